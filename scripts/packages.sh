# Sourced by demo.sh and test.sh: Debian packages, and plain words on failure.
#
#   need PACKAGE "why"     notes a package that must be there
#   install_needed         installs those of them that dpkg does not have

missing=()
reasons=()

# The last sentence of a failed script.
fail() {
  echo "$(basename "$0"): $*" >&2
  exit 1
}

has_package() {
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

need() {
  has_package "$1" && return
  missing+=("$1")
  reasons+=("$2")
}

# Runs a command as root: directly, or through sudo.
as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    fail "needs root or sudo to install Debian packages: ${missing[*]}"
  fi
}

# Whether the package lists know every missing package.
lists_are_there() {
  local package
  for package in "${missing[@]}"; do
    [ -n "$(apt-cache policy "$package" 2>/dev/null |
        sed -n 's/^ *Candidate: *//p' | grep -v '^(none)$')" ] || return 1
  done
}

apt_install() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -y -q \
    -o Dpkg::Use-Pty=0 install --no-install-recommends "$@"
}

update_lists() {
  echo "Reading the package lists (apt-get update)."
  as_root apt-get -q update || fail "apt-get update failed"
}

install_needed() {
  [ ${#missing[@]} -gt 0 ] || return 0
  command -v apt-get >/dev/null ||
    fail "this is not Debian; please install: ${missing[*]}"
  echo "Debian packages to install:"
  local i
  for i in "${!missing[@]}"; do
    printf '  %-22s %s\n' "${missing[$i]}" "${reasons[$i]}"
  done
  local fresh=no
  if ! lists_are_there; then
    update_lists
    fresh=yes
  fi
  # Old lists can name versions that the mirror no longer has.
  if ! apt_install "${missing[@]}"; then
    [ "$fresh" = no ] || fail "apt-get could not install: ${missing[*]}"
    update_lists
    apt_install "${missing[@]}" ||
      fail "apt-get could not install: ${missing[*]}"
  fi
  missing=()
  reasons=()
}

# What building the libraries and the program takes.
need_build_packages() {
  need g++ "the C++ compiler"
  need cmake "the build system"
  need ninja-build "runs the build"
  need libboost-dev "exact numbers (Boost.Multiprecision, headers only)"
  need libgmp-dev "fast big integers below Boost's numbers"
  need libglm-dev "vectors for cameras"
  need libtbb-dev "threads (oneTBB)"
  need libpng-dev "writes PNG pictures"
  need zlib1g-dev "compression, for PNG"
  need libzip-dev "packages, for 3MF"
  need libexpat1-dev "XML, for 3MF"
  need libcli11-dev "command line of the program"
  need nlohmann-json3-dev "statistics as JSON"
  need libfmt-dev "messages of the program"
  need libstb-dev "draws the letters of legends"
  need fonts-dejavu-core "those letters"
  need libsdl2-dev "the window of the viewer"
  need libimgui-dev "the panels of the viewer"
  need pkg-config "finds both of them"
}

# What the package for Python takes, built as a wheel and installed.
need_python_packages() {
  need python3-dev "builds the package for Python"
  need pybind11-dev "binds the library to Python"
  need python3-pybind11 "the same, for pip"
  need python3-numpy "arrays of the package for Python"
  need python3-setuptools "builds its wheel"
  need python3-wheel "builds its wheel"
  need python3-venv "tests the wheel where nothing else is"
  need python3-pip "installs the wheel"
}

# What the tests take beside that.
need_test_packages() {
  need libgtest-dev "test framework"
  need librapidcheck-dev "random properties, shrunk when they fail"
  need lib3mf1 "judges the 3MF files that are written"
  need parallel "runs a farm's jobs"
  need libbenchmark-dev "measures booleans"
  need python3 "scripts that check the tree of sources"
  need coq "checks the proofs of spec/coq"
  need xvfb "a display for the viewer"
  need xdotool "a hand for the viewer"
  need make "compiles the proofs"
  need ocaml "compiles the oracle that the proofs are extracted to"
  need_python_packages
  need python3-pytest "tests of the package for Python"
  need python3-hypothesis "random properties of it"
  need python3-matplotlib "figures that the package makes right"
  need python3-meshio "meshes that the package takes"
  need mypy "checks the package's annotations"
}

# What the package for the web takes, where HALFSPACE_WEB is ON.
need_web_packages() {
  need clang-19 "compiles the package for the web"
  need lld-19 "links it"
  need xz-utils "packs it"
  need llvm-19 "its archives"
  need wasi-libc "the C library of WebAssembly"
  need libc++-19-dev-wasm32 "the C++ library of WebAssembly"
  need libc++abi-19-dev-wasm32 "the same"
  need libclang-rt-19-dev-wasm32 "128-bit integers of WebAssembly"
  command -v node >/dev/null || need nodejs "runs the package for the web"
  command -v npm >/dev/null || need npm "packs it"
  need binaryen "makes the module small"
  need chromium "shows its page"
}
