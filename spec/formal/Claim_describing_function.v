(** describing-function (eqs. 12 to 15). [P = Y_P1/X_m], [Q = Y_Q1/X_m], [F_0 = Y_0]: the gain that takes the input's one tone to
    the output's first harmonic, and the mean. Every member of the piecewise-linear catalogue is a sum of kernels, and its
    describing function is the sum of theirs, for all parameters and every sweep. *)
From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels Catalogue.
Import ListNotations.
Open Scope R_scope.

(** What a describing function says: with [x = X sin(w t)] the first harmonic is [P x + (Q/w) x']; and there is only one. *)
Definition definition : Prop := forall (c : characteristic) (B X : R) (d : df), 0 < X -> describes c B X d ->
  let y := output c B X in
  mean y = f0 d /\ sine_part 1 y / X = p d /\ cosine_part 1 y / X = q d /\
  (forall w t, 0 < w -> let x := fun t => X * sin (w * t) in
     sine_part 1 y * sin (w * t) + cosine_part 1 y * cos (w * t) = p d * x t + q d / w * Derive x t) /\
  (forall e, describes c B X e -> e = d).

(** Any number of kernels. *)
Definition linearity : Prop := forall (scale B X : R) (ks : list kernel), 0 < X -> 0 < scale -> List.Forall well_formed ks ->
  describes (sum_shape ks) B X (sum_df scale B X ks).

(** The catalogue. *)
Definition members : Prop := forall scale B X : R, 0 < X -> 0 < scale ->
  let given_by (c : characteristic) (ks : list kernel) := describes c B X (sum_df scale B X ks) in
  (forall level, given_by (relay level) (relay_kernels level)) /\
  (forall level dead_zone, 0 <= dead_zone ->
     given_by (relay_dead_zone level dead_zone) (relay_dead_zone_kernels level dead_zone)) /\
  (forall level half_width offset,
     given_by (relay_hysteresis level half_width offset) (relay_hysteresis_kernels level half_width offset)) /\
  (forall level on_ off,
     given_by (relay_dead_zone_hysteresis level on_ off B X) (relay_dead_zone_hysteresis_kernels level on_ off B X)) /\
  (forall slope breakpoint, 0 <= breakpoint ->
     given_by (saturation slope breakpoint) (saturation_kernels slope (- breakpoint) breakpoint)) /\
  (forall slope lower upper, lower <= upper ->
     given_by (saturation_asymmetric slope lower upper) (saturation_kernels slope lower upper)) /\
  (forall slope half_width, 0 <= half_width -> given_by (dead_zone slope half_width) (crossing half_width slope)) /\
  (forall slope inner outer, 0 <= inner <= outer ->
     given_by (dead_zone_saturation slope inner outer) (dead_zone_saturation_kernels slope inner outer)) /\
  (forall inner outer breakpoint, 0 <= breakpoint ->
     given_by (gain_changing inner outer breakpoint) (gain_changing_kernels_1 inner outer breakpoint) /\
     given_by (gain_changing inner outer breakpoint) (gain_changing_kernels_2 inner outer breakpoint) /\
     given_by (gain_changing inner outer breakpoint) (gain_changing_kernels_3 inner outer breakpoint)) /\
  (forall slope level, given_by (preload slope level) (preload_kernels slope level)) /\
  (forall tread above below, 0 < tread -> (B + X) / tread < INR above + 1 / 2 -> - (B - X) / tread < INR below + 1 / 2 ->
     given_by (quantizer tread) (quantizer_kernels tread above below)) /\
  (forall gain, given_by (absolute gain) (absolute_kernels gain)) /\
  (forall left_slope right_slope anchor first rest, ascends first rest -> (anchor <= length rest)%nat ->
     given_by (polyline left_slope right_slope first rest) (polyline_kernels left_slope right_slope anchor first rest)) /\
  (forall slope half_gap, given_by (backlash slope half_gap B X) (backlash_kernels slope half_gap B X)).

(** The relay with hysteresis of eqs. 30 to 32, from the least amplitude that switches both ways on, that amplitude included. *)
Definition relay_at_every_amplitude : Prop := forall C x_a x_0 X d : R, 0 <= x_a -> 0 < X -> x_a + Rabs x_0 <= X ->
  describes (relay_hysteresis C x_a d) x_0 X
    {| f0 := C / PI * (asin ((x_a + x_0) / X) - asin ((x_a - x_0) / X)) + d;
       p := 2 * C / (PI * X) * (sqrt (1 - ((x_a - x_0) / X) ^ 2) + sqrt (1 - ((x_a + x_0) / X) ^ 2));
       q := - (4 * C * x_a / (PI * X ^ 2)) |}.

Lemma definition_holds : definition.
Proof.
  intros c B X d HX D y. pose proof PI_RGT_0. pose proof D as [D1 [D2 D3]].
  assert (M : mean y = f0 d) by (unfold mean, y; rewrite (RInt_of _ _ _ _ D1); field; lra).
  assert (S : sine_part 1 y = X * p d).
  { unfold sine_part. rewrite (RInt_ext _ (fun t => output c B X t * sin t)).
    - rewrite (RInt_of _ _ _ _ D2). field. lra.
    - intros t _. simpl. now rewrite Rmult_1_l. }
  assert (C : cosine_part 1 y = X * q d).
  { unfold cosine_part. rewrite (RInt_ext _ (fun t => output c B X t * cos t)).
    - rewrite (RInt_of _ _ _ _ D3). field. lra.
    - intros t _. simpl. now rewrite Rmult_1_l. }
  rewrite S, C. repeat split; [exact M|field; lra|field; lra| |].
  - intros w t Hw. cbv zeta. replace (Derive (fun t => X * sin (w * t)) t) with (X * (w * cos (w * t))).
    + field. lra.
    + symmetry. apply is_derive_unique. auto_derive; [trivial|ring].
  - intros e [E1 [E2 E3]]. apply df_eq.
    + apply (Rmult_eq_reg_l (2 * PI)); [|lra]. now rewrite <- (RInt_of _ _ _ _ E1), <- (RInt_of _ _ _ _ D1).
    + apply (Rmult_eq_reg_l (PI * X)); [now rewrite <- (RInt_of _ _ _ _ E2), <- (RInt_of _ _ _ _ D2)|].
      apply Rmult_integral_contrapositive; lra.
    + apply (Rmult_eq_reg_l (PI * X)); [now rewrite <- (RInt_of _ _ _ _ E3), <- (RInt_of _ _ _ _ D3)|].
      apply Rmult_integral_contrapositive; lra.
Qed.

Lemma members_hold : members.
Proof.
  intros scale B X HX Hs given_by.
  assert (G : forall c ks, is_sum c B X ks -> given_by c ks) by (intros; now apply described_by_kernels).
  repeat match goal with |- _ /\ _ => split end; intros; repeat match goal with |- _ /\ _ => split end; apply G;
    auto using relay_is_sum, relay_dead_zone_is_sum, relay_hysteresis_is_sum, relay_dead_zone_hysteresis_is_sum,
      saturation_is_sum, dead_zone_is_sum, preload_is_sum, absolute_is_sum, backlash_is_sum, quantizer_is_sum, polyline_is_sum.
  - apply saturation_is_sum; lra.
  - apply dead_zone_saturation_is_sum; lra.
  - now apply gain_changing_is_sum.
  - now apply gain_changing_is_sum.
  - now apply gain_changing_is_sum.
Qed.

Lemma relay_holds : relay_at_every_amplitude.
Proof.
  intros C x_a x_0 X d Ha HX H. pose proof PI_RGT_0.
  assert (A : - Rabs x_0 <= x_0 <= Rabs x_0) by (unfold Rabs; destruct (Rcase_abs x_0); lra).
  assert (within : forall z, - X <= z <= X -> -1 <= z / X <= 1).
  { intros z Hz. split; apply (Rmult_le_reg_r X); trivial; unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra; lra. }
  pose proof (within (x_a - x_0) ltac:(lra)) as U. pose proof (within (x_a + x_0) ltac:(lra)) as V.
  pose proof (described_by_kernels _ 1 _ _ _ HX Rlt_0_1 (relay_hysteresis_is_sum x_0 X C x_a d)) as D.
  match goal with |- describes _ _ _ ?e => replace e with (sum_df 1 x_0 X (relay_hysteresis_kernels C x_a d)); [exact D|] end.
  cbn [relay_hysteresis_kernels sum_df fold_right df_of].
  assert (R1 : ratio x_a x_0 X = (x_a - x_0) / X) by (unfold ratio; now rewrite Rmin_left, Rmax_right by lra).
  assert (R2 : ratio (- x_a) x_0 X = - ((x_a + x_0) / X)).
  { unfold ratio. replace ((- x_a - x_0) / X) with (- ((x_a + x_0) / X)) by (field; lra). now rewrite Rmin_left, Rmax_right by lra. }
  rewrite R1, R2. unfold sign_df, constant_df, sine, flat.
  apply df_eq; cbn [f0 p q df_plus df_times on_df].
  - rewrite asin_opp. field. lra.
  - replace ((1 - (x_a - x_0) / X) * (1 + (x_a - x_0) / X)) with (1 - ((x_a - x_0) / X) ^ 2) by ring.
    replace ((1 - - ((x_a + x_0) / X)) * (1 + - ((x_a + x_0) / X))) with (1 - ((x_a + x_0) / X) ^ 2) by ring.
    field. lra.
  - field. lra.
Qed.

Theorem statement : definition /\ linearity /\ members /\ relay_at_every_amplitude.
Proof.
  repeat match goal with |- _ /\ _ => split end.
  - exact definition_holds.
  - intros scale B X ks. apply sum_described.
  - exact members_hold.
  - exact relay_holds.
Qed.
Print Assumptions statement.
