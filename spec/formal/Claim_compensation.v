(** claim: compensation (Fig. 11)
    The inverse allocation, a constant added to each thrust, and the inverse thruster maps, put before thrusters and allocation, leave
    the force that was asked for plus a constant: what the constants push along the axes. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Thruster Claim_allocation.
Open Scope R_scope.

(** Commands for a force and a moment, by any way to a command from a thrust, and what thrusters then deliver. *)
Definition commands (find : thruster -> R -> R) (d : R) (known : thruster * thruster) (offset asked : R * R) : R * R :=
  let tau := thrusts d asked in (find (fst known) (fst tau + fst offset), find (snd known) (snd tau + snd offset)).
Definition delivered (d : R) (actual : thruster * thruster) (c : R * R) : R * R :=
  forces d (thrust (fst actual) (fst c), thrust (snd actual) (snd c)).

(** A thrust that the thruster can be asked for: none, or one that some command gives. *)
Definition available (t : thruster) (T : R) : Prop := T = 0 \/ reaches t T.
Definition sound (t : thruster) : Prop := grows (forward t) /\ grows (backward t).

Lemma available_thrust (t : thruster) (T : R) : sound t -> available t T -> thrust t (command t T) = T.
Proof.
  intros [F B] [->|A]; [|exact (proj2 (thrust_found t T F B A))].
  unfold command. destruct (Req_EM_T 0 0); [|lra]. unfold thrust, side_thrust. destruct (Rlt_dec 0 0); [lra|].
  pose proof (magnitudes _ F). destruct (Rlt_dec 0 (dead_zone (forward t))); [reflexivity|]. rewrite Rmin_left by lra. unfold curve. ring.
Qed.

(** The hypotheses within-limits and outside-dead-zone are [available]; same-thrusters is that one pair stands at both places. *)
Theorem statement : forall (d : R) (thrusters : thruster * thruster) (offset asked : R * R), 0 < d ->
  sound (fst thrusters) -> sound (snd thrusters) ->
  available (fst thrusters) (fst (thrusts d asked) + fst offset) ->
  available (snd thrusters) (snd (thrusts d asked) + snd offset) ->
  let constant := forces d offset in
  delivered d thrusters (commands command d thrusters offset asked) = (fst asked + fst constant, snd asked + snd constant).
Proof.
  intros d [t1 t2] [o1 o2] [X N] Hd S1 S2 A1 A2 constant. unfold delivered, commands, constant. simpl in *.
  rewrite !available_thrust by assumption. unfold forces, thrusts. simpl. f_equal; field; lra.
Qed.

(** No offset of two thrusters is free: only none pushes along neither axis. *)
Theorem no_offset_is_free : forall (d : R) (offset : R * R), 0 < d -> (forces d offset = (0, 0) <-> offset = (0, 0)).
Proof.
  intros d [a b] Hd. unfold forces. simpl. split; intros E; injection E as E1 E2; [|subst; f_equal; ring].
  assert (a - b = 0) by (apply (Rmult_eq_reg_l d); lra). f_equal; lra.
Qed.

(** What a thruster does that is asked for what it cannot give: nothing below half of the least thrust, else the nearest thrust. *)
Definition clamped_side (s : side) (m : R) : R :=
  let least := curve s (dead_zone s) in let most := curve s (limit s) in
  if Rle_dec (2 * m) least then 0 else side_command s (Rmin (Rmax m least) most).
Definition clamped (t : thruster) (T : R) : R :=
  if Req_EM_T T 0 then 0 else if Rlt_dec T 0 then - clamped_side (backward t) (- T) else clamped_side (forward t) T.

(** Within reach it is the command. *)
Theorem clamped_within_reach : forall (t : thruster) (T : R), reaches t T -> clamped t T = command t T.
Proof.
  assert (one : forall s m, 0 < m -> within_reach s m -> clamped_side s m = side_command s m).
  { intros s m P [L M]. unfold clamped_side. destruct (Rle_dec _ _); [exfalso; lra|]. rewrite Rmax_left, Rmin_left; auto. }
  intros t T [[P W]|[P W]]; unfold clamped, command; destruct (Req_EM_T T 0); try lra; destruct (Rlt_dec T 0); try lra;
    rewrite one; auto; lra.
Qed.

(** Thrusters for counterexamples: thrust [a n^2] for n from 1 to 2. *)
Definition example (a : R) : thruster :=
  let s := {| quadratic := a; linear := 0; dead_zone := 1; limit := 2 |} in {| forward := s; backward := s |}.
Lemma example_sound a : 0 < a -> sound (example a).
Proof. intros H. split; (apply accepted; simpl; lra). Qed.

(** Real thrust 5 % below the map: a moment is not what was asked for. *)
Theorem needs_same_thrusters : exists known actual offset asked, sound known /\ sound actual /\
  (let tau := thrusts 1 asked in available known (fst tau + fst offset) /\ available known (snd tau + snd offset)) /\
  snd (delivered 1 (actual, actual) (commands command 1 (known, known) offset asked)) <> snd asked + snd (forces 1 offset).
Proof.
  exists (example 1), (example (19 / 20)), (5 / 2, 5 / 2), (0, 2).
  assert (S := example_sound 1 ltac:(lra)). split; [exact S|]. split; [apply example_sound; lra|].
  assert (A1 : available (example 1) (7 / 2)) by (right; left; split; [lra|unfold within_reach, curve; simpl; lra]).
  assert (A2 : available (example 1) (3 / 2)) by (right; left; split; [lra|unfold within_reach, curve; simpl; lra]).
  assert (E : thrusts 1 (0, 2) = (1, - (1))) by (unfold thrusts; simpl; f_equal; field).
  assert (less : forall n, thrust (example (19 / 20)) n = 19 / 20 * thrust (example 1) n).
  { intros n. unfold thrust, side_thrust, curve. simpl. destruct (Rlt_dec n 0); [destruct (Rlt_dec (- n) 1)|destruct (Rlt_dec n 1)]; field. }
  unfold commands, delivered. rewrite E. simpl. replace (1 + 5 / 2) with (7 / 2) by field. replace (- (1) + 5 / 2) with (3 / 2) by field.
  split; [split; assumption|]. rewrite !less, !available_thrust by assumption. lra.
Qed.

(** Asked for more than they can give, thrusters saturate. *)
Theorem needs_within_limits : exists t offset asked, sound t /\
  snd (delivered 1 (t, t) (commands clamped 1 (t, t) offset asked)) <> snd asked + snd (forces 1 offset).
Proof.
  exists (example 1), (5 / 2, 5 / 2), (0, 8). split; [apply example_sound; lra|]. set (t := example 1).
  unfold delivered, commands, forces, thrusts. simpl. replace (1 / 2 * 0 + 1 / 2 / 1 * 8 + 5 / 2) with (13 / 2) by field.
  replace (1 / 2 * 0 - 1 / 2 / 1 * 8 + 5 / 2) with (- (3 / 2)) by field.
  assert (R4 : reaches t 4) by (left; split; [lra|unfold within_reach, curve; simpl; lra]).
  assert (R3 : reaches t (- (3 / 2))) by (right; split; [lra|unfold within_reach, curve; simpl; lra]).
  rewrite (clamped_within_reach t (- (3 / 2)) R3).
  replace (clamped t (13 / 2)) with (command t 4).
  - rewrite !available_thrust by (try (apply example_sound; lra); right; assumption). lra.
  - unfold clamped, command, clamped_side, curve. simpl. destruct (Req_EM_T 4 0); [lra|]. destruct (Rlt_dec 4 0); [lra|].
    destruct (Req_EM_T (13 / 2) 0); [lra|]. destruct (Rlt_dec (13 / 2) 0); [lra|]. destruct (Rle_dec _ _); [exfalso; lra|].
    f_equal. rewrite Rmax_left by lra. rewrite Rmin_right; lra.
Qed.

(** Without an offset a small moment asks for thrusts that there are none of. *)
Theorem needs_outside_dead_zone : exists t asked, sound t /\
  snd (delivered 1 (t, t) (commands clamped 1 (t, t) (0, 0) asked)) <> snd asked + snd (forces 1 (0, 0)).
Proof.
  exists (example 1), (0, 1 / 2). split; [apply example_sound; lra|].
  unfold delivered, commands, forces, thrusts. simpl. replace (1 / 2 * 0 + 1 / 2 / 1 * (1 / 2) + 0) with (1 / 4) by field.
  replace (1 / 2 * 0 - 1 / 2 / 1 * (1 / 2) + 0) with (- (1 / 4)) by field.
  assert (Z : clamped (example 1) (1 / 4) = 0).
  { unfold clamped, clamped_side, curve. simpl. destruct (Req_EM_T (1 / 4) 0); [reflexivity|]. destruct (Rlt_dec (1 / 4) 0); [lra|].
    destruct (Rle_dec _ _); lra. }
  assert (Z' : clamped (example 1) (- (1 / 4)) = 0).
  { unfold clamped, clamped_side, curve. simpl. destruct (Req_EM_T (- (1 / 4)) 0); [reflexivity|]. destruct (Rlt_dec (- (1 / 4)) 0); [|lra].
    destruct (Rle_dec _ _); lra. }
  rewrite Z, Z'. assert (T0 : thrust (example 1) 0 = 0).
  { unfold thrust, side_thrust. simpl. destruct (Rlt_dec 0 0); [lra|]. destruct (Rlt_dec 0 1); [reflexivity|lra]. }
  rewrite T0. lra.
Qed.

(** The constant is not nothing. *)
Theorem constant_counts : forces 1 (5 / 2, 5 / 2) <> (0, 0).
Proof. unfold forces. simpl. intros E. injection E as E _. lra. Qed.

Print Assumptions statement.
