#!/usr/bin/env python3
"""Compares a figure with an item image.

  draw_check.py FIGURE.svg IDS.npy

The figure is one of `halfspace draw --by polygon`. Each pixel's centre must lie
in the region whose title names the polygon of the image there; centres nearer
than a thousandth of a pixel to a border are left out, and must be few.
Exit status: 0 if they agree, else 1.
"""

import re
import struct
import sys
import xml.etree.ElementTree

NEAR = 1e-3


def regions_of(path):
    """[(polygon or -1, loops of points)]."""
    regions = []
    for element in xml.etree.ElementTree.parse(path).iter():
        if not element.tag.endswith("}path"):
            continue
        title = element.find("{http://www.w3.org/2000/svg}title").text
        polygon = -1 if title == "background" else int(title.split()[1])
        loops = []
        for part in element.get("d").split("Z")[:-1]:
            numbers = [float(n) for n in re.findall(r"-?[\d.]+", part)]
            loops.append(list(zip(numbers[0::2], numbers[1::2])))
        regions.append((polygon, loops))
    return regions


def image_of(path):
    data = open(path, "rb").read()
    length = struct.unpack("<H", data[8:10])[0]
    shape = re.search(rb"'shape': \((\d+), (\d+)\)", data)
    height, width = int(shape[1]), int(shape[2])
    ids = struct.unpack(f"<{height * width}i", data[10 + length:])
    return width, height, ids


def crossings(loops, y):
    """Where a horizontal line crosses the borders, and whether it is near an
    end of one."""
    found, near_end = [], False
    for loop in loops:
        for (x0, y0), (x1, y1) in zip(loop, loop[1:] + loop[:1]):
            near_end = near_end or min(abs(y - y0), abs(y - y1)) < NEAR
            if (y0 <= y) != (y1 <= y):
                found.append(x0 + (y - y0) * (x1 - x0) / (y1 - y0))
    return sorted(found), near_end


def main():
    width, height, ids = image_of(sys.argv[2])
    wrong = left_out = 0
    regions = regions_of(sys.argv[1])
    for j in range(height):
        rows = [(polygon, *crossings(loops, j + 0.5))
                for polygon, loops in regions]
        for i in range(width):
            x = i + 0.5
            if any(near or any(abs(x - c) < NEAR for c in row)
                   for _, row, near in rows):
                left_out += 1
                continue
            holders = [polygon for polygon, row, _ in rows
                       if sum(c < x for c in row) % 2 == 1]
            wrong += holders != [ids[j * width + i]]
    if wrong or left_out > width * height / 4:
        print(f"{wrong} pixels differ, {left_out} are left out")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
