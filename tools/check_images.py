#!/usr/bin/env python3
"""Draws random hard scenes by itself, and compares them with the program's.

  tools/check_images.py PROGRAM --cases 200
  tools/check_images.py PROGRAM --kind areas --kind rays --seconds 60 --seed 7
  tools/check_images.py PROGRAM --kind caps --case 812 --keep FOLDER

Nothing here is of the libraries: a ray is cast for each sample, in integers,
through planes and edges as a textbook has them; winding numbers are counted
along a ray; areas are those of the cells of an arrangement of lines. The
infinitely small number of S4.4 is one of 2^-200, which is small enough for
scenes of such size. Scenes are small and hard: integers of one digit, eyes on
planes and on corners, coplanar polygons, solids in each other.

Kinds: plain, clips (up to eight planes), caps (of closed solids), samples (2, 4
and 8 each way, clipped and capped, too), areas (exact coverage), objects
(nested, moved by turns, mirrors and scales, in boxes and hulls, with and
without cuts), screens (of four kinds, clipped and capped), rays (hits in
order), picks, and depthsort.

Case N of a kind is the same whatever else is asked for. Exit status: 0 if all
agree, 1 if one differs (its files are kept, and named), 2 for bad usage.
"""

import argparse
import ast
import collections
import fractions
import json
import math
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time
import zlib

F = fractions.Fraction
LATTICE = 256  # lattice units in a grid step (S4.1)
SMALL = 200    # the bits of the infinitely small number


# Vectors of numbers of any kind.

def minus(u, v):
    return (u[0] - v[0], u[1] - v[1], u[2] - v[2])


def plus(u, v):
    return (u[0] + v[0], u[1] + v[1], u[2] + v[2])


def times(k, u):
    return (k * u[0], k * u[1], k * u[2])


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0])


def sign(x):
    return (x > 0) - (x < 0)


def half_up(value):
    return math.floor(value + F(1, 2))


# Scenes.

class Polygon:
    """A convex polygon in the world, in `scale` parts of a lattice unit."""

    def __init__(self, corners, color, holes=()):
        self.corners, self.color, self.holes = corners, color, holes
        a, b = corners[0], None
        for b, c in zip(corners[1:], corners[2:]):
            self.normal = cross(minus(b, a), minus(c, a))
            if self.normal != (0, 0, 0):
                break

    def holds(self, at, below):
        """Whether the point at / below, in its plane, is inside; None if it is
        on an edge."""
        on_edge = False
        for k, a in enumerate(self.corners):
            b = self.corners[(k + 1) % len(self.corners)]
            side = sign(dot(self.normal, cross(minus(b, a), minus(
                at, times(below, a))))) * sign(below)
            if side < 0:
                return False
            on_edge = on_edge or side == 0
        return None if on_edge else True


class Camera:
    def __init__(self, eye, w, s0, sx, sy, width, height, near=None):
        self.eye, self.w, self.s0, self.sx, self.sy = eye, w, s0, sx, sy
        self.width, self.height, self.near = width, height, near

    def scaled(self, k):
        """The same camera where lengths are `k` times as large."""
        eye = times(k, self.eye) if self.w else self.eye
        near = self.near
        if not self.w and near is not None:
            near *= k
        return Camera(eye, self.w, times(k, self.s0), times(k, self.sx),
                      times(k, self.sy), self.width, self.height, near)

    def ray(self, x, y, below):
        """Origin and direction at the image point (x, y) / below, both times
        `below`, and what a parameter of them is to be multiplied by."""
        s = plus(times(below, self.s0), plus(times(x, self.sx),
                                             times(y, self.sy)))
        if self.w:
            return times(below, self.eye), minus(s, times(below, self.eye)), 1
        return s, times(-1, self.eye), F(1, below)

    def is_seen(self, t):
        """Whether a ray parameter is beyond the near distance."""
        if self.w:
            return t > F(self.near or 0, 2**16)
        return self.near is None or t > F(self.near, 2**16)


class Scene:
    def __init__(self, polygons, camera, scale, background=(255, 255, 255)):
        self.polygons, self.camera, self.scale = polygons, camera, scale
        self.background = background
        self.clips, self.caps, self.cull = [], None, False
        self.parts, self.styles = [], []

    def clip_value(self, clip, at, below):
        """A clip plane's value at the point at / below, times what is
        positive."""
        a, b, c, d = clip
        value = dot((a, b, c), at) + d * below * LATTICE * self.scale
        return value * sign(below)

    def windings(self, at, clip):
        """The winding numbers of parts at the point, moved a little to the kept
        side of the clip plane that it is in."""
        chance = random.Random(str(at))
        while True:
            way = tuple(chance.randint(-10**6, 10**6) for _ in range(3))
            if dot(way, clip[:3]) <= 0:
                continue
            counts = dict.fromkeys(self.parts or [0], 0)
            for number, polygon in enumerate(self.polygons):
                speed = dot(polygon.normal, way)
                if speed == 0:
                    break
                t = dot(polygon.normal, minus(polygon.corners[0], at)) / F(
                    speed)
                if t <= 0:
                    continue
                inside = polygon.holds(plus(at, times(t, way)), 1)
                if inside is None:
                    break
                if inside:
                    part = self.parts[number] if self.parts else 0
                    counts[part] += 1 if speed > 0 else -1
            else:
                return counts

    def seen(self, x, y, below):
        """What the ray of the image point (x, y) / below meets first."""
        origin, way, unit = self.camera.ray(x, y, below)
        scale = below  # of origin
        best, item = None, -1
        for number, polygon in enumerate(self.polygons):
            speed = dot(polygon.normal, way)
            if speed == 0 or (self.cull and speed > 0):
                continue
            # p = origin / scale + t way / scale in perspective, where the way
            # was multiplied too; without it the way is as it is.
            step = scale if self.camera.w else 1
            t = F(dot(polygon.normal, minus(times(scale, polygon.corners[0]),
                                            origin)) * step, speed * scale)
            if not self.camera.is_seen(t) or (best is not None and t >= best):
                continue
            down = t.denominator * scale * step
            at = plus(times(t.denominator * step, origin),
                      times(t.numerator * scale, way))
            inside = polygon.holds(at, down)
            assert inside is not None, "a sample on an edge"
            if not inside or any(hole.holds(at, down)
                                 for hole in polygon.holes):
                continue
            if not self.is_left(polygon, at, down):
                continue
            best, item = t, number
        if self.caps:
            for k, clip in enumerate(self.clips):
                t, part = self.cap_at(k, clip, origin, way, scale)
                if t is not None and (best is None or t < best):
                    best, item = t, len(self.polygons) + k + 16 * part
        return item

    def is_left(self, polygon, at, down):
        """Whether clip planes leave the polygon at a point of it."""
        for clip in self.clips:
            in_plane = all(
                self.clip_value(clip, p, 1) == 0 for p in polygon.corners)
            if in_plane and self.caps:
                return False
            if not in_plane and self.clip_value(clip, at, down) < 0:
                return False
        return True

    def cap_at(self, k, clip, origin, way, scale):
        """The ray parameter of the plane's cap, if the ray meets it, and the
        part that it is of, or how many there are where it is of several."""
        speed = dot(clip[:3], way)
        if speed == 0 or (self.cull and speed < 0):
            return None, 0
        step = scale if self.camera.w else 1
        height = dot(clip[:3], origin) + clip[3] * LATTICE * self.scale * scale
        t = F(-height * step, speed * scale)
        if not self.camera.is_seen(t) or (self.camera.w and t <= 0):
            return None, 0
        at = tuple(F(o, scale) + t * F(w, step) for o, w in zip(origin, way))
        for other, plane in enumerate(self.clips):
            if other != k and self.clip_value(plane, at, 1) <= 0:
                return None, 0
        windings = self.windings(at, clip)
        if sum(windings.values()) <= 0:
            return None, 0
        if not self.parts:
            return t, 0
        inside = [part for part, winding in windings.items() if winding > 0]
        return t, inside[0] if len(inside) == 1 else len(self.styles) - 1

    def color(self, item, x, y):
        """The colour of an item at the point (x, y) of the image."""
        if item < 0:
            return self.background
        if item < len(self.polygons):
            return self.polygons[item].color
        k = item - len(self.polygons)
        part, period = k // 16, 8
        solid, hatch = self.styles[part] if self.parts else self.caps
        is_several = bool(self.parts) and part == len(self.styles) - 1
        values = [x + y - F(1, 2), x - y + F(1, 2)]
        if not is_several:
            values = values[(k + part) % 2:][:1]
            period = 16 if part % 4 > 1 else 8
        if hatch and any(value % period < 2 for value in values):
            return hatch
        return solid

    def image(self, samples=1):
        """Items by rows of samples, and colours by rows of pixels."""
        camera = self.camera
        two = 2 * samples
        below = two << 2 * SMALL
        items = []
        for row in range(camera.height * samples):
            items.append([])
            y = ((2 * row + 1) << 2 * SMALL) + two
            for column in range(camera.width * samples):
                x = ((2 * column + 1) << 2 * SMALL) + (two << SMALL)
                items[-1].append(self.seen(x, y, below))
        colors = []
        for j in range(camera.height):
            for i in range(camera.width):
                sums = [0, 0, 0]
                for b in range(j * samples, (j + 1) * samples):
                    for a in range(i * samples, (i + 1) * samples):
                        color = self.color(items[b][a], F(2 * a + 1, two),
                                           F(2 * b + 1, two))
                        sums = [s + c for s, c in zip(sums, color)]
                colors.append(tuple(half_up(F(s, samples * samples))
                                    for s in sums))
        return items, colors

    # Areas.

    def lines(self):
        """The lines of the image on whose sides the same is seen: (a, b, c)."""
        camera, lines = self.camera, set()

        def add(value):
            """The line where an affine function of the image point is 0, by
            its values at (0, 0), (1, 0) and (0, 1)."""
            c, x, y = value(0, 0), value(1, 0), value(0, 1)
            a, b = x - c, y - c
            if (a, b) == (0, 0):
                return
            lead = a if a != 0 else b
            lines.add((F(a) / lead, F(b) / lead, F(c) / lead))

        def point(x, y):
            return plus(camera.s0, plus(times(x, camera.sx),
                                        times(y, camera.sy)))

        def through(a, b):
            """The plane through the eye and two points."""
            normal = (cross(minus(a, camera.eye), minus(b, camera.eye))
                      if camera.w else cross(minus(b, a), camera.eye))
            add(lambda x, y: dot(normal, minus(point(x, y), a)))

        planes = []
        for polygon in self.polygons:
            for k, a in enumerate(polygon.corners):
                through(a, polygon.corners[(k + 1) % len(polygon.corners)])
            planes.append((polygon.normal,
                           -dot(polygon.normal, polygon.corners[0])))
        for a, b, c, d in self.clips:
            planes.append(((a, b, c), d * LATTICE * self.scale))
        # Where two planes meet: there depths are equal, clips cut polygons,
        # caps end and winding numbers change.
        def value_at(plane, p, w):
            return dot(plane[0], p) + plane[1] * w
        eyes = [value_at(plane, camera.eye, camera.w) for plane in planes]
        for i, p in enumerate(planes):
            for j in range(i):
                add(lambda x, y, p=p, q=planes[j], pe=eyes[i], qe=eyes[j]:
                    pe * value_at(q, point(x, y), 1) -
                    qe * value_at(p, point(x, y), 1))
            if camera.near is not None and eyes[i] != 0:
                k = camera.near
                add(lambda x, y, p=p, pe=eyes[i]:
                    (2**16 - k) * pe + k * value_at(p, point(x, y), 1)
                    if camera.w else
                    2**16 * value_at(p, point(x, y), 1) - k * pe)
        if self.caps and any(h for _, h in [self.caps] + self.styles):
            for k in range(-camera.height - 8, camera.width + camera.height):
                for edge in (0, 2):
                    at = F(8 * (k // 8) + edge)
                    lines.add((F(1), F(1), -at - F(1, 2)))
                    lines.add((F(1), F(-1), -at + F(1, 2)))
        return lines

    def areas(self):
        """The colours of pixels, each the integral over what is seen in it."""
        lines = self.lines()
        colors = []
        for j in range(self.camera.height):
            for i in range(self.camera.width):
                cells = [[(F(i), F(j)), (F(i + 1), F(j)), (F(i + 1), F(j + 1)),
                          (F(i), F(j + 1))]]
                for line in lines:
                    cells = [part for cell in cells
                             for part in cut(cell, line)]
                sums = [F(0)] * 3
                for cell in cells:
                    size, (x, y) = area(cell)
                    below = x.denominator * y.denominator
                    item = self.seen(x.numerator * y.denominator,
                                     y.numerator * x.denominator, below)
                    color = self.color(item, x, y)
                    sums = [s + size * c for s, c in zip(sums, color)]
                colors.append(tuple(half_up(s) for s in sums))
        return colors


def cut(cell, line):
    """The parts of a convex cell on both sides of a line."""
    a, b, c = line
    values = [a * x + b * y + c for x, y in cell]
    if all(v >= 0 for v in values) or all(v <= 0 for v in values):
        return [cell]
    parts = [[], []]
    for k, (p, v) in enumerate(zip(cell, values)):
        q, w = cell[(k + 1) % len(cell)], values[(k + 1) % len(cell)]
        if v >= 0:
            parts[0].append(p)
        if v <= 0:
            parts[1].append(p)
        if v * w < 0:
            t = v / (v - w)
            meet = (p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]))
            parts[0].append(meet)
            parts[1].append(meet)
    return parts


def area(cell):
    """Area and an inner point of a convex cell."""
    x0, y0 = cell[0]
    twice = F(0)
    for (ax, ay), (bx, by) in zip(cell[1:], cell[2:]):
        twice += (ax - x0) * (by - y0) - (ay - y0) * (bx - x0)
    n = len(cell)
    return abs(twice) / 2, (sum(p[0] for p in cell) / n,
                            sum(p[1] for p in cell) / n)


# Random scenes. All numbers are grid steps; the program's files get them.

class Given:
    """Vertices, polygons and a camera as a .scene file has them."""

    def __init__(self, chance):
        self.chance = chance
        self.vertices, self.polygons, self.colors = [], [], []
        self.part_of = []  # by polygon, of solids

    def add(self, corners):
        first = len(self.vertices)
        self.vertices += corners
        self.polygons.append(list(range(first, first + len(corners))))
        self.colors.append(tuple(
            self.chance.randrange(256) for _ in range(3)))

    def small(self, most):
        return self.chance.randint(-most, most)

    def point(self, most):
        return tuple(self.small(most) for _ in range(3))

    def add_random(self):
        """A triangle or a parallelogram, maybe in the plane of another."""
        kind = self.chance.randrange(4)
        while True:
            if kind == 0 and self.polygons:
                # In the plane of another polygon, with a corner in common.
                other = [self.vertices[v]
                         for v in self.chance.choice(self.polygons)]
                a = other[0]
                u, v = minus(other[1], a), minus(other[2], a)
                corners = [plus(a, plus(times(self.small(2), u),
                                        times(self.small(2), v)))
                           for _ in range(3)]
            elif kind == 1:
                # Across an axis.
                axis, at = self.chance.randrange(3), self.small(3)
                corners = [list(self.point(4)) for _ in range(3)]
                for corner in corners:
                    corner[axis] = at
                corners = [tuple(corner) for corner in corners]
            else:
                corners = [self.point(4) for _ in range(3)]
            a, b, c = corners
            if cross(minus(b, a), minus(c, a)) == (0, 0, 0):
                kind = self.chance.randrange(1, 4)
                continue
            if self.chance.randrange(3) == 0:
                corners = [a, b, plus(b, minus(c, a)), c]
            self.add(corners)
            return

    def add_solid(self):
        """A box or a tetrahedron, faces outwards."""
        if self.chance.randrange(3):
            low = self.point(3)
            high = plus(low, tuple(self.chance.randint(1, 4)
                                   for _ in range(3)))
            p = [(x, y, z) for z in (low[2], high[2])
                 for y in (low[1], high[1]) for x in (low[0], high[0])]
            for face in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4),
                         (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
                self.add([p[k] for k in face])
            return
        while True:
            p = [self.point(4) for _ in range(4)]
            volume = dot(cross(minus(p[1], p[0]), minus(p[2], p[0])),
                         minus(p[3], p[0]))
            if volume == 0:
                continue
            if volume < 0:
                p[0], p[1] = p[1], p[0]
            for face in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)):
                self.add([p[k] for k in face])
            return

    def add_camera(self, width, height):
        """Looks at the origin from a point of the grid, or of a polygon."""
        chance = self.chance
        while True:
            w = 0 if chance.randrange(4) == 0 else 1
            eye = self.point(9)
            if w and self.vertices and chance.randrange(4) == 0:
                eye = chance.choice(self.vertices)
            if w and chance.randrange(5) == 0:
                a, b = (chance.choice(self.vertices or [(1, 2, 3)])
                        for _ in range(2))
                eye = plus(a, times(2, minus(a, b)))
            target = self.point(1)
            ahead = minus(target, eye) if w else times(-1, eye)
            across = cross(ahead, self.point(2))
            if ahead == (0, 0, 0) or across == (0, 0, 0):
                continue
            down = cross(ahead, across)

            def long(v, length):
                size = max(abs(x) for x in v)
                return tuple(int(length * x / size) for x in v)
            wide = chance.choice((4, 9, 14)) * LATTICE
            sx = long(across, wide // width)
            sy = long(down, wide // width)
            middle = times(LATTICE, target)
            if chance.randrange(2):
                sx, sy = times(16, tuple(x // 16 for x in sx)), times(
                    16, tuple(x // 16 for x in sy))
            corner = minus(middle, plus(times(width // 2, sx),
                                        times(height // 2, sy)))
            lattice_eye = times(LATTICE, eye)
            span = minus(corner, lattice_eye) if w else lattice_eye
            if dot(cross(sx, sy), span) == 0:
                continue
            near = None
            if chance.randrange(4) == 0:
                near = chance.choice((2**14, 2**15, 2**16, 3 * 2**14))
            self.camera = Camera(lattice_eye, w, corner, sx, sy, width, height,
                                 near)
            return

    def text(self, clips=(), caps=None, cull=False, parts=(), styles=()):
        lines = ["halfspace-scene 1", "unit 2 0", "grid 26"]
        lines += ["v %d %d %d" % v for v in self.vertices]
        for polygon, color in zip(self.polygons, self.colors):
            lines.append("p %s color %d %d %d" % (
                (" ".join(map(str, polygon)),) + color))
        c = self.camera
        lines += ["eye %d %d %d %d" % (c.eye + (c.w,)), "s0 %d %d %d" % c.s0,
                  "sx %d %d %d" % c.sx, "sy %d %d %d" % c.sy,
                  "size %d %d" % (c.width, c.height)]
        if c.near is not None:
            lines.append("near %d" % c.near)
        if cull:
            lines.append("cull")
        lines += ["clip %d %d %d %d" % clip for clip in clips]
        if caps:
            for word, (solid, hatch) in [("caps", caps)] + [
                    ("cap", style) for style in styles]:
                lines.append(word + " %d %d %d" % solid + (
                    " hatch %d %d %d" % hatch if hatch else ""))
            lines += ["part %d %d 1" % (part, k)
                      for k, part in enumerate(parts)]
        return "\n".join(lines + ["end", ""])

    def corners(self, scale=1):
        return [[times(LATTICE * scale, self.vertices[v]) for v in polygon]
                for polygon in self.polygons]

    def scene(self):
        return Scene([Polygon(corners, color) for corners, color in
                      zip(self.corners(), self.colors)], self.camera, 1)


def some_clips(chance, given, count):
    """Different planes, some of them through corners or faces."""
    clips = []
    while len(clips) < count:
        normal = tuple(chance.randint(-2, 2) for _ in range(3))
        if chance.randrange(2):
            axis = chance.randrange(3)
            normal = tuple(chance.choice((-1, 1)) if k == axis else 0
                           for k in range(3))
        if chance.randrange(5) == 0 and given.polygons:
            a, b, c = (given.vertices[v]
                       for v in chance.choice(given.polygons)[:3])
            normal = cross(minus(b, a), minus(c, a))
        if normal == (0, 0, 0):
            continue
        at = chance.choice(given.vertices)
        if chance.randrange(3) == 0:
            at = given.point(3)
        clip = normal + (-dot(normal, at),)
        share = math.gcd(*clip)
        clip = tuple(x // share for x in clip)
        if clip not in clips:
            clips.append(clip)
    return clips


# What the program says.

def run(program, arguments, folder):
    done = subprocess.run([program] + arguments, cwd=folder, text=True,
                          capture_output=True)
    if done.returncode != 0:
        raise Differs("%s: status %d: %s" % (" ".join(arguments),
                                             done.returncode, done.stderr))
    return done.stdout


def read_npy(path):
    raw = path.read_bytes()
    size = int.from_bytes(raw[8:10], "little")
    shape = ast.literal_eval(raw[10:10 + size].decode())["shape"]
    numbers = memoryview(raw)[10 + size:].cast("i").tolist()
    return [numbers[r * shape[1]:(r + 1) * shape[1]] for r in range(shape[0])]


def read_png(path):
    """The pixels of a PNG of 8 bits a channel, without alpha."""
    raw, at, data = path.read_bytes(), 8, b""
    while at < len(raw):
        size, kind = int.from_bytes(raw[at:at + 4], "big"), raw[at + 4:at + 8]
        body = raw[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height = (int.from_bytes(body[k:k + 4], "big")
                             for k in (0, 4))
            channels = {0: 1, 2: 3, 3: 1}[body[9]]
            palette = None
            assert body[8] == 8
        if kind == b"PLTE":
            palette = [tuple(body[k:k + 3]) for k in range(0, size, 3)]
        if kind == b"IDAT":
            data += body
        at += size + 12
    data, line = zlib.decompress(data), [0] * (width * channels)
    pixels, step = [], width * channels + 1
    for row in range(height):
        filter_, now = data[row * step], []
        for k, byte in enumerate(data[row * step + 1:(row + 1) * step]):
            left = now[k - channels] if k >= channels else 0
            above = line[k]
            corner = line[k - channels] if k >= channels else 0
            guess = left + above - corner
            nearest = min((left, above, corner),
                          key=lambda v: abs(guess - v))
            now.append((byte + (0, left, above, (left + above) // 2,
                                nearest)[filter_]) % 256)
        line = now
        for k in range(0, len(now), channels):
            if palette:
                pixels.append(palette[now[k]])
            else:
                pixels.append(tuple(now[k:k + 3]) if channels == 3
                              else (now[k],) * 3)
    return pixels


class Differs(Exception):
    pass


def compare(expected, found, what):
    if expected == found:
        return
    places = [k for k, (a, b) in enumerate(zip(expected, found)) if a != b]
    raise Differs("%s: %d differ, first number %d: %s in place of %s" % (
        what, len(places) or 1, places[0] if places else -1,
        found[places[0]] if places else len(found),
        expected[places[0]] if places else len(expected)))


def flat(rows):
    return [item for row in rows for item in row]


# Kinds: each makes a case in a folder, and returns how many numbers it
# compared.

def check_render(program, folder, scene, name, options, samples=1):
    items, colors = scene.image(samples)
    run(program, ["render", name, "-q", "-o", "a.png", "--ids", "a.npy"] +
        options, folder)
    compare(flat(items), flat(read_npy(folder / "a.npy")), "items")
    compare(colors, read_png(folder / "a.png"), "colours")
    return len(flat(items))


def random_given(chance, solids, width=9, height=7):
    given = Given(chance)
    for k in range(chance.randint(1, 3) if solids else chance.randint(1, 9)):
        given.add_solid() if solids else given.add_random()
        given.part_of += [k] * (len(given.polygons) - len(given.part_of))
    given.add_camera(width, height)
    return given


def random_style(chance):
    """Of caps: a colour, and maybe one of hatching."""
    return (tuple(chance.randrange(256) for _ in range(3)),
            chance.choice((None, (9, 200, 40))))


def write_section(chance, folder, solids, size, clips=True):
    """A scene, clipped, and capped if of solids."""
    given = random_given(chance, solids, *size)
    scene = given.scene()
    if clips:
        scene.clips = some_clips(chance, given, chance.choice((1, 1, 2, 3, 8)))
    scene.cull = chance.randrange(4) == 0
    if solids and clips:
        scene.caps = random_style(chance)
        if chance.randrange(2):
            scene.parts = given.part_of
            scene.styles = [random_style(chance)
                            for _ in range(scene.parts[-1] + 2)]
    (folder / "a.scene").write_text(
        given.text(scene.clips, scene.caps, scene.cull, scene.parts,
                   scene.styles))
    return given, scene


def plain(program, folder, chance):
    _, scene = write_section(chance, folder, False, (9, 7), False)
    method = chance.choice(("span", "painter"))
    return check_render(program, folder, scene, "a.scene",
                        ["--method", method])


def clips(program, folder, chance):
    _, scene = write_section(chance, folder, False, (9, 7))
    method = chance.choice(("span", "painter"))
    return check_render(program, folder, scene, "a.scene",
                        ["--method", method])


def caps(program, folder, chance):
    _, scene = write_section(chance, folder, True, (9, 7))
    method = chance.choice(("span", "painter"))
    return check_render(program, folder, scene, "a.scene",
                        ["--method", method])


def screens(program, folder, chance):
    _, scene = write_section(chance, folder, chance.randrange(2) == 0, (7, 5),
                             chance.randrange(4) != 0)
    compared = 0
    for kind in ("list", "bsp1", "quad", "bsp2"):
        compared += check_render(program, folder, scene, "a.scene",
                                 ["--screen", kind])
    return compared


def depthsort(program, folder, chance):
    _, scene = write_section(chance, folder, False, (9, 7),
                             chance.randrange(3) == 0)
    method = chance.choice(("span", "painter"))
    return check_render(program, folder, scene, "a.scene",
                        ["--priority", "depthsort", "--method", method])


def samples(program, folder, chance):
    _, scene = write_section(chance, folder, chance.randrange(2) == 0, (4, 3),
                             chance.randrange(3) != 0)
    each = chance.choice((2, 2, 4, 8))
    if each == 8:
        scene.camera.width = scene.camera.height = 2
        text = (folder / "a.scene").read_text().replace("size 4 3", "size 2 2")
        (folder / "a.scene").write_text(text)
    return check_render(program, folder, scene, "a.scene",
                        ["--aa", str(each)], each)


def areas(program, folder, chance):
    given = Given(chance)
    solids = chance.randrange(3) == 0
    for _ in range(1 if solids else chance.randint(1, 4)):
        given.add_solid() if solids else given.add_random()
    given.add_camera(4, 3)
    scene = given.scene()
    if chance.randrange(2) == 0:
        scene.clips = some_clips(chance, given, 1)
        if solids:
            scene.caps = ((10, 20, 230), chance.choice((None, (9, 200, 40))))
    (folder / "a.scene").write_text(given.text(scene.clips, scene.caps))
    run(program, ["render", "a.scene", "-q", "-o", "a.png", "--aa", "exact"],
        folder)
    compare(scene.areas(), read_png(folder / "a.png"), "areas")
    return 12


def picks(program, folder, chance):
    given, scene = write_section(chance, folder, chance.randrange(2) == 0,
                                 (5, 4), chance.randrange(2) == 0)
    items, _ = scene.image()
    for _ in range(3):
        x, y = chance.randrange(5), chance.randrange(4)
        said = json.loads(run(program, ["pick", "a.scene", "--json", "--at",
                                        "%d,%d" % (x, y)], folder))
        hits = said["hits"]
        found = -1
        if hits and "polygon" in hits[0]:
            found = hits[0]["polygon"]
        elif hits:
            part = hits[0].get("part", 0)
            if part == "several":
                part = scene.parts[-1] + 1
            found = (len(scene.polygons) + hits[0]["cap_of_clip_plane"] +
                     16 * part)
        compare([items[y][x]], [found], "pick")
    return 3


def rays(program, folder, chance):
    given = Given(chance)
    for _ in range(chance.randint(1, 9)):
        if chance.randrange(4):
            given.add_random()
        else:
            given.add_solid()
    given.add_camera(4, 3)
    (folder / "a.scene").write_text(given.text())
    polygons = [Polygon(corners, None) for corners in given.corners()]
    compared = 0
    for _ in range(4):
        origin = given.point(6)
        if chance.randrange(2):
            origin = chance.choice(given.vertices)
        end = given.point(6)
        if chance.randrange(2):
            end = chance.choice(given.vertices)
        way = minus(end, origin)
        if way == (0, 0, 0):
            continue
        reach = chance.choice(("--to", "--along"))
        hits = []
        for number, polygon in enumerate(polygons):
            speed = dot(polygon.normal, way)
            if speed == 0:
                continue
            t = F(dot(polygon.normal, minus(polygon.corners[0], times(
                LATTICE, origin))), speed * LATTICE)
            if t < 0 or (reach == "--to" and t > 1):
                continue
            at = tuple(LATTICE * (o + t * w) for o, w in zip(origin, way))
            if polygon.holds(at, 1) is not False:
                hits.append((t, number))
        hits.sort()
        last = end if reach == "--to" else way
        said = json.loads(run(
            program, ["pick", "a.scene", "--json", "--all",
                      "--from=%d,%d,%d" % origin,
                      reach + "=%d,%d,%d" % last], folder))
        found = [(F(hit["parameter"]), hit["polygon"])
                 for hit in said["hits"]]
        compare(hits, found, "hits")
        hidden = any(0 < t < 1 for t, _ in hits) if reach == "--to" else None
        if hidden is not None:
            said = run(program, ["pick", "a.scene",
                                 "--from=%d,%d,%d" % origin,
                                 "--sees=%d,%d,%d" % end], folder)
            compare([hidden], ["hidden" in said], "visibility")
        compared += 1 + len(hits)
    return compared


# Objects: (M p + t) / 2^shift with entries that doubles hold exactly.

TURNS = (((1, 0, 0), 0), ((1, 0, 0), 90), ((0, 1, 0), 180), ((0, 0, 1), -90),
         ((0, 0, 1), 270))


def turned(axis, degrees, p):
    for _ in range(degrees // 90 % 4):
        p = plus(cross(axis, p), times(dot(axis, p), axis))
    return p


class Placed:
    """An object: a model's polygons, its own objects, and how it stands."""

    def __init__(self, chance, name):
        self.name = name
        self.model = Given(chance)
        for _ in range(chance.randint(1, 4)):
            self.model.add_random()
        self.axis, self.degrees = chance.choice(TURNS)
        self.scale = chance.choice((F(1), F(1, 2), F(3, 4), F(-1), F(2)))
        self.move = tuple(F(chance.randint(-40, 40), 8) for _ in range(3))
        self.inner = []
        self.is_there = chance.randrange(8) != 0

    def moved(self, p):
        return plus(times(self.scale, turned(self.axis, self.degrees, p)),
                    self.move)

    def corners(self):
        """All that its region has to hold, in its owner."""
        own = [self.moved(p) for p in self.model.vertices]
        for inner in self.inner:
            own += [self.moved(p) for p in inner.region]
        return own

    def choose_region(self, chance):
        """A box or a tetrahedron that holds it."""
        corners = self.corners()
        low = tuple(math.floor(min(p[k] for p in corners)) - 1
                    for k in range(3))
        high = tuple(math.ceil(max(p[k] for p in corners)) + 1
                     for k in range(3))
        self.is_hull = chance.randrange(2) == 0
        if self.is_hull:
            size = math.floor(max(sum(p) for p in corners)) + 1 - sum(low)
            ends = [tuple(low[k] + (size if k == axis else 0)
                          for k in range(3)) for axis in range(3)]
            self.region = [low] + ends
            high = plus(low, (size, size, size))
        else:
            self.region = [(x, y, z) for x in (low[0], high[0])
                           for y in (low[1], high[1])
                           for z in (low[2], high[2])]
        self.box = low, high

    def shift(self, by):
        """Moves it, and its region, along x."""
        self.move, *self.region = [plus(p, (by, 0, 0))
                                   for p in [self.move] + self.region]
        self.box = tuple(plus(p, (by, 0, 0)) for p in self.box)

    def hull_faces(self):
        """Planes of the region, positive inside, as (normal, point)."""
        if self.is_hull:
            p = self.region
            faces = [((1, 0, 0), p[0]), ((0, 1, 0), p[0]), ((0, 0, 1), p[0]),
                     ((-1, -1, -1), p[1])]
        else:
            low, high = self.box
            faces = []
            for axis in range(3):
                unit = tuple(int(k == axis) for k in range(3))
                faces += [(unit, low), (times(-1, unit), high)]
        return faces

    def line(self, owner):
        words = ["object", self.name, "m" + self.name]
        if owner:
            words += ["in", "m" + owner]
        words += ["region"] + [
            "%d,%d,%d" % p for p in (self.region if self.is_hull else self.box)]
        words += ["move", ",".join(repr(float(x)) for x in self.move),
                  "scale", repr(float(self.scale)),
                  "turn", "%d,%d,%d,%d" % (self.axis + (self.degrees,)),
                  "there", "yes" if self.is_there else "no"]
        return " ".join(words)


class Hole:
    """The inside of a region, moved to the world."""

    def __init__(self, faces):
        self.faces = faces  # (normal, point) in the world's parts

    def holds(self, at, below):
        return all(dot(normal, minus(at, times(below, p))) * sign(below) > 0
                   for normal, p in self.faces)


def objects(program, folder, chance):
    world = Given(chance)
    for _ in range(chance.randint(1, 5)):
        world.add_random()
    tops = []
    for k in range(chance.randint(1, 3)):
        top = Placed(chance, "o%d" % k)
        if chance.randrange(2) == 0:
            inner = Placed(chance, "o%di" % k)
            inner.choose_region(chance)
            top.inner.append(inner)
        top.choose_region(chance)
        # Beside the others along x, so that regions share no space.
        if tops:
            top.shift(tops[-1].box[1][0] - top.box[0][0] +
                      chance.randrange(2))
        tops.append(top)
    target = chance.choice(tops)
    world.add_camera(9, 7)
    if chance.randrange(3):
        # Looks at an object.
        middle = times(LATTICE, tuple(
            (a + b) // 2 for a, b in zip(*target.box)))
        c = world.camera
        c.s0 = plus(c.s0, middle)
        if c.w:
            c.eye = plus(c.eye, middle)
    lines = ["halfspace-objects 1", "cut", "world w.scene"]
    (folder / "w.scene").write_text(world.text())
    for top in tops:
        for placed in [top] + top.inner:
            placed.model.camera = world.camera
            (folder / (placed.name + ".scene")).write_text(
                placed.model.text())
            lines.append("model m%s %s.scene" % (placed.name, placed.name))
    for top in tops:
        lines.append(top.line(None))
        lines += [inner.line(top.name) for inner in top.inner]
    (folder / "a.objects").write_text("\n".join(lines) + "\n")
    # The moved polygons, in 64 parts of a lattice unit.
    scale = 1024
    polygons = []

    def take(given, regions, maps):
        def world_of(p):
            for mapped in reversed(maps):
                p = mapped.moved(p)
            whole = times(LATTICE * scale, p)
            assert all(x == int(x) for x in whole)
            return tuple(int(x) for x in whole)
        flips = sum(m.scale < 0 for m in maps) % 2
        holes = []
        for placed in regions:
            faces = []
            for normal, p in placed.hull_faces():
                # Three points of the face, moved.
                u = cross(normal, (1, 2, 5))
                v = cross(normal, u)
                a, b, c = (world_of(q) for q in (
                    p, plus(p, u), plus(p, v)))
                # Right-handed about the normal, but where maps mirror.
                n = cross(minus(b, a), minus(c, a))
                if flips:
                    n = times(-1, n)
                faces.append((n, a))
            holes.append(Hole(faces))
        for polygon, color in zip(given.polygons, given.colors):
            corners = [world_of(given.vertices[v]) for v in polygon]
            if flips:
                corners.reverse()
            polygons.append(Polygon(corners, color, holes))

    def place(given, regions, maps, there):
        if there:
            take(given, regions, maps)
        else:
            polygons.extend([None] * len(given.polygons))
        for placed in regions:
            place(placed.model, placed.inner, maps + [placed],
                  there and placed.is_there)

    place(world, tops, [], True)
    ids = [k for k, polygon in enumerate(polygons) if polygon]
    scene = Scene([p for p in polygons if p], world.camera.scaled(scale),
                  scale)
    items, colors = scene.image()
    run(program, ["render", "a.objects", "-q", "-o", "a.png", "--ids",
                  "a.npy"], folder)
    compare([ids[item] if item >= 0 else -1 for item in flat(items)],
            flat(read_npy(folder / "a.npy")), "items")
    compare(colors, read_png(folder / "a.png"), "colours")
    return len(colors)


KINDS = {f.__name__: f for f in (plain, clips, caps, samples, areas, objects,
                                 screens, rays, picks, depthsort)}


def main(words):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--kind", action="append", choices=KINDS, default=[])
    parser.add_argument("--cases", type=int, default=0, help="of each kind")
    parser.add_argument("--seconds", type=float, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--case", type=int, help="this one alone")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER",
                        help="for the files of the last case of each kind")
    arguments = parser.parse_args(words)
    if not (arguments.cases or arguments.seconds or arguments.case is not None):
        parser.error("say how long: --seconds, --cases or --case")
    program = str(arguments.program.resolve())
    kinds = arguments.kind or list(KINDS)
    cases, numbers = collections.Counter(), collections.Counter()
    wrong, begin, number = 0, time.monotonic(), arguments.case or 0
    while kinds:
        if arguments.cases and number >= arguments.cases:
            break
        for kind in list(kinds):
            if arguments.seconds and (time.monotonic() - begin >
                                      arguments.seconds):
                kinds = []
                break
            folder = pathlib.Path(tempfile.mkdtemp(prefix="check-" + kind))
            chance = random.Random("%d %s %d" % (arguments.seed, kind, number))
            keep = False
            try:
                numbers[kind] += KINDS[kind](program, folder, chance)
                cases[kind] += 1
            except Differs as differs:
                keep, wrong = True, wrong + 1
                print("%s, case %d of seed %d: %s\n  files: %s" % (
                    kind, number, arguments.seed, differs, folder), flush=True)
            if arguments.keep:
                target = arguments.keep / kind
                shutil.rmtree(target, ignore_errors=True)
                shutil.copytree(folder, target)
            if not keep:
                shutil.rmtree(folder)
        number += 1
        if arguments.case is not None:
            break
    for kind in cases:
        print("%-10s %8d cases, %10d numbers compared" % (
            kind, cases[kind], numbers[kind]))
    print("%d cases in %.0f s, %d differ" % (
        sum(cases.values()) + wrong, time.monotonic() - begin, wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
