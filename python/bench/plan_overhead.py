#!/usr/bin/env python3
"""What Python adds to the time of a plan: the same obstacles planned in C++ and from numpy, in turn.

Usage: PYTHONPATH=build/release/python plan_overhead.py build/release/bin/fairway-plan-time
"""
import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import fairway

CELL_M = 4.0


def world(n, rng):
    """n by n cells, a rim, and blocks on a twentieth of it that leave the goal alone."""
    grid = np.zeros((n, n), bool)
    for _ in range(max(3, n // 20)):
        y, x = rng.integers(0, n, 2)
        h, w = rng.integers(2, max(3, n // 12), 2)
        grid[y:y + h, x:x + w] = True
    middle = slice(n // 2 - 12, n // 2 + 13)
    grid[middle, middle] = False
    grid[0] = grid[-1] = grid[:, 0] = grid[:, -1] = True
    return grid


def in_cpp(program, grid, goal, turns):
    with tempfile.NamedTemporaryFile(delete=False) as file:
        file.write(grid.astype(np.uint8).tobytes())
    try:
        ny, nx = grid.shape
        text = subprocess.run([program, file.name, str(nx), str(ny), str(CELL_M), str(goal),
                               str(goal), str(turns)], check=True, capture_output=True).stdout
    finally:
        os.unlink(file.name)
    return [float(line) for line in text.split()]


def in_python(grid, goal, turns):
    seconds = []
    for _ in range(turns):
        begin = time.perf_counter()
        plan = fairway.plan_arrays(grid, CELL_M, speed_mps=10.0, turn_radius_m=3 * CELL_M,
                                   goal_m=(goal, goal))
        heading, cost, region = plan.heading_rad, plan.cost_m, plan.region
        seconds.append(time.perf_counter() - begin)
        del heading, cost, region, plan
    return seconds


def main():
    rng = np.random.default_rng(1)
    print("| cells | C++, median ms | Python, median ms | Python adds | least ms, C++ and Python |")
    print("|---|---|---|---|---|")
    for n, turns, rounds in ((100, 20, 10), (300, 10, 10), (1000, 3, 8)):
        grid = world(n, rng)
        goal = n * CELL_M / 2
        cpp, python = [], []
        for _ in range(rounds):  # in turn, so that a busy machine is busy for both
            cpp += in_cpp(sys.argv[1], grid, goal, turns)
            python += in_python(grid, goal, turns)
        a, b = statistics.median(cpp) * 1e3, statistics.median(python) * 1e3
        print(f"| {n} x {n} | {a:.2f} | {b:.2f} | {100 * (b / a - 1):+.1f} % | "
              f"{min(cpp) * 1e3:.2f}, {min(python) * 1e3:.2f} |")


if __name__ == "__main__":
    main()
