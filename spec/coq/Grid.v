(** * S3: HEUR's Theorem 1: a scene of which every tree is quadratic.

    [n / 2] rectangles across the z-axis and [n / 2] across the y-axis, each of
    the ones crossing each of the others as seen along the x-axis: whatever
    roots are chosen, the tree has [n (n + 4) / 4] nodes. *)

From Coq Require Import QArith Lqa Lia List Bool Permutation.
From Halfspace Require Import Base Convex Tree Scene.
Import ListNotations.
Open Scope Q_scope.

(** ** The scene *)

Definition point (x y z : Q) : Point := {| px := x; py := y; pz := z |}.

(** Rectangle [i] across the z-axis, in the plane z = i + 1. *)
Definition across_z (m i : Z) : Plane * list Point :=
  let y := inject_Z m + 2 in
  let z := inject_Z i + 1 in
  ({| pa := 0; pb := 0; pc := y; pd := - (y * z) |},
   [point 0 0 z; point 1 0 z; point 1 y z; point 0 y z]).

(** Rectangle [j] across the y-axis, in the plane y = j + 1. *)
Definition across_y (m j : Z) : Plane * list Point :=
  let z := inject_Z m + 1 in
  let y := inject_Z j + 1 in
  ({| pa := 0; pb := - z; pc := 0; pd := z * y |},
   [point 2 y 0; point 3 y 0; point 3 y z; point 2 y z]).

Definition numbers (m : nat) : list Z := map Z.of_nat (seq 0 m).

Definition grid_scene (m : nat) : Scene :=
  map (across_z (Z.of_nat m)) (numbers m) ++
  map (across_y (Z.of_nat m)) (numbers m).

(** ** Bars: what a rectangle and its parts are *)

Definition coordinate (z : bool) (v : Point) : Q := if z then pz v else py v.

(** The plane in which a coordinate is [k]. *)
Definition level (z : bool) (k : Q) (h : Plane) : Prop :=
  exists s, ~ s == 0 /\ forall v, value_at h v == s * (coordinate z v - k).

(** A fragment in such a plane that reaches from [low] to [high] in the other
    coordinate. *)
Definition bar (z : bool) (k low high : Q) (f : Fragment) : Prop :=
  level z k (support f) /\
  (forall v, In v (vertices f) ->
   coordinate z v == k /\ low <= coordinate (negb z) v <= high) /\
  (exists v, In v (vertices f) /\ coordinate (negb z) v == low) /\
  (exists v, In v (vertices f) /\ coordinate (negb z) v == high).

Lemma level_sign : forall s x, ~ s == 0 ->
  s * x == 0 <-> x == 0.
Proof.
  intros s x N; split; [intros H; apply Qmult_integral in H; tauto|].
  intros ->; ring.
Qed.

(** Bars against planes of their own direction stay whole. *)
Lemma bar_beside : forall z k low high f s k' h, bar z k low high f ->
  ~ s == 0 -> (forall v, value_at (plane h) v == s * (coordinate z v - k')) ->
  (k == k' -> relation f h = rCoincident) /\
  (0 < s * (k - k') -> relation f h = rPositive) /\
  (s * (k - k') < 0 -> relation f h = rNegative).
Proof.
  intros z k low high f s k' h (_ & A & (u & U & _) & _) N H.
  assert (forall v, In v (vertices f) -> value_at (plane h) v == s * (k - k'))
    as V.
  { intros v I; rewrite H; destruct (A v I) as [-> _]; reflexivity. }
  pose proof (relation_vertices f h) as R; split; [|split]; intros K;
    destruct (relation f h); try reflexivity; exfalso.
  - destruct R as [_ (v & I & P)]; rewrite (V v I), K in P; lra.
  - destruct R as [_ (v & I & P)]; rewrite (V v I), K in P; lra.
  - destruct R as [(v & I & P) _]; rewrite (V v I), K in P; lra.
  - destruct R as [_ (v & I & P)]; rewrite (V v I) in P; lra.
  - specialize (R u U); rewrite (V u U) in R; lra.
  - destruct R as [_ (v & I & P)]; rewrite (V v I) in P; lra.
  - destruct R as [_ (v & I & P)]; rewrite (V v I) in P; lra.
  - specialize (R u U); rewrite (V u U) in R; lra.
  - destruct R as [(v & I & P) _]; rewrite (V v I) in P; lra.
Qed.

(** Bars that a plane of the other direction passes are cut. *)
Lemma bar_across : forall z k low high f s k' h, bar z k low high f ->
  ~ s == 0 ->
  (forall v, value_at (plane h) v == s * (coordinate (negb z) v - k')) ->
  low < k' < high -> relation f h = rSpanning.
Proof.
  intros z k low high f s k' h (_ & _ & (u & U & Lu) & (w & W & Lw)) N H K.
  pose proof (relation_vertices f h) as R.
  pose proof (H u) as Hu; pose proof (H w) as Hw; rewrite Lu in Hu.
  rewrite Lw in Hw.
  destruct (Q_dec s 0) as [[S | S] | S]; [| | contradiction];
    destruct (relation f h); try reflexivity; exfalso.
  - destruct R as [R _]; specialize (R w W); nra.
  - destruct R as [R _]; specialize (R u U); nra.
  - pose proof (R u U) as X; rewrite Hu in X; apply level_sign in X; auto; lra.
  - destruct R as [R _]; specialize (R u U); nra.
  - destruct R as [R _]; specialize (R w W); nra.
  - pose proof (R u U) as X; rewrite Hu in X; apply level_sign in X; auto; lra.
Qed.

Lemma coordinate_between : forall z p q v t k,
  px v == px p + (px q - px p) * t -> py v == py p + (py q - py p) * t ->
  pz v == pz p + (pz q - pz p) * t ->
  coordinate z p == k -> coordinate z q == k -> coordinate z v == k.
Proof.
  intros [] p q v t k X Y Z P Q; simpl in *;
    rewrite ?Y, ?Z, P, Q; ring.
Qed.

(** The part on the side of a plane with [0 < s], and with [s < 0]. *)
Lemma bar_part : forall side z k low high f s k' h, bar z k low high f ->
  side <> kOn -> ~ s == 0 -> (forall v,
    value_at (toward side (plane h)) v == s * (coordinate (negb z) v - k')) ->
  relation f h = rSpanning -> low < k' < high -> valid f ->
  (0 < s -> bar z k k' high (part side f h)) /\
  (s < 0 -> bar z k low k' (part side f h)).
Proof.
  intros side z k low high f s k' h B O N H R K V.
  destruct (part_is_cut side f h V O R) as (c & C & Hc).
  destruct B as (L & A & (u & U & Lu) & (w & W & Lw)).
  assert (forall v, value_at (plane h) v == 0 ->
          coordinate (negb z) v == k') as On.
  { intros v Z; assert (value_at (toward side (plane h)) v == 0) as Z'.
    { destruct side; simpl; rewrite ?value_at_reversed, Z; reflexivity. }
    rewrite H in Z'; apply level_sign in Z'; auto; lra. }
  assert (forall v, In v (vertices (part side f h)) -> coordinate z v == k /\
          low <= coordinate (negb z) v <= high /\
          0 <= s * (coordinate (negb z) v - k')) as P.
  { intros v I; destruct (part_vertex side f h v V O R I) as
      (S & p & q & t & E & T & (X & Y & Z) & F).
    rewrite H in S; destruct (round_ends _ _ _ E) as [Ip Iq].
    destruct (A p Ip) as [Dp Ep], (A q Iq) as [Dq Eq]; split; [|split].
    - apply (coordinate_between z p q v t k); auto.
    - destruct F as [F | F]; [now apply A|].
      rewrite H in F; apply level_sign in F; auto; lra.
    - exact S. }
  assert (forall v, In v (vertices f) -> 0 < s * (coordinate (negb z) v - k')
          -> In v (vertices (part side f h))) as Q.
  { intros v I S; apply part_keeps; auto; now rewrite H. }
  split; intros S; (split; [exact L | split; [|split]]).
  - intros v I; destruct (P v I) as (D & E & G); split; [exact D|].
    split; [|tauto]; destruct (Qlt_le_dec (coordinate (negb z) v) k'); nra.
  - exists c; auto.
  - exists w; split; [|exact Lw]; apply Q; auto; rewrite Lw; nra.
  - intros v I; destruct (P v I) as (D & E & G); split; [exact D|].
    split; [tauto|]; destruct (Qlt_le_dec k' (coordinate (negb z) v)); nra.
  - exists u; split; [|exact Lu]; apply Q; auto; rewrite Lu; nra.
  - exists c; auto.
Qed.

(** ** Cells: what the list at a place of the tree is *)

(** A box in y and z: [low] and [high] of each. *)
Record Cell := { lows : bool -> Q; highs : bool -> Q }.

(** A bar that is inside the cell in one coordinate, and goes from end to end
    in the other. *)
Definition fits (cell : Cell) (f : Fragment) : Prop :=
  exists z k, lows cell z < k < highs cell z /\
  bar z k (lows cell (negb z)) (highs cell (negb z)) f.

Definition apart (h k : Plane) : Prop :=
  forall z x, level z x h -> ~ level z x k.

Definition cell_of (cell : Cell) (l : list Fragment) : Prop :=
  Forall (fits cell) l /\
  ForallOrdPairs (fun f g => apart (support f) (support g)) l.

(** The cell's part above [k], or below it. *)
Definition above (cell : Cell) (z : bool) (k : Q) : Cell :=
  {| lows := fun a => if Bool.eqb a z then k else lows cell a;
     highs := highs cell |}.

Definition below (cell : Cell) (z : bool) (k : Q) : Cell :=
  {| lows := lows cell;
     highs := fun a => if Bool.eqb a z then k else highs cell a |}.

Definition is_across_z (f : Fragment) : bool :=
  negb (Qeq_bool (pc (support f)) 0).

Definition count (z : bool) (l : list Fragment) : nat :=
  length (filter (fun f => Bool.eqb (is_across_z f) z) l).

Lemma bar_is : forall z k low high f, bar z k low high f -> is_across_z f = z.
Proof.
  intros z k low high f ((s & N & H) & _); unfold is_across_z.
  pose proof (H (point 0 0 0)) as A; pose proof (H (point 0 0 1)) as B.
  unfold value_at in A, B; simpl in A, B.
  destruct (Qeq_bool (pc (support f)) 0) eqn:E; destruct z; simpl in *;
    try reflexivity; exfalso.
  - apply Qeq_bool_iff in E; apply N; lra.
  - apply Qeq_bool_neq in E; apply E; lra.
Qed.

(** How the plane of a bar divides a cell: each side has its part of the cell,
    and every bar of the other direction. *)
Lemma cell_distribute : forall z k h s, ~ s == 0 ->
  (forall v, value_at (plane h) v == s * (coordinate z v - k)) ->
  forall cell l c p n, lows cell z < k < highs cell z -> Forall valid l ->
  cell_of cell l ->
  distribute Fragment Splitter relation split l h = (c, p, n) ->
  let up := if Qlt_le_dec 0 s then above cell z k else below cell z k in
  let down := if Qlt_le_dec 0 s then below cell z k else above cell z k in
  cell_of up p /\ cell_of down n /\
  count z l = (count z c + count z p + count z n)%nat /\
  count (negb z) c = 0%nat /\
  count (negb z) p = count (negb z) l /\
  count (negb z) n = count (negb z) l.
Proof.
  intros z k h s N H cell l; induction l as [|f l IH];
    intros c p n K V [F D] E up down.
  - injection E as <- <- <-; repeat split; constructor.
  - simpl in E.
    destruct (distribute Fragment Splitter relation split l h) as [[c' p'] n']
      eqn:G.
    inversion V as [|? ? V1 V2]; subst; inversion F as [|? ? F1 F2]; subst.
    inversion D as [|? ? D1 D2]; subst.
    destruct (IH c' p' n' K V2 (conj F2 D2) eq_refl)
      as ([Fp Dp] & [Fn Dn] & C1 & C2 & C3 & C4).
    fold up in Fp; fold down in Fn.
    destruct (distribute_forall Fragment Splitter relation split valid
                (fun g => apart (support f) (support g))) with (l := l)
      (h := h) (c := c') (p := p') (n := n') as (Ac & Ap & An); auto.
    destruct F1 as (a & x & X & B); pose proof (bar_is _ _ _ _ _ B) as A.
    destruct (Bool.bool_dec a z) as [-> | M].
    + destruct (bar_beside z x _ _ f s k h B N H) as (R1 & R2 & R3).
      assert (count z (f :: l) = S (count z l)) as S1.
      { unfold count; simpl; rewrite A, eqb_reflx; reflexivity. }
      assert (count (negb z) (f :: l) = count (negb z) l) as S2.
      { unfold count; simpl; rewrite A; now destruct z. }
      assert (forall m, count z (f :: m) = S (count z m) /\
              count (negb z) (f :: m) = count (negb z) m) as S3.
      { intros m; unfold count; simpl; rewrite A; now destruct z. }
      assert (k < x -> fits (above cell z k) f) as Up.
      { intros L; exists z, x; simpl; rewrite eqb_reflx.
        replace (Bool.eqb (negb z) z) with false by now destruct z.
        split; [tauto | exact B]. }
      assert (x < k -> fits (below cell z k) f) as Dn'.
      { intros L; exists z, x; simpl; rewrite eqb_reflx.
        replace (Bool.eqb (negb z) z) with false by now destruct z.
        split; [tauto | exact B]. }
      destruct (Q_dec (s * (x - k)) 0) as [[L | L] | L].
      * rewrite (R3 L) in E; injection E as <- <- <-.
        destruct (S3 n') as [T1 T2]; rewrite S1, S2, T1, T2, C1.
        repeat split; auto; try lia; [|constructor; assumption].
        constructor; [|exact Fn]; unfold down.
        destruct (Qlt_le_dec 0 s); [apply Dn' | apply Up]; nra.
      * rewrite (R2 L) in E; injection E as <- <- <-.
        destruct (S3 p') as [T1 T2]; rewrite S1, S2, T1, T2, C1.
        repeat split; auto; try lia; [|constructor; assumption].
        constructor; [|exact Fp]; unfold up.
        destruct (Qlt_le_dec 0 s); [apply Up | apply Dn']; nra.
      * rewrite R1 in E; [|apply level_sign in L; [lra | exact N]].
        injection E as <- <- <-.
        destruct (S3 c') as [T1 T2]; rewrite S1, S2, T1, T2, C1.
        repeat split; auto; lia.
    + assert (z = negb a) as -> by (destruct a, z; simpl; congruence).
      rewrite negb_involutive in *.
      assert (relation f h = rSpanning) as R.
      { now apply (bar_across a x _ _ f s k h B). }
      rewrite R in E; injection E as <- <- <-.
      assert (forall g m, support g = support f ->
              count (negb a) (g :: m) = count (negb a) m /\
              count a (g :: m) = S (count a m)) as S3.
      { intros g m W; unfold count; simpl; unfold is_across_z in *.
        rewrite W, A; now destruct a. }
      destruct (S3 f l eq_refl) as [S1 S2].
      destruct (S3 (part kPositive f h) p' eq_refl) as [T1 T2].
      destruct (S3 (part kNegative f h) n' eq_refl) as [U1 U2].
      rewrite S1, S2, T1, T2, U1, U2, C1, C3, C4.
      assert (fits up (part kPositive f h) /\ fits down (part kNegative f h))
        as [Fu Fd].
      { destruct (bar_part kPositive a x _ _ f s k h B ltac:(discriminate) N H
                    R K V1) as [P1 P2].
        assert (forall v, value_at (reversed (plane h)) v ==
                (- s) * (coordinate (negb a) v - k)) as H'.
        { intros v; rewrite value_at_reversed, H; ring. }
        destruct (bar_part kNegative a x _ _ f (- s) k h B ltac:(discriminate)
                    ltac:(lra) H' R K V1) as [Q1 Q2].
        assert (Bool.eqb a (negb a) = false) as Ea by now destruct a.
        unfold up, down, above, below.
        destruct (Qlt_le_dec 0 s); split; exists a, x; cbn [lows highs];
          rewrite Ea, eqb_reflx; (split; [exact X|]).
        - apply P1; lra.
        - apply Q2; lra.
        - apply P2; destruct (Q_dec s 0) as [[|]|]; lra || contradiction.
        - apply Q1; destruct (Q_dec s 0) as [[|]|]; lra || contradiction. }
      repeat split; auto; constructor; assumption.
Qed.

(** S3.3: whatever roots are chosen. *)
Lemma cell_nodes : forall choose_root at_most place l,
  Forall valid l -> (length l <= at_most)%nat ->
  (exists cell, cell_of cell l) ->
  nodes (build_at Fragment Splitter splitter_of relation split choose_root
           at_most place l) =
  (count true l + count false l + count true l * count false l)%nat.
Proof.
  intros choose_root.
  apply (build_induction Fragment Splitter source splitter_of relation split
    choose_root valid own_plane split_valid (fun l t =>
      (exists cell, cell_of cell l) -> nodes t =
      (count true l + count false l + count true l * count false l)%nat)).
  - reflexivity.
  - intros l root c p n place at_most V I _ D C _ _ P Q (cell & G).
    destruct G as [F A]; pose proof F as F'; rewrite Forall_forall in F'.
    destruct (F' root I) as (z & k & K & B).
    destruct B as ((s & N & H) & B).
    destruct (cell_distribute z k (splitter_of root) s N H cell l c p n K V
                (conj F A) D) as (Gp & Gn & C1 & C2 & C3 & C4).
    specialize (P (ex_intro (fun b => cell_of b p) _ Gp)).
    specialize (Q (ex_intro (fun b => cell_of b n) _ Gn)).
    assert (count z c = 1%nat) as C5.
    { assert (forall f, In f c -> level z k (support f)) as L.
      { intros f J.
        apply (distribute_coincident Fragment Splitter source relation split _ _
                 _ _ _ f D) in J.
        destruct J as [J R]; destruct (F' f J) as (a & x & X & M).
        destruct (Bool.bool_dec a z) as [-> | O].
        - destruct (bar_beside z x _ _ f s k (splitter_of root) M N H)
            as (R1 & R2 & R3).
          destruct (Q_dec (s * (x - k)) 0) as [[Y | Y] | Y].
          + rewrite (R3 Y) in R; discriminate.
          + rewrite (R2 Y) in R; discriminate.
          + apply level_sign in Y; [|exact N].
            destruct M as [(t & T & M) _]; exists t; split; [exact T|].
            intros v; rewrite M; assert (x == k) as -> by lra; reflexivity.
        - assert (z = negb a) as -> by (destruct a, z; simpl; congruence).
          rewrite (bar_across a x _ _ f s k (splitter_of root) M N H K) in R.
          discriminate. }
      assert (ForallOrdPairs (fun f g => apart (support f) (support g)) c)
        as A'.
      { clear - D A; revert c p n D; generalize (splitter_of root); intros h.
        induction l as [|f l IH]; intros c p n D; simpl in D.
        - injection D as <- <- <-; constructor.
        - inversion A as [|? ? A1 A2]; subst.
          destruct (distribute Fragment Splitter relation split l h)
            as [[c' p'] n'] eqn:E.
          specialize (IH A2 c' p' n' eq_refl).
          destruct (relation f h); injection D as <- <- <-; auto.
          constructor; [|exact IH]; rewrite Forall_forall in *; intros g J.
          apply A1; apply (distribute_coincident Fragment Splitter source
            relation split _ _ _ _ _ g E) in J; tauto. }
      assert (count z c = length c) as ->.
      { clear - C2; unfold count in *; induction c as [|f c IH];
          [reflexivity|].
        simpl in *; destruct (is_across_z f), z; simpl in *; auto;
          discriminate. }
      destruct c as [|f [|g c]]; [destruct C | reflexivity | exfalso].
      inversion A' as [|? ? A1 _]; subst; inversion A1 as [|? ? A2 _]; subst.
      apply (A2 z k); apply L; simpl; auto. }
    simpl nodes; rewrite P, Q; destruct z; simpl in C2, C3, C4; rewrite C1, C3,
      C4, C5; nia.
Qed.

(** ** The theorem *)

Lemma across_valid : forall m i, (0 <= m)%Z ->
  polygon_ok (fst (across_z m i)) (snd (across_z m i)) /\
  polygon_ok (fst (across_y m i)) (snd (across_y m i)).
Proof.
  intros m i M; assert (0 <= inject_Z m) as Q.
  { change 0 with (inject_Z 0); now rewrite <- Zle_Qle. }
  unfold across_z, across_y; revert Q.
  generalize (inject_Z m) (inject_Z i); intros r x Q.
  assert (0 < r + 2) as Y by lra; assert (0 < r + 1) as Z by lra.
  revert Y Z; generalize (r + 2) (r + 1) (x + 1); clear; intros y z k Y Z.
  assert (0 < y * y) as YY by nra; assert (0 < z * z) as ZZ by nra.
  split; constructor; unfold round, point; simpl.
  - intros v [<- | [<- | [<- | [<- | []]]]]; unfold value_at; simpl; ring.
  - intros p q v [E | [E | [E | [E | []]]]]; injection E as <- <-;
      intros [<- | [<- | [<- | [<- | []]]]]; unfold value_at, edge_plane, cross,
      dot, difference, normal; simpl; ring_simplify; nra.
  - intros p q [E | [E | [E | [E | []]]]]; injection E as <- <-;
      intros (A & B & C); simpl in *; lra.
  - repeat constructor; intros (A & B & C); simpl in *; lra.
  - eexists; eexists; eexists; split; [left; reflexivity|]; simpl.
    split; [right; right; left; reflexivity|]; unfold value_at, edge_plane,
      cross, dot, difference, normal; simpl; ring_simplify; nra.
  - intros v [<- | [<- | [<- | [<- | []]]]]; unfold value_at; simpl; ring.
  - intros p q v [E | [E | [E | [E | []]]]]; injection E as <- <-;
      intros [<- | [<- | [<- | [<- | []]]]]; unfold value_at, edge_plane, cross,
      dot, difference, normal; simpl; ring_simplify; nra.
  - intros p q [E | [E | [E | [E | []]]]]; injection E as <- <-;
      intros (A & B & C); simpl in *; lra.
  - repeat constructor; intros (A & B & C); simpl in *; lra.
  - eexists; eexists; eexists; split; [left; reflexivity|]; simpl.
    split; [right; right; left; reflexivity|]; unfold value_at, edge_plane,
      cross, dot, difference, normal; simpl; ring_simplify; nra.
Qed.

Lemma level_of_across_z : forall m i z k, (0 <= m)%Z ->
  level z k (fst (across_z m i)) -> z = true /\ k == inject_Z i + 1.
Proof.
  intros m i z k M (s & N & H); assert (0 <= inject_Z m) as Q.
  { change 0 with (inject_Z 0); now rewrite <- Zle_Qle. }
  unfold across_z, value_at in H; simpl in H; revert Q H.
  generalize (inject_Z m) (inject_Z i); intros r x Q H.
  pose proof (H (point 0 0 (x + 1))) as A; pose proof (H (point 0 0 x)) as B.
  destruct z; simpl in A, B.
  - split; [reflexivity|].
    assert (s * (x + 1 - k) == 0) as C by (rewrite <- A; ring).
    apply level_sign in C; [lra | exact N].
  - exfalso; assert (r + 2 == 0); [|lra].
    setoid_replace (r + 2) with ((0 * 0 + 0 * 0 + (r + 2) * (x + 1) +
      - ((r + 2) * (x + 1))) - (0 * 0 + 0 * 0 + (r + 2) * x +
      - ((r + 2) * (x + 1)))) by ring.
    rewrite A, B; ring.
Qed.

Lemma level_of_across_y : forall m j z k, (0 <= m)%Z ->
  level z k (fst (across_y m j)) -> z = false /\ k == inject_Z j + 1.
Proof.
  intros m j z k M (s & N & H); assert (0 <= inject_Z m) as Q.
  { change 0 with (inject_Z 0); now rewrite <- Zle_Qle. }
  unfold across_y, value_at in H; simpl in H; revert Q H.
  generalize (inject_Z m) (inject_Z j); intros r x Q H.
  pose proof (H (point 0 (x + 1) 0)) as A; pose proof (H (point 0 x 0)) as B.
  destruct z; simpl in A, B.
  - exfalso; assert (r + 1 == 0); [|lra].
    setoid_replace (r + 1) with ((0 * 0 + - (r + 1) * x + 0 * 0 +
      (r + 1) * (x + 1)) - (0 * 0 + - (r + 1) * (x + 1) + 0 * 0 +
      (r + 1) * (x + 1))) by ring.
    rewrite A, B; ring.
  - split; [reflexivity|].
    assert (s * (x + 1 - k) == 0) as C by (rewrite <- A; ring).
    apply level_sign in C; [lra | exact N].
Qed.

(** The cell of the whole scene. *)
Definition whole_cell (m : Z) : Cell :=
  {| lows := fun _ => 0;
     highs := fun z => if z then inject_Z m + 1 else inject_Z m + 2 |}.

Lemma across_fits : forall m i id, (0 <= i < m)%Z ->
  fits (whole_cell m) (whole id (fst (across_z m i)) (snd (across_z m i))) /\
  fits (whole_cell m) (whole id (fst (across_y m i)) (snd (across_y m i))).
Proof.
  intros m i id [I L]; assert (0 <= inject_Z i) as A.
  { change 0 with (inject_Z 0); now rewrite <- Zle_Qle. }
  assert (inject_Z i + 1 <= inject_Z m) as B.
  { change 1 with (inject_Z 1); rewrite <- inject_Z_plus, <- Zle_Qle; lia. }
  unfold across_z, across_y, fits, whole_cell.
  revert A B; generalize (inject_Z i) (inject_Z m); intros x r A B.
  split; [exists true | exists false]; exists (x + 1); simpl;
    (split; [lra|]); unfold bar, level; simpl.
  - split; [|split; [|split]].
    + exists (r + 2); split; [lra|]; intros v; unfold value_at; simpl; ring.
    + intros v [<- | [<- | [<- | [<- | []]]]]; simpl; lra.
    + exists (point 0 0 (x + 1)); simpl; split; [auto | reflexivity].
    + exists (point 1 (r + 2) (x + 1)); simpl; split; [auto | reflexivity].
  - split; [|split; [|split]].
    + exists (- (r + 1)); split; [lra|]; intros v; unfold value_at; simpl; ring.
    + intros v [<- | [<- | [<- | [<- | []]]]]; simpl; lra.
    + exists (point 2 (x + 1) 0); simpl; split; [auto | reflexivity].
    + exists (point 3 (x + 1) (r + 1)); simpl; split; [auto | reflexivity].
Qed.

Lemma numbers_in : forall m i, In i (numbers m) -> (0 <= i < Z.of_nat m)%Z.
Proof.
  unfold numbers; intros m i I; apply in_map_iff in I.
  destruct I as (k & <- & K); apply in_seq in K; lia.
Qed.

Lemma pairs_map : forall (A B : Type) (R : B -> B -> Prop) (g : A -> B) l,
  NoDup l -> (forall x y, x <> y -> R (g x) (g y)) ->
  ForallOrdPairs R (map g l).
Proof.
  intros A B R g l N H; induction N as [|x l X N IH]; simpl; constructor; auto.
  apply Forall_forall; intros b I; apply in_map_iff in I.
  destruct I as (y & <- & Y); apply H; intros ->; contradiction.
Qed.

Lemma pairs_app : forall (A : Type) (R : A -> A -> Prop) l m,
  ForallOrdPairs R l -> ForallOrdPairs R m ->
  (forall x y, In x l -> In y m -> R x y) -> ForallOrdPairs R (l ++ m).
Proof.
  intros A R l m L M H; induction L as [|x l X L IH]; simpl; [exact M|].
  constructor; [|apply IH; intros; apply H; simpl; auto].
  apply Forall_app; split; [exact X|]; apply Forall_forall; intros y Y.
  apply H; simpl; auto.
Qed.

Lemma cell_of_polygons : forall cell scene id,
  Forall (fun p => forall id, fits cell (whole id (fst p) (snd p))) scene ->
  ForallOrdPairs (fun p q => apart (fst p) (fst q)) scene ->
  cell_of cell (polygons_from id scene).
Proof.
  intros cell scene id F A; revert id; unfold cell_of.
  induction A as [|[h c] scene X A IH]; intros id; simpl; [split; constructor|].
  inversion F as [|? ? F1 F2]; subst; destruct (IH F2 (id + 1)%Z) as [B C].
  split; constructor; auto; simpl.
  clear - X; revert id; induction X as [|[k d] scene Y X IH]; intros id; simpl;
    constructor; auto.
Qed.

Lemma grid_cell : forall m,
  cell_of (whole_cell (Z.of_nat m)) (polygons_of (grid_scene m)).
Proof.
  intros m; apply cell_of_polygons; unfold grid_scene.
  - apply Forall_forall; intros p P; apply in_app_or in P.
    destruct P as [P | P]; apply in_map_iff in P; destruct P as (i & <- & I);
      intros id; apply numbers_in in I.
    + exact (proj1 (across_fits (Z.of_nat m) i id I)).
    + exact (proj2 (across_fits (Z.of_nat m) i id I)).
  - assert (NoDup (numbers m)) as N.
    { unfold numbers; apply FinFun.Injective_map_NoDup; [|apply seq_NoDup].
      intros x y E; lia. }
    assert (0 <= Z.of_nat m)%Z as M by lia.
    assert (forall x y : Z, x <> y ->
            ~ inject_Z x + 1 == inject_Z y + 1) as D.
    { intros x y X E; apply X; apply inject_Z_injective; lra. }
    apply pairs_app; [apply pairs_map | apply pairs_map |]; auto.
    + intros x y X z k A B; apply level_of_across_z in A, B; auto.
      destruct A as [_ A], B as [_ B]; apply (D x y X); lra.
    + intros x y X z k A B; apply level_of_across_y in A, B; auto.
      destruct A as [_ A], B as [_ B]; apply (D x y X); lra.
    + intros p q P Q z k A B; apply in_map_iff in P, Q.
      destruct P as (x & <- & _), Q as (y & <- & _).
      apply level_of_across_z in A; auto; apply level_of_across_y in B; auto.
      destruct A as [A _], B as [B _]; congruence.
Qed.

Lemma count_polygons : forall z scene id,
  count z (polygons_from id scene) =
  length (filter (fun p => Bool.eqb (negb (Qeq_bool (pc (fst p)) 0)) z) scene).
Proof.
  intros z scene; induction scene as [|[h c] scene IH]; intros id;
    [reflexivity|].
  unfold count in *; simpl; unfold is_across_z at 1; simpl.
  destruct (Bool.eqb _ z); simpl; now rewrite IH.
Qed.

Lemma grid_count : forall z m, count z (polygons_of (grid_scene m)) = m.
Proof.
  intros z m; unfold polygons_of; rewrite count_polygons.
  assert (forall l, length (filter (fun p : Plane * list Point =>
            Bool.eqb (negb (Qeq_bool (pc (fst p)) 0)) z)
            (map (across_z (Z.of_nat m)) l)) = if z then length l else 0%nat)
    as A.
  { assert (Qeq_bool (inject_Z (Z.of_nat m) + 2) 0 = false) as E.
    { apply not_true_is_false; intros E; apply Qeq_bool_iff in E.
      assert (0 <= inject_Z (Z.of_nat m)); [|lra].
      change 0 with (inject_Z 0); rewrite <- Zle_Qle; lia. }
    induction l as [|i l IH]; [now destruct z|]; simpl.
    rewrite E; destruct z; simpl; now rewrite IH. }
  assert (forall l, length (filter (fun p : Plane * list Point =>
            Bool.eqb (negb (Qeq_bool (pc (fst p)) 0)) z)
            (map (across_y (Z.of_nat m)) l)) = if z then 0%nat else length l)
    as B.
  { induction l as [|i l IH]; [now destruct z|]; simpl.
    destruct z; simpl; now rewrite IH. }
  unfold grid_scene; rewrite filter_app, app_length, A, B.
  unfold numbers; rewrite map_length, seq_length; destruct z; lia.
Qed.

Theorem grid_scene_ok : forall m, scene_ok (grid_scene m).
Proof.
  intros m; unfold scene_ok, grid_scene; apply Forall_forall; intros p P.
  apply in_app_or in P; destruct P as [P | P]; apply in_map_iff in P;
    destruct P as (i & <- & _).
  - exact (proj1 (across_valid (Z.of_nat m) i ltac:(lia))).
  - exact (proj2 (across_valid (Z.of_nat m) i ltac:(lia))).
Qed.

Lemma pairs_permuted : forall (A : Type) (R : A -> A -> Prop),
  (forall x y, R x y -> R y x) -> forall l m, Permutation l m ->
  ForallOrdPairs R l -> ForallOrdPairs R m.
Proof.
  intros A R S l m P;
    induction P as [|x l m P IH | x y l | l m k P1 IH1 P2 IH2]; intros H; auto.
  - inversion H as [|? ? X Y]; subst; constructor; auto.
    apply Forall_forall; intros z Z; rewrite Forall_forall in X; apply X.
    now apply (Permutation_in z (Permutation_sym P)).
  - inversion H as [|? ? X Y]; subst; inversion Y as [|? ? X' Y']; subst.
    inversion X; subst; repeat constructor; auto.
Qed.

(** S3.L7: n polygons, and n (n + 4) / 4 nodes, whatever roots are chosen. *)
Theorem grid_nodes : forall choose_root m,
  let n := length (polygons_of (grid_scene m)) in
  n = (2 * m)%nat /\
  nodes (build Fragment Splitter splitter_of relation split choose_root
           (polygons_of (grid_scene m))) = (n * (n + 4) / 4)%nat.
Proof.
  intros choose_root m n.
  assert (n = 2 * m)%nat as E.
  { unfold n, polygons_of.
    assert (forall scene id, length (polygons_from id scene) = length scene)
      as L.
    { induction scene as [|[h c] scene IH]; intros id; simpl; auto. }
    rewrite L; unfold grid_scene, numbers.
    rewrite app_length, !map_length, seq_length; lia. }
  split; [exact E|]; unfold build; rewrite cell_nodes.
  - rewrite !grid_count, E.
    replace (2 * m * (2 * m + 4))%nat with ((m + m + m * m) * 4)%nat by lia.
    now rewrite Nat.div_mul.
  - apply polygons_valid, grid_scene_ok.
  - reflexivity.
  - exists (whole_cell (Z.of_nat m)); apply grid_cell.
Qed.

(** And when the polygons are inserted, in any order. *)
Theorem grid_nodes_by_insertion : forall m polygons,
  Permutation polygons (polygons_of (grid_scene m)) ->
  let n := length polygons in
  nodes (insert_all Fragment Splitter source splitter_of relation split polygons
           Nothing) = (n * (n + 4) / 4)%nat.
Proof.
  intros m polygons P n.
  destruct (grid_nodes (fun _ _ => 0%nat) m) as [E _].
  assert (forall z, count z polygons = m) as C.
  { intros z; rewrite <- (grid_count z m); unfold count; clear - P.
    induction P; simpl; try reflexivity.
    - destruct (Bool.eqb _ _); simpl; now rewrite IHP.
    - destruct (Bool.eqb _ _), (Bool.eqb _ _); reflexivity.
    - congruence. }
  assert (Forall valid polygons) as V.
  { apply Forall_forall; intros f F.
    pose proof (polygons_valid _ (grid_scene_ok m)) as V.
    rewrite Forall_forall in V; apply V; now apply (Permutation_in f P). }
  destruct (grid_cell m) as [F A].
  rewrite (insertion_nodes Fragment Splitter source splitter_of relation split
             (fun _ _ => 0%nat) valid own_plane split_valid
             (fun _ _ => eq_refl) polygons V).
  unfold build; rewrite cell_nodes; auto.
  - unfold n; rewrite !C, (Permutation_length P), E.
    replace (2 * m * (2 * m + 4))%nat with ((m + m + m * m) * 4)%nat by lia.
    now rewrite Nat.div_mul.
  - exists (whole_cell (Z.of_nat m)); split.
    + apply Forall_forall; intros f I; rewrite Forall_forall in F; apply F.
      now apply (Permutation_in f P).
    + refine (pairs_permuted _ _ _ _ _ (Permutation_sym P) A).
      intros h k H z x K L; apply (H z x L K).
Qed.
