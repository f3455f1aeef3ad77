(** * S4.3, S4.5, S5.3: what a ray meets.

    [View.v] decides with the values of planes at the eye and at an image
    point. Here is what these say of the point in which the point's ray meets a
    plane: whether there is one, on which side of another plane it is, whether
    it is beyond the near distance, and which of two is nearer. *)

From Coq Require Import QArith Lqa Lia List.
From Halfspace Require Import Base.
Import ListNotations.
Open Scope Q_scope.

Section Ray.

Variable perspective : bool.
(** The eye, or the direction towards the viewer; the image point. *)
Variables e s : Point.

(** A plane at the homogeneous point (p, w): of space, or at infinity. *)
Definition value_of (h : Plane) (p : Point) (w : Q) : Q :=
  pa h * px p + pb h * py p + pc h * pz p + pd h * w.

Definition at_eye (h : Plane) : Q :=
  value_of h e (if perspective then 1 else 0).

Definition at_image (h : Plane) : Q := value_at h s.

(** S4.3: p(t). *)
Definition ray (t : Q) : Point :=
  if perspective then
    {| px := px e + t * (px s - px e);
       py := py e + t * (py s - py e);
       pz := pz e + t * (pz s - pz e) |}
  else
    {| px := px s - t * px e; py := py s - t * py e; pz := pz s - t * pz e |}.

(** S4.3: where the ray is. *)
Definition on_ray (t : Q) : Prop := if perspective then 0 < t else True.

(** The ray meets the plane there. *)
Definition meets (h : Plane) (t : Q) : Prop :=
  on_ray t /\ value_at h (ray t) == 0.

(** S4.5: P(e) Q(s) - Q(e) P(s), read against the side that the eye is on. *)
Definition oriented (P : Plane) (x : Q) : Q :=
  match sign (at_eye P) with
  | kNegative => - x
  | _ => x
  end.

Definition cut (P h : Plane) : Q :=
  oriented P (at_eye P * at_image h - at_eye h * at_image P).

(** S4.5.3, with the near distance in units of the ray parameter. *)
Definition from_near (P : Plane) (k : Q) : Q :=
  oriented P (if perspective then (1 - k) * at_eye P + k * at_image P
              else at_image P - k * at_eye P).

(** S5.3. *)
Definition nearness (P : Plane) : Q := - / at_eye P * at_image P.

Lemma value_on_ray : forall h t, value_at h (ray t) ==
  if perspective then (1 - t) * at_eye h + t * at_image h
  else at_image h - t * at_eye h.
Proof.
  intros h t; unfold ray, at_eye, at_image, value_of, value_at.
  destruct perspective; simpl; ring.
Qed.

Lemma oriented_positive : forall P x, ~ at_eye P == 0 ->
  (0 < oriented P x <-> 0 < at_eye P * x).
Proof.
  intros P x N; unfold oriented.
  destruct (sign_cases (at_eye P)) as [[-> H] | [[_ H] | [-> H]]];
    [| contradiction |]; split; intros; nra.
Qed.

(** A ray meets a plane that the eye is not on at one point at most. *)
Theorem meets_once : forall P t u, ~ at_eye P == 0 ->
  meets P t -> meets P u -> t == u.
Proof.
  intros P t u N [T Ht] [U Hu]; unfold on_ray in *.
  rewrite value_on_ray in Ht, Hu; destruct perspective.
  - assert (at_eye P * (t - u) == 0) as Z.
    { transitivity (t * ((1 - u) * at_eye P + u * at_image P) -
                    u * ((1 - t) * at_eye P + t * at_image P)); [ring|].
      rewrite Ht, Hu; ring. }
    apply Qmult_integral in Z; destruct Z; [contradiction | lra].
  - assert (at_eye P * (t - u) == 0) as Z by lra.
    apply Qmult_integral in Z; destruct Z; [contradiction | lra].
Qed.

(** S4.5.2: the sign at an edge is the side of the edge's plane that the point
    is on in which the ray meets the polygon's plane. *)
Theorem cut_is_the_side : forall P h t, ~ at_eye P == 0 -> meets P t ->
  (0 < cut P h <-> 0 < value_at h (ray t)).
Proof.
  intros P h t N [T M]; unfold cut; rewrite oriented_positive by exact N.
  unfold on_ray in T; rewrite value_on_ray in M |- *.
  set (p := at_eye P) in *; set (q := at_eye h) in *.
  set (u := at_image P) in *; set (v := at_image h) in *.
  assert (0 < p * p) as S by (destruct (Q_dec p 0) as [[L|L]|L]; nra).
  destruct perspective.
  - assert (p * (p * v - q * u) * t == (p * p) * ((1 - t) * q + t * v)) as E.
    { transitivity ((p * p) * ((1 - t) * q + t * v) -
                    p * q * ((1 - t) * p + t * u)); [ring|].
      rewrite M; ring. }
    split; intros H; nra.
  - assert (p * (p * v - q * u) == (p * p) * (v - t * q)) as E.
    { transitivity ((p * p) * (v - t * q) - p * q * (u - t * p)); [ring|].
      rewrite M; ring. }
    split; intros H; nra.
Qed.

(** S4.5.3: its sign is whether that point is beyond the near distance. *)
Theorem from_near_is_the_distance : forall P k t, ~ at_eye P == 0 ->
  meets P t -> (0 < from_near P k <-> k < t).
Proof.
  intros P k t N [T M]; unfold from_near; rewrite oriented_positive by exact N.
  unfold on_ray in T; rewrite value_on_ray in M.
  set (p := at_eye P) in *; set (u := at_image P) in *.
  assert (0 < p * p) as S by (destruct (Q_dec p 0) as [[L|L]|L]; nra).
  destruct perspective.
  - assert (p * ((1 - k) * p + k * u) * t == (p * p) * (t - k)) as E.
    { transitivity ((p * p) * (t - k) + k * p * ((1 - t) * p + t * u));
        [ring|].
      rewrite M; ring. }
    split; intros H; nra.
  - assert (p * (u - k * p) == (p * p) * (t - k)) as E.
    { transitivity ((p * p) * (t - k) + p * (u - t * p)); [ring|].
      rewrite M; ring. }
    split; intros H; nra.
Qed.

(** S5.3: the greater, the nearer. *)
Theorem nearness_is_the_order : forall P R t u,
  ~ at_eye P == 0 -> ~ at_eye R == 0 -> meets P t -> meets R u ->
  (nearness R < nearness P <-> t < u).
Proof.
  assert (forall P t, ~ at_eye P == 0 -> meets P t ->
    if perspective then t * (nearness P + 1) == 1 else nearness P == - t) as D.
  { intros P t N [T M]; unfold on_ray in T; rewrite value_on_ray in M.
    unfold nearness; destruct perspective.
    - assert (t * at_image P == (t - 1) * at_eye P) as E by lra.
      transitivity (t - / at_eye P * (t * at_image P)); [ring|].
      rewrite E; field; exact N.
    - assert (at_image P == t * at_eye P) as E by lra.
      rewrite E; field; exact N. }
  intros P R t u N N' M M'.
  pose proof (D P t N M) as E; pose proof (D R u N' M') as E'.
  destruct M as [T _], M' as [U _]; unfold on_ray in *.
  destruct perspective; [|lra].
  set (a := nearness P) in *; set (b := nearness R) in *.
  assert (0 < a + 1) as A by nra; assert (0 < b + 1) as B by nra.
  split; intros H; nra.
Qed.

(** Edges of a bounded polygon: nothing at infinity or beyond is inside. *)
Definition bounded (edges : list Plane) : Prop := forall q w,
  (forall h, In h edges -> 0 < value_of h q w) -> 0 < w.

(** S4.5 needs no test of the horizon: where all edges have the right sign, the
    ray does meet the plane, and in front of the eye. *)
Theorem no_horizon : forall P edges, ~ at_eye P == 0 -> bounded edges ->
  (forall h, In h edges -> 0 < cut P h) -> exists t, meets P t.
Proof.
  intros P edges N B C; unfold meets, on_ray.
  destruct perspective eqn:V.
  - set (p := at_eye P) in *; set (u := at_image P) in *.
    assert (0 < p * (p - u)) as S.
    { apply (B {| px := p * (p * px s - u * px e);
                  py := p * (p * py s - u * py e);
                  pz := p * (p * pz s - u * pz e) |}).
      intros h I; specialize (C h I); unfold cut in C.
      apply oriented_positive in C; [|exact N].
      fold p u in C; unfold at_eye in C; rewrite V in C.
      unfold at_image, value_at, value_of in *; simpl in *; nra. }
    assert (~ p - u == 0) as D by (intros Z; rewrite Z in S; lra).
    exists (p / (p - u)); split.
    + apply (Qmult_lt_l _ _ ((p - u) * (p - u))).
      { destruct (Q_dec (p - u) 0) as [[L|L]|L]; nra. }
      setoid_replace ((p - u) * (p - u) * (p / (p - u)))
        with (p * (p - u)) by (field; exact D).
      lra.
    + rewrite value_on_ray, V; fold p u; field; exact D.
  - exists (at_image P / at_eye P); split; [exact I|].
    rewrite value_on_ray, V; field; exact N.
Qed.

(** S4.5: a sample is covered exactly if its ray meets the polygon's plane
    inside all edges, in front of the eye and beyond the near distance. *)
Theorem covered_is_seen : forall P edges k, ~ at_eye P == 0 -> bounded edges ->
  ((forall h, In h edges -> 0 < cut P h) /\ 0 < from_near P k <->
   exists t, meets P t /\ k < t /\
             forall h, In h edges -> 0 < value_at h (ray t)).
Proof.
  intros P edges k N B; split.
  - intros [C F]; destruct (no_horizon P edges N B C) as [t M].
    exists t; split; [exact M|]; split.
    + now apply (from_near_is_the_distance P k t N M).
    + intros h I; now apply (cut_is_the_side P h t N M), C.
  - intros (t & M & K & C); split.
    + intros h I; now apply (cut_is_the_side P h t N M), C.
    + now apply (from_near_is_the_distance P k t N M).
Qed.

End Ray.
