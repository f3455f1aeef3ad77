#!/usr/bin/env python3
"""Checks that every clause of spec/ is what the code and the proofs carry out.

  tools/check_traceability.py [--laws PROGRAM REPORT] [--write]
                              [--confirm CLAUSE ...]

spec/traceability.md has a heading for every clause of spec/S*.md, and under it
lines that say

  confirmed: HASH         of the clause's text, when these lines were last read
  reference: NAMES        functions of ref/, `io/`, `spec/`; several with ;
  fast: NAMES             functions of fast/
  laws: S2.L3, S3.L7 (1)  tests of proptest/; after a law the least number of
                          cases it has to run, else it is the file's `cases:`,
                          and `ref` if it is tested on the reference alone
  fuzz: TARGETS           programs of fuzz/

A function stands with its header, `halfspace/ref/split.hpp ref::split`; one of
several of a name with its type, `... ref::build: BspTree(const Scene&, const
BuildOptions&)`. What a clause has none of stands as `-` and the reason.

What is named is shown to be real by use:

* theorems come from the lists of spec/coq/, which tools/check_proofs.py asks
  Coq about; a list may name no clause that is not there;
* functions have their address taken by proptest/traceability/functions.cpp,
  which has to be what this writes, and is compiled, linked and run as a test;
* laws are those of spec/, each named by a clause; --laws names the program
  that tests them, which is asked for its list, and the file to which it wrote
  what it has run (HALFSPACE_LAW_REPORT): every law has to be in the list, and
  every test of a law has to have passed, for each implementation on as many
  cases as it should;
* fuzz targets are built by fuzz/CMakeLists.txt and have a corpus;
* the constants of the code are those of the theories (check_constants.py);
* docs/traceability.md and docs/proven.md are what this writes.

--write writes the three generated files; --confirm takes the present text of
the clauses as confirmed ("all" for all of them).
Exit status: 0 if all holds, else 1.
"""

import argparse
import hashlib
import pathlib
import re
import subprocess
import sys
import textwrap

import check_constants

ROOT = pathlib.Path(__file__).resolve().parent.parent
CLAUSE = re.compile(r"^## (S\d+\.\d+) (.+)$", re.MULTILINE)
LAW = re.compile(r"^\*\*(S\d+\.L\d+)\*\*", re.MULTILINE)
KEYS = ("confirmed", "reference", "fast", "laws", "fuzz")


def clauses():
    """The clauses, as {name: (title, file, hash of the text)}."""
    found = {}
    for path in sorted((ROOT / "spec").glob("S*.md")):
        parts = re.split(r"^(?=## )", path.read_text(), flags=re.MULTILINE)
        for part in parts:
            if match := CLAUSE.match(part):
                text = " ".join(part.split())
                digest = hashlib.sha256(text.encode()).hexdigest()[:12]
                found[match[1]] = (match[2], path.name, digest)
    return found


def laws():
    """The names of all laws."""
    return {law for path in (ROOT / "spec").glob("S*.md")
            for law in LAW.findall(path.read_text())}


def rows(faults):
    """The rows, as {clause: {key: value}}, and the least number of cases."""
    path = ROOT / "spec/traceability.md"
    text = path.read_text()
    least = re.search(r"^cases: (\d+)$", text, re.MULTILINE)
    if not least:
        faults.append(f"{path.name}: no line `cases:`")
    found = {}
    for part in re.split(r"^(?=## )", text, flags=re.MULTILINE)[1:]:
        head, *lines = part.splitlines()
        name = head.removeprefix("## ").split()[0]
        row, key = {}, None
        for line in lines:
            if match := re.match(r"(\w+): (.*)", line):
                key = match[1]
                row[key] = match[2].strip()
            elif line.strip() and key:
                row[key] += " " + line.strip()
        if name in found:
            faults.append(f"{path.name}: {name} stands there twice")
        if set(row) != set(KEYS):
            faults.append(f"{path.name}: {name}: has {sorted(row)}")
        found[name] = {key: row.get(key, "-") for key in KEYS}
    return found, int(least[1]) if least else 1


def members(value, separator):
    """The members of a line; none if it is a dash and a reason."""
    if value.startswith("-"):
        return []
    return [member.strip() for member in value.split(separator)]


def theorems(faults, known):
    """The listed theorems, as [(name, file, clauses, sentence)]."""
    found = []
    for path in sorted((ROOT / "spec/coq").glob("*.theorems")):
        for line in path.read_text().splitlines():
            if not line.strip() or line.startswith("#"):
                continue
            fields = [field.strip() for field in line.split("|")]
            if len(fields) != 4:
                faults.append(f"{path.name}: {line}")
                continue
            name, file, clause, sentence = fields
            where = [part.strip() for part in clause.split(",")]
            for part in where:
                if part not in known:
                    faults.append(f"{path.name}: {name}: no clause {part}")
            found.append((name, file, where, sentence))
    return found


def function_of(entry, faults):
    """(header, name, type or None) of an entry of a row."""
    match = re.match(r"(\S+\.hpp) ([\w:]+?)(?:: (.+))?$", entry)
    if not match:
        faults.append(f"traceability.md: no function: {entry}")
        return None
    return match[1], match[2], match[3]


def functions_file(table, faults):
    """The text of the C++ file that takes the address of every function."""
    headers, uses = set(), []
    for clause, row in table.items():
        for key in ("reference", "fast"):
            for entry in members(row[key], ";"):
                if function := function_of(entry, faults):
                    header, name, kind = function
                    headers.add(header)
                    uses.append((clause, name, kind))
    lines = ["// Written by tools/check_traceability.py --write from "
             "spec/traceability.md.", "// clang-format off", ""]
    lines += [f'#include "{header}"' for header in sorted(headers)]
    lines += ["", "#include <cstddef>", "#include <cstdio>", "",
              "namespace halfspace {", "namespace {", "",
              "std::size_t taken = 0;", "",
              "template <class Function>",
              "void take(Function* function) {",
              "  Function* volatile kept = function;",
              "  if (kept != nullptr) ++taken;", "}",
              "template <class Class, class Member>",
              "void take(Member Class::*member) {",
              "  Member Class::*volatile kept = member;",
              "  if (kept != nullptr) ++taken;", "}", "",
              "void take_all() {"]
    for clause, name, kind in uses:
        if kind:
            scope = name.rpartition("::")[0]
            using = f"    using namespace {scope};\n" if scope else ""
            lines.append(f"  {{  // {clause}\n{using}    using Kind = {kind};\n"
                         f"    take<Kind>(&{name});\n  }}")
        else:
            lines.append(f"  take(&{name});  // {clause}")
    lines += ["}", "", "}  // namespace", "}  // namespace halfspace", "",
              "int main() {", "  halfspace::take_all();",
              '  std::printf("%zu functions\\n", halfspace::taken);',
              f"  return halfspace::taken == {len(uses)} ? 0 : 1;", "}", ""]
    return "\n".join(lines)


def wanted_laws(table, least, faults):
    """The laws that clauses name, as {law: (least number of cases, whether the
    reference alone is tested)}."""
    known, wanted = laws(), {}
    for clause, row in table.items():
        for entry in re.split(r", (?=S)", row["laws"]):
            if entry.startswith("-"):
                continue
            match = re.match(r"(S\d+\.L\d+)(?: \((?:(\d+)|(\d+, )?(ref))\))?$",
                             entry)
            if not match or match[1] not in known:
                faults.append(f"{clause}: no law: {entry}")
                continue
            number = match[2] or (match[3] or "").removesuffix(", ")
            said = (int(number) if number else least, match[4] == "ref")
            if wanted.setdefault(match[1], said) != said:
                faults.append(f"{clause}: another clause asks less or more of "
                              f"{match[1]}")
    for law in sorted(known - wanted.keys()):
        faults.append(f"{law} is named by no clause")
    return wanted


def tests_of(program):
    """The names of a test program's tests: S2Split/0.L3ThePartsLie..."""
    done = subprocess.run([program, "--gtest_list_tests"], check=True,
                          stdout=subprocess.PIPE, text=True)
    suite, names = "", []
    for line in done.stdout.splitlines():
        words = line.split("#")[0].split()
        if words and line[0].isspace():
            names.append(suite + words[0])
        elif words and words[0].endswith("."):
            suite = words[0]
    return names


def check_runs(wanted, names, report, faults):
    """Every test of every law has passed, on as many cases as it should."""
    ran, skipped = {}, set()
    for line in report.splitlines():
        # S2Split/0.L3ThePartsLieOnTheirSides 812 passed
        name, cases, how = line.split()
        # Beyond the portable one instruction sets may be missing.
        if how == "passed":
            ran[name] = max(int(cases), ran.get(name, 0))
        elif how == "skipped" and re.search(r"/[2-9]\.", name):
            skipped.add(name)
        else:
            faults.append(f"{name} has not passed")
    most = {law: {} for law in wanted}
    for name in names:
        match = re.match(r"(S\d+)\w*((?:/\d+)?)\.(L\d+)[A-Z]\w*$", name)
        if not match:
            continue
        law = f"{match[1]}.{match[3]}"
        if law not in wanted:
            faults.append(f"{name} is of no law")
        elif name in skipped:
            print(f"{name}: skipped, this machine lacks what it is for")
        elif name not in ran:
            faults.append(f"{name} has not run")
        else:
            # One law may have several tests, and one number for them.
            counts = most[law]
            counts[match[2]] = max(ran[name], counts.get(match[2], 0))
    for law, counts in sorted(most.items()):
        least, ref_only = wanted[law]
        # A suite without a number tests what both share.
        expected = {"/0"} if ref_only else {"/0", "/1"}
        if set(counts) != {""} and not expected <= set(counts):
            faults.append(f"{law} has run for {sorted(counts)} of "
                          f"{sorted(expected)}")
        for cases in counts.values():
            if cases < least:
                faults.append(f"{law} has run {cases} cases of {least}")


def check_fuzz(table, faults):
    built = set(re.findall(r"^halfspace_fuzz_target\((\w+)",
                           (ROOT / "fuzz/CMakeLists.txt").read_text(),
                           re.MULTILINE))
    named = {target for row in table.values()
             for target in members(row["fuzz"], ",")}
    for target in sorted(named):
        if target not in built or not (ROOT / f"fuzz/{target}.cpp").exists():
            faults.append(f"no fuzz target: {target}")
        corpus = ROOT / "fuzz/corpus" / target.removeprefix("fuzz_")
        if not corpus.is_dir() or not any(corpus.iterdir()):
            faults.append(f"{target} has no corpus")
    for target in sorted(built - named):
        faults.append(f"{target} is named by no clause")


def item(text):
    """A member of a list, in lines of 80."""
    return textwrap.fill("* " + text, 80, subsequent_indent="  ",
                         break_long_words=False, break_on_hyphens=False)


def table_file(table, known, proofs):
    """docs/traceability.md."""
    lines = ["# Traceability", "",
             "Written by `tools/check_traceability.py --write`: who carries",
             "out each clause, and what shows that they do.", ""]
    for clause, (title, file, _) in known.items():
        row = table.get(clause, {key: "-" for key in KEYS})
        lines += [f"## {clause} {title}", "", f"`spec/{file}`", ""]
        names = [f"`{stem.removesuffix('.v')}.{name}`"
                 for name, stem, where, _ in proofs if clause in where]
        lines.append(item("Theorems: " + (", ".join(names) or "none")))
        for key in ("reference", "fast"):
            shown = []
            for entry in members(row[key], ";"):
                function = function_of(entry, [])
                if function:
                    shown.append(f"`{function[1]}`")
            lines.append(item(f"{key.capitalize()}: " +
                              (", ".join(shown) or row[key].lstrip("- "))))
        lines.append(item("Laws: " + row["laws"].lstrip("- ")))
        targets = [f"`{target}`" for target in members(row["fuzz"], ",")]
        lines.append(item("Fuzz targets: " + (", ".join(targets) or
                                              row["fuzz"].lstrip("- "))))
        lines.append("")
    return "\n".join(lines)


def proven_file(known, proofs):
    """docs/proven.md."""
    lines = ["# What is proven", "",
             "Written by `tools/check_traceability.py --write` from the lists",
             "in `spec/coq/`. Coq has checked every theorem, and none rests on",
             "an axiom (`tools/check_proofs.py`).", ""]
    last = None
    for name, file, where, sentence in sorted(
            proofs, key=lambda p: (p[2][0], p[1])):
        stem = file.removesuffix(".v")
        if (where[0], stem) != last:
            last = (where[0], stem)
            lines += ["" if lines[-1] else None, f"## {where[0]}, {file}", ""]
        lines.append(item(f"`{name}`: {sentence}"))
    with_proof = {clause for _, _, where, _ in proofs for clause in where}
    without = ", ".join(clause for clause in known if clause not in with_proof)
    lines += ["", (ROOT / "spec/coq/not-proven.md").read_text().rstrip(),
              item(f"**Clauses without any theorem**: {without}."), ""]
    return "\n".join(line for line in lines if line is not None)


def confirm(names, known):
    path = ROOT / "spec/traceability.md"
    parts = re.split(r"^(?=## )", path.read_text(), flags=re.MULTILINE)
    for i, part in enumerate(parts):
        match = CLAUSE.match(part)
        if match and match[1] in known and (match[1] in names or
                                            "all" in names):
            parts[i] = re.sub(r"^confirmed: .*$",
                              "confirmed: " + known[match[1]][2], part,
                              flags=re.MULTILINE)
    path.write_text("".join(parts))


def check(write=False, program=None, report=None):
    """Everything that is wrong, and what there is."""
    faults, known = [], clauses()
    table, least = rows(faults)
    for clause in known.keys() - table.keys():
        faults.append(f"{clause} has no row in spec/traceability.md")
    for clause in table.keys() - known.keys():
        faults.append(f"spec/traceability.md: no clause {clause}")
    for clause, row in table.items():
        if clause in known and row["confirmed"] != known[clause][2]:
            faults.append(f"{clause} has changed: read its row again, then "
                          f"tools/check_traceability.py --confirm {clause}")
    proofs = theorems(faults, known)
    wanted = wanted_laws(table, least, faults)
    if program:
        check_runs(wanted, tests_of(program),
                   pathlib.Path(report).read_text(), faults)
    check_fuzz(table, faults)
    faults += check_constants.faults_of(ROOT)
    for name, text in (
            ("proptest/traceability/functions.cpp",
             functions_file(table, faults)),
            ("docs/traceability.md", table_file(table, known, proofs)),
            ("docs/proven.md", proven_file(known, proofs))):
        path = ROOT / name
        if write:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        if not path.exists() or path.read_text() != text:
            faults.append(f"{name} is not what --write writes")
    return faults, (f"{len(known)} clauses, {len(proofs)} theorems, "
                    f"{len(wanted)} laws")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--laws", nargs=2, default=(None, None),
                        metavar=("PROGRAM", "REPORT"))
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--confirm", nargs="+", default=[])
    options = parser.parse_args()
    if options.confirm:
        confirm(options.confirm, clauses())
    faults, what = check(options.write, *options.laws)
    for fault in faults:
        print(fault)
    print(f"{what}, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
