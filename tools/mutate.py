#!/usr/bin/python3
"""Plants faults in the sources, and tells which the tests do not notice.

  tools/mutate.py                          ref/, fast/, io/, the vocabulary
  tools/mutate.py --only screen,split      files whose path has one of these
  tools/mutate.py --list --only screen     the mutants, one a line
  tools/mutate.py --report mutants.md      the table and the survivors
  tools/mutate.py --tests vectors_test --report quick.md    by these tests only
  tools/mutate.py --again quick.md         what survived those, by all tests
  tools/mutate.py --new                    what nobody has argued away
  tools/mutate.py --stale                  arguments whose lines are gone
  tools/mutate.py --mend                   the same, after moves and renamings

Mutant schemata: every mutant of a file is compiled into it at once, and the
environment variable HALFSPACE_MUTANT tells which one is alive; so there is one
build, then a process or a few for each mutant. Faults are planted in operators
(one for another), comparisons (one too many, one too few, turned round),
conditions (negated), constants (one more; true and false), enumerators (the
next one) and statements (left out). Needs Debian's python3-clang-14, and a
build of the tests: cmake --preset mutants && cmake --build --preset mutants.

A mutant dies if a test fails, crashes or takes five times as long. One that
cannot be told from the original is listed in tools/mutants.txt, as

  FILE: BEFORE => AFTER: why nobody can tell

Exit status: 0 all others died, 1 some survived, 2 nothing could be tried.
"""

import argparse
import collections
import concurrent.futures
import math
import os
import pathlib
import re
import resource
import subprocess
import sys

from file_lists import sources_of

try:
    from clang import cindex
    from clang.cindex import CursorKind as Kind
except ImportError:  # what checks mutants.txt needs none
    cindex = None

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIBCLANG = "/usr/lib/llvm-14/lib/libclang-14.so.1"

# Sources that are listed in any CMakeLists.txt of these folders.
FILES = [path for library in ("ref", "fast", "spec", "io")
         for path in sources_of(ROOT, library)]

# The source by which a header with functions of its own is compiled.
HOSTS = {"spec/include/halfspace/span.hpp": "ref/src/screen.cpp",
         "fast/src/raster/bands.hpp": "fast/src/raster/render.cpp",
         "fast/src/raster/band_walk.hpp": "fast/src/raster/render.cpp",
         "fast/src/raster/kernel/generic/coverage_merge.hpp":
             "fast/src/raster/kernel/portable.cpp"}
FILES += HOSTS

OTHERS = {
    "<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"],
    "==": ["!="], "!=": ["=="], "&&": ["||"], "||": ["&&"],
    "+": ["-"], "-": ["+"], "*": ["+"], "/": ["*"], "%": ["/"],
    "<<": [">>"], ">>": ["<<"], "&": ["|"], "|": ["&"],
    "+=": ["-="], "-=": ["+="], "*=": ["+="],
}

# Which tests look at a file, quickest first: a program and its filter.
QUICK = [("spec_test", "*"), ("io_test", "*"), ("faults_test", "*"),
         ("vectors_test", "*Implementations*"), ("ref_test", "*"),
         ("fast_test", "*")]
LAWS = [("exhaustive_test", "*Word*"), ("agree_tree_test", "*"),
        ("agree_display_tree_test", "*"), ("agree_blend_test", "*"),
        ("agree_image_test", "*"), ("agree_boolean_test", "*"),
        ("proptest", "S*/*")]


SUITE = re.compile(r"^(?:TYPED_)?TEST(?:_F|_P)?\((\w+),", re.M)


def suites_in(paths):
    """A filter for the tests of some files."""
    return ":".join(sorted({
        f"{suite}.*" for path in paths
        for suite in SUITE.findall(path.read_text())}))


def suites_of(*rooms):
    """A filter for the tests of rooms of fast/."""
    return suites_in(path for room in rooms
                     for path in (ROOT / "fast/test" / room).glob("*_test.cpp"))


def named_for(path):
    """A filter for the tests of a source: FILE_test.cpp, FILE_SUBJECT_test.cpp
    where its room has its tests, or anywhere in those of its library."""
    path = pathlib.Path(path)
    library, stem = path.parts[0], path.stem
    room = ROOT / library / "test" / pathlib.Path(*path.parts[2:-1])
    folder = room if room.is_dir() else ROOT / library / "test"
    return suites_in(sorted(folder.rglob(f"{stem}_test.cpp")) +
                     sorted(folder.rglob(f"{stem}_*_test.cpp")))


REF_BOOLEAN = "Faces*:Keep*:Classify*:Boolean*:BadEdges*:Rounded*"

# The slow ones stand apart, and come last.
REF_RENDER = ("RefScan*:RefPainter*:RefRaycast*:RefRender*-*Algorithms* "
              "RefRender*Limits* RefRender*Hurts*")
REF_TREE = "Build*:Insert*:ChooseRoot*:Split*:Predicate*-*DeepTree*:*Chain*"

SOLIDS = suites_of("table", "solid", "intersect", "boolean")
TREES = suites_of("tree") + " " + suites_of("sah") + "-*Threads*"
IMAGES = suites_of("camera", "raster") + " " + suites_of("sah") + "-*Threads*"
AGREE_IMAGE = "*Words*:*Fragments* *ManyTiles* *Hurt* *Leaves*"
FAST_SOLID = {"fast_test": SOLIDS, "agree_boolean_test": "*"}
FAST_IMAGE = {"vectors_test": "*Implementations*", "fast_test": IMAGES,
              "agree_image_test": AGREE_IMAGE, "agree_blend_test": "*",
              "proptest": ""}

# The tests that look at these files after those of its name, where not all do.
# Filters apart are tried in turn. The longest beginning of a path counts.
TESTS_OF = {
    "ref/src/classify": {"vectors_test": "*Implementations*",
                         "ref_test": REF_BOOLEAN, "proptest": ""},
    "ref/src/boolean": {"vectors_test": "*Implementations*",
                        "ref_test": REF_BOOLEAN, "proptest": ""},
    **{f"ref/src/{stem}": {"vectors_test": "*Implementations*",
                           "ref_test": REF_RENDER, "proptest": ""}
       for stem in ("scan", "projection", "shade", "render", "oracle/")},
    **{f"ref/src/{stem}": {"ref_test": "Rational*", "proptest": "S1*"}
       for stem in ("small_rational", "big_rational")},
    **{f"ref/src/{stem}": {"vectors_test": "*Implementations*",
                           "ref_test": REF_TREE, "proptest": ""}
       for stem in ("build", "splitter")},
    "fast/src/base/": {"fast_test": suites_of("base") + " " + SOLIDS},
    "fast/src/box/": FAST_SOLID,
    "fast/src/camera/": FAST_IMAGE,
    "fast/src/tree/": {"vectors_test": "*Implementations*",
                       "fast_test": TREES, "agree_tree_test": "*",
                       "agree_blend_test": "*", "proptest": ""},
    "fast/src/tree/leaf_packets": {"fast_test": TREES,
                                   "agree_image_test": "*Leaves*"},
    "fast/src/tree/predicate": {"agree_tree_test": "*Planes*:*Sides*:*Split*",
                                "proptest": "S1*"},
    "fast/src/sah/": {"vectors_test": "*Implementations*",
                      "fast_test": TREES, "agree_display_tree_test": "*"},
    "fast/src/raster/": FAST_IMAGE,
    **{f"fast/src/raster/{stem}": {
        "fast_test": "DynamicScreen*:KernelTiles*",
        "exhaustive_test": "*RandomMerges*", "agree_image_test": AGREE_IMAGE,
        "proptest": "S4*"}
       for stem in ("dynamic_screen", "kernel/generic/coverage_merge")},
    "fast/src/raster/scan_convert": {"agree_image_test": "*Cover*", "proptest": ""},
    "fast/src/raster/culler": {"agree_image_test": "*", "proptest": ""},
    **{f"fast/src/{room}/": FAST_SOLID
       for room in ("table", "solid", "intersect", "boolean")},
    "io/src/": {"io_test": "*-Triangulate*"},
    "spec/src/boolean": {"spec_test": "BadEdges*:MakeSolid*"},
    "spec/src/camera": {"spec_test": "MakeCamera*"},
    "spec/src/scene_file": {"spec_test": "SceneFile*"},
    "spec/": {"spec_test": "-*BitBudget*"},
}

# What runs only for the files that name it, or for those of its own room.
CHOSEN = {"agree_blend_test", "agree_boolean_test", "agree_display_tree_test",
          "faults_test"}
ROOMS = {"spec_test", "io_test", "ref_test", "fast_test"}

# The laws that look at a file, where not all do.
LAWS_OF = {
    "screen": "S4*", "dynamic_screen": "S4*", "split": "S2*:S3*", "predicate": "S*",
    "traverse": "S3*:S5*", "classify": "S6*", "boolean": "S6*",
    "scan": "S4*:S5*", "projection": "S4*:S5*", "shade": "S5*",
    "build": "S3*", "splitter": "S3*", "insert": "S3*",
}

PRELUDE = """#include <cstdlib>
static bool HalfspaceMutant(int id) {
  static const int alive = [] {
    const char* text = std::getenv("HALFSPACE_MUTANT");
    return text == nullptr ? -1 : std::atoi(text);
  }();
  return alive == id;
}
"""


class Site:
    """A piece of the source, and what may stand in its place."""

    def __init__(self, begin, end, is_statement):
        self.begin, self.end, self.is_statement = begin, end, is_statement
        self.mutants = []  # (id, code); the code of a statement is left out


class Mutant:
    def __init__(self, number, path, line, text, before, after):
        self.number, self.path, self.line = number, path, line
        self.text = text  # of the line
        self.before = " ".join(before.split())
        self.after = " ".join(after.split())

    def key(self):
        return f"{self.path}: {self.before} => {self.after} in {self.text}"

    def line_of_report(self):
        return f"* `{self.path}:{self.line}`: `{self.before}` => `{self.after}`"


class Source:
    """A file, its sites, and the text with all of its mutants in it."""

    def __init__(self, path, first_id, arguments):
        self.path, self.next_id = path, first_id
        self.text = (ROOT / path).read_text()
        self.sites, self.mutants = {}, []
        unit = cindex.Index.create().parse(str(ROOT / path), args=arguments)
        errors = [d for d in unit.diagnostics if d.severity >= 3]
        if errors:
            sys.exit(f"{path}: {errors[0]}")
        self.kept_out = [m.span() for m in re.finditer(
            r"HALFSPACE_ASSERT\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)"
            r"|static_assert\([^;]*;|constexpr [^;{(]*[=;{][^;]*;", self.text)]
        for cursor in unit.cursor.get_children():
            where = cursor.location.file
            if where and where.name == str(ROOT / path):
                self.visit(cursor, None)

    # What is mutated.

    def visit(self, cursor, parent):
        children = list(cursor.get_children())
        begin, end = cursor.extent.start.offset, cursor.extent.end.offset
        is_out = any(a <= begin < b for a, b in self.kept_out)
        if not is_out and end > begin:
            self.mutate(cursor, parent, children, begin, end)
        for k, child in enumerate(children):
            # Labels and sizes must be constants.
            if cursor.kind == Kind.CASE_STMT and k == 0:
                continue
            if cursor.kind == Kind.VAR_DECL and "[" in cursor.type.spelling:
                if child.kind == Kind.INTEGER_LITERAL:
                    continue
            self.visit(child, cursor)

    def mutate(self, cursor, parent, children, begin, end):
        kind, text = cursor.kind, self.text[begin:end]
        operands = self.operands(cursor, children)
        if operands:
            (_, left_end), (right_begin, _) = operands
            word = self.text[left_end:right_begin].strip()
            for other in OTHERS.get(word, []):
                if "string" in cursor.type.spelling:
                    continue
                self.add(begin, end, self.text[begin:left_end] + f" {other} " +
                         self.text[right_begin:end])
        elif kind == Kind.UNARY_OPERATOR:
            for sign, other in (("++", "--"), ("--", "++"), ("-", ""),
                                ("!", "")):
                if text.startswith(sign) and text[1:2] != "=":
                    # An optional<bool>, say, must not become the type of both.
                    self.add(begin, end, other + text[len(sign):],
                             code="!" + text if sign == "!" else None)
                    break
        elif kind == Kind.CXX_BOOL_LITERAL_EXPR:
            self.add(begin, end, "false" if text == "true" else "true")
        elif kind == Kind.INTEGER_LITERAL and text.isdigit():
            if parent is not None and parent.kind in (
                    Kind.DECL_REF_EXPR, Kind.MEMBER_REF_EXPR,
                    Kind.INIT_LIST_EXPR, Kind.TYPE_REF):
                return
            self.add(begin, end, str(int(text) + 1))
        elif kind == Kind.DECL_REF_EXPR and cursor.referenced is not None \
                and cursor.referenced.kind == Kind.ENUM_CONSTANT_DECL:
            values = [c.enum_value for c in
                      cursor.referenced.semantic_parent.get_children()]
            at = values.index(cursor.referenced.enum_value)
            self.add(begin, end, f"static_cast<decltype({text})>"
                                 f"({values[(at + 1) % len(values)]})")
        if kind == Kind.IF_STMT or kind == Kind.CONDITIONAL_OPERATOR:
            condition = children[0]
            a, b = condition.extent.start.offset, condition.extent.end.offset
            if condition.kind.is_expression():
                self.add(a, b, f"!({self.text[a:b]})")
        if kind in (Kind.COMPOUND_STMT, Kind.CASE_STMT, Kind.DEFAULT_STMT):
            for child in children[kind == Kind.CASE_STMT:]:
                if child.kind.is_expression() or child.kind in (
                        Kind.BREAK_STMT, Kind.CONTINUE_STMT):
                    self.leave_out(child)

    def operands(self, cursor, children):
        """The extents of both operands, where there are two."""
        def extent(c):
            return c.extent.start.offset, c.extent.end.offset
        if cursor.kind in (Kind.BINARY_OPERATOR,
                           Kind.COMPOUND_ASSIGNMENT_OPERATOR):
            return [extent(c) for c in children[:2]]
        if cursor.kind == Kind.CALL_EXPR and \
                cursor.spelling.startswith("operator"):
            given = list(cursor.get_arguments())
            if len(given) == 2 and extent(given[0])[1] <= extent(given[1])[0]:
                return [extent(c) for c in given]
        return None

    def site(self, begin, end, is_statement):
        key = (begin, end, is_statement)
        if key not in self.sites:
            self.sites[key] = Site(begin, end, is_statement)
        return self.sites[key]

    def add(self, begin, end, after, code=None):
        self.note(self.site(begin, end, False), after, code or after)

    def leave_out(self, cursor):
        begin, end = cursor.extent.start.offset, cursor.extent.end.offset
        if not any(a <= begin < b for a, b in self.kept_out):
            self.note(self.site(begin, end, True), "", "")

    def note(self, site, after, code):
        number = self.next_id
        self.next_id += 1
        site.mutants.append((number, code))
        line = self.text.count("\n", 0, site.begin) + 1
        self.mutants.append(Mutant(
            number, self.path, line, self.text.splitlines()[line - 1].strip(),
            self.text[site.begin:site.end],
            after or "(left out)"))

    # The text with all mutants in it.

    def drop_lines(self, lines):
        """Forgets the mutants on lines that do not compile."""
        for key, site in list(self.sites.items()):
            first = self.text.count("\n", 0, site.begin) + 1
            last = self.text.count("\n", 0, site.end) + 1
            if any(first <= line <= last for line in lines):
                gone = {number for number, _ in site.mutants}
                self.mutants = [m for m in self.mutants
                                if m.number not in gone]
                del self.sites[key]

    def schemata(self):
        # Outer sites first; of equal extents the statement is the outer one.
        order = sorted(self.sites.values(),
                       key=lambda s: (s.begin, -s.end, not s.is_statement))
        text, rest = self.render(0, len(self.text), order)
        assert not rest
        # Not inline: a test's own copy must not stand in for it.
        return text.replace("constexpr MergeCase", "static MergeCase")

    def render(self, begin, end, sites):
        """The text from begin to end; takes the sites in it off the list."""
        result, at = [], begin
        while sites and sites[0].begin < end and sites[0].end <= end:
            site = sites.pop(0)
            result.append(self.text[at:site.begin])
            inner, _ = self.render(site.begin, site.end, sites)
            result.append(self.wrapped(site, inner))
            at = site.end
        result.append(self.text[at:end])
        return "".join(result), sites

    @staticmethod
    def wrapped(site, inner):
        for number, after in site.mutants:
            if site.is_statement:
                inner = f"if (!HalfspaceMutant({number})) {inner}"
            else:
                # On one line, so that errors name the original's lines.
                flat = " ".join(re.sub(r"//.*", "", after).split())
                # A condition's other outcome; an optional is none.
                if flat.startswith("!("):
                    inner = f"static_cast<bool>({inner})"
                inner = f"(HalfspaceMutant({number}) ? ({flat}) : ({inner}))"
        return inner


class Build:
    """The tests of a build, linked again with mutated objects."""

    def __init__(self, folder, scratch):
        self.folder, self.scratch = folder, scratch
        scratch.mkdir(parents=True, exist_ok=True)
        (scratch / "prelude.hpp").write_text(PRELUDE)

    def commands(self, target):
        output = subprocess.run(
            ["ninja", "-C", self.folder, "-t", "commands", target],
            capture_output=True, text=True)
        return output.stdout.splitlines() if output.returncode == 0 else []

    def compile_command(self, path):
        path = HOSTS.get(path, path)
        room = path.split("/")[0]
        for line in self.commands(f"{room}/libhalfspace_{room}.a"):
            if line.endswith(f"/{path}"):
                # A cache before the compiler knows none of its options.
                return re.sub(r"^\S*ccache ", "", line)
        sys.exit(f"mutate.py: {self.folder} does not compile {path} by itself; "
                 "cmake --preset mutants makes a build that does")

    def parse_arguments(self, path):
        words = self.compile_command(path).split()
        return [w for w in words if w[:2] in ("-D", "-I")] + ["-std=c++20"]

    def place(self, source):
        """Where the schemata go, and what has to be searched to find them."""
        stem = source.path.replace("/", "_")
        if source.path not in HOSTS:
            return self.scratch / stem, None
        # Where its folder of headers begins.
        file = self.scratch / stem / re.split("/include/|/src/", source.path)[1]
        file.parent.mkdir(parents=True, exist_ok=True)
        return file, self.scratch / stem

    def compile(self, source, headers):
        """Compiles the schemata; forgets mutants until that succeeds."""
        file, folder = self.place(source)
        object_ = self.scratch / (source.path.replace("/", "_") + ".o")
        original = str(ROOT / source.path)
        host = HOSTS.get(source.path)
        command = self.compile_command(source.path).split()
        command[command.index("-o") + 1] = str(object_)
        command[-1] = str(ROOT / host if host else file)
        for flag in ("-MD", "-Werror"):
            if flag in command:
                command.remove(flag)
        for flag in ("-MT", "-MF"):
            if flag in command:
                at = command.index(flag)
                del command[at:at + 2]
        # -O1 compiles sooner; the mutants do not mind.
        command += ["-O1", "-w", "-I", str(pathlib.Path(original).parent),
                    "-include", str(self.scratch / "prelude.hpp")]
        if host:
            command[1:1] = ["-I", str(folder)]
        for header in headers:
            file_of_header, folder = self.place(header)
            file_of_header.write_text(header.schemata())
            command[1:1] = ["-I", str(folder)]
        for _ in range(12):
            file.write_text(source.schemata())
            done = subprocess.run(command, capture_output=True, text=True,
                                  cwd=self.folder)
            if done.returncode == 0:
                return object_
            lines = {int(n) for n in re.findall(
                re.escape(str(file)) + r":(\d+):\d+: (?:error|note)",
                done.stderr)}
            if not lines:
                sys.exit(f"{source.path}:\n{done.stderr[:3000]}")
            source.drop_lines(lines)
        sys.exit(f"mutate.py: {source.path} does not compile with mutants")

    def link(self, target, objects):
        """Links a test with the objects before all libraries."""
        lines = self.commands(target)
        if not lines:
            return None
        for part in lines[-1].split(" && "):
            if " -o " not in part:
                continue
            program = self.scratch / target
            part = re.sub(r" -o (\S+)", f" -o {program} " + " ".join(
                map(str, objects)), part, count=1)
            done = subprocess.run(part, shell=True, cwd=self.folder,
                                  capture_output=True, text=True)
            if done.returncode != 0:
                sys.exit(f"{target}:\n{done.stderr[-2000:]}")
            return program
        return None


def run(program, filter_, mutant, limit):
    """Whether the tests pass within a limit of processor seconds."""
    environment = dict(os.environ)
    if mutant is not None:
        environment["HALFSPACE_MUTANT"] = str(mutant)
    try:
        done = subprocess.run(
            ["prlimit", f"--cpu={limit}", "--core=0", program,
             f"--gtest_filter={filter_}", "--gtest_fail_fast"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            env=environment, timeout=100 * limit, cwd=program.parent)
        return done.returncode == 0
    except subprocess.TimeoutExpired:
        return False


def seconds_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def plan_for(path, programs):
    """The tests for mutants of a file, quickest first."""
    room = path.split("/")[0]
    steps = []
    own, named = f"{room}_test", named_for(path)
    if own in programs and named:
        steps.append((programs[own], named))
    chosen = TESTS_OF.get(max((start for start in TESTS_OF
                               if path.startswith(start)), key=len, default=""))
    for target, filter_ in QUICK + LAWS:
        if target not in programs:
            continue
        if chosen is not None:
            if target not in chosen:
                continue
            filter_ = chosen[target]
        elif target in CHOSEN or own != target in ROOMS:
            continue
        if target == "proptest":
            laws = (chosen or {}).get("proptest") or LAWS_OF.get(
                pathlib.Path(path).stem, "S*")
            number = 0 if room == "ref" else 1
            filter_ = ":".join(f"{law}/{number}.*" for law in laws.split(":"))
        steps += [(programs[target], part) for part in filter_.split()]
    return list(dict.fromkeys(steps))


class Reason:
    """An entry of tools/mutants.txt, and what says that it is stale."""

    def __init__(self, key):
        self.key = key
        self.path, rest = key.split(": ", 1)
        self.before, rest = rest.split(" => ", 1)
        # The line of the source comes last; " in " may stand before it, too.
        parts = rest.split(" in ")
        at = next((n for n in range(1, len(parts))
                   if self.begins_in(" in ".join(parts[n:]))), 1)
        self.after, self.text = " in ".join(parts[:at]), " in ".join(parts[at:])

    def begins_in(self, line):
        words = TOKEN.findall(self.before)
        return any(TOKEN.findall(line)[at:at + len(words)] ==
                   words[:len(TOKEN.findall(line)) - at]
                   for at in range(len(TOKEN.findall(line))))

    def is_stale(self, lines):
        return self.text not in lines.get(self.path, ())

    def renamed(self, words):
        """The key with other names, on another line of the same shape."""
        mine = TOKEN.findall(self.text)
        if len(mine) != len(words):
            return None
        names = {}
        for old, new in zip(mine, words):
            is_name = re.fullmatch(r"[A-Za-z_]\w*", old) and \
                re.fullmatch(r"[A-Za-z_]\w*", new)
            if old != new and not is_name or names.setdefault(old, new) != new:
                return None
        return names


TOKEN = re.compile(r"\w+|<<=?|>>=?|<=|>=|==|!=|&&|\|\||->|::|[-+*/]=|[^\w\s]")


def lines_of_files():
    return {path: [line.strip() for line in
                   (ROOT / path).read_text().splitlines()] for path in FILES}


def with_names(text, names):
    return re.sub(r"[A-Za-z_]\w*", lambda m: names.get(m[0], m[0]), text)


def mended(reason, lines):
    """The key where the line has moved, or has had names changed."""
    library, stem = reason.path.split("/")[0], pathlib.Path(reason.path).stem
    places = [path for path in lines if reason.text in lines[path] and
              path.split("/")[0] == library]
    same_name = [path for path in places if pathlib.Path(path).stem == stem]
    # A short line is found in files that have nothing to do with it.
    for found in (same_name, places if len(reason.text) >= 30 else []):
        if len(found) == 1:
            return f"{found[0]}: {reason.key.split(': ', 1)[1]}"
    # The same line of its own file with the fewest names changed.
    best = []
    for line in set(lines.get(reason.path, ())):
        names = reason.renamed(TOKEN.findall(line))
        changed = sum(old != new for old, new in (names or {}).items())
        if names and changed <= max(2, len(names) // 3):
            best.append((changed, line, names))
    best.sort(key=lambda entry: entry[:2])
    if not best or len(best) > 1 and best[0][0] == best[1][0]:
        return None
    _, line, names = best[0]
    return (f"{reason.path}: {with_names(reason.before, names)} => "
            f"{with_names(reason.after, names)} in {line}")


def check_reasons(mend):
    """Finds what is stale in tools/mutants.txt, and mends or drops it."""
    lines = lines_of_files()
    path = ROOT / "tools/mutants.txt"
    kept, is_kept, stale, dropped = [], True, 0, 0
    for line in path.read_text().splitlines():
        if line and not line.startswith(("#", " ")):
            reason, is_kept = Reason(line), True
            if reason.is_stale(lines):
                stale += 1
                other = mended(reason, lines)
                is_kept = other is not None
                dropped += not is_kept
                if not mend:
                    print(f"stale: {line}")
                line = other
        if is_kept:
            kept.append(line)
    wrong = [start for start in TESTS_OF
             if not any(file.startswith(start) for file in FILES)]
    for start in wrong:
        print(f"mutate.py: no source begins with {start}")
    if mend:
        path.write_text("\n".join(kept) + "\n")
        print(f"{stale} stale, {stale - dropped} mended, {dropped} dropped")
        return 1 if wrong else 0
    print(f"{stale} stale")
    return 1 if stale or wrong else 0


def reasons():
    """The mutants that nobody can tell from the original, and why."""
    path = ROOT / "tools/mutants.txt"
    known = {}
    if not path.is_file():
        return known
    key = None
    for line in path.read_text().splitlines():
        if line.startswith("  "):
            known[key] = (known.get(key, "") + " " + line.strip()).strip()
        elif line and not line.startswith("#"):
            key = line
    return known


def judge(mutant, steps, limits):
    """What kills the mutant, if anything."""
    for program, filter_ in steps:
        if not run(program, filter_, mutant.number,
                   limits[program, filter_]):
            return program.name
    return None


def write_report(path, rows, survivors, known):
    lines = ["| file | mutants | died | equivalent | survived |",
             "|---|---|---|---|---|"]
    for name, (count, died, equivalent) in rows.items():
        lines.append(f"| `{name}` | {count} | {died} | {equivalent} | "
                     f"{count - died - equivalent} |")
    sums = [sum(row[k] for row in rows.values()) for k in range(3)]
    lines.append(f"| all | {sums[0]} | {sums[1]} | {sums[2]} | "
                 f"{sums[0] - sums[1] - sums[2]} |")
    if survivors:
        lines += ["", "Survivors:", ""]
        for mutant in survivors:
            why = known.get(mutant.key(), "not explained")
            lines.append(f"{mutant.line_of_report()}: {why}")
    text = "\n".join(lines) + "\n"
    print(text)
    if path:
        path.write_text(text)


def parse():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--only", default="", help="parts of paths, commas")
    parser.add_argument("--build", type=pathlib.Path,
                        default=ROOT / "build/mutants")
    parser.add_argument("--scratch", type=pathlib.Path,
                        default=ROOT / "build/mutants/schemata")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--report", type=pathlib.Path)
    parser.add_argument("--tests", default="", help="these only, commas")
    parser.add_argument("--again", type=pathlib.Path, metavar="REPORT",
                        help="those only that survived there")
    parser.add_argument("--new", action="store_true",
                        help="not those that tools/mutants.txt explains")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--stale", action="store_true",
                        help="what of tools/mutants.txt is no longer there")
    parser.add_argument("--mend", action="store_true",
                        help="and mend it, or drop what is gone")
    return parser.parse_args()


def main():
    arguments = parse()
    if arguments.stale or arguments.mend:
        return check_reasons(arguments.mend)
    if cindex is None:
        sys.exit("mutate.py: needs Debian's python3-clang-14, and its python3")
    cindex.Config.set_library_file(LIBCLANG)
    build = Build(arguments.build.resolve(), arguments.scratch.resolve())
    words = arguments.only.split(",")
    paths = [p for p in FILES if any(word in p for word in words)]
    sources, number = [], 0
    for path in paths:
        source = Source(path, number, build.parse_arguments(path))
        number = source.next_id
        sources.append(source)
    if arguments.list:
        for source in sources:
            for mutant in source.mutants:
                print(f"{mutant.path}:{mutant.line}: {mutant.before} => "
                      f"{mutant.after}")
        return 0
    objects = []
    for source in sources:
        if HOSTS.get(source.path) not in paths:
            objects.append(build.compile(source, [
                other for other in sources
                if HOSTS.get(other.path) == source.path]))
    programs = {}
    wanted = arguments.tests.split(",") if arguments.tests else None
    for target, _ in QUICK + LAWS:
        if wanted and target not in wanted:
            continue
        program = build.link(target, objects)
        if program:
            programs[target] = program
    limits = {}
    plans = {path: plan_for(path, programs) for path in paths}
    for step in {step for plan in plans.values() for step in plan}:
        begin = seconds_of_children()
        if not run(*step, None, 3600):
            print(f"mutate.py: {step[0].name} fails without a fault")
            return 2
        limits[step] = math.ceil(5 * (seconds_of_children() - begin)) + 1
    mutants = [m for source in sources for m in source.mutants]
    if arguments.again:
        again = arguments.again.read_text()
        mutants = [m for m in mutants if m.line_of_report() in again]
    known, survivors = reasons(), []
    rows = collections.OrderedDict((path, [0, 0, 0]) for path in paths)
    if arguments.new:
        mutants = [m for m in mutants if m.key() not in known]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        verdicts = pool.map(
            lambda m: judge(m, plans[m.path], limits), mutants)
        for done, (mutant, killer) in enumerate(zip(mutants, verdicts), 1):
            row = rows[mutant.path]
            row[0] += 1
            row[1] += killer is not None
            if killer is None:
                row[2] += mutant.key() in known
                survivors.append(mutant)
            print(f"{done}/{len(mutants)} {mutant.path}:{mutant.line}: "
                  f"{mutant.before} => {mutant.after}: "
                  f"{killer or 'SURVIVES'}", file=sys.stderr)
    write_report(arguments.report, rows, survivors, known)
    return 1 if any(m.key() not in known for m in survivors) else 0


if __name__ == "__main__":
    sys.exit(main())
