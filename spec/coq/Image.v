(** * S3, S5.5: trees have the points of their scenes, and the algorithms agree.

    The programs of [Tree.v] and [Order.v] with the polygons of [Scene.v] and
    the cameras of [View.v]: nothing is left to be assumed. *)

From Coq Require Import QArith Lia List Permutation.
From Halfspace Require Import Base Convex Tree Order Scene View.
From Halfspace Require Spans Split.
Import ListNotations.

Section Image.

Variable camera : Camera.
Hypothesis ok : camera_ok camera.
Variable options : Options.
(** The pixel. *)
Variables i j : Z.

Local Notation side_of_eye := (fun s => View.side_of_eye camera (plane s)).
Local Notation covers := (View.covers camera options i j).
Local Notation side_at := (fun f s => View.side_at camera i j f (plane s)).
Local Notation plane_ok := (fun s => not_zero (plane s)).
Local Notation is_nearer := (View.is_nearer camera i j).

Definition Tree := BspTree Fragment Splitter.

(** S3.5, S3.6, with this file's fragments. *)
Definition build_scene (choose_root : list Side -> list Fragment -> nat)
  (scene : Scene) : Tree :=
  Tree.build Fragment Splitter splitter_of relation split choose_root
    (polygons_of scene).

Definition insert_scene (polygons : list Fragment) : Tree :=
  Tree.insert_all Fragment Splitter source splitter_of relation split polygons
    Nothing.

(** ** Trees have the points of their scenes *)

Definition has (r : Point) (f : Fragment) : Prop := Split.inside (vertices f) r.

Lemma split_has : forall r f s, valid f -> relation f s = rSpanning ->
  (has r f <-> has r (fst (split f s)) \/ has r (snd (split f s))).
Proof.
  intros r f s V R.
  apply (Split.parts_make_up_the_polygon (shape f) (plane s) (splitter s) r).
  exact (parts_share_all_of_the_section (support f) (plane s) (shape f)
           (valid_normal f V) V R (splitter s)).
Qed.

(** S3.5: a built tree loses and invents no point of space. *)
Theorem built_tree_has_the_points : forall choose_root scene r,
  scene_ok scene ->
  Exists (has r) (fragments (build_scene choose_root scene)) <->
  Exists (has r) (polygons_of scene).
Proof.
  intros choose_root scene r O.
  apply (build_has Fragment Splitter source splitter_of relation split
    choose_root valid own_plane split_valid (has r) (split_has r)).
  now apply polygons_valid.
Qed.

(** S3.6: nor does a tree made by insertion, in any order. *)
Theorem inserted_tree_has_the_points : forall scene polygons r,
  scene_ok scene -> Permutation polygons (polygons_of scene) ->
  Exists (has r) (fragments (insert_scene polygons)) <->
  Exists (has r) (polygons_of scene).
Proof.
  intros scene polygons r O P; unfold insert_scene.
  rewrite (insert_all_has Fragment Splitter source splitter_of relation split
    valid split_valid (has r) (split_has r)).
  - simpl; rewrite Exists_nil, !Exists_exists.
    split; [intros [(f & I & H) | []] | intros (f & I & H); left]; exists f;
      split; auto; [now apply (Permutation_in f P)|].
    now apply (Permutation_in f (Permutation_sym P)).
  - apply Forall_forall; intros f F.
    pose proof (polygons_valid scene O) as V; rewrite Forall_forall in V.
    apply V; now apply (Permutation_in f P).
Qed.

(** ** What a pixel shows *)

(** S5.5: what the four programs show at the pixel. *)
Definition render (tree : Tree) : option Z :=
  render_pixel Fragment source covers
    (front_to_back Fragment Splitter side_of_eye tree).

Definition paint (tree : Tree) : option Z :=
  paint_pixel Fragment source covers
    (back_to_front Fragment Splitter side_of_eye tree).

Definition zbuffer (polygons : list Fragment) : option Z :=
  zbuffer_pixel Fragment source covers is_nearer polygons.

Definition raycast (polygons : list Fragment) : option Z :=
  raycast_pixel Fragment source covers is_nearer polygons.

(** S5.1: the pixel of the item image. *)
Definition seen (polygons : list Fragment) (pixel : option Z) : Prop :=
  item Fragment source covers is_nearer polygons pixel.

Definition tree_of_scene (polygons : list Fragment) (tree : Tree) : Prop :=
  tree_of Fragment Splitter source valid plane_ok covers side_at is_nearer
    polygons tree.

Lemma polygons_in_order : forall scene,
  in_order Fragment source (polygons_of scene).
Proof.
  unfold polygons_of, in_order; generalize 0%Z; intros id scene; revert id.
  assert (forall scene id least, (least <= id)%Z ->
          Forall (fun f => (least <= source f)%Z) (polygons_from id scene))
    as L.
  { clear; induction scene as [|[plane corners] scene IH]; intros id least H;
      [constructor|].
    constructor; [exact H | apply IH; lia]. }
  induction scene as [|[plane corners] scene IH]; intros id; [constructor|].
  constructor; [apply IH|].
  apply (L scene (id + 1)%Z (source (whole id plane corners))).
  change (id <= id + 1)%Z; lia.
Qed.

Lemma splitter_ok : forall f, valid f -> not_zero (plane (splitter_of f)).
Proof. exact valid_normal. Qed.

Lemma split_source : forall f h,
  source (fst (split f h)) = source f /\ source (snd (split f h)) = source f.
Proof. split; reflexivity. Qed.

Lemma split_side_at : forall f h k,
  side_at (fst (split f h)) k = side_at f k /\
  side_at (snd (split f h)) k = side_at f k.
Proof. intros; split; apply side_at_part. Qed.

Lemma split_nearer : forall f h g,
  is_nearer (fst (split f h)) g = is_nearer f g /\
  is_nearer (snd (split f h)) g = is_nearer f g /\
  is_nearer g (fst (split f h)) = is_nearer g f /\
  is_nearer g (snd (split f h)) = is_nearer g f.
Proof.
  intros f s g; unfold View.is_nearer, split; cbn [fst snd part support]; auto.
Qed.

(** S3.5: a built tree is one of its scene, however roots are chosen. *)
Theorem build_scene_tree : forall choose_root scene, scene_ok scene ->
  tree_of_scene (polygons_of scene) (build_scene choose_root scene).
Proof.
  intros choose_root scene O.
  apply (build_tree_of Fragment Splitter source splitter_of relation split valid
    plane_ok covers side_at is_nearer own_plane splitter_ok split_valid
    split_source split_side_at
    (View.split_covers camera ok options i j)
    (View.relation_side_at camera ok options i j) split_nearer).
  - now apply polygons_valid.
  - apply polygons_in_order.
Qed.

(** S3.6: and so is one made by insertion, in any order. *)
Theorem insert_scene_tree : forall scene polygons, scene_ok scene ->
  Permutation polygons (polygons_of scene) ->
  tree_of_scene (rev polygons) (insert_scene polygons).
Proof.
  intros scene polygons O P.
  apply (insert_all_tree_of Fragment Splitter source splitter_of relation split
    valid
    plane_ok covers side_at is_nearer own_plane splitter_ok split_valid
    split_source split_side_at
    (View.split_covers camera ok options i j)
    (View.relation_side_at camera ok options i j) split_nearer).
  apply Forall_forall; intros f F.
  pose proof (polygons_valid scene O) as V; rewrite Forall_forall in V.
  apply V; now apply (Permutation_in f P).
Qed.

Lemma trees_agree : forall polygons others tree,
  tree_of_scene polygons tree -> Permutation polygons others ->
  render tree = paint tree /\ render tree = zbuffer others.
Proof.
  intros polygons others tree T P.
  destruct (algorithms_agree Fragment Splitter source side_of_eye valid plane_ok
    covers side_at is_nearer
    (fun f g s _ _ => nearer_side camera options i j f g (plane s))
    (fun f g s _ _ => both_on camera options i j f g (plane s))
    (fun f g s _ _ => eye_on_plane camera ok options i j f g (plane s))
    (nearer_asymmetric camera i j)
    (not_nearer_transitive camera i j) polygons others tree T P) as (A & B & _).
  split; assumption.
Qed.

(** S5.5: for every scene, every camera that is one, every choice of roots and
    every pixel: front to back with the first writer, back to front with the
    last, z-buffer in any order of the polygons, and nearest hit agree. *)
Theorem image_of_built_tree : forall choose_root scene others,
  scene_ok scene -> Permutation (polygons_of scene) others ->
  let tree := build_scene choose_root scene in
  render tree = paint tree /\
  render tree = zbuffer others /\
  render tree = raycast (polygons_of scene) /\
  seen (polygons_of scene) (render tree).
Proof.
  intros choose_root scene others O P tree.
  pose proof (build_scene_tree choose_root scene O) as T; fold tree in T.
  destruct (trees_agree _ others tree T P) as [A B].
  destruct (trees_agree _ (polygons_of scene) tree T (Permutation_refl _))
    as [_ C].
  split; [exact A|]; split; [exact B|].
  assert (zbuffer (polygons_of scene) = raycast (polygons_of scene)) as R.
  { symmetry; apply raycast_is_zbuffer, polygons_in_order. }
  split; [congruence|]; rewrite C; unfold zbuffer, seen.
  apply zbuffer_is_item;
    [exact (nearer_asymmetric camera i j) |
     exact (not_nearer_transitive camera i j)].
Qed.

(** The same of a tree made by insertion, in any order: so the image does not
    depend on the tree. *)
Theorem image_of_inserted_tree : forall choose_root scene polygons,
  scene_ok scene -> Permutation polygons (polygons_of scene) ->
  render (insert_scene polygons) = paint (insert_scene polygons) /\
  render (insert_scene polygons) = render (build_scene choose_root scene).
Proof.
  intros choose_root scene polygons O P.
  pose proof (insert_scene_tree scene polygons O P) as T.
  assert (Permutation (rev polygons) (polygons_of scene)) as R.
  { rewrite <- P; symmetry; apply Permutation_rev. }
  destruct (trees_agree _ _ _ T R) as [A B]; split; [exact A|].
  destruct (image_of_built_tree choose_root scene (polygons_of scene) O
              (Permutation_refl _)) as (_ & C & _).
  congruence.
Qed.

(** S3.7: front to back no fragment is hidden by a later one. *)
Theorem scene_front_to_back : forall choose_root scene, scene_ok scene ->
  ForallOrdPairs (not_hidden Fragment source covers is_nearer)
    (front_to_back Fragment Splitter side_of_eye
       (build_scene choose_root scene)).
Proof.
  intros choose_root scene O.
  destruct (build_scene_tree choose_root scene O) as (S & V & _).
  apply (front_to_back_order Fragment Splitter source side_of_eye valid plane_ok
    covers side_at is_nearer
    (fun f g s _ _ => nearer_side camera options i j f g (plane s))
    (fun f g s _ _ => both_on camera options i j f g (plane s))
    (fun f g s _ _ => eye_on_plane camera ok options i j f g (plane s)) _ S V).
Qed.

End Image.

(** ** Whole lines *)

Section Line.

Variable camera : Camera.
Variable options : Options.
(** The line of pixels, and how many it has. *)
Variables j width : Z.
(** S4.6: the object segments that scan conversion gives of a fragment on the
    line, whatever finds them. *)
Variable segments : Fragment -> list Spans.Span.
Hypothesis segments_sorted : forall f, Spans.sorted (segments f).
Hypothesis segments_cover : forall f i, (0 <= i < width)%Z ->
  (Spans.covered i (segments f) <-> View.covers camera options i j f = true).

(** S4.8, S5.5: merging front to back fills every pixel of the line with what
    the tree shows at its sample, and leaves the others as they were. *)
Theorem merged_line_is_the_image : forall tree line i, (0 <= i < width)%Z ->
  Spans.render_line
    (map (fun f => (source f, segments f))
       (front_to_back Fragment Splitter
          (fun s => View.side_of_eye camera (plane s)) tree))
    (Spans.whole_line width) line i =
  match render camera options i j tree with
  | Some id => id
  | None => line i
  end.
Proof.
  intros tree line i I; rewrite Spans.line_front_to_back_is_painter; [|
    apply Forall_forall; intros s S; apply in_map_iff in S;
    destruct S as (f & <- & _); apply segments_sorted | exact I].
  rewrite <- map_rev; unfold render.
  rewrite <- first_writer_is_last; unfold paint_pixel.
  generalize (rev (front_to_back Fragment Splitter
    (fun s => View.side_of_eye camera (plane s)) tree)); intros l.
  assert (forall seen m, m i = match seen with
                               | Some id => id
                               | None => line i
                               end ->
    Spans.paint_line (map (fun f => (source f, segments f)) l) m i =
    match fold_left (fun pixel f =>
      if View.covers camera options i j f then Some (source f) else pixel)
      l seen with
    | Some id => id
    | None => line i
    end) as H; [|now apply H].
  unfold Spans.paint_line; induction l as [|f l IH]; intros seen m M;
    [exact M|].
  simpl; apply IH; unfold Spans.paint.
  pose proof (segments_cover f i I) as C.
  rewrite <- Spans.inside_covered in C.
  destruct (existsb (Spans.inside i) (segments f)),
    (View.covers camera options i j f); auto; exfalso; intuition congruence.
Qed.

End Line.
