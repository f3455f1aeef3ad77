#!/usr/bin/env python3
"""Compares the constants of the filter and of the exact integers with those of
the theories that prove them enough.

Exit status: 0 if they are the same, else 1.
"""

import pathlib
import re
import sys

# What the code says, what the theory says, and how the one is read as the
# other.
CONSTANTS = (
    ("fast/src/exact/filter.hpp", r"kRounding = 0x1p-(\d+);",
     "spec/coq/Filter.v", r"kRounding : Q := Eval cbv in 1 # 2 \^ (\d+)\."),
    ("fast/src/exact/filter.hpp",
     r"return (\d+) \* kRounding \* most;",
     "spec/coq/Filter.v", r"values_factor : Q := (\d+)\."),
    ("fast/src/exact/filter.hpp",
     r"f\.size \* \(v\.error \* \(1 \+ 0x1p-(\d+)\) \+ rounding\)",
     "spec/coq/Filter.v", r"error_growth : Q := Eval cbv in 1 # 2 \^ (\d+)\."),
    ("fast/src/exact/filter.hpp",
     r"std::min\(1\.0, (\d+) \* std::max\(hp\.error, hq\.error\)",
     "spec/coq/Vertex.v", r"doubt_factor : Q := (\d+)\."),
    ("fast/src/exact/filter.hpp",
     r"doubt \* length\) \* \(1 \+ 0x1p-(\d+)\) \+ rounding",
     "spec/coq/Filter.v", r"error_growth : Q := Eval cbv in 1 # 2 \^ (\d+)\."),
    ("fast/src/exact/filter.hpp", r"doubt \*= 1 \+ 0x1p-(\d+);",
     "spec/coq/Meet.v", r"doubt_growth : Q := Eval cbv in 1 # 2 \^ (\d+)\."),
    ("fast/src/exact/filter.hpp", r"\), error \* \(1 \+ 0x1p-(\d+)\) \+ rounding\}",
     "spec/coq/Meet.v", r"doubt_growth : Q := Eval cbv in 1 # 2 \^ (\d+)\."),
    ("fast/src/exact/filter.hpp", r"(\d+) \* kRounding \* extent \*",
     "spec/coq/Meet.v", r"rounding_factor : Q := (\d+)\."),
    ("fast/src/exact/filter.hpp", r"(\d+) \* kRounding \* \(size",
     "spec/coq/Meet.v", r"rnd \((\d+) \* kRounding \*"),
    ("fast/src/camera/view.cpp", r"eye_error = (\d+) \* kRounding \* \(farthest",
     "spec/coq/Eye.v", r"eye_factor : Q := (\d+)\."),
    ("fast/src/exact/exact_plane.hpp",
     r"kWords = kBits == 26 \? (\d) : kBits == 40 \? (\d) : (\d);",
     "spec/coq/Numbers.v",
     r"if n =\? 26 then (\d) else if n =\? 40 then (\d) else (\d)\."),
    ("fast/src/exact/exact_plane.hpp",
     r"Value = std::conditional_t<kBits == (\d+), Wide<3>, Int128>",
     "spec/coq/Numbers.v",
     r"value_bits \(n : Z\) : Z := if n =\? (\d+) then 192 else 128\."),
)


def faults_of(root):
    """Everything that differs, or is not found."""
    faults = []
    for code, in_code, theory, in_theory in CONSTANTS:
        said = re.search(in_code, (root / code).read_text())
        proven = re.search(in_theory, (root / theory).read_text())
        if not said:
            faults.append(f"{code}: nothing reads {in_code}")
        elif not proven:
            faults.append(f"{theory}: nothing reads {in_theory}")
        elif said.groups() != proven.groups():
            faults.append(f"{code} says {said[0]}, {theory} {proven[0]}")
    return faults


def main():
    faults = faults_of(pathlib.Path(__file__).resolve().parent.parent)
    for fault in faults:
        print(fault)
    print(f"{len(CONSTANTS)} constants, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
