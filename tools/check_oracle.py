#!/usr/bin/env python3
"""Compares the oracle of spec/oracle with what Coq extracts from spec/coq.

  tools/check_oracle.py [--write]     --write replaces the oracle's files

Exit status: 0 if they are the same, else 1. Needs Coq.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

FILES = ("halfspace_oracle.ml", "halfspace_oracle.mli")


def run(command, folder):
    """What a command prints, if it fails."""
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    return done.stdout[-4000:] if done.returncode != 0 else None


def faults_of(theories, oracle, write=False):
    """What is wrong with the oracle's files, by the theories beside."""
    if said := run(["make", "--no-print-directory", "-j2"], theories):
        return [said]
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(oracle / "extract.v", folder)
        if said := run(["coqc", "-Q", str(theories), "Halfspace", "extract.v"],
                       folder):
            return [said]
        for name in FILES:
            fresh = (pathlib.Path(folder) / name).read_text()
            if write:
                (oracle / name).write_text(fresh)
            if (oracle / name).read_text() != fresh:
                faults.append(f"spec/oracle/{name} is not what Coq extracts: "
                              "tools/check_oracle.py --write")
    return faults


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    faults = faults_of(root / "spec/coq", root / "spec/oracle",
                       "--write" in sys.argv[1:])
    for fault in faults:
        print(fault)
    print(f"{len(FILES)} files of the oracle, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
