(** orbit-amplitude-monotone-quadratic: Quadratic drag: (X_m - x_a)/x_a falls as g grows, so that the amplitude identifies g.
    The inequalities of its certificate, written by certificates.py: not to be edited. A number of the file is the double that it names:
    its dyadic value stands here. *)
From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Margins.
Open Scope R_scope.

(** quadratic drag: the derivative of the relative overshoot, over y*^2 near zero, keeps its sign for y* <= 0.9 *)
Theorem quadratic_overshoot_weak : forall r : R, 0 <= r <= (8106479329266893 / 9007199254740992) ->
  (r <= (3602879701896397 / 72057594037927936) -> (13215451387 / 9007199254740992) * r ^ 2 <= (ln_1p r) + r * (ln_1p r) + (ln_1p (- r)) - r * (ln_1p (- r))) /\ ((3602879701896397 / 72057594037927936) <= r -> (13215451387 / 9007199254740992) <= (ln_1p r) + r * (ln_1p r) + (ln_1p (- r)) - r * (ln_1p (- r))).
Proof. over_power_of r. Qed.

(** quadratic drag: the derivative of the relative overshoot keeps its sign for y* >= 0.9 *)
Theorem quadratic_overshoot_strong : forall r : R, (8106479329266893 / 9007199254740992) <= r <= 1 ->
  (508509662965967 / 562949953421312) <= (ln_1p r) + r * (ln_1p r) - (sqrt (1 - r)).
Proof. value_of r. Qed.

(** exp(v) exceeds 2 v for v <= 1 *)
Theorem logarithm_low : forall v : R, 0 <= v <= 1 ->
  (263460615609591 / 2251799813685248) <= (exp v) - 2 * v.
Proof. value_of v. Qed.

(** exp(v) - 2 v grows for v >= 1 *)
Theorem logarithm_high : forall v : R, 1 <= v ->
  exists slope, is_derive (fun v : R => (exp v) - 2 * v) v slope /\ (1617426887497577 / 2251799813685248) <= slope.
Proof. slope_of v. Qed.
