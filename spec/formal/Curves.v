(** How the curves of the method's bias in the certificates are proved: what they print is the error that the claims method-bias-... speak
    of; near zero it lies within a multiple of the coordinate's square of its limit, and beyond it is enclosed. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Hyperbolic Claim_method_bias Bias Enclosure Margins.
From Selfosc Require Claim_orbit_linear Claim_method_bias_alpha_linear Claim_method_bias_beta_linear.
From Selfosc Require Claim_method_bias_alpha_quadratic Claim_method_bias_beta_quadratic.
Open Scope R_scope.

(** * The printed formulas *)

Lemma size_is z : size_linear z = z - ln_1p (tanh z).
Proof. unfold size_linear. now rewrite tanh_once. Qed.

Lemma alpha_linear z : 0 < z ->
  16 * z * (sqrt (1 - (z - (tanh z)) ^ 2 / (z - (ln_1p ((tanh z)))) ^ 2)) / (PI ^ 3 * (1 - (ln_1p ((tanh z))) / z)) = error_alpha_linear z + 1.
Proof.
  intros Hz. pose proof (size_linear_positive z Hz) as S. pose proof PI_RGT_0. unfold error_alpha_linear. rewrite tanh_once. rewrite size_is in *.
  replace ((z - tanh z) ^ 2 / (z - ln_1p (tanh z)) ^ 2) with (((z - tanh z) / (z - ln_1p (tanh z))) ^ 2) by (unfold Rdiv; rewrite Rpow_mult_distr, pow_inv; reflexivity).
  set (q := sqrt _). set (l := ln _) in *. field. repeat split; lra.
Qed.

Lemma beta_linear z : 0 < z ->
  8 * (z - (tanh z)) / (PI ^ 2 * (z - (ln_1p ((tanh z)))) * (1 - (ln_1p ((tanh z))) / z)) = error_beta_linear z + 1.
Proof.
  intros Hz. pose proof (size_linear_positive z Hz) as S. pose proof PI_RGT_0. unfold error_beta_linear. rewrite tanh_once. rewrite size_is in *.
  set (t := tanh z) in *. set (l := ln _) in *. field. repeat split; lra.
Qed.

Lemma turn_is t : 0 < t -> 2 * (atan ((sqrt ((tanh t))))) + 2 * (ln_1p ((sqrt ((tanh t))))) + 2 * t - (ln_1p ((tanh t))) = 2 * turn t.
Proof.
  intros Ht. rewrite (turn_once t Ht). pose proof (exp_pos (2 * t)) as E.
  replace (1 + tanh t) with (exp (2 * t) / ((exp (2 * t) + 1) / 2)) by (field; lra).
  rewrite ln_div by lra. rewrite ln_exp. set (a := atan _). set (b := ln (1 + _)). field.
Qed.

Lemma alpha_quadratic t : 0 < t ->
  2 * (2 * (atan ((sqrt ((tanh t))))) + 2 * (ln_1p ((sqrt ((tanh t))))) + 2 * t - (ln_1p ((tanh t)))) ^ 2 *
    (sqrt (1 - (1 - (ln_1p ((tanh t))) / t) ^ 2)) / (PI ^ 3 * (sqrt t) ^ 2) = alpha_by_t t + 1.
Proof.
  intros Ht. pose proof PI_RGT_0. rewrite (turn_is t Ht). unfold alpha_by_t. rewrite size_is.
  replace (sqrt t ^ 2) with t by (rewrite <- Rsqr_pow2, Rsqr_sqrt; lra).
  replace (1 - ln_1p (tanh t) / t) with ((t - ln_1p (tanh t)) / t) by (field; lra).
  set (q := sqrt _). field. split; lra.
Qed.

Lemma beta_quadratic t : 0 < t ->
  3 * (2 * (atan ((sqrt ((tanh t))))) + 2 * (ln_1p ((sqrt ((tanh t))))) + 2 * t - (ln_1p ((tanh t)))) ^ 2 / (2 * PI ^ 2 * t * (sqrt t) ^ 2) -
  3 * (2 * (atan ((sqrt ((tanh t))))) + 2 * (ln_1p ((sqrt ((tanh t))))) + 2 * t - (ln_1p ((tanh t)))) ^ 2 * (ln_1p ((tanh t))) / (2 * PI ^ 2 * t ^ 2 * (sqrt t) ^ 2)
  = beta_by_t t + 1.
Proof.
  intros Ht. pose proof PI_RGT_0. rewrite (turn_is t Ht). unfold beta_by_t. rewrite size_is.
  replace (sqrt t ^ 2) with t by (rewrite <- Rsqr_pow2, Rsqr_sqrt; lra). set (l := ln _). field. split; lra.
Qed.

(** * Near zero and beyond *)

Lemma near_alpha_linear z : 0 < z <= 1 / 4 ->
  32 / PI ^ 3 - 1 - 32 / PI ^ 3 * z ^ 2 <= error_alpha_linear z <= 32 / PI ^ 3 - 1 + 32 / PI ^ 3 * z ^ 2.
Proof. intros Hz. pose proof (proj1 (Rabs_le_between _ _) (Claim_method_bias_alpha_linear.near z Hz)). lra. Qed.

Lemma near_beta_linear z : 0 < z <= 1 / 4 ->
  32 / (3 * PI ^ 2) - 1 - 8 / PI ^ 2 * (2 * z ^ 2) <= error_beta_linear z <= 8 / PI ^ 2 * ((2 + 2 * z ^ 2 / 5) * (2 / 3 + 2 * z ^ 2 / 15)) - 1.
Proof. intros Hz. destruct (Claim_method_bias_beta_linear.near z Hz) as [N U]. pose proof (proj1 (Rabs_le_between _ _) N). lra. Qed.

Lemma near_alpha_quadratic t : 0 < t <= 1 / 5 ->
  32 / PI ^ 3 - 1 - 8 / PI ^ 3 * (3 * t ^ 2) <= alpha_by_t t <= 32 / PI ^ 3 - 1 + 8 / PI ^ 3 * (3 * t ^ 2).
Proof. intros Ht. pose proof (proj1 (Rabs_le_between _ _) (Claim_method_bias_alpha_quadratic.near t Ht)). lra. Qed.

Lemma near_beta_quadratic t : 0 < t <= 1 / 5 -> 12 / PI ^ 2 - 1 - 6 / PI ^ 2 * (2 * t ^ 2) <= beta_by_t t <= 6 / PI ^ 2 * (2 + t ^ 4) - 1.
Proof. intros Ht. destruct (Claim_method_bias_beta_quadratic.near t Ht) as [N U]. pose proof (proj1 (Rabs_le_between _ _) N). lra. Qed.

(** The error v lies between two numbers; the margin is linear in it on either side of the centre. *)
Ltac at_ends :=
  match goal with N : ?low <= ?v <= ?high |- 0 < ?margin =>
    let g := eval pattern v in margin in
    match g with ?h _ =>
      first [apply Rlt_le_trans with (h high); [cbv beta; interval with (i_prec 60)|cbv beta; lra]
            |apply Rlt_le_trans with (h low); [cbv beta; interval with (i_prec 60)|cbv beta; lra]]
    end
  end.
Ltac sides := match goal with |- context [Rabs ?e] => unfold Rabs; destruct (Rcase_abs e) as [_|_] end.
Ltac beyond z := sides; first [interval with (i_prec 60, i_depth 4, i_bisect z)|interval with (i_prec 40, i_bisect z, i_taylor z, i_degree 6)].

(** * By the claims' uniform bounds, up to near the end of their range *)

Lemma linear_group z c : 0 < z <= c -> z - Rtrigo_def.tanh z <= c - Rtrigo_def.tanh c.
Proof. intros [H [L| ->]]; [left; apply Claim_orbit_linear.root_increases; lra|lra]. Qed.
Lemma quadratic_group t c : 0 < t <= c -> size_linear t <= size_linear c.
Proof. intros [H [L| ->]]; [left; apply size_increases; lra|lra]. Qed.
Ltac group z lemma value := intros H; apply lemma; [lra|]; apply Rle_trans with (1 := value z _ H); rewrite ?size_is, ?tanh_once; interval with (i_prec 40).

Lemma alpha_linear_one z : 0 < z <= 195 / 100 -> Rabs (error_alpha_linear z) < 5 / 100.
Proof. group z Claim_method_bias_alpha_linear.up_to_one linear_group. Qed.
Lemma alpha_linear_ten z : 0 < z <= 109 / 10 -> Rabs (error_alpha_linear z) < 48 / 100.
Proof. group z Claim_method_bias_alpha_linear.up_to_ten linear_group. Qed.
Lemma beta_linear_one z : 0 < z <= 195 / 100 -> Rabs (error_beta_linear z) < 9 / 100.
Proof. group z Claim_method_bias_beta_linear.up_to_one linear_group. Qed.
Lemma beta_linear_ten z : 0 < z <= 109 / 10 -> Rabs (error_beta_linear z) < 17 / 100.
Proof. group z Claim_method_bias_beta_linear.up_to_ten linear_group. Qed.
Lemma alpha_quadratic_one t : 0 < t <= 268 / 100 -> Rabs (alpha_by_t t) < 8 / 100.
Proof. group t Claim_method_bias_alpha_quadratic.up_to_one quadratic_group. Qed.
Lemma alpha_quadratic_ten t : 0 < t <= 206 / 10 -> Rabs (alpha_by_t t) < 53 / 100.
Proof. group t Claim_method_bias_alpha_quadratic.up_to_ten quadratic_group. Qed.
Lemma beta_quadratic_one t : 0 < t <= 268 / 100 -> Rabs (beta_by_t t) < 22 / 100.
Proof. group t Claim_method_bias_beta_quadratic.up_to_one quadratic_group. Qed.
Lemma beta_quadratic_ten t : 0 < t <= 206 / 10 -> Rabs (beta_by_t t) < 36 / 100.
Proof. group t Claim_method_bias_beta_quadratic.up_to_ten quadratic_group. Qed.

(** A curve about zero by its uniform bounds; another, and that whose radius as a double is below the claim's, near zero and beyond. *)
Tactic Notation "uniform" ident(z) constr(inner) uconstr(bound) tactic(unroll) :=
  match goal with |- context [Rabs (?v + 1 - 1)] =>
    replace (v + 1 - 1) with v by ring; destruct (Rle_lt_dec z inner);
    [pose proof (bound z ltac:(split; assumption)); lra|unroll; beyond z]
  end.
Tactic Notation "curve" ident(z) uconstr(printed) uconstr(near) constr(split) tactic(uniformly) tactic(unroll) :=
  let low := fresh in let high := fresh in
  intros z [low high]; assert (positive : 0 < z) by lra; rewrite (printed z positive);
  first [uniformly
        |destruct (Rle_lt_dec z split);
         [first [exfalso; lra|pose proof (near z ltac:(lra)); sides; at_ends]|first [exfalso; lra|unroll; beyond z]]].

Ltac unroll_alpha_linear := rewrite Claim_method_bias_alpha_linear.enclosed.
Ltac unroll_beta_linear := rewrite Claim_method_bias_beta_linear.enclosed.
Ltac unroll_alpha_quadratic := rewrite Claim_method_bias_alpha_quadratic.enclosed_is by assumption; Claim_method_bias_alpha_quadratic.enclose.
Ltac unroll_beta_quadratic := rewrite Claim_method_bias_beta_quadratic.enclosed_is by assumption; Claim_method_bias_beta_quadratic.enclose.

Tactic Notation "method_bias_alpha_linear" ident(z) :=
  curve z alpha_linear near_alpha_linear (1 / 8)
    (first [uniform z (109 / 10) alpha_linear_ten unroll_alpha_linear|uniform z (195 / 100) alpha_linear_one unroll_alpha_linear]) unroll_alpha_linear.
Tactic Notation "method_bias_beta_linear" ident(z) :=
  curve z beta_linear near_beta_linear (1 / 8)
    (first [uniform z (109 / 10) beta_linear_ten unroll_beta_linear|uniform z (195 / 100) beta_linear_one unroll_beta_linear]) unroll_beta_linear.
Tactic Notation "method_bias_alpha_quadratic" ident(t) :=
  curve t alpha_quadratic near_alpha_quadratic (1 / 5)
    (first [uniform t (206 / 10) alpha_quadratic_ten unroll_alpha_quadratic|uniform t (268 / 100) alpha_quadratic_one unroll_alpha_quadratic]) unroll_alpha_quadratic.
Tactic Notation "method_bias_beta_quadratic" ident(t) :=
  curve t beta_quadratic near_beta_quadratic (1 / 5)
    (first [uniform t (206 / 10) beta_quadratic_ten unroll_beta_quadratic|uniform t (268 / 100) beta_quadratic_one unroll_beta_quadratic]) unroll_beta_quadratic.
