(** method-bias-alpha-linear: Linear drag: the method's error of alpha is +3.2 % as g goes to 0, -3 % at 1, +47 % at 10, below 5 % for g <= 1.
    The inequalities of its certificate, written by certificates.py: not to be edited. A number of the file is the double that it names:
    its dyadic value stands here. *)
From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Margins Curves.
Open Scope R_scope.

(** the relative error is within 0.05 of 0.0 *)
Theorem up_to_one : forall coordinate : R, 0 < coordinate <= (8872091265919877 / 4503599627370496) ->
  0 < (1 - 20 * (Rabs (16 * coordinate * (sqrt (1 - (coordinate - (tanh coordinate)) ^ 2 / (coordinate - (ln_1p ((tanh coordinate)))) ^ 2)) / (PI ^ 3 * (1 - (ln_1p ((tanh coordinate))) / coordinate)) - 1))) / 20.
Proof. method_bias_alpha_linear coordinate. Qed.

(** the relative error is within 0.48 of 0.0 *)
Theorem up_to_ten : forall coordinate : R, 0 < coordinate <= 11 ->
  0 < 12 / 25 - (Rabs (16 * coordinate * (sqrt (1 - (coordinate - (tanh coordinate)) ^ 2 / (coordinate - (ln_1p ((tanh coordinate)))) ^ 2)) / (PI ^ 3 * (1 - (ln_1p ((tanh coordinate))) / coordinate)) - 1)).
Proof. method_bias_alpha_linear coordinate. Qed.

(** the relative error is within 0.002 of 0.032 *)
Theorem at_zero : forall coordinate : R, 0 < coordinate <= (5764607523034235 / 576460752303423488) ->
  0 < (1152921504606847 / 576460752303423488) * (1 - 500 * (Rabs (16 * coordinate * (sqrt (1 - (coordinate - (tanh coordinate)) ^ 2 / (coordinate - (ln_1p ((tanh coordinate)))) ^ 2)) / (PI ^ 3 * (1 - (ln_1p ((tanh coordinate))) / coordinate)) - (290482175965397 / 281474976710656)))).
Proof. method_bias_alpha_linear coordinate. Qed.

(** the relative error is within 0.006 of -0.03 *)
Theorem at_one : forall coordinate : R, (8782019273372467 / 4503599627370496) <= coordinate <= (8872091265919877 / 4503599627370496) ->
  0 < (3458764513820541 / 576460752303423488) - (Rabs (16 * coordinate * (sqrt (1 - (coordinate - (tanh coordinate)) ^ 2 / (coordinate - (ln_1p ((tanh coordinate)))) ^ 2)) / (PI ^ 3 * (1 - (ln_1p ((tanh coordinate))) / coordinate)) - (4368491638549381 / 4503599627370496))).
Proof. method_bias_alpha_linear coordinate. Qed.

(** the relative error is within 0.006 of 0.47 *)
Theorem at_ten : forall coordinate : R, (6186819988100219 / 562949953421312) <= coordinate <= 11 ->
  0 < (3458764513820541 / 576460752303423488) - (Rabs (16 * coordinate * (sqrt (1 - (coordinate - (tanh coordinate)) ^ 2 / (coordinate - (ln_1p ((tanh coordinate)))) ^ 2)) / (PI ^ 3 * (1 - (ln_1p ((tanh coordinate))) / coordinate)) - (6620291452234629 / 4503599627370496))).
Proof. method_bias_alpha_linear coordinate. Qed.
