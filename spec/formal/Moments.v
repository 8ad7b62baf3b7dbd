(** Polynomials, and the integrals of powers of the sine. *)
From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic.
Import ListNotations.
Open Scope R_scope.

(** A polynomial by its coefficients, the constant first. *)
Fixpoint eval (c : list R) (x : R) : R := match c with [] => 0 | a :: c => a + x * eval c x end.

(** The mean of [sin^(2j)]: 1, 1/2, 3/8, ... *)
Fixpoint even_mean (j : nat) : R :=
  match j with O => 1 | S i => even_mean i * ((2 * INR i + 1) / (2 * INR i + 2)) end.

Lemma sine_power_ex n a b : ex_RInt (fun t => sin t ^ n) a b.
Proof.
  apply (ex_RInt_continuous (V := R_CompleteNormedModule)). intros t _.
  apply (ex_derive_continuous (V := R_NormedModule)). auto_derive. trivial.
Qed.

(** Two more powers, where the cosine or the sine vanishes at both ends. *)
Lemma two_more n a b l : cos a * sin a ^ S n = 0 -> cos b * sin b ^ S n = 0 ->
  is_RInt (fun t => sin t ^ n) a b l -> is_RInt (fun t => sin t ^ (S (S n))) a b ((INR n + 1) / (INR n + 2) * l).
Proof.
  intros Ha Hb I. pose proof (pos_INR n) as P.
  assert (K : is_RInt (fun t => (INR n + 2) * sin t ^ S (S n) - (INR n + 1) * sin t ^ n) a b (- (cos b * sin b ^ S n) - - (cos a * sin a ^ S n))).
  { apply (by_antiderivative (fun t => - (cos t * sin t ^ S n))).
    - intros t. auto_derive; [trivial|]. pose proof (sin2_cos2 t) as Q. unfold Rsqr in Q.
      replace (match n with O => 1 | S _ => INR n + 1 end) with (INR n + 1) by (destruct n; simpl; lra). simpl pred.
      replace (1 * cos t) with (cos t) by ring.
      replace (cos t * (cos t * ((INR n + 1) * sin t ^ n))) with ((INR n + 1) * sin t ^ n * (cos t * cos t)) by ring.
      replace (cos t * cos t) with (1 - sin t * sin t) by lra. simpl. ring.
    - intros t. auto_derive. trivial. }
  rewrite Ha, Hb in K.
  pose proof (multiply _ (/ (INR n + 2)) _ _ _ (add _ _ _ _ _ _ K (multiply _ (INR n + 1) _ _ _ I))) as M.
  apply (equal _ _ _ (/ (INR n + 2) * (- 0 - - 0 + (INR n + 1) * l))); [|field; lra].
  refine (is_RInt_ext (V := R_NormedModule) _ _ _ _ _ _ M). intros t _. simpl. field. lra.
Qed.

Lemma even_power j : is_RInt (fun t => sin t ^ (2 * j)) 0 (2 * PI) (2 * PI * even_mean j).
Proof.
  induction j as [|j IH].
  - simpl. apply (equal _ _ _ ((2 * PI - 0) * 1)); [apply constant_integral|ring].
  - replace (2 * S j)%nat with (S (S (2 * j))) by lia.
    apply (equal _ _ _ ((INR (2 * j) + 1) / (INR (2 * j) + 2) * (2 * PI * even_mean j))).
    + apply two_more; [rewrite sin_0; simpl; ring|rewrite sin_2PI; simpl; ring|exact IH].
    + rewrite mult_INR. pose proof (pos_INR j). simpl. field. lra.
Qed.

Lemma odd_power j : is_RInt (fun t => sin t ^ (2 * j + 1)) 0 (2 * PI) 0.
Proof.
  induction j as [|j IH].
  - simpl. apply (ext sin); [pose proof PI_RGT_0; lra|intros; ring|].
    apply (equal _ _ _ (- cos (2 * PI) - - cos 0)); [|rewrite cos_2PI, cos_0; ring].
    apply (by_antiderivative (fun t => - cos t)); intros t; auto_derive; trivial; ring.
  - replace (2 * S j + 1)%nat with (S (S (2 * j + 1))) by lia.
    apply (equal _ _ _ ((INR (2 * j + 1) + 1) / (INR (2 * j + 1) + 2) * 0)); [|ring].
    apply two_more; [rewrite sin_0; simpl; ring|rewrite sin_2PI; simpl; ring|exact IH].
Qed.

Lemma power_and_cosine n : is_RInt (fun t => sin t ^ n * cos t) 0 (2 * PI) 0.
Proof.
  pose proof (pos_INR n).
  apply (equal _ _ _ (sin (2 * PI) ^ S n / (INR n + 1) - sin 0 ^ S n / (INR n + 1))).
  - apply (by_antiderivative (fun t => sin t ^ S n / (INR n + 1))); intros t; auto_derive; trivial.
    replace (match n with O => 1 | S _ => INR n + 1 end) with (INR n + 1) by (destruct n; simpl; lra). simpl. field. lra.
  - rewrite sin_2PI, sin_0. simpl. field. lra.
Qed.
