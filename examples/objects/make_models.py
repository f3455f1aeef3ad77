#!/usr/bin/env python3
"""Makes the models of the objects' examples: coloured OFF files.

  examples/objects/make_models.py FOLDER

Boxes, and balls of quadrangles and triangles, whose corners are whole
thousandths, so that what is planar stays planar where that matters.
"""

import math
import pathlib
import sys


class Model:
    def __init__(self):
        self.points = []
        self.faces = []

    def face(self, points, color):
        first = len(self.points)
        self.points += points
        self.faces.append((range(first, len(self.points)), color))

    def box(self, low, high, color):
        """A box; faces look outwards."""
        x, y, z = zip(low, high)
        at = [(x[k & 1], y[k >> 1 & 1], z[k >> 2]) for k in range(8)]
        shades = ((4, 6, 2, 0, 0.7), (1, 3, 7, 5, 0.8), (0, 1, 5, 4, 0.9),
                  (2, 6, 7, 3, 0.6), (0, 2, 3, 1, 0.4), (4, 5, 7, 6, 1.0))
        for a, b, c, d, light in shades:
            self.face([at[a], at[b], at[c], at[d]],
                      [round(light * part) for part in color])

    def ball(self, radius, parts, color):
        """Triangles between circles of latitude."""
        def point(i, j):
            up = math.pi * i / parts - math.pi / 2
            round_ = math.pi * j / parts
            flat = math.cos(up) * radius
            return (round(flat * math.cos(round_), 3),
                    round(flat * math.sin(round_), 3),
                    round(radius * math.sin(up), 3))

        for i in range(parts):
            for j in range(2 * parts):
                a, b = point(i, j), point(i, j + 1)
                c, d = point(i + 1, j + 1), point(i + 1, j)
                stripe = 1.0 if (i // 2 + j // 2) % 2 else 0.82
                tone = [round(stripe * (0.6 + 0.4 * i / parts) * part)
                        for part in color]
                if i > 0:
                    self.face([a, b, c], tone)
                if i < parts - 1:
                    self.face([a, c, d], tone)

    def write(self, path):
        lines = ["OFF", f"{len(self.points)} {len(self.faces)} 0"]
        lines += ["%g %g %g" % p for p in self.points]
        lines += [" ".join(map(str, [len(ids), *ids, *color]))
                  for ids, color in self.faces]
        path.write_text("\n".join(lines) + "\n")


def main(folder):
    folder = pathlib.Path(folder)
    field = Model()
    field.box((-40, -30, -1), (40, 30, 0), (120, 170, 90))
    walls = (210, 190, 160)
    field.box((-6, 4, 0), (6, 4.5, 6), walls)
    field.box((-6, -4, 0), (-5.5, 4, 6), walls)
    field.box((5.5, -4, 0), (6, 4, 6), walls)
    field.box((-5.5, -4, 0), (-1.5, -3.5, 6), walls)
    field.box((1.5, -4, 0), (5.5, -3.5, 6), walls)
    field.box((-1.5, -4, 5), (1.5, -3.5, 6), walls)
    field.box((-6.5, -4.5, 6), (6.5, 5, 6.5), (150, 60, 50))
    field.write(folder / "field.off")
    door = Model()
    door.box((0, -0.1, 0), (2.8, 0.1, 4.8), (120, 70, 30))
    door.box((2.3, -0.3, 2.2), (2.5, -0.1, 2.4), (230, 200, 60))
    door.write(folder / "door.off")
    plane = Model()
    plane.box((-5, -0.6, -0.6), (5, 0.6, 0.6), (220, 220, 235))
    plane.box((-1, -6, 0), (1.5, 6, 0.3), (190, 200, 230))
    plane.box((-5, -2, 0.2), (-4, 2, 0.4), (190, 200, 230))
    plane.box((-5, -0.1, 0.6), (-4, 0.1, 2.2), (200, 60, 50))
    plane.write(folder / "plane.off")
    propeller = Model()
    propeller.box((-0.1, -1.6, -0.15), (0.1, 1.6, 0.15), (60, 60, 60))
    propeller.write(folder / "propeller.off")
    for name, radius, parts, color in (("sun", 4, 16, (250, 200, 60)),
                                       ("earth", 1.2, 12, (80, 130, 230)),
                                       ("moon", 0.4, 8, (200, 200, 200))):
        ball = Model()
        ball.ball(radius, parts, color)
        ball.write(folder / f"{name}.off")


if __name__ == "__main__":
    main(*sys.argv[1:])
