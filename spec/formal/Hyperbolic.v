(** The hyperbolic tangent of Coq's library: range, inverse, slope. Shared by orbit-linear, the amplitudes and the method's bias. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

Definition atanh (r : R) : R := ln ((1 + r) / (1 - r)) / 2.

Lemma tanh_is z : tanh z = (exp z - exp (- z)) / (exp z + exp (- z)).
Proof. unfold tanh, sinh, cosh. pose proof (exp_pos z). pose proof (exp_pos (- z)). field. lra. Qed.

Lemma tanh_range z : 0 < z -> 0 < tanh z < 1.
Proof.
  intros H. rewrite tanh_is. assert (exp (- z) < exp z) by (apply exp_increasing; lra). pose proof (exp_pos (- z)).
  split; [apply Rdiv_lt_0_compat; lra|apply div_lt_one; lra].
Qed.

Lemma tanh_below_one z : tanh z < 1.
Proof. rewrite tanh_is. pose proof (exp_pos z). pose proof (exp_pos (- z)). apply div_lt_one; lra. Qed.

Lemma tanh_0 : tanh 0 = 0.
Proof. rewrite tanh_is, Ropp_0. field. rewrite exp_0. lra. Qed.

(** [z = atanh (tanh z)], in logarithms. *)
Lemma atanh_tanh z : 0 < z -> ln (1 + tanh z) - ln (1 - tanh z) = 2 * z.
Proof.
  intros H. pose proof (tanh_range z H) as [T0 T1]. pose proof (exp_pos z) as P. pose proof (exp_pos (- z)) as N.
  assert (E : (1 + tanh z) * exp (- z) = (1 - tanh z) * exp z) by (rewrite tanh_is; field; lra).
  apply (f_equal ln) in E. rewrite !ln_mult, !ln_exp in E by lra. lra.
Qed.

Lemma excess_derive z : is_derive (fun z => z - tanh z) z (tanh z * tanh z).
Proof.
  apply (is_derive_ext (fun z => z - (exp z - exp (- z)) / (exp z + exp (- z)))); [intros t; now rewrite tanh_is|].
  pose proof (exp_pos z). pose proof (exp_pos (- z)). auto_derive; [lra|]. rewrite tanh_is.
  assert (exp z * exp (- z) = 1) by (rewrite <- exp_plus, Rplus_opp_r; apply exp_0).
  field_simplify_eq; [|lra]. nra.
Qed.

Lemma tanh_derive z : is_derive tanh z (1 - tanh z * tanh z).
Proof.
  pose proof (is_derive_minus (fun z => z) (fun z => z - tanh z) z _ _ (is_derive_id (K := R_AbsRing) z) (excess_derive z)) as D.
  apply (is_derive_ext _ tanh) in D; [exact D|]. intros t. unfold minus, plus, opp; simpl. ring.
Qed.

Lemma tanh_increases a b : a < b -> tanh a < tanh b.
Proof.
  intros ab. apply (increases tanh (fun z => 1 - tanh z * tanh z)); [exact ab| | |]; intros z Hz.
  - apply tanh_derive.
  - apply (continuity_of_derive _ _ _ (tanh_derive z)).
  - pose proof (tanh_below_one z). pose proof (tanh_below_one (- z)) as N.
    assert (O : tanh (- z) = - tanh z) by (rewrite !tanh_is, Ropp_involutive; pose proof (exp_pos z); pose proof (exp_pos (- z)); field; repeat split; lra).
    rewrite O in N. nra.
Qed.

(** [tanh (atanh r) = r]. *)
Lemma tanh_atanh r : -1 < r < 1 -> tanh (atanh r) = r.
Proof.
  intros H. assert (Q : 0 < (1 + r) / (1 - r)) by (apply Rdiv_lt_0_compat; lra).
  assert (S : exp (atanh r) * exp (atanh r) = (1 + r) / (1 - r)).
  { rewrite <- exp_plus. replace (atanh r + atanh r) with (ln ((1 + r) / (1 - r))) by (unfold atanh; field). apply exp_ln, Q. }
  rewrite tanh_is, exp_Ropp. pose proof (exp_pos (atanh r)) as P. set (e := exp (atanh r)) in *.
  apply (Rmult_eq_reg_r (e * e + 1)); [|nra].
  replace ((e - / e) / (e + / e) * (e * e + 1)) with (e * e - 1) by (field; repeat split; lra || nra).
  rewrite S. field. lra.
Qed.

Lemma atanh_positive r : 0 < r < 1 -> 0 < atanh r.
Proof.
  intros H. unfold atanh. assert (1 < (1 + r) / (1 - r)); [|pose proof (ln_increasing 1 ((1 + r) / (1 - r)) ltac:(lra) H0); rewrite ln_1 in *; lra].
  apply (Rmult_lt_reg_r (1 - r)); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
Qed.
