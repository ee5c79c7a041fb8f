#!/usr/bin/env python3
"""Proves plans of real maps with many parameters, and tells which proves most (docs/tuning.md).

Usage: tuning_study.py FAIRWAY MAPS OUT --vary KEY=VALUE,VALUE... [--set KEY=VALUE]...
                       [--only NAME,NAME...] [--undecided-max F] [--time-limit S]
                       [--flown | --tried]

MAPS holds the maps, which are not part of Fairway (docs/tuning.md says where they are from). Every
combination of the values of all --vary is one column. What OUT/proofs.jsonl has already is not
proved again. All parameters of a plan are given explicitly, so that no figure depends on defaults,
unless plan.preset is varied. Proved shares have the undecided ones in brackets.

With --flown nothing is proved: shares are those of 10,000 states flown under each plan, the same for
all columns, as `fairway tune` evaluates them. --tried, without --vary, tells the shares under the
five settings that `fairway plan` chooses from, and what it takes.
"""
import argparse
import csv
import itertools
import json
import pathlib
import subprocess
import sys
import time

# name: (kind, file below MAPS, metres per pixel or 0, cell, turning radius, goal or None, more keys)
# Goals are those that `fairway init` chose for the paper's parameters: every setting allows them.
MAPS = {
    "berlin": ("city", "movingai_cities/Berlin_1_256.map", 2, 4, 9, "goal_m = [278, 74]", ""),
    "boston": ("city", "movingai_cities/Boston_0_256.map", 2, 4, 8, "goal_m = [258, 50]", ""),
    "denver": ("city", "movingai_lf/Denver_1_256.map", 2, 4, 9, "goal_m = [278, 226]", ""),
    "paris": ("city", "movingai_cities/Paris_1_256.map", 2, 4, 8, "goal_m = [262, 54]", ""),
    "newyork": ("city", "movingai_cities/NewYork_0_512.map", 2, 8, 18, "goal_m = [228, 108]", ""),
    "moscow": ("city", "movingai_cities/Moscow_1_1024.map", 2, 16, 30, "goal_m = [1176, 1608]", ""),
    "london": ("city", "movingai_cities/London_0_1024.map", 2, 16, 36, "goal_m = [1128, 472]", ""),
    "den520d": ("cave", "movingai_other/den520d.map", 2, 4, 10, "goal_m = [158, 194]", ""),
    "mines": ("cave", "ros_turtlebot_stdr/mines.yaml", 0, 0.2, 0.4, "goal_m = [29.1, 16.3]", ""),
    "cave": ("cave", "ros_tuw_cave/map.yaml", 0, 0.1, 0.25, "goal_m = [5.45, 5.45]", ""),
    "willow": ("indoor", "ros_willow/willow-2010-02-18-0.10.yaml", 0, 0.2, 0.4, "goal_m = [34.9, 16.3]", ""),
    "freiburg": ("indoor", "ros_turtlebot_stdr/frieburg.yaml", 0, 0.4, 0.8, "goal_m = [36.2, 17.8]", ""),
    "hospital": ("indoor", "ros_turtlebot_stdr/hospital_section.yaml", 0, 0.2, 0.4,
                 "goal_m = [37.1, 10.5]", ""),
    "depot": ("indoor", "ros_nav2/depot.yaml", 0, 0.2, 0.5, "goal_m = [4.7, 7.7]", ""),
    "warehouse": ("indoor", "ros_nav2/warehouse.yaml", 0, 0.4, 0.9, "goal_m = [-3.3, 3.2]", ""),
    "aws": ("indoor", "ros_aws_warehouse/map.yaml", 0, 0.15, 0.35, "goal_m = [-0.93, -2.48]", ""),
    "cob": ("indoor", "ros_cob/map.yaml", 0, 0.2, 0.5, "goal_m = [1.9, -4.1]", ""),
    "stata": ("indoor", "f1tenth_gym/stata_basement.yaml", 0, 0.5, 0.75, "goal_m = [14.35, 0.25]", ""),
    "mrpt": ("indoor", "ros_mrpt/demo_world2.yaml", 0, 0.5, 1.5, "goal_m = [27.75, 24.75]", ""),
    "campus": ("outdoor", "ros_cob_campus/map.yaml", 0, 2, 4, "goal_m = [115.8, -101]", ""),
    "davos": ("outdoor", "geo_terrain_davos/davosdorf.tif", 0, 40, 100,
              "goal_deg = [46.8122867, 9.8467226]", "altitude_m = 1850.0"),
    "alexandria": ("outdoor", "geo_buildings_alexandria/buildings.geojson", 0, 5, 12,
                   "goal_deg = [38.8121324, -77.0528988]", "world_margin_m = 60.0"),
    "geofence": ("outdoor", "uav_plans/multicopter_mission_geofence_avoid.plan", 0, 8, 20,
                 "goal_deg = [47.3948728, 8.5469703]", ""),
    "dalby": ("outdoor", "uav_plans/Dalby-OBC2016-fence.txt", 0, 40, 100,
              "goal_deg = [-27.2733105, 151.2920211]", ""),
    "cefence": ("outdoor", "uav_plans/ce_geofence_home_base.plan", 0, 0.5, 1.5,
                "goal_deg = [38.7507614, -77.497224]", ""),
    **{track: ("track", f"f1tenth_racetracks/{track}_map.yaml", 0, 0.25, 0.8, None, "")
       for track in ("Austin", "IMS", "Monza", "Spa")},
}
PAPER = {"alpha": 2.0, "beta": 2.0, "metric": '"euclidean"', "sigma_cells": 1.0, "mu_path": 0.5,
         "sigma_path": 1.5, "mu_border": 0.5, "sigma_border": 0.5, "axis_capture_rad": 0.02}


def run(words):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    return done.stdout


def center_line(maps, track, file):
    with open(maps / f"f1tenth_racetracks/{track}_centerline.csv") as lines:
        points = [row[:2] for row in csv.reader(lines) if row and row[0][0] not in "#x"]
    file.write_text("x_m,y_m\n" + "".join(f"{float(x):.6f},{float(y):.6f}\n" for x, y in points))


def scenario_of(name, maps, folder):
    kind, file, pixel_m, cell_m, radius_m, goal, more = MAPS[name]
    mission = f'kind = "goal"\n{goal}'
    if kind == "track":
        center_line(maps, name, folder / f"{name}.csv")
        mission = f'kind = "path"\npath_file = "{name}.csv"\nclosed = true'
    scenario = folder / f"{name}.toml"
    scenario.write_text(f'[map]\nfile = "{maps / file}"\ncell_m = {float(cell_m)}\n'
                        + (f"resolution_m = {float(pixel_m)}\n" if pixel_m else "") + f"{more}\n"
                        f"[vehicle]\nspeed_mps = {2.0 * radius_m}\nturn_radius_m = {float(radius_m)}\n"
                        f"[mission]\n{mission}\n")
    return scenario


class Proofs:
    """What has been proved, one JSON object a line."""

    def __init__(self, program, maps, folder, undecided_max, time_limit_s):
        self.time_limit_s = time_limit_s
        self.program, self.maps, self.folder, self.undecided_max = program, maps, folder, undecided_max
        folder.mkdir(parents=True, exist_ok=True)
        self.file = folder / "proofs.jsonl"
        lines = self.file.read_text().splitlines() if self.file.exists() else []
        self.known = {one["of"]: one for one in map(json.loads, lines)}

    def of(self, name, keys):
        given = {} if "plan.preset" in keys else PAPER
        sets = {f"plan.{key}": value for key, value in given.items()} | keys
        of = json.dumps([name, self.undecided_max, self.time_limit_s, sorted(sets.items())])
        if of not in self.known:
            one = self.prove(name, sets) | {"of": of}
            with self.file.open("a") as out:
                out.write(json.dumps(one) + "\n")
            self.known[of] = one
        return self.known[of]

    def prove(self, name, sets):
        plan, certificate = self.folder / "plan.safetensors", self.folder / "certificate.safetensors"
        words = [self.program, "plan", scenario_of(name, self.maps, self.folder), "--quiet", "--force", "-o", plan]
        for key, value in sets.items():
            words += ["--set", f"{key}={value}"]
        run(words)
        began = time.time()
        method = ["--method", "contract", "--contract", self.exact_contract()] if MAPS[name][0] == "track" else []
        said = json.loads(run([self.program, "verify", plan, "--undecided-max", self.undecided_max, *method,
                               "--volume-samples", 100000, "--time-limit", self.time_limit_s, "--quiet", "--json", "--force",
                               "-o", certificate]))
        return {"shares": said["volume_fraction"], "cells": said["cells"], "wall_s": time.time() - began}

    def flown(self, name, keys, fixed):
        """The evaluations of a search that only has to list these choices, by their values."""
        words = [self.program, "tune", scenario_of(name, self.maps, self.folder), "-o", self.folder / name,
                 "--quiet", "--force", "--finalists", 1, "--evaluations", 10000, "--set", "verify.undecided_max=1"]
        for key, value in fixed.items():
            words += ["--set", f"{key}={value}"]
        for key, values in keys.items():
            words += ["--vary", f"{key}={','.join(values)}"]
        run(words)
        with (self.folder / name / "evaluations.csv").open() as lines:
            return {tuple(float(row[key]) for key in keys): 100 * float(row["share"])
                    for row in csv.DictReader(lines)}

    def tried(self, name):
        """(alpha, sigma_cells, share) of each setting, and which was taken."""
        said = json.loads(run([self.program, "plan", scenario_of(name, self.maps, self.folder), "--json", "--quiet",
                               "--force", "-o", self.folder / "plan.safetensors"]))
        plan = said["options"]["plan"]
        return [((one["alpha"], one["sigma_cells"]) == (plan["alpha"], plan["sigma_cells"]), one["flown_share"])
                for one in said["tried_parameters"]], said["cells"]

    def exact_contract(self):
        contract = self.folder / "exact.toml"
        contract.write_text("[vehicle.contract]\n")
        return contract


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("maps", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--vary", action="append", default=[])
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--only", default=",".join(n for n, m in MAPS.items() if m[0] != "track"))
    parser.add_argument("--undecided-max", type=float, default=0.03)
    parser.add_argument("--time-limit", type=float, default=300.0)
    parser.add_argument("--flown", action="store_true")
    parser.add_argument("--tried", action="store_true")
    asked = parser.parse_args()
    fixed = dict(one.split("=", 1) for one in asked.set)
    axes = [[(key, value) for value in values.split(",")]
            for key, values in (one.split("=", 1) for one in asked.vary)]
    columns = [dict(chosen) for chosen in itertools.product(*axes)]
    proofs = Proofs(asked.program.absolute(), asked.maps.absolute(), asked.out.absolute(), asked.undecided_max,
                    asked.time_limit)

    def row(cells):
        print("| " + " | ".join(cells) + " |", flush=True)

    if asked.tried:
        row(["map", "kind", "cells", "r / cell", "paper", "light", "wide", "corners", "beside"])
        row(["---"] * 9)
        for name in asked.only.split(","):
            tried, cells = proofs.tried(name)
            row([name, MAPS[name][0], "{} x {}".format(*cells), f"{MAPS[name][4] / MAPS[name][3]:.3g}",
                 *("-" if share is None else ("**{:.1f}**" if taken else "{:.1f}").format(100 * share)
                   for taken, share in tried)])
        return
    row(["map", "kind", "cells", "r / cell", *(" ".join(c.values()) for c in columns)])
    row(["---"] * (4 + len(columns)))
    shares = [[] for _ in columns]
    for name in asked.only.split(","):
        if asked.flown:
            found = proofs.flown(name, {axis[0][0]: [v for _, v in axis] for axis in axes}, fixed)
            row([name, MAPS[name][0], "", f"{MAPS[name][4] / MAPS[name][3]:.3g}",
                 *(f"{found[tuple(map(float, c.values()))]:.1f}" for c in columns)])
            continue
        made = [proofs.of(name, fixed | column) for column in columns]
        for share, one in zip(shares, made):
            share.append(one["shares"].get("follow", one["shares"].get("reach", 0.0)))
        row([name, MAPS[name][0], "{} x {}".format(*made[0]["cells"]), f"{MAPS[name][4] / MAPS[name][3]:.3g}",
             *(f"{100 * share[-1]:.1f} ({100 * one['shares']['undecided']:.1f})" for share, one in zip(shares, made))])
    if asked.flown:
        return
    row(["mean", "", "", "", *(f"{100 * sum(s) / len(s):.1f}" for s in shares)])


main()
