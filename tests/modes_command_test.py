#!/usr/bin/env python3
"""Plans with modes, as the command tells of them: query, info, export, verify.

Usage: modes_command_test.py FAIRWAY SOURCE [unittest arguments]
"""
import csv
import io
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

FAIRWAY = SOURCE = None

SCENARIO = """[map]
file = {map}
resolution_m = 4.0
cell_m = 4.0
[vehicle]
speed_mps = 10.0
turn_radius_m = 9.0
[mission]
kind = "goal"
goal_m = [220.0, 32.0]
[plan]
preset = "paper"
alpha = 0.5
beta = 1.5
modes = {modes}
"""
LOOKING_AWAY = "100,180,3.14"  # in a street, away from the goal


class Modes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-modes-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for modes in (0, 3):
            (cls.folder / f"s{modes}.toml").write_text(
                SCENARIO.format(map=json.dumps(str(SOURCE / "demo/town.map")), modes=modes))
            cls.run_command("plan", f"s{modes}.toml", "-o", f"p{modes}")
            cls.run_command("verify", f"p{modes}", "-o", f"c{modes}", "--undecided-max", "0.03",
                            "--pictures", f"pictures{modes}")

    @classmethod
    def run_command(cls, *words, data=None):
        done = subprocess.run([FAIRWAY, *map(str, words)], cwd=cls.folder, text=True, input=data or "",
                              capture_output=True)
        if done.returncode != 0:
            raise AssertionError(f"{words}: {done.stderr}")
        return done.stdout

    def test_a_query_has_a_sixth_column_where_the_plan_has_modes(self):
        states = "".join(f"{x},{y},{h}\n" for x in range(10, 250, 16) for y in range(8, 190, 14) for h in (0.3, 3.14))
        told = {}
        for modes in (0, 3):
            text = self.run_command("query", f"c{modes}", "--states", "-", data="x_m,y_m,heading_rad\n" + states)
            told[modes] = list(csv.DictReader(io.StringIO(text)))
        self.assertEqual(list(told[0][0]), ["x_m", "y_m", "heading_rad", "verdict", "time_bound_s"])
        self.assertEqual(list(told[3][0]), [*told[0][0], "mode"])
        served = set()
        for alone, row in zip(told[0], told[3]):
            mode = int(row.pop("mode"))
            if row["verdict"] != "reach":
                self.assertEqual(mode, 0)
            if mode == 0 and alone["verdict"] != "undecided":
                self.assertEqual(row["verdict"], alone["verdict"])  # mode 0 is the plan without modes
            if mode > 0:
                self.assertNotEqual(row["time_bound_s"], "")
                served.add(mode)
        self.assertLessEqual(served, {1, 2, 3})
        self.assertTrue(served)

    def test_json_of_a_query_has_the_mode_where_the_plan_has_modes(self):
        for modes in (0, 3):
            report = json.loads(self.run_command("--json", "query", f"c{modes}", "--state", LOOKING_AWAY))
            self.assertEqual("mode" in report["states"][0], modes > 0)

    def test_info_tells_the_modes_of_a_plan_and_what_each_serves(self):
        words, report = self.run_command("info", "p3"), json.loads(self.run_command("--json", "info", "p3"))
        self.assertRegex(words, r"modes +3 further ones: ")
        directed = [mode for mode in report["modes"] if mode["rule"] == "direction"]
        self.assertEqual(len(report["modes"]), 3)
        self.assertIn(f"{len(directed)} on towards ", words)
        report = json.loads(self.run_command("--json", "info", "c3"))
        self.assertEqual(report["further_modes"], 3)
        self.assertEqual(len(report["reach_by_mode"]), 4)
        self.assertAlmostEqual(sum(report["reach_by_mode"]), report["volume_fraction"]["reach"], places=9)
        self.assertIn("by mode 3", self.run_command("info", "c3"))
        for product in ("p0", "c0"):
            self.assertNotIn("mode", self.run_command("info", product))
            self.assertNotIn("mode", self.run_command("--json", "info", product))

    def test_exports_say_that_modes_are_in_them(self):
        self.assertIn("the headings of 3 further modes", self.run_command("export", "p3", "-o", "p.tif"))
        told = self.run_command("export", "c3", "--heading", "0", "--heading", "1", "-o", "c.tif")
        self.assertIn("the verdicts and modes at 2 headings", told)
        self.assertNotIn("mode", self.run_command("export", "p0", "-o", "p0.tif"))
        self.assertNotIn("mode", self.run_command("export", "c0", "-o", "c0.tif"))

    def test_a_picture_of_modes_is_drawn_where_there_are_some(self):
        for modes in (0, 3):
            drawn = {file.name for file in (self.folder / f"pictures{modes}").iterdir()}
            self.assertEqual({"modes.svg", "modes.png"} <= drawn, modes > 0)
            self.assertEqual("modes.svg" in drawn, modes > 0)
        drawing = (self.folder / "pictures3/modes.svg").read_text()
        for words in ("mode 1: ", "no mode is proved to reach"):
            self.assertTrue(f">{words}" in drawing, words)


if __name__ == "__main__":
    FAIRWAY = pathlib.Path(sys.argv[1]).resolve()
    SOURCE = pathlib.Path(sys.argv[2]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
