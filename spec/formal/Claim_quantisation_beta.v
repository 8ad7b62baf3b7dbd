(** claim: quantisation-beta (eq. 38)
    [dbeta/beta = -2 dX/X], to first order in an error of the amplitude, without delay, with or without bias: Table 3's formula
    does not know the bias. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Enclosure Claim_table_3.
Open Scope R_scope.

(** Eq. 38. *)
Definition sensitivity_beta : R := -2.

(** With the delay in: eq. 34. *)
Definition beta_delayed (C x_a x_0 X w T_d : R) : R :=
  w * alpha C x_a x_0 X w * sin (w * T_d) + beta C x_a X w * cos (w * T_d).

Theorem statement : forall C x_a X w : R, 0 < C -> 0 < x_a -> 0 < w -> x_a < X ->
  is_derive (fun A => beta C x_a A w) X (sensitivity_beta * (beta C x_a X w / X)).
Proof.
  intros C x_a X w HC Hxa Hw H. pose proof PI_RGT_0. unfold beta, sensitivity_beta.
  assert (0 < X * X) by nra. assert (0 < X * (X * X)) by (apply Rmult_lt_0_compat; lra).
  auto_derive.
  - assert (0 < w * w) by nra. assert (0 < PI * (X * X)) by (apply Rmult_lt_0_compat; lra). nra.
  - field. repeat split; lra.
Qed.

(** With a delay eq. 34 mixes P into beta. *)
Theorem needs_no_delay : exists C x_a X w T_d : R, 0 < C /\ 0 < x_a /\ 0 < w /\ x_a < X /\ 0 < T_d /\
  ~ is_derive (fun A => beta_delayed C x_a 0 A w T_d) X (sensitivity_beta * (beta_delayed C x_a 0 X w T_d / X)).
Proof.
  exists 1, 1, 2, 1, (1 / 2). repeat split; try lra. intros D.
  unfold beta_delayed, alpha, beta, sensitivity_beta in D. other_derivative D.
Qed.

Print Assumptions statement.
