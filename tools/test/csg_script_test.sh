#!/usr/bin/env bash
# Expressions and scripts of booleans: operators, transforms, halves, origins,
# colours, exact identities of volumes, and what is refused.
. "$(dirname "$0")/expect.sh"

# volume FILE: what `info` says of it, exactly.
volume() {
  "$program" info --exact "$1" | sed -n 's/^volume *//p'
}

# holds EQUATION: it is true, of fractions written as f("1/3").
holds() {
  python3 -c "
from fractions import Fraction as f
import sys
sys.exit(0 if $1 else 1)" || wrong "not true: $1"
}

# gives VOLUME ARGUMENT...: csg has this volume by either library, and what it
# writes has it exactly.
gives() {
  local want=$1 library
  shift
  for library in fast ref; do
    expect 0 "closed, volume $want," csg "$@" -o out.off --impl $library
    [ "$(volume out.off)" = "$want" ] ||
      wrong "'$*' by $library: out.off has volume $(volume out.off)"
  done
}

box 0 0 0 4 4 4 >a.off
box 1 1 1 5 5 5 >b.off
box 3 0 0 6 2 2 >c.off
box 0 0 0 6 1 1 >d.off
two="A=a.off B=b.off"
all="$two C=c.off D=d.off"

# Operators and what binds more strongly, by either library.
# shellcheck disable=SC2086
{
  gives 64 'A' A=a.off
  gives 101 'A | B' $two
  gives 74 'A ^ B' $two
  gives 37 'A - B' $two
  gives 27 'A & ~(A - B)' $two
  gives 37 'A & ~B' $two
  gives 39 '(A - B) | C & D' $all
  gives 3 'D - A | A & (B & C)' $all
}
# Halves, whole and cut.
gives_fast() {
  local want=$1
  shift
  expect 0 "closed, volume $want," csg "$@" -o out.off
  [ "$(volume out.off)" = "$want" ] || wrong "'$*': $(volume out.off)"
}
gives_fast 40 'A & half(z < 2.5)' A=a.off
gives_fast 24 'A - half(z < 2.5)' A=a.off
gives_fast 32 'A & half(0,0,0, 4,4,0, 0,0,4)' A=a.off
gives_fast 8 'half(z > 1) & A & half(x < 1) & half(y > 2) - half(z > 2) |
  A & half(z > 2) & half(y > 3) & half(x > 1)' A=a.off
expect 2 'line 1, column 3.*infinitely far' csg 'A | half(x < 1)' A=a.off \
  -o out.off
expect 2 'inside out' csg '~A' A=a.off -o out.off
expect 2 'no half-spaces' csg 'A & half(x < 1)' A=a.off -o out.off --impl ref
# Nothing is left: a mesh of no polygons.
expect 0 'volume 0,' csg 'A - A' A=a.off -o out.off
# It is an operand like any other.
cp out.off nothing.off
gives 64 'A - N | translate(N, 1, 2, 3)' A=a.off N=nothing.off
expect 0 'volume 0,' csg 'A & scale(N, 2) | N' A=a.off N=nothing.off -o out.off
expect 0 'volume 0,' csg N N=nothing.off --trust -o out.off
expect 2 'union takes two files' csg union a.off -o out.off

# Transforms: exact in decimals, powers of two, quarter turns and mirrors.
expect 0 'moved 0 coordinates' csg 'translate(A, 0.1, -1e-6, 3) | A' A=a.off \
  -o out.off
gives 8 'scale(A, 0.5)' A=a.off
gives 64 'A & scale(rotate(A, 0, 0, 1, -180), -1, -1, 1) |
  rotate(rotate(A, 1, 0, 0, 90), 1, 0, 0, -90)' A=a.off
gives 128 'A | scale(A, -1, 1, 1)' A=a.off
gives 64 'matrix(A, 0.6,-0.8,0,7, 0.8,0.6,0,0, 0,0,1,0)' A=a.off
# Any other turn is rounded, to the grid of 40 bits if not told otherwise, and
# that is said; the finer the grid, the less.
: >moves
for grid in 26 40 54; do
  expect 0 'moved [1-9][0-9]* coordinates (by at most' csg \
    'rotate(A, 1, 2, 3, 10)' A=a.off -o "turned-$grid.off" --grid $grid \
    --stats stats.json
  number stats.json max_move | tail -n 1 >>moves
done
[ "$(wc -l <moves)" = 3 ] || wrong "moves are not three: $(cat moves)"
sort -gr moves | cmp - moves || wrong "moves do not shrink: $(cat moves)"
expect 0 'moved [1-9]' csg 'rotate(A, 1, 2, 3, 10)' A=a.off -o out.off
same out.off turned-40.off
# What is written is a solid as it stands, on the finest grid, too, and in
# floats: it is read again without repair.
for grid in 40 54; do
  for file in out.off out.stl out.ply out.obj; do
    expect 0 'moved [1-9]' csg 'A - rotate(A, 1, 2, 3, 10) | B' A=a.off B=b.off \
      -o $file --grid $grid
    expect 0 'moved 0 coordinates (by at most 0), triangulated 0, dropped 0' \
      csg F F=$file -o again.off
  done
done
# A slab thinner than floats are fine vanishes, and that is said, or refused. In
# doubles it is there.
slab='A - translate(A, 0, 0, -1e-9)'
expect 0 'warning: rounding lost 6 of 6 faces.*made 1 part of the surface 0' \
  csg "$slab" A=a.off -o slab.stl
expect 2 'rounding lost 6 of 6 faces.*nothing was written' csg "$slab" A=a.off \
  -o none.stl --strict
[ ! -e none.stl ] || wrong "none.stl was written"
expect 0 'result: 6 polygons' csg "$slab" A=a.off -o slab.off --strict
# So is a move beyond a bound.
expect 2 'rounding moves the surface by up to .*near' csg \
  'rotate(A, 1, 2, 3, 10)' A=a.off -o none.stl --max-move 1e-12
[ ! -e none.stl ] || wrong "none.stl was written"
expect 0 'moved [1-9]' csg 'rotate(A, 1, 2, 3, 10)' A=a.off -o out.stl \
  --max-move 1e-5
# What is too small for the grid of the others does not vanish unseen.
expect 2 'a.off.*line 1, column 7.*nothing is left of it' csg \
  'scale(A, 1e40) | A' A=a.off -o out.off
# A turned box is still a box's worth, nearly.
expect 0 'volume \(64\|64.0000000\|63.9999999\)' csg 'rotate(A, 1, 2, 3, 10)' A=a.off -o out.off

# Scripts: files beside them, names given again, lines that go on.
mkdir parts
cp a.off b.off parts/
printf '# first\nX = "a.off" -\n  "b.off"\nX = (X |\nD)\nX\n' >parts/first.csg
expect 0 'volume 39,' csg --script parts/first.csg D=d.off -o out.off
expect 2 'first.csg: line 5, column 1.*D.*stands for nothing' csg \
  --script parts/first.csg -o out.off
expect 2 "E.*never used" csg --script parts/first.csg D=d.off E=d.off -o o.off
printf 'x = y\ny = x\n' >cyclic.csg
expect 2 'cyclic.csg: line 1, column 5.*y.*stands for nothing' csg \
  --script cyclic.csg -o out.off
: >empty.csg
expect 2 'empty.csg.*no statement' csg --script empty.csg -o out.off
expect 2 'none.csg' csg --script none.csg -o out.off
expect 2 'none.off' csg '"none.off"' -o out.off
python3 -c 'print("(" * 100000 + "A" + ")" * 100000)' >deep.csg
expect 0 'volume 64,' csg --script deep.csg A=a.off -o out.off
python3 -c 'print("(" * 100000 + "A")' >open.csg
expect 2 'column 100000.*never closed' csg --script open.csg A=a.off -o out.off
# A row of boxes, each a third into the next: one by one, and by doubling.
{
  echo 's = "a.off"'
  for i in $(seq 1 99); do echo "s = s | translate(\"a.off\", $((3 * i)), 0, 0)"; done
} >row.csg
expect 0 'volume 4816,' csg --script row.csg -o row.off --merge plane
[ "$(sed -n 2p row.off | cut -d' ' -f1,2)" = '8 6' ] ||
  wrong "row.off: $(sed -n 2p row.off)"

# Where polygons come from; and their colours.
expect 0 'closed' csg difference a.off b.off -o out.off --origin origin.txt \
  --stats stats.json
[ "$(number stats.json faces)" = 9 ] || wrong "faces in stats.json"
[ "$(grep -vc '^solid' origin.txt)" = "$(number stats.json polygons_out)" ] ||
  wrong "origin.txt and stats.json have other numbers of polygons"
[ "$(sed -n 2p out.off | cut -d' ' -f2)" = "$(number stats.json polygons_out)" ] ||
  wrong "out.off and stats.json have other numbers of polygons"
[ "$(grep -c '^solid' origin.txt)" = 2 ] || wrong "solids in origin.txt"
grep -q '^solid 1 B (line 1, column 5) b.off$' origin.txt ||
  wrong "origin.txt: $(head -n 2 origin.txt)"
grep -v solid origin.txt | sort -u | tr '\n' ' ' >origins
[ "$(cat origins)" = '0 0 0 1 0 2 0 3 0 4 0 5 1 0 1 2 1 4 ' ] ||
  wrong "origins: $(cat origins)"
expect 0 'closed' csg 'A & half(z < 2)' A=a.off -o out.off --origin origin.txt
[ "$(sed -n 2p origin.txt)" = 'solid 1 half (line 1, column 5)' ] ||
  wrong "origin.txt: $(head -n 2 origin.txt)"
[ "$(grep -c '^1 0$' origin.txt)" = 1 ] || wrong "the cut in origin.txt"
[ -z "$(awk 'NR > 10 && NF > 5' out.off)" ] || wrong "colours in out.off"
sed '11,$s/$/ 9 8 7/' a.off >colored.off
expect 0 'closed' csg 'A & half(z < 2)' A=colored.off -o out.off
[ "$(grep -c '^4 [0-9 ]* 9 8 7$' out.off)" = 5 ] || wrong "colours of out.off"
[ "$(grep -c '^4 [0-9]* [0-9]* [0-9]* [0-9]*$' out.off)" = 1 ] ||
  wrong "the cut in out.off"
expect 0 'closed' csg difference a.off b.off -o out.off --origin origin.txt
expect 2 'origin' csg difference a.off b.off -o o.off --origin o --impl ref
# Polygons count as in the file, where one has no area and two are no convex
# polygons; also when they have been bent by rounding, and cut once more.
cat >angle.off <<EOF
OFF
12 9 0
0 0 0
4 0 0
4 2 0
2 2 0
2 4 0
0 4 0
0 0 3
4 0 3
4 2 3
2 2 3
2 4 3
0 4 3
3 0 1 0
6 5 4 3 2 1 0
6 6 7 8 9 10 11
4 0 1 7 6
4 1 2 8 7
4 2 3 9 8
4 3 4 10 9
4 4 5 11 10
4 5 0 6 11
EOF
for moved in 'A - A | translate(A, 9, 0, 0)' 'rotate(A, 1, 2, 3, 25)'; do
  expect 0 'closed' csg "$moved" A=angle.off -o moved.off --origin angle.txt
  grep -v solid angle.txt | cut -d' ' -f2 | sort -u | tr '\n' ' ' >origins
  [ "$(cat origins)" = '1 2 3 4 5 6 7 8 ' ] || wrong "$moved: $(cat origins)"
done
sed '11,$s/$/ 10 20 30/' a.off >red.off
sed '11,$s/$/ 40 50 60/' b.off >green.off
expect 0 'result' csg difference red.off green.off -o out.off
[ "$(grep -c ' 10 20 30$' out.off)" = "$(grep -c '^0' origin.txt)" ] ||
  wrong "colours of A in out.off"
[ "$(grep -c ' 40 50 60$' out.off)" = 3 ] || wrong "colours of B in out.off"

# What has no colour has none after a PLY, and no material comes of it.
expect 0 'result' csg difference red.off b.off -o some.ply
expect 0 'result' csg A A=some.ply -o again.ply
same some.ply again.ply
expect 0 'result' csg A A=some.ply -o out.off
[ "$(grep -c ' 10 20 30$' out.off)" = 15 ] || wrong "colours of out.off"
[ "$(grep -c '^4 [0-9]* [0-9]* [0-9]* [0-9]*$' out.off)" = 3 ] ||
  wrong "what has no colour has one in out.off"
expect 0 'result' csg A A=some.ply -o out.obj
[ "$(grep -c '^newmtl' out.mtl)" = 1 ] || wrong "materials of out.mtl"

# Any number of threads writes the same bytes; a share is checked.
for i in $(seq 0 69); do
  printf 'translate(scale(A, 0.5), %d, %d, 0.25) |\n' $((i % 10)) $((i / 7))
done | sed '$s/|$//' >many.csg
for threads in 1 2 4; do
  expect 0 'closed' csg --script many.csg --threads $threads -o many.off \
    --stats many.json A=a.off
  [ $threads = 1 ] && cp many.off one.off
  cmp -s many.off one.off || wrong "$threads threads write other bytes"
done
expect 0 'shadow: 69 of 69 booleans checked at .* points, 0 mismatches' \
  csg --script many.csg --shadow 1 -o many.off A=a.off
cmp -s many.off one.off || wrong "--shadow changes the result"
expect 0 'shadow: 2 of 2 booleans' csg '(A ^ B) - half(x < 1) - B' A=a.off \
  B=b.off --shadow 1 -o out.off
expect 2 'impl fast' csg 'A - B' A=a.off B=b.off --shadow 1 --impl ref -o o.off
expect 2 'shadow' csg 'A - B' A=a.off B=b.off --shadow 1.5 -o o.off

# Surfaces that cross themselves, and open ones, are refused with the place.
{
  echo OFF
  echo 16 12 0
  sed -n '3,10p' a.off
  sed -n '3,10p' b.off
  sed -n '11,16p' a.off
  sed -n '11,16p' b.off | awk '{ print $1, $2 + 8, $3 + 8, $4 + 8, $5 + 8 }'
} >crossed.off
expect 2 'crossed.off.*polygons 1 and 8 cross near' csg 'A - X' A=a.off \
  X=crossed.off -o out.off
expect 0 'repaired: X: 6 pairs' csg X X=crossed.off --repair \
  -o out.off --stats stats.json
expect 0 'volume 101,' csg X X=crossed.off --repair -o out.off
expect 0 'volume 101,' csg X X=crossed.off --repair -o o.off --impl ref
expect 2 'crossed.off.*5 more' csg '"crossed.off"' -o out.off --impl ref
# One that passes through itself along edges alone: an octahedron whose equator
# lies in a face of a box. As two operands they make no difference.
cat >box.off <<END
OFF
8 6 0
-3 -3 -6
3 -3 -6
3 3 -6
-3 3 -6
-3 -3 0
3 -3 0
3 3 0
-3 3 0
4 3 2 1 0
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
END
cat >octahedron.off <<END
OFF
6 8 0
1 0 0
-1 0 0
0 1 0
0 -1 0
0 0 1
0 0 -1
3 0 2 4
3 2 1 4
3 1 3 4
3 3 0 4
3 2 0 5
3 1 2 5
3 3 1 5
3 0 3 5
END
{
  echo OFF
  echo 14 14 0
  sed -n '3,10p' box.off
  sed -n '3,8p' octahedron.off
  sed -n '11,16p' box.off
  sed -n '9,16p' octahedron.off |
    awk '{ print $1, $2 + 8, $3 + 8, $4 + 8 }'
} >sunk.off
for impl in fast ref; do
  expect 2 'sunk.off.*polygons 1 and 6 cross near.*7 more' csg X X=sunk.off \
    --impl $impl -o out.off
  expect 0 'volume 216.666666667,' csg X X=sunk.off --repair --impl $impl \
    -o out.off
done
expect 0 'volume 216.666666667,' csg 'A | B' A=box.off B=octahedron.off -o o.off
sed '$d' a.off | sed 's/^8 6/8 5/' >lid.off
expect 2 'lid.off.*4 bad edges' csg 'A - X' A=a.off X=lid.off -o out.off
# But where vertices lie within edges, as where import drops a polygon without
# area, a surface that is closed along every line is closed.
box 0 0 0 4 4 4 | awk 'NR == 2 { $0 = "10 7 0" } { print }
  NR == 10 { print "1 0 4"; print "3 0 4" }' |
  sed 's/^4 0 1 5 4$/6 0 1 5 9 8 4/; $a\4 4 8 9 5' >needle.off
expect 0 'closed: 2 corners added' csg X X=needle.off -o out.off
expect 0 'closed, but for 2 corners' info needle.off
gives 37 'X - B' X=needle.off B=b.off
# The face on the other side has one of the two corners, and no needle is there.
sed '$d; 2s/7/6/' needle.off | sed 's/^4 4 5 7 6/5 4 9 5 7 6/' >tee.off
gives 64 X X=tee.off
sed '$d; 2s/7/5/' needle.off | sed '/^4 0 2 3 1$/d' >lid.off
expect 2 'lid.off.* bad edges' csg X X=lid.off -o out.off
expect 0 'not closed: 8 bad edges' info lid.off
# One within another that faces outwards too, one that faces inwards, and a wall
# of no thickness. What --trust does not look for is told, or the result is.
box 1 1 1 2 2 2 | sed -n '3,$p' >inner
box 0 0 0 4 4 4 | sed -n '3,10p' >eight
inner_faces=$(sed '1,8d' inner |
  awk '{ print $1, $2 + 8, $3 + 8, $4 + 8, $5 + 8 }')
shell_of() { # NAME FACES-WITHIN
  { echo OFF; echo "16 $((6 + $(wc -l <<<"$2"))) 0"; cat eight
    head -8 inner; box 0 0 0 4 4 4 | sed -n '11,16p'; echo "$2"; } >"$1"
}
shell_of twice.off "$inner_faces"
expect 2 'twice.off.*winds round a place twice: polygon 6 .* near 1, 1, 1' \
  csg X X=twice.off -o out.off
sed '2s/12/13/; 18a 3 0 1 0' twice.off >flat.off
expect 2 'flat.off.*winds round a place twice: polygon 7 .* near 1, 1, 1' \
  csg X X=flat.off -o out.off
expect 0 'volume 64,' csg X X=twice.off --repair -o out.off
shell_of hollow.off "$(awk '{ print $1, $5, $4, $3, $2 }' <<<"$inner_faces")"
expect 0 'volume 63,' csg X X=hollow.off -o out.off --stats stats.json
grep -q '"trusted": false' stats.json || wrong "trusted without --trust"
{ head -10 hollow.off | sed '2s/.*/8 6 0/'
  box 0 0 0 4 4 4 | sed -n '11,16p' | awk '{ print $1, $5, $4, $3, $2 }'
} >inwards.off
expect 2 'inside out: polygon 0 faces inwards' csg X X=inwards.off -o out.off
expect 2 'inside out: its volume is -64' csg X X=inwards.off --trust -o out.off
expect 2 'leaves nothing' csg X X=inwards.off --repair -o out.off
shell_of wall.off "4 8 9 11 10
4 10 11 9 8"
box 1.5 1 0 3 3 5 >cutter.off
expect 2 'wall.off.*polygons 6 and 7 overlap' csg X X=wall.off -o out.off
expect 2 'trust did not look.*bad edges; .*wall.off.*polygons 6 and 7 overlap' \
  csg 'X - C' X=wall.off C=cutter.off --trust -o out.off
# What is too small beside the others is named, and where it was moved, if so.
box -1e300 -1e300 -1e300 1e300 1e300 1e300 >huge.off
expect 2 'a.off: as it stands at line 1, column 1: nothing is left of it' \
  csg 'A | H' A=a.off H=huge.off -o out.off
expect 2 'a.off: as moved at line 1, column 11: nothing is left of it' \
  csg 'translate(A, 1, 2, 3) | H' A=a.off H=huge.off -o out.off
# What comes of edges that cross in a face is not fixed, but one or the other.
"$program" csg 'X & half(z < 2.5)' X=crossed.off --trust -o out.off >stdout \
  2>stderr
case $? in
  0) grep -q '^trusted: nobody looked' stdout || wrong "--trust is not told" ;;
  2) grep -q 'trust did not look' stderr || wrong "--trust: $(cat stderr)" ;;
  *) wrong "--trust stopped the program: $(cat stderr)" ;;
esac
expect 0 'trusted: nobody looked' csg 'A - B' A=a.off B=b.off --trust \
  -o out.off --stats stats.json
grep -q '"trusted": true' stats.json || wrong "--trust is not in the statistics"

# Many files at once, and the language.
box 0 0 0 1 1 1 >m1.off
box 2 0 0 3 1 1 >m2.off
box 4 0 0 5 1 1 >m3.off
expect 0 'volume 3,' csg union m1.off m2.off m3.off -o out.off
expect 0 'volume 1,' csg difference m1.off m2.off m3.off -o out.off
expect 2 'takes two files or more' csg union m1.off -o out.off
expect 0 'volume 24,' csg 'box(2, 3, 4)' -o out.off
expect 0 'volume 4,' csg 'union([for i in range(4): translate(A, 2 * i, 0, 0)])' \
  A=m1.off -o out.off
expect 2 'line 1, column 1: this bracket is never closed' csg 'box(1' -o out.off
# Files where an expression was expected.
expect 2 'm1.off: this is a file, .*A A=FILE.*--script' csg m1.off -o out.off
expect 2 'm1.off: this is a file' csg m1.off - m2.off -o out.off
expect 2 'column 3: .*files stand in quotes' csg 'm1.off - m2.off' -o out.off
# Inside out: the advice works.
sed 's/^\(4\) \(.*\) \(.*\) \(.*\) \(.*\)$/\1 \5 \4 \3 \2/' m1.off >turned.off
expect 2 'turned.off.*inside out.*flip' csg union turned.off m2.off -o out.off
expect 2 'turned.off.*flip' csg A A=turned.off --repair -o out.off
expect 0 'volume 2,' csg 'flip(A) | B' A=turned.off B=m2.off -o out.off
# What OpenSCAD exports.
printf 'group() {\n difference() {\n  cube(size = [3, 3, 3], center = false);\n' \
  >scad.csg
printf '  import(file = "m1.off", layer = "");\n }\n}\n' >>scad.csg
expect 0 'volume 26,' csg --script scad.csg -o out.off
printf 'group() { minkowski() { cube(size = 1); } }\n' >minkowski.csg
expect 2 'minkowski.csg: line 1, column 11: minkowski is not read' \
  csg --script minkowski.csg -o out.off
finish
