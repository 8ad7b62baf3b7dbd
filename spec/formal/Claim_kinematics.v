(** claim: kinematics (eq. 4)
    From body to Earth, [J1] is the rotation yaw after pitch after roll, and [J2] gives the rates of roll, pitch and yaw from the body's
    rates of turn. A quaternion that turns at [q omega/2] is in the same attitude and moves the same way. *)
From Coq Require Import Reals Lra Lia Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common SixAxes.
Open Scope R_scope.

(** * Three turns *)

Definition rows (a b c d e f g h i : R) : matrix := fun r s => match r, s with
  | 0%nat, 0%nat => a | 0%nat, 1%nat => b | 0%nat, _ => c | 1%nat, 0%nat => d | 1%nat, 1%nat => e | 1%nat, _ => f | _, 0%nat => g | _, 1%nat => h | _, _ => i end.
Definition product (A B : matrix) : matrix := fun i j => sum 3 (fun k => A i k * B k j).
Definition transposed (A : matrix) : matrix := fun i j => A j i.
Definition determinant (A : matrix) : R := dot 3 (A 0%nat) (cross (A 1%nat) (A 2%nat)).

Definition about_x (t : R) : matrix := rows 1 0 0 0 (cos t) (- sin t) 0 (sin t) (cos t).
Definition about_y (t : R) : matrix := rows (cos t) 0 (sin t) 0 1 0 (- sin t) 0 (cos t).
Definition about_z (t : R) : matrix := rows (cos t) (- sin t) 0 (sin t) (cos t) 0 0 0 1.
Definition J1 (roll pitch yaw : R) : matrix := product (about_z yaw) (product (about_y pitch) (about_x roll)).

(** The matrix from body rates (p, q, r) to Euler rates, as the program has it. *)
Definition J2 (roll pitch : R) : matrix := rows
  1 (sin roll * (sin pitch / cos pitch)) (cos roll * (sin pitch / cos pitch))
  0 (cos roll) (- sin roll)
  0 (sin roll / cos pitch) (cos roll / cos pitch).

(** * The quaternion (w, i, j, k) *)

Record quaternion := Q { re : R; im_i : R; im_j : R; im_k : R }.
Definition qmul (a b : quaternion) : quaternion := Q
  (re a * re b - im_i a * im_i b - im_j a * im_j b - im_k a * im_k b)
  (re a * im_i b + im_i a * re b + im_j a * im_k b - im_k a * im_j b)
  (re a * im_j b - im_i a * im_k b + im_j a * re b + im_k a * im_i b)
  (re a * im_k b + im_i a * im_j b - im_j a * im_i b + im_k a * re b).
Definition conjugate (a : quaternion) : quaternion := Q (re a) (- im_i a) (- im_j a) (- im_k a).
Definition imaginary (v : vector) : quaternion := Q 0 (v 0%nat) (v 1%nat) (v 2%nat).
Definition part (a : quaternion) : vector := fun i => match i with 0%nat => im_i a | 1%nat => im_j a | _ => im_k a end.
(** The rotation [q v q*], column by column. *)
Definition unit (j : nat) : vector := fun i => if Nat.eqb i j then 1 else 0.
Definition rotation (q : quaternion) : matrix := fun i j => part (qmul (qmul q (imaginary (unit j))) (conjugate q)) i.
(** [q omega/2]. *)
Definition spin (q : quaternion) (omega : vector) : quaternion := qmul q (imaginary (fun i => omega i / 2)).
(** The quaternion of three turns. *)
Definition of_angles (roll pitch yaw : R) : quaternion :=
  qmul (Q (cos (yaw / 2)) 0 0 (sin (yaw / 2))) (qmul (Q (cos (pitch / 2)) 0 (sin (pitch / 2)) 0) (Q (cos (roll / 2)) (sin (roll / 2)) 0 0)).

(** Two matrices of three rows are equal. *)
Definition same (A B : matrix) : Prop := forall i j, (i < 3)%nat -> (j < 3)%nat -> A i j = B i j.
Ltac entries := intros i j Hi Hj; destruct i as [|[|[|i]]]; try lia; destruct j as [|[|[|j]]]; try lia; clear Hi Hj.

Lemma cos_square t : cos t * cos t = 1 - sin t * sin t.
Proof. pose proof (sin2_cos2' t). lra. Qed.

(** A product of quaternions is one turn after the other; a quaternion about an axis is a turn about it. *)
Lemma rotation_of_product a b : same (rotation (qmul a b)) (product (rotation a) (rotation b)).
Proof.
  destruct a as [a0 a1 a2 a3]. destruct b as [b0 b1 b2 b3].
  entries; unfold rotation, part, qmul, conjugate, imaginary, unit, product; simpl; ring.
Qed.

Lemma half_angles t : sin t = 2 * sin (t / 2) * cos (t / 2) /\ cos t = cos (t / 2) * cos (t / 2) - sin (t / 2) * sin (t / 2).
Proof. pose proof (sin_2a (t / 2)) as S. pose proof (cos_2a (t / 2)) as C. replace (2 * (t / 2)) with t in * by field. split; assumption. Qed.

Ltac one_turn t := destruct (half_angles t) as [S C]; pose proof (cos_square (t / 2)) as K; unfold about_x, about_y, about_z; rewrite S, C;
  entries; unfold rotation, part, qmul, conjugate, imaginary, unit, rows; simpl; set (c := cos (t / 2)) in *; set (s := sin (t / 2)) in *; nra.
Lemma rotation_x t : same (rotation (Q (cos (t / 2)) (sin (t / 2)) 0 0)) (about_x t).
Proof. one_turn t. Qed.
Lemma rotation_y t : same (rotation (Q (cos (t / 2)) 0 (sin (t / 2)) 0)) (about_y t).
Proof. one_turn t. Qed.
Lemma rotation_z t : same (rotation (Q (cos (t / 2)) 0 0 (sin (t / 2)))) (about_z t).
Proof. one_turn t. Qed.

Lemma product_same A B A' B' : same A A' -> same B B' -> same (product A B) (product A' B').
Proof. intros HA HB i j Hi Hj. unfold product. apply sum_ext. intros k Hk. rewrite HA, HB by assumption. reflexivity. Qed.
Lemma same_trans A B C : same A B -> same B C -> same A C.
Proof. intros H K i j Hi Hj. rewrite H, K by assumption. reflexivity. Qed.

(** The quaternion's attitude is that of the three turns. *)
Lemma same_attitude roll pitch yaw : same (rotation (of_angles roll pitch yaw)) (J1 roll pitch yaw).
Proof.
  unfold of_angles, J1. eapply same_trans; [apply rotation_of_product|]. apply product_same; [apply rotation_z|].
  eapply same_trans; [apply rotation_of_product|]. apply product_same; [apply rotation_y|apply rotation_x].
Qed.

(** * The claim *)

Theorem statement :
  (* J1 is a rotation *)
  (forall roll pitch yaw, same (product (J1 roll pitch yaw) (transposed (J1 roll pitch yaw))) (diagonal (fun _ => 1)) /\ determinant (J1 roll pitch yaw) = 1) /\
  (* while the angles change at [J2 omega], J1 changes at J1 times the cross-product matrix of omega *)
  (forall (roll pitch yaw : R -> R) (omega : vector) (t : R),
    (* the hypothesis not-upright *)
    cos (pitch t) <> 0 ->
    let rates := times 3 (J2 (roll t) (pitch t)) omega in
    is_derive roll t (rates 0%nat) -> is_derive pitch t (rates 1%nat) -> is_derive yaw t (rates 2%nat) ->
    forall i j, (i < 3)%nat -> (j < 3)%nat ->
    is_derive (fun t => J1 (roll t) (pitch t) (yaw t) i j) t (product (J1 (roll t) (pitch t) (yaw t)) (skew omega) i j)) /\
  (* the quaternion of the angles is in the same attitude *)
  (forall roll pitch yaw, same (rotation (of_angles roll pitch yaw)) (J1 roll pitch yaw)) /\
  (* and a quaternion that turns at [q omega/2], any quaternion, moves the same way *)
  (forall (w a b c : R -> R) (omega : vector) (t : R), let q := fun t => Q (w t) (a t) (b t) (c t) in let rate := spin (q t) omega in
    is_derive w t (re rate) -> is_derive a t (im_i rate) -> is_derive b t (im_j rate) -> is_derive c t (im_k rate) ->
    forall i j, (i < 3)%nat -> (j < 3)%nat -> is_derive (fun t => rotation (q t) i j) t (product (rotation (q t)) (skew omega) i j)).
Proof.
  split; [|split; [|split]].
  - intros roll pitch yaw. pose proof (cos_square roll) as Qr. pose proof (cos_square pitch) as Qp. pose proof (cos_square yaw) as Qy.
    unfold J1, about_x, about_y, about_z, determinant, dot, cross, times, skew, product, transposed, rows, diagonal.
    set (a := sin roll) in *. set (b := cos roll) in *. set (c := sin pitch) in *. set (d := cos pitch) in *. set (e := sin yaw) in *. set (f := cos yaw) in *.
    split; [entries; simpl; ring [Qr Qp Qy]|simpl; ring [Qr Qp Qy]].
  - intros roll pitch yaw omega t N rates Dr Dp Dy.
    pose proof (cos_square (roll t)) as Qr. pose proof (cos_square (pitch t)) as Qp. pose proof (cos_square (yaw t)) as Qy.
    assert (Er : Derive (fun x : R => roll x) t = rates 0%nat) by exact (is_derive_unique _ _ _ Dr). assert (Ep : Derive (fun x : R => pitch x) t = rates 1%nat) by exact (is_derive_unique _ _ _ Dp). assert (Ey : Derive (fun x : R => yaw x) t = rates 2%nat) by exact (is_derive_unique _ _ _ Dy).
    assert (Xr : ex_derive roll t) by (eexists; exact Dr). assert (Xp : ex_derive pitch t) by (eexists; exact Dp). assert (Xy : ex_derive yaw t) by (eexists; exact Dy).
    unfold J1, about_x, about_y, about_z, skew, product, rows.
    unfold rates, times, J2, rows in Er, Ep, Ey. simpl in Er, Ep, Ey. clear Dr Dp Dy rates.
    entries; simpl; (auto_derive; [repeat split; assumption|]); rewrite ?Er, ?Ep, ?Ey;
      set (a := sin (roll t)) in *; set (b := cos (roll t)) in *; set (c := sin (pitch t)) in *; set (d := cos (pitch t)) in *;
      set (e := sin (yaw t)) in *; set (f := cos (yaw t)) in *; field_simplify_eq; try exact N; ring [Qr Qp Qy].
  - exact same_attitude.
  - intros w a b c omega t q rate Dw Da Db Dc.
    assert (Ew : Derive (fun x : R => w x) t = re rate) by exact (is_derive_unique _ _ _ Dw). assert (Ea : Derive (fun x : R => a x) t = im_i rate) by exact (is_derive_unique _ _ _ Da). assert (Eb : Derive (fun x : R => b x) t = im_j rate) by exact (is_derive_unique _ _ _ Db). assert (Ec : Derive (fun x : R => c x) t = im_k rate) by exact (is_derive_unique _ _ _ Dc).
    assert (Xw : ex_derive w t) by (eexists; exact Dw). assert (Xa : ex_derive a t) by (eexists; exact Da).
    assert (Xb : ex_derive b t) by (eexists; exact Db). assert (Xc : ex_derive c t) by (eexists; exact Dc).
    unfold rate, spin, imaginary, q in Ew, Ea, Eb, Ec. simpl in Ew, Ea, Eb, Ec. clear Dw Da Db Dc rate.
    unfold q, rotation, part, qmul, conjugate, imaginary, unit, product, skew. clear q.
    entries; simpl; (auto_derive; [repeat split; assumption|]); rewrite ?Ew, ?Ea, ?Eb, ?Ec; field.
Qed.

(** Upright the rates of roll and yaw are one: two sets of Euler rates turn the body the same way, so that no matrix gives them back. *)
Theorem needs_not_upright : forall roll yaw (side : bool), let pitch := if side then PI / 2 else - (PI / 2) in
  exists dr dy, dr <> 0 /\
  forall i j, (i < 3)%nat -> (j < 3)%nat -> is_derive (fun t => J1 (roll + dr * t) pitch (yaw + dy * t) i j) 0 0.
Proof.
  intros roll yaw side pitch. exists 1, (if side then 1 else -1). split; [lra|]. intros i j Hi Hj.
  assert (C : cos pitch = 0 /\ sin pitch = if side then 1 else -1).
  { unfold pitch. destruct side; [rewrite cos_PI2, sin_PI2|rewrite cos_neg, sin_neg, cos_PI2, sin_PI2]; split; lra. }
  destruct C as [C S]. unfold J1, about_x, about_y, about_z, product, rows. rewrite C, S. revert i j Hi Hj.
  destruct side; entries; simpl; (auto_derive; [trivial|]); rewrite ?Rmult_0_r, ?Rplus_0_r; ring.
Qed.

Print Assumptions statement.
