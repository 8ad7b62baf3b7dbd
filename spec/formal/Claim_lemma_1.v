(** lemma-1 (Lemma 1). As printed: an odd characteristic has mean output zero if and only if the input has no bias. "If" holds;
    "only if" does not. As corrected: where the characteristic is odd, nondecreasing and not zero somewhere inside the sweep, the
    mean output has the sign of the bias, and so vanishes with it and only with it. With memory: where the falling branch is the
    half-turn image of the rising one. *)
From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels Moments Abel Claim_polynomial.
Import ListNotations.
Open Scope R_scope.

(** * As corrected *)

(** The rising branch rises somewhere inside the sweep or its mirror image. *)
Definition rises_inside (F : R -> R) (B X : R) : Prop :=
  exists u v, - (X + Rabs B) < u /\ u < v /\ v < X + Rabs B /\ F u < F v.

Definition sign_of_bias (c : characteristic) (B X : R) : Prop :=
  let y := output c B X in
  ex_RInt y 0 (2 * PI) /\ (0 < B -> 0 < mean y) /\ (B < 0 -> mean y < 0) /\ (B = 0 -> mean y = 0).

Definition with_memory : Prop := forall (c : characteristic) (B X : R), 0 < X ->
  nondecreasing (rising c) -> half_turn_images c -> rises_inside (rising c) B X -> sign_of_bias c B X.

Definition without_memory : Prop := forall (F : R -> R) (B X : R), 0 < X ->
  odd F -> nondecreasing F -> (exists x, B - X < x < B + X /\ F x <> 0) ->
  sign_of_bias (static F) B X /\ (mean (output (static F) B X) = 0 <-> B = 0).

(** Nothing less will do: where the rising branch does not rise inside, the mean vanishes at this bias. *)
Definition only_where_it_rises : Prop := forall (c : characteristic) (B X : R), 0 < X ->
  nondecreasing (rising c) -> half_turn_images c -> ~ rises_inside (rising c) B X -> mean (output c B X) = 0.

(** "If", without monotony. *)
Definition unbiased_has_no_mean : Prop := forall (F : R -> R) (X : R), odd F ->
  ex_RInt (output (static F) 0 X) 0 (2 * PI) -> mean (output (static F) 0 X) = 0.

(** The lemma read as "at every amplitude", without monotony: it fails only where the characteristic is odd about the bias too,
    hence periodic with twice the bias. *)
Definition at_every_amplitude : Prop := forall (F : R -> R) (B : R), odd F -> (forall x : R, continuous F x) ->
  ((forall X, 0 < X -> mean (output (static F) B X) = 0) <-> (forall x, F (B + x) = - F (B - x))) /\
  ((forall X, 0 < X -> mean (output (static F) B X) = 0) <-> (forall x, F (x + 2 * B) = F x)).

(** On any waveform of mirrored half waves about a bias, not the sinusoid alone: so the lemma speaks of exact oscillations too. *)
Definition on_mirrored_half_waves : Prop := forall (F s : R -> R) (B h l : R), 0 < h -> odd F -> nondecreasing F ->
  continuity s -> (forall t, s (t + h) = - s t) ->
  (exists x t, Rabs x < Rabs (s t) + Rabs B /\ F x <> 0) ->
  is_RInt (fun t => F (B + s t)) 0 (h + h) l -> (0 < B -> 0 < l) /\ (B < 0 -> l < 0) /\ (B = 0 -> l = 0).

(** * Proof *)

(** A rise between two points is a rise between two neighbours of a chain between them, as near as one likes. *)
Lemma chain (F : R -> R) u h : forall n, F u < F (u + INR n * h) -> exists k, (k < n)%nat /\ F (u + INR k * h) < F (u + INR (S k) * h).
Proof.
  induction n as [|n IH]; intros H; [exfalso; simpl in H; replace (u + 0 * h) with u in H by ring; lra|].
  destruct (Rlt_dec (F (u + INR n * h)) (F (u + INR (S n) * h))) as [L|L]; [exists n; auto|].
  destruct IH as [k [Hk HF]]; [lra|]. exists k. auto.
Qed.

Lemma close_rise (F : R -> R) u v w : 0 < w -> u < v -> F u < F v -> exists p q, u <= p /\ p < q /\ q <= v /\ q - p < w /\ F p < F q.
Proof.
  intros Hw Huv HF. destruct (archimed ((v - u) / w)) as [Ha _]. set (n := Z.to_nat (up ((v - u) / w))).
  assert (P : 0 < (v - u) / w) by (apply Rdiv_lt_0_compat; lra).
  assert (N : (v - u) / w < INR n) by (unfold n; rewrite INR_IZR_INZ, Z2Nat.id; [exact Ha|apply le_IZR; lra]).
  assert (N0 : 0 < INR n) by lra. set (h := (v - u) / INR n).
  assert (E : INR n * h = v - u) by (unfold h; field; lra).
  assert (Hh : 0 < h) by (apply Rdiv_lt_0_compat; lra).
  assert (Hhw : h < w).
  { apply (Rmult_lt_reg_l (INR n)); [lra|]. rewrite E. apply (Rmult_lt_compat_r w) in N; [|lra].
    replace ((v - u) / w * w) with (v - u) in N by (field; lra). lra. }
  destruct (chain F u h n) as [k [Hk HF']]; [replace (u + INR n * h) with v by lra; exact HF|].
  exists (u + INR k * h), (u + INR (S k) * h). pose proof (pos_INR k).
  assert (K1 : INR (S k) <= INR n) by (apply le_INR; lia). rewrite S_INR in K1.
  assert (0 <= INR k * h) by (apply Rmult_le_pos; lra).
  assert ((INR k + 1) * h <= INR n * h) by (apply Rmult_le_compat_r; lra).
  rewrite S_INR in *. repeat split; lra || exact HF'.
Qed.

(** Angles of the rising half between two ratios. *)
Lemma between_angles a b t : -1 <= a <= 1 -> -1 <= b <= 1 -> asin a < t < asin b -> a < sin t < b.
Proof.
  intros A B T. pose proof (asin_bound a). pose proof (asin_bound b).
  rewrite <- (sin_asin a), <- (sin_asin b) by assumption. split; apply sin_increasing_1; lra.
Qed.

(** For a positive bias: what the rising branch gives there, less what it gives at the mirrored bias. *)
Lemma pair_positive (F : R -> R) (B X l : R) : 0 < X -> nondecreasing F -> 0 < B -> rises_inside F B X ->
  is_RInt (fun t => F (sweep B X t) - F (sweep (- B) X t)) (- (PI / 2)) (PI / 2) l -> 0 < l.
Proof.
  intros HX mono HB [u [v [Hu [Huv [Hv HF]]]]] I. rewrite Rabs_right in Hu, Hv by lra.
  destruct (close_rise F u v (2 * B)) as [p [q [H1 [H2 [H3 [H4 H5]]]]]]; try lra.
  set (s := Rmax (q - B) (- X)). set (r := Rmin (p + B) X).
  assert (S : - X <= s <= X /\ - X <= r <= X /\ q - B <= s /\ r <= p + B /\ s < r).
  { unfold s, r, Rmax, Rmin. destruct (Rle_dec (q - B) (- X)), (Rle_dec (p + B) X); lra. }
  assert (unit_ : forall z, - X <= z <= X -> -1 <= z / X <= 1).
  { intros z Hz. split; apply (Rmult_le_reg_r X); trivial; unfold Rdiv; rewrite Rmult_assoc, Rinv_l; lra. }
  assert (D : s / X < r / X) by (apply Rmult_lt_compat_r; [now apply Rinv_0_lt_compat|lra]).
  pose proof (unit_ s ltac:(lra)) as Us. pose proof (unit_ r ltac:(lra)) as Ur.
  pose proof (asin_bound (s / X)). pose proof (asin_bound (r / X)).
  assert (A : asin (s / X) < asin (r / X)).
  { destruct (Rlt_le_dec (asin (s / X)) (asin (r / X))) as [L|L]; [exact L|exfalso].
    apply sin_incr_1 in L; try lra. rewrite !sin_asin in L; lra. }
  apply (positive _ (- (PI / 2)) (asin (s / X)) (asin (r / X)) (PI / 2) (F q - F p) l) in I; trivial; try lra.
  - intros t _. assert (F (sweep (- B) X t) <= F (sweep B X t)) by (apply mono; unfold sweep; lra). lra.
  - intros t T. apply between_angles in T; trivial.
    assert (X * (s / X) = s) by (field; lra). assert (X * (r / X) = r) by (field; lra).
    assert (s < X * sin t < r) by (split; [rewrite <- H6|rewrite <- H7]; apply Rmult_lt_compat_l; lra).
    assert (F q <= F (sweep B X t)) by (apply mono; unfold sweep; lra).
    assert (F (sweep (- B) X t) <= F p) by (apply mono; unfold sweep; lra). lra.
Qed.

(** The mean output is that of the pair. *)
Lemma mean_of_pair c B X : 0 < X -> nondecreasing (rising c) -> half_turn_images c ->
  exists l, is_RInt (output c B X) 0 (2 * PI) l /\
    is_RInt (fun t => rising c (sweep B X t) - rising c (sweep (- B) X t)) (- (PI / 2)) (PI / 2) l.
Proof.
  intros HX mono image. pose proof PI_RGT_0.
  assert (I : forall b, is_RInt (fun t => rising c (sweep b X t)) (- (PI / 2)) (PI / 2) (RInt (fun t => rising c (sweep b X t)) (- (PI / 2)) (PI / 2))).
  { intros b. apply integral_of, nondecreasing_on_sweep; [lra|exact mono]. }
  exists (RInt (fun t => rising c (sweep B X t)) (- (PI / 2)) (PI / 2) - RInt (fun t => rising c (sweep (- B) X t)) (- (PI / 2)) (PI / 2)).
  split; [|now apply subtract]. apply mean_by_branches; [apply I|].
  apply (ext (fun t => - rising c (sweep (- B) X (0 - t)))); [lra| |].
  - intros t _. rewrite image. do 2 f_equal. unfold sweep. rewrite Rminus_0_l, sin_neg. ring.
  - apply negate, (backwards (fun t => rising c (sweep (- B) X t))).
    replace (0 - PI / 2) with (- (PI / 2)) by ring. replace (0 - - (PI / 2)) with (PI / 2) by ring. apply I.
Qed.

Lemma with_memory_holds : with_memory.
Proof.
  intros c B X HX mono image rise. unfold sign_of_bias. set (y := output c B X). pose proof PI_RGT_0. destruct (mean_of_pair c B X HX mono image) as [l [M I]].
  assert (E : mean y = l / (2 * PI)) by (unfold mean, y; now rewrite (RInt_of _ _ _ _ M)). rewrite E.
  assert (P : 0 < / (2 * PI)) by (apply Rinv_0_lt_compat; lra).
  split; [now exists l|]. split; [|split]; intros HB.
  - apply Rmult_lt_0_compat; [|exact P]. now apply (pair_positive (rising c) B X l).
  - assert (0 < - l).
    { apply (pair_positive (rising c) (- B) X (- l)); trivial; [lra|unfold rises_inside in *; now rewrite Rabs_Ropp|].
      rewrite Ropp_involutive. refine (ext _ _ _ _ _ _ _ (negate _ _ _ _ I)); [lra|intros; ring]. }
    unfold Rdiv. nra.
  - subst B. rewrite Ropp_0 in I.
    assert (Z : is_RInt (fun t => rising c (sweep 0 X t) - rising c (sweep 0 X t)) (- (PI / 2)) (PI / 2) 0).
    { apply (ext (fun _ => 0)); [lra|intros; ring|apply zero_integral]. }
    apply RInt_of in I, Z. rewrite I in Z. rewrite Z. unfold Rdiv. ring.
Qed.

Lemma only_where_it_rises_holds : only_where_it_rises.
Proof.
  intros c B X HX mono image N. pose proof PI_RGT_0. destruct (mean_of_pair c B X HX mono image) as [l [M I]].
  unfold mean. rewrite (RInt_of _ _ _ _ M). replace l with 0; [field; lra|].
  rewrite <- (RInt_of _ _ _ _ I). symmetry. apply RInt_of. apply (ext (fun _ => 0)); [lra| |apply zero_integral].
  intros t T. assert (S : -1 < sin t < 1).
  { replace 1 with (sin (PI / 2)) by exact sin_PI2. replace (- sin (PI / 2)) with (sin (- (PI / 2))) by now rewrite sin_neg.
    replace (-1) with (sin (- (PI / 2))) by (rewrite sin_neg, sin_PI2; ring). split; apply sin_increasing_1; lra. }
  assert (A : forall b, - Rabs B <= b <= Rabs B -> - (X + Rabs B) < sweep b X t < X + Rabs B) by (intros b Hb; unfold sweep; nra).
  assert (- Rabs B <= B <= Rabs B /\ - Rabs B <= - B <= Rabs B) by (unfold Rabs; destruct (Rcase_abs B); lra).
  pose proof (A B ltac:(lra)) as A1. pose proof (A (- B) ltac:(lra)) as A2.
  destruct (Rtotal_order (sweep B X t) (sweep (- B) X t)) as [L|[L|L]]; [| rewrite L; ring|].
  - assert (rising c (sweep B X t) <= rising c (sweep (- B) X t)) by (apply mono; lra).
    destruct (Rlt_dec (rising c (sweep B X t)) (rising c (sweep (- B) X t))) as [R|]; [exfalso; apply N; do 2 eexists; repeat split; [| | |exact R]; lra|lra].
  - assert (rising c (sweep (- B) X t) <= rising c (sweep B X t)) by (apply mono; lra).
    destruct (Rlt_dec (rising c (sweep (- B) X t)) (rising c (sweep B X t))) as [R|]; [exfalso; apply N; do 2 eexists; repeat split; [| | |exact R]; lra|lra].
Qed.

Lemma without_memory_holds : without_memory.
Proof.
  intros F B X HX Hodd mono [x [Hx Fx]].
  assert (S : sign_of_bias (static F) B X).
  { apply with_memory_holds; trivial; [now apply odd_is_its_image|].
    assert (N : x <> 0) by (intros ->; apply Fx; specialize (Hodd 0); rewrite Ropp_0 in Hodd; lra).
    exists (- Rabs x), (Rabs x). pose proof (Rabs_pos_lt x N).
    assert (Rabs x < X + Rabs B) by (unfold Rabs; destruct (Rcase_abs x), (Rcase_abs B); lra).
    repeat split; try lra. simpl. assert (L : F (- Rabs x) <= F (Rabs x)) by (apply mono; lra). rewrite Hodd in *.
    assert (F (Rabs x) <> 0); [|lra]. unfold Rabs. destruct (Rcase_abs x); [rewrite Hodd; lra|exact Fx]. }
  split; [exact S|]. destruct S as [_ [S1 [S2 S3]]]. split; [|exact S3]. intros Z.
  destruct (Rtotal_order B 0) as [L|[L|L]]; [apply S2 in L; lra|exact L|apply S1 in L; lra].
Qed.

Lemma unbiased_holds : unbiased_has_no_mean.
Proof.
  intros F X Hodd [l I]. pose proof PI_RGT_0. unfold mean.
  assert (E : ex_RInt (fun t => output (static F) 0 X t * 1) 0 (2 * PI)).
  { exists l. apply (ext (output (static F) 0 X)); [lra|intros; ring|exact I]. }
  pose proof (half_turn_images_cancel (static F) X (fun _ => 1) (odd_is_its_image F Hodd) (fun _ => eq_refl) E) as Z.
  rewrite (RInt_of _ 0 (2 * PI) 0); [field; lra|].
  refine (ext _ _ _ _ _ _ _ Z); [lra|intros; ring].
Qed.

Lemma at_every_amplitude_holds : at_every_amplitude.
Proof.
  intros F B Hodd cont.
  assert (A : (forall X, 0 < X -> mean (output (static F) B X) = 0) <-> (forall x, F (B + x) = - F (B - x))).
  { pose proof (mean_zero_at_every_amplitude (static F) B cont cont) as A. unfold both_branches in A; simpl in A.
    split; [intros H x; pose proof (proj1 A H x); lra|intros H; apply A; intros x; rewrite H; ring]. }
  split; [exact A|]. rewrite A. split; intros H x.
  - replace (x + 2 * B) with (B + (x + B)) by ring. rewrite H. replace (B - (x + B)) with (- x) by ring. rewrite Hodd. ring.
  - replace (B + x) with (x - B + 2 * B) by ring. rewrite H, <- Hodd. f_equal. ring.
Qed.

(** A value that an odd function does not take at zero is a rise. *)
Lemma odd_rise (F : R -> R) x : odd F -> nondecreasing F -> F x <> 0 -> 0 < Rabs x /\ F (- Rabs x) < F (Rabs x).
Proof.
  intros Hodd mono Fx. assert (N : x <> 0) by (intros ->; apply Fx; specialize (Hodd 0); rewrite Ropp_0 in Hodd; lra).
  pose proof (Rabs_pos_lt x N). split; [assumption|].
  assert (L : F (- Rabs x) <= F (Rabs x)) by (apply mono; lra). rewrite Hodd in *.
  assert (F (Rabs x) <> 0); [|lra]. unfold Rabs. destruct (Rcase_abs x); [rewrite Hodd; lra|exact Fx].
Qed.

(** Every value between the extremes occurs, and stays near for a while. *)
Lemma occurs (s : R -> R) h t0 y e : continuity s -> (forall t, s (t + h) = - s t) -> 0 < e -> - Rabs (s t0) <= y <= Rabs (s t0) ->
  exists t d, s t = y /\ 0 < d /\ forall r, t < r < t + d -> Rabs (s r - y) < e.
Proof.
  intros cs flip He Hy.
  destruct (IVT_gen s t0 (t0 + h) y cs) as [t [_ E]].
  { rewrite flip. unfold Rabs in Hy. unfold Rmin, Rmax. destruct (Rcase_abs (s t0)), (Rle_dec (s t0) (- s t0)); lra. }
  destruct (cs t e He) as [d [Hd near]]. exists t, d. split; [exact E|]. split; [exact Hd|]. intros r Hr. rewrite <- E.
  apply (near r). split; [split; [exact I|lra]|]. simpl. unfold R_dist. rewrite Rabs_right; lra.
Qed.

Lemma mirrored_positive (F s : R -> R) (B h l : R) : 0 < h -> odd F -> nondecreasing F -> continuity s ->
  (forall t, s (t + h) = - s t) -> (exists x t, Rabs x < Rabs (s t) + Rabs B /\ F x <> 0) -> 0 < B ->
  is_RInt (fun t => F (B + s t) - F (- B + s t)) 0 h l -> 0 < l.
Proof.
  intros Hh Hodd mono cs flip [x [t0 [Hx Fx]]] HB I. rewrite (Rabs_right B) in Hx by lra.
  destruct (odd_rise F x Hodd mono Fx) as [Px rise]. set (X := Rabs (s t0)) in *. pose proof (Rabs_pos (s t0)) as HX. fold X in HX.
  destruct (close_rise F (- Rabs x) (Rabs x) (2 * B)) as [u [v [H1 [H2 [H3 [H4 H5]]]]]]; try lra.
  set (low := Rmax (v - B) (- X)). set (high := Rmin (u + B) X).
  assert (S : v - B <= low /\ - X <= low /\ high <= u + B /\ high <= X /\ low <= high /\ (low < high \/ X = 0)).
  { unfold low, high, Rmax, Rmin. destruct (Rle_dec (v - B) (- X)), (Rle_dec (u + B) X); lra. }
  set (y := (low + high) / 2).
  assert (room : exists e, 0 < e /\ forall z, Rabs (z - y) < e -> v - B <= z <= u + B).
  { destruct S as [S1 [S2 [S3 [S4 [S5 [S6|S6]]]]]].
    - exists ((high - low) / 2). split; [lra|]. intros z Hz. apply Rabs_def2 in Hz. unfold y in Hz. lra.
    - assert (Y : y = 0) by (unfold y; lra). exists (B - Rabs x). split; [lra|]. intros z Hz. rewrite Y, Rminus_0_r in Hz.
      apply Rabs_def2 in Hz. lra. }
  destruct room as [e [He room]].
  destruct (occurs s h t0 y e cs flip He) as [t [d [Et [Hd near]]]]; [unfold y; fold X; lra|].
  assert (per : forall r, F (B + s (r + h)) - F (- B + s (r + h)) = F (B + s r) - F (- B + s r)).
  { intros r. rewrite flip. replace (B + - s r) with (- (- B + s r)) by ring. replace (- B + - s r) with (- (B + s r)) by ring.
    rewrite !Hodd. ring. }
  pose proof (any_period _ h t l Hh per I) as J.
  apply (positive _ t t (Rmin (t + d) (t + h)) (t + h) (F v - F u) l) in J; trivial; try lra.
  - unfold Rmin. destruct (Rle_dec (t + d) (t + h)); lra.
  - apply Rmin_r.
  - intros r _. assert (F (- B + s r) <= F (B + s r)) by (apply mono; lra). lra.
  - intros r Hr. assert (Hr' : t < r < t + d) by (pose proof (Rmin_l (t + d) (t + h)); lra).
    pose proof (room _ (near r Hr')). assert (F v <= F (B + s r)) by (apply mono; lra). assert (F (- B + s r) <= F u) by (apply mono; lra). lra.
Qed.

Lemma on_mirrored_half_waves_holds : on_mirrored_half_waves.
Proof.
  intros F s B h l Hh Hodd mono cs flip inside I.
  (* the second half wave is the first one's pair *)
  destruct (both_parts _ 0 h (h + h) ltac:(lra) (ex_intro _ l I)) as [[l1 I1] [l2 I2]].
  assert (L : l = l1 + l2) by (rewrite <- (RInt_of _ _ _ _ I); apply RInt_of; now apply join with h).
  assert (I2' : is_RInt (fun t => - F (- B + s t)) 0 h l2).
  { apply (ext (fun t => F (B + s (t + h)))); [lra| |].
    - intros t _. rewrite flip, <- Hodd. f_equal. ring.
    - apply (later (fun t => F (B + s t)) h). rewrite Rplus_0_l. exact I2. }
  assert (J : is_RInt (fun t => F (B + s t) - F (- B + s t)) 0 h l).
  { rewrite L. refine (ext _ _ _ _ _ _ _ (add _ _ _ _ _ _ I1 I2')); [lra|intros; ring]. }
  split; [|split]; intros HB.
  - now apply (mirrored_positive F s B h l).
  - assert (0 < - l); [|lra]. apply (mirrored_positive F s (- B) h (- l)); trivial; [now rewrite Rabs_Ropp|lra|].
    rewrite Ropp_involutive. refine (ext _ _ _ _ _ _ _ (negate _ _ _ _ J)); [lra|intros; ring].
  - subst B. rewrite <- (RInt_of _ _ _ _ J). apply RInt_of. apply (ext (fun _ => 0)); [lra| |apply zero_integral].
    intros t _. rewrite Ropp_0. ring.
Qed.

Theorem statement : with_memory /\ only_where_it_rises /\ without_memory /\ unbiased_has_no_mean /\
  at_every_amplitude /\ on_mirrored_half_waves.
Proof.
  exact (conj with_memory_holds (conj only_where_it_rises_holds (conj without_memory_holds (conj unbiased_holds
          (conj at_every_amplitude_holds on_mirrored_half_waves_holds))))).
Qed.
Print Assumptions statement.

(** * As printed *)

Definition as_printed : Prop := forall (F : R -> R) (B X : R), 0 < X -> odd F ->
  ex_RInt (output (static F) B X) 0 (2 * PI) -> (mean (output (static F) B X) = 0 <-> B = 0).

(** Read as "at every amplitude". *)
Definition as_printed_at_every_amplitude : Prop := forall (F : R -> R) (B : R), odd F -> (forall x : R, continuous F x) ->
  ((forall X, 0 < X -> mean (output (static F) B X) = 0) <-> B = 0).

Lemma mean_of_polynomial c B X l : mean_sum X 0 (about_bias B c) = l ->
  ex_RInt (output (static (eval c)) B X) 0 (2 * PI) /\ mean (output (static (eval c)) B X) = l.
Proof.
  intros E. pose proof PI_RGT_0. destruct (Claim_polynomial.statement c B X) as [[M _] _].
  split; [eexists; exact M|]. unfold mean. rewrite (RInt_of _ _ _ _ M). simpl (f0 _). rewrite E. field. lra.
Qed.

(** [F = x^3 - 2 x], [X = 1], [x_0 = 1/sqrt(2)]. *)
Theorem as_printed_false : ~ as_printed.
Proof.
  intros H. set (B := / sqrt 2).
  assert (S : 0 < sqrt 2) by (apply sqrt_lt_R0; lra). assert (Q : B * B = / 2).
  { unfold B. rewrite <- Rinv_mult. f_equal. apply sqrt_sqrt. lra. }
  destruct (mean_of_polynomial [0; -2; 0; 1] B 1 0) as [E M].
  { simpl. match goal with |- ?l = 0 => replace l with (B * (B * B - / 2)) by field end. rewrite Q. ring. }
  assert (B = 0); [|assert (0 < B) by (now apply Rinv_0_lt_compat); lra].
  apply (H (eval [0; -2; 0; 1]) B 1); trivial; [lra|]. intros x. simpl. ring.
Qed.

Lemma sine_about_pi X : 0 < X -> mean (output (static sin) PI X) = 0.
Proof.
  apply (proj1 (at_every_amplitude_holds sin PI sin_neg (fun x => ex_derive_continuous sin x ltac:(auto_derive; trivial)))).
  intros x. rewrite Rplus_comm, sin_plus_pi, sin_PI_x. reflexivity.
Qed.

(** [F = sin], [x_0 = pi], every amplitude: without monotony. *)
Theorem as_printed_at_every_amplitude_false : ~ as_printed_at_every_amplitude.
Proof.
  intros H. pose proof PI_RGT_0. assert (PI = 0); [|lra].
  apply (H sin PI sin_neg (fun x => ex_derive_continuous sin x ltac:(auto_derive; trivial))). exact sine_about_pi.
Qed.

Theorem needs_nondecreasing : odd sin /\ forall X, 0 < X ->
  (exists x, PI - X < x < PI + X /\ sin x <> 0) /\ mean (output (static sin) PI X) = 0 /\ PI <> 0.
Proof.
  pose proof PI_RGT_0. split; [exact sin_neg|]. intros X HX. split; [|split; [now apply sine_about_pi|lra]].
  exists (PI - Rmin X 1 / 2). pose proof (Rmin_l X 1). pose proof (Rmin_r X 1). assert (0 < Rmin X 1) by (apply Rmin_pos; lra).
  split; [lra|]. rewrite sin_PI_x. apply Rgt_not_eq, sin_gt_0; pose proof PI2_1; lra.
Qed.

(** [F = x + 1/2] at [x_0 = -1/2]. *)
Theorem needs_odd : let F := fun x => x + 1 / 2 in
  nondecreasing F /\ forall X, 0 < X -> (exists x, - (1 / 2) - X < x < - (1 / 2) + X /\ F x <> 0) /\ mean (output (static F) (- (1 / 2)) X) = 0.
Proof.
  cbv zeta. split; [intros a b; lra|]. intros X HX. split; [exists (- (1 / 2) + X / 2); lra|].
  destruct (mean_of_polynomial [1 / 2; 1] (- (1 / 2)) X 0) as [_ M]; [simpl; field|]. rewrite <- M. unfold mean. f_equal.
  apply RInt_ext. intros t _. rewrite !output_static. simpl. ring.
Qed.

(** A dead zone that is wider than the sweep. *)
Definition dead_zone (width x : R) : R := Rmax (x - width) 0 - Rmax (- x - width) 0.
Theorem needs_not_zero_on_sweep : forall width B X, 0 < X -> Rabs B + X <= width ->
  odd (dead_zone width) /\ nondecreasing (dead_zone width) /\ mean (output (static (dead_zone width)) B X) = 0.
Proof.
  intros width B X HX H. assert (A : - Rabs B <= B <= Rabs B) by (unfold Rabs; destruct (Rcase_abs B); lra).
  split; [|split].
  - intros x. unfold dead_zone. rewrite Ropp_involutive. ring.
  - intros a b ab. unfold dead_zone, Rmax. by_cases; lra.
  - unfold mean. pose proof PI_RGT_0. rewrite (RInt_of _ 0 (2 * PI) 0); [field; lra|].
    apply (ext (fun _ => 0)); [lra| |apply zero_integral]. intros t _. rewrite output_static. unfold sweep, dead_zone.
    destruct (SIN_bound t). rewrite !Rmax_right by nra. ring.
Qed.

(** Not zero on the closed sweep alone is not enough: a value at the turning point does not count. *)
Definition turning_point_only (x : R) : R := if Rle_dec 2 x then 1 else if Rle_dec x (- 2) then -1 else 0.
Theorem closed_sweep_is_not_enough : odd turning_point_only /\ nondecreasing turning_point_only /\
  turning_point_only (1 + 1) <> 0 /\ mean (output (static turning_point_only) 1 1) = 0.
Proof.
  unfold turning_point_only. split; [|split; [|split]].
  - intros x. destruct (Rle_dec 2 (- x)), (Rle_dec (- x) (- 2)), (Rle_dec 2 x), (Rle_dec x (- 2)); lra.
  - intros a c ac. destruct (Rle_dec 2 a), (Rle_dec a (- 2)), (Rle_dec 2 c), (Rle_dec c (- 2)); lra.
  - destruct (Rle_dec 2 (1 + 1)); lra.
  - unfold mean. pose proof PI_RGT_0. rewrite (RInt_of _ 0 (2 * PI) 0); [field; lra|].
    apply (ext_off [PI / 2] (fun _ => 0)); [lra| |apply zero_integral].
    intros t T N. rewrite output_static. unfold sweep. simpl in N.
    assert (L : sin t < 1).
    { destruct (Rle_lt_or_eq_dec _ _ (proj2 (SIN_bound t))) as [L|E]; [exact L|exfalso]. apply N. left.
      destruct (Rlt_dec t PI) as [P|P].
      - rewrite <- (asin_sin (PI / 2)) by lra. rewrite sin_PI2, <- E.
        destruct (Rle_dec t (PI / 2)); [apply asin_sin; lra|]. rewrite <- sin_PI_x, asin_sin by lra.
        assert (asin (sin t) = PI / 2) by (rewrite E; exact asin_1). rewrite <- sin_PI_x, asin_sin in H0 by lra. lra.
      - assert (sin t <= 0) by (apply sin_le_0; lra). lra. }
    destruct (SIN_bound t). destruct (Rle_dec 2 (1 + 1 * sin t)); [lra|]. destruct (Rle_dec (1 + 1 * sin t) (- 2)); lra.
Qed.
