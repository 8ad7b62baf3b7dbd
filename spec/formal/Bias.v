(** The method's bias along the coordinate that unrolls the orbit: near zero, and up to [g = 10]. Shared by method-bias-alpha-linear,
    -beta-linear, -alpha-quadratic and -beta-quadratic. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Hyperbolic Claim_method_bias.
From Selfosc Require Claim_orbit_linear Claim_orbit_quadratic.
Open Scope R_scope.

(** * Bounds near zero, by the sign of a derivative *)

Lemma below_by_slope (f f' : R -> R) z : 0 <= z -> f 0 = 0 -> (forall x, 0 <= x <= z -> is_derive f x (f' x)) -> (forall x, 0 < x < z -> 0 <= f' x) -> 0 <= f z.
Proof.
  intros Hz F0 D P. rewrite <- F0. apply (does_not_fall f f'); [exact Hz| | |exact P]; intros x Hx; [apply D; lra|].
  apply (continuity_of_derive f x (f' x)), D. lra.
Qed.

Lemma tanh_nonneg z : 0 <= z -> 0 <= tanh z.
Proof. intros [H| <-]; [pose proof (tanh_range z H); lra|rewrite tanh_0; lra]. Qed.

Lemma tanh_le z : 0 <= z -> tanh z <= z.
Proof.
  intros H. assert (0 <= z - tanh z); [|lra].
  apply (below_by_slope (fun z => z - tanh z) (fun z => tanh z * tanh z)); [exact H|rewrite tanh_0; ring| |].
  - intros x _. apply excess_derive.
  - intros x Hx. pose proof (tanh_nonneg x). nra.
Qed.

Lemma excess_le z : 0 <= z -> z - tanh z <= z ^ 3 / 3.
Proof.
  intros H. assert (0 <= z ^ 3 / 3 - (z - tanh z)); [|lra].
  apply (below_by_slope (fun z => z ^ 3 / 3 - (z - tanh z)) (fun z => z ^ 2 - tanh z * tanh z)); [exact H|rewrite tanh_0; field| |].
  - intros x _. apply (is_derive_minus (fun z => z ^ 3 / 3) (fun z => z - tanh z)); [auto_derive; [trivial|field]|apply excess_derive].
  - intros x Hx. pose proof (tanh_nonneg x ltac:(lra)). pose proof (tanh_le x ltac:(lra)). nra.
Qed.

Lemma excess_ge z : 0 <= z <= 1 -> z ^ 3 / 3 - 2 * z ^ 5 / 15 <= z - tanh z.
Proof.
  intros H. assert (0 <= (z - tanh z) - (z ^ 3 / 3 - 2 * z ^ 5 / 15)); [|lra].
  apply (below_by_slope (fun z => (z - tanh z) - (z ^ 3 / 3 - 2 * z ^ 5 / 15)) (fun z => tanh z * tanh z - (z ^ 2 - 2 * z ^ 4 / 3))); [lra|rewrite tanh_0; field| |].
  - intros x _. apply (is_derive_minus (fun z => z - tanh z) (fun z => z ^ 3 / 3 - 2 * z ^ 5 / 15)); [apply excess_derive|auto_derive; [trivial|field]].
  - intros x Hx. pose proof (excess_le x ltac:(lra)) as E. assert (P : 0 <= x - x ^ 3 / 3) by nra.
    assert (Q : (x - x ^ 3 / 3) * (x - x ^ 3 / 3) <= tanh x * tanh x) by (apply Rmult_le_compat; lra).
    assert (0 <= (x ^ 3) * (x ^ 3)) by nra. replace ((x - x ^ 3 / 3) * (x - x ^ 3 / 3)) with (x ^ 2 - 2 * x ^ 4 / 3 + x ^ 3 * x ^ 3 / 9) in Q by field. lra.
Qed.

(** [size_linear z = ln (cosh z)]: its slope is [tanh z]. *)
Lemma size_derive z : 0 <= z -> is_derive size_linear z (tanh z).
Proof.
  intros H. pose proof (tanh_nonneg z H) as T.
  assert (D : is_derive (fun t => ln (1 + t)) (tanh z) (/ (1 + tanh z))) by (auto_derive; [lra|field; lra]).
  pose proof (is_derive_comp (fun t => ln (1 + t)) tanh z _ _ D (tanh_derive z)) as E.
  pose proof (is_derive_minus (fun z => z) (fun z => ln (1 + tanh z)) z _ _ (is_derive_id (K := R_AbsRing) z) E) as F.
  revert F. unfold minus, plus, opp, scal, one; simpl; unfold mult; simpl. intros F.
  match type of F with is_derive _ _ ?l => replace l with (tanh z) in F by (field; lra) end. exact F.
Qed.

Lemma size_0 : size_linear 0 = 0.
Proof. unfold size_linear. rewrite tanh_0, Rplus_0_r, ln_1. ring. Qed.

Lemma size_le z : 0 <= z -> size_linear z <= z ^ 2 / 2.
Proof.
  intros H. assert (0 <= z ^ 2 / 2 - size_linear z); [|lra].
  apply (below_by_slope (fun z => z ^ 2 / 2 - size_linear z) (fun z => z - tanh z)); [exact H|rewrite size_0; field| |].
  - intros x Hx. apply (is_derive_minus (fun z => z ^ 2 / 2) size_linear); [auto_derive; [trivial|field]|apply size_derive; lra].
  - intros x Hx. pose proof (tanh_le x). lra.
Qed.

Lemma size_ge z : 0 <= z -> z ^ 2 / 2 - z ^ 4 / 12 <= size_linear z.
Proof.
  intros H. assert (0 <= size_linear z - (z ^ 2 / 2 - z ^ 4 / 12)); [|lra].
  apply (below_by_slope (fun z => size_linear z - (z ^ 2 / 2 - z ^ 4 / 12)) (fun z => tanh z - (z - z ^ 3 / 3))); [exact H|rewrite size_0; field| |].
  - intros x Hx. apply (is_derive_minus size_linear (fun z => z ^ 2 / 2 - z ^ 4 / 12)); [apply size_derive; lra|auto_derive; [trivial|field]].
  - intros x Hx. pose proof (excess_le x). lra.
Qed.

Lemma size_le_sharp z : 0 <= z <= 1 -> size_linear z <= z ^ 2 / 2 - z ^ 4 / 12 + z ^ 6 / 45.
Proof.
  intros H. assert (0 <= z ^ 2 / 2 - z ^ 4 / 12 + z ^ 6 / 45 - size_linear z); [|lra].
  apply (below_by_slope (fun z => z ^ 2 / 2 - z ^ 4 / 12 + z ^ 6 / 45 - size_linear z) (fun z => z - z ^ 3 / 3 + 2 * z ^ 5 / 15 - tanh z)); [lra|rewrite size_0; field| |].
  - intros x Hx. apply (is_derive_minus (fun z => z ^ 2 / 2 - z ^ 4 / 12 + z ^ 6 / 45) size_linear); [auto_derive; [trivial|field]|apply size_derive; lra].
  - intros x Hx. pose proof (excess_ge x). lra.
Qed.

(** Quotients near zero: [r = z^2/size] is near 2, [q = g/size] near [2 z/3]. *)
Lemma near_zero_linear z : 0 < z <= 1 / 4 -> let r := z ^ 2 / size_linear z in let q := (z - tanh z) / size_linear z in
  2 <= r <= 2 + 2 * z ^ 2 / 5 /\ 0 <= q <= z /\ 2 / 3 - z ^ 2 <= q / z <= 2 / 3 + 2 * z ^ 2 / 15.
Proof.
  intros Hz r q. pose proof (size_linear_positive z ltac:(lra)) as S0. pose proof (size_le z ltac:(lra)) as S1. pose proof (size_ge z ltac:(lra)) as S2.
  pose proof (excess_le z ltac:(lra)) as E1. pose proof (excess_ge z ltac:(lra)) as E2.
  assert (Z2 : 0 < z ^ 2 <= 1 / 16) by (split; nra). assert (Z3 : 0 < z ^ 3) by (apply pow_lt; lra).
  assert (R1 : r * size_linear z = z ^ 2) by (unfold r; field; lra). assert (Q1 : q / z * (z * size_linear z) = z - tanh z) by (unfold q; field; lra).
  assert (QZ : q = q / z * z) by (field; lra).
  assert (B : 2 / 3 - z ^ 2 <= q / z <= 2 / 3 + 2 * z ^ 2 / 15).
  { split.
    - apply (Rmult_le_reg_r (z * size_linear z)); [nra|]. rewrite Q1.
      apply Rle_trans with ((2 / 3 - z ^ 2) * (z * (z ^ 2 / 2))); [apply Rmult_le_compat_l; [lra|apply Rmult_le_compat_l; lra]|].
      apply Rle_trans with (2 := E2). replace ((2 / 3 - z ^ 2) * (z * (z ^ 2 / 2))) with (z ^ 3 / 3 - z ^ 5 / 2) by field.
      assert (0 < z ^ 5) by (apply pow_lt; lra). lra.
    - apply (Rmult_le_reg_r (z * size_linear z)); [nra|]. rewrite Q1.
      apply Rle_trans with ((2 / 3 + 2 * z ^ 2 / 15) * (z * (z ^ 2 / 2 - z ^ 4 / 12))); [|apply Rmult_le_compat_l; [lra|apply Rmult_le_compat_l; lra]].
      apply Rle_trans with (1 := E1).
      replace ((2 / 3 + 2 * z ^ 2 / 15) * (z * (z ^ 2 / 2 - z ^ 4 / 12))) with (z ^ 3 / 3 + z ^ 3 * (z ^ 2) * (1 / 90 - z ^ 2 / 90)) by field.
      assert (0 < z ^ 3 * z ^ 2) by nra. assert (0 < 1 / 90 - z ^ 2 / 90) by lra. nra. }
  split; [|split; [|exact B]].
  - split.
    + apply (Rmult_le_reg_r (size_linear z)); [exact S0|]. rewrite R1. lra.
    + apply (Rmult_le_reg_r (size_linear z)); [exact S0|]. rewrite R1.
      apply Rle_trans with ((2 + 2 * z ^ 2 / 5) * (z ^ 2 / 2 - z ^ 4 / 12)); [|apply Rmult_le_compat_l; lra].
      replace ((2 + 2 * z ^ 2 / 5) * (z ^ 2 / 2 - z ^ 4 / 12)) with (z ^ 2 + z ^ 2 * z ^ 2 * (1 / 30 - z ^ 2 / 30)) by field.
      assert (0 <= z ^ 2 * z ^ 2 * (1 / 30 - z ^ 2 / 30)) by (apply Rmult_le_pos; nra). lra.
  - rewrite QZ. split; nra.
Qed.

(** A form in which the coordinate occurs once in the hyperbolic tangent, for enclosures. *)
Lemma tanh_once z : tanh z = 1 - 2 / (exp (2 * z) + 1).
Proof.
  rewrite tanh_is, exp_Ropp. replace (2 * z) with (z + z) by ring. rewrite exp_plus. pose proof (exp_pos z). field. split; nra.
Qed.

(** A root of [z - tanh z = g] between two numbers. *)
Lemma root_between z low high : 0 < z -> 0 <= low -> low - tanh low < z - tanh z -> z - tanh z < high - tanh high -> 0 < high -> low < z < high.
Proof.
  intros Hz L A B H. split.
  - destruct (Rlt_le_dec low z) as [Q|[Q|Q]]; [exact Q| |]; [pose proof (Claim_orbit_linear.root_increases z low ltac:(lra) Q)|subst]; lra.
  - destruct (Rlt_le_dec z high) as [Q|[Q|Q]]; [exact Q| |]; [pose proof (Claim_orbit_linear.root_increases high z ltac:(lra) Q)|subst]; lra.
Qed.

(** * Quadratic drag, unrolled by t with [y = tanh t] and [g = size_linear t/2] *)

Definition turn (t : R) : R := atan (sqrt (tanh t)) + atanh (sqrt (tanh t)).
Definition alpha_by_t (t : R) : R := 8 * turn t ^ 2 / (PI ^ 3 * t) * sqrt (1 - (size_linear t / t) ^ 2) - 1.
Definition beta_by_t (t : R) : R := 6 * size_linear t * turn t ^ 2 / (PI ^ 2 * t ^ 3) - 1.

Lemma unroll_quadratic g : 0 < g -> exists t, 0 < t /\ size_linear t = 2 * g /\ error_alpha_quadratic g = alpha_by_t t /\ error_beta_quadratic g = beta_by_t t.
Proof.
  intros G. destruct (Claim_orbit_quadratic.y_range g G) as [[Y0 Y1] YY]. set (y := Claim_orbit_quadratic.y g) in *.
  exists (atanh y). pose proof (atanh_positive y ltac:(lra)) as T0. assert (E : tanh (atanh y) = y) by (apply tanh_atanh; lra).
  pose proof (atanh_tanh (atanh y) T0) as L. rewrite E in L.
  assert (S : size_linear (atanh y) = 2 * g).
  { unfold size_linear. rewrite E. assert (P : ln (1 - y) + ln (1 + y) = - (4 * g)).
    { rewrite <- ln_mult by lra. replace ((1 - y) * (1 + y)) with (exp (- (4 * g))) by lra. apply ln_exp. }
    lra. }
  assert (A : amplitude_quadratic g = atanh y / 2) by (unfold amplitude_quadratic; fold y; unfold size_linear in S; rewrite E in S; lra).
  assert (Tq : turn_quadratic g = turn (atanh y)) by (unfold turn_quadratic, turn; fold y; rewrite E; reflexivity).
  pose proof PI_RGT_0. split; [exact T0|]. split; [exact S|]. unfold error_alpha_quadratic, error_beta_quadratic, alpha_by_t, beta_by_t. rewrite A, Tq, S. split.
  - replace (g / (atanh y / 2)) with (2 * g / atanh y) by (field; lra). set (q := sqrt (1 - _)). field. lra.
  - field. lra.
Qed.

Lemma size_increases s t : 0 <= s -> s < t -> size_linear s < size_linear t.
Proof.
  intros S st. apply (increases size_linear tanh); [exact st| | |]; intros x Hx.
  - apply size_derive. lra.
  - apply (continuity_of_derive size_linear x (tanh x)), size_derive. lra.
  - apply (tanh_range x). lra.
Qed.

(** [atan s + atanh s] is near [2 s]. *)
Lemma turn_bounds s : 0 <= s <= 1 / 2 -> 2 * s <= atan s + atanh s <= 2 * s + s ^ 5 / 2.
Proof.
  intros H. assert (D : forall x, 0 <= x <= 1 / 2 -> is_derive (fun s => atan s + atanh s) x (2 / (1 - x ^ 4))).
  { intros x Hx. assert (0 < 1 - x * x) by nra. assert (0 < 1 - x ^ 4) by (replace (x ^ 4) with (x * x * (x * x)) by ring; nra). unfold atanh.
    auto_derive; [repeat split; [lra|apply Rdiv_lt_0_compat; lra]|]. field. repeat split; nra. }
  assert (Z : atan 0 + atanh 0 = 0) by (unfold atanh; rewrite atan_0; replace ((1 + 0) / (1 - 0)) with 1 by field; rewrite ln_1; field).
  assert (W : forall x, 0 <= x <= 1 / 2 -> 0 <= x ^ 4 <= 1 / 16 /\ 0 < 1 - x ^ 4).
  { intros x Hx. assert (0 <= x * x <= 1 / 4) by nra. replace (x ^ 4) with (x * x * (x * x)) by ring. split; nra. }
  split.
  - assert (0 <= atan s + atanh s - 2 * s); [|lra].
    apply (below_by_slope (fun s => atan s + atanh s - 2 * s) (fun x => 2 / (1 - x ^ 4) - 2)); [lra|lra| |].
    + intros x Hx. apply (is_derive_minus (fun s => atan s + atanh s) (fun s => 2 * s)); [apply D; lra|auto_derive; [trivial|ring]].
    + intros x Hx. destruct (W x ltac:(lra)) as [W1 W2]. assert (2 <= 2 / (1 - x ^ 4)); [|lra].
      apply (Rmult_le_reg_r (1 - x ^ 4)); [exact W2|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
  - assert (0 <= 2 * s + s ^ 5 / 2 - (atan s + atanh s)); [|lra].
    apply (below_by_slope (fun s => 2 * s + s ^ 5 / 2 - (atan s + atanh s)) (fun x => 2 + 5 * x ^ 4 / 2 - 2 / (1 - x ^ 4))); [lra|lra| |].
    + intros x Hx. apply (is_derive_minus (fun s => 2 * s + s ^ 5 / 2) (fun s => atan s + atanh s)); [auto_derive; [trivial|field]|apply D; lra].
    + intros x Hx. destruct (W x ltac:(lra)) as [W1 W2]. assert (2 / (1 - x ^ 4) <= 2 + 5 * x ^ 4 / 2); [|lra].
      apply (Rmult_le_reg_r (1 - x ^ 4)); [exact W2|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. nra.
Qed.

(** Quotients near zero: [turn^2/t] is near 4, [size/t] near [t/2]. *)
Lemma near_zero_quadratic t : 0 < t <= 1 / 5 -> let r := turn t ^ 2 / t in let q := size_linear t / t in
  4 - 4 * t ^ 2 / 3 <= r <= 4 + 2 * t ^ 2 / 3 + t ^ 4 /\ 0 <= q <= t / 2 /\ 1 / 2 - t ^ 2 / 12 <= q / t <= 1 / 2 - t ^ 2 / 12 + t ^ 4 / 45.
Proof.
  intros Ht r q. pose proof (tanh_range t ltac:(lra)) as [T0 T1]. pose proof (tanh_le t ltac:(lra)) as T2. pose proof (excess_le t ltac:(lra)) as T3.
  pose proof (excess_ge t ltac:(lra)) as T5. pose proof (size_le t ltac:(lra)) as S1. pose proof (size_le_sharp t ltac:(lra)) as S3.
  pose proof (size_ge t ltac:(lra)) as S2. pose proof (size_linear_positive t ltac:(lra)) as S0.
  set (s := sqrt (tanh t)). assert (SS : s * s = tanh t) by (apply sqrt_sqrt; lra). assert (P : 0 < s) by (apply sqrt_lt_R0; lra).
  assert (U : s <= 1 / 2) by nra. pose proof (turn_bounds s ltac:(lra)) as [B1 B2]. change (atan s + atanh s) with (turn t) in B1, B2.
  assert (T4 : 0 < t ^ 2 <= 1 / 25) by (split; nra).
  assert (B3 : s ^ 5 <= s * t ^ 2).
  { replace (s ^ 5) with (s * (s * s * (s * s))) by ring. rewrite SS. apply Rmult_le_compat_l; [lra|]. replace (t ^ 2) with (t * t) by ring. apply Rmult_le_compat; lra. }
  assert (R1 : 4 * tanh t <= turn t ^ 2).
  { replace (4 * tanh t) with (2 * s * (2 * s)) by (rewrite <- SS; ring). replace (turn t ^ 2) with (turn t * turn t) by ring. apply Rmult_le_compat; lra. }
  assert (R2 : turn t ^ 2 <= tanh t * ((2 + t ^ 2 / 2) * (2 + t ^ 2 / 2))).
  { replace (tanh t * ((2 + t ^ 2 / 2) * (2 + t ^ 2 / 2))) with (s * (2 + t ^ 2 / 2) * (s * (2 + t ^ 2 / 2))) by (rewrite <- SS; ring).
    replace (turn t ^ 2) with (turn t * turn t) by ring. apply Rmult_le_compat; lra. }
  assert (R3 : turn t ^ 2 <= t * (4 + 2 * t ^ 2 / 3 + t ^ 4)).
  { apply Rle_trans with (1 := R2). apply Rle_trans with (t * (1 - t ^ 2 / 3 + 2 * t ^ 4 / 15) * ((2 + t ^ 2 / 2) * (2 + t ^ 2 / 2))).
    - apply Rmult_le_compat_r; [apply Rmult_le_pos; lra|]. replace (t * (1 - t ^ 2 / 3 + 2 * t ^ 4 / 15)) with (t - (t ^ 3 / 3 - 2 * t ^ 5 / 15)) by field. lra.
    - rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|]. replace (t ^ 4) with (t ^ 2 * t ^ 2) by ring. set (w := t ^ 2) in *.
      assert (W2 : 0 <= w * w <= 1 / 25) by (split; nra).
      assert (W3 : 0 <= w * w * w <= w * w / 25) by (split; [apply Rmult_le_pos; lra|apply (Rmult_le_compat_l (w * w)) with (r1 := w); lra]).
      assert (W4 : 0 <= w * w * (w * w) <= w * w / 25) by (split; [apply Rmult_le_pos; lra|apply (Rmult_le_compat_l (w * w)) with (r1 := w * w); lra]). lra. }
  split; [split|split].
  - apply (Rmult_le_reg_r t); [lra|]. unfold r. replace (turn t ^ 2 / t * t) with (turn t ^ 2) by (field; lra). lra.
  - apply (Rmult_le_reg_r t); [lra|]. unfold r. replace (turn t ^ 2 / t * t) with (turn t ^ 2) by (field; lra). lra.
  - split; apply (Rmult_le_reg_r t); try lra; unfold q; replace (size_linear t / t * t) with (size_linear t) by (field; lra); lra.
  - assert (Q : q / t * t ^ 2 = size_linear t) by (unfold q; field; lra).
    split; apply (Rmult_le_reg_r (t ^ 2)); try lra; rewrite Q; lra.
Qed.

Lemma turn_once t : 0 < t -> turn t = atan (sqrt (1 - 2 / (exp (2 * t) + 1))) + (ln (1 + sqrt (1 - 2 / (exp (2 * t) + 1))) + ln ((exp (2 * t) + 1) / 2) / 2).
Proof.
  intros Ht. pose proof (tanh_range t Ht) as [T0 T1]. unfold turn. rewrite <- tanh_once. f_equal. set (s := sqrt (tanh t)).
  assert (SS : s * s = tanh t) by (apply sqrt_sqrt; lra). assert (P : 0 < s) by (apply sqrt_lt_R0; lra). assert (U : s < 1) by nra.
  pose proof (exp_pos (2 * t)) as E. pose proof (tanh_once t) as O.
  unfold atanh. assert (M : (1 + s) / (1 - s) = (1 + s) * (1 + s) * ((exp (2 * t) + 1) / 2)).
  { apply (Rmult_eq_reg_r ((1 - s) * (2 / (exp (2 * t) + 1)))); [|apply Rgt_not_eq, Rmult_lt_0_compat; [lra|apply Rdiv_lt_0_compat; lra]].
    replace ((1 + s) / (1 - s) * ((1 - s) * (2 / (exp (2 * t) + 1)))) with ((1 + s) * (2 / (exp (2 * t) + 1))) by (field; lra).
    replace (2 / (exp (2 * t) + 1)) with (1 - s * s) at 1 by (rewrite SS; lra). field. lra. }
  assert (E2 : 0 < (exp (2 * t) + 1) / 2) by lra. assert (S2 : 0 < 1 + s) by lra. assert (S3 : 0 < (1 + s) * (1 + s)) by (apply Rmult_lt_0_compat; lra).
  rewrite M, (ln_mult ((1 + s) * (1 + s))), (ln_mult (1 + s)) by assumption. field.
Qed.

(** A root of [size_linear t = 2 g] between two numbers. *)
Lemma size_root_between t low high : 0 < t -> 0 <= low -> size_linear low < size_linear t -> size_linear t < size_linear high -> 0 < high -> low < t < high.
Proof.
  intros Ht L A B H. split.
  - destruct (Rlt_le_dec low t) as [Q|[Q|Q]]; [exact Q| |]; [pose proof (size_increases t low ltac:(lra) Q)|subst]; lra.
  - destruct (Rlt_le_dec t high) as [Q|[Q|Q]]; [exact Q| |]; [pose proof (size_increases high t ltac:(lra) Q)|subst]; lra.
Qed.

(** Between [1 - q^2] and 1. *)
Lemma sqrt_near_one q : 0 <= q <= 1 -> 1 - q ^ 2 <= sqrt (1 - q ^ 2) <= 1.
Proof.
  intros H. assert (P : 0 <= 1 - q ^ 2 <= 1) by (split; nra). pose proof (sqrt_pos (1 - q ^ 2)) as S. pose proof (sqrt_sqrt _ (proj1 P)) as E.
  assert (S1 : sqrt (1 - q ^ 2) <= 1) by (pose proof (sqrt_le_1 (1 - q ^ 2) 1 ltac:(lra) ltac:(lra) ltac:(lra)) as L; rewrite sqrt_1 in L; exact L).
  assert (S2 : sqrt (1 - q ^ 2) * sqrt (1 - q ^ 2) <= sqrt (1 - q ^ 2) * 1) by (apply Rmult_le_compat_l; assumption). split; [lra|exact S1].
Qed.
