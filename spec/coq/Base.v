(** * Words that all theories share.

    Read beside [value_at] and [side_of] in ref/src/predicate.cpp. Points and
    planes have rational coordinates, as in [ref/]; nothing here or in any other
    theory rests on an axiom. *)

From Coq Require Import QArith Lqa List.
Import ListNotations.
Open Scope Q_scope.

(** S1.5: which side of a plane something is on. *)
Inductive Side := kNegative | kOn | kPositive.

(** S2.1: how a fragment lies against a plane. *)
Inductive Relation := rPositive | rNegative | rCoincident | rSpanning.

(** The sign of a number, as a side. *)
Definition sign (value : Q) : Side :=
  match value ?= 0 with
  | Lt => kNegative
  | Eq => kOn
  | Gt => kPositive
  end.

Definition opposite (side : Side) : Side :=
  match side with
  | kNegative => kPositive
  | kOn => kOn
  | kPositive => kNegative
  end.

Definition side_eqb (s t : Side) : bool :=
  match s, t with
  | kNegative, kNegative | kOn, kOn | kPositive, kPositive => true
  | _, _ => false
  end.

Lemma side_eqb_eq : forall s t, side_eqb s t = true <-> s = t.
Proof. destruct s, t; simpl; split; congruence. Qed.

Lemma sign_positive : forall value, sign value = kPositive <-> 0 < value.
Proof.
  intros value; unfold sign; rewrite Qgt_alt.
  destruct (value ?= 0); split; congruence.
Qed.

Lemma sign_negative : forall value, sign value = kNegative <-> value < 0.
Proof.
  intros value; unfold sign; rewrite Qlt_alt.
  destruct (value ?= 0); split; congruence.
Qed.

Lemma sign_on : forall value, sign value = kOn <-> value == 0.
Proof.
  intros value; unfold sign; rewrite Qeq_alt.
  destruct (value ?= 0); split; congruence.
Qed.

(** One of three, each with what it means. *)
Lemma sign_cases : forall value,
  sign value = kNegative /\ value < 0 \/
  sign value = kOn /\ value == 0 \/
  sign value = kPositive /\ 0 < value.
Proof.
  intros value; destruct (sign value) eqn:E.
  - left; split; [reflexivity | now apply sign_negative].
  - right; left; split; [reflexivity | now apply sign_on].
  - right; right; split; [reflexivity | now apply sign_positive].
Qed.

Global Instance sign_proper : Proper (Qeq ==> eq) sign.
Proof. intros p q E; unfold sign; now rewrite E. Qed.

Lemma sign_opposite : forall value, sign (- value) = opposite (sign value).
Proof.
  intros value.
  destruct (sign_cases value) as [[E H] | [[E H] | [E H]]]; rewrite E; simpl.
  - apply sign_positive; lra.
  - apply sign_on; lra.
  - apply sign_negative; lra.
Qed.

(** S1: points and planes. *)
Record Point := { px : Q; py : Q; pz : Q }.
Record Plane := { pa : Q; pb : Q; pc : Q; pd : Q }.

Definition value_at (plane : Plane) (p : Point) : Q :=
  pa plane * px p + pb plane * py p + pc plane * pz p + pd plane.

Definition side_of (plane : Plane) (p : Point) : Side :=
  sign (value_at plane p).

(** The same plane with its sides exchanged. *)
Definition reversed (plane : Plane) : Plane :=
  {| pa := - pa plane; pb := - pb plane;
     pc := - pc plane; pd := - pd plane |}.

Lemma value_at_reversed : forall plane p,
  value_at (reversed plane) p == - value_at plane p.
Proof. intros; unfold value_at, reversed; simpl; ring. Qed.

Lemma side_of_reversed : forall plane p,
  side_of (reversed plane) p = opposite (side_of plane p).
Proof.
  intros; unfold side_of; rewrite value_at_reversed; apply sign_opposite.
Qed.
