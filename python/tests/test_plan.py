"""Plans from arrays, scenarios and files."""
import gc
import math
import os

import numpy as np
import pytest

import fairway


def test_arrays_have_the_shape_of_the_obstacles_and_their_meaning(plan, obstacles):
    assert plan.heading_rad.shape == plan.cost_m.shape == plan.region.shape == obstacles.shape
    assert plan.shape == obstacles.shape
    assert (plan.heading_rad.dtype, plan.cost_m.dtype, plan.region.dtype) == (
        np.float32, np.float32, np.int8)
    assert np.array_equal(plan.region == fairway.Region.OBSTACLE, obstacles)
    goal = plan.region == fairway.Region.GOAL
    assert np.all(plan.cost_m[goal] <= 2 * 12.0)
    iy, ix = np.nonzero(goal)
    reach_m = np.hypot((ix + 0.5) * 4.0 - 500.0, (iy + 0.5) * 4.0 - 360.0)
    assert reach_m.max() <= 2 * 12.0  # beta turning radii about goal_m
    free = (plan.region == fairway.Region.FREE) & np.isfinite(plan.cost_m)
    assert np.all(np.abs(plan.heading_rad[free]) <= math.pi)
    assert plan.vehicle == {"speed_mps": 10.0, "turn_radius_m": 12.0}
    assert plan.extent_m == (0.0, 640.0, 0.0, 480.0)


def test_arrays_are_read_only_views_that_keep_the_plan_alive(small_plan):
    plan = fairway.plan_arrays(np.zeros((40, 50), np.uint8), 1.0, (-10, 5), speed_mps=2,
                               turn_radius_m=2.5, goal_m=(20, 25))
    first, second = plan.heading_rad, plan.heading_rad
    assert np.shares_memory(first, second)
    for array in (first, plan.cost_m, plan.region):
        assert not array.flags.owndata
        assert not array.flags.writeable
        with pytest.raises(ValueError):
            array[0, 0] = 0
    assert first.base is plan
    del plan, second, array
    gc.collect()
    assert np.array_equal(first, small_plan.heading_rad, equal_nan=True)


def test_array_options_are_those_of_scenarios(obstacles):
    plan = fairway.plan_arrays(obstacles, 4, speed_mps=5, turn_radius_m=9, goal_m=[500, 360],
                               metric="octile", filter="paper", blend="paper", sigma_cells=3.0,
                               mu_path=0.25, sigma_path=1.25, mu_border=0.75, sigma_border=0.25,
                               alpha=2.5, beta=3.0, axis_capture_rad=0.01)
    assert plan.record["options"]["plan"] == {
        "metric": "octile", "filter": "paper", "blend": "paper", "sigma_cells": 3.0,
        "mu_path": 0.25, "sigma_path": 1.25, "mu_border": 0.75, "sigma_border": 0.25,
        "alpha": 2.5, "beta": 3.0, "axis_capture_rad": 0.01}
    assert plan.record["mission"] == {"kind": "goal", "goal_m": [500.0, 360.0],
                                      "goal_heading_rad": None}


def test_defaults_are_those_of_scenarios(plan, source):
    scenario = fairway.Scenario(source / "demo/demo.toml")
    assert plan.record["options"]["plan"] == scenario.options["plan"]


def test_any_layout_of_the_same_obstacles_gives_the_same_plan(plan, obstacles):
    wide = np.zeros((240, 320), bool)
    wide[::2, ::2] = obstacles
    for same in (np.asfortranarray(obstacles), obstacles.astype(np.uint8), obstacles.tolist(),
                 wide[::2, ::2]):
        other = fairway.plan_arrays(same, 4.0, (0.0, 0.0), speed_mps=10.0, turn_radius_m=12.0,
                                    goal_m=np.array([500, 360]))
        assert np.array_equal(other.heading_rad, plan.heading_rad, equal_nan=True)


def test_a_path_is_followed(obstacles):
    plan = fairway.plan_arrays(obstacles, 4.0, speed_mps=10.0, turn_radius_m=12.0,
                               path_m=[[100, 100], [540, 100], [540, 380], [100, 380]],
                               closed=True)
    assert plan.record["mission"]["closed"] is True
    assert plan.fly(plan.random_starts(200)).counts["reach"] > 190


def test_the_plan_of_a_scenario_is_that_of_the_command_to_the_byte(command, source, tmp_path):
    command("plan", source / "demo/demo.toml", "-o", tmp_path / "command.safetensors")
    stages = []
    plan = fairway.plan(fairway.Scenario(source / "demo/demo.toml"),
                        progress=lambda stage, left_s: stages.append((stage, left_s)))
    plan.save(tmp_path / "python.safetensors")
    assert ((tmp_path / "python.safetensors").read_bytes()
            == (tmp_path / "command.safetensors").read_bytes())
    assert [stage for stage, _ in stages] == ["reading the map", "computing the field"]
    assert stages[0][1] is None and stages[1][1] > 0


def test_a_plan_file_reads_back_the_same(plan, tmp_path):
    path = tmp_path / "p.safetensors"
    plan.save(os.fspath(path))
    back = fairway.load_plan(path)
    assert np.array_equal(back.heading_rad, plan.heading_rad, equal_nan=True)
    assert np.array_equal(back.cost_m, plan.cost_m)
    assert np.array_equal(back.region, plan.region)
    assert (back.cell_m, back.origin_m, back.record["mission"]) == (
        plan.cell_m, plan.origin_m, plan.record["mission"])
    with pytest.raises(fairway.InputError, match="exists"):
        plan.save(path, force=False)
    plan.save(path)
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(fairway.InputError) as error:
        fairway.load_plan(path)
    assert str(path) in error.value.where


def test_a_map_of_a_scenario_plans_as_the_scenario_does(source):
    scenario = fairway.Scenario(source / "demo/demo.toml")
    grid = scenario.read_map()
    assert grid.obstacle.shape == grid.shape and set(np.unique(grid.obstacle)) == {0, 1}
    same = fairway.read_map(source / "demo/basin.yaml", 8.0)
    assert np.array_equal(same.obstacle, grid.obstacle) and same.origin_m == grid.origin_m
    one = fairway.plan_arrays(grid, speed_mps=10, turn_radius_m=20, goal_m=(840, 620))
    assert np.array_equal(one.heading_rad, fairway.plan(scenario).heading_rad, equal_nan=True)
    with pytest.raises(ValueError, match="has its own"):
        fairway.plan_arrays(grid, 8.0, speed_mps=10, turn_radius_m=20, goal_m=(840, 620))


@pytest.mark.parametrize("obstacles, error, words", [
    (np.zeros((9, 9)), TypeError, "bool or uint8"),
    (np.zeros((9, 9), int), TypeError, "compare"),
    (np.zeros(9, bool), ValueError, r"shape \[9\], expected \[ny, nx\]"),
    (np.zeros((2, 3, 4), bool), ValueError, "expected"),
    (np.zeros((0, 3), bool), ValueError, "expected"),
    (np.full((9, 9), 255, np.uint8), ValueError, "other than 0"),
    (None, TypeError, "bool or uint8"),
    ([[1, 2], [3]], TypeError, "bool or uint8"),
])
def test_other_arrays_are_refused_in_words(obstacles, error, words):
    with pytest.raises(error, match=words):
        fairway.plan_arrays(obstacles, 1.0, speed_mps=1.0, turn_radius_m=2.0, goal_m=(4, 4))


@pytest.mark.parametrize("keywords, error, words", [
    ({"speed_mps": -1.0}, ValueError, "expected speed_mps > 0"),
    ({"speed_mps": math.nan}, ValueError, "expected speed_mps > 0"),
    ({"turn_radius_m": 0.0}, ValueError, "expected turn_radius_m larger than the cell"),
    ({"turn_radius_m": 1.0}, ValueError, "expected turn_radius_m larger than the cell"),
    ({"goal_m": (1.0, math.inf)}, ValueError, "goal_m: is not finite"),
    ({"goal_m": (1.0, 2.0, 3.0)}, ValueError, "2 numbers: x_m, y_m"),
    ({"goal_m": None}, ValueError, "expected either"),
    ({"path_m": [[0, 0], [1, 1]]}, ValueError, "expected either"),
    ({"goal_m": None, "path_m": [[0, 0]]}, ValueError, "two or more"),
    ({"metric": "manhattan"}, ValueError, 'expected one of "euclidean", "octile", "paper"'),
    ({"mu_path": 2.0}, ValueError, "mu"),
    ({"colour": 1}, TypeError, "incompatible"),
])
def test_options_out_of_range_are_refused_in_words(obstacles, keywords, error, words):
    given = {"speed_mps": 10.0, "turn_radius_m": 12.0, "goal_m": (500.0, 360.0), **keywords}
    with pytest.raises(error, match=words):
        fairway.plan_arrays(obstacles, 4.0, **given)


def test_a_mission_the_map_does_not_allow_says_why(obstacles):
    def ask(goal_m):
        with pytest.raises(fairway.MissionRefused) as error:
            fairway.plan_arrays(obstacles, 4.0, speed_mps=10.0, turn_radius_m=12.0, goal_m=goal_m)
        return error.value
    assert isinstance(ask((300.0, 220.0)), ValueError)
    assert ask((300.0, 220.0)).reason == "in_obstacle"
    near = ask((300.0, 270.0))
    assert near.reason == "in_buffer" and near.lacks_m > 0.0
    assert ask((-5000.0, 0.0)).reason == "outside_map"


def test_a_wrong_scenario_names_the_line(tmp_path):
    file = tmp_path / "s.toml"
    file.write_text("[map]\nfile = 'a.pgm'\ncell_m = -1\n")
    with pytest.raises(fairway.InputError, match=r"s\.toml:3: map\.cell_m") as error:
        fairway.Scenario(file)
    assert error.value.where == f"{file}:3"
    with pytest.raises(ValueError, match="nowhere.toml"):
        fairway.Scenario(tmp_path / "nowhere.toml")
    with pytest.raises(ValueError, match="there is no such key"):
        fairway.Scenario.from_text("[map]\nfiel = 'a'\n")


def test_a_command_is_that_of_the_cell_and_a_turn_through_the_smaller_angle(plan):
    rate = plan.vehicle["speed_mps"] / plan.vehicle["turn_radius_m"]
    x0, y0 = plan.origin_m
    checked = 0
    for x, y, h in plan.random_starts(300, seed=21, where="not_obstacle"):
        heading, turn = plan.command(x, y, h)
        cell = plan.heading_rad[int((y - y0) // plan.cell_m), int((x - x0) // plan.cell_m)]
        if np.isnan(cell):
            assert np.isnan(heading) and turn == 0
            continue
        assert heading == cell
        left = (float(cell) - h) % (2 * np.pi)
        assert turn == (0 if left == 0 else rate if left < np.pi else -rate)
        assert plan.command(x, y, heading) == (heading, 0)
        checked += 1
    assert checked > 200
    for x, y, h in [(-1e9, 0, 0), (1e300, 0, 0), (float("nan"), 0, 0), (0, 0, float("inf"))]:
        heading, turn = plan.command(x, y, h)
        assert np.isnan(heading) and turn == 0


CONTRACT = {"command_error_m": 6.0, "look_ahead_m": 0.0, "heading_error_rad": 0.035,
            "turn_radius_m": [18.0, 22.0], "speed_mps": [10.0, 10.0],
            "hold_side_rad": np.pi / 2, "side_uncertain_rad": 0.0, "wind_mps": 0.0}


def test_a_contract_of_the_scenario_stands_in_the_plan(tmp_path, source, command):
    file = tmp_path / "contract.toml"
    file.write_text("[vehicle.contract]\ncommand_error_m = 6\nheading_error_rad = 0.035\n"
                    "turn_radius_m = [18, 22]\n")
    assert fairway.read_contract(file, speed_mps=10.0, turn_radius_m=20.0) == CONTRACT
    with pytest.raises(fairway.InputError, match="contract.toml:4: vehicle.contract.turn_radius_m"):
        fairway.read_contract(file, speed_mps=10.0, turn_radius_m=30.0)
    plans = {}
    for name, more in {"with": ["--set", "vehicle.contract.command_error_m=6"], "without": []}.items():
        out = tmp_path / f"{name}.safetensors"
        command("plan", source / "demo/demo.toml", "-o", out, "--quiet", *more)
        plans[name] = fairway.load_plan(out)
    assert plans["without"].contract is None and "contract" not in plans["without"].record
    assert plans["with"].contract["command_error_m"] == 6.0
    assert plans["with"].record["contract"] == plans["with"].contract
    assert np.array_equal(plans["with"].heading_rad, plans["without"].heading_rad, equal_nan=True)
