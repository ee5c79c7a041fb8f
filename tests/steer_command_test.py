#!/usr/bin/env python3
"""`fairway steer` as a user sees it: lengths against a brute force of the six words in numpy.

Usage: steer_command_test.py FAIRWAY [unittest arguments]
"""
import csv
import io
import json
import math
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

FAIRWAY = None
COLUMNS = ["length_m", "word", "converged", "end_x_m", "end_y_m", "end_heading_rad"]


def brute_force(start, goal, radius):
    """Shortest length over the six words, arrays of shape [n, 3]; the textbook's formulas."""
    d = (goal[:, :2] - start[:, :2]) / radius
    h0, h1 = start[:, 2], goal[:, 2]
    best = np.full(len(d), np.inf)

    def turn(a):
        return np.mod(a, 2 * np.pi)

    def centre(pose, side):
        return np.stack([-side * np.sin(pose), side * np.cos(pose)], axis=1)

    for first in (1, -1):
        for last in (1, -1):
            v = d + centre(h1, last) - centre(h0, first)
            length, angle = np.hypot(*v.T), np.arctan2(v[:, 1], v[:, 0])
            if first == last:
                straight = length
            else:
                straight = np.sqrt(np.where(length >= 2, length**2 - 4, np.nan))
                angle = angle + first * np.arctan2(2, straight)
            total = turn(first * (angle - h0)) + straight + turn(last * (h1 - angle))
            best = np.fmin(best, total)
            if first != last:
                continue
            bend = np.arccos(np.where(length <= 4, length, np.nan) / 4)
            middle = np.pi + 2 * bend
            # The middle circle touches the first one in this direction from its centre.
            touch = angle + first * bend
            t = turn(first * (touch - h0) + np.pi / 2)
            total = t + middle + turn(first * (h1 - h0) - t + middle)
            best = np.fmin(best, total)
    return best * radius


class Steer(unittest.TestCase):
    def steer(self, *arguments, code=0, text=None):
        done = subprocess.run([FAIRWAY, "steer", *map(str, arguments)], text=True, input=text,
                              capture_output=True)
        self.assertEqual(done.returncode, code, done.stdout[:500] + done.stderr)
        return done

    def rows(self, done):
        lines = list(csv.reader(io.StringIO(done.stdout)))
        self.assertEqual(lines[0], COLUMNS)
        return [dict(zip(COLUMNS, line)) for line in lines[1:]]

    def test_pairs_have_the_least_length_and_end_at_their_goals(self):
        draw = np.random.default_rng(4)
        for radius, n in ((1.0, 10_000), (20.0, 100_000)):
            for box in (1, 4, 40):
                start, goal = (np.column_stack([draw.uniform(0, box * radius, (n, 2)),
                                                draw.uniform(-math.pi, math.pi, n)])
                               for _ in range(2))
                text = "\n".join(",".join(map(repr, row))
                                 for row in np.hstack([start, goal]).tolist())
                rows = self.rows(self.steer("--turn-radius", radius, "--pairs", "-", text=text))
                lengths = np.array([float(row["length_m"]) for row in rows])
                np.testing.assert_allclose(lengths, brute_force(start, goal, radius),
                                           rtol=0, atol=1e-9 * radius)
                ends = np.array([[float(row[c]) for c in COLUMNS[3:]] for row in rows])
                self.assertLess(np.abs(ends[:, :2] - goal[:, :2]).max(), 1e-10 * radius)
                off = np.mod(ends[:, 2] - goal[:, 2] + np.pi, 2 * np.pi) - np.pi
                self.assertLess(np.abs(off).max(), 1e-12)
                self.assertEqual({row["converged"] for row in rows}, {"true"})
                self.assertLessEqual({row["word"] for row in rows},
                                     {"LSL", "RSR", "LSR", "RSL", "RLR", "LRL"})

    def test_one_pair_and_the_same_in_a_file_with_a_header_in_another_order(self):
        one = self.steer("--from", "0,0,90deg", "--to=-3,4,-1.5", "--turn-radius", "2").stdout
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "pairs.csv"
            path.write_bytes(b"\xef\xbb\xbf# pairs\r\nh0_rad,x0_m,name,y0_m,x1_m,y1_m,h1_rad\r\n\r\n"
                             b"90deg, 0 ,a,+0,-3,4,-1.5\r\n")
            self.assertEqual(self.steer("--pairs", path, "--turn-radius", 2).stdout, one)

    def test_numbers_come_back_as_they_were(self):
        row = self.rows(self.steer("--from", "0.1,0.2,0.3", "--to", "0.1,0.2,0.3",
                                   "--turn-radius", 3))[0]
        self.assertEqual([row[c] for c in COLUMNS],
                         ["0", "LSL", "true", "0.1", "0.2", "0.3"])

    def test_json_is_one_object(self):
        done = self.steer("--json", "--from", "0,0,0", "--to", "7,0,0", "--turn-radius", 2)
        answer = json.loads(done.stdout)
        self.assertEqual(answer["paths"][0]["length_m"], 7.0)
        self.assertIs(answer["paths"][0]["converged"], True)

    def test_the_papers_law_converges_but_not_always_by_the_shortest_path(self):
        draw = np.random.default_rng(5)
        n = 500
        start = np.column_stack([draw.uniform(-80, 80, (n, 2)), draw.uniform(-math.pi, math.pi, n)])
        goal = np.tile([0.0, 0.0, math.pi / 2], (n, 1))
        text = "\n".join(",".join(map(repr, row)) for row in np.hstack([start, goal]).tolist())
        rows = self.rows(self.steer("--turn-radius", 20, "--law", "clf", "--pairs", "-", text=text))
        self.assertEqual({row["converged"] for row in rows}, {"true"})
        excess = np.array([float(row["length_m"]) for row in rows]) - brute_force(start, goal, 20.0)
        self.assertGreater(excess.min(), -2.0)
        self.assertGreater(excess.max(), 2.0)
        for row in rows:
            self.assertLess(math.hypot(float(row["end_x_m"]), float(row["end_y_m"])), 0.4)
            self.assertLessEqual(set(row["word"]), set("LSR"))

    def test_goals_that_move_and_noise_are_borne_by_both_laws(self):
        poses = ("--from", "0,0,0", "--to", "100,50,90deg", "--turn-radius", 20)
        for law in ("shortest", "clf"):
            unrest = (*poses, "--law", law, "--goal-speed", 0.25, "--noise", 0.02)
            done = self.steer(*unrest)
            row = self.rows(done)[0]
            self.assertEqual(row["converged"], "true")
            driven = float(row["length_m"])
            self.assertAlmostEqual(float(row["end_x_m"]), 100.0, delta=0.4)
            self.assertAlmostEqual(float(row["end_y_m"]), 50.0 + 0.25 * driven, delta=0.4)
            self.assertEqual(self.steer(*unrest).stdout, done.stdout)
            self.assertNotEqual(self.steer(*unrest, "--seed", 2).stdout, done.stdout)
        with tempfile.TemporaryDirectory() as folder:
            track = Path(folder) / "t.csv"
            self.steer(*poses, "--goal-speed", 0.25, "--step", 0.5, "--track", track)
            with open(track) as file:
                lines = list(csv.DictReader(file))
            steps = {round(float(b["driven_m"]) - float(a["driven_m"]), 9)
                     for a, b in zip(lines, lines[1:])}
            self.assertEqual(steps, {0.5})

    def test_the_papers_law_has_the_papers_parameters(self):
        start = ("--from=-0.65,-0.25,-92.5deg", "--to", "0,0,90deg", "--turn-radius", 1,
                 "--law", "clf")
        figure_6 = self.rows(self.steer(*start))[0]
        self.assertEqual(figure_6["word"], "RLSR")
        self.assertNotEqual(self.rows(self.steer(*start, "--repulsion", "none"))[0]["word"], "RLSR")
        self.assertEqual(self.rows(self.steer(*start, "--n", 3))[0], figure_6)  # shapes V alone
        wide = self.rows(self.steer(*start, "--tolerance", 0.2))[0]
        self.assertLess(float(wide["length_m"]), float(figure_6["length_m"]))

    def test_flights_that_cannot_be_are_refused(self):
        poses = ("--from", "0,0,0", "--to", "1,0,0", "--turn-radius")
        for arguments, words in ((("1e14",), "at most 1e+09 metres"),
                                 ((1, "--tolerance", 0.001), "expected more than 0.00505"),
                                 ((1, "--step", 0.2), "expected 0.0001 to 0.1 metres"),
                                 ((1, "--goal-speed", 1), "--goal-speed"),
                                 ((1, "--n", 4), "--law clf")):
            self.assertIn(words, self.steer(*poses, *arguments, code=64).stderr)

    def test_threads_change_nothing(self):
        draw = np.random.default_rng(6)
        text = "\n".join(",".join(map(repr, row)) for row in draw.uniform(-3, 3, (600, 6)).tolist())
        for law in ("shortest", "clf"):
            arguments = ("--turn-radius", 1, "--pairs", "-", "--law", law)
            self.assertEqual(self.steer(*arguments, "--threads", 1, text=text).stdout,
                             self.steer(*arguments, "--threads", 2, text=text).stdout)

    def waypoints(self, rows, header="x_m,y_m,heading_rad\n"):
        return header + "".join(",".join(map(repr, row)) + "\n" for row in rows)

    def test_waypoints_are_legs_from_each_to_the_next(self):
        draw = np.random.default_rng(7)
        rows = np.column_stack([draw.uniform(0, 200, (40, 2)), draw.uniform(-3, 3, 40)])
        text = self.waypoints(rows.tolist())
        legs = self.rows(self.steer("--turn-radius", 20, "--waypoints", "-", text=text))
        lengths = np.array([float(leg["length_m"]) for leg in legs])
        np.testing.assert_allclose(lengths, brute_force(rows[:-1], rows[1:], 20.0), atol=1e-7)
        for leg, goal in zip(legs, rows[1:]):
            self.assertAlmostEqual(float(leg["end_x_m"]), goal[0], places=8)
            self.assertAlmostEqual(float(leg["end_y_m"]), goal[1], places=8)
        # A separate start adds one leg, and then a single waypoint is enough.
        more = self.rows(self.steer("--turn-radius", 20, "--waypoints", "-", "--from", "5,5,1",
                                    text=text))
        self.assertEqual(more[1:], legs)
        one = self.rows(self.steer("--turn-radius", 20, "--waypoints", "-", "--from", "5,5,1",
                                   text="100,50,90deg\n"))
        direct = self.rows(self.steer("--turn-radius", 20, "--from", "5,5,1", "--to", "100,50,90deg"))
        self.assertEqual(one, direct)

    def test_the_papers_law_goes_on_from_where_it_arrived(self):
        rows = [[0, 0, 0], [120, 60, 1.5], [40, 140, 3.0], [40, 140, 0.0]]
        with tempfile.TemporaryDirectory() as folder:
            track = Path(folder) / "t.csv"
            legs = self.rows(self.steer("--turn-radius", 20, "--law", "clf", "--waypoints", "-",
                                        "--track", track, text=self.waypoints(rows)))
            points = np.loadtxt(track, delimiter=",", skiprows=1)
        self.assertEqual([leg["converged"] for leg in legs], ["true"] * 3)
        for k, (leg, goal) in enumerate(zip(legs, rows[1:])):
            of_leg = points[points[:, 0] == k]
            end = [float(leg[c]) for c in COLUMNS[3:]]
            np.testing.assert_array_equal(of_leg[-1, 2:5], end)
            self.assertLess(math.dist(end[:2], goal[:2]), 0.4)
            self.assertLess(abs(math.remainder(end[2] - goal[2], 2 * math.pi)), 0.02)
            if k:  # no jump between legs
                before = points[points[:, 0] == k - 1][-1]
                np.testing.assert_array_equal(of_leg[0, 1:5], before[1:5])
            # Each row leads to the next: the arc of its curvature.
            s = np.diff(of_leg[:, 1])
            half = of_leg[:-1, 5] * s / 2
            along = np.sinc(half / np.pi) * s
            x = of_leg[:-1, 2] + along * np.cos(of_leg[:-1, 4] + half)
            y = of_leg[:-1, 3] + along * np.sin(of_leg[:-1, 4] + half)
            np.testing.assert_allclose(x, of_leg[1:, 2], atol=1e-9)
            np.testing.assert_allclose(y, of_leg[1:, 3], atol=1e-9)
            self.assertLessEqual(np.abs(of_leg[:, 5]).max(), 0.05 + 1e-15)

    def test_a_track_of_the_shortest_path_has_v_fall_by_what_is_driven(self):
        with tempfile.TemporaryDirectory() as folder:
            track = Path(folder) / "t.csv"
            leg = self.rows(self.steer("--turn-radius", 20, "--from", "0,0,0", "--to=-30,9,2",
                                       "--track", track))[0]
            self.assertEqual(track.read_text().splitlines()[0],
                             "leg,driven_m,x_m,y_m,heading_rad,curvature_per_m,value")
            points = np.loadtxt(track, delimiter=",", skiprows=1)
        length = float(leg["length_m"])
        np.testing.assert_allclose(points[:, 6], (length - points[:, 1]) / 20, atol=1e-12)
        self.assertAlmostEqual(points[-1, 1], length, places=9)
        self.assertLessEqual(np.diff(points[:, 1]).max(), 0.2 + 1e-9)
        self.assertEqual(set(np.round(np.unique(points[:, 5]) * 20, 12)) - {-1.0, 0.0, 1.0}, set())

    def test_pictures_appear_whole_and_are_kept_unless_forced(self):
        poses = ("--from", "0,0,0", "--to", "50,80,90deg", "--turn-radius", 20)
        with tempfile.TemporaryDirectory() as folder:
            svg, png = Path(folder) / "p.svg", Path(folder) / "p.png"
            plain = self.steer(*poses).stdout
            self.assertEqual(self.steer(*poses, "--picture", svg).stdout, plain)
            for text in ("start", "goal", "V: what is left of the path"):
                self.assertIn(f">{text}<", svg.read_text())
            self.steer(*poses, "--law", "clf", "--picture", png)
            self.assertEqual(png.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
            before = svg.read_bytes()
            done = self.steer(*poses, "--law", "clf", "--picture", svg, code=65)
            self.assertIn("p.svg", done.stderr)
            self.assertEqual(svg.read_bytes(), before)
            self.steer(*poses, "--law", "clf", "--picture", svg, "--force")
            for text in ("V (Eq. 20)", "V_A, attraction (Eq. 9)"):
                self.assertIn(f">{text}<", svg.read_text())
            self.steer("--turn-radius", 20, "--waypoints", "-", "--picture", svg, "--force",
                       text=self.waypoints([[0, 0, 0], [90, 9, 1], [50, 50, 2]]))
            self.assertIn(">waypoints<", svg.read_text())
            self.assertEqual(sorted(Path(folder).iterdir()), [png, svg])

    def test_wrong_usage_is_64(self):
        poses = ("--from", "0,0,0", "--to", "1,1,1")
        for arguments in (("--turn-radius", 1), ("--from", "0,0,0", "--turn-radius", 1), poses,
                          (*poses, "--turn-radius", 1, "--pairs", "x.csv"),
                          (*poses, "--turn-radius", 0), (*poses, "--turn-radius", -2),
                          (*poses, "--turn-radius", "nan"), (*poses, "--turn-radius", "inf"),
                          (*poses, "--turn-radius", "1e-320"),
                          (*poses, "--turn-radius", 1, "--law", "fastest"),
                          ("--from", "0,0", "--to", "1,1,1", "--turn-radius", 1),
                          ("--from", "0,nan,0", "--to", "1,1,1", "--turn-radius", 1),
                          ("--from", "0,0,0", "--to", "1e300,1,1", "--turn-radius", 1),
                          ("--from", "0,0,0", "--to", "1e5,1,1", "--turn-radius", 1, "--law", "clf"),
                          (*poses, "--turn-radius", 1, "--waypoints", "x.csv"),
                          ("--pairs", "x.csv", "--turn-radius", 1, "--waypoints", "x.csv"),
                          ("--pairs", "x.csv", "--turn-radius", 1, "--picture", "x.svg"),
                          ("--pairs", "x.csv", "--turn-radius", 1, "--track", "x.csv"),
                          (*poses, "--turn-radius", 1, "--picture", "x.jpg"),
                          ("--from", "0,0,0", "--turn-radius", 1)):
            done = self.steer(*arguments, code=64)
            self.assertTrue(done.stderr.strip())
            self.assertEqual(done.stdout, "")

    def test_bad_input_is_65_and_says_where(self):
        header = "x0_m,y0_m,h0_rad,x1_m,y1_m,h1_rad\n"
        for text, line in ((header + "0,0,0,1,1\n", ":2: "), ("0,0,0,1,1,1\n0,0,x,1,1,1\n", ":2: "),
                           ("0,0,nan,1,1,1\n", ":1: "), ("0,0,0,1,inf,1\n", ":1: "),
                           ("0,0,0,1,1,1,1\n", ":1: "), (header, ": no pairs"), ("", ": no pairs"),
                           ("x0_m,y0_m\n", ":1: "), ("0,0,0,1e200,0,0\n", ":1: "),
                           (header.replace("y0_m", "x0_m"), ":1: ")):
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "pairs.csv"
                path.write_text(text)
                done = self.steer("--pairs", path, "--turn-radius", 1, code=65)
                self.assertIn(f"pairs.csv{line}", done.stderr)
                self.assertEqual(done.stdout, "")
        self.steer("--pairs", "/nowhere/pairs.csv", "--turn-radius", 1, code=65)

    def test_bad_waypoints_are_65_and_say_where(self):
        header = "x_m,y_m,heading_rad\n"
        for text, where in ((header + "0,0,0\n1,1\n", ":3: 2 fields: expected 3"),
                            ("0,0,0\n1,1,north\n", ":2: heading_rad is 'north'"),
                            ("0,0,0\n\nnan,1,1\n", ":3: x_m is 'nan'"),
                            ("0,0,0\n1e200,1,1\n", ":2: the poses are more than"),
                            ("x_m,y_m\n0,0\n", ":1: no column heading_rad"),
                            (header, ": no waypoints"), ("0,0,0\n", ": has one waypoint")):
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "w.csv"
                path.write_text(text)
                done = self.steer("--waypoints", path, "--turn-radius", 1, "--picture",
                                  Path(folder) / "p.svg", code=65)
                self.assertIn(f"w.csv{where}", done.stderr)
                self.assertEqual(done.stdout, "")
                self.assertEqual([p.name for p in Path(folder).iterdir()], ["w.csv"])
        done = self.steer("--waypoints", "-", "--law", "clf", "--turn-radius", 1, code=65,
                          text="0,0,0\n1e5,0,0\n")
        self.assertIn("standard input:2: the poses are more than", done.stderr)
        self.steer("--waypoints", "/nowhere/w.csv", "--turn-radius", 1, code=65)


def read_region(path):
    """Regions [iy][ix] and the metadata of a plan file."""
    data = path.read_bytes()
    (length,) = struct.unpack("<Q", data[:8])
    header = json.loads(data[8:8 + length])
    begin, end = (8 + length + offset for offset in header["region"]["data_offsets"])
    region = np.frombuffer(data[begin:end], np.int8).reshape(header["region"]["shape"])
    return region, json.loads(header["__metadata__"]["fairway"])


class GoalHeading(unittest.TestCase):
    """A run whose goal has a heading, in a bay with a wall next to the goal."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        image = np.full((90, 120), 255, np.uint8)
        image[28:30, 60:120] = 0  # y 60 to 62, above the goal at y 45
        image[52:90, 104:106] = 0
        (cls.folder / "map.pgm").write_bytes(b"P5\n120 90\n255\n" + image.tobytes())
        (cls.folder / "s.toml").write_text("""[map]
file = "map.pgm"
resolution_m = 1.0
cell_m = 2.0
[vehicle]
speed_mps = 10.0
turn_radius_m = 6.0
[mission]
kind = "goal"
goal_m = [96.0, 46.0]
goal_heading_rad = 3.5
[plan]
alpha = 0.5
beta = 1.5
[simulate]
random = 150
sample = 400
[verify]
method = "bitmap"
""")
        cls.run_fairway("run", "s.toml", "-o", "out", "--quiet")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def run_fairway(cls, *arguments):
        done = subprocess.run([FAIRWAY, *arguments], cwd=cls.folder, text=True, capture_output=True)
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        return done.stdout

    def test_every_leg_ends_at_the_goals_pose_and_touches_no_obstacle(self):
        region, record = read_region(self.folder / "out/plan.safetensors")
        (x0, y0), cell = record["origin_m"], record["cell_m"]
        with open(self.folder / "out/flights.csv") as lines:
            rows = [[float(row[c]) for c in ("flight", "time_s", "x_m", "y_m", "heading_rad",
                                             "curvature_per_m", "final_leg")]
                    for row in csv.DictReader(lines)]
        legs = {}
        for row in rows:
            if row[6] == 1:
                legs.setdefault(row[0], []).append(row)
        self.assertGreater(len(legs), 50)
        for leg in legs.values():
            self.assertAlmostEqual(leg[-1][2], 96.0, places=9)
            self.assertAlmostEqual(leg[-1][3], 46.0, places=9)
            self.assertAlmostEqual(math.remainder(leg[-1][4] - 3.5, 2 * math.pi), 0.0, places=9)
            for (_, t, x, y, h, k, _), (_, t1, *_) in zip(leg, leg[1:]):
                self.assertLessEqual(abs(k), 1 / 6.0)
                s = np.linspace(0, (t1 - t) * 10.0, 20)  # along the arc itself
                along = np.sinc(k * s / 2 / np.pi) * s
                ix = np.floor((x + along * np.cos(h + k * s / 2) - x0) / cell).astype(int)
                iy = np.floor((y + along * np.sin(h + k * s / 2) - y0) / cell).astype(int)
                self.assertTrue((region[iy, ix] != 1).all())

    def test_the_summary_counts_them_and_the_products_show_them(self):
        summary = json.loads((self.folder / "out/summary.json").read_text())
        legs = summary["final_legs"]
        reach = sum(summary[of]["outcomes"]["reach"] for of in ("random_flights", "given_flights"))
        self.assertEqual(legs["count"], reach)
        self.assertEqual(legs["shortest"] + legs["other"] + legs["none_clear"], legs["count"])
        self.assertGreater(legs["shortest"], 0)
        self.assertGreater(legs["other"], 0)
        self.assertLess(legs["worst_end_error_m"], 1e-9)
        self.assertLess(legs["worst_end_error_rad"], 1e-9)
        features = json.loads((self.folder / "out/flights.geojson").read_text())["features"]
        flights = [f for f in features if "outcome" in f["properties"]]
        self.assertEqual(len(flights), 150)
        drawn = [f["properties"] for f in features if "outcome" not in f["properties"]]
        asked = [f["properties"].get("final_leg") for f in flights]
        self.assertEqual(len(drawn), asked.count("shortest") + asked.count("other"))
        for leg in drawn:
            self.assertEqual(leg["final_leg"], asked[leg["flight"]])
            self.assertLessEqual(leg["length_m"], legs["longest_m"] + 1e-9)
        for name in ("flights", "final_legs"):
            self.assertIn("final-legs-other", (self.folder / f"out/{name}.svg").read_text())

    def test_simulate_takes_the_heading_from_the_plan(self):
        text = self.run_fairway("simulate", "out/plan.safetensors", "--state", "20,20,0",
                                "--csv", "t.csv")
        self.assertIn("go on to the goal's heading", text)
        last = (self.folder / "t.csv").read_text().splitlines()[-1].split(",")
        self.assertAlmostEqual(float(last[2]), 96.0, places=9)
        self.assertEqual(last[6], "1")
        answer = json.loads(self.run_fairway("simulate", "out/plan.safetensors", "--json",
                                             "--state", "20,20,0"))
        self.assertEqual(answer["final_legs"]["count"], 1)
        self.assertEqual(answer["outcomes"]["reach"], 1)
        disturbed = json.loads(self.run_fairway("simulate", "out/plan.safetensors", "--json",
                                                "--state", "20,20,0", "--law", "bang-bang"))
        self.assertIsNone(disturbed["final_legs"])


if __name__ == "__main__":
    FAIRWAY = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
