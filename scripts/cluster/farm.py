#!/usr/bin/env python3
"""Shares work among many processes or machines: plans it, runs its jobs.

  farm.py film   DIR MODEL --frames 0:1000 [-- OPTIONS OF render]
  farm.py image  DIR MODEL --size 20000x20000 [-- OPTIONS OF render]
  farm.py views  DIR draw MODEL VIEWS.txt [-- OPTIONS OF draw]
  farm.py union  DIR PART... -o all.off [-- OPTIONS OF csg]
  farm.py laws   DIR --shards 100 --seconds 3600
  farm.py fuzz   DIR fuzz_split --jobs 100 --runs 1000000
  farm.py run    DIR PHASE [NUMBER | A:B | --first K --stride N]
  farm.py phases DIR
  farm.py status DIR
  farm.py manifest DIR

The first six write a plan into the folder DIR, which all machines must see.
scripts/cluster/slurm.sh, parallel.sh or the Snakefile then run its jobs; `run`
runs some of them here. A job may be killed, lost or run twice: its files appear
when they are whole, its record last, and what is done is not run again.
`manifest` checks all there is and writes DIR/results/MANIFEST.sha256.

Exit status: 0 all is done, 1 a job failed or is not done, 2 bad usage. `run` of
one job has the status of its command.
"""

import argparse
import os
import pathlib
import shutil
import sys

import kinds
import plan as plans
import run as runs

HERE = pathlib.Path(__file__).resolve().parent


def program_of(said):
    """The program to run: as said, that of this tree's build, or in PATH."""
    built = HERE.parents[1] / "build" / "release" / "tools" / "halfspace"
    found = said or (built if built.exists() else shutil.which("halfspace"))
    if not found or not os.access(found, os.X_OK):
        raise plans.Error(f"{said or 'halfspace'}: no such program: say "
                          "--program, or build it")
    return str(pathlib.Path(found).resolve())


def planned(args, rest):
    """(sources, phases) of the plan that the arguments ask for."""
    if args.kind == "laws":
        return [], kinds.laws(args.program, args.shards, args.seconds,
                              args.cases, args.law)
    if args.kind == "fuzz":
        return [], kinds.fuzz(args.target, args.jobs, args.runs, args.seed)
    program = program_of(args.program)
    if args.kind == "film":
        return [args.model], kinds.film(program, args.model, args.frames,
                                        args.per_job, args.ids, rest)
    if args.kind == "image":
        return [args.model], kinds.image(program, args.model, args.size,
                                         args.per_job, rest)
    if args.kind == "views":
        return [args.model, args.views], kinds.views(
            program, args.command, args.model, pathlib.Path(args.views), rest)
    parts = args.parts
    if args.list:
        parts = parts + pathlib.Path(args.list).read_text().split("\n")
    parts = [part for part in parts if part]
    return parts, kinds.union(program, parts, args.output, args.block,
                              args.fan, rest)


def numbers_of(text, count):
    """The jobs that 7, 3:9, 3: or nothing mean."""
    if not text:
        return range(count)
    try:
        if ":" not in text:
            return range(int(text), int(text) + 1)
        begin, _, end = text.partition(":")
        return range(int(begin or 0), min(int(end or count), count))
    except ValueError:
        raise plans.Error(f"jobs are N or A:B, not {text}")


def run(args):
    """Runs jobs one after another; goes on after one that fails."""
    plan = plans.Plan(args.folder)
    status = 0
    count = plan.phase(args.phase).count
    numbers = (range(args.first, count, args.stride) if args.stride
               else numbers_of(args.jobs, count))
    for number in numbers:
        try:
            runs.run(plan, args.phase, number)
        except runs.JobFailed as failed:
            print(f"farm.py: {failed}", file=sys.stderr)
            status = status or failed.status
    return status


def phases(args):
    for phase in plans.Plan(args.folder).phases:
        print(phase.name, phase.count)
    return 0


def status(args):
    """What is done, a line a phase; 1 if something is not."""
    plan = plans.Plan(args.folder)
    lacking = 0
    for phase in plan.phases:
        missing = runs.missing(plan, phase.name)
        lacking += len(missing)
        some = " ".join(map(str, missing[:8])) + (
            " ..." if len(missing) > 8 else "")
        print(f"{phase.name}: {phase.count - len(missing)} of {phase.count} "
              f"done{'; not ' + some if missing else ''}")
    return 1 if lacking else 0


def manifest(args):
    count = runs.manifest(plans.Plan(args.folder))
    print(f"{count} files are as their records say; their checksums are in "
          f"{args.folder}/results/MANIFEST.sha256")
    return 0


def parser():
    top = argparse.ArgumentParser(
        prog="farm.py", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    kind = top.add_subparsers(dest="kind", required=True, metavar="WHAT")

    def add(name, about, plans_work=True):
        one = kind.add_parser(name, help=about)
        one.add_argument("folder", metavar="DIR", help="the plan's folder")
        if plans_work and name not in ("laws", "fuzz"):
            one.add_argument("--program", help="the program halfspace, where "
                             "all machines have it")
        return one

    one = add("film", "frames of a film")
    one.add_argument("model")
    one.add_argument("--frames", required=True, metavar="A:B",
                     help="from A up to but not including B")
    one.add_argument("--per-job", type=int, default=10, metavar="N",
                     help="frames a job; 10 if not said")
    one.add_argument("--ids", action="store_true",
                     help="write the polygons' numbers, too")
    one = add("image", "one image by rows")
    one.add_argument("model")
    one.add_argument("--size", required=True, metavar="WxH")
    one.add_argument("--per-job", type=int, default=1000, metavar="N",
                     help="rows a job; 1000 if not said")
    one = add("views", "a drawing, picture or table from each of many views")
    one.add_argument("command", choices=("draw", "render", "seen"))
    one.add_argument("model")
    one.add_argument("views", help="a text file: a line is the file's NAME and "
                     "its own OPTIONS")
    one = add("union", "the union of many solids, by blocks")
    one.add_argument("parts", nargs="*")
    one.add_argument("--list", help="a file with more of them, one a line")
    one.add_argument("-o", "--output", required=True, metavar="NAME",
                     help="the result, in DIR/results")
    one.add_argument("--block", type=int, default=100, metavar="N",
                     help="parts a job; 100 if not said")
    one.add_argument("--fan", type=int, default=8, metavar="N",
                     help="results that one job joins; 8 if not said")
    one = add("laws", "laws, with seeds of their own in each shard")
    one.add_argument("--shards", type=int, required=True)
    how = one.add_mutually_exclusive_group(required=True)
    how.add_argument("--seconds", type=int)
    how.add_argument("--cases", type=int)
    one.add_argument("--law", help="S4 or S5.L3; all if not said")
    one.add_argument("--program", help="the property suite's, if it is not "
                     "that of build/release")
    one = add("fuzz", "a fuzz target, with a seed a job")
    one.add_argument("target")
    one.add_argument("--jobs", type=int, required=True)
    one.add_argument("--runs", type=int, required=True)
    one.add_argument("--seed", type=int, default=1)
    one = add("run", "run jobs of a plan here", False)
    one.add_argument("phase")
    one.add_argument("jobs", nargs="?", help="N or A:B; all if not said")
    one.add_argument("--first", type=int, default=0, metavar="K",
                     help="with --stride: job K and every N-th after it")
    one.add_argument("--stride", type=int, metavar="N")
    one.set_defaults(act=run)
    for name, about, act in (
            ("phases", "names of a plan's phases, and their jobs", phases),
            ("status", "what is done", status),
            ("manifest", "check all, and write the checksums", manifest)):
        add(name, about, False).set_defaults(act=act)
    return top


def main(words):
    rest = []
    if "--" in words:
        at = words.index("--")
        words, rest = words[:at], words[at + 1:]
    args = parser().parse_args(words)
    try:
        if hasattr(args, "act"):
            return args.act(args)
        sources, phases_of_it = planned(args, rest)
        plans.write(args.folder, args.kind, sources, phases_of_it)
        for name, jobs in phases_of_it.items():
            print(f"{name}: {len(jobs)} job{'s' * (len(jobs) != 1)}")
        return 0
    except plans.Error as error:
        print(f"farm.py: {error}", file=sys.stderr)
        return 2 if not hasattr(args, "act") else 1
    except OSError as error:
        print(f"farm.py: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
