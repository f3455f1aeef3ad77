(** * S3.4: candidates are drawn without repetition.

    Read beside [candidates_of] in ref/src/splitter.cpp. A list of numbers is
    a function from places to numbers; [draw j count] is draw number j. *)

From Coq Require Import Arith Lia List.
Import ListNotations.

Definition exchanged (a : nat -> nat) (i r : nat) : nat -> nat :=
  fun n => if n =? i then a r else if n =? r then a i else a n.

Section Draw.

(** [mix(K + 3 + j) mod count], whatever [mix] is. *)
Variable draw : nat -> nat -> nat.
Hypothesis draw_less : forall j count, 0 < count -> draw j count < count.

(** [rest] exchanges from place [j] on, in a list of [m]. *)
Fixpoint shuffled (m j rest : nat) (a : nat -> nat) : nat -> nat :=
  match rest with
  | O => a
  | S rest' =>
    let r := j + draw j (m - j) in
    shuffled m (S j) rest' (exchanged a j r)
  end.

Definition candidates_of (m k : nat) : list nat :=
  if k <? m then map (shuffled m 0 k (fun n => n)) (seq 0 k) else seq 0 m.

(** Every place below [m] has a number below [m], and no two the same. *)
Definition arranged (m : nat) (a : nat -> nat) : Prop :=
  (forall n, n < m -> a n < m) /\
  forall n p, n < m -> p < m -> a n = a p -> n = p.

Lemma exchanged_arranged : forall m a i r, arranged m a -> i < m -> r < m ->
  arranged m (exchanged a i r).
Proof.
  intros m a i r [B D] I R; split; unfold exchanged.
  - intros n N; destruct (n =? i); [auto|]; destruct (n =? r); auto.
  - intros n p N P.
    destruct (Nat.eqb_spec n i), (Nat.eqb_spec p i),
      (Nat.eqb_spec n r), (Nat.eqb_spec p r); subst; intros E; auto;
      apply D in E; auto; congruence.
Qed.

Lemma shuffled_arranged : forall m rest j a, arranged m a -> j + rest <= m ->
  arranged m (shuffled m j rest a).
Proof.
  intros m; induction rest as [|rest IH]; intros j a A L; simpl; [exact A|].
  apply IH; [|lia]; apply exchanged_arranged; [exact A | lia |].
  assert (draw j (m - j) < m - j) by (apply draw_less; lia); lia.
Qed.

(** As many as were asked for, or all; all of the list, and none twice. *)
Theorem candidates_are_distinct : forall m k,
  NoDup (candidates_of m k) /\ length (candidates_of m k) = min k m /\
  forall c, In c (candidates_of m k) -> c < m.
Proof.
  intros m k; unfold candidates_of; destruct (Nat.ltb_spec k m) as [K | K].
  - assert (arranged m (shuffled m 0 k (fun n => n))) as [B D].
    { apply shuffled_arranged; [|lia]; split; auto. }
    split; [|split].
    + apply NoDup_nth with (d := m); rewrite map_length, seq_length.
      intros n p N P.
      rewrite !(nth_indep _ m (shuffled m 0 k (fun n => n) 0))
        by (rewrite map_length, seq_length; assumption).
      rewrite !map_nth, !seq_nth by assumption; simpl.
      apply D; lia.
    + rewrite map_length, seq_length; lia.
    + intros c I; apply in_map_iff in I; destruct I as (n & <- & N).
      apply in_seq in N; apply B; lia.
  - split; [apply seq_NoDup | split].
    + rewrite seq_length; lia.
    + intros c I; apply in_seq in I; lia.
Qed.

End Draw.
