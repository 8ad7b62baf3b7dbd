(** kernel-band (eq. 10). The input held between two breakpoints has, on both branches together, mean and sine component as
    differences of one function of each end's ratio: [(sqrt(1 - u^2) + u asin(u))/pi] for the mean,
    [(asin(u) + u sqrt(1 - u^2))/pi] for the sine component. The forms that the program chooses from all equal the integrals. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels.
Open Scope R_scope.

Definition mean_of_end (u : R) : R := (sqrt (1 - u ^ 2) + u * asin u) / PI.
Definition sine_of_end (u : R) : R := (asin u + u * sqrt (1 - u ^ 2)) / PI.

(** Both ends on the sweep, the turning points included. *)
Definition closed_form : Prop := forall (lower upper B X u v : R),
  0 < X -> u = (lower - B) / X -> v = (upper - B) / X -> -1 <= u <= v -> v <= 1 ->
  describes (static (held lower upper)) B X
    {| f0 := (lower + upper) / 2 + X * (mean_of_end u - mean_of_end v); p := sine_of_end v - sine_of_end u; q := 0 |}.

(** What the program evaluates, by whichever of its four forms, wherever the ends are; [scale] is its power of two. *)
Definition as_coded : Prop := forall (scale origin lower upper slope B X : R), 0 < X -> 0 < scale -> lower <= upper ->
  describes (multiple_of slope (static (fun x => held lower upper x - origin))) B X
    (df_times slope (band_df scale origin lower upper B X)).

Theorem statement : closed_form /\ as_coded.
Proof.
  split.
  - intros lower upper B X u v HX Eu Ev U V. pose proof PI_RGT_0.
    assert (Du : lower = B + X * u) by (rewrite Eu; field; lra). assert (Dv : upper = B + X * v) by (rewrite Ev; field; lra).
    assert (lu : lower <= upper) by nra.
    assert (Ru : ratio lower B X = u) by (unfold ratio; rewrite <- Eu, Rmin_left, Rmax_right by lra; reflexivity).
    assert (Rv : ratio upper B X = v) by (unfold ratio; rewrite <- Ev, Rmin_left, Rmax_right by lra; reflexivity).
    assert (Zu : shortfall lower B X = 0) by (unfold shortfall; apply Rmax_right; nra).
    assert (Zv : shortfall upper B X = 0) by (unfold shortfall; apply Rmax_right; nra).
    destruct (band_by_ramps 0 lower upper B X HX lu) as [D _].
    apply (describes_output (static (fun x => held lower upper x - 0))).
    { intros t. unfold output; simpl. destruct (Rlt_dec 0 (cos t)); ring. }
    match goal with |- describes _ B X ?d => replace d with (band_near_the_maximum 0 lower upper B X); [exact D|] end.
    unfold band_near_the_maximum, ramp_both, ramp_at, sided. rewrite Ru, Rv, Zu, Zv.
    apply df_eq; cbn [f0 p q df_minus df_plus flat on_df ramp_df]; rewrite ?phi_is_acos by lra;
      unfold mean_of_end, sine_of_end, sine;
      replace (1 - u ^ 2) with ((1 - u) * (1 + u)) by ring; replace (1 - v ^ 2) with ((1 - v) * (1 + v)) by ring.
    + rewrite Du, Dv. field. lra.
    + field. lra.
    + ring.
  - intros scale origin lower upper slope B X HX Hs lu. apply describes_times. now apply band_described.
Qed.
Print Assumptions statement.
