(** S6 Boolean: which fragments a boolean takes, and why.

    Read beside ref/src/boolean.cpp ([keep]) and ref/src/classify.cpp
    ([class_in_plane]).  Space is Q^3, a set is a predicate on its points, and
    "near" is the cube round a point, so that nothing is assumed. *)

From Coq Require Import QArith Qabs Qminmax Lqa Bool.
From Halfspace Require Import Base.

(** * S6.3, S6.4: the words of boolean.hpp *)

Inductive BooleanOp :=
  kUnion | kIntersection | kDifference | kSymmetricDifference.
Inductive SolidClass := kInside | kOutside | kSame | kOpposite.
Inductive Keep := kDrop | kKeep | kFlip.

(** The table of S6.4, row by row as in ref/src/boolean.cpp. *)
Record Row := { and_a : Keep; and_b : Keep; or_a : Keep; or_b : Keep;
                minus_a : Keep; minus_b : Keep; xor_a : Keep; xor_b : Keep }.

Local Notation X := kKeep.
Local Notation F := kFlip.
Local Notation o := kDrop.

Definition table (solid_class : SolidClass) : Row :=
  match solid_class with
  (*                       AND  OR   A - B XOR
                           A  B  A  B  A  B  A  B *)
  | kInside   => Build_Row X  X  o  o  o  F  F  F
  | kOutside  => Build_Row o  o  X  X  X  o  X  X
  | kSame     => Build_Row X  o  X  o  o  o  o  o
  | kOpposite => Build_Row o  o  o  o  X  o  o  o
  end.

Definition keep (operation : BooleanOp) (solid_class : SolidClass)
    (first_operand : bool) : Keep :=
  let row := table solid_class in
  match operation with
  | kIntersection => if first_operand then row.(and_a) else row.(and_b)
  | kUnion => if first_operand then row.(or_a) else row.(or_b)
  | kDifference => if first_operand then row.(minus_a) else row.(minus_b)
  | kSymmetricDifference => if first_operand then row.(xor_a) else row.(xor_b)
  end.

(** The class of a fragment in a splitter's plane by the classes it gets on the
    splitter's two sides. [agrees]: its normal is the splitter's. *)
Definition is_outside (c : SolidClass) : bool :=
  match c with kOutside => true | _ => false end.

Definition same_class (c d : SolidClass) : bool :=
  match c, d with
  | kInside, kInside | kOutside, kOutside
  | kSame, kSame | kOpposite, kOpposite => true
  | _, _ => false
  end.

Definition class_in_plane (positive negative : SolidClass) (agrees : bool)
    : SolidClass :=
  if same_class positive negative then positive
  else
    let surface_agrees := is_outside positive in
    if Bool.eqb surface_agrees agrees then kSame else kOpposite.

(** * The rule: a boundary is where membership changes *)

(** What a set is right beside a point of a plane: off the plane, its
    membership on the positive side and on the negative side. *)
Record Sides := { on_positive : bool; on_negative : bool }.

(** The operation on memberships. *)
Definition member (operation : BooleanOp) (a b : bool) : bool :=
  match operation with
  | kUnion => a || b
  | kIntersection => a && b
  | kDifference => a && negb b
  | kSymmetricDifference => xorb a b
  end.

Definition member_sides (operation : BooleanOp) (a b : Sides) : Sides :=
  {| on_positive := member operation a.(on_positive) b.(on_positive);
     on_negative := member operation a.(on_negative) b.(on_negative) |}.

(** A solid beside its own surface: the positive side faces out. *)
Definition own_sides : Sides := {| on_positive := false; on_negative := true |}.

(** The other solid beside a fragment of the class, in the fragment's
    orientation. *)
Definition sides_of_class (c : SolidClass) : Sides :=
  match c with
  | kInside => {| on_positive := true; on_negative := true |}
  | kOutside => {| on_positive := false; on_negative := false |}
  | kSame => {| on_positive := false; on_negative := true |}
  | kOpposite => {| on_positive := true; on_negative := false |}
  end.

(** Membership changes across the fragment: keep it if it faces out, turn it
    over if it faces in. *)
Definition rule (result : Sides) : Keep :=
  match result.(on_positive), result.(on_negative) with
  | false, true => kKeep
  | true, false => kFlip
  | _, _ => kDrop
  end.

(** The result beside a fragment of the first operand, or of the second. *)
Definition result_sides (operation : BooleanOp) (c : SolidClass)
    (first_operand : bool) : Sides :=
  if first_operand then member_sides operation own_sides (sides_of_class c)
  else member_sides operation (sides_of_class c) own_sides.

Definition on_surface (c : SolidClass) : bool :=
  match c with kSame | kOpposite => true | _ => false end.

Theorem table_is_the_rule_for_the_first : forall operation c,
  keep operation c true = rule (result_sides operation c true).
Proof. destruct operation, c; reflexivity. Qed.

Theorem table_is_the_rule_for_the_second : forall operation c,
  on_surface c = false ->
  keep operation c false = rule (result_sides operation c false).
Proof. destruct operation, c; (discriminate || reflexivity). Qed.

(** Where both surfaces coincide, the second operand's fragment is dropped: the
    first operand's stands for both. *)
Theorem second_is_dropped_on_a_common_surface : forall operation c,
  on_surface c = true -> keep operation c false = kDrop.
Proof. destruct operation, c; (discriminate || reflexivity). Qed.

Definition taken (k : Keep) : nat := match k with kDrop => 0 | _ => 1 end.

(** On a common surface one of the two fragments is taken if membership changes
    there, and none if it does not. *)
Theorem common_surface_is_taken_once : forall operation c,
  on_surface c = true ->
  let change := xorb (result_sides operation c true).(on_positive)
                     (result_sides operation c true).(on_negative) in
  (taken (keep operation c true) + taken (keep operation c false))%nat =
  if change then 1%nat else 0%nat.
Proof. destruct operation, c; (discriminate || reflexivity). Qed.

(** * S6.3: same and opposite *)

Definition class_of_member (inside : bool) : SolidClass :=
  if inside then kInside else kOutside.

Definition turned (s : Sides) : Sides :=
  {| on_positive := s.(on_negative); on_negative := s.(on_positive) |}.

(** From the other solid's membership above and below the splitter,
    [class_in_plane] names the class that says exactly that about both sides of
    the fragment, whichever way the fragment faces. *)
Theorem class_in_plane_says_both_sides : forall above below agrees,
  sides_of_class
    (class_in_plane (class_of_member above) (class_of_member below) agrees) =
  let splitters := {| on_positive := above; on_negative := below |} in
  if agrees then splitters else turned splitters.
Proof. destruct above, below, agrees; reflexivity. Qed.

Theorem class_tells_sides : forall c d,
  sides_of_class c = sides_of_class d -> c = d.
Proof. destruct c, d; (discriminate || reflexivity). Qed.

Definition turned_class (c : SolidClass) : SolidClass :=
  match c with kSame => kOpposite | kOpposite => kSame | _ => c end.

Theorem turning_the_fragment_exchanges_same_and_opposite :
  forall above below agrees,
  class_in_plane (class_of_member above) (class_of_member below) (negb agrees) =
  turned_class
    (class_in_plane (class_of_member above) (class_of_member below) agrees).
Proof. destruct above, below, agrees; reflexivity. Qed.

(** CSG's rule takes the splitter's direction for the surface's (E3): it errs
    exactly where the surface faces the other way. *)
Definition class_by_the_splitter (positive negative : SolidClass)
    (agrees : bool) : SolidClass :=
  if same_class positive negative then positive
  else if agrees then kSame else kOpposite.

Theorem the_splitters_direction_is_not_enough : forall above below agrees,
  class_by_the_splitter (class_of_member above) (class_of_member below) agrees
    <> class_in_plane (class_of_member above) (class_of_member below) agrees
  <-> above = true /\ below = false.
Proof.
  destruct above, below, agrees; cbn; split; intro H;
    try (split; reflexivity); try discriminate; try (now destruct H);
    try (now contradict H); try (destruct H; discriminate).
Qed.

(** * Identities of the table *)

(** The class against the complement of the other solid. *)
Definition complement_class (c : SolidClass) : SolidClass :=
  match c with
  | kInside => kOutside | kOutside => kInside
  | kSame => kOpposite | kOpposite => kSame
  end.

Definition flipped (k : Keep) : Keep :=
  match k with kKeep => kFlip | kFlip => kKeep | kDrop => kDrop end.

Theorem complement_class_is_the_complement : forall c,
  (sides_of_class (complement_class c)).(on_positive) =
    negb (sides_of_class c).(on_positive) /\
  (sides_of_class (complement_class c)).(on_negative) =
    negb (sides_of_class c).(on_negative).
Proof. destruct c; split; reflexivity. Qed.

(** A - B is A and the complement of B: of A the table takes what it takes of
    the intersection with that complement ... *)
Theorem difference_is_intersection_for_the_first : forall c,
  keep kDifference c true = keep kIntersection (complement_class c) true.
Proof. destruct c; reflexivity. Qed.

(** ... and of B, whose complement has its polygons turned over, the same. *)
Theorem difference_is_intersection_for_the_second : forall c,
  keep kDifference c false =
  flipped (keep kIntersection (turned_class c) false).
Proof. destruct c; reflexivity. Qed.

(** De Morgan: A or B is the complement of the intersection of the complements.
    Polygon and class are turned over twice, so only inside and outside are
    exchanged. *)
Theorem de_morgan_for_the_table : forall c first_operand,
  keep kUnion c first_operand =
  keep kIntersection (turned_class (complement_class c)) first_operand.
Proof. destruct c, first_operand; reflexivity. Qed.

(** Against itself every fragment of a solid is [kSame]. *)
Theorem boolean_with_itself :
  keep kUnion kSame true = kKeep /\ keep kIntersection kSame true = kKeep /\
  keep kDifference kSame true = kDrop /\
  keep kSymmetricDifference kSame true = kDrop /\
  forall operation, keep operation kSame false = kDrop.
Proof. repeat split; destruct operation; reflexivity. Qed.

(** Against the empty solid every fragment is [kOutside]. *)
Theorem boolean_with_the_empty_solid :
  keep kUnion kOutside true = kKeep /\ keep kDifference kOutside true = kKeep /\
  keep kSymmetricDifference kOutside true = kKeep /\
  keep kSymmetricDifference kOutside false = kKeep /\
  keep kIntersection kOutside true = kDrop /\
  keep kDifference kOutside false = kDrop.
Proof. repeat split; reflexivity. Qed.

(** * The rule is the regularised set operation *)

Definition PointSet := Point -> Prop.

Definition near (e : Q) (p q : Point) : Prop :=
  (- e < q.(px) - p.(px) < e) /\ (- e < q.(py) - p.(py) < e) /\
  (- e < q.(pz) - p.(pz) < e).

Definition interior (s : PointSet) (p : Point) : Prop :=
  exists e, 0 < e /\ forall q, near e p q -> s q.
Definition closure (s : PointSet) (p : Point) : Prop :=
  forall e, 0 < e -> exists q, near e p q /\ s q.
Definition boundary (s : PointSet) (p : Point) : Prop :=
  closure s p /\ closure (fun q => ~ s q) p.

(** S6.5: the closure of the interior. *)
Definition regularised (s : PointSet) : PointSet := closure (interior s).

Definition set_operation (operation : BooleanOp) (s t : PointSet) : PointSet :=
  match operation with
  | kUnion => fun p => s p \/ t p
  | kIntersection => fun p => s p /\ t p
  | kDifference => fun p => s p /\ ~ t p
  | kSymmetricDifference => fun p => (s p /\ ~ t p) \/ (t p /\ ~ s p)
  end.

(** [p] is a point of the plane round which the set is, off the plane, what
    [sides] says. *)
Definition beside (plane : Plane) (p : Point) (s : PointSet) (sides : Sides)
    : Prop :=
  exists e, 0 < e /\ forall q, near e p q ->
    (0 < value_at plane q -> (s q <-> sides.(on_positive) = true)) /\
    (value_at plane q < 0 -> (s q <-> sides.(on_negative) = true)).

Definition has_normal (plane : Plane) : Prop :=
  ~ (plane.(pa) == 0 /\ plane.(pb) == 0 /\ plane.(pc) == 0).

(** ** Small facts about cubes *)

Lemma near_itself : forall e p, 0 < e -> near e p p.
Proof. intros e p H; unfold near; repeat split; lra. Qed.

Lemma near_within : forall e f p q, near e p q -> e <= f -> near f p q.
Proof. unfold near; intros e f p q H Hle; repeat split; lra. Qed.

Lemma near_twice : forall e f p q r,
  near e p q -> near f q r -> near (e + f) p r.
Proof. unfold near; intros e f p q r H J; repeat split; lra. Qed.

(** Round a point of an open cube there is a cube that stays in it. *)
Lemma near_room : forall e p q, near e p q ->
  exists f, 0 < f /\ forall r, near f q r -> near e p r.
Proof.
  intros e p q H.
  assert (G : forall u, - e < u < e -> exists f, 0 < f /\ f <= e - u /\
                                                 f <= e + u).
  { intros u Hu. destruct (Qlt_le_dec u 0) as [N | N].
    - exists (e + u). repeat split; lra.
    - exists (e - u). repeat split; lra. }
  destruct H as [Hx [Hy Hz]].
  destruct (G _ Hx) as [f1 [P1 [A1 B1]]].
  destruct (G _ Hy) as [f2 [P2 [A2 B2]]].
  destruct (G _ Hz) as [f3 [P3 [A3 B3]]].
  exists (Qmin f1 (Qmin f2 f3)).
  assert (M1 := Q.le_min_l f1 (Qmin f2 f3)).
  assert (M2 := Q.le_min_r f1 (Qmin f2 f3)).
  assert (M3 := Q.le_min_l f2 f3). assert (M4 := Q.le_min_r f2 f3).
  split.
  - apply Q.min_glb_lt; [ assumption | apply Q.min_glb_lt; assumption ].
  - intros r [Rx [Ry Rz]]. unfold near; repeat split; lra.
Qed.

Definition size (plane : Plane) : Q :=
  Qabs plane.(pa) + Qabs plane.(pb) + Qabs plane.(pc).

Lemma size_nonnegative : forall plane, 0 <= size plane.
Proof.
  intro plane. unfold size.
  assert (A := Qabs_nonneg (pa plane)). assert (B := Qabs_nonneg (pb plane)).
  assert (C := Qabs_nonneg (pc plane)). lra.
Qed.

Lemma product_bound : forall n u e, 0 <= e -> - e < u < e ->
  - (Qabs n * e) <= n * u <= Qabs n * e.
Proof.
  intros n u e He [L U].
  pattern (Qabs n). apply Qabs_case; intro H; split; nra.
Qed.

Lemma value_moves_little : forall plane p q e, 0 <= e -> near e p q ->
  - (size plane * e) <= value_at plane q - value_at plane p <= size plane * e.
Proof.
  intros plane p q e He [Hx [Hy Hz]].
  assert (A := product_bound (pa plane) _ e He Hx).
  assert (B := product_bound (pb plane) _ e He Hy).
  assert (C := product_bound (pc plane) _ e He Hz).
  unfold size, value_at. split; lra.
Qed.

(** Off the plane there is a cube off the plane. *)
Lemma room_on_the_positive_side : forall plane q, 0 < value_at plane q ->
  exists f, 0 < f /\ forall r, near f q r -> 0 < value_at plane r.
Proof.
  intros plane q H. assert (S := size_nonnegative plane).
  assert (Pos : 0 < / (2 * (size plane + 1))) by (apply Qinv_lt_0_compat; lra).
  exists (value_at plane q * / (2 * (size plane + 1))). split; [ nra | ].
  intros r N.
  assert (E : value_at plane q * / (2 * (size plane + 1)) *
              (2 * (size plane + 1)) == value_at plane q) by (field; lra).
  apply (value_moves_little plane) in N; [ | nra ].
  set (f := value_at plane q * / (2 * (size plane + 1))) in *.
  assert (0 < f) by (unfold f; nra). nra.
Qed.

Lemma room_on_the_negative_side : forall plane q, value_at plane q < 0 ->
  exists f, 0 < f /\ forall r, near f q r -> value_at plane r < 0.
Proof.
  intros plane q H.
  destruct (room_on_the_positive_side (reversed plane) q) as [f [Hf G]].
  - rewrite value_at_reversed; lra.
  - exists f; split; [ assumption | ]. intros r N. specialize (G r N).
    rewrite value_at_reversed in G; lra.
Qed.

Lemma normal_square : forall plane, has_normal plane ->
  0 < pa plane * pa plane + pb plane * pb plane + pc plane * pc plane.
Proof.
  intros plane H.
  assert (S : forall v, 0 <= v * v) by (intro; nra).
  assert (Z : forall v, v * v <= 0 -> v == 0).
  { intros v G.
    destruct (Q_dec v 0) as [[L | L] | L]; [ nra | nra | exact L ]. }
  assert (A := S (pa plane)). assert (B := S (pb plane)).
  assert (C := S (pc plane)).
  destruct (Qlt_le_dec 0 (pa plane * pa plane + pb plane * pb plane +
                          pc plane * pc plane)) as [L | L]; [ exact L | ].
  exfalso. apply H. repeat split; apply Z; lra.
Qed.

(** Beside every point of the plane, however near, there is a point on its
    positive side. *)
Lemma close_on_the_positive_side : forall plane, has_normal plane ->
  forall q e, 0 < e -> value_at plane q == 0 ->
  exists r, near e q r /\ 0 < value_at plane r.
Proof.
  intros plane Hn q e He Hq.
  assert (N := normal_square plane Hn). assert (S := size_nonnegative plane).
  assert (Pos : 0 < / (2 * (size plane + 1))) by (apply Qinv_lt_0_compat; lra).
  set (t := e * / (2 * (size plane + 1))).
  assert (Ht : 0 < t) by (unfold t; nra).
  assert (E : t * (2 * (size plane + 1)) == e) by (unfold t; field; lra).
  exists {| px := px q + t * pa plane; py := py q + t * pb plane;
            pz := pz q + t * pc plane |}.
  assert (A := Qabs_nonneg (pa plane)). assert (B := Qabs_nonneg (pb plane)).
  assert (C := Qabs_nonneg (pc plane)).
  assert (G : forall n, Qabs n <= size plane -> - e < t * n < e).
  { intros n Hle. assert (L := Qle_Qabs n). assert (M := Qle_Qabs (- n)).
    rewrite Qabs_opp in M. split; nra. }
  split.
  - unfold near; cbn.
    assert (Ga := G (pa plane)). assert (Gb := G (pb plane)).
    assert (Gc := G (pc plane)). unfold size in Ga, Gb, Gc.
    repeat split; lra.
  - assert (V : value_at plane {| px := px q + t * pa plane;
        py := py q + t * pb plane; pz := pz q + t * pc plane |} ==
        value_at plane q + t * (pa plane * pa plane + pb plane * pb plane +
                                pc plane * pc plane))
      by (unfold value_at; cbn; ring).
    rewrite V. nra.
Qed.

Lemma reversed_has_normal : forall plane,
  has_normal plane -> has_normal (reversed plane).
Proof.
  unfold has_normal, reversed; cbn; intros plane H [A [B C]].
  apply H; repeat split; lra.
Qed.

Lemma close_on_the_negative_side : forall plane, has_normal plane ->
  forall q e, 0 < e -> value_at plane q == 0 ->
  exists r, near e q r /\ value_at plane r < 0.
Proof.
  intros plane Hn q e He Hq.
  destruct (close_on_the_positive_side (reversed plane)
              (reversed_has_normal plane Hn) q e He) as [r [N V]].
  - rewrite value_at_reversed; lra.
  - exists r; split; [ assumption | ]. rewrite value_at_reversed in V; lra.
Qed.

(** Off the plane, however near to any point, there is a point of a side that
    holds points near it. *)
Lemma close_off_the_plane : forall plane, has_normal plane ->
  forall q e, 0 < e ->
  exists r, near e q r /\ (0 < value_at plane r \/ value_at plane r < 0).
Proof.
  intros plane Hn q e He.
  destruct (Q_dec (value_at plane q) 0) as [[L | G] | E].
  - exists q; split; [ now apply near_itself | right; exact L ].
  - exists q; split; [ now apply near_itself | left; exact G ].
  - destruct (close_on_the_positive_side plane Hn q e He E) as [r [N V]].
    exists r; split; [ exact N | left; exact V ].
Qed.

(** ** The theorems *)

Theorem operation_beside_a_plane : forall operation plane p s t i j,
  beside plane p s i -> beside plane p t j ->
  beside plane p (set_operation operation s t) (member_sides operation i j).
Proof.
  intros operation plane p s t i j [e [He Hs]] [f [Hf Ht]].
  exists (Qmin e f). split; [ now apply Q.min_glb_lt | ].
  intros q N.
  destruct (Hs q (near_within _ _ _ _ N (Q.le_min_l e f))) as [Sp Sn].
  destruct (Ht q (near_within _ _ _ _ N (Q.le_min_r e f))) as [Tp Tn].
  split; intro V; [ specialize (Sp V); specialize (Tp V); clear Sn Tn
                  | specialize (Sn V); specialize (Tn V); clear Sp Tp ];
    destruct operation, i as [[] []], j as [[] []]; cbn in *;
    intuition discriminate.
Qed.

(** Regularising a set changes nothing off the plane. *)
Theorem regularised_beside_a_plane : forall plane p s sides,
  beside plane p s sides -> beside plane p (regularised s) sides.
Proof.
  intros plane p s sides [e [He H]]. exists e. split; [ exact He | ].
  intros q N. destruct (near_room e p q N) as [f [Hf Room]].
  split; intro V.
  - destruct (room_on_the_positive_side plane q V) as [g [Hg Off]].
    split.
    + intro R. destruct (R (Qmin f g)) as [r [Nr Ir]].
      { now apply Q.min_glb_lt. }
      assert (Nf := near_within _ _ _ _ Nr (Q.le_min_l f g)).
      assert (Ng := near_within _ _ _ _ Nr (Q.le_min_r f g)).
      destruct (H r (Room r Nf)) as [Hp Hn].
      apply (Hp (Off r Ng)).
      destruct Ir as [k [Hk Ik]]. apply Ik. now apply near_itself.
    + intros T k Hk. exists q. split; [ now apply near_itself | ].
      exists (Qmin f g). split; [ now apply Q.min_glb_lt | ].
      intros r Nr.
      assert (Nf := near_within _ _ _ _ Nr (Q.le_min_l f g)).
      assert (Ng := near_within _ _ _ _ Nr (Q.le_min_r f g)).
      destruct (H r (Room r Nf)) as [Hp Hn].
      now apply (Hp (Off r Ng)).
  - destruct (room_on_the_negative_side plane q V) as [g [Hg Off]].
    split.
    + intro R. destruct (R (Qmin f g)) as [r [Nr Ir]].
      { now apply Q.min_glb_lt. }
      assert (Nf := near_within _ _ _ _ Nr (Q.le_min_l f g)).
      assert (Ng := near_within _ _ _ _ Nr (Q.le_min_r f g)).
      destruct (H r (Room r Nf)) as [Hp Hn].
      apply (Hn (Off r Ng)).
      destruct Ir as [k [Hk Ik]]. apply Ik. now apply near_itself.
    + intros T k Hk. exists q. split; [ now apply near_itself | ].
      exists (Qmin f g). split; [ now apply Q.min_glb_lt | ].
      intros r Nr.
      assert (Nf := near_within _ _ _ _ Nr (Q.le_min_l f g)).
      assert (Ng := near_within _ _ _ _ Nr (Q.le_min_r f g)).
      destruct (H r (Room r Nf)) as [Hp Hn].
      now apply (Hn (Off r Ng)).
Qed.

(** The regularised set has its boundary where membership changes, and there
    alone. *)
Theorem boundary_where_membership_changes : forall plane p s sides,
  has_normal plane -> value_at plane p == 0 -> beside plane p s sides ->
  (boundary (regularised s) p <-> sides.(on_positive) <> sides.(on_negative)).
Proof.
  intros plane p s [sp sn] Hn Hp B. cbn.
  assert (R := regularised_beside_a_plane _ _ _ _ B).
  destruct R as [e [He R]]. destruct B as [e' [He' B]]. cbn in R, B.
  split.
  - intros [In Out] Same. subst sn. destruct sp.
    + (* Both sides inside: no point near p is outside. *)
      destruct (Out (Qmin e e')) as [q [Nq NotR]].
      { now apply Q.min_glb_lt. }
      assert (Ne := near_within _ _ _ _ Nq (Q.le_min_l e e')).
      assert (Ne' := near_within _ _ _ _ Nq (Q.le_min_r e e')).
      destruct (R q Ne) as [Rp Rn].
      destruct (Q_dec (value_at plane q) 0) as [[L | G] | E].
      * apply NotR. now apply Rn.
      * apply NotR. now apply Rp.
      * apply NotR. intros k Hk.
        destruct (near_room e' p q Ne') as [f [Hf Room]].
        destruct (close_on_the_positive_side plane Hn q (Qmin k f))
          as [r [Nr Vr]]; [ now apply Q.min_glb_lt | exact E | ].
        assert (Nk := near_within _ _ _ _ Nr (Q.le_min_l k f)).
        assert (Nf := near_within _ _ _ _ Nr (Q.le_min_r k f)).
        exists r. split; [ exact Nk | ].
        destruct (near_room e' p r (Room r Nf)) as [f' [Hf' Room']].
        destruct (room_on_the_positive_side plane r Vr) as [g [Hg Off]].
        exists (Qmin f' g). split; [ now apply Q.min_glb_lt | ].
        intros w Nw.
        assert (Nf' := near_within _ _ _ _ Nw (Q.le_min_l f' g)).
        assert (Ng := near_within _ _ _ _ Nw (Q.le_min_r f' g)).
        now apply (proj1 (B w (Room' w Nf')) (Off w Ng)).
    + (* Both sides outside: no point near p is inside. *)
      destruct (In e') as [q [Nq Rq]]; [ exact He' | ].
      destruct (near_room e' p q Nq) as [f [Hf Room]].
      destruct (Rq f Hf) as [r [Nr [k [Hk Ik]]]].
      destruct (near_room e' p r (Room r Nr)) as [f' [Hf' Room']].
      destruct (close_off_the_plane plane Hn r (Qmin k f')) as [w [Nw Off]];
        [ now apply Q.min_glb_lt | ].
      assert (Nk := near_within _ _ _ _ Nw (Q.le_min_l k f')).
      assert (Nf' := near_within _ _ _ _ Nw (Q.le_min_r k f')).
      destruct (B w (Room' w Nf')) as [Bp Bn].
      destruct Off as [V | V].
      * assert (S := proj1 (Bp V) (Ik w Nk)). discriminate.
      * assert (S := proj1 (Bn V) (Ik w Nk)). discriminate.
  - (* Both sides come arbitrarily near. *)
    assert (G : forall k, 0 < k ->
      (exists q, near k p q /\ near e p q /\ 0 < value_at plane q) /\
      (exists q, near k p q /\ near e p q /\ value_at plane q < 0)).
    { intros k Hk. split.
      - destruct (close_on_the_positive_side plane Hn p (Qmin k e))
          as [q [N V]]; [ now apply Q.min_glb_lt | exact Hp | ].
        exists q. repeat split; try (exact V).
        all: try apply (near_within _ _ _ _ N (Q.le_min_l k e)).
        all: apply (near_within _ _ _ _ N (Q.le_min_r k e)).
      - destruct (close_on_the_negative_side plane Hn p (Qmin k e))
          as [q [N V]]; [ now apply Q.min_glb_lt | exact Hp | ].
        exists q. repeat split; try (exact V).
        all: try apply (near_within _ _ _ _ N (Q.le_min_l k e)).
        all: apply (near_within _ _ _ _ N (Q.le_min_r k e)). }
    intro Differ. split; intros k Hk; destruct (G k Hk) as
      [[q [Nk [Ne V]]] [q' [Nk' [Ne' V']]]].
    + destruct sp, sn; try congruence.
      * exists q. split; [ exact Nk | ].
        now apply (proj1 (R q Ne) V).
      * exists q'. split; [ exact Nk' | ].
        now apply (proj2 (R q' Ne') V').
    + destruct sp, sn; try congruence.
      * exists q'. split; [ exact Nk' | ]. intro I.
        apply (proj2 (R q' Ne') V') in I. discriminate.
      * exists q. split; [ exact Nk | ]. intro I.
        apply (proj1 (R q Ne) V) in I. discriminate.
Qed.

(** S6.4 and S6.5 together.  Near an inner point of a fragment of A the table
    takes the fragment exactly where the regularised result has its
    boundary ... *)
Theorem first_operands_fragment_is_taken_on_the_boundary :
  forall operation plane p s t c,
  has_normal plane -> value_at plane p == 0 ->
  beside plane p s own_sides -> beside plane p t (sides_of_class c) ->
  (boundary (regularised (set_operation operation s t)) p <->
   keep operation c true <> kDrop).
Proof.
  intros operation plane p s t c Hn Hp Hs Ht.
  rewrite (boundary_where_membership_changes plane p _ _ Hn Hp
             (operation_beside_a_plane operation _ _ _ _ _ _ Hs Ht)).
  destruct operation, c; cbn; intuition congruence.
Qed.

(** ... and so it is for a fragment of B off A's surface. *)
Theorem second_operands_fragment_is_taken_on_the_boundary :
  forall operation plane p s t c,
  has_normal plane -> value_at plane p == 0 -> on_surface c = false ->
  beside plane p s (sides_of_class c) -> beside plane p t own_sides ->
  (boundary (regularised (set_operation operation s t)) p <->
   keep operation c false <> kDrop).
Proof.
  intros operation plane p s t c Hn Hp Off Hs Ht.
  rewrite (boundary_where_membership_changes plane p _ _ Hn Hp
             (operation_beside_a_plane operation _ _ _ _ _ _ Hs Ht)).
  destruct operation, c; try discriminate; cbn; intuition congruence.
Qed.

(** What is kept faces out of the result, and what is flipped does so once it
    is turned over. *)
Theorem taken_fragments_face_outwards : forall operation plane p s t c,
  beside plane p s own_sides -> beside plane p t (sides_of_class c) ->
  let result := regularised (set_operation operation s t) in
  (keep operation c true = kKeep -> beside plane p result own_sides) /\
  (keep operation c true = kFlip -> beside plane p result (turned own_sides)).
Proof.
  intros operation plane p s t c Hs Ht result.
  assert (R := regularised_beside_a_plane _ _ _ _
                 (operation_beside_a_plane operation _ _ _ _ _ _ Hs Ht)).
  destruct operation, c; split; intro K; (discriminate || exact R).
Qed.

Theorem taken_fragments_of_the_second_face_outwards :
  forall operation plane p s t c,
  on_surface c = false ->
  beside plane p s (sides_of_class c) -> beside plane p t own_sides ->
  let result := regularised (set_operation operation s t) in
  (keep operation c false = kKeep -> beside plane p result own_sides) /\
  (keep operation c false = kFlip -> beside plane p result (turned own_sides)).
Proof.
  intros operation plane p s t c Off Hs Ht result.
  assert (R := regularised_beside_a_plane _ _ _ _
                 (operation_beside_a_plane operation _ _ _ _ _ _ Hs Ht)).
  destruct operation, c; try discriminate; split; intro K;
    (discriminate || exact R).
Qed.

(** The identities, for point sets. *)
Theorem difference_is_intersection_with_the_complement : forall s t p,
  regularised (set_operation kDifference s t) p <->
  regularised (set_operation kIntersection s (fun q => ~ t q)) p.
Proof. intros; reflexivity. Qed.

Theorem de_morgan : forall s t p,
  ~ set_operation kUnion s t p <->
  set_operation kIntersection (fun q => ~ s q) (fun q => ~ t q) p.
Proof. intros; cbn; tauto. Qed.

Theorem all_but_the_difference_commute : forall operation s t p,
  operation <> kDifference ->
  (regularised (set_operation operation s t) p <->
   regularised (set_operation operation t s) p).
Proof.
  assert (G : forall s t : PointSet, (forall p, s p <-> t p) ->
              forall p, regularised s p -> regularised t p).
  { intros s t E p R e He. destruct (R e He) as [q [N [f [Hf I]]]].
    exists q. split; [ exact N | ]. exists f. split; [ exact Hf | ].
    intros r Nr. apply E. now apply I. }
  intros operation s t p N.
  destruct operation; try (now contradict N);
    split; apply G; intro q; cbn; tauto.
Qed.
