#!/usr/bin/env bash
# Backgrounds, orbits, turntables and the headlight: what they change, and
# nothing else.
. "$(dirname "$0")/expect.sh"

"$make_model" interlocking-cubes -o cubes.off || exit 1
size=(--size 64x48)
expect 0 'span' render cubes.off "${size[@]}" -o plain.png --ids plain.npy
for ground in gradient none; do
  expect 0 'span' render cubes.off "${size[@]}" --background $ground \
    -o $ground.png --ids $ground.npy
  same plain.npy $ground.npy
  cmp -s plain.png $ground.png && wrong "--background $ground changes nothing"
done
# Byte 25 of a PNG is its colour type: 6 has an alpha channel, 2 has none.
[ "$(od -An -tu1 -j25 -N1 none.png | tr -d ' ')" = 6 ] || wrong "no alpha"
[ "$(od -An -tu1 -j25 -N1 gradient.png | tr -d ' ')" = 2 ] || wrong "alpha"
# The rows of a gradient are those of the whole picture.
expect 0 'span' render cubes.off "${size[@]}" --background gradient \
  --rows 0:20 -o rows-0.png
expect 0 'span' render cubes.off "${size[@]}" --background gradient \
  --rows 20:48 -o rows-1.png
expect 0 '' join rows-0.png rows-1.png -o joined.png
same joined.png gradient.png

expect 0 'span' render cubes.off "${size[@]}" --orbit 0,0 --ids orbit.npy
expect 0 'span' render cubes.off "${size[@]}" --view front --ids front.npy
same orbit.npy front.npy
expect 0 'span' render cubes.off "${size[@]}" --orbit 0,90 --ids orbit.npy
expect 0 'span' render cubes.off "${size[@]}" --view top --ids top.npy
same orbit.npy top.npy
expect 0 'span' render cubes.off "${size[@]}" --headlight -o head.png \
  --ids head.npy
same plain.npy head.npy
cmp -s plain.png head.png && wrong "--headlight changes nothing"

expect 0 '6 frames' render cubes.off "${size[@]}" --turntable 6 -o t-%d.png \
  --ids t-%d.npy
for k in 0 1 2 3 4 5; do [ -s t-$k.png ] || wrong "no frame $k"; done
cmp -s t-0.npy t-3.npy && wrong "the turntable does not turn"
expect 2 'needs one %d' render cubes.off --turntable 6 -o t.png
# It begins at the eye, or at the file's own camera, turns, and keeps the size.
eye=(--size 40x30 --eye 30,-40,25 --target 1,1,1 --ortho --height 9)
expect 0 '2 frames' render cubes.off "${eye[@]}" --turntable 2 -o t-%d.png
expect 0 'span' render cubes.off "${eye[@]}" -o first.png
expect 0 'span' render cubes.off --size 40x30 --eye=-28,42,25 --target 1,1,1 \
  --ortho --height 9 -o second.png
same t-0.png first.png
same t-1.png second.png
for camera in "--ortho --height 9" "--fov 30"; do
  # shellcheck disable=SC2086
  expect 0 '' scene cubes.off --size 40x30 --eye 30,-40,25 --target 2,2,2 \
    $camera -o own.scene
  expect 0 '4 frames' render own.scene --turntable 4 -o t-%d.png
  expect 0 'span' render own.scene -o first.png
  same t-0.png first.png
  cmp -s t-0.png t-1.png && wrong "the turntable of a scene does not turn"
  cmp -s t-0.png t-2.png && wrong "the turntable of a scene turns too far"
done
expect 2 'own camera' render own.scene --turntable 4 -o t-%d.png --size 9x9
# What is seen from behind is marked: all of a cube from inside, nothing of it
# from outside, and by both libraries alike.
inside=(--size 24x18 --eye 0.5,0.5,0.5 --target 1,0.7,0.6)
"$make_model" cube -o cube.off || exit 1
for impl in fast ref; do
  expect 0 'span' render cube.off "${inside[@]}" --back-color 255,0,0 \
    --impl $impl -o mark-$impl.png
done
same mark-fast.png mark-ref.png
expect 0 'span' render cube.off "${inside[@]}" -o inside.png
cmp -s inside.png mark-ref.png && wrong "--back-color marks nothing"
expect 0 'span' render cube.off --size 24x18 --back-color 255,0,0 -o mark.png
expect 0 'span' render cube.off --size 24x18 -o outside.png
same mark.png outside.png
# With samples and where polygons are seen through, too.
cut=(--size 24x18 --clip 1,1,0,-0.9 --back-color 255,0,0)
for look in "--aa 2" "--alpha 90" "--aa 4 --alpha 200 --cap hatch" \
  "--aa 2 --shade gouraud --smooth 99"; do
  for impl in fast ref; do
    # shellcheck disable=SC2086
    expect 0 '24x18' render cube.off "${cut[@]}" $look --impl $impl \
      -o mark-$impl.png --ids mark-$impl.npy
  done
  same mark-fast.png mark-ref.png
  same mark-fast.npy mark-ref.npy
  # shellcheck disable=SC2086
  expect 0 '24x18' render cube.off "${cut[@]}" $look --lazy -o lazy.png
  same mark-fast.png lazy.png
  # shellcheck disable=SC2086
  expect 0 '24x18' render cube.off "${cut[@]:0:4}" $look -o bare.png
  cmp -s bare.png mark-fast.png && wrong "$look: --back-color marks nothing"
done
expect 2 'no exact areas' render cube.off --back-color 255,0,0 --aa exact \
  -o no.png
expect 2 'in front' render cube.off --alpha 9 --aa exact -o no.png
expect 2 'AZIMUTH,ELEVATION' render cubes.off --orbit 1 -o no.png
expect 2 'AZIMUTH,ELEVATION' render cubes.off --orbit 1,91 -o no.png
expect 2 'gradient or none' render cubes.off --background sky -o no.png
# Of a gradient each row of pixels is the picture over its colour, and of none
# each pixel has the share that is seen.
for look in "--aa 2" "--alpha 90" "--alpha 90 --aa 4" "--lines wire --aa 2"; do
  # The reference takes 50 times as long where lines of several cubes cross.
  model=cubes.off
  [[ $look == --lines* ]] && model=cube.off
  for ground in gradient none; do
    for impl in fast ref; do
      # shellcheck disable=SC2086
      expect 0 '16x12' render $model --size 16x12 --background $ground $look \
        --impl $impl -o ground-$impl.png
    done
    same ground-fast.png ground-ref.png
    cp ground-fast.png $ground.png
  done
  [ "$(od -An -tu1 -j25 -N1 none.png | tr -d ' ')" = 6 ] || wrong "no alpha"
  for rows in 0:5 5:7 7:12; do
    # shellcheck disable=SC2086
    expect 0 '16x' render $model --size 16x12 --background gradient $look \
      --rows $rows -o rows-${rows%:*}.png
  done
  expect 0 '' join rows-0.png rows-5.png rows-7.png -o joined.png
  same joined.png gradient.png
done
expect 0 '16x12' render cubes.off --size 16x12 --lines wire --background none \
  -o lines.png
expect 0 '16x12' render cubes.off --size 16x12 --background none -o none.png
cmp -s lines.png none.png && wrong "lines over none change nothing"
expect 2 'leave out --lazy' render cubes.off --background none --aa 2 --lazy \
  -o no.png
expect 2 'gradient is not made' render cubes.off --background gradient \
  --aa exact -o no.png
expect 2 'one colour' draw cubes.off --background none -o no.svg
# Lines, lights and creases: both libraries draw the same lines, and each option
# changes the picture.
"$make_model" cube -o cube.off || exit 1
for aa in 0 2; do
  lines=(--size 24x18 --lines features --line-width 1.5)
  [ $aa = 0 ] || lines+=(--aa $aa)
  expect 0 'span' render cube.off "${lines[@]}" -o fast.png --ids fast.npy
  expect 0 'span' render cube.off "${lines[@]}" --impl ref -o ref.png
  same fast.png ref.png
done
expect 0 'span' render cube.off --size 24x18 --aa 2 -o bare.png --ids bare.npy
same fast.npy bare.npy
cmp -s fast.png bare.png && wrong "--lines changes nothing"
# Over a section they are those of what is left, and of the caps.
cut=(--size 24x18 --lines features --clip 1,1,0,-0.9)
for caps in "" "--cap hatch"; do
  # shellcheck disable=SC2086
  expect 0 'span' render cube.off "${cut[@]}" $caps -o fast-cut.png
  # shellcheck disable=SC2086
  expect 0 'span' render cube.off "${cut[@]}" $caps --impl ref -o ref-cut.png
  same fast-cut.png ref-cut.png
  cmp -s fast-cut.png fast.png && wrong "--clip leaves lines as they are"
done
for impl in fast ref; do
  expect 0 'span' render cube.off "${cut[@]}" --cap hatch --rows 3:11 \
    --impl $impl -o rows-$impl.png
done
same rows-fast.png rows-ref.png
expect 0 'span' render cube.off --size 24x18 --clip 1,1,0,-0.9 --cap hatch \
  -o no-lines.png
cmp -s no-lines.png fast-cut.png && wrong "a section has no lines"
expect 0 'span' render cubes.off "${size[@]}" --lines outline -o outline.png
expect 0 'span' render cubes.off "${size[@]}" --lines features -o features.png
cmp -s outline.png features.png && wrong "creases are no outline"
expect 0 'span' render cubes.off "${size[@]}" --lines wire --rows 0:20 \
  -o wire-0.png
expect 0 'span' render cubes.off "${size[@]}" --lines wire --rows 20:48 \
  -o wire-1.png
expect 0 'span' render cubes.off "${size[@]}" --lines wire -o wire.png
expect 0 '' join wire-0.png wire-1.png -o joined.png
same joined.png wire.png
"$make_model" sphere --count 12 -o ball.off || exit 1
expect 0 'span' render ball.off "${size[@]}" -o flat.png
expect 0 'span' render ball.off "${size[@]}" --shade gouraud -o gouraud.png
expect 0 'span' render ball.off "${size[@]}" --smooth 180 -o smooth.png
same gouraud.png smooth.png
expect 0 'span' render ball.off "${size[@]}" --smooth 0 -o creased.png
same flat.png creased.png
for light in "--light 1,0,0" "--light 1,0,0 --light 0,1,0,0.5" \
  "--ambient 0.9" "--headlight --light 1,0,0"; do
  # shellcheck disable=SC2086
  expect 0 'span' render ball.off "${size[@]}" $light -o light.png
  cmp -s flat.png light.png && wrong "$light changes nothing"
done
# What hides all behind it is opaque, whatever goes with it.
for look in "--aa 4" "--aa exact" "--aa 2 --back-color 1,2,3"; do
  # shellcheck disable=SC2086
  expect 0 'span' render cubes.off "${size[@]}" $look -o opaque.png
  # shellcheck disable=SC2086
  expect 0 'span' render cubes.off "${size[@]}" $look --alpha 255 -o hides.png
  same opaque.png hides.png
done
expect 2 'needs --lines' render cubes.off --line-width 2 -o no.png
expect 2 '0.0625 to 256' render cubes.off --lines wire --line-width 0 -o no.png
expect 2 'maybe a strength' render cubes.off --light 1,2,3,-1 -o no.png
expect 2 'from 0 to 1' render cubes.off --ambient 2 -o no.png
expect 2 'from 0 to 180' render cubes.off --smooth 181 -o no.png
[ -e no.png ] && wrong "a picture was written for bad input"

finish
