#!/usr/bin/env bash
# The map as JSON: its regions fill the image exactly, and show at every pixel's
# centre what the item image has there; errors are one line.
. "$(dirname "$0")/expect.sh"

"$make_model" interlocking-cubes -o cubes.off || exit 1
for view in "--ortho" "--eye 300,-500,400 --target 0,0,0" "--cull --near 1" \
  "--clip 3,1,2,40" "--clip 3,1,2,40 --clip 0,-1,1,0 --cap part"; do
  # shellcheck disable=SC2086
  set -- $view --size 48x36
  expect 0 'regions' map cubes.off "$@" --exact -o map.json
  expect 0 'span' render cubes.off "$@" -o a.png --ids a.npy
  python3 - <<'PYTHON' || wrong "$view: the map is not that of the image"
import fractions
import json
import struct

with open("map.json", encoding="ascii") as file:
    made = json.load(file)
width, height = made["width"], made["height"]
points = [[fractions.Fraction(c) for c in p] for p in made["exact_vertices"]]
assert [[float(c) for c in p] for p in points] == made["vertices"]


def steps(loop):
    return zip(loop, loop[1:] + loop[:1])


area = 0
for region in made["regions"]:
    twice = sum(points[p][0] * points[q][1] - points[p][1] * points[q][0]
                for loop in region["loops"] for p, q in steps(loop))
    assert twice > 0
    area += twice / 2
assert area == width * height
ends = [arc[:2] for arc in made["arcs"]]
assert ends == sorted(ends) and len(ends) > 100

data = open("a.npy", "rb").read()
ids = struct.unpack(f"<{width * height}i", data[-4 * width * height:])
half = fractions.Fraction(1, 2)
POLYGONS = 216
for j in range(height):
    y = j + half
    row = []
    for region in made["regions"]:
        for loop in region["loops"]:
            for p, q in steps(loop):
                (x0, y0), (x1, y1) = points[p], points[q]
                if (y0 <= y) != (y1 <= y):
                    # A centre sees what is a hair to the right and below it.
                    slope = (x1 - x0) / (y1 - y0)
                    row.append((x0 + (y - y0) * slope, slope, y1 < y0,
                                region["polygon"]))
    for i in range(width):
        before = [c for c in row if c[0] <= i + half and c[2]]
        seen = max(before)[3]
        # The stripes of caps are of their caps (S10.5).
        if seen >= POLYGONS and (seen - POLYGONS) % 16 >= 8:
            seen -= 8
        assert seen == ids[j * width + i], (i, j)
PYTHON
done
expect 0 '' map cubes.off --by part
expect 0 '' map cubes.off --by part --clip 3,1,2,40 --cap hatch
expect 2 'needs --clip' map cubes.off --cap hatch -o none.json
expect 2 'needs [0-9]* cells, and the limit is 3$' map cubes.off --most-cells 3 -o none.json
[ -e none.json ] && wrong "a map that is too large was written"
expect 2 'must be\|not in' map cubes.off --by colours
printf 'OFF\n1 0 0\n0 0 0\n' >empty.off
expect 0 ' 0 polygons; 0 regions' map empty.off -o empty.json
python3 -m json.tool empty.json >json.txt || wrong "empty.json is no JSON"

exit $((failures > 0))
