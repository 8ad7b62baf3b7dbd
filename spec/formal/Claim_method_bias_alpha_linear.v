(** claim: method-bias-alpha-linear (of this project)
    The first-harmonic method on the exact symmetric orbit with linear drag, without delay: its relative error of alpha is +3.2 % as g
    goes to 0, -3 % at 1, +47 % at 10; in magnitude below 5 % for [g <= 1] and below 48 % for [g <= 10]. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Hyperbolic Claim_method_bias Bias Enclosure.
From Selfosc Require Claim_orbit_linear Claim_table_3.
Open Scope R_scope.

(** The error as a function of z, in the form that is enclosed. *)
Lemma enclosed z : error_alpha_linear z =
  16 * z ^ 2 / (PI ^ 3 * (z - ln (1 + (1 - 2 / (exp (2 * z) + 1))))) *
  sqrt (1 - ((z - (1 - 2 / (exp (2 * z) + 1))) / (z - ln (1 + (1 - 2 / (exp (2 * z) + 1))))) ^ 2) - 1.
Proof. unfold error_alpha_linear, size_linear. now rewrite tanh_once. Qed.

Lemma limit : 32 / 1000 < 32 / PI ^ 3 - 1 < 33 / 1000.
Proof. split; interval with (i_prec 40). Qed.

Lemma near z : 0 < z <= 1 / 4 -> Rabs (error_alpha_linear z - (32 / PI ^ 3 - 1)) <= 32 / PI ^ 3 * z ^ 2.
Proof.
  intros Hz. destruct (near_zero_linear z Hz) as [R0 [Q0 _]]. set (q := (z - tanh z) / size_linear z) in *.
  pose proof (sqrt_near_one q ltac:(lra)) as S. pose proof PI_RGT_0 as HPI. pose proof (size_linear_positive z ltac:(lra)) as S0.
  assert (Z2 : 0 < z ^ 2 <= 1 / 16) by (split; nra). assert (Q2 : q ^ 2 <= z ^ 2) by nra.
  assert (K : 0 < 16 / PI ^ 3) by (apply Rdiv_lt_0_compat; [lra|apply pow_lt; exact HPI]).
  assert (E : error_alpha_linear z - (32 / PI ^ 3 - 1) = 16 / PI ^ 3 * (z ^ 2 / size_linear z * sqrt (1 - q ^ 2) - 2)).
  { unfold error_alpha_linear. fold q. set (w := sqrt _). field. split; lra. }
  rewrite E, Rabs_mult, (Rabs_pos_eq (16 / PI ^ 3)) by lra. replace (32 / PI ^ 3 * z ^ 2) with (16 / PI ^ 3 * (2 * z ^ 2)) by (field; lra).
  apply Rmult_le_compat_l; [lra|]. set (r := z ^ 2 / size_linear z) in *. set (w := sqrt (1 - q ^ 2)) in *.
  apply Rabs_le. split.
  - assert (2 * (1 - z ^ 2) <= r * w) by (apply Rmult_le_compat; lra). lra.
  - assert (r * w <= r * 1) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Lemma up_to_one z : 0 < z -> z - tanh z <= 1 -> Rabs (error_alpha_linear z) < 5 / 100.
Proof.
  intros Hz G. pose proof limit as L. destruct (Rle_lt_dec z (1 / 8)) as [Q|Q].
  - pose proof (near z ltac:(lra)) as N. assert (z ^ 2 <= 1 / 64) by nra. pose proof (Rabs_triang (error_alpha_linear z - (32 / PI ^ 3 - 1)) (32 / PI ^ 3 - 1)) as T.
    replace (error_alpha_linear z - (32 / PI ^ 3 - 1) + (32 / PI ^ 3 - 1)) with (error_alpha_linear z) in T by ring.
    rewrite (Rabs_pos_eq (32 / PI ^ 3 - 1)) in T by lra. nra.
  - assert (U : z < 197 / 100).
    { apply (root_between z 0 (197 / 100) Hz (Rle_refl 0)); [|apply Rle_lt_trans with (1 := G); rewrite tanh_once; interval with (i_prec 40)|lra].
      apply (Claim_orbit_linear.root_increases 0 z); lra. }
    assert (I : 1 / 8 <= z <= 197 / 100) by lra. rewrite enclosed. apply Rabs_def1; interval with (i_bisect z, i_autodiff z, i_prec 40).
Qed.

Lemma up_to_ten z : 0 < z -> z - tanh z <= 10 -> Rabs (error_alpha_linear z) < 48 / 100.
Proof.
  intros Hz G. destruct (Rle_lt_dec (z - tanh z) 1) as [Q|Q]; [pose proof (up_to_one z Hz Q); lra|].
  assert (L : 19 / 10 < z) by (apply (root_between z (19 / 10) 12 Hz); [lra|apply Rlt_trans with (2 := Q); rewrite tanh_once; interval with (i_prec 40)|apply Rle_lt_trans with (1 := G); rewrite tanh_once; interval with (i_prec 40)|lra]).
  assert (U : z <= 11) by (pose proof (tanh_below_one z); lra).
  rewrite enclosed. apply Rabs_def1; interval with (i_bisect z, i_autodiff z, i_prec 40).
Qed.

Theorem statement : forall alpha beta C x_a z, 0 < alpha -> 0 < beta -> 0 < C -> 0 < x_a ->
  let g := Claim_orbit_linear.g alpha beta C x_a in
  (* the orbit's z *)
  0 < z -> z - tanh z = g ->
  let X := Claim_orbit_linear.X_m alpha beta C x_a z in let w := frequency (Claim_orbit_linear.T alpha beta z) in
  let e := error (Claim_table_3.alpha C x_a 0 X w) alpha in
  (g <= 1 -> Rabs e < 5 / 100) /\ (g <= 10 -> Rabs e < 48 / 100) /\
  (* at 1 and at 10 *)
  (g = 1 -> Rabs (e - - (3 / 100)) < 1 / 200) /\ (g = 10 -> Rabs (e - 47 / 100) < 1 / 200) /\
  (* as g goes to zero: to 32/pi^3 - 1 *)
  (g <= 1 / 200 -> Rabs (e - (32 / PI ^ 3 - 1)) <= 32 / PI ^ 3 * z ^ 2 /\ z ^ 3 <= 4 * g) /\ 32 / 1000 < 32 / PI ^ 3 - 1 < 33 / 1000.
Proof.
  intros alpha beta C x_a z Ha Hb HC Hx g Hz E X w e.
  assert (Ee : e = error_alpha_linear z) by exact (proj1 (proj1 Claim_method_bias.statement alpha beta C x_a z Ha Hb HC Hx Hz E)).
  rewrite Ee, <- E. clear Ee e X w. split; [apply up_to_one, Hz|]. split; [apply up_to_ten, Hz|]. split; [|split; [|split; [|exact limit]]].
  - intros G. assert (B : 1961 / 1000 < z < 1963 / 1000) by (apply root_between; try lra; rewrite G, tanh_once; interval with (i_prec 40)).
    assert (I : 1961 / 1000 <= z <= 1963 / 1000) by lra. rewrite enclosed. apply Rabs_def1; interval with (i_autodiff z, i_bisect z, i_prec 40).
  - intros G. assert (B : 10999 / 1000 < z < 11001 / 1000) by (apply root_between; try lra; rewrite G, tanh_once; interval with (i_prec 40)).
    assert (I : 10999 / 1000 <= z <= 11001 / 1000) by lra. rewrite enclosed. apply Rabs_def1; interval with (i_autodiff z, i_bisect z, i_prec 40).
  - intros G. assert (U : z < 1 / 4).
    { apply (root_between z 0 (1 / 4) Hz (Rle_refl 0)); [apply (Claim_orbit_linear.root_increases 0 z); lra| |lra].
      apply Rle_lt_trans with (1 := G). rewrite tanh_once. interval with (i_prec 40). }
    split; [apply near; lra|]. pose proof (excess_ge z ltac:(lra)) as K. assert (0 < z ^ 3) by (apply pow_lt, Hz).
    replace (z ^ 5) with (z ^ 3 * z ^ 2) in K by ring. assert (z ^ 2 <= 1 / 16) by nra. nra.
Qed.

Print Assumptions statement.
