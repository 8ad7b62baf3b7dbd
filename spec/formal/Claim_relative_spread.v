(** claim: relative-spread (eq. 41)
    [sigma% = sqrt(2) abs((v_1 - v_2)/(v_1 + v_2)) 100] is the sample standard deviation (n - 1) of two values over their mean, in
    percent. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(** Eq. 41 as the program has it. *)
Definition relative_spread_percent (v_1 v_2 : R) : R := sqrt 2 * Rabs ((v_1 - v_2) / (v_1 + v_2)) * 100.

Definition mean (v_1 v_2 : R) : R := (v_1 + v_2) / 2.
(** Over n - 1 of two values. *)
Definition sample_deviation (v_1 v_2 : R) : R := sqrt (((v_1 - mean v_1 v_2) ^ 2 + (v_2 - mean v_1 v_2) ^ 2) / (2 - 1)).

(** Two values of one sign; no more is needed than that their mean is not zero. *)
Theorem statement : forall v_1 v_2 : R, v_1 + v_2 <> 0 ->
  relative_spread_percent v_1 v_2 = sample_deviation v_1 v_2 / Rabs (mean v_1 v_2) * 100.
Proof.
  intros v_1 v_2 H. unfold relative_spread_percent, sample_deviation, mean.
  assert (S2 : 0 < sqrt 2) by (apply sqrt_lt_R0; lra). assert (S : sqrt 2 * sqrt 2 = 2) by (apply sqrt_sqrt; lra).
  replace (((v_1 - (v_1 + v_2) / 2) ^ 2 + (v_2 - (v_1 + v_2) / 2) ^ 2) / (2 - 1)) with (Rsqr ((v_1 - v_2) / sqrt 2)).
  - rewrite sqrt_Rsqr_abs, !Rabs_div, (Rabs_right (sqrt 2)), (Rabs_right 2) by lra.
    assert (A : Rabs (v_1 + v_2) <> 0) by (apply Rabs_no_R0; exact H).
    replace (Rabs (v_1 - v_2) / sqrt 2) with (Rabs (v_1 - v_2) * (sqrt 2 / 2)) by (rewrite <- S at 2; field; lra). field. exact A.
  - unfold Rsqr. replace ((v_1 - v_2) / sqrt 2 * ((v_1 - v_2) / sqrt 2)) with ((v_1 - v_2) ^ 2 / (sqrt 2 * sqrt 2)) by (field; lra).
    rewrite S. field.
Qed.

(** Over n in place of n - 1 it is another number: the factor [sqrt(2)] would be missing. *)
Theorem not_over_n : Rabs ((1 - 3) / (1 + 3)) * 100 <> sample_deviation 1 3 / Rabs (mean 1 3) * 100.
Proof.
  pose proof (statement 1 3 ltac:(lra)) as E. unfold relative_spread_percent in E. rewrite <- E.
  intros F. rewrite Rabs_left in F by lra. assert (S : sqrt 2 = 1) by lra. assert (sqrt 2 * sqrt 2 = 2) by (apply sqrt_sqrt; lra). nra.
Qed.

Print Assumptions statement.
