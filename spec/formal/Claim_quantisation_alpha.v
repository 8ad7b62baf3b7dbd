(** claim: quantisation-alpha (eq. 37)
    [dalpha/alpha = [(2 - (X_m/x_a)^2)/((X_m/x_a)^2 - 1)] dX/X], to first order in an error of the amplitude, unbiased and without
    delay: the logarithmic derivative of Table 3's alpha. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Enclosure Claim_table_3.
Open Scope R_scope.

(** Eq. 37 by the ratio [r = X_m/x_a]. *)
Definition sensitivity_alpha (r : R) : R := (2 - r ^ 2) / (r ^ 2 - 1).

(** With the bias and the delay in: eqs. 31, 30 and 34 over [w^2]. *)
Definition alpha_delayed (C x_a x_0 X w T_d : R) : R :=
  (w ^ 2 * alpha C x_a x_0 X w * cos (w * T_d) + - (w * beta C x_a X w) * sin (w * T_d)) / w ^ 2.

Lemma ratio_above_one x_a X : 0 < x_a -> x_a < X -> 0 < 1 - (x_a / X) ^ 2 /\ 0 < (X / x_a) ^ 2 - 1.
Proof.
  intros Hxa H. assert (R1 : 0 < x_a / X < 1) by (split; [apply Rdiv_lt_0_compat; lra|apply div_lt_one; lra]).
  assert (R2 : 1 < X / x_a).
  { apply (Rmult_lt_reg_r x_a); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
  split; nra.
Qed.

Theorem statement : forall C x_a X w : R, 0 < C -> 0 < x_a -> 0 < w -> x_a < X ->
  is_derive (fun A => alpha C x_a 0 A w) X (sensitivity_alpha (X / x_a) * (alpha C x_a 0 X w / X)).
Proof.
  intros C x_a X w HC Hxa Hw H. pose proof PI_RGT_0. destruct (ratio_above_one x_a X Hxa H) as [R0 R1].
  assert (E : forall A, 0 < A -> alpha C x_a 0 A w = 4 * C / (PI * w ^ 2) * (sqrt (1 - (x_a / A) ^ 2) / A)).
  { intros A HA. unfold alpha. replace ((0 - x_a) ^ 2 / A ^ 2) with ((x_a / A) ^ 2) by (field; lra).
    replace ((0 + x_a) ^ 2 / A ^ 2) with ((x_a / A) ^ 2) by (field; lra). field. lra. }
  apply (is_derive_ext_loc (fun A => 4 * C / (PI * w ^ 2) * (sqrt (1 - (x_a / A) ^ 2) / A))).
  { exists (mkposreal X ltac:(lra)). intros A HA. symmetry. apply E.
    unfold ball in HA; simpl in HA; unfold AbsRing_ball, abs, minus, plus, opp in HA; simpl in HA. apply Rabs_def2 in HA. lra. }
  rewrite (E X ltac:(lra)). auto_derive.
  - unfold Rdiv in R0. repeat split; try lra.
  - unfold sensitivity_alpha. set (s := sqrt (1 - (x_a / X) ^ 2)).
    assert (S : s * s = 1 - (x_a / X) ^ 2) by (unfold s; apply sqrt_sqrt; lra).
    replace (sqrt (1 + - (x_a * / X * (x_a * / X * 1)))) with s by (unfold s; f_equal; unfold Rdiv; ring).
    assert (S0 : 0 < s) by (apply sqrt_lt_R0; lra). clearbody s.
    assert (XX : X * X - x_a * x_a <> 0) by nra.
    (* The root's inverse is the root over its square. *)
    assert (I : / s = s / (1 - (x_a / X) ^ 2)) by (rewrite <- S; field; lra).
    transitivity (4 * C / (PI * w ^ 2) * (x_a ^ 2 / X ^ 4 * / s - s / X ^ 2)).
    + field. repeat split; lra.
    + rewrite I. field. repeat split; lra.
Qed.

(** With a bias of half the half-width it is another derivative. *)
Theorem needs_unbiased : exists C x_a x_0 X w : R, 0 < C /\ 0 < x_a /\ 0 < w /\ x_a + Rabs x_0 < X /\
  ~ is_derive (fun A => alpha C x_a x_0 A w) X (sensitivity_alpha (X / x_a) * (alpha C x_a x_0 X w / X)).
Proof.
  exists 1, 1, (1 / 2), 2, 1. rewrite Rabs_right by lra. repeat split; try lra. intros D.
  unfold alpha, sensitivity_alpha in D. other_derivative D.
Qed.

(** With a delay eq. 34 mixes Q into alpha. *)
Theorem needs_no_delay : exists C x_a X w T_d : R, 0 < C /\ 0 < x_a /\ 0 < w /\ x_a < X /\ 0 < T_d /\
  ~ is_derive (fun A => alpha_delayed C x_a 0 A w T_d) X (sensitivity_alpha (X / x_a) * (alpha_delayed C x_a 0 X w T_d / X)).
Proof.
  exists 1, 1, 2, 1, (1 / 2). repeat split; try lra. intros D.
  unfold alpha_delayed, alpha, beta, sensitivity_alpha in D. other_derivative D.
Qed.

Print Assumptions statement.
