(** * S5.4, S5.6: channels of colours.

    Read beside [blended] in ref/src/oracle/painter.cpp, the rounding in
    ref/src/shade.cpp, and [blended] in fast/src/raster/drawer.cpp. *)

From Coq Require Import ZArith QArith Qround Lia Lqa.
Open Scope Q_scope.

(** ** S5.4: rounded half up *)

Definition rounded (value : Q) : Z := Qfloor (value + (1 # 2)).

(** The nearest integer, of two the greater. *)
Theorem rounded_is_nearest : forall value,
  inject_Z (rounded value) - (1 # 2) <= value <
  inject_Z (rounded value) + (1 # 2).
Proof.
  intros value; unfold rounded.
  pose proof (Qfloor_le (value + (1 # 2))) as L.
  pose proof (Qlt_floor (value + (1 # 2))) as U.
  rewrite inject_Z_plus in U; change (inject_Z 1) with 1 in U.
  split; lra.
Qed.

Lemma rounded_unique : forall value n,
  inject_Z n - (1 # 2) <= value < inject_Z n + (1 # 2) -> rounded value = n.
Proof.
  intros value n [L U]; pose proof (rounded_is_nearest value) as [L' U'].
  assert (inject_Z (rounded value) < inject_Z (n + 1)) as A
    by (rewrite inject_Z_plus; change (inject_Z 1) with 1; lra).
  assert (inject_Z n < inject_Z (rounded value + 1)) as B
    by (rewrite inject_Z_plus; change (inject_Z 1) with 1; lra).
  rewrite <- Zlt_Qlt in A, B; lia.
Qed.

(** ** S5.6 *)

(** alpha / 255 of [over] and the rest of [under]. *)
Definition mixed (over under alpha : Z) : Q :=
  let share := inject_Z alpha / 255 in
  share * inject_Z over + (1 - share) * inject_Z under.

Definition blended (over under alpha : Z) : Z :=
  rounded (mixed over under alpha).

(** The same in integers, as the fast library has it. *)
Definition fast_blended (over under alpha : Z) : Z :=
  ((2 * (alpha * over + (255 - alpha) * under) + 255) / 510)%Z.

Theorem fast_blended_is_blended : forall over under alpha,
  fast_blended over under alpha = blended over under alpha.
Proof.
  intros over under alpha; unfold fast_blended, blended, rounded.
  set (n := (2 * (alpha * over + (255 - alpha) * under) + 255)%Z).
  change (n / 510)%Z with (Qfloor (n # 510)); apply Qfloor_comp.
  rewrite Qmake_Qdiv; unfold n, mixed; unfold Zminus.
  repeat first [rewrite inject_Z_plus | rewrite inject_Z_mult |
                rewrite inject_Z_opp].
  change (inject_Z 2) with 2; change (inject_Z 255) with 255.
  change (inject_Z 510) with 510; field.
Qed.

Theorem opaque_hides : forall over under, blended over under 255 = over.
Proof.
  intros over under; apply rounded_unique; unfold mixed.
  change (inject_Z 255) with 255.
  setoid_replace (255 / 255) with 1 by reflexivity; split; lra.
Qed.

Theorem transparent_shows : forall over under, blended over under 0 = under.
Proof.
  intros over under; apply rounded_unique; unfold mixed.
  setoid_replace (inject_Z 0 / 255) with 0 by reflexivity; split; lra.
Qed.

(** A channel stays between the two: no step leaves 0 to 255. *)
Theorem blended_between : forall over under alpha low high,
  (0 <= alpha <= 255)%Z ->
  (low <= over <= high)%Z -> (low <= under <= high)%Z ->
  (low <= blended over under alpha <= high)%Z.
Proof.
  intros over under alpha low high A O U.
  rewrite <- fast_blended_is_blended; unfold fast_blended; split.
  - apply Z.div_le_lower_bound; [lia|]; nia.
  - apply Z.lt_succ_r, Z.div_lt_upper_bound; [lia|]; nia.
Qed.
