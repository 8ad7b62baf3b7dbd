(** kernel-sign (eq. 10). [sgn(x - at_)] contributes on the rising branch the mean [-asin(u)/pi], the sine component
    [2 sqrt(1 - u^2)/pi] and the cosine component [-2 u/pi], with [u = (at_ - bias)/amplitude]. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels.
Open Scope R_scope.

(** Every breakpoint on the sweep, the turning points included, whatever the value at the breakpoint. *)
Definition closed_form : Prop := forall (at_ B X u : R) (F : R -> R),
  0 < X -> u = (at_ - B) / X -> -1 <= u <= 1 ->
  (forall x, x < at_ -> F x = -1) -> (forall x, at_ < x -> F x = 1) ->
  describes_rising F B X {| f0 := - asin u / PI; p := 2 * sqrt (1 - u ^ 2) / PI / X; q := - (2 * u) / PI / X |}.

(** What the program evaluates: every breakpoint, level, bias, amplitude and branch. *)
Definition as_coded : Prop := forall (at_ level B X : R) (b : branches), 0 < X ->
  describes (multiple_of level (on b (sign at_))) B X (df_times level (on_df b (sign_df (ratio at_ B X) X))).

Theorem statement : closed_form /\ as_coded.
Proof.
  split.
  - intros at_ B X u F HX -> U Hb Ha. pose proof PI_RGT_0.
    assert (E : ratio at_ B X = (at_ - B) / X) by (unfold ratio; rewrite Rmin_left, Rmax_right by lra; reflexivity).
    pose proof (sign_rising at_ B X F HX Hb Ha) as D. rewrite E in D.
    match goal with |- describes_rising F B X ?d => replace d with (sign_df ((at_ - B) / X) X); [exact D|] end.
    apply df_eq; cbn [f0 p q sign_df].
    + field. lra.
    + unfold sine. replace ((1 - (at_ - B) / X) * (1 + (at_ - B) / X)) with (1 - ((at_ - B) / X) ^ 2) by ring. field. lra.
    + field. lra.
  - intros at_ level B X b HX. apply describes_times, describes_on. now apply sign_at_rising.
Qed.
Print Assumptions statement.
