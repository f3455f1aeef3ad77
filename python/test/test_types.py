"""The annotations: mypy --strict, and the stubs against the module."""
import pathlib
import subprocess
import sys

import halfspace

PACKAGE = pathlib.Path(halfspace.__file__).parent
ROOT = pathlib.Path(__file__).parents[2]


def run(*arguments):
    done = subprocess.run([sys.executable, "-m", *arguments], text=True,
                          capture_output=True, cwd=PACKAGE.parent)
    assert done.returncode == 0, done.stdout + done.stderr


def test_mypy_finds_nothing():
    assert (PACKAGE / "py.typed").is_file()
    run("mypy", "--strict", "--config-file", str(ROOT / "pyproject.toml"),
        "-p", "halfspace", "--cache-dir", "/dev/null")


def test_the_stubs_are_those_of_the_module():
    run("mypy.stubtest", "halfspace._core", "--allowlist",
        str(pathlib.Path(__file__).with_name("stubtest_allowlist.txt")),
        "--mypy-config-file", str(ROOT / "pyproject.toml"))
