(** claim: delays-add (eq. 36)
    A command that takes [T_d] to the axis and a reading that takes [T_d] to the relay make the loop that one delay of [2 T_d] before the
    axis makes: the record is the same, [T_d] later. *)
From Coq Require Import Reals Lra Lia Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

Section Loops.
Variables alpha beta_1 beta_2 delta C x_a T : R.
(** The axis obeys from one instant on, the relay looks at the instants of a set. *)
Variables (start : R) (instants : R -> Prop).

(** One delay before the axis and one after it. *)
Definition apart (x v u : R -> R) : Prop :=
  axis start alpha beta_1 beta_2 delta (fun t => u (t - T)) x v /\ relay instants C x_a (fun t => - x (t - T)) u.

(** Both before it; the relay looks [T] earlier. *)
Definition joined (x v u : R -> R) : Prop :=
  axis start alpha beta_1 beta_2 delta (fun t => u (t - 2 * T)) x v /\ relay (fun t => instants (t + T)) C x_a (fun t => - x t) u.
End Loops.

Lemma axis_ext start alpha beta_1 beta_2 delta f g x v : (forall t, f t = g t) ->
  axis start alpha beta_1 beta_2 delta f x v -> axis start alpha beta_1 beta_2 delta g x v.
Proof.
  intros E [a b c]. split; [exact a|exact b|]. intros t Ht L. rewrite <- E. apply c; [exact Ht|].
  revert L. apply filter_imp. intros s Hs. now rewrite !E.
Qed.

Lemma relay_earlier (instants : R -> Prop) C x_a (f y : R -> R) T :
  relay instants C x_a f y <-> relay (fun t => instants (t + T)) C x_a (fun t => f (t + T)) (fun t => y (t + T)).
Proof.
  split.
  - intros [a b c d e]. split.
    + intros t I. apply a, I.
    + intros t I. apply b, I.
    + intros t I. apply c, I.
    + intros s t Is It st Y H. apply (d (s + T) (t + T)); try assumption; try lra.
      intros r Ir Hr. replace r with (r - T + T) by ring. apply H; [replace (r - T + T) with r by ring; exact Ir|lra].
    + intros s t Is It st Y H. apply (e (s + T) (t + T)); try assumption; try lra.
      intros r Ir Hr. replace r with (r - T + T) by ring. apply H; [replace (r - T + T) with r by ring; exact Ir|lra].
  - assert (back : forall (P : R -> Prop) t, P t -> P (t - T + T)) by (intros P t H; replace (t - T + T) with t by ring; exact H).
    assert (forth : forall t, t - T + T = t) by (intros; ring).
    intros [a b c d e]. split.
    + intros t I. specialize (a (t - T) (back instants t I)). cbv beta in a. rewrite forth in a. exact a.
    + intros t I H. specialize (b (t - T) (back instants t I)). cbv beta in b. rewrite forth in b. exact (b H).
    + intros t I H. specialize (c (t - T) (back instants t I)). cbv beta in c. rewrite forth in c. exact (c H).
    + intros s t Is It st Y H. specialize (d (s - T) (t - T) (back instants s Is) (back instants t It) ltac:(lra)).
      cbv beta in d. rewrite !forth in d. apply (d Y). intros r Ir Hr. apply H; [exact Ir|lra].
    + intros s t Is It st Y H. specialize (e (s - T) (t - T) (back instants s Is) (back instants t It) ltac:(lra)).
      cbv beta in e. rewrite !forth in e. apply (e Y). intros r Ir Hr. apply H; [exact Ir|lra].
Qed.

(** Samples every h, and a command held from one to the next. *)
Definition samples (h t : R) : Prop := exists k : Z, t = IZR k * h.
Definition held (h : R) (u : R -> R) : Prop := forall k t, IZR k * h <= t < IZR (k + 1) * h -> u t = u (IZR k * h).

Theorem statement : forall (alpha beta_1 beta_2 delta C x_a T start : R),
  (* what the relay reads is the coordinate T later; so is its command: for a relay that looks at any instants *)
  (forall (instants : R -> Prop) (x v u : R -> R),
    apart alpha beta_1 beta_2 delta C x_a T start instants x v u <->
    joined alpha beta_1 beta_2 delta C x_a T start instants x v (fun t => u (t + T))) /\
  (* and where it looks at samples, and its command is held, if the delay is a whole number of samples *)
  (forall (h : R) (m : Z) (from : R) (x v u : R -> R), T = IZR m * h ->
    let since := fun instant t => samples h t /\ instant < t in
    (apart alpha beta_1 beta_2 delta C x_a T start (since from) x v u /\ held h u) <->
    (axis start alpha beta_1 beta_2 delta (fun t => u (t - 2 * T + T)) x v /\
     relay (since (from - T)) C x_a (fun t => - x t) (fun t => u (t + T)) /\ held h (fun t => u (t + T)))).
Proof.
  intros alpha beta_1 beta_2 delta C x_a T start.
  assert (A : forall instants x v u, apart alpha beta_1 beta_2 delta C x_a T start instants x v u <->
    joined alpha beta_1 beta_2 delta C x_a T start instants x v (fun t => u (t + T))).
  { intros instants x v u. unfold apart, joined. split; intros [X L]; split.
    - revert X. apply axis_ext. intros t. f_equal. ring.
    - apply (relay_earlier instants C x_a (fun t => - x (t - T)) u T) in L. destruct L as [a b c d e].
      assert (forth : forall t, t + T - T = t) by (intros; ring). split.
      + exact a.
      + intros t I H. apply (b t I). cbv beta. now rewrite forth.
      + intros t I H. apply (c t I). cbv beta. now rewrite forth.
      + intros s t Is It st Y H. apply (d s t Is It st Y). intros r Ir Hr. cbv beta. rewrite forth. apply H; assumption.
      + intros s t Is It st Y H. apply (e s t Is It st Y). intros r Ir Hr. cbv beta. rewrite forth. apply H; assumption.
    - revert X. apply axis_ext. intros t. f_equal. ring.
    - apply (relay_earlier instants C x_a (fun t => - x (t - T)) u T). destruct L as [a b c d e].
      assert (forth : forall t, t + T - T = t) by (intros; ring). split.
      + exact a.
      + intros t I H. apply (b t I). now rewrite forth in H.
      + intros t I H. apply (c t I). now rewrite forth in H.
      + intros s t Is It st Y H. apply (d s t Is It st Y). intros r Ir Hr. specialize (H r Ir Hr). now rewrite forth in H.
      + intros s t Is It st Y H. apply (e s t Is It st Y). intros r Ir Hr. specialize (H r Ir Hr). now rewrite forth in H. }
  split; [exact A|].
  intros h m from x v u ET since.
  (* the samples, shifted by whole ones, are the samples *)
  assert (S : forall t, since from (t + T) <-> since (from - T) t).
  { intros t. unfold since, samples. split; intros [[k Ek] H]; (split; [|lra]).
    - exists (k - m)%Z. rewrite minus_IZR. lra.
    - exists (k + m)%Z. rewrite plus_IZR. lra. }
  assert (R : forall y, relay (fun t => since from (t + T)) C x_a (fun t => - x t) y <-> relay (since (from - T)) C x_a (fun t => - x t) y).
  { intros y. split; intros [a b c d e]; split; intros.
    all: try (apply a; now apply S). all: try (apply b; [now apply S|assumption]). all: try (apply c; [now apply S|assumption]).
    all: try (apply (d s); try assumption; try (now apply S); intros r Ir Hr; apply H3; [now apply S|assumption]).
    all: try (apply (e s); try assumption; try (now apply S); intros r Ir Hr; apply H3; [now apply S|assumption]). }
  assert (H : held h u <-> held h (fun t => u (t + T))).
  { unfold held. rewrite ET. split; intros H k t Ht.
    - replace (IZR k * h + IZR m * h) with (IZR (k + m) * h) by (rewrite plus_IZR; ring).
      apply H. replace (k + m + 1)%Z with (k + 1 + m)%Z by ring. rewrite !plus_IZR in *. lra.
    - replace t with (t - IZR m * h + IZR m * h) by ring. replace (IZR k * h) with (IZR (k - m) * h + IZR m * h) by (rewrite minus_IZR; ring).
      apply (H (k - m)%Z). replace (k - m + 1)%Z with (k + 1 - m)%Z by ring. rewrite !minus_IZR. lra. }
  rewrite (A (since from) x v u). unfold joined. rewrite R, H. tauto.
Qed.

(** A delay of half a sample moves the instants at which a held command changes: a vehicle at rest below the lower level, whose command
    has changed at the sample 0. *)
Theorem needs_whole_samples : exists (x v u : R -> R),
  let since := fun instant t => samples 1 t /\ instant < t in
  apart 1 1 0 (-1) 1 1 (1 / 2) (1 / 2) (since (- (1 / 2))) x v u /\ held 1 u /\ ~ held 1 (fun t => u (t + 1 / 2)).
Proof.
  exists (fun _ => -2), (fun _ => 0), (fun t => if Rlt_dec t 0 then -1 else 1). intros since. split; [split|split].
  - split.
    + intros t _. exact (is_derive_const (-2) t).
    + intros t _. apply continuous_const.
    + intros t Ht _. cbv beta. destruct (Rlt_dec (t - 1 / 2) 0); [lra|]. unfold drag.
      replace ((1 + -1 - (1 * 0 + 0 * (0 * Rabs 0))) / 1) with 0 by field. exact (is_derive_const 0 t).
  - assert (P : forall t, since (- (1 / 2)) t -> 0 <= t).
    { intros t [[k ->] H]. rewrite Rmult_1_r in *. apply IZR_le. assert (-1 < k)%Z; [|lia]. apply lt_IZR. lra. }
    split; cbv beta; intros.
    + destruct (Rlt_dec t 0); lra.
    + specialize (P t H). destruct (Rlt_dec t 0); lra.
    + lra.
    + specialize (P t H0). destruct (Rlt_dec t 0); lra.
    + specialize (P s H). destruct (Rlt_dec s 0); lra.
  - intros k t Ht. rewrite Rmult_1_r in *. rewrite plus_IZR in Ht. destruct (Rlt_dec t 0), (Rlt_dec (IZR k) 0); try reflexivity.
    + exfalso. lra.
    + exfalso. assert (K : (k <= -1)%Z) by (assert (k < 0)%Z by (apply lt_IZR; lra); lia). apply IZR_le in K. lra.
  - intros H. specialize (H (-1)%Z (- (1 / 2))). simpl in H. specialize (H ltac:(lra)). cbv beta in H.
    destruct (Rlt_dec (- (1 / 2) + 1 / 2) 0), (Rlt_dec (-1 * 1 + 1 / 2) 0); lra.
Qed.

Print Assumptions statement.
