#!/usr/bin/env python3
"""Makes pictures like those of FAG83 again, with their times.

  demonstrations.py PROGRAM FOLDER [SHARE]

PROGRAM is `halfspace`. The models are made here: an artery and a skull as level
sets of functions, of SHARE of the usual cells each way, three atoms, a small
well, three cubes. Into FOLDER go
fag83-figure-6.png to fag83-figure-10.png, and fag83-figures.csv: polygons, the
tree, milliseconds a frame on one thread, and the frames a second of table 2 of
the paper.
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np


class Model:
    """Polygons with colours, and a number a vertex."""

    def __init__(self):
        self.points, self.faces, self.colors, self.numbers = [], [], [], []

    def add(self, points, faces, color=(236, 214, 184), numbers=None):
        first = len(self.points)
        self.points += [tuple(float(x) for x in p) for p in points]
        self.faces += [tuple(int(i) + first for i in f) for f in faces]
        self.colors += [color] * len(faces)
        self.numbers += list(np.zeros(len(points)) if numbers is None
                             else numbers)

    def write(self, path):
        with open(path, "w", encoding="ascii") as file:
            file.write("ply\nformat ascii 1.0\nelement vertex %d\n"
                       % len(self.points))
            file.write("property float x\nproperty float y\n"
                       "property float z\nproperty float density\n")
            file.write("element face %d\nproperty list uchar int "
                       "vertex_indices\nproperty uchar red\n"
                       "property uchar green\nproperty uchar blue\n"
                       "end_header\n" % len(self.faces))
            for point, number in zip(self.points, self.numbers):
                file.write("%.4f %.4f %.4f %.4f\n" % (*point, number))
            for face, color in zip(self.faces, self.colors):
                file.write("%d %s %d %d %d\n" % (
                    len(face), " ".join(map(str, face)), *color))


# The six tetrahedra round a cube's diagonal; corner k is at the bits of k.
TETRAHEDRA = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7),
              (0, 4, 5, 7), (0, 5, 1, 7)]


def level_set(function, low, high, cells):
    """Vertices and triangles of {function = 0}, outwards where it grows, by
    marching tetrahedra."""
    low, high = np.array(low, float), np.array(high, float)
    count = np.ceil((high - low) / (high - low).max() * cells).astype(int) + 1
    axes = [np.linspace(low[k], high[k], count[k]) for k in range(3)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    values = function(grid[:, 0], grid[:, 1], grid[:, 2])
    values = np.where(values == 0, 1e-9, values)
    index = np.arange(len(grid)).reshape(count)
    corner = [index[i:count[0] - 1 + i, j:count[1] - 1 + j,
                    k:count[2] - 1 + k].ravel()
              for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    cuts = []  # triples of pairs of grid points
    for names in TETRAHEDRA:
        tetra = np.stack([corner[n] for n in names], 1)
        inside = values[tetra] < 0
        number = inside.sum(1)
        for wanted in (1, 2, 3):
            these = tetra[number == wanted]
            if not len(these):
                continue
            order = np.argsort(~inside[number == wanted], 1, kind="stable")
            these = np.take_along_axis(these, order, 1)
            a, b, c, d = these.T
            if wanted == 1:
                cuts.append([(a, b), (a, c), (a, d)])
            elif wanted == 3:
                cuts.append([(a, d), (b, d), (c, d)])
            else:
                cuts.append([(a, c), (a, d), (b, d)])
                cuts.append([(a, c), (b, d), (b, c)])
    pairs = np.concatenate(
        [np.stack([np.stack(p, 1) for p in cut], 1) for cut in cuts])
    keys, vertex = np.unique(np.sort(pairs.reshape(-1, 2), 1), axis=0,
                             return_inverse=True)
    f, g = values[keys[:, 0]], values[keys[:, 1]]
    share = np.clip(f / (f - g), 0.03, 0.97)[:, None]
    points = grid[keys[:, 0]] * (1 - share) + grid[keys[:, 1]] * share
    triangles = vertex.reshape(-1, 3)
    # Outwards: from what is inside to what is outside.
    inner = np.where(values[pairs[:, :, 0]] < 0, pairs[:, :, 0],
                     pairs[:, :, 1])
    outer = np.where(values[pairs[:, :, 0]] < 0, pairs[:, :, 1],
                     pairs[:, :, 0])
    out = (grid[outer] - grid[inner]).sum(1)
    p, q, r = (points[triangles[:, k]] for k in range(3))
    turned = (np.cross(q - p, r - p) * out).sum(1) < 0
    triangles[turned] = triangles[turned][:, ::-1]
    return points, triangles


def smooth_union(a, b, width):
    share = np.clip(0.5 + 0.5 * (b - a) / width, 0, 1)
    return b + (a - b) * share - width * share * (1 - share)


def smooth_difference(a, b, width):
    return -smooth_union(-a, b, width)


def ellipsoid(x, y, z, middle, radii):
    """About the distance from an ellipsoid."""
    u = (x - middle[0]) / radii[0]
    v = (y - middle[1]) / radii[1]
    w = (z - middle[2]) / radii[2]
    return (np.sqrt(u * u + v * v + w * w) - 1) * min(radii)


def tube(x, y, z, way, radii):
    """About the distance from a tube along a polygon of points."""
    nearest = np.full(x.shape, 1e9)
    for (p, q), (r, s) in zip(zip(way, way[1:]), zip(radii, radii[1:])):
        p, q = np.array(p), np.array(q)
        along = q - p
        share = np.clip(((x - p[0]) * along[0] + (y - p[1]) * along[1] +
                         (z - p[2]) * along[2]) / (along @ along), 0, 1)
        distance = np.sqrt((x - p[0] - share * along[0]) ** 2 +
                           (y - p[1] - share * along[1]) ** 2 +
                           (z - p[2] - share * along[2]) ** 2)
        nearest = np.minimum(nearest, distance - (r + share * (s - r)))
    return nearest


def curve(points, steps=24):
    """A smooth way through points (Catmull and Rom 1974)."""
    points = np.array(points, float)
    ends = np.concatenate([[2 * points[0] - points[1]], points,
                           [2 * points[-1] - points[-2]]])
    way = []
    for k in range(len(points) - 1):
        a, b, c, d = ends[k:k + 4]
        for t in np.arange(steps) / steps:
            way.append(0.5 * (2 * b + (c - a) * t +
                              (2 * a - 5 * b + 4 * c - d) * t * t +
                              (3 * b - a - 3 * c + d) * t ** 3))
    return way + [points[-1]]


def artery(share):
    """A carotid artery that parts in two, narrowed beyond the fork."""
    trunk = curve([(0.1, 0, -2.2), (-0.05, 0.05, -1.3), (0.05, 0, -0.5),
                   (0, 0, 0)])
    inner = curve([(0, 0, -0.1), (0.38, 0.1, 0.5), (0.5, 0.2, 1.2),
                   (0.34, 0.1, 2.2)])
    outer = curve([(0, 0, -0.1), (-0.34, -0.08, 0.5), (-0.55, -0.1, 1.2),
                   (-0.6, 0.1, 2.2)])
    def radii(way, first, last, narrow=None):
        t = np.linspace(0, 1, len(way))
        r = first + (last - first) * t
        if narrow:
            at, depth, width = narrow
            r = r * (1 - depth * np.exp(-((t - at) / width) ** 2))
        return r

    def function(x, y, z):
        f = tube(x, y, z, trunk, radii(trunk, 0.34, 0.42))
        g = tube(x, y, z, inner, radii(inner, 0.40, 0.24, (0.42, 0.5, 0.1)))
        h = tube(x, y, z, outer, radii(outer, 0.30, 0.20))
        f = smooth_union(smooth_union(f, g, 0.12), h, 0.12)
        wall = 0.012 * np.sin(9 * z) * np.cos(7 * x + 5 * y)
        f = f + wall
        # Open at the ends, and hollow: a wall.
        hollow = np.maximum(f, -(f + 0.075))
        return np.maximum(hollow, np.abs(z) - 2.05)

    model = Model()
    model.add(*level_set(function, (-1.4, -0.8, -2.2), (1.1, 0.9, 2.2),
                         110 * share), color=(190, 62, 48))
    return model


def skull(share):
    """A skull, with a density that falls from the crown to the hollows."""
    def function(x, y, z):
        ax = np.abs(x)
        f = ellipsoid(x, y, z, (0, 0.18, 0.52), (0.72, 0.92, 0.72))
        face = ellipsoid(x, y, z, (0, -0.36, 0.02), (0.50, 0.42, 0.62))
        f = smooth_union(f, face, 0.16)
        brow = ellipsoid(ax, y, z, (0.21, -0.64, 0.40), (0.23, 0.13, 0.075))
        f = smooth_union(f, brow, 0.10)
        cheek = ellipsoid(ax, y, z, (0.40, -0.54, -0.04), (0.14, 0.20, 0.11))
        f = smooth_union(f, cheek, 0.09)
        arch = ellipsoid(ax, y, z, (0.52, -0.22, -0.01), (0.06, 0.38, 0.055))
        f = smooth_union(f, arch, 0.10)
        jaw = ellipsoid(x, y, z, (0, -0.36, -0.66), (0.43, 0.40, 0.19))
        ramus = ellipsoid(ax, y, z, (0.45, -0.12, -0.42), (0.08, 0.17, 0.42))
        jaw = smooth_union(jaw, ramus, 0.08)
        chin = ellipsoid(x, y, z, (0, -0.68, -0.80), (0.20, 0.12, 0.12))
        jaw = smooth_union(jaw, chin, 0.08)
        throat = ellipsoid(x, y, z, (0, -0.10, -0.72), (0.33, 0.46, 0.42))
        jaw = smooth_difference(jaw, throat, 0.05)
        f = smooth_difference(
            f, ellipsoid(x, y, z, (0, 0.05, -0.55), (0.36, 0.50, 0.42)), 0.05)
        f = smooth_union(f, jaw, 0.03)
        temple = ellipsoid(ax, y, z, (0.80, -0.30, 0.16), (0.17, 0.30, 0.30))
        f = smooth_difference(f, temple, 0.08)
        eye = ellipsoid(ax, y, z, (0.265, -0.80, 0.17), (0.20, 0.34, 0.17))
        f = smooth_difference(f, eye, 0.05)
        nose = ellipsoid(ax, y, z, (0.055, -0.86, -0.15), (0.085, 0.26, 0.17))
        f = smooth_difference(f, nose, 0.03)
        bridge = ellipsoid(x, y, z, (0, -0.77, 0.12), (0.075, 0.12, 0.16))
        f = smooth_union(f, bridge, 0.05)
        # Two rows of teeth on an arc.
        teeth = np.full(x.shape, 1e9)
        for k in range(-6, 7):
            angle = (k + 0.0) * 0.145
            tx, ty = 0.36 * np.sin(angle), -0.36 - 0.42 * np.cos(angle)
            for tz, r in ((-0.42, 0.085), (-0.575, 0.08)):
                teeth = np.minimum(
                    teeth, ellipsoid(x, y, z, (tx, ty, tz), (0.032, 0.04, r)))
        f = smooth_union(f, teeth, 0.02)
        hollow = ellipsoid(x, y, z, (0, 0.30, 0.56), (0.60, 0.72, 0.60))
        return np.maximum(f, -hollow)

    points, triangles = level_set(function, (-0.95, -1.1, -1.05),
                                  (0.95, 1.2, 1.35), 104 * share)
    x, y, z = points.T
    density = np.sqrt((x / 0.78) ** 2 + ((y - 0.10) / 1.0) ** 2 +
                      ((z - 0.12) / 1.25) ** 2)
    model = Model()
    model.add(points, triangles, numbers=density)
    return model


def sphere(middle, radius, meridians, parallels, inwards=False):
    points, faces = [], []
    for j in range(1, parallels):
        for i in range(meridians):
            a = 2 * np.pi * i / meridians
            b = np.pi * j / parallels
            points.append(np.array(middle) + radius * np.array(
                [np.sin(b) * np.cos(a), np.sin(b) * np.sin(a), np.cos(b)]))
    points.append(np.array(middle) + [0, 0, radius])
    points.append(np.array(middle) - [0, 0, radius])
    top, bottom = len(points) - 2, len(points) - 1
    for i in range(meridians):
        n = (i + 1) % meridians
        faces.append((top, i, n))
        last = (parallels - 2) * meridians
        faces.append((bottom, last + n, last + i))
        for j in range(parallels - 2):
            a, b = j * meridians, (j + 1) * meridians
            faces += [(a + i, b + i, b + n), (a + i, b + n, a + n)]
    if inwards:
        faces = [f[::-1] for f in faces]
    return points, faces


def atoms():
    """Three atoms that touch, each with shells round a kernel."""
    model = Model()
    shells = [((-1.05, 0, -0.6), 1.15, (70, 110, 190)),
              ((1.05, 0, -0.6), 1.15, (60, 150, 90)),
              ((0, 0, 1.15), 1.05, (205, 150, 50))]
    for middle, radius, color in shells:
        model.add(*sphere(middle, radius, 48, 24), color=color)
        model.add(*sphere(middle, 0.78 * radius, 48, 24, inwards=True),
                  color=color)
        model.add(*sphere(middle, 0.55 * radius, 40, 20), color=(200, 70, 60))
        model.add(*sphere(middle, 0.36 * radius, 32, 16, inwards=True),
                  color=(200, 70, 60))
        model.add(*sphere(middle, 0.18 * radius, 24, 12),
                  color=(240, 220, 120))
    return model


def revolved(outline, sides, middle=(0, 0), turn=0.5):
    """A solid of revolution: radii and heights from its bottom to its top."""
    points, faces = [], []
    for radius, height in outline:
        for i in range(sides):
            a = 2 * np.pi * (i + turn) / sides
            points.append((middle[0] + radius * np.cos(a),
                           middle[1] + radius * np.sin(a), height))
    for j in range(len(outline) - 1):
        for i in range(sides):
            n = (i + 1) % sides
            a, b = j * sides, (j + 1) * sides
            faces.append((a + i, a + n, b + n, b + i))
    faces.append(tuple(range(sides - 1, -1, -1)))
    last = (len(outline) - 1) * sides
    faces.append(tuple(range(last, last + sides)))
    return points, faces


def well():
    """A rotunda over a well: steps, eight columns, a beam and a dome."""
    model = Model()
    stone, white, slate = (196, 186, 170), (240, 238, 230), (110, 128, 150)
    for k, radius in enumerate((2.05, 1.85, 1.65)):
        model.add(*revolved([(radius, 0.16 * k), (radius, 0.16 * (k + 1))],
                            48), color=stone)
    floor = 0.48
    for k in range(8):
        a = 2 * np.pi * (k + 0.5) / 8
        at = (1.38 * np.cos(a), 1.38 * np.sin(a))
        model.add(*revolved([(0.19, floor), (0.19, floor + 0.06)], 16, at),
                  color=white)
        model.add(*revolved([(0.135, floor + 0.06), (0.13, floor + 0.8),
                             (0.11, floor + 1.62)], 16, at), color=white)
        model.add(*revolved([(0.12, floor + 1.62), (0.19, floor + 1.72),
                             (0.19, floor + 1.78)], 16, at), color=white)
    top = floor + 1.78
    ring = [(1.62, top), (1.62, top + 0.24), (1.74, top + 0.30),
            (1.74, top + 0.36)]
    model.add(*revolved(ring, 48), color=white)
    dome = [(1.6 * np.cos(t), top + 0.36 + 1.0 * np.sin(t))
            for t in np.linspace(0, 1.45, 12)]
    model.add(*revolved(dome, 48), color=slate)
    tip = top + 0.36 + np.sin(1.45)
    model.add(*revolved([(0.14, tip - 0.03), (0.14, tip + 0.12),
                         (0.05, tip + 0.2), (0.09, tip + 0.3),
                         (0.02, tip + 0.45)], 16), color=white)
    # The well itself.
    model.add(*revolved([(0.42, floor), (0.42, floor + 0.55),
                         (0.48, floor + 0.6), (0.48, floor + 0.66)], 32),
              color=stone)
    return model


def cubes():
    """Three cubes that reach into each other, of 216 rectangles."""
    model = Model()
    middles = [(0, 0, 0), (0.75, 0.55, 0.5), (1.35, -0.3, -0.35)]
    colors = [(200, 80, 70), (80, 150, 90), (70, 110, 190)]
    for middle, color in zip(middles, colors):
        for axis in range(3):
            for side in (-1, 1):
                for i in range(6):
                    for j in range(2):
                        u0, u1 = -0.6 + 0.2 * i, -0.4 + 0.2 * i
                        v0, v1 = -0.6 + 0.6 * j, 0.6 * j
                        corners = [(u0, v0), (u1, v0), (u1, v1), (u0, v1)]
                        if side < 0:
                            corners.reverse()
                        points = []
                        for u, v in corners:
                            p = [0, 0, 0]
                            p[axis] = 0.6 * side
                            p[(axis + 1) % 3] = u
                            p[(axis + 2) % 3] = v
                            points.append([a + b for a, b in zip(p, middle)])
                        model.add(points, [(0, 1, 2, 3)], color=color)
    return model


# Figure, its model, how it is rendered, and table 2 of the paper: polygons in
# the tree, frames a second.
FIGURES = [
    ("6", "carotid artery", artery,
     ["--orbit", "-22,10", "--smooth", "70", "--clip", "0,1,0,0.03",
      "--cap", "236,150,140", "--light=-0.5,-0.8,0.7", "--ambient", "0.25"],
     1633, "0.50 - 0.58"),
    ("7", "3 atoms", atoms,
     ["--orbit", "22,22", "--smooth", "60", "--clip", "0.12,1,0,0",
      "--cap", "hatch", "--light=-0.4,-0.8,0.9"], 1440, "1.53 - 1.84"),
    ("8", "Old Well", well,
     ["--orbit", "12,14", "--smooth", "30", "--aa", "4", "--lines",
      "features", "--line-width", "0.75", "--line-color", "90,90,96",
      "--line-crease", "30"],
     356, "1.6 - 2.5"),
    ("9", "skull", skull,
     ["--orbit", "28,8", "--scalar", "density", "--map", "heated",
      "--range", "0.35,1.22", "--legend", "--legend-title", "density",
      "--smooth", "50", "--aa", "4", "--background", "12,12,16",
      "--headlight", "--light=-0.6,-0.5,0.7,0.35"], 2255, "0.40 - 0.48"),
    ("10", "3 cubes", cubes,
     ["--orbit", "35,28", "--aa", "4", "--lines", "features",
      "--line-crease", "10"], 280, "2.46 - 4.81"),
]


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    share = float(sys.argv[3]) if len(sys.argv) == 4 else 1
    folder.mkdir(parents=True, exist_ok=True)
    rows = []
    with tempfile.TemporaryDirectory() as work:
        for figure, name, make, options, polygons, frames in FIGURES:
            model = make(share) if make in (artery, skull) else make()
            path = pathlib.Path(work, "model.ply")
            model.write(path)
            stats = pathlib.Path(work, "stats.json")
            command = [program, "render", str(path), "-o",
                       str(folder / f"fag83-figure-{figure}.png"), "--size",
                       "640x480", "--stats", str(stats), "--threads", "1",
                       "--repeat", "5", "--quiet", *options]
            subprocess.run(command, check=True)
            found = json.loads(stats.read_text(encoding="utf-8"))
            rows.append([figure, name, len(model.faces), found["frame_ms"],
                         polygons, frames])
            print(f"figure {figure}: {name}, {len(model.faces)} polygons, "
                  f"{found['frame_ms']:.1f} ms a frame; 1983: {polygons} "
                  f"polygons, {frames} frames a second", flush=True)
    with open(folder / "fag83-figures.csv", "w", encoding="utf-8",
              newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["figure", "model", "polygons", "ms_a_frame",
                         "polygons_1983", "frames_a_second_1983"])
        for row in rows:
            writer.writerow([*row[:3], f"{row[3]:.1f}", *row[4:]])


if __name__ == "__main__":
    main()
