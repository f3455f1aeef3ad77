#!/usr/bin/env python3
"""Prints the demo's table from out/METHOD.json and the comparisons."""
import json
import sys

NAMES = {"span": "span buffer", "painter": "painter", "zbuffer": "z-buffer",
         "raycast": "ray casting"}


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
    tree = stats["span"]
    print(f"""
{mesh}
  polygons in     {tree["polygons"]}
  tree            {tree["fragments"]} fragments, {tree["nodes"]} nodes,\
 height {tree["height"]}, built in {tree["build_ms"] / 1000:.2f} s

  {"method":12} {"pixels painted":>15} {"mismatches":>11} {"time":>10}""")
    for method in methods:
        of = stats[method]
        print(f"  {NAMES[method]:12} {of['pixels_painted']:>15}"
              f" {mismatches(method):>11} {of['frame_ms'] / 1000:>8.2f} s")
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
