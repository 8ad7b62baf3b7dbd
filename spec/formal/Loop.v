(** Closed loops, exactly: the paper's nonlinear processes (eq. 21) and linear ones in state space; what half a period does. *)
From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic.
Open Scope R_scope.

(** A motion of mirrored half waves about [m]. With [m] the reference it is a symmetric self-oscillation. *)
Definition mirrored (h m : R) (x : R -> R) : Prop := forall t, x (t + h) = 2 * m - x t.

(** * Nonlinear processes *)

(** Eq. 21: [G (x, x', x'', ...) = u + delta]. The left side is any function of the output's derivatives. *)
Definition left_side : Type := (nat -> R) -> R.
Definition jet (x : R -> R) (t : R) : nat -> R := fun k => Derive_n x k t.

(** Integrating: the output itself does not occur, only its derivatives. *)
Definition integrating (G : left_side) : Prop := forall d e : nat -> R, (forall k, (1 <= k)%nat -> d k = e k) -> G d = G e.
Definition odd_process (G : left_side) : Prop := forall d : nat -> R, G (fun k => - d k) = - G d.

(** Coquelicot's derivatives are total, so that no differentiability is asked. *)
Lemma Derive_from_constant (c : R) (f : R -> R) k t : Derive_n (fun t => c - f t) (S k) t = - Derive_n f (S k) t.
Proof.
  revert t. induction k as [|k IH]; intros t.
  - simpl. rewrite <- Derive_opp. unfold Derive. f_equal. apply Lim_ext. intros h. unfold Rdiv. f_equal. ring.
  - change (Derive (Derive_n (fun t => c - f t) (S k)) t = - Derive (Derive_n f (S k)) t).
    rewrite <- Derive_opp. apply Derive_ext. exact IH.
Qed.

Lemma jet_half_period x h m t k : mirrored h m x -> (1 <= k)%nat -> jet x (t + h) k = - jet x t k.
Proof.
  intros M Hk. destruct k as [|k]; [lia|]. unfold jet. rewrite <- Derive_n_comp_trans.
  rewrite (Derive_n_ext _ (fun t => 2 * m - x t)) by exact M. apply Derive_from_constant.
Qed.

(** Mirrored half waves, about whatever middle: the left side changes its sign over half a period. *)
Theorem left_side_half_period G x h m t : integrating G -> odd_process G -> mirrored h m x ->
  G (jet x (t + h)) = - G (jet x t).
Proof. intros HG Ho M. rewrite <- Ho. apply HG. intros k Hk. now apply (jet_half_period x h m). Qed.

(** A sinusoid about a bias is of mirrored half waves. *)
Lemma sinusoid_mirrored b X w : 0 < w -> mirrored (PI / w) b (fun t => b + X * sin (w * t)).
Proof.
  intros Hw t. replace (w * (t + PI / w)) with (w * t + PI) by (field; lra). rewrite sin_plus_pi. ring.
Qed.

(** * Linear processes *)

Fixpoint total (n : nat) (f : nat -> R) : R := match n with O => 0 | S m => total m f + f m end.

Lemma total_ext n f g : (forall i, (i < n)%nat -> f i = g i) -> total n f = total n g.
Proof. induction n as [|n IH]; intros H; simpl; [reflexivity|]. rewrite IH, H; auto. Qed.
Lemma total_plus n f g : total n (fun i => f i + g i) = total n f + total n g.
Proof. induction n as [|n IH]; simpl; [ring|]. rewrite IH. ring. Qed.
Lemma total_times n k f : total n (fun i => k * f i) = k * total n f.
Proof. induction n as [|n IH]; simpl; [ring|]. rewrite IH. ring. Qed.
Lemma total_zero n : total n (fun _ => 0) = 0.
Proof. induction n as [|n IH]; simpl; [reflexivity|]. rewrite IH. ring. Qed.
Lemma total_exchange n m f : total n (fun i => total m (fun j => f i j)) = total m (fun j => total n (fun i => f i j)).
Proof.
  induction n as [|n IH]; simpl; [now rewrite total_zero|]. rewrite IH, <- total_plus. reflexivity.
Qed.
Lemma total_integral n (f : nat -> R -> R) (a b : R) (l : nat -> R) :
  (forall i, (i < n)%nat -> is_RInt (f i) a b (l i)) -> is_RInt (fun t => total n (fun i => f i t)) a b (total n l).
Proof.
  induction n as [|n IH]; intros H; simpl.
  - apply (equal _ _ _ ((b - a) * 0)); [apply constant_integral|ring].
  - apply add; auto.
Qed.

(** [z' = A z + b u], [y = c z], of any order. *)
Record linear_process := { order : nat; A : nat -> nat -> R; b : nat -> R; c : nat -> R }.

(** As integrals: the command may jump. *)
Definition moves (P : linear_process) (u : R -> R) (z : R -> nat -> R) : Prop := forall i, (i < order P)%nat -> forall s t : R,
  is_RInt (fun r => total (order P) (fun j => A P i j * z r j) + b P i * u r) s t (z t i - z s i).
Definition repeats (P : linear_process) (T : R) (z : R -> nat -> R) : Prop :=
  forall t i, (i < order P)%nat -> z (t + T) i = z t i.
Definition response (P : linear_process) (z : R -> nat -> R) (t : R) : R := total (order P) (fun i => c P i * z t i).

(** Some combination of the states integrates the command. *)
Definition has_integrator (P : linear_process) : Prop := exists l : nat -> R,
  (forall j, (j < order P)%nat -> total (order P) (fun i => l i * A P i j) = 0) /\ total (order P) (fun i => l i * b P i) <> 0.
(** Zero is no pole. *)
Definition no_pole_at_zero (P : linear_process) : Prop := forall v : nat -> R,
  (forall i, (i < order P)%nat -> total (order P) (fun j => A P i j * v j) = 0) -> forall j, (j < order P)%nat -> v j = 0.
(** No pole on the imaginary axis but at zero: without command the process has no periodic motion but rest. *)
Definition rests_without_command (P : linear_process) : Prop := forall (T : R) (z : R -> nat -> R), 0 < T ->
  moves P (fun _ => 0) z -> repeats P T z -> forall t i, (i < order P)%nat -> z t i = z 0 i.
(** No pole on the imaginary axis at all: without command it rests at zero. *)
Definition rests_at_zero (P : linear_process) : Prop := forall (T : R) (z : R -> nat -> R), 0 < T ->
  moves P (fun _ => 0) z -> repeats P T z -> forall t i, (i < order P)%nat -> z t i = 0.

(** An integrator passes periodic motion only where the mean of its input is zero. *)
Theorem integrator_balance P u z T : has_integrator P -> moves P u z -> repeats P T z -> forall s, is_RInt u s (s + T) 0.
Proof.
  intros [l [Hl Hg]] M Rz s. set (n := order P) in *. set (g := total n (fun i => l i * b P i)) in *.
  assert (I : is_RInt (fun r => total n (fun i => l i * (total n (fun j => A P i j * z r j) + b P i * u r))) s (s + T)
                (total n (fun i => l i * (z (s + T) i - z s i)))).
  { apply (total_integral n (fun i r => l i * (total n (fun j => A P i j * z r j) + b P i * u r))). intros i Hi.
    apply multiply. now apply M. }
  assert (Z : total n (fun i => l i * (z (s + T) i - z s i)) = 0).
  { rewrite (total_ext n _ (fun _ => 0)); [apply total_zero|]. intros i Hi. rewrite (Rz s i Hi). ring. }
  rewrite Z in I.
  assert (E : forall r, total n (fun i => l i * (total n (fun j => A P i j * z r j) + b P i * u r)) = g * u r).
  { intros r. rewrite (total_ext n _ (fun i => total n (fun j => l i * A P i j * z r j) + u r * (l i * b P i))).
    - rewrite total_plus, total_exchange, total_times.
      rewrite (total_ext n (fun j => total n (fun i => l i * A P i j * z r j)) (fun _ => 0)); [rewrite total_zero; unfold g; ring|].
      intros j Hj. rewrite (total_ext n _ (fun i => z r j * (l i * A P i j))); [rewrite total_times, Hl; [ring|exact Hj]|intros; ring].
    - intros i Hi. rewrite Rmult_plus_distr_l, <- total_times. f_equal; [apply total_ext; intros; ring|ring]. }
  apply (equal _ _ _ (/ g * 0)); [|ring].
  refine (is_RInt_ext (V := R_NormedModule) _ _ _ _ _ _ (multiply _ (/ g) _ _ _ I)).
  intros r _. rewrite E. match goal with |- ?p = ?q => change (@eq R p q) end. field. exact Hg.
Qed.

Lemma state_continuous P u z i : moves P u z -> (i < order P)%nat -> forall t : R, continuous (fun r => z r i) t.
Proof.
  intros M Hi t. pose proof (M i Hi 0) as I.
  apply (continuous_ext (fun r => (z r i - z 0 i) + z 0 i)); [intros; simpl; ring|].
  apply (continuous_plus (fun r => z r i - z 0 i) (fun _ => z 0 i)); [|apply continuous_const].
  apply (continuous_RInt_1 (V := R_NormedModule) (fun r => total (order P) (fun j => A P i j * z r j) + b P i * u r) 0 t (fun r => z r i - z 0 i)).
  exists (mkposreal 1 Rlt_0_1). intros s _. apply I.
Qed.

(** Without a pole at zero: a command of mean zero gets a response of mean zero. *)
Theorem static_balance P u z T : no_pole_at_zero P -> moves P u z -> repeats P T z -> is_RInt u 0 T 0 ->
  is_RInt (response P z) 0 T 0.
Proof.
  intros H M Rz U. set (n := order P).
  assert (I : forall j, (j < n)%nat -> is_RInt (fun r => z r j) 0 T (RInt (fun r => z r j) 0 T)).
  { intros j Hj. apply integral_of, (ex_RInt_continuous (V := R_CompleteNormedModule)). intros t _. now apply (state_continuous P u z). }
  assert (Z : forall j, (j < n)%nat -> RInt (fun r => z r j) 0 T = 0).
  { apply H. intros i Hi. pose proof (M i Hi 0 T) as Mi.
    assert (K : is_RInt (fun r => total n (fun j => A P i j * z r j) + b P i * u r) 0 T
                  (total n (fun j => A P i j * RInt (fun r => z r j) 0 T) + b P i * 0)).
    { apply add; [|now apply multiply]. apply (total_integral n (fun j r => A P i j * z r j)). intros j Hj. apply multiply, I, Hj. }
    fold n in Mi. apply RInt_of in K, Mi. rewrite Mi in K. pose proof (Rz 0 i Hi) as ZT. rewrite Rplus_0_l in ZT. fold n. lra. }
  apply (equal _ _ _ (total n (fun i => c P i * RInt (fun r => z r i) 0 T))).
  - apply (total_integral n (fun i r => c P i * z r i)). intros i Hi. apply multiply, I, Hi.
  - rewrite (total_ext n _ (fun _ => 0)); [apply total_zero|]. intros i Hi. rewrite Z by exact Hi. ring.
Qed.

(** A linear process answers a command of mirrored half waves with mirrored half waves. *)
Lemma half_period_sum P u z h : moves P u z -> (forall t, u (t + h) = - u t) -> moves P (fun _ => 0) (fun t i => z (t + h) i + z t i).
Proof.
  intros M U i Hi s t.
  assert (L : is_RInt (fun r => total (order P) (fun j => A P i j * z (r + h) j) + b P i * u (r + h)) s t (z (t + h) i - z (s + h) i)).
  { apply (later (fun r => total (order P) (fun j => A P i j * z r j) + b P i * u r) h). apply M, Hi. }
  pose proof (add _ _ _ _ _ _ L (M i Hi s t)) as S.
  apply (equal _ _ _ (z (t + h) i - z (s + h) i + (z t i - z s i))); [|ring].
  refine (is_RInt_ext (V := R_NormedModule) _ _ _ _ _ _ S). intros r _. simpl. rewrite U.
  rewrite (total_ext (order P) (fun j => A P i j * (z (r + h) j + z r j)) (fun j => A P i j * z (r + h) j + A P i j * z r j)) by (intros; ring).
  rewrite total_plus. ring.
Qed.

Theorem linear_half_period P u z h : 0 < h -> moves P u z -> repeats P (h + h) z -> (forall t, u (t + h) = - u t) ->
  (rests_without_command P -> exists m, mirrored h m (response P z)) /\
  (rests_at_zero P -> mirrored h 0 (response P z)).
Proof.
  intros Hh M Rz U. pose proof (half_period_sum P u z h M U) as F.
  assert (R' : repeats P h (fun t i => z (t + h) i + z t i)).
  { intros t i Hi. simpl. replace (t + h + h) with (t + (h + h)) by ring. rewrite (Rz t i Hi). ring. }
  assert (S : forall t, response P z (t + h) = total (order P) (fun i => c P i * (z (t + h) i + z t i)) - response P z t).
  { intros t. unfold response. rewrite (total_ext (order P) (fun i => c P i * (z (t + h) i + z t i)) (fun i => c P i * z (t + h) i + c P i * z t i)) by (intros; ring).
    rewrite total_plus. ring. }
  split.
  - intros H. exists (total (order P) (fun i => c P i * (z (0 + h) i + z 0 i)) / 2). intros t. rewrite S. f_equal.
    replace (2 * (total (order P) (fun i => c P i * (z (0 + h) i + z 0 i)) / 2)) with (total (order P) (fun i => c P i * (z (0 + h) i + z 0 i))) by field.
    apply total_ext. intros i Hi. f_equal. exact (H h _ Hh F R' t i Hi).
  - intros H t. rewrite S. rewrite (total_ext (order P) _ (fun _ => 0)).
    + rewrite total_zero. ring.
    + intros i Hi. pose proof (H h _ Hh F R' t i Hi) as Z. simpl in Z. rewrite Z. ring.
Qed.

(** * Processes that rest without command *)

(** [v' = a v] and periodic: nothing but zero where [a] is not zero. *)
Lemma periodic_lag (a T : R) (v : R -> R) : a <> 0 -> 0 < T -> (forall t : R, continuous v t) ->
  (forall s t : R, is_RInt (fun r => a * v r) s t (v t - v s)) -> (forall t, v (t + T) = v t) -> forall t, v t = 0.
Proof.
  intros Ha HT Cv I Rv t.
  assert (D : forall r, is_derive v r (a * v r)).
  { intros r. apply (is_derive_ext (fun s => (v s - v 0) + v 0)); [intros; simpl; ring|].
    replace (a * v r) with (plus (a * v r) 0) by (unfold plus; simpl; ring).
    apply (is_derive_plus (V := R_NormedModule) (fun s => v s - v 0) (fun _ => v 0)); [|apply (is_derive_const (V := R_NormedModule))].
    apply (is_derive_RInt (V := R_NormedModule) (fun r => a * v r) (fun s => v s - v 0) 0 r).
    - exists (mkposreal 1 Rlt_0_1). intros s _. apply I.
    - apply (continuous_scal_r (K := R_AbsRing) (V := R_NormedModule) a v), Cv. }
  set (w := fun r => v r * exp (- a * r)).
  assert (Dw : forall r, is_derive w r 0).
  { intros r. unfold w. auto_derive; [exists (a * v r); apply D|]. replace (Derive (fun x => v x) r) with (a * v r) by (symmetry; apply is_derive_unique, D). ring. }
  assert (const : forall r, w r = w 0).
  { intros r. destruct (MVT_gen w 0 r (fun _ => 0)) as [x [_ E]].
    - intros x _. apply Dw.
    - intros x _. apply continuity_pt_filterlim, (ex_derive_continuous (V := R_NormedModule)). exists 0. apply Dw.
    - lra. }
  pose proof (const t) as E1. pose proof (const (t + T)) as E2. unfold w in E1, E2. rewrite Rv in E2.
  rewrite <- E1 in E2. replace (- a * (t + T)) with (- a * t + - a * T) in E2 by ring. rewrite exp_plus in E2.
  pose proof (exp_pos (- a * t)).
  assert (F : v t * (exp (- a * T) - 1) = 0) by (apply (Rmult_eq_reg_l (exp (- a * t))); [|lra]; lra).
  apply Rmult_integral in F. destruct F as [|F]; [assumption|]. exfalso.
  assert (- a * T = 0); [|assert (a * T <> 0) by (apply Rmult_integral_contrapositive; lra); lra].
  apply exp_inv. rewrite exp_0. lra.
Qed.

(** A cascade: each state moves by itself and by those before it. Lags, then at most one integrator at the end. *)
Definition cascade (P : linear_process) : Prop :=
  forall i j, (i < order P)%nat -> (j < order P)%nat -> (i < j)%nat -> A P i j = 0.

Lemma total_last n f : (forall j, (S j < n)%nat -> f j = 0) -> (0 < n)%nat -> total n f = f (pred n).
Proof.
  intros H Hn. destruct n as [|n]; [lia|]. simpl. rewrite (total_ext n f (fun _ => 0)), total_zero; [ring|]. intros j Hj. apply H. lia.
Qed.

Lemma total_one n f i : (i < n)%nat -> (forall j, (j < n)%nat -> j <> i -> f j = 0) -> total n f = f i.
Proof.
  intros Hi H. induction n as [|n IH]; [lia|]. simpl. destruct (Nat.eq_dec i n) as [->|N].
  - rewrite (total_ext n f (fun _ => 0)), total_zero; [ring|]. intros j Hj. apply H; lia.
  - rewrite IH; [rewrite (H n); [ring|lia|lia]|lia|]. intros j Hj. apply H. lia.
Qed.

Lemma cascade_states P T z : cascade P -> 0 < T -> moves P (fun _ => 0) z -> repeats P T z ->
  forall k, (k <= order P)%nat -> (forall i, (i < k)%nat -> A P i i <> 0) -> forall i, (i < k)%nat -> forall t, z t i = 0.
Proof.
  intros Hc HT M Rz. induction k as [|k IH]; intros Hk D i Hi t; [lia|].
  assert (before : forall i, (i < k)%nat -> forall t, z t i = 0) by (apply IH; [lia|intros; apply D; lia]).
  destruct (Nat.eq_dec i k) as [->|N]; [|apply before; lia].
  apply (periodic_lag (A P k k) T (fun t => z t k)); [apply D; lia|exact HT|now apply (state_continuous P (fun _ => 0))| |intros; apply Rz; lia].
  intros s r. refine (is_RInt_ext (V := R_NormedModule) _ _ _ _ _ _ (M k _ s r)); [|lia]. intros q _.
  rewrite (total_one (order P) _ k); [simpl; ring|lia|]. intros j Hj Nj.
  destruct (Nat.lt_ge_cases j k) as [L|L]; [rewrite before by exact L; ring|]. rewrite Hc by lia. ring.
Qed.

(** Lags alone. *)
Theorem lags_rest_at_zero P : cascade P -> (forall i, (i < order P)%nat -> A P i i <> 0) -> rests_at_zero P.
Proof. intros Hc D T z HT M Rz t i Hi. now apply (cascade_states P T z Hc HT M Rz (order P) (le_n _) D). Qed.

(** Lags and an integrator at their end: the processes of the paper. *)
Theorem lags_and_integrator_rest P n : order P = S n -> cascade P -> (forall i, (i < n)%nat -> A P i i <> 0) -> A P n n = 0 ->
  rests_without_command P.
Proof.
  intros On Hc D Z T z HT M Rz t i Hi.
  assert (before : forall i, (i < n)%nat -> forall t, z t i = 0).
  { apply (cascade_states P T z Hc HT M Rz n); [lia|exact D]. }
  destruct (Nat.eq_dec i n) as [->|N]; [|rewrite !before by lia; reflexivity].
  assert (I : is_RInt (fun _ => 0) 0 t (z t n - z 0%R n)).
  { refine (is_RInt_ext (V := R_NormedModule) _ _ _ _ _ _ (M n Hi 0 t)). intros r _.
    rewrite (total_one (order P) _ n); [rewrite Z; simpl; ring|exact Hi|]. intros j Hj Nj. rewrite before by lia. ring. }
  assert (E : is_RInt (fun _ : R => 0) 0 t 0) by (apply (equal _ _ _ ((t - 0) * 0)); [apply constant_integral|ring]).
  apply RInt_of in I, E. rewrite I in E. lra.
Qed.

(** * Relay orbits with one switching each way *)

(** Times at either command, a command of levels [d + C] and [d - C], an exact motion, and an error that stands at the relay's
    levels where it switches. *)
Record relay_orbit (P : linear_process) (C x_a d r high low : R) (u : R -> R) (z : R -> nat -> R) : Prop := {
  high_positive : 0 < high;
  low_positive : 0 < low;
  command_high : forall t, 0 <= t < high -> u t = d + C;
  command_low : forall t, high <= t < high + low -> u t = d - C;
  command_repeats : forall t, u (t + (high + low)) = u t;
  motion : moves P u z;
  motion_repeats : repeats P (high + low) z;
  switches_up : r - response P z 0 = x_a;
  switches_down : r - response P z high = - x_a }.

Lemma equal_times_flip P C x_a r h u z : relay_orbit P C x_a 0 r h h u z -> forall t, u (t + h) = - u t.
Proof.
  intros O t. destruct O as [Hh _ up_ down_ Ru _ _ _ _].
  destruct (within_a_period (h + h) t ltac:(lra)) as [k [s [Hs ->]]].
  replace (s + IZR k * (h + h) + h) with (s + h + IZR k * (h + h)) by ring. rewrite !(shift_by_periods u (h + h) Ru).
  destruct (Rlt_dec s h) as [L|L].
  - rewrite (up_ s), (down_ (s + h)) by lra. ring.
  - rewrite (down_ s) by lra. replace (s + h) with (s - h + (h + h)) by ring. rewrite Ru, up_ by lra. ring.
Qed.

(** The command's integral over a period. *)
Lemma command_integral P C x_a d r high low u z : relay_orbit P C x_a d r high low u z ->
  is_RInt u 0 (high + low) (high * (d + C) + low * (d - C)).
Proof.
  intros [Hh Hl up_ down_ _ _ _ _ _]. apply join with high.
  - apply (ext (fun _ => d + C)); [lra|intros t T; symmetry; apply up_; lra|].
    apply (equal _ _ _ ((high - 0) * (d + C))); [apply constant_integral|ring].
  - apply (ext (fun _ => d - C)); [lra|intros t T; symmetry; apply down_; lra|].
    apply (equal _ _ _ ((high + low - high) * (d - C))); [apply constant_integral|ring].
Qed.

(** With an integrator the times at both commands differ by [- d/C] of the period. *)
Theorem times_of_orbit P C x_a d r high low u z : has_integrator P -> 0 < C -> relay_orbit P C x_a d r high low u z ->
  (high - low) / (high + low) = - (d / C).
Proof.
  intros HP HC O. pose proof (command_integral _ _ _ _ _ _ _ _ _ O) as I. destruct O as [Hh Hl _ _ _ M Rz _ _].
  pose proof (integrator_balance P u z _ HP M Rz 0) as B. rewrite Rplus_0_l in B. apply RInt_of in I, B. rewrite I in B.
  apply (Rmult_eq_reg_r (C * (high + low))); [|apply Rmult_integral_contrapositive; lra]. field_simplify; lra.
Qed.

(** Equal times: the response is of mirrored half waves, about the reference where the process rests without command. *)
Theorem equal_times_mirrored P C x_a r h u z : relay_orbit P C x_a 0 r h h u z ->
  (rests_without_command P -> mirrored h r (response P z)) /\ (rests_at_zero P -> r = 0).
Proof.
  intros O. pose proof (equal_times_flip _ _ _ _ _ _ _ O) as U. destruct O as [Hh _ _ _ _ M Rz S1 S2].
  destruct (linear_half_period P u z h Hh M Rz U) as [L1 L2]. split; intros H.
  - destruct (L1 H) as [m Hm]. pose proof (Hm 0) as E. rewrite Rplus_0_l in E. replace r with m by lra. exact Hm.
  - pose proof (L2 H 0) as E. rewrite Rplus_0_l in E. lra.
Qed.
