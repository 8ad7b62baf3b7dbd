(** claim: allocation (eq. 35)
    Two parallel thrusters at [+-d] from the vehicle's axis give the force [X = tau_1 + tau_2] and the moment [N = d (tau_1 - tau_2)];
    [tau_1 = (X + N/d)/2] and [tau_2 = (X - N/d)/2] are the only thrusts that give them. *)
From Coq Require Import Reals Lra.
Open Scope R_scope.

(** Force and moment by thrusts, and back, as the program has them. *)
Definition forces (d : R) (tau : R * R) : R * R := (fst tau + snd tau, d * fst tau - d * snd tau).
Definition thrusts (d : R) (f : R * R) : R * R := (1 / 2 * fst f + 1 / 2 / d * snd f, 1 / 2 * fst f - 1 / 2 / d * snd f).

Theorem statement : forall d X N : R, 0 < d ->
  thrusts d (X, N) = ((X + N / d) / 2, (X - N / d) / 2) /\
  forall tau_1 tau_2 : R, (tau_1 + tau_2 = X /\ d * (tau_1 - tau_2) = N) <-> (tau_1, tau_2) = thrusts d (X, N).
Proof.
  intros d X N Hd. unfold thrusts, fst, snd. split.
  - f_equal; field; lra.
  - intros t1 t2. split.
    + intros [<- <-]. f_equal; field; lra.
    + intros E. injection E as -> ->. split; field; lra.
Qed.

(** As matrices: either undoes the other. *)
Theorem inverse : forall (d : R) (p : R * R), 0 < d -> forces d (thrusts d p) = p /\ thrusts d (forces d p) = p.
Proof. intros d [a b] Hd. unfold forces, thrusts, fst, snd. split; f_equal; field; lra. Qed.

(** Two thrusters in one line turn nothing: no thrusts give a moment, and many give a force. *)
Theorem needs_arm_positive : (forall tau, snd (forces 0 tau) = 0) /\ forces 0 (1, 0) = forces 0 (0, 1).
Proof. unfold forces, fst, snd. split; [intros [a b]; ring|f_equal; ring]. Qed.

(** With the thrusters exchanged the moment has the other sign. *)
Theorem thrusters_exchanged : forall d : R, 0 < d -> forces d (1, 0) <> forces d (0, 1).
Proof. intros d Hd E. injection E as E. lra. Qed.

Print Assumptions statement.
