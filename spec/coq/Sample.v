(** * S4.4, S4.5: the sample of a pixel.

    Read beside [sign_at_sample] and [covers] in ref/src/oracle/zbuffer.cpp. A sample
    is infinitely near its pixel's centre; its signs are those of a value, else
    of the x-derivative, else of the y-derivative. *)

From Coq Require Import QArith Qabs Qminmax Lqa Lia List Bool.
From Halfspace Require Import Base.
Import ListNotations.
Open Scope Q_scope.

(** ** Definitions *)

(** A function value + X dx + Y dy of the image point (X, Y). *)
Record Affine := { value : Q; dx : Q; dy : Q }.

Definition at_image (f : Affine) (X Y : Q) : Q :=
  value f + X * dx f + Y * dy f.

(** The centre of pixel [i], in either direction. *)
Definition centre (i : Z) : Q := inject_Z i + (1 # 2).

(** S4.4: the sign at the sample of pixel (i, j). *)
Definition sign_at_sample (f : Affine) (i j : Z) : Side :=
  match sign (at_image f (centre i) (centre j)) with
  | kOn =>
    match sign (dx f) with
    | kOn => sign (dy f)
    | s => s
    end
  | s => s
  end.

(** S4.5: the sample is covered where all of these are positive. *)
Definition covers (insides : list Affine) (i j : Z) : bool :=
  forallb (fun f => side_eqb (sign_at_sample f i j) kPositive) insides.

Definition scale (k : Q) (f : Affine) : Affine :=
  {| value := k * value f; dx := k * dx f; dy := k * dy f |}.

Definition add (f g : Affine) : Affine :=
  {| value := value f + value g; dx := dx f + dx g; dy := dy f + dy g |}.

(** The other side of the same line. *)
Definition negated (f : Affine) : Affine := scale (- 1) f.

Definition is_zero (f : Affine) : Prop :=
  value f == 0 /\ dx f == 0 /\ dy f == 0.

(** ** What the sample's sign means *)

(** The sample itself, for a small enough e: (i + 1/2 + e, j + 1/2 + e e). *)
Definition near_sample (f : Affine) (i j : Z) (e : Q) : Q :=
  at_image f (centre i + e) (centre j + e * e).

Lemma near_sample_terms : forall f i j e,
  near_sample f i j e ==
  at_image f (centre i) (centre j) + e * dx f + e * e * dy f.
Proof. intros; unfold near_sample, at_image; ring. Qed.

(** A term of higher order cannot outweigh one of lower order, if e is small
    enough. *)
Lemma outweighed : forall p q, 0 < p ->
  exists e0, 0 < e0 /\ forall e, 0 < e -> e <= e0 -> 0 < p + e * q.
Proof.
  intros p q H.
  assert (0 < 1 + Qabs q) as A.
  { pose proof (Qabs_nonneg q); lra. }
  exists (p / (1 + Qabs q) * (1 # 2)); split.
  - assert (0 < p / (1 + Qabs q)); [|lra].
    apply Qlt_shift_div_l; lra.
  - intros e P E.
    assert (e * (1 + Qabs q) <= p * (1 # 2)) as B.
    { setoid_replace (p * (1 # 2))
        with (p / (1 + Qabs q) * (1 # 2) * (1 + Qabs q))
        by (field; lra).
      apply Qmult_le_compat_r; lra. }
    assert (- q <= Qabs q) as C.
    { rewrite <- Qabs_opp; apply Qle_Qabs. }
    nra.
Qed.

Lemma small_enough_positive : forall v p q,
  0 < v \/ v == 0 /\ (0 < p \/ p == 0 /\ 0 < q) ->
  exists e0, 0 < e0 /\
  forall e, 0 < e -> e <= e0 -> 0 < v + e * p + e * e * q.
Proof.
  intros v p q [V | [V [P | [P R]]]].
  - destruct (outweighed v p V) as (e1 & E1 & H1).
    destruct (outweighed (v * (1 # 2)) p) as (e2 & E2 & H2); [lra|].
    destruct (outweighed (v * (1 # 2)) q) as (e3 & E3 & H3); [lra|].
    exists (Qmin (Qmin e2 e3) 1); split.
    { repeat apply Q.min_glb_lt; lra. }
    intros e A B.
    pose proof (Q.le_min_l (Qmin e2 e3) 1).
    pose proof (Q.le_min_r (Qmin e2 e3) 1).
    pose proof (Q.le_min_l e2 e3); pose proof (Q.le_min_r e2 e3).
    specialize (H2 e A ltac:(lra)).
    assert (0 < e * e) by nra; assert (e * e <= e) by nra.
    specialize (H3 (e * e) ltac:(lra) ltac:(lra)); lra.
  - destruct (outweighed p q P) as (e1 & E1 & H1).
    exists e1; split; [exact E1|]; intros e A B; specialize (H1 e A B).
    assert (0 < e * (p + e * q)) by nra; rewrite V; lra.
  - exists 1; split; [lra|]; intros e A B.
    assert (0 < e * e) by nra; assert (0 < e * e * q) by nra.
    rewrite V, P; lra.
Qed.

Lemma sign_at_sample_proper : forall f g i j,
  value f == value g -> dx f == dx g -> dy f == dy g ->
  sign_at_sample f i j = sign_at_sample g i j.
Proof.
  intros f g i j A B C; unfold sign_at_sample.
  assert (at_image f (centre i) (centre j) == at_image g (centre i) (centre j))
    as E by (unfold at_image; rewrite A, B, C; reflexivity).
  now rewrite (sign_proper _ _ E), (sign_proper _ _ B), (sign_proper _ _ C).
Qed.

(** Its sign, written out. *)
Lemma sign_at_sample_positive : forall f i j,
  let v := at_image f (centre i) (centre j) in
  sign_at_sample f i j = kPositive <->
  0 < v \/ v == 0 /\ (0 < dx f \/ dx f == 0 /\ 0 < dy f).
Proof.
  intros f i j v; unfold sign_at_sample; fold v.
  destruct (sign_cases v) as [[E V] | [[E V] | [E V]]]; rewrite E.
  - split; [discriminate | intros [|[]]; lra].
  - destruct (sign_cases (dx f)) as [[F W] | [[F W] | [F W]]]; rewrite F.
    + split; [discriminate | intros [|[_ [|[]]]]; lra].
    + rewrite sign_positive; split; [auto | intros [|[_ [|[]]]]; lra].
    + split; auto.
  - split; auto.
Qed.

Theorem sign_at_sample_negated : forall f i j,
  sign_at_sample (negated f) i j = opposite (sign_at_sample f i j).
Proof.
  intros f i j; unfold sign_at_sample.
  assert (forall p q, p == - q -> sign p = opposite (sign q)) as N.
  { intros p q E; rewrite <- sign_opposite; now apply sign_proper. }
  rewrite (N (at_image (negated f) (centre i) (centre j))
             (at_image f (centre i) (centre j)))
    by (unfold at_image, negated, scale; simpl; ring).
  rewrite (N (dx (negated f)) (dx f)) by (simpl; ring).
  rewrite (N (dy (negated f)) (dy f)) by (simpl; ring).
  destruct (sign (at_image f (centre i) (centre j))); try reflexivity.
  destruct (sign (dx f)); reflexivity.
Qed.

(** The sample is never on a line: its sign is 0 for the zero function
    alone. *)
Theorem sample_never_on : forall f i j,
  sign_at_sample f i j = kOn <-> is_zero f.
Proof.
  intros f i j; unfold sign_at_sample, is_zero, at_image.
  destruct (sign_cases (value f + centre i * dx f + centre j * dy f))
    as [[E V] | [[E V] | [E V]]]; rewrite E;
    destruct (sign_cases (dx f)) as [[F W] | [[F W] | [F W]]]; rewrite ?F;
    rewrite ?sign_on; split; try discriminate; intros H;
    try (destruct H as (A & B & C); rewrite ?A, ?B, ?C in *; lra).
  rewrite W, H in V; repeat split; auto; lra.
Qed.

(** For every small enough e > 0 the sign at (i + 1/2 + e, j + 1/2 + e e) is
    the sign at the sample. *)
Theorem sample_is_infinitely_near : forall f i j,
  exists e0, 0 < e0 /\ forall e, 0 < e -> e <= e0 ->
  sign (near_sample f i j e) = sign_at_sample f i j.
Proof.
  intros f i j; destruct (sign_at_sample f i j) eqn:E.
  - assert (sign_at_sample (negated f) i j = kPositive) as H.
    { now rewrite sign_at_sample_negated, E. }
    apply sign_at_sample_positive, small_enough_positive in H.
    destruct H as (e0 & E0 & H); exists e0; split; [exact E0|].
    intros e A B; specialize (H e A B); apply sign_negative.
    rewrite near_sample_terms; revert H; unfold negated, scale, at_image; simpl.
    intros; lra.
  - apply sample_never_on in E; destruct E as (V & W & X).
    exists 1; split; [lra|]; intros e A B; apply sign_on.
    unfold near_sample, at_image; rewrite V, W, X; ring.
  - apply sign_at_sample_positive, small_enough_positive in E.
    destruct E as (e0 & E0 & H); exists e0; split; [exact E0|].
    intros e A B; apply sign_positive; rewrite near_sample_terms; auto.
Qed.

(** Any number of functions at once: there is an image point at which all of
    them have the signs that they have at the sample. *)
Theorem sample_is_a_point : forall fs i j,
  exists e, 0 < e /\ forall f, In f fs ->
  sign (near_sample f i j e) = sign_at_sample f i j.
Proof.
  intros fs i j.
  assert (exists e0, 0 < e0 /\ forall e, 0 < e -> e <= e0 -> forall f,
          In f fs -> sign (near_sample f i j e) = sign_at_sample f i j) as H.
  { induction fs as [|f fs (e1 & E1 & H1)].
    - exists 1; split; [lra | intros e _ _ f []].
    - destruct (sample_is_infinitely_near f i j) as (e2 & E2 & H2).
      exists (Qmin e1 e2); split; [now apply Q.min_glb_lt|].
      pose proof (Q.le_min_l e1 e2); pose proof (Q.le_min_r e1 e2).
      intros e A B g [G | G]; [subst g; apply H2 | apply H1]; auto; lra. }
  destruct H as (e0 & E0 & H); exists e0; split; [exact E0|].
  intros f F; apply (H e0); auto; lra.
Qed.

(** ** Signs add and scale *)

Theorem sample_of_sum : forall f g i j,
  sign_at_sample f i j = kPositive -> sign_at_sample g i j = kPositive ->
  sign_at_sample (add f g) i j = kPositive.
Proof.
  intros f g i j; rewrite !sign_at_sample_positive; unfold at_image; simpl.
  intros; destruct H as [H | [H [H1 | [H1 H2]]]],
    H0 as [G | [G [G1 | [G1 G2]]]]; try (left; lra); right; split; try lra;
    try (left; lra); right; split; lra.
Qed.

Theorem sample_of_multiple : forall k f i j,
  0 < k -> sign_at_sample (scale k f) i j = sign_at_sample f i j.
Proof.
  assert (forall k f i j, 0 < k -> sign_at_sample f i j = kPositive ->
          sign_at_sample (scale k f) i j = kPositive) as P.
  { intros k f i j K; rewrite !sign_at_sample_positive; unfold at_image; simpl.
    intros [H | [H [H1 | [H1 H2]]]].
    - left; assert (0 < k * (value f + centre i * dx f + centre j * dy f))
        by nra; lra.
    - right; split; [|left; nra].
      assert (k * (value f + centre i * dx f + centre j * dy f) == 0)
        by (rewrite H; ring); lra.
    - right; split; [|right; split; [rewrite H1; ring | nra]].
      assert (k * (value f + centre i * dx f + centre j * dy f) == 0)
        by (rewrite H; ring); lra. }
  intros k f i j K; destruct (sign_at_sample f i j) eqn:E.
  - assert (sign_at_sample (scale k (negated f)) i j = kPositive) as H.
    { apply P; [exact K|]; now rewrite sign_at_sample_negated, E. }
    rewrite (sign_at_sample_proper _ (negated (scale k f))) in H
      by (simpl; ring).
    rewrite sign_at_sample_negated in H.
    destruct (sign_at_sample (scale k f) i j); simpl in H; congruence.
  - apply sample_never_on in E; apply sample_never_on.
    destruct E as (A & B & C); unfold is_zero, scale; simpl.
    rewrite A, B, C; repeat split; ring.
  - now apply P.
Qed.

(** ** Half-planes partition the samples *)

(** A line's two half-planes: every sample is in exactly one. *)
Theorem half_planes_partition : forall f i j, ~ is_zero f ->
  side_eqb (sign_at_sample f i j) kPositive =
  negb (side_eqb (sign_at_sample (negated f) i j) kPositive).
Proof.
  intros f i j N; rewrite sign_at_sample_negated.
  destruct (sign_at_sample f i j) eqn:E; simpl; try reflexivity.
  now apply sample_never_on in E.
Qed.

(** A polygon cut along a line that is not everywhere: each of its samples is
    in exactly one part, and a part has no others. *)
Theorem parts_partition : forall f insides i j, ~ is_zero f ->
  covers insides i j =
  xorb (covers (f :: insides) i j) (covers (negated f :: insides) i j).
Proof.
  intros f insides i j N; simpl; rewrite (half_planes_partition f i j N).
  destruct (side_eqb (sign_at_sample (negated f) i j) kPositive),
    (covers insides i j); reflexivity.
Qed.

(** Two polygons on the two sides of a shared edge never both cover a
    sample. *)
Theorem shared_edge_owned_once : forall f insides others i j,
  covers (f :: insides) i j = true ->
  covers (negated f :: others) i j = false.
Proof.
  intros f insides others i j; simpl; rewrite sign_at_sample_negated.
  destruct (sign_at_sample f i j); simpl; congruence.
Qed.

(** An edge may be listed scaled, and in any place. *)
Theorem covers_all : forall insides i j,
  covers insides i j = true <->
  forall f, In f insides -> sign_at_sample f i j = kPositive.
Proof.
  intros insides i j; unfold covers; rewrite forallb_forall.
  split; intros H f F; apply side_eqb_eq; auto.
Qed.

(** ** Runs of pixels (S4.6) *)

Lemma centre_lt : forall i j, (i < j)%Z -> centre i < centre j.
Proof.
  intros i j H; unfold centre.
  assert (inject_Z i < inject_Z j) by now rewrite <- Zlt_Qlt. lra.
Qed.

(** Between two pixels of a line at whose samples a function is positive it is
    positive. *)
Lemma positive_between : forall f i i' i'' j, (i <= i' <= i'')%Z ->
  sign_at_sample f i j = kPositive -> sign_at_sample f i'' j = kPositive ->
  sign_at_sample f i' j = kPositive.
Proof.
  intros f i i' i'' j [A B].
  destruct (Z.eq_dec i i'); [now subst|].
  destruct (Z.eq_dec i' i''); [now subst|].
  assert (centre i < centre i') by (apply centre_lt; lia).
  assert (centre i' < centre i'') by (apply centre_lt; lia).
  rewrite !sign_at_sample_positive; unfold at_image.
  destruct (sign_cases (dx f)) as [[_ W] | [[_ W] | [_ W]]].
  - intros _ H1; left.
    assert (0 < (centre i'' - centre i') * - dx f) by nra.
    destruct H1 as [H1 | [H1 _]]; lra.
  - rewrite W; intros [H1 | [H1 H2]] _; [left; lra | right; split; [lra|]].
    destruct H2 as [H2 | [_ H2]]; [lra | right; split; [lra | exact H2]].
  - intros H1 _; left.
    assert (0 < (centre i' - centre i) * dx f) by nra.
    destruct H1 as [H1 | [H1 _]]; lra.
Qed.

(** So what a polygon covers of a line is one run of pixels. *)
Theorem at_most_one_segment : forall insides i i' i'' j,
  (i <= i' <= i'')%Z -> covers insides i j = true ->
  covers insides i'' j = true -> covers insides i' j = true.
Proof.
  intros insides i i' i'' j B; rewrite !covers_all; intros P R f F.
  apply (positive_between f i i' i''); auto.
Qed.

(** The samples to the right of an edge are those of the pixels whose centre
    is not left of it, however the edge is inclined: it meets the line's centre
    height at [meets], and moves by [slope] from line to line. *)
Theorem right_of_edge : forall meets slope i j,
  let edge := {| value := - meets + slope * centre j;
                 dx := 1; dy := - slope |} in
  sign_at_sample edge i j = kPositive <-> meets <= centre i.
Proof.
  intros meets slope i j edge; rewrite sign_at_sample_positive.
  unfold at_image, edge; simpl.
  assert (- meets + slope * centre j + centre i * 1 + centre j * - slope ==
          centre i - meets) as E by ring.
  rewrite E; split; intros H.
  - destruct H as [H | [H _]]; lra.
  - destruct (Qlt_le_dec meets (centre i)); [left; lra | right; split; lra].
Qed.

(** The samples below a horizontal boundary are those of the lines whose centre
    is not above it. *)
Theorem below_boundary : forall top i j,
  sign_at_sample {| value := - top; dx := 0; dy := 1 |} i j = kPositive <->
  top <= centre j.
Proof.
  intros top i j; rewrite sign_at_sample_positive; unfold at_image; simpl.
  assert (- top + centre i * 0 + centre j * 1 == centre j - top) as E by ring.
  rewrite E; split; intros H.
  - destruct H as [H | [H _]]; lra.
  - destruct (Qlt_le_dec top (centre j)); [left; lra | right; split; [lra|]].
    right; split; lra.
Qed.
