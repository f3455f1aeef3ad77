#!/usr/bin/env bash
# Objects that move: in boxes and hulls, the image of the polygons moved; what
# is wrong with them is one line, and nothing is written.
. "$(dirname "$0")/expect.sh"

box -9 -9 -1 9 9 0 >floor.off
box -1 -1 -1 1 1 1 >block.off
view=(--size 40x30 --eye 9,-16,12 --target 0,0,1)

# objects LINE...: a file of a floor with these lines.
objects() {
  printf '%s\n' 'halfspace-objects 1' 'world floor.off' \
    'model block block.off' "$@" >a.objects
}
left='object left block region -6,-4,1 -1,4,6'
# A tent over the right half.
tent='region 0,-4,1 8,-4,1 0,4,1 8,4,1 4,-4,7 4,4,7'
right="object right block $tent"

objects "$left move -3,0,2.5 turn 0,0,1,30" "$right move 4,0,2.5 scale 0.5"
expect 0 '18 polygons in 2 objects' render a.objects "${view[@]}" -o a.png \
  --ids a.npy
expect 0 '40x30' render a.objects "${view[@]}" -o b.png --ids b.npy --impl ref
expect 0 'mismatches: 0 of' compare a.npy b.npy
same a.png b.png
expect 0 '40x30' render a.objects "${view[@]}" --ids b.npy --impl ref \
  --method zbuffer
expect 0 'mismatches: 0 of' compare a.npy b.npy

# All other looks are those of the scene of what has moved, by both libraries
# alike; what only says how to draw changes no byte.
for look in "--lines features --line-width 2" "--lines wire --rows 3:9" \
  "--back-color 255,0,0 --clip 1,0,0,3" "--aa 2" "--aa exact" "--alpha 120" \
  "--lines outline --aa 4 --clip 1,0,0,3" "--rows 5:25" \
  "--background gradient" "--shade gouraud --smooth 60 --aa 2"; do
  # Few pixels where the reference takes seconds for many.
  seen=("${view[@]}")
  [[ $look == *--lines* || $look == *--aa* ]] && seen[1]=16x12
  [[ $look == *"--aa exact"* || $look == *"--aa 4"* ]] && seen[1]=8x6
  expect 0 "${seen[1]%x*}x" render a.objects "${seen[@]}" -o plain.png
  # shellcheck disable=SC2086
  expect 0 "${seen[1]%x*}x" render a.objects "${seen[@]}" $look -o a.png \
    --ids a.npy
  # shellcheck disable=SC2086
  expect 0 "${seen[1]%x*}x" render a.objects "${seen[@]}" $look -o b.png \
    --ids b.npy --impl ref
  expect 0 'mismatches: 0 of' compare a.npy b.npy
  same a.png b.png
  cmp -s a.png plain.png && wrong "$look changes nothing"
done
expect 0 '40x30' render a.objects "${view[@]}" -o plain.png
for same in "--priority depthsort" "--screen quad" "--alpha 255"; do
  # shellcheck disable=SC2086
  expect 0 '40x30' render a.objects "${view[@]}" $same -o a.png
  same a.png plain.png
done
expect 0 '40x10' render a.objects "${view[@]}" --lines wire --rows 0:10 \
  -o rows-0.png
expect 0 '40x20' render a.objects "${view[@]}" --lines wire --rows 10:30 \
  -o rows-1.png
expect 0 '40x30' render a.objects "${view[@]}" --lines wire -o a.png
expect 0 '' join rows-0.png rows-1.png -o joined.png
same joined.png a.png
expect 0 '3 frames' render a.objects --size 40x30 --turntable 3 --lines wire \
  -o t-%d.png
cmp -s t-0.png t-1.png && wrong "the turntable does not turn"
for option in --lazy "--heuristic first" "--shadow 1" "--tree a.tree"; do
  # shellcheck disable=SC2086
  expect 2 'objects' render a.objects $option -o bad.png
done

# Numbers of the models have one scale; what has none has no data.
{
  printf 'ply\nformat ascii 1.0\nelement vertex 4\n'
  printf 'property float %s\n' x y z heat
  printf 'element face 4\nproperty list uchar int vertex_index\nend_header\n'
  printf '%s\n' '-1 -1 -1 0' '1 -1 -1 3' '0 1 -1 7' '0 0 1 9' \
    '3 0 2 1' '3 0 1 3' '3 1 2 3' '3 2 0 3'
} >hot.ply
printf '%s\n' 'halfspace-objects 1' 'world floor.off' 'model hot hot.ply' \
  'model block block.off' "${left/block/hot} move -3,0,2.5 turn 0,0,1,30" \
  "$right move 4,0,2.5 scale -0.5" >hot.objects
for look in "" "--aa 2" "--alpha 90" "--legend"; do
  # shellcheck disable=SC2086
  expect 0 '40x30' render hot.objects "${view[@]}" --scalar heat $look -o a.png
  # shellcheck disable=SC2086
  expect 0 '40x30' render hot.objects "${view[@]}" --scalar heat $look -o b.png \
    --impl ref
  same a.png b.png
done
expect 2 'no model is a PLY with numbers called cold' render hot.objects \
  --scalar cold -o bad.png
printf '1\n' >n.csv
expect 2 'give a property' render hot.objects --scalar n.csv -o bad.png

# Sections are those of the objects where they stand, with caps of each.
for caps in "" "--cap hatch" "--cap part" "--cap file"; do
  # shellcheck disable=SC2206
  cut=("${view[@]}" --clip 0.2,1,0.1,-0.5 --clip 0,-1,-1,6 $caps)
  expect 0 '40x30' render a.objects "${cut[@]}" -o cut.png --ids cut.npy
  cmp -s cut.png a.png && wrong "--clip $caps changes nothing"
  expect 0 '40x30' render a.objects "${cut[@]}" -o b.png --ids b.npy --impl ref
  expect 0 'mismatches: 0 of' compare cut.npy b.npy
  same cut.png b.png
  expect 0 '40x30' render a.objects "${cut[@]}" --ids b.npy --impl ref \
    --method zbuffer
  expect 0 'mismatches: 0 of' compare cut.npy b.npy
  cmp -s cut.png before.png && wrong "$caps changes nothing"
  cp cut.png before.png
done
expect 0 '40x30' render a.objects "${view[@]}" --yon 19 -o far.png
cmp -s far.png a.png && wrong "--yon changes nothing"
expect 2 'needs --clip' render a.objects --cap hatch -o bad.png
objects cut "$left move -3,0,2.5"
expect 0 '40x30' render a.objects "${view[@]}" --clip 0,1,0,0 -o cut.png
expect 2 'leaves it open' render a.objects --clip 0,1,0,0 --cap hatch -o bad.png
printf 'OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n' >sheet.off
printf '%s\n' 'halfspace-objects 1' 'world floor.off' 'model block sheet.off' \
  "$left move -3,0,2.5" >a.objects
expect 2 'models is not closed' render a.objects --clip 0,1,0,0 --cap hatch \
  -o bad.png

# Where the world's polygons are in the way, it says so, or cuts.
objects 'object low block region 1,1,-0.5 6,6,4 move 3,3,2'
expect 2 'region of low is not free: polygon' render a.objects \
  -o bad.png
objects 'cut' 'object low block region 1,1,-0.5 6,6,4 move 3,3,2'
expect 0 '1 objects' render a.objects "${view[@]}" --ids a.npy
expect 0 '40x30' render a.objects "${view[@]}" --ids b.npy --impl ref
expect 0 'mismatches: 0 of' compare a.npy b.npy
expect 2 '--lines: draws whole polygons' render a.objects --lines wire -o bad.png

# wrong_objects PATTERN LINE...: these lines are an error.
wrong_objects() {
  local pattern=$1
  shift
  objects "$@"
  expect 2 "$pattern" render a.objects -o bad.png --ids bad.npy
}
wrong_objects 'regions of left and of two share space' "$left" \
  'object two block region -2,-4,1 3,4,6'
wrong_objects 'regions of left and of two share space' "$left" \
  'object two block region -2,-4,1 3,-4,1 3,4,1 3,0,6'
wrong_objects 'right leaves its region' "$right move 4,0,5"
wrong_objects 'left leaves its region' "$left move -2,0,2.5"
wrong_objects 'turn must be X,Y,Z,DEGREES' "$left turn 0,0,1"
wrong_objects 'singular' "$left move -3,0,2.5 scale 0"
wrong_objects 'left has a map with an entry of 2^31' "$left move -3,0,2.5 scale 1e12"
wrong_objects 'moves by 2^86' "$left move 1e30,0,0"
wrong_objects 'lie in one plane' \
  'object two block region 0,0,1 1,0,1 0,1,1 1,1,1'
wrong_objects 'is empty' 'object two block region 3,0,1 2,4,2'
wrong_objects 'at least 4 points' 'object two block region 0,0,1 1,0,1 0,1,1'
wrong_objects 'beyond every grid' 'object two block region 0,0,1 1e30,1,2'
wrong_objects 'there is no model ball' 'object two ball region 0,0,1 1,1,2'
wrong_objects 'knows move, turn' "$left spin 3"
wrong_objects 'a second object left' "$left" "$left"

for content in '' '# nothing'; do
  printf '%s\n' "$content" >empty.objects
  expect 2 'line 1: begins with halfspace-objects 1' render empty.objects \
    -o bad.png
done
: >empty.objects
expect 2 'line 1: begins with halfspace-objects 1' render empty.objects -o bad.png
printf 'halfspace-objects 1\n' >empty.objects
expect 2 'line 1: has no world' render empty.objects -o bad.png

# In any frame, before the first is drawn.
objects "$left move -3,0,2.5" "$right move 4,0,2.5 scale 0.5"
printf '0 right.move 4,0,2.5\n8 right.move 4,0,6.9\n' >a.path
expect 2 'frame [1-8]: right leaves its region' render a.objects \
  "${view[@]}" --path a.path -o bad-%d.png
printf '0 right.move 4,0,2.5\n8 right.move 4,0,3\n' >a.path
expect 0 '9 frames' render a.objects "${view[@]}" --path a.path -o f-%d.png
printf '0 ball.move 4,0,2.5\n' >a.path
expect 2 'there is no object ball' render a.objects --path a.path -o bad-%d.png
[ -z "$(ls bad* 2>/dev/null)" ] || wrong "a failed run left $(ls bad*)"

finish
