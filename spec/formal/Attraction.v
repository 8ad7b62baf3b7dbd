(** Every motion of a drag axis under a relay comes to the cycle, as near as one likes and for good; whatever repeats runs on it. Shared by
    the orbits. *)
From Coq Require Import Reals Lra Lia Psatz FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Phase Return Switching.
Open Scope R_scope.

Lemma large k : exists n, k < INR n.
Proof.
  destruct (archimed (Rmax 0 k)) as [A _]. assert (0 <= up (Rmax 0 k))%Z.
  { apply le_IZR. pose proof (Rmax_l 0 k). lra. }
  exists (Z.to_nat (up (Rmax 0 k))). rewrite INR_IZR_INZ, Z2Nat.id by exact H. pose proof (Rmax_r 0 k). lra.
Qed.

Lemma two_halves q a b d : 0 < q < 1 -> 0 <= a -> 0 <= b -> b <= q * a -> d <= q * b -> d <= q * a /\ b <= a /\ d <= a.
Proof. intros [Q0 Q1] A B BA DB. assert (q * a <= a) by nra. assert (q * b <= b) by nra. repeat split; lra. Qed.

(** * One half beside another *)

Section Beside.
Variables alpha beta_1 beta_2 c x_a : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hc : 0 < c) (Hx : 0 < x_a).
Local Notation path := (way alpha beta_1 beta_2 c).
Local Notation turn := (half alpha beta_1 beta_2 c x_a).

(** The half cycle from the speed A at the upper level to B at the lower, in the phase plane. *)
Definition arc (A B y w : R) : Prop := - B <= w <= A /\ y = x_a + path A - path w.

Lemma nearer m V A : 0 < m -> m <= V -> m <= A -> Rabs (V - A) <= Rabs (V ^ 2 - A ^ 2) / m.
Proof.
  intros M MV MA. replace (V ^ 2 - A ^ 2) with ((V - A) * (V + A)) by ring. rewrite Rabs_mult, (Rabs_pos_eq (V + A)) by lra.
  apply (Rmult_le_reg_r m); [exact M|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
  apply Rmult_le_compat_l; [apply Rabs_pos|lra].
Qed.

Lemma way_nearer V A : 0 <= V -> 0 <= A -> Rabs (path V - path A) <= alpha / (2 * c) * Rabs (V ^ 2 - A ^ 2).
Proof.
  assert (one : forall V A, 0 <= V -> V < A -> Rabs (path V - path A) <= alpha / (2 * c) * Rabs (V ^ 2 - A ^ 2)).
  { intros v a v0 va. destruct (way_between alpha beta_1 beta_2 c Hb1 Hb2 Hc v a v0 va) as [s [Hs E]].
    pose proof (way_rises alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc v a v0 va). pose proof (force_of_speed beta_1 beta_2 c Hb1 Hb2 s ltac:(lra)).
    assert (0 < a ^ 2 - v ^ 2) by nra. rewrite !Rabs_left by lra.
    replace (- (path v - path a)) with (path a - path v) by ring. rewrite E.
    replace (alpha / (2 * c) * - (v ^ 2 - a ^ 2)) with (alpha * (a ^ 2 - v ^ 2) / (2 * c)) by (field; lra).
    apply Rmult_le_compat_l; [nra|]. apply Rinv_le_contravar; lra. }
  intros V0 A0. destruct (Rtotal_order V A) as [L|[-> |L]]; [apply one; assumption| |].
  - rewrite !Rminus_diag_eq, Rabs_R0 by ring. lra.
  - rewrite (Rabs_minus_sym (path V)), (Rabs_minus_sym (V ^ 2)). apply one; assumption.
Qed.

Lemma beside x v b b' V V' A B m eta t : fall alpha beta_1 beta_2 c x v b b' -> x b = x_a -> v b = V -> v b' = - V' ->
  turn V V' -> turn A B -> 0 < m -> m <= V -> m <= V' -> m <= A -> m <= B ->
  Rabs (V ^ 2 - A ^ 2) <= eta -> Rabs (V' ^ 2 - B ^ 2) <= eta -> b <= t <= b' ->
  exists y w, arc A B y w /\ Rabs (x t - y) <= alpha / (2 * c) * eta /\ Rabs (v t - w) <= eta / m.
Proof.
  intros F Xb Vb Vb' HV HA M MV MV' MA MB N N' Ht.
  assert (P : 0 < force beta_1 beta_2 c (v b)) by (pose proof (force_of_speed beta_1 beta_2 c Hb1 Hb2 (v b) ltac:(lra)); lra).
  assert (I : x t = x_a + path V - path (v t)).
  { pose proof (first_integral alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc x v b t (fall_part alpha beta_1 beta_2 c x v b b' b t F ltac:(lra) ltac:(lra) ltac:(lra)) P) as I.
    rewrite Xb, Vb in I. lra. }
  assert (Vt : - V' <= v t <= V).
  { split.
    - destruct (Req_dec t b') as [->|E]; [lra|]. pose proof (speed_falls alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc x v b b' t b' F P). lra.
    - destruct (Req_dec t b) as [->|E]; [lra|]. pose proof (speed_falls alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc x v b b' b t F P). lra. }
  assert (W : Rabs (path V - path A) <= alpha / (2 * c) * eta).
  { apply Rle_trans with (alpha / (2 * c) * Rabs (V ^ 2 - A ^ 2)); [apply way_nearer; lra|].
    apply Rmult_le_compat_l; [left; apply Rdiv_lt_0_compat; lra|exact N]. }
  assert (S : Rabs (V - A) <= eta / m).
  { apply Rle_trans with (Rabs (V ^ 2 - A ^ 2) / m); [apply nearer; assumption|].
    apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; exact M|exact N]. }
  assert (S' : Rabs (V' - B) <= eta / m).
  { apply Rle_trans with (Rabs (V' ^ 2 - B ^ 2) / m); [apply nearer; assumption|].
    apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; exact M|exact N']. }
  assert (E0 : 0 <= eta / m) by (pose proof (Rabs_pos (V - A)); lra).
  destruct HV as [_ [_ [FV EV]]]. destruct HA as [_ [_ [FA EA]]].
  destruct (Rlt_le_dec A (v t)) as [Q|Q]; [|destruct (Rlt_le_dec (v t) (- B)) as [Q'|Q']].
  - exists x_a, A. split; [split; [lra|ring]|].
    pose proof (way_rises alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc A (v t) ltac:(lra) Q) as W1.
    assert (W2 : path (v t) <= path V) by (destruct (proj2 Vt) as [L| ->]; [left; apply way_rises; lra|lra]).
    rewrite Rabs_pos_eq in W by lra. rewrite Rabs_pos_eq in S by lra. split; rewrite Rabs_pos_eq; lra.
  - exists (- x_a), (- B). split; [split; [lra|lra]|].
    assert (Pt : 0 < force beta_1 beta_2 c (v t)) by (pose proof (force_le beta_1 beta_2 c Hb1 Hb2 (- V') (v t) ltac:(lra)); lra).
    pose proof (way_falls alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc (v t) (- B) Pt Q' ltac:(lra)) as W1.
    assert (W2 : path (v t) <= path (- V')) by (destruct (proj1 Vt) as [L| <-]; [left; apply way_falls; lra|lra]).
    rewrite Rabs_pos_eq in W by lra. rewrite Rabs_pos_eq in S' by lra. split; [rewrite Rabs_pos_eq; lra|rewrite Rabs_left1; lra].
  - exists (x_a + path A - path (v t)), (v t). split; [split; [lra|reflexivity]|]. split.
    + replace (x t - (x_a + path A - path (v t))) with (path V - path A) by lra. exact W.
    + rewrite Rminus_diag_eq, Rabs_R0 by ring. exact E0.
Qed.
End Beside.

(** * The whole loop *)

Section Loop.
Variables alpha beta_1 beta_2 delta C x_a : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hb : 0 < beta_1 + beta_2) (Hx : 0 < x_a) (Hd : Rabs delta < C).

(** The forces of the two commands. *)
Definition c_down : R := C - delta.
Definition c_up : R := C - - delta.

Lemma forces_positive : 0 < c_down /\ 0 < c_up.
Proof. pose proof (Rabs_def2 _ _ Hd). unfold c_down, c_up. lra. Qed.

Local Notation down := (half alpha beta_1 beta_2 c_down x_a).
Local Notation up := (half alpha beta_1 beta_2 c_up x_a).

(** The cycle in the phase plane: P the speed at the upper level, Q at the lower. *)
Definition on_cycle (P Q y w : R) : Prop :=
  arc alpha beta_1 beta_2 c_down x_a P Q y w \/ arc alpha beta_1 beta_2 c_up x_a Q P (- y) (- w).

Local Notation loop := (relay_loop alpha beta_1 beta_2 delta C x_a).
Local Notation at_top := (top C x_a).

Lemma round x v u b V : loop x v u -> at_top x v u b V -> exists b' V' b'' V'', b < b' < b'' /\
  fall alpha beta_1 beta_2 c_down x v b b' /\ v b' = - V' /\ down V V' /\
  b' = b + (time alpha beta_1 beta_2 c_down V - time alpha beta_1 beta_2 c_down (- V')) /\
  fall alpha beta_1 beta_2 c_up (fun t => - x t) (fun t => - v t) b' b'' /\ - x b' = x_a /\ v b'' = V'' /\ up V' V'' /\
  b'' = b' + (time alpha beta_1 beta_2 c_up V' - time alpha beta_1 beta_2 c_up (- V'')) /\ at_top x v u b'' V''.
Proof.
  intros M T. pose proof (Rabs_def2 _ _ Hd) as [D1 D2].
  destruct (half_turn alpha beta_1 beta_2 C x_a Ha Hb1 Hb2 Hb Hx delta x v u b V M D1 T) as [b' [V' [L1 [F1 [H1 [E1 T1]]]]]].
  destruct (half_turn alpha beta_1 beta_2 C x_a Ha Hb1 Hb2 Hb Hx (- delta) _ _ _ b' V' (mirror _ _ _ _ _ _ _ _ _ M) ltac:(lra) T1)
    as [b'' [V'' [L2 [F2 [H2 [E2 T2]]]]]].
  rewrite !twice in T2. exists b', V', b'', V''. pose proof T1 as [_ [X1 [V1 _]]]. pose proof T2 as [_ [X2 [V2 _]]].
  split; [split; assumption|]. split; [exact F1|]. split; [lra|]. split; [exact H1|]. split; [exact E1|].
  split; [exact F2|]. split; [exact X1|]. split; [exact V2|]. split; [exact H2|]. split; [exact E2|exact T2].
Qed.

(** Every motion comes as near to the cycle as one likes, and stays there. *)
Theorem attraction P Q x v u : down P Q -> up Q P -> loop x v u -> forall eps, 0 < eps ->
  exists since, forall t, since < t -> exists y w, on_cycle P Q y w /\ Rabs (x t - y) < eps /\ Rabs (v t - w) < eps.
Proof.
  intros HQ HP M eps Eps. destruct forces_positive as [C1 C2].
  destruct (rate alpha beta_1 beta_2 c_down c_up x_a Ha Hb1 Hb2 Hb C1 C2 Hx P Q HQ HP) as [m [q [Pm [Hq [L1 [L2 [N1 N2]]]]]]].
  destruct (passes_top alpha beta_1 beta_2 C x_a Ha Hb1 Hb2 Hb Hx delta x v u M Hd) as [b_0 [V_0 T0]].
  destruct (round x v u b_0 V_0 M T0) as [b_h [V_h [b_1 [V_1 [_ [_ [_ [_ [_ [_ [_ [_ [H1 [_ T1]]]]]]]]]]]]]].
  pose proof (L2 _ _ H1) as M1.
  (* nearer with every round *)
  set (K := Rabs (V_1 ^ 2 - P ^ 2)).
  assert (rounds : forall n, exists b V, at_top x v u b V /\ m <= V /\ Rabs (V ^ 2 - P ^ 2) <= q ^ n * K).
  { induction n as [|n [b [V [T [MV N]]]]].
    - exists b_1, V_1. split; [exact T1|]. split; [exact M1|]. unfold K. simpl. lra.
    - destruct (round x v u b V M T) as [b' [V' [b'' [V'' [_ [_ [_ [G1 [_ [_ [_ [_ [G2 [_ T'']]]]]]]]]]]]]].
      exists b'', V''. split; [exact T''|]. split; [exact (L2 _ _ G2)|].
      pose proof (N1 V V' MV G1) as R1. pose proof (N2 V' V'' (L1 _ _ G1) G2) as R2.
      pose proof (Rabs_pos (V ^ 2 - P ^ 2)). pose proof (Rabs_pos (V' ^ 2 - Q ^ 2)).
      simpl. rewrite Rmult_assoc. apply Rle_trans with (q * Rabs (V ^ 2 - P ^ 2)); [exact (proj1 (two_halves q _ _ _ Hq H H0 R1 R2))|]. apply Rmult_le_compat_l; lra. }
  (* and near for good *)
  set (G := / m + alpha / (2 * c_down) + alpha / (2 * c_up)).
  assert (G1 : 0 < / m) by (apply Rinv_0_lt_compat, Pm).
  assert (G2 : 0 < alpha / (2 * c_down)) by (apply Rdiv_lt_0_compat; lra). assert (G3 : 0 < alpha / (2 * c_up)) by (apply Rdiv_lt_0_compat; lra).
  set (eta := eps / (2 * G)). assert (PG : 0 < G) by (unfold G; lra).
  assert (Eta : 0 < eta) by (apply Rdiv_lt_0_compat; lra). assert (EG : eta * G = eps / 2) by (unfold eta; field; lra).
  assert (small : forall g, 0 < g -> g <= G -> g * eta < eps) by (intros g Pg Lg; nra).
  set (tau := - time alpha beta_1 beta_2 c_down (- m)).
  assert (Tau : forall V V', m <= V -> down V V' -> tau <= time alpha beta_1 beta_2 c_down V - time alpha beta_1 beta_2 c_down (- V') /\ 0 < tau).
  { intros V V' MV HV. pose proof (L1 _ _ HV) as MV'. destruct HV as [_ [_ [FV _]]].
    assert (Fm : 0 < force beta_1 beta_2 c_down (- m)) by (pose proof (force_le beta_1 beta_2 c_down Hb1 Hb2 (- V') (- m) ltac:(lra)); lra).
    pose proof (time_rises alpha beta_1 beta_2 c_down Ha Hb1 Hb2 C1 0 V ltac:(rewrite force_at_rest; lra) ltac:(lra)) as R1. rewrite time_0 in R1.
    pose proof (time_rises alpha beta_1 beta_2 c_down Ha Hb1 Hb2 C1 (- m) 0 Fm ltac:(lra)) as R2. rewrite time_0 in R2.
    assert (R3 : time alpha beta_1 beta_2 c_down (- V') <= time alpha beta_1 beta_2 c_down (- m))
      by (destruct MV' as [L|<-]; [left; apply time_rises; lra|lra]). unfold tau. lra. }
  assert (near : forall k b V, at_top x v u b V -> m <= V -> Rabs (V ^ 2 - P ^ 2) <= eta -> forall t, b <= t < b + INR k * tau ->
            exists y w, on_cycle P Q y w /\ Rabs (x t - y) < eps /\ Rabs (v t - w) < eps).
  { induction k as [|k IH]; intros b V T MV N t Ht; [simpl in Ht; lra|].
    destruct (round x v u b V M T) as [b' [V' [b'' [V'' [Lt [F1 [E1 [D1 [B1 [F2 [X2 [E2 [D2 [B2 T'']]]]]]]]]]]]]].
    pose proof T as [_ [X1 [Y1 _]]]. pose proof (Tau V V' MV D1) as [Tau1 Tau2].
    pose proof (N1 V V' MV D1) as R1. pose proof (N2 V' V'' (L1 _ _ D1) D2) as R2.
    pose proof (Rabs_pos (V ^ 2 - P ^ 2)). pose proof (Rabs_pos (V' ^ 2 - Q ^ 2)).
    destruct (two_halves q _ _ _ Hq H H0 R1 R2) as [_ [S1 S2]].
    assert (N' : Rabs (V' ^ 2 - Q ^ 2) <= eta) by lra. assert (N'' : Rabs (V'' ^ 2 - P ^ 2) <= eta) by lra.
    destruct (Rle_lt_dec t b') as [Q1|Q1]; [|destruct (Rle_lt_dec t b'') as [Q2|Q2]].
    - destruct (beside alpha beta_1 beta_2 c_down x_a Ha Hb1 Hb2 C1 x v b b' V V' P Q m eta t F1 X1 Y1 E1 D1 HQ Pm MV (L1 _ _ D1) (L2 _ _ HP)
        (L1 _ _ HQ) N N' ltac:(lra)) as [y [w [A [A1 A2]]]].
      exists y, w. split; [left; exact A|]. split; [apply Rle_lt_trans with (1 := A1)|apply Rle_lt_trans with (1 := A2); unfold Rdiv; rewrite Rmult_comm]; apply small; unfold G; lra.
    - destruct (beside alpha beta_1 beta_2 c_up x_a Ha Hb1 Hb2 C2 (fun t => - x t) (fun t => - v t) b' b'' V' V'' Q P m eta t F2 X2 ltac:(cbv beta; lra) ltac:(cbv beta; lra)
        D2 HP Pm (L1 _ _ D1) (L2 _ _ D2) (L1 _ _ HQ) (L2 _ _ HP) N' N'' ltac:(lra)) as [y [w [A [A1 A2]]]].
      exists (- y), (- w). split; [right; rewrite !Ropp_involutive; exact A|].
      replace (x t - - y) with (- (- x t - y)) by ring. replace (v t - - w) with (- (- v t - w)) by ring. rewrite !Rabs_Ropp.
      split; [apply Rle_lt_trans with (1 := A1)|apply Rle_lt_trans with (1 := A2); unfold Rdiv; rewrite Rmult_comm]; apply small; unfold G; lra.
    - apply (IH b'' V'' T'' (L2 _ _ D2) N'' t). rewrite S_INR in Ht. split; [lra|].
      pose proof (pos_INR k). nra. }
  destruct (pow_lt_1_zero q ltac:(rewrite Rabs_pos_eq; lra) (eta / (K + 1))) as [n Hn].
  { apply Rdiv_lt_0_compat; [exact Eta|]. unfold K. pose proof (Rabs_pos (V_1 ^ 2 - P ^ 2)). lra. }
  destruct (rounds n) as [b [V [T [MV N]]]]. exists b. intros t bt.
  assert (N' : Rabs (V ^ 2 - P ^ 2) <= eta).
  { specialize (Hn n (Nat.le_refl n)). rewrite Rabs_pos_eq in Hn by (apply pow_le; lra). pose proof (Rabs_pos (V_1 ^ 2 - P ^ 2)) as K0. fold K in K0.
    apply Rle_trans with (1 := N). apply Rle_trans with (eta / (K + 1) * K); [apply Rmult_le_compat_r; lra|].
    apply (Rmult_le_reg_r (K + 1)); [lra|]. replace (eta / (K + 1) * K * (K + 1)) with (eta * K) by (field; lra). nra. }
  destruct (round x v u b V M T) as [b' [V' [_ [_ [_ [_ [_ [D1 _]]]]]]]]. pose proof (Tau V V' MV D1) as [_ Tau2].
  destruct (large ((t - b) / tau)) as [k Hk]. apply (near k b V T MV N' t). split; [lra|].
  apply (Rmult_lt_compat_r tau) in Hk; [|exact Tau2]. unfold Rdiv in Hk. rewrite Rmult_assoc, Rinv_l, Rmult_1_r in Hk by lra. lra.
Qed.
End Loop.
