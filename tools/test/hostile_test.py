#!/usr/bin/env python3
"""Tries to break the program with bad files, options and outputs.

  tools/test/hostile_test.py PROGRAM MAKE_MODEL FOLDER [TRIES] [SEED]

Each try damages a file or an option, or gives a folder, a device, a pipe, a
bomb or a text in UTF-16 for a file, or lets the disk be full or Ctrl-C be pressed
at some moment. It runs a command in 2 GB of address space and checks that

* it ends by itself, with status 0, 1 or 2, or 130 where Ctrl-C was pressed;
* with status 2 it prints one line on standard error, which begins with
  `halfspace: ` and names a file or an option of the command line;
* no file that it was given has changed, and what it was to write is as before
  or, with status 0, new;
* nothing is left beside.

Exit status: 0 if all tries hold, else 1.
"""
import io
import gzip
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import threading
import time
import zipfile
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples"))
from read_solid import crc32c  # noqa: E402

TIMEOUT_S = 60
ADDRESS_SPACE = 2_000_000_000

NUMBERS = ["0", "-1", "1e999", "nan", "inf", "-inf", "1e308", "1e-320", "", " ",
           "99999999999999999999", "-9223372036854775808", "0x10", "1,2", "x",
           "\u00e9", "%s%n", "../..", "1e18", "2147483648", "4294967296"]
OPTIONS = {
    "info": ["--grid", "--json", "--check", "--exact"],
    "render": ["--size", "--eye", "--target", "--up", "--fov", "--height",
               "--near", "--view", "--shade", "--alpha", "--threads", "--rows",
               "--impl", "--method", "--grid", "--repeat", "--background",
               "--color", "--light", "--heuristic", "--seed", "--candidates"],
    "build": ["--heuristic", "--candidates", "--seed", "--threads", "--grid",
              "--cut-weight", "--impl"],
    "scene": ["--size", "--eye", "--up", "--fov", "--near", "--shade"],
    "csg": ["--merge", "--grid", "--threads", "--impl", "--shadow", "--max-move",
            "--origin", "--stats", "--keep-origin", "--strict", "--repair"],
    "repair": ["--weld", "--thicken", "--without", "--close-all", "--threads"],
}
FLAGS = {"--json", "--check", "--exact", "--keep-origin", "--strict", "--repair",
         "--close-all"}
EXPRESSIONS = [
    "A - B", "A | (B", "A &", "~A", "A ^ B ^ A", "translate(A, 1e400, 0, 0)",
    "rotate(A, 0, 0, 0, 1)", "scale(A, 0)", "half(x < 1)", "A & half(x < 1)",
    "(" * 20000 + "A" + ")" * 20000, "A" + " | A" * 20000, "~" * 30001 + "A",
    "A B", "\"none.off\"", "A - \"", "matrix(A, 1, 2)", "", ";", "# nothing",
    "A = A", "half(0,0,0,0,0,0,0,0,0) & A", "A \x00 B", "\u00fc | A",
    "scale(A, 1e-300)", "scale(A, 1e300) | B", "A @ B", "A | B - C",
    "translate(" * 5000 + "A" + ", 1, 0, 0)" * 5000,
]


def png():
    def chunk(kind, data):
        return (len(data).to_bytes(4, "big") + kind + data +
                zlib.crc32(kind + data).to_bytes(4, "big"))
    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", bytes((0, 0, 0, 1, 0, 0, 0, 1, 8, 0, 0, 0, 0))) +
            chunk(b"IDAT", zlib.compress(b"\0\0")) + chunk(b"IEND", b""))


MODEL = "3D/3dmodel.model"


def package_of(entries):
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as package:
        for name, entry in entries.items():
            package.writestr(name, entry)
    return made.getvalue()


def entries_of(package):
    with zipfile.ZipFile(io.BytesIO(package)) as opened:
        return {name: opened.read(name) for name in opened.namelist()}


class Tries:
    def __init__(self, program, make_model, folder, seed, many):
        self.program = program
        self.folder = folder
        self.random = random.Random(seed)
        self.sources = {}
        for suffix in ("off", "obj", "ply", "stl", "scene", "3mf", "glb"):
            name = f"cube.{suffix}"
            subprocess.run([make_model, "cube", "-o", name], cwd=folder,
                           check=True, stdout=subprocess.DEVNULL)
            self.sources[suffix] = (folder / name).read_bytes()
        (folder / "b.off").write_bytes(self.sources["off"])
        # Exact solids: in bytes, and as a text that has no checksum.
        script = "translate(A, 1, 2, 3) - rotate(A, 1, 1, 1, 40)"
        for suffix, form in (("hsolid", "hsolid"),
                             ("text.hsolid", "hsolid-text")):
            done = subprocess.run(
                [program, "csg", script, "A=b.off", "-o", "-", "--format", form],
                cwd=folder, check=True, stdout=subprocess.PIPE)
            self.sources[suffix] = done.stdout
        text = self.sources["text.hsolid"]
        self.sources["text.hsolid"] = text[:-len("01234567\n")] + b"-\n"
        # What has an image, inside or beside it.
        (folder / "skin.png").write_bytes(png())
        (folder / "skin.mtl").write_text(
            "newmtl skin\nKd 1 0.5 0\nPm 0.5\nmap_Kd skin.png\n")
        self.sources["skin.obj"] = (
            b"mtllib skin.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
            b"vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 3/3 2/2\nf 1/1 2/2 4/3\n"
            b"f 1/1 4/2 3/3\nf 2/1 3/2 4/3\n")
        (folder / "skin.obj").write_bytes(self.sources["skin.obj"])
        for suffix in ("skin.3mf", "skin.glb", "skin.gltf", "skin.ply"):
            subprocess.run([program, "csg", "A", "A=skin.obj", "-o", suffix],
                           cwd=folder, check=True, stdout=subprocess.DEVNULL)
            self.sources[suffix] = (folder / suffix).read_bytes()
        for suffix in ("off", "ply"):
            self.sources[suffix + ".gz"] = gzip.compress(self.sources[suffix])
        self.bombs = self.made_bombs(2_900_000_000 if many else 50_000_000)
        self.wrong = 0

    def made_bombs(self, most):
        """Files of few bytes that claim many, or unpack to so many, by kind."""
        huge = bytes(1 << 20)
        packed = zlib.compressobj(9, wbits=31)
        zeros = b"".join(packed.compress(huge) for _ in range(most >> 20)) + packed.flush()
        model = entries_of(self.sources["3mf"])[MODEL]
        entity = (b'<?xml version="1.0"?><!DOCTYPE m [<!ENTITY a "' + b"x" * 1000 + b'">' +
                  b"".join(b'<!ENTITY %c "%s">' % (98 + k, b"&%c;" % (97 + k) * 20)
                           for k in range(8)) + b"]>" +
                  model[model.index(b"<model"):].replace(b"</model>", b"&i;</model>"))
        outside = model.replace(b"<model", b'<!DOCTYPE m [<!ENTITY e SYSTEM "file:///etc/'
                                b'passwd">]><model', 1)
        skin = entries_of(self.sources["skin.3mf"])
        texture, = [name for name in skin if name.endswith(".png")]
        blanks = b" " * min(most, 1_100_000_000)
        tag = model.replace(b"<model ", b"<model a='" + b"x" * min(most, 200_000_000) +
                            b"' ", 1)
        deep = b'{"asset":{"version":"2.0"},"x":' + b"[" * 100000 + b"]" * 100000 + b"}"
        return {
            "off.gz": [zeros],
            "3mf": [package_of({MODEL: entity}), package_of({MODEL: outside}),
                    package_of({MODEL: model + blanks}), package_of({MODEL: tag}),
                    package_of({**skin, texture: png() + blanks})],
            "gltf": [deep, b'{"asset":{"version":"2.0"},"buffers":[{"byteLength":'
                     b'9007199254740992,"uri":"data:;base64,AAAA"}]}'],
            "ply": [b"ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\n"
                    b"property float x\nproperty float y\nproperty float z\nelement face "
                    b"4294967295\nproperty list uchar int vertex_indices\nend_header\n" +
                    bytes(64),
                    b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                    b"float y\nproperty float z\nelement face 1\nproperty list uint int "
                    b"vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n4294967295 0 1 2\n"],
            "off": [b"OFF\n1000000000 1000000000 0\n0 0 0\n"],
            "stl": [bytes(80) + (4294967295).to_bytes(4, "little") + bytes(50)],
            "obj": [b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf" + b" 1 2 3" * 2_000_000 + b"\n"],
        }

    def put_strange(self, path):
        """Puts what is no mesh at the path; returns what ends it, or None."""
        kind = self.random.randrange(9)
        suffix = path.name.split(".", 1)[1]
        if kind < 4 and suffix in self.bombs:
            path.write_bytes(self.random.choice(self.bombs[suffix]))
        elif kind == 4:
            path.mkdir()
        elif kind == 5:
            path.symlink_to(self.random.choice(
                ["/dev/zero", "/dev/null", "/dev/urandom", "/dev/full", path.name,
                 "/proc/self/mem", "/", "none"]))
        elif kind == 6:
            os.mkfifo(path)
            data = self.damaged(self.sources["off"])
            self.is_over = threading.Event()
            return lambda: self.fill(path, data, self.is_over)
        else:
            text = self.sources[self.random.choice(["off", "obj", "scene"])].decode()
            path.write_bytes(text.encode(self.random.choice(["utf-16", "utf-32",
                                                             "utf-8-sig"])))
        return None

    @staticmethod
    def fill(path, data, is_over):
        """Writes to a pipe once it is read, until the command is over."""
        while not is_over.is_set():
            try:
                end = os.open(path, os.O_WRONLY | os.O_NONBLOCK)
            except OSError:
                time.sleep(0.005)
                continue
            try:
                os.write(end, data[:60000])
            except OSError:
                pass
            os.close(end)
            return

    def damaged(self, data):
        """The bytes with something wrong in them."""
        data = bytearray(data)
        kind = self.random.randrange(9)
        at = self.random.randrange(len(data))
        if kind == 0:
            return bytes(data[:at])
        if kind == 1:
            for _ in range(self.random.randrange(1, 20)):
                data[self.random.randrange(len(data))] = self.random.randrange(256)
            return bytes(data)
        if kind == 2:
            word = self.random.choice(NUMBERS).encode()
            return bytes(data[:at]) + b" " + word + b" " + bytes(data[at:])
        if kind == 3:
            end = self.random.randrange(at, len(data))
            return bytes(data[:at] + data[end:])
        if kind == 4:
            end = min(len(data), at + 200)
            return bytes(data[:end]) + bytes(data[at:end]) * 50 + bytes(data[end:])
        if kind == 5:
            return bytes(self.random.randrange(256)
                         for _ in range(self.random.randrange(300)))
        if kind == 6:
            lines = data.split(b"\n")
            self.random.shuffle(lines)
            return b"\n".join(lines)
        if kind == 7:
            words = data.split(b" ")
            for _ in range(3):
                words[self.random.randrange(len(words))] = self.random.choice(
                    NUMBERS).encode()
            return b" ".join(words)
        return b"\x1f\x8b" + bytes(data)

    def damaged_inside(self, suffix):
        """A whole package, or whole chunks, of a model with something wrong."""
        data = self.sources[suffix]
        if suffix.endswith("3mf"):
            made = io.BytesIO()
            with zipfile.ZipFile(io.BytesIO(data)) as package, \
                    zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as other:
                for name in package.namelist():
                    entry = package.read(name)
                    if name.endswith((".model", ".rels")) and \
                            self.random.randrange(4):
                        entry = self.damaged(entry)
                        if self.random.randrange(8) == 0:
                            entry += b" " * 50_000_000
                    other.writestr(name, entry)
            return made.getvalue()
        length = int.from_bytes(data[12:16], "little")
        text, rest = data[20:20 + length], data[20 + length:]
        text = self.damaged(text)
        if self.random.randrange(2):
            rest = rest[:8] + self.damaged(rest[8:])
        body = (len(text).to_bytes(4, "little") + b"JSON" + text +
                (len(rest) - 8).to_bytes(4, "little") + rest[4:])
        return data[:8] + (12 + len(body)).to_bytes(4, "little") + body

    def words(self, number):
        """A command, and the names of the files it may write."""
        suffix = self.random.choice(list(self.sources))
        source = f"try.{suffix}"
        data = self.sources[suffix]
        spoil = self.random.randrange(3)
        if spoil == 0:
            data = self.damaged(data)
            if suffix == "hsolid" and self.random.randrange(4):
                # What is behind the checksum is to be reached, too.
                data = data[:-4] + crc32c(data[:-4]).to_bytes(4, "little")
            if suffix.endswith(("3mf", "glb")) and self.random.randrange(3):
                data = self.damaged_inside(suffix)
        path = self.folder / source
        self.ending = None
        if path.is_symlink() or not path.is_dir():
            path.unlink(missing_ok=True)
        else:
            path.rmdir()
        if self.random.randrange(6) == 0:
            self.ending = self.put_strange(path)
        else:
            path.write_bytes(data)
        command = self.random.choice(list(OPTIONS))
        outputs = []
        if command == "repair":
            out = self.random.choice(["out.off", "out.obj", "out.3mf", "out.glb",
                                      source, "none/out.ply", "/dev/full", "folder.off"])
            words = [command, source, "-o", out]
            outputs.append(out)
        elif command == "csg":
            out = self.random.choice(["out.off", "out.stl", "out.3mf", "out.glb",
                                      "out.scene", source, "out.obj", "out.ply",
                                      "out.gltf", "out.step", "folder.off", "-",
                                      "out.hsolid", "b.off", "none/out.off", "/dev/full",
                                      "out.txt", ""])
            expression = (self.random.choice(EXPRESSIONS) if spoil == 1
                          else "A - B")
            words = [command, expression.replace("\0", "?"), f"A={source}",
                     "B=b.off", "-o", out]
            outputs.append(out)
        else:
            words = [command, source]
            out = {"info": "", "render": "out.png", "build": "out.tree",
                   "scene": "out.scene"}.get(command, "")
            if out and self.random.randrange(4) == 0:
                out = self.random.choice([source, "none/x.png", "/dev/full"])
            if out:
                words += ["-o", out]
                outputs.append(out)
        if command == "render" and "--size" not in words:
            words += ["--size=16x12"]
        if spoil == 2:
            for option in self.random.sample(OPTIONS[command],
                                             self.random.randrange(1, 3)):
                if option == "--size":
                    words = [w for w in words if not w.startswith("--size")]
                if option in FLAGS:
                    words.append(option)
                else:
                    words.append(f"{option}={self.random.choice(NUMBERS)}")
        return words, outputs

    def contents(self):
        return {path.name: path.read_bytes() for path in self.folder.iterdir()
                if path.is_file() and not path.is_symlink()}

    def run(self, number):
        words, outputs = self.words(number)
        before = self.contents()
        # No file may grow beyond so many bytes, as on a full disk.
        room = self.random.choice([0, 1, 100, 4000]) \
            if self.random.randrange(6) == 0 else None
        pressed_s = self.random.uniform(0, 0.1) if self.random.randrange(8) == 0 \
            else None

        def limit():
            if room is not None:
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
            # Sanitizers reserve more than that.
            if os.environ.get("HALFSPACE_SANITIZED"):
                return
            resource.setrlimit(resource.RLIMIT_AS,
                               (ADDRESS_SPACE, ADDRESS_SPACE))
        try:
            done = self.finished(words, limit, pressed_s)
        except subprocess.TimeoutExpired:
            return self.complain(number, words, f"over {TIMEOUT_S} s")
        error = done.stderr.decode(errors="replace")
        # A signal that comes before it is taken care of ends it as any program.
        may_stop = pressed_s is not None
        if done.returncode not in (0, 1, 2) and not (
                may_stop and done.returncode in (130, -signal.SIGINT)):
            return self.complain(number, words, f"status {done.returncode}: "
                                 + error[-300:])
        if done.returncode == 2:
            lines = error.split("\n")
            if len(lines) != 2 or lines[1] or not error.startswith("halfspace: "):
                return self.complain(number, words, f"not one line: {error!r}")
            options = [w.split("=")[0] for w in words if w.startswith("--")]
            places = ([w for w in words if "." in w or "/" in w] + options +
                      ["try.", "b.off", "line ", "expression", "camera", "-o",
                       "output"])
            if not any(place in error for place in places if place):
                return self.complain(number, words, f"no place: {error!r}")
        after = self.contents()
        for name, data in before.items():
            # Beside an output are its materials and images; what is given as
            # a name of one may be a number.
            if name in NUMBERS and done.returncode == 0:
                continue
            if name.startswith("out") and outputs and done.returncode == 0:
                continue
            if after.get(name) != data:
                return self.complain(number, words, f"{name} was changed")
        for name in after:
            if ".part-" in name:
                return self.complain(number, words, f"{name} was left")
        return None

    def finished(self, words, limit, pressed_s):
        """The command when it has ended, Ctrl-C being pressed meanwhile."""
        if self.ending:
            filling = threading.Thread(target=self.ending)
            filling.start()
        try:
            return self.communicated(words, limit, pressed_s)
        finally:
            if self.ending:
                self.is_over.set()
                filling.join()

    def communicated(self, words, limit, pressed_s):
        with subprocess.Popen([self.program, *words], cwd=self.folder,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, preexec_fn=limit) as process:
            if pressed_s is not None:
                time.sleep(pressed_s)
                process.send_signal(signal.SIGINT)
            try:
                out, error = process.communicate(timeout=TIMEOUT_S)
            except subprocess.TimeoutExpired:
                process.kill()
                raise
        return subprocess.CompletedProcess(words, process.returncode, out, error)

    def complain(self, number, words, what):
        shown = [w if len(w) < 80 else w[:80] + "..." for w in words]
        print(f"WRONG: try {number}: {shown}: {what}")
        self.wrong += 1


def main():
    program, make_model, folder = (pathlib.Path(a) for a in sys.argv[1:4])
    tries = int(sys.argv[4]) if len(sys.argv) > 4 else 500
    seed = int(sys.argv[5]) if len(sys.argv) > 5 else 1
    subprocess.run(["rm", "-rf", folder], check=True)
    os.makedirs(folder)
    (folder / "folder.off").mkdir()
    hostile = Tries(program.resolve(), make_model.resolve(), folder, seed, tries >= 500)
    for number in range(tries):
        hostile.run(number)
    print(f"{tries} tries, {hostile.wrong} wrong")
    return 1 if hostile.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
