#!/usr/bin/env bash
# What `info` shows: measures, components, genus, faults, JSON.
. "$(dirname "$0")/expect.sh"

box 10 20 30 12 23 34 >a.off
box 0 0 0 0.5 0.5 0.5 >b.off
expect 0 '^volume     24$' info a.off
expect 0 '^area       52$' info a.off
expect 0 '^size       2 x 3 x 4$' info a.off
expect 0 '^centre     11, 21.5, 32$' info a.off
expect 0 '^components 1 (genus 0)$' info a.off
expect 0 '^from       10, 20, 30 times' info a.off --exact
"$program" csg '"a.off" & "b.off"' -o nothing.off -q
expect 0 '^components 0$' info nothing.off
# A plate with a hole, and a box apart.
box 0 0 0 9 9 1 >plate.off
box 3 3 -1 6 6 2 >hole.off
box 20 0 0 21 1 1 >apart.off
"$program" csg '("plate.off" - "hole.off") | "apart.off"' -o two.off -q
expect 0 '^components 2 (genus 1, 0)$' info two.off
# A third is no decimal.
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 2\n' >third.off
printf '3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n' >>third.off
expect 0 '^volume     0.333333333333$' info third.off
expect 0 '^volume     1/3$' info third.off --exact
# On demand.
expect 0 '^solid      yes' info a.off --check
sed 's/^\(4\) \(.*\) \(.*\) \(.*\) \(.*\)$/\1 \5 \4 \3 \2/' a.off >inwards.off
expect 0 '^solid      no: .*inside out' info inwards.off --check
sed '$d' a.off | sed 's/^8 6/8 5/' >open.off
expect 0 '^solid      no: .*4 bad edges' info open.off --check
expect 0 '^surface    not closed: 4 bad edges' info open.off
# Several, and as JSON.
expect 0 '^file       b.off' info a.off b.off
expect 2 'none.off' info a.off none.off
box 12 21 32 15 22 33 | awk 'NR > 2 && NF == 5 {
  print $1, $2 + 8, $3 + 8, $4 + 8, $5 + 8; next } NR > 2' >through
{ echo OFF; echo '16 12 0'; sed -n '3,10p' a.off; head -8 through
  sed -n '11,$p' a.off; tail -6 through; } >crossed.off
"$program" info --json --check a.off two.off inwards.off open.off crossed.off \
  >all.json ||
  wrong 'info --json'
python3 - <<'PYTHON' || wrong 'the JSON is not as it should be'
import json
a, two, inwards, gap, crossed = json.load(open("all.json"))
assert a["volume"] == 24 and a["exact_volume"] == "24" and a["area"] == 52
assert a["from"] == [10, 20, 30] and a["to"] == [12, 23, 34]
assert a["size"] == [2, 3, 4]
assert a["closed"] and a["solid"] and "fault" not in a
assert [part["genus"] for part in two["components"]] == [1, 0]
assert [part["volume"] for part in two["components"]] == [72, 1]
assert not inwards["solid"] and "inside out" in inwards["fault"]
assert [part.get("code") for part in (a, two, inwards, gap, crossed)] == [
    None, None, "INSIDE_OUT", "OPEN", "SELF_CROSSING"]
assert [part.get("polygon") for part in (a, inwards, gap)] == [None, 0, 2]
assert crossed["polygon"] == 5 and "cross" in crossed["fault"]
PYTHON
# Exact files have units of which no double has the square or cube.
"$program" csg '"a.off"' --format hsolid-text -o - >a.txt
# in_unit UNIT: the box with steps of so much.
in_unit() {
  sed "s/^unit .*/unit $1/; s/^checksum .*/checksum -/" a.txt >units.hsolid
}
in_unit '10 300'
expect 0 '^volume     2.4e+901$' info units.hsolid
expect 0 '^area       5.2e+601$' info units.hsolid
expect 0 'volume 2.4e+901,' csg '"units.hsolid"' -o out.hsolid
expect 0 'volume 2.4e+901,' csg '"units.hsolid"' -o out.off
box 0 0 0 1e301 2e300 3e300 >far.off
for library in ref fast; do
  expect 0 'volume 6e+901,' csg '"far.off"' -o out.off --impl $library
done
expect 0 '"volume": null,' info --json units.hsolid
in_unit '10 -300'
expect 0 '^volume     2.4e-899$' info units.hsolid
expect 0 'volume 2.4e-899,' csg '"units.hsolid"' -o out.hsolid
in_unit '10 310'
expect 2 'units.hsolid: .* beyond the greatest double.* 10^310' info units.hsolid
expect 0 'volume 2.4e+931,' csg '"units.hsolid"' -o out.hsolid
expect 2 'out.stl: .* beyond the greatest double' csg '"units.hsolid"' -o out.stl
in_unit '10 -330'
expect 2 'units.hsolid: .* below the least double.* 10^-330' info units.hsolid
for exponent in 4096 -4096; do
  for base in 2 10; do
    in_unit "$base $exponent"
    expect 0 'closed, volume [1-9]' csg '"units.hsolid"' -o out.hsolid
    expect 0 'closed, volume [1-9]' csg '"out.hsolid"' -o again.hsolid
    same out.hsolid again.hsolid
  done
done
finish
