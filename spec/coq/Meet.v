(** * S1.5: where two planes meet the plane of three points, by the filter.

    Read beside the second [meet] of fast/src/exact/filter.hpp: the point is told by
    the values [f] and [g] that the two planes take at the three points. As in
    [Filter.v] doubles are modelled by what rounds. *)

From Coq Require Import QArith Qabs Qminmax Qfield Lqa.
From Halfspace Require Import Base Filter Vertex.

Section Rounding.
Variable rnd : Q -> Q.
Hypothesis rounds : forall v, Qabs (rnd v - v) <= kRounding * Qabs v.

(** ** The same operations in the same order as filter.hpp *)

Local Notation value := bounded_value.
Local Notation off := bounded_error.
Local Notation size b := (Qabs (bounded_value b)).

(** A component of f x g, and a bound on how far it is off. *)
Definition minor (fj fk gj gk : Bounded) : Q :=
  rnd (rnd (value fj * value gk) - rnd (value fk * value gj)).

Definition doubt_of_minor (fj fk gj gk : Bounded) : Q :=
  rnd (rnd (rnd (rnd (rnd (rnd (
    rnd (size fj * off gk) + rnd (size gk * off fj)) +
    rnd (off fj * off gk)) + rnd (size fk * off gj)) +
    rnd (size gj * off fk)) + rnd (off fk * off gj)) +
    rnd (3 * kRounding *
         rnd (rnd (size fj * size gk) + rnd (size fk * size gj)))).

(** This share of a bound pays for the bound's own roundings. *)
Definition doubt_growth : Q := Eval cbv in 1 # 2 ^ 40.

Definition doubt_of_minors (d0 d1 d2 : Q) : Q :=
  rnd (rnd (rnd (rnd (0 + d0) + d1) + d2) * (1 + doubt_growth)).

Definition total_of (w0 w1 w2 : Q) : Q := rnd (rnd (w0 + w1) + w2).

Definition sure_of (total doubt : Q) : Q :=
  rnd (Qabs total - rnd (2 * doubt)).

Definition coordinate (s t a b c : Q) : Q :=
  rnd (a + rnd (rnd (s * rnd (b - a)) + rnd (t * rnd (c - a)))).

(** How many units the roundings of a coordinate are given. *)
Definition rounding_factor : Q := 16.

Definition error_of_meet (extent doubt sure s t rounding : Q) : Q :=
  rnd (rnd (rnd (rnd (extent * rnd (rnd (2 * doubt) / sure)) +
                 rnd (rnd (rounding_factor * kRounding * extent) *
                      rnd (Qabs s + Qabs t))) * (1 + doubt_growth)) +
       rounding).

(** ** How far a component is off *)

(** What the ends' errors and the roundings can make of it. *)
Definition exact_doubt (fj fk gj gk : Bounded) : Q :=
  size fj * off gk + size gk * off fj + off fj * off gk +
  (size fk * off gj + size gj * off fk + off fk * off gj) +
  3 * kRounding * (size fj * size gk + size fk * size gj).

Definition sizes_of (fj fk gj gk : Bounded) : Q :=
  size fj * size gk + size fk * size gj.

Definition near (b : Bounded) (truth : Q) : Prop :=
  Qabs (value b - truth) <= off b.

Lemma near_off : forall b truth, near b truth -> 0 <= off b.
Proof.
  intros b truth N. eapply Qle_trans; [ apply Qabs_nonneg | exact N ].
Qed.

Lemma product_of_truths : forall f g tf tg, near f tf -> near g tg ->
  Qabs (value f * value g - tf * tg) <=
  size f * off g + size g * off f + off f * off g.
Proof.
  intros f g tf tg F G. unfold near in *.
  setoid_replace (value f * value g - tf * tg) with
    (value f * (value g - tg) + value g * (value f - tf) +
     - ((value f - tf) * (value g - tg))) by ring.
  apply abs_sum; [ apply abs_sum | rewrite Qabs_opp ]; apply abs_product;
    auto using Qle_refl.
Qed.

Theorem minor_is_near : forall fj fk gj gk tfj tfk tgj tgk,
  near fj tfj -> near fk tfk -> near gj tgj -> near gk tgk ->
  Qabs (minor fj fk gj gk - (tfj * tgk - tfk * tgj)) <=
  exact_doubt fj fk gj gk -
  (kRounding - kRounding * kRounding) * sizes_of fj fk gj gk /\
  Qabs (minor fj fk gj gk) <=
  (1 + 3 * kRounding) * sizes_of fj fk gj gk.
Proof.
  intros fj fk gj gk tfj tfk tgj tgk Fj Fk Gj Gk.
  assert (A := product_of_truths fj gk tfj tgk Fj Gk).
  assert (B := product_of_truths fk gj tfk tgj Fk Gj).
  assert (C := product_within rnd rounds (value fj) (value gk) _ (Qle_refl _)).
  assert (D := product_within rnd rounds (value fk) (value gj) _ (Qle_refl _)).
  unfold minor, exact_doubt, sizes_of.
  set (x := value fj * value gk) in *. set (y := value fk * value gj) in *.
  set (rx := rnd x) in *. set (ry := rnd y) in *.
  assert (X : Qabs x <= size fj * size gk) by (unfold x; rewrite Qabs_Qmult;
    apply Qle_refl).
  assert (Y : Qabs y <= size fk * size gj) by (unfold y; rewrite Qabs_Qmult;
    apply Qle_refl).
  assert (X0 := Qabs_nonneg x). assert (Y0 := Qabs_nonneg y).
  set (sx := size fj * size gk) in *. set (sy := size fk * size gj) in *.
  assert (E : Qabs (rx - ry - (x - y)) <= kRounding * (sx + sy)).
  { setoid_replace (rx - ry - (x - y)) with ((rx - x) + - (ry - y)) by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ]. rewrite Qabs_opp. lra. }
  assert (XY : Qabs (x - y) <= sx + sy).
  { setoid_replace (x - y) with (x + - y) by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ]. rewrite Qabs_opp. lra. }
  assert (F := rnd_within rnd rounds _ _ _ _ E XY).
  set (m := rnd (rx - ry)) in *. split.
  - setoid_replace (m - (tfj * tgk - tfk * tgj)) with
      ((m - (x - y)) + ((x - tfj * tgk) + - (y - tfk * tgj))) by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ].
    eapply Qle_trans; [ apply Qplus_le_r; apply Qabs_triangle | ].
    rewrite Qabs_opp. clear - A B F X0 X Y0 Y. unfold kRounding in *. lra.
  - setoid_replace m with ((x - y) + (m - (x - y))) by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ].
    clear - F XY X0 X Y0 Y. unfold kRounding in *. lra.
Qed.

(** ** The doubt that is computed is no smaller, its own roundings included *)

Lemma product_below : forall u v, 0 <= u -> 0 <= v ->
  (1 - kRounding) * (u * v) <= rnd (u * v).
Proof.
  intros u v U V. apply (rnd_below rnd rounds);
    [ now apply Qmult_le_0_compat | apply Qle_refl ].
Qed.

Lemma sum_below : forall u v u' v', 0 <= u' -> 0 <= v' -> u' <= u -> v' <= v ->
  (1 - kRounding) * (u' + v') <= rnd (u + v).
Proof. intros. apply (rnd_below rnd rounds); lra. Qed.

Lemma doubt_of_minor_is_enough : forall fj fk gj gk,
  0 <= off fj -> 0 <= off fk -> 0 <= off gj -> 0 <= off gk ->
  0 <= exact_doubt fj fk gj gk /\
  3 * kRounding * sizes_of fj fk gj gk <= exact_doubt fj fk gj gk /\
  (1 - 16 * kRounding) * exact_doubt fj fk gj gk <=
  doubt_of_minor fj fk gj gk.
Proof.
  intros fj fk gj gk Oj Ok Pj Pk.
  unfold doubt_of_minor, exact_doubt, sizes_of.
  assert (Sj := Qabs_nonneg (value fj)). assert (Sk := Qabs_nonneg (value fk)).
  assert (Tj := Qabs_nonneg (value gj)). assert (Tk := Qabs_nonneg (value gk)).
  assert (A1 := product_below _ _ Sj Pk).
  assert (A2 := product_below _ _ Tk Oj).
  assert (A3 := product_below _ _ Oj Pk).
  assert (A4 := product_below _ _ Sk Pj).
  assert (A5 := product_below _ _ Tj Ok).
  assert (A6 := product_below _ _ Ok Pj).
  assert (A7 := product_below _ _ Sj Tk).
  assert (A8 := product_below _ _ Sk Tj).
  assert (B1 := Qmult_le_0_compat _ _ Sj Pk).
  assert (B2 := Qmult_le_0_compat _ _ Tk Oj).
  assert (B3 := Qmult_le_0_compat _ _ Oj Pk).
  assert (B4 := Qmult_le_0_compat _ _ Sk Pj).
  assert (B5 := Qmult_le_0_compat _ _ Tj Ok).
  assert (B6 := Qmult_le_0_compat _ _ Ok Pj).
  assert (B7 := Qmult_le_0_compat _ _ Sj Tk).
  assert (B8 := Qmult_le_0_compat _ _ Sk Tj).
  set (p1 := size fj * off gk) in *. set (p2 := size gk * off fj) in *.
  set (p3 := off fj * off gk) in *. set (p4 := size fk * off gj) in *.
  set (p5 := size gj * off fk) in *. set (p6 := off fk * off gj) in *.
  set (p7 := size fj * size gk) in *. set (p8 := size fk * size gj) in *.
  clearbody p1 p2 p3 p4 p5 p6 p7 p8.
  set (k := 1 - kRounding) in *.
  assert (K0 : 0 <= k) by (unfold k, kRounding; lra).
  assert (Below : forall u v u' v', 0 <= u' -> 0 <= v' -> u' <= u -> v' <= v ->
    k * (u' + v') <= rnd (u + v) /\ 0 <= k * (u' + v')).
  { intros u v u' v' U V LU LV. split; [ now apply sum_below | ].
    apply Qmult_le_0_compat; lra. }
  assert (N : forall p, 0 <= p -> 0 <= k * p)
    by (intros; now apply Qmult_le_0_compat).
  destruct (Below _ _ _ _ (N _ B1) (N _ B2) A1 A2) as [S2 N2].
  destruct (Below _ _ _ _ N2 (N _ B3) S2 A3) as [S3 N3].
  destruct (Below _ _ _ _ N3 (N _ B4) S3 A4) as [S4 N4].
  destruct (Below _ _ _ _ N4 (N _ B5) S4 A5) as [S5 N5].
  destruct (Below _ _ _ _ N5 (N _ B6) S5 A6) as [S6 N6].
  destruct (Below _ _ _ _ (N _ B7) (N _ B8) A7 A8) as [S7 N7].
  assert (S8 : k * (3 * kRounding * (k * (k * p7 + k * p8))) <=
    rnd (3 * kRounding * rnd (rnd p7 + rnd p8))).
  { apply (rnd_below rnd rounds).
    - apply Qmult_le_0_compat; [ discriminate | exact N7 ].
    - rewrite !(Qmult_comm (3 * kRounding)). apply Qmult_le_compat_r;
        [ exact S7 | discriminate ]. }
  assert (N8 : 0 <= k * (3 * kRounding * (k * (k * p7 + k * p8)))).
  { apply N, Qmult_le_0_compat; [ discriminate | exact N7 ]. }
  destruct (Below _ _ _ _ N6 N8 S6 S8) as [S9 _].
  split; [ | split ].
  - clear - B1 B2 B3 B4 B5 B6 B7 B8. unfold kRounding. lra.
  - clear - B1 B2 B3 B4 B5 B6 B7 B8. unfold kRounding. lra.
  - eapply Qle_trans; [ | exact S9 ].
    clear - B1 B2 B3 B4 B5 B6 B7 B8. unfold k, kRounding. lra.
Qed.

Lemma doubt_of_minors_is_enough : forall d0 d1 d2 e0 e1 e2,
  0 <= e0 -> 0 <= e1 -> 0 <= e2 ->
  (1 - 16 * kRounding) * e0 <= d0 -> (1 - 16 * kRounding) * e1 <= d1 ->
  (1 - 16 * kRounding) * e2 <= d2 ->
  (1 + 100 * kRounding) * (e0 + e1 + e2) <= doubt_of_minors d0 d1 d2.
Proof.
  intros d0 d1 d2 e0 e1 e2 E0 E1 E2 D0 D1 D2. unfold doubt_of_minors.
  set (k := 1 - kRounding). set (l := 1 - 16 * kRounding) in *.
  assert (L : forall e, 0 <= e -> 0 <= l * e)
    by (intros; apply Qmult_le_0_compat; [ discriminate | assumption ]).
  assert (K : forall e, 0 <= e -> 0 <= k * e)
    by (intros; apply Qmult_le_0_compat; [ discriminate | assumption ]).
  assert (S0 : k * (0 + l * e0) <= rnd (0 + d0))
    by (apply sum_below; auto using Qle_refl).
  assert (N0 : 0 <= k * (0 + l * e0)) by (apply K; specialize (L e0 E0); lra).
  assert (S1 := sum_below _ _ _ _ N0 (L e1 E1) S0 D1). fold k in S1.
  assert (N1 : 0 <= k * (k * (0 + l * e0) + l * e1))
    by (apply K; specialize (L e1 E1); lra).
  assert (S2 := sum_below _ _ _ _ N1 (L e2 E2) S1 D2). fold k in S2.
  assert (N2 : 0 <= k * (k * (k * (0 + l * e0) + l * e1) + l * e2))
    by (apply K; specialize (L e2 E2); lra).
  assert (S3 : k * (k * (k * (k * (0 + l * e0) + l * e1) + l * e2) *
                    (1 + doubt_growth)) <=
    rnd (rnd (rnd (rnd (0 + d0) + d1) + d2) * (1 + doubt_growth))).
  { apply (rnd_below rnd rounds).
    - apply Qmult_le_0_compat; [ exact N2 | discriminate ].
    - apply Qmult_le_compat_r; [ exact S2 | discriminate ]. }
  eapply Qle_trans; [ | exact S3 ].
  clear - E0 E1 E2. unfold k, l, doubt_growth, kRounding. lra.
Qed.

(** ** How far a coordinate is off *)

Local Notation u := kRounding.

Lemma total_is_near : forall w0 w1 w2,
  Qabs (total_of w0 w1 w2 - (w0 + w1 + w2)) <=
  (2 * u + u * u) * (Qabs w0 + Qabs w1 + Qabs w2).
Proof.
  intros w0 w1 w2. unfold total_of.
  assert (A0 := Qabs_nonneg w0). assert (A1 := Qabs_nonneg w1).
  assert (A2 := Qabs_nonneg w2).
  assert (A := Qabs_triangle w0 w1).
  assert (R := rounds (w0 + w1)). set (x := rnd (w0 + w1)) in *.
  assert (B : Qabs (x + w2 - (w0 + w1 + w2)) <= u * (Qabs w0 + Qabs w1)).
  { setoid_replace (x + w2 - (w0 + w1 + w2)) with (x - (w0 + w1)) by ring.
    unfold kRounding in *. lra. }
  assert (C : Qabs (w0 + w1 + w2) <= Qabs w0 + Qabs w1 + Qabs w2).
  { eapply Qle_trans; [ apply Qabs_triangle | ]. lra. }
  assert (D := rnd_within rnd rounds _ _ _ _ B C).
  clear - A0 A1 A2 D. unfold kRounding in *. lra.
Qed.

(** What is known of the components [w], their errors [e] and sizes [z]. *)
Definition component (w truth e z : Q) : Prop :=
  Qabs (w - truth) <= e - (u - u * u) * z /\
  Qabs w <= (1 + 3 * u) * z /\ 0 <= z /\ 3 * u * z <= e.

Lemma errors_together : forall w0 w1 w2 t0 t1 t2 e0 e1 e2 z0 z1 z2,
  component w0 t0 e0 z0 -> component w1 t1 e1 z1 -> component w2 t2 e2 z2 ->
  Qabs (w1 - t1) + Qabs (w2 - t2) +
  Qabs (total_of w0 w1 w2 - (t0 + t1 + t2)) <=
  (2 + 9 * u) * (e0 + e1 + e2).
Proof.
  intros w0 w1 w2 t0 t1 t2 e0 e1 e2 z0 z1 z2
    [A0 [B0 [Z0 E0]]] [A1 [B1 [Z1 E1]]] [A2 [B2 [Z2 E2]]].
  assert (T := total_is_near w0 w1 w2).
  assert (R : Qabs (total_of w0 w1 w2 - (t0 + t1 + t2)) <=
    Qabs (total_of w0 w1 w2 - (w0 + w1 + w2)) +
    (Qabs (w0 - t0) + Qabs (w1 - t1) + Qabs (w2 - t2))).
  { setoid_replace (total_of w0 w1 w2 - (t0 + t1 + t2)) with
      ((total_of w0 w1 w2 - (w0 + w1 + w2)) +
       ((w0 - t0) + (w1 - t1) + (w2 - t2))) by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ]. apply Qplus_le_r.
    eapply Qle_trans; [ apply Qabs_triangle | ]. apply Qplus_le_l.
    apply Qabs_triangle. }
  clear - A0 B0 Z0 E0 A1 B1 Z1 E1 A2 B2 Z2 E2 T R. unfold kRounding in *. lra.
Qed.

Lemma quotient_is_near : forall w total, ~ total == 0 ->
  Qabs (rnd (w / total) - w / total) <= u * Qabs (w / total) /\
  Qabs (w / total) <= (1 + 2 * u) * Qabs (rnd (w / total)).
Proof.
  intros w total N. assert (R := rounds (w / total)). split; [ exact R | ].
  set (s := w / total) in *.
  assert (K : Qabs s <= Qabs (rnd s) + Qabs (rnd s - s)).
  { setoid_replace s with (rnd s - (rnd s - s)) at 1 by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ]. rewrite Qabs_opp. lra. }
  assert (Qabs (rnd s) >= 0) by apply Qabs_nonneg.
  unfold kRounding in *. lra.
Qed.

Lemma term_is_near : forall s true_s d extent, Qabs d <= extent ->
  Qabs (s - true_s) <= u * Qabs true_s -> Qabs true_s <= (1 + 2 * u) * Qabs s ->
  Qabs (rnd (s * rnd d) - true_s * d) <=
  (301 # 100) * u * (Qabs s * extent) /\
  Qabs (true_s * d) <= (1 + 2 * u) * (Qabs s * extent).
Proof.
  intros s true_s d extent D S T. assert (S0 := Qabs_nonneg s).
  assert (X0 : 0 <= extent) by (assert (K := Qabs_nonneg d); lra).
  assert (R := rounds d).
  assert (A : Qabs (s * (rnd d - d)) <= Qabs s * (u * extent)).
  { apply abs_product; [ apply Qle_refl | ]. unfold kRounding in *. lra. }
  assert (B : Qabs ((s - true_s) * d) <= u * ((1 + 2 * u) * Qabs s) * extent).
  { apply abs_product; [ | exact D ]. unfold kRounding in *. lra. }
  assert (C : Qabs (true_s * d) <= (1 + 2 * u) * Qabs s * extent)
    by (apply abs_product; assumption).
  assert (SX : 0 <= Qabs s * extent) by (now apply Qmult_le_0_compat).
  setoid_replace (Qabs s * (u * extent)) with (u * (Qabs s * extent)) in A
    by ring.
  setoid_replace (u * ((1 + 2 * u) * Qabs s) * extent) with
    (u * (1 + 2 * u) * (Qabs s * extent)) in B by ring.
  setoid_replace ((1 + 2 * u) * Qabs s * extent) with
    ((1 + 2 * u) * (Qabs s * extent)) in C by ring.
  set (sx := Qabs s * extent) in *.
  assert (E : Qabs (s * rnd d - true_s * d) <= (2 * u + 2 * u * u) * sx).
  { setoid_replace (s * rnd d - true_s * d) with
      (s * (rnd d - d) + (s - true_s) * d) by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ].
    clear - A B SX. unfold kRounding in *. lra. }
  assert (F := rnd_within rnd rounds _ _ _ _ E C).
  split; [ | exact C ]. eapply Qle_trans; [ exact F | ].
  clear - SX. unfold kRounding. lra.
Qed.

Lemma coordinate_is_near : forall s t true_s true_t a b c extent M,
  Qabs a <= M -> Qabs (b - a) <= extent -> Qabs (c - a) <= extent ->
  Qabs (s - true_s) <= u * Qabs true_s -> Qabs true_s <= (1 + 2 * u) * Qabs s ->
  Qabs (t - true_t) <= u * Qabs true_t -> Qabs true_t <= (1 + 2 * u) * Qabs t ->
  Qabs (coordinate s t a b c -
        (a + (true_s * (b - a) + true_t * (c - a)))) <=
  6 * u * (extent * (Qabs s + Qabs t)) + u * M.
Proof.
  intros s t true_s true_t a b c extent M HM B C S S' T T'. unfold coordinate.
  destruct (term_is_near s true_s (b - a) extent B S S') as [X X'].
  destruct (term_is_near t true_t (c - a) extent C T T') as [Y Y'].
  set (x := rnd (s * rnd (b - a))) in *. set (y := rnd (t * rnd (c - a))) in *.
  set (tx := true_s * (b - a)) in *. set (ty := true_t * (c - a)) in *.
  assert (SX : 0 <= Qabs s * extent).
  { apply Qmult_le_0_compat; [ apply Qabs_nonneg | ].
    eapply Qle_trans; [ apply Qabs_nonneg | exact B ]. }
  assert (TX : 0 <= Qabs t * extent).
  { apply Qmult_le_0_compat; [ apply Qabs_nonneg | ].
    eapply Qle_trans; [ apply Qabs_nonneg | exact B ]. }
  setoid_replace (extent * (Qabs s + Qabs t)) with
    (Qabs s * extent + Qabs t * extent) by ring.
  set (sx := Qabs s * extent) in *. set (tx' := Qabs t * extent) in *.
  assert (E : Qabs (x + y - (tx + ty)) <= (301 # 100) * u * (sx + tx')).
  { setoid_replace (x + y - (tx + ty)) with ((x - tx) + (y - ty)) by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ]. lra. }
  assert (F : Qabs (tx + ty) <= (1 + 2 * u) * (sx + tx')).
  { eapply Qle_trans; [ apply Qabs_triangle | ]. lra. }
  assert (G := rnd_within rnd rounds _ _ _ _ E F).
  set (z := rnd (x + y)) in *.
  match type of G with _ <= ?e => set (ez := e) in G end.
  assert (H : Qabs (a + z - (a + (tx + ty))) <= ez).
  { setoid_replace (a + z - (a + (tx + ty))) with (z - (tx + ty)) by ring.
    exact G. }
  assert (I : Qabs (a + (tx + ty)) <= M + (1 + 2 * u) * (sx + tx'))
    by (now apply abs_sum).
  assert (J := rnd_within rnd rounds _ _ _ _ H I).
  eapply Qle_trans; [ exact J | ].
  assert (M0 : 0 <= M) by (assert (K := Qabs_nonneg a); lra).
  clear - SX TX M0. unfold ez, kRounding. lra.
Qed.

(** The point by the components at hand against the true one. *)
Lemma shares_are_near : forall w1 w2 total t1 t2 true_total a b c x extent,
  Qabs (b - a) <= extent -> Qabs (c - a) <= extent -> Qabs (x - a) <= extent ->
  (x - a) * true_total == t1 * (b - a) + t2 * (c - a) -> ~ total == 0 ->
  Qabs (a + (w1 / total * (b - a) + w2 / total * (c - a)) - x) * Qabs total <=
  extent * (Qabs (w1 - t1) + Qabs (w2 - t2) + Qabs (total - true_total)).
Proof.
  intros w1 w2 total t1 t2 true_total a b c x extent B C X Eq N.
  rewrite <- Qabs_Qmult.
  setoid_replace ((a + (w1 / total * (b - a) + w2 / total * (c - a)) - x) *
                  total) with
    ((w1 - t1) * (b - a) + (w2 - t2) * (c - a) +
     - ((total - true_total) * (x - a)) +
     (t1 * (b - a) + t2 * (c - a) - (x - a) * true_total)) by (field; exact N).
  rewrite Eq.
  setoid_replace ((w1 - t1) * (b - a) + (w2 - t2) * (c - a) +
    - ((total - true_total) * (x - a)) +
    (t1 * (b - a) + t2 * (c - a) - (t1 * (b - a) + t2 * (c - a)))) with
    ((w1 - t1) * (b - a) + (w2 - t2) * (c - a) +
     - ((total - true_total) * (x - a))) by ring.
  assert (P := abs_product (w1 - t1) (b - a) _ _ (Qle_refl _) B).
  assert (R := abs_product (w2 - t2) (c - a) _ _ (Qle_refl _) C).
  assert (S := abs_product (total - true_total) (x - a) _ _ (Qle_refl _) X).
  eapply Qle_trans; [ apply Qabs_triangle | ]. rewrite Qabs_opp.
  eapply Qle_trans; [ apply Qplus_le_l; apply Qabs_triangle | ]. lra.
Qed.

(** The bound that filter.hpp computes, its own roundings included. *)
Lemma error_is_enough : forall extent doubt sure s t M far,
  0 <= extent -> 0 <= doubt -> 0 < sure -> 0 <= M ->
  far * sure <= (1 - 90 * u) * (2 * (doubt * extent)) ->
  far + 6 * u * (extent * (Qabs s + Qabs t)) + u * M <=
  error_of_meet extent doubt sure s t (rounding_of_values M).
Proof.
  intros extent doubt sure s t M far X D S HM Far.
  unfold error_of_meet, rounding_of_values.
  set (sigma := Qabs s + Qabs t).
  assert (S0 : 0 <= sigma).
  { unfold sigma. assert (A := Qabs_nonneg s). assert (B := Qabs_nonneg t).
    lra. }
  set (k := 1 - u). assert (K0 : 0 <= k) by discriminate.
  assert (Below : forall v w, 0 <= w -> w <= v -> k * w <= rnd v /\ 0 <= k * w).
  { intros v w W V. split; [ now apply (rnd_below rnd rounds) | ].
    now apply Qmult_le_0_compat. }
  assert (Plus0 : forall v w, 0 <= v -> 0 <= w -> 0 <= v + w)
    by (clear; intros; lra).
  destruct (Below (2 * doubt) (2 * doubt) ltac:(lra) (Qle_refl _)) as [Q1 Q1'].
  assert (Q2 : k * (2 * doubt) / sure <= rnd (2 * doubt) / sure).
  { unfold Qdiv. apply Qmult_le_compat_r; [ exact Q1 | ].
    apply Qlt_le_weak, Qinv_lt_0_compat, S. }
  assert (Q2' : 0 <= k * (2 * doubt) / sure)
    by (apply Qle_shift_div_l; [ exact S | lra ]).
  destruct (Below _ _ Q2' Q2) as [Q3 Q3'].
  set (q := rnd (rnd (2 * doubt) / sure)) in *.
  assert (F : far <= (1 - 80 * u) * (extent * q)).
  { apply (Qmult_le_r _ _ sure S). eapply Qle_trans; [ exact Far | ].
    assert (G : k * (k * (2 * doubt)) <= q * sure).
    { assert (H : k * (k * (2 * doubt) / sure) * sure <= q * sure)
        by (apply Qmult_le_compat_r; [ exact Q3 | lra ]).
      eapply Qle_trans; [ | exact H ].
      setoid_replace (k * (k * (2 * doubt) / sure) * sure) with
        (k * (k * (2 * doubt))) by (field; lra). apply Qle_refl. }
    apply (Qmult_le_compat_r _ _ extent) in G; [ | exact X ].
    assert (DX : 0 <= doubt * extent) by (now apply Qmult_le_0_compat).
    setoid_replace (k * (k * (2 * doubt)) * extent) with
      (k * k * 2 * (doubt * extent)) in G by ring.
    setoid_replace ((1 - 80 * u) * (extent * q) * sure) with
      ((1 - 80 * u) * (q * sure * extent)) by ring.
    set (dx := doubt * extent) in *. set (y := q * sure * extent) in *.
    clear - G DX. unfold k, kRounding in *. lra. }
  assert (Q0 : 0 <= q) by lra.
  assert (P0 : 0 <= extent * q) by (now apply Qmult_le_0_compat).
  destruct (Below (extent * q) _ P0 (Qle_refl _)) as [P1 P1'].
  assert (R0 : 0 <= rounding_factor * u * extent)
    by (apply Qmult_le_0_compat; [ discriminate | exact X ]).
  destruct (Below _ _ R0 (Qle_refl _)) as [R1 R1'].
  destruct (Below _ _ S0 (Qle_refl _)) as [T1 T1'].
  assert (V : k * (rounding_factor * u * extent) * (k * sigma) <=
    rnd (rounding_factor * u * extent) * rnd sigma)
    by (apply Qmult_le_compat_nonneg; split; assumption).
  destruct (Below _ _ (Qmult_le_0_compat _ _ R1' T1') V) as [V1 V1'].
  assert (W : k * (extent * q) +
    k * (k * (rounding_factor * u * extent) * (k * sigma)) <=
    rnd (extent * q) +
    rnd (rnd (rounding_factor * u * extent) * rnd sigma)) by lra.
  destruct (Below _ _ (Plus0 _ _ P1' V1') W) as [W1 W1'].
  assert (G0 : 0 <= 1 + doubt_growth) by discriminate.
  assert (Y := Qmult_le_compat_r _ _ (1 + doubt_growth) W1 G0).
  destruct (Below _ _ (Qmult_le_0_compat _ _ W1' G0) Y) as [Y1 Y1'].
  assert (M1 : 0 <= values_factor * u * M)
    by (apply Qmult_le_0_compat; [ discriminate | exact HM ]).
  assert (Z := Qplus_le_compat _ _ _ _ Y1 (Qle_refl (values_factor * u * M))).
  destruct (Below _ _ (Plus0 _ _ Y1' M1) Z) as [Z1 _].
  eapply Qle_trans; [ | exact Z1 ].
  assert (XS : 0 <= extent * sigma) by (now apply Qmult_le_0_compat).
  setoid_replace (k * (rounding_factor * u * extent) * (k * sigma)) with
    (k * k * rounding_factor * u * (extent * sigma)) by ring.
  set (xq := extent * q) in *. set (xs := extent * sigma) in *.
  clear - F P0 XS HM.
  unfold k, rounding_factor, values_factor, doubt_growth, kRounding in *. lra.
Qed.

(** ** The point *)

Definition meet_of_planes (p0 p1 p2 : Point) (f0 f1 f2 g0 g1 g2 : Bounded)
    (extent rounding : Q) : Vertex :=
  let w0 := minor f1 f2 g1 g2 in
  let w1 := minor f2 f0 g2 g0 in
  let w2 := minor f0 f1 g0 g1 in
  let doubt := doubt_of_minors (doubt_of_minor f1 f2 g1 g2)
    (doubt_of_minor f2 f0 g2 g0) (doubt_of_minor f0 f1 g0 g1) in
  let total := total_of w0 w1 w2 in
  let sure := sure_of total doubt in
  if Qlt_le_dec 0 sure then
    let s := rnd (w1 / total) in
    let t := rnd (w2 / total) in
    {| point := {| px := coordinate s t (px p0) (px p1) (px p2);
                   py := coordinate s t (py p0) (py p1) (py p2);
                   pz := coordinate s t (pz p0) (pz p1) (pz p2) |};
       error := error_of_meet extent doubt sure s t rounding |}
  else {| point := p0; error := rnd (rnd (2 * extent) + rounding) |}.

Lemma minor_is_component : forall fj fk gj gk tfj tfk tgj tgk,
  near fj tfj -> near fk tfk -> near gj tgj -> near gk tgk ->
  component (minor fj fk gj gk) (tfj * tgk - tfk * tgj)
    (exact_doubt fj fk gj gk) (sizes_of fj fk gj gk).
Proof.
  intros fj fk gj gk tfj tfk tgj tgk Fj Fk Gj Gk.
  destruct (minor_is_near fj fk gj gk _ _ _ _ Fj Fk Gj Gk) as [A B].
  destruct (doubt_of_minor_is_enough fj fk gj gk (near_off _ _ Fj)
    (near_off _ _ Fk) (near_off _ _ Gj) (near_off _ _ Gk)) as [_ [C _]].
  repeat split; try assumption. unfold sizes_of.
  assert (D := Qmult_le_0_compat _ _ (Qabs_nonneg (value fj))
                 (Qabs_nonneg (value gk))).
  assert (E := Qmult_le_0_compat _ _ (Qabs_nonneg (value fk))
                 (Qabs_nonneg (value gj))). lra.
Qed.

(** Where it is sure of the total, that is not zero. *)
Lemma sure_tells : forall total doubt, 0 <= doubt -> 0 < sure_of total doubt ->
  ~ total == 0 /\ sure_of total doubt <= (1 + u) * Qabs total.
Proof.
  intros total doubt D S. unfold sure_of in *.
  assert (B : (1 - u) * (2 * doubt) <= rnd (2 * doubt))
    by (apply (rnd_below rnd rounds); [ lra | apply Qle_refl ]).
  set (v := Qabs total - rnd (2 * doubt)) in *.
  assert (R := rounds v). apply (within _ _) in R.
  assert (V : v <= Qabs total) by (unfold v, kRounding in *; lra).
  assert (K : 0 < v /\ rnd v <= (1 + u) * v).
  { destruct (Qlt_le_dec 0 v) as [L | L].
    - split; [ exact L | ]. rewrite (Qabs_pos v) in R by lra. lra.
    - exfalso. rewrite (Qabs_neg v) in R by exact L.
      unfold kRounding in *. lra. }
  destruct K as [K1 K2]. split.
  - intro Z. assert (A : Qabs total == 0) by (rewrite Z; reflexivity). lra.
  - unfold kRounding in *. lra.
Qed.

(** The plane of the three points meets the two planes in a point that is off
    the filter's vertex by at most the bound that goes with it. *)
Theorem meet_of_planes_stands_for :
  forall p0 p1 p2 f0 f1 f2 g0 g1 g2 F0 F1 F2 G0 G1 G2 x extent M,
  near f0 F0 -> near f1 F1 -> near f2 F2 ->
  near g0 G0 -> near g1 G1 -> near g2 G2 ->
  let w1 := F2 * G0 - F0 * G2 in
  let w2 := F0 * G1 - F1 * G0 in
  let w := F1 * G2 - F2 * G1 + w1 + w2 in
  (px x - px p0) * w == w1 * (px p1 - px p0) + w2 * (px p2 - px p0) ->
  (py x - py p0) * w == w1 * (py p1 - py p0) + w2 * (py p2 - py p0) ->
  (pz x - pz p0) * w == w1 * (pz p1 - pz p0) + w2 * (pz p2 - pz p0) ->
  stands_for p1 p0 extent -> stands_for p2 p0 extent ->
  stands_for x p0 extent -> point_within M p0 ->
  let new := meet_of_planes p0 p1 p2 f0 f1 f2 g0 g1 g2 extent
               (rounding_of_values M) in
  stands_for (point new) x (error new).
Proof.
  intros p0 p1 p2 f0 f1 f2 g0 g1 g2 F0 F1 F2 G0 G1 G2 x extent M
    Nf0 Nf1 Nf2 Ng0 Ng1 Ng2 W1 W2 W Ex Ey Ez
    [B1 [B2 B3]] [C1 [C2 C3]] [X1 [X2 X3]] [M1 [M2 M3]] new.
  assert (X0 : 0 <= extent)
    by (assert (K := Qabs_nonneg (px x - px p0)); lra).
  assert (M0 : 0 <= M) by (assert (K := Qabs_nonneg (px p0)); lra).
  assert (K0 := minor_is_component _ _ _ _ _ _ _ _ Nf1 Nf2 Ng1 Ng2).
  assert (K1 := minor_is_component _ _ _ _ _ _ _ _ Nf2 Nf0 Ng2 Ng0).
  assert (K2 := minor_is_component _ _ _ _ _ _ _ _ Nf0 Nf1 Ng0 Ng1).
  assert (T := errors_together _ _ _ _ _ _ _ _ _ _ _ _ K0 K1 K2).
  clear K0 K1 K2.
  destruct (doubt_of_minor_is_enough f1 f2 g1 g2 (near_off _ _ Nf1)
    (near_off _ _ Nf2) (near_off _ _ Ng1) (near_off _ _ Ng2)) as [P0 [_ D0]].
  destruct (doubt_of_minor_is_enough f2 f0 g2 g0 (near_off _ _ Nf2)
    (near_off _ _ Nf0) (near_off _ _ Ng2) (near_off _ _ Ng0)) as [P1 [_ D1]].
  destruct (doubt_of_minor_is_enough f0 f1 g0 g1 (near_off _ _ Nf0)
    (near_off _ _ Nf1) (near_off _ _ Ng0) (near_off _ _ Ng1)) as [P2 [_ D2]].
  assert (D := doubt_of_minors_is_enough _ _ _ _ _ _ P0 P1 P2 D0 D1 D2).
  clear D0 D1 D2. unfold new, meet_of_planes. clear new.
  fold W1 W2 in T. fold W in T.
  set (e0 := exact_doubt f1 f2 g1 g2) in *.
  set (e1 := exact_doubt f2 f0 g2 g0) in *.
  set (e2 := exact_doubt f0 f1 g0 g1) in *.
  set (doubt := doubt_of_minors _ _ _) in *.
  set (v1 := minor f2 f0 g2 g0) in *. set (v2 := minor f0 f1 g0 g1) in *.
  set (total := total_of _ v1 v2) in *.
  assert (E0 : 0 <= e0 + e1 + e2) by lra.
  assert (D0 : 0 <= doubt) by (unfold kRounding in *; lra).
  set (sure := sure_of total doubt).
  destruct (Qlt_le_dec 0 sure) as [S | S]; cbn [point error].
  - destruct (sure_tells total doubt D0 S) as [N Less]. fold sure in Less.
    destruct (quotient_is_near v1 total N) as [S1 S1'].
    destruct (quotient_is_near v2 total N) as [S2 S2'].
    set (s := rnd (v1 / total)) in *. set (t := rnd (v2 / total)) in *.
    assert (One : forall a b c y, Qabs a <= M -> Qabs (b - a) <= extent ->
      Qabs (c - a) <= extent -> Qabs (y - a) <= extent ->
      (y - a) * W == W1 * (b - a) + W2 * (c - a) ->
      Qabs (coordinate s t a b c - y) <=
      error_of_meet extent doubt sure s t (rounding_of_values M)).
    { intros a b c y Ha Hb Hc Hy Eq.
      assert (Near := coordinate_is_near s t _ _ a b c extent M Ha Hb Hc
                        S1 S1' S2 S2').
      assert (Far := shares_are_near v1 v2 total W1 W2 W a b c y extent
                       Hb Hc Hy Eq N).
      set (z := a + (v1 / total * (b - a) + v2 / total * (c - a))) in *.
      eapply Qle_trans; [ | apply (error_is_enough extent doubt sure s t M
                                     (Qabs (z - y)) X0 D0 S M0) ].
      - setoid_replace (coordinate s t a b c - y) with
          ((z - y) + (coordinate s t a b c - z)) by ring.
        eapply Qle_trans; [ apply Qabs_triangle | ]. lra.
      - assert (F0' := Qabs_nonneg (z - y)).
        assert (A : Qabs (z - y) * sure <=
                    Qabs (z - y) * ((1 + u) * Qabs total)).
        { rewrite !(Qmult_comm (Qabs (z - y))).
          apply Qmult_le_compat_r; assumption. }
        assert (B : extent * (Qabs (v1 - W1) + Qabs (v2 - W2) +
                              Qabs (total - W)) <=
                    extent * ((2 + 9 * u) * (e0 + e1 + e2))).
        { rewrite !(Qmult_comm extent). apply Qmult_le_compat_r; assumption. }
        assert (C : (1 + 100 * u) * (extent * (e0 + e1 + e2)) <=
                    doubt * extent).
        { setoid_replace ((1 + 100 * u) * (extent * (e0 + e1 + e2))) with
            ((1 + 100 * u) * (e0 + e1 + e2) * extent) by ring.
          apply Qmult_le_compat_r; assumption. }
        assert (XE : 0 <= extent * (e0 + e1 + e2))
          by (now apply Qmult_le_0_compat).
        setoid_replace (Qabs (z - y) * ((1 + u) * Qabs total)) with
          ((1 + u) * (Qabs (z - y) * Qabs total)) in A by ring.
        setoid_replace (extent * ((2 + 9 * u) * (e0 + e1 + e2))) with
          ((2 + 9 * u) * (extent * (e0 + e1 + e2))) in B by ring.
        set (far := Qabs (z - y) * sure) in *.
        set (ft := Qabs (z - y) * Qabs total) in *.
        set (xe := extent * (e0 + e1 + e2)) in *.
        set (dx := doubt * extent) in *.
        set (r := extent * (Qabs (v1 - W1) + Qabs (v2 - W2) +
                            Qabs (total - W))) in *.
        clear - A B C XE Far. unfold kRounding in *. lra. }
    repeat split; apply One; assumption.
  - assert (K : (1 - u) * ((1 - u) * (2 * extent) + values_factor * u * M) <=
                rnd (rnd (2 * extent) + rounding_of_values M)).
    { assert (R : (1 - u) * (2 * extent) <= rnd (2 * extent))
        by (apply (rnd_below rnd rounds); [ lra | apply Qle_refl ]).
      unfold rounding_of_values. apply (rnd_below rnd rounds);
        unfold values_factor, kRounding in *; lra. }
    assert (All : forall a y, Qabs (y - a) <= extent -> Qabs (a - y) <=
      rnd (rnd (2 * extent) + rounding_of_values M)).
    { intros a y H. setoid_replace (a - y) with (- (y - a)) by ring.
      rewrite Qabs_opp. eapply Qle_trans; [ exact H | ].
      clear - K X0 M0. unfold values_factor, kRounding in *. lra. }
    repeat split; apply All; assumption.
Qed.

(** Such a point is on both planes: any affine function that has the values [f]
    at the three points, [f] being one of the two, is zero there. *)
Theorem meet_of_planes_is_on_the_planes :
  forall h k p0 p1 p2 x,
  let F p := value_at h p in
  let G p := value_at k p in
  let w1 := F p2 * G p0 - F p0 * G p2 in
  let w2 := F p0 * G p1 - F p1 * G p0 in
  let w := F p1 * G p2 - F p2 * G p1 + w1 + w2 in
  ~ w == 0 ->
  (px x - px p0) * w == w1 * (px p1 - px p0) + w2 * (px p2 - px p0) ->
  (py x - py p0) * w == w1 * (py p1 - py p0) + w2 * (py p2 - py p0) ->
  (pz x - pz p0) * w == w1 * (pz p1 - pz p0) + w2 * (pz p2 - pz p0) ->
  value_at h x == 0 /\ value_at k x == 0.
Proof.
  intros h k p0 p1 p2 x F G w1 w2 w N X Y Z.
  assert (On : forall l, value_at l x * w ==
    value_at l p0 * (w - w1 - w2) + value_at l p1 * w1 + value_at l p2 * w2).
  { intro l. setoid_replace (value_at l x * w) with
      (value_at l p0 * w + pa l * ((px x - px p0) * w) +
       pb l * ((py x - py p0) * w) + pc l * ((pz x - pz p0) * w))
      by (unfold value_at; ring).
    rewrite X, Y, Z. unfold value_at. ring. }
  assert (Zero : forall v, v * w == 0 -> v == 0).
  { intros v H. apply Qmult_integral in H. destruct H; [ assumption | ].
    contradiction. }
  split; apply Zero; rewrite On; unfold w, w1, w2, F, G; ring.
Qed.

End Rounding.
