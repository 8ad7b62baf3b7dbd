(** claim: thruster-asymmetric (eq. 3)
    A thruster that differs by direction has coefficients [(a_f, b_f)] for [n > 0] and [(a_b, b_b)] for [n <= 0]. Thrust has the sign of the
    command, so the sign of the thrust picks the side on which to look for the command. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Common Thruster.
Open Scope R_scope.

Theorem statement : forall t : thruster, grows (forward t) -> grows (backward t) ->
  let f := forward t in let b := backward t in
  (* eq. 2 on each side *)
  (forall n, 0 < n -> turning f n -> thrust t n = quadratic f * Rabs n * n + linear f * n) /\
  (forall n, n < 0 -> turning b (- n) -> thrust t n = quadratic b * Rabs n * n + linear b * n) /\
  thrust t 0 = 0 /\
  (* the sign of the command *)
  (forall n, turns t n -> 0 <= thrust t n * n) /\
  (* each thrust within reach has one command *)
  (forall T, reaches t T -> exists! n, turns t n /\ thrust t n = T) /\
  (forall T, reaches t T -> turns t (command t T) /\ thrust t (command t T) = T) /\
  (* and the command for the thrust of a command is that command *)
  (forall n, turns t n -> thrust t n <> 0 -> command t (thrust t n) = n).
Proof.
  intros t GF GB f b. pose proof (magnitudes f GF) as MF.
  assert (P1 : forall n, 0 < n -> turning f n -> thrust t n = quadratic f * Rabs n * n + linear f * n).
  { intros n P N. rewrite (thrust_by_side t n) by (left; split; assumption). destruct (Rlt_dec n 0); [lra|].
    unfold curve. fold f. rewrite Rabs_right by lra. ring. }
  assert (P2 : forall n, n < 0 -> turning b (- n) -> thrust t n = quadratic b * Rabs n * n + linear b * n).
  { intros n P N. rewrite (thrust_by_side t n) by (right; split; assumption). destruct (Rlt_dec n 0); [|lra].
    unfold curve. fold b. rewrite Rabs_left by lra. ring. }
  split; [exact P1|]. split; [exact P2|]. split; [|split; [|split; [|split]]].
  - unfold thrust, side_thrust. destruct (Rlt_dec 0 0); [lra|]. fold f. destruct (Rlt_dec 0 (dead_zone f)); [reflexivity|].
    rewrite Rmin_left by lra. unfold curve. ring.
  - intros n U. rewrite (thrust_by_side t n U). fold f b. destruct U as [[P N]|[P N]]; destruct (Rlt_dec n 0); try lra.
    + pose proof (turning_forwards f GF n N). nra.
    + pose proof (turning_forwards b GB (- n) N). nra.
  - intros T W. destruct (thrust_found t T GF GB W) as [U E]. exists (command t T). split; [split; assumption|].
    intros n [H F]. apply (one_command t); try assumption; [|now rewrite E, F]. rewrite E. destruct W as [[W _]|[W _]]; lra.
  - intros T W. exact (thrust_found t T GF GB W).
  - intros n U Z. assert (W : reaches t (thrust t n)).
    { unfold reaches. rewrite (thrust_by_side t n U) in *. fold f b in U, Z. fold f b. destruct U as [[P N]|[P N]]; destruct (Rlt_dec n 0); try lra.
      - left. assert (0 < curve f n) by (destruct (turning_forwards f GF n N) as [Q|Q]; [exact Q|contradict Z; lra]). split; [lra|apply turning_reach; assumption].
      - right. assert (0 < curve b (- n)) by (destruct (turning_forwards b GB (- n) N) as [Q|Q]; [exact Q|contradict Z; lra]). split; [lra|]. rewrite Ropp_involutive. apply turning_reach; assumption. }
    destruct (thrust_found t _ GF GB W) as [V E]. apply (one_command t); try assumption. now rewrite E.
Qed.

(** With the forward coefficients astern too the thrust is another one. *)
Theorem sides_matter : exists f b, grows f /\ grows b /\
  thrust {| forward := f; backward := b |} (-1) <> thrust {| forward := f; backward := f |} (-1).
Proof.
  exists {| quadratic := 2; linear := 0; dead_zone := 0; limit := 2 |}, {| quadratic := 1; linear := 0; dead_zone := 0; limit := 2 |}.
  split; [apply accepted; simpl; lra|]. split; [apply accepted; simpl; lra|].
  unfold thrust, side_thrust, curve. simpl. destruct (Rlt_dec (-1) 0); [|lra]. destruct (Rlt_dec (- -1) 0); [lra|].
  rewrite !Rmin_left by lra. lra.
Qed.

Print Assumptions statement.
