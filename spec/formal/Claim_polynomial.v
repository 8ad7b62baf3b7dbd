(** polynomial (eq. 10). With the polynomial written about the bias, [f(B + y) = sum b_m y^m], and [y = X sin(theta)]:
    [F_0 = sum b_2j X^2j <sin^2j>], [P = 2 sum b_2j+1 X^2j <sin^2j+2>], [Q = 0], the means of even powers of the sine being
    1, 1/2, 3/8, ... For polynomials of any degree. *)
From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels Moments.
Import ListNotations.
Open Scope R_scope.

(** Horner's scheme: each pass makes one coefficient about the bias. *)
Fixpoint pass (B : R) (c : list R) : list R :=
  match c with [] => [] | a :: c => let r := pass B c in (a + B * hd 0 r) :: r end.
Fixpoint passes (B : R) (n : nat) (c : list R) : list R :=
  match n with O => c | S n => match pass B c with [] => [] | b :: r => b :: passes B n r end end.
Definition about_bias (B : R) (c : list R) : list R := passes B (length c) c.

(** The two sums, over the pairs of coefficients from number [2 j] on. *)
Fixpoint mean_sum (X : R) (j : nat) (b : list R) : R :=
  match b with
  | [] => 0
  | [even] => even * (X ^ (2 * j) * even_mean j)
  | even :: _ :: b => even * (X ^ (2 * j) * even_mean j) + mean_sum X (S j) b
  end.
Fixpoint sine_sum (X : R) (j : nat) (b : list R) : R :=
  match b with
  | [] => 0
  | [_] => 0
  | _ :: odd :: b => 2 * odd * (X ^ (2 * j) * even_mean (S j)) + sine_sum X (S j) b
  end.
Definition polynomial_df (c : list R) (B X : R) : df :=
  {| f0 := mean_sum X 0 (about_bias B c); p := sine_sum X 0 (about_bias B c); q := 0 |}.

(** The program's loop: [mean] is [X^2j <sin^2j>], [even] is [2 j]. *)
Fixpoint loop (square mean even f0 p : R) (b : list R) : R * R :=
  match b with
  | [] => (f0, p)
  | [b0] => (f0 + b0 * mean, p)
  | b0 :: b1 :: b => let next := mean * ((even + 1) / (even + 2)) in
      loop square (next * square) (even + 2) (f0 + b0 * mean) (p + b1 * 2 * next) b
  end.
Definition coded_df (c : list R) (B X : R) : df :=
  let '(f0, p) := loop (X ^ 2) 1 0 0 0 (about_bias B c) in {| f0 := f0; p := p; q := 0 |}.

Lemma pass_eval B c x : eval c x = hd 0 (pass B c) + (x - B) * eval (tl (pass B c)) x.
Proof.
  induction c as [|a c IH]; simpl; [ring|]. rewrite IH. destruct (pass B c) as [|b r]; simpl; ring.
Qed.

Lemma pass_length B c : length (pass B c) = length c.
Proof. induction c; simpl; auto. Qed.

Lemma about_bias_eval B c y : eval (about_bias B c) y = eval c (B + y).
Proof.
  unfold about_bias. remember (length c) as n eqn:L. revert c L. induction n as [|n IH]; intros c L.
  - destruct c; [reflexivity|discriminate].
  - simpl. pose proof (pass_eval B c (B + y)) as E. pose proof (pass_length B c) as P. destruct (pass B c) as [|b r].
    + rewrite <- L in P. discriminate.
    + simpl in *. rewrite IH, E by lia. ring.
Qed.

(** Induction over pairs. *)
Lemma by_pairs (P : list R -> Prop) : P [] -> (forall a, P [a]) -> (forall a b c, P c -> P (a :: b :: c)) -> forall c, P c.
Proof.
  intros H0 H1 H2. assert (K : forall c, P c /\ forall a, P (a :: c)); [|intros c; apply K].
  induction c as [|b c [I1 I2]]; split; auto.
Qed.

Lemma loop_is_sums X b : forall j mean even f p, mean = X ^ (2 * j) * even_mean j -> even = 2 * INR j ->
  loop (X ^ 2) mean even f p b = (f + mean_sum X j b, p + sine_sum X j b).
Proof.
  induction b as [|a|a c b IH] using by_pairs; intros j m e f p -> ->; [simpl; f_equal; ring|simpl; f_equal; ring|].
  cbn [loop mean_sum sine_sum]. pose proof (pos_INR j).
  rewrite (IH (S j)); [f_equal; [ring|simpl even_mean; ring]| |rewrite S_INR; ring].
  replace (2 * S j)%nat with (2 * j + 2)%nat by lia. rewrite pow_add. simpl even_mean. ring.
Qed.

(** Three integrals of the part from coefficient [2 j] on. *)
Lemma integrals X b : forall j,
  is_RInt (fun t => (X * sin t) ^ (2 * j) * eval b (X * sin t)) 0 (2 * PI) (2 * PI * mean_sum X j b) /\
  is_RInt (fun t => (X * sin t) ^ (2 * j) * eval b (X * sin t) * sin t) 0 (2 * PI) (PI * X * sine_sum X j b) /\
  is_RInt (fun t => (X * sin t) ^ (2 * j) * eval b (X * sin t) * cos t) 0 (2 * PI) 0.
Proof.
  pose proof PI_RGT_0.
  assert (Z : forall f : R -> R, (forall t, f t = 0) -> is_RInt f 0 (2 * PI) 0).
  { intros f Hf. apply (ext (fun _ => 0)); [lra|intros; now rewrite Hf|].
    apply (equal _ _ _ ((2 * PI - 0) * 0)); [apply constant_integral|ring]. }
  (* one coefficient *)
  assert (one : forall a j, is_RInt (fun t => a * X ^ (2 * j) * sin t ^ (2 * j)) 0 (2 * PI) (2 * PI * (a * (X ^ (2 * j) * even_mean j)))).
  { intros a j. apply (equal _ _ _ (a * X ^ (2 * j) * (2 * PI * even_mean j))); [|ring]. apply multiply, even_power. }
  assert (one_sine : forall a j, is_RInt (fun t => a * X ^ (2 * j) * sin t ^ (2 * j + 1)) 0 (2 * PI) 0).
  { intros a j. apply (equal _ _ _ (a * X ^ (2 * j) * 0)); [|ring]. apply multiply, odd_power. }
  assert (one_cosine : forall a j, is_RInt (fun t => a * X ^ (2 * j) * (sin t ^ (2 * j) * cos t)) 0 (2 * PI) 0).
  { intros a j. apply (equal _ _ _ (a * X ^ (2 * j) * 0)); [|ring]. apply multiply, power_and_cosine. }
  induction b as [|a|a c b IH] using by_pairs; intros j.
  - simpl. repeat split; [apply (equal _ _ _ 0); [|ring]|apply (equal _ _ _ 0); [|ring]|]; apply Z; intros; simpl; ring.
  - cbn [eval mean_sum sine_sum]. repeat split.
    + apply (ext (fun t => a * X ^ (2 * j) * sin t ^ (2 * j))); [lra| |apply one]. intros. rewrite Rpow_mult_distr. ring.
    + apply (equal _ _ _ 0); [|ring].
      apply (ext (fun t => a * X ^ (2 * j) * sin t ^ (2 * j + 1))); [lra| |apply one_sine]. intros. rewrite Rpow_mult_distr, pow_add. ring.
    + apply (ext (fun t => a * X ^ (2 * j) * (sin t ^ (2 * j) * cos t))); [lra| |apply one_cosine]. intros. rewrite Rpow_mult_distr. ring.
  - destruct (IH (S j)) as [I1 [I2 I3]].
    assert (split_ : forall t, (X * sin t) ^ (2 * j) * eval (a :: c :: b) (X * sin t)
      = a * X ^ (2 * j) * sin t ^ (2 * j) + (c * X * X ^ (2 * j) * sin t ^ (2 * j + 1) + (X * sin t) ^ (2 * S j) * eval b (X * sin t))).
    { intros t. cbn [eval]. replace (2 * S j)%nat with (2 * j + 2)%nat by lia. rewrite !pow_add, Rpow_mult_distr. ring. }
    cbn [mean_sum sine_sum]. repeat split.
    + apply (equal _ _ _ (2 * PI * (a * (X ^ (2 * j) * even_mean j)) + (0 + 2 * PI * mean_sum X (S j) b))); [|ring].
      refine (ext _ _ _ _ _ _ (fun t _ => eq_sym (split_ t)) _); [lra|]. apply add; [apply one|apply add; [apply (one_sine (c * X) j)|exact I1]].
    + apply (equal _ _ _ (0 + (2 * PI * (c * X * (X ^ (2 * j) * even_mean (S j))) + PI * X * sine_sum X (S j) b))); [|ring].
      apply (ext (fun t => a * X ^ (2 * j) * sin t ^ (2 * j + 1) + (c * X * X ^ (2 * j) * sin t ^ (2 * S j)
        + (X * sin t) ^ (2 * S j) * eval b (X * sin t) * sin t))); [lra| |].
      * intros t _. rewrite split_. replace (2 * S j)%nat with (2 * j + 2)%nat by lia. rewrite !pow_add. ring.
      * apply add; [apply one_sine|apply add; [|exact I2]].
        apply (equal _ _ _ (c * X * X ^ (2 * j) * (2 * PI * even_mean (S j)))); [|ring]. apply multiply, even_power.
    + apply (equal _ _ _ (0 + (0 + 0))); [|ring].
      apply (ext (fun t => a * X ^ (2 * j) * (sin t ^ (2 * j) * cos t) + (c * X * X ^ (2 * j) * (sin t ^ (2 * j + 1) * cos t)
        + (X * sin t) ^ (2 * S j) * eval b (X * sin t) * cos t))); [lra| |].
      * intros t _. rewrite split_. ring.
      * apply add; [apply one_cosine|apply add; [|exact I3]].
        apply (equal _ _ _ (c * X * X ^ (2 * j) * 0)); [|ring]. apply multiply, power_and_cosine.
Qed.

Theorem statement : forall (c : list R) (B X : R),
  describes (static (eval c)) B X (polynomial_df c B X) /\ coded_df c B X = polynomial_df c B X.
Proof.
  intros c B X. split.
  - destruct (integrals X (about_bias B c) 0) as [I1 [I2 I3]]. pose proof PI_RGT_0.
    assert (O : forall t, (X * sin t) ^ (2 * 0) * eval (about_bias B c) (X * sin t) = output (static (eval c)) B X t).
    { intros t. rewrite about_bias_eval. unfold output, sweep; simpl. destruct (Rlt_dec 0 (cos t)); ring. }
    repeat split; simpl (f0 _); simpl (p _); simpl (q _).
    + refine (ext _ _ _ _ _ _ _ I1); [lra|]. intros t _. apply O.
    + refine (ext _ _ _ _ _ _ _ I2); [lra|]. intros t _. now rewrite <- O.
    + apply (equal _ _ _ 0); [|ring]. refine (ext _ _ _ _ _ _ _ I3); [lra|]. intros t _. now rewrite <- O.
  - unfold coded_df, polynomial_df. rewrite (loop_is_sums X _ 0); [f_equal; ring|simpl; ring|simpl; ring].
Qed.
Print Assumptions statement.
