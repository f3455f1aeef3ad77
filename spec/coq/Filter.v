(** S1.5: the filter of fast/src/exact/filter.hpp never tells a wrong side.

    Doubles are modelled by what rounds: [rnd] is any function that moves a
    value by at most 2^-53 of its size.  Both it and the property are premises
    of the theorems, not axioms. *)

From Coq Require Import QArith Qabs Lqa.
From Halfspace Require Import Base.

(** * The constants of filter.hpp, which tools/check_traceability.py compares *)

(** kRounding: half a unit in the last place of 1. *)
Definition kRounding : Q := Eval cbv in 1 # 2 ^ 53.
(** rounding_of_values() is so many times [kRounding * M]. *)
Definition values_factor : Q := 16.
(** value_at() adds this share of the vertex's error. *)
Definition error_growth : Q := Eval cbv in 1 # 2 ^ 48.

Section Rounding.
Variable rnd : Q -> Q.
Hypothesis rounds : forall v, Qabs (rnd v - v) <= kRounding * Qabs v.

(** * The same operations in the same order as filter.hpp *)

Definition filter_size (plane : Plane) : Q :=
  rnd (rnd (Qabs (pa plane) + Qabs (pb plane)) + Qabs (pc plane)).

Definition rounding_of_values (M : Q) : Q := values_factor * kRounding * M.

Definition filter_value (plane : Plane) (v : Point) : Q :=
  rnd (rnd (rnd (rnd (pa plane * px v) + rnd (pb plane * py v)) +
            rnd (pc plane * pz v)) + pd plane).

Definition filter_error (plane : Plane) (error rounding : Q) : Q :=
  rnd (filter_size plane *
       rnd (rnd (error * (1 + error_growth)) + rounding)).

(** The sign, or [None] where it cannot be told: not the same as zero. *)
Definition known_sign (value error : Q) : option Side :=
  if Qlt_le_dec error value then Some kPositive
  else if Qlt_le_dec value (- error) then Some kNegative else None.

(** * What rounding does *)

Lemma rnd_within : forall v w e t, Qabs (v - w) <= e -> Qabs w <= t ->
  Qabs (rnd v - w) <= e + kRounding * (t + e).
Proof.
  intros v w e t He Ht. assert (R := rounds v).
  apply Qabs_Qle_condition in He. apply Qabs_Qle_condition in Ht.
  assert (V : Qabs v <= t + e) by (apply Qabs_Qle_condition; lra).
  assert (U : kRounding * Qabs v <= kRounding * (t + e))
    by (unfold kRounding in *; lra).
  apply Qabs_Qle_condition in R. apply Qabs_Qle_condition. lra.
Qed.

Lemma rnd_below : forall v w, 0 <= w -> w <= v -> (1 - kRounding) * w <= rnd v.
Proof.
  intros v w Hw Hv. assert (R := rounds v).
  rewrite (Qabs_pos v) in R by lra. apply Qabs_Qle_condition in R.
  unfold kRounding in *. lra.
Qed.

Lemma abs_product : forall p q s t, Qabs p <= s -> Qabs q <= t ->
  Qabs (p * q) <= s * t.
Proof.
  intros p q s t Hp Hq. rewrite Qabs_Qmult.
  apply Qmult_le_compat_nonneg; split; auto using Qabs_nonneg.
Qed.

Lemma product_within : forall p q t, Qabs q <= t ->
  Qabs (rnd (p * q) - p * q) <= kRounding * (Qabs p * t).
Proof.
  intros p q t Hq. eapply Qle_trans; [ apply rounds | ].
  assert (P := abs_product p q (Qabs p) t (Qle_refl _) Hq).
  unfold kRounding in *. lra.
Qed.

Lemma abs_sum : forall p q s t, Qabs p <= s -> Qabs q <= t ->
  Qabs (p + q) <= s + t.
Proof.
  intros p q s t Hp Hq. eapply Qle_trans; [ apply Qabs_triangle | ]. lra.
Qed.

(** Four products and sums lose at most 4.01 units of their sizes. *)
Theorem filter_value_is_near : forall plane v most,
  Qabs (px v) <= most -> Qabs (py v) <= most -> Qabs (pz v) <= most ->
  Qabs (filter_value plane v - value_at plane v) <=
  (401 # 100) * kRounding *
  (Qabs (pa plane) * most + Qabs (pb plane) * most + Qabs (pc plane) * most +
   Qabs (pd plane)).
Proof.
  intros [a b c d] [x y z] most X Y Z.
  unfold filter_value, value_at. cbn [pa pb pc pd px py pz] in *.
  assert (A := product_within a x most X).
  assert (B := product_within b y most Y).
  assert (C := product_within c z most Z).
  assert (A' := abs_product a x _ most (Qle_refl _) X).
  assert (B' := abs_product b y _ most (Qle_refl _) Y).
  assert (C' := abs_product c z _ most (Qle_refl _) Z).
  set (s1 := rnd (a * x)) in *. set (s2 := rnd (b * y)) in *.
  set (s3 := rnd (c * z)) in *.
  set (p1 := a * x) in *. set (p2 := b * y) in *. set (p3 := c * z) in *.
  set (n1 := Qabs a * most) in *. set (n2 := Qabs b * most) in *.
  set (n3 := Qabs c * most) in *.
  assert (N1 : 0 <= n1) by (eapply Qle_trans; [ apply Qabs_nonneg | exact A' ]).
  assert (N2 : 0 <= n2) by (eapply Qle_trans; [ apply Qabs_nonneg | exact B' ]).
  assert (N3 : 0 <= n3) by (eapply Qle_trans; [ apply Qabs_nonneg | exact C' ]).
  assert (N4 := Qabs_nonneg d).
  assert (S2 : Qabs (s1 + s2 - (p1 + p2)) <= kRounding * n1 + kRounding * n2).
  { setoid_replace (s1 + s2 - (p1 + p2)) with ((s1 - p1) + (s2 - p2)) by ring.
    now apply abs_sum. }
  assert (R2 := rnd_within _ _ _ _ S2 (abs_sum _ _ _ _ A' B')).
  set (t2 := rnd (s1 + s2)) in *.
  match type of R2 with _ <= ?e => set (e2 := e) in R2 end.
  assert (S3 : Qabs (t2 + s3 - (p1 + p2 + p3)) <= e2 + kRounding * n3).
  { setoid_replace (t2 + s3 - (p1 + p2 + p3))
      with ((t2 - (p1 + p2)) + (s3 - p3)) by ring.
    now apply abs_sum. }
  assert (R3 := rnd_within _ _ _ _ S3
                  (abs_sum _ _ _ _ (abs_sum _ _ _ _ A' B') C')).
  set (t3 := rnd (t2 + s3)) in *.
  match type of R3 with _ <= ?e => set (e3 := e) in R3 end.
  assert (S4 : Qabs (t3 + d - (p1 + p2 + p3 + d)) <= e3).
  { setoid_replace (t3 + d - (p1 + p2 + p3 + d)) with (t3 - (p1 + p2 + p3))
      by ring. exact R3. }
  assert (R4 := rnd_within _ _ _ _ S4 (abs_sum _ _ _ _
    (abs_sum _ _ _ _ (abs_sum _ _ _ _ A' B') C') (Qle_refl (Qabs d)))).
  eapply Qle_trans; [ exact R4 | ].
  unfold e3, e2, kRounding. clear - N1 N2 N3 N4. lra.
Qed.

(** * The plane and the point are off, too *)

(** [plane] approximates the plane [truth], and [v] the point [p]. *)
Definition approximates (plane truth : Plane) : Prop :=
  Qabs (pa plane - pa truth) <= 2 * kRounding * Qabs (pa truth) /\
  Qabs (pb plane - pb truth) <= 2 * kRounding * Qabs (pb truth) /\
  Qabs (pc plane - pc truth) <= 2 * kRounding * Qabs (pc truth) /\
  Qabs (pd plane - pd truth) <= 2 * kRounding * Qabs (pd truth).

Definition stands_for (v p : Point) (error : Q) : Prop :=
  Qabs (px v - px p) <= error /\ Qabs (py v - py p) <= error /\
  Qabs (pz v - pz p) <= error.

Definition sizes (plane : Plane) : Q :=
  Qabs (pa plane) + Qabs (pb plane) + Qabs (pc plane).

(** A point within the grid, [M] being its half. *)
Definition point_within (M : Q) (p : Point) : Prop :=
  Qabs (px p) <= M /\ Qabs (py p) <= M /\ Qabs (pz p) <= M.

(** As every plane through a point of the grid does. *)
Definition offset_within (M : Q) (plane : Plane) : Prop :=
  Qabs (pd plane) <= sizes plane * M.

Theorem plane_through_a_grid_point_has_such_an_offset : forall M plane p,
  point_within M p -> value_at plane p == 0 -> offset_within M plane.
Proof.
  intros M [a b c d] [x y z] [X [Y Z]] H.
  unfold offset_within, sizes, value_at in *. cbn [pa pb pc pd px py pz] in *.
  assert (A := abs_product a x _ M (Qle_refl _) X).
  assert (B := abs_product b y _ M (Qle_refl _) Y).
  assert (C := abs_product c z _ M (Qle_refl _) Z).
  assert (E : d == - (a * x + b * y + c * z)) by lra.
  rewrite E, Qabs_opp.
  assert (S := abs_sum _ _ _ _ (abs_sum _ _ _ _ A B) C). lra.
Qed.

Lemma term_moves : forall a ta x tx e M, 0 <= M ->
  Qabs (a - ta) <= 2 * kRounding * Qabs ta -> Qabs (x - tx) <= e ->
  Qabs tx <= M ->
  Qabs (a * x - ta * tx) <= Qabs a * e + 2 * kRounding * (Qabs ta * M).
Proof.
  intros a ta x tx e M HM Ha Hx Ht.
  setoid_replace (a * x - ta * tx) with (a * (x - tx) + (a - ta) * tx) by ring.
  assert (P := abs_product a (x - tx) _ e (Qle_refl _) Hx).
  assert (R := abs_product (a - ta) tx _ M Ha Ht).
  eapply Qle_trans; [ apply (abs_sum _ _ _ _ P R) | ]. lra.
Qed.

Lemma size_of_truth : forall a ta M, 0 <= M ->
  Qabs (a - ta) <= 2 * kRounding * Qabs ta ->
  (1 - 2 * kRounding) * (Qabs ta * M) <= Qabs a * M /\
  Qabs a <= (1 + 2 * kRounding) * Qabs ta.
Proof.
  intros a ta M HM H.
  assert (L : Qabs ta <= Qabs a + Qabs (a - ta)).
  { setoid_replace ta with (a - (a - ta)) at 1 by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ]. rewrite Qabs_opp. lra. }
  assert (U : Qabs a <= Qabs ta + Qabs (a - ta)).
  { setoid_replace a with (ta + (a - ta)) at 1 by ring. apply Qabs_triangle. }
  split; [ | unfold kRounding in *; lra ].
  assert (K : (1 - 2 * kRounding) * Qabs ta <= Qabs a)
    by (unfold kRounding in *; lra).
  apply (Qmult_le_compat_r _ _ M) in K; [ | exact HM ]. lra.
Qed.

(** All that is off, in terms of the plane at hand. *)
Theorem filter_value_is_near_the_truth : forall plane truth v p error M,
  0 <= M -> 0 <= error -> approximates plane truth -> stands_for v p error ->
  point_within M p -> offset_within M truth ->
  Qabs (filter_value plane v - value_at truth p) <=
  sizes plane * error * (1 + 5 * kRounding) +
  sizes plane * M * (13 * kRounding).
Proof.
  intros [a b c d] [ta tb tc td] [x y z] [tx ty tz] error M HM He
    [Pa [Pb [Pc Pd]]] [Vx [Vy Vz]] [Tx [Ty Tz]] Off.
  unfold offset_within, sizes in *. cbn [pa pb pc pd px py pz] in *.
  assert (Reach : forall s t, Qabs (s - t) <= error -> Qabs t <= M ->
                  Qabs s <= M + error).
  { intros s t E T. setoid_replace s with (t + (s - t)) by ring.
    now apply abs_sum. }
  assert (Near := filter_value_is_near
    {| pa := a; pb := b; pc := c; pd := d |} {| px := x; py := y; pz := z |}
    (M + error) (Reach _ _ Vx Tx) (Reach _ _ Vy Ty) (Reach _ _ Vz Tz)).
  cbn [pa pb pc pd px py pz] in Near.
  assert (A := term_moves a ta x tx error M HM Pa Vx Tx).
  assert (B := term_moves b tb y ty error M HM Pb Vy Ty).
  assert (C := term_moves c tc z tz error M HM Pc Vz Tz).
  destruct (size_of_truth a ta M HM Pa) as [Sa _].
  destruct (size_of_truth b tb M HM Pb) as [Sb _].
  destruct (size_of_truth c tc M HM Pc) as [Sc _].
  destruct (size_of_truth d td M HM Pd) as [_ Sd].
  set (fv := filter_value _ _) in *. unfold value_at in *.
  cbn [pa pb pc pd px py pz] in *.
  assert (Moved : Qabs (a * x + b * y + c * z + d -
                        (ta * tx + tb * ty + tc * tz + td)) <=
    (Qabs a * error + 2 * kRounding * (Qabs ta * M)) +
    (Qabs b * error + 2 * kRounding * (Qabs tb * M)) +
    (Qabs c * error + 2 * kRounding * (Qabs tc * M)) +
    2 * kRounding * Qabs td).
  { setoid_replace (a * x + b * y + c * z + d -
                    (ta * tx + tb * ty + tc * tz + td))
      with ((a * x - ta * tx) + (b * y - tb * ty) + (c * z - tc * tz) +
            (d - td)) by ring.
    apply abs_sum; [ apply abs_sum; [ apply abs_sum | ] | ]; assumption. }
  setoid_replace (fv - (ta * tx + tb * ty + tc * tz + td))
    with ((fv - (a * x + b * y + c * z + d)) +
          (a * x + b * y + c * z + d - (ta * tx + tb * ty + tc * tz + td)))
    by ring.
  eapply Qle_trans; [ apply (abs_sum _ _ _ _ Near Moved) | ].
  assert (Za : 0 <= Qabs a * error)
    by (apply Qmult_le_0_compat; auto using Qabs_nonneg).
  assert (Zb : 0 <= Qabs b * error)
    by (apply Qmult_le_0_compat; auto using Qabs_nonneg).
  assert (Zc : 0 <= Qabs c * error)
    by (apply Qmult_le_0_compat; auto using Qabs_nonneg).
  assert (Ya : 0 <= Qabs ta * M)
    by (apply Qmult_le_0_compat; auto using Qabs_nonneg).
  assert (Yb : 0 <= Qabs tb * M)
    by (apply Qmult_le_0_compat; auto using Qabs_nonneg).
  assert (Yc : 0 <= Qabs tc * M)
    by (apply Qmult_le_0_compat; auto using Qabs_nonneg).
  clear - Za Zb Zc Ya Yb Yc Sa Sb Sc Sd Off.
  rewrite !Qmult_plus_distr_r in *. rewrite !Qmult_plus_distr_l in *.
  set (ea := Qabs a * error) in *. set (eb := Qabs b * error) in *.
  set (ec := Qabs c * error) in *. set (ma := Qabs a * M) in *.
  set (mb := Qabs b * M) in *. set (mc := Qabs c * M) in *.
  set (na := Qabs ta * M) in *. set (nb := Qabs tb * M) in *.
  set (nc := Qabs tc * M) in *. unfold kRounding in *. lra.
Qed.

(** The bound that filter.hpp computes, its own roundings included, is no
    smaller. *)
Theorem filter_error_is_enough : forall plane error M,
  0 <= M -> 0 <= error ->
  sizes plane * error * (1 + 5 * kRounding) +
  sizes plane * M * (13 * kRounding) <=
  filter_error plane error (rounding_of_values M).
Proof.
  intros [a b c d] error M HM He.
  unfold filter_error, filter_size, sizes, rounding_of_values.
  cbn [pa pb pc pd].
  assert (Na := Qabs_nonneg a). assert (Nb := Qabs_nonneg b).
  assert (Nc := Qabs_nonneg c).
  set (k := 1 - kRounding). assert (K0 : 0 <= k) by (unfold k, kRounding; lra).
  assert (Nab : 0 <= Qabs a + Qabs b) by lra.
  assert (S1 := rnd_below (Qabs a + Qabs b) _ Nab (Qle_refl _)).
  fold k in S1. set (r1 := rnd (Qabs a + Qabs b)) in *.
  assert (S2 : k * (k * (Qabs a + Qabs b + Qabs c)) <= rnd (r1 + Qabs c)).
  { apply rnd_below; [ unfold k, kRounding; lra | ].
    unfold k, kRounding in *; lra. }
  set (size := rnd (r1 + Qabs c)) in *.
  set (n := Qabs a + Qabs b + Qabs c) in *.
  assert (Hn : 0 <= n) by (unfold n; lra).
  assert (S3 : k * (error * (1 + error_growth)) <=
               rnd (error * (1 + error_growth))).
  { apply rnd_below; [ unfold error_growth; lra | apply Qle_refl ]. }
  set (r3 := rnd (error * (1 + error_growth))) in *.
  set (low := k * (k * (error * (1 + error_growth)) +
                   values_factor * kRounding * M)).
  assert (S4 : low <= rnd (r3 + values_factor * kRounding * M)).
  { apply rnd_below;
      unfold k, error_growth, values_factor, kRounding in *; lra. }
  set (r4 := rnd (r3 + values_factor * kRounding * M)) in *.
  assert (Hlow : 0 <= low)
    by (unfold low, k, error_growth, values_factor, kRounding; lra).
  assert (Hkn : 0 <= k * (k * n)) by (unfold k, kRounding; lra).
  assert (P : k * (k * n) * low <= size * r4)
    by (apply Qmult_le_compat_nonneg; split; assumption).
  assert (Hp : 0 <= k * (k * n) * low) by (now apply Qmult_le_0_compat).
  eapply Qle_trans; [ | apply (rnd_below _ _ Hp P) ].
  fold k. unfold low.
  assert (Ne : 0 <= n * error) by (now apply Qmult_le_0_compat).
  assert (Nm : 0 <= n * M) by (now apply Qmult_le_0_compat).
  setoid_replace (k * (k * (k * n) * (k * (k * (error * (1 + error_growth)) +
                  values_factor * kRounding * M))))
    with (k * k * k * k * k * (1 + error_growth) * (n * error) +
          k * k * k * k * values_factor * kRounding * (n * M)) by ring.
  set (ne := n * error) in *. set (nm := n * M) in *.
  unfold k, error_growth, values_factor, kRounding. clear - Ne Nm. lra.
Qed.

(** A sign that the filter knows is the sign. *)
Theorem known_sign_is_the_side : forall plane truth v p error M side,
  0 <= M -> 0 <= error -> approximates plane truth -> stands_for v p error ->
  point_within M p -> offset_within M truth ->
  known_sign (filter_value plane v)
    (filter_error plane error (rounding_of_values M)) = Some side ->
  side_of truth p = side.
Proof.
  intros plane truth v p error M side HM He HP HV HT HO H.
  assert (B := filter_value_is_near_the_truth plane truth v p error M
                 HM He HP HV HT HO).
  assert (E := filter_error_is_enough plane error M HM He).
  assert (G := Qle_trans _ _ _ B E). apply Qabs_Qle_condition in G.
  unfold known_sign in H. unfold side_of.
  destruct (Qlt_le_dec _ _) as [L | _] in H.
  - injection H as <-. apply sign_positive. lra.
  - destruct (Qlt_le_dec _ _) as [L | _] in H; [ | discriminate ].
    injection H as <-. apply sign_negative. lra.
Qed.
End Rounding.
