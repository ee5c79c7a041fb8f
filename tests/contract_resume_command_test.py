#!/usr/bin/env python3
"""`fairway verify` under a vehicle contract: continued, with failing states and pictures.

Usage: contract_resume_command_test.py FAIRWAY [unittest arguments]
"""
import csv
import json
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
cell_m = 8.0
[vehicle]
speed_mps = 10.0
turn_radius_m = 12.0
{contract}[mission]
kind = "goal"
goal_m = [{goal}]
[plan]
alpha = 0.5
modes = 0
beta = 1.5
"""
CONTRACT = """[vehicle.contract]
command_error_m = 1.0
heading_error_rad = 0.03
turn_radius_m = [11.0, 13.0]
speed_mps = [9.0, 11.0]
"""
PICTURES = {f"{name}.{end}" for name in ("verdicts", "proved", "counterexamples") for end in ("svg", "png")}


def map_with_a_wall():
    rows = [bytearray(b"\xff" * 100) for _ in range(80)]
    for row in rows[20:24]:
        row[30:70] = bytes(40)
    return b"P5\n100 80\n255\n" + b"".join(rows)


class ContractResume(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-contract-resume-"))
        (cls.folder / "map.pgm").write_bytes(map_with_a_wall())
        (cls.folder / "c.toml").write_text(CONTRACT)
        for name, contract, goal in (("plain", "", "150.0, 60.0"), ("kept", CONTRACT, "150.0, 60.0"),
                                     ("other", "", "50.0, 60.0")):
            (cls.folder / f"{name}.toml").write_text(SCENARIO.format(contract=contract, goal=goal))
            cls.run_there(0, "plan", f"{name}.toml", "-o", name)
        cls.verify(0, "plain", "--contract", "c.toml", "-o", "whole.cert")
        cls.verify(0, "plain", "--contract", "c.toml", "-o", "part.cert", "--time-limit", "0.05")
        cls.verify(0, "plain", "-o", "exact.cert", "--undecided-max", "0.2")

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

    @classmethod
    def verify(cls, code, *arguments):
        return cls.run_there(code, "verify", *arguments, "--volume-samples", 1000)

    def summary(self, name):
        return json.loads((self.folder / f"{name}.summary.json").read_text())

    def test_what_is_resumed_is_proved_again_and_goes_on(self):
        done = self.verify(0, "plain", "--contract", "c.toml", "--resume", "part.cert", "-o", "on.cert")
        part, on, whole = map(self.summary, ("part", "on", "whole"))
        self.assertNotIn("resumed", whole)
        resumed = on["resumed"]
        self.assertEqual(resumed["from"], "part.cert")
        self.assertEqual(resumed["dropped_leaves"], 0)
        self.assertTrue(resumed["in_time"])
        self.assertIn(f"All {resumed['decided_leaves']} decided leaves of part.cert were proved again.", done.stdout)
        for verdict in ("reach", "collide", "leave", "trapped"):
            self.assertGreaterEqual(on["volume_fraction"][verdict], part["volume_fraction"][verdict])
            # Which leaves are worth cutting is judged by their neighbours then: nearly the same ones.
            self.assertGreaterEqual(on["volume_fraction"][verdict], whole["volume_fraction"][verdict] - 0.005)
        self.run_there(0, "check", "on.cert")

    def test_a_finished_proof_is_cut_on_and_loses_nothing(self):
        for threads in (1, 2):
            self.verify(0, "plain", "--resume", "whole.cert", "-o", f"again{threads}.cert", "--threads", threads)
        self.assertEqual((self.folder / "again1.cert").read_bytes(), (self.folder / "again2.cert").read_bytes())
        again = self.summary("again1")
        self.assertEqual(again["resumed"]["dropped_leaves"], 0)
        self.assertGreater(again["resumed"]["decided_leaves"], 1000)
        self.assertEqual(again["method"], "contract")  # that of the certificate
        self.assertEqual(again["contract"]["command_error_m"], 1.0)

    def test_parts_are_those_of_the_earlier_proof(self):
        self.verify(0, "plain", "--contract", "c.toml", "--parts", "1", "-o", "coarse.cert")
        self.verify(0, "plain", "--resume", "coarse.cert", "-o", "coarse_on.cert")
        self.assertEqual(self.summary("coarse_on")["parts_per_cell"], 1)

    def test_a_proof_of_something_else_is_refused_by_what_differs(self):
        (self.folder / "wider.toml").write_text(CONTRACT.replace("0.03", "0.05"))
        before = sorted(self.folder.iterdir())
        for words, arguments in (
                ("part.cert: is of a different plan: its regions differ", ("other", "--resume", "part.cert")),
                ("another contract: heading_error_rad is 0.03 there and 0.05 now",
                 ("plain", "--contract", "wider.toml", "--resume", "part.cert")),
                ("another region of interest", ("plain", "--resume", "part.cert", "--region", "0,0,40,40")),
                ("was proved with --parts 2, not 3", ("plain", "--resume", "part.cert", "--parts", "3")),
                ("add --method certified", ("kept", "--resume", "exact.cert")),
                ("leave out --method certified", ("kept", "--method", "certified", "--resume", "part.cert")),
                ("is a plan", ("kept", "--resume", "plain")),
        ):
            done = self.verify(65, *arguments, "-o", "bad.cert")
            self.assertIn(words, done.stderr)
            self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_no_time_to_prove_again_is_told(self):
        done = self.verify(0, "plain", "--resume", "whole.cert", "-o", "late.cert", "--time-limit", "0.000001")
        resumed = self.summary("late")["resumed"]
        self.assertEqual(resumed["dropped_leaves"], resumed["decided_leaves"])
        self.assertFalse(resumed["in_time"])
        self.assertIn("the time limit left no time to prove them again", done.stdout)
        self.assertIn("stopped at its limit", done.stderr)
        self.assertIsNone(self.summary("late")["at_risk"])

    def test_failing_states_are_listed_with_what_is_known(self):
        self.verify(0, "plain", "--contract", "c.toml", "-o", "f.cert", "--failures", "f.csv", "--pictures", "pictures")
        self.assertEqual({p.name for p in (self.folder / "pictures").iterdir()}, PICTURES)
        with open(self.folder / "f.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), ["x_m", "y_m", "heading_rad", "verdict", "start"])
        verdicts = {row["verdict"] for row in rows}
        self.assertIn("at_risk", verdicts)
        self.assertIn("collide", verdicts)
        self.assertNotIn("reach", verdicts)
        grounds = [row["start"] for row in rows]
        order = ["safe_start", "buffer", "cut_off"]
        self.assertEqual(grounds, sorted(grounds, key=order.index))
        for ground in order:
            for verdict in verdicts:
                self.assertLessEqual(sum(r["start"] == ground and r["verdict"] == verdict for r in rows), 100)
        # A query says the same.
        states = rows[:: max(1, len(rows) // 20)]
        asked = "x_m,y_m,heading_rad\n" + "".join(f"{r['x_m']},{r['y_m']},{r['heading_rad']}\n" for r in states)
        (self.folder / "asked.csv").write_text(asked)
        told = list(csv.DictReader(self.run_there(0, "query", "f.cert", "--states", "asked.csv").stdout.splitlines()))
        self.assertEqual([row["verdict"] for row in told], [row["verdict"] for row in states])
        self.run_there(0, "simulate", "plain", "--states", "f.csv", "--quiet")
        self.assertIn("at risk: may collide", (self.folder / "pictures/counterexamples.svg").read_text())

    def test_a_raster_has_what_queries_say(self):
        report = json.loads(self.run_there(0, "--json", "export", "whole.cert", "-o", "v.tif", "--heading", "90deg").stdout)
        self.assertEqual(report["of"], "contract verdicts")
        self.assertTrue((self.folder / "v.tif").is_file())
        if shutil.which("gdalinfo"):
            told = subprocess.run(["gdalinfo", "-hist", self.folder / "v.tif"], capture_output=True, text=True).stdout
            self.assertIn("7 at_risk", told)
            self.assertIn("every vehicle there that keeps the contract", told)

    def test_draw_and_info_know_both_kinds(self):
        self.run_there(0, "draw", "whole.cert", "-o", "drawn.svg")
        self.assertIn("under the contract", (self.folder / "drawn.svg").read_text())
        told = {}
        for name, kind in (("plain", "plan"), ("exact.cert", "certificate"), ("whole.cert", "contract_certificate")):
            told[kind] = json.loads(self.run_there(0, "info", name, "--json").stdout)
            self.assertEqual(told[kind]["kind"], kind)
            self.assertEqual(told[kind]["cells"], told["plan"]["cells"])
            self.assertEqual(told[kind]["vehicle"], {"speed_mps": 10.0, "turn_radius_m": 12.0})
        self.assertNotIn("volume_fraction", told["plan"])
        self.assertEqual(told["contract_certificate"]["volume_fraction"], self.summary("whole")["volume_fraction"])
        self.assertEqual(told["contract_certificate"]["contract"]["turn_radius_m"], [11.0, 13.0])
        self.assertIsNone(told["certificate"]["contract"])
        self.assertEqual(told["certificate"]["region_of_interest"], "goal")
        words = self.run_there(0, "info", "whole.cert", "-o", "info.png").stdout
        self.assertIn("holds for every vehicle that keeps the contract", words)
        self.assertRegex(words, r"of all states +\d+ % reach")
        self.assertIn("the command of a place within 1 m", words)
        self.assertTrue((self.folder / "info.png").is_file())
        self.assertIn("only --output goes with", self.run_there(65, "info", "plain", "--cell", "2").stderr)
        cut = self.folder / "cut.cert"
        cut.write_bytes((self.folder / "whole.cert").read_bytes()[:-1])
        self.run_there(65, "info", "cut.cert")
        cut.unlink()

    def test_a_contract_too_wide_for_every_cell_is_refused(self):
        (self.folder / "wild.toml").write_text(CONTRACT.replace("command_error_m = 1.0", "command_error_m = 5000.0"))
        before = sorted(self.folder.iterdir())
        done = self.verify(65, "plain", "--contract", "wild.toml", "-o", "wild.cert")
        self.assertIn("nothing was proved: The contract is too wide", done.stderr)
        self.assertRegex(done.stderr, r"[\d.]+ m would leave hardly any such cell")
        self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_a_run_with_such_a_contract_goes_on_without_its_proof(self):
        wild = CONTRACT.replace("command_error_m = 1.0", "command_error_m = 5000.0")
        (self.folder / "wild_run.toml").write_text(SCENARIO.format(contract=wild, goal="150.0, 60.0") +
                                                   "[simulate]\nrandom = 5\n[verify]\nundecided_max = 0.2\n")
        done = self.run_there(0, "run", "wild_run.toml", "-o", "wild")
        self.assertIn("Nothing was proved under the contract", done.stderr)
        summary = json.loads((self.folder / "wild/summary.json").read_text())
        self.assertNotIn("contract", summary)
        self.assertTrue(any("Nothing was proved under the contract" in w for w in summary["warnings"]))
        self.assertFalse((self.folder / "wild/contract.certificate.safetensors").exists())


if __name__ == "__main__":
    FAIRWAY = sys.argv[1]
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
