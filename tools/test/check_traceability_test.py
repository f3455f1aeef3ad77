#!/usr/bin/env python3
"""Plants faults in a copy of what check_traceability.py reads, and sees it find
each."""

import pathlib
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import check_traceability  # noqa: E402

TABLE = "spec/traceability.md"
FUNCTIONS = "proptest/traceability/functions.cpp"
PROGRAM = "tests.sh"
REPORT = "report.txt"

# What is planted, in which file, what stands there, what is put there, and
# what the check says of it.
PLANTED = [
    ("nothing", TABLE, "# Traceability", "# Traceability", None),
    ("an edited clause", "spec/S2-split.md", "## S2.3 Split\n",
     "## S2.3 Split\n\nNot so.\n", "S2.3 has changed"),
    ("a clause that is gone", "spec/S3-tree.md", "## S3.2 ", "### S3.2 ",
     "no clause S3.2"),
    ("a clause that is new", "spec/S3-tree.md", "## S3.1 ",
     "## S3.99 New\n\nText.\n\n## S3.1 ", "S3.99 has no row"),
    ("a row twice", TABLE, "## S1.2 Scene", "## S1.1 Scene",
     "stands there twice"),
    ("a row without a line", TABLE, "laws: S1.L7\n", "", "S1.1: has"),
    ("a new function", TABLE, "halfspace/ref/split.hpp ref::split",
     "halfspace/ref/split.hpp ref::divide", f"{FUNCTIONS} is not"),
    ("a function without a header", TABLE, "halfspace/ref/split.hpp ref::split",
     "ref::split", "no function: ref::split"),
    ("a function not taken", FUNCTIONS, "  take(&ref::split);", "",
     f"{FUNCTIONS} is not"),
    ("a law of no clause", TABLE, "S2.L2, S2.L3", "S2.L3",
     "S2.L2 is named by no clause"),
    ("a law that is not there", TABLE, "S2.L2, S2.L3", "S2.L2, S2.L3, S2.L99",
     "S2.3: no law: S2.L99"),
    ("a test that is gone", PROGRAM, "  L3Some", "  DISABLED_L3Some",
     "S2.L3 has run for [] of"),
    ("a test that does not run", REPORT, "S2Suite/0.L3Some 100000 passed\n", "",
     "S2Suite/0.L3Some has not run"),
    ("a test that does not run on one implementation", REPORT,
     "S2Suite/1.L3Some 100000 passed\n", "", "S2Suite/1.L3Some has not run"),
    ("an implementation that is not tested", PROGRAM, "S2Suite/1. ",
     "S2Suite. ", "S2.L3 has run for"),
    ("a law that two clauses see differently", TABLE, "laws: S3.L5, S3.L7 (1)",
     "laws: S3.L5 (2), S3.L7 (1)", "asks less or more of S3.L5"),
    ("a test that is skipped", REPORT, "S2Suite/1.L3Some 100000 passed",
     "S2Suite/1.L3Some 0 skipped", "S2Suite/1.L3Some has not passed"),
    ("a test that fails", REPORT, "S2Suite/0.L3Some 100000 passed",
     "S2Suite/0.L3Some 100000 failed", "S2Suite/0.L3Some has not passed"),
    ("a test of few cases", REPORT, "S2Suite/1.L3Some 100000 passed",
     "S2Suite/1.L3Some 2 passed", "S2.L3 has run 2 cases of"),
    ("a test of no law", PROGRAM, "  L3Some", "  L3Some\n  L77Other",
     "L77Other is of no law"),
    ("a fuzz target that is gone", "fuzz/CMakeLists.txt",
     "halfspace_fuzz_target(fuzz_merge", "# (fuzz_merge",
     "no fuzz target: fuzz_merge"),
    ("a fuzz target of no clause", "fuzz/CMakeLists.txt",
     "halfspace_fuzz_target(fuzz_merge",
     "halfspace_fuzz_target(fuzz_other)\nhalfspace_fuzz_target(fuzz_merge",
     "fuzz_other is named by no clause"),
    ("a theorem of no clause", "spec/coq/Spans.theorems", "| S4.7 |",
     "| S4.77 |", "no clause S4.77"),
    ("a sentence of a theorem", "spec/coq/Spans.theorems", "eight conditions",
     "nine conditions", "docs/proven.md is not"),
    ("a document", "docs/traceability.md", "* Laws: S1.L7", "* Laws: S1.L8",
     "docs/traceability.md is not"),
    ("another constant in the code", "fast/src/exact/filter.hpp",
     "kRounding = 0x1p-53", "kRounding = 0x1p-54", "filter.hpp says"),
    ("another doubt of a vertex", "spec/coq/Vertex.v",
     "doubt_factor : Q := 2", "doubt_factor : Q := 1", "filter.hpp says"),
    ("another constant in a theory", "spec/coq/Numbers.v",
     "if n =? 26 then 4 else", "if n =? 26 then 3 else", "exact_plane.hpp says"),
]


def copy(place):
    """What the check reads; a program and a report in which all is well."""
    for name in ("spec", "docs", "fuzz"):
        shutil.copytree(ROOT / name, place / name,
                        ignore=shutil.ignore_patterns("*.vo*", "*.glob"))
    for name in (FUNCTIONS, "fast/src/exact/filter.hpp",
                 "fast/src/exact/exact_plane.hpp", "fast/src/camera/view.cpp"):
        (place / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, place / name)
    tests, report = [], []
    table, least = check_traceability.rows([])
    wanted = check_traceability.wanted_laws(table, least, [])
    for law, (_, ref_only) in sorted(wanted.items()):
        clause, number = law.split(".")
        for kind in (0,) if ref_only else (0, 1):
            tests.append(f"{clause}Suite/{kind}.  # TypeParam\n"
                         f"  {number}Some\n")
            report.append(f"{clause}Suite/{kind}.{number}Some 100000 passed\n")
    (place / PROGRAM).write_text(f"#!/bin/sh\ncat <<'END'\n"
                                 f"{''.join(tests)}END\n")
    (place / PROGRAM).chmod(0o755)
    (place / REPORT).write_text("".join(report))


def faults_with(place, name, here, there):
    """What the check says after one replacement, which is then undone."""
    path = place / name
    text = path.read_text()
    if here not in text:
        return [f"{name} does not hold {here!r}"]
    if name == PROGRAM:
        # One law's tests of both implementations.
        at = text.index("S2Suite/0.  # TypeParam\n  L3Some")
        planted = text[:at] + text[at:].replace(here, there, 2)
    else:
        planted = text.replace(here, there, 1)
    path.write_text(planted)
    faults, _ = check_traceability.check(False, place / PROGRAM, place / REPORT)
    path.write_text(text)
    return faults


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        check_traceability.ROOT = ROOT
        copy(place)
        check_traceability.ROOT = place
        for what, name, here, there, expected in PLANTED:
            faults = faults_with(place, name, here, there)
            good = (not faults if expected is None else
                    any(expected in fault for fault in faults))
            failures += not good
            print(f"{what}: {'ok' if good else f'not found in {faults}'}")
    print(f"{len(PLANTED)} plants, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
