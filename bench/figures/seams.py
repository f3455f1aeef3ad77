#!/usr/bin/env python3
"""Counts the pixels in which a viewer shows background through the joints of a
figure's regions.

  seams.py PROGRAM [SIZE ...]        PROGRAM: halfspace; sizes 500 1000 2000

Each scene of docs/figures/models.py that has several regions is drawn on white
and on green, one of them shaded smoothly. A pixel that is the same on both, with
the eight round it, if everything is one region is inside: a viewer's rounding of an outline reaches no farther.
One that is inside and differs if there are all regions is a seam.
Viewers: rsvg-convert and Chromium for SVG, pdftoppm and mutool for PDF. Debian:
librsvg2-bin chromium poppler-utils mupdf-tools qpdf libxml2-utils python3-numpy
python3-pil.
Exit status: 0 if there are no seams and qpdf and xmllint accept the files.
"""

import pathlib
import subprocess
import sys
import tempfile

import numpy
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "docs/figures"))
import models  # noqa: E402

SCENES = ("bars", "cubes", "surfaces", "moebius", "vessel", "bust")
# Scenes whose regions are shaded, by gradients and meshes.
SHADED = {"bust": ["--shade", "gouraud", "--smooth", "60"]}
SIDE = 1000  # pixels of the figure itself


def run(*command):
    return subprocess.run([str(word) for word in command], check=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def rsvg(path, size, out):
    run("rsvg-convert", "-w", size, path.with_suffix(".svg"), "-o", out)


def chromium(path, size, out):
    page = out.with_suffix(".html")
    page.write_text('<body style="margin:0"><img width="%d" src="%s">'
                    % (size, path.with_suffix(".svg").name))
    run("chromium", "--headless", "--no-sandbox", "--disable-gpu",
        "--hide-scrollbars", "--force-device-scale-factor=1",
        f"--window-size={size},{size}", f"--screenshot={out}", page)


def poppler(path, size, out):
    run("pdftoppm", "-png", "-singlefile", "-scale-to", size,
        path.with_suffix(".pdf"), out.with_suffix(""))


def mupdf(path, size, out):
    run("mutool", "draw", "-w", size, "-h", size, "-o", out,
        path.with_suffix(".pdf"))


VIEWERS = {"rsvg-convert": rsvg, "chromium": chromium, "pdftoppm": poppler,
           "mutool": mupdf}


def inner(mask):
    """What is in a mask with all its neighbours."""
    padded = numpy.pad(mask, 1)
    height, width = mask.shape
    result = mask.copy()
    for j in range(3):
        for i in range(3):
            result &= padded[j:j + height, i:i + width]
    return result


def main():
    program, *sizes = sys.argv[1:]
    sizes = [int(size) for size in sizes] or [500, 1000, 2000]
    seams = faults = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        models.write_all(folder)
        for scene in SCENES:
            for by in ("all", "colour"):
                for ground in ("#ffffff", "#00ff00"):
                    for ending in ("svg", "pdf"):
                        path = folder / f"{by}{ground[1:]}.{ending}"
                        shade = SHADED.get(scene, []) if by == "colour" else []
                        run(program, "draw", folder / f"{scene}.off", "--by",
                            by, "--background", ground, "--size",
                            f"{SIDE}x{SIDE}", "--ortho", "-q", *shade, "-o",
                            path)
            for check in (("qpdf", "--check", folder / "colourffffff.pdf"),
                          ("xmllint", "--noout", folder / "colourffffff.svg")):
                faults += subprocess.run(
                    check, stdout=subprocess.DEVNULL).returncode != 0
            for viewer, draw in VIEWERS.items():
                for size in sizes:
                    seen = {}
                    for by in ("all", "colour"):
                        for ground in ("ffffff", "00ff00"):
                            out = folder / "seen.png"
                            draw(folder / (by + ground), size, out)
                            seen[by, ground] = numpy.asarray(
                                Image.open(out).convert("RGB"))
                    inside = inner((seen["all", "ffffff"] ==
                                    seen["all", "00ff00"]).all(axis=2))
                    other = (seen["colour", "ffffff"] !=
                             seen["colour", "00ff00"]).any(axis=2)
                    count = int((inside & other).sum())
                    seams += count
                    print(f"{scene:9} {viewer:13} {size:5}: {count} seams of "
                          f"{int(inside.sum())} pixels", flush=True)
    print(f"{seams} seams, {faults} files at fault")
    return 1 if seams or faults else 0


if __name__ == "__main__":
    sys.exit(main())
