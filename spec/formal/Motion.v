(** The cycle is a motion: two arcs, joined and repeated, obey the axis and the relay at every instant. The speed along an arc is the inverse of the
    passing time. Shared by the orbits. *)
From Coq Require Import Reals Lra Lia Psatz ZArith Ranalysis5.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Phase Return Switching Attraction Joints.
Open Scope R_scope.

(** * One arc *)

Section Arc.
Variables alpha beta_1 beta_2 c low high : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hc : 0 < c)
  (Hlow : 0 < force beta_1 beta_2 c low) (ordered_ends : low < high).
Local Notation passing := (time alpha beta_1 beta_2 c).
Local Notation path := (way alpha beta_1 beta_2 c).
Local Notation push := (force beta_1 beta_2 c).

Lemma pushed w : low <= w -> 0 < push w.
Proof. intros H. pose proof (force_le beta_1 beta_2 c Hb1 Hb2 low w H). lra. Qed.

Lemma passing_less v w : low <= v -> v < w -> passing v < passing w.
Proof. intros Hv vw. apply time_rises; try assumption. apply pushed, Hv. Qed.

Lemma passing_continuous y : forall w, low <= w <= high -> continuity_pt (fun w => passing w - y) w.
Proof.
  intros w Hw. apply (continuity_pt_minus passing (fun _ => y)); [|apply continuity_pt_const; intros p q; reflexivity].
  apply (continuity_of_derive _ w (alpha / push w)), time_derive; try assumption. apply pushed. lra.
Qed.

(** The speed at which the time y is left. *)
Definition speed_at (y : R) : R :=
  match Rlt_dec (passing low) y, Rlt_dec y (passing high) with
  | left above, left below => proj1_sig (IVT_interv (fun w => passing w - y) low high (passing_continuous y) ordered_ends
      (Rlt_minus _ _ above) (Rgt_minus _ _ below))
  | _, _ => 0
  end.

Lemma speed_at_is y : passing low < y < passing high -> low < speed_at y < high /\ passing (speed_at y) = y.
Proof.
  intros [Y1 Y2]. unfold speed_at. destruct (Rlt_dec (passing low) y) as [A|A]; [|contradiction]. destruct (Rlt_dec y (passing high)) as [B|B]; [|contradiction].
  destruct (IVT_interv _ _ _ _ _ _ _) as [w [W1 W2]]. simpl. assert (E : passing w = y) by lra.
  split; [|exact E]. split; [destruct (proj1 W1) as [L|L]|destruct (proj2 W1) as [L|L]]; try exact L; subst w; lra.
Qed.

Lemma speed_at_passing w : low < w < high -> speed_at (passing w) = w.
Proof.
  intros Hw. destruct (speed_at_is (passing w)) as [S E]; [split; apply passing_less; lra|].
  destruct (Rtotal_order (speed_at (passing w)) w) as [L|[L|L]]; [|exact L|].
  - pose proof (passing_less _ _ (Rlt_le _ _ (proj1 S)) L). lra.
  - pose proof (passing_less w _ (Rlt_le _ _ (proj1 Hw)) L). lra.
Qed.

Lemma speed_at_near y eps : passing low < y < passing high -> 0 < eps ->
  exists d, 0 < d /\ forall z, Rabs (z - y) < d -> passing low < z < passing high /\ Rabs (speed_at z - speed_at y) < eps.
Proof.
  intros Hy E. destruct (speed_at_is y Hy) as [[S1 S2] Ey]. set (w := speed_at y) in *.
  set (e := Rmin (eps / 2) (Rmin ((w - low) / 2) ((high - w) / 2))).
  assert (E1 : e <= eps / 2) by apply Rmin_l.
  assert (E2 : e <= (w - low) / 2) by (apply Rle_trans with (1 := Rmin_r _ _), Rmin_l).
  assert (E3 : e <= (high - w) / 2) by (apply Rle_trans with (1 := Rmin_r _ _), Rmin_r).
  assert (E0 : 0 < e) by (unfold e; repeat apply Rmin_pos; lra).
  assert (L1 : passing (w - e) < y) by (rewrite <- Ey; apply passing_less; lra).
  assert (L2 : y < passing (w + e)) by (rewrite <- Ey; apply passing_less; lra).
  assert (L3 : passing low < passing (w - e)) by (apply passing_less; lra).
  assert (L4 : passing (w + e) < passing high) by (apply passing_less; lra).
  exists (Rmin (y - passing (w - e)) (passing (w + e) - y)). split; [apply Rmin_pos; lra|]. intros z Hz.
  pose proof (Rmin_l (y - passing (w - e)) (passing (w + e) - y)). pose proof (Rmin_r (y - passing (w - e)) (passing (w + e) - y)).
  apply Rabs_def2 in Hz. assert (Z : passing low < z < passing high) by lra. split; [exact Z|].
  destruct (speed_at_is z Z) as [[Z1 Z2] Ez]. apply Rabs_def1.
  - destruct (Rlt_le_dec (speed_at z) (w + e)) as [Q|[Q|Q]]; [lra| |].
    + pose proof (passing_less (w + e) (speed_at z) ltac:(lra) Q). lra.
    + rewrite <- Q in Ez. lra.
  - destruct (Rlt_le_dec (w - e) (speed_at z)) as [Q|[Q|Q]]; [lra| |].
    + pose proof (passing_less (speed_at z) (w - e) ltac:(lra) Q). lra.
    + rewrite Q in Ez. lra.
Qed.

Lemma speed_at_derive y : passing low < y < passing high -> is_derive speed_at y (push (speed_at y) / alpha).
Proof.
  intros Hy. apply is_derive_Reals. intros eps Eps. destruct (speed_at_is y Hy) as [[S1 S2] Ey].
  destruct (stays_above push (speed_at y) (push (speed_at y) - alpha * eps)) as [d1 [D1 N1]];
    [apply (continuity_of_derive push _ _ (force_derive beta_1 beta_2 c (speed_at y)))|nra|].
  destruct (stays_below push (speed_at y) (push (speed_at y) + alpha * eps)) as [d2 [D2 N2]];
    [apply (continuity_of_derive push _ _ (force_derive beta_1 beta_2 c (speed_at y)))|nra|].
  destruct (speed_at_near y (Rmin d1 d2) Hy (Rmin_pos _ _ D1 D2)) as [d [D N]].
  exists (mkposreal d D). intros h h0 Hh. simpl in Hh. destruct (N (y + h)) as [Yh Near]; [replace (y + h - y) with h by ring; exact Hh|].
  pose proof (Rmin_l d1 d2). pose proof (Rmin_r d1 d2). destruct (speed_at_is (y + h) Yh) as [[T1 T2] Eh].
  (* the mean of the slope between the two speeds *)
  assert (mean : exists s, Rabs (s - speed_at y) <= Rabs (speed_at (y + h) - speed_at y) /\ low <= s /\
            alpha * (speed_at (y + h) - speed_at y) = push s * h).
  { assert (one : forall v w, low < v -> v < w -> exists s, v < s < w /\ alpha * (w - v) = push s * (passing w - passing v)).
    { intros v w Hv vw. destruct (mean_value passing (fun s => alpha / push s) v w vw) as [s [Hs E]].
      - intros s Hs. apply time_derive; try assumption. apply pushed. lra.
      - intros s Hs. apply (continuity_of_derive _ s (alpha / push s)), time_derive; try assumption. apply pushed. lra.
      - exists s. split; [exact Hs|]. rewrite E. field. pose proof (pushed s). lra. }
    destruct (Rtotal_order (speed_at (y + h)) (speed_at y)) as [L|[L|L]].
    - destruct (one _ _ T1 L) as [s [Hs E]]. exists s. rewrite Ey, Eh in E. split; [rewrite !Rabs_left; lra|]. split; lra.
    - rewrite L in Eh. lra.
    - destruct (one _ _ S1 L) as [s [Hs E]]. exists s. rewrite Ey, Eh in E. split; [rewrite !Rabs_pos_eq; lra|]. split; lra. }
  destruct mean as [s [Hs [Ls E]]]. specialize (N1 s ltac:(lra)). specialize (N2 s ltac:(lra)).
  replace ((speed_at (y + h) - speed_at y) / h) with (push s / alpha)
    by (apply (Rmult_eq_reg_l (alpha * h)); [field_simplify; lra|apply Rmult_integral_contrapositive_currified; lra]).
  replace (push s / alpha - push (speed_at y) / alpha) with ((push s - push (speed_at y)) / alpha) by (field; lra).
  apply Rabs_def1; apply (Rmult_lt_reg_r alpha); try exact Ha; unfold Rdiv; rewrite Rmult_assoc, Rinv_l, Rmult_1_r; lra.
Qed.

(** From the level y_0 at the speed A. *)
Variables y_0 A : R.
Hypothesis HA : low < A < high.
Definition arc_v (t : R) : R := speed_at (passing A - t).
Definition arc_x (t : R) : R := y_0 + path A - path (arc_v t).

Lemma arc_v_derive t : passing low < passing A - t < passing high -> is_derive arc_v t (- (push (arc_v t) / alpha)).
Proof.
  intros H. assert (D : is_derive (fun t => passing A - t) t (-1)) by (auto_derive; [trivial|ring]).
  pose proof (is_derive_comp speed_at (fun t => passing A - t) t _ _ (speed_at_derive _ H) D) as E.
  replace (- (push (arc_v t) / alpha)) with (scal (-1) (push (arc_v t) / alpha)) by (unfold scal; simpl; unfold mult; simpl; ring). exact E.
Qed.

Lemma arc_x_derive t : passing low < passing A - t < passing high -> is_derive arc_x t (arc_v t).
Proof.
  intros H. pose proof (arc_v_derive t H) as Dv. destruct (speed_at_is _ H) as [[S _] _]. fold (arc_v t) in S.
  pose proof (pushed (arc_v t) ltac:(lra)) as P.
  pose proof (is_derive_comp path arc_v t _ _ (way_derive alpha beta_1 beta_2 c Hb1 Hb2 Hc (arc_v t) P) Dv) as D.
  pose proof (is_derive_minus (fun _ => y_0 + path A) (fun t => path (arc_v t)) t _ _ (is_derive_const (y_0 + path A) t) D) as E.
  revert E. unfold minus, plus, opp, scal, zero; simpl; unfold mult; simpl. intros E.
  match type of E with is_derive _ _ ?l => replace l with (arc_v t) in E by (field; lra) end. exact E.
Qed.

Lemma arc_v_at w : low < w < high -> arc_v (passing A - passing w) = w.
Proof. intros H. unfold arc_v. replace (passing A - (passing A - passing w)) with (passing w) by ring. apply speed_at_passing, H. Qed.
End Arc.

(** * One half *)

Section Half.
Variables alpha beta_1 beta_2 c x_a A B : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hb : 0 < beta_1 + beta_2) (Hc : 0 < c) (Hx : 0 < x_a).
Hypotheses (A0 : 0 < A) (HAB : half alpha beta_1 beta_2 c x_a A B).
Local Notation passing := (time alpha beta_1 beta_2 c).

Definition half_time : R := passing A - passing (- B).
Definition half_low : R := - ((B + terminal beta_1 beta_2 c) / 2).

Lemma B_below : 0 < B < terminal beta_1 beta_2 c.
Proof.
  destruct (terminal_speed beta_1 beta_2 Hb1 Hb2 c Hc Hb) as [W E]. split; [apply HAB|].
  exact (half_below_terminal alpha beta_1 beta_2 c Hb1 Hb2 x_a A B _ HAB E).
Qed.

Lemma low_pushed : 0 < force beta_1 beta_2 c half_low.
Proof.
  destruct (terminal_speed beta_1 beta_2 Hb1 Hb2 c Hc Hb) as [W E]. pose proof B_below as [B0 BW]. unfold force, half_low. rewrite drag_odd.
  pose proof (drag_lt beta_1 beta_2 Hb1 Hb2 ((B + terminal beta_1 beta_2 c) / 2) (terminal beta_1 beta_2 c) Hb ltac:(lra)). lra.
Qed.

Lemma low_below : half_low < A + 1.
Proof. pose proof B_below. unfold half_low. lra. Qed.

Definition half_v : R -> R := arc_v alpha beta_1 beta_2 c half_low (A + 1) Hb1 Hb2 Hc low_pushed low_below A.
Definition half_x : R -> R := arc_x alpha beta_1 beta_2 c half_low (A + 1) Hb1 Hb2 Hc low_pushed low_below x_a A.

Lemma half_passes v w : half_low <= v -> v < w -> passing v < passing w.
Proof. apply (passing_less alpha beta_1 beta_2 c half_low Ha Hb1 Hb2 Hc low_pushed). Qed.

Lemma half_inside t : 0 <= t <= half_time -> passing half_low < passing A - t < passing (A + 1).
Proof.
  intros Ht. pose proof B_below as [B0 BW]. unfold half_time in Ht.
  pose proof (half_passes half_low (- B) (Rle_refl _) ltac:(unfold half_low; lra)).
  pose proof (half_passes A (A + 1) ltac:(unfold half_low; lra) ltac:(lra)). lra.
Qed.

Lemma half_time_positive : 0 < half_time.
Proof. pose proof B_below. unfold half_time. pose proof (half_passes (- B) A ltac:(unfold half_low; lra) ltac:(lra)). lra. Qed.

Lemma half_v_derive t : 0 <= t <= half_time -> is_derive half_v t (- (force beta_1 beta_2 c (half_v t) / alpha)).
Proof. intros Ht. apply arc_v_derive; [exact Ha|apply half_inside, Ht]. Qed.

Lemma half_x_derive t : 0 <= t <= half_time -> is_derive half_x t (half_v t).
Proof. intros Ht. apply arc_x_derive; [exact Ha|apply half_inside, Ht]. Qed.

Lemma half_v_at w : - B <= w <= A -> half_v (passing A - passing w) = w.
Proof. intros Hw. pose proof B_below. apply arc_v_at; [exact Ha|unfold half_low; lra]. Qed.

Lemma half_v_start : half_v 0 = A.
Proof. replace 0 with (passing A - passing A) by ring. apply half_v_at. pose proof B_below. lra. Qed.
Lemma half_v_end : half_v half_time = - B.
Proof. apply half_v_at. pose proof B_below. lra. Qed.

Lemma half_x_is t : half_x t = x_a + way alpha beta_1 beta_2 c A - way alpha beta_1 beta_2 c (half_v t).
Proof. reflexivity. Qed.
Lemma half_x_start : half_x 0 = x_a.
Proof. rewrite half_x_is, half_v_start. ring. Qed.
Lemma half_x_end : half_x half_time = - x_a.
Proof. rewrite half_x_is, half_v_end. destruct HAB as [_ [_ [_ E]]]. lra. Qed.

(** The speed goes from A to [-B], every value once. *)
Lemma half_v_range t : 0 <= t <= half_time -> - B <= half_v t <= A /\ (t < half_time -> - B < half_v t).
Proof.
  intros Ht. destruct (speed_at_is alpha beta_1 beta_2 c half_low (A + 1) Hb1 Hb2 Hc low_pushed low_below _ (half_inside t Ht)) as [[S1 S2] E].
  change (speed_at _ _ _ _ _ _ _ _ _ _ _ _) with (half_v t) in S1, S2, E. unfold half_time in Ht. pose proof B_below as [B0 BW].
  assert (U : half_v t <= A) by (destruct (Rle_lt_dec (half_v t) A) as [Q|Q]; [exact Q|]; pose proof (half_passes A (half_v t) ltac:(unfold half_low; lra) Q); lra).
  assert (L : - B <= half_v t) by (destruct (Rle_lt_dec (- B) (half_v t)) as [Q|Q]; [exact Q|]; pose proof (half_passes (half_v t) (- B) ltac:(lra) Q); lra).
  split; [split; assumption|]. intros Lt. destruct L as [L|L]; [exact L|]. rewrite <- L in E. unfold half_time in Lt. lra.
Qed.

Lemma half_on_arc t : 0 <= t <= half_time -> arc alpha beta_1 beta_2 c x_a A B (half_x t) (half_v t).
Proof. intros Ht. split; [apply half_v_range, Ht|apply half_x_is]. Qed.

Lemma half_covers y w : arc alpha beta_1 beta_2 c x_a A B y w -> exists t, 0 <= t <= half_time /\ half_x t = y /\ half_v t = w.
Proof.
  intros [Hw E]. pose proof B_below. pose proof (half_v_at w Hw) as V. exists (passing A - passing w).
  split; [|split; [rewrite half_x_is, V; lra|exact V]]. unfold half_time. split.
  - destruct (proj2 Hw) as [L| ->]; [pose proof (half_passes w A ltac:(unfold half_low; lra) L)|]; lra.
  - destruct (proj1 Hw) as [L| <-]; [pose proof (half_passes (- B) w ltac:(unfold half_low; lra) L)|]; lra.
Qed.

(** The lower level is not reached before the end. *)
Lemma half_above t : 0 <= t < half_time -> - x_a < half_x t.
Proof.
  intros Ht. destruct (half_v_range t ltac:(lra)) as [[V1 V2] V3]. specialize (V3 (proj2 Ht)). rewrite half_x_is.
  destruct HAB as [_ [_ [F E]]].
  assert (way alpha beta_1 beta_2 c (half_v t) < way alpha beta_1 beta_2 c (- B)); [|lra].
  destruct (Rle_lt_dec (half_v t) 0) as [Q|Q].
  - apply way_falls; assumption.
  - rewrite E. destruct V2 as [L|L]; [pose proof (way_rises alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc (half_v t) A ltac:(lra) L)|rewrite L]; lra.
Qed.

(** The turning point: speed zero, beyond the upper level by [way A]. *)
Lemma half_turns : half_v (passing A) = 0 /\ half_x (passing A) = x_a + way alpha beta_1 beta_2 c A /\ 0 < passing A < half_time /\
  forall t, 0 <= t <= half_time -> half_x t <= x_a + way alpha beta_1 beta_2 c A.
Proof.
  pose proof B_below. pose proof (half_v_at 0 ltac:(lra)) as V. rewrite time_0, Rminus_0_r in V. split; [exact V|].
  split; [rewrite half_x_is, V, way_0; ring|]. split.
  - pose proof (half_passes 0 A ltac:(unfold half_low; lra) A0) as R1. pose proof (half_passes (- B) 0 ltac:(unfold half_low; lra) ltac:(lra)) as R2.
    rewrite time_0 in R1, R2. unfold half_time. lra.
  - intros t Ht. rewrite half_x_is. assert (0 <= way alpha beta_1 beta_2 c (half_v t)); [|lra].
    destruct (half_v_range t Ht) as [[V1 _] _]. rewrite <- (way_0 alpha beta_1 beta_2 c).
    destruct (Rtotal_order (half_v t) 0) as [L|[-> |L]]; [left; apply way_falls; try assumption; try lra|lra|left; apply way_rises; lra].
    destruct HAB as [_ [_ [F _]]]. pose proof (force_le beta_1 beta_2 c Hb1 Hb2 (- B) (half_v t) V1). lra.
Qed.

(** The turning point is passed once. *)
Lemma half_turns_once t : 0 <= t <= half_time -> half_x t = x_a + way alpha beta_1 beta_2 c A -> t = passing A.
Proof.
  intros Ht E. rewrite half_x_is in E. destruct (half_v_range t Ht) as [[V1 _] _].
  assert (V : half_v t = 0).
  { destruct (Rtotal_order (half_v t) 0) as [L|[L|L]]; [exfalso|exact L|exfalso].
    - assert (F : 0 < force beta_1 beta_2 c (half_v t)).
      { destruct HAB as [_ [_ [F _]]]. pose proof (force_le beta_1 beta_2 c Hb1 Hb2 (- B) (half_v t) V1). lra. }
      pose proof (way_falls alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc (half_v t) 0 F L (Rle_refl 0)). rewrite way_0 in *. lra.
    - pose proof (way_rises alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc 0 (half_v t) (Rle_refl 0) L). rewrite way_0 in *. lra. }
  destruct (speed_at_is alpha beta_1 beta_2 c half_low (A + 1) Hb1 Hb2 Hc low_pushed low_below _ (half_inside t Ht)) as [_ S].
  change (speed_at _ _ _ _ _ _ _ _ _ _ _ _) with (half_v t) in S. rewrite V, time_0 in S. lra.
Qed.
End Half.

(** * The cycle *)

Section Cycle.
Variables alpha beta_1 beta_2 delta C x_a P Q : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hb : 0 < beta_1 + beta_2) (Hx : 0 < x_a) (Hd : Rabs delta < C).
Hypotheses (HQ : half alpha beta_1 beta_2 (c_down delta C) x_a P Q) (HP : half alpha beta_1 beta_2 (c_up delta C) x_a Q P).

Let C1 : 0 < c_down delta C := proj1 (forces_positive delta C Hd).
Let C2 : 0 < c_up delta C := proj2 (forces_positive delta C Hd).
Let P0 : 0 < P := proj1 (proj2 HP).
Let Q0 : 0 < Q := proj1 (proj2 HQ).

Local Notation v_1 := (half_v alpha beta_1 beta_2 (c_down delta C) x_a P Q Hb1 Hb2 Hb C1 P0 HQ).
Local Notation x_1 := (half_x alpha beta_1 beta_2 (c_down delta C) x_a P Q Hb1 Hb2 Hb C1 P0 HQ).
Local Notation v_2 := (half_v alpha beta_1 beta_2 (c_up delta C) x_a Q P Hb1 Hb2 Hb C2 Q0 HP).
Local Notation x_2 := (half_x alpha beta_1 beta_2 (c_up delta C) x_a Q P Hb1 Hb2 Hb C2 Q0 HP).
Definition time_down : R := half_time alpha beta_1 beta_2 (c_down delta C) P Q.
Definition time_up : R := half_time alpha beta_1 beta_2 (c_up delta C) Q P.
Definition period : R := time_down + time_up.

Lemma times_positive : 0 < time_down /\ 0 < time_up.
Proof.
  split; [exact (half_time_positive _ _ _ _ x_a P Q Ha Hb1 Hb2 Hb C1 P0 HQ)|exact (half_time_positive _ _ _ _ x_a Q P Ha Hb1 Hb2 Hb C2 Q0 HP)].
Qed.

(** The number of the period, and the instant within it. *)
Definition turns (t : R) : Z := Int_part (t / period).
Definition within (t : R) : R := t - IZR (turns t) * period.
Definition cycle_v (t : R) : R := if Rlt_dec (within t) time_down then v_1 (within t) else - v_2 (within t - time_down).
Definition cycle_x (t : R) : R := if Rlt_dec (within t) time_down then x_1 (within t) else - x_2 (within t - time_down).
Definition cycle_u (t : R) : R := if Rlt_dec (within t) time_down then - C else C.

Lemma turns_is k t : IZR k * period <= t < (IZR k + 1) * period -> turns t = k.
Proof.
  intros Ht. pose proof times_positive as [T1 T2]. assert (T0 : 0 < period) by (unfold period; lra). unfold turns.
  assert (E : t = t / period * period) by (field; lra). destruct (base_Int_part (t / period)) as [I1 I2].
  assert (L1 : IZR k <= t / period) by (apply (Rmult_le_reg_r period); lra).
  assert (L2 : t / period < IZR k + 1) by (apply (Rmult_lt_reg_r period); lra).
  assert (Int_part (t / period) < k + 1)%Z by (apply lt_IZR; rewrite plus_IZR; lra).
  assert (k < Int_part (t / period) + 1)%Z by (apply lt_IZR; rewrite plus_IZR; lra). lia.
Qed.

Lemma within_is k t : IZR k * period <= t < (IZR k + 1) * period -> within t = t - IZR k * period.
Proof. intros Ht. unfold within. rewrite (turns_is k t Ht). reflexivity. Qed.

Lemma first_half k t : IZR k * period <= t <= IZR k * period + time_down ->
  cycle_v t = v_1 (t - IZR k * period) /\ cycle_x t = x_1 (t - IZR k * period) /\ (t < IZR k * period + time_down -> cycle_u t = - C).
Proof.
  intros Ht. pose proof times_positive as [T1 T2]. assert (R1 : IZR k * period <= t < (IZR k + 1) * period) by (unfold period in *; lra).
  unfold cycle_v, cycle_x, cycle_u. rewrite (within_is k t R1). destruct (Rlt_dec (t - IZR k * period) time_down) as [L|L]; [repeat split|].
  assert (E : t - IZR k * period = time_down) by lra. rewrite E, Rminus_diag_eq by reflexivity.
  rewrite (half_v_start alpha beta_1 beta_2 _ x_a Q P Ha Hb1 Hb2 Hb), (half_x_start alpha beta_1 beta_2 _ x_a Q P Ha Hb1 Hb2 Hb). unfold time_down at 1 2.
  rewrite (half_v_end alpha beta_1 beta_2 _ x_a P Q Ha Hb1 Hb2 Hb), (half_x_end alpha beta_1 beta_2 _ x_a P Q Ha Hb1 Hb2 Hb). repeat split; lra.
Qed.

Lemma second_half k t : IZR k * period + time_down <= t <= (IZR k + 1) * period ->
  cycle_v t = - v_2 (t - (IZR k * period + time_down)) /\ cycle_x t = - x_2 (t - (IZR k * period + time_down)) /\
  (t < (IZR k + 1) * period -> cycle_u t = C).
Proof.
  intros Ht. pose proof times_positive as [T1 T2]. destruct (proj2 Ht) as [L|L].
  - assert (R1 : IZR k * period <= t < (IZR k + 1) * period) by lra.
    unfold cycle_v, cycle_x, cycle_u. rewrite (within_is k t R1). destruct (Rlt_dec (t - IZR k * period) time_down) as [N|N]; [exfalso; lra|].
    replace (t - IZR k * period - time_down) with (t - (IZR k * period + time_down)) by ring. repeat split.
  - assert (E : IZR (k + 1) * period = t) by (rewrite plus_IZR; lra).
    destruct (first_half (k + 1) t) as [V [X _]]; [lra|]. rewrite V, X, E, Rminus_diag_eq by reflexivity.
    replace (t - (IZR k * period + time_down)) with time_up by (rewrite L; unfold period; ring).
    rewrite (half_v_start alpha beta_1 beta_2 _ x_a P Q Ha Hb1 Hb2 Hb), (half_x_start alpha beta_1 beta_2 _ x_a P Q Ha Hb1 Hb2 Hb). unfold time_up.
    rewrite (half_v_end alpha beta_1 beta_2 _ x_a Q P Ha Hb1 Hb2 Hb), (half_x_end alpha beta_1 beta_2 _ x_a Q P Ha Hb1 Hb2 Hb). repeat split; lra.
Qed.

(** Every instant is in the middle of a half, or at the end of one. *)
Lemma everywhere t : exists k, IZR k * period < t < IZR k * period + time_down \/ t = IZR k * period + time_down \/
  IZR k * period + time_down < t < (IZR k + 1) * period \/ t = (IZR k + 1) * period.
Proof.
  pose proof times_positive as [T1 T2]. assert (T0 : 0 < period) by (unfold period; lra).
  destruct (base_Int_part (t / period)) as [I1 I2]. set (k := Int_part (t / period)) in *.
  assert (E : t = t / period * period) by (field; lra).
  assert (K1 : IZR k * period <= t) by (rewrite E; apply Rmult_le_compat_r; lra).
  assert (K2 : t < (IZR k + 1) * period) by (rewrite E at 1; apply Rmult_lt_compat_r; lra).
  destruct K1 as [K1|K1].
  - exists k. destruct (Rtotal_order t (IZR k * period + time_down)) as [L|[L|L]]; [left; lra|right; left; exact L|right; right; left; lra].
  - exists (k - 1)%Z. right. right. right. rewrite minus_IZR. lra.
Qed.

Lemma shifted (f : R -> R) s t l : is_derive f (t - s) l -> is_derive (fun t => f (t - s)) t l.
Proof.
  intros D. assert (E : is_derive (fun t => t - s) t 1) by (auto_derive; [trivial|ring]).
  pose proof (is_derive_comp f (fun t => t - s) t _ _ D E) as F. revert F. unfold scal; simpl; unfold mult; simpl. rewrite Rmult_1_l. trivial.
Qed.

Let d_x1 k t : IZR k * period <= t <= IZR k * period + time_down -> is_derive (fun t => x_1 (t - IZR k * period)) t (cycle_v t).
Proof.
  intros Ht. destruct (first_half k t Ht) as [-> _]. apply (shifted x_1). apply half_x_derive; [exact Ha|]. unfold time_down in Ht. lra.
Qed.
Let d_x2 k t : IZR k * period + time_down <= t <= (IZR k + 1) * period -> is_derive (fun t => - x_2 (t - (IZR k * period + time_down))) t (cycle_v t).
Proof.
  intros Ht. destruct (second_half k t Ht) as [-> _]. apply (is_derive_opp (K := R_AbsRing) (fun t => x_2 (t - (IZR k * period + time_down)))).
  apply (shifted x_2). apply half_x_derive; [exact Ha|]. unfold period, time_up in *. lra.
Qed.
Let d_v1 k t : IZR k * period <= t <= IZR k * period + time_down ->
  is_derive (fun t => v_1 (t - IZR k * period)) t ((- C + delta - drag beta_1 beta_2 (cycle_v t)) / alpha).
Proof.
  intros Ht. destruct (first_half k t Ht) as [-> _]. apply (shifted v_1).
  replace ((- C + delta - drag beta_1 beta_2 (v_1 (t - IZR k * period))) / alpha)
    with (- (force beta_1 beta_2 (c_down delta C) (v_1 (t - IZR k * period)) / alpha)) by (unfold force, c_down; field; lra).
  apply half_v_derive; [exact Ha|]. unfold time_down in Ht. lra.
Qed.
Let d_v2 k t : IZR k * period + time_down <= t <= (IZR k + 1) * period ->
  is_derive (fun t => - v_2 (t - (IZR k * period + time_down))) t ((C + delta - drag beta_1 beta_2 (cycle_v t)) / alpha).
Proof.
  intros Ht. destruct (second_half k t Ht) as [-> _]. rewrite drag_odd.
  replace ((C + delta - - drag beta_1 beta_2 (v_2 (t - (IZR k * period + time_down)))) / alpha)
    with (opp (- (force beta_1 beta_2 (c_up delta C) (v_2 (t - (IZR k * period + time_down))) / alpha))) by (unfold force, c_up, opp; simpl; field; lra).
  apply (is_derive_opp (K := R_AbsRing) (fun t => v_2 (t - (IZR k * period + time_down)))).
  apply (shifted v_2). apply half_v_derive; [exact Ha|]. unfold period, time_up in *. lra.
Qed.

Lemma cycle_velocity t : is_derive cycle_x t (cycle_v t).
Proof.
  pose proof times_positive as [T1 T2]. destruct (everywhere t) as [k [Ht|[Ht|[Ht|Ht]]]].
  - apply (local_derive cycle_x (fun t => x_1 (t - IZR k * period)) t (Rmin (t - IZR k * period) (IZR k * period + time_down - t))); [apply Rmin_pos; lra| |apply d_x1; lra].
    intros s Hs. pose proof (Rmin_l (t - IZR k * period) (IZR k * period + time_down - t)). pose proof (Rmin_r (t - IZR k * period) (IZR k * period + time_down - t)).
    apply first_half. lra.
  - apply (glue_derive cycle_x (fun t => x_1 (t - IZR k * period)) (fun t => - x_2 (t - (IZR k * period + time_down))) t (Rmin time_down time_up)).
    + apply Rmin_pos; assumption.
    + intros s Hs. pose proof (Rmin_l time_down time_up). apply first_half. lra.
    + intros s Hs. pose proof (Rmin_r time_down time_up). apply second_half. unfold period in *. lra.
    + apply d_x1. lra.
    + apply d_x2. unfold period in *. lra.
  - apply (local_derive cycle_x (fun t => - x_2 (t - (IZR k * period + time_down))) t (Rmin (t - (IZR k * period + time_down)) ((IZR k + 1) * period - t)));
      [apply Rmin_pos; lra| |apply d_x2; lra].
    intros s Hs. pose proof (Rmin_l (t - (IZR k * period + time_down)) ((IZR k + 1) * period - t)).
    pose proof (Rmin_r (t - (IZR k * period + time_down)) ((IZR k + 1) * period - t)). apply second_half. lra.
  - apply (glue_derive cycle_x (fun t => - x_2 (t - (IZR k * period + time_down))) (fun t => x_1 (t - IZR (k + 1) * period)) t (Rmin time_down time_up)).
    + apply Rmin_pos; assumption.
    + intros s Hs. pose proof (Rmin_r time_down time_up). apply second_half. unfold period in *. lra.
    + intros s Hs. pose proof (Rmin_l time_down time_up). apply first_half. rewrite plus_IZR. lra.
    + apply d_x2. unfold period in *. lra.
    + apply d_x1. rewrite plus_IZR. lra.
Qed.

Lemma cycle_no_jump t : continuous cycle_v t.
Proof.
  pose proof times_positive as [T1 T2]. destruct (everywhere t) as [k [Ht|[Ht|[Ht|Ht]]]].
  - eapply continuous_of_derive.
    apply (local_derive cycle_v (fun t => v_1 (t - IZR k * period)) t (Rmin (t - IZR k * period) (IZR k * period + time_down - t))); [apply Rmin_pos; lra| |apply d_v1; lra].
    intros s Hs. pose proof (Rmin_l (t - IZR k * period) (IZR k * period + time_down - t)). pose proof (Rmin_r (t - IZR k * period) (IZR k * period + time_down - t)).
    apply first_half. lra.
  - apply (glue_continuous cycle_v (fun t => v_1 (t - IZR k * period)) (fun t => - v_2 (t - (IZR k * period + time_down))) t (Rmin time_down time_up)).
    + apply Rmin_pos; assumption.
    + intros s Hs. pose proof (Rmin_l time_down time_up). apply first_half. lra.
    + intros s Hs. pose proof (Rmin_r time_down time_up). apply second_half. unfold period in *. lra.
    + eapply continuous_of_derive. apply d_v1. lra.
    + eapply continuous_of_derive. apply d_v2. unfold period in *. lra.
  - eapply continuous_of_derive.
    apply (local_derive cycle_v (fun t => - v_2 (t - (IZR k * period + time_down))) t (Rmin (t - (IZR k * period + time_down)) ((IZR k + 1) * period - t)));
      [apply Rmin_pos; lra| |apply d_v2; lra].
    intros s Hs. pose proof (Rmin_l (t - (IZR k * period + time_down)) ((IZR k + 1) * period - t)).
    pose proof (Rmin_r (t - (IZR k * period + time_down)) ((IZR k + 1) * period - t)). apply second_half. lra.
  - apply (glue_continuous cycle_v (fun t => - v_2 (t - (IZR k * period + time_down))) (fun t => v_1 (t - IZR (k + 1) * period)) t (Rmin time_down time_up)).
    + apply Rmin_pos; assumption.
    + intros s Hs. pose proof (Rmin_r time_down time_up). apply second_half. unfold period in *. lra.
    + intros s Hs. pose proof (Rmin_l time_down time_up). apply first_half. rewrite plus_IZR. lra.
    + eapply continuous_of_derive. apply d_v2. unfold period in *. lra.
    + eapply continuous_of_derive. apply d_v1. rewrite plus_IZR. lra.
Qed.

Lemma C_positive : 0 < C.
Proof. pose proof (Rabs_pos delta). lra. Qed.

(** At a joint the command does not stay. *)
Lemma cycle_newton t : locally t (fun s => cycle_u s = cycle_u t) -> is_derive cycle_v t ((cycle_u t + delta - drag beta_1 beta_2 (cycle_v t)) / alpha).
Proof.
  intros [e E]. pose proof (cond_pos e) as Pe. pose proof times_positive as [T1 T2]. pose proof C_positive as PC.
  destruct (everywhere t) as [k [Ht|[Ht|[Ht|Ht]]]].
  - destruct (first_half k t ltac:(lra)) as [_ [_ U]]. rewrite U by lra.
    apply (local_derive cycle_v (fun t => v_1 (t - IZR k * period)) t (Rmin (t - IZR k * period) (IZR k * period + time_down - t))); [apply Rmin_pos; lra| |apply d_v1; lra].
    intros s Hs. pose proof (Rmin_l (t - IZR k * period) (IZR k * period + time_down - t)). pose proof (Rmin_r (t - IZR k * period) (IZR k * period + time_down - t)).
    apply first_half. lra.
  - exfalso. destruct (second_half k t) as [_ [_ U]]; [unfold period in *; lra|].
    set (s := t - Rmin e time_down / 2). pose proof (Rmin_l e time_down). pose proof (Rmin_r e time_down). pose proof (Rmin_pos e time_down Pe T1).
    destruct (first_half k s) as [_ [_ W]]; [unfold s; lra|]. assert (B : ball t e s) by (change (Rabs (s - t) < e); unfold s; rewrite Rabs_left; lra).
    specialize (E s B). cbv beta in E. rewrite W, U in E; [lra|unfold period in *; lra|unfold s; lra].
  - destruct (second_half k t ltac:(lra)) as [_ [_ U]]. rewrite U by lra.
    apply (local_derive cycle_v (fun t => - v_2 (t - (IZR k * period + time_down))) t (Rmin (t - (IZR k * period + time_down)) ((IZR k + 1) * period - t)));
      [apply Rmin_pos; lra| |apply d_v2; lra].
    intros s Hs. pose proof (Rmin_l (t - (IZR k * period + time_down)) ((IZR k + 1) * period - t)).
    pose proof (Rmin_r (t - (IZR k * period + time_down)) ((IZR k + 1) * period - t)). apply second_half. lra.
  - exfalso. destruct (first_half (k + 1) t) as [_ [_ U]]; [rewrite plus_IZR; lra|].
    set (s := t - Rmin e time_up / 2). pose proof (Rmin_l e time_up). pose proof (Rmin_r e time_up). pose proof (Rmin_pos e time_up Pe T2).
    destruct (second_half k s) as [_ [_ W]]; [unfold s, period in *; lra|]. assert (B : ball t e s) by (change (Rabs (s - t) < e); unfold s; rewrite Rabs_left; lra).
    specialize (E s B). cbv beta in E. rewrite W, U in E; [lra|rewrite plus_IZR; lra|unfold s; lra].
Qed.

(** In which half, by the command. *)
Lemma by_command t : exists k, (IZR k * period <= t < IZR k * period + time_down /\ cycle_u t = - C /\ - x_a < cycle_x t) \/
  (IZR k * period + time_down <= t < (IZR k + 1) * period /\ cycle_u t = C /\ cycle_x t < x_a).
Proof.
  pose proof times_positive as [T1 T2].
  assert (one : forall k, IZR k * period <= t < IZR k * period + time_down -> cycle_u t = - C /\ - x_a < cycle_x t).
  { intros k Ht. destruct (first_half k t ltac:(lra)) as [_ [-> U]]. split; [apply U; lra|]. apply half_above; [exact Ha|exact Hx|]. unfold time_down in Ht. lra. }
  assert (two : forall k, IZR k * period + time_down <= t < (IZR k + 1) * period -> cycle_u t = C /\ cycle_x t < x_a).
  { intros k Ht. destruct (second_half k t ltac:(lra)) as [_ [-> U]]. split; [apply U; lra|].
    assert (- x_a < x_2 (t - (IZR k * period + time_down))); [|lra]. apply half_above; [exact Ha|exact Hx|]. unfold period, time_up in *. lra. }
  destruct (everywhere t) as [k [Ht|[Ht|[Ht|Ht]]]].
  - exists k. left. split; [lra|]. apply (one k). lra.
  - exists k. right. assert (R1 : IZR k * period + time_down <= t < (IZR k + 1) * period) by (unfold period in *; lra). split; [exact R1|]. exact (two k R1).
  - exists k. right. split; [lra|]. apply (two k). lra.
  - exists (k + 1)%Z. left. assert (R1 : IZR (k + 1) * period <= t < IZR (k + 1) * period + time_down) by (rewrite plus_IZR; lra). split; [exact R1|].
    exact (one _ R1).
Qed.

Theorem cycle_is_motion : relay_loop alpha beta_1 beta_2 delta C x_a cycle_x cycle_v cycle_u.
Proof.
  pose proof times_positive as [T1 T2]. pose proof C_positive as PC. split; split.
  - intros t _. apply cycle_velocity.
  - intros t _. apply cycle_no_jump.
  - intros t _. apply cycle_newton.
  - intros t _. destruct (by_command t) as [k [[_ [U _]]|[_ [U _]]]]; [right|left]; exact U.
  - intros t _ H. destruct (by_command t) as [k [[_ [U X]]|[_ [U _]]]]; [lra|exact U].
  - intros t _ H. destruct (by_command t) as [k [[_ [U _]]|[_ [U X]]]]; [exact U|lra].
  - intros s t Ls Lt st Us between. destruct (by_command s) as [k [[_ [U _]]|[Hs _]]]; [lra|].
    destruct (Rlt_le_dec t ((IZR k + 1) * period)) as [L|L]; [apply (second_half k t); lra|exfalso].
    specialize (between ((IZR k + 1) * period)). destruct (first_half (k + 1) ((IZR k + 1) * period)) as [_ [X _]]; [rewrite plus_IZR; lra|].
    rewrite X, plus_IZR, Rminus_diag_eq in between by reflexivity. rewrite (half_x_start alpha beta_1 beta_2 _ x_a P Q Ha Hb1 Hb2 Hb) in between.
    assert (- x_a < - x_a); [|lra]. apply between; [unfold later in *; lra|lra].
  - intros s t Ls Lt st Us between. destruct (by_command s) as [k [[Hs _]|[_ [U _]]]]; [|lra].
    destruct (Rlt_le_dec t (IZR k * period + time_down)) as [L|L]; [apply (first_half k t); lra|exfalso].
    specialize (between (IZR k * period + time_down)). destruct (second_half k (IZR k * period + time_down)) as [_ [X _]]; [unfold period; lra|].
    rewrite X, Rminus_diag_eq in between by reflexivity. rewrite (half_x_start alpha beta_1 beta_2 _ x_a Q P Ha Hb1 Hb2 Hb) in between.
    assert (- - x_a < x_a); [|lra]. apply between; [unfold later in *; lra|lra].
Qed.

Lemma cycle_repeats t : cycle_x (t + period) = cycle_x t /\ cycle_v (t + period) = cycle_v t /\ cycle_u (t + period) = cycle_u t.
Proof.
  pose proof times_positive as [T1 T2]. assert (T0 : 0 < period) by (unfold period; lra).
  assert (E : within (t + period) = within t).
  { destruct (base_Int_part (t / period)) as [I1 I2]. set (k := Int_part (t / period)) in *.
    assert (E : t = t / period * period) by (field; lra).
    assert (K : IZR k * period <= t < (IZR k + 1) * period) by (rewrite E; split; [apply Rmult_le_compat_r|apply Rmult_lt_compat_r]; lra).
    rewrite (within_is k t K), (within_is (k + 1) (t + period)) by (rewrite plus_IZR; lra). rewrite plus_IZR. ring. }
  unfold cycle_x, cycle_v, cycle_u. rewrite E. repeat split.
Qed.

Lemma cycle_on_cycle t : on_cycle alpha beta_1 beta_2 delta C x_a P Q (cycle_x t) (cycle_v t).
Proof.
  pose proof times_positive as [T1 T2]. destruct (by_command t) as [k [[Ht _]|[Ht _]]].
  - left. destruct (first_half k t ltac:(lra)) as [-> [-> _]]. apply half_on_arc; [exact Ha|]. unfold time_down in Ht. lra.
  - right. destruct (second_half k t ltac:(lra)) as [-> [-> _]]. rewrite !Ropp_involutive. apply half_on_arc; [exact Ha|]. unfold period, time_up in *. lra.
Qed.

Lemma cycle_covers y w : on_cycle alpha beta_1 beta_2 delta C x_a P Q y w -> exists t, 0 < t <= 2 * period /\ cycle_x t = y /\ cycle_v t = w.
Proof.
  pose proof times_positive as [T1 T2]. intros [A|A].
  - destruct (half_covers _ _ _ _ x_a P Q Ha Hb1 Hb2 Hb C1 P0 HQ y w A) as [t [Ht [X V]]]. exists (t + period).
    destruct (cycle_repeats t) as [-> [-> _]]. destruct (first_half 0 t) as [-> [-> _]]; [fold time_down in Ht; lra|].
    rewrite Rmult_0_l, Rminus_0_r. split; [fold time_down in Ht; unfold period; lra|]. split; assumption.
  - destruct (half_covers _ _ _ _ x_a Q P Ha Hb1 Hb2 Hb C2 Q0 HP (- y) (- w) A) as [t [Ht [X V]]]. exists (t + time_down).
    fold time_up in Ht. destruct (second_half 0 (t + time_down)) as [-> [-> _]]; [unfold period; lra|].
    replace (t + time_down - (0 * period + time_down)) with t by ring. rewrite X, V. split; [unfold period; lra|]. split; ring.
Qed.

(** The turning points: the greatest and the least coordinate. *)
Lemma cycle_amplitude : let high := x_a + way alpha beta_1 beta_2 (c_down delta C) P in let low := - (x_a + way alpha beta_1 beta_2 (c_up delta C) Q) in
  (forall t, low <= cycle_x t <= high) /\ (exists t, 0 < t /\ cycle_x t = high) /\ (exists t, 0 < t /\ cycle_x t = low).
Proof.
  intros high low. pose proof times_positive as [T1 T2].
  destruct (half_turns _ _ _ _ x_a P Q Ha Hb1 Hb2 Hb C1 P0 HQ) as [_ [X1 [S1 M1]]]. fold time_down in S1, M1.
  destruct (half_turns _ _ _ _ x_a Q P Ha Hb1 Hb2 Hb C2 Q0 HP) as [_ [X2 [S2 M2]]]. fold time_up in S2, M2.
  assert (H1 : 0 <= way alpha beta_1 beta_2 (c_down delta C) P) by (rewrite <- (way_0 alpha beta_1 beta_2 (c_down delta C)); left; apply way_rises; try assumption; lra).
  assert (H2 : 0 <= way alpha beta_1 beta_2 (c_up delta C) Q) by (rewrite <- (way_0 alpha beta_1 beta_2 (c_up delta C)); left; apply way_rises; try assumption; lra).
  split; [|split].
  - intros t. unfold high, low. destruct (by_command t) as [k [[Ht [_ L]]|[Ht [_ L]]]].
    + split; [lra|]. destruct (first_half k t ltac:(lra)) as [_ [-> _]]. apply M1. lra.
    + split; [|lra]. destruct (second_half k t ltac:(lra)) as [_ [-> _]]. apply Ropp_le_contravar, M2. unfold period in *. lra.
  - exists (time alpha beta_1 beta_2 (c_down delta C) P). split; [lra|]. destruct (first_half 0 (time alpha beta_1 beta_2 (c_down delta C) P)) as [_ [-> _]]; [lra|].
    rewrite Rmult_0_l, Rminus_0_r. exact X1.
  - exists (time_down + time alpha beta_1 beta_2 (c_up delta C) Q). split; [lra|].
    destruct (second_half 0 (time_down + time alpha beta_1 beta_2 (c_up delta C) Q)) as [_ [-> _]]; [unfold period; lra|].
    replace (time_down + time alpha beta_1 beta_2 (c_up delta C) Q - (0 * period + time_down)) with (time alpha beta_1 beta_2 (c_up delta C) Q) by ring.
    unfold low. rewrite X2. reflexivity.
Qed.

(** No shorter time will do: the upper turning point is passed once in each period. *)
Lemma cycle_no_sooner T : 0 < T -> (forall t, 0 < t -> cycle_x (t + T) = cycle_x t) -> period <= T.
Proof.
  intros HT R. pose proof times_positive as [T1 T2].
  set (peak := time alpha beta_1 beta_2 (c_down delta C) P).
  destruct (half_turns _ _ _ _ x_a P Q Ha Hb1 Hb2 Hb C1 P0 HQ) as [_ [X1 [S1 _]]]. fold time_down in S1. fold peak in S1, X1.
  assert (W : 0 < way alpha beta_1 beta_2 (c_down delta C) P).
  { pose proof (way_rises alpha beta_1 beta_2 (c_down delta C) Ha Hb1 Hb2 C1 0 P (Rle_refl 0) P0) as W. rewrite way_0 in W. exact W. }
  assert (E : cycle_x peak = x_a + way alpha beta_1 beta_2 (c_down delta C) P).
  { destruct (first_half 0 peak) as [_ [-> _]]; [lra|]. rewrite Rmult_0_l, Rminus_0_r. exact X1. }
  rewrite <- (R peak) in E by lra. destruct (by_command (peak + T)) as [k [[Ht [_ L]]|[Ht [_ L]]]]; [|exfalso; lra].
  destruct (first_half k (peak + T) ltac:(lra)) as [_ [X _]]. rewrite X in E.
  apply half_turns_once in E; [|exact Ha|fold time_down; lra]. fold peak in E.
  assert (K : T = IZR k * period) by lra. assert (0 < period) by (unfold period; lra).
  assert (0 < k)%Z. { apply lt_IZR. apply (Rmult_lt_reg_r period); lra. }
  assert (1 <= k)%Z by lia. apply IZR_le in H1. rewrite K. nra.
Qed.
End Cycle.
