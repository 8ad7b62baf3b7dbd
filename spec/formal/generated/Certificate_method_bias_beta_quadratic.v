(** method-bias-beta-quadratic: Quadratic drag: the method's error of beta_xx is +22 % as g goes to 0, -9 % at 1, -35 % at 10, below 36 % up to there.
    The inequalities of its certificate, written by certificates.py: not to be edited. A number of the file is the double that it names:
    its dyadic value stands here. *)
From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Margins Curves.
Open Scope R_scope.

(** the relative error is within 0.22 of 0.0 *)
Theorem up_to_one : forall coordinate : R, 0 < coordinate <= (3039929748475085 / 1125899906842624) ->
  0 < 11 / 50 - (Rabs (3 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 / (2 * PI ^ 2 * coordinate * (sqrt coordinate) ^ 2) - 3 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 * (ln_1p ((tanh coordinate))) / (2 * PI ^ 2 * coordinate ^ 2 * (sqrt coordinate) ^ 2) - 1)).
Proof. method_bias_beta_quadratic coordinate. Qed.

(** the relative error is within 0.36 of 0.0 *)
Theorem up_to_ten : forall coordinate : R, 0 < coordinate <= (5826532017910579 / 281474976710656) ->
  0 < 9 / 25 - (Rabs (3 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 / (2 * PI ^ 2 * coordinate * (sqrt coordinate) ^ 2) - 3 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 * (ln_1p ((tanh coordinate))) / (2 * PI ^ 2 * coordinate ^ 2 * (sqrt coordinate) ^ 2) - 1)).
Proof. method_bias_beta_quadratic coordinate. Qed.

(** the relative error is within 0.002 of 0.2158 *)
Theorem at_zero : forall coordinate : R, 0 < coordinate <= (5764607523034235 / 576460752303423488) ->
  0 < (1152921504606847 / 576460752303423488) * (1 - 500 * (Rabs (3 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 / (2 * PI ^ 2 * coordinate * (sqrt coordinate) ^ 2) - 3 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 * (ln_1p ((tanh coordinate))) / (2 * PI ^ 2 * coordinate ^ 2 * (sqrt coordinate) ^ 2) - (5475476426957049 / 4503599627370496)))).
Proof. method_bias_beta_quadratic coordinate. Qed.

(** the relative error is within 0.006 of -0.088 *)
Theorem at_one : forall coordinate : R, (6034823500676465 / 2251799813685248) <= coordinate <= (3039929748475085 / 1125899906842624) ->
  0 < (3458764513820541 / 576460752303423488) - (Rabs (3 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 / (2 * PI ^ 2 * coordinate * (sqrt coordinate) ^ 2) - 3 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 * (ln_1p ((tanh coordinate))) / (2 * PI ^ 2 * coordinate ^ 2 * (sqrt coordinate) ^ 2) - (8214565720323785 / 9007199254740992))).
Proof. method_bias_beta_quadratic coordinate. Qed.

(** the relative error is within 0.006 of -0.346 *)
Theorem at_ten : forall coordinate : R, (2910451259188183 / 140737488355328) <= coordinate <= (5826532017910579 / 281474976710656) ->
  0 < (3458764513820541 / 576460752303423488) - (Rabs (3 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 / (2 * PI ^ 2 * coordinate * (sqrt coordinate) ^ 2) - 3 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 * (ln_1p ((tanh coordinate))) / (2 * PI ^ 2 * coordinate ^ 2 * (sqrt coordinate) ^ 2) - (5890708312600609 / 9007199254740992))).
Proof. method_bias_beta_quadratic coordinate. Qed.
