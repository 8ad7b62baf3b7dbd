(** claim: method-bias (of this project)
    The paper's method takes the orbit for a sinusoid. On symmetric orbits without delay its relative errors of alpha and of the drag
    coefficient are functions of one number: [g = x_a beta^2/(C alpha)] for linear drag, [g = x_a beta/alpha] for quadratic drag. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Hyperbolic Cycle.
From Selfosc Require Claim_orbit_linear Claim_orbit_quadratic Claim_table_3.
Open Scope R_scope.

(** Frequency of a period. *)
Definition frequency (T : R) : R := 2 * PI / T.
(** The relative error of an estimate. *)
Definition error (estimate truth : R) : R := estimate / truth - 1.

(** * Linear drag, with [z - tanh z = g] *)

(** The amplitude is [ln (cosh z)], written so, in units of [C alpha/beta^2]. *)
Definition size_linear (z : R) : R := z - ln (1 + tanh z).
Definition error_alpha_linear (z : R) : R :=
  16 * z ^ 2 / (PI ^ 3 * size_linear z) * sqrt (1 - ((z - tanh z) / size_linear z) ^ 2) - 1.
Definition error_beta_linear (z : R) : R := 8 * z * (z - tanh z) / (PI ^ 2 * size_linear z ^ 2) - 1.

Lemma sqrt_scaled r x : 0 < r -> 0 <= x -> sqrt (r ^ 2 * x) = r * sqrt x.
Proof. intros Hr Hx. rewrite sqrt_mult by nra. f_equal. rewrite <- Rsqr_pow2. apply sqrt_Rsqr. lra. Qed.

(** What is left of Table 3's alpha without bias. *)
Lemma alpha_unbiased C x_a X w : 0 < X -> Claim_table_3.alpha C x_a 0 X w = 4 * C * sqrt (1 - (x_a / X) ^ 2) / (PI * X * w ^ 2).
Proof.
  intros HX. unfold Claim_table_3.alpha. replace ((0 - x_a) ^ 2 / X ^ 2) with ((x_a / X) ^ 2) by (field; lra).
  replace ((0 + x_a) ^ 2 / X ^ 2) with ((x_a / X) ^ 2) by (field; lra). unfold Rdiv. ring.
Qed.

Lemma size_linear_positive z : 0 < z -> 0 < size_linear z.
Proof.
  intros Hz. pose proof (tanh_range z Hz) as [T0 T1]. unfold size_linear.
  assert (L : ln (1 + tanh z) <= tanh z).
  { assert (E : 1 + tanh z <= exp (tanh z)) by (left; apply exp_ineq1; lra). apply Rle_trans with (ln (exp (tanh z))); [|rewrite ln_exp; lra].
    destruct E as [E|E]; [left; apply ln_increasing; lra|rewrite <- E; lra]. }
  pose proof (Claim_orbit_linear.root_increases 0 z (Rle_refl 0) Hz) as R0. rewrite tanh_0 in R0. lra.
Qed.

(** * Quadratic drag, with y of the orbit *)

Definition amplitude_quadratic (g : R) : R := g + ln (1 + Claim_orbit_quadratic.y g) / 2.
Definition turn_quadratic (g : R) : R := let y := Claim_orbit_quadratic.y g in atan (sqrt y) + atanh (sqrt y).
Definition error_alpha_quadratic (g : R) : R :=
  4 * turn_quadratic g ^ 2 / (PI ^ 3 * amplitude_quadratic g) * sqrt (1 - (g / amplitude_quadratic g) ^ 2) - 1.
Definition error_beta_quadratic (g : R) : R := 3 * g * turn_quadratic g ^ 2 / (2 * PI ^ 2 * amplitude_quadratic g ^ 3) - 1.

Lemma amplitude_quadratic_positive g : 0 < g -> g < amplitude_quadratic g.
Proof.
  intros G. destruct (Claim_orbit_quadratic.y_range g G) as [[Y0 Y1] _]. unfold amplitude_quadratic.
  assert (0 < ln (1 + Claim_orbit_quadratic.y g)) by (rewrite <- ln_1; apply ln_increasing; lra). lra.
Qed.

Lemma turn_quadratic_positive g : 0 < g -> 0 < turn_quadratic g.
Proof.
  intros G. destruct (Claim_orbit_quadratic.y_range g G) as [[Y0 Y1] _]. unfold turn_quadratic.
  assert (S0 : 0 < sqrt (Claim_orbit_quadratic.y g)) by (apply sqrt_lt_R0, Y0).
  assert (S1 : sqrt (Claim_orbit_quadratic.y g) < 1) by (rewrite <- sqrt_1; apply sqrt_lt_1; lra).
  pose proof (atanh_positive (sqrt (Claim_orbit_quadratic.y g)) ltac:(lra)).
  pose proof (atan_increasing 0 _ S0) as A. rewrite atan_0 in A. lra.
Qed.

Theorem statement :
  (* linear drag: z is determined by g, so both errors are functions of g alone *)
  (forall alpha beta C x_a z, 0 < alpha -> 0 < beta -> 0 < C -> 0 < x_a -> 0 < z -> z - tanh z = Claim_orbit_linear.g alpha beta C x_a ->
    let X := Claim_orbit_linear.X_m alpha beta C x_a z in let w := frequency (Claim_orbit_linear.T alpha beta z) in
    error (Claim_table_3.alpha C x_a 0 X w) alpha = error_alpha_linear z /\ error (Claim_table_3.beta C x_a X w) beta = error_beta_linear z) /\
  (* quadratic drag *)
  (forall alpha beta C x_a, 0 < alpha -> 0 < beta -> 0 < C -> 0 < x_a ->
    let g := Claim_orbit_quadratic.g alpha beta x_a in let y := Claim_orbit_quadratic.y g in
    let X := Claim_orbit_quadratic.X_m alpha beta x_a y in let w := frequency (Claim_orbit_quadratic.T alpha beta C y) in
    error (Claim_table_3.alpha C x_a 0 X w) alpha = error_alpha_quadratic g /\ error (Claim_table_3.beta_xx C x_a X w) beta = error_beta_quadratic g).
Proof.
  pose proof PI_RGT_0 as HPI. split.
  - intros alpha beta C x_a z Ha Hb HC Hx Hz E X w. pose proof (size_linear_positive z Hz) as S0.
    assert (Xa : x_a = C * alpha / beta ^ 2 * (z - tanh z)) by (rewrite E; unfold Claim_orbit_linear.g; field; lra).
    assert (EX : X = C * alpha / beta ^ 2 * size_linear z) by (unfold X, Claim_orbit_linear.X_m, size_linear; rewrite Xa; ring).
    assert (U : 0 < C * alpha / beta ^ 2) by (apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat; assumption|nra]).
    assert (X0 : 0 < X) by (rewrite EX; apply Rmult_lt_0_compat; assumption).
    assert (Q : x_a / X = (z - tanh z) / size_linear z) by (rewrite EX, Xa; field; repeat split; lra).
    unfold error, w, frequency, Claim_orbit_linear.T. split.
    + rewrite alpha_unbiased by exact X0. rewrite Q, EX. unfold error_alpha_linear. set (q := sqrt _). field. repeat split; lra.
    + unfold Claim_table_3.beta. rewrite EX, Xa. unfold error_beta_linear. field. repeat split; lra.
  - intros alpha beta C x_a Ha Hb HC Hx g y X w. assert (G0 : 0 < g) by (unfold g, Claim_orbit_quadratic.g; apply Rdiv_lt_0_compat; nra).
    pose proof (amplitude_quadratic_positive g G0) as A0. pose proof (turn_quadratic_positive g G0) as T0.
    assert (Xa : x_a = alpha / beta * g) by (unfold g, Claim_orbit_quadratic.g; field; lra).
    assert (EX : X = alpha / beta * amplitude_quadratic g) by (unfold X, Claim_orbit_quadratic.X_m, amplitude_quadratic; fold y; rewrite Xa at 1; field; lra).
    assert (U : 0 < alpha / beta) by (apply Rdiv_lt_0_compat; assumption).
    assert (X0 : 0 < X) by (rewrite EX; apply Rmult_lt_0_compat; lra).
    assert (Q : x_a / X = g / amplitude_quadratic g) by (rewrite EX, Xa at 1; field; repeat split; lra).
    assert (R0 : 0 < sqrt (beta * C)) by (apply sqrt_lt_R0, Rmult_lt_0_compat; assumption).
    assert (RR : sqrt (beta * C) ^ 2 = beta * C) by (replace (sqrt (beta * C) ^ 2) with (sqrt (beta * C) * sqrt (beta * C)) by ring; apply sqrt_sqrt; nra).
    assert (W : w ^ 2 = PI ^ 2 * (beta * C) / (alpha ^ 2 * turn_quadratic g ^ 2)).
    { rewrite <- RR. unfold w, frequency, Claim_orbit_quadratic.T. change (atan (sqrt y) + atanh (sqrt y)) with (turn_quadratic g). field. repeat split; lra. }
    unfold error. split.
    + rewrite alpha_unbiased by exact X0. rewrite Q, W, EX. unfold error_alpha_quadratic. set (q := sqrt _). field. repeat split; lra.
    + unfold Claim_table_3.beta_xx. rewrite W, EX, Xa at 1. unfold error_beta_quadratic. field. repeat split; lra.
Qed.

Print Assumptions statement.
