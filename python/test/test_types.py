"""The annotations: mypy --strict, and the stubs against the module; and the
names, which are those of the C++ headers."""
import inspect
import pathlib
import re
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


# Names of the headers that have another form here.
ELSEWHERE = {
    "Display": {"scene", "camera", "polygons_of_scene"},  # for fast/ and spec/
    "Figure": {"regions"},  # itself, a sequence
    "LineDrawing": {"lines"},  # its arrays
    "Mesh": {"polygon_count", "corners_of", "fields_at", "add", "field_count"},
    "MovingPicture": {"polygons"},  # ids
    "Picture": {"polygons"},
    "SeenPolygon": {"source"},
}


def declared():
    """By class or struct of the face its public names."""
    found = {}
    for header in sorted((ROOT / "face/include/halfspace").glob("*.hpp")):
        text = re.sub(r"//.*", "", header.read_text(encoding="utf-8"))
        for kind, name, body in re.findall(
                r"^(class|struct) (?:HALFSPACE_API )?(\w+) \{\n(.*?)^\};",
                text, re.M | re.S):
            body = body.split(" private:")[0]
            # What functions are made of is two levels deep.
            body = re.sub(r"\{[^{}]*\}", "", re.sub(r"\{[^{}]*\}", "", body))
            names = set(re.findall(r"\b([a-z]\w*)\(", body)) | set(
                re.findall(r"\b([a-z]\w*)(?: = [^;()]*)?;", body))
            found[name] = names
    return found


def test_the_names_are_those_of_the_headers():
    of_cpp = {"const", "default", "noexcept"}
    headers = declared()
    assert len(headers) > 20 and "decompose" in headers["Solid"]
    compared = 0
    for name, names in headers.items():
        ours = getattr(halfspace, name, None) or getattr(
            halfspace, name + "s", None)
        if ours is None:
            continue
        known = {*dir(ours), *getattr(ours, "_fields", ()),
                 *getattr(ours, "__dataclass_fields__", ())}
        for one in names - of_cpp - ELSEWHERE.get(name, set()):
            assert one in known or one + "s" in known, (name, one)
            compared += 1
    assert compared > 120
    for name, function in {
            "OperandOptions": halfspace.Solid.from_mesh,
            "MeshOptions": halfspace.Solid.mesh,
            "WorkOptions": halfspace.Solid.evaluate,
            "MendOptions": halfspace.mended}.items():
        parameters = inspect.signature(function).parameters
        assert headers[name] and headers[name] <= set(parameters), name
