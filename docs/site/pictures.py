"""The pictures of docs/guide.md that no command on its page makes.

They are made when the site is built, in the folder in which the guide's own
commands have run.
"""
import math
import subprocess

import PIL.Image


def write_floor(path, half=40):
    """A chequered floor."""
    side = range(-half, half + 1)
    lines = [f"OFF\n{len(side) ** 2} {4 * half * half} 0"]
    lines += [f"{x} {y} 0" for y in side for x in side]
    for y in range(2 * half):
        for x in range(2 * half):
            first = y * len(side) + x
            colour = "218 205 176" if (x + y) % 2 else "24 52 112"
            lines.append(f"4 {first} {first + 1} {first + len(side) + 1} "
                         f"{first + len(side)} {colour}")
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def write_torus(path, numbers, round_it=96, about=48):
    """A torus, and by vertex its curvature."""
    points, curvatures, faces = [], [], []
    for i in range(round_it):
        u = 2 * math.pi * i / round_it
        for k in range(about):
            v = 2 * math.pi * k / about
            out = 3 + math.cos(v)
            points.append(f"{out * math.cos(u):.6f} {out * math.sin(u):.6f} "
                          f"{math.sin(v):.6f}")
            curvatures.append(f"{math.cos(v) / out:.6f}")
            across, on = (i + 1) % round_it * about, (k + 1) % about
            faces.append(f"4 {i * about + k} {across + k} {across + on} "
                         f"{i * about + on}")
    path.write_text("\n".join([f"OFF\n{len(points)} {len(faces)} 0", *points,
                               *faces]) + "\n", encoding="ascii")
    numbers.write_text("\n".join(curvatures) + "\n", encoding="ascii")


def make(folder, environment):
    """Makes them all in the folder, by the programs of the environment."""
    def run(*words):
        subprocess.run(words, cwd=folder, env=environment, check=True,
                       stdout=subprocess.DEVNULL)

    def render(out, *words):
        run("halfspace", "render", *words, "-o", out)
    render("transparent.png", "cubes.off", "--alpha", "110")
    for name, how in (("figure.svg", ("--fill", "part", "--lines", "regions")),
                      ("drawing.svg", ("--fill", "none", "--lines", "edges",
                                       "--hidden", "dashed"))):
        run("halfspace", "draw", "cubes.off", *how, "-o", name)
    run("make_model", "pinwheel", "-o", "bars.off")
    render("depthsort.png", "bars.off", "--priority", "depthsort", "--aa",
           "4", "--lines", "features")
    # A frame of the film, in which the door is open.
    film = f"{environment['EXAMPLES']}/objects/village.path"
    for name, how in (("objects", ()),
                      ("objects-lines", ("--lines", "features", "--aa", "4"))):
        render(name + "-%02d.png", "village.objects", "--size", "800x500",
               "--path", film, "--frames", "14:15", *how)
        (folder / (name + "-14.png")).rename(folder / (name + ".png"))
    write_torus(folder / "torus.off", folder / "torus.csv")
    render("scalars.png", "torus.off", "--scalar", "torus.csv",
           "--scalar-on", "vertices", "--map", "coolwarm", "--legend",
           "--legend-title", "curvature", "--smooth", "60", "--aa", "4")
    (folder / "shot.events").write_text("wait\nshot window.png\nquit\n",
                                        encoding="ascii")
    environment = dict(environment, SDL_VIDEODRIVER="dummy",
                       SDL_RENDER_DRIVER="software")
    run("halfspace", "view", "plate.stl", "drill.stl", "--size", "1000x820",
        "--play", "shot.events")
    write_floor(folder / "floor.off")
    beside = PIL.Image.new("RGB", (732, 180), "white")
    for number, how in enumerate(((), ("--aa", "4"),
                                  ("--aa", "exact"))):
        part = folder / f"floor-{number}.png"
        render(part.name, "floor.off", "--eye", "0,-39,3", "--target",
               "0,-33,0", "--fov", "55", "--size", "240x180", "--ambient",
               "1", "--background", "198,220,240", *how)
        beside.paste(PIL.Image.open(part), (246 * number, 0))
    beside.save(folder / "antialiasing.png")
