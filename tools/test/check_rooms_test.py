#!/usr/bin/env python3
"""Plants faults in a copy of the sources, and sees check_rooms.py find each."""

import pathlib
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import check_rooms  # noqa: E402

# What is planted, in which file, what is put at its end (or, for a pair, in
# place of what), and what the check says of it.
PLANTED = [
    ("nothing", "fast/src/box/bvh.cpp", "", None),
    ("a room above that includes one below", "fast/src/box/bvh.cpp",
     '#include "table/geometry_table.hpp"\n', "box/ does not include table/"),
    ("a wing in the other", "fast/src/sah/axis_split.cpp",
     '#include "solid/loops.hpp"\n', "sah/ does not include solid/"),
    ("the other wing in this one", "fast/src/boolean/boolean.cpp",
     '#include "raster/culler.hpp"\n', "boolean/ does not include raster/"),
    ("a public header of the other wing", "fast/src/table/points.cpp",
     '#include "halfspace/fast/render.hpp"\n',
     "table/ does not include raster/"),
    ("fast/ in ref/", "ref/src/split.cpp",
     '#include "halfspace/fast/split.hpp"\n', "ref/ does not include fast/"),
    ("ref/ in fast/", "fast/include/halfspace/fast/split.hpp",
     '#include "halfspace/ref/split.hpp"\n', "fast/ does not include ref/"),
    ("ref/ in spec/", "spec/src/scene.cpp",
     '#include "halfspace/ref/split.hpp"\n', "spec/ does not include ref/"),
    ("fast/ in io/", "io/src/text.cpp",
     '#include "halfspace/fast/solid.hpp"\n', "io/ does not include fast/"),
    ("csg/ in shadow/", "shadow/src/check.cpp",
     '#include "halfspace/csg/plan.hpp"\n', "shadow/ does not include csg/"),
    ("face/ in fast/", "fast/src/solid/loops.cpp",
     '#include "halfspace/halfspace.hpp"\n', "fast/ does not include face/"),
    ("a type that is not there", "spec/src/scene.cpp",
     '#include "halfspace/nothing.hpp"\n', "no such file"),
    ("the inside of a library", "csg/src/plan.cpp",
     '#include "box/bvh.hpp"\n', "csg/src does not look into fast/src"),
    ("the inside of a library in a test", "io/test/text_test.cpp",
     '#include "box/bvh.hpp"\n', "io/test does not look into fast/src"),
    ("a header that is not there", "fast/src/box/bvh.cpp",
     '#include "box/tree.hpp"\n', "no such file"),
    ("laws in a generator", "proptest/generate/soups.cpp",
     '#include "laws/law.hpp"\n', "generate/ does not include laws/"),
    ("laws in the vectors", "proptest/vectors/vectors_test.cpp",
     '#include "laws/law.hpp"\n', "vectors/ does not include laws/"),
    ("a source that is not listed", "fast/src/box/other.cpp", "\n",
     "does not list other.cpp"),
    ("a header that is not listed", "fast/src/box/other.hpp", "\n",
     "does not list other.hpp"),
    ("a source that is listed only", "fast/src/box/CMakeLists.txt",
     ("bvh.cpp", "bvh.cpp old.cpp"), "lists old.cpp, which is not there"),
    ("a program that is not listed", "proptest/agree/other_test.cpp", "\n",
     "does not list other_test.cpp"),
    ("a test of no source", "fast/test/box/other_test.cpp", "\n",
     "fast/src/box has no source of that name"),
    ("a target without a line", "proptest/README.md",
     ("| `vectors_test` |", "| vectors |"), "no line for vectors_test"),
    ("a line without a target", "proptest/README.md",
     ("| `vectors_test` |", "| `vectors` |"), "there is no target vectors"),
    ("no list of rooms", "fast/CMakeLists.txt",
     ("foreach(room", "foreach(space"), "no list of rooms"),
]


def faults_with(place, name, planted):
    """What the check says with one plant, which is then taken out."""
    path = place / name
    text = path.read_text() if path.exists() else None
    if isinstance(planted, tuple):
        if planted[0] not in text:
            return [f"{name} does not hold {planted[0]!r}"]
        path.write_text(text.replace(*planted, 1))
    else:
        path.write_text((text or "") + planted)
    faults = check_rooms.check(place)
    if text is None:
        path.unlink()
    else:
        path.write_text(text)
    return faults


def full_folder(place):
    """What the check says of a folder with one source too many."""
    for number in range(check_rooms.MOST_FILES + 1):
        (place / f"fuzz/more_{number}.cpp").touch()
    return check_rooms.check(place)


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        for name in check_rooms.files_in(ROOT):
            (place / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, place / name)
        shutil.copy(ROOT / "proptest/README.md", place / "proptest")
        plants = [(what, expected, faults_with(place, name, planted))
                  for what, name, planted, expected in PLANTED]
        plants.append(("a full folder", "more than 30", full_folder(place)))
        for what, expected, faults in plants:
            good = (not faults if expected is None else
                    any(expected in fault for fault in faults))
            failures += not good
            print(f"{what}: {'ok' if good else f'not found in {faults}'}")
    print(f"{len(plants)} plants, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
