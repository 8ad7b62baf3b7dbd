(** theorem-2 (Theorem 2). As printed: with an odd characteristic and a constant reference the self-oscillations are symmetric if
    and only if the process is astatic. Neither direction holds. As corrected: with a characteristic of lemma 1 an integrating process,
    linear or of the paper's nonlinear class (eq. 21), oscillates symmetrically about any constant reference; a process without
    integrator oscillates symmetrically about no constant reference but zero. On the first harmonic, and exactly. *)
From Coq Require Import Reals Lra Lia ZArith List.
From Coq Require FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Selfosc Require Import Periodic Kernels Moments Abel Claim_polynomial Claim_odd_harmonics Claim_lemma_1 Loop.
Import ListNotations.
Open Scope R_scope.

(** * On the first harmonic *)

(** The characteristics of lemma 1, with memory; without memory the branches are one odd function. *)
Definition of_lemma_1 (c : characteristic) (B X : R) : Prop :=
  nondecreasing (rising c) /\ half_turn_images c /\ rises_inside (rising c) B X.

(** The paper's nonlinear class: an odd left side without the output itself. The error is [B + X sin(w t)]; the constant parts
    balance, with a constant disturbance [delta] at the process' input. *)
Definition first_harmonic_nonlinear : Prop := forall (G : left_side) (c : characteristic) (B X w r delta : R), 0 < X -> 0 < w ->
  integrating G -> odd_process G -> of_lemma_1 c B X ->
  let x := fun t => r - (B + X * sin (w * t)) in
  ex_RInt (fun theta => G (jet x (theta / w))) 0 PI ->
  mean (fun theta => G (jet x (theta / w))) = mean (output c B X) + delta ->
  (delta = 0 -> B = 0) /\ (0 < delta -> B < 0) /\ (delta < 0 -> 0 < B).

(** Linear processes, answering exactly to what the characteristic makes of the sinusoid. *)
Definition first_harmonic_linear : Prop := forall (P : linear_process) (c : characteristic) (B X w : R) (z : R -> nat -> R),
  0 < X -> 0 < w -> has_integrator P -> of_lemma_1 c B X ->
  moves P (fun t => output c B X (w * t)) z -> repeats P (2 * PI / w) z -> B = 0.

(** Without integrator: a static term [f], odd, nondecreasing and not zero somewhere inside the sweep. *)
Definition first_harmonic_static : Prop := forall (f : R -> R) (g : left_side) (c : characteristic) (X w r : R), 0 < X -> 0 < w ->
  odd f -> nondecreasing f -> (exists x, r - X < x < r + X /\ f x <> 0) -> integrating g -> odd_process g ->
  half_turn_images c -> ex_RInt (output c 0 X) 0 (2 * PI) ->
  let x := fun t => r + X * sin (w * t) in
  ex_RInt (fun theta => g (jet x (theta / w))) 0 PI ->
  mean (fun theta => f (x (theta / w)) + g (jet x (theta / w))) = mean (output c 0 X) -> r = 0.

Definition first_harmonic_linear_static : Prop := forall (P : linear_process) (c : characteristic) (X w r : R) (z : R -> nat -> R),
  0 < X -> 0 < w -> no_pole_at_zero P -> half_turn_images c -> ex_RInt (output c 0 X) 0 (2 * PI) ->
  moves P (fun t => output c 0 X (w * t)) z -> repeats P (2 * PI / w) z ->
  is_RInt (fun t => r - response P z t) 0 (2 * PI / w) 0 -> r = 0.

(** * Exactly *)

(** An oscillation of mirrored half waves, of any waveform, is symmetric: its middle is the reference. *)
Definition exact_nonlinear : Prop := forall (G : left_side) (F x : R -> R) (r m h : R),
  integrating G -> odd_process G -> odd F -> nondecreasing F -> continuity x -> mirrored h m x ->
  (forall t, G (jet x t) = F (r - x t)) -> (exists t, F (r - x t) <> 0) -> m = r.

(** An integrator anywhere in a nonlinear process: [w] integrates what the characteristic gives, and is periodic. The error is of
    mirrored half waves [s] about [B], of any waveform; the characteristic is not zero somewhere inside the sweep. *)
Definition exact_integrating_chain : Prop := forall (F s w : R -> R) (B h : R), 0 < h -> odd F -> nondecreasing F ->
  continuity s -> (forall t, s (t + h) = - s t) -> (exists x t, Rabs x < Rabs (s t) + Rabs B /\ F x <> 0) ->
  (forall a b, is_RInt (fun t => F (B + s t)) a b (w b - w a)) -> (forall t, w (t + (h + h)) = w t) -> B = 0.

(** The same under a relay with hysteresis: the equation holds where the command is continuous, the relay turns where the error
    stands at its levels, and turns now and then. *)
Definition turns (u : R -> R) (a b t : R) : Prop := exists e, 0 < e /\
  (forall s, t - e < s < t -> u s = a) /\ (forall s, t < s < t + e -> u s = b).
Definition exact_nonlinear_relay : Prop := forall (G : left_side) (u x : R -> R) (C x_a r m h : R),
  integrating G -> odd_process G -> mirrored h m x ->
  (forall t, continuous u t -> G (jet x t) = u t) -> (forall t, exists a b, turns u a b t) ->
  (forall t, turns u (- C) C t -> r - x t = x_a) -> (forall t, turns u C (- C) t -> r - x t = - x_a) ->
  (exists t, turns u (- C) C t) -> m = r.

(** A characteristic of any kind, as a relation between input and output. *)
Definition law : Type := (R -> R) -> (R -> R) -> Prop.
Definition odd_law (obeys : law) : Prop := forall e u, obeys e u -> obeys (fun t => - e t) (fun t => - u t).
Definition closed_loop (G : left_side) (obeys : law) (r : R) (x u : R -> R) : Prop :=
  (forall t, continuous u t -> G (jet x t) = u t) /\ obeys (fun t => r - x t) u.
Definition periodic (T : R) (x : R -> R) : Prop := 0 < T /\ forall t, x (t + T) = x t.

(** With an integrating process the reference moves the oscillation and changes nothing else. *)
Definition reference_does_not_matter : Prop := forall (G : left_side) (obeys : law) (r r' : R) (x u : R -> R),
  integrating G -> closed_loop G obeys r x u -> closed_loop G obeys r' (fun t => x t + (r' - r)) u.

(** So where the loop has one oscillation, but for its phase, this one is symmetric about every constant reference. *)
Definition unique_is_symmetric : Prop := forall (G : left_side) (obeys : law) (r T : R) (x u : R -> R),
  integrating G -> odd_process G -> odd_law obeys -> closed_loop G obeys r x u -> periodic T x ->
  (forall x' u', closed_loop G obeys r x' u' -> periodic T x' -> exists phase, forall t, x' t = x (t + phase)) ->
  exists h, 0 < h /\ mirrored h r x.

(** Without integrator: a static term that takes no value twice. *)
Definition exact_static : Prop := forall (f : R -> R) (g : left_side) (x u : R -> R) (r h t : R),
  odd f -> (forall a b, f a = f b -> a = b) -> integrating g -> odd_process g ->
  mirrored h r x -> u (t + h) = - u t ->
  f (x t) + g (jet x t) = u t -> f (x (t + h)) + g (jet x (t + h)) = u (t + h) -> r = 0.

(** Linear processes under a relay with one switching each way. *)
Definition relay_orbits : Prop := forall (P : linear_process) (C x_a r high low : R) (u : R -> R) (z : R -> nat -> R),
  0 < C -> relay_orbit P C x_a 0 r high low u z ->
  (has_integrator P -> high = low) /\
  (has_integrator P -> rests_without_command P -> mirrored high r (response P z)) /\
  (rests_at_zero P -> high = low -> r = 0).

(** * Proof *)

Lemma bias_of_mean c B X delta : 0 < X -> of_lemma_1 c B X -> mean (output c B X) = - delta ->
  (delta = 0 -> B = 0) /\ (0 < delta -> B < 0) /\ (delta < 0 -> 0 < B).
Proof.
  intros HX [mono [image rise]] E. destruct (with_memory_holds c B X HX mono image rise) as [_ [L1 [L2 L3]]].
  destruct (Rtotal_order B 0) as [L|[L|L]]; [apply L2 in L|apply L3 in L|apply L1 in L]; repeat split; intros; lra.
Qed.

Lemma left_side_mean G x m w : 0 < w -> integrating G -> odd_process G -> mirrored (PI / w) m x ->
  ex_RInt (fun theta => G (jet x (theta / w))) 0 PI -> is_RInt (fun theta => G (jet x (theta / w))) 0 (2 * PI) 0.
Proof.
  intros Hw HG Ho M E. pose proof PI_RGT_0. apply half_period_cancels; [lra| |exact E]. intros theta.
  replace ((theta + PI) / w) with (theta / w + PI / w) by (field; lra). now apply (left_side_half_period G x (PI / w) m).
Qed.

Lemma first_harmonic_nonlinear_holds : first_harmonic_nonlinear.
Proof.
  intros G c B X w r delta HX Hw HG Ho Hc x E Bal. pose proof PI_RGT_0. apply (bias_of_mean c B X delta HX Hc).
  assert (M : mirrored (PI / w) (r - B) x).
  { intros t. unfold x. pose proof (sinusoid_mirrored B X w Hw t) as S. simpl in S. lra. }
  pose proof (left_side_mean G x (r - B) w Hw HG Ho M E) as Z. unfold mean at 1 in Bal. rewrite (RInt_of _ _ _ _ Z) in Bal.
  replace (0 / (2 * PI)) with 0 in Bal by (field; lra). lra.
Qed.

Lemma in_angle (y : R -> R) (w l : R) : 0 < w -> is_RInt (fun t => y (w * t)) 0 (2 * PI / w) l -> is_RInt y 0 (2 * PI) (w * l).
Proof.
  intros Hw I. pose proof PI_RGT_0.
  assert (K : is_RInt (fun theta => scal (/ w) ((fun t => y (w * t)) (/ w * theta + 0))) 0 (2 * PI) l).
  { apply (is_RInt_comp_lin (V := R_NormedModule) (fun t => y (w * t)) (/ w) 0 0 (2 * PI) l).
    replace (/ w * 0 + 0) with 0 by ring. replace (/ w * (2 * PI) + 0) with (2 * PI / w) by (field; lra). exact I. }
  refine (ext _ _ _ _ _ _ _ (multiply _ w _ _ _ K)); [lra|]. intros theta _. unfold scal; simpl; unfold mult; simpl.
  replace (w * (/ w * theta + 0)) with theta by (field; lra). field. lra.
Qed.

Lemma first_harmonic_linear_holds : first_harmonic_linear.
Proof.
  intros P c B X w z HX Hw HP Hc M Rz. pose proof PI_RGT_0.
  pose proof (integrator_balance P _ z _ HP M Rz 0) as I. rewrite Rplus_0_l in I. apply in_angle in I; [|exact Hw].
  apply (bias_of_mean c B X 0 HX Hc); [|reflexivity]. unfold mean. rewrite (RInt_of _ _ _ _ I). field. lra.
Qed.

Lemma first_harmonic_static_holds : first_harmonic_static.
Proof.
  intros f g c X w r HX Hw Hf mono inside Hg Ho image Ec x Eg Bal. pose proof PI_RGT_0.
  assert (M : mirrored (PI / w) r x) by (apply sinusoid_mirrored; exact Hw).
  pose proof (left_side_mean g x r w Hw Hg Ho M Eg) as Z.
  destruct (without_memory_holds f r X HX Hf mono inside) as [[Ef _] Z1]. apply Z1. apply integral_of in Ef.
  assert (S : is_RInt (fun theta => f (x (theta / w)) + g (jet x (theta / w))) 0 (2 * PI) (RInt (output (static f) r X) 0 (2 * PI) + 0)).
  { apply add; [|exact Z]. refine (ext _ _ _ _ _ _ _ Ef); [lra|]. intros theta _. rewrite output_static. unfold x, sweep.
    replace (w * (theta / w)) with theta by (field; lra). reflexivity. }
  rewrite (mean_of_images c X image Ec) in Bal. unfold mean in Bal. rewrite (RInt_of _ _ _ _ S), Rplus_0_r in Bal. exact Bal.
Qed.

Lemma first_harmonic_linear_static_holds : first_harmonic_linear_static.
Proof.
  intros P c X w r z HX Hw HP image Ec M Rz Bal. pose proof PI_RGT_0.
  pose proof (mean_of_images c X image Ec) as Z.
  assert (U : is_RInt (fun t => output c 0 X (w * t)) 0 (2 * PI / w) 0).
  { assert (K : is_RInt (fun t => scal w (output c 0 X (w * t + 0))) 0 (2 * PI / w) (RInt (output c 0 X) 0 (2 * PI))).
    { apply (is_RInt_comp_lin (V := R_NormedModule) (output c 0 X) w 0 0 (2 * PI / w)).
      replace (w * 0 + 0) with 0 by ring. replace (w * (2 * PI / w) + 0) with (2 * PI) by (field; lra). now apply integral_of. }
    assert (L : RInt (output c 0 X) 0 (2 * PI) = 0).
    { unfold mean in Z. apply (Rmult_eq_reg_r (/ (2 * PI))); [lra|]. apply Rinv_neq_0_compat. lra. }
    rewrite L in K. apply (equal _ _ _ (/ w * 0)); [|ring].
    refine (ext _ _ _ _ _ _ _ (multiply _ (/ w) _ _ _ K)).
    - left. apply Rdiv_lt_0_compat; lra.
    - intros t _. unfold scal; simpl; unfold mult; simpl. rewrite Rplus_0_r. field. lra. }
  pose proof (static_balance P _ z _ HP M Rz U) as S.
  pose proof (subtract _ _ _ _ _ _ (constant_integral r 0 (2 * PI / w)) S) as D.
  apply RInt_of in Bal, D. rewrite Bal in D. assert (0 < 2 * PI / w) by (apply Rdiv_lt_0_compat; lra).
  apply (Rmult_eq_reg_l (2 * PI / w)); lra.
Qed.

Lemma exact_nonlinear_holds : exact_nonlinear.
Proof.
  intros G F x r m h HG Ho Fodd mono cont M eq [t0 F0]. set (B := r - m).
  destruct (Req_dec B 0) as [Z|N]; [unfold B in Z; lra|exfalso].
  set (s := fun t => m - x t). assert (Hs : forall t, r - x t = B + s t) by (intros; unfold B, s; ring).
  assert (flip : forall t, F (B + s t) = F (- B + s t)).
  { intros t. rewrite <- !Hs, <- !eq. rewrite <- (Ropp_involutive (G (jet x t))), <- (left_side_half_period G x h m t HG Ho M).
    rewrite eq, <- Fodd. f_equal. rewrite (M t). unfold B, s. ring. }
  set (a := Rabs B). assert (Ha : 0 < a) by now apply Rabs_pos_lt.
  assert (flat : forall t, F (s t - a) = F (s t + a)).
  { intros t. unfold a, Rabs. destruct (Rcase_abs B); rewrite <- ?(Rplus_comm B), ?(Rplus_comm (s t)); pose proof (flip t) as E.
    - replace (s t - - B) with (B + s t) by ring. exact E.
    - replace (s t - B) with (- B + s t) by ring. symmetry. exact E. }
  set (X := Rabs (s t0)). assert (HX : 0 <= X) by apply Rabs_pos.
  (* every value between the two half waves occurs *)
  assert (occurs : forall y, - X <= y <= X -> exists t, s t = y).
  { intros y Hy. assert (cs : continuity s) by (apply continuity_minus; [apply continuity_const; now intros ? ?|exact cont]).
    assert (Sh : s (t0 + h) = - s t0) by (unfold s; rewrite M; ring).
    destruct (IVT_gen s t0 (t0 + h) y cs) as [t [_ E]]; [|now exists t]. rewrite Sh. unfold X, Rabs in Hy. unfold Rmin, Rmax.
    destruct (Rcase_abs (s t0)), (Rle_dec (s t0) (- s t0)); lra. }
  set (p := r - x t0) in *. assert (Np : p <> 0) by (intros E; apply F0; rewrite E; specialize (Fodd 0); rewrite Ropp_0 in Fodd; lra).
  assert (Hp : Rabs p <= X + a).
  { unfold p. rewrite Hs. unfold X, a. rewrite Rplus_comm. apply Rabs_triang. }
  assert (Pp : 0 < Rabs p) by now apply Rabs_pos_lt.
  assert (rise : F (- Rabs p) < F (Rabs p)).
  { assert (L : F (- Rabs p) <= F (Rabs p)) by (apply mono; lra). rewrite Fodd in *.
    assert (F (Rabs p) <> 0); [|lra]. unfold Rabs. destruct (Rcase_abs p); [rewrite Fodd; lra|exact F0]. }
  destruct (close_rise F (- Rabs p) (Rabs p) (2 * a)) as [u [v [H1 [H2 [H3 [H4 H5]]]]]]; try lra.
  destruct (occurs (Rmax (v - a) (- X))) as [t Et]; [unfold Rmax; destruct (Rle_dec (v - a) (- X)); lra|].
  assert (v - a <= s t <= u + a) by (rewrite Et; unfold Rmax; destruct (Rle_dec (v - a) (- X)); lra).
  assert (F (s t - a) <= F u) by (apply mono; lra). assert (F v <= F (s t + a)) by (apply mono; lra).
  rewrite (flat t) in *. lra.
Qed.

Lemma exact_integrating_chain_holds : exact_integrating_chain.
Proof.
  intros F s w B h Hh Hodd mono cs flip inside I per. pose proof (I 0 (0 + (h + h))) as Z. rewrite per, Rplus_0_l, Rminus_eq_0 in Z.
  destruct (on_mirrored_half_waves_holds F s B h 0 Hh Hodd mono cs flip inside Z) as [L1 [L2 _]].
  destruct (Rtotal_order B 0) as [L|[L|L]]; [apply L2 in L; lra|exact L|apply L1 in L; lra].
Qed.

Lemma turns_continuous (u : R -> R) (a b t e s : R) : 0 < e -> (forall s, t - e < s < t -> u s = a) -> (forall s, t < s < t + e -> u s = b) ->
  t - e < s < t + e -> s <> t -> continuous u s.
Proof.
  intros He L H Hs N. assert (D : 0 < Rmin (Rabs (s - t)) (Rmin (s - (t - e)) (t + e - s))).
  { apply Rmin_pos; [apply Rabs_pos_lt; lra|apply Rmin_pos; lra]. }
  apply (continuous_ext_loc u (fun _ => u s) s); [|apply continuous_const].
  exists (mkposreal _ D). intros y Hy. change (Rabs (y - s) < Rmin (Rabs (s - t)) (Rmin (s - (t - e)) (t + e - s))) in Hy.
  pose proof (Rmin_l (Rabs (s - t)) (Rmin (s - (t - e)) (t + e - s))). pose proof (Rmin_r (Rabs (s - t)) (Rmin (s - (t - e)) (t + e - s))).
  pose proof (Rmin_l (s - (t - e)) (t + e - s)). pose proof (Rmin_r (s - (t - e)) (t + e - s)).
  assert (Hy' : Rabs (y - s) < Rabs (s - t)) by lra. assert (- (s - (t - e)) < y - s < t + e - s).
  { assert (A : Rabs (y - s) < s - (t - e)) by lra. assert (A' : Rabs (y - s) < t + e - s) by lra.
    apply Rabs_def2 in A. apply Rabs_def2 in A'. lra. }
  destruct (Rtotal_order s t) as [S|[S|S]]; [|contradiction|].
  - rewrite (Rabs_left (s - t)) in Hy' by lra. apply Rabs_def2 in Hy'. rewrite !L; lra.
  - rewrite (Rabs_right (s - t)) in Hy' by lra. apply Rabs_def2 in Hy'. rewrite !H; lra.
Qed.

Lemma exact_nonlinear_relay_holds : exact_nonlinear_relay.
Proof.
  intros G u x C x_a r m h HG Ho M eq isolated up_ down_ [t T].
  assert (half : turns u C (- C) (t + h)).
  { destruct T as [e [He [L H]]]. destruct (isolated (t + h)) as [a [b [d [Hd [L' H']]]]].
    set (q := Rmin e d). assert (Q : 0 < q <= e /\ q <= d) by (unfold q; pose proof (Rmin_l e d); pose proof (Rmin_r e d); pose proof (Rmin_pos e d He Hd); lra).
    assert (flip : forall s, t - q < s < t + q -> s <> t -> u (s + h) = - u s).
    { intros s Hs N. rewrite <- (eq s), <- (eq (s + h)).
      - now apply (left_side_half_period G x h m).
      - apply (turns_continuous u a b (t + h) d); trivial; lra.
      - apply (turns_continuous u (- C) C t e); trivial; lra. }
    exists q. split; [lra|]. split; intros s Hs.
    - assert (E : u (s - h + h) = - u (s - h)) by (apply flip; lra). replace (s - h + h) with s in E by ring. rewrite E, L by lra. ring.
    - assert (E : u (s - h + h) = - u (s - h)) by (apply flip; lra). replace (s - h + h) with s in E by ring. rewrite E, H by lra. ring. }
  pose proof (up_ t T). pose proof (down_ _ half) as D. rewrite (M t) in D. lra.
Qed.

Lemma Derive_plus_constant (c : R) (f : R -> R) k t : Derive_n (fun t => f t + c) (S k) t = Derive_n f (S k) t.
Proof.
  transitivity (Derive_n (fun t => c - (- f t)) (S k) t); [apply Derive_n_ext; intros; ring|].
  rewrite Derive_from_constant, Derive_n_opp. ring.
Qed.

Lemma reference_holds : reference_does_not_matter.
Proof.
  intros G obeys r r' x u HG [eq ob]. split.
  - intros t Ct. rewrite <- (eq t Ct). apply HG. intros [|k] Hk; [lia|]. apply Derive_plus_constant.
  - replace (fun t => r' - (x t + (r' - r))) with (fun t => r - x t); [exact ob|]. apply FunctionalExtensionality.functional_extensionality. intros t. ring.
Qed.

Lemma unique_holds : unique_is_symmetric.
Proof.
  intros G obeys r T x u HG Ho Hlaw [eq ob] [HT per] unique.
  destruct (unique (fun t => 2 * r - x t) (fun t => - u t)) as [phase E].
  - split.
    + intros t Ct. assert (C' : continuous u t).
      { apply (continuous_ext (fun t => - - u t)); [intros s; exact (Ropp_involutive (u s))|]. exact (continuous_opp (V := R_NormedModule) (fun t => - u t) t Ct). }
      rewrite <- (eq t C'), <- Ho. apply HG. intros [|k] Hk; [lia|]. apply Derive_from_constant.
    + replace (fun t => r - (2 * r - x t)) with (fun t => - (r - x t)); [now apply Hlaw|]. apply FunctionalExtensionality.functional_extensionality. intros t. ring.
  - split; [exact HT|]. intros t. now rewrite per.
  - destruct (within_a_period T phase HT) as [k [s [Hs ->]]].
    assert (E' : forall t, x (t + (s + T)) = 2 * r - x t).
    { intros t. rewrite E. rewrite <- (shift_by_periods x T per (k - 1) (t + (s + T))). f_equal. rewrite minus_IZR. ring. }
    exists (s + T). split; [lra|exact E'].
Qed.

Lemma exact_static_holds : exact_static.
Proof.
  intros f g x u r h t Hf inj Hg Ho M U E1 E2. rewrite (left_side_half_period g x h r t Hg Ho M), U, <- E1, (M t) in E2.
  assert (E : f (2 * r - x t) = f (- x t)) by (rewrite Hf; lra). apply inj in E. lra.
Qed.

Lemma relay_orbits_hold : relay_orbits.
Proof.
  intros P C x_a r high low u z HC O.
  assert (equal_times : has_integrator P -> high = low).
  { intros HP. pose proof (times_of_orbit P C x_a 0 r high low u z HP HC O) as T. destruct O as [Hh Hl _ _ _ _ _ _ _].
    replace (0 / C) with 0 in T by (field; lra). apply (Rmult_eq_compat_r (high + low)) in T. field_simplify in T; lra. }
  split; [exact equal_times|split].
  - intros HP Rest. rewrite <- (equal_times HP) in O. now apply (equal_times_mirrored P C x_a r high u z O).
  - intros Rest <-. now apply (equal_times_mirrored P C x_a r high u z O).
Qed.

Theorem statement :
  (first_harmonic_nonlinear /\ first_harmonic_linear /\ first_harmonic_static /\ first_harmonic_linear_static) /\
  (exact_nonlinear /\ exact_integrating_chain /\ exact_nonlinear_relay /\ reference_does_not_matter /\ unique_is_symmetric /\ exact_static) /\
  relay_orbits.
Proof.
  exact (conj (conj first_harmonic_nonlinear_holds (conj first_harmonic_linear_holds
                (conj first_harmonic_static_holds first_harmonic_linear_static_holds)))
        (conj (conj exact_nonlinear_holds (conj exact_integrating_chain_holds (conj exact_nonlinear_relay_holds
                (conj reference_holds (conj unique_holds exact_static_holds)))))
              relay_orbits_hold)).
Qed.
Print Assumptions statement.

(** * As printed *)

(** A motion of a loop with a memoryless characteristic, exactly. *)
Definition exact_motion (G : left_side) (F : R -> R) (r T : R) (x : R -> R) : Prop :=
  periodic T x /\ forall t, G (jet x t) = F (r - x t).
(** Symmetric: the error has no constant part. *)
Definition symmetric (r T : R) (x : R -> R) : Prop := is_RInt (fun t => r - x t) 0 T 0.

Definition as_printed_if : Prop := forall G F r T x, integrating G -> odd F -> exact_motion G F r T x -> symmetric r T x.
Definition as_printed_only_if : Prop := forall G F r T x, odd F -> exact_motion G F r T x -> (exists t, x t <> r) -> symmetric r T x -> integrating G.

(** A sinusoid's derivatives. *)
Lemma sinusoid_jet a k w t : let x := fun t => a - k * sin (w * t) in
  Derive_n x 1 t = - k * w * cos (w * t) /\ Derive_n x 2 t = k * w * w * sin (w * t) /\ Derive_n x 3 t = k * w * w * w * cos (w * t).
Proof.
  intros x.
  assert (D1 : forall t, Derive_n x 1 t = - k * w * cos (w * t)) by (intros s; apply is_derive_unique; unfold x; auto_derive; [trivial|ring]).
  assert (D2 : forall t, Derive_n x 2 t = k * w * w * sin (w * t)).
  { intros s. change (Derive (Derive_n x 1) s = k * w * w * sin (w * s)). rewrite (Derive_ext _ _ _ D1). apply is_derive_unique. auto_derive; [trivial|ring]. }
  split; [apply D1|split; [apply D2|]].
  change (Derive (Derive_n x 2) t = k * w * w * w * cos (w * t)). rewrite (Derive_ext _ _ _ D2). apply is_derive_unique. auto_derive; [trivial|ring].
Qed.

Lemma sinusoid_periodic a k : periodic (2 * PI) (fun t => a - k * sin (1 * t)).
Proof. pose proof PI_RGT_0. split; [lra|]. intros t. rewrite !Rmult_1_l, sin_turn. reflexivity. Qed.

Lemma sinusoid_integral a k : is_RInt (fun t => a + k * sin (1 * t)) 0 (2 * PI) (2 * PI * a).
Proof.
  apply (equal _ _ _ (a * (2 * PI) - k * cos (2 * PI) - (a * 0 - k * cos 0))); [|rewrite cos_2PI, cos_0; ring].
  apply (by_antiderivative (fun t => a * t - k * cos t)); intros t; auto_derive; trivial. replace (1 * t) with t by ring. ring.
Qed.

(** [(x''' + 2 x'' + x')/2 = u]: two lags and an integrator. *)
Definition third_order : left_side := fun d => (d 3%nat + 2 * d 2%nat + d 1%nat) / 2.
Lemma third_order_integrating : integrating third_order /\ odd_process third_order.
Proof. split; [intros d e H; unfold third_order; rewrite !H by lia; reflexivity|intros d; unfold third_order; field]. Qed.

(** [F = x - 2 sgn(x)], odd: the oscillation [-(2 + sin t)] about the reference zero. *)
Definition sawtooth (x : R) : R := x - 2 * Rcomplements.sign x.
Theorem as_printed_false : ~ as_printed_if.
Proof.
  intros H. pose proof PI_RGT_0. set (x := fun t => -2 - 1 * sin (1 * t)).
  assert (S : symmetric 0 (2 * PI) x).
  { apply (H third_order sawtooth); [apply third_order_integrating|intros y; unfold sawtooth; rewrite sign_opp; ring|].
    split; [apply sinusoid_periodic|]. intros t. destruct (sinusoid_jet (-2) 1 1 t) as [D1 [D2 D3]]. fold x in D1, D2, D3.
    unfold third_order, jet. rewrite D1, D2, D3. unfold sawtooth, x. destruct (SIN_bound (1 * t)).
    rewrite sign_eq_1 by lra. field. }
  assert (Q : is_RInt (fun t => 0 - x t) 0 (2 * PI) (2 * PI * 2)).
  { refine (ext _ _ _ _ _ _ _ (sinusoid_integral 2 1)); [lra|]. intros t _. unfold x. ring. }
  apply RInt_of in S, Q. rewrite S in Q. lra.
Qed.

(** A static process, reference zero, a saturation: symmetric. *)
Definition static_process : left_side := fun d => (d 3%nat + 3 * d 2%nat + 3 * d 1%nat + d 0%nat) / 8.
Definition saturation (x : R) : R := Rmax (-1) (Rmin x 1).
Lemma saturation_odd : odd saturation.
Proof. intros x. unfold saturation, Rmax, Rmin. by_cases; lra. Qed.
Lemma saturation_nondecreasing : nondecreasing saturation.
Proof. intros a b ab. unfold saturation, Rmax, Rmin. by_cases; lra. Qed.
Lemma saturation_inside x : -1 <= x <= 1 -> saturation x = x.
Proof. intros H. unfold saturation. rewrite Rmin_left, Rmax_right by lra. reflexivity. Qed.

Lemma static_motion r k : Rabs r / 9 + Rabs k <= 1 ->
  exact_motion static_process saturation r (2 * PI / sqrt 3) (fun t => 8 * r / 9 - k * sin (sqrt 3 * t)).
Proof.
  intros Hk. pose proof PI_RGT_0. assert (S : 0 < sqrt 3) by (apply sqrt_lt_R0; lra). assert (Q : sqrt 3 * sqrt 3 = 3) by (apply sqrt_sqrt; lra).
  split; [split; [apply Rdiv_lt_0_compat; lra|]|].
  - intros t. replace (sqrt 3 * (t + 2 * PI / sqrt 3)) with (sqrt 3 * t + 2 * PI) by (field; lra). now rewrite sin_turn.
  - intros t. destruct (sinusoid_jet (8 * r / 9) k (sqrt 3) t) as [D1 [D2 D3]].
    unfold static_process, jet. rewrite D1, D2, D3. simpl (Derive_n _ 0 t).
    replace (k * sqrt 3 * sqrt 3) with (3 * k) by (rewrite Rmult_assoc, Q; ring).
    rewrite saturation_inside; [field|]. destruct (SIN_bound (sqrt 3 * t)). unfold Rabs in Hk. destruct (Rcase_abs r), (Rcase_abs k); nra.
Qed.

Theorem as_printed_only_if_false : ~ as_printed_only_if.
Proof.
  intros H. pose proof PI_RGT_0. assert (S : 0 < sqrt 3) by (apply sqrt_lt_R0; lra).
  assert (I : integrating static_process).
  { apply (H _ saturation 0 (2 * PI / sqrt 3) (fun t => 8 * 0 / 9 - 1 * sin (sqrt 3 * t)) saturation_odd).
    - apply static_motion. rewrite Rabs_R0, Rabs_R1. lra.
    - exists (PI / 2 / sqrt 3). replace (sqrt 3 * (PI / 2 / sqrt 3)) with (PI / 2) by (field; lra). rewrite sin_PI2. lra.
    - unfold symmetric. apply (equal _ _ _ (- cos (2 * PI) / sqrt 3 - - cos 0 / sqrt 3)); [|rewrite cos_2PI, cos_0; field; lra].
      replace (2 * PI) with (sqrt 3 * (2 * PI / sqrt 3)) at 2 by (field; lra). rewrite <- (Rmult_0_r (sqrt 3)) at 2.
      apply (by_antiderivative (fun t => - cos (sqrt 3 * t) / sqrt 3)); intros t; auto_derive; trivial. field. lra. }
  assert (E : static_process (fun _ => 0) = static_process (fun k => match k with O => 8 | S _ => 0 end)).
  { apply I. intros [|k] Hk; [lia|reflexivity]. }
  unfold static_process in E. lra.
Qed.

(** Without integrator, about the reference 9/2, odd and nondecreasing: the error has the constant part 1/2. *)
Theorem needs_integrating : exists x T, odd saturation /\ nondecreasing saturation /\
  exact_motion static_process saturation (9 / 2) T x /\ (exists t, x t <> 4) /\ ~ symmetric (9 / 2) T x.
Proof.
  pose proof PI_RGT_0. assert (S : 0 < sqrt 3) by (apply sqrt_lt_R0; lra).
  exists (fun t => 8 * (9 / 2) / 9 - 1 / 2 * sin (sqrt 3 * t)), (2 * PI / sqrt 3).
  split; [exact saturation_odd|]. split; [exact saturation_nondecreasing|]. split; [apply static_motion; rewrite !Rabs_right; lra|]. split.
  - exists (PI / 2 / sqrt 3). replace (sqrt 3 * (PI / 2 / sqrt 3)) with (PI / 2) by (field; lra). rewrite sin_PI2. lra.
  - unfold symmetric. intros I.
    assert (J : is_RInt (fun t => 9 / 2 - (8 * (9 / 2) / 9 - 1 / 2 * sin (sqrt 3 * t))) 0 (2 * PI / sqrt 3)
      (1 / 2 * (2 * PI / sqrt 3) - 1 / 2 * cos (sqrt 3 * (2 * PI / sqrt 3)) / sqrt 3 - (1 / 2 * 0 - 1 / 2 * cos (sqrt 3 * 0) / sqrt 3))).
    { apply (by_antiderivative (fun t => 1 / 2 * t - 1 / 2 * cos (sqrt 3 * t) / sqrt 3)); intros t; auto_derive; trivial. field. lra. }
    apply RInt_of in I, J. rewrite I in J. replace (sqrt 3 * (2 * PI / sqrt 3)) with (2 * PI) in J by (field; lra).
    rewrite !Rmult_0_r, cos_2PI, cos_0 in J. assert (0 < 2 * PI / sqrt 3) by (apply Rdiv_lt_0_compat; lra). lra.
Qed.

(** Without an odd characteristic: a saturation with an offset. *)
Theorem needs_odd : exists F x, nondecreasing F /\ integrating third_order /\ exact_motion third_order F 0 (2 * PI) x /\ ~ symmetric 0 (2 * PI) x.
Proof.
  pose proof PI_RGT_0. exists (fun y => Rmax (-2) (Rmin y 2) + 1), (fun t => 1 - 1 * sin (1 * t)).
  split; [intros a b ab; unfold Rmax, Rmin; by_cases; lra|]. split; [apply third_order_integrating|]. split.
  - split; [apply sinusoid_periodic|]. intros t. destruct (sinusoid_jet 1 1 1 t) as [D1 [D2 D3]]. unfold third_order, jet. rewrite D1, D2, D3.
    destruct (SIN_bound (1 * t)). rewrite Rmin_left, Rmax_right by lra. field.
  - intros I. assert (Q : is_RInt (fun t => 0 - (1 - 1 * sin (1 * t))) 0 (2 * PI) (2 * PI * -1)).
    { refine (ext _ _ _ _ _ _ _ (sinusoid_integral (-1) 1)); [lra|]. intros t _. ring. }
    apply RInt_of in I, Q. rewrite I in Q. lra.
Qed.

(** Without monotony: the sawtooth above; and on the first harmonic [x^3 - 2 x] with [2/(s (s + 1)^2)], which turns over at 1 rad/s
    with the gain one: [F_0 = 0] and [1 + (P + j Q) G(j) = 0] at bias and amplitude [2/sqrt(5)]. *)
Theorem needs_nondecreasing : exists B X d, B <> 0 /\ 0 < X /\ odd (eval [0; -2; 0; 1]) /\
  describes (static (eval [0; -2; 0; 1])) B X d /\ f0 d = 0 /\
  (1 + (p d, q d) * (2 / (Ci * ((Ci + 1) * (Ci + 1)))))%C = 0%C.
Proof.
  set (B := sqrt (4 / 5)). assert (Q : B * B = 4 / 5) by (apply sqrt_sqrt; lra). assert (HB : 0 < B) by (apply sqrt_lt_R0; lra).
  exists B, B, (polynomial_df [0; -2; 0; 1] B B). repeat match goal with |- _ /\ _ => split end.
  - lra.
  - exact HB.
  - intros x. simpl. ring.
  - apply Claim_polynomial.statement.
  - simpl. match goal with |- ?l = 0 => replace l with (B * (5 / 2 * (B * B) - 2)) by field end. rewrite Q. field.
  - assert (P : p (polynomial_df [0; -2; 0; 1] B B) = 1).
    { simpl. match goal with |- ?l = 1 => replace l with (15 / 4 * (B * B) - 2) by field end. rewrite Q. field. }
    rewrite P. simpl (q _).
    replace (Ci * ((Ci + 1) * (Ci + 1)))%C with (RtoC (-2)) by (unfold Ci, RtoC, Cmult, Cplus; simpl; f_equal; ring).
    unfold Cdiv, Cinv, RtoC, Cmult, Cplus; simpl. f_equal; field.
Qed.
