(** claim: heave (eq. 43)
    Heave is the axis of eq. 36 with [tau_ZE + W - B] for its disturbance. So the experiment weighs the vehicle in water: with linear
    drag the times at either command give [tau_ZE + W - B] exactly. *)
From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common SixAxes Times Cycle.
From Selfosc Require Claim_uncoupled_axis Claim_delta_from_times.
Open Scope R_scope.

(** The axis of eq. 36. *)
Definition eq_36 (alpha beta_1 beta_2 delta speed rate tau : R) : Prop := alpha * rate + (beta_1 + beta_2 * Rabs speed) * speed = delta + tau.

(** A vehicle of Table 2's form, level, the other axes at rest: its parameters, and its motion at the instants after the start. *)
Section Vehicle.
Variables m W B : R.
Variables r_b : vector.
Variables I_o M_A linear_drag : matrix.
Variables quadratic_drag tau_E : vector.
Hypotheses (HI : forall j k, (j < 3)%nat -> (k < 3)%nat -> j <> k -> I_o j k = 0)
  (HM : forall j k, (j < 6)%nat -> (k < 6)%nat -> j <> k -> M_A j k = 0).

Let row roll pitch nu nu' tau := Claim_uncoupled_axis.row m W B (fun _ => 0) r_b I_o M_A linear_drag quadratic_drag roll pitch nu nu' tau tau_E 2.

Lemma heave_is nu nu' tau : (forall j, (j < 6)%nat -> j <> 2%nat -> nu j = 0) ->
  row 0 0 nu nu' tau <-> eq_36 (m + M_A 2%nat 2%nat) (linear_drag 2%nat 2%nat) (quadratic_drag 2%nat) (tau_E 2%nat + (W - B)) (nu 2%nat) (nu' 2%nat) (tau 2%nat).
Proof.
  intros Rest. unfold row. rewrite (Claim_uncoupled_axis.statement m W B r_b I_o M_A linear_drag quadratic_drag 0 0 (fun _ => 0) nu nu' tau tau_E 2)
    by (try assumption; try reflexivity; unfold Claim_uncoupled_axis.of_table_2; tauto).
  unfold Claim_uncoupled_axis.uncoupled, Claim_uncoupled_axis.alpha, Claim_uncoupled_axis.beta, Claim_uncoupled_axis.delta, eq_36. simpl. reflexivity.
Qed.
End Vehicle.

Theorem statement : forall (m W B : R) (r_b : vector) (I_o M_A linear_drag : matrix) (quadratic_drag tau_E : vector),
  (forall j k, (j < 3)%nat -> (k < 3)%nat -> j <> k -> I_o j k = 0) -> (forall j k, (j < 6)%nat -> (k < 6)%nat -> j <> k -> M_A j k = 0) ->
  let row := fun roll pitch nu nu' tau => Claim_uncoupled_axis.row m W B (fun _ => 0) r_b I_o M_A linear_drag quadratic_drag roll pitch nu nu' tau tau_E 2 in
  (* heave by eq. 5 is eq. 36 with that disturbance *)
  (forall roll pitch nu nu' tau, roll = 0 -> pitch = 0 -> (forall j, (j < 6)%nat -> j <> 2%nat -> nu j = 0) ->
    row roll pitch nu nu' tau <-> eq_36 (m + M_A 2%nat 2%nat) (linear_drag 2%nat 2%nat) (quadratic_drag 2%nat) (tau_E 2%nat + (W - B)) (nu 2%nat) (nu' 2%nat) (tau 2%nat)) /\
  (* and with linear drag the times weigh the vehicle: over any motion that comes back, whatever the delay of the command y *)
  (quadratic_drag 2%nat = 0 -> 0 < m + M_A 2%nat 2%nat ->
   forall (C T_d T a t_plus t_minus : R) (y z : R -> R) (nu : R -> vector),
   (forall t j, (j < 6)%nat -> j <> 2%nat -> nu t j = 0) ->
   (forall t, 0 < t -> is_derive z t (nu t 2%nat)) -> (forall t, 0 < t -> continuous (fun t => nu t 2%nat) t) ->
   (forall t, 0 < t -> locally t (fun s => y (s - T_d) = y (t - T_d)) -> exists nu', is_derive (fun t => nu t 2%nat) t (nu' 2%nat) /\
      row 0 0 (nu t) nu' (fun i => if Nat.eqb i 2 then y (t - T_d) else 0)) ->
   0 < a + T_d -> 0 < T -> z (a + T_d + T) = z (a + T_d) -> nu (a + T_d + T) 2%nat = nu (a + T_d) 2%nat ->
   held C y a (a + T) t_plus t_minus ->
   tau_E 2%nat + W - B = delta_of_times C t_plus t_minus T).
Proof.
  intros m W B r_b I_o M_A Dl q tau_E HI HM row. split.
  - intros roll pitch nu nu' tau -> -> Rest. apply heave_is; assumption.
  - intros Q Al C T_d T a p n y z nu Rest Z V N Sa HT Cz Cv H.
    replace (tau_E 2%nat + W - B) with (tau_E 2%nat + (W - B)) by ring.
    apply (Claim_delta_from_times.statement 0 (m + M_A 2%nat 2%nat) (Dl 2%nat 2%nat) (tau_E 2%nat + (W - B)) C T_d a T p n y z (fun t => nu t 2%nat));
      try assumption; [lra|]. split; [exact Z|exact V|].
    intros t Ht Loc. destruct (N t Ht Loc) as [nu' [D R]].
    apply (heave_is m W B r_b I_o M_A Dl q tau_E HI HM (nu t) nu') in R; [|intros j Hj Nj; apply Rest; assumption].
    unfold eq_36 in R. simpl in R. rewrite Q in R.
    replace ((y (t - T_d) + (tau_E 2%nat + (W - B)) - drag (Dl 2%nat 2%nat) 0 (nu t 2%nat)) / (m + M_A 2%nat 2%nat)) with (nu' 2%nat); [exact D|].
    apply (Rmult_eq_reg_r (m + M_A 2%nat 2%nat)); [|lra]. unfold drag. field_simplify; lra.
Qed.

(** Off the vertical the axis feels less of weight and buoyancy. *)
Theorem needs_level : forall W B roll pitch, W <> B -> cos roll * cos pitch <> 1 ->
  restoring W B (fun _ => 0) (fun _ => 0) roll pitch 2%nat <> - (W - B).
Proof.
  intros W B roll pitch D N H. unfold restoring, down in H. simpl in H. apply N. apply (Rmult_eq_reg_l (W - B)); lra.
Qed.

(** With quadratic drag the times do not give the disturbance. *)
Theorem needs_linear_drag : exists (x_a T t_plus t_minus a : R) (x v u : R -> R),
  relay_loop 1 0 1 (1 / 2) 1 x_a x v u /\ repeats T x v u /\ 0 < a /\ held 1 u a (a + T) t_plus t_minus /\
  delta_of_times 1 t_plus t_minus T < 1 / 2 - 1 / 50.
Proof. exact Claim_delta_from_times.as_printed_false. Qed.

(** Beyond the level the vehicle sinks against the command: a motion that never comes back. *)
Theorem needs_within_relay : forall alpha beta C x_a delta : R, 0 < alpha -> 0 < beta -> 0 < x_a -> C <= delta ->
  exists x v u, relay_loop alpha beta 0 delta C x_a x v u /\ forall t, 0 < t -> x_a < x t.
Proof. intros. apply drifts_away; lra || assumption. Qed.

Print Assumptions statement.
