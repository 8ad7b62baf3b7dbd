(** Any motion of axis and relay, from the law of either alone: the command stays until the other level, the level is reached, the command turns
    there, and from one level to the other the speeds go through the half map. Shared by the orbits. *)
From Coq Require Import Reals Lra Lia Psatz Classical FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Phase.
Open Scope R_scope.

Lemma continuity_of_continuous (f : R -> R) t : continuous f t -> continuity_pt f t.
Proof. intros H. apply continuity_pt_filterlim. exact H. Qed.

Lemma stays_above (f : R -> R) t y : continuity_pt f t -> y < f t -> exists d, 0 < d /\ forall s, Rabs (s - t) < d -> y < f s.
Proof.
  intros C H. apply continuity_pt_filterlim in C.
  destruct (C (fun z => y < z) (open_gt y (f t) H)) as [d Hd]. exists d. split; [apply cond_pos|]. intros s Hs. apply Hd. exact Hs.
Qed.

Lemma stays_below (f : R -> R) t y : continuity_pt f t -> f t < y -> exists d, 0 < d /\ forall s, Rabs (s - t) < d -> f s < y.
Proof.
  intros C H. apply continuity_pt_filterlim in C.
  destruct (C (fun z => z < y) (open_lt y (f t) H)) as [d Hd]. exists d. split; [apply cond_pos|]. intros s Hs. apply Hd. exact Hs.
Qed.

Lemma first_passage (f : R -> R) a e y : a < e -> (forall t, a <= t <= e -> continuity_pt f t) -> y < f a -> f e <= y ->
  exists b, a < b <= e /\ f b = y /\ forall r, a <= r < b -> y < f r.
Proof.
  intros ae C A E. set (S := fun s => a <= s <= e /\ forall r, a <= r <= s -> y < f r).
  assert (Sa : S a) by (split; [lra|]; intros r Hr; replace r with a by lra; exact A).
  destruct (completeness S) as [b [B1 B2]]; [exists e; intros s [Hs _]; lra|now exists a|].
  assert (ab : a <= b) by exact (B1 a Sa). assert (be : b <= e) by (apply B2; intros s [Hs _]; lra).
  assert (before : forall r, a <= r < b -> y < f r).
  { intros r Hr. destruct (classic (exists s, S s /\ r < s)) as [[s [[Hs Q] rs]]|N]; [apply Q; lra|exfalso].
    assert (b <= r); [|lra]. apply B2. intros s Ss. destruct (Rle_lt_dec s r) as [L|L]; [exact L|exfalso; apply N; now exists s]. }
  assert (Eb : f b = y).
  { destruct (Rtotal_order (f b) y) as [L|[L|L]]; [exfalso|exact L|exfalso].
    - destruct (stays_below f b y (C b ltac:(lra)) L) as [d [D Hd]].
      assert (a < b) by (destruct ab as [?| <-]; lra).
      set (r := Rmax a (b - d / 2)). assert (R1 : a <= r < b) by (unfold r; split; [apply Rmax_l|apply Rmax_lub_lt; lra]).
      specialize (before r R1). specialize (Hd r). assert (Rabs (r - b) < d); [|specialize (Hd H0); lra].
      assert (b - d / 2 <= r) by apply Rmax_r. rewrite Rabs_left by lra. lra.
    - destruct (stays_above f b y (C b ltac:(lra)) L) as [d [D Hd]].
      assert (b < e) by (destruct be as [?| ->]; lra).
      set (s := Rmin e (b + d / 2)). assert (R1 : b < s <= e) by (unfold s; split; [apply Rmin_glb_lt; lra|apply Rmin_l]).
      assert (S s); [|specialize (B1 s H0); lra]. split; [lra|]. intros r Hr.
      destruct (Rlt_le_dec r b) as [Q|Q]; [apply before; lra|]. apply Hd. assert (s <= b + d / 2) by apply Rmin_r.
      rewrite Rabs_pos_eq by lra. lra. }
  exists b. split; [|split; assumption]. split; [|exact be]. destruct ab as [?| <-]; lra.
Qed.

(** * Falling *)

Section Fall.
Variables alpha beta_1 beta_2 c : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hb : 0 < beta_1 + beta_2) (Hc : 0 < c).
Local Notation falls := (fall alpha beta_1 beta_2 c).
Local Notation push := (force beta_1 beta_2 c).

Lemma sinks x v a e k y : (forall t, a < t -> falls x v a t) -> a <= e -> 0 < k -> (forall t, e < t -> v t <= - k) ->
  exists t, a < t /\ x t <= y.
Proof.
  intros F ae K V. set (t := e + 1 + Rmax 0 ((x e - y) / k)). exists t.
  pose proof (Rmax_l 0 ((x e - y) / k)) as M1. pose proof (Rmax_r 0 ((x e - y) / k)) as M2.
  assert (et : e < t) by (unfold t; lra). split; [lra|]. destruct (F t ltac:(lra)) as [_ X _ DX _].
  assert (D : x t + k * t <= x e + k * e).
  { apply (does_not_rise (fun t => x t + k * t) (fun t => v t + k) e t); [lra| | |].
    - intros s Hs. apply (is_derive_plus x (fun t => k * t)); [apply DX; lra|]. auto_derive; [trivial|ring].
    - intros s Hs. apply (continuity_pt_plus x (fun t => k * t)); [apply X; lra|].
      apply (continuity_of_derive _ s k). auto_derive; [trivial|ring].
    - intros s Hs. specialize (V s ltac:(lra)). lra. }
  assert (Q : x e - y <= k * (t - e)).
  { replace (x e - y) with (k * ((x e - y) / k)) by (field; lra). apply Rmult_le_compat_l; [lra|]. unfold t. lra. }
  lra.
Qed.

(** However fast it begins, an axis that falls for ever passes every level. *)
Lemma passes x v a y : (forall t, a < t -> falls x v a t) -> exists t, a < t /\ x t <= y.
Proof.
  intros F. destruct (classic (exists e, a < e /\ 0 < push (v e))) as [[e [ae P]]|N].
  - assert (Fe : forall t, e < t -> falls x v e t) by (intros t et; apply (fall_part alpha beta_1 beta_2 c x v a t e t (F t ltac:(lra))); lra).
    set (g := e + 1 + Rmax 0 (time alpha beta_1 beta_2 c (v e))).
    pose proof (Rmax_l 0 (time alpha beta_1 beta_2 c (v e))). pose proof (Rmax_r 0 (time alpha beta_1 beta_2 c (v e))).
    assert (eg : e < g) by (unfold g; lra). pose proof (passing_time alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc x v e g (Fe g eg) P) as T.
    assert (Vg : v g < 0).
    { destruct (Rlt_le_dec (v g) 0) as [Q|[Q|Q]]; [exact Q|exfalso|exfalso].
      - pose proof (time_rises alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc 0 (v g)) as TR. rewrite time_0, force_at_rest in TR. unfold g in *. lra.
      - rewrite <- Q, time_0 in T. unfold g in *. lra. }
    apply (sinks x v a g (- v g) y F); [lra|lra|]. intros t gt.
    pose proof (speed_falls alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc x v e t g t (Fe t ltac:(lra)) P). lra.
  - destruct (terminal_speed beta_1 beta_2 Hb1 Hb2 c Hc Hb) as [W Ew]. set (w := terminal beta_1 beta_2 c) in *.
    apply (sinks x v a a w y F); [lra|exact W|]. intros t at_. destruct (Rle_lt_dec (v t) (- w)) as [Q|Q]; [exact Q|exfalso].
    apply N. exists t. split; [exact at_|]. unfold force. pose proof (drag_lt beta_1 beta_2 Hb1 Hb2 (- w) (v t) Hb Q) as D.
    rewrite drag_odd in D. lra.
Qed.

(** It passes a level downwards. *)
Lemma passes_down x v a b : falls x v a b -> a < b -> (forall r, a <= r < b -> x b < x r) -> v b < 0.
Proof.
  intros F ab above. destruct (Rlt_le_dec (v b) 0) as [Q|Q]; [exact Q|exfalso].
  pose proof F as [_ X V DX DV].
  pose proof (force_of_speed beta_1 beta_2 c Hb1 Hb2 (v b) Q) as P.
  assert (Cf : continuity_pt (fun r => push (v r)) b).
  { apply (continuity_pt_comp v (force beta_1 beta_2 c) b); [apply V; lra|]. apply (continuity_of_derive _ _ _ (force_derive beta_1 beta_2 c (v b))). }
  destruct (stays_above _ b 0 Cf ltac:(cbv beta; lra)) as [d [D Hd]].
  set (s := Rmax a (b - d / 2)). assert (S1 : a <= s < b) by (unfold s; split; [apply Rmax_l|apply Rmax_lub_lt; lra]).
  assert (S2 : b - d / 2 <= s) by apply Rmax_r.
  assert (Ps : 0 < push (v s)) by (apply Hd; rewrite Rabs_left by lra; lra).
  assert (Fs : falls x v s b) by (apply (fall_part alpha beta_1 beta_2 c x v a b s b F); lra).
  assert (x s < x b); [|specialize (above s S1); lra].
  apply (increases x v s b); [lra| | |]; intros r Hr; [apply DX; lra|apply X; lra|].
  pose proof (speed_falls alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc x v s b r b Fs Ps). lra.
Qed.
End Fall.

(** * The mirror *)

Lemma mirror alpha beta_1 beta_2 delta C x_a x v u : relay_loop alpha beta_1 beta_2 delta C x_a x v u ->
  relay_loop alpha beta_1 beta_2 (- delta) C x_a (fun t => - x t) (fun t => - v t) (fun t => - u t).
Proof.
  intros [[X V N] [T H L SH SL]]. split; split.
  - intros t Ht. apply (is_derive_opp (K := R_AbsRing) x), X, Ht.
  - intros t Ht. apply (continuous_opp (K := R_AbsRing) v), V, Ht.
  - intros t Ht E. specialize (N t Ht). cbv beta.
    assert (E' : locally t (fun s => u s = u t)) by (revert E; apply filter_imp; intros s; lra).
    replace ((- u t + - delta - drag beta_1 beta_2 (- v t)) / alpha) with (opp ((u t + delta - drag beta_1 beta_2 (v t)) / alpha)).
    + apply (is_derive_opp (K := R_AbsRing) v), N, E'.
    + rewrite drag_odd. unfold opp; simpl. unfold Rdiv. ring.
  - intros t Ht. destruct (T t Ht) as [-> | ->]; [right|left]; ring.
  - intros t Ht K. rewrite (L t Ht) by lra. ring.
  - intros t Ht K. rewrite (H t Ht) by lra. ring.
  - intros s t Hs Ht st Us between. rewrite (SL s t Hs Ht st) by (try lra; intros r Lr Hr; specialize (between r Lr Hr); lra). ring.
  - intros s t Hs Ht st Us between. rewrite (SH s t Hs Ht st) by (try lra; intros r Lr Hr; specialize (between r Lr Hr); lra). ring.
Qed.

Lemma twice (f : R -> R) : (fun t => - - f t) = f.
Proof. apply functional_extensionality. intros. ring. Qed.

(** * From one level to the other *)

Section Loop.
Variables alpha beta_1 beta_2 C x_a : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hb : 0 < beta_1 + beta_2) (Hx : 0 < x_a).
Local Notation loop := (fun delta => relay_loop alpha beta_1 beta_2 delta C x_a).

(** After the instant a the command is [-C] until the lower level. *)
Definition commanded (x u : R -> R) (a : R) : Prop :=
  - x_a < x a /\ forall s, a < s -> (forall r, a < r <= s -> - x_a < x r) -> u s = - C.

Lemma falls_while delta x v u a b : loop delta x v u -> 0 < a -> commanded x u a -> a < b ->
  (forall r, a < r < b -> - x_a < x r) -> fall alpha beta_1 beta_2 (C - delta) x v a b.
Proof.
  intros [[X V N] _] a0 [_ Com] ab above. split; [lra| | | |]; intros t Ht.
  - apply (continuity_of_derive x t (v t)), X. lra.
  - apply continuity_of_continuous, V. lra.
  - apply X. lra.
  - assert (U : forall s, a < s < b -> u s = - C) by (intros s Hs; apply Com; [lra|]; intros r Hr; apply above; lra).
    replace (- (force beta_1 beta_2 (C - delta) (v t) / alpha)) with ((u t + delta - drag beta_1 beta_2 (v t)) / alpha)
      by (rewrite U by exact Ht; unfold force; field; lra).
    apply N; [lra|]. assert (P : 0 < Rmin (t - a) (b - t)) by (apply Rmin_pos; lra).
    exists (mkposreal _ P). intros s Hs. change (Rabs (s - t) < Rmin (t - a) (b - t)) in Hs.
    pose proof (Rmin_l (t - a) (b - t)). pose proof (Rmin_r (t - a) (b - t)). apply Rabs_def2 in Hs. rewrite !U by lra. reflexivity.
Qed.

(** The lower level is reached, and passed downwards; the command turns. *)
Lemma next_passage delta x v u a : loop delta x v u -> delta < C -> 0 < a -> commanded x u a ->
  exists b, a < b /\ fall alpha beta_1 beta_2 (C - delta) x v a b /\ x b = - x_a /\ v b < 0 /\ commanded (fun t => - x t) (fun t => - u t) b.
Proof.
  intros M D a0 Com. pose proof M as [[X V N] [T H L SH SL]].
  assert (E : exists e, a < e /\ x e <= - x_a).
  { destruct (classic (exists e, a < e /\ x e <= - x_a)) as [E|E]; [exact E|].
    apply (passes alpha beta_1 beta_2 (C - delta) Ha Hb1 Hb2 Hb ltac:(lra) x v a). intros t Ht.
    apply (falls_while delta x v u a t M a0 Com Ht). intros r Hr.
    destruct (Rlt_le_dec (- x_a) (x r)) as [Q|Q]; [exact Q|exfalso]. apply E. exists r. lra. }
  destruct E as [e [ae E]].
  destruct (first_passage x a e (- x_a) ae) as [b [[ab be] [Eb above]]]; [|apply Com|exact E|].
  { intros t Ht. apply (continuity_of_derive x t (v t)), X. lra. }
  assert (F : fall alpha beta_1 beta_2 (C - delta) x v a b) by (apply (falls_while delta x v u a b M a0 Com ab); intros r Hr; apply above; lra).
  assert (Vb : v b < 0) by (apply (passes_down alpha beta_1 beta_2 (C - delta) Ha Hb1 Hb2 ltac:(lra) x v a b F ab); intros r Hr; rewrite Eb; apply above, Hr).
  exists b. repeat (split; [assumption|]). split; [cbv beta; lra|]. intros s bs between. cbv beta in *.
  destruct (stays_below v b 0 (continuity_of_continuous v b (V b ltac:(lra))) Vb) as [d [Pd Hd]].
  set (r := Rmin s (b + d / 2)). assert (R1 : b < r <= s) by (unfold r; split; [apply Rmin_glb_lt; lra|apply Rmin_l]).
  assert (R2 : r <= b + d / 2) by apply Rmin_r.
  assert (Xr : x r < x b).
  { apply (decreases x v b r); [lra| | |]; intros q Hq; [apply X; lra|apply (continuity_of_derive x q (v q)), X; lra|].
    apply Hd. rewrite Rabs_pos_eq by lra. lra. }
  assert (Ur : u r = C) by (apply H; [unfold later; lra|lra]).
  rewrite (SH r s); [ring|unfold later; lra|unfold later; lra|lra|exact Ur|]. intros q _ Hq. specialize (between q ltac:(lra)). lra.
Qed.

(** The upper level, passed upwards at the speed V at the instant b. *)
Definition top (x v u : R -> R) (b V : R) : Prop := 0 < b /\ x b = x_a /\ v b = V /\ 0 < V /\ commanded x u b.

(** From one level to the other: the half map, and the time it takes. *)
Lemma half_turn delta x v u b V : loop delta x v u -> delta < C -> top x v u b V ->
  exists b' V', b < b' /\ fall alpha beta_1 beta_2 (C - delta) x v b b' /\ half alpha beta_1 beta_2 (C - delta) x_a V V' /\
    b' = b + (time alpha beta_1 beta_2 (C - delta) V - time alpha beta_1 beta_2 (C - delta) (- V')) /\
    top (fun t => - x t) (fun t => - v t) (fun t => - u t) b' V'.
Proof.
  intros M D [b0 [Xb [Vb [V0 Com]]]]. destruct (next_passage delta x v u b M D b0 Com) as [b' [bb' [F [Xb' [Vb' Com']]]]].
  assert (P : 0 < force beta_1 beta_2 (C - delta) (v b)).
  { pose proof (force_of_speed beta_1 beta_2 (C - delta) Hb1 Hb2 (v b) ltac:(lra)). lra. }
  exists b', (- v b'). split; [exact bb'|]. split; [exact F|]. split; [|split].
  - pose proof (first_integral alpha beta_1 beta_2 (C - delta) Ha Hb1 Hb2 ltac:(lra) x v b b' F P) as I.
    unfold half. rewrite Ropp_involutive. split; [lra|]. split; [lra|]. split; [|rewrite Xb, Xb', Vb in I; lra].
    apply (keeps_moving alpha beta_1 beta_2 (C - delta) Ha x v b b' b' F P). lra.
  - pose proof (passing_time alpha beta_1 beta_2 (C - delta) Ha Hb1 Hb2 ltac:(lra) x v b b' F P) as I.
    rewrite Ropp_involutive, <- Vb. lra.
  - unfold top. split; [lra|]. split; [lra|]. split; [reflexivity|]. split; [lra|exact Com'].
Qed.

(** Every motion comes to a level with the command that it had. *)
Lemma begins delta x v u : loop delta x v u -> Rabs delta < C -> exists a, 0 < a /\ (commanded x u a \/ commanded (fun t => - x t) (fun t => - u t) a).
Proof.
  intros M D. pose proof (Rabs_def2 _ _ D) as [D1 D2]. pose proof M as [[X V N] [T H L SH SL]].
  assert (low : forall a, 0 < a -> u a = - C -> - x_a < x a -> commanded x u a).
  { intros a a0 Ua Xa. split; [exact Xa|]. intros s as_ between. apply (SL a s); try (unfold later; lra). intros r _ Hr. specialize (between r Hr). lra. }
  assert (high : forall a, 0 < a -> u a = C -> x a < x_a -> commanded (fun t => - x t) (fun t => - u t) a).
  { intros a a0 Ua Xa. split; [lra|]. intros s as_ between. rewrite (SH a s); try (unfold later; lra). intros r _ Hr. specialize (between r Hr). lra. }
  destruct (classic (exists a, 0 < a /\ (commanded x u a \/ commanded (fun t => - x t) (fun t => - u t) a))) as [Y|No]; [exact Y|exfalso].
  assert (stuck : forall a, 0 < a -> u a = C /\ x a = x_a \/ u a = - C /\ x a = - x_a).
  { intros a a0. destruct (T a a0) as [Ua|Ua]; [left|right]; (split; [exact Ua|]).
    - destruct (Rlt_le_dec (x a) x_a) as [Q|[Q|Q]]; [exfalso; apply No; exists a; split; [exact a0|right; apply high; assumption]| |lra].
      rewrite (L a a0) in Ua by lra. lra.
    - destruct (Rlt_le_dec (- x_a) (x a)) as [Q|[Q|Q]]; [exfalso; apply No; exists a; split; [exact a0|left; apply low; assumption]| |lra].
      rewrite (H a a0) in Ua by lra. lra. }
  (* Nothing can stay at a level: the command moves it. *)
  assert (rest : forall (y w : R), w = C \/ w = - C -> forall d, 0 < d -> (forall t, Rabs (t - 1) < d -> x t = y /\ u t = w) -> False).
  { intros y w Hw d Pd Near.
    assert (Loc : locally 1 (fun t => x t = y /\ u t = w)) by (exists (mkposreal d Pd); intros t Ht; apply Near, Ht).
    assert (V0 : forall t, Rabs (t - 1) < Rmin d (1 / 2) -> v t = 0).
    { intros t Ht. pose proof (Rmin_l d (1 / 2)). pose proof (Rmin_r d (1 / 2)). pose proof (Rabs_def2 _ _ Ht).
      assert (Dt : is_derive x t 0).
      { apply (is_derive_ext_loc (fun _ => y)); [|exact (is_derive_const y t)].
        assert (P : 0 < d - Rabs (t - 1)) by lra. exists (mkposreal _ P). intros s Hs. change (Rabs (s - t) < d - Rabs (t - 1)) in Hs.
        symmetry. apply Near. replace (s - 1) with ((s - t) + (t - 1)) by ring. pose proof (Rabs_triang (s - t) (t - 1)). lra. }
      apply is_derive_unique in Dt. rewrite <- Dt. symmetry. apply is_derive_unique, X. lra. }
    assert (Pm : 0 < Rmin d (1 / 2)) by (apply Rmin_pos; lra).
    assert (U1 : x 1 = y /\ u 1 = w) by (apply Near; rewrite Rminus_diag_eq, Rabs_R0 by ring; exact Pd).
    assert (D' : is_derive v 1 0).
    { apply (is_derive_ext_loc (fun _ => 0)); [|exact (is_derive_const 0 1)].
      exists (mkposreal _ Pm). intros s Hs. symmetry. apply V0. exact Hs. }
    assert (D'' : is_derive v 1 ((u 1 + delta - drag beta_1 beta_2 (v 1)) / alpha)).
    { apply N; [lra|]. revert Loc. apply filter_imp. intros s [_ ->]. symmetry. apply U1. }
    apply is_derive_unique in D'. apply is_derive_unique in D''. rewrite D' in D''.
    rewrite (V0 1) in D'' by (rewrite Rminus_diag_eq, Rabs_R0 by ring; exact Pm). rewrite drag_0, (proj2 U1) in D''.
    assert (w + delta = 0); [|destruct Hw; lra]. apply (f_equal (fun z => z * alpha)) in D''. field_simplify in D''; lra. }
  destruct (stuck 1 ltac:(lra)) as [[U1 X1]|[U1 X1]].
  - destruct (stays_above x 1 0 (continuity_of_derive x 1 _ (X 1 ltac:(lra))) ltac:(lra)) as [d [Pd Hd]].
    apply (rest x_a C (or_introl eq_refl) (Rmin d (1 / 2))); [apply Rmin_pos; lra|]. intros t Ht.
    pose proof (Rmin_l d (1 / 2)). pose proof (Rmin_r d (1 / 2)). pose proof (Rabs_def2 _ _ Ht). specialize (Hd t ltac:(lra)).
    destruct (stuck t ltac:(lra)) as [[Q1 Q2]|[Q1 Q2]]; [split; assumption|lra].
  - destruct (stays_below x 1 0 (continuity_of_derive x 1 _ (X 1 ltac:(lra))) ltac:(lra)) as [d [Pd Hd]].
    apply (rest (- x_a) (- C) (or_intror eq_refl) (Rmin d (1 / 2))); [apply Rmin_pos; lra|]. intros t Ht.
    pose proof (Rmin_l d (1 / 2)). pose proof (Rmin_r d (1 / 2)). pose proof (Rabs_def2 _ _ Ht). specialize (Hd t ltac:(lra)).
    destruct (stuck t ltac:(lra)) as [[Q1 Q2]|[Q1 Q2]]; [lra|split; assumption].
Qed.

Lemma passes_top delta x v u : loop delta x v u -> Rabs delta < C -> exists b V, top x v u b V.
Proof.
  intros M D. pose proof (Rabs_def2 _ _ D) as [D1 D2]. pose proof (mirror _ _ _ _ _ _ _ _ _ M) as M'.
  assert (second : forall a, 0 < a -> commanded (fun t => - x t) (fun t => - u t) a -> exists b V, top x v u b V).
  { intros a a0 Com. destruct (next_passage (- delta) _ _ _ a M' ltac:(lra) a0 Com) as [b [ab [_ [Xb [Vb Com']]]]].
    rewrite !twice in Com'. exists b, (v b). unfold top. split; [lra|]. split; [lra|]. split; [reflexivity|]. split; [lra|exact Com']. }
  destruct (begins delta x v u M D) as [a [a0 [Com|Com]]]; [|exact (second a a0 Com)].
  destruct (next_passage delta x v u a M D1 a0 Com) as [b [ab [_ [_ [_ Com']]]]]. exact (second b ltac:(lra) Com').
Qed.
End Loop.
