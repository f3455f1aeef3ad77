#!/usr/bin/env bash
# Figures: every pixel's centre lies in the region of the polygon that the
# image shows there, in all formats the same regions, errors one line.
check=$(realpath "$(dirname "$0")/draw_check.py")
. "$(dirname "$0")/expect.sh"

"$make_model" interlocking-cubes -o cubes.off || exit 1
"$make_model" pinwheel -o pinwheel.off || exit 1
for model in cubes pinwheel; do
  for view in "" "--ortho" "--cull" "--near 1" "--fov 90"; do
    # shellcheck disable=SC2086
    set -- $view --size 96x72
    expect 0 'regions' draw "$model.off" "$@" -o a.svg --by polygon \
      --decimals 6
    expect 0 'span' render "$model.off" "$@" -o a.png --ids a.npy
    python3 "$check" a.svg a.npy || wrong "$model $view: the figure differs"
  done
done
# What joins more has fewer regions; a figure of the same is the same.
expect 0 ' [0-9]* regions' draw cubes.off -o face.svg --by face
expect 0 ' regions' draw cubes.off -o again.svg --by face
same face.svg again.svg
for ending in pdf eps tex; do
  expect 0 ' regions' draw cubes.off -o "a.$ending" --lines regions
  [ -s "a.$ending" ] || wrong "a.$ending is empty"
done
head -c 8 a.pdf | grep -q '%PDF-1.4' || wrong "a.pdf is no PDF"
expect 0 ' 1 regions' draw cubes.off -o none.svg --eye 900,0,0 --target 999,0,0
expect 2 'one of .svg .pdf .eps .tex' draw cubes.off -o a.bmp
expect 2 'more than 3 cells' draw cubes.off -o b.svg --most-cells 3
[ -e b.svg ] && wrong "a figure that is too large was written"
expect 2 'must be\|not in' draw cubes.off -o a.svg --by colours

exit $((failures > 0))
