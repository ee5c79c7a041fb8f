#!/usr/bin/env python3
"""The proof under a vehicle contract, as users of `fairway run` and `fairway verify` see it.

Usage: contract_proof_command_test.py FAIRWAY [unittest arguments]
"""
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
cell_m = 4.0
[vehicle]
speed_mps = 10.0
turn_radius_m = 12.0
{contract}[mission]
kind = "goal"
goal_m = [100.0, 80.0]
[plan]
alpha = 0.5
modes = 0
beta = 1.5
[verify]
undecided_max = 0.1
[simulate]
random = 5
sample = 50
"""
CONTRACT = """[vehicle.contract]
command_error_m = 1.0
heading_error_rad = 0.03
turn_radius_m = [11.0, 13.0]
speed_mps = [9.0, 11.0]
"""
MADE = ["contract.certificate.safetensors", "contract.png", "contract.svg"]


class ContractProof(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-contract-proof-"))
        (cls.folder / "map.pgm").write_bytes(b"P5\n100 80\n255\n" + b"\xff" * 8000)
        (cls.folder / "c.toml").write_text(CONTRACT)
        for name, contract in (("plain", ""), ("kept", CONTRACT)):
            (cls.folder / f"{name}.toml").write_text(SCENARIO.format(contract=contract))
        cls.printed = cls.run_there(0, "run", "kept.toml", "-o", "kept").stdout
        cls.summary = json.loads((cls.folder / "kept/summary.json").read_text())
        cls.run_there(0, "run", "plain.toml", "-o", "plain", "--quiet")

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

    def test_a_run_with_a_contract_proves_and_checks_both(self):
        for name in [*MADE, "certificate.safetensors"]:
            self.assertIn(name, self.summary["products"])
            self.assertTrue((self.folder / "kept" / name).is_file(), name)
        under = self.summary["contract"]
        self.assertTrue(under["checked"])
        self.assertIn("within its contract", under["findings"][0]["what"])
        for finding in under["findings"]:
            self.assertIn(finding, self.summary["findings"])
        self.assertTrue(self.summary["verify"]["checked"])
        self.assertEqual(under["contract"]["turn_radius_m"], [11.0, 13.0])
        self.assertEqual(under["method"], "contract")
        shares = under["volume_fraction"]
        self.assertAlmostEqual(sum(shares.values()), 1.0)
        self.assertLessEqual(under["at_risk"], shares["undecided"])
        self.assertGreater(shares["reach"], 0.5)
        # The exact vehicle keeps the contract: what fails for it cannot reach under the contract.
        exact = self.summary["verify"]["volume_fraction"]
        self.assertLessEqual(shares["reach"], 1.0 - exact["collide"] + 0.01)
        self.assertGreater(under["worst_time_s"], 0.0)
        self.assertIsInstance(under["chokes"], list)
        stages = self.summary["stage_wall_s"]
        self.assertIn("verifying under the contract", stages)
        self.assertFalse([stage for stage in stages if "%" in stage])
        self.run_there(0, "check", "kept/contract.certificate.safetensors")

    def test_the_contract_is_told_after_the_exact_vehicle_and_its_shares_add_up(self):
        lines = self.printed.splitlines()
        reach = [k for k, line in enumerate(lines) if "are proved to reach" in line and "all states" in line]
        self.assertEqual(len(reach), 2, self.printed)
        self.assertEqual(reach[0], 0)
        self.assertIn("whatever the vehicle does within its contract", lines[reach[1]])
        told = [float(line.replace("<", "").split("%")[0]) for line in lines[reach[1]:] if "%  of all states" in line]
        self.assertGreaterEqual(len(told), 3)
        self.assertAlmostEqual(sum(told), 100.0, delta=2.5)
        self.assertIn("Under the contract no sampled state that reaches takes longer than", self.printed)
        self.assertIn("contract.svg", self.printed)
        self.assertLessEqual(sum("of all states wait for" in line for line in lines), 2)

    def test_a_run_without_a_contract_has_none_of_it(self):
        summary = json.loads((self.folder / "plain/summary.json").read_text())
        self.assertNotIn("contract", summary)
        for name in MADE:
            self.assertFalse((self.folder / "plain" / name).exists(), name)
        plain = (self.folder / "plain/certificate.safetensors").read_bytes()
        self.assertEqual(plain, (self.folder / "kept/certificate.safetensors").read_bytes())

    def test_force_takes_away_what_a_run_with_a_contract_left(self):
        shutil.copytree(self.folder / "kept", self.folder / "again")
        self.run_there(0, "run", "kept.toml", "-o", "again", "--no-verify", "--force", "--quiet")
        for name in MADE:
            self.assertFalse((self.folder / "again" / name).exists(), name)
        self.assertNotIn("contract", json.loads((self.folder / "again/summary.json").read_text()))

    def test_verify_gives_the_same_bytes_on_any_number_of_threads(self):
        for threads in (1, 2):
            self.run_there(0, "verify", "plain/plan.safetensors", "--contract", "c.toml", "--threads", threads,
                           "-o", f"threads{threads}.cert", "--quiet")
        one, two = ((self.folder / f"threads{k}.cert").read_bytes() for k in (1, 2))
        self.assertEqual(one, two)
        run = self.summary["contract"]
        alone = json.loads((self.folder / "threads1.summary.json").read_text())
        self.assertEqual(alone["leaves"], run["leaves"])
        self.assertEqual(alone["volume_fraction"], run["volume_fraction"])

    def test_a_run_finds_the_same_states_at_risk_on_any_number_of_threads(self):
        self.run_there(0, "run", "kept.toml", "-o", "one", "--threads", 1, "--quiet")
        for name in ("report.html", "contract.svg"):
            if (self.folder / "kept" / name).exists():  # a build without npm has no page
                self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / "kept" / name).read_bytes())

    def test_verify_warns_of_a_contract_too_wide_for_the_plan(self):
        (self.folder / "wide.toml").write_text(CONTRACT.replace("command_error_m = 1.0", "command_error_m = 40.0"))
        done = self.run_there(0, "verify", "plain/plan.safetensors", "--contract", "wide.toml", "-o", "wide.cert")
        self.assertIn("The contract is too wide for this plan", done.stderr)
        warnings = json.loads((self.folder / "wide.summary.json").read_text())["warnings"]
        self.assertEqual(len([w for w in warnings if "too wide" in w]), 1)

    def test_bad_contracts_leave_nothing_behind(self):
        before = sorted(self.folder.iterdir())
        for k, (old, new) in enumerate((("[11.0, 13.0]", "[13.0, 11.0]"), ("[11.0, 13.0]", "[13.0, 14.0]"),
                                        ("= 1.0", "= -1.0"), ("= 0.03", "= 3.0"), ("speed_mps", "speed"))):
            bad = self.folder / "bad.toml"
            bad.write_text(CONTRACT.replace(old, new))
            done = self.run_there(65, "verify", "plain/plan.safetensors", "--contract", "bad.toml", "-o", "bad.cert")
            self.assertIn("bad.toml:", done.stderr)
            bad.write_text(SCENARIO.format(contract=CONTRACT.replace(old, new)))
            done = self.run_there(65, "run", "bad.toml", "-o", "bad")
            self.assertIn("bad.toml:", done.stderr)
            bad.unlink()
            self.assertEqual(sorted(self.folder.iterdir()), before)
        self.run_there(65, "verify", "plain/plan.safetensors", "--method", "contract", "-o", "bad.cert")
        self.assertEqual(sorted(self.folder.iterdir()), before)


if __name__ == "__main__":
    FAIRWAY = sys.argv[1]
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
