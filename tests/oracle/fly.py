#!/usr/bin/python3
"""An independent exact flight of a plan file, to compare `fairway simulate` with.

Written from the model alone, in angles where the library uses vectors: the centre of the turning
circle, the angle at which the circle leaves through each of the four sides (one arcsine or
arccosine per side), the smallest of them, or the command if it comes first; then straight.
All flights advance together, one cell per step, in numpy.

    fly.py PLAN.safetensors --random 20000 --seed 1 --write-states states.csv
    fly.py PLAN.safetensors --states states.csv --outcomes mine.csv
    fly.py PLAN.safetensors --states states.csv --compare theirs.csv
    fly.py PLAN.safetensors --random 20000 --command build/release/bin/fairway

--compare reads `x_m,y_m,heading_rad,outcome,time_s,length_m`, prints how many outcomes agree and
the largest relative difference of times among them; --command has the program fly the states and
compares. Exit code 1 when fewer than 99.99 % agree or a time differs by more than 1e-6.
A flight that weaves along a border (arcs out of and back into the same side, alternating between
two cells) repeats itself, shifted, until a corner is near; such repeats are skipped in one step
unless --no-leaps is given.

Ties (headings along a border, exact corners) are out of scope: states are random.
"""

import argparse
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

OBSTACLE, GOAL = 1, 2
OUTCOMES = ["reach", "collide", "leave", "trapped"]
REACH, COLLIDE, LEAVE, TRAPPED = range(4)
TWO_PI = 2.0 * math.pi


class Plan:
    """heading_rad F32 [ny,nx], region I8 [ny,nx], cost_m F32 [ny,nx], and the metadata."""

    def __init__(self, path):
        with open(path, "rb") as file:
            size = int.from_bytes(file.read(8), "little")
            header = json.loads(file.read(size))
        types = {"F32": "<f4", "I8": "i1", "F64": "<f8"}

        def array(name):
            entry = header[name]
            begin, end = entry["data_offsets"]
            dtype = np.dtype(types[entry["dtype"]])
            flat = np.fromfile(path, dtype, (end - begin) // dtype.itemsize, offset=8 + size + begin)
            return flat.reshape(entry["shape"])

        self.heading = array("heading_rad")
        self.region = array("region")
        self.cost = array("cost_m")
        meta = json.loads(header["__metadata__"]["fairway"])
        self.x0, self.y0 = meta["origin_m"]
        self.cell = float(meta["cell_m"])
        self.speed = float(meta["vehicle"]["speed_mps"])
        self.radius = float(meta["vehicle"]["turn_radius_m"])
        self.ny, self.nx = self.heading.shape


def wrapped(angle):
    """Into (-pi, pi], for |angle| < 3 pi."""
    angle = np.where(angle > math.pi, angle - TWO_PI, angle)
    return np.where(angle <= -math.pi, angle + TWO_PI, angle)


def side_angles(x, y, h, turn, d, r):
    """Angles turned, in [0, 2 pi), until the circle heads out of right, top, left, bottom."""
    center_x = x - turn * r * np.sin(h)
    center_y = y + turn * r * np.cos(h)
    with np.errstate(invalid="ignore"):
        right = np.arcsin(turn * (d - center_x) / r)
        left = math.pi - np.arcsin(turn * (0.0 - center_x) / r)
        top = np.arccos(turn * (center_y - d) / r)
        bottom = -np.arccos(turn * (center_y - 0.0) / r)
    angles = np.stack([right, top, left, bottom])
    angles = np.mod(turn * (angles - h), TWO_PI)
    return np.where(np.isnan(angles), np.inf, angles)


def cross_cell(x, y, h, psi, d, r):
    """One cell for many flights.

    Exit x, y, h, side (0 right, 1 top, 2 left, 3 bottom), length, whether it is (almost) only an arc.
    """
    difference = psi - h
    turn_by = np.where(np.isnan(psi), 0.0, wrapped(difference))
    turn_by = np.where(np.abs(difference) == math.pi, math.pi, turn_by)
    turn = np.where(turn_by < 0.0, -1.0, 1.0)
    angle = np.abs(turn_by)

    exits = side_angles(x, y, h, turn, d, r)
    exits = np.where(angle > 0.0, exits, np.inf)
    side = np.argmin(exits, axis=0)
    first = np.min(exits, axis=0)
    on_arc = first <= angle
    turned = np.where(on_arc, first, angle)
    after = h + turn * turned
    arc_x = x + turn * r * (np.sin(after) - np.sin(h))
    arc_y = y - turn * r * (np.cos(after) - np.cos(h))
    after = np.where(on_arc | (angle == 0.0), wrapped(after), psi)
    after = np.where(angle == 0.0, h, after)
    arc_x = np.where(angle == 0.0, x, arc_x)
    arc_y = np.where(angle == 0.0, y, arc_y)

    ux, uy = np.cos(after), np.sin(after)
    with np.errstate(divide="ignore", invalid="ignore"):
        to_x = np.where(ux > 0.0, (d - arc_x) / ux, np.where(ux < 0.0, -arc_x / ux, np.inf))
        to_y = np.where(uy > 0.0, (d - arc_y) / uy, np.where(uy < 0.0, -arc_y / uy, np.inf))
    straight = np.where(on_arc, 0.0, np.maximum(np.minimum(to_x, to_y), 0.0))
    straight_side = np.where(to_x < to_y, np.where(ux > 0.0, 0, 2), np.where(uy > 0.0, 1, 3))
    side = np.where(on_arc, side, straight_side)
    return (
        np.clip(arc_x + straight * ux, 0.0, d),
        np.clip(arc_y + straight * uy, 0.0, d),
        after,
        side,
        r * turned + straight,
        straight < 1e-3 * r * turned,
    )


def leap(x, y, h, vertical, weaves, d, r):
    """Moves weaving flights (in place) by pairs of hops close to the next corner; length flown."""
    along = np.where(vertical, y, x)
    across = np.abs(np.where(vertical, np.cos(h), np.sin(h)))
    upwards = np.where(vertical, np.sin(h), np.cos(h)) > 0.0
    pair = 4.0 * r * across
    rest = np.where(upwards, d - along, along)
    with np.errstate(divide="ignore", invalid="ignore"):
        pairs = np.floor(rest / pair) - 3.0
    pairs = np.where(weaves & (pair < d / 20.0) & (pair > 1e-10 * d) & (pairs > 0.0), pairs, 0.0)
    moved = along + np.where(upwards, pairs, -pairs) * pair
    x[:] = np.where(vertical, x, moved)
    y[:] = np.where(vertical, moved, y)
    return pairs * 4.0 * r * np.arcsin(across)


def fly(plan, states, length_limit=None, leaps=True):
    """Outcomes (indices into OUTCOMES) and lengths of flights from states [n, 3]."""
    n = len(states)
    d, r = plan.cell, plan.radius
    outcome = np.full(n, TRAPPED)
    length = np.full(n, np.inf)
    if length_limit is None:
        length_limit = 4.0 * plan.nx * plan.ny * d + 1000.0 * TWO_PI * r

    # A ring of cells outside the grid, so that no index needs a check.
    region = np.full((plan.ny + 2, plan.nx + 2), 99, np.int8)
    region[1:-1, 1:-1] = plan.region
    heading = np.full((plan.ny + 2, plan.nx + 2), np.nan)
    heading[1:-1, 1:-1] = plan.heading

    gx, gy = states[:, 0] - plan.x0, states[:, 1] - plan.y0
    inside = (gx >= 0) & (gy >= 0) & (gx < plan.nx * d) & (gy < plan.ny * d)
    outcome[~inside], length[~inside] = LEAVE, 0.0
    flight = np.nonzero(inside)[0]
    gx, gy = gx[inside], gy[inside]
    ix, iy = np.floor(gx / d).astype(int), np.floor(gy / d).astype(int)
    x, y, h = gx - ix * d, gy - iy * d, states[inside, 2].copy()
    ix, iy = ix + 1, iy + 1
    flown = np.zeros(len(flight))
    hops = np.zeros(len(flight), int)
    kept = (ix, iy, x, y, h, np.full(len(flight), np.inf))
    renew, step = 1, 0
    while len(flight):
        # What is here?
        here = region[iy, ix]
        kx, ky = kept[0], kept[1]
        repeats = (
            (kx == ix)
            & (ky == iy)
            & (flown - kept[5] > 6.28 * r)
            & (np.abs(kept[2] - x) < 1e-9 * d)
            & (np.abs(kept[3] - y) < 1e-9 * d)
            & (np.abs(wrapped(kept[4] - h)) < 1e-9)
        )
        ended = (here == GOAL) | (here == OBSTACLE) | (here == 99)
        over = ended | repeats | (flown >= length_limit)
        if over.any():
            done = flight[ended]
            outcome[done] = np.select(
                [here[ended] == GOAL, here[ended] == OBSTACLE], [REACH, COLLIDE], LEAVE
            )
            length[done] = flown[ended]
            on = ~over
            flight, ix, iy, x, y, h, flown, hops = (
                a[on] for a in (flight, ix, iy, x, y, h, flown, hops)
            )
            kept = tuple(a[on] for a in kept)
            continue
        if step == renew:  # Brent: keep the state after 1, 2, 4, ... cells
            kept = (ix, iy, x, y, h, flown.copy())
            renew *= 2
        step += 1
        was_x, was_y = x, y
        x, y, h, side, more, arc_alone = cross_cell(x, y, h, heading[iy, ix], d, r)
        flown = flown + more
        vertical = (side == 0) | (side == 2)
        x = np.select([side == 0, side == 2], [d, 0.0], x)
        y = np.select([side == 1, side == 3], [d, 0.0], y)
        hops = np.where(arc_alone & np.where(vertical, x == was_x, y == was_y), hops + 1, 0)
        x = np.select([side == 0, side == 2], [0.0, d], x)
        y = np.select([side == 1, side == 3], [0.0, d], y)
        ix = ix + (side == 0) - (side == 2)
        iy = iy + (side == 1) - (side == 3)
        if leaps and (hops >= 2).any():
            flown += leap(x, y, h, vertical, hops >= 2, d, r)
    return outcome, length


def random_states(plan, count, seed):
    """Uniform over cells that are not obstacles."""
    draw = np.random.default_rng(seed)
    cells = np.nonzero(plan.region.ravel() != OBSTACLE)[0]
    cell = draw.choice(cells, count)
    x = plan.x0 + (cell % plan.nx + draw.random(count)) * plan.cell
    y = plan.y0 + (cell // plan.nx + draw.random(count)) * plan.cell
    return np.stack([x, y, draw.uniform(-math.pi, math.pi, count)], axis=1)


def read_csv(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def write_states(path, states):
    with open(path, "w") as file:
        file.write("x_m,y_m,heading_rad\n")
        file.writelines(f"{x!r},{y!r},{h!r}\n" for x, y, h in states.tolist())


def compare(plan, states, outcome, length, rows):
    """Prints how well another program's rows agree; True when they meet the threshold."""
    if len(rows) != len(states):
        print(f"{len(rows)} rows for {len(states)} states")
        return False
    theirs = np.array([OUTCOMES.index(row["outcome"]) for row in rows])
    their_time = np.array([float(row["time_s"]) for row in rows])
    mine_time = length / plan.speed
    same = theirs == outcome
    timed = same & np.isfinite(mine_time) & (mine_time > 0.0)
    with np.errstate(invalid="ignore"):
        relative = np.abs(their_time - mine_time)[timed] / mine_time[timed]
    worst = relative.max() if len(relative) else 0.0
    print(f"states {len(states)}, outcomes agree {same.mean():.6%} ({(~same).sum()} differ)")
    for k, name in enumerate(OUTCOMES):
        print(f"  {name}: {np.sum(outcome == k)} here, {np.sum(theirs == k)} there")
    off = int((relative > 1e-6).sum())
    print(f"times: largest relative difference {worst:.3g}, median {np.median(relative) if len(relative) else 0:.3g}, {off} beyond 1e-6")
    for i in np.nonzero(~same)[0][:5]:
        print(f"  differs: {states[i].tolist()} {OUTCOMES[outcome[i]]} {mine_time[i]} s here, "
              f"{OUTCOMES[theirs[i]]} {their_time[i]} s there")
    worst_at = np.nonzero(timed)[0][np.argsort(-relative)[: min(off, 5)]]
    for i in worst_at:
        print(f"  time: {states[i].tolist()} {mine_time[i]} s here, {their_time[i]} s there")
    return bool(same.mean() >= 0.9999 and off <= 1e-4 * len(states))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("plan")
    parser.add_argument("--states")
    parser.add_argument("--random", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--write-states")
    parser.add_argument("--outcomes")
    parser.add_argument("--compare")
    parser.add_argument("--no-leaps", action="store_true")
    parser.add_argument("--command", help="the fairway program to fly the states with, for comparison")
    options = parser.parse_args()
    plan = Plan(options.plan)
    if options.states:
        rows = read_csv(options.states)
        states = np.array([[float(r[k]) for k in ("x_m", "y_m", "heading_rad")] for r in rows])
    elif options.random:
        states = random_states(plan, options.random, options.seed)
    else:
        parser.error("expected --states or --random")
    if options.write_states:
        write_states(options.write_states, states)

    begin = time.monotonic()
    outcome, length = fly(plan, states, leaps=not options.no_leaps)
    print(f"flown in {time.monotonic() - begin:.1f} s", file=sys.stderr)
    if options.outcomes:
        with open(options.outcomes, "w") as file:
            file.write("x_m,y_m,heading_rad,outcome,time_s,length_m\n")
            for (x, y, h), o, m in zip(states.tolist(), outcome, length.tolist()):
                file.write(f"{x!r},{y!r},{h!r},{OUTCOMES[o]},{m / plan.speed!r},{m!r}\n")
    good = True
    if options.compare:
        good = compare(plan, states, outcome, length, read_csv(options.compare))
    if options.command:
        with tempfile.TemporaryDirectory() as folder:
            given, answered = os.path.join(folder, "states.csv"), os.path.join(folder, "outcomes.csv")
            write_states(given, states)
            subprocess.run(
                [options.command, "simulate", options.plan, "--states", given, "--outcomes", answered, "--quiet"],
                check=True,
                stdout=subprocess.DEVNULL,
            )
            good = compare(plan, states, outcome, length, read_csv(answered)) and good
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
