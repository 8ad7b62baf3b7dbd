(** claim: relay-noise (section 4.1, in words)
    As printed: the relay is insensitive to noise (refuted). As corrected: while the input moves one way through both levels, noise
    smaller than the half-width switches the relay exactly once. *)
From Coq Require Import Reals Lra Psatz.
From Coq Require Classical_Prop.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

(** Up to an instant one output, and from it on the other. *)
Definition switches_once (instants : R -> Prop) (y : R -> R) (before after from to : R) : Prop :=
  exists at_time, from <= at_time <= to /\
    forall t, instants t -> from <= t <= to -> (t < at_time -> y t = before) /\ (at_time < t -> y t = after).

(** At all instants or at samples; the input rises or falls; the disturbed input begins beyond one level and ends beyond the other. *)
Lemma upwards (instants : R -> Prop) (C x_a : R) (input noise y : R -> R) (from to : R) :
  0 < C -> relay instants C x_a (fun t => input t + noise t) y ->
  (forall s t, instants s -> instants t -> s <= t -> input s <= input t) ->
  (forall t, instants t -> Rabs (noise t) < x_a) ->
  instants from -> instants to -> from <= to -> input from + noise from < - x_a -> x_a < input to + noise to ->
  switches_once instants y (- C) C from to.
Proof.
  intros HC L up small If It ft B E.
  assert (Y0 : y from = - C) by (apply (low _ _ _ _ _ L); assumption).
  assert (Y1 : y to = C) by (apply (high _ _ _ _ _ L); assumption).
  (* Once high, it does not turn back. *)
  assert (keeps : forall s t, instants s -> instants t -> from <= s -> s <= t -> y s = C -> y t = C).
  { intros s t Is It' fs st Ys.
    assert (X : exists r, instants r /\ from < r <= s /\ x_a <= input r + noise r).
    { apply Classical_Prop.NNPP. intros N. assert (y s = - C); [|lra].
      apply (stays_low _ _ _ _ _ L from s); try assumption. intros r Ir Hr.
      destruct (Rlt_le_dec (input r + noise r) x_a) as [Q|Q]; [exact Q|]. exfalso. apply N. exists r. split; [exact Ir|]. split; [exact Hr|exact Q]. }
    destruct X as [r [Ir [Hr Q]]]. apply (stays_high _ _ _ _ _ L s t); try assumption.
    intros q Iq Hq. pose proof (up r q Ir Iq ltac:(lra)). pose proof (small r Ir) as A. pose proof (small q Iq) as A'.
    apply Rabs_def2 in A. apply Rabs_def2 in A'. lra. }
  (* The instant is the last one of the low output. *)
  destruct (completeness (fun t => instants t /\ from <= t <= to /\ y t = - C)) as [m [M1 M2]].
  - exists to. intros t [_ [T _]]. lra.
  - exists from. repeat split; try assumption; lra.
  - exists m. split; [split|].
    + apply M1. repeat split; try assumption; lra.
    + apply M2. intros t [_ [T _]]. lra.
    + intros t I T. split; intros Q.
      * destruct (two_valued _ _ _ _ _ L t I) as [Z|Z]; [exfalso|exact Z].
        assert (m <= t); [|lra]. apply M2. intros s [Is [S Ys]].
        destruct (Rle_lt_dec s t) as [A|A]; [exact A|exfalso]. pose proof (keeps t s I Is (proj1 T) ltac:(lra) Z). lra.
      * destruct (two_valued _ _ _ _ _ L t I) as [Z|Z]; [exact Z|exfalso].
        assert (t <= m); [|lra]. apply M1. repeat split; try assumption; apply T.
Qed.

Lemma turned_round (instants : R -> Prop) (C x_a : R) (input y : R -> R) :
  relay instants C x_a input y -> relay instants C x_a (fun t => - input t) (fun t => - y t).
Proof.
  intros L. split.
  - intros t I. destruct (two_valued _ _ _ _ _ L t I); lra.
  - intros t I H. rewrite (low _ _ _ _ _ L t I) by lra. ring.
  - intros t I H. rewrite (high _ _ _ _ _ L t I) by lra. ring.
  - intros s t Is It st Y H. rewrite (stays_low _ _ _ _ _ L s t); try assumption; try lra. intros r Ir Hr. specialize (H r Ir Hr). lra.
  - intros s t Is It st Y H. rewrite (stays_high _ _ _ _ _ L s t); try assumption; try lra. intros r Ir Hr. specialize (H r Ir Hr). lra.
Qed.

Theorem statement : forall (instants : R -> Prop) (C x_a : R) (input noise y : R -> R) (from to : R),
  0 < C -> relay instants C x_a (fun t => input t + noise t) y ->
  (* the hypothesis noise-below-half-width *)
  (forall t, instants t -> Rabs (noise t) < x_a) ->
  instants from -> instants to -> from <= to ->
  ((forall s t, instants s -> instants t -> s <= t -> input s <= input t) ->
   input from + noise from < - x_a -> x_a < input to + noise to -> switches_once instants y (- C) C from to) /\
  ((forall s t, instants s -> instants t -> s <= t -> input t <= input s) ->
   x_a < input from + noise from -> input to + noise to < - x_a -> switches_once instants y C (- C) from to).
Proof.
  intros instants C x_a input noise y from to HC L small If It ft. split.
  - intros up B E. apply (upwards instants C x_a input noise); assumption.
  - intros down B E.
    assert (S : switches_once instants (fun t => - y t) (- C) C from to).
    { apply (upwards instants C x_a (fun t => - input t) (fun t => - noise t)); try assumption; try lra.
      - pose proof (turned_round _ _ _ _ _ L) as T. destruct T as [a b c d e]. split; intros.
        + apply a; assumption.
        + apply b; [assumption|lra].
        + apply c; [assumption|lra].
        + apply (d s); try assumption. intros r Ir Hr. specialize (H3 r Ir Hr). lra.
        + apply (e s); try assumption. intros r Ir Hr. specialize (H3 r Ir Hr). lra.
      - intros s t Is It' st. specialize (down s t Is It' st). lra.
      - intros t I. rewrite Rabs_Ropp. apply small, I. }
    destruct S as [m [M S]]. exists m. split; [exact M|]. intros t I T. destruct (S t I T) as [A B']. split; intros Q.
    + specialize (A Q). lra.
    + specialize (B' Q). lra.
Qed.

(** Noise of one and a half half-widths on an input that rises steadily from -3 to 3: the relay goes up, down and up again. *)
Definition ramp (t : R) : R := t.
Definition large_noise (t : R) : R :=
  if Rlt_dec t (- (2 / 5)) then - (3 / 2) else if Rlt_dec t 0 then 3 / 2 else if Rlt_dec t (2 / 5) then - (3 / 2) else 3 / 2.
Definition chatter (t : R) : R := if Rlt_dec 0 (ramp t + large_noise t) then 1 else -1.

Theorem as_printed_false : relay always 1 1 (fun t => ramp t + large_noise t) chatter /\
  (forall s t, s <= t -> ramp s <= ramp t) /\ (forall t, Rabs (large_noise t) <= 3 / 2 * 1) /\
  chatter (-3) = -1 /\ chatter (- (1 / 5)) = 1 /\ chatter (1 / 5) = -1 /\ chatter 3 = 1.
Proof.
  assert (V : forall t, ramp t + large_noise t < -1 \/ 1 < ramp t + large_noise t).
  { intros t. unfold ramp, large_noise. repeat destruct (Rlt_dec _ _); lra. }
  split; [|split; [|split]].
  - split; unfold chatter.
    + intros t _. destruct (Rlt_dec _ _); lra.
    + intros t _ H. destruct (Rlt_dec _ _); lra.
    + intros t _ H. destruct (Rlt_dec _ _); lra.
    + intros s t _ _ [st|<-] Y H; [|exact Y]. specialize (H t I ltac:(lra)). destruct (V t), (Rlt_dec 0 (ramp t + large_noise t)); lra.
    + intros s t _ _ [st|<-] Y H; [|exact Y]. specialize (H t I ltac:(lra)). destruct (V t), (Rlt_dec 0 (ramp t + large_noise t)); lra.
  - intros s t H. exact H.
  - intros t. unfold large_noise. repeat destruct (Rlt_dec _ _); unfold Rabs; destruct (Rcase_abs _); lra.
  - assert (N : large_noise (-3) = - (3 / 2) /\ large_noise (- (1 / 5)) = 3 / 2 /\ large_noise (1 / 5) = - (3 / 2) /\ large_noise 3 = 3 / 2).
    { unfold large_noise. repeat split; repeat (destruct (Rlt_dec _ _); try lra). }
    destruct N as [N1 [N2 [N3 N4]]]. unfold chatter, ramp. rewrite N1, N2, N3, N4.
    repeat split; destruct (Rlt_dec _ _); lra.
Qed.

Print Assumptions statement.
