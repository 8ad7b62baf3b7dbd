(** claim: surge (eq. 44)
    Where speed is what is measured, feed the relay with minus its integral: [alpha u' + beta(u) u = X(t - 2 T_d) + tau_XE] then
    oscillates as the yaw axis does, with the integral in the place of heading. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

Section Surge.
Variables alpha beta_1 beta_2 tau C x_a T_d : R.

(** The equation of the speed alone, of first order, under the delayed command. *)
Definition first_order (speed command : R -> R) : Prop :=
  (forall t, 0 < t -> continuous speed t) /\
  (forall t, 0 < t -> locally t (fun s => command (s - 2 * T_d) = command (t - 2 * T_d)) ->
    is_derive speed t ((command (t - 2 * T_d) + tau - drag beta_1 beta_2 (speed t)) / alpha)).

(** The integral of the speed, from whatever it is at the instant 1. *)
Definition integral (speed : R -> R) (at_one t : R) : R := at_one + RInt speed 1 t.

(** Surge with the integral fed back; yaw, or any axis of eq. 36. *)
Definition surge_loop (speed command : R -> R) (at_one : R) : Prop :=
  first_order speed command /\ relay later C x_a (fun t => - integral speed at_one t) command.
Definition yaw_loop (heading rate command : R -> R) : Prop :=
  axis 0 alpha beta_1 beta_2 tau (fun t => command (t - 2 * T_d)) heading rate /\ relay later C x_a (fun t => - heading t) command.

Lemma integral_derive (speed : R -> R) (at_one t : R) : (forall t, 0 < t -> continuous speed t) -> 0 < t ->
  is_derive (integral speed at_one) t (speed t).
Proof.
  intros cont Ht. assert (D : is_derive (fun s => RInt speed 1 s) t (speed t)).
  { apply (is_derive_RInt (V := R_CompleteNormedModule) speed (fun s => RInt speed 1 s) 1 t); [|apply cont, Ht].
    exists (mkposreal (t / 2) ltac:(lra)). intros s Hs. apply (RInt_correct (V := R_CompleteNormedModule)).
    apply (ex_RInt_continuous (V := R_CompleteNormedModule)). intros r Hr. apply cont.
    unfold ball in Hs; simpl in Hs; unfold AbsRing_ball, abs, minus, plus, opp in Hs; simpl in Hs. apply Rabs_def2 in Hs.
    pose proof (Rmin_glb 1 s (Rmin 1 (t / 2))) as G. pose proof (Rmin_l 1 (t / 2)). pose proof (Rmin_r 1 (t / 2)).
    assert (0 < Rmin 1 (t / 2)) by (apply Rmin_pos; lra). lra. }
  unfold integral. replace (speed t) with (plus 0 (speed t)) by (unfold plus; simpl; ring).
  exact (is_derive_plus (fun _ => at_one) (fun s => RInt speed 1 s) t 0 (speed t) (is_derive_const at_one t) D).
Qed.

Theorem statement_here :
  (* a motion of the surge loop is one of the yaw loop, with the integral for heading *)
  (forall speed command at_one, surge_loop speed command at_one -> yaw_loop (integral speed at_one) speed command) /\
  (* and a motion of the yaw loop one of the surge loop, with the heading for integral *)
  (forall heading rate command, yaw_loop heading rate command ->
    surge_loop rate command (heading 1) /\ forall t, 0 < t -> integral rate (heading 1) t = heading t).
Proof.
  split.
  - intros speed command at_one [[cont newton] L]. split; [|exact L]. split; [|exact cont|exact newton].
    intros t Ht. apply integral_derive; assumption.
  - intros heading rate command [[vel cont newton] L].
    assert (E : forall t, 0 < t -> integral rate (heading 1) t = heading t).
    { intros t Ht. assert (D : forall s, 0 < s -> is_derive (fun r => integral rate (heading 1) r - heading r) s 0).
      { intros s Hs. replace 0 with (minus (rate s) (rate s)) by (unfold minus, plus, opp; simpl; ring).
        apply (is_derive_minus (integral rate (heading 1)) heading); [apply integral_derive; assumption|apply vel, Hs]. }
      assert (Z : integral rate (heading 1) 1 - heading 1 = 0).
      { unfold integral. rewrite (RInt_point (V := R_CompleteNormedModule) 1 rate). unfold zero; simpl. ring. }
      enough (K : integral rate (heading 1) t - heading t = integral rate (heading 1) 1 - heading 1) by lra.
      destruct (Rle_lt_dec 1 t) as [Q|Q].
      - apply (is_constant (fun r => integral rate (heading 1) r - heading r) 1 t Q); intros s Hs; [apply D; lra|].
        apply (continuity_of_derive _ s 0), D. lra.
      - symmetry. apply (is_constant (fun r => integral rate (heading 1) r - heading r) t 1); [lra| |]; intros s Hs; [apply D; lra|].
        apply (continuity_of_derive _ s 0), D. lra. }
    split; [|exact E]. split; [split; assumption|].
    destruct L as [a b c d e]. split.
    + exact a.
    + intros t I H. apply b; [exact I|]. rewrite <- E; assumption.
    + intros t I H. apply c; [exact I|]. rewrite <- E; assumption.
    + intros s t Is It st Y H. apply (d s t Is It st Y). intros r Ir Hr. rewrite <- E by assumption. apply H; assumption.
    + intros s t Is It st Y H. apply (e s t Is It st Y). intros r Ir Hr. rewrite <- E by assumption. apply H; assumption.
Qed.
End Surge.

Theorem statement : forall (alpha beta_1 beta_2 tau C x_a T_d : R),
  (forall speed command at_one, surge_loop alpha beta_1 beta_2 tau C x_a T_d speed command at_one ->
    yaw_loop alpha beta_1 beta_2 tau C x_a T_d (integral speed at_one) speed command) /\
  (forall heading rate command, yaw_loop alpha beta_1 beta_2 tau C x_a T_d heading rate command ->
    surge_loop alpha beta_1 beta_2 tau C x_a T_d rate command (heading 1) /\
    forall t, 0 < t -> integral rate (heading 1) t = heading t).
Proof. exact statement_here. Qed.

(** The speed itself fed to the relay: at half of the half-width it stays, and never switches, as no loop with the integral does. *)
Theorem needs_integrated : exists speed command : R -> R,
  first_order 1 1 0 0 0 speed command /\ relay later 1 2 (fun t => - speed t) command /\
  forall at_one, ~ surge_loop 1 1 0 0 1 2 0 speed command at_one.
Proof.
  exists (fun _ => 1), (fun _ => 1). split; [|split].
  - split; [intros; apply continuous_const|]. intros t Ht _. unfold drag.
    replace ((1 + 0 - (1 * 1 + 0 * (1 * Rabs 1))) / 1) with 0 by field. exact (is_derive_const 1 t).
  - split; intros; lra.
  - intros at_one [_ L]. assert (I : forall t, integral (fun _ => 1) at_one t = at_one + (t - 1)).
    { intros t. unfold integral. rewrite (int_unique _ _ _ _ (int_const 1 1 t)). ring. }
    pose proof (low _ _ _ _ _ L (4 + Rabs at_one)) as Lo. cbv beta in Lo. rewrite I in Lo.
    assert (- Rabs at_one <= at_one) by (unfold Rabs; destruct (Rcase_abs at_one); lra).
    specialize (Lo ltac:(unfold later; pose proof (Rabs_pos at_one); lra) ltac:(lra)). lra.
Qed.

Print Assumptions statement.
