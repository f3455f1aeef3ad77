#!/usr/bin/env bash
# Exact solids in files: what leaves comes back.
. "$(dirname "$0")/expect.sh"
reader=${0%/*}/../../examples/read_solid.py

box 0 0 0 3 3 3 >a.off
box 1 1 1 5 4 4.5 >b.off
# A wedge, whose meets with boxes are on no grid.
cat >c.off <<'END'
OFF
6 5 0
-1 -1 -1
7 0 2
-1 6 0
-1 -1 8
7 0 9
-1 6 11
3 0 2 1
3 3 4 5
4 0 1 4 3
4 1 2 5 4
4 2 0 3 5
END
expect 0 closed csg 'translate(C, 0.1, 0.2, 0.3)' C=c.off -o d.off

# Chains give the bytes of one script.
for first in '|' '&' '-' '^'; do
  for second in '|' '-' '^'; do
    for third in '&' '-'; do
      expect 0 closed csg "((A $first B) $second C) $third D" \
        A=a.off B=b.off C=c.off D=d.off -o one.off
      expect 0 closed csg "A $first B" A=a.off B=b.off -o ab.hsolid.gz
      expect 0 closed csg "X $second C" X=ab.hsolid.gz C=c.off \
        --format hsolid-text -o abc.hsolid
      expect 0 closed csg "X $third D" X=abc.hsolid D=d.off -o chain.off
      same one.off chain.off
    done
  done
done
# Moves too, and mirrors.
expect 0 closed csg 'mirror(translate(A - C, 1, 2, 3), 1, 0, 0) | B' \
  A=a.off B=b.off C=c.off -o one.off
expect 0 closed csg 'A - C' A=a.off C=c.off -o ac.hsolid
expect 0 'moved 0 coordinates' csg 'mirror(translate(X, 1, 2, 3), 1, 0, 0) | B' \
  X=ac.hsolid B=b.off -o chain.off
same one.off chain.off
# What no grid holds is rounded, and is a solid.
expect 0 closed csg 'rotate(X, 1, 2, 3, 25) - B' X=ac.hsolid B=b.off -o turned.off
expect 0 closed info turned.off

# Other programs read it: the example's volume is exact.
expect 0 'volume 19,' csg 'A - B' A=a.off B=b.off -o ab.hsolid
for form in hsolid hsolid-text; do
  "$program" csg 'A - B' A=a.off B=b.off -o - --format $form >form.hsolid ||
    wrong "csg --format $form"
  [ "$(python3 "$reader" form.hsolid)" = "9 faces, 2 parts, volume 19" ] ||
    wrong "read_solid.py of $form: $(python3 "$reader" form.hsolid)"
done
# On standard input, for the commands that want polygons, and for info.
expect 0 'volume     19' info ab.hsolid
# The solid's own volume, box and faces, not those of its surface in doubles.
expect 0 closed csg 'hull(0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0, 3) &
  half(0, 0, 1, 1, 0, 0, 0, 1, 0) & half(x < 0.7)' -o corner.hsolid
expect 0 '^volume     973/6000$' info corner.hsolid --exact
expect 0 '^volume     0.162166666667$' info corner.hsolid
expect 0 '^to         0.7, 1, 1$' info corner.hsolid --exact
expect 0 '"exact_volume": "973/6000"' info corner.hsolid --json
expect 0 closed csg 'hull(0, 0, 0, 3, 0, 0, 0, 7, 0, 0, 0, 1) & half(x < 1) &
  half(y < 3)' -o thirds.hsolid
expect 0 '^vertices   8, 3 of them where three planes meet$' info thirds.hsolid
expect 0 '^volume     13/7$' info thirds.hsolid --exact
expect 0 '^to         1, 3, 1$' info thirds.hsolid --exact
expect 0 '^solid      yes' info thirds.hsolid --check
"$program" info - <form.hsolid | grep >/dev/null 'volume     19' || wrong 'info -'
cat form.hsolid | "$program" csg 'X - translate(Y, 1, 0, 0)' X=- Y=- -o x.off -q ||
  wrong 'csg - twice'
"$program" csg 'X - B' X=- B=b.off -o chain.hsolid <form.hsolid >out.txt ||
  wrong 'csg -'
expect 0 painted render ab.hsolid -o ab.png
# It is no mesh, and there is nothing in it to mend.
expect 2 'ab.hsolid: an exact file needs no repair: .* A=ab.hsolid -o x.off' \
  repair ab.hsolid -o x.off
expect 2 'x.hsolid: .* as a mesh first; .* makes an exact file of that' \
  repair a.off -o x.hsolid
"$program" repair - -o x.off <form.hsolid 2>stderr &&
  wrong 'an exact file was repaired'
grep -q 'standard input: an exact file is no mesh' stderr ||
  wrong "repair of an exact pipe: $(cat stderr)"
# Units beyond all doubles, and the file in the error.
"$program" csg A A=ab.hsolid -o - --format hsolid-text |
  sed 's/^unit .*/unit 10 4096/; s/^checksum .*/checksum -/' >far.hsolid
expect 2 'far.hsolid: the coordinates need a unit' \
  csg 'A - B' A=far.hsolid B=b.off -o x.off
expect 2 'far.hsolid: the coordinates need a unit' \
  csg 'A & half(x < 5)' A=far.hsolid -o x.off
sed 's/^unit .*/unit 2 4096/' far.hsolid >farther.hsolid
expect 2 'farther.hsolid: .*coordinates are beyond the greatest double' \
  csg 'translate(A, 0.3, 0, 0)' A=farther.hsolid -o x.off
sed 's/^unit .*/unit 10 300/' far.hsolid >300.hsolid
expect 2 'x.stl: the solid.s coordinates go up to .*e+300' \
  csg 'rotate(A, 0, 0, 1, 30)' A=300.hsolid -o x.stl
# Origins are those of the first operands.
grep -a -q 'a.off' chain.hsolid || wrong 'the parts are lost'

# A surface that touches itself along an edge within a face has a slit there,
# which is in the file, so that what goes on from it is what it would have been.
wedge='matrix(C, 1, -1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)'
"$program" csg 'box(4, 2, 3)' -o c.off >out.txt || wrong 'c.off'
"$program" csg 'box(1, 1, 9)' -o d.off >out.txt || wrong 'd.off'
expect 0 'volume 22,' csg "$wedge - translate(D, 2, 0, -7)" C=c.off D=d.off \
  -o slit.hsolid
expect 0 'volume 22,' csg 'A' A=slit.hsolid -o again.hsolid
expect 0 'volume 19,' csg 'A - translate(D, 0, 0, -3)' A=slit.hsolid D=d.off \
  -o chained.off
expect 0 'volume 19,' csg \
  "($wedge - translate(D, 2, 0, -7)) - translate(D, 0, 0, -3)" \
  C=c.off D=d.off -o whole.off
same chained.off whole.off
# Nor does an exact file tell what was written on the way.
for format in off hsolid; do
  expect 0 closed csg '(box(2) | sphere(2, 8)) - translate(box(1, 9, 1), 0, 1, 1)' \
    -o whole.$format
  expect 0 closed csg 'box(2) | sphere(2, 8)' -o part.hsolid
  expect 0 closed csg 'P - translate(box(1, 9, 1), 0, 1, 1)' P=part.hsolid \
    -o chained.$format
  same chained.$format whole.$format
done
python3 "${0%/*}/../../examples/read_solid.py" slit.hsolid | grep >/dev/null ' 22$' ||
  wrong "read_solid.py: slit.hsolid"

# Nor does it matter how often a solid is named, which is named first, or where
# half-spaces stand: whole = X1 OP X2, by one script and by three commands.
chain() { # X1 OP X2, of A and b.off
  expect 0 closed csg "$1" A=a.off -o x1.hsolid
  expect 0 closed csg "$3" A=a.off -o x2.hsolid --format hsolid-text
  for format in off stl hsolid; do
    expect 0 closed csg "($1) $2 ($3)" A=a.off -o whole.$format
    expect 0 closed csg "X1 $2 X2" X1=x1.hsolid X2=x2.hsolid -o chained.$format
    same chained.$format whole.$format
  done
}
moved='translate(A, 1, 0, 0)'
chain '"b.off" | A | translate("b.off", 0, 0, 0)' '|' 'A - "b.off"'
chain 'A & "b.off"' '|' 'A | "b.off"'
chain '"b.off" - A & half(x < 4)' '|' \
  'A & half(x < 2) & half(z > 1) | "b.off" & half(x < 4)'
chain "A | $moved | box(1) | half(z < 2) & \"b.off\"" '-' "$moved & half(x < 2)"
chain 'mirror(A & half(x < 2) | box(1, 2, 9), 1, 0, 0)' '|' \
  'mirror(A, 1, 0, 0) | "b.off" & half(x > -2)'
chain "translate(translate(A, -1, 0, 0) | $moved, 1, 0, 0)" '^' 'A | box(1)'
# Planes that no vertex on the grid is on are named by their place in space.
tetrahedron() { # CORNERS
  printf '%s\n' OFF '4 4 0' "$@" '3 0 2 1' '3 0 1 3' '3 1 2 3' '3 2 0 3'
}
tetrahedron '-1 0.5 0' '3 -1 0.25' '2 3 0' '1 1 3.5' >a.off
tetrahedron '0 0 0' '4 1 0' '1 4 1' '1 1 5' >t.off
chain 'A & half(2, 0.5, -2, 2, -2, -2, 0, 3, 1)' '&' 'A & "t.off"'
chain 'A & half(0, 3, 0.1, 0.5, 0.5, 0.1, 0.5, 1.25, 1)' '&' 'A - box(1, 1, 2)'
# What is a point on one grid and none on another is the same in files, and so
# are numbers that are rounded; of symmetric differences the order stays.
hull='hull(-1.5, 1.7, 0.24, 2, -1, -1, 1, -0.3, -2.5, -1, 3, 0, -3, -0.5, -3)'
turn='0.6, -0.8, 0, 0, 0.8, 0.6, 0, 0, 0, 0, 1, 0'
tetrahedron '-2.8 -4 2' '0 2.875 -3.31' '0.4 -2 2' '3 -2.5 3.72' >a.off
tetrahedron '1 -3 1' '1 0.7 -3' '-1.67 1.875 3' '2 3 2' >t.off
expect 0 closed csg 'A - "t.off"' A=a.off -o x1.hsolid
expect 0 closed csg 'cylinder(4.5, 3.75, 7) - (A - "t.off")' A=a.off -o whole.hsolid
expect 0 closed csg 'cylinder(4.5, 3.75, 7) - X1' X1=x1.hsolid -o chained.hsolid
same chained.hsolid whole.hsolid
chain "matrix($hull & half(y > 0.5), $turn) | A - A" '-' A
chain 'A - A | cylinder(1.8, 1, 6)' '^' '(box(4, 4, 2.5) | A - A) ^ box(4, 4, 2.5)'
# A vertex that numbers hold is not rounded, whether it is a point or a meet.
tetrahedron '0 1.125 2.5' '-2 -3 0' '-2.88 -3 3' '-0.74 4 -0.5' >a.off
cut='A ^ (box(4, 3, 5) -
  half(-2, -1.8, -2.9, -0.75, -1.75, -1.29, 2.84, -1.95, 2.78))'
chain "rotate($cut, 0, 1, 0, 180)" '&' "rotate($cut, 0, 1, 0, 180)"
expect 0 closed csg "$cut" A=a.off -o x1.hsolid
expect 0 closed csg "rotate($cut, 0, 1, 0, 180)" A=a.off -o whole.stl
expect 0 closed csg 'rotate(X1, 0, 1, 0, 180)' X1=x1.hsolid -o chained.stl
same chained.stl whole.stl
chain 'A - A' '|' 'A & box(2) - A'
box 0 0 0 3 3 3 >a.off
# The unit and the bits are the solid's own, not those of what it was cut from.
"$program" csg 'box(2, 3, 4) - translate(box(1), 9.125, 0.3, 1e-9)' -o - \
  --format hsolid-text | sed -n 2,3p >own.txt
printf 'unit 10 0\ngrid 26\n' | cmp - own.txt || wrong "own unit: $(cat own.txt)"
"$program" csg 'box(2.25, 3, 4) - half(z > 3.125)' -o - \
  --format hsolid-text | sed -n 2,3p >own.txt
printf 'unit 2 -3\ngrid 26\n' | cmp - own.txt || wrong "own unit: $(cat own.txt)"

# Primitives are called by what they are, not by where they stood, and have no
# colour; a colour of a file goes on.
expect 0 closed csg 'box(3)' -o one.hsolid
expect 0 closed csg 'translate(box(2), 1, 1, 2)' -o two.hsolid
sed '11,$s/$/ 9 8 7/' b.off >nine.off
for format in off ply hsolid; do
  expect 0 closed csg '(A | B) - C' A=one.hsolid B=two.hsolid C=nine.off \
    -o chain.$format
  expect 0 closed csg '(box(3) | translate(box(2), 1, 1, 2)) - C' C=nine.off \
    -o script.$format
  same chain.$format script.$format
done
grep -q '^[0-9][0-9 ]* 9 8 7$' chain.off || wrong 'no colour in chain.off'
[ "$(grep -c '^[4-9] ' chain.off)" -gt "$(grep -c ' 9 8 7$' chain.off)" ] ||
  wrong 'faces without a colour have one'

# A changed byte is found; a file without a checksum is checked.
printf x | dd of=form.hsolid bs=1 seek=200 conv=notrunc 2>dd.txt
expect 2 'form.hsolid: line' info form.hsolid
printf x | dd of=ab.hsolid bs=1 seek=200 conv=notrunc 2>dd.txt
expect 2 'ab.hsolid: byte .*checksum' info ab.hsolid
sed 's/^checksum.*/checksum -/' abc.hsolid >edited.hsolid
expect 0 closed csg 'X' X=edited.hsolid -o edited.off
# Inside out: every side is the other, every loop runs the other way.
expect 2 'inside out' csg 'flip(X)' X=edited.hsolid -o edited.off
expect 2 'the reference' csg 'X - B' X=ac.hsolid B=b.off --impl ref -o x.off
expect 2 'must end in' csg 'A - B' A=a.off B=b.off -o x.hsolids
finish
