#!/usr/bin/env python3
"""Compares the laws of spec/ with the tests of proptest/, both ways.

A law is a paragraph of spec/S*.md that begins with **S4.L3**. Its test is a
TYPED_TEST, TEST or TEST_P of the suite S4Screen (S and the number begin the
name) whose name begins with L3 and goes on with a capital, in a file
proptest/laws/**/S*_test.cpp. A law may have several tests: variants begin with its
number as well.

Exit status: 0 if every law has a test and every numbered test a law, else 1.
"""

import pathlib
import re
import sys

LAW = re.compile(r"^\*\*S(\d+)\.L(\d+)\*\*\s+(\S.*)$", re.MULTILINE)
TEST = re.compile(
    r"^\s*(?:TYPED_TEST|TEST|TEST_F|TEST_P)\(\s*S(\d+)\w*\s*,\s*(\w+)\s*\)",
    re.MULTILINE)
NUMBERED = re.compile(r"L(\d+)(?=[A-Z]|$)")


def laws_in(spec):
    """The laws, as {(clause file, number): where}, and what is wrong."""
    laws, wrong = {}, []
    for path in sorted(spec.glob("S*.md")):
        last = 0
        for match in LAW.finditer(path.read_text()):
            key = (int(match[1]), int(match[2]))
            here = f"{path.name}: S{key[0]}.L{key[1]}"
            if not path.name.startswith(f"S{key[0]}-"):
                wrong.append(f"{here} is another file's")
            if key in laws:
                wrong.append(f"{here} stands there twice")
            elif key[1] != last + 1:
                wrong.append(f"{here} follows L{last}")
            last = key[1]
            laws[key] = path.name
    return laws, wrong


def tests_in(proptest):
    """The numbered tests, as {(clause file, number): [where and name]}."""
    tests = {}
    for path in sorted(proptest.glob("laws/**/S*_test.cpp")):
        for match in TEST.finditer(path.read_text()):
            number = NUMBERED.match(match[2])
            if number:
                key = (int(match[1]), int(number[1]))
                tests.setdefault(key, []).append(f"{path.name}: {match[2]}")
    return tests


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    laws, wrong = laws_in(root / "spec")
    tests = tests_in(root / "proptest")
    if not laws:
        wrong.append("spec/ has no laws")
    for s, n in sorted(laws.keys() - tests.keys()):
        wrong.append(f"{laws[s, n]}: S{s}.L{n} has no test")
    for s, n in sorted(tests.keys() - laws.keys()):
        wrong += [f"{test} is the test of no law" for test in tests[s, n]]
    for line in wrong:
        print(line)
    count = sum(len(names) for names in tests.values())
    print(f"{len(laws)} laws, {count} tests of them, {len(wrong)} mismatches")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
