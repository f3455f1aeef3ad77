#!/usr/bin/env bash
# Images: the methods agree, a scene file gives the same image as its mesh, and
# the statistics say what happened.
. "$(dirname "$0")/expect.sh"

size=(--size 48x36)
views=("" "--ortho" "--near 100" "--eye 300,-500,250 --target 10,20,30"
  "--eye 0,0,900 --target 0,0,0 --ortho" "--cull" "--fov 20 --up 1,1,1"
  "--eye -.5,-400.25,3 --target 0,0,0" "--grid 26")
rendered=48x36

models="cube pinwheel interlocking-cubes"
for model in $models; do
  "$make_model" "$model" -o "$model.off" || exit 1
done
# images MODEL OPTION...: what the reference paints, all other ways paint.
images() {
  local model=$1
  shift
  expect 0 "span: $rendered" render "$model" "$@" -o a.png --ids a.npy --impl ref
  for method in painter zbuffer raycast; do
    expect 0 "$method: $rendered" render "$model" "$@" --method "$method" \
      --impl ref -o b.png --ids b.npy
    same a.npy b.npy
    same a.png b.png
  done
  for method in span painter; do
    for tree in "" "--heuristic h3"; do
      # shellcheck disable=SC2086
      expect 0 "$method: $rendered.*(fast)" render "$model" "$@" $tree \
        --method "$method" --threads 2 -o b.png --ids b.npy
      same a.npy b.npy
      same a.png b.png
    done
  done
  expect 0 'polygons' scene "$model" "$@" -o shot.scene
  expect 0 'span' render shot.scene -o b.png --ids b.npy
  same a.npy b.npy
  same a.png b.png
  expect 0 'polygons' scene shot.scene -o again.scene
  same shot.scene again.scene
}
# Every option meets one model; every model is seen without any.
for view in "${views[@]}"; do
  # shellcheck disable=SC2086
  images pinwheel.off $view --size "$rendered"
done
for model in cube interlocking-cubes; do
  images $model.off --size "$rendered"
done

# Every instruction set that this machine has gives the same bytes, whole and in
# rows, flat and smooth.
"$make_model" sphere --count 12 -o levels.scene || exit 1
for look in "" "--shade gouraud" "--method painter" "--method painter --alpha 90" \
  "--rows 3:20"; do
  # shellcheck disable=SC2086
  set -- levels.scene --size 77x41 $look
  expect 0 '(fast)' render "$@" -o a.png --ids a.npy
  for level in portable avx2 avx512 best; do
    if "$program" render "$@" --simd $level -o b.png --ids b.npy >stdout 2>&1
    then
      same a.npy b.npy
      same a.png b.png
    else
      expect 2 "this machine has no $level" render "$@" --simd $level -o b.png
      echo "skipped: this machine has no $level"
    fi
  done
done
expect 2 '\-\-simd.*portable.*mmx' render cube.off -o a.png --simd mmx
expect 2 '\-\-simd.*ref' render cube.off -o a.png --simd avx2 --impl ref

# Smooth colours, in a mesh and in a scene.
"$make_model" sphere --count 8 -o sphere.scene || exit 1
expect 0 'corners' info sphere.scene
expect 0 'span' render sphere.scene "${size[@]}" -o flat.png
expect 0 'span' render sphere.scene "${size[@]}" -o a.png --shade gouraud
cmp -s flat.png a.png && wrong "flat and smooth colours look the same"
expect 0 'polygons' scene sphere.scene "${size[@]}" --shade gouraud -o b.scene
expect 0 'span' render b.scene -o b.png
same a.png b.png
expect 0 'span' render cube.off "${size[@]}" -o a.png --shade gouraud
expect 0 'polygons' scene cube.off "${size[@]}" --shade gouraud -o b.scene
expect 0 'raycast' render b.scene -o b.png --method raycast
same a.png b.png

# An image in which something is seen, and one in which nothing is.
expect 0 'span' render cube.off "${size[@]}" -o a.png --stats a.json
[ "$(number a.json pixels_painted)" -gt 300 ] || wrong "the cube is not seen"
expect 0 'span: 48x36, 0 pixels' render cube.off "${size[@]}" -o b.png \
  --eye 0,0,900 --target 0,0,999

# Every name that --stats promises, by either method; repeats change nothing.
for method in span zbuffer; do
  expect 0 "$method" render pinwheel.off "${size[@]}" --ids a.npy \
    --method "$method" --repeat 3 --threads 2 --stats a.json
  for name in polygons fragments nodes height splits build_ms frame_ms \
    pixels_painted bytes moved max_move triangulated dropped; do
    [ -n "$(number a.json $name)" ] || wrong "$method: no $name in --stats"
  done
done

# A tree of which images build what they come to: the same bytes, and where the
# camera looks away or one side hides the other, less of it.
"$make_model" sphere --count 60 -o ball.off || exit 1
for how in "--shade gouraud" "--alpha 80" "--method painter" "--aa 2" \
  "--clip 1,0,0,0 --cap hatch" "--rows 3:30 --threads 2"; do
  expect 0 'tree' render ball.off "${size[@]}" -o a.png --ids a.npy $how
  expect 0 'built: [0-9]* of [0-9]* cells' render ball.off "${size[@]}" \
    -o b.png --ids b.npy $how --lazy
  same a.png b.png
  same a.npy b.npy
done
expect 0 'span' render ball.off "${size[@]}" --lazy --stats a.json \
  --eye 3,0,0 --target 1,0,0 --fov 5
for name in cells cells_built polygons_built fragments_built bytes_built; do
  [ -n "$(number a.json $name)" ] || wrong "no $name in --stats of --lazy"
done
[ "$(number a.json polygons_built)" -lt "$(number a.json polygons)" ] ||
  wrong "what is outside of the image was built"
[ "$(number a.json polygons_built)" -gt 0 ] || wrong "nothing was built"
expect 0 'built: 0 of' render ball.off "${size[@]}" -o b.png --lazy \
  --eye 0,0,900 --target 0,0,999
expect 0 '4 frames' render ball.off "${size[@]}" -o f%d.png --turntable 4
expect 0 '4 frames' render ball.off "${size[@]}" -o g%d.png --turntable 4 --lazy
for k in 0 1 2 3; do same f$k.png g$k.png; done

# A share of the pixels, or all, checked against the reference.
expect 0 'shadow: 1728 pixels checked, .*, 0 mismatches' render pinwheel.off \
  "${size[@]}" -o a.png --shadow 1
expect 0 'shadow: 18 pixels checked' render sphere.scene "${size[@]}" \
  -o a.png --shade gouraud --shadow 0.01 --stats a.json
[ "$(number a.json shadow_pixels)" = 18 ] || wrong "shadow_pixels is not 18"
[ "$(number a.json shadow_mismatches)" = 0 ] || wrong "a mismatch"
expect 0 'shadow: 96 pixels checked' render cube.off "${size[@]}" -o a.png \
  --rows 5:9 --shadow 0.5
export HALFSPACE_SHADOW=0.5
expect 0 'shadow: 864 pixels checked' render cube.off "${size[@]}" -o a.png
expect 2 'checks opaque images' render cube.off "${size[@]}" -o a.png --alpha 9
unset HALFSPACE_SHADOW
expect 2 '--shadow: must be a number above 0 and at most 1' render cube.off \
  -o a.png --shadow 1.5
[ -e halfspace-shadow.scene ] && wrong "a scene for no mismatch"

expect 0 '"polygons": 24' render pinwheel.off "${size[@]}" --stats -
finish
