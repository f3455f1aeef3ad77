#!/usr/bin/env bash
# Pictures as they come without further options: lit, whole, centred.
. "$(dirname "$0")/expect.sh"

# rows FILE: the first and last row and column with a polygon in an array of
# 64x48, and the size of the picture.
extent() {
  tail -c $((64 * 48 * 4)) "$1" | od -An -v -t d4 -w256 |
    awk '{ for (i = 1; i <= NF; i++) if ($i >= 0) {
             if (!seen++) { top = NR; left = i; right = i }
             bottom = NR; if (i < left) left = i; if (i > right) right = i } }
         END { if (seen) print left - 1, 64 - right, top - 1, 48 - bottom
               else print "nothing" }'
}

box 10 20 30 16 22 31 >box.off
"$program" render box.off --ids usual.npy --size 64x48 -q || wrong 'render'
for words in '' '--view front' '--view back' '--view left' '--view right' \
  '--view top' '--view bottom' '--view iso' '--ortho' '--view top --ortho' \
  '--up 0,1,0' '--view front --up 0,1,0' '--up 1,2,3 --ortho'; do
  # shellcheck disable=SC2086
  "$program" render box.off --ids a.npy --size 64x48 -q $words ||
    wrong "render $words"
  read -r left right top bottom <<<"$(extent a.npy)"
  [ "$bottom" ] || { wrong "'$words' shows nothing"; continue; }
  [ $((left - right)) -ge -1 ] && [ $((left - right)) -le 1 ] &&
    [ $((top - bottom)) -ge -1 ] && [ $((top - bottom)) -le 1 ] ||
    wrong "'$words' is not centred: $left $right $top $bottom"
  [ "$left" -le 3 ] || [ "$top" -le 3 ] ||
    wrong "'$words' does not fill the picture: $left $right $top $bottom"
done
# What is in front with z up is on top with y up.
"$program" render box.off --ids a.npy --size 64x48 -q --view front --up 0,1,0
"$program" render box.off --ids b.npy --size 64x48 -q --view top
same a.npy b.npy
# Light comes from above there, too: what is bright with z up is with y up.
color_of() { sed -n 's/^p .* color //p' "$1" | sed -n "$2p"; }
"$program" scene box.off -o z_up.scene -q || wrong 'scene'
"$program" scene box.off -o y_up.scene -q --up 0,1,0 || wrong 'scene --up'
"$program" scene box.off -o lit.scene -q --up 0,1,0 --light 0.15,-0.45,0.88
[ "$(color_of z_up.scene 2)" = "$(color_of y_up.scene 4)" ] ||
  wrong "the top is not as bright with y up: $(color_of y_up.scene 4)"
[ "$(color_of z_up.scene 2)" = "$(color_of lit.scene 2)" ] ||
  wrong '--light turns with --up'
"$program" render box.off -o lines.png --size 64x48 -q --lines wire
"$program" render box.off -o edges.png --size 64x48 -q --edges wire
same lines.png edges.png
expect 2 'excludes' render box.off --ids a.npy --view top --eye 1,2,3
expect 2 '\-\-view.*front|back.*sideways' render box.off --ids a.npy \
  --view sideways

# A film of a scene has the size of its camera.
"$program" scene box.off -o box.scene --size 64x48 -q || wrong 'scene'
printf '0 eye 40,-40,40 target 13,21,30\n' >tour.txt
expect 0 'span: 64x48' render box.scene --ids '%d.npy' --path tour.txt

# A white mesh is lit: its faces differ from the page and from each other.
{
  printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n'
  printf 'property float y\nproperty float z\nproperty uchar red\n'
  printf 'property uchar green\nproperty uchar blue\nelement face 4\n'
  printf 'property list uchar int vertex_indices\nend_header\n'
  printf '0 0 0 255 255 255\n1 0 0 255 255 255\n0 1 0 255 255 255\n'
  printf '0 0 1 255 255 255\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n'
} >white.ply
"$program" scene white.ply -o white.scene -q || wrong 'scene white.ply'
[ "$(sed -n 's/.*color //p' white.scene | sort -u | wc -l)" = 4 ] ||
  wrong 'white faces are not lit'
grep -q 'color 255 255 255' white.scene && wrong 'a white face on a white page'
"$program" scene white.ply -o red.scene -q --color '#ff0000' --light 0,0,1
grep -q 'color [0-9]* 0 0' red.scene || wrong '--color'
"$program" scene white.ply -o page.scene -q --background 10,20,30
grep -q '^background 10 20 30' page.scene || wrong '--background'
# A boolean writes the colours of the file, not those of a picture.
"$program" csg 'A' A=white.ply -o same.off -q || wrong 'csg'
grep -q '255 255 255' same.off || wrong 'csg changed the colours'
for color in 1,2 '#12345' 1,2,256 red; do
  expect 2 '\-\-background' render box.off -o a.png --background "$color"
done
expect 2 '\-\-light' render box.off -o a.png --light 0,0,0

# A picture that shows nothing says so.
expect 0 'warning: the picture shows nothing' render box.off -o a.png \
  --size 8x8 --eye 0,0,0 --target=-1,-1,-1
finish
