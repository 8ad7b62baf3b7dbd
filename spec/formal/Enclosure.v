(** The tactic [interval] of the Interval library over the integers [Z] of Coq itself.
    Out of the box it computes with the machine's floats and 63-bit integers, which Coq takes as axioms; here every digit is computed
    by the kernel, and [Print Assumptions] stays at the axioms of the reals. Always say [i_prec]: without it the machine's floats are
    taken. *)
From Interval Require Tactic.
From Interval.Float Require Import Specific_stdz Specific_ops.
Module Digits := SpecificFloat StdZRadix2.
Module Kernel := Tactic.IntervalTactic Digits.
Export Interval.Tactic.
Export Kernel.
