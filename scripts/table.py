#!/usr/bin/env python3
"""Prints the demo's table from out/METHOD.json and the comparisons."""
import json
import sys

NAMES = {"span": "fast, span buffer", "painter": "ref, painter",
         "zbuffer": "ref, z-buffer", "raycast": "ref, ray casting"}


def mismatches(method):
    """What `halfspace compare` counted against the span buffer."""
    if method == "span":
        return "-"
    with open(f"out/{method}.txt", encoding="ascii") as file:
        return file.read().split("mismatches: ")[1].split()[0]


def main(mesh, *methods):
    stats = {}
    for method in methods:
        with open(f"out/{method}.json", encoding="ascii") as file:
            stats[method] = json.load(file)
    print(f"\n{mesh}: {stats['span']['polygons']} polygons in\n")
    for name, method in (("fast", "span"), ("ref", "painter")):
        tree = stats[method]
        print(f"  tree of {name:5} {tree['fragments']} fragments,"
              f" {tree['nodes']} nodes, height {tree['height']},"
              f" built in {tree['build_ms'] / 1000:.3f} s")
    print(f"\n  {'image by':18} {'pixels painted':>15} {'mismatches':>11}"
          f" {'time':>11}")
    for method in methods:
        of = stats[method]
        print(f"  {NAMES[method]:18} {of['pixels_painted']:>15}"
              f" {mismatches(method):>11} {of['frame_ms'] / 1000:>9.3f} s")
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
