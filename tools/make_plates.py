#!/usr/bin/env python3
"""Writes plates whose faces have many corners on their sides, as OFF.

  make_plates.py FOLDER [--first N] [--count N]

What tessellates a border cuts its sides into many pieces, and rounding to
decimals, or turning, bends them a bit: such faces are no polygons of a plane,
and have to become triangles. Plates are squares, brackets, gears, combs, frames
and strips; each second one, about, is turned before it is written. Plate I is
always the same. Prints the files' names. They are meant for

  round_trips.py PROGRAM --steps 0 --seeds 0 --parts FOLDER/*.off
"""

import argparse
import math
import pathlib
import random

COMB = [corner for i in range(10)
        for corner in ((100 - 10 * i, 50), (95 - 10 * i, 50),
                       (95 - 10 * i, 10), (90 - 10 * i, 10))]
SHAPES = {
    "square": [(0, 0), (100, 0), (100, 100), (0, 100)],
    "bracket": [(0, 0), (100, 0), (100, 40), (40, 40), (40, 100), (0, 100)],
    "gear": [((50 if i % 2 else 35) * math.cos(math.pi * i / 12),
              (50 if i % 2 else 35) * math.sin(math.pi * i / 12))
             for i in range(24)],
    "comb": [(0, 0), (100, 0), *COMB],
    "frame": [(0, 0), (100, 0), (100, 100), (0, 100), (0, 50), (20, 50),
              (20, 80), (80, 80), (80, 20), (20, 20), (20, 49), (0, 49)],
    "strip": [(0, 0), (100, 0), (100, 0.5), (0, 0.5)],
}


def border(corners, pitch):
    """The polygon with more corners on its sides, about so far apart."""
    result = []
    for (x, y), (to_x, to_y) in zip(corners, corners[1:] + corners[:1]):
        count = max(1, int(math.dist((x, y), (to_x, to_y)) / pitch))
        result += [(x + (to_x - x) * i / count, y + (to_y - y) * i / count)
                   for i in range(count)]
    return result


def turned(point, axis, degrees):
    """By Rodrigues' formula."""
    size = math.hypot(*axis)
    k = [a / size for a in axis]
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    along = sum(a * p for a, p in zip(k, point))
    across = [k[(i + 1) % 3] * point[(i + 2) % 3] -
              k[(i + 2) % 3] * point[(i + 1) % 3] for i in range(3)]
    return [p * cos + c * sin + a * along * (1 - cos)
            for p, c, a in zip(point, across, k)]


def plate(number):
    """The text of its file."""
    rng = random.Random(number)
    pitch, digits = rng.choice([0.7, 2, 5]), rng.choice([3, 4, 6])
    flat = [(round(x, digits), round(y, digits)) for x, y in
            border(rng.choice(list(SHAPES.values())), pitch)]
    points = [(x, y, z) for z in (0, rng.choice([3, 10, 40])) for x, y in flat]
    if rng.random() < 0.5:
        axis = [rng.randint(1, 9) for _ in range(3)]
        degrees = rng.randint(1, 89)
        points = [turned(p, axis, degrees) for p in points]
    n = len(flat)
    faces = [range(n - 1, -1, -1), range(n, 2 * n)]
    faces += [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
    return "\n".join(
        ["OFF", f"{len(points)} {len(faces)} 0"] +
        [" ".join(f"{x:.{digits}f}" for x in p) for p in points] +
        [f"{len(face)} " + " ".join(map(str, face)) for face in faces]) + "\n"


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=20)
    words = parser.parse_args()
    words.folder.mkdir(parents=True, exist_ok=True)
    for number in range(words.first, words.first + words.count):
        path = words.folder / f"plate{number}.off"
        path.write_text(plate(number))
        print(path)


if __name__ == "__main__":
    main()
