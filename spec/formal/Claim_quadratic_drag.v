(** claim: quadratic-drag (eqs. 28-29)
    [alpha = P_N/w^2], [beta_xx = -(3 pi/8) Q_N/(X_m w^2)], [delta = F_0]: the parameters of an axis with quadratic drag, from the
    describing function that balances a sinusoid in the mean and in the first harmonic. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Claim_first_harmonic_equations Claim_linear_drag.
Open Scope R_scope.

(** The formula of the program, by describing function, amplitude and angular frequency. *)
Definition identified_beta_xx (Q_N X w : R) : R := - Q_N / (8 / (3 * PI) * X * w ^ 2).

Theorem statement : forall (alpha beta_xx x_0 X w delta : R) (y : R -> R), 0 < X -> 0 < w ->
  (* the hypothesis one-tone: a sinusoid balances the relay's output y in the mean and in the first harmonic *)
  balances (left_side alpha 0 beta_xx x_0 X w) y delta ->
  alpha = identified_alpha (Y_P 1 y / X) w /\ beta_xx = identified_beta_xx (Y_Q 1 y / X) X w /\ delta = Y_0 y /\
  (* as eq. 29 writes it *)
  identified_beta_xx (Y_Q 1 y / X) X w = - (3 * PI / 8) * ((Y_Q 1 y / X) / (X * w ^ 2)).
Proof.
  intros alpha beta_xx x_0 X w delta y HX Hw B. pose proof PI_RGT_0.
  apply (proj2 (Claim_first_harmonic_equations.statement alpha 0 beta_xx x_0 X w delta y HX Hw)) in B.
  unfold f_R, f_I in B. destruct B as [E1 [E2 E3]]. unfold identified_alpha, identified_beta_xx.
  replace (Y_P 1 y / X) with (alpha * w ^ 2) by lra. replace (Y_Q 1 y / X) with (- (0 * w + 8 / (3 * PI) * beta_xx * X * w ^ 2)) by lra.
  repeat split; try lra; field; repeat split; lra.
Qed.

Print Assumptions statement.
