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
[ "$(sizes --candidates 1)" != "$(sizes)" ] || wrong "--candidates is not used"
[ "$(sizes --candidates 216)" = "$(sizes --heuristic fewest-cuts)" ] ||
  wrong "all candidates are not the fewest cuts"
expect 0 'moved 0 coordinates' build cubes.off
finish
