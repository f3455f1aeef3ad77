(** * S1.3, S2, S4.5: polygons in space, and what a plane makes of them.

    The relation and the split are those of [Split.v], whose parts [Convex.v]
    shows to be convex polygons; here they are put on the planes of a scene, as
    [Tree.v] asks. [View.v] shows such fragments to a camera. *)

From Coq Require Import QArith Lqa Lia List Bool.
From Halfspace Require Import Base Convex.
From Halfspace Require Split.
Import ListNotations.
Open Scope Q_scope.

(** A plane at the homogeneous point (p, w): a point of space if [w] is 1, a
    direction if it is 0. *)
Definition value_of (h : Plane) (p : Point) (w : Q) : Q :=
  dot (normal h) p + pd h * w.

Lemma value_of_point : forall h p, value_of h p 1 == value_at h p.
Proof. intros; unfold value_of, value_at, dot; simpl; ring. Qed.

(** ** Fragments *)

(** S2.2: what [Split.v] cuts, and the plane of the source. *)
Record Fragment := { shape : Split.Fragment; support : Plane }.

Definition source (f : Fragment) : Z := Split.source (shape f).
Definition vertices (f : Fragment) : list Point := Split.vertices (shape f).

Definition whole (id : Z) (plane : Plane) (corners : list Point) : Fragment :=
  {| shape := {|
       Split.source := id;
       Split.edges := map (fun k => Split.kSource (Z.of_nat k))
                        (seq 0 (length corners));
       Split.vertices := corners |};
     support := plane |}.

Fixpoint edges_along (h : Plane) (corners : list Point) : list Plane :=
  match corners with
  | p :: (q :: _) as rest => edge_plane h p q :: edges_along h rest
  | _ => []
  end.

(** S4.5: planes through all edges, round the polygon and back to the first
    corner, positive on the polygon's side. *)
Definition edges_of (h : Plane) (corners : list Point) : list Plane :=
  match corners with
  | [] => []
  | p :: _ => edges_along h (corners ++ [p])
  end.

Definition edges (f : Fragment) : list Plane :=
  edges_of (support f) (vertices f).

(** S3.1: the plane of a node, by the polygon that gave it. *)
Record Splitter := { splitter : Z; plane : Plane }.

Definition splitter_of (f : Fragment) : Splitter :=
  {| splitter := source f; plane := support f |}.

(** S2.1. *)
Definition relation (f : Fragment) (s : Splitter) : Relation :=
  Split.relation (shape f) (plane s).

(** S2.3. *)
Definition part (side : Side) (f : Fragment) (s : Splitter) : Fragment :=
  {| shape := Split.part_of side (shape f) (plane s) (splitter s);
     support := support f |}.

Definition split (f : Fragment) (s : Splitter) : Fragment * Fragment :=
  (part kPositive f s, part kNegative f s).

Lemma split_shapes : forall f s,
  (shape (fst (split f s)), shape (snd (split f s))) =
  Split.split (shape f) (plane s) (splitter s).
Proof. reflexivity. Qed.

(** ** What a fragment is *)

Definition inside (f : Fragment) (q : Point) : Prop :=
  value_at (support f) q == 0 /\
  forall e, In e (edges f) -> 0 < value_at e q.

Definition valid (f : Fragment) : Prop :=
  polygon_ok (support f) (vertices f).

Lemma edges_are : forall h l e, In e (edges_of h l) <->
  exists p q, In (p, q) (round l) /\ e = edge_plane h p q.
Proof.
  intros h l e; destruct l as [|x l].
  - split; [intros [] | intros (p & q & [] & _)].
  - unfold edges_of, round; generalize ((x :: l) ++ [x]); clear x l.
    induction l as [|p [|q l] IH].
    + split; [intros [] | intros (p & q & [] & _)].
    + split; [intros [] | intros (a & b & [] & _)].
    + change (edges_along h (p :: q :: l)) with
        (edge_plane h p q :: edges_along h (q :: l)).
      change (along (p :: q :: l)) with ((p, q) :: along (q :: l)).
      simpl In; rewrite IH; split.
      * intros [E | (a & b & I & E)]; [exists p, q | exists a, b]; auto.
      * intros (a & b & [E | I] & ->).
        -- injection E as <- <-; auto.
        -- right; exists a, b; auto.
Qed.

Theorem valid_normal : forall f, valid f -> not_zero (support f).
Proof.
  intros f V (X & Y & Z); destruct (ok_area _ _ V) as (p & q & v & _ & _ & L).
  assert (value_at (edge_plane (support f) p q) v == 0); [|lra].
  unfold value_at, edge_plane, cross, dot, normal; simpl; rewrite X, Y, Z; ring.
Qed.

Lemma turning : forall n g a b c,
  0 < dot n n -> dot n a == 0 -> dot n b == 0 -> dot n c == 0 ->
  0 < dot g a -> 0 < dot g b -> 0 < dot g c ->
  0 < dot n (cross a b) -> 0 < dot n (cross b c) -> 0 < dot n (cross a c).
Proof.
  intros n g a b c N A B C Ga Gb Gc AB BC.
  set (det := dot a (cross b c)).
  assert (det * dot n n == dot n (cross b c) * dot n a -
          dot n (cross a c) * dot n b + dot n (cross a b) * dot n c) as D.
  { unfold det, dot, cross; simpl; ring. }
  rewrite A, B, C in D.
  assert (det == 0) as Z.
  { destruct (Qeq_dec det 0) as [E | E]; [exact E|exfalso].
    assert (det * dot n n == 0) as E' by lra.
    apply Qmult_integral in E'; destruct E'; lra. }
  assert (det * dot g n == dot n (cross b c) * dot g a -
          dot n (cross a c) * dot g b + dot n (cross a b) * dot g c) as E.
  { unfold det, dot, cross; simpl; ring. }
  rewrite Z in E.
  assert (0 < dot n (cross b c) * dot g a) by nra.
  assert (0 < dot n (cross a b) * dot g c) by nra.
  destruct (Qlt_le_dec 0 (dot n (cross a c))) as [L | L]; [exact L|exfalso].
  assert (dot n (cross a c) * dot g b <= 0) by nra.
  lra.
Qed.

Lemma edge_turns : forall h p r q,
  value_at (edge_plane h p r) q ==
  dot (normal h) (cross (difference p q) (difference r q)).
Proof.
  intros; unfold value_at, edge_plane, dot, cross, difference, normal; simpl.
  ring.
Qed.

Section Hull.

Variables (plane h : Plane) (q : Point).
Hypothesis ok : not_zero plane.
Hypothesis q_in_plane : value_at plane q == 0.
Hypothesis q_outside : value_at h q < 0.

Definition planar (v : Point) : Prop :=
  value_at plane v == 0 /\ 0 <= value_at h v.

Let n := normal plane.
Let w (v : Point) := difference v q.

Lemma planar_facts : forall v, planar v ->
  dot n (w v) == 0 /\ 0 < dot (normal h) (w v).
Proof.
  intros v [A B]; unfold n, w, dot, difference, normal; simpl.
  unfold value_at in *; split; lra.
Qed.

Lemma walk_turns : forall l start p z,
  Forall planar (start :: p :: l ++ [z]) ->
  0 < dot n (cross (w start) (w p)) ->
  Forall (fun e => 0 < value_at e q) (edges_along plane (p :: l ++ [z])) ->
  0 < dot n (cross (w start) (w z)).
Proof.
  induction l as [|r l IH]; intros start p z P S E; simpl in *.
  - inversion E as [|? ? E1 _]; subst; rewrite edge_turns in E1.
    inversion P as [|? ? P1 P']; inversion P' as [|? ? P2 P'']; subst.
    inversion P'' as [|? ? P3 _]; subst.
    apply planar_facts in P1, P2, P3.
    apply (turning n (normal h) (w start) (w p) (w z)); try tauto.
    now apply not_zero_square.
  - inversion E as [|? ? E1 E2]; subst; rewrite edge_turns in E1.
    inversion P as [|? ? P1 P']; inversion P' as [|? ? P2 P'']; subst.
    apply (IH start r z); auto.
    inversion P'' as [|? ? P3 _]; subst.
    apply planar_facts in P1, P2, P3.
    apply (turning n (normal h) (w start) (w p) (w r)); try tauto.
    now apply not_zero_square.
Qed.

(** Going round, every edge turning to the left as seen from [q], one does not
    come back to where one began within a half-plane. *)
Lemma no_way_round : forall corners,
  Forall planar corners -> corners <> [] ->
  Forall (fun e => 0 < value_at e q) (edges_of plane corners) -> False.
Proof.
  intros [|p l] P N E; [easy|]; simpl edges_of in E.
  assert (0 < dot n (cross (w p) (w p))) as H.
  { destruct l as [|r l].
    - simpl in E; inversion E as [|? ? E1 _]; subst.
      now rewrite edge_turns in E1.
    - simpl in E; inversion E as [|? ? E1 E2]; subst.
      rewrite edge_turns in E1; apply (walk_turns l p r p); auto.
      inversion P as [|? ? P1 P2]; subst; constructor; auto.
      change (r :: l ++ [p]) with ((r :: l) ++ [p]).
      apply Forall_app; auto. }
  assert (dot n (cross (w p) (w p)) == 0); [|lra].
  unfold dot, cross; simpl; ring.
Qed.

End Hull.

Definition total_at (q : Point) (w : Q) (l : list Plane) : Q :=
  fold_right (fun e sum => value_of e q w + sum) 0 l.

Definition origin : Point := Split.origin.

Lemma total_along : forall h q w l p z,
  total_at q w (edges_along h (p :: l ++ [z])) ==
  dot (cross (normal h) (difference z p)) q +
  w * total_at origin 1 (edges_along h (p :: l ++ [z])).
Proof.
  intros h q w; induction l as [|r l IH]; intros p z.
  - simpl; unfold value_of, dot, cross, difference; simpl; ring.
  - change (total_at q w (edges_along h (p :: (r :: l) ++ [z]))) with
      (value_of (edge_plane h p r) q w +
       total_at q w (edges_along h (r :: l ++ [z]))).
    change (total_at origin 1 (edges_along h (p :: (r :: l) ++ [z]))) with
      (value_of (edge_plane h p r) origin 1 +
       total_at origin 1 (edges_along h (r :: l ++ [z]))).
    rewrite IH; unfold value_of, dot, cross, difference; simpl; ring.
Qed.

(** The sum over the edges does not depend on the point, but for its weight. *)
Lemma total_round : forall h corners q w,
  total_at q w (edges_of h corners) ==
  w * total_at origin 1 (edges_of h corners).
Proof.
  intros h [|p l] q w; [simpl; ring|]; unfold edges_of.
  change ((p :: l) ++ [p]) with (p :: l ++ [p]).
  rewrite (total_along h q w l p p).
  assert (dot (cross (normal h) (difference p p)) q == 0) as ->; [|ring].
  unfold dot, cross, difference; simpl; ring.
Qed.

Lemma total_not_negative : forall q w l,
  (forall e, In e l -> 0 <= value_of e q w) -> 0 <= total_at q w l.
Proof.
  intros q w; induction l as [|e l IH]; intros H; simpl; [lra|].
  assert (0 <= value_of e q w) by (apply H; simpl; auto).
  assert (0 <= total_at q w l) by (apply IH; simpl in *; auto); lra.
Qed.

Lemma total_positive : forall q w l,
  (forall e, In e l -> 0 <= value_of e q w) ->
  (exists e, In e l /\ 0 < value_of e q w) -> 0 < total_at q w l.
Proof.
  intros q w; induction l as [|e l IH]; intros H [k [K P]]; [destruct K|].
  assert (0 <= value_of e q w) by (apply H; simpl; auto).
  assert (0 <= total_at q w l).
  { apply total_not_negative; intros; apply H; simpl; auto. }
  simpl; destruct K as [-> | K]; [lra|].
  assert (0 < total_at q w l); [|lra].
  apply IH; [intros; apply H; simpl; auto | exists k; auto].
Qed.

(** S2.2: what is inside all edges lies between the vertices. *)
Theorem valid_hull : forall f q h, valid f -> inside f q ->
  (forall v, In v (vertices f) -> 0 <= value_at h v) -> 0 <= value_at h q.
Proof.
  intros f q h V [P E] H.
  destruct (Qlt_le_dec (value_at h q) 0) as [L | L]; [exfalso | exact L].
  apply (no_way_round (support f) h q (valid_normal f V) P L (vertices f)).
  - apply Forall_forall; intros u U; split; auto.
    now apply (ok_planar _ _ V).
  - intros N; destruct (ok_area _ _ V) as (p & a & v & _ & I & _).
    rewrite N in I; destruct I.
  - apply Forall_forall; exact E.
Qed.

(** S4.5, no horizon test: nothing at infinity or beyond is inside. *)
Theorem valid_bounded : forall f q w, valid f ->
  (forall e, In e (edges f) -> 0 < value_of e q w) -> 0 < w.
Proof.
  intros f q w V H; destruct (ok_area _ _ V) as (a & b & v & E & I & P).
  assert (In (edge_plane (support f) a b) (edges f)) as J.
  { apply edges_are; exists a, b; auto. }
  assert (0 < total_at q w (edges f)) as T.
  { apply total_positive; [intros k K; apply Qlt_le_weak; auto|].
    exists (edge_plane (support f) a b); auto. }
  assert (0 < total_at v 1 (edges f)) as U.
  { apply total_positive.
    - intros k K; rewrite value_of_point; apply edges_are in K.
      destruct K as (r & s & K & ->); now apply (ok_convex _ _ V).
    - exists (edge_plane (support f) a b); rewrite value_of_point; auto. }
  unfold edges in T, U; rewrite total_round in T; rewrite total_round in U.
  destruct (Qlt_le_dec 0 w) as [L | L]; [exact L | exfalso; nra].
Qed.

(** S2.L6: the parts of a fragment are fragments. *)
Theorem split_valid : forall f s, valid f -> relation f s = rSpanning ->
  valid (fst (split f s)) /\ valid (snd (split f s)).
Proof.
  intros f s V R; split;
    apply (parts_are_convex_polygons (support f) (plane s) (shape f)
             (valid_normal f V) V R); discriminate.
Qed.

(** S2.1: what the relation says of the vertices. *)
Theorem relation_vertices : forall f s,
  let h := plane s in
  match relation f s with
  | rPositive => (forall v, In v (vertices f) -> 0 <= value_at h v) /\
                 exists v, In v (vertices f) /\ 0 < value_at h v
  | rNegative => (forall v, In v (vertices f) -> value_at h v <= 0) /\
                 exists v, In v (vertices f) /\ value_at h v < 0
  | rCoincident => forall v, In v (vertices f) -> value_at h v == 0
  | rSpanning => (exists v, In v (vertices f) /\ 0 < value_at h v) /\
                 exists v, In v (vertices f) /\ value_at h v < 0
  end.
Proof.
  intros f s h; unfold relation, Split.relation.
  destruct (Split.relation_is_the_table (Split.sides_of (shape f) (plane s)))
    as (P & N & C & S).
  assert (forall side, In side (Split.sides_of (shape f) (plane s)) <->
          exists v, In v (vertices f) /\ side_of h v = side) as I.
  { intros side; unfold Split.sides_of; rewrite in_map_iff.
    split; intros (v & A & B); exists v; auto. }
  rewrite !I in *; clear I.
  assert (forall v, side_of h v = kPositive <-> 0 < value_at h v) as Sp.
  { intros; apply sign_positive. }
  assert (forall v, side_of h v = kNegative <-> value_at h v < 0) as Sn.
  { intros; apply sign_negative. }
  destruct (Split.relation_of _) eqn:E.
  - destruct (proj1 P eq_refl) as [A (v & V & L)]; split.
    + intros u U; destruct (Qlt_le_dec (value_at h u) 0); [|assumption].
      exfalso; apply A; exists u; split; [exact U | now apply Sn].
    + exists v; split; [exact V | now apply Sp].
  - destruct (proj1 N eq_refl) as [A (v & V & L)]; split.
    + intros u U; destruct (Qlt_le_dec 0 (value_at h u)); [|assumption].
      exfalso; apply A; exists u; split; [exact U | now apply Sp].
    + exists v; split; [exact V | now apply Sn].
  - intros v V; apply sign_on; apply (proj1 C eq_refl).
    unfold Split.sides_of; apply in_map_iff; exists v; auto.
  - destruct (proj1 S eq_refl) as [(u & U & L) (v & V & M)]; split.
    + exists u; split; [exact U | now apply Sp].
    + exists v; split; [exact V | now apply Sn].
Qed.

(** A fragment lies in its own plane. *)
Theorem own_plane : forall f, valid f ->
  relation f (splitter_of f) = rCoincident.
Proof.
  intros f V; pose proof (relation_vertices f (splitter_of f)) as R.
  pose proof (ok_planar _ _ V) as P; simpl in R.
  destruct (relation f (splitter_of f)); try reflexivity; exfalso.
  - destruct R as [_ (v & I & H)]; specialize (P v I); lra.
  - destruct R as [_ (v & I & H)]; specialize (P v I); lra.
  - destruct R as [(v & I & H) _]; specialize (P v I); lra.
Qed.

(** ** The corners of a part *)

Lemma part_corners_are : forall side f s, side <> kOn ->
  vertices (part side f s) = corners_of side (plane s) (vertices f).
Proof. intros; now apply walk_emits. Qed.

Lemma spanning_both : forall side f s, side <> kOn ->
  relation f s = rSpanning ->
  (exists v, In v (vertices f) /\ 0 < value_at (toward side (plane s)) v) /\
  (exists v, In v (vertices f) /\ value_at (toward side (plane s)) v < 0).
Proof. intros; now apply spans. Qed.

(** Every vertex of a part is on its side, or on the splitter; it is a vertex
    of the fragment, or lies on the splitter between two of them. *)
Lemma part_vertex : forall side f s v, valid f -> side <> kOn ->
  relation f s = rSpanning -> In v (vertices (part side f s)) ->
  0 <= value_at (toward side (plane s)) v /\ exists p q t,
  In (p, q) (round (vertices f)) /\ 0 <= t <= 1 /\ at_ t p q v /\
  (In v (vertices f) \/ value_at (toward side (plane s)) v == 0).
Proof.
  intros side f s v V N R I; rewrite part_corners_are in I by exact N.
  destruct (spanning_both side f s N R) as [A B].
  exact (part_corner (toward side (plane s)) (vertices f)
    (crossing_point (plane s)) (crossing_at side (plane s)) v I).
Qed.

Lemma part_keeps : forall side f s v, valid f -> side <> kOn ->
  relation f s = rSpanning -> In v (vertices f) ->
  0 < value_at (toward side (plane s)) v -> In v (vertices (part side f s)).
Proof.
  intros side f s v V N R I L; rewrite part_corners_are by exact N.
  now apply Convex.part_keeps.
Qed.

Lemma part_is_cut : forall side f s, valid f -> side <> kOn ->
  relation f s = rSpanning ->
  exists v, In v (vertices (part side f s)) /\ value_at (plane s) v == 0.
Proof.
  intros side f s V N R; rewrite part_corners_are by exact N.
  destruct (spanning_both side f s N R) as [A B].
  destruct (part_has_exit (toward side (plane s)) (vertices f) A B
    (crossing_point (plane s)) (crossing_at side (plane s)))
    as (x & X & (_ & _ & _ & _ & _ & _ & _ & _ & Z)).
  exists x; split; [exact X|].
  destruct side; simpl in Z; rewrite ?value_at_reversed in Z; lra.
Qed.

(** Every edge of a part is a share of an edge of the fragment or, within its
    plane, of the splitter. *)
Lemma part_edge : forall side f s a b, valid f -> side <> kOn ->
  relation f s = rSpanning -> In (a, b) (round (vertices (part side f s))) ->
  exists c e, 0 < c /\
  (In e (edges f) \/ e = toward side (plane s)) /\
  forall v, value_at (support f) v == 0 ->
  value_at (edge_plane (support f) a b) v == c * value_at e v.
Proof.
  intros side f s a b V N R I; rewrite part_corners_are in I by exact N.
  destruct (spanning_both side f s N R) as [A B].
  destruct (Convex.part_edge (support f) (toward side (plane s)) (vertices f)
    (valid_normal f V) V A B (crossing_point (plane s))
    (crossing_at side (plane s)) a b I) as (c & C & [(p & q & E & H) | H]).
  - exists c, (edge_plane (support f) p q); split; [exact C|]; split; [left|].
    + apply edges_are; exists p, q; auto.
    + intros v _; apply H.
  - exists c, (toward side (plane s)); auto.
Qed.

(** ** Scenes *)

(** A scene: planes and corners; the index is the id. *)
Definition Scene := list (Plane * list Point).

Definition scene_ok (scene : Scene) : Prop :=
  Forall (fun p => polygon_ok (fst p) (snd p)) scene.

Fixpoint polygons_from (id : Z) (scene : Scene) : list Fragment :=
  match scene with
  | [] => []
  | (plane, corners) :: rest =>
    whole id plane corners :: polygons_from (id + 1) rest
  end.

Definition polygons_of (scene : Scene) : list Fragment :=
  polygons_from 0 scene.

Lemma polygons_valid : forall scene, scene_ok scene ->
  Forall valid (polygons_of scene).
Proof.
  unfold polygons_of; generalize 0%Z; intros id scene O; revert id.
  induction O as [|[plane corners] scene P _ IH]; intros id; simpl; auto.
Qed.
