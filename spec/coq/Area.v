(** * S2.L4: the vector areas of the parts add up to the polygon's.

    Seen from a point of the cut, the cut adds nothing; what every edge of the
    polygon adds is divided between the parts. From wherever it is seen, the sum
    round a polygon is the same. *)

From Coq Require Import QArith Lqa Lia List Bool Permutation.
From Halfspace Require Import Base Convex Tree Scene Image.
From Halfspace Require Split.
Import ListNotations.
Open Scope Q_scope.

(** ** Vector area *)

Definition sum (l : list Q) : Q := fold_right Qplus 0 l.

(** Twice the area of a polygon as seen along the normal of [k]. *)
Definition double_area (k : Plane) (corners : list Point) : Q :=
  sum (map (fun e => area k (fst e) (snd e) Split.origin) (round corners)).

Definition axis (x y z : Q) : Plane :=
  {| pa := x; pb := y; pc := z; pd := 0 |}.

(** Twice the vector area: the sum of [p x q] over the edges from [p] to [q]. *)
Definition vector_area (corners : list Point) : Point :=
  {| px := sum (map (fun e => px (cross (fst e) (snd e))) (round corners));
     py := sum (map (fun e => py (cross (fst e) (snd e))) (round corners));
     pz := sum (map (fun e => pz (cross (fst e) (snd e))) (round corners)) |}.

Definition sum_of (p q : Point) : Point :=
  {| px := px p + px q; py := py p + py q; pz := pz p + pz q |}.

Lemma sum_app : forall l m, sum (l ++ m) == sum l + sum m.
Proof.
  induction l as [|q l IH]; intros m; simpl; [ring|]; rewrite IH; ring.
Qed.

Lemma sum_ext : forall (A : Type) (f g : A -> Q) l,
  (forall a, In a l -> f a == g a) -> sum (map f l) == sum (map g l).
Proof.
  intros A f g l; induction l as [|a l IH]; intros H; simpl; [reflexivity|].
  rewrite (H a (or_introl eq_refl)), IH by (intros b B; apply H; now right).
  reflexivity.
Qed.

Lemma sum_both : forall (A : Type) (f g : A -> Q) l,
  sum (map f l) + sum (map g l) == sum (map (fun a => f a + g a) l).
Proof.
  intros A f g l; induction l as [|a l IH]; simpl; [ring|].
  rewrite <- IH; ring.
Qed.

(** What the edges add does not depend on where they are seen from. *)
Lemma seen_from : forall k o l p z,
  sum (map (fun e => area k (fst e) (snd e) o) (along (p :: l ++ [z]))) ==
  dot (cross (normal k) (difference z p)) o +
  sum (map (fun e => area k (fst e) (snd e) Split.origin)
         (along (p :: l ++ [z]))).
Proof.
  intros k o; induction l as [|q l IH]; intros p z.
  - simpl; expand; ring.
  - change (along (p :: (q :: l) ++ [z])) with
      ((p, q) :: along (q :: l ++ [z])).
    cbn [map fst snd]; unfold sum at 1 2; cbn [fold_right]; fold (sum
      (map (fun e => area k (fst e) (snd e) o) (along (q :: l ++ [z]))));
      fold (sum (map (fun e => area k (fst e) (snd e) Split.origin)
                   (along (q :: l ++ [z])))).
    rewrite IH; generalize (sum (map (fun e => area k (fst e) (snd e)
      Split.origin) (along (q :: l ++ [z])))); intros rest; expand; ring.
Qed.

Lemma seen_from_anywhere : forall k o corners,
  sum (map (fun e => area k (fst e) (snd e) o) (round corners)) ==
  double_area k corners.
Proof.
  intros k o [|p l]; [reflexivity|]; unfold double_area, round.
  change ((p :: l) ++ [p]) with (p :: l ++ [p]); rewrite seen_from.
  expand; ring.
Qed.

(** Nor on the corner that one begins with. *)
Lemma round_rotated : forall p l q m, round ((p :: l) ++ q :: m) =
  along (p :: l ++ [q]) ++ along (q :: m ++ [p]).
Proof.
  intros p l q m.
  change (round ((p :: l) ++ q :: m)) with
    (along (((p :: l) ++ q :: m) ++ [p])).
  rewrite <- app_assoc; apply (along_app (p :: l) q (m ++ [p])).
Qed.

Lemma sum_permuted : forall l m, Permutation l m -> sum l == sum m.
Proof.
  intros l m P; induction P; simpl; [reflexivity | rewrite IHP; reflexivity |
    ring | now rewrite IHP1].
Qed.

Lemma sum_rotated : forall (w : Point * Point -> Q) l m,
  sum (map w (round (l ++ m))) == sum (map w (round (m ++ l))).
Proof.
  intros w [|p l] [|q m]; try (rewrite app_nil_r; reflexivity).
  rewrite !round_rotated.
  apply sum_permuted, Permutation_map, Permutation_app_comm.
Qed.

(** ** The positive part *)

Lemma last_of : forall (A : Type) (l : list A) x d, last (x :: l) d = last l x.
Proof.
  intros A; induction l as [|y l IH]; intros x d; [reflexivity|].
  change (last (x :: y :: l) d) with (last (y :: l) d); now rewrite !IH.
Qed.

Lemma last_app : forall (A : Type) (l m : list A) d,
  last (l ++ m) d = last m (last l d).
Proof.
  intros A; induction l as [|x l IH]; intros m d; [reflexivity|].
  simpl app; now rewrite !last_of.
Qed.

Section Cut.

Variables (plane h k : Plane) (corners : list Point) (o : Point).
Hypothesis plane_ok : not_zero plane.
Hypothesis planar : forall v, In v corners -> value_at plane v == 0.
Hypothesis some_above : exists v, In v corners /\ 0 < value_at h v.
Hypothesis flat : forall p q, In (p, q) (round corners) ->
  value_at h p == 0 -> value_at h q == 0 -> False.
Hypothesis o_planar : value_at plane o == 0.
Hypothesis o_on : value_at h o == 0.
Variable meet : Point -> Point -> Point.
Hypothesis meet_at : forall p q,
  0 < value_at h p /\ value_at h q < 0 \/
  value_at h p < 0 /\ 0 < value_at h q ->
  exists t, 0 < t < 1 /\ at_ t p q (meet p q) /\ value_at h (meet p q) == 0.

Local Notation g := (value_at h).
Local Notation edge p q := (In (p, q) (round corners)).

(** What the edge from [p] to [q] adds, as seen from [o]. *)
Definition adds (e : Point * Point) : Q := area k (fst e) (snd e) o.

(** A point of the line in which the two planes meet. *)
Definition on_cut (v : Point) : Prop := value_at plane v == 0 /\ g v == 0.

Lemma cut_adds_nothing : forall a b, on_cut a -> on_cut b -> adds (a, b) == 0.
Proof.
  intros a b [A Ga] [B Gb]; unfold adds; simpl.
  destruct some_above as (u & U & Gu).
  pose proof (four_points plane h a b o u plane_ok A B o_planar (planar u U))
    as F; rewrite Ga, Gb, o_on in F.
  assert (area plane a b o == 0) as Z.
  { assert (area plane a b o * g u == 0) as E by lra.
    apply Qmult_integral in E; destruct E; [assumption | lra]. }
  pose proof (not_zero_square plane plane_ok) as S.
  assert (area k a b o * dot (normal plane) (normal plane) ==
    dot (normal k) (normal plane) * area plane a b o +
    (value_at plane b - value_at plane a) *
    (dot (normal plane) (cross (difference o a) (normal k))) +
    (value_at plane o - value_at plane a) *
    (dot (normal plane) (cross (normal k) (difference b a)))) as E.
  { expand; ring. }
  rewrite Z, A, B, o_planar in E.
  assert (area k a b o * dot (normal plane) (normal plane) == 0) as E' by lra.
  apply Qmult_integral in E'; destruct E'; [assumption | lra].
Qed.

(** The positive side's share of what an edge adds. *)
Definition share (e : Point * Point) : Q :=
  let (p, q) := e in
  match side_of h p, side_of h q with
  | kPositive, kNegative => adds (p, meet p q)
  | kNegative, kPositive => adds (meet p q, q)
  | kNegative, _ | _, kNegative => 0
  | _, _ => adds (p, q)
  end.

(** What the corner [a], last put, and the vertex [p] that the walk has come to
    will add. *)
Definition pending (a p : Point) : Q :=
  match side_of h p with kNegative => 0 | _ => adds (a, p) end.

Definition waits (a p : Point) : Prop := g p < 0 -> on_cut a.

Lemma meet_on_cut : forall p q, edge p q ->
  0 < g p /\ g q < 0 \/ g p < 0 /\ 0 < g q -> on_cut (meet p q).
Proof.
  intros p q E S; destruct (meet_at p q S) as (t & T & A & Z); split; auto.
  destruct (round_ends _ _ _ E) as [P Q].
  rewrite (at_value t p q _ plane A), (planar p P), (planar q Q); ring.
Qed.

Lemma put_more : forall puts rest a,
  sum (map adds (along (a :: puts ++ rest))) ==
  sum (map adds (along (a :: puts))) +
  sum (map adds (along (last puts a :: rest))).
Proof.
  induction puts as [|b puts IH]; intros rest a; [simpl; ring|].
  rewrite last_of.
  change (sum (map adds (along (a :: (b :: puts) ++ rest)))) with
    (adds (a, b) + sum (map adds (along (b :: puts ++ rest)))).
  change (sum (map adds (along (a :: b :: puts)))) with
    (adds (a, b) + sum (map adds (along (b :: puts)))).
  rewrite IH; ring.
Qed.

(** Along the walk, what has been put and what is pending is what the edges had
    to give. *)
Lemma walk_adds : forall l p a, incl (along (p :: l)) (round corners) ->
  waits a p -> exists b, b = last (flat_map (emit h meet) (along (p :: l))) a /\
  waits b (last l p) /\
  sum (map adds (along (a :: flat_map (emit h meet) (along (p :: l))))) +
  pending b (last l p) ==
  pending a p + sum (map share (along (p :: l))).
Proof.
  induction l as [|q l IH]; intros p a I W.
  - exists a; split; [reflexivity | split; [exact W|]].
    unfold sum; cbn [along flat_map map fold_right last].
    generalize (pending a p); intros; ring.
  - assert (edge p q) as E by (apply I; now left).
    assert (incl (along (q :: l)) (round corners)) as I'.
    { intros e J; apply I; now right. }
    destruct (round_ends _ _ _ E) as [Ip Iq].
    change (along (p :: q :: l)) with ((p, q) :: along (q :: l)).
    change (flat_map (emit h meet) ((p, q) :: along (q :: l)))
      with (emit h meet (p, q) ++ flat_map (emit h meet) (along (q :: l))).
    rewrite (last_of _ l q p).
    assert (waits (last (emit h meet (p, q)) a) q /\
      sum (map adds (along (a :: emit h meet (p, q)))) +
      pending (last (emit h meet (p, q)) a) q ==
      pending a p + share (p, q)) as [Wb S].
    { pose proof (meet_on_cut p q E) as M.
      unfold emit, share, pending, waits, side_of in *.
      destruct (sign_cases (g p)) as [[Sp P] | [[Sp P] | [Sp P]]];
        destruct (sign_cases (g q)) as [[Sq R] | [[Sq R] | [Sq R]]];
        rewrite ?Sp, ?Sq; unfold sum; simpl; split; try lra; auto.
      - rewrite cut_adds_nothing; [ring | auto |].
        split; [now apply planar | exact R].
      - rewrite cut_adds_nothing; [ring | auto | apply M; auto].
      - intros _; split; [now apply planar | exact P].
      - destruct (flat p q E P R). }
    destruct (IH q (last (emit h meet (p, q)) a) I' Wb) as (b & B & Wc & T).
    exists b; split; [|split; [exact Wc|]].
    + now rewrite last_app.
    + rewrite put_more.
      change (sum (map share ((p, q) :: along (q :: l)))) with
        (share (p, q) + sum (map share (along (q :: l)))).
      lra.
Qed.

(** Round the polygon, from a corner on the positive side on. *)
Lemma part_adds_from : forall u l, 0 < g u ->
  incl (round (u :: l)) (round corners) ->
  sum (map adds (round (flat_map (emit h meet) (round (u :: l))))) ==
  sum (map share (round (u :: l))).
Proof.
  intros u l U I.
  assert (side_of h u = kPositive) as Su by now apply sign_positive.
  assert (adds (u, u) == 0) as Zero by (unfold adds; expand; ring).
  destruct (walk_adds (l ++ [u]) u u I) as (b & B & _ & S).
  { intros N; exfalso; lra. }
  change (along (u :: l ++ [u])) with (round (u :: l)) in B, S.
  assert (exists rest, flat_map (emit h meet) (round (u :: l)) = u :: rest)
    as (rest & F).
  { assert (exists x more, round (u :: l) = (u, x) :: more) as (x & more & ->)
      by (destruct l; eexists; eexists; reflexivity).
    simpl; rewrite Su; destruct (side_of h x); eexists; reflexivity. }
  rewrite F in *; rewrite last_of in B; subst b.
  replace (last (l ++ [u]) u) with u in S by now rewrite last_app.
  unfold pending in S; rewrite Su, Zero in S.
  change (round (u :: rest)) with (along (u :: rest ++ [u])).
  rewrite put_more.
  change (sum (map adds (along (u :: u :: rest)))) with
    (adds (u, u) + sum (map adds (along (u :: rest)))) in S.
  change (sum (map adds (along [last rest u; u]))) with
    (adds (last rest u, u) + 0).
  rewrite Zero in S; lra.
Qed.

(** What the part adds is its side's share. *)
Lemma part_adds : double_area k (part_corners h corners meet) ==
  sum (map share (round corners)).
Proof.
  rewrite <- (seen_from_anywhere k o).
  change (fun e => area k (fst e) (snd e) o) with adds.
  destruct some_above as (u & U & Gu); apply in_split in U.
  destruct U as (l & m & C); unfold part_corners.
  destruct l as [|p l].
  - simpl in C; pose proof (part_adds_from u m Gu) as P; rewrite <- C in P.
    apply P, incl_refl.
  - pose proof (round_rotated p l u m) as R; rewrite <- C in R.
    pose proof (round_rotated u m p l) as R'.
    pose proof (part_adds_from u (m ++ p :: l) Gu) as P.
    change (u :: m ++ p :: l) with ((u :: m) ++ p :: l) in P; rewrite R' in P.
    rewrite R in *; rewrite flat_map_app in *; rewrite sum_rotated, P.
    + apply sum_permuted, Permutation_map, Permutation_app_comm.
    + intros e J; apply in_or_app; apply in_app_or in J; tauto.
Qed.

End Cut.

(** ** Both parts *)

Section Parts.

Variables (plane h : Plane) (f : Split.Fragment).
Hypothesis plane_ok : not_zero plane.
Hypothesis ok : polygon_ok plane (Split.vertices f).
Hypothesis spanning : Split.relation f h = rSpanning.

Local Notation corners := (Split.vertices f).

Theorem double_areas_add_up : forall splitter k,
  double_area k corners ==
  double_area k (Split.vertices (fst (Split.split f h splitter))) +
  double_area k (Split.vertices (snd (Split.split f h splitter))).
Proof.
  intros splitter k; unfold Split.split, fst, snd.
  rewrite !walk_emits by discriminate; unfold corners_of.
  destruct (spans h f spanning kPositive) as [A B]; [discriminate|].
  destruct (spans h f spanning kNegative) as [A' B']; [discriminate|].
  pose proof (crossing_at kPositive h) as M.
  pose proof (crossing_at kNegative h) as M'.
  simpl toward in *.
  pose proof (no_edge_in_plane plane h corners plane_ok ok A B) as Flat.
  destruct (part_has_exit h corners A B (crossing_point h) M)
    as (o & _ & X).
  destruct (exit_is_in plane h corners ok o X) as (Po & Zo & _).
  assert (value_at (reversed h) o == 0) as Zo'
    by (rewrite value_at_reversed, Zo; reflexivity).
  assert (forall p q, In (p, q) (round corners) -> value_at (reversed h) p == 0
    -> value_at (reversed h) q == 0 -> False) as Flat'.
  { intros p q E P Q; rewrite value_at_reversed in P, Q.
    apply (Flat p q E); lra. }
  rewrite (part_adds plane h k corners o plane_ok (ok_planar _ _ ok) A Flat Po
    Zo _ M).
  rewrite (part_adds plane (reversed h) k corners o plane_ok (ok_planar _ _ ok)
    A' Flat' Po Zo' _ M').
  rewrite sum_both, <- (seen_from_anywhere k o).
  apply sum_ext; intros (p, q) E; specialize (Flat p q E).
  assert (forall v, side_of (reversed h) v = opposite (side_of h v)) as S
    by (intros; apply side_of_reversed).
  assert (0 < value_at h p /\ value_at h q < 0 \/
          value_at h p < 0 /\ 0 < value_at h q ->
          area k p q o == area k p (crossing_point h p q) o +
                          area k (crossing_point h p q) q o) as Cut.
  { intros T; destruct (M p q T) as (t & _ & At & _).
    rewrite (at_area k p q 0 t p _ (at_start p q) At),
      (at_area k p q t 1 _ q At (at_end p q)); ring. }
  unfold share, adds; rewrite !S; cbn [fst snd].
  unfold side_of.
  destruct (sign_cases (value_at h p)) as [[-> P] | [[-> P] | [-> P]]];
    destruct (sign_cases (value_at h q)) as [[-> Q] | [[-> Q] | [-> Q]]];
    cbn [opposite]; try ring.
  - rewrite Cut by auto; ring.
  - destruct (Flat P Q).
  - rewrite Cut by auto; ring.
Qed.

(** S2.L4. *)
Theorem vector_areas_add_up : forall splitter,
  same (vector_area corners)
    (sum_of (vector_area (Split.vertices (fst (Split.split f h splitter))))
       (vector_area (Split.vertices (snd (Split.split f h splitter))))).
Proof.
  intros splitter; pose proof (double_areas_add_up splitter) as D.
  assert (forall l, px (vector_area l) == double_area (axis 1 0 0) l /\
    py (vector_area l) == double_area (axis 0 1 0) l /\
    pz (vector_area l) == double_area (axis 0 0 1) l) as V.
  { intros l; unfold vector_area, double_area; simpl.
    repeat split; apply sum_ext; intros (p, q) _; unfold Split.origin; expand;
      ring. }
  unfold same, sum_of; cbn [px py pz].
  rewrite !(proj1 (V _)), !(proj1 (proj2 (V _))), !(proj2 (proj2 (V _))).
  auto.
Qed.

End Parts.

(** ** Trees *)

(** S3.L1: what a fragment has of the area of polygon [id], as seen along the
    normal of [k]. *)
Definition area_of (id : Z) (k : Plane) (f : Fragment) : Q :=
  if (source f =? id)%Z then double_area k (vertices f) else 0.

Lemma split_area : forall id k f s, valid f -> relation f s = rSpanning ->
  area_of id k f ==
  area_of id k (fst (split f s)) + area_of id k (snd (split f s)).
Proof.
  intros id k f s V R; unfold area_of.
  change (source (fst (split f s))) with (source f).
  change (source (snd (split f s))) with (source f).
  destruct (source f =? id)%Z; [|ring].
  exact (double_areas_add_up (support f) (plane s) (shape f) (valid_normal f V)
           V R (splitter s) k).
Qed.

(** S3.5: the fragments of a polygon in a built tree have its area. *)
Theorem built_tree_has_the_areas : forall choose_root scene id k,
  scene_ok scene ->
  total Fragment (area_of id k)
    (fragments (build_scene choose_root scene)) ==
  total Fragment (area_of id k) (polygons_of scene).
Proof.
  intros choose_root scene id k O; unfold build_scene.
  apply (build_total Fragment Splitter source splitter_of relation split
    choose_root valid own_plane split_valid (area_of id k)).
  - intros f s V R; exact (split_area id k f s V R).
  - now apply polygons_valid.
Qed.

(** S3.6: so have those in a tree made by insertion, in any order. *)
Theorem inserted_tree_has_the_areas : forall scene polygons id k,
  scene_ok scene -> Permutation polygons (polygons_of scene) ->
  total Fragment (area_of id k)
    (fragments (insert_scene polygons)) ==
  total Fragment (area_of id k) (polygons_of scene).
Proof.
  intros scene polygons id k O P; unfold insert_scene.
  rewrite (insert_all_total Fragment Splitter source splitter_of relation split
    valid split_valid (area_of id k)).
  - assert (forall l m, Permutation l m -> total Fragment (area_of id k) l ==
            total Fragment (area_of id k) m) as Q.
    { unfold total; generalize (area_of id k); intros w l m H.
      induction H; cbn [fold_right]; [reflexivity | rewrite IHPermutation;
        reflexivity | ring | now rewrite IHPermutation1]. }
    rewrite (Q _ _ P); cbn [fragments]; generalize (polygons_of scene).
    intros l; change (total Fragment (area_of id k) []) with 0; ring.
  - intros f s V R; exact (split_area id k f s V R).
  - apply Forall_forall; intros f F.
    pose proof (polygons_valid scene O) as V; rewrite Forall_forall in V.
    apply V; now apply (Permutation_in f P).
Qed.
