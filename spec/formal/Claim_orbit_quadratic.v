(** claim: orbit-quadratic (of this project)
    The axis [alpha v' + beta v abs(v) = u] under a relay [+-C] with hysteresis [x_a] has exactly one limit cycle whatever the four
    positive numbers, and every start reaches it. With [g = beta x_a/alpha], [y = sqrt(1 - exp(-4 g))]:
    [X_m = x_a + (alpha/(2 beta)) ln(1 + y)], [T = 2 (alpha/sqrt(beta C)) [atan sqrt(y) + atanh sqrt(y)]]. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Phase Cycle Hyperbolic.
Open Scope R_scope.

Definition g (alpha beta x_a : R) : R := beta * x_a / alpha.
Definition y (g : R) : R := sqrt (1 - exp (- (4 * g))).
Definition T (alpha beta C y : R) : R := 2 * (alpha / sqrt (beta * C)) * (atan (sqrt y) + atanh (sqrt y)).
Definition X_m (alpha beta x_a y : R) : R := x_a + alpha / (2 * beta) * ln (1 + y).

Lemma y_range h : 0 < h -> 0 < y h < 1 /\ y h * y h = 1 - exp (- (4 * h)).
Proof.
  intros H. assert (E : 0 < exp (- (4 * h)) < 1) by (split; [apply exp_pos|rewrite <- exp_0; apply exp_increasing; lra]).
  unfold y. assert (Q : sqrt (1 - exp (- (4 * h))) * sqrt (1 - exp (- (4 * h))) = 1 - exp (- (4 * h))) by (apply sqrt_sqrt; lra).
  assert (P : 0 < sqrt (1 - exp (- (4 * h)))) by (apply sqrt_lt_R0; lra). split; [split; [exact P|nra]|exact Q].
Qed.

(** * The two integrals, on either side of rest *)

Section Axis.
Variables alpha beta C : R.
Hypotheses (Ha : 0 < alpha) (Hb : 0 < beta) (HC : 0 < C).

(** The terminal speed. *)
Definition k : R := sqrt (C / beta).

Lemma k_is : 0 < k /\ beta * (k * k) = C /\ beta * k = sqrt (beta * C).
Proof.
  assert (Q : 0 < C / beta) by (apply Rdiv_lt_0_compat; lra). assert (K : 0 < k) by (apply sqrt_lt_R0, Q).
  assert (KK : k * k = C / beta) by (apply sqrt_sqrt; lra). assert (E : beta * (k * k) = C) by (rewrite KK; field; lra).
  split; [exact K|]. split; [exact E|]. symmetry. apply sqrt_lem_1; [nra|nra|]. rewrite <- E at 1. ring.
Qed.

Lemma force_up s : 0 <= s -> force 0 beta C s = C + beta * (s * s).
Proof. intros H. unfold force, drag. rewrite Rabs_pos_eq by exact H. ring. Qed.
Lemma force_down s : s <= 0 -> force 0 beta C s = C - beta * (s * s).
Proof. intros H. unfold force, drag. rewrite Rabs_left1 by exact H. ring. Qed.

Lemma way_up v : 0 <= v -> way alpha 0 beta C v = alpha / (2 * beta) * ln (1 + beta * (v * v) / C).
Proof.
  intros V. assert (F : forall s, 0 < 1 + beta * (s * s) / C).
  { intros s. assert (0 <= beta * (s * s) / C) by (apply Rmult_le_pos; [nra|left; apply Rinv_0_lt_compat; exact HC]). lra. }
  assert (D : forall s, 0 <= s -> is_derive (fun v => alpha / (2 * beta) * ln (1 + beta * (v * v) / C)) s (alpha * s / force 0 beta C s)).
  { intros s Hs. rewrite (force_up s Hs). pose proof (F s) as Z. assert (0 < C + beta * (s * s)) by nra. auto_derive; [exact Z|].
    field. repeat split; try lra. }
  apply (way_is alpha 0 beta C (Rle_refl 0) (Rlt_le _ _ Hb) HC (fun v => alpha / (2 * beta) * ln (1 + beta * (v * v) / C)) v).
  - rewrite (force_up v V). nra.
  - replace (1 + beta * (0 * 0) / C) with 1 by (field; lra). rewrite ln_1. ring.
  - intros s Hs. rewrite Rmin_left in Hs by exact V. apply D. lra.
  - intros s Hs. rewrite Rmin_left in Hs by exact V. apply (continuity_of_derive _ s _ (D s (proj1 Hs))).
Qed.

Lemma below_terminal s : s <= 0 -> 0 < force 0 beta C s -> 0 < 1 + s / k /\ 0 < 1 - s / k /\ 0 < 1 - beta * (s * s) / C /\ - k < s.
Proof.
  intros S F. rewrite (force_down s S) in F. destruct k_is as [K [KK _]]. assert (L : - k < s).
  { destruct (Rlt_le_dec (- k) s) as [L|L]; [exact L|exfalso]. assert (k * k <= s * s) by nra. nra. }
  assert (E : 1 + s / k = (k + s) / k) by (field; lra). assert (E' : 1 - s / k = (k - s) / k) by (field; lra).
  assert (E'' : 1 - beta * (s * s) / C = (C - beta * (s * s)) / C) by (field; lra).
  rewrite E, E', E''. repeat split; try exact L; apply Rdiv_lt_0_compat; lra.
Qed.

Lemma pushed_between s v : v <= 0 -> 0 < force 0 beta C v -> Rmin 0 v <= s -> 0 < force 0 beta C s.
Proof.
  intros V F Hs. rewrite Rmin_right in Hs by exact V. pose proof (force_le 0 beta C (Rle_refl 0) (Rlt_le _ _ Hb) v s Hs). lra.
Qed.

Lemma way_down v : v <= 0 -> 0 < force 0 beta C v -> way alpha 0 beta C v = - (alpha / (2 * beta) * ln (1 - beta * (v * v) / C)).
Proof.
  intros V F. assert (D : forall s, s <= 0 -> 0 < force 0 beta C s ->
    is_derive (fun v => - (alpha / (2 * beta) * ln (1 - beta * (v * v) / C))) s (alpha * s / force 0 beta C s)).
  { intros s Hs Fs. destruct (below_terminal s Hs Fs) as [_ [_ [Z _]]]. rewrite (force_down s Hs) in *. auto_derive; [exact Z|].
    field. repeat split; lra. }
  apply (way_is alpha 0 beta C (Rle_refl 0) (Rlt_le _ _ Hb) HC (fun v => - (alpha / (2 * beta) * ln (1 - beta * (v * v) / C))) v); [exact F| | |].
  - replace (1 - beta * (0 * 0) / C) with 1 by (field; lra). rewrite ln_1. ring.
  - intros s Hs. pose proof (pushed_between s v V F ltac:(lra)). rewrite Rmax_left in Hs by exact V. apply D; lra.
  - intros s Hs. pose proof (pushed_between s v V F ltac:(lra)) as Fs. rewrite Rmax_left in Hs by exact V. apply (continuity_of_derive _ s _ (D s (proj2 Hs) Fs)).
Qed.

Lemma time_up v : 0 <= v -> time alpha 0 beta C v = alpha / (beta * k) * atan (v / k).
Proof.
  intros V. destruct k_is as [K [KK _]].
  assert (D : forall s, 0 <= s -> is_derive (fun v => alpha / (beta * k) * atan (v / k)) s (alpha / force 0 beta C s)).
  { intros s Hs. rewrite (force_up s Hs), <- KK. auto_derive; [trivial|]. field. repeat split; try lra; try nra. }
  apply (time_is alpha 0 beta C (Rle_refl 0) (Rlt_le _ _ Hb) HC (fun v => alpha / (beta * k) * atan (v / k)) v).
  - rewrite (force_up v V). nra.
  - replace (0 / k) with 0 by (field; lra). rewrite atan_0. ring.
  - intros s Hs. rewrite Rmin_left in Hs by exact V. apply D. lra.
  - intros s Hs. rewrite Rmin_left in Hs by exact V. apply (continuity_of_derive _ s _ (D s (proj1 Hs))).
Qed.

Lemma time_down v : v <= 0 -> 0 < force 0 beta C v -> time alpha 0 beta C v = - (alpha / (beta * k) * atanh (- v / k)).
Proof.
  intros V F. destruct k_is as [K [KK _]].
  assert (D : forall s, s <= 0 -> 0 < force 0 beta C s ->
    is_derive (fun v => - (alpha / (beta * k) * atanh (- v / k))) s (alpha / force 0 beta C s)).
  { intros s Hs Fs. destruct (below_terminal s Hs Fs) as [Z1 [Z2 [_ L]]]. rewrite (force_down s Hs), <- KK in *. unfold atanh.
    assert (N1 : 0 < 1 + - s / k) by (replace (1 + - s / k) with (1 - s / k) by (field; lra); exact Z2).
    assert (N2 : 0 < 1 - - s / k) by (replace (1 - - s / k) with (1 + s / k) by (field; lra); exact Z1).
    auto_derive.
    - split; [unfold Rdiv in *; lra|]. split; [|trivial]. apply Rdiv_lt_0_compat; assumption.
    - field. repeat split; try lra; nra. }
  apply (time_is alpha 0 beta C (Rle_refl 0) (Rlt_le _ _ Hb) HC (fun v => - (alpha / (beta * k) * atanh (- v / k))) v); [exact F| | |].
  - unfold atanh. replace ((1 + - 0 / k) / (1 - - 0 / k)) with 1 by (field; lra). rewrite ln_1. field. lra.
  - intros s Hs. pose proof (pushed_between s v V F ltac:(lra)). rewrite Rmax_left in Hs by exact V. apply D; lra.
  - intros s Hs. pose proof (pushed_between s v V F ltac:(lra)) as Fs. rewrite Rmax_left in Hs by exact V. apply (continuity_of_derive _ s _ (D s (proj2 Hs) Fs)).
Qed.

(** The speed at the levels is the share [sqrt y] of the terminal one. *)
Section Level.
Variable x_a : R.
Hypothesis Hx : 0 < x_a.
Let h := g alpha beta x_a.
Let P := k * sqrt (y h).

Lemma h_positive : 0 < h.
Proof. unfold h, g. apply Rdiv_lt_0_compat; nra. Qed.

Lemma share : 0 < P /\ P / k = sqrt (y h) /\ beta * (P * P) / C = y h /\ 0 < force 0 beta C (- P).
Proof.
  destruct k_is as [K [KK _]]. destruct (y_range h h_positive) as [[Y0 Y1] _].
  assert (R0 : 0 < sqrt (y h)) by (apply sqrt_lt_R0, Y0). assert (RR : sqrt (y h) * sqrt (y h) = y h) by (apply sqrt_sqrt; lra).
  assert (P0 : 0 < P) by (unfold P; nra). assert (E : beta * (P * P) = C * y h).
  { unfold P. replace (beta * (k * sqrt (y h) * (k * sqrt (y h)))) with (beta * (k * k) * (sqrt (y h) * sqrt (y h))) by ring. rewrite KK, RR. reflexivity. }
  split; [exact P0|]. split; [unfold P; field; lra|]. split; [rewrite E; field; lra|].
  rewrite force_down by lra. replace (beta * (- P * - P)) with (beta * (P * P)) by ring. rewrite E. nra.
Qed.

Lemma half_quadratic : half alpha 0 beta C x_a P P.
Proof.
  destruct share as [P0 [_ [E F]]]. destruct (y_range h h_positive) as [[Y0 Y1] YY].
  unfold half. split; [lra|]. split; [exact P0|]. split; [exact F|].
  rewrite way_down, way_up by (lra || assumption). replace (beta * (- P * - P) / C) with (beta * (P * P) / C) by (f_equal; ring). rewrite E.
  assert (L : ln (1 - y h) + ln (1 + y h) = - (4 * h)).
  { rewrite <- ln_mult by lra. replace ((1 - y h) * (1 + y h)) with (exp (- (4 * h))) by lra. apply ln_exp. }
  replace (ln (1 - y h)) with (- (4 * h) - ln (1 + y h)) by lra. unfold h, g. field. lra.
Qed.

Lemma period_quadratic : 2 * (time alpha 0 beta C P - time alpha 0 beta C (- P)) = T alpha beta C (y h).
Proof.
  destruct share as [P0 [S [_ F]]]. destruct k_is as [K [_ KB]]. rewrite time_up, time_down by (lra || assumption).
  rewrite Ropp_involutive, S, KB. unfold T. ring.
Qed.

Lemma amplitude_quadratic : x_a + way alpha 0 beta C P = X_m alpha beta x_a (y h).
Proof. destruct share as [P0 [_ [E _]]]. rewrite way_up, E by lra. reflexivity. Qed.
End Level.
End Axis.

(** * The claim *)

Theorem statement : forall alpha beta C x_a : R, 0 < alpha -> 0 < beta -> 0 < C -> 0 < x_a ->
  let y := y (g alpha beta x_a) in
  (* one limit cycle, which every start reaches, with this period and this amplitude *)
  exists X V U, limit_cycle alpha 0 beta 0 C x_a (T alpha beta C y) X V U /\
    between (- X_m alpha beta x_a y) (X_m alpha beta x_a y) X.
Proof.
  intros alpha beta C x_a Ha Hb HC Hx. cbv zeta.
  rewrite <- (period_quadratic alpha beta C Ha Hb HC x_a Hx), <- (amplitude_quadratic alpha beta C Ha Hb HC x_a Hx).
  apply (symmetric_cycle alpha 0 beta C x_a); try lra. apply half_quadratic; assumption.
Qed.

(** Without drag the speed at the levels grows for ever; without half-width it falls with every half. *)
Theorem needs_drag_positive : forall alpha C x_a V V', 0 < alpha -> 0 < C -> 0 < x_a -> half alpha 0 0 C x_a V V' ->
  V' ^ 2 = V ^ 2 + 4 * C * x_a / alpha /\ V < V'.
Proof.
  intros alpha C x_a V V' Ha HC Hx H. pose proof (grows_without_drag alpha C x_a V V' Ha HC H) as E. split; [exact E|].
  assert (0 < 4 * C * x_a / alpha) by (apply Rdiv_lt_0_compat; nra). destruct H as [V0 [V1 _]]. nra.
Qed.

Theorem needs_half_width_positive : forall alpha beta C V V', 0 < alpha -> 0 < beta -> 0 < C -> 0 < V -> half alpha 0 beta C 0 V V' -> V' < V.
Proof. intros alpha beta C V V' Ha Hb HC V0 H. apply (dies_without_half_width alpha 0 beta C V V'); lra || assumption. Qed.

Print Assumptions statement.
