#!/usr/bin/env bash
# Builds everything and runs the whole test suite: optimised, then with
# assertions and sanitizers what can be afforded so; then the scripts that check
# the sources. The last line says whether all is well.
set -euo pipefail
cd "$(dirname "$0")"
. scripts/packages.sh

# Runs the rest of the line; its output is kept, and shown if it fails.
step() {
  local what=$1
  shift
  local begin=$SECONDS
  printf '%-44s ' "$what"
  if "$@" >"out/test.log" 2>&1; then
    local count
    count=$(sed -n 's/^100% tests passed.* out of \([0-9]*\)$/\1 tests, /p' \
      out/test.log)
    echo "ok ($count$((SECONDS - begin)) s)"
    return
  fi
  echo "FAILED"
  cat out/test.log >&2
  fail "$what: failed; what it printed stands above"
}

# Configures and builds a preset: everything, or the folders that are named.
build() {
  local preset=$1
  shift
  # The demo may have configured the same folder without tests.
  cmake --preset "$preset" -DBUILD_TESTING=ON &&
    cmake --build --preset "$preset" --target "${@:-all}"
}

need_build_packages
need_test_packages
install_needed

mkdir -p out
# Two runs need not wait for each other's tests, but must not starve either.
CTEST_PARALLEL_LEVEL=$(nproc)
export CTEST_PARALLEL_LEVEL
# The fuzz targets' corpora are replayed once, with sanitizers.
step "build, optimised" build release \
  {spec,ref,fast,io,csg,face,viewer}/test/all \
  {shadow,tools,proptest,examples,bench}/all
# Every law notes there what it has run.
laws_run=$PWD/out/laws.txt
rm -f "$laws_run"
step "all tests, optimised" env HALFSPACE_LAW_REPORT="$laws_run" \
  ctest --preset release --no-tests=error -LE fuzz
step "clauses, laws, functions" python3 tools/check_traceability.py \
  --laws build/release/proptest/proptest "$laws_run"
# What the tests with these labels need; building the laws takes longer. The
# reference is in the fuzz targets; its own tests look at values.
step "build, with sanitizers" build asan \
  {spec,fast,io,csg,face,viewer}/test/all proptest/faults/all fuzz/all \
  tools/all \
  examples/all
# Checking proofs keeps one core busy, and now and then a second one.
python3 tools/check_proofs.py >out/proofs.log 2>&1 &
proofs=$!
trap 'kill $proofs 2>/dev/null || true' EXIT
# Where memory came from is kept two calls deep: whole stacks take a tenth to a
# third of the time.
step "unit tests and fuzz corpus, with sanitizers" \
  env ASAN_OPTIONS="malloc_context_size=2:${ASAN_OPTIONS:-}" \
  LSAN_OPTIONS="suppressions=$PWD/cmake/leak_sanitizer.supp:print_suppressions=0" \
  ctest --preset asan --no-tests=error -L 'unit|fuzz'
proofs_checked() {
  local status=0
  wait $proofs || status=$?
  trap - EXIT
  cat out/proofs.log
  return $status
}
step "tools/check_proofs.py" proofs_checked
step "tools/mutate.py --stale" python3 tools/mutate.py --stale
for script in tools/check_laws.py tools/check_mirror.py tools/check_rooms.py \
  tools/test/check_rooms_test.py tools/test/check_traceability_test.py \
  tools/test/mutate_test.py tools/test/verify_test.py \
  tools/test/round_trips_test.py tools/test/chains_test.py \
  tools/test/check_proofs_test.py tools/check_oracle.py \
  tools/test/check_oracle_test.py; do
  step "$script" python3 "$script"
done
echo "All tests passed."
