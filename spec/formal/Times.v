(** The times at either command, and what they say of a disturbance. Shared by delta-from-times and heave. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Switching.
Open Scope R_scope.

(** From the instant a to b the command y is held at [C] for the time [t_plus] in all, and at [-C] for [t_minus], in finitely many pieces. *)
Inductive held (C : R) (y : R -> R) (a : R) : R -> R -> R -> Prop :=
| nothing : held C y a a 0 0
| high_for b c t_plus t_minus : held C y a b t_plus t_minus -> b < c -> (forall t, b < t < c -> y t = C) -> held C y a c (t_plus + (c - b)) t_minus
| low_for b c t_plus t_minus : held C y a b t_plus t_minus -> b < c -> (forall t, b < t < c -> y t = - C) -> held C y a c t_plus (t_minus + (c - b)).

Lemma held_time C y a b p m : held C y a b p m -> b - a = p + m /\ a <= b.
Proof. induction 1; lra. Qed.

(** Along the pieces momentum and linear drag grow by what command and disturbance give. *)
Lemma balance start alpha beta delta C y T_d x v a b p m : alpha <> 0 ->
  axis start alpha beta 0 delta (fun t => y (t - T_d)) x v -> start < a + T_d -> held C y a b p m ->
  alpha * v (b + T_d) + beta * x (b + T_d) - (alpha * v (a + T_d) + beta * x (a + T_d)) = C * (p - m) + delta * (b - a).
Proof.
  intros Ha [X V N] Sa H.
  assert (piece : forall b c w, a <= b -> b < c -> (forall t, b < t < c -> y t = w) ->
    alpha * v (c + T_d) + beta * x (c + T_d) - (alpha * v (b + T_d) + beta * x (b + T_d)) = (w + delta) * (c - b)).
  { intros b' c w ab bc Y.
    assert (K : alpha * v (c + T_d) + beta * x (c + T_d) - (w + delta) * (c + T_d) = alpha * v (b' + T_d) + beta * x (b' + T_d) - (w + delta) * (b' + T_d)).
    { apply (is_constant (fun t => alpha * v t + beta * x t - (w + delta) * t)); [lra|intros t Ht|intros t Ht].
      - assert (Y' : forall s, b' + T_d < s < c + T_d -> y (s - T_d) = w) by (intros s Hs; apply Y; lra).
        assert (Loc : locally t (fun s => y (s - T_d) = y (t - T_d))).
        { assert (P : 0 < Rmin (t - (b' + T_d)) (c + T_d - t)) by (apply Rmin_pos; lra). exists (mkposreal _ P). intros s Hs.
          change (Rabs (s - t) < Rmin (t - (b' + T_d)) (c + T_d - t)) in Hs. apply Rabs_def2 in Hs.
          pose proof (Rmin_l (t - (b' + T_d)) (c + T_d - t)). pose proof (Rmin_r (t - (b' + T_d)) (c + T_d - t)). rewrite !Y' by lra. reflexivity. }
        pose proof (N t ltac:(lra) Loc) as Dv. cbv beta in Dv. rewrite (Y' t Ht) in Dv.
        pose proof (is_derive_plus _ _ t _ _ (is_derive_scal v t alpha _ Dv) (is_derive_scal x t beta _ (X t ltac:(lra)))) as D.
        assert (Dl : is_derive (fun t => (w + delta) * t) t (w + delta)) by (auto_derive; [trivial|ring]).
        pose proof (is_derive_minus _ _ t _ _ D Dl) as E. revert E. unfold minus, plus, opp, scal; simpl; unfold mult; simpl. intros E.
        match type of E with is_derive _ _ ?l => replace l with 0 in E by (unfold drag; field; exact Ha) end. exact E.
      - apply (continuity_pt_minus (fun t => alpha * v t + beta * x t) (fun t => (w + delta) * t)).
        + apply (continuity_pt_plus (fun t => alpha * v t) (fun t => beta * x t)); apply continuity_pt_mult;
            try (apply continuity_pt_const; intros p' q'; reflexivity).
          * apply continuity_of_continuous, V. lra.
          * apply (continuity_of_derive x t (v t)), X. lra.
        + apply (continuity_of_derive _ t (w + delta)). auto_derive; [trivial|ring]. }
    lra. }
  induction H as [|b c p m H IH bc Y|b c p m H IH bc Y].
  - ring.
  - pose proof (held_time _ _ _ _ _ _ H). pose proof (piece b c C ltac:(lra) bc Y). lra.
  - pose proof (held_time _ _ _ _ _ _ H). pose proof (piece b c (- C) ltac:(lra) bc Y). lra.
Qed.

(** The estimate. *)
Definition delta_of_times (C t_plus t_minus T : R) : R := - (C * (t_plus - t_minus) / T).
