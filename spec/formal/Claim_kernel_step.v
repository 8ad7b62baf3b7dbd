(** kernel-step (eq. 10). A step above [at_] contributes on the rising branch the mean [acos(u)/(2 pi)], the sine component
    [sqrt(1 - u^2)/pi] and the cosine component [(1 - u)/pi], with [u = (at_ - bias)/amplitude]; on the falling branch the cosine
    component changes sign; below [at_] the sine component does. P and Q are components over the amplitude. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels.
Open Scope R_scope.

(** Every breakpoint on the sweep, the turning points included, whatever the value at the breakpoint. *)
Definition closed_form : Prop := forall (at_ B X u : R) (F : R -> R),
  0 < X -> u = (at_ - B) / X -> -1 <= u <= 1 ->
  (forall x, x < at_ -> F x = 0) -> (forall x, at_ < x -> F x = 1) ->
  describes_rising F B X {| f0 := acos u / (2 * PI); p := sqrt (1 - u ^ 2) / PI / X; q := (1 - u) / PI / X |}.

(** What the program evaluates: every breakpoint, height, bias, amplitude, side and branch. *)
Definition as_coded : Prop := forall (at_ height B X : R) (s : side) (b : branches), 0 < X ->
  describes (multiple_of height (on b (step s at_))) B X (df_times height (on_df b (step_at s at_ B X))).

Theorem statement : closed_form /\ as_coded.
Proof.
  split.
  - intros at_ B X u F HX -> U Hb Ha. pose proof PI_RGT_0.
    assert (E : ratio at_ B X = (at_ - B) / X) by (unfold ratio; rewrite Rmin_left, Rmax_right by lra; reflexivity).
    pose proof (step_rising at_ B X F HX Hb Ha) as D. rewrite E in D.
    match goal with |- describes_rising F B X ?d => replace d with (step_df ((at_ - B) / X) X); [exact D|] end.
    apply df_eq; cbn [f0 p q step_df].
    + rewrite phi_is_acos, acos_asin by exact U. field. lra.
    + unfold sine. replace ((1 - (at_ - B) / X) * (1 + (at_ - B) / X)) with (1 - ((at_ - B) / X) ^ 2) by ring. field. lra.
    + field. lra.
  - intros at_ height B X s b HX. apply describes_times, describes_on. now apply step_at_rising.
Qed.
Print Assumptions statement.
