#!/usr/bin/env bash
# Builds the package for the web and its page into out/web, and runs all its
# tests: in node, and in a headless Chromium. test.sh leaves them out, for the
# module is a build of its own.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh

need_build_packages
need_test_packages
need_web_packages
install_needed

# A folder of its own, whose cache knows what test.sh does not ask for.
build=build/web
cmake --preset release -B "$build" -DBUILD_TESTING=ON -DHALFSPACE_WEB=ON \
  -DHALFSPACE_PYTHON=OFF
cmake --build "$build" --target halfspace halfspace_web_agree
ctest --test-dir "$build" -L web --no-tests=error --output-on-failure
mkdir -p out/web
cp -r "$build"/web/made/. out/web/
echo "out/web/package is what npm packs, out/web/halfspace.html the page."
