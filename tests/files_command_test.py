#!/usr/bin/env python3
"""No file is lost: outputs that are inputs, simultaneous runs, interrupted runs.

Usage: files_command_test.py FAIRWAY [unittest arguments]
"""
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

FAIRWAY = None

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
sample = {sample}
"""


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-files-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "map.pgm").write_bytes(b"P5\n70 60\n255\n" + b"\xff" * 4200)
        self.scenario("s.toml")

    def scenario(self, name, sample=10):
        (self.folder / name).write_text(SCENARIO.format(sample=sample))

    def expect(self, code, *arguments):
        done = subprocess.run([FAIRWAY, *map(str, arguments)], cwd=self.folder, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=120)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def start(self, *arguments):
        return subprocess.Popen([FAIRWAY, *map(str, arguments)], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def wait_for(self, process, pattern):
        deadline = time.monotonic() + 60
        while not list(self.folder.glob(pattern)):
            self.assertIsNone(process.poll(), "ended before it could be met")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.005)

    def content(self):
        return {p.name: p.read_bytes() for p in self.folder.iterdir() if p.is_file()}

    def whole(self, folder):
        """A run's folder is one set: every product is the one listed in summary.json."""
        summary = json.loads((folder / "summary.json").read_text())
        for name, digest in summary["products"].items():
            self.assertEqual(hashlib.sha256((folder / name).read_bytes()).hexdigest(), digest, name)
        self.assertEqual({p.name for p in folder.iterdir()}, set(summary["products"]) | {"summary.json"})
        return summary


class Inputs(Files):
    def test_an_output_that_is_an_input_is_refused_by_every_command(self):
        (self.folder / "line.csv").write_text("x_m,y_m\n20,30\n50,30\n")
        (self.folder / "m.yaml").write_text("image: map.pgm\nresolution: 1.0\norigin: [0, 0, 0]\nnegate: 0\n"
                                            "occupied_thresh: 0.65\nfree_thresh: 0.2\n")
        text = (self.folder / "s.toml").read_text()
        (self.folder / "ros.toml").write_text(text.replace('"map.pgm"\nresolution_m = 1.0', '"m.yaml"'))
        goal = 'kind = "goal"\ngoal_m = [45.0, 30.0]'
        (self.folder / "path.toml").write_text(text.replace(goal, 'kind = "path"\npath_file = "line.csv"'))
        (self.folder / "states.csv").write_text("x_m,y_m,heading_rad\n20,20,0\n")
        self.expect(0, "plan", "s.toml", "-o", "p")
        self.expect(0, "verify", "p", "-o", "c", "--volume-samples", "1000")
        os.symlink("p", self.folder / "soft")
        os.link(self.folder / "p", self.folder / "hard")
        os.link(self.folder / "p", self.folder / "p.tif")
        os.link(self.folder / "c", self.folder / "c.tif")
        os.link(self.folder / "p", self.folder / "p.svg")
        os.link(self.folder / "map.pgm", self.folder / "map.png")
        (self.folder / "pictures").mkdir()
        os.link(self.folder / "p", self.folder / "pictures/proved.png")
        before = self.content()
        for words in (("plan", "s.toml", "-o", "s.toml"), ("plan", "s.toml", "-o", "map.pgm"),
                      ("plan", "ros.toml", "-o", "m.yaml"),
                      ("plan", "path.toml", "-o", "line.csv"), ("plan", "s.toml", "-o", "./s.toml"),
                      ("verify", "p", "-o", "p"), ("verify", "p", "-o", "soft"), ("verify", "p", "-o", "hard"),
                      ("verify", "p", "-o", "d", "--summary", "p"), ("verify", "p", "-o", "d", "--failures", "p"),
                      ("verify", "p", "-o", "c", "--resume", "c"),
                      ("verify", "p", "-o", "d", "--pictures", "pictures"),
                      ("ceiling", "p", "-o", "p"), ("ceiling", "p", "--picture", "p.svg"),
                      ("draw", "p", "-o", "p.svg"), ("plan", "s.toml", "-o", "q", "--picture", "map.png"),
                      ("export", "p", "-o", "p.tif"), ("export", "c", "-o", "c.tif"),
                      ("cell", "p.svg", "--cell", "5,5", "-o", "p.svg"),
                      ("simulate", "p", "--state", "20,20,0", "--outcomes", "p"),
                      ("simulate", "p", "--state", "20,20,0", "--csv", "hard"),
                      ("simulate", "p", "--states", "states.csv", "--outcomes", "states.csv"),
                      ("info", "map.pgm", "--resolution", 1, "-o", "map.png"),
                      ("init", "map.pgm", "--resolution", 1, "-o", "map.pgm"),
                      ("steer", "--waypoints", "states.csv", "--turn-radius", "4", "--track", "states.csv"),
                      ("contract", "--log", "states.csv", "-o", "states.csv")):
            for force in ((), ("--force",)):
                with self.subTest(words=words, force=force):
                    self.assertIn("is an input", self.expect(65, *words, *force).stderr)
                    self.assertEqual(self.content(), before)
        # Files that only the map file names are known once it is read.
        self.assertIn("is an input", self.expect(65, "plan", "ros.toml", "-o", "map.pgm", "--force").stderr)
        self.assertEqual(self.content(), before)

    def test_a_run_does_not_replace_what_it_is_made_of(self):
        (self.folder / "out").mkdir()
        text = (self.folder / "s.toml").read_text()
        shutil.copy(self.folder / "map.pgm", self.folder / "out/plan.png")
        (self.folder / "s.toml").write_text(text.replace("map.pgm", "out/plan.png"))
        before = (self.folder / "out/plan.png").read_bytes()
        self.assertIn("is an input", self.expect(65, "run", "s.toml", "-o", "out", "--force").stderr)
        self.assertEqual((self.folder / "out/plan.png").read_bytes(), before)
        self.assertEqual([p.name for p in (self.folder / "out").iterdir()], ["plan.png"])

    def test_two_products_want_two_places(self):
        self.expect(0, "plan", "s.toml", "-o", "p")
        done = self.expect(65, "simulate", "p", "--state", "20,20,0", "--csv", "a", "--outcomes", "./a")
        self.assertIn("two products", done.stderr)
        self.expect(65, "verify", "p", "-o", "c", "--summary", "c")
        self.expect(65, "plan", "s.toml", "-o", "a.svg", "--picture", "./a.svg")
        self.assertNotIn("a", self.content())


class Folders(Files):
    def test_of_two_runs_at_once_one_wins_and_loses_nothing(self):
        for exists in (False, True):
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            if exists:
                (self.folder / "out").mkdir()
            both = [self.start("run", "s.toml", "-o", "out") for _ in range(2)]
            told = [p.communicate(timeout=120)[1] for p in both]
            self.assertEqual(sorted(p.returncode for p in both), [0, 65], told)
            self.whole(self.folder / "out")
            self.assertEqual([p.name for p in self.folder.glob(".*")], [])

    def test_of_two_forced_runs_at_once_one_whole_set_is_left(self):
        self.scenario("t.toml", sample=11)
        both = [self.start("run", name, "-o", "out", "--force") for name in ("s.toml", "t.toml")]
        for process in both:
            process.communicate(timeout=120)
        self.assertEqual([p.returncode for p in both], [0, 0])
        self.assertIn(self.whole(self.folder / "out")["random_flights"]["count"], (10, 11))

    def test_a_folder_that_appears_during_a_run_is_kept(self):
        self.scenario("s.toml", sample=200_000)
        process = self.start("run", "s.toml", "-o", "out")
        self.wait_for(process, ".out.partial-*/plan.safetensors")
        (self.folder / "out").mkdir()
        for name in ("summary.json", "distance.png"):
            (self.folder / "out" / name).write_text("mine")
        _, told = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 65, told)
        self.assertIn("out", told)
        self.assertEqual({p.name: p.read_text() for p in (self.folder / "out").iterdir()},
                         {"summary.json": "mine", "distance.png": "mine"})

    def test_a_folder_in_the_place_of_a_product_is_told_before_anything_is_replaced(self):
        self.expect(0, "run", "s.toml", "-o", "out")
        out = self.folder / "out"
        (out / "flights.csv").unlink()
        (out / "flights.csv").mkdir()
        before = {p.name: p.read_bytes() for p in out.iterdir() if p.is_file()}
        done = self.expect(65, "run", "s.toml", "-o", "out", "--force")
        self.assertIn("flights.csv", done.stderr)
        self.assertEqual({p.name: p.read_bytes() for p in out.iterdir() if p.is_file()}, before)

    def test_a_killed_run_is_swept_by_the_next_and_a_live_one_is_not(self):
        self.scenario("long.toml", sample=10_000_000)
        killed = self.start("run", "long.toml", "-o", "out")
        self.wait_for(killed, ".out.partial-*/plan.safetensors")
        killed.kill()
        killed.communicate(timeout=60)
        alive = self.start("run", "long.toml", "-o", "out")
        self.addCleanup(alive.communicate)
        self.addCleanup(alive.kill)
        self.wait_for(alive, f".out.partial-{alive.pid}-*/plan.safetensors")
        self.expect(0, "run", "s.toml", "-o", "out")
        self.assertEqual([p.name.split("-")[1] for p in self.folder.glob(".out.partial-*")], [str(alive.pid)])


class Interrupted(Files):
    def interrupted(self, process):
        process.send_signal(signal.SIGINT)
        _, told = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 128 + signal.SIGINT)
        told = re.sub("(?m)^fairway: .* so far.*\n", "", told)  # where it took long
        self.assertEqual(told.count("\n"), 1, told)
        return told

    def test_a_run_says_that_nothing_is_left(self):
        self.scenario("long.toml", sample=10_000_000)
        process = self.start("run", "long.toml", "-o", "out")
        self.wait_for(process, ".out.partial-*/plan.safetensors")
        told = self.interrupted(process)
        self.assertTrue(told.startswith("fairway: interrupted: nothing of this run was kept; "), told)
        self.assertIn("--time-limit", told)
        self.assertIn("--resume", told)
        self.assertEqual(set(self.content()), {"map.pgm", "s.toml", "long.toml"})
        self.assertFalse((self.folder / "out").exists())

    def test_verify_says_how_to_go_on(self):
        self.expect(0, "plan", "s.toml", "-o", "p")
        process = self.start("verify", "p", "-o", "c", "--undecided-max", "0", "--time-limit", "100",
                             "--pictures", "pictures")
        self.wait_for(process, ".pictures.partial-*")
        time.sleep(0.2)
        told = self.interrupted(process)
        self.assertIn("--time-limit", told)
        self.assertIn("--resume", told)
        self.assertNotIn("c", self.content())


class Help(Files):
    def test_common_options_stand_in_the_help_of_every_command(self):
        for command in ("run", "plan", "simulate", "verify", "query", "check", "cell", "draw", "export", "steer", "tune", "contract", "compare", "view"):
            told = self.expect(0, command, "--help").stdout
            common = told.partition("Common options:\n")[2]
            for option in ("--threads", "--quiet", "--json"):
                self.assertIn(option, common, command)
            self.assertEqual("--force" in common, command not in ("query", "check", "view"), command)

    def test_they_work_before_and_after_the_command(self):
        self.expect(0, "plan", "s.toml", "-o", "p")
        self.expect(65, "plan", "s.toml", "-o", "p")
        self.expect(0, "--force", "plan", "s.toml", "-o", "p")
        done = self.expect(0, "plan", "s.toml", "-o", "p", "--force", "--json", "--threads", "1")
        self.assertEqual(json.loads(done.stdout)["threads"], 1)

    def test_a_word_that_is_no_command_is_told_what_it_may_have_meant(self):
        for words, told in ((("rn", "demo.toml"), "unknown command rn; did you mean run?"),
                            (("verfy",), "unknown command verfy; did you mean verify?"),
                            (("demo.toml",), "demo.toml is not a command; did you mean fairway run demo.toml?"),
                            ((".",), "did you mean fairway view .?"),
                            (("frobnicate",), "expected one of run, plan, simulate")):
            done = self.expect(64, *words)
            self.assertIn(told, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("fairway plan: unexpected argument: b c", self.expect(64, "plan", "a", "-o", "x", "b", "c").stderr)

    def test_run_says_what_it_leaves(self):
        told = self.expect(0, "run", "--help").stdout
        for word in ("report.html", "certificate.safetensors", "fairway view"):
            self.assertIn(word, told)


if __name__ == "__main__":
    FAIRWAY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
