(** claim: relay-f0 (eq. 32)
    [F_0 = C (t_high - t_low)/(t_high + t_low)] with the times per period at the high and the low output, and from the one-tone input
    itself [F_0 = (C/pi) [asin((x_a + e_0)/X) - asin((x_a - e_0)/X)]]; an offset of the levels adds itself. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Relay.
Open Scope R_scope.

(** From the times, and from the tone. *)
Definition F_0_of_times (C t_high t_low : R) : R := C * (t_high - t_low) / (t_high + t_low).
Definition F_0 (C x_a e_0 X : R) : R := C / PI * (asin ((x_a + e_0) / X) - asin ((x_a - e_0) / X)).

(** The time for which a signal has a value, from 0 to T. *)
Definition spends (y : R -> R) (value T time : R) : Prop :=
  is_RInt (fun t => if Req_EM_T (y t) value then 1 else 0) 0 T time.

(** The mean of any signal of two values, the levels with an offset: nothing is asked of its waveform. *)
Theorem mean_of_two_values : forall (C offset T t_high t_low : R) (y : R -> R), 0 < C -> 0 < T ->
  (forall t, y t = offset + C \/ y t = offset - C) ->
  spends y (offset + C) T t_high -> spends y (offset - C) T t_low ->
  is_RInt y 0 T (T * (F_0_of_times C t_high t_low + offset)).
Proof.
  intros C offset T t_high t_low y HC HT two H L.
  assert (S : t_high + t_low = T).
  { assert (One : is_RInt (fun _ => 1) 0 T (t_high + t_low)).
    { eapply int_eq; [exact (int_plus _ _ _ _ _ _ H L)| |reflexivity]. intros t. cbv beta.
      destruct (two t) as [E|E], (Req_EM_T (y t) (offset + C)), (Req_EM_T (y t) (offset - C)); lra. }
    rewrite (int_same _ _ _ _ _ One (int_const 1 0 T)). ring. }
  eapply int_eq; [exact (int_plus _ _ _ _ _ _ (int_scal _ _ _ (offset + C) _ H) (int_scal _ _ _ (offset - C) _ L))| |].
  - intros t. cbv beta. destruct (two t) as [E|E], (Req_EM_T (y t) (offset + C)), (Req_EM_T (y t) (offset - C)); lra.
  - unfold F_0_of_times. rewrite S. rewrite <- S. field. lra.
Qed.

(** The hypothesis switches-both-ways is in [switches]: [X > x_a + abs(x_0)], or equal to it and a relay that turns at the level. *)
Theorem statement : forall (C x_a e_0 X offset : R) (y : R -> R), 0 <= x_a -> switches C x_a e_0 X y ->
  (* the mean, whatever the offset, over one turn and any other *)
  Y_0 (fun t => y t + offset) = F_0 C x_a e_0 X + offset /\
  (forall a, is_RInt y a (a + 2 * PI) (2 * PI * F_0 C x_a e_0 X)) /\
  (* it is that of the angles at either output *)
  let t_high := down x_a e_0 X - up x_a e_0 X in let t_low := 2 * PI - t_high in
  (forall t, up x_a e_0 X < t < down x_a e_0 X -> y t = C) /\
  (forall t, down x_a e_0 X < t < up x_a e_0 X + 2 * PI -> y t = - C) /\
  F_0 C x_a e_0 X = F_0_of_times C t_high t_low.
Proof.
  intros C x_a e_0 X offset y Hxa law. pose proof PI_RGT_0.
  assert (HX : 0 < X) by (destruct law as [_ [S|[S _]]]; [pose proof (Rabs_pos e_0); lra|exact S]).
  assert (reach : x_a + Rabs e_0 <= X) by (destruct law as [_ [S|[_ [S _]]]]; lra).
  assert (T : forall a, is_RInt y a (a + 2 * PI) (2 * PI * F_0 C x_a e_0 X)).
  { intros a. eapply int_eq; [apply (over_a_turn C x_a e_0 X y (fun _ => 1) (fun t => t) (2 * PI) a Hxa law)|intros; cbv beta; ring|].
    - intros t. auto_derive; [trivial|ring].
    - intros t. apply continuous_const.
    - intros t. ring.
    - unfold down, up, F_0. field. lra. }
  split; [|split; [exact T|intros t_high t_low; split; [|split]]].
  - pose proof (T 0) as T0. rewrite Rplus_0_l in T0.
    rewrite (Y_0_of _ _ (int_plus _ _ _ _ _ _ T0 (int_const offset 0 (2 * PI)))). field. lra.
  - intros t. exact (high_between C x_a e_0 X Hxa HX reach y law t).
  - intros t. exact (low_between C x_a e_0 X Hxa HX reach y law t).
  - unfold F_0, F_0_of_times, t_low, t_high, down, up. field. lra.
Qed.

(** With the times exchanged the sign is wrong. *)
Theorem times_exchanged : forall C t_high t_low : R, 0 < C -> 0 < t_low < t_high ->
  F_0_of_times C t_low t_high < 0 < F_0_of_times C t_high t_low.
Proof.
  intros. unfold F_0_of_times. replace (C * (t_low - t_high) / (t_low + t_high)) with (- (C * (t_high - t_low) / (t_high + t_low))) by (field; lra).
  assert (0 < C * (t_high - t_low) / (t_high + t_low)) by (apply Rdiv_lt_0_compat; nra). lra.
Qed.

Print Assumptions statement.
