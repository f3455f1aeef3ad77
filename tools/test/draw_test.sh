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
head -c 8 a.pdf | grep >/dev/null '%PDF-1.4' || wrong "a.pdf is no PDF"
expect 0 ' 1 regions' draw cubes.off -o none.svg --eye 900,0,0 --target 999,0,0
expect 2 'one of .svg .pdf .eps .tex .dxf .hpgl' draw cubes.off -o a.bmp
expect 2 'needs [0-9]* cells, and the limit is 3$' draw cubes.off -o b.svg --most-cells 3
[ -e b.svg ] && wrong "a figure that is too large was written"
expect 2 'must be\|not in' draw cubes.off -o a.svg --by colours

# Shaded regions have the picture's colours, within the levels.
colors=$(dirname "$check")/draw_colors.py
tent() {
  python3 - "$1" <<'END'
import sys
n = int(sys.argv[1])
points = [(x, y, (x - 2) * (y - 1) % 3) for y in range(n) for x in range(n)]
faces = [f for y in range(n - 1) for x in range(n - 1)
         for a in [n * y + x]
         for f in ((a, a + 1, a + n + 1), (a, a + n + 1, a + n))]
print("COFF\n%d %d 0" % (len(points), len(faces)))
for p in points:
    print(*p, 40 + 20 * p[0] % 200, 200 - 30 * p[1] % 200, 90, 255)
for f in faces:
    print(3, *f)
END
}
tent 4 >tent.off
for view in "--ortho" "--eye 1,-3,3 --target 2,2,1 --fov 70"; do
  for levels in 2 12; do
    # shellcheck disable=SC2086
    set -- $view --size 48x36 --shade gouraud
    expect 0 'span' render tent.off "$@" -o c.png
    for ending in svg pdf; do
      expect 0 ' 0 turned over' draw tent.off "$@" -o "c.$ending" \
        --decimals 6 --levels "$levels" --certificate
      python3 "$colors" "c.$ending" c.png "$levels" ||
        wrong "$view, $levels levels: $ending has other colours"
    done
  done
done
for ending in eps tex; do
  expect 0 ' regions' draw tent.off --shade gouraud -o "c.$ending" --size 48x36
done
# What would turn over gets more decimals.
tent 30 >fine.off
expect 0 ' 0 turned over, .*; [1-9][0-9]* points with up to [1-9]' draw \
  fine.off -o t.svg --by polygon --size 40x30 --decimals 0 --certificate \
  --view iso
# Shaded regions are of one polygon each.
expect 0 ' regions' draw tent.off --fill shaded -o shaded.svg --size 48x36
grep -q linearGradient shaded.svg || wrong "nothing is shaded"
for by in face part file all; do
  expect 2 "regions by $by have one colour" draw tent.off --shade gouraud \
    --by "$by" -o none.svg
done
grep -q "certificate: coordinates moved by .* 0 of [0-9]* loops turned" \
  a.svg || wrong "a.svg has no certificate"
grep -q 'id="region-0" class="' a.svg || wrong "paths have no ids"

# Lines: hidden parts are dashed, gone, or named with their edges.
expect 0 ' [1-9][0-9]* strokes' draw cubes.off -o gone.svg --lines edges
expect 0 ' strokes' draw cubes.off -o dashed.svg --view iso --hidden dashed \
  --crease 20 --titles
grep -q 'stroke-dasharray' dashed.svg || wrong "nothing is dashed"
grep -q 'stroke-dasharray' gone.svg && wrong "hidden lines are drawn"
grep -q '<title>polygon [0-9]* edge [0-9]*-[0-9]* [0-9.]* to .* behind' \
  dashed.svg || wrong "strokes do not name their edges"
grep -q '<title>polygons [0-9]* and [0-9]* ' dashed.svg ||
  wrong "intersections are not drawn"
for ending in svg pdf eps tex dxf hpgl; do
  expect 0 'scale 1:\|scale [0-9]*:1' draw cubes.off -o "s.$ending" --sheet a4 \
    --hidden dashed
  [ -s "s.$ending" ] || wrong "s.$ending is empty"
done
grep -q 'width="297mm" height="210mm"' s.svg || wrong "the sheet is not A4"
grep -q 'MediaBox\[0 0 841.89 595.276\]' s.pdf || wrong "the page is not A4"
expect 2 'no room' draw cubes.off -o s.svg --sheet a4 --scale 1000:1
expect 2 'holds lines alone' draw cubes.off -o s.dxf --lines none
# A section is hatched where it is seen, and nowhere else.
expect 0 'polygons' csg 'box(4, 3, 2) & half(z < 1)' -o half.off
expect 0 ' strokes' draw half.off -o cut.svg --view top --ortho --cut z=1
grep -q 'id="hatching"' cut.svg || wrong "the section is not hatched"
grep -q 'id="section"' cut.svg || wrong "the section has no border"
expect 0 ' strokes' draw half.off -o cut.svg --view bottom --ortho --cut z=1
grep -q 'id="hatching"' cut.svg && wrong "a hidden section is hatched"
expect 2 'x, y or z' draw half.off -o cut.svg --cut w=1
# What polygons let through is composed; it is of flat colours alone.
for view in "" "--ortho --cull"; do
  # shellcheck disable=SC2086
  set -- $view --size 48x36 --alpha 120
  expect 0 'painter' render cubes.off "$@" -o glass.png
  expect 0 ' regions' draw cubes.off "$@" -o glass.svg --decimals 6
  python3 "$colors" glass.svg glass.png 0 || wrong "glass has other colours"
done
expect 2 'composes' draw cubes.off --alpha 120 --by part -o none.svg
# Each file may have its own alpha: one that is not seen changes no colour.
expect 0 ' regions' draw cubes.off --size 48x36 --ortho -o one.svg --alpha 120
expect 0 ' regions' draw cubes.off cubes.off --size 48x36 --ortho -o two.svg \
  --alpha 120,0
same one.svg two.svg
expect 2 'one a FILE' draw cubes.off --alpha 120,0 -o none.svg
# A file may say how opaque each face is, or its corners in the mean.
ply() { # ply VERTEX-PROPERTIES FACE-PROPERTIES, then vertices and faces
  printf 'ply\nformat ascii 1.0\nelement vertex 8\n'
  for name in x y z; do echo "property float $name"; done
  for name in $1; do echo "property uchar $name"; done
  echo 'element face 2'
  echo 'property list uchar int vertex_indices'
  for name in $2; do echo "property uchar $name"; done
  echo end_header
}
corners='0 0 0,4 0 0,4 4 0,0 4 0,1 1 2,5 1 2,5 5 2,1 5 2'
rgba='red green blue alpha'
{ ply '' "$rgba"; tr , '\n' <<<"$corners"
  echo; echo '4 0 1 2 3 255 0 0 255'; echo '4 4 5 6 7 0 0 255 102'; } |
  grep . >faces.ply
{ ply "$rgba" ''; k=0; tr , '\n' <<<"$corners" | while read -r p; do
    [ $k -lt 4 ] && echo "$p 255 0 0 255"
    [ $k -ge 4 ] && echo "$p 0 0 255 $((k % 2 == 0 ? 94 : 110))"
    k=$((k + 1)); done
  echo '4 0 1 2 3'; echo '4 4 5 6 7'; } | grep . >corners.ply
for file in faces corners; do
  expect 0 ' 4 regions' draw $file.ply --view top --ortho -o own.svg
  # 102 of 255 parts of blue over red, and over white, in light from above.
  for color in e80000 8b005d 9999f6; do
    grep -q "fill=\"#$color\"" own.svg || wrong "$file: no #$color"
  done
  expect 0 ' 3 regions' draw $file.ply --view top --ortho -o own.svg --alpha 255
  expect 0 ' 3 regions' draw $file.ply --view top --ortho -o own.svg --by polygon
done
expect 0 ' 4 regions' draw faces.ply corners.ply --view top --ortho -o own.svg \
  --lines regions
# Numbers are bands of one colour, those of the picture, and have a legend.
printf 'n\n' >tent.csv
for k in 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
  echo $((k * 7 % 16)) >>tent.csv
done
for view in "--ortho --steps 5" "--eye 1,-3,3 --target 2,2,1 --range 2,12 --steps 7 \
    --no-clamp"; do
  # shellcheck disable=SC2086
  set -- $view --size 48x36 --scalar tent.csv:n
  expect 0 'span' render tent.off "$@" -o n.png
  expect 0 ' regions' draw tent.off "$@" -o n.svg --decimals 9
  python3 "$colors" n.svg n.png 0 || wrong "numbers have other colours"
done
for ending in svg pdf eps tex; do
  expect 0 ' regions' draw tent.off --scalar tent.csv:n --legend \
    --legend-title height --steps 4 -o "n.$ending"
  [ -s "n.$ending" ] || wrong "n.$ending is empty"
done
grep -q 'class="legend">height<' n.svg || wrong "the legend has no title"
[ "$(grep -c '<path class="legend" fill=' n.svg)" = 4 ] ||
  wrong "the legend has not four colours"
expect 2 'larger --size' draw tent.off --scalar tent.csv:n --legend \
  --size 20x20 -o none.svg
expect 2 'gives regions' draw tent.off --scalar tent.csv:n --by part -o none.svg
# Clip planes cut regions as they cut pictures, and caps are regions.
for view in "" "--ortho --cull" "--yon 600"; do
  # shellcheck disable=SC2086
  set -- $view --size 48x36 --clip 3,1,2,40 --clip=-1,0,0,90 --cap hatch
  expect 0 'span' render cubes.off "$@" -o cut.png
  for by in colour polygon part; do
    [ $by = part ] && color=part || color=face
    expect 0 ' regions' draw cubes.off "$@" --by $by --fill $color -o cut.svg \
      --decimals 6 --lines regions
    grep -q '<title>cap<' cut.svg || wrong "there is no cap"
    grep -q '<title>hatching<' cut.svg || wrong "the cap is not hatched"
    [ $by = part ] || python3 "$colors" cut.svg cut.png 0 ||
      wrong "the section has other colours by $by"
  done
done
expect 0 ' strokes' draw cubes.off --clip 1,0,0,0 -o cut.svg --lines edges \
  --hidden dashed --cap hatch --titles --ortho --view right
grep -q 'id="section"' cut.svg || wrong "the cut has no edges"
grep -q '<title>cut of polygon' cut.svg || wrong "the cut names no polygon"
expect 0 ' strokes' draw cubes.off --clip 1,0,0,0 --clip 0,1,0,0 \
  --clip 0,0,-1,0 -o cut.svg --lines edges --hidden dashed --cap hatch --titles
grep -q '<title>where caps meet' cut.svg || wrong "no caps meet"
for view in "" "--ortho --cull" "--yon 600"; do
  # shellcheck disable=SC2086
  set -- $view --size 48x36 --clip 3,1,2,40 --cap hatch --alpha 120
  expect 0 'painter' render cubes.off "$@" -o glass.png
  expect 0 ' regions' draw cubes.off "$@" -o glass.svg --decimals 6
  python3 "$colors" glass.svg glass.png 0 || wrong "cut glass has other colours"
done
# Caps let through what their file does.
set -- cubes.off pinwheel.off --size 48x36 --ortho --clip 1,0,0,0 -o two.svg
for cap in hatch file part; do
  expect 0 ' regions' draw "$@" --cap $cap --alpha 0,0
  grep 'fill="#' two.svg | grep -v 'fill="#ffffff"' && wrong "a $cap is seen"
  expect 0 ' regions' draw "$@" --cap $cap --alpha 0,90
  grep 'fill="#' two.svg | grep -v 'fill="#ffffff"' >/dev/null ||
    wrong "no $cap is seen"
done
expect 2 'needs --clip' draw cubes.off --cap hatch -o none.svg
# Axes and notes are seen where nothing is before them.
expect 0 ' strokes' draw cubes.off --axes -o axes.svg --view iso
grep -q 'class="tick">' axes.svg || wrong "axes have no numbers"
grep -q 'class="axis">z<' axes.svg || wrong "axes have no names"
printf '# a comment\npoint 0 0 200 tip & top\npoint 0 0 0 inside\n' >notes.txt
printf 'line -200 0 0 250 0 0\ntext 0 0 210 (words)\n' >>notes.txt
for ending in svg pdf eps tex dxf hpgl; do
  expect 0 ' strokes' draw cubes.off --notes notes.txt --view iso --ortho \
    --height 500 --hidden dashed -o "notes.$ending"
  [ -s "notes.$ending" ] || wrong "notes.$ending is empty"
done
grep -q '>tip &amp; top<' notes.svg || wrong "a point has no text"
grep -q '>inside<' notes.svg && wrong "a hidden text is written"
grep -q 'id="hidden-given"' notes.svg || wrong "no part of a line is hidden"
# Clip planes cut notes, not axes, and caps hide both.
expect 0 ' strokes' draw cubes.off --notes notes.txt --view iso --ortho \
  --height 500 --clip 0,0,-1,100 -o cut.svg
grep -q '>tip &amp; top<' cut.svg && wrong "a point is seen that is cut away"
printf 'point 0 0 0 inside\n' >within.txt
set -- cubes.off --notes within.txt --view right --ortho --clip=-1,0,0,-1
expect 0 ' strokes' draw "$@" -o cut.svg
grep -q '>inside<' cut.svg && wrong "a point is seen that is cut away"
set -- cubes.off --notes within.txt --view right --ortho --clip=-1,0,0,1
expect 0 ' strokes' draw "$@" -o cut.svg
grep -q '>inside<' cut.svg || wrong "a point is hidden that the cut uncovers"
expect 0 ' strokes' draw "$@" --cap hatch -o cut.svg
grep -q '>inside<' cut.svg && wrong "a point behind a cap is seen"
for caps in "" "--cap hatch"; do
  # shellcheck disable=SC2086
  expect 0 ' strokes' draw cubes.off --axes -o cut-axes.svg --view iso \
    --clip 0,0,1,-900 $caps
  [ "$(grep -c 'class="tick">' cut-axes.svg)" -ge \
    "$(grep -c 'class="tick">' axes.svg)" ] || wrong "axes are cut"
done
printf 'circle 1 2 3\n' >bad.txt
expect 2 'bad.txt: line 1: begins with .circle' draw cubes.off --notes bad.txt \
  -o none.svg
printf 'text 1 2\n' >bad.txt
expect 2 'bad.txt: line 1: .* is no finite number' draw cubes.off \
  --notes bad.txt -o none.svg
# Several files, and one without polygons.
expect 0 ' regions' draw cubes.off pinwheel.off -o two.svg --fill file
grep -q '<title>file 1' two.svg || wrong "the second file is not seen"
printf 'OFF\n1 0 0\n0 0 0\n' >empty.off
for ending in svg pdf eps tex dxf hpgl; do
  expect 0 ' 0 polygons; 0 regions' draw empty.off -o "e.$ending" --lines edges
  [ -s "e.$ending" ] || wrong "e.$ending is empty"
done

exit $((failures > 0))
