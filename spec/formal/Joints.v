(** Functions joined at a point: slopes and continuity of the whole from those of the two sides. Shared by the cycle and the triangle. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Lemma glue_derive (f g h : R -> R) p d l : 0 < d -> (forall t, p - d < t <= p -> f t = g t) -> (forall t, p <= t < p + d -> f t = h t) ->
  is_derive g p l -> is_derive h p l -> is_derive f p l.
Proof.
  intros Pd G H Dg Dh. apply is_derive_Reals in Dg. apply is_derive_Reals in Dh. apply is_derive_Reals. intros eps E.
  destruct (Dg eps E) as [d1 N1]. destruct (Dh eps E) as [d2 N2]. pose proof (cond_pos d1). pose proof (cond_pos d2).
  assert (P : 0 < Rmin d (Rmin d1 d2)) by (repeat apply Rmin_pos; assumption). exists (mkposreal _ P). intros k k0 Hk. simpl in Hk.
  pose proof (Rmin_l d (Rmin d1 d2)). pose proof (Rle_trans _ _ _ (Rmin_r d (Rmin d1 d2)) (Rmin_l d1 d2)).
  pose proof (Rle_trans _ _ _ (Rmin_r d (Rmin d1 d2)) (Rmin_r d1 d2)).
  destruct (Rlt_le_dec k 0) as [L|L].
  - rewrite (G p), (G (p + k)); [apply N1; [exact k0|lra]| |lra]. rewrite Rabs_left in Hk by exact L. lra.
  - rewrite (H p), (H (p + k)); [apply N2; [exact k0|lra]| |lra]. rewrite Rabs_pos_eq in Hk by exact L. lra.
Qed.

Lemma glue_continuous (f g h : R -> R) p d : 0 < d -> (forall t, p - d < t <= p -> f t = g t) -> (forall t, p <= t < p + d -> f t = h t) ->
  continuous g p -> continuous h p -> continuous f p.
Proof.
  intros Pd G H Cg Ch. apply filterlim_locally. intros eps.
  assert (Cg' := proj1 (filterlim_locally g (g p)) Cg eps). assert (Ch' := proj1 (filterlim_locally h (h p)) Ch eps).
  destruct Cg' as [d1 N1]. destruct Ch' as [d2 N2]. pose proof (cond_pos d1). pose proof (cond_pos d2).
  assert (P : 0 < Rmin d (Rmin d1 d2)) by (repeat apply Rmin_pos; assumption). exists (mkposreal _ P). intros t Ht.
  change (Rabs (t - p) < Rmin d (Rmin d1 d2)) in Ht.
  pose proof (Rmin_l d (Rmin d1 d2)). pose proof (Rle_trans _ _ _ (Rmin_r d (Rmin d1 d2)) (Rmin_l d1 d2)).
  pose proof (Rle_trans _ _ _ (Rmin_r d (Rmin d1 d2)) (Rmin_r d1 d2)). pose proof (Rabs_def2 _ _ Ht).
  destruct (Rlt_le_dec t p) as [L|L].
  - rewrite (G p), (G t) by lra. apply N1. change (Rabs (t - p) < d1). lra.
  - rewrite (H p), (H t) by lra. apply N2. change (Rabs (t - p) < d2). lra.
Qed.

Lemma local_derive (f g : R -> R) p d l : 0 < d -> (forall t, p - d < t < p + d -> f t = g t) -> is_derive g p l -> is_derive f p l.
Proof. intros Pd E D. apply (glue_derive f g g p d l Pd); try assumption; intros t Ht; apply E; lra. Qed.
