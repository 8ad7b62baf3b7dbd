(** The limit cycle of a drag axis under a relay: one, whatever the positive numbers, the disturbance below the level and the mix of drags, and
    every start reaches it. Shared by the orbits. *)
From Coq Require Import Reals Lra Lia Psatz ZArith.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Phase Return Switching Attraction Motion.
Open Scope R_scope.

(** * What is said of a cycle *)

(** The motion repeats itself after T. *)
Definition repeats (T : R) (x v u : R -> R) : Prop :=
  0 < T /\ forall t, 0 < t -> x (t + T) = x t /\ v (t + T) = v t /\ u (t + T) = u t.

(** A motion comes to another's course in the phase plane: from some instant on it is as near to states of the other as one likes. *)
Definition comes_to (x v X V : R -> R) : Prop := forall eps, 0 < eps -> exists since, forall t, since < t ->
  exists s, 0 < s /\ Rabs (x t - X s) < eps /\ Rabs (v t - V s) < eps.

(** A motion runs through states of another only. *)
Definition runs_on (x v X V : R -> R) : Prop := forall t, 0 < t -> exists s, 0 < s /\ x t = X s /\ v t = V s.

(** The one limit cycle of the loop: a motion that repeats itself after T and no sooner; every motion comes to it; whatever repeats runs on it. *)
Record limit_cycle (alpha beta_1 beta_2 delta C x_a T : R) (X V U : R -> R) : Prop := {
  is_motion : relay_loop alpha beta_1 beta_2 delta C x_a X V U;
  repeating : repeats T X V U;
  no_sooner : forall T', repeats T' X V U -> T <= T';
  from_every_start : forall x v u, relay_loop alpha beta_1 beta_2 delta C x_a x v u -> comes_to x v X V;
  the_only_one : forall x v u T', relay_loop alpha beta_1 beta_2 delta C x_a x v u -> repeats T' x v u -> runs_on x v X V }.

(** Its turning points. *)
Definition between (low high : R) (X : R -> R) : Prop :=
  (forall t, 0 < t -> low <= X t <= high) /\ (exists t, 0 < t /\ X t = high) /\ (exists t, 0 < t /\ X t = low).

(** * The theorem *)

Section Cycle.
Variables alpha beta_1 beta_2 delta C x_a : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hb : 0 < beta_1 + beta_2) (Hx : 0 < x_a) (Hd : Rabs delta < C).

Lemma again n : forall (T : R) (x v u : R -> R), repeats T x v u -> forall t, 0 < t -> x (t + INR n * T) = x t /\ v (t + INR n * T) = v t.
Proof.
  intros T x v u [T0 H]. induction n as [|n IH]; intros t Ht; [simpl; rewrite Rmult_0_l, Rplus_0_r; split; reflexivity|].
  rewrite S_INR. replace (t + (INR n + 1) * T) with (t + INR n * T + T) by ring. pose proof (pos_INR n).
  destruct (H (t + INR n * T)) as [-> [-> _]]; [nra|]. apply IH, Ht.
Qed.

Theorem the_cycle P Q : half alpha beta_1 beta_2 (C - delta) x_a P Q -> half alpha beta_1 beta_2 (C - - delta) x_a Q P ->
  exists X V U,
    limit_cycle alpha beta_1 beta_2 delta C x_a
      (time alpha beta_1 beta_2 (C - delta) P - time alpha beta_1 beta_2 (C - delta) (- Q)
       + (time alpha beta_1 beta_2 (C - - delta) Q - time alpha beta_1 beta_2 (C - - delta) (- P))) X V U /\
    between (- (x_a + way alpha beta_1 beta_2 (C - - delta) Q)) (x_a + way alpha beta_1 beta_2 (C - delta) P) X.
Proof.
  intros HQ HP.
  set (X := cycle_x alpha beta_1 beta_2 delta C x_a P Q Hb1 Hb2 Hb Hd HQ HP).
  set (V := cycle_v alpha beta_1 beta_2 delta C x_a P Q Hb1 Hb2 Hb Hd HQ HP).
  set (U := cycle_u alpha beta_1 beta_2 delta C P Q).
  set (T := period alpha beta_1 beta_2 delta C P Q).
  assert (M : relay_loop alpha beta_1 beta_2 delta C x_a X V U) by (apply cycle_is_motion; assumption).
  destruct (times_positive alpha beta_1 beta_2 delta C x_a P Q Ha Hb1 Hb2 Hb Hd HQ HP) as [T1 T2].
  assert (T0 : 0 < T) by (unfold T, period; lra).
  assert (R : forall t, X (t + T) = X t /\ V (t + T) = V t /\ U (t + T) = U t) by (intros t; apply cycle_repeats; assumption).
  exists X, V, U. split.
  - change (limit_cycle alpha beta_1 beta_2 delta C x_a T X V U). split.
    + exact M.
    + split; [exact T0|]. intros t _. apply R.
    + intros T' [T0' R']. apply (cycle_no_sooner alpha beta_1 beta_2 delta C x_a P Q Ha Hb1 Hb2 Hb Hx Hd HQ HP T' T0'). intros t Ht. apply R', Ht.
    + intros x v u Mx eps Eps. destruct (attraction alpha beta_1 beta_2 delta C x_a Ha Hb1 Hb2 Hb Hx Hd P Q x v u HQ HP Mx eps Eps) as [since H].
      exists since. intros t Ht. destruct (H t Ht) as [y [w [On [Ny Nw]]]].
      destruct (cycle_covers alpha beta_1 beta_2 delta C x_a P Q Ha Hb1 Hb2 Hb Hd HQ HP y w On) as [s [[S _] [E1 E2]]].
      exists s. split; [exact S|]. subst y w. split; assumption.
    + intros x v u T' Mx Rx t Ht.
      (* the distance of this state from the cycle has a minimum, which is zero *)
      set (D := fun s => Rabs (x t - X s) + Rabs (v t - V s)).
      assert (CD : forall s, continuity_pt D s).
      { intros s. apply (continuity_pt_plus (fun s => Rabs (x t - X s)) (fun s => Rabs (v t - V s))).
        - apply (continuity_pt_comp (fun s => x t - X s) Rabs); [|apply Rcontinuity_abs].
          apply (continuity_pt_minus (fun _ => x t) X); [apply continuity_pt_const; intros p q; reflexivity|].
          apply (continuity_of_derive X s (V s)), cycle_velocity; assumption.
        - apply (continuity_pt_comp (fun s => v t - V s) Rabs); [|apply Rcontinuity_abs].
          apply (continuity_pt_minus (fun _ => v t) V); [apply continuity_pt_const; intros p q; reflexivity|].
          apply continuity_of_continuous, cycle_no_jump; assumption. }
      destruct (continuity_ab_min D 0 (2 * T) ltac:(lra)) as [s [Hmin Hs]]; [intros; apply CD|].
      assert (small : forall eps, 0 < eps -> D s < 2 * eps).
      { intros eps Eps. destruct (attraction alpha beta_1 beta_2 delta C x_a Ha Hb1 Hb2 Hb Hx Hd P Q x v u HQ HP Mx eps Eps) as [since H].
        destruct Rx as [T0' Rx']. destruct (large ((since - t) / T')) as [n Hn].
        assert (L : since < t + INR n * T').
        { apply (Rmult_lt_compat_r T') in Hn; [|exact T0']. unfold Rdiv in Hn. rewrite Rmult_assoc, Rinv_l, Rmult_1_r in Hn by lra. lra. }
        destruct (H _ L) as [y [w [On [Ny Nw]]]]. destruct (again n T' x v u (conj T0' Rx') t Ht) as [E1 E2]. rewrite E1 in Ny. rewrite E2 in Nw.
        destruct (cycle_covers alpha beta_1 beta_2 delta C x_a P Q Ha Hb1 Hb2 Hb Hd HQ HP y w On) as [r [[r0 r1] [E3 E4]]].
        fold X in E3. fold V in E4. fold T in r1.
        specialize (Hmin r ltac:(lra)). unfold D in *. rewrite E3, E4 in Hmin. lra. }
      assert (Z : D s = 0).
      { destruct (Req_dec (D s) 0) as [Z|N]; [exact Z|exfalso]. assert (P0 : 0 <= D s) by (unfold D; pose proof (Rabs_pos (x t - X s)); pose proof (Rabs_pos (v t - V s)); lra).
        specialize (small (D s / 2) ltac:(lra)). lra. }
      unfold D in Z. pose proof (Rabs_pos (x t - X s)). pose proof (Rabs_pos (v t - V s)).
      assert (Zx : x t = X s).
      { destruct (Req_dec (x t - X s) 0) as [E|E]; [lra|]. apply Rabs_pos_lt in E. lra. }
      assert (Zv : v t = V s).
      { destruct (Req_dec (v t - V s) 0) as [E|E]; [lra|]. apply Rabs_pos_lt in E. lra. }
      exists (s + T). destruct (R s) as [-> [-> _]]. split; [lra|]. split; assumption.
  - destruct (cycle_amplitude alpha beta_1 beta_2 delta C x_a P Q Ha Hb1 Hb2 Hb Hx Hd HQ HP) as [A1 [A2 A3]].
    split; [intros t _; apply A1|]. split; assumption.
Qed.

(** Whatever the numbers. *)
Theorem one_cycle : exists T X V U, limit_cycle alpha beta_1 beta_2 delta C x_a T X V U.
Proof.
  destruct (forces_positive delta C Hd) as [C1 C2]. unfold c_down, c_up in *.
  destruct (fixed_pair alpha beta_1 beta_2 (C - delta) (C - - delta) x_a Ha Hb1 Hb2 Hb C1 C2 Hx) as [P [Q [HQ HP]]].
  destruct (the_cycle P Q HQ HP) as [X [V [U [L _]]]]. eexists. exists X, V, U. exact L.
Qed.
End Cycle.

(** The symmetric cycle, without disturbance: P on either side. *)
Theorem symmetric_cycle alpha beta_1 beta_2 C x_a P : 0 < alpha -> 0 <= beta_1 -> 0 <= beta_2 -> 0 < beta_1 + beta_2 -> 0 < C -> 0 < x_a ->
  half alpha beta_1 beta_2 C x_a P P ->
  exists X V U,
    limit_cycle alpha beta_1 beta_2 0 C x_a (2 * (time alpha beta_1 beta_2 C P - time alpha beta_1 beta_2 C (- P))) X V U /\
    between (- (x_a + way alpha beta_1 beta_2 C P)) (x_a + way alpha beta_1 beta_2 C P) X.
Proof.
  intros Ha Hb1 Hb2 Hb HC Hx HP.
  assert (D : Rabs 0 < C) by (rewrite Rabs_R0; exact HC).
  pose proof (the_cycle alpha beta_1 beta_2 0 C x_a Ha Hb1 Hb2 Hb Hx D P P) as K. rewrite Ropp_0, Rminus_0_r in K.
  destruct (K HP HP) as [X [V [U [L B]]]]. exists X, V, U. split; [|exact B].
  replace (2 * (time alpha beta_1 beta_2 C P - time alpha beta_1 beta_2 C (- P))) with
    (time alpha beta_1 beta_2 C P - time alpha beta_1 beta_2 C (- P) + (time alpha beta_1 beta_2 C P - time alpha beta_1 beta_2 C (- P))) by ring.
  exact L.
Qed.

(** * What the hypotheses are for *)

(** Without drag each half ends faster than it began, by the same in the square. *)
Theorem grows_without_drag alpha C x_a V V' : 0 < alpha -> 0 < C ->
  half alpha 0 0 C x_a V V' -> V' ^ 2 = V ^ 2 + 4 * C * x_a / alpha.
Proof.
  intros Ha HC [V0 [V1 [_ E]]].
  assert (W : forall v, way alpha 0 0 C v = alpha / (2 * C) * v ^ 2).
  { intros v. unfold way. apply int_unique.
    replace (alpha / (2 * C) * v ^ 2) with (alpha / (2 * C) * v ^ 2 - alpha / (2 * C) * 0 ^ 2) by ring.
    apply (int_eq (fun s => alpha / C * s) _ 0 v (alpha / (2 * C) * v ^ 2 - alpha / (2 * C) * 0 ^ 2)); [|intros t|reflexivity].
    - apply (by_antiderivative (fun s => alpha / (2 * C) * s ^ 2)); intros t; [auto_derive; [trivial|field; lra]|].
      apply (continuous_of_ex_derive (fun s => alpha / C * s)). intros s. auto_derive. trivial.
    - unfold force, drag. field. lra. }
  rewrite !W in E. apply (Rmult_eq_reg_l (alpha / (2 * C))); [|apply Rgt_not_eq, Rdiv_lt_0_compat; lra].
  replace ((- V') ^ 2) with (V' ^ 2) in E by ring. rewrite E. field. lra.
Qed.

(** Without half-width each half ends slower than it began. *)
Theorem dies_without_half_width alpha beta_1 beta_2 C V V' : 0 < alpha -> 0 <= beta_1 -> 0 <= beta_2 -> 0 < beta_1 + beta_2 -> 0 < C -> 0 < V ->
  half alpha beta_1 beta_2 C 0 V V' -> V' < V.
Proof.
  intros Ha Hb1 Hb2 Hb HC V0 [_ [V1 [F E]]].
  destruct (way_between alpha beta_1 beta_2 C Hb1 Hb2 HC 0 V (Rle_refl 0) V0) as [s [Hs Es]].
  destruct (way_between_back alpha beta_1 beta_2 C Hb1 Hb2 HC 0 V' (Rle_refl 0) V1 F) as [r [Hr Er]].
  rewrite Ropp_0, way_0 in Er. rewrite way_0 in Es. pose proof (force_of_speed beta_1 beta_2 C Hb1 Hb2 s ltac:(lra)) as G1.
  pose proof (drag_pos beta_1 beta_2 Hb1 Hb2 r Hb ltac:(lra)) as G2. pose proof (force_le beta_1 beta_2 C Hb1 Hb2 (- V') (- r) ltac:(lra)) as G3.
  assert (G4 : force beta_1 beta_2 C (- r) < C) by (unfold force; rewrite drag_odd; lra).
  assert (Z : (V' ^ 2) * force beta_1 beta_2 C s = V ^ 2 * force beta_1 beta_2 C (- r)).
  { assert (Y : alpha * (V ^ 2 - 0 ^ 2) / (2 * force beta_1 beta_2 C s) = alpha * (V' ^ 2 - 0 ^ 2) / (2 * force beta_1 beta_2 C (- r))) by lra.
    apply (Rmult_eq_reg_l alpha); [|lra]. apply (Rmult_eq_compat_r (2 * force beta_1 beta_2 C s * force beta_1 beta_2 C (- r))) in Y.
    field_simplify in Y; lra. }
  assert (V' ^ 2 < V ^ 2); [|nra]. assert (0 < V' ^ 2) by nra. assert (0 < V ^ 2) by nra.
  apply (Rmult_lt_reg_r (force beta_1 beta_2 C s)); [lra|]. rewrite Z. apply Rmult_lt_compat_l; lra.
Qed.

(** A disturbance of the level or above: a motion that never comes back. *)
Theorem drifts_away alpha beta_1 beta_2 delta C x_a : 0 < alpha -> 0 <= beta_1 -> 0 <= beta_2 -> 0 < beta_1 + beta_2 -> 0 < x_a -> C <= delta ->
  exists x v u, relay_loop alpha beta_1 beta_2 delta C x_a x v u /\ forall t, 0 < t -> x_a < x t.
Proof.
  intros Ha Hb1 Hb2 Hb Hx D.
  assert (W : exists w, 0 <= w /\ drag beta_1 beta_2 w = delta - C).
  { destruct D as [D|D].
    - destruct (terminal_speed beta_1 beta_2 Hb1 Hb2 (delta - C) ltac:(lra) Hb) as [W E]. exists (terminal beta_1 beta_2 (delta - C)). split; [lra|exact E].
    - exists 0. rewrite drag_0. lra. }
  destruct W as [w [W E]]. exists (fun t => x_a + 1 + w * t), (fun _ => w), (fun _ => - C).
  assert (X : forall t, 0 < t -> x_a < x_a + 1 + w * t) by (intros t Ht; nra).
  split; [|exact X]. split; split.
  - intros t Ht. auto_derive; [trivial|ring].
  - intros t Ht. apply continuous_const.
  - intros t Ht _. rewrite E. replace ((- C + delta - (delta - C)) / alpha) with 0 by (field; lra). exact (is_derive_const w t).
  - intros t Ht. right. reflexivity.
  - intros t Ht H. specialize (X t Ht). lra.
  - reflexivity.
  - intros s t Hs Ht st Us between. specialize (X t Ht). destruct st as [st|st]; [specialize (between t Ht ltac:(lra)); lra|exact Us].
  - reflexivity.
Qed.

(** * Closed forms of the two integrals, on either side of rest *)

Section Closed.
Variables alpha beta_1 beta_2 c : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hc : 0 < c).

Lemma antiderivative_is (F G : R -> R) (g : R -> R) v : (forall s, 0 < force beta_1 beta_2 c s -> is_derive F s (g s)) ->
  0 < force beta_1 beta_2 c v -> F 0 = 0 -> G 0 = 0 ->
  (forall s, Rmin 0 v < s < Rmax 0 v -> is_derive G s (g s)) -> (forall s, Rmin 0 v <= s <= Rmax 0 v -> continuity_pt G s) -> F v = G v.
Proof.
  intros DF P F0 G0 DG CG.
  assert (L : forall s, Rmin 0 v <= s -> 0 < force beta_1 beta_2 c s).
  { intros s Hs. pose proof (force_le beta_1 beta_2 c Hb1 Hb2 (Rmin 0 v) s Hs). unfold Rmin in *. destruct (Rle_dec 0 v); [rewrite force_at_rest in *|]; lra. }
  assert (K : F (Rmax 0 v) - G (Rmax 0 v) = F (Rmin 0 v) - G (Rmin 0 v)).
  { apply (is_constant (fun s => F s - G s)); [apply Rminmax|intros s Hs|intros s Hs].
    - replace 0 with (minus (g s) (g s)) by (unfold minus, plus, opp; simpl; ring). apply (is_derive_minus F G); [apply DF, L; lra|apply DG, Hs].
    - apply (continuity_pt_minus F G); [apply (continuity_of_derive F s (g s)), DF, L; lra|apply CG, Hs]. }
  unfold Rmax, Rmin in K. destruct (Rle_dec 0 v); lra.
Qed.

Lemma way_is (G : R -> R) v : 0 < force beta_1 beta_2 c v -> G 0 = 0 ->
  (forall s, Rmin 0 v < s < Rmax 0 v -> is_derive G s (alpha * s / force beta_1 beta_2 c s)) ->
  (forall s, Rmin 0 v <= s <= Rmax 0 v -> continuity_pt G s) -> way alpha beta_1 beta_2 c v = G v.
Proof.
  intros P G0. apply (antiderivative_is _ _ (fun s => alpha * s / force beta_1 beta_2 c s)); try assumption; [|apply way_0].
  intros s Hs. apply way_derive; assumption.
Qed.

Lemma time_is (G : R -> R) v : 0 < force beta_1 beta_2 c v -> G 0 = 0 ->
  (forall s, Rmin 0 v < s < Rmax 0 v -> is_derive G s (alpha / force beta_1 beta_2 c s)) ->
  (forall s, Rmin 0 v <= s <= Rmax 0 v -> continuity_pt G s) -> time alpha beta_1 beta_2 c v = G v.
Proof.
  intros P G0. apply (antiderivative_is _ _ (fun s => alpha / force beta_1 beta_2 c s)); try assumption; [|apply time_0].
  intros s Hs. apply time_derive; assumption.
Qed.
End Closed.
