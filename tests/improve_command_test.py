#!/usr/bin/env python3
"""fairway improve as its users see it: a plan that proves more, or none.

Usage: improve_command_test.py FAIRWAY [unittest arguments]
"""
import csv
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

FAIRWAY = None

# A wide place with the goal; to its right a street that is narrower than two turns.
SCENARIO = """[map]
file = "map.pgm"
resolution_m = 4.0
cell_m = 8.0
[vehicle]
speed_mps = 10.0
turn_radius_m = 20.0
[mission]
kind = "goal"
goal_m = [80.0, 96.0]
[plan]
alpha = 0.6
modes = 0
{more}
[simulate]
random = 20
[verify]
undecided_max = 0.01
"""


class Improve(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-improve-"))
        columns, rows = 84, 44
        pixels = bytearray(b"\xff" * (columns * rows))
        for row in range(rows):
            if not 14 <= row < 28:
                pixels[row * columns + 42:(row + 1) * columns] = bytes(columns - 42)
        (self.folder / "map.pgm").write_bytes(b"P5\n%d %d\n255\n" % (columns, rows) + bytes(pixels))
        self.scenario("s.toml")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def scenario(self, name, more=""):
        (self.folder / name).write_text(SCENARIO.format(more=more))

    def expect(self, code, *arguments):
        done = subprocess.run([FAIRWAY, *map(str, arguments)], cwd=self.folder, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def share(self, plan):
        told = self.expect(0, "--json", "verify", plan, "-o", "x.cert", "--undecided-max", 0.01, "--force").stdout
        return json.loads(told)["volume_fraction"]["reach"]

    def test_the_improved_plan_proves_what_is_told_and_lists_what_was_changed(self):
        self.expect(0, "plan", "s.toml", "-o", "p.safetensors")
        told = json.loads(self.expect(0, "--json", "improve", "p.safetensors", "-o", "better.safetensors",
                                      "--changes", "changes.csv", "--picture", "better.svg").stdout)
        self.assertTrue(told["improved"])
        before, after = self.share("p.safetensors"), self.share("better.safetensors")
        self.assertAlmostEqual(told["proved_before"]["exact"], before, places=9)
        self.assertAlmostEqual(told["proved_after"]["exact"], after, places=9)
        self.assertGreater(after, before + 0.02)
        with open(self.folder / "changes.csv") as lines:
            changes = list(csv.DictReader(lines))
        self.assertEqual(len(changes), told["cells_changed"])
        for change in changes:
            self.assertNotEqual(change["before_rad"], change["after_rad"])
            self.assertLessEqual(abs(float(change["after_rad"])), math.pi)
        self.assertIn("<svg", (self.folder / "better.svg").read_text())
        # The record says so, and everything that reads plans reads it.
        header = (self.folder / "better.safetensors").read_bytes()
        length = int.from_bytes(header[:8], "little")
        record = json.loads(json.loads(header[8:8 + length])["__metadata__"]["fairway"])
        self.assertEqual(record["improved"]["cells_changed"], len(changes))
        self.expect(0, "simulate", "better.safetensors", "--random", 20)
        self.assertIn("accepted", self.expect(0, "check", "x.cert", "--plan", "better.safetensors").stdout)

    def test_a_scenario_can_ask_for_it(self):
        self.scenario("i.toml", "improve = true")
        self.expect(0, "run", "i.toml", "-o", "out")
        summary = json.loads((self.folder / "out/summary.json").read_text())
        before, after = summary["improved"]["exact"]
        self.assertGreater(after, before)
        self.assertAlmostEqual(summary["verify"]["volume_fraction"]["reach"], after, places=9)
        self.assertTrue(summary["options"]["plan"]["improve"])
        self.expect(0, "run", "s.toml", "-o", "plain")
        plain = json.loads((self.folder / "plain/summary.json").read_text())
        self.assertNotIn("improved", plain)
        self.assertNotIn("improve", plain["options"]["plan"])
        self.assertAlmostEqual(plain["verify"]["volume_fraction"]["reach"], before, places=9)

    def test_where_nothing_can_be_gained_nothing_is_written(self):
        (self.folder / "map.pgm").write_bytes(b"P5\n84 44\n255\n" + b"\xff" * (84 * 44))
        self.expect(0, "plan", "s.toml", "-o", "p.safetensors")
        # No time to try a second cell, and no command may bend.
        done = self.expect(1, "improve", "p.safetensors", "-o", "better.safetensors", "--most-bend", 1e-9,
                           "--sweeps", 1, "--time-limit", 1e-9)
        self.assertIn("No better commands were found", done.stdout)
        self.assertFalse((self.folder / "better.safetensors").exists())

    def test_bad_input_is_refused_before_any_work(self):
        self.expect(0, "plan", "s.toml", "-o", "p.safetensors")
        self.assertIn("--force", self.expect(65, "improve", "p.safetensors", "-o", "map.pgm").stderr)
        self.expect(65, "improve", "p.safetensors", "-o", "p.safetensors", "--force")
        self.expect(65, "improve", "map.pgm", "-o", "q.safetensors")
        self.expect(64, "improve", "p.safetensors")
        self.expect(64, "improve", "p.safetensors", "-o", "q.safetensors", "--most-bend", "-1")
        self.assertFalse((self.folder / "q.safetensors").exists())


if __name__ == "__main__":
    FAIRWAY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
