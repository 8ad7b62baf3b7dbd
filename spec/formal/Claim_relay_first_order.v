(** claim: relay-first-order (of this project)
    The process [drag y' + stiffness y = u(t - L) + load] under a two-level relay with hysteresis: a motion that comes down to the
    lower level after the lower command has stood for a dead time L is periodic from then on, with the half-periods and the extremes of
    the formulas. Stiffness zero is the integrator with dead time. *)
From Coq Require Import Reals Lra Lia Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Switching.
From Selfosc Require Claim_relay_ultimate.
Open Scope R_scope.

(** The loop: the process wherever the command stays, y without jumps; the relay commands [low] above the upper level and [high] below
    the lower one, and stays as it is between. At a level itself nothing is asked. *)
Record loop (d k L load high low upper lower : R) (y u : R -> R) : Prop := {
  no_jump : forall t, continuous y t;
  process : forall t, locally t (fun s => u (s - L) = u (t - L)) -> is_derive y t ((u (t - L) + load - k * y t) / d);
  low_above : forall t, upper < y t -> u t = low;
  high_below : forall t, y t < lower -> u t = high;
  stays_high : forall s t, s <= t -> u s = high -> (forall r, s < r <= t -> y r < upper) -> u t = high;
  stays_low : forall s t, s <= t -> u s = low -> (forall r, s < r <= t -> lower < y r) -> u t = low }.

(** The answer to a unit of force after a time, and the time after which it has a value. *)
Definition settle (d k t : R) : R := if Req_EM_T k 0 then t / d else (1 - exp (- (k / d) * t)) / k.
Definition time_to (d k z : R) : R := if Req_EM_T k 0 then d * z else - (d / k) * ln (1 - k * z).

(** Extremes, and the time from one to the level on the other side. *)
Definition minimum (d k L load low lower : R) : R := lower + (low + load - k * lower) * settle d k L.
Definition maximum (d k L load high upper : R) : R := upper + (high + load - k * upper) * settle d k L.
Definition rise (d k L load high low upper lower : R) : R :=
  let m := minimum d k L load low lower in time_to d k ((upper - m) / (high + load - k * m)).
Definition fall (d k L load high low upper lower : R) : R :=
  let m := maximum d k L load high upper in time_to d k ((lower - m) / (low + load - k * m)).
Definition time_high d k L load high low upper lower : R := L + rise d k L load high low upper lower.
Definition time_low d k L load high low upper lower : R := L + fall d k L load high low upper lower.

(** The output over the half with the upper command: on down for a dead time, then up. *)
Definition up_half (d k L load high low lower s : R) : R :=
  let m := minimum d k L load low lower in
  if Rle_dec s L then lower + (low + load - k * lower) * settle d k s else m + (high + load - k * m) * settle d k (s - L).

Section Answer.
Variables d k : R.
Hypotheses (Hd : 0 < d) (Hk : 0 <= k).

Lemma settle_0 : settle d k 0 = 0.
Proof. unfold settle. destruct (Req_EM_T k 0); [field; lra|]. rewrite Rmult_0_r, exp_0. field; assumption. Qed.

Lemma settle_derive t : is_derive (settle d k) t ((1 - k * settle d k t) / d).
Proof.
  unfold settle. destruct (Req_EM_T k 0) as [->|N].
  - auto_derive; [lra|]. field. lra.
  - auto_derive; [exact I|]. field. split; lra.
Qed.

Lemma settle_increases s t : s < t -> settle d k s < settle d k t.
Proof.
  intros H. unfold settle. destruct (Req_EM_T k 0) as [->|N].
  - unfold Rdiv. apply Rmult_lt_compat_r; [apply Rinv_0_lt_compat|]; lra.
  - assert (0 < k) by lra. unfold Rdiv. apply Rmult_lt_compat_r; [apply Rinv_0_lt_compat; lra|].
    assert (exp (- (k / d) * t) < exp (- (k / d) * s)); [|lra]. apply exp_increasing.
    assert (0 < k / d) by (apply Rdiv_lt_0_compat; lra). nra.
Qed.

Lemma settle_below t : k * settle d k t < 1.
Proof.
  unfold settle. destruct (Req_EM_T k 0) as [->|N]; [lra|].
  replace (k * ((1 - exp (- (k / d) * t)) / k)) with (1 - exp (- (k / d) * t)) by (field; lra). pose proof (exp_pos (- (k / d) * t)). lra.
Qed.

Lemma settle_time z : k * z < 1 -> settle d k (time_to d k z) = z.
Proof.
  intros H. unfold settle, time_to. destruct (Req_EM_T k 0) as [->|N]; [field; lra|].
  replace (- (k / d) * (- (d / k) * ln (1 - k * z))) with (ln (1 - k * z)) by (field; lra). rewrite exp_ln by lra. field; lra.
Qed.
End Answer.

Section Loop.
Variables d k L load high low upper lower : R.
Hypotheses (Hd : 0 < d) (Hk : 0 <= k) (HL : 0 < L) (Levels : lower <= upper).
Hypotheses (Sinks : low + load < k * lower) (Climbs : k * upper < high + load).
Notation S := (settle d k).
Notation m := (minimum d k L load low lower).
Notation tau := (rise d k L load high low upper lower).

(** Where the command was w all along, the process answers. *)
Lemma answers y u a b w : loop d k L load high low upper lower y u -> a <= b -> (forall t, a < t < b -> u (t - L) = w) ->
  y b = y a + (w + load - k * y a) * S (b - a).
Proof.
  intros M ab U. set (f := fun t => (y t - (y a + (w + load - k * y a) * S (t - a))) * exp (k / d * (t - a))).
  assert (E : f b = f a).
  { apply (is_constant f a b ab).
    - intros t Ht.
      assert (Lo : locally t (fun s => u (s - L) = u (t - L))).
      { assert (P : 0 < Rmin (t - a) (b - t)) by (apply Rmin_pos; lra). exists (mkposreal _ P). intros s Hs.
        change (Rabs (s - t) < Rmin (t - a) (b - t)) in Hs. apply Rabs_def2 in Hs.
        pose proof (Rmin_l (t - a) (b - t)). pose proof (Rmin_r (t - a) (b - t)). rewrite !U by lra. reflexivity. }
      pose proof (process _ _ _ _ _ _ _ _ _ _ M t Lo) as D. rewrite (U t Ht) in D.
      assert (Ds : is_derive (fun t => S (t - a)) t ((1 - k * S (t - a)) / d)).
      { evar_last; [apply (is_derive_comp S (fun t => t - a)); [apply settle_derive; assumption|auto_derive; [exact I|reflexivity]]|].
        unfold scal; simpl; unfold mult; simpl. ring. }
      assert (De : is_derive (fun t => exp (k / d * (t - a))) t (k / d * exp (k / d * (t - a)))) by (auto_derive; [exact I|replace (t + - a) with (t - a) by ring; ring]).
      unfold f. evar_last.
      + apply (is_derive_mult (fun t => y t - (y a + (w + load - k * y a) * S (t - a))) (fun t => exp (k / d * (t - a)))); [|exact De|intros; apply Rmult_comm].
        apply (is_derive_minus y); [exact D|]. apply (is_derive_plus (fun _ => y a)); [apply is_derive_const|]. apply is_derive_scal, Ds.
      + unfold minus, plus, opp, mult, zero; simpl. field. lra.
    - intros t Ht. unfold f. apply continuity_pt_mult.
      + apply continuity_pt_minus; [apply continuity_of_continuous, (no_jump _ _ _ _ _ _ _ _ _ _ M)|].
        apply continuity_of_derive with ((w + load - k * y a) * ((1 - k * S (t - a)) / d)).
        evar_last.
        * apply (is_derive_plus (fun _ => y a)); [apply is_derive_const|]. apply is_derive_scal.
          apply (is_derive_comp S (fun t => t - a)); [apply settle_derive; assumption|auto_derive; [exact I|reflexivity]].
        * unfold plus, zero, scal; simpl; unfold mult; simpl. ring.
      + apply continuity_of_derive with (k / d * exp (k / d * (t - a))). auto_derive; [exact I|replace (t + - a) with (t - a) by ring; ring]. }
  unfold f in E. replace (a - a) with 0 in E by ring. rewrite (settle_0 d k Hd), !Rmult_0_r, exp_0 in E.
  assert (Q : (y b - (y a + (w + load - k * y a) * S (b - a))) * exp (k / d * (b - a)) = 0) by (rewrite E; ring).
  apply Rmult_integral in Q. destruct Q as [Q|Q]; [lra|]. pose proof (exp_pos (k / d * (b - a))). lra.
Qed.

Lemma minimum_below : m < lower.
Proof.
  unfold minimum. pose proof (settle_increases d k Hd Hk 0 L HL) as P. rewrite (settle_0 d k Hd) in P. nra.
Qed.

Lemma drives_at_minimum : 0 < high + load - k * m.
Proof. pose proof minimum_below. nra. Qed.

Lemma share : k * ((upper - m) / (high + load - k * m)) < 1.
Proof.
  pose proof drives_at_minimum as P. apply (Rmult_lt_reg_r (high + load - k * m)); [exact P|].
  replace (k * ((upper - m) / (high + load - k * m)) * (high + load - k * m)) with (k * (upper - m)) by (field; lra). lra.
Qed.

Lemma rise_positive : 0 < tau.
Proof.
  pose proof minimum_below as B. pose proof drives_at_minimum as P. unfold rise. cbv zeta.
  assert (Z : 0 < (upper - m) / (high + load - k * m)) by (apply Rdiv_lt_0_compat; lra).
  destruct (Rle_lt_dec (time_to d k ((upper - m) / (high + load - k * m))) 0) as [Q|Q]; [exfalso|exact Q].
  pose proof (settle_time d k Hd Hk _ share) as E. destruct Q as [Q|Q].
  - apply (settle_increases d k Hd Hk) in Q. rewrite E, (settle_0 d k Hd) in Q. lra.
  - rewrite Q, (settle_0 d k Hd) in E. lra.
Qed.

(** The rise meets the upper level at its end, and not before. *)
Lemma rise_meets : m + (high + load - k * m) * S tau = upper.
Proof.
  pose proof drives_at_minimum as P. unfold rise. cbv zeta. rewrite (settle_time d k Hd Hk _ share). field. lra.
Qed.

Lemma rise_below s : s < tau -> m + (high + load - k * m) * S s < upper.
Proof.
  intros H. rewrite <- rise_meets. pose proof drives_at_minimum as P. pose proof (settle_increases d k Hd Hk s tau H). nra.
Qed.

(** One half: the shape, and the upper command all along. *)
Lemma one_half y u b : loop d k L load high low upper lower y u -> y b = lower -> (forall t, b - L < t < b -> u t = low) ->
  (forall s, 0 <= s <= L + tau -> y (b + s) = up_half d k L load high low lower s) /\ (forall t, b < t < b + (L + tau) -> u t = high).
Proof.
  intros M Yb Before. pose proof rise_positive as Pt. pose proof minimum_below as Bm. pose proof M as [J P LA HB SH SL].
  (* The dead time. *)
  assert (D : forall s, 0 <= s <= L -> y (b + s) = lower + (low + load - k * lower) * S s).
  { intros s Hs. rewrite (answers y u b (b + s) low M) by (try lra; intros t Ht; apply Before; lra). rewrite Yb. replace (b + s - b) with s by ring. reflexivity. }
  assert (U0 : forall t, b < t <= b + L -> u t = high).
  { intros t Ht. apply HB. replace t with (b + (t - b)) by ring. rewrite D by lra.
    pose proof (settle_increases d k Hd Hk 0 (t - b) ltac:(lra)) as Q. rewrite (settle_0 d k Hd) in Q. nra. }
  assert (Ym : y (b + L) = m) by (rewrite D by lra; reflexivity).
  (* The rise, by steps of a dead time: the command of a step is known when the output of the step before is. *)
  assert (Steps : forall n : nat, forall s, 0 <= s <= tau -> s <= INR n * L -> y (b + L + s) = m + (high + load - k * m) * S s).
  { induction n as [|n IH]; intros s Hs Hn.
    - simpl in Hn. assert (s = 0) by lra. subst s. rewrite Rplus_0_r, (settle_0 d k Hd), Ym. ring.
    - rewrite S_INR in Hn. rewrite (answers y u (b + L) (b + L + s) high M); [rewrite Ym; replace (b + L + s - (b + L)) with s by ring; reflexivity|lra|].
      intros t Ht. destruct (Rle_lt_dec (t - L) (b + L)) as [Q|Q]; [apply U0; lra|].
      apply (SH (b + L)); [lra|apply U0; lra|]. intros r Hr. replace r with (b + L + (r - b - L)) by ring.
      rewrite IH by lra. apply rise_below. lra. }
  assert (R : forall s, 0 <= s <= tau -> y (b + L + s) = m + (high + load - k * m) * S s).
  { intros s Hs. destruct (archimed (s / L)) as [A _]. set (z := up (s / L)) in *.
    assert (0 <= s / L) by (apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; lra]).
    assert (Z : (0 <= z)%Z) by (apply le_IZR; lra). apply (Steps (Z.to_nat z) s Hs).
    rewrite INR_IZR_INZ, Z2Nat.id by exact Z. replace s with (s / L * L) at 1 by (field; lra). apply Rmult_le_compat_r; lra. }
  split.
  - intros s Hs. unfold up_half. cbv zeta. destruct (Rle_dec s L) as [Q|Q]; [apply D; lra|].
    replace (b + s) with (b + L + (s - L)) by ring. apply R. lra.
  - intros t Ht. destruct (Rle_lt_dec t (b + L)) as [Q|Q]; [apply U0; lra|].
    apply (SH (b + L)); [lra|apply U0; lra|]. intros r Hr. replace r with (b + L + (r - b - L)) by ring. rewrite R by lra. apply rise_below. lra.
Qed.

(** The half ends at the upper level and stays between the minimum and that level. *)
Lemma half_ends : up_half d k L load high low lower (L + tau) = upper.
Proof.
  pose proof rise_positive. unfold up_half. cbv zeta. destruct (Rle_dec (L + tau) L); [lra|]. replace (L + tau - L) with tau by ring. exact rise_meets.
Qed.

Lemma half_within s : 0 <= s <= L + tau -> m <= up_half d k L load high low lower s <= upper.
Proof.
  intros Hs. pose proof minimum_below as Bm. pose proof drives_at_minimum as P. unfold up_half. cbv zeta.
  assert (I : forall r t, r <= t -> S r <= S t).
  { intros r t [H| ->]; [left; apply settle_increases; assumption|right; reflexivity]. }
  pose proof (settle_0 d k Hd) as Z. destruct (Rle_dec s L) as [Q|Q].
  - pose proof (I 0 s ltac:(lra)) as I0. pose proof (I s L Q) as IL. rewrite Z in I0. unfold minimum. nra.
  - pose proof (I 0 (s - L) ltac:(lra)) as I0. rewrite Z in I0. pose proof (I (s - L) tau ltac:(lra)) as It. pose proof rise_meets. nra.
Qed.
End Loop.

Lemma mirrored d k L load high low upper lower y u : loop d k L load high low upper lower y u ->
  loop d k L (- load) (- low) (- high) (- lower) (- upper) (fun t => - y t) (fun t => - u t).
Proof.
  intros [J P LA HB SH SL]. split.
  - intros t. apply (continuous_opp (K := R_AbsRing) y), J.
  - intros t Lo. assert (Lo' : locally t (fun s => u (s - L) = u (t - L))) by (revert Lo; apply filter_imp; intros s; lra).
    pose proof (is_derive_opp (K := R_AbsRing) y t _ (P t Lo')) as D. evar_last; [exact D|]. unfold opp; simpl. unfold Rdiv. ring.
  - intros t H. rewrite HB by lra. ring.
  - intros t H. rewrite LA by lra. ring.
  - intros s t st H B. rewrite (SL s t st); [ring|lra|]. intros r Hr. specialize (B r Hr). cbv beta in B. lra.
  - intros s t st H B. rewrite (SH s t st); [ring|lra|]. intros r Hr. specialize (B r Hr). cbv beta in B. lra.
Qed.

Section Mirror.
Variables d k L load high low upper lower : R.

Lemma mirrored_minimum : minimum d k L (- load) (- high) (- upper) = - maximum d k L load high upper.
Proof. unfold minimum, maximum. ring. Qed.

Lemma mirrored_rise : rise d k L (- load) (- low) (- high) (- lower) (- upper) = fall d k L load high low upper lower.
Proof.
  unfold rise, fall. cbv zeta. rewrite mirrored_minimum. f_equal. set (M := maximum d k L load high upper).
  replace (- lower - - M) with (- (lower - M)) by ring. replace (- low + - load - k * - M) with (- (low + load - k * M)) by ring.
  destruct (Req_EM_T (low + load - k * M) 0) as [->|N]; [rewrite Ropp_0; unfold Rdiv; rewrite Rinv_0; ring|field; lra].
Qed.
End Mirror.

(** The output over a whole period. *)
Definition cycle (d k L load high low upper lower s : R) : R :=
  let T := time_high d k L load high low upper lower in
  if Rle_dec s T then up_half d k L load high low lower s else - up_half d k L (- load) (- low) (- high) (- upper) (s - T).

Section Cycle.
Variables d k L load high low upper lower : R.
Hypotheses (Hd : 0 < d) (Hk : 0 <= k) (HL : 0 < L) (Levels : lower <= upper).
Hypotheses (Sinks : low + load < k * lower) (Climbs : k * upper < high + load).
Notation T_high := (time_high d k L load high low upper lower).
Notation T_low := (time_low d k L load high low upper lower).
Notation shape := (cycle d k L load high low upper lower).

Lemma times : L < T_high /\ L < T_low.
Proof.
  unfold time_high, time_low. pose proof (rise_positive d k L load high low upper lower Hd Hk HL Levels Sinks Climbs).
  pose proof (rise_positive d k L (- load) (- low) (- high) (- lower) (- upper) Hd Hk HL ltac:(lra) ltac:(lra) ltac:(lra)) as F.
  rewrite mirrored_rise in F. lra.
Qed.

Lemma one_period y u b : loop d k L load high low upper lower y u -> y b = lower -> (forall t, b - L < t < b -> u t = low) ->
  (forall s, 0 <= s <= T_high + T_low -> y (b + s) = shape s) /\ (forall t, b < t < b + T_high -> u t = high) /\
  (forall t, b + T_high < t < b + (T_high + T_low) -> u t = low) /\ y (b + (T_high + T_low)) = lower.
Proof.
  intros M Yb Before. pose proof times as Ti.
  destruct (one_half _ _ _ _ _ _ _ _ Hd Hk HL Levels Sinks Climbs y u b M Yb Before) as [Y U]. fold T_high in Y, U.
  pose proof (half_ends d k L load high low upper lower Hd Hk HL Levels Sinks Climbs) as E. fold T_high in E.
  assert (Yc : - y (b + T_high) = - upper) by (rewrite Y by (unfold time_high in *; lra); f_equal; exact E).
  assert (Uc : forall t, b + T_high - L < t < b + T_high -> - u t = - high) by (intros t Ht; rewrite U by (unfold time_high in *; lra); reflexivity).
  destruct (one_half d k L (- load) (- low) (- high) (- lower) (- upper) Hd Hk HL ltac:(lra) ltac:(lra) ltac:(lra) _ _ _ (mirrored _ _ _ _ _ _ _ _ _ _ M) Yc Uc)
    as [Y' U'].
  pose proof (half_ends d k L (- load) (- low) (- high) (- lower) (- upper) Hd Hk HL ltac:(lra) ltac:(lra) ltac:(lra)) as E'.
  rewrite mirrored_rise in Y', U', E'. fold T_low in Y', U', E'. cbv beta in Y', U'.
  assert (W : forall s, 0 <= s <= T_high + T_low -> y (b + s) = shape s).
  { intros s Hs. unfold cycle. cbv zeta. destruct (Rle_dec s T_high) as [Q|Q]; [apply Y; unfold time_high in *; lra|].
    rewrite <- Y' by (unfold time_low in *; lra). replace (b + T_high + (s - T_high)) with (b + s) by ring. ring. }
  split; [exact W|]. split; [exact U|]. split.
  - intros t Ht. specialize (U' t ltac:(unfold time_low in *; lra)). lra.
  - replace (b + (T_high + T_low)) with (b + T_high + T_low) by ring. specialize (Y' T_low ltac:(unfold time_low in *; lra)). rewrite E' in Y'. lra.
Qed.

Lemma periods y u b n : loop d k L load high low upper lower y u -> y b = lower -> (forall t, b - L < t < b -> u t = low) ->
  y (b + INR n * (T_high + T_low)) = lower /\ forall t, b + INR n * (T_high + T_low) - L < t < b + INR n * (T_high + T_low) -> u t = low.
Proof.
  intros M Yb Before. pose proof times as Ti. induction n as [|n [Yn Un]].
  - simpl. rewrite Rmult_0_l, Rplus_0_r. split; assumption.
  - destruct (one_period y u _ M Yn Un) as [_ [_ [U Y]]]. rewrite S_INR.
    replace (b + (INR n + 1) * (T_high + T_low)) with (b + INR n * (T_high + T_low) + (T_high + T_low)) by ring.
    split; [exact Y|]. intros t Ht. apply U. lra.
Qed.

Lemma shape_within s : 0 <= s <= T_high + T_low -> minimum d k L load low lower <= shape s <= maximum d k L load high upper.
Proof.
  intros Hs. pose proof (minimum_below d k L load low lower Hd Hk HL Sinks) as B.
  pose proof (minimum_below d k L (- load) (- high) (- upper) Hd Hk HL ltac:(lra)) as B'. rewrite mirrored_minimum in B'.
  unfold cycle. cbv zeta. destruct (Rle_dec s T_high) as [Q|Q].
  - pose proof (half_within d k L load high low upper lower Hd Hk HL Levels Sinks Climbs s) as W. unfold time_high in Q. lra.
  - pose proof (half_within d k L (- load) (- low) (- high) (- lower) (- upper) Hd Hk HL ltac:(lra) ltac:(lra) ltac:(lra) (s - T_high)) as W.
    rewrite mirrored_rise, mirrored_minimum in W. unfold time_low in Hs. lra.
Qed.
End Cycle.

Theorem statement : forall d k L load high low upper lower : R,
  0 < d -> 0 <= k -> 0 < L -> lower <= upper -> low + load < k * lower -> k * upper < high + load ->
  let T_high := time_high d k L load high low upper lower in
  let T_low := time_low d k L load high low upper lower in
  let P := T_high + T_low in
  forall y u b, loop d k L load high low upper lower y u -> y b = lower -> (forall t, b - L < t < b -> u t = low) ->
  (* after any number of periods the same begins again *)
  (forall n s, 0 <= s <= P -> y (b + INR n * P + s) = cycle d k L load high low upper lower s) /\
  (forall n t, b + INR n * P < t < b + INR n * P + T_high -> u t = high) /\
  (forall n t, b + INR n * P + T_high < t < b + INR n * P + P -> u t = low) /\
  (* the extremes are met, and nothing is beyond them *)
  y (b + L) = minimum d k L load low lower /\ y (b + T_high + L) = maximum d k L load high upper /\
  (forall t, b <= t -> minimum d k L load low lower <= y t <= maximum d k L load high upper).
Proof.
  intros d k L load high low upper lower Hd Hk HL Levels Sinks Climbs T_high T_low P y u b M Yb Before.
  pose proof (times d k L load high low upper lower Hd Hk HL Levels Sinks Climbs) as Ti. fold T_high T_low in Ti.
  assert (One : forall n, _) by (intros n; destruct (periods d k L load high low upper lower Hd Hk HL Levels Sinks Climbs y u b n M Yb Before) as [Yn Un];
    exact (one_period d k L load high low upper lower Hd Hk HL Levels Sinks Climbs y u _ M Yn Un)). fold T_high T_low P in One.
  assert (Shape : forall n s, 0 <= s <= P -> y (b + INR n * P + s) = cycle d k L load high low upper lower s) by (intros n; apply One).
  assert (Begin : forall s, 0 <= s <= P -> y (b + s) = cycle d k L load high low upper lower s).
  { intros s Hs. rewrite <- (Shape 0%nat s Hs). simpl. f_equal. ring. }
  split; [exact Shape|]. split; [intros n; apply One|]. split; [|split; [|split]].
  - intros n t Ht. apply (One n). lra.
  - rewrite Begin by (unfold P; lra). unfold cycle, up_half. cbv zeta. fold T_high. destruct (Rle_dec L T_high); [|lra]. destruct (Rle_dec L L); [reflexivity|lra].
  - replace (b + T_high + L) with (b + (T_high + L)) by ring. rewrite Begin by (unfold P; lra). unfold cycle. cbv zeta. fold T_high.
    destruct (Rle_dec (T_high + L) T_high); [lra|]. replace (T_high + L - T_high) with L by ring.
    unfold up_half. cbv zeta. destruct (Rle_dec L L); [|lra]. unfold maximum. ring.
  - intros t Ht. destruct (base_Int_part ((t - b) / P)) as [I1 I2]. set (z := Int_part ((t - b) / P)) in *.
    assert (HP : 0 < P) by (unfold P; lra).
    assert (R0 : 0 <= (t - b) / P) by (apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; lra]).
    assert (Z : (0 <= z)%Z) by (assert (-1 < z)%Z by (apply lt_IZR; lra); lia).
    assert (E : t - b = (t - b) / P * P) by (field; lra).
    replace t with (b + INR (Z.to_nat z) * P + (t - b - IZR z * P)) by (rewrite INR_IZR_INZ, Z2Nat.id by exact Z; ring).
    assert (In : 0 <= t - b - IZR z * P <= P).
    { split.
      - assert (IZR z * P <= (t - b) / P * P) by (apply Rmult_le_compat_r; lra). lra.
      - assert ((t - b) / P * P <= (IZR z + 1) * P) by (apply Rmult_le_compat_r; lra). lra. }
    rewrite Shape by exact In. apply shape_within; assumption.
Qed.

(** Where the upper command does not drive the output past the upper level the relay never switches back. *)
Theorem needs_levels_passed : forall d k L load high low upper lower : R, 0 < d -> 0 <= k -> 0 < L -> high + load <= k * upper ->
  forall y u s, loop d k L load high low upper lower y u -> y s < upper -> (forall t, s - L < t <= s -> u t = high) ->
  forall t, s <= t -> y t < upper /\ u t = high.
Proof.
  intros d k L load high low upper lower Hd Hk HL Weak y u s M Ys Us. pose proof M as [J P LA HB SH SL].
  assert (Below : forall x, 0 <= x -> y s + (high + load - k * y s) * settle d k x < upper).
  { intros x Hx. pose proof (settle_below d k Hk x) as B. pose proof (settle_0 d k Hd) as Z.
    assert (0 <= settle d k x) by (destruct Hx as [H| <-]; [apply (settle_increases d k Hd Hk) in H; lra|lra]).
    destruct (Rle_lt_dec (high + load - k * y s) 0) as [Q|Q]; [nra|]. assert (0 < k) by (destruct Hk as [H0| <-]; lra).
    apply (Rmult_lt_reg_l k); [assumption|]. nra. }
  assert (Steps : forall n : nat, forall t, s <= t -> t <= s + INR n * L -> y t < upper /\ u t = high).
  { induction n as [|n IH]; intros t Ht Hn; [simpl in Hn; assert (t = s) by lra; subst t; split; [exact Ys|apply Us; lra]|]. rewrite S_INR in Hn.
    assert (In : forall r, s <= r <= t -> y r < upper).
    { intros r Hr. rewrite (answers d k L load high low upper lower Hd Hk y u s r high M); [apply Below; lra|lra|].
      intros q Hq. destruct (Rle_lt_dec (q - L) s) as [Q|Q]; [apply Us; lra|apply IH; lra]. }
    split; [apply In; lra|]. apply (SH s t Ht); [apply Us; lra|]. intros r Hr. apply In. lra. }
  intros t Ht. destruct (archimed ((t - s) / L)) as [A _]. set (z := up ((t - s) / L)) in *.
  assert (0 <= (t - s) / L) by (apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; lra]).
  assert (Z : (0 <= z)%Z) by (apply le_IZR; lra). apply (Steps (Z.to_nat z) t Ht).
  rewrite INR_IZR_INZ, Z2Nat.id by exact Z. assert (t - s <= IZR z * L); [|lra].
  replace (t - s) with ((t - s) / L * L) by (field; lra). apply Rmult_le_compat_r; lra.
Qed.

(** The loop of an integrator without hysteresis has a faster motion too, of a fifth of the period. *)
Theorem needs_low_for_a_dead_time : forall L, 0 < L ->
  exists y u, loop 1 0 L 0 1 (-1) 0 0 y u /\ y (2 * (L / 5)) = 0 /\ (forall t, L / 5 < t < 2 * (L / 5) -> u t = -1) /\
    forall t, y (t + (time_high 1 0 L 0 1 (-1) 0 0 + time_low 1 0 L 0 1 (-1) 0 0) / 5) = y t.
Proof.
  intros L HL. pose proof (Claim_relay_ultimate.needs_below_for_a_dead_time 1 L 1 ltac:(lra) HL ltac:(lra)) as N. cbv zeta in N.
  set (y := Claim_relay_ultimate.triangle 1 (L / 5) 1) in *. set (u := Claim_relay_ultimate.command 1 (L / 5) 1) in *.
  destruct N as [[J I B A] [_ [_ Per]]]. exists y, u.
  assert (Down : forall t, 0 < t < 2 * (L / 5) -> 0 < y t).
  { intros t Ht. unfold y. destruct (Rle_lt_dec t (L / 5)) as [Q|Q].
    - rewrite (Claim_relay_ultimate.rising 1 (L / 5) 1 ltac:(lra) 0) by lra. lra.
    - rewrite (Claim_relay_ultimate.falling 1 (L / 5) 1 ltac:(lra) 0) by lra. lra. }
  split; [split|split; [|split]].
  - exact J.
  - intros t Lo. evar_last; [exact (I t Lo)|field].
  - intros t H. rewrite A by exact H. lra.
  - intros t H. rewrite B by exact H. lra.
  - intros s t st H Q. destruct st as [st| <-]; [apply B, Q; lra|exact H].
  - intros s t st H Q. destruct st as [st| <-]; [rewrite A by (apply Q; lra); lra|exact H].
  - unfold y. rewrite (Claim_relay_ultimate.falling 1 (L / 5) 1 ltac:(lra) 0) by lra. lra.
  - intros t Ht. rewrite A by (apply Down; lra). lra.
  - intros t. rewrite <- (Per t) at 1. f_equal. unfold time_high, time_low, rise, fall, minimum, maximum, time_to, settle, Claim_relay_ultimate.period.
    cbv zeta. destruct (Req_EM_T 0 0); [|contradiction]. field.
Qed.

Print Assumptions statement.
