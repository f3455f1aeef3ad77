(** * S3: building a tree, inserting into one, and walking it.

    The programs are those of [ref/src/build.cpp] and [ref/src/traverse.cpp].
    They are written for any kind of fragment and plane; what is proven of them
    rests on what a split does, which is given with each section, and which
    [Scene.v] shows of polygons in space. *)

From Coq Require Import ZArith QArith Lqa Lia List Bool Permutation.
From Coq Require Import Relations Sorted.
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

(** ** What the geometry has to give, and [Scene.v] does *)

(** What fragments are taken to be: a fragment lies in its own plane, and so
    do the parts of it. *)
Variable valid : Fragment -> Prop.
Hypothesis own_plane : forall f, valid f ->
  relation f (plane_of f) = rCoincident.
Hypothesis split_valid : forall f h, valid f -> relation f h = rSpanning ->
  valid (fst (split f h)) /\ valid (snd (split f h)).

(** ** Whatever a split keeps, a tree keeps *)

Section Kept.

(** A sum over fragments, such as an area, that a split divides between the
    parts. *)
Variable weight : Fragment -> Q.
Hypothesis split_weight : forall f h, valid f -> relation f h = rSpanning ->
  (weight f == weight (fst (split f h)) + weight (snd (split f h)))%Q.

Definition total (l : list Fragment) : Q :=
  fold_right (fun f sum => weight f + sum)%Q 0%Q l.

Lemma total_app : forall l m, (total (l ++ m) == total l + total m)%Q.
Proof.
  induction l as [|f l IH]; intros m; simpl; [ring|]; rewrite IH; ring.
Qed.

Lemma distribute_total : forall l h c p n,
  distribute l h = (c, p, n) -> Forall valid l ->
  (total l == total c + total p + total n)%Q.
Proof.
  induction l as [|f l IH]; intros h c p n; simpl.
  - intros E _; injection E as <- <- <-; simpl; ring.
  - destruct (distribute l h) as [[c' p'] n'] eqn:D.
    intros E V; inversion V as [|? ? V1 V2]; subst; revert E.
    specialize (IH h c' p' n' D V2).
    destruct (relation f h) eqn:R; intros E; injection E as <- <- <-; simpl;
      rewrite IH; try ring.
    rewrite (split_weight f h V1 R); ring.
Qed.

Lemma put_total : forall f l, (total (put f l) == weight f + total l)%Q.
Proof.
  intros f; induction l as [|g l IH]; simpl; [ring|].
  destruct (_ <? _)%Z; simpl; [ring | rewrite IH; ring].
Qed.

(** S3.6: insertion adds the fragment's weight, no more and no less. *)
Theorem insert_total : forall tree f, valid f ->
  (total (fragments (insert f tree)) == weight f + total (fragments tree))%Q.
Proof.
  induction tree as [|h c p IHp n IHn]; intros f V; simpl; [ring|].
  destruct (relation f h) eqn:R; simpl; rewrite ?total_app.
  - rewrite IHp by exact V; ring.
  - rewrite IHn by exact V; ring.
  - rewrite put_total; ring.
  - destruct (split_valid f h V R) as [P N].
    rewrite (IHp _ P), (IHn _ N), (split_weight f h V R); ring.
Qed.

Theorem insert_all_total : forall l tree, Forall valid l ->
  (total (fragments (insert_all l tree)) ==
   total l + total (fragments tree))%Q.
Proof.
  unfold insert_all; induction l as [|f l IH]; intros tree V; simpl; [ring|].
  inversion V as [|? ? V1 V2]; subst.
  rewrite IH, insert_total by assumption; ring.
Qed.

End Kept.

Section Points.

(** Membership of a point in closed fragments: a split's parts together have
    the points of the whole. *)
Variable has : Fragment -> Prop.
Hypothesis split_has : forall f h, valid f -> relation f h = rSpanning ->
  (has f <-> has (fst (split f h)) \/ has (snd (split f h))).

Lemma distribute_has : forall l h c p n,
  distribute l h = (c, p, n) -> Forall valid l ->
  (Exists has l <-> Exists has c \/ Exists has p \/ Exists has n).
Proof.
  induction l as [|f l IH]; intros h c p n; simpl.
  - intros E _; injection E as <- <- <-; rewrite Exists_nil; tauto.
  - destruct (distribute l h) as [[c' p'] n'] eqn:D.
    intros E V; inversion V as [|? ? V1 V2]; subst; revert E.
    specialize (IH h c' p' n' D V2).
    destruct (relation f h) eqn:R; intros E; injection E as <- <- <-;
      rewrite !Exists_cons, IH; try tauto.
    rewrite (split_has f h V1 R); tauto.
Qed.

Lemma put_has : forall f l, Exists has (put f l) <-> has f \/ Exists has l.
Proof.
  intros f; induction l as [|g l IH]; simpl.
  - rewrite Exists_cons, Exists_nil; tauto.
  - destruct (_ <? _)%Z; rewrite !Exists_cons, ?IH, ?Exists_cons; tauto.
Qed.

(** S3.6: insertion loses and invents no point. *)
Theorem insert_has : forall tree f, valid f ->
  Exists has (fragments (insert f tree)) <->
  has f \/ Exists has (fragments tree).
Proof.
  induction tree as [|h c p IHp n IHn]; intros f V; simpl.
  - rewrite Exists_cons; tauto.
  - destruct (relation f h) eqn:R; simpl; rewrite ?Exists_app.
    + rewrite (IHp f V); tauto.
    + rewrite (IHn f V); tauto.
    + rewrite put_has; tauto.
    + destruct (split_valid f h V R) as [P N].
      rewrite (IHp _ P), (IHn _ N), (split_has f h V R); tauto.
Qed.

Theorem insert_all_has : forall l tree, Forall valid l ->
  Exists has (fragments (insert_all l tree)) <->
  Exists has l \/ Exists has (fragments tree).
Proof.
  unfold insert_all; induction l as [|f l IH]; intros tree V; simpl.
  - rewrite Exists_nil; tauto.
  - inversion V as [|? ? V1 V2]; subst.
    rewrite (IH _ V2), (insert_has _ _ V1), Exists_cons; tauto.
Qed.

End Points.

(** ** A build comes to an end with every polygon in the tree *)

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
    inversion F as [|? ? H1 H2]; subst.
    destruct (IH h c' p' n' D V2 H2) as (A & B & C).
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
  (forall f h, valid f -> relation f h = rSpanning ->
   (weight f == weight (fst (split f h)) + weight (snd (split f h)))%Q) ->
  forall l, Forall valid l ->
  (total weight (fragments (build l)) == total weight l)%Q.
Proof.
  intros weight W l V; unfold build.
  apply (build_induction (fun l t => total weight (fragments t) ==
    total weight l)%Q); auto; [reflexivity|].
  clear l V; intros l root c p n place m V _ _ D _ _ _ P N; simpl.
  rewrite !total_app, P, N, (distribute_total weight W _ _ _ _ _ D V); ring.
Qed.

(** S3.5: a tree loses and invents no point, however roots are chosen. *)
Theorem build_has : forall has : Fragment -> Prop,
  (forall f h, valid f -> relation f h = rSpanning ->
   (has f <-> has (fst (split f h)) \/ has (snd (split f h)))) ->
  forall l, Forall valid l ->
  (Exists has (fragments (build l)) <-> Exists has l).
Proof.
  intros has W l V; unfold build.
  apply (build_induction (fun l t =>
    Exists has (fragments t) <-> Exists has l)); auto; [reflexivity|].
  clear l V; intros l root c p n place m V _ _ D _ _ _ P N; simpl.
  rewrite !Exists_app, P, N, (distribute_has has W _ _ _ _ _ D V); tauto.
Qed.

(** ** HEUR's Theorem 3: what no plane cuts in a circle is never cut *)

(** S3.3: whether the plane of [p] cuts [f]: an edge of HEUR's graph G(I). *)
Definition cuts (p f : Fragment) : bool :=
  match relation f (plane_of p) with rSpanning => true | _ => false end.

(** S3.3: out(P). *)
Definition out (l : list Fragment) (p : Fragment) : nat :=
  length (filter (cuts p) l).

(** One may not come back to where one began, from fragment to fragment of the
    list, each cut by the plane of the one before. *)
Definition no_cycle (l : list Fragment) : Prop :=
  forall f, ~ clos_trans Fragment
    (fun p g => In p l /\ In g l /\ cuts p g = true) f f.

(** No two fragments of the list are coplanar. *)
Definition no_coplanar (l : list Fragment) : Prop :=
  NoDup l /\ forall p f, In p l -> In f l ->
  relation f (plane_of p) = rCoincident -> f = p.

(** S3.3: [kFewestCuts], [kH1] and [kH3] choose so. *)
Definition least_out : Prop :=
  forall place l first p, In first l -> In p l ->
  (out l (nth (choose_root place l) l first) <= out l p)%nat.

Lemma trans_mono : forall (A : Type) (R S : A -> A -> Prop),
  (forall x y, R x y -> clos_trans A S x y) ->
  forall x y, clos_trans A R x y -> clos_trans A S x y.
Proof.
  intros A R S H x y T; induction T as [x y E | x y z _ IH1 _ IH2]; auto.
  now apply t_trans with y.
Qed.

(** A graph without cycles has a member that leads nowhere. *)
Lemma an_end : forall (A : Type) (l : list A) (leads : A -> A -> bool),
  (forall x, ~ clos_trans A
     (fun p f => In p l /\ In f l /\ leads p f = true) x x) ->
  l <> [] -> exists p, In p l /\ forall f, In f l -> leads p f = false.
Proof.
  intros A; induction l as [|a l IH]; intros leads C N; [easy|].
  assert (leads a a = false) as Aa.
  { destruct (leads a a) eqn:E; [exfalso | reflexivity].
    apply (C a), t_step; simpl; auto. }
  destruct l as [|b l']; [exists a; simpl; split; auto; intros f [<- | []];
    exact Aa|].
  set (l := b :: l') in *.
  destruct (IH (fun x y => leads x y || leads x a && leads a y))
    as (p & P & H); [|easy|].
  - intros x T; apply (C x); revert T; apply trans_mono.
    intros y z (Y & Z & E); apply orb_true_iff in E; destruct E as [E | E].
    + apply t_step; simpl; auto.
    + apply andb_true_iff in E; destruct E as [E F].
      apply t_trans with a; apply t_step; simpl; auto.
  - destruct (leads p a) eqn:E.
    + exists a; split; [now left|]; intros f [<- | F]; [exact Aa|].
      specialize (H f F); simpl in H; apply orb_false_iff in H.
      destruct H as [_ H]; exact H.
    + exists p; split; [now right|]; intros f [<- | F]; [exact E|].
      specialize (H f F); simpl in H; apply orb_false_iff in H; tauto.
Qed.

Lemma distribute_uncut : forall l h c p n,
  distribute l h = (c, p, n) ->
  (forall f, In f l -> relation f h <> rSpanning) ->
  Permutation (c ++ p ++ n) l.
Proof.
  induction l as [|f l IH]; intros h c p n; simpl.
  - intros E _; injection E as <- <- <-; constructor.
  - destruct (distribute l h) as [[c' p'] n'] eqn:D.
    intros E U; assert (relation f h <> rSpanning) as Uf by (apply U; auto).
    specialize (IH h c' p' n' D (fun g G => U g (or_intror G))).
    destruct (relation f h); injection E as <- <- <-; try easy; rewrite <- IH;
      simpl.
    + symmetry; apply Permutation_middle.
    + rewrite !app_assoc; symmetry; apply Permutation_middle.
    + reflexivity.
Qed.

Lemma no_cycle_incl : forall l m, incl m l -> no_cycle l -> no_cycle m.
Proof.
  intros l m I C f T; apply (C f); revert T; apply trans_mono.
  intros x y (X & Y & E); apply t_step; auto.
Qed.

Lemma no_repeats_app : forall l m : list Fragment,
  NoDup (l ++ m) -> NoDup l /\ NoDup m.
Proof.
  induction l as [|f l IH]; intros m N; simpl in *.
  - split; [constructor | exact N].
  - inversion N as [|? ? X Y]; subst; destruct (IH m Y); split; auto.
    constructor; auto; intros F; apply X, in_or_app; auto.
Qed.

(** S3.L9: then the tree has the polygons themselves, each in its own node. *)
Theorem acyclic_tree_has_n_nodes : least_out ->
  forall l, Forall valid l -> no_cycle l -> no_coplanar l ->
  Permutation (fragments (build l)) l /\ nodes (build l) = length l.
Proof.
  intros L l V; unfold build.
  apply (build_induction (fun l t => no_cycle l -> no_coplanar l ->
    Permutation (fragments t) l /\ nodes t = length l)); auto.
  clear l V; intros l root c p n place m V I E D C _ _ P N G [U W].
  assert (forall f, In f l -> relation f (plane_of root) <> rSpanning) as Z.
  { destruct (an_end Fragment l cuts G) as (q & Q & H);
      [intros ->; destruct I|].
    assert (out l q = 0)%nat as O.
    { unfold out; clear - H; induction l as [|f l IH]; [reflexivity|]; simpl.
      rewrite H by (simpl; auto); apply IH; intros; apply H; simpl; auto. }
    pose proof (L place l root q I Q) as O'; rewrite <- E, O in O'.
    intros f F S; unfold out in O'.
    assert (In f (filter (cuts root) l)) as J.
    { apply filter_In; split; [exact F|]; unfold cuts; now rewrite S. }
    destruct (filter (cuts root) l); [destruct J | simpl in O'; lia]. }
  pose proof (distribute_uncut _ _ _ _ _ D Z) as R.
  assert (c = [root]) as ->.
  { assert (NoDup (c ++ p ++ n)) as B.
    { apply (Permutation_NoDup (Permutation_sym R) U). }
    assert (forall f, In f c -> f = root) as A.
    { intros f F; apply (distribute_coincident _ _ _ _ _ f D) in F.
      apply W; tauto. }
    destruct c as [|f [|g c]]; [destruct C | rewrite (A f); simpl; auto |].
    exfalso; inversion B as [|? ? X _]; apply X; left.
    rewrite (A f), (A g); simpl; auto. }
  assert (forall k, incl k ([root] ++ p ++ n) -> NoDup k ->
          no_cycle k /\ no_coplanar k) as K.
  { intros k J B; assert (incl k l) as J'.
    { intros f F; apply (Permutation_in f R), J, F. }
    split; [now apply (no_cycle_incl l)|]; split; [exact B|].
    intros q f Q F; apply W; auto. }
  assert (NoDup ([root] ++ p ++ n)) as B.
  { apply (Permutation_NoDup (Permutation_sym R) U). }
  apply NoDup_cons_iff in B; destruct B as [_ B].
  destruct (K p) as [Kp1 Kp2].
  { intros f F; apply in_or_app; right; apply in_or_app; auto. }
  { apply (no_repeats_app _ _ B). }
  destruct (K n) as [Kn1 Kn2].
  { intros f F; apply in_or_app; right; apply in_or_app; auto. }
  { apply (no_repeats_app _ _ B). }
  destruct (P Kp1 Kp2) as [Pp Np], (N Kn1 Kn2) as [Pn Nn]; simpl.
  split.
  - rewrite Pp, Pn; exact R.
  - rewrite Np, Nn, <- (Permutation_length R); simpl; now rewrite app_length.
Qed.

(** ** Insertion in order is building with the first as root *)

(** Insertion into a node takes each polygon where [distribute] puts it. *)
Lemma insert_all_node : forall l h c p n lc lp ln,
  distribute l h = (lc, lp, ln) ->
  insert_all l (Node h c p n) =
  Node h (fold_left (fun c f => put f c) lc c) (insert_all lp p)
    (insert_all ln n).
Proof.
  unfold insert_all; induction l as [|f l IH]; intros h c p n lc lp ln; simpl.
  - intros E; injection E as <- <- <-; reflexivity.
  - destruct (distribute l h) as [[c' p'] n'] eqn:D.
    destruct (relation f h); intros E; injection E as <- <- <-;
      now rewrite (IH h _ _ _ c' p' n' D).
Qed.

Lemma put_last : forall f l,
  Forall (fun g => (source g <= source f)%Z) l -> put f l = l ++ [f].
Proof.
  intros f; induction l as [|g l IH]; intros A; [reflexivity|]; simpl.
  inversion A as [|? ? A1 A2]; subst.
  destruct (Z.ltb_spec (source f) (source g)); [lia | now rewrite IH].
Qed.

Lemma put_all : forall l c,
  StronglySorted (fun f g => (source f <= source g)%Z) (c ++ l) ->
  fold_left (fun c f => put f c) l c = c ++ l.
Proof.
  induction l as [|f l IH]; intros c S; simpl; [now rewrite app_nil_r|].
  change (f :: l) with ([f] ++ l) in *; rewrite app_assoc in *.
  rewrite put_last; [now apply IH|].
  clear IH; induction c as [|g c IH]; [constructor|]; simpl in S.
  inversion S as [|? ? S1 S2]; subst; constructor; [|now apply IH].
  rewrite Forall_forall in S2; apply S2; apply in_or_app; left.
  apply in_or_app; right; now left.
Qed.

Lemma distribute_sorted : forall l h c p n, distribute l h = (c, p, n) ->
  StronglySorted (fun f g => (source f <= source g)%Z) l ->
  Forall valid l -> (forall f h, source (fst (split f h)) = source f /\
                                 source (snd (split f h)) = source f) ->
  StronglySorted (fun f g => (source f <= source g)%Z) c /\
  StronglySorted (fun f g => (source f <= source g)%Z) p /\
  StronglySorted (fun f g => (source f <= source g)%Z) n.
Proof.
  intros l h c p n D S V K; revert c p n D.
  induction S as [|f l S IH A]; intros c p n; simpl.
  - intros E; injection E as <- <- <-; repeat split; constructor.
  - inversion V as [|? ? V1 V2]; subst.
    destruct (distribute l h) as [[c' p'] n'] eqn:D.
    intros E; destruct (IH V2 c' p' n' eq_refl) as (B1 & B2 & B3).
    destruct (distribute_forall (fun g => (source f <= source g)%Z))
      with (l := l) (h := h) (c := c') (p := p') (n := n')
      as (C1 & C2 & C3); auto.
    { intros g k _ G _; destruct (K g k) as [-> ->]; auto. }
    destruct (K f h) as [K1 K2].
    destruct (relation f h); injection E as <- <- <-; repeat split; auto;
      constructor; rewrite ?K1, ?K2; auto.
Qed.

(** S3.L10: inserting polygons one by one gives the tree that is built with
    the first of each list as root. *)
Theorem insertion_is_building_with_the_first :
  (forall place l, choose_root place l = 0%nat) ->
  (forall f h, source (fst (split f h)) = source f /\
               source (snd (split f h)) = source f) ->
  forall l, Forall valid l ->
  StronglySorted (fun f g => (source f <= source g)%Z) l ->
  insert_all l Nothing = build l.
Proof.
  intros First K l V; unfold build.
  apply (build_induction (fun l t =>
    StronglySorted (fun f g => (source f <= source g)%Z) l ->
    insert_all l Nothing = t)); auto.
  clear l V; intros l root c p n place m V I E D _ _ _ P N S.
  destruct (distribute_sorted _ _ _ _ _ D S V K) as (S1 & S2 & S3).
  rewrite First in E; destruct l as [|f l]; [destruct I|].
  simpl in E; subst f; simpl in D.
  destruct (distribute l (plane_of root)) as [[c' p'] n'] eqn:D'.
  rewrite own_plane in D by now inversion V.
  injection D as <- <- <-; unfold insert_all in *; simpl.
  change (fold_left (fun t polygon => insert polygon t) l
    (Node (plane_of root) [root] Nothing Nothing))
    with (insert_all l (Node (plane_of root) [root] Nothing Nothing)).
  rewrite (insert_all_node _ _ _ _ _ _ _ _ D'), put_all by exact S1.
  unfold insert_all; now rewrite P, N.
Qed.

(** In any order it gives as many nodes. *)
Theorem insertion_nodes : (forall place l, choose_root place l = 0%nat) ->
  forall l, Forall valid l -> nodes (insert_all l Nothing) = nodes (build l).
Proof.
  intros First l V; unfold build.
  apply (build_induction (fun l t => nodes (insert_all l Nothing) = nodes t));
    auto.
  clear l V; intros l root c p n place m V I E D _ _ _ P N.
  rewrite First in E; destruct l as [|f l]; [destruct I|].
  simpl in E; subst f; simpl in D.
  destruct (distribute l (plane_of root)) as [[c' p'] n'] eqn:D'.
  rewrite own_plane in D by now inversion V.
  injection D as <- <- <-.
  change (insert_all (root :: l) Nothing)
    with (insert_all l (Node (plane_of root) [root] Nothing Nothing)).
  rewrite (insert_all_node _ _ _ _ _ _ _ _ D'); simpl; now rewrite P, N.
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

