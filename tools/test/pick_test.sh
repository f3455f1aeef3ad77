#!/usr/bin/env bash
# Picks are the item image; rays hit in order, with exact shares of the way;
# errors are one line.
. "$(dirname "$0")/expect.sh"

"$make_model" interlocking-cubes -o cubes.off || exit 1
for view in "" "--ortho" "--cull" "--near 1" "--view top"; do
  # shellcheck disable=SC2086
  set -- $view --size 24x18
  expect 0 'span' render cubes.off "$@" -o a.png --ids a.npy
  for pixel in 0,0 12,9 7,5 23,17 11,13; do
    expect 0 'polygon\|nothing' pick cubes.off "$@" --at $pixel
    python3 - $pixel <<'PYTHON' || wrong "$view: $pixel differs from the image"
import sys
x, y = map(int, sys.argv[1].split(","))
raw = open("a.npy", "rb").read()
ids = raw[-24 * 18 * 4:]
at = 4 * (y * 24 + x)
item = int.from_bytes(ids[at:at + 4], "little", signed=True)
words = open("stdout").read().split()
found = int(words[1]) if words[0] == "polygon" else -1
sys.exit(item != found)
PYTHON
    mv stdout whole
    expect 0 'polygon\|nothing' pick cubes.off "$@" --at $pixel --lazy
    same stdout whole
  done
done

box 0 0 0 2 2 2 >box.off
expect 0 'point 0, 0.5, 1  distance 1  t 1/2' pick box.off --from -1,0.5,1 \
  --along 2,0,0
[ "$(wc -l <stdout)" = 1 ] || wrong "more than the first hit"
expect 0 't 1/4' pick box.off --from -1,0.5,1 --to 3,0.5,1 --all
[ "$(wc -l <stdout)" = 2 ] || wrong "a box is not hit twice"
expect 0 '"parameter": "3/4"' pick box.off --from -1,0.5,1 --to 3,0.5,1 --all \
  --json
expect 0 'nothing' pick box.off --from -1,0.5,1 --to -0.5,0.5,1
expect 0 'visible' pick box.off --from -1,-1,5 --sees 5,9,5
expect 0 'hidden' pick box.off --from -1,0.5,1 --sees 3,0.5,1
"$make_model" sphere --count 40 -o ball.off || exit 1
for ask in "--from 9,8,7 --along -9,-8,-7" "--from 9,0.5,0.6 --to -9,-2,-1 --all" \
  "--from 9,8,7 --sees -9,-8,-7" "--at 320,240 --clip 1,1,1,0 --cap hatch"; do
  # shellcheck disable=SC2086
  set -- $ask
  expect 0 '.' pick ball.off "$@" --stats a.json
  mv stdout whole
  expect 0 '.' pick ball.off "$@" --lazy --stats b.json
  same stdout whole
  [ -n "$(number a.json ask_ms)" ] || wrong "$ask: no ask_ms in --stats"
  [ "$(number a.json nodes)" -gt 0 ] || wrong "$ask: no tree in --stats"
  [ "$(number b.json polygons_built)" -lt "$(number b.json polygons)" ] ||
    wrong "$ask: all was built"
  [ "$(number b.json cells_built)" -gt 0 ] || wrong "$ask: nothing was built"
done
expect 2 'none/a.json' pick box.off --at 1,1 --stats none/a.json
expect 2 'X,Y, a column' pick box.off --at 1
expect 2 'the image has the columns 0 to 639' pick box.off --at 640,0
expect 2 'give --at' pick box.off
expect 2 'give --at' pick box.off --from 0,0,0
expect 2 'give --at' pick box.off --at 1,1 --from 0,0,0 --to 1,1,1
expect 2 'goes nowhere' pick box.off --from 0,0,0 --along 0,0,0
expect 2 'goes nowhere' pick box.off --from 0,0,0 --to 0,0,0
expect 2 '64 times' pick box.off --from 0,0,0 --to 1e30,0,0
expect 2 'cut what --at sees' pick box.off --from 0,0,0 --to 1,1,1 --clip 1,0,0,0
expect 2 'needs a ray' pick box.off --at 1,1 --all

finish
