(** * S2.3: how often the boundary of a convex polygon passes a plane, and how
    many edges the parts have.

    The walk is that of [Split.v]; that one edge of a convex polygon leaves a
    side of the plane, and one comes back, is shown in [Convex.v]. *)

From Coq Require Import QArith Lqa Lia List Bool Permutation.
From Halfspace Require Import Base Convex.
From Halfspace Require Split.
Import ListNotations.
Open Scope Q_scope.

(** ** Edges that pass *)

(** An edge leaves the positive side: from its first corner, or inside. *)
Definition leaves (h : Plane) (e : Point * Point) : bool :=
  match side_of h (fst e), side_of h (snd e) with
  | kPositive, kNegative | kOn, kNegative => true
  | _, _ => false
  end.

(** An edge comes back to it. *)
Definition comes_back (h : Plane) (e : Point * Point) : bool :=
  match side_of h (fst e), side_of h (snd e) with
  | kNegative, kPositive | kOn, kPositive => true
  | _, _ => false
  end.

Definition count {A : Type} (test : A -> bool) (l : list A) : nat :=
  length (filter test l).

Lemma leaves_tells : forall h p q, leaves h (p, q) = true <->
  0 <= value_at h p /\ value_at h q < 0.
Proof.
  intros h p q; unfold leaves, side_of; simpl.
  destruct (sign_cases (value_at h p)) as [[A P] | [[A P] | [A P]]];
    destruct (sign_cases (value_at h q)) as [[B R] | [[B R] | [B R]]];
    rewrite A, ?B; split; intros H; try discriminate;
    lra || reflexivity || idtac.
Qed.

Lemma comes_back_tells : forall h p q, comes_back h (p, q) = true <->
  value_at h p <= 0 /\ 0 < value_at h q.
Proof.
  intros h p q; unfold comes_back, side_of; simpl.
  destruct (sign_cases (value_at h p)) as [[A P] | [[A P] | [A P]]];
    destruct (sign_cases (value_at h q)) as [[B R] | [[B R] | [B R]]];
    rewrite A, ?B; split; intros H; try discriminate;
    lra || reflexivity || idtac.
Qed.

(** Where no edge lies in the plane, a corner on it and an edge that crosses it
    are each one edge that leaves or comes back. *)
Lemma passages_along : forall h first l,
  (forall p q, In (p, q) (along (l ++ [first])) ->
     value_at h p == 0 -> value_at h q == 0 -> False) ->
  (Split.on_plane (map (side_of h) l) +
   Split.crossings_from (side_of h first) (map (side_of h) l) =
   count (leaves h) (along (l ++ [first])) +
   count (comes_back h) (along (l ++ [first])))%nat.
Proof.
  intros h first; induction l as [|p l IH]; intros Flat; [reflexivity|].
  assert (forall q rest, along ((p :: l) ++ [first]) = (p, q) :: rest ->
    (Split.on_plane [side_of h p] +
     (if Split.crosses (side_of h p) (side_of h q) then 1 else 0) =
     count (leaves h) [(p, q)] + count (comes_back h) [(p, q)])%nat) as One.
  { intros q rest E; rewrite E in Flat.
    specialize (Flat p q (or_introl eq_refl)).
    unfold count, leaves, comes_back, side_of; simpl.
    destruct (sign_cases (value_at h p)) as [[-> P] | [[-> P] | [-> P]]];
      destruct (sign_cases (value_at h q)) as [[-> R] | [[-> R] | [-> R]]];
      try reflexivity; destruct (Flat P R). }
  destruct l as [|q l].
  - specialize (One first [] eq_refl); unfold count, Split.on_plane in *.
    simpl in *; destruct (Split.crosses _ _); lia.
  - specialize (One q _ eq_refl).
    assert (forall a b, In (a, b) (along ((q :: l) ++ [first])) ->
            value_at h a == 0 -> value_at h b == 0 -> False) as Flat'.
    { intros a b I; apply Flat; now right. }
    specialize (IH Flat').
    change (along ((p :: q :: l) ++ [first])) with
      ([(p, q)] ++ along ((q :: l) ++ [first])).
    change (map (side_of h) (p :: q :: l)) with
      ([side_of h p] ++ map (side_of h) (q :: l)).
    change (Split.crossings_from (side_of h first)
      ([side_of h p] ++ map (side_of h) (q :: l))) with
      ((if Split.crosses (side_of h p) (side_of h q) then 1 else 0) +
       Split.crossings_from (side_of h first) (map (side_of h) (q :: l)))%nat.
    unfold count, Split.on_plane in *; rewrite !filter_app, !app_length; lia.
Qed.

Lemma count_one : forall (A : Type) (test : A -> bool) l, NoDup l ->
  (exists a, In a l /\ test a = true) ->
  (forall a b, In a l -> In b l -> test a = true -> test b = true -> a = b) ->
  count test l = 1%nat.
Proof.
  intros A test l D (a & I & T) U; unfold count.
  assert (forall b, In b (filter test l) <-> b = a) as F.
  { intros b; rewrite filter_In; split; [|intros ->; auto].
    intros [J T']; now apply U. }
  assert (NoDup (filter test l)) as D' by now apply NoDup_filter.
  destruct (filter test l) as [|b [|c m]]; [|reflexivity|].
  - destruct (proj2 (F a) eq_refl).
  - assert (b = a) by (apply F; simpl; auto).
    assert (c = a) by (apply F; simpl; auto); subst b c.
    inversion D' as [|? ? N _]; destruct N; now left.
Qed.

(** Whether an edge is the splitter's. *)
Definition named (splitter : Z) (name : Split.EdgeName) : bool :=
  match name with
  | Split.kSplitter polygon => Z.eqb polygon splitter
  | Split.kSource _ => false
  end.

(** The cut comes to the positive part where the boundary leaves, and to the
    negative part where it comes back. *)
Lemma cuts_along : forall h first l k,
  let walk := Split.walk_from (side_of h first) k (map (side_of h) l) in
  count Split.cut (filter (fun s => side_eqb (Split.part s) kPositive) walk) =
  count (leaves h) (along (l ++ [first])) /\
  count Split.cut (filter (fun s => side_eqb (Split.part s) kNegative) walk) =
  count (comes_back h) (along (l ++ [first])).
Proof.
  intros h first; induction l as [|p l IH]; intros k; [split; reflexivity|].
  assert (forall q,
    count Split.cut (filter (fun s => side_eqb (Split.part s) kPositive)
      (Split.step k (side_of h p) (side_of h q))) = count (leaves h) [(p, q)] /\
    count Split.cut (filter (fun s => side_eqb (Split.part s) kNegative)
      (Split.step k (side_of h p) (side_of h q))) =
    count (comes_back h) [(p, q)]) as One.
  { intros q; unfold count, leaves, comes_back; simpl.
    destruct (side_of h p), (side_of h q); split; reflexivity. }
  destruct l as [|q l]; [exact (One first)|].
  destruct (One q) as [A B], (IH (S k)) as [A' B'].
  change (along ((p :: q :: l) ++ [first])) with
    ([(p, q)] ++ along ((q :: l) ++ [first])).
  change (Split.walk_from (side_of h first) k (map (side_of h) (p :: q :: l)))
    with (Split.step k (side_of h p) (side_of h q) ++
          Split.walk_from (side_of h first) (S k) (map (side_of h) (q :: l))).
  unfold count in *; rewrite !filter_app, !app_length.
  rewrite <- A, <- B, <- A', <- B'; split; reflexivity.
Qed.

(** ** A polygon that spans a plane *)

Section Parts.

Variables (plane h : Plane) (f : Split.Fragment).
Hypothesis plane_ok : not_zero plane.
Hypothesis ok : polygon_ok plane (Split.vertices f).
Hypothesis spanning : Split.relation f h = rSpanning.

Local Notation corners := (Split.vertices f).

Lemma rounds_apart : NoDup (round corners).
Proof.
  apply NoDup_map_inv with (f := fst); rewrite round_starts.
  exact (visits_once_distinct _ (ok_once _ _ ok)).
Qed.

Lemma flat_edges : forall p q, In (p, q) (round corners) ->
  value_at h p == 0 -> value_at h q == 0 -> False.
Proof.
  destruct (spans h f spanning kPositive) as [A B]; [discriminate|].
  exact (no_edge_in_plane plane h corners plane_ok ok A B).
Qed.

Theorem leaves_once : count (leaves h) (round corners) = 1%nat.
Proof.
  destruct (spans h f spanning kPositive) as [A B]; [discriminate|].
  pose proof (crossing_at kPositive h) as M; simpl in A, B, M.
  apply count_one; [exact rounds_apart | |].
  - destruct (part_has_exit h corners A B (crossing_point h) M)
      as (_ & _ & r & s & _ & E & R & S & _).
    exists (r, s); split; [exact E | now apply leaves_tells].
  - intros (r, s) (r', s') E E' L L'.
    apply leaves_tells in L, L'; destruct L, L'.
    now apply (one_exit_edge plane h corners plane_ok ok A B
                 (crossing_point h) M).
Qed.

Theorem comes_back_once : count (comes_back h) (round corners) = 1%nat.
Proof.
  destruct (spans h f spanning kPositive) as [A B]; [discriminate|].
  pose proof (crossing_at kPositive h) as M; simpl in A, B, M.
  apply count_one; [exact rounds_apart | |].
  - destruct (part_has_entry h corners A B (crossing_point h) M)
      as (_ & _ & r & s & _ & E & R & S & _).
    exists (r, s); split; [exact E | now apply comes_back_tells].
  - intros (r, s) (r', s') E E' L L'.
    apply comes_back_tells in L, L'; destruct L, L'.
    now apply (one_entry_edge plane h corners plane_ok ok A B
                 (crossing_point h) M).
Qed.

(** The boundary passes the plane exactly twice, at corners or inside edges. *)
Theorem passes_twice :
  (Split.on_plane (Split.sides_of f h) +
   Split.crossings (Split.sides_of f h) = 2)%nat.
Proof.
  pose proof leaves_once as L; pose proof comes_back_once as C.
  pose proof flat_edges as Flat.
  unfold Split.sides_of, Split.crossings, round in *.
  destruct corners as [|p l]; [discriminate|].
  pose proof (passages_along h p (p :: l) Flat) as P; simpl map in *; lia.
Qed.

(** Nothing is put on the plane's own side. *)
Lemma walk_has_sides : forall s, In s (Split.walk (Split.sides_of f h)) ->
  Split.part s <> kOn.
Proof.
  intros s I; destruct (Split.walk_tells _ s I) as (here & there & A & B & C).
  unfold Split.sides_of in B at 2; rewrite map_length in B.
  assert (~ (here = kOn /\ there = kOn)) as N.
  { intros [-> ->].
    destruct (Split.sides_nth f h _ _ A) as [_ P].
    destruct (Split.sides_nth f h _ _ B) as [_ R].
    apply sign_on in P, R; revert P R; apply flat_edges.
    set (k := Split.at_ s) in *.
    unfold Split.sides_of in A; rewrite nth_error_map in A.
    assert (k < length corners)%nat as L.
    { apply nth_error_Some; intros E; rewrite E in A; discriminate. }
    clear - L; revert L; unfold Split.next, round.
    destruct corners as [|x l]; [simpl; lia|].
    intros L; set (m := x :: l) in *.
    assert (forall m k, (k < length m)%nat ->
      In (nth k m Split.origin,
          if S k =? length m then x else nth (S k) m Split.origin)%nat
         (along (m ++ [x]))) as K.
    { clear; induction m as [|a [|b m] IH]; intros k L; simpl in L; [lia| |].
      - assert (k = 0)%nat as -> by lia; now left.
      - destruct k as [|k]; [now left|]; right.
        specialize (IH k); simpl length in IH.
        exact (IH ltac:(lia)). }
    specialize (K m k L); destruct (S k =? length m)%nat; exact K. }
  revert C; destruct here, there; simpl; intros C;
    repeat (destruct C as [<- | C]; [simpl; discriminate|]); try destruct C.
  - destruct N; auto.
  - destruct N; auto.
Qed.

(** S2.L2: n + 4 - k edges, k of the corners being on the plane, and k is at
    most 2. *)
Theorem parts_have_n_plus_4_minus_k_edges : forall splitter,
  let k := Split.on_plane (Split.sides_of f h) in
  (k <= 2)%nat /\
  (length (Split.edges (fst (Split.split f h splitter))) +
   length (Split.edges (snd (Split.split f h splitter))) =
   length corners + 4 - k)%nat.
Proof.
  intros splitter k; pose proof passes_twice as P; fold k in P.
  split; [lia|].
  pose proof (Split.parts_share_the_walk f h splitter walk_has_sides) as S.
  simpl in *; rewrite S, Split.edges_of_both_parts by exact P.
  unfold Split.sides_of; rewrite map_length; reflexivity.
Qed.

(** S2.L7: a part gets one new edge, named for the splitter. *)
Theorem one_new_edge : forall side splitter, side <> kOn ->
  length (Split.edges f) = length corners ->
  (forall e, In e (Split.edges f) -> e <> Split.kSplitter splitter) ->
  count (named splitter) (Split.edges (Split.part_of side f h splitter)) =
  1%nat.
Proof.
  intros side splitter N L Fresh; unfold Split.part_of; simpl.
  set (steps := filter (fun s => side_eqb (Split.part s) side)
                  (Split.walk (Split.sides_of f h))).
  assert (forall s, In s steps -> named splitter (Split.edge_of f splitter s) =
          Split.cut s) as E.
  { intros s I; apply filter_In in I; destruct I as [I _].
    destruct (Split.walk_tells _ s I) as (here & there & A & _ & _).
    unfold Split.edge_of; destruct (Split.cut s).
    - simpl; apply Z.eqb_refl.
    - assert (Split.at_ s < length (Split.edges f))%nat as K.
      { rewrite L; unfold Split.sides_of in A; rewrite nth_error_map in A.
        apply nth_error_Some; intros O; rewrite O in A; discriminate. }
      specialize (Fresh _ (nth_In _ (Split.kSplitter splitter) K)).
      destruct (nth (Split.at_ s) (Split.edges f) (Split.kSplitter splitter));
        simpl; [reflexivity|].
      apply Z.eqb_neq; intros ->; now apply Fresh. }
  assert (count (named splitter) (map (Split.edge_of f splitter) steps) =
          count Split.cut steps) as ->.
  { unfold count; revert E; generalize steps; clear.
    induction steps as [|s l IH]; intros E; simpl; [reflexivity|].
    rewrite (E s (or_introl eq_refl)).
    specialize (IH (fun t I => E t (or_intror I))).
    destruct (Split.cut s); simpl; now rewrite IH. }
  unfold steps, Split.walk, Split.sides_of; clear E steps.
  pose proof leaves_once as P; pose proof comes_back_once as Q.
  unfold round in P, Q; destruct corners as [|p l]; [discriminate|].
  destruct (cuts_along h p (p :: l) 0) as [X Y]; simpl map in *.
  destruct side; [rewrite Y; exact Q | easy | rewrite X; exact P].
Qed.

(** S2.2: a part has as many corners as edges. *)
Theorem a_corner_for_every_edge : forall side splitter,
  length (Split.vertices (Split.part_of side f h splitter)) =
  length (Split.edges (Split.part_of side f h splitter)).
Proof. intros; simpl; now rewrite !map_length. Qed.

End Parts.
