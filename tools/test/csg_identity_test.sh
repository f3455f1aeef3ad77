#!/usr/bin/env bash
# Volumes of what csg writes, which `info` tells exactly, add up as those of
# sets do; and a file that is wrong makes them not to.
. "$(dirname "$0")/expect.sh"

volume() {
  "$program" info --exact "$1" | sed -n 's/^volume *//p'
}

# adds_up FOLDER: the volumes of its files do, exactly.
adds_up() {
  python3 - "$(volume "$1/a.off")" "$(volume "$1/b.off")" \
    "$(volume "$1/or.off")" "$(volume "$1/and.off")" \
    "$(volume "$1/less.off")" "$(volume "$1/back.off")" \
    "$(volume "$1/xor.off")" "$(volume "$1/morgan.off")" <<'END'
import sys
from fractions import Fraction
a, b, union, common, less, back, xor, morgan = map(Fraction, sys.argv[1:])
sys.exit(not (0 < a and 0 < b and 0 < common and a + b == union + common and
              less == a - common and back == a and
              xor == union - common and morgan == less))
END
}

# work_out FOLDER: everything from its a.off and b.off.
work_out() {
  local two="A=$1/a.off B=$1/b.off"
  # shellcheck disable=SC2086
  {
    expect 0 'result' csg 'A | B' $two -o "$1/or.off"
    expect 0 'result' csg 'B & A' $two -o "$1/and.off"
    expect 0 'result' csg 'A - B' $two -o "$1/less.off" --merge plane
    expect 0 'result' csg 'A ^ B' $two -o "$1/xor.off"
    expect 0 'result' csg '(A - B) | (A & B)' $two -o "$1/back.off"
    expect 0 'result' csg '~(~A | B) & ~(B - A)' $two -o "$1/morgan.off"
  }
}

# Solids of boxes on a grid, whose faces and edges coincide everywhere; and
# slanted ones.
mkdir boxes slanted
box 0 0 0 1 1 1 >unit.off
cp unit.off boxes/
python3 - <<'END'
import random
draw = random.Random(5)
def boxes(count):
    terms = []
    for _ in range(count):
        size = [draw.randint(1, 4) for _ in range(3)]
        at = [draw.randint(0, 8 - s) for s in size]
        terms.append('translate(scale("unit.off", %d, %d, %d), %d, %d, %d)'
                     % (*size, *at))
    return terms
for name in 'ab':
    with open('boxes/%s.csg' % name, 'w') as file:
        file.write(' |\n '.join(boxes(9)) + ' -\n (' + ' | '.join(boxes(4)) +
                   ')\n')
END
for name in a b; do
  expect 0 'moved 0 coordinates' csg --script boxes/$name.csg \
    -o boxes/$name.off
done
work_out boxes
adds_up boxes || wrong "boxes do not add up"
# Prisms with slants of 45 degrees: every three planes meet in halves.
expect 0 'moved 0 coordinates' csg \
  'scale(C, 4) & half(0,0,0, 1,1,0, 0,0,1) - translate(C, 0, 2, 1)' C=unit.off \
  -o slanted/a.off
expect 0 'moved 0 coordinates' csg \
  'translate(rotate(A, 0, 0, 1, 90), 3.25, 0.5, 0.75) |
   translate(rotate(A, 1, 0, 0, 90), 0.125, 3.5, -1)' \
  A=slanted/a.off -o slanted/b.off
work_out slanted
adds_up slanted || wrong "slanted solids do not add up"

# Whatever file is put in another's place, and whatever box is lost, is noticed.
planted=0
mkdir wrong
cp boxes/*.off wrong/
adds_up wrong || wrong "a copy does not add up"
for file in or and less xor back morgan; do
  "$program" csg "X ^ translate(scale(Y, 1, 1, 0.125), 9, 9, 9)" \
    X=boxes/$file.off Y=unit.off -o wrong/$file.off >log 2>&1 ||
    wrong "planting: $(cat log)"
  adds_up wrong && wrong "a wrong $file.off is not noticed"
  planted=$((planted + 1))
  cp boxes/$file.off wrong/
done
[ $planted = 6 ] || wrong "planted $planted wrong files, not 6"
finish
