#!/usr/bin/env python3
"""The command as a user sees it: exit codes, messages, products.

Usage: command_test.py FAIRWAY SOURCE_DIR [unittest arguments]
"""
import csv
import hashlib
import json
import math
import os
import pathlib
import pty
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

FAIRWAY = SOURCE = None

SCENARIO = """[map]
file = "map.pgm"
resolution_m = 1.0
cell_m = 2.0
[vehicle]
speed_mps = 10.0
turn_radius_m = 4.0
[mission]
kind = "goal"
goal_m = {goal}
[verify]
undecided_max = 0.1
[simulate]
random = 20
sample = 100
"""


def write_map(path, walled=None, room=12):
    """An empty world of 120 x 90 m, free (255), with walls 2 m thick around `walled` if given."""
    image = np.full((90, 120), 255, np.uint8)
    if walled:
        x, y = walled
        row = 90 - y  # image rows run from the top
        wall = room + 2
        image[row - wall:row + wall, x - wall:x + wall] = 0
        image[row - room:row + room, x - room:x + room] = 255
    path.write_bytes(b"P5\n120 90\n255\n" + image.tobytes())


def read_safetensors(path):
    """The layout in a dozen lines of numpy, as any user's script would read it."""
    data = path.read_bytes()
    (length,) = struct.unpack("<Q", data[:8])
    header = json.loads(data[8:8 + length])
    record = json.loads(header.pop("__metadata__")["fairway"])
    types = {"F32": "<f4", "I8": "<i1"}
    arrays = {}
    for name, entry in header.items():
        begin, end = entry["data_offsets"]
        raw = data[8 + length + begin:8 + length + end]
        arrays[name] = np.frombuffer(raw, types[entry["dtype"]]).reshape(entry["shape"])
    return record, arrays, length


class Command(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-command-"))
        write_map(self.folder / "map.pgm")
        self.scenario("s.toml")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def scenario(self, name, goal="[90.0, 45.0]", more=""):
        (self.folder / name).write_text(SCENARIO.format(goal=goal) + more)

    def run_command(self, *arguments, **options):
        return subprocess.run([FAIRWAY, *map(str, arguments)], cwd=self.folder, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, **options)

    def expect(self, code, *arguments, **options):
        done = self.run_command(*arguments, **options)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def names(self):
        return sorted(p.name for p in self.folder.iterdir())

    def plan(self):
        self.expect(0, "plan", "s.toml", "-o", "p.safetensors")
        return self.folder / "p.safetensors"


class Run(Command):
    def test_leaves_every_product_and_says_where_to_look(self):
        done = self.expect(0, "run", "s.toml")
        folder = self.folder / "s-out"
        products = {"plan.safetensors", "flights.csv", "flights.geojson", "outcomes.csv", "plan.svg",
                    "plan.png", "flights.svg", "flights.png", "headings.svg", "headings.png",
                    "certificate.safetensors", "failures.csv", "verdicts.svg", "verdicts.png",
                    "proved.svg", "proved.png", "counterexamples.svg", "counterexamples.png",
                    "summary.json"}
        absent = not (folder / "report.html").exists()  # in a build without npm
        products |= set() if absent else {"report.html"}
        self.assertEqual({p.name for p in folder.iterdir()}, products)
        self.assertIn("s-out/plan.svg", done.stdout)
        self.assertIn("s-out/verdicts.svg", done.stdout)
        self.assertIn("s-out/summary.json", done.stdout)
        if absent:
            self.assertIn("report.html was not written: ", done.stderr)
        else:
            # Without a terminal there is no progress, except for a line now and then on slow machines.
            self.assertEqual(re.sub("(?m)^fairway: .* so far.*\n", "", done.stderr), "")
        summary = json.loads((folder / "summary.json").read_text())
        self.assertEqual(summary["cells"], [62, 47])
        self.assertEqual(sum(summary["region_cells"].values()), 62 * 47)
        self.assertEqual(summary["random_flights"]["count"], 100)
        self.assertEqual(summary["recorded_flights"], 20)
        self.assertEqual(set(summary["products"]), products - {"summary.json"})
        for name, digest in summary["products"].items():
            self.assertEqual(hashlib.sha256((folder / name).read_bytes()).hexdigest(), digest)
        for entry in summary["inputs"]:
            content = (self.folder / entry["path"]).read_bytes()
            self.assertEqual(hashlib.sha256(content).hexdigest(), entry["sha256"])
        with open(folder / "outcomes.csv") as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual(len(rows), 100)
        reached = sum(row["outcome"] == "reach" for row in rows)
        self.assertEqual(reached, summary["random_flights"]["outcomes"]["reach"])
        self.assertEqual(len(json.loads((folder / "flights.geojson").read_text())["features"]), 20)

    def test_products_do_not_depend_on_threads(self):
        summaries = []
        for threads in (1, 2, 5):
            self.expect(0, "--threads", threads, "run", "s.toml", "-o", f"out{threads}")
            summaries.append(json.loads((self.folder / f"out{threads}/summary.json").read_text()))
        for summary in summaries:
            page = "report.html" in summary["products"]  # not in a build without npm
            self.assertEqual(len(summary["products"]), 18 + page)
            for key in ("wall_s", "stage_wall_s", "peak_rss_bytes", "threads"):
                del summary[key]
            self.assertEqual(summary, summaries[0])  # digests of all products among them

    def test_a_path_mission_also_gets_its_distance_chart(self):
        (self.folder / "line.csv").write_text("x_m,y_m\n20,45\n60,45\n100,60\n")
        text = SCENARIO.replace('kind = "goal"\ngoal_m = {goal}',
                                'kind = "path"\npath_file = "line.csv"')
        (self.folder / "path.toml").write_text(text)
        self.expect(0, "run", "path.toml", "-o", "out")
        self.assertTrue((self.folder / "out/distance.svg").is_file())
        inputs = json.loads((self.folder / "out/summary.json").read_text())["inputs"]
        self.assertIn("line.csv", [entry["path"] for entry in inputs])

    def test_failing_states_fly_as_their_verdicts_say(self):
        self.expect(0, "run", "s.toml", "-o", "out")
        with open(self.folder / "out/failures.csv") as lines:
            failing = list(csv.DictReader(lines))
        proved = [k for k, row in enumerate(failing) if row["verdict"] != "undecided"]
        self.assertGreater(len(proved), 0)
        grounds = ["safe_start", "buffer", "cut_off"]
        order = [grounds.index(row["start"]) for row in failing]
        self.assertEqual(order, sorted(order))  # from safe starts with a command first
        self.expect(0, "simulate", "out/plan.safetensors", "--states", "out/failures.csv",
                    "--outcomes", "replayed.csv")
        with open(self.folder / "replayed.csv") as lines:
            outcomes = [row["outcome"] for row in csv.DictReader(lines)]
        self.assertEqual([outcomes[k] for k in proved], [failing[k]["verdict"] for k in proved])

    def test_existing_products_are_kept_unless_forced(self):
        self.expect(0, "run", "s.toml", "-o", "out")
        (self.folder / "out/notes.txt").write_text("mine")
        (self.folder / "out/plan.svg").write_text("edited")
        refused = self.expect(65, "run", "s.toml", "-o", "out")
        self.assertIn("--force", refused.stderr)
        self.assertEqual((self.folder / "out/plan.svg").read_text(), "edited")
        (self.folder / "out/distance.svg").write_text("of an earlier run with a path")
        self.expect(0, "run", "s.toml", "-o", "out", "--force")
        self.assertFalse((self.folder / "out/distance.svg").exists())
        self.assertIn("<svg", (self.folder / "out/plan.svg").read_text())
        self.assertEqual((self.folder / "out/notes.txt").read_text(), "mine")
        self.assertEqual(self.names(), ["map.pgm", "out", "s.toml"])

    def test_an_unreachable_goal_is_a_no_that_leaves_nothing(self):
        write_map(self.folder / "map.pgm", walled=(60, 46), room=4)  # the goal fills the room
        self.scenario("s.toml", goal="[60.0, 46.0]", more="[plan]\nalpha = 0.5\nbeta = 0.8\n")
        done = self.expect(1, "run", "s.toml", "-o", "out")
        self.assertRegex(done.stdout, "^s.toml:10: mission.goal_m: .*reach")
        self.assertEqual(self.names(), ["map.pgm", "s.toml"])
        done = self.expect(1, "plan", "s.toml", "-o", "p", "--json")
        self.assertTrue(json.loads(done.stdout)["unreachable"])

    def test_a_mission_the_map_does_not_allow_names_the_line(self):
        write_map(self.folder / "map.pgm", walled=(60, 45))
        for goal, word in (("[60.0, 58.0]", "obstacle"), ("[60.0, 63.0]", "lacks"),
                           ("[500.0, 45.0]", "outside the map")):
            self.scenario("s.toml", goal=goal)
            done = self.expect(65, "run", "s.toml", "-o", "out")
            self.assertTrue(done.stderr.startswith("fairway: s.toml:10: mission.goal_m: "),
                            done.stderr)
            self.assertIn(word, done.stderr)
            self.assertEqual(self.names(), ["map.pgm", "s.toml"])

    def test_states_outside_the_map_name_the_line(self):
        text = (self.folder / "s.toml").read_text() + "states = [[500, 1, 0]]\n"
        (self.folder / "s.toml").write_text(text)
        done = self.expect(65, "run", "s.toml")
        self.assertIn("s.toml:16: simulate.states: (500, 1) is outside the map", done.stderr)
        self.assertEqual(self.names(), ["map.pgm", "s.toml"])

    def test_a_signal_leaves_nothing_behind(self):
        more = (self.folder / "s.toml").read_text().replace("sample = 100", "sample = 10000000")
        (self.folder / "s.toml").write_text(more)
        process = subprocess.Popen([FAIRWAY, "run", "s.toml", "-o", "out"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while not list(self.folder.glob(".out.partial-*/plan.safetensors")):
            self.assertIsNone(process.poll(), "ended before it could be interrupted")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(60), 128 + signal.SIGTERM)
        self.assertEqual(self.names(), ["map.pgm", "s.toml"])

    def test_a_full_disk_leaves_nothing_behind(self):
        def small_files():  # writes beyond 8 kB fail, as on a full disk
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))
        done = self.expect(65, "run", "s.toml", "-o", "out", preexec_fn=small_files,
                           restore_signals=False)
        self.assertIn("cannot be written", done.stderr)
        self.assertEqual(self.names(), ["map.pgm", "s.toml"])


class Overrides(Command):
    def test_set_is_as_though_it_stood_in_the_scenario(self):
        text = (self.folder / "s.toml").read_text()
        (self.folder / "t.toml").write_text(text.replace("cell_m = 2.0", "cell_m = 3.0") + '[plan]\nmetric = "paper"\n')
        self.expect(0, "plan", "t.toml", "-o", "written")
        done = self.expect(0, "plan", "s.toml", "-o", "set", "--set", "map.cell_m=3", "--set", "plan.metric=paper", "--json")
        written, arrays, _ = read_safetensors(self.folder / "written")
        record, same_arrays, _ = read_safetensors(self.folder / "set")
        for name, array in arrays.items():
            np.testing.assert_array_equal(array, same_arrays[name])
        self.assertEqual(record["options"], written["options"])
        self.assertEqual(record["options"]["map"]["cell_m"], 3.0)
        digest = hashlib.sha256(text.encode()).hexdigest()  # the file's own
        self.assertIn({"path": "s.toml", "sha256": digest}, record["inputs"])
        self.assertEqual(json.loads(done.stdout)["set"], {"map.cell_m": 3.0, "plan.metric": "paper"})
        self.assertNotIn("set", json.loads(self.expect(0, "plan", "s.toml", "-o", "p", "--json").stdout))

    def test_a_wrong_key_or_value_is_wrong_usage_told_before_files_are_read(self):
        for command in ("run", "plan"):
            for text, expected in (
                    ("map.cel_m=3", "map.cel_m: there is no such key; did you mean map.cell_m?"),
                    ("map.cell_m=-3", "map.cell_m: expected a number in (0, 1000000000], found -3"),
                    ("map.cell_m", "expected KEY=VALUE, such as map.cell_m=4.0"),
                    ("plan.metric=exact", 'plan.metric: expected "euclidean", "octile" or "paper", found \'exact\'')):
                done = self.expect(64, command, "none.toml", "-o", "o", "--set", text)
                self.assertIn(f"--set: {expected}", done.stderr)

    def test_what_only_the_map_can_tell_names_the_option_too(self):
        done = self.expect(65, "plan", "s.toml", "-o", "p", "--set", "mission.goal_m=[500, 45]")
        self.assertTrue(done.stderr.startswith("fairway: --set: mission.goal_m: "), done.stderr)
        done = self.expect(65, "plan", "s.toml", "-o", "p", "--set", "map.file=none.pgm")
        self.assertIn("none.pgm: no such file (map.file of --set)", done.stderr)
        done = self.expect(65, "plan", "s.toml", "-o", "p", "--set", "map.cell_m=1e-6")
        self.assertTrue(done.stderr.startswith("fairway: --set: map.cell_m: "), done.stderr)
        self.assertEqual(self.names(), ["map.pgm", "s.toml"])

    def test_the_short_names_say_how_far_a_proof_goes(self):
        def options(*words):
            done = self.expect(0, "run", "s.toml", "-o", "out", "--force", "--json", *words)
            return json.loads(done.stdout)["verify"]["options"]
        self.assertEqual(options()["undecided_max"], 0.1)
        self.assertEqual(options("--undecided-max", "1")["undecided_max"], 1.0)
        self.assertEqual(options("--time-limit", "7.5")["time_limit_s"], 7.5)
        self.assertEqual(options("--set", "verify.time_limit_s=3", "--time-limit", 7)["time_limit_s"], 7.0)
        self.expect(64, "run", "s.toml", "--time-limit", "0")
        self.expect(64, "run", "s.toml", "--undecided-max", "2")
        self.expect(64, "run", "s.toml", "--no-verify", "--time-limit", "3")
        self.expect(64, "plan", "s.toml", "-o", "p", "--no-verify")

    def test_a_run_without_proof_says_so_and_has_no_certificate(self):
        done = self.expect(0, "run", "s.toml", "-o", "out", "--no-verify")
        self.assertIn("Nothing was verified.", done.stdout)
        names = {p.name for p in (self.folder / "out").iterdir()}
        self.assertEqual(names & {"certificate.safetensors", "failures.csv", "verdicts.svg", "proved.svg"}, set())
        self.assertIn("plan.svg", names)
        summary = json.loads((self.folder / "out/summary.json").read_text())
        self.assertEqual(summary["verify"]["method"], "none")
        self.assertEqual(summary["set"], {"verify.method": "none"})


class Draw(Command):
    def test_a_plan_and_its_verdicts_by_the_ending_of_the_name(self):
        self.expect(0, "plan", "s.toml", "-o", "p", "--picture", "with.svg")
        self.expect(0, "draw", "p", "-o", "p.png")
        self.assertTrue((self.folder / "p.png").read_bytes().startswith(b"\x89PNG"))
        shutil.copy(self.folder / "p", self.folder / "s")
        self.expect(0, "draw", "s", "-o", "s.svg")
        # The picture is the same whether drawn with the plan or from its file of the same name.
        self.assertEqual((self.folder / "s.svg").read_bytes(), (self.folder / "with.svg").read_bytes())
        self.expect(0, "verify", "p", "-o", "c", "--undecided-max", "0.5", "--volume-samples", "1000")
        done = self.expect(0, "draw", "c", "-o", "c.svg", "--json")
        self.assertEqual(json.loads(done.stdout), {"picture": "c.svg", "of": "verdicts"})
        self.assertIn("<svg", (self.folder / "c.svg").read_text())

    def test_wrong_endings_and_wrong_files_are_refused(self):
        plan = self.plan()
        for words in (("draw", plan, "-o", "p.jpg"), ("draw", plan, "-o", "p"),
                      ("plan", "s.toml", "-o", "q", "--picture", "q.pdf")):
            self.assertIn(".svg or .png", self.expect(64, *words).stderr)
        self.expect(65, "draw", "s.toml", "-o", "s.svg")
        (self.folder / "kept.svg").write_text("precious")
        self.expect(65, "draw", plan, "-o", "kept.svg")
        self.expect(65, "plan", "s.toml", "-o", "q", "--picture", "kept.svg")
        self.assertEqual((self.folder / "kept.svg").read_text(), "precious")
        self.assertNotIn("q", self.names())


class Plan(Command):
    def test_the_file_reads_as_plain_safetensors(self):
        record, arrays, length = read_safetensors(self.plan())
        self.assertEqual(length % 8, 0)
        self.assertEqual({n: (a.dtype.str, a.shape) for n, a in arrays.items()},
                         {"heading_rad": ("<f4", (47, 62)), "cost_m": ("<f4", (47, 62)),
                          "region": ("|i1", (47, 62))})
        self.assertEqual(record["format_version"], 1)
        self.assertEqual(record["cell_m"], 2.0)
        self.assertEqual(record["origin_m"], [-2.0, -2.0])
        self.assertEqual(record["vehicle"], {"speed_mps": 10.0, "turn_radius_m": 4.0})
        self.assertEqual(record["mission"]["goal_m"], [90.0, 45.0])
        self.assertEqual(record["options"]["plan"]["metric"], "euclidean")
        for name, array in arrays.items():
            self.assertEqual(hashlib.sha256(array.tobytes()).hexdigest(), record["sha256"][name])
        heading = arrays["heading_rad"].astype(float)
        has_command = ~np.isnan(heading)
        self.assertTrue((np.abs(heading[has_command]) < math.pi).all())
        self.assertTrue(has_command[np.isfinite(arrays["cost_m"]) & (arrays["region"] != 1)].all())
        self.assertTrue((arrays["region"][0] == 1).all())  # the ring: outside = "obstacle"
        # Row 0 is the lowest: the goal cells lie about (90, 45), to the right of the middle.
        iy, ix = np.nonzero(arrays["region"] == 2)
        self.assertAlmostEqual(-2 + 2 * (ix.mean() + 0.5), 90, delta=1)
        self.assertAlmostEqual(-2 + 2 * (iy.mean() + 0.5), 45, delta=1)
        # Left of the goal the command is east.
        self.assertLess(abs(heading[23, 15]), 0.2)

    def test_the_bytes_depend_on_nothing_else(self):
        first = self.plan().read_bytes()
        self.expect(0, "plan", "s.toml", "-o", "p.safetensors", "--force", "--threads", 1)
        self.assertEqual((self.folder / "p.safetensors").read_bytes(), first)
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        shutil.copy(self.folder / "map.pgm", elsewhere)
        shutil.copy(self.folder / "s.toml", elsewhere)
        self.expect(0, "plan", elsewhere / "s.toml", "-o", "q.safetensors")
        self.assertEqual((self.folder / "q.safetensors").read_bytes(), first)

    def test_an_existing_plan_is_kept_unless_forced(self):
        (self.folder / "p.safetensors").write_text("precious")
        done = self.expect(65, "plan", "s.toml", "-o", "p.safetensors")
        self.assertIn("p.safetensors: already exists", done.stderr)
        self.assertEqual((self.folder / "p.safetensors").read_text(), "precious")

    def test_json_is_one_object_and_words_stay_away(self):
        done = self.expect(0, "plan", "s.toml", "-o", "p", "--json")
        self.assertEqual(json.loads(done.stdout)["cells"], [62, 47])
        self.assertEqual(self.expect(0, "plan", "s.toml", "-o", "q", "--quiet").stdout, "")
        failed = self.expect(65, "plan", "none.toml", "-o", "r", "--json")
        self.assertEqual(json.loads(failed.stdout)["exit_code"], 65)


class Verify(Command):
    def test_draws_pictures_into_a_folder_of_their_own(self):
        self.plan()
        self.expect(0, "verify", "p.safetensors", "-o", "c.safetensors", "--pictures", "pictures",
                    "--undecided-max", "0.05", "--volume-samples", "10000")
        self.assertEqual({p.name for p in (self.folder / "pictures").iterdir()},
                         {f"{name}.{kind}" for name in ("verdicts", "proved", "counterexamples")
                          for kind in ("svg", "png")})
        done = self.expect(65, "verify", "p.safetensors", "-o", "again.safetensors", "--pictures",
                           "pictures")
        self.assertIn("pictures", done.stderr)
        self.assertNotIn("again.safetensors", self.names())

    def test_killed_half_way_leaves_nothing_and_what_was_there_can_be_resumed(self):
        self.plan()
        quick = ("--undecided-max", "0.5", "--volume-samples", "1000")
        endless = ("verify", "p.safetensors", "-o", "c.safetensors", "--force", "--undecided-max",
                   "0", "--time-limit", "100")
        for before in (None, "there"):
            if before:
                self.expect(0, "verify", "p.safetensors", "-o", "c.safetensors", *quick)
                before = (self.folder / "c.safetensors").read_bytes()
            for wait_s in (0.0, 0.1, 0.5):
                with self.subTest(before=before is not None, wait_s=wait_s):
                    running = subprocess.Popen([FAIRWAY, *endless], cwd=self.folder,
                                               stderr=subprocess.DEVNULL)
                    time.sleep(wait_s)
                    running.kill()
                    running.wait()
                    path = self.folder / "c.safetensors"
                    self.assertEqual(path.read_bytes() if path.exists() else None, before)
        self.expect(0, "verify", "p.safetensors", "-o", "d.safetensors", "--resume",
                    "c.safetensors", *quick)
        self.expect(0, "check", "d.safetensors")

    def test_what_is_resumed_says_how_much_was_dropped_and_keeps_to_the_time_limit(self):
        self.plan()
        quick = ("--undecided-max", "0.5", "--volume-samples", "1000")
        self.expect(0, "verify", "p.safetensors", "-o", "c", *quick)
        done = self.expect(0, "verify", "p.safetensors", "-o", "d", "--resume", "c", *quick)
        self.assertRegex(done.stdout, r"All \d+ decided leaves of c were proved again\.")
        resumed = json.loads((self.folder / "d.summary.json").read_text())["resumed"]
        self.assertEqual((resumed["dropped_leaves"], resumed["in_time"]), (0, True))
        done = self.expect(0, "verify", "p.safetensors", "-o", "e", "--resume", "c", "--time-limit", "1e-9", *quick)
        self.assertRegex(done.stdout, r"Of \d+ decided leaves of c, \d+ were dropped: the time limit left no time")
        self.expect(0, "check", "e")

    def test_a_line_now_and_then_where_nobody_watches_and_none_with_quiet(self):
        self.plan()
        endless = ("verify", "p.safetensors", "--undecided-max", "0", "--time-limit", "11")
        both = [subprocess.Popen([FAIRWAY, *endless, "-o", name, *more], cwd=self.folder, text=True,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
                for name, more in (("c", ()), ("d", ("--quiet",)))]
        told, silence = [process.communicate(timeout=120)[1] for process in both]
        self.assertRegex(told, r"^fairway: verifying[^\n]*, 1\d s so far, time limit (in \d s|reached)\n")
        self.assertNotIn("so far", silence)

    def test_a_terminal_is_told_the_time_that_is_left(self):
        self.plan()
        terminal, end = pty.openpty()
        running = subprocess.Popen([FAIRWAY, "verify", "p.safetensors", "-o", "c", "--undecided-max", "0",
                                    "--time-limit", "4", "--volume-samples", "1000"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=end)
        os.close(end)
        shown = b""
        while True:
            try:
                shown += os.read(terminal, 65536)
            except OSError:  # the other end is closed
                break
        os.close(terminal)
        self.assertEqual(running.wait(60), 0)
        self.assertRegex(shown, rb"% undecided  \d s so far, time limit in \d s")

    def test_a_bitmap_is_drawn_asked_exported_and_no_certificate(self):
        self.plan()
        for words in (("--failures", "f.csv"), ("--resume", "c.safetensors")):
            self.expect(64, "verify", "p.safetensors", "-o", "b", "--method", "bitmap", *words)
        told = self.expect(0, "verify", "p.safetensors", "-o", "b", "--method", "bitmap",
                           "--border-samples", 20, "--pictures", "pictures").stdout
        self.assertIn("not a proof", told)
        self.assertIn("Bitmap: b. Summary: ", told)
        self.assertEqual(sorted(os.listdir(self.folder / "pictures")),
                         ["sampled.png", "sampled.svg", "slices.png", "slices.svg"])
        summary = json.loads((self.folder / "b.summary.json").read_text())
        self.assertEqual((summary["method"], summary["proved"]), ("bitmap", False))
        answer = self.expect(0, "query", "b", "--state", "20,45,0").stdout.splitlines()
        self.assertEqual(answer[0], "x_m,y_m,heading_rad,verdict,time_bound_s")
        self.assertRegex(answer[1], r"^20,45,0,(sampled_reach|sampled_other|undecided),$")
        told = json.loads(self.expect(0, "query", "b", "--state", "20,45,0", "--json").stdout)
        self.assertEqual(told["bitmap"], "b")
        self.assertIn("not a proof", self.expect(0, "export", "b", "-o", "b.tif").stdout)
        for words in (("check", "b"), ("simulate", "b", "--state", "20,45,0"), ("verify", "b", "-o", "c")):
            self.assertIn("is a bitmap", self.expect(65, *words).stderr)

    def test_a_region_of_any_cells_is_proved_and_checked(self):
        self.plan()
        (self.folder / "area.geojson").write_text(
            '{"type": "Polygon", "coordinates": [[[12, 12], [40, 12], [26, 40], [12, 12]]]}')
        (self.folder / "cells.csv").write_text("ix,iy\n5,5\n6,5\n")
        for region in ("area.geojson", "cells.csv"):
            self.expect(0, "verify", "p.safetensors", "-o", "c", "--force", "--region", region,
                        "--undecided-max", 0.9, "--volume-samples", 2000)
            self.expect(0, "check", "c")
        self.expect(65, "verify", "p.safetensors", "-o", "area.geojson", "--force", "--region", "area.geojson")
        self.assertIn("or a file", self.expect(64, "verify", "p.safetensors", "-o", "d", "--region", "nowhere").stderr)
        (self.folder / "cells.csv").write_text("ix,iy\n5,5000\n")
        self.assertIn("cells.csv:2: is no cell", self.expect(65, "verify", "p.safetensors", "-o", "d",
                                                             "--region", "cells.csv").stderr)
        self.assertNotIn("d", self.names())

    def test_the_sets_of_a_cell_are_printed_and_drawn(self):
        self.plan()
        told = self.expect(0, "cell", "p.safetensors", "--cell", "5,5", "--entry", "left", "-o", "cell.png").stdout
        self.assertEqual(told.splitlines()[0], "set,entry,exit,along_m,from_rad,to_rad")
        self.assertTrue(all(line.split(",")[1] == "left" for line in told.splitlines()[1:]))
        self.assertEqual((self.folder / "cell.png").read_bytes()[:4], b"\x89PNG")
        self.expect(65, "cell", "p.safetensors", "--cell", "5,5", "-o", "cell.png")
        self.assertIn("has no cell 500,5", self.expect(65, "cell", "p.safetensors", "--cell", "500,5").stderr)
        for wrong in (("--cell", "5"), ("--cell", "5,5", "--exit", "up"), ("--cell", "5,5", "-o", "x.gif")):
            self.expect(64, "cell", "p.safetensors", *wrong)


class Simulate(Command):
    def test_flies_states_from_everywhere_and_writes_all_files(self):
        plan = self.plan()
        (self.folder / "states.csv").write_text("x_m,y_m,heading_rad\n20,20,1.5\n30,60,90deg\n")
        self.expect(0, "simulate", plan, "--state", "20,45,180deg", "--state", "25,45,-0.5",
                    "--states", "states.csv", "--random", 6, "--seed", 3, "--csv", "t.csv",
                    "--outcomes", "o.csv", "--geojson", "t.geojson")
        with open(self.folder / "o.csv") as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual(list(rows[0]), ["x_m", "y_m", "heading_rad", "outcome", "time_s", "length_m",
                                         "flown_m", "reversals", "turned_rad"])
        self.assertEqual(len(rows), 10)
        self.assertAlmostEqual(float(rows[0]["heading_rad"]), math.pi)
        self.assertAlmostEqual(float(rows[3]["heading_rad"]), math.pi / 2)
        for row in rows[:4]:
            self.assertEqual(row["outcome"], "reach")
            self.assertAlmostEqual(float(row["length_m"]), 10 * float(row["time_s"]), places=6)
            # No shorter than the distance to the goal disc (beta r = 8 m), minus a cell of tolerance.
            way = math.dist((float(row["x_m"]), float(row["y_m"])), (90, 45)) - 8
            self.assertGreaterEqual(float(row["length_m"]), way - 1e-6)
        with open(self.folder / "t.csv") as lines:
            flights = {row["flight"] for row in csv.DictReader(lines)}
        self.assertEqual(flights, {str(i) for i in range(10)})

    def test_outcomes_can_go_to_stdout(self):
        done = self.expect(0, "simulate", self.plan(), "--state", "20,45,0", "--outcomes", "-")
        self.assertEqual(done.stdout.splitlines()[0],
                         "x_m,y_m,heading_rad,outcome,time_s,length_m,flown_m,reversals,turned_rad")
        self.assertEqual(len(done.stdout.splitlines()), 2)

    def test_random_starts_do_not_depend_on_threads_or_on_how_many(self):
        plan = self.plan()
        for law in ("exact", "proportional"):
            some = self.expect(0, "simulate", plan, "--random", 50, "--law", law, "--outcomes", "-",
                               "--threads", 1).stdout
            more = self.expect(0, "simulate", plan, "--random", 2500, "--law", law, "--outcomes", "-",
                               "--threads", 2).stdout
            self.assertTrue(more.startswith(some))

    def test_a_damaged_plan_is_refused(self):
        plan = self.plan()
        data = bytearray(plan.read_bytes())
        data[-40] ^= 1
        plan.write_bytes(data)
        done = self.expect(65, "simulate", plan, "--random", 1)
        self.assertIn("sha256", done.stderr)

    def test_wrong_input_is_told_apart_from_wrong_usage(self):
        plan = self.plan()
        (self.folder / "nan.csv").write_text("nan,0,0\n")
        self.expect(65, "simulate", plan, "--states", "none.csv")
        self.assertIn("nan.csv:1: ", self.expect(65, "simulate", plan, "--states", "nan.csv").stderr)
        self.expect(64, "simulate", plan)
        self.expect(64, "simulate", plan, "--random", "x")
        self.expect(64, "simulate", plan, "--random", 1, "--wind", "1,2")
        self.expect(64, "simulate", plan, "--random", 1, "--law", "magic")
        self.expect(65, "simulate", plan, "--random", 1, "--outcomes", "none/o.csv")

    def test_a_wrong_value_on_the_command_line_is_wrong_usage_reported_before_files_are_read(self):
        for state in ("1,2", "1,2,3,4", "nan,0,0", "inf,0,0", "0,x,0", "0,0,", "", "1 2 3"):
            done = self.expect(64, "simulate", "none.safetensors", "--state", state)
            self.assertIn("--state: ", done.stderr)
        self.assertIn("expected 3", self.expect(64, "simulate", "none", "--state", "1,2").stderr)
        sampled = ("simulate", "none", "--random", 1, "--law", "bang-bang")
        for option, wrong in (
                ("--wind", ("1", "nan,0", "0,inf", "a,b")),
                ("--gust", ("nan", "-1", "inf", "x")),
                ("--gain", ("nan", "0", "-0", "1e999")),
                ("--period", ("nan", "0", "1e-300", "inf")),
                ("--gust-time", ("0", "nan")),
                ("--time-limit", ("0", "nan", "inf")),
                ("--position-noise", ("nan", "-1")),
                ("--heading-noise", ("nan", "-1deg", "200deg", "4", "deg", "x")),
                ("--step", ("nan", "0", "inf")),
                ("--seed", ("-1", "1.5", "x")),
                ("--random", ("-1", "1e9"))):
            for value in wrong:
                done = self.expect(64, *sampled, f"{option}={value}")
                self.assertIn(option, done.stderr)
                self.assertLess(len(done.stderr), 300)
        self.expect(64, *sampled, "--csv", "-", "--outcomes", "-")
        self.expect(65, *sampled, "--heading-noise", "180deg", "--wind", "-1,2")  # "none" is not a plan


class Usage(Command):
    def test_exit_codes(self):
        self.expect(0, "--help")
        self.expect(0, "run", "--help")
        self.assertRegex(self.expect(0, "--version").stdout, r"^fairway \d+\.\d+\.\d+\n$")
        self.assertIn("`map.cell_m`", self.expect(0, "--scenario-keys").stdout)
        self.expect(64)
        self.expect(64, "frobnicate")
        self.expect(64, "run")
        self.expect(64, "plan", "s.toml")
        self.expect(64, "run", "s.toml", "--no-such-option")
        self.expect(64, "--threads", "0", "run", "s.toml")
        self.expect(65, "run", "none.toml")
        self.expect(65, "run", ".")

    def test_scenario_faults_name_file_line_and_key(self):
        for old, new, expected in (
                ("cell_m = 2.0", "cell_m = 4.0", "s.toml:7: vehicle.turn_radius_m: is 4 m, expected "
                 "more than map.cell_m, which is 4 m"),
                ("cell_m = 2.0", "cel_m = 2.0",
                 "s.toml:4: map.cel_m: there is no such key; did you mean map.cell_m?"),
                ("map.pgm", "none.pgm", "none.pgm"),
                ("speed_mps = 10.0", "speed_mps = inf", "s.toml:6: vehicle.speed_mps: expected")):
            self.scenario("s.toml")
            text = (self.folder / "s.toml").read_text()
            self.assertIn(old, text)
            (self.folder / "s.toml").write_text(text.replace(old, new))
            done = self.expect(65, "run", "s.toml", "-o", "out")
            self.assertIn(expected, done.stderr)
            self.assertEqual(self.names(), ["map.pgm", "s.toml"])

    def test_the_demonstration_runs(self):
        scenario = os.path.join(SOURCE, "demo", "demo.toml")
        done = self.expect(0, "run", scenario, "-o", "demo")
        summary = json.loads((self.folder / "demo/summary.json").read_text())
        self.assertGreater(summary["random_flights"]["share"]["reach"], 0.99)
        self.assertIn("demo/plan.svg", done.stdout)


if __name__ == "__main__":
    FAIRWAY, SOURCE = (os.path.abspath(path) for path in sys.argv[1:3])
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
