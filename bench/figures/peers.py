#!/usr/bin/env python3
"""Compares figures of halfspace with those of gl2ps and three.js's SVGRenderer.

  peers.py PROGRAM [--gl2ps PEER] [--three FOLDER] [--table FILE.md]

PROGRAM: halfspace; PEER: peer_gl2ps, which HALFSPACE_BENCH_GL2PS=ON builds;
FOLDER: where `npm install three` ran. Who is left out is named in the table. Of each scene of docs/figures/models.py all get the same
triangles, in one orthographic view of 1000 x 1000 pixels, a colour an object.
Wrong: the share of pixels away from edges that show another object's colour.
Seams: the share of such pixels that change with what is behind the figure.
Paths are filled ones; times are of the processor, without reading the file for
the peers and with all of it for halfspace. three.js is told to leave out the
backs of closed objects, as its users do.
Debian: libgl2ps-dev libosmesa6-dev poppler-utils librsvg2-bin nodejs
python3-numpy python3-pil. Exit status: 0 if halfspace has nothing wrong and no
seam.
"""

import argparse
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

import numpy
from PIL import Image

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "docs/figures"))
sys.path.insert(0, str(HERE))
import models  # noqa: E402
from seams import inner  # noqa: E402

SCENES = ("bars", "cubes", "surfaces", "moebius", "vessel")
SIDE = 1000
GROUNDS = {"white": (255, 255, 255), "green": (0, 255, 0)}


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          **options).stdout.decode()


def read_scene(path):
    """The camera's vectors, the vertices and the polygons of a scene file."""
    camera, vertices, polygons = {}, [], []
    for line in path.read_text().split("\n"):
        words = line.split()
        if not words:
            continue
        if words[0] in ("eye", "s0", "sx", "sy"):
            camera[words[0]] = numpy.array(words[1:4], float)
        elif words[0] == "v":
            vertices.append([int(word) for word in words[1:4]])
        elif words[0] == "p":
            polygons.append([int(w) for w in words[1:words.index("color")]])
    return camera, numpy.array(vertices, float), polygons


def seen_vertices(camera, vertices):
    """Vertices in pixels, and their depth: greater is nearer."""
    to_image = numpy.linalg.inv(numpy.column_stack(
        [camera["sx"], camera["sy"], camera["eye"]]))
    # A grid step is 256 of the camera's.
    seen = (vertices * 256 - camera["s0"]) @ to_image.T
    depth = seen[:, 2] * numpy.linalg.norm(camera["eye"]) / \
        numpy.linalg.norm(camera["sx"])
    seen[:, 2] = depth - depth.mean()
    return seen


def parts_of(polygons, vertices):
    """The number of each polygon's part, by common points."""
    parent = {}

    def root(key):
        while parent.setdefault(key, key) != key:
            key = parent[key]
        return key
    names = [tuple(point) for point in vertices]
    for polygon in polygons:
        for corner in polygon[1:]:
            parent[root(names[corner])] = root(names[polygon[0]])
    numbers = {}
    return [numbers.setdefault(root(names[polygon[0]]), len(numbers))
            for polygon in polygons]


def closed_parts(polygons, vertices, parts):
    """By part whether each of its edges is passed once both ways."""
    passed = set()
    names = [tuple(point) for point in vertices]
    for polygon, part in zip(polygons, parts):
        for p, q in zip(polygon, polygon[1:] + polygon[:1]):
            passed.add((part, names[p], names[q]))
    closed = [True] * (max(parts) + 1)
    for part, p, q in passed:
        closed[part] = closed[part] and (part, q, p) in passed
    return closed


def write_triangles(path, seen, polygons, looks, ground):
    """A page that has no colour of its own gets two triangles behind all."""
    lines = []
    far = seen[:, 2].min() - 100
    corners = [(0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE)]
    for k in (1, 2) if ground else ():
        points = [c for p in (corners[0], corners[k], corners[k + 1])
                  for c in (*p, far)]
        lines.append([*points, *ground, 0])
    for polygon, look in zip(polygons, looks):
        for k in range(1, len(polygon) - 1):
            points = [c for v in (polygon[0], polygon[k], polygon[k + 1])
                      for c in seen[v]]
            lines.append([*points, *look])
    path.write_text("\n".join(" ".join(f"{n:.6g}" if isinstance(n, float)
                                       else str(n) for n in line)
                              for line in lines) + "\n")


def rastered(path, ground):
    out = path.with_suffix(".png")
    if path.suffix == ".pdf":
        run("pdftoppm", "-png", "-singlefile", "-scale-to", SIDE, path,
            out.with_suffix(""))
    else:
        run("rsvg-convert", "-w", SIDE, "-h", SIDE, "-b",
            "#%02x%02x%02x" % GROUNDS[ground], path, "-o", out)
    return numpy.asarray(Image.open(out).convert("RGB")).astype(int)


def paths_in(path):
    text = path.read_bytes()
    if path.suffix == ".pdf":
        # gl2ps writes meshes of triangles of 36 bytes, two of them behind.
        return sum(int(length) // 36 for length in re.findall(
            rb"/ShadingType 4.*?/Length (\d+)", text, re.DOTALL)) - 2
    # Of ours each region stands once, and is used again.
    return text.count(b"<path")


class Row:
    def __init__(self, peer, files, seconds, objects, colors):
        images = {name: rastered(path, name) for name, path in files.items()}
        inside = (objects >= 0) & inner_same(objects)
        true = numpy.array(colors)[objects]
        far = numpy.abs(images["white"] - true).max(axis=2) > 48
        nearest = numpy.abs(images["white"][:, :, None] -
                            numpy.array(colors)[None, None]).sum(axis=3)
        other = nearest.argmin(axis=2) != objects
        self.wrong = (inside & far & other).sum() / inside.sum()
        self.seams = (inside & (images["white"] != images["green"])
                      .any(axis=2)).sum() / inside.sum()
        white = files["white"]
        self.cells = [peer, f"{self.wrong:.3%}", f"{self.seams:.3%}",
                      str(paths_in(white)), f"{white.stat().st_size:,}",
                      f"{seconds:.3f} s"]


def inner_same(objects):
    """Where all eight neighbours show the same object."""
    result = numpy.ones(objects.shape, bool)
    for number in numpy.unique(objects):
        mask = objects == number
        result &= ~mask | inner(mask)
    return result


def own_row(program, folder, scene, objects, colors):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    files = {}
    for name, ground in GROUNDS.items():
        files[name] = folder / f"own-{name}.svg"
        run(program, "draw", folder / f"{scene}.off", "--by", "part", "--ortho",
            "--size", f"{SIDE}x{SIDE}", "--background",
            ",".join(map(str, ground)), "-q", "-o", files[name])
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = (after.ru_utime + after.ru_stime - before.ru_utime -
               before.ru_stime) / 2
    return Row("halfspace", files, seconds, objects, colors)


def peer_rows(folder, peers, seen, polygons, objects, colors, looks):
    rows = []
    for name, command, ending in peers:
        files, seconds = {}, 0
        for ground, color in GROUNDS.items():
            triangles = folder / f"{ground}.txt"
            write_triangles(triangles, seen, polygons, looks,
                            color if ending == "pdf" else None)
            files[ground] = folder / f"{name}-{ground}.{ending}"
            words, cwd = command
            seconds = float(run(*words, triangles, files[ground], cwd=cwd))
        rows.append(Row(name, files, seconds, objects, colors))
    return rows


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--gl2ps", type=pathlib.Path)
    parser.add_argument("--three", type=pathlib.Path)
    parser.add_argument("--table", type=pathlib.Path)
    arguments = parser.parse_args()
    program = arguments.program.resolve()
    lines = ["| scene | by | wrong | seams | paths | bytes | time |",
             "|---|---|---|---|---|---|---|"]
    bad = False
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        models.write_all(folder)
        peers = []
        if arguments.gl2ps:
            peers.append(("gl2ps", ([arguments.gl2ps.resolve()], None), "pdf"))
        else:
            lines.insert(0, "Without --gl2ps, so without gl2ps.\n")
        if arguments.three:
            peers.append(("three.js", (["node", HERE / "peer_three.mjs"],
                                       arguments.three), "svg"))
        else:
            lines.insert(0, "Without --three, so without three.js.\n")
        for scene in SCENES:
            mesh = folder / f"{scene}.off"
            view = ["--ortho", "--size", f"{SIDE}x{SIDE}", "-q"]
            run(program, "render", mesh, "--ids", folder / "ids.npy", "-o",
                folder / "ids.png", *view)
            run(program, "scene", mesh, "-o", folder / "v.scene", *view)
            camera, vertices, polygons = read_scene(folder / "v.scene")
            parts = numpy.array(parts_of(polygons, vertices))
            ids = numpy.load(folder / "ids.npy")
            objects = numpy.where(ids < 0, -1, parts[ids])
            colors = palette(parts.max() + 1)
            own = own_row(program, folder, scene, objects, colors)
            bad |= own.wrong > 0 or own.seams > 0
            seen = seen_vertices(camera, vertices)
            closed = closed_parts(polygons, vertices, parts)
            looks = [(*colors[part], int(closed[part])) for part in parts]
            rows = [own] + peer_rows(folder, peers, seen, polygons, objects,
                                     colors, looks)
            for row in rows:
                lines.append(f"| {scene} | " + " | ".join(row.cells) + " |")
                print(lines[-1], flush=True)
    if arguments.table:
        arguments.table.write_text("\n".join(lines) + "\n")
    return 1 if bad else 0


def palette(count):
    """The colours that `draw --fill part` gives the first parts."""
    colors = [(230, 159, 0), (86, 180, 233), (0, 158, 115), (240, 228, 66),
              (0, 114, 178), (213, 94, 0), (204, 121, 167), (153, 153, 153)]
    return [colors[k % len(colors)] for k in range(count)]


if __name__ == "__main__":
    sys.exit(main())
