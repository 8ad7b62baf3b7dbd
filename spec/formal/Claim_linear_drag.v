(** claim: linear-drag (eqs. 26-27)
    [alpha = P_N/w^2], [beta = -Q_N/w], [delta = F_0]: the parameters of an axis with linear drag, from the describing function that
    balances a sinusoid in the mean and in the first harmonic. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Claim_first_harmonic_equations.
Open Scope R_scope.

(** The formulas of the program, by describing function and angular frequency. *)
Definition identified_alpha (P_N w : R) : R := P_N / w ^ 2.
Definition identified_beta (Q_N w : R) : R := - Q_N / w.

Theorem statement : forall (alpha beta x_0 X w delta : R) (y : R -> R), 0 < X -> 0 < w ->
  (* the hypothesis one-tone: a sinusoid balances the relay's output y in the mean and in the first harmonic *)
  balances (left_side alpha beta 0 x_0 X w) y delta ->
  alpha = identified_alpha (Y_P 1 y / X) w /\ beta = identified_beta (Y_Q 1 y / X) w /\ delta = Y_0 y.
Proof.
  intros alpha beta x_0 X w delta y HX Hw B. pose proof PI_RGT_0.
  apply (proj2 (Claim_first_harmonic_equations.statement alpha beta 0 x_0 X w delta y HX Hw)) in B.
  unfold f_R, f_I in B. destruct B as [E1 [E2 E3]]. unfold identified_alpha, identified_beta.
  replace (Y_P 1 y / X) with (alpha * w ^ 2) by lra. replace (- (Y_Q 1 y / X)) with (beta * w) by lra.
  repeat split; try lra; field; lra.
Qed.

Print Assumptions statement.
