#!/usr/bin/env python3
"""Compiles and runs what the documents show.

  documents.py extract OUT.cpp DOCUMENT...
      writes the C++ blocks into one source, each with its place in the document

  documents.py run PROGRAM MAKE_MODEL FOLDER DOCUMENT...
      runs the shell blocks in FOLDER, beside small models with the names that
      the documents use

A block's fence says what it is: ```cpp is compiled; ```sh is run; ```text NAME
is a file for the blocks after it; ```sh build names targets and is not run,
for it builds what these tests are a part of. Exit status: 0 all is well, 1 a
command failed, 2 bad usage.
"""
import os
import pathlib
import subprocess
import sys

# The models that the documents' commands name, by the commands that make them.
MODELS = """
make_model cube -o cube.off
make_model interlocking-cubes -o cubes.off
cp "$EXAMPLES/csg/block.off" "$EXAMPLES/csg/drill.off" .
halfspace csg 'scale(A, 0.2)' A=block.off -o plate.stl
halfspace csg 'scale(A, 0.2)' A=drill.off -o drill.stl
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
        if not found:
            sys.exit(f"{document}: no C++ block")
        parts += [f'#line {first} "{document}"\n{text}\n'
                  for first, text in found]
    pathlib.Path(out).write_text("".join(parts), encoding="utf-8")


def shell(script, folder, environment, place):
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", script],
                          cwd=folder, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        print(f"{place}: exit status {done.returncode}\n{script}\n"
              f"{done.stdout}")
    return done.returncode == 0


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
        files, commands = [], []
        for words, first, text in blocks(document):
            if words[:1] == ["text"] and len(words) == 2:
                files.append((words[1], text))
            elif words == ["sh"]:
                commands.append((first, text))
        for name, text in files:
            (folder / name).write_text(text, encoding="utf-8")
        for first, text in commands:
            failed += not shell(text, folder, environment,
                                f"{document}:{first}")
        if not commands:
            sys.exit(f"{document}: no shell block")
        count += len(commands)
    print(f"{count} blocks run, {failed} failed")
    return 1 if failed else 0


def main():
    if len(sys.argv) >= 4 and sys.argv[1] == "extract":
        return extract(sys.argv[2], sys.argv[3:]) or 0
    if len(sys.argv) >= 6 and sys.argv[1] == "run":
        return run(*sys.argv[2:5], sys.argv[5:])
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
