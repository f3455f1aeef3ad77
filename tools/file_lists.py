"""The sources that each CMakeLists.txt lists, for the scripts beside this."""

import pathlib
import re

SOURCES = (".cpp", ".hpp", ".h", ".inc")


def listed_in(folder, below=()):
    """The files that the CMakeLists.txt of a folder lists, as paths from there.

    ${stem}_test.cpp lists those of `below` for which there is such a word.
    """
    text = re.sub(r"#[^\n]*|\b(message|file)\([^)]*\)", "",
                  (folder / "CMakeLists.txt").read_text())
    words = set(re.findall(r"[^\s()\"]+", text))
    made = re.findall(r"OUTPUT (\S+)", text)
    words -= {*made, *("${CMAKE_CURRENT_BINARY_DIR}/" + name for name in made)}
    listed = set()
    for word in words:
        if not word.endswith(SOURCES) or \
                word.startswith("$") and "/" in word.split("}")[-1]:
            continue
        if "$" not in word:
            listed.add(pathlib.Path(word))
            continue
        shape = re.compile(re.sub(r"\\\$\\\{\w+\\\}", "(.+)",
                                  re.escape(word)))
        for path in below:
            match = shape.fullmatch(str(path))
            if match and match[1] in words:
                listed.add(path)
    return listed


def sources_of(root, library):
    """The .cpp files of a library in all its lists, in order, from the root."""
    found = []
    for path in sorted((root / library).rglob("CMakeLists.txt")):
        folder = path.parent
        if "test" in folder.relative_to(root).parts:
            continue
        found += [folder / name for name in sorted(listed_in(folder))
                  if name.suffix == ".cpp"]
    return [str(path.relative_to(root)) for path in found]
