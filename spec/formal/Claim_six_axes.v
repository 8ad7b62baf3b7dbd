(** claim: six-axes (eq. 5)
    In [(M_RB + M_A) nu' + (C_RB + C_A) nu + D nu + g = tau + tau_E] the inertia is symmetric and positive definite, so that nu' is
    determined; Coriolis and centripetal forces do no work; drag takes energy whatever the motion. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Selfosc Require Import Common SixAxes.
Import ListNotations.
Open Scope R_scope.

(** * A body: points with masses *)

Record point := { mass : R; place : vector }.

Fixpoint total (f : point -> R) (body : list point) : R := match body with [] => 0 | p :: rest => f p + total f rest end.
Definition mass_of (body : list point) : R := total mass body.
Definition centre (body : list point) : vector := fun i => total (fun p => mass p * place p i) body / mass_of body.
Definition square (u : vector) : R := u 0%nat * u 0%nat + u 1%nat * u 1%nat + u 2%nat * u 2%nat.
Definition inertia (body : list point) : matrix := fun i j =>
  total (fun p => mass p * ((if Nat.eqb i j then square (place p) else 0) - place p i * place p j)) body.
Definition inertia_of (body : list point) : matrix := rigid_body (mass_of body) (centre body) (inertia body).

(** Every mass is positive, and three points are not on one line. *)
Definition is_body (body : list point) : Prop := (forall p, In p body -> 0 < mass p) /\
  exists a b c, In a body /\ In b body /\ In c body /\
    0 < square (cross (fun i => place b i - place a i) (fun i => place c i - place a i)).

(** The velocity of a point of the body. *)
Definition velocity (nu : vector) (p : point) : vector := fun i => nu i + cross (angular nu) (place p) i.

(** Twice the kinetic energy is that of the points. *)
Lemma energy_of_points body nu : mass_of body <> 0 ->
  dot 6 nu (times 6 (inertia_of body) nu) = total (fun p => mass p * square (velocity nu p)) body.
Proof.
  intros M0.
  assert (E : forall m_r i, (forall k, m_r k = total (fun p => mass p * place p k) body) -> mass_of body * centre body i = m_r i).
  { intros m_r i H. unfold centre. rewrite H. field. exact M0. }
  set (m_r := fun k => total (fun p => mass p * place p k) body). specialize (E m_r).
  assert (E' : forall i, mass_of body * centre body i = m_r i) by (intros i; apply E; reflexivity). clear E.
  unfold dot, times, inertia_of, rigid_body, blocks, diagonal, opposite, skew. simpl. rewrite !E'. unfold m_r, mass_of, inertia. clear.
  induction body as [|p body IH]; simpl.
  - ring.
  - rewrite <- IH. unfold velocity, square, cross, times, skew, angular. simpl. ring.
Qed.

Lemma total_nonneg f body : (forall p, In p body -> 0 <= f p) -> 0 <= total f body.
Proof.
  induction body as [|p body IH]; intros H; simpl; [lra|]. pose proof (H p (or_introl eq_refl)). specialize (IH (fun q Q => H q (or_intror Q))). lra.
Qed.

Lemma total_zero f body : (forall p, In p body -> 0 <= f p) -> total f body <= 0 -> forall p, In p body -> f p = 0.
Proof.
  induction body as [|q body IH]; intros H T p Hp; [destruct Hp|]. simpl in T. pose proof (H q (or_introl eq_refl)) as Q.
  pose proof (total_nonneg f body (fun r Hr => H r (or_intror Hr))) as N.
  destruct Hp as [<-|Hp]; [lra|]. apply IH; [intros r Hr; apply H; right; exact Hr|lra|exact Hp].
Qed.

Lemma mass_positive body : is_body body -> 0 < mass_of body.
Proof.
  intros [M [a [_ [_ [A _]]]]]. unfold mass_of. assert (N : 0 <= total mass body) by (apply total_nonneg; intros p Hp; left; apply M, Hp).
  destruct N as [N|N]; [exact N|exfalso]. pose proof (total_zero mass body (fun p Hp => Rlt_le _ _ (M p Hp)) ltac:(lra) a A). specialize (M a A). lra.
Qed.

Lemma square_nonneg u : 0 <= square u.
Proof. unfold square. nra. Qed.
Lemma square_zero u : square u = 0 -> u 0%nat = 0 /\ u 1%nat = 0 /\ u 2%nat = 0.
Proof. unfold square. intros H. repeat split; nra. Qed.

Lemma body_definite body : is_body body -> positive_definite 6 (inertia_of body).
Proof.
  intros B nu N. pose proof (mass_positive body B) as M0. rewrite energy_of_points by lra. destruct B as [M [a [b [c [A [Bb [Cc S]]]]]]].
  assert (P : forall p, In p body -> 0 <= mass p * square (velocity nu p)).
  { intros p Hp. apply Rmult_le_pos; [left; apply M, Hp|apply square_nonneg]. }
  destruct (total_nonneg _ body P) as [Q|Q]; [exact Q|exfalso].
  assert (Z : forall p, In p body -> velocity nu p 0%nat = 0 /\ velocity nu p 1%nat = 0 /\ velocity nu p 2%nat = 0).
  { intros p Hp. apply square_zero. pose proof (total_zero _ body P ltac:(lra) p Hp) as E. cbv beta in E. pose proof (M p Hp).
    apply Rmult_integral in E. destruct E as [E|E]; [lra|exact E]. }
  destruct (Z a A) as [A0 [A1 A2]]. destruct (Z b Bb) as [B0 [B1 B2]]. destruct (Z c Cc) as [C0 [C1 C2]].
  unfold velocity, cross, times, skew, angular, square in *. simpl in *. clear Z P Q.
  set (p := nu 3%nat) in *. set (q := nu 4%nat) in *. set (r := nu 5%nat) in *.
  set (x1 := place b 0%nat - place a 0%nat) in *. set (y1 := place b 1%nat - place a 1%nat) in *. set (z1 := place b 2%nat - place a 2%nat) in *.
  set (x2 := place c 0%nat - place a 0%nat) in *. set (y2 := place c 1%nat - place a 1%nat) in *. set (z2 := place c 2%nat - place a 2%nat) in *.
  (* the turn has no part across either difference *)
  assert (U1 : q * z1 = r * y1) by (unfold z1, y1; lra). assert (U2 : r * x1 = p * z1) by (unfold x1, z1; lra). assert (U3 : p * y1 = q * x1) by (unfold x1, y1; lra).
  assert (V1 : q * z2 = r * y2) by (unfold z2, y2; lra). assert (V2 : r * x2 = p * z2) by (unfold x2, z2; lra). assert (V3 : p * y2 = q * x2) by (unfold x2, y2; lra).
  set (n1 := y1 * z2 - z1 * y2). set (n2 := z1 * x2 - x1 * z2). set (n3 := x1 * y2 - y1 * x2).
  assert (S' : 0 < n1 * n1 + n2 * n2 + n3 * n3) by (unfold n1, n2, n3; replace (n1 * n1) with (n1 * n1) by ring; lra).
  assert (D1 : p * n1 + q * n2 = 0).
  { replace (p * n1 + q * n2) with (z2 * (p * y1) - z1 * (p * y2) + q * n2) by (unfold n1; ring). rewrite U3, V3. unfold n2. ring. }
  assert (D2 : q * n2 + r * n3 = 0).
  { replace (q * n2 + r * n3) with (x2 * (q * z1) - x1 * (q * z2) + r * n3) by (unfold n2; ring). rewrite U1, V1. unfold n3. ring. }
  assert (D3 : p * n1 + r * n3 = 0).
  { replace (p * n1 + r * n3) with (y1 * (p * z2) - y2 * (p * z1) + r * n3) by (unfold n1; ring). rewrite <- U2, <- V2. unfold n3. ring. }
  assert (W1 : p * n1 = 0 /\ p * n2 = 0 /\ p * n3 = 0).
  { split; [lra|split].
    - replace (p * n2) with (x2 * (p * z1) - x1 * (p * z2)) by (unfold n2; ring). rewrite <- U2, <- V2. ring.
    - replace (p * n3) with (x1 * (p * y2) - x2 * (p * y1)) by (unfold n3; ring). rewrite U3, V3. ring. }
  assert (W2 : q * n1 = 0 /\ q * n2 = 0 /\ q * n3 = 0).
  { split; [|split; [lra|]].
    - replace (q * n1) with (y1 * (q * z2) - y2 * (q * z1)) by (unfold n1; ring). rewrite U1, V1. ring.
    - replace (q * n3) with (y2 * (q * x1) - y1 * (q * x2)) by (unfold n3; ring). rewrite <- U3, <- V3. ring. }
  assert (W3 : r * n1 = 0 /\ r * n2 = 0 /\ r * n3 = 0).
  { split; [|split; [|lra]].
    - replace (r * n1) with (z2 * (r * y1) - z1 * (r * y2)) by (unfold n1; ring). rewrite <- U1, <- V1. ring.
    - replace (r * n2) with (z1 * (r * x2) - z2 * (r * x1)) by (unfold n2; ring). rewrite U2, V2. ring. }
  assert (K : forall w, w * n1 = 0 /\ w * n2 = 0 /\ w * n3 = 0 -> w = 0).
  { intros w [K1 [K2 K3]]. destruct (Req_dec w 0) as [E|E]; [exact E|exfalso].
    apply Rmult_integral in K1. apply Rmult_integral in K2. apply Rmult_integral in K3. destruct K1, K2, K3; try contradiction. rewrite H, H0, H1 in S'. lra. }
  pose proof (K p W1) as Zp. pose proof (K q W2) as Zq. pose proof (K r W3) as Zr. rewrite Zp, Zq, Zr in *.
  destruct N as [i [Hi Ni]]. apply Ni. destruct i as [|[|[|[|[|[|i]]]]]]; [lra|lra|lra|exact Zp|exact Zq|exact Zr|lia].
Qed.

(** * The claim *)

Theorem statement : forall (body : list point) (M_A linear_drag : matrix) (quadratic_drag g : vector),
  (* the hypotheses inertia-of-a-body, added-mass-symmetric, drag-coefficients-dissipate *)
  is_body body ->
  symmetric 6 M_A -> (forall u, nonzero 6 u -> 0 < dot 6 u (times 6 (plus (inertia_of body) M_A) u)) ->
  semidefinite 6 linear_drag -> (forall i, (i < 6)%nat -> 0 <= quadratic_drag i) ->
  let M := plus (inertia_of body) M_A in
  (* inertia is symmetric and positive definite, the body's by itself too *)
  symmetric 6 M /\ positive_definite 6 M /\ symmetric 6 (inertia_of body) /\ positive_definite 6 (inertia_of body) /\
  (* so that nu' is determined *)
  (forall nu tau, exists nu', eq_5 M linear_drag quadratic_drag g nu nu' tau /\
    forall w, eq_5 M linear_drag quadratic_drag g nu w tau -> forall i, (i < 6)%nat -> w i = nu' i) /\
  (* Coriolis and centripetal forces: what turning axes make of the momenta; they do no work *)
  (forall nu, let p := linear (times 6 M nu) in let h := angular (times 6 M nu) in let v := linear nu in let omega := angular nu in
    (forall i, (i < 3)%nat -> times 6 (coriolis M nu) nu i = cross omega p i) /\
    (forall i, (i < 3)%nat -> times 6 (coriolis M nu) nu (3 + i)%nat = cross v p i + cross omega h i)) /\
  (forall nu i j, (i < 6)%nat -> (j < 6)%nat -> coriolis M nu i j = - coriolis M nu j i) /\
  (forall nu, dot 6 nu (times 6 (coriolis M nu) nu) = 0) /\
  (* drag takes energy *)
  (forall nu, 0 <= dot 6 nu (times 6 (drag_matrix linear_drag quadratic_drag nu) nu)).
Proof.
  intros body M_A Dl q g B Sy Pd Sd Q M. pose proof (body_definite body B) as Pb.
  assert (In' : forall i j, inertia body i j = inertia body j i).
  { intros i j. unfold inertia. clear. induction body as [|p body IH]; simpl; [reflexivity|]. rewrite IH, (Nat.eqb_sym i j). ring. }
  assert (Sb : symmetric 6 (inertia_of body)).
  { intros i j Hi Hj. unfold inertia_of, rigid_body, blocks, diagonal, opposite, skew.
    do 6 (destruct i as [|i]; [do 6 (destruct j as [|j]; [simpl; try apply In'; ring|]); lia|]). lia. }
  assert (Sm : symmetric 6 M) by (intros i j Hi Hj; unfold M, plus; rewrite (Sb i j Hi Hj), (Sy i j Hi Hj); reflexivity).
  assert (Pm : positive_definite 6 M) by exact Pd.
  repeat (split; [assumption|]). split; [|split; [|split; [|split]]].
  - intros nu tau.
    set (b := fun i => tau i - times 6 (coriolis M nu) nu i - times 6 (drag_matrix Dl q nu) nu i - g i).
    destruct (definite_solves 6 M Sm Pm b) as [u Hu]. exists u. split.
    + intros i Hi. rewrite (Hu i Hi). unfold b. ring.
    + intros w Hw. apply (definite_once 6 M b w u Pm); [|exact Hu]. intros i Hi. specialize (Hw i Hi). unfold b. lra.
  - intros nu. cbv zeta. unfold coriolis. set (m := times 6 M nu). split; intros i Hi;
      (do 3 (destruct i as [|i]; [unfold times, blocks, opposite, skew, cross, times, linear, angular; simpl; ring|])); lia.
  - intros nu i j Hi Hj. unfold coriolis. set (m := times 6 M nu). unfold blocks, opposite, skew, linear, angular.
    do 6 (destruct i as [|i]; [do 6 (destruct j as [|j]; [simpl; ring|]); lia|]). lia.
  - intros nu. unfold coriolis. set (m := times 6 M nu). unfold dot, times, blocks, opposite, skew, linear, angular. simpl. ring.
  - intros nu. assert (E : dot 6 nu (times 6 (drag_matrix Dl q nu) nu) = dot 6 nu (times 6 Dl nu) + sum 6 (fun i => q i * Rabs (nu i) * (nu i * nu i))).
    { unfold dot, times, drag_matrix, plus, diagonal. simpl. ring. }
    rewrite E. specialize (Sd nu). assert (T : forall i, (i < 6)%nat -> 0 <= q i * Rabs (nu i) * (nu i * nu i)).
    { intros i Hi. apply Rmult_le_pos; [apply Rmult_le_pos; [apply Q, Hi|apply Rabs_pos]|nra]. }
    simpl. pose proof (T 0%nat ltac:(lia)). pose proof (T 1%nat ltac:(lia)). pose proof (T 2%nat ltac:(lia)). pose proof (T 3%nat ltac:(lia)).
    pose proof (T 4%nat ltac:(lia)). pose proof (T 5%nat ltac:(lia)). lra.
Qed.

(** The centre of gravity moved by 3 with the inertia about the origin as it was: the form is negative. *)
Theorem needs_inertia_of_a_body : exists nu, let r_g := fun i => if Nat.eqb i 0 then 3 else 0 in
  dot 6 nu (times 6 (rigid_body 1 r_g (diagonal (fun _ => 1))) nu) < 0.
Proof.
  exists (fun i => match i with 1%nat => - 3 | 5%nat => 1 | _ => 0 end). unfold dot, times, rigid_body, blocks, diagonal, opposite, skew. simpl. lra.
Qed.

(** Added mass with one entry beside its mirror image: the inertia is not symmetric. *)
Theorem needs_added_mass_symmetric : forall M, symmetric 6 M -> exists M_A, ~ symmetric 6 (plus M M_A).
Proof.
  intros M Sy. exists (fun i j => match i, j with 0%nat, 1%nat => 1 | _, _ => 0 end). intros H.
  specialize (H 0%nat 1%nat ltac:(lia) ltac:(lia)). unfold plus in H. rewrite (Sy 0%nat 1%nat) in H by lia. lra.
Qed.

(** Linear drag that pushes gives energy. *)
Theorem needs_drag_coefficients_dissipate : exists linear_drag nu, dot 6 nu (times 6 (drag_matrix linear_drag (fun _ => 0) nu) nu) < 0.
Proof.
  exists (diagonal (fun _ => -20)), (fun i => if Nat.eqb i 0 then 1 else 0). unfold dot, times, drag_matrix, plus, diagonal. simpl. lra.
Qed.

Print Assumptions statement.
