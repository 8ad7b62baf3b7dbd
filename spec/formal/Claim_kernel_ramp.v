(** kernel-ramp (eq. 10). A ramp [max(x - at_, 0)] contributes on the rising branch, per amplitude, the mean
    [(sin(phi) - phi cos(phi))/(2 pi)], the sine component [(phi - sin(phi) cos(phi))/(2 pi)] and the cosine component
    [(1 - u)^2/(2 pi)], with [u = cos(phi) = (at_ - bias)/amplitude]. Below the sweep the excess adds a constant. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels.
Open Scope R_scope.

(** Every breakpoint on the sweep, the turning points included. *)
Definition closed_form : Prop := forall (at_ B X phi : R),
  0 < X -> 0 <= phi <= PI -> at_ = B + X * cos phi ->
  describes_rising (fun x => Rmax (x - at_) 0) B X
    {| f0 := X * ((sin phi - phi * cos phi) / (2 * PI)); p := (phi - sin phi * cos phi) / (2 * PI);
       q := (1 - cos phi) ^ 2 / (2 * PI) |}.

(** What the program evaluates: every breakpoint, slope, bias, amplitude, side and branch. *)
Definition as_coded : Prop := forall (at_ slope B X : R) (s : side) (b : branches), 0 < X ->
  describes (multiple_of slope (on b (ramp s at_))) B X (df_times slope (on_df b (ramp_at s at_ B X))).

Theorem statement : closed_form /\ as_coded.
Proof.
  split.
  - intros at_ B X phi HX Hphi ->. pose proof PI_RGT_0. pose proof (COS_bound phi) as [C1 C2].
    set (u := cos phi) in *.
    assert (E : ratio (B + X * u) B X = u).
    { unfold ratio. replace ((B + X * u - B) / X) with u by (field; lra). now rewrite Rmin_left, Rmax_right by lra. }
    assert (Z : shortfall (B + X * u) B X = 0) by (unfold shortfall; apply Rmax_right; nra).
    assert (P : Kernels.phi u = phi).
    { rewrite phi_is_acos, <- acos_asin by lra. unfold u. now apply acos_cos. }
    assert (S : sine u = sin phi).
    { unfold sine. apply sqrt_lem_1; [apply Rmult_le_pos; lra|apply sin_ge_0; lra|].
      pose proof (sin2_cos2 phi) as Q. unfold Rsqr in Q. fold u in Q. lra. }
    pose proof (ramp_at_rising Above (B + X * u) B X HX) as D. unfold ramp_at, sided in D. rewrite E, Z in D.
    match goal with |- describes_rising _ B X ?d => replace d with (ramp_df u X 0); [exact D|] end.
    apply df_eq; cbn [f0 p q ramp_df constant_df]; rewrite ?P, ?S; field; lra.
  - intros at_ slope B X s b HX. apply describes_times, describes_on. now apply ramp_at_rising.
Qed.
Print Assumptions statement.
