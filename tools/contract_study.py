#!/usr/bin/env python3
"""Proves plans of four real maps under many contracts, and draws what each number costs.

Usage: contract_study.py FAIRWAY MAPS OUT [NAME...]

MAPS holds the maps, which are not part of Fairway (docs/contract-study.md says where they are
from). Around one contract, each of its numbers is changed by itself: the command error, the heading
error, the range of radii. What has been proved already, in OUT/NAME, is not proved again. Writes
OUT/contract-study-NAME.svg and prints the figures as a Markdown table. All of it takes about eleven
minutes of processor time.
"""
import json
import math
import os
import pathlib
import subprocess
import sys
import time
import tomllib

# name: (title, map below MAPS, what `init` needs, alpha)
MAPS = {
    "berlin": ("Berlin, blocks of houses, r 12 m", "movingai_cities/Berlin_1_256.map",
               ["--resolution", 2, "--cell", 5, "--turn-radius", 12], 2.0),
    "davos": ("Davos, valleys below 1850 m, r 100 m", "geo_terrain_davos/davosdorf.tif",
              ["--altitude", 1850, "--cell", 40, "--turn-radius", 100], 1.0),
    "alexandria": ("Alexandria, single buildings, r 12 m", "geo_buildings_alexandria/buildings.geojson",
                   ["--cell", 5, "--turn-radius", 12], 2.0),
    "fence": ("A geofence with places to keep out of, r 20 m",
              "uav_plans/multicopter_mission_geofence_avoid.plan",
              ["--cell", 8, "--turn-radius", 20], 2.0),
}
# axis: (title, values)
AXES = {
    "rho": ("command error, in turning radii", [0.0, 0.02, 0.05, 0.1, 0.2, 0.3]),
    "eps": ("heading error, degrees", [0.0, 1.0, 2.0, 4.0]),
    "radius": ("turning radius, +- per cent", [0.0, 5.0, 10.0, 20.0]),
}
PARTS = 2  # of half a cell, 0.2 r: always the same, so that only the contract changes
BASE = {"rho": 0.1, "eps": 1.0, "radius": 10.0}
LEAST_EPS_DEG = 0.01   # stands for 0


def run(words):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    return done.stdout


def contract_toml(r, speed, rho, eps, radius):
    share = radius / 100.0
    return (f"[vehicle.contract]\ncommand_error_m = {rho * r:.6g}\n"
            f"heading_error_rad = {math.radians(max(eps, LEAST_EPS_DEG)):.6g}\n"
            f"turn_radius_m = [{(1 - share) * r:.6g}, {(1 + share) * r:.6g}]\n"
            f"speed_mps = [{0.9 * speed:.6g}, {1.1 * speed:.6g}]\n")


def contracts():
    """Each contract once: one of its numbers differs from the base, or none."""
    found = []
    for axis, (_, values) in AXES.items():
        for value in values:
            one = {**BASE, axis: value}
            if one not in found:
                found.append(one)
    return found


def proved(program, plan, folder, r, speed, one):
    """The summary of a proof under a contract, or of the exact vehicle."""
    name = "exact" if one is None else "_".join(f"{k}{v:g}" for k, v in one.items())
    summary = folder / f"{name}.summary.json"
    if not summary.exists():
        options = ["--undecided-max", 0.005]
        if one is not None:
            contract = folder / f"{name}.toml"
            contract.write_text(contract_toml(r, speed, **one))
            options = ["--contract", contract, "--parts", PARTS]
        certificate = folder / f"{name}.cert"
        before, began = os.times(), time.time()
        run([program, "verify", plan, *options, "--volume-samples", 1000, "--quiet", "--force",
             "--summary", folder / "made.json", "-o", certificate])
        after = os.times()
        said = json.loads((folder / "made.json").read_text())
        said["cpu_s"] = after.children_user - before.children_user
        said["wall_s"] = time.time() - began
        certificate.unlink()
        (folder / "made.json").unlink()
        summary.write_text(json.dumps(said))
    return json.loads(summary.read_text())


def shares(said):
    """Of all states, from the bottom of the picture: [reach, undecided, at risk, fail]; and of safe
    starts that reach."""
    all_states, risk = said["volume_fraction"], said.get("at_risk") or 0.0
    fail = all_states["collide"] + all_states["leave"] + all_states["trapped"]
    open_states = max(0.0, all_states["undecided"] - risk)
    return [all_states["reach"], open_states, risk, fail], said["volume_fraction_free"]["reach"]


KINDS = [("proved to reach", "#a9cbf5"), ("undecided", "#fdf6a3"), ("at risk", "#f3b48c"),
         ("proved to fail", "#cf5a2b")]


def picture(title, exact, by_axis):
    width, height, gap, left, top = 250, 190, 30, 52, 64
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {left + 3 * width + 2 * gap + 20} '
           f'{top + height + 50}" font-family="sans-serif" font-size="12" fill="#222">',
           '<rect width="100%" height="100%" fill="#fff"/>',
           f'<text x="{left}" y="20" font-size="15">{title}</text>']
    x = left
    for name, color in KINDS:
        out.append(f'<rect x="{x}" y="32" width="12" height="12" fill="{color}" stroke="#666" '
                   f'stroke-width=".5"/><text x="{x + 17}" y="42">{name}</text>')
        x += 32 + 6.6 * len(name)
    out.append(f'<path d="M{x},38h22" stroke="#123d7a" stroke-width="2"/><circle cx="{x + 11}" cy="38" r="3" '
               f'fill="#123d7a"/><text x="{x + 28}" y="42">safe starts that reach</text>')
    x += 170
    out.append(f'<path d="M{x},38h22" stroke="#222" stroke-dasharray="4 3"/><text x="{x + 28}" y="42">'
               'the exact vehicle, all states</text>')

    def y(share):
        return top + height * (1.0 - share)

    for k, (axis, (label, values)) in enumerate(AXES.items()):
        x0 = left + k * (width + gap)
        at = [x0 + width * v / values[-1] for v in values]
        lower = [0.0] * len(values)
        for kind, (_, color) in enumerate(KINDS):
            upper = [low + shares(said)[0][kind] for low, said in zip(lower, by_axis[axis])]
            edge = [f"{px:.1f},{y(u):.1f}" for px, u in zip(at, upper)]
            back = [f"{px:.1f},{y(low):.1f}" for px, low in zip(at, lower)][::-1]
            out.append(f'<path d="M{" ".join(edge + back)}z" fill="{color}" stroke="#666" stroke-width=".5"/>')
            lower = upper
        out.append(f'<path d="M{x0},{y(exact):.1f}h{width}" stroke="#222" stroke-dasharray="4 3"/>')
        safe = [y(shares(said)[1]) for said in by_axis[axis]]
        line = " ".join(f"{px:.1f},{py:.1f}" for px, py in zip(at, safe))
        out.append(f'<path d="M{line}" fill="none" stroke="#123d7a" stroke-width="2"/>')
        out += [f'<circle cx="{px:.1f}" cy="{py:.1f}" r="3" fill="#123d7a"/>' for px, py in zip(at, safe)]
        out.append(f'<rect x="{x0}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#222"/>')
        for value, px in zip(values, at):
            if value == 0.02:
                continue
            weight = ' font-weight="bold"' if value == BASE[axis] else ""
            out.append(f'<path d="M{px:.1f},{top + height}v4" stroke="#222"/><text x="{px:.1f}" '
                       f'y="{top + height + 18}" text-anchor="middle"{weight}>{value:g}</text>')
        out.append(f'<text x="{x0 + width / 2}" y="{top + height + 40}" text-anchor="middle">{label}</text>')
        if k == 0:
            out += [f'<text x="{x0 - 6}" y="{y(s) + 4:.1f}" text-anchor="end">{100 * s:.0f} %</text>'
                    for s in (0.0, 0.25, 0.5, 0.75, 1.0)]
    return "\n".join(out + ["</svg>", ""])


def row(cells):
    print("| " + " | ".join(cells) + " |", flush=True)


def row_of(said):
    """Of all states / of safe starts, in per cent: those proved to reach; and of all states those that
    are at risk, and undecided."""
    (reach, undecided, risk, _), safe = shares(said)
    return f"{100 * reach:.0f} / {100 * safe:.0f} ({100 * risk:.0f}, {100 * undecided:.0f})"


def study(program, maps, out, name):
    title, file, options, alpha = MAPS[name]
    folder = out / name
    folder.mkdir(parents=True, exist_ok=True)
    scenario, plan = folder / "scenario.toml", folder / "plan.safetensors"
    if not plan.exists():
        run([program, "init", maps / file, *options, "--force", "-o", scenario])
        run([program, "plan", scenario, "--set", f"plan.alpha={alpha}", "--force", "-o", plan])
    vehicle = tomllib.loads(scenario.read_text())["vehicle"]
    r, speed = vehicle["turn_radius_m"], vehicle["speed_mps"]
    exact = proved(program, plan, folder, r, speed, None)
    said = [(one, proved(program, plan, folder, r, speed, one)) for one in contracts()]
    by_axis = {axis: [next(s for one, s in said if one == {**BASE, axis: value}) for value in values]
               for axis, (_, values) in AXES.items()}
    (out / f"contract-study-{name}.svg").write_text(
        picture(f"{title}, alpha {alpha:g}", exact["volume_fraction"]["reach"], by_axis))
    cpu = exact["cpu_s"] + sum(s["cpu_s"] for _, s in said)
    return [(None, exact), *said], cpu


def main():
    program, maps, out = (pathlib.Path(a).absolute() for a in sys.argv[1:4])
    names = sys.argv[4:] or list(MAPS)
    made = [study(program, maps, out, name) for name in names]
    row(["command error", "heading error", "radius", *names])
    row(["---"] * (3 + len(names)))
    for k, (one, _) in enumerate(made[0][0]):
        contract = ["the exact vehicle", "", ""] if one is None else [
            f"{one['rho']:g} r", f"{one['eps']:g} deg", f"+-{one['radius']:g} %"]
        row(contract + [row_of(said[k][1]) for said, _ in made])
    row(["processor time", "", ""] + [f"{cpu:.0f} s" for _, cpu in made])


main()
