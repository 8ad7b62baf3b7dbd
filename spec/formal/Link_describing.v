(** The describing functions that the program computes are the ones that the claims of group B speak of: each kernel's closed form on
    each side and branch, the lists of kernels of the catalogue, the polynomial. *)
From Coq Require Import Reals Lra List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels Catalogue Claim_polynomial.
From Selfosc Require Formulas.
Import ListNotations.
Open Scope R_scope.

Definition triple (d : df) : R * R * R := (f0 d, p d, q d).

(** * Kernels *)

(** How the program holds breakpoint and distances to the sweep. *)
Lemma held_ratio z : Rmin (Rmax z (-1)) 1 = Rmax (-1) (Rmin z 1).
Proof. unfold Rmin, Rmax. by_cases; lra. Qed.
Lemma held_distance z : Rmin (Rmax (1 - z) 0) 2 = 1 - Rmax (-1) (Rmin z 1).
Proof. unfold Rmin, Rmax. by_cases; lra. Qed.

Section Kernel.
Variables at_ B X : R.
Hypothesis HX : 0 < X.
Let u := ratio at_ B X.
Lemma above_middle : Rmin (Rmax ((at_ - B) / X) (-1)) 1 = u.
Proof. now rewrite held_ratio. Qed.
Lemma above_near : Rmin (Rmax (B / X + 1 - at_ / X) 0) 2 = 1 - u.
Proof. unfold u, ratio. rewrite <- held_distance. do 2 f_equal. field. lra. Qed.
Lemma above_far : Rmin (Rmax (at_ / X - B / X + 1) 0) 2 = 1 + u.
Proof.
  unfold u, ratio. replace (at_ / X - B / X + 1) with (1 - - ((at_ - B) / X)) by (field; lra). rewrite held_distance.
  unfold Rmin, Rmax. by_cases; lra.
Qed.
Lemma above_short : Rmax (B - at_ - X) 0 = shortfall at_ B X.
Proof. unfold shortfall. f_equal. ring. Qed.
Lemma below_short : Rmax (at_ - B - X) 0 = shortfall (- at_) (- B) X.
Proof. unfold shortfall. f_equal. ring. Qed.
Let v := ratio (- at_) (- B) X.
Lemma below_is : v = - u.
Proof.
  unfold v, u, ratio. replace ((- at_ - - B) / X) with (- ((at_ - B) / X)) by (field; lra). unfold Rmin, Rmax. by_cases; lra.
Qed.
Lemma below_middle : Rmin (Rmax ((B - at_) / X) (-1)) 1 = v.
Proof.
  rewrite held_ratio. unfold v, ratio. do 2 f_equal. field. lra.
Qed.
Lemma below_near : Rmin (Rmax (at_ / X - B / X + 1) 0) 2 = 1 - v.
Proof. rewrite above_far, below_is. ring. Qed.
Lemma below_far : Rmin (Rmax (B / X + 1 - at_ / X) 0) 2 = 1 + v.
Proof. rewrite above_near, below_is. ring. Qed.
End Kernel.

(** The angle by the three decisions of the code, and the inverse sine, near the ends by way of the angle. *)
Lemma coded_phi u :
  (if Rlt_dec 0 ((2 * Rabs u - 1) / 2)
   then (if Rlt_dec 0 u then 2 * asin (sqrt ((1 - u) / 2)) else PI - 2 * asin (sqrt ((1 + u) / 2)))
   else (PI - 2 * asin u) / 2) = phi u.
Proof.
  unfold phi, select. replace ((2 * Rabs u - 1) / 2) with (Rabs u - 1 / 2) by field.
  replace ((1 - u) / 2) with (1 / 2 * (1 - u)) by field. replace ((1 + u) / 2) with (1 / 2 * (1 + u)) by field.
  destruct (Rlt_dec 0 (Rabs u - 1 / 2)), (Rlt_dec 0 u); (reflexivity || field).
Qed.
Lemma coded_asin u : -1 <= u <= 1 -> (if Rlt_dec 0 ((2 * Rabs u - 1) / 2) then (PI - 2 * phi u) / 2 else asin u) = asin u.
Proof. intros U. rewrite phi_is_acos by exact U. destruct (Rlt_dec 0 ((2 * Rabs u - 1) / 2)); field. Qed.

Ltac components := unfold triple; cbn [f0 p q df_times df_plus df_minus on_df flat constant_df line_df step_df sign_df ramp_df];
  repeat match goal with |- (_, _) = (_, _) => apply (f_equal2 (@pair _ _)) end.

Theorem formula_kernel_step : forall at_ height B X, 0 < X ->
  let of s b := triple (df_times height (on_df b (step_at s at_ B X))) in
  Formulas.step_above_both at_ height B X = of Above Both /\ Formulas.step_below_both at_ height B X = of Below Both /\
  Formulas.step_above_rising at_ height B X = of Above Rising /\ Formulas.step_below_rising at_ height B X = of Below Rising /\
  Formulas.step_above_falling at_ height B X = of Above Falling /\ Formulas.step_below_falling at_ height B X = of Below Falling.
Proof.
  intros at_ height B X HX. pose proof PI_RGT_0. cbv zeta. unfold step_at, sided.
  unfold Formulas.step_above_both, Formulas.step_below_both, Formulas.step_above_rising, Formulas.step_below_rising,
    Formulas.step_above_falling, Formulas.step_below_falling.
  rewrite ?(below_middle at_ B X HX), ?(above_middle at_ B X).
  repeat match goal with |- _ /\ _ => split end.
  1, 3, 5: rewrite ?(above_near at_ B X HX), ?(above_far at_ B X HX).
  4, 5, 6: rewrite ?(below_near at_ B X HX), ?(below_far at_ B X HX).
  all: rewrite ?coded_phi; components; unfold sine; try (rewrite (Rmult_comm (1 + _) (1 - _))); try field; try lra.
  
Qed.

Theorem formula_kernel_ramp : forall at_ slope B X, 0 < X ->
  let of s b := triple (df_times slope (on_df b (ramp_at s at_ B X))) in
  Formulas.ramp_above_both at_ slope B X = of Above Both /\ Formulas.ramp_below_both at_ slope B X = of Below Both /\
  Formulas.ramp_above_rising at_ slope B X = of Above Rising /\ Formulas.ramp_below_rising at_ slope B X = of Below Rising /\
  Formulas.ramp_above_falling at_ slope B X = of Above Falling /\ Formulas.ramp_below_falling at_ slope B X = of Below Falling.
Proof.
  intros at_ slope B X HX. pose proof PI_RGT_0. cbv zeta. unfold ramp_at, sided.
  unfold Formulas.ramp_above_both, Formulas.ramp_below_both, Formulas.ramp_above_rising, Formulas.ramp_below_rising,
    Formulas.ramp_above_falling, Formulas.ramp_below_falling.
  rewrite ?(below_middle at_ B X HX), ?(above_middle at_ B X).
  repeat match goal with |- _ /\ _ => split end.
  1, 3, 5: rewrite ?(above_short at_ B X), ?(above_near at_ B X HX), ?(above_far at_ B X HX).
  4, 5, 6: rewrite ?(below_short at_ B X), ?(below_near at_ B X HX), ?(below_far at_ B X HX).
  all: rewrite ?coded_phi; components; unfold sine; try (rewrite (Rmult_comm (1 + _) (1 - _))); try field; try lra.
  
Qed.

Theorem formula_kernel_sign : forall at_ level B X, 0 < X ->
  let of b := triple (df_times level (on_df b (sign_df (ratio at_ B X) X))) in
  Formulas.sign_both at_ level B X = of Both /\ Formulas.sign_rising at_ level B X = of Rising /\
  Formulas.sign_falling at_ level B X = of Falling.
Proof.
  intros at_ level B X HX. pose proof PI_RGT_0. pose proof (ratio_range at_ B X) as U. cbv zeta.
  unfold Formulas.sign_both, Formulas.sign_rising, Formulas.sign_falling.
  rewrite ?(above_middle at_ B X), ?(above_near at_ B X HX), ?(above_far at_ B X HX).
  repeat match goal with |- _ /\ _ => split end.
  all: rewrite ?coded_phi, ?(coded_asin _ U); components; unfold sine; try (rewrite (Rmult_comm (1 + _) (1 - _))); try field; try lra.
  
Qed.

Theorem formula_kernel_constant_and_line : forall value B X, 0 < X ->
  let of b := triple (df_times value (on_df b (constant_df X))) in
  Formulas.constant_both value B X = of Both /\ Formulas.constant_rising value B X = of Rising /\
  Formulas.constant_falling value B X = of Falling /\ Formulas.line_df value B X = triple (df_times value (line_df B)).
Proof.
  intros value B X HX. pose proof PI_RGT_0. cbv zeta.
  unfold Formulas.constant_both, Formulas.constant_rising, Formulas.constant_falling, Formulas.line_df.
  repeat match goal with |- _ /\ _ => split end; components; field; lra.
Qed.

(** A held input, by whichever of its four forms. *)
Theorem formula_kernel_band : forall origin lower upper slope B X, 0 < X -> lower <= upper ->
  Formulas.band origin lower upper slope B X = triple (df_times slope (band_df 1 origin lower upper B X)).
Proof.
  intros origin lower upper slope B X HX order_. pose proof PI_RGT_0. unfold Formulas.band, band_df.
  replace ((2 * lower - 2 * B - X) / 2) with (lower - B - 1 / 2 * X) by field.
  replace ((2 * B - 2 * upper - X) / 2) with (B - upper - 1 / 2 * X) by field.
  destruct (Rlt_dec 0 (lower - B - 1 / 2 * X)) as [C1|C1]; [|destruct (Rlt_dec 0 (B - upper - 1 / 2 * X)) as [C2|C2];
    [|destruct (Rlt_dec 0 (upper - lower - X)) as [C3|C3]]].
  - rewrite ?(above_middle lower B X), ?(above_middle upper B X), ?(above_near lower B X HX), ?(above_near upper B X HX),
      ?(above_far lower B X HX), ?(above_far upper B X HX), ?(above_short lower B X), ?(above_short upper B X), ?coded_phi.
    unfold band_near_the_maximum, ramp_both, ramp_at, sided. components; unfold sine; field; lra.
  - rewrite ?(below_middle lower B X HX), ?(below_middle upper B X HX), ?(below_near lower B X HX), ?(below_near upper B X HX),
      ?(below_far lower B X HX), ?(below_far upper B X HX), ?(below_short lower B X), ?(below_short upper B X), ?coded_phi.
    unfold band_near_the_minimum, ramp_both, ramp_at, sided. components; unfold sine;
    rewrite ?(Rmult_comm (1 + _) (1 - _)); field; lra.
  - rewrite ?(below_middle lower B X HX), ?(above_middle upper B X), ?(below_near lower B X HX), ?(above_near upper B X HX),
      ?(below_far lower B X HX), ?(above_far upper B X HX), ?(below_short lower B X), ?(above_short upper B X), ?coded_phi.
    unfold wide_band, ramp_both, ramp_at, sided. components; unfold sine; rewrite ?(Rmult_comm (1 + _) (1 - _)); field; lra.
  - pose proof (middle_is_wide_enough lower upper B X HX order_ ltac:(lra) ltac:(lra) ltac:(lra)) as wide.
    unfold band_from_the_middle.
    set (low := Rmin (Rmax lower (B - X)) (B + X)). set (high := Rmin (Rmax upper (B - X)) (B + X)).
    assert (cosine : forall at_ u, at_ = B + X * u -> -1 <= u <= 1 ->
      sqrt (Rmax (at_ - B + X) 0 * Rmax (B + X - at_) 0) = X * sine u /\
      sqrt (Rmax ((at_ - (B - X)) * 1) 0 * Rmax ((B + X - at_) * 1) 0) = X * sine u).
    { intros at_ u -> U. pose proof (code_cosine 1 u B X HX Rlt_0_1 U) as E. replace (X * 1 * sine u) with (X * sine u) in E by ring. split; [|exact E].
      rewrite <- E, !Rmult_1_r. do 2 f_equal. f_equal. ring. }
    destruct (cosine low _ (clamp_place lower B X HX) (ratio_range lower B X)) as [L1 L2].
    destruct (cosine high _ (clamp_place upper B X HX) (ratio_range upper B X)) as [H1 H2].
    rewrite L1, L2, H1, H2.
    assert (positive : 0 < X * sine (ratio lower B X) + X * sine (ratio upper B X)) by (rewrite <- Rmult_plus_distr_l; apply Rmult_lt_0_compat; lra).
    generalize dependent (X * sine (ratio lower B X) + X * sine (ratio upper B X)). intros S HS.
    replace ((high - low) * 1 * (1 / S)) with ((high - low) / S) by (field; lra).
    replace ((low + high - (B + B)) * 1 * (1 / S)) with ((low + high - 2 * B) / S) by (field; lra).
    replace (lower - (B + X)) with (lower - B - X) by ring. replace (upper - (B + X)) with (upper - B - X) by ring.
    pose proof (pow2_ge_0 (high - low)). pose proof (pow2_ge_0 (low + high - 2 * B)). pose proof (pow_lt S 2 HS).
    components; field; repeat split; try lra.
Qed.

(** * The catalogue *)

(** The lists of kernels that the program reports: for the relay with a dead zone and hysteresis and the backlash they depend on the
    sweep. *)
Theorem formula_catalogue : forall level slope gain width d half_width offset on_ off at_ lower upper inner outer half_gap B X,
  Formulas.relay level B X = relay_kernels level /\
  Formulas.relay_dead_zone level d B X = relay_dead_zone_kernels level d /\
  Formulas.relay_hysteresis level half_width offset B X = relay_hysteresis_kernels level half_width offset /\
  Formulas.relay_dead_zone_hysteresis level on_ off B X = relay_dead_zone_hysteresis_kernels level on_ off B X /\
  Formulas.saturation slope at_ B X = saturation_kernels slope (- at_) at_ /\
  Formulas.saturation_asymmetric slope lower upper B X = saturation_kernels slope lower upper /\
  Formulas.dead_zone slope width B X = crossing width slope /\
  Formulas.dead_zone_saturation slope width at_ B X = dead_zone_saturation_kernels slope width at_ /\
  Formulas.gain_changing_1 inner outer at_ B X = gain_changing_kernels_1 inner outer at_ /\
  Formulas.gain_changing_2 inner outer at_ B X = gain_changing_kernels_2 inner outer at_ /\
  Formulas.gain_changing_3 inner outer at_ B X = gain_changing_kernels_3 inner outer at_ /\
  Formulas.preload slope level B X = preload_kernels slope level /\
  Formulas.absolute gain B X = absolute_kernels gain /\
  Formulas.backlash slope half_gap B X = backlash_kernels slope half_gap B X.
Proof.
  intros.
  unfold Formulas.relay, Formulas.relay_dead_zone, Formulas.relay_hysteresis, Formulas.relay_dead_zone_hysteresis, Formulas.saturation,
    Formulas.saturation_asymmetric, Formulas.dead_zone, Formulas.dead_zone_saturation, Formulas.gain_changing_1, Formulas.gain_changing_2,
    Formulas.gain_changing_3, Formulas.preload, Formulas.absolute, Formulas.backlash.
  unfold relay_dead_zone_hysteresis_kernels, backlash_kernels, gain_changing_kernels_1, gain_changing_kernels_2, gain_changing_kernels_3,
    crossing, select.
  replace (- on_ - (B - X)) with (X - on_ - B) by ring.
  replace (- (outer - inner)) with (inner - outer) by ring. replace (- half_gap * slope) with (- (slope * half_gap)) by ring.
  replace (half_gap * slope) with (slope * half_gap) by ring.
  repeat match goal with |- _ /\ _ => split end; reflexivity.
Qed.

(** A quantizer whose sweep passes two treads either way, and a polyline of three points beside the middle one: the program's loops
    over treads and points, once. *)
Theorem formula_quantizer : forall scale tread B X, sum_df scale B X (Formulas.quantizer tread B X) = sum_df scale B X (quantizer_kernels tread 2 2).
Proof.
  intros. unfold Formulas.quantizer, quantizer_kernels. cbn [treads app]. unfold sum_df. cbn [fold_right].
  replace (tread * (INR 2 - 1 / 2)) with (3 * tread / 2) by (simpl; field). replace (tread * (INR 1 - 1 / 2)) with (tread / 2) by (simpl; field).
  replace (- (3 * tread / 2)) with (-3 * tread / 2) by field. replace (- (tread / 2)) with (- tread / 2) by field.
  apply df_eq; cbn [f0 p q df_plus]; ring.
Qed.
Theorem formula_polyline : forall x0 y0 x1 y1 x2 y2 left right B X,
  Formulas.polyline x0 y0 x1 y1 x2 y2 left right B X = polyline_kernels left right 1 (x0, y0) [(x1, y1); (x2, y2)].
Proof. reflexivity. Qed.

(** * Polynomials: of degree five *)

Theorem formula_polynomial : forall c0 c1 c2 c3 c4 c5 B X,
  Formulas.polynomial c0 c1 c2 c3 c4 c5 B X = triple (coded_df [c0; c1; c2; c3; c4; c5] B X).
Proof.
  intros. unfold Formulas.polynomial, coded_df, about_bias. cbn [passes pass hd loop length fst snd]. components; try field.
Qed.
