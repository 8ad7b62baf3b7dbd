(** The building blocks of piecewise-linear characteristics, and the closed forms of their describing functions: what
    [src/nonlinearity/kernel.rs] and [src/describing/kernel.rs] say. Each closed form is stated once, here, as the code has it, and
    proved to be the integral in the claims on kernels. No rule of Leibniz is needed: each integral has an antiderivative. *)
From Coq Require Import Reals Lra Psatz List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic.
Open Scope R_scope.

(** * Describing functions *)

(** Mean, sine and cosine component, the latter two over the amplitude (eqs. 12 to 15). *)
Record df := { f0 : R; p : R; q : R }.
Definition df_plus (d e : df) : df := {| f0 := f0 d + f0 e; p := p d + p e; q := q d + q e |}.
Definition df_minus (d e : df) : df := {| f0 := f0 d - f0 e; p := p d - p e; q := q d - q e |}.
Definition df_times (k : R) (d : df) : df := {| f0 := k * f0 d; p := k * p d; q := k * q d |}.
Definition flat (value : R) : df := {| f0 := value; p := 0; q := 0 |}.

(** The integrals exist and are what [d] says. *)
Definition describes (c : characteristic) (B X : R) (d : df) : Prop :=
  is_RInt (output c B X) 0 (2 * PI) (2 * PI * f0 d) /\
  is_RInt (fun t => output c B X t * sin t) 0 (2 * PI) (PI * X * p d) /\
  is_RInt (fun t => output c B X t * cos t) 0 (2 * PI) (PI * X * q d).

(** Of a function of the input on the rising branch alone: the integrals over half a turn. *)
Definition describes_rising (F : R -> R) (B X : R) (d : df) : Prop :=
  is_RInt (fun t => F (sweep B X t)) (- (PI / 2)) (PI / 2) (2 * PI * f0 d) /\
  is_RInt (fun t => F (sweep B X t) * sin t) (- (PI / 2)) (PI / 2) (PI * X * p d) /\
  is_RInt (fun t => F (sweep B X t) * cos t) (- (PI / 2)) (PI / 2) (PI * X * q d).

(** * The kernels *)

Inductive branches := Both | Rising | Falling.
Inductive side := Above | Below.

(** A function that counts on some branches. *)
Definition on (b : branches) (F : R -> R) : characteristic :=
  match b with
  | Both => static F
  | Rising => {| rising := F; falling := fun _ => 0 |}
  | Falling => {| rising := fun _ => 0; falling := F |}
  end.

(** The code's [select]: by the sign of [z]. *)
Definition select (z below above : R) : R := if Rlt_dec 0 z then above else below.

Definition beyond (s : side) (at_ x : R) : R := match s with Above => x - at_ | Below => at_ - x end.
Definition step (s : side) (at_ x : R) : R := select (beyond s at_ x) 0 1.
Definition ramp (s : side) (at_ x : R) : R := Rmax (beyond s at_ x) 0.
Definition sign (at_ x : R) : R := select (x - at_) (-1) 1.
Definition held (lower upper x : R) : R := Rmin (Rmax x lower) upper.

(** * The closed forms *)

(** What the rising branch contributes, on the branches that count. *)
Definition on_df (b : branches) (d : df) : df :=
  match b with
  | Both => {| f0 := f0 d + f0 d; p := p d + p d; q := 0 |}
  | Rising => d
  | Falling => {| f0 := f0 d; p := p d; q := - q d |}
  end.

(** The ratio of breakpoint and sweep, held to [-1, 1]. *)
Definition ratio (at_ B X : R) : R := Rmax (-1) (Rmin ((at_ - B) / X) 1).
(** How far the breakpoint lies below the sweep. *)
Definition shortfall (at_ B X : R) : R := Rmax (B - X - at_) 0.

(** acos(u) as the code has it: from the middle, or from the nearer end. *)
Definition phi (u : R) : R :=
  select (Rabs u - 1 / 2) (PI / 2 - asin u)
    (select u (PI - 2 * asin (sqrt (1 / 2 * (1 + u)))) (2 * asin (sqrt (1 / 2 * (1 - u))))).
Definition sine (u : R) : R := sqrt ((1 - u) * (1 + u)).

Definition constant_df (X : R) : df := {| f0 := 1 / 2; p := 0; q := 2 * / PI / X |}.
Definition line_df (B : R) : df := {| f0 := B; p := 1; q := 0 |}.
Definition step_df (u X : R) : df :=
  {| f0 := 1 / 2 * / PI * phi u; p := / PI / X * sine u; q := / PI / X * (1 - u) |}.
Definition sign_df (u X : R) : df :=
  {| f0 := - asin u * / PI; p := 2 * / PI / X * sine u; q := - (2 * / PI / X) * u |}.
Definition ramp_df (u X short : R) : df :=
  {| f0 := 1 / 2 * / PI * X * (phi u * (1 - u) - (phi u - sine u)) + 1 / 2 * short;
     p := 1 / 2 * / PI * (1 / 2) * (phi u + phi u - 2 * sine u * u);
     q := 1 / 2 * / PI * (1 - u) ^ 2 + q (constant_df X) * short |}.

(** Below a breakpoint is above, of the input turned upside down. *)
Definition sided (s : side) (kernel : R -> R -> df) (at_ B : R) : df :=
  match s with
  | Above => kernel at_ B
  | Below => let d := kernel (- at_) (- B) in {| f0 := f0 d; p := - p d; q := q d |}
  end.
Definition step_at (s : side) (at_ B X : R) : df := sided s (fun a b => step_df (ratio a b X) X) at_ B.
Definition ramp_at (s : side) (at_ B X : R) : df := sided s (fun a b => ramp_df (ratio a b X) X (shortfall a b X)) at_ B.

(** A ramp on both branches, for bands. *)
Definition ramp_both (s : side) (at_ B X : R) : df := on_df Both (ramp_at s at_ B X).

(** The four forms of a held input, less an origin. *)
Definition band_near_the_maximum (origin lower upper B X : R) : df :=
  df_minus (df_plus (flat (lower - origin)) (ramp_both Above lower B X)) (ramp_both Above upper B X).
Definition band_near_the_minimum (origin lower upper B X : R) : df :=
  df_minus (df_plus (flat (upper - origin)) (ramp_both Below lower B X)) (ramp_both Below upper B X).
Definition wide_band (origin lower upper B X : R) : df :=
  df_minus (df_plus (line_df (B - origin)) (ramp_both Below lower B X)) (ramp_both Above upper B X).
(** From the middle; [scale] is any positive number that falls out. *)
Definition band_from_the_middle (scale origin lower upper B X : R) : df :=
  let low := Rmin (Rmax lower (B - X)) (B + X) in
  let high := Rmin (Rmax upper (B - X)) (B + X) in
  let distance d := Rmax (d * scale) 0 in
  let cosine at_ := sqrt (distance (at_ - (B - X)) * distance (B + X - at_)) in
  let overshoot at_ := Rmax (Rmax (at_ - (B + X)) (B - X - at_)) 0 in
  let sum := low + high - (B + B) in
  let difference := high - low in
  let over_cosines := 1 / (cosine low + cosine high) in
  let of_difference := difference * scale * over_cosines in
  let of_sum := sum * scale * over_cosines in
  let product := of_difference * (1 - of_sum ^ 2) / ((1 + of_difference ^ 2) * (1 + of_sum ^ 2)) in
  let half_angle := atan of_difference in
  let share := / PI * (half_angle + product) in
  df_plus (flat (1 / 2 * (lower - origin + (upper - origin))))
    {| f0 := / PI * (sum * (of_difference - half_angle) - difference * atan of_sum)
             + 1 / 2 * (overshoot lower - overshoot upper);
       p := share + share; q := 0 |}.
(** Which of them the code takes. *)
Definition band_df (scale origin lower upper B X : R) : df :=
  if Rlt_dec 0 (lower - B - 1 / 2 * X) then band_near_the_maximum origin lower upper B X
  else if Rlt_dec 0 (B - upper - 1 / 2 * X) then band_near_the_minimum origin lower upper B X
  else if Rlt_dec 0 (upper - lower - X) then wide_band origin lower upper B X
  else band_from_the_middle scale origin lower upper B X.

(** Every order of what maxima and minima compare, the innermost first. *)
Ltac by_cases := repeat match goal with |- context [Rle_dec ?a ?b] =>
  lazymatch a with context [Rle_dec _ _] => fail | _ => lazymatch b with context [Rle_dec _ _] => fail | _ =>
  destruct (Rle_dec a b) end end end.

(** * Describing functions are linear, and do not see single points *)

Definition sum_of (c d : characteristic) : characteristic :=
  {| rising := fun x => rising c x + rising d x; falling := fun x => falling c x + falling d x |}.
Definition multiple_of (k : R) (c : characteristic) : characteristic :=
  {| rising := fun x => k * rising c x; falling := fun x => k * falling c x |}.

Lemma describes_plus c c' B X d d' : describes c B X d -> describes c' B X d' -> describes (sum_of c c') B X (df_plus d d').
Proof.
  intros [A1 [A2 A3]] [B1 [B2 B3]]. pose proof PI_RGT_0.
  assert (S : forall t, output (sum_of c c') B X t = output c B X t + output c' B X t).
  { intros t. unfold output, sum_of; simpl. now destruct (Rlt_dec 0 (cos t)). }
  repeat split; simpl; rewrite Rmult_plus_distr_l.
  - apply (ext (fun t => output c B X t + output c' B X t)); [lra|now intros; rewrite S|now apply add].
  - apply (ext (fun t => output c B X t * sin t + output c' B X t * sin t)); [lra|intros; rewrite S; ring|now apply add].
  - apply (ext (fun t => output c B X t * cos t + output c' B X t * cos t)); [lra|intros; rewrite S; ring|now apply add].
Qed.

Lemma describes_times k c B X d : describes c B X d -> describes (multiple_of k c) B X (df_times k d).
Proof.
  intros [A1 [A2 A3]]. pose proof PI_RGT_0.
  assert (S : forall t, output (multiple_of k c) B X t = k * output c B X t).
  { intros t. unfold output, multiple_of; simpl. now destruct (Rlt_dec 0 (cos t)). }
  repeat split; simpl.
  - apply (equal _ _ _ (k * (2 * PI * f0 d))); [|ring].
    apply (ext (fun t => k * output c B X t)); [lra|now intros; rewrite S|now apply multiply].
  - apply (equal _ _ _ (k * (PI * X * p d))); [|ring].
    apply (ext (fun t => k * (output c B X t * sin t))); [lra|intros; rewrite S; ring|now apply multiply].
  - apply (equal _ _ _ (k * (PI * X * q d))); [|ring].
    apply (ext (fun t => k * (output c B X t * cos t))); [lra|intros; rewrite S; ring|now apply multiply].
Qed.

Lemma describes_output c c' B X d : (forall t, output c B X t = output c' B X t) -> describes c B X d -> describes c' B X d.
Proof.
  intros S [A1 [A2 A3]]. pose proof PI_RGT_0. repeat split.
  - apply (ext (output c B X)); [lra|now intros|exact A1].
  - apply (ext (fun t => output c B X t * sin t)); [lra|intros; now rewrite S|exact A2].
  - apply (ext (fun t => output c B X t * cos t)); [lra|intros; now rewrite S|exact A3].
Qed.

(** The same integral where functions differ at single points only. *)
Lemma ext_off (points : list R) (f g : R -> R) : forall (a b l : R), a <= b ->
  (forall t, a < t < b -> ~ In t points -> f t = g t) -> is_RInt f a b l -> is_RInt g a b l.
Proof.
  induction points as [|x points IH]; intros a b l ab H I.
  - apply (ext f); [exact ab| |exact I]. intros t T. now apply H.
  - destruct (Rlt_dec a x) as [ax|ax]; [destruct (Rlt_dec x b) as [xb|xb]|].
    + destruct (both_parts f a x b ltac:(lra) (ex_intro _ l I)) as [[m M] [n N]].
      rewrite <- (RInt_of _ _ _ _ I), (RInt_of _ _ _ _ (join _ _ _ _ _ _ M N)).
      apply join with x; [apply (IH a x m)|apply (IH x b n)]; trivial; try lra;
        intros t T O; apply H; try lra; intros [E|E]; [lra|tauto|lra|tauto].
    + apply (IH a b l ab); [|exact I]. intros t T O. apply H; [exact T|]. intros [E|E]; [lra|tauto].
    + apply (IH a b l ab); [|exact I]. intros t T O. apply H; [exact T|]. intros [E|E]; [lra|tauto].
Qed.

(** A sweep passes an input once on the way up. *)
Lemma passes_once B X t x : 0 < X -> - (PI / 2) < t < PI / 2 -> sweep B X t = x -> t = asin ((x - B) / X).
Proof.
  intros HX T <-. unfold sweep. replace ((B + X * sin t - B) / X) with (sin t) by (field; lra).
  symmetry. apply asin_sin. lra.
Qed.

(** Outputs of characteristics that differ at single inputs differ at single angles. *)
Lemma output_off (points : list R) c c' B X : 0 < X ->
  (forall x, B - X <= x <= B + X -> ~ In x points -> rising c x = rising c' x /\ falling c x = falling c' x) ->
  exists times, forall t, 0 < t < 2 * PI -> ~ In t times -> output c B X t = output c' B X t.
Proof.
  intros HX same. pose proof PI_RGT_0.
  set (angles := map (fun x => asin ((x - B) / X)) points).
  set (times := angles ++ map (fun t => PI - t) angles ++ map (fun t => t + 2 * PI) angles ++ PI / 2 :: PI / 2 + PI :: nil).
  exists times. intros t T O. assert (N : ~ In (sweep B X t) points).
  { intros I. apply O. unfold times. rewrite !in_app_iff.
    assert (P : forall s, - (PI / 2) < s < PI / 2 -> sweep B X s = sweep B X t -> In s angles).
    { intros s S E. apply in_map_iff. exists (sweep B X t). split; [|exact I]. symmetry. now apply (passes_once B X s). }
    destruct (Rtotal_order t (PI / 2)) as [L|[->|L]]; [left; apply P; [lra|reflexivity]|simpl; tauto|].
    destruct (Rtotal_order t (PI / 2 + PI)) as [M|[->|M]].
    - right; left. apply in_map_iff. exists (PI - t). split; [ring|]. apply P; [lra|apply sweep_back].
    - simpl; tauto.
    - right; right; left. apply in_map_iff. exists (t - 2 * PI). split; [ring|]. apply P; [lra|].
      unfold sweep. rewrite <- (sin_turn (t - 2 * PI)). do 3 f_equal. ring. }
  destruct (same (sweep B X t)) as [S1 S2]; [unfold sweep; destruct (SIN_bound t); nra|exact N|].
  unfold output. now destruct (Rlt_dec 0 (cos t)).
Qed.

Lemma describes_off (points : list R) c c' B X d : 0 < X ->
  (forall x, B - X <= x <= B + X -> ~ In x points -> rising c x = rising c' x /\ falling c x = falling c' x) ->
  describes c B X d -> describes c' B X d.
Proof.
  intros HX same [A1 [A2 A3]]. pose proof PI_RGT_0. destruct (output_off points c c' B X HX same) as [times off].
  repeat split.
  - apply (ext_off times (output c B X)); [lra|exact off|exact A1].
  - apply (ext_off times (fun t => output c B X t * sin t)); [lra| |exact A2]. intros t T O. now rewrite off.
  - apply (ext_off times (fun t => output c B X t * cos t)); [lra| |exact A3]. intros t T O. now rewrite off.
Qed.

Corollary describes_same c c' B X d : 0 < X ->
  (forall x, rising c x = rising c' x /\ falling c x = falling c' x) -> describes c B X d -> describes c' B X d.
Proof. intros HX same. apply (describes_off nil); auto. Qed.

Lemma df_eq d e : f0 d = f0 e -> p d = p e -> q d = q e -> d = e.
Proof. destruct d, e; simpl. now intros -> -> ->. Qed.

(** * From the rising branch to any branches and sides *)

(** What the falling branch contributes is the rising branch's, mirrored at the maximum. *)
Theorem describes_on b F B X d : describes_rising F B X d -> describes (on b F) B X (on_df b d).
Proof.
  intros [A1 [A2 A3]]. pose proof PI_RGT_0.
  assert (Z : forall w, is_RInt (fun t => 0 * w t) (- (PI / 2)) (PI / 2) 0).
  { intros w. apply (ext (fun _ => 0)); [lra|intros; ring|].
    apply (equal _ _ _ ((PI / 2 - - (PI / 2)) * 0)); [apply constant_integral|ring]. }
  assert (A1' : is_RInt (fun t => F (sweep B X t) * 1) (- (PI / 2)) (PI / 2) (2 * PI * f0 d)).
  { apply (ext (fun t => F (sweep B X t))); [lra|intros; ring|exact A1]. }
  assert (A2' : is_RInt (fun t => F (sweep B X t) * sin (PI - t)) (- (PI / 2)) (PI / 2) (PI * X * p d)).
  { apply (ext (fun t => F (sweep B X t) * sin t)); [lra|intros t _; now rewrite sin_PI_x|exact A2]. }
  assert (A3' : is_RInt (fun t => F (sweep B X t) * cos (PI - t)) (- (PI / 2)) (PI / 2) (- (PI * X * q d))).
  { apply (ext (fun t => - (F (sweep B X t) * cos t))); [lra| |now apply negate]. intros t _.
    replace (cos (PI - t)) with (- cos t) by (rewrite <- (cos_neg t), <- cos_plus_pi; f_equal; ring). ring. }
  assert (W : forall c l, is_RInt (fun t => output c B X t * 1) 0 (2 * PI) l -> is_RInt (output c B X) 0 (2 * PI) l).
  { intros c l. apply ext; [lra|intros; ring]. }
  destruct b; repeat split; simpl.
  - apply W. apply (equal _ _ _ (2 * PI * f0 d + 2 * PI * f0 d)); [|ring]. now apply by_branches.
  - apply (equal _ _ _ (PI * X * p d + PI * X * p d)); [|ring]. apply by_branches; auto using sin_turn.
  - apply (equal _ _ _ (PI * X * q d + - (PI * X * q d))); [|ring]. apply by_branches; auto using cos_turn.
  - apply W. apply (equal _ _ _ (2 * PI * f0 d + 0)); [|ring]. apply by_branches; simpl; auto.
  - apply (equal _ _ _ (PI * X * p d + 0)); [|ring]. apply by_branches; simpl; auto using sin_turn.
  - apply (equal _ _ _ (PI * X * q d + 0)); [|ring]. apply by_branches; simpl; auto using cos_turn.
  - apply W. apply (equal _ _ _ (0 + 2 * PI * f0 d)); [|ring]. apply by_branches; simpl; auto.
  - apply (equal _ _ _ (0 + PI * X * p d)); [|ring]. apply by_branches; simpl; auto using sin_turn.
  - apply (equal _ _ _ (0 + - (PI * X * q d))); [|ring]. apply by_branches; simpl; auto using cos_turn.
Qed.

(** Below a breakpoint: the input turned upside down. *)
Theorem describes_upside_down F B X d :
  describes_rising F (- B) X d -> describes_rising (fun x => F (- x)) B X {| f0 := f0 d; p := - p d; q := q d |}.
Proof.
  intros [A1 [A2 A3]]. pose proof PI_RGT_0.
  assert (S : forall t, - sweep B X t = sweep (- B) X (0 - t)).
  { intros t. unfold sweep. rewrite Rminus_0_l, sin_neg. ring. }
  assert (V : forall (f : R -> R) l, is_RInt f (- (PI / 2)) (PI / 2) l -> is_RInt (fun t => f (0 - t)) (- (PI / 2)) (PI / 2) l).
  { intros f l I. apply backwards. replace (0 - PI / 2) with (- (PI / 2)) by ring. replace (0 - - (PI / 2)) with (PI / 2) by ring. exact I. }
  repeat split; simpl.
  - apply (ext (fun t => F (sweep (- B) X (0 - t)))); [lra|now intros; rewrite S|]. now apply (V (fun t => F (sweep (- B) X t))).
  - apply (ext (fun t => - (F (sweep (- B) X (0 - t)) * sin (0 - t)))); [lra| |].
    + intros t _. rewrite S, Rminus_0_l, sin_neg. ring.
    + apply (equal _ _ _ (- (PI * X * p d))); [|ring]. apply negate. now apply (V (fun t => F (sweep (- B) X t) * sin t)).
  - apply (ext (fun t => F (sweep (- B) X (0 - t)) * cos (0 - t))); [lra| |].
    + intros t _. now rewrite S, Rminus_0_l, cos_neg.
    + now apply (V (fun t => F (sweep (- B) X t) * cos t)).
Qed.

(** * Angles *)

Lemma ratio_range at_ B X : -1 <= ratio at_ B X <= 1.
Proof. unfold ratio. split; [apply Rmax_l|]. apply Rmax_lub; [lra|apply Rmin_r]. Qed.

Lemma sin_asin_ratio at_ B X : sin (asin (ratio at_ B X)) = ratio at_ B X.
Proof. apply sin_asin, ratio_range. Qed.

Lemma cos_asin_sine u : -1 <= u <= 1 -> cos (asin u) = sine u.
Proof. intros H. rewrite cos_asin by exact H. unfold sine, Rsqr. f_equal. ring. Qed.

Lemma sine_squared u : -1 <= u <= 1 -> sine u * sine u = (1 - u) * (1 + u).
Proof. intros H. apply sqrt_sqrt. apply Rmult_le_pos; lra. Qed.

(** Half-angle formulas: what the code takes near the ends is the inverse cosine too. *)
Lemma half_angle u : -1 <= u <= 1 -> 2 * asin (sqrt (1 / 2 * (1 - u))) = PI / 2 - asin u.
Proof.
  intros H. pose proof PI_RGT_0. pose proof (asin_bound u) as [L1 L2].
  replace (sqrt (1 / 2 * (1 - u))) with (sin ((PI / 2 - asin u) / 2)).
  - rewrite asin_sin by lra. field.
  - symmetry. apply sqrt_lem_1.
    + lra.
    + apply sin_ge_0; lra.
    + set (h := (PI / 2 - asin u) / 2).
      assert (E : u = cos (2 * h)).
      { unfold h. replace (2 * ((PI / 2 - asin u) / 2)) with (PI / 2 - asin u) by field.
        rewrite cos_shift, sin_asin by exact H. reflexivity. }
      rewrite E, cos_2a_sin. field.
Qed.

Theorem phi_is_acos u : -1 <= u <= 1 -> phi u = PI / 2 - asin u.
Proof.
  intros H. unfold phi, select. destruct (Rlt_dec 0 (Rabs u - 1 / 2)); [|reflexivity].
  destruct (Rlt_dec 0 u); [now apply half_angle|].
  replace (1 + u) with (1 - - u) by ring. rewrite half_angle by lra. rewrite asin_opp. field.
Qed.

(** The input is beyond the breakpoint from the angle asin(u) on. *)
Lemma before_and_after at_ B X t : 0 < X -> - (PI / 2) < t < PI / 2 ->
  (t < asin (ratio at_ B X) -> sweep B X t < at_) /\ (asin (ratio at_ B X) < t -> at_ < sweep B X t).
Proof.
  intros HX T. set (u := ratio at_ B X). pose proof (ratio_range at_ B X) as U. fold u in U.
  pose proof (asin_bound u) as [L1 L2]. pose proof (sin_asin_ratio at_ B X) as S. fold u in S.
  assert (D : X * ((at_ - B) / X) = at_ - B) by (field; lra). unfold sweep.
  assert (M1 : -1 < sin t < 1).
  { rewrite <- sin_PI2. replace (- sin (PI / 2)) with (sin (- (PI / 2))) by now rewrite sin_neg.
    replace (-1) with (sin (- (PI / 2))) by (rewrite sin_neg, sin_PI2; ring).
    split; apply sin_increasing_1; lra. }
  split; intros L.
  - assert (sin t < u) by (rewrite <- S; apply sin_increasing_1; lra).
    assert (sin t < (at_ - B) / X).
    { unfold u, ratio, Rmax, Rmin in H. destruct (Rle_dec ((at_ - B) / X) 1); destruct (Rle_dec (-1)); lra. }
    nra.
  - assert (u < sin t) by (rewrite <- S; apply sin_increasing_1; lra).
    assert ((at_ - B) / X < sin t).
    { unfold u, ratio, Rmax, Rmin in H. destruct (Rle_dec ((at_ - B) / X) 1); destruct (Rle_dec (-1)); lra. }
    nra.
Qed.

(** * The rising branch, kernel by kernel *)

(** A function that is [below] below the breakpoint and [above] above, whatever at it, under any weight with antiderivatives. *)
Lemma in_two_parts at_ B X (F w below above AB AA : R -> R) : 0 < X ->
  (forall x, x < at_ -> F x = below x) -> (forall x, at_ < x -> F x = above x) ->
  (forall t : R, is_derive AB t (below (sweep B X t) * w t)) -> (forall t : R, ex_derive (fun t => below (sweep B X t) * w t) t) ->
  (forall t : R, is_derive AA t (above (sweep B X t) * w t)) -> (forall t : R, ex_derive (fun t => above (sweep B X t) * w t) t) ->
  let a := asin (ratio at_ B X) in
  is_RInt (fun t => F (sweep B X t) * w t) (- (PI / 2)) (PI / 2) (AB a - AB (- (PI / 2)) + (AA (PI / 2) - AA a)).
Proof.
  intros HX Hb Ha Db Cb Da Ca a. pose proof PI_RGT_0. pose proof (asin_bound (ratio at_ B X)) as [L1 L2]. fold a in L1, L2.
  apply join with a.
  - apply (ext (fun t => below (sweep B X t) * w t)); [exact L1| |now apply by_antiderivative].
    intros t T. rewrite Hb; [reflexivity|]. apply before_and_after; [exact HX|lra|apply T].
  - apply (ext (fun t => above (sweep B X t) * w t)); [exact L2| |now apply by_antiderivative].
    intros t T. rewrite Ha; [reflexivity|]. apply before_and_after; [exact HX|lra|apply T].
Qed.

Lemma sin_minus_PI2 : sin (- (PI / 2)) = -1.
Proof. rewrite sin_neg, sin_PI2. ring. Qed.
Lemma cos_minus_PI2 : cos (- (PI / 2)) = 0.
Proof. rewrite cos_neg. exact cos_PI2. Qed.

Lemma describes_rising_by_weights F B X d :
  is_RInt (fun t => F (sweep B X t) * 1) (- (PI / 2)) (PI / 2) (2 * PI * f0 d) ->
  is_RInt (fun t => F (sweep B X t) * sin t) (- (PI / 2)) (PI / 2) (PI * X * p d) ->
  is_RInt (fun t => F (sweep B X t) * cos t) (- (PI / 2)) (PI / 2) (PI * X * q d) -> describes_rising F B X d.
Proof.
  intros H1 H2 H3. pose proof PI_RGT_0. repeat split; trivial.
  apply (ext (fun t => F (sweep B X t) * 1)); [lra|intros; ring|exact H1].
Qed.

(** Two levels: the step and the sign at once. *)
Lemma two_levels_rising at_ B X low high F : 0 < X ->
  (forall x, x < at_ -> F x = low) -> (forall x, at_ < x -> F x = high) ->
  let u := ratio at_ B X in
  describes_rising F B X {| f0 := (low + high) / 4 - (high - low) * asin u / (2 * PI);
    p := (high - low) * sine u / (PI * X); q := (low + high - (high - low) * u) / (PI * X) |}.
Proof.
  intros HX Hl Hh u. pose proof PI_RGT_0. pose proof (ratio_range at_ B X) as U. fold u in U.
  assert (S : sin (asin u) = u) by now apply sin_asin. assert (C : cos (asin u) = sine u) by now apply cos_asin_sine.
  apply describes_rising_by_weights; eapply equal.
  1: apply (in_two_parts at_ B X F (fun _ => 1) (fun _ => low) (fun _ => high) (fun t => low * t) (fun t => high * t) HX Hl Hh);
    intros t; auto_derive; trivial; ring.
  2: apply (in_two_parts at_ B X F sin (fun _ => low) (fun _ => high) (fun t => - low * cos t) (fun t => - high * cos t) HX Hl Hh);
    intros t; auto_derive; trivial; ring.
  3: apply (in_two_parts at_ B X F cos (fun _ => low) (fun _ => high) (fun t => low * sin t) (fun t => high * sin t) HX Hl Hh);
    intros t; auto_derive; trivial; ring.
  all: fold u; rewrite ?S, ?C, ?sin_PI2, ?cos_PI2, ?sin_minus_PI2, ?cos_minus_PI2; simpl; field; lra.
Qed.

Theorem step_rising at_ B X F : 0 < X -> (forall x, x < at_ -> F x = 0) -> (forall x, at_ < x -> F x = 1) ->
  describes_rising F B X (step_df (ratio at_ B X) X).
Proof.
  intros HX H0 H1. pose proof PI_RGT_0.
  replace (step_df (ratio at_ B X) X) with {| f0 := (0 + 1) / 4 - (1 - 0) * asin (ratio at_ B X) / (2 * PI);
    p := (1 - 0) * sine (ratio at_ B X) / (PI * X); q := (0 + 1 - (1 - 0) * ratio at_ B X) / (PI * X) |}.
  - now apply two_levels_rising.
  - apply df_eq; simpl; [rewrite phi_is_acos by apply ratio_range| |]; field; lra.
Qed.

Theorem sign_rising at_ B X F : 0 < X -> (forall x, x < at_ -> F x = -1) -> (forall x, at_ < x -> F x = 1) ->
  describes_rising F B X (sign_df (ratio at_ B X) X).
Proof.
  intros HX H0 H1. pose proof PI_RGT_0.
  replace (sign_df (ratio at_ B X) X) with {| f0 := (-1 + 1) / 4 - (1 - -1) * asin (ratio at_ B X) / (2 * PI);
    p := (1 - -1) * sine (ratio at_ B X) / (PI * X); q := (-1 + 1 - (1 - -1) * ratio at_ B X) / (PI * X) |}.
  - now apply two_levels_rising.
  - apply df_eq; simpl; field; lra.
Qed.

(** The breakpoint is on the sweep, below it or above it. *)
Lemma places at_ B X : 0 < X ->
  shortfall at_ B X = 0 /\ B - at_ = - X * ratio at_ B X \/
  ratio at_ B X = -1 /\ B - at_ = X + shortfall at_ B X \/
  ratio at_ B X = 1 /\ shortfall at_ B X = 0.
Proof.
  intros HX. assert (D : X * ((at_ - B) / X) = at_ - B) by (field; lra). unfold shortfall, ratio, Rmax, Rmin.
  destruct (Rle_dec ((at_ - B) / X) 1); [destruct (Rle_dec (-1) ((at_ - B) / X))|destruct (Rle_dec (-1) 1); [|lra]];
    destruct (Rle_dec (B - X - at_) 0); nra.
Qed.

Lemma ends_of_angles : asin 1 = PI / 2 /\ asin (-1) = - (PI / 2) /\ sine 1 = 0 /\ sine (-1) = 0.
Proof.
  unfold sine. repeat split; [exact asin_1|exact (eq_trans (asin_opp 1) (f_equal Ropp asin_1))| |];
    rewrite <- sqrt_0; f_equal; ring.
Qed.

Theorem ramp_rising at_ B X F : 0 < X -> (forall x, x < at_ -> F x = 0) -> (forall x, at_ < x -> F x = x - at_) ->
  describes_rising F B X (ramp_df (ratio at_ B X) X (shortfall at_ B X)).
Proof.
  intros HX H0 H1. pose proof PI_RGT_0. pose proof (places at_ B X HX) as N. destruct ends_of_angles as [E1 [E2 [E3 E4]]].
  set (u := ratio at_ B X) in *. set (short := shortfall at_ B X) in *.
  pose proof (ratio_range at_ B X) as U. fold u in U.
  assert (S : sin (asin u) = u) by now apply sin_asin. assert (C : cos (asin u) = sine u) by now apply cos_asin_sine.
  apply describes_rising_by_weights; eapply equal.
  1: apply (in_two_parts at_ B X F (fun _ => 1) (fun _ => 0) (fun x => x - at_) (fun _ => 0)
             (fun t => (B - at_) * t - X * cos t) HX H0 H1); intros t; unfold sweep; auto_derive; trivial; ring.
  2: apply (in_two_parts at_ B X F sin (fun _ => 0) (fun x => x - at_) (fun _ => 0)
             (fun t => - (B - at_) * cos t + X * (t - sin t * cos t) / 2) HX H0 H1); intros t; unfold sweep; auto_derive; trivial.
  2, 3: pose proof (sin2_cos2 t) as P; unfold Rsqr in P; nra.
  3: apply (in_two_parts at_ B X F cos (fun _ => 0) (fun x => x - at_) (fun _ => 0)
             (fun t => (B - at_) * sin t + X * (sin t * sin t) / 2) HX H0 H1); intros t; unfold sweep; auto_derive; trivial; field.
  all: fold u; rewrite ?S, ?C, ?sin_PI2, ?cos_PI2, ?sin_minus_PI2, ?cos_minus_PI2; unfold ramp_df, constant_df; cbn [f0 p q].
  all: rewrite ?phi_is_acos by exact U.
  all: destruct N as [[N1 N2]|[[N1 N2]|[N1 N2]]]; rewrite ?N1, ?N2, ?E1, ?E2, ?E3, ?E4; try (field; lra).
Qed.

(** * Any side, any branches *)

Theorem step_at_rising s at_ B X : 0 < X -> describes_rising (step s at_) B X (step_at s at_ B X).
Proof.
  intros HX. destruct s; unfold step_at, sided.
  - apply step_rising; trivial; intros x Hx; unfold step, select, beyond; destruct (Rlt_dec 0 (x - at_)); lra.
  - assert (D : describes_rising (fun x => step Above (- at_) x) (- B) X (step_df (ratio (- at_) (- B) X) X)).
    { apply step_rising; trivial; intros x Hx; unfold step, select, beyond; destruct (Rlt_dec 0 (x - - at_)); lra. }
    apply describes_upside_down in D. destruct D as [D1 [D2 D3]]. pose proof PI_RGT_0.
    assert (S : forall x, step Above (- at_) (- x) = step Below at_ x).
    { intros x. unfold step, beyond. f_equal. ring. }
    repeat split; [apply (ext (fun t => step Above (- at_) (- sweep B X t)))
      |apply (ext (fun t => step Above (- at_) (- sweep B X t) * sin t))
      |apply (ext (fun t => step Above (- at_) (- sweep B X t) * cos t))]; trivial; try lra; intros; now rewrite S.
Qed.

Theorem ramp_at_rising s at_ B X : 0 < X -> describes_rising (ramp s at_) B X (ramp_at s at_ B X).
Proof.
  intros HX. destruct s; unfold ramp_at, sided.
  - apply ramp_rising; trivial; intros x Hx; unfold ramp, beyond; [apply Rmax_right|apply Rmax_left]; lra.
  - assert (D : describes_rising (fun x => ramp Above (- at_) x) (- B) X
                  (ramp_df (ratio (- at_) (- B) X) X (shortfall (- at_) (- B) X))).
    { apply ramp_rising; trivial; intros x Hx; unfold ramp, beyond; [apply Rmax_right|apply Rmax_left]; lra. }
    apply describes_upside_down in D. destruct D as [D1 [D2 D3]]. pose proof PI_RGT_0.
    assert (S : forall x, ramp Above (- at_) (- x) = ramp Below at_ x).
    { intros x. unfold ramp, beyond. f_equal. ring. }
    repeat split; [apply (ext (fun t => ramp Above (- at_) (- sweep B X t)))
      |apply (ext (fun t => ramp Above (- at_) (- sweep B X t) * sin t))
      |apply (ext (fun t => ramp Above (- at_) (- sweep B X t) * cos t))]; trivial; try lra; intros; now rewrite S.
Qed.

Theorem sign_at_rising at_ B X : 0 < X -> describes_rising (sign at_) B X (sign_df (ratio at_ B X) X).
Proof.
  intros HX. apply sign_rising; trivial; intros x Hx; unfold sign, select; destruct (Rlt_dec 0 (x - at_)); lra.
Qed.

Theorem constant_rising B X : 0 < X -> describes_rising (fun _ => 1) B X (constant_df X).
Proof.
  intros HX. pose proof PI_RGT_0.
  apply describes_rising_by_weights; eapply equal.
  1: apply (by_antiderivative (fun t => t)); intros t; auto_derive; trivial; ring.
  2: apply (by_antiderivative (fun t => - cos t)); intros t; auto_derive; trivial; ring.
  3: apply (by_antiderivative sin); intros t; auto_derive; trivial; ring.
  all: rewrite ?sin_PI2, ?cos_PI2, ?sin_minus_PI2, ?cos_minus_PI2; simpl; field; lra.
Qed.

Theorem line_rising B X : 0 < X ->
  describes_rising (fun x => x) B X {| f0 := B / 2; p := 1 / 2; q := 2 * B / (PI * X) |}.
Proof.
  intros HX. pose proof PI_RGT_0. unfold sweep.
  apply describes_rising_by_weights; unfold sweep; eapply equal.
  1: apply (by_antiderivative (fun t => B * t - X * cos t)); intros t; auto_derive; trivial; ring.
  2: apply (by_antiderivative (fun t => - B * cos t + X * (t - sin t * cos t) / 2)); intros t; auto_derive; trivial;
     pose proof (sin2_cos2 t) as P; unfold Rsqr in P; nra.
  3: apply (by_antiderivative (fun t => B * sin t + X * (sin t * sin t) / 2)); intros t; auto_derive; trivial; field.
  all: rewrite ?sin_PI2, ?cos_PI2, ?sin_minus_PI2, ?cos_minus_PI2; simpl; field; lra.
Qed.

Theorem line_described B X : 0 < X -> describes (static (fun x => x)) B X (line_df B).
Proof.
  intros HX. replace (line_df B) with (on_df Both {| f0 := B / 2; p := 1 / 2; q := 2 * B / (PI * X) |}).
  - exact (describes_on Both _ B X _ (line_rising B X HX)).
  - apply df_eq; simpl; field.
Qed.

Theorem flat_described value B X : 0 < X -> describes (static (fun _ => value)) B X (flat value).
Proof.
  intros HX. pose proof PI_RGT_0. replace (flat value) with (df_times value (on_df Both (constant_df X))).
  - apply (describes_same (multiple_of value (static (fun _ => 1)))); [exact HX|intros; simpl; lra|].
    apply describes_times. exact (describes_on Both _ B X _ (constant_rising B X HX)).
  - apply df_eq; simpl; field.
Qed.

(** * A held input *)

Lemma describes_minus c c' B X d d' : describes c B X d -> describes c' B X d' ->
  describes {| rising := fun x => rising c x - rising c' x; falling := fun x => falling c x - falling c' x |} B X (df_minus d d').
Proof.
  intros D E. pose proof (describes_plus _ _ _ _ _ _ D (describes_times (-1) _ _ _ _ E)) as S.
  replace (df_minus d d') with (df_plus d (df_times (-1) d')) by (apply df_eq; simpl; ring).
  revert S. apply describes_output. intros t. unfold output, sum_of, multiple_of; simpl. destruct (Rlt_dec 0 (cos t)); ring.
Qed.

Lemma ramp_both_described s at_ B X : 0 < X -> describes (static (ramp s at_)) B X (ramp_both s at_ B X).
Proof. intros HX. exact (describes_on Both _ B X _ (ramp_at_rising s at_ B X HX)). Qed.

(** Three forms hold for every band. *)
Lemma band_by_ramps origin lower upper B X : 0 < X -> lower <= upper ->
  describes (static (fun x => held lower upper x - origin)) B X (band_near_the_maximum origin lower upper B X) /\
  describes (static (fun x => held lower upper x - origin)) B X (band_near_the_minimum origin lower upper B X) /\
  describes (static (fun x => held lower upper x - origin)) B X (wide_band origin lower upper B X).
Proof.
  intros HX lu. unfold band_near_the_maximum, band_near_the_minimum, wide_band.
  assert (ramps : forall s a, describes (static (ramp s a)) B X (ramp_both s a B X)) by (intros; now apply ramp_both_described).
  assert (L : describes (static (fun x => x - origin)) B X (line_df (B - origin))).
  { replace (line_df (B - origin)) with (df_minus (line_df B) (flat origin)) by (apply df_eq; simpl; ring).
    exact (describes_minus _ _ _ _ _ _ (line_described B X HX) (flat_described origin B X HX)). }
  assert (three : forall c a b d e f, describes (static c) B X d -> describes (static a) B X e -> describes (static b) B X f ->
    (forall x, c x + a x - b x = held lower upper x - origin) ->
    describes (static (fun x => held lower upper x - origin)) B X (df_minus (df_plus d e) f)).
  { intros c a b d e f D E G S. eapply describes_output; [|exact (describes_minus _ _ _ _ _ _ (describes_plus _ _ _ _ _ _ D E) G)].
    intros t. unfold output; simpl. destruct (Rlt_dec 0 (cos t)); apply S. }
  split; [|split].
  - apply (three (fun _ => lower - origin) (ramp Above lower) (ramp Above upper)); auto using flat_described.
    intros x. unfold held, ramp, beyond, Rmax, Rmin.
    by_cases; lra.
  - apply (three (fun _ => upper - origin) (ramp Below lower) (ramp Below upper)); auto using flat_described.
    intros x. unfold held, ramp, beyond, Rmax, Rmin.
    by_cases; lra.
  - apply (three (fun x => x - origin) (ramp Below lower) (ramp Above upper)); auto.
    intros x. unfold held, ramp, beyond, Rmax, Rmin.
    by_cases; lra.
Qed.

(** The form from the middle, by sine and cosine of half the sum and half the difference of the ends' angles. *)
Lemma clamp_place at_ B X : 0 < X -> Rmin (Rmax at_ (B - X)) (B + X) = B + X * ratio at_ B X.
Proof.
  intros HX. assert (D : X * ((at_ - B) / X) = at_ - B) by (field; lra). unfold ratio, Rmax, Rmin.
  by_cases; nra.
Qed.

Lemma overshoot_is at_ B X : 0 < X ->
  Rmax (Rmax (at_ - (B + X)) (B - X - at_)) 0 = at_ - (B + X * ratio at_ B X) + 2 * shortfall at_ B X.
Proof.
  intros HX. assert (D : X * ((at_ - B) / X) = at_ - B) by (field; lra). unfold shortfall, ratio, Rmax, Rmin.
  by_cases; nra.
Qed.

Lemma code_cosine scale u B X : 0 < X -> 0 < scale -> -1 <= u <= 1 ->
  sqrt (Rmax ((B + X * u - (B - X)) * scale) 0 * Rmax ((B + X - (B + X * u)) * scale) 0) = X * scale * sine u.
Proof.
  intros HX Hs U. assert (0 < X * scale) by now apply Rmult_lt_0_compat.
  rewrite !Rmax_left by (apply Rmult_le_pos; nra).
  replace ((B + X * u - (B - X)) * scale * ((B + X - (B + X * u)) * scale)) with ((X * scale) ^ 2 * ((1 - u) * (1 + u))) by ring.
  rewrite sqrt_mult by (try apply pow2_ge_0; apply Rmult_le_pos; lra). rewrite sqrt_pow2 by lra. reflexivity.
Qed.

Theorem from_the_middle_is_by_ramps scale origin lower upper B X : 0 < X -> 0 < scale -> lower <= upper ->
  0 < sine (ratio lower B X) + sine (ratio upper B X) ->
  band_from_the_middle scale origin lower upper B X = band_near_the_maximum origin lower upper B X.
Proof.
  intros HX Hs lu Hc. pose proof PI_RGT_0.
  unfold band_from_the_middle, band_near_the_maximum, ramp_both, ramp_at, sided, ramp_df, constant_df; cbv zeta.
  rewrite !clamp_place, !overshoot_is, !code_cosine by (trivial; apply ratio_range).
  assert (u12 : ratio lower B X <= ratio upper B X).
  { unfold ratio. apply Rle_max_compat_l, Rle_min_compat_r. unfold Rdiv.
    apply Rmult_le_compat_r; [left; now apply Rinv_0_lt_compat|lra]. }
  pose proof (ratio_range lower B X) as U. pose proof (ratio_range upper B X) as V.
  set (u := ratio lower B X) in *. set (v := ratio upper B X) in *.
  set (a := asin u). set (b := asin v).
  pose proof (asin_bound u) as A. pose proof (asin_bound v) as A'. fold a in A. fold b in A'.
  assert (Su : sin a = u) by now apply sin_asin. assert (Sv : sin b = v) by now apply sin_asin.
  assert (Cu : cos a = sine u) by now apply cos_asin_sine. assert (Cv : cos b = sine v) by now apply cos_asin_sine.
  assert (ab : a <= b).
  { destruct (Rle_dec a b) as [|N]; [assumption|]. assert (v < u); [|lra].
    rewrite <- Su, <- Sv. apply sin_increasing_1; lra. }
  set (m := (b - a) / 2). set (n := (a + b) / 2).
  assert (Ea : a = n - m) by (unfold m, n; field). assert (Eb : b = n + m) by (unfold m, n; field).
  rewrite Ea, sin_minus in Su. rewrite Eb, sin_plus in Sv. rewrite Ea, cos_minus in Cu. rewrite Eb, cos_plus in Cv.
  assert (P : 0 < cos n * cos m) by lra.
  assert (Pm : 0 < cos m) by (pose proof (cos_ge_0 m); destruct (Req_dec (cos m) 0) as [E|]; [rewrite E in P; lra|unfold m in *; lra]).
  assert (Pn : 0 < cos n) by (apply (Rmult_lt_reg_r (cos m)); lra).
  assert (Rm : - (PI / 2) < m < PI / 2).
  { split; [unfold m; lra|]. destruct (Req_dec m (PI / 2)) as [E|]; [rewrite E, cos_PI2 in Pm; lra|unfold m in *; lra]. }
  assert (Rn : - (PI / 2) < n < PI / 2).
  { split.
    - destruct (Req_dec n (- (PI / 2))) as [E|]; [rewrite E, cos_minus_PI2 in Pn; lra|unfold n in *; lra].
    - destruct (Req_dec n (PI / 2)) as [E|]; [rewrite E, cos_PI2 in Pn; lra|unfold n in *; lra]. }
  assert (K : X * scale <> 0) by (apply Rmult_integral_contrapositive; lra).
  assert (K' : X * scale * (cos n * cos m + sin n * sin m) + X * scale * (cos n * cos m - sin n * sin m) <> 0).
  { replace (X * scale * (cos n * cos m + sin n * sin m) + X * scale * (cos n * cos m - sin n * sin m))
      with (X * scale * (2 * (cos n * cos m))) by ring. apply Rmult_integral_contrapositive; lra. }
  assert (D : (B + X * v - (B + X * u)) * scale * (1 / (X * scale * sine u + X * scale * sine v)) = tan m).
  { rewrite <- Cu, <- Cv, <- Su, <- Sv. unfold tan. field. repeat split; lra. }
  assert (S : (B + X * u + (B + X * v) - (B + B)) * scale * (1 / (X * scale * sine u + X * scale * sine v)) = tan n).
  { rewrite <- Cu, <- Cv, <- Su, <- Sv. unfold tan. field. repeat split; lra. }
  rewrite D, S, !atan_tan by assumption.
  pose proof (sin2_cos2 m) as Qm. pose proof (sin2_cos2 n) as Qn. unfold Rsqr in Qm, Qn.
  apply df_eq; cbn [f0 p q df_plus df_minus flat on_df]; rewrite ?phi_is_acos by assumption; fold a b.
  - assert (T : (u + v) * tan m = sine u - sine v).
    { rewrite <- Cu, <- Cv, <- Su, <- Sv. unfold tan. field. lra. }
    replace (B + X * u + (B + X * v) - (B + B)) with (X * (u + v)) by ring.
    replace (X * (u + v) * (tan m - m)) with (X * ((u + v) * tan m - (u + v) * m)) by ring. rewrite T, Ea, Eb.
    field. lra.
  - assert (T : tan m * (1 - tan n ^ 2) / ((1 + tan m ^ 2) * (1 + tan n ^ 2)) = 1 / 2 * (sine v * v - sine u * u)).
    { assert (Im : 1 + tan m ^ 2 = / (cos m * cos m)).
      { unfold tan. replace (1 + (sin m / cos m) ^ 2) with ((sin m * sin m + cos m * cos m) / (cos m * cos m)) by (field; lra).
        rewrite Qm. field. lra. }
      assert (In : 1 + tan n ^ 2 = / (cos n * cos n)).
      { unfold tan. replace (1 + (sin n / cos n) ^ 2) with ((sin n * sin n + cos n * cos n) / (cos n * cos n)) by (field; lra).
        rewrite Qn. field. lra. }
      rewrite Im, In, <- Cu, <- Cv, <- Su, <- Sv. unfold tan. field. lra. }
    rewrite T, Ea, Eb. field. lra.
  - ring.
Qed.

(** Where the code takes that form, both cosines are not zero at once. *)
Lemma sine_positive u : -1 < u < 1 -> 0 < sine u.
Proof. intros H. apply sqrt_lt_R0, Rmult_lt_0_compat; lra. Qed.

Lemma middle_is_wide_enough lower upper B X : 0 < X -> lower <= upper ->
  lower - B - 1 / 2 * X <= 0 -> B - upper - 1 / 2 * X <= 0 -> upper - lower - X <= 0 ->
  0 < sine (ratio lower B X) + sine (ratio upper B X).
Proof.
  intros HX lu H1 H2 H3.
  assert (Du : X * ((lower - B) / X) = lower - B) by (field; lra). assert (Dv : X * ((upper - B) / X) = upper - B) by (field; lra).
  pose proof (sqrt_pos ((1 - ratio lower B X) * (1 + ratio lower B X))).
  pose proof (sqrt_pos ((1 - ratio upper B X) * (1 + ratio upper B X))).
  destruct (Rle_dec (lower - B) (- (1 / 2) * X)) as [L|L].
  - assert (0 < sine (ratio upper B X)); [|unfold sine in *; lra]. apply sine_positive. unfold ratio, Rmax, Rmin. by_cases; nra.
  - assert (0 < sine (ratio lower B X)); [|unfold sine in *; lra]. apply sine_positive. unfold ratio, Rmax, Rmin. by_cases; nra.
Qed.

Theorem band_described scale origin lower upper B X : 0 < X -> 0 < scale -> lower <= upper ->
  describes (static (fun x => held lower upper x - origin)) B X (band_df scale origin lower upper B X).
Proof.
  intros HX Hs lu. destruct (band_by_ramps origin lower upper B X HX lu) as [B1 [B2 B3]]. unfold band_df.
  destruct (Rlt_dec 0 (lower - B - 1 / 2 * X)); [exact B1|].
  destruct (Rlt_dec 0 (B - upper - 1 / 2 * X)); [exact B2|].
  destruct (Rlt_dec 0 (upper - lower - X)); [exact B3|].
  rewrite from_the_middle_is_by_ramps; [exact B1|assumption..|]. apply middle_is_wide_enough; lra.
Qed.
