#!/usr/bin/env python3
"""Makes the gallery of docs/figures from models made by code.

  make_figures.py PROGRAM [FOLDER]

PROGRAM is `halfspace`; FOLDER gets the figures; docs/figures if none is named.
"""

import pathlib
import subprocess
import sys
import tempfile

import models

HERE = pathlib.Path(__file__).resolve().parent

# A plate with a boss, a bore, holes and a rib, in millimetres.
PART = """
def hole(x, y) = translate(cylinder(4, 60), x, y, -5)
plate = translate(box(90, 60, 12), -45, -30, 0)
boss = cylinder(20, 30)
rib = translate(box(80, 8, 20), -40, -4, 4)
bore = translate(cylinder(11, 60), 0, 0, -5)
sunk = translate(cylinder(15, 12), 0, 0, 24)
body = (plate | boss | rib) - bore - sunk
result = body - hole(-37, 22) - hole(37, 22) - hole(-37, -22) - hole(37, -22)
"""

SCENE = ["--ortho", "--size", "480x480", "--decimals", "2"]
# Of each figure the model and the options; SVG without another ending.
FIGURES = {
    "bars": ("bars", [*SCENE, "--view", "top", "--fill", "part",
                      "--lines", "edges"]),
    "cubes": ("cubes", [*SCENE, "--fill", "part", "--lines", "edges"]),
    "surfaces": ("surfaces", [*SCENE, "--fill", "part", "--lines", "edges",
                              "--crease", "90"]),
    "moebius": ("moebius", [*SCENE, "--fill", "part", "--lines", "edges",
                            "--crease", "60"]),
    "vessel": ("vessel", [*SCENE, "--fill", "part", "--lines", "edges",
                          "--crease", "60"]),
    "plot": ("plot", [*SCENE, "--fill", "colour", "--axes"]),
    "glass": ("bars", [*SCENE, "--view", "top", "--alpha", "150"]),
    "bust.pdf": ("bust", [*SCENE, "--fill", "shaded", "--smooth", "60",
                          "--view", "front"]),
    "building": ("building", ["--eye", "30,-28,14", "--target", "6,4,4",
                              "--fov", "24", "--size", "640x480", "--fill",
                              "colour", "--lines", "edges", "--decimals",
                              "2"]),
    "part": ("part", ["--sheet", "a4", "--views", "front,left,top,iso",
                      "--hidden", "dashed", "--decimals", "2"]),
    "section": ("half", ["--sheet", "a4", "--views", "front,iso", "--cut",
                         "y=0", "--decimals", "2"]),
    "plotter": ("honeycomb", ["--lines", "edges", "--size", "640x480",
                              "--decimals", "1"]),
}


def main():
    program = sys.argv[1]
    out = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else HERE

    def run(*command):
        subprocess.run([program, *map(str, command), "-q"], check=True)

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        models.write_all(folder)
        (folder / "part.txt").write_text(PART)
        run("csg", "--script", folder / "part.txt", "-o", folder / "part.off")
        run("csg", "A & half(y > 0)", f"A={folder / 'part.off'}", "-o",
            folder / "half.off")
        for figure, (model, options) in FIGURES.items():
            name = figure if "." in figure else figure + ".svg"
            run("draw", folder / f"{model}.off", *options, "-o", out / name)
        run("draw", folder / "honeycomb.off", "--lines", "edges", "-o",
            out / "plotter.hpgl")


if __name__ == "__main__":
    main()
