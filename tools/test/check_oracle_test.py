#!/usr/bin/env python3
"""Plants faults in a copy of the oracle and of its theories, and sees
check_oracle.py find each."""

import pathlib
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import check_oracle  # noqa: E402

ORACLE = "oracle/halfspace_oracle.ml"

# What is planted, in which file, what stands there, what is put there, and
# what the check says of it.
PLANTED = [
    ("nothing", ORACLE, "", "", None),
    ("a swapped case in the oracle", ORACLE, "K1", "K8", ORACLE),
    ("another row of the table in the theory", "coq/Boolean.v",
     "| kInside   => Build_Row X  X  o  o  o  F",
     "| kInside   => Build_Row X  X  o  o  o  X", "Error"),
    ("another word of the oracle", "oracle/extract.v", "Boolean.keep",
     "Boolean.keeps", "Error"),
]


def main():
    failures = 0
    for what, name, here, there, expected in PLANTED:
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            # With the times, so that only what is planted is compiled again.
            shutil.copytree(ROOT / "spec/coq", place / "coq")
            shutil.copytree(ROOT / "spec/oracle", place / "oracle")
            text = (place / name).read_text()
            faults = [f"{name} does not hold {here!r}"]
            if here in text:
                (place / name).write_text(text.replace(here, there))
                faults = check_oracle.faults_of(place / "coq", place / "oracle")
        good = (not faults if expected is None else
                any(expected in fault for fault in faults))
        failures += not good
        print(f"{what}: {'ok' if good else f'not found in {faults}'}")
    print(f"{len(PLANTED)} plants, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
