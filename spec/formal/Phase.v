(** A drag axis while the command stays: [alpha v' = -(c + drag v)], [x' = v], [c] the force of the command less the disturbance. In the phase
    plane x falls as [way v] grows, and time passes as [time v] falls: two integrals that know nothing of the start. Shared by the orbits.
    The other command is the mirror image: [-x], [-v], and the other c. *)
From Coq Require Import Reals Lra Lia Psatz Ranalysis5.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

(** * The drag *)

Lemma abs_cases v : 0 <= v /\ Rabs v = v \/ v < 0 /\ Rabs v = - v.
Proof. unfold Rabs. destruct (Rcase_abs v); [right|left]; lra. Qed.

Lemma drag_odd beta_1 beta_2 v : drag beta_1 beta_2 (- v) = - drag beta_1 beta_2 v.
Proof. unfold drag. rewrite Rabs_Ropp. ring. Qed.

Lemma drag_0 beta_1 beta_2 : drag beta_1 beta_2 0 = 0.
Proof. unfold drag. ring. Qed.

Lemma drag_derive beta_1 beta_2 v : is_derive (drag beta_1 beta_2) v (beta_1 + 2 * beta_2 * Rabs v).
Proof.
  assert (Q : is_derive (fun v => v * Rabs v) v (2 * Rabs v)).
  { apply is_derive_Reals. intros eps Heps. exists (mkposreal eps Heps). intros h Hh Hs. simpl in Hs.
    assert (B : Rabs ((v + h) * Rabs (v + h) - v * Rabs v - 2 * Rabs v * h) <= h * h).
    { apply Rabs_le. destruct (abs_cases v) as [[A ->]|[A ->]], (abs_cases (v + h)) as [[B ->]|[B ->]]; split; nra. }
    replace (((v + h) * Rabs (v + h) - v * Rabs v) / h - 2 * Rabs v)
      with (((v + h) * Rabs (v + h) - v * Rabs v - 2 * Rabs v * h) / h) by (field; exact Hh).
    unfold Rdiv. rewrite Rabs_mult, Rabs_inv. pose proof (Rabs_pos_lt h Hh) as P.
    apply (Rmult_lt_reg_r (Rabs h)); [exact P|]. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
    replace (h * h) with (Rabs h * Rabs h) in B by (rewrite <- Rabs_mult; apply Rabs_pos_eq; nra). nra. }
  unfold drag. apply (is_derive_ext (fun v => plus (scal beta_1 v) (scal beta_2 (v * Rabs v)))); [reflexivity|].
  replace (beta_1 + 2 * beta_2 * Rabs v) with (plus (scal beta_1 one) (scal beta_2 (2 * Rabs v)))
    by (unfold plus, scal, one; simpl; unfold mult; simpl; ring).
  apply (is_derive_plus (V := R_NormedModule)).
  - apply (is_derive_scal (fun v => v) v beta_1 one). apply (is_derive_id (K := R_AbsRing)).
  - apply (is_derive_scal (fun v => v * Rabs v) v beta_2 (2 * Rabs v) Q).
Qed.

Section Drag.
Variables beta_1 beta_2 : R.
Hypotheses (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2).

Lemma drag_le a b : a <= b -> drag beta_1 beta_2 a <= drag beta_1 beta_2 b.
Proof.
  intros ab. unfold drag. assert (a * Rabs a <= b * Rabs b); [|apply Rplus_le_compat; apply Rmult_le_compat_l; assumption].
  destruct (abs_cases a) as [[A ->]|[A ->]], (abs_cases b) as [[B ->]|[B ->]]; nra.
Qed.

Lemma drag_lt a b : 0 < beta_1 + beta_2 -> a < b -> drag beta_1 beta_2 a < drag beta_1 beta_2 b.
Proof.
  intros P ab. unfold drag. assert (Q : a * Rabs a < b * Rabs b).
  2:{ destruct Hb1 as [B| <-]; [|rewrite !Rmult_0_l, !Rplus_0_l; apply Rmult_lt_compat_l; lra].
      apply Rplus_lt_le_compat; [apply Rmult_lt_compat_l|apply Rmult_le_compat_l]; lra. }
  destruct (abs_cases a) as [[A ->]|[A ->]], (abs_cases b) as [[B ->]|[B ->]]; nra.
Qed.

Lemma drag_nonneg v : 0 <= v -> 0 <= drag beta_1 beta_2 v.
Proof. intros H. rewrite <- (drag_0 beta_1 beta_2). apply drag_le, H. Qed.

Lemma drag_pos v : 0 < beta_1 + beta_2 -> 0 < v -> 0 < drag beta_1 beta_2 v.
Proof. intros P H. rewrite <- (drag_0 beta_1 beta_2). now apply drag_lt. Qed.

(** The speed at which drag takes all of a force c. *)
Definition terminal (c : R) : R := 2 * c / (beta_1 + sqrt (beta_1 ^ 2 + 4 * beta_2 * c)).

Lemma terminal_speed c : 0 < c -> 0 < beta_1 + beta_2 -> 0 < terminal c /\ drag beta_1 beta_2 (terminal c) = c.
Proof.
  intros Hc P. unfold terminal. set (r := sqrt _).
  assert (E : r * r = beta_1 ^ 2 + 4 * beta_2 * c) by (apply sqrt_sqrt; nra).
  assert (R0 : 0 <= r) by apply sqrt_pos.
  assert (S : 0 < beta_1 + r).
  { destruct (Req_dec beta_1 0) as [Z|Z]; [|lra]. assert (0 < r * r) by (rewrite E, Z; nra). nra. }
  assert (T : 0 < 2 * c / (beta_1 + r)) by (apply Rdiv_lt_0_compat; lra).
  split; [exact T|]. unfold drag. rewrite (Rabs_pos_eq _ (Rlt_le _ _ T)).
  apply (Rmult_eq_reg_r ((beta_1 + r) * (beta_1 + r))); [|apply Rgt_not_eq; nra]. field_simplify; [|lra].
  replace (r ^ 2) with (beta_1 ^ 2 + 4 * beta_2 * c) by (rewrite <- E; ring). ring.
Qed.
End Drag.

(** * The two integrals *)

Section Fall.
Variables alpha beta_1 beta_2 c : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hc : 0 < c).

(** The force that slows; above minus the terminal speed it does not vanish. *)
Definition force (v : R) : R := c + drag beta_1 beta_2 v.
Definition way (v : R) : R := RInt (fun s => alpha * s / force s) 0 v.
Definition time (v : R) : R := RInt (fun s => alpha / force s) 0 v.

Lemma force_derive v : is_derive force v (beta_1 + 2 * beta_2 * Rabs v).
Proof.
  unfold force. replace (beta_1 + 2 * beta_2 * Rabs v) with (0 + (beta_1 + 2 * beta_2 * Rabs v)) by ring.
  apply (is_derive_plus (fun _ => c) (drag beta_1 beta_2) v 0); [exact (is_derive_const c v)|apply drag_derive].
Qed.

Lemma force_le a b : a <= b -> force a <= force b.
Proof. intros ab. unfold force. pose proof (drag_le beta_1 beta_2 Hb1 Hb2 a b ab). lra. Qed.

Lemma force_at_rest : force 0 = c.
Proof. unfold force. rewrite drag_0. ring. Qed.

Lemma force_of_speed v : 0 <= v -> c <= force v.
Proof. intros H. rewrite <- force_at_rest. apply force_le, H. Qed.

Lemma force_continuous v : continuous force v.
Proof. apply (continuous_of_derive _ v _ (force_derive v)). Qed.

Lemma integrand_continuous (g : R -> R) v : (forall s, continuous g s) -> 0 < force v -> continuous (fun s => g s / force s) v.
Proof.
  intros G P. apply (continuous_mult (K := R_AbsRing) g (fun s => / force s)); [apply G|].
  apply (continuous_comp force Rinv); [apply force_continuous|]. apply continuous_Rinv. lra.
Qed.

Lemma integral_derive (g : R -> R) v : (forall s, continuous g s) -> 0 < force v ->
  is_derive (fun v => RInt (fun s => g s / force s) 0 v) v (g v / force v).
Proof.
  intros G P. apply (is_derive_RInt (V := R_CompleteNormedModule) (fun s => g s / force s) (fun v => RInt (fun s => g s / force s) 0 v) 0 v);
    [|apply integrand_continuous; assumption].
  assert (L : locally v (fun s => 0 < force s)) by (apply (force_continuous v); apply open_gt; exact P).
  revert L. apply filter_imp. intros s Hs. apply (RInt_correct (V := R_CompleteNormedModule)).
  apply (ex_RInt_continuous (V := R_CompleteNormedModule)). intros r Hr. apply integrand_continuous; [exact G|].
  apply Rlt_le_trans with (force (Rmin 0 s)); [|apply force_le, Hr].
  unfold Rmin. destruct (Rle_dec 0 s); [rewrite force_at_rest; exact Hc|exact Hs].
Qed.

Lemma way_derive v : 0 < force v -> is_derive way v (alpha * v / force v).
Proof.
  intros P. apply (integral_derive (fun s => alpha * s)); [|exact P].
  apply continuous_of_ex_derive. intros s. auto_derive. trivial.
Qed.

Lemma time_derive v : 0 < force v -> is_derive time v (alpha / force v).
Proof. intros P. apply (integral_derive (fun _ => alpha)); [intros; apply continuous_const|exact P]. Qed.

Lemma way_0 : way 0 = 0.
Proof. unfold way. rewrite (RInt_point (V := R_CompleteNormedModule)). reflexivity. Qed.
Lemma time_0 : time 0 = 0.
Proof. unfold time. rewrite (RInt_point (V := R_CompleteNormedModule)). reflexivity. Qed.

Lemma between_moves a v : 0 < force a -> a <= v -> 0 < force v.
Proof. intros P av. pose proof (force_le a v av). lra. Qed.

Lemma way_rises a b : 0 <= a -> a < b -> way a < way b.
Proof.
  intros A ab. assert (P : forall v, 0 <= v -> 0 < force v) by (intros v V; pose proof (force_of_speed v V); lra).
  apply (increases way (fun v => alpha * v / force v)); [exact ab| | |]; intros v V.
  - apply way_derive, P. lra.
  - apply (continuity_of_derive way v (alpha * v / force v)), way_derive, P. lra.
  - apply Rdiv_lt_0_compat; [nra|apply P; lra].
Qed.

Lemma way_falls a b : 0 < force a -> a < b -> b <= 0 -> way b < way a.
Proof.
  intros A ab B. assert (P : forall v, a <= v -> 0 < force v) by (intros v V; pose proof (force_le a v V); lra).
  apply (decreases way (fun v => alpha * v / force v)); [exact ab| | |]; intros v V.
  - apply way_derive, P. lra.
  - apply (continuity_of_derive way v (alpha * v / force v)), way_derive, P. lra.
  - assert (0 < - (alpha * v) / force v) by (apply Rdiv_lt_0_compat; [nra|apply P; lra]).
    unfold Rdiv in *. nra.
Qed.

Lemma time_rises a b : 0 < force a -> a < b -> time a < time b.
Proof.
  intros A ab. assert (P : forall v, a <= v -> 0 < force v) by (intros v V; pose proof (force_le a v V); lra).
  apply (increases time (fun v => alpha / force v)); [exact ab| | |]; intros v V.
  - apply time_derive, P. lra.
  - apply (continuity_of_derive time v (alpha / force v)), time_derive, P. lra.
  - apply Rdiv_lt_0_compat; [lra|apply P; lra].
Qed.

(** * Any motion *)

(** From instant a to instant b the axis falls freely: the command stays. *)
Record fall (x v : R -> R) (a b : R) : Prop := {
  ordered : a <= b;
  x_continuous : forall t, a <= t <= b -> continuity_pt x t;
  v_continuous : forall t, a <= t <= b -> continuity_pt v t;
  x_moves : forall t, a < t < b -> is_derive x t (v t);
  v_falls : forall t, a < t < b -> is_derive v t (- (force (v t) / alpha)) }.

Lemma fall_part x v a b s t : fall x v a b -> a <= s -> s <= t -> t <= b -> fall x v s t.
Proof. intros [O X V DX DV] as_ st tb. split; [exact st|..]; intros r Hr; [apply X|apply V|apply DX|apply DV]; lra. Qed.

(** The terminal speed is not reached: the square of the force, times an exponential, does not fall. *)
Lemma keeps_moving x v a b t : fall x v a b -> 0 < force (v a) -> a <= t <= b -> 0 < force (v t).
Proof.
  intros L P T. destruct (Req_dec t a) as [->|N]; [exact P|].
  pose proof (fall_part x v a b a t L ltac:(lra) ltac:(lra) ltac:(lra)) as [O _ V _ DV].
  assert (Fc : forall r, a <= r <= t -> continuity_pt (fun r => force (v r)) r).
  { intros r Hr. apply (continuity_pt_comp v force r); [apply V; lra|]. apply (continuity_of_derive force _ _ (force_derive (v r))). }
  destruct (continuity_ab_maj (fun r => beta_1 + 2 * beta_2 * Rabs (v r)) a t ltac:(lra)) as [M [HM _]].
  { intros r Hr. apply (continuity_pt_plus (fun _ => beta_1) (fun r => 2 * beta_2 * Rabs (v r))); [apply continuity_pt_const; intros p q; reflexivity|].
    apply (continuity_pt_scal (fun r => Rabs (v r)) (2 * beta_2)). apply (continuity_pt_comp v Rabs r); [apply V; lra|apply Rcontinuity_abs]. }
  set (k := beta_1 + 2 * beta_2 * Rabs (v M)) in *.
  set (Q := fun r => force (v r) * force (v r) * exp (2 * k / alpha * r)).
  assert (never : forall r, a <= r <= t -> force (v r) <> 0).
  { intros r Hr E. assert (QQ : Q a <= Q r).
    { apply (does_not_fall Q (fun r => 2 * (k - (beta_1 + 2 * beta_2 * Rabs (v r))) / alpha * Q r)); [lra| | |].
      - intros s Hs. unfold Q.
        assert (D1 : is_derive (fun r => force (v r)) s (- (force (v s) / alpha) * (beta_1 + 2 * beta_2 * Rabs (v s)))).
        { apply (is_derive_comp force v s _ _ (force_derive (v s)) (DV s ltac:(lra))). }
        assert (D2 : is_derive (fun r => exp (2 * k / alpha * r)) s (2 * k / alpha * exp (2 * k / alpha * s))) by (auto_derive; [trivial|ring]).
        pose proof (is_derive_mult _ _ s _ _ D1 D1 (fun p q => Rmult_comm p q)) as D3.
        pose proof (is_derive_mult _ _ s _ _ D3 D2 (fun p q => Rmult_comm p q)) as D4.
        revert D4. unfold plus, mult; simpl. intros D4.
        match type of D4 with is_derive _ _ ?l => match goal with |- is_derive _ _ ?m => replace m with l by (field; lra) end end. exact D4.
      - intros s Hs. apply continuity_pt_mult; [apply continuity_pt_mult; apply Fc; lra|].
        apply derivable_continuous_pt. exists (2 * k / alpha * exp (2 * k / alpha * s)). apply is_derive_Reals. auto_derive; [trivial|ring].
      - intros s Hs. specialize (HM s ltac:(lra)). cbv beta in HM. fold k in HM.
        apply Rmult_le_pos; [apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; lra]|].
        unfold Q. apply Rmult_le_pos; [apply Rle_0_sqr|left; apply exp_pos]. }
    unfold Q in QQ. rewrite E in QQ. pose proof (exp_pos (2 * k / alpha * a)) as Ea.
    assert (0 < force (v a) * force (v a) * exp (2 * k / alpha * a)) by (apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat; exact P|exact Ea]). nra. }
  destruct (Rlt_le_dec 0 (force (v t))) as [Q1|Q1]; [exact Q1|exfalso].
  assert (Q2 : force (v t) < 0) by (pose proof (never t ltac:(lra)); lra).
  destruct (IVT_interv (fun r => - force (v r)) a t) as [z [Z1 Z2]]; try lra.
  { intros r Hr. apply (continuity_pt_opp (fun r => force (v r))), Fc, Hr. }
  apply (never z Z1). lra.
Qed.

(** The first integral, and the time. *)
Lemma first_integral x v a b : fall x v a b -> 0 < force (v a) -> x b + way (v b) = x a + way (v a).
Proof.
  intros L P. pose proof (keeps_moving x v a b) as K. pose proof L as [O X V DX DV].
  apply (is_constant (fun t => x t + way (v t)) a b O); intros t Ht.
  - assert (Pt := K t L P ltac:(lra)).
    pose proof (is_derive_comp way v t _ _ (way_derive (v t) Pt) (DV t Ht)) as D.
    pose proof (is_derive_plus x (fun t => way (v t)) t _ _ (DX t Ht) D) as E. revert E. unfold plus, scal; simpl; unfold mult; simpl. intros E.
    match type of E with is_derive _ _ ?l => replace l with 0 in E by (field; lra) end. exact E.
  - apply (continuity_pt_plus x (fun t => way (v t))); [apply X, Ht|]. apply (continuity_pt_comp v way t); [apply V, Ht|].
    apply (continuity_of_derive way _ _ (way_derive (v t) (K t L P Ht))).
Qed.

Lemma passing_time x v a b : fall x v a b -> 0 < force (v a) -> time (v b) + b = time (v a) + a.
Proof.
  intros L P. pose proof (keeps_moving x v a b) as K. pose proof L as [O X V DX DV].
  apply (is_constant (fun t => time (v t) + t) a b O); intros t Ht.
  - assert (Pt := K t L P ltac:(lra)).
    pose proof (is_derive_comp time v t _ _ (time_derive (v t) Pt) (DV t Ht)) as D.
    pose proof (is_derive_plus (fun t => time (v t)) (fun t => t) t _ _ D (is_derive_id (K := R_AbsRing) t)) as E. revert E.
    unfold plus, scal, one; simpl; unfold mult; simpl. intros E.
    match type of E with is_derive _ _ ?l => replace l with 0 in E by (field; lra) end. exact E.
  - apply (continuity_pt_plus (fun t => time (v t)) (fun t => t)); [|apply derivable_continuous_pt, derivable_pt_id].
    apply (continuity_pt_comp v time t); [apply V, Ht|]. apply (continuity_of_derive time _ _ (time_derive (v t) (K t L P Ht))).
Qed.

Lemma speed_falls x v a b s t : fall x v a b -> 0 < force (v a) -> a <= s -> s < t -> t <= b -> v t < v s.
Proof.
  intros L P as_ st tb. assert (Ps := keeps_moving x v a b s L P ltac:(lra)).
  assert (Ls := fall_part x v a b s t L as_ ltac:(lra) tb). assert (Pt := keeps_moving x v s t t Ls Ps ltac:(lra)).
  pose proof (passing_time x v s t Ls Ps). destruct (Rlt_le_dec (v t) (v s)) as [Q|[Q|Q]]; [exact Q| |].
  - pose proof (time_rises (v s) (v t) Ps Q). lra.
  - rewrite Q in *. lra.
Qed.

(** * How far it goes *)

(** A speed that can be computed, not only one that exists: so with the half below. *)
Lemma way_grows_without_bound y : {V | 0 < V /\ 0 < force (- V) /\ y <= way (- V)}.
Proof.
  (* [way (- V)] begins at 0, and its derivative is [alpha V/force (- V)]. *)
  assert (D : forall V, 0 < force (- V) -> is_derive (fun V => way (- V)) V (alpha * V / force (- V))).
  { intros V P. pose proof (is_derive_comp way (fun V => - V) V _ (-1) (way_derive (- V) P)) as D.
    replace (alpha * V / force (- V)) with (scal (-1) (alpha * - V / force (- V))) by (unfold scal; simpl; unfold mult; simpl; field; lra).
    apply D. auto_derive; [trivial|ring]. }
  destruct (Rle_lt_or_eq_dec 0 (beta_1 + beta_2) (Rplus_le_le_0_compat _ _ Hb1 Hb2)) as [Q|Q].
  - destruct (terminal_speed beta_1 beta_2 Hb1 Hb2 c Hc Q) as [W E]. set (w := terminal beta_1 beta_2 c) in *.
    set (L := beta_1 + 2 * beta_2 * w).
    assert (HL : 0 < L) by (unfold L; destruct (Req_dec beta_1 0); nra).
    assert (f : forall V, 0 <= V < w -> 0 < force (- V) <= L * (w - V)).
    { intros V HV. unfold force. rewrite drag_odd. split.
      - pose proof (drag_lt beta_1 beta_2 Hb1 Hb2 V w Q ltac:(lra)). lra.
      - rewrite <- E at 1. unfold drag, L. rewrite !Rabs_pos_eq by lra. pose proof (Rmult_le_pos beta_2 ((w - V) * (w - V)) Hb2 (Rle_0_sqr (w - V))). lra. }
    set (k := Rmax 0 (L * y / (alpha * w)) + 1).
    assert (Hk : 0 < k) by (unfold k; pose proof (Rmax_l 0 (L * y / (alpha * w))); lra).
    assert (X : 0 < exp (- k) < 1) by (split; [apply exp_pos|rewrite <- exp_0; apply exp_increasing; lra]).
    exists (w * (1 - exp (- k))). assert (HV : 0 < w * (1 - exp (- k)) < w) by (split; nra).
    split; [lra|]. split; [apply f; lra|].
    assert (B : way (- 0) - alpha / L * (- w * ln (1 - 0 / w) - 0)
             <= way (- (w * (1 - exp (- k)))) - alpha / L * (- w * ln (1 - w * (1 - exp (- k)) / w) - w * (1 - exp (- k)))).
    { apply (does_not_fall (fun V => way (- V) - alpha / L * (- w * ln (1 - V / w) - V))
        (fun V => alpha * V / force (- V) - alpha / L * (V / (w - V)))); [lra| | |].
      - intros V V0. assert (U : 0 < 1 - V / w) by (pose proof (div_lt_one V w W ltac:(lra)); lra).
        apply (is_derive_minus (fun V => way (- V)) (fun V => alpha / L * (- w * ln (1 - V / w) - V))); [apply D, f; lra|].
        auto_derive; [lra|]. field. repeat split; lra.
      - intros V V0. assert (U : 0 < 1 - V / w) by (pose proof (div_lt_one V w W ltac:(lra)); lra).
        apply (continuity_pt_minus (fun V => way (- V)) (fun V => alpha / L * (- w * ln (1 - V / w) - V))).
        + apply (continuity_of_derive _ V _ (D V (proj1 (f V ltac:(lra))))).
        + apply (continuity_of_derive _ V (alpha / L * (V / (w - V)))). auto_derive; [lra|]. field. repeat split; lra.
      - intros V V0. destruct (f V ltac:(lra)) as [f1 f2].
        replace (alpha / L * (V / (w - V))) with (alpha * V * / (L * (w - V))) by (field; lra).
        assert (/ (L * (w - V)) <= / force (- V)) by (apply Rinv_le_contravar; assumption). unfold Rdiv.
        assert (0 <= alpha * V) by nra. nra. }
    replace (1 - 0 / w) with 1 in B by (field; lra). replace (1 - w * (1 - exp (- k)) / w) with (exp (- k)) in B by (field; lra).
    rewrite ln_1, ln_exp, Ropp_0, way_0 in B.
    assert (y <= alpha / L * (- w * - k - w * (1 - exp (- k)))); [|lra].
    assert (K1 : L * y / (alpha * w) <= k - 1) by (unfold k; pose proof (Rmax_r 0 (L * y / (alpha * w))); lra).
    assert (AL : 0 < alpha / L) by (apply Rdiv_lt_0_compat; lra).
    assert (Y : y = alpha / L * (w * (L * y / (alpha * w)))) by (field; lra). rewrite Y at 1.
    apply Rmult_le_compat_l; [lra|]. nra.
  - (* no drag: [way v] is [alpha v^2/(2 c)] *)
    assert (B1 : beta_1 = 0) by lra. assert (B2 : beta_2 = 0) by lra.
    assert (f : forall v, force v = c) by (intros; unfold force, drag; rewrite B1, B2; ring).
    set (V := 1 + Rmax 0 (2 * c * y / alpha)). exists V.
    assert (HV : 1 <= V /\ 2 * c * y / alpha <= V) by (unfold V; pose proof (Rmax_l 0 (2 * c * y / alpha)); pose proof (Rmax_r 0 (2 * c * y / alpha)); lra).
    split; [lra|]. split; [rewrite f; exact Hc|].
    assert (B : way (- V) - alpha / (2 * c) * V ^ 2 = way (- 0) - alpha / (2 * c) * 0 ^ 2).
    { apply (is_constant (fun V => way (- V) - alpha / (2 * c) * V ^ 2) 0 V); [lra| |]; intros s Hs.
      - assert (Ps : 0 < force (- s)) by (rewrite f; exact Hc). specialize (D s Ps). rewrite f in D.
        replace 0 with (minus (alpha * s / c) (alpha * s / c)) by (unfold minus, plus, opp; simpl; ring).
        apply (is_derive_minus (fun V => way (- V)) (fun V => alpha / (2 * c) * V ^ 2)); [exact D|]. auto_derive; [trivial|field; lra].
      - assert (Ps : 0 < force (- s)) by (rewrite f; exact Hc).
        apply (continuity_pt_minus (fun V => way (- V)) (fun V => alpha / (2 * c) * V ^ 2)); [apply (continuity_of_derive _ s _ (D s Ps))|].
        apply (continuity_of_derive _ s (alpha * s / c)). auto_derive; [trivial|field; lra]. }
    rewrite Ropp_0, way_0 in B. replace (way (- V)) with (alpha / (2 * c) * V ^ 2) by lra.
    replace y with (alpha / (2 * c) * (2 * c * y / alpha)) by (field; lra). apply Rmult_le_compat_l; [|nra].
    left. apply Rdiv_lt_0_compat; lra.
Qed.

(** * From one switching to the next *)

(** From the level [x_a] at the speed V the axis comes to [-x_a] at the speed V', the other way. *)
Definition half (x_a V V' : R) : Prop := 0 <= V /\ 0 < V' /\ 0 < force (- V') /\ way (- V') = way V + 2 * x_a.

Lemma half_exists x_a V : 0 < x_a -> 0 <= V -> {V' | half x_a V V'}.
Proof.
  intros Hx HV. set (y := way V + 2 * x_a).
  assert (W : 0 <= way V) by (destruct HV as [HV| <-]; [pose proof (way_rises 0 V (Rle_refl 0) HV); rewrite way_0 in *; lra|rewrite way_0; lra]).
  destruct (way_grows_without_bound (y + 1)) as [M [M0 [M1 M2]]].
  destruct (IVT_interv (fun V => way (- V) - y) 0 M) as [V' [V1 V2]].
  - intros s Hs. apply (continuity_pt_minus (fun V => way (- V)) (fun _ => y)); [|apply continuity_pt_const; intros p q; reflexivity].
    apply (continuity_pt_comp (fun V => - V) way s); [apply derivable_continuous_pt; apply derivable_pt_opp, derivable_pt_id|].
    apply (continuity_of_derive way (- s) (alpha * - s / force (- s))), way_derive.
    pose proof (force_le (- M) (- s) ltac:(lra)). lra.
  - exact M0.
  - rewrite Ropp_0, way_0. unfold y. lra.
  - lra.
  - exists V'. assert (V' <> 0) by (intros E; rewrite E, Ropp_0, way_0 in V2; unfold y in V2; lra).
    unfold half. repeat split; try lra; [|unfold y in V2; lra]. pose proof (force_le (- M) (- V') ltac:(lra)). lra.
Qed.

Lemma half_increases x_a V V' W W' : half x_a V V' -> half x_a W W' -> V < W -> V' < W'.
Proof.
  intros [V0 [V1 [V2 V3]]] [W0 [W1 [W2 W3]]] VW. pose proof (way_rises V W V0 VW).
  destruct (Rlt_le_dec V' W') as [Q|[Q|Q]]; [exact Q| |].
  - pose proof (way_falls (- V') (- W') V2 ltac:(lra) ltac:(lra)). lra.
  - subst. lra.
Qed.

Lemma half_unique x_a V V' W' : half x_a V V' -> half x_a V W' -> V' = W'.
Proof.
  intros [V0 [V1 [V2 V3]]] [W0 [W1 [W2 W3]]]. destruct (Rtotal_order V' W') as [Q|[Q|Q]]; [|exact Q|].
  - pose proof (way_falls (- W') (- V') W2 ltac:(lra) ltac:(lra)). lra.
  - pose proof (way_falls (- V') (- W') V2 ltac:(lra) ltac:(lra)). lra.
Qed.

Lemma half_does_not_fall x_a V V' W W' : half x_a V V' -> half x_a W W' -> V <= W -> V' <= W'.
Proof. intros A B [L| <-]; [left; exact (half_increases x_a V V' W W' A B L)|right; exact (half_unique x_a V V' W' A B)]. Qed.

Lemma half_back x_a V V' W : half x_a V V' -> half x_a W V' -> V = W.
Proof.
  intros A B. destruct (Rtotal_order V W) as [Q|[Q|Q]]; [|exact Q|].
  - pose proof (half_increases x_a V V' W V' A B Q). lra.
  - pose proof (half_increases x_a W V' V V' B A Q). lra.
Qed.

(** The square of the speed: two of them come nearer in every half, by no less than what drag takes at the least speed m. *)
Lemma way_between V W : 0 <= V -> V < W ->
  exists s, V < s < W /\ way W - way V = alpha * (W ^ 2 - V ^ 2) / (2 * force s).
Proof.
  intros V0 VW. assert (P : forall v, V <= v -> 0 < force v) by (intros v Hv; pose proof (force_of_speed v ltac:(lra)); lra).
  destruct (cauchy way (fun s => s ^ 2) (fun v => alpha * v / force v) (fun s => 2 * s) V W VW) as [s [Hs E]].
  - intros v Hv. apply way_derive, P. lra.
  - intros v _. auto_derive; [trivial|ring].
  - intros v Hv. apply (continuity_of_derive way v (alpha * v / force v)), way_derive, P. lra.
  - intros v _. apply (continuity_of_derive _ v (2 * v)). auto_derive; [trivial|ring].
  - exists s. split; [exact Hs|]. specialize (P s ltac:(lra)). cbv beta in E.
    apply (Rmult_eq_reg_r (2 * s)); [|lra]. rewrite <- E. field. lra.
Qed.

Lemma way_between_back V W : 0 <= V -> V < W -> 0 < force (- W) ->
  exists s, V < s < W /\ way (- W) - way (- V) = alpha * (W ^ 2 - V ^ 2) / (2 * force (- s)).
Proof.
  intros V0 VW PW. assert (P : forall v, - W <= v -> 0 < force v) by (intros v Hv; pose proof (force_le (- W) v Hv); lra).
  destruct (cauchy way (fun s => s ^ 2) (fun v => alpha * v / force v) (fun s => 2 * s) (- W) (- V) ltac:(lra)) as [s [Hs E]].
  - intros v Hv. apply way_derive, P. lra.
  - intros v _. auto_derive; [trivial|ring].
  - intros v Hv. apply (continuity_of_derive way v (alpha * v / force v)), way_derive, P. lra.
  - intros v _. apply (continuity_of_derive _ v (2 * v)). auto_derive; [trivial|ring].
  - exists (- s). split; [lra|]. rewrite Ropp_involutive. specialize (P s ltac:(lra)). cbv beta in E.
    apply (Rmult_eq_reg_r (2 * s)); [|lra]. replace (W ^ 2 - V ^ 2) with (- ((- V) ^ 2 - (- W) ^ 2)) by ring.
    replace ((way (- W) - way (- V)) * (2 * s)) with (- ((way (- V) - way (- W)) * (2 * s))) by ring. rewrite <- E. field. lra.
Qed.

Lemma half_contracts x_a m V V' W W' : half x_a V V' -> half x_a W W' -> V <= W -> 0 <= m -> m <= V -> m <= V' ->
  (W' ^ 2 - V' ^ 2) * force m <= force (- m) * (W ^ 2 - V ^ 2).
Proof.
  intros A B [VW| <-] M MV MV'; [|rewrite (half_unique x_a V V' W' A B); lra].
  pose proof (half_increases x_a V V' W W' A B VW) as VW'.
  destruct A as [V0 [V1 [V2 V3]]]. destruct B as [W0 [W1 [W2 W3]]].
  destruct (way_between V W V0 VW) as [s [Hs Es]]. destruct (way_between_back V' W' (Rlt_le _ _ V1) VW' W2) as [r [Hr Er]].
  pose proof (force_le m s ltac:(lra)) as F1. pose proof (force_le (- r) (- m) ltac:(lra)) as F2.
  pose proof (force_of_speed m M) as F3. pose proof (force_le (- W') (- r) ltac:(lra)) as F4.
  assert (E : (W' ^ 2 - V' ^ 2) * force s = force (- r) * (W ^ 2 - V ^ 2)).
  { assert (Z : alpha * (W ^ 2 - V ^ 2) / (2 * force s) = alpha * (W' ^ 2 - V' ^ 2) / (2 * force (- r))) by lra.
    apply (Rmult_eq_reg_l alpha); [|lra].
    apply (Rmult_eq_compat_r (2 * force s * force (- r))) in Z. field_simplify in Z; lra. }
  assert (0 < W ^ 2 - V ^ 2) by nra. assert (0 < W' ^ 2 - V' ^ 2) by nra.
  apply Rle_trans with ((W' ^ 2 - V' ^ 2) * force s); [apply Rmult_le_compat_l; lra|].
  rewrite E. apply Rmult_le_compat_r; lra.
Qed.

(** From either side. *)
Lemma half_nears x_a m V V' A B : half x_a V V' -> half x_a A B -> 0 <= m -> m <= V -> m <= V' -> m <= A -> m <= B ->
  Rabs (V' ^ 2 - B ^ 2) * force m <= force (- m) * Rabs (V ^ 2 - A ^ 2).
Proof.
  intros HV HA M MV MV' MA MB. destruct (Rle_lt_dec V A) as [L|L].
  - pose proof (half_does_not_fall x_a V V' A B HV HA L). pose proof HV as [? [? _]]. pose proof HA as [? [? _]].
    rewrite !Rabs_left1 by nra.
    replace (- (V' ^ 2 - B ^ 2)) with (B ^ 2 - V' ^ 2) by ring. replace (- (V ^ 2 - A ^ 2)) with (A ^ 2 - V ^ 2) by ring.
    apply (half_contracts x_a m V V' A B HV HA); lra.
  - pose proof (half_does_not_fall x_a A B V V' HA HV (Rlt_le _ _ L)). pose proof HV as [? [? _]]. pose proof HA as [? [? _]].
    rewrite !Rabs_pos_eq by nra. apply (half_contracts x_a m A B V V' HA HV); lra.
Qed.

(** A half takes its time, and ends below the terminal speed. *)
Lemma half_below_terminal x_a V V' w : half x_a V V' -> drag beta_1 beta_2 w = c -> V' < w.
Proof.
  intros [_ [_ [P _]]] E. destruct (Rlt_le_dec V' w) as [Q|Q]; [exact Q|exfalso].
  pose proof (force_le (- V') (- w) ltac:(lra)) as F. unfold force in F at 2. rewrite drag_odd in F. lra.
Qed.
End Fall.
