(** * S1.3, S2.3: the parts of a convex polygon are convex polygons.

    The walk of [Split.v], and so of ref/src/split.cpp, is followed from vertex
    to vertex: every edge of a part is a piece of an edge of the polygon, or
    goes from where the boundary leaves the part's side of the plane to where
    it comes back. *)

From Coq Require Import QArith Lqa Lia List Bool Permutation.
From Halfspace Require Import Base.
From Halfspace Require Split.
Import ListNotations.
Open Scope Q_scope.

(** ** Vectors *)

Definition difference (p q : Point) : Point :=
  {| px := px p - px q; py := py p - py q; pz := pz p - pz q |}.

Definition dot (u v : Point) : Q := px u * px v + py u * py v + pz u * pz v.

Definition cross (u v : Point) : Point :=
  {| px := py u * pz v - pz u * py v;
     py := pz u * px v - px u * pz v;
     pz := px u * py v - py u * px v |}.

Definition normal (h : Plane) : Point :=
  {| px := pa h; py := pb h; pz := pc h |}.

Definition not_zero (h : Plane) : Prop :=
  ~ (pa h == 0 /\ pb h == 0 /\ pc h == 0).

Definition same (p q : Point) : Prop :=
  px p == px q /\ py p == py q /\ pz p == pz q.

Lemma square_positive : forall x, ~ x == 0 -> 0 < x * x.
Proof. intros x H; destruct (Q_dec x 0) as [[|]|]; nra || contradiction. Qed.

Lemma dot_positive : forall u,
  ~ (px u == 0 /\ py u == 0 /\ pz u == 0) -> 0 < dot u u.
Proof.
  intros u N; unfold dot.
  assert (forall x, 0 <= x * x) as S by (intros; nra).
  pose proof (S (px u)); pose proof (S (py u)); pose proof (S (pz u)).
  destruct (Qeq_dec (px u) 0) as [A | A];
    [|pose proof (square_positive _ A); lra].
  destruct (Qeq_dec (py u) 0) as [B | B];
    [|pose proof (square_positive _ B); lra].
  destruct (Qeq_dec (pz u) 0) as [C | C];
    [|pose proof (square_positive _ C); lra].
  exfalso; apply N; auto.
Qed.

Lemma not_zero_square : forall h, not_zero h -> 0 < dot (normal h) (normal h).
Proof. intros h N; now apply dot_positive. Qed.

(** ** Polygons *)

(** A plane through the edge from [p] to [q] of a polygon in the plane [h],
    positive on the polygon's side. *)
Definition edge_plane (h : Plane) (p q : Point) : Plane :=
  let m := cross (normal h) (difference q p) in
  {| pa := px m; pb := py m; pc := pz m; pd := - dot m p |}.

(** The steps from each to the next. *)
Fixpoint along (l : list Point) : list (Point * Point) :=
  match l with
  | p :: (q :: _) as rest => (p, q) :: along rest
  | _ => []
  end.

(** All steps, round the polygon and back to the first corner. *)
Definition round (l : list Point) : list (Point * Point) :=
  match l with
  | [] => []
  | p :: _ => along (l ++ [p])
  end.

(** No two members are one point. *)
Definition visits_once : list Point -> Prop :=
  ForallOrdPairs (fun p q => ~ same p q).

(** S1.3: the corners are in the plane, every edge has all of them on its side,
    no edge has its ends in one point, no two corners are one point, and not all
    are on one line. *)
Record polygon_ok (plane : Plane) (corners : list Point) : Prop := {
  ok_planar : forall v, In v corners -> value_at plane v == 0;
  ok_convex : forall p q v, In (p, q) (round corners) -> In v corners ->
    0 <= value_at (edge_plane plane p q) v;
  ok_apart : forall p q, In (p, q) (round corners) -> ~ same p q;
  ok_once : visits_once corners;
  ok_area : exists p q v, In (p, q) (round corners) /\ In v corners /\
    0 < value_at (edge_plane plane p q) v
}.

(** Twice the area of a triangle, times the size of the normal. *)
Definition area (h : Plane) (p q v : Point) : Q :=
  value_at (edge_plane h p q) v.

Ltac expand := unfold area, value_at, edge_plane, cross, dot, difference,
  normal in *; simpl in *.

Lemma area_turn : forall h p q v, area h p q v == area h q v p.
Proof. intros; expand; ring. Qed.

Lemma area_swap : forall h p q v, area h q p v == - area h p q v.
Proof. intros; expand; ring. Qed.

(** Four points of a plane, and the values of any plane at them. *)
Lemma four_points : forall h k a b c v, not_zero h ->
  value_at h a == 0 -> value_at h b == 0 -> value_at h c == 0 ->
  value_at h v == 0 ->
  area h a b c * value_at k v ==
  area h v b c * value_at k a + area h a v c * value_at k b +
  area h a b v * value_at k c.
Proof.
  intros h k a b c v N A B C V; apply not_zero_square in N.
  set (det := dot (difference b a) (cross (difference c a) (difference v a))).
  assert (det * dot (normal h) (normal h) ==
    area h a c v * (value_at h b - value_at h a) -
    area h a b v * (value_at h c - value_at h a) +
    area h a b c * (value_at h v - value_at h a)) as D.
  { unfold det; expand; ring. }
  rewrite A, B, C, V in D.
  assert (det == 0) as Z.
  { assert (det * dot (normal h) (normal h) == 0) as E by lra.
    apply Qmult_integral in E; destruct E; [assumption | lra]. }
  assert (det * dot (normal k) (normal h) ==
    area h a c v * (value_at k b - value_at k a) -
    area h a b v * (value_at k c - value_at k a) +
    area h a b c * (value_at k v - value_at k a)) as E.
  { unfold det; expand; ring. }
  rewrite Z in E.
  assert (area h v b c == area h a b c - area h a v c - area h a b v) as F.
  { expand; ring. }
  assert (area h a c v == - area h a v c) as G by (expand; ring).
  rewrite F, G in *; lra.
Qed.

(** Beside an edge there is a point of the plane off it. *)
Lemma point_beside : forall h p q, not_zero h -> value_at h p == 0 ->
  value_at h q == 0 -> ~ same p q ->
  exists z, value_at h z == 0 /\ ~ area h p q z == 0.
Proof.
  intros h p q N P Q D; set (u := cross (normal h) (difference q p)).
  exists {| px := px p + px u; py := py p + py u; pz := pz p + pz u |}; split.
  - rewrite <- P; unfold u; expand; ring.
  - pose proof (not_zero_square h N) as S.
    assert (0 < dot (difference q p) (difference q p)) as T.
    { apply dot_positive; intros (A & B & C); apply D; unfold same.
      expand; repeat split; lra. }
    assert (area h p q {| px := px p + px u; py := py p + py u;
                          pz := pz p + pz u |} ==
            dot (normal h) (normal h) * dot (difference q p) (difference q p) -
            (value_at h q - value_at h p) * (value_at h q - value_at h p))
      as E by (unfold u; expand; ring).
    rewrite E, P, Q; nra.
Qed.

(** ** Steps *)

Lemma along_app : forall l x m,
  along (l ++ x :: m) = along (l ++ [x]) ++ along (x :: m).
Proof.
  induction l as [|p [|q l] IH]; intros x m; [reflexivity | reflexivity |].
  change ((p :: q :: l) ++ x :: m) with (p :: (q :: l) ++ x :: m).
  change ((p :: q :: l) ++ [x]) with (p :: (q :: l) ++ [x]).
  simpl in *; now rewrite IH.
Qed.

Lemma along_twice : forall l, incl (along (l ++ l)) (round l).
Proof.
  intros [|x l] s I; [destruct I|].
  change ((x :: l) ++ x :: l) with (x :: l ++ x :: l) in I.
  change (x :: l ++ x :: l) with ((x :: l) ++ x :: l) in I.
  rewrite along_app in I; apply in_app_or in I; destruct I as [I | I];
    [exact I|].
  unfold round; destruct l as [|y l]; [destruct I|].
  assert (forall k, incl (along k) (along (k ++ [x]))) as K; [|now apply K].
  clear; induction k as [|p [|q k] IH]; intros s I; [destruct I | destruct I |].
  destruct I as [<- | I]; [now left|]; right; now apply IH.
Qed.

Lemma along_ends : forall l p q, In (p, q) (along l) -> In p l /\ In q l.
Proof.
  induction l as [|x [|y l] IH]; intros p q I; [destruct I | destruct I |].
  destruct I as [E | I]; [injection E as <- <-; simpl; auto|].
  destruct (IH p q I); split; right; assumption.
Qed.

Lemma round_ends : forall l p q, In (p, q) (round l) -> In p l /\ In q l.
Proof.
  intros [|x l] p q I; [destruct I|]; apply along_ends in I.
  destruct I as [P Q]; apply in_app_or in P, Q; simpl in *.
  split; [destruct P as [P | [P | []]] | destruct Q as [Q | [Q | []]]]; auto.
Qed.

Lemma round_leaves : forall l p, In p l -> exists q, In (p, q) (round l).
Proof.
  intros [|x l] p I; [destruct I|]; unfold round.
  assert (forall k, In p k -> exists q, In (p, q) (along (k ++ [x]))) as K;
    [|now apply K].
  clear; induction k as [|y k IH]; intros I; [destruct I|].
  destruct k as [|z k].
  - destruct I as [-> | []]; exists x; now left.
  - destruct I as [-> | I]; [exists z; now left|].
    destruct (IH I) as [q Q]; exists q; now right.
Qed.

Lemma same_sym : forall p q, same p q -> same q p.
Proof. intros p q (A & B & C); repeat split; now symmetry. Qed.

Lemma same_value : forall p q k, same p q -> value_at k p == value_at k q.
Proof. intros p q k (A & B & C); unfold value_at; rewrite A, B, C; ring. Qed.

Lemma visits_once_in : forall l p q, visits_once l -> In p l -> In q l ->
  same p q -> p = q.
Proof.
  intros l p q O P Q S; destruct (ForallOrdPairs_In O p q P Q) as [E | [N | N]];
    [exact E | contradiction | destruct N; now apply same_sym].
Qed.

Lemma visits_once_distinct : forall l, visits_once l -> NoDup l.
Proof.
  intros l O; induction O as [|p l H O IH]; constructor; auto.
  intros I; rewrite Forall_forall in H; apply (H p I).
  unfold same; repeat split; reflexivity.
Qed.

Lemma along_starts : forall l x, map fst (along (l ++ [x])) = l.
Proof.
  induction l as [|p [|q l] IH]; intros x; [reflexivity | reflexivity |].
  change ((p :: q :: l) ++ [x]) with (p :: q :: (l ++ [x])).
  change (map fst (along (p :: q :: (l ++ [x])))) with
    (p :: map fst (along ((q :: l) ++ [x]))); now rewrite IH.
Qed.

Lemma along_stops : forall l x y, map snd (along (y :: l ++ [x])) = l ++ [x].
Proof.
  induction l as [|p l IH]; intros x y; [reflexivity|].
  change (map snd (along (y :: (p :: l) ++ [x]))) with
    (p :: map snd (along (p :: l ++ [x]))); now rewrite IH.
Qed.

Lemma round_starts : forall l, map fst (round l) = l.
Proof. intros [|x l]; [reflexivity|]; apply along_starts. Qed.

Lemma round_stops : forall l, Permutation (map snd (round l)) l.
Proof.
  intros [|x l]; [constructor|]; unfold round.
  change ((x :: l) ++ [x]) with (x :: l ++ [x]); rewrite along_stops.
  apply Permutation_sym, Permutation_cons_append.
Qed.

(** A corner has one edge that leaves it, and one that comes to it. *)
Lemma one_next : forall l p q q', visits_once l -> In (p, q) (round l) ->
  In (p, q') (round l) -> q = q'.
Proof.
  intros l p q q' O I J; apply visits_once_distinct in O.
  rewrite <- round_starts in O; revert I J O; generalize (round l).
  induction l0 as [|e m IH]; intros I J O; [destruct I|].
  inversion O as [|? ? N O']; subst.
  assert (forall z, In (p, z) m -> In p (map fst m)) as K.
  { intros z Z; apply in_map_iff; exists (p, z); auto. }
  destruct I as [-> | I], J as [E | J]; simpl in N.
  - now injection E.
  - destruct N; eauto.
  - subst e; destruct N; eauto.
  - auto.
Qed.

Lemma one_before : forall l p p' q, visits_once l -> In (p, q) (round l) ->
  In (p', q) (round l) -> p = p'.
Proof.
  intros l p p' q O I J; apply visits_once_distinct in O.
  apply (Permutation_NoDup (Permutation_sym (round_stops l))) in O.
  revert I J O; generalize (round l).
  induction l0 as [|e m IH]; intros I J O; [destruct I|].
  inversion O as [|? ? N O']; subst.
  assert (forall z, In (z, q) m -> In q (map snd m)) as K.
  { intros z Z; apply in_map_iff; exists (z, q); auto. }
  destruct I as [-> | I], J as [E | J]; simpl in N.
  - now injection E.
  - destruct N; eauto.
  - subst e; destruct N; eauto.
  - auto.
Qed.

(** ** A convex polygon against a plane *)

(** [v] is on the edge from [p] to [q], at [t]. *)
Definition at_ (t : Q) (p q v : Point) : Prop :=
  px v == px p + (px q - px p) * t /\ py v == py p + (py q - py p) * t /\
  pz v == pz p + (pz q - pz p) * t.

Lemma at_value : forall t p q v k, at_ t p q v ->
  value_at k v == value_at k p + (value_at k q - value_at k p) * t.
Proof.
  intros t p q v k (X & Y & Z); unfold value_at; rewrite X, Y, Z; ring.
Qed.

Lemma at_start : forall p q, at_ 0 p q p.
Proof. intros; unfold at_; repeat split; ring. Qed.

Lemma at_end : forall p q, at_ 1 p q q.
Proof. intros; unfold at_; repeat split; ring. Qed.

Lemma at_area : forall h p q t u a b, at_ t p q a -> at_ u p q b ->
  forall v, area h a b v == (u - t) * area h p q v.
Proof.
  intros h p q t u a b (X & Y & Z) (X' & Y' & Z') v.
  unfold area, edge_plane, cross, difference, dot, value_at; simpl.
  rewrite X, Y, Z, X', Y', Z'; ring.
Qed.

Section Cut.

Variables (plane h : Plane) (corners : list Point).
Hypothesis plane_ok : not_zero plane.
Hypothesis ok : polygon_ok plane corners.
Hypothesis some_above : exists v, In v corners /\ 0 < value_at h v.
Hypothesis some_below : exists v, In v corners /\ value_at h v < 0.

Local Notation edge p q := (In (p, q) (round corners)).
Local Notation g := (value_at h).

Lemma corner_planar : forall v, In v corners -> value_at plane v == 0.
Proof. apply (ok_planar _ _ ok). Qed.

Lemma edge_planar : forall p q, edge p q ->
  value_at plane p == 0 /\ value_at plane q == 0.
Proof.
  intros p q E; apply round_ends in E; split; apply corner_planar; tauto.
Qed.

Lemma edge_area : forall p q v, edge p q -> In v corners ->
  0 <= area plane p q v.
Proof. apply (ok_convex _ _ ok). Qed.

(** Not all corners are on one edge's line. *)
Lemma not_flat : forall p q, edge p q ->
  ~ forall v, In v corners -> area plane p q v == 0.
Proof.
  intros p q E F; destruct (ok_area _ _ ok) as (a & b & c & AB & C & L).
  fold (area plane a b c) in L; destruct (edge_planar p q E) as [P Q].
  destruct (round_ends _ _ _ AB) as [A B].
  destruct (point_beside plane p q plane_ok P Q (ok_apart _ _ ok p q E))
    as (z & Z & N).
  apply N; pose proof (four_points plane (edge_plane plane p q) a b c z plane_ok
    (corner_planar a A) (corner_planar b B) (corner_planar c C) Z) as D.
  fold (area plane p q z) (area plane p q a) (area plane p q b)
    (area plane p q c) in D.
  rewrite (F a A), (F b B), (F c C) in D.
  assert (area plane a b c * area plane p q z == 0) as D' by lra.
  apply Qmult_integral in D'; destruct D'; [lra | assumption].
Qed.

(** No edge lies in the plane. *)
Lemma no_edge_in_plane : forall p q, edge p q -> g p == 0 -> g q == 0 -> False.
Proof.
  intros p q E P Q; destruct some_above as (u & U & Gu).
  destruct some_below as (w & W & Gw).
  destruct (edge_planar p q E) as [Pp Pq].
  pose proof (four_points plane h p q u w plane_ok Pp Pq (corner_planar u U)
    (corner_planar w W)) as D; rewrite P, Q in D.
  pose proof (edge_area p q u E U) as Au.
  pose proof (edge_area p q w E W) as Aw.
  assert (area plane p q u == 0) as Zu.
  { destruct (Q_dec (area plane p q u) 0) as [[L | L] | L]; [lra | nra |].
    exact L. }
  destruct (point_beside plane p q plane_ok Pp Pq (ok_apart _ _ ok p q E))
    as (z & Z & N).
  pose proof (four_points plane h p q z u plane_ok Pp Pq Z (corner_planar u U))
    as F; rewrite P, Q, Zu in F.
  assert (area plane p q z * g u == 0) as G by lra.
  apply Qmult_integral in G; destruct G; [contradiction | lra].
Qed.

(** The boundary does not touch the plane from one side. *)
Lemma no_touching : forall k a v b,
  (exists w, In w corners /\ value_at k w < 0) ->
  edge a v -> edge v b -> value_at k v == 0 -> 0 < value_at k a ->
  0 < value_at k b -> False.
Proof.
  intros k a v b (w & W & Gw) A B V Ga Gb.
  destruct (edge_planar a v A) as [Pa Pv], (edge_planar v b B) as [_ Pb].
  destruct (round_ends _ _ _ B) as [_ Ib].
  assert (forall z, In z corners -> area plane a v b * value_at k z ==
          area plane v b z * value_at k a + area plane a v z * value_at k b)
    as F.
  { intros z Z; pose proof (four_points plane k a v b z plane_ok Pa Pv Pb
      (corner_planar z Z)) as F; rewrite V in F.
    assert (area plane z v b == area plane v b z) as T by apply area_turn.
    rewrite T in F; lra. }
  pose proof (edge_area a v b A Ib) as Ab.
  assert (area plane a v b == 0) as Z.
  { pose proof (F w W) as Fw; pose proof (edge_area v b w B W).
    pose proof (edge_area a v w A W).
    destruct (Q_dec (area plane a v b) 0) as [[L | L] | L]; [lra | nra |].
    exact L. }
  apply (not_flat a v A); intros z I; pose proof (F z I) as Fz.
  rewrite Z in Fz; pose proof (edge_area v b z B I).
  pose proof (edge_area a v z A I).
  destruct (Q_dec (area plane a v z) 0) as [[L | L] | L]; [lra | nra |].
  exact L.
Qed.

(** Where the boundary leaves the positive side, and where it comes back. *)
Definition exit (x : Point) : Prop :=
  exists r s t, edge r s /\ 0 <= g r /\ g s < 0 /\ 0 <= t < 1 /\
  at_ t r s x /\ g x == 0.

Definition entry (y : Point) : Prop :=
  exists r s t, edge r s /\ g r <= 0 /\ 0 < g s /\ 0 <= t < 1 /\
  at_ t r s y /\ g y == 0.

Lemma at_planar : forall r s t x, edge r s -> at_ t r s x ->
  value_at plane x == 0.
Proof.
  intros r s t x E A; destruct (edge_planar r s E) as [R S].
  rewrite (at_value t r s x plane A), R, S; ring.
Qed.

Lemma at_edge_area : forall p q r s t x, edge p q -> edge r s -> 0 <= t <= 1 ->
  at_ t r s x -> 0 <= area plane p q x.
Proof.
  intros p q r s t x E F T A; destruct (round_ends _ _ _ F) as [R S].
  unfold area; rewrite (at_value t r s x _ A).
  pose proof (edge_area p q r E R) as Ar.
  pose proof (edge_area p q s E S) as As.
  unfold area in *; nra.
Qed.

(** The exit and the entry are apart, the entry to the left. *)
Lemma exit_before_entry : forall r s r' s' t' y,
  edge r s -> 0 <= g r -> g s < 0 -> edge r' s' -> g r' <= 0 -> 0 < g s' ->
  0 <= t' < 1 -> at_ t' r' s' y -> g y == 0 -> 0 < area plane r s y.
Proof.
  intros r s r' s' t' y E R S E' R' S' T' A' Gy.
  pose proof (at_edge_area r s r' s' t' y E E' ltac:(lra) A') as N.
  destruct (Qlt_le_dec 0 (area plane r s y)) as [L | L]; [exact L | exfalso].
  assert (area plane r s y == 0) as Z by lra; clear N L.
  destruct (edge_planar r s E) as [Pr Ps], (edge_planar r' s' E') as [Pr' Ps'].
  pose proof (at_planar r' s' t' y E' A') as Py.
  destruct (round_ends _ _ _ E') as [_ Is'].
  (* Seen from y all is left of s, too. *)
  assert (forall v, In v corners ->
          area plane r s v * g s == area plane y s v * (g s - g r)) as B.
  { intros v V; pose proof (four_points plane h r s y v plane_ok Pr Ps Py
      (corner_planar v V)) as F; rewrite Z, Gy in F.
    assert (area plane v s y == - area plane y s v) as F1 by (expand; ring).
    assert (area plane r v y == area plane r s y -
            (area plane r s v - area plane y s v)) as F2 by (expand; ring).
    rewrite F1, F2, Z in F; lra. }
  assert (forall v, In v corners -> 0 <= area plane y s v) as C.
  { intros v V; specialize (B v V); pose proof (edge_area r s v E V).
    destruct (Qlt_le_dec (area plane y s v) 0) as [M | M]; [exfalso; nra|].
    exact M. }
  assert (forall v, In v corners -> 0 <= area plane y s' v) as D.
  { intros v V.
    assert (area plane y s' v == (1 - t') * area plane r' s' v) as ->.
    { apply (at_area plane r' s'); [exact A' | apply at_end]. }
    pose proof (edge_area r' s' v E' V); nra. }
  assert (forall v, In v corners -> area plane y s s' * g v ==
          - area plane y s' v * g s + area plane y s v * g s') as F.
  { intros v V; pose proof (four_points plane h y s s' v plane_ok Py Ps Ps'
      (corner_planar v V)) as F; rewrite Gy in F.
    assert (area plane y v s' == - area plane y s' v) as F1 by (expand; ring).
    rewrite F1 in F; lra. }
  destruct some_below as (w & W & Gw).
  assert (area plane y s s' == 0) as Y.
  { pose proof (C s' Is') as C1; pose proof (F w W) as F1.
    pose proof (C w W); pose proof (D w W).
    assert (0 <= - area plane y s' w * g s) by nra.
    assert (0 <= area plane y s w * g s') by nra.
    destruct (Q_dec (area plane y s s') 0) as [[M | M] | M]; [lra | nra |].
    exact M. }
  apply (not_flat r s E); intros v V.
  pose proof (F v V) as F1; rewrite Y in F1.
  pose proof (C v V) as C1; pose proof (D v V) as D1.
  assert (0 <= - area plane y s' v * g s) by nra.
  assert (area plane y s v == 0) as K.
  { destruct (Q_dec (area plane y s v) 0) as [[M | M] | M]; [lra | nra |].
    exact M. }
  pose proof (B v V) as B1; rewrite K in B1.
  assert (area plane r s v * g s == 0) as B2 by lra.
  apply Qmult_integral in B2; destruct B2; [assumption | lra].
Qed.

(** So the edge from exit to entry is the plane's, as seen in the polygon's. *)
Lemma cut_edge : forall x y, exit x -> entry y ->
  exists c, 0 < c /\ forall v, value_at plane v == 0 ->
  area plane x y v == c * g v.
Proof.
  intros x y (r & s & t & E & R & S & T & A & Gx)
    (r' & s' & t' & E' & R' & S' & T' & A' & Gy).
  pose proof (exit_before_entry r s r' s' t' y E R S E' R' S' T' A' Gy) as L.
  destruct (edge_planar r s E) as [_ Ps].
  pose proof (at_planar r s t x E A) as Px.
  pose proof (at_planar r' s' t' y E' A') as Py.
  assert (area plane x s y == (1 - t) * area plane r s y) as X.
  { apply (at_area plane r s); [exact A | apply at_end]. }
  exists (area plane x s y / - g s); split.
  - apply Qlt_shift_div_l; [lra|]; nra.
  - intros v V; pose proof (four_points plane h x y s v plane_ok Px Py Ps V)
      as F; rewrite Gx, Gy in F.
    assert (area plane x y s == - area plane x s y) as G by (expand; ring).
    rewrite G in F; apply Qmult_inj_r with (- g s); [lra|].
    setoid_replace (area plane x s y / - g s * g v * - g s)
      with (area plane x s y * g v) by (field; lra).
    lra.
Qed.

(** ** The walk *)

(** The point in which an edge crosses the plane. *)
Variable meet : Point -> Point -> Point.
Hypothesis meet_at : forall p q, 0 < g p /\ g q < 0 \/ g p < 0 /\ 0 < g q ->
  exists t, 0 < t < 1 /\ at_ t p q (meet p q) /\ g (meet p q) == 0.

(** What the walk puts into the positive part at the edge from [p] to [q]. *)
Definition emit (e : Point * Point) : list Point :=
  let (p, q) := e in
  match side_of h p, side_of h q with
  | kOn, kOn => []
  | kOn, _ => [p]
  | kPositive, kNegative => [p; meet p q]
  | kPositive, _ => [p]
  | kNegative, kPositive => [meet p q]
  | kNegative, _ => []
  end.

(** [a] and then [b] are on one edge. *)
Definition piece (a b : Point) : Prop :=
  exists r s t u, edge r s /\ 0 <= t /\ t < u /\ u <= 1 /\
  at_ t r s a /\ at_ u r s b.

(** Step of a part: a piece of an edge, or the cut. *)
Definition linked (e : Point * Point) : Prop :=
  piece (fst e) (snd e) \/ exit (fst e) /\ entry (snd e).

(** What is known of the last corner put, [a], when the walk comes to [p]. *)
Definition state (a p : Point) : Prop :=
  (0 < g p /\ piece a p) \/
  (g p == 0 /\ piece a p /\ exists r, edge r p /\ 0 < g r) \/
  (g p == 0 /\ exit a /\ exists r, edge r p /\ g r < 0) \/
  (g p < 0 /\ exit a).

Lemma whole_piece : forall p q, edge p q -> piece p q.
Proof.
  intros p q E; exists p, q, 0, 1; repeat split; auto; try lra;
    apply at_start || apply at_end.
Qed.

(** One step of the walk: what is put follows [a], and the state goes on. *)
Lemma walk_step : forall p q, edge p q ->
  (exists x y, emit (p, q) = [x; y] /\ linked (x, y) /\ state y q /\
     forall a, state a p -> linked (a, x)) \/
  (exists x, emit (p, q) = [x] /\ state x q /\
     forall a, state a p -> linked (a, x)) \/
  (emit (p, q) = [] /\ forall a, state a p -> state a q).
Proof.
  intros p q E; unfold emit, side_of.
  pose proof (no_edge_in_plane p q E) as Flat.
  assert (forall x, g x == 0 -> g x < 0 -> False) as Zn by (intros; lra).
  assert (forall x, g x == 0 -> 0 < g x -> False) as Zp by (intros; lra).
  assert (forall x, g x < 0 -> 0 < g x -> False) as Np by (intros; lra).
  destruct (sign_cases (g p)) as [[-> P] | [[-> P] | [-> P]]];
    destruct (sign_cases (g q)) as [[-> R] | [[-> R] | [-> R]]].
  - right; right; split; [reflexivity|]; intros a S.
    unfold state in *; intuition (exfalso; eauto).
  - right; right; split; [reflexivity|]; intros a S.
    assert (exists r, edge r q /\ g r < 0) by (exists p; auto).
    unfold state in *; intuition (exfalso; eauto).
  - right; left; exists (meet p q).
    destruct (meet_at p q (or_intror (conj P R))) as (t & T & A & M).
    assert (entry (meet p q)) as Y.
    { exists p, q, t; repeat split; auto; try lra; apply A. }
    split; [reflexivity|]; split.
    + left; split; [exact R|]; exists p, q, t, 1; repeat split; auto; try lra;
        apply A || apply at_end.
    + intros a S; right; split; [|exact Y]; simpl.
      unfold state in S; intuition (exfalso; eauto).
  - right; left; exists p; split; [reflexivity|]; split.
    + right; right; right; split; [exact R|]; exists p, q, 0.
      repeat split; auto; try lra; apply at_start.
    + intros a S; unfold state in S.
      destruct S as [[S _] | [[_ [S _]] | [(_ & _ & r & B & L) | [S _]]]].
      * exfalso; eauto.
      * left; exact S.
      * exfalso; apply (no_touching (reversed h) r p q); auto.
        -- destruct some_above as (u & U & Gu); exists u; split; [exact U|].
           rewrite value_at_reversed; lra.
        -- rewrite value_at_reversed; lra.
        -- rewrite value_at_reversed; lra.
        -- rewrite value_at_reversed; lra.
      * exfalso; eauto.
  - exfalso; auto.
  - right; left; exists p; split; [reflexivity|]; split.
    + left; split; [exact R | now apply whole_piece].
    + intros a S; unfold state in S.
      destruct S as [[S _] | [(_ & _ & r & B & L) | [[_ [S _]] | [S _]]]].
      * exfalso; eauto.
      * exfalso; apply (no_touching h r p q some_below); auto.
      * right; split; [exact S|]; exists p, q, 0.
        repeat split; auto; simpl; try lra; apply at_start.
      * exfalso; eauto.
  - left; exists p, (meet p q).
    destruct (meet_at p q (or_introl (conj P R))) as (t & T & A & M).
    split; [reflexivity|]; split; [|split].
    + left; exists p, q, 0, t; repeat split; auto; try lra;
        apply at_start || apply A.
    + right; right; right; split; [exact R|]; exists p, q, t.
      repeat split; auto; try lra; apply A.
    + intros a S; left; unfold state in S.
      intuition (exfalso; eauto).
  - right; left; exists p; split; [reflexivity|]; split.
    + right; left; split; [exact R|]; split; [now apply whole_piece|].
      exists p; auto.
    + intros a S; left; unfold state in S.
      intuition (exfalso; eauto).
  - right; left; exists p; split; [reflexivity|]; split.
    + left; split; [exact R | now apply whole_piece].
    + intros a S; left; unfold state in S.
      intuition (exfalso; eauto).
Qed.

(** The steps of what is put, after [a]. *)
Lemma walk_linked : forall l p a, incl (along (p :: l)) (round corners) ->
  state a p -> Forall linked (along (a :: flat_map emit (along (p :: l)))).
Proof.
  induction l as [|q l IH]; intros p a I S; [constructor|].
  assert (edge p q) as E by (apply I; now left).
  assert (incl (along (q :: l)) (round corners)) as I'.
  { intros e J; apply I; now right. }
  change (along (p :: q :: l)) with ((p, q) :: along (q :: l)).
  change (flat_map emit ((p, q) :: along (q :: l)))
    with (emit (p, q) ++ flat_map emit (along (q :: l))).
  destruct (walk_step p q E) as [(x & y & -> & L & T & K) |
    [(x & -> & T & K) | (-> & K)]]; simpl app.
  - constructor; [now apply K|]; constructor; [exact L|]; now apply IH.
  - constructor; [now apply K|]; now apply IH.
  - apply IH; auto.
Qed.

Lemma walk_linked_from_start : forall l,
  incl (along l) (round corners) ->
  Forall linked (along (flat_map emit (along l))).
Proof.
  induction l as [|p [|q l] IH]; intros I; [constructor | constructor |].
  assert (edge p q) as E by (apply I; now left).
  assert (incl (along (q :: l)) (round corners)) as I'.
  { intros e J; apply I; now right. }
  change (along (p :: q :: l)) with ((p, q) :: along (q :: l)).
  change (flat_map emit ((p, q) :: along (q :: l)))
    with (emit (p, q) ++ flat_map emit (along (q :: l))).
  destruct (walk_step p q E) as [(x & y & -> & L & T & _) |
    [(x & -> & T & _) | (-> & _)]]; simpl app.
  - constructor; [exact L|]; now apply walk_linked.
  - now apply walk_linked.
  - now apply IH.
Qed.

(** The corners of the positive part. *)
Definition part_corners : list Point := flat_map emit (round corners).

Lemma round_in_twice : forall l, incl (round l) (along (l ++ l)).
Proof.
  intros [|x l] e I; [destruct I|].
  change (along ((x :: l) ++ x :: l)) with (along ((x :: l) ++ x :: l)).
  rewrite along_app; apply in_or_app; left; exact I.
Qed.

Lemma round_twice : forall x l,
  round (x :: l) ++ round (x :: l) = along ((x :: l) ++ x :: (l ++ [x])).
Proof. intros x l; now rewrite along_app. Qed.

Lemma part_linked : forall a b, In (a, b) (round part_corners) ->
  linked (a, b).
Proof.
  assert (Forall linked (along (part_corners ++ part_corners))) as F.
  { unfold part_corners; rewrite <- flat_map_app.
    assert (forall l, round l ++ round l = along (l ++ l ++ firstn 1 l) /\
            incl (along (l ++ l ++ firstn 1 l)) (round l)) as K.
    { intros [|x l]; [split; [reflexivity | intros e []]|].
      assert (along ((x :: l) ++ (x :: l) ++ firstn 1 (x :: l)) =
              round (x :: l) ++ round (x :: l)) as ->.
      { symmetry; apply round_twice. }
      split; [reflexivity|]; intros e J; apply in_app_or in J; tauto. }
    destruct (K corners) as [-> I]; now apply walk_linked_from_start. }
  intros a b I; apply round_in_twice in I; rewrite Forall_forall in F; auto.
Qed.

(** ** The part is a convex polygon *)

(** A corner of the part is one of the polygon, or on the plane between two. *)
Lemma part_corner : forall v, In v part_corners ->
  0 <= g v /\ exists p q t, edge p q /\ 0 <= t <= 1 /\ at_ t p q v /\
  (In v corners \/ g v == 0).
Proof.
  intros v I; apply in_flat_map in I; destruct I as ((p, q) & E & I).
  destruct (round_ends _ _ _ E) as [P Q]; unfold emit, side_of in I.
  assert (v = p -> 0 <= g p -> 0 <= g v /\ exists p q t, edge p q /\
          0 <= t <= 1 /\ at_ t p q v /\ (In v corners \/ g v == 0)) as A.
  { intros -> L; split; [exact L|]; exists p, q, 0; repeat split; auto;
      try lra; apply at_start. }
  assert (0 < g p /\ g q < 0 \/ g p < 0 /\ 0 < g q -> v = meet p q ->
          0 <= g v /\ exists p q t, edge p q /\
          0 <= t <= 1 /\ at_ t p q v /\ (In v corners \/ g v == 0)) as B.
  { intros S ->; destruct (meet_at p q S) as (t & T & M & Z).
    split; [lra|]; exists p, q, t; repeat split; auto; try lra; apply M. }
  destruct (sign_cases (g p)) as [[X L] | [[X L] | [X L]]]; rewrite X in I;
    destruct (sign_cases (g q)) as [[Y M] | [[Y M] | [Y M]]]; rewrite Y in I;
    simpl in I;
    repeat (destruct I as [I | I];
      [symmetry in I; (apply A; [exact I | lra]) ||
                      (apply B; [tauto | exact I]) |]); destruct I.
Qed.

Lemma part_keeps : forall v, In v corners -> 0 < g v -> In v part_corners.
Proof.
  intros v I P; destruct (round_leaves corners v I) as [q E].
  apply in_flat_map; exists (v, q); split; [exact E|]; unfold emit, side_of.
  apply sign_positive in P; rewrite P; destruct (sign (g q)); now left.
Qed.

(** From a corner above to one below the boundary leaves. *)
Lemma leaves : forall l p w, 0 <= g p -> In w l -> g w < 0 ->
  exists r s, In (r, s) (along (p :: l)) /\ 0 <= g r /\ g s < 0.
Proof.
  induction l as [|q l IH]; intros p w P I W; [destruct I|].
  destruct (Qlt_le_dec (g q) 0) as [R | R].
  - exists p, q; repeat split; auto; now left.
  - destruct I as [-> | I]; [lra|].
    destruct (IH q w R I W) as (r & s & J & K); exists r, s; split; auto.
    now right.
Qed.

Lemma comes_back : forall l p w, g p <= 0 -> In w l -> 0 < g w ->
  exists r s, In (r, s) (along (p :: l)) /\ g r <= 0 /\ 0 < g s.
Proof.
  induction l as [|q l IH]; intros p w P I W; [destruct I|].
  destruct (Qlt_le_dec 0 (g q)) as [R | R].
  - exists p, q; repeat split; auto; now left.
  - destruct I as [-> | I]; [lra|].
    destruct (IH q w R I W) as (r & s & J & K); exists r, s; split; auto.
    now right.
Qed.

(** All that follows a corner, once round. *)
Lemma round_from : forall p, In p corners ->
  exists l, incl corners l /\ incl (along (p :: l)) (round corners).
Proof.
  intros p I; apply in_split in I; destruct I as (l1 & l2 & E).
  exists (l2 ++ corners); split.
  - intros v V; apply in_or_app; now right.
  - intros e J; apply along_twice; rewrite E at 1; rewrite <- app_assoc.
    simpl; rewrite along_app; apply in_or_app; right; exact J.
Qed.

Lemma part_has_exit : exists x, In x part_corners /\ exit x.
Proof.
  destruct some_above as (u & U & Gu), some_below as (w & W & Gw).
  destruct (round_from u U) as (l & A & B).
  destruct (leaves l u w ltac:(lra) (A w W) Gw) as (r & s & I & R & S).
  apply B in I.
  destruct (Qlt_le_dec 0 (g r)) as [L | L].
  - destruct (meet_at r s (or_introl (conj L S))) as (t & T & M & Z).
    exists (meet r s); split.
    + apply in_flat_map; exists (r, s); split; [exact I|].
      unfold emit, side_of; apply sign_positive in L; apply sign_negative in S.
      rewrite L, S; right; now left.
    + exists r, s, t; repeat split; auto; try lra; apply M.
  - assert (g r == 0) as Z by lra; exists r; split.
    + apply in_flat_map; exists (r, s); split; [exact I|].
      unfold emit, side_of; apply sign_on in Z; apply sign_negative in S.
      rewrite Z, S; now left.
    + exists r, s, 0; repeat split; auto; try lra; apply at_start.
Qed.

Lemma part_has_entry : exists y, In y part_corners /\ entry y.
Proof.
  destruct some_above as (u & U & Gu), some_below as (w & W & Gw).
  destruct (round_from w W) as (l & A & B).
  destruct (comes_back l w u ltac:(lra) (A u U) Gu) as (r & s & I & R & S).
  apply B in I.
  destruct (Qlt_le_dec (g r) 0) as [L | L].
  - destruct (meet_at r s (or_intror (conj L S))) as (t & T & M & Z).
    exists (meet r s); split.
    + apply in_flat_map; exists (r, s); split; [exact I|].
      unfold emit, side_of; apply sign_negative in L; apply sign_positive in S.
      rewrite L, S; now left.
    + exists r, s, t; repeat split; auto; try lra; apply M.
  - assert (g r == 0) as Z by lra; exists r; split.
    + apply in_flat_map; exists (r, s); split; [exact I|].
      unfold emit, side_of; apply sign_on in Z; apply sign_positive in S.
      rewrite Z, S; now left.
    + exists r, s, 0; repeat split; auto; try lra; apply at_start.
Qed.

(** What an edge of the part is: a positive share of an edge of the polygon, or
    of the plane. *)
Lemma part_edge : forall a b, In (a, b) (round part_corners) ->
  exists c, 0 < c /\
  ((exists r s, edge r s /\ forall v, area plane a b v == c * area plane r s v)
   \/ forall v, value_at plane v == 0 -> area plane a b v == c * g v).
Proof.
  intros a b I; destruct (part_linked a b I) as [P | [X Y]].
  - destruct P as (r & s & t & u & E & _ & L & _ & A & B).
    exists (u - t); split; [lra|]; left; exists r, s; split; [exact E|].
    now apply at_area.
  - destruct (cut_edge a b X Y) as (c & C & H); exists c; auto.
Qed.

(** What the polygon has of the plane: the segment from exit to entry. *)
Lemma from_exit_to_entry : forall x y r, exit x -> entry y ->
  value_at plane r == 0 -> g r == 0 ->
  (forall p q, edge p q -> 0 <= area plane p q r) ->
  exists t, 0 <= t <= 1 /\ at_ t x y r.
Proof.
  intros x y r X Y R Gr N; destruct (cut_edge x y X Y) as (c & C & H).
  destruct X as (r1 & s1 & t1 & E1 & R1 & S1 & T1 & A1 & Gx).
  destruct Y as (r2 & s2 & t2 & E2 & R2 & S2 & T2 & A2 & Gy).
  destruct (edge_planar r1 s1 E1) as [_ P1].
  destruct (edge_planar r2 s2 E2) as [_ P2].
  pose proof (at_planar r1 s1 t1 x E1 A1) as Px.
  pose proof (at_planar r2 s2 t2 y E2 A2) as Py.
  pose proof (H r R) as Hr; rewrite Gr in Hr.
  assert (0 < area plane x s1 y) as L.
  { assert (area plane x s1 y == - area plane x y s1) as -> by (expand; ring).
    rewrite (H s1 P1); nra. }
  assert (0 <= area plane x s1 r) as M.
  { assert (area plane x s1 r == (1 - t1) * area plane r1 s1 r) as ->.
    { apply (at_area plane r1 s1); [exact A1 | apply at_end]. }
    specialize (N r1 s1 E1); nra. }
  set (t := area plane x s1 r / area plane x s1 y).
  assert (area plane x s1 r == t * area plane x s1 y) as T.
  { unfold t; field; lra. }
  assert (forall k, value_at k r ==
          value_at k x + (value_at k y - value_at k x) * t) as K.
  { intros k; pose proof (four_points plane k x s1 y r plane_ok Px P1 Py R)
      as F.
    assert (area plane x r y == - area plane x y r) as F1 by (expand; ring).
    assert (area plane r s1 y == area plane x s1 y - area plane x r y -
            area plane x s1 r) as F2 by (expand; ring).
    rewrite F2, F1, Hr, T in F.
    apply Qmult_inj_r with (area plane x s1 y); [lra|]; lra. }
  exists t; repeat split.
  - unfold t; apply Qle_shift_div_l; [exact L | lra].
  - assert (0 <= area plane y s2 r) as O.
    { assert (area plane y s2 r == (1 - t2) * area plane r2 s2 r) as ->.
      { apply (at_area plane r2 s2); [exact A2 | apply at_end]. }
      specialize (N r2 s2 E2); nra. }
    unfold area in O; rewrite K in O; fold (area plane y s2 x) in O.
    fold (area plane y s2 y) in O.
    assert (area plane y s2 x == area plane x y s2) as O1.
    { symmetry; apply area_turn. }
    assert (area plane y s2 y == 0) as O2 by (expand; ring).
    rewrite O1, O2, (H s2 P2) in O.
    assert (0 < c * g s2) by nra.
    destruct (Qlt_le_dec 1 t); [exfalso; nra | assumption].
  - specialize (K {| pa := 1; pb := 0; pc := 0; pd := 0 |}).
    unfold value_at in K; simpl in K; lra.
  - specialize (K {| pa := 0; pb := 1; pc := 0; pd := 0 |}).
    unfold value_at in K; simpl in K; lra.
  - specialize (K {| pa := 0; pb := 0; pc := 1; pd := 0 |}).
    unfold value_at in K; simpl in K; lra.
Qed.

Lemma section : forall r, value_at plane r == 0 -> g r == 0 ->
  (forall p q, edge p q -> 0 <= area plane p q r) ->
  exists x y t, In x part_corners /\ In y part_corners /\ 0 <= t <= 1 /\
  at_ t x y r.
Proof.
  intros r R Gr N; destruct part_has_exit as (x & Ix & X).
  destruct part_has_entry as (y & Iy & Y).
  destruct (from_exit_to_entry x y r X Y R Gr N) as (t & T & A).
  exists x, y, t; auto.
Qed.

Lemma exit_is_in : forall x, exit x -> value_at plane x == 0 /\ g x == 0 /\
  forall p q, edge p q -> 0 <= area plane p q x.
Proof.
  intros x (r & s & t & E & _ & _ & T & A & Z); split; [|split]; auto.
  - exact (at_planar r s t x E A).
  - intros p q F; apply (at_edge_area p q r s t); auto; lra.
Qed.

Lemma entry_is_in : forall x, entry x -> value_at plane x == 0 /\ g x == 0 /\
  forall p q, edge p q -> 0 <= area plane p q x.
Proof.
  intros x (r & s & t & E & _ & _ & T & A & Z); split; [|split]; auto.
  - exact (at_planar r s t x E A).
  - intros p q F; apply (at_edge_area p q r s t); auto; lra.
Qed.

Lemma exit_is_no_entry : forall x y, exit x -> entry y -> ~ same x y.
Proof.
  intros x y X Y (A & B & C); destruct (cut_edge x y X Y) as (c & P & H).
  destruct some_above as (u & U & Gu).
  pose proof (H u (corner_planar u U)) as Hu.
  assert (area plane x y u == 0) as Z by (expand; rewrite A, B, C; ring).
  nra.
Qed.

(** However often the boundary leaves, it leaves in one point ... *)
Theorem one_exit : forall x x', exit x -> exit x' -> same x x'.
Proof.
  intros x x' X X'; destruct part_has_entry as (y & _ & Y).
  destruct (exit_is_in x X) as (P & Z & N).
  destruct (exit_is_in x' X') as (P' & Z' & N').
  destruct (from_exit_to_entry x y x' X Y P' Z' N') as (t & T & A & B & C).
  destruct (from_exit_to_entry x' y x X' Y P Z N) as (u & U & D & E & F).
  destruct (Qlt_le_dec 0 t) as [L | L].
  - exfalso; apply (exit_is_no_entry x y X Y).
    assert (0 < t + u * (1 - t)) as K by nra.
    assert (forall k l m, m == k + (l - k) * t -> k == m + (l - m) * u ->
            k == l) as H.
    { intros k l m M O; rewrite M in O.
      assert ((l - k) * (t + u * (1 - t)) == 0) as W by lra.
      apply Qmult_integral in W; destruct W; lra. }
    unfold same; repeat split; eapply H; eauto.
  - assert (t == 0) as O by lra; unfold same; rewrite A, B, C, O.
    repeat split; ring.
Qed.

(** ... and comes back in one. *)
Theorem one_entry : forall y y', entry y -> entry y' -> same y y'.
Proof.
  intros y y' Y Y'; destruct part_has_exit as (x & _ & X).
  destruct (entry_is_in y Y) as (P & Z & N).
  destruct (entry_is_in y' Y') as (P' & Z' & N').
  destruct (from_exit_to_entry x y y' X Y P' Z' N') as (t & T & A & B & C).
  destruct (from_exit_to_entry x y' y X Y' P Z N) as (u & U & D & E & F).
  destruct (Qlt_le_dec t 1) as [L | L].
  - exfalso; apply (exit_is_no_entry x y X Y).
    assert (0 < 1 - t * u) as K by nra.
    assert (forall k l m, m == k + (l - k) * t -> l == k + (m - k) * u ->
            k == l) as H.
    { intros k l m M O; rewrite M in O.
      assert ((l - k) * (1 - t * u) == 0) as W by lra.
      apply Qmult_integral in W; destruct W; lra. }
    unfold same; repeat split; eapply H; eauto.
  - assert (t == 1) as O by lra; unfold same; rewrite A, B, C, O.
    repeat split; ring.
Qed.

(** The corners of a part that are on the plane are the ends of the cut. *)
Lemma part_corner_on_plane : forall v, In v part_corners -> g v == 0 ->
  exit v \/ entry v.
Proof.
  intros v I O; apply in_flat_map in I; destruct I as ((p, q) & E & I).
  assert (0 <= g p -> g q < 0 -> forall t, 0 <= t < 1 -> at_ t p q v ->
          exit v) as X.
  { intros P L t T A; exists p, q, t; auto 10. }
  assert (g p <= 0 -> 0 < g q -> forall t, 0 <= t < 1 -> at_ t p q v ->
          entry v) as Y.
  { intros P L t T A; exists p, q, t; auto 10. }
  unfold emit, side_of in I.
  assert (v = p -> g p == 0 -> ~ g q == 0 -> exit v \/ entry v) as A.
  { intros -> Z N; destruct (Q_dec (g q) 0) as [[L | L] | L]; [left | right |].
    - apply (X ltac:(lra) L 0); [lra | apply at_start].
    - apply (Y ltac:(lra) L 0); [lra | apply at_start].
    - contradiction. }
  assert (0 < g p /\ g q < 0 \/ g p < 0 /\ 0 < g q -> v = meet p q ->
          exit v \/ entry v) as B.
  { intros S ->; destruct (meet_at p q S) as (t & T & M & _).
    destruct S as [[S1 S2] | [S1 S2]]; [left | right].
    - apply (X ltac:(lra) S2 t); [lra | exact M].
    - apply (Y ltac:(lra) S2 t); [lra | exact M]. }
  destruct (sign_cases (g p)) as [[P L] | [[P L] | [P L]]]; rewrite P in I;
    destruct (sign_cases (g q)) as [[R M] | [[R M] | [R M]]]; rewrite R in I;
    simpl in I;
    repeat (destruct I as [I | I];
      [symmetry in I; (apply B; [tauto | exact I]) ||
                      (apply A; [exact I | lra | lra]) ||
                      (exfalso; subst v; lra) |]); destruct I.
Qed.

(** ** Once round *)

(** What is on an edge's line is that edge's point at some [u]. *)
Lemma on_line_at : forall r s v, edge r s -> value_at plane v == 0 ->
  area plane r s v == 0 -> exists u, at_ u r s v.
Proof.
  intros r s v E V Z; destruct (edge_planar r s E) as [R S].
  destruct (point_beside plane r s plane_ok R S (ok_apart _ _ ok r s E))
    as (z & Pz & N).
  set (d := area plane r s z) in *.
  exists (area plane r v z / d).
  assert (forall k, value_at k v ==
          value_at k r + (value_at k s - value_at k r) *
          (area plane r v z / d)) as K.
  { intros k; pose proof (four_points plane k r s z v plane_ok R S Pz V) as F.
    fold d in F; rewrite Z in F.
    assert (area plane v s z == d - area plane r v z - area plane r s v) as G
      by (unfold d; expand; ring).
    rewrite G, Z in F; apply Qmult_inj_r with d; [exact N|].
    setoid_replace ((value_at k r + (value_at k s - value_at k r) *
      (area plane r v z / d)) * d) with (d * value_at k r +
      (value_at k s - value_at k r) * area plane r v z) by (field; exact N).
    lra. }
  repeat split.
  - specialize (K {| pa := 1; pb := 0; pc := 0; pd := 0 |}).
    unfold value_at in K; simpl in K; lra.
  - specialize (K {| pa := 0; pb := 1; pc := 0; pd := 0 |}).
    unfold value_at in K; simpl in K; lra.
  - specialize (K {| pa := 0; pb := 0; pc := 1; pd := 0 |}).
    unfold value_at in K; simpl in K; lra.
Qed.

(** As long as there are corners ahead on an edge's line, the boundary goes on
    along it, and forward. *)
Lemma goes_on : forall k r s v m v', edge r s ->
  value_at k s < value_at k r ->
  In v corners -> In m corners -> edge v v' ->
  area plane r s v == 0 -> area plane r s m == 0 ->
  value_at k m < value_at k v ->
  area plane r s v' == 0 /\ value_at k v' < value_at k v.
Proof.
  intros k r s v m v' E D V M F Av Am L.
  destruct (round_ends _ _ _ F) as [_ V'].
  destruct (on_line_at r s v E (corner_planar v V) Av) as (t & T).
  destruct (on_line_at r s m E (corner_planar m M) Am) as (u & U).
  pose proof (at_value t r s v k T) as Gv.
  pose proof (at_value u r s m k U) as Gm.
  assert (t < u) as Less.
  { destruct (Qlt_le_dec t u); [assumption | exfalso; nra]. }
  assert (area plane r s v' == 0) as Z.
  { pose proof (edge_area r s v' E V') as N.
    pose proof (edge_area v v' m F M) as B.
    assert (area plane v v' m == - ((u - t) * area plane r s v')) as A.
    { rewrite <- (at_area plane r s t u v m T U v'); expand; ring. }
    rewrite A in B; nra. }
  split; [exact Z|].
  destruct (on_line_at r s v' E (corner_planar v' V') Z) as (w & W).
  pose proof (at_value w r s v' k W) as Gv'.
  destruct (Qlt_le_dec t w) as [Lw | Lw]; [nra | exfalso].
  apply (not_flat v v' F); intros z I.
  pose proof (edge_area v v' z F I) as N.
  rewrite (at_area plane r s t w v v' T W z) in *.
  pose proof (edge_area r s z E I); nra.
Qed.

(** How many corners are further down. *)
Definition below (k : Plane) (v : Point) : nat :=
  length (filter (fun c => negb (Qle_bool (value_at k v) (value_at k c)))
            corners).

Lemma below_less : forall k v w, In w corners ->
  value_at k w < value_at k v -> (below k w < below k v)%nat.
Proof.
  intros k v w I L; unfold below; set (f := value_at k) in *.
  assert (forall c d, negb (Qle_bool (f c) (f d)) = true <-> f d < f c) as B.
  { intros c d; rewrite negb_true_iff, <- not_true_iff_false, Qle_bool_iff.
    split; intros H; [now apply Qnot_le_lt | now apply Qlt_not_le]. }
  assert (forall l, (length (filter (fun c => negb (Qle_bool (f w) (f c))) l) <=
    length (filter (fun c => negb (Qle_bool (f v) (f c))) l))%nat) as Le.
  { induction l as [|c l IH]; [constructor|]; simpl.
    destruct (negb (Qle_bool (f w) (f c))) eqn:X;
      destruct (negb (Qle_bool (f v) (f c))) eqn:Y; simpl; try lia.
    apply B in X; rewrite <- not_true_iff_false, B in Y; exfalso; lra. }
  revert I; generalize corners.
  intros all; induction all as [|c l IH]; intros I; [destruct I|]; simpl.
  destruct I as [-> | I].
  - replace (negb (Qle_bool (f w) (f w))) with false.
    + replace (negb (Qle_bool (f v) (f w))) with true
        by (symmetry; now apply B).
      simpl; specialize (Le l); lia.
    + symmetry; apply not_true_iff_false; rewrite B; apply Qlt_irrefl.
  - specialize (IH I); destruct (negb (Qle_bool (f w) (f c))) eqn:X;
      destruct (negb (Qle_bool (f v) (f c))) eqn:Y; simpl; try lia.
    apply B in X; rewrite <- not_true_iff_false, B in Y; exfalso; lra.
Qed.

(** No two edges that go down one line overlap: the boundary would go along
    both to the same corner, and a corner has one edge that comes to it. *)
Lemma no_overlap : forall k r s, edge r s -> value_at k s < value_at k r ->
  forall n p a p' a', (below k a + below k a' < n)%nat ->
  edge p a -> edge p' a' -> area plane r s a == 0 -> area plane r s a' == 0 ->
  value_at k a < value_at k p' -> value_at k a' < value_at k p -> a = a'.
Proof.
  intros k r s E D; induction n as [|n IH]; intros p a p' a' N F F' A A' L L';
    [lia|].
  destruct (round_ends _ _ _ F) as [_ I], (round_ends _ _ _ F') as [_ I'].
  destruct (on_line_at r s a E (corner_planar a I) A) as (t & T).
  destruct (on_line_at r s a' E (corner_planar a' I') A') as (u & U).
  pose proof (at_value t r s a k T) as Ka.
  pose proof (at_value u r s a' k U) as Ka'.
  destruct (Q_dec (value_at k a) (value_at k a')) as [[K | K] | K].
  - destruct (round_leaves corners a' I') as (b & B).
    destruct (goes_on k r s a' a b E D I' I B A' A K) as [Ab Kb].
    destruct (round_ends _ _ _ B) as [_ Ib].
    assert (a = b) as S.
    { apply (IH p a a' b); auto; [|lra].
      pose proof (below_less k a' b Ib Kb); lia. }
    subst b; assert (p = a') as P by
      exact (one_before corners p a' a (ok_once _ _ ok) F B).
    subst p; exfalso; lra.
  - destruct (round_leaves corners a I) as (b & B).
    destruct (goes_on k r s a a' b E D I I' B A A' K) as [Ab Kb].
    destruct (round_ends _ _ _ B) as [_ Ib].
    assert (b = a') as S.
    { apply (IH a b p' a'); auto; [|lra].
      pose proof (below_less k a b Ib Kb); lia. }
    subst b; assert (a = p') as P by
      exact (one_before corners a p' a' (ok_once _ _ ok) B F').
    subst p'; exfalso; lra.
  - apply (visits_once_in corners a a' (ok_once _ _ ok) I I').
    assert (t == u) as Tu by nra.
    destruct T as (X & Y & Z), U as (X' & Y' & Z').
    repeat split; [rewrite X, X' | rewrite Y, Y' | rewrite Z, Z']; rewrite Tu;
      reflexivity.
Qed.

(** Where an edge leaves. *)
Lemma edge_leaves : forall k r s, 0 <= value_at k r -> value_at k s < 0 ->
  exists x t, 0 <= t < 1 /\ at_ t r s x /\ value_at k x == 0 /\
  (value_at k r == 0 -> t == 0).
Proof.
  intros k r s R S; set (t := value_at k r / (value_at k r - value_at k s)).
  set (x := {| px := px r + (px s - px r) * t; py := py r + (py s - py r) * t;
               pz := pz r + (pz s - pz r) * t |}).
  assert (at_ t r s x) as A by (repeat split; reflexivity).
  exists x, t; split; [|split; [exact A | split]].
  - unfold t; split; [apply Qle_shift_div_l | apply Qlt_shift_div_r]; lra.
  - rewrite (at_value t r s x k A); unfold t; field; lra.
  - intros O; unfold t; rewrite O; unfold Qdiv; ring.
Qed.

Lemma at_zero : forall t r s x, t == 0 -> at_ t r s x -> same x r.
Proof.
  intros t r s x Z (A & B & C); unfold same; rewrite A, B, C, Z.
  repeat split; ring.
Qed.

(** Edges that leave a side of a plane in one point are one edge. *)
Lemma one_edge : forall k,
  (forall r s r' s' t t' x x', edge r s -> edge r' s' ->
     0 <= value_at k r -> value_at k s < 0 -> 0 <= value_at k r' ->
     value_at k s' < 0 -> 0 <= t < 1 -> 0 <= t' < 1 ->
     at_ t r s x -> at_ t' r' s' x' -> value_at k x == 0 ->
     value_at k x' == 0 -> same x x') ->
  forall r s r' s', edge r s -> 0 <= value_at k r -> value_at k s < 0 ->
  edge r' s' -> 0 <= value_at k r' -> value_at k s' < 0 -> (r, s) = (r', s').
Proof.
  intros k One r s r' s' E R S E' R' S'.
  destruct (edge_leaves k r s R S) as (x & t & T & A & Z & O).
  destruct (edge_leaves k r' s' R' S') as (x' & t' & T' & A' & Z' & O').
  assert (same x x') as K by
    exact (One r s r' s' t t' x x' E E' R S R' S' T T' A A' Z Z').
  destruct (round_ends _ _ _ E) as [Ir Is], (round_ends _ _ _ E') as [Ir' Is'].
  pose proof (edge_area r s r' E Ir') as Nr.
  pose proof (edge_area r s s' E Is') as Ns.
  assert (area plane r s x' == 0) as C.
  { unfold area; rewrite <- (same_value x x' _ K), (at_value t r s x _ A).
    expand; ring. }
  unfold area in C, Nr, Ns; rewrite (at_value t' r' s' x' _ A') in C.
  fold (area plane r s r') (area plane r s s') in *.
  assert (area plane r s r' == 0) as Cr by nra.
  assert (area plane r s s' == 0 -> (r, s) = (r', s')) as Go.
  { intros Cs; assert (s = s') as <-.
    { apply (no_overlap k r s E ltac:(lra)
        (1 + below k s + below k s')%nat r s r' s'); auto; lra || lia || idtac.
      expand; ring. }
    f_equal; exact (one_before corners r r' s (ok_once _ _ ok) E E'). }
  destruct (Qlt_le_dec 0 t') as [L | L]; [apply Go; nra|].
  assert (same x' r') as Sx.
  { apply (at_zero t' r' s'); [lra | exact A']. }
  pose proof (same_value x' r' k Sx) as Kr'; rewrite Z' in Kr'.
  destruct (Qlt_le_dec 0 (value_at k r)) as [P | P].
  - apply Go; apply (goes_on k r s r' s s' E ltac:(lra) Ir' Is E' Cr); [|lra].
    expand; ring.
  - assert (same x r) as Sr.
    { apply (at_zero t r s); [apply O; lra | exact A]. }
    assert (r = r') as ->.
    { apply (visits_once_in corners r r' (ok_once _ _ ok) Ir Ir').
      destruct Sr as (B1 & B2 & B3), K as (K1 & K2 & K3), Sx as (D1 & D2 & D3).
      unfold same; rewrite <- B1, <- B2, <- B3, K1, K2, K3; auto. }
    f_equal; exact (one_next corners r' s s' (ok_once _ _ ok) E E').
Qed.

(** The boundary leaves a side of the plane along one edge only ... *)
Theorem one_exit_edge : forall r s r' s', edge r s -> 0 <= g r -> g s < 0 ->
  edge r' s' -> 0 <= g r' -> g s' < 0 -> (r, s) = (r', s').
Proof.
  apply (one_edge h); intros r s r' s' t t' x x' E E' R S R' S' T T' A A' Z Z'.
  apply one_exit; [exists r, s, t | exists r', s', t']; auto 10.
Qed.

(** ... and comes back along one. *)
Theorem one_entry_edge : forall r s r' s', edge r s -> g r <= 0 -> 0 < g s ->
  edge r' s' -> g r' <= 0 -> 0 < g s' -> (r, s) = (r', s').
Proof.
  assert (forall v, value_at (reversed h) v == - g v) as V
    by (intros; apply value_at_reversed).
  intros r s r' s' E R S E' R' S'.
  apply (one_edge (reversed h)); auto; rewrite ?V; try lra.
  clear r s r' s' E R S E' R' S'.
  intros r s r' s' t t' x x' E E' R S R' S' T T' A A' Z Z'.
  rewrite value_at_reversed in *.
  apply one_entry; [exists r, s, t | exists r', s', t']; repeat split; auto;
    try lra; apply A || apply A'.
Qed.

(** What an edge puts into the part: its first corner, or where it passes. *)
Lemma emitted : forall p q v, edge p q -> In v (emit (p, q)) ->
  v = p /\ 0 < g p \/
  g v == 0 /\ (0 <= g p /\ g q < 0 /\ exit v \/ g p <= 0 /\ 0 < g q /\ entry v).
Proof.
  intros p q v E I; pose proof (no_edge_in_plane p q E) as Flat.
  assert (0 < g p /\ g q < 0 \/ g p < 0 /\ 0 < g q -> v = meet p q ->
          g v == 0 /\ (0 <= g p /\ g q < 0 /\ exit v \/
                       g p <= 0 /\ 0 < g q /\ entry v)) as M.
  { intros S ->; destruct (meet_at p q S) as (t & T & A & Z).
    split; [exact Z|]; destruct S as [[S1 S2] | [S1 S2]]; [left | right];
      (split; [lra|]; split; [lra|]; exists p, q, t; repeat split; auto;
       try lra; apply A). }
  unfold emit, side_of in I.
  destruct (sign_cases (g p)) as [[P L] | [[P L] | [P L]]]; rewrite P in I;
    destruct (sign_cases (g q)) as [[R K] | [[R K] | [R K]]]; rewrite R in I;
    simpl in I.
  - destruct I.
  - destruct I.
  - destruct I as [<- | []]; right; apply M; auto.
  - destruct I as [<- | []]; right; split; [exact L|]; left; split; [lra|].
    split; [exact K|]; exists p, q, 0; repeat split; auto; try lra;
      apply at_start.
  - destruct I.
  - destruct I as [<- | []]; right; split; [exact L|]; right; split; [lra|].
    split; [exact K|]; exists p, q, 0; repeat split; auto; try lra;
      apply at_start.
  - destruct I as [<- | [<- | []]]; [left; auto | right; apply M; auto].
  - destruct I as [<- | []]; left; auto.
  - destruct I as [<- | []]; left; auto.
Qed.

Lemma visits_once_flat : forall (A : Type) (f : A -> list Point) l,
  (forall a, In a l -> visits_once (f a)) ->
  ForallOrdPairs (fun a b => forall v w, In v (f a) -> In w (f b) ->
    ~ same v w) l -> visits_once (flat_map f l).
Proof.
  intros A f l; induction l as [|a l IH]; intros H O; [constructor|]; simpl.
  inversion O as [|? ? Oa Ol]; subst; rewrite Forall_forall in Oa.
  assert (visits_once (flat_map f l)) as Hl.
  { apply IH; [intros b B; apply H; now right | exact Ol]. }
  assert (forall v w, In v (f a) -> In w (flat_map f l) -> ~ same v w) as D.
  { intros v w V W; apply in_flat_map in W; destruct W as (b & B & W).
    exact (Oa b B v w V W). }
  specialize (H a (or_introl eq_refl)); revert H D; generalize (f a).
  induction l0 as [|v m IHm]; intros H D; [exact Hl|]; simpl.
  inversion H as [|? ? Hv Hm]; subst; constructor.
  - apply Forall_forall; intros w W; apply in_app_or in W.
    rewrite Forall_forall in Hv; destruct W as [W | W]; [now apply Hv|].
    apply D; [now left | exact W].
  - apply IHm; [exact Hm | intros w z W; apply D; now right].
Qed.

(** So no two corners of the part are one point, however far apart. *)
Lemma part_visits_once : visits_once part_corners.
Proof.
  apply visits_once_flat.
  - intros (p, q) E; unfold emit, side_of.
    destruct (sign_cases (g p)) as [[-> L] | [[-> L] | [-> L]]];
      destruct (sign_cases (g q)) as [[-> K] | [[-> K] | [-> K]]];
      repeat constructor.
    intros S; destruct (meet_at p q (or_introl (conj L K))) as (t & _ & _ & Z).
    rewrite <- (same_value _ _ h S) in Z; lra.
  - assert (ForallOrdPairs (fun a b => ~ same (fst a) (fst b)) (round corners))
      as D.
    { pose proof (ok_once _ _ ok) as O; unfold visits_once in O.
      rewrite <- round_starts in O; revert O; generalize (round corners).
      induction l as [|a l IH]; intros O; simpl in O; [constructor|].
      inversion O as [|? ? Oa Ol]; subst; constructor; auto.
      rewrite Forall_forall in *; intros b B; apply Oa, in_map, B. }
    assert (forall a b, edge (fst a) (snd a) -> edge (fst b) (snd b) ->
            ~ same (fst a) (fst b) -> forall v w, In v (emit a) ->
            In w (emit b) -> ~ same v w) as Apart.
    { intros (p, q) (p', q') E E' N v w V W S; simpl in *.
      pose proof (same_value v w h S) as Gvw.
      assert ((p, q) <> (p', q')) as Ne.
      { intros Eq; injection Eq as -> ->; apply N; unfold same.
        repeat split; reflexivity. }
      destruct (emitted p q v E V) as [[-> P] | [Z P]];
        destruct (emitted p' q' w E' W) as [[-> P'] | [Z' P']];
        [contradiction | lra | lra |].
      destruct P as [(P & Q & X) | (P & Q & Y)];
        destruct P' as [(P' & Q' & X') | (P' & Q' & Y')].
      - apply Ne; now apply one_exit_edge.
      - exact (exit_is_no_entry v w X Y' S).
      - exact (exit_is_no_entry w v X' Y (same_sym _ _ S)).
      - apply Ne; now apply one_entry_edge. }
    assert (forall l, incl l (round corners) ->
      ForallOrdPairs (fun a b => ~ same (fst a) (fst b)) l ->
      ForallOrdPairs (fun a b => forall v w, In v (emit a) -> In w (emit b) ->
        ~ same v w) l) as K; [|now apply K; [apply incl_refl|]].
    induction l as [|a l IH]; intros I O; [constructor|].
    inversion O as [|? ? Oa Ol]; subst; constructor.
    + rewrite Forall_forall in *; intros b B v w.
      apply Apart; [| |now apply Oa].
      * rewrite <- surjective_pairing; apply I; now left.
      * rewrite <- surjective_pairing; apply I; now right.
    + apply IH; [intros b B; apply I; now right | exact Ol].
Qed.

(** ** The part is a convex polygon, in the sense of S1.3 *)

Theorem part_is_convex : polygon_ok plane part_corners.
Proof.
  assert (forall v, In v part_corners -> value_at plane v == 0) as Planar.
  { intros v I; destruct (part_corner v I) as (_ & p & q & t & E & _ & A & _).
    exact (at_planar p q t v E A). }
  assert (forall p q, In (p, q) (round part_corners) -> ~ same p q) as Apart.
  { intros a b I (X & Y & Z).
    assert (forall v, area plane a b v == 0) as N.
    { intros v; expand; rewrite X, Y, Z; ring. }
    destruct (part_edge a b I) as (c & C & [(r & s & E & H) | H]).
    - apply (not_flat r s E); intros v V; pose proof (H v) as Hv.
      rewrite N in Hv; assert (c * area plane r s v == 0) as D by lra.
      apply Qmult_integral in D; destruct D; [lra | assumption].
    - destruct some_above as (u & U & Gu); pose proof (H u (corner_planar u U))
        as Hu; rewrite N in Hu; nra. }
  constructor; auto using part_visits_once.
  - intros a b v I V; destruct (part_corner v V) as
      (G & p & q & t & E & T & A & _).
    fold (area plane a b v).
    destruct (part_edge a b I) as (c & C & [(r & s & F & H) | H]).
    + rewrite H; pose proof (at_edge_area r s p q t v F E T A); nra.
    + rewrite H by auto; nra.
  - destruct some_above as (u & U & Gu); pose proof (part_keeps u U Gu) as I.
    destruct part_has_exit as (x & Ix & X), part_has_entry as (y & Iy & Y).
    destruct (cut_edge x y X Y) as (c & C & H).
    pose proof (H u (corner_planar u U)) as Hu.
    destruct (round_leaves _ u I) as [b J].
    destruct (round_ends _ _ _ J) as [_ Ib].
    assert (forall v, In v part_corners -> 0 <= area plane u b v) as N.
    { intros v V; destruct (part_corner v V) as (G & p & q & t & E & T & A & _).
      destruct (part_edge u b J) as (c' & C' & [(r & s & F & H') | H']).
      - rewrite H'; pose proof (at_edge_area r s p q t v F E T A); nra.
      - rewrite H' by auto; nra. }
    destruct (Qlt_le_dec 0 (area plane u b x)) as [Lx | Lx];
      [exists u, b, x; auto|].
    destruct (Qlt_le_dec 0 (area plane u b y)) as [Ly | Ly];
      [exists u, b, y; auto|].
    exfalso; pose proof (N x Ix); pose proof (N y Iy).
    destruct (point_beside plane u b plane_ok (Planar u I) (Planar b Ib)
                (Apart u b J)) as (z & Z & K).
    pose proof (four_points plane (edge_plane plane u b) x y u z plane_ok
      (Planar x Ix) (Planar y Iy) (Planar u I) Z) as D.
    fold (area plane u b z) (area plane u b x) (area plane u b y)
      (area plane u b u) in D.
    assert (area plane u b u == 0) as Uu by (expand; ring).
    assert (area plane u b x == 0) as Ux by lra.
    assert (area plane u b y == 0) as Uy by lra.
    rewrite Uu, Ux, Uy in D.
    assert (area plane x y u * area plane u b z == 0) as D' by lra.
    apply Qmult_integral in D'; destruct D'; [|contradiction].
    assert (0 < c * g u) by nra; lra.
Qed.


End Cut.

(** ** The parts that the walk of [Split.v] gives *)

(** The plane, its positive side being the part's. *)
Definition toward (side : Side) (h : Plane) : Plane :=
  match side with kNegative => reversed h | _ => h end.

Definition crossing_point (h : Plane) (p q : Point) : Point :=
  Split.meet p (value_at h p) q (value_at h q).

Lemma crossing_at : forall side h p q,
  0 < value_at (toward side h) p /\ value_at (toward side h) q < 0 \/
  value_at (toward side h) p < 0 /\ 0 < value_at (toward side h) q ->
  exists t, 0 < t < 1 /\ at_ t p q (crossing_point h p q) /\
  value_at (toward side h) (crossing_point h p q) == 0.
Proof.
  intros side h p q S.
  assert (value_at h p < 0 /\ 0 < value_at h q \/
          0 < value_at h p /\ value_at h q < 0) as S'.
  { destruct side; simpl in S; rewrite ?value_at_reversed in S; lra. }
  destruct (Split.meet_is_inside_the_edge p (value_at h p) q (value_at h q) S')
    as [T _].
  exists (value_at h p / (value_at h p - value_at h q)); split; [exact T|].
  split; [unfold at_, crossing_point, Split.meet; simpl; repeat split;
          reflexivity|].
  assert (value_at h (crossing_point h p q) == 0) as Z.
  { apply Split.meet_is_on_the_plane; intros E; lra. }
  destruct side; simpl; rewrite ?value_at_reversed, Z; reflexivity.
Qed.

Definition corners_of (side : Side) (h : Plane) (corners : list Point) :=
  part_corners (toward side h) corners (crossing_point h).

Section Walk.

Variables (f : Split.Fragment) (h : Plane) (side : Side).
Hypothesis a_side : side <> kOn.

Local Notation n := (length (Split.vertices f)).

Lemma step_emits : forall k p q,
  nth k (Split.vertices f) Split.origin = p ->
  nth (Split.next n k) (Split.vertices f) Split.origin = q ->
  map (Split.corner_of f h)
    (filter (fun s => side_eqb (Split.part s) side)
       (Split.step k (side_of h p) (side_of h q))) =
  emit (toward side h) (crossing_point h) (p, q).
Proof.
  intros k p q P R; unfold emit.
  assert (forall v, side_of (toward side h) v =
          match side with kNegative => opposite (side_of h v)
                        | _ => side_of h v end) as S.
  { intros v; destruct side; simpl; auto using side_of_reversed. }
  rewrite !S; unfold crossing_point, Split.corner_of.
  destruct side; try easy; destruct (side_of h p) eqn:Sp;
    destruct (side_of h q) eqn:Sq; simpl; rewrite ?P, ?R; reflexivity.
Qed.

Lemma walk_from_emits : forall first l before,
  Split.vertices f = before ++ l -> l <> [] ->
  nth 0 (Split.vertices f) Split.origin = first ->
  map (Split.corner_of f h)
    (filter (fun s => side_eqb (Split.part s) side)
       (Split.walk_from (side_of h first) (length before)
          (map (side_of h) l))) =
  flat_map (emit (toward side h) (crossing_point h)) (along (l ++ [first])).
Proof.
  intros first; induction l as [|p l IH]; intros before V N F; [easy|].
  assert (nth (length before) (Split.vertices f) Split.origin = p) as P.
  { rewrite V, app_nth2, Nat.sub_diag by lia; reflexivity. }
  assert (n = length before + S (length l))%nat as L.
  { rewrite V, app_length; reflexivity. }
  destruct l as [|q l].
  - simpl map; simpl Split.walk_from; simpl along.
    rewrite (step_emits _ p first P).
    + simpl; now rewrite app_nil_r.
    + unfold Split.next; simpl in L.
      replace (S (length before) =? n)%nat with true; [exact F|].
      symmetry; apply Nat.eqb_eq; lia.
  - change (map (side_of h) (p :: q :: l)) with
      (side_of h p :: side_of h q :: map (side_of h) l).
    change (Split.walk_from (side_of h first) (length before)
      (side_of h p :: side_of h q :: map (side_of h) l)) with
      (Split.step (length before) (side_of h p) (side_of h q) ++
       Split.walk_from (side_of h first) (S (length before))
         (map (side_of h) (q :: l))).
    change (along ((p :: q :: l) ++ [first])) with
      ((p, q) :: along ((q :: l) ++ [first])).
    rewrite filter_app, map_app; simpl flat_map at 1.
    rewrite (step_emits _ p q P).
    + f_equal; replace (S (length before)) with (length (before ++ [p]))
        by (rewrite app_length; simpl; lia).
      apply IH; [now rewrite <- app_assoc | easy | exact F].
    + unfold Split.next; simpl in L.
      replace (S (length before) =? n)%nat with false
        by (symmetry; apply Nat.eqb_neq; lia).
      replace (S (length before)) with (length (before ++ [p]))
        by (rewrite app_length; simpl; lia).
      rewrite V; change (p :: q :: l) with ([p] ++ q :: l).
      rewrite app_assoc, app_nth2, Nat.sub_diag by lia; reflexivity.
Qed.

Theorem walk_emits : forall splitter,
  Split.vertices (Split.part_of side f h splitter) =
  corners_of side h (Split.vertices f).
Proof.
  intros splitter; unfold Split.part_of, corners_of, part_corners; simpl.
  unfold Split.walk, Split.sides_of.
  destruct (Split.vertices f) as [|p l] eqn:V; [reflexivity|].
  pose proof (walk_from_emits p (p :: l) [] V) as W; simpl length in W.
  unfold round; rewrite <- W; [reflexivity | easy | now rewrite V].
Qed.

End Walk.

Section Parts.

Variables (plane h : Plane) (f : Split.Fragment).
Hypothesis plane_ok : not_zero plane.
Hypothesis ok : polygon_ok plane (Split.vertices f).
Hypothesis spanning : Split.relation f h = rSpanning.

Lemma spans : forall side, side <> kOn ->
  (exists v, In v (Split.vertices f) /\ 0 < value_at (toward side h) v) /\
  (exists v, In v (Split.vertices f) /\ value_at (toward side h) v < 0).
Proof.
  intros side N.
  destruct (Split.relation_is_the_table (Split.sides_of f h))
    as (_ & _ & _ & T).
  apply T in spanning; destruct spanning as [P R].
  unfold Split.sides_of in P, R; apply in_map_iff in P, R.
  destruct P as (u & U & Iu), R as (w & W & Iw).
  apply sign_positive in U; apply sign_negative in W.
  destruct side; try easy; simpl; split;
    (exists u; split; [exact Iu | rewrite ?value_at_reversed; lra]) ||
    (exists w; split; [exact Iw | rewrite ?value_at_reversed; lra]).
Qed.

(** S2.L6: both parts are convex polygons, in the sense of S1.3. *)
Theorem parts_are_convex_polygons : forall side splitter, side <> kOn ->
  polygon_ok plane (Split.vertices (Split.part_of side f h splitter)).
Proof.
  intros side splitter N; rewrite walk_emits by exact N.
  destruct (spans side N) as [A B].
  apply part_is_convex; auto using crossing_at.
Qed.

(** S2.3: no two corners of a part are one point, however far apart. *)
Theorem parts_visit_once : forall side splitter, side <> kOn ->
  visits_once (Split.vertices (Split.part_of side f h splitter)).
Proof.
  intros side splitter N.
  exact (ok_once _ _ (parts_are_convex_polygons side splitter N)).
Qed.

(** S2.3: on the splitter a part has the corners of one edge, two points. *)
Theorem parts_meet_the_splitter_in_two_points : forall side splitter,
  side <> kOn -> exists x y, ~ same x y /\ forall v,
  In v (Split.vertices (Split.part_of side f h splitter)) ->
  value_at h v == 0 -> same x v \/ same y v.
Proof.
  intros side splitter N; rewrite walk_emits by exact N.
  destruct (spans side N) as [A B].
  pose proof (crossing_at side h) as M.
  destruct (part_has_exit (toward side h) (Split.vertices f) A B
    (crossing_point h) M) as (x & _ & X).
  destruct (part_has_entry (toward side h) (Split.vertices f) A B
    (crossing_point h) M) as (y & _ & Y).
  exists x, y; split.
  - exact (exit_is_no_entry plane (toward side h) (Split.vertices f) plane_ok ok
      A B x y X Y).
  - intros v I Z.
    assert (value_at (toward side h) v == 0) as Z'.
    { destruct side; simpl; rewrite ?value_at_reversed, Z; reflexivity. }
    destruct (part_corner_on_plane (toward side h) (Split.vertices f)
      (crossing_point h) M v I Z') as [V | V]; [left | right].
    + exact (one_exit plane (toward side h) (Split.vertices f) plane_ok ok A B
        (crossing_point h) M x v X V).
    + exact (one_entry plane (toward side h) (Split.vertices f) plane_ok ok A B
        (crossing_point h) M y v Y V).
Qed.

(** The boundary leaves a side in one segment: both parts have all that the
    polygon has of the plane. *)
Theorem parts_share_all_of_the_section : forall splitter,
  Split.parts_share_the_section f h splitter.
Proof.
  intros splitter r I Z.
  assert (value_at plane r == 0 /\ forall p q,
          In (p, q) (round (Split.vertices f)) -> 0 <= area plane p q r)
    as [P E].
  { apply (I (fun r => value_at plane r == 0 /\ forall p q,
          In (p, q) (round (Split.vertices f)) -> 0 <= area plane p q r)).
    - intros p q t [Pp Ep] [Pq Eq] (u & U & A).
      assert (at_ u p q t) as A' by exact A; split.
      + rewrite (at_value u p q t plane A'), Pp, Pq; ring.
      + intros a b J; unfold area; rewrite (at_value u p q t _ A').
        specialize (Ep a b J); specialize (Eq a b J); unfold area in *; nra.
    - intros v V; split; [now apply (ok_planar _ _ ok)|].
      intros p q J; now apply (ok_convex _ _ ok). }
  assert (forall side, side <> kOn -> Split.inside
    (Split.vertices (Split.part_of side f h splitter)) r) as K;
    [|split; now apply K].
  intros side N; rewrite walk_emits by exact N.
  destruct (spans side N) as [A B].
  destruct (section plane (toward side h) (Split.vertices f) plane_ok ok A B
    (crossing_point h) (crossing_at side h) r P) as (x & y & t & X & Y & T & R).
  - destruct side; simpl; rewrite ?value_at_reversed, Z; reflexivity.
  - exact E.
  - apply (Split.polygons_are_convex _ x y r);
      try now apply Split.vertex_is_inside.
    exists t; split; [exact T | exact R].
Qed.

(** S2.L5: so the parts are the polygon's intersections with the closed
    half-spaces, and make it up. *)
Theorem parts_are_the_shares : forall splitter r,
  (Split.inside (Split.vertices (fst (Split.split f h splitter))) r <->
   Split.inside (Split.vertices f) r /\ 0 <= value_at h r) /\
  (Split.inside (Split.vertices (snd (Split.split f h splitter))) r <->
   Split.inside (Split.vertices f) r /\ value_at h r <= 0).
Proof.
  intros; apply Split.parts_are_the_intersections,
    parts_share_all_of_the_section.
Qed.

End Parts.
