#!/usr/bin/env python3
"""Sends booleans through files and looks at what is in them.

  round_trips.py PROGRAM [--pairs N] [--steps N] [--seeds N] [--formats ...]
                 [--parts FILE...] [--judge PROGRAM] [--first N]

PROGRAM is `halfspace`. Two trials:

* pairs: booleans of two solids that are turned against each other, by any
  angle or by 1e-3 to 1e-12 degrees. Each is written in each format, read by the
  program, and read and checked here, in integers and without the program's
  code: closed, no two vertices in one place, no triangle without area, no two
  triangles with more in common than corners and edges that both have, unless
  they touch without crossing. With --parts the solids are those in the files:
  a part and a copy of it, or another part, scaled to the size of the first.
  --judge is a program that has the last word: it gets the files, and ends with
  status 1 where one is no solid's (bench/judge/judge_mesh.cpp, by CGAL).
* steps: a block from which a turned bar is taken again and again, each time
  from the file of the step before; and the same in one run. All steps must
  end, and the volumes must agree within the sum of what was moved.

Prints a line for each trial and format; exit status 1 if anything failed.
"""

import argparse
import collections
import fractions
import io
import math
import pathlib
import random
import re
import struct
import subprocess
import sys
import tempfile
import zipfile
from xml.etree import ElementTree

FORMATS = ["stl", "off", "obj", "ply", "3mf"]
OPERATIONS = ["&", "|", "-", "^"]


def run(program, *words):
    """The output of the program, and its error message or None."""
    done = subprocess.run([program, *map(str, words)], capture_output=True,
                          text=True)
    return done.stdout, done.stderr.strip() if done.returncode else None


# --- files, as (vertices in fractions, polygons of indices)

def read_stl(data):
    count = struct.unpack_from("<I", data, 80)[0]
    ids, polygons = {}, []
    for t in range(count):
        numbers = struct.unpack_from("<12f", data, 84 + 50 * t)
        polygons.append([ids.setdefault(numbers[k:k + 3], len(ids))
                         for k in (3, 6, 9)])
    return list(ids), polygons


def read_off(data):
    words = data.decode().split()
    vertices, faces = int(words[1]), int(words[2])
    at = 4
    points = [tuple(map(float, words[at + 3 * v:at + 3 * v + 3]))
              for v in range(vertices)]
    at += 3 * vertices
    lines = data.decode().splitlines()[2 + vertices:2 + vertices + faces]
    return points, [[int(word) for word in line.split()[1:]]
                    [:int(line.split()[0])] for line in lines]


def read_obj(data):
    points, polygons = [], []
    for line in data.decode().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            polygons.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return points, polygons


def read_ply(data):
    """PLY as the program writes it: doubles first, lists of ints."""
    header, _, body = data.partition(b"end_header\n")
    text = header.decode()
    counts = dict((name, int(n)) for name, n in
                  re.findall(r"element (\w+) (\d+)", text))
    if "format ascii" in text:
        rows = [line.split() for line in body.decode().splitlines()]
        rows, faces = rows[:counts["vertex"]], rows[counts["vertex"]:]
        return ([tuple(map(float, row[:3])) for row in rows],
                [[int(w) for w in row[1:int(row[0]) + 1]] for row in faces])
    sizes = {"double": 8, "float": 4, "int": 4, "uint": 4, "uchar": 1}
    of_vertex, of_face = text.split("element face")
    row = sum(sizes[t] for t in re.findall(r"property (\w+) \w+\n",
                                           of_vertex))
    extra = sum(sizes[t] for t in re.findall(r"property (\w+) \w+\n",
                                             of_face + "\n"))
    points = [struct.unpack_from("<3d", body, row * v)
              for v in range(counts["vertex"])]
    at, polygons = row * counts["vertex"], []
    for _ in range(counts["face"]):
        corners = body[at]
        polygons.append(list(struct.unpack_from(f"<{corners}i", body, at + 1)))
        at += 1 + 4 * corners + extra
    return points, polygons


def read_3mf(data):
    """One object of triangles; its numbers are floats, in decimals."""
    space = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    package = zipfile.ZipFile(io.BytesIO(data))
    model = ElementTree.fromstring(package.read("3D/3dmodel.model"))
    as_float = lambda word: struct.unpack("f", struct.pack("f", float(word)))[0]
    points = [tuple(as_float(vertex.get(axis)) for axis in "xyz")
              for vertex in model.iter(space + "vertex")]
    return points, [[int(triangle.get(name)) for name in ("v1", "v2", "v3")]
                    for triangle in model.iter(space + "triangle")]


READERS = {"stl": read_stl, "off": read_off, "obj": read_obj, "ply": read_ply,
           "3mf": read_3mf}


def write_off(path, points, polygons):
    """For judges that read no 3MF."""
    lines = ["OFF", f"{len(points)} {len(polygons)} 0"]
    lines += [" ".join(map(repr, point)) for point in points]
    lines += [" ".join(map(str, [len(p), *p])) for p in polygons]
    path.write_text("\n".join(lines) + "\n")


# --- the checker

def minus(p, q):
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


def cross(p, q):
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
            p[0] * q[1] - p[1] * q[0])


def dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def sign(value):
    return (value > 0) - (value < 0)


def in_integers(points):
    """The points times a power of two, or of ten where that is less."""
    exact = [tuple(map(fractions.Fraction, p)) for p in points]
    by = math.lcm(1, *(c.denominator for p in exact for c in p))
    return [tuple(int(c * by) for c in p) for p in exact], by


def crosses(a, b):
    """Whether an edge of one passes through the inside of the other."""
    for t, u in ((a, b), (b, a)):
        normal = cross(minus(u[1], u[0]), minus(u[2], u[0]))
        sides = [sign(dot(normal, minus(p, u[0]))) for p in t]
        for i in range(3):
            j = (i + 1) % 3
            if sides[i] * sides[j] >= 0:
                continue
            p, q = t[i], t[j]
            turns = [sign(dot(cross(minus(q, p), minus(u[k], p)),
                              minus(u[(k + 1) % 3], p))) for k in range(3)]
            if turns in ([1, 1, 1], [-1, -1, -1]):
                return True
    return False


def pairs_near(triangles):
    """Pairs whose boxes overlap, by a sweep along the first axis."""
    boxes = [tuple((min(p[k] for p in t), max(p[k] for p in t))
                   for k in range(3)) for t in triangles]
    order = sorted(range(len(boxes)), key=lambda i: boxes[i][0][0])
    active = []
    for i in order:
        active = [j for j in active if boxes[j][0][1] >= boxes[i][0][0]]
        for j in active:
            if all(boxes[i][k][0] <= boxes[j][k][1] and
                   boxes[j][k][0] <= boxes[i][k][1] for k in (1, 2)):
                yield i, j
        active.append(i)


def faults_of(points, polygons):
    """What keeps a mesh from being a solid's surface; its volume."""
    faults = []
    whole, by = in_integers(points)
    if len(set(whole)) != len(whole):
        faults.append("two vertices in one place")
    uses = collections.Counter()
    triangles = []
    for polygon in polygons:
        for i, v in enumerate(polygon):
            uses[v, polygon[(i + 1) % len(polygon)]] += 1
        triangles += [(polygon[0], polygon[i], polygon[i + 1])
                      for i in range(1, len(polygon) - 1)]
    if any(uses[u, v] != uses[v, u] for u, v in list(uses)):
        faults.append("not closed")
    corners = [tuple(whole[v] for v in t) for t in triangles]
    if any(cross(minus(t[1], t[0]), minus(t[2], t[0])) == (0, 0, 0)
           for t in corners):
        faults.append("a triangle without area")
    if any(crosses(corners[i], corners[j])
           for i, j in pairs_near(corners)):
        faults.append("triangles cross")
    volume = sum(dot(t[0], cross(t[1], t[2])) for t in corners)
    return faults, float(fractions.Fraction(volume, 6 * by ** 3))


# --- the trials

def number(value):
    return f"{value:.17f}".rstrip("0").rstrip(".") or "0"


def turned(solid, rng, degrees):
    axis = " ".join(str(rng.randint(1, 9)) + "," for _ in range(3))
    return f"rotate({solid}, {axis} {number(degrees)})"


def some_solid(rng):
    size = lambda: number(round(rng.uniform(0.5, 2), 3))
    return rng.choice([
        lambda: f"box({size()}, {size()}, {size()})",
        lambda: f"sphere({size()}, {rng.randint(6, 16)})",
        lambda: f"cylinder({size()}, {size()}, {rng.randint(5, 16)})",
    ])()


def moved_in(text):
    """How far the program says that it moved something at most."""
    return max([float(m) for m in re.findall(r"by at most ([0-9.e+-]+)\)",
                                             text)], default=0)


def volume_in(text):
    match = re.search(r"volume ([0-9.e+-]+)", text)
    return float(match[1]) if match else 0.0


def check_file(program, path, expected, reach, judge=None):
    """What is wrong with a file whose solid should have this volume."""
    mesh = READERS[path.suffix[1:]](path.read_bytes())
    faults, volume = faults_of(*mesh)
    _, error = run(program, "csg", "A", f"A={path}", "-o",
                   path.with_suffix(".again.off"))
    if error and volume != 0:
        faults.append(error)
    if abs(volume - expected) > reach:
        faults.append(f"volume {volume}, not {expected}")
    if judge and volume != 0:
        if path.suffix == ".3mf":
            path = path.with_suffix(".3mf.off")
            write_off(path, *mesh)
        said = subprocess.run([judge, str(path)], capture_output=True,
                              text=True)
        if said.returncode:
            faults.append(f"the judge: {said.stdout.strip()}")
    return faults


def size_of(path):
    """The greatest extent of a part, and its middle."""
    points, _ = READERS[path.suffix[1:]](path.read_bytes())
    low = [min(p[k] for p in points) for k in range(3)]
    high = [max(p[k] for p in points) for k in range(3)]
    return (max(h - l for l, h in zip(low, high)),
            [(l + h) / 2 for l, h in zip(low, high)])


class Parts:
    """Solids of files, moved to the origin, 2 wide."""

    def __init__(self, program, files, folder):
        self.names, self.solids = {}, []
        for i, file in enumerate(files):
            # Written anew, for the reader here knows one kind of OFF.
            path = folder / f"part{i}.off"
            _, error = run(program, "csg", "P", f"P={file}", "-o", path)
            if error:
                sys.exit(error)
            width, middle = size_of(path)
            # A power of two moves no coordinate.
            scale = 2.0 ** -round(math.log2(width / 2))
            shift = ", ".join(number(-round(c, 3)) for c in middle)
            self.names[f"P{i}"] = path
            self.solids.append(
                f"scale(translate(P{i}, {shift}), {number(scale)})")

    def some(self, rng):
        return rng.choice(self.solids) if self.solids else some_solid(rng)

    def words_of(self, text):
        return [f"{name}={path}" for name, path in self.names.items()
                if re.search(rf"\b{name}\b", text)]


def try_pairs(program, trials, formats, parts, judge, folder):
    """Tries pairs; `trials` is a range of their numbers."""
    failed = collections.Counter()
    for i in trials:
        rng = random.Random(i)
        a = parts.some(rng)
        angle = rng.choice([rng.uniform(1, 89),
                            10.0 ** -rng.randint(3, 12)])
        b = turned(a if rng.random() < 0.6 else parts.some(rng), rng, angle)
        text = f"{turned(a, rng, rng.uniform(0, 90))} " \
               f"{rng.choice(OPERATIONS)} {b}"
        if rng.random() < 0.5:
            text = f"{a} {rng.choice(OPERATIONS)} {b}"
        for name in formats:
            path = folder / f"pair.{name}"
            said, error = run(program, "csg", text, *parts.words_of(text),
                              "-o", path)
            faults = [error] if error else check_file(
                program, path, volume_in(said), 1e-5 + 200 * moved_in(said),
                judge)
            if faults:
                failed[name] += 1
                print(f"pair {i}, {name}: {text}: {'; '.join(faults)}",
                      flush=True)
    for name in formats:
        print(f"pairs through {name}: {len(trials) - failed[name]} of "
              f"{len(trials)}")
    return sum(failed.values())


def try_steps(program, steps, seeds, formats, folder):
    failures = 0
    for seed in range(seeds):
        rng = random.Random(seed)
        bars = []
        for k in range(steps):
            solid = ("translate(box(8, 0.6, 0.5), -4, -0.3, -0.25)"
                     if k % 2 == 0 else
                     "translate(cylinder(0.3, 8, 12), 0, 0, -4)")
            shift = ", ".join(number(round(rng.uniform(-1.5, 1.5), 3))
                              for _ in range(3))
            bar = turned(solid, rng, round(rng.uniform(1, 89), 3))
            bars.append(f"translate({bar}, {shift})")
        block = "translate(box(4, 4, 4), -2, -2, -2)"
        said, error = run(program, "csg", " - ".join([block, *bars]), "-o",
                          folder / "whole.off")
        whole, polygons = volume_in(said), polygons_in(said)
        print(f"seed {seed}, in one run: "
              f"{error or f'{polygons} polygons, volume {whole}'}")
        for name in formats:
            failures += try_chain(program, [block, *bars], name, whole, folder,
                                  seed)
    return failures


def polygons_in(text):
    match = re.search(r"result: (\d+) polygons", text)
    return int(match[1]) if match else 0


def try_chain(program, solids, name, whole, folder, seed):
    path = folder / f"step.{name}"
    moved, said = 0.0, ""
    for k, solid in enumerate(solids):
        text = solid if k == 0 else f"A - {solid}"
        words = [] if k == 0 else [f"A={path}"]
        out = folder / f"next.{name}"
        said, error = run(program, "csg", text, *words, "-o", out)
        if error:
            print(f"seed {seed}, {name}: step {k}: {error}")
            return 1
        moved += moved_in(said)
        out.replace(path)
    volume = volume_in(said)
    faults = check_file(program, path, volume, 1e-5)
    # A surface that moves by so much changes its volume by its area times that.
    if abs(volume - whole) > 1000 * moved + 1e-9:
        faults.append(f"not {whole}")
    print(f"seed {seed}, {name}: {len(solids) - 1} steps, "
          f"{polygons_in(said)} polygons, volume {volume}, moved {moved:.3g}"
          + "".join(f"; {fault}" for fault in faults))
    return 1 if faults else 0


def main():
    parser = argparse.ArgumentParser(
        description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--pairs", type=int, default=20)
    parser.add_argument("--steps", type=int, default=10)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--formats", nargs="+", choices=FORMATS,
                        default=FORMATS)
    parser.add_argument("--parts", nargs="+", default=[])
    parser.add_argument("--judge")
    parser.add_argument("--first", type=int, default=0,
                        help="the number of the first pair")
    arguments = parser.parse_args()
    trials = range(arguments.first, arguments.first + arguments.pairs)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        parts = Parts(arguments.program, arguments.parts, folder)
        failures = try_pairs(arguments.program, trials, arguments.formats,
                             parts, arguments.judge, folder)
        failures += try_steps(arguments.program, arguments.steps,
                              arguments.seeds, arguments.formats, folder)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
