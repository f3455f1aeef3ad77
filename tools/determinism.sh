#!/usr/bin/env bash
# Builds proptest/determinism with many compilers, levels of optimisation and
# sanitizers, and with filters that are never sure, and compares what it prints
# with proptest/agree/determinism.txt and with one another.
#
#   tools/determinism.sh                    all compilers that are there
#   tools/determinism.sh g++-12 clang++-19  these
#   LEVELS="-O0 -O3" tools/determinism.sh   these levels, nothing else
#   SANITIZERS=thread tools/determinism.sh  g++ 12 with these, nothing else
#   UNSURE=-O0 tools/determinism.sh         filters never sure, nothing else
#
# Exit status: 0 the same bytes everywhere, 1 not.
set -euo pipefail
cd "$(dirname "$0")/.."
compilers=("$@")
if [ ${#compilers[@]} = 0 ]; then
  for compiler in g++-12 clang++-14 clang++-19; do
    command -v "$compiler" >/dev/null && compilers+=("$compiler")
  done
fi
if [ -z "${LEVELS+set}${SANITIZERS+set}${UNSURE+set}" ]; then
  LEVELS="-O0 -O1 -O2 -O3"
  SANITIZERS="address,undefined thread"
  UNSURE=-O2
fi
status=0
first=
# Whether the hashes are those of the first build, inner ones too.
as_the_first() {
  [ -n "$first" ] || first=$1
  cmp -s "$first" "$1"
}
# Filters that are never sure decide nothing, so there the inner hashes, which
# count who decided, are others.
any_inner() { true; }
compare=as_the_first
export TSAN_OPTIONS="suppressions=$PWD/cmake/thread_sanitizer.supp"
try() {
  local what=$1 folder=build/determinism/${1//[^a-zA-Z0-9]/_}
  shift
  if cmake -S . -B "$folder" -G Ninja -DHALFSPACE_WARNINGS_AS_ERRORS=OFF \
    "$@" >"$folder.log" 2>&1 &&
    cmake --build "$folder" --target determinism >>"$folder.log" 2>&1 &&
    "$folder/proptest/determinism" proptest/agree/determinism.txt \
      >>"$folder.log" 2>&1 &&
    "$folder/proptest/determinism" --all >"$folder.hashes" &&
    "$compare" "$folder.hashes"; then
    echo "same   $what"
  else
    echo "OTHER  $what: see $folder.log"
    status=1
  fi
}
mkdir -p build/determinism
for compiler in "${compilers[@]}"; do
  for level in ${LEVELS:-}; do
    try "$compiler $level" -DCMAKE_CXX_COMPILER="$compiler" \
      -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="$level"
  done
done
for sanitizers in ${SANITIZERS:-}; do
  try "g++-12 $sanitizers" -DCMAKE_CXX_COMPILER=g++-12 \
    -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O1 \
    -DHALFSPACE_SANITIZE="$sanitizers"
done
compare=any_inner
for level in ${UNSURE:-}; do
  try "${compilers[0]} $level, filters never sure" \
    -DCMAKE_CXX_COMPILER="${compilers[0]}" -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_FLAGS="$level" -DHALFSPACE_FILTERS_UNSURE=ON
done
exit $status
