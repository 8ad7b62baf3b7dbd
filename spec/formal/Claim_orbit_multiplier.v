(** claim: orbit-multiplier (of this project)
    A small deviation from the limit cycle of a drag axis without delay is multiplied by
    [m = (1 + mu - d_1)(1 - mu - d_2)/((1 - mu + d_1)(1 + mu + d_2))] in each period, and [1 - m > 0.48 (d_1 + d_2)]; [mu = delta/C], [d_1] and [d_2]
    the drag forces at the upper and the lower switching over C. Any mix of linear and quadratic drag. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Phase Return Switching Cycle.
Open Scope R_scope.

Definition numerator (mu d_1 d_2 : R) : R := (1 + mu - d_1) * (1 - mu - d_2).
Definition denominator (mu d_1 d_2 : R) : R := (1 - mu + d_1) * (1 + mu + d_2).
Definition multiplier (mu d_1 d_2 : R) : R := numerator mu d_1 d_2 / denominator mu d_1 d_2.

(** * The slope of a function given by an equation *)

Lemma implicit_derive (f k p : R -> R) V l q : continuity_pt k V -> (exists d, 0 < d /\ forall W, Rabs (W - V) < d -> f (k W) = p W) ->
  is_derive f (k V) l -> l <> 0 -> is_derive p V q -> is_derive k V (q / l).
Proof.
  intros Ck [d [Pd Eq]] Df l0 Dp. apply is_derive_Reals in Df. apply is_derive_Reals in Dp. apply is_derive_Reals. intros eps Eps.
  assert (L : 0 < Rabs l) by (apply Rabs_pos_lt, l0). pose proof (Rabs_pos q) as Q0.
  set (eta := Rmin (Rabs l / 2) (eps * (Rabs l * Rabs l) / (4 * (Rabs l + Rabs q)))).
  assert (Eta : 0 < eta) by (apply Rmin_pos; [lra|apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat; nra|lra]]).
  assert (E1 : eta <= Rabs l / 2) by apply Rmin_l. assert (E2 : eta * (4 * (Rabs l + Rabs q)) <= eps * (Rabs l * Rabs l)).
  { apply Rle_trans with (eps * (Rabs l * Rabs l) / (4 * (Rabs l + Rabs q)) * (4 * (Rabs l + Rabs q))); [apply Rmult_le_compat_r; [lra|apply Rmin_r]|].
    right. field. lra. }
  destruct (Df eta Eta) as [d1 N1]. destruct (Dp eta Eta) as [d2 N2]. pose proof (cond_pos d1). pose proof (cond_pos d2).
  destruct (stays_above k V (k V - d1) Ck ltac:(lra)) as [d3 [P3 N3]]. destruct (stays_below k V (k V + d1) Ck ltac:(lra)) as [d4 [P4 N4]].
  assert (P : 0 < Rmin (Rmin d d2) (Rmin d3 d4)) by (repeat apply Rmin_pos; assumption). exists (mkposreal _ P). intros h h0 Hh. simpl in Hh.
  assert (H1 : Rabs h < d /\ Rabs h < d2 /\ Rabs h < d3 /\ Rabs h < d4).
  { pose proof (Rmin_l (Rmin d d2) (Rmin d3 d4)). pose proof (Rmin_r (Rmin d d2) (Rmin d3 d4)). pose proof (Rmin_l d d2). pose proof (Rmin_r d d2).
    pose proof (Rmin_l d3 d4). pose proof (Rmin_r d3 d4). lra. }
  destruct H1 as [A1 [A2 [A3 A4]]]. assert (S : V + h - V = h) by ring.
  specialize (N3 (V + h)). specialize (N4 (V + h)). rewrite S in N3, N4. specialize (N3 A3). specialize (N4 A4).
  assert (Ep := Eq (V + h)). rewrite S in Ep. specialize (Ep A1). assert (E0 := Eq V). rewrite Rminus_diag_eq, Rabs_R0 in E0 by ring. specialize (E0 Pd).
  specialize (N2 h h0 A2). set (w := k (V + h) - k V) in *.
  (* w (l + a) = h (q + b), a and b small *)
  assert (Aex : exists a, Rabs a < eta /\ f (k (V + h)) - f (k V) = w * (l + a)).
  { destruct (Req_dec w 0) as [W|W].
    - exists 0. rewrite Rabs_R0. split; [exact Eta|]. replace (k (V + h)) with (k V) by (unfold w in W; lra). rewrite W. ring.
    - exists ((f (k V + w) - f (k V)) / w - l). split; [apply N1; [exact W|apply Rabs_def1; unfold w; lra]|].
      replace (k V + w) with (k (V + h)) by (unfold w; ring). field. exact W. }
  destruct Aex as [a [Na Ea]]. set (b := (p (V + h) - p V) / h - q) in *.
  assert (Eb : p (V + h) - p V = h * (q + b)) by (unfold b; field; exact h0).
  assert (La : Rabs l / 2 <= Rabs (l + a)) by (pose proof (Rabs_triang_inv l (- a)) as T; rewrite Rabs_Ropp in T; unfold Rminus in T; rewrite Ropp_involutive in T; lra).
  assert (la0 : l + a <> 0) by (intros Z; rewrite Z, Rabs_R0 in La; lra).
  assert (Wh : w / h = (q + b) / (l + a)).
  { apply (Rmult_eq_reg_r (h * (l + a))); [|apply Rmult_integral_contrapositive_currified; assumption].
    replace (w / h * (h * (l + a))) with (w * (l + a)) by (field; exact h0). rewrite <- Ea, Ep, E0, Eb. field. exact la0. }
  rewrite Wh. replace ((q + b) / (l + a) - q / l) with ((b * l - q * a) / (l * (l + a))) by (field; split; assumption).
  unfold Rdiv. rewrite Rabs_mult, Rabs_inv, Rabs_mult.
  assert (Num : Rabs (b * l - q * a) <= eta * (Rabs l + Rabs q)).
  { apply Rle_trans with (Rabs (b * l) + Rabs (- (q * a))); [apply Rabs_triang|]. rewrite Rabs_Ropp, !Rabs_mult. pose proof (Rabs_pos a). pose proof (Rabs_pos b). nra. }
  apply (Rmult_lt_reg_r (Rabs l * Rabs (l + a))); [nra|]. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by nra.
  apply Rle_lt_trans with (1 := Num).
  assert (eps * (Rabs l * (Rabs l / 2)) <= eps * (Rabs l * Rabs (l + a))) by (apply Rmult_le_compat_l; [lra|apply Rmult_le_compat_l; lra]).
  assert (0 < eps * (Rabs l * Rabs l)) by (apply Rmult_lt_0_compat; nra). lra.
Qed.

(** * One half *)

Section Half.
Variables alpha beta_1 beta_2 c x_a A B : R.
Hypotheses (Ha : 0 < alpha) (Hb1 : 0 <= beta_1) (Hb2 : 0 <= beta_2) (Hc : 0 < c).
Hypotheses (A0 : 0 < A) (HAB : half alpha beta_1 beta_2 c x_a A B).
Local Notation turn := (half alpha beta_1 beta_2 c x_a).

Variable next : R -> R.
Hypothesis Hnext : forall V, 0 <= V -> turn V (next V).

Lemma next_is : next A = B.
Proof. exact (half_unique alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc x_a A _ _ (Hnext A (Rlt_le _ _ A0)) HAB). Qed.

Lemma next_continuous : continuity_pt next A.
Proof.
  pose proof HAB as [_ [B0 _]]. intros eps Eps. set (d := Rmin (Rmin 1 A) (eps * B / (2 * A + 1))).
  assert (D1 : d <= 1) by (apply Rle_trans with (1 := Rmin_l _ _), Rmin_l). assert (D2 : d <= A) by (apply Rle_trans with (1 := Rmin_l _ _), Rmin_r).
  assert (D3 : d * (2 * A + 1) <= eps * B).
  { apply Rle_trans with (eps * B / (2 * A + 1) * (2 * A + 1)); [apply Rmult_le_compat_r; [lra|apply Rmin_r]|right; field; lra]. }
  exists d. split; [repeat apply Rmin_pos; try lra; apply Rdiv_lt_0_compat; nra|]. intros V [_ HV].
  change (Rabs (V - A) < d) in HV. change (Rabs (next V - next A) < eps). rewrite next_is. pose proof (Rabs_def2 _ _ HV).
  pose proof (Hnext V ltac:(lra)) as T. pose proof T as [_ [N0 _]].
  pose proof (half_nears alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc x_a 0 V (next V) A B T HAB ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as N.
  rewrite Ropp_0, force_at_rest in N.
  assert (N' : Rabs (next V ^ 2 - B ^ 2) <= Rabs (V ^ 2 - A ^ 2)) by (apply (Rmult_le_reg_r c); lra).
  replace (next V ^ 2 - B ^ 2) with ((next V - B) * (next V + B)) in N' by ring. replace (V ^ 2 - A ^ 2) with ((V - A) * (V + A)) in N' by ring.
  rewrite !Rabs_mult, (Rabs_pos_eq (next V + B)), (Rabs_pos_eq (V + A)) in N' by lra.
  pose proof (Rabs_pos (V - A)). pose proof (Rabs_pos (next V - B)).
  apply (Rmult_lt_reg_r B); [exact B0|]. nra.
Qed.

(** The slope of the half map, by energy along the half. *)
Lemma next_derive : is_derive next A (A * force beta_1 beta_2 c (- B) / (B * force beta_1 beta_2 c A)).
Proof.
  pose proof HAB as [_ [B0 [FB _]]]. pose proof (force_of_speed beta_1 beta_2 c Hb1 Hb2 A (Rlt_le _ _ A0)) as FA.
  replace (A * force beta_1 beta_2 c (- B) / (B * force beta_1 beta_2 c A))
    with (alpha * A / force beta_1 beta_2 c A / (alpha * B / force beta_1 beta_2 c (- B))) by (field; repeat split; lra).
  apply (implicit_derive (fun w => way alpha beta_1 beta_2 c (- w)) next (fun V => way alpha beta_1 beta_2 c V + 2 * x_a)).
  - exact next_continuous.
  - exists A. split; [exact A0|]. intros W HW. apply Rabs_def2 in HW. apply (Hnext W ltac:(lra)).
  - rewrite next_is. assert (Dm : is_derive (fun w => - w) B (-1)) by (auto_derive; [trivial|ring]).
    pose proof (is_derive_comp (way alpha beta_1 beta_2 c) (fun w => - w) B _ _ (way_derive alpha beta_1 beta_2 c Hb1 Hb2 Hc (- B) FB) Dm) as D.
    revert D. unfold scal; simpl; unfold mult; simpl. intros D. match type of D with is_derive _ _ ?l => replace (alpha * B / force beta_1 beta_2 c (- B)) with l by (field; lra) end. exact D.
  - apply Rgt_not_eq, Rdiv_lt_0_compat; nra.
  - pose proof (is_derive_plus (way alpha beta_1 beta_2 c) (fun _ => 2 * x_a) A _ _ (way_derive alpha beta_1 beta_2 c Hb1 Hb2 Hc A ltac:(lra)) (is_derive_const (2 * x_a) A)) as D.
    revert D. unfold plus, zero; simpl. rewrite Rplus_0_r. trivial.
Qed.
End Half.

(** * The claim *)

Theorem statement : forall alpha beta_1 beta_2 delta C x_a : R, 0 < alpha -> 0 <= beta_1 -> 0 <= beta_2 -> 0 < beta_1 + beta_2 -> 0 < x_a ->
  (* the hypothesis disturbance-below-level *)
  Rabs delta < C ->
  let down := half alpha beta_1 beta_2 (C - delta) x_a in let up := half alpha beta_1 beta_2 (C - - delta) x_a in
  (* the speeds of the one cycle at the levels *)
  exists P Q, down P Q /\ up Q P /\ 0 < P /\
  let mu := delta / C in let d_1 := drag beta_1 beta_2 P / C in let d_2 := drag beta_1 beta_2 Q / C in
  (* the slope there of the return map, which takes each speed at the upper level to the next *)
  (forall return_map, (forall V, 0 <= V -> exists V', down V V' /\ up V' (return_map V)) -> is_derive return_map P (multiplier mu d_1 d_2)) /\
  (* the excess grows with either drag force at the rate 2 *)
  denominator mu d_1 d_2 - numerator mu d_1 d_2 = 2 * (d_1 + d_2) /\
  0 < multiplier mu d_1 d_2 /\ 1 - multiplier mu d_1 d_2 > 12 / 25 * (d_1 + d_2) /\ 1 - multiplier mu d_1 d_2 >= 1 / 2 * (d_1 + d_2).
Proof.
  intros alpha beta_1 beta_2 delta C x_a Ha Hb1 Hb2 Hb Hx D down up. pose proof (Rabs_def2 _ _ D) as [D1 D2]. pose proof (Rabs_pos delta) as D0.
  assert (C0 : 0 < C) by lra. assert (C1 : 0 < C - delta) by lra. assert (C2 : 0 < C - - delta) by lra.
  destruct (fixed_pair alpha beta_1 beta_2 (C - delta) (C - - delta) x_a Ha Hb1 Hb2 Hb C1 C2 Hx) as [P [Q [HQ HP]]].
  pose proof HQ as [_ [Q0 [FQ _]]]. pose proof HP as [_ [P0 [FP _]]].
  exists P, Q. split; [exact HQ|]. split; [exact HP|]. split; [exact P0|]. intros mu d_1 d_2.
  assert (S1 : drag beta_1 beta_2 P = C * d_1) by (unfold d_1; field; lra). assert (S2 : drag beta_1 beta_2 Q = C * d_2) by (unfold d_2; field; lra).
  assert (S3 : delta = C * mu) by (unfold mu; field; lra).
  assert (E1 : 0 < d_1) by (apply Rdiv_lt_0_compat; [apply drag_pos; assumption|exact C0]).
  assert (E2 : 0 < d_2) by (apply Rdiv_lt_0_compat; [apply drag_pos; assumption|exact C0]).
  assert (F1 : force beta_1 beta_2 (C - delta) P = C * (1 - mu + d_1)) by (unfold force; rewrite S1, S3; ring).
  assert (F2 : force beta_1 beta_2 (C - delta) (- Q) = C * (1 - mu - d_2)) by (unfold force; rewrite drag_odd, S2, S3; ring).
  assert (F3 : force beta_1 beta_2 (C - - delta) Q = C * (1 + mu + d_2)) by (unfold force; rewrite S2, S3; ring).
  assert (F4 : force beta_1 beta_2 (C - - delta) (- P) = C * (1 + mu - d_1)) by (unfold force; rewrite drag_odd, S1, S3; ring).
  rewrite F2 in FQ. rewrite F4 in FP.
  assert (G2 : 0 < 1 - mu - d_2) by nra. assert (G4 : 0 < 1 + mu - d_1) by nra.
  assert (Den : 0 < denominator mu d_1 d_2 <= 4).
  { unfold denominator. assert (0 < 1 - mu + d_1 <= 2) by lra. assert (0 < 1 + mu + d_2 <= 2) by lra. split; nra. }
  assert (Ex : denominator mu d_1 d_2 - numerator mu d_1 d_2 = 2 * (d_1 + d_2)) by (unfold denominator, numerator; ring).
  assert (Rate : 1 - multiplier mu d_1 d_2 = 2 * (d_1 + d_2) / denominator mu d_1 d_2) by (rewrite <- Ex; unfold multiplier; field; lra).
  assert (Half : 1 / 2 * (d_1 + d_2) <= 1 - multiplier mu d_1 d_2).
  { rewrite Rate. apply (Rmult_le_reg_r (denominator mu d_1 d_2)); [lra|].
    replace (2 * (d_1 + d_2) / denominator mu d_1 d_2 * denominator mu d_1 d_2) with (2 * (d_1 + d_2)) by (field; lra). nra. }
  split; [|split; [exact Ex|split; [|split; lra]]].
  - intros return_map HR.
    set (next_1 := fun V => proj1_sig (half_exists alpha beta_1 beta_2 (C - delta) Ha Hb1 Hb2 C1 x_a (Rabs V) Hx (Rabs_pos V))).
    set (next_2 := fun V => proj1_sig (half_exists alpha beta_1 beta_2 (C - - delta) Ha Hb1 Hb2 C2 x_a (Rabs V) Hx (Rabs_pos V))).
    assert (N1 : forall V, 0 <= V -> down V (next_1 V)).
    { intros V HV. unfold next_1. destruct (half_exists _ _ _ _ _ _ _ _ _ _ _ _) as [V' H']. simpl. rewrite Rabs_pos_eq in H' by exact HV. exact H'. }
    assert (N2 : forall V, 0 <= V -> up V (next_2 V)).
    { intros V HV. unfold next_2. destruct (half_exists _ _ _ _ _ _ _ _ _ _ _ _) as [V' H']. simpl. rewrite Rabs_pos_eq in H' by exact HV. exact H'. }
    pose proof (next_derive alpha beta_1 beta_2 (C - delta) x_a P Q Ha Hb1 Hb2 C1 P0 HQ next_1 N1) as D3.
    pose proof (next_derive alpha beta_1 beta_2 (C - - delta) x_a Q P Ha Hb1 Hb2 C2 Q0 HP next_2 N2) as D4.
    pose proof (next_is alpha beta_1 beta_2 (C - delta) x_a P Q Ha Hb1 Hb2 C1 P0 HQ next_1 N1) as E3. rewrite <- E3 in D4 at 1.
    pose proof (is_derive_comp next_2 next_1 P _ _ D4 D3) as D5.
    apply (is_derive_ext_loc (fun V => next_2 (next_1 V))).
    + exists (mkposreal P P0). intros V HV. change (Rabs (V - P) < P) in HV. apply Rabs_def2 in HV. destruct (HR V ltac:(lra)) as [V' [H1 H2]].
      rewrite (half_unique alpha beta_1 beta_2 (C - delta) Ha Hb1 Hb2 C1 x_a V _ _ (N1 V ltac:(lra)) H1).
      pose proof H1 as [_ [V0' _]].
      exact (half_unique alpha beta_1 beta_2 (C - - delta) Ha Hb1 Hb2 C2 x_a V' _ _ (N2 V' ltac:(lra)) H2).
    + rewrite F1, F2, F3, F4 in D5. revert D5. unfold scal; simpl; unfold mult; simpl. intros D5.
      match type of D5 with is_derive _ _ ?l => replace (multiplier mu d_1 d_2) with l end; [exact D5|].
      unfold multiplier, numerator, denominator. field. repeat split; lra.
  - unfold multiplier. apply Rdiv_lt_0_compat; [unfold numerator; apply Rmult_lt_0_compat; assumption|lra].
Qed.

(** At the level and above, one command no longer turns the axis: a motion never comes back. *)
Theorem needs_disturbance_below_level : forall alpha beta_1 beta_2 C x_a delta : R, 0 < alpha -> 0 <= beta_1 -> 0 <= beta_2 -> 0 < beta_1 + beta_2 -> 0 < x_a ->
  C <= delta -> exists x v u, relay_loop alpha beta_1 beta_2 delta C x_a x v u /\ forall t, 0 < t -> x_a < x t.
Proof. intros. apply drifts_away; assumption. Qed.

Print Assumptions statement.
