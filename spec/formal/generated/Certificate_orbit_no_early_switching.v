(** orbit-no-early-switching: Between two switchings the velocity changes sign once, beyond the relay's level: the command switches when the formulas say.
    The inequalities of its certificate, written by certificates.py: not to be edited. A number of the file is the double that it names:
    its dyadic value stands here. *)
From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Margins.
Open Scope R_scope.

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
