(** * S4.7, S4.8: the eight merge cases, and the merge.

    The program is that of [ref/src/screen.cpp]; what is proven of it is that
    it takes the object segments out of the unlit list, and nothing else. *)

From Coq Require Import ZArith List Lia Permutation.
Import ListNotations.
Open Scope Z_scope.

(** ** Definitions *)

(** S4.6: a closed run of pixels on a scan line, both ends in it. *)
Record Span := { first : Z; last : Z }.

Inductive MergeCase := k1 | k2 | k3 | k4 | k5 | k6 | k7 | k8.

(** S4.7: the conditions, as the table has them. *)
Definition condition (k : MergeCase) (object unlit : Span) : Prop :=
  let I := first object in
  let J := last object in
  let Min := first unlit in
  let Max := last unlit in
  match k with
  | k1 => J < Min
  | k2 => I <= Min <= J /\ J < Max
  | k3 => Min < I /\ J < Max
  | k4 => I <= Min /\ J = Max
  | k5 => Min < I <= Max /\ J = Max
  | k6 => I <= Min /\ J > Max
  | k7 => Min < I <= Max /\ Max < J
  | k8 => I > Max
  end.

(** The case that relates the two segments. *)
Definition merge_case (object unlit : Span) : MergeCase :=
  if last object <? first unlit then k1 else
  if first object >? last unlit then k8 else
  let from_left := first object <=? first unlit in
  if last object <? last unlit then if from_left then k2 else k3 else
  if last object =? last unlit then if from_left then k4 else k5 else
  if from_left then k6 else k7.

(** What the loop works on: the segments not yet dealt with, the unlit
    segments already passed and what was painted (both last first), and the
    cases met (last first). *)
Record State := {
  objects : list Span;
  unlit : list Span;
  passed : list Span;
  lit : list Span;
  cases : list MergeCase
}.

(** S4.7: one step, F2B's Merge-segment. [I], [J] and [Min], [Max] are the
    ends of the current segments. In case 3 the new segment takes K's Max
    before that changes (E1). *)
Definition merge_segment (state : State) : State :=
  match objects state, unlit state with
  | object :: next_objects, k :: next_unlit =>
    let (I, J) := object in
    let (Min, Max) := k in
    let merged objects unlit passed lit :=
      {| objects := objects; unlit := unlit; passed := passed; lit := lit;
         cases := merge_case object k :: cases state |} in
    match merge_case object k with
    | k1 => (* the object precedes *)
      merged next_objects (k :: next_unlit) (passed state) (lit state)
    | k2 => (* it covers the left end *)
      merged next_objects ({| first := J + 1; last := Max |} :: next_unlit)
        (passed state)
        ({| first := Min; last := J |} :: lit state)
    | k3 => (* it lies strictly inside *)
      merged next_objects ({| first := J + 1; last := Max |} :: next_unlit)
        ({| first := Min; last := I - 1 |} :: passed state)
        (object :: lit state)
    | k4 => (* it covers all, and both end together *)
      merged next_objects next_unlit (passed state) (k :: lit state)
    | k5 => (* it covers the right end, and both end together *)
      merged next_objects next_unlit
        ({| first := Min; last := I - 1 |} :: passed state)
        ({| first := I; last := Max |} :: lit state)
    | k6 => (* it covers all, and goes on *)
      merged (object :: next_objects) next_unlit (passed state)
        (k :: lit state)
    | k7 => (* it covers the right end, and goes on *)
      merged (object :: next_objects) next_unlit
        ({| first := Min; last := I - 1 |} :: passed state)
        ({| first := I; last := Max |} :: lit state)
    | k8 => (* the unlit segment precedes *)
      merged (object :: next_objects) next_unlit (k :: passed state)
        (lit state)
    end
  | _, _ => state
  end.

(** Whether either list has ended. *)
Definition ended (state : State) : bool :=
  match objects state, unlit state with
  | _ :: _, _ :: _ => false
  | _, _ => true
  end.

(** F2B's Merge: steps until either list ends. [at_most] steps are always
    enough, as [merge_ends] says. *)
Fixpoint merge_lists (at_most : nat) (state : State) : State :=
  match at_most with
  | O => state
  | S fewer =>
    if ended state then state else merge_lists fewer (merge_segment state)
  end.

(** What became of a line: its newly lit pixels, and those still unlit. *)
Record Merged := { newly_lit : list Span; still_unlit : list Span }.

Definition begin_merge (objects unlit : list Span) : State :=
  {| objects := objects; unlit := unlit; passed := []; lit := [];
     cases := [] |}.

Definition run_merge (objects unlit : list Span) : State :=
  merge_lists (length objects + length unlit) (begin_merge objects unlit).

(** S4.8. *)
Definition merge (objects_ unlit_ : list Span) : Merged :=
  let state := run_merge objects_ unlit_ in
  {| newly_lit := rev (lit state);
     still_unlit := rev (passed state) ++ unlit state |}.

(** ** What the lists mean *)

Definition in_span (i : Z) (s : Span) : Prop := first s <= i <= last s.

(** Pixel [i] is in one of the segments. *)
Definition covered (i : Z) (l : list Span) : Prop := Exists (in_span i) l.

(** Sorted segments, none empty, the first not before [from], and each at
    least [gap] after the last pixel of the one before: with [gap] 1 they do
    not overlap, with [gap] 2 they are not adjacent either. *)
Fixpoint apart (gap from : Z) (l : list Span) : Prop :=
  match l with
  | [] => True
  | s :: rest =>
    from <= first s <= last s /\ apart gap (last s + gap) rest
  end.

(** What object segments have to be. *)
Definition sorted (l : list Span) : Prop := exists from, apart 1 from l.

(** What an unlit list is. *)
Definition separate (l : list Span) : Prop := exists from, apart 2 from l.

(** ** The cases *)

Ltac split_cases :=
  unfold merge_case, condition; simpl;
  repeat match goal with
  | |- context [if ?t then _ else _] => destruct t eqn:?
  end.

(** The function gives the case whose condition holds. *)
Theorem merge_case_condition : forall object k,
  first object <= last object -> first k <= last k ->
  condition (merge_case object k) object k.
Proof. intros [I J] [Min Max]; split_cases; intros; lia. Qed.

Theorem cases_exclusive : forall object k case other,
  first object <= last object -> first k <= last k ->
  condition case object k -> condition other object k -> case = other.
Proof.
  intros [I J] [Min Max] case other; unfold condition; simpl; intros.
  destruct case, other; try reflexivity; exfalso; lia.
Qed.

Theorem cases_exhaustive : forall object k,
  first object <= last object -> first k <= last k ->
  exists! case, condition case object k.
Proof.
  intros object k Ho Hk; exists (merge_case object k); split.
  - now apply merge_case_condition.
  - intros other H; apply (cases_exclusive object k); auto.
    now apply merge_case_condition.
Qed.

(** ** Steps *)

Definition left_over (state : State) : nat :=
  (length (objects state) + length (unlit state))%nat.

Lemma merge_segment_drops : forall state,
  ended state = false ->
  (left_over (merge_segment state) < left_over state)%nat.
Proof.
  intros [o k p l cs]; unfold ended, left_over, merge_segment; simpl.
  destruct o as [|[I J] o], k as [|[Min Max] k]; simpl; try discriminate.
  intros _; destruct merge_case; simpl; lia.
Qed.

(** Every step drops a segment from one of the lists; so the merge ends. *)
Theorem merge_ends : forall at_most state,
  (left_over state <= at_most)%nat ->
  ended (merge_lists at_most state) = true.
Proof.
  induction at_most as [|n IH]; intros state H; simpl.
  - destruct state as [o k p l cs]; unfold left_over in H; simpl in H.
    destruct o, k; simpl in H; try lia; reflexivity.
  - destruct (ended state) eqn:E; [exact E|].
    apply IH; pose proof (merge_segment_drops state E); lia.
Qed.

Lemma merge_lists_steps : forall at_most state,
  (length (cases (merge_lists at_most state)) + left_over
     (merge_lists at_most state) <=
   length (cases state) + left_over state)%nat.
Proof.
  induction at_most as [|n IH]; intros state; simpl; [lia|].
  destruct (ended state) eqn:E; [lia|].
  specialize (IH (merge_segment state)).
  pose proof (merge_segment_drops state E) as D.
  assert (length (cases (merge_segment state)) = S (length (cases state))) as C.
  { destruct state as [o k p l cs]; unfold ended in E; simpl in E.
    unfold merge_segment; simpl.
    destruct o as [|[I J] o], k as [|[Min Max] k]; try discriminate.
    destruct merge_case; reflexivity. }
  lia.
Qed.

(** The steps are no more than the object segments, the unlit segments, and
    one. *)
Theorem merge_steps : forall objects_ unlit_,
  (length (cases (run_merge objects_ unlit_)) <=
   length objects_ + length unlit_ + 1)%nat.
Proof.
  intros o k; unfold run_merge.
  pose proof (merge_lists_steps (length o + length k) (begin_merge o k)) as H.
  unfold begin_merge, left_over in *; simpl in *; lia.
Qed.

(** More steps than are needed change nothing. *)
Lemma merge_lists_enough : forall n m state,
  (left_over state <= n)%nat -> (n <= m)%nat ->
  merge_lists m state = merge_lists n state.
Proof.
  induction n as [|n IH]; intros m state H L.
  - destruct state as [o k p l cs]; unfold left_over in H; simpl in H.
    destruct o, k; simpl in H; try lia; destruct m; reflexivity.
  - destruct m as [|m]; [lia|]; simpl.
    destruct (ended state) eqn:E; [reflexivity|].
    apply IH; [|lia]. pose proof (merge_segment_drops state E); lia.
Qed.

(** ** Pixels *)

Lemma covered_nil : forall i, covered i [] <-> False.
Proof. intros i; split; [intros H; inversion H | tauto]. Qed.

Lemma covered_cons : forall i s l,
  covered i (s :: l) <-> first s <= i <= last s \/ covered i l.
Proof.
  intros i s l; unfold covered; split; intros H.
  - inversion H; subst; auto.
  - destruct H; [now apply Exists_cons_hd | now apply Exists_cons_tl].
Qed.

Lemma covered_app : forall i l m,
  covered i (l ++ m) <-> covered i l \/ covered i m.
Proof. intros; unfold covered; apply Exists_app. Qed.

Lemma covered_rev : forall i l, covered i (rev l) <-> covered i l.
Proof. intros; unfold covered; split; apply Exists_rev || intros H.
  - rewrite <- (rev_involutive l); now apply Exists_rev.
Qed.

Lemma covered_dec : forall i l, covered i l \/ ~ covered i l.
Proof.
  intros i l; induction l as [|s l [H | H]].
  - right; rewrite covered_nil; tauto.
  - left; rewrite covered_cons; tauto.
  - rewrite covered_cons.
    destruct (Z_le_dec (first s) i), (Z_le_dec i (last s)); tauto.
Qed.

(** So a question about pixels becomes one about numbers. *)
Lemma covered_known : forall i l,
  (covered i l <-> True) \/ (covered i l <-> False).
Proof. intros i l; destruct (covered_dec i l); tauto. Qed.

Lemma apart_weaker : forall gap from from' l,
  from' <= from -> apart gap from l -> apart gap from' l.
Proof. intros gap from from' [|s l]; simpl; [tauto | intuition lia]. Qed.

Ltac lower :=
  match goal with
  | A : apart ?gap ?from ?l |- apart ?gap ?from' ?l =>
    apply (apart_weaker gap from from' l); [lia | exact A]
  end.

Lemma apart_bound : forall gap l from i,
  0 <= gap -> apart gap from l -> covered i l -> from <= i.
Proof.
  intros gap; induction l as [|s l IH]; intros from i G A C.
  - now apply covered_nil in C.
  - destruct A as [A B]; apply covered_cons in C; destruct C as [C | C];
      [lia|].
    specialize (IH _ _ G B C); lia.
Qed.

Lemma apart_gap : forall gap gap' l from,
  gap' <= gap -> apart gap from l -> apart gap' from l.
Proof.
  intros gap gap'; induction l as [|s l IH]; intros from G; simpl; [tauto|].
  intros [A B]; split; [exact A|].
  eapply apart_weaker; [|apply IH; [exact G | exact B]]; lia.
Qed.

Lemma separate_sorted : forall l, separate l -> sorted l.
Proof.
  intros l [from A]; exists from; apply (apart_gap 2); [lia | exact A].
Qed.

(** ** What one step does: the rows of the table *)

(** What a step with one object segment against one unlit segment paints, and
    what it leaves of the unlit one. *)
Definition painted_by (object k : Span) : list Span :=
  lit (merge_segment (begin_merge [object] [k])).

Definition left_by (object k : Span) : list Span :=
  let state := merge_segment (begin_merge [object] [k]) in
  passed state ++ unlit state.

(** Every row lights the pixels that are in both segments. *)
Theorem step_paints_intersection : forall object k i,
  first object <= last object -> first k <= last k ->
  covered i (painted_by object k) <-> in_span i object /\ in_span i k.
Proof.
  intros object k i Ho Hk.
  pose proof (merge_case_condition object k Ho Hk) as C; revert C.
  unfold painted_by, merge_segment, in_span; destruct object as [I J], k as
    [Min Max]; simpl in *.
  destruct merge_case; simpl; rewrite ?covered_cons, ?covered_nil; simpl;
    lia.
Qed.

(** Every row leaves of the unlit segment what is not in the object. *)
Theorem step_leaves_difference : forall object k i,
  first object <= last object -> first k <= last k ->
  covered i (left_by object k) <-> in_span i k /\ ~ in_span i object.
Proof.
  intros object k i Ho Hk.
  pose proof (merge_case_condition object k Ho Hk) as C; revert C.
  unfold left_by, merge_segment, in_span; destruct object as [I J], k as
    [Min Max]; simpl in *.
  destruct merge_case; simpl; rewrite ?covered_cons, ?covered_nil; simpl;
    lia.
Qed.

(** No row leaves an empty segment, or paints one. *)
Theorem step_leaves_nothing_empty : forall object k,
  first object <= last object -> first k <= last k ->
  Forall (fun s => first s <= last s) (painted_by object k ++ left_by object k).
Proof.
  intros object k Ho Hk.
  pose proof (merge_case_condition object k Ho Hk) as C; revert C.
  unfold painted_by, left_by, merge_segment; destruct object as [I J], k as
    [Min Max]; simpl in *.
  destruct merge_case; simpl; intros C; repeat constructor; simpl; lia.
Qed.

(** ** The whole merge *)

(** What lies in the accumulators stays there, below what comes. *)
Lemma merge_lists_accumulates : forall n o k p l cs,
  let fresh := merge_lists n {| objects := o; unlit := k; passed := [];
                                lit := []; cases := [] |} in
  let full := merge_lists n {| objects := o; unlit := k; passed := p;
                               lit := l; cases := cs |} in
  lit full = lit fresh ++ l /\ passed full = passed fresh ++ p /\
  unlit full = unlit fresh.
Proof.
  induction n as [|n IH]; intros o k p l cs; simpl; [auto|].
  unfold ended; simpl.
  destruct o as [|[I J] o]; [simpl; auto|].
  destruct k as [|[Min Max] k]; [simpl; auto|].
  unfold merge_segment; simpl.
  destruct merge_case; simpl;
    match goal with
    | |- lit (merge_lists _ {| objects := ?o; unlit := ?k; passed := ?p;
                               lit := ?l; cases := ?cs |}) =
         lit (merge_lists _ {| objects := _; unlit := _; passed := ?p';
                               lit := ?l'; cases := ?cs' |}) ++ _ /\ _ =>
      destruct (IH o k p l cs) as (L & P & U);
      destruct (IH o k p' l' cs') as (L' & P' & U');
      rewrite L, P, U, L', P', U', <- ?app_assoc; auto
    end.
Qed.

Definition all_lit (state : State) := rev (lit state).
Definition all_unlit (state : State) := rev (passed state) ++ unlit state.

Definition run (n : nat) (o k : list Span) : State :=
  merge_lists n (begin_merge o k).

(** One step and then the rest, without accumulators. *)
Lemma run_step : forall n o k,
  ended (begin_merge o k) = false ->
  let next := merge_segment (begin_merge o k) in
  let rest := run n (objects next) (unlit next) in
  all_lit (run (S n) o k) = rev (lit next) ++ all_lit rest /\
  all_unlit (run (S n) o k) = rev (passed next) ++ all_unlit rest.
Proof.
  intros n o k E next rest; unfold run; simpl merge_lists.
  rewrite E; fold next.
  destruct (merge_lists_accumulates n (objects next) (unlit next)
              (passed next) (lit next) (cases next)) as (L & P & U).
  assert (next = {| objects := objects next; unlit := unlit next;
                    passed := passed next; lit := lit next;
                    cases := cases next |}) as D by now destruct next.
  rewrite <- D in L, P, U.
  unfold all_lit, all_unlit, rest, run, begin_merge.
  rewrite L, P, U, !rev_app_distr, app_assoc; auto.
Qed.

(** Everything about the merge, by induction on its steps. *)
Lemma run_correct : forall gap n o k from from',
  1 <= gap <= 2 ->
  (length o + length k <= n)%nat ->
  apart 1 from o -> apart gap from' k ->
  let state := run n o k in
  (forall i, covered i (all_lit state) <-> covered i o /\ covered i k) /\
  (forall i, covered i (all_unlit state) <-> covered i k /\ ~ covered i o) /\
  apart 1 from (all_lit state) /\ apart 1 from' (all_lit state) /\
  apart gap from' (all_unlit state).
Proof.
  intros gap n; induction n as [|n IH]; intros o k from from' G H A B; cbv zeta.
  { destruct o, k; simpl in H; try lia; unfold all_lit, all_unlit; simpl.
    repeat split; try tauto; intros; rewrite ?covered_nil in *; tauto. }
  destruct o as [|object o].
  { unfold all_lit, all_unlit; simpl.
    repeat split; try tauto; intros; rewrite ?covered_nil in *; tauto. }
  destruct k as [|s k].
  { unfold all_lit, all_unlit; simpl.
    repeat split; try tauto; intros; rewrite ?covered_nil in *; tauto. }
  destruct (run_step n (object :: o) (s :: k) eq_refl) as [L U].
  rewrite L, U; clear L U.
  destruct A as [A A'], B as [B B'].
  pose proof (merge_case_condition object s (proj2 A) (proj2 B)) as C; revert C.
  assert (forall i, covered i o -> last object + 1 <= i) as Bo.
  { intros i; apply (apart_bound 1); [lia | exact A']. }
  assert (forall i, covered i k -> last s + gap <= i) as Bk.
  { intros i; apply (apart_bound gap); [lia | exact B']. }
  destruct object as [I J], s as [Min Max]; simpl in A, B, A', B', Bo, Bk, H.
  unfold merge_segment, begin_merge; simpl.
  destruct merge_case; simpl; intros C.
  1: destruct (IH o ({| first := Min; last := Max |} :: k) (J + 1) from')
       as (P & R & S1 & S2 & S3).
  6: destruct (IH o ({| first := J + 1; last := Max |} :: k) (J + 1) (J + 1))
       as (P & R & S1 & S2 & S3).
  11: destruct (IH o ({| first := J + 1; last := Max |} :: k) (J + 1) (J + 1))
       as (P & R & S1 & S2 & S3).
  16: destruct (IH o k (J + 1) (Max + gap)) as (P & R & S1 & S2 & S3).
  21: destruct (IH o k (J + 1) (Max + gap)) as (P & R & S1 & S2 & S3).
  26: destruct (IH ({| first := I; last := J |} :: o) k from (Max + gap))
       as (P & R & S1 & S2 & S3).
  31: destruct (IH ({| first := I; last := J |} :: o) k from (Max + gap))
       as (P & R & S1 & S2 & S3).
  36: destruct (IH ({| first := I; last := J |} :: o) k from (Max + gap))
       as (P & R & S1 & S2 & S3).
  all: try (simpl; lia); try exact A'; try exact B'; try exact G.
  all: try (simpl; split; [lia | assumption]).
  all: split; [intros i | split; [intros i |]].
  (* What is sorted. *)
  all: try (simpl; repeat split; lia || lower; fail).
  (* Which pixels. *)
  all: simpl; rewrite ?covered_cons, ?P, ?R, ?covered_cons;
    specialize (Bo i); specialize (Bk i); simpl.
  all: destruct (covered_known i o) as [E | E];
    destruct (covered_known i k) as [F | F];
    try specialize (Bo (proj2 E Logic.I));
    try specialize (Bk (proj2 F Logic.I));
    rewrite E, ?F; clear - A B C G Bo Bk; lia.
Qed.

Lemma merge_run : forall o k,
  newly_lit (merge o k) = all_lit (run (length o + length k) o k) /\
  still_unlit (merge o k) = all_unlit (run (length o + length k) o k).
Proof. intros o k; split; reflexivity. Qed.

(** What a merge lights are the pixels that are object and unlit. *)
Theorem merge_lit : forall o k, sorted o -> sorted k ->
  forall i, covered i (newly_lit (merge o k)) <-> covered i o /\ covered i k.
Proof.
  intros o k [f A] [g B]; destruct (merge_run o k) as [E _]; rewrite E.
  apply (run_correct 1 _ o k f g); auto; lia.
Qed.

(** What it leaves unlit are the unlit pixels that are not object. *)
Theorem merge_unlit : forall o k, sorted o -> sorted k ->
  forall i,
  covered i (still_unlit (merge o k)) <-> covered i k /\ ~ covered i o.
Proof.
  intros o k [f A] [g B]; destruct (merge_run o k) as [_ E]; rewrite E.
  apply (run_correct 1 _ o k f g); auto; lia.
Qed.

(** The invariants are kept. *)
Theorem merge_sorted : forall o k, sorted o -> sorted k ->
  sorted (newly_lit (merge o k)) /\ sorted (still_unlit (merge o k)).
Proof.
  intros o k [f A] [g B]; destruct (merge_run o k) as [E F]; rewrite E, F.
  destruct (run_correct 1 (length o + length k) o k f g) as (_ & _ & C & _ & D);
    auto; try lia.
  split; [exists f | exists g]; assumption.
Qed.

Theorem merge_separate : forall o k, sorted o -> separate k ->
  separate (still_unlit (merge o k)).
Proof.
  intros o k [f A] [g B]; destruct (merge_run o k) as [_ E]; rewrite E.
  destruct (run_correct 2 (length o + length k) o k f g) as (_ & _ & _ & _ & D);
    auto; try lia.
  exists g; assumption.
Qed.

(** ** The unlit list is a normal form *)

Lemma apart_first : forall gap from s l i,
  0 <= gap -> apart gap from (s :: l) -> covered i (s :: l) -> first s <= i.
Proof.
  intros gap from s l i G [A B] C; apply covered_cons in C.
  destruct C as [C | C]; [lia|].
  pose proof (apart_bound gap l (last s + gap) i G B C); lia.
Qed.

Theorem normal_form : forall l m, separate l -> separate m ->
  (forall i, covered i l <-> covered i m) -> l = m.
Proof.
  induction l as [|s l IH]; intros m [f A] [g B] E.
  - destruct m as [|t m]; [reflexivity|].
    exfalso; apply (covered_nil (first t)), E, covered_cons.
    destruct B as [B _]; lia.
  - destruct m as [|t m].
    { exfalso; apply (covered_nil (first s)), E, covered_cons.
      destruct A as [A _]; lia. }
    pose proof (apart_bound 2 l (last s + 2)) as Ls.
    pose proof (apart_bound 2 m (last t + 2)) as Lt.
    assert (first s = first t) as F.
    { apply Z.le_antisymm.
      - apply (apart_first 2 f s l); [lia | exact A |].
        apply E, covered_cons; destruct B as [B _]; lia.
      - apply (apart_first 2 g t m); [lia | exact B |].
        apply E, covered_cons; destruct A as [A _]; lia. }
    destruct A as [A A'], B as [B B'].
    assert (last s = last t) as L.
    { destruct (Z.lt_trichotomy (last s) (last t)) as [C | [C | C]];
        [|exact C|]; exfalso.
      - assert (covered (last s + 1) (s :: l)) as H.
        { apply E, covered_cons; lia. }
        apply covered_cons in H; destruct H as [H | H]; [lia|].
        specialize (Ls (last s + 1) ltac:(lia) A' H); lia.
      - assert (covered (last t + 1) (t :: m)) as H.
        { apply E, covered_cons; lia. }
        apply covered_cons in H; destruct H as [H | H]; [lia|].
        specialize (Lt (last t + 1) ltac:(lia) B' H); lia. }
    f_equal; [destruct s, t; simpl in *; congruence|].
    apply IH; [exists (last s + 2); exact A' | exists (last t + 2); exact B' |].
    intros i; specialize (Ls i ltac:(lia) A'); specialize (Lt i ltac:(lia) B').
    specialize (E i); rewrite !covered_cons in E; split; intros H.
    + specialize (Ls H); assert (covered i m) by (destruct E as [E _];
        destruct E as [E | E]; [auto | lia | exact E]); assumption.
    + specialize (Lt H); assert (covered i l) by (destruct E as [_ E];
        destruct E as [E | E]; [auto | lia | exact E]); assumption.
Qed.

(** ** Many merges of one line *)

(** The unlit list of a line after all the object lists. *)
Definition merge_all (line : list (list Span)) (unlit : list Span) :=
  fold_left (fun k o => still_unlit (merge o k)) line unlit.

Lemma merge_all_separate : forall line k,
  Forall sorted line -> separate k -> separate (merge_all line k).
Proof.
  induction line as [|o line IH]; intros k A B; [exact B|].
  inversion A; subst; apply IH; [assumption|]; now apply merge_separate.
Qed.

(** A pixel is lit after all merges exactly if some object has it. *)
Theorem merge_all_unlit : forall line k,
  Forall sorted line -> separate k -> forall i,
  covered i (merge_all line k) <->
  covered i k /\ ~ Exists (covered i) line.
Proof.
  induction line as [|o line IH]; intros k A B i.
  - simpl; split; [intros C; split; [exact C | intros H; inversion H] | tauto].
  - inversion A as [|? ? A1 A2]; subst.
    change (merge_all (o :: line) k)
      with (merge_all line (still_unlit (merge o k))).
    rewrite (IH _ A2 (merge_separate o k A1 B)).
    rewrite (merge_unlit o k A1 (separate_sorted k B)).
    rewrite Exists_cons; tauto.
Qed.

(** In every order the same unlit segments are left. *)
Theorem merge_all_order : forall line line' k,
  Forall sorted line -> separate k -> Permutation line line' ->
  merge_all line k = merge_all line' k.
Proof.
  intros line line' k A B P.
  assert (Forall sorted line') as A'.
  { apply Forall_forall; intros o H; rewrite Forall_forall in A; apply A.
    now apply (Permutation_in o (Permutation_sym P)). }
  apply normal_form; try now apply merge_all_separate.
  intros i; rewrite !merge_all_unlit by assumption.
  assert (Exists (covered i) line <-> Exists (covered i) line') as E; [|tauto].
  rewrite !Exists_exists; split; intros (o & H & C); exists o; split; auto.
  - now apply (Permutation_in o P).
  - now apply (Permutation_in o (Permutation_sym P)).
Qed.

(** ** A line of the image *)

Definition whole_line (width : Z) : list Span :=
  [{| first := 0; last := width - 1 |}].

Lemma whole_line_separate : forall width, 0 < width ->
  separate (whole_line width).
Proof. intros w H; exists 0; simpl; lia. Qed.

(** A line of the item image, and how segments are painted on it. *)
Definition ItemLine := Z -> Z.

Definition inside (i : Z) (s : Span) : bool :=
  (first s <=? i) && (i <=? last s).

Definition paint (item : Z) (segments : list Span) (line : ItemLine) :
  ItemLine :=
  fun i => if existsb (inside i) segments then item else line i.

(** What is displayed of one item on the line: its object segments. *)
Definition Displayed := (Z * list Span)%type.

(** [render]: front to back, each merged with what is unlit. *)
Fixpoint render_line (front_to_back : list Displayed) (unlit : list Span)
  (line : ItemLine) : ItemLine :=
  match front_to_back with
  | [] => line
  | (item, o) :: rest =>
    let merged := merge o unlit in
    render_line rest (still_unlit merged) (paint item (newly_lit merged) line)
  end.

(** [paint] of [painter.cpp]: back to front, each painted over the others. *)
Definition paint_line (back_to_front : list Displayed) (line : ItemLine) :
  ItemLine :=
  fold_left (fun l shown => paint (fst shown) (snd shown) l) back_to_front line.

Lemma inside_covered : forall i l,
  existsb (inside i) l = true <-> covered i l.
Proof.
  intros i l; unfold covered; rewrite existsb_exists, Exists_exists.
  unfold inside, in_span; split; intros (s & H & C); exists s; split; auto; lia.
Qed.

Lemma paint_line_app : forall l m line i,
  paint_line (l ++ m) line i = paint_line m (paint_line l line) i.
Proof. intros; unfold paint_line; now rewrite fold_left_app. Qed.

Lemma render_line_keeps_lit : forall shown k line i,
  Forall (fun s => sorted (snd s)) shown -> sorted k -> ~ covered i k ->
  render_line shown k line i = line i.
Proof.
  induction shown as [|[item o] shown IH]; intros k line i A B C; simpl;
    [reflexivity|].
  inversion A as [|? ? A1 A2]; subst; simpl in A1.
  assert (~ covered i (still_unlit (merge o k))) as N.
  { rewrite (merge_unlit o k A1 B); tauto. }
  rewrite (IH _ _ i A2 (proj2 (merge_sorted o k A1 B)) N).
  unfold paint; destruct existsb eqn:E; [|reflexivity].
  apply inside_covered in E; rewrite (merge_lit o k A1 B) in E; tauto.
Qed.

(** Painting at one pixel sees nothing but that pixel. *)
Lemma paint_line_local : forall shown l m i,
  l i = m i -> paint_line shown l i = paint_line shown m i.
Proof.
  induction shown as [|s shown IH]; intros l m i H; [exact H|].
  unfold paint_line; simpl; apply IH; unfold paint; now rewrite H.
Qed.

(** Where a pixel is unlit, merging front to back shows what painting in
    reverse does. *)
Theorem render_line_is_paint_line : forall shown k line i,
  Forall (fun s => sorted (snd s)) shown -> sorted k -> covered i k ->
  render_line shown k line i = paint_line (rev shown) line i.
Proof.
  induction shown as [|[item o] shown IH]; intros k line i A B C;
    [reflexivity|].
  inversion A as [|? ? A1 A2]; subst; simpl in A1.
  pose proof (merge_sorted o k A1 B) as [_ B'].
  simpl rev; rewrite paint_line_app; simpl render_line.
  unfold paint_line at 1; simpl fold_left; unfold paint at 2.
  destruct (existsb (inside i) o) eqn:E.
  - apply inside_covered in E.
    assert (~ covered i (still_unlit (merge o k))) as N.
    { rewrite (merge_unlit o k A1 B); tauto. }
    rewrite (render_line_keeps_lit _ _ _ i A2 B' N); unfold paint.
    replace (existsb _ _) with true; [reflexivity|].
    symmetry; apply inside_covered; rewrite (merge_lit o k A1 B); tauto.
  - assert (~ covered i o) as N by (rewrite <- inside_covered, E; congruence).
    assert (covered i (still_unlit (merge o k))) as C'.
    { rewrite (merge_unlit o k A1 B); tauto. }
    rewrite (IH _ _ i A2 B' C'); apply paint_line_local.
    destruct (existsb (inside i) (newly_lit (merge o k))) eqn:F.
    + apply inside_covered in F; rewrite (merge_lit o k A1 B) in F; tauto.
    + unfold paint; change (rev (lit (run_merge o k)))
        with (newly_lit (merge o k)); now rewrite F.
Qed.

(** The whole line: the image is the same from end to end. *)
Theorem line_front_to_back_is_painter : forall shown width line i,
  Forall (fun s => sorted (snd s)) shown -> 0 <= i < width ->
  render_line shown (whole_line width) line i =
  paint_line (rev shown) line i.
Proof.
  intros shown width line i A H.
  apply render_line_is_paint_line; [exact A | exists 0; simpl; lia |].
  apply covered_cons; simpl; lia.
Qed.

(** Stopping when nothing is unlit changes nothing. *)
Theorem full_line_stays : forall shown line i,
  Forall (fun s => sorted (snd s)) shown ->
  render_line shown [] line i = line i.
Proof.
  intros shown line i A; apply render_line_keeps_lit;
    [exact A | exists 0; simpl; auto | now rewrite covered_nil].
Qed.

(** A line's unlit list is empty exactly when no pixel is unlit. *)
Theorem full_when_all_lit : forall k, sorted k ->
  (k = [] <-> forall i, ~ covered i k).
Proof.
  intros k [f A]; split; [intros E i; subst; rewrite covered_nil; tauto|].
  destruct k as [|s k]; [reflexivity | intros H; exfalso].
  apply (H (first s)), covered_cons; destruct A as [A _]; lia.
Qed.
