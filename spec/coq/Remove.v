(** * S3.11: polygons are removed from a tree.

    The program is that of [ref/src/build.cpp]: fragments leave the lists, and a
    node that holds nothing and has fewer than two children gives its place to
    its child. *)

From Coq Require Import ZArith Lia List Bool.
From Halfspace Require Import Base Tree Order.
Import ListNotations.
Open Scope list_scope.

Section Remove.

Variables Fragment Plane : Type.
(** Whether a fragment is of a polygon that stays. *)
Variable stays : Fragment -> bool.

Notation Tree := (BspTree Fragment Plane).
Notation nothing := (Nothing : Tree).

(** ** Definitions *)

(** Step 2, of a node whose subtrees are done. *)
Definition standing (plane : Plane) (coincident : list Fragment)
  (positive negative : Tree) : Tree :=
  match coincident, positive, negative with
  | [], Nothing, _ => negative
  | [], _, Nothing => positive
  | _, _, _ => Node plane coincident positive negative
  end.

Fixpoint remove (tree : Tree) : Tree :=
  match tree with
  | Nothing => nothing
  | Node plane coincident positive negative =>
    standing plane (filter stays coincident) (remove positive)
      (remove negative)
  end.

(** No node holds nothing and has fewer than two children. *)
Fixpoint tight (tree : Tree) : Prop :=
  match tree with
  | Nothing => True
  | Node _ coincident positive negative =>
    (coincident <> [] \/ (positive <> nothing /\ negative <> nothing)) /\
    tight positive /\ tight negative
  end.

(** ** What is left *)

Lemma standing_fragments : forall h c p n,
  fragments (standing h c p n) =
  c ++ fragments p ++ fragments n.
Proof.
  intros h [|f c] [|hp cp pp np] [|hn cn pn nn]; simpl;
    rewrite ?app_nil_r; reflexivity.
Qed.

(** The tree has the fragments of the polygons that stay, as they were, and no
    others. *)
Theorem removed_fragments : forall tree,
  fragments (remove tree) = filter stays (fragments tree).
Proof.
  induction tree as [|h c p IHp n IHn]; simpl; [reflexivity|].
  now rewrite standing_fragments, IHp, IHn, !filter_app.
Qed.

Variable side_of_eye : Plane -> Side.

Lemma standing_walk : forall h c p n,
  front_to_back Fragment Plane side_of_eye (standing h c p n) =
  front_to_back Fragment Plane side_of_eye (Node h c p n).
Proof.
  intros h [|f c] [|hp cp pp np] [|hn cn pn nn]; try reflexivity; simpl;
    destruct (side_of_eye h); simpl; rewrite ?app_nil_r; reflexivity.
Qed.

(** They are displayed in the order in which they were, from every eye. *)
Theorem removed_walk : forall tree,
  front_to_back Fragment Plane side_of_eye (remove tree) =
  filter stays (front_to_back Fragment Plane side_of_eye tree).
Proof.
  induction tree as [|h c p IHp n IHn]; [reflexivity|].
  simpl remove; rewrite standing_walk; simpl; rewrite IHp, IHn.
  destruct (side_of_eye h); simpl; now rewrite !filter_app.
Qed.

(** ** How many nodes *)

Lemma standing_tight : forall h c p n, tight p -> tight n ->
  tight (standing h c p n).
Proof.
  intros h [|f c] [|hp cp pp np] [|hn cn pn nn]; simpl; intros P N;
    try tauto; split; try tauto.
  - right; split; discriminate.
  - left; discriminate.
  - left; discriminate.
  - left; discriminate.
  - left; discriminate.
Qed.

Theorem removed_is_tight : forall tree, tight (remove tree).
Proof.
  induction tree as [|h c p IHp n IHn]; simpl; [exact I|].
  now apply standing_tight.
Qed.

(** A tree without needless nodes has fewer than twice as many nodes as
    fragments. *)
Theorem tight_nodes : forall tree, tight tree -> tree <> nothing ->
  nodes tree < 2 * length (fragments tree).
Proof.
  induction tree as [|h c p IHp n IHn]; intros T E; [contradiction|].
  simpl in T |- *; destruct T as (K & P & N).
  rewrite !app_length.
  assert (nodes p <= 2 * length (fragments p)) as A.
  { destruct p as [|hp cp pp np]; [simpl; lia|].
    apply Nat.lt_le_incl, IHp; [exact P | discriminate]. }
  assert (nodes n <= 2 * length (fragments n)) as B.
  { destruct n as [|hn cn pn nn]; [simpl; lia|].
    apply Nat.lt_le_incl, IHn; [exact N | discriminate]. }
  destruct K as [K | [K L]].
  - destruct c as [|f c]; [contradiction|]; simpl; lia.
  - specialize (IHp P K); specialize (IHn N L); lia.
Qed.

Theorem removed_nodes : forall tree, remove tree <> nothing ->
  nodes (remove tree) < 2 * length (fragments (remove tree)).
Proof.
  intros tree E; apply tight_nodes; [apply removed_is_tight | exact E].
Qed.

End Remove.
