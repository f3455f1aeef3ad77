#!/usr/bin/env bash
# Builds the module by the preset `wasm`, and the package and the page of it.
#
#   build.sh SOURCE BUILD_DIR OUT_DIR
#
# OUT_DIR/package is what npm packs, OUT_DIR/halfspace.html the page.
set -euo pipefail
source=$1
build=$2
out=$3

# What is in the environment is meant for the native compiler.
unset CXX CXXFLAGS LDFLAGS
cmake --preset wasm -S "$source" -B "$build" \
  -DCMAKE_CXX_COMPILER_LAUNCHER="${CMAKE_CXX_COMPILER_LAUNCHER:-}"
cmake --build "$build" --target halfspace_web halfspace_web_agree
node "$source/web/build.mjs" "$source/web" "$build/web/halfspace.wasm" "$out"
