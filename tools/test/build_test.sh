#!/usr/bin/env bash
# Trees: every rule, the theorem of HEUR, and that seeds matter.
. "$(dirname "$0")/expect.sh"

# HEUR Theorem 1: n(n + 4) / 4 nodes, whatever the rule; here 12 * 16 / 4.
"$make_model" theorem1 --count 12 -o theorem1.scene || exit 1
for rule in first random fewest-cuts h1 h2 h3 h4 h5 h6; do
  expect 0 '^tree: 48 nodes' build theorem1.scene --heuristic $rule \
    --stats a.json
  [ "$(number a.json nodes)" = 48 ] || wrong "$rule: nodes in --stats"
  [ "$(number a.json polygons)" = 12 ] || wrong "$rule: polygons in --stats"
  fragments=$(number a.json fragments)
  [ "$(number a.json splits)" = $((fragments - 12)) ] || wrong "$rule: splits"
  [ "$(number a.json bytes)" -gt 1000 ] || wrong "$rule: bytes in --stats"
done

# The same seed gives the same tree, another seed another one; all candidates
# at once are the rule of the fewest cuts.
"$make_model" interlocking-cubes -o cubes.off || exit 1
sizes() {
  "$program" build cubes.off --stats - "$@" |
    grep -E '"(nodes|height|fragments)"'
}
[ "$(sizes --seed 3)" = "$(sizes --seed 3)" ] || wrong "one seed, two trees"
[ "$(sizes --seed 3)" != "$(sizes --seed 4)" ] || wrong "two seeds, one tree"
[ "$(sizes --candidates 1)" != "$(sizes --candidates 5)" ] || wrong "--candidates is not used"
[ "$(sizes --candidates 216)" = "$(sizes --heuristic fewest-cuts)" ] ||
  wrong "all candidates are not the fewest cuts"
expect 0 'moved 0 coordinates' build cubes.off
# The reference makes the same trees by the same rules.
for rule in first random h3; do
  [ "$(sizes --heuristic $rule)" = "$(sizes --heuristic $rule --impl ref)" ] ||
    wrong "$rule: fast and ref make different trees"
done
[ "$(sizes --impl ref)" = "$(sizes --heuristic random)" ] ||
  wrong "the reference's tree is not a random one"

# Without a rule fast makes a tree for display, the same with any threads.
expect 0 '^tree: ' build cubes.off --stats a.json --threads 1 -o one.tree
expect 0 '^tree: ' build cubes.off --stats b.json --threads 3 -o three.tree
same one.tree three.tree
grep -q '"heuristic": "display"' a.json || wrong "not a tree for display"
for name in bytes bytes_per_polygon bytes_per_fragment build_wall_ms; do
  [ -n "$(number a.json $name)" ] || wrong "no $name in --stats"
done
bytes=$(number a.json bytes)
polygons=$(number a.json bytes_per_polygon)
[ "${polygons%.*}" = $((bytes / 216)) ] || wrong "bytes_per_polygon"
[ "$polygons" != 0 ] && [ "${polygons%.*}" -lt 1000 ] ||
  wrong "$polygons bytes a polygon"

# A saved tree gives the same image, by span and by painter; other scenes', cut
# and spoilt ones are errors.
view=(--size 40x30 --eye 300,200,150)
expect 0 'span' render cubes.off "${view[@]}" --ids a.npy
expect 0 'painter' render cubes.off "${view[@]}" --ids p.npy --impl ref \
  --method painter
same a.npy p.npy
for method in span painter; do
  expect 0 'loaded in' render cubes.off "${view[@]}" --tree one.tree \
    --method $method --ids b.npy --stats b.json
  same a.npy b.npy
  expect 0 "$method" render cubes.off "${view[@]}" --method $method --ids b.npy
  same a.npy b.npy
done
grep -q '"heuristic": "loaded"' b.json || wrong "the tree was not loaded"
"$make_model" cube -o cube.off || exit 1
expect 2 'one.tree.*another scene' render cube.off --tree one.tree --ids b.npy
expect 2 'none.tree' render cubes.off --tree none.tree --ids b.npy
expect 2 'none/a.tree' build cubes.off -o none/a.tree
expect 2 'ref.*saves no trees' build cubes.off -o a.tree --impl ref
expect 2 'ref reads no trees' render cubes.off --tree one.tree --ids b.npy \
  --impl ref
expect 2 'zbuffer needs no tree' render cubes.off --tree one.tree --ids b.npy \
  --method zbuffer
head -c 1000 one.tree >cut.tree
expect 2 'cut.tree' render cubes.off --tree cut.tree --ids b.npy
expect 2 'cubes.off' render cubes.off --tree cubes.off --ids b.npy

# Someone who waits at a terminal is told how far it is; Ctrl-C ends it with
# one line, the usual status and no file. Triangles that cross everywhere take
# long enough.
awk -v count=120000 'BEGIN {
  srand(1)
  print "OFF\n" 3 * count, count, 0
  for (i = 0; i < 3 * count; ++i) {
    if (i % 3 == 0) { x = 900 * rand(); y = 900 * rand(); z = 900 * rand() }
    printf "%d %d %d\n", x + 500 * rand(), y + 500 * rand(), z + 500 * rand()
  }
  for (i = 0; i < count; ++i) print 3, 3 * i, 3 * i + 1, 3 * i + 2
}' >crossing.off
echo "echo \$\$ >pid
exec '$program' build crossing.off --threads 1 -o crossing.tree" >long.sh
script -q -e -f -c 'env --default-signal=INT sh long.sh' told >/dev/null &
job=$!
for _ in $(seq 600); do
  grep -qs 'halfspace: tree' told && break
  sleep 0.1
done
kill -INT "$(cat pid)"
wait $job
[ $? = 130 ] || wrong "interrupted: not status 130"
tr '\r' '\n' <told | grep >/dev/null '^halfspace: tree *[0-9]* %' ||
  wrong "nothing told: $(head -c 300 told)"
tr '\r' '\n' <told |
  grep -q '^halfspace: interrupted; no tree was made$' ||
  wrong "interrupted: $(head -c 300 told)"
[ ! -e crossing.tree ] || wrong "interrupted, and yet a tree"

# What a tree that cuts will take is said before it is made, where that is much.
awk 'BEGIN {
  count = 1000
  srand(1)
  print "OFF\n" 3 * count, count, 0
  for (i = 0; i < 3 * count; ++i)
    printf "%d %d %d\n", 1e6 * rand(), 1e6 * rand(), 1e6 * rand()
  for (i = 0; i < count; ++i) print 3, 3 * i, 3 * i + 1, 3 * i + 2
}' >across.off
echo "echo \$\$ >pid
exec '$program' build across.off --heuristic random" >long.sh
rm -f pid told  # or what the build before told would end the wait at once
script -q -e -f -c 'env --default-signal=INT sh long.sh' told >/dev/null &
job=$!
for _ in $(seq 600); do
  grep -qs 'halfspace: tree' told && break
  kill -0 $job 2>/dev/null || break
  sleep 0.1
done
kill -INT "$(cat pid)" 2>/dev/null
wait $job
grep -q 'of 1000 about [12].[0-9] million fragments are expected' told ||
  wrong "the cost of a tree is not told: $(head -c 300 told)"
"$make_model" sphere --count 40 -o sphere.off || exit 1
for how in '--heuristic random' ''; do
  script -q -e -c "'$program' build sphere.off $how" told >/dev/null ||
    wrong "build $how"
  ! grep -q expected told || wrong "a mesh's tree costs much: $how"
done
finish
