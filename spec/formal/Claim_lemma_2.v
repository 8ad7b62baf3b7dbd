(** lemma-2 (Lemma 2). As printed: the mean output of a characteristic that is not odd can vanish if and only if the input has a
    bias. Neither direction holds at one amplitude. As corrected: an even part of one sign, not zero almost everywhere on the sweep,
    gives a mean output that does not vanish without bias; with nondecreasing branches a bias at which it vanishes has the sign
    opposite to the even part's. *)
From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels Moments Abel Claim_polynomial Claim_lemma_1.
Import ListNotations.
Open Scope R_scope.

(** * As corrected *)

(** The even part of a pair of branches: [(F(x) + F(-x))/2] without memory. *)
Definition even_part (c : characteristic) (x : R) : R := (rising c x + falling c (- x)) / 2.

(** Of the sign of [s] inside the sweep, or zero. *)
Definition one_sign (s : R) (c : characteristic) (X : R) : Prop := forall x, - X < x < X -> 0 <= s * even_part c x.

(** Away from zero on an interval inside the sweep. Of a function that has an integral this is the same as "not zero almost
    everywhere": [exactly_where] below. *)
Definition not_zero_on_an_interval (s : R) (c : characteristic) (X : R) : Prop :=
  exists e a b, 0 < e /\ - X <= a /\ a < b /\ b <= X /\ forall x, a < x < b -> e <= s * even_part c x.

Definition unbiased_mean : Prop := forall (s : R) (c : characteristic) (X : R), 0 < X ->
  ex_RInt (output c 0 X) 0 (2 * PI) -> one_sign s c X -> not_zero_on_an_interval s c X -> 0 < s * mean (output c 0 X).

(** Nothing less will do. *)
Definition exactly_where : Prop := forall (s : R) (c : characteristic) (X : R), 0 < X ->
  ex_RInt (output c 0 X) 0 (2 * PI) -> 0 < s * mean (output c 0 X) -> not_zero_on_an_interval s c X.

(** A continuous characteristic: one point inside the sweep is enough. *)
Definition continuous_characteristic : Prop := forall (s : R) (F : R -> R) (X : R), 0 < X -> (forall x : R, continuous F x) ->
  one_sign s (static F) X -> (exists x, - X < x < X /\ s * even_part (static F) x <> 0) -> 0 < s * mean (output (static F) 0 X).

Definition opposite_bias : Prop := forall (s : R) (c : characteristic) (B X : R), 0 < X ->
  nondecreasing (rising c) -> nondecreasing (falling c) -> one_sign s c X -> not_zero_on_an_interval s c X ->
  mean (output c B X) = 0 -> s * B < 0.

(** Read as "at every amplitude", the "only if" of the printed lemma holds: without bias the mean vanishes at every amplitude for
    no characteristic but the odd ones. *)
Definition only_if_at_every_amplitude : Prop := forall (F : R -> R), (forall x : R, continuous F x) ->
  ((forall X, 0 < X -> mean (output (static F) 0 X) = 0) <-> odd F).

(** * Proof *)

(** Without bias the mean is that of the even part. *)
Lemma mean_of_even_part c X : ex_RInt (output c 0 X) 0 (2 * PI) ->
  is_RInt (fun t => even_part c (X * sin t)) (- (PI / 2)) (PI / 2) (PI * mean (output c 0 X)).
Proof.
  intros [l I]. pose proof PI_RGT_0.
  assert (E : ex_RInt (fun t => output c 0 X t * 1) 0 (2 * PI)) by (exists l; apply (ext (output c 0 X)); [lra|intros; ring|exact I]).
  destruct (by_branches_back c 0 X (fun _ => 1) (fun _ => eq_refl) E) as [[r Er] [f Ef]].
  pose proof (by_branches c 0 X (fun _ => 1) r f (fun _ => eq_refl) Er Ef) as M.
  assert (L : l = r + f).
  { rewrite <- (RInt_of _ _ _ _ M). symmetry. apply RInt_of. apply (ext (output c 0 X)); [lra|intros; ring|exact I]. }
  assert (Em : PI * mean (output c 0 X) = / 2 * (r + f)) by (unfold mean; rewrite (RInt_of _ _ _ _ I), L; field; lra).
  rewrite Em. assert (Eb : is_RInt (fun t => falling c (sweep 0 X (0 - t)) * 1) (- (PI / 2)) (PI / 2) f).
  { apply (backwards (fun t => falling c (sweep 0 X t) * 1)).
    replace (0 - PI / 2) with (- (PI / 2)) by ring. replace (0 - - (PI / 2)) with (PI / 2) by ring. exact Ef. }
  refine (ext _ _ _ _ _ _ _ (multiply _ (/ 2) _ _ _ (add _ _ _ _ _ _ Er Eb))); [lra|].
  intros t _. unfold even_part, sweep. rewrite Rminus_0_l, sin_neg, !Rplus_0_l.
  replace (X * - sin t) with (- (X * sin t)) by ring. field.
Qed.

Lemma inside_sweep X t : 0 < X -> - (PI / 2) < t < PI / 2 -> - X < X * sin t < X.
Proof.
  intros HX T. assert (S : -1 < sin t < 1); [|nra].
  replace 1 with (sin (PI / 2)) by exact sin_PI2. replace (- sin (PI / 2)) with (sin (- (PI / 2))) by now rewrite sin_neg.
  replace (-1) with (sin (- (PI / 2))) by (rewrite sin_neg, sin_PI2; ring). split; apply sin_increasing_1; lra.
Qed.

Lemma unbiased_mean_holds : unbiased_mean.
Proof.
  intros s c X HX I sign_ [e [a [b [He [Ha [ab [Hb low]]]]]]]. pose proof PI_RGT_0.
  pose proof (multiply _ s _ _ _ (mean_of_even_part c X I)) as M.
  assert (0 < s * (PI * mean (output c 0 X))); [|nra].
  assert (unit_ : forall z, - X <= z <= X -> -1 <= z / X <= 1).
  { intros z Hz. split; apply (Rmult_le_reg_r X); trivial; unfold Rdiv; rewrite Rmult_assoc, Rinv_l; lra. }
  assert (D : a / X < b / X) by (apply Rmult_lt_compat_r; [now apply Rinv_0_lt_compat|lra]).
  pose proof (unit_ a ltac:(lra)) as Ua. pose proof (unit_ b ltac:(lra)) as Ub.
  pose proof (asin_bound (a / X)). pose proof (asin_bound (b / X)).
  assert (A : asin (a / X) < asin (b / X)).
  { destruct (Rlt_le_dec (asin (a / X)) (asin (b / X))) as [L|L]; [exact L|exfalso].
    apply sin_incr_1 in L; try lra. rewrite !sin_asin in L; lra. }
  apply (positive _ (- (PI / 2)) (asin (a / X)) (asin (b / X)) (PI / 2) e _) in M; trivial; try lra.
  - intros t T. apply sign_. now apply inside_sweep.
  - intros t T. apply low. apply between_angles in T; trivial.
    assert (Ea : X * (a / X) = a) by (field; lra). assert (Eb : X * (b / X) = b) by (field; lra).
    split; [rewrite <- Ea|rewrite <- Eb]; apply Rmult_lt_compat_l; lra.
Qed.

Lemma exactly_where_holds : exactly_where.
Proof.
  intros s c X HX I P. pose proof PI_RGT_0.
  pose proof (multiply _ s _ _ _ (mean_of_even_part c X I)) as M.
  assert (half : - (PI / 2) < PI / 2) by lra. assert (P' : 0 < s * (PI * mean (output c 0 X))) by nra.
  destruct (positive_somewhere _ _ _ _ half M P') as [e [a [b [He [Ha [ab [Hb low]]]]]]].
  exists e, (X * sin a), (X * sin b). destruct (SIN_bound a), (SIN_bound b).
  assert (S : sin a < sin b) by (apply sin_increasing_1; lra).
  repeat split; try nra. intros x Hx.
  assert (U : -1 <= x / X <= 1).
  { split; apply (Rmult_le_reg_r X); trivial; unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra; nra. }
  assert (E : x = X * sin (asin (x / X))) by (rewrite sin_asin by exact U; field; lra).
  pose proof (asin_bound (x / X)) as Bx. rewrite E. apply low. set (t := asin (x / X)) in *.
  rewrite E in Hx. destruct Hx as [H1' H2']. apply Rmult_lt_reg_l in H1', H2'; trivial. split.
  - apply sin_increasing_0; lra.
  - apply sin_increasing_0; lra.
Qed.

Lemma continuous_output F B X : (forall x : R, continuous F x) -> ex_RInt (output (static F) B X) 0 (2 * PI).
Proof. intros cont. eexists. exact (proj1 (mean_over_quarter (static F) B X cont cont)). Qed.

Lemma continuous_characteristic_holds : continuous_characteristic.
Proof.
  intros s F X HX cont sign_ [x [Hx Fx]]. set (E := even_part (static F)).
  assert (cE : continuous E x).
  { apply (continuous_ext (fun x => / 2 * (F x + F (- x)))); [intros; unfold E, even_part; simpl; field|].
    apply (continuous_scal_r (K := R_AbsRing) (V := R_NormedModule) (/ 2)).
    apply (continuous_plus F (fun x => F (- x))); [apply cont|]. apply (continuous_comp Ropp F); [|apply cont].
    apply (ex_derive_continuous (V := R_NormedModule)). auto_derive. trivial. }
  assert (Pr : 0 < s * E x) by (specialize (sign_ x Hx); fold E in sign_, Fx; lra).
  apply unbiased_mean_holds; trivial; [now apply continuous_output|].
  assert (Hhalf : 0 < Rabs (E x) / 2) by (assert (N : E x <> 0) by (intros Z; rewrite Z in Pr; lra); pose proof (Rabs_pos_lt _ N); lra).
  destruct (proj1 (filterlim_locally (F := locally x) E (E x)) cE (mkposreal _ Hhalf)) as [[d Hd] near].
  set (b := Rmin (x + d) X). exists (s * E x / 2), x, b.
  assert (x < b <= X /\ b <= x + d) by (unfold b, Rmin; destruct (Rle_dec (x + d) X); lra).
  repeat split; try lra. intros y Hy.
  assert (By : ball x d y) by (change (Rabs (y - x) < d); rewrite Rabs_right; lra). specialize (near y By).
  change (Rabs (E y - E x) < Rabs (E x) / 2) in near. change (s * E x / 2 <= s * E y).
  apply Rabs_def2 in near. unfold Rabs in near. destruct (Rcase_abs (E x)); nra.
Qed.

(** The mean of nondecreasing branches does not fall with the bias. *)
Lemma mean_grows c B B' X : 0 < X -> nondecreasing (rising c) -> nondecreasing (falling c) -> B <= B' ->
  ex_RInt (output c B X) 0 (2 * PI) /\ mean (output c B X) <= mean (output c B' X).
Proof.
  intros HX Hr Hf BB. pose proof PI_RGT_0.
  assert (I : forall F b, nondecreasing F -> is_RInt (fun t => F (sweep b X t)) (- (PI / 2)) (PI / 2) (RInt (fun t => F (sweep b X t)) (- (PI / 2)) (PI / 2))).
  { intros F b mono. apply integral_of, nondecreasing_on_sweep; [lra|exact mono]. }
  pose proof (mean_by_branches c B X _ _ (I _ B Hr) (I _ B Hf)) as M.
  pose proof (mean_by_branches c B' X _ _ (I _ B' Hr) (I _ B' Hf)) as M'. split; [eexists; exact M|].
  unfold mean. rewrite (RInt_of _ _ _ _ M), (RInt_of _ _ _ _ M').
  apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; lra|].
  apply Rplus_le_compat; (apply RInt_le; [lra|now eexists; apply I|now eexists; apply I|]); intros t _;
    [apply Hr|apply Hf]; unfold sweep; lra.
Qed.

Lemma opposite_bias_holds : opposite_bias.
Proof.
  intros s c B X HX Hr Hf sign_ away Z.
  destruct (mean_grows c 0 0 X HX Hr Hf (Rle_refl 0)) as [E _].
  assert (P := unbiased_mean_holds s c X HX E sign_ away).
  destruct (Rle_dec 0 B) as [L|L].
  - destruct (mean_grows c 0 B X HX Hr Hf L) as [_ G]. rewrite Z in G.
    destruct (Rle_dec 0 s) as [S|S]; [exfalso; nra|]. assert (B <> 0) by (intros ->; rewrite Z in P; lra). nra.
  - destruct (mean_grows c B 0 X HX Hr Hf ltac:(lra)) as [_ G]. rewrite Z in G.
    destruct (Rle_dec s 0) as [S|S]; [exfalso; nra|]. nra.
Qed.

Lemma only_if_holds : only_if_at_every_amplitude.
Proof.
  intros F cont. pose proof (mean_zero_at_every_amplitude (static F) 0 cont cont) as A. unfold both_branches in A; simpl in A.
  rewrite A. split; intros H x.
  - pose proof (H x) as E. rewrite Rplus_0_l, Rminus_0_l in E. lra.
  - rewrite Rplus_0_l, Rminus_0_l, H. ring.
Qed.

Theorem statement : unbiased_mean /\ exactly_where /\ continuous_characteristic /\ opposite_bias /\ only_if_at_every_amplitude.
Proof.
  exact (conj unbiased_mean_holds (conj exactly_where_holds (conj continuous_characteristic_holds (conj opposite_bias_holds only_if_holds)))).
Qed.
Print Assumptions statement.

(** * As printed *)

Definition as_printed_only_if : Prop := forall (F : R -> R) (B X : R), 0 < X -> ~ odd F ->
  ex_RInt (output (static F) B X) 0 (2 * PI) -> mean (output (static F) B X) = 0 -> B <> 0.
Definition as_printed_if : Prop := forall (F : R -> R), ~ odd F -> exists B X, 0 < X /\ B <> 0 /\ mean (output (static F) B X) = 0.

(** [F = x + x^2 - 1/2], [X = 1], no bias. *)
Theorem as_printed_false : ~ as_printed_only_if.
Proof.
  intros H. destruct (mean_of_polynomial [- (1 / 2); 1; 1] 0 1 0) as [E M]; [simpl; field|].
  apply (H (eval [- (1 / 2); 1; 1]) 0 1); trivial; [lra|]. intros O. specialize (O 1). simpl in O. lra.
Qed.

(** [F = 1 + x^2]: no bias will do. *)
Theorem as_printed_if_false : ~ as_printed_if.
Proof.
  intros H. destruct (H (eval [1; 0; 1])) as [B [X [HX [_ Z]]]]; [intros O; specialize (O 0); simpl in O; lra|].
  destruct (mean_of_polynomial [1; 0; 1] B X _ eq_refl) as [_ M]. rewrite Z in M. simpl in M. nra.
Qed.

(** Without an even part of one sign: the same [F]. *)
Theorem needs_even_part_of_one_sign : let F := eval [- (1 / 2); 1; 1] in
  not_zero_on_an_interval 1 (static F) 1 /\ mean (output (static F) 0 1) = 0.
Proof.
  split; [|apply mean_of_polynomial; simpl; field].
  exists (1 / 16), (3 / 4), 1. repeat split; try lra. intros x Hx. unfold even_part. simpl. nra.
Qed.

(** Without an even part that is not zero: an odd function; and a value at one point alone. *)
Theorem needs_even_part_not_zero : forall X, 0 < X -> one_sign 1 (static (eval [0; 1])) X /\ mean (output (static (eval [0; 1])) 0 X) = 0.
Proof.
  intros X HX. split; [intros x _; unfold even_part; simpl; lra|]. apply mean_of_polynomial. simpl. ring.
Qed.

Definition one_point (x : R) : R := if Req_EM_T x 0 then 1 else 0.
Theorem one_point_is_not_enough : forall X, 0 < X ->
  one_sign 1 (static one_point) X /\ even_part (static one_point) 0 <> 0 /\ mean (output (static one_point) 0 X) = 0.
Proof.
  intros X HX. unfold one_point. split; [|split].
  - intros x _. unfold even_part; simpl. destruct (Req_EM_T x 0), (Req_EM_T (- x) 0); lra.
  - unfold even_part; simpl. destruct (Req_EM_T 0 0), (Req_EM_T (- 0) 0); lra.
  - unfold mean. pose proof PI_RGT_0. rewrite (RInt_of _ 0 (2 * PI) 0); [field; lra|].
    apply (ext_off [PI] (fun _ => 0)); [lra| |apply zero_integral].
    intros t T N. simpl in N. rewrite output_static. unfold sweep.
    assert (S : sin t <> 0).
    { destruct (Rtotal_order t PI) as [L|[L|L]]; [apply Rgt_not_eq, sin_gt_0; lra|exfalso; apply N; left; lra|apply Rlt_not_eq, sin_lt_0; lra]. }
    destruct (Req_EM_T (0 + X * sin t) 0) as [Z|]; [exfalso; nra|reflexivity].
Qed.

(** [F = e - x] falls: its mean vanishes at the bias [e], which has the even part's own sign. *)
Theorem needs_nondecreasing : forall e X, 0 < e -> 0 < X -> let F := eval [e; -1] in
  one_sign 1 (static F) X /\ not_zero_on_an_interval 1 (static F) X /\ mean (output (static F) e X) = 0 /\ 0 < 1 * e.
Proof.
  intros e X He HX F. repeat split; try lra.
  - intros x _. unfold even_part, F; simpl. lra.
  - exists e, (- X), X. repeat split; try lra. intros x _. unfold even_part, F; simpl. lra.
  - apply mean_of_polynomial. simpl. ring.
Qed.
