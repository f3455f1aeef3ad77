#!/usr/bin/env python3
"""Compares the colours of a shaded figure with those of a picture.

  draw_colors.py FIGURE PICTURE.png LEVELS

The figure is an SVG or PDF that `halfspace draw --shade gouraud` wrote, the
picture what `halfspace render` makes of the same view. At each pixel's centre
no channel may be off by more than LEVELS and what the picture rounds; centres
nearer than a hundredth of a pixel to a border are left out, and must be few.
Exit status: 0 if they agree, else 1.
"""

import re
import struct
import sys
import xml.etree.ElementTree
import zlib

NEAR = 1e-2
SVG = "{http://www.w3.org/2000/svg}"


def picture_of(path):
    """Width, height and rows of bytes of a PNG of 8-bit RGB."""
    data = open(path, "rb").read()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
            assert (depth, color) == (8, 2), "not RGB of 8 bits"
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    raw, rows = zlib.decompress(packed), []
    above = bytes(3 * width)
    for j in range(height):
        line = bytearray(raw[j * (3 * width + 1):(j + 1) * (3 * width + 1)])
        rule, line = line[0], line[1:]
        for k in range(3 * width):
            a = line[k - 3] if k > 2 else 0
            b, c = above[k], above[k - 3] if k > 2 else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b),
                        (abs(p - c), 2, c))[2]
            line[k] = (line[k] + (0, a, b, (a + b) // 2, paeth)[rule]) & 255
        above = bytes(line)
        rows.append(above)
    return width, height, rows


def rgb(word):
    return tuple(int(word[k:k + 2], 16) for k in (1, 3, 5))


def svg_areas(path):
    """[(loops of points, colour at a point)], the last drawn last."""
    root = xml.etree.ElementTree.parse(path).getroot()
    gradients = {}
    for element in root.iter(SVG + "linearGradient"):
        x1, y1, x2, y2 = (float(element.get(k)) for k in ("x1", "y1", "x2",
                                                         "y2"))
        ends = [rgb(stop.get("stop-color")) for stop in element]
        gradients[f"url(#{element.get('id')})"] = (x1, y1, x2, y2, *ends)

    def painter(word):
        if word not in gradients:
            color = rgb(word)
            return lambda x, y: color
        x1, y1, x2, y2, first, last = gradients[word]
        dx, dy = x2 - x1, y2 - y1

        def paint(x, y):
            t = ((x - x1) * dx + (y - y1) * dy) / (dx * dx + dy * dy)
            t = min(1, max(0, t))
            return tuple(f + t * (g - f) for f, g in zip(first, last))
        return paint
    areas = []
    for element in root.iter(SVG + "path"):
        if element.get("fill") is None:
            continue
        loops = []
        for part in element.get("d").split("Z")[:-1]:
            numbers = [float(n) for n in re.findall(r"-?[\d.]+", part)]
            loops.append(list(zip(numbers[0::2], numbers[1::2])))
        areas.append((loops, painter(element.get("fill"))))
    return areas


def pdf_areas(path):
    """The same of a PDF: its flat regions, then the triangles of its mesh."""
    data = open(path, "rb").read()
    streams = [(head, zlib.decompress(body)) for head, body in re.findall(
        rb"<<(/Length[^\n]*)>>\nstream\n(.*?)\nendstream", data, re.DOTALL)]
    page = [float(n) for n in
            re.search(rb"MediaBox\[0 0 ([\d.]+) ([\d.]+)", data).groups()]
    areas, loops, color = [], [], None
    for line in streams[0][1].decode().splitlines():
        words = line.split()
        if words[-1] == "RG":
            color = tuple(255 * float(n) for n in words[:3])
        elif words[-1] in ("m", "l"):
            point = (float(words[0]), page[1] - float(words[1]))
            loops.extend([[point]] if words[-1] == "m" else [])
            if words[-1] == "l":
                loops[-1].append(point)
        elif words[-1] == "W":
            break
        elif words[-1] in ("f*", "B*"):
            if words[-1] == "f*":
                areas.append((loops, lambda x, y, c=color: c))
            loops = []
    for _, mesh in streams[1:]:
        for at in range(0, len(mesh), 45):
            points, colors = [], []
            for k in range(3):
                vertex = struct.unpack(">BIIHHH", mesh[at + 15 * k:
                                                       at + 15 * k + 15])
                assert vertex[0] == 0
                points.append((vertex[1] / 0xFFFFFFFF * page[0],
                               page[1] - vertex[2] / 0xFFFFFFFF * page[1]))
                colors.append([c * 255 / 65535 for c in vertex[3:]])
            areas.append(([points], blend(points, colors)))
    return areas


def blend(points, colors):
    (ax, ay), (bx, by), (cx, cy) = points
    twice = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)

    def paint(x, y):
        v = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / twice
        w = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / twice
        return tuple((1 - v - w) * a + v * b + w * c for a, b, c
                     in zip(*colors))
    return paint if twice else lambda x, y: (0, 0, 0)


def main():
    figure, picture, levels = sys.argv[1], sys.argv[2], float(sys.argv[3])
    width, height, rows = picture_of(picture)
    areas = (pdf_areas if figure.endswith(".pdf") else svg_areas)(figure)
    seen = [[None] * width for _ in range(height)]
    unsure = set()
    for loops, paint in areas:
        sides = [(p, q) for loop in loops
                 for p, q in zip(loop, loop[1:] + loop[:1])]
        low = min(p[1] for p, _ in sides)
        high = max(p[1] for p, _ in sides)
        for j in range(max(0, int(low - 1)), min(height, int(high + 1))):
            y, crossings = j + 0.5, []
            for (x0, y0), (x1, y1) in sides:
                if min(y0, y1) - NEAR < y < max(y0, y1) + NEAR:
                    at = (x0 + (y - y0) * (x1 - x0) / (y1 - y0)
                          if abs(y1 - y0) > NEAR else x0)
                    if abs(y - y0) < NEAR or abs(y - y1) < NEAR:
                        for x in (x0, x1):
                            unsure.update((j, int(x + d)) for d in (-1, 0))
                    unsure.update((j, i) for i in (int(at - 1), int(at))
                                  if abs(at - i - 0.5) < NEAR)
                if (y0 <= y) != (y1 <= y):
                    crossings.append(x0 + (y - y0) * (x1 - x0) / (y1 - y0))
            crossings.sort()
            for x0, x1 in zip(crossings[0::2], crossings[1::2]):
                for i in range(max(0, int(x0 + 0.5)),
                               min(width, int(x1 + 0.5))):
                    if x0 < i + 0.5 < x1:
                        seen[j][i] = paint(i + 0.5, y)
    wrong = worst = 0
    for j in range(height):
        for i in range(width):
            if (j, i) in unsure:
                continue
            pixel = rows[j][3 * i:3 * i + 3]
            off = (max(abs(a - b) for a, b in zip(seen[j][i], pixel))
                   if seen[j][i] else 255)
            worst = max(worst, off)
            # A picture rounds by a half; a PDF's flat colours by 1/20000.
            wrong += off > levels + 0.52
    print(f"{wrong} pixels differ, the worst by {worst:.2f}; "
          f"{len(unsure)} are left out")
    return wrong > 0 or len(unsure) > width * height / 4


if __name__ == "__main__":
    sys.exit(main())
