(** claim: bounded-dual (of this project)
    Of all deviations within a box that meet the rows [slopes . z <= limit] for some element of their slopes, none has an objective above
    [sum y limit + sum_j (objective_j - sum y slope_j) z_j], evaluated in intervals, whatever multipliers y of zero or more are given. *)
From Coq Require Import Reals Lra List.
Import ListNotations.
Open Scope R_scope.

(** Intervals by their ends, and what a number is in one. *)
Definition interval := (R * R)%type.
Definition contains (i : interval) (x : R) : Prop := fst i <= x <= snd i.

(** A row: for each unknown the range of its slope, and the limit. *)
Record row := { slopes : list interval; limit : R }.

Fixpoint dot (u z : list R) : R := match u, z with a :: u, b :: z => a * b + dot u z | _, _ => 0 end.

(** [s] is an element of the row's slopes, and the deviation z meets the row with it. *)
Definition meets (z : list R) (r : row) : Prop := exists s, Forall2 contains (slopes r) s /\ dot s z <= limit r.

(** Any arithmetic of intervals that encloses: rounded outwards or exact. *)
Section Arithmetic.
Variable point : R -> interval.
Variables add sub mul : interval -> interval -> interval.
Hypothesis point_encloses : forall x, contains (point x) x.
Hypothesis add_encloses : forall i j x y, contains i x -> contains j y -> contains (add i j) (x + y).
Hypothesis sub_encloses : forall i j x y, contains i x -> contains j y -> contains (sub i j) (x - y).
Hypothesis mul_encloses : forall i j x y, contains i x -> contains j y -> contains (mul i j) (x * y).

(** [sum y limit]. *)
Fixpoint limits (rows : list row) (y : list R) : interval := match rows, y with
  | r :: rows, m :: y => add (mul (point m) (point (limit r))) (limits rows y) | _, _ => point 0 end.

(** What remains of the objective: [objective_j - sum y slope_j] for each unknown j. *)
Fixpoint less (remains : list interval) (m : R) (s : list interval) : list interval := match remains, s with
  | l :: remains, i :: s => sub l (mul (point m) i) :: less remains m s | _, _ => remains end.
Fixpoint rest (objective : list interval) (rows : list row) (y : list R) : list interval := match rows, y with
  | r :: rows, m :: y => rest (less objective m (slopes r)) rows y | _, _ => objective end.

Fixpoint over_box (remains box : list interval) : interval := match remains, box with
  | l :: remains, b :: box => add (mul l b) (over_box remains box) | _, _ => point 0 end.

(** The bound: the upper end. *)
Definition dual_bound (rows : list row) (y objective : list R) (box : list interval) : R :=
  snd (add (limits rows y) (over_box (rest (map point objective) rows y) box)).

Lemma over_box_encloses remains : forall w box z, Forall2 contains remains w -> Forall2 contains box z -> contains (over_box remains box) (dot w z).
Proof.
  induction remains as [|l remains IH]; intros w box z W Z; inversion W; subst; simpl; [apply point_encloses|].
  inversion Z; subst; simpl; [apply point_encloses|]. apply add_encloses; [apply mul_encloses; assumption|apply IH; assumption].
Qed.

(** One row accounted for: the numbers [w - m s]. *)
Fixpoint minus (w : list R) (m : R) (s : list R) : list R := match w, s with a :: w, b :: s => a - m * b :: minus w m s | _, _ => w end.

Lemma less_encloses remains : forall w m ranges s, Forall2 contains remains w -> Forall2 contains ranges s -> Forall2 contains (less remains m ranges) (minus w m s).
Proof.
  induction remains as [|l remains IH]; intros w m ranges s W S; inversion W; subst; simpl; [constructor|].
  inversion S; subst; simpl; [assumption|]. constructor; [apply sub_encloses; [assumption|apply mul_encloses; [apply point_encloses|assumption]]|apply IH; assumption].
Qed.

Lemma dot_minus w : forall m s z, length s = length w -> dot (minus w m s) z = dot w z - m * dot s z.
Proof.
  induction w as [|a w IH]; intros m s z L; destruct s as [|b s]; simpl in *; try discriminate; [ring|].
  destruct z as [|c z]; simpl; [ring|]. rewrite IH by congruence. ring.
Qed.

Lemma same_length (A B : Type) (P : A -> B -> Prop) l m : Forall2 P l m -> length l = length m.
Proof. induction 1; simpl; congruence. Qed.

Lemma weak_duality rows : forall y remains w box z, Forall (meets z) rows -> Forall (fun m => 0 <= m) y -> Forall2 contains remains w -> Forall2 contains box z ->
  (forall r, In r rows -> length (slopes r) = length remains) ->
  exists a b, contains (limits rows y) a /\ contains (over_box (rest remains rows y) box) b /\ dot w z <= a + b.
Proof.
  induction rows as [|r rows IH]; intros y remains w box z M Y W Z L; [|destruct y as [|m y]].
  - exists 0, (dot w z). split; [apply point_encloses|]. split; [apply over_box_encloses; assumption|lra].
  - exists 0, (dot w z). split; [apply point_encloses|]. split; [apply over_box_encloses; assumption|lra].
  - inversion M as [|? ? Mr Ms]; subst. inversion Y as [|? ? Ym Ys]; subst. destruct Mr as [s [S D]].
    pose proof (L r (or_introl eq_refl)) as Lr. pose proof (same_length _ _ _ _ _ S) as Ls. pose proof (same_length _ _ _ _ _ W) as Lw.
    assert (W' := less_encloses remains w m (slopes r) s W S).
    assert (Ll : length (less remains m (slopes r)) = length remains).
    { clear - Lr. revert remains Lr. induction (slopes r) as [|i t IHt]; intros [|l remains] Lr; simpl in *; try discriminate; [reflexivity|]. now rewrite IHt by congruence. }
    destruct (IH y (less remains m (slopes r)) (minus w m s) box z Ms Ys W' Z) as [a [b [A [B E]]]].
    { intros r' Hr'. rewrite Ll. apply L. right. exact Hr'. }
    exists (m * limit r + a), b. simpl. split; [apply add_encloses; [apply mul_encloses; apply point_encloses|exact A]|]. split; [exact B|].
    rewrite dot_minus in E by congruence. assert (m * dot s z <= m * limit r) by (apply Rmult_le_compat_l; assumption). lra.
Qed.

Theorem encloses : forall (rows : list row) (y objective : list R) (box : list interval) (z : list R),
  Forall (meets z) rows -> Forall (fun m => 0 <= m) y -> Forall2 contains box z -> (forall r, In r rows -> length (slopes r) = length objective) ->
  dot objective z <= dual_bound rows y objective box.
Proof.
  intros rows y objective box z M Y Z L.
  assert (O : Forall2 contains (map point objective) objective) by (clear - point_encloses; induction objective; simpl; constructor; auto).
  destruct (weak_duality rows y (map point objective) objective box z M Y O Z) as [a [b [A [B E]]]]; [intros r Hr; rewrite map_length; apply L, Hr|].
  pose proof (add_encloses _ _ _ _ A B) as S. unfold dual_bound. destruct S as [_ S]. lra.
Qed.
End Arithmetic.

(** The claim: any arithmetic that encloses. *)
Definition encloses_by (operation : interval -> interval -> interval) (f : R -> R -> R) : Prop :=
  forall i j x y, contains i x -> contains j y -> contains (operation i j) (f x y).

Theorem statement : forall (point : R -> interval) (add sub mul : interval -> interval -> interval),
  (forall x, contains (point x) x) -> encloses_by add Rplus -> encloses_by sub Rminus -> encloses_by mul Rmult ->
  forall (rows : list row) (y objective : list R) (box : list interval) (z : list R),
  Forall (meets z) rows -> Forall (fun m => 0 <= m) y -> Forall2 contains box z -> (forall r, In r rows -> length (slopes r) = length objective) ->
  dot objective z <= dual_bound point add sub mul rows y objective box.
Proof. intros point add sub mul P A S M. exact (encloses point add sub mul P A S M). Qed.

(** A multiplier below zero turns its row round: the bound is below the objective. *)
Definition exact_point (x : R) : interval := (x, x).
Definition exact_add (i j : interval) : interval := (fst i + fst j, snd i + snd j).
Definition exact_sub (i j : interval) : interval := (fst i - snd j, snd i - fst j).
Definition exact_mul (i j : interval) : interval :=
  (Rmin (Rmin (fst i * fst j) (fst i * snd j)) (Rmin (snd i * fst j) (snd i * snd j)),
   Rmax (Rmax (fst i * fst j) (fst i * snd j)) (Rmax (snd i * fst j) (snd i * snd j))).

Theorem needs_multipliers_not_negative : exists (rows : list row) (y objective z : list R) (box : list interval),
  Forall (meets z) rows /\ Forall2 contains box z /\ dual_bound exact_point exact_add exact_sub exact_mul rows y objective box < dot objective z.
Proof.
  exists [{| slopes := [(0, 0)]; limit := 1 |}], [-1], [0], [0], [(0, 0)]. split; [|split].
  - constructor; [|constructor]. exists [0]. split; [constructor; [unfold contains; simpl; lra|constructor]|simpl; lra].
  - constructor; [unfold contains; simpl; lra|constructor].
  - unfold dual_bound, exact_point, exact_add, exact_sub, exact_mul. simpl. unfold Rmax, Rmin. repeat destruct (Rle_dec _ _); lra.
Qed.

Print Assumptions statement.
