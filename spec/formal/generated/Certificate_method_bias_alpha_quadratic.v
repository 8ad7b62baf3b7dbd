(** method-bias-alpha-quadratic: Quadratic drag: the method's error of alpha is +3.2 % as g goes to 0, -6.5 % at 1, +52 % at 10.
    The inequalities of its certificate, written by certificates.py: not to be edited. A number of the file is the double that it names:
    its dyadic value stands here. *)
From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Margins Curves.
Open Scope R_scope.

(** the relative error is within 0.08 of 0.0 *)
Theorem up_to_one : forall coordinate : R, 0 < coordinate <= (3039929748475085 / 1125899906842624) ->
  0 < 2 / 25 - (Rabs (2 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 * (sqrt (1 - (1 - (ln_1p ((tanh coordinate))) / coordinate) ^ 2)) / (PI ^ 3 * (sqrt coordinate) ^ 2) - 1)).
Proof. method_bias_alpha_quadratic coordinate. Qed.

(** the relative error is within 0.53 of 0.0 *)
Theorem up_to_ten : forall coordinate : R, 0 < coordinate <= (5826532017910579 / 281474976710656) ->
  0 < (2386907802506363 / 4503599627370496) - (Rabs (2 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 * (sqrt (1 - (1 - (ln_1p ((tanh coordinate))) / coordinate) ^ 2)) / (PI ^ 3 * (sqrt coordinate) ^ 2) - 1)).
Proof. method_bias_alpha_quadratic coordinate. Qed.

(** the relative error is within 0.002 of 0.032 *)
Theorem at_zero : forall coordinate : R, 0 < coordinate <= (5764607523034235 / 576460752303423488) ->
  0 < (1152921504606847 / 576460752303423488) * (1 - 500 * (Rabs (2 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 * (sqrt (1 - (1 - (ln_1p ((tanh coordinate))) / coordinate) ^ 2)) / (PI ^ 3 * (sqrt coordinate) ^ 2) - (290482175965397 / 281474976710656)))).
Proof. method_bias_alpha_quadratic coordinate. Qed.

(** the relative error is within 0.006 of -0.065 *)
Theorem at_one : forall coordinate : R, (6034823500676465 / 2251799813685248) <= coordinate <= (3039929748475085 / 1125899906842624) ->
  0 < (3458764513820541 / 576460752303423488) - (Rabs (2 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 * (sqrt (1 - (1 - (ln_1p ((tanh coordinate))) / coordinate) ^ 2)) / (PI ^ 3 * (sqrt coordinate) ^ 2) - (2105432825795707 / 2251799813685248))).
Proof. method_bias_alpha_quadratic coordinate. Qed.

(** the relative error is within 0.006 of 0.52 *)
Theorem at_ten : forall coordinate : R, (2910451259188183 / 140737488355328) <= coordinate <= (5826532017910579 / 281474976710656) ->
  0 < (3458764513820541 / 576460752303423488) - (Rabs (2 * (2 * (atan ((sqrt ((tanh coordinate))))) + 2 * (ln_1p ((sqrt ((tanh coordinate))))) + 2 * coordinate - (ln_1p ((tanh coordinate)))) ^ 2 * (sqrt (1 - (1 - (ln_1p ((tanh coordinate))) / coordinate) ^ 2)) / (PI ^ 3 * (sqrt coordinate) ^ 2) - 38 / 25)).
Proof. method_bias_alpha_quadratic coordinate. Qed.
