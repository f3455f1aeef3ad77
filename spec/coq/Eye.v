(** * S4.2: the filter never tells a wrong side of the eye.

    Read beside [eye_value] and [make_view] of fast/src/view. As in [Filter.v]
    doubles are modelled by what rounds. *)

From Coq Require Import QArith Qabs Lqa.
From Halfspace Require Import Base Filter.

Section Rounding.
Variable rnd : Q -> Q.
Hypothesis rounds : forall v, Qabs (rnd v - v) <= kRounding * Qabs v.

(** How many half units of the sizes the bound is. *)
Definition eye_factor : Q := 8.

(** [farthest] is the largest of the eye's coordinates, and [grid] bounds the
    scene's, or is 0 for an eye at infinity, to which a plane's offset is 0. *)
Definition eye_error (farthest grid : Q) : Q :=
  rnd (eye_factor * kRounding * rnd (farthest + grid)).

Definition eye_bound (plane : Plane) (farthest grid : Q) : Q :=
  rnd (filter_size rnd plane * eye_error farthest grid).

(** A coordinate of the eye, rounded once. *)
Definition rounded_once (x truth : Q) : Prop :=
  Qabs (x - truth) <= kRounding * Qabs truth.

Lemma eye_term : forall a ta x tx far,
  Qabs (a - ta) <= 2 * kRounding * Qabs ta -> rounded_once x tx ->
  Qabs x <= far ->
  Qabs (a * x - ta * tx) <= (302 # 100) * kRounding * (Qabs a * far).
Proof.
  intros a ta x tx far A X F. unfold rounded_once in X.
  assert (F0 : 0 <= far) by (eapply Qle_trans; [ apply Qabs_nonneg | exact F ]).
  assert (T : Qabs tx <= (1 + 2 * kRounding) * far).
  { assert (K : Qabs tx <= Qabs x + Qabs (x - tx)).
    { setoid_replace tx with (x - (x - tx)) at 1 by ring.
      eapply Qle_trans; [ apply Qabs_triangle | ]. rewrite Qabs_opp. lra. }
    assert (Qabs tx >= 0) by apply Qabs_nonneg.
    unfold kRounding in *. lra. }
  assert (B : Qabs ta <= (1 + 3 * kRounding) * Qabs a).
  { destruct (size_of_truth a ta 1 ltac:(discriminate) A) as [K _].
    assert (Qabs ta >= 0) by apply Qabs_nonneg.
    assert (Qabs a >= 0) by apply Qabs_nonneg.
    unfold kRounding in *. lra. }
  assert (P : Qabs (a * (x - tx)) <= Qabs a * (kRounding * ((1 + 2 * kRounding)
              * far))).
  { apply abs_product; [ apply Qle_refl | ]. unfold kRounding in *. lra. }
  assert (R : Qabs ((a - ta) * tx) <= 2 * kRounding * ((1 + 3 * kRounding) *
              Qabs a) * ((1 + 2 * kRounding) * far)).
  { apply abs_product; [ | exact T ]. unfold kRounding in *. lra. }
  assert (AF : 0 <= Qabs a * far)
    by (apply Qmult_le_0_compat; [ apply Qabs_nonneg | exact F0 ]).
  setoid_replace (Qabs a * (kRounding * ((1 + 2 * kRounding) * far))) with
    (kRounding * (1 + 2 * kRounding) * (Qabs a * far)) in P by ring.
  setoid_replace (2 * kRounding * ((1 + 3 * kRounding) * Qabs a) *
                  ((1 + 2 * kRounding) * far)) with
    (2 * kRounding * (1 + 3 * kRounding) * (1 + 2 * kRounding) *
     (Qabs a * far)) in R by ring.
  setoid_replace (a * x - ta * tx) with (a * (x - tx) + (a - ta) * tx) by ring.
  eapply Qle_trans; [ apply Qabs_triangle | ].
  set (af := Qabs a * far) in *. clear - P R AF. unfold kRounding in *. lra.
Qed.

(** All that is off at the eye. *)
Theorem eye_value_is_near : forall plane truth e te far grid,
  approximates plane truth ->
  rounded_once (px e) (px te) -> rounded_once (py e) (py te) ->
  rounded_once (pz e) (pz te) ->
  Qabs (px e) <= far -> Qabs (py e) <= far -> Qabs (pz e) <= far ->
  0 <= grid -> offset_within grid truth ->
  Qabs (filter_value rnd plane e - value_at truth te) <=
  (704 # 100) * kRounding * (sizes plane * (far + grid)).
Proof.
  intros plane truth e te far grid [A [B [C D]]] X Y Z Fx Fy Fz G Off.
  assert (Near := filter_value_is_near rnd rounds plane e far Fx Fy Fz).
  assert (TA := eye_term _ _ _ _ far A X Fx).
  assert (TB := eye_term _ _ _ _ far B Y Fy).
  assert (TC := eye_term _ _ _ _ far C Z Fz).
  destruct (size_of_truth _ _ grid G A) as [SA _].
  destruct (size_of_truth _ _ grid G B) as [SB _].
  destruct (size_of_truth _ _ grid G C) as [SC _].
  destruct (size_of_truth _ _ 1 ltac:(discriminate) D) as [_ SD].
  assert (F0 : 0 <= far)
    by (eapply Qle_trans; [ apply Qabs_nonneg | exact Fx ]).
  assert (Nf : forall v, 0 <= Qabs v * far)
    by (intros; apply Qmult_le_0_compat; [ apply Qabs_nonneg | exact F0 ]).
  assert (Ng : forall v, 0 <= Qabs v * grid)
    by (intros; apply Qmult_le_0_compat; [ apply Qabs_nonneg | exact G ]).
  assert (Na := Nf (pa plane)). assert (Nb := Nf (pb plane)).
  assert (Nc := Nf (pc plane)). assert (Ga := Ng (pa truth)).
  assert (Gb := Ng (pb truth)). assert (Gc := Ng (pc truth)).
  unfold offset_within, sizes in *.
  setoid_replace ((Qabs (pa truth) + Qabs (pb truth) + Qabs (pc truth)) * grid)
    with (Qabs (pa truth) * grid + Qabs (pb truth) * grid +
          Qabs (pc truth) * grid) in Off by ring.
  setoid_replace ((Qabs (pa plane) + Qabs (pb plane) + Qabs (pc plane)) *
                  (far + grid))
    with (Qabs (pa plane) * far + Qabs (pb plane) * far +
          Qabs (pc plane) * far + (Qabs (pa plane) * grid +
          Qabs (pb plane) * grid + Qabs (pc plane) * grid)) by ring.
  setoid_replace (filter_value rnd plane e - value_at truth te) with
    ((filter_value rnd plane e - value_at plane e) +
     (((pa plane * px e - pa truth * px te) +
       (pb plane * py e - pb truth * py te)) +
      ((pc plane * pz e - pc truth * pz te) + (pd plane - pd truth))))
    by (unfold value_at; ring).
  eapply Qle_trans; [ apply (abs_sum _ _ _ _ Near (abs_sum _ _ _ _
    (abs_sum _ _ _ _ TA TB) (abs_sum _ _ _ _ TC D))) | ].
  clear - SA SB SC SD Off Na Nb Nc Ga Gb Gc. unfold kRounding in *. lra.
Qed.

(** The bound that the fast library computes, its own roundings included, is no
    smaller: a sign that it tells is the eye's side. *)
Theorem known_sign_at_the_eye : forall plane truth e te far grid side,
  approximates plane truth ->
  rounded_once (px e) (px te) -> rounded_once (py e) (py te) ->
  rounded_once (pz e) (pz te) ->
  Qabs (px e) <= far -> Qabs (py e) <= far -> Qabs (pz e) <= far ->
  0 <= grid -> offset_within grid truth ->
  known_sign (filter_value rnd plane e) (eye_bound plane far grid) =
    Some side ->
  side_of truth te = side.
Proof.
  intros plane truth e te far grid side A X Y Z Fx Fy Fz G Off H.
  assert (Near := eye_value_is_near plane truth e te far grid A X Y Z Fx Fy Fz
                    G Off).
  assert (F0 : 0 <= far)
    by (eapply Qle_trans; [ apply Qabs_nonneg | exact Fx ]).
  assert (Enough : (704 # 100) * kRounding * (sizes plane * (far + grid)) <=
                   eye_bound plane far grid).
  { unfold eye_bound, eye_error, filter_size, sizes.
    assert (Na := Qabs_nonneg (pa plane)).
    assert (Nb := Qabs_nonneg (pb plane)).
    assert (Nc := Qabs_nonneg (pc plane)).
    set (a := Qabs (pa plane)) in *. set (b := Qabs (pb plane)) in *.
    set (c := Qabs (pc plane)) in *. clearbody a b c.
    set (k := 1 - kRounding). assert (K0 : 0 <= k) by discriminate.
    assert (S1 : k * (a + b) <= rnd (a + b))
      by (apply (rnd_below rnd rounds); [ lra | apply Qle_refl ]).
    assert (S2 : k * (k * (a + b + c)) <= rnd (rnd (a + b) + c)).
    { apply (rnd_below rnd rounds); unfold k, kRounding in *; lra. }
    assert (S3 : k * (far + grid) <= rnd (far + grid))
      by (apply (rnd_below rnd rounds); [ lra | apply Qle_refl ]).
    assert (S4 : k * (eye_factor * kRounding * (k * (far + grid))) <=
      rnd (eye_factor * kRounding * rnd (far + grid))).
    { apply (rnd_below rnd rounds);
        unfold eye_factor, k, kRounding in *; lra. }
    set (size := rnd (rnd (a + b) + c)) in *.
    set (error := rnd (eye_factor * kRounding * rnd (far + grid))) in *.
    assert (L1 : 0 <= k * (k * (a + b + c))) by (unfold k, kRounding; lra).
    assert (L2 : 0 <= k * (eye_factor * kRounding * (k * (far + grid))))
      by (unfold eye_factor, k, kRounding; lra).
    assert (P := Qmult_le_compat_nonneg _ _ _ _ (conj L1 S2) (conj L2 S4)).
    eapply Qle_trans; [ | exact (rnd_below rnd rounds _ _
      (Qmult_le_0_compat _ _ L1 L2) P) ].
    assert (N : 0 <= (a + b + c) * (far + grid))
      by (apply Qmult_le_0_compat; lra).
    fold k. setoid_replace (k * (k * (k * (a + b + c)) *
      (k * (eye_factor * kRounding * (k * (far + grid)))))) with
      (k * k * k * k * k * eye_factor * kRounding *
       ((a + b + c) * (far + grid))) by ring.
    set (n := (a + b + c) * (far + grid)) in *. clear - N.
    unfold k, eye_factor, kRounding. lra. }
  assert (B := Qle_trans _ _ _ Near Enough). apply Qabs_Qle_condition in B.
  unfold known_sign in H. unfold side_of.
  destruct (Qlt_le_dec _ _) as [L | _] in H.
  - injection H as <-. apply sign_positive. lra.
  - destruct (Qlt_le_dec _ _) as [L | _] in H; [ | discriminate ].
    injection H as <-. apply sign_negative. lra.
Qed.

End Rounding.
