#!/usr/bin/env python3
"""fairway compare as its users see it: plans side by side on stdout, as JSON, as a folder.

Usage: compare_command_test.py FAIRWAY [unittest arguments]
"""
import csv
import html.parser
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

FAIRWAY = None

# A basin of 320 by 240 m with a bar across its lower half.
SCENARIO = """[map]
file = "map.pgm"
resolution_m = 2.0
cell_m = {cell_m}
[vehicle]
speed_mps = 10.0
turn_radius_m = 16.0
[mission]
kind = "goal"
goal_m = [{goal}]
[plan]
alpha = {alpha}
beta = 2.0
[simulate]
random = 0
sample = 100
[verify]
undecided_max = 0.02
"""


class Links(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.found, self.tags = [], []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.found += [value for name, value in attrs if name in ("href", "src")]


class Compare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-compare-"))
        pixels = bytearray(b"\xff" * (160 * 120))
        for row in range(60, 120):
            pixels[row * 160 + 70:row * 160 + 76] = bytes(6)
        (cls.folder / "map.pgm").write_bytes(b"P5\n160 120\n255\n" + bytes(pixels))
        for name, changes in {"wide": {}, "narrow": {"alpha": 0.75}, "fine": {"cell_m": 4.0},
                              "elsewhere": {"goal": "60.0, 180.0"}}.items():
            values = {"alpha": 1.75, "cell_m": 8.0, "goal": "250.0, 120.0", **changes}
            (cls.folder / f"{name}.toml").write_text(SCENARIO.format(**values))
        for name in ("wide", "narrow"):
            cls.expect(0, "run", f"{name}.toml", "-o", name)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def expect(cls, code, *arguments):
        done = subprocess.run([FAIRWAY, *map(str, arguments)], cwd=cls.folder, text=True, stdin=subprocess.DEVNULL,
                              capture_output=True, timeout=300)
        if done.returncode != code:
            raise AssertionError(f"{arguments}: {done.returncode}\n{done.stdout}{done.stderr}")
        return done

    def compared(self, *arguments):
        return json.loads(self.expect(0, "compare", *arguments, "--states", 6000, "--json").stdout)

    def rows(self, name):
        return list(csv.DictReader((self.folder / name).read_text().splitlines()))

    @staticmethod
    def line(told, measure):
        return next(line for line in told["table"] if line["measure"] == measure)

    def test_shares_are_those_of_each_run(self):
        told = self.compared("wide", "narrow")
        self.assertEqual([plan["name"] for plan in told["plans"]], ["wide", "narrow"])
        self.assertTrue(told["is_proved"])
        for k, name in enumerate(("wide", "narrow")):
            summary = json.loads((self.folder / name / "summary.json").read_text())
            plan = told["plans"][k]
            self.assertEqual(plan["proofs"], [f"{name}/certificate.safetensors, as it was found."])
            for of, member in (("all", "volume_fraction"), ("safe_start", "volume_fraction_free"),
                               ("buffer", "volume_fraction_buffer")):
                share = plan["exact"][of]["reach"]
                self.assertAlmostEqual(share["value"], summary["verify"][member]["reach"],
                                       delta=5 * share["standard_error"] + 0.003)
            # Costs of all states, as the run itself has measured them on states of its own.
            for measure in ("time_s", "length_ratio", "turned_rad_per_100m"):
                one, other = plan["costs"][measure], summary["measures"][measure]
                self.assertAlmostEqual(one["value"], other["value"],
                                       delta=5 * math.hypot(one["standard_error"], other["standard_error"]) + 1e-6)
        reaching = self.line(told, "proved")["value"][0]
        pair = told["pairs"][0]
        self.assertAlmostEqual(reaching["value"], pair["only_first"]["value"] + pair["both"]["value"])
        self.assertGreater(self.line(told, "length_ratio")["value"][0]["value"], 1.0)

    def test_a_plan_and_itself_differ_in_nothing_and_order_mirrors(self):
        same = self.compared("wide", "wide/plan.safetensors")
        self.assertEqual({plan["name"] for plan in same["plans"]}, {"wide", "wide/plan.safetensors"})
        for line in same["table"]:
            self.assertEqual(line["value"][0], line["value"][1], line["measure"])
            self.assertIn(line["difference_from_first"][1]["value"], (0.0, None))
        self.assertEqual(same["pairs"][0]["only_first"]["value"], 0)
        there, back = self.compared("wide", "narrow"), self.compared("narrow", "wide")
        for one, other in zip(there["table"], back["table"]):
            self.assertEqual(one["value"], other["value"][::-1])
            if one["difference_from_first"][1]["value"] is not None:
                self.assertEqual(one["difference_from_first"][1]["value"], -other["difference_from_first"][1]["value"])
        self.assertEqual(there["pairs"][0]["only_first"], back["pairs"][0]["only_second"])

    def test_states_of_the_folder_are_won_when_they_are_flown_again(self):
        self.expect(0, "compare", "wide", "narrow", "-o", "won", "--states", 6000)
        rows = self.rows("won/states.csv")
        self.assertGreater(len(rows), 20)
        decided = 0
        for k, name in enumerate(("wide", "narrow"), 1):
            self.expect(0, "simulate", f"{name}/plan.safetensors", "--states", "won/states.csv", "--outcomes",
                        f"{name}.csv", "--force")
            for row, flown in zip(rows, self.rows(f"{name}.csv"), strict=True):
                self.assertEqual(float(row["x_m"]), float(flown["x_m"]))
                if row[f"verdict_{k}"] != "undecided":
                    self.assertEqual(row[f"verdict_{k}"], flown["outcome"])
                    decided += 1
        self.assertGreater(decided, len(rows))
        for row in rows:
            self.assertEqual([row["verdict_1"], row["verdict_2"]].count("reach"), 1)

    def test_the_folder_is_whole_and_its_page_stands_alone(self):
        self.expect(0, "compare", "wide", "narrow", "-o", "whole", "--states", 2000, "--quiet")
        folder = self.folder / "whole"
        self.assertEqual({p.name for p in folder.iterdir()},
                         {"compare.html", "comparison.csv", "comparison.json", "states.csv", "difference.svg",
                          "difference.png"})
        page = (folder / "compare.html").read_text()
        links = Links()
        links.feed(page)
        self.assertNotIn("script", links.tags)
        self.assertEqual({str(name) for name in links.found},
                         {"difference.svg", "difference.png", "states.csv", "comparison.csv", "comparison.json"})
        for svg in (page[page.index("<svg"):page.index("</svg>") + 6], (folder / "difference.svg").read_text()):
            xml.etree.ElementTree.fromstring(svg)
        told = json.loads((folder / "comparison.json").read_text())
        rows = self.rows("whole/comparison.csv")
        self.assertEqual(len(rows), 2 * len(told["table"]))
        for row in rows:
            value = self.line(told, row["measure"])["value"][["wide", "narrow"].index(row["plan"])]["value"]
            self.assertEqual(row["value"], "" if value is None else row["value"])
            if value is not None:
                self.assertEqual(float(row["value"]), value)
        # Kept unless --force; then the same again, byte for byte.
        before = {p.name: p.read_bytes() for p in folder.iterdir()}
        self.expect(65, "compare", "wide", "narrow", "-o", "whole", "--states", 2000)
        self.expect(0, "compare", "wide", "narrow", "-o", "whole", "--states", 2000, "--force", "--threads", 1)
        self.assertEqual({p.name: p.read_bytes() for p in folder.iterdir()}, before)

    def test_scenarios_are_planned_and_other_cells_compared_where_both_are_free(self):
        done = self.expect(0, "compare", "wide", "fine.toml", "--quick", "--states", 2000)
        self.assertIn("different cells, of 8 and 4 m", done.stderr)
        self.assertIn("seen to reach the goal", done.stdout)
        self.assertNotIn("proved to", done.stdout)
        proved = self.compared("wide.toml", "narrow.toml", "--time-limit", "60")
        self.assertEqual(proved["plans"][0]["proofs"], ["Proved for this comparison, in at most 60 s."])
        three = self.compared("wide", "narrow", "narrow.toml", "--quick")
        self.assertEqual([pair["second"] for pair in three["pairs"]], [1, 2])
        self.assertEqual(three["pairs"][0]["only_first"], three["pairs"][1]["only_first"])

    def test_a_certificate_of_another_plan_is_told_and_not_used(self):
        shutil.copytree(self.folder / "wide", self.folder / "mixed")
        shutil.copy(self.folder / "narrow/certificate.safetensors", self.folder / "mixed/certificate.safetensors")
        told = self.compared("wide", "mixed")
        self.assertTrue(any("mixed/certificate.safetensors is not about this plan" in w for w in told["warnings"]))
        self.assertEqual(told["plans"][1]["proofs"], ["Proved for this comparison, in at most 60 s."])
        self.assertLess(abs(self.line(told, "proved")["difference_from_first"][1]["value"]), 0.03)

    def test_bad_input_is_told(self):
        for words, told in ((("wide", "nowhere"), "nowhere: does not exist, expected a run's folder, a plan or a scenario"),
                            (("wide", "."), "is a folder without plan.safetensors"),
                            (("wide", "map.pgm"), "map.pgm: "),
                            (("wide", "wide/certificate.safetensors"), "is a certificate, expected a plan"),
                            (("wide", "elsewhere.toml"), "elsewhere.toml: its mission is the goal at (60, 180); that of "
                             "wide is the goal at (250, 120)"),
                            (("wide", "narrow", "-o", "wide"), "is one of the runs to compare"),
                            (("wide", "narrow", "-o", "map.pgm"), "map.pgm")):
            with self.subTest(words=words):
                done = self.expect(65, "compare", *words)
                self.assertIn(told, done.stderr)
                self.assertEqual(done.stdout, "")
        for words in (("wide",), (), ("wide", "narrow", "--states", "10"), ("wide", "narrow", "--time-limit", "0")):
            self.expect(64, "compare", *words)
        broken = bytearray((self.folder / "wide/certificate.safetensors").read_bytes())
        broken[-1] ^= 1
        shutil.copytree(self.folder / "wide", self.folder / "broken")
        (self.folder / "broken/certificate.safetensors").write_bytes(bytes(broken))
        self.assertIn("broken/certificate.safetensors", self.expect(65, "compare", "wide", "broken").stderr)


if __name__ == "__main__":
    FAIRWAY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
