#!/usr/bin/env python3
"""Plays random events to the window, without a screen.

    random_events.py PROGRAM FOLDER COUNT [SEED [MOST_MS [OPTION...]]]

The window must end by itself with status 0, write no complaint, and between two
looks at its input take no more of the processor than MOST_MS, if that is not 0;
the picture at the end is what `halfspace render` makes of its state. OPTIONS of
`halfspace view`, such as `--size 1920x1080` and the file that is opened first,
follow.
"""

import os
import pathlib
import random
import re
import subprocess
import sys

BOX = """OFF
8 6 0
0 0 0\n2 0 0\n0 2 0\n2 2 0\n0 0 2\n2 0 2\n0 2 2\n2 2 2
4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5
"""
KEYS = ["1", "3", "5", "7", "9", "Space", "Return", "Left", "Right", "Up", "A",
        "D", "K", "Tab", "O", "X", "N", "Z", "P", "H", "+", "-", "E", "S", "B",
        "G", "V", "T", "Shift+1", "Shift+7", "Shift+Left", "Ctrl+Up", "Ctrl+Z",
        "Ctrl+Y", "Backspace", "F1", "W", "C", "L", "Shift+K", ",", ".",
        "Ctrl+S", "Ctrl+E", "Escape"]


def made_line(chance, width, height):
    """One event; keys that end the window or write files are not among them."""
    x, y = chance.randrange(-20, width + 20), chance.randrange(-20, height + 20)
    held = chance.choice(["", "", "", " shift", " ctrl", " alt"])
    kind = chance.randrange(20)
    if kind < 8:
        return f"move {x} {y}{held}"
    if kind < 11:
        return f"press {chance.choice(['left', 'middle', 'right'])}{held}"
    if kind < 14:
        return f"release {chance.choice(['left', 'middle', 'right'])}"
    if kind == 14:
        return f"pinch {chance.uniform(-.2, .2):.3f} {x} {y}"
    if kind < 16:
        return f"wheel {chance.uniform(-3, 3):.3f}{held}"
    if kind < 18:
        return f"key {chance.choice(KEYS)}"
    if kind == 18:
        return chance.choice(["text 0.5", "text name", "wait", "wait",
                              f"size {chance.randrange(1, 700)} "
                              f"{chance.randrange(1, 500)}"])
    return "drop " + chance.choice(["box.off", "bad.off", "gone.off",
                                    "empty.stl", "."])


def main():
    program, folder, count = sys.argv[1:4]
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    most_ms = float(sys.argv[5]) if len(sys.argv) > 5 else 0
    options = sys.argv[6:] or ["box.off"]
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "box.off").write_text(BOX)
    (folder / "bad.off").write_text("OFF\n3 1 0\n1 2\n")
    (folder / "empty.stl").write_bytes(b"")
    chance = random.Random(seed)
    size = re.search(r"(\d+)x(\d+)", " ".join(options))
    # The panel is beside the picture, and the status line below.
    width, height = ((int(size[1]) + 316, int(size[2]) + 27) if size
                     else (700, 500))
    lines = [made_line(chance, width, height) for _ in range(int(count))]
    # Whatever was clicked: at the end there is a picture.
    lines += ["release left", "release middle", "release right",
              "drop box.off", "wait", "dump"]
    (folder / "events").write_text("\n".join(lines) + "\n")
    for old in folder.glob("out-*"):
        old.unlink()
    environment = dict(os.environ, SDL_VIDEODRIVER="dummy",
                       SDL_RENDER_DRIVER="software")
    done = subprocess.run(
        [program, "view", *options, "--play", "events", "--dump",
         "out-%d.png"], cwd=folder, env=environment, capture_output=True,
        text=True, timeout=3600, check=False)
    print(f"seed {seed}: {done.stdout}{done.stderr}", end="")
    if done.returncode != 0 or done.stderr:
        print(f"status {done.returncode}")
        return 1
    work = re.search(r"([0-9.]+) ms of the processor", done.stdout)
    if not work:
        return 1
    if 0 < most_ms < float(work[1]):
        print(f"the input waited for {work[1]} ms of work")
        return 1
    for view in sorted(folder.glob("out-*.view")):
        picture = view.with_suffix(".png")
        subprocess.run([program, "render", view.name, "-o", "again.png", "-q"],
                       cwd=folder, check=True)
        if picture.read_bytes() != (folder / "again.png").read_bytes():
            print(f"{picture} is not the picture of {view}")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
