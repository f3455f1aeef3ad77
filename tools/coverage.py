#!/usr/bin/python3
"""Measures what the tests reach in ref/ and the core of fast/, by clang 19.

  tools/coverage.py                     all of it, into out/coverage.md
  tools/coverage.py --tests ref_test,vectors_test     by these tests only
  tools/coverage.py --no-build          by what build/coverage holds
  tools/coverage.py --no-run            by what was noted last
  tools/coverage.py --print             to the terminal

Lines, branches (every outcome of every condition) and MC/DC (every condition
seen to decide by itself). What cannot happen is marked in the source, on the
line or above it, with the reason up to the next line without a comment:

  // Never true: a polygon has an area.
  // Never false: ...        the condition's other outcome
  // Never alone: ...        the condition decides nothing by itself (MC/DC)
  // Never reached: ...      the lines up to one that is reached

A mark where nothing is missing is an error. What HALFSPACE_ASSERT stops is the
caller's mistake, and a switch over all enumerators has no other value: neither
needs a mark. Needs Debian's clang-19, llvm-19, libclang-rt-19-dev.

Exit status: 0 nothing is missing, 1 something is, 2 a mark is wrong.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys

from mutate import suites_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
FLAGS = ("-O1 -fprofile-instr-generate -fcoverage-mapping -fcoverage-mcdc "
         "-fprofile-update=atomic")  # or threads lose counts
# Programs, and those of their tests that are about these files.
TESTS = {
    "ref_test": "*", "vectors_test": "*Implementations*",
    "exhaustive_test": "*", "agree_tree_test": "*", "agree_image_test": "*",
    "agree_display_tree_test": "*", "agree_boolean_test": "*",
    "fast_test": suites_of("tree", "table", "solid", "intersect", "boolean") +
                 ":DynamicScreen*:FastRender*:DisplayTree.O*:DisplayTree.L*"
                 "-*ManyPairs*",
}
SOURCES = {
    "The reference": ["ref/src", "ref/include"],
    "The core of the fast library": [
        f"fast/src/{name}" for name in (
            "raster/dynamic_screen.cpp",
            "raster/kernel/generic/coverage_merge.hpp",
            "exact/filter.hpp", "exact/exact_plane.hpp", "tree/split.cpp",
            "tree/split_walk.hpp", "tree/scene_planes.cpp",
            "tree/scene_planes.hpp", "tree/predicate.cpp", "tree/splitter.cpp",
            "tree/choose_root.hpp", "tree/build.cpp",
            "tree/fragment_splitter.cpp", "tree/fragment_splitter.hpp",
            "tree/insert.cpp", "tree/traverse.cpp", "tree/traversal.hpp",
            "intersect/candidates.cpp", "intersect/candidates.hpp",
            "boolean/membership.hpp", "boolean/emit.cpp",
            "boolean/assemble.cpp", "solid/loops.cpp")],
}
# Those of which MC/DC is asked: merging, sides, classes, traversal.
DECISIONS = re.compile(
    r"/(screen|dynamic_screen|coverage_merge|predicate|scene_planes|filter"
    r"|classify|traverse|traversal|split_walk|split|membership|candidates|emit"
    r"|assemble)\.")
MARK = re.compile(r"// Never (true|false|alone|reached): (.*)")


def run(command, **more):
    return subprocess.run(list(map(str, command)), check=True, cwd=ROOT,
                          **more)


def build(folder, tests):
    run(["cmake", "-S", ".", "-B", folder, "-G", "Ninja",
         "-DCMAKE_CXX_COMPILER=clang++-19", "-DCMAKE_BUILD_TYPE=None",
         f"-DCMAKE_CXX_FLAGS={FLAGS}", "-DHALFSPACE_WARNINGS_AS_ERRORS=OFF",
         "-DHALFSPACE_BENCH=OFF"], stdout=subprocess.DEVNULL)
    run(["cmake", "--build", folder, "--target", *tests],
        stdout=subprocess.DEVNULL)


def programs_of(folder, tests):
    found = {}
    for test in tests:
        found[test] = next(path for path in folder.rglob(test)
                           if path.is_file())
    return found


def execute(folder, programs):
    def one(test):
        profile = folder / f"{test}.profraw"
        profile.unlink(missing_ok=True)
        done = subprocess.run(
            ["env", f"LLVM_PROFILE_FILE={profile}", programs[test],
             f"--gtest_filter={TESTS[test]}"],
            cwd=programs[test].parent, stdout=subprocess.DEVNULL)
        return done.returncode == 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for test, fine in zip(programs, pool.map(one, programs)):
            if not fine:
                sys.exit(f"coverage.py: {test} fails")


def export(folder, programs, form):
    first, *others = programs.values()
    objects = [first]
    for program in others:
        objects += ["-object", program]
    names = [name for group in SOURCES.values() for name in group]
    done = run(["llvm-cov-19", "export", *objects, f"-format={form}",
                f"-instr-profile={folder / 'all.profdata'}",
                *(["-skip-expansions", "-skip-functions"]
                  if form == "text" else []),
                *(ROOT / name for name in names)],
               capture_output=True, text=True)
    return done.stdout


class Mark:
    """A comment that says what cannot happen, and the line it is about."""

    def __init__(self, kind, reason, line):
        self.kind, self.reason, self.line = kind, reason, line
        self.is_used = False


class File:
    def __init__(self, path):
        self.path = path
        self.text = (ROOT / path).read_text().splitlines()
        self.lines = {}  # number: times
        self.branches = collections.defaultdict(lambda: [0, 0])
        self.conditions = {}  # of a decision's place: which were shown
        self.marks = self.find_marks()
        self.missing, self.exempt = [], []
        self.excused = [0, 0, 0]  # lines, outcomes, conditions
        self.assertions = [
            m.span() for m in re.finditer(
                r"HALFSPACE_ASSERT\((?:[^()]|\((?:[^()]|"
                r"\([^()]*\))*\))*\)", "\n".join(self.text))]

    def find_marks(self):
        marks = []
        for k, line in enumerate(self.text):
            found = MARK.search(line)
            if not found:
                continue
            kind, reason, at = found[1], found[2], k + 1
            is_alone = line.strip().startswith("//")
            while at < len(self.text) and self.text[at].strip()[:2] == "//" \
                    and not MARK.search(self.text[at]):
                reason += " " + self.text[at].strip()[2:].strip()
                at += 1
            # Several marks may stand above one line.
            while is_alone and self.text[at].strip()[:2] == "//":
                at += 1
            marks.append(Mark(kind, reason, at + 1 if is_alone else k + 1))
        return marks

    def offset(self, line, column):
        return sum(len(t) + 1 for t in self.text[:line - 1]) + column - 1

    def is_asserted(self, line, column):
        at = self.offset(line, column)
        return any(a <= at < b for a, b in self.assertions)

    def is_excused(self, kinds, line, first=None):
        """Whether a mark is about one of the lines from `first` to `line`."""
        for mark in self.marks:
            if mark.kind in kinds and (first or line) <= mark.line <= line:
                mark.is_used = True
                return True
        return False

    def miss(self, line, what):
        self.missing.append((line, what, self.text[line - 1].strip()))

    def judge(self):
        self.judge_lines()
        for place, (yes, no) in sorted(self.branches.items()):
            if yes == 0 or no == 0:
                self.judge_branch(place, yes, no)
        if DECISIONS.search(self.path):
            for place, shown in sorted(self.conditions.items()):
                self.judge_conditions(place, shown)
        return [f"{self.path}:{m.line}: nothing is missing that was marked as "
                f"never {m.kind}" for m in self.marks if not m.is_used]

    def judge_lines(self):
        # The lines that follow a mark, up to one that is reached.
        unreached = set()
        for mark in self.marks:
            if mark.kind != "reached":
                continue
            at = mark.line
            while at <= len(self.text) and self.lines.get(at, 0) == 0:
                if at in self.lines:
                    unreached.add(at)
                    mark.is_used = True
                at += 1
        for line, times in self.lines.items():
            text = self.text[line - 1].strip()
            if times > 0:
                continue
            follows = self.text[line - 2].strip() if line > 1 else ""
            if line in unreached or text.startswith("HALFSPACE_ASSERT") or \
                    follows.startswith("HALFSPACE_ASSERT(false"):
                self.excused[0] += 1
            else:
                self.miss(line, "not reached")
        self.unreached = unreached

    def judge_branch(self, place, yes, no):
        line, column = place[:2]
        text = self.text[line - 1]
        for is_missing, kind in ((yes == 0, "true"), (no == 0, "false")):
            if not is_missing:
                continue
            # What the compiler writes, a comparison of all members.
            is_default = "= default;" in text
            is_switch = kind == "true" and re.search(
                r"\bswitch \($", text[:column - 1])
            if line in self.unreached or is_switch or is_default or \
                    self.is_asserted(line, column) or \
                    self.is_excused([kind], line):
                self.excused[1] += 1
            else:
                self.miss(line, f"never {kind}: "
                          f"`{self.piece(place)}`")

    def judge_conditions(self, place, shown):
        first, last = place[0], place[2]
        for is_shown in shown:
            if is_shown:
                continue
            if self.is_asserted(*place[:2]) or self.is_excused(
                    ["alone", "true", "false"], last, first):
                self.excused[2] += 1
            else:
                self.miss(first, "a condition never decides by itself: "
                          f"`{self.piece(place)}`")

    def piece(self, place):
        text = "\n".join(self.text)
        return " ".join(text[self.offset(*place[:2]):
                             self.offset(*place[2:4])].split())


def read(folder, programs):
    files = {}

    def file_of(name):
        path = str(pathlib.Path(name).relative_to(ROOT))
        return files.setdefault(path, None) or files.__setitem__(
            path, File(path)) or files[path]

    for part in export(folder, programs, "lcov").split("end_of_record"):
        name = re.search(r"^SF:(.*)$", part, re.M)
        if not name:
            continue
        file = file_of(name[1])
        for line, times in re.findall(r"^DA:(\d+),(\d+)", part, re.M):
            # Braces are no code of their own.
            if file.text[int(line) - 1].strip() not in ("", "}", "};", "});"):
                file.lines[int(line)] = \
                    file.lines.get(int(line), 0) + int(times)
    for entry in json.loads(
            export(folder, programs, "text"))["data"][0]["files"]:
        file = file_of(entry["filename"])
        for branch in entry.get("branches", []):
            place = tuple(branch[:4])
            if file.piece(place) in ("true", "false"):
                continue
            counts = file.branches[place]
            counts[0] += branch[4]
            counts[1] += branch[5]
        for record in entry.get("mcdc_records", []):
            place, shown = tuple(record[:4]), record[-1]
            known = file.conditions.get(place, [False] * len(shown))
            file.conditions[place] = [a or b for a, b in zip(known, shown)]
    return files


def share(have, of, excused):
    if of == 0:
        return "-"
    text = f"{have}/{of}"
    return text + (f" + {excused}" if excused else "")


def row(file):
    lines = [n > 0 for n in file.lines.values()]
    outcomes = [n > 0 for pair in file.branches.values() for n in pair]
    shown = [b for all_ in file.conditions.values() for b in all_]
    return [sum(lines), len(lines), file.excused[0], sum(outcomes),
            len(outcomes), file.excused[1], sum(shown), len(shown),
            file.excused[2]]


def table(files):
    text = ["| file | lines | outcomes of branches | MC/DC conditions |",
            "|---|---|---|---|"]
    sums = [0] * 9
    for path, file in sorted(files.items()):
        numbers = row(file)
        sums = [a + b for a, b in zip(sums, numbers)]
        text.append(f"| `{path}` | " + " | ".join(
            share(*numbers[k:k + 3]) for k in (0, 3, 6)) + " |")
    text.append("| all | " + " | ".join(
        share(*sums[k:k + 3]) for k in (0, 3, 6)) + " |")
    return "\n".join(text) + "\n"


def report(files, tests):
    parts = []
    for title, names in SOURCES.items():
        some = {path: file for path, file in files.items()
                if path.startswith(tuple(names))}
        parts.append(f"### {title}\n\n{table(some)}")
    marks = [f"* `{path}:{mark.line}`, never {mark.kind}: {mark.reason}"
             for path, file in sorted(files.items()) for mark in file.marks]
    missing = [f"* `{path}:{line}`: {what}"
               for path, file in sorted(files.items())
               for line, what, _ in sorted(file.missing)]
    parts.append("### Marked as impossible\n\n" +
                 ("\n".join(marks) or "Nothing.") + "\n")
    parts.append("### Missing\n\n" + ("\n".join(missing) or "Nothing.") + "\n")
    return "\n".join(parts), len(missing)


def absent():
    """The sources that are not there: they have been moved or renamed."""
    return [name for names in SOURCES.values() for name in names
            if not (ROOT / name).exists()]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--tests", default=",".join(TESTS))
    parser.add_argument("--no-build", action="store_true")
    parser.add_argument("--no-run", action="store_true")
    parser.add_argument("--print", action="store_true")
    arguments = parser.parse_args()
    if absent():
        sys.exit(f"coverage.py: not there: {', '.join(absent())}")
    tests = arguments.tests.split(",")
    folder = ROOT / "build/coverage"
    if not arguments.no_build and not arguments.no_run:
        build(folder, tests)
    programs = programs_of(folder, tests)
    if not arguments.no_run:
        execute(folder, programs)
        run(["llvm-profdata-19", "merge", "-o", folder / "all.profdata",
             *(folder / f"{test}.profraw" for test in tests)])
    files = read(folder, programs)
    wrong = [line for file in files.values() for line in file.judge()]
    text, missing = report(files, tests)
    if arguments.print:
        print(text)
    else:
        (ROOT / "out").mkdir(exist_ok=True)
        (ROOT / "out/coverage.md").write_text(text)
    print("\n".join(wrong + [f"{missing} missing, {len(wrong)} marks wrong"]))
    return 2 if wrong else 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
