(** S2: a polygon against a plane, and what the plane makes of it.

    The programs are [relation] of ref/src/predicate.cpp and [split] of
    ref/src/split.cpp; the walk round the boundary is that of
    fast/src/tree/split_walk.hpp. *)

From Coq Require Import QArith Qfield Lqa List Arith Lia.
From Halfspace Require Import Base.
Import ListNotations.
Open Scope list_scope.

(** * Definitions *)

(** S2.2: an edge of a fragment, by name. *)
Inductive EdgeName := kSource (corner : Z) | kSplitter (polygon : Z).

(** S2.2: edge [k] leaves vertex [k]. *)
Record Fragment := { source : Z; edges : list EdgeName; vertices : list Point }.

Definition is_side (side : Side) (s : Side) : bool := side_eqb side s.

(** S2.1, by the sides of the vertices. *)
Definition relation_of (sides : list Side) : Relation :=
  let some_positive := existsb (is_side kPositive) sides in
  let some_negative := existsb (is_side kNegative) sides in
  if some_positive && some_negative then rSpanning
  else if some_positive then rPositive
  else if some_negative then rNegative
  else rCoincident.

Definition sides_of (fragment : Fragment) (plane : Plane) : list Side :=
  map (side_of plane) (vertices fragment).

Definition relation (fragment : Fragment) (plane : Plane) : Relation :=
  relation_of (sides_of fragment plane).

(** S2.3, step 2: what the walk puts into a part. The corner is vertex [at_]
    or, if [crossing], the point in which edge [at_] passes through the plane;
    the edge that leaves it is edge [at_] or, if [cut], the plane's. *)
Record Put := { part : Side; at_ : nat; crossing : bool; cut : bool }.

Definition put (part : Side) (k : nat) (crossing cut : bool) : Put :=
  {| part := part; at_ := k; crossing := crossing; cut := cut |}.

(** One edge: from a vertex on the side [here] to one on the side [there]. *)
Definition step (k : nat) (here there : Side) : list Put :=
  match here with
  | kOn => [put (opposite there) k false true; put there k false false]
  | _ =>
    put here k false false ::
    if side_eqb there (opposite here)
    then [put here k true true; put there k true false]
    else []
  end.

(** The rest of the walk, [first] being the side at which it began. *)
Fixpoint walk_from (first : Side) (k : nat) (sides : list Side) : list Put :=
  match sides with
  | [] => []
  | [here] => step k here first
  | here :: (there :: _) as rest =>
    step k here there ++ walk_from first (S k) rest
  end.

Definition walk (sides : list Side) : list Put :=
  match sides with [] => [] | first :: _ => walk_from first 0 sides end.

(** The point in which the line through [p] and [q] meets a plane on which [h]
    takes the values [hp] and [hq] there. *)
Definition meet (p : Point) (hp : Q) (q : Point) (hq : Q) : Point :=
  let t := hp / (hp - hq) in
  {| px := px p + (px q - px p) * t; py := py p + (py q - py p) * t;
     pz := pz p + (pz q - pz p) * t |}.

Definition origin : Point := {| px := 0; py := 0; pz := 0 |}.

Definition next (count k : nat) : nat := if S k =? count then O else S k.

Definition corner_of (fragment : Fragment) (plane : Plane) (step : Put)
    : Point :=
  let at_vertex k := nth k (vertices fragment) origin in
  let p := at_vertex (at_ step) in
  let q := at_vertex (next (length (vertices fragment)) (at_ step)) in
  if crossing step then meet p (value_at plane p) q (value_at plane q) else p.

Definition edge_of (fragment : Fragment) (splitter : Z) (step : Put)
    : EdgeName :=
  if cut step then kSplitter splitter
  else nth (at_ step) (edges fragment) (kSplitter splitter).

(** The part of a side. *)
Definition part_of (side : Side) (fragment : Fragment) (plane : Plane)
    (splitter : Z) : Fragment :=
  let steps := filter (fun s => side_eqb (part s) side)
                      (walk (sides_of fragment plane)) in
  {| source := source fragment;
     edges := map (edge_of fragment splitter) steps;
     vertices := map (corner_of fragment plane) steps |}.

(** S2.3. *)
Definition split (fragment : Fragment) (plane : Plane) (splitter : Z)
    : Fragment * Fragment :=
  (part_of kPositive fragment plane splitter,
   part_of kNegative fragment plane splitter).

(** * S2.1: the relation *)

Lemma some_side : forall side sides,
  existsb (is_side side) sides = true <-> In side sides.
Proof.
  intros side sides. rewrite existsb_exists. unfold is_side. split.
  - intros [s [I E]]. apply side_eqb_eq in E. now subst s.
  - intro I. exists side. split; [ exact I | now apply side_eqb_eq ].
Qed.

Lemma no_side : forall side sides,
  existsb (is_side side) sides = false <-> ~ In side sides.
Proof.
  intros. rewrite <- some_side. destruct (existsb _ _); split; congruence.
Qed.

(** The rows of S2.1's table; the first column decides the second, and each
    list of sides is in one row. *)
Theorem relation_is_the_table : forall sides,
  (relation_of sides = rPositive <->
   ~ In kNegative sides /\ In kPositive sides) /\
  (relation_of sides = rNegative <->
   ~ In kPositive sides /\ In kNegative sides) /\
  (relation_of sides = rCoincident <-> forall s, In s sides -> s = kOn) /\
  (relation_of sides = rSpanning <-> In kPositive sides /\ In kNegative sides).
Proof.
  intro sides. unfold relation_of.
  destruct (existsb (is_side kPositive) sides) eqn:P;
    destruct (existsb (is_side kNegative) sides) eqn:N; cbn;
    rewrite ?some_side, ?no_side in P; rewrite ?some_side, ?no_side in N.
  - repeat split; try congruence; try tauto.
    intro A. specialize (A _ P). discriminate.
  - repeat split; try congruence; try tauto.
    intro A. specialize (A _ P). discriminate.
  - repeat split; try congruence; try tauto.
    intro A. specialize (A _ N). discriminate.
  - repeat split; try congruence; try tauto.
    intros _ s I. destruct s; tauto.
Qed.

Definition opposite_relation (r : Relation) : Relation :=
  match r with
  | rPositive => rNegative | rNegative => rPositive
  | rCoincident => rCoincident | rSpanning => rSpanning
  end.

(** Against the reversed plane positive and negative are exchanged. *)
Theorem relation_to_the_reversed_plane : forall fragment plane,
  relation fragment (reversed plane) =
  opposite_relation (relation fragment plane).
Proof.
  intros fragment plane. unfold relation, sides_of.
  assert (E : map (side_of (reversed plane)) (vertices fragment) =
              map opposite (map (side_of plane) (vertices fragment))).
  { rewrite map_map. apply map_ext. intro p. apply side_of_reversed. }
  rewrite E. generalize (map (side_of plane) (vertices fragment)). intro l.
  assert (F : forall side, existsb (is_side side) (map opposite l) =
                           existsb (is_side (opposite side)) l).
  { intro side. induction l as [ | s l IH ]; [ reflexivity | ]. cbn.
    rewrite IH. destruct side, s; reflexivity. }
  unfold relation_of. rewrite !F. cbn.
  destruct (existsb (is_side kPositive) l), (existsb (is_side kNegative) l);
    reflexivity.
Qed.

(** * S2.3: how many corners *)

Definition on_plane (sides : list Side) : nat :=
  length (filter (side_eqb kOn) sides).

Definition crosses (here there : Side) : bool :=
  match here, there with
  | kPositive, kNegative | kNegative, kPositive => true
  | _, _ => false
  end.

(** The edges that pass through the plane strictly inside. *)
Fixpoint crossings_from (first : Side) (sides : list Side) : nat :=
  match sides with
  | [] => 0
  | [here] => if crosses here first then 1 else 0
  | here :: (there :: _) as rest =>
    (if crosses here there then 1 else 0) + crossings_from first rest
  end.

Definition crossings (sides : list Side) : nat :=
  match sides with [] => 0 | first :: _ => crossings_from first sides end.

Lemma step_length : forall k here there,
  length (step k here there) =
  (1 + (if side_eqb kOn here then 1 else 0) +
   2 * (if crosses here there then 1 else 0))%nat.
Proof. destruct here, there; reflexivity. Qed.

Lemma walk_from_length : forall first sides k,
  length (walk_from first k sides) =
  (length sides + on_plane sides + 2 * crossings_from first sides)%nat.
Proof.
  intros first sides. induction sides as [ | here rest IH ]; intro k;
    [ reflexivity | ].
  destruct rest as [ | there rest ].
  - cbn [walk_from]. rewrite step_length. unfold on_plane. cbn.
    destruct here; cbn; lia.
  - change (walk_from first k (here :: there :: rest)) with
      (step k here there ++ walk_from first (S k) (there :: rest)).
    rewrite app_length, IH, step_length. unfold on_plane.
    cbn [filter crossings_from length]. destruct here; cbn; lia.
Qed.

(** Every vertex goes to a part, those on the plane to both, and a crossing
    gives one to both. *)
Theorem corners_of_both_parts : forall sides,
  length (walk sides) =
  (length sides + on_plane sides + 2 * crossings sides)%nat.
Proof.
  intros [ | first rest ]; [ reflexivity | ].
  unfold walk, crossings. apply walk_from_length.
Qed.

(** The boundary of a convex polygon passes through the plane twice, at a
    vertex or inside an edge: then both parts have n + 4 - k edges. *)
Theorem edges_of_both_parts : forall sides,
  (on_plane sides + crossings sides = 2)%nat ->
  length (walk sides) = (length sides + 4 - on_plane sides)%nat.
Proof. intros sides H. rewrite corners_of_both_parts. lia. Qed.

(** The two parts together are the walk. *)
Theorem parts_share_the_walk : forall fragment plane splitter,
  (forall s, In s (walk (sides_of fragment plane)) -> part s <> kOn) ->
  let (positive, negative) := split fragment plane splitter in
  (length (edges positive) + length (edges negative))%nat =
  length (walk (sides_of fragment plane)).
Proof.
  intros fragment plane splitter H. cbn. rewrite !map_length.
  induction (walk (sides_of fragment plane)) as [ | s l IH ]; [ reflexivity | ].
  cbn. assert (N := H s (or_introl eq_refl)).
  assert (IH' := IH (fun t I => H t (or_intror I))).
  destruct (part s); cbn; [ lia | now destruct N | lia ].
Qed.

(** * S2.3: where the corners are *)

Theorem meet_is_on_the_plane : forall plane p q,
  ~ value_at plane p == value_at plane q ->
  value_at plane (meet p (value_at plane p) q (value_at plane q)) == 0.
Proof.
  intros plane p q H. unfold meet, value_at in *. cbn.
  field. intro E. apply H. lra.
Qed.

(** On the way from [p] to [q]: the point at [t]. *)
Definition between (p q r : Point) : Prop :=
  exists t, 0 <= t <= 1 /\ px r == px p + (px q - px p) * t /\
    py r == py p + (py q - py p) * t /\ pz r == pz p + (pz q - pz p) * t.

(** A crossing is strictly inside its edge. *)
Theorem meet_is_inside_the_edge : forall p hp q hq,
  (hp < 0 /\ 0 < hq \/ 0 < hp /\ hq < 0) ->
  0 < hp / (hp - hq) < 1 /\ between p q (meet p hp q hq).
Proof.
  intros p hp q hq H.
  assert (T : 0 < hp / (hp - hq) < 1).
  { destruct H as [[Hp Hq] | [Hp Hq]].
    - setoid_replace (hp / (hp - hq)) with ((- hp) / (hq - hp))
        by (field; split; lra).
      split.
      + apply Qlt_shift_div_l; lra.
      + apply Qlt_shift_div_r; lra.
    - split.
      + apply Qlt_shift_div_l; lra.
      + apply Qlt_shift_div_r; lra. }
  split; [ exact T | ].
  exists (hp / (hp - hq)). unfold meet; cbn. repeat split; try reflexivity; lra.
Qed.

(** A set that holds with two points those between them. *)
Definition is_convex (s : Point -> Prop) : Prop :=
  forall p q r, s p -> s q -> between p q r -> s r.

(** The points of a polygon: those of every convex set with its vertices. *)
Definition inside (points : list Point) (r : Point) : Prop :=
  forall s, is_convex s -> (forall p, In p points -> s p) -> s r.

Lemma vertex_is_inside : forall points p, In p points -> inside points p.
Proof. intros points p I s _ H. now apply H. Qed.

Theorem polygons_are_convex : forall points, is_convex (inside points).
Proof.
  intros points p q r P R B s C H.
  apply (C p q r); [ now apply P | now apply R | exact B ].
Qed.

Lemma inside_of_inside : forall points more r,
  (forall p, In p more -> inside points p) -> inside more r ->
  inside points r.
Proof.
  intros points more r H M s C P. apply (M s C). intros p I. now apply H.
Qed.

(** What the walk puts where, edge by edge. *)
Lemma step_tells : forall k here there s, In s (step k here there) ->
  at_ s = k /\
  (crossing s = true -> crosses here there = true) /\
  (crossing s = false -> part s = here \/ here = kOn).
Proof.
  intros k here there s I.
  destruct here, there; cbn in I;
    repeat (destruct I as [<- | I];
            [ cbn; repeat split; auto; discriminate | ]);
    destruct I.
Qed.

Lemma walk_from_tells : forall first sides k s,
  In s (walk_from first k sides) ->
  exists i here there,
    nth_error sides i = Some here /\
    (nth_error sides (S i) = Some there \/
     S i = length sides /\ there = first) /\
    In s (step (k + i) here there).
Proof.
  intros first sides. induction sides as [ | here rest IH ]; intros k s I;
    [ destruct I | ].
  destruct rest as [ | there rest ].
  - exists 0%nat, here, first. cbn in *. rewrite Nat.add_0_r.
    repeat split; auto.
  - change (walk_from first k (here :: there :: rest)) with
      (step k here there ++ walk_from first (S k) (there :: rest)) in I.
    apply in_app_or in I. destruct I as [I | I].
    + exists 0%nat, here, there. cbn. rewrite Nat.add_0_r. auto.
    + destruct (IH (S k) s I) as [i [h [t [A [B C]]]]].
      exists (S i), h, t. rewrite Nat.add_succ_r, <- Nat.add_succ_l.
      cbn [nth_error length]. split; [ exact A | split; [ | exact C ] ].
      destruct B as [B | [B ->]]; [ left; exact B | right ].
      split; [ cbn in *; lia | reflexivity ].
Qed.

Lemma walk_tells : forall sides s, In s (walk sides) ->
  exists here there,
    nth_error sides (at_ s) = Some here /\
    nth_error sides (next (length sides) (at_ s)) = Some there /\
    In s (step (at_ s) here there).
Proof.
  intros [ | first rest ] s I; [ destruct I | ].
  destruct (walk_from_tells first (first :: rest) 0 s I)
    as [i [here [there [A [B C]]]]].
  cbn in C. destruct (step_tells _ _ _ _ C) as [E _].
  exists here, there. rewrite E. split; [ exact A | split; [ | exact C ] ].
  unfold next. destruct B as [B | [B ->]].
  - assert (L : (S i < length (first :: rest))%nat)
      by (apply nth_error_Some; congruence).
    replace (S i =? length (first :: rest))%nat with false
      by (symmetry; apply Nat.eqb_neq; lia). exact B.
  - rewrite B, Nat.eqb_refl. reflexivity.
Qed.

Lemma sides_nth : forall fragment plane k side,
  nth_error (sides_of fragment plane) k = Some side ->
  In (nth k (vertices fragment) origin) (vertices fragment) /\
  side_of plane (nth k (vertices fragment) origin) = side.
Proof.
  intros fragment plane k side H. unfold sides_of in H.
  rewrite nth_error_map in H.
  destruct (nth_error (vertices fragment) k) as [p | ] eqn:E;
    [ | discriminate ].
  cbn in H. injection H as <-.
  rewrite (nth_error_nth _ _ origin E). split; [ | reflexivity ].
  now apply nth_error_In in E.
Qed.

(** Every corner that the walk puts is a point of the polygon, and on the side
    of its part, or on the plane. *)
Theorem corner_is_inside_and_on_its_side : forall fragment plane s,
  In s (walk (sides_of fragment plane)) ->
  inside (vertices fragment) (corner_of fragment plane s) /\
  (side_of plane (corner_of fragment plane s) = part s \/
   value_at plane (corner_of fragment plane s) == 0).
Proof.
  intros fragment plane s I.
  destruct (walk_tells _ _ I) as [here [there [A [B C]]]].
  unfold sides_of at 2 in B. rewrite map_length in B.
  destruct (sides_nth _ _ _ _ A) as [Ip Sp].
  destruct (sides_nth _ _ _ _ B) as [Iq Sq].
  destruct (step_tells _ _ _ _ C) as [_ [Cross Keep]].
  unfold corner_of.
  set (p := nth (at_ s) (vertices fragment) origin) in *.
  set (q := nth (next _ _) (vertices fragment) origin) in *.
  destruct (crossing s).
  - specialize (Cross eq_refl).
    assert (H : value_at plane p < 0 /\ 0 < value_at plane q \/
                0 < value_at plane p /\ value_at plane q < 0).
    { unfold side_of in Sp, Sq. subst here there.
      destruct (sign_cases (value_at plane p)) as [[E ?] | [[E ?] | [E ?]]];
        destruct (sign_cases (value_at plane q)) as [[F ?] | [[F ?] | [F ?]]];
        rewrite E, F in Cross; try discriminate; tauto. }
    split.
    + apply (polygons_are_convex _ p q); try now apply vertex_is_inside.
      now apply meet_is_inside_the_edge.
    + right. apply meet_is_on_the_plane. intro E. lra.
  - split; [ now apply vertex_is_inside | ].
    destruct (Keep eq_refl) as [K | K].
    + left. congruence.
    + right. rewrite K in Sp. now apply sign_on in Sp.
Qed.

(** The points of a part are points of the polygon on the part's closed side of
    the plane. *)
Theorem parts_are_within_the_polygon : forall fragment plane splitter r,
  (inside (vertices (part_of kPositive fragment plane splitter)) r ->
   inside (vertices fragment) r /\ 0 <= value_at plane r) /\
  (inside (vertices (part_of kNegative fragment plane splitter)) r ->
   inside (vertices fragment) r /\ value_at plane r <= 0).
Proof.
  intros fragment plane splitter r.
  assert (Affine : forall p q t, between p q t -> exists u, 0 <= u <= 1 /\
    value_at plane t == value_at plane p + (value_at plane q -
                                            value_at plane p) * u).
  { intros p q t [u [U [X [Y Z]]]]. exists u. split; [ exact U | ].
    unfold value_at. rewrite X, Y, Z. ring. }
  assert (Vertex : forall side v,
    In v (vertices (part_of side fragment plane splitter)) ->
    inside (vertices fragment) v /\
    (side_of plane v = side \/ value_at plane v == 0)).
  { intros side v I. cbn in I. apply in_map_iff in I.
    destruct I as [s [<- F]]. apply filter_In in F. destruct F as [I E].
    apply side_eqb_eq in E. rewrite <- E.
    now apply corner_is_inside_and_on_its_side. }
  split; intro I; (split;
    [ apply (inside_of_inside _ _ _ (fun v J => proj1 (Vertex _ v J)) I) | ]).
  - apply (I (fun v => 0 <= value_at plane v)).
    + intros p q t P R B. destruct (Affine p q t B) as [u [U ->]]. nra.
    + intros v J. destruct (Vertex _ v J) as [_ [S | S]]; [ | lra ].
      apply sign_positive in S. lra.
  - apply (I (fun v => value_at plane v <= 0)).
    + intros p q t P R B. destruct (Affine p q t B) as [u [U ->]]. nra.
    + intros v J. destruct (Vertex _ v J) as [_ [S | S]]; [ | lra ].
      apply sign_negative in S. lra.
Qed.

(** ** The parts make up the polygon *)

Lemma nth_error_of_in : forall (A : Type) (v : A) l, In v l ->
  exists k, nth_error l k = Some v.
Proof. intros A v l I. now apply In_nth_error. Qed.

Lemma walk_from_puts : forall first sides k i here,
  nth_error sides i = Some here -> here <> kOn ->
  In (put here (k + i) false false) (walk_from first k sides).
Proof.
  intros first sides. induction sides as [ | s rest IH ]; intros k i here E N;
    [ destruct i; discriminate | ].
  assert (Here : forall there, In (put here k false false) (step k here there)).
  { intro there. destruct here; [ now left | now destruct N | now left ]. }
  destruct i as [ | i ].
  - cbn in E. injection E as ->. rewrite Nat.add_0_r.
    destruct rest as [ | there rest ]; [ apply Here | ].
    change (walk_from first k (here :: there :: rest)) with
      (step k here there ++ walk_from first (S k) (there :: rest)).
    apply in_or_app. left. apply Here.
  - cbn in E. destruct rest as [ | there rest ]; [ destruct i; discriminate | ].
    change (walk_from first k (s :: there :: rest)) with
      (step k s there ++ walk_from first (S k) (there :: rest)).
    apply in_or_app. right. rewrite Nat.add_succ_r, <- Nat.add_succ_l.
    now apply IH.
Qed.

(** Each part keeps the vertices on its side. *)
Theorem vertices_are_kept : forall fragment plane splitter side v,
  In v (vertices fragment) -> side_of plane v = side -> side <> kOn ->
  In v (vertices (part_of side fragment plane splitter)).
Proof.
  intros fragment plane splitter side v I E N.
  destruct (nth_error_of_in _ _ _ I) as [k K].
  cbn. apply in_map_iff. exists (put side k false false). split.
  - unfold corner_of, put. cbn. now apply nth_error_nth.
  - apply filter_In. split; [ | now apply side_eqb_eq ].
    assert (L : nth_error (sides_of fragment plane) k = Some side).
    { unfold sides_of. rewrite nth_error_map, K. cbn. now rewrite E. }
    unfold walk. destruct (sides_of fragment plane) as [ | first rest ].
    + destruct k; discriminate.
    + now apply (walk_from_puts first (first :: rest) 0 k side).
Qed.

Lemma between_and_the_meet : forall plane p q r,
  0 < value_at plane p -> value_at plane q < 0 -> between p q r ->
  let y := meet p (value_at plane p) q (value_at plane q) in
  (0 <= value_at plane r -> between p y r) /\
  (value_at plane r <= 0 -> between y q r).
Proof.
  intros plane p q r Hp Hq [u [U [X [Y Z]]]] y.
  set (hp := value_at plane p) in *. set (hq := value_at plane q) in *.
  assert (Hr : value_at plane r == hp + (hq - hp) * u).
  { unfold hp, hq, value_at. rewrite X, Y, Z. ring. }
  split; intro S; rewrite Hr in S.
  - exists (u * (hp - hq) / hp). split.
    + split.
      * apply Qle_shift_div_l; [ exact Hp | ]. nra.
      * apply Qle_shift_div_r; [ exact Hp | ]. nra.
    + unfold y, meet; cbn. rewrite X, Y, Z.
      repeat split; field; split; intro E; lra.
  - exists ((u * (hp - hq) - hp) / (- hq)). split.
    + split.
      * apply Qle_shift_div_l; [ lra | ]. nra.
      * apply Qle_shift_div_r; [ lra | ]. nra.
    + unfold y, meet; cbn. rewrite X, Y, Z.
      repeat split; field; split; intro E; lra.
Qed.

Lemma between_reversed : forall p q r, between p q r -> between q p r.
Proof.
  intros p q r [u [U [X [Y Z]]]]. exists (1 - u). split; [ lra | ].
  rewrite X, Y, Z. repeat split; ring.
Qed.

(** What both parts have of the plane: all that the polygon has. It is the
    segment between the two points at which the boundary passes. *)
Definition parts_share_the_section (fragment : Fragment) (plane : Plane)
    (splitter : Z) : Prop :=
  forall r, inside (vertices fragment) r -> value_at plane r == 0 ->
    inside (vertices (part_of kPositive fragment plane splitter)) r /\
    inside (vertices (part_of kNegative fragment plane splitter)) r.

(** The parts are the polygon's intersections with the closed half-spaces. *)
Theorem parts_are_the_intersections : forall fragment plane splitter r,
  parts_share_the_section fragment plane splitter ->
  (inside (vertices (part_of kPositive fragment plane splitter)) r <->
   inside (vertices fragment) r /\ 0 <= value_at plane r) /\
  (inside (vertices (part_of kNegative fragment plane splitter)) r <->
   inside (vertices fragment) r /\ value_at plane r <= 0).
Proof.
  intros fragment plane splitter r Section.
  set (P := inside (vertices (part_of kPositive fragment plane splitter))).
  set (N := inside (vertices (part_of kNegative fragment plane splitter))).
  assert (CP : is_convex P) by apply polygons_are_convex.
  assert (CN : is_convex N) by apply polygons_are_convex.
  assert (All : forall t, inside (vertices fragment) t ->
    inside (vertices fragment) t /\ (0 <= value_at plane t -> P t) /\
    (value_at plane t <= 0 -> N t)).
  { intros t T.
    apply (T (fun t => inside (vertices fragment) t /\
      (0 <= value_at plane t -> P t) /\ (value_at plane t <= 0 -> N t))).
    - assert (Cross : forall p q w, 0 < value_at plane p ->
        value_at plane q < 0 -> inside (vertices fragment) p ->
        inside (vertices fragment) q -> P p -> N q -> between p q w ->
        (0 <= value_at plane w -> P w) /\ (value_at plane w <= 0 -> N w)).
      { intros p q w Hp Hq Ip Iq Pp Nq B.
        destruct (between_and_the_meet plane p q w Hp Hq B) as [B1 B2].
        assert (Y : P (meet p (value_at plane p) q (value_at plane q)) /\
                    N (meet p (value_at plane p) q (value_at plane q))).
        { apply Section.
          - apply (polygons_are_convex _ p q); try assumption.
            apply meet_is_inside_the_edge. right. split; assumption.
          - apply meet_is_on_the_plane. intro E. lra. }
        split; intro S.
        - exact (CP p _ w Pp (proj1 Y) (B1 S)).
        - exact (CN _ q w (proj2 Y) Nq (B2 S)). }
      intros p q w [Ip [Pp Np]] [Iq [Pq Nq]] B.
      assert (Iw : inside (vertices fragment) w)
        by exact (polygons_are_convex _ p q w Ip Iq B).
      split; [ exact Iw | ].
      destruct (Qlt_le_dec 0 (value_at plane p)) as [Hp | Hp].
      + destruct (Qlt_le_dec (value_at plane q) 0) as [Hq | Hq].
        * apply (Cross p q w); auto; [ apply Pp | apply Nq ]; lra.
        * assert (W : P w) by
            (apply (CP p q w); [ apply Pp | apply Pq | exact B ]; lra).
          split; [ intros _; exact W | intro S ].
          refine (proj2 (Section w Iw _)).
          assert (G := proj2 (proj1 (parts_are_within_the_polygon
                         fragment plane splitter w) W)). lra.
      + destruct (Qlt_le_dec (value_at plane p) 0) as [Hp' | Hp'].
        * destruct (Qlt_le_dec 0 (value_at plane q)) as [Hq | Hq].
          -- apply (Cross q p w); try assumption.
             ++ apply Pq. now apply Qlt_le_weak.
             ++ apply Np. exact Hp.
             ++ now apply between_reversed.
          -- assert (W : N w) by
               (apply (CN p q w); [ apply Np | apply Nq | exact B ]; lra).
             split; [ intro S | intros _; exact W ].
             refine (proj1 (Section w Iw _)).
             assert (G := proj2 (proj2 (parts_are_within_the_polygon
                            fragment plane splitter w) W)). lra.
        * assert (Zp : value_at plane p == 0) by lra.
          destruct (Section p Ip Zp) as [Sp Sn].
          assert (G := parts_are_within_the_polygon fragment plane splitter w).
          destruct (Qlt_le_dec (value_at plane q) 0) as [Hq | Hq].
          -- assert (W : N w)
               by (apply (CN p q w); [ exact Sn | apply Nq; lra | exact B ]).
             split; [ intro S | intros _; exact W ].
             refine (proj1 (Section w Iw _)).
             assert (G' := proj2 (proj2 G W)). lra.
          -- assert (W : P w)
               by (apply (CP p q w); [ exact Sp | apply Pq; lra | exact B ]).
             split; [ intros _; exact W | intro S ].
             refine (proj2 (Section w Iw _)).
             assert (G' := proj2 (proj1 G W)). lra.
    - intros v I. split; [ now apply vertex_is_inside | ].
      assert (Iv := vertex_is_inside _ _ I).
      split; intro S; destruct (sign_cases (value_at plane v))
        as [[E V] | [[E V] | [E V]]]; try lra.
      + exact (proj1 (Section v Iv V)).
      + apply vertex_is_inside.
        apply (vertices_are_kept _ _ _ _ v I E). discriminate.
      + apply vertex_is_inside.
        apply (vertices_are_kept _ _ _ _ v I E). discriminate.
      + exact (proj2 (Section v Iv V)). }
  destruct (parts_are_within_the_polygon fragment plane splitter r) as [WP WN].
  split; split.
  - exact WP.
  - intros [I S]. exact (proj1 (proj2 (All r I)) S).
  - exact WN.
  - intros [I S]. exact (proj2 (proj2 (All r I)) S).
Qed.

(** So they make up the polygon, and share nothing off the plane. *)
Theorem parts_make_up_the_polygon : forall fragment plane splitter r,
  parts_share_the_section fragment plane splitter ->
  let positive := vertices (fst (split fragment plane splitter)) in
  let negative := vertices (snd (split fragment plane splitter)) in
  (inside (vertices fragment) r <-> inside positive r \/ inside negative r) /\
  (inside positive r -> inside negative r -> value_at plane r == 0).
Proof.
  intros fragment plane splitter r Section. cbn.
  destruct (parts_are_the_intersections fragment plane splitter r Section)
    as [P N].
  rewrite P, N. split.
  - destruct (Qlt_le_dec (value_at plane r) 0) as [L | L].
    + split; [ intro I; right; split; [ exact I | lra ] | tauto ].
    + split; [ intro I; left; split; [ exact I | exact L ] | tauto ].
  - intros [_ A] [_ B]. lra.
Qed.
