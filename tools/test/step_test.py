#!/usr/bin/env python3
"""STEP files are solids: syntax, topology and volume by a reader of its own.

  tools/test/step_test.py PROGRAM FOLDER

Each file must be Part 21; each reference must be there; each edge must be used
by two faces, once in each direction; each loop must be closed; vertices must
lie on the planes of their faces. The volume that the loops go round must be the
one that is known, and so must be the numbers of solids, cavities and holes.
"""
import collections
import math
import pathlib
import re
import subprocess
import sys

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
FOLDER = pathlib.Path(sys.argv[2])
WRONG = []


def wrong(what):
    print("WRONG:", what)
    WRONG.append(what)


class Step:
    def __init__(self, path):
        text = path.read_text("ascii")
        parts = re.fullmatch(r"ISO-10303-21;\nHEADER;\n(.*)ENDSEC;\nDATA;\n(.*)ENDSEC;\n"
                             r"END-ISO-10303-21;\n", text, re.DOTALL)
        if "FILE_SCHEMA(('CONFIG_CONTROL_DESIGN'))" not in parts[1]:
            wrong(f"{path}: schema")
        self.entities = {}
        for line in parts[2].splitlines():
            number, name, rest = re.fullmatch(r"#(\d+)=([A-Z_0-9]*)(\(.*\));", line).groups()
            if int(number) in self.entities:
                wrong(f"{path}: #{number} twice")
            self.entities[int(number)] = (name, rest)
        for number, (name, rest) in self.entities.items():
            for other in self.ids(rest):
                if other not in self.entities:
                    wrong(f"{path}: #{number} names #{other}")
            if re.search(r"[-+(,]\d+E|(?<![.\d])\d+E", rest):
                wrong(f"{path}: a real without a point: {rest}")

    @staticmethod
    def ids(rest):
        return [int(x) for x in re.findall(r"#(\d+)", re.sub(r"'[^']*'", "", rest))]

    def all(self, wanted):
        return [n for n, (name, _) in self.entities.items() if name == wanted]

    def of(self, number):
        return self.ids(self.entities[number][1])

    def point(self, number):
        name, rest = self.entities[number]
        if name == "VERTEX_POINT":
            return self.point(self.of(number)[0])
        return [float(x) for x in re.search(r"\(([^()]*)\)\)$", rest)[1].split(",")]


def loop_points(step, bound, uses):
    """The vertices of a bound's loop, in its order."""
    points, ends = [], []
    for oriented in step.of(step.of(bound)[0]):
        edge, = step.of(oriented)
        forward = step.entities[oriented][1].endswith(".T.)")
        uses[edge].append(forward)
        start, end, line = step.of(edge)
        a, b = step.point(start), step.point(end)
        at, vector = step.of(line)
        direction = step.point(step.of(vector)[0])
        along = [y - x for x, y in zip(a, b)]
        length = math.hypot(*along)
        if any(abs(d - x / length) > 1e-12 for d, x in zip(direction, along)) or \
                step.point(at) != a:
            wrong(f"edge #{edge} is not on its line")
        points.append(a if forward else b)
        ends.append((start, end) if forward else (end, start))
    for first, second in zip(ends, ends[1:] + ends[:1]):
        if first[1] != second[0]:
            wrong(f"loop of #{bound} is open")
    return points


def area_of(points):
    total = [0.0] * 3
    for b, c in zip(points[1:], points[2:]):
        u = [x - y for x, y in zip(b, points[0])]
        v = [x - y for x, y in zip(c, points[0])]
        for k in range(3):
            total[k] += u[k - 2] * v[k - 1] - u[k - 1] * v[k - 2]
    return total


def check(name, expression, volume, solids, voids, holes, bindings=()):
    done = subprocess.run([PROGRAM, "csg", expression, *bindings, "-o", name], cwd=FOLDER,
                          capture_output=True, text=True)
    if done.returncode:
        return wrong(f"{name}: {done.stderr}")
    step = Step(FOLDER / name)
    uses, total, inner = collections.defaultdict(list), 0.0, 0
    for face in step.all("ADVANCED_FACE"):
        *bounds, plane = step.of(face)
        origin, axis, _ = step.of(step.of(plane)[0])
        at, normal = step.point(origin), step.point(axis)
        kinds = [step.entities[b][0] for b in bounds]
        if kinds[0] != "FACE_OUTER_BOUND" or set(kinds[1:]) - {"FACE_BOUND"}:
            wrong(f"{name}: bounds {kinds}")
        inner += len(bounds) - 1
        for i, bound in enumerate(bounds):
            points = loop_points(step, bound, uses)
            area = area_of(points)
            if (sum(a * n for a, n in zip(area, normal)) > 0) != (i == 0):
                wrong(f"{name}: loop #{bound} runs the wrong way")
            total += sum(a * p for a, p in zip(area, points[0])) / 6
            for p in points:
                if abs(sum((x - y) * n for x, y, n in zip(p, at, normal))) > 1e-12:
                    wrong(f"{name}: {p} is off the plane of #{face}")
    for edge in step.all("EDGE_CURVE"):
        if sorted(uses[edge]) != [False, True]:
            wrong(f"{name}: edge #{edge} is used {uses[edge]}")
    faces = [f for shell in step.all("CLOSED_SHELL") for f in step.of(shell)]
    if sorted(faces) != sorted(step.all("ADVANCED_FACE")):
        wrong(f"{name}: not each face is in one shell")
    got = (len(step.all("MANIFOLD_SOLID_BREP")) + len(step.all("BREP_WITH_VOIDS")),
           len(step.all("ORIENTED_CLOSED_SHELL")), inner)
    if abs(total - volume) > 1e-9 * max(1, abs(volume)) or got != (solids, voids, holes):
        wrong(f"{name}: volume {total}, not {volume}; {got}, not {(solids, voids, holes)}")
    return None


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    box = "translate(box({0}, {0}, {0}), {1}, {1}, {1})"
    check("corner.step", f"box(4, 4, 4) - {box.format(4, 1)}", 37, 1, 0, 0)
    check("hole.step", "box(4, 4, 4) - translate(box(1, 1, 9), 1, 1, -2)", 60, 1, 0, 2)
    check("void.stp", f"box(4, 4, 4) - {box.format(1, 1)}", 63, 1, 1, 0)
    check("two.step", f"box(1, 1, 1) | {box.format(2, 3)}", 9, 2, 0, 0)
    # A cavity with a part of its own, and points on no grid.
    check("nest.step", f"(box(8, 8, 8) - {box.format(6, 1)}) | {box.format(2, 3)}",
          512 - 216 + 8, 2, 1, 0)
    third = "half(0, 0, 1, 0, 1, 0, 1, 0, 0)"
    check("corner6.step", f"box(1, 1, 1) & ~{third}", 1 / 6, 1, 0, 0)
    # Parts that touch in an edge.
    check("touch.step", f"box(1, 1, 1) | translate(box(1, 1, 1), 1, 1, 0)", 2, 2, 0, 0)
    check("turned.step", f"box(4, 4, 4) - rotate({box.format(4, 1)}, 1, 2, 3, 25)",
          volume_by_program(f"box(4, 4, 4) - rotate({box.format(4, 1)}, 1, 2, 3, 25)"), 1, 0, 0)
    return 1 if WRONG else 0


def volume_by_program(expression):
    done = subprocess.run([PROGRAM, "csg", expression, "-o", "volume.off"], cwd=FOLDER,
                          capture_output=True, text=True)
    return float(re.search(r"volume ([-\d.e]+)", done.stdout)[1])


if __name__ == "__main__":
    sys.exit(main())
