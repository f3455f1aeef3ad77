#!/usr/bin/env python3
"""Compares the public functions of ref/ and fast/, header by header.

The ten headers of STEMS declare the same names in the same order in both
rooms. A header may declare more types than its twin, and no more functions but
those that ALONE names with a reason.

Exit status: 0 if the headers that fast/ has agree with ref/, else 1.
"""

import pathlib
import re
import sys

STEMS = ("predicate split splitter build traverse scan screen render classify "
         "boolean").split()

# Functions that have no twin, and why.
ALONE = {
    ("ref", "predicate"): {
        "operator<": "orders points by their coordinates; fast has none",
        "to_point": "coordinates as rationals; fast has none",
        "value_at": "the value as a rational; fast has its sign alone",
    },
    ("ref", "screen"): {
        "merge_segment": "F2B's step on a linked list; fast has no list",
        "merge": "on lists of segments; fast has DynamicScreen alone",
    },
    ("ref", "boolean"): {
        "keep": "fast decides by memberships round an edge, not by classes",
        "close_junctions": "fast's results are made so; no step of its own",
        "volume6": "a rational; fast has none",
        "bad_edges": "fast has it in a header of its own",
        "rounded": "fast has to_mesh(), of triangles",
    },
    ("fast", "build"): {
        "has_leaves": "only fast's display trees have leaves",
        "divide_leaves": "only fast's display trees have leaves",
    },
    ("fast", "predicate"): {
        "plane_corners": "three grid points; ref has the plane's rationals",
        "intern_planes": "names planes, so that equal ones are told by id",
    },
}

# Words that stand before a parenthesis at namespace or class level without
# being the name of a function.
NOT_FUNCTIONS = {"if", "for", "while", "switch", "return", "sizeof", "noexcept",
                 "alignof", "decltype", "static_assert", "defined", "operator",
                 "function", "requires", "explicit", "assert",
                 "__attribute__", "alignas", "HALFSPACE_ASSERT"}


def without_noise(text):
    """The text without comments, strings, and preprocessor lines."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.DOTALL)
    text = re.sub(r'"(?:\\.|[^"\\])*"', '""', text)
    directive = r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*"
    return re.sub(directive, "", text, flags=re.MULTILINE)


def free_functions(text):
    """The names of the functions that a header declares in its namespaces.

    Overloads in a row are one name: what a function is given differs. Members
    are left out: how a class is made is its room's own affair.
    """
    names, head, depth = [], "", []
    for token in re.findall(r"[{};]|[^{};]+", without_noise(text)):
        if token == "{":
            is_namespace = bool(re.search(r"\b(namespace|extern)\b", head))
            if not depth or all(depth):
                name = function_in(head)
                if name and not is_namespace:
                    names.append(name)
            depth.append(is_namespace)
            head = ""
        elif token == "}":
            if depth:
                depth.pop()
            head = ""
        elif token == ";":
            if all(depth):
                name = function_in(head)
                if name:
                    names.append(name)
            head = ""
        elif all(depth):
            head += token
    return [name for name, before in zip(names, [None] + names)
            if name != before]


def function_in(head):
    """The name of the function that a declaration declares, if it is one."""
    if re.match(r"\s*(using|typedef|static_assert|namespace)\b", head):
        return None
    if re.match(r"\s*(template\s*<[^{}]*>\s*)?"
                r"(struct|class|enum|union)\b[^()]*$", head):
        return None
    symbol = re.search(r"\boperator\s*(\(\)|\[\]|[^\s\w(]+|\w+)\s*\(", head)
    if symbol:
        return "operator" + symbol[1]
    for match in re.finditer(r"\b([A-Za-z_]\w*)\s*\(", head):
        if match[1] not in NOT_FUNCTIONS:
            # A variable initialised with a call is no function.
            return None if "=" in head[:match.start()] else match[1]
    return None


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    ref = root / "ref/include/halfspace/ref"
    fast = root / "fast/include/halfspace/fast"
    present = [stem for stem in STEMS if (fast / f"{stem}.hpp").exists()]
    wrong = []
    for stem in present:
        if not (ref / f"{stem}.hpp").exists():
            wrong.append(f"{stem}.hpp: ref/ has no such header")
            continue
        names = {}
        for room, path in (("ref", ref), ("fast", fast)):
            alone = ALONE.get((room, stem), {})
            declared = free_functions((path / f"{stem}.hpp").read_text())
            names[room] = [name for name in declared if name not in alone]
            for name in sorted(alone.keys() - set(declared)):
                wrong.append(f"{stem}.hpp: {room} declares no {name}, which "
                             "is listed as having no twin")
        if names["ref"] != names["fast"]:
            for room in names:
                listed = ", ".join(names[room]) or "nothing"
                wrong.append(f"{stem}.hpp: {room} declares {listed}")
    for line in wrong:
        print(line)
    if not present:
        print("fast/ has none of the ten headers yet: nothing to compare")
    else:
        print(f"{len(present)} of {len(STEMS)} headers compared, "
              f"{'they differ' if wrong else 'they agree'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
