(** The tactic [interval] of the Interval library over the integers [Z] of Coq itself.
    Out of the box it computes with the machine's floats and 63-bit integers, which Coq takes as axioms; here every digit is computed
    by the kernel, and [Print Assumptions] stays at the axioms of the reals. Always say [i_prec]: without it the machine's floats are
    taken. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Interval Require Tactic.
From Interval.Float Require Import Specific_stdz Specific_ops.
Module Digits := SpecificFloat StdZRadix2.
Module Kernel := Tactic.IntervalTactic Digits.
Export Interval.Tactic.
Export Kernel.

(** A derivative computed and enclosed tells apart from another number. *)
Ltac other_derivative D :=
  let E := fresh in
  match type of D with is_derive ?f ?x ?l =>
    assert (E : exists d, is_derive f x d /\ (d < l \/ l < d)) by
      (eexists; split; [auto_derive; [repeat split; try interval with (i_prec 40); trivial|reflexivity]|
        (left; interval with (i_prec 40)) || (right; interval with (i_prec 40))]);
    destruct E as [d [E [L|L]]]; apply is_derive_unique in E; apply is_derive_unique in D; rewrite E in D; lra
  end.
