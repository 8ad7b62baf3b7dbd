(** The piecewise-linear catalogue: each member's output as [src/nonlinearity] states it, and the kernels that it is reported to
    be the sum of. Proved here: it is, but at the breakpoints, which no integral sees. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels.
Import ListNotations.
Open Scope R_scope.

(** * Kernels and their sums *)

Inductive kernel :=
  | Constant (value : R) (b : branches)
  | Line (slope : R)
  | Sign (at_ level : R) (b : branches)
  | Step (at_ height : R) (s : side) (b : branches)
  | Ramp (at_ slope : R) (s : side) (b : branches)
  | Band (origin lower upper slope : R).

Definition shape (k : kernel) : characteristic :=
  match k with
  | Constant value b => multiple_of value (on b (fun _ => 1))
  | Line slope => multiple_of slope (static (fun x => x))
  | Sign at_ level b => multiple_of level (on b (sign at_))
  | Step at_ height s b => multiple_of height (on b (step s at_))
  | Ramp at_ slope s b => multiple_of slope (on b (ramp s at_))
  | Band origin lower upper slope => multiple_of slope (static (fun x => held lower upper x - origin))
  end.

(** [DescribingFunction::of]; [scale] is the power of two that a band takes, any positive number. *)
Definition df_of (scale B X : R) (k : kernel) : df :=
  match k with
  | Constant value b => df_times value (on_df b (constant_df X))
  | Line slope => df_times slope (line_df B)
  | Sign at_ level b => df_times level (on_df b (sign_df (ratio at_ B X) X))
  | Step at_ height s b => df_times height (on_df b (step_at s at_ B X))
  | Ramp at_ slope s b => df_times slope (on_df b (ramp_at s at_ B X))
  | Band origin lower upper slope => df_times slope (band_df scale origin lower upper B X)
  end.

Definition well_formed (k : kernel) : Prop := match k with Band _ lower upper _ => lower <= upper | _ => True end.

Definition sum_shape (ks : list kernel) : characteristic := fold_right (fun k c => sum_of (shape k) c) (static (fun _ => 0)) ks.
Definition sum_df (scale B X : R) (ks : list kernel) : df := fold_right (fun k d => df_plus (df_of scale B X k) d) (flat 0) ks.

Theorem kernel_described scale B X k : 0 < X -> 0 < scale -> well_formed k -> describes (shape k) B X (df_of scale B X k).
Proof.
  intros HX Hs Hk. destruct k; simpl; apply describes_times.
  - apply describes_on. now apply constant_rising.
  - now apply line_described.
  - apply describes_on. now apply sign_at_rising.
  - apply describes_on. now apply step_at_rising.
  - apply describes_on. now apply ramp_at_rising.
  - now apply band_described.
Qed.

(** Integrals are linear: of any number of kernels. *)
Theorem sum_described scale B X ks : 0 < X -> 0 < scale -> List.Forall well_formed ks ->
  describes (sum_shape ks) B X (sum_df scale B X ks).
Proof.
  intros HX Hs. induction ks as [|k ks IH]; intros F; simpl; [now apply flat_described|].
  inversion F; subst. apply describes_plus; [now apply kernel_described|now apply IH].
Qed.

(** A characteristic is the sum of these kernels on this sweep, but at single points. *)
Definition is_sum (c : characteristic) (B X : R) (ks : list kernel) : Prop :=
  List.Forall well_formed ks /\ exists points, forall x, B - X <= x <= B + X -> ~ In x points ->
    rising (sum_shape ks) x = rising c x /\ falling (sum_shape ks) x = falling c x.

Theorem described_by_kernels c scale B X ks : 0 < X -> 0 < scale -> is_sum c B X ks -> describes c B X (sum_df scale B X ks).
Proof.
  intros HX Hs [W [points H]]. apply (describes_off points (sum_shape ks)); trivial. now apply sum_described.
Qed.

(** * The members: outputs *)

Definition relay (level : R) : characteristic := static (fun x => select x (- level) level).
Definition relay_dead_zone (level dead_zone : R) : characteristic :=
  static (fun x => select (Rabs x - dead_zone) 0 (select x (- level) level)).
Definition relay_hysteresis (level half_width offset : R) : characteristic :=
  {| rising := fun x => offset + select (x - half_width) (- level) level;
     falling := fun x => offset + select (x - - half_width) (- level) level |}.
(** The levels of the sides that the sweep reaches are 0 or the level. *)
Definition relay_dead_zone_hysteresis (level on_ off B X : R) : characteristic :=
  let positive := select (B + X - on_) 0 level in
  let negative := select (- on_ - (B - X)) 0 level in
  {| rising := fun x => select (x - on_) 0 positive - select (x - - off) negative 0;
     falling := fun x => select (x - off) 0 positive - select (x - - on_) negative 0 |}.
Definition saturation (slope breakpoint : R) : characteristic :=
  static (fun x => slope * held (- breakpoint) breakpoint x).
Definition saturation_asymmetric (slope lower upper : R) : characteristic := static (fun x => slope * held lower upper x).
Definition dead_zone (slope half_width : R) : characteristic :=
  static (fun x => slope * (x - held (- half_width) half_width x)).
Definition dead_zone_saturation (slope half_width breakpoint : R) : characteristic :=
  static (fun x => let h := held (- breakpoint) breakpoint x in slope * (h - held (- half_width) half_width h)).
Definition gain_changing (inner outer breakpoint : R) : characteristic :=
  static (fun x => let h := held (- breakpoint) breakpoint x in inner * h + outer * (x - h)).
Definition preload (slope level : R) : characteristic := static (fun x => slope * x + select x (- level) level).
Definition absolute (gain : R) : characteristic := static (fun x => gain * Rabs x).
Definition floor (x : R) : R := IZR (Int_part x).
Definition quantizer (tread : R) : characteristic := static (fun x => tread * floor (x / tread + 1 / 2)).
Definition backlash (slope half_gap B X : R) : characteristic :=
  {| rising := fun x => slope * Rmax (x - half_gap) (B - X + half_gap);
     falling := fun x => slope * Rmin (x + half_gap) (B + X - half_gap) |}.

Definition point : Type := R * R.
Definition slope_between (a b : point) : R := (snd b - snd a) / (fst b - fst a).
Fixpoint follow (right_slope : R) (a : point) (rest : list point) (x value : R) : R :=
  match rest with
  | [] => select (x - fst a) value (snd a + right_slope * (x - fst a))
  | b :: rest => follow right_slope b rest x (select (x - fst a) value (snd a + slope_between a b * (x - fst a)))
  end.
Definition polyline (left_slope right_slope : R) (first : point) (rest : list point) : characteristic :=
  static (fun x => follow right_slope first rest x (snd first + left_slope * (x - fst first))).

(** * The members: kernels *)

Definition crossing (at_ slope : R) : list kernel := [Ramp at_ slope Above Both; Ramp (- at_) (- slope) Below Both].

Definition relay_kernels (level : R) := [Sign 0 level Both].
Definition relay_dead_zone_kernels (level dead_zone : R) := [Step dead_zone level Above Both; Step (- dead_zone) (- level) Below Both].
Definition relay_hysteresis_kernels (level half_width offset : R) :=
  [Constant offset Both; Sign half_width level Rising; Sign (- half_width) level Falling].
Definition relay_dead_zone_hysteresis_kernels (level on_ off B X : R) :=
  let positive := select (B + X - on_) 0 level in
  let negative := select (- on_ - (B - X)) 0 level in
  [Step on_ positive Above Rising; Step off positive Above Falling;
   Step (- off) (- negative) Below Rising; Step (- on_) (- negative) Below Falling].
Definition saturation_kernels (slope lower upper : R) := [Band 0 lower upper slope].
Definition dead_zone_saturation_kernels (slope inner outer : R) :=
  [Band inner inner outer slope; Band (- inner) (- outer) (- inner) slope].
(** By the order of the slopes, one of three. *)
Definition gain_changing_kernels_1 (inner outer at_ : R) := [Line outer; Band 0 (- at_) at_ (inner - outer)].
Definition gain_changing_kernels_2 (inner outer at_ : R) := Line inner :: crossing at_ (outer - inner).
Definition gain_changing_kernels_3 (inner outer at_ : R) := Band 0 (- at_) at_ inner :: crossing at_ outer.
Definition preload_kernels (slope level : R) := [Line slope; Sign 0 level Both].
Definition absolute_kernels (gain : R) := [Ramp 0 gain Above Both; Ramp 0 gain Below Both].
Fixpoint treads (kernel_at : R -> kernel) (n : nat) : list kernel :=
  match n with O => [] | S m => kernel_at (INR n - 1 / 2) :: treads kernel_at m end.
Definition quantizer_kernels (tread : R) (above below : nat) :=
  treads (fun place => Step (tread * place) tread Above Both) above ++
  treads (fun place => Step (- (tread * place)) (- tread) Below Both) below.
Definition backlash_kernels (slope half_gap B X : R) :=
  [Line slope; Constant (- (slope * half_gap)) Rising; Constant (slope * half_gap) Falling;
   Ramp (B - X + 2 * half_gap) slope Below Rising; Ramp (B + X - 2 * half_gap) (- slope) Above Falling].
(** Bands count from the end that is nearer to the anchor, the point of number [anchor]. *)
Fixpoint bands (anchor : nat) (a : point) (rest : list point) : list kernel :=
  match rest with
  | [] => []
  | b :: rest => Band (match anchor with O => fst a | S _ => fst b end) (fst a) (fst b) (slope_between a b) :: bands (pred anchor) b rest
  end.
Definition polyline_kernels (left_slope right_slope : R) (anchor : nat) (first : point) (rest : list point) :=
  Constant (snd (nth anchor (first :: rest) first)) Both ::
  Ramp (fst first) (- left_slope) Below Both :: Ramp (fst (last rest first)) right_slope Above Both :: bands anchor first rest.

(** * They are the sums *)

Ltac decide_all := repeat match goal with
  | |- context [Rlt_dec ?a ?b] => lazymatch a with context [Rlt_dec _ _] => fail | context [Rle_dec _ _] => fail | _ =>
      lazymatch b with context [Rlt_dec _ _] => fail | context [Rle_dec _ _] => fail | _ => destruct (Rlt_dec a b) end end
  | |- context [Rle_dec ?a ?b] => lazymatch a with context [Rlt_dec _ _] => fail | context [Rle_dec _ _] => fail | _ =>
      lazymatch b with context [Rlt_dec _ _] => fail | context [Rle_dec _ _] => fail | _ => destruct (Rle_dec a b) end end
  end.
Ltac well_formed := repeat match goal with |- List.Forall _ _ => constructor end; simpl; try exact I; try lra.
Ltac unfold_kernels := unfold step, ramp, sign, held, beyond, select, Rmax, Rmin in *.

(** What ramps and held inputs make together. *)
Ltac by_orders := unfold_kernels; decide_all; lra.
Lemma outside at_ x : 0 <= at_ -> ramp Above at_ x - ramp Below (- at_) x = x - held (- at_) at_ x.
Proof. intros H. by_orders. Qed.
Lemma between inner outer x : 0 <= inner -> inner <= outer ->
  held inner outer x - inner + (held (- outer) (- inner) x - - inner)
  = held (- outer) outer x - held (- inner) inner (held (- outer) outer x).
Proof. intros H H'. by_orders. Qed.
Lemma absolute_value x : Rabs x = ramp Above 0 x + ramp Below 0 x.
Proof. unfold Rabs. destruct (Rcase_abs x); by_orders. Qed.
Lemma not_below at_ x : Rmax x at_ = x + ramp Below at_ x.
Proof. by_orders. Qed.
Lemma not_above at_ x : Rmin x at_ = x - ramp Above at_ x.
Proof. by_orders. Qed.

Section Members.
Variables B X : R.
Hypothesis X_positive : 0 < X.

Lemma relay_is_sum level : is_sum (relay level) B X (relay_kernels level).
Proof.
  split; [well_formed|exists [0]]. intros x _ N. simpl in *. unfold_kernels. decide_all; split; lra.
Qed.

Lemma relay_dead_zone_is_sum level width : 0 <= width ->
  is_sum (relay_dead_zone level width) B X (relay_dead_zone_kernels level width).
Proof.
  intros H. split; [well_formed|exists [width; - width]]. intros x _ N. simpl in *. unfold_kernels.
  unfold Rabs. destruct (Rcase_abs x); decide_all; split; try lra; destruct N; lra.
Qed.

Lemma relay_hysteresis_is_sum level half_width offset :
  is_sum (relay_hysteresis level half_width offset) B X (relay_hysteresis_kernels level half_width offset).
Proof.
  split; [well_formed|exists []]. intros x _ N. simpl in *. unfold_kernels. decide_all; split; lra.
Qed.

Lemma relay_dead_zone_hysteresis_is_sum level on_ off :
  is_sum (relay_dead_zone_hysteresis level on_ off B X) B X (relay_dead_zone_hysteresis_kernels level on_ off B X).
Proof.
  split; [well_formed|exists [- on_; - off]]. intros x _ N. simpl in *.
  generalize (select (B + X - on_) 0 level) (select (- on_ - (B - X)) 0 level). intros positive negative.
  unfold_kernels. decide_all; split; try lra; destruct N; lra.
Qed.

Lemma saturation_is_sum slope lower upper : lower <= upper ->
  is_sum (saturation_asymmetric slope lower upper) B X (saturation_kernels slope lower upper).
Proof. intros H. split; [well_formed|exists []]. intros x _ _. simpl. split; ring. Qed.

Lemma dead_zone_is_sum slope half_width : 0 <= half_width -> is_sum (dead_zone slope half_width) B X (crossing half_width slope).
Proof.
  intros H. split; [well_formed|exists []]. intros x _ _. simpl.
  rewrite <- outside by exact H. split; ring.
Qed.

Lemma dead_zone_saturation_is_sum slope inner outer : 0 <= inner -> inner <= outer ->
  is_sum (dead_zone_saturation slope inner outer) B X (dead_zone_saturation_kernels slope inner outer).
Proof.
  intros H H'. split; [well_formed|exists []]. intros x _ _. simpl.
  rewrite <- between by assumption. split; ring.
Qed.

Lemma gain_changing_is_sum inner outer at_ : 0 <= at_ ->
  is_sum (gain_changing inner outer at_) B X (gain_changing_kernels_1 inner outer at_) /\
  is_sum (gain_changing inner outer at_) B X (gain_changing_kernels_2 inner outer at_) /\
  is_sum (gain_changing inner outer at_) B X (gain_changing_kernels_3 inner outer at_).
Proof.
  intros H. split; [|split]; (split; [well_formed|exists []]); intros x _ _; simpl;
    pose proof (outside at_ x H); replace (held (- at_) at_ x) with (x - (ramp Above at_ x - ramp Below (- at_) x)) by lra; split; ring.
Qed.

Lemma preload_is_sum slope level : is_sum (preload slope level) B X (preload_kernels slope level).
Proof.
  split; [well_formed|exists []]. intros x _ _. simpl. unfold_kernels. decide_all; split; lra.
Qed.

Lemma absolute_is_sum gain : is_sum (absolute gain) B X (absolute_kernels gain).
Proof.
  split; [well_formed|exists []]. intros x _ _. simpl. rewrite absolute_value. split; ring.
Qed.

Lemma backlash_is_sum slope half_gap : is_sum (backlash slope half_gap B X) B X (backlash_kernels slope half_gap B X).
Proof.
  split; [well_formed|exists []]. intros x _ _. simpl.
  rewrite not_below, not_above. unfold ramp, beyond. split.
  - replace (B - X + half_gap - (x - half_gap)) with (B - X + 2 * half_gap - x) by ring. ring.
  - replace (x + half_gap - (B + X - half_gap)) with (x - (B + X - 2 * half_gap)) by ring. ring.
Qed.
End Members.

(** The quantizer: of all treads those count that the input has passed. *)
Fixpoint count (n : nat) (y : R) : R :=
  match n with O => 0 | S m => (if Rlt_dec (INR n - 1 / 2) y then 1 else 0) + count m y end.

Lemma count_all n y : INR n - 1 / 2 < y -> count n y = INR n.
Proof.
  induction n as [|n IH]; intros H; [reflexivity|]. cbn [count]. destruct (Rlt_dec (INR (S n) - 1 / 2) y); [|lra].
  rewrite S_INR in *. rewrite IH; lra.
Qed.

Lemma count_is (j n : nat) y : (j <= n)%nat -> (j = O \/ INR j - 1 / 2 < y) -> y <= INR j + 1 / 2 -> count n y = INR j.
Proof.
  intros jn L H. induction n as [|n IH].
  - replace j with O by lia. reflexivity.
  - destruct (Nat.eq_dec j (S n)) as [->|N].
    + destruct L as [L|L]; [discriminate|now apply count_all].
    + cbn [count]. rewrite IH by lia. destruct (Rlt_dec (INR (S n) - 1 / 2) y); [exfalso|ring].
      assert (INR j <= INR n) by (apply le_INR; lia). rewrite S_INR in *. lra.
Qed.

Lemma sum_shape_app ks ls x :
  rising (sum_shape (ks ++ ls)) x = rising (sum_shape ks) x + rising (sum_shape ls) x /\
  falling (sum_shape (ks ++ ls)) x = falling (sum_shape ks) x + falling (sum_shape ls) x.
Proof.
  induction ks as [|k ks [IH1 IH2]]; simpl; [split; ring|]. unfold sum_shape in *. rewrite IH1, IH2. split; ring.
Qed.

Lemma treads_count tread x n : 0 < tread ->
  let above := sum_shape (treads (fun place => Step (tread * place) tread Above Both) n) in
  let below := sum_shape (treads (fun place => Step (- (tread * place)) (- tread) Below Both) n) in
  rising above x = tread * count n (x / tread) /\ falling above x = tread * count n (x / tread) /\
  rising below x = - (tread * count n (- x / tread)) /\ falling below x = - (tread * count n (- x / tread)).
Proof.
  intros Ht. cbv zeta.
  assert (D : tread * (x / tread) = x) by (field; lra). assert (D' : tread * (- x / tread) = - x) by (field; lra).
  induction n as [|n [I1 [I2 [I3 I4]]]]; [simpl; repeat split; ring|].
  cbn [treads count]. set (place := INR (S n) - 1 / 2). unfold sum_shape in *. cbn [fold_right sum_of shape on multiple_of static rising falling].
  rewrite I1, I2, I3, I4. unfold step, beyond, select.
  assert (E1 : 0 < x - tread * place <-> place < x / tread) by (split; nra).
  assert (E2 : 0 < - (tread * place) - x <-> place < - x / tread) by (split; nra).
  destruct (Rlt_dec 0 (x - tread * place)), (Rlt_dec place (x / tread)); try tauto;
    destruct (Rlt_dec 0 (- (tread * place) - x)), (Rlt_dec place (- x / tread)); try tauto; repeat split; ring.
Qed.

Lemma treads_well_formed (f : R -> kernel) n : (forall place, well_formed (f place)) -> List.Forall well_formed (treads f n).
Proof. intros H. induction n; simpl; constructor; auto. Qed.

Lemma quantizer_is_sum tread B X above below : 0 < tread ->
  (B + X) / tread < INR above + 1 / 2 -> - (B - X) / tread < INR below + 1 / 2 ->
  is_sum (quantizer tread) B X (quantizer_kernels tread above below).
Proof.
  intros Ht Ha Hb. split.
  - apply Forall_app. split; apply treads_well_formed; intros; exact I.
  - exists (map (fun k => tread * (INR k - 1 / 2)) (seq 1 above)). intros x [L H] N.
    set (y := x / tread). assert (D : x = tread * y) by (unfold y; field; lra).
    assert (Ly : - y < INR below + 1 / 2).
    { apply Rle_lt_trans with (2 := Hb). unfold y, Rdiv. rewrite <- Ropp_mult_distr_l. apply Ropp_le_contravar, Rmult_le_compat_r; [left; now apply Rinv_0_lt_compat|lra]. }
    assert (Hy : y < INR above + 1 / 2).
    { apply Rle_lt_trans with (2 := Ha). apply Rmult_le_compat_r; [left; now apply Rinv_0_lt_compat|lra]. }
    destruct (treads_count tread x above Ht) as [A1 [A2 _]]. destruct (treads_count tread x below Ht) as [_ [_ [B1 B2]]].
    unfold quantizer_kernels. destruct (sum_shape_app (treads (fun place => Step (tread * place) tread Above Both) above)
      (treads (fun place => Step (- (tread * place)) (- tread) Below Both) below) x) as [S1 S2].
    rewrite S1, S2, A1, A2, B1, B2. unfold quantizer; simpl. replace (- x / tread) with (- y) by (unfold y; field; lra). fold y.
    assert (K : count above y - count below (- y) = floor (y + 1 / 2)); [|split; rewrite <- K; ring].
    unfold floor. destruct (base_Int_part (y + 1 / 2)) as [F1 F2]. set (z := Int_part (y + 1 / 2)) in *.
    destruct (Z_le_gt_dec 0 z) as [P|P].
    + set (j := Z.to_nat z). assert (J : INR j = IZR z) by (unfold j; rewrite INR_IZR_INZ, Z2Nat.id; [reflexivity|exact P]).
      assert (z0 : 0 <= IZR z) by (now apply IZR_le).
      rewrite (count_is j above), (count_is 0 below); try (left; reflexivity); try lia; [simpl; lra|simpl; lra| | |lra].
      * apply INR_le. apply le_INR. apply Nat.lt_succ_r, INR_lt. rewrite S_INR. lra.
      * destruct (Nat.eq_dec j 0) as [E|E]; [now left|right]. destruct (Rtotal_order (INR j - 1 / 2) y) as [T|[T|T]]; [exact T| |lra].
        exfalso. apply N. apply in_map_iff. exists j. split; [rewrite T; symmetry; exact D|].
        apply in_seq. split; [lia|]. assert (j < S above)%nat; [|lia]. apply INR_lt. rewrite S_INR. lra.
    + set (j := Z.to_nat (- z)). assert (J : INR j = - IZR z) by (unfold j; rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR; [reflexivity|lia]).
      assert (z1 : IZR z <= -1) by (apply IZR_le; lia).
      rewrite (count_is 0 above), (count_is j below); try (left; reflexivity); try lia; [simpl; lra| |right; lra|lra|simpl; lra].
      apply Nat.lt_succ_r, INR_lt. rewrite S_INR. lra.
Qed.

(** The polyline, of any number of points. *)
Fixpoint ascends (a : point) (rest : list point) : Prop :=
  match rest with [] => True | b :: rest => fst a < fst b /\ ascends b rest end.

(** What the bands that count from their lower ends add. *)
Definition over (x : R) (ks : list kernel) : R := rising (sum_shape ks) x.
Lemma over_cons x k ks : over x (k :: ks) = rising (shape k) x + over x ks.
Proof. reflexivity. Qed.

Lemma bands_static x anchor a rest : falling (sum_shape (bands anchor a rest)) x = over x (bands anchor a rest).
Proof.
  revert anchor a. induction rest as [|b rest IH]; intros; [reflexivity|].
  unfold over, sum_shape in *. simpl. now rewrite IH.
Qed.

Lemma last_cons (rest : list point) : forall a b, last (b :: rest) a = last rest b.
Proof. induction rest as [|c rest IH]; intros a b; [reflexivity|]. change (last (c :: rest) a = last (c :: rest) b). now rewrite !IH. Qed.

Lemma before_first rest : forall a x right_slope v, ascends a rest -> x <= fst a ->
  follow right_slope a rest x v = v /\ over x (bands 0 a rest) = 0 /\ x <= fst (last rest a).
Proof.
  induction rest as [|b rest IH]; intros a x r v S H.
  - simpl. unfold select. destruct (Rlt_dec 0 (x - fst a)); [lra|]. repeat split; trivial.
  - destruct S as [S1 S2]. assert (Hb : x <= fst b) by lra. rewrite last_cons. cbn [follow bands pred].
    destruct (IH b x r (select (x - fst a) v (snd a + slope_between a b * (x - fst a))) S2 Hb) as [I1 [I2 I3]].
    assert (K : follow r b rest x (select (x - fst a) v (snd a + slope_between a b * (x - fst a))) = v).
    { rewrite I1. unfold select. destruct (Rlt_dec 0 (x - fst a)); [lra|reflexivity]. }
    split; [exact K|]. split.
    + rewrite over_cons, I2. simpl. unfold held. rewrite Rmax_right, Rmin_left by lra. ring.
    + exact I3.
Qed.

Lemma after_first rest : forall a x right_slope v, ascends a rest -> fst a < x ->
  follow right_slope a rest x v = snd a + over x (bands 0 a rest) + right_slope * Rmax (x - fst (last rest a)) 0.
Proof.
  induction rest as [|b rest IH]; intros a x r v S H.
  - simpl. unfold select, over. simpl. destruct (Rlt_dec 0 (x - fst a)); [|lra]. rewrite Rmax_left by lra. ring.
  - destruct S as [S1 S2]. cbn [follow bands pred]. rewrite over_cons. simpl (rising (shape _) x).
    assert (V : select (x - fst a) v (snd a + slope_between a b * (x - fst a)) = snd a + slope_between a b * (x - fst a)).
    { unfold select. destruct (Rlt_dec 0 (x - fst a)); [reflexivity|lra]. }
    rewrite V, last_cons. destruct (Rle_dec x (fst b)) as [L|L].
    + destruct (before_first rest b x r (snd a + slope_between a b * (x - fst a)) S2 L) as [I1 [I2 I3]].
      rewrite I1, I2. unfold held. rewrite (Rmax_left x), (Rmin_left x) by lra. rewrite Rmax_right by lra. ring.
    + rewrite IH by (trivial; lra). unfold held. rewrite (Rmax_left x), (Rmin_right x) by lra.
      assert (K : slope_between a b * (fst b - fst a) = snd b - snd a) by (unfold slope_between; field; lra). lra.
Qed.

Lemma any_anchor rest : forall anchor a x, ascends a rest -> (anchor <= length rest)%nat ->
  snd (nth anchor (a :: rest) a) + over x (bands anchor a rest) = snd a + over x (bands 0 a rest).
Proof.
  induction rest as [|b rest IH]; intros anchor a x S H; [simpl in H; replace anchor with O by lia; reflexivity|].
  destruct anchor as [|anchor]; [reflexivity|]. destruct S as [S1 S2]. simpl in H.
  change (nth (Datatypes.S anchor) (a :: b :: rest) a) with (nth anchor (b :: rest) a).
  rewrite (nth_indep (b :: rest) a b) by (simpl; lia).
  cbn [bands pred]. rewrite !over_cons. specialize (IH anchor b x S2 ltac:(lia)). simpl (rising (shape _) x).
  assert (K : slope_between a b * (fst b - fst a) = snd b - snd a) by (unfold slope_between; field; lra). nra.
Qed.

Lemma polyline_is_sum left_slope right_slope anchor first rest B X :
  ascends first rest -> (anchor <= length rest)%nat ->
  is_sum (polyline left_slope right_slope first rest) B X (polyline_kernels left_slope right_slope anchor first rest).
Proof.
  intros S H. split.
  - repeat (constructor; [exact I|]). clear H. revert anchor first S.
    induction rest as [|b rest IH]; intros anchor a S; constructor; destruct S; [simpl; lra|now apply IH].
  - exists []. intros x _ _.
    assert (K : over x (polyline_kernels left_slope right_slope anchor first rest)
                = follow right_slope first rest x (snd first + left_slope * (x - fst first))).
    { unfold polyline_kernels. rewrite !over_cons. pose proof (any_anchor rest anchor first x S H) as A.
      set (value := snd (nth anchor (first :: rest) first)) in *. simpl (rising (shape _) x). unfold ramp, beyond.
      destruct (Rle_dec x (fst first)) as [L|L].
      - destruct (before_first rest first x right_slope (snd first + left_slope * (x - fst first)) S L) as [I1 [I2 I3]].
        rewrite I1. rewrite I2 in A. rewrite (Rmax_left (fst first - x)), Rmax_right by lra. lra.
      - rewrite after_first by (trivial; lra). rewrite (Rmax_right (fst first - x)) by lra. lra. }
    split; [exact K|].
    transitivity (over x (polyline_kernels left_slope right_slope anchor first rest)); [|exact K]. unfold polyline_kernels. cbn [sum_shape fold_right sum_of falling].
    rewrite bands_static. unfold over. cbn [sum_shape fold_right sum_of rising]. reflexivity.
Qed.
