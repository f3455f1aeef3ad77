#!/usr/bin/env bash
# compare: 0 for equal images, 1 for different ones, with count and place.
. "$(dirname "$0")/expect.sh"

# An item image of 3 columns and 2 rows, its last pixel as said.
image() {
  local header="{'descr': '<i4', 'fortran_order': False, 'shape': (2, 3), }"
  printf '\x93NUMPY\x01\x00\x76\x00%-117s\n' "$header"
  printf '\x00\x00\x00\x00%.0s' 1 2 3 4
  printf '\xff\xff\xff\xff'
  # shellcheck disable=SC2059
  printf "\\x0$1\\x00\\x00\\x00"
}
image 5 >five.npy
image 5 >also_five.npy
image 6 >six.npy
expect 0 'mismatches: 0 of 6' compare five.npy also_five.npy
expect 1 'column 2, row 1: 5 and 6' compare five.npy six.npy
expect 1 'mismatches: 1 of 6' compare five.npy six.npy
head -c 130 five.npy >cut.npy
expect 2 'cut.npy' compare five.npy cut.npy

# Images of other sizes differ; so do those of other eyes.
"$make_model" cube -o cube.off || exit 1
expect 0 'span' render cube.off --size 8x6 --ids a.npy
expect 0 'span' render cube.off --size 6x8 --ids b.npy
expect 0 'span' render cube.off --size 8x6 --eye 500,500,500 --ids c.npy
expect 1 'sizes differ: 8x6 and 6x8' compare a.npy b.npy
expect 1 'mismatches: ' compare a.npy c.npy
expect 0 'mismatches: 0 of 48' compare a.npy a.npy
finish
