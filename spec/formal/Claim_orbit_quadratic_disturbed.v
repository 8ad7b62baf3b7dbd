(** claim: orbit-quadratic-disturbed (of this project)
    The axis with quadratic drag and a constant force delta under a relay [+-C] with hysteresis [x_a] has exactly one limit cycle whatever
    the positive numbers alpha, beta, C, [x_a], as long as [abs(delta) < C]; every start reaches it. *)
From Coq Require Import Reals Lra.
From Selfosc Require Import Common Cycle.
Open Scope R_scope.

Theorem statement : forall alpha beta C x_a delta : R, 0 < alpha -> 0 < beta -> 0 < C -> 0 < x_a ->
  (* the hypothesis disturbance-below-level *)
  Rabs delta < C ->
  exists T X V U, limit_cycle alpha 0 beta delta C x_a T X V U.
Proof. intros. apply one_cycle; lra || assumption. Qed.

(** At the level and above, one command no longer turns the axis: a motion never comes back. *)
Theorem needs_disturbance_below_level : forall alpha beta C x_a delta : R, 0 < alpha -> 0 < beta -> 0 < x_a -> C <= delta ->
  exists x v u, relay_loop alpha 0 beta delta C x_a x v u /\ forall t, 0 < t -> x_a < x t.
Proof. intros. apply drifts_away; lra || assumption. Qed.

Print Assumptions statement.
