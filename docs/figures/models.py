"""Models for the gallery, as OFF files: write_all(folder)."""

import math
import pathlib

ORANGE, BLUE, GREEN = (230, 159, 0), (86, 180, 233), (0, 158, 115)
RED, GREY = (213, 94, 0), (200, 200, 200)


class Model:
    """Polygons with a colour each."""

    def __init__(self):
        self.points, self.faces = [], []

    def add(self, points, faces, color):
        first = len(self.points)
        self.points += points
        self.faces += [([first + k for k in face], color) for face in faces]

    def write(self, path):
        lines = ["OFF", f"{len(self.points)} {len(self.faces)} 0"]
        lines += [" ".join(f"{c:.6f}" for c in p) for p in self.points]
        lines += [f"{len(f)} " + " ".join(map(str, f)) + " %d %d %d" % color
                  for f, color in self.faces]
        path.write_text("\n".join(lines) + "\n")


def turned(p, axis, degrees):
    """A point turned about a coordinate axis."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    q = list(p)
    q[i], q[j] = c * p[i] - s * p[j], s * p[i] + c * p[j]
    return tuple(q)


BOX_FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3),
             (0, 4, 6, 2), (1, 3, 7, 5)]


def box(low, high):
    """The corners of a box; x goes first."""
    return [tuple((low, high)[k >> a & 1][a] for a in range(3))
            for k in range(8)]


def grid(point, columns, rows, wrap_u=False, wrap_v=False):
    """Triangles of a surface point(u, v), u and v from 0 to 1."""
    across = columns if wrap_u else columns + 1
    down = rows if wrap_v else rows + 1
    points = [point(i / columns, j / rows)
              for j in range(down) for i in range(across)]
    faces = []
    for j in range(rows):
        for i in range(columns):
            a = j * across + i
            b = j * across + (i + 1) % across
            c = (j + 1) % down * across + (i + 1) % across
            d = (j + 1) % down * across + i
            faces += [(a, b, c), (a, c, d)]
    return points, faces


def bars():
    """Three bars, each over the next."""
    model = Model()
    for k, color in enumerate((ORANGE, BLUE, GREEN)):
        corners = [turned((x, y + 0.9, z + 0.2 * x), 2, 120 * k)
                   for x, y, z in box((-2, -0.3, -0.15), (2, 0.3, 0.15))]
        model.add(corners, BOX_FACES, color)
    return model


def cubes():
    """Three cubes through each other."""
    model = Model()
    for k, color in enumerate((ORANGE, BLUE, GREEN)):
        corners = [turned(turned(p, 0, 25 * k + 10), 2, 37 * k)
                   for p in box((-1, -1, -1), (1, 1, 1))]
        model.add([(x + 0.55 * k, y, z + 0.2 * k) for x, y, z in corners],
                  BOX_FACES, color)
    return model


def surfaces():
    """Two surface plots that cross."""
    model = Model()

    def first(u, v):
        x, y = 4 * u - 2, 4 * v - 2
        return x, y, 0.7 * math.sin(2 * x) * math.cos(2 * y)

    def second(u, v):
        x, y = 4 * u - 2, 4 * v - 2
        return x, y, 0.35 * x - 0.25 * y + 0.2 * math.cos(3 * x)
    model.add(*grid(first, 29, 29), ORANGE)
    model.add(*grid(second, 29, 29), BLUE)
    return model


def moebius():
    """A Moebius strip and a torus."""
    model = Model()

    def strip(u, v):
        a, w = 2 * math.pi * u, 0.9 * (v - 0.5)
        r = 1.5 + w * math.cos(a / 2)
        return r * math.cos(a), r * math.sin(a), w * math.sin(a / 2)

    def torus(u, v):
        a, b = 2 * math.pi * u, 2 * math.pi * v
        r = 1 + 0.3 * math.cos(b)
        return r * math.cos(a) - 1.4, 0.3 * math.sin(b), r * math.sin(a)
    model.add(*grid(strip, 96, 6), ORANGE)
    model.add(*grid(torus, 64, 24, True, True), BLUE)
    return model


def vessel():
    """A vessel that forks, and a plane through it."""
    model = Model()

    def tube(side):
        def point(u, v):
            # Below the fork there is one tube.
            t = u if side < 0 else 0.4 + 0.6 * u
            b = 2 * math.pi * v
            r = 0.55 * (1 - 0.45 * t) * (1 + 0.06 * math.sin(25 * t))
            fork = max(0, t - 0.4)
            x = side * 2.2 * fork ** 1.5 + 0.2 * math.sin(5 * t)
            return (x + r * math.cos(b), 0.15 * math.sin(7 * t) +
                    r * math.sin(b), 4 * t - 2)
        return point
    for side in (-1, 1):
        model.add(*grid(tube(side), 80, 36, False, True), RED)
    model.add([(-2, -1.5, -0.6), (2, -1.5, -0.2), (2, 1.5, 0.6),
               (-2, 1.5, 0.2)], [(0, 1, 2), (0, 2, 3)], GREY)
    return model


def plot():
    """A surface over a floor."""
    model = Model()

    def hill(u, v):
        x, y = 6 * u - 3, 6 * v - 3
        return (x, y, 0.3 + 1.8 * math.exp(-(x * x + y * y) / 2) -
                1.2 * math.exp(-((x - 1.5) ** 2 + (y + 1) ** 2)))
    points, faces = grid(hill, 40, 40)
    for k in range(0, len(faces), 2):
        z = sum(points[c][2] for c in faces[k]) / 3
        share = min(1, max(0, (z + 0.6) / 2.6))
        band = round(8 * share) / 8
        color = tuple(round(a + band * (b - a))
                      for a, b in zip((40, 80, 160), (250, 220, 90)))
        model.add([points[c] for c in faces[k] + faces[k + 1]],
                  [(0, 1, 2), (3, 4, 5)], color)
    model.add([(-3, -3, -1), (3, -3, -1), (3, 3, -1), (-3, 3, -1)],
              [(0, 1, 2, 3)], (235, 235, 235))
    return model


def building():
    """A house with windows, a roof and steps."""
    model = Model()
    wall, roof, glass, stone = (232, 220, 200), (170, 80, 60), \
        (120, 160, 190), (180, 180, 180)
    model.add(box((0, 0, 0), (12, 8, 6)), BOX_FACES, wall)
    model.add([(-.5, -.5, 6), (12.5, -.5, 6), (12.5, 8.5, 6), (-.5, 8.5, 6),
               (-.5, 4, 9.5), (12.5, 4, 9.5)],
              [(0, 1, 5, 4), (2, 3, 4, 5), (0, 4, 3), (1, 2, 5),
               (3, 2, 1, 0)], roof)
    for x in (1, 4, 7.5, 10):
        for z in (1, 3.8):
            if x == 4 and z == 1:
                continue
            model.add(box((x, -0.15, z), (x + 1.2, 0.1, z + 1.5)), BOX_FACES,
                      glass)
    for y in (1.2, 5.2):
        model.add(box((11.9, y, 3), (12.15, y + 1.6, 4.6)), BOX_FACES, glass)
    model.add(box((4, -0.2, 0), (5.6, 0.1, 2.4)), BOX_FACES, (110, 70, 50))
    for k in range(3):
        model.add(box((3.6, -1.6 + 0.5 * k, 0), (6, 0, 0.15 * (k + 1))),
                  BOX_FACES, stone)
    model.add(box((9, 5, 6), (10, 6, 10.2)), BOX_FACES, roof)
    return model


def bust():
    """A head on a neck and shoulders: a tube with bumps."""
    model = Model()
    # Heights and half widths, from the shoulders to the crown.
    profile = [(0, 1.7), (0.5, 1.65), (0.8, 1.3), (1.0, 0.8), (1.15, 0.55),
               (1.5, 0.5), (1.75, 0.6), (2.0, 0.78), (2.4, 0.92), (2.8, 0.95),
               (3.2, 0.85), (3.45, 0.6), (3.58, 0.3), (3.62, 0.0)]

    def width(t):
        k = min(int(t * (len(profile) - 1)), len(profile) - 2)
        s = t * (len(profile) - 1) - k
        p = [profile[min(max(k + d, 0), len(profile) - 1)]
             for d in (-1, 0, 1, 2)]
        return [0.5 * (2 * b + (c - a) * s + (2 * a - 5 * b + 4 * c - d) * s * s
                       + (3 * b - a - 3 * c + d) * s ** 3)
                for a, b, c, d in zip(*p)]

    def bump(x, z, at_x, at_z, wide, high):
        return math.exp(-((x - at_x) / wide) ** 2 - ((z - at_z) / high) ** 2)

    def skin(u, v):
        z, r = width(v)
        r = max(r, 0)
        a = 2 * math.pi * u
        flat = 0.62 if z < 1 else 0.62 + 0.38 * min(1, (z - 1) / 0.5)
        x, y = r * math.sin(a), -r * flat * math.cos(a)
        if y < 0:
            y -= (0.28 * bump(x, z, 0, 2.45, 0.13, 0.2) +
                  0.1 * bump(x, z, 0, 2.12, 0.3, 0.07) +
                  0.12 * bump(x, z, 0, 1.88, 0.25, 0.12) -
                  0.12 * bump(x, z, 0.32, 2.68, 0.17, 0.12) -
                  0.12 * bump(x, z, -0.32, 2.68, 0.17, 0.12))
        return x, y, z
    model.add(*grid(skin, 72, 78, True), (214, 196, 170))
    return model


def honeycomb():
    """161 hexagonal cells, each a ring of six walls."""
    model = Model()
    count = 0
    for j in range(14):
        for i in range(12):
            if count == 161:
                break
            count += 1
            x, y = 2 * (i + j % 2 / 2), math.sqrt(3) * j
            for k in range(6):
                outer, inner = [], []
                for corner in (k, k + 1):
                    a = math.radians(60 * corner + 30)
                    for ring, r in ((outer, 1.15), (inner, 0.95)):
                        ring.append((x + r * math.cos(a), y + r * math.sin(a)))
                (a, b), (c, d) = outer, inner
                corners = [(*p, z) for z in (0, 3) for p in (a, b, c, d)]
                model.add(corners, BOX_FACES, ORANGE)
    return model


MODELS = {"bars": bars, "cubes": cubes, "surfaces": surfaces,
          "moebius": moebius, "vessel": vessel, "plot": plot,
          "building": building, "bust": bust, "honeycomb": honeycomb}


def write_all(folder):
    for name, make in MODELS.items():
        make().write(pathlib.Path(folder) / f"{name}.off")
