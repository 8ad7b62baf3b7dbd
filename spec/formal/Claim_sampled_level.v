(** claim: sampled-level (section 4.3)
    A relay that looks at its input at sampling instants switches at a level that is [x_a] or beyond, and beyond by no more than the
    input moves in one sampling interval. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

(** Two samples with none between. *)
Definition consecutive (samples : R -> Prop) (s t : R) : Prop :=
  samples s /\ samples t /\ s < t /\ forall r, samples r -> ~ (s < r < t).

Theorem statement : forall (samples : R -> Prop) (C x_a : R) (input y : R -> R) (s t : R),
  0 < C -> relay samples C x_a input y -> consecutive samples s t ->
  (* the command turns up at the sample t, or down *)
  (y s = - C -> y t = C -> x_a <= input t /\ input t - x_a <= input t - input s) /\
  (y s = C -> y t = - C -> input t <= - x_a /\ - x_a - input t <= input s - input t).
Proof.
  intros samples C x_a input y s t HC L [Is [It [st gap]]].
  assert (only : forall r, samples r -> s < r <= t -> r = t).
  { intros r Ir [R1 [R2|R2]]; [exfalso; apply (gap r Ir); lra|exact R2]. }
  split; intros Ys Yt; split.
  - destruct (Rle_lt_dec x_a (input t)) as [Q|Q]; [exact Q|exfalso].
    assert (y t = - C); [|lra]. apply (stays_low _ _ _ _ _ L s t); try assumption; try lra. intros r Ir Hr. now rewrite (only r Ir Hr).
  - destruct (Rle_lt_dec (input s) x_a) as [Q|Q]; [lra|exfalso]. pose proof (high _ _ _ _ _ L s Is Q). lra.
  - destruct (Rle_lt_dec (input t) (- x_a)) as [Q|Q]; [exact Q|exfalso].
    assert (y t = C); [|lra]. apply (stays_high _ _ _ _ _ L s t); try assumption; try lra. intros r Ir Hr. now rewrite (only r Ir Hr).
  - destruct (Rle_lt_dec (- x_a) (input s)) as [Q|Q]; [lra|exfalso]. pose proof (low _ _ _ _ _ L s Is Q). lra.
Qed.

(** The lower limit cannot be raised by one percent: samples 0 and 1 of an input that comes to [x_a] itself. *)
Theorem limit_is_met : exists (samples : R -> Prop) (C x_a : R) (input y : R -> R),
  0 < C /\ 0 < x_a /\ relay samples C x_a input y /\ consecutive samples 0 1 /\ y 0 = - C /\ y 1 = C /\ input 1 < x_a * (1 + 1 / 100).
Proof.
  exists (fun t => t = 0 \/ t = 1), 1, 1, (fun t => t), (fun t => if Rlt_dec t 1 then -1 else 1).
  split; [lra|]. split; [lra|]. split; [|split].
  - split.
    + intros t _. destruct (Rlt_dec t 1); lra.
    + intros t _ H. destruct (Rlt_dec t 1); lra.
    + intros t [->| ->] H; lra.
    + intros s t [->| ->] [->| ->] st Y H; destruct (Rlt_dec _ 1); lra.
    + intros s t [->| ->] [->| ->] st Y H; destruct (Rlt_dec _ 1); try lra. specialize (H 1 ltac:(auto) ltac:(lra)). lra.
  - split; [auto|]. split; [auto|]. split; [lra|]. intros r [->| ->]; lra.
  - destruct (Rlt_dec 0 1), (Rlt_dec 1 1); lra.
Qed.

Print Assumptions statement.
