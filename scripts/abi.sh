#!/usr/bin/env bash
# Says whether the ABI of the shared library has changed since the last release:
# compares the packages that scripts/debian.sh has built in out/debian with the
# record of that release in face/.
#
#   scripts/abi.sh           exit status 1 if anything has changed
#   scripts/abi.sh --write   makes the record, and the symbols file, of this
#                            build: when it is released
#
# The record has the types and functions of the interface as abidw sees them in
# the library's debugging information.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh

need abigail-tools "compares interfaces"
need xz-utils "packs the record"
install_needed

out=$PWD/out/debian
package=$(sed -n 's/^Package: \(libhalfspace[0-9.]*\)$/\1/p' debian/control)
record=face/$package.abi.xz
version=$(dpkg-parsechangelog -S Version)
built=$(echo "$out/${package}_$version"_*.deb)
[ -e "$built" ] || fail "there is no $built; first: scripts/debian.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for part in "$package" "$package-dbgsym" libhalfspace-dev; do
  dpkg-deb -x "$out/${part}_$version"_*.deb "$folder"
done
library=$(echo "$folder"/usr/lib/*/libhalfspace.so.?*.?*.?*)
abidw --exported-interfaces-only \
  --debug-info-dir "$folder/usr/lib/debug" \
  --headers-dir "$folder/usr/include/halfspace" --drop-private-types \
  --no-corpus-path --no-comp-dir-path --type-id-style hash \
  --out-file "$folder/now.abi" "$library"

# symbols: the lines of debian/*.symbols, by the names that C++ has for them.
symbols() {
  echo "libhalfspace.so.${package#libhalfspace} $package #MINVER#"
  echo "* Build-Depends-Package: libhalfspace-dev"
  nm -D --defined-only "$library" | sed 's/^[0-9a-f]* . //' | c++filt |
    sed -e "/^halfspace_[a-z_0-9]*$/{s/.*/ &@Base ${version%-*}/;t}" \
      -e "s/.*/ (c++)\"&@Base\" ${version%-*}/" | LC_ALL=C sort -u
}

if [ "${1:-}" = --write ]; then
  xz -9c "$folder/now.abi" >"$record"
  symbols >"debian/$package.symbols"
  echo "$record and debian/$package.symbols are those of $(basename "$built")."
  exit 0
fi
xz -dc "$record" >"$folder/before.abi" || fail "there is no record; --write"
status=0
abidiff --no-show-locs "$folder/before.abi" "$folder/now.abi" \
  >"$folder/said" || status=$?
# Of the bits of the exit status, 8 means: what was built before cannot go on.
if ((status & 3)); then
  cat "$folder/said" >&2
  fail "abidiff failed"
elif ((status & 8)); then
  cat "$folder/said"
  fail "the ABI has changed and is not compatible: the next release needs" \
    "another minor version, and with it another package name"
elif ((status & 4)); then
  cat "$folder/said"
  fail "the ABI has changed: see whether programs that were built before go on"
fi
echo "The ABI is that of the last release."
