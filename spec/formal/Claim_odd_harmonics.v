(** odd-harmonics (Theorem 1). An odd characteristic without memory under an unbiased sinusoid gives an output with odd harmonics
    only: the mean and every even order vanish. *)
From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels Moments Claim_polynomial.
Import ListNotations.
Open Scope R_scope.

(** Every odd characteristic that has Fourier coefficients, every amplitude, every even order. *)
Definition theorem_1 : Prop := forall (F : R -> R) (X : R) (k : nat), odd F ->
  let y := output (static F) 0 X in
  ex_RInt (fun t => y t * sin (INR (2 * k) * t)) 0 (2 * PI) ->
  ex_RInt (fun t => y t * cos (INR (2 * k) * t)) 0 (2 * PI) ->
  sine_part (2 * k) y = 0 /\ cosine_part (2 * k) y = 0.

(** The mean is the cosine part of order zero, but for a factor. *)
Definition mean_vanishes : Prop := forall (F : R -> R) (X : R), odd F ->
  let y := output (static F) 0 X in ex_RInt y 0 (2 * PI) -> mean y = 0.

(** On any waveform: what changes its sign over half a period has odd orders only. So has a symmetric oscillation, exactly. *)
Definition on_mirrored_half_waves : Prop := forall (y : R -> R) (k : nat), (forall t, y (t + PI) = - y t) ->
  ex_RInt (fun t => y t * sin (INR (2 * k) * t)) 0 PI -> ex_RInt (fun t => y t * cos (INR (2 * k) * t)) 0 PI ->
  sine_part (2 * k) y = 0 /\ cosine_part (2 * k) y = 0.

Lemma even_orders c X k : half_turn_images c -> let y := output c 0 X in
  ex_RInt (fun t => y t * sin (INR (2 * k) * t)) 0 (2 * PI) -> ex_RInt (fun t => y t * cos (INR (2 * k) * t)) 0 (2 * PI) ->
  sine_part (2 * k) y = 0 /\ cosine_part (2 * k) y = 0.
Proof.
  intros image y Es Ec. pose proof PI_RGT_0. unfold sine_part, cosine_part, y in *.
  rewrite (RInt_of _ _ _ _ (half_turn_images_cancel c X _ image (sin_even k) Es)).
  rewrite (RInt_of _ _ _ _ (half_turn_images_cancel c X _ image (cos_even k) Ec)).
  split; field; lra.
Qed.

Lemma mean_of_images c X : half_turn_images c -> let y := output c 0 X in ex_RInt y 0 (2 * PI) -> mean y = 0.
Proof.
  intros image y [l E]. pose proof PI_RGT_0. unfold mean.
  assert (E' : ex_RInt (fun t => y t * 1) 0 (2 * PI)) by (exists l; apply (ext y); [lra|intros; ring|exact E]).
  pose proof (half_turn_images_cancel c X (fun _ => 1) image (fun _ => eq_refl) E') as Z.
  rewrite (RInt_of y 0 (2 * PI) 0); [field; lra|]. apply (ext (fun t => y t * 1)); [lra|intros; ring|exact Z].
Qed.

Theorem statement : theorem_1 /\ mean_vanishes /\ on_mirrored_half_waves.
Proof.
  split; [|split].
  - intros F X k H y. now apply even_orders, odd_is_its_image.
  - intros F X H y. now apply mean_of_images, odd_is_its_image.
  - intros y k flip Es Ec. pose proof PI_RGT_0. unfold sine_part, cosine_part.
    rewrite (RInt_of _ 0 (2 * PI) 0), (RInt_of _ 0 (2 * PI) 0); [split; field; lra| |];
      apply half_period_cancels; trivial; try lra; intros t; [rewrite cos_even, flip|rewrite sin_even, flip]; ring.
Qed.
Print Assumptions statement.

(** [F = x + x^2] is not odd: harmonics 0 and 2 are not zero. *)
Lemma double_angle t : cos (INR (2 * 1) * t) = 1 - 2 * (sin t * sin t).
Proof. simpl. replace ((1 + 1) * t) with (2 * t) by ring. rewrite cos_2a_sin. ring. Qed.

Lemma by_sines (f : R -> R) (c : list R) : (forall t, f t = eval c (sin t)) -> RInt f 0 (2 * PI) = 2 * PI * mean_sum 1 0 c.
Proof.
  intros H. pose proof PI_RGT_0. apply RInt_of. destruct (integrals 1 c 0) as [I _].
  refine (ext _ _ _ _ _ _ _ I); [lra|]. intros t _. rewrite H, !Rmult_1_l. simpl. ring.
Qed.

Theorem needs_odd : exists F, let y := output (static F) 0 1 in mean y <> 0 /\ cosine_part 2 y <> 0.
Proof.
  exists (fun x => x + x * x). cbv zeta. pose proof PI_RGT_0. split.
  - unfold mean. rewrite (by_sines _ [0; 1; 1]).
    + simpl. apply Rgt_not_eq. replace (2 * PI * (0 * (1 * 1) + 1 * (1 * (1 * 1) * (1 * ((2 * 0 + 1) / (2 * 0 + 2))))) / (2 * PI)) with (1 / 2) by (field; lra). lra.
    + intros t. rewrite output_static. unfold sweep. simpl. ring.
  - unfold cosine_part. rewrite (by_sines _ [0; 1; 1; -2; -2]).
    + simpl. apply Rlt_not_eq.
      match goal with |- ?v < 0 => replace v with (- (1 / 2)) by (field; lra) end. lra.
    + intros t. rewrite output_static. change 2%nat with (2 * 1)%nat. rewrite double_angle. unfold sweep. simpl. ring.
Qed.

(** [F = x^3] under a bias: harmonics 0 and 2 are not zero. *)
Theorem needs_unbiased : exists F, odd F /\ let y := output (static F) 1 1 in mean y <> 0 /\ cosine_part 2 y <> 0.
Proof.
  exists (fun x => x * x * x). split; [intros x; ring|]. cbv zeta. pose proof PI_RGT_0. split.
  - unfold mean. rewrite (by_sines _ [1; 3; 3; 1]).
    + simpl. apply Rgt_not_eq. match goal with |- ?v > 0 => replace v with (5 / 2) by (field; lra) end. lra.
    + intros t. rewrite output_static. unfold sweep. simpl. ring.
  - unfold cosine_part. rewrite (by_sines _ [1; 3; 1; -5; -6; -2]).
    + simpl. apply Rlt_not_eq. match goal with |- ?v < 0 => replace v with (- (3 / 2)) by (field; lra) end. lra.
    + intros t. rewrite output_static. change 2%nat with (2 * 1)%nat. rewrite double_angle. unfold sweep. simpl. ring.
Qed.
