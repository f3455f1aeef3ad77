(** * S1.3, S2: polygons in space, and what a plane makes of them.

    A fragment is its source, its plane, the planes of its edges, and points
    whose sides say how it lies against a plane: its corners, to which a split
    adds where lines between them cross the splitter. (Of these the ones between
    neighbours are the new corners; the others lie between them and change no
    side.) [View.v] shows such fragments to a camera. *)

From Coq Require Import QArith Qminmax Lqa Lia List Bool Permutation.
From Halfspace Require Import Base.
Import ListNotations.
Open Scope Q_scope.

(** ** Vectors and homogeneous points *)

Definition difference (p q : Point) : Point :=
  {| px := px p - px q; py := py p - py q; pz := pz p - pz q |}.

Definition dot (u v : Point) : Q := px u * px v + py u * py v + pz u * pz v.

Definition cross (u v : Point) : Point :=
  {| px := py u * pz v - pz u * py v;
     py := pz u * px v - px u * pz v;
     pz := px u * py v - py u * px v |}.

Definition normal (h : Plane) : Point :=
  {| px := pa h; py := pb h; pz := pc h |}.

(** A plane at the homogeneous point (p, w): a point of space if [w] is 1, a
    direction if it is 0. *)
Definition value_of (h : Plane) (p : Point) (w : Q) : Q :=
  dot (normal h) p + pd h * w.

Lemma value_of_point : forall h p, value_of h p 1 == value_at h p.
Proof. intros; unfold value_of, value_at, dot; simpl; ring. Qed.

Definition not_zero (h : Plane) : Prop :=
  ~ (pa h == 0 /\ pb h == 0 /\ pc h == 0).

(** ** Polygons *)

(** A plane through the edge from [p] to [q] of a polygon in the plane [h],
    positive on the polygon's side. *)
Definition edge_plane (h : Plane) (p q : Point) : Plane :=
  let m := cross (normal h) (difference q p) in
  {| pa := px m; pb := py m; pc := pz m; pd := - dot m p |}.

Fixpoint edges_along (h : Plane) (corners : list Point) : list Plane :=
  match corners with
  | p :: (q :: _) as rest => edge_plane h p q :: edges_along h rest
  | _ => []
  end.

(** All edges, round the polygon and back to the first corner. *)
Definition edges_of (h : Plane) (corners : list Point) : list Plane :=
  match corners with
  | [] => []
  | p :: _ => edges_along h (corners ++ [p])
  end.

(** S2.2. *)
Record Fragment := {
  source : Z;
  support : Plane;
  edges : list Plane;
  vertices : list Point
}.

Definition whole (id : Z) (plane : Plane) (corners : list Point) : Fragment :=
  {| source := id; support := plane; edges := edges_of plane corners;
     vertices := corners |}.

(** S1.3: the corners are in the plane, every edge has all of them on its side,
    and not all are on one line. *)
Definition polygon_ok (plane : Plane) (corners : list Point) : Prop :=
  (forall v, In v corners -> value_at plane v == 0) /\
  (forall e v, In e (edges_of plane corners) -> In v corners ->
   0 <= value_at e v) /\
  (exists e v, In e (edges_of plane corners) /\ In v corners /\
   0 < value_at e v).

(** ** Relation and split *)

(** S2.1. *)
Definition relation (f : Fragment) (h : Plane) : Relation :=
  let some side := existsb (fun v => side_eqb (side_of h v) side) (vertices f)
  in
  if some kPositive then if some kNegative then rSpanning else rPositive
  else if some kNegative then rNegative else rCoincident.

(** The point in which the line through [p] and [q] meets the plane. *)
Definition meet (h : Plane) (p q : Point) : Point :=
  let t := value_at h p / (value_at h p - value_at h q) in
  {| px := px p + (px q - px p) * t;
     py := py p + (py q - py p) * t;
     pz := pz p + (pz q - pz p) * t |}.

Definition crossings (h : Plane) (points : list Point) : list Point :=
  flat_map (fun p => flat_map (fun q =>
    match side_of h p, side_of h q with
    | kPositive, kNegative => [meet h p q]
    | _, _ => []
    end) points) points.

(** The part of a fragment on the positive side of a plane. *)
Definition part (f : Fragment) (h : Plane) : Fragment :=
  {| source := source f; support := support f; edges := h :: edges f;
     vertices :=
       filter (fun v => negb (side_eqb (side_of h v) kNegative)) (vertices f) ++
       crossings h (vertices f) |}.

(** S2.3. *)
Definition split (f : Fragment) (h : Plane) : Fragment * Fragment :=
  (part f h, part f (reversed h)).

(** ** What a fragment is *)

Definition inside (f : Fragment) (q : Point) : Prop :=
  value_at (support f) q == 0 /\
  forall e, In e (edges f) -> 0 < value_at e q.

Record valid (f : Fragment) : Prop := {
  valid_normal : not_zero (support f);
  valid_planar : forall v, In v (vertices f) ->
    value_at (support f) v == 0;
  (* what is inside lies between the vertices *)
  valid_hull : forall q h, inside f q ->
    (forall v, In v (vertices f) -> 0 <= value_at h v) -> 0 <= value_at h q;
  (* it is bounded: nothing at infinity or beyond is inside *)
  valid_bounded : forall q w,
    (forall e, In e (edges f) -> 0 < value_of e q w) -> 0 < w
}.

(** *** A polygon is one *)

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

Lemma not_zero_square : forall h, not_zero h -> 0 < dot (normal h) (normal h).
Proof.
  intros h N; unfold dot, normal; simpl.
  destruct (Qeq_dec (pa h) 0) as [A | A].
  - destruct (Qeq_dec (pb h) 0) as [B | B].
    + destruct (Qeq_dec (pc h) 0) as [C | C]; [exfalso; apply N; auto|].
      assert (0 < pc h * pc h) by (destruct (Q_dec (pc h) 0) as [[|]|]; nra).
      nra.
    + assert (0 < pb h * pb h) by (destruct (Q_dec (pb h) 0) as [[|]|]; nra).
      nra.
  - assert (0 < pa h * pa h) by (destruct (Q_dec (pa h) 0) as [[|]|]; nra).
    nra.
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

Definition origin : Point := {| px := 0; py := 0; pz := 0 |}.

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

(** S1.3, S2.2: a convex polygon is a fragment. *)
Theorem whole_valid : forall id plane corners,
  polygon_ok plane corners -> valid (whole id plane corners).
Proof.
  intros id plane corners (A & B & (e & v & E & V & P)).
  assert (not_zero plane) as N.
  { intros (X & Y & Z).
    assert (value_at e v == 0); [|lra].
    assert (forall l, In e (edges_along plane l) -> value_at e v == 0) as H.
    { clear - X Y Z; induction l as [|p [|r l] IH]; simpl in *; try tauto.
      intros [<- | I]; [|auto].
      rewrite edge_turns; unfold dot, normal; simpl; rewrite X, Y, Z; ring. }
    destruct corners as [|p l]; [destruct E | exact (H _ E)]. }
  constructor; simpl.
  - exact N.
  - exact A.
  - intros q h [Q I] H; simpl in Q, I.
    destruct (Qlt_le_dec (value_at h q) 0) as [L | L]; [exfalso | exact L].
    apply (no_way_round plane h q N Q L corners).
    + apply Forall_forall; intros u U; split; auto.
    + intros ->; destruct V.
    + now apply Forall_forall.
  - intros q w H.
    assert (0 < total_at q w (edges_of plane corners)) as T.
    { apply total_positive; [intros k K; apply Qlt_le_weak; auto|].
      exists e; auto. }
    assert (0 < total_at v 1 (edges_of plane corners)) as U.
    { apply total_positive; [intros k K; rewrite value_of_point; auto|].
      exists e; rewrite value_of_point; auto. }
    rewrite total_round in T; rewrite total_round in U.
    destruct (Qlt_le_dec 0 w) as [L | L]; [exact L | exfalso; nra].
Qed.

(** *** The parts of a fragment are fragments *)

Lemma meet_value : forall h k p q, 0 < value_at h p -> value_at h q < 0 ->
  value_at k (meet h p q) * (value_at h p - value_at h q) ==
  value_at k q * value_at h p - value_at k p * value_at h q.
Proof.
  intros h k p q P N; set (s := value_at h p) in *.
  set (r := value_at h q) in *.
  assert (value_at k (meet h p q) ==
          value_at k p + (value_at k q - value_at k p) * (s / (s - r))) as E.
  { unfold meet; fold s r; generalize (s / (s - r)); intros t.
    unfold value_at; simpl; ring. }
  rewrite E; field; lra.
Qed.

Lemma crossings_in : forall h points v,
  In v (crossings h points) <-> exists p q, In p points /\ In q points /\
  0 < value_at h p /\ value_at h q < 0 /\ v = meet h p q.
Proof.
  intros h points v; unfold crossings; rewrite in_flat_map; split.
  - intros (p & P & H); apply in_flat_map in H; destruct H as (q & Q & H).
    exists p, q; unfold side_of in H.
    destruct (sign (value_at h p)) eqn:A; try destruct H.
    destruct (sign (value_at h q)) eqn:B; try destruct H; try easy.
    apply sign_positive in A; apply sign_negative in B; auto.
  - intros (p & q & P & Q & A & B & ->); exists p; split; [exact P|].
    apply in_flat_map; exists q; split; [exact Q|]; unfold side_of.
    apply sign_positive in A; apply sign_negative in B; rewrite A, B.
    left; reflexivity.
Qed.

Lemma part_vertices : forall f h v, In v (vertices (part f h)) <->
  In v (vertices f) /\ 0 <= value_at h v \/
  In v (crossings h (vertices f)).
Proof.
  intros f h v; simpl; rewrite in_app_iff, filter_In.
  assert (negb (side_eqb (side_of h v) kNegative) = true <->
          0 <= value_at h v) as ->; [|tauto].
  unfold side_of.
  destruct (sign_cases (value_at h v)) as [[-> H] | [[-> H] | [-> H]]]; simpl;
    split; try easy; intros; lra.
Qed.

(** Between lower bounds and upper bounds there is room, if no lower one is
    above an upper one. *)
Lemma between_bounds : forall lower upper : list Q,
  (forall l u, In l lower -> In u upper -> l <= u) ->
  (forall u, In u upper -> 0 <= u) ->
  exists m, 0 <= m /\ (forall l, In l lower -> l <= m) /\
            (forall u, In u upper -> m <= u).
Proof.
  induction lower as [|l lower IH]; intros upper H P.
  - exists 0; split; [lra|]; split; [intros l []| exact P].
  - destruct (IH upper) as (m & M & L & U); auto.
    { intros; apply H; simpl; auto. }
    exists (Qmax l m); pose proof (Q.le_max_l l m); pose proof (Q.le_max_r l m).
    split; [lra|]; split.
    + intros k [<- | K]; [lra | specialize (L k K); lra].
    + intros u K; apply Q.max_lub; [apply H; simpl; auto | auto].
Qed.

Definition combined (k h : Plane) (m : Q) : Plane :=
  {| pa := pa k - m * pa h; pb := pb k - m * pb h;
     pc := pc k - m * pc h; pd := pd k - m * pd h |}.

Lemma combined_value : forall k h m p,
  value_at (combined k h m) p == value_at k p - m * value_at h p.
Proof. intros; unfold value_at, combined; simpl; ring. Qed.

Theorem part_valid : forall f h, valid f -> valid (part f h).
Proof.
  intros f h [N P H B]; constructor.
  - exact N.
  - intros v V; apply part_vertices in V; simpl.
    destruct V as [[V _] | V]; [auto|].
    apply crossings_in in V; destruct V as (p & q & A & C & Hp & Hq & ->).
    pose proof (meet_value h (support f) p q Hp Hq) as E.
    rewrite (P p A), (P q C) in E.
    assert (value_at (support f) (meet h p q) *
            (value_at h p - value_at h q) == 0) as F by lra.
    apply Qmult_integral in F; destruct F; [assumption | lra].
  - intros q k [Q I] K; simpl in Q, I.
    assert (0 < value_at h q) as Hq by auto.
    set (positive := filter (fun v => side_eqb (side_of h v) kPositive)
                       (vertices f)).
    set (negative := filter (fun v => side_eqb (side_of h v) kNegative)
                       (vertices f)).
    assert (forall v, In v positive <->
            In v (vertices f) /\ 0 < value_at h v) as Ip.
    { intros v; unfold positive, side_of; rewrite filter_In, side_eqb_eq.
      now rewrite sign_positive. }
    assert (forall v, In v negative <->
            In v (vertices f) /\ value_at h v < 0) as In'.
    { intros v; unfold negative, side_of; rewrite filter_In, side_eqb_eq.
      now rewrite sign_negative. }
    destruct (between_bounds
      (map (fun v => value_at k v / value_at h v) negative)
      (map (fun v => value_at k v / value_at h v) positive))
      as (m & M & L & U).
    + intros l u Hl Hu; apply in_map_iff in Hl, Hu.
      destruct Hl as (b & <- & Hb), Hu as (a & <- & Ha).
      apply Ip in Ha; apply In' in Hb; destruct Ha as [Va Ha], Hb as [Vb Hb].
      pose proof (meet_value h k a b Ha Hb) as E.
      assert (0 <= value_at k (meet h a b)) as Km.
      { apply K, part_vertices; right; apply crossings_in; exists a, b; auto. }
      assert (0 <= value_at k (meet h a b) *
              (value_at h a - value_at h b)) as F.
      { apply Qmult_le_0_compat; lra. }
      setoid_replace (value_at k b / value_at h b)
        with (- value_at k b / - value_at h b) by (field; lra).
      apply Qle_shift_div_l; [exact Ha|].
      setoid_replace (- value_at k b / - value_at h b * value_at h a)
        with (- value_at k b * value_at h a / - value_at h b) by (field; lra).
      apply Qle_shift_div_r; lra.
    + intros u Hu; apply in_map_iff in Hu; destruct Hu as (a & <- & Ha).
      apply Ip in Ha; destruct Ha as [Va Ha].
      apply Qle_shift_div_l; [exact Ha|].
      assert (0 <= value_at k a); [|lra].
      apply K, part_vertices; left; split; [exact Va | lra].
    + assert (0 <= value_at (combined k h m) q) as F.
      { apply H; [split; auto|]; intros v V; rewrite combined_value.
        destruct (Q_dec (value_at h v) 0) as [[D | D] | D].
        - specialize (L (value_at k v / value_at h v)).
          assert (value_at k v / value_at h v <= m) as L'.
          { apply L, in_map_iff; exists v; split; [reflexivity|].
            apply In'; auto. }
          assert (value_at k v == value_at k v / value_at h v * value_at h v)
            as E by (field; lra).
          set (r := value_at k v / value_at h v) in *; nra.
        - specialize (U (value_at k v / value_at h v)).
          assert (m <= value_at k v / value_at h v) as U'.
          { apply U, in_map_iff; exists v; split; [reflexivity|].
            apply Ip; auto. }
          assert (value_at k v == value_at k v / value_at h v * value_at h v)
            as E by (field; lra).
          set (r := value_at k v / value_at h v) in *; nra.
        - assert (0 <= value_at k v).
          { apply K, part_vertices; left; split; [exact V | lra]. }
          rewrite D; lra. }
      rewrite combined_value in F; nra.
  - intros q w E; apply (B q w); intros e I; apply E; simpl; auto.
Qed.

Theorem split_valid : forall f h, valid f -> relation f h = rSpanning ->
  valid (fst (split f h)) /\ valid (snd (split f h)).
Proof. intros f h V _; split; now apply part_valid. Qed.

(** ** Sides of a fragment's vertices *)

Lemma some_side : forall f h side,
  existsb (fun v => side_eqb (side_of h v) side) (vertices f) = true <->
  exists v, In v (vertices f) /\ side_of h v = side.
Proof.
  intros f h side; rewrite existsb_exists.
  split; intros (v & V & S); exists v; split; auto; now apply side_eqb_eq.
Qed.

Lemma no_side : forall f h side,
  existsb (fun v => side_eqb (side_of h v) side) (vertices f) = false ->
  forall v, In v (vertices f) -> side_of h v <> side.
Proof.
  intros f h side E v V S.
  assert (existsb (fun v => side_eqb (side_of h v) side) (vertices f) = true);
    [apply some_side; exists v; auto | congruence].
Qed.

(** S2.1: what the relation says of the vertices. *)
Theorem relation_vertices : forall f h,
  match relation f h with
  | rPositive => (forall v, In v (vertices f) -> 0 <= value_at h v) /\
                 exists v, In v (vertices f) /\ 0 < value_at h v
  | rNegative => (forall v, In v (vertices f) -> value_at h v <= 0) /\
                 exists v, In v (vertices f) /\ value_at h v < 0
  | rCoincident => forall v, In v (vertices f) -> value_at h v == 0
  | rSpanning => (exists v, In v (vertices f) /\ 0 < value_at h v) /\
                 exists v, In v (vertices f) /\ value_at h v < 0
  end.
Proof.
  intros f h; unfold relation.
  assert (forall v, side_of h v <> kNegative -> 0 <= value_at h v) as A.
  { intros v; unfold side_of; rewrite sign_negative; intros; lra. }
  assert (forall v, side_of h v <> kPositive -> value_at h v <= 0) as B.
  { intros v; unfold side_of; rewrite sign_positive; intros; lra. }
  destruct (existsb _ (vertices f)) eqn:P at 1;
    destruct (existsb (fun v => side_eqb (side_of h v) kNegative) (vertices f))
      eqn:N.
  all: try (apply some_side in P; destruct P as (p & P & Sp);
            apply sign_positive in Sp).
  all: try (apply some_side in N; destruct N as (q & N & Sn);
            apply sign_negative in Sn).
  all: try pose proof (no_side f h kPositive P) as P'.
  all: try pose proof (no_side f h kNegative N) as N'.
  - split; [exists p | exists q]; auto.
  - split; [intros v V; apply A, N', V | exists p; auto].
  - split; [intros v V; apply B, P', V | exists q; auto].
  - intros v V; specialize (A v (N' v V)); specialize (B v (P' v V)); lra.
Qed.

(** A fragment lies in its own plane. *)
Theorem own_plane : forall f, valid f -> relation f (support f) = rCoincident.
Proof.
  intros f V; pose proof (relation_vertices f (support f)) as R.
  pose proof (valid_planar f V) as P.
  destruct (relation f (support f)); try reflexivity; exfalso.
  - destruct R as [_ (v & I & H)]; specialize (P v I); lra.
  - destruct R as [_ (v & I & H)]; specialize (P v I); lra.
  - destruct R as [(v & I & H) _]; specialize (P v I); lra.
Qed.

(** S2.L5: the points of a fragment that are off the splitter are those of its
    parts. *)
Theorem part_inside : forall f h q,
  inside (part f h) q <-> inside f q /\ 0 < value_at h q.
Proof.
  intros f h q; unfold inside; simpl; split.
  - intros [P E]; repeat split; auto.
  - intros [[P E] H]; split; [exact P|]; intros e [<- | I]; auto.
Qed.

(** Every vertex of a part is on its side, or on the splitter; it is a vertex
    of the fragment, or lies on the splitter between two of them. *)
Lemma part_vertex : forall f h v, valid f -> In v (vertices (part f h)) ->
  0 <= value_at h v /\
  (In v (vertices f) \/ value_at h v == 0 /\ exists p q t,
     In p (vertices f) /\ In q (vertices f) /\
     px v == px p + (px q - px p) * t /\ py v == py p + (py q - py p) * t /\
     pz v == pz p + (pz q - pz p) * t).
Proof.
  intros f h v _ I; apply part_vertices in I; destruct I as [[I P] | I];
    [auto|].
  apply crossings_in in I; destruct I as (p & q & Ip & Iq & P & N & ->).
  pose proof (meet_value h h p q P N) as E.
  assert (value_at h (meet h p q) == 0) as Z.
  { apply Qmult_integral_l with (value_at h p - value_at h q); [lra|].
    rewrite Qmult_comm, E; ring. }
  split; [rewrite Z; lra|]; right; split; [exact Z|].
  exists p, q, (value_at h p / (value_at h p - value_at h q)).
  repeat split; auto; reflexivity.
Qed.

Lemma part_keeps : forall f h v, In v (vertices f) -> 0 <= value_at h v ->
  In v (vertices (part f h)).
Proof. intros; apply part_vertices; auto. Qed.

Lemma part_is_cut : forall f h, valid f -> relation f h = rSpanning ->
  exists v, In v (vertices (part f h)) /\ value_at h v == 0.
Proof.
  intros f h _ R; pose proof (relation_vertices f h) as S; rewrite R in S.
  destruct S as [(p & Ip & P) (q & Iq & N)].
  exists (meet h p q); split.
  - apply part_vertices; right; apply crossings_in; exists p, q; auto.
  - pose proof (meet_value h h p q P N) as E.
    apply Qmult_integral_l with (value_at h p - value_at h q); [lra|].
    rewrite Qmult_comm, E; ring.
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
  constructor; [now apply whole_valid | apply IH].
Qed.
