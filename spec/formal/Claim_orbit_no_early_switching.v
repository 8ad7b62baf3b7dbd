(** claim: orbit-no-early-switching (of this project)
    Between switchings the force, drag included, keeps its sign in the direction that the command gives. So after the relay switches at
    [x_a] the velocity falls to zero once, at the turning point beyond [x_a], and then stays negative until x is [-x_a]: no level is
    crossed earlier than the closed forms assume. Every mix of linear and quadratic drag, [abs(delta) < C]. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Phase Switching Cycle.
Open Scope R_scope.

(** From the instant b, where the upper level is passed upwards and the command is [-C] from then on, to b', where the lower is reached. *)
Record one_way (alpha beta_1 beta_2 delta C x_a : R) (x v u : R -> R) (b t_0 b' : R) : Prop := {
  turns_within : b < t_0 < b';
  command : forall t, b < t < b' -> u t = - C;
  force_keeps_sign : forall t, b <= t <= b' -> - C + delta - drag beta_1 beta_2 (v t) < 0;
  rises : forall t, b <= t < t_0 -> 0 < v t;
  rests : v t_0 = 0;
  comes_back : forall t, t_0 < t <= b' -> v t < 0;
  beyond : x_a < x t_0;
  not_earlier : forall t, b <= t < b' -> - x_a < x t;
  arrives : x b' = - x_a;
  below_terminal : - v b' < terminal beta_1 beta_2 (C - delta) }.

Lemma one_half alpha beta_1 beta_2 delta C x_a x v u b V :
  0 < alpha -> 0 <= beta_1 -> 0 <= beta_2 -> 0 < beta_1 + beta_2 -> 0 < x_a -> delta < C ->
  relay_loop alpha beta_1 beta_2 delta C x_a x v u -> top C x_a x v u b V ->
  exists t_0 b' V', one_way alpha beta_1 beta_2 delta C x_a x v u b t_0 b' /\ top C x_a (fun t => - x t) (fun t => - v t) (fun t => - u t) b' V'.
Proof.
  intros Ha Hb1 Hb2 Hb Hx D M T.
  destruct (half_turn alpha beta_1 beta_2 C x_a Ha Hb1 Hb2 Hb Hx delta x v u b V M D T) as [b' [V' [Lt [F [H [E T']]]]]].
  assert (Hc : 0 < C - delta) by lra. set (c := C - delta) in *.
  destruct T as [b0 [Xb [Vb [V0 Com]]]]. pose proof T' as [_ [Xb' [Vb' [V0' _]]]]. cbv beta in Xb', Vb'.
  assert (P : 0 < force beta_1 beta_2 c (v b)) by (pose proof (force_of_speed beta_1 beta_2 c Hb1 Hb2 (v b) ltac:(lra)); lra).
  assert (K : forall t, b <= t <= b' -> 0 < force beta_1 beta_2 c (v t)) by (intros t Ht; apply (keeps_moving alpha beta_1 beta_2 c Ha x v b b' t F P Ht)).
  assert (S : forall s t, b <= s -> s < t -> t <= b' -> v t < v s) by (intros; apply (speed_falls alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc x v b b' s t F P); assumption).
  pose proof H as [_ [_ [F' W]]].
  pose proof (time_rises alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc 0 V ltac:(rewrite force_at_rest; exact Hc) V0) as R1. rewrite time_0 in R1.
  pose proof (time_rises alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc (- V') 0 F' ltac:(lra)) as R2. rewrite time_0 in R2.
  set (t_0 := b + time alpha beta_1 beta_2 c V). assert (I : b < t_0 < b') by (unfold t_0; lra).
  assert (Z : v t_0 = 0).
  { pose proof (passing_time alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc x v b t_0 (fall_part alpha beta_1 beta_2 c x v b b' b t_0 F ltac:(lra) ltac:(lra) ltac:(lra)) P) as Q.
    rewrite Vb in Q. destruct (Rtotal_order (v t_0) 0) as [L|[L|L]]; [exfalso|exact L|exfalso].
    - pose proof (time_rises alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc (v t_0) 0 (K t_0 ltac:(lra)) L) as R3. rewrite time_0 in R3. unfold t_0 in *. lra.
    - pose proof (time_rises alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc 0 (v t_0) ltac:(rewrite force_at_rest; exact Hc) L) as R3. rewrite time_0 in R3. unfold t_0 in *. lra. }
  assert (X : forall t, b <= t <= b' -> x t = x_a + way alpha beta_1 beta_2 c V - way alpha beta_1 beta_2 c (v t)).
  { intros t Ht. pose proof (first_integral alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc x v b t (fall_part alpha beta_1 beta_2 c x v b b' b t F ltac:(lra) ltac:(lra) ltac:(lra)) P) as Q.
    rewrite Vb in Q. lra. }
  assert (B : 0 < way alpha beta_1 beta_2 c V) by (pose proof (way_rises alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc 0 V (Rle_refl 0) V0) as Q; rewrite way_0 in Q; exact Q).
  assert (N : forall t, b <= t < b' -> - x_a < x t).
  { intros t Ht. rewrite X by lra. pose proof (S t b' ltac:(lra) ltac:(lra) ltac:(lra)) as L.
    assert (way alpha beta_1 beta_2 c (v t) < way alpha beta_1 beta_2 c (- V')); [|lra].
    destruct (Rle_lt_dec (v t) 0) as [Q|Q].
    - apply way_falls; try assumption. lra.
    - rewrite W. destruct (Req_dec t b) as [->|Ne]; [rewrite Vb; lra|].
      pose proof (S b t ltac:(lra) ltac:(lra) ltac:(lra)). pose proof (way_rises alpha beta_1 beta_2 c Ha Hb1 Hb2 Hc (v t) V ltac:(lra) ltac:(lra)). lra. }
  exists t_0, b', V'. split; [|exact T']. split.
  - exact I.
  - intros t Ht. apply Com; [lra|]. intros r Hr. apply N. lra.
  - intros t Ht. specialize (K t Ht). unfold force, c in K. lra.
  - intros t Ht. rewrite <- Z. apply S; lra.
  - exact Z.
  - intros t Ht. rewrite <- Z. apply S; lra.
  - rewrite X, Z, way_0 by lra. lra.
  - exact N.
  - lra.
  - rewrite Vb'. destruct (terminal_speed beta_1 beta_2 Hb1 Hb2 c Hc Hb) as [_ Ew]. exact (half_below_terminal alpha beta_1 beta_2 c Hb1 Hb2 x_a V V' _ H Ew).
Qed.

Theorem statement : forall (alpha beta_1 beta_2 delta C x_a : R) (x v u : R -> R),
  0 < alpha -> 0 <= beta_1 -> 0 <= beta_2 -> 0 < beta_1 + beta_2 -> 0 < x_a ->
  (* the hypothesis disturbance-below-level *)
  Rabs delta < C ->
  relay_loop alpha beta_1 beta_2 delta C x_a x v u ->
  let x' := fun t => - x t in let v' := fun t => - v t in let u' := fun t => - u t in
  (* every motion passes the upper level upwards, and turns its command there *)
  (exists b V, top C x_a x v u b V) /\
  (* from there it goes one way to the lower level, whatever its speed, and passes that downwards *)
  (forall b V, top C x_a x v u b V -> exists t_0 b' V', one_way alpha beta_1 beta_2 delta C x_a x v u b t_0 b' /\ top C x_a x' v' u' b' V') /\
  (* from the lower level the same, mirrored *)
  (forall b V, top C x_a x' v' u' b V -> exists t_0 b' V', one_way alpha beta_1 beta_2 (- delta) C x_a x' v' u' b t_0 b' /\ top C x_a x v u b' V').
Proof.
  intros alpha beta_1 beta_2 delta C x_a x v u Ha Hb1 Hb2 Hb Hx D M x' v' u'. pose proof (Rabs_def2 _ _ D) as [D1 D2].
  split; [|split].
  - exact (passes_top alpha beta_1 beta_2 C x_a Ha Hb1 Hb2 Hb Hx delta x v u M D).
  - intros b V T. exact (one_half alpha beta_1 beta_2 delta C x_a x v u b V Ha Hb1 Hb2 Hb Hx D1 M T).
  - intros b V T. destruct (one_half alpha beta_1 beta_2 (- delta) C x_a x' v' u' b V Ha Hb1 Hb2 Hb Hx ltac:(lra) (mirror _ _ _ _ _ _ _ _ _ M) T) as [t_0 [b' [V' [O T']]]].
    exists t_0, b', V'. split; [exact O|]. unfold x', v', u' in T'. rewrite !twice in T'. exact T'.
Qed.

(** At the level and above, one command no longer turns the axis: a motion never comes back. *)
Theorem needs_disturbance_below_level : forall alpha beta_1 beta_2 C x_a delta : R, 0 < alpha -> 0 <= beta_1 -> 0 <= beta_2 -> 0 < beta_1 + beta_2 -> 0 < x_a ->
  C <= delta -> exists x v u, relay_loop alpha beta_1 beta_2 delta C x_a x v u /\ forall t, 0 < t -> x_a < x t.
Proof. intros. apply drifts_away; assumption. Qed.

Print Assumptions statement.
