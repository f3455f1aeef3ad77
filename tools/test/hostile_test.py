#!/usr/bin/env python3
"""Tries to break the program with bad files, options and outputs.

  tools/test/hostile_test.py PROGRAM MAKE_MODEL FOLDER [TRIES] [SEED]

Each try damages a file or an option, runs a command in 2 GB of address space
and checks that

* it ends by itself, with status 0, 1 or 2;
* with status 2 it prints one line on standard error, which begins with
  `halfspace: ` and names a file or an option of the command line;
* no file that it was given has changed, and what it was to write is as before
  or, with status 0, new;
* nothing is left beside.

Exit status: 0 if all tries hold, else 1.
"""
import io
import os
import pathlib
import random
import resource
import subprocess
import sys
import zipfile

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
    "csg": ["--merge", "--grid", "--threads", "--impl", "--shadow"],
}
FLAGS = {"--json", "--check", "--exact"}
EXPRESSIONS = [
    "A - B", "A | (B", "A &", "~A", "A ^ B ^ A", "translate(A, 1e400, 0, 0)",
    "rotate(A, 0, 0, 0, 1)", "scale(A, 0)", "half(x < 1)", "A & half(x < 1)",
    "(" * 20000 + "A" + ")" * 20000, "A" + " | A" * 20000, "~" * 30001 + "A",
    "A B", "\"none.off\"", "A - \"", "matrix(A, 1, 2)", "", ";", "# nothing",
    "A = A", "half(0,0,0,0,0,0,0,0,0) & A", "A \x00 B", "\u00fc | A",
    "scale(A, 1e-300)", "scale(A, 1e300) | B", "A @ B", "A | B - C",
    "translate(" * 5000 + "A" + ", 1, 0, 0)" * 5000,
]


class Tries:
    def __init__(self, program, make_model, folder, seed):
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
        self.wrong = 0

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
        if suffix == "3mf":
            made = io.BytesIO()
            with zipfile.ZipFile(io.BytesIO(data)) as package, \
                    zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as other:
                for name in package.namelist():
                    entry = package.read(name)
                    if name.endswith(".model"):
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
            if suffix in ("3mf", "glb") and self.random.randrange(3):
                data = self.damaged_inside(suffix)
        (self.folder / source).write_bytes(data)
        command = self.random.choice(list(OPTIONS))
        outputs = []
        if command == "csg":
            out = self.random.choice(["out.off", "out.stl", "out.3mf", "out.glb",
                                      "out.scene", source,
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
                   "scene": "out.scene"}[command]
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
        return {path.name: path.read_bytes()
                for path in self.folder.iterdir() if path.is_file()}

    def run(self, number):
        words, outputs = self.words(number)
        before = self.contents()

        def limit():
            # Sanitizers reserve more than that.
            if os.environ.get("HALFSPACE_SANITIZED"):
                return
            resource.setrlimit(resource.RLIMIT_AS,
                               (ADDRESS_SPACE, ADDRESS_SPACE))
        try:
            done = subprocess.run([self.program, *words], cwd=self.folder,
                                  stdin=subprocess.DEVNULL, timeout=TIMEOUT_S,
                                  preexec_fn=limit, capture_output=True)
        except subprocess.TimeoutExpired:
            return self.complain(number, words, f"over {TIMEOUT_S} s")
        error = done.stderr.decode(errors="replace")
        if done.returncode not in (0, 1, 2):
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
            if name in outputs and done.returncode == 0 and \
                    not name.startswith("try.") and name != "b.off":
                continue
            if after.get(name) != data:
                return self.complain(number, words, f"{name} was changed")
        for name in after:
            if ".part-" in name:
                return self.complain(number, words, f"{name} was left")
        return None

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
    hostile = Tries(program.resolve(), make_model.resolve(), folder, seed)
    for number in range(tries):
        hostile.run(number)
    print(f"{tries} tries, {hostile.wrong} wrong")
    return 1 if hostile.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
