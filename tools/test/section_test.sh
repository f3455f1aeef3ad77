#!/usr/bin/env bash
# Sections: all methods give the same image, caps fill what is closed, and what
# cannot be cut is one line with nothing written.
. "$(dirname "$0")/expect.sh"

"$make_model" cube -o cube.off || exit 1
"$make_model" interlocking-cubes -o cubes.off || exit 1
"$make_model" klein-bottle -o klein.off || exit 1
cut=(--clip 0,1,0,-1.5 --clip 1,0.5,-2,40 --size 20x15)
for method in span painter zbuffer raycast; do
  expect 0 "$method" render cubes.off "${cut[@]}" --cap hatch \
    --method $method --ids $method.npy -o $method.png
  same span.npy $method.npy
  same span.png $method.png
done
expect 0 'span' render cubes.off --clip 0,1,0,-1.5 --clip 0,2,0,-3 --ids a.npy
expect 0 'span' render cubes.off --clip 0,1,0,-1.5 --ids b.npy
same a.npy b.npy
expect 0 'cap of clip plane 0' pick cubes.off --clip 0,1,0,-1 --cap hatch \
  --at 320,240
expect 0 'span' render cubes.off --yon 1e9 --ids far.npy
expect 0 'span' render cubes.off --ids all.npy
same far.npy all.npy

expect 0 'span' render cubes.off --clip 0,1,0,-1 --cap hatch --aa 2 \
  --ids fine.npy --size 12x9
expect 0 'span' render cubes.off --clip 0,1,0,-1 --cap hatch --aa 2 \
  --ids exact.npy --size 12x9 --impl ref
same fine.npy exact.npy
# Caps are blended as polygons are.
for how in fast ref; do
  expect 0 'painter' render cubes.off "${cut[@]}" --cap hatch --alpha 90 \
    --impl $how --ids "glass-$how.npy" -o "glass-$how.png"
done
same glass-fast.png glass-ref.png
same glass-fast.npy span.npy
# The reference beside the image checks what planes leave, and caps.
for cap in hatch part; do
  expect 0 ' 0 mismatches' render cubes.off "${cut[@]}" --cap $cap --shadow 1 \
    -o shadowed.png
  grep -q ' 300 pixels checked' stdout || wrong "not all pixels were checked"
done
# Exact areas of what is left, too.
for how in fast ref; do
  expect 0 'by exact' render cube.off --clip 1,2,0,-1 --clip 0,0,1,-0.3 \
    --cap hatch --aa exact --size 8x6 --impl "$how" -o "areas-$how.png"
done
same areas-fast.png areas-ref.png

# Polygons that are seen edge-on bound caps, and no list has them.
box 0 0 0 4 4 4 >cube.off
for eye in '--view front --ortho' '--eye 4,2,30 --target 4,2,0 --up 0,1,0'; do
  # shellcheck disable=SC2086
  set -- cube.off $eye --size 40x30 --clip 0,0,-1,2 --clip 0,1,0,-2 --cap hatch
  expect 0 'span' render "$@" --ids tree.npy
  expect 0 'depth sort' render "$@" --priority depthsort --ids list.npy
  expect 0 'mismatches: 0' compare tree.npy list.npy
done

# Planes of a film move evenly, and nothing is built anew.
cat >cut.path <<'END'
0 eye 30,20,15 target 2,2,2 clip 0,1,0,-1 clip 1,0,0,-0.5
4 clip 0,1,0,-3 clip 1,0,0,-0.5
END
expect 0 '5 frames' render cube.off --size 40x30 --path cut.path --cap hatch \
  -o moves-%d.png
for k in 0 1 2 3 4; do
  expect 0 'span' render cube.off --size 40x30 --eye 30,20,15 --target 2,2,2 \
    --clip "0,1,0,-$(python3 -c "print(1 + $k / 2)")" --clip 1,0,0,-0.5 \
    --cap hatch -o still.png
  same still.png moves-$k.png
done
cmp -s moves-0.png moves-4.png && wrong 'the planes do not move'
printf '0 eye 9,9,9 target 0,0,0 yon 10\n2 yon 20\n' >yon.path
expect 0 '3 frames' render cube.off --size 40x30 --path yon.path -o yon-%d.png
expect 0 'span' render cube.off --size 40x30 --eye 9,9,9 --target 0,0,0 \
  --yon 15 -o still.png
same still.png yon-1.png
bad_path() { # MESSAGE LINES
  printf '0 eye 9,9,9 target 0,0,0 %b\n' "$2" >bad.path
  expect 2 "$1" render cube.off --size 40x30 --path bad.path -o no-%d.png \
    --cap hatch
}
bad_path 'line 1: clip must be A,B,C,D' 'clip 1,0,0'
bad_path 'line 1: yon must be a number above 0' 'yon 0'
bad_path 'line 2: clip is said here' '\n2 clip 0,1,0,-1'
bad_path 'line 2: clip is said 2 times here, and 1 times before' \
  'clip 0,1,0,-1\n2 clip 0,1,0,-1 clip 1,0,0,0'
bad_path 'frame 1: --clip: .*normal is zero' 'clip 0,1,0,-1\n2 clip 0,-1,0,-1'
bad_path 'needs --clip' ''
ls no-*.png >no.txt 2>/dev/null && wrong 'a picture was written for bad input'

nine=()
for k in 1 2 3 4 5 6 7 8 9; do nine+=(--clip "1,0,0,$k"); done
expect 2 'at most 8 clip planes' render cubes.off "${nine[@]}" -o no.png
expect 2 'normal is zero' render cubes.off --clip 0,0,0,1 -o no.png
expect 2 'A,B,C,D' render cubes.off --clip 1,0,0 -o no.png
expect 2 'not closed' render klein.off --clip 1,0,0,0 --cap hatch -o no.png
expect 2 'needs --clip' render cubes.off --cap hatch -o no.png
expect 2 'above 0' render cubes.off --yon -1 -o no.png
for command in render draw map pick; do
  case $command in
    pick) out=(--at 3,4) ;;
    map) out=(-o no.json) ;;
    render) out=(-o no.png) ;;
    draw) out=(-o no.svg) ;;
  esac
  expect 2 'yon: must be more than --near' $command cubes.off --yon 2 --near 2 \
    "${out[@]}"
done
[ -e no.png ] && wrong "a picture was written for bad input"

finish
