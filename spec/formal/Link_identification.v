(** The program's formulas from oscillation to parameters, and those of thrusters and allocation, are the ones that the claims of
    groups A and D speak of: a formula that changes in the program breaks a proof here. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels Catalogue Claim_describing_function.
From Selfosc Require Common Claim_allocation Claim_delay_rotation Claim_first_harmonic_equations Claim_linear_drag Claim_quadratic_drag
  Claim_quantisation_alpha Claim_quantisation_beta Claim_quantisation_beta_xx Claim_relative_spread Claim_relay_f0 Claim_relay_p
  Claim_relay_q Claim_second_quadrant Claim_sine_abs_sine Claim_switching_condition Claim_table_3 Claim_thruster_bilinear Formulas.
Open Scope R_scope.

(** Tuples component by component. *)
Ltac components := repeat match goal with |- (_, _) = (_, _) => apply (f_equal2 (@pair _ _)) end.

(** The describing function that the program computes of the relay with hysteresis: the sum over the kernels that it lists. *)
Definition of_relay (scale C x_a d x_0 X : R) : df := sum_df scale x_0 X (Formulas.relay_hysteresis C x_a d x_0 X).

Lemma of_relay_is scale C x_a d x_0 X : 0 <= x_a -> 0 < X -> 0 < scale -> x_a + Rabs x_0 <= X ->
  of_relay scale C x_a d x_0 X =
    {| f0 := C / PI * (asin ((x_a + x_0) / X) - asin ((x_a - x_0) / X)) + d;
       p := 2 * C / (PI * X) * (sqrt (1 - ((x_a - x_0) / X) ^ 2) + sqrt (1 - ((x_a + x_0) / X) ^ 2));
       q := - (4 * C * x_a / (PI * X ^ 2)) |}.
Proof.
  intros Ha HX Hs H. pose proof (relay_holds C x_a x_0 X d Ha HX H) as D.
  pose proof (described_by_kernels _ scale _ _ _ HX Hs (relay_hysteresis_is_sum x_0 X C x_a d)) as E.
  change (of_relay scale C x_a d x_0 X) with (sum_df scale x_0 X (relay_hysteresis_kernels C x_a d)).
  exact (proj2 (proj2 (proj2 (proj2 (definition_holds _ _ X _ HX D)))) _ E).
Qed.

(** relay-p, relay-q, relay-f0, second-quadrant. *)
Theorem formula_relay : forall scale C x_a d x_0 X, 0 <= x_a -> 0 < X -> 0 < scale -> x_a + Rabs x_0 <= X ->
  let found := of_relay scale C x_a d x_0 X in
  p found = Claim_relay_p.P_N C x_a x_0 X /\ q found = Claim_relay_q.Q_N C x_a X /\ f0 found = Claim_relay_f0.F_0 C x_a x_0 X + d.
Proof.
  intros. unfold found. rewrite of_relay_is by assumption. pose proof PI_RGT_0.
  unfold Claim_relay_p.P_N, Claim_relay_q.Q_N, Claim_relay_f0.F_0. cbn [p q f0]. repeat split. field. lra.
Qed.

Theorem formula_relay_f0 : forall C t_high t_low, Formulas.relay_f0_by_times C t_high t_low = Claim_relay_f0.F_0_of_times C t_high t_low.
Proof. reflexivity. Qed.

(** switching-condition: the amplitude is at least the program's least one. *)
Theorem formula_switching_condition : forall x_a x_0 X, 0 < X ->
  (Formulas.condition_40_least_amplitude x_a x_0 <= X <-> Claim_switching_condition.condition_40 x_a x_0 X).
Proof.
  intros x_a x_0 X HX. unfold Formulas.condition_40_least_amplitude, Claim_switching_condition.condition_40. split; intros H.
  - apply (Rmult_le_reg_r X); trivial. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
  - apply (Rmult_le_compat_r X) in H; [|lra]. unfold Rdiv in H. rewrite Rmult_assoc, Rinv_l in H; lra.
Qed.

(** linear-drag, quadratic-drag; sine-abs-sine by its constant. *)
Theorem formula_drag : forall F_0 P Q X w, 0 < X -> 0 < w ->
  Formulas.table_3 F_0 P Q X w =
    (Claim_linear_drag.identified_alpha P w, Claim_linear_drag.identified_beta Q w, Claim_quadratic_drag.identified_beta_xx Q X w, F_0) /\
  snd (fst (Formulas.table_3 F_0 P Q X w)) = - Q / (Claim_sine_abs_sine.coefficient 1 * X * w ^ 2).
Proof.
  intros F_0 P Q X w HX Hw. pose proof PI_RGT_0.
  unfold Formulas.table_3, Claim_linear_drag.identified_alpha, Claim_linear_drag.identified_beta, Claim_quadratic_drag.identified_beta_xx,
    Claim_sine_abs_sine.coefficient. cbn [fst snd]. split; [components|]; trivial; simpl INR; field; lra.
Qed.

(** first-harmonic-equations: what the left side of eqs. 24 and 25 is made of, is given back. *)
Theorem formula_first_harmonic : forall alpha beta_1 beta_2 X w F_0, 0 < X -> 0 < w ->
  let given_back b_1 b_2 := Formulas.table_3 F_0 (- Claim_first_harmonic_equations.f_R alpha w)
    (- Claim_first_harmonic_equations.f_I b_1 b_2 X w) X w in
  fst (fst (fst (given_back beta_1 beta_2))) = alpha /\ snd (fst (fst (given_back beta_1 0))) = beta_1 /\
  snd (fst (given_back 0 beta_2)) = beta_2.
Proof.
  intros alpha beta_1 beta_2 X w F_0 HX Hw. pose proof PI_RGT_0. cbv zeta.
  unfold Formulas.table_3, Claim_first_harmonic_equations.f_R, Claim_first_harmonic_equations.f_I. cbn [fst snd].
  repeat split; field; lra.
Qed.

(** table-3: the parameters that the program makes of the relay's describing function. *)
Theorem formula_table_3 : forall scale C x_a x_0 X w, 0 <= x_a -> 0 < X -> 0 < w -> 0 < scale -> x_a + Rabs x_0 <= X ->
  let found := of_relay scale C x_a 0 x_0 X in
  Formulas.table_3 (f0 found) (p found) (q found) X w =
    (Claim_table_3.alpha C x_a x_0 X w, Claim_table_3.beta C x_a X w, Claim_table_3.beta_xx C x_a X w, Claim_table_3.delta C x_a x_0 X).
Proof.
  intros. unfold found. rewrite of_relay_is by assumption. pose proof PI_RGT_0. cbn [p q f0].
  unfold Formulas.table_3, Claim_table_3.alpha, Claim_table_3.beta, Claim_table_3.beta_xx, Claim_table_3.delta.
  replace ((x_0 - x_a) ^ 2 / X ^ 2) with (((x_a - x_0) / X) ^ 2) by (field; lra).
  replace ((x_0 + x_a) ^ 2 / X ^ 2) with (((x_a + x_0) / X) ^ 2) by (field; lra).
  components; field; lra.
Qed.

(** delay-rotation. *)
Theorem formula_delay_rotation : forall F_0 P Q phase,
  Formulas.delay_rotation F_0 P Q phase = (F_0, fst (Claim_delay_rotation.delayed (P, Q) phase), snd (Claim_delay_rotation.delayed (P, Q) phase)).
Proof. intros. unfold Formulas.delay_rotation, Claim_delay_rotation.delayed. cbn [fst snd]. components; ring. Qed.

(** quantisation-alpha, -beta, -beta-xx, -zero. *)
Theorem formula_quantisation : forall r, Formulas.quantisation r =
  (Claim_quantisation_alpha.sensitivity_alpha r, Claim_quantisation_beta.sensitivity_beta, Claim_quantisation_beta_xx.sensitivity_beta_xx).
Proof. reflexivity. Qed.

(** relative-spread. *)
Theorem formula_relative_spread : forall v_1 v_2, Formulas.relative_spread v_1 v_2 = Claim_relative_spread.relative_spread_percent v_1 v_2.
Proof. intros. unfold Formulas.relative_spread, Claim_relative_spread.relative_spread_percent. ring. Qed.

(** thruster-bilinear: thrust and torque. *)
Theorem formula_thruster_bilinear : forall by_rate by_speed n u_a,
  Formulas.thruster_bilinear by_rate by_speed n u_a = Claim_thruster_bilinear.bilinear by_rate by_speed n u_a.
Proof. intros. unfold Formulas.thruster_bilinear, Claim_thruster_bilinear.bilinear. ring. Qed.

(** allocation, and with it compensation. *)
Theorem formula_allocation : forall d tau f, 0 < d ->
  Formulas.allocation_forces d (fst tau) (snd tau) = Claim_allocation.forces d tau /\
  Formulas.allocation_thrusts d (fst f) (snd f) = Claim_allocation.thrusts d f.
Proof.
  intros d tau f Hd. unfold Formulas.allocation_forces, Formulas.allocation_thrusts, Claim_allocation.forces, Claim_allocation.thrusts.
  cbn [fst snd]. split; components; (ring || (field; lra)).
Qed.
