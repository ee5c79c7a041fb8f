"""A world that all tests share: 640 by 480 m with a wall, a plan on it and its certificate."""
import os
import pathlib
import subprocess

import numpy as np
import pytest

import fairway

CELL_M = 4.0
FAIRWAY = pathlib.Path(os.environ["FAIRWAY"]).resolve()


@pytest.fixture(scope="session")
def obstacles():
    grid = np.zeros((120, 160), bool)
    grid[0] = grid[-1] = grid[:, 0] = grid[:, -1] = True
    grid[50:60, 60:110] = True
    return grid


@pytest.fixture(scope="session")
def plan(obstacles):
    return fairway.plan_arrays(obstacles, CELL_M, speed_mps=10.0, turn_radius_m=12.0,
                               goal_m=(500.0, 360.0))


@pytest.fixture(scope="session")
def small_plan():
    return fairway.plan_arrays(np.zeros((40, 50), bool), 1.0, (-10.0, 5.0), speed_mps=2.0,
                               turn_radius_m=2.5, goal_m=(20.0, 25.0))


@pytest.fixture(scope="session")
def certificate(small_plan):
    return fairway.verify(small_plan, undecided_max=0.05)


@pytest.fixture(scope="session")
def source():
    return pathlib.Path(os.environ["FAIRWAY_SOURCE"])


@pytest.fixture(scope="session")
def command():
    """Runs the fairway command; its output."""
    def run(*arguments):
        done = subprocess.run([FAIRWAY, *map(str, arguments)], text=True,
                              capture_output=True, stdin=subprocess.DEVNULL)
        assert done.returncode == 0, done.stderr
        return done.stdout
    return run
