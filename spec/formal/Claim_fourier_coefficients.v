(** claim: fourier-coefficients (eqs. 7-11)
    Mean and first harmonic of an output are the constant and the sinusoid nearest to it in the mean square: with any other constant
    and sinusoid more is left, by the mean square of the differences. Nothing is asked of the output but a mean square and
    coefficients. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

(** What a constant and a sinusoid leave of the output, squared. *)
Definition left_over (y : R -> R) (m p q : R) (t : R) : R := (y t - m - p * sin t - q * cos t) ^ 2.

(** Parseval: the integral of what is left, for any constant and sinusoid. *)
Lemma what_is_left (y : R -> R) (a s c square m p q : R) :
  is_RInt y 0 (2 * PI) a -> is_RInt (fun t => y t * sin t) 0 (2 * PI) s -> is_RInt (fun t => y t * cos t) 0 (2 * PI) c ->
  is_RInt (fun t => y t ^ 2) 0 (2 * PI) square ->
  is_RInt (left_over y m p q) 0 (2 * PI)
    (square - 2 * m * a - 2 * p * s - 2 * q * c + 2 * PI * m ^ 2 + PI * p ^ 2 + PI * q ^ 2).
Proof.
  intros A S C Q.
  pose proof (int_plus _ _ _ _ _ _ (int_minus _ _ _ _ _ _ (int_minus _ _ _ _ _ _ (int_minus _ _ _ _ _ _ Q
    (int_scal _ _ _ (2 * m) _ A)) (int_scal _ _ _ (2 * p) _ S)) (int_scal _ _ _ (2 * q) _ C))
    (int_plus _ _ _ _ _ _ (int_plus _ _ _ _ _ _ (int_const (m ^ 2) 0 (2 * PI)) (int_scal _ _ _ (2 * m * p) _ turn_of_sin))
    (int_plus _ _ _ _ _ _ (int_plus _ _ _ _ _ _ (int_scal _ _ _ (2 * m * q) _ turn_of_cos) (int_scal _ _ _ (2 * p * q) _ turn_of_sin_cos))
    (int_plus _ _ _ _ _ _ (int_scal _ _ _ (p ^ 2) _ turn_of_sin2) (int_scal _ _ _ (q ^ 2) _ turn_of_cos2))))) as I.
  apply (int_eq _ _ _ _ _ _ I); [intros t; unfold left_over; ring|ring].
Qed.

Theorem statement : forall (y : R -> R),
  ex_RInt y 0 (2 * PI) -> ex_RInt (fun t => y t * sin t) 0 (2 * PI) -> ex_RInt (fun t => y t * cos t) 0 (2 * PI) ->
  ex_RInt (fun t => y t ^ 2) 0 (2 * PI) ->
  (* the coefficients, and the mean square that they leave *)
  RInt (left_over y (Y_0 y) (Y_P 1 y) (Y_Q 1 y)) 0 (2 * PI) / (2 * PI) =
    RInt (fun t => y t ^ 2) 0 (2 * PI) / (2 * PI) - Y_0 y ^ 2 - (Y_P 1 y ^ 2 + Y_Q 1 y ^ 2) / 2 /\
  (* any others leave more *)
  forall m p q : R,
  RInt (left_over y m p q) 0 (2 * PI) / (2 * PI) =
    RInt (left_over y (Y_0 y) (Y_P 1 y) (Y_Q 1 y)) 0 (2 * PI) / (2 * PI)
    + (m - Y_0 y) ^ 2 + ((p - Y_P 1 y) ^ 2 + (q - Y_Q 1 y) ^ 2) / 2.
Proof.
  intros y [a A] [s S] [c C] [square Q]. pose proof PI_RGT_0.
  rewrite (Y_0_of y a A), (Y_P_of y s S), (Y_Q_of y c C).
  rewrite (int_unique _ _ _ _ (what_is_left y a s c square _ _ _ A S C Q)), (int_unique _ _ _ _ Q).
  split; [field; lra|]. intros m p q.
  rewrite (int_unique _ _ _ _ (what_is_left y a s c square _ _ _ A S C Q)). field. lra.
Qed.

(** Coefficients halved, the normalisation [1/(2 pi)] throughout, leave more of a sine. *)
Theorem halved_coefficients_leave_more :
  RInt (left_over sin 0 (1 / 2) 0) 0 (2 * PI) <> RInt (left_over sin (Y_0 sin) (Y_P 1 sin) (Y_Q 1 sin)) 0 (2 * PI).
Proof.
  pose proof PI_RGT_0.
  pose proof (what_is_left sin 0 PI 0 PI) as L.
  assert (Q : is_RInt (fun t => sin t ^ 2) 0 (2 * PI) PI).
  { apply (int_eq _ _ _ _ _ _ turn_of_sin2); [intros; ring|reflexivity]. }
  rewrite (Y_0_of sin 0 turn_of_sin), (Y_P_of sin PI turn_of_sin2), (Y_Q_of sin 0 turn_of_sin_cos).
  rewrite (int_unique _ _ _ _ (L (0) (1 / 2) 0 turn_of_sin turn_of_sin2 turn_of_sin_cos Q)).
  rewrite (int_unique _ _ _ _ (L (0 / (2 * PI)) (PI / PI) (0 / PI) turn_of_sin turn_of_sin2 turn_of_sin_cos Q)).
  intros E. field_simplify in E; try lra.
Qed.

Print Assumptions statement.
