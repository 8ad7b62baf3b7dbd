(** claim: delay-rotation (eqs. 33-34)
    A delay [T_d] at the plant's input turns the describing function: [P* = P cos(w T_d) + Q sin(w T_d)],
    [Q* = -P sin(w T_d) + Q cos(w T_d)] replace P and Q. It is a rotation, multiplication by [exp(-j w T_d)]: lengths stay, delays add, and a
    negative delay undoes it. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

(** Eq. 34 by the phase [w T_d]. *)
Definition delayed (G : C) (phase : R) : C :=
  (fst G * cos phase + snd G * sin phase, - fst G * sin phase + snd G * cos phase).

Theorem statement : forall (P Q phase : R),
  delayed (P, Q) phase = Cmult (P, Q) (cos phase, - sin phase) /\
  Cmod (delayed (P, Q) phase) = Cmod (P, Q) /\
  (forall other, delayed (delayed (P, Q) phase) other = delayed (P, Q) (phase + other)) /\
  delayed (delayed (P, Q) phase) (- phase) = (P, Q) /\
  (* and it is what a delay does to the first harmonic of a periodic output *)
  forall y : R -> R, (forall t, y (t + 2 * PI) = y t) ->
    ex_RInt (fun t => y t * sin t) 0 (2 * PI) -> ex_RInt (fun t => y t * cos t) 0 (2 * PI) ->
    (Y_P 1 (fun t => y (t - phase)), Y_Q 1 (fun t => y (t - phase))) = delayed (Y_P 1 y, Y_Q 1 y) phase.
Proof.
  intros P Q phase. unfold delayed, fst, snd. pose proof (sin2_cos2' phase) as S. pose proof PI_RGT_0.
  split; [|split; [|split; [|split]]].
  - unfold Cmult, fst, snd. f_equal; ring.
  - unfold Cmod, fst, snd. f_equal. replace ((P * cos phase + Q * sin phase) ^ 2 + (- P * sin phase + Q * cos phase) ^ 2)
      with ((P ^ 2 + Q ^ 2) * (sin phase * sin phase + cos phase * cos phase)) by ring. rewrite S. ring.
  - intros other. rewrite sin_plus, cos_plus. f_equal; ring.
  - rewrite sin_neg, cos_neg. f_equal.
    + transitivity (P * (sin phase * sin phase + cos phase * cos phase)); [ring|rewrite S; ring].
    + transitivity (Q * (sin phase * sin phase + cos phase * cos phase)); [ring|rewrite S; ring].
  - intros y period [s Hs] [c Hc].
    assert (turn : forall f l, is_RInt (fun t => y t * f t) 0 (2 * PI) l -> (forall t, f (t + 2 * PI) = f t) ->
      is_RInt (fun t => y (t - phase) * f (t - phase)) 0 (2 * PI) l).
    { intros f l I Pf. apply (int_eq (fun t => (fun r => y r * f r) (t + - phase)) _ _ _ l); [|intros; reflexivity|reflexivity].
      apply (is_RInt_shift (fun r => y r * f r) (- phase)). replace (2 * PI + - phase) with (0 + - phase + 2 * PI) by ring.
      apply any_turn; [|exact I]. intros t. cbv beta. rewrite period, Pf. reflexivity. }
    pose proof (turn sin s Hs sin_turn) as Ts. pose proof (turn cos c Hc cos_turn) as Tc.
    rewrite (Y_P_of y s Hs), (Y_Q_of y c Hc).
    (* the sum formulas at (t - phase) + phase *)
    assert (Is : is_RInt (fun t => y (t - phase) * sin t) 0 (2 * PI) (cos phase * s + sin phase * c)).
    { eapply int_eq; [exact (int_plus _ _ _ _ _ _ (int_scal _ _ _ (cos phase) _ Ts) (int_scal _ _ _ (sin phase) _ Tc))| |reflexivity].
      intros t. cbv beta. replace (sin t) with (sin (t - phase + phase)) by (f_equal; ring). rewrite sin_plus. ring. }
    assert (Ic : is_RInt (fun t => y (t - phase) * cos t) 0 (2 * PI) (cos phase * c - sin phase * s)).
    { eapply int_eq; [exact (int_minus _ _ _ _ _ _ (int_scal _ _ _ (cos phase) _ Tc) (int_scal _ _ _ (sin phase) _ Ts))| |reflexivity].
      intros t. cbv beta. replace (cos t) with (cos (t - phase + phase)) by (f_equal; ring). rewrite cos_plus. ring. }
    rewrite (Y_P_of _ _ Is), (Y_Q_of _ _ Ic). f_equal; field; lra.
Qed.

(** With the sign of the delay changed it is another turn. *)
Theorem sign_matters : delayed (1, 0) (PI / 2) <> delayed (1, 0) (- (PI / 2)).
Proof.
  unfold delayed, fst, snd. rewrite sin_neg, cos_neg, sin_PI2, cos_PI2. intros E. injection E as E. lra.
Qed.

Print Assumptions statement.
