(** S6.6 Touching: round a line on which polygons meet.

    Read beside [Passages] in fast/. The half-planes in which polygons leave the
    line are numbered in radial order. Passing one of them changes the winding
    number by 1 or by -1: [changes]. The winding number of the wedge before the
    first of them is [start], so after [k] of them it is [level start changes k].
    A solid has winding numbers 0 and 1 only (S6.2). *)

From Coq Require Import ZArith List Lia.
Import ListNotations.
Open Scope Z_scope.

Definition is_change (c : Z) : Prop := c = 1 \/ c = -1.

Fixpoint level (start : Z) (changes : list Z) (k : nat) {struct k} : Z :=
  match k, changes with
  | S k', c :: rest => level (start + c) rest k'
  | _, _ => start
  end.

Fixpoint alternates (changes : list Z) : Prop :=
  match changes with
  | c :: (d :: _) as rest => d = - c /\ alternates rest
  | _ => True
  end.

Lemma alternates_tail : forall c rest, alternates (c :: rest) -> alternates rest.
Proof. intros c [|d rest]; simpl; tauto. Qed.

(** If entries and exits alternate, there are two winding numbers round the
    line: the one before the first half-plane and the one behind it. *)
Theorem alternation_leaves_two_levels : forall changes start c rest k,
  changes = c :: rest -> alternates changes ->
  level start changes k = start \/ level start changes k = start + c.
Proof.
  induction changes as [|d tail IH]; intros start c rest k E A.
  - discriminate.
  - injection E; intros Er Ed; subst d rest.
    destruct k as [|k]; [left; reflexivity|].
    simpl. destruct tail as [|d tail].
    + right. destruct k; simpl; reflexivity.
    + assert (D : d = - c) by (simpl in A; tauto).
      destruct (IH (start + c) d tail k eq_refl (alternates_tail _ _ A)) as [H|H];
        rewrite H; subst d; [right|left]; lia.
Qed.

(** If all winding numbers round the line are two neighbours, entries and exits
    alternate. *)
Theorem two_levels_alternate : forall changes start low,
  (forall c, In c changes -> is_change c) ->
  (forall k, (k <= length changes)%nat ->
    low <= level start changes k <= low + 1) ->
  alternates changes.
Proof.
  induction changes as [|c rest IH]; intros start low C L; [exact I|].
  destruct rest as [|d rest]; [exact I|].
  assert (c = 1 \/ c = -1) as Hc by (apply C; simpl; tauto).
  assert (d = 1 \/ d = -1) as Hd by (apply C; simpl; tauto).
  pose proof (L 0%nat ltac:(simpl; lia)) as L0.
  pose proof (L 2%nat ltac:(simpl; lia)) as L2.
  simpl in L0, L2.
  split; [destruct Hc, Hd; lia|].
  apply (IH (start + c) low).
  - intros e He. apply C. right. exact He.
  - intros k Hk. exact (L (S k) (le_n_S _ _ Hk)).
Qed.

(** What S6.6 asks at a line is what S6.2 asks round it. *)
Theorem solid_round_a_line : forall changes start c rest,
  changes = c :: rest ->
  (forall e, In e changes -> is_change e) ->
  (alternates changes /\ 0 <= start <= 1 /\ 0 <= start + c <= 1) <->
  (forall k, (k <= length changes)%nat -> 0 <= level start changes k <= 1).
Proof.
  intros changes start c rest E C. split.
  - intros [A [S0 S1]] k _.
    destruct (alternation_leaves_two_levels changes start c rest k E A) as [H|H];
      rewrite H; assumption.
  - intros L. split; [|split].
    + apply (two_levels_alternate changes start 0 C). intros k Hk.
      pose proof (L k Hk). lia.
    + pose proof (L 0%nat ltac:(lia)) as H. subst changes. exact H.
    + subst changes. pose proof (L 1%nat ltac:(simpl; lia)) as H.
      exact H.
Qed.

(** A polygon that has the line in its interior leaves it to both sides. If what
    else meets there is on either side of it once, be it another polygon's
    interior or two faces at an edge, that never alternates. *)
Theorem crossing_does_not_alternate : forall c d,
  is_change c -> ~ alternates [c; d; - c; - d].
Proof. intros c d [H|H] [A [B _]]; lia. Qed.

(** Faces on one side of the polygon touch it, if they face the right way. *)
Theorem touching_in_a_face_alternates : forall c,
  alternates [c; - c; c; - c].
Proof. intros c. simpl. repeat split; lia. Qed.
