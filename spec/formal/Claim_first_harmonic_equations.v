(** claim: first-harmonic-equations (eqs. 21-25)
    For [x = x_0 + X sin(w t)] the left side [alpha x'' + beta_1 x' + beta_2 x' abs(x')] has mean zero and the first harmonic
    [(f_R + j f_I) X sin(w t)] with [f_R = -alpha w^2], [f_I = beta_1 w + (8/(3 pi)) beta_2 X w^2]. Where it balances
    [delta - y] in the mean and in the first harmonic, y the output of the relay seen from x, the identification equations hold:
    [f_R = -P_N], [f_I = -Q_N], [F_0 = delta]. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

Definition f_R (alpha w : R) : R := - (alpha * w ^ 2).
Definition f_I (beta_1 beta_2 X w : R) : R := beta_1 * w + 8 / (3 * PI) * beta_2 * X * w ^ 2.

Section Tone.
Variables alpha beta_1 beta_2 x_0 X w : R.

(** The tone in time, and the left side by the angle [theta = w t]. *)
Definition x (t : R) : R := sinusoid x_0 X (w * t).
Definition left_side (theta : R) : R :=
  alpha * Derive_n x 2 (theta / w) + drag beta_1 beta_2 (Derive x (theta / w)).

Hypotheses (HX : 0 < X) (Hw : 0 < w).

Lemma left_side_is theta : left_side theta =
  - (alpha * X * w ^ 2) * sin theta + beta_1 * X * w * cos theta + beta_2 * (X * w) ^ 2 * (cos theta * Rabs (cos theta)).
Proof.
  assert (D1 : forall t : R, Derive x t = X * w * cos (w * t)).
  { intros t. apply is_derive_unique. unfold x, sinusoid. auto_derive; [trivial|ring]. }
  assert (D2 : Derive_n x 2 (theta / w) = - (X * w ^ 2 * sin theta)).
  { change (Derive (fun t => Derive x t) (theta / w) = - (X * w ^ 2 * sin theta)).
    rewrite (Derive_ext _ (fun t => X * w * cos (w * t))) by exact D1. apply is_derive_unique.
    auto_derive; [trivial|]. replace (w * (theta / w)) with theta by (field; lra). ring. }
  unfold left_side, drag. rewrite D2, D1. replace (w * (theta / w)) with theta by (field; lra).
  rewrite Rabs_mult, (Rabs_right (X * w)) by nra. ring.
Qed.
End Tone.

(** Cosine times its magnitude: mean, and products with sine and cosine. *)
Lemma quarters (f A : R -> R) : (forall t, is_derive A t (cos t * cos t * f t)) -> (forall t : R, ex_derive f t) ->
  is_RInt (fun t => cos t * Rabs (cos t) * f t) 0 (2 * PI)
    ((A (PI / 2) - A 0) - (A (3 * (PI / 2)) - A (PI / 2)) + (A (2 * PI) - A (3 * (PI / 2)))).
Proof.
  intros HA Hf. pose proof PI_RGT_0.
  assert (I : forall a b, is_RInt (fun t => cos t * cos t * f t) a b (A b - A a)).
  { intros a b. apply by_antiderivative; [exact HA|]. intros t.
    apply (continuous_of_ex_derive (fun s => cos s * cos s * f s)). intros s. auto_derive. apply Hf. }
  apply (int_chasles _ 0 (3 * (PI / 2))); [apply (int_chasles _ 0 (PI / 2))|].
  - refine (int_eq_inside _ _ _ _ _ _ (I 0 (PI / 2)) _); [lra|]. intros t T.
    rewrite Rabs_right; [ring|]. apply Rle_ge, cos_ge_0; lra.
  - apply (int_eq_inside (fun t => - 1 * (cos t * cos t * f t))); [lra| |].
    + replace (- (A (3 * (PI / 2)) - A (PI / 2))) with (- 1 * (A (3 * (PI / 2)) - A (PI / 2))) by ring. apply int_scal, I.
    + intros t T. rewrite Rabs_left1; [ring|]. apply cos_le_0; lra.
  - refine (int_eq_inside _ _ _ _ _ _ (I (3 * (PI / 2)) (2 * PI)) _); [lra|]. intros t T.
    rewrite Rabs_right; [ring|]. apply Rle_ge. replace t with (t - 2 * PI + 2 * PI) by ring. rewrite cos_turn. apply cos_ge_0; lra.
Qed.

Lemma cos_abs_cos_mean : is_RInt (fun t => cos t * Rabs (cos t)) 0 (2 * PI) 0.
Proof.
  pose proof (quarters (fun _ => 1) (fun t => t / 2 + sin t * cos t / 2)) as Q.
  eapply int_eq; [apply Q|intros; cbv beta; ring|].
  - intros t. auto_derive; [trivial|]. pose proof (sin2_cos2' t). nra.
  - intros t. auto_derive. trivial.
  - cbv beta. rewrite sin_PI2, cos_PI2, sin_0, sin_2PI, cos_3PI2. field.
Qed.

Lemma cos_abs_cos_sin : is_RInt (fun t => cos t * Rabs (cos t) * sin t) 0 (2 * PI) 0.
Proof.
  pose proof (quarters sin (fun t => - cos t ^ 3 / 3)) as Q.
  eapply int_eq; [apply Q|intros; reflexivity|].
  - intros t. auto_derive; [trivial|]. field.
  - intros t. auto_derive. trivial.
  - cbv beta. rewrite cos_PI2, cos_0, cos_2PI, cos_3PI2. field.
Qed.

Lemma cos_abs_cos_cos : is_RInt (fun t => cos t * Rabs (cos t) * cos t) 0 (2 * PI) (8 / 3).
Proof.
  pose proof (quarters cos (fun t => sin t - sin t ^ 3 / 3)) as Q.
  eapply int_eq; [apply Q|intros; reflexivity|].
  - intros t. auto_derive; [trivial|]. pose proof (sin2_cos2' t) as S.
    replace (sin t * (sin t * 1)) with (1 - cos t * cos t) by lra. field.
  - intros t. auto_derive. trivial.
  - cbv beta. rewrite sin_PI2, sin_0, sin_2PI, sin_3PI2. field.
Qed.

(** Mean and first harmonic of the left side. *)
Theorem left_side_harmonics : forall alpha beta_1 beta_2 x_0 X w : R, 0 < X -> 0 < w ->
  let left := left_side alpha beta_1 beta_2 x_0 X w in
  is_RInt left 0 (2 * PI) 0 /\
  is_RInt (fun t => left t * sin t) 0 (2 * PI) (PI * X * f_R alpha w) /\
  is_RInt (fun t => left t * cos t) 0 (2 * PI) (PI * X * f_I beta_1 beta_2 X w).
Proof.
  intros alpha beta_1 beta_2 x_0 X w HX Hw left. pose proof PI_RGT_0.
  pose proof (left_side_is alpha beta_1 beta_2 x_0 X w HX Hw) as L. fold left in L.
  assert (sum : forall (f : R -> R) (s c q : R),
    is_RInt (fun t => sin t * f t) 0 (2 * PI) s -> is_RInt (fun t => cos t * f t) 0 (2 * PI) c ->
    is_RInt (fun t => cos t * Rabs (cos t) * f t) 0 (2 * PI) q ->
    is_RInt (fun t => left t * f t) 0 (2 * PI) (- (alpha * X * w ^ 2) * s + beta_1 * X * w * c + beta_2 * (X * w) ^ 2 * q)).
  { intros f s c q S C Q.
    eapply int_eq; [exact (int_plus _ _ _ _ _ _ (int_plus _ _ _ _ _ _ (int_scal _ _ _ (- (alpha * X * w ^ 2)) _ S)
      (int_scal _ _ _ (beta_1 * X * w) _ C)) (int_scal _ _ _ (beta_2 * (X * w) ^ 2) _ Q))| |reflexivity].
    intros t. cbv beta. rewrite L. ring. }
  split; [|split].
  - eapply int_eq; [apply (sum (fun _ => 1) 0 0 0)|intros; cbv beta; ring|ring].
    + apply (int_eq _ _ _ _ _ _ turn_of_sin); [intros; ring|reflexivity].
    + apply (int_eq _ _ _ _ _ _ turn_of_cos); [intros; ring|reflexivity].
    + apply (int_eq _ _ _ _ _ _ cos_abs_cos_mean); [intros; ring|reflexivity].
  - eapply int_eq; [apply (sum sin PI 0 0)|intros; reflexivity|unfold f_R; ring].
    + exact turn_of_sin2.
    + apply (int_eq _ _ _ _ _ _ turn_of_sin_cos); [intros; ring|reflexivity].
    + exact cos_abs_cos_sin.
  - eapply int_eq; [apply (sum cos 0 PI (8 / 3))|intros; reflexivity|unfold f_I; field; lra].
    + exact turn_of_sin_cos.
    + exact turn_of_cos2.
    + exact cos_abs_cos_cos.
Qed.

(** What it takes that left side and [delta - y] have the same mean and the same first harmonic. *)
Definition balances (left y : R -> R) (delta : R) : Prop :=
  Y_0 left = delta - Y_0 y /\ Y_P 1 left = - Y_P 1 y /\ Y_Q 1 left = - Y_Q 1 y.

Theorem statement : forall (alpha beta_1 beta_2 x_0 X w delta : R) (y : R -> R), 0 < X -> 0 < w ->
  let left := left_side alpha beta_1 beta_2 x_0 X w in
  let P_N := Y_P 1 y / X in let Q_N := Y_Q 1 y / X in let F_0 := Y_0 y in
  (Y_0 left = 0 /\ Y_P 1 left = f_R alpha w * X /\ Y_Q 1 left = f_I beta_1 beta_2 X w * X) /\
  (balances left y delta <-> f_R alpha w = - P_N /\ f_I beta_1 beta_2 X w = - Q_N /\ F_0 = delta).
Proof.
  intros alpha beta_1 beta_2 x_0 X w delta y HX Hw left P_N Q_N F_0. pose proof PI_RGT_0.
  destruct (left_side_harmonics alpha beta_1 beta_2 x_0 X w HX Hw) as [M [S C]]. fold left in M, S, C.
  assert (E : Y_0 left = 0 /\ Y_P 1 left = f_R alpha w * X /\ Y_Q 1 left = f_I beta_1 beta_2 X w * X).
  { rewrite (Y_0_of _ _ M), (Y_P_of _ _ S), (Y_Q_of _ _ C). repeat split; field; lra. }
  split; [exact E|]. unfold balances, P_N, Q_N, F_0. destruct E as [-> [-> ->]].
  split; intros [E0 [E1 E2]].
  - replace (Y_P 1 y) with (- (f_R alpha w * X)) by lra. replace (Y_Q 1 y) with (- (f_I beta_1 beta_2 X w * X)) by lra.
    repeat split; try field; lra.
  - rewrite E0, E1. repeat split; try field; lra.
Qed.

Print Assumptions statement.
