"""Runs jobs of a plan, so that any may be killed, lost, or run twice.

A job writes into a folder of its own; its files go to results/ by renaming when
the command has ended well, and its record, with their checksums, comes last. So
a job is done if and only if there is its record. A job that is done already is
not run again, unless its command, a source or what it reads has changed, or a
file of its has.
"""

import hashlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

import plan as plans


def identity(plan, job):
    """What the job's outputs depend on, as one checksum.

    Of a job that it needs it takes the outputs' checksums from the record.
    """
    parts = [job.command, job.outputs, job.printed, plan.sources]
    for phase, number in job.needs:
        record = plan.record(phase, number)
        if record is None:
            raise plans.Error(f"{phase}: job {number} is not done yet")
        parts.append(record["outputs"])
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()


def all_outputs(job):
    return job.outputs + ([job.printed] if job.printed else [])


def is_done(plan, phase, number, job, made_of):
    record = plan.record(phase, number)
    if record is None or record["identity"] != made_of:
        return False
    for name in all_outputs(job):
        path = plan.results / name
        if not path.exists() or path.stat().st_size != \
                record["outputs"][name]["bytes"]:
            return False
        if plans.checksum(path) != record["outputs"][name]["sha256"]:
            return False
    return True


def words_of(plan, job, scratch):
    return [word.replace("@OUT@", str(scratch))
            .replace("@RESULTS@", str(plan.results)) for word in job.command]


def call(plan, job, scratch):
    """Runs the command; its exit status, as a shell has it."""
    printed = scratch / (job.printed or "printed.log")
    printed.parent.mkdir(parents=True, exist_ok=True)
    with open(printed, "wb") as out, open(scratch / "said.log", "wb") as said:
        try:
            child = subprocess.Popen(words_of(plan, job, scratch), stdout=out,
                                     stderr=said, stdin=subprocess.DEVNULL,
                                     cwd=plan.place)
        except OSError as error:
            said.write(f"{error}\n".encode())
            return 127

        def stop(number, _):
            child.send_signal(number)

        before = {number: signal.signal(number, stop)
                  for number in (signal.SIGTERM, signal.SIGINT)}
        status = child.wait()
        for number, action in before.items():
            signal.signal(number, action)
    return 128 - status if status < 0 else status


def keep_failure(plan, phase, number, scratch):
    """Puts what a failed job left where a person finds it; returns that."""
    place = plan.folder / "failed" / phase / str(number)
    shutil.rmtree(place, ignore_errors=True)
    place.parent.mkdir(parents=True, exist_ok=True)
    try:
        scratch.rename(place)
    except OSError:
        # The same job failed elsewhere at the same time, in the same way.
        shutil.rmtree(scratch, ignore_errors=True)
    return place


def failure(plan, phase, number, scratch, status, why):
    place = keep_failure(plan, phase, number, scratch)
    try:
        last = (place / "said.log").read_text(errors="replace").strip()
    except OSError:
        last = ""
    line = last.splitlines()[-1] if last else why
    raise JobFailed(f"{phase}: job {number}: {line} (status {status}; all of "
                    f"it is in {place})", status)


class JobFailed(Exception):
    def __init__(self, text, status):
        super().__init__(text)
        self.status = status


def run(plan, phase, number):
    """Runs a job that is not done; raises JobFailed with its exit status."""
    job = plan.job(phase, number)
    made_of = identity(plan, job)
    if is_done(plan, phase, number, job, made_of):
        return
    (plan.folder / "work").mkdir(exist_ok=True)
    scratch = pathlib.Path(tempfile.mkdtemp(
        prefix=f"{phase}-{number}-", dir=plan.folder / "work"))
    for name in job.outputs:
        (scratch / name).parent.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    status = call(plan, job, scratch)
    if status != 0:
        failure(plan, phase, number, scratch, status, "said nothing")
    outputs = {}
    for name in all_outputs(job):
        path = scratch / name
        if not path.exists():
            failure(plan, phase, number, scratch, 1, f"did not write {name}")
        outputs[name] = {"bytes": path.stat().st_size,
                         "sha256": plans.checksum(path)}
    for name in all_outputs(job):
        target = plan.results / name
        target.parent.mkdir(parents=True, exist_ok=True)
        (scratch / name).replace(target)
    shutil.rmtree(scratch, ignore_errors=True)
    shutil.rmtree(plan.folder / "failed" / phase / str(number),
                  ignore_errors=True)
    plans.replace(plan.record_file(phase, number), json.dumps({
        "identity": made_of, "outputs": outputs,
        "seconds": round(time.monotonic() - begin, 3),
        "machine": os.uname().nodename}) + "\n")


def missing(plan, phase):
    """The numbers of a phase's jobs without a record."""
    return [number for number in range(plan.phase(phase).count)
            if plan.record(phase, number) is None]


def manifest(plan):
    """Checks all there is, and writes results/MANIFEST.sha256.

    Raises Error if a job is not done, or a file or a source is not that of the
    records.
    """
    lines = []
    for source, there in plan.sources.items():
        path = pathlib.Path(plan.place) / source
        if not path.exists() or plans.checksum(path) != there:
            raise plans.Error(f"{source}: has changed since the plan was made")
    for phase in plan.phases:
        for number, job in enumerate(plan.jobs(phase.name)):
            if not is_done(plan, phase.name, number, job, identity(plan, job)):
                raise plans.Error(f"{phase.name}: job {number} is not done, or "
                                  "its files have changed: run it again")
            outputs = plan.record(phase.name, number)["outputs"]
            lines += [f"{outputs[name]['sha256']}  {name}\n"
                      for name in all_outputs(job)]
    plans.replace(plan.results / "MANIFEST.sha256", "".join(sorted(
        lines, key=lambda line: line[66:])))
    shutil.rmtree(plan.folder / "work", ignore_errors=True)
    return len(lines)
