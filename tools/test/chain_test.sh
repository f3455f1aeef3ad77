#!/usr/bin/env bash
# Results that are written, read, and gone on with, beside solids that are
# turned; and surfaces that a coarser grid makes cross themselves.
. "$(dirname "$0")/expect.sh"
trips=${0%/*}/../round_trips.py

# Cuts through files, and pairs; read here without the program's code.
python3 "$trips" "$program" --pairs 2 --steps 12 --seeds 1 \
  --formats off stl >out.txt || wrong "round_trips.py: $(cat out.txt)"
for format in off stl; do
  grep -q "seed 0, $format: 12 steps" out.txt || wrong "no 12 steps in $format"
done
# No more polygons than the same in one run.
whole=$(sed -n 's/^seed 0, in one run: \([0-9]*\) .*/\1/p' out.txt)
for n in $(sed -n 's/^seed 0, .*steps, \([0-9]*\) polygons.*/\1/p' out.txt); do
  [ "$n" -le "$whole" ] || wrong "$n polygons through files, $whole in one run"
done

# Where origins are wanted, corners on straight edges stay: no polygon reaches
# beyond the one that it comes from.
expect 0 closed csg 'translate(box(4), -2, -2, -2) - rotate(box(9, 1, 1), 1, 2,
  3, 20)' -o cut.off
expect 0 closed csg 'A - rotate(box(1, 9, 1), 2, 1, 3, 50)' A=cut.off -o x.off
few=$(sed -n 2p x.off)
expect 0 closed csg 'A - rotate(box(1, 9, 1), 2, 1, 3, 50)' A=cut.off -o x.off \
  --origin x.txt
[ "${few%% *}" -lt "$(sed -n 2p x.off | cut -d' ' -f1)" ] ||
  wrong 'no corner stays for --origin'

# Sheets that are nearer to each other than the grid's steps.
expect 0 closed csg 'rotate(sphere(1, 12), 1, 2, 3, 10) -
  rotate(sphere(1, 12), 1, 2, 3, 10.00001)' -o shell.off
expect 0 'met in .* places and were moved' csg A A=shell.off --grid 26 \
  -o coarse.off
expect 0 'moved 0 coordinates' csg A A=coarse.off -o again.off
# One that crossed itself before is not mended so.
box 0 0 0 2 2 2 >a.off
box 1 1 1 3 3 3 >b.off
python3 - <<'END'
a, b = (open(name).read().split("\n") for name in ("a.off", "b.off"))
points = [line for text in (a, b) for line in text[2:10]]
faces = [line for line in a[10:16]] + [
    " ".join(["4"] + [str(int(w) + 8) for w in line.split()[1:5]])
    for line in b[10:16]]
open("both.off", "w").write("\n".join(["OFF", "16 12 0", *points, *faces, ""]))
END
expect 2 'crosses itself' csg 'rotate(A, 1, 2, 3, 10)' A=both.off -o out.off

# Solids in millimetres and in inches, and one that no grid holds: the others
# stay as they are.
box 0 0 0 25.4 25.4 25.4 >mm.off
box 0 0 0 1 1 1 >inch.off
expect 0 'volume 16387.064,' csg 'A | scale(B, 25.4)' A=mm.off B=inch.off \
  -o same.off
expect 0 '^volume     16387.064$' info same.off
expect 0 'volume 0,' csg 'A ^ scale(B, 25.4)' A=mm.off B=inch.off -o none.off
expect 0 closed csg '(A | translate(B, 30, 0, 0)) |
  translate(rotate(B, 1, 2, 3, 25), 60, 0, 0)' A=mm.off B=inch.off -o three.off
for corner in '25.3999[0-9]* 25.3999' '25.4[0-9]* 25.4'; do
  grep -q "^$corner" three.off && found=yes
done
[ "${found:-}" ] || wrong "the cube's corner is not in three.off"

# Of an edge between faces in one plane a file has the ends alone, where they
# are points. Cut after a turn, it has the plane that it would have had.
hull='hull(-2.9, 0, 2, -3, 2.125, -2.23, 2, 2.75, 3, 3, 1, 0.9, 2, 2, -2.125,
  -1, 3, 1.375)'
turn='0.6, -0.8, 0, 0, 0.8, 0.6, 0, 0, 0, 0, 1, 0'
both='(box(4, 2.57, 4.75) | box(1.25, 3, 5))'
expect 0 closed csg "matrix($both & $hull, $turn)" -o one.hsolid
expect 0 closed csg "$both" -o both.hsolid
expect 0 closed csg "matrix(A & $hull, $turn)" A=both.hsolid -o two.hsolid
same one.hsolid two.hsolid

# In one script `A - (B - A)` is one minuend less all others, so a face of A has
# parts that come from two operands; in the file they are one.
a='(hull(0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4) - half(1, 0, 0, 1, 1, 0, 2, 0, 1))'
b='hull(-1, 1, -1, 5, 1, -1, -1, 5, -1, 1, 1, 5, -1, -1, 2)'
expect 0 closed csg "$a - ($b - $a)" -o one.hsolid
expect 0 closed csg "$a" -o a.hsolid
expect 0 closed csg "A - ($b - A)" A=a.hsolid -o two.hsolid
same one.hsolid two.hsolid

# A turn about the axis leaves the plane along it what it was: it names the edge
# in one way only where it is near, however it came.
hull='hull(-4, -4, 3.125, 3.63, 3, 1, -4, -0.5, -0.625, -2.625, -1, 4)'
both="(matrix(box(3, 1.76, 3.06), $turn) & $hull) | matrix(box(3.25, 2, 2), $turn)"
sheared='1, 2, 0, -0.54, 0, 1, 0, -0.4, 0, 0, 1, 1'
expect 0 closed csg "matrix(matrix($both, $sheared), $turn)" -o one.hsolid
expect 0 closed csg "matrix($both, $sheared)" -o both.hsolid
expect 0 closed csg "matrix(A, $turn)" A=both.hsolid -o two.hsolid
same one.hsolid two.hsolid

# The unit is that of the planes that name edges, not that of operands, of which
# one is empty here and on a finer grid.
empty='hull(-3, 3, -0.25, -3.5, 3, -3, -3, 4, -4, -3, -3, 1.125) &
  hull(1, -3, 1, 0.25, 2, 1.875, 3, -0.92, -0.08, 0, 2.1, -2.1, 0, 3, 1.95)'
both='(hull(2.4, 1.8, -1.625, -4, 3.1, -1.8, -2.5, -2, -3.5, 3.25, -1.93, 3) |
  box(4.125, 1, 1.35)) & box(4, 4.625, 1.25)'
expect 0 closed csg "scale($empty, 1.5) ^ $both" -o one.hsolid
expect 0 closed csg "$empty" -o empty.hsolid
expect 0 closed csg "scale(A, 1.5) ^ $both" A=empty.hsolid -o two.hsolid
same one.hsolid two.hsolid

# Exact files that say that they were checked are not checked again, where their
# checksum agrees: this one crosses itself, and no one looks.
"$program" csg 'A | translate(A, 7, 1, 1)' A=a.off -o - \
  --format hsolid-text >apart.hsolid || wrong 'csg --format hsolid-text'
python3 - "${0%/*}/../../examples" <<'END'
import re
import sys

sys.path.insert(0, sys.argv[1])
from read_solid import crc32c

text = open("apart.hsolid").read()
moved = "".join(
    re.sub(r"\b9\b", "3", re.sub(r"\b7\b", "1", line))
    if re.match("point|plane", line) else line
    for line in text.splitlines(keepends=True)
    if not re.match("checksum|conforming", line))
for name, body in (("said", moved), ("unsaid", moved.replace("checked\n", ""))):
    with open(f"{name}.hsolid", "w") as file:
        file.write(f"{body}checksum {crc32c(body.encode()):08x}\n")
    with open(f"{name}-changed.hsolid", "w") as file:
        file.write(f"{body}checksum {crc32c(body.encode()) ^ 1:08x}\n")
END
expect 0 closed csg X X=said.hsolid -o out.hsolid
expect 2 'crosses itself' csg X X=unsaid.hsolid -o out.hsolid
expect 2 'checksum' csg X X=said-changed.hsolid -o out.hsolid
finish
