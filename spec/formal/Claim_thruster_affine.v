(** claim: thruster-affine (eq. 2)
    In still water the thrust is [a abs(n) n + b n], odd in the command n. Each thrust within reach has one command; for the simplest
    thruster, [b = 0], it is [sgn(T) sqrt(abs(T)/a)]. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Thruster.
Open Scope R_scope.

Definition affine (s : side) : thruster := {| forward := s; backward := s |}.

(** turning and within-limit are in [dead_zone s <= Rabs n <= limit s]; thrust-grows is [grows s]. *)
Theorem statement : forall s : side, grows s ->
  let a := quadratic s in let b := linear s in
  (forall n, dead_zone s <= Rabs n <= limit s -> thrust (affine s) n = a * Rabs n * n + b * n) /\
  (forall n, thrust (affine s) (- n) = - thrust (affine s) n) /\
  (forall T, T <> 0 -> within_reach s (Rabs T) ->
    exists! n, dead_zone s <= Rabs n <= limit s /\ thrust (affine s) n = T) /\
  (forall T, T <> 0 -> within_reach s (Rabs T) -> thrust (affine s) (command (affine s) T) = T) /\
  (forall T, b = 0 -> 0 < a -> T <> 0 -> within_reach s (Rabs T) -> command (affine s) T = sign T * sqrt (Rabs T / a)).
Proof.
  intros s G a b. pose proof (magnitudes s G) as M.
  assert (turns_is : forall n, n <> 0 -> dead_zone s <= Rabs n <= limit s -> turns (affine s) n).
  { intros n N. unfold Rabs. destruct (Rcase_abs n); intros H; [right|left]; (split; [lra|exact H]). }
  assert (turns_back : forall n, turns (affine s) n -> dead_zone s <= Rabs n <= limit s).
  { intros n [[P N]|[P N]]; simpl in N; [rewrite Rabs_right by lra|rewrite Rabs_left by lra]; exact N. }
  assert (reaches_is : forall T, T <> 0 -> within_reach s (Rabs T) -> reaches (affine s) T).
  { intros T N. unfold Rabs. destruct (Rcase_abs T); intros H; [right|left]; (split; [lra|exact H]). }
  assert (at_zero : thrust (affine s) 0 = 0).
  { unfold thrust, side_thrust. simpl. destruct (Rlt_dec 0 0); [lra|]. destruct (Rlt_dec 0 (dead_zone s)); [reflexivity|].
    rewrite Rmin_left by lra. unfold curve. ring. }
  assert (form : forall n, dead_zone s <= Rabs n <= limit s -> thrust (affine s) n = a * Rabs n * n + b * n).
  { intros n H. destruct (Req_dec n 0) as [->|N]; [rewrite at_zero; ring|].
    rewrite (thrust_by_side _ n (turns_is n N H)). unfold curve, Rabs. simpl. fold a b. destruct (Rlt_dec n 0), (Rcase_abs n); try lra; ring. }
  split; [exact form|]. split; [|split; [|split]].
  - intros n. destruct (Req_dec n 0) as [->|N]; [rewrite Ropp_0, at_zero; ring|].
    unfold thrust. simpl. destruct (Rlt_dec n 0), (Rlt_dec (- n) 0); try lra. now rewrite Ropp_involutive.
  - intros T N W. destruct (thrust_found (affine s) T G G (reaches_is T N W)) as [U E].
    exists (command (affine s) T). split; [split; [apply turns_back, U|exact E]|].
    intros n [H F]. apply (one_command (affine s)); try assumption.
    + apply turns_is; [|exact H]. intros Z. subst n. rewrite at_zero in F. lra.
    + rewrite E. exact N.
    + now rewrite E, F.
  - intros T N W. exact (proj2 (thrust_found (affine s) T G G (reaches_is T N W))).
  - intros T B A N W. destruct (thrust_found (affine s) T G G (reaches_is T N W)) as [U E].
    set (n := command (affine s) T) in *. pose proof (turns_back n U) as H. rewrite (form n H) in E. rewrite B in E.
    assert (S : Rabs T / a = Rabs n * Rabs n).
    { rewrite <- E. replace (a * Rabs n * n + 0 * n) with (a * Rabs n * n) by ring. rewrite !Rabs_mult, Rabs_Rabsolu, (Rabs_right a) by lra. field. lra. }
    rewrite S, sqrt_square by apply Rabs_pos. destruct U as [[P _]|[P _]].
    + rewrite Rabs_right in * by lra. rewrite sign_eq_1 by nra. ring.
    + rewrite Rabs_left in * by lra. rewrite sign_eq_m1 by nra. ring.
Qed.

Definition made (a b least most : R) : side := {| quadratic := a; linear := b; dead_zone := least; limit := most |}.
Ltac by_test := apply accepted; simpl; unfold curve; simpl; lra.

(** Friction holds the propeller where the formula has some thrust. *)
Theorem needs_turning : exists s n, grows s /\ Rabs n <= limit s /\ thrust (affine s) n <> quadratic s * Rabs n * n + linear s * n.
Proof.
  exists (made 1 0 1 2), (1 / 2). split; [by_test|]. rewrite Rabs_right by lra. simpl. split; [lra|].
  unfold thrust, side_thrust. simpl. destruct (Rlt_dec (1 / 2) 0); [lra|]. destruct (Rlt_dec (1 / 2) 1); lra.
Qed.

(** Thrust stays what it is at the limit. *)
Theorem needs_within_limit : exists s n, grows s /\ dead_zone s <= Rabs n /\ thrust (affine s) n <> quadratic s * Rabs n * n + linear s * n.
Proof.
  exists (made 1 0 0 1), 2. split; [by_test|]. rewrite Rabs_right by lra. simpl. split; [lra|].
  unfold thrust, side_thrust, curve. simpl. destruct (Rlt_dec 2 0); [lra|]. rewrite Rmin_right by lra. lra.
Qed.

(** Past the vertex of a parabola open downwards a thrust has two commands. *)
Theorem needs_thrust_grows : exists s m n, 0 <= dead_zone s < limit s /\ 0 <= curve s (dead_zone s) /\
  turning s m /\ turning s n /\ m <> n /\ thrust (affine s) m = thrust (affine s) n.
Proof.
  exists (made (-1) 3 0 2), 1, 2. unfold turning, thrust, side_thrust, curve. simpl.
  destruct (Rlt_dec 1 0), (Rlt_dec 2 0); try lra. rewrite !Rmin_left by lra. repeat split; lra.
Qed.

(** Growth alone is not enough: where thrust is negative at the dead zone, ahead and astern give one thrust. *)
Theorem needs_thrust_forwards : exists s m n, 0 <= dead_zone s < limit s /\
  (forall p q, dead_zone s <= p -> p < q -> q <= limit s -> curve s p < curve s q) /\
  turning s m /\ turning s (- n) /\ m <> n /\ thrust (affine s) m = thrust (affine s) n.
Proof.
  exists (made 1 (-3) (8 / 5) 4), (18 / 5), (- (9 / 5)). unfold turning, thrust, side_thrust, curve. simpl.
  destruct (Rlt_dec (18 / 5) 0), (Rlt_dec (- (9 / 5)) 0); try lra. rewrite !Rmin_left by lra.
  destruct (Rlt_dec (18 / 5) (8 / 5)), (Rlt_dec (- - (9 / 5)) (8 / 5)); try lra. repeat split; intros; nra.
Qed.

(** The simplest inverse where b is not zero misses. *)
Theorem needs_b_zero : exists s T, grows s /\ within_reach s T /\ 0 < T /\ thrust (affine s) (sqrt (T / quadratic s)) <> T.
Proof.
  exists (made 1 1 0 2), 4. split; [by_test|]. unfold within_reach, curve. simpl. split; [lra|]. split; [lra|].
  replace (4 / 1) with (2 * 2) by lra. rewrite sqrt_square by lra. unfold thrust, side_thrust, curve. simpl.
  destruct (Rlt_dec 2 0); [lra|]. destruct (Rlt_dec 2 0); [lra|]. rewrite Rmin_left by lra. lra.
Qed.

Print Assumptions statement.
