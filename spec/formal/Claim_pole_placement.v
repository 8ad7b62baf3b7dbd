(** claim: pole-placement (of this project)
    The gains that [control] designs for an axis [alpha x'' + beta_1 x' = u] give the closed loop the characteristic polynomial
    [alpha f (s + w)^2 (s + c w)(s + p)] for I-PD and PID, without the factor [s + c w] for PD: f the time constant of the filter, w the
    bandwidth over the structure's ratio, c 1 for I-PD and 0.1 for PID, p whatever the filter makes it. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Inductive structure := Pd | Pid | Ipd.
(** The slow pole as a share of the double one. *)
Definition slow_pole (k : structure) : R := match k with Pd => 0 | Pid => 1 / 10 | Ipd => 1 end.
(** The filter on the derivative is this much faster than the double pole. *)
Definition filter (w : R) : R := 1 / 10 / w.

(** The gains as the program computes them, by the place w of the double pole. *)
Definition q (alpha beta_1 c w : R) : R := alpha * (1 - (2 + c) * w * filter w) + beta_1 * filter w.
Definition K_i (alpha beta_1 c w : R) : R := q alpha beta_1 c w * (c * w * w ^ 2).
Definition K_p (alpha beta_1 c w : R) : R :=
  alpha * filter w * (c * w * w ^ 2) + q alpha beta_1 c w * ((1 + 2 * c) * w ^ 2) - K_i alpha beta_1 c w * filter w.
Definition K_d (alpha beta_1 c w : R) : R :=
  alpha * filter w * ((1 + 2 * c) * w ^ 2) + q alpha beta_1 c w * ((2 + c) * w) - beta_1 - K_p alpha beta_1 c w * filter w.

(** The loop: [alpha s^2 + beta_1 s] for the axis, [f s + 1] for the filter, [s] for the integral; and what is fed back. *)
Definition own (alpha beta_1 f s : R) : R := (alpha * s ^ 2 + beta_1 * s) * (f * s + 1).
Definition fed_back (f k_p k_i k_d s : R) : R := k_i + (k_p + k_i * f) * s + (k_d + k_p * f) * s ^ 2.

(** The characteristic polynomial of the loop with an integral, and without one (which needs no [1/s]). *)
Definition with_integral (alpha beta_1 f k_p k_i k_d s : R) : R := own alpha beta_1 f s * s + fed_back f k_p k_i k_d s.
Definition without_integral (alpha beta_1 f k_p k_d s : R) : R := own alpha beta_1 f s + k_p + (k_d + k_p * f) * s.

(** The pole that the filter adds. *)
Definition p (alpha beta_1 c w : R) : R := q alpha beta_1 c w / (alpha * filter w).

Theorem statement : forall alpha beta_1 w s : R, 0 < alpha -> 0 < w ->
  let f := filter w in
  (forall k, let c := slow_pole k in
    with_integral alpha beta_1 f (K_p alpha beta_1 c w) (K_i alpha beta_1 c w) (K_d alpha beta_1 c w) s
    = alpha * f * (s + w) ^ 2 * (s + c * w) * (s + p alpha beta_1 c w)) /\
  K_i alpha beta_1 (slow_pole Pd) w = 0 /\
  without_integral alpha beta_1 f (K_p alpha beta_1 (slow_pole Pd) w) (K_d alpha beta_1 (slow_pole Pd) w) s
    = alpha * f * (s + w) ^ 2 * (s + p alpha beta_1 (slow_pole Pd) w).
Proof.
  intros alpha beta_1 w s Ha Hw f. unfold f.
  split; [intros k; cbv zeta; generalize (slow_pole k); intros c|split]; unfold with_integral, without_integral, own, fed_back, p, K_d, K_p, K_i, q, filter; simpl slow_pole.
  - field. lra.
  - ring.
  - field. lra.
Qed.

(** The characteristic function with a delay T of the command: what is fed back comes late. *)
Definition delayed (alpha beta_1 f k_p k_i k_d T s : R) : R := own alpha beta_1 f s * s + fed_back f k_p k_i k_d s * exp (- (s * T)).

(** A delay moves the double pole of every design whose axis' own polynomial does not vanish there by itself. *)
Theorem needs_no_delay : forall (alpha beta_1 w T : R) (k : structure), 0 < alpha -> 0 < w -> 0 < T ->
  let c := slow_pole k in let f := filter w in
  own alpha beta_1 f (- w) <> 0 ->
  delayed alpha beta_1 f (K_p alpha beta_1 c w) (K_i alpha beta_1 c w) (K_d alpha beta_1 c w) T (- w) <> 0.
Proof.
  intros alpha beta_1 w T k Ha Hw HT c f O. unfold delayed.
  pose proof (proj1 (statement alpha beta_1 w (- w) Ha Hw) k) as E. fold c f in E. cbv zeta in E. fold c f in E. unfold with_integral in E.
  replace (- w + w) with 0 in E by ring. rewrite pow_ne_zero in E by discriminate.
  set (F := fed_back _ _ _ _ _) in *. assert (F0 : F = own alpha beta_1 f (- w) * w) by lra. rewrite F0.
  replace (- (- w * T)) with (w * T) by ring.
  assert (X : 1 < exp (w * T)) by (rewrite <- exp_0; apply exp_increasing; nra).
  replace (own alpha beta_1 f (- w) * - w + own alpha beta_1 f (- w) * w * exp (w * T))
    with (own alpha beta_1 f (- w) * (w * (exp (w * T) - 1))) by ring.
  apply Rmult_integral_contrapositive. split; [exact O|]. apply Rgt_not_eq. nra.
Qed.

(** The bandwidth, a share of w, is no pole: there the polynomial is positive. *)
Theorem not_the_bandwidth : forall alpha beta_1 w : R, 0 < alpha -> 0 <= beta_1 -> 0 < w ->
  0 < without_integral alpha beta_1 (filter w) (K_p alpha beta_1 0 w) (K_d alpha beta_1 0 w) (- (3 / 5 * w)).
Proof.
  intros alpha beta_1 w Ha Hb Hw. pose proof (proj2 (proj2 (statement alpha beta_1 w (- (3 / 5 * w)) Ha Hw))) as E.
  cbv zeta in E. change (slow_pole Pd) with 0 in E. rewrite E. unfold p, q, filter.
  match goal with |- 0 < ?l => replace l with (2 / 125 * w * (37 / 5 * alpha * w + beta_1)) by (field; repeat split; lra) end.
  assert (0 < alpha * w) by nra. apply Rmult_lt_0_compat; lra.
Qed.

Print Assumptions statement.
