#!/usr/bin/env bash
# Runs a fuzz target for a number of executions and prints its row for
# docs/assurance.md.
#
#   tools/campaign.sh TARGET EXECUTIONS [SEED [OPTION...]]
#   tools/campaign.sh fuzz_split 1000000 7
#   tools/campaign.sh fuzz_agree_image 1000000 7 -max_len=80
#
# The options are libFuzzer's. Short inputs are small scenes, tried more often.
# Needs clang: the preset `campaign` is optimised, with assertions and without
# sanitizers. Begins with fuzz/corpus; what it finds of its own goes to
# out/campaign/TARGET, a failure's input beside it; two runs of one target at a
# time need a folder each, HALFSPACE_CAMPAIGN_FOLDER.
set -euo pipefail
cd "$(dirname "$0")/.."

target=$1 executions=$2 seed=${3:-1}
options=("${@:4}")
corpus=fuzz/corpus/${target#fuzz_}
program=build/campaign/fuzz/$target
found=${HALFSPACE_CAMPAIGN_FOLDER:-out/campaign}/$target

[ -n "${HALFSPACE_CAMPAIGN_PROGRAM:-}" ] && program=$HALFSPACE_CAMPAIGN_PROGRAM
if [ ! -x "$program" ]; then
  cmake --preset campaign >/dev/null
  cmake --build --preset campaign --target "$target" >/dev/null
fi
mkdir -p "$found"
# Files that a target writes need no disk.
[ -d /dev/shm ] && export TMPDIR=/dev/shm
dictionary=()
[ -f "fuzz/dictionaries/${target#fuzz_}.dict" ] &&
  dictionary=("-dict=fuzz/dictionaries/${target#fuzz_}.dict")
# Its schedule by rare features takes half the time and more.
begin=$SECONDS
status=0
"$program" -runs="$executions" -seed="$seed" -print_final_stats=1 -entropic=0 \
  -artifact_prefix="$found-" "${dictionary[@]}" "${options[@]}" \
  "$found" "$corpus" \
  >"$found.log" 2>&1 || status=$?
ran=$(sed -n 's/^stat::number_of_executed_units: *//p' "$found.log")
result="no failure"
[ $status -eq 0 ] || result="FAILED: see $found.log"
named="seed $seed${options[*]:+, ${options[*]}}"
echo "| \`$target\` | ${ran:-?} ($named) | $((SECONDS - begin)) |" \
  "\`$(git rev-parse --short HEAD)\` | $result |"
exit $status
