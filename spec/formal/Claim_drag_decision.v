(** claim: drag-decision (eq. 42)
    With [D = sigma_beta% - sigma_betaxx%]: quadratic drag where [D > lambda], linear where [D < -lambda], else undecided. A larger lambda can
    only turn decisions into indecision; exchanging the two spreads exchanges the two laws; [lambda = 0] always decides unless the
    spreads are equal. *)
From Coq Require Import Reals Lra.
Open Scope R_scope.

Inductive decision := Linear | Quadratic | Undecided.

(** Eq. 42 as the program has it. *)
Definition decide (spread_linear spread_quadratic lambda : R) : decision :=
  let D := spread_linear - spread_quadratic in
  if Rlt_dec lambda D then Quadratic else if Rlt_dec D (- lambda) then Linear else Undecided.

Definition exchanged (d : decision) : decision :=
  match d with Linear => Quadratic | Quadratic => Linear | Undecided => Undecided end.

Theorem statement : forall linear quadratic lambda : R, 0 <= lambda ->
  (* three outcomes, each with its comparison *)
  (decide linear quadratic lambda = Quadratic <-> linear - quadratic > lambda) /\
  (decide linear quadratic lambda = Linear <-> linear - quadratic < - lambda) /\
  (decide linear quadratic lambda = Undecided <-> - lambda <= linear - quadratic <= lambda) /\
  (* a larger threshold *)
  (forall wider, lambda <= wider ->
    decide linear quadratic wider = decide linear quadratic lambda \/ decide linear quadratic wider = Undecided) /\
  (* the spreads exchanged *)
  decide quadratic linear lambda = exchanged (decide linear quadratic lambda) /\
  (* no threshold *)
  (decide linear quadratic 0 = Undecided <-> linear = quadratic).
Proof.
  intros l q lambda H. unfold decide.
  repeat split; intros; repeat destruct (Rlt_dec _ _); try discriminate; try reflexivity; try lra; try (left; reflexivity); try (right; reflexivity).
Qed.

(** With the two laws exchanged it is another rule. *)
Theorem names_matter : decide 20 5 10 <> decide 5 20 10.
Proof. unfold decide. repeat destruct (Rlt_dec _ _); discriminate || lra. Qed.

Print Assumptions statement.
