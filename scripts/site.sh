#!/usr/bin/env bash
# Builds the site into out/site/html: installs what it takes, builds the program
# and the package for Python, runs every block of the pages for their pictures.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh

need_build_packages
need_python_packages
need python3-matplotlib "figures of the site"
need mkdocs "makes pages of text"
need mkdocs-material "how they look"
need doxygen "the pages of the C++ headers"
need chromium "looks whether the search works"
need python3-pil "puts pictures beside each other"
install_needed

cmake --preset release -DBUILD_TESTING=ON \
  -DHALFSPACE_PYTHON_EXECUTABLE=/usr/bin/python3
cmake --build --preset release --target halfspace make_model
python=$PWD/out/site-python
/usr/bin/python3 -m venv --clear --system-site-packages "$python"
# The module takes the libraries that are built already.
HALFSPACE_BUILD_DIR=$PWD/build/release "$python/bin/pip" install -q \
  --no-build-isolation .
/usr/bin/python3 docs/site/build.py build/release/tools/halfspace \
  build/release/examples/make_model out/site --python "$python/bin/python3"
