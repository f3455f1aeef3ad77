#!/usr/bin/env python3
"""Counts the pixels whose centres lie in another region of a figure than that
of the polygon in the item image.

  wrong_pixels.py PROGRAM [--size N] [MESH ...]

PROGRAM: halfspace; N: 4000; without meshes the scenes of docs/figures/models.py.
The figure's paths, one a polygon and region, are rastered here: what is to the
right of an edge has the edge's region more or less, by its direction. Debian:
python3-numpy.
Exit status: 0 if no pixel is wrong.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "docs/figures"))
import models  # noqa: E402

SCENES = ("bars", "cubes", "surfaces", "moebius", "vessel")
PATH = re.compile(r'<path [^>]*d="([^"]*)"><title>([^<]*)</title>')
NUMBER = re.compile(r"-?[\d.]+")


def raster(svg, size):
    """The polygon of the region at each pixel's centre, -1 for none."""
    steps = numpy.zeros((size, size + 1), numpy.int64)
    regions = 0
    for data, title in PATH.findall(svg):
        regions += 1
        key = -1 if title == "background" else int(title.split()[1])
        for loop in data.split("Z")[:-1]:
            points = numpy.array(NUMBER.findall(loop), float).reshape(-1, 2)
            for (x0, y0), (x1, y1) in zip(points, numpy.roll(points, -1, 0)):
                low, high = min(y0, y1), max(y0, y1)
                rows = numpy.arange(max(0, int(numpy.ceil(low - 0.5))),
                                    min(size, int(numpy.ceil(high - 0.5))))
                if len(rows) == 0:
                    continue
                x = x0 + (rows + 0.5 - y0) * ((x1 - x0) / (y1 - y0))
                columns = numpy.clip(numpy.ceil(x - 0.5), 0, size).astype(int)
                # The region is on the right of its steps: above them if they
                # go to the left.
                steps[rows, columns] += (key + 2) * (1 if y1 < y0 else -1)
    return numpy.cumsum(steps, axis=1)[:, :size] - 2, regions


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--size", type=int, default=4000)
    parser.add_argument("meshes", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    size = arguments.size
    wrong = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if not arguments.meshes:
            models.write_all(folder)
        meshes = arguments.meshes or [folder / f"{s}.off" for s in SCENES]
        for mesh in meshes:
            view = ["--ortho", "--size", f"{size}x{size}", "-q"]
            for command in (
                    ["draw", mesh, "--by", "polygon", "--decimals", "12", "-o",
                     folder / "f.svg"],
                    ["render", mesh, "-o", folder / "f.png", "--ids",
                     folder / "f.npy"]):
                subprocess.run([arguments.program, *map(str, command), *view],
                               check=True)
            seen, regions = raster((folder / "f.svg").read_text(), size)
            count = int((seen != numpy.load(folder / "f.npy")).sum())
            wrong += count
            print(f"{mesh.stem}: {count} of {size * size} pixels wrong, "
                  f"{regions} regions", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
