(** claim: quantisation-zero (after eq. 37)
    At [X_m = sqrt(2) x_a] the error of alpha vanishes to first order, unbiased and without delay: the derivative of alpha by the amplitude is zero
    there, positive below and negative above. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Enclosure Claim_table_3 Claim_quantisation_alpha.
Open Scope R_scope.

Lemma alpha_positive : forall C x_a X w : R, 0 < C -> 0 < x_a -> 0 < w -> x_a < X -> 0 < alpha C x_a 0 X w.
Proof.
  intros C x_a X w HC Hxa Hw H. pose proof PI_RGT_0. destruct (ratio_above_one x_a X Hxa H) as [R0 _].
  unfold alpha. replace ((0 - x_a) ^ 2 / X ^ 2) with ((x_a / X) ^ 2) by (field; lra).
  replace ((0 + x_a) ^ 2 / X ^ 2) with ((x_a / X) ^ 2) by (field; lra).
  pose proof (sqrt_lt_R0 _ R0). apply Rdiv_lt_0_compat.
  - apply Rmult_lt_0_compat; lra.
  - apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat; lra|nra].
Qed.

Theorem statement : forall C x_a X w : R, 0 < C -> 0 < x_a -> 0 < w -> x_a < X ->
  exists slope : R, is_derive (fun A => alpha C x_a 0 A w) X slope /\
    (X < sqrt 2 * x_a -> 0 < slope) /\ (X = sqrt 2 * x_a -> slope = 0) /\ (sqrt 2 * x_a < X -> slope < 0).
Proof.
  intros C x_a X w HC Hxa Hw H.
  exists (sensitivity_alpha (X / x_a) * (alpha C x_a 0 X w / X)).
  split; [apply Claim_quantisation_alpha.statement; assumption|].
  assert (A : 0 < alpha C x_a 0 X w / X) by (apply Rdiv_lt_0_compat; [apply alpha_positive; assumption|lra]).
  assert (S : sqrt 2 * sqrt 2 = 2) by (apply sqrt_sqrt; lra). assert (S0 : 0 < sqrt 2) by (apply sqrt_lt_R0; lra).
  set (r := X / x_a). assert (E : X = r * x_a) by (unfold r; field; lra). assert (R1 : 1 < r) by nra.
  assert (D : 0 < / (r ^ 2 - 1)) by (apply Rinv_0_lt_compat; nra).
  unfold sensitivity_alpha, Rdiv. repeat split; intros B.
  - assert (r < sqrt 2) by nra. apply Rmult_lt_0_compat; [|exact A]. apply Rmult_lt_0_compat; [nra|exact D].
  - assert (Er : r = sqrt 2) by (apply (Rmult_eq_reg_r x_a); lra). rewrite Er. replace (sqrt 2 ^ 2) with 2 by (rewrite <- S at 1; ring). ring.
  - assert (sqrt 2 < r) by nra. assert (N : 2 - r ^ 2 < 0) by nra. assert ((2 - r ^ 2) * / (r ^ 2 - 1) < 0) by nra. unfold Rdiv in A. nra.
Qed.

(** With a bias, or with a delay, the derivative does not vanish there. *)
Theorem needs_unbiased : exists C x_a x_0 w : R, 0 < C /\ 0 < x_a /\ 0 < w /\ x_a + Rabs x_0 < sqrt 2 * x_a /\
  ~ is_derive (fun A => alpha C x_a x_0 A w) (sqrt 2 * x_a) 0.
Proof.
  exists 1, 1, (1 / 4), 1. rewrite Rabs_right by lra. repeat split; try lra; [interval with (i_prec 40)|]. intros D.
  unfold alpha in D. other_derivative D.
Qed.

Theorem needs_no_delay : exists C x_a w T_d : R, 0 < C /\ 0 < x_a /\ 0 < w /\ 0 < T_d /\
  ~ is_derive (fun A => alpha_delayed C x_a 0 A w T_d) (sqrt 2 * x_a) 0.
Proof.
  exists 1, 1, 1, (1 / 2). repeat split; try lra. intros D.
  unfold alpha_delayed, alpha, beta in D. other_derivative D.
Qed.

Print Assumptions statement.
