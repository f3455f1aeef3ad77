#!/usr/bin/env bash
# Films, rows and alpha: parts joined are the whole, byte for byte, frames are
# the images of their cameras, and both libraries blend alike.
. "$(dirname "$0")/expect.sh"

size=(--size 50x37)
"$make_model" interlocking-cubes -o cubes.off || exit 1

# Rows, by any number of threads, by either library, from any camera.
for view in "" "--ortho" "--alpha 90" "--impl ref" "--impl ref --ortho" \
  "--method painter" "--method zbuffer --near 100" "--impl ref --alpha 90"; do
  # shellcheck disable=SC2086
  set -- cubes.off "${size[@]}" $view
  expect 0 '50x37' render "$@" -o whole.png --ids whole.npy
  for threads in 1 5; do
    for rows in 0:1 1:20 20:; do
      expect 0 '50x' render "$@" --rows $rows --threads $threads \
        -o "${rows%:*}.png" --ids "${rows%:*}.npy"
    done
    expect 0 '50x37 from 3 parts' join 0.png 1.png 20.png -o joined.png
    expect 0 '50x37 from 3 parts' join 0.npy 1.npy 20.npy -o joined.npy
    same whole.png joined.png
    same whole.npy joined.npy
    case $view in --impl*|*zbuffer*) break ;; esac
  done
done
expect 0 '50x37' render cubes.off "${size[@]}" --rows :37 -o all.png
expect 0 '50x37 from 1 parts' join all.png -o joined.png
expect 2 '0:37' render cubes.off "${size[@]}" --rows 30:38 -o a.png
expect 2 '0:37' render cubes.off "${size[@]}" --rows 37: -o a.png
for rows in 5:5 6:5 5 : -1:5 a:b; do
  expect 2 '\-\-rows.*A:B' render cubes.off --rows=$rows -o a.png
done

# What does not belong together is not joined.
expect 2 '20.png.*row 20.*row 1 comes next' join 0.png 20.png -o a.png
expect 2 '1.png.*row 1, but row 0' join 1.png 0.png 20.png -o a.png
expect 2 '1.png.*row 19 of 37' join 0.png 1.png -o a.png
expect 2 'row 37 comes next' join 0.png 1.png 20.png 20.png -o a.png
expect 2 '20.png.*is a part' join 0.png 1.png 20.png -o 20.png
expect 2 'same kind' join 0.png 1.npy -o a.png
expect 2 '\.png or .npy' join 0.png -o a.jpg
expect 2 'none.png' join 0.png none.png -o a.png
expect 2 'none.npy' join 0.npy none.npy -o a.npy
cp cubes.off fake.png
cp cubes.off fake.npy
expect 2 'fake.png.*no PNG' join fake.png -o a.png
expect 2 'fake.npy' join fake.npy -o a.npy
head -c 400 whole.png >cut.png
head -c 400 whole.npy >cut.npy
expect 2 'cut.png' join cut.png -o a.png
expect 2 'cut.npy' join cut.npy -o a.npy
expect 0 '40x3' render cubes.off --size 40x3 -o narrow.png --ids narrow.npy
expect 2 'narrow.png.*40 columns' join all.png narrow.png -o a.png
expect 2 'narrow.npy.*40 columns' join whole.npy narrow.npy -o a.npy
[ ! -e a.png ] || wrong "a failed join left a.png"
expect 2 'none/a.png' join all.png -o none/a.png
expect 2 'none/a.npy' join whole.npy -o none/a.npy
# A full disk is said to be full.
ln -sf /dev/full full.png
expect 2 'full.png' join all.png -o full.png
expect 2 'full.png' render cubes.off --size 9x9 -o full.png
expect 2 '/dev/full' render cubes.off --size 9x9 --ids /dev/full
[ -c /dev/full ] || wrong "a device was removed"

# A film: key frames are the cameras they say, in between it moves evenly.
cat >tour.txt <<'TOUR'
# Round the cubes.
2   eye 300,-500,250  target 10,20,30  fov 30

6   eye 100,-500,250
7   eye 500,100,50    fov 40
TOUR
film=(cubes.off "${size[@]}" --path tour.txt)
expect 0 'span: 50x37, 6 frames' render "${film[@]}" -o f-%03d.png \
  --ids f%d.npy --stats a.json
[ "$(echo f-*.png)" = "$(printf 'f-%03d.png ' 2 3 4 5 6 7 | sed 's/ $//')" ] ||
  wrong "the film has the frames $(echo f-*.png)"
[ "$(number a.json frames)" = 6 ] || wrong "frames in --stats"
frame() {
  local number=$1
  shift
  expect 0 'span' render cubes.off "${size[@]}" -o still.png "$@"
  same still.png "f-00$number.png"
}
frame 2 --eye 300,-500,250 --target 10,20,30 --fov 30
frame 4 --eye 200,-500,250 --target 10,20,30 --fov 30
frame 6 --eye 100,-500,250 --target 10,20,30 --fov 30
frame 7 --eye 500,100,50 --target 10,20,30 --fov 40
mkdir -p shared
expect 0 '2 frames' render "${film[@]}" -o shared/f-%03d.png --frames :4
expect 0 '50x37, [0-9]* pixels' render "${film[@]}" \
  -o shared/f-%03d.png --frames 4:5 --threads 3
expect 0 '3 frames' render "${film[@]}" -o shared/f-%03d.png --frames 5:8 \
  --impl ref
for name in f-*.png; do same "$name" "shared/$name"; done
expect 0 '50x10, 6 frames' render "${film[@]}" --rows 3:13 -o top-%d.png
echo '0 target 1,2,3' >still.txt
expect 0 'span' render cubes.off "${size[@]}" --path still.txt -o '100%%-%d.png'
[ -s '100%-0.png' ] || wrong "no percent sign in the name"

expect 2 '2:8' render "${film[@]}" -o f-%d.png --frames 0:4
expect 2 '2:8' render "${film[@]}" -o f-%d.png --frames 8:
expect 2 'needs --path' render cubes.off -o a.png --frames 0:4
for name in a.png %d-%d.png %s.png %5d.png %0d0.png%; do
  expect 2 '%05d\|pictures' render "${film[@]}" -o "$name"
done
bad() {
  printf '%b\n' "$2" >bad.txt
  expect 2 "bad.txt: $1" render cubes.off --path bad.txt -o f-%d.png
}
bad 'there are no cameras' '# nothing'
bad "line 2: .*not 'x'" '0 eye 1,2,3\nx eye 1,2,3'
bad "line 1: .*not '-1'" '-1 eye 1,2,3'
bad "line 1: eye .*not '1,2'" '0 eye 1,2'
bad "line 1: fov .*not ''" '0 fov'
bad "line 1: knows eye.*not 'eyes'" '0 eyes 1,2,3'
bad 'line 3: frame 4 comes after frame 5' '0 fov 30\n5\n4'
bad 'line 2: eye is said here' '0 fov 30\n5 eye 1,2,3'
expect 2 'none.txt' render cubes.off --path none.txt -o f-%d.png
echo '0 eye 1,2,3 target 1,2,3' >bad.txt
expect 2 'frame 0.*eye' render cubes.off --path bad.txt -o f-%d.png

# Alpha: alike in both libraries, nothing at 0, the usual image at 255.
"$make_model" sphere --count 8 -o sphere.scene || exit 1
for shade in flat gouraud; do
  set -- sphere.scene "${size[@]}" --shade $shade
  expect 0 'painter.*(fast)' render "$@" --alpha 77 -o a.png --ids a.npy
  expect 0 'painter.*(ref)' render "$@" --alpha 77 -o b.png --ids b.npy \
    --impl ref
  same a.png b.png
  same a.npy b.npy
  expect 0 'painter' render "$@" --alpha 77 -o b.png --heuristic h4
  same a.png b.png
  expect 0 'span' render "$@" -o whole.png
  cmp -s a.png whole.png && wrong "$shade: alpha changes nothing"
  expect 0 'span' render "$@" --alpha 255 -o b.png
  same whole.png b.png
done
expect 0 'painter' render sphere.scene "${size[@]}" --alpha 0 -o a.png
expect 0 'span: 50x37, 0 pixels' render cubes.off "${size[@]}" -o b.png \
  --eye 0,0,900 --target 0,0,999
same a.png b.png
expect 2 'span' render cubes.off -o a.png --alpha 7 --method span
expect 2 'zbuffer' render cubes.off -o a.png --alpha 7 --method zbuffer
for alpha in 256 -1 0.5 x; do
  expect 2 '\-\-alpha.*at least 0 and at most 255' render cubes.off -o a.png --alpha=$alpha
done
finish
