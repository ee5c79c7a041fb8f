#!/usr/bin/env python3
"""`fairway contract` as a user sees it.

Usage: contract_command_test.py FAIRWAY [unittest arguments]
"""
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

FAIRWAY = None
NUMBERS = ["--airspeed", 20, "--turn-radius", 50]


def log_lines(seed, seconds=120, delay=4, ignored=None, step=None):
    """A vehicle that obeys after `delay` tenths of a second, on circles of 20 m; one line a sample."""
    draw = random.Random(seed)
    x = y = course = 0.0
    asked = [0.0] * (delay + 1)
    command, until = 0.0, 3.0
    lines = ["t_s,x_m,y_m,course_rad,command_rad"]
    for k in range(10 * seconds):
        t = 0.1 * k
        if t >= until:
            command, until = command + draw.choice([-1, 1]) * draw.uniform(0.6, 2.2), t + draw.uniform(5.0, 9.0)
        shown = [math.remainder(a, 2 * math.pi) for a in (course, command)]
        lines.append(f"{t:.1f},{x:.3f},{y:.3f},{shown[0]:.5f},{shown[1]:.5f}")
        obeys = not (ignored and ignored[0] <= t < ignored[1])
        asked = asked[1:] + [command if obeys else asked[-1]]
        for _ in range(10):
            turn = math.remainder(asked[0] - course, 2 * math.pi)
            course += max(-0.005, min(0.005, turn))
            x += 0.1 * math.cos(course)
            y += 0.1 * math.sin(course)
    return lines


class Contract(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-contract-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def contract(self, *words, code=0):
        done = subprocess.run([FAIRWAY, "contract", *map(str, words)], cwd=self.folder, text=True,
                              capture_output=True, timeout=300, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def write(self, name, lines):
        (self.folder / name).write_text("\n".join(lines) + "\n")

    def test_every_number_that_counts_has_its_reason(self):
        text = self.contract(*NUMBERS, "--delay", 0.2, "--wind", 4).stdout
        for key in ("command_error_m", "heading_error_rad", "turn_radius_m", "speed_mps", "side_uncertain_rad"):
            self.assertRegex(text, rf"(?m)^# .*\n{key} = ")
        self.assertIn("[vehicle.contract]\n", text)

    def test_what_it_prints_is_a_contract_and_goes_to_a_file_whole(self):
        printed = self.contract(*NUMBERS).stdout
        self.contract(*NUMBERS, "-o", "c.toml")
        self.assertEqual((self.folder / "c.toml").read_text(), printed)
        self.contract(*NUMBERS, "-o", "c.toml", code=65)
        self.assertEqual(self.contract(*NUMBERS, "--quiet").stdout, printed)
        self.write("log.csv", log_lines(1))
        self.contract("--log", "log.csv", "--contract", "c.toml", code=1)  # 50 m are not 20 m
        told = json.loads(self.contract(*NUMBERS, "--json").stdout)
        self.assertEqual(told["contract"]["turn_radius_m"], [45.0, 55.0])

    def test_wrong_usage_says_what_is_missing(self):
        for words, hint in ((["--turn-radius", 5], "--airspeed, or --log"),
                            (["--airspeed", 5], "0 of them given, expected one"),
                            (["--airspeed", 5, "--turn-radius", 5, "--turn-rate", 1], "2 of them given"),
                            ([*NUMBERS, "--wind", 30], "expected less than the least airspeed, 19 m/s"),
                            ([*NUMBERS, "--heading-error", "91deg"], "quarter turn"),
                            (["--airspeed", 5, "--bank-limit", "89deg"], "less than 85deg"),
                            ([*NUMBERS, "--margin", 0.1], "--log"),
                            (["--log", "x.csv", "--airspeed", 5], "--airspeed"),
                            (["--log", "x.csv", "--columns", "when=t"], "a part of time, x, y"),
                            (["--log", "x.csv", "--picture", "p.svg"], "--contract")):
            with self.subTest(words=words):
                self.assertIn(hint, self.contract(*words, code=64).stderr)

    def test_a_fit_is_kept_by_its_logs_and_by_another_flight(self):
        for seed in (1, 2, 3):
            self.write(f"{seed}.csv", log_lines(seed))
        self.contract("--log", "1.csv", "2.csv", "--margin", 0.3, "-o", "c.toml")
        text = (self.folder / "c.toml").read_text()
        self.assertIn("From 2 flight logs", text)
        self.assertRegex(text, r"decided by [12]\.csv at t = ")
        low, high = map(float, re.search(r"turn_radius_m = \[(.*), (.*)\]", text).groups())
        self.assertTrue(17.0 < low < 20.0 < high < 23.0, text)
        told = self.contract("--log", "1.csv", "2.csv", "3.csv", "--contract", "c.toml").stdout
        self.assertIn("3 of 3 logs keep the contract.", told)

    def test_the_tightest_contract_is_kept_by_its_own_log_as_the_file_says(self):
        for seed in (7, 8):
            self.write("log.csv", log_lines(seed))
            self.contract("--log", "log.csv", "-o", "c.toml", "--force")
            words = re.search(r"# fairway contract --log OTHER.csv --contract FILE.toml (.*)\n",
                              (self.folder / "c.toml").read_text())[1].split()
            self.contract("--log", "log.csv", "--contract", "c.toml", *words)

    def test_a_command_ignored_is_found_and_drawn(self):
        lines = log_lines(4)
        times = [i for i in range(602, len(lines)) if lines[i].split(",")[4] != lines[i - 1].split(",")[4]]
        given = float(lines[times[0]].split(",")[0])
        self.write("good.csv", lines)
        self.write("bad.csv", log_lines(4, ignored=(given, given + 4.0)))
        self.contract("--airspeed", 10, "--turn-radius", 20, "--delay", 0.5, "--position-error", 2, "-o", "c.toml")
        self.contract("--log", "good.csv", "--contract", "c.toml")
        done = self.contract("--log", "good.csv", "bad.csv", "--contract", "c.toml", "--picture", "p.svg", code=1)
        self.assertIn("1 of 2 logs keep the contract", done.stdout)
        until = float(re.search(r"bad.csv: NOT kept: .* beyond t = ([\d.]+) s", done.stdout)[1])
        self.assertTrue(given < until < given + 5.0, done.stdout)
        self.assertIn("contract not kept", (self.folder / "p.svg").read_text())
        told = json.loads(self.contract("--json", "--log", "bad.csv", "--contract", "c.toml", code=1).stdout)
        self.assertFalse(told["logs"][0]["kept"])
        self.assertEqual(told["logs"][0]["kept_until_s"], until)

    def test_logs_that_say_nothing_are_refused_and_nothing_is_written(self):
        good = log_lines(5)
        fields = [line.split(",") for line in good]
        still = [",".join([f[0], f[1], f[2], f[3], "0.0"]) for f in fields[1:]]
        straight = [f"{0.1 * k:.1f},{k},0,0,{0.1 * (k // 100)}" for k in range(600)]
        degrees = [",".join([f[0], f[1], f[2], "90.0", f[4]]) for f in fields[1:]]
        for lines, hint in ((good[:1] + still, "the command never changes"),
                            (good[:1] + straight, "never turns"),
                            (good[:1] + degrees, ":2: course_rad is 90: expected radians"),
                            (good[:400] + good[450:], ":401: a gap of 5.1 s"),
                            (good[:400] + good[300:], ":401: time goes from"),
                            (good[:20], "19 samples: expected at least 50"),
                            (["t,x,y"] + good[1:], "no column t_s among t,x,y"),
                            (good[:1] + good[1::10], "more than a third of the turning radius")):
            with self.subTest(hint=hint):
                self.write("log.csv", lines)
                self.assertIn(hint, self.contract("--log", "log.csv", "-o", "c.toml", code=65).stderr)
                self.assertFalse((self.folder / "c.toml").exists())
        self.assertIn("expected a CSV file", self.contract("--log", "none.csv", code=65).stderr)

    def test_threads_do_not_change_a_byte(self):
        self.write("log.csv", log_lines(6, seconds=60))
        self.assertEqual(self.contract("--threads", 1, "--log", "log.csv").stdout,
                         self.contract("--threads", 2, "--log", "log.csv").stdout)


if __name__ == "__main__":
    FAIRWAY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
