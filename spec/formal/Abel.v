(** Abel's problem: which functions have the mean zero over every sinusoid? The odd ones alone, among continuous functions.
    By Weierstrass' theorem (Bernstein's proof) and Wallis' product; no double integral is exchanged. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Moments.
Import ListNotations.
Open Scope R_scope.

(** * Coins *)

(** The mean of [f] over the number of heads among [n] coins of probability [x]. *)
Fixpoint coins (n : nat) (f : nat -> R) (x : R) : R :=
  match n with O => f O | S n => (1 - x) * coins n f x + x * coins n (fun k => f (S k)) x end.

Lemma coins_le n x : 0 <= x <= 1 -> forall f g, (forall k, (k <= n)%nat -> f k <= g k) -> coins n f x <= coins n g x.
Proof.
  intros Hx. induction n as [|n IH]; intros f g H; simpl; [apply H; lia|].
  assert (coins n f x <= coins n g x) by (apply IH; intros; apply H; lia).
  assert (coins n (fun k => f (S k)) x <= coins n (fun k => g (S k)) x) by (apply IH; intros; apply H; lia).
  nra.
Qed.

Lemma coins_ext n x : forall f g, (forall k, f k = g k) -> coins n f x = coins n g x.
Proof.
  induction n as [|n IH]; intros f g H; simpl; [apply H|].
  now rewrite (IH f g H), (IH (fun k => f (S k)) (fun k => g (S k)) (fun k => H (S k))).
Qed.

(** Mean and variance at once. *)
Lemma coins_spread n x : forall a b c, coins n (fun k => b + c * (INR k - a) ^ 2) x = b + c * (INR n * x * (1 - x) + (INR n * x - a) ^ 2).
Proof.
  induction n as [|n IH]; intros a b c; [simpl; ring|]. cbn [coins].
  rewrite (coins_ext n x (fun k => b + c * (INR (S k) - a) ^ 2) (fun k => b + c * (INR k - (a - 1)) ^ 2)).
  - rewrite !IH, S_INR. ring.
  - intros k. rewrite S_INR. ring.
Qed.

(** * Polynomials *)

Definition is_polynomial (f : R -> R) : Prop := exists c, forall x, f x = eval c x.

Lemma polynomial_plus f g : is_polynomial f -> is_polynomial g -> is_polynomial (fun x => f x + g x).
Proof.
  intros [c Hc] [d Hd].
  set (add_ := fix add_ (c d : list R) := match c, d with [], _ => d | _, [] => c | a :: c, b :: d => a + b :: add_ c d end).
  exists (add_ c d). intros x. rewrite Hc, Hd. clear. revert d. induction c as [|a c IH]; intros [|b d]; simpl; try ring.
  rewrite <- IH. ring.
Qed.

Lemma polynomial_times k f : is_polynomial f -> is_polynomial (fun x => k * f x).
Proof.
  intros [c Hc]. exists (map (Rmult k) c). intros x. rewrite Hc. clear. induction c as [|a c IH]; simpl; [ring|]. rewrite <- IH. ring.
Qed.

Lemma polynomial_shift f : is_polynomial f -> is_polynomial (fun x => x * f x).
Proof. intros [c Hc]. exists (0 :: c). intros x. simpl. rewrite Hc. ring. Qed.

Lemma polynomial_ext f g : (forall x, f x = g x) -> is_polynomial f -> is_polynomial g.
Proof. intros H [c Hc]. exists c. intros x. now rewrite <- H. Qed.

Lemma coins_polynomial n : forall f, is_polynomial (coins n f).
Proof.
  induction n as [|n IH]; intros f; [exists [f O]; intros x; simpl; ring|].
  apply (polynomial_ext (fun x => (coins n f x + -1 * (x * coins n f x)) + x * coins n (fun k => f (S k)) x)); [intros; simpl; ring|].
  apply polynomial_plus; [apply polynomial_plus; [apply IH|apply polynomial_times, polynomial_shift, IH]|apply polynomial_shift, IH].
Qed.

(** * Weierstrass' theorem on [0, 1] *)

Theorem weierstrass (f : R -> R) (eps : R) : (forall x : R, continuous f x) -> 0 < eps ->
  exists p, is_polynomial p /\ forall x, 0 <= x <= 1 -> Rabs (f x - p x) <= eps.
Proof.
  intros cont Heps.
  assert (pt : forall x, continuity_pt f x) by (intros x; apply continuity_pt_filterlim, cont).
  assert (Hhalf : 0 < eps / 2) by lra.
  destruct (@Heine_cor2 f 0 1 (fun x _ => pt x) (mkposreal _ Hhalf)) as [[delta Hd] near]. simpl in near.
  destruct (continuity_ab_maj f 0 1 ltac:(lra) (fun x _ => pt x)) as [xM [HM _]].
  destruct (continuity_ab_min f 0 1 ltac:(lra) (fun x _ => pt x)) as [xm [Hm _]].
  set (M := f xM - f xm). assert (M0 : 0 <= M) by (unfold M; pose proof (HM 0 ltac:(lra)); pose proof (Hm 0 ltac:(lra)); lra).
  set (K := M / (delta * delta)).
  assert (K0 : 0 <= K) by (apply Rmult_le_pos; [exact M0|left; apply Rinv_0_lt_compat, Rmult_lt_0_compat; lra]).
  assert (step : forall x y, 0 <= x <= 1 -> 0 <= y <= 1 -> Rabs (f y - f x) <= eps / 2 + K * (y - x) ^ 2).
  { intros x y Hx Hy. destruct (Rlt_dec (Rabs (y - x)) delta) as [L|L].
    - pose proof (near y x Hy Hx L). assert (0 <= K * (y - x) ^ 2) by (apply Rmult_le_pos; [exact K0|apply pow2_ge_0]). lra.
    - assert (Rabs (f y - f x) <= M).
      { unfold M. pose proof (HM x Hx). pose proof (HM y Hy). pose proof (Hm x Hx). pose proof (Hm y Hy). apply Rabs_le. lra. }
      assert (D : delta * delta <= (y - x) ^ 2).
      { rewrite <- (pow2_abs (y - x)). replace (delta * delta) with (delta ^ 2) by ring. apply pow_incr. lra. }
      assert (M <= K * (y - x) ^ 2).
      { replace M with (K * (delta * delta)) by (unfold K; field; lra). apply Rmult_le_compat_l; [exact K0|exact D]. }
      lra. }
  destruct (archimed (K / eps)) as [A _]. set (n := Z.to_nat (up (K / eps))).
  assert (P : 0 <= K / eps) by (apply Rmult_le_pos; [exact K0|left; now apply Rinv_0_lt_compat]).
  assert (Hn : K / eps < INR n) by (unfold n; rewrite INR_IZR_INZ, Z2Nat.id; [exact A|apply le_IZR; lra]).
  assert (N0 : 0 < INR n) by lra.
  exists (coins n (fun k => f (INR k / INR n))). split; [apply coins_polynomial|]. intros x Hx.
  assert (unit_ : forall k, (k <= n)%nat -> 0 <= INR k / INR n <= 1).
  { intros k Hk. pose proof (pos_INR k). pose proof (le_INR _ _ Hk). split.
    - apply Rmult_le_pos; [assumption|left; now apply Rinv_0_lt_compat].
    - apply (Rmult_le_reg_r (INR n)); [exact N0|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
  assert (V : forall c, coins n (fun k => c + K / (INR n * INR n) * (INR k - INR n * x) ^ 2) x = c + K * x * (1 - x) / INR n).
  { intros c. rewrite coins_spread. field. lra. }
  assert (U : coins n (fun k => f (INR k / INR n)) x <= f x + eps / 2 + K * x * (1 - x) / INR n).
  { rewrite <- V. apply coins_le; [exact Hx|]. intros k Hk. specialize (step x _ Hx (unit_ k Hk)). apply Rabs_le_between in step.
    replace (K / (INR n * INR n) * (INR k - INR n * x) ^ 2) with (K * (INR k / INR n - x) ^ 2) by (field; lra). lra. }
  assert (W : - (K / (INR n * INR n)) = - K / (INR n * INR n)) by (field; lra).
  assert (L : f x - eps / 2 - K * x * (1 - x) / INR n <= coins n (fun k => f (INR k / INR n)) x).
  { replace (f x - eps / 2 - K * x * (1 - x) / INR n) with (coins n (fun k => f x - eps / 2 + - (K / (INR n * INR n)) * (INR k - INR n * x) ^ 2) x).
    - apply coins_le; [exact Hx|]. intros k Hk. specialize (step x _ Hx (unit_ k Hk)). apply Rabs_le_between in step.
      replace (- (K / (INR n * INR n)) * (INR k - INR n * x) ^ 2) with (- (K * (INR k / INR n - x) ^ 2)) by (field; lra). lra.
    - rewrite coins_spread. field. lra. }
  assert (S : K * x * (1 - x) / INR n <= eps / 2).
  { apply (Rmult_lt_compat_r eps) in Hn; [|exact Heps]. replace (K / eps * eps) with K in Hn by (field; lra).
    apply (Rmult_le_reg_r (INR n)); [exact N0|]. replace (K * x * (1 - x) / INR n * INR n) with (K * (x * (1 - x))) by (field; lra).
    assert (Q : x * (1 - x) <= 1 / 4) by (pose proof (pow2_ge_0 (x - 1 / 2)); lra).
    apply (Rmult_le_compat_l K) in Q; [|exact K0]. lra. }
  apply Rabs_le. lra.
Qed.

(** * Wallis' integrals *)

Fixpoint wallis (n : nat) : R :=
  match n with O => PI / 2 | S O => 1 | S (S k) => (INR k + 1) / (INR k + 2) * wallis k end.

Lemma wallis_integral n : is_RInt (fun t => sin t ^ n) 0 (PI / 2) (wallis n).
Proof.
  pose proof PI_RGT_0.
  assert (K : is_RInt (fun t => sin t ^ n) 0 (PI / 2) (wallis n) /\ is_RInt (fun t => sin t ^ S n) 0 (PI / 2) (wallis (S n))); [|apply K].
  induction n as [|n [I1 I2]]; split.
  - apply (ext (fun _ => 1)); [lra|intros; simpl; ring|]. apply (equal _ _ _ ((PI / 2 - 0) * 1)); [apply constant_integral|simpl; ring].
  - apply (ext sin); [lra|intros; simpl; ring|]. apply (equal _ _ _ (- cos (PI / 2) - - cos 0)); [|rewrite cos_PI2, cos_0; simpl; ring].
    apply (by_antiderivative (fun t => - cos t)); intros t; auto_derive; trivial; ring.
  - exact I2.
  - apply two_more; [rewrite sin_0; simpl; ring|rewrite cos_PI2; ring|exact I1].
Qed.

Lemma wallis_product n : wallis n * wallis (S n) = PI / 2 / (INR n + 1).
Proof.
  induction n as [|n IH]; [simpl; field|].
  change (wallis (S (S n))) with ((INR n + 1) / (INR n + 2) * wallis n). pose proof (pos_INR n).
  replace (wallis (S n) * ((INR n + 1) / (INR n + 2) * wallis n)) with ((INR n + 1) / (INR n + 2) * (wallis n * wallis (S n))) by ring.
  rewrite IH, S_INR. field. lra.
Qed.

(** * Polynomials under sinusoids of every amplitude *)

(** Of the coefficients from number [m] on: the integral over a quarter turn, as a function of the amplitude. *)
Fixpoint over_quarter (m : nat) (a : list R) (c : R) : R :=
  match a with [] => 0 | x :: a => x * wallis m * c ^ m + over_quarter (S m) a c end.
(** The integral of the polynomial from 0 to 1. *)
Fixpoint over_unit (m : nat) (a : list R) : R := match a with [] => 0 | x :: a => x / (INR m + 1) + over_unit (S m) a end.

Lemma zero_integral a b : is_RInt (fun _ : R => 0) a b 0.
Proof. apply (equal _ _ _ ((b - a) * 0)); [apply constant_integral|ring]. Qed.

Lemma over_quarter_integral a c : forall m, is_RInt (fun t => (c * sin t) ^ m * eval a (c * sin t)) 0 (PI / 2) (over_quarter m a c).
Proof.
  pose proof PI_RGT_0. induction a as [|x a IH]; intros m; simpl.
  - apply (ext (fun _ => 0)); [lra|intros; ring|apply zero_integral].
  - apply (ext (fun t => x * c ^ m * sin t ^ m + (c * sin t) ^ S m * eval a (c * sin t))); [lra| |].
    + intros t _. rewrite Rpow_mult_distr. simpl. rewrite Rpow_mult_distr. ring.
    + apply add; [|apply IH]. apply (equal _ _ _ (x * c ^ m * wallis m)); [|ring]. apply multiply, wallis_integral.
Qed.

(** Once more over a quarter turn, weighted with the sine: what is left is the plain integral. *)
Lemma twice_over_quarter a : forall m, is_RInt (fun t => over_quarter m a (sin t) * sin t) 0 (PI / 2) (PI / 2 * over_unit m a).
Proof.
  pose proof PI_RGT_0. induction a as [|x a IH]; intros m; simpl.
  - apply (equal _ _ _ 0); [|ring]. apply (ext (fun _ => 0)); [lra|intros; ring|apply zero_integral].
  - apply (ext (fun t => x * wallis m * sin t ^ S m + over_quarter (S m) a (sin t) * sin t)); [lra|intros; simpl; ring|].
    apply (equal _ _ _ (x * wallis m * wallis (S m) + PI / 2 * over_unit (S m) a)).
    + apply add; [|apply IH]. apply multiply, wallis_integral.
    + pose proof (pos_INR m). rewrite Rmult_assoc, wallis_product. field. lra.
Qed.

Lemma over_unit_integral a : forall m, is_RInt (fun u => u ^ m * eval a u) 0 1 (over_unit m a).
Proof.
  induction a as [|x a IH]; intros m; simpl.
  - apply (ext (fun _ => 0)); [lra|intros; ring|apply zero_integral].
  - apply (ext (fun u => x * u ^ m + u ^ S m * eval a u)); [lra|intros; simpl; ring|]. apply add; [|apply IH].
    pose proof (pos_INR m). apply (equal _ _ _ (x * (1 ^ S m / (INR m + 1) - 0 ^ S m / (INR m + 1)))).
    + apply multiply. apply (by_antiderivative (fun u => u ^ S m / (INR m + 1))); intros u; auto_derive; trivial.
      replace (match m with O => 1 | S _ => INR m + 1 end) with (INR m + 1) by (destruct m; simpl; lra). simpl. field. lra.
    + rewrite pow1, pow_i by lia. field. lra.
Qed.

(** * Abel's problem *)

Lemma continuous_integral (f : R -> R) a b : (forall x : R, continuous f x) -> ex_RInt f a b.
Proof. intros H. apply (ex_RInt_continuous (V := R_CompleteNormedModule)). intros; apply H. Qed.

Lemma bounded_integral (f : R -> R) a b l e : a <= b -> is_RInt f a b l -> (forall t, a < t < b -> Rabs (f t) <= e) -> Rabs l <= (b - a) * e.
Proof.
  intros ab I H. apply Rabs_le. split.
  - assert (0 <= l - (b - a) * - e); [|lra]. apply (not_negative (fun t => f t - - e) a b); [exact ab|apply subtract; [exact I|apply constant_integral]|].
    intros t T. specialize (H t T). apply Rabs_le_between in H. lra.
  - assert (0 <= (b - a) * e - l); [|lra]. apply (not_negative (fun t => e - f t) a b); [exact ab|apply subtract; [apply constant_integral|exact I]|].
    intros t T. specialize (H t T). apply Rabs_le_between in H. lra.
Qed.

Lemma unit_interval (E : R -> R) : (forall x : R, continuous E x) ->
  (forall c, 0 < c <= 1 -> is_RInt (fun t => E (c * sin t)) 0 (PI / 2) 0) -> RInt E 0 1 = 0.
Proof.
  intros cont zero. pose proof PI_RGT_0.
  destruct (Req_dec (RInt E 0 1) 0) as [|N]; [assumption|exfalso].
  assert (He : 0 < Rabs (RInt E 0 1) / 4) by (pose proof (Rabs_pos_lt _ N); lra). set (e := Rabs (RInt E 0 1) / 4) in *.
  destruct (weierstrass E e cont He) as [p [[a Ha] near]].
  assert (near' : forall x, 0 <= x <= 1 -> Rabs (E x - eval a x) <= e) by (intros x Hx; rewrite <- Ha; now apply near).
  assert (small : forall c, 0 < c <= 1 -> Rabs (over_quarter 0 a c) <= PI / 2 * e).
  { intros c Hc. pose proof (over_quarter_integral a c 0) as I. pose proof (subtract _ _ _ _ _ _ (zero c Hc) I) as D.
    apply (bounded_integral _ _ _ _ e) in D; [|lra|].
    - rewrite Rminus_0_l, Rabs_Ropp in D. lra.
    - intros t T. rewrite pow_O, Rmult_1_l. apply near'.
      assert (0 < sin t) by (apply sin_gt_0; lra). destruct (SIN_bound t). split; nra. }
  assert (J : Rabs (PI / 2 * over_unit 0 a) <= PI / 2 * e).
  { pose proof (twice_over_quarter a 0) as I.
    pose proof (multiply _ (PI / 2 * e) _ _ _ (wallis_integral 1)) as B. simpl (wallis 1) in B.
    assert (sines : forall t, 0 < t < PI / 2 -> 0 < sin t <= 1) by (intros t T; split; [apply sin_gt_0; lra|apply SIN_bound]).
    apply Rabs_le. split.
    - assert (0 <= PI / 2 * over_unit 0 a + PI / 2 * e * 1); [|lra].
      apply (not_negative _ 0 (PI / 2) _ ltac:(lra) (add _ _ _ _ _ _ I B)). intros t T. specialize (sines t T).
      pose proof (small _ sines) as S. apply Rabs_le_between in S. rewrite pow_1. nra.
    - assert (0 <= PI / 2 * e * 1 - PI / 2 * over_unit 0 a); [|lra].
      apply (not_negative _ 0 (PI / 2) _ ltac:(lra) (subtract _ _ _ _ _ _ B I)). intros t T. specialize (sines t T).
      pose proof (small _ sines) as S. apply Rabs_le_between in S. rewrite pow_1. nra. }
  assert (J' : Rabs (over_unit 0 a) <= e).
  { rewrite Rabs_mult, (Rabs_right (PI / 2)) in J by lra. apply (Rmult_le_reg_l (PI / 2)); lra. }
  assert (D : Rabs (RInt E 0 1 - over_unit 0 a) <= (1 - 0) * e).
  { apply (bounded_integral (fun u => E u - u ^ 0 * eval a u) 0 1); [lra| |].
    - apply subtract; [apply integral_of, continuous_integral, cont|apply over_unit_integral].
    - intros u U. rewrite pow_O, Rmult_1_l. apply near'. lra. }
  assert (T : Rabs (RInt E 0 1) <= Rabs (RInt E 0 1 - over_unit 0 a) + Rabs (over_unit 0 a)).
  { replace (RInt E 0 1) with (RInt E 0 1 - over_unit 0 a + over_unit 0 a) at 1 by ring. apply Rabs_triang. }
  unfold e in *. lra.
Qed.

(** A continuous function whose integral over a quarter turn vanishes at every amplitude is zero. *)
Theorem abel (E : R -> R) : (forall x : R, continuous E x) ->
  (forall c, 0 < c -> is_RInt (fun t => E (c * sin t)) 0 (PI / 2) 0) -> forall x, 0 <= x -> E x = 0.
Proof.
  intros cont zero.
  assert (primitive : forall x, 0 <= x -> RInt E 0 x = 0).
  { intros x [Hx| <-]; [|exact (RInt_point (V := R_CompleteNormedModule) 0 E)].
    assert (Z : RInt (fun u => E (x * u)) 0 1 = 0).
    { apply unit_interval.
      - intros u. apply (continuous_comp (fun u => x * u) E); [|apply cont].
        apply (ex_derive_continuous (V := R_NormedModule)). auto_derive. trivial.
      - intros c Hc. apply (ext (fun t => E (x * c * sin t))); [pose proof PI_RGT_0; lra|intros; f_equal; ring|].
        apply zero, Rmult_lt_0_compat; lra. }
    assert (I : is_RInt (fun u => x * E (x * u)) 0 1 (RInt E 0 x)).
    { apply (is_RInt_ext (V := R_NormedModule) (fun u => scal x (E (x * u + 0)))).
      - intros u _. unfold scal; simpl; unfold mult; simpl. now rewrite Rplus_0_r.
      - apply (is_RInt_comp_lin E x 0 0 1). rewrite !Rmult_0_r, Rmult_1_r, !Rplus_0_r.
        apply integral_of, continuous_integral, cont. }
    rewrite <- (RInt_of _ _ _ _ I). transitivity (x * RInt (fun u => E (x * u)) 0 1); [|rewrite Z; exact (Rmult_0_r x)].
    apply RInt_of, multiply, integral_of, continuous_integral.
    intros u. apply (continuous_comp (fun u => x * u) E); [|apply cont].
    apply (ex_derive_continuous (V := R_NormedModule)). auto_derive. trivial. }
  assert (positive_ : forall x, 0 < x -> E x = 0).
  { intros x Hx.
    assert (D : is_derive (fun y => RInt E 0 y) x (E x)).
    { apply (is_derive_RInt (V := R_NormedModule) E (fun y => RInt E 0 y) 0 x); [|apply cont].
      exists (mkposreal 1 Rlt_0_1). intros y _. apply integral_of, continuous_integral, cont. }
    assert (D0 : is_derive (fun y => RInt E 0 y) x 0).
    { apply (is_derive_ext_loc (fun _ => 0)); [|apply (is_derive_const (V := R_NormedModule))].
      exists (mkposreal x Hx). intros y Hy. change (Rabs (y - x) < x) in Hy. apply Rabs_def2 in Hy.
      symmetry. apply primitive. lra. }
    rewrite <- (is_derive_unique _ _ _ D). now apply is_derive_unique. }
  intros x [Hx| <-]; [now apply positive_|].
  destruct (Req_dec (E 0) 0) as [|N]; [assumption|exfalso].
  assert (He : 0 < Rabs (E 0)) by now apply Rabs_pos_lt.
  destruct (proj1 (filterlim_locally (F := locally 0) E (E 0)) (cont 0) (mkposreal _ He)) as [[d Hd] near].
  assert (B : ball 0 d (d / 2)) by (change (Rabs (d / 2 - 0) < d); rewrite Rabs_right; lra).
  specialize (near _ B). change (Rabs (E (d / 2) - E 0) < Rabs (E 0)) in near.
  rewrite positive_, Rminus_0_l, Rabs_Ropp in near by lra. lra.
Qed.

(** * The mean output at every amplitude *)

(** What both branches answer together. *)
Definition both_branches (c : characteristic) (x : R) : R := rising c x + falling c x.

Lemma mean_over_quarter c B X : (forall x : R, continuous (rising c) x) -> (forall x : R, continuous (falling c) x) ->
  is_RInt (output c B X) 0 (2 * PI) (2 * PI * mean (output c B X)) /\
  is_RInt (fun t => both_branches c (B + X * sin t) + both_branches c (B - X * sin t)) 0 (PI / 2) (2 * PI * mean (output c B X)).
Proof.
  intros Cr Cf. pose proof PI_RGT_0.
  assert (S : forall F : R -> R, (forall x : R, continuous F x) -> forall t : R, continuous (fun t => F (sweep B X t)) t).
  { intros F CF t. apply (continuous_comp (sweep B X) F); [|apply CF].
    apply (ex_derive_continuous (V := R_NormedModule)). unfold sweep. auto_derive. trivial. }
  assert (Er : forall a b, is_RInt (fun t => rising c (sweep B X t)) a b (RInt (fun t => rising c (sweep B X t)) a b)).
  { intros a b. now apply integral_of, continuous_integral, S. }
  assert (Ef : forall a b, is_RInt (fun t => falling c (sweep B X t)) a b (RInt (fun t => falling c (sweep B X t)) a b)).
  { intros a b. now apply integral_of, continuous_integral, S. }
  pose proof (mean_by_branches c B X _ _ (Er _ _) (Ef _ _)) as M.
  assert (E : 2 * PI * mean (output c B X) = RInt (fun t => rising c (sweep B X t)) (- (PI / 2)) (PI / 2)
                                           + RInt (fun t => falling c (sweep B X t)) (- (PI / 2)) (PI / 2)).
  { unfold mean. rewrite (RInt_of _ _ _ _ M). field. lra. }
  rewrite E. split; [exact M|].
  assert (fold_ : forall f : R -> R, (forall a b : R, is_RInt f a b (RInt f a b)) -> is_RInt (fun t => f t + f (0 - t)) 0 (PI / 2) (RInt f (- (PI / 2)) (PI / 2))).
  { intros f If. apply (equal _ _ _ (RInt f 0 (PI / 2) + RInt f (- (PI / 2)) 0)).
    - apply add; [apply If|]. apply (backwards f 0). rewrite Rminus_0_r, Rminus_0_l. apply If.
    - symmetry. rewrite Rplus_comm. apply RInt_of. apply join with 0; apply If. }
  refine (ext _ _ _ _ _ _ _ (add _ _ _ _ _ _ (fold_ _ Er) (fold_ _ Ef))); [lra|].
  intros t _. unfold both_branches, sweep. rewrite Rminus_0_l, sin_neg.
  replace (B + X * - sin t) with (B - X * sin t) by ring. ring.
Qed.

Theorem mean_zero_at_every_amplitude c B : (forall x : R, continuous (rising c) x) -> (forall x : R, continuous (falling c) x) ->
  ((forall X, 0 < X -> mean (output c B X) = 0) <-> (forall s, both_branches c (B + s) = - both_branches c (B - s))).
Proof.
  intros Cr Cf. pose proof PI_RGT_0. set (E := fun s => both_branches c (B + s) + both_branches c (B - s)). split.
  - intros H0.
    assert (Z : forall s, 0 <= s -> E s = 0).
    { apply abel.
      - assert (Cb : forall x, continuous (both_branches c) x) by (intros x; apply (continuous_plus (rising c) (falling c)); auto).
        intros s. apply (continuous_plus (fun s => both_branches c (B + s)) (fun s => both_branches c (B - s)));
          [apply (continuous_comp (fun s => B + s) (both_branches c))|apply (continuous_comp (fun s => B - s) (both_branches c))];
          try apply Cb; apply (ex_derive_continuous (V := R_NormedModule)); auto_derive; trivial.
      - intros X HX. pose proof (proj2 (mean_over_quarter c B X Cr Cf)) as I. rewrite H0, Rmult_0_r in I by exact HX. exact I. }
    intros s. destruct (Rle_dec 0 s) as [L|L].
    + specialize (Z s L). unfold E in Z. lra.
    + specialize (Z (- s) ltac:(lra)). unfold E in Z. replace (B + - s) with (B - s) in Z by ring. replace (B - - s) with (B + s) in Z by ring. lra.
  - intros H0 X HX. pose proof (proj2 (mean_over_quarter c B X Cr Cf)) as I.
    assert (Z : is_RInt (fun t => both_branches c (B + X * sin t) + both_branches c (B - X * sin t)) 0 (PI / 2) 0).
    { apply (ext (fun _ => 0)); [lra| |apply zero_integral]. intros t _. rewrite H0. ring. }
    apply RInt_of in I, Z. rewrite I in Z. apply (Rmult_eq_reg_l (2 * PI)); lra.
Qed.
