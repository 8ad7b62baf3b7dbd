(** claim: relay-q (eq. 30)
    [Q_N = -4 C x_a/(pi X_m^2)] for a relay with hysteresis that a biased sinusoid switches both ways, independent of the bias and of
    an offset of the levels. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Relay.
Open Scope R_scope.

Definition Q_N (C x_a X : R) : R := - (4 * C * x_a) / (PI * X ^ 2).

(** The hypothesis switches-both-ways is in [switches]: [X > x_a + abs(x_0)], or equal to it and a relay that turns at the level. *)
Theorem statement : forall (C x_a x_0 X offset : R) (y : R -> R), 0 <= x_a -> switches C x_a x_0 X y ->
  Y_Q 1 (fun t => y t + offset) / X = Q_N C x_a X /\
  (* over any turn *)
  forall a, is_RInt (fun t => y t * cos t) a (a + 2 * PI) (PI * X * Q_N C x_a X).
Proof.
  intros C x_a x_0 X offset y Hxa law. pose proof PI_RGT_0.
  assert (HX : 0 < X) by (destruct law as [_ [S|[S _]]]; [pose proof (Rabs_pos x_0); lra|exact S]).
  assert (reach : x_a + Rabs x_0 <= X) by (destruct law as [_ [S|[_ [S _]]]]; lra).
  assert (T : forall a, is_RInt (fun t => y t * cos t) a (a + 2 * PI) (PI * X * Q_N C x_a X)).
  { intros a. eapply int_eq; [apply (over_a_turn C x_a x_0 X y cos sin 0 a Hxa law)|intros; reflexivity|].
    - intros t. auto_derive; [trivial|ring].
    - apply continuous_of_ex_derive. intros t. auto_derive. trivial.
    - intros t. rewrite sin_turn. ring.
    - pose proof (sin_up x_a x_0 X Hxa HX reach) as U. pose proof (sin_down x_a x_0 X Hxa HX reach) as D.
      replace (sin (up x_a x_0 X)) with ((x_a - x_0) / X) by (rewrite <- U; field; lra).
      replace (sin (down x_a x_0 X)) with (- (x_a + x_0) / X) by (rewrite <- D; field; lra).
      unfold Q_N. field. lra. }
  split; [|exact T]. pose proof (T 0) as T0. rewrite Rplus_0_l in T0.
  assert (O : is_RInt (fun t => (y t + offset) * cos t) 0 (2 * PI) (PI * X * Q_N C x_a X)).
  { eapply int_eq; [exact (int_plus _ _ _ _ _ _ T0 (int_scal _ _ _ offset _ turn_of_cos))|intros; cbv beta; ring|ring]. }
  rewrite (Y_Q_of _ _ O). field. lra.
Qed.

(** A sinusoid that does not switch the relay leaves its output constant, with no sine or cosine, while the formula is not zero. *)
Theorem needs_switches_both_ways : exists (C x_a x_0 X : R) (y : R -> R),
  0 <= x_a /\ relay always C x_a (sinusoid x_0 X) y /\ Y_Q 1 y / X <> Q_N C x_a X.
Proof.
  exists 1, 2, 0, 1, (fun _ => 1). pose proof PI_RGT_0. split; [lra|]. split.
  - pose proof SIN_bound as B. split; unfold sinusoid.
    + intros; left; reflexivity.
    + intros; reflexivity.
    + intros t _ T. specialize (B t). lra.
    + intros; reflexivity.
    + intros s t _ _ _ E. lra.
  - assert (Z : is_RInt (fun t => 1 * cos t) 0 (2 * PI) 0).
    { eapply int_eq; [exact turn_of_cos|intros; ring|reflexivity]. }
    rewrite (Y_Q_of _ _ Z). unfold Q_N. replace (0 / PI / 1) with 0 by (field; lra).
    assert (0 < 8 / PI) by (apply Rdiv_lt_0_compat; lra). replace (- (4 * 1 * 2) / (PI * 1 ^ 2)) with (- (8 / PI)) by (field; lra). lra.
Qed.

Print Assumptions statement.
