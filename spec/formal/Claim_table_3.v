(** claim: table-3 (Table 3)
    Eqs. 27 and 29 with 30 and 31 put in: [beta = 4 C x_a/(pi w X_m^2)], [beta_xx = (3/2) C x_a/(w^2 X_m^3)], and alpha by eq. 31 over
    [w^2]; [delta] is the mean of eq. 32. The formulas are those of the integrals of a relay's output along the sinusoid. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Relay Claim_relay_p Claim_relay_q Claim_relay_f0 Claim_linear_drag Claim_quadratic_drag.
Open Scope R_scope.

(** Table 3 as the program prints it. *)
Definition alpha (C x_a x_0 X w : R) : R :=
  2 * C * (sqrt (1 - (x_0 - x_a) ^ 2 / X ^ 2) + sqrt (1 - (x_0 + x_a) ^ 2 / X ^ 2)) / (PI * X * w ^ 2).
Definition beta (C x_a X w : R) : R := 4 * C * x_a / (PI * X ^ 2 * w).
Definition beta_xx (C x_a X w : R) : R := 3 * C * x_a / (2 * X ^ 3 * w ^ 2).
Definition delta (C x_a x_0 X : R) : R := C * (asin ((x_a + x_0) / X) - asin ((x_a - x_0) / X)) / PI.

Lemma alpha_is C x_a x_0 X w : 0 < X -> 0 < w -> alpha C x_a x_0 X w = identified_alpha (P_N C x_a x_0 X) w.
Proof.
  intros HX Hw. pose proof PI_RGT_0. unfold alpha, identified_alpha, P_N.
  replace ((x_0 - x_a) ^ 2 / X ^ 2) with (((x_a - x_0) / X) ^ 2) by (field; lra).
  replace ((x_0 + x_a) ^ 2 / X ^ 2) with (((x_a + x_0) / X) ^ 2) by (field; lra). field. lra.
Qed.

Theorem statement : forall (C x_a x_0 X w : R) (y : R -> R), 0 <= x_a -> 0 < w -> switches C x_a x_0 X y ->
  alpha C x_a x_0 X w = identified_alpha (Y_P 1 y / X) w /\
  beta C x_a X w = identified_beta (Y_Q 1 y / X) w /\
  beta_xx C x_a X w = identified_beta_xx (Y_Q 1 y / X) X w /\
  delta C x_a x_0 X = Y_0 y.
Proof.
  intros C x_a x_0 X w y Hxa Hw law. pose proof PI_RGT_0.
  assert (HX : 0 < X) by (destruct law as [_ [S|[S _]]]; [pose proof (Rabs_pos x_0); lra|exact S]).
  rewrite (proj1 (Claim_relay_p.statement C x_a x_0 X y Hxa law)).
  replace (Y_Q 1 y / X) with (Q_N C x_a X).
  2:{ pose proof (proj2 (Claim_relay_q.statement C x_a x_0 X 0 y Hxa law) 0) as T. rewrite Rplus_0_l in T.
      rewrite (Y_Q_of _ _ T). field. lra. }
  replace (Y_0 y) with (F_0 C x_a x_0 X).
  2:{ pose proof (proj1 (proj2 (Claim_relay_f0.statement C x_a x_0 X 0 y Hxa law)) 0) as T. rewrite Rplus_0_l in T.
      rewrite (Y_0_of _ _ T). field. lra. }
  split; [apply alpha_is; assumption|].
  unfold beta, beta_xx, delta, identified_beta, identified_beta_xx, Q_N, F_0. repeat split; field; repeat split; lra.
Qed.

Print Assumptions statement.
