#!/usr/bin/env python3
"""What a plan keeps of what any control could keep, as a user of run, verify and ceiling sees it.

Usage: ceiling_command_test.py FAIRWAY [unittest arguments]
"""
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

FAIRWAY = None

# Walls on all sides: whoever looks at one from nearer than it can turn is lost, whatever steers.
SCENARIO = """[map]
file = "map.pgm"
resolution_m = 2.0
cell_m = 4.0
[vehicle]
speed_mps = 10.0
turn_radius_m = 10.0
[mission]
kind = "goal"
goal_m = [100.0, 80.0]
[simulate]
random = 5
sample = 100
[verify]
undecided_max = 0.002
"""
CONTRACT = """[vehicle.contract]
heading_error_rad = 0.05
"""
PATH = SCENARIO.replace('kind = "goal"\ngoal_m = [100.0, 80.0]',
                        'kind = "path"\npath_file = "path.csv"\nclosed = true')
OF = "what any control could keep"


class CeilingOfAPlan(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-ceiling-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "map.pgm").write_bytes(b"P5\n100 80\n255\n" + b"\xff" * 8000)
        (self.folder / "path.csv").write_text("x_m,y_m\n50,50\n150,50\n150,110\n50,110\n")
        (self.folder / "s.toml").write_text(SCENARIO)

    def expect(self, code, *words):
        done = subprocess.run([FAIRWAY, *map(str, words)], cwd=self.folder, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def summary(self, place):
        return json.loads((self.folder / place).read_text())

    def compared(self, summary, part, table):
        """The members agree with each other, and with the line, which is there once."""
        lower, upper = part["ceiling"]
        proved = part["volume_fraction"]["reach"]
        self.assertTrue(0 < lower <= upper < 1, part["ceiling"])
        self.assertLess(0.1, proved)
        self.assertLessEqual(proved, upper)
        self.assertAlmostEqual(part["share_of_ceiling"], proved / upper, places=9)
        self.assertGreaterEqual(part["ceiling_levels"], 1)
        self.assertLessEqual(part["ceiling_buffer"][1], part["ceiling_free"][1])
        lines = [line for line in summary["findings"]
                 if line["of"] == OF and ("within its contract" in line["what"]) == ("contract" in part)]
        self.assertEqual(len(lines), 1, summary["findings"])
        told = float(lines[0]["share"].removesuffix(" %")) / 100  # rounded down
        self.assertLessEqual(told, part["share_of_ceiling"])
        self.assertLess(part["share_of_ceiling"] - told, 0.01)
        self.assertIn(f"no plan can keep more than {math.ceil(1000 * upper) / 10:.1f} %", lines[0]["what"])
        self.assertIn(lines[0]["what"], table)
        return lines[0]["what"]

    def test_a_run_compares_its_proof_with_the_ceiling(self):
        done = self.expect(0, "run", "s.toml", "-o", "out", "--set", "verify.ceiling=true")
        summary = self.summary("out/summary.json")
        what = self.compared(summary, summary["verify"], done.stdout)
        self.assertIn("are proved to reach the goal", what)
        self.assertIn("finding what any control could keep", summary["stage_wall_s"])
        page = self.folder / "out/report.html"
        if page.exists():  # not every build has one
            self.assertIn(f"Of {OF} ", page.read_text())
        # The ceiling by itself is the same, and so is that of verify.
        alone = json.loads(self.expect(0, "ceiling", "out", "--levels", "2", "--json").stdout)
        self.assertEqual(alone["ceiling"], summary["verify"]["ceiling"])
        done = self.expect(0, "verify", "out/plan.safetensors", "-o", "c", "--ceiling")
        again = self.summary("c.summary.json")
        self.assertEqual(again["ceiling"], alone["ceiling"])
        self.compared(again, again, done.stdout)

    def test_nothing_changes_unless_it_is_asked_for(self):
        self.expect(0, "run", "s.toml", "-o", "without")
        self.expect(0, "run", "s.toml", "-o", "with", "--set", "verify.ceiling=true")
        without, asked = self.summary("without/summary.json"), self.summary("with/summary.json")
        self.assertNotIn("ceiling", json.dumps({**without, "set": None}))
        self.assertEqual(without["options"], asked["options"])
        for name, digest in without["products"].items():
            if name != "report.html":
                self.assertEqual(asked["products"][name], digest, name)
        self.assertEqual(without["findings"], [f for f in asked["findings"] if f["of"] != OF])
        self.expect(0, "run", "s.toml", "-o", "unproved", "--no-verify", "--set", "verify.ceiling=true")
        self.assertNotIn("share_of_ceiling", json.dumps(self.summary("unproved/summary.json")))

    def test_under_a_contract_less_is_kept_of_the_same_ceiling(self):
        (self.folder / "s.toml").write_text(SCENARIO + "ceiling = true\n" + CONTRACT)
        done = self.expect(0, "run", "s.toml", "-o", "out")
        summary = self.summary("out/summary.json")
        exact, contract = summary["verify"], summary["contract"]
        self.compared(summary, exact, done.stdout)
        self.compared(summary, contract, done.stdout)
        self.assertEqual(exact["ceiling"], contract["ceiling"])
        self.assertLess(contract["share_of_ceiling"], exact["share_of_ceiling"])
        self.assertEqual([f["of"] for f in contract["findings"]].count(OF), 1)
        done = self.expect(0, "verify", "out/plan.safetensors", "-o", "c", "--ceiling")
        again = self.summary("c.summary.json")
        self.assertEqual(again["ceiling"], exact["ceiling"])
        self.assertIn("within its contract", self.compared(again, again, done.stdout))

    def test_of_a_path_only_the_touch_is_compared(self):
        (self.folder / "p.toml").write_text(PATH)
        self.expect(0, "plan", "p.toml", "-o", "p")
        done = self.expect(0, "verify", "p", "-o", "touch", "--method", "certified", "--ceiling")
        summary = self.summary("touch.summary.json")
        self.assertIn("are proved to touch the path", self.compared(summary, summary, done.stdout))
        done = self.expect(0, "verify", "p", "-o", "follow", "--ceiling")
        summary = self.summary("follow.summary.json")
        self.assertIn("follow", summary)  # or this plan is no test
        self.assertNotIn("share_of_ceiling", summary)
        self.assertIn("What any control could keep was not compared", done.stderr)

    def test_a_limit_of_memory_leaves_the_proof_and_a_warning(self):
        self.expect(0, "plan", "s.toml", "-o", "p")
        done = self.expect(0, "verify", "p", "-o", "c", "--ceiling", "--memory-limit", "8")
        self.assertEqual(self.summary("c.summary.json")["ceiling_levels"], 1)
        self.assertIn("What any control could keep is known less closely", done.stderr)
        done = self.expect(0, "verify", "p", "-o", "c", "--ceiling", "--memory-limit", "1", "--force")
        summary = self.summary("c.summary.json")
        self.assertEqual((summary["ceiling"], summary["ceiling_levels"]), ([0, 1], 0))
        self.assertEqual([f for f in summary["findings"] if f["of"] == OF], [])
        self.assertIn("What any control could keep is not known", done.stderr)
        done = self.expect(1, "ceiling", "p", "--memory-limit", "1", "--picture", "c.svg")
        self.assertIn("No file was written.", done.stdout)

    def test_bitmaps_are_not_compared(self):
        self.expect(0, "plan", "s.toml", "-o", "p")
        done = self.expect(64, "verify", "p", "-o", "b", "--method", "bitmap", "--ceiling")
        self.assertIn("--ceiling", done.stderr)
        (self.folder / "s.toml").write_text(SCENARIO + 'ceiling = true\nmethod = "bitmap"\n')
        done = self.expect(65, "run", "s.toml", "-o", "out")
        self.assertIn("s.toml:16: verify.ceiling", done.stderr)

    def test_the_picture_of_a_run_shows_what_its_plan_keeps(self):
        self.expect(0, "run", "s.toml", "-o", "out")
        for asked, words in (("out", "proved of this plan"), ("out/plan.safetensors", "proved of this plan"),
                             ("s.toml", "some control could")):
            self.expect(0, "ceiling", asked, "--levels", "1", "--picture", "c.svg", "--force")
            self.assertIn(words, (self.folder / "c.svg").read_text(), asked)
        self.expect(0, "plan", "s.toml", "-o", "out/plan.safetensors", "--force", "--set", "plan.alpha=1")
        done = self.expect(0, "ceiling", "out", "--levels", "1", "--picture", "c.svg", "--force")
        self.assertIn("is not about this plan", done.stderr)
        self.assertIn("some control could", (self.folder / "c.svg").read_text())
        self.expect(65, "ceiling", "out", "-o", "out/certificate.safetensors", "--force")


if __name__ == "__main__":
    FAIRWAY = sys.argv.pop(1)
    unittest.main()
