#!/usr/bin/env python3
"""Checks where files stand and what they include.

* A library includes those that LIBRARIES names beside it: ref/ and fast/ do not
  see each other, and spec/ sees neither.
* The rooms of fast/src, proptest/, io/src and tools/src stand in the lists of
  ROOMS, the first two in files of CMake. A room includes itself and the rooms above it. The lines of such a list
  after the first are wings, which do not include one another. The room of a
  public header is that of the source of its name; where there is none, the
  lowest in which it could be.
* What is in no include/ folder is included from its own library and by its
  tests alone, but for those that INSIDERS names.
* A CMakeLists.txt lists just the sources below it, down to other
  CMakeLists.txt; a header only if it lists headers.
* A test in fast/test/ROOM has the name of a source in fast/src/ROOM, and maybe
  its subject: FILE_test.cpp, FILE_SUBJECT_test.cpp.
* proptest/README.md has a line for each target of proptest/.
* No folder has more than 30 sources.

Exit status: 0 if all of that holds, else 1.
"""

import pathlib
import re
import sys

from file_lists import SOURCES, listed_in

# What each library includes of the others. Programs and tests include all.
LIBRARIES = {
    "spec": {"spec"},
    "ref": {"spec", "ref"},
    "fast": {"spec", "fast"},
    "io": {"spec", "io"},
    "shadow": {"spec", "ref", "fast", "shadow"},
    "csg": {"spec", "ref", "fast", "io", "csg"},
    "face": {"spec", "fast", "io", "csg", "face"},
    "viewer": {"spec", "fast", "io", "face", "viewer"},
}
PROGRAMS = ("tools", "proptest", "fuzz", "bench", "examples", "python")

# The rooms of folders: the file with their list, or the list.
ROOMS = {"fast/src": "fast/CMakeLists.txt",
         "proptest": "proptest/CMakeLists.txt",
         "io/src": ("base", "polygon", "mesh", "scene", "color", "view", "picture",
                    "figure"),
         "tools/src": ("cli", "image", "figure", "commands"),
         "viewer/src": ("core", "window")}

# Who looks inside a library that is not theirs, and why.
INSIDERS = {
    ("proptest/identities", "fast/src"):
        "how a surface is put together is looked at from inside",
    ("io/test", "spec/test"): "planes of the vocabulary's own tests",
}

# Includes that are still to be mended; one that is gone leaves this list.
WAITING = {
    ("fast/src/solid/solid.cpp", "halfspace/fast/predicate.hpp"),
}

MOST_FILES = 30
# Folders that are still to be divided.
LARGE = set()

INCLUDE = re.compile(r'^ *# *include +"([^"]+)"', re.M)


def files_in(root):
    """All sources and lists of files, in no folder of a build."""
    found = []
    for top in (*LIBRARIES, *PROGRAMS):
        for path in sorted((root / top).rglob("*")):
            if path.suffix in SOURCES or path.name == "CMakeLists.txt":
                found.append(path.relative_to(root))
    return found


def rooms_of(root, folder):
    """The rooms in order, each with its wing: 0 is seen by all wings."""
    if isinstance(ROOMS[folder], tuple):
        return {room: (place, 0) for place, room in enumerate(ROOMS[folder])}
    text = (root / ROOMS[folder]).read_text()
    listed = re.search(r"foreach\(room IN ITEMS\n(.*?)\)", text, re.S)
    if not listed:
        return {}
    return {room: (place, wing)
            for wing, line in enumerate(listed[1].splitlines())
            for place, room in enumerate(line.split(), 100 * wing)}


class Rooms:
    """The rooms of a folder, and which of them may include which."""

    def __init__(self, root, folder, files):
        self.folder = pathlib.PurePath(folder)
        self.rooms = rooms_of(root, folder)
        # The public headers' rooms.
        self.public = {}
        if not self.rooms:
            return
        sources = {path.stem: self.room(path) for path in files
                   if path.suffix == ".cpp" and self.room(path)}
        headers = [path for path in files if folder == "fast/src" and
                   path.is_relative_to("fast/include")]
        includes = {path: INCLUDE.findall((root / path).read_text())
                    for path in headers}
        names = {str(path.relative_to("fast/include")): path
                 for path in headers}

        def room_of(name):
            if name not in self.public:
                path = names[name]
                self.public[name] = sources.get(path.stem) or max(
                    (room_of(other) for other in includes[path]
                     if other in names), key=lambda room: self.rooms[room],
                    default=next(iter(self.rooms)))
            return self.public[name]

        for name in names:
            room_of(name)

    def room(self, path):
        if not path.is_relative_to(self.folder):
            return None
        parts = path.relative_to(self.folder).parts
        return parts[0] if len(parts) > 1 and parts[0] in self.rooms else None

    def may_include(self, room, other):
        place, wing = self.rooms[room]
        other_place, other_wing = self.rooms[other]
        return other_place <= place and other_wing in (0, wing)


def owner(path):
    """The library or the tests that a file belongs to."""
    parts = path.parts
    if parts[0] in LIBRARIES and parts[1] in ("include", "src"):
        return f"{parts[0]}/{parts[1]}"
    if parts[0] in LIBRARIES and parts[1] == "test":
        return f"{parts[0]}/test"
    return parts[0]


def find(root, path, name, known):
    """The file that an include means, of those that stand somewhere inside."""
    folders = [path.parent]
    if owner(path).split("/")[-1] in ("src", "include", "test"):
        folders += [pathlib.Path(path.parts[0], "test"),
                    pathlib.Path(path.parts[0], "src")]
    folders += [pathlib.Path(top) for top in
                (path.parts[0], "proptest", "fast/src", "spec/test",
                 "csg/src", "io/src", "tools/src", "examples/models")]
    for folder in folders:
        parts = []
        for part in (folder / name).parts:
            parts = parts[:-1] if part == ".." else parts + [part]
        if pathlib.Path(*parts) in known:
            return pathlib.Path(*parts)
    return None


def check_include(path, name, target, all_rooms, known):
    """What is wrong with an include of `target`, if it is a known file."""
    library = re.fullmatch(r"halfspace/(?:(\w+)/(?:\w+/)*)?\w+\.h(?:pp)?", name)
    if library:
        # Types have no folder of their own: the vocabulary's, and the face's.
        other = library[1] or next(
            (top for top in ("spec", "face")
             if pathlib.Path(top, "include", name) in known), None)
        if other is None:
            return "no such file"
        top = path.parts[0]
        if top in LIBRARIES and owner(path) != f"{top}/test" and \
                other not in LIBRARIES[top]:
            return f"{top}/ does not include {other}/"
        for rooms in all_rooms:
            room = rooms.room(path)
            if room and name in rooms.public and not rooms.may_include(
                    room, rooms.public[name]):
                return f"{room}/ does not include {rooms.public[name]}/"
        return None
    if target is None:
        return "no such file"
    for rooms in all_rooms:
        room, other = rooms.room(path), rooms.room(target)
        if room and other and not rooms.may_include(room, other):
            return f"{room}/ does not include {other}/"
    own, its = owner(path), owner(target)
    is_own = own == its or own.split("/")[0] == its.split("/")[0] and \
        own.endswith("/test")
    helpers = its in ("proptest", "examples") and own in PROGRAMS
    insiders = any(path.is_relative_to(who) and target.is_relative_to(whom)
                   for who, whom in INSIDERS)
    if not (is_own or helpers or insiders):
        return f"{own} does not look into {its}"
    return None


def check_includes(root, files):
    known = set(files)
    all_rooms = [Rooms(root, folder, files) for folder in ROOMS]
    waiting = set()
    wrong = [f"{ROOMS[folder]}: no list of rooms"
             for folder, rooms in zip(ROOMS, all_rooms) if not rooms.rooms]
    for path in files:
        if path.suffix not in SOURCES or "consumer" in path.parts:
            continue
        for name in INCLUDE.findall((root / path).read_text()):
            target = None if name.startswith("halfspace/") else find(
                root, path, name, known)
            said = check_include(path, name, target, all_rooms, known)
            if said and (str(path), name) in WAITING:
                waiting.add((str(path), name))
            elif said:
                wrong.append(f"{path}: includes {name}: {said}")
    return wrong + [f"{path} no longer includes {name}, for which it waits"
                    for path, name in sorted(WAITING - waiting)]


def check_lists(root, files):
    wrong = []
    lists = {path.parent: set() for path in files
             if path.name == "CMakeLists.txt"}
    for path in files:
        folder = next((above for above in path.parents if above in lists), None)
        if path.suffix in SOURCES and folder is not None:
            lists[folder].add(path.relative_to(folder))
    for folder, below in lists.items():
        listed = listed_in(root / folder, below)
        has_headers = any(path.suffix == ".hpp" for path in listed)
        wanted = {path for path in below if "include" not in path.parts and
                  (path.suffix == ".cpp" or
                   has_headers and path.suffix == ".hpp")}
        wrong += [f"{folder}/CMakeLists.txt: does not list {path}"
                  for path in sorted(wanted - listed)]
        wrong += [f"{folder}/CMakeLists.txt: lists {path}, which is not there"
                  for path in sorted(listed)
                  if not (root / folder / path).is_file()]
    return wrong


def check_folders(files):
    counts = {}
    for path in files:
        if path.suffix in SOURCES:
            counts[path.parent] = counts.get(path.parent, 0) + 1
    return [f"{folder}: {count} sources, more than {MOST_FILES}"
            for folder, count in sorted(counts.items())
            if (count > MOST_FILES) != (str(folder) in LARGE)]


def check_mirror(files):
    wrong = []
    for path in files:
        if not path.is_relative_to("fast/test") or \
                not path.name.endswith("_test.cpp"):
            continue
        folder = pathlib.Path("fast/src") / path.parent.relative_to("fast/test")
        words = path.stem.removesuffix("_test").split("_")
        if not any(folder / ("_".join(words[:count]) + end) in files
                   for count in range(1, len(words) + 1)
                   for end in (".cpp", ".hpp")):
            wrong.append(f"{path}: {folder} has no source of that name")
    return wrong


def check_targets(root, files):
    """README.md has a line for each target, and no other lines."""
    targets = set()
    for path in files:
        if path.name != "CMakeLists.txt" or path.parts[0] != "proptest":
            continue
        text = re.sub(r"#[^\n]*", "", (root / path).read_text())
        for name in re.findall(r"add_(?:executable|library)\((\S+)", text):
            if "${" not in name:
                targets.add(name)
                continue
            stems = re.search(r"foreach\(stem IN ITEMS([^)]*)\)", text)
            targets.update(re.sub(r"\$\{stem\}", stem, name)
                           for stem in stems[1].split())
    readme = root / "proptest/README.md"
    lines = set(re.findall(r"^\| `(\w+)` \|", readme.read_text(), re.M))
    return [f"proptest/README.md: no line for {name}"
            for name in sorted(targets - lines)] + \
        [f"proptest/README.md: there is no target {name}"
         for name in sorted(lines - targets)]


def check(root):
    files = files_in(root)
    return [*check_includes(root, files), *check_lists(root, files),
            *check_folders(files), *check_mirror(files),
            *check_targets(root, files)]


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    wrong = check(root)
    for line in wrong:
        print(line)
    print(f"{len(files_in(root))} files, {len(wrong)} faults")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
