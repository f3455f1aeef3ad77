#!/usr/bin/env bash
# Faces with many corners on their sides stay faces of solids.
. "$(dirname "$0")/expect.sh"
make_plates=${0%/*}/../make_plates.py

python3 "$make_plates" plates --count 12 >names.txt
while read -r plate; do
  expect 0 'solid      yes' info "$plate" --check
  expect 0 closed csg "rotate(P, 2, 7, 3, 20) & translate(box(300), -150, \
    -150, -260)" P="$plate" -o cut.stl
  expect 0 'solid      yes' info cut.stl --check
done <names.txt
finish
