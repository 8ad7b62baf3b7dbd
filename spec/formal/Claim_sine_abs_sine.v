(** claim: sine-abs-sine (before eq. 29)
    [sin abs(sin) = (8/pi) [sin/3 - sin 3/15 - sin 5/105 - ...]]: the sine of odd order k has the coefficient
    [-8/(pi k (k^2 - 4))]; so the first harmonic is [8/(3 pi)], and the third is minus a fifth of it. Every amplitude. *)
From Coq Require Import Reals Lra Lia Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Enclosure.
From Selfosc Require Import Common.
Open Scope R_scope.

Definition coefficient (k : nat) : R := - (8 / (PI * (INR k * (INR k ^ 2 - 4)))).

(** The input of amplitude X through [v abs(v)]. *)
Definition output (X t : R) : R := X * sin t * Rabs (X * sin t).

(** An antiderivative of [sin^2 t sin (k t)]. *)
Lemma antiderivative (k a b : R) : k <> 0 -> k <> 2 -> k <> -2 ->
  is_RInt (fun t => sin t * sin t * sin (k * t)) a b
    ((- cos (k * b) / (2 * k) + cos ((k + 2) * b) / (4 * (k + 2)) + cos ((k - 2) * b) / (4 * (k - 2)))
     - (- cos (k * a) / (2 * k) + cos ((k + 2) * a) / (4 * (k + 2)) + cos ((k - 2) * a) / (4 * (k - 2)))).
Proof.
  intros K0 K2 K3.
  apply (by_antiderivative (fun t => - cos (k * t) / (2 * k) + cos ((k + 2) * t) / (4 * (k + 2)) + cos ((k - 2) * t) / (4 * (k - 2)))).
  - intros t. auto_derive; [trivial|].
    replace ((k + 2) * t) with (k * t + 2 * t) by ring. replace ((k - 2) * t) with (k * t - 2 * t) by ring.
    rewrite sin_plus, sin_minus, (cos_2a t), (sin_2a t).
    pose proof (sin2_cos2' t) as S. replace (cos t * cos t) with (1 - sin t * sin t) by lra. field. repeat split; lra.
  - intros t. apply (continuous_of_ex_derive (fun s => sin s * sin s * sin (k * s))). intros s. auto_derive. trivial.
Qed.

Lemma cos_of_turns (n : nat) : cos (INR n * (2 * PI)) = 1.
Proof. replace (INR n * (2 * PI)) with (0 + 2 * INR n * PI) by ring. rewrite cos_period. exact cos_0. Qed.

(** Over the first half turn and over the second one. *)
Lemma half (n : nat) (k := 2 * INR n + 1) (s : R) :
  is_RInt (fun t => sin t * sin t * sin (k * t)) 0 PI (- 4 / (k * (k ^ 2 - 4))) /\
  is_RInt (fun t => sin t * sin t * sin (k * t)) PI (2 * PI) (4 / (k * (k ^ 2 - 4))).
Proof.
  assert (K : 1 <= k) by (unfold k; pose proof (pos_INR n); lra).
  assert (K2 : k <> 2).
  { unfold k. intros E. assert (F : 2 * INR n = 1) by lra.
    assert (G : INR (2 * n) = INR 1) by (rewrite mult_INR; simpl (INR 2); simpl (INR 1); lra). apply INR_eq in G. lia. }
  assert (one : forall j : R, j = 0 \/ j = 2 \/ j = -2 -> cos ((k + j) * PI) = -1 /\ cos ((k + j) * (2 * PI)) = 1).
  { assert (base : cos (k * PI) = -1 /\ cos (k * (2 * PI)) = 1).
    { split.
      - unfold k. replace ((2 * INR n + 1) * PI) with (PI + 2 * INR n * PI) by ring. rewrite cos_period. exact cos_PI.
      - replace (k * (2 * PI)) with (INR (2 * n + 1) * (2 * PI)); [apply cos_of_turns|].
        rewrite plus_INR, mult_INR. simpl (INR 2). simpl (INR 1). unfold k. ring. }
    intros j [->|[->| ->]].
    - rewrite Rplus_0_r. exact base.
    - replace ((k + 2) * PI) with (k * PI + 2 * INR 1 * PI) by (simpl; ring).
      replace ((k + 2) * (2 * PI)) with (k * (2 * PI) + 2 * INR 2 * PI) by (simpl; ring). rewrite !cos_period. exact base.
    - replace (k * PI) with ((k + -2) * PI + 2 * INR 1 * PI) in base by (simpl; ring).
      replace (k * (2 * PI)) with ((k + -2) * (2 * PI) + 2 * INR 2 * PI) in base by (simpl; ring). rewrite !cos_period in base. exact base. }
  destruct (one 0) as [A1 A2]; [tauto|]. destruct (one 2) as [B1 B2]; [tauto|]. destruct (one (-2)) as [C1 C2]; [tauto|].
  rewrite Rplus_0_r in A1, A2. replace (k + -2) with (k - 2) in C1, C2 by ring.
  assert (D : k ^ 2 - 4 <> 0) by (replace (k ^ 2 - 4) with ((k - 2) * (k + 2)) by ring; apply Rmult_integral_contrapositive; split; lra).
  split.
  - eapply int_eq; [apply (antiderivative k 0 PI); lra|reflexivity|]. rewrite A1, B1, C1, !Rmult_0_r, cos_0.
    field. replace (k ^ 2 - 4) with ((k - 2) * (k + 2)) in D by ring. repeat split; lra.
  - eapply int_eq; [apply (antiderivative k PI (2 * PI)); lra|reflexivity|]. rewrite A1, B1, C1, A2, B2, C2.
    field. repeat split; lra.
Qed.

Theorem statement : forall (X : R) (n : nat), 0 < X ->
  Y_P (2 * n + 1) (output X) = X ^ 2 * coefficient (2 * n + 1) /\
  coefficient 1 = 8 / (3 * PI) /\ coefficient 3 = - (coefficient 1 / 5) /\ coefficient 5 = - (8 / PI / 105).
Proof.
  intros X n HX. pose proof PI_RGT_0 as HPI.
  split; [|unfold coefficient; simpl; repeat split; field; lra].
  set (k := 2 * INR n + 1). assert (Ek : INR (2 * n + 1) = k) by (rewrite plus_INR, mult_INR; simpl; unfold k; ring).
  destruct (half n 0) as [A B]. fold k in A, B.
  assert (K : 1 <= k) by (unfold k; pose proof (pos_INR n); lra).
  assert (D : k * (k ^ 2 - 4) <> 0).
  { apply Rmult_integral_contrapositive. split; [lra|]. replace (k ^ 2 - 4) with ((k - 2) * (k + 2)) by ring.
    apply Rmult_integral_contrapositive. split; [|lra]. unfold k. intros E.
    assert (G : INR (2 * n) = INR 1) by (rewrite mult_INR; simpl (INR 2); simpl (INR 1); lra). apply INR_eq in G. lia. }
  assert (I : is_RInt (fun t => output X t * sin (k * t)) 0 (2 * PI)
    (X ^ 2 * (- 4 / (k * (k ^ 2 - 4))) + - X ^ 2 * (4 / (k * (k ^ 2 - 4))))).
  { apply (int_chasles _ 0 PI).
    - refine (int_eq_inside _ _ _ _ _ _ (int_scal _ _ _ _ _ A) _); [lra|]. intros t T. unfold output.
      rewrite Rabs_right; [ring|]. apply Rle_ge, Rmult_le_pos; [lra|]. apply sin_ge_0; lra.
    - refine (int_eq_inside _ _ _ _ _ _ (int_scal _ _ _ _ _ B) _); [lra|]. intros t T. unfold output.
      rewrite Rabs_left1; [ring|]. assert (sin t <= 0) by (apply sin_le_0; lra). nra. }
  unfold Y_P, coefficient. rewrite Ek, (int_unique _ _ _ _ I). 
  assert (D2 : k ^ 2 - 4 <> 0) by (intros E; apply D; rewrite E; ring). field. repeat split; lra.
Qed.

(** The rounded constant is not the coefficient. *)
Theorem not_0_85 : coefficient 1 < 0.85.
Proof. unfold coefficient. simpl. interval with (i_prec 30). Qed.

Print Assumptions statement.
