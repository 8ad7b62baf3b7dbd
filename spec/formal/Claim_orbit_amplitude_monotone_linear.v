(** claim: orbit-amplitude-monotone-linear (of this project)
    With linear drag the relative overshoot [(X_m - x_a)/x_a = (tanh z - ln(1 + tanh z))/(z - tanh z)] falls as [g = z - tanh z] grows:
    amplitude and half-width determine g, and with the period alpha and beta. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Hyperbolic Claim_orbit_linear.
Open Scope R_scope.

Definition overshoot (z : R) : R := (tanh z - ln (1 + tanh z)) / (z - tanh z).

(** Of numerator and denominator, both zero at zero, the quotient of the slopes is [(1 - t)/t] with [t = tanh z]: it falls. *)
Lemma overshoot_falls z w : 0 < z -> z < w -> overshoot w < overshoot z.
Proof.
  apply (ratio_falls (fun z => tanh z - ln (1 + tanh z)) (fun z => z - tanh z) (fun z => (1 - tanh z) * tanh z) (fun z => tanh z * tanh z)).
  - rewrite tanh_0, Rplus_0_r, ln_1. ring.
  - rewrite tanh_0. ring.
  - intros x Hx. assert (T0 : 0 <= tanh x) by (destruct Hx as [Hx| <-]; [pose proof (tanh_range x Hx); lra|rewrite tanh_0; lra]).
    assert (D : is_derive (fun t => t - ln (1 + t)) (tanh x) (1 - / (1 + tanh x))) by (auto_derive; [lra|field; lra]).
    pose proof (is_derive_comp (fun t => t - ln (1 + t)) tanh x _ _ D (tanh_derive x)) as E.
    replace ((1 - tanh x) * tanh x) with (scal (1 - tanh x * tanh x) (1 - / (1 + tanh x))) by (unfold scal; simpl; unfold mult; simpl; field; lra).
    exact E.
  - intros x _. apply excess_derive.
  - intros x Hx. pose proof (tanh_range x Hx). nra.
  - intros x y Hx xy. pose proof (tanh_range x Hx). pose proof (tanh_range y ltac:(lra)). pose proof (tanh_increases x y xy).
    replace ((1 - tanh y) * tanh y / (tanh y * tanh y)) with (/ tanh y - 1) by (field; lra).
    replace ((1 - tanh x) * tanh x / (tanh x * tanh x)) with (/ tanh x - 1) by (field; lra).
    assert (/ tanh y < / tanh x); [|lra]. apply Rinv_lt_contravar; [nra|assumption].
Qed.

Theorem statement : forall alpha beta C x_a z alpha' beta' C' x_a' z' : R,
  0 < alpha -> 0 < beta -> 0 < C -> 0 < x_a -> 0 < alpha' -> 0 < beta' -> 0 < C' -> 0 < x_a' ->
  0 < z -> z - tanh z = g alpha beta C x_a -> 0 < z' -> z' - tanh z' = g alpha' beta' C' x_a' ->
  (* the relative overshoot of the orbit *)
  (X_m alpha beta C x_a z - x_a) / x_a = overshoot z /\
  (* falls as g grows *)
  (g alpha beta C x_a < g alpha' beta' C' x_a' -> overshoot z' < overshoot z) /\
  (* so amplitude, half-width, period and level determine inertia and drag *)
  (X_m alpha beta C x_a z = X_m alpha' beta' C x_a z' -> T alpha beta z = T alpha' beta' z' -> C' = C -> x_a' = x_a ->
    alpha' = alpha /\ beta' = beta).
Proof.
  intros alpha beta C x_a z alpha' beta' C' x_a' z' Ha Hb HC Hx Ha' Hb' HC' Hx' Hz E Hz' E'.
  assert (grows : forall a b, 0 < a -> 0 < b -> a - tanh a < b - tanh b -> a < b).
  { intros a b A B L. destruct (Rlt_le_dec a b) as [Q|[Q|Q]]; [exact Q| |]; [pose proof (root_increases b a ltac:(lra) Q)|subst]; lra. }
  assert (O : forall alpha beta C x_a z, 0 < alpha -> 0 < beta -> 0 < C -> 0 < x_a -> 0 < z -> z - tanh z = g alpha beta C x_a ->
    (X_m alpha beta C x_a z - x_a) / x_a = overshoot z).
  { clear. intros alpha beta C x_a z Ha Hb HC Hx Hz E. unfold overshoot, X_m. rewrite E. unfold g.
    field. repeat split; lra. }
  split; [apply O; assumption|]. split.
  - intros L. apply overshoot_falls; [exact Hz|]. apply grows; lra.
  - intros EX ET EC Ex. subst C' x_a'. pose proof (O _ _ _ _ _ Ha Hb HC Hx Hz E) as O1. pose proof (O _ _ _ _ _ Ha' Hb' HC Hx Hz' E') as O2.
    rewrite EX, O2 in O1.
    assert (Z : z' = z).
    { destruct (Rtotal_order z' z) as [L|[L|L]]; [|exact L|]; [pose proof (overshoot_falls z' z Hz' L)|pose proof (overshoot_falls z z' Hz L)]; lra. }
    subst z'. rewrite E in E'. unfold g, T in *.
    (* the period gives alpha/beta, g gives beta^2/alpha *)
    assert (R1 : alpha' * beta = alpha * beta').
    { apply (Rmult_eq_reg_l (4 * z)); [|lra].
      replace (4 * z * (alpha * beta')) with (4 * alpha * z / beta * (beta * beta')) by (field; lra). rewrite ET. field. lra. }
    assert (R2 : beta ^ 2 * alpha' = beta' ^ 2 * alpha).
    { apply (Rmult_eq_reg_l x_a); [|lra].
      replace (x_a * (beta ^ 2 * alpha')) with (x_a * beta ^ 2 / (C * alpha) * (C * alpha * alpha')) by (field; lra). rewrite E'. field. lra. }
    assert (B : beta' = beta).
    { apply (Rmult_eq_reg_l (alpha * beta')); [|nra]. replace (alpha * beta' * beta) with (alpha' * beta * beta) by (rewrite R1; ring). lra. }
    split; [|exact B]. subst beta'. apply (Rmult_eq_reg_r beta); lra.
Qed.

Print Assumptions statement.
