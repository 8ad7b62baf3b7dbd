(** A thruster in still water as the program has it: two sides, each with dead zone and limit, and the command for a thrust. Shared by
    thruster-affine, thruster-asymmetric and compensation. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common.
Open Scope R_scope.

Record side := { quadratic : R; linear : R; dead_zone : R; limit : R }.

(** Eq. 2 for a command of zero or more. *)
Definition curve (s : side) (n : R) : R := (quadratic s * n + linear s) * n.
Definition side_thrust (s : side) (n : R) : R := if Rlt_dec n (dead_zone s) then 0 else curve s (Rmin n (limit s)).
Definition side_command (s : side) (T : R) : R :=
  let root := sqrt (Rmax (linear s ^ 2 + 4 * quadratic s * T) 0) in
  let n := if Rlt_dec (linear s) 0 then (root - linear s) / (2 * quadratic s)
           else if Rlt_dec 0 T then 2 * T / (linear s + root) else 0 in
  Rmin (Rmax n (dead_zone s)) (limit s).

(** Commands that turn the propeller and that it can follow. *)
Definition turning (s : side) (n : R) : Prop := dead_zone s <= n <= limit s.
(** Thrusts that such commands give. *)
Definition within_reach (s : side) (T : R) : Prop := curve s (dead_zone s) <= T <= curve s (limit s).

(** The hypothesis thrust-grows. Besides what its name says thrust must not be negative at the dead zone. *)
Record grows (s : side) : Prop := {
  magnitudes : 0 <= dead_zone s < limit s;
  forwards : 0 <= curve s (dead_zone s);
  increasing : forall m n, dead_zone s <= m -> m < n -> n <= limit s -> curve s m < curve s n }.

(** The constructor's test implies it. *)
Lemma accepted (s : side) (slope := fun n => 2 * quadratic s * n + linear s) :
  0 <= dead_zone s < limit s -> 0 <= quadratic s * dead_zone s + linear s ->
  0 <= slope (dead_zone s) -> 0 <= slope (limit s) -> 0 < slope (dead_zone s) + slope (limit s) -> grows s.
Proof.
  unfold slope. intros M F S0 S1 S. split; [exact M|unfold curve; nra|]. intros m n Hm mn Hn. unfold curve.
  assert (0 < quadratic s * (n + m) + linear s).
  { (* the slope between the two, linear in their sum *)
    assert (L : limit s - dead_zone s > 0) by lra.
    destruct (Rle_lt_dec 0 (quadratic s)) as [Q|Q].
    - destruct (Req_dec (quadratic s) 0) as [Z|N]; [rewrite Z in *; lra|].
      assert (2 * dead_zone s < n + m) by lra. nra.
    - assert (n + m < 2 * limit s) by lra. nra. }
  nra.
Qed.

Section Side.
Variable s : side.
Hypothesis G : grows s.

Lemma slope_positive n : turning s n -> 0 <= 2 * quadratic s * n + linear s.
Proof.
  intros [N0 N1]. destruct (magnitudes s G) as [M0 M1].
  destruct (Rle_lt_dec 0 (2 * quadratic s * n + linear s)) as [L|L]; [exact L|exfalso].
  assert (step : forall h, h <> 0 -> turning s (n + h) -> 0 < (2 * quadratic s * n + linear s + quadratic s * h)).
  { intros h Hh [T0 T1]. destruct (Rlt_le_dec 0 h) as [P|P].
    - pose proof (increasing s G n (n + h) N0 ltac:(lra) T1) as I. unfold curve in I. nra.
    - pose proof (increasing s G (n + h) n T0 ltac:(lra) N1) as I. unfold curve in I. nra. }
  (* A step so short that the slope does not change its sign. *)
  set (k := - (2 * quadratic s * n + linear s)) in *. assert (K : 0 < k) by (unfold k; lra).
  assert (small : forall h, Rabs h <= k / (2 * (1 + Rabs (quadratic s))) -> quadratic s * h <= k / 2).
  { intros h Hh. pose proof (Rabs_pos (quadratic s)). pose proof (Rle_abs (quadratic s * h)) as A. rewrite Rabs_mult in A.
    assert (B : Rabs (quadratic s) * Rabs h <= Rabs (quadratic s) * (k / (2 * (1 + Rabs (quadratic s))))) by (apply Rmult_le_compat_l; lra).
    assert (D : Rabs (quadratic s) * (k / (2 * (1 + Rabs (quadratic s)))) <= k / 2).
    { replace (Rabs (quadratic s) * (k / (2 * (1 + Rabs (quadratic s))))) with (k / 2 * (Rabs (quadratic s) / (1 + Rabs (quadratic s)))) by (field; lra).
      assert (Rabs (quadratic s) / (1 + Rabs (quadratic s)) < 1) by (apply div_lt_one; lra). nra. }
    lra. }
  set (e := k / (2 * (1 + Rabs (quadratic s)))) in *.
  assert (E : 0 < e) by (unfold e; pose proof (Rabs_pos (quadratic s)); apply Rdiv_lt_0_compat; lra).
  destruct (Rlt_le_dec n (limit s)) as [I|I].
  - set (h := Rmin e (limit s - n)). assert (Hh : 0 < h <= e /\ h <= limit s - n).
    { unfold h. pose proof (Rmin_l e (limit s - n)). pose proof (Rmin_r e (limit s - n)). split; [split; [apply Rmin_pos; lra|lra]|lra]. }
    specialize (step h ltac:(lra) ltac:(unfold turning; lra)). specialize (small h ltac:(rewrite Rabs_right; lra)). unfold k in small; lra.
  - set (h := Rmin e (n - dead_zone s)). assert (Hh : 0 < h <= e /\ h <= n - dead_zone s).
    { unfold h. pose proof (Rmin_l e (n - dead_zone s)). pose proof (Rmin_r e (n - dead_zone s)). split; [split; [apply Rmin_pos; lra|lra]|lra]. }
    specialize (step (- h) ltac:(lra) ltac:(unfold turning; lra)). specialize (small (- h) ltac:(rewrite Rabs_left; lra)). unfold k in small; lra.
Qed.

(** The command for the thrust of a command is that command. *)
Lemma command_of_thrust n : turning s n -> 0 < curve s n -> side_command s (curve s n) = n.
Proof.
  intros N P. pose proof (slope_positive n N) as S. destruct N as [N0 N1]. destruct (magnitudes s G) as [M0 _].
  assert (Hn : 0 < n) by (unfold curve in P; destruct (Req_dec n 0); [subst; lra|lra]).
  assert (F : 0 < quadratic s * n + linear s) by (unfold curve in P; nra).
  assert (R : sqrt (Rmax (linear s ^ 2 + 4 * quadratic s * curve s n) 0) = 2 * quadratic s * n + linear s).
  { replace (linear s ^ 2 + 4 * quadratic s * curve s n) with ((2 * quadratic s * n + linear s) * (2 * quadratic s * n + linear s))
      by (unfold curve; ring). rewrite Rmax_left by nra. apply sqrt_square, S. }
  unfold side_command. rewrite R.
  assert (E : (if Rlt_dec (linear s) 0 then (2 * quadratic s * n + linear s - linear s) / (2 * quadratic s)
    else if Rlt_dec 0 (curve s n) then 2 * curve s n / (linear s + (2 * quadratic s * n + linear s)) else 0) = n).
  { destruct (Rlt_dec (linear s) 0) as [L|L].
    - field. intros Z. rewrite Z in F. lra.
    - destruct (Rlt_dec 0 (curve s n)); [|lra]. unfold curve. field. lra. }
  rewrite E, Rmax_left, Rmin_left; auto.
Qed.

(** Every thrust within reach is that of a command, by continuity. *)
Lemma command_exists T : 0 < T -> within_reach s T -> turning s (side_command s T) /\ curve s (side_command s T) = T.
Proof.
  intros P [T0 T1]. destruct (magnitudes s G) as [M0 M1].
  destruct (IVT_gen (curve s) (dead_zone s) (limit s) T) as [n [[N0 N1] E]].
  - intros x. apply (continuity_of_derive (curve s) x (2 * quadratic s * x + linear s)). unfold curve. auto_derive; [trivial|ring].
  - assert (curve s (dead_zone s) <= curve s (limit s)) by lra. rewrite Rmin_left, Rmax_right; lra.
  - rewrite Rmin_left, Rmax_right in * by lra.
    rewrite <- E. rewrite command_of_thrust; [|split; assumption|rewrite E; exact P]. split; [split; assumption|reflexivity].
Qed.

Lemma turning_thrust n : turning s n -> side_thrust s n = curve s n.
Proof. intros [N0 N1]. unfold side_thrust. destruct (Rlt_dec n (dead_zone s)); [lra|]. now rewrite Rmin_left. Qed.

Lemma turning_forwards n : turning s n -> 0 <= curve s n.
Proof.
  intros [N0 N1]. destruct (Req_dec n (dead_zone s)) as [->|N]; [apply (forwards s G)|].
  left. apply Rle_lt_trans with (curve s (dead_zone s)); [apply (forwards s G)|apply (increasing s G); lra].
Qed.

Lemma same_command m n : turning s m -> turning s n -> curve s m = curve s n -> m = n.
Proof.
  intros [M0 M1] [N0 N1] E. destruct (Rtotal_order m n) as [L|[L|L]]; [|exact L|].
  - pose proof (increasing s G m n M0 L N1). lra.
  - pose proof (increasing s G n m N0 L M1). lra.
Qed.
Lemma turning_reach n : turning s n -> within_reach s (curve s n).
Proof.
  intros [N0 N1]. split.
  - destruct N0 as [L| <-]; [left; apply (increasing s G); lra|lra].
  - destruct N1 as [L| ->]; [left; apply (increasing s G); lra|lra].
Qed.
End Side.

(** Eq. 3: one side for [n > 0] and one for [n <= 0], and the command for a thrust. *)
Record thruster := { forward : side; backward : side }.
Definition thrust (t : thruster) (n : R) : R :=
  if Rlt_dec n 0 then - side_thrust (backward t) (- n) else side_thrust (forward t) n.
Definition command (t : thruster) (T : R) : R :=
  if Req_EM_T T 0 then 0 else if Rlt_dec T 0 then - side_command (backward t) (- T) else side_command (forward t) T.

(** On the side of either sign: commands and thrusts. *)
Definition turns (t : thruster) (n : R) : Prop := 0 < n /\ turning (forward t) n \/ n < 0 /\ turning (backward t) (- n).
Definition reaches (t : thruster) (T : R) : Prop := 0 < T /\ within_reach (forward t) T \/ T < 0 /\ within_reach (backward t) (- T).

Lemma thrust_found (t : thruster) (T : R) : grows (forward t) -> grows (backward t) -> reaches t T ->
  turns t (command t T) /\ thrust t (command t T) = T.
Proof.
  assert (pos : forall s, grows s -> forall n, turning s n -> 0 < curve s n -> 0 < n).
  { intros s [[M _] _ _] n [N0 _] P. unfold curve in P. destruct (Req_dec n 0); [subst; lra|lra]. }
  intros GF GB [[P W]|[P W]]; unfold command; destruct (Req_EM_T T 0); try lra; destruct (Rlt_dec T 0); try lra.
  - destruct (command_exists (forward t) GF T P W) as [N E].
    assert (0 < side_command (forward t) T) by (apply (pos (forward t) GF); [exact N|lra]).
    split; [left; split; assumption|]. unfold thrust. destruct (Rlt_dec _ 0); [lra|]. rewrite turning_thrust; assumption.
  - destruct (command_exists (backward t) GB (- T) ltac:(lra) W) as [N E].
    assert (0 < side_command (backward t) (- T)) by (apply (pos (backward t) GB); [exact N|lra]).
    split; [right; rewrite Ropp_involutive; split; [lra|assumption]|]. unfold thrust. destruct (Rlt_dec _ 0); [|lra].
    rewrite Ropp_involutive, turning_thrust by assumption. lra.
Qed.

Lemma thrust_by_side (t : thruster) (n : R) : turns t n ->
  thrust t n = if Rlt_dec n 0 then - curve (backward t) (- n) else curve (forward t) n.
Proof.
  intros [[P N]|[P N]]; unfold thrust; destruct (Rlt_dec n 0); try lra; now rewrite turning_thrust.
Qed.

Lemma one_command (t : thruster) (m n : R) : grows (forward t) -> grows (backward t) -> turns t m -> turns t n -> thrust t m <> 0 ->
  thrust t m = thrust t n -> m = n.
Proof.
  intros GF GB M N Z E. rewrite (thrust_by_side t m M) in Z, E. rewrite (thrust_by_side t n N) in E.
  destruct M as [[M0 M]|[M0 M]], N as [[N0 N]|[N0 N]]; destruct (Rlt_dec m 0), (Rlt_dec n 0); try lra.
  - apply (same_command (forward t)); assumption.
  - pose proof (turning_forwards _ GF m M). pose proof (turning_forwards _ GB (- n) N). lra.
  - pose proof (turning_forwards _ GB (- m) M). pose proof (turning_forwards _ GF n N). lra.
  - assert (- m = - n) by (apply (same_command (backward t)); try assumption; lra). lra.
Qed.
