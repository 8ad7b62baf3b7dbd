(** orbit-quadratic-disturbed: Quadratic drag with a disturbance: one limit cycle, reached from every start.
    The inequalities of its certificate, written by certificates.py: not to be edited. A number of the file is the double that it names:
    its dyadic value stands here. *)
From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Margins.
Open Scope R_scope.

(** the excess of the slope's denominator over its numerator grows with the drag at the upper switching, at a rate above 1.99 *)
Theorem excess_first : forall mu d_1 d_2 : R, -1 <= mu <= 1 -> 0 <= d_1 <= 2 -> 0 <= d_2 <= 2 ->
  exists slope, is_derive (fun d_1 : R => (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - (8962163258467287 / 4503599627370496) * d_1 - (8962163258467287 / 4503599627370496) * d_2) d_1 slope /\ (45035996273705 / 4503599627370496) <= slope.
Proof. slope_of mu d_1 d_2. Qed.

(** the excess of the slope's denominator over its numerator grows with the drag at the lower switching, at a rate above 1.99 *)
Theorem excess_second : forall mu d_1 d_2 : R, -1 <= mu <= 1 -> 0 <= d_1 <= 2 -> 0 <= d_2 <= 2 ->
  exists slope, is_derive (fun d_2 : R => (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - (8962163258467287 / 4503599627370496) * d_1 - (8962163258467287 / 4503599627370496) * d_2) d_2 slope /\ (45035996273705 / 4503599627370496) <= slope.
Proof. slope_of mu d_1 d_2. Qed.

(** 0.48 times the slope's denominator is below 1.99 *)
Theorem denominator : forall mu s_1 s_2 : R, -1 <= mu <= 1 -> 0 <= s_1 <= 1 -> 0 <= s_2 <= 1 ->
  (5497558139 / 2251799813685248) <= (8962163258467287 / 4503599627370496) - 12 * (1 - mu + s_1 + mu * s_1) * (1 + mu + s_2 - mu * s_2) / 25.
Proof. value_of mu s_1 s_2. Qed.

(** drag leaves force up to half the terminal speed *)
Theorem force_slow : forall speed linear_share : R, 0 <= speed <= (1 / 2) -> 0 <= linear_share <= 1 ->
  (1 / 4) <= 1 - linear_share * speed - speed ^ 2 + linear_share * speed ^ 2.
Proof. value_of speed linear_share. Qed.

(** the force that drag leaves falls from half the terminal speed to all of it *)
Theorem force_fast : forall speed linear_share : R, (1 / 2) <= speed <= 1 -> 0 <= linear_share <= 1 ->
  exists slope, is_derive (fun speed : R => linear_share * speed - 1 + speed ^ 2 - linear_share * speed ^ 2) speed slope /\ (1 / 4) <= slope.
Proof. slope_of speed linear_share. Qed.

(** the force that brakes after a switching falls as the disturbance grows, up to that of the relay's level *)
Theorem braking : forall mu drag : R, -1 <= mu <= 1 -> 0 <= drag <= 2 ->
  exists slope, is_derive (fun mu : R => mu - 1 - drag) mu slope /\ 1 <= slope.
Proof. slope_of mu drag. Qed.

(** the force that brakes after a switching grows with the drag *)
Theorem braking_drag : forall mu drag : R, -1 <= mu <= 1 -> 0 <= drag <= 2 ->
  exists slope, is_derive (fun drag : R => 1 - mu + drag) drag slope /\ 1 <= slope.
Proof. slope_of mu drag. Qed.
