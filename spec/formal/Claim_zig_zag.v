(** claim: zig-zag (introduction)
    The ship's zig-zag test is the same experiment: the rudder goes to the other side when the heading has changed by a set angle, and
    Nomoto's first-order model [T r' + r = K delta_R] is the drag axis [alpha = T/K], [beta = 1/K] with the rudder as command. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

(** Inertia and drag of the axis by Nomoto's constants. *)
Definition alpha (T K : R) : R := T / K.
Definition beta (K : R) : R := 1 / K.

(** The zig-zag test: Nomoto's ship, and the rudder [+-delta_R] put over when the heading psi passes [+-psi_a]. *)
Definition zig_zag_test (T K delta_R psi_a : R) (psi r rudder : R -> R) : Prop :=
  (forall t, 0 < t -> is_derive psi t (r t)) /\ (forall t, 0 < t -> continuous r t) /\
  (forall t, 0 < t -> locally t (fun s => rudder s = rudder t) -> exists r', is_derive r t r' /\ T * r' + r t = K * rudder t) /\
  relay later delta_R psi_a (fun t => - psi t) rudder.

(** Nomoto's response from rest to a rudder held at d. *)
Definition response (T K d t : R) : R := K * d * (1 - exp (- (t / T))).

Theorem statement : forall T K : R, 0 < T -> 0 < K ->
  (* the test is the self-oscillation experiment on the axis *)
  (forall (delta_R psi_a : R) (psi r rudder : R -> R),
    zig_zag_test T K delta_R psi_a psi r rudder <-> relay_loop (alpha T K) (beta K) 0 0 delta_R psi_a psi r rudder) /\
  (* and the response to a rudder that is held is that of the axis *)
  (forall d t : R, exists r', is_derive (response T K d) t r' /\ T * r' + response T K d t = K * d /\
    alpha T K * r' + beta K * response T K d t = d).
Proof.
  intros T K HT HK. split.
  - intros delta_R psi_a psi r rudder. unfold zig_zag_test, relay_loop. split.
    + intros [P [R [N L]]]. split; [|exact L]. split; [exact P|exact R|].
      intros t Ht H. destruct (N t Ht H) as [r' [D E]]. 
      assert (Er : (rudder t + 0 - drag (beta K) 0 (r t)) / alpha T K = r').
      { unfold drag, alpha, beta. replace (rudder t) with ((T * r' + r t) / K) by (rewrite E; field; lra). field. lra. }
      rewrite Er. exact D.
    + intros [[P R N] L]. split; [exact P|]. split; [exact R|]. split; [|exact L].
      intros t Ht H. exists ((rudder t + 0 - drag (beta K) 0 (r t)) / alpha T K). split; [apply N; assumption|]. unfold drag, alpha, beta. field. lra.
  - intros d t. exists (K * d / T * exp (- (t / T))). split; [|split].
    + unfold response. auto_derive; [trivial|]. unfold Rdiv. set (e := exp _). field. lra.
    + unfold response. field. lra.
    + unfold response, alpha, beta. field. lra.
Qed.

(** With [beta = K] it is another equation. *)
Theorem not_beta_K : exists T K d t r' : R, 0 < T /\ 0 < K /\ is_derive (response T K d) t r' /\
  alpha T K * r' + K * response T K d t <> d.
Proof.
  exists 1, 2, 1, 1. destruct (proj2 (statement 1 2 ltac:(lra) ltac:(lra)) 1 1) as [r' [D [E F]]]. exists r'.
  split; [lra|split; [lra|split; [exact D|]]]. unfold alpha, beta in *. intros G.
  assert (P : 0 < response 1 2 1 1).
  { unfold response. pose proof (exp_increasing (- (1 / 1)) 0 ltac:(lra)) as X. rewrite exp_0 in X. lra. }
  lra.
Qed.

Print Assumptions statement.
