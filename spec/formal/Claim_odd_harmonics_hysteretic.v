(** odd-harmonics-hysteretic (Theorem 1, with memory). Branches that are each other's image under a half-turn about the origin
    give odd harmonics only, under an unbiased sinusoid. The relay with hysteresis of the paper's experiment is of this kind; the
    paper's Theorem 1, stated for a function of x, does not cover it. *)
From Coq Require Import Reals Lra List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels Catalogue Claim_describing_function Claim_odd_harmonics.
Import ListNotations.
Open Scope R_scope.

(** Each branch is the other's image, but at single points, which no integral sees. *)
Definition branches_odd (c : characteristic) : Prop := exists points, forall x, ~ In x points -> falling c x = - rising c (- x).

(** Every such characteristic that has Fourier coefficients, every amplitude, every even order, and the mean. *)
Definition with_memory : Prop := forall (c : characteristic) (X : R) (k : nat), 0 < X -> branches_odd c ->
  let y := output c 0 X in
  (ex_RInt y 0 (2 * PI) -> mean y = 0) /\
  (ex_RInt (fun t => y t * sin (INR (2 * k) * t)) 0 (2 * PI) -> ex_RInt (fun t => y t * cos (INR (2 * k) * t)) 0 (2 * PI) ->
   sine_part (2 * k) y = 0 /\ cosine_part (2 * k) y = 0).

(** The relay of the experiment. *)
Definition relay_is_of_the_kind : Prop := forall C x_a : R, branches_odd (relay_hysteresis C x_a 0).

Theorem statement : with_memory /\ relay_is_of_the_kind.
Proof.
  split.
  - intros c X k HX [points image] y. pose proof PI_RGT_0.
    set (exact_ := {| rising := rising c; falling := fun x => - rising c (- x) |}).
    assert (E : half_turn_images exact_) by (intros x; reflexivity).
    destruct (output_off points c exact_ 0 X HX) as [times off].
    { intros x _ N. simpl. split; [reflexivity|now apply image]. }
    assert (same : forall (w : R -> R) l, is_RInt (fun t => output exact_ 0 X t * w t) 0 (2 * PI) l ->
                     is_RInt (fun t => y t * w t) 0 (2 * PI) l).
    { intros w l. apply (ext_off times); [lra|]. intros t T O. unfold y. now rewrite off. }
    assert (back : forall w : R -> R, ex_RInt (fun t => y t * w t) 0 (2 * PI) -> ex_RInt (fun t => output exact_ 0 X t * w t) 0 (2 * PI)).
    { intros w [l I]. exists l. refine (ext_off times _ _ _ _ _ _ _ I); [lra|]. intros t T O. unfold y. now rewrite off. }
    split.
    + intros [l I]. unfold mean. rewrite (RInt_of y 0 (2 * PI) 0); [field; lra|].
      apply (ext (fun t => y t * 1)); [lra|intros; ring|]. apply same, half_turn_images_cancel; trivial.
      apply back. exists l. apply (ext y); [lra|intros; ring|exact I].
    + intros Es Ec. unfold sine_part, cosine_part.
      rewrite (RInt_of _ _ _ _ (same _ _ (half_turn_images_cancel exact_ X _ E (sin_even k) (back _ Es)))).
      rewrite (RInt_of _ _ _ _ (same _ _ (half_turn_images_cancel exact_ X _ E (cos_even k) (back _ Ec)))).
      split; field; lra.
  - intros C x_a. exists [x_a; - x_a]. intros x N. simpl in N. unfold relay_hysteresis, select. simpl.
    destruct (Rlt_dec 0 (x - - x_a)), (Rlt_dec 0 (- x - x_a)); try lra; exfalso; apply N; right; left; lra.
Qed.
Print Assumptions statement.

(** Unequal levels: the mean is their offset. *)
Theorem needs_branches_odd : exists C x_a d X, 0 < x_a < X /\ mean (output (relay_hysteresis C x_a d) 0 X) <> 0.
Proof.
  exists 1, 1, (1 / 2), 2. split; [lra|].
  assert (D := relay_holds 1 1 0 2 (1 / 2) ltac:(lra) ltac:(lra)). rewrite Rabs_R0 in D. specialize (D ltac:(lra)).
  destruct (definition_holds _ _ 2 _ Rlt_0_2 D) as [M _]. rewrite M. simpl (f0 _). rewrite Rplus_0_r, Rminus_0_r. pose proof PI_RGT_0.
  match goal with |- ?v <> 0 => replace v with (1 / 2) by (field; lra) end. lra.
Qed.

(** A bias. *)
Theorem needs_unbiased : exists C x_a B X, 0 < x_a /\ x_a + Rabs B <= X /\ mean (output (relay_hysteresis C x_a 0) B X) <> 0.
Proof.
  exists 1, (1 / 2), (1 / 2), 1. rewrite Rabs_right by lra. split; [lra|]. split; [lra|].
  assert (D := relay_holds 1 (1 / 2) (1 / 2) 1 0 ltac:(lra) ltac:(lra)). rewrite Rabs_right in D by lra. specialize (D ltac:(lra)).
  destruct (definition_holds _ _ 1 _ Rlt_0_1 D) as [M _]. rewrite M. simpl (f0 _). pose proof PI_RGT_0.
  replace ((1 / 2 + 1 / 2) / 1) with 1 by field. replace ((1 / 2 - 1 / 2) / 1) with 0 by field. rewrite asin_1, asin_0.
  match goal with |- ?v <> 0 => replace v with (1 / 2) by (field; lra) end. lra.
Qed.
