(** claim: switching-condition (eq. 40)
    The experiment is usable when [(x_a + abs(x_0))/X_m <= 1]: exactly then both radicands of eq. 31 are zero or more, so that it has a
    value, and exactly then a sinusoid reaches both levels of the relay. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

Definition condition_40 (x_a x_0 X : R) : Prop := (x_a + Rabs x_0) / X <= 1.

Lemma condition_40_is x_a x_0 X : 0 < X -> (condition_40 x_a x_0 X <-> x_a + Rabs x_0 <= X).
Proof.
  intros HX. unfold condition_40. split; intros H.
  - apply (Rmult_le_compat_r X) in H; [|lra]. unfold Rdiv in H. rewrite Rmult_assoc, Rinv_l in H; lra.
  - apply (Rmult_le_reg_r X); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
Qed.

Lemma radicand_is u X : 0 < X -> (0 <= 1 - (u / X) ^ 2 <-> Rabs u <= X).
Proof.
  intros HX. assert (E : 1 - (u / X) ^ 2 = (X ^ 2 - u ^ 2) / X ^ 2) by (field; lra).
  assert (P : 0 < X ^ 2) by nra. rewrite E.
  assert (S : 0 <= (X ^ 2 - u ^ 2) / X ^ 2 <-> 0 <= X ^ 2 - u ^ 2).
  { split; intros H.
    - apply (Rmult_le_compat_r (X ^ 2)) in H; [|lra]. unfold Rdiv in H. rewrite Rmult_assoc, Rinv_l in H; lra.
    - apply Rmult_le_pos; [exact H|]. left. apply Rinv_0_lt_compat, P. }
  rewrite S. unfold Rabs. destruct (Rcase_abs u); split; intros; nra.
Qed.

Theorem statement : forall x_a x_0 X : R, 0 <= x_a -> 0 < X ->
  (condition_40 x_a x_0 X <-> 0 <= 1 - ((x_a - x_0) / X) ^ 2 /\ 0 <= 1 - ((x_a + x_0) / X) ^ 2) /\
  (condition_40 x_a x_0 X <-> (exists t, x_a <= sinusoid x_0 X t) /\ (exists t, sinusoid x_0 X t <= - x_a)).
Proof.
  intros x_a x_0 X Hxa HX. rewrite (condition_40_is x_a x_0 X HX), !radicand_is by exact HX. split.
  - unfold Rabs. destruct (Rcase_abs x_0), (Rcase_abs (x_a - x_0)), (Rcase_abs (x_a + x_0)); lra.
  - unfold sinusoid. split.
    + intros H. split; [exists (PI / 2); rewrite sin_PI2|exists (3 * (PI / 2)); rewrite sin_3PI2];
        revert H; unfold Rabs; destruct (Rcase_abs x_0); lra.
    + intros [[t T] [s S]]. pose proof (SIN_bound t) as [_ B]. pose proof (SIN_bound s) as [B' _].
      unfold Rabs. destruct (Rcase_abs x_0); nra.
Qed.

(** With a limit of 1.1 the condition does not say so. *)
Theorem not_1_1 : exists x_a x_0 X : R, 0 <= x_a /\ 0 < X /\ (x_a + Rabs x_0) / X <= 1.1 /\ 1 - ((x_a + x_0) / X) ^ 2 < 0.
Proof. exists 1, 0.1, 1. rewrite Rabs_right by lra. lra. Qed.

Print Assumptions statement.
