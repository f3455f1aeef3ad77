#!/usr/bin/env python3
"""Tests of scripts/cluster without a cluster: plans, jobs, what is done twice.

  scripts/cluster/test/farm_test.py PROGRAM LAWS

PROGRAM is build/release/tools/halfspace, LAWS
build/release/proptest/proptest. It takes GNU parallel.
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

FARM = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = LAWS = ""


def call(*words, **options):
    return subprocess.run(list(map(str, words)), text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          **options)


class FarmTest(unittest.TestCase):
    """Each test has a folder with a part in it."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="farm-")
        self.addCleanup(self.folder.cleanup)
        self.here = pathlib.Path(self.folder.name)
        self.halfspace("csg", "sphere(3) - box(3, 3, 3)", "-o", "part.stl")

    def halfspace(self, *words):
        done = call(PROGRAM, *words, "-q", cwd=self.here)
        self.assertEqual(done.returncode, 0, done.stdout)

    def farm(self, *words, status=0):
        done = call(FARM / "farm.py", *words, cwd=self.here)
        self.assertEqual(done.returncode, status, done.stdout)
        return done.stdout

    def run_all(self, plan):
        for line in self.farm("phases", plan).splitlines():
            self.farm("run", plan, line.split()[0])

    def result(self, plan, name):
        return (self.here / plan / "results" / name).read_bytes()

    def film(self, plan="film", frames="3:9"):
        return self.farm("film", plan, "part.stl", "--program", PROGRAM,
                         "--frames", frames, "--per-job", 4, "--ids", "--",
                         "--turntable", 12, "--size", "40x30")

    def test_a_film_has_the_frames_of_one_process(self):
        self.assertEqual(self.film(), "tree: 1 job\nframes: 2 jobs\n")
        self.run_all("film")
        self.assertIn("13 files", self.farm("manifest", "film"))
        self.halfspace("render", "part.stl", "--turntable", 12, "--size",
                       "40x30", "-o", "one-%05d.png", "--ids", "one-%05d.npy",
                       "--frames", "3:9")
        for number in range(3, 9):
            for ending in "png", "npy":
                self.assertEqual(
                    self.result("film", f"frame-{number:05d}.{ending}"),
                    (self.here / f"one-{number:05d}.{ending}").read_bytes())

    def test_an_image_of_rows_is_that_of_one_process(self):
        self.farm("image", "image", "part.stl", "--program", PROGRAM, "--size",
                  "50x40", "--per-job", 16, "--", "--shade", "gouraud",
                  "--smooth", 30)
        self.run_all("image")
        self.halfspace("render", "part.stl", "--size", "50x40", "--shade",
                       "gouraud", "--smooth", 30, "-o", "one.png")
        self.assertEqual(self.result("image", "image.png"),
                         (self.here / "one.png").read_bytes())

    def test_a_union_of_blocks_is_that_of_one_process(self):
        parts = []
        for number in range(7):
            parts.append(f"p{number}.off")
            self.halfspace("csg", f"translate(box(2, 2, 2), {number * 1.5}, "
                           f"{number % 2}, 0)", "-o", parts[-1])
        # One block and one group have a single member.
        self.assertEqual(self.farm("union", "union", *parts, "--program",
                                   PROGRAM, "-o", "all.off", "--block", 2,
                                   "--fan", 3),
                         "level-0: 4 jobs\nlevel-1: 2 jobs\nlevel-2: 1 job\n")
        self.run_all("union")
        self.halfspace("csg", "union", *parts, "-o", "one.off")
        self.assertEqual(self.result("union", "all.off"),
                         (self.here / "one.off").read_bytes())

    def test_views_are_those_of_one_process(self):
        (self.here / "views.txt").write_text(
            "top.svg --view top\n\n# a comment\nsheet/iso.pdf --view iso\n")
        self.farm("views", "views", "draw", "part.stl", "views.txt",
                  "--program", PROGRAM, "--", "--fill", "none", "--lines",
                  "edges")
        self.run_all("views")
        self.halfspace("draw", "part.stl", "--fill", "none", "--lines",
                       "edges", "--view", "top", "-o", "one.svg")
        self.assertEqual(self.result("views", "top.svg"),
                         (self.here / "one.svg").read_bytes())
        self.assertTrue(self.result("views", "sheet/iso.pdf"))

    def test_what_is_done_is_not_run_again(self):
        self.film()
        self.run_all("film")
        record = self.here / "film" / "done" / "frames" / "0000" / "1.json"
        first = record.stat().st_mtime_ns
        self.run_all("film")
        self.film()
        self.assertEqual(record.stat().st_mtime_ns, first)
        self.assertEqual(self.farm("status", "film"), "tree: 1 of 1 done\n"
                         "frames: 2 of 2 done\n")

    def test_what_is_damaged_or_lost_is_made_again(self):
        self.film()
        self.run_all("film")
        frame = self.here / "film" / "results" / "frame-00003.png"
        bytes_of_it = frame.read_bytes()
        for damage in (lambda: frame.write_bytes(bytes_of_it[:-1] + b"x"),
                       frame.unlink):
            damage()
            self.assertIn("job 0 is not done, or its files have changed",
                          self.farm("manifest", "film", status=1))
            self.run_all("film")
            self.assertEqual(frame.read_bytes(), bytes_of_it)
        self.farm("manifest", "film")

    def test_what_follows_from_a_change_is_made_again(self):
        self.film()
        self.run_all("film")
        record = self.here / "film" / "done" / "tree" / "0000" / "0.json"
        noted = json.loads(record.read_text())
        noted["outputs"]["model.tree"]["sha256"] = "0" * 64
        record.write_text(json.dumps(noted))
        self.farm("manifest", "film", status=1)
        self.run_all("film")
        self.farm("manifest", "film")

    def test_a_job_that_is_killed_leaves_nothing_half_done(self):
        self.farm("image", "image", "part.stl", "--program", PROGRAM, "--size",
                  "9000x9000", "--per-job", 9000, "--", "--shade", "gouraud")
        self.farm("run", "image", "tree")
        job = subprocess.Popen([FARM / "farm.py", "run", "image", "rows", "0"],
                               cwd=self.here, stderr=subprocess.DEVNULL,
                               start_new_session=True)
        work = self.here / "image" / "work"
        while not list(work.glob("rows-0-*")) and job.poll() is None:
            time.sleep(0.01)
        os.killpg(job.pid, signal.SIGKILL)
        job.wait()
        self.assertFalse((self.here / "image" / "results" / "rows").exists())
        self.assertIn("rows: 0 of 1 done; not 0",
                      self.farm("status", "image", status=1))

    def test_a_job_that_fails_says_so_and_the_others_go_on(self):
        (self.here / "views.txt").write_text(
            "a.svg --view top\nb.svg --view nowhere\nc.svg --view iso\n")
        self.farm("views", "views", "draw", "part.stl", "views.txt",
                  "--program", PROGRAM)
        said = self.farm("run", "views", "views", status=2)
        self.assertIn("views: job 1: ", said)
        self.assertIn("--view", said)
        self.assertIn("(status 2; all of it is in ", said)
        self.assertTrue((self.here / "views" / "failed" / "views" / "1" /
                         "said.log").exists())
        self.assertIn("2 of 3 done; not 1",
                      self.farm("status", "views", status=1))
        self.assertIn("job 1 is not done",
                      self.farm("manifest", "views", status=1))

    def test_a_phase_needs_that_before_it(self):
        self.film()
        self.assertIn("tree: job 0 is not done yet",
                      self.farm("run", "film", "frames", "0", status=1))

    def test_a_folder_has_one_plan(self):
        self.film()
        self.assertIn("holds another plan", self.farm(
            "film", "film", "part.stl", "--program", PROGRAM, "--frames",
            "0:2", "--", "--turntable", 12, status=2))
        (self.here / "part.stl").write_text("solid\nendsolid\n")
        self.assertIn("its sources have changed", self.farm(
            "film", "film", "part.stl", "--program", PROGRAM, "--frames",
            "3:9", "--per-job", 4, "--ids", "--", "--turntable", 12, "--size",
            "40x30", status=2))

    def test_sources_that_change_are_seen(self):
        self.film()
        self.run_all("film")
        with open(self.here / "part.stl", "ab") as part:
            part.write(b" ")
        self.assertIn("part.stl: has changed since the plan was made",
                      self.farm("manifest", "film", status=1))

    def test_a_stride_runs_all_jobs_once(self):
        self.film(frames="0:12")
        self.farm("run", "film", "tree")
        self.farm("run", "film", "frames", "--stride", 2, "--first", 1)
        self.assertIn("1 of 3 done; not 0 2",
                      self.farm("status", "film", status=1))
        self.farm("run", "film", "frames", "--stride", 2, "--first", 0)
        self.farm("status", "film")

    def test_wrong_words_are_one_line(self):
        for words, said in (
                (("film", "x", "nothing.stl", "--frames", "0:1"),
                 "nothing.stl: No such file"),
                (("film", "x", "part.stl", "--frames", "5"), "--frames is two"),
                (("film", "x", "part.stl", "--frames", "5:5"), "has no frame"),
                (("union", "x", "-o", "all.off"), "there are no parts"),
                (("image", "x", "part.stl", "--size", "5"), "--size is two")):
            out = self.farm(*words, "--program", PROGRAM, status=2)
            self.assertIn(said, out)
            self.assertEqual(out.count("\n"), 1, out)
            self.assertFalse((self.here / "x").exists())
        self.assertIn("make a plan first",
                      self.farm("run", "x", "frames", status=1))

    def test_gnu_parallel_runs_a_plan_and_resumes_it(self):
        self.film()
        self.farm("run", "film", "tree")
        done = call(FARM / "parallel.sh", "film", "-j", 2, cwd=self.here)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("13 files", done.stdout)
        done = call(FARM / "parallel.sh", "film", "-j", 2, cwd=self.here)
        self.assertEqual(done.returncode, 0, done.stdout)

    # Not among the packages of all tests: scripts/cluster/test.sh installs it.
    @unittest.skipUnless(shutil.which("snakemake"), "there is no Snakemake")
    def test_snakemake_runs_a_plan_and_what_is_lost_of_it(self):
        self.film()
        words = ["snakemake", "-s", FARM / "Snakefile", "--config",
                 "plan=film", "-j", 2]
        done = call(*words, cwd=self.here)
        self.assertEqual(done.returncode, 0, done.stdout)
        first = self.result("film", "frame-00005.png")
        (self.here / "film" / "done" / "frames" / "0000" / "0.json").unlink()
        (self.here / "film" / "results" / "frame-00005.png").unlink()
        done = call(*words, cwd=self.here)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(self.result("film", "frame-00005.png"), first)
        self.assertIn("13 files", self.farm("manifest", "film"))

    def test_laws_and_their_summary(self):
        self.farm("laws", "laws", "--shards", 2, "--cases", 10, "--law",
                  "S2.L1", "--program", LAWS)
        self.run_all("laws")
        summary = self.result("laws", "summary.txt").decode()
        self.assertIn("0 laws failed", summary)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    LAWS = str(pathlib.Path(sys.argv.pop(1)).resolve())
    if not shutil.which("parallel"):
        sys.exit("farm_test.py: needs GNU parallel (apt-get install parallel)")
    unittest.main()
