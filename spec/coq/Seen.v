(** * S4.5: a sample is covered exactly if a ray meets the polygon there.

    [View.v] decides by signs at the sample, [Ray.v] says what the same signs
    mean at an image point; the sample is an image point infinitely near its
    pixel's centre. *)

From Coq Require Import QArith Qminmax Lqa List Bool.
From Halfspace Require Import Base Sample Convex Scene View.
From Halfspace Require Ray.
Import ListNotations.
Open Scope Q_scope.

Section Seen.

Variable camera : Camera.
Variable options : Options.
Variables i j : Z.

(** The image point (i + 1/2 + e, j + 1/2 + e e) in space. *)
Definition image_point (e : Q) : Point :=
  let X := centre i + e in
  let Y := centre j + e * e in
  {| px := px (s0 camera) + X * px (sx camera) + Y * px (sy camera);
     py := py (s0 camera) + X * py (sx camera) + Y * py (sy camera);
     pz := pz (s0 camera) + X * pz (sx camera) + Y * pz (sy camera) |}.

(** Its ray meets the fragment's plane inside the fragment's edges, in front of
    the eye and beyond the near distance. *)
Definition ray_meets (f : Fragment) (e : Q) : Prop :=
  let s := image_point e in
  exists t, Ray.meets (perspective camera) (eye camera) s (support f) t /\
            match near options with Some k => k < t | None => True end /\
            forall h, In h (edges f) ->
            0 < value_at h (Ray.ray (perspective camera) (eye camera) s t).

Lemma same_at_eye : forall h,
  Ray.at_eye (perspective camera) (eye camera) h == at_eye camera h.
Proof.
  intros h; unfold Ray.at_eye, at_eye, Ray.value_of, value_of, weight_of_eye.
  unfold dot, normal; destruct (perspective camera); simpl; ring.
Qed.

Lemma same_at_image : forall h e,
  near_sample (plane_at_image camera h) i j e ==
  Ray.at_image (image_point e) h.
Proof.
  intros h e; unfold near_sample, plane_at_image, at_image, Ray.at_image.
  unfold value_at, image_point, dot, normal; simpl; ring.
Qed.

Lemma same_oriented : forall P f x e, near_sample f i j e == x ->
  near_sample (oriented camera P f) i j e ==
  Ray.oriented (perspective camera) (eye camera) P x.
Proof.
  intros P f x e E; unfold Ray.oriented, oriented, side_of_eye.
  rewrite (sign_proper _ _ (same_at_eye P)).
  destruct (sign (at_eye camera P)); [|exact E | exact E].
  rewrite <- E; unfold near_sample, negated, scale, at_image; simpl; ring.
Qed.

Lemma same_cut : forall P h e,
  near_sample (oriented camera P (cut camera P h)) i j e ==
  Ray.cut (perspective camera) (eye camera) (image_point e) P h.
Proof.
  intros P h e; unfold Ray.cut; apply same_oriented.
  rewrite !same_at_eye, <- !same_at_image.
  unfold near_sample, cut, add, scale, at_image; simpl; ring.
Qed.

(** What [beyond_near] asks of the sample. *)
Definition near_function (P : Plane) (k : Q) : Affine :=
  if perspective camera then
    add {| value := (1 - k) * at_eye camera P; dx := 0; dy := 0 |}
        (scale k (plane_at_image camera P))
  else
    add {| value := - k * at_eye camera P; dx := 0; dy := 0 |}
        (plane_at_image camera P).

Lemma same_near : forall P k e,
  near_sample (oriented camera P (near_function P k)) i j e ==
  Ray.from_near (perspective camera) (eye camera) (image_point e) P k.
Proof.
  intros P k e; unfold Ray.from_near; apply same_oriented.
  pose proof (same_at_eye P) as A; pose proof (same_at_image P e) as B.
  revert A; unfold near_function; destruct (perspective camera); intros A;
    rewrite A, <- B; unfold near_sample, add, scale, at_image; simpl; ring.
Qed.

Lemma near_enough : forall fs, exists e0, 0 < e0 /\ forall e, 0 < e ->
  e <= e0 -> forall f, In f fs ->
  sign (near_sample f i j e) = sign_at_sample f i j.
Proof.
  induction fs as [|f fs (e1 & E1 & H1)].
  - exists 1; split; [lra | intros e _ _ f []].
  - destruct (sample_is_infinitely_near f i j) as (e2 & E2 & H2).
    exists (Qmin e1 e2); split; [now apply Q.min_glb_lt|].
    pose proof (Q.le_min_l e1 e2); pose proof (Q.le_min_r e1 e2).
    intros e A B g [G | G]; [subst g; apply H2 | apply H1]; auto; lra.
Qed.

(** The functions whose signs decide. *)
Definition deciding (f : Fragment) : list Affine :=
  map (fun h => oriented camera (support f) (cut camera (support f) h))
      (edges f) ++
  match near options with
  | Some k => [oriented camera (support f) (near_function (support f) k)]
  | None => []
  end.

Theorem covers_is_seen : forall f, valid f ->
  exists e0, 0 < e0 /\ forall e, 0 < e -> e <= e0 ->
  (covers camera options i j f = true <->
   side_of_eye camera (support f) <> kOn /\
   not_culled camera options (support f) = true /\ ray_meets f e).
Proof.
  intros f V; destruct (near_enough (deciding f)) as (e0 & E0 & H).
  exists e0; split; [exact E0 | intros e E L; specialize (H e E L)].
  set (P := support f) in *; set (s := image_point e) in *.
  assert (forall h, In h (edges f) ->
    (sign_at_sample (oriented camera P (cut camera P h)) i j = kPositive <->
     0 < Ray.cut (perspective camera) (eye camera) s P h)) as C.
  { intros h I; rewrite <- H.
    - rewrite sign_positive; now rewrite same_cut.
    - unfold deciding; apply in_or_app; left; apply in_map_iff; eauto. }
  assert (Sample.covers (map (fun h => oriented camera P (cut camera P h))
                             (edges f)) i j = true <->
          forall h, In h (edges f) ->
          0 < Ray.cut (perspective camera) (eye camera) s P h) as D.
  { unfold Sample.covers; rewrite forallb_forall; split.
    - intros A h I; apply C; auto; apply side_eqb_eq, A, in_map_iff; eauto.
    - intros A g I; apply in_map_iff in I; destruct I as (h & <- & I).
      apply side_eqb_eq, C; auto. }
  assert (Ray.bounded (edges f)) as B.
  { intros q w A; apply (valid_bounded f q w V); intros h I.
    setoid_replace (value_of h q w) with (Ray.value_of h q w); [now apply A|].
    unfold value_of, Ray.value_of, dot, normal; simpl; ring. }
  unfold covers; fold P; rewrite !andb_true_iff, negb_true_iff, D.
  assert (side_eqb (side_of_eye camera P) kOn = false <->
          side_of_eye camera P <> kOn) as O.
  { split; intros A.
    - intros Z; apply side_eqb_eq in Z; congruence.
    - destruct (side_eqb (side_of_eye camera P) kOn) eqn:Z; auto.
      apply side_eqb_eq in Z; contradiction. }
  rewrite O; split.
  - intros [[[N K] M] A]; split; [exact N|]; split; [exact K|].
    assert (~ Ray.at_eye (perspective camera) (eye camera) P == 0) as N'.
    { rewrite same_at_eye; intros Z; apply N; now apply sign_on. }
    destruct (Ray.no_horizon _ _ s P (edges f) N' B A) as [t T].
    exists t; split; [exact T|]; split.
    + destruct (near options) as [k|] eqn:G; [|exact I].
      apply (Ray.from_near_is_the_distance _ _ s P k t N' T).
      unfold beyond_near in M; rewrite G in M; apply side_eqb_eq in M.
      change (sign_at_sample (oriented camera P (near_function P k)) i j =
              kPositive) in M.
      rewrite <- H in M; [|unfold deciding; rewrite G; apply in_or_app; right;
                            left; reflexivity].
      apply sign_positive in M; now rewrite same_near in M.
    + intros h I; apply (Ray.cut_is_the_side _ _ s P h t N' T), A, I.
  - intros (N & K & t & T & F & A).
    assert (~ Ray.at_eye (perspective camera) (eye camera) P == 0) as N'.
    { rewrite same_at_eye; intros Z; apply N; now apply sign_on. }
    split; [split; [split; [exact N | exact K]|]|].
    + unfold beyond_near; destruct (near options) as [k|] eqn:G; [|reflexivity].
      apply side_eqb_eq.
      change (sign_at_sample (oriented camera P (near_function P k)) i j =
              kPositive).
      rewrite <- H; [|unfold deciding; rewrite G; apply in_or_app; right;
                      left; reflexivity].
      apply sign_positive; rewrite same_near.
      apply (Ray.from_near_is_the_distance _ _ s P k t N' T), F.
    + intros h I; apply (Ray.cut_is_the_side _ _ s P h t N' T), A, I.
Qed.

End Seen.
