(** method-bias-beta-linear: Linear drag: the method's error of beta is +8 % as g goes to 0, -4 % at 1, -16 % at 10, below 17 % up to there.
    The inequalities of its certificate, written by certificates.py: not to be edited. A number of the file is the double that it names:
    its dyadic value stands here. *)
From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Margins Curves.
Open Scope R_scope.

(** the relative error is within 0.09 of 0.0 *)
Theorem up_to_one : forall coordinate : R, 0 < coordinate <= (8872091265919877 / 4503599627370496) ->
  0 < (3242591731706757 / 36028797018963968) - (Rabs (8 * (coordinate - (tanh coordinate)) / (PI ^ 2 * (coordinate - (ln_1p ((tanh coordinate)))) * (1 - (ln_1p ((tanh coordinate))) / coordinate)) - 1)).
Proof. method_bias_beta_linear coordinate. Qed.

(** the relative error is within 0.17 of 0.0 *)
Theorem up_to_ten : forall coordinate : R, 0 < coordinate <= 11 ->
  0 < (6124895493223875 / 36028797018963968) - (Rabs (8 * (coordinate - (tanh coordinate)) / (PI ^ 2 * (coordinate - (ln_1p ((tanh coordinate)))) * (1 - (ln_1p ((tanh coordinate))) / coordinate)) - 1)).
Proof. method_bias_beta_linear coordinate. Qed.

(** the relative error is within 0.002 of 0.0808 *)
Theorem at_zero : forall coordinate : R, 0 < coordinate <= (5764607523034235 / 576460752303423488) ->
  0 < (1152921504606847 / 576460752303423488) * (1 - 500 * (Rabs (8 * (coordinate - (tanh coordinate)) / (PI ^ 2 * (coordinate - (ln_1p ((tanh coordinate)))) * (1 - (ln_1p ((tanh coordinate))) / coordinate)) - (304218154828877 / 281474976710656)))).
Proof. method_bias_beta_linear coordinate. Qed.

(** the relative error is within 0.006 of -0.041 *)
Theorem at_one : forall coordinate : R, (8782019273372467 / 4503599627370496) <= coordinate <= (8872091265919877 / 4503599627370496) ->
  0 < (3458764513820541 / 576460752303423488) - (Rabs (8 * (coordinate - (tanh coordinate)) / (PI ^ 2 * (coordinate - (ln_1p ((tanh coordinate)))) * (1 - (ln_1p ((tanh coordinate))) / coordinate)) - (8637904085296611 / 9007199254740992))).
Proof. method_bias_beta_linear coordinate. Qed.

(** the relative error is within 0.006 of -0.16 *)
Theorem at_ten : forall coordinate : R, (6186819988100219 / 562949953421312) <= coordinate <= 11 ->
  0 < (3458764513820541 / 576460752303423488) - (Rabs (8 * (coordinate - (tanh coordinate)) / (PI ^ 2 * (coordinate - (ln_1p ((tanh coordinate)))) * (1 - (ln_1p ((tanh coordinate))) / coordinate)) - 21 / 25)).
Proof. method_bias_beta_linear coordinate. Qed.
