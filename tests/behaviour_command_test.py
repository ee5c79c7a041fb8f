#!/usr/bin/env python3
"""Behaviours within a vehicle contract, as a user of `fairway simulate` sees them.

Usage: behaviour_command_test.py FAIRWAY [unittest arguments]
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

SCENARIO = """[map]
file = "map.pgm"
resolution_m = 2.0
cell_m = 4.0
[vehicle]
speed_mps = 10.0
turn_radius_m = 12.0
{contract}[mission]
kind = "goal"
goal_m = [100.0, 80.0]
[plan]
alpha = 0.5
beta = 1.5
[simulate]
random = 0
sample = 0
"""
CONTRACT = """[vehicle.contract]
command_error_m = 3.0
heading_error_rad = 0.03
turn_radius_m = [11.0, 13.0]
speed_mps = [9.0, 11.0]
"""


class Behaviours(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-behaviour-"))
        (cls.folder / "map.pgm").write_bytes(b"P5\n100 80\n255\n" + b"\xff" * 8000)
        (cls.folder / "c.toml").write_text(CONTRACT)
        for name, contract in (("plain", ""), ("kept", CONTRACT)):
            (cls.folder / f"{name}.toml").write_text(SCENARIO.format(contract=contract))
            cls.run_there(0, "plan", f"{name}.toml", "-o", f"{name}.plan", "--quiet")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def run_there(cls, code, *arguments):
        done = subprocess.run([FAIRWAY, *map(str, arguments)], cwd=cls.folder, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True)
        if done.returncode != code:
            raise AssertionError(f"{arguments}: {done.returncode}\n{done.stdout}{done.stderr}")
        return done

    def test_a_start_in_front_of_the_wall_is_at_risk_and_said_first(self):
        done = self.run_there(0, "simulate", "plain.plan", "--contract", "c.toml", "--behaviours", "8",
                              "--state", "100,120,0", "--state", "190,80,0")
        first = done.stdout.splitlines()[0]
        self.assertTrue(first.startswith("(190, 80, 0 rad): of 8 behaviours, 8 collide"), first)
        self.assertIn("at risk, proved by a flight", first)
        self.assertIn("Of 2 starts, 1 (50.0 %) fails", done.stdout)
        self.assertIn("From 1, all 8 behaviours reach", done.stdout)

    def test_json_counts_every_behaviour(self):
        done = self.run_there(0, "simulate", "plain.plan", "--contract", "c.toml", "--random", "30",
                              "--random-in", "flyable", "--behaviours", "5", "--json")
        report = json.loads(done.stdout)
        self.assertEqual(report["starts"], 30)
        self.assertEqual(report["contract"]["command_error_m"], 3.0)
        self.assertEqual(report["adversaries"], ["random", "greedy", "circling", "guided"])
        for flight in report["flights"]:
            self.assertEqual(sum(flight["behaviours"].values()), 5)
            failed = flight["behaviours"]["collide"] + flight["behaviours"]["leave"]
            self.assertEqual(flight["outcome"] in ("collide", "leave"), failed > 0)
        self.assertEqual(report["fail"], sum(f["outcome"] in ("collide", "leave") for f in report["flights"]))
        self.assertLessEqual(report["at_risk"], report["fail"])

    def test_the_same_seed_flies_the_same_on_any_number_of_threads(self):
        runs = [self.run_there(0, "simulate", "plain.plan", "--contract", "c.toml", "--random", "40", "--json",
                               "--behaviours", "6", "--seed", seed, "--threads", threads).stdout
                for seed, threads in (("3", "1"), ("3", "2"), ("4", "2"))]
        self.assertEqual(runs[0], runs[1])
        self.assertNotEqual(runs[0], runs[2])

    def test_files_hold_the_worst_flight_of_each_start(self):
        self.run_there(0, "simulate", "plain.plan", "--contract", "c.toml", "--behaviours", "4", "--force",
                       "--state", "190,80,0", "--state", "100,120,0", "--csv", "t.csv", "--outcomes", "o.csv")
        with open(self.folder / "o.csv") as file:
            outcomes = list(csv.DictReader(file))
        self.assertEqual([row["outcome"] for row in outcomes], ["collide", "reach"])
        with open(self.folder / "t.csv") as file:
            rows = [row for row in csv.DictReader(file) if row["flight"] == "0"]
        for row in rows:
            curvature = abs(float(row["curvature_per_m"]))
            self.assertTrue(curvature == 0.0 or 1 / 13 - 1e-12 <= curvature <= 1 / 11 + 1e-12)
        last = rows[-1]
        self.assertGreater(float(last["x_m"]), 190.0)
        for a, b in zip(rows, rows[1:]):  # it does not jump
            moved = math.dist((float(a["x_m"]), float(a["y_m"])), (float(b["x_m"]), float(b["y_m"])))
            self.assertLessEqual(moved, 10.0 * (float(b["time_s"]) - float(a["time_s"])) + 1e-6)

    def test_a_plan_with_a_contract_needs_no_file(self):
        done = self.run_there(0, "simulate", "kept.plan", "--behaviours", "3", "--state", "100,120,0")
        self.assertIn("all 3 behaviours reach", done.stdout)
        # Without asking for behaviours, flights are exact, as those of any plan.
        done = self.run_there(0, "simulate", "kept.plan", "--state", "100,120,0")
        self.assertIn("Of 1 flight", done.stdout)

    def test_what_does_not_fit_is_refused(self):
        state = ("--state", "100,120,0")
        done = self.run_there(65, "simulate", "plain.plan", "--behaviours", "3", *state)
        self.assertIn("has no vehicle contract, expected --contract FILE.toml", done.stderr)
        self.run_there(65, "simulate", "plain.plan", "--contract", "map.pgm", *state)
        self.run_there(65, "simulate", "plain.plan", "--contract", "none.toml", *state)
        for other in (("--law", "bang-bang"), ("--laps", "1"), ("--qgc", "m.plan"), ("--behaviours", "0"),
                      ("--adversary", "kind")):
            self.run_there(64, "simulate", "plain.plan", "--contract", "c.toml", *state, *other)


if __name__ == "__main__":
    FAIRWAY = sys.argv[1]
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
