(** S1.6: how large the numbers of the definitions become.

    Read beside spec/S1-geometry.md, S1.6, and fast/src/exact/exact_plane.hpp.  Everything
    is integers; [bits] is the least width for every value of a bound. *)

From Coq Require Import ZArith Lia List.
Import ListNotations.
Local Open Scope Z_scope.

(** * The grid *)

(** S1.1: a coordinate of the grid of [n] bits. *)
Definition on_grid (n c : Z) : Prop := - 2 ^ (n - 1) <= c < 2 ^ (n - 1).

Record GridPoint := { gx : Z; gy : Z; gz : Z }.
Definition in_grid (n : Z) (p : GridPoint) : Prop :=
  on_grid n (gx p) /\ on_grid n (gy p) /\ on_grid n (gz p).

(** S1.6: [M] bounds coordinates, [L] their differences. *)
Definition bound_M (n : Z) : Z := 2 ^ (n - 1).
Definition bound_L (n : Z) : Z := 2 ^ n - 1.

(** A number has [b] bits if its size is below [2 ^ (b - 1)]. *)
Definition has_bits (b v : Z) : Prop := Z.abs v < 2 ^ (b - 1).

(** The words of fast/src/exact/exact_plane.hpp, 64 bits each. *)
Definition kWords (n : Z) : Z :=
  if n =? 26 then 4 else if n =? 40 then 6 else 8.

Definition is_grid (n : Z) : Prop := n = 26 \/ n = 40 \/ n = 54.

(** * The numbers of the definitions *)

(** Components of (p1 - p0) x (p2 - p0) (S1.4). *)
Definition cross (y0 z0 y1 z1 y2 z2 : Z) : Z :=
  (y1 - y0) * (z2 - z0) - (z1 - z0) * (y2 - y0).
Definition normal_x (p0 p1 p2 : GridPoint) : Z :=
  cross (gy p0) (gz p0) (gy p1) (gz p1) (gy p2) (gz p2).
Definition normal_y (p0 p1 p2 : GridPoint) : Z :=
  cross (gz p0) (gx p0) (gz p1) (gx p1) (gz p2) (gx p2).
Definition normal_z (p0 p1 p2 : GridPoint) : Z :=
  cross (gx p0) (gy p0) (gx p1) (gy p1) (gx p2) (gy p2).
(** d = -n.p0 (S1.4). *)
Definition offset (p0 p1 p2 : GridPoint) : Z :=
  - (normal_x p0 p1 p2 * gx p0 + normal_y p0 p1 p2 * gy p0 +
     normal_z p0 p1 p2 * gz p0).

Definition det3 (a1 b1 c1 a2 b2 c2 a3 b3 c3 : Z) : Z :=
  a1 * (b2 * c3 - b3 * c2) + a2 * (b3 * c1 - b1 * c3) +
  a3 * (b1 * c2 - b2 * c1).

(** A plane with its four coefficients. *)
Record IntegerPlane := { ia : Z; ib : Z; ic : Z; id : Z }.
Definition plane_of (p0 p1 p2 : GridPoint) : IntegerPlane :=
  {| ia := normal_x p0 p1 p2; ib := normal_y p0 p1 p2;
     ic := normal_z p0 p1 p2; id := offset p0 p1 p2 |}.

(** The point of three planes by Cramer's rule is (X/W, Y/W, Z/W). *)
Definition meet_w (P Q R : IntegerPlane) : Z :=
  det3 (ia P) (ib P) (ic P) (ia Q) (ib Q) (ic Q) (ia R) (ib R) (ic R).
Definition meet_x (P Q R : IntegerPlane) : Z :=
  - det3 (id P) (ib P) (ic P) (id Q) (ib Q) (ic Q) (id R) (ib R) (ic R).
Definition meet_y (P Q R : IntegerPlane) : Z :=
  - det3 (ia P) (id P) (ic P) (ia Q) (id Q) (ic Q) (ia R) (id R) (ic R).
Definition meet_z (P Q R : IntegerPlane) : Z :=
  - det3 (ia P) (ib P) (id P) (ia Q) (ib Q) (id Q) (ia R) (ib R) (id R).

Definition fourth_plane (P Q R S : IntegerPlane) : Z :=
  ia S * meet_x P Q R + ib S * meet_y P Q R + ic S * meet_z P Q R +
  id S * meet_w P Q R.

(** Cramer's rule is right: the point is on all three planes. *)
Theorem meet_is_on_the_planes : forall P Q R,
  fourth_plane P Q R P = 0 /\ fourth_plane P Q R Q = 0 /\
  fourth_plane P Q R R = 0.
Proof.
  intros; unfold fourth_plane, meet_x, meet_y, meet_z, meet_w, det3.
  repeat split; ring.
Qed.

Theorem three_points_are_on_their_plane : forall p0 p1 p2 p,
  p = p0 \/ p = p1 \/ p = p2 ->
  normal_x p0 p1 p2 * gx p + normal_y p0 p1 p2 * gy p +
  normal_z p0 p1 p2 * gz p + offset p0 p1 p2 = 0.
Proof.
  intros p0 p1 p2 p [E | [E | E]]; subst p;
    unfold offset, normal_x, normal_y, normal_z, cross; ring.
Qed.

(** * Bounds *)

(** Twice the area of a triangle in a square of side [l] is at most l * l. *)
Lemma cross_bound : forall l m y0 z0 y1 z1 y2 z2,
  m <= y0 <= m + l -> m <= y1 <= m + l -> m <= y2 <= m + l ->
  m <= z0 <= m + l -> m <= z1 <= m + l -> m <= z2 <= m + l ->
  Z.abs (cross y0 z0 y1 z1 y2 z2) <= l * l.
Proof.
  intros l m y0 z0 y1 z1 y2 z2 Y0 Y1 Y2 Z0 Z1 Z2.
  assert (E : cross y0 z0 y1 z1 y2 z2 =
    (y0 - m) * (z1 - z2) + (y1 - m) * (z2 - z0) + (y2 - m) * (z0 - z1))
    by (unfold cross; ring).
  rewrite E.
  assert (T : forall u v, 0 <= u <= l ->
    - (l * Z.max 0 (- v)) <= u * v <= l * Z.max 0 v).
  { intros u v Hu. destruct (Z_le_gt_dec 0 v) as [H | H].
    - rewrite (Z.max_r 0 v), (Z.max_l 0 (- v)) by lia. split.
      + rewrite Z.mul_0_r. apply Z.mul_nonneg_nonneg; lia.
      + apply Z.mul_le_mono_nonneg_r; lia.
    - rewrite (Z.max_l 0 v), (Z.max_r 0 (- v)) by lia. split.
      + rewrite <- Z.mul_opp_r, Z.opp_involutive.
        apply Z.mul_le_mono_nonpos_r; lia.
      + rewrite Z.mul_0_r. apply Z.mul_nonneg_nonpos; lia. }
  assert (A := T (y0 - m) (z1 - z2) ltac:(lia)).
  assert (B := T (y1 - m) (z2 - z0) ltac:(lia)).
  assert (C := T (y2 - m) (z0 - z1) ltac:(lia)).
  assert (Up : l * (Z.max 0 (z1 - z2) + Z.max 0 (z2 - z0) +
                    Z.max 0 (z0 - z1)) <= l * l)
    by (apply Z.mul_le_mono_nonneg_l; lia).
  assert (Down : l * (Z.max 0 (- (z1 - z2)) + Z.max 0 (- (z2 - z0)) +
                      Z.max 0 (- (z0 - z1))) <= l * l)
    by (apply Z.mul_le_mono_nonneg_l; lia).
  rewrite !Z.mul_add_distr_l in Up, Down.
  apply Z.abs_le. split; lia.
Qed.

Lemma abs_product : forall u v a b, Z.abs u <= a -> Z.abs v <= b ->
  Z.abs (u * v) <= a * b.
Proof.
  intros; rewrite Z.abs_mul.
  apply Z.mul_le_mono_nonneg; auto using Z.abs_nonneg.
Qed.

Lemma abs_sum3 : forall u v w a b c,
  Z.abs u <= a -> Z.abs v <= b -> Z.abs w <= c ->
  Z.abs (u + v + w) <= a + b + c.
Proof. intros; lia. Qed.

Lemma abs_sum2 : forall u v a b,
  Z.abs u <= a -> Z.abs v <= b -> Z.abs (u + v) <= a + b.
Proof. intros; lia. Qed.

Lemma abs_difference : forall u v a b,
  Z.abs u <= a -> Z.abs v <= b -> Z.abs (u - v) <= a + b.
Proof. intros; lia. Qed.

Lemma Z_le_abs : forall v, v <= Z.abs v.
Proof. intro; lia. Qed.

(** The three components of a cross product, together. *)
Lemma cross_sum_bound : forall b1 b2 b3 c1 c2 c3 B C,
  Z.abs b1 <= B -> Z.abs b2 <= B -> Z.abs b3 <= B ->
  Z.abs c1 <= C -> Z.abs c2 <= C -> Z.abs c3 <= C ->
  Z.abs (b2 * c3 - b3 * c2) + Z.abs (b3 * c1 - b1 * c3) +
  Z.abs (b1 * c2 - b2 * c1) <= 4 * (B * C).
Proof.
  intros b1 b2 b3 c1 c2 c3 B C Hb1 Hb2 Hb3 Hc1 Hc2 Hc3.
  assert (S : forall v, exists e, (e = 1 \/ e = -1) /\ Z.abs v = e * v).
  { intro v. destruct (Z_le_gt_dec 0 v);
      [ exists 1 | exists (-1) ]; lia. }
  destruct (S (b2 * c3 - b3 * c2)) as [e1 [E1 ->]].
  destruct (S (b3 * c1 - b1 * c3)) as [e2 [E2 ->]].
  destruct (S (b1 * c2 - b2 * c1)) as [e3 [E3 ->]].
  assert (R : e1 * (b2 * c3 - b3 * c2) + e2 * (b3 * c1 - b1 * c3) +
    e3 * (b1 * c2 - b2 * c1) =
    b1 * (e3 * c2 - e2 * c3) + b2 * (e1 * c3 - e3 * c1) +
    b3 * (e2 * c1 - e1 * c2)) by ring.
  rewrite R.
  assert (G : forall b v, Z.abs b <= B -> b * v <= B * Z.abs v).
  { intros b v H. eapply Z.le_trans; [ apply Z_le_abs | ].
    apply abs_product; [ exact H | apply Z.le_refl ]. }
  assert (T : Z.abs (e3 * c2 - e2 * c3) + Z.abs (e1 * c3 - e3 * c1) +
              Z.abs (e2 * c1 - e1 * c2) <= 4 * C).
  { clear - E1 E2 E3 Hc1 Hc2 Hc3. destruct E1, E2, E3; subst; lia. }
  assert (G1 := G b1 (e3 * c2 - e2 * c3) Hb1).
  assert (G2 := G b2 (e1 * c3 - e3 * c1) Hb2).
  assert (G3 := G b3 (e2 * c1 - e1 * c2) Hb3).
  assert (HB : 0 <= B) by (clear - Hb1; lia).
  apply (Z.mul_le_mono_nonneg_l _ _ B HB) in T.
  rewrite !Z.mul_add_distr_l in T.
  replace (B * (4 * C)) with (4 * (B * C)) in T by ring.
  revert G1 G2 G3 T. clear. intros.
  eapply Z.le_trans; [ | exact T ].
  apply Z.add_le_mono; [ apply Z.add_le_mono | ]; assumption.
Qed.

(** The greatest determinant of three rows of signs is 4. *)
Theorem det3_bound : forall a1 b1 c1 a2 b2 c2 a3 b3 c3 A B C,
  Z.abs a1 <= A -> Z.abs a2 <= A -> Z.abs a3 <= A ->
  Z.abs b1 <= B -> Z.abs b2 <= B -> Z.abs b3 <= B ->
  Z.abs c1 <= C -> Z.abs c2 <= C -> Z.abs c3 <= C ->
  Z.abs (det3 a1 b1 c1 a2 b2 c2 a3 b3 c3) <= 4 * (A * B * C).
Proof.
  intros a1 b1 c1 a2 b2 c2 a3 b3 c3 A B C A1 A2 A3 B1 B2 B3 C1 C2 C3.
  assert (H := cross_sum_bound b1 b2 b3 c1 c2 c3 B C B1 B2 B3 C1 C2 C3).
  unfold det3.
  assert (P1 := abs_product a1 _ A _ A1
               (Z.le_refl (Z.abs (b2 * c3 - b3 * c2)))).
  assert (P2 := abs_product a2 _ A _ A2
               (Z.le_refl (Z.abs (b3 * c1 - b1 * c3)))).
  assert (P3 := abs_product a3 _ A _ A3
               (Z.le_refl (Z.abs (b1 * c2 - b2 * c1)))).
  assert (HA : 0 <= A) by (clear - A1; lia).
  apply (Z.mul_le_mono_nonneg_l _ _ A HA) in H.
  rewrite !Z.mul_add_distr_l in H.
  replace (A * (4 * (B * C))) with (4 * (A * B * C)) in H by ring.
  eapply Z.le_trans; [ | exact H ].
  eapply Z.le_trans; [ apply Z.abs_triangle | ].
  apply Z.add_le_mono; [ | assumption ].
  eapply Z.le_trans; [ apply Z.abs_triangle | ].
  apply Z.add_le_mono; assumption.
Qed.

(** The values with which all bounds are found: coordinates from [-M] to
    [L - M], and [M] the larger. *)
Definition within (M L : Z) (p : GridPoint) : Prop :=
  - M <= gx p <= L - M /\ - M <= gy p <= L - M /\ - M <= gz p <= L - M.

Section Bounds.
Variables M L : Z.
Hypothesis M_positive : 0 < M.
Hypothesis L_reaches : L <= 2 * M.

Lemma within_size : forall p, within M L p ->
  Z.abs (gx p) <= M /\ Z.abs (gy p) <= M /\ Z.abs (gz p) <= M.
Proof. unfold within; intros; lia. Qed.

Theorem difference_bound : forall p q, within M L p -> within M L q ->
  Z.abs (gx q - gx p) <= L /\ Z.abs (gy q - gy p) <= L /\
  Z.abs (gz q - gz p) <= L.
Proof. unfold within; intros; lia. Qed.

Theorem normal_bound : forall p0 p1 p2,
  within M L p0 -> within M L p1 -> within M L p2 ->
  Z.abs (normal_x p0 p1 p2) <= L * L /\ Z.abs (normal_y p0 p1 p2) <= L * L /\
  Z.abs (normal_z p0 p1 p2) <= L * L.
Proof.
  unfold within; intros p0 p1 p2 H0 H1 H2.
  repeat split; apply (cross_bound L (- M)); lia.
Qed.

Theorem offset_bound : forall p0 p1 p2,
  within M L p0 -> within M L p1 -> within M L p2 ->
  Z.abs (offset p0 p1 p2) <= 4 * (M * M * M).
Proof.
  intros p0 p1 p2 H0 H1 H2.
  apply within_size in H0, H1, H2.
  assert (E : offset p0 p1 p2 = - det3 (gx p0) (gy p0) (gz p0)
    (gx p1) (gy p1) (gz p1) (gx p2) (gy p2) (gz p2))
    by (unfold offset, normal_x, normal_y, normal_z, cross, det3; ring).
  rewrite E, Z.abs_opp. apply det3_bound; lia.
Qed.

(** What a plane of three points of the grid is within. *)
Definition plane_within (P : IntegerPlane) : Prop :=
  Z.abs (ia P) <= L * L /\ Z.abs (ib P) <= L * L /\ Z.abs (ic P) <= L * L /\
  Z.abs (id P) <= 4 * (M * M * M).

Theorem plane_of_is_within : forall p0 p1 p2,
  within M L p0 -> within M L p1 -> within M L p2 ->
  plane_within (plane_of p0 p1 p2).
Proof.
  intros p0 p1 p2 H0 H1 H2. unfold plane_within, plane_of; cbn.
  assert (N := normal_bound p0 p1 p2 H0 H1 H2).
  assert (D := offset_bound p0 p1 p2 H0 H1 H2). tauto.
Qed.

Theorem meet_bound : forall P Q R,
  plane_within P -> plane_within Q -> plane_within R ->
  Z.abs (meet_w P Q R) <= 4 * L ^ 6 /\
  Z.abs (meet_x P Q R) <= 16 * (M ^ 3 * L ^ 4) /\
  Z.abs (meet_y P Q R) <= 16 * (M ^ 3 * L ^ 4) /\
  Z.abs (meet_z P Q R) <= 16 * (M ^ 3 * L ^ 4).
Proof.
  intros P Q R [Pa [Pb [Pc Pd]]] [Qa [Qb [Qc Qd]]] [Ra [Rb [Rc Rd]]].
  unfold meet_w, meet_x, meet_y, meet_z.
  rewrite !Z.abs_opp.
  replace (4 * L ^ 6) with (4 * (L * L * (L * L) * (L * L))) by ring.
  replace (16 * (M ^ 3 * L ^ 4))
    with (4 * (4 * (M * M * M) * (L * L) * (L * L))) by ring.
  split; [ apply det3_bound; assumption | ].
  split; [ apply det3_bound; assumption | ].
  split.
  - replace (4 * (4 * (M * M * M) * (L * L) * (L * L)))
      with (4 * (L * L * (4 * (M * M * M)) * (L * L))) by ring.
    apply det3_bound; assumption.
  - replace (4 * (4 * (M * M * M) * (L * L) * (L * L)))
      with (4 * (L * L * (L * L) * (4 * (M * M * M)))) by ring.
    apply det3_bound; assumption.
Qed.

(** The determinant of four planes: four times a plane's coefficient times a
    determinant of three. *)
Theorem fourth_plane_bound : forall P Q R S,
  plane_within P -> plane_within Q -> plane_within R -> plane_within S ->
  Z.abs (fourth_plane P Q R S) <= 64 * (M ^ 3 * L ^ 6).
Proof.
  intros P Q R S HP HQ HR [Sa [Sb [Sc Sd]]].
  destruct (meet_bound P Q R HP HQ HR) as [W [X [Y Z]]].
  unfold fourth_plane.
  assert (A := abs_product _ _ _ _ Sa X).
  assert (B := abs_product _ _ _ _ Sb Y).
  assert (C := abs_product _ _ _ _ Sc Z).
  assert (D := abs_product _ _ _ _ Sd W).
  replace (64 * (M ^ 3 * L ^ 6)) with
    (L * L * (16 * (M ^ 3 * L ^ 4)) + L * L * (16 * (M ^ 3 * L ^ 4)) +
     L * L * (16 * (M ^ 3 * L ^ 4)) + 4 * (M * M * M) * (4 * L ^ 6)) by ring.
  apply abs_sum2; [ apply abs_sum3 | ]; assumption.
Qed.

(** ** The same signs from values at grid points, as fast/src/exact/exact_plane.hpp has
    them *)

(** n.(p - origin). *)
Definition value_from (P : IntegerPlane) (origin p : GridPoint) : Z :=
  ia P * (gx p - gx origin) + ib P * (gy p - gy origin) +
  ic P * (gz p - gz origin).

Theorem value_from_is_the_value : forall p0 p1 p2 p,
  value_from (plane_of p0 p1 p2) p0 p =
  ia (plane_of p0 p1 p2) * gx p + ib (plane_of p0 p1 p2) * gy p +
  ic (plane_of p0 p1 p2) * gz p + id (plane_of p0 p1 p2).
Proof. intros; unfold value_from, plane_of, offset; cbn; ring. Qed.

Theorem value_bound : forall P origin p,
  plane_within P -> within M L origin -> within M L p ->
  Z.abs (value_from P origin p) <= 3 * L ^ 3.
Proof.
  intros P origin p [Pa [Pb [Pc _]]] Ho Hp. unfold value_from.
  destruct (difference_bound origin p Ho Hp) as [X [Y Z]].
  assert (A := abs_product _ _ _ _ Pa X).
  assert (B := abs_product _ _ _ _ Pb Y).
  assert (C := abs_product _ _ _ _ Pc Z).
  replace (3 * L ^ 3) with (L * L * L + L * L * L + L * L * L) by ring.
  apply abs_sum3; assumption.
Qed.

(** f[i] g[j] - f[j] g[i], of values. *)
Definition minor (fi fj gi gj : Z) : Z := fi * gj - fj * gi.

Theorem minor_bound : forall fi fj gi gj,
  Z.abs fi <= 3 * L ^ 3 -> Z.abs fj <= 3 * L ^ 3 ->
  Z.abs gi <= 3 * L ^ 3 -> Z.abs gj <= 3 * L ^ 3 ->
  Z.abs (minor fi fj gi gj) <= 18 * L ^ 6.
Proof.
  intros fi fj gi gj F G H K. unfold minor.
  assert (A := abs_product _ _ _ _ F K). assert (B := abs_product _ _ _ _ G H).
  replace (18 * L ^ 6) with (3 * L ^ 3 * (3 * L ^ 3) + 3 * L ^ 3 * (3 * L ^ 3))
    by ring.
  apply abs_difference; assumption.
Qed.

Theorem sign_at_meet_bound : forall w0 w1 w2 r0 r1 r2,
  Z.abs w0 <= 18 * L ^ 6 -> Z.abs w1 <= 18 * L ^ 6 -> Z.abs w2 <= 18 * L ^ 6 ->
  Z.abs r0 <= 3 * L ^ 3 -> Z.abs r1 <= 3 * L ^ 3 -> Z.abs r2 <= 3 * L ^ 3 ->
  Z.abs (w0 * r0 + w1 * r1 + w2 * r2) <= 162 * L ^ 9 /\
  Z.abs (w0 + w1 + w2) <= 54 * L ^ 6.
Proof.
  intros w0 w1 w2 r0 r1 r2 W0 W1 W2 R0 R1 R2. split.
  2: { replace (54 * L ^ 6) with (18 * L ^ 6 + 18 * L ^ 6 + 18 * L ^ 6) by ring.
       apply abs_sum3; assumption. }
  assert (A := abs_product _ _ _ _ W0 R0).
  assert (B := abs_product _ _ _ _ W1 R1).
  assert (C := abs_product _ _ _ _ W2 R2).
  replace (162 * L ^ 9) with
    (18 * L ^ 6 * (3 * L ^ 3) + 18 * L ^ 6 * (3 * L ^ 3) +
     18 * L ^ 6 * (3 * L ^ 3)) by ring.
  apply abs_sum3; assumption.
Qed.

(** ** The camera's side *)

(** [C] bounds a camera's components, in lattice steps, 2^8 to a grid step;
    [2 ^ 18 * C] an image point's, in half steps. *)
Variable C : Z.

(** 2^8 h(e), and 2^9 h(s): [scale] is 2^8 or 2^9, or 0 for a direction. *)
Definition scaled_value (P : IntegerPlane) (scale x y z : Z) : Z :=
  ia P * x + ib P * y + ic P * z + scale * id P.

Theorem scaled_value_bound : forall P scale x y z K,
  plane_within P -> 0 <= scale ->
  Z.abs x <= K -> Z.abs y <= K -> Z.abs z <= K ->
  Z.abs (scaled_value P scale x y z) <=
  3 * (L * L * K) + scale * (4 * (M * M * M)).
Proof.
  intros P scale x y z K [Pa [Pb [Pc Pd]]] Hs X Y Z. unfold scaled_value.
  assert (A := abs_product _ _ _ _ Pa X).
  assert (B := abs_product _ _ _ _ Pb Y).
  assert (D := abs_product _ _ _ _ Pc Z).
  assert (Hs' : Z.abs scale <= scale) by (clear - Hs; lia).
  assert (E := abs_product scale (id P) scale _ Hs' Pd).
  replace (3 * (L * L * K)) with (L * L * K + L * L * K + L * L * K) by ring.
  apply abs_sum2; [ apply abs_sum3 | ]; assumption.
Qed.

(** P(e)Q(s) - Q(e)P(s), and the depths of two polygons. *)
Theorem edge_sign_bound : forall pe qs qe ps E S,
  Z.abs pe <= E -> Z.abs qe <= E -> Z.abs ps <= S -> Z.abs qs <= S ->
  Z.abs (pe * qs - qe * ps) <= 2 * (E * S).
Proof.
  intros pe qs qe ps E S H1 H2 H3 H4.
  assert (A := abs_product _ _ _ _ H1 H4).
  assert (B := abs_product _ _ _ _ H2 H3).
  replace (2 * (E * S)) with (E * S + E * S) by ring.
  apply abs_difference; assumption.
Qed.
End Bounds.

(** * The grids of 26, 40 and 54 bits *)

Lemma in_grid_within : forall n p, in_grid n p -> 1 <= n ->
  within (bound_M n) (bound_L n) p.
Proof.
  intros n p [X [Y Z]] Hn. unfold on_grid in *. unfold within, bound_M, bound_L.
  assert (2 ^ n = 2 * 2 ^ (n - 1))
    by (rewrite <- Z.pow_succ_r by lia; f_equal; lia). lia.
Qed.

Lemma bounds_of_a_grid : forall n, 1 <= n ->
  0 < bound_M n /\ bound_L n <= 2 * bound_M n.
Proof.
  intros n Hn. unfold bound_M, bound_L.
  assert (0 < 2 ^ (n - 1)) by (apply Z.pow_pos_nonneg; lia).
  assert (2 ^ n = 2 * 2 ^ (n - 1))
    by (rewrite <- Z.pow_succ_r by lia; f_equal; lia). lia.
Qed.

(** Bounds are compared with powers of two by computing both. *)
Ltac of_grid n H :=
  clear - H; destruct H as [H | [H | H]]; subst n; vm_compute;
  (reflexivity || discriminate).

Definition plane_of_grid (n : Z) (P : IntegerPlane) : Prop :=
  exists p0 p1 p2, in_grid n p0 /\ in_grid n p1 /\ in_grid n p2 /\
                   P = plane_of p0 p1 p2.

Lemma plane_of_grid_within : forall n P, 1 <= n -> plane_of_grid n P ->
  plane_within (bound_M n) (bound_L n) P.
Proof.
  intros n P Hn [p0 [p1 [p2 [H0 [H1 [H2 ->]]]]]].
  destruct (bounds_of_a_grid n Hn).
  apply plane_of_is_within; try assumption; now apply in_grid_within.
Qed.

Lemma grid_positive : forall n, is_grid n -> 1 <= n.
Proof. unfold is_grid; lia. Qed.

(** The rows of S1.6's table that planes make. *)
Theorem bits_of_a_plane : forall n P, is_grid n -> plane_of_grid n P ->
  has_bits (2 * n + 1) (ia P) /\ has_bits (2 * n + 1) (ib P) /\
  has_bits (2 * n + 1) (ic P) /\ has_bits (3 * n + 1) (id P).
Proof.
  intros n P Hn HP.
  destruct (plane_of_grid_within n P (grid_positive n Hn) HP)
    as [A [B [C D]]].
  assert (E : bound_L n * bound_L n < 2 ^ (2 * n + 1 - 1)) by (of_grid n Hn).
  assert (F : 4 * (bound_M n * bound_M n * bound_M n) < 2 ^ (3 * n + 1 - 1))
    by (of_grid n Hn).
  unfold has_bits. repeat split.
  - exact (Z.le_lt_trans _ _ _ A E).
  - exact (Z.le_lt_trans _ _ _ B E).
  - exact (Z.le_lt_trans _ _ _ C E).
  - exact (Z.le_lt_trans _ _ _ D F).
Qed.

Theorem bits_of_a_meet : forall n P Q R, is_grid n ->
  plane_of_grid n P -> plane_of_grid n Q -> plane_of_grid n R ->
  has_bits (6 * n + 3) (meet_w P Q R) /\ has_bits (7 * n + 2) (meet_x P Q R) /\
  has_bits (7 * n + 2) (meet_y P Q R) /\ has_bits (7 * n + 2) (meet_z P Q R).
Proof.
  intros n P Q R Hn HP HQ HR. assert (One := grid_positive n Hn).
  destruct (bounds_of_a_grid n One) as [HM HL].
  destruct (meet_bound _ _ _ _ _ (plane_of_grid_within n P One HP)
              (plane_of_grid_within n Q One HQ)
              (plane_of_grid_within n R One HR)) as [W [X [Y Z]]].
  assert (E : 4 * bound_L n ^ 6 < 2 ^ (6 * n + 3 - 1)) by (of_grid n Hn).
  assert (F : 16 * (bound_M n ^ 3 * bound_L n ^ 4) < 2 ^ (7 * n + 2 - 1))
    by (of_grid n Hn).
  unfold has_bits. repeat split.
  - exact (Z.le_lt_trans _ _ _ W E).
  - exact (Z.le_lt_trans _ _ _ X F).
  - exact (Z.le_lt_trans _ _ _ Y F).
  - exact (Z.le_lt_trans _ _ _ Z F).
Qed.

Theorem bits_of_a_fourth_plane : forall n P Q R S, is_grid n ->
  plane_of_grid n P -> plane_of_grid n Q -> plane_of_grid n R ->
  plane_of_grid n S -> has_bits (9 * n + 4) (fourth_plane P Q R S).
Proof.
  intros n P Q R S Hn HP HQ HR HS. assert (One := grid_positive n Hn).
  destruct (bounds_of_a_grid n One) as [HM HL].
  assert (B := fourth_plane_bound _ _ _ _ _ _
    (plane_of_grid_within n P One HP) (plane_of_grid_within n Q One HQ)
    (plane_of_grid_within n R One HR) (plane_of_grid_within n S One HS)).
  assert (E : 64 * (bound_M n ^ 3 * bound_L n ^ 6) < 2 ^ (9 * n + 4 - 1))
    by (of_grid n Hn).
  exact (Z.le_lt_trans _ _ _ B E).
Qed.

(** Every sign of a scene fits in 4, 6 and 8 words. *)
Theorem fourth_plane_fits_the_words : forall n P Q R S, is_grid n ->
  plane_of_grid n P -> plane_of_grid n Q -> plane_of_grid n R ->
  plane_of_grid n S -> has_bits (64 * kWords n) (fourth_plane P Q R S).
Proof.
  intros n P Q R S Hn HP HQ HR HS.
  assert (B := bits_of_a_fourth_plane n P Q R S Hn HP HQ HR HS).
  assert (E : 2 ^ (9 * n + 4 - 1) <= 2 ^ (64 * kWords n - 1))
    by (of_grid n Hn).
  exact (Z.lt_le_trans _ _ _ B E).
Qed.

(** The same from |x| <= 2^25, both ends in it. *)
Theorem fourth_plane_fits_256_bits : forall P Q R S,
  let small p := Z.abs (gx p) <= 2 ^ 25 /\ Z.abs (gy p) <= 2 ^ 25 /\
                 Z.abs (gz p) <= 2 ^ 25 in
  let of_small T := exists p0 p1 p2, small p0 /\ small p1 /\ small p2 /\
                                     T = plane_of p0 p1 p2 in
  of_small P -> of_small Q -> of_small R -> of_small S ->
  has_bits 256 (fourth_plane P Q R S).
Proof.
  intros P Q R S small of_small HP HQ HR HS.
  assert (G : forall T, of_small T -> plane_within (2 ^ 25) (2 * 2 ^ 25) T).
  { intros T [p0 [p1 [p2 [H0 [H1 [H2 ->]]]]]]. unfold small in *.
    change (2 ^ 25) with 33554432 in *.
    apply plane_of_is_within; unfold within; lia. }
  assert (B := fourth_plane_bound (2 ^ 25) (2 * 2 ^ 25) _ _ _ _
                 (G P HP) (G Q HQ) (G R HR) (G S HS)).
  assert (E : 64 * ((2 ^ 25) ^ 3 * (2 * 2 ^ 25) ^ 6) < 2 ^ (256 - 1))
    by reflexivity.
  exact (Z.le_lt_trans _ _ _ B E).
Qed.

(** fast/src/exact/exact_plane.hpp: values fit in [Value], two words or, at 54 bits,
    three; determinants and what is on the way fit in kWords words. *)
Definition value_bits (n : Z) : Z := if n =? 54 then 192 else 128.

Theorem values_fit : forall n P origin p, is_grid n ->
  plane_of_grid n P -> in_grid n origin -> in_grid n p ->
  has_bits (3 * n + 3) (value_from P origin p) /\
  has_bits (value_bits n) (value_from P origin p).
Proof.
  intros n P origin p Hn HP Ho Hp. assert (One := grid_positive n Hn).
  destruct (bounds_of_a_grid n One) as [HM HL].
  assert (B := value_bound _ _ P origin p (plane_of_grid_within n P One HP)
    (in_grid_within n origin Ho One) (in_grid_within n p Hp One)).
  assert (E : 3 * bound_L n ^ 3 < 2 ^ (3 * n + 3 - 1)) by (of_grid n Hn).
  assert (F : 3 * bound_L n ^ 3 < 2 ^ (value_bits n - 1)) by (of_grid n Hn).
  split; [ exact (Z.le_lt_trans _ _ _ B E) | exact (Z.le_lt_trans _ _ _ B F) ].
Qed.

Theorem determinants_of_values_fit : forall n, is_grid n ->
  forall w0 w1 w2 r0 r1 r2,
  let L := bound_L n in
  Z.abs w0 <= 18 * L ^ 6 -> Z.abs w1 <= 18 * L ^ 6 -> Z.abs w2 <= 18 * L ^ 6 ->
  Z.abs r0 <= 3 * L ^ 3 -> Z.abs r1 <= 3 * L ^ 3 -> Z.abs r2 <= 3 * L ^ 3 ->
  has_bits (64 * kWords n) (w0 * r0 + w1 * r1 + w2 * r2) /\
  has_bits (64 * kWords n) (w0 + w1 + w2).
Proof.
  intros n Hn w0 w1 w2 r0 r1 r2 L W0 W1 W2 R0 R1 R2.
  destruct (sign_at_meet_bound L w0 w1 w2 r0 r1 r2 W0 W1 W2 R0 R1 R2) as [A B].
  assert (E : 162 * L ^ 9 < 2 ^ (64 * kWords n - 1))
    by (unfold L; of_grid n Hn).
  assert (F : 54 * L ^ 6 < 2 ^ (64 * kWords n - 1))
    by (unfold L; of_grid n Hn).
  split; [ exact (Z.le_lt_trans _ _ _ A E) | exact (Z.le_lt_trans _ _ _ B F) ].
Qed.

(** S1.6, the camera's side.  [2 ^ (n + 13)] bounds the eye's components in
    lattice steps, [2 ^ (n + 31)] those of 2 s. *)
Theorem bits_of_the_eyes_value : forall n P x y z scale, is_grid n ->
  plane_of_grid n P -> 0 <= scale <= 2 ^ 8 ->
  Z.abs x <= 2 ^ (n + 13) -> Z.abs y <= 2 ^ (n + 13) ->
  Z.abs z <= 2 ^ (n + 13) ->
  has_bits (3 * n + 16) (scaled_value P scale x y z).
Proof.
  intros n P x y z scale Hn HP Hs X Y Z. assert (One := grid_positive n Hn).
  destruct (bounds_of_a_grid n One) as [HM HL].
  assert (B := scaled_value_bound _ _ P scale x y z _
    (plane_of_grid_within n P One HP) (proj1 Hs) X Y Z).
  assert (D : scale * (4 * (bound_M n * bound_M n * bound_M n)) <=
              2 ^ 8 * (4 * (bound_M n * bound_M n * bound_M n)))
    by (apply Z.mul_le_mono_nonneg_r; [ of_grid n Hn | apply Hs ]).
  assert (E : 3 * (bound_L n * bound_L n * 2 ^ (n + 13)) +
    2 ^ 8 * (4 * (bound_M n * bound_M n * bound_M n)) < 2 ^ (3 * n + 16 - 1))
    by (of_grid n Hn).
  refine (Z.le_lt_trans _ _ _ B (Z.le_lt_trans _ _ _ _ E)).
  apply Z.add_le_mono_l. exact D.
Qed.

Theorem bits_of_an_image_points_value : forall n P x y z, is_grid n ->
  plane_of_grid n P ->
  Z.abs x <= 2 ^ (n + 31) -> Z.abs y <= 2 ^ (n + 31) ->
  Z.abs z <= 2 ^ (n + 31) ->
  has_bits (3 * n + 34) (scaled_value P (2 ^ 9) x y z).
Proof.
  intros n P x y z Hn HP X Y Z. assert (One := grid_positive n Hn).
  destruct (bounds_of_a_grid n One) as [HM HL].
  assert (B := scaled_value_bound _ _ P (2 ^ 9) x y z _
    (plane_of_grid_within n P One HP) ltac:(discriminate) X Y Z).
  assert (E : 3 * (bound_L n * bound_L n * 2 ^ (n + 31)) +
    2 ^ 9 * (4 * (bound_M n * bound_M n * bound_M n)) < 2 ^ (3 * n + 34 - 1))
    by (of_grid n Hn).
  exact (Z.le_lt_trans _ _ _ B E).
Qed.

(** The edge sign of S4.5 and the depth of S5.3 fit as well. *)
Theorem bits_of_an_edge_sign : forall n pe qs qe ps, is_grid n ->
  has_bits (3 * n + 16) pe -> has_bits (3 * n + 16) qe ->
  has_bits (3 * n + 34) ps -> has_bits (3 * n + 34) qs ->
  has_bits (6 * n + 50) (pe * qs - qe * ps) /\
  has_bits (64 * kWords n) (pe * qs - qe * ps).
Proof.
  intros n pe qs qe ps Hn H1 H2 H3 H4. unfold has_bits in *.
  apply Z.lt_le_pred in H1, H2, H3, H4.
  assert (B := edge_sign_bound pe qs qe ps _ _ H1 H2 H3 H4).
  assert (E : 2 * (Z.pred (2 ^ (3 * n + 16 - 1)) *
                   Z.pred (2 ^ (3 * n + 34 - 1))) < 2 ^ (6 * n + 50 - 1))
    by (of_grid n Hn).
  assert (F : 2 ^ (6 * n + 50 - 1) <= 2 ^ (64 * kWords n - 1))
    by (of_grid n Hn).
  assert (G := Z.le_lt_trans _ _ _ B E).
  split; [ exact G | exact (Z.lt_le_trans _ _ _ G F) ].
Qed.

(** ** The other rows of the camera's side *)

Lemma fits : forall n b v, is_grid n -> b <= 64 * kWords n -> 1 <= b ->
  has_bits b v -> has_bits (64 * kWords n) v.
Proof.
  intros n b v Hn Hb Hb1 H. unfold has_bits in *.
  refine (Z.lt_le_trans _ _ _ H _). apply Z.pow_le_mono_r; lia.
Qed.

(** The values' bounds, as [scaled_value_bound] has them. *)
Definition value_at_most (n scale K : Z) : Z :=
  3 * (bound_L n * bound_L n * K) +
  scale * (4 * (bound_M n * bound_M n * bound_M n)).

Definition eye_within (n x y z : Z) : Prop :=
  Z.abs x <= 2 ^ (n + 13) /\ Z.abs y <= 2 ^ (n + 13) /\
  Z.abs z <= 2 ^ (n + 13).

Definition image_within (n x y z : Z) : Prop :=
  Z.abs x <= 2 ^ (n + 31) /\ Z.abs y <= 2 ^ (n + 31) /\
  Z.abs z <= 2 ^ (n + 31).

Lemma scaled_at_most : forall n P scale x y z K, is_grid n ->
  plane_of_grid n P -> 0 <= scale ->
  Z.abs x <= K -> Z.abs y <= K -> Z.abs z <= K ->
  Z.abs (scaled_value P scale x y z) <= value_at_most n scale K.
Proof.
  intros n P scale x y z K Hn HP Hs X Y Z. assert (One := grid_positive n Hn).
  destruct (bounds_of_a_grid n One) as [HM HL].
  exact (scaled_value_bound _ _ P scale x y z K
           (plane_of_grid_within n P One HP) Hs X Y Z).
Qed.

(** The derivatives of an edge sign: in the place of 2^9 Q(s) the change of
    Q(s) by one column or line of pixels. *)
Theorem bits_of_a_derivative : forall n P Q ex ey ez dx dy dz, is_grid n ->
  plane_of_grid n P -> plane_of_grid n Q ->
  eye_within n ex ey ez -> eye_within n dx dy dz ->
  has_bits (6 * n + 32)
    (scaled_value P (2 ^ 8) ex ey ez * scaled_value Q 0 dx dy dz -
     scaled_value Q (2 ^ 8) ex ey ez * scaled_value P 0 dx dy dz).
Proof.
  intros n P Q ex ey ez dx dy dz Hn HP HQ [E1 [E2 E3]] [D1 [D2 D3]].
  assert (Z8 : 0 <= 2 ^ 8) by discriminate.
  assert (B := edge_sign_bound _ _ _ _ _ _
    (scaled_at_most n P _ _ _ _ _ Hn HP Z8 E1 E2 E3)
    (scaled_at_most n Q _ _ _ _ _ Hn HQ Z8 E1 E2 E3)
    (scaled_at_most n P 0 _ _ _ _ Hn HP (Z.le_refl 0) D1 D2 D3)
    (scaled_at_most n Q 0 _ _ _ _ Hn HQ (Z.le_refl 0) D1 D2 D3)).
  assert (F : 2 * (value_at_most n (2 ^ 8) (2 ^ (n + 13)) *
                   value_at_most n 0 (2 ^ (n + 13))) < 2 ^ (6 * n + 32 - 1))
    by (of_grid n Hn).
  exact (Z.le_lt_trans _ _ _ B F).
Qed.

(** S4.5.3, in perspective, times 2^9: (2^16 - k) P(e) + k P(s). *)
Definition near_in_perspective (k pe ps : Z) : Z :=
  (2 ^ 16 - k) * (2 * pe) + k * ps.

(** And for an eye at infinity: 2^16 P(s) - k n.d. *)
Definition near_at_infinity (k nd ps : Z) : Z := 2 ^ 16 * ps - k * (2 * nd).

Theorem bits_of_a_near_distance : forall n P ex ey ez sx sy sz k, is_grid n ->
  plane_of_grid n P -> eye_within n ex ey ez -> image_within n sx sy sz ->
  Z.abs k <= 2 ^ 32 ->
  has_bits (3 * n + 66) (near_in_perspective k
    (scaled_value P (2 ^ 8) ex ey ez) (scaled_value P (2 ^ 9) sx sy sz)) /\
  has_bits (3 * n + 51) (near_at_infinity k
    (scaled_value P 0 ex ey ez) (scaled_value P (2 ^ 9) sx sy sz)).
Proof.
  intros n P ex ey ez sx sy sz k Hn HP [E1 [E2 E3]] [S1 [S2 S3]] K.
  assert (Z8 : 0 <= 2 ^ 8) by discriminate.
  assert (Z9 : 0 <= 2 ^ 9) by discriminate.
  assert (Pe := scaled_at_most n P _ _ _ _ _ Hn HP Z8 E1 E2 E3).
  assert (Nd := scaled_at_most n P 0 _ _ _ _ Hn HP (Z.le_refl 0) E1 E2 E3).
  assert (Ps := scaled_at_most n P _ _ _ _ _ Hn HP Z9 S1 S2 S3).
  set (pe := scaled_value P (2 ^ 8) ex ey ez) in *.
  set (nd := scaled_value P 0 ex ey ez) in *.
  set (ps := scaled_value P (2 ^ 9) sx sy sz) in *.
  assert (Two : Z.abs 2 <= 2) by discriminate.
  assert (K' : Z.abs (2 ^ 16 - k) <= 2 ^ 16 + 2 ^ 32)
    by (apply abs_difference; [ discriminate | exact K ]).
  unfold near_in_perspective, near_at_infinity, has_bits. split.
  - assert (B := abs_sum2 _ _ _ _
      (abs_product _ _ _ _ K' (abs_product _ _ _ _ Two Pe))
      (abs_product _ _ _ _ K Ps)).
    assert (F : (2 ^ 16 + 2 ^ 32) *
      (2 * value_at_most n (2 ^ 8) (2 ^ (n + 13))) +
      2 ^ 32 * value_at_most n (2 ^ 9) (2 ^ (n + 31)) < 2 ^ (3 * n + 66 - 1))
      by (of_grid n Hn).
    exact (Z.le_lt_trans _ _ _ B F).
  - assert (Sixteen : Z.abs (2 ^ 16) <= 2 ^ 16) by discriminate.
    assert (B := abs_difference _ _ _ _ (abs_product _ _ _ _ Sixteen Ps)
      (abs_product _ _ _ _ K (abs_product _ _ _ _ Two Nd))).
    assert (F : 2 ^ 16 * value_at_most n (2 ^ 9) (2 ^ (n + 31)) +
      2 ^ 32 * (2 * value_at_most n 0 (2 ^ (n + 13))) < 2 ^ (3 * n + 51 - 1))
      by (of_grid n Hn).
    exact (Z.le_lt_trans _ _ _ B F).
Qed.

(** The determinant of the eye, an image point and two grid points, the first
    two scaled by [ew] and [sw]: on which side of the edge the image point is.
    By pairs of columns. *)
Definition det_of_edge (ex ey ez ew sx sy sz sw : Z) (p q : GridPoint) : Z :=
  (ex * sy - ey * sx) * (gz p - gz q) - (ex * sz - ez * sx) * (gy p - gy q) +
  (ey * sz - ez * sy) * (gx p - gx q) +
  ((ex * sw - ew * sx) * (gy p * gz q - gz p * gy q) -
   (ey * sw - ew * sy) * (gx p * gz q - gz p * gx q) +
   (ez * sw - ew * sz) * (gx p * gy q - gy p * gx q)).

Theorem bits_of_a_source_edge : forall n ex ey ez ew sx sy sz sw p q,
  is_grid n -> eye_within n ex ey ez -> image_within n sx sy sz ->
  Z.abs ew <= 2 ^ 8 -> Z.abs sw <= 2 ^ 9 -> in_grid n p -> in_grid n q ->
  has_bits (3 * n + 48) (det_of_edge ex ey ez ew sx sy sz sw p q).
Proof.
  intros n ex ey ez ew sx sy sz sw p q Hn [E1 [E2 E3]] [S1 [S2 S3]] Ew Sw HP HQ.
  assert (One := grid_positive n Hn).
  destruct (bounds_of_a_grid n One) as [HM HL].
  assert (WP := in_grid_within n p HP One).
  assert (WQ := in_grid_within n q HQ One).
  destruct (difference_bound _ _ q p WQ WP) as [Dx [Dy Dz]].
  destruct (within_size _ _ HL p WP) as [Px [Py Pz]].
  destruct (within_size _ _ HL q WQ) as [Qx [Qy Qz]].
  assert (Minor : forall a b c d A B, Z.abs a <= A -> Z.abs c <= A ->
    Z.abs b <= B -> Z.abs d <= B -> Z.abs (a * b - c * d) <= A * B + A * B).
  { intros a b c d A B Ha Hc Hb Hd. apply abs_difference;
      apply abs_product; assumption. }
  assert (Mixed : forall e s, Z.abs e <= 2 ^ (n + 13) ->
    Z.abs s <= 2 ^ (n + 31) ->
    Z.abs (e * sw - ew * s) <= 2 ^ (n + 13) * 2 ^ 9 + 2 ^ 8 * 2 ^ (n + 31)).
  { intros e s He Hs. apply abs_difference; apply abs_product; assumption. }
  assert (Six : forall u v w x y z a b, Z.abs u <= a -> Z.abs v <= a ->
    Z.abs w <= a -> Z.abs x <= b -> Z.abs y <= b -> Z.abs z <= b ->
    Z.abs (u - v + w + (x - y + z)) <= 3 * a + 3 * b).
  { clear. intros. lia. }
  unfold det_of_edge, has_bits.
  refine (Z.le_lt_trans _ _ _ (Six _ _ _ _ _ _ _ _
    (abs_product _ _ _ _ (Minor _ _ _ _ _ _ E1 E2 S2 S1) Dz)
    (abs_product _ _ _ _ (Minor _ _ _ _ _ _ E1 E3 S3 S1) Dy)
    (abs_product _ _ _ _ (Minor _ _ _ _ _ _ E2 E3 S3 S2) Dx)
    (abs_product _ _ _ _ (Mixed _ _ E1 S1) (Minor _ _ _ _ _ _ Py Pz Qz Qy))
    (abs_product _ _ _ _ (Mixed _ _ E2 S2) (Minor _ _ _ _ _ _ Px Pz Qz Qx))
    (abs_product _ _ _ _ (Mixed _ _ E3 S3) (Minor _ _ _ _ _ _ Px Py Qy Qx)))
    _).
  of_grid n Hn.
Qed.

(** S5.4: whether a channel, with three such determinants as weights, reaches
    [v - 1/2], where rounding goes up to [v]. *)
Definition against_a_step (d0 d1 d2 c0 c1 c2 v : Z) : Z :=
  d0 * (2 * c0 - (2 * v - 1)) + d1 * (2 * c1 - (2 * v - 1)) +
  d2 * (2 * c2 - (2 * v - 1)).

Theorem bits_of_a_color : forall n d0 d1 d2 c0 c1 c2 v, is_grid n ->
  has_bits (3 * n + 48) d0 -> has_bits (3 * n + 48) d1 ->
  has_bits (3 * n + 48) d2 ->
  0 <= c0 <= 255 -> 0 <= c1 <= 255 -> 0 <= c2 <= 255 -> 0 <= v <= 255 ->
  has_bits (3 * n + 59) (against_a_step d0 d1 d2 c0 c1 c2 v).
Proof.
  intros n d0 d1 d2 c0 c1 c2 v Hn H0 H1 H2 C0 C1 C2 V. unfold has_bits in *.
  apply Z.lt_le_pred in H0, H1, H2.
  assert (Step : forall c, 0 <= c <= 255 ->
    Z.abs (2 * c - (2 * v - 1)) <= 511)
    by (intros c C; clear - C V; lia).
  refine (Z.le_lt_trans _ _ _ (abs_sum3 _ _ _ _ _ _
    (abs_product _ _ _ _ H0 (Step _ C0)) (abs_product _ _ _ _ H1 (Step _ C1))
    (abs_product _ _ _ _ H2 (Step _ C2))) _).
  of_grid n Hn.
Qed.

(** All rows fit in the words of their grid, at 26 bits in 256 bits. *)
Theorem all_rows_fit : forall n v, is_grid n ->
  has_bits (6 * n + 50) v \/ has_bits (6 * n + 32) v \/
  has_bits (3 * n + 66) v \/ has_bits (3 * n + 59) v \/
  has_bits (3 * n + 51) v \/ has_bits (3 * n + 48) v ->
  has_bits (64 * kWords n) v.
Proof.
  intros n v Hn H.
  assert (K : 6 * n + 50 <= 64 * kWords n /\ 3 * n + 66 <= 64 * kWords n /\
              1 <= n)
    by (clear - Hn; destruct Hn as [-> | [-> | ->]]; vm_compute;
        repeat split; discriminate).
  destruct H as [H | [H | [H | [H | [H | H]]]]];
    revert H; apply fits; try assumption; clear - K; lia.
Qed.
