#!/usr/bin/env bash
# Seen areas add up, and those of a box are those of geometry; errors are one
# line.
. "$(dirname "$0")/expect.sh"

box -1 -1 -1 1 1 1 >box.off
printf '0,0,1\n1,1,1\n' >suns.csv
printf '0,0,0\n5,0,0\n' >eyes.csv

expect 0 '2 views; 3 of 6 polygons' seen box.off --directions suns.csv \
  --csv sun.csv
expect 0 '' seen box.off --eyes eyes.csv --csv eyes-seen.csv
expect 0 '' seen box.off --view iso --by file --exact --csv exact.csv
python3 - <<'PYTHON' || wrong "the areas are not those of geometry"
import csv
import fractions
import math


def rows(name):
    with open(name, encoding="ascii") as file:
        return list(csv.DictReader(file))


def close(a, b):
    assert abs(a - b) < 1e-12, (a, b)


# From above one face of area 4; from (1, 1, 1) three of 4 / sqrt(3).
for view, areas in (("0", [4]), ("1", [4 / math.sqrt(3)] * 3)):
    seen = [float(r["projected_area"]) for r in rows("sun.csv")
            if r["view"] == view and r["key"] != "-1"]
    assert len(seen) == 6
    for found, expected in zip(sorted(seen)[-len(areas):], areas):
        close(found, expected)
    close(sum(seen), sum(areas))
# From the middle six faces of a sixth of the sphere; from 5 one that is four
# away and two wide.
all_round = rows("eyes-seen.csv")
for r in all_round[:7]:
    close(float(r["steradians"]), 0 if r["key"] == "-1" else 4 * math.pi / 6)
outside = {r["key"]: float(r["steradians"]) for r in all_round[7:]}
close(sum(outside.values()), 4 * math.pi)
close(max(v for k, v in outside.items() if k != "-1"),
      4 * math.atan(1 / (4 * math.sqrt(18))))
# As rationals the image is covered once.
total = sum(fractions.Fraction(r["exact_square_pixels"])
            for r in rows("exact.csv"))
assert total == 640 * 480, total
PYTHON

printf '1,2\n' >bad.csv
expect 2 'bad.csv:1: expected X,Y,Z, three numbers, not' seen box.off \
  --eyes bad.csv
printf '0,0,0\n' >bad.csv
expect 2 'bad.csv:1: expected X,Y,Z, three numbers that are not all 0' seen \
  box.off --directions bad.csv
: >bad.csv
expect 2 'bad.csv: there is no line X,Y,Z' seen box.off --eyes bad.csv
expect 2 'none.csv' seen box.off --eyes none.csv
expect 2 'a parallel view has no eye' seen box.off --eyes eyes.csv --ortho
expect 2 'are not rational' seen box.off --panorama --eye 5,0,0 --exact
expect 2 'would overwrite an input' seen box.off --csv box.off
printf 'OFF\n0 0 0\n' >empty.off
expect 2 'no polygons' seen empty.off

finish
