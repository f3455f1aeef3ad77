#!/usr/bin/env bash
# Coverage of the core by the tests: lines, branches and MC/DC, by clang 19
# (Debian: clang-19 llvm-19 libclang-rt-19-dev).
#
#   tools/coverage.sh                   ref/ and the core of fast/, by all tests
#   tools/coverage.sh vectors_test      by these tests only
#   tools/coverage.sh --html FOLDER     and annotated sources into a folder
#
# Prints the table of docs/coverage.md.
set -euo pipefail
cd "$(dirname "$0")/.."
html=
if [ "${1:-}" = --html ]; then
  html=$2
  shift 2
fi
tests=("$@")
[ ${#tests[@]} -gt 0 ] || tests=(vectors_test exhaustive_test ref_test
  fast_test agree_tree_test agree_image_test agree_boolean_test proptest)
build=build/coverage
flags="-O1 -fprofile-instr-generate -fcoverage-mapping -fcoverage-mcdc"
cmake -S . -B $build -G Ninja -DCMAKE_CXX_COMPILER=clang++-19 \
  -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="$flags" \
  -DHALFSPACE_WARNINGS_AS_ERRORS=OFF -DHALFSPACE_BENCH=OFF >$build.log
cmake --build $build --target "${tests[@]}" >>$build.log
rm -f $build/*.profraw
objects=()
for test in "${tests[@]}"; do
  program=$(find $build -type f -name "$test" -perm -u+x | head -1)
  LLVM_PROFILE_FILE=$build/$test.profraw "$program" >>$build.log
  objects+=(-object "$program")
done
llvm-profdata-19 merge -o $build/all.profdata $build/*.profraw
sources=(ref/src ref/include fast/src/merge.cpp fast/src/split.cpp
  fast/src/geometry.cpp fast/src/predicate.cpp fast/src/splitter.cpp
  fast/src/traverse.cpp fast/src/insert.cpp fast/src/build.cpp
  fast/src/tree_builder.cpp fast/src/root_rule.hpp)
llvm-cov-19 report "${objects[@]}" -instr-profile=$build/all.profdata \
  --show-mcdc-summary --show-branch-summary --show-region-summary=false \
  --show-instantiation-summary=false "${sources[@]}"
if [ -n "$html" ]; then
  llvm-cov-19 show "${objects[@]}" -instr-profile=$build/all.profdata \
    --show-mcdc --show-branches=count --format=html -output-dir="$html" \
    "${sources[@]}"
fi
