#!/usr/bin/env bash
# Builds everything and runs the whole test suite.
set -euo pipefail
cd "$(dirname "$0")"
cmake --preset release
cmake --build --preset release
ctest --preset release
