#!/usr/bin/env python3
"""Tries tools/chains.py on programs that pretend to work scripts out.

One writes the script, with those of the files that it reads put in: a chain
then writes the bytes of one script. Another adds a sign for each file that
has half-spaces, and that must be found, and shrunk.
"""

import pathlib
import subprocess
import sys
import tempfile

CHAINS = pathlib.Path(__file__).resolve().parent.parent / "chains.py"

PROGRAM = """#!/usr/bin/env -S python3 -I -S
import re, sys
script, output = sys.argv[2], sys.argv[sys.argv.index("-o") + 1]
def read(match):
    text = open(match[1]).read()
    return text + ("!" if FAULT and "half" in text else "")
text = re.sub('"([a-z0-9]*.hsolid)"', read, script)
open(output, "w").write(text)
moved = 1 if "cylinder" in text else 0
print(f"operands: 2 of 8 polygons; moved {moved} coordinates")
"""


def expect(condition, what, text=""):
    if not condition:
        sys.exit(f"chains_test.py: not so: {what}\n{text}")


def run(program, *words):
    done = subprocess.run([sys.executable, CHAINS, program, *map(str, words)],
                          capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def main():
    with tempfile.TemporaryDirectory() as name:
        program = pathlib.Path(name) / "program"

        def make(fault):
            program.write_text(PROGRAM.replace("FAULT", str(fault)))
            program.chmod(0o755)

        make(False)
        status, text = run(program, "--count", 6, "--jobs", 2)
        expect(status == 0 and ", 0 differ" in text, "all are the same", text)
        expect("; 0 are rounded" not in text, "some are rounded", text)
        make(True)
        first = run(program, "--count", 6)
        expect(first[0] == 1 and "half(" in first[1], "a fault is found",
               first[1])
        expect(run(program, "--count", 6, "--jobs", 2) == first,
               "scripts are the same again")
        number = first[1].split()[1]
        status, text = run(program, "--first", number, "--count", 1, "--shrink",
                           "--out", pathlib.Path(name) / "out")
        expect(status == 1 and text.count("half(") >= 2,
               "one script is tried again", text)
        expect(text.count("chain:") == 2, "it is shrunk to one cut", text)
        expect((pathlib.Path(name) / "out" / f"1-{number}" /
                "whole.off").is_file(), "its files stay", text)
    print("chains.py: a fault is found again, shrunk, and its files are there")


if __name__ == "__main__":
    main()
