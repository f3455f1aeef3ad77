(** * S10.6: the part that a cap is of, and the keys of caps.

    A ray from a point of a cap to infinity crosses polygons, each of which
    counts 1 or -1 to the winding number (S6.2) and belongs to one part. *)

From Coq Require Import ZArith List Lia.
Import ListNotations.
Open Scope Z_scope.

(** ** Winding numbers *)

(** The part of the polygon that is crossed, and what it counts. *)
Definition Crossing : Type := (nat * Z)%type.

Fixpoint winding (crossings : list Crossing) : Z :=
  match crossings with
  | [] => 0
  | c :: rest => snd c + winding rest
  end.

(** That of part [q] alone: of its own polygons. *)
Definition winding_of (q : nat) (crossings : list Crossing) : Z :=
  winding (filter (fun c => Nat.eqb (fst c) q) crossings).

Fixpoint sum_below (m : nat) (f : nat -> Z) : Z :=
  match m with
  | O => 0
  | S k => sum_below k f + f k
  end.

Lemma sum_of_nothing : forall m f,
  (forall q, (q < m)%nat -> f q = 0) -> sum_below m f = 0.
Proof.
  induction m as [| m IH]; intros f H; simpl; [reflexivity |].
  rewrite IH, H; auto.
Qed.

Lemma sum_of_one_more : forall m f g p v,
  (p < m)%nat ->
  (forall q, (q < m)%nat -> f q = g q + if Nat.eqb p q then v else 0) ->
  sum_below m f = v + sum_below m g.
Proof.
  induction m as [| m IH]; intros f g p v P H; [lia |]; simpl.
  destruct (Nat.eq_dec p m) as [-> | N].
  - assert (sum_below m f = sum_below m g) as ->.
    { assert (forall k, (k <= m)%nat -> sum_below k f = sum_below k g) as E.
      { induction k as [| k E]; intros L; simpl; [reflexivity |].
        rewrite E, H by lia.
        destruct (Nat.eqb_spec m k); lia. }
      apply E; lia. }
    rewrite H by lia; rewrite Nat.eqb_refl; lia.
  - rewrite (IH f g p v) by (try lia; intros; apply H; lia).
    rewrite H by lia.
    destruct (Nat.eqb_spec p m); lia.
Qed.

(** The winding number is the sum of those of the parts. *)
Theorem winding_adds_up : forall m crossings,
  (forall c, In c crossings -> (fst c < m)%nat) ->
  winding crossings = sum_below m (fun q => winding_of q crossings).
Proof.
  intros m; induction crossings as [| [p v] rest IH]; intros H.
  - symmetry; apply sum_of_nothing; reflexivity.
  - simpl; rewrite IH by (intros; apply H; right; assumption).
    symmetry; apply (sum_of_one_more _ _ _ p v).
    + apply (H (p, v)); left; reflexivity.
    + intros q _; unfold winding_of; simpl.
      destruct (Nat.eqb p q); simpl; lia.
Qed.

Lemma some_is_positive : forall m f,
  0 < sum_below m f -> exists q, (q < m)%nat /\ 0 < f q.
Proof.
  induction m as [| m IH]; intros f H; simpl in H; [lia |].
  destruct (Z_lt_le_dec 0 (f m)) as [P | N].
  - exists m; split; [lia | assumption].
  - destruct (IH f) as [q [L P]]; [lia |].
    exists q; split; [lia | assumption].
Qed.

(** So where the winding number is above 0, that of a part is. *)
Theorem a_cap_has_a_part : forall m crossings,
  (forall c, In c crossings -> (fst c < m)%nat) ->
  0 < winding crossings ->
  exists q, (q < m)%nat /\ 0 < winding_of q crossings.
Proof.
  intros m crossings H P; apply some_is_positive.
  rewrite <- winding_adds_up; assumption.
Qed.

(** ** The part of a cap *)

(** The only part whose winding number is above 0, else [m]. *)
Definition part_of_cap (m : nat) (crossings : list Crossing) : nat :=
  match filter (fun q => 0 <? winding_of q crossings) (seq 0 m) with
  | [q] => q
  | _ => m
  end.

Lemma inside_tells : forall m crossings q,
  In q (filter (fun r => 0 <? winding_of r crossings) (seq 0 m)) <->
  (q < m)%nat /\ 0 < winding_of q crossings.
Proof.
  intros; rewrite filter_In, in_seq, Z.ltb_lt; intuition lia.
Qed.

(** A cap is of one part where, and only where, that part's winding number
    alone is above 0. *)
Theorem a_part_has_its_own_cap : forall m crossings q,
  (q < m)%nat ->
  (part_of_cap m crossings = q <->
   0 < winding_of q crossings /\
   forall r, (r < m)%nat -> 0 < winding_of r crossings -> r = q).
Proof.
  intros m crossings q L; unfold part_of_cap.
  pose proof (inside_tells m crossings) as T.
  pose proof (NoDup_filter (fun r => 0 <? winding_of r crossings)
                (seq_NoDup m 0)) as D.
  destruct (filter _ (seq 0 m)) as [| p [| r rest]].
  - split; [lia |]; intros [P _].
    exfalso; apply (proj2 (T q)); auto.
  - split.
    + intros ->; split; [apply (T q); left; reflexivity |].
      intros r R P.
      destruct (proj2 (T r) (conj R P)) as [E | []]; auto.
    + intros [P U].
      destruct (proj1 (T p)) as [R Q]; [left; reflexivity |].
      apply U; assumption.
  - split; [lia |]; intros [P U].
    destruct (proj1 (T p)) as [P1 P2]; [left; reflexivity |].
    destruct (proj1 (T r)) as [R1 R2]; [right; left; reflexivity |].
    exfalso; inversion D as [| x l N]; apply N; left.
    rewrite (U p P1 P2), (U r R1 R2); reflexivity.
Qed.

(** And it is of several where, and only where, two of them overlap. *)
Theorem a_cap_of_several_overlaps : forall m crossings,
  (forall c, In c crossings -> (fst c < m)%nat) ->
  0 < winding crossings ->
  (part_of_cap m crossings = m <->
   exists p q, (p < m)%nat /\ (q < m)%nat /\ p <> q /\
     0 < winding_of p crossings /\ 0 < winding_of q crossings).
Proof.
  intros m crossings H W; split.
  - intros E.
    destruct (a_cap_has_a_part m crossings H W) as [p [L P]].
    unfold part_of_cap in E.
    pose proof (inside_tells m crossings) as T.
    pose proof (NoDup_filter (fun r => 0 <? winding_of r crossings)
                  (seq_NoDup m 0)) as D.
    destruct (filter _ (seq 0 m)) as [| a [| b rest]].
    + exfalso; apply (proj2 (T p)); auto.
    + destruct (proj1 (T a)) as [A _]; [left; reflexivity | lia].
    + destruct (proj1 (T a)) as [A1 A2]; [left; reflexivity |].
      destruct (proj1 (T b)) as [B1 B2]; [right; left; reflexivity |].
      exists a, b; repeat split; auto.
      intros ->; inversion D as [| x l N]; apply N; left; reflexivity.
  - intros [p [q [P [Q [N [A B]]]]]].
    destruct (Nat.lt_trichotomy (part_of_cap m crossings) m) as [L | [E | G]].
    + pose proof (proj1 (a_part_has_its_own_cap m crossings
                           (part_of_cap m crossings) L) eq_refl) as [_ U].
      exfalso; apply N.
      rewrite (U p P A), (U q Q B); reflexivity.
    + exact E.
    + exfalso; unfold part_of_cap in G.
      pose proof (inside_tells m crossings) as T.
      destruct (filter _ (seq 0 m)) as [| a [| b rest]]; try lia.
      destruct (proj1 (T a)) as [A1 _]; [left; reflexivity | lia].
Qed.

(** ** Keys *)

(** The key of the cap of part [q] in plane [k], of [n] polygons; 8 more in the
    stripes. *)
Definition cap_key (n k q : Z) (stripes : bool) : Z :=
  n + k + 16 * q + if stripes then 8 else 0.

(** A key tells plane, part and stripes, and is no polygon's. *)
Theorem cap_keys_tell : forall n k q s k' q' s',
  0 <= k < 8 -> 0 <= k' < 8 -> 0 <= q -> 0 <= q' ->
  n <= cap_key n k q s /\
  (cap_key n k q s = cap_key n k' q' s' -> k = k' /\ q = q' /\ s = s').
Proof.
  intros n k q s k' q' s' K K' Q Q'; unfold cap_key; split.
  - destruct s; lia.
  - destruct s, s'; intros E; repeat split; try lia; exfalso; lia.
Qed.
