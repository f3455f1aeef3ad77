#!/usr/bin/env bash
# Scalars: all libraries and methods colour alike, files of all kinds say the
# same, and bad input is one line with nothing written.
. "$(dirname "$0")/expect.sh"

# Numbers at the corners of a cube, of six quadrangles, in text and binary.
python3 - <<'PYTHON' || exit 1
import struct
points = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4),
         (1, 5, 7, 3)]
heat = [x + 2 * y + 4 * z + 0.25 for x, y, z in points]
head = ("ply\nformat %s 1.0\nelement vertex 8\nproperty float x\n"
        "property float y\nproperty float z\nproperty double heat\n"
        "element face 6\nproperty list uchar int vertex_indices\n"
        "property short part\nend_header\n")
with open("cube.ply", "w") as file:
    file.write(head % "ascii")
    for point, value in zip(points, heat):
        file.write("%d %d %d %r\n" % (*point, value))
    for k, face in enumerate(faces):
        file.write("4 %d %d %d %d %d\n" % (*face, k))
with open("bytes.ply", "wb") as file:
    file.write((head % "binary_big_endian").encode())
    for point, value in zip(points, heat):
        file.write(struct.pack(">fffd", *point, value))
    for k, face in enumerate(faces):
        file.write(struct.pack(">Biiiih", 4, *face, k))
with open("heat.csv", "w") as file:
    file.write("name,heat\n")
    for k, value in enumerate(heat):
        file.write('"p%d", %r\n' % (k, value))
def array(name, code, kind, values, shape=None):
    text = "{'descr': '%s', 'fortran_order': False, 'shape': %s, }" % (
        code, shape or "(%d,)" % len(values))
    text += "\n"
    with open(name, "wb") as file:
        file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) +
                   text.encode())
        file.write(struct.pack("<%d%s" % (len(values), kind), *values))
array("heat.npy", "<f8", "d", heat)
array("part.npy", "<i2", "h", range(6))
array("seven.npy", "<f8", "d", range(7))
array("gap.npy", "<f4", "f", [1, 2, 3, 4, 5, float("nan")])
array("flat.npy", "<f8", "d", range(8), "(4, 2)")
open("map.txt", "w").write("# three\n255 0 0\n#00ff00\n0 0 255\n")
open("bad-map.txt", "w").write("255 0 0\n256 0 0\n")
PYTHON
rendered=60x45
height=${rendered#*x}
half=$((height / 2))
size=(--size "$rendered")
heat=(--scalar heat --map heated --range 0,8)

expect 0 'span' render cube.ply "${size[@]}" "${heat[@]}" -o span.png
for method in painter zbuffer raycast; do
  expect 0 "$method" render cube.ply "${size[@]}" "${heat[@]}" \
    --method $method -o $method.png
  same span.png $method.png
done
expect 0 'span' render bytes.ply "${size[@]}" "${heat[@]}" -o bytes.png
same span.png bytes.png
for file in heat.npy heat.csv:heat; do
  expect 0 'span' render cube.ply "${size[@]}" --scalar $file --map heated \
    --range 0,8 -o other.png
  same span.png other.png
done
expect 0 'span' render cube.ply "${size[@]}" --scalar part -o part.png
expect 0 'span' render cube.ply "${size[@]}" --scalar part.npy -o other.png
same part.png other.png
for samples in "" "--aa 4" "--aa 4 --impl ref"; do
  # shellcheck disable=SC2086
  expect 0 'span' render cube.ply --size 20x15 "${heat[@]}" $samples \
    -o "few$samples.png"
done
same 'few--aa 4.png' 'few--aa 4 --impl ref.png'
cmp -s few.png 'few--aa 4.png' && wrong "--aa changes no colour of a scalar"
# Blended in the colours of numbers, by each way there is to an image.
glass=("${heat[@]}" --alpha 90)
expect 0 'painter' render cube.ply "${size[@]}" "${glass[@]}" -o glass.png
cmp -s glass.png span.png && wrong "--alpha changes no colour of a scalar"
expect 0 'painter' render cube.ply "${size[@]}" --alpha 90 -o other.png
cmp -s glass.png other.png && wrong "--scalar changes no blended colour"
for way in "--impl ref" --lazy "--priority depthsort" "--threads 2"; do
  # shellcheck disable=SC2086
  expect 0 'painter' render cube.ply "${size[@]}" "${glass[@]}" $way -o other.png
  same glass.png other.png
done
expect 0 'span' render cube.ply "${size[@]}" "${heat[@]}" --alpha 255 \
  -o other.png
same span.png other.png
expect 0 'span' render cube.ply "${size[@]}" "${heat[@]}" --rows 0:$half \
  -o r-0.png
expect 0 'span' render cube.ply "${size[@]}" "${heat[@]}" \
  --rows $half:"$height" -o r-1.png
expect 0 '' join r-0.png r-1.png -o joined.png
same joined.png span.png
# The shape stays what it was, and each option changes the picture.
expect 0 'span' render cube.ply "${size[@]}" "${heat[@]}" --ids a.npy
expect 0 'span' render cube.ply "${size[@]}" --shade gouraud --ids b.npy
same a.npy b.npy
for option in --log "--steps 3" "--map viridis" "--map turbo_r" \
  "--map map.txt" "--range 2,3" "--range 2,3 --no-clamp"; do
  # shellcheck disable=SC2086
  expect 0 'span' render cube.ply "${size[@]}" --scalar heat $option -o o.png
  cmp -s o.png span.png && wrong "$option changes nothing"
done
expect 0 'span' render cube.ply "${size[@]}" --scalar gap.npy -o gap.png
expect 0 'span' render cube.ply "${size[@]}" --scalar gap.npy \
  --nan-color '#ff00ff' -o other.png
cmp -s gap.png other.png && wrong "--nan-color changes nothing"
expect 0 'span' render cube.ply --scalar heat -o plain.png
expect 0 'span' render cube.ply --scalar heat --legend -o legend.png
cmp -s plain.png legend.png && wrong "--legend changes nothing"

bad() {  # bad SENTENCE OPTIONS...
  local sentence=$1
  shift
  expect 2 "$sentence" render cube.ply "$@" -o no.png
}
bad '7 numbers for 8 vertices or 6 faces' --scalar seven.npy
bad 'one dimension' --scalar flat.npy
bad 'none.npy: cannot be read' --scalar none.npy
bad 'there is no property .warmth. .* only x, y, z, heat, part' --scalar warmth
bad '2 columns' --scalar heat.csv
"$make_model" cube -o cube.off
expect 2 'height is no .npy or .csv, and only a PLY' render cube.off \
  --scalar height -o no.png
bad 'no column' --scalar heat.csv:cold
bad 'is no number' --scalar heat.csv:name
bad 'is no file, and no map: heated' --scalar heat --map sunny
bad 'bad-map.txt: line 2: .256. is not from 0 to 255' --scalar heat \
  --map bad-map.txt
bad 'LOW below HIGH' --scalar heat --range 3,3
bad 'begins above 0' --scalar heat --range -1,3 --log
bad 'at least 2 and at most 4096' --scalar heat --steps 1
bad 'needs --scalar' --legend
bad 'no exact areas' --scalar heat --aa exact
bad 'would overwrite' --scalar no.png.npy --ids no.png.npy
bad 'whole pictures' --scalar heat --legend --rows 0:9
[ -e no.png ] && wrong "a picture was written for bad input"

finish
