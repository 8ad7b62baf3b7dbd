(** The return map of a drag axis under a relay: down by the force c_1, up by the force c_2. It has one fixed pair of speeds, and every other
    speed comes nearer to it by a fixed rate. Shared by the orbits. *)
From Coq Require Import Reals Lra Lia Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Phase.
Open Scope R_scope.

Section Return.
Variables alpha beta_1 beta_2 c_1 c_2 x_a : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hb : 0 < beta_1 + beta_2) (Hc1 : 0 < c_1) (Hc2 : 0 < c_2) (Hx : 0 < x_a).

Local Notation down := (half alpha beta_1 beta_2 c_1 x_a).
Local Notation up := (half alpha beta_1 beta_2 c_2 x_a).
Local Notation force_1 := (force beta_1 beta_2 c_1).
Local Notation force_2 := (force beta_1 beta_2 c_2).

Lemma down_exists V : 0 <= V -> exists V', down V V'.
Proof. intros H. destruct (half_exists alpha beta_1 beta_2 c_1 Ha Hb1 Hb2 Hc1 x_a V Hx H) as [V' HV]. now exists V'. Qed.
Lemma up_exists V : 0 <= V -> exists V', up V V'.
Proof. intros H. destruct (half_exists alpha beta_1 beta_2 c_2 Ha Hb1 Hb2 Hc2 x_a V Hx H) as [V' HV]. now exists V'. Qed.
Let down_le := half_does_not_fall alpha beta_1 beta_2 c_1 Ha Hb1 Hb2 Hc1 x_a.
Let up_le := half_does_not_fall alpha beta_1 beta_2 c_2 Ha Hb1 Hb2 Hc2 x_a.

Lemma leaves c V V' : half alpha beta_1 beta_2 c x_a V V' -> 0 <= V /\ 0 < V'.
Proof. intros [A [B _]]. split; assumption. Qed.

(** The fixed pair, by order alone (Tarski): the least upper bound of the speeds that the return map does not lower. *)
Lemma fixed_pair : exists P Q, down P Q /\ up Q P.
Proof.
  destruct (terminal_speed beta_1 beta_2 Hb1 Hb2 c_2 Hc2 Hb) as [W Ew]. set (w := terminal beta_1 beta_2 c_2) in *.
  set (S := fun V => 0 <= V /\ exists V' V'', down V V' /\ up V' V'' /\ V <= V'').
  assert (Z : S 0).
  { split; [lra|]. destruct (down_exists 0 (Rle_refl 0)) as [A HA]. destruct (leaves _ _ _ HA) as [_ A0].
    destruct (up_exists A (Rlt_le _ _ A0)) as [B HB]. destruct (leaves _ _ _ HB). exists A, B. split; [exact HA|split; [exact HB|lra]]. }
  destruct (completeness S) as [P [P1 P2]].
  - exists w. intros V [V0 [V' [V'' [_ [HV L]]]]].
    pose proof (half_below_terminal alpha beta_1 beta_2 c_2 Hb1 Hb2 x_a V' V'' w HV Ew). lra.
  - now exists 0.
  - assert (P0 : 0 <= P) by exact (P1 0 Z).
    destruct (down_exists P P0) as [Q HQ]. destruct (leaves _ _ _ HQ) as [_ Q0].
    destruct (up_exists Q (Rlt_le _ _ Q0)) as [R HR]. destruct (leaves _ _ _ HR) as [_ R0].
    assert (PR : P <= R).
    { apply P2. intros V SV. pose proof (P1 V SV). destruct SV as [V0 [V' [V'' [HV [HV' L]]]]].
      pose proof (down_le V V' P Q HV HQ H). pose proof (up_le V' V'' Q R HV' HR H0). lra. }
    assert (RP : R <= P).
    { apply P1. split; [lra|]. destruct (down_exists R (Rlt_le _ _ R0)) as [S1 H1]. destruct (leaves _ _ _ H1) as [_ S10].
      destruct (up_exists S1 (Rlt_le _ _ S10)) as [S2 H2]. exists S1, S2. split; [exact H1|split; [exact H2|]].
      apply (up_le Q R S1 S2 HR H2), (down_le P Q R S1 HQ H1 PR). }
    exists P, Q. split; [exact HQ|]. replace P with R by lra. exact HR.
Qed.

(** No half ends slower than the half that begins at rest. *)
Lemma least_speed : exists m, 0 < m /\ 0 < force_1 (- m) /\ 0 < force_2 (- m) /\
  (forall V V', down V V' -> m <= V') /\ (forall V V', up V V' -> m <= V').
Proof.
  destruct (down_exists 0 (Rle_refl 0)) as [A HA]. destruct (up_exists 0 (Rle_refl 0)) as [B HB].
  exists (Rmin A B). pose proof (Rmin_l A B). pose proof (Rmin_r A B).
  split; [apply Rmin_pos; [apply (leaves _ _ _ HA)|apply (leaves _ _ _ HB)]|].
  split; [pose proof (force_le beta_1 beta_2 c_1 Hb1 Hb2 (- A) (- Rmin A B) ltac:(lra)); destruct HA as [_ [_ [? _]]]; lra|].
  split; [pose proof (force_le beta_1 beta_2 c_2 Hb1 Hb2 (- B) (- Rmin A B) ltac:(lra)); destruct HB as [_ [_ [? _]]]; lra|].
  split; intros V V' HV; [pose proof (down_le 0 A V V' HA HV (proj1 HV))|pose proof (up_le 0 B V V' HB HV (proj1 HV))]; lra.
Qed.

Lemma brakes c m : 0 < c -> 0 < m -> 0 < force beta_1 beta_2 c (- m) -> 0 < force beta_1 beta_2 c (- m) / force beta_1 beta_2 c m < 1.
Proof.
  intros Hc M F. assert (D := drag_pos beta_1 beta_2 Hb1 Hb2 m Hb M).
  assert (F' : force beta_1 beta_2 c (- m) < force beta_1 beta_2 c m) by (unfold force; rewrite drag_odd; lra).
  split; [apply Rdiv_lt_0_compat; lra|apply div_lt_one; lra].
Qed.

(** With a fixed pair P, Q: at a rate q below one every speed comes nearer, in either half. *)
Lemma rate P Q : down P Q -> up Q P -> exists m q, 0 < m /\ 0 < q < 1 /\
  (forall V V', down V V' -> m <= V') /\ (forall V V', up V V' -> m <= V') /\
  (forall V V', m <= V -> down V V' -> Rabs (V' ^ 2 - Q ^ 2) <= q * Rabs (V ^ 2 - P ^ 2)) /\
  (forall V V', m <= V -> up V V' -> Rabs (V' ^ 2 - P ^ 2) <= q * Rabs (V ^ 2 - Q ^ 2)).
Proof.
  intros HQ HP. destruct least_speed as [m [M [F1 [F2 [L1 L2]]]]].
  destruct (brakes c_1 m Hc1 M F1) as [B1 B1']. destruct (brakes c_2 m Hc2 M F2) as [B2 B2'].
  set (q_1 := force_1 (- m) / force_1 m) in *. set (q_2 := force_2 (- m) / force_2 m) in *.
  pose proof (force_of_speed beta_1 beta_2 c_1 Hb1 Hb2 m (Rlt_le _ _ M)) as G1.
  pose proof (force_of_speed beta_1 beta_2 c_2 Hb1 Hb2 m (Rlt_le _ _ M)) as G2.
  exists m, (Rmax q_1 q_2). pose proof (Rmax_l q_1 q_2). pose proof (Rmax_r q_1 q_2).
  split; [exact M|]. split; [split; [lra|apply Rmax_lub_lt; assumption]|]. split; [exact L1|]. split; [exact L2|].
  split; intros V V' MV HV.
  - pose proof (half_nears alpha beta_1 beta_2 c_1 Ha Hb1 Hb2 Hc1 x_a m V V' P Q HV HQ ltac:(lra) MV (L1 _ _ HV) (L2 _ _ HP) (L1 _ _ HQ)) as N.
    apply Rle_trans with (q_1 * Rabs (V ^ 2 - P ^ 2)); [|apply Rmult_le_compat_r; [apply Rabs_pos|assumption]].
    apply (Rmult_le_reg_r (force_1 m)); [lra|]. unfold q_1. replace (force_1 (- m) / force_1 m * Rabs (V ^ 2 - P ^ 2) * force_1 m)
      with (force_1 (- m) * Rabs (V ^ 2 - P ^ 2)) by (field; lra). exact N.
  - pose proof (half_nears alpha beta_1 beta_2 c_2 Ha Hb1 Hb2 Hc2 x_a m V V' Q P HV HP ltac:(lra) MV (L2 _ _ HV) (L1 _ _ HQ) (L2 _ _ HP)) as N.
    apply Rle_trans with (q_2 * Rabs (V ^ 2 - Q ^ 2)); [|apply Rmult_le_compat_r; [apply Rabs_pos|assumption]].
    apply (Rmult_le_reg_r (force_2 m)); [lra|]. unfold q_2. replace (force_2 (- m) / force_2 m * Rabs (V ^ 2 - Q ^ 2) * force_2 m)
      with (force_2 (- m) * Rabs (V ^ 2 - Q ^ 2)) by (field; lra). exact N.
Qed.

Lemma one_pair P Q P' Q' : down P Q -> up Q P -> down P' Q' -> up Q' P' -> P = P' /\ Q = Q'.
Proof.
  intros A B A' B'. destruct (rate P Q A B) as [m [q [M [Hq [L1 [L2 [N1 N2]]]]]]].
  pose proof (N1 P' Q' (L2 _ _ B') A') as R1. pose proof (N2 Q' P' (L1 _ _ A') B') as R2.
  pose proof (Rabs_pos (P' ^ 2 - P ^ 2)) as K1. pose proof (Rabs_pos (Q' ^ 2 - Q ^ 2)) as K2.
  assert (Z : Rabs (P' ^ 2 - P ^ 2) = 0) by nra.
  destruct (Req_dec (P' ^ 2 - P ^ 2) 0) as [E|E]; [|apply Rabs_no_R0 in E; contradiction].
  pose proof (L2 _ _ B). pose proof (L2 _ _ B'). assert (EP : P = P') by nra. split; [exact EP|].
  subst P'. exact (half_unique alpha beta_1 beta_2 c_1 Ha Hb1 Hb2 Hc1 x_a P Q Q' A A').
Qed.
End Return.
