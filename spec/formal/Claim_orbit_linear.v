(** claim: orbit-linear (of this project)
    The axis [alpha v' + beta v = u] under a relay [+-C] with hysteresis [x_a] has exactly one limit cycle whatever the four positive
    numbers, and every start reaches it. With [g = x_a beta^2/(C alpha)] and [z - tanh z = g]: [T = 4 alpha z/beta],
    [X_m = x_a + (C alpha/beta^2)(tanh z - ln(1 + tanh z))]. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Phase Cycle Hyperbolic.
Open Scope R_scope.

Definition g (alpha beta C x_a : R) : R := x_a * beta ^ 2 / (C * alpha).
Definition T (alpha beta z : R) : R := 4 * alpha * z / beta.
Definition X_m (alpha beta C x_a z : R) : R := x_a + C * alpha / beta ^ 2 * (tanh z - ln (1 + tanh z)).

(** * The root *)

(** Its left side increases from zero without bound: one root. *)
Lemma root_increases a b : 0 <= a -> a < b -> a - tanh a < b - tanh b.
Proof.
  intros A ab. apply (increases (fun z => z - tanh z) (fun z => tanh z * tanh z)); [exact ab| | |]; intros z Hz.
  - apply excess_derive.
  - apply (continuity_of_derive _ _ _ (excess_derive z)).
  - pose proof (tanh_range z ltac:(lra)). nra.
Qed.

Lemma root h : 0 < h -> exists z, 0 < z /\ z - tanh z = h /\ forall y, 0 < y -> y - tanh y = h -> y = z.
Proof.
  intros H. pose proof tanh_0 as T0.
  destruct (IVT_gen (fun z => z - tanh z) 0 (h + 1) h) as [z [Hz Ez]].
  - intros x. apply (continuity_of_derive _ _ _ (excess_derive x)).
  - cbv beta. rewrite T0. pose proof (tanh_below_one (h + 1)). rewrite Rmin_left, Rmax_right by lra. lra.
  - rewrite Rmin_left, Rmax_right in Hz by lra. exists z.
    assert (Z : 0 < z) by (destruct (proj1 Hz) as [L|<-]; [exact L|rewrite T0 in Ez; lra]).
    split; [exact Z|]. split; [exact Ez|]. intros y Y Ey.
    destruct (Rtotal_order y z) as [L|[L|L]]; [|exact L|].
    + pose proof (root_increases y z ltac:(lra) L). lra.
    + pose proof (root_increases z y ltac:(lra) L). lra.
Qed.

(** * The two integrals *)

Section Axis.
Variables alpha beta C : R.
Hypotheses (Ha : 0 < alpha) (Hb : 0 < beta) (HC : 0 < C).

Lemma force_is v : force beta 0 C v = C + beta * v.
Proof. unfold force, drag. ring. Qed.

Lemma inside s v : 0 < force beta 0 C v -> Rmin 0 v <= s -> 0 < C + beta * s.
Proof.
  intros P L. rewrite <- force_is. pose proof (force_le beta 0 C (Rlt_le _ _ Hb) (Rle_refl 0) (Rmin 0 v) s L) as F.
  unfold Rmin in *. destruct (Rle_dec 0 v); [rewrite force_at_rest in F|]; lra.
Qed.

Lemma way_linear v : 0 < force beta 0 C v -> way alpha beta 0 C v = alpha / beta * (v - C / beta * ln (1 + beta * v / C)).
Proof.
  intros P.
  assert (D : forall s, Rmin 0 v <= s -> is_derive (fun v => alpha / beta * (v - C / beta * ln (1 + beta * v / C))) s (alpha * s / force beta 0 C s)).
  { intros s Hs. pose proof (inside s v P Hs) as I. rewrite force_is.
    assert (Z : 0 < 1 + beta * s / C) by (replace (1 + beta * s / C) with ((C + beta * s) / C) by (field; lra); apply Rdiv_lt_0_compat; lra).
    auto_derive; [lra|]. field. repeat split; lra. }
  apply (way_is alpha beta 0 C (Rlt_le _ _ Hb) (Rle_refl 0) HC (fun v => alpha / beta * (v - C / beta * ln (1 + beta * v / C))) v); [exact P| | |].
  - replace (1 + beta * 0 / C) with 1 by (field; lra). rewrite ln_1. ring.
  - intros s Hs. apply D. lra.
  - intros s Hs. apply (continuity_of_derive _ s _ (D s (proj1 Hs))).
Qed.

Lemma time_linear v : 0 < force beta 0 C v -> time alpha beta 0 C v = alpha / beta * ln (1 + beta * v / C).
Proof.
  intros P.
  assert (D : forall s, Rmin 0 v <= s -> is_derive (fun v => alpha / beta * ln (1 + beta * v / C)) s (alpha / force beta 0 C s)).
  { intros s Hs. pose proof (inside s v P Hs) as I. rewrite force_is.
    assert (Z : 0 < 1 + beta * s / C) by (replace (1 + beta * s / C) with ((C + beta * s) / C) by (field; lra); apply Rdiv_lt_0_compat; lra).
    auto_derive; [lra|]. field. repeat split; lra. }
  apply (time_is alpha beta 0 C (Rlt_le _ _ Hb) (Rle_refl 0) HC (fun v => alpha / beta * ln (1 + beta * v / C)) v); [exact P| | |].
  - replace (1 + beta * 0 / C) with 1 by (field; lra). rewrite ln_1. ring.
  - intros s Hs. apply D. lra.
  - intros s Hs. apply (continuity_of_derive _ s _ (D s (proj1 Hs))).
Qed.

(** The speed at the levels is the share [tanh z] of the terminal one. *)
Section Root.
Variables x_a z : R.
Hypotheses (Hz : 0 < z) (Ez : z - tanh z = g alpha beta C x_a).
Let P := C / beta * tanh z.

Lemma pushed : 0 < force beta 0 C P /\ 0 < force beta 0 C (- P).
Proof.
  pose proof (tanh_range z Hz) as [T0 T1]. rewrite !force_is. unfold P.
  replace (C + beta * (C / beta * tanh z)) with (C * (1 + tanh z)) by (field; lra).
  replace (C + beta * - (C / beta * tanh z)) with (C * (1 - tanh z)) by (field; lra).
  split; apply Rmult_lt_0_compat; lra.
Qed.

Lemma up_share : 1 + beta * P / C = 1 + tanh z.
Proof. unfold P. field. lra. Qed.
Lemma down_share : 1 + beta * - P / C = 1 - tanh z.
Proof. unfold P. field. lra. Qed.

Lemma half_linear : half alpha beta 0 C x_a P P.
Proof.
  pose proof pushed as [F1 F2]. pose proof (tanh_range z Hz) as [T0 T1]. pose proof (atanh_tanh z Hz) as A.
  assert (P0 : 0 < P) by (apply Rmult_lt_0_compat; [apply Rdiv_lt_0_compat; lra|lra]).
  unfold half. split; [lra|]. split; [exact P0|]. split; [exact F2|]. rewrite !way_linear, up_share, down_share by assumption.
  assert (X : x_a = C * alpha / beta ^ 2 * (z - tanh z)) by (rewrite Ez; unfold g; field; lra).
  rewrite X. replace (ln (1 - tanh z)) with (ln (1 + tanh z) - 2 * z) by lra. unfold P. field. lra.
Qed.

Lemma period_linear : 2 * (time alpha beta 0 C P - time alpha beta 0 C (- P)) = T alpha beta z.
Proof.
  pose proof pushed as [F1 F2]. rewrite !time_linear, up_share, down_share by assumption.
  replace (alpha / beta * ln (1 + tanh z) - alpha / beta * ln (1 - tanh z)) with (alpha / beta * (ln (1 + tanh z) - ln (1 - tanh z))) by ring.
  rewrite (atanh_tanh z Hz). unfold T. field. lra.
Qed.

Lemma amplitude_linear : x_a + way alpha beta 0 C P = X_m alpha beta C x_a z.
Proof. pose proof pushed as [F1 F2]. rewrite way_linear, up_share by assumption. unfold X_m, P. field. lra. Qed.
End Root.
End Axis.

(** * The claim *)

Theorem statement : forall alpha beta C x_a : R, 0 < alpha -> 0 < beta -> 0 < C -> 0 < x_a ->
  (* one z *)
  exists z, 0 < z /\ z - tanh z = g alpha beta C x_a /\ (forall y, 0 < y -> y - tanh y = g alpha beta C x_a -> y = z) /\
  (* one limit cycle, which every start reaches, with this period and this amplitude *)
  exists X V U, limit_cycle alpha beta 0 0 C x_a (T alpha beta z) X V U /\
    between (- X_m alpha beta C x_a z) (X_m alpha beta C x_a z) X.
Proof.
  intros alpha beta C x_a Ha Hb HC Hx.
  assert (Hg : 0 < g alpha beta C x_a) by (unfold g; apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat; [lra|nra]|apply Rmult_lt_0_compat; lra]).
  destruct (root _ Hg) as [z [Hz [Ez Uz]]]. exists z. split; [exact Hz|]. split; [exact Ez|]. split; [exact Uz|].
  rewrite <- (period_linear alpha beta C Hb HC z Hz), <- (amplitude_linear alpha beta C Hb HC x_a z Hz).
  apply (symmetric_cycle alpha beta 0 C x_a); try lra. apply half_linear; assumption.
Qed.

(** Without drag the speed at the levels grows for ever; without half-width it falls with every half. *)
Theorem needs_drag_positive : forall alpha C x_a V V', 0 < alpha -> 0 < C -> 0 < x_a -> half alpha 0 0 C x_a V V' ->
  V' ^ 2 = V ^ 2 + 4 * C * x_a / alpha /\ V < V'.
Proof.
  intros alpha C x_a V V' Ha HC Hx H. pose proof (grows_without_drag alpha C x_a V V' Ha HC H) as E. split; [exact E|].
  assert (0 < 4 * C * x_a / alpha) by (apply Rdiv_lt_0_compat; nra). destruct H as [V0 [V1 _]]. nra.
Qed.

Theorem needs_half_width_positive : forall alpha beta C V V', 0 < alpha -> 0 < beta -> 0 < C -> 0 < V -> half alpha beta 0 C 0 V V' -> V' < V.
Proof. intros alpha beta C V V' Ha Hb HC V0 H. apply (dies_without_half_width alpha beta 0 C V V'); lra || assumption. Qed.

Print Assumptions statement.
