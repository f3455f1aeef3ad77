#!/usr/bin/env python3
"""Images of materials go through files and booleans.

  tools/test/textures_test.py PROGRAM FOLDER

Two boxes have materials with an image each, a PNG and a JPEG, and texture points
that are an affine function of their place. Whatever a boolean makes of them, in
whichever format, each face must have its box's material, that very image and
the points of the function. Files are read by the readers below, which share
nothing with the program, and by the program again, format after format.
"""
import base64
import hashlib
import json
import pathlib
import struct
import subprocess
import sys
import urllib.parse
import xml.etree.ElementTree as ElementTree
import zipfile
import zlib

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
FOLDER = pathlib.Path(sys.argv[2])
WRONG = []

CUBE = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
SURFACES = {"wood": (0.25, 0.5), "stone": (None, 0.125)}


def wrong(what):
    print("WRONG:", what)
    WRONG.append(what)


def run(*words, status=0):
    done = subprocess.run([PROGRAM, *words], cwd=FOLDER, capture_output=True, text=True)
    if done.returncode != status:
        wrong(f"{words}: status {done.returncode}: {done.stderr}{done.stdout}")
    return done.stdout + done.stderr


def png():
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    rows = b"".join(b"\0" + bytes((60 * x, 60 * y, 90)[k] for x in range(4) for k in range(3))
                    for y in range(4))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def jpeg():
    """One grey pixel: each table of codes has one code, that of 0."""
    def segment(marker, data):
        return bytes((0xff, marker)) + struct.pack(">H", len(data) + 2) + data
    codes = bytes([1] + 15 * [0] + [0])
    return (b"\xff\xd8" + segment(0xe0, b"JFIF\0\1\1\0\0\1\0\1\0\0") +
            segment(0xdb, b"\0" + 64 * b"\1") +
            segment(0xc0, bytes((8, 0, 1, 0, 1, 1, 1, 0x11, 0))) +
            segment(0xc4, b"\0" + codes) + segment(0xc4, b"\x10" + codes) +
            segment(0xda, bytes((1, 1, 0, 0, 63, 0))) + b"\x3f\xff\xd9")


IMAGES = {"wood": png(), "stone": jpeg()}


def uv_of(material, p):
    if material == "wood":
        return ((p[0] + 2 * p[1] + 3 * p[2]) / 64, (3 * p[0] - p[1] + p[2] + 8) / 64)
    return ((p[0] - p[1] + p[2]) / 32 + 0.25, (p[0] + p[1] + 4 * p[2]) / 128)


def write_box(name, low, high, material, image):
    points = [tuple((low, high)[i >> k & 1][k] for k in range(3)) for i in range(8)]
    lines = [f"mtllib {name}.mtl"]
    lines += ["v %r %r %r" % p for p in points]
    lines += ["vt %r %r" % uv_of(material, p) for p in points]
    lines.append(f"usemtl {material}")
    lines += ["f " + " ".join(f"{c + 1}/{c + 1}" for c in corners) for corners in CUBE]
    (FOLDER / f"{name}.obj").write_text("\n".join(lines) + "\n")
    metallic, roughness = SURFACES[material]
    (FOLDER / f"{name}.mtl").write_text(
        f"newmtl {material}\nKd 0.8 0.6 0.4\nmap_Kd {image}\nPr {roughness}\n" +
        (f"Pm {metallic}\n" if metallic else ""))
    (FOLDER / image).parent.mkdir(exist_ok=True)
    (FOLDER / image).write_bytes(IMAGES[material])


def read_obj(path):
    points, texture, faces, images, surfaces = [], [], [], {}, {}
    material = name = None
    for line in path.read_text().splitlines():
        word, _, rest = line.partition(" ")
        if word == "mtllib":
            for entry in (path.parent / rest).read_text().splitlines():
                key, _, value = entry.partition(" ")
                if key == "newmtl":
                    name = value
                    surfaces[name] = [None, None]
                elif key == "map_Kd":
                    images[name] = (path.parent / value).read_bytes()
                elif key in ("Pm", "Pr"):
                    surfaces[name][key == "Pr"] = float(value)
        elif word in ("v", "vt"):
            (points if word == "v" else texture).append(tuple(map(float, rest.split())))
        elif word == "usemtl":
            material = rest
        elif word == "f":
            corners = [[int(n) - 1 for n in corner.split("/")] for corner in rest.split()]
            faces.append(([points[c[0]] for c in corners], [texture[c[1]] for c in corners],
                          material, images[material], tuple(surfaces[material])))
    return faces


def read_ply(path):
    header, _, body = path.read_bytes().partition(b"end_header\n")
    names, images, surfaces, elements, numbers = {}, {}, {}, [], None
    for line in header.decode().splitlines():
        words = line.split()
        if words[:2] == ["comment", "halfspace"] and words[2] == "material":
            names[int(words[3])] = words[-1]
        elif words[:3] == ["comment", "halfspace", "texture"]:
            images[int(words[3])] = (path.parent / " ".join(words[4:])).read_bytes()
        elif words[:3] == ["comment", "halfspace", "surface"]:
            surfaces[int(words[3])] = tuple(None if w == "none" else float(w)
                                            for w in words[4:])
        elif words[0] == "element":
            elements.append((int(words[2]), []))
        elif words[0] == "property":
            elements[-1][1].append(words[1:])
    if "ascii" in header.decode():
        numbers = iter(body.split())
    at = 0

    def number(kind):
        nonlocal at
        if numbers:
            return float(next(numbers))
        code = {"double": "<d", "int": "<i", "uchar": "<B", "uint": "<I"}[kind]
        at += struct.calcsize(code)
        return struct.unpack_from(code, body, at - struct.calcsize(code))[0]
    rows = [[{what[-1]: [number(what[2]) for _ in range(int(number(what[1])))]
              if what[0] == "list" else number(what[0]) for what in properties}
             for _ in range(count)] for count, properties in elements]
    faces = []
    for row in rows[1]:
        vertices = [rows[0][int(v)] for v in row["vertex_indices"]]
        uv = (list(zip(row["texcoord"][::2], row["texcoord"][1::2])) if "texcoord" in row
              else [(v["s"], v["t"]) for v in vertices])
        place = int(row["material"])
        faces.append(([(v["x"], v["y"], v["z"]) for v in vertices], uv, names[place],
                      images[place], surfaces[place]))
    return faces


def read_gltf(path):
    data = path.read_bytes()
    if path.suffix == ".glb":
        length, = struct.unpack_from("<I", data, 12)
        file, body = json.loads(data[20:20 + length]), data[28 + length:]
        if struct.unpack_from("<I", data, 20 + length)[0] % 4:
            wrong(f"{path.name}: the chunk of bytes is not of whole words")
    else:
        file = json.loads(data)
        body = base64.b64decode(file["buffers"][0]["uri"].split(",")[1])

    def part(i):
        view = file["bufferViews"][i]
        return body[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]

    def rows(i):
        accessor = file["accessors"][i]
        view = file["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor["type"]]
        code = f"<{width}{'f' if accessor['componentType'] == 5126 else 'I'}"
        first = view["byteOffset"] + accessor["byteOffset"]
        stride = view.get("byteStride", struct.calcsize(code))
        return [struct.unpack_from(code, body, first + k * stride)
                for k in range(accessor["count"])]
    faces = []
    for mesh in file["meshes"]:
        for primitive in mesh["primitives"]:
            points = [(x, -z, y) for x, y, z in rows(primitive["attributes"]["POSITION"])]
            uv = [(u, 1 - v) for u, v in rows(primitive["attributes"]["TEXCOORD_0"])]
            material = file["materials"][primitive["material"]]
            pbr = material["pbrMetallicRoughness"]
            texture = file["textures"][pbr["baseColorTexture"]["index"]]
            image = file["images"][texture["source"]]
            content = part(image["bufferView"])
            if image["mimeType"] != ("image/png" if content[:1] == b"\x89" else "image/jpeg"):
                wrong(f"{path.name}: {image}")
            indices = [i for i, in rows(primitive["indices"])]
            for t in range(0, len(indices), 3):
                corners = indices[t:t + 3]
                faces.append(([points[c] for c in corners], [uv[c] for c in corners],
                              material["name"], content,
                              (pbr["metallicFactor"] or None, pbr["roughnessFactor"])))
    return faces


def read_3mf(path):
    package = zipfile.ZipFile(path)
    core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    space = "{http://schemas.microsoft.com/3dmanufacturing/material/2015/02}"
    own = "{urn:halfspace:origin}"
    root = ElementTree.fromstring(package.read("3D/3dmodel.model"))
    base = root.find(f".//{core}basematerials")
    bases = [b.get("name") for b in base]
    surfaces = [(float(s.get("metallicness")) or None, float(s.get("roughness")))
                for s in root.find(f".//{space}pbmetallicdisplayproperties"
                                   f"[@id='{base.get('displaypropertiesid')}']")]
    targets = {r.get("Target") for r in
               ElementTree.fromstring(package.read("3D/_rels/3dmodel.model.rels"))}
    images, groups = {}, {}
    for texture in root.iter(space + "texture2d"):
        name = texture.get("path")
        if name not in targets:
            wrong(f"{path.name}: no relationship leads to {name}")
        images[texture.get("id")] = package.read(name.lstrip("/"))
    for group in root.iter(space + "texture2dgroup"):
        groups[group.get("id")] = group
    points = [tuple(float(v.get(k)) for k in "xyz") for v in root.iter(core + "vertex")]
    faces = []
    for triangle in root.iter(core + "triangle"):
        group = groups[triangle.get("pid")]
        if group.get(own + "pid") != base.get("id"):
            wrong(f"{path.name}: the material of {group.attrib}")
        places = [int(triangle.get(p, triangle.get("p1"))) for p in ("p1", "p2", "p3")]
        material = int(group.get(own + "pindex"))
        faces.append(([points[int(triangle.get(v))] for v in ("v1", "v2", "v3")],
                      [tuple(float(group[p].get(k)) for k in "uv") for p in places],
                      bases[material], images[group.get("texid")], surfaces[material]))
    return faces


READERS = {".obj": read_obj, ".ply": read_ply, ".glb": read_gltf, ".gltf": read_gltf,
           ".3mf": read_3mf}


def check(name, materials=frozenset(("wood", "stone"))):
    faces = READERS[pathlib.Path(name).suffix](FOLDER / name)
    if {material for _, _, material, _, _ in faces} != materials:
        wrong(f"{name}: other materials")
    for points, uv, material, image, surface in faces:
        if image != IMAGES[material]:
            wrong(f"{name}: {material} has the image {hashlib.md5(image).hexdigest()}")
        if surface != SURFACES[material]:
            wrong(f"{name}: {material} is {surface}")
        for point, got in zip(points, uv):
            want = uv_of(material, point)
            if max(abs(a - b) for a, b in zip(got, want)) > 1e-6:
                wrong(f"{name}: {material} has {got}, not {want}, at {point}")


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    write_box("a", (0, 0, 0), (4, 4, 4), "wood", "some wood.png")
    write_box("b", (1, 1, 1), (5, 5, 5), "stone", "images/stone.jpg")
    (FOLDER / "out").mkdir(exist_ok=True)
    for suffix in READERS:
        out = run("csg", "A - B", "A=a.obj", "B=b.obj", "-o",
                  f"cut{suffix}")
        if "warning" in out or "note" in out:
            wrong(f"cut{suffix}: {out}")
        check(f"cut{suffix}")
        for other in READERS:
            name = f"out/{suffix[1:]}{other}"
            out = run("csg", "A", f"A=cut{suffix}", "-o", name)
            if "warning" in out or "note" in out:
                wrong(f"{name}: {out}")
            check(name)
    # Two that have the same bytes are one image, and names are each one's own.
    run("csg", "A | translate(B, 0, 0, 9)", "A=cut.glb", "B=cut.gltf", "-o", "two.3mf")
    names = [n for n in zipfile.ZipFile(FOLDER / "two.3mf").namelist() if "Textures" in n]
    if len(names) != 2:
        wrong(f"two.3mf has the images {names}")
    # An image goes beside a file under a name that no other file has.
    names = {p.name: p.read_bytes() for p in (FOLDER / "out").glob("glb_*")}
    if sorted(names.values()) != sorted(IMAGES.values()):
        wrong(f"out has {sorted(names)}")
    taken = FOLDER / "again_some_wood.png"
    taken.write_bytes(b"other")
    for _ in range(2):
        run("csg", "A", "A=cut.glb", "-o", "again.obj")
        check("again.obj")
    if taken.read_bytes() != b"other" or not (FOLDER / "again_some_wood_2.png").is_file():
        wrong("an image was written over")
    if (FOLDER / "again_some_wood_3.png").exists():
        wrong("the same image was written twice")
    # An image is an input, too.
    run("csg", "A", "A=a.obj", "-o", "c.obj", "--origin", "some wood.png", status=2)
    check("cut.obj")
    # Images beside a glTF, with a name in a URI.
    file = json.loads((FOLDER / "cut.gltf").read_text())
    for image in file["images"]:
        view = image.pop("bufferView")
        part = file["bufferViews"][view]
        body = base64.b64decode(file["buffers"][0]["uri"].split(",")[1])
        name = "beside " + image["name"]
        (FOLDER / name).write_bytes(body[part["byteOffset"]:][:part["byteLength"]])
        image.pop("mimeType")
        image["uri"] = urllib.parse.quote(name)
    (FOLDER / "beside.gltf").write_text(json.dumps(file))
    for suffix in READERS:
        run("csg", "A", "A=beside.gltf", "-o", f"out/beside{suffix}")
        check(f"out/beside{suffix}")
    # What is not there, or no image, is said and left out.
    (FOLDER / "images/stone.jpg").write_bytes(b"no image")
    (FOLDER / "some wood.png").unlink()
    for suffix in (".glb", ".3mf"):
        out = run("csg", "A - B", "A=a.obj", "B=b.obj", "-o", f"lost{suffix}")
        for word in ("some wood.png' of 'wood' is not in it: it was not found",
                     "images/stone.jpg' of 'stone' is not in it: it is neither a PNG"):
            if word not in out:
                wrong(f"lost{suffix}: {out}")
        if suffix == ".3mf" and "no room for texture points" not in out:
            wrong(f"lost{suffix}: {out}")
    # Others read these files, strictly.
    judge = pathlib.Path(__file__).resolve().parents[1] / "judge_files.py"
    done = subprocess.run([sys.executable, judge, "cut.3mf", "two.3mf", "out/glb.3mf"],
                          cwd=FOLDER, capture_output=True, text=True)
    if done.returncode or "cut.3mf: 24 triangles, volume 37\n" not in done.stdout:
        wrong(f"lib3mf: {done.stdout}{done.stderr}")
    return 1 if WRONG else 0


if __name__ == "__main__":
    sys.exit(main())
