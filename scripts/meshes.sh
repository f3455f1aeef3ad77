# Sourced by demo.sh: real meshes, from Debian's package libcgal-demo (CC0).
#
#   need_meshes NAME...    puts data/meshes/NAME of the package in out/models/

# Fetches the package's file and takes the archive of meshes out of it. Nothing
# is installed: the package depends on a whole geometry library.
fetch_archive() {
  missing=(libcgal-demo)
  lists_are_there || update_lists
  missing=()
  echo "Fetching meshes: the package libcgal-demo, which is not installed."
  mkdir -p out/package
  (cd out/package && apt-get -q -o APT::Sandbox::User=root download \
    libcgal-demo >/dev/null) ||
    fail "apt-get could not download libcgal-demo"
  dpkg-deb --fsys-tarfile out/package/libcgal-demo_*.deb |
    tar -x -C out/package --strip-components=5 --wildcards '*/data.tar.gz' ||
    fail "libcgal-demo has no data.tar.gz"
  rm out/package/libcgal-demo_*.deb
}

need_meshes() {
  local name
  local archive=out/package/data.tar.gz
  local absent=()
  for name in "$@"; do
    [ -s "out/models/$name" ] || absent+=("data/meshes/$name")
  done
  [ ${#absent[@]} -gt 0 ] || return 0
  [ -s "$archive" ] || fetch_archive
  mkdir -p out/models
  tar -x -z -f "$archive" -C out/models --strip-components=2 "${absent[@]}" ||
    fail "$archive does not hold ${absent[*]}"
}
