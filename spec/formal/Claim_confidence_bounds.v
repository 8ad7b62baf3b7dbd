(** confidence-bounds (section 5.3, eqs. 37 to 39). The paper says of the bounds that quantisation of the amplitude sets: they get
    smaller as the magnitude of the self-oscillations gets bigger. It is so for both drags. For the inertia it is not: between the
    amplitudes [sqrt(2) x_a] (1.414) and [sqrt((5 + sqrt(17))/2) x_a] (2.136) its bound grows, from zero on. *)
From Coq Require Import Reals Lra Psatz List.
From Coquelicot Require Import Coquelicot.
From Interval Require Tactic.
From Interval.Float Require Import Specific_stdz Specific_ops.
(** The tactic [interval] over Coq's own integers: the machine's are axioms to Coq. *)
Module Digits := SpecificFloat StdZRadix2.
Module Kernel := Tactic.IntervalTactic Digits.
Import Interval.Tactic Kernel.
Import ListNotations.
Open Scope R_scope.

(** The bounds: relative, of a reading with the step [quantum], at the hysteresis level [x_a]. *)
Definition alpha_bound (x_a quantum X : R) : R := Rabs ((2 - (X / x_a) ^ 2) / ((X / x_a) ^ 2 - 1) * (quantum / X)).
Definition beta_bound (quantum X : R) : R := Rabs (- 2 * (quantum / X)).
Definition beta_xx_bound (quantum X : R) : R := Rabs (- 3 * (quantum / X)).

Definition least : R := sqrt 2.
Definition greatest : R := sqrt ((5 + sqrt 17) / 2).

Definition falls_between (f : R -> R) (a b : R) : Prop := forall X Y, a < X -> X < Y -> Y <= b -> f Y < f X.
Definition grows_between (f : R -> R) (a b : R) : Prop := forall X Y, a <= X -> X < Y -> Y <= b -> f X < f Y.

Definition drags : Prop := forall quantum X Y, 0 < quantum -> 0 < X -> X < Y ->
  beta_bound quantum Y < beta_bound quantum X /\ beta_xx_bound quantum Y < beta_xx_bound quantum X.

Definition inertia : Prop := forall x_a quantum, 0 < x_a -> 0 < quantum ->
  falls_between (alpha_bound x_a quantum) x_a (least * x_a) /\ alpha_bound x_a quantum (least * x_a) = 0 /\
  grows_between (alpha_bound x_a quantum) (least * x_a) (greatest * x_a) /\
  (forall b, falls_between (alpha_bound x_a quantum) (greatest * x_a) b).

Definition where_ : Prop := Rabs (least - 1.4142) < 0.0001 /\ Rabs (greatest - 2.1358) < 0.0001.

(** Table 4: [(x_a*, X_m)] in degrees; eleven of the nineteen rows lie where the inertia's bound grows, eight do not. *)
Definition rows_between : list (R * R) := [(10.29, 20.6); (15, 29.8); (16.84, 29.78); (21.20, 35.25); (17.73, 36.57); (21.92, 42.25);
  (22.37, 41.08); (31.29, 47.17); (22.42, 44.09); (23.6, 49.67); (34, 60.33)].
Definition rows_elsewhere : list (R * R) := [(11, 26.17); (41.07, 53); (6.58, 26.36); (12.21, 30.69); (13.12, 40.33); (14.25, 42.73);
  (14.33, 42.73); (19.83, 48.88)].
Definition between (row : R * R) : Prop := least < snd row / fst row < greatest.
Definition table_4 : Prop := length rows_between = 11%nat /\ length rows_elsewhere = 8%nat /\
  List.Forall between rows_between /\ List.Forall (fun row => ~ between row) rows_elsewhere.

(** By the ratio of amplitude and level. *)
Definition g (r : R) : R := (r * r - 2) / (r * (r * r - 1)).

Lemma bound_by_ratio x_a quantum X : 0 < x_a -> 0 < quantum -> x_a < X ->
  alpha_bound x_a quantum X = quantum / x_a * Rabs (g (X / x_a)).
Proof.
  intros Ha Hq HX. unfold alpha_bound, g. set (r := X / x_a). assert (E : X = r * x_a) by (unfold r; field; lra).
  assert (Hr : 1 < r) by (apply (Rmult_lt_reg_r x_a); lra).
  assert (P : 0 < quantum / x_a) by (apply Rdiv_lt_0_compat; lra).
  rewrite <- (Rabs_right (quantum / x_a)) at 1 by lra. rewrite <- Rabs_mult, <- Rabs_Ropp. f_equal. rewrite E. field.
  repeat split; nra.
Qed.

Lemma g_difference a b : 1 < a -> 1 < b ->
  g b - g a = (b - a) * - (a * a * (b * b) - 2 * (a * a) - a * b - 2 * (b * b) + 2) / (a * (a * a - 1) * (b * (b * b - 1))).
Proof. intros Ha Hb. unfold g. field. repeat split; nra. Qed.

Lemma greatest_squared : greatest * greatest = (5 + sqrt 17) / 2 /\ 2 < greatest.
Proof.
  assert (S : 4 < sqrt 17) by interval with (i_prec 40). split; [apply sqrt_sqrt; lra|]. unfold greatest. interval with (i_prec 40).
Qed.

(** [r^4 - 5 r^2 + 2] is not positive up to the greatest, and not negative beyond. *)
Lemma turning r : 1 <= r -> (r <= greatest -> r * r * (r * r) - 5 * (r * r) + 2 <= 0) /\ (greatest <= r -> 0 <= r * r * (r * r) - 5 * (r * r) + 2).
Proof.
  intros Hr. destruct greatest_squared as [E G]. assert (S : sqrt 17 * sqrt 17 = 17) by (apply sqrt_sqrt; lra).
  assert (S4 : 4 < sqrt 17) by interval with (i_prec 40).
  assert (F : r * r * (r * r) - 5 * (r * r) + 2 = (r * r - greatest * greatest) * (r * r - (5 - sqrt 17) / 2)) by
    (rewrite E; transitivity (r * r * (r * r) - 5 * (r * r) + (25 - sqrt 17 * sqrt 17) / 4); [rewrite S; field|field]).
  assert (P : 0 < r * r - (5 - sqrt 17) / 2) by nra. rewrite F. split; intros H'.
  - assert (r * r <= greatest * greatest) by (apply Rmult_le_compat; lra). nra.
  - assert (greatest * greatest <= r * r) by (apply Rmult_le_compat; lra). apply Rmult_le_pos; lra.
Qed.

Lemma g_grows a b : 1 < a -> a < b -> b <= greatest -> g a < g b.
Proof.
  intros Ha ab Hb. assert (0 < g b - g a); [|lra]. rewrite g_difference by lra. apply Rdiv_lt_0_compat.
  - apply Rmult_lt_0_compat; [lra|]. assert (0 < a * b) by nra.
    assert (K : (a * a - 2) * (b * b - 2) < a * b + 2); [|lra].
    destruct (Rle_dec (b * b) 2) as [B2|B2].
    + assert (a * a < b * b) by nra. assert ((2 - a * a) * (2 - b * b) <= 1 * 1) by (apply Rmult_le_compat; nra). lra.
    + pose proof (proj1 (turning b ltac:(lra)) Hb) as T.
      assert (M : (a * a - 2) * (b * b + 2) < (b * b - 2) * (a * b + 2)).
      { assert (0 < (b - a) * (a * (b * b) + 2 * (a + 2 * b))); [|lra]. apply Rmult_lt_0_compat; nra. }
      apply (Rmult_lt_compat_r (b * b - 2)) in M; [|lra].
      assert (Q : (b * b - 2) * (b * b - 2) * (a * b + 2) <= (b * b + 2) * (a * b + 2)) by (apply Rmult_le_compat_r; lra).
      apply (Rmult_lt_reg_r (b * b + 2)); [nra|]. lra.
  - assert (0 < a * a - 1) by nra. assert (0 < b * b - 1) by nra. repeat apply Rmult_lt_0_compat; lra.
Qed.

Lemma g_falls a b : greatest <= a -> a < b -> g b < g a.
Proof.
  intros Ha ab. destruct greatest_squared as [_ G]. assert (0 < g a - g b); [|lra].
  replace (g a - g b) with (- (g b - g a)) by ring. rewrite g_difference by lra.
  replace (- ((b - a) * - (a * a * (b * b) - 2 * (a * a) - a * b - 2 * (b * b) + 2) / (a * (a * a - 1) * (b * (b * b - 1)))))
    with ((b - a) * (a * a * (b * b) - 2 * (a * a) - a * b - 2 * (b * b) + 2) / (a * (a * a - 1) * (b * (b * b - 1))))
    by (field; repeat split; nra).
  apply Rdiv_lt_0_compat.
  - apply Rmult_lt_0_compat; [lra|]. pose proof (proj2 (turning a ltac:(lra)) Ha) as T. assert (0 < a * b) by nra.
    assert (A2 : 2 < a * a) by nra. assert (K : a * b + 2 < (a * a - 2) * (b * b - 2)); [|lra].
    assert (M : (a * a - 2) * (a * b + 2) < (b * b - 2) * (a * a + 2)).
    { assert (0 < (b - a) * (a * a * b + 2 * (b + 2 * a))); [|lra]. apply Rmult_lt_0_compat; [lra|]. assert (0 < a * a * b) by (apply Rmult_lt_0_compat; lra). lra. }
    apply (Rmult_lt_compat_r (a * a - 2)) in M; [|lra].
    assert (Q : (a * a + 2) * (a * b + 2) <= (a * a - 2) * (a * a - 2) * (a * b + 2)) by (apply Rmult_le_compat_r; lra).
    apply (Rmult_lt_reg_r (a * a + 2)); [lra|]. lra.
  - assert (0 < a * a - 1) by nra. assert (0 < b * b - 1) by nra. repeat apply Rmult_lt_0_compat; lra.
Qed.

Lemma g_sign r : 1 < r -> (r <= least -> g r <= 0) /\ (least <= r -> 0 <= g r).
Proof.
  intros Hr. assert (E : least * least = 2) by (apply sqrt_sqrt; lra). assert (P : 0 < least) by (apply sqrt_lt_R0; lra).
  assert (D : 0 < r * (r * r - 1)) by (apply Rmult_lt_0_compat; nra). split; intros H; unfold g.
  - apply Rmult_le_reg_r with (r * (r * r - 1)); [exact D|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; nra.
  - apply Rmult_le_pos; [nra|left; now apply Rinv_0_lt_compat].
Qed.

Lemma ratio_order x_a X Y k : 0 < x_a -> (X < Y -> X / x_a < Y / x_a) /\ (X <= k * x_a -> X / x_a <= k) /\ (k * x_a <= X -> k <= X / x_a).
Proof.
  intros Ha. assert (E : X / x_a * x_a = X) by (field; lra). assert (E' : Y / x_a * x_a = Y) by (field; lra).
  repeat split; intros H; [apply (Rmult_lt_reg_r x_a)|apply (Rmult_le_reg_r x_a)|apply (Rmult_le_reg_r x_a)]; lra.
Qed.

Theorem statement : drags /\ inertia /\ where_ /\ table_4.
Proof.
  assert (L1 : 1 < least) by (unfold least; interval with (i_prec 40)). destruct greatest_squared as [_ G2].
  split; [|split; [|split]].
  - intros quantum X Y Hq HX XY. unfold beta_bound, beta_xx_bound. rewrite !Rabs_mult, !(Rabs_left (- 2)), !(Rabs_left (- 3)) by lra.
    assert (D : 0 < quantum / Y < quantum / X).
    { split; [apply Rdiv_lt_0_compat; lra|]. apply Rmult_lt_compat_l; [lra|]. apply Rinv_lt_contravar; [apply Rmult_lt_0_compat; lra|lra]. }
    rewrite !Rabs_right by lra. lra.
  - intros x_a quantum Ha Hq. assert (P : 0 < quantum / x_a) by (apply Rdiv_lt_0_compat; lra).
    assert (G1 : least < greatest) by (unfold least, greatest; interval with (i_prec 40)).
    split; [|split; [|split]].
    + intros X Y H1 H2 H3. rewrite !bound_by_ratio by (trivial; lra). apply Rmult_lt_compat_l; [exact P|].
      destruct (ratio_order x_a X Y 1 Ha) as [O1 _]. destruct (ratio_order x_a Y X least Ha) as [_ [O2 _]].
      assert (R1 : 1 < X / x_a) by (apply (Rmult_lt_reg_r x_a); [lra|]; replace (X / x_a * x_a) with X by (field; lra); lra).
      specialize (O1 H2). specialize (O2 H3). pose proof (g_grows (X / x_a) (Y / x_a) R1 O1 ltac:(lra)).
      pose proof (proj1 (g_sign (Y / x_a) ltac:(lra)) O2). rewrite !Rabs_left1 by lra. lra.
    + rewrite bound_by_ratio by (trivial; nra). replace (least * x_a / x_a) with least by (field; lra).
      unfold g, least. rewrite sqrt_sqrt by lra. replace ((2 - 2) / (sqrt 2 * (2 - 1))) with 0.
      * rewrite Rabs_R0. ring.
      * field. apply Rgt_not_eq, sqrt_lt_R0. lra.
    + intros X Y H1 H2 H3. assert (x_a < X) by nra. rewrite !bound_by_ratio by (trivial; lra). apply Rmult_lt_compat_l; [exact P|].
      destruct (ratio_order x_a X Y least Ha) as [O1 [_ O3]]. destruct (ratio_order x_a Y X greatest Ha) as [_ [O2 _]].
      specialize (O1 H2). specialize (O2 H3). specialize (O3 H1). pose proof (g_grows (X / x_a) (Y / x_a) ltac:(lra) O1 O2) as GG.
      pose proof (proj2 (g_sign (X / x_a) ltac:(lra)) O3). rewrite !Rabs_right by lra. exact GG.
    + intros b X Y H1 H2 _. assert (x_a < X) by nra. rewrite !bound_by_ratio by (trivial; lra). apply Rmult_lt_compat_l; [exact P|].
      destruct (ratio_order x_a X Y greatest Ha) as [O1 [_ O3]]. specialize (O1 H2). specialize (O3 ltac:(lra)).
      pose proof (g_falls _ _ O3 O1) as GG. pose proof (proj2 (g_sign (X / x_a) ltac:(lra)) ltac:(lra)).
      pose proof (proj2 (g_sign (Y / x_a) ltac:(lra)) ltac:(lra)). rewrite !Rabs_right by lra. exact GG.
  - unfold where_, least, greatest. split; interval with (i_prec 40).
  - unfold table_4, rows_between, rows_elsewhere, between, least, greatest. split; [reflexivity|split; [reflexivity|]].
    split; repeat (apply List.Forall_cons || apply List.Forall_nil); simpl.
    all: try (split; interval with (i_prec 40)).
    all: intros [H1 H2]; (assert (K := H1); revert K; apply Rle_not_lt; interval with (i_prec 40)) || (revert H2; apply Rle_not_lt; interval with (i_prec 40)).
Qed.
Print Assumptions statement.

(** As printed, of all three parameters. *)
Definition as_printed : Prop := forall x_a quantum X Y, 0 < x_a -> 0 < quantum -> x_a < X -> X < Y ->
  alpha_bound x_a quantum Y < alpha_bound x_a quantum X.
Theorem as_printed_false : ~ as_printed.
Proof.
  intros H. specialize (H 1 1 (3 / 2) 2 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)). revert H. apply Rle_not_lt.
  unfold alpha_bound. interval with (i_prec 40).
Qed.
