(** claim: relay-p (eq. 31)
    [P_N = (2C/(pi X_m)) [sqrt(1 - ((x_a - x_0)/X_m)^2) + sqrt(1 - ((x_a + x_0)/X_m)^2)]] for a relay with hysteresis that a biased
    sinusoid switches both ways, from the law of the relay. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Relay.
Open Scope R_scope.

Definition P_N (C x_a x_0 X : R) : R :=
  2 * C / (PI * X) * (sqrt (1 - ((x_a - x_0) / X) ^ 2) + sqrt (1 - ((x_a + x_0) / X) ^ 2)).

(** The hypothesis switches-both-ways is in [switches]: [X > x_a + abs(x_0)], or equal to it and a relay that turns at the level. *)
Theorem statement : forall (C x_a x_0 X : R) (y : R -> R), 0 <= x_a -> switches C x_a x_0 X y ->
  Y_P 1 y / X = P_N C x_a x_0 X /\
  (* over any turn *)
  forall a, is_RInt (fun t => y t * sin t) a (a + 2 * PI) (PI * X * P_N C x_a x_0 X).
Proof.
  intros C x_a x_0 X y Hxa law. pose proof PI_RGT_0.
  assert (HX : 0 < X) by (destruct law as [_ [S|[S _]]]; [pose proof (Rabs_pos x_0); lra|exact S]).
  assert (reach : x_a + Rabs x_0 <= X) by (destruct law as [_ [S|[_ [S _]]]]; lra).
  assert (T : forall a, is_RInt (fun t => y t * sin t) a (a + 2 * PI) (PI * X * P_N C x_a x_0 X)).
  { intros a. eapply int_eq; [apply (over_a_turn C x_a x_0 X y sin (fun t => - cos t) 0 a Hxa law)|intros; reflexivity|].
    - intros t. auto_derive; [trivial|ring].
    - apply continuous_of_ex_derive. intros t. auto_derive. trivial.
    - intros t. rewrite cos_turn. ring.
    - unfold down, up, P_N. rewrite (Rplus_comm PI), neg_cos, !cos_asin
        by (apply share_up || apply share_down; assumption).
      unfold Rsqr. replace ((x_a - x_0) / X * ((x_a - x_0) / X)) with (((x_a - x_0) / X) ^ 2) by ring.
      replace ((x_a + x_0) / X * ((x_a + x_0) / X)) with (((x_a + x_0) / X) ^ 2) by ring. field. lra. }
  split; [|exact T]. pose proof (T 0) as T0. rewrite Rplus_0_l in T0. rewrite (Y_P_of _ _ T0). field. lra.
Qed.

(** With the bias left out it is another number. *)
Theorem bias_matters : P_N 1 1 0 2 <> P_N 1 1 1 2.
Proof.
  unfold P_N. pose proof PI_RGT_0. replace (1 - ((1 - 0) / 2) ^ 2) with (3 / 4) by field. replace (1 - ((1 + 0) / 2) ^ 2) with (3 / 4) by field.
  replace (1 - ((1 - 1) / 2) ^ 2) with (1 * 1) by field. replace (1 - ((1 + 1) / 2) ^ 2) with 0 by field.
  rewrite sqrt_square, sqrt_0 by lra. intros E. apply Rmult_eq_reg_l in E.
  - assert (S : sqrt (3 / 4) * sqrt (3 / 4) = 3 / 4) by (apply sqrt_sqrt; lra). nra.
  - apply Rgt_not_eq. apply Rdiv_lt_0_compat; lra.
Qed.

Print Assumptions statement.
