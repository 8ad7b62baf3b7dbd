(** The program's formulas of exact orbits, and those that its certificates show to be positive, are the ones that the claims of group C
    speak of. Near zero [z - tanh z] and [x - ln (1 + x)] are computed by truncated series: of these only the other side is an equation. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Hyperbolic.
From Selfosc Require Claim_orbit_linear Claim_orbit_quadratic Claim_orbit_multiplier Formulas.
Open Scope R_scope.

(** orbit-multiplier: the return map's slope. *)
Theorem formula_return_slope : forall mu d_1 d_2, Formulas.return_slope mu d_1 d_2 =
  (Claim_orbit_multiplier.numerator mu d_1 d_2, Claim_orbit_multiplier.denominator mu d_1 d_2).
Proof. reflexivity. Qed.

(** What its certificate shows: the excess of the denominator less 1.99 times the drag forces is a hundredth of them; the rate. *)
Theorem formula_excess : forall mu d_1 d_2,
  Formulas.orbit_multiplier_excess_first mu d_1 d_2
    = Claim_orbit_multiplier.denominator mu d_1 d_2 - Claim_orbit_multiplier.numerator mu d_1 d_2 - 199 / 100 * (d_1 + d_2) /\
  Formulas.orbit_multiplier_excess_first mu d_1 d_2 = 1 / 100 * (d_1 + d_2) /\
  Formulas.orbit_multiplier_excess_second mu d_1 d_2 = Formulas.orbit_multiplier_excess_first mu d_1 d_2.
Proof.
  intros. unfold Formulas.orbit_multiplier_excess_first, Formulas.orbit_multiplier_excess_second, Claim_orbit_multiplier.numerator,
    Claim_orbit_multiplier.denominator. repeat split; field.
Qed.
Theorem certificate_denominator : forall mu s_1 s_2, -1 <= mu <= 1 -> 0 <= s_1 <= 1 -> 0 <= s_2 <= 1 ->
  0 < Formulas.orbit_multiplier_denominator mu s_1 s_2.
Proof. intros mu s_1 s_2 M S1 S2. unfold Formulas.orbit_multiplier_denominator. 
  assert (a : 0 <= 1 - mu + s_1 + mu * s_1 <= 2) by nra. assert (b : 0 <= 1 + mu + s_2 - mu * s_2 <= 2) by nra.
  pose proof (Rmult_le_compat _ _ _ _ (proj1 a) (proj1 b) (proj2 a) (proj2 b)). lra.
Qed.
(** Drag leaves force below the terminal speed, and none at it. *)
Theorem certificate_force : forall speed share, 0 <= speed -> 0 <= share <= 1 ->
  (speed < 1 -> 0 < Formulas.orbit_linear_force_slow speed share 0) /\ (speed = 1 -> Formulas.orbit_linear_force_slow speed share 0 = 0) /\
  Formulas.orbit_linear_force_fast speed share 0 = - Formulas.orbit_linear_force_slow speed share 0.
Proof.
  intros speed share S H. unfold Formulas.orbit_linear_force_slow, Formulas.orbit_linear_force_fast. repeat split.
  - intros L. replace (1 - share * speed - speed ^ 2 + share * speed ^ 2) with ((1 - speed) * (1 + speed - share * speed)) by ring.
    apply Rmult_lt_0_compat; nra.
  - intros ->. ring.
  - ring.
Qed.

(** orbit-linear: the root's left side. *)
Theorem formula_linear_half_width : forall z, (1 < z -> Formulas.linear_half_width z = z - tanh z) /\
  Formulas.orbit_linear_linear_width_short z 0 0 = z - tanh z /\ Formulas.orbit_linear_linear_width_long z 0 0 = z - tanh z.
Proof.
  intros z. unfold Formulas.linear_half_width. repeat split. intros H. destruct (Rlt_dec 0 (z - 1)); [reflexivity|lra].
Qed.

(** orbit-quadratic: the period. *)
Theorem formula_quadratic_period : forall alpha beta C x_a, 0 < alpha -> 0 < beta -> 0 < C -> 0 < x_a ->
  let g := Claim_orbit_quadratic.g alpha beta x_a in
  Claim_orbit_quadratic.T alpha beta C (Claim_orbit_quadratic.y g) = 2 * (alpha / sqrt (beta * C)) * Formulas.quadratic_period g.
Proof.
  intros alpha beta C x_a Ha Hb HC Hx g. unfold Claim_orbit_quadratic.T. f_equal. unfold Formulas.quadratic_period.
  assert (Hg : 0 < g) by (unfold g, Claim_orbit_quadratic.g; apply Rdiv_lt_0_compat; nra).
  destruct (Claim_orbit_quadratic.y_range g Hg) as [Y E]. unfold Claim_orbit_quadratic.y in *.
  replace (- (exp (-4 * g) - 1)) with (1 - exp (- (4 * g))) by (replace (-4 * g) with (- (4 * g)) by ring; ring).
  set (y := sqrt (1 - exp (- (4 * g)))) in *.
  assert (root : 0 < sqrt y < 1).
  { split; [now apply sqrt_lt_R0|]. rewrite <- sqrt_1. apply sqrt_lt_1_alt. lra. }
  assert (square : sqrt y * sqrt y = y) by (apply sqrt_sqrt; lra).
  unfold atanh. destruct (Rlt_dec 0 ((10 * g - 1) / 10)) as [L|L]; [|reflexivity]. f_equal.
  (* 1 - y = exp(-4 g)/(1 + y) *)
  assert (K : ln ((1 + sqrt y) / (1 - sqrt y)) = 2 * ln (1 + sqrt y) + 4 * g + ln (1 + y)).
  { replace ((1 + sqrt y) / (1 - sqrt y)) with ((1 + sqrt y) * (1 + sqrt y) * (exp (4 * g) * (1 + y))).
    - rewrite !ln_mult, ln_exp by (try apply Rmult_lt_0_compat; try apply exp_pos; lra). ring.
    - assert (X : exp (4 * g) * exp (- (4 * g)) = 1) by (rewrite <- exp_plus, Rplus_opp_r; apply exp_0).
      assert (Z : exp (4 * g) * (1 + y) * (1 - y) = 1) by (replace (exp (4 * g) * (1 + y) * (1 - y)) with (exp (4 * g) * (1 - y * y)) by ring; rewrite E; lra).
      apply (Rmult_eq_reg_r (1 - sqrt y)); [|lra]. unfold Rdiv. rewrite Rmult_assoc with (r2 := / (1 - sqrt y)), Rinv_l, Rmult_1_r by lra.
      transitivity ((1 + sqrt y) * (exp (4 * g) * (1 + y) * (1 - sqrt y * sqrt y))); [ring|]. rewrite square, Z. ring. }
  rewrite K. field.
Qed.

