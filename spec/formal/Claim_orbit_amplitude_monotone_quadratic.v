(** claim: orbit-amplitude-monotone-quadratic (of this project)
    With quadratic drag the relative overshoot [(X_m - x_a)/x_a = ln(1 + y)/(2 g)], [y = sqrt(1 - exp(-4 g))], falls as g grows:
    amplitude and half-width determine g, and with the period alpha and beta. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Hyperbolic Claim_orbit_quadratic.
Open Scope R_scope.

Definition overshoot (g : R) : R := ln (1 + y g) / (2 * g).

(** With [y = tanh t] it is [ln(1 + tanh t)/ln(cosh t)]; of both, zero at zero, the quotient of the slopes is [(1 - y)/y]: it falls. *)
Definition half_log (t : R) : R := - (ln (1 - tanh t * tanh t) / 2).

Lemma unrolled_falls s t : 0 < s -> s < t -> ln (1 + tanh t) / half_log t < ln (1 + tanh s) / half_log s.
Proof.
  apply (ratio_falls (fun t => ln (1 + tanh t)) half_log (fun t => 1 - tanh t) tanh).
  - rewrite tanh_0, Rplus_0_r. apply ln_1.
  - unfold half_log. rewrite tanh_0, Rmult_0_l, Rminus_0_r, ln_1. field.
  - intros x Hx. assert (T0 : 0 <= tanh x) by (destruct Hx as [Hx| <-]; [pose proof (tanh_range x Hx); lra|rewrite tanh_0; lra]).
    assert (D : is_derive (fun t => ln (1 + t)) (tanh x) (/ (1 + tanh x))) by (auto_derive; [lra|field; lra]).
    pose proof (is_derive_comp (fun t => ln (1 + t)) tanh x _ _ D (tanh_derive x)) as E.
    replace (1 - tanh x) with (scal (1 - tanh x * tanh x) (/ (1 + tanh x))) by (unfold scal; simpl; unfold mult; simpl; field; lra). exact E.
  - intros x Hx. assert (T0 : 0 <= tanh x) by (destruct Hx as [Hx| <-]; [pose proof (tanh_range x Hx); lra|rewrite tanh_0; lra]).
    pose proof (tanh_below_one x) as T1. assert (Q : 0 < 1 - tanh x * tanh x) by nra.
    assert (D : is_derive (fun t => - (ln (1 - t * t) / 2)) (tanh x) (tanh x / (1 - tanh x * tanh x))) by (auto_derive; [exact Q|field; lra]).
    pose proof (is_derive_comp (fun t => - (ln (1 - t * t) / 2)) tanh x _ _ D (tanh_derive x)) as E.
    match type of E with is_derive _ _ ?l => replace l with (tanh x) in E by (unfold scal; simpl; unfold mult; simpl; field; lra) end. exact E.
  - intros x Hx. apply (tanh_range x Hx).
  - intros u w Hu uw. pose proof (tanh_range u Hu). pose proof (tanh_range w ltac:(lra)). pose proof (tanh_increases u w uw).
    replace ((1 - tanh w) / tanh w) with (/ tanh w - 1) by (field; lra). replace ((1 - tanh u) / tanh u) with (/ tanh u - 1) by (field; lra).
    assert (/ tanh w < / tanh u); [|lra]. apply Rinv_lt_contravar; [nra|assumption].
Qed.

Lemma unroll h : 0 < h -> 0 < atanh (y h) /\ tanh (atanh (y h)) = y h /\ half_log (atanh (y h)) = 2 * h.
Proof.
  intros H. destruct (y_range h H) as [Y YY]. assert (E : tanh (atanh (y h)) = y h) by (apply tanh_atanh; lra).
  split; [apply atanh_positive, Y|]. split; [exact E|]. unfold half_log. rewrite E, YY.
  replace (1 - (1 - exp (- (4 * h)))) with (exp (- (4 * h))) by ring. rewrite ln_exp. field.
Qed.

Lemma y_grows g h : 0 < g -> g < h -> y g < y h.
Proof.
  intros G gh. unfold y. assert (exp (- (4 * h)) < exp (- (4 * g))) by (apply exp_increasing; lra).
  assert (exp (- (4 * g)) < 1) by (rewrite <- exp_0; apply exp_increasing; lra). apply sqrt_lt_1; lra.
Qed.

Lemma overshoot_falls g h : 0 < g -> g < h -> overshoot h < overshoot g.
Proof.
  intros G gh. destruct (unroll g G) as [T0 [T1 T2]]. destruct (unroll h ltac:(lra)) as [S0 [S1 S2]]. unfold overshoot.
  rewrite <- T2, <- S2, <- T1, <- S1 at 1. rewrite S1, T1. rewrite <- T1, <- S1.
  assert (L : atanh (y g) < atanh (y h)).
  { pose proof (y_grows g h G gh). destruct (Rlt_le_dec (atanh (y g)) (atanh (y h))) as [Q|[Q|Q]]; [exact Q|exfalso|exfalso].
    - apply tanh_increases in Q. lra.
    - rewrite Q in S1. lra. }
  pose proof (unrolled_falls _ _ T0 L) as U. rewrite T1, S1, T2, S2 in *. exact U.
Qed.

Theorem statement : forall alpha beta C x_a alpha' beta' : R,
  0 < alpha -> 0 < beta -> 0 < C -> 0 < x_a -> 0 < alpha' -> 0 < beta' ->
  let h := g alpha beta x_a in let h' := g alpha' beta' x_a in
  (* the relative overshoot of the orbit *)
  (X_m alpha beta x_a (y h) - x_a) / x_a = overshoot h /\
  (* falls as g grows, whatever it grows by *)
  (forall a b, 0 < a -> a < b -> overshoot b < overshoot a) /\
  (* so amplitude, half-width, period and level determine inertia and drag *)
  (X_m alpha beta x_a (y h) = X_m alpha' beta' x_a (y h') -> T alpha beta C (y h) = T alpha' beta' C (y h') -> alpha' = alpha /\ beta' = beta).
Proof.
  intros alpha beta C x_a alpha' beta' Ha Hb HC Hx Ha' Hb' h h'.
  assert (O : forall alpha beta, 0 < alpha -> 0 < beta -> 0 < g alpha beta x_a /\
            (X_m alpha beta x_a (y (g alpha beta x_a)) - x_a) / x_a = overshoot (g alpha beta x_a)).
  { clear - Hx. intros alpha beta Ha Hb. split; [unfold g; apply Rdiv_lt_0_compat; nra|].
    unfold overshoot, X_m. set (L := ln _). unfold g. field. repeat split; lra. }
  destruct (O alpha beta Ha Hb) as [G1 O1]. destruct (O alpha' beta' Ha' Hb') as [G2 O2]. fold h in G1, O1. fold h' in G2, O2.
  split; [exact O1|]. split; [exact overshoot_falls|]. intros EX ET.
  rewrite EX, O2 in O1.
  assert (Z : h' = h).
  { destruct (Rtotal_order h' h) as [L|[L|L]]; [|exact L|]; [pose proof (overshoot_falls h' h G2 L)|pose proof (overshoot_falls h h' G1 L)]; lra. }
  rewrite Z in ET.
  (* g gives beta/alpha, the period alpha/sqrt(beta) *)
  assert (R1 : beta' * alpha = beta * alpha').
  { unfold h, h', g in Z. apply (Rmult_eq_reg_r x_a); [|lra].
    replace (beta' * alpha * x_a) with (beta' * x_a / alpha' * (alpha * alpha')) by (field; lra). rewrite Z. field. lra. }
  destruct (y_range h G1) as [[Y0 Y1] _]. set (Y := atan (sqrt (y h)) + atanh (sqrt (y h))) in *.
  assert (S0 : 0 < sqrt (y h)) by (apply sqrt_lt_R0, Y0).
  assert (S1 : sqrt (y h) < 1) by (rewrite <- sqrt_1; apply sqrt_lt_1; lra).
  assert (PY : 0 < Y).
  { unfold Y. pose proof (atanh_positive (sqrt (y h)) ltac:(lra)). pose proof (atan_increasing 0 (sqrt (y h)) S0) as A. rewrite atan_0 in A. lra. }
  assert (B1 : 0 < sqrt (beta * C)) by (apply sqrt_lt_R0; nra). assert (B2 : 0 < sqrt (beta' * C)) by (apply sqrt_lt_R0; nra).
  assert (Q1 : sqrt (beta * C) * sqrt (beta * C) = beta * C) by (apply sqrt_sqrt; nra).
  assert (Q2 : sqrt (beta' * C) * sqrt (beta' * C) = beta' * C) by (apply sqrt_sqrt; nra).
  assert (R2 : alpha * sqrt (beta' * C) = alpha' * sqrt (beta * C)).
  { unfold T in ET. fold Y in ET. apply (Rmult_eq_reg_r (2 * Y)); [|lra].
    replace (alpha * sqrt (beta' * C) * (2 * Y)) with (2 * (alpha / sqrt (beta * C)) * Y * (sqrt (beta * C) * sqrt (beta' * C))) by (field; lra).
    rewrite ET. field. lra. }
  assert (R3 : alpha * alpha * beta' = alpha' * alpha' * beta).
  { apply (Rmult_eq_reg_r C); [|lra].
    replace (alpha * alpha * beta' * C) with ((alpha * sqrt (beta' * C)) * (alpha * sqrt (beta' * C))) by
      (transitivity (alpha * alpha * (sqrt (beta' * C) * sqrt (beta' * C))); [ring|rewrite Q2; ring]).
    rewrite R2. transitivity (alpha' * alpha' * (sqrt (beta * C) * sqrt (beta * C))); [ring|rewrite Q1; ring]. }
  assert (A : alpha' = alpha).
  { apply (Rmult_eq_reg_l (alpha' * beta)); [|nra]. replace (alpha' * beta * alpha) with (alpha * (beta * alpha')) by ring. rewrite <- R1. nra. }
  split; [exact A|]. subst alpha'. apply (Rmult_eq_reg_r alpha); lra.
Qed.

Print Assumptions statement.
