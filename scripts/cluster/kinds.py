"""What jobs each kind of work has."""

import pathlib
import re
import shlex

from plan import Error, Job

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Options of `render` that its tree must be built with, too.
OF_TREES = ("--grid", "--shade", "--heuristic", "--candidates", "--seed",
            "--cut-weight")


def blocks(count, size):
    """(begin, end) of blocks of so many, the last one smaller."""
    if size < 1:
        raise Error(f"a job takes 1 or more, not {size}")
    return [(begin, min(begin + size, count))
            for begin in range(0, count, size)]


def pair_of(text, what, separator):
    match = re.fullmatch(rf"(\d+){separator}(\d+)", text)
    if not match:
        raise Error(f"{what} is two numbers with {separator} between, "
                    f"not {text}")
    return int(match[1]), int(match[2])


def tree_job(program, model, options):
    """The job that saves the tree of a film or an image."""
    with_values = [word for at, option in enumerate(options)
                   if option in OF_TREES
                   for word in options[at:at + 2]]
    return Job([program, "build", model, *with_values, "-q",
                "-o", "@OUT@/model.tree"], ["model.tree"])


def film(program, model, frames, a_job, ids, options):
    """The frames of a film, `a_job` of them a job, by one tree."""
    begin, end = pair_of(frames, "--frames", ":")
    if begin >= end:
        raise Error(f"--frames {frames} has no frame")
    jobs = []
    for first, last in blocks(end - begin, a_job):
        numbers = range(begin + first, begin + last)
        names = [f"frame-{number:05d}.png" for number in numbers]
        command = [program, "render", model, "--tree", "@RESULTS@/model.tree",
                   *options, "-q", "-o", "@OUT@/frame-%05d.png",
                   "--frames", f"{numbers[0]}:{numbers[-1] + 1}"]
        if ids:
            command += ["--ids", "@OUT@/frame-%05d.npy"]
            names += [f"frame-{number:05d}.npy" for number in numbers]
        jobs.append(Job(command, names, [("tree", 0)]))
    return {"tree": [tree_job(program, model, options)], "frames": jobs}


def image(program, model, size, a_job, options):
    """One image, `a_job` of its rows a job, and the whole of them."""
    _, height = pair_of(size, "--size", "x")
    rows, names = [], []
    for begin, end in blocks(height, a_job):
        names.append(f"rows/{begin:06d}.png")
        rows.append(Job(
            [program, "render", model, "--tree", "@RESULTS@/model.tree",
             *options, "--size", size, "-q", "--rows", f"{begin}:{end}",
             "-o", f"@OUT@/{names[-1]}"], [names[-1]], [("tree", 0)]))
    whole = Job([program, "join", *(f"@RESULTS@/{name}" for name in names),
                 "-q", "-o", "@OUT@/image.png"], ["image.png"],
                [("rows", number) for number in range(len(rows))])
    return {"tree": [tree_job(program, model, options)], "rows": rows,
            "whole": [whole]}


def views(program, command, model, views_file, options):
    """A drawing, a picture or a table of a model from each of many views."""
    jobs, names = [], set()
    for at, line in enumerate(views_file.read_text().splitlines(), 1):
        name, *of_view = shlex.split(line, comments=True) or [""]
        if not name:
            continue
        if name in names:
            raise Error(f"{views_file}:{at}: {name} is there already")
        if pathlib.PurePath(name).is_absolute() or ".." in name.split("/"):
            raise Error(f"{views_file}:{at}: {name} leaves the results")
        names.add(name)
        to = "--csv" if command == "seen" else "-o"
        jobs.append(Job([program, command, model, *options, *of_view, "-q", to,
                         f"@OUT@/{name}"], [name]))
    if not jobs:
        raise Error(f"{views_file}: has no view; a line is NAME OPTIONS")
    return {"views": jobs}


def union_job(program, files, output, options, needs):
    if len(files) == 1:
        what = [f'"{files[0]}"']
    else:
        what = ["union", *files]
    return Job([program, "csg", *what, *options, "-q",
                "-o", f"@OUT@/{output}"], [output], needs)


def union(program, parts, output, block, fan, options):
    """The union of many files: blocks of them, then results by `fan`.

    Results on the way are exact files, so nothing is rounded but the last.
    """
    if not parts:
        raise Error("there are no parts")
    if fan < 2:
        raise Error(f"--fan is 2 or more, not {fan}")
    phases = {}
    files = [(part, None) for part in parts]
    while len(files) > 1 or not phases:
        level = f"level-{len(phases)}"
        size = fan if phases else block
        parted = blocks(len(files), size)
        jobs, results = [], []
        for number, (begin, end) in enumerate(parted):
            last = len(parted) == 1
            name = output if last else f"{level}/{number:05d}.hsolid"
            taken = files[begin:end]
            jobs.append(union_job(program, [file for file, _ in taken], name,
                                  options if last else [],
                                  [need for _, need in taken if need]))
            results.append((f"@RESULTS@/{name}", (level, number)))
        phases[level] = jobs
        files = results
    return phases


def laws(program, shards, seconds, cases, law):
    """Laws with seeds of their own in each shard, and the summary of all."""
    verify = str(ROOT / "tools" / "verify.py")
    how = ["--seconds", str(seconds)] if seconds else ["--cases", str(cases)]
    how += ["--law", law] if law else []
    how += ["--program", program] if program else []
    names = [f"shards/{number:05d}.json" for number in range(shards)]
    jobs = [Job([verify, *how, "--jobs", "1", "--shard", f"{number}/{shards}",
                 "--out", "@OUT@/found", "--json", f"@OUT@/{name}"], [name])
            for number, name in enumerate(names)]
    merge = Job([verify, "merge", *(f"@RESULTS@/{name}" for name in names)],
                [], [("shards", number) for number in range(shards)],
                "summary.txt")
    return {"shards": jobs, "summary": [merge]}


def fuzz(target, jobs, runs, seed):
    """A fuzz target with a seed a job, and all rows for the table."""
    names = [f"rows/{number:05d}.txt" for number in range(jobs)]
    # Corpora of jobs at work must not meet.
    campaigns = [Job(["env", "HALFSPACE_CAMPAIGN_FOLDER=@OUT@/campaign",
                      str(ROOT / "tools" / "campaign.sh"), target, str(runs),
                      str(seed + number)], [], [], name)
                 for number, name in enumerate(names)]
    table = Job(["cat", *(f"@RESULTS@/{name}" for name in names)], [],
                [("campaigns", number) for number in range(jobs)], "rows.txt")
    return {"campaigns": campaigns, "table": [table]}
