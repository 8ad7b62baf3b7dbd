(** The formulas of the program, written by [selfosc verify --formulas]: not to be edited. A changed formula changes this file, and breaks
    the theorems [formula_...] that say what it equals. *)
From Coq Require Import Reals List.
From Selfosc Require Import Kernels Catalogue.
Import ListNotations.
Open Scope R_scope.

Definition step_above_both (at_ height bias amplitude : R) :=
  (height * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) / PI, 2 * height * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) / (PI * amplitude), 0).

Definition ramp_above_both (at_ slope bias amplitude : R) :=
  (slope * (amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / PI - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) / PI + amplitude * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) / PI + (Rmax (bias - at_ - amplitude) 0)), slope * ((if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) - (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) * (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) / PI, 0).

Definition step_below_both (at_ height bias amplitude : R) :=
  (height * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2) / PI, -2 * height * (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2))) / (PI * amplitude), 0).

Definition ramp_below_both (at_ slope bias amplitude : R) :=
  (slope * (amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / PI - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2) / PI + amplitude * (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2))) / PI + (Rmax (at_ - bias - amplitude) 0)), slope * ((sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2))) * (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) - (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2)) / PI, 0).

Definition step_above_rising (at_ height bias amplitude : R) :=
  (height * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) / (2 * PI), height * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) / (PI * amplitude), height * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / (PI * amplitude)).

Definition ramp_above_rising (at_ slope bias amplitude : R) :=
  (slope * (amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / PI - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) / PI + amplitude * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) / PI + (Rmax (bias - at_ - amplitude) 0)) / 2, slope * ((if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) - (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) * (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) / (2 * PI), slope * ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2)^2 + 4 * (Rmax (bias - at_ - amplitude) 0) / amplitude) / (2 * PI)).

Definition step_below_rising (at_ height bias amplitude : R) :=
  (height * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2) / (2 * PI), -height * (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2))) / (PI * amplitude), height * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / (PI * amplitude)).

Definition ramp_below_rising (at_ slope bias amplitude : R) :=
  (slope * (amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / PI - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2) / PI + amplitude * (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2))) / PI + (Rmax (at_ - bias - amplitude) 0)) / 2, slope * ((sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2))) * (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) - (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2)) / (2 * PI), slope * ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2)^2 + 4 * (Rmax (at_ - bias - amplitude) 0) / amplitude) / (2 * PI)).

Definition step_above_falling (at_ height bias amplitude : R) :=
  (height * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) / (2 * PI), height * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) / (PI * amplitude), -height * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / (PI * amplitude)).

Definition ramp_above_falling (at_ slope bias amplitude : R) :=
  (slope * (amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / PI - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) / PI + amplitude * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) / PI + (Rmax (bias - at_ - amplitude) 0)) / 2, slope * ((if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2) - (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) * (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) / (2 * PI), slope * (-(Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2)^2 - 4 * (Rmax (bias - at_ - amplitude) 0) / amplitude) / (2 * PI)).

Definition step_below_falling (at_ height bias amplitude : R) :=
  (height * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2) / (2 * PI), -height * (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2))) / (PI * amplitude), -height * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / (PI * amplitude)).

Definition ramp_below_falling (at_ slope bias amplitude : R) :=
  (slope * (amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / PI - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2) / PI + amplitude * (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2))) / PI + (Rmax (at_ - bias - amplitude) 0)) / 2, slope * ((sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2))) * (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) - (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - at_) / amplitude) (-1)) 1))) / 2)) / (2 * PI), slope * (-(Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2)^2 - 4 * (Rmax (at_ - bias - amplitude) 0) / amplitude) / (2 * PI)).

Definition sign_both (at_ level bias amplitude : R) :=
  (-2 * level * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (PI - 2 * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2)) / 2 else (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / PI, 4 * level * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) / (PI * amplitude), 0).

Definition constant_both (value bias amplitude : R) :=
  (value, 0, 0).

Definition sign_rising (at_ level bias amplitude : R) :=
  (-level * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (PI - 2 * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2)) / 2 else (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / PI, 2 * level * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) / (PI * amplitude), -2 * level * (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) / (PI * amplitude)).

Definition constant_rising (value bias amplitude : R) :=
  (value / 2, 0, 2 * value / (PI * amplitude)).

Definition sign_falling (at_ level bias amplitude : R) :=
  (-level * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (PI - 2 * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / 2)) / 2 else (asin (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1))) / PI, 2 * level * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - at_ / amplitude) 0) 2) * (Rmin (Rmax (at_ / amplitude - bias / amplitude + 1) 0) 2))) / (PI * amplitude), 2 * level * (Rmin (Rmax ((at_ - bias) / amplitude) (-1)) 1) / (PI * amplitude)).

Definition constant_falling (value bias amplitude : R) :=
  (value / 2, 0, -2 * value / (PI * amplitude)).

Definition line_df (slope bias amplitude : R) :=
  (bias * slope, slope, 0).

Definition band (origin lower upper slope bias amplitude : R) :=
  (slope * (if Rlt_dec 0 ((2 * lower - 2 * bias - amplitude) / 2) then lower - origin + amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((lower - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((lower - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((lower - bias) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) / PI - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((lower - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((lower - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((lower - bias) / amplitude) (-1)) 1))) / 2) / PI + amplitude * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) * (Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2))) / PI + (Rmax (bias - lower - amplitude) 0) - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) / PI + amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1))) / 2) / PI - amplitude * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) * (Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2))) / PI - (Rmax (bias - upper - amplitude) 0) else (if Rlt_dec 0 ((2 * bias - 2 * upper - amplitude) / 2) then upper - origin + amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) / PI - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1))) / 2) / PI + amplitude * (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2))) / PI + (Rmax (lower - bias - amplitude) 0) - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - upper) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - upper) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - upper) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) / PI + amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - upper) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - upper) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - upper) / amplitude) (-1)) 1))) / 2) / PI - amplitude * (sqrt ((Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2))) / PI - (Rmax (upper - bias - amplitude) 0) else (if Rlt_dec 0 (upper - lower - amplitude) then bias - origin + amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) / PI - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1))) / 2) / PI + amplitude * (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2))) / PI + (Rmax (lower - bias - amplitude) 0) - amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1))) / 2) * (Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) / PI + amplitude * (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1))) / 2) / PI - amplitude * (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) * (Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2))) / PI - (Rmax (bias - upper - amplitude) 0) else (lower - 2 * origin + upper + 2 * ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) + (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - 2 * bias) * ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) / ((sqrt ((Rmax ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) 0))) + (sqrt ((Rmax ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude))) 0)))) - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) / ((sqrt ((Rmax ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) 0))) + (sqrt ((Rmax ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude))) 0)))) - (atan (((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) / ((sqrt ((Rmax ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) 0))) + (sqrt ((Rmax ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude))) 0))))))) / PI - 2 * (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) * (atan (((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) + (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - 2 * bias) / ((sqrt ((Rmax ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) 0))) + (sqrt ((Rmax ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude))) 0)))))) / PI + 2 * (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) * (atan (((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) + (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - 2 * bias) / ((sqrt ((Rmax ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) 0))) + (sqrt ((Rmax ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude))) 0)))))) / PI + (Rmax (Rmax (lower - bias - amplitude) (bias - amplitude - lower)) 0) - (Rmax (Rmax (upper - bias - amplitude) (bias - amplitude - upper)) 0)) / 2))), slope * (if Rlt_dec 0 ((2 * lower - 2 * bias - amplitude) / 2) then ((if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((lower - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((lower - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((lower - bias) / amplitude) (-1)) 1))) / 2) - (sqrt ((Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) * (Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2))) * (Rmin (Rmax ((lower - bias) / amplitude) (-1)) 1) - (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1))) / 2) + (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) * (Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2))) * (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1)) / PI else (if Rlt_dec 0 ((2 * bias - 2 * upper - amplitude) / 2) then ((sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2))) * (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1) - (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1))) / 2) + (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - upper) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - upper) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - upper) / amplitude) (-1)) 1))) / 2) - (sqrt ((Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2))) * (Rmin (Rmax ((bias - upper) / amplitude) (-1)) 1)) / PI else (if Rlt_dec 0 (upper - lower - amplitude) then 1 - (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1))) / 2) / PI + (sqrt ((Rmin (Rmax (lower / amplitude - bias / amplitude + 1) 0) 2) * (Rmin (Rmax (bias / amplitude + 1 - lower / amplitude) 0) 2))) * (Rmin (Rmax ((bias - lower) / amplitude) (-1)) 1) / PI - (if Rlt_dec 0 ((2 * (Rabs (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1)) - 1) / 2) then (if Rlt_dec 0 (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1) then 2 * (asin (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) / 2))) else PI - 2 * (asin (sqrt ((Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2) / 2)))) else (PI - 2 * (asin (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1))) / 2) / PI + (sqrt ((Rmin (Rmax (bias / amplitude + 1 - upper / amplitude) 0) 2) * (Rmin (Rmax (upper / amplitude - bias / amplitude + 1) 0) 2))) * (Rmin (Rmax ((upper - bias) / amplitude) (-1)) 1) / PI else 2 * ((atan (((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) / ((sqrt ((Rmax ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) 0))) + (sqrt ((Rmax ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude))) 0)))))) + ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) * (1 - ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) + (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - 2 * bias)^2 / (((sqrt ((Rmax ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) 0))) + (sqrt ((Rmax ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude))) 0))))^2)) / (((sqrt ((Rmax ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) 0))) + (sqrt ((Rmax ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude))) 0)))) * (1 + ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)))^2 / (((sqrt ((Rmax ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) 0))) + (sqrt ((Rmax ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude))) 0))))^2)) * (1 + ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) + (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - 2 * bias)^2 / (((sqrt ((Rmax ((Rmin (Rmax lower (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax lower (bias - amplitude)) (bias + amplitude))) 0))) + (sqrt ((Rmax ((Rmin (Rmax upper (bias - amplitude)) (bias + amplitude)) - bias + amplitude) 0) * (Rmax (bias + amplitude - (Rmin (Rmax upper (bias - amplitude)) (bias + amplitude))) 0))))^2)))) / PI))), 0).

Definition polynomial (c0 c1 c2 c3 c4 c5 bias amplitude : R) :=
  (c0 + bias * c1 + bias^2 * c2 + bias^3 * c3 + bias^4 * c4 + bias^5 * c5 + amplitude^2 * c2 / 2 + 3 * amplitude^2 * bias * c3 / 2 + 3 * amplitude^2 * bias^2 * c4 + 5 * amplitude^2 * bias^3 * c5 + 3 * amplitude^4 * c4 / 8 + 15 * amplitude^4 * bias * c5 / 8, c1 + 2 * bias * c2 + 3 * bias^2 * c3 + 4 * bias^3 * c4 + 5 * bias^4 * c5 + 3 * amplitude^2 * c3 / 4 + 3 * amplitude^2 * bias * c4 + 15 * amplitude^2 * bias^2 * c5 / 2 + 5 * amplitude^4 * c5 / 8, 0).

Definition relay (level bias amplitude : R) :=
  [Sign 0 level Both].

Definition relay_dead_zone (level dead_zone bias amplitude : R) :=
  [Step dead_zone level Above Both; Step (-dead_zone) (-level) Below Both].

Definition relay_hysteresis (level half_width offset bias amplitude : R) :=
  [Constant offset Both; Sign half_width level Rising; Sign (-half_width) level Falling].

Definition relay_dead_zone_hysteresis (level on_ off bias amplitude : R) :=
  [Step on_ (if Rlt_dec 0 (bias + amplitude - on_) then level else 0) Above Rising; Step off (if Rlt_dec 0 (bias + amplitude - on_) then level else 0) Above Falling; Step (-off) (-(if Rlt_dec 0 (amplitude - on_ - bias) then level else 0)) Below Rising; Step (-on_) (-(if Rlt_dec 0 (amplitude - on_ - bias) then level else 0)) Below Falling].

Definition saturation (slope breakpoint bias amplitude : R) :=
  [Band 0 (-breakpoint) breakpoint slope].

Definition saturation_asymmetric (slope lower upper bias amplitude : R) :=
  [Band 0 lower upper slope].

Definition dead_zone (slope half_width bias amplitude : R) :=
  [Ramp half_width slope Above Both; Ramp (-half_width) (-slope) Below Both].

Definition dead_zone_saturation (slope half_width breakpoint bias amplitude : R) :=
  [Band half_width half_width breakpoint slope; Band (-half_width) (-breakpoint) (-half_width) slope].

Definition gain_changing_1 (inner outer breakpoint bias amplitude : R) :=
  [Line outer; Band 0 (-breakpoint) breakpoint (inner - outer)].

Definition gain_changing_2 (inner outer breakpoint bias amplitude : R) :=
  [Line inner; Ramp breakpoint (outer - inner) Above Both; Ramp (-breakpoint) (inner - outer) Below Both].

Definition gain_changing_3 (inner outer breakpoint bias amplitude : R) :=
  [Band 0 (-breakpoint) breakpoint inner; Ramp breakpoint outer Above Both; Ramp (-breakpoint) (-outer) Below Both].

Definition preload (slope level bias amplitude : R) :=
  [Line slope; Sign 0 level Both].

Definition quantizer (tread bias amplitude : R) :=
  [Step (tread / 2) tread Above Both; Step (-tread / 2) (-tread) Below Both; Step (3 * tread / 2) tread Above Both; Step (-3 * tread / 2) (-tread) Below Both].

Definition absolute (gain bias amplitude : R) :=
  [Ramp 0 gain Above Both; Ramp 0 gain Below Both].

Definition polyline (x0 y0 x1 y1 x2 y2 left right bias amplitude : R) :=
  [Constant y1 Both; Ramp x0 (-left) Below Both; Ramp x2 right Above Both; Band x1 x0 x1 ((y1 - y0) / (x1 - x0)); Band x1 x1 x2 ((y2 - y1) / (x2 - x1))].

Definition backlash (slope half_gap bias amplitude : R) :=
  [Line slope; Constant (-half_gap * slope) Rising; Constant (half_gap * slope) Falling; Ramp (bias - amplitude + 2 * half_gap) slope Below Rising; Ramp (bias + amplitude - 2 * half_gap) (-slope) Above Falling].

Definition relay_f0_by_times (level t_high t_low : R) :=
  level * (t_high - t_low) / (t_high + t_low).

Definition condition_40_least_amplitude (half_width bias : R) :=
  half_width + (Rabs bias).

Definition table_3 (f0 p q amplitude omega : R) :=
  (p / (omega^2), -q / omega, -3 * PI * q / (8 * amplitude * omega^2), f0).

Definition delay_rotation (f0 p q phase : R) :=
  (f0, p * (cos phase) + q * (sin phase), q * (cos phase) - p * (sin phase)).

Definition quantisation (ratio : R) :=
  ((2 - ratio^2) / (ratio^2 - 1), -2, -3).

Definition relative_spread (first second : R) :=
  100 * (sqrt 2) * (Rabs ((first - second) / (first + second))).

Definition thruster_bilinear (by_rate by_speed rate speed : R) :=
  (by_rate * rate - by_speed * speed) * (Rabs rate).

Definition allocation_forces (arm tau_1 tau_2 : R) :=
  (tau_1 + tau_2, arm * (tau_1 - tau_2)).

Definition allocation_thrusts (arm force moment : R) :=
  ((force + moment / arm) / 2, (force - moment / arm) / 2).

Definition quadratic_half_cycle (y gap ratio : R) :=
  ratio * (y + gap * ratio) / (y + ratio).

Definition quadratic_speeds (gap mu : R) :=
  ((if Rlt_dec 0 (-mu) then gap * (1 - mu^2) / (gap * (Rabs mu) + (sqrt (gap * (gap * (Rabs mu)^2 + 1 - mu^2)))) else gap * (Rabs mu) + (sqrt (gap * (gap * (Rabs mu)^2 + 1 - mu^2)))), (if Rlt_dec 0 (-mu) then gap * (Rabs mu) + (sqrt (gap * (gap * (Rabs mu)^2 + 1 - mu^2))) else gap * (1 - mu^2) / (gap * (Rabs mu) + (sqrt (gap * (gap * (Rabs mu)^2 + 1 - mu^2)))))).

Definition quadratic_period (g : R) :=
  (atan (sqrt (sqrt (-(exp (-4 * g) - 1))))) + (if Rlt_dec 0 ((10 * g - 1) / 10) then (2 * (ln (1 + (sqrt (sqrt (-(exp (-4 * g) - 1)))))) + 4 * g + (ln (1 + (sqrt (-(exp (-4 * g) - 1)))))) / 2 else (ln ((1 + (sqrt (sqrt (-(exp (-4 * g) - 1))))) / (1 - (sqrt (sqrt (-(exp (-4 * g) - 1)))))) / 2)).

Definition linear_half_cycle (speed next g ratio : R) :=
  ratio * (if Rlt_dec 0 ((10 * (Rabs (-next / ratio)) - 1) / 10) then -next / ratio - (ln (1 + (-next / ratio))) else next^2 * (1 + 2 * next / (3 * ratio * (2 - next / ratio)^2) + 10 * next^3 / (25 * ratio^3 * (2 - next / ratio)^4) + 2 * next^5 / (7 * ratio^5 * (2 - next / ratio)^6) + 2 * next^7 / (9 * ratio^7 * (2 - next / ratio)^8) + 2 * next^9 / (11 * ratio^9 * (2 - next / ratio)^10) + 1538461538461538 * next^11 / (10000000000000000 * ratio^11 * (2 - next / ratio)^12) + 2 * next^13 / (15 * ratio^13 * (2 - next / ratio)^14)) / (ratio^2 * (2 - next / ratio))) - ratio * (if Rlt_dec 0 ((10 * (Rabs (speed / ratio)) - 1) / 10) then speed / ratio - (ln (1 + (speed / ratio))) else speed^2 * (1 - 2 * speed / (3 * ratio * (2 + speed / ratio)^2) - 10 * speed^3 / (25 * ratio^3 * (2 + speed / ratio)^4) - 2 * speed^5 / (7 * ratio^5 * (2 + speed / ratio)^6) - 2 * speed^7 / (9 * ratio^7 * (2 + speed / ratio)^8) - 2 * speed^9 / (11 * ratio^9 * (2 + speed / ratio)^10) - 1538461538461538 * speed^11 / (10000000000000000 * ratio^11 * (2 + speed / ratio)^12) - 2 * speed^13 / (15 * ratio^13 * (2 + speed / ratio)^14)) / (ratio^2 * (2 + speed / ratio))) - 2 * g.

Definition linear_half_width (z : R) :=
  (if Rlt_dec 0 (z - 1) then z - (tanh z) else z^3 / (3 + z^2 / (5 + z^2 / (7 + z^2 / (9 + z^2 / (11 + z^2 / (13 + z^2 / (15 + z^2 / (17 + z^2 / (19 + z^2 / (21 + 25 * z^2 / (575 + z^2)))))))))) + z^2)).

Definition linear_amplitude_excess (z : R) :=
  (if Rlt_dec 0 ((10 * (Rabs (tanh z)) - 1) / 10) then (tanh z) - (ln (1 + (tanh z))) else (1 - 2 * (tanh z) / (3 * (2 + (tanh z))^2) - 10 * (tanh z)^3 / (25 * (2 + (tanh z))^4) - 2 * (tanh z)^5 / (7 * (2 + (tanh z))^6) - 2 * (tanh z)^7 / (9 * (2 + (tanh z))^8) - 2 * (tanh z)^9 / (11 * (2 + (tanh z))^10) - 1538461538461538 * (tanh z)^11 / (10000000000000000 * (2 + (tanh z))^12) - 2 * (tanh z)^13 / (15 * (2 + (tanh z))^14)) * (tanh z)^2 / (2 + (tanh z))).

Definition return_slope (mu d_1 d_2 : R) :=
  ((1 + mu - d_1) * (1 - mu - d_2), (1 - mu + d_1) * (1 + mu + d_2)).

Definition orbit_quadratic_excess_first (mu d_1 d_2 : R) :=
  (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - 199 * d_1 / 100 - 199 * d_2 / 100.

Definition orbit_quadratic_excess_second (mu d_1 d_2 : R) :=
  (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - 199 * d_1 / 100 - 199 * d_2 / 100.

Definition orbit_quadratic_denominator (mu s_1 s_2 : R) :=
  199 / 100 - 12 * (1 - mu + s_1 + mu * s_1) * (1 + mu + s_2 - mu * s_2) / 25.

Definition orbit_quadratic_force_slow (speed linear_share unused_3 : R) :=
  1 - linear_share * speed - speed^2 + linear_share * speed^2.

Definition orbit_quadratic_force_fast (speed linear_share unused_3 : R) :=
  linear_share * speed - 1 + speed^2 - linear_share * speed^2.

Definition orbit_quadratic_quadratic_next (y gap unused_3 : R) :=
  (y + gap) / (y + 1).

Definition orbit_linear_excess_first (mu d_1 d_2 : R) :=
  (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - 199 * d_1 / 100 - 199 * d_2 / 100.

Definition orbit_linear_excess_second (mu d_1 d_2 : R) :=
  (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - 199 * d_1 / 100 - 199 * d_2 / 100.

Definition orbit_linear_denominator (mu s_1 s_2 : R) :=
  199 / 100 - 12 * (1 - mu + s_1 + mu * s_1) * (1 + mu + s_2 - mu * s_2) / 25.

Definition orbit_linear_force_slow (speed linear_share unused_3 : R) :=
  1 - linear_share * speed - speed^2 + linear_share * speed^2.

Definition orbit_linear_force_fast (speed linear_share unused_3 : R) :=
  linear_share * speed - 1 + speed^2 - linear_share * speed^2.

Definition orbit_linear_linear_width_short (z unused_2 unused_3 : R) :=
  z - (tanh z).

Definition orbit_linear_linear_width_long (z unused_2 unused_3 : R) :=
  z - (tanh z).

Definition orbit_no_early_switching_force_slow (speed linear_share unused_3 : R) :=
  1 - linear_share * speed - speed^2 + linear_share * speed^2.

Definition orbit_no_early_switching_force_fast (speed linear_share unused_3 : R) :=
  linear_share * speed - 1 + speed^2 - linear_share * speed^2.

Definition orbit_no_early_switching_braking (mu drag unused_3 : R) :=
  mu - 1 - drag.

Definition orbit_no_early_switching_braking_drag (mu drag unused_3 : R) :=
  1 - mu + drag.

Definition orbit_multiplier_excess_first (mu d_1 d_2 : R) :=
  (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - 199 * d_1 / 100 - 199 * d_2 / 100.

Definition orbit_multiplier_excess_second (mu d_1 d_2 : R) :=
  (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - 199 * d_1 / 100 - 199 * d_2 / 100.

Definition orbit_multiplier_denominator (mu s_1 s_2 : R) :=
  199 / 100 - 12 * (1 - mu + s_1 + mu * s_1) * (1 + mu + s_2 - mu * s_2) / 25.

Definition orbit_quadratic_disturbed_excess_first (mu d_1 d_2 : R) :=
  (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - 199 * d_1 / 100 - 199 * d_2 / 100.

Definition orbit_quadratic_disturbed_excess_second (mu d_1 d_2 : R) :=
  (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - 199 * d_1 / 100 - 199 * d_2 / 100.

Definition orbit_quadratic_disturbed_denominator (mu s_1 s_2 : R) :=
  199 / 100 - 12 * (1 - mu + s_1 + mu * s_1) * (1 + mu + s_2 - mu * s_2) / 25.

Definition orbit_quadratic_disturbed_force_slow (speed linear_share unused_3 : R) :=
  1 - linear_share * speed - speed^2 + linear_share * speed^2.

Definition orbit_quadratic_disturbed_force_fast (speed linear_share unused_3 : R) :=
  linear_share * speed - 1 + speed^2 - linear_share * speed^2.

Definition orbit_quadratic_disturbed_braking (mu drag unused_3 : R) :=
  mu - 1 - drag.

Definition orbit_quadratic_disturbed_braking_drag (mu drag unused_3 : R) :=
  1 - mu + drag.

Definition orbit_linear_disturbed_excess_first (mu d_1 d_2 : R) :=
  (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - 199 * d_1 / 100 - 199 * d_2 / 100.

Definition orbit_linear_disturbed_excess_second (mu d_1 d_2 : R) :=
  (1 - mu + d_1) * (1 + mu + d_2) - (1 + mu - d_1) * (1 - mu - d_2) - 199 * d_1 / 100 - 199 * d_2 / 100.

Definition orbit_linear_disturbed_denominator (mu s_1 s_2 : R) :=
  199 / 100 - 12 * (1 - mu + s_1 + mu * s_1) * (1 + mu + s_2 - mu * s_2) / 25.

Definition orbit_linear_disturbed_force_slow (speed linear_share unused_3 : R) :=
  1 - linear_share * speed - speed^2 + linear_share * speed^2.

Definition orbit_linear_disturbed_force_fast (speed linear_share unused_3 : R) :=
  linear_share * speed - 1 + speed^2 - linear_share * speed^2.

Definition orbit_linear_disturbed_braking (mu drag unused_3 : R) :=
  mu - 1 - drag.

Definition orbit_linear_disturbed_braking_drag (mu drag unused_3 : R) :=
  1 - mu + drag.

Definition orbit_amplitude_monotone_quadratic_quadratic_overshoot_weak (r unused_2 unused_3 : R) :=
  (ln (1 + r)) + r * (ln (1 + r)) + (ln (1 + (-r))) - r * (ln (1 + (-r))).

Definition orbit_amplitude_monotone_quadratic_quadratic_overshoot_strong (r unused_2 unused_3 : R) :=
  (ln (1 + r)) + r * (ln (1 + r)) - (sqrt (1 - r)).

Definition orbit_amplitude_monotone_quadratic_logarithm_low (v unused_2 unused_3 : R) :=
  (exp v) - 2 * v.

Definition orbit_amplitude_monotone_quadratic_logarithm_high (v unused_2 unused_3 : R) :=
  (exp v) - 2 * v.

Definition orbit_amplitude_monotone_linear_linear_overshoot_weak (t unused_2 unused_3 : R) :=
  t^2 - t * (ln (1 + t)) - (1 - t) * ((ln ((1 + t) / (1 - t)) / 2) - t).

Definition orbit_amplitude_monotone_linear_linear_overshoot_strong (t unused_2 unused_3 : R) :=
  (2 * t - t * (ln (1 + t)) - (ln (1 + t)) - (sqrt (1 - t))) / 2.

Definition orbit_amplitude_monotone_linear_logarithm_low (v unused_2 unused_3 : R) :=
  (exp v) - 2 * v.

Definition orbit_amplitude_monotone_linear_logarithm_high (v unused_2 unused_3 : R) :=
  (exp v) - 2 * v.

Definition orbit_amplitude_monotone_linear_linear_width_short (z unused_2 unused_3 : R) :=
  z - (tanh z).

Definition orbit_amplitude_monotone_linear_linear_width_long (z unused_2 unused_3 : R) :=
  z - (tanh z).
