#!/usr/bin/env python3
"""Reads a .scene file (spec/scene-format.md) and says what is in it."""
import re
import sys


def read_scene(path):
    scene = {"v": [], "p": [], "cull": False, "shade": "flat",
             "background": (255, 255, 255)}
    # Comments may hold any bytes. Lines end with a line feed alone.
    with open(path, encoding="latin-1", newline="\n") as file:
        lines = [re.findall(r"[^ \t\r\n]+", line.split("#")[0])
                 for line in file]
    lines = [line for line in lines if line]
    assert lines[0] == ["halfspace-scene", "1"] and lines[-1] == ["end"]
    for key, *words in lines[1:-1]:
        if key == "p":
            at = words.index("color")
            colors = [int(word) for word in words[at + 5:]]
            scene["p"].append({"corners": [int(word) for word in words[:at]],
                               "color": [int(w) for w in words[at + 1:at + 4]],
                               "colors": colors})
        elif key == "v":
            scene["v"].append(tuple(int(word) for word in words))
        else:  # unit, grid, eye, s0, sx, sy, near, size, cull, shade, ...
            plain = key in ("cull", "shade")
            scene[key] = (words or [True])[0] if plain else [int(w) for w in words]
    return scene


if __name__ == "__main__":
    for name, value in read_scene(sys.argv[1]).items():
        print(name, len(value) if name in ("v", "p") else value)
