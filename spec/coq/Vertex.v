(** * S1.5, S2.3: the new vertices of the filter stand for the true ones.

    Read beside [meet] of fast/src/exact/filter.hpp, that of an edge. As in
    [Filter.v] doubles are modelled by what rounds. *)

From Coq Require Import QArith Qabs Qminmax Qfield Lqa.
From Halfspace Require Import Base Filter.
From Halfspace Require Split.

Section Rounding.
Variable rnd : Q -> Q.
Hypothesis rounds : forall v, Qabs (rnd v - v) <= kRounding * Qabs v.

(** ** The same operations in the same order as filter.hpp *)

(** The bound is twice what the errors alone ask: it pays for its roundings. *)
Definition doubt_factor : Q := 2.

(** A vertex: a point, and a bound on how far it is off. *)
Record Vertex := { point : Point; error : Q }.

(** A value, and a bound on how far it is off. *)
Record Bounded := { bounded_value : Q; bounded_error : Q }.

Definition clamp (t : Q) : Q := Qmax 0 (Qmin 1 t).

Definition share_of (hp hq : Bounded) : Q :=
  let fall := rnd (bounded_value hp - bounded_value hq) in
  if Qeq_dec fall 0 then 1 # 2 else clamp (rnd (bounded_value hp / fall)).

Definition doubt_of (hp hq : Bounded) : Q :=
  let fall := rnd (bounded_value hp - bounded_value hq) in
  if Qeq_dec fall 0 then 1
  else
    Qmin 1 (rnd (rnd (doubt_factor *
                      Qmax (bounded_error hp) (bounded_error hq)) / Qabs fall)).

Definition along (t p q : Q) : Q := rnd (p + rnd (t * rnd (q - p))).

Definition length_of (p q : Point) : Q :=
  Qmax (Qabs (rnd (px q - px p)))
    (Qmax (Qabs (rnd (py q - py p))) (Qabs (rnd (pz q - pz p)))).

Definition error_of (error doubt length rounding : Q) : Q :=
  rnd (rnd (rnd (error + rnd (doubt * length)) * (1 + error_growth)) +
       rounding).

Definition meet (p : Vertex) (hp : Bounded) (q : Vertex) (hq : Bounded)
    (rounding : Q) : Vertex :=
  let t := share_of hp hq in
  {| point := {| px := along t (px (point p)) (px (point q));
                 py := along t (py (point p)) (py (point q));
                 pz := along t (pz (point p)) (pz (point q)) |};
     error := error_of (Qmax (error p) (error q)) (doubt_of hp hq)
                (length_of (point p) (point q)) rounding |}.

(** ** How far the share is off *)

Lemma rounded_within : forall v, - (kRounding * Qabs v) <= rnd v - v /\
  rnd v - v <= kRounding * Qabs v.
Proof. intros v. apply Qabs_Qle_condition, rounds. Qed.

Lemma within : forall v e, Qabs v <= e <-> - e <= v /\ v <= e.
Proof. intros v e. apply Qabs_Qle_condition. Qed.

Lemma clamped : forall v t d, 0 <= t <= 1 -> Qabs (v - t) <= d ->
  0 <= clamp v <= 1 /\ Qabs (clamp v - t) <= d.
Proof.
  intros v t d T D. apply within in D. unfold clamp.
  assert (C : 0 <= Qmax 0 (Qmin 1 v) <= 1 /\
              (Qmax 0 (Qmin 1 v) == v \/
               Qmax 0 (Qmin 1 v) == 0 /\ v <= 0 \/
               Qmax 0 (Qmin 1 v) == 1 /\ 1 <= v)).
  { destruct (Q.min_spec 1 v) as [[A ->] | [A ->]];
      [ | destruct (Q.max_spec 0 v) as [[B ->] | [B ->]] ].
    - split; [ split; discriminate | right; right; split;
        [ reflexivity | lra ] ].
    - split; [ lra | left; reflexivity ].
    - split; [ split; discriminate | right; left; split;
        [ reflexivity | lra ] ]. }
  destruct C as [B C]. split; [ exact B | ]. apply within.
  destruct C as [C | [[C L] | [C L]]]; rewrite C; lra.
Qed.

(** The true share of an edge whose ends are on different sides. *)
Lemma true_share : forall hp hq, (hp < 0 /\ 0 < hq \/ 0 < hp /\ hq < 0) ->
  let t := hp / (hp - hq) in
  0 <= t <= 1 /\ (1 - t) * hp + t * hq == 0.
Proof.
  intros hp hq H t.
  assert (T := proj1 (Split.meet_is_inside_the_edge Split.origin hp
                        Split.origin hq H)).
  fold t in T. split; [ lra | ]. unfold t. field. lra.
Qed.

Theorem share_is_near : forall hp hq th tq,
  Qabs (bounded_value hp - th) <= bounded_error hp ->
  Qabs (bounded_value hq - tq) <= bounded_error hq ->
  (th < 0 /\ 0 < tq \/ 0 < th /\ tq < 0) ->
  let t := th / (th - tq) in
  0 <= share_of hp hq <= 1 /\ 0 <= doubt_of hp hq <= 1 /\
  Qabs (share_of hp hq - t) <= doubt_of hp hq + (203 # 100) * kRounding.
Proof.
  intros [Hp Ep] [Hq Eq] th tq P R S t. cbn [bounded_value bounded_error] in *.
  destruct (true_share th tq S) as [T Zero]. fold t in T, Zero. clearbody t.
  unfold share_of, doubt_of. cbn [bounded_value bounded_error].
  set (F := Hp - Hq). set (f := rnd F).
  set (E := Qmax Ep Eq).
  assert (LE : Ep <= E) by apply Q.le_max_l.
  assert (RE : Eq <= E) by apply Q.le_max_r.
  apply within in P, R.
  assert (E0 : 0 <= E) by lra.
  destruct (Qeq_dec f 0) as [Z | N].
  { split; [ split; discriminate | ]. split; [ split; discriminate | ].
    apply within. unfold kRounding. lra. }
  assert (A : Qabs (Hp - t * F) <= E).
  { apply within.
    assert (K : Hp - t * F == (1 - t) * (Hp - th) + t * (Hq - tq)).
    { setoid_replace ((1 - t) * (Hp - th) + t * (Hq - tq)) with
        ((1 - t) * Hp + t * Hq - ((1 - t) * th + t * tq)) by ring.
      rewrite Zero. unfold F. ring. }
    rewrite K. clear K.
    assert (0 <= t * (E - (Hq - tq)) /\ 0 <= t * (E + (Hq - tq)) /\
            0 <= (1 - t) * (E - (Hp - th)) /\ 0 <= (1 - t) * (E + (Hp - th)))
      by (repeat split; apply Qmult_le_0_compat; lra).
    lra. }
  assert (Pos : 0 < Qabs f).
  { destruct (Qlt_le_dec 0 (Qabs f)) as [L | L]; [ exact L | ].
    exfalso. apply N. apply within in L. lra. }
  set (r := E / Qabs f).
  assert (Rf : r * Qabs f == E) by (unfold r; field; lra).
  assert (R0 : 0 <= r) by (unfold r; apply Qle_shift_div_l; lra).
  (* |F| is little more than |f|. *)
  assert (FF := rounds F). fold f in FF.
  assert (G : Qabs F <= Qabs f + Qabs (f - F)).
  { setoid_replace F with (f - (f - F)) at 1 by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ]. rewrite Qabs_opp. lra. }
  assert (B : Qabs (Hp - t * f) <= E + (101 # 100) * kRounding * Qabs f).
  { setoid_replace (Hp - t * f) with ((Hp - t * F) + t * (F - f)) by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ].
    assert (K : Qabs (t * (F - f)) <= 1 * Qabs (f - F)).
    { apply abs_product; [ apply within; lra | ].
      setoid_replace (F - f) with (- (f - F)) by ring. rewrite Qabs_opp. lra. }
    unfold kRounding in *. lra. }
  set (T1 := Hp / f).
  assert (H1 : T1 * f == Hp) by (unfold T1; field; exact N).
  assert (C : Qabs (T1 - t) <= r + (101 # 100) * kRounding).
  { apply (Qmult_le_r _ _ (Qabs f) Pos). rewrite <- Qabs_Qmult.
    setoid_replace ((T1 - t) * f) with (Hp - t * f) by (rewrite <- H1; ring).
    lra. }
  assert (D : Qabs (rnd T1 - t) <= (1 + kRounding) * r +
                                   (203 # 100) * kRounding).
  { setoid_replace (rnd T1 - t) with ((rnd T1 - T1) + (T1 - t)) by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ]. assert (K := rounds T1).
    assert (M : Qabs T1 <= 1 + Qabs (T1 - t)).
    { setoid_replace T1 with (t + (T1 - t)) at 1 by ring.
      eapply Qle_trans; [ apply Qabs_triangle | ].
      assert (Qabs t <= 1) by (apply within; lra). lra. }
    unfold kRounding in *. lra. }
  destruct (clamped _ _ _ T D) as [Range Near].
  split; [ exact Range | ].
  unfold doubt_factor. set (d := rnd (rnd (2 * E) / Qabs f)).
  assert (Big : (1 + kRounding) * r <= d).
  { assert (K := rnd_below rnd rounds (2 * E) (2 * E) ltac:(lra)
                   (Qle_refl _)).
    assert (L : (1 - kRounding) * (2 * r) <= rnd (2 * E) / Qabs f).
    { apply Qle_shift_div_l; [ exact Pos | ].
      setoid_replace ((1 - kRounding) * (2 * r) * Qabs f)
        with ((1 - kRounding) * (2 * (r * Qabs f))) by ring.
      rewrite Rf. exact K. }
    assert (L0 : 0 <= (1 - kRounding) * (2 * r))
      by (unfold kRounding in *; lra).
    assert (O := rnd_below rnd rounds _ _ L0 L). fold d in O.
    unfold kRounding in *. lra. }
  assert (D0 : 0 <= d) by (unfold kRounding in *; lra).
  destruct (Q.min_spec 1 d) as [[L ->] | [L ->]].
  - split; [ split; discriminate | ]. apply within. unfold kRounding. lra.
  - split; [ lra | ]. eapply Qle_trans; [ exact Near | ]. lra.
Qed.

(** ** How far a coordinate is off *)

Theorem along_is_near : forall s t p q tp tq e M doubt length,
  0 <= s <= 1 -> 0 <= t <= 1 -> 0 <= doubt ->
  Qabs (s - t) <= doubt + (203 # 100) * kRounding ->
  Qabs (p - tp) <= e -> Qabs (q - tq) <= e -> Qabs tp <= M -> Qabs tq <= M ->
  Qabs (rnd (q - p)) <= length ->
  Qabs (along s p q - (tp + (tq - tp) * t)) <=
  e * (1 + 10 * kRounding) + doubt * length * (1 + 2 * kRounding) +
  10 * kRounding * M.
Proof.
  intros s t p q tp tq e M doubt length S T Db Dist P R Mp Mq Len.
  unfold along. set (w := q - p) in *. set (dx := rnd w) in *.
  set (m := rnd (s * dx)).
  apply within in P, R, Mp, Mq.
  assert (W : Qabs w <= 2 * M + 2 * e) by (apply within; unfold w; lra).
  assert (W0 := Qabs_nonneg w).
  assert (A : Qabs (dx - w) <= kRounding * Qabs w) by apply rounds.
  assert (Adx : Qabs dx <= (1 + kRounding) * Qabs w).
  { setoid_replace dx with (w + (dx - w)) at 1 by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ]. lra. }
  assert (Aw : Qabs w <= (1 + (101 # 100) * kRounding) * length).
  { assert (K : Qabs w <= Qabs dx + Qabs (dx - w)).
    { setoid_replace w with (dx - (dx - w)) at 1 by ring.
      eapply Qle_trans; [ apply Qabs_triangle | ]. rewrite Qabs_opp. lra. }
    unfold kRounding in *. lra. }
  assert (As : Qabs s <= 1) by (apply within; lra).
  assert (B : Qabs (m - s * dx) <= kRounding * Qabs dx).
  { eapply Qle_trans; [ apply rounds | ].
    assert (K := abs_product s dx 1 _ As (Qle_refl _)).
    unfold kRounding in *. lra. }
  assert (C : Qabs (m - s * w) <= (201 # 100) * kRounding * Qabs w).
  { setoid_replace (m - s * w) with ((m - s * dx) + s * (dx - w)) by ring.
    eapply Qle_trans; [ apply Qabs_triangle | ].
    assert (K := abs_product s (dx - w) 1 _ As A).
    unfold kRounding in *. lra. }
  assert (D : Qabs (p + s * w) <= M + e).
  { apply within. unfold w.
    assert (0 <= s * (M + e - q) /\ 0 <= s * (M + e + q) /\
            0 <= (1 - s) * (M + e - p) /\ 0 <= (1 - s) * (M + e + p))
      by (repeat split; apply Qmult_le_0_compat; lra). lra. }
  assert (G : Qabs (rnd (p + m) - (p + s * w)) <=
              kRounding * (M + e) + (202 # 100) * kRounding * Qabs w).
  { assert (K : Qabs (p + m - (p + s * w)) <=
                (201 # 100) * kRounding * Qabs w).
    { setoid_replace (p + m - (p + s * w)) with (m - s * w) by ring. exact C. }
    assert (L := rnd_within rnd rounds _ _ _ _ K D).
    eapply Qle_trans; [ exact L | ]. unfold kRounding in *. lra. }
  assert (H : Qabs (p + s * w - (tp + (tq - tp) * t)) <=
              e + Qabs (s - t) * Qabs w).
  { setoid_replace (p + s * w - (tp + (tq - tp) * t))
      with (((1 - t) * (p - tp) + t * (q - tq)) + (s - t) * w)
      by (unfold w; ring).
    eapply Qle_trans; [ apply Qabs_triangle | ]. rewrite Qabs_Qmult.
    assert (K : Qabs ((1 - t) * (p - tp) + t * (q - tq)) <= e).
    { apply within.
      assert (0 <= t * (e - (q - tq)) /\ 0 <= t * (e + (q - tq)) /\
              0 <= (1 - t) * (e - (p - tp)) /\ 0 <= (1 - t) * (e + (p - tp)))
        by (repeat split; apply Qmult_le_0_compat; lra). lra. }
    lra. }
  assert (I : Qabs (s - t) * Qabs w <=
              doubt * ((1 + (101 # 100) * kRounding) * length) +
              (203 # 100) * kRounding * (2 * M + 2 * e)).
  { assert (K1 : Qabs (s - t) * Qabs w <=
                 (doubt + (203 # 100) * kRounding) * Qabs w)
      by (apply Qmult_le_compat_r; assumption).
    assert (K2 : doubt * Qabs w <=
                 doubt * ((1 + (101 # 100) * kRounding) * length)).
    { rewrite !(Qmult_comm doubt). apply Qmult_le_compat_r; assumption. }
    unfold kRounding in *. lra. }
  setoid_replace (rnd (p + m) - (tp + (tq - tp) * t))
    with ((rnd (p + m) - (p + s * w)) + (p + s * w - (tp + (tq - tp) * t)))
    by ring.
  eapply Qle_trans; [ apply Qabs_triangle | ].
  assert (E0 : 0 <= e) by lra. assert (M0 : 0 <= M) by lra.
  assert (L0 : 0 <= length)
    by (eapply Qle_trans; [ apply Qabs_nonneg | exact Len ]).
  assert (DL : 0 <= doubt * length) by (now apply Qmult_le_0_compat).
  setoid_replace (doubt * ((1 + (101 # 100) * kRounding) * length))
    with ((1 + (101 # 100) * kRounding) * (doubt * length)) in I by ring.
  clear - G H I E0 M0 DL W. set (dl := doubt * length) in *.
  unfold kRounding in *. lra.
Qed.

(** The bound that filter.hpp computes, its own roundings included. *)
Theorem vertex_error_is_enough : forall e doubt length M,
  0 <= e -> 0 <= doubt -> 0 <= length -> 0 <= M ->
  e * (1 + 10 * kRounding) + doubt * length * (1 + 2 * kRounding) +
  10 * kRounding * M <= error_of e doubt length (rounding_of_values M).
Proof.
  intros e doubt length M E D L HM.
  assert (DL : 0 <= doubt * length) by (now apply Qmult_le_0_compat).
  unfold error_of, rounding_of_values.
  set (dl := doubt * length) in *.
  set (k := 1 - kRounding). assert (K0 : 0 <= k) by (unfold k, kRounding; lra).
  assert (S1 := rnd_below rnd rounds dl dl DL (Qle_refl _)). fold k in S1.
  assert (S2 : k * (e + k * dl) <= rnd (e + rnd dl)).
  { apply rnd_below; try assumption; unfold k, kRounding in *; lra. }
  assert (S3 : k * (k * (e + k * dl) * (1 + error_growth)) <=
               rnd (rnd (e + rnd dl) * (1 + error_growth))).
  { apply rnd_below; try assumption.
    - unfold k, error_growth, kRounding in *; lra.
    - unfold error_growth, k, kRounding in *; lra. }
  assert (S4 : k * (k * (k * (e + k * dl) * (1 + error_growth)) +
                    values_factor * kRounding * M) <=
    rnd (rnd (rnd (e + rnd dl) * (1 + error_growth)) +
         values_factor * kRounding * M)).
  { apply rnd_below; try assumption;
      unfold k, error_growth, values_factor, kRounding in *; lra. }
  eapply Qle_trans; [ | exact S4 ].
  clear - E DL HM. unfold k, error_growth, values_factor, kRounding. lra.
Qed.

(** ** The vertex *)

(** Where an edge crosses a plane the filter's vertex stands for the true one,
    within the bound that goes with it. *)
Theorem meet_stands_for : forall p hp q hq tp tq th tk M,
  stands_for (point p) tp (error p) -> stands_for (point q) tq (error q) ->
  point_within M tp -> point_within M tq ->
  Qabs (bounded_value hp - th) <= bounded_error hp ->
  Qabs (bounded_value hq - tk) <= bounded_error hq ->
  (th < 0 /\ 0 < tk \/ 0 < th /\ tk < 0) ->
  let new := meet p hp q hq (rounding_of_values M) in
  stands_for (point new) (Split.meet tp th tq tk) (error new).
Proof.
  intros p hp q hq tp tq th tk M Sp Sq Wp Wq Hp Hq Sides new.
  destruct (share_is_near hp hq th tk Hp Hq Sides) as [S [[D0 D1] Near]].
  destruct (true_share th tk Sides) as [T _].
  set (e := Qmax (error p) (error q)).
  assert (LE : error p <= e) by apply Q.le_max_l.
  assert (RE : error q <= e) by apply Q.le_max_r.
  destruct Sp as [Px [Py Pz]], Sq as [Qx [Qy Qz]].
  destruct Wp as [Mx [My Mz]], Wq as [Nx [Ny Nz]].
  assert (E0 : 0 <= e).
  { assert (K := Qabs_nonneg (px (point p) - px tp)). lra. }
  assert (M0 : 0 <= M) by (assert (K := Qabs_nonneg (px tp)); lra).
  set (length := length_of (point p) (point q)).
  assert (Lx : Qabs (rnd (px (point q) - px (point p))) <= length)
    by (apply Q.le_max_l).
  assert (Ly : Qabs (rnd (py (point q) - py (point p))) <= length).
  { eapply Qle_trans; [ apply Q.le_max_l | apply Q.le_max_r ]. }
  assert (Lz : Qabs (rnd (pz (point q) - pz (point p))) <= length).
  { eapply Qle_trans; [ apply Q.le_max_r | apply Q.le_max_r ]. }
  assert (L0 : 0 <= length)
    by (eapply Qle_trans; [ apply Qabs_nonneg | exact Lx ]).
  assert (Enough := vertex_error_is_enough e (doubt_of hp hq) length M E0 D0 L0
                      M0).
  unfold stands_for, new, meet, Split.meet. cbn [point error px py pz].
  fold e length.
  repeat split; (eapply Qle_trans; [ | exact Enough ]);
    apply along_is_near; try assumption; try lra.
Qed.

(** And it is within the grid again, so vertices of vertices are covered. *)
Theorem meet_is_within : forall tp tq th tk M,
  point_within M tp -> point_within M tq ->
  (th < 0 /\ 0 < tk \/ 0 < th /\ tk < 0) ->
  point_within M (Split.meet tp th tq tk).
Proof.
  intros tp tq th tk M [Px [Py Pz]] [Qx [Qy Qz]] Sides.
  destruct (true_share th tk Sides) as [T _].
  assert (One : forall a b, Qabs a <= M -> Qabs b <= M ->
    Qabs (a + (b - a) * (th / (th - tk))) <= M).
  { intros a b A B. apply within in A, B. apply within.
    set (t := th / (th - tk)) in *.
    assert (0 <= t * (M - b) /\ 0 <= t * (M + b) /\
            0 <= (1 - t) * (M - a) /\ 0 <= (1 - t) * (M + a))
      by (repeat split; apply Qmult_le_0_compat; lra). lra. }
  unfold point_within, Split.meet. cbn [px py pz]. auto.
Qed.

End Rounding.
