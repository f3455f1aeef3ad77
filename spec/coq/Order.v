(** * S3.7, S5.5: the orders that a tree gives, and what a pixel shows.

    The traversals are those of [ref/src/traverse.cpp], and the four programs
    for one pixel those of [render.cpp], [painter.cpp], [zbuffer.cpp] and
    [raycast.cpp]. Everything happens at one sample: [covers] says which
    fragments cover it, and [side_at] on which side of a plane the sample's ray
    meets a fragment. [View.v] defines both for polygons in space, and proves
    what is asked of them here; [Image.v] puts the two together. *)

From Coq Require Import ZArith Lia List Bool Permutation Sorted.
From Halfspace Require Import Base Tree.
Import ListNotations.
Open Scope list_scope.

Section Order.

Variables Fragment Plane : Type.
Variable source : Fragment -> Z.
Variable plane_of : Fragment -> Plane.
Variable relation : Fragment -> Plane -> Relation.
Variable split : Fragment -> Plane -> Fragment * Fragment.

(** S4.2: the eye's side of a plane. *)
Variable side_of_eye : Plane -> Side.

(** ** Traversal *)

(** What there is of the children of a node, the near one first. Where the eye
    is on the splitter, positive counts as near. *)
Definition children_of {A : Type} (eye : Side) (positive negative : A) : A * A
  :=
  match eye with
  | kNegative => (negative, positive)
  | _ => (positive, negative)
  end.

(** The node's fragments, which an eye on the splitter does not see. *)
Definition shown_of (eye : Side) (coincident : list Fragment) :=
  match eye with
  | kOn => []
  | _ => coincident
  end.

Fixpoint back_to_front (tree : BspTree Fragment Plane) : list Fragment :=
  match tree with
  | Nothing => []
  | Node plane coincident positive negative =>
    let eye := side_of_eye plane in
    let '(near, far) :=
      children_of eye (back_to_front positive) (back_to_front negative) in
    far ++ rev (shown_of eye coincident) ++ near
  end.

Fixpoint front_to_back (tree : BspTree Fragment Plane) : list Fragment :=
  match tree with
  | Nothing => []
  | Node plane coincident positive negative =>
    let eye := side_of_eye plane in
    let '(near, far) :=
      children_of eye (front_to_back positive) (front_to_back negative) in
    near ++ shown_of eye coincident ++ far
  end.

(** The fragments in nodes whose splitter holds the eye. *)
Fixpoint edge_on (tree : BspTree Fragment Plane) : list Fragment :=
  match tree with
  | Nothing => []
  | Node plane coincident positive negative =>
    match side_of_eye plane with kOn => coincident | _ => [] end ++
    edge_on positive ++ edge_on negative
  end.

Theorem back_to_front_is_reverse : forall tree,
  back_to_front tree = rev (front_to_back tree).
Proof.
  induction tree as [|h c p IHp n IHn]; simpl; [reflexivity|].
  rewrite IHp, IHn.
  destruct (side_of_eye h); simpl; now rewrite !rev_app_distr, <- ?app_assoc.
Qed.

Ltac exchange :=
  rewrite <- ?app_assoc; repeat apply Permutation_app_head;
  rewrite ?app_assoc; repeat apply Permutation_app_tail;
  apply Permutation_app_comm.

(** Every fragment is displayed once, but for those whose plane holds the
    eye. *)
Theorem displayed_once : forall tree,
  Permutation (front_to_back tree ++ edge_on tree) (fragments tree).
Proof.
  induction tree as [|h c p IHp n IHn]; simpl; [constructor|].
  rewrite <- IHp, <- IHn; clear IHp IHn.
  generalize (front_to_back p) (front_to_back n) (edge_on p) (edge_on n).
  intros fp fn ep en; destruct (side_of_eye h); simpl.
  - transitivity ((c ++ fp ++ fn) ++ ep ++ en); [|exchange].
    apply Permutation_app_tail.
    rewrite (Permutation_app_comm fn), <- app_assoc; reflexivity.
  - transitivity (c ++ (fp ++ fn) ++ ep ++ en); [|exchange].
    rewrite !(app_assoc _ c), (Permutation_app_comm _ c), <- app_assoc.
    reflexivity.
  - transitivity ((c ++ fp ++ fn) ++ ep ++ en); [|exchange].
    apply Permutation_app_tail.
    rewrite !app_assoc, (Permutation_app_comm fp c); reflexivity.
Qed.

(** ** What the geometry has to give, and [View.v] does *)

Variable valid : Fragment -> Prop.
Variable plane_ok : Plane -> Prop.

(** S4.5: whether the fragment covers the sample. *)
Variable covers : Fragment -> bool.
(** On which side of a plane the sample's ray meets the fragment's plane. *)
Variable side_at : Fragment -> Plane -> Side.
(** S5.3: whether the ray meets the first one's plane before the second's. *)
Variable is_nearer : Fragment -> Fragment -> bool.

Hypothesis own_plane : forall f, valid f ->
  relation f (plane_of f) = rCoincident.
Hypothesis plane_of_ok : forall f, valid f -> plane_ok (plane_of f).
Hypothesis split_valid : forall f h, valid f -> relation f h = rSpanning ->
  valid (fst (split f h)) /\ valid (snd (split f h)).
Hypothesis split_source : forall f h,
  source (fst (split f h)) = source f /\ source (snd (split f h)) = source f.
Hypothesis split_side_at : forall f h k,
  side_at (fst (split f h)) k = side_at f k /\
  side_at (snd (split f h)) k = side_at f k.
Hypothesis split_covers : forall f h, valid f -> relation f h = rSpanning ->
  covers f = xorb (covers (fst (split f h))) (covers (snd (split f h))) /\
  (covers (fst (split f h)) = true -> side_at f h = kPositive) /\
  (covers (snd (split f h)) = true -> side_at f h = kNegative).
Hypothesis relation_side_at : forall f h, valid f -> covers f = true ->
  match relation f h with
  | rPositive => side_at f h = kPositive
  | rNegative => side_at f h = kNegative
  | rCoincident => side_at f h = kOn
  | rSpanning => True
  end.
(** The ray comes from the eye's side of a plane, and crosses it once. *)
Hypothesis nearer_side : forall f g h,
  valid f -> valid g -> covers f = true -> covers g = true ->
  side_of_eye h <> kOn -> side_at f h <> opposite (side_of_eye h) ->
  side_at g h <> side_of_eye h -> side_at f h <> side_at g h ->
  is_nearer g f = false /\ is_nearer f g = true.
Hypothesis both_on : forall f g h,
  valid f -> valid g -> covers f = true -> covers g = true ->
  side_of_eye h <> kOn -> side_at f h = kOn -> side_at g h = kOn ->
  is_nearer f g = false.
(** With the eye on a plane, all is seen on one side of it. *)
Hypothesis eye_on_plane : forall f g h,
  valid f -> valid g -> plane_ok h -> covers f = true -> covers g = true ->
  side_of_eye h = kOn -> side_at f h <> kOn /\ side_at f h = side_at g h.

(** ** The sides of a tree *)

(** The fragment is on side [s] of the plane, as far as the sample tells. *)
Definition within (h : Plane) (s : Side) (f : Fragment) : Prop :=
  covers f = true -> side_at f h = s.

(** In order of id. *)
Definition in_order (l : list Fragment) : Prop :=
  StronglySorted (fun f g => (source f <= source g)%Z) l.

(** S3.1: what is in a node lies on its plane, what is below a node on its
    side; and a node's list is in order. *)
Fixpoint sides (tree : BspTree Fragment Plane) : Prop :=
  match tree with
  | Nothing => True
  | Node h c p n =>
    plane_ok h /\ in_order c /\ Forall (within h kOn) c /\
    Forall (within h kPositive) (fragments p) /\
    Forall (within h kNegative) (fragments n) /\
    sides p /\ sides n
  end.

Lemma split_covers_whole : forall f h, valid f -> relation f h = rSpanning ->
  (covers (fst (split f h)) = true -> covers f = true) /\
  (covers (snd (split f h)) = true -> covers f = true).
Proof.
  intros f h V R; destruct (split_covers f h V R) as (X & A & B).
  rewrite X; destruct (covers (fst (split f h))), (covers (snd (split f h)));
    simpl; split; auto.
  - intros _; rewrite A in B by auto; discriminate (B eq_refl).
  - intros _; rewrite A in B by auto; discriminate (B eq_refl).
Qed.

Lemma parts_within : forall k s f h, valid f -> within k s f ->
  relation f h = rSpanning ->
  within k s (fst (split f h)) /\ within k s (snd (split f h)).
Proof.
  intros k s f h V W R; destruct (split_covers_whole f h V R) as [A B].
  destruct (split_side_at f h k) as [C D]; unfold within in *.
  rewrite C, D; auto.
Qed.

Lemma distribute_within : forall l h c p n,
  distribute Fragment Plane relation split l h = (c, p, n) ->
  Forall valid l ->
  Forall (within h kOn) c /\ Forall (within h kPositive) p /\
  Forall (within h kNegative) n.
Proof.
  induction l as [|f l IH]; intros h c p n; simpl.
  - intros E _; injection E as <- <- <-; auto.
  - destruct (distribute _ _ _ _ l h) as [[c' p'] n'] eqn:D.
    intros E V; inversion V as [|? ? V1 V2]; subst.
    destruct (IH h c' p' n' D V2) as (A & B & C).
    pose proof (relation_side_at f h V1) as S.
    destruct (relation f h) eqn:R; injection E as <- <- <-; auto.
    destruct (split_covers f h V1 R) as (_ & P & Q).
    destruct (split_side_at f h h) as [P' Q'].
    repeat split; auto; constructor; auto; unfold within;
      rewrite ?P', ?Q'; auto.
Qed.

Lemma distribute_order : forall l h c p n,
  distribute Fragment Plane relation split l h = (c, p, n) ->
  Forall valid l -> in_order l -> in_order c /\ in_order p /\ in_order n.
Proof.
  unfold in_order; induction l as [|f l IH]; intros h c p n; simpl.
  - intros E _ _; injection E as <- <- <-; repeat split; constructor.
  - destruct (distribute _ _ _ _ l h) as [[c' p'] n'] eqn:D.
    intros E V O; inversion V as [|? ? V1 V2]; subst.
    inversion O as [|? ? O1 O2]; subst.
    destruct (IH h c' p' n' D V2 O1) as (A & B & C).
    destruct (distribute_forall Fragment Plane relation split valid
                (fun g => (source f <= source g)%Z)) with (l := l) (h := h)
      (c := c') (p := p') (n := n') as (A' & B' & C'); auto.
    { intros g k _ S _; destruct (split_source g k) as [-> ->]; auto. }
    destruct (split_source f h) as [P Q].
    destruct (relation f h) eqn:R; injection E as <- <- <-; repeat split;
      auto; constructor; rewrite ?P, ?Q; auto.
Qed.

Section Build.

Variable choose_root : list Side -> list Fragment -> nat.

Let built := build Fragment Plane plane_of relation split choose_root.

(** S3.5: built trees are sided, however roots are chosen. *)
Theorem build_sides : forall l, Forall valid l -> in_order l ->
  sides (built l).
Proof.
  intros l V O; unfold built, build; revert O.
  apply (build_induction Fragment Plane source plane_of relation split
           choose_root valid own_plane split_valid
           (fun l t => in_order l -> sides t)); auto; [intros _; exact I|].
  clear l V; intros l root c p n place m V I _ D C Lp Ln Hp Hn O; simpl.
  destruct (distribute_within _ _ _ _ _ D V) as (A1 & A2 & A3).
  destruct (distribute_order _ _ _ _ _ D V O) as (B1 & B2 & B3).
  destruct (distribute_valid Fragment Plane relation split valid split_valid
              _ _ _ _ _ D V) as (V1 & V2 & V3).
  assert (valid root) as Vr by (rewrite Forall_forall in V; auto).
  repeat split; auto;
    apply (build_at_forall Fragment Plane source plane_of relation split
             choose_root valid own_plane split_valid); auto;
    intros; apply parts_within; auto.
Qed.

End Build.

Lemma put_order : forall f l, in_order l ->
  in_order (put Fragment source f l).
Proof.
  unfold in_order; intros f; induction l as [|g l IH]; intros O; simpl.
  - repeat constructor.
  - inversion O as [|? ? O1 O2]; subst.
    destruct (Z.ltb_spec (source f) (source g)) as [L | L].
    + constructor; [exact O|]; constructor; [lia|].
      eapply Forall_impl; [|exact O2]; simpl; intros; lia.
    + constructor; [auto|].
      apply put_forall; auto.
Qed.

(** S3.6: insertion keeps trees sided. *)
Theorem insert_sides : forall tree f, valid f -> sides tree ->
  sides (insert Fragment Plane source plane_of relation split f tree).
Proof.
  induction tree as [|h c p IHp n IHn]; intros f V S; simpl.
  - repeat split; auto; try (repeat constructor; fail).
    constructor; [|constructor]; intros C.
    pose proof (relation_side_at f (plane_of f) V C) as R.
    now rewrite (own_plane f V) in R.
  - destruct S as (S1 & S2 & S3 & S4 & S5 & S6 & S7).
    pose proof (relation_side_at f h V) as Q.
    destruct (relation f h) eqn:R; simpl; repeat split; auto.
    + apply (insert_forall Fragment Plane source plane_of relation split valid
               split_valid); auto; intros; apply parts_within; auto.
    + apply (insert_forall Fragment Plane source plane_of relation split valid
               split_valid); auto; intros; apply parts_within; auto.
    + now apply put_order.
    + now apply put_forall.
    + destruct (split_covers f h V R) as (_ & P & _).
      destruct (split_side_at f h h) as [P' _].
      destruct (split_valid f h V R) as [V' _].
      apply (insert_forall Fragment Plane source plane_of relation split valid
               split_valid); auto; [intros; apply parts_within; auto|].
      unfold within; rewrite P'; exact P.
    + destruct (split_covers f h V R) as (_ & _ & P).
      destruct (split_side_at f h h) as [_ P'].
      destruct (split_valid f h V R) as [_ V'].
      apply (insert_forall Fragment Plane source plane_of relation split valid
               split_valid); auto; [intros; apply parts_within; auto|].
      unfold within; rewrite P'; exact P.
    + apply IHp; auto; now apply split_valid.
    + apply IHn; auto; now apply split_valid.
Qed.

(** ** Front to back, nothing is hidden by what comes later *)

(** S5.3: in front is what is nearer, and of equals the lowest id. *)
Definition before (f g : Fragment) : bool :=
  is_nearer f g || negb (is_nearer g f) && (source f <? source g)%Z.

(** [g] does not hide [f] at the sample. *)
Definition not_hidden (f g : Fragment) : Prop :=
  covers f = true -> covers g = true -> before g f = false.

Lemma ordered_app : forall l m,
  ForallOrdPairs not_hidden l -> ForallOrdPairs not_hidden m ->
  (forall f g, In f l -> In g m -> not_hidden f g) ->
  ForallOrdPairs not_hidden (l ++ m).
Proof.
  induction l as [|f l IH]; intros m L M H; simpl; [exact M|].
  inversion L as [|? ? L1 L2]; subst; constructor.
  - rewrite Forall_forall in *; intros g G; apply in_app_or in G.
    destruct G as [G | G]; [auto | apply H; simpl; auto].
  - apply IH; auto; intros; apply H; simpl; auto.
Qed.

Lemma front_to_back_in : forall tree f,
  In f (front_to_back tree) -> In f (fragments tree).
Proof.
  intros tree f H; apply (Permutation_in f (displayed_once tree)).
  apply in_or_app; auto.
Qed.

Lemma nearer_not_hidden : forall f g,
  (covers f = true -> covers g = true ->
   is_nearer g f = false /\ is_nearer f g = true) -> not_hidden f g.
Proof.
  intros f g H A B; destruct (H A B) as [C D]; unfold before.
  now rewrite C, D.
Qed.

(** S3.7: front to back, no fragment is hidden by a later one, wherever the eye
    is: on a splitter too. *)
Theorem front_to_back_order : forall tree,
  sides tree -> Forall valid (fragments tree) ->
  ForallOrdPairs not_hidden (front_to_back tree).
Proof.
  induction tree as [|h c p IHp n IHn]; intros S V; [constructor|].
  simpl in S, V; rewrite !Forall_app in V.
  destruct S as (S1 & S2 & S3 & S4 & S5 & S6 & S7), V as (V1 & V2 & V3).
  specialize (IHp S6 V2); specialize (IHn S7 V3).
  rewrite Forall_forall in S3, S4, S5, V1, V2, V3.
  unfold within in S3, S4, S5.
  assert (side_of_eye h <> kOn -> ForallOrdPairs not_hidden c) as Oc.
  { intros E; clear - S2 S3 V1 E both_on; induction c as [|f c IH];
      [constructor|].
    inversion S2 as [|? ? A B]; subst; constructor.
    - rewrite Forall_forall in *; intros g G Cf Cg; unfold before.
      assert (In f (f :: c) /\ In g (f :: c)) as [F' G'] by (simpl; auto).
      rewrite (both_on g f h), (both_on f g h); auto; simpl.
      apply Z.ltb_ge; auto.
    - apply IH; auto; intros; [apply S3 | apply V1]; simpl; auto. }
  simpl; destruct (side_of_eye h) eqn:E; simpl.
  - apply ordered_app; [exact IHn | apply ordered_app |].
    + apply Oc; congruence.
    + exact IHp.
    + intros f g F G; apply front_to_back_in in G; apply nearer_not_hidden.
      intros Cf Cg; apply (nearer_side f g h); auto;
        rewrite ?E, ?(S3 f F Cf), ?(S4 g G Cg); simpl; congruence.
    + intros f g F G; apply front_to_back_in in F; apply nearer_not_hidden.
      intros Cf Cg; apply in_app_or in G; destruct G as [G | G].
      * apply (nearer_side f g h); auto;
          rewrite ?E, ?(S5 f F Cf), ?(S3 g G Cg); simpl; congruence.
      * apply front_to_back_in in G; apply (nearer_side f g h); auto;
          rewrite ?E, ?(S5 f F Cf), ?(S4 g G Cg); simpl; congruence.
  - apply ordered_app; [exact IHp | exact IHn |].
    intros f g F G Cf Cg; apply front_to_back_in in F, G; exfalso.
    destruct (eye_on_plane f g h) as [_ X]; auto.
    rewrite (S4 f F Cf), (S5 g G Cg) in X; discriminate.
  - apply ordered_app; [exact IHp | apply ordered_app |].
    + apply Oc; congruence.
    + exact IHn.
    + intros f g F G; apply front_to_back_in in G; apply nearer_not_hidden.
      intros Cf Cg; apply (nearer_side f g h); auto;
        rewrite ?E, ?(S3 f F Cf), ?(S5 g G Cg); simpl; congruence.
    + intros f g F G; apply front_to_back_in in F; apply nearer_not_hidden.
      intros Cf Cg; apply in_app_or in G; destruct G as [G | G].
      * apply (nearer_side f g h); auto;
          rewrite ?E, ?(S4 f F Cf), ?(S3 g G Cg); simpl; congruence.
      * apply front_to_back_in in G; apply (nearer_side f g h); auto;
          rewrite ?E, ?(S4 f F Cf), ?(S5 g G Cg); simpl; congruence.
Qed.

(** What is in a node whose splitter holds the eye covers nothing. *)
Theorem edge_on_covers_nothing : forall tree,
  sides tree -> Forall valid (fragments tree) ->
  forall f, In f (edge_on tree) -> covers f = false.
Proof.
  induction tree as [|h c p IHp n IHn]; intros S V f F; [destruct F|].
  simpl in S, V, F; rewrite !Forall_app in V.
  destruct S as (S1 & S2 & S3 & S4 & S5 & S6 & S7), V as (V1 & V2 & V3).
  apply in_app_or in F; destruct F as [F | F].
  - destruct (side_of_eye h) eqn:E; [destruct F | | destruct F].
    rewrite Forall_forall in S3, V1.
    destruct (covers f) eqn:C; [exfalso | reflexivity].
    destruct (eye_on_plane f f h) as [N _]; auto.
    now apply N, (S3 f F).
  - apply in_app_or in F; destruct F; auto.
Qed.

(** ** S5.5: what one pixel shows *)

(** [render]: the first that covers the sample writes the pixel. *)
Definition render_pixel (shown : list Fragment) : option Z :=
  fold_left (fun pixel f =>
    match pixel with
    | Some _ => pixel
    | None => if covers f then Some (source f) else None
    end) shown None.

(** [paint]: the last that covers the sample has written the pixel. *)
Definition paint_pixel (shown : list Fragment) : option Z :=
  fold_left (fun pixel f => if covers f then Some (source f) else pixel)
    shown None.

(** [zbuffer]: the uncut polygons in the order they come; each is compared
    with the one seen so far. *)
Definition nearest (polygons : list Fragment) : option Fragment :=
  fold_left (fun seen f =>
    if covers f then
      match seen with
      | None => Some f
      | Some g => if before f g then Some f else seen
      end
    else seen) polygons None.

Definition zbuffer_pixel (polygons : list Fragment) : option Z :=
  option_map source (nearest polygons).

(** S5.1: the polygon that covers the sample and is in front of all that do. *)
Definition in_front (polygons : list Fragment) (p : Fragment) : Prop :=
  In p polygons /\ covers p = true /\
  forall q, In q polygons -> covers q = true -> before q p = false.

(** S5.1, and [raycast]: the item image at the sample. *)
Definition item (polygons : list Fragment) (pixel : option Z) : Prop :=
  match pixel with
  | Some id => exists p, in_front polygons p /\ source p = id
  | None => forall p, In p polygons -> covers p = false
  end.

Lemma render_pixel_find : forall shown,
  render_pixel shown = option_map source (find covers shown).
Proof.
  assert (forall shown id, fold_left (fun pixel f =>
    match pixel with
    | Some _ => pixel
    | None => if covers f then Some (source f) else None
    end) shown (Some id) = Some id) as H.
  { induction shown; simpl; auto. }
  unfold render_pixel; induction shown as [|f shown IH]; simpl; auto.
  destruct (covers f); [apply H | exact IH].
Qed.

(** Front to back the first writer is, back to front, the last. *)
Theorem first_writer_is_last : forall shown,
  paint_pixel (rev shown) = render_pixel shown.
Proof.
  intros shown; rewrite render_pixel_find; unfold paint_pixel.
  induction shown as [|f shown IH]; simpl; [reflexivity|].
  rewrite fold_left_app; simpl; destruct (covers f); auto.
Qed.

Theorem render_is_paint : forall tree,
  render_pixel (front_to_back tree) = paint_pixel (back_to_front tree).
Proof.
  intros tree; now rewrite back_to_front_is_reverse, first_writer_is_last.
Qed.

(** Nearer is an order of depths: not both ways, and what is not nearer than
    another is not nearer than what that is not nearer than. *)
Hypothesis nearer_asymmetric : forall f g,
  is_nearer f g = true -> is_nearer g f = false.
Hypothesis not_nearer_transitive : forall f g h,
  is_nearer f g = false -> is_nearer g h = false -> is_nearer f h = false.
(** Depth is a function of the plane, so a part has its polygon's. *)
Hypothesis split_nearer : forall f h g,
  is_nearer (fst (split f h)) g = is_nearer f g /\
  is_nearer (snd (split f h)) g = is_nearer f g /\
  is_nearer g (fst (split f h)) = is_nearer g f /\
  is_nearer g (snd (split f h)) = is_nearer g f.

Lemma not_before : forall f g, before f g = false <->
  is_nearer f g = false /\ (is_nearer g f = true \/ (source g <= source f)%Z).
Proof.
  intros f g; unfold before; rewrite orb_false_iff, andb_false_iff.
  rewrite negb_false_iff, Z.ltb_ge; tauto.
Qed.

Lemma not_before_transitive : forall f g h,
  before f g = false -> before g h = false -> before f h = false.
Proof.
  intros f g h; rewrite !not_before; intros [A B] [C D].
  split; [eauto using not_nearer_transitive|].
  destruct B as [B | B].
  - left; destruct (is_nearer h f) eqn:E; [reflexivity|].
    rewrite (not_nearer_transitive g h f) in B; auto.
  - destruct D as [D | D]; [|right; lia].
    left; destruct (is_nearer h f) eqn:E; [reflexivity|].
    rewrite (not_nearer_transitive h f g) in D; auto.
Qed.

Lemma before_not_after : forall f g, before f g = true -> before g f = false.
Proof.
  intros f g; unfold before; rewrite orb_true_iff, andb_true_iff.
  rewrite negb_true_iff, Z.ltb_lt; intros H; apply not_before.
  destruct H as [H | [H L]]; [auto using nearer_asymmetric|].
  split; [exact H | right; lia].
Qed.

Lemma not_before_itself : forall f, before f f = false.
Proof.
  intros f; destruct (before f f) eqn:E; [|reflexivity].
  now rewrite (before_not_after f f E) in E.
Qed.

(** S5.1: there is one item image, and no more. *)
Theorem item_unique : forall polygons pixel other,
  item polygons pixel -> item polygons other -> pixel = other.
Proof.
  intros polygons [a|] [b|]; simpl; try reflexivity.
  - intros (p & (Ip & Cp & Hp) & <-) (q & (Iq & Cq & Hq) & <-); f_equal.
    specialize (Hp q Iq Cq); specialize (Hq p Ip Cp).
    apply not_before in Hp; apply not_before in Hq.
    destruct Hp as [A [B | B]], Hq as [C [D | D]]; try congruence; lia.
  - intros (p & (Ip & Cp & _) & _) H; rewrite H in Cp; easy.
  - intros H (p & (Ip & Cp & _) & _); rewrite H in Cp; easy.
Qed.

Lemma nearest_spec : forall polygons,
  match nearest polygons with
  | Some p => in_front polygons p
  | None => forall p, In p polygons -> covers p = false
  end.
Proof.
  unfold in_front; induction polygons as [|f l IH] using rev_ind;
    [intros p []|].
  unfold nearest in *; rewrite fold_left_app; simpl.
  destruct (fold_left _ l None) as [g|]; destruct (covers f) eqn:C.
  - destruct IH as (I & Cg & H), (before f g) eqn:B.
    + repeat split; [apply in_or_app; simpl; auto | exact C |].
      intros q Q Cq; apply in_app_or in Q; destruct Q as [Q | [<- | []]].
      * apply (not_before_transitive q g f); auto using before_not_after.
      * apply not_before_itself.
    + repeat split; [apply in_or_app; simpl; auto | exact Cg |].
      intros q Q Cq; apply in_app_or in Q; destruct Q as [Q | [<- | []]];
        auto.
  - destruct IH as (I & Cg & H).
    repeat split; [apply in_or_app; simpl; auto | exact Cg |].
    intros q Q Cq; apply in_app_or in Q; destruct Q as [Q | [<- | []]]; auto.
    congruence.
  - repeat split; [apply in_or_app; simpl; auto | exact C |].
    intros q Q Cq; apply in_app_or in Q; destruct Q as [Q | [<- | []]].
    + rewrite IH in Cq; easy.
    + apply not_before_itself.
  - intros p Q; apply in_app_or in Q; destruct Q as [Q | [<- | []]]; auto.
Qed.

(** The z-buffer gives the item image. *)
Theorem zbuffer_is_item : forall polygons,
  item polygons (zbuffer_pixel polygons).
Proof.
  intros polygons; unfold zbuffer_pixel; pose proof (nearest_spec polygons).
  destruct (nearest polygons) as [p|]; simpl; [exists p; auto | assumption].
Qed.

(** And does so in any order of the polygons. *)
Theorem zbuffer_any_order : forall polygons others,
  Permutation polygons others ->
  zbuffer_pixel polygons = zbuffer_pixel others.
Proof.
  intros l m P; apply (item_unique l); [apply zbuffer_is_item|].
  pose proof (zbuffer_is_item m) as H; pose proof (Permutation_sym P) as R.
  destruct (zbuffer_pixel m) as [id|]; simpl in *.
  - destruct H as (p & (I & C & B) & E); exists p; repeat split; auto.
    + now apply (Permutation_in p R).
    + intros q Q; apply B; now apply (Permutation_in q P).
  - intros p I; apply H; now apply (Permutation_in p P).
Qed.

(** [zbuffer.cpp] and [raycast.cpp] take the polygons in order of id, and only
    a strictly nearer one replaces what was seen: the lowest id stays. *)
Definition first_hit (polygons : list Fragment) : option Fragment :=
  fold_left (fun seen f =>
    if covers f then
      match seen with
      | None => Some f
      | Some g => if is_nearer f g then Some f else seen
      end
    else seen) polygons None.

Definition raycast_pixel (polygons : list Fragment) : option Z :=
  option_map source (first_hit polygons).

Theorem raycast_is_zbuffer : forall polygons, in_order polygons ->
  raycast_pixel polygons = zbuffer_pixel polygons.
Proof.
  intros polygons O; unfold raycast_pixel, zbuffer_pixel; f_equal.
  unfold first_hit, nearest.
  assert (forall seen, match seen with
    | Some g => Forall (fun f => (source g <= source f)%Z) polygons
    | None => True
    end -> fold_left (fun seen f =>
      if covers f then
        match seen with
        | None => Some f
        | Some g => if is_nearer f g then Some f else seen
        end
      else seen) polygons seen = fold_left (fun seen f =>
      if covers f then
        match seen with
        | None => Some f
        | Some g => if before f g then Some f else seen
        end
      else seen) polygons seen) as H; [|now apply H].
  induction O as [|f l O IH A]; intros seen S; simpl; [reflexivity|].
  destruct (covers f).
  - destruct seen as [g|].
    + inversion S as [|? ? S1 S2]; subst.
      assert (before f g = is_nearer f g) as ->.
      { unfold before; destruct (is_nearer f g); simpl; [reflexivity|].
        destruct (Z.ltb_spec (source f) (source g)); [lia|].
        now rewrite andb_false_r. }
      destruct (is_nearer f g); apply IH; auto.
    + apply IH; exact A.
  - apply IH; destruct seen; [inversion S; auto | auto].
Qed.

(** ** A tree shows what its polygons do *)

(** A fragment of a polygon: the same id, the same depth. *)
Definition of_polygon (p f : Fragment) : Prop :=
  source f = source p /\
  forall g, is_nearer f g = is_nearer p g /\ is_nearer g f = is_nearer g p.

(** What building and insertion give, and all that an image needs. *)
Definition tree_of (polygons : list Fragment)
  (tree : BspTree Fragment Plane) : Prop :=
  sides tree /\ Forall valid (fragments tree) /\
  Forall (fun f => exists p, In p polygons /\ of_polygon p f /\
                   (covers f = true -> covers p = true)) (fragments tree) /\
  forall p, In p polygons -> covers p = true ->
    Exists (fun f => covers f = true /\ of_polygon p f) (fragments tree).

Lemma of_polygon_parts : forall p f h, of_polygon p f ->
  of_polygon p (fst (split f h)) /\ of_polygon p (snd (split f h)).
Proof.
  intros p f h [S N]; destruct (split_source f h) as [A B].
  unfold of_polygon; rewrite A, B; repeat split; auto;
    destruct (split_nearer f h g) as (C1 & C2 & C3 & C4);
    rewrite ?C1, ?C2, ?C3, ?C4; apply N.
Qed.

Lemma from_polygon_parts : forall polygons f h, valid f ->
  (exists p, In p polygons /\ of_polygon p f /\
     (covers f = true -> covers p = true)) ->
  relation f h = rSpanning ->
  (exists p, In p polygons /\ of_polygon p (fst (split f h)) /\
     (covers (fst (split f h)) = true -> covers p = true)) /\
  (exists p, In p polygons /\ of_polygon p (snd (split f h)) /\
     (covers (snd (split f h)) = true -> covers p = true)).
Proof.
  intros polygons f h V (p & I & O & C) R.
  destruct (of_polygon_parts p f h O) as [A B].
  destruct (split_covers_whole f h V R).
  split; exists p; auto.
Qed.

Lemma parts_have : forall p f h, valid f -> relation f h = rSpanning ->
  (covers f = true /\ of_polygon p f ->
   (covers (fst (split f h)) = true /\ of_polygon p (fst (split f h))) \/
   (covers (snd (split f h)) = true /\ of_polygon p (snd (split f h)))).
Proof.
  intros p f h V R [C O]; destruct (of_polygon_parts p f h O) as [A B].
  destruct (split_covers f h V R) as (X & _ & _); rewrite C in X.
  destruct (covers (fst (split f h))), (covers (snd (split f h))); auto;
    discriminate.
Qed.

(** What some fragment of a list shows of a polygon, some fragment of the tree
    shows. *)
Definition shows (p : Fragment) (l : list Fragment) : Prop :=
  Exists (fun f => covers f = true /\ of_polygon p f) l.

Lemma shows_app : forall p l m, shows p (l ++ m) <-> shows p l \/ shows p m.
Proof. intros; apply Exists_app. Qed.

Lemma distribute_shows : forall p l h c pos neg,
  distribute Fragment Plane relation split l h = (c, pos, neg) ->
  Forall valid l -> shows p l -> shows p c \/ shows p pos \/ shows p neg.
Proof.
  unfold shows; intros q; induction l as [|f l IH]; intros h c p n; simpl.
  - intros _ _ H; inversion H.
  - destruct (distribute _ _ _ _ l h) as [[c' p'] n'] eqn:D.
    intros E V H; inversion V as [|? ? V1 V2]; subst.
    apply Exists_cons in H; specialize (IH h c' p' n' D V2).
    pose proof (parts_have q f h V1) as X.
    destruct (relation f h) eqn:R; injection E as <- <- <-;
      rewrite !Exists_cons; tauto.
Qed.

Lemma put_shows : forall p f l,
  shows p [f] \/ shows p l -> shows p (put Fragment source f l).
Proof.
  unfold shows; intros p f l H.
  induction l as [|g l IH]; simpl; [destruct H as [H | H];
    [exact H | inversion H]|].
  rewrite Exists_cons, Exists_nil, Exists_cons in H.
  rewrite Exists_cons, Exists_nil in IH.
  destruct (_ <? _)%Z; rewrite !Exists_cons; tauto.
Qed.

Lemma insert_shows : forall p tree f, valid f ->
  shows p [f] \/ shows p (fragments tree) ->
  shows p (fragments
    (insert Fragment Plane source plane_of relation split f tree)).
Proof.
  intros q; induction tree as [|h c p IHp n IHn]; intros f V; simpl.
  - intros [H | H]; [exact H | inversion H].
  - rewrite !shows_app; intros H.
    pose proof (parts_have q f h V) as X.
    destruct (relation f h) eqn:R; simpl; rewrite !shows_app.
    + specialize (IHp f V); tauto.
    + specialize (IHn f V); tauto.
    + pose proof (put_shows q f c); tauto.
    + destruct (split_valid f h V R) as [V1 V2]; specialize (X eq_refl).
      specialize (IHp _ V1); specialize (IHn _ V2).
      assert (forall g, shows q [g] <-> covers g = true /\ of_polygon q g) as Y.
      { intros g; unfold shows; rewrite Exists_cons, Exists_nil; tauto. }
      rewrite Y in *; tauto.
Qed.

Lemma of_itself : forall p, of_polygon p p.
Proof. intros p; split; [reflexivity | intros g; split; reflexivity]. Qed.

(** S3.5: a built tree shows its polygons, however roots are chosen. *)
Theorem build_tree_of : forall choose_root polygons,
  Forall valid polygons -> in_order polygons ->
  tree_of polygons
    (build Fragment Plane plane_of relation split choose_root polygons).
Proof.
  intros choose_root l V O; unfold tree_of.
  split; [now apply build_sides|]; unfold build.
  split; [apply (build_at_forall Fragment Plane source plane_of relation split
             choose_root valid own_plane split_valid); auto|].
  split; [apply (build_at_forall Fragment Plane source plane_of relation split
             choose_root valid own_plane split_valid); auto|].
  - intros; now apply from_polygon_parts.
  - apply Forall_forall; intros f F; exists f; auto using of_itself.
  - intros p I C; change (shows p (fragments (build_at Fragment Plane plane_of
      relation split choose_root (length l) [] l))).
    assert (shows p l) as S.
    { apply Exists_exists; exists p; auto using of_itself. }
    revert S; apply (build_induction Fragment Plane source plane_of relation
      split choose_root valid own_plane split_valid
      (fun l t => shows p l -> shows p (fragments t))); auto.
    clear l V O I C; intros l root c pos n place m V _ _ D _ _ _ P N S.
    simpl; rewrite !shows_app.
    destruct (distribute_shows p _ _ _ _ _ D V S) as [H | [H | H]]; auto.
Qed.

(** S3.6: so does a tree into which they are inserted, in any order. *)
Theorem insert_tree_of : forall polygons tree p,
  valid p -> tree_of polygons tree ->
  tree_of (p :: polygons)
    (insert Fragment Plane source plane_of relation split p tree).
Proof.
  intros l tree p V (S & W & A & B); unfold tree_of.
  split; [now apply insert_sides|].
  split; [apply (insert_forall Fragment Plane source plane_of relation split
             valid split_valid); auto|].
  split; [apply (insert_forall Fragment Plane source plane_of relation split
             valid split_valid); auto|].
  - intros; now apply from_polygon_parts.
  - exists p; simpl; auto using of_itself.
  - eapply Forall_impl; [|exact A]; intros f (q & I & H).
    exists q; simpl; auto.
  - intros q I C; apply insert_shows; [exact V|].
    destruct I as [<- | I]; [left; apply Exists_cons; auto using of_itself|].
    right; apply B; auto.
Qed.

Theorem insert_all_tree_of : forall polygons, Forall valid polygons ->
  tree_of (rev polygons)
    (insert_all Fragment Plane source plane_of relation split polygons Nothing).
Proof.
  assert (forall l m tree, Forall valid l -> tree_of m tree ->
          tree_of (rev l ++ m)
            (insert_all Fragment Plane source plane_of relation split l tree))
    as H.
  { induction l as [|p l IH]; intros m tree V T; [exact T|].
    inversion V as [|? ? V1 V2]; subst; simpl; rewrite <- app_assoc; simpl.
    apply IH; [exact V2 | now apply insert_tree_of]. }
  intros l V; rewrite <- (app_nil_r (rev l)); apply H; [exact V|].
  repeat split; simpl; auto; intros p [].
Qed.

Lemma find_first : forall l f, ForallOrdPairs not_hidden l ->
  find covers l = Some f ->
  In f l /\ covers f = true /\
  forall g, In g l -> covers g = true -> before g f = false.
Proof.
  induction l as [|f l IH]; intros g O F; simpl in F; [discriminate|].
  inversion O as [|? ? O1 O2]; subst.
  destruct (covers f) eqn:C.
  - injection F as <-; repeat split; simpl; auto.
    intros g [<- | G] Cg; [apply not_before_itself|].
    rewrite Forall_forall in O1; now apply O1.
  - destruct (IH g O2 F) as (I & Cg & H); repeat split; simpl; auto.
    intros k [<- | K] Ck; [congruence | auto].
Qed.

(** S5.5: the tree, front to back with the first writer, shows the item image,
    for every eye. *)
Theorem render_is_item : forall polygons tree, tree_of polygons tree ->
  item polygons (render_pixel (front_to_back tree)).
Proof.
  intros l tree (S & V & A & B); rewrite render_pixel_find.
  pose proof (front_to_back_order tree S V) as O.
  rewrite Forall_forall in A.
  assert (forall p, In p l -> covers p = true -> exists f,
          In f (front_to_back tree) /\ covers f = true /\ of_polygon p f) as K.
  { intros p I C; destruct (proj1 (Exists_exists _ _) (B p I C))
      as (f & F & Cf & P).
    exists f; repeat split; auto; try apply P.
    apply (Permutation_in f (Permutation_sym (displayed_once tree))) in F.
    apply in_app_or in F; destruct F as [F | F]; [exact F|].
    rewrite (edge_on_covers_nothing tree S V f F) in Cf; discriminate. }
  destruct (find covers (front_to_back tree)) as [f|] eqn:F; simpl.
  - destruct (find_first _ _ O F) as (I & C & H).
    destruct (A f (front_to_back_in tree f I)) as (p & Ip & (Sp & Np) & Cp).
    exists p; split; [|auto]; repeat split; auto.
    intros q Iq Cq; destruct (K q Iq Cq) as (g & Ig & Cg & Sq & Nq).
    specialize (H g Ig Cg); apply not_before in H; apply not_before.
    rewrite <- Sp, <- Sq.
    destruct (Np q) as [P1 P2], (Nq f) as [Q1 Q2].
    rewrite <- P1, <- P2, <- Q1, <- Q2; exact H.
  - intros p I; destruct (covers p) eqn:C; [exfalso | reflexivity].
    destruct (K p I C) as (f & If & Cf & _).
    now rewrite (find_none _ _ F f If) in Cf.
Qed.

(** S5.5: all algorithms agree: front to back with the first writer, back to
    front with the last, z-buffer in any order, nearest hit. *)
Theorem algorithms_agree : forall polygons others tree,
  tree_of polygons tree -> Permutation polygons others ->
  render_pixel (front_to_back tree) = paint_pixel (back_to_front tree) /\
  render_pixel (front_to_back tree) = zbuffer_pixel others /\
  (in_order polygons ->
   render_pixel (front_to_back tree) = raycast_pixel polygons).
Proof.
  intros l m tree T P.
  assert (render_pixel (front_to_back tree) = zbuffer_pixel l) as E.
  { apply (item_unique l); [now apply render_is_item | apply zbuffer_is_item]. }
  split; [apply render_is_paint|]; split.
  - rewrite E; now apply zbuffer_any_order.
  - intros O; rewrite E; symmetry; now apply raycast_is_zbuffer.
Qed.

End Order.
