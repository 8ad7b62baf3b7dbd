(** claim: thruster-bilinear (eq. 1)
    A propeller at the rate n in water that moves along its axis at [u_a] gives the thrust [T_nn abs(n) n - T_nu abs(n) u_a], and a torque
    of the same form. A thrust has exactly one rate that turns its way and does not brake. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(** Eq. 1, for thrust and for torque. *)
Definition bilinear (by_rate by_speed n u_a : R) : R := by_rate * Rabs n * n - by_speed * Rabs n * u_a.

(** The rate for a thrust, in the program's two forms. *)
Definition rate (T_nn T_nu T u_a : R) : R :=
  if Req_EM_T T 0 then 0 else
  let s := sign T in let with_flow := s * T_nu * u_a in let root := sqrt (with_flow ^ 2 + 4 * T_nn * Rabs T) in
  if Rlt_dec with_flow 0 then s * (2 * Rabs T / (root - with_flow)) else s * ((with_flow + root) / (2 * T_nn)).

(** The propeller turns faster than the flow that it turns with, or against it. *)
Definition not_braking (T_nn T_nu n u_a : R) : Prop := T_nu * Rabs u_a / T_nn < Rabs n \/ n * u_a <= 0.

(** The thrust of a positive one, at a positive rate m in the flow c that goes its way. *)
Lemma positive_root a c T : 0 < a -> 0 < T ->
  let root := sqrt (c ^ 2 + 4 * a * T) in
  Rabs c < root /\ root * root = c ^ 2 + 4 * a * T /\
  (c + root) / (2 * a) = 2 * T / (root - c) /\ (forall m, 0 < m -> (a * m * m - c * m = T <-> m = (c + root) / (2 * a))).
Proof.
  intros Ha HT root. assert (P : 0 < 4 * a * T) by (apply Rmult_lt_0_compat; lra).
  assert (S : root * root = c ^ 2 + 4 * a * T) by (apply sqrt_sqrt; nra). assert (R0 : 0 <= root) by apply sqrt_pos.
  assert (L : Rabs c < root) by (unfold Rabs; destruct (Rcase_abs c); nra).
  assert (B : - root < c < root) by (apply Rabs_def2 in L; lra).
  repeat split; try assumption.
  - apply (Rmult_eq_reg_r (2 * a * (root - c))); [|apply Rmult_integral_contrapositive; lra].
    field_simplify; [nra|lra|lra].
  - intros E. assert (Q : (2 * a * m - c) * (2 * a * m - c) = root * root) by nra.
    assert (F : (2 * a * m - c - root) * (2 * a * m - c + root) = 0) by nra.
    apply Rmult_integral in F. destruct F as [F|F]; [|exfalso; nra].
    apply (Rmult_eq_reg_r (2 * a)); [|lra]. field_simplify; lra.
  - intros ->. replace (a * ((c + root) / (2 * a)) * ((c + root) / (2 * a)) - c * ((c + root) / (2 * a))) with ((root * root - c ^ 2) / (4 * a)) by (field; lra).
    rewrite S. field. lra.
Qed.

Theorem statement : forall T_nn T_nu u_a : R, 0 < T_nn -> 0 <= T_nu ->
  (* each thrust has one rate that turns its way, and that does not brake *)
  (forall T, T <> 0 -> exists! n, 0 < n * T /\ bilinear T_nn T_nu n u_a = T) /\
  (forall T, T <> 0 -> let n := rate T_nn T_nu T u_a in
    0 < n * T /\ bilinear T_nn T_nu n u_a = T /\ not_braking T_nn T_nu n u_a) /\
  (* and the rate for the thrust of a rate that does not brake is that rate *)
  (forall n, n <> 0 -> not_braking T_nn T_nu n u_a -> rate T_nn T_nu (bilinear T_nn T_nu n u_a) u_a = n).
Proof.
  intros a k u Ha Hk.
  (* one rate, by the sign of the thrust *)
  assert (one : forall T n, T <> 0 -> (0 < n * T /\ bilinear a k n u = T <-> n = rate a k T u)).
  { intros T n HT. unfold rate. destruct (Req_EM_T T 0); [contradiction|].
    set (s := sign T). assert (Hs : s = 1 /\ 0 < T \/ s = -1 /\ T < 0).
    { unfold s. destruct (Rlt_dec 0 T); [left; rewrite sign_eq_1|right; rewrite sign_eq_m1]; lra. }
    assert (T0 : 0 < Rabs T) by (apply Rabs_pos_lt; exact HT).
    set (c := s * k * u). destruct (positive_root a c (Rabs T) Ha T0) as [L [S [E M]]].
    set (root := sqrt (c ^ 2 + 4 * a * Rabs T)) in *.
    assert (V : (if Rlt_dec c 0 then s * (2 * Rabs T / (root - c)) else s * ((c + root) / (2 * a))) = s * ((c + root) / (2 * a)))
      by (destruct (Rlt_dec c 0); [rewrite E|]; reflexivity).
    cbv zeta. rewrite V.
    assert (Q0 : 0 < (c + root) / (2 * a)) by (apply Rdiv_lt_0_compat; [apply Rabs_def2 in L; lra|lra]).
    split.
    - intros [P B]. assert (N : n = s * (s * n)) by (destruct Hs as [[-> _]|[-> _]]; ring). rewrite N. f_equal.
      assert (Pm : 0 < s * n) by (destruct Hs as [[-> Q]|[-> Q]]; nra). apply M; [exact Pm|].
      assert (An : Rabs n = s * n) by (destruct Hs as [[-> Q]|[-> Q]]; [rewrite Rabs_right|rewrite Rabs_left]; lra).
      assert (At : Rabs T = s * T) by (destruct Hs as [[-> Q]|[-> Q]]; [rewrite Rabs_right|rewrite Rabs_left]; lra).
      rewrite At, <- B. unfold bilinear, c. rewrite An. destruct Hs as [[-> _]|[-> _]]; ring.
    - intros ->. set (m := (c + root) / (2 * a)) in *. assert (F := proj2 (M m Q0) eq_refl).
      assert (An : Rabs (s * m) = m) by (destruct Hs as [[-> Q]|[-> Q]]; [rewrite Rabs_right|rewrite Rabs_left]; lra).
      split; [destruct Hs as [[-> Q]|[-> Q]]; nra|]. unfold bilinear. rewrite An.
      assert (At : T = s * Rabs T) by (destruct Hs as [[-> Q]|[-> Q]]; [rewrite Rabs_right|rewrite Rabs_left]; lra).
      rewrite At, <- F. unfold c. destruct Hs as [[-> _]|[-> _]]; ring. }
  (* thrust and rate have one sign exactly where the propeller does not brake *)
  assert (way : forall n, n <> 0 -> (not_braking a k n u <-> 0 < n * bilinear a k n u \/ n * u <= 0)).
  { intros n N. assert (Pn : 0 < Rabs n) by (apply Rabs_pos_lt; exact N). unfold not_braking.
    split; (intros [H|H]; [|right; exact H]).
    - apply (Rmult_lt_compat_r a) in H; [|exact Ha]. unfold Rdiv in H. rewrite Rmult_assoc, Rinv_l, Rmult_1_r in H by lra.
      left. unfold bilinear. replace (n * (a * Rabs n * n - k * Rabs n * u)) with (Rabs n * (a * (n * n) - k * (n * u))) by ring.
      apply Rmult_lt_0_compat; [exact Pn|]. replace (n * n) with (Rabs n * Rabs n) by (unfold Rabs; destruct (Rcase_abs n); ring).
      assert (n * u <= Rabs n * Rabs u) by (rewrite <- Rabs_mult; apply Rle_abs). pose proof (Rabs_pos u). nra.
    - destruct (Rle_lt_dec (n * u) 0) as [B|B]; [right; exact B|left].
      assert (Eu : n * u = Rabs n * Rabs u) by (rewrite <- Rabs_mult, Rabs_right; lra).
      unfold bilinear in H. replace (n * (a * Rabs n * n - k * Rabs n * u)) with (Rabs n * (a * (n * n) - k * (n * u))) in H by ring.
      rewrite Eu in H. replace (n * n) with (Rabs n * Rabs n) in H by (unfold Rabs; destruct (Rcase_abs n); ring).
      apply (Rmult_lt_reg_r a); [exact Ha|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. nra. }
  split; [|split].
  - intros T HT. exists (rate a k T u). split; [apply one; [exact HT|reflexivity]|]. intros n H. symmetry. apply one; assumption.
  - intros T HT n. destruct (proj2 (one T n HT) eq_refl) as [P B]. split; [exact P|]. split; [exact B|].
    apply way; [intros Z; rewrite Z in P; lra|]. left. rewrite B. exact P.
  - intros n N H. symmetry. apply one.
    + apply way in H; [|exact N]. destruct H as [H|H]; [intros Z; rewrite Z in H; lra|].
      unfold bilinear. assert (Pn : 0 < Rabs n) by (apply Rabs_pos_lt; exact N).
      replace (a * Rabs n * n - k * Rabs n * u) with (Rabs n * (a * n - k * u)) by ring.
      apply Rmult_integral_contrapositive. split; [lra|]. intros Z. assert (n * (a * n - k * u) = 0) by (rewrite Z; ring).
      assert (0 < n * n) by (destruct (Rtotal_order n 0) as [Q|[Q|Q]]; nra). nra.
    + split; [|reflexivity]. apply way in H; [|exact N]. destruct H as [H|H]; [exact H|].
      unfold bilinear. assert (Pn : 0 < Rabs n) by (apply Rabs_pos_lt; exact N).
      replace (n * (a * Rabs n * n - k * Rabs n * u)) with (Rabs n * (a * (n * n) - k * (n * u))) by ring.
      assert (0 < n * n) by (destruct (Rtotal_order n 0) as [Q|[Q|Q]]; nra). apply Rmult_lt_0_compat; [exact Pn|nra].
Qed.

(** A propeller that turns with the flow more slowly pushes backwards, and the rate found for that thrust turns the other way. *)
Theorem needs_not_braking : exists T_nn T_nu n u_a : R, 0 < T_nn /\ 0 <= T_nu /\ 0 < n /\
  bilinear T_nn T_nu n u_a < 0 /\ rate T_nn T_nu (bilinear T_nn T_nu n u_a) u_a < 0.
Proof.
  exists 1, 1, 1, 2. assert (B : bilinear 1 1 1 2 = -1) by (unfold bilinear; rewrite Rabs_right by lra; ring).
  repeat split; try lra. rewrite B. destruct (proj1 (proj2 (statement 1 1 2 ltac:(lra) ltac:(lra))) (-1) ltac:(lra)) as [P _]. lra.
Qed.

(** The rate for still water misses in a flow. *)
Theorem flow_matters : bilinear 1 1 (rate 1 1 1 0) 1 <> 1.
Proof.
  destruct (proj1 (proj2 (statement 1 1 0 ltac:(lra) ltac:(lra))) 1 ltac:(lra)) as [P [E _]]. unfold bilinear in *.
  set (n := rate 1 1 1 0) in *. rewrite Rabs_right in * by lra. nra.
Qed.

Print Assumptions statement.
