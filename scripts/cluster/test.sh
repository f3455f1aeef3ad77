#!/usr/bin/env bash
# Tests the farm on a real Slurm: four nodes on this machine, a film and a union
# of 5,000 parts, a node lost at a random time, --times TIMES of all that (one).
set -euo pipefail
cd "$(dirname "$0")/../.."
. scripts/packages.sh

need_build_packages
need slurm-wlm "runs the jobs of four nodes"
need slurm-wlm-basic-plugins "lets them talk without munge"
need parallel "runs a plan on one machine"
need snakemake "the same"
install_needed

cmake --preset release
cmake --build --preset release --target halfspace proptest
scripts/cluster/test/farm_test.py build/release/tools/halfspace \
  build/release/proptest/proptest
scripts/cluster/test/slurm_test.py build/release/tools/halfspace "$@"
