(** disturbance-and-drag (section 5.3's conclusion, eq. 30). The paper says: it was shown that the disturbance does not correlate to the
    identified drag. On the first harmonic it is so: [Q] of the relay, of which both drags are made, depends neither on the bias nor on
    an offset of the levels. On exact orbits it is not: a disturbance of half the relay's level moves the drag identified of one
    and the same vehicle by more than a fifth. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Interval Require Tactic.
From Interval.Float Require Import Specific_stdz Specific_ops.
From Selfosc Require Import Periodic Kernels Catalogue Claim_describing_function.
(** The tactic [interval] over Coq's own integers: the machine's are axioms to Coq. *)
Module Digits := SpecificFloat StdZRadix2.
Module Kernel := Tactic.IntervalTactic Digits.
Import Interval.Tactic Kernel.
Open Scope R_scope.

(** * On the first harmonic *)

Definition first_harmonic : Prop := forall C x_a x_0 x_0' X d d' e e', 0 <= x_a -> 0 < X -> x_a + Rabs x_0 <= X -> x_a + Rabs x_0' <= X ->
  describes (relay_hysteresis C x_a d) x_0 X e -> describes (relay_hysteresis C x_a d') x_0' X e' -> q e = q e'.

(** * On exact orbits *)

(** A vehicle with linear drag, [alpha v' + beta v = u + delta], and its two phases: at the command [+C] from one switching to the
    other, for the time [high], and at [-C] for the time [low]. *)
Record exact_orbit (alpha beta C x_a delta high low : R) (x_up v_up x_down v_down : R -> R) : Prop := {
  times : 0 < high /\ 0 < low;
  up_moves : forall t, is_derive x_up t (v_up t) /\ is_derive v_up t ((C + delta - beta * v_up t) / alpha);
  down_moves : forall t, is_derive x_down t (v_down t) /\ is_derive v_down t ((- C + delta - beta * v_down t) / alpha);
  up_between : x_up 0 = - x_a /\ x_up high = x_a;
  down_between : x_down 0 = x_a /\ x_down low = - x_a;
  speeds_meet : v_down 0 = v_up high /\ v_up 0 = v_down low;
  up_not_earlier : forall t, 0 <= t < high -> x_up t < x_a;
  down_not_earlier : forall t, 0 <= t < low -> - x_a < x_down t }.

(** Half its height, from the least output to the greatest. *)
Definition amplitude (x_up x_down : R -> R) (high low X : R) : Prop := exists t s, 0 <= t <= high /\ 0 <= s <= low /\
  (forall r, 0 <= r <= high -> x_up t <= x_up r <= x_down s) /\ (forall r, 0 <= r <= low -> x_up t <= x_down r <= x_down s) /\
  X = (x_down s - x_up t) / 2.

(** Eq. 27 with eq. 30: what is identified from the amplitude and the period. *)
Definition beta_identified (C x_a X T : R) : R := 4 * C * x_a / (PI * (2 * PI / T) * X ^ 2).

Definition on_exact_orbits : Prop := exists x_a high low high' low' X X',
  (exists x_up v_up x_down v_down, exact_orbit 1 1 1 x_a 0 high low x_up v_up x_down v_down /\ amplitude x_up x_down high low X) /\
  (exists x_up v_up x_down v_down, exact_orbit 1 1 1 x_a (- (1 / 2)) high' low' x_up v_up x_down v_down /\ amplitude x_up x_down high' low' X') /\
  12 / 10 * beta_identified 1 x_a X (high + low) < beta_identified 1 x_a X' (high' + low').

(** * Proof *)

Lemma first_harmonic_holds : first_harmonic.
Proof.
  intros C x_a x_0 x_0' X d d' e e' Ha HX H H' E E'.
  destruct (definition_holds _ _ _ _ HX (relay_holds C x_a x_0 X d Ha HX H)) as [_ [_ [_ [_ U]]]].
  destruct (definition_holds _ _ _ _ HX (relay_holds C x_a x_0' X d' Ha HX H')) as [_ [_ [_ [_ U']]]].
  rewrite (U e E), (U' e' E'). reflexivity.
Qed.

(** One phase at the constant force [U], from rest at [x0] with the speed [v0] against the force; unit inertia and drag. *)
Definition speed (U v0 t : R) : R := U + (v0 - U) * exp (- t).
Definition place (U x0 v0 t : R) : R := x0 + U * t - (speed U v0 t - v0).
Definition turn (U v0 : R) : R := ln ((U - v0) / U).

Lemma place_moves U x0 v0 t : is_derive (place U x0 v0) t (speed U v0 t).
Proof. unfold place, speed. auto_derive; trivial. ring. Qed.
Lemma speed_moves U v0 t : is_derive (speed U v0) t ((U - 1 * speed U v0 t) / 1).
Proof. unfold speed. auto_derive; trivial. field. Qed.

(** It is at rest at the turn, moves backwards before and forwards after. *)
Lemma speed_sign U v0 t : 0 < U -> v0 < 0 -> (t < turn U v0 -> speed U v0 t < 0) /\ (turn U v0 < t -> 0 < speed U v0 t).
Proof.
  intros HU Hv. assert (P : 0 < (U - v0) / U) by (apply Rdiv_lt_0_compat; lra).
  assert (E : (U - v0) * exp (- turn U v0) = U) by (unfold turn; rewrite exp_Ropp, exp_ln by exact P; field; lra).
  unfold speed. split; intros H.
  - assert (exp (- turn U v0) < exp (- t)) by (apply exp_increasing; lra). nra.
  - assert (exp (- t) < exp (- turn U v0)) by (apply exp_increasing; lra). nra.
Qed.

Lemma place_order U x0 v0 s t : 0 < U -> v0 < 0 -> s < t ->
  (t <= turn U v0 -> place U x0 v0 t < place U x0 v0 s) /\ (turn U v0 <= s -> place U x0 v0 s < place U x0 v0 t).
Proof.
  intros HU Hv st.
  destruct (MVT_cor2 (place U x0 v0) (speed U v0) s t st) as [r [E Hr]].
  - intros r _. apply is_derive_Reals, place_moves.
  - destruct (speed_sign U v0 r HU Hv) as [S1 S2]. split; intros H; [specialize (S1 ltac:(lra))|specialize (S2 ltac:(lra))]; nra.
Qed.

(** The whole phase: least at the turn, greatest at its ends, and not at the far end before its time. *)
Lemma phase U x0 v0 T : 0 < U -> v0 < 0 -> turn U v0 <= T -> x0 < place U x0 v0 T ->
  (forall t, 0 <= t <= T -> place U x0 v0 (turn U v0) <= place U x0 v0 t <= place U x0 v0 T) /\
  (forall t, 0 <= t < T -> place U x0 v0 t < place U x0 v0 T) /\ 0 < turn U v0.
Proof.
  intros HU Hv HT far.
  assert (P0 : 0 < turn U v0).
  { unfold turn. rewrite <- ln_1. apply ln_increasing; [lra|]. apply (Rmult_lt_reg_r U); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
  assert (start : place U x0 v0 0 = x0) by (unfold place, speed; rewrite Ropp_0, exp_0; ring).
  assert (order_ : forall s t, s < t -> (t <= turn U v0 -> place U x0 v0 t < place U x0 v0 s) /\ (turn U v0 <= s -> place U x0 v0 s < place U x0 v0 t))
    by (intros; now apply place_order).
  assert (strict : forall t, 0 <= t < T -> place U x0 v0 t < place U x0 v0 T).
  { intros t Ht. destruct (Rle_dec t (turn U v0)) as [L|L]; [|apply (order_ t T); lra].
    destruct (Req_dec t 0) as [->|N]; [rewrite start; exact far|]. pose proof (proj1 (order_ 0 t ltac:(lra)) L). lra. }
  split; [|split; [exact strict|exact P0]]. intros t Ht. split.
  - destruct (Rtotal_order t (turn U v0)) as [L|[->|L]]; [|lra|].
    + pose proof (proj1 (order_ t (turn U v0) L) ltac:(lra)). lra.
    + pose proof (proj2 (order_ (turn U v0) t L) ltac:(lra)). lra.
  - destruct (Req_dec t T) as [->|N]; [lra|]. left. apply strict. lra.
Qed.

(** Two phases that meet: an orbit, and its amplitude. [D] is the force of the second phase, turned upside down. *)
Lemma orbit x_a delta high low a b : 0 < x_a -> 0 < high -> 0 < low -> 0 < 1 + delta -> 0 < 1 - delta -> a < 0 -> 0 < b ->
  b = speed (1 + delta) a high -> - a = speed (1 - delta) (- b) low ->
  2 * x_a = (1 + delta) * high - (b - a) -> 2 * x_a = (1 - delta) * low - (b - a) ->
  turn (1 + delta) a <= high -> turn (1 - delta) (- b) <= low ->
  let x_up := place (1 + delta) (- x_a) a in let x_down := fun t => - place (1 - delta) (- x_a) (- b) t in
  exact_orbit 1 1 1 x_a delta high low x_up (speed (1 + delta) a) x_down (fun t => - speed (1 - delta) (- b) t) /\
  amplitude x_up x_down high low
    ((- place (1 - delta) (- x_a) (- b) (turn (1 - delta) (- b)) - place (1 + delta) (- x_a) a (turn (1 + delta) a)) / 2).
Proof.
  intros Ha Hh Hl HU HD Na Pb Eb Ea W1 W2 T1 T2 x_up x_down.
  assert (up_end : place (1 + delta) (- x_a) a high = x_a) by (unfold place; rewrite <- Eb; lra).
  assert (down_end : place (1 - delta) (- x_a) (- b) low = x_a) by (unfold place; rewrite <- Ea; lra).
  assert (start : forall U v, place U (- x_a) v 0 = - x_a) by (intros; unfold place, speed; rewrite Ropp_0, exp_0; ring).
  assert (start_v : forall U v, speed U v 0 = v) by (intros; unfold speed; rewrite Ropp_0, exp_0; ring).
  destruct (phase (1 + delta) (- x_a) a high HU Na T1 ltac:(lra)) as [U1 [U2 U3]].
  destruct (phase (1 - delta) (- x_a) (- b) low HD ltac:(lra) T2 ltac:(lra)) as [D1 [D2 D3]].
  split.
  - constructor; unfold x_up, x_down.
    + lra.
    + intros t. split; [apply place_moves|]. exact (speed_moves (1 + delta) a t).
    + intros t. split.
      * apply (is_derive_opp (V := R_NormedModule) (place (1 - delta) (- x_a) (- b))), place_moves.
      * replace ((- (1) + delta - 1 * - speed (1 - delta) (- b) t) / 1) with (- ((1 - delta - 1 * speed (1 - delta) (- b) t) / 1)) by field.
        apply (is_derive_opp (V := R_NormedModule) (speed (1 - delta) (- b))), speed_moves.
    + rewrite start, up_end. lra.
    + rewrite start, down_end. lra.
    + rewrite !start_v. lra.
    + intros t Ht. pose proof (U2 t Ht). lra.
    + intros t Ht. pose proof (D2 t Ht). lra.
  - exists (turn (1 + delta) a), (turn (1 - delta) (- b)). unfold x_up, x_down. split; [lra|]. split; [lra|].
    pose proof (U1 0 ltac:(lra)) as M. rewrite start, up_end in M. pose proof (D1 0 ltac:(lra)) as N. rewrite start, down_end in N.
    split; [|split; [|reflexivity]].
    + intros r Hr. pose proof (U1 r Hr). lra.
    + intros r Hr. pose proof (D1 r Hr). lra.
Qed.

(** With a disturbance of minus one half: fifteen time constants at the command up, five at the command down. *)
Definition e_up : R := exp (- (15)).
Definition e_down : R := exp (- (5)).
Definition v_low : R := (- (3 / 2) * (1 - e_down) + e_down * (1 / 2) * (1 - e_up)) / (1 - e_up * e_down).
Definition v_high : R := 1 / 2 + (v_low - 1 / 2) * e_up.
Definition level : R := (1 / 2 * 15 - (v_high - v_low)) / 2.

(** Without: the half period [2 z] solves [z - tanh z = x_a]. *)
Definition th (z : R) : R := (1 - exp (- (2 * z))) / (1 + exp (- (2 * z))).

Lemma half_period : exists z, 3.75 <= z <= 3.76 /\ z - th z = level.
Proof.
  assert (C : continuity (fun z => z - th z - level)).
  { intros z. apply continuity_pt_filterlim. assert (D : ex_derive (fun z => z - th z - level) z).
    { unfold th. auto_derive. pose proof (exp_pos (- (2 * z))). lra. }
    exact (ex_derive_continuous (V := R_NormedModule) (fun z => z - th z - level) z D). }
  destruct (IVT (fun z => z - th z - level) 3.75 3.76 C ltac:(lra)) as [z [Hz E]].
  - unfold th, level, v_high, v_low, e_up, e_down. interval with (i_prec 40).
  - unfold th, level, v_high, v_low, e_up, e_down. interval with (i_prec 40).
  - exists z. split; [exact Hz|lra].
Qed.

Lemma on_exact_orbits_holds : on_exact_orbits.
Proof.
  destruct half_period as [z [Hz E]]. set (x_a := level).
  assert (Ha : 0 < x_a) by (unfold x_a, level, v_high, v_low, e_up, e_down; interval with (i_prec 40)).
  assert (Hth : 0.99 < th z < 1) by (unfold th; split; interval with (i_prec 40)).
  assert (Nz : 1 + exp (- (2 * z)) <> 0) by (pose proof (exp_pos (- (2 * z))); lra).
  (* the symmetric orbit *)
  destruct (orbit x_a 0 (2 * z) (2 * z) (- th z) (th z)) as [O A]; try lra.
  { unfold speed, th. field. exact Nz. }
  { unfold speed, th. field. exact Nz. }
  { unfold x_a. lra. }
  { unfold x_a. lra. }
  { apply Rminus_le. unfold turn, th. interval with (i_prec 40). }
  { apply Rminus_le. unfold turn, th. interval with (i_prec 40). }
  (* the disturbed one *)
  assert (Vl : v_low < 0) by (unfold v_low, e_up, e_down; interval with (i_prec 40)).
  assert (Vh : 0 < v_high) by (unfold v_high, v_low, e_up, e_down; interval with (i_prec 40)).
  assert (Ne : 1 - e_up * e_down <> 0) by (apply Rgt_not_eq; unfold e_up, e_down; interval with (i_prec 40)).
  destruct (orbit x_a (- (1 / 2)) 15 5 v_low v_high) as [O' A']; try lra.
  { unfold v_high, speed. fold e_up. field. }
  { unfold speed. fold e_down. unfold v_high, v_low. field. exact Ne. }
  { unfold x_a, level. lra. }
  { unfold x_a, level. lra. }
  { unfold turn, v_low, e_up, e_down. interval with (i_prec 40). }
  { unfold turn, v_high, v_low, e_up, e_down. interval with (i_prec 40). }
  do 7 eexists. split; [do 4 eexists; split; [exact O|exact A]|]. split; [do 4 eexists; split; [exact O'|exact A']|].
  unfold beta_identified, place, speed, turn, x_a, level, v_high, v_low, th, e_up, e_down.
  interval with (i_prec 40).
Qed.

Theorem statement : first_harmonic /\ on_exact_orbits.
Proof. exact (conj first_harmonic_holds on_exact_orbits_holds). Qed.
Print Assumptions statement.
