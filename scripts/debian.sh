#!/usr/bin/env bash
# Builds the Debian packages of what is committed, into out/debian, and has
# lintian look at them. With --check they are built twice, which must give the
# same bytes.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh

need_build_packages
need dpkg-dev "builds packages"
need debhelper "the steps of that"
need dh-python "those of Python"
need pybuild-plugin-pyproject "the same"
need appstream "checks the description for software centres"
need lintian "looks for what packages have wrong"
need_python_packages
install_needed

version=$(dpkg-parsechangelog -S Version)
upstream=${version%-*}
out=$PWD/out/debian
# packages FOLDER: builds all of them there, from a source package.
packages() {
  local folder=$1
  rm -rf "$folder"
  mkdir -p "$folder/halfspace-$upstream"
  git archive --prefix="halfspace-$upstream/" HEAD -- . ':!debian' |
    gzip -n >"$folder/halfspace_$upstream.orig.tar.gz"
  git archive HEAD | tar -x -C "$folder/halfspace-$upstream"
  # A symbol that the list does not have is a fault here, like a lost one. The
  # system's own Python builds, whichever else a user has.
  (cd "$folder/halfspace-$upstream" && PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    DPKG_GENSYMBOLS_CHECK_LEVEL=4 \
    dpkg-buildpackage -us -uc -j"$(nproc)") >"$folder/build.log" 2>&1 || {
    tail -40 "$folder/build.log" >&2
    fail "the packages cannot be built; all of it stands in $folder/build.log"
  }
  rm -rf "$folder/halfspace-$upstream"
}

packages "$out"
# A first upload closes a bug only in Debian's own archive.
lintian --fail-on warning --suppress-tags initial-upload-closes-no-bugs \
  "$out"/*.changes
if [ "${1:-}" = --check ]; then
  packages "$out/again"
  for package in "$out"/*.deb; do
    cmp "$package" "$out/again/$(basename "$package")" ||
      fail "$(basename "$package"): a second build gives other bytes"
  done
  rm -r "$out/again"
  echo "A second build gives the same bytes."
fi
# What they consist of.
scripts/sbom.py "$out"
ls "$out"/*.deb
