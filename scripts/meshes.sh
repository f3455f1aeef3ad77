# Sourced by demo.sh: real meshes, from Debian's package libcgal-demo (CC0).
#
#   need_meshes NAME...    puts data/meshes/NAME of the package in out/models/

# The archive of meshes, as installed; empty where there is none.
mesh_archive() {
  local path
  path=$(dpkg -L libcgal-demo 2>/dev/null | grep '/data\.tar\.gz$' || true)
  [ -f "$path" ] && echo "$path"
  # Small images of Debian leave out what is below /usr/share/doc.
  [ -f out/package/data.tar.gz ] && echo out/package/data.tar.gz
  return 0
}

# The archive out of the package's file, where installing it left it out.
unpack_package() {
  echo "Fetching libcgal-demo again: documentation is not installed here."
  mkdir -p out/package
  (cd out/package && apt-get -q download libcgal-demo >/dev/null) &&
    dpkg-deb --fsys-tarfile out/package/libcgal-demo_*.deb |
    tar -x -C out/package --strip-components=5 --wildcards '*/data.tar.gz'
}

need_meshes() {
  local name archive
  local absent=()
  for name in "$@"; do
    [ -s "out/models/$name" ] || absent+=("data/meshes/$name")
  done
  [ ${#absent[@]} -gt 0 ] || return 0
  archive=$(mesh_archive | head -n 1)
  if [ -z "$archive" ]; then
    need libcgal-demo "real meshes to render (CC0)"
    install_needed
    archive=$(mesh_archive | head -n 1)
  fi
  if [ -z "$archive" ]; then
    unpack_package || fail "libcgal-demo has no data.tar.gz"
    archive=out/package/data.tar.gz
  fi
  mkdir -p out/models
  tar -x -z -f "$archive" -C out/models --strip-components=2 "${absent[@]}" ||
    fail "$archive does not hold ${absent[*]}"
}
