#!/usr/bin/env python3
"""From a map to a run, and states in degrees: info, init, --state-deg, and what refusals propose.

Usage: map_command_test.py FAIRWAY SOURCE_DIR [unittest arguments]
"""
import csv
import io
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

FAIRWAY = SOURCE = None

KEEP_IN = {"fileType": "Plan", "version": 1,
           "geoFence": {"version": 2, "circles": [], "polygons": [{"version": 1, "inclusion": True, "polygon": [
               [47.393, 8.5397], [47.393, 8.5603], [47.407, 8.5603], [47.407, 8.5397]]}]},
           "mission": {"version": 2, "items": [], "plannedHomePosition": [47.4, 8.55, 400]}}
SITE = """[map]
file = "site.plan"
cell_m = 20.0
[vehicle]
speed_mps = 12.0
turn_radius_m = 45.0
[mission]
kind = "goal"
goal_deg = {goal}
[simulate]
random = 5
sample = 20
{states}
[verify]
undecided_max = 0.9
"""


class Maps(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-maps-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "site.plan").write_text(json.dumps(KEEP_IN))
        # A room of 70 x 60 m, with a wall that has a door of 12 m.
        rows = [bytes(0 if 30 <= x < 32 and not 20 <= y < 32 else 255 for x in range(70)) for y in range(60)]
        (self.folder / "room.pgm").write_bytes(b"P5\n70 60\n255\n" + b"".join(rows))

    def expect(self, code, *arguments):
        done = subprocess.run([FAIRWAY, *map(str, arguments)], cwd=self.folder, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=300)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def site(self, name="site.toml", goal="[47.403, 8.556]", states=""):
        (self.folder / name).write_text(SITE.format(goal=goal, states=states))
        return name


class Info(Maps):
    def test_tells_size_free_share_and_room_in_words_json_and_a_picture(self):
        words = self.expect(0, "info", "room.pgm", "--resolution", 1, "--cell", 1, "-o", "room.png").stdout
        self.assertRegex(words, r"size +70 m x 60 m: 70 x 60 cells of 1 m")
        self.assertIn("not georeferenced", words)
        self.assertEqual((self.folder / "room.png").read_bytes()[:4], b"\x89PNG")
        found = json.loads(self.expect(0, "info", "room.pgm", "--resolution", 1, "--cell", 1, "--json").stdout)
        self.assertEqual(found["cells"], [70, 60])
        self.assertEqual(found["origin_m"], [0.0, 0.0])
        self.assertEqual(found["free_cells"], 70 * 60 - 2 * 48)
        self.assertEqual(found["part_cells"], [70 * 60 - 2 * 48])
        self.assertFalse(found["georeferenced"])
        narrow = json.loads(self.expect(0, "info", "room.pgm", "--resolution", 1, "--cell", 1, "--turn-radius", 4,
                                        "--json").stdout)
        self.assertEqual(narrow["parts"], 2)  # the buffers of 8 m close the door
        self.assertIn("resolution_m is missing", self.expect(65, "info", "room.pgm").stderr)
        self.assertIn("ends in .svg or .png", self.expect(64, "info", "room.pgm", "-o", "x.pdf").stderr)

    def test_a_map_in_degrees_says_where_it_is(self):
        found = json.loads(self.expect(0, "info", "site.plan", "--json").stdout)
        self.assertEqual(found["reference_deg"], [47.4, 8.55])
        self.assertAlmostEqual(found["widest_place_deg"][0], 47.4, 2)


class Init(Maps):
    def test_what_it_writes_runs_as_it_is_from_any_folder(self):
        (self.folder / "deeper").mkdir()
        told = self.expect(0, "init", "room.pgm", "--resolution", 1, "--cell", 1, "--turn-radius", 2.5, "-o",
                           "deeper/s.toml").stdout
        self.assertIn("Next: fairway run deeper/s.toml", told)
        scenario = tomllib.loads((self.folder / "deeper/s.toml").read_text())
        self.assertEqual(scenario["map"]["file"], "../room.pgm")
        self.assertEqual(scenario["vehicle"]["turn_radius_m"], 2.5)
        self.expect(0, "run", "deeper/s.toml", "-o", "out")
        summary = json.loads((self.folder / "out/summary.json").read_text())
        self.assertLess(summary["unreachable_share_of_free"], 0.1)
        self.expect(65, "init", "room.pgm", "--resolution", 1, "-o", "deeper/s.toml")
        self.expect(0, "init", "room.pgm", "--resolution", 1, "-o", "deeper/s.toml", "--force")
        self.expect(0, "plan", "deeper/s.toml", "-o", "p")

    def test_the_demonstrations_map_and_a_fence_can_be_planned(self):
        for map_file in (SOURCE / "demo/basin.yaml", "site.plan"):
            self.expect(0, "init", map_file, "-o", "s.toml", "--force")
            self.expect(0, "plan", "s.toml", "-o", "p", "--force")
            text = (self.folder / "s.toml").read_text()
            self.assertEqual("goal_deg =" in text, map_file == "site.plan")
            # The commented-out value is valid too: the goal in map metres.
            if map_file == "site.plan":
                metres = re.sub(r"goal_deg = .*\n# (goal_m = .*)", r"\1", text)
                self.assertIn("\ngoal_m", metres)
                (self.folder / "m.toml").write_text(metres)
                self.expect(0, "plan", "m.toml", "-o", "p", "--force")

    def test_where_nothing_fits_it_says_what_would(self):
        self.assertRegex(self.expect(65, "init", "room.pgm", "--resolution", 1, "--turn-radius", 30, "-o",
                                     "s.toml").stderr, r"turn_radius_m = [0-9.]+")
        self.assertFalse((self.folder / "s.toml").exists())


class Degrees(Maps):
    def test_states_in_degrees_are_those_in_metres(self):
        self.site()
        self.expect(0, "plan", "site.toml", "-o", "p")
        self.expect(0, "verify", "p", "-o", "c", "--undecided-max", 0.9)
        told = json.loads(self.expect(0, "simulate", "p", "--state-deg=47.397,8.545,90", "--json").stdout)["flights"][0]
        self.assertAlmostEqual(told["heading_rad"], 0.0, 3)
        self.assertAlmostEqual(told["lat_deg"], 47.397, 8)
        self.assertAlmostEqual(told["lon_deg"], 8.545, 8)
        self.assertAlmostEqual(told["course_deg"], 90.0, 5)
        again = json.loads(self.expect(0, "simulate", "p", "--json",
                                       f"--state={told['x_m']},{told['y_m']},{told['heading_rad']}").stdout)
        self.assertEqual(again["flights"][0]["time_s"], told["time_s"])
        self.assertIn("= 47.397, 8.545, course 90.0 deg: reach",
                      self.expect(0, "simulate", "p", "--state-deg=47.397,8.545,90").stdout)
        (self.folder / "s.csv").write_text("\ufefflat_deg,lon_deg,course_deg\r\n47.397,8.545,90\r\n")
        for words in (["--state-deg=47.397,8.545,90"], ["--states", "s.csv"]):
            for trust in ([], ["--trust-file"]):
                rows = list(csv.DictReader(io.StringIO(self.expect(0, "query", "c", *words, *trust).stdout)))
                self.assertEqual(list(rows[0]), ["x_m", "y_m", "heading_rad", "verdict", "time_bound_s"])
                self.assertEqual(float(rows[0]["x_m"]), told["x_m"])
        state = json.loads(self.expect(0, "query", "c", "--state-deg=47.397,8.545,90", "--json").stdout)["states"][0]
        self.assertAlmostEqual(state["course_deg"], 90.0, 5)

    def test_states_deg_of_a_scenario_are_flown(self):
        self.site(states="states = [[0.0, 0.0, 0.0]]\nstates_deg = [[47.397, 8.545, 90.0]]")
        self.expect(0, "run", "site.toml", "-o", "out")
        with open(self.folder / "out/outcomes.csv") as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual(float(rows[0]["x_m"]), 0.0)
        self.assertLess(float(rows[1]["x_m"]), -300.0)
        self.assertAlmostEqual(float(rows[1]["heading_rad"]), 0.0, 3)

    def test_what_is_wrong_about_degrees_is_said(self):
        (self.folder / "s.toml").write_text(
            '[map]\nfile = "room.pgm"\nresolution_m = 1.0\ncell_m = 2.0\n[vehicle]\nspeed_mps = 5.0\n'
            'turn_radius_m = 3.0\n[mission]\nkind = "goal"\ngoal_m = [50.0, 30.0]\n')
        self.expect(0, "plan", "s.toml", "-o", "flat")
        self.assertIn("not georeferenced", self.expect(65, "simulate", "flat", "--state-deg=47,8,90").stderr)
        (self.folder / "d.csv").write_text("lat_deg,lon_deg,course_deg\n47.397,8.545,90\n")
        self.assertIn("d.csv: is in degrees, and the map is not georeferenced",
                      self.expect(65, "simulate", "flat", "--states", "d.csv").stderr)
        for wrong in ("97,8,90", "47,8", "47,8,400", "47,8,90deg"):
            self.expect(64, "simulate", "flat", f"--state-deg={wrong}")
        self.site()
        self.expect(0, "plan", "site.toml", "-o", "p")
        self.assertIn("more than 100 km", self.expect(65, "simulate", "p", "--state-deg=8.545,47.397,90").stderr)
        warned = self.expect(0, "simulate", "p", "--state=47.398,8.545,90deg").stderr
        self.assertIn("looks like the map's latitude and longitude", warned)
        (self.folder / "s.toml").write_text((self.folder / "s.toml").read_text() +
                                            "[simulate]\nstates_deg = [[47.0, 8.0, 0.0]]\n")
        self.assertRegex(self.expect(65, "run", "s.toml", "-o", "out").stderr,
                         r"s\.toml:12: simulate\.states_deg: the map is not georeferenced")

    def test_headings_in_degrees_are_refused_wherever_states_are_given(self):
        self.site(states="states = [[500.0, 430.0, 90.0]]")
        self.assertRegex(self.expect(65, "plan", "site.toml", "-o", "p").stderr,
                         r"site\.toml:13: simulate\.states: .*90 degrees are 1\.5708")
        self.site()
        self.expect(0, "plan", "site.toml", "-o", "p")
        hint = "did you mean 90deg?"
        self.assertIn(hint, self.expect(64, "simulate", "p", "--state=100,100,90").stderr)
        self.assertIn(hint, self.expect(64, "steer", "--from=0,0,0", "--to=9,9,90", "--turn-radius", 2).stderr)
        (self.folder / "s.csv").write_text("x_m,y_m,heading_rad\n1,1,90\n")
        self.assertIn("s.csv:2: ", self.expect(65, "simulate", "p", "--states", "s.csv").stderr)
        (self.folder / "p.csv").write_text("0,0,0,9,9,90\n")
        self.assertIn(hint, self.expect(65, "steer", "--pairs", "p.csv", "--turn-radius", 2).stderr)

    def test_a_goal_in_degrees_is_answered_in_degrees_that_fit(self):
        self.site(goal="[47.4065, 8.5600]")
        told = self.expect(65, "plan", "site.toml", "-o", "p").stderr
        self.assertIn("around [47.4065, 8.56]", told)
        found = re.search(r"nearest goal that fits is (\[[0-9., ]+\]); it serves 100 %", told)
        self.assertTrue(found, told)
        self.site(goal=found[1])
        self.expect(0, "plan", "site.toml", "-o", "p")
        self.site(goal="[47.5, 8.55]")
        self.assertRegex(self.expect(65, "plan", "site.toml", "-o", "q").stderr,
                         r"\(\[47\.5, 8\.55\] is outside about latitude 47\.39[0-9]+ to 47\.40")

    def test_states_in_obstacles_are_warned_of(self):
        self.site(states="states = [[-775.0, 0.0, 0.0], [0.0, 0.0, 0.0]]")
        told = self.expect(0, "run", "site.toml", "-o", "out").stderr
        self.assertIn("1 of the scenario's 2 states lies in an obstacle", told)
        summary = json.loads((self.folder / "out/summary.json").read_text())
        self.assertTrue(any("lies in an obstacle" in w for w in summary["warnings"]))


if __name__ == "__main__":
    FAIRWAY, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
