(** * S4.1 to S4.5, S5.3: polygons seen by a camera, at one pixel.

    Read beside ref/src/oracle/zbuffer.cpp, from [sign_at_sample] to [is_nearer], and
    [side_of_eye] in ref/src/predicate.cpp. What [Order.v] asks of the geometry
    is shown for every camera and every pixel. *)

From Coq Require Import QArith Lqa Lia List Bool.
From Halfspace Require Import Base Sample Convex Scene.
Import ListNotations.
Open Scope Q_scope.

(* Coq compares terms by their words before it computes with numbers. *)
Local Strategy 100 [sign_at_sample at_image Sample.covers value_of value_at
  edges edges_of edge_plane round Qplus Qmult Qopp Qinv Qcompare].

(** ** Cameras *)

(** S4.1: the eye, a point or the direction towards the viewer, and the map
    from image points to points of space. *)
Record Camera := {
  perspective : bool;
  eye : Point;
  s0 : Point;
  sx : Point;
  sy : Point
}.

Definition weight_of_eye (camera : Camera) : Q :=
  if perspective camera then 1 else 0.

(** S4.1: sx, sy and s0 - eye are linearly independent, or, for an eye at
    infinity, sx, sy and eye. *)
Definition camera_ok (camera : Camera) : Prop :=
  ~ dot (cross (sx camera) (sy camera))
        (if perspective camera then difference (s0 camera) (eye camera)
         else eye camera) == 0.

(** S5.2, S4.3: what beside the edges decides whether a polygon is seen: back
    faces may be left out, and what is not beyond the near distance is. *)
Record Options := {
  cull : bool;
  near : option Q
}.

Section View.

Variable camera : Camera.
Hypothesis ok : camera_ok camera.
Variable options : Options.
(** The pixel. *)
Variables i j : Z.

(** S4.2: h(e). *)
Definition at_eye (h : Plane) : Q :=
  value_of h (eye camera) (weight_of_eye camera).

Definition side_of_eye (h : Plane) : Side := sign (at_eye h).

(** The function h(s) of the image point. *)
Definition plane_at_image (h : Plane) : Affine :=
  {| value := value_at h (s0 camera);
     dx := dot (normal h) (sx camera);
     dy := dot (normal h) (sy camera) |}.

(** S4.5: P(e) Q(s) - Q(e) P(s). *)
Definition cut (P : Plane) (e : Plane) : Affine :=
  add (scale (at_eye P) (plane_at_image e))
      (scale (- at_eye e) (plane_at_image P)).

(** Read against the side of [P] that the eye is on. *)
Definition oriented (P : Plane) (f : Affine) : Affine :=
  match side_of_eye P with
  | kNegative => negated f
  | _ => f
  end.

(** S4.5.3, with the near distance [k] in units of the ray parameter. *)
Definition beyond_near (P : Plane) : bool :=
  match near options with
  | None => true
  | Some k =>
    let f :=
      if perspective camera then
        add {| value := (1 - k) * at_eye P; dx := 0; dy := 0 |}
            (scale k (plane_at_image P))
      else
        add {| value := - k * at_eye P; dx := 0; dy := 0 |}
            (plane_at_image P) in
    side_eqb (sign_at_sample (oriented P f) i j) kPositive
  end.

(** S5.2. *)
Definition not_culled (P : Plane) : bool :=
  negb (cull options && side_eqb (side_of_eye P) kNegative).

(** S4.5, S5.2. *)
Definition covers (f : Fragment) : bool :=
  negb (side_eqb (side_of_eye (support f)) kOn) &&
  not_culled (support f) && beyond_near (support f) &&
  Sample.covers (map (fun e => oriented (support f) (cut (support f) e))
                     (edges f)) i j.

(** On which side of [h] the ray meets the plane of [f]. *)
Definition side_at (f : Fragment) (h : Plane) : Side :=
  sign_at_sample (oriented (support f) (cut (support f) h)) i j.

(** S5.3: the greater, the nearer; in perspective this is 1/t, but for 1, else
    -t. *)
Definition nearness (P : Plane) : Affine :=
  scale (- / at_eye P) (plane_at_image P).

Definition subtract (f g : Affine) : Affine := add f (negated g).

Definition is_nearer (f g : Fragment) : bool :=
  side_eqb (sign_at_sample
    (subtract (nearness (support f)) (nearness (support g))) i j) kPositive.

(** ** No sample is on an edge *)

(** A plane that holds the eye and the image plane is none. *)
Lemma camera_spans : forall h,
  is_zero (plane_at_image h) -> at_eye h == 0 ->
  pa h == 0 /\ pb h == 0 /\ pc h == 0 /\ pd h == 0.
Proof.
  intros h (V & X & Y) E; revert V X Y E.
  unfold camera_ok in ok; unfold plane_at_image, at_eye, weight_of_eye.
  unfold value_of, value_at; simpl; intros V X Y E.
  set (w := if perspective camera then difference (s0 camera) (eye camera)
            else eye camera) in *.
  assert (dot (normal h) w == 0) as W.
  { unfold w in *; destruct (perspective camera); unfold dot, difference in *;
      simpl in *; lra. }
  clearbody w.
  set (u := sx camera) in *; set (v := sy camera) in *.
  set (D := dot (cross u v) w) in *.
  assert (D * pa h == dot (normal h) u * px (cross v w) +
          dot (normal h) v * px (cross w u) +
          dot (normal h) w * px (cross u v)) as A.
  { unfold D, dot, cross; simpl; ring. }
  assert (D * pb h == dot (normal h) u * py (cross v w) +
          dot (normal h) v * py (cross w u) +
          dot (normal h) w * py (cross u v)) as B.
  { unfold D, dot, cross; simpl; ring. }
  assert (D * pc h == dot (normal h) u * pz (cross v w) +
          dot (normal h) v * pz (cross w u) +
          dot (normal h) w * pz (cross u v)) as C.
  { unfold D, dot, cross; simpl; ring. }
  rewrite X, Y, W in A, B, C.
  assert (forall q, D * q == 0 -> q == 0) as Z.
  { intros q H; apply Qmult_integral in H; destruct H; [contradiction|].
    assumption. }
  assert (pa h == 0) as A' by (apply Z; rewrite A; ring).
  assert (pb h == 0) as B' by (apply Z; rewrite B; ring).
  assert (pc h == 0) as C' by (apply Z; rewrite C; ring).
  repeat split; auto; rewrite A', B', C' in V; lra.
Qed.

(** The plane P(e) Q - Q(e) P, which holds the eye. *)
Definition pencil (P e : Plane) : Plane :=
  {| pa := at_eye P * pa e - at_eye e * pa P;
     pb := at_eye P * pb e - at_eye e * pb P;
     pc := at_eye P * pc e - at_eye e * pc P;
     pd := at_eye P * pd e - at_eye e * pd P |}.

Lemma pencil_value : forall P e q w,
  value_of (pencil P e) q w ==
  at_eye P * value_of e q w - at_eye e * value_of P q w.
Proof.
  intros; unfold value_of, pencil, dot, normal; simpl.
  generalize (at_eye P) (at_eye e); intros; ring.
Qed.

(** S4.5: if the line in which [e] cuts [P] were under the sample, the two
    would be one plane. *)
Theorem edge_never_on_sample : forall P e,
  sign_at_sample (cut P e) i j = kOn ->
  at_eye P * pa e == at_eye e * pa P /\ at_eye P * pb e == at_eye e * pb P /\
  at_eye P * pc e == at_eye e * pc P /\ at_eye P * pd e == at_eye e * pd P.
Proof.
  intros P e S; apply sample_never_on in S; destruct S as (V & X & Y).
  destruct (camera_spans (pencil P e)) as (A & B & C & D).
  - unfold is_zero, cut, add, scale, plane_at_image, value_at, dot, pencil,
      normal in *; simpl in *; repeat split; lra.
  - unfold at_eye at 1; rewrite pencil_value; fold (at_eye e) (at_eye P); ring.
  - unfold pencil in *; simpl in *; repeat split; lra.
Qed.

Lemma oriented_on : forall P f,
  sign_at_sample (oriented P f) i j = kOn -> sign_at_sample f i j = kOn.
Proof.
  intros P f; unfold oriented; destruct (side_of_eye P); auto.
  rewrite sign_at_sample_negated; destruct (sign_at_sample f i j); simpl; easy.
Qed.

(** S4.5, by the sides on which the ray meets the edges. *)
Lemma covers_edges : forall f, covers f = true <->
  side_of_eye (support f) <> kOn /\ not_culled (support f) = true /\
  beyond_near (support f) = true /\
  forall e, In e (edges f) -> side_at f e = kPositive.
Proof.
  intros f; unfold covers; rewrite !andb_true_iff, negb_true_iff, covers_all.
  assert (side_eqb (side_of_eye (support f)) kOn = false <->
          side_of_eye (support f) <> kOn) as ->.
  { destruct (side_of_eye (support f)); simpl; split; easy. }
  split.
  - intros [[[A B] C] D]; repeat split; auto; intros e E.
    unfold side_at; apply D, in_map_iff; exists e; auto.
  - intros (A & B & C & D); repeat split; auto; intros k K.
    apply in_map_iff in K; destruct K as (e & <- & E).
    unfold side_at in D; exact (D e E).
Qed.

(** A fragment that covers the sample is met off every plane that does not hold
    all its vertices. *)
Lemma off_plane : forall f h v, valid f -> covers f = true ->
  In v (vertices f) -> ~ value_at h v == 0 -> side_at f h <> kOn.
Proof.
  intros f h v V C I N S; unfold side_at in S; apply oriented_on in S.
  apply edge_never_on_sample in S; destruct S as (A & B & D & E).
  apply covers_edges in C; destruct C as [C _].
  assert (~ at_eye (support f) == 0) as M.
  { intros M; apply C, sign_on, M. }
  pose proof (ok_planar _ _ V v I) as P.
  assert (at_eye (support f) * value_at h v ==
          at_eye h * value_at (support f) v) as F.
  { revert A B D E; unfold value_at.
    generalize (at_eye (support f)) (at_eye h); generalize (support f).
    intros k s t A B D E.
    setoid_replace (s * (pa h * px v + pb h * py v + pc h * pz v + pd h)) with
      (s * pa h * px v + s * pb h * py v + s * pc h * pz v + s * pd h) by ring.
    rewrite A, B, D, E; ring. }
  rewrite P in F.
  assert (at_eye (support f) * value_at h v == 0) as G by lra.
  apply Qmult_integral in G; tauto.
Qed.

(** ** The sample's ray *)

(** Where the ray through the image point (X, Y) meets the plane of a fragment,
    as a homogeneous point (p, w), on the eye's side of the plane. *)
Definition image_point (X Y : Q) : Point :=
  {| px := px (s0 camera) + X * px (sx camera) + Y * px (sy camera);
     py := py (s0 camera) + X * py (sx camera) + Y * py (sy camera);
     pz := pz (s0 camera) + X * pz (sx camera) + Y * pz (sy camera) |}.

Definition turned (P : Plane) (value : Q) : Q :=
  match side_of_eye P with
  | kNegative => - value
  | _ => value
  end.

Definition hit_point (P : Plane) (X Y : Q) : Point :=
  let s := image_point X Y in
  let p := turned P (at_eye P) in
  let r := turned P (value_at P s) in
  {| px := p * px s - r * px (eye camera);
     py := p * py s - r * py (eye camera);
     pz := p * pz s - r * pz (eye camera) |}.

Definition hit_weight (P : Plane) (X Y : Q) : Q :=
  turned P (at_eye P) -
  turned P (value_at P (image_point X Y)) * weight_of_eye camera.

Lemma value_of_combination : forall h s e w p r,
  value_of h {| px := p * px s - r * px e; py := p * py s - r * py e;
                pz := p * pz s - r * pz e |} (p - r * w) ==
  p * value_at h s - r * value_of h e w.
Proof. intros; unfold value_of, value_at, dot, normal; simpl; ring. Qed.

(** A plane at that point has the value of S4.5. *)
Lemma hit_value : forall P h X Y,
  value_of h (hit_point P X Y) (hit_weight P X Y) ==
  at_image (oriented P (cut P h)) X Y.
Proof.
  intros P h X Y.
  assert (at_image (cut P h) X Y == at_eye P * value_at h (image_point X Y) -
          at_eye h * value_at P (image_point X Y)) as E.
  { unfold at_image, cut, add, scale, plane_at_image, value_at, dot, normal,
      image_point; simpl; ring. }
  assert (value_of h (hit_point P X Y) (hit_weight P X Y) ==
          turned P (at_eye P) * value_at h (image_point X Y) -
          turned P (value_at P (image_point X Y)) * at_eye h) as F.
  { apply value_of_combination. }
  rewrite F; unfold oriented, turned; destruct (side_of_eye P);
    rewrite ?E; try ring.
  assert (at_image (negated (cut P h)) X Y == - at_image (cut P h) X Y) as ->.
  { unfold at_image, negated, scale; simpl; ring. }
  rewrite E; ring.
Qed.

(** The planes of all points, and of the points at infinity. *)
Definition weight_plane : Plane := {| pa := 0; pb := 0; pc := 0; pd := 1 |}.

(** A ray that sees a fragment meets it in a point inside, which is on the side
    of every plane that the sample tells, of any number of planes. *)
Theorem hit_is_a_point : forall f planes, valid f -> covers f = true ->
  exists p, inside f p /\
  forall h, In h planes -> side_of h p = side_at f h.
Proof.
  intros f planes V C; set (P := support f) in *.
  unfold covers in C; rewrite !andb_true_iff in C; destruct C as [_ C].
  rewrite Sample.covers_all in C.
  destruct (sample_is_a_point
    (map (fun e => oriented P (cut P e)) (planes ++ edges f)) i j)
    as (t & T & K).
  set (X := centre i + t) in *; set (Y := centre j + t * t) in *.
  set (q := hit_point P X Y); set (w := hit_weight P X Y).
  assert (forall e, In e (planes ++ edges f) ->
          sign (value_of e q w) = side_at f e) as S.
  { intros e I; unfold side_at; fold P.
    rewrite <- (K (oriented P (cut P e))) by
      (apply in_map_iff; exists e; auto).
    apply sign_proper; unfold q, w; apply hit_value. }
  assert (forall e, In e (edges f) -> 0 < value_of e q w) as E.
  { intros e I; apply sign_positive; rewrite S by (apply in_or_app; auto).
    apply C; apply in_map_iff; exists e; auto. }
  assert (0 < w) as W by exact (valid_bounded f q w V E).
  set (p := {| px := px q / w; py := py q / w; pz := pz q / w |}).
  assert (forall k, value_of k q w == w * value_at k p) as R.
  { intros k; unfold value_of, value_at, dot, normal, p; simpl; field; lra. }
  exists p; split; [split|].
  - fold P; assert (value_of P q w == 0) as Z.
    { unfold q, w; rewrite hit_value.
      assert (forall X Y, at_image (cut P P) X Y == 0) as Z.
      { intros; unfold at_image, cut, add, scale; simpl; ring. }
      unfold oriented; destruct (side_of_eye P); rewrite ?Z; try reflexivity.
      assert (at_image (negated (cut P P)) X Y == - at_image (cut P P) X Y)
        as -> by (unfold at_image, negated, scale; simpl; ring).
      rewrite Z; ring. }
    rewrite R in Z; apply Qmult_integral in Z; destruct Z; [lra | assumption].
  - intros e I; specialize (E e I); rewrite R in E.
    destruct (Qlt_le_dec 0 (value_at e p)) as [L | L]; [exact L|].
    exfalso; nra.
  - intros h I; rewrite <- (S h) by (apply in_or_app; auto).
    unfold side_of; pose proof (R h) as Rh.
    destruct (sign_cases (value_at h p)) as [[-> L] | [[-> L] | [-> L]]];
      symmetry.
    + apply sign_negative; nra.
    + apply sign_on; rewrite Rh, L; ring.
    + apply sign_positive; nra.
Qed.

(** What is not negative at a fragment's vertices is not negative where a ray
    meets it. *)
Lemma hit_between_vertices : forall f h, valid f -> covers f = true ->
  (forall v, In v (vertices f) -> 0 <= value_at h v) ->
  side_at f h <> kNegative.
Proof.
  intros f h V C H S.
  destruct (hit_is_a_point f [h] V C) as (p & I & K).
  specialize (K h (or_introl eq_refl)); rewrite S in K.
  apply sign_negative in K; pose proof (valid_hull f p h V I H); lra.
Qed.

Lemma side_at_reversed : forall f h,
  side_at f (reversed h) = opposite (side_at f h).
Proof.
  intros f h; unfold side_at; rewrite <- sign_at_sample_negated.
  assert (at_eye (reversed h) == - at_eye h) as E.
  { unfold at_eye, value_of, dot, normal, reversed; simpl; ring. }
  unfold oriented; destruct (side_of_eye (support f));
    apply sign_at_sample_proper;
    unfold cut, add, negated, scale, plane_at_image, value_at, dot, normal;
    simpl; rewrite E; ring.
Qed.

(** S2.1, S4.5: the relation of a fragment to a plane says on which side of the
    plane every ray meets it. *)
Theorem relation_side_at : forall f s, valid f -> covers f = true ->
  match relation f s with
  | rPositive => side_at f (plane s) = kPositive
  | rNegative => side_at f (plane s) = kNegative
  | rCoincident => side_at f (plane s) = kOn
  | rSpanning => True
  end.
Proof.
  intros f s V C; set (h := plane s).
  assert (forall k, (forall v, In v (vertices f) -> 0 <= value_at k v) ->
          side_at f k <> kNegative) as H.
  { intros k; now apply hit_between_vertices. }
  assert ((forall v, In v (vertices f) -> value_at h v <= 0) ->
          side_at f h <> kPositive) as H'.
  { intros L; specialize (H (reversed h)); rewrite side_at_reversed in H.
    destruct (side_at f h); simpl in H; try easy.
    exfalso; apply H; [|reflexivity].
    intros v I; rewrite value_at_reversed; specialize (L v I); lra. }
  specialize (H h); pose proof (off_plane f h) as O.
  pose proof (relation_vertices f s) as R; fold h in R.
  destruct (relation f s); auto.
  - destruct R as [R (v & I & L)]; specialize (H R).
    specialize (O v V C I ltac:(lra)).
    destruct (side_at f h); congruence.
  - destruct R as [R (v & I & L)]; specialize (H' R).
    specialize (O v V C I ltac:(lra)).
    destruct (side_at f h); congruence.
  - assert (forall v, In v (vertices f) -> 0 <= value_at h v) as A.
    { intros v I; rewrite (R v I); lra. }
    assert (forall v, In v (vertices f) -> value_at h v <= 0) as B.
    { intros v I; rewrite (R v I); lra. }
    specialize (H A); specialize (H' B); destruct (side_at f h); congruence.
Qed.

Lemma side_at_part : forall side f s k,
  side_at (part side f s) k = side_at f k.
Proof.
  intros; unfold side_at.
  change (support (part side f s)) with (support f); reflexivity.
Qed.

(** A part covers what its fragment covers on its side of the splitter: the
    edges that it lost have nothing of it outside. *)
Lemma part_covers : forall side f s, valid f -> side <> kOn ->
  relation f s = rSpanning ->
  covers (part side f s) = true <->
  covers f = true /\ side_at f (toward side (plane s)) = kPositive.
Proof.
  intros side f s V N R.
  assert (valid (part side f s)) as W.
  { destruct (split_valid f s V R); destruct side; easy. }
  destruct (spanning_both side f s N R) as [(u & U & Lu) _].
  pose proof (Scene.part_keeps side f s u V N R U Lu) as Iu.
  split.
  - intros C.
    assert (forall k, (forall v, In v (vertices (part side f s)) ->
            0 <= value_at k v) ->
            (exists v, In v (vertices (part side f s)) /\ 0 < value_at k v) ->
            side_at f k = kPositive) as K.
    { intros k H (v & I & L).
      pose proof (side_at_part side f s k) as E.
      pose proof (hit_between_vertices _ k W C H) as A.
      pose proof (off_plane _ k v W C I ltac:(lra)) as B.
      rewrite E in A, B; destruct (side_at f k); easy. }
    split.
    + rewrite covers_edges in C; rewrite covers_edges.
      destruct C as (C1 & C2 & C3 & C4); repeat split; auto.
      intros e E; apply edges_are in E; destruct E as (p & q & E & ->).
      assert (forall v, In v (vertices (part side f s)) ->
              0 <= value_at (edge_plane (support f) p q) v) as H.
      { intros v I; destruct (part_vertex side f s v V N R I) as
          (_ & a & b & t & F & T & A & _).
        exact (at_edge_area (support f) (vertices f) V p q a b t v E F T A). }
      apply K; [exact H|].
      (* else the part would be on one line *)
      destruct (ok_area _ _ W) as (a & b & v & Eab & Iv & L).
      destruct (round_ends _ _ _ Eab) as [Ia Ib].
      destruct (Qlt_le_dec 0 (value_at (edge_plane (support f) p q) a));
        [exists a; auto|].
      destruct (Qlt_le_dec 0 (value_at (edge_plane (support f) p q) b));
        [exists b; auto|].
      destruct (Qlt_le_dec 0 (value_at (edge_plane (support f) p q) v));
        [exists v; auto|].
      exfalso; pose proof (H a Ia); pose proof (H b Ib); pose proof (H v Iv).
      destruct (edge_planar (support f) (vertices f) V p q E) as [Pp Pq].
      pose proof (valid_normal f V) as Nz.
      destruct (point_beside (support f) p q Nz Pp Pq (ok_apart _ _ V p q E))
        as (z & Z & M).
      pose proof (four_points (support f) (edge_plane (support f) p q) a b v z
        Nz (ok_planar _ _ W a Ia) (ok_planar _ _ W b Ib)
        (ok_planar _ _ W v Iv) Z) as D.
      assert (value_at (edge_plane (support f) p q) a == 0) as Za by lra.
      assert (value_at (edge_plane (support f) p q) b == 0) as Zb by lra.
      assert (value_at (edge_plane (support f) p q) v == 0) as Zv by lra.
      rewrite Za, Zb, Zv in D.
      assert (area (support f) a b v * area (support f) p q z == 0) as D'.
      { unfold area at 2; lra. }
      apply Qmult_integral in D'; destruct D' as [D' | D'];
        [|contradiction].
      unfold area in D'; change (support (part side f s)) with (support f) in L.
      lra.
    + apply K; [|exists u; auto].
      intros v I; now destruct (part_vertex side f s v V N R I).
  - intros [C S]; rewrite covers_edges in C |- *.
    destruct C as (C1 & C2 & C3 & C4); repeat split; auto.
    intros e E; apply edges_are in E; destruct E as (a & b & E & ->).
    destruct (Scene.part_edge side f s a b V N R E) as (c & k & C & K & H).
    assert (covers f = true) as Cf by (apply covers_edges; auto).
    destruct (hit_is_a_point f [edge_plane (support f) a b; k] V Cf)
      as (p & [P _] & Q).
    rewrite side_at_part; change (support (part side f s)) with (support f).
    rewrite <- (Q (edge_plane (support f) a b)) by now left.
    assert (side_of k p = kPositive) as Sk.
    { rewrite (Q k) by (right; now left).
      destruct K as [K | ->]; [now apply C4 | exact S]. }
    apply sign_positive in Sk; apply sign_positive; rewrite (H p P); nra.
Qed.

(** S4.L8: every sample of a fragment is in exactly one of its parts, on that
    part's side of the splitter. *)
Theorem split_covers : forall f s, valid f -> relation f s = rSpanning ->
  covers f = xorb (covers (fst (split f s))) (covers (snd (split f s))) /\
  (covers (fst (split f s)) = true -> side_at f (plane s) = kPositive) /\
  (covers (snd (split f s)) = true -> side_at f (plane s) = kNegative).
Proof.
  intros f s V R; unfold split; cbn [fst snd].
  pose proof (part_covers kPositive f s V ltac:(discriminate) R) as P.
  pose proof (part_covers kNegative f s V ltac:(discriminate) R) as N.
  cbn [toward] in P, N; rewrite side_at_reversed in N.
  pose proof (relation_vertices f s) as Q; rewrite R in Q.
  destruct Q as [(v & I & L) _].
  assert (covers f = true -> side_at f (plane s) <> kOn) as O.
  { intros C; apply (off_plane f (plane s) v V C I); lra. }
  destruct (covers (part kPositive f s)), (covers (part kNegative f s)),
    (covers f), (side_at f (plane s)); simpl in *; intuition congruence.
Qed.

(** ** The order of depths *)

(** The value of [h] where the ray meets [P], but for a positive factor. *)
Definition toward (P h : Plane) : Affine :=
  add (plane_at_image h) (scale (at_eye h) (nearness P)).

Lemma side_at_toward : forall f h, covers f = true ->
  side_at f h = sign_at_sample (toward (support f) h) i j.
Proof.
  intros f h C; unfold side_at; set (P := support f) in *.
  assert (side_of_eye P <> kOn) as N.
  { unfold covers in C; fold P in C; rewrite !andb_true_iff in C.
    destruct C as [[[C _] _] _]; intros E; now rewrite E in C. }
  unfold oriented, side_of_eye in *.
  destruct (sign_cases (at_eye P)) as [[E L] | [[E L] | [E L]]];
    rewrite E in *; try easy.
  - rewrite <- (sample_of_multiple (- at_eye P) (toward P h)) by lra.
    apply sign_at_sample_proper; unfold negated, cut, toward, nearness, add,
      scale; cbn [value dx dy]; revert L;
      generalize (at_eye P) (at_eye h) (plane_at_image P) (plane_at_image h);
      intros p q F G L; field; lra.
  - rewrite <- (sample_of_multiple (at_eye P) (toward P h)) by lra.
    apply sign_at_sample_proper; unfold cut, toward, nearness, add, scale;
      cbn [value dx dy]; revert L;
      generalize (at_eye P) (at_eye h) (plane_at_image P) (plane_at_image h);
      intros p q F G L; field; lra.
Qed.

Lemma difference_positive : forall f g,
  sign_at_sample f i j <> kNegative -> sign_at_sample g i j <> kPositive ->
  sign_at_sample f i j <> sign_at_sample g i j ->
  sign_at_sample (subtract f g) i j = kPositive.
Proof.
  intros f g; pose proof (sign_at_sample_negated g i j) as N.
  destruct (sign_at_sample f i j) eqn:F; destruct (sign_at_sample g i j) eqn:G;
    try easy; intros _ _ _; simpl in N.
  - apply sample_never_on in F; destruct F as (A & B & C).
    rewrite <- N; apply sign_at_sample_proper; unfold subtract, add;
      cbn [value dx dy]; rewrite ?A, ?B, ?C; ring.
  - now apply sample_of_sum.
  - apply sample_never_on in G; destruct G as (A & B & C).
    rewrite <- F; apply sign_at_sample_proper; unfold subtract, add, negated,
      scale; cbn [value dx dy]; rewrite ?A, ?B, ?C; ring.
Qed.

Lemma subtract_opposite : forall f g,
  sign_at_sample (subtract g f) i j =
  opposite (sign_at_sample (subtract f g) i j).
Proof.
  intros f g; rewrite <- sign_at_sample_negated; apply sign_at_sample_proper;
    unfold subtract, add, negated, scale; cbn [value dx dy]; ring.
Qed.

Theorem nearer_asymmetric : forall f g,
  is_nearer f g = true -> is_nearer g f = false.
Proof.
  intros f g; unfold is_nearer; rewrite subtract_opposite.
  destruct (sign_at_sample _ i j); easy.
Qed.

Theorem not_nearer_transitive : forall f g h,
  is_nearer f g = false -> is_nearer g h = false -> is_nearer f h = false.
Proof.
  intros f g h; unfold is_nearer.
  generalize (nearness (support f)) (nearness (support g))
    (nearness (support h)); intros F G H A B.
  destruct (side_eqb (sign_at_sample (subtract F H) i j) kPositive) eqn:C;
    [exfalso | reflexivity].
  apply side_eqb_eq in C.
  (* H - G would be above F - G, which is not positive. *)
  assert (sign_at_sample (subtract (subtract F G) (subtract H G)) i j =
          kPositive) as D.
  { rewrite <- C; apply sign_at_sample_proper; unfold subtract, add, negated,
      scale; cbn [value dx dy]; ring. }
  assert (sign_at_sample (subtract (subtract H G) (subtract F G)) i j <>
          kPositive) as E.
  { rewrite subtract_opposite, D; easy. }
  pose proof (subtract_opposite G H) as S.
  destruct (sign_at_sample (subtract F G) i j) eqn:X; try easy;
    destruct (sign_at_sample (subtract G H) i j) eqn:Y; try easy;
    simpl in S; try (apply E, difference_positive; rewrite ?X, ?S; easy).
  apply sample_never_on in X; apply sample_never_on in Y.
  assert (sign_at_sample (subtract F H) i j = kOn); [|congruence].
  apply sample_never_on; revert X Y; unfold is_zero, subtract, add, negated,
    scale; cbn [value dx dy]; intros (X1 & X2 & X3) (Y1 & Y2 & Y3).
  repeat split; lra.
Qed.

(** S3.7: the ray crosses a plane once, from the eye's side to the other; so
    what it meets on the eye's side is nearer. *)
Theorem nearer_side : forall f g h,
  covers f = true -> covers g = true ->
  side_of_eye h <> kOn -> side_at f h <> opposite (side_of_eye h) ->
  side_at g h <> side_of_eye h -> side_at f h <> side_at g h ->
  is_nearer g f = false /\ is_nearer f g = true.
Proof.
  intros f g h Cf Cg; rewrite (side_at_toward f h Cf), (side_at_toward g h Cg).
  intros N F G D.
  assert (is_nearer f g = true) as R; [|auto using nearer_asymmetric].
  unfold is_nearer; apply side_eqb_eq; unfold side_of_eye in *.
  destruct (sign_cases (at_eye h)) as [[E L] | [[E L] | [E L]]];
    rewrite E in *; simpl in *; try easy.
  - rewrite <- (sample_of_multiple (- at_eye h)) by lra.
    rewrite <- (difference_positive (toward (support g) h)
                  (toward (support f) h)) by auto.
    apply sign_at_sample_proper; unfold toward, subtract, negated, add, scale;
      cbn [value dx dy]; ring.
  - rewrite <- (sample_of_multiple (at_eye h)) by lra.
    rewrite <- (difference_positive (toward (support f) h)
                  (toward (support g) h)) by auto.
    apply sign_at_sample_proper; unfold toward, subtract, negated, add, scale;
      cbn [value dx dy]; ring.
Qed.

(** What lies on one plane is met at one depth. *)
Theorem both_on : forall f g h,
  covers f = true -> covers g = true ->
  side_of_eye h <> kOn -> side_at f h = kOn -> side_at g h = kOn ->
  is_nearer f g = false.
Proof.
  intros f g h Cf Cg; rewrite (side_at_toward f h Cf), (side_at_toward g h Cg).
  intros N F G; apply sample_never_on in F; apply sample_never_on in G.
  assert (~ at_eye h == 0) as Z by (intros Z; now apply N, sign_on).
  unfold is_nearer.
  assert (sign_at_sample (subtract (nearness (support f))
            (nearness (support g))) i j = kOn) as ->; [|reflexivity].
  apply sample_never_on; revert F G; unfold is_zero, toward, subtract, add,
    negated, scale; cbn [value dx dy].
  generalize (nearness (support f)) (nearness (support g)); intros A B.
  intros (X1 & X2 & X3) (Y1 & Y2 & Y3).
  assert (forall p q r, p + at_eye h * q == 0 -> p + at_eye h * r == 0 ->
          q + - (1) * r == 0) as R.
  { intros p q r S T.
    assert (at_eye h * (q + - (1) * r) == 0) as U by lra.
    apply Qmult_integral in U; tauto. }
  repeat split; eapply R; eauto.
Qed.

(** With the eye on a plane every ray stays on one side of it, and off it. *)
Theorem eye_on_plane : forall f g h, not_zero h ->
  covers f = true -> covers g = true ->
  side_of_eye h = kOn -> side_at f h <> kOn /\ side_at f h = side_at g h.
Proof.
  intros f g h Z Cf Cg E; apply sign_on in E.
  assert (forall k, covers k = true ->
          side_at k h = sign_at_sample (plane_at_image h) i j) as S.
  { intros k Ck; rewrite (side_at_toward k h Ck).
    apply sign_at_sample_proper; unfold toward, add, scale; cbn [value dx dy];
      rewrite E; ring. }
  rewrite (S f Cf), (S g Cg); split; [|reflexivity].
  intros O; apply sample_never_on in O.
  destruct (camera_spans h O E) as (A & B & C & _); apply Z; auto.
Qed.

End View.
