(** Six degrees of freedom: vectors and matrices by index, the vehicle of eq. 5, and the solution of a positive definite system.
    Shared by six-axes, uncoupled-axis and heave. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Selfosc Require Import Common.
Import ListNotations.
Open Scope R_scope.

Fixpoint sum (n : nat) (f : nat -> R) : R := match n with O => 0 | S k => sum k f + f k end.
Definition vector := nat -> R.
Definition matrix := nat -> nat -> R.
Definition dot (n : nat) (u w : vector) : R := sum n (fun i => u i * w i).
Definition times (n : nat) (M : matrix) (u : vector) : vector := fun i => sum n (fun j => M i j * u j).
Definition plus (M N : matrix) : matrix := fun i j => M i j + N i j.

Definition symmetric (n : nat) (M : matrix) : Prop := forall i j, (i < n)%nat -> (j < n)%nat -> M i j = M j i.
Definition nonzero (n : nat) (u : vector) : Prop := exists i, (i < n)%nat /\ u i <> 0.
Definition positive_definite (n : nat) (M : matrix) : Prop := forall u, nonzero n u -> 0 < dot n u (times n M u).
Definition semidefinite (n : nat) (M : matrix) : Prop := forall u, 0 <= dot n u (times n M u).

(** * A symmetric positive definite system has one solution: elimination of the last unknown *)

Lemma sum_ext n f g : (forall i, (i < n)%nat -> f i = g i) -> sum n f = sum n g.
Proof. induction n as [|n IH]; intros H; [reflexivity|]. simpl. rewrite IH, H by (try intros; try apply H; lia). reflexivity. Qed.
Lemma sum_plus n f g : sum n (fun i => f i + g i) = sum n f + sum n g.
Proof. induction n as [|n IH]; simpl; [ring|rewrite IH; ring]. Qed.
Lemma sum_scal n c f : sum n (fun i => c * f i) = c * sum n f.
Proof. induction n as [|n IH]; simpl; [ring|rewrite IH; ring]. Qed.
Lemma sum_zero n f : (forall i, (i < n)%nat -> f i = 0) -> sum n f = 0.
Proof. induction n as [|n IH]; intros H; [reflexivity|]. simpl. rewrite IH, H by (try intros; try apply H; lia). ring. Qed.

Definition last (n : nat) (a : R) (u : vector) : vector := fun i => if Nat.eqb i n then a else u i.
Lemma last_is n a u : last n a u n = a.
Proof. unfold last. now rewrite Nat.eqb_refl. Qed.
Lemma last_below n a u i : (i < n)%nat -> last n a u i = u i.
Proof. intros H. unfold last. destruct (Nat.eqb_spec i n); [lia|reflexivity]. Qed.

Definition reduced (n : nat) (M : matrix) : matrix := fun i j => M i j - M i n * M n j / M n n.

Lemma times_last n M a u i : times (S n) M (last n a u) i = times n M u i + M i n * a.
Proof. unfold times. simpl. rewrite last_is. f_equal. apply sum_ext. intros j Hj. now rewrite last_below. Qed.

Lemma times_reduced n M u i : times n (reduced n M) u i = times n M u i - M i n / M n n * times n M u n.
Proof.
  unfold times. rewrite <- sum_scal. replace (sum n (fun j => M i j * u j) - sum n (fun j => M i n / M n n * (M n j * u j)))
    with (sum n (fun j => M i j * u j) + -1 * sum n (fun j => M i n / M n n * (M n j * u j))) by ring.
  rewrite <- sum_scal, <- sum_plus. apply sum_ext. intros j _. unfold reduced, Rdiv. ring.
Qed.

Lemma pivot n M : positive_definite (S n) M -> 0 < M n n.
Proof.
  intros H. specialize (H (last n 1 (fun _ => 0))). unfold dot in H. simpl in H. rewrite last_is, times_last in H.
  rewrite (sum_zero n) in H by (intros i Hi; rewrite last_below by exact Hi; ring).
  assert (Z : times n M (fun _ => 0) n = 0) by (apply sum_zero; intros; ring). rewrite Z in H.
  assert (0 < 0 + 1 * (0 + M n n * 1)); [|lra]. apply H. exists n. rewrite last_is. split; [lia|lra].
Qed.

Lemma reduced_definite n M : symmetric (S n) M -> positive_definite (S n) M -> symmetric n (reduced n M) /\ positive_definite n (reduced n M).
Proof.
  intros Sy H. pose proof (pivot n M H) as P. split.
  - intros i j Hi Hj. unfold reduced. rewrite (Sy i j), (Sy i n), (Sy n j) by lia. unfold Rdiv. ring.
  - intros u [k [Hk Uk]]. set (s := times n M u n). set (a := - s / M n n).
    assert (W : nonzero (S n) (last n a u)) by (exists k; rewrite last_below by exact Hk; split; [lia|exact Uk]).
    specialize (H _ W). unfold dot in *. simpl in H. rewrite last_is, times_last in H.
    rewrite (sum_ext n _ (fun i => u i * times n M u i + a * (M n i * u i))) in H
      by (intros i Hi; rewrite last_below, times_last, (Sy i n) by lia; ring).
    rewrite sum_plus, sum_scal in H. change (sum n (fun i => M n i * u i)) with s in H. fold s in H.
    rewrite (sum_ext n _ (fun i => u i * times n M u i + - (s / M n n) * (M n i * u i))).
    + rewrite sum_plus, sum_scal. change (sum n (fun i => M n i * u i)) with s.
      replace (sum n (fun i => u i * times n M u i) + - (s / M n n) * s)
        with (sum n (fun i => u i * times n M u i) + a * s + a * (s + M n n * a)) by (unfold a; field; lra). exact H.
    + intros i Hi. rewrite times_reduced. fold s. rewrite (Sy i n) by lia. unfold Rdiv. ring.
Qed.

Theorem definite_solves n : forall M, symmetric n M -> positive_definite n M -> forall b, exists u, forall i, (i < n)%nat -> times n M u i = b i.
Proof.
  induction n as [|n IH]; intros M Sy H b; [exists b; intros i Hi; lia|]. pose proof (pivot n M H) as P.
  destruct (reduced_definite n M Sy H) as [Sy' H'].
  destruct (IH _ Sy' H' (fun i => b i - M i n * b n / M n n)) as [u Hu].
  exists (last n ((b n - times n M u n) / M n n) u). intros i Hi. rewrite times_last.
  destruct (Nat.eq_dec i n) as [->|N]; [field; lra|]. specialize (Hu i ltac:(lia)). rewrite times_reduced in Hu.
  replace (b i) with (times n M u i - M i n / M n n * times n M u n + M i n * b n / M n n) by (rewrite Hu; ring). field. lra.
Qed.

Theorem definite_once n M b u w : positive_definite n M ->
  (forall i, (i < n)%nat -> times n M u i = b i) -> (forall i, (i < n)%nat -> times n M w i = b i) -> forall i, (i < n)%nat -> u i = w i.
Proof.
  intros H U W i Hi. destruct (Req_dec (u i - w i) 0) as [E|N]; [lra|exfalso].
  specialize (H (fun j => u j - w j) (ex_intro _ i (conj Hi N))).
  assert (Z : dot n (fun j => u j - w j) (times n M (fun j => u j - w j)) = 0); [|lra].
  apply sum_zero. intros j Hj. replace (times n M (fun j => u j - w j) j) with (times n M u j - times n M w j); [rewrite U, W by exact Hj; ring|].
  unfold times. replace (sum n (fun k => M j k * u k) - sum n (fun k => M j k * w k))
    with (sum n (fun k => M j k * u k) + -1 * sum n (fun k => M j k * w k)) by ring.
  rewrite <- sum_scal, <- sum_plus. apply sum_ext. intros k _. ring.
Qed.

(** * The vehicle *)

(** [skew a u] is the cross product a x u. *)
Definition skew (a : vector) : matrix := fun i j => match i, j with
  | 0%nat, 1%nat => - a 2%nat | 0%nat, 2%nat => a 1%nat | 1%nat, 0%nat => a 2%nat | 1%nat, 2%nat => - a 0%nat | 2%nat, 0%nat => - a 1%nat | 2%nat, 1%nat => a 0%nat | _, _ => 0 end.
Definition blocks (A B C D : matrix) : matrix := fun i j =>
  if Nat.ltb i 3 then if Nat.ltb j 3 then A i j else B i (j - 3)%nat else if Nat.ltb j 3 then C (i - 3)%nat j else D (i - 3)%nat (j - 3)%nat.
Definition diagonal (d : vector) : matrix := fun i j => if Nat.eqb i j then d i else 0.
Definition opposite (M : matrix) : matrix := fun i j => - M i j.

(** [M_RB = [[m I, -m S(r_g)], [m S(r_g), I_o]]]. *)
Definition rigid_body (m : R) (r_g : vector) (I_o : matrix) : matrix :=
  blocks (diagonal (fun _ => m)) (opposite (skew (fun i => m * r_g i))) (skew (fun i => m * r_g i)) I_o.

(** [C(nu) = [[0, -S(p)], [-S(p), -S(h)]]], [(p, h) = M nu] the momenta. *)
Definition linear (u : vector) : vector := u.
Definition angular (u : vector) : vector := fun i => u (3 + i)%nat.
Definition coriolis (M : matrix) (nu : vector) : matrix :=
  let momenta := times 6 M nu in
  blocks (fun _ _ => 0) (opposite (skew (linear momenta))) (opposite (skew (linear momenta))) (opposite (skew (angular momenta))).

(** [D(nu)]: linear drag, and quadratic drag axis by axis. *)
Definition drag_matrix (linear_drag : matrix) (quadratic_drag nu : vector) : matrix :=
  plus linear_drag (diagonal (fun i => quadratic_drag i * Rabs (nu i))).

(** The vertical seen from the body, by roll and pitch; yaw does not matter. *)
Definition down (roll pitch : R) : vector := fun i => match i with
  | 0%nat => - sin pitch | 1%nat => sin roll * cos pitch | _ => cos roll * cos pitch end.
Definition cross (a b : vector) : vector := times 3 (skew a) b.

(** [g]: minus weight W and buoyancy B with their moments. *)
Definition restoring (W B : R) (r_g r_b : vector) (roll pitch : R) : vector := fun i =>
  if Nat.ltb i 3 then - (W * down roll pitch i - B * down roll pitch i)
  else - (cross r_g (fun k => W * down roll pitch k) (i - 3)%nat + cross r_b (fun k => - B * down roll pitch k) (i - 3)%nat).

(** Eq. 5: [M nu' + C(nu) nu + D(nu) nu + g = tau]. *)
Definition eq_5 (M : matrix) (linear_drag : matrix) (quadratic_drag g nu nu' tau : vector) : Prop := forall i, (i < 6)%nat ->
  times 6 M nu' i + times 6 (coriolis M nu) nu i + times 6 (drag_matrix linear_drag quadratic_drag nu) nu i + g i = tau i.

Ltac indices := intros; repeat match goal with i : nat |- _ => destruct i as [|i]; try lia end.
