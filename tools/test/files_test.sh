#!/usr/bin/env bash
# Files that are written: never over an input, all or nothing, with the reason
# where that fails; and Ctrl-C.
. "$(dirname "$0")/expect.sh"

"$make_model" cube -o cube.off || exit 1
"$make_model" cube -o cube.scene || exit 1
box 0 0 0 2 2 2 >a.off
box 1 1 1 3 3 3 >b.off
cp a.off before.off

# An output that is an input, by whatever name, or another output.
ln -s a.off link.off
ln a.off hard.off
mkdir sub
for name in a.off ./a.off sub/../a.off "$PWD/a.off" link.off hard.off; do
  expect 2 'overwrite an input' csg union a.off b.off -o "$name"
  expect 2 'overwrite an input' csg 'A | "b.off"' A=b.off -o c.off \
    --origin b.off
done
echo 'result = "a.off" | "b.off"' >script.csg
expect 2 'script.csg.*overwrite' csg --script script.csg -o c.off \
  --stats script.csg
expect 2 'both write' csg union a.off b.off -o c.off --origin c.off
expect 2 'overwrite' render cube.scene --ids a.npy --size 8x8 --stats cube.scene
expect 2 'both write' render cube.off -o a.png --ids a.png --size 8x8
expect 2 'both write' render cube.off --ids ./a.npy --stats a.npy --size 8x8
expect 2 'overwrite' scene cube.scene -o cube.scene
expect 2 'overwrite' build a.off -o a.off
printf '0 eye 9,0,2 target 0,0,0\n2 eye 9,9,2\n' >tour.txt
cp tour.txt 1.npy
expect 2 'overwrite' render cube.off --ids '%d.npy' --path 1.npy --size 8x8
same a.off before.off
same tour.txt 1.npy
[ -e c.off ] && wrong 'a refused command wrote c.off'

# The permissions stay, and nothing is left beside.
"$program" csg union a.off b.off -o c.off -q >out || wrong 'union'
[ -s out ] && wrong '--quiet printed something'
chmod 640 c.off
expect 0 'result' csg union a.off b.off -o c.off
[ "$(stat -c %a c.off)" = 640 ] || wrong 'the permissions changed'
ls ./*.part-* 2>/dev/null && wrong 'a part was left'

# Standard input and output, and gzipped files.
for format in off obj stl ply glb gltf scene; do
  "$program" csg union a.off b.off -o "direct.$format" -q || wrong "-o $format"
  "$program" csg union a.off b.off -o - --format $format >"piped.$format" ||
    wrong "-o - --format $format"
  same "direct.$format" "piped.$format"
  "$program" info - <"piped.$format" | grep >/dev/null '^volume     15$' ||
    wrong "$format on standard input"
done
"$program" csg union - b.off -o piped.off -q <a.off || wrong 'csg union -'
same direct.off piped.off
expect 2 '\-\-format' csg union a.off b.off -o -
expect 2 'both write' csg union a.off b.off -o - --format off --stats -
"$program" csg union a.off b.off -o c.off.gz -q || wrong '-o c.off.gz'
gzip -dc c.off.gz | cmp - direct.off || wrong 'c.off.gz'
expect 0 '^volume     15$' info c.off.gz
"$program" scene cube.off -o shot.scene.gz -q --size 9x9 || wrong 'shot.scene.gz'
expect 0 'span: 9x9' render shot.scene.gz --ids a.npy
expect 2 'standard input' info -

# A repair between two pipes is that of the files.
sed 's/^4 0 2 3 1$/4 0 1 3 2/' a.off >turned.off
expect 0 '1 polygon turned' repair turned.off -o mended.off
"$program" repair - -o - --format off <turned.off >piped.off ||
  wrong 'repair from standard input to standard output'
same mended.off piped.off
gzip -c turned.off | "$program" repair - -o piped.stl -q ||
  wrong 'repair of a gzipped pipe'
expect 0 closed info piped.stl
expect 2 'give --format' repair turned.off -o -
expect 2 'standard input' repair - -o none.off
# Each of the formats, and none to a full device.
for format in obj stl ply 3mf glb gltf scene; do
  "$program" repair turned.off -o - --format $format >piped.$format ||
    wrong "repair to standard output as $format"
  expect 0 closed info piped.$format
done
# What lies in a plane has nothing within, whatever fills it.
printf 'OFF\n4 2 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n3 0 1 2\n3 0 2 3\n' >sheet.off
expect 2 '\-\-thicken' repair sheet.off -o shell.off --close-all
printf 'OFF\n5 3 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 0\n' >fan.off
printf '3 0 1 4\n3 1 2 4\n3 2 3 4\n' >>fan.off
expect 2 'nothing is within.*--thicken' repair fan.off -o shell.off --close-all
[ -e shell.off ] && wrong 'a sheet became a solid of no volume'

# What has no colours gets none on its way through a boolean, and a scene is lit
# as a picture of the mesh is: all show the same.
for format in off ply obj 3mf glb stl hsolid scene; do
  expect 0 closed csg 'a | b' a=a.off b=b.off -o plain.$format
  expect 0 'painted' render plain.$format --size 40x30 --eye 9,7,8 \
    --target 1,1,1 -o plain.png
  [ $format != off ] || cp plain.png off.png
  same off.png plain.png
done
[ -z "$(awk 'NR > 2 && NF > 3 && NF != $1 + 1' plain.off)" ] ||
  wrong 'colours in plain.off'
grep -a -q red plain.ply && wrong 'colours in plain.ply'
expect 0 'painted' render plain.off --size 40x30 --eye 9,7,8 --target 1,1,1 \
  --shade gouraud -o smooth.png
cmp -s off.png smooth.png && wrong '--shade gouraud changes nothing'
# Beside a solid that has some, it is as bright as by itself.
sed '11,$s/$/ 10 200 30/' b.off >green.off
for format in off ply obj 3mf glb hsolid scene; do
  expect 0 closed csg 'a | b' a=a.off b=green.off -o mixed.$format
  expect 0 'painted' render mixed.$format --size 40x30 --eye 9,7,8 \
    --target 1,1,1 -o mixed.png
  [ $format != off ] || cp mixed.png off.png
  same off.png mixed.png
  [ $format = scene ] && continue
  expect 0 closed csg A A=mixed.$format -o back.off
  [ "$(awk 'NR > 2 && $1 > 2 && NF == $1 + 1' back.off)" ] ||
    wrong "$format: all faces have a colour"
  grep -q ' 10 200 30$' back.off || wrong "$format: no face has its colour"
done

# A full device, as every output and as standard output.
if [ -w /dev/full ]; then
  ln -s /dev/full full.off
  ln -s /dev/full full.png
  ln -s /dev/full full.npy
  ln -s /dev/full full.scene
  expect 2 'No space left' csg union a.off b.off -o full.off
  expect 2 'No space left' csg union a.off b.off -o c.off --origin /dev/full
  expect 2 'No space left' csg union a.off b.off -o c.off --stats /dev/full
  expect 2 'No space left' render cube.off -o full.png --size 300x300
  expect 2 'No space left' render cube.off --ids full.npy --size 8x8
  expect 2 'No space left' render cube.off --stats /dev/full --size 8x8
  expect 2 'No space left' scene cube.off -o full.scene
  expect 2 'No space left' build cube.off -o /dev/full
  for words in 'info cube.off' '--help' 'info --help' '--version' \
    'build cube.off' 'build cube.off --stats -' 'compare b.npy b.npy'; do
    "$program" render cube.off --ids b.npy --size 8x8 -q || wrong 'render'
    # shellcheck disable=SC2086
    "$program" $words >/dev/full 2>stderr
    [ $? = 2 ] || wrong "'$words' to a full device: not status 2"
    grep -q 'standard output.*No space' stderr ||
      wrong "'$words' to a full device: $(cat stderr)"
  done
fi

# Sources without an end.
(
  # Sanitizers reserve more than that.
  [ "${HALFSPACE_SANITIZED:-}" ] || ulimit -v 2000000
  ln -s /dev/zero zero.off
  expect 2 'zero' info zero.off
  expect 2 '/dev/zero' csg --script /dev/zero -o c.off
  expect 2 '/dev/zero' render cube.off --ids '%d.npy' --path /dev/zero
  finish
) || failures=$((failures + 1))

# Ctrl-C, also where nothing asks for it: a long boolean, or a pipe that gives
# nothing.
mkfifo pipe.off
for words in 'info pipe.off' 'csg union pipe.off a.off -o stopped.off' \
  'render pipe.off -o stopped.png'; do
  # Nothing writes into the pipe, but it is open.
  sleep 30 >pipe.off &
  sleeper=$!
  # shellcheck disable=SC2086
  env --default-signal=INT "$program" $words >stdout 2>stderr &
  pid=$!
  sleep 0.5
  kill -INT $pid
  wait $pid
  [ $? = 130 ] || wrong "'$words' interrupted: not status 130"
  [ "$(cat stderr)" = 'halfspace: interrupted' ] ||
    wrong "'$words' interrupted: $(cat stderr)"
  kill $sleeper
  wait $sleeper 2>/dev/null
done
ls stopped.* 2>/dev/null && wrong 'an interrupted command wrote a file'
finish
