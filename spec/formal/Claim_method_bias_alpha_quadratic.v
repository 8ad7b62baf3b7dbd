(** claim: method-bias-alpha-quadratic (of this project)
    The first-harmonic method on the exact symmetric orbit with quadratic drag, without delay: its relative error of alpha is +3.2 % as g
    goes to 0, -6.5 % at 1, +52 % at 10; in magnitude below 8 % for [g <= 1] and below 53 % for [g <= 10]. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Hyperbolic Claim_method_bias Bias Enclosure.
From Selfosc Require Claim_orbit_quadratic Claim_table_3.
Open Scope R_scope.

(** The error as a function of t, with [y = tanh t] and [g = size_linear t/2], in the form that is enclosed. *)
Definition share (t : R) : R := 1 - 2 / (exp (2 * t) + 1).
Definition size (t : R) : R := t - ln (1 + share t).
Definition time (t : R) : R := atan (sqrt (share t)) + (ln (1 + sqrt (share t)) + ln ((exp (2 * t) + 1) / 2) / 2).
Definition enclosed (t : R) : R := 8 * time t ^ 2 / (PI ^ 3 * t) * sqrt (1 - (size t / t) ^ 2) - 1.

Lemma enclosed_is t : 0 < t -> alpha_by_t t = enclosed t.
Proof. intros Ht. unfold alpha_by_t, enclosed, size_linear. rewrite (turn_once t Ht), tanh_once. reflexivity. Qed.

Lemma size_is t : size_linear t = size t.
Proof. unfold size_linear. rewrite tanh_once. reflexivity. Qed.

Ltac enclose := unfold enclosed, size, time, share in *.

Lemma limit : 32 / 1000 < 32 / PI ^ 3 - 1 < 33 / 1000.
Proof. split; interval with (i_prec 40). Qed.

Lemma near t : 0 < t <= 1 / 5 -> Rabs (alpha_by_t t - (32 / PI ^ 3 - 1)) <= 8 / PI ^ 3 * (3 * t ^ 2).
Proof.
  intros Ht. destruct (near_zero_quadratic t Ht) as [R0 [Q0 _]]. set (q := size_linear t / t) in *.
  pose proof (sqrt_near_one q ltac:(lra)) as S. pose proof PI_RGT_0 as HPI. assert (T2 : 0 < t ^ 2 <= 1 / 25) by (split; nra).
  assert (Q2 : q ^ 2 <= t ^ 2 / 4) by nra. assert (K : 0 < 8 / PI ^ 3) by (apply Rdiv_lt_0_compat; [lra|apply pow_lt; exact HPI]).
  assert (E : alpha_by_t t - (32 / PI ^ 3 - 1) = 8 / PI ^ 3 * (turn t ^ 2 / t * sqrt (1 - q ^ 2) - 4)).
  { unfold alpha_by_t. fold q. set (w := sqrt (1 - _)). field. split; lra. }
  rewrite E, Rabs_mult, (Rabs_pos_eq (8 / PI ^ 3)) by lra. apply Rmult_le_compat_l; [lra|].
  set (r := turn t ^ 2 / t) in *. set (w := sqrt (1 - q ^ 2)) in *. replace (t ^ 4) with (t ^ 2 * t ^ 2) in R0 by ring.
  assert (L : (4 - 4 * t ^ 2 / 3) * (1 - t ^ 2 / 4) <= r * w) by (apply Rmult_le_compat; lra).
  assert (U : r * w <= r * 1) by (apply Rmult_le_compat_l; lra). apply Rabs_le. split; nra.
Qed.

Lemma up_to_one t : 0 < t -> size_linear t <= 2 -> Rabs (alpha_by_t t) < 8 / 100.
Proof.
  intros Ht G. destruct (Rle_lt_dec t (1 / 5)) as [Q|Q].
  - pose proof (near t ltac:(lra)) as N. pose proof limit as L. assert (T2 : 0 < t ^ 2 <= 1 / 25) by (split; nra). set (w := t ^ 2) in *.
    assert (K : 8 / PI ^ 3 * (3 * w) < 4 / 100) by (interval with (i_prec 40)). pose proof (Rabs_def2 _ _ (Rle_lt_trans _ _ _ N K)). apply Rabs_def1; lra.
  - assert (U : t < 27 / 10).
    { apply (size_root_between t 0 (27 / 10) Ht (Rle_refl 0)); [apply size_increases; lra|apply Rle_lt_trans with (1 := G); rewrite size_is; enclose; interval with (i_prec 40)|lra]. }
    assert (I : 1 / 5 <= t <= 27 / 10) by lra. rewrite (enclosed_is t Ht). enclose. apply Rabs_def1; interval with (i_bisect t, i_autodiff t, i_prec 40).
Qed.

Lemma up_to_ten t : 0 < t -> size_linear t <= 20 -> Rabs (alpha_by_t t) < 53 / 100.
Proof.
  intros Ht G. destruct (Rle_lt_dec (size_linear t) 2) as [Q|Q]; [pose proof (up_to_one t Ht Q); lra|].
  assert (L : 26 / 10 < t < 207 / 10).
  { apply size_root_between; try lra; [apply Rlt_trans with (2 := Q)|apply Rle_lt_trans with (1 := G)]; rewrite size_is; enclose; interval with (i_prec 40). }
  assert (I : 26 / 10 <= t <= 207 / 10) by lra. rewrite (enclosed_is t Ht). enclose. apply Rabs_def1; interval with (i_bisect t, i_autodiff t, i_prec 40).
Qed.

Theorem statement : forall alpha beta C x_a, 0 < alpha -> 0 < beta -> 0 < C -> 0 < x_a ->
  let g := Claim_orbit_quadratic.g alpha beta x_a in let y := Claim_orbit_quadratic.y g in
  let X := Claim_orbit_quadratic.X_m alpha beta x_a y in let w := frequency (Claim_orbit_quadratic.T alpha beta C y) in
  let e := error (Claim_table_3.alpha C x_a 0 X w) alpha in
  (g <= 1 -> Rabs e < 8 / 100) /\ (g <= 10 -> Rabs e < 53 / 100) /\
  (* at 1 and at 10 *)
  (g = 1 -> Rabs (e - - (65 / 1000)) < 1 / 200) /\ (g = 10 -> Rabs (e - 52 / 100) < 1 / 200) /\
  (* as g goes to zero *)
  (g <= 1 / 200 -> Rabs (e - (32 / PI ^ 3 - 1)) <= 8 / PI ^ 3 * (15 * g)) /\ 32 / 1000 < 32 / PI ^ 3 - 1 < 33 / 1000.
Proof.
  intros alpha beta C x_a Ha Hb HC Hx g y X w e.
  assert (G0 : 0 < g) by (unfold g, Claim_orbit_quadratic.g; apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat|]; assumption).
  assert (Ee : e = error_alpha_quadratic g) by exact (proj1 (proj2 Claim_method_bias.statement alpha beta C x_a Ha Hb HC Hx)).
  destruct (unroll_quadratic g G0) as [t [Ht [S [EA EB]]]]. rewrite Ee, EA. clear Ee e X w y.
  split; [intros G; apply up_to_one; lra|]. split; [intros G; apply up_to_ten; lra|]. split; [|split; [|split; [|exact limit]]].
  - intros G. assert (B : 2693 / 1000 - 5 / 1000 < t < 2693 / 1000 + 5 / 1000) by (apply size_root_between; try lra; rewrite S, G, size_is; enclose; interval with (i_prec 40)).
    assert (I : 2688 / 1000 <= t <= 2698 / 1000) by lra. rewrite (enclosed_is t Ht). enclose. apply Rabs_def1; interval with (i_autodiff t, i_bisect t, i_prec 40).
  - intros G. assert (B : 2069 / 100 < t < 207 / 10) by (apply size_root_between; try lra; rewrite S, G, size_is; enclose; interval with (i_prec 40)).
    assert (I : 2069 / 100 <= t <= 207 / 10) by lra. rewrite (enclosed_is t Ht). enclose. apply Rabs_def1; interval with (i_autodiff t, i_bisect t, i_prec 40).
  - intros G. assert (U : t < 1 / 5).
    { apply (size_root_between t 0 (1 / 5) Ht (Rle_refl 0)); [apply size_increases; lra| |lra]. rewrite S. apply Rle_lt_trans with (1 / 100); [lra|].
      rewrite size_is. enclose. interval with (i_prec 40). }
    pose proof (near t ltac:(lra)) as N. pose proof (size_ge t ltac:(lra)) as K. rewrite S in K.
    assert (T2 : 0 < t ^ 2 <= 1 / 25) by (split; nra). replace (t ^ 4) with (t ^ 2 * t ^ 2) in K by ring.
    assert (T3 : t ^ 2 <= 5 * g) by nra.
    assert (KP : 0 < 8 / PI ^ 3) by (apply Rdiv_lt_0_compat; [lra|apply pow_lt, PI_RGT_0]).
    apply Rle_trans with (1 := N). apply Rmult_le_compat_l; lra.
Qed.

Print Assumptions statement.
