(** orbit-amplitude-monotone-linear: Linear drag: (X_m - x_a)/x_a falls as g grows, so that the amplitude identifies g.
    The inequalities of its certificate, written by certificates.py: not to be edited. A number of the file is the double that it names:
    its dyadic value stands here. *)
From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Margins.
Open Scope R_scope.

(** linear drag: the derivative of the relative overshoot, over tanh^3 z near zero, keeps its sign for tanh z <= 0.9 *)
Theorem linear_overshoot_weak : forall t : R, 0 <= t <= (8106479329266893 / 9007199254740992) ->
  (t <= (3602879701896397 / 72057594037927936) -> (70618703665 / 4611686018427387904) * t ^ 3 <= t ^ 2 - t * (ln_1p t) - (1 - t) * ((atanh t) - t)) /\ ((3602879701896397 / 72057594037927936) <= t -> (70618703665 / 4611686018427387904) <= t ^ 2 - t * (ln_1p t) - (1 - t) * ((atanh t) - t)).
Proof. over_power_of t. Qed.

(** linear drag: the derivative of the relative overshoot keeps its sign for tanh z >= 0.9 *)
Theorem linear_overshoot_strong : forall t : R, (8106479329266893 / 9007199254740992) <= t <= 1 ->
  (2249933991984817 / 36028797018963968) <= (2 * t - t * (ln_1p t) - (ln_1p t) - (sqrt (1 - t))) / 2.
Proof. value_of t. Qed.

(** exp(v) exceeds 2 v for v <= 1 *)
Theorem logarithm_low : forall v : R, 0 <= v <= 1 ->
  (263460615609591 / 2251799813685248) <= (exp v) - 2 * v.
Proof. value_of v. Qed.

(** exp(v) - 2 v grows for v >= 1 *)
Theorem logarithm_high : forall v : R, 1 <= v ->
  exists slope, is_derive (fun v : R => (exp v) - 2 * v) v slope /\ (1617426887497577 / 2251799813685248) <= slope.
Proof. slope_of v. Qed.

(** linear drag: z - tanh z over z^3 is positive for z <= 1/2 *)
Theorem linear_width_short : forall z : R, 0 <= z <= (1 / 2) ->
  (1149291619034355 / 18014398509481984) * z ^ 3 <= z - (tanh z).
Proof. over_power_of z. Qed.

(** linear drag: z - tanh z grows for z >= 1/2 *)
Theorem linear_width_long : forall z : R, (1 / 2) <= z ->
  exists slope, is_derive (fun z : R => z - (tanh z)) z slope /\ (1923507820477547 / 9007199254740992) <= slope.
Proof. slope_of z. Qed.
