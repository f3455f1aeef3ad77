#!/usr/bin/env python3
"""Measures how often a second `halfspace view` shows a model that turns.

    turning.py PROGRAM FILE [COUNT [OPTION...]]

A drag turns the model by COUNT moves, each of which waits until its picture is
on the screen, and then by three times as many: the difference leaves out the
start. So what is printed is the rate of pictures, and the time from a move to
its picture, at the display of the environment (SDL_VIDEODRIVER, DISPLAY).
OPTIONS are of `halfspace view`; the usual one is --size 1920x1080.
"""

import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time


def events(count):
    chance = random.Random(1)
    x, y = 900, 500
    lines = ["wait", f"move {x} {y}", "press left", "wait"]
    for _ in range(count):
        x += chance.randint(-9, 12)
        y += chance.randint(-6, 6)
        lines += [f"move {x} {y}", "wait"]
    return "\n".join(lines + ["release left", "wait"]) + "\n"


def played(program, file, count, options, folder):
    """The seconds that so many moves take, and what the program says."""
    script = folder / "events"
    script.write_text(events(count))
    start = time.monotonic()
    done = subprocess.run([program, "view", file, *options, "--play", script],
                          check=True, capture_output=True, text=True)
    return time.monotonic() - start, done.stdout.strip()


def main():
    program, file = sys.argv[1:3]
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 100
    options = sys.argv[4:] or ["--size", "1920x1080"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        few, _ = played(program, file, count, options, folder)
        many, said = played(program, file, 3 * count, options, folder)
    each = (many - few) / (2 * count)
    window = re.search(r"window after (\d+) ms", said)
    print(f"{pathlib.Path(file).name}: {1 / each:.0f} pictures a second, "
          f"{1000 * each:.1f} ms from a move to its picture; "
          f"window after {window[1]} ms; {said.split('; ')[-1]}")


if __name__ == "__main__":
    main()
