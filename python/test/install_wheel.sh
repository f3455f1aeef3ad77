#!/usr/bin/env bash
# Builds the wheel and installs it in a fresh virtual environment, as users do.
#
#   install_wheel.sh PYTHON SOURCE WORK BUILD
#
# BUILD keeps what was compiled; WORK/venv is made anew, and sees the packages
# of the system, for nothing is downloaded.
set -euo pipefail
python=$1
source=$2
work=$3
build=$4

mkdir -p "$work"
rm -rf "$work/venv" "$work/wheel" "$work/source"
# What setuptools reads and writes beside: the sources' folder stays clean.
mkdir -p "$work/source/python"
for part in LICENSE pyproject.toml setup.py docs; do
  ln -s "$source/$part" "$work/source/$part"
done
cp -r "$source/python/halfspace" "$work/source/python/"
rm -f "$work"/source/python/halfspace/*.so
HALFSPACE_BUILD_DIR=$build "$python" -m pip wheel --no-build-isolation \
  --no-deps --no-index --wheel-dir "$work/wheel" "$work/source"
"$python" -m venv --system-site-packages "$work/venv"
"$work/venv/bin/pip" install --no-index --no-deps --quiet "$work"/wheel/*.whl
cd "$work"
"$work/venv/bin/python" -c 'import halfspace
print(halfspace.__version__, halfspace.__file__)'
