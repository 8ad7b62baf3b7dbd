(** How the inequalities of certificates are proved: by enclosure, and by the calculus that an end needs where the formula vanishes. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Hyperbolic Enclosure Bias.
Open Scope R_scope.

(** Functions by the names of the certificates. [tanh] is in the form that is enclosed ([Bias.tanh_once]). *)
Notation ln_1p x := (ln (1 + x)).
Notation atanh x := (ln ((1 + x) / (1 - x)) / 2).
Notation tanh x := (1 - 2 / (exp (2 * x) + 1)).

(** Taylor at zero: [f >= b x^n] where the derivative of order n is at least [n! b] and the lower ones vanish at zero. *)
Lemma over_square (f f1 f2 : R -> R) b z : 0 <= z -> f 0 = 0 -> f1 0 = 0 ->
  (forall x, 0 <= x <= z -> is_derive f x (f1 x) /\ is_derive f1 x (f2 x) /\ 2 * b <= f2 x) -> b * z ^ 2 <= f z.
Proof.
  intros Hz F0 F1 D. assert (S : forall x, 0 <= x <= z -> 0 <= f1 x - 2 * b * x).
  { intros x Hx. apply (below_by_slope (fun x => f1 x - 2 * b * x) (fun x => f2 x - 2 * b)); [lra|lra| |].
    - intros y Hy. apply (is_derive_minus f1 (fun x => 2 * b * x)); [apply D; lra|auto_derive; [trivial|ring]].
    - intros y Hy. destruct (D y ltac:(lra)) as [_ [_ L]]. lra. }
  assert (0 <= f z - b * z ^ 2); [|lra].
  apply (below_by_slope (fun x => f x - b * x ^ 2) (fun x => f1 x - 2 * b * x)); [lra|rewrite F0; ring| |].
  - intros y Hy. apply (is_derive_minus f (fun x => b * x ^ 2)); [apply D; lra|auto_derive; [trivial|ring]].
  - intros y Hy. apply S. lra.
Qed.

Lemma over_cube (f f1 f2 f3 : R -> R) b z : 0 <= z -> f 0 = 0 -> f1 0 = 0 -> f2 0 = 0 ->
  (forall x, 0 <= x <= z -> is_derive f x (f1 x) /\ is_derive f1 x (f2 x) /\ is_derive f2 x (f3 x) /\ 6 * b <= f3 x) -> b * z ^ 3 <= f z.
Proof.
  intros Hz F0 F1 F2 D. assert (S : forall x, 0 <= x <= z -> 3 * b * x ^ 2 <= f1 x).
  { intros x Hx. apply (over_square f1 f2 f3 (3 * b)); try lra. intros y Hy. destruct (D y ltac:(lra)) as [_ [A [B C]]]. split; [exact A|split; [exact B|lra]]. }
  assert (0 <= f z - b * z ^ 3); [|lra].
  apply (below_by_slope (fun x => f x - b * x ^ 3) (fun x => f1 x - 3 * b * x ^ 2)); [lra|rewrite F0; ring| |].
  - intros y Hy. apply (is_derive_minus f (fun x => b * x ^ 3)); [apply D; lra|auto_derive; [trivial|ring]].
  - intros y Hy. specialize (S y ltac:(lra)). lra.
Qed.

(** * Tactics, by the form of an inequality *)

Ltac domain := repeat match goal with H : _ /\ _ |- _ => destruct H end.
Ltac derive := auto_derive; [repeat split; try interval with (i_prec 40); trivial|reflexivity].

(** [bound <= formula]. *)
Ltac enclosed x := first [interval with (i_prec 80)|interval with (i_prec 40, i_bisect x, i_depth 8)|interval with (i_prec 40, i_bisect x, i_taylor x, i_degree 5)].
Tactic Notation "value_of" ident(x) := intros; domain; enclosed x.
Tactic Notation "value_of" ident(x) ident(y) := intros; domain; interval with (i_prec 40, i_bisect x, i_bisect y).
Tactic Notation "value_of" ident(x) ident(y) ident(z) := intros; domain; interval with (i_prec 40, i_bisect x, i_bisect y, i_bisect z, i_depth 60).

(** The derivative is at least the bound; that of [z - tanh z] is [tanh z] squared, which has a limit. *)
Ltac tanh_square :=
  match goal with |- _ <= ?d => match d with context [exp (2 * ?z)] =>
    replace d with ((1 - 2 / (exp (2 * z) + 1)) ^ 2) by (pose proof (exp_pos (2 * z)); field; lra)
  end end; interval with (i_prec 80).
Ltac slope := intros; domain; eexists; split; [derive|cbv beta; first [lra|nra|interval with (i_prec 80)|tanh_square]].
Tactic Notation "slope_of" ident(x) := slope.
Tactic Notation "slope_of" ident(x) ident(y) := slope.
Tactic Notation "slope_of" ident(x) ident(y) ident(z) := slope.

(** The formula over a power at zero, by Taylor; itself beyond. *)
Ltac vanishes :=
  cbv beta;
  repeat match goal with |- context [ln ?a] => replace (ln a) with 0 by (symmetry; replace a with 1 by field; apply ln_1) end;
  repeat match goal with |- context [exp ?a] => replace (exp a) with 1 by (symmetry; replace a with 0 by ring; apply exp_0) end;
  field.
Ltac function_of x := match goal with |- ?b <= ?f => let g := eval pattern x in f in match g with ?h _ => change (b <= h x) end end.
Ltac derivatives :=
  lazymatch goal with
  | |- is_derive _ _ _ /\ _ => split; [derive|cbv beta; derivatives]
  | |- _ <= _ => match goal with x : R |- _ => interval with (i_prec 40, i_bisect x) end
  end.
Ltac taylor x low high :=
  let step := (let y := fresh in intros y [? ?]; match type of high with _ <= ?top => assert (y <= top) by lra end; derivatives) in
  function_of x;
  first [eapply over_square; [exact low| | |step]; vanishes|eapply over_cube; [exact low| | | |step]; vanishes].
Tactic Notation "over_power_of" ident(x) :=
  let low := fresh in let high := fresh in let near := fresh in
  intros x [low high];
  lazymatch goal with
  | |- _ /\ _ => split; intros near; [taylor x low near|enclosed x]
  | |- _ => taylor x low high
  end.
