#!/usr/bin/env python3
"""Cuts random scripts of booleans into chains of commands.

  chains.py PROGRAM [--seed N] [--first N] [--count N] [--jobs N] [--shrink]
            [--out FOLDER]

PROGRAM is `halfspace`. A script is a random tree of booleans over tetrahedra in
files, boxes, cylinders, hulls and half-spaces, which are moved, mirrored,
scaled, sheared and turned by quarters, and named again and again. It is worked
out in one command; and as a chain of commands, each of which reads `.hsolid`
files that those before it wrote. Both write `.hsolid`, OFF and STL, which must
be the same bytes (S6.10). The chain's last `.hsolid`, read and written once
more, must not change, either. Where an operand has to be rounded, nothing is
promised, and nothing compared.

Script I of seed N is always the same: --seed N --first I --count 1 tries it
again. --shrink looks for a smaller script that differs. With --out the files of
scripts that differ stay there. Prints a line for each script that differs, and
one for all; exit status 1 if any does.
"""

import argparse
import collections
import concurrent.futures
import dataclasses
import pathlib
import random
import re
import subprocess
import sys
import tempfile

FORMATS = ["hsolid", "off", "stl"]
OPERATIONS = ["|", "&", "-", "^"]
TIMEOUT_S = 120


# --- scripts

@dataclasses.dataclass(eq=False)
class Node:
    """A solid. `text` has a %s for each child; one without is an operand."""
    text: str
    children: list = dataclasses.field(default_factory=list)

    def is_bounded(self):
        return not self.text.startswith("half(")


def text_of(node, names):
    """The node as an expression, in which nodes with names are named."""
    if node in names:
        return names[node]
    return node.text % tuple(text_of(child, names) for child in node.children)


def all_nodes(node, seen=None):
    """The node and all below it, each once, children first."""
    seen = {} if seen is None else seen
    if node not in seen:
        for child in node.children:
            all_nodes(child, seen)
        seen[node] = True
    return list(seen)


@dataclasses.dataclass
class Case:
    """A script, the nodes at which it is cut, and the files that it reads."""
    root: Node
    cuts: list
    files: dict

    def script(self):
        return text_of(self.root, {})

    def steps(self):
        """The commands of the chain: expressions, and the files they make."""
        names, steps = {}, []
        for node in all_nodes(self.root):
            if node in self.cuts and node is not self.root:
                name = f"x{len(steps)}.hsolid"
                steps.append((text_of(node, names), name))
                names[node] = f'"{name}"'
        return steps, text_of(self.root, names)


def decimal(rng, low, high):
    """A number of few digits: an integer, a half, a tenth, a hundredth."""
    parts = rng.choice([1, 1, 2, 4, 8, 10, 100])
    number = rng.randint(low * parts, high * parts) / parts
    return repr(number).removesuffix(".0")


def three(rng, low, high):
    return [decimal(rng, low, high) for _ in range(3)]


def determinant(rows):
    (a, b, c), (d, e, f), (g, h, i) = rows
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def tetrahedron(rng):
    """An OFF file, its faces outwards."""
    while True:
        points = [three(rng, -4, 4) for _ in range(4)]
        place = [list(map(float, point)) for point in points]
        size = determinant([[p - o for p, o in zip(corner, place[0])]
                            for corner in place[1:]])
        if abs(size) > 2:
            break
    if size < 0:
        points[2], points[3] = points[3], points[2]
    faces = ["3 0 2 1", "3 0 1 3", "3 1 2 3", "3 2 0 3"]
    return "\n".join(["OFF", "4 4 0", *map(" ".join, points), *faces, ""])


def half_space(rng):
    if rng.random() < 0.4:
        return Node(f"half({rng.choice('xyz')} {rng.choice('<>')} "
                    f"{decimal(rng, -2, 2)})")
    while True:
        points = [three(rng, -3, 3) for _ in range(3)]
        u, v = ([float(a) - float(b) for a, b in zip(point, points[0])]
                for point in points[1:])
        normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                  u[0] * v[1] - u[1] * v[0]]
        if any(abs(c) > 0.1 for c in normal):
            return Node("half(" + ", ".join(sum(points, [])) + ")")


def moved(rng, node):
    """The solid under a map that needs no rounding."""
    axis = rng.randrange(3)
    unit = ", ".join("1" if k == axis else "0" for k in range(3))
    kind = rng.randrange(7)
    if kind < 2:
        return Node("translate(%s, " + ", ".join(three(rng, -3, 3)) + ")",
                    [node])
    if kind == 2:
        return Node(f"mirror(%s, {rng.choice([unit, '1, 1, 0', '0, 1, -1'])})",
                    [node])
    if kind == 3:
        by = rng.choice(["2", "0.5", "-1", "1.5", "1, 2, 0.5", "0.25, 1, -1"])
        return Node(f"scale(%s, {by})", [node])
    if kind == 4:
        return Node(f"rotate(%s, {unit}, {rng.choice([90, 180, 270])})", [node])
    if kind == 5:
        row = [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]
        row[axis][(axis + rng.choice([1, 2])) % 3] = rng.choice(
            ["1", "-1", "0.5", "2"])
        rows = [", ".join(r + [decimal(rng, -1, 1)]) for r in row]
        return Node("matrix(%s, " + ", ".join(rows) + ")", [node])
    return Node("matrix(%s, 0.6, -0.8, 0, 0, 0.8, 0.6, 0, 0, 0, 0, 1, 0)",
                [node])


def operand(rng, files):
    kind = rng.randrange(6)
    if kind < 2:
        name = f"t{rng.randrange(4)}.off"
        if name not in files:
            files[name] = tetrahedron(rng)
        return Node(f'"{name}"')
    size = [decimal(rng, 1, 5) for _ in range(3)]
    if kind == 2:
        return Node(f"box({', '.join(size)})")
    if kind == 3:
        return Node(f"cylinder({size[0]}, {size[1]}, {rng.randint(3, 8)})")
    if kind == 4:
        return moved(rng, Node(f"box({', '.join(size)})"))
    while True:
        points = [three(rng, -3, 3) for _ in range(rng.randint(4, 6))]
        place = [list(map(float, point)) for point in points]
        if any(abs(determinant([[p - o for p, o in zip(corner, place[0])]
                                for corner in (place[1], place[2], last)])) > 1
               for last in place[3:]):
            return Node("hull(" + ", ".join(sum(points, [])) + ")")


def random_case(rng):
    """A script of two to nine booleans, cut at one to five of its nodes."""
    files, made = {}, []

    def solid(booleans):
        """A bounded solid."""
        if made and rng.random() < 0.2:
            return rng.choice(made)
        if booleans == 0:
            node = operand(rng, files)
        else:
            left = rng.randrange(booleans)
            a = solid(left)
            if rng.random() < 0.3:
                node = Node(f"(%s {rng.choice('&-')} %s)", [a, half_space(rng)])
            else:
                b = solid(booleans - 1 - left)
                node = Node(f"(%s {rng.choice(OPERATIONS)} %s)", [a, b])
        if rng.random() < 0.25:
            node = moved(rng, node)
        made.append(node)
        return node

    while True:
        files.clear()
        made.clear()
        root = solid(rng.randint(2, 9))
        inner = [node for node in all_nodes(root)[:-1]
                 if node.children and node.is_bounded()]
        if inner:
            break
    cuts = rng.sample(inner, min(len(inner), rng.randint(1, 5)))
    return Case(root, cuts, files)


# --- trials

class Bench:
    """Works cases out in a folder of their own."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def csg(self, expression, output):
        """The program's summary, or its error; what it rounded is an error."""
        done = subprocess.run(
            [self.program, "csg", expression, "-o", output, "--threads", "1"],
            cwd=self.folder, capture_output=True, text=True, timeout=TIMEOUT_S)
        if done.returncode:
            return f"status {done.returncode}: {done.stderr.strip()}"
        operands = done.stdout.partition("\n")[0]
        rounds = re.search(r"moved ([1-9]\d*) coordinates|rounded", operands)
        return "rounded" if rounds else ""

    def differences(self, case):
        """The formats that differ; None where nothing is to be compared."""
        for name, text in case.files.items():
            (self.folder / name).write_text(text)
        for name in FORMATS:
            error = self.csg(case.script(), f"whole.{name}")
            if error:
                return None
        steps, last = case.steps()
        for expression, output in steps:
            error = self.csg(expression, output)
            if error:
                return None if error == "rounded" else [error]
        found = []
        for name in FORMATS:
            error = self.csg(last, f"chained.{name}")
            if error:
                return None if error == "rounded" else [error]
            if not self.same(f"whole.{name}", f"chained.{name}"):
                found.append(name)
        error = self.csg('"chained.hsolid"', "again.hsolid")
        if error or not self.same("chained.hsolid", "again.hsolid"):
            found.append("again.hsolid")
        return found

    def same(self, a, b):
        return (self.folder / a).read_bytes() == (self.folder / b).read_bytes()


def replaced(node, old, new, known=None):
    """A copy of the tree with one node replaced; and the copies by node."""
    known = {} if known is None else known
    if node is old:
        known[node] = new
    elif node not in known:
        children = [replaced(child, old, new, known)[0]
                    for child in node.children]
        known[node] = node if children == node.children else \
            Node(node.text, children)
    return known[node], known


def smaller(case):
    """Cases with one node or one cut less."""
    for cut in case.cuts:
        if len(case.cuts) > 1:
            yield Case(case.root, [c for c in case.cuts if c is not cut],
                       case.files)
    for node in reversed(all_nodes(case.root)):
        for child in node.children:
            if not child.is_bounded():
                continue
            root, known = replaced(case.root, node, child)
            alive = all_nodes(root)
            cuts = [known.get(c, c) for c in case.cuts]
            cuts = [c for i, c in enumerate(cuts)
                    if c in alive and c.children and c is not root and
                    c not in cuts[:i]]
            if cuts:
                yield Case(root, cuts, case.files)


def shrunk(bench, case, found):
    """A smaller case that still has one of the differences."""
    while True:
        for other in smaller(case):
            now = bench.differences(other)
            if now and set(now) & set(found):
                case, found = other, now
                break
        else:
            return case, found


def describe(case):
    steps, last = case.steps()
    lines = [f"  script: {case.script()}"]
    lines += [f"  chain:  {expression} -> {output}"
              for expression, output in [*steps, (last, "the result")]]
    used = [name for name in case.files if name in case.script()]
    return "\n".join(lines + [f"  {name}: {case.files[name]!r}"
                              for name in used])


def try_case(arguments, number):
    """What one script comes to: a word, and a text where it differs."""
    rng = random.Random(f"{arguments.seed} {number}")
    case = random_case(rng)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if arguments.out:
            folder = arguments.out / f"{arguments.seed}-{number}"
            folder.mkdir(parents=True, exist_ok=True)
        bench = Bench(arguments.program, folder)
        found = bench.differences(case)
        if found and arguments.shrink:
            case, found = shrunk(bench, case, found)
            bench.differences(case)
        if arguments.out and not found:
            for path in folder.iterdir():
                path.unlink()
            folder.rmdir()
    if found is None:
        return ["not compared"], ""
    return (found or ["same"],
            f"script {number} of seed {arguments.seed}: {', '.join(found)}\n"
            f"{describe(case)}" if found else "")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0,
                        help="the number of the first script")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--shrink", action="store_true")
    parser.add_argument("--out", type=pathlib.Path, metavar="FOLDER")
    arguments = parser.parse_args()
    if not arguments.program.is_file():
        parser.error(f"there is no {arguments.program}: build it first")
    arguments.program = arguments.program.resolve()
    if arguments.out:
        arguments.out = arguments.out.resolve()
    numbers = range(arguments.first, arguments.first + arguments.count)
    counts = collections.Counter()
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for words, text in pool.map(lambda i: try_case(arguments, i), numbers):
            counts.update("status" if word.startswith("status") else word
                          for word in words)
            if text:
                print(text, flush=True)
    compared = arguments.count - counts["not compared"]
    bad = compared - counts["same"]
    kinds = ", ".join(f"{counts[name]} in {name}" for name in
                      [*FORMATS, "again.hsolid", "status"] if counts[name])
    print(f"chains of {compared} scripts compared, {bad} differ"
          + (f": {kinds}" if bad else "") +
          f"; {counts['not compared']} are rounded or refused")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
