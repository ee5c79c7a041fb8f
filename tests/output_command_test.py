#!/usr/bin/env python3
"""Standard output is written in full, or the command fails: for every command that prints.

Usage: output_command_test.py FAIRWAY [unittest arguments]
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

FAIRWAY = CHECK = None
LOST = 74
MESSAGE = "standard output could not be written"

SCENARIO = """[map]
file = "map.pgm"
resolution_m = 1.0
cell_m = 2.0
[vehicle]
speed_mps = 10.0
turn_radius_m = 4.0
[mission]
kind = "goal"
goal_m = [45.0, 30.0]
[verify]
undecided_max = 0.5
[simulate]
random = 5
sample = 10
"""


class Output(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-output-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "map.pgm").write_bytes(b"P5\n70 60\n255\n" + b"\xff" * 4200)
        (self.folder / "s.toml").write_text(SCENARIO)
        for words in (["plan", "s.toml", "-o", "p"], ["verify", "p", "-o", "c", "--volume-samples", "20000"]):
            self.assertEqual(self.start(words)[0], 0)

    def start(self, words, closed=False, program=None, **options):
        """Exit code and stderr, with standard output full, or closed."""
        if closed:
            options["preexec_fn"] = lambda: os.close(1)
        elif "stdout" not in options:
            options["stdout"] = subprocess.DEVNULL
        done = subprocess.run([program or FAIRWAY, *words], cwd=self.folder, text=True, stdin=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, timeout=120, **options)
        return done.returncode, done.stderr

    def lost(self, words, program=None):
        name = "fairway" if program is None else pathlib.Path(program).name
        with open("/dev/full", "w") as full:
            for closed in (False, True):
                with self.subTest(words=words, closed=closed):
                    code, told = self.start(words, closed, program, **({} if closed else {"stdout": full}))
                    self.assertEqual(code, LOST, told)
                    self.assertIn(f"{name}: {MESSAGE}", told)
                    self.assertEqual(told.count(MESSAGE), 1)

    def test_the_answers_of_every_command(self):
        state = ["--state", "20,20,0.5"]
        steer = ["steer", "--from", "0,0,0", "--to", "50,0,0", "--turn-radius", "4"]
        for words in (["run", "s.toml", "-o", "out", "--force"],
                      ["plan", "s.toml", "-o", "again", "--force"],
                      ["verify", "p", "-o", "d", "--force", "--volume-samples", "20000"],
                      ["export", "p", "-o", "p.tif", "--force"],
                      ["draw", "p", "-o", "p.svg", "--force"],
                      ["simulate", "p", *state], ["ceiling", "p", "--levels", "1"],
                      ["simulate", "p", "--random", "5000", "--json"],
                      ["simulate", "p", "--random", "10", "--outcomes", "-"],
                      ["simulate", "p", "--random", "20000", "--outcomes", "-"],
                      ["simulate", "p", "--random", "10", "--csv", "-"],
                      ["simulate", "p", "--random", "10", "--geojson", "-"],
                      ["query", "c", *state], ["query", "c", *state, "--json"],
                      ["compare", "p", "p", "--quick", "--states", "1000"],
                      ["compare", "p", "p", "--quick", "--states", "1000", "--json"],
                      ["cell", "p", "--cell", "5,5"], ["cell", "p", "--cell", "5,5", "--json"],
                      steer, [*steer, "--json"], ["contract", "--airspeed", "20", "--turn-radius", "50"],
                      ["tune", "s.toml", "-o", "t", "--evaluations", "2", "--finalists", "1", "--force"],
                      ["info", "map.pgm", "--resolution", "1"], ["init", "map.pgm", "--resolution", "1", "-o", "i", "--force"],
                      ["--help"], ["verify", "--help"], ["--version"], ["--scenario-keys"]):
            self.lost(words)

    def test_the_check(self):
        for words in (["c"], ["c", "--json"], ["--help"], ["--version"]):
            self.lost(words, CHECK)
        with open("/dev/full", "w") as full:
            self.assertEqual(self.start(["check", "c"], stdout=full)[0], LOST)
        self.assertEqual(self.start(["check", "c"], closed=True)[0], LOST)

    def test_a_page_that_nobody_was_told_of_is_not_served(self):
        self.assertEqual(self.start(["run", "s.toml", "-o", "out"])[0], 0)
        page = self.folder / "out/report.html"  # any page will do where the build has none
        if not page.exists():
            page.write_text("<!doctype html>")
        self.lost(["view", "out", "--port", "0"])

    def test_nothing_to_tell_is_nothing_lost(self):
        with open("/dev/full", "w") as full:
            for words in (["plan", "s.toml", "-o", "q", "--quiet", "--force"],
                          ["simulate", "p", "--random", "10", "--outcomes", "o.csv", "--quiet", "--force"]):
                self.assertEqual(self.start(words, stdout=full), (0, ""))
                self.assertEqual(self.start(words, closed=True), (0, ""))

    def test_what_is_told_never_ends_up_in_a_product(self):
        code, _ = self.start(["plan", "s.toml", "-o", "q"], closed=True)
        self.assertEqual(code, LOST)
        self.assertEqual((self.folder / "q").read_bytes(), (self.folder / "p").read_bytes())

    def test_another_failure_keeps_its_code(self):
        with open("/dev/full", "w") as full:
            for words in (["run", "none.toml"], ["run", "none.toml", "--json"]):
                code, told = self.start(words, stdout=full)
                self.assertEqual(code, 65)
                self.assertIn("none.toml", told)

    def test_a_stderr_that_is_full_or_closed_changes_nothing(self):
        with open("/dev/full", "w") as full:
            for how in ({"stderr": full}, {"preexec_fn": lambda: os.close(2)}):
                for words, code in ((["run", "none.toml"], 65), (["rn"], 64), (["query", "p", "--state", "1,1,1"], 65)):
                    done = subprocess.run([FAIRWAY, *words], cwd=self.folder, stdout=subprocess.DEVNULL,
                                          timeout=60, **how)
                    self.assertEqual(done.returncode, code, words)
                done = subprocess.run([CHECK, "p"], cwd=self.folder, stdout=subprocess.DEVNULL, timeout=60, **how)
                self.assertIn(done.returncode, (1, 65))


if __name__ == "__main__":
    FAIRWAY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    CHECK = str(pathlib.Path(FAIRWAY).parent / "fairway-check")
    unittest.main()
