#!/usr/bin/env python3
"""Compiles and runs what the documents show.

  documents.py extract OUT.cpp DOCUMENT...
      writes the C++ blocks into one source, each with its place in the document

  documents.py run PROGRAM MAKE_MODEL FOLDER DOCUMENT...
      runs the shell blocks in FOLDER, beside small models with the names that
      the documents use

  documents.py names ROOT
      looks up the files that documents name, and the papers that documents and
      sources cite by key (spec/bibliography.md)

A block's fence says what it is: ```cpp is compiled; ```sh is run; ```text
output is what the block before it prints, but for times; ```text NAME is a file
for the commands; ```sh build names targets and is not run, for it builds what
these tests are a part of. A page of docs/site may lack blocks; its Python is run
by python/test/test_document.py. Exit status: 0 all is well, 1 a command failed,
printed something else or a name is unknown, 2 bad usage.
"""
import os
import pathlib
import re
import subprocess
import sys

# The models that the documents' commands name, by the commands that make them.
MODELS = """
make_model cube -o cube.off
make_model interlocking-cubes -o cubes.off
cp "$EXAMPLES/csg/block.off" "$EXAMPLES/csg/drill.off" .
halfspace csg 'scale(A, 0.25)' A=block.off -o plate.stl
halfspace csg 'translate(scale(A, 0.25), 12, 8, 2)' A=drill.off -o drill.stl
halfspace csg 'A | translate(A, 1, 1, 1)' A=cube.off -o part.stl
cp cube.off a.off
halfspace csg 'translate(A, 0.5, 0, 0)' A=cube.off -o b.stl
halfspace csg 'translate(A, 0, 0.5, 0)' A=cube.off -o c.ply
halfspace csg 'translate(A, 0, 0, 0.5)' A=cube.off -o d.obj
"""


def blocks(document):
    """The fenced blocks: (words after the fence, number of the first line,
    text)."""
    words = None
    with open(document, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            if not line.startswith("```"):
                if words is not None:
                    text.append(line)
            elif words is None:
                words, first, text = line[3:].split(), number + 1, []
            else:
                yield words, first, "".join(text)
                words = None
    if words is not None:
        sys.exit(f"{document}:{first - 1}: a block without an end")


def extract(out, documents):
    parts = []
    for document in documents:
        found = [(first, text) for words, first, text in blocks(document)
                 if words == ["cpp"]]
        parts += [f'#line {first} "{document}"\n{text}\n'
                  for first, text in found]
        if not found and "/docs/site/" not in document:
            sys.exit(f"{document}: no C++ block")
    pathlib.Path(out).write_text("".join(parts), encoding="utf-8")


def without_times(text):
    return re.sub(r"[0-9.]+ m?s\b", "# ms", text)


def shell(script, folder, environment, place, output=None):
    """Whether the script ends well, and prints `output` if that is given."""
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", script],
                          cwd=folder, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        print(f"{place}: exit status {done.returncode}\n{script}\n"
              f"{done.stdout}")
        return False
    if output is not None and without_times(done.stdout) != without_times(
            output):
        print(f"{place}: prints\n{done.stdout}and not\n{output}")
        return False
    return True


def run(program, make_model, folder, documents):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for path in folder.iterdir():
        path.unlink()
    tools = os.pathsep.join(str(pathlib.Path(tool).resolve().parent)
                            for tool in (program, make_model))
    environment = dict(os.environ, EXAMPLES=str(pathlib.Path(
        __file__).resolve().parent.parent))
    environment["PATH"] = tools + os.pathsep + environment["PATH"]
    if not shell(MODELS, folder, environment, "the models"):
        return 1
    failed, count = 0, 0
    for document in documents:
        commands = []
        for words, first, text in blocks(document):
            if words == ["sh"]:
                commands.append([first, text, None])
            elif words == ["text", "output"]:
                commands[-1][2] = text
            elif words[:1] == ["text"] and len(words) == 2:
                (folder / words[1]).write_text(text, encoding="utf-8")
        for first, text, output in commands:
            failed += not shell(text, folder, environment,
                                f"{document}:{first}", output)
        if not commands and "/docs/site/" not in document:
            sys.exit(f"{document}: no shell block")
        count += len(commands)
    print(f"{count} blocks run, {failed} failed")
    return 1 if failed else 0


# A path that a document names, in backquotes.
PATH = re.compile(r"`((?:[A-Z]+\.md|(?:spec|ref|fast|shadow|io|csg|face|tools"
                  r"|proptest|fuzz|bench|examples|docs|cmake|scripts)"
                  r"/[\w./*-]+|\w+/[\w/]+\.[ch]pp))`")
KEY = re.compile(r"\b[A-Z]{2,4}[0-9]{2}[a-z]?\b")
# A document that a comment names.
DOCUMENT = re.compile(r"\b(?:docs|spec)/[\w/-]+\.md\b")
# Documents that speak of the past, or that scripts write.
OLD = ("docs/campaigns.md", "docs/decisions/")
# Words that look like keys and are none.
NO_KEYS = {"CLI11"}


def exists(root, named):
    """Whether some file has that path, from the root, in includes, or below
    the rooms of fast/src."""
    return any(any(root.glob(base + named)) for base in (
        "", "*/include/halfspace/", "fast/src/", "fast/src/raster/",
        "fast/src/raster/kernel/"))


def names(root):
    root = pathlib.Path(root)
    files = [path for part in root.iterdir()
             if part.name not in ("build", "out", ".git")
             for path in ([part] if part.is_file() else part.rglob("*"))]
    known = set(KEY.findall("\n".join(re.findall(
        r"^\*\*(\w+)\*\*", (root / "spec/bibliography.md").read_text(
            encoding="utf-8"), re.M))))
    wrong = []
    for path in sorted(files):
        name = path.relative_to(root)
        is_document = path.suffix == ".md"
        if not is_document and path.suffix not in (".hpp", ".cpp"):
            continue
        for number, line in enumerate(
                path.read_text(encoding="utf-8").splitlines(), 1):
            if not is_document and "//" not in line:
                continue
            comment = line if is_document else line[line.index("//"):]
            if not str(name).startswith(OLD):
                pattern = PATH if is_document else DOCUMENT
                wrong += [f"{name}:{number}: there is no {named}"
                          for named in pattern.findall(comment)
                          if not exists(root, named.rstrip("/"))]
            wrong += [f"{name}:{number}: {key} is not in the bibliography"
                      for key in KEY.findall(comment)
                      if key not in known | NO_KEYS]
    print("\n".join(wrong + [f"{len(wrong)} names are unknown"]))
    return 1 if wrong else 0


def main():
    if len(sys.argv) >= 4 and sys.argv[1] == "extract":
        return extract(sys.argv[2], sys.argv[3:]) or 0
    if len(sys.argv) >= 6 and sys.argv[1] == "run":
        return run(*sys.argv[2:5], sys.argv[5:])
    if len(sys.argv) == 3 and sys.argv[1] == "names":
        return names(sys.argv[2])
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
