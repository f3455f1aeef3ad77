(** * S10.2, S10.5: what clip planes leave, at samples and between lines.

    A clip plane is one more edge of every polygon. What is seen at a point of
    the image depends on the signs of functions that are affine in it, so it is
    the same all over a cell of their lines: an integral over a pixel is a sum
    over cells. *)

From Coq Require Import QArith Lqa List.
From Halfspace Require Import Base Ray.
Import ListNotations.
Open Scope Q_scope.

Section Clip.

Variable perspective : bool.
Variable e : Point.

(** S10.2: the signs of edges and of clip planes together say that the ray
    meets the polygon inside its edges, on the positive sides of all clip
    planes, in front of the eye and beyond the near distance. *)
Theorem clipped_is_seen : forall s P edges clips k,
  ~ at_eye perspective e P == 0 -> bounded edges ->
  ((forall h, In h edges -> 0 < cut perspective e s P h) /\
   (forall c, In c clips -> 0 < cut perspective e s P c) /\
   0 < from_near perspective e s P k <->
   exists t, meets perspective e s P t /\ k < t /\
             (forall h, In h edges -> 0 < value_at h (ray perspective e s t)) /\
             (forall c, In c clips ->
              0 < value_at c (ray perspective e s t))).
Proof.
  intros s P edges clips k N B.
  assert (bounded (edges ++ clips)) as B'.
  { intros q w A; apply (B q w); intros h I; apply A, in_or_app; now left. }
  pose proof (covered_is_seen perspective e s P (edges ++ clips) k N B') as C.
  split.
  - intros (A & D & F).
    destruct C as [C _]; destruct C as (t & M & K & V).
    { split; [|exact F]; intros h I; apply in_app_or in I.
      destruct I as [I | I]; [now apply A | now apply D]. }
    exists t; split; [exact M|]; split; [exact K|].
    split; intros h I; apply V, in_or_app; [now left | now right].
  - intros (t & M & K & A & D).
    destruct C as [_ C]; destruct C as (V & F).
    { exists t; split; [exact M|]; split; [exact K|].
      intros h I; apply in_app_or in I.
      destruct I as [I | I]; [now apply A | now apply D]. }
    split; [|split; [|exact F]]; intros h I; apply V, in_or_app;
      [now left | now right].
Qed.

(** ** Between lines *)

(** The point at a share of the way from one image point to another. *)
Definition mixed (s u : Point) (t : Q) : Point :=
  {| px := px s + t * (px u - px s);
     py := py s + t * (py u - py s);
     pz := pz s + t * (pz u - pz s) |}.

(** A function of image points is affine if it goes evenly along every way. *)
Definition affine (f : Point -> Q) : Prop := forall s u t,
  f (mixed s u t) == (1 - t) * f s + t * f u.

Lemma same_side : forall f s u, affine f ->
  (forall t, 0 <= t -> t <= 1 -> ~ f (mixed s u t) == 0) ->
  (0 < f s <-> 0 < f u).
Proof.
  assert (forall f s u, affine f ->
    (forall t, 0 <= t -> t <= 1 -> ~ f (mixed s u t) == 0) ->
    0 < f s -> 0 < f u) as H.
  { intros f s u A Z P; unfold affine in A.
    destruct (Qlt_le_dec 0 (f u)) as [G | G]; [exact G | exfalso].
    assert (0 < f s - f u) as D by lra.
    assert (~ f s - f u == 0) as D' by lra.
    apply (Z (f s / (f s - f u))).
    - apply Qle_shift_div_l; lra.
    - apply Qle_shift_div_r; lra.
    - rewrite A; field; exact D'. }
  intros f s u A Z; split; [now apply H|]; unfold affine in A.
  intros P.
  assert (f s == f (mixed s u 0)) as S by (rewrite A; ring).
  assert (f u == f (mixed s u 1)) as U by (rewrite A; ring).
  destruct (Qlt_le_dec 0 (f s)) as [G | G]; [exact G | exfalso].
  assert (0 < f u - f s) as D by lra.
  assert (~ f u - f s == 0) as D' by lra.
  apply (Z (- f s / (f u - f s))).
  - apply Qle_shift_div_l; lra.
  - apply Qle_shift_div_r; lra.
  - rewrite A; field; exact D'.
Qed.

Lemma at_image_mixed : forall h s u t,
  at_image (mixed s u t) h == (1 - t) * at_image s h + t * at_image u h.
Proof.
  intros h s u t; unfold at_image, value_at, mixed; simpl; ring.
Qed.

Lemma oriented_affine : forall P f, affine f ->
  affine (fun s => oriented perspective e P (f s)).
Proof.
  intros P f A s u t; unfold affine in A; unfold oriented.
  destruct (sign (at_eye perspective e P)); rewrite A; ring.
Qed.

Lemma cut_affine : forall P h, affine (fun s => cut perspective e s P h).
Proof.
  intros P h.
  apply (oriented_affine P (fun s => at_eye perspective e P * at_image s h -
                                     at_eye perspective e h * at_image s P)).
  intros s u t; rewrite !at_image_mixed; ring.
Qed.

Lemma from_near_affine : forall P k,
  affine (fun s => from_near perspective e s P k).
Proof.
  intros P k.
  apply (oriented_affine P (fun s => if perspective
    then (1 - k) * at_eye perspective e P + k * at_image s P
    else at_image s P - k * at_eye perspective e P)).
  intros s u t; destruct perspective; rewrite !at_image_mixed; ring.
Qed.

Lemma nearer_affine : forall P R, affine (fun s =>
  nearness perspective e s P - nearness perspective e s R).
Proof.
  intros P R s u t; unfold nearness; rewrite !at_image_mixed; ring.
Qed.

(** S10.5, S7.6: all along a way on which the functions that decide are nowhere
    0, the same polygons cover the image point, and in the same order of depth.
*)
Theorem cells_cover_alike : forall s u P planes k,
  (forall t, 0 <= t -> t <= 1 ->
   ~ from_near perspective e (mixed s u t) P k == 0 /\
   forall h, In h planes -> ~ cut perspective e (mixed s u t) P h == 0) ->
  ((forall h, In h planes -> 0 < cut perspective e s P h) /\
   0 < from_near perspective e s P k <->
   (forall h, In h planes -> 0 < cut perspective e u P h) /\
   0 < from_near perspective e u P k).
Proof.
  intros s u P planes k Z.
  assert (forall h, In h planes ->
    (0 < cut perspective e s P h <-> 0 < cut perspective e u P h)) as C.
  { intros h I.
    apply (same_side (fun v => cut perspective e v P h) s u (cut_affine P h)).
    intros t L G; destruct (Z t L G) as [_ Y]; exact (Y h I). }
  assert (0 < from_near perspective e s P k <->
          0 < from_near perspective e u P k) as F.
  { apply (same_side (fun v => from_near perspective e v P k) s u
             (from_near_affine P k)).
    intros t L G; destruct (Z t L G) as [Y _]; exact Y. }
  split; intros [A B]; split.
  - intros h I; apply (C h I), A, I.
  - apply F, B.
  - intros h I; apply (C h I), A, I.
  - apply F, B.
Qed.

Theorem cells_order_alike : forall s u P R,
  (forall t, 0 <= t -> t <= 1 ->
   ~ nearness perspective e (mixed s u t) P -
     nearness perspective e (mixed s u t) R == 0) ->
  (nearness perspective e s R < nearness perspective e s P <->
   nearness perspective e u R < nearness perspective e u P).
Proof.
  intros s u P R Z.
  pose proof (same_side (fun v => nearness perspective e v P -
    nearness perspective e v R) s u (nearer_affine P R) Z) as S.
  cbv beta in S.
  split; intros H.
  - assert (0 < nearness perspective e s P - nearness perspective e s R) as A
      by lra.
    apply S in A; lra.
  - assert (0 < nearness perspective e u P - nearness perspective e u R) as A
      by lra.
    apply S in A; lra.
Qed.

End Clip.
