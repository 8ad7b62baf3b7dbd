(** Outputs under a sinusoid, their integrals over a turn, and what half a turn does: shared by the claims on symmetry. *)
From Coq Require Import Reals Lra Lia ZArith Classical.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(** * The objects *)

(** A characteristic answers with one function of the input while the input grows, and with another while it falls. *)
Record characteristic := { rising : R -> R; falling : R -> R }.

(** Without memory both are one. *)
Definition static (F : R -> R) : characteristic := {| rising := F; falling := F |}.

(** The input of eq. 7: a sinusoid about a bias [B], of amplitude [X], at the angle [t]. *)
Definition sweep (B X t : R) : R := B + X * sin t.

(** The output, eq. 8. The input grows where the cosine is positive; the value at a turning point matters to no integral. *)
Definition output (c : characteristic) (B X t : R) : R :=
  if Rlt_dec 0 (cos t) then rising c (sweep B X t) else falling c (sweep B X t).

(** Y_0, Y_Pk, Y_Qk of eq. 10. *)
Definition mean (y : R -> R) : R := RInt y 0 (2 * PI) / (2 * PI).
Definition sine_part (k : nat) (y : R -> R) : R := RInt (fun t => y t * sin (INR k * t)) 0 (2 * PI) / PI.
Definition cosine_part (k : nat) (y : R -> R) : R := RInt (fun t => y t * cos (INR k * t)) 0 (2 * PI) / PI.

Definition odd (F : R -> R) : Prop := forall x, F (- x) = - F x.
Definition nondecreasing (F : R -> R) : Prop := forall a b, a <= b -> F a <= F b.

(** Branches that are each other's image under a half-turn about the origin: with memory, what [odd] is without. *)
Definition half_turn_images (c : characteristic) : Prop := forall x, falling c x = - rising c (- x).

(** * Arithmetic of integrals *)

(** [ring] where the goal's type is the carrier of a module. *)
Ltac real_ring := match goal with |- ?p = ?q => change (@eq R p q) end; ring.

Lemma sin_plus_pi t : sin (t + PI) = - sin t.
Proof. exact (neg_sin t). Qed.

Lemma cos_plus_pi t : cos (t + PI) = - cos t.
Proof. exact (neg_cos t). Qed.

Lemma sin_turn t : sin (t + 2 * PI) = sin t.
Proof. rewrite <- (sin_period t 1). f_equal. simpl. ring. Qed.

Lemma cos_turn t : cos (t + 2 * PI) = cos t.
Proof. rewrite <- (cos_period t 1). f_equal. simpl. ring. Qed.

Lemma RInt_of (f : R -> R) (a b l : R) : is_RInt f a b l -> @eq R (RInt f a b) l.
Proof. apply (is_RInt_unique (V := R_CompleteNormedModule)). Qed.

Lemma integral_of (f : R -> R) (a b : R) : ex_RInt f a b -> is_RInt f a b (RInt f a b).
Proof. apply (RInt_correct (V := R_CompleteNormedModule)). Qed.

Lemma ext (f g : R -> R) (a b l : R) : a <= b -> (forall t, a < t < b -> f t = g t) -> is_RInt f a b l -> is_RInt g a b l.
Proof.
  intros ab H. apply (is_RInt_ext (V := R_NormedModule)). intros t T. apply H. now rewrite Rmin_left, Rmax_right in T by lra.
Qed.

Lemma join (f : R -> R) (a b c l m : R) : is_RInt f a b l -> is_RInt f b c m -> is_RInt f a c (l + m).
Proof. apply (is_RInt_Chasles (V := R_NormedModule)). Qed.

Lemma add (f g : R -> R) (a b l m : R) : is_RInt f a b l -> is_RInt g a b m -> is_RInt (fun t => f t + g t) a b (l + m).
Proof. apply (is_RInt_plus (V := R_NormedModule)). Qed.

Lemma subtract (f g : R -> R) (a b l m : R) : is_RInt f a b l -> is_RInt g a b m -> is_RInt (fun t => f t - g t) a b (l - m).
Proof. apply (is_RInt_minus (V := R_NormedModule)). Qed.

Lemma negate (f : R -> R) (a b l : R) : is_RInt f a b l -> is_RInt (fun t => - f t) a b (- l).
Proof. apply (is_RInt_opp (V := R_NormedModule)). Qed.

Lemma multiply (f : R -> R) (k a b l : R) : is_RInt f a b l -> is_RInt (fun t => k * f t) a b (k * l).
Proof. apply (is_RInt_scal (V := R_NormedModule)). Qed.

Lemma constant_integral (k a b : R) : is_RInt (fun _ => k) a b ((b - a) * k).
Proof. exact (is_RInt_const (V := R_NormedModule) a b k). Qed.

(** The value of an integral may be written otherwise. *)
Lemma equal (f : R -> R) (a b l m : R) : is_RInt f a b l -> l = m -> is_RInt f a b m.
Proof. now intros H <-. Qed.

Lemma both_parts (f : R -> R) (a b c : R) : a <= b <= c -> ex_RInt f a c -> ex_RInt f a b /\ ex_RInt f b c.
Proof.
  split.
  - now apply (ex_RInt_Chasles_1 (V := R_CompleteNormedModule)) with c.
  - now apply (ex_RInt_Chasles_2 (V := R_CompleteNormedModule)) with a.
Qed.

Lemma by_antiderivative (A f : R -> R) (a b : R) :
  (forall t : R, is_derive A t (f t)) -> (forall t : R, ex_derive f t) -> is_RInt f a b (A b - A a).
Proof.
  intros HA Hf. apply (is_RInt_derive (V := R_CompleteNormedModule) A f a b); intros; [apply HA|].
  apply (ex_derive_continuous (V := R_NormedModule)), Hf.
Qed.

(** The same function later by [v]. *)
Lemma later (f : R -> R) (v a b l : R) : is_RInt f (a + v) (b + v) l -> is_RInt (fun t => f (t + v)) a b l.
Proof.
  intros H. apply (is_RInt_ext (V := R_NormedModule) (fun t => scal 1 (f (1 * t + v)))).
  - intros t _. unfold scal; simpl; unfold mult; simpl. rewrite !Rmult_1_l. reflexivity.
  - apply (is_RInt_comp_lin f 1 v a b l). now rewrite !Rmult_1_l.
Qed.

(** The same function backwards, about [v/2]. *)
Lemma backwards (f : R -> R) (v a b l : R) : is_RInt f (v - b) (v - a) l -> is_RInt (fun t => f (v - t)) a b l.
Proof.
  intros H. rewrite <- (Ropp_involutive l).
  apply (is_RInt_ext (V := R_NormedModule) (fun t => opp (scal (-1) (f (-1 * t + v))))).
  - intros t _. unfold opp, scal; simpl; unfold mult; simpl. replace (-1 * t + v) with (v - t) by ring. real_ring.
  - apply (is_RInt_opp (V := R_NormedModule)), (is_RInt_comp_lin f (-1) v a b).
    replace (-1 * a + v) with (v - a) by ring. replace (-1 * b + v) with (v - b) by ring.
    now apply (is_RInt_swap (V := R_NormedModule)).
Qed.

(** * Positive integrals *)

Lemma not_negative (f : R -> R) (a b l : R) : a <= b -> is_RInt f a b l -> (forall t, a < t < b -> 0 <= f t) -> 0 <= l.
Proof.
  intros ab H P. rewrite <- (RInt_of _ _ _ _ H). apply RInt_ge_0; [exact ab|now exists l|exact P].
Qed.

(** Nowhere negative, and no less than [eps] on a part. *)
Lemma positive (f : R -> R) (a c d b eps l : R) :
  a <= c -> c < d -> d <= b -> 0 < eps -> is_RInt f a b l ->
  (forall t, a < t < b -> 0 <= f t) -> (forall t, c < t < d -> eps <= f t) -> 0 < l.
Proof.
  intros ac cd db He Hf H0 H1.
  destruct (both_parts f a c b) as [E1 E2]; [lra|now exists l|].
  destruct (both_parts f c d b) as [E3 E4]; [lra|exact E2|].
  apply integral_of in E1, E3, E4.
  assert (L : l = RInt f a c + (RInt f c d + RInt f d b)).
  { rewrite <- (RInt_of _ _ _ _ Hf). apply RInt_of. exact (join _ _ _ _ _ _ E1 (join _ _ _ _ _ _ E3 E4)). }
  assert (0 <= RInt f a c) by (apply (not_negative f a c); auto; intros; apply H0; lra).
  assert (0 <= RInt f d b) by (apply (not_negative f d b); auto; intros; apply H0; lra).
  assert (0 <= RInt f c d - (d - c) * eps).
  { apply (not_negative (fun t => f t - eps) c d); [lra|apply subtract; [exact E3|apply constant_integral]|].
    intros t T. specialize (H1 t T). lra. }
  assert (0 < (d - c) * eps) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(** A positive integral needs an interval on which the function stays above a positive number: of a function that has an
    integral this is what "on a set of positive measure" says. Else tags could be chosen where it does not. *)
Lemma low_tags (f : R -> R) (e h : R) : 0 < h -> forall (n : nat) (x : R),
  (forall i, (i < n)%nat -> exists t, x + INR i * h < t < x + INR (S i) * h /\ f t < e) ->
  exists s : SF_seq, SF_h s = x /\ seq.last (SF_h s) (SF_lx s) = x + INR n * h /\ pointed_subdiv s /\
    seq_step (SF_lx s) <= h /\ Riemann_sum f s <= e * (INR n * h).
Proof.
  intros Hh. induction n as [|n IH]; intros x low.
  - exists (SF_nil x). split; [reflexivity|]. split; [simpl; ring|]. split; [intros i Hi; unfold SF_size in Hi; simpl in Hi; lia|].
    split; [unfold seq_step; simpl; lra|]. unfold Riemann_sum; simpl. unfold zero; simpl. lra.
  - destruct (low O) as [t [T Ft]]; [lia|]. destruct (IH (x + h)) as [s [S1 [S2 [S3 [S4 S5]]]]].
    { intros i Hi. destruct (low (S i)) as [u [U Fu]]; [lia|]. exists u. rewrite !S_INR in *. split; [lra|exact Fu]. }
    simpl in T. exists (SF_cons (x, t) s). split; [reflexivity|]. split; [|split; [|split]].
    + rewrite S_INR. transitivity (x + h + INR n * h); [exact S2|ring].
    + intros [|i] Hi; simpl; [rewrite S1; lra|]. apply S3. rewrite SF_size_cons in Hi. lia.
    + change (Rmax (Rabs (SF_h s - x)) (seq_step (SF_lx s)) <= h). rewrite S1.
      apply Rmax_lub; [|exact S4]. rewrite Rabs_right; lra.
    + rewrite Riemann_sum_cons. rewrite S1, S_INR. change ((x + h - x) * f t + Riemann_sum f s <= e * ((INR n + 1) * h)). nra.
Qed.

Lemma positive_somewhere (f : R -> R) (a b l : R) : a < b -> is_RInt f a b l -> 0 < l ->
  exists e c d, 0 < e /\ a <= c /\ c < d /\ d <= b /\ forall t, c < t < d -> e <= f t.
Proof.
  intros ab I Hl. set (e := l / (2 * (b - a))).
  assert (He : 0 < e) by (apply Rdiv_lt_0_compat; lra).
  destruct (classic (exists c d, a <= c /\ c < d /\ d <= b /\ forall t, c < t < d -> e <= f t)) as [[c [d H]]|N].
  { exists e, c, d. tauto. }
  exfalso.
  assert (low : forall c d, a <= c -> c < d -> d <= b -> exists t, c < t < d /\ f t < e).
  { intros c d ac cd db. destruct (classic (exists t, c < t < d /\ f t < e)) as [|M]; [assumption|]. destruct N.
    exists c, d. repeat split; trivial. intros t T. destruct (Rle_dec e (f t)) as [|L]; [assumption|]. destruct M. exists t. lra. }
  assert (Hl2 : 0 < l / 2) by lra.
  destruct (I (fun y => Rabs (y - l) < l / 2)) as [delta fine].
  { exists (mkposreal _ Hl2). intros y Hy. exact Hy. }
  destruct (archimed ((b - a) / delta)) as [A _]. set (n := Z.to_nat (up ((b - a) / delta))). pose proof (cond_pos delta) as Hd.
  assert (P : 0 < (b - a) / delta) by (apply Rdiv_lt_0_compat; lra).
  assert (Hn : (b - a) / delta < INR n) by (unfold n; rewrite INR_IZR_INZ, Z2Nat.id; [exact A|apply le_IZR; lra]).
  set (h := (b - a) / INR n). assert (Eh : INR n * h = b - a) by (unfold h; field; lra).
  assert (Hh : 0 < h) by (apply Rdiv_lt_0_compat; lra).
  assert (hd : h < delta).
  { apply (Rmult_lt_reg_l (INR n)); [lra|]. rewrite Eh. apply (Rmult_lt_compat_r delta) in Hn; [|lra].
    replace ((b - a) / delta * delta) with (b - a) in Hn by (field; lra). lra. }
  destruct (low_tags f e h Hh n a) as [s [S1 [S2 [S3 [S4 S5]]]]].
  { intros i Hi. assert (INR (S i) <= INR n) by (apply le_INR; lia). pose proof (pos_INR i). rewrite S_INR in *. apply low; nra. }
  assert (whole : pointed_subdiv s /\ SF_h s = Rmin a b /\ seq.last (SF_h s) (SF_lx s) = Rmax a b).
  { rewrite Rmin_left, Rmax_right by lra. split; [exact S3|split; [exact S1|rewrite S2; lra]]. }
  assert (near : Rabs (sign (b - a) * Riemann_sum f s - l) < l / 2) by (apply fine; [lra|exact whole]).
  rewrite sign_eq_1, Rmult_1_l in near by lra. apply Rabs_def2 in near. rewrite Eh in S5.
  assert (e * (b - a) = l / 2) by (unfold e; field; lra). lra.
Qed.

(** * A nondecreasing function has an integral *)

(** What is true from somewhere on. *)
Lemma indicator_integral (f : R -> R) (y a b : R) : a <= b ->
  (forall s t, a <= s -> s <= t -> t <= b -> f s <= f t) -> ex_RInt (fun t => if Rle_dec y (f t) then 1 else 0) a b.
Proof.
  intros ab mono.
  set (S := fun t => t = a \/ (a <= t <= b /\ f t < y)).
  destruct (completeness S) as [c [upper least]].
  - exists b. intros t [->|[T _]]; lra.
  - exists a. now left.
  - assert (a <= c) by (apply upper; now left).
    assert (c <= b) by (apply least; intros t [->|[T _]]; lra).
    exists ((c - a) * 0 + (b - c) * 1). apply join with c.
    + apply (ext (fun _ => 0)); [lra| |apply constant_integral].
      intros t T. destruct (Rle_dec y (f t)) as [Y|_]; [exfalso|reflexivity].
      assert (c <= t); [|lra]. apply least. intros s [->|[T' L]]; [lra|].
      destruct (Rle_dec s t) as [|N]; [assumption|]. assert (f t <= f s) by (apply mono; lra). lra.
    + apply (ext (fun _ => 1)); [lra| |apply constant_integral].
      intros t T. destruct (Rle_dec y (f t)) as [_|N]; [reflexivity|exfalso].
      assert (t <= c) by (apply upper; right; lra). lra.
Qed.

(** A stair of [n] treads of height [d] under [v]. *)
Fixpoint stair (d v : R) (n : nat) : R :=
  match n with O => 0 | S k => stair d v k + d * (if Rle_dec (INR (S k) * d) v then 1 else 0) end.

Lemma stair_full d v n : 0 <= d -> INR n * d <= v -> stair d v n = INR n * d.
Proof.
  intros Hd. induction n as [|n IH]; intros H; [simpl; ring|].
  cbn [stair]. destruct (Rle_dec (INR (S n) * d) v); [|lra]. rewrite S_INR in *. rewrite IH by lra. ring.
Qed.

Lemma stair_near d v n : 0 <= d -> 0 <= v -> v <= INR (S n) * d -> stair d v n <= v <= stair d v n + d.
Proof.
  intros Hd Hv. induction n as [|n IH]; intros H; [simpl in *; lra|].
  cbn [stair]. destruct (Rle_dec (INR (S n) * d) v) as [L|L].
  - rewrite stair_full by (auto; rewrite S_INR in L; lra). rewrite !S_INR in *. lra.
  - lra.
Qed.

Theorem nondecreasing_integral (f : R -> R) (a b : R) : a <= b ->
  (forall s t, a <= s -> s <= t -> t <= b -> f s <= f t) -> ex_RInt f a b.
Proof.
  intros ab mono.
  set (hold := fun t => Rmax a (Rmin t b)).
  assert (held : forall t, a <= hold t <= b).
  { intros t. unfold hold. split; [apply Rmax_l|]. apply Rmax_lub; [lra|apply Rmin_r]. }
  set (g := fun t => f (hold t)). set (h := f b - f a).
  assert (Hh : 0 <= h) by (unfold h; assert (f a <= f b) by (apply mono; lra); lra).
  assert (Hg : forall t, 0 <= g t - f a <= h).
  { intros t. unfold g, h. destruct (held t). assert (f a <= f (hold t)) by (apply mono; lra).
    assert (f (hold t) <= f b) by (apply mono; lra). lra. }
  set (d := fun n => (h + 1) / INR (S n)).
  assert (Hd : forall n, 0 < d n) by (intros n; apply Rdiv_lt_0_compat; [lra|apply lt_0_INR; lia]).
  set (step := fun n t => f a + stair (d n) (g t - f a) n).
  assert (near : forall n t, step n t <= g t <= step n t + d n).
  { intros n t. unfold step. pose proof (Hg t). pose proof (Hd n).
    assert (INR (S n) * d n = h + 1) by (unfold d; field; apply Rgt_not_eq, lt_0_INR; lia).
    pose proof (stair_near (d n) (g t - f a) n). lra. }
  assert (each : forall n, ex_RInt (step n) a b).
  { intros n. unfold step. generalize (d n). intros e.
    assert (E : ex_RInt (fun t => stair e (g t - f a) n) a b).
    { induction n as [|n IH]; [exists ((b - a) * 0); apply constant_integral|].
      assert (I : ex_RInt (fun t => if Rle_dec (INR (S n) * e) (g t - f a) then 1 else 0) a b).
      { apply (indicator_integral (fun t => g t - f a)); [exact ab|]. intros s t S0 ST T0.
        assert (g s <= g t); [|lra]. unfold g, hold. apply mono; try apply held.
        now apply Rle_max_compat_l, Rle_min_compat_r. }
      destruct IH as [l L], I as [m M]. exists (l + e * m). exact (add _ _ _ _ _ _ L (multiply _ e _ _ _ M)). }
    destruct E as [l L]. exists ((b - a) * f a + l). exact (add _ _ _ _ _ _ (constant_integral (f a) a b) L). }
  destruct (filterlim_RInt (V := R_CompleteNormedModule) step a b eventually _ g (fun n => RInt (step n) a b)) as [l [_ L]].
  - intros n. apply integral_of, each.
  - apply filterlim_locally. intros eps.
    destruct (archimed ((h + 1) / eps)) as [A _]. set (N := Z.to_nat (up ((h + 1) / eps))).
    assert (P : 0 < (h + 1) / eps) by (apply Rdiv_lt_0_compat; [lra|apply cond_pos]).
    exists N. intros n Hn t. change (Rabs (step n t - g t) < eps).
    assert (Hn0 : 0 < INR (S n)) by (apply lt_0_INR; lia). pose proof (cond_pos eps) as He.
    assert (d n < eps).
    { unfold d. apply (Rmult_lt_reg_r (INR (S n) / eps)); [now apply Rdiv_lt_0_compat|].
      replace ((h + 1) / INR (S n) * (INR (S n) / eps)) with ((h + 1) / eps) by (field; lra).
      replace (eps * (INR (S n) / eps)) with (INR (S n)) by (field; lra).
      apply Rlt_trans with (INR N); [|apply lt_INR; lia].
      unfold N. rewrite INR_IZR_INZ, Z2Nat.id; [exact A|]. apply le_IZR. lra. }
    pose proof (near n t). apply Rabs_def1; lra.
  - exists l. apply (ext g); [exact ab| |exact L]. intros t T. unfold g, hold.
    rewrite Rmin_left, Rmax_right by lra. reflexivity.
Qed.

(** On the rising half of a sweep. *)
Lemma sin_rises s t : - (PI / 2) <= s -> s <= t -> t <= PI / 2 -> sin s <= sin t.
Proof. intros. apply sin_incr_1; lra. Qed.

Corollary nondecreasing_on_sweep (F : R -> R) (B X : R) : 0 <= X -> nondecreasing F ->
  ex_RInt (fun t => F (sweep B X t)) (- (PI / 2)) (PI / 2).
Proof.
  intros HX mono. pose proof PI_RGT_0. apply nondecreasing_integral; [lra|].
  intros s t S0 ST T0. apply mono. unfold sweep. apply Rplus_le_compat_l, Rmult_le_compat_l; [exact HX|].
  now apply sin_rises.
Qed.

(** * Over a turn, by branches *)

(** Any turn of a periodic function. *)
Lemma whole_turn (y : R -> R) (l : R) : (forall t, y (t + 2 * PI) = y t) ->
  is_RInt y (- (PI / 2)) (PI / 2 + PI) l -> is_RInt y 0 (2 * PI) l.
Proof.
  intros period H. pose proof PI_RGT_0.
  destruct (both_parts y (- (PI / 2)) 0 (PI / 2 + PI)) as [E1 E2]; [lra|now exists l|]. apply integral_of in E1, E2.
  assert (L : l = RInt y 0 (PI / 2 + PI) + RInt y (- (PI / 2)) 0).
  { rewrite <- (RInt_of _ _ _ _ H), (RInt_of _ _ _ _ (join _ _ _ _ _ _ E1 E2)). ring. }
  rewrite L. apply join with (PI / 2 + PI); [exact E2|].
  apply (ext (fun t => y (t + - (2 * PI)))); [lra| |].
  - intros t _. rewrite <- (period (t + - (2 * PI))). f_equal. ring.
  - apply (later y (- (2 * PI))). replace (PI / 2 + PI + - (2 * PI)) with (- (PI / 2)) by field.
    replace (2 * PI + - (2 * PI)) with 0 by ring. exact E1.
Qed.

Lemma whole_turn_back (y : R -> R) : (forall t, y (t + 2 * PI) = y t) ->
  ex_RInt y 0 (2 * PI) -> ex_RInt y (- (PI / 2)) (PI / 2 + PI).
Proof.
  intros period H. pose proof PI_RGT_0.
  destruct (both_parts y 0 (PI / 2 + PI) (2 * PI)) as [E1 E2]; [lra|exact H|]. apply integral_of in E1, E2.
  eexists. apply join with 0; [|exact E1].
  apply (ext (fun t => y (t + 2 * PI))); [lra|intros t _; apply period|]. apply later.
  replace (- (PI / 2) + 2 * PI) with (PI / 2 + PI) by field. rewrite Rplus_0_l. exact E2.
Qed.

Lemma output_static F B X t : output (static F) B X t = F (sweep B X t).
Proof. unfold output. simpl. now destruct (Rlt_dec 0 (cos t)). Qed.

Lemma output_period c B X t : output c B X (t + 2 * PI) = output c B X t.
Proof. unfold output, sweep. now rewrite sin_turn, cos_turn. Qed.

Lemma output_rising c B X t : - (PI / 2) < t < PI / 2 -> output c B X t = rising c (sweep B X t).
Proof. intros T. unfold output. destruct (Rlt_dec 0 (cos t)) as [|N]; [reflexivity|]. destruct N. apply cos_gt_0; lra. Qed.

Lemma output_falling c B X t : PI / 2 < t < PI / 2 + PI -> output c B X t = falling c (sweep B X t).
Proof.
  intros T. unfold output. destruct (Rlt_dec 0 (cos t)) as [P|]; [|reflexivity].
  assert (cos t < 0) by (apply cos_lt_0; lra). lra.
Qed.

(** The input comes back on the falling branch as it went on the rising one. *)
Lemma sweep_back B X t : sweep B X (PI - t) = sweep B X t.
Proof. unfold sweep. f_equal. f_equal. replace (PI - t) with (- (t - PI)) by ring. rewrite sin_neg. rewrite <- sin_plus_pi. f_equal. ring. Qed.

(** Both branches over the rising half: what is left of a claim on integrals over a turn. *)
Theorem by_branches c B X (w : R -> R) (r f : R) : (forall t, w (t + 2 * PI) = w t) ->
  is_RInt (fun t => rising c (sweep B X t) * w t) (- (PI / 2)) (PI / 2) r ->
  is_RInt (fun t => falling c (sweep B X t) * w (PI - t)) (- (PI / 2)) (PI / 2) f ->
  is_RInt (fun t => output c B X t * w t) 0 (2 * PI) (r + f).
Proof.
  intros period Hr Hf. pose proof PI_RGT_0.
  apply whole_turn; [intros t; now rewrite output_period, period|].
  apply join with (PI / 2).
  - apply (ext (fun t => rising c (sweep B X t) * w t)); [lra| |exact Hr].
    intros t T. now rewrite output_rising by lra.
  - apply (ext (fun t => falling c (sweep B X (PI - t)) * w (PI - (PI - t)))); [lra| |].
    + intros t T. rewrite output_falling, sweep_back by lra. do 2 f_equal. ring.
    + apply (backwards (fun t => falling c (sweep B X t) * w (PI - t)) PI).
      replace (PI - (PI / 2 + PI)) with (- (PI / 2)) by field. replace (PI - PI / 2) with (PI / 2) by field. exact Hf.
Qed.

Theorem by_branches_back c B X (w : R -> R) : (forall t, w (t + 2 * PI) = w t) ->
  ex_RInt (fun t => output c B X t * w t) 0 (2 * PI) ->
  ex_RInt (fun t => rising c (sweep B X t) * w t) (- (PI / 2)) (PI / 2) /\
  ex_RInt (fun t => falling c (sweep B X t) * w (PI - t)) (- (PI / 2)) (PI / 2).
Proof.
  intros period H. pose proof PI_RGT_0.
  apply whole_turn_back in H; [|intros t; now rewrite output_period, period].
  destruct (both_parts _ (- (PI / 2)) (PI / 2) (PI / 2 + PI) ltac:(lra) H) as [[r Hr] [f Hf]]. split.
  - exists r. apply (ext (fun t => output c B X t * w t)); [lra| |exact Hr]. intros t T. now rewrite output_rising by lra.
  - exists f. apply (ext (fun t => output c B X (PI - t) * w (PI - t))); [lra| |].
    + intros t T. now rewrite output_falling, sweep_back by lra.
    + apply (backwards (fun t => output c B X t * w t) PI).
      replace (PI - - (PI / 2)) with (PI / 2 + PI) by field. replace (PI - PI / 2) with (PI / 2) by field. exact Hf.
Qed.

(** The mean output is that of both branches. *)
Corollary mean_by_branches c B X (r f : R) :
  is_RInt (fun t => rising c (sweep B X t)) (- (PI / 2)) (PI / 2) r ->
  is_RInt (fun t => falling c (sweep B X t)) (- (PI / 2)) (PI / 2) f ->
  is_RInt (output c B X) 0 (2 * PI) (r + f).
Proof.
  intros Hr Hf. pose proof PI_RGT_0.
  apply (ext (fun t => output c B X t * 1)); [lra|intros; ring|].
  apply by_branches; [reflexivity| |].
  - apply (ext (fun t => rising c (sweep B X t))); [lra|intros; ring|exact Hr].
  - apply (ext (fun t => falling c (sweep B X t))); [lra|intros; ring|exact Hf].
Qed.

(** * What half a turn does *)

(** Half a period of any length: what changes its sign over it has the mean zero. *)
Lemma half_period_cancels (y : R -> R) (h : R) : 0 <= h -> (forall t, y (t + h) = - y t) -> ex_RInt y 0 h -> is_RInt y 0 (2 * h) 0.
Proof.
  intros Hh flip [l Hl]. apply (equal _ _ _ (l + - l)); [|ring]. apply join with h; [exact Hl|].
  apply (ext (fun t => - y (t + - h))); [lra| |].
  - intros t _. rewrite <- flip. f_equal. ring.
  - apply negate, later. replace (h + - h) with 0 by ring. replace (2 * h + - h) with h by ring. exact Hl.
Qed.

Lemma sin_even k t : sin (INR (2 * k) * (t + PI)) = sin (INR (2 * k) * t).
Proof.
  rewrite mult_INR. simpl (INR 2). rewrite <- (sin_period ((1 + 1) * INR k * t) k). f_equal. ring.
Qed.

Lemma cos_even k t : cos (INR (2 * k) * (t + PI)) = cos (INR (2 * k) * t).
Proof.
  rewrite mult_INR. simpl (INR 2). rewrite <- (cos_period ((1 + 1) * INR k * t) k). f_equal. ring.
Qed.

(** A half-turn image on the falling branch undoes the rising one, under every weight that half a turn leaves alone. *)
Theorem half_turn_images_cancel c X (w : R -> R) : half_turn_images c -> (forall t, w (t + PI) = w t) ->
  ex_RInt (fun t => output c 0 X t * w t) 0 (2 * PI) -> is_RInt (fun t => output c 0 X t * w t) 0 (2 * PI) 0.
Proof.
  intros image half E. pose proof PI_RGT_0.
  assert (whole : forall t, w (t + 2 * PI) = w t) by (intros t; rewrite <- (half t), <- (half (t + PI)); f_equal; ring).
  destruct (by_branches_back c 0 X w whole E) as [Er _]. apply integral_of in Er.
  set (r := RInt (fun t => rising c (sweep 0 X t) * w t) (- (PI / 2)) (PI / 2)) in *.
  apply (equal _ _ _ (r + - r)); [|ring]. apply by_branches; [exact whole|exact Er|].
  apply (ext (fun t => - (rising c (sweep 0 X (0 - t)) * w (0 - t)))); [lra| |].
  - intros t _. rewrite image. rewrite <- (half (0 - t)). replace (0 - t + PI) with (PI - t) by ring.
    replace (sweep 0 X (0 - t)) with (- sweep 0 X t); [ring|]. unfold sweep. rewrite Rminus_0_l, sin_neg. ring.
  - apply negate, (backwards (fun t => rising c (sweep 0 X t) * w t)).
    replace (0 - PI / 2) with (- (PI / 2)) by ring. replace (0 - - (PI / 2)) with (PI / 2) by ring. exact Er.
Qed.

Lemma odd_is_its_image F : odd F -> half_turn_images (static F).
Proof. intros H x. simpl. rewrite H. ring. Qed.

(** * Any period *)

Lemma shift_by_periods (u : R -> R) (T : R) : (forall t, u (t + T) = u t) -> forall (k : Z) t, u (t + IZR k * T) = u t.
Proof.
  intros Ru.
  assert (N : forall (n : nat) t, u (t + INR n * T) = u t).
  { induction n as [|n IH]; intros t; [f_equal; simpl; ring|]. rewrite S_INR. replace (t + (INR n + 1) * T) with (t + INR n * T + T) by ring.
    rewrite Ru. apply IH. }
  intros k t. destruct (Z_le_gt_dec 0 k) as [L|L].
  - rewrite <- (N (Z.to_nat k) t). rewrite INR_IZR_INZ, Z2Nat.id by exact L. reflexivity.
  - rewrite <- (N (Z.to_nat (- k)) (t + IZR k * T)). rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR by lia. f_equal. ring.
Qed.

(** Every time is some periods after one within the first. *)
Lemma within_a_period (T t : R) : 0 < T -> exists (k : Z) s, 0 <= s < T /\ t = s + IZR k * T.
Proof.
  intros HT. destruct (base_Int_part (t / T)) as [L1 L2]. exists (Int_part (t / T)), (t - IZR (Int_part (t / T)) * T).
  assert (E : t = t / T * T) by (field; lra). set (ratio := t / T) in *. split; [|ring]. split; nra.
Qed.

(** A periodic function has the same integral over every period. *)
Theorem any_period (y : R -> R) (T a l : R) : 0 < T -> (forall t, y (t + T) = y t) -> is_RInt y 0 T l -> is_RInt y a (a + T) l.
Proof.
  intros HT period I. destruct (within_a_period T a HT) as [k [s [Hs ->]]].
  assert (J : is_RInt y s (s + T) l).
  { destruct (both_parts y 0 s T ltac:(lra) (ex_intro _ l I)) as [E1 E2]. apply integral_of in E1, E2.
    apply (equal _ _ _ (RInt y s T + RInt y 0 s)).
    - apply join with T; [exact E2|]. apply (ext (fun t => y (t + - T))); [lra| |].
      + intros t _. rewrite <- (period (t + - T)). f_equal. ring.
      + apply (later y (- T)). replace (T + - T) with 0 by ring. replace (s + T + - T) with s by ring. exact E1.
    - rewrite <- (RInt_of _ _ _ _ I). rewrite Rplus_comm. symmetry. apply RInt_of. now apply join with s. }
  apply (ext (fun t => y (t + - IZR k * T))); [lra| |].
  - intros t _. rewrite <- (shift_by_periods y T period k). f_equal. ring.
  - apply (later y (- IZR k * T)). replace (s + IZR k * T + - IZR k * T) with s by ring.
    replace (s + IZR k * T + T + - IZR k * T) with (s + T) by ring. exact J.
Qed.
