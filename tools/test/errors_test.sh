#!/usr/bin/env bash
# Bad usage and bad files: exit status 2 and one line that names the trouble.
. "$(dirname "$0")/expect.sh"

"$make_model" cube -o cube.off || exit 1
"$make_model" cube -o cube.scene || exit 1
"$make_model" cube -o cube.stl || exit 1

# Usage.
expect 2 'subcommand'
expect 2 'teapot' teapot
expect 2 'FILE' render
expect 2 'give -o' render cube.off
expect 2 'colour' render cube.off -o a.png --colour
expect 2 '\-\-size.*WxH.*0x480' render cube.off -o a.png --size 0x480
expect 2 '\-\-size.*99999x1' render cube.off -o a.png --size 99999x1
expect 2 '\-\-size.*640' render cube.off -o a.png --size 640
expect 2 '\-\-eye.*X,Y,Z.*1,2' render cube.off -o a.png --eye 1,2
expect 2 '\-\-eye.*nan' render cube.off -o a.png --eye nan,0,0
expect 2 '\-\-eye.*inf' render cube.off -o a.png --eye 0,inf,0
expect 2 '\-\-method.*painter.*magic' render cube.off -o a.png --method magic
expect 2 '\-\-grid.*26|40|54.*30' info cube.off --grid 30
expect 2 '\-\-heuristic.*h7' build cube.off --heuristic h7
expect 2 '\-\-candidates.*0' build cube.off --candidates 0
expect 2 '\-\-seed.*-1' build cube.off --seed=-1
expect 2 '\-\-repeat' render cube.off -o a.png --repeat 0
expect 2 '\-\-candidates.*at least 1' build cube.off --candidates 0
expect 2 '\.png' render cube.off -o a.jpg
expect 2 'fast.*zbuffer' render cube.off -o a.png --impl fast --method zbuffer
expect 2 '\-\-priority.*not zbuffer' render cube.off -o a.png \
  --method zbuffer --priority depthsort
expect 2 '\-\-priority depthsort.*leave out --heuristic' render cube.off \
  -o a.png --priority depthsort --heuristic h1
expect 2 '\-\-priority depthsort.*exact' render cube.off -o a.png \
  --priority depthsort --aa exact
expect 2 '\-\-tree.*depthsort needs none' render cube.off -o a.png \
  --priority depthsort --tree a.tree
expect 2 '\-\-lazy.*leave out --tree' render cube.off -o a.png --lazy --tree a.tree
expect 2 '\-\-lazy.*--heuristic' render cube.off -o a.png --lazy --heuristic h1
expect 2 '\-\-lazy.*whole trees' render cube.off -o a.png --lazy --screen list
expect 2 '\-\-lazy.*whole trees' render cube.off -o a.png --lazy --aa exact
expect 2 '\-\-lazy.*ref' render cube.off -o a.png --lazy --impl ref
expect 2 '\-\-lazy.*no tree' render cube.off -o a.png --lazy --method zbuffer
expect 2 'output' csg
expect 2 'say what' csg -o c.off
expect 2 'NAME=FILE.*cube.off' csg xor cube.off cube.off -o c.off
expect 2 'output' csg union cube.off cube.off
expect 2 'must end in' csg union cube.off cube.off -o out.txt

# Cameras.
expect 2 'camera.*eye' render cube.off -o a.png --eye 1,1,1 --target 1,1,1
expect 2 'camera.*up' render cube.off -o a.png --eye 0,0,9 --target 0,0,0 \
  --up 0,0,1
expect 2 'camera.*up is zero' render cube.off -o a.png --up 0,0,0
expect 2 '\-\-fov.*above 0' render cube.off -o a.png --fov 0
expect 2 '\-\-fov.*below 180' render cube.off -o a.png --fov 180
expect 2 '\-\-height.*above 0' render cube.off -o a.png --ortho --height 0
expect 2 'camera.*near' render cube.off -o a.png --near=-1
expect 2 'camera.*pixel is less' render cube.off -o a.png --fov 1e-300
expect 2 'camera.*up is zero' render cube.off -o a.png --up 0,0,0
expect 2 'camera.*near distance' render cube.off -o a.png --near 1e300
# Numbers at the ends of what doubles hold: too far is said to be too far, and
# directions of any length are directions.
for eye in 1e300,0,0 0,-1e308,5 1e308,1e308,1e308; do
  expect 2 'camera.*eye is farther away' render cube.off -o a.png --eye $eye
done
expect 0 'span' render cube.off --ids a.npy --size 9x9 --up 0,0,5
for up in 0,0,1e300 0,0,1e-320; do
  expect 0 'span' render cube.off --ids b.npy --size 9x9 --up $up
  same a.npy b.npy
done
for target in 1e300,0,0 -1e308,1e308,0; do
  expect 0 'span' render cube.off --ids b.npy --size 9x9 --target $target
done
expect 2 'name of the file is empty' info ''

# Files that are not there, or not files.
mkdir folder.off folder.scene
for command in info build 'render -o a.png' 'scene -o a.scene'; do
  # shellcheck disable=SC2086
  set -- $command
  expect 2 'none.off' "$1" none.off "${@:2}"
  expect 2 'none.scene' "$1" none.scene "${@:2}"
  expect 2 'folder.off' "$1" folder.off "${@:2}"
  expect 2 'folder.scene' "$1" folder.scene "${@:2}"
done
expect 2 'none.npy' compare none.npy none.npy
expect 2 'none.off' csg union cube.off none.off -o out.off

# Files of no use.
: >empty.off
: >empty.obj
: >empty.stl
: >empty.ply
: >empty.scene
for file in empty.*; do expect 2 "$file" info "$file"; done
head -c 40 cube.off >cut.off
head -c 200 cube.stl >cut.stl
head -n 8 cube.scene >cut.scene
expect 2 'cut.off' info cut.off
expect 2 'cut.stl' info cut.stl
expect 2 'cut.scene' info cut.scene
echo 'hello' >hello.off
echo 'hello' >hello.ply
echo 'hello' >hello.scene
cp cube.off cube.txt
expect 2 'hello.off' info hello.off
expect 2 'hello.ply' info hello.ply
expect 2 'hello.scene' info hello.scene
expect 2 'cube.txt' info cube.txt
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n' >nan.off
expect 2 'nan.off.*nan' info nan.off
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n' >index.off
expect 2 'index.off.*7' info index.off
printf 'OFF\n999999999 999999999 0\n' >huge.off
expect 2 'huge.off' info huge.off
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n' >index.obj
expect 2 'index.obj.*9' info index.obj
printf 'v 0 0 0\nv 1 0 0\n' >points.obj
expect 2 'points.obj' info points.obj
sed 's/^p 0/p 77/' cube.scene >index.scene
expect 2 'index.scene.*77' info index.scene
printf '\xff\xfeO\0F\0F\0\n\0' >utf16.off
expect 2 'utf16.off' info utf16.off
expect 2 'hello.off' compare hello.off hello.off

# A scene has its own grid and its own camera.
expect 2 'cube.scene.*grid' info cube.scene --grid 54
expect 0 'polygons' scene cube.scene -o shot.scene --size 32x24
expect 2 '\-\-size.*32x24' render shot.scene -o a.png --size 33x24
expect 0 'span' render shot.scene -o a.png --size 32x24
expect 2 '\-\-fov.*own camera.*\-\-eye' render shot.scene -o a.png --fov 30
expect 2 '\-\-ortho.*own camera' render shot.scene -o a.png --ortho
expect 0 'span: 32x24' render shot.scene -o a.png --view top --fov 30
expect 2 'own colours' render shot.scene -o a.png --color 1,2,3
expect 2 '\-\-threads.*at most' render cube.off -o a.png --threads 1000000000
sed 's/^v /unit 10 0\nv /' cube.scene >units.scene
expect 2 "second 'unit' line" info units.scene

# Numbers beyond doubles, and so large that nothing is left beside them.
for far in 1e400 -1e999 1e30; do
  sed "3s/.*/$far 0 0/" cube.off >far.off
  said='far.off: line 3: .* is beyond the greatest double'
  [ $far = 1e30 ] && said='far.off: polygon .* reaches as far as 1e+30; .* of the'
  expect 2 "$said" info far.off
  expect 2 "$said" csg A A=far.off -o out.off
  expect 2 "$said" repair far.off -o out.off
  expect 2 "$said" render far.off -o a.png
done

expect 2 "line 1, column 5: '1e400' is beyond the greatest double" csg \
  'box(1e400)' -o out.off

# Places that cannot be written.
expect 2 'none/a.png' render cube.off -o none/a.png --size 8x8
expect 2 'none/a.npy' render cube.off --ids none/a.npy --size 8x8
expect 2 'none/a.json' render cube.off --stats none/a.json --size 8x8
expect 2 'none/a.json' build cube.off --stats none/a.json
expect 2 'none/a.scene' scene cube.off -o none/a.scene
expect 2 'none/a.off' csg union cube.off cube.off -o none/a.off

# Solids that are none.
"$make_model" klein-bottle -o bottle.scene || exit 1
sed '$d' cube.off | sed 's/^8 6/8 5/' >open.off
expect 2 'open.off.*4 bad edges' csg union cube.off open.off -o out.off
expect 2 'open.off.*4 bad edges' csg union open.off cube.off -o out.off
expect 2 'bottle.scene.*bad edges' csg union cube.off bottle.scene -o out.off
finish
