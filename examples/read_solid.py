#!/usr/bin/env python3
"""Reads a .hsolid file (spec/solid-format.md); prints its size and volume."""
import gzip
import struct
import sys
from fractions import Fraction
from urllib.parse import unquote_to_bytes

MAGIC = b"\x89HSOLID\r\n\x1a\n"


def crc32c(data):
    table = []
    for n in range(256):
        for _ in range(8):
            n = n >> 1 ^ (0x82F63B78 if n & 1 else 0)
        table.append(n)
    crc = 0xFFFFFFFF
    for byte in data:
        crc = crc >> 8 ^ table[(crc ^ byte) & 255]
    return crc ^ 0xFFFFFFFF


class Bytes:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, form):
        values = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return values

    def integers(self, count, size):
        self.at += count * size
        return [int.from_bytes(self.data[at:at + size], "little", signed=True)
                for at in range(self.at - count * size, self.at, size)]

    def several(self, read):
        return [read() for _ in range(self.take("I")[0])]


def read_binary(data):
    assert crc32c(data[:-4]) == struct.unpack("<I", data[-4:])[0], "checksum"
    b = Bytes(data[:-4])
    b.at = len(MAGIC)
    version, flags, base, exponent, grid = b.take("IIiiI")
    assert version in (1, 2)
    solid = {"checked": bool(flags & 1), "conforming": bool(flags & 2),
             "unit": [base, exponent], "grid": grid,
             "point": b.several(lambda: b.take("qqq")),
             "plane": b.several(lambda: b.integers(3, 16) + b.integers(3, 8)),
             "meet": b.several(lambda: b.take("III")),
             "part": b.several(lambda: b.take(f"{b.take('I')[0]}s")[0]),
             "origin": b.several(lambda: b.take("II"))}
    faces = b.several(lambda: b.take("IIIBBBB"))
    counts = iter(b.several(lambda: b.take("I")[0]))
    corners = iter(b.several(lambda: b.take("II")))
    solid["face"] = [
        {"plane": plane, "side": "+-"[side & 1], "origin": origin,
         "color": None if side & 2 else color,
         "loops": [[next(corners) for _ in range(next(counts))]
                   for _ in range(loops)]}
        for plane, origin, loops, *color, side in faces]
    return solid


def read_text(data):
    solid = {key: [] for key in ("point", "plane", "meet", "part", "origin",
                                 "face")}
    solid |= {"checked": False, "conforming": False}
    for line in data.split(b"\n"):
        key, *words = line.split(b"#")[0].split() or [b"#"]
        key, words = key.decode(), [word.decode() for word in words]
        if key in ("point", "plane", "meet", "origin"):
            solid[key].append([int(word) for word in words])
        elif key == "face":
            plane, side, *color, origin = words
            solid["face"].append({"plane": int(plane), "side": side,
                                  "color": None if color == ["-"] else
                                  [int(c) for c in color],
                                  "origin": int(origin), "loops": []})
        elif key == "loop":
            solid["face"][-1]["loops"].append(
                [(int(v), 0xFFFFFFFF if p == "-" else int(p))
                 for v, p in zip(words[::2], words[1::2])])
        elif key == "part":
            solid["part"].append(unquote_to_bytes("".join(words)))
        elif key in ("unit", "grid"):
            solid[key] = [int(word) for word in words]
        elif key in ("checked", "conforming"):
            solid[key] = True
        elif key == "checksum" and words != ["-"]:
            body = data[:data.rindex(b"\nchecksum ") + 1]
            assert int(words[0], 16) == crc32c(body), "checksum"
    return solid


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0]]


def dot(u, v):
    return sum(a * b for a, b in zip(u, v))


def meet(planes):
    """The point of three planes, by Cramer's rule."""
    total = [0, 0, 0]
    for i in range(3):
        offset = dot(planes[i][:3], planes[i][3:])
        product = cross(planes[(i + 1) % 3][:3], planes[(i + 2) % 3][:3])
        total = [t + offset * p for t, p in zip(total, product)]
    below = dot(planes[0][:3], cross(planes[1][:3], planes[2][:3]))
    return [Fraction(t, below) for t in total]


def volume(solid):
    """Six volumes of tetrahedra from the origin, in model units."""
    vertices = [[Fraction(c) for c in point] for point in solid["point"]]
    vertices += [meet([solid["plane"][p] for p in m]) for m in solid["meet"]]
    base, exponent = solid["unit"]
    total = Fraction(0)
    for face in solid["face"]:
        for loop in face["loops"]:
            p = [vertices[v] for v, _ in loop]
            total += sum(dot(p[0], cross(p[i], p[i + 1]))
                         for i in range(1, len(p) - 1))
    return total / 6 * Fraction(base) ** (3 * exponent)


def read_solid(path):
    with open(path, "rb") as file:
        data = file.read()
    if data.startswith(b"\x1f\x8b"):
        data = gzip.decompress(data)
    return read_binary(data) if data.startswith(MAGIC) else read_text(data)


if __name__ == "__main__":
    read = read_solid(sys.argv[1])
    print(len(read["face"]), "faces,", len(read["part"]), "parts, volume",
          volume(read))
