#!/usr/bin/env python3
"""Tries tools/verify.py on a program that pretends to have two laws.

One law holds; the other fails and saves a scene. Both the failure and the sums
must come out right, for one run and merged.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

VERIFY = pathlib.Path(__file__).resolve().parent.parent / "verify.py"

PROGRAM = """#!/usr/bin/env python3
import json, os, pathlib, sys
GOOD, BAD = "S4Screen/0.L1Holds", "S4Screen/0.L12Fails"
if sys.argv[1] == "--gtest_list_tests":
    print("S4Screen/0.  # TypeParam = Ref\\n  L1Holds\\n  L12Fails\\n"
          "Distribution.\\n  NoLaw")
    sys.exit(0)
test = sys.argv[1].partition("=")[2]
assert os.environ["RC_PARAMS"].startswith("seed=")
folder = pathlib.Path(os.environ["HALFSPACE_COUNTEREXAMPLES"])
pathlib.Path(os.environ["HALFSPACE_REPORT"]).write_text(json.dumps({
    "cases": {test: 100}, "failures": {test: 3} if test == BAD else {},
    "notes": {"views looked at": 10, "slivers": 4}}))
if test == BAD:
    scene = folder / "s4-l12.scene"
    scene.write_text("halfspace-scene 1")
    print(f"law_test.cpp:7: not so: a == b\\nsaved as {scene}")
    sys.exit(1)
"""


def run(*words):
    done = subprocess.run([sys.executable, VERIFY, *map(str, words)],
                          capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def expect(condition, what, text=""):
    if not condition:
        sys.exit(f"verify_test.py: not so: {what}\n{text}")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        program = folder / "program"
        program.write_text(PROGRAM)
        program.chmod(0o755)
        common = ["--program", program, "--jobs", 2, "--out", folder / "out"]

        status, text = run("--list", *common)
        expect(status == 0 and "S4.L12" in text and "NoLaw" not in text,
               "laws are listed, and nothing else", text)

        first = folder / "first.json"
        status, text = run("--law", "S4", "--cases", 900, "--shard", "0/2",
                           "--json", first, *common)
        summary = json.loads(first.read_text())
        expect(status == 1, "a failure is the exit status", text)
        expect(len(summary["failures"]) == 1, "a law fails once", text)
        failure = summary["failures"][0]
        expect(failure["law"] == "S4.L12", "the law is named", text)
        expect("a == b" in failure["message"], "it says what is not so", text)
        expect(pathlib.Path(failure["scene"]).is_file(), "the scene is there")
        expect(f"HALFSPACE_REPLAY={failure['scene']} {program} "
               "--gtest_filter='S4Screen/0.L12Fails'" in text,
               "the line that replays it is printed", text)
        expect(summary["cases"] >= 900, "so many cases were asked for", text)
        expect(summary["cases"] == sum(summary["cases_by_law"].values()),
               "the sum is the sum", text)

        second = folder / "second.json"
        status, text = run("--law", "S4.L1", "--cases", 300, "--shard", "1/2",
                           "--json", second, *common)
        expect(status == 0, "L1 is not L12", text)
        status, text = run("merge", first, second)
        total = summary["cases"] + json.loads(second.read_text())["cases"]
        expect(status == 1 and f"{total:,} cases" in text, "sums add up", text)
        status, text = run("merge", first, first)
        expect(status != 0 and "there twice" in text,
               "no shard counts twice", text)
        status, text = run("--law", "S9", "--cases", 1, *common)
        expect(status == 2, "there is no such law", text)
    print("verify.py: a failure is found, saved and replayed; sums add up")


if __name__ == "__main__":
    main()
