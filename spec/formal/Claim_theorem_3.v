(** theorem-3 (Theorem 3). As printed: with an astatic process the self-oscillations are asymmetric if and only if the characteristic
    is. As corrected: with an integrating process a characteristic whose even part is of one sign, and not zero almost everywhere on
    the sweep, oscillates asymmetrically; an odd nondecreasing one symmetrically (theorem-2). Exactly, in the strict sense of mirrored
    half waves about the reference, the printed "only if" holds of odd processes: the characteristic is then odd where it is swept. *)
From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels Moments Abel Claim_polynomial Claim_odd_harmonics Claim_lemma_1 Claim_lemma_2 Loop Claim_theorem_2.
Import ListNotations.
Open Scope R_scope.

(** * On the first harmonic *)

(** The characteristics of lemma 2: the even part has the sign of [s]. *)
Definition of_lemma_2 (s : R) (c : characteristic) (X : R) : Prop :=
  ex_RInt (output c 0 X) 0 (2 * PI) /\ one_sign s c X /\ not_zero_on_an_interval s c X.

(** The paper's nonlinear class; nondecreasing branches give the sign of the bias too. *)
Definition first_harmonic_nonlinear : Prop := forall (G : left_side) (s : R) (c : characteristic) (B X w r : R), 0 < X -> 0 < w ->
  integrating G -> odd_process G -> of_lemma_2 s c X ->
  let x := fun t => r - (B + X * sin (w * t)) in
  ex_RInt (fun theta => G (jet x (theta / w))) 0 PI ->
  mean (fun theta => G (jet x (theta / w))) = mean (output c B X) ->
  B <> 0 /\ (nondecreasing (rising c) -> nondecreasing (falling c) -> s * B < 0).

(** Linear processes. *)
Definition first_harmonic_linear : Prop := forall (P : linear_process) (s : R) (c : characteristic) (B X w : R) (z : R -> nat -> R),
  0 < X -> 0 < w -> has_integrator P -> of_lemma_2 s c X ->
  moves P (fun t => output c B X (w * t)) z -> repeats P (2 * PI / w) z ->
  B <> 0 /\ (nondecreasing (rising c) -> nondecreasing (falling c) -> s * B < 0).

(** * Exactly *)

(** An oscillation that is symmetric, whatever its waveform, has swept a characteristic that is odd there. *)
Definition symmetric_only_if_odd : Prop := forall (G : left_side) (F x : R -> R) (r h : R),
  integrating G -> odd_process G -> mirrored h r x -> (forall t, G (jet x t) = F (r - x t)) ->
  forall t, F (- (r - x t)) = - F (r - x t).

(** With memory: what the branches give at opposite errors, half a period apart, is opposite. *)
Definition symmetric_only_if_images : Prop := forall (G : left_side) (c : characteristic) (x u : R -> R) (r h t : R),
  integrating G -> odd_process G -> mirrored h r x -> G (jet x t) = u t -> G (jet x (t + h)) = u (t + h) ->
  u t = rising c (r - x t) -> u (t + h) = falling c (- (r - x t)) -> even_part c (r - x t) = 0.

(** An integrator anywhere in a nonlinear process: [w] integrates what the characteristic gives. An even part of one sign along the
    error, and away from zero for a while, leaves no oscillation of mirrored half waves about zero error. *)
Definition exact_integrating_chain : Prop := forall (F e w : R -> R) (s h eps a b : R), 0 < h ->
  (forall t, e (t + h) = - e t) ->
  (forall a b, is_RInt (fun t => F (e t)) a b (w b - w a)) -> (forall t, w (t + (h + h)) = w t) ->
  (forall t, 0 <= s * (F (e t) + F (- e t))) ->
  0 < eps -> 0 <= a -> a < b -> b <= h -> (forall t, a < t < b -> eps <= s * (F (e t) + F (- e t))) -> False.

(** Linear processes under a relay with levels [d +- C], one switching each way: the times differ by [- d/C] of the period, so they
    are equal exactly where there is no offset; without offset the motion is symmetric. *)
Definition relay_orbits : Prop := forall (P : linear_process) (C x_a d r high low : R) (u : R -> R) (z : R -> nat -> R),
  0 < C -> has_integrator P -> relay_orbit P C x_a d r high low u z ->
  (high - low) / (high + low) = - (d / C) /\ (high = low <-> d = 0) /\
  (d = 0 -> rests_without_command P -> mirrored high r (response P z)).

(** * Proof *)

Lemma balanced s c B X : 0 < X -> of_lemma_2 s c X -> mean (output c B X) = 0 ->
  B <> 0 /\ (nondecreasing (rising c) -> nondecreasing (falling c) -> s * B < 0).
Proof.
  intros HX [E [sign_ away]] Z. split.
  - intros ->. pose proof (unbiased_mean_holds s c X HX E sign_ away) as P. rewrite Z in P. lra.
  - intros Hr Hf. now apply (opposite_bias_holds s c B X).
Qed.

Lemma first_harmonic_nonlinear_holds : first_harmonic_nonlinear.
Proof.
  intros G s c B X w r HX Hw HG Ho Hc x E Bal. pose proof PI_RGT_0. apply (balanced s c B X HX Hc).
  assert (M : mirrored (PI / w) (r - B) x).
  { intros t. unfold x. pose proof (sinusoid_mirrored B X w Hw t) as S. simpl in S. lra. }
  pose proof (left_side_mean G x (r - B) w Hw HG Ho M E) as Z. rewrite <- Bal. unfold mean. rewrite (RInt_of _ _ _ _ Z). field. lra.
Qed.

Lemma first_harmonic_linear_holds : first_harmonic_linear.
Proof.
  intros P s c B X w z HX Hw HP Hc M Rz. pose proof PI_RGT_0. apply (balanced s c B X HX Hc).
  pose proof (integrator_balance P _ z _ HP M Rz 0) as I. rewrite Rplus_0_l in I. apply in_angle in I; [|exact Hw].
  unfold mean. rewrite (RInt_of _ _ _ _ I). field. lra.
Qed.

Lemma symmetric_only_if_odd_holds : symmetric_only_if_odd.
Proof.
  intros G F x r h HG Ho M eq t. rewrite <- eq, <- (left_side_half_period G x h r t HG Ho M), eq, (M t). f_equal. ring.
Qed.

Lemma symmetric_only_if_images_holds : symmetric_only_if_images.
Proof.
  intros G c x u r h t HG Ho M E1 E2 U1 U2. unfold even_part. rewrite <- U1, <- U2, <- E1, <- E2.
  rewrite (left_side_half_period G x h r t HG Ho M). field.
Qed.

Lemma exact_integrating_chain_holds : exact_integrating_chain.
Proof.
  intros F e w s h eps a b Hh flip I per sign_ Heps Ha ab Hb away.
  pose proof (I 0 h) as I1. pose proof (I h (h + h)) as I2.
  assert (I2' : is_RInt (fun t => F (- e t)) 0 h (w (h + h) - w h)).
  { apply (ext (fun t => F (e (t + h)))); [lra|intros t _; now rewrite flip|].
    apply (later (fun t => F (e t)) h). rewrite Rplus_0_l. exact I2. }
  pose proof (multiply _ s _ _ _ (add _ _ _ _ _ _ I1 I2')) as J.
  apply (positive _ 0 a b h eps) in J; auto.
  pose proof (per 0) as P. rewrite Rplus_0_l in P. rewrite P in J. replace (w h - w 0 + (w 0 - w h)) with 0 in J by ring. lra.
Qed.

Lemma relay_orbits_hold : relay_orbits.
Proof.
  intros P C x_a d r high low u z HC HP O.
  pose proof (times_of_orbit P C x_a d r high low u z HP HC O) as T.
  assert (iff_ : high = low <-> d = 0).
  { pose proof O as [Hh Hl _ _ _ _ _ _ _]. split.
    - intros ->. replace ((low - low) / (low + low)) with 0 in T by (field; lra).
      apply (Rmult_eq_reg_r (/ C)); [|apply Rinv_neq_0_compat; lra]. unfold Rdiv in T. lra.
    - intros ->. replace (0 / C) with 0 in T by (field; lra). apply (Rmult_eq_compat_r (high + low)) in T. field_simplify in T; lra. }
  split; [exact T|]. split; [exact iff_|]. intros D Rest. subst d. rewrite <- (proj2 iff_ eq_refl) in O.
  now apply (equal_times_mirrored P C x_a r high u z O).
Qed.

Theorem statement :
  (first_harmonic_nonlinear /\ first_harmonic_linear) /\
  (symmetric_only_if_odd /\ symmetric_only_if_images /\ exact_integrating_chain) /\ relay_orbits.
Proof.
  exact (conj (conj first_harmonic_nonlinear_holds first_harmonic_linear_holds)
        (conj (conj symmetric_only_if_odd_holds (conj symmetric_only_if_images_holds exact_integrating_chain_holds)) relay_orbits_hold)).
Qed.
Print Assumptions statement.

(** * As printed *)

Definition as_printed : Prop := forall G F r T x, integrating G -> exact_motion G F r T x -> (exists t, x t <> r) ->
  (~ symmetric r T x <-> ~ odd F).

(** A characteristic that is odd where it is swept, and nowhere else: held at -1 and at 2. *)
Theorem as_printed_false : ~ as_printed.
Proof.
  intros H. pose proof PI_RGT_0. set (F := fun y => Rmax (-1) (Rmin y 2)). set (x := fun t => 0 - 1 * sin (1 * t)).
  assert (M : exact_motion third_order F 0 (2 * PI) x).
  { split; [apply sinusoid_periodic|]. intros t. destruct (sinusoid_jet 0 1 1 t) as [D1 [D2 D3]]. fold x in D1, D2, D3.
    unfold third_order, jet. rewrite D1, D2, D3. unfold F, x. destruct (SIN_bound (1 * t)). rewrite Rmin_left, Rmax_right by lra. field. }
  assert (O : ~ odd F) by (intros O; specialize (O 2); unfold F, Rmax, Rmin in O; revert O; by_cases; lra).
  assert (N : exists t, x t <> 0) by (exists (PI / 2); unfold x; rewrite !Rmult_1_l, sin_PI2; lra).
  apply (proj2 (H third_order F 0 (2 * PI) x (proj1 third_order_integrating) M N) O). unfold symmetric.
  apply (equal _ _ _ (2 * PI * 0)); [|ring]. refine (ext _ _ _ _ _ _ _ (sinusoid_integral 0 1)); [lra|]. intros t _. unfold x. ring.
Qed.

(** Without an even part of one sign, on the first harmonic: [F = x + x^2 - 1/2] with [2/(s (s + 1)^2)] balances without bias at the
    amplitude 1, and is not odd on the sweep. *)
Theorem needs_even_part_of_one_sign : exists d, let F := eval [- (1 / 2); 1; 1] in
  not_zero_on_an_interval 1 (static F) 1 /\ describes (static F) 0 1 d /\ f0 d = 0 /\
  (1 + (p d, q d) * (2 / (Ci * ((Ci + 1) * (Ci + 1)))))%C = 0%C.
Proof.
  exists (polynomial_df [- (1 / 2); 1; 1] 0 1). cbv zeta. split; [apply Claim_lemma_2.needs_even_part_of_one_sign|].
  split; [apply Claim_polynomial.statement|]. split; [simpl; field|].
  assert (P : p (polynomial_df [- (1 / 2); 1; 1] 0 1) = 1) by (simpl; field).
  rewrite P. simpl (q _).
  replace (Ci * ((Ci + 1) * (Ci + 1)))%C with (RtoC (-2)) by (unfold Ci, RtoC, Cmult, Cplus; simpl; f_equal; ring).
  unfold Cdiv, Cinv, RtoC, Cmult, Cplus; simpl. f_equal; field.
Qed.

(** Without integrator an odd nondecreasing characteristic oscillates asymmetrically about a reference. *)
Theorem needs_integrating : exists x T, odd saturation /\ nondecreasing saturation /\
  exact_motion static_process saturation (9 / 2) T x /\ (exists t, x t <> 4) /\ ~ symmetric (9 / 2) T x.
Proof. exact Claim_theorem_2.needs_integrating. Qed.
