(** claim: uncoupled-axis (eq. 6, Table 2)
    [alpha nu' + beta(nu) nu = delta + tau] with the entries of Table 2 gives an axis the acceleration that eq. 5 gives it: alpha is
    inertia and added mass; beta linear drag and quadratic drag times speed; delta the external force, and in heave weight less
    buoyancy with it. *)
From Coq Require Import Reals Lra Lia.
From Selfosc Require Import Common SixAxes.
Open Scope R_scope.

(** The axes of Table 2 among the six components: surge, sway, heave, yaw. *)
Definition of_table_2 (i : nat) : Prop := i = 0%nat \/ i = 1%nat \/ i = 2%nat \/ i = 5%nat.

(** Table 2. *)
Definition alpha (m : R) (I_o M_A : matrix) (i : nat) : R := (if Nat.ltb i 3 then m else I_o (i - 3)%nat (i - 3)%nat) + M_A i i.
Definition beta (linear_drag : matrix) (quadratic_drag : vector) (i : nat) (speed : R) : R := linear_drag i i + quadratic_drag i * Rabs speed.
Definition delta (W B : R) (tau_E : vector) (i : nat) : R := tau_E i + (if Nat.eqb i 2 then W - B else 0).

(** The row of eq. 5, and the uncoupled axis. *)
Definition row (m W B : R) (r_g r_b : vector) (I_o M_A linear_drag : matrix) (quadratic_drag : vector) (roll pitch : R) (nu nu' tau tau_E : vector) (i : nat) : Prop :=
  let M := plus (rigid_body m r_g I_o) M_A in
  times 6 M nu' i + times 6 (coriolis M nu) nu i + times 6 (drag_matrix linear_drag quadratic_drag nu) nu i + restoring W B r_g r_b roll pitch i = tau i + tau_E i.
Definition uncoupled (m W B : R) (I_o M_A linear_drag : matrix) (quadratic_drag : vector) (nu nu' tau tau_E : vector) (i : nat) : Prop :=
  alpha m I_o M_A i * nu' i + beta linear_drag quadratic_drag i (nu i) * nu i = delta W B tau_E i + tau i.

Definition origin : vector := fun _ => 0.

Theorem statement : forall (m W B : R) (r_b : vector) (I_o M_A linear_drag : matrix) (quadratic_drag : vector) (roll pitch : R) (r_g : vector)
  (nu nu' tau tau_E : vector) (i : nat), of_table_2 i ->
  (* the hypotheses others-at-rest, level, gravity-at-origin, axes-of-inertia, water-uncoupled *)
  (forall j, (j < 6)%nat -> j <> i -> nu j = 0) -> roll = 0 -> pitch = 0 -> (forall j, (j < 3)%nat -> r_g j = 0) ->
  (forall j k, (j < 3)%nat -> (k < 3)%nat -> j <> k -> I_o j k = 0) -> (forall j k, (j < 6)%nat -> (k < 6)%nat -> j <> k -> M_A j k = 0) ->
  row m W B r_g r_b I_o M_A linear_drag quadratic_drag roll pitch nu nu' tau tau_E i <-> uncoupled m W B I_o M_A linear_drag quadratic_drag nu nu' tau tau_E i.
Proof.
  intros m W B r_b I_o M_A Dl q roll pitch r_g nu nu' tau tau_E i Hi Rest -> -> G In Wa.
  assert (G0 := G 0%nat ltac:(lia)). assert (G1 := G 1%nat ltac:(lia)). assert (G2 := G 2%nat ltac:(lia)).
  assert (I01 : I_o 0%nat 1%nat = 0) by (apply In; lia). assert (I02 : I_o 0%nat 2%nat = 0) by (apply In; lia). assert (I10 : I_o 1%nat 0%nat = 0) by (apply In; lia).
  assert (I12 : I_o 1%nat 2%nat = 0) by (apply In; lia). assert (I20 : I_o 2%nat 0%nat = 0) by (apply In; lia). assert (I21 : I_o 2%nat 1%nat = 0) by (apply In; lia).
  unfold row, uncoupled, alpha, beta, delta, restoring, coriolis, times, blocks, opposite, cross, times, skew, linear, angular, drag_matrix, plus, rigid_body, blocks, diagonal, opposite, skew, down.
  destruct Hi as [->|[->|[->| ->]]]; simpl.
  - rewrite ?(Rest 1%nat), ?(Rest 2%nat), ?(Rest 3%nat), ?(Rest 4%nat), ?(Rest 5%nat) by lia. rewrite G0, G1, G2, ?sin_0, ?cos_0.
    rewrite ?(Wa 0%nat 1%nat), ?(Wa 0%nat 2%nat), ?(Wa 0%nat 3%nat), ?(Wa 0%nat 4%nat), ?(Wa 0%nat 5%nat) by lia. split; intros H; lra.
  - rewrite ?(Rest 0%nat), ?(Rest 2%nat), ?(Rest 3%nat), ?(Rest 4%nat), ?(Rest 5%nat) by lia. rewrite G0, G1, G2, ?sin_0, ?cos_0.
    rewrite ?(Wa 1%nat 0%nat), ?(Wa 1%nat 2%nat), ?(Wa 1%nat 3%nat), ?(Wa 1%nat 4%nat), ?(Wa 1%nat 5%nat) by lia. split; intros H; lra.
  - rewrite ?(Rest 0%nat), ?(Rest 1%nat), ?(Rest 3%nat), ?(Rest 4%nat), ?(Rest 5%nat) by lia. rewrite G0, G1, G2, ?sin_0, ?cos_0.
    rewrite ?(Wa 2%nat 0%nat), ?(Wa 2%nat 1%nat), ?(Wa 2%nat 3%nat), ?(Wa 2%nat 4%nat), ?(Wa 2%nat 5%nat) by lia. split; intros H; lra.
  - rewrite ?(Rest 0%nat), ?(Rest 1%nat), ?(Rest 2%nat), ?(Rest 3%nat), ?(Rest 4%nat) by lia. rewrite G0, G1, G2, I20, I21, ?sin_0, ?cos_0.
    rewrite ?(Wa 5%nat 0%nat), ?(Wa 5%nat 1%nat), ?(Wa 5%nat 2%nat), ?(Wa 5%nat 3%nat), ?(Wa 5%nat 4%nat) by lia. split; intros H; lra.
Qed.

(** * Without each hypothesis the two differ *)

Definition only (k : nat) (a : R) : vector := fun i => if Nat.eqb i k then a else 0.
Definition entry (j k : nat) (a : R) : matrix := fun i l => if Nat.eqb i j then if Nat.eqb l k then a else 0 else 0.
Definition zero : matrix := fun _ _ => 0.
Ltac compute_row := unfold row, uncoupled, alpha, beta, delta, restoring, coriolis, times, blocks, opposite, cross, times, skew, linear, angular, drag_matrix, plus,
  rigid_body, blocks, diagonal, opposite, skew, down, only, entry, zero, origin; simpl; rewrite ?sin_0, ?cos_0, ?sin_PI2, ?cos_PI2.

(** Ahead and sideways at once, added mass that differs: the water turns the vehicle. *)
Theorem needs_others_at_rest : exists nu tau, let M_A := entry 0 0 1 in
  row 1 0 0 origin origin (diagonal (fun _ => 1)) M_A zero origin 0 0 nu origin tau origin 5 /\
  ~ uncoupled 1 0 0 (diagonal (fun _ => 1)) M_A zero origin nu origin tau origin 5.
Proof. exists (fun i => if Nat.ltb i 2 then 1 else 0), (only 5 (-1)). compute_row. split; [|intros H]; lra. Qed.

(** Upright, weight pushes along surge. *)
Theorem needs_level : exists tau,
  row 1 1 0 origin origin (diagonal (fun _ => 1)) zero zero origin 0 (PI / 2) origin origin tau origin 0 /\
  ~ uncoupled 1 1 0 (diagonal (fun _ => 1)) zero zero origin origin origin tau origin 0.
Proof. exists (only 0 1). compute_row. split; [|intros H]; lra. Qed.

(** Centre of gravity below the origin: surge accelerates pitch, and pitch surge. *)
Theorem needs_gravity_at_origin : exists nu' tau, let r_g := only 2 1 in
  row 1 0 0 r_g origin (diagonal (fun _ => 2)) zero zero origin 0 0 origin nu' tau origin 0 /\
  ~ uncoupled 1 0 0 (diagonal (fun _ => 2)) zero zero origin origin nu' tau origin 0.
Proof. exists (only 4 1), (only 0 1). compute_row. split; [|intros H]; lra. Qed.

(** A product of inertia: roll accelerates yaw. *)
Theorem needs_axes_of_inertia : exists nu' tau, let I_o := entry 2 0 1 in
  row 1 0 0 origin origin I_o zero zero origin 0 0 origin nu' tau origin 5 /\
  ~ uncoupled 1 0 0 I_o zero zero origin origin nu' tau origin 5.
Proof. exists (only 3 1), (only 5 1). compute_row. split; [|intros H]; lra. Qed.

(** The same through the water. *)
Theorem needs_water_uncoupled : exists nu' tau, let M_A := entry 5 1 1 in
  row 1 0 0 origin origin (diagonal (fun _ => 1)) M_A zero origin 0 0 origin nu' tau origin 5 /\
  ~ uncoupled 1 0 0 (diagonal (fun _ => 1)) M_A zero origin origin nu' tau origin 5.
Proof. exists (only 1 1), (only 5 1). compute_row. split; [|intros H]; lra. Qed.

Print Assumptions statement.
