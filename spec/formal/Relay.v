(** The output of a relay with hysteresis for a biased sinusoid: from the relay's law to the times of switching, and the integral of
    the output times any weight over any turn. Shared by relay-p, relay-q, relay-f0 and table-3. *)
From Coq Require Import Reals Lra Lia Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

(** The relay switches both ways: the sinusoid passes both levels, or at least reaches both and the relay turns at the level itself. *)
Definition switches (C x_a x_0 X : R) (y : R -> R) : Prop :=
  relay always C x_a (sinusoid x_0 X) y /\
  (x_a + Rabs x_0 < X \/ 0 < X /\ x_a + Rabs x_0 <= X /\ turns_at_level always C x_a (sinusoid x_0 X) y).

Lemma relay_shift (C x_a : R) (f y : R -> R) (v : R) :
  relay always C x_a f y -> relay always C x_a (fun t => f (t + v)) (fun t => y (t + v)).
Proof.
  assert (A : forall t, always t) by (intros; exact I).
  intros L. split.
  - intros t _. apply (two_valued _ _ _ _ _ L), A.
  - intros t _. apply (high _ _ _ _ _ L), A.
  - intros t _. apply (low _ _ _ _ _ L), A.
  - intros s t _ _ st Y between. apply (stays_high _ _ _ _ _ L (s + v) (t + v)); auto; [lra|].
    intros r _ Hr. replace r with (r - v + v) by ring. apply between; [apply A|lra].
  - intros s t _ _ st Y between. apply (stays_low _ _ _ _ _ L (s + v) (t + v)); auto; [lra|].
    intros r _ Hr. replace r with (r - v + v) by ring. apply between; [apply A|lra].
Qed.

Lemma switches_shift (C x_a x_0 X : R) (y : R -> R) (v : R) : (forall t, sin (t + v) = sin t) ->
  switches C x_a x_0 X y -> switches C x_a x_0 X (fun t => y (t + v)).
Proof.
  intros P [L H]. assert (E : forall t, sinusoid x_0 X (t + v) = sinusoid x_0 X t) by (intros; unfold sinusoid; now rewrite P).
  split.
  - destruct (relay_shift _ _ _ _ v L) as [a b c d e]. split.
    + exact a.
    + intros t T. rewrite <- E. apply b, T.
    + intros t T. rewrite <- E. apply c, T.
    + intros s t S T st Y between. apply (d s t S T st Y). intros r Rr Hr. rewrite E. apply between; assumption.
    + intros s t S T st Y between. apply (e s t S T st Y). intros r Rr Hr. rewrite E. apply between; assumption.
  - destruct H as [H|[HX [H [h l]]]]; [left; exact H|right]. split; [exact HX|]. split; [exact H|]. split.
    + intros t T. rewrite <- E. apply h. exact I.
    + intros t T. rewrite <- E. apply l. exact I.
Qed.

Section Relay.
Variables C x_a x_0 X : R.
Hypotheses (Hxa : 0 <= x_a) (HX : 0 < X) (reach : x_a + Rabs x_0 <= X).

(** The angles at which the input rises through [x_a] and falls through [-x_a]. *)
Definition up : R := asin ((x_a - x_0) / X).
Definition down : R := PI + asin ((x_a + x_0) / X).

Lemma bounds : - Rabs x_0 <= x_0 <= Rabs x_0.
Proof. unfold Rabs. destruct (Rcase_abs x_0); lra. Qed.

Lemma share u : - X <= u <= X -> -1 <= u / X <= 1.
Proof. intros H. split; apply (Rmult_le_reg_r X); try lra; unfold Rdiv; rewrite Rmult_assoc, Rinv_l; lra. Qed.

Lemma share_up : -1 <= (x_a - x_0) / X <= 1.
Proof. apply share. pose proof bounds. lra. Qed.
Lemma share_down : -1 <= (x_a + x_0) / X <= 1.
Proof. apply share. pose proof bounds. lra. Qed.

Lemma sin_up : X * sin up = x_a - x_0.
Proof. unfold up. rewrite sin_asin by apply share_up. field. lra. Qed.
Lemma sin_down : X * sin down = - (x_a + x_0).
Proof. unfold down. rewrite Rplus_comm, neg_sin, sin_asin by apply share_down. field. lra. Qed.

Lemma order : - (PI / 2) <= up <= PI / 2 /\ PI / 2 <= down <= 3 * (PI / 2).
Proof. pose proof (asin_bound ((x_a - x_0) / X)). pose proof (asin_bound ((x_a + x_0) / X)). unfold up, down. lra. Qed.

Variable y : R -> R.
Hypothesis law : switches C x_a x_0 X y.

Lemma high_between t : up < t < down -> y t = C.
Proof.
  intros [T1 T2]. pose proof PI_RGT_0. pose proof order as O. pose proof sin_up as U. pose proof sin_down as D.
  destruct law as [L S]. assert (A : forall s, always s) by (intros; exact I).
  destruct (Rlt_le_dec t (PI / 2)) as [Q|Q].
  - apply (high _ _ _ _ _ L); [apply A|]. unfold sinusoid. assert (sin up < sin t) by (apply sin_increasing_1; lra). nra.
  - (* At the top the output is high, and the input has not yet fallen to the lower level. *)
    assert (Y : y (PI / 2) = C).
    { destruct (Req_dec (x_a) (x_0 + X)) as [E|N].
      - destruct S as [S|[_ [_ S]]].
        + pose proof bounds. lra.
        + apply (high_at _ _ _ _ _ S); [apply A|]. unfold sinusoid. rewrite sin_PI2. lra.
      - apply (high _ _ _ _ _ L); [apply A|]. unfold sinusoid. rewrite sin_PI2. pose proof bounds. lra. }
    apply (stays_high _ _ _ _ _ L (PI / 2) t (A _) (A _) Q Y). intros r _ [R1 R2]. unfold sinusoid.
    assert (sin down < sin r) by (apply sin_decreasing_1; lra). nra.
Qed.

Lemma low_between t : down < t < up + 2 * PI -> y t = - C.
Proof.
  intros [T1 T2]. pose proof PI_RGT_0. pose proof order as O. pose proof sin_up as U. pose proof sin_down as D.
  destruct law as [L S]. assert (A : forall s, always s) by (intros; exact I).
  destruct (Rlt_le_dec t (3 * (PI / 2))) as [Q|Q].
  - apply (low _ _ _ _ _ L); [apply A|]. unfold sinusoid. assert (sin t < sin down) by (apply sin_decreasing_1; lra). nra.
  - assert (rise : forall r, 3 * (PI / 2) <= r < up + 2 * PI -> sin r < sin up).
    { intros r Hr. replace (sin r) with (sin (r - 2 * PI)).
      - apply sin_increasing_1; lra.
      - rewrite <- (sin_turn (r - 2 * PI)). f_equal. ring. }
    assert (Y : y (3 * (PI / 2)) = - C).
    { destruct (Req_dec (- x_a) (x_0 - X)) as [E|N].
      - destruct S as [S|[_ [_ S]]].
        + pose proof bounds. lra.
        + apply (low_at _ _ _ _ _ S); [apply A| |]; unfold sinusoid; rewrite sin_3PI2; [lra|].
          specialize (rise (3 * (PI / 2)) ltac:(lra)). rewrite sin_3PI2 in rise. nra.
      - apply (low _ _ _ _ _ L); [apply A|]. unfold sinusoid. rewrite sin_3PI2. pose proof bounds. lra. }
    apply (stays_low _ _ _ _ _ L (3 * (PI / 2)) t (A _) (A _) Q Y). intros r _ [R1 R2]. unfold sinusoid.
    specialize (rise r ltac:(lra)). nra.
Qed.
End Relay.

(** The integral of output times weight over any turn, by an antiderivative of the weight that repeats, or grows by the same in each
    turn. *)
Lemma over_a_turn (C x_a x_0 X : R) (y f A : R -> R) (growth a : R) :
  0 <= x_a -> switches C x_a x_0 X y ->
  (forall t, is_derive A t (f t)) -> (forall t, continuous f t) -> (forall t, A (t + 2 * PI) = A t + growth) ->
  let u := up x_a x_0 X in let d := down x_a x_0 X in
  is_RInt (fun t => y t * f t) a (a + 2 * PI) (C * (2 * (A d - A u) - growth)).
Proof.
  intros Hxa law HA Hf period u d. pose proof PI_RGT_0.
  assert (HX : 0 < X) by (destruct law as [_ [S|[S _]]]; [pose proof (Rabs_pos x_0); lra|exact S]).
  assert (reach : x_a + Rabs x_0 <= X) by (destruct law as [_ [S|[_ [S _]]]]; lra).
  pose proof (order x_a x_0 X) as O. fold u d in O.
  assert (fperiod : forall t, f (t + 2 * PI) = f t).
  { intros t. assert (D : is_derive (fun s => A (s + 2 * PI)) t (f (t + 2 * PI))).
    { pose proof (is_derive_comp A (fun s => s + 2 * PI) t (f (t + 2 * PI)) 1 (HA _)) as K.
      unfold scal in K; simpl in K; unfold mult in K; simpl in K. rewrite Rmult_1_l in K. apply K. auto_derive; [trivial|ring]. }
    apply (is_derive_ext _ (fun s => A s + growth) t _ period) in D. apply is_derive_unique in D. rewrite <- D.
    apply is_derive_unique. replace (f t) with (f t + 0) by ring.
    apply (is_derive_plus A (fun _ => growth) t (f t) 0); [apply HA|]. exact (is_derive_const growth t). }
  (* One value on an interval. *)
  assert (piece : forall k p q, p <= q -> (forall t, p < t < q -> y t = k) -> is_RInt (fun t => y t * f t) p q (k * (A q - A p))).
  { intros k p q pq K. apply (int_eq_inside (fun t => k * f t)); [exact pq|apply int_scal, by_antiderivative; assumption|].
    intros t T. now rewrite (K t T). }
  (* In every turn the output is the same. *)
  assert (turns : forall n : Z, switches C x_a x_0 X (fun t => y (t + IZR n * (2 * PI)))).
  { intros n. apply (switches_shift C x_a x_0 X y); [|exact law]. intros t.
    destruct (Z_le_gt_dec 0 n) as [N|N].
    - rewrite <- (sin_period t (Z.to_nat n)). f_equal. rewrite INR_IZR_INZ, Z2Nat.id by exact N. ring.
    - rewrite <- (sin_period (t + IZR n * (2 * PI)) (Z.to_nat (- n))). f_equal. rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR by lia. ring. }
  assert (hi : forall (n : Z) t, u + IZR n * (2 * PI) < t < d + IZR n * (2 * PI) -> y t = C).
  { intros n t T. replace t with (t - IZR n * (2 * PI) + IZR n * (2 * PI)) by ring.
    apply (high_between C x_a x_0 X Hxa HX reach _ (turns n)). fold u d. lra. }
  assert (lo : forall (n : Z) t, d + IZR n * (2 * PI) < t < u + 2 * PI + IZR n * (2 * PI) -> y t = - C).
  { intros n t T. replace t with (t - IZR n * (2 * PI) + IZR n * (2 * PI)) by ring.
    apply (low_between C x_a x_0 X Hxa HX reach _ (turns n)). fold u d. lra. }
  (* The turn that a lies in. *)
  destruct (archimed ((a - u) / (2 * PI))) as [Z1 Z2]. set (n := (Rdefinitions.up ((a - u) / (2 * PI)) - 1)%Z).
  assert (Ez : IZR (Rdefinitions.up ((a - u) / (2 * PI))) = IZR n + 1) by (unfold n; rewrite minus_IZR; ring).
  rewrite Ez in Z1, Z2. clear Ez.
  assert (Ea : a = u + (a - u) / (2 * PI) * (2 * PI)) by (field; lra).
  set (s := IZR n * (2 * PI)) in *.
  assert (N1 : u + s <= a < u + s + 2 * PI) by (unfold s; split; nra).
  assert (s' : IZR (n + 1) * (2 * PI) = s + 2 * PI) by (rewrite plus_IZR; unfold s; ring).
  assert (As : forall t, A (t + s + 2 * PI) = A (t + s) + growth) by (intros; apply period).
  assert (hi0 : forall t, u + s < t < d + s -> y t = C) by (intros t T; apply (hi n); fold s; lra).
  assert (lo0 : forall t, d + s < t < u + 2 * PI + s -> y t = - C) by (intros t T; apply (lo n); fold s; lra).
  assert (hi1 : forall t, u + s + 2 * PI < t < d + s + 2 * PI -> y t = C) by (intros t T; apply (hi (n + 1)%Z); rewrite s'; lra).
  assert (lo1 : forall t, d + s + 2 * PI < t < u + 2 * PI + s + 2 * PI -> y t = - C)
    by (intros t T; apply (lo (n + 1)%Z); rewrite s'; lra).
  assert (Aus : A (d + s) - A (u + s) = A d - A u).
  { assert (C0 : A (d + s) - A d = A (u + s) - A u); [|lra].
    assert (K : forall t, is_derive (fun t => A (t + s) - A t) t 0).
    { intros t. assert (D : is_derive (fun t => A (t + s)) t (f (t + s))).
      { pose proof (is_derive_comp A (fun r => r + s) t (f (t + s)) 1 (HA _)) as K.
        unfold scal in K; simpl in K; unfold mult in K; simpl in K. rewrite Rmult_1_l in K. apply K. auto_derive; [trivial|ring]. }
      assert (F : f (t + s) = f t).
      { unfold s. clear - fperiod. assert (P : forall m t, f (t + INR m * (2 * PI)) = f t).
        { induction m; intros; [simpl; f_equal; ring|]. rewrite S_INR. rewrite <- (IHm t0), <- (fperiod (t0 + INR m * (2 * PI))). f_equal. ring. }
        destruct (Z_le_gt_dec 0 n) as [N|N].
        - rewrite <- (P (Z.to_nat n) t). f_equal. rewrite INR_IZR_INZ, Z2Nat.id by exact N. ring.
        - rewrite <- (P (Z.to_nat (- n)) (t + IZR n * (2 * PI))). f_equal. rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR by lia. ring. }
      rewrite F in D. replace 0 with (f t - f t) by ring. exact (is_derive_minus _ A t _ _ D (HA t)). }
    apply (is_constant (fun t => A (t + s) - A t)); [lra|intros; apply K|intros x _; apply (continuity_of_derive _ x 0), K]. }
  destruct (Rle_lt_dec a (d + s)) as [Q|Q].
  - (* high, low, high *)
    replace (C * (2 * (A d - A u) - growth)) with
      (C * (A (d + s) - A a) + (- C * (A (u + s + 2 * PI) - A (d + s)) + C * (A (a + 2 * PI) - A (u + s + 2 * PI)))).
    + apply (int_chasles _ a (d + s)); [apply piece; [lra|intros t T; apply hi0; lra]|].
      apply (int_chasles _ (d + s) (u + s + 2 * PI)); apply piece; try lra; intros t T; [apply lo0|apply hi1]; lra.
    + rewrite (As u), (period a). rewrite <- Aus. ring.
  - (* low, high, low *)
    replace (C * (2 * (A d - A u) - growth)) with
      (- C * (A (u + s + 2 * PI) - A a) + (C * (A (d + s + 2 * PI) - A (u + s + 2 * PI)) + - C * (A (a + 2 * PI) - A (d + s + 2 * PI)))).
    + apply (int_chasles _ a (u + s + 2 * PI)); [apply piece; [lra|intros t T; apply lo0; lra]|].
      apply (int_chasles _ (u + s + 2 * PI) (d + s + 2 * PI)); apply piece; try lra; intros t T; [apply hi1|apply lo1]; lra.
    + rewrite (As u), (As d), (period a). rewrite <- Aus. ring.
Qed.
