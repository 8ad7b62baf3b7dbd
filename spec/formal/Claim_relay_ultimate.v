(** claim: relay-ultimate (of this project)
    The process [k exp(-s L)/s] under an ideal relay oscillates with the period [4 L], which is its ultimate period, and the gain
    [4 C/(pi X_m)] that the describing function gives is [8/pi^2 = 0.81] of its ultimate gain [pi/(2 k L)]. *)
From Coq Require Import Reals Lra Lia Psatz ZArith.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Switching Joints.
Open Scope R_scope.

(** The loop: [y' = k u(t - L)] wherever the command stays, y without jumps; the relay, without hysteresis, says C below zero and
    [-C] above (at zero either). *)
Record loop (k L C : R) (y u : R -> R) : Prop := {
  no_jump : forall t, continuous y t;
  integrates : forall t, locally t (fun s => u (s - L) = u (t - L)) -> is_derive y t (k * u (t - L));
  below : forall t, y t < 0 -> u t = C;
  above : forall t, 0 < y t -> u t = - C }.

(** One half: up for a dead time, down for another. *)
Definition tent (k L C s : R) : R := if Rle_dec s L then k * C * s else k * C * (2 * L - s).

Definition X_m (k L C : R) : R := k * C * L.
Definition period (L : R) : R := 4 * L.
Definition gain_of_describing_function (C X : R) : R := 4 * C / (PI * X).
Definition ultimate_gain (k L : R) : R := PI / (2 * k * L).

(** The process at the frequency w: [k exp(-j w L)/(j w)]. *)
Definition response_re (k L w : R) : R := - (k / w * sin (w * L)).
Definition response_im (k L w : R) : R := - (k / w * cos (w * L)).

Section Loop.
Variables k L C : R.
Hypotheses (Hk : 0 < k) (HL : 0 < L) (HC : 0 < C).

Lemma tent_positive s : 0 < s < 2 * L -> 0 < tent k L C s.
Proof. intros H. unfold tent. destruct (Rle_dec s L); apply Rmult_lt_0_compat; nra. Qed.

(** Where the command was w all along, y goes straight. *)
Lemma straight y u a b w : loop k L C y u -> a <= b -> (forall t, a < t < b -> u (t - L) = w) -> y b = y a + k * w * (b - a).
Proof.
  intros [J I _ _] ab U. assert (E : y b - k * w * b = y a - k * w * a).
  { apply (is_constant (fun t => y t - k * w * t)); [exact ab|intros t Ht|intros t Ht].
    - assert (Lo : locally t (fun s => u (s - L) = u (t - L))).
      { assert (P : 0 < Rmin (t - a) (b - t)) by (apply Rmin_pos; lra). exists (mkposreal _ P). intros s Hs.
        change (Rabs (s - t) < Rmin (t - a) (b - t)) in Hs. apply Rabs_def2 in Hs.
        pose proof (Rmin_l (t - a) (b - t)). pose proof (Rmin_r (t - a) (b - t)). rewrite !U by lra. reflexivity. }
      pose proof (I t Lo) as D. rewrite (U t Ht) in D.
      assert (Dl : is_derive (fun t => k * w * t) t (k * w)) by (auto_derive; [trivial|ring]).
      pose proof (is_derive_minus y (fun t => k * w * t) t _ _ D Dl) as M. revert M. unfold minus, plus, opp; simpl. intros M.
      match type of M with is_derive _ _ ?l => replace l with 0 in M by ring end. exact M.
    - apply (continuity_pt_minus y (fun t => k * w * t)); [apply continuity_of_continuous, J|].
      apply (continuity_of_derive _ t (k * w)). auto_derive; [trivial|ring]. }
  lra.
Qed.

(** After a dead time below zero: a tent, and then a dead time above zero. *)
Lemma one_tent y u b : loop k L C y u -> y b = 0 -> (forall t, b - L < t < b -> y t < 0) ->
  (forall s, 0 <= s <= 2 * L -> y (b + s) = tent k L C s).
Proof.
  intros M Yb Before. pose proof M as [J I B A].
  assert (U1 : forall s, 0 <= s <= L -> y (b + s) = k * C * s).
  { intros s Hs. rewrite (straight y u b (b + s) C M) by (try lra; intros t Ht; apply B, Before; lra). rewrite Yb. ring. }
  intros s Hs. unfold tent. destruct (Rle_dec s L) as [Q|Q]; [apply U1; lra|].
  rewrite (straight y u (b + L) (b + s) (- C) M).
  - rewrite U1 by lra. ring.
  - lra.
  - intros t Ht. apply A. replace (t - L) with (b + (t - L - b)) by ring. rewrite U1 by lra. apply Rmult_lt_0_compat; nra.
Qed.

Lemma mirrored y u : loop k L C y u -> loop k L C (fun t => - y t) (fun t => - u t).
Proof.
  intros [J I B A]. split.
  - intros t. apply (continuous_opp (K := R_AbsRing) y), J.
  - intros t Lo. assert (Lo' : locally t (fun s => u (s - L) = u (t - L))) by (revert Lo; apply filter_imp; intros s; lra).
    replace (k * - u (t - L)) with (opp (k * u (t - L))) by (unfold opp; simpl; ring). apply (is_derive_opp (K := R_AbsRing) y), I, Lo'.
  - intros t H. rewrite A by lra. ring.
  - intros t H. rewrite B by lra. reflexivity.
Qed.

(** One tent after the other, with either sign in turn. *)
Lemma tents n : forall y u b, loop k L C y u -> y b = 0 -> (forall t, b - L < t < b -> y t < 0) ->
  forall s, 0 <= s <= 2 * L -> y (b + INR n * (2 * L) + s) = (-1) ^ n * tent k L C s.
Proof.
  induction n as [|n IH]; intros y u b M Yb Before s Hs.
  - simpl. rewrite Rmult_0_l, Rplus_0_r, Rmult_1_l. exact (one_tent y u b M Yb Before s Hs).
  - pose proof (one_tent y u b M Yb Before) as T.
    assert (E : - y (b + 2 * L) = 0) by (rewrite T by lra; unfold tent; destruct (Rle_dec (2 * L) L); [lra|ring]).
    assert (Be : forall t, b + 2 * L - L < t < b + 2 * L -> - y t < 0).
    { intros t Ht. replace t with (b + (t - b)) by ring. rewrite T by lra. pose proof (tent_positive (t - b)). lra. }
    specialize (IH _ _ (b + 2 * L) (mirrored y u M) E Be s Hs). cbv beta in IH. rewrite S_INR.
    replace (b + (INR n + 1) * (2 * L) + s) with (b + 2 * L + INR n * (2 * L) + s) by ring. simpl. lra.
Qed.
End Loop.

(** * The triangle is such a motion *)

Section Triangle.
Variables k L C : R.
Hypotheses (Hk : 0 < k) (HL : 0 < L) (HC : 0 < C).

Definition within (t : R) : R := t - IZR (Int_part (t / (4 * L))) * (4 * L).
Definition triangle (t : R) : R := let s := within t in k * C * (if Rle_dec s L then s else if Rle_dec s (3 * L) then 2 * L - s else s - 4 * L).
Definition command (t : R) : R := if Rlt_dec (triangle t) 0 then C else - C.

Lemma within_is n t : IZR n * (4 * L) <= t < (IZR n + 1) * (4 * L) -> within t = t - IZR n * (4 * L).
Proof.
  intros Ht. unfold within. assert (E : t = t / (4 * L) * (4 * L)) by (field; lra). destruct (base_Int_part (t / (4 * L))) as [I1 I2].
  assert (L1 : IZR n <= t / (4 * L)) by (apply (Rmult_le_reg_r (4 * L)); lra).
  assert (L2 : t / (4 * L) < IZR n + 1) by (apply (Rmult_lt_reg_r (4 * L)); lra).
  assert (Int_part (t / (4 * L)) < n + 1)%Z by (apply lt_IZR; rewrite plus_IZR; lra).
  assert (n < Int_part (t / (4 * L)) + 1)%Z by (apply lt_IZR; rewrite plus_IZR; lra).
  replace (Int_part (t / (4 * L))) with n by lia. reflexivity.
Qed.

Lemma rising n t : IZR n * (4 * L) - L <= t <= IZR n * (4 * L) + L -> triangle t = k * C * (t - IZR n * (4 * L)).
Proof.
  intros Ht. unfold triangle. destruct (Rlt_le_dec t (IZR n * (4 * L))) as [Q|Q].
  - rewrite (within_is (n - 1) t) by (rewrite minus_IZR; lra). rewrite minus_IZR. f_equal.
    destruct (Rle_dec _ L); [lra|]. destruct (Rle_dec _ (3 * L)); lra.
  - rewrite (within_is n t) by lra. f_equal. destruct (Rle_dec _ L); lra.
Qed.

Lemma falling n t : IZR n * (4 * L) + L <= t <= IZR n * (4 * L) + 3 * L -> triangle t = k * C * (IZR n * (4 * L) + 2 * L - t).
Proof. intros Ht. unfold triangle. rewrite (within_is n t) by lra. f_equal. destruct (Rle_dec _ L); [lra|]. destruct (Rle_dec _ (3 * L)); lra. Qed.

Lemma everywhere t : exists n, IZR n * (4 * L) - L < t < IZR n * (4 * L) + L \/ t = IZR n * (4 * L) + L \/
  IZR n * (4 * L) + L < t < IZR n * (4 * L) + 3 * L \/ t = IZR n * (4 * L) - L.
Proof.
  destruct (base_Int_part ((t + L) / (4 * L))) as [I1 I2]. exists (Int_part ((t + L) / (4 * L))). set (n := Int_part ((t + L) / (4 * L))) in *.
  assert (E : t + L = (t + L) / (4 * L) * (4 * L)) by (field; lra).
  assert (A : IZR n * (4 * L) <= t + L) by (rewrite E; apply Rmult_le_compat_r; lra).
  assert (B : t + L < (IZR n + 1) * (4 * L)) by (rewrite E at 1; apply Rmult_lt_compat_r; lra).
  destruct A as [A|A]; [|right; right; right; lra].
  destruct (Rtotal_order t (IZR n * (4 * L) + L)) as [Q|[Q|Q]]; [left; lra|right; left; exact Q|right; right; left; lra].
Qed.

Lemma K_positive : 0 < k * C.
Proof. apply Rmult_lt_0_compat; assumption. Qed.

(** A dead time after the corner the command is the one of the other side. *)
Lemma command_late n t : (IZR n * (4 * L) - L < t < IZR n * (4 * L) + L -> command (t - L) = C) /\
  (IZR n * (4 * L) + L <= t <= IZR n * (4 * L) + 3 * L -> command (t - L) = - C).
Proof.
  pose proof K_positive as K. unfold command. split; intros Ht.
  - assert (N : triangle (t - L) < 0).
    { destruct (Rle_lt_dec (IZR n * (4 * L) - L) (t - L)) as [Q|Q].
      - rewrite (rising n) by lra. nra.
      - rewrite (falling (n - 1)) by (rewrite minus_IZR; lra). rewrite minus_IZR. nra. }
    destruct (Rlt_dec _ _); [reflexivity|contradiction].
  - assert (N : 0 <= triangle (t - L)).
    { destruct (Rle_lt_dec (t - L) (IZR n * (4 * L) + L)) as [Q|Q].
      - rewrite (rising n) by lra. apply Rmult_le_pos; lra.
      - rewrite (falling n) by lra. apply Rmult_le_pos; lra. }
    destruct (Rlt_dec _ _); [lra|reflexivity].
Qed.

Lemma up_slope n t : is_derive (fun t => k * C * (t - IZR n * (4 * L))) t (k * C).
Proof. auto_derive; [trivial|ring]. Qed.
Lemma down_slope n t : is_derive (fun t => k * C * (IZR n * (4 * L) + 2 * L - t)) t (k * - C).
Proof. auto_derive; [trivial|ring]. Qed.

Theorem triangle_is_motion : loop k L C triangle command.
Proof.
  pose proof K_positive as K. split.
  - intros t. destruct (everywhere t) as [n [Ht|[Ht|[Ht|Ht]]]].
    + apply (glue_continuous triangle (fun t => k * C * (t - IZR n * (4 * L))) (fun t => k * C * (t - IZR n * (4 * L))) t
        (Rmin (t - (IZR n * (4 * L) - L)) (IZR n * (4 * L) + L - t))); try apply (continuous_of_derive _ _ _ (up_slope n t)); [apply Rmin_pos; lra|..];
        intros s Hs; pose proof (Rmin_l (t - (IZR n * (4 * L) - L)) (IZR n * (4 * L) + L - t)); pose proof (Rmin_r (t - (IZR n * (4 * L) - L)) (IZR n * (4 * L) + L - t)); apply rising; lra.
    + apply (glue_continuous triangle (fun t => k * C * (t - IZR n * (4 * L))) (fun t => k * C * (IZR n * (4 * L) + 2 * L - t)) t L HL);
        [intros s Hs; apply rising; lra|intros s Hs; apply falling; lra|apply (continuous_of_derive _ _ _ (up_slope n t))|apply (continuous_of_derive _ _ _ (down_slope n t))].
    + apply (glue_continuous triangle (fun t => k * C * (IZR n * (4 * L) + 2 * L - t)) (fun t => k * C * (IZR n * (4 * L) + 2 * L - t)) t
        (Rmin (t - (IZR n * (4 * L) + L)) (IZR n * (4 * L) + 3 * L - t))); try apply (continuous_of_derive _ _ _ (down_slope n t)); [apply Rmin_pos; lra|..];
        intros s Hs; pose proof (Rmin_l (t - (IZR n * (4 * L) + L)) (IZR n * (4 * L) + 3 * L - t)); pose proof (Rmin_r (t - (IZR n * (4 * L) + L)) (IZR n * (4 * L) + 3 * L - t)); apply falling; lra.
    + apply (glue_continuous triangle (fun t => k * C * (IZR (n - 1) * (4 * L) + 2 * L - t)) (fun t => k * C * (t - IZR n * (4 * L))) t L HL);
        [intros s Hs; apply falling; rewrite minus_IZR; lra|intros s Hs; apply rising; lra|apply (continuous_of_derive _ _ _ (down_slope (n - 1) t))|apply (continuous_of_derive _ _ _ (up_slope n t))].
  - intros t [e E]. pose proof (cond_pos e) as Pe. assert (P : 0 < Rmin e L) by (apply Rmin_pos; assumption). pose proof (Rmin_l e L). pose proof (Rmin_r e L).
    destruct (everywhere t) as [n [Ht|[Ht|[Ht|Ht]]]].
    + rewrite (proj1 (command_late n t) Ht). apply (local_derive triangle (fun t => k * C * (t - IZR n * (4 * L))) t (Rmin (t - (IZR n * (4 * L) - L)) (IZR n * (4 * L) + L - t)));
        [apply Rmin_pos; lra| |apply up_slope].
      intros s Hs. pose proof (Rmin_l (t - (IZR n * (4 * L) - L)) (IZR n * (4 * L) + L - t)). pose proof (Rmin_r (t - (IZR n * (4 * L) - L)) (IZR n * (4 * L) + L - t)). apply rising. lra.
    + exfalso. assert (B : ball t e (t - Rmin e L / 2)) by (change (Rabs (t - Rmin e L / 2 - t) < e); rewrite Rabs_left; lra). specialize (E _ B). cbv beta in E.
      rewrite (proj1 (command_late n _)), (proj2 (command_late n t)) in E by lra. lra.
    + rewrite (proj2 (command_late n t)) by lra. apply (local_derive triangle (fun t => k * C * (IZR n * (4 * L) + 2 * L - t)) t (Rmin (t - (IZR n * (4 * L) + L)) (IZR n * (4 * L) + 3 * L - t)));
        [apply Rmin_pos; lra| |apply down_slope].
      intros s Hs. pose proof (Rmin_l (t - (IZR n * (4 * L) + L)) (IZR n * (4 * L) + 3 * L - t)). pose proof (Rmin_r (t - (IZR n * (4 * L) + L)) (IZR n * (4 * L) + 3 * L - t)). apply falling. lra.
    + exfalso. assert (B : ball t e (t + Rmin e L / 2)) by (change (Rabs (t + Rmin e L / 2 - t) < e); rewrite Rabs_pos_eq; lra). specialize (E _ B). cbv beta in E.
      rewrite (proj1 (command_late n _)), (proj2 (command_late (n - 1) t)) in E by (rewrite ?minus_IZR; lra). lra.
  - intros t H. unfold command. destruct (Rlt_dec (triangle t) 0); [reflexivity|contradiction].
  - intros t H. unfold command. destruct (Rlt_dec (triangle t) 0); [lra|reflexivity].
Qed.

Lemma triangle_before : triangle 0 = 0 /\ forall t, - L < t < 0 -> triangle t < 0.
Proof.
  pose proof K_positive as K. split; [rewrite (rising 0); lra|]. intros t Ht. rewrite (rising 0) by lra. nra.
Qed.
End Triangle.

Theorem statement : forall k L C : R, 0 < k -> 0 < L -> 0 < C ->
  (* there is a motion that comes up to zero after a dead time below it *)
  (exists y u, loop k L C y u /\ y 0 = 0 /\ forall t, 0 - L < t < 0 -> y t < 0) /\
  (* any motion that comes up to zero after a dead time below it is from then on a triangle: amplitude k C L, period 4 L *)
  (forall y u b, loop k L C y u -> y b = 0 -> (forall t, b - L < t < b -> y t < 0) ->
    (forall n s, 0 <= s <= 2 * L -> y (b + INR n * (2 * L) + s) = (-1) ^ n * tent k L C s) /\
    (forall t, b <= t -> y (t + period L) = y t /\ Rabs (y t) <= X_m k L C) /\ y (b + L) = X_m k L C) /\
  (* the ultimate point: the process has the phase -pi first at this frequency, whose period is that, and there 1 over the ultimate gain *)
  (let w := 2 * PI / period L in response_im k L w = 0 /\ response_re k L w = - (1 / ultimate_gain k L) /\
    forall w', 0 < w' < w -> response_im k L w' < 0) /\
  (* the describing function gives 8/pi^2 of it *)
  gain_of_describing_function C (X_m k L C) = 8 / PI ^ 2 * ultimate_gain k L.
Proof.
  intros k L C Hk HL HC. pose proof PI_RGT_0 as HPI. split; [|split; [|split]].
  - exists (triangle k L C), (command k L C). split; [apply triangle_is_motion; assumption|].
    destruct (triangle_before k L C Hk HL HC) as [T0 T1]. split; [exact T0|]. intros t Ht. apply T1. lra.
  - intros y u b M Yb Before. pose proof (fun n => tents k L C Hk HL HC n y u b M Yb Before) as T. split; [exact T|]. split.
    + intros t Ht.
      (* the number of the half *)
      assert (Q : exists n s, 0 <= s <= 2 * L /\ t = b + INR n * (2 * L) + s).
      { destruct (base_Int_part ((t - b) / (2 * L))) as [I1 I2]. set (z := Int_part ((t - b) / (2 * L))) in *.
        assert (R0 : 0 <= (t - b) / (2 * L)) by (apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; lra]).
        assert (Z : (0 <= z)%Z) by (assert (-1 < z)%Z by (apply lt_IZR; lra); lia).
        exists (Z.to_nat z), (t - b - IZR z * (2 * L)). rewrite INR_IZR_INZ, Z2Nat.id by exact Z. split; [|ring].
        assert (E : t - b = (t - b) / (2 * L) * (2 * L)) by (field; lra). split.
        - assert (IZR z * (2 * L) <= (t - b) / (2 * L) * (2 * L)) by (apply Rmult_le_compat_r; lra). lra.
        - assert ((t - b) / (2 * L) * (2 * L) <= (IZR z + 1) * (2 * L)) by (apply Rmult_le_compat_r; lra). lra. }
      destruct Q as [n [s [Hs ->]]]. split.
      * replace (b + INR n * (2 * L) + s + period L) with (b + INR (S (S n)) * (2 * L) + s) by (rewrite !S_INR; unfold period; ring).
        rewrite !T by exact Hs. simpl. ring.
      * rewrite T by exact Hs. rewrite Rabs_mult, pow_1_abs, Rmult_1_l.
        unfold tent, X_m. assert (K : 0 < k * C) by (apply Rmult_lt_0_compat; assumption). destruct (Rle_dec s L); rewrite Rabs_pos_eq; nra.
    + pose proof (T 0%nat L ltac:(lra)) as E. simpl in E. rewrite Rmult_0_l, Rplus_0_r, Rmult_1_l in E. rewrite E. unfold tent, X_m.
      destruct (Rle_dec L L); [reflexivity|lra].
  - cbv zeta. assert (Ew : 2 * PI / period L * L = PI / 2) by (unfold period; field; lra). unfold response_re, response_im. rewrite Ew, cos_PI2, sin_PI2.
    split; [ring|]. split; [unfold ultimate_gain, period; field; lra|]. intros w' [W0 W1].
    assert (w' * L < PI / 2) by (rewrite <- Ew; apply Rmult_lt_compat_r; assumption). assert (0 < w' * L) by (apply Rmult_lt_0_compat; assumption).
    assert (0 < cos (w' * L)) by (apply cos_gt_0; lra). assert (0 < k / w') by (apply Rdiv_lt_0_compat; lra). nra.
  - unfold gain_of_describing_function, X_m, ultimate_gain. field. repeat split; lra.
Qed.

(** With hysteresis the triangle goes on for a dead time after it has passed the half-width: the way from [-(x_a + k C L)] to [x_a + k C L] and
    back, at the speed k C, takes longer. *)
Theorem needs_no_hysteresis : forall k L C x_a, 0 < k -> 0 < L -> 0 < C -> 0 < x_a ->
  2 * ((2 * (x_a + k * C * L)) / (k * C)) > period L.
Proof.
  intros k L C x_a Hk HL HC Hx. unfold period. assert (K : 0 < k * C) by (apply Rmult_lt_0_compat; assumption).
  replace (2 * (2 * (x_a + k * C * L) / (k * C))) with (4 * (x_a / (k * C)) + 4 * L) by (field; lra).
  assert (0 < x_a / (k * C)) by (apply Rdiv_lt_0_compat; assumption). lra.
Qed.

(** The loop has faster motions too: the triangle of a fifth of the dead time, whose command is the same a period of it earlier. It comes up
    to zero after a fifth of a dead time below it. *)
Theorem needs_below_for_a_dead_time : forall k L C, 0 < k -> 0 < L -> 0 < C ->
  let y := triangle k (L / 5) C in
  loop k L C y (command k (L / 5) C) /\ y 0 = 0 /\ (forall t, - (L / 5) < t < 0 -> y t < 0) /\ forall t, y (t + period L / 5) = y t.
Proof.
  intros k L C Hk HL HC y. assert (HL5 : 0 < L / 5) by lra. destruct (triangle_before k (L / 5) C Hk HL5 HC) as [Z B].
  assert (R : forall t, triangle k (L / 5) C (t + period L / 5) = triangle k (L / 5) C t).
  { intros t. unfold triangle. replace (within (L / 5) (t + period L / 5)) with (within (L / 5) t); [reflexivity|].
    destruct (base_Int_part (t / (4 * (L / 5)))) as [I1 I2]. set (n := Int_part (t / (4 * (L / 5)))) in *.
    assert (E : t = t / (4 * (L / 5)) * (4 * (L / 5))) by (field; lra).
    assert (A1 : IZR n * (4 * (L / 5)) <= t) by (rewrite E; apply Rmult_le_compat_r; lra).
    assert (A2 : t < (IZR n + 1) * (4 * (L / 5))) by (rewrite E at 1; apply Rmult_lt_compat_r; lra).
    unfold period. rewrite (within_is (L / 5) HL5 n t), (within_is (L / 5) HL5 (n + 1)) by (rewrite ?plus_IZR; lra). rewrite plus_IZR. field. }
  assert (U : forall t, command k (L / 5) C (t - L) = command k (L / 5) C (t - L / 5)).
  { intros t. unfold command. replace (t - L / 5) with (t - L + period L / 5) by (unfold period; field). now rewrite R. }
  destruct (triangle_is_motion k (L / 5) C Hk HL5 HC) as [M1 M2 M3 M4]. split; [|split; [exact Z|split; [exact B|exact R]]].
  split; [exact M1| |exact M3|exact M4]. intros t N. rewrite U. apply M2. apply (filter_imp (fun s => command k (L / 5) C (s - L) = command k (L / 5) C (t - L))); [|exact N].
  intros s E. rewrite <- !U. exact E.
Qed.

Print Assumptions statement.
