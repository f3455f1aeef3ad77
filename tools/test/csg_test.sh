#!/usr/bin/env bash
# Booleans: volumes, closed results in every format, operands of any units.
. "$(dirname "$0")/expect.sh"

# volumes A B UNION INTERSECTION DIFFERENCE
volumes() {
  local a=$1 b=$2 operation
  shift 2
  for operation in union intersection difference; do
    expect 0 "closed, volume $1," csg $operation "$a" "$b" -o out.off
    expect 0 'moved 0 coordinates' csg $operation "$a" "$b" -o out.scene
    for file in out.off out.scene; do
      [ "$1" = 0 ] || expect 0 'closed$' info "$file"
    done
    shift
  done
}

box 0 0 0 2 2 2 >a.off
box 1 1 1 3 3 3 >b.off
volumes a.off b.off 15 1 7
# Other units: tenths and thousandths; binary fractions; a scene.
box 0.5 0.5 0.5 1.5 1.5 1.125 >tenths.off
volumes a.off tenths.off 8 0.625 7.375
"$make_model" cube -o cube.scene || exit 1
volumes cube.scene a.off 8000000 8 7999992
expect 0 'closed' csg union a.off b.off -o big.stl
volumes big.stl tenths.off 15 0.625 14.375
# Faces that coincide, a box in itself, a box beside it, a box within it.
box 2 0 0 4 2 2 >beside.off
box 0.25 0.25 0.25 1.75 1.75 1.75 >within.off
volumes a.off beside.off 16 0 8
volumes a.off a.off 8 8 0
volumes a.off within.off 8 3.375 4.625
# What is said of the result is what is in the file, in every format.
for format in obj ply stl off; do
  expect 0 'volume 7,' csg difference a.off b.off -o "out.$format"
  expect 0 'surface    closed' info "out.$format"
  expect 0 'volume 7,' csg union "out.$format" "out.$format" -o out.scene
done
# The least surface, and the same bytes in whatever order the solids come: a
# block of 64 cubes, and some that are turned.
box 0 0 0 1 1 1 >unit.off
# union_of COUNT STEP TERM: the terms, every STEPth of them first.
union_of() {
  awk -v count="$1" -v step="$2" -v term="$3" 'BEGIN {
    for (n = 0; n < count; ++n) {
      i = n * step % count
      printf n ? " | " term : term, int(i / 16), int(i / 4) % 4, i % 4
    }
  }'
}
cube='translate(U, %d, %d, %d)'
turned='matrix(U, 2.1, -2.8, 0, %d.1, 2.8, 2.1, 0.5, %d, 0, 0, 3, %d)'
for step in 1 5 27; do
  expect 0 'result: 12 polygons' csg "$(union_of 64 $step "$cube")" \
    U=unit.off --merge plane -o block$step.stl
  expect 0 'moved [1-9]' csg "$(union_of 31 $step "$turned")" U=unit.off \
    --merge plane -o turned$step.off
  same block1.stl block$step.stl
  same turned1.off turned$step.off
done
# Corners off the grid: tilted bars. They are rounded, and that is said.
box -250 -250 -100 250 250 70 >block.off
"$make_model" pinwheel -o bars.scene || exit 1
expect 0 'out.off: moved [1-9][0-9]* vertices' csg difference block.off bars.scene \
  -o out.off --stats a.json
[ "$(number a.json bad_edges)" = 0 ] || wrong "bad edges in --stats"
expect 0 'surface    closed' info out.off
finish
