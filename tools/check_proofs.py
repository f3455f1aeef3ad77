#!/usr/bin/env python3
"""Builds the theories of spec/coq and checks that they prove what they claim.

  tools/check_proofs.py [FOLDER]     FOLDER is spec/coq unless given

A file FOLDER/*.theorems names one theorem a line:

  name | file | clause | sentence

name: a Theorem, Lemma or Corollary of that file; clause: S4.7, or several with
commas; sentence: what it says, in English. An empty line or one that begins
with # says nothing.

Fails if a theory does not compile; if it holds an axiom, a parameter, a
variable outside a section, an unfinished proof, or a command that weakens
Coq's checks; if a line of a list is wrong or names a theorem twice; if "Print
Assumptions" of a theorem is not "Closed under the global context"; or if
coqchk, which checks the compiled files without trusting coqc, is not content.
"""

import concurrent.futures
import pathlib
import re
import subprocess
import sys

LIBRARY = "Halfspace"

# What is forbidden wherever it stands, as the first words of a sentence, or
# as an attribute or tactic within it.
FORBIDDEN = re.compile(
    r"\b(Axioms?|Conjectures?|Parameters?|Admitted|Admit|admit|give_up|Abort"
    r"|Primitive|Declare\s+ML\s+Module|bypass_check|Guard\s+Checking"
    r"|Positivity\s+Checking|Universe\s+Checking|type_in_type)\b")
OF_SECTIONS = re.compile(
    r"^(?:(?:Local|Global|Polymorphic|Monomorphic)\s+)*"
    r"(Hypothes[ie]s|Variables?|Context)\b")
OPENS = re.compile(r"^Section\s+(\w+)$")
OPENS_MODULE = re.compile(r"^Module\s+(?:Type\s+)?(\w+)\b(?!.*:=)")
CLOSES = re.compile(r"^End\s+(\w+)$")
PROVES = re.compile(r"^(?:(?:Local|Global|#\[\w+\])\s*)*"
                    r"(?:Theorem|Lemma|Corollary)\s+(\w+)")
CLAUSES = re.compile(r"^S\d+\.\d+(?:, S\d+\.\d+)*$")


def without_comments(text):
    """The text without its (nested) comments; strings become empty."""
    kept, depth, at = [], 0, 0
    while at < len(text):
        if text.startswith("(*", at):
            depth, at = depth + 1, at + 2
        elif depth and text.startswith("*)", at):
            depth, at = depth - 1, at + 2
        elif text[at] == '"':
            end = text.find('"', at + 1)
            at = len(text) if end < 0 else end + 1
            kept += [] if depth else ['""']
        else:
            kept += [] if depth else [text[at]]
            at += 1
    return "".join(kept)


def sentences_of(path):
    """The sentences of a theory, each on one line and without its full stop.
    Bullets and braces that stand before a sentence are left out."""
    text = without_comments(path.read_text())
    for sentence in re.split(r"\.(?=\s|$)", text):
        yield re.sub(r"^[-+*{}\s]+", "", " ".join(sentence.split()))


def faults_of(path):
    """What a theory must not hold, and the names of what it proves."""
    faults, proven, inside = [], set(), []
    for sentence in sentences_of(path):
        here = f"{path.name}: {sentence[:60]}"
        if FORBIDDEN.search(sentence):
            faults.append(f"{here}: forbidden")
        if OF_SECTIONS.match(sentence) and "section" not in inside:
            faults.append(f"{here}: outside a section")
        if OPENS.match(sentence):
            inside.append("section")
        elif OPENS_MODULE.match(sentence):
            inside.append("module")
        elif CLOSES.match(sentence) and inside:
            inside.pop()
        if match := PROVES.match(sentence):
            proven.add(match[1])
    return faults, proven


def theorems_in(folder, proven):
    """The theorems listed, as [(file's stem, name)], and what is wrong."""
    theorems, faults = [], []
    for path in sorted(folder.glob("*.theorems")):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if not line.strip() or line.startswith("#"):
                continue
            here = f"{path.name}:{number}"
            fields = [field.strip() for field in line.split("|")]
            if len(fields) != 4 or not all(fields):
                faults.append(f"{here}: not name | file | clause | sentence")
                continue
            name, file, clause, sentence = fields
            stem = file.removesuffix(".v")
            if name not in proven.get(file, ()):
                faults.append(f"{here}: {file} does not prove {name}")
            elif (stem, name) in theorems:
                faults.append(f"{here}: {name} is listed twice")
            else:
                theorems.append((stem, name))
            if not CLAUSES.match(clause):
                faults.append(f"{here}: no clause: {clause}")
            if not (sentence[0].isupper() and sentence.endswith(".")):
                faults.append(f"{here}: no sentence: {sentence}")
    if not theorems:
        faults.append("no theorem is listed")
    return theorems, faults


def run(command, folder, text=None):
    return subprocess.run(command, cwd=folder, input=text, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def toplevel(folder, stems, lines):
    """What Coq answers."""
    header = ["From Coq Require Import String."]
    header += [f"From {LIBRARY} Require {stem}." for stem in stems]
    return run(["coqtop", "-q", "-quiet", "-Q", ".", LIBRARY], folder,
               "\n".join(header + lines) + "\n").stdout


def closed(answer):
    return (re.search(r"(?:^|\s)Closed under the global context(?:$|\s)",
                      answer) and
            not re.search(r"\bError\b|\bAxioms:", answer))


def assumptions(folder, theorems):
    """What Coq says that the theorems rest on, if on anything."""
    if not theorems:
        return []
    stems = sorted({stem for stem, _ in theorems})
    # All of them in one term rest on nothing exactly if each does; asked one
    # by one, Coq would walk through all that they share once for each.
    terms = [f"@{LIBRARY}.{stem}.{name}" for stem, name in theorems]
    text = toplevel(folder, stems, [
        "Definition all_theorems :=\n  (" + ",\n   ".join(terms + ["tt"]) +
        ").", 'Check "theorems"%string.', "Print Assumptions all_theorems."])
    if "Error" not in text and closed(text.partition('"theorems"')[2]):
        return []
    lines = []
    for stem, name in theorems:
        # An answer follows each question, so none can go missing unseen.
        lines.append(f'Check "theorem {stem}.{name}"%string.')
        lines.append(f"Print Assumptions {LIBRARY}.{stem}.{name}.")
    answers = re.split(r'"theorem ([\w.]+)"', toplevel(folder, stems, lines))
    said = {}
    for name, text in zip(answers[1::2], answers[2::2]):
        said[name] = " ".join(text.split())
    faults = []
    for stem, name in theorems:
        text = said.get(f"{stem}.{name}", "Coq does not answer")
        if not closed(text):
            faults.append(f"{stem}.{name}: {text[:400]}")
    return faults or ["Coq does not say that the theorems rest on nothing"]


def independent_check(folder, stems):
    """What coqchk finds in the compiled theories."""
    done = run(["coqchk", "-silent", "-o", "-Q", ".", LIBRARY] +
               [f"{LIBRARY}.{stem}" for stem in stems], folder)
    text = " ".join(done.stdout.split())
    faults = [] if done.returncode == 0 else ["coqchk: " + text[-2000:]]
    for what in ("Axioms", "Constants/Inductives relying on type-in-type",
                 "Constants/Inductives relying on unsafe (co)fixpoints",
                 "Inductives whose positivity is assumed"):
        if f"* {what}: <none>" not in text:
            faults.append(f"coqchk: {what} are not <none>: {text[-2000:]}")
    return faults


def check(folder):
    """The number of theorems, and everything that is wrong."""
    faults, proven = [], {}
    theories = sorted(folder.glob("*.v"))
    for path in theories:
        wrong, proven[path.name] = faults_of(path)
        faults += wrong
    theorems, wrong = theorems_in(folder, proven)
    faults += wrong
    built = run(["make", "--no-print-directory", "-j2"], folder)
    if built.returncode != 0:
        return len(theorems), faults + ["make: " + built.stdout[-4000:]]
    with concurrent.futures.ThreadPoolExecutor() as pool:
        # Either takes most of a minute.
        asked = pool.submit(assumptions, folder, theorems)
        checked = pool.submit(independent_check, folder,
                              [path.stem for path in theories])
        faults += asked.result() + checked.result()
    return len(theorems), faults


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    folder = (pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else
              root / "spec" / "coq")
    count, faults = check(folder)
    for fault in faults:
        print(fault)
    print(f"{count} theorems, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
