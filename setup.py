"""Builds the extension module of the Python package by CMake.

HALFSPACE_BUILD_DIR names a folder that is kept, so that what was compiled is
not compiled again. It may be one that CMake configured before, with position
independent code, such as that of the preset "release". Where that makes a
shared library (HALFSPACE_SHARED), the module needs it, as that of Debian does.
"""
import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        target = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve()
        build = pathlib.Path(os.environ.get(
            "HALFSPACE_BUILD_DIR", ROOT / self.build_temp)).resolve()
        if not (build / "CMakeCache.txt").exists():
            _configure(build)
        subprocess.run(["cmake", "--build", build, "--target",
                        "halfspace_python", "--parallel",
                        str(os.cpu_count() or 1)], check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(build / "python" / target.name), str(target))


def _configure(build):
    generator = ["-G", "Ninja"] if _has("ninja") else []
    subprocess.run(
        ["cmake", "-S", ROOT, "-B", build, *generator,
         "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
         "-DCMAKE_UNITY_BUILD_BATCH_SIZE=10", "-DBUILD_TESTING=OFF",
         "-DHALFSPACE_BENCH=OFF", "-DHALFSPACE_PYTHON=ON",
         "-DHALFSPACE_WARNINGS_AS_ERRORS=OFF",
         f"-DHALFSPACE_PYTHON_EXECUTABLE={sys.executable}"], check=True)


def _has(program):
    try:
        return subprocess.run([program, "--version"],
                              stdout=subprocess.DEVNULL).returncode == 0
    except OSError:
        return False


def _version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(halfspace VERSION (\S+)", text)[1]


setup(version=_version(),
      ext_modules=[Extension("halfspace._core", sources=[])],
      cmdclass={"build_ext": CMakeBuild})
