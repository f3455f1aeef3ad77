#!/usr/bin/env python3
"""Properties of faces go through files and booleans.

  tools/test/attributes_test.py PROGRAM FOLDER

Two boxes have materials, groups, texture points and normals. Each texture
point is an affine function of its place, one for each box, so that whatever a
boolean makes of the faces can be checked by its places alone: every corner of
the result has the value of its box's function there. The results are read by
the readers below, which share nothing with the program, and by the program
again, format after format.
"""
import base64
import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
FOLDER = pathlib.Path(sys.argv[2])
WRONG = []

CUBE_FACES = [((0, 2, 3, 1), (0, 0, -1), "bottom"), ((4, 5, 7, 6), (0, 0, 1), "top"),
              ((0, 1, 5, 4), (0, -1, 0), "side"), ((2, 6, 7, 3), (0, 1, 0), "side"),
              ((0, 4, 6, 2), (-1, 0, 0), "side"), ((1, 3, 7, 5), (1, 0, 0), "side")]


def uv_a(p):
    return ((p[0] + 2 * p[1] + 3 * p[2]) / 64, (3 * p[0] - p[1] + p[2] + 8) / 64)


def uv_b(p):
    return ((p[0] - p[1] + p[2]) / 32 + 0.25, (p[0] + p[1] + 4 * p[2]) / 128)


def wrong(what):
    print("WRONG:", what)
    WRONG.append(what)


def write_box(name, low, high, material, color, uv):
    """An OBJ of six faces, and its MTL."""
    points = [tuple((low, high)[i >> k & 1][k] for k in range(3)) for i in range(8)]
    lines = [f"mtllib {name}.mtl", f"o {name}"]
    lines += ["v %r %r %r" % p for p in points]
    lines += ["vt %r %r" % uv(p) for p in points]
    lines += ["vn %r %r %r" % normal for _, normal, _ in CUBE_FACES]
    lines.append(f"usemtl {material}")
    for number, (corners, _, group) in enumerate(CUBE_FACES):
        lines.append(f"g {group}")
        lines.append("f " + " ".join(f"{c + 1}/{c + 1}/{number + 1}" for c in corners))
    (FOLDER / f"{name}.obj").write_text("\n".join(lines) + "\n")
    (FOLDER / f"{name}.mtl").write_text(
        f"newmtl {material}\nKd {color[0]} {color[1]} {color[2]}\nd 0.5\n"
        "newmtl unused\nKd 1 1 1\n")


def run(*words, status=0):
    done = subprocess.run([PROGRAM, *words], cwd=FOLDER, capture_output=True, text=True)
    if done.returncode != status:
        wrong(f"{words}: status {done.returncode}: {done.stderr}{done.stdout}")
    return done.stdout + done.stderr


def read_obj(path):
    points, texture, normals, faces, colors = [], [], [], [], {}
    material = group = item = None
    for line in path.read_text().splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "mtllib":
            name = None
            for entry in (path.parent / words[1]).read_text().splitlines():
                parts = entry.split()
                if parts[:1] == ["newmtl"]:
                    name = parts[1]
                if parts[:1] == ["Kd"]:
                    colors[name] = tuple(round(255 * float(x)) for x in parts[1:])
        values = words[1:]
        if words[0] == "v":
            points.append(tuple(map(float, values[:3])))
        elif words[0] == "vt":
            texture.append(tuple(map(float, values)))
        elif words[0] == "vn":
            normals.append(tuple(map(float, values)))
        elif words[0] == "usemtl":
            material = values[0]
        elif words[0] == "g":
            group = values[0]
        elif words[0] == "o":
            item = values[0]
        elif words[0] == "f":
            corners = [tuple(int(x) - 1 if x else None for x in v.split("/"))
                       for v in values]
            faces.append({"points": [points[c[0]] for c in corners],
                          "uv": [texture[c[1]] for c in corners],
                          "normal": [normals[c[2]] if c[2:] else None for c in corners],
                          "material": material, "group": group, "object": item,
                          "color": colors[material]})
    return faces


def read_ply(path):
    """In text, or in bytes of little endian."""
    data = path.read_bytes()
    tokens = None
    if b"format ascii" in data[:20]:
        tokens = iter(data[data.index(b"end_header\n"):].split()[1:])
    at = data.index(b"end_header\n") + len(b"end_header\n")
    sizes = {"double": "d", "int": "i", "uchar": "B", "uint": "I"}
    elements, names = [], {}
    for line in data[:at].decode().splitlines():
        words = line.split()
        if words[:2] == ["comment", "halfspace"]:
            names[words[2], int(words[3])] = words[4:]
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        if words[0] == "property":
            elements[-1][2].append(words[1:])

    def values(count, kind):
        nonlocal at
        if tokens is not None:
            return [(float if kind == "double" else int)(next(tokens))
                    for _ in range(count)]
        code = f"<{count}{sizes[kind]}"
        read = struct.unpack_from(code, data, at)
        at += struct.calcsize(code)
        return read
    rows = {}
    for name, count, properties in elements:
        rows[name] = []
        for _ in range(count):
            row = {}
            for what in properties:
                if what[0] == "list":
                    row[what[3]] = values(values(1, what[1])[0], what[2])
                else:
                    row[what[1]] = values(1, what[0])[0]
            rows[name].append(row)
    faces = []
    for row in rows["face"]:
        vertices = [rows["vertex"][v] for v in row["vertex_indices"]]
        uv, normal = row["texcoord"], row["corner_normal"]
        words = names["material", row["material"]]
        faces.append({"points": [(v["x"], v["y"], v["z"]) for v in vertices],
                      "uv": list(zip(uv[::2], uv[1::2])),
                      "normal": list(zip(normal[::3], normal[1::3], normal[2::3])),
                      "material": words[4], "color": tuple(map(int, words[:3])),
                      "group": names["group", row["group"]][0],
                      "object": names["object", row["object"]][0],
                      "origin": (row.get("origin_solid"), row.get("origin_polygon"))})
    return faces


def srgb(value):
    return 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055


def read_glb(path):
    data = path.read_bytes()
    assert data[:8] == b"glTF\2\0\0\0" and struct.unpack("<I", data[8:12])[0] == len(data)
    length, = struct.unpack("<I", data[12:16])
    return faces_of_gltf(json.loads(data[20:20 + length]), data[28 + length:])


def read_gltf(path):
    file = json.loads(path.read_text())
    buffer, = file["buffers"]
    body = base64.b64decode(buffer["uri"].split(";base64,")[1], validate=True)
    assert len(body) == buffer["byteLength"]
    return faces_of_gltf(file, body)


def faces_of_gltf(file, body):
    def numbers(i):
        accessor = file["accessors"][i]
        view = file["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        code = f"<{width}{'f' if accessor['componentType'] == 5126 else 'I'}"
        stride = view.get("byteStride", struct.calcsize(code))
        first = view["byteOffset"] + accessor["byteOffset"]
        return [struct.unpack_from(code, body, first + k * stride)
                for k in range(accessor["count"])]
    faces = []
    for node in file["nodes"]:
        for primitive in file["meshes"][node["mesh"]]["primitives"]:
            attributes = {k: numbers(v) for k, v in primitive["attributes"].items()}
            indices = [i for i, in numbers(primitive["indices"])]
            material = file["materials"][primitive["material"]]
            color = material["pbrMetallicRoughness"]["baseColorFactor"]
            origins = [[v for v, in numbers(primitive["extras"][k])]
                       if k in primitive["extras"] else None
                       for k in ("origin_solid", "origin_polygon")]
            for t in range(0, len(indices), 3):
                corners = indices[t:t + 3]
                turned = {k: [attributes[k][c] for c in corners]
                          for k in ("POSITION", "NORMAL")}
                faces.append({
                    "points": [(x, -z, y) for x, y, z in turned["POSITION"]],
                    "normal": [(x, -z, y) for x, y, z in turned["NORMAL"]],
                    "uv": [(u, 1 - v) for u, v in
                           (attributes["TEXCOORD_0"][c] for c in corners)],
                    "material": material["name"], "object": node["name"],
                    "color": tuple(round(255 * srgb(c)) for c in color[:3]),
                    "group": primitive["extras"]["group"],
                    "origin": tuple(o[t // 3] if o else None for o in origins)})
    return faces


def read_3mf(path):
    space = {"c": "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
             "t": "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07"}
    root = ElementTree.fromstring(zipfile.ZipFile(path).read("3D/3dmodel.model"))
    bases = root.findall(".//c:base", space)
    points = [tuple(float(v.get(k)) for k in "xyz")
              for v in root.findall(".//c:vertex", space)]
    faces = []
    for triangle in root.findall(".//c:triangle", space):
        base = bases[int(triangle.get("p1"))]
        digits = base.get("displaycolor")
        faces.append({"points": [points[int(triangle.get(k))] for k in ("v1", "v2", "v3")],
                      "material": base.get("name"), "color": tuple(
                          int(digits[k:k + 2], 16) for k in (1, 3, 5)),
                      "origin": tuple(int(triangle.get(k, -1)) for k in
                                      ("{urn:halfspace:origin}solid",
                                       "{urn:halfspace:origin}polygon"))})
    for group in root.findall(".//t:triangleset", space):
        kind = group.get("identifier").rstrip("0123456789")
        for part in group:
            first = int(part.get("index", part.get("startindex", "0")))
            for i in range(first, int(part.get("endindex", first)) + 1):
                faces[i][kind] = group.get("name")
    return faces


READERS = {".obj": read_obj, ".ply": read_ply, ".glb": read_glb, ".gltf": read_gltf,
           ".3mf": read_3mf}


def volume_of(faces):
    total = 0.0
    for face in faces:
        a = face["points"][0]
        for b, c in zip(face["points"][1:], face["points"][2:]):
            total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                      a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total


def normal_of(points):
    n = [0.0, 0.0, 0.0]
    for b, c in zip(points[1:], points[2:]):
        u = [b[k] - points[0][k] for k in range(3)]
        v = [c[k] - points[0][k] for k in range(3)]
        for k in range(3):
            n[k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]
    length = math.hypot(*n)
    return [x / length for x in n]


def check(name, volume, map_b, tolerance, origins=False):
    """Whether the faces of a result have what their boxes say at each corner."""
    faces = READERS[pathlib.Path(name).suffix](FOLDER / name)
    if abs(volume_of(faces) - volume) > 1e-5:
        wrong(f"{name}: volume {volume_of(faces)}, not {volume}")
    seen = set()
    for face in faces:
        is_b = face["material"] == "blue"
        seen.add((face["material"], face["group"]))
        if face["color"] != ((0, 51, 255) if is_b else (204, 0, 102)):
            wrong(f"{name}: {face['material']} is {face['color']}")
        if face["object"] != ("b" if is_b else "a"):
            wrong(f"{name}: {face['material']} of {face['object']}")
        normal = normal_of(face["points"])
        for k, point in enumerate(face["points"]):
            want = uv_b(map_b(point)) if is_b else uv_a(point)
            for got, value in zip(face.get("uv", [want] * 9)[k], want):
                if abs(got - value) > tolerance:
                    wrong(f"{name}: {face['material']} has {got}, not {value} at {point}")
            for got, value in zip(face.get("normal", [normal] * 9)[k], normal):
                if abs(got - value) > 1e-5:
                    wrong(f"{name}: normal {face['normal'][k]}, not {normal}")
        if origins:
            solid, polygon = face["origin"]
            if solid != int(is_b) or CUBE_FACES[polygon][2] != face["group"]:
                wrong(f"{name}: origin {face['origin']} of {face['material']}")
    if not seen >= {("red", "top"), ("red", "side"), ("blue", "side")}:
        wrong(f"{name}: only {sorted(seen)}")


def same(point):
    return point


def turned_back(point):
    """Of a turn by 30 degrees about z."""
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    return (c * point[0] + s * point[1], -s * point[0] + c * point[1], point[2])


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    write_box("a", (0, 0, 0), (4, 4, 4), "red", (0.8, 0, 0.4), uv_a)
    write_box("b", (1, 1, 1), (5, 5, 5), "blue", (0, 0.2, 1), uv_b)
    # One after another: each format is read back by the program, too.
    for suffix in READERS:
        out = run("csg", "A - B", "A=a.obj", "B=b.obj", "-o", f"cut{suffix}")
        lost = "texture points, normals" if suffix == ".3mf" else ""
        if ("has no room for" in out) != bool(lost) or lost not in out:
            wrong(f"cut{suffix}: {out}")
        check(f"cut{suffix}", 37, same, 1e-7)
        if suffix == ".3mf":
            continue
        for other in READERS:
            name = f"again-{suffix[1:]}{other}"
            run("csg", "A", f"A=cut{suffix}", "-o", name)
            check(name, 37, same, 1e-6)
    # Where corners are moved and rounded, numbers are those of the place.
    for suffix in READERS:
        run("csg", "A | rotate(B, 0, 0, 1, 30)", "A=a.obj", "B=b.obj", "-o",
            f"turned{suffix}", "--keep-origin")
        volume = volume_of(READERS[suffix](FOLDER / f"turned{suffix}"))
        check(f"turned{suffix}", volume, turned_back, 1e-6, origins=suffix != ".obj")
    # What is mirrored has its normals outside all the same, and what is cut out
    # by it has them inside.
    for suffix in READERS:
        run("csg", "A | translate(mirror(B, 1, 0, 0), 6, 0, 0)", "A=a.obj", "B=b.obj",
            "-o", f"joined{suffix}")
        check(f"joined{suffix}", 64 + 64 - 27, lambda p: (6 - p[0], p[1], p[2]), 1e-6)
        run("csg", "A - translate(mirror(B, 1, 0, 0), 6, 0, 0)", "A=a.obj", "B=b.obj",
            "-o", f"mirror{suffix}")
        check(f"mirror{suffix}", 37, lambda p: (6 - p[0], p[1], p[2]), 1e-6)
    # The bytes of a glTF may be beside it; they are an input, too.
    file = json.loads((FOLDER / "cut.gltf").read_text())
    body = base64.b64decode(file["buffers"][0]["uri"].split(",")[1])
    file["buffers"][0]["uri"] = "bytes.obj"
    (FOLDER / "apart.gltf").write_text(json.dumps(file))
    (FOLDER / "bytes.obj").write_bytes(body)
    run("csg", "A", "A=apart.gltf", "-o", "apart.ply")
    check("apart.ply", 37, same, 1e-6)
    run("csg", "A", "A=apart.gltf", "-o", "bytes.obj", status=2)
    if (FOLDER / "bytes.obj").read_bytes() != body:
        wrong("bytes.obj is another now")
    # A repair keeps them: a hole is filled by what the face beside it has.
    text = (FOLDER / "b.obj").read_text()
    (FOLDER / "open.obj").write_text(text.replace("f 5/5/2", "# f 5/5/2"))
    run("repair", "open.obj", "--close-all", "-o", "closed.obj")
    run("csg", "B", "B=b.obj", "-o", "whole.obj")
    faces, fine = read_obj(FOLDER / "closed.obj"), read_obj(FOLDER / "whole.obj")
    if len(faces) != 6 or abs(volume_of(faces) - 64) > 1e-9:
        wrong(f"closed.obj: {len(faces)} faces, volume {volume_of(faces)}")
    if sum(face in fine for face in faces) != 5:
        wrong("closed.obj: not five faces as they were")
    filling, = [face for face in faces if face not in fine]
    if (filling["material"], filling["group"], filling["normal"]) != \
            ("blue", "side", [None] * 4):
        wrong(f"closed.obj: {filling}")
    out = run("repair", "open.obj", "--close-all", "-o", "closed.stl")
    if "has no room for materials, names of objects, groups" not in out:
        wrong(f"closed.stl: {out}")
    run("repair", "open.obj", "--close-all", "-o", "b.obj", status=2)
    # Another program reads the packages, and finds closed meshes.
    judge = pathlib.Path(__file__).resolve().parents[1] / "judge_files.py"
    done = subprocess.run([sys.executable, judge, "cut.3mf", "turned.3mf"], cwd=FOLDER,
                          capture_output=True, text=True)
    if done.returncode or "cut.3mf: 24 triangles, volume 37\n" not in done.stdout:
        wrong(f"lib3mf: {done.stdout}{done.stderr}")
    # Of two objects of one number none is taken for the other.
    with zipfile.ZipFile(FOLDER / "cut.3mf") as package, \
            zipfile.ZipFile(FOLDER / "twice.3mf", "w") as other:
        for name in package.namelist():
            entry = package.read(name)
            if name.endswith(".model"):
                ids = re.findall(rb'<object id="(\d+)"', entry)
                entry = entry.replace(
                    b"</resources>",
                    b'<object id="' + ids[0] + b'"/></resources>')
            other.writestr(name, entry)
    out = run("info", "twice.3mf", status=2)
    if "is there twice" not in out:
        wrong(f"twice.3mf: {out}")
    # What has no room for something says so, and an input is not overwritten.
    out = run("csg", "A - B", "A=a.obj", "B=b.obj", "-o", "cut.stl")
    for word in ("materials", "groups", "normals", "texture points", "names of objects"):
        if word not in out:
            wrong(f"cut.stl: nothing is said of {word}: {out}")
    out = run("csg", "A - B", "A=a.obj", "B=b.obj", "-o", "b.obj", status=2)
    before = (FOLDER / "a.mtl").read_text()
    (FOLDER / "c.obj").write_text((FOLDER / "a.obj").read_text())
    (FOLDER / "a.obj").unlink()
    out = run("csg", "A - B", "A=c.obj", "B=b.obj", "-o", "a.obj", status=2)
    if "a.mtl" not in out or (FOLDER / "a.mtl").read_text() != before:
        wrong(f"a.mtl: {out}")
    return 1 if WRONG else 0


if __name__ == "__main__":
    sys.exit(main())
