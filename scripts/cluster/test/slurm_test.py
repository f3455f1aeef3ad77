#!/usr/bin/env python3
"""Runs a farm's work on a Slurm of four nodes, and loses a node on the way.

  scripts/cluster/test/slurm_test.py PROGRAM [--times 5] [--parts 5000]
                                     [--array 8000]

A film and a union of many parts, each by an array of jobs. At a random time a
node is killed with all that runs on it; it comes back when its jobs have been
given to others. The results must have the bytes of one process. With --array,
instead: one array of so many jobs, a small frame each, and a node lost on the
way. Exit status: 0 the bytes are the same, 1 not, 2 there is no Slurm.
"""

import argparse
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

import slurm

FARM = pathlib.Path(__file__).resolve().parents[1]
FACES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2),
         (1, 3, 7, 5))


def write_parts(folder, count):
    """Boxes of two sizes on a lattice: some overlap, touch, or are alone."""
    folder.mkdir()
    names = []
    for number in range(count):
        at = (number % 20, number // 20 % 25, number // 500)
        size = 1.25 if sum(at) % 3 else 0.75
        corners = "".join(
            " ".join(str(at[axis] + size * (corner >> axis & 1))
                     for axis in range(3)) + "\n" for corner in range(8))
        faces = "".join("4 " + " ".join(map(str, face)) + "\n"
                        for face in FACES)
        names.append(f"{folder.name}/{number:05d}.off")
        (folder.parent / names[-1]).write_text(f"OFF\n8 6 0\n{corners}{faces}")
    return names


class Work:
    """A folder with models, one process's results, and plans."""

    def __init__(self, folder, program, frames, parts, size="320x240"):
        self.folder, self.program, self.frames = folder, program, frames
        self.parts = write_parts(folder / "parts", parts)
        self.call(program, "csg", "sphere(3) - cylinder(1, 9)", "-q",
                  "-o", "part.stl")
        self.options = ["--turntable", str(frames), "--size", size,
                        "--shade", "gouraud", "--smooth", "30", "--aa", "2"]
        begin = time.monotonic()
        self.call(program, "render", "part.stl", *self.options, "-q",
                  "-o", "frame-%05d.png")
        if parts:
            self.call(program, "csg", "union", *self.parts, "-q", "-o",
                      "all.off")
        print(f"one process: {time.monotonic() - begin:.1f} s")

    def frame_names(self):
        return [f"frame-{number:05d}.png" for number in range(self.frames)]

    def call(self, *words, **options):
        subprocess.run(words, cwd=self.folder, check=True, **options)

    def plan_film(self, film, per_job):
        self.call(FARM / "farm.py", "film", film, "part.stl", "--program",
                  self.program, "--frames", f"0:{self.frames}", "--per-job",
                  str(per_job), "--", *self.options, stdout=subprocess.DEVNULL)

    def plan(self, film, union):
        self.plan_film(film, 2)
        self.call(FARM / "farm.py", "union", union, *self.parts, "--program",
                  self.program, "-o", "all.off", "--block", "50",
                  stdout=subprocess.DEVNULL)

    def differences(self, names_of):
        """Names of results, by plan, that have not the bytes of one process."""
        wrong = []
        for plan, names in names_of.items():
            for name in names:
                path = self.folder / plan / "results" / name
                if not path.exists() or path.read_bytes() != \
                        (self.folder / name).read_bytes():
                    wrong.append(f"{plan}/{name}")
            done = subprocess.run(
                ["sha256sum", "--quiet", "-c", "MANIFEST.sha256"],
                cwd=self.folder / plan / "results", text=True,
                capture_output=True)
            if done.returncode != 0:
                wrong.append(f"{plan}: {done.stdout}{done.stderr}")
        return wrong


def lose_a_node(cluster, after, seconds):
    """Loses a node after so many seconds, then waits for all jobs; what to
    print of it."""
    begin = time.monotonic()
    time.sleep(after)

    def at_work():
        return cluster.call("squeue", "-h", "-r", "-t", "running", "-w",
                            f"n{victim}").splitlines()
    victim = random.randrange(slurm.NODES) + 1
    cluster.wait(at_work, 60, f"a job on node n{victim}")
    lost = at_work()
    cluster.lose_node(victim)
    # Longer than Slurm waits for a node, and then as if it had been repaired.
    time.sleep(slurm.TIMEOUT + 15)
    cluster.start_node(victim)
    cluster.wait(lambda: cluster.jobs() == 0, seconds, "the jobs", every=1)
    return (f"node n{victim} lost after {after:.1f} s, {len(lost)} jobs on it; "
            f"all done after {time.monotonic() - begin:.1f} s")


def one_time(cluster, work, number, after):
    """One film and one union, with a node lost after so many seconds."""
    film, union = f"film-{number}", f"union-{number}"
    work.plan(film, union)
    for plan in film, union:
        work.call(FARM / "slurm.sh", plan, env=cluster.environment,
                  stdout=subprocess.DEVNULL)
    said = lose_a_node(cluster, after, 900)
    wrong = work.differences({film: work.frame_names(), union: ["all.off"]})
    print(f"{number}: {said}: "
          f"{'the same bytes' if not wrong else 'WRONG: ' + str(wrong[:3])}")
    return not wrong


def one_array(cluster, work, after):
    """One array of a job a frame, with a node lost."""
    work.plan_film("array", 1)
    work.call(FARM / "slurm.sh", "array", env=cluster.environment)
    said = lose_a_node(cluster, after, 3 * work.frames)
    wrong = work.differences({"array": work.frame_names()})
    print(f"{work.frames} jobs: {said}: "
          f"{'none is missing, the same bytes' if not wrong else wrong[:3]}")
    return not wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--times", type=int, default=1)
    parser.add_argument("--frames", type=int, default=120)
    parser.add_argument("--parts", type=int, default=5000)
    parser.add_argument("--array", type=int)
    parser.add_argument("--seed", type=int, default=time.time_ns() % 10**6)
    args = parser.parse_args()
    if not shutil.which("slurmctld"):
        print("slurm_test.py: there is no Slurm (apt-get install slurm-wlm)",
              file=sys.stderr)
        return 2
    random.seed(args.seed)
    print(f"seed {args.seed}")
    with tempfile.TemporaryDirectory(prefix="farm-") as folder:
        if args.array:
            work = Work(pathlib.Path(folder), args.program.resolve(),
                        args.array, 0, size="16x12")
        else:
            work = Work(pathlib.Path(folder), args.program.resolve(),
                        args.frames, args.parts)
        with slurm.Cluster(work.folder / "slurm") as cluster:
            if args.array:
                return 0 if one_array(cluster, work, random.uniform(5, 60)) \
                    else 1
            right = [one_time(cluster, work, number, random.uniform(1, 12))
                     for number in range(args.times)]
    return 0 if all(right) else 1


if __name__ == "__main__":
    sys.exit(main())
