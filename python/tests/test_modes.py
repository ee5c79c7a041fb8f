"""Plans with modes: their commands, which one serves a state, and the pilot that keeps it."""
import csv
import io
import math

import numpy as np
import pytest

import fairway

SCENARIO = """[map]
file = "{source}/demo/town.map"
resolution_m = 4.0
cell_m = 4.0
[vehicle]
speed_mps = 10.0
turn_radius_m = 9.0
[mission]
kind = "goal"
goal_m = [220.0, 32.0]
[plan]
preset = "paper"
alpha = 0.5
beta = 1.5
modes = 5
"""


@pytest.fixture(scope="module")
def town(source):
    return fairway.plan(fairway.Scenario.from_text(SCENARIO.format(source=source)))


@pytest.fixture(scope="module")
def proof(town):
    return fairway.verify(town, undecided_max=0.02, samples=20000)


def test_commands_of_modes_are_views_of_the_plans_memory(town, small_plan):
    further = town.mode_heading_rad
    assert further.dtype == np.float32 and further.shape[1:] == town.shape
    assert 1 <= len(further) <= 5 and len(further) == len(town.record["modes"])
    assert not further.flags.writeable and not further.flags.owndata
    assert np.shares_memory(further, town.mode_heading_rad)
    inside = town.region != fairway.Region.OBSTACLE
    for field, made in zip(further, town.record["modes"]):
        assert np.isfinite(field[inside]).mean() > 0.9 and np.isnan(field[~inside]).all()
        assert made["rule"] in ("direction", "turning_places")
        if "direction_rad" not in made:
            continue
        # It goes on in its direction, but where walls bend it.
        off = np.cos(field[inside] - made["direction_rad"])
        assert np.median(off) > 0.9
    assert small_plan.mode_heading_rad.shape == (0, *small_plan.shape)


def test_a_query_names_the_mode_and_without_modes_it_is_the_first(town, proof, small_plan, certificate):
    assert proof.modes == len(town.mode_heading_rad) + 1
    starts = town.random_starts(2000, seed=5, where="not_obstacle")
    verdict, bound_s, mode = proof.query_modes(starts)
    assert mode.dtype == np.int8 and mode.shape == (2000,)
    for one, other in zip(proof.query(starts), (verdict, bound_s)):
        assert np.array_equal(one, other)
    reach = verdict == fairway.Verdict.REACH
    assert np.all(mode[~reach] == 0)
    assert 0 <= mode.min() and mode.max() < proof.modes and np.mean(mode > 0) > 0.05
    # The plan's own field brings just those of mode 0.
    outcome = town.fly(starts[reach & (mode == 0)]).outcome
    assert np.all(outcome == fairway.Outcome.REACH)
    assert certificate.modes == 1
    assert not certificate.query_modes(small_plan.random_starts(100, seed=1))[2].any()


def test_queries_are_those_of_the_command(town, proof, command, tmp_path):
    proof.save(tmp_path / "c.safetensors")
    starts = town.random_starts(100, seed=6, where="not_obstacle")
    np.savetxt(tmp_path / "s.csv", starts, delimiter=",", fmt="%.17g")
    text = command("query", tmp_path / "c.safetensors", "--states", tmp_path / "s.csv")
    rows = list(csv.DictReader(io.StringIO(text)))
    verdict, bound_s, mode = proof.query_modes(starts)
    assert [int(row["mode"]) for row in rows] == list(mode)
    assert [row["verdict"] for row in rows] == [fairway.Verdict(v).name.lower() for v in verdict]
    assert np.array_equal(fairway.load_certificate(tmp_path / "c.safetensors").query_modes(starts)[2], mode)


def test_a_map_of_modes_is_that_of_verdicts(town, proof, certificate):
    for heading_rad in (0.0, math.pi):
        modes, verdicts = proof.mode_map(heading_rad), proof.verdict_map(heading_rad)
        assert modes.shape == town.shape and modes.dtype == np.int8
        assert np.array_equal(modes >= 0, verdicts == fairway.Verdict.REACH)
        assert modes.max() > 0
        assert np.all(modes[town.region == fairway.Region.GOAL] == 0)
    assert set(np.unique(certificate.mode_map(1.0))) <= {-1, 0}
    with pytest.raises(ValueError, match="finite"):
        proof.mode_map(math.inf)


def flown(pilot, town, state, step_m=0.05, longest_m=4000.0):
    """Flies by the pilot's commands, in steps: modes, and the way to the goal or to a wall."""
    x, y, heading = state
    speed, radius = town.vehicle["speed_mps"], town.vehicle["turn_radius_m"]
    modes, way_m = [], 0.0
    while way_m < longest_m:
        iy, ix = int((y - town.origin_m[1]) // town.cell_m), int((x - town.origin_m[0]) // town.cell_m)
        if not (0 <= iy < town.shape[0] and 0 <= ix < town.shape[1]):
            return modes, None
        if town.region[iy, ix] != fairway.Region.FREE and town.region[iy, ix] != fairway.Region.BUFFER:
            return modes, way_m if town.region[iy, ix] == fairway.Region.GOAL else None
        command, rate, _, _, mode = pilot.steer(x, y, heading)
        modes.append(mode)
        off = math.remainder(command - heading, 2 * math.pi) if rate else 0.0
        turn = math.copysign(min(abs(off), step_m / radius), rate) if rate else 0.0
        middle = heading + turn / 2
        x, y = x + step_m * math.cos(middle), y + step_m * math.sin(middle)
        heading = math.remainder(heading + turn, 2 * math.pi)
        way_m += step_m
        assert abs(rate) <= speed / radius * 1.0001
    return modes, None


def test_a_pilot_brings_whom_the_plan_alone_does_not_and_mostly_goes_down(town, proof):
    starts = town.random_starts(1500, seed=7, where="not_obstacle")
    verdict, bound_s, mode = proof.query_modes(starts)
    saved = np.flatnonzero((verdict == fairway.Verdict.REACH) & (mode > 0))[:40]
    assert len(saved) == 40
    # Exact flights change modes, too: found by trials, which may miss a few.
    assert np.mean(town.fly(starts[saved]).outcome == fairway.Outcome.REACH) > 0.9
    reached, down, in_time = 0, 0, 0
    for k in saved:
        pilot = fairway.ModePilot(proof)
        assert pilot.mode == 0
        modes, way_m = flown(pilot, town, starts[k])
        assert modes[0] == mode[k]
        down += all(b <= a for a, b in zip(modes, modes[1:]))
        if way_m is None:
            continue
        reached += 1
        in_time += way_m / town.vehicle["speed_mps"] <= bound_s[k] + 0.05
    # What is proved is of exact flights. Steps of 5 cm cross borders a little late, and states along
    # the edges of what is proved do not forgive that: then the pilot asks anew, and may go back.
    assert reached >= 32 and down >= 20 and in_time >= 30, (reached, down, in_time)


def test_a_pilot_refuses_states_that_are_none_and_keeps_its_certificate(proof):
    pilot = fairway.ModePilot(certificate=fairway.verify(
        fairway.plan_arrays(np.zeros((20, 20), bool), 1.0, speed_mps=2.0, turn_radius_m=2.5, goal_m=(10, 10)),
        undecided_max=0.5, samples=1000))
    command, rate, verdict, bound_s, mode = pilot.steer(3.0, 3.0, 0.7)
    assert verdict == fairway.Verdict.REACH and math.isfinite(bound_s) and mode == 0
    assert math.isfinite(command) and abs(rate) <= 0.81
    for bad in ((math.nan, 0, 0), (0, math.inf, 0), (1e30, 0, 0), (0, 0, math.nan), (0, 0, 8.0)):
        with pytest.raises(ValueError):
            pilot.steer(*bad)
    assert pilot.steer(-50.0, 3.0, 0.0)[2] == fairway.Verdict.LEAVE
    with pytest.raises(TypeError):
        fairway.ModePilot(None)
