(** * S3: building a tree, inserting into one, and walking it.

    The programs are those of [ref/src/build.cpp] and [ref/src/traverse.cpp].
    They are written for any kind of fragment and plane; what is proven of them
    rests on what a split does, which is given with each section, and which
    [Scene.v] shows of polygons in space. *)

From Coq Require Import ZArith QArith Lqa Lia List.
From Halfspace Require Import Base.
Import ListNotations.
Open Scope list_scope.

Section Tree.

Variables Fragment Plane : Type.
Variable source : Fragment -> Z.
Variable plane_of : Fragment -> Plane.
Variable relation : Fragment -> Plane -> Relation.
Variable split : Fragment -> Plane -> Fragment * Fragment.

(** ** Definitions *)

(** S3.1. *)
Inductive BspTree :=
| Nothing
| Node (plane : Plane) (coincident : list Fragment)
       (positive negative : BspTree).

(** Which member of a list becomes the root, at each place of the tree: any
    function whatever. A place is told by the sides on the way to it. *)
Variable choose_root : list Side -> list Fragment -> nat.

(** S3.5, step 3: the list for the node, and those for its two sides. *)
Fixpoint distribute (polygons : list Fragment) (plane : Plane) :
  list Fragment * list Fragment * list Fragment :=
  match polygons with
  | [] => ([], [], [])
  | polygon :: rest =>
    let '(coincident, positive, negative) := distribute rest plane in
    match relation polygon plane with
    | rCoincident => (polygon :: coincident, positive, negative)
    | rPositive => (coincident, polygon :: positive, negative)
    | rNegative => (coincident, positive, polygon :: negative)
    | rSpanning =>
      let parts := split polygon plane in
      (coincident, fst parts :: positive, snd parts :: negative)
    end
  end.

(** S3.5, to a depth of [at_most]; a tree is never deeper than its list is
    long. *)
Fixpoint build_at (at_most : nat) (place : list Side)
  (polygons : list Fragment) : BspTree :=
  match at_most, polygons with
  | S fewer, first :: _ =>
    let root := nth (choose_root place polygons) polygons first in
    let plane := plane_of root in
    let '(coincident, positive, negative) := distribute polygons plane in
    Node plane coincident (build_at fewer (kPositive :: place) positive)
      (build_at fewer (kNegative :: place) negative)
  | _, _ => Nothing
  end.

Definition build (polygons : list Fragment) : BspTree :=
  build_at (length polygons) [] polygons.

(** Puts a fragment into a node's list, which is in order of id. *)
Fixpoint put (fragment : Fragment) (coincident : list Fragment) :=
  match coincident with
  | [] => [fragment]
  | f :: rest =>
    if (source fragment <? source f)%Z then fragment :: coincident
    else f :: put fragment rest
  end.

(** S3.6. *)
Fixpoint insert (polygon : Fragment) (tree : BspTree) : BspTree :=
  match tree with
  | Nothing => Node (plane_of polygon) [polygon] Nothing Nothing
  | Node plane coincident positive negative =>
    match relation polygon plane with
    | rCoincident => Node plane (put polygon coincident) positive negative
    | rPositive => Node plane coincident (insert polygon positive) negative
    | rNegative => Node plane coincident positive (insert polygon negative)
    | rSpanning =>
      let parts := split polygon plane in
      Node plane coincident (insert (fst parts) positive)
        (insert (snd parts) negative)
    end
  end.

Definition insert_all (polygons : list Fragment) (tree : BspTree) : BspTree :=
  fold_left (fun t polygon => insert polygon t) polygons tree.

(** S3.2. *)
Fixpoint nodes (tree : BspTree) : nat :=
  match tree with
  | Nothing => 0
  | Node _ _ positive negative => S (nodes positive + nodes negative)
  end.

Fixpoint fragments (tree : BspTree) : list Fragment :=
  match tree with
  | Nothing => []
  | Node _ coincident positive negative =>
    coincident ++ fragments positive ++ fragments negative
  end.

(** ** Whatever a split keeps, a tree keeps *)

Section Kept.

(** A sum over fragments, such as an area, that a split divides between the
    parts. *)
Variable weight : Fragment -> Q.
Hypothesis split_weight : forall f h, relation f h = rSpanning ->
  (weight f == weight (fst (split f h)) + weight (snd (split f h)))%Q.

Definition total (l : list Fragment) : Q :=
  fold_right (fun f sum => weight f + sum)%Q 0%Q l.

Lemma total_app : forall l m, (total (l ++ m) == total l + total m)%Q.
Proof.
  induction l as [|f l IH]; intros m; simpl; [ring|]; rewrite IH; ring.
Qed.

Lemma distribute_total : forall l h c p n,
  distribute l h = (c, p, n) ->
  (total l == total c + total p + total n)%Q.
Proof.
  induction l as [|f l IH]; intros h c p n; simpl.
  - intros E; injection E as <- <- <-; simpl; ring.
  - destruct (distribute l h) as [[c' p'] n'] eqn:D.
    specialize (IH h c' p' n' D).
    destruct (relation f h) eqn:R; intros E; injection E as <- <- <-; simpl;
      rewrite IH; try ring.
    rewrite (split_weight f h R); ring.
Qed.

Lemma put_total : forall f l, (total (put f l) == weight f + total l)%Q.
Proof.
  intros f; induction l as [|g l IH]; simpl; [ring|].
  destruct (_ <? _)%Z; simpl; [ring | rewrite IH; ring].
Qed.

(** S3.6: insertion adds the fragment's weight, no more and no less. *)
Theorem insert_total : forall tree f,
  (total (fragments (insert f tree)) == weight f + total (fragments tree))%Q.
Proof.
  induction tree as [|h c p IHp n IHn]; intros f; simpl; [ring|].
  destruct (relation f h) eqn:R; simpl; rewrite ?total_app.
  - rewrite IHp; ring.
  - rewrite IHn; ring.
  - rewrite put_total; ring.
  - rewrite IHp, IHn, (split_weight f h R); ring.
Qed.

Theorem insert_all_total : forall l tree,
  (total (fragments (insert_all l tree)) ==
   total l + total (fragments tree))%Q.
Proof.
  unfold insert_all; induction l as [|f l IH]; intros tree; simpl; [ring|].
  rewrite IH, insert_total; ring.
Qed.

End Kept.

Section Points.

(** Membership of a point in closed fragments: a split's parts together have
    the points of the whole. *)
Variable has : Fragment -> Prop.
Hypothesis split_has : forall f h, relation f h = rSpanning ->
  (has f <-> has (fst (split f h)) \/ has (snd (split f h))).

Lemma distribute_has : forall l h c p n,
  distribute l h = (c, p, n) ->
  (Exists has l <-> Exists has c \/ Exists has p \/ Exists has n).
Proof.
  induction l as [|f l IH]; intros h c p n; simpl.
  - intros E; injection E as <- <- <-; rewrite Exists_nil; tauto.
  - destruct (distribute l h) as [[c' p'] n'] eqn:D.
    specialize (IH h c' p' n' D).
    destruct (relation f h) eqn:R; intros E; injection E as <- <- <-;
      rewrite !Exists_cons, IH; try tauto.
    rewrite (split_has f h R); tauto.
Qed.

Lemma put_has : forall f l, Exists has (put f l) <-> has f \/ Exists has l.
Proof.
  intros f; induction l as [|g l IH]; simpl.
  - rewrite Exists_cons, Exists_nil; tauto.
  - destruct (_ <? _)%Z; rewrite !Exists_cons, ?IH, ?Exists_cons; tauto.
Qed.

(** S3.6: insertion loses and invents no point. *)
Theorem insert_has : forall tree f,
  Exists has (fragments (insert f tree)) <->
  has f \/ Exists has (fragments tree).
Proof.
  induction tree as [|h c p IHp n IHn]; intros f; simpl.
  - rewrite Exists_cons; tauto.
  - destruct (relation f h) eqn:R; simpl; rewrite ?Exists_app.
    + rewrite IHp; tauto.
    + rewrite IHn; tauto.
    + rewrite put_has; tauto.
    + rewrite IHp, IHn, (split_has f h R); tauto.
Qed.

Theorem insert_all_has : forall l tree,
  Exists has (fragments (insert_all l tree)) <->
  Exists has l \/ Exists has (fragments tree).
Proof.
  unfold insert_all; induction l as [|f l IH]; intros tree; simpl.
  - rewrite Exists_nil; tauto.
  - rewrite IH, insert_has, Exists_cons; tauto.
Qed.

End Points.

(** ** A build comes to an end with every polygon in the tree *)

(** What fragments are taken to be: a fragment lies in its own plane, and so
    do the parts of it. *)
Variable valid : Fragment -> Prop.
Hypothesis own_plane : forall f, valid f ->
  relation f (plane_of f) = rCoincident.
Hypothesis split_valid : forall f h, valid f -> relation f h = rSpanning ->
  valid (fst (split f h)) /\ valid (snd (split f h)).

(** What holds of a list and of the parts of what it holds of, holds of the
    three lists. *)
Lemma distribute_forall : forall P : Fragment -> Prop,
  (forall f h, valid f -> P f -> relation f h = rSpanning ->
   P (fst (split f h)) /\ P (snd (split f h))) ->
  forall l h c p n, distribute l h = (c, p, n) ->
  Forall valid l -> Forall P l -> Forall P c /\ Forall P p /\ Forall P n.
Proof.
  intros P K; induction l as [|f l IH]; intros h c p n; simpl.
  - intros E _; injection E as <- <- <-; auto.
  - destruct (distribute l h) as [[c' p'] n'] eqn:D.
    intros E V F; inversion V as [|? ? V1 V2]; subst.
    inversion F as [|? ? H1 H2]; subst; destruct (IH h c' p' n' D V2 H2) as (A & B & C).
    destruct (relation f h) eqn:R; injection E as <- <- <-; auto.
    destruct (K f h V1 H1 R); auto.
Qed.

Lemma distribute_valid : forall l h c p n,
  distribute l h = (c, p, n) -> Forall valid l ->
  Forall valid c /\ Forall valid p /\ Forall valid n.
Proof.
  induction l as [|f l IH]; intros h c p n; simpl.
  - intros E _; injection E as <- <- <-; auto.
  - destruct (distribute l h) as [[c' p'] n'] eqn:D.
    intros E V; inversion V as [|? ? V1 V2]; subst.
    destruct (IH h c' p' n' D V2) as (A & B & C).
    destruct (relation f h) eqn:R; injection E as <- <- <-; auto.
    destruct (split_valid f h V1 R); auto.
Qed.

Lemma distribute_length : forall l h c p n,
  distribute l h = (c, p, n) ->
  (length c + length p <= length l)%nat /\
  (length c + length n <= length l)%nat.
Proof.
  induction l as [|f l IH]; intros h c p n; simpl.
  - intros E; injection E as <- <- <-; simpl; lia.
  - destruct (distribute l h) as [[c' p'] n'] eqn:D.
    specialize (IH h c' p' n' D).
    destruct (relation f h); intros E; injection E as <- <- <-; simpl; lia.
Qed.

Lemma distribute_coincident : forall l h c p n f,
  distribute l h = (c, p, n) ->
  (In f c <-> In f l /\ relation f h = rCoincident).
Proof.
  induction l as [|g l IH]; intros h c p n f; simpl.
  - intros E; injection E as <- <- <-; simpl; tauto.
  - destruct (distribute l h) as [[c' p'] n'] eqn:D.
    specialize (IH h c' p' n' f D).
    destruct (relation g h) eqn:R; intros E; injection E as <- <- <-; simpl;
      rewrite IH; (split; [intuition (subst; auto)|]);
      intros [[G | G] Q]; subst; auto; congruence.
Qed.

(** The root stays in the node, so the lists for the children are shorter. *)
Lemma distribute_shorter : forall l root c p n,
  In root l -> valid root -> distribute l (plane_of root) = (c, p, n) ->
  In root c /\ (length p < length l)%nat /\ (length n < length l)%nat.
Proof.
  intros l root c p n I V D.
  pose proof (distribute_length _ _ _ _ _ D).
  assert (In root c) as C.
  { apply (distribute_coincident _ _ _ _ _ root D); auto. }
  destruct c; [destruct C | simpl in *; split; [auto | lia]].
Qed.

(** An induction for trees that are built: what holds of nothing, and of a node
    if it holds of its children, holds of every tree that is built. *)
Lemma build_induction :
  forall (holds : list Fragment -> BspTree -> Prop),
  holds [] Nothing ->
  (forall l root c p n place at_most,
     Forall valid l -> In root l ->
     root = nth (choose_root place l) l root ->
     distribute l (plane_of root) = (c, p, n) ->
     In root c -> (length p <= at_most)%nat -> (length n <= at_most)%nat ->
     holds p (build_at at_most (kPositive :: place) p) ->
     holds n (build_at at_most (kNegative :: place) n) ->
     holds l (Node (plane_of root) c
                (build_at at_most (kPositive :: place) p)
                (build_at at_most (kNegative :: place) n))) ->
  forall at_most place l,
  Forall valid l -> (length l <= at_most)%nat ->
  holds l (build_at at_most place l).
Proof.
  intros holds Base Step at_most; induction at_most as [|m IH];
    intros place l V L.
  - destruct l; [exact Base | simpl in L; lia].
  - destruct l as [|f l]; [exact Base|].
    set (all := f :: l) in *.
    set (root := nth (choose_root place all) all f).
    assert (In root all /\ root = nth (choose_root place all) all root)
      as [I N].
    { destruct (Nat.lt_ge_cases (choose_root place all) (length all))
        as [H | H].
      - split; [now apply nth_In | now apply nth_indep].
      - unfold root; rewrite !(nth_overflow all) by exact H.
        split; [now left | reflexivity]. }
    destruct (distribute all (plane_of root)) as [[c p] n] eqn:D.
    assert (valid root) as Vr by (rewrite Forall_forall in V; auto).
    destruct (distribute_shorter _ _ _ _ _ I Vr D) as (C & P & Q).
    destruct (distribute_valid _ _ _ _ _ D V) as (_ & Vp & Vn).
    replace (build_at (S m) place all) with
      (Node (plane_of root) c (build_at m (kPositive :: place) p)
         (build_at m (kNegative :: place) n)).
    + apply (Step all root c p n place m); auto; try lia; apply IH; auto; lia.
    + change (build_at (S m) place all) with
        (let '(coincident, positive, negative) :=
           distribute all (plane_of root) in
         Node (plane_of root) coincident
           (build_at m (kPositive :: place) positive)
           (build_at m (kNegative :: place) negative)).
      now rewrite D.
Qed.

(** S3.5: a tree has the weight of its list, however roots are chosen; for
    areas this is S3.L1. *)
Theorem build_total : forall weight,
  (forall f h, relation f h = rSpanning ->
   (weight f == weight (fst (split f h)) + weight (snd (split f h)))%Q) ->
  forall l, Forall valid l ->
  (total weight (fragments (build l)) == total weight l)%Q.
Proof.
  intros weight W l V; unfold build.
  apply (build_induction (fun l t => total weight (fragments t) ==
    total weight l)%Q); auto; [reflexivity|].
  clear l V; intros l root c p n place m _ _ _ D _ _ _ P N; simpl.
  rewrite !total_app, P, N, (distribute_total weight W _ _ _ _ _ D); ring.
Qed.

(** S3.5: a tree loses and invents no point, however roots are chosen. *)
Theorem build_has : forall has : Fragment -> Prop,
  (forall f h, relation f h = rSpanning ->
   (has f <-> has (fst (split f h)) \/ has (snd (split f h)))) ->
  forall l, Forall valid l ->
  (Exists has (fragments (build l)) <-> Exists has l).
Proof.
  intros has W l V; unfold build.
  apply (build_induction (fun l t =>
    Exists has (fragments t) <-> Exists has l)); auto; [reflexivity|].
  clear l V; intros l root c p n place m _ _ _ D _ _ _ P N; simpl.
  rewrite !Exists_app, P, N, (distribute_has has W _ _ _ _ _ D); tauto.
Qed.

(** What holds of the list and of all parts, holds of a built tree. *)
Lemma build_at_forall : forall P : Fragment -> Prop,
  (forall f h, valid f -> P f -> relation f h = rSpanning ->
   P (fst (split f h)) /\ P (snd (split f h))) ->
  forall at_most place l, Forall valid l -> (length l <= at_most)%nat ->
  Forall P l -> Forall P (fragments (build_at at_most place l)).
Proof.
  intros P K.
  apply (build_induction (fun l t => Forall P l -> Forall P (fragments t)));
    auto.
  intros l root c p n place m V _ _ D _ _ _ Hp Hn H; simpl.
  destruct (distribute_forall P K _ _ _ _ _ D V H) as (A & B & C).
  rewrite !Forall_app; auto.
Qed.

Lemma put_forall : forall (P : Fragment -> Prop) f l,
  P f -> Forall P l -> Forall P (put f l).
Proof.
  intros P f l H; induction l as [|g l IH]; intros A; simpl; auto.
  inversion A; subst; destruct (_ <? _)%Z; auto.
Qed.

Lemma insert_forall : forall P : Fragment -> Prop,
  (forall f h, valid f -> P f -> relation f h = rSpanning ->
   P (fst (split f h)) /\ P (snd (split f h))) ->
  forall tree f, valid f -> P f -> Forall P (fragments tree) ->
  Forall P (fragments (insert f tree)).
Proof.
  intros P K; induction tree as [|h c p IHp n IHn]; intros f V H A; simpl;
    [auto|].
  simpl in A; rewrite !Forall_app in A; destruct A as (A & B & C).
  destruct (relation f h) eqn:R; simpl; rewrite !Forall_app; auto.
  - auto using put_forall.
  - destruct (K f h V H R), (split_valid f h V R); auto.
Qed.

End Tree.

Arguments Nothing {Fragment Plane}.
Arguments Node {Fragment Plane}.
Arguments fragments {Fragment Plane}.
Arguments nodes {Fragment Plane}.

