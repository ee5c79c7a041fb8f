#!/usr/bin/env python3
"""fairway tune: what it writes, what it says, and that a killed search goes on.

Usage: tune_command_test.py FAIRWAY [unittest arguments]
"""
import csv
import json
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

FAIRWAY = None

SCENARIO = """# A yard.
[map]
file = "map.pgm"
resolution_m = 2.0
cell_m = 2.0
[vehicle]
speed_mps = 5.0
turn_radius_m = 5.0
[mission]
kind = "goal"
goal_m = [60.0, 60.0]
[verify]
undecided_max = 0.1
"""


class Tune(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-tune-"))
        self.addCleanup(shutil.rmtree, self.folder)
        pixels = bytearray(b"\xff" * 2500)
        for y in range(0, 12):
            pixels[y * 50 + 15:y * 50 + 18] = bytes(3)
        for y in range(36, 50):
            pixels[y * 50 + 30:y * 50 + 33] = bytes(3)
        (self.folder / "map.pgm").write_bytes(b"P5\n50 50\n255\n" + pixels)
        (self.folder / "s.toml").write_text(SCENARIO)

    def fairway(self, *words, code=0):
        done = subprocess.run([FAIRWAY, *map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def test_writes_the_tuned_scenario_whose_proof_is_the_one_it_tells(self):
        told = json.loads(self.fairway("tune", "s.toml", "-o", "out", "--evaluations", 12, "--finalists", 1,
                                       "--json", "--quiet").stdout)
        out = self.folder / "out"
        self.assertEqual({p.name for p in out.iterdir()},
                         {"scenario.toml", "plan.safetensors", "certificate.safetensors", "summary.json",
                          "evaluations.csv", "search.json", "search.svg", "search.png", "pareto.svg", "pareto.png"})
        self.assertEqual(told, json.loads((out / "summary.json").read_text()))
        self.assertGreaterEqual(told["tuned_share"], told["given_share"])
        self.assertTrue(told["checked"])
        self.fairway("check", out / "certificate.safetensors")
        self.fairway("plan", out / "scenario.toml", "-o", "again", "--quiet")
        self.assertEqual((self.folder / "again").read_bytes(), (out / "plan.safetensors").read_bytes())
        proved = json.loads(self.fairway("verify", "again", "-o", "c", "--undecided-max", 0.1, "--quiet", "--json").stdout)
        self.assertEqual(proved["volume_fraction"]["reach"], told["tuned_share"])
        rows = list(csv.DictReader((out / "evaluations.csv").read_text().splitlines()))
        self.assertLessEqual(len(rows), 12)
        self.assertEqual(len(rows), told["tuning"]["evaluations"])
        front = told["tuning"]["pareto_front"]
        for one, next_one in zip(front, front[1:]):
            self.assertGreater(one["share"], next_one["share"])
            self.assertGreater(one["mean_time_s"], next_one["mean_time_s"])

    def test_depends_on_no_threads_and_not_on_having_been_killed(self):
        words = ["tune", "s.toml", "--evaluations", 10, "--finalists", 1, "--quiet"]
        self.fairway(*words, "-o", "one", "--threads", 1)
        self.fairway(*words, "-o", "two", "--threads", 2)
        killed = subprocess.Popen([FAIRWAY, *map(str, words), "-o", "killed"], cwd=self.folder, stderr=subprocess.DEVNULL)
        log = self.folder / "killed" / "evaluations.csv"
        for _ in range(1000):
            if killed.poll() is not None or (log.exists() and log.read_text().count("\n") > 3):
                break
            time.sleep(0.01)
        killed.send_signal(signal.SIGKILL)
        killed.wait()
        self.fairway(*words, "-o", "killed", "--resume")
        for name in ("evaluations.csv", "scenario.toml", "plan.safetensors", "certificate.safetensors", "search.svg"):
            for other in ("two", "killed"):
                self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / other / name).read_bytes(), name)

    def test_refuses_bad_input(self):
        for words in (["--vary", "plan.alpha"], ["--vary", "plan.alpha=3:1"], ["--vary", "plan.nothing=1:2"],
                      ["--objective", "speed"], ["--evaluations", "0"], ["--time-limit", "-1"]):
            self.fairway("tune", "s.toml", "-o", "out", *words, code=64)
        self.fairway("tune", "none.toml", "-o", "out", code=65)
        self.assertFalse((self.folder / "out").exists())
        (self.folder / "out").mkdir()
        (self.folder / "out" / "mine").write_text("keep")
        said = self.fairway("tune", "s.toml", "-o", "out", code=65).stderr
        self.assertIn("--force", said)
        self.fairway("tune", "s.toml", "-o", "out", "--resume", code=65)
        self.fairway("tune", "s.toml", "-o", "out", "--evaluations", 2, "--finalists", 1, "--force", "--quiet")
        self.assertEqual((self.folder / "out" / "mine").read_text(), "keep")

    def test_replaces_no_file_that_it_reads(self):
        (self.folder / "map.pgm").rename(self.folder / "search.png")
        (self.folder / "map.yaml").write_text("image: search.png\nresolution: 2.0\norigin: [0, 0, 0]\nnegate: 0\n"
                                              "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
        (self.folder / "s.toml").write_text(SCENARIO.replace("map.pgm", "map.yaml").replace("resolution_m = 2.0\n", ""))
        self.fairway("tune", "s.toml", "-o", ".", "--evaluations", 2, "--force", code=65)
        self.assertTrue((self.folder / "search.png").exists())


if __name__ == "__main__":
    FAIRWAY = str(pathlib.Path(sys.argv.pop(1)).absolute())
    unittest.main()
