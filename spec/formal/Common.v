(** What the claims share: the drag axis, the relay, the sinusoid, and facts of real analysis. *)
From Coq Require Import Reals Lra Lia Psatz.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(** * The objects *)

(** Linear drag and quadratic drag together: the force [beta_1 v + beta_2 v abs(v)]. *)
Definition drag (beta_1 beta_2 v : R) : R := beta_1 * v + beta_2 * (v * Rabs v).

(** The biased sinusoid [x_0 + X sin(theta)] of eq. 7. *)
Definition sinusoid (x_0 X theta : R) : R := x_0 + X * sin theta.

(** The relay with hysteresis, looked at at some [instants] (all of them, or samples). Beyond a level the output is decided;
    between the levels it stays as it was. At a level itself nothing is asked, so that a relay that turns at the level and one that
    turns beyond it both obey. *)
Record relay (instants : R -> Prop) (C x_a : R) (input output : R -> R) : Prop := {
  two_valued : forall t, instants t -> output t = C \/ output t = - C;
  high : forall t, instants t -> x_a < input t -> output t = C;
  low : forall t, instants t -> input t < - x_a -> output t = - C;
  stays_high : forall s t, instants s -> instants t -> s <= t -> output s = C ->
    (forall r, instants r -> s < r <= t -> - x_a < input r) -> output t = C;
  stays_low : forall s t, instants s -> instants t -> s <= t -> output s = - C ->
    (forall r, instants r -> s < r <= t -> input r < x_a) -> output t = - C }.

(** The relay of the program turns at the level itself; where both levels are zero, upwards. *)
Record turns_at_level (instants : R -> Prop) (C x_a : R) (input output : R -> R) : Prop := {
  high_at : forall t, instants t -> x_a <= input t -> output t = C;
  low_at : forall t, instants t -> input t <= - x_a -> input t < x_a -> output t = - C }.

Definition always (t : R) : Prop := True.
Definition later (t : R) : Prop := 0 < t.

(** An axis under a force, from an instant on: [x' = v], and [alpha v' + beta_1 v + beta_2 v abs(v) = force + delta] wherever the force
    stays constant near by; the velocity does not jump anywhere. *)
Record axis (start alpha beta_1 beta_2 delta : R) (force x v : R -> R) : Prop := {
  velocity : forall t, start < t -> is_derive x t (v t);
  no_jump : forall t, start < t -> continuous v t;
  newton : forall t, start < t -> locally t (fun s => force s = force t) ->
    is_derive v t ((force t + delta - drag beta_1 beta_2 (v t)) / alpha) }.

(** The loop of axis and relay, reference zero, no delay: the command u is the relay's output for the error [-x]. *)
Definition relay_loop (alpha beta_1 beta_2 delta C x_a : R) (x v u : R -> R) : Prop :=
  axis 0 alpha beta_1 beta_2 delta u x v /\ relay later C x_a (fun t => - x t) u.

(** * Tactics *)

(** [ring] where the goal's type is the carrier of a module. *)
Ltac real_ring := match goal with |- ?p = ?q => change (@eq R p q) end; ring.

(** * Mean value *)

Lemma continuity_of_derive (f : R -> R) (x l : R) : is_derive f x l -> continuity_pt f x.
Proof. intros H. apply derivable_continuous_pt. exists l. now apply is_derive_Reals. Qed.

Lemma continuous_of_derive (f : R -> R) (x l : R) : is_derive f x l -> continuous f x.
Proof. intros H. apply (ex_derive_continuous (V := R_NormedModule)). now exists l. Qed.

Lemma continuous_of_ex_derive (f : R -> R) : (forall x : R, ex_derive f x) -> forall x : R, continuous f x.
Proof. intros H x. apply (ex_derive_continuous (V := R_NormedModule)), H. Qed.

(** Cauchy's mean value, the point strictly between. *)
Lemma cauchy (f g f' g' : R -> R) (a b : R) : a < b ->
  (forall x, a < x < b -> is_derive f x (f' x)) -> (forall x, a < x < b -> is_derive g x (g' x)) ->
  (forall x, a <= x <= b -> continuity_pt f x) -> (forall x, a <= x <= b -> continuity_pt g x) ->
  exists c, a < c < b /\ (g b - g a) * f' c = (f b - f a) * g' c.
Proof.
  intros ab Df Dg Cf Cg.
  assert (pf : forall c, a < c < b -> derivable_pt f c) by (intros c Hc; exists (f' c); apply is_derive_Reals; auto).
  assert (pg : forall c, a < c < b -> derivable_pt g c) by (intros c Hc; exists (g' c); apply is_derive_Reals; auto).
  destruct (MVT f g a b pf pg ab Cf Cg) as [c [P E]]. exists c. split; [exact P|].
  replace (derive_pt f c (pf c P)) with (f' c) in E
    by (symmetry; apply derive_pt_eq; apply is_derive_Reals; auto).
  replace (derive_pt g c (pg c P)) with (g' c) in E
    by (symmetry; apply derive_pt_eq; apply is_derive_Reals; auto).
  exact E.
Qed.

Lemma mean_value (f f' : R -> R) (a b : R) : a < b ->
  (forall x, a < x < b -> is_derive f x (f' x)) -> (forall x, a <= x <= b -> continuity_pt f x) ->
  exists c, a < c < b /\ f b - f a = f' c * (b - a).
Proof.
  intros ab Df Cf.
  destruct (cauchy f (fun x => x) f' (fun _ => 1) a b ab Df) as [c [P E]]; try assumption.
  - intros x _. auto_derive; trivial.
  - intros x _. apply derivable_continuous_pt, derivable_pt_id.
  - exists c. split; [exact P|]. lra.
Qed.

Lemma increases (f f' : R -> R) (a b : R) : a < b ->
  (forall x, a < x < b -> is_derive f x (f' x)) -> (forall x, a <= x <= b -> continuity_pt f x) ->
  (forall x, a < x < b -> 0 < f' x) -> f a < f b.
Proof.
  intros ab D C P. destruct (mean_value f f' a b ab D C) as [c [Hc E]]. specialize (P c Hc). nra.
Qed.

Lemma does_not_fall (f f' : R -> R) (a b : R) : a <= b ->
  (forall x, a < x < b -> is_derive f x (f' x)) -> (forall x, a <= x <= b -> continuity_pt f x) ->
  (forall x, a < x < b -> 0 <= f' x) -> f a <= f b.
Proof.
  intros [ab| ->] D C P; [|lra]. destruct (mean_value f f' a b ab D C) as [c [Hc E]]. specialize (P c Hc). nra.
Qed.

Lemma decreases (f f' : R -> R) (a b : R) : a < b ->
  (forall x, a < x < b -> is_derive f x (f' x)) -> (forall x, a <= x <= b -> continuity_pt f x) ->
  (forall x, a < x < b -> f' x < 0) -> f b < f a.
Proof.
  intros ab D C P. destruct (mean_value f f' a b ab D C) as [c [Hc E]]. specialize (P c Hc). nra.
Qed.

Lemma does_not_rise (f f' : R -> R) (a b : R) : a <= b ->
  (forall x, a < x < b -> is_derive f x (f' x)) -> (forall x, a <= x <= b -> continuity_pt f x) ->
  (forall x, a < x < b -> f' x <= 0) -> f b <= f a.
Proof.
  intros [ab| ->] D C P; [|lra]. destruct (mean_value f f' a b ab D C) as [c [Hc E]]. specialize (P c Hc). nra.
Qed.

Lemma is_constant (f : R -> R) (a b : R) : a <= b ->
  (forall x, a < x < b -> is_derive f x 0) -> (forall x, a <= x <= b -> continuity_pt f x) -> f b = f a.
Proof.
  intros ab D C. apply Rle_antisym.
  - apply (does_not_rise f (fun _ => 0)); auto. intros; lra.
  - apply (does_not_fall f (fun _ => 0)); auto. intros; lra.
Qed.

(** l'Hospital's rule for monotony: where f and g begin at zero and f'/g' falls, so does f/g. *)
Lemma ratio_falls (f g f' g' : R -> R) :
  f 0 = 0 -> g 0 = 0 ->
  (forall x, 0 <= x -> is_derive f x (f' x)) -> (forall x, 0 <= x -> is_derive g x (g' x)) ->
  (forall x, 0 < x -> 0 < g' x) -> (forall x y, 0 < x -> x < y -> f' y / g' y < f' x / g' x) ->
  forall x y, 0 < x -> x < y -> f y / g y < f x / g x.
Proof.
  intros F0 G0 Df Dg Pg Q x y Hx xy.
  assert (cont : forall h h' : R -> R, (forall t, 0 <= t -> is_derive h t (h' t)) ->
            forall u v, 0 <= u -> forall t, u <= t <= v -> continuity_pt h t).
  { intros h h' D u v Hu t Ht. apply (continuity_of_derive h t (h' t)), D; lra. }
  assert (G : forall t, 0 < t -> 0 < g t).
  { intros t Ht. rewrite <- G0. apply (increases g g'); auto; intros s Hs; [apply Dg; lra|apply (cont g g' Dg 0 t); lra|apply Pg; lra]. }
  destruct (cauchy f g f' g' 0 x Hx) as [c [Hc E1]]; try (intros s Hs; (apply Df || apply Dg); lra);
    try (apply (cont f f' Df); lra); try (apply (cont g g' Dg); lra).
  destruct (cauchy f g f' g' x y xy) as [d [Hd E2]]; try (intros s Hs; (apply Df || apply Dg); lra);
    try (apply (cont f f' Df); lra); try (apply (cont g g' Dg); lra).
  rewrite F0, G0, !Rminus_0_r in E1.
  assert (L : f' d / g' d < f' c / g' c) by (apply Q; lra).
  assert (Pc : 0 < g' c) by (apply Pg; lra). assert (Pd : 0 < g' d) by (apply Pg; lra).
  assert (gx := G x Hx). assert (gy : 0 < g y) by (apply G; lra).
  assert (gxy : g x < g y).
  { apply (increases g g'); auto; intros s Hs; [apply Dg; lra|apply (cont g g' Dg x y); lra|apply Pg; lra]. }
  assert (A1 : f x = f' c / g' c * g x) by (field_simplify_eq; lra).
  assert (A2 : f y - f x = f' d / g' d * (g y - g x)) by (field_simplify_eq; lra).
  set (p := f' c / g' c) in *. set (q := f' d / g' d) in *.
  apply (Rmult_lt_reg_r (g y)); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
  replace (f x * / g x * g y) with (p * g y) by (rewrite A1; field; lra).
  nra.
Qed.

(** * Integrals *)

Lemma by_antiderivative (A f : R -> R) (a b : R) :
  (forall t, is_derive A t (f t)) -> (forall t, continuous f t) -> is_RInt f a b (A b - A a).
Proof.
  intros HA Hf. apply (is_RInt_derive (V := R_CompleteNormedModule) A f a b); intros; [apply HA|apply Hf].
Qed.

(** Coquelicot's rules, over the reals: its own, stated for modules, make unification run away. *)
Lemma int_plus (f g : R -> R) (a b k l : R) : is_RInt f a b k -> is_RInt g a b l -> is_RInt (fun t => f t + g t) a b (k + l).
Proof. exact (is_RInt_plus (V := R_NormedModule) f g a b k l). Qed.

Lemma int_minus (f g : R -> R) (a b k l : R) : is_RInt f a b k -> is_RInt g a b l -> is_RInt (fun t => f t - g t) a b (k - l).
Proof. exact (is_RInt_minus (V := R_NormedModule) f g a b k l). Qed.

Lemma int_scal (f : R -> R) (a b c l : R) : is_RInt f a b l -> is_RInt (fun t => c * f t) a b (c * l).
Proof. exact (is_RInt_scal (V := R_NormedModule) f a b c l). Qed.

Lemma int_const (c a b : R) : is_RInt (fun _ => c) a b ((b - a) * c).
Proof. exact (is_RInt_const (V := R_NormedModule) a b c). Qed.

Lemma int_chasles (f : R -> R) (a b c k l : R) : is_RInt f a b k -> is_RInt f b c l -> is_RInt f a c (k + l).
Proof. exact (is_RInt_Chasles (V := R_NormedModule) f a b c k l). Qed.

Lemma int_unique (f : R -> R) (a b l : R) : is_RInt f a b l -> RInt f a b = l.
Proof. exact (is_RInt_unique (V := R_CompleteNormedModule) f a b l). Qed.

Lemma int_same (f : R -> R) (a b k l : R) : is_RInt f a b k -> is_RInt f a b l -> k = l.
Proof. intros K L. rewrite <- (int_unique f a b k K). exact (int_unique f a b l L). Qed.

(** The same integral, written otherwise. *)
Lemma int_eq (f g : R -> R) (a b k l : R) : is_RInt f a b k -> (forall t, f t = g t) -> k = l -> is_RInt g a b l.
Proof. intros K E <-. apply (is_RInt_ext f g a b k); [intros t _; apply E|exact K]. Qed.

Lemma int_eq_inside (f g : R -> R) (a b k : R) : a <= b -> is_RInt f a b k -> (forall t, a < t < b -> f t = g t) -> is_RInt g a b k.
Proof.
  intros ab K E. apply (is_RInt_ext f g a b k); [|exact K]. intros t. rewrite Rmin_left, Rmax_right by exact ab. apply E.
Qed.

(** One function, shifted. *)
Lemma is_RInt_shift (f : R -> R) (v a b l : R) :
  is_RInt f (a + v) (b + v) l -> is_RInt (fun t => f (t + v)) a b l.
Proof.
  intros H. apply (is_RInt_ext (fun y => scal 1 (f (1 * y + v)))).
  - intros x _. unfold scal; simpl; unfold mult; simpl. rewrite Rmult_1_l. f_equal. ring.
  - apply (is_RInt_comp_lin f 1 v a b l). now rewrite !Rmult_1_l.
Qed.

(** * Turns *)

Lemma sin_turn t : sin (t + 2 * PI) = sin t.
Proof. rewrite <- (sin_period t 1). f_equal. simpl. ring. Qed.

Lemma cos_turn t : cos (t + 2 * PI) = cos t.
Proof. rewrite <- (cos_period t 1). f_equal. simpl. ring. Qed.

Lemma sin2_cos2' t : sin t * sin t + cos t * cos t = 1.
Proof. pose proof (sin2_cos2 t) as S. unfold Rsqr in S. exact S. Qed.

Lemma div_lt_one a b : 0 < b -> a < b -> a / b < 1.
Proof. intros Hb H. apply (Rmult_lt_reg_r b); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. Qed.

(** A periodic function has the same integral over every turn. *)
Lemma any_turn (f : R -> R) (l a : R) : (forall t, f (t + 2 * PI) = f t) ->
  is_RInt f 0 (2 * PI) l -> is_RInt f a (a + 2 * PI) l.
Proof.
  intros P H. pose proof PI_RGT_0 as HPI.
  (* Within one turn of zero. *)
  assert (near : forall b, 0 <= b <= 2 * PI -> forall m, is_RInt f 0 (2 * PI) m -> is_RInt f b (b + 2 * PI) m).
  { intros b Hb m Hm.
    assert (X1 : ex_RInt f 0 b) by (apply (ex_RInt_Chasles_1 (V := R_CompleteNormedModule)) with (2 * PI); [lra|eexists; exact Hm]).
    assert (X2 : ex_RInt f b (2 * PI)) by (apply (ex_RInt_Chasles_2 (V := R_CompleteNormedModule)) with 0; [lra|eexists; exact Hm]).
    destruct X1 as [p Hp]. destruct X2 as [q Hq].
    assert (E : m = p + q).
    { rewrite <- (is_RInt_unique _ _ _ _ Hm).
      exact (is_RInt_unique _ _ _ _ (is_RInt_Chasles (V := R_NormedModule) _ _ _ _ _ _ Hp Hq)). }
    rewrite E, (Rplus_comm p q). apply (is_RInt_Chasles (V := R_NormedModule) f b (2 * PI) (b + 2 * PI) q p Hq).
    apply (is_RInt_ext (fun t => f (t + - (2 * PI)))).
    - intros t _. rewrite <- (P (t + - (2 * PI))). f_equal. ring.
    - apply (is_RInt_shift f (- (2 * PI))).
      replace (2 * PI + - (2 * PI)) with 0 by ring. replace (b + 2 * PI + - (2 * PI)) with b by ring. exact Hp. }
  (* A whole number of turns further. *)
  assert (steps : forall n m, forall c, is_RInt f c (c + 2 * PI) m ->
            is_RInt f (c + INR n * (2 * PI)) (c + INR n * (2 * PI) + 2 * PI) m /\
            is_RInt f (c - INR n * (2 * PI)) (c - INR n * (2 * PI) + 2 * PI) m).
  { assert (later : forall c m, is_RInt f c (c + 2 * PI) m -> is_RInt f (c + 2 * PI) (c + 2 * PI + 2 * PI) m).
    { intros c m Hm. apply (is_RInt_ext (fun t => f (t + - (2 * PI)))).
      - intros t _. rewrite <- (P (t + - (2 * PI))). f_equal. ring.
      - apply (is_RInt_shift f (- (2 * PI))).
        replace (c + 2 * PI + - (2 * PI)) with c by ring. replace (c + 2 * PI + 2 * PI + - (2 * PI)) with (c + 2 * PI) by ring. exact Hm. }
    assert (earlier : forall c m, is_RInt f c (c + 2 * PI) m -> is_RInt f (c - 2 * PI) (c - 2 * PI + 2 * PI) m).
    { intros c m Hm. apply (is_RInt_ext (fun t => f (t + 2 * PI))); [intros; apply P|].
      apply (is_RInt_shift f (2 * PI)). replace (c - 2 * PI + 2 * PI) with c by ring. exact Hm. }
    induction n as [|n IH]; intros m c Hm.
    - simpl. rewrite Rmult_0_l, Rplus_0_r, Rminus_0_r. split; exact Hm.
    - rewrite S_INR. destruct (IH m c Hm) as [U D]. split.
      + replace (c + (INR n + 1) * (2 * PI)) with (c + INR n * (2 * PI) + 2 * PI) by ring. apply later, U.
      + replace (c - (INR n + 1) * (2 * PI)) with (c - INR n * (2 * PI) - 2 * PI) by ring. apply earlier, D. }
  destruct (archimed (a / (2 * PI))) as [A1 A2]. set (z := up (a / (2 * PI))) in *.
  assert (E : a = a / (2 * PI) * (2 * PI)) by (field; lra).
  set (b := a - (IZR z - 1) * (2 * PI)).
  assert (Hb : 0 <= b <= 2 * PI) by (unfold b; split; nra).
  pose proof (near b Hb l H) as N.
  destruct (Z_le_gt_dec 0 (z - 1)) as [Z|Z].
  - destruct (steps (Z.to_nat (z - 1)) l b N) as [S _]. rewrite INR_IZR_INZ, Z2Nat.id, minus_IZR in S by exact Z.
    replace a with (b + (IZR z - 1) * (2 * PI)) by (unfold b; ring). exact S.
  - destruct (steps (Z.to_nat (- (z - 1))) l b N) as [_ S].
    rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR, minus_IZR in S by lia.
    replace a with (b - - (IZR z - 1) * (2 * PI)) by (unfold b; ring). exact S.
Qed.

(** One, sine and cosine over a turn. *)
Lemma turn_of_sin : is_RInt sin 0 (2 * PI) 0.
Proof.
  replace 0 with (- cos (2 * PI) - - cos 0) at 2 by (rewrite cos_2PI, cos_0; ring).
  apply (by_antiderivative (fun t => - cos t)); intros t; [auto_derive; [trivial|ring]|].
  apply continuous_of_ex_derive. intros s. auto_derive. trivial.
Qed.

Lemma turn_of_cos : is_RInt cos 0 (2 * PI) 0.
Proof.
  replace 0 with (sin (2 * PI) - sin 0) at 2 by (rewrite sin_2PI, sin_0; ring).
  apply (by_antiderivative sin); intros t; [auto_derive; [trivial|ring]|].
  apply continuous_of_ex_derive. intros s. auto_derive. trivial.
Qed.

Lemma turn_of_sin_cos : is_RInt (fun t => sin t * cos t) 0 (2 * PI) 0.
Proof.
  replace 0 with (sin (2 * PI) ^ 2 / 2 - sin 0 ^ 2 / 2) at 2 by (rewrite sin_2PI, sin_0; field).
  apply (by_antiderivative (fun t => sin t ^ 2 / 2)); intros t; [auto_derive; [trivial|field]|].
  apply (continuous_of_ex_derive (fun t => sin t * cos t)). intros s. auto_derive. trivial.
Qed.

Lemma turn_of_sin2 : is_RInt (fun t => sin t * sin t) 0 (2 * PI) PI.
Proof.
  replace PI with ((2 * PI / 2 - sin (2 * PI) * cos (2 * PI) / 2) - (0 / 2 - sin 0 * cos 0 / 2)) at 2
    by (rewrite sin_2PI, sin_0; field).
  apply (by_antiderivative (fun t => t / 2 - sin t * cos t / 2)); intros t.
  - auto_derive; [trivial|]. pose proof (sin2_cos2' t). nra.
  - apply (continuous_of_ex_derive (fun t => sin t * sin t)). intros s. auto_derive. trivial.
Qed.

Lemma turn_of_cos2 : is_RInt (fun t => cos t * cos t) 0 (2 * PI) PI.
Proof.
  replace PI with ((2 * PI / 2 + sin (2 * PI) * cos (2 * PI) / 2) - (0 / 2 + sin 0 * cos 0 / 2)) at 2
    by (rewrite sin_2PI, sin_0; field).
  apply (by_antiderivative (fun t => t / 2 + sin t * cos t / 2)); intros t.
  - auto_derive; [trivial|]. pose proof (sin2_cos2' t). nra.
  - apply (continuous_of_ex_derive (fun t => cos t * cos t)). intros s. auto_derive. trivial.
Qed.

(** * Fourier coefficients (eqs. 8-11) *)

Definition Y_0 (y : R -> R) : R := RInt y 0 (2 * PI) / (2 * PI).
Definition Y_P (k : nat) (y : R -> R) : R := RInt (fun t => y t * sin (INR k * t)) 0 (2 * PI) / PI.
Definition Y_Q (k : nat) (y : R -> R) : R := RInt (fun t => y t * cos (INR k * t)) 0 (2 * PI) / PI.

Lemma Y_0_of (y : R -> R) (l : R) : is_RInt y 0 (2 * PI) l -> Y_0 y = l / (2 * PI).
Proof. intros H. unfold Y_0. now rewrite (is_RInt_unique _ _ _ _ H). Qed.

Lemma Y_P_of (y : R -> R) (l : R) : is_RInt (fun t => y t * sin t) 0 (2 * PI) l -> Y_P 1 y = l / PI.
Proof.
  intros H. unfold Y_P. rewrite (RInt_ext _ (fun t => y t * sin t)) by (intros; simpl; now rewrite Rmult_1_l).
  now rewrite (is_RInt_unique _ _ _ _ H).
Qed.

Lemma Y_Q_of (y : R -> R) (l : R) : is_RInt (fun t => y t * cos t) 0 (2 * PI) l -> Y_Q 1 y = l / PI.
Proof.
  intros H. unfold Y_Q. rewrite (RInt_ext _ (fun t => y t * cos t)) by (intros; simpl; now rewrite Rmult_1_l).
  now rewrite (is_RInt_unique _ _ _ _ H).
Qed.
