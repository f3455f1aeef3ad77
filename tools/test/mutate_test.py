#!/usr/bin/env python3
"""Tries how tools/mutate.py finds and mends stale entries of mutants.txt."""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import mutate  # noqa: E402

LINES = {
    "fast/src/tree/split.cpp": [
        "if (width <= limit) return first_of(width, limit);",
        "const int count = width + 1;", "const int other = width + 1;"],
    "fast/src/box/bvh.cpp": ["while (level > 0) level = parents[level];"],
    "io/src/bvh.cpp": ["while (level > 0) level = parents[level];",
                       "int n = 0;"],
    "fast/src/box/short.cpp": ["int n = 0;"],
}

# An entry, and what is made of it: itself, another, or nothing.
ENTRIES = [
    ("it is there",
     "fast/src/box/bvh.cpp: level > 0 => level >= 0 in "
     "while (level > 0) level = parents[level];", "same"),
    ("its file has another name",
     "fast/src/box/tree.cpp: level > 0 => level >= 0 in "
     "while (level > 0) level = parents[level];",
     "fast/src/box/bvh.cpp: level > 0 => level >= 0 in "
     "while (level > 0) level = parents[level];"),
    ("names have changed",
     "fast/src/tree/split.cpp: size <= limit => size < limit in "
     "if (size <= limit) return first_of(size, limit);",
     "fast/src/tree/split.cpp: width <= limit => width < limit in "
     "if (width <= limit) return first_of(width, limit);"),
    ("two names are one",
     "fast/src/tree/split.cpp: size <= limit => size < limit in "
     "if (size <= limit) return first_of(length, limit);",
     "fast/src/tree/split.cpp: width <= limit => width < limit in "
     "if (width <= limit) return first_of(width, limit);"),
    ("two lines would do",
     "fast/src/tree/split.cpp: 1 => 2 in const int some = width + 1;", None),
    ("an operator has changed",
     "fast/src/tree/split.cpp: width < limit => width <= limit in "
     "if (width < limit) return first_of(width, limit);", None),
    ("a short line elsewhere",
     "fast/src/box/bvh.cpp: 0 => 1 in int n = 0;", None),
]


def main():
    failures = 0
    for what, key, expected in ENTRIES:
        reason = mutate.Reason(key)
        got = key if not reason.is_stale(LINES) else mutate.mended(
            reason, LINES)
        wanted = key if expected == "same" else expected
        failures += got != wanted
        print(f"{what}: {'ok' if got == wanted else f'got {got}'}")
    print(f"{len(ENTRIES)} entries, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
