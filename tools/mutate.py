#!/usr/bin/python3
"""Plants faults in the sources, and tells which the tests do not notice.

  tools/mutate.py                          ref/, fast/, io/, the vocabulary
  tools/mutate.py --only screen,split      files whose path has one of these
  tools/mutate.py --list --only screen     the mutants, one a line
  tools/mutate.py --report mutants.md      the table and the survivors
  tools/mutate.py --tests vectors_test --report quick.md    by these tests only
  tools/mutate.py --again quick.md         what survived those, by all tests
  tools/mutate.py --new                    what nobody has argued away

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

from clang import cindex
from clang.cindex import CursorKind as Kind

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIBCLANG = "/usr/lib/llvm-14/lib/libclang-14.so.1"

FILES = [
    "spec/include/halfspace/span.hpp", "ref/src/screen.cpp", "ref/src/split.cpp", "ref/src/predicate.cpp",
    "ref/src/splitter.cpp", "ref/src/build.cpp", "ref/src/traverse.cpp",
    "ref/src/projection.cpp", "ref/src/scan.cpp", "ref/src/render.cpp",
    "ref/src/shade.cpp", "ref/src/classify.cpp", "ref/src/boolean.cpp",
    "ref/src/big_rational.cpp", "ref/src/small_rational.cpp",
    "ref/src/oracle/painter.cpp", "ref/src/oracle/zbuffer.cpp",
    "ref/src/oracle/raycast.cpp",
    "fast/src/raster/dynamic_screen.cpp",
    "fast/src/raster/kernel/generic/coverage_merge.hpp",
    "fast/src/tree/split.cpp", "fast/src/tree/scene_planes.cpp",
    "fast/src/tree/predicate.cpp", "fast/src/tree/splitter.cpp",
    "fast/src/tree/traverse.cpp", "fast/src/tree/insert.cpp", "fast/src/raster/tile_buffer.cpp",
    "fast/src/raster/scan_convert.cpp", "fast/src/intersect/self_intersections.cpp", "fast/src/camera/view.cpp",
    "fast/src/raster/culler.cpp", "fast/src/raster/gouraud.cpp", "fast/src/raster/polygon_rasterizer.cpp",
    "fast/src/sah/sah_builder.cpp", "fast/src/sah/axis_split.cpp",
    "fast/src/sah/polygon_split.cpp",
    "fast/src/sah/build_display_tree.cpp",
    "fast/src/raster/render.cpp", "fast/src/raster/depth_line.cpp", "fast/src/tree/build.cpp",
    "fast/src/tree/tree_file.cpp", "fast/src/tree/fragment_splitter.cpp",
    "fast/src/tree/leaf_packets.cpp",
    "fast/src/solid/grid_prefilter.cpp",
    "fast/src/intersect/candidates.cpp", "fast/src/boolean/emit.cpp",
    "fast/src/boolean/assemble.cpp", "fast/src/intersect/edge_plane_crossings.cpp",
    "fast/src/boolean/boolean.cpp", "fast/src/intersect/face_intersection.cpp",
    "fast/src/boolean/classify.cpp", "fast/src/solid/loops.cpp",
    "fast/src/intersect/radial_order.cpp", "fast/src/box/bvh.cpp",
    "fast/src/boolean/chain.cpp", "fast/src/solid/convex_merge.cpp",
    "fast/src/solid/edge_packets.cpp", "fast/src/solid/to_mesh.cpp",
    "fast/src/solid/merge_groups.cpp", "fast/src/solid/dynamic_bvh.cpp",
    "fast/src/base/huge_page_pool.cpp", "fast/src/intersect/point_location.cpp", "fast/src/solid/merge_faces.cpp",
    "fast/src/solid/vertex_order.cpp", "fast/src/boolean/conform.cpp",
    "fast/src/boolean/check_operand.cpp",
    "fast/src/tree/plane_ids.cpp", "fast/src/boolean/resolve.cpp",
    "fast/src/intersect/line_section.cpp", "fast/src/intersect/self_radial_order.cpp", "fast/src/solid/solid.cpp", "fast/src/table/geometry_table.cpp",
    "fast/src/table/planes.cpp", "fast/src/table/points.cpp",
    "fast/src/table/rounding.cpp", "fast/src/solid/face_triangulation.cpp",
    "spec/src/boolean.cpp", "spec/src/camera.cpp", "spec/src/int128.cpp",
    "spec/src/message.cpp", "spec/src/polygon.cpp", "spec/src/scene.cpp",
    "spec/src/scene_file.cpp", "spec/src/scene_file_write.cpp",
    "spec/src/token_lines.cpp",
    "io/src/automatic_view.cpp", "io/src/encode.cpp", "io/src/file.cpp",
    "io/src/format.cpp", "io/src/grid.cpp", "io/src/import.cpp", "io/src/join.cpp",
    "io/src/mesh_builder.cpp", "io/src/npy.cpp", "io/src/number.cpp",
    "io/src/ply_header.cpp", "io/src/png_rows.cpp", "io/src/read_mesh.cpp",
    "io/src/read_obj.cpp", "io/src/read_off.cpp", "io/src/read_ply.cpp",
    "io/src/read_stl.cpp", "io/src/shade.cpp", "io/src/text.cpp",
    "io/src/triangulate.cpp", "io/src/view.cpp", "io/src/write_mesh.cpp",
]

# The source by which a header with functions of its own is compiled.
HOSTS = {"spec/include/halfspace/span.hpp": "ref/src/screen.cpp"}

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

REF_BOOLEAN = "Faces*:Keep*:Classify*:Boolean*:BadEdges*:Rounded*"

# Those of faces take least, so they come first.
FAST_BOOLEAN = ("FastBooleanFaces*:FastOperand*:FastBadEdges*:FastTable*:"
                "FastHalves* "
                "FastChain*:FastResolve*:FastThreads*:FastBoolean.* "
                "FastNonsense*")
FAST_SPACE = "Space*:BoxTree*:FaceIndex*:MergeFaces*:Digits* " + FAST_BOOLEAN

# The slow ones stand apart, and come last.
REF_RENDER = ("RefScan*:RefPainter*:RefRaycast*:RefRender*-*Algorithms* "
              "RefRender*Limits* RefRender*Hurts*")
REF_TREE = "Build*:Insert*:ChooseRoot*:Split*:Predicate*-*DeepTree*:*Chain*"

FAST_TREE = "Build*:Insert*:Heur*:TreeFile* DisplayTree*-*Threads*"
FAST_IMAGE = "ViewBounds*:Near*:FastRender* DisplayTree*-*Threads*"
AGREE_IMAGE = ("*Words*:*Fragments* *ManyTiles* *Hurt* *Leaves*")

# The tests that look at these files, where not all do. Filters apart are tried
# in turn.
TESTS_OF = {
    "ref/src/classify": {"vectors_test": "*Implementations*",
                         "ref_test": REF_BOOLEAN, "proptest": ""},
    "ref/src/boolean": {"vectors_test": "*Implementations*",
                        "ref_test": REF_BOOLEAN, "proptest": ""},
    **{f"ref/src/{stem}": {"vectors_test": "*Implementations*",
                           "ref_test": REF_RENDER, "proptest": ""}
       for stem in ("scan", "projection", "shade", "render", "painter",
                    "zbuffer", "raycast")},
    "ref/src/small_rational": {"ref_test": "Rational*", "proptest": "S1*"},
    **{f"ref/src/{stem}": {"vectors_test": "*Implementations*",
                           "ref_test": REF_TREE, "proptest": ""}
       for stem in ("build", "splitter")},
    **{f"fast/src/{stem}": {"vectors_test": "*Implementations*",
                            "fast_test": FAST_TREE, "agree_tree_test": "*",
                            "agree_blend_test": "*", "proptest": ""}
       for stem in ("build", "insert", "plane_table", "tree_builder",
                    "tree_file", "splitter")},
    "fast/src/display_": {"vectors_test": "*Implementations*",
                          "fast_test": "DisplayTree*-*Threads*",
                          "agree_display_tree_test": "*"},
    "fast/src/fragment_blocks": {
        "fast_test": "FragmentBlocks* Near*:DisplayTree*-*Threads*",
        "agree_image_test": "*Leaves*"},
    "fast/src/predicate": {"agree_tree_test": "*Planes*:*Sides*:*Split*",
                           "proptest": "S1*"},
    "fast/src/scan": {"agree_image_test": "*Cover*", "proptest": ""},
    "fast/src/self_intersections": {"fast_test": "FastResolve*"},
    **{f"fast/src/{stem}": {"vectors_test": "*Implementations*",
                            "fast_test": FAST_IMAGE,
                            "agree_image_test": AGREE_IMAGE,
                            "agree_blend_test": "*", "proptest": ""}
       for stem in ("view", "drawer", "render", "depth")},
    "fast/src/culler": {"fast_test": "Culler*", "agree_image_test": "*",
                        "proptest": ""},
    "fast/src/shader": {"vectors_test": "*Implementations*",
                        "fast_test": "ShadeBounds*",
                        "agree_image_test": AGREE_IMAGE,
                        "agree_blend_test": "*", "proptest": ""},
    "fast/src/boolean": {"agree_boolean_test": "*",
                         "fast_test": FAST_BOOLEAN},
    "fast/src/edge_blocks": {"agree_boolean_test": "*",
                             "fast_test": FAST_BOOLEAN},
    "fast/src/locator": {"agree_boolean_test": "*",
                         "fast_test": FAST_BOOLEAN},
    "fast/src/section": {"fast_test": "Section*"},
    "fast/src/mesh_order": {"fast_test": "MeshOrder*"},
    "fast/src/conform": {"agree_boolean_test": "*",
                        "fast_test": "FastConform* FastNonsense*"},
    "fast/src/base/huge_page_pool": {"fast_test": "HugePagePool*:List* " + FAST_BOOLEAN},
    **{f"fast/src/{stem}": {"agree_boolean_test": "*",
                            "fast_test": FAST_SPACE} for stem in (
        "box_tree", "chain", "convex_parts", "to_mesh", "face_groups",
        "face_index", "merge_faces", "near_cells", "operand", "resolve", "self_wings",
        "solid", "space", "triangulate")},
    "fast/src/screen": {"vectors_test": "*Implementations*",
                        "fast_test": "KernelTiles* " + FAST_IMAGE,
                        "agree_image_test": AGREE_IMAGE},
    **{f"fast/src/raster/{stem}": {
        "fast_test": "DynamicScreen*:KernelTiles*",
        "exhaustive_test": "*RandomMerges*", "agree_image_test": AGREE_IMAGE,
        "proptest": "S4*"}
       for stem in ("dynamic_screen", "kernel/generic/coverage_merge")},
    "io/src/triangulate": {
        "io_test": "Triangulate*:ShapeOf*-*Ends*:*Quadratic*:*ManyCorners* "
                   "Triangulate.*Ends*:*Quadratic*:*ManyCorners*:ImportScene*"},
    "io/src/number": {"io_test": "ParseNumber*:NumberOf*:ToDouble*:Import*"},
    "io/src/view": {"io_test": "LookAt*:AutomaticView*"},
    "io/src/automatic_view": {"io_test": "LookAt*:AutomaticView*"},
    "io/src/grid": {"io_test": "ImportScene* ToGrid*:ChooseGrid*"},
    "io/src/import": {"io_test": "ImportScene*"},
    "io/src/join": {"io_test": "*Parts*"},
    "io/src/encode": {"io_test": "Encode* WriteMesh*:WriteScene*"},
    "io/src/file": {"io_test": "WriteFile*"},
    "io/src/npy": {"io_test": "Npy*"},
    "io/src/png": {"io_test": "WritePng*:PngParts*"},
    "io/src/shade": {"io_test": "Shade*"},
    "io/src/text": {"io_test": "Text* Read*"},
    "io/src/read": {"io_test": "Read*"},
    "io/src/ply": {"io_test": "Read*"},
    "io/src/write": {"io_test": "Encode*:Write*"},
    "io/": {"io_test": "-Triangulate*:LookAt*:ImportScene*"},
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
        file = self.scratch / stem / source.path.split("/include/")[1]
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
    for target, filter_ in QUICK + LAWS:
        if target not in programs:
            continue
        chosen = next((tests for start, tests in TESTS_OF.items()
                       if path.startswith(start)), None)
        if chosen is not None:
            if target not in chosen:
                continue
            filter_ = chosen[target]
        elif target in CHOSEN or f"{room}_test" != target in ROOMS:
            continue
        if target == "proptest":
            laws = (chosen or {}).get("proptest") or LAWS_OF.get(
                pathlib.Path(path).stem, "S*")
            number = 0 if room == "ref" else 1
            filter_ = ":".join(f"{law}/{number}.*" for law in laws.split(":"))
        steps += [(programs[target], part) for part in filter_.split()]
    return steps


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
    return parser.parse_args()


def main():
    arguments = parse()
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
