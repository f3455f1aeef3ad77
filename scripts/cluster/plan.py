"""A plan: phases of jobs, each a command, kept as files in a folder.

  plan.json               the kind, where commands run, sources, the phases
  jobs/PHASE/0003.jsonl   jobs 3,000 to 3,999 of a phase, one a line
  results/                what the jobs write
  done/PHASE/0003/17.json the record of a job that is done
  failed/PHASE/17/        what a job left that failed, with its log
  work/                   of jobs under way

A phase begins when that before it is done. A folder holds a million jobs as
well as ten: a job reads its own thousand of lines.
"""

import dataclasses
import hashlib
import json
import os
import pathlib
import socket

FORM = 1
IN_A_FILE = 1000


class Error(Exception):
    """What is wrong, in one line for the user."""


@dataclasses.dataclass(frozen=True)
class Job:
    """A command and what it makes.

    In words of `command`, @OUT@ is a folder of the job's own, from which
    `outputs` go to results/, and @RESULTS@ is results/. `needs` are the jobs of
    phases before, as (phase, number), whose outputs it reads. What it prints is
    the output `printed`, if that has a name.
    """
    command: list
    outputs: list
    needs: list = dataclasses.field(default_factory=list)
    printed: str = ""


@dataclasses.dataclass(frozen=True)
class Phase:
    name: str
    count: int


def checksum(path):
    """SHA-256 of a file, in hexadecimal."""
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()


def replace(path, text):
    """Writes a small file so that nobody ever sees a part of it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    aside = path.with_name(f"{path.name}.{unique()}")
    aside.write_text(text)
    aside.replace(path)


def unique():
    """A name that no other process on any machine of the farm has."""
    return f"{socket.gethostname()}-{os.getpid()}"


class Plan:
    """A plan's folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        try:
            plan = json.loads((self.folder / "plan.json").read_text())
        except FileNotFoundError:
            raise Error(f"{folder}: has no plan.json: make a plan first")
        except json.JSONDecodeError as error:
            raise Error(f"{folder}/plan.json: {error}")
        if plan.get("form") != FORM:
            raise Error(f"{folder}/plan.json: of another form than {FORM}")
        self.kind = plan["kind"]
        self.place = plan["place"]
        self.sources = plan["sources"]
        self.phases = [Phase(**phase) for phase in plan["phases"]]

    @property
    def results(self):
        return self.folder / "results"

    def phase(self, name):
        for phase in self.phases:
            if phase.name == name:
                return phase
        names = ", ".join(phase.name for phase in self.phases)
        raise Error(f"{self.folder}: has no phase {name}, but {names}")

    def job(self, phase, number):
        count = self.phase(phase).count
        if not 0 <= number < count:
            raise Error(f"{phase}: has no job {number}, but 0 to {count - 1}")
        with open(jobs_file(self.folder, phase, number)) as lines:
            for at, line in enumerate(lines):
                if at == number % IN_A_FILE:
                    return Job(**json.loads(line))
        raise Error(f"{phase}: job {number} is missing in its file")

    def jobs(self, phase):
        """All jobs of a phase, in order."""
        for begin in range(0, self.phase(phase).count, IN_A_FILE):
            with open(jobs_file(self.folder, phase, begin)) as lines:
                for line in lines:
                    yield Job(**json.loads(line))

    def record_file(self, phase, number):
        return (self.folder / "done" / phase / f"{number // IN_A_FILE:04}" /
                f"{number}.json")

    def record(self, phase, number):
        """What is noted of a job that is done; None if it is not."""
        try:
            return json.loads(self.record_file(phase, number).read_text())
        except (FileNotFoundError, json.JSONDecodeError):
            return None


def jobs_file(folder, phase, number):
    return folder / "jobs" / phase / f"{number // IN_A_FILE:04}.jsonl"


def write(folder, kind, sources, phases):
    """Writes a plan of phases, {name: [Job, ...]}, into a folder.

    The same plan again keeps what is done; another one is an error. Sources
    are files that the jobs read; their checksums are part of the plan.
    """
    folder = pathlib.Path(folder).resolve()
    plan = {
        "form": FORM,
        "kind": kind,
        "place": str(pathlib.Path.cwd()),
        "sources": {str(source): checksum(source) for source in sources},
        "phases": [{"name": name, "count": len(jobs)}
                   for name, jobs in phases.items()],
    }
    lines = {}
    for name, jobs in phases.items():
        for begin in range(0, len(jobs), IN_A_FILE):
            lines[jobs_file(folder, name, begin)] = "".join(
                json.dumps(dataclasses.asdict(job)) + "\n"
                for job in jobs[begin:begin + IN_A_FILE])
    text = json.dumps(plan, indent=1) + "\n"
    if (folder / "plan.json").exists():
        same = ((folder / "plan.json").read_text() == text and all(
            file.exists() and file.read_text() == job
            for file, job in lines.items()))
        if not same:
            raise Error(f"{folder}: holds another plan, or its sources have "
                        "changed: choose another folder")
        return
    for file, job in lines.items():
        replace(file, job)
    # Last: a folder that has it is whole.
    replace(folder / "plan.json", text)
