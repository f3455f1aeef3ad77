#!/usr/bin/env python3
"""Checks laws for as long as you like, on new random cases all the time.

  tools/verify.py --law S4 --seconds 60            laws of one clause file
  tools/verify.py --law S5.L3 --cases 100000       one law
  tools/verify.py --seconds 600 --jobs 2           all laws
  tools/verify.py --law S5 --impl fast --seconds 60
  tools/verify.py --list
  tools/verify.py --shard 3/100 --seconds 3600 --json shard-3.json
  tools/verify.py merge shard-*.json

The laws are those of proptest/, as ctest runs them, but with other seeds: that
of a round follows from --seed, the shard and the number of the round, so shards
never try the same cases, and the same line tries the same ones again. Build
first: cmake --preset release && cmake --build --preset release.

The first failure of a law is shrunk and saved as a .scene file, and the line
that replays it is printed; the other laws go on. Exit status: 0 no law failed,
1 one did, 2 bad usage.
"""

import argparse
import collections
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
IMPLEMENTATIONS = {"ref": "0", "fast": "1"}
SAVED = re.compile(r"^saved as (.*\.scene)", re.MULTILINE)
BROKEN = re.compile(r"^.*: not so: .*$", re.MULTILINE)
FAILED = re.compile(r"^\[  FAILED  \] (\S+\.\S+?)(?:,.*)?(?: \(\d+ ms\))?$",
                    re.MULTILINE)
# Views and pairs are tried in rounds of so many times what ctest tries: enough
# for every trouble to come up in each. Rounds of a law become twice as long, up to
# the second number: each begins with a program and with the saved scenes.
ROUND, LONGEST_ROUND = 3, 192


def mixed(*numbers):
    """One seed from several numbers (splitmix64, S3.4)."""
    state = 0
    for number in numbers:
        z = (state + number + 0x9e3779b97f4a7c15) % 2**64
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9 % 2**64
        z = (z ^ z >> 27) * 0x94d049bb133111eb % 2**64
        state = z ^ z >> 31
    return state


def tests_of(program):
    """All laws of the program: names as GoogleTest has them."""
    listing = subprocess.run([program, "--gtest_list_tests"], check=True,
                             capture_output=True, text=True).stdout
    tests, suite = [], ""
    for line in listing.splitlines():
        word = line.split("#")[0].strip()
        if word.endswith("."):
            suite = word
        elif line.startswith("  ") and re.match(r"S\d", suite):
            tests.append(suite + word)
    return tests


def law_of(test):
    """S4.L3, of S4Screen/0.L3LitPixels..."""
    match = re.match(r"S(\d+)\w*/\d+\.L(\d+)", test)
    return f"S{match[1]}.L{match[2]}" if match else test


def chosen(tests, laws, implementation):
    """The tests of some laws, or of clause files, or of all."""
    def fits(test):
        number = test.partition("/")[2].partition(".")[0]
        if implementation and number != IMPLEMENTATIONS[implementation]:
            return False
        name = law_of(test)
        return not laws or any(
            name == law or name.startswith(law + ".") for law in laws)
    return [test for test in tests if fits(test)]


class Round:
    """One run of the program on one test, with a seed of its own."""

    def __init__(self, program, test, seed, folder, length):
        self.test, self.seed, self.folder = test, seed, folder
        self.length = length
        folder.mkdir(parents=True, exist_ok=True)
        self.report = folder / "report.json"
        self.log = open(folder / "log", "w+")
        environment = dict(
            os.environ, RC_PARAMS=f"seed={seed}", HALFSPACE_REPORT=self.report,
            HALFSPACE_COUNTEREXAMPLES=folder,
            HALFSPACE_PROPTEST_RUNS=str(length))
        self.process = subprocess.Popen(
            [program, f"--gtest_filter={test}"], stdout=self.log,
            stderr=subprocess.STDOUT, env=environment)

    def counts(self):
        try:
            return json.loads(self.report.read_text())
        except (OSError, ValueError):
            return {"cases": {}, "failures": {}, "notes": {}}

    def text(self):
        self.log.flush()
        return pathlib.Path(self.log.name).read_text(errors="replace")

    def close(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGKILL)
            self.process.wait()
        self.log.close()


class Campaign:
    def __init__(self, arguments, program, tests, folder):
        self.arguments, self.program, self.tests = arguments, program, tests
        self.folder = folder
        self.begin = time.monotonic()
        self.running, self.turn, self.rounds = [], 0, 0
        self.cases = collections.Counter()
        self.notes = collections.Counter()
        self.failures = []
        self.shown = 0.0

    def seconds(self):
        return time.monotonic() - self.begin

    def live(self):
        """Cases so far, those of rounds that still run among them."""
        total = sum(self.cases.values())
        for one in self.running:
            total += sum(one.counts()["cases"].values())
        return total

    def is_over(self):
        limit = self.arguments
        if limit.seconds and self.seconds() >= limit.seconds:
            return True
        return bool(limit.cases) and self.live() >= limit.cases

    def next_test(self):
        """Laws in turn; one that has failed is not tried again."""
        bad = {failure["test"] for failure in self.failures}
        good = [test for test in self.tests if test not in bad]
        if not good:
            return None
        self.turn += 1
        return good[(self.turn - 1) % len(good)]

    def start(self):
        while len(self.running) < self.arguments.jobs:
            test = self.next_test()
            if test is None:
                return
            self.rounds += 1
            seed = mixed(self.arguments.seed, self.arguments.shard[0],
                         self.arguments.shard[1], self.rounds)
            before = (self.turn - 1) // len(self.tests)
            length = min(LONGEST_ROUND, ROUND << min(before, 32))
            self.running.append(Round(self.program, test, seed,
                                      self.folder / str(self.rounds), length))

    def finish(self, one):
        """Takes the counts of a round that has ended, or is ended."""
        status = one.process.poll()
        one.close()
        counts = one.counts()
        self.cases.update(counts["cases"])
        self.notes.update(counts["notes"])
        # A round that is cut off has not failed, unless it had shrunk already.
        if status == 0 or (status is None and not counts["failures"]):
            return
        text = pathlib.Path(one.log.name).read_text(errors="replace")
        saved, broken = SAVED.findall(text), BROKEN.findall(text)
        scenes = sorted(str(p) for p in one.folder.glob("*.scene"))
        failure = {"test": one.test, "law": law_of(one.test),
                   "seed": one.seed, "length": one.length,
                   "log": one.log.name,
                   "scene": saved[-1] if saved else (scenes or [None])[0],
                   "message": broken[-1] if broken else
                              f"exit status {status}; see the log"}
        failure["replay"] = self.replay_line(failure)
        self.failures.append(failure)
        self.say(f"{failure['law']} FAILED: {failure['message']}\n"
                 f"  test   {failure['test']}\n  log    {failure['log']}\n"
                 f"  replay {failure['replay']}")

    def replay_line(self, failure):
        filter_ = f"{self.program} --gtest_filter='{failure['test']}'"
        if failure["scene"]:
            return f"HALFSPACE_REPLAY={failure['scene']} {filter_}"
        return (f"RC_PARAMS=seed={failure['seed']} "
                f"HALFSPACE_PROPTEST_RUNS={failure['length']} {filter_}")

    def say(self, text):
        if sys.stdout.isatty():
            print("\r\x1b[K", end="")
        print(text, flush=True)

    def show(self):
        """The line of progress, twice a second on a terminal."""
        every = 0.5 if sys.stdout.isatty() else 30.0
        if self.seconds() - self.shown < every:
            return
        self.shown = self.seconds()
        laws = sorted({law_of(one.test) for one in self.running})
        line = (f"{self.seconds():6.0f} s  {self.live():,} cases, "
                f"{self.live() / max(self.seconds(), 0.1):,.0f} a second, "
                f"{len(self.failures)} laws failed; now {' '.join(laws)}")
        looked = self.notes["views looked at"]
        if looked:
            rarest = min((n for n in self.notes if is_trouble(n)),
                         key=self.notes.get, default=None)
            if rarest:
                line += f"; rarest: {rarest} {self.notes[rarest] / looked:.1%}"
        end = "" if sys.stdout.isatty() else "\n"
        start = "\r\x1b[K" if sys.stdout.isatty() else ""
        print(start + line, end=end, flush=True)

    def run(self):
        try:
            while not self.is_over():
                self.start()
                if not self.running:
                    break
                for one in list(self.running):
                    if one.process.poll() is not None:
                        self.running.remove(one)
                        self.finish(one)
                self.show()
                time.sleep(0.1)
        except KeyboardInterrupt:
            self.say("stopped")
        for one in self.running:
            self.finish(one)
        self.running = []

    def summary(self):
        by_law = collections.Counter()
        for test, count in self.cases.items():
            by_law[law_of(test)] += count
        return {"seed": self.arguments.seed,
                "shards": [list(self.arguments.shard)],
                "seconds": round(self.seconds(), 1),
                "rounds": self.rounds, "cases": sum(by_law.values()),
                "cases_by_law": dict(sorted(by_law.items())),
                "cases_by_test": dict(sorted(self.cases.items())),
                "distribution": dict(sorted(self.notes.items())),
                "failures": self.failures}


def is_trouble(name):
    return name != "views looked at" and ", case " not in name


def merged(summaries):
    """One summary of several. Refuses the same shard twice."""
    result = {"seed": summaries[0]["seed"], "shards": [], "seconds": 0,
              "rounds": 0, "cases": 0, "failures": []}
    sums = {key: collections.Counter() for key in
            ("cases_by_law", "cases_by_test", "distribution")}
    for summary in summaries:
        for shard in summary["shards"]:
            if shard in result["shards"] and summary["seed"] == result["seed"]:
                sys.exit(f"verify.py: shard {shard} is there twice")
        for key in ("seconds", "rounds", "cases"):
            result[key] = round(result[key] + summary[key], 1)
        result["shards"] += summary["shards"]
        result["failures"] += summary["failures"]
        for key, counter in sums.items():
            counter.update(summary[key])
    result.update({key: dict(sorted(c.items())) for key, c in sums.items()})
    return result


def report(summary):
    """The summary, for people."""
    print(f"{summary['cases']:,} cases in {summary['rounds']:,} rounds and "
          f"{summary['seconds']:,} s; {len(summary['failures'])} laws failed")
    looked = summary["distribution"].get("views looked at", 0)
    if looked:
        print(f"of {looked:,} views looked at:")
        for name, count in summary["distribution"].items():
            if is_trouble(name):
                print(f"  {count / looked:6.1%}  {name}")
    for failure in summary["failures"]:
        print(f"{failure['law']}: {failure['message']}\n"
              f"  {failure['replay']}")


def parse(words):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--law", action="append", default=[],
                        help="S4, or S4.L3; more than once for several; "
                        "else all")
    parser.add_argument("--impl", choices=IMPLEMENTATIONS, default=None)
    parser.add_argument("--seconds", type=float, default=0)
    parser.add_argument("--cases", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--shard", default="0/1", metavar="I/N")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE")
    parser.add_argument("--out", type=pathlib.Path, metavar="FOLDER",
                        help="for logs and counterexamples")
    parser.add_argument("--program", type=pathlib.Path,
                        default=ROOT / "build/release/proptest/proptest")
    parser.add_argument("--list", action="store_true", help="laws, and stop")
    arguments = parser.parse_args(words)
    match = re.fullmatch(r"(\d+)/(\d+)", arguments.shard)
    if not match or int(match[1]) >= int(match[2]):
        parser.error("--shard wants I/N with I from 0 to N - 1")
    arguments.shard = (int(match[1]), int(match[2]))
    if not arguments.program.is_file():
        parser.error(f"there is no {arguments.program}: build it first")
    if arguments.jobs < 1:
        parser.error("--jobs wants at least 1")
    if not (arguments.seconds or arguments.cases or arguments.list):
        parser.error("say how long: --seconds or --cases")
    return parser, arguments


def write(path, summary):
    """Writes beside the file, then renames: it is never there in part."""
    beside = path.with_name(path.name + ".new")
    beside.write_text(json.dumps(summary, indent=1) + "\n")
    beside.rename(path)


def main(words):
    if words and words[0] == "merge":
        summary = merged([json.loads(pathlib.Path(word).read_text())
                          for word in words[1:]])
        report(summary)
        return 1 if summary["failures"] else 0
    parser, arguments = parse(words)
    tests = tests_of(arguments.program)
    for law in arguments.law:
        if not chosen(tests, [law], arguments.impl):
            parser.error(f"there is no law {law}")
    tests = chosen(tests, arguments.law, arguments.impl)
    if not tests:
        parser.error("there are no laws")
    if arguments.list:
        print("\n".join(f"{law_of(test):8} {test}" for test in tests))
        return 0
    folder = arguments.out or pathlib.Path(tempfile.mkdtemp(prefix="verify-"))
    campaign = Campaign(arguments, arguments.program, tests, folder.resolve())
    campaign.run()
    summary = campaign.summary()
    campaign.say("")
    report(summary)
    if arguments.json:
        write(arguments.json, summary)
    return 1 if summary["failures"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
