#!/usr/bin/env python3
"""What other programs make of 3MF and GLB files.

  tools/judge_files.py FILE...

A .3mf is read by lib3mf (Debian's lib3mf1), strictly: it must give no warning,
and each mesh of it must be closed and oriented. A .glb is read by the validator
of Khronos, where node finds `gltf-validator` (npm install gltf-validator): it
must find no error and no warning. For each file a line says how many triangles
they saw, and, of a 3MF, the volume of the vertices that they read.

Exit status: 0 if all are fine, 1 if one is not, 2 if a judge is missing.
"""
import ctypes
import json
import pathlib
import subprocess
import sys

# From lib3mf's headers of 1.8: a call gives 0 where it succeeds, texts are
# filled in, and each function is as it stands there.
LIBRARY = "lib3MF.so.1"

VALIDATOR = """
const validator = require('gltf-validator');
const bytes = new Uint8Array(require('fs').readFileSync(process.argv[1]));
validator.validateBytes(bytes).then(report =>
  console.log(JSON.stringify({issues: report.issues.messages.filter(
    m => m.severity < 2), triangles: report.info.totalTriangleCount})));
"""


class Fault(Exception):
    pass


def call(library, name, *arguments):
    result = getattr(library, "lib3mf_" + name)(*arguments)
    if result != 0:
        raise Fault(f"{name} gives {result & 0xffffffff:#x}")


def volume_of(points, triangles):
    total = 0.0
    for a, b, c in triangles:
        p, q, r = points[a], points[b], points[c]
        total += (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                  p[2] * (q[0] * r[1] - q[1] * r[0])) / 6
    return total


def judge_3mf(path):
    library = ctypes.CDLL(LIBRARY)
    model, reader = ctypes.c_void_p(), ctypes.c_void_p()
    iterator, mesh = ctypes.c_void_p(), ctypes.c_void_p()
    call(library, "createmodel", ctypes.byref(model))
    call(library, "model_queryreader", model, b"3mf", ctypes.byref(reader))
    call(library, "reader_setstrictmodeactive", reader, ctypes.c_int(1))
    call(library, "reader_readfromfileutf8", reader, str(path).encode())
    number = ctypes.c_uint32()
    call(library, "reader_getwarningcount", reader, ctypes.byref(number))
    if number.value:
        raise Fault(f"lib3mf gives {number.value} warnings")
    call(library, "model_getmeshobjects", model, ctypes.byref(iterator))
    count, volume = 0, 0.0
    while True:
        there = ctypes.c_int()
        call(library, "resourceiterator_movenext", iterator, ctypes.byref(there))
        if not there.value:
            return count, volume
        call(library, "resourceiterator_getcurrent", iterator, ctypes.byref(mesh))
        fine = ctypes.c_int()
        call(library, "meshobject_ismanifoldandoriented", mesh, ctypes.byref(fine))
        if not fine.value:
            raise Fault("lib3mf finds a mesh that is not closed and oriented")
        call(library, "meshobject_getvertexcount", mesh, ctypes.byref(number))
        floats = (ctypes.c_float * (3 * number.value))()
        call(library, "meshobject_getvertices", mesh, floats, number, None)
        points = [floats[i:i + 3] for i in range(0, len(floats), 3)]
        call(library, "meshobject_gettrianglecount", mesh, ctypes.byref(number))
        corners = (ctypes.c_uint32 * (3 * number.value))()
        call(library, "meshobject_gettriangleindices", mesh, corners, number, None)
        triangles = [corners[i:i + 3] for i in range(0, len(corners), 3)]
        count += len(triangles)
        volume += volume_of(points, triangles)


def judge_glb(path):
    done = subprocess.run(["node", "-e", VALIDATOR, str(path)], capture_output=True,
                          text=True)
    if done.returncode:
        raise FileNotFoundError("gltf-validator: npm install gltf-validator")
    report = json.loads(done.stdout)
    if report["issues"]:
        raise Fault(f"the validator says {report['issues'][:3]}")
    return report["triangles"], None


def main():
    status = 0
    for name in sys.argv[1:]:
        path = pathlib.Path(name)
        try:
            judge = judge_3mf if path.suffix == ".3mf" else judge_glb
            count, volume = judge(path)
        except Fault as fault:
            print(f"{name}: {fault}")
            status = 1
        except OSError as missing:
            print(f"{name}: no judge: {missing}")
            return 2
        else:
            more = "" if volume is None else f", volume {volume:.9g}"
            print(f"{name}: {count} triangles{more}")
    return status


if __name__ == "__main__":
    sys.exit(main())
