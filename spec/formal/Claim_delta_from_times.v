(** claim: delta-from-times (eq. 32, delta = F_0)
    As printed: the disturbance is found from the times at either command, whatever the drag law. As corrected:
    [delta = -C (t_plus - t_minus)/T] is exact, for any waveform and any delay, when drag is linear. *)
From Coq Require Import Reals Lra Psatz ZArith.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Phase Attraction Motion Cycle Hyperbolic Times Enclosure.
From Selfosc Require Claim_orbit_quadratic.
Open Scope R_scope.

(** The command y acts on the axis [T_d] later, whatever it is made by, and over the time T velocity and coordinate come back. *)
Theorem statement : forall (start alpha beta delta C T_d a T t_plus t_minus : R) (y x v : R -> R), alpha <> 0 ->
  (* the hypothesis linear-drag: no quadratic drag *)
  axis start alpha beta 0 delta (fun t => y (t - T_d)) x v -> start < a + T_d ->
  0 < T -> x (a + T_d + T) = x (a + T_d) -> v (a + T_d + T) = v (a + T_d) ->
  held C y a (a + T) t_plus t_minus ->
  delta = delta_of_times C t_plus t_minus T.
Proof.
  intros start alpha beta delta C T_d a T p m y x v Ha A Sa HT X V H.
  pose proof (balance start alpha beta delta C y T_d x v a (a + T) p m Ha A Sa H) as B.
  replace (a + T + T_d) with (a + T_d + T) in B by ring. rewrite X, V in B. unfold delta_of_times.
  apply (Rmult_eq_reg_r T); [|lra]. field_simplify; lra.
Qed.

(** * Quadratic drag: two in a hundred of the level less *)

Section Quadratic.
(** Inertia 1, drag 1, level 1, disturbance 1/2; the half-width is such that the speeds at the levels are roots. *)
Let x_a := ln (8 / 5) / 4.
Let P := sqrt (3 / 4).
Let Q := sqrt (3 / 8).

Lemma half_width : 0 < x_a.
Proof. unfold x_a. assert (0 < ln (8 / 5)) by (rewrite <- ln_1; apply ln_increasing; lra). lra. Qed.

Lemma roots : 0 < P /\ P * P = 3 / 4 /\ 0 < Q /\ Q * Q = 3 / 8.
Proof. unfold P, Q. repeat split; try (apply sqrt_lt_R0; lra); apply sqrt_sqrt; lra. Qed.

Lemma disturbed : Rabs (1 / 2) < 1.
Proof. rewrite Rabs_pos_eq; lra. Qed.

Lemma logs : ln (5 / 8) = - (4 * x_a).
Proof. unfold x_a. replace (5 / 8) with (/ (8 / 5)) by field. rewrite ln_Rinv by lra. field. Qed.

Lemma down : half 1 0 1 (1 - 1 / 2) x_a P Q.
Proof.
  destruct roots as [P0 [PP [Q0 QQ]]]. assert (F : 0 < force 0 1 (1 - 1 / 2) (- Q)) by (unfold force, drag; rewrite Rabs_left by lra; lra).
  unfold half. split; [lra|]. split; [exact Q0|]. split; [exact F|].
  rewrite (Claim_orbit_quadratic.way_down 1 1 (1 - 1 / 2)), (Claim_orbit_quadratic.way_up 1 1 (1 - 1 / 2)) by (lra || assumption).
  replace (1 * (- Q * - Q)) with (3 / 8) by lra. replace (1 * (P * P)) with (3 / 4) by lra.
  assert (L : ln (1 - 3 / 8 / (1 - 1 / 2)) + ln (1 + 3 / 4 / (1 - 1 / 2)) = ln (5 / 8)) by (rewrite <- ln_mult by lra; f_equal; field).
  rewrite logs in L. lra.
Qed.

Lemma up : half 1 0 1 (1 - - (1 / 2)) x_a Q P.
Proof.
  destruct roots as [P0 [PP [Q0 QQ]]]. assert (F : 0 < force 0 1 (1 - - (1 / 2)) (- P)) by (unfold force, drag; rewrite Rabs_left by lra; lra).
  unfold half. split; [lra|]. split; [exact P0|]. split; [exact F|].
  rewrite (Claim_orbit_quadratic.way_down 1 1 (1 - - (1 / 2))), (Claim_orbit_quadratic.way_up 1 1 (1 - - (1 / 2))) by (lra || assumption).
  replace (1 * (- P * - P)) with (3 / 4) by lra. replace (1 * (Q * Q)) with (3 / 8) by lra.
  replace (1 - - (1 / 2)) with (3 / 2) by lra.
  assert (L : ln (1 - 3 / 4 / (3 / 2)) + ln (1 + 3 / 8 / (3 / 2)) = ln (5 / 8)) by (rewrite <- ln_mult by lra; f_equal; field).
  rewrite logs in L. lra.
Qed.

(** As printed, for quadratic drag: false on an exact limit cycle, without delay. *)
Theorem as_printed_false : exists (x_a T t_plus t_minus a : R) (x v u : R -> R),
  relay_loop 1 0 1 (1 / 2) 1 x_a x v u /\ repeats T x v u /\ 0 < a /\ held 1 u a (a + T) t_plus t_minus /\
  delta_of_times 1 t_plus t_minus T < 1 / 2 - 1 / 50.
Proof.
  destruct roots as [P0 [PP [Q0 QQ]]]. pose proof half_width as Hx. pose proof disturbed as Hd. pose proof down as HQ. pose proof up as HP.
  assert (B0 : 0 <= 0) by lra. assert (B1 : 0 <= 1) by lra. assert (B2 : 0 < 0 + 1) by lra. assert (A0 : 0 < 1) by lra.
  set (T := period 1 0 1 (1 / 2) 1 P Q). set (T1 := Motion.time_down 1 0 1 (1 / 2) 1 P Q). set (T2 := Motion.time_up 1 0 1 (1 / 2) 1 P Q).
  destruct (times_positive 1 0 1 (1 / 2) 1 x_a P Q A0 B0 B1 B2 Hd HQ HP) as [H1 H2]. fold T1 in H1. fold T2 in H2.
  exists x_a, T, T2, T1, T, (cycle_x 1 0 1 (1 / 2) 1 x_a P Q B0 B1 B2 Hd HQ HP), (cycle_v 1 0 1 (1 / 2) 1 x_a P Q B0 B1 B2 Hd HQ HP), (cycle_u 1 0 1 (1 / 2) 1 P Q).
  assert (ET : T = T1 + T2) by reflexivity.
  split; [apply cycle_is_motion; assumption|]. split; [split; [lra|intros t _; apply cycle_repeats; assumption]|]. split; [lra|]. split.
  - replace T2 with (0 + (T + T - (T + T1))) by lra. replace T1 with (0 + (T + T1 - T)) at 2 by lra.
    apply high_for with (b := T + T1).
    + apply low_for; [apply nothing|lra|]. intros t Ht. apply (first_half 1 0 1 (1 / 2) 1 x_a P Q A0 B0 B1 B2 Hd HQ HP 1); fold T T1; lra.
    + lra.
    + intros t Ht. apply (second_half 1 0 1 (1 / 2) 1 x_a P Q A0 B0 B1 B2 Hd HQ HP 1); fold T T1; lra.
  - unfold delta_of_times. rewrite ET.
    assert (FQ : 0 < force 0 1 (c_down (1 / 2) 1) (- Q)) by (unfold c_down, force, drag; rewrite Rabs_left by lra; lra).
    assert (FP : 0 < force 0 1 (c_up (1 / 2) 1) (- P)) by (unfold c_up, force, drag; rewrite Rabs_left by lra; lra).
    assert (C1 : 0 < c_down (1 / 2) 1) by (unfold c_down; lra). assert (C2 : 0 < c_up (1 / 2) 1) by (unfold c_up; lra).
    assert (E1 : 3 < T1).
    { unfold T1, Motion.time_down, half_time. rewrite (Claim_orbit_quadratic.time_up 1 1 (c_down (1 / 2) 1)), (Claim_orbit_quadratic.time_down 1 1 (c_down (1 / 2) 1)) by (lra || assumption).
      unfold Claim_orbit_quadratic.k, c_down, atanh, P, Q. interval with (i_prec 40). }
    assert (E2 : T2 < 11 / 10).
    { unfold T2, Motion.time_up, half_time. rewrite (Claim_orbit_quadratic.time_up 1 1 (c_up (1 / 2) 1)), (Claim_orbit_quadratic.time_down 1 1 (c_up (1 / 2) 1)) by (lra || assumption).
      unfold Claim_orbit_quadratic.k, c_up, atanh, P, Q. interval with (i_prec 40). }
    assert (E3 : T1 < 312 / 100).
    { unfold T1, Motion.time_down, half_time. rewrite (Claim_orbit_quadratic.time_up 1 1 (c_down (1 / 2) 1)), (Claim_orbit_quadratic.time_down 1 1 (c_down (1 / 2) 1)) by (lra || assumption).
      unfold Claim_orbit_quadratic.k, c_down, atanh, P, Q. interval with (i_prec 40). }
    assert (E4 : 1098 / 1000 < T2).
    { unfold T2, Motion.time_up, half_time. rewrite (Claim_orbit_quadratic.time_up 1 1 (c_up (1 / 2) 1)), (Claim_orbit_quadratic.time_down 1 1 (c_up (1 / 2) 1)) by (lra || assumption).
      unfold Claim_orbit_quadratic.k, c_up, atanh, P, Q. interval with (i_prec 40). }
    apply (Rmult_lt_reg_r (T1 + T2)); [lra|]. replace (- (1 * (T2 - T1) / (T1 + T2)) * (T1 + T2)) with (T1 - T2) by (field; lra). lra.
Qed.
End Quadratic.

Print Assumptions statement.
