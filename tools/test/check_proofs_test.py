#!/usr/bin/env python3
"""Plants faults in a small theory, and sees check_proofs.py find each."""

import pathlib
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import check_proofs  # noqa: E402

SOUND = """(** Axiom. Nothing (* Admitted. *) here counts: it is a comment. *)
Section Numbers.
Variable n : nat.
Theorem same : n = n.
Proof. reflexivity. Qed.
End Numbers.
"""
LIST = "same | Planted.v | S1.1 | Every number is itself.\n"

# What is planted, the theory, the list, and what the check says of it.
PLANTED = [
    ("nothing", SOUND, LIST, None),
    ("an axiom", SOUND + "Axiom false : False.\n", LIST, "forbidden"),
    ("a parameter", SOUND + "Local Parameter k : nat.\n", LIST, "forbidden"),
    ("an unfinished proof",
     SOUND + "Lemma no : 0 = 1.\nProof.\nAdmitted.\n", LIST, "forbidden"),
    ("no universes", SOUND + "Unset Universe Checking.\n", LIST, "forbidden"),
    ("a variable", SOUND + "Variable k : nat.\n", LIST, "outside a section"),
    ("a hypothesis in a module",
     SOUND + "Module M.\nHypothesis h : False.\nEnd M.\n", LIST,
     "outside a section"),
    ("another's axiom",
     "From Coq Require Import FunctionalExtensionality.\n"
     "Theorem same (f g : nat -> nat) : (forall n, f n = g n) -> f = g.\n"
     "Proof. apply functional_extensionality. Qed.\n", LIST,
     "functional_extensionality_dep"),
    ("a false proof",
     SOUND + "Lemma no : 0 = 1.\nProof. reflexivity. Qed.\n", LIST, "make: "),
    ("a name that is nowhere", SOUND, LIST.replace("same", "some"),
     "does not prove some"),
    ("a name twice", SOUND, LIST + LIST, "listed twice"),
    ("a line without a clause", SOUND, LIST.replace("S1.1", "S9"), "no clause"),
    ("an empty list", SOUND, "# nothing\n", "no theorem is listed"),
]


def main():
    failures = 0
    for what, theory, names, expected in PLANTED:
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            shutil.copy(ROOT / "spec" / "coq" / "Makefile", folder)
            (folder / "Planted.v").write_text(theory)
            (folder / "Planted.theorems").write_text(names)
            _, faults = check_proofs.check(folder)
        if expected is None:
            good = not faults
        else:
            good = any(expected in fault for fault in faults)
        failures += not good
        print(f"{what}: {'ok' if good else f'not found in {faults}'}")
    print(f"{len(PLANTED)} plants, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
