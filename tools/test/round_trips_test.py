#!/usr/bin/env python3
"""Tries the checker of tools/round_trips.py on meshes with known faults."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import round_trips  # noqa: E402


def tetrahedron(at, turned=False):
    points = [tuple(a + b for a, b in zip(at, p))
              for p in ((0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4))]
    polygons = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
    return points, [p[::-1] if turned else p for p in polygons]


def both(a, b):
    return (a[0] + b[0],
            a[1] + [[v + len(a[0]) for v in polygon] for polygon in b[1]])


def expect(wanted, mesh):
    faults, volume = round_trips.faults_of(*mesh)
    if (faults, volume) != wanted:
        sys.exit(f"{mesh}: {faults}, {volume}, not {wanted}")


def main():
    one = tetrahedron((0, 0, 0))
    expect(([], 64 / 6), one)
    expect(([], 128 / 6), both(one, tetrahedron((9, 0, 0))))
    expect((["triangles cross"], 128 / 6), both(one, tetrahedron((.5, 1, 1))))
    expect((["two vertices in one place"], 128 / 6),
           both(one, tetrahedron((4, 0, 0))))
    faults, _ = round_trips.faults_of(one[0], one[1][:3])
    if faults != ["not closed"]:
        sys.exit(f"an open surface: {faults}")
    flat = one[0] + [(2, 0, 0)], one[1] + [[0, 1, 4], [0, 4, 1]]
    if "a triangle without area" not in round_trips.faults_of(*flat)[0]:
        sys.exit("a triangle without area is not found")
    print("round_trips.py finds what it should")


if __name__ == "__main__":
    main()
