(** claim: second-quadrant (section 4.1, Goldfarb)
    The points [-G_N = -P - jQ] of the unbiased relay with hysteresis, over all levels, half-widths and amplitudes that switch, are
    the second quadrant: each point of it is one of them, and none lies outside. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Claim_relay_p Claim_relay_q.
Open Scope R_scope.

(** The second quadrant with both half axes that bound it; the origin is the gain of no relay. *)
Definition second_quadrant (re im : R) : Prop := re <= 0 /\ 0 <= im /\ (re <> 0 \/ im <> 0).

Definition of_a_relay (re im : R) : Prop := exists C x_a X : R,
  0 < C /\ 0 <= x_a /\ 0 < X /\ x_a <= X /\ re = - P_N C x_a 0 X /\ im = - Q_N C x_a X.

Lemma unbiased C x_a X : 0 < X -> P_N C x_a 0 X = 4 * C / (PI * X) * sqrt (1 - (x_a / X) ^ 2).
Proof.
  intros HX. pose proof PI_RGT_0. unfold P_N. replace ((x_a - 0) / X) with (x_a / X) by (field; lra).
  replace ((x_a + 0) / X) with (x_a / X) by (field; lra). field. lra.
Qed.

Theorem statement : forall re im : R, of_a_relay re im <-> second_quadrant re im.
Proof.
  intros re im. pose proof PI_RGT_0 as HPI. split.
  - intros [C [x_a [X [HC [Hxa [HX [reach [-> ->]]]]]]]]. rewrite unbiased by exact HX. unfold Q_N.
    assert (K : 0 < 4 * C / (PI * X)) by (apply Rdiv_lt_0_compat; [lra|apply Rmult_lt_0_compat; lra]).
    replace (- (- (4 * C * x_a) / (PI * X ^ 2))) with (4 * C / (PI * X) * (x_a / X)) by (field; lra).
    assert (S : 0 <= x_a / X <= 1).
    { split; [apply Rmult_le_pos; [exact Hxa|left; apply Rinv_0_lt_compat, HX]|].
      apply (Rmult_le_reg_r X); [exact HX|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
    pose proof (sqrt_pos (1 - (x_a / X) ^ 2)). split; [nra|split; [nra|]].
    destruct (Req_dec (x_a / X) 0) as [Z|N].
    + left. rewrite Z. replace (1 - 0 ^ 2) with 1 by ring. rewrite sqrt_1. lra.
    + right. apply Rgt_not_eq. apply Rmult_lt_0_compat; lra.
  - intros [Hre [Him N]]. set (m := sqrt (re ^ 2 + im ^ 2)).
    assert (S : 0 < re ^ 2 + im ^ 2) by (destruct N; nra).
    assert (M : 0 < m) by (apply sqrt_lt_R0; exact S). assert (MM : m * m = re ^ 2 + im ^ 2) by (apply sqrt_sqrt; lra).
    exists (m * PI / 4), (im / m), 1.
    assert (L : im / m <= 1) by (apply (Rmult_le_reg_r m); [exact M|]; unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra; nra).
    split; [apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat; lra|lra]|].
    split; [apply Rmult_le_pos; [exact Him|left; apply Rinv_0_lt_compat, M]|]. split; [lra|]. split; [exact L|].
    rewrite unbiased by lra. unfold Q_N. split.
    + replace (1 - (im / m / 1) ^ 2) with ((- re / m) * (- re / m)).
      * rewrite sqrt_square by (apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat, M]). field. lra.
      * replace (1 - (im / m / 1) ^ 2) with ((m * m - im ^ 2) / (m * m)) by (field; lra). rewrite MM at 1. field. lra.
    + field. lra.
Qed.

(** Magnitude and angle: [-G_N = (4 C/(pi X)) exp(j (pi - asin(x_a/X)))]. *)
Theorem polar : forall C x_a X : R, 0 < C -> 0 <= x_a -> 0 < X -> x_a <= X ->
  let angle := PI - asin (x_a / X) in
  - P_N C x_a 0 X = 4 * C / (PI * X) * cos angle /\ - Q_N C x_a X = 4 * C / (PI * X) * sin angle /\ PI / 2 <= angle <= PI.
Proof.
  intros C x_a X HC Hxa HX reach angle. pose proof PI_RGT_0.
  assert (S : 0 <= x_a / X <= 1).
  { split; [apply Rmult_le_pos; [exact Hxa|left; apply Rinv_0_lt_compat, HX]|].
    apply (Rmult_le_reg_r X); [exact HX|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
  unfold angle. rewrite unbiased by exact HX. rewrite sin_PI_x, sin_asin by lra.
  replace (PI - asin (x_a / X)) with (- asin (x_a / X) + PI) by ring. rewrite neg_cos, cos_neg, cos_asin by lra.
  unfold Rsqr, Q_N. split; [f_equal; replace (x_a / X * (x_a / X)) with ((x_a / X) ^ 2) by ring; ring|split; [field; lra|]].
  pose proof (asin_bound (x_a / X)). assert (0 <= asin (x_a / X)).
  { destruct (Rle_lt_dec 0 (asin (x_a / X))) as [L|L]; [exact L|exfalso].
    assert (sin (asin (x_a / X)) < 0) by (apply sin_lt_0_var; lra). rewrite sin_asin in H1 by lra. lra. }
  lra.
Qed.

(** The third quadrant is not covered. *)
Theorem nothing_else : ~ of_a_relay (-1) (-1).
Proof. intros H. apply statement in H. unfold second_quadrant in H. lra. Qed.

Print Assumptions statement.
