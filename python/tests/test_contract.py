"""Certificates under a contract: verdicts, that a path is followed, that a goal is held."""
import csv
import io
import json
import math

import numpy as np
import pytest

import fairway

CORNERS = [[100, 100], [220, 60], [340, 110], [350, 220], [220, 260], [90, 210]]


@pytest.fixture(scope="module")
def contract():
    return {"command_error_m": 1.0, "look_ahead_m": 0.0, "heading_error_rad": 0.02,
            "turn_radius_m": [2.4, 2.6], "speed_mps": [1.9, 2.1], "hold_side_rad": math.pi / 2,
            "side_uncertain_rad": 0.0, "wind_mps": 0.0}


@pytest.fixture(scope="module")
def kept(small_plan, contract):
    return fairway.verify(small_plan, contract={**contract, "command_error_m": 0.1}, samples=3000)


@pytest.fixture(scope="module")
def tour():
    return fairway.plan_arrays(np.zeros((40, 56), bool), 8.0, speed_mps=10.0, turn_radius_m=20.0,
                               path_m=CORNERS, closed=True, delta_position_m=6.0)


@pytest.fixture(scope="module")
def followed(tour):
    return fairway.verify(tour, samples=3000)


def test_verdicts_are_those_of_the_command_and_of_flights(small_plan, kept, command, tmp_path):
    assert isinstance(kept, fairway.ContractCertificate)
    assert kept.contract["command_error_m"] == 0.1 and kept.follow is None
    kept.save(tmp_path / "k.safetensors")
    starts = small_plan.random_starts(300, seed=12, where="not_obstacle")
    np.savetxt(tmp_path / "s.csv", starts, delimiter=",", fmt="%.17g")
    rows = list(csv.DictReader(io.StringIO(
        command("query", tmp_path / "k.safetensors", "--states", tmp_path / "s.csv"))))
    verdict, bound_s = kept.query(starts)
    assert [fairway.Verdict(v).name.lower() for v in verdict] == [row["verdict"] for row in rows]
    assert np.array_equal(bound_s, [float(row["time_bound_s"] or "inf") for row in rows])
    flights = small_plan.fly(starts)  # of a vehicle that keeps the contract
    proved = (verdict != fairway.Verdict.UNDECIDED) & (verdict != fairway.Verdict.AT_RISK)
    assert proved.mean() > 0.5
    assert np.array_equal(flights.outcome[proved], verdict[proved])
    reach = verdict == fairway.Verdict.REACH
    assert np.all(flights.time_s[reach] <= bound_s[reach])
    plainly, _ = kept.query(starts, search=False)
    assert np.array_equal(np.where(verdict == fairway.Verdict.AT_RISK, 0, verdict), plainly)


def test_a_file_read_again_tells_the_same(small_plan, kept, command, tmp_path):
    small_plan.save(tmp_path / "p.safetensors")
    kept.save(tmp_path / "k.safetensors")
    same = fairway.load_certificate(tmp_path / "k.safetensors")
    assert isinstance(same, fairway.ContractCertificate)
    for name in ("summary", "contract", "volume_fraction", "leaves", "parts_per_cell", "shape",
                 "cell_m", "origin_m", "extent_m"):
        assert getattr(same, name) == getattr(kept, name), name
    assert sum(kept.volume_fraction.values()) == pytest.approx(1.0)
    assert fairway.check(tmp_path / "k.safetensors", plan=tmp_path / "p.safetensors")["accepted"]
    (tmp_path / "c.toml").write_text("[vehicle.contract]\ncommand_error_m = 0.1\n"
                                     "heading_error_rad = 0.02\nturn_radius_m = [2.4, 2.6]\n"
                                     "speed_mps = [1.9, 2.1]\n")
    command("verify", tmp_path / "p.safetensors", "--contract", tmp_path / "c.toml",
            "--volume-samples", 3000, "-o", tmp_path / "o.safetensors")
    told = json.loads((tmp_path / "o.summary.json").read_text())
    for name, value in kept.summary.items():
        assert name == "plan" or told[name] == value, name
    from_file = fairway.verify(small_plan, contract=tmp_path / "c.toml", samples=3000)
    assert from_file.volume_fraction == kept.volume_fraction
    with pytest.raises(ValueError, match="exists"):
        kept.save(tmp_path / "k.safetensors", force=False)


def test_a_witness_shows_how_a_vehicle_may_fail(plan, command, tmp_path):
    kept = fairway.verify(plan, contract={
        "command_error_m": 3.0, "look_ahead_m": 0.0, "heading_error_rad": 0.02,
        "turn_radius_m": [11.0, 13.0], "speed_mps": [9.0, 11.0], "hold_side_rad": math.pi / 2,
        "side_uncertain_rad": 0.0, "wind_mps": 0.0}, samples=3000)
    starts = plan.random_starts(2000, seed=3, where="not_obstacle")
    verdict, _ = kept.query(starts)
    at_risk = starts[verdict == fairway.Verdict.AT_RISK]
    assert len(at_risk) > 0
    rows = kept.witness(at_risk[0])
    assert np.array_equal(rows[0, 1:4], at_risk[0]) and np.isnan(rows[-1, 4:]).all()
    assert (np.diff(rows[:, 0]) > 0).all() and np.isfinite(rows[:-1, [4, 6, 7, 8]]).all()
    turning = rows[:-1][rows[:-1, 4] != 0.0]
    assert np.allclose(np.abs(turning[:, 4]) * turning[:, 5], 1.0)
    assert ((10.999 < turning[:, 5]) & (turning[:, 5] < 1e9)).all()
    end = rows[-1, 1:3] / 4.0  # in an obstacle: cells of 4 m
    assert plan.region[int(end[1]), int(end[0])] == fairway.Region.OBSTACLE
    kept.save(tmp_path / "k.safetensors")
    command("query", tmp_path / "k.safetensors", "--state",
            ",".join(f"{v:.17g}" for v in at_risk[0]), "--witness", tmp_path / "w.csv")
    told = np.genfromtxt(tmp_path / "w.csv", delimiter=",", skip_header=1)
    assert np.array_equal(told, rows, equal_nan=True)
    proved = starts[verdict == fairway.Verdict.REACH]
    assert kept.witness(proved[0]) is None


def test_a_map_of_verdicts_and_failing_states_are_queries(small_plan, kept, tmp_path):
    verdicts = kept.verdict_map(2.0, search=False)
    assert verdicts.shape == small_plan.shape and verdicts.dtype == np.int8
    iy, ix = np.indices(small_plan.shape)
    states = np.column_stack([(small_plan.origin_m[0] + ix + 0.5 + 1 / 37).ravel(),
                              (small_plan.origin_m[1] + iy + 0.5 - 1 / 53).ravel(),
                              np.full(ix.size, 2.0005)])
    asked, _ = kept.query(states, search=False)
    assert np.mean(asked == verdicts.ravel()) > 0.999
    lost, why = kept.failing_states(of_each=5)
    assert len(lost) and fairway.Verdict.REACH not in why
    assert np.array_equal(kept.query(lost)[0], why)
    kept.save_geotiff(tmp_path / "v.tif", [0.0])
    assert (tmp_path / "v.tif").stat().st_size > 0
    assert "<svg" in kept.picture(headings=2).svg
    assert kept.command(10.0, 20.0, 0.0) == small_plan.command(10.0, 20.0, 0.0)


def test_a_path_is_proved_to_be_followed(tour, followed, command, tmp_path):
    follow = followed.follow
    assert followed.volume_fraction["follow"] > 0.5 and "reach" not in followed.volume_fraction
    assert 0 < follow["tube_m"] < 20 and 0 < follow["tube_heading_rad"] < 2
    assert follow["tube_m"] == max(s["distance_m"] for s in follow["profile"])
    assert "hold_radius_m" not in follow
    least_s, most_s = follow["lap_time_s"]
    starts = tour.random_starts(100, seed=3)
    verdict, bound_s = followed.query(starts, search=False)
    on = verdict == fairway.Verdict.FOLLOW
    assert on.mean() > 0.5 and np.all(np.isfinite(bound_s[on])) and np.all(np.isinf(bound_s[~on]))
    laps = tour.fly(starts[on], laps=3)
    assert np.all(laps.after == fairway.After.FOLLOW)
    assert follow["length_m"] / 10.0 == pytest.approx(0.5 * (least_s + most_s), rel=0.9)
    assert least_s <= follow["length_m"] / 10.0 <= most_s
    tour.save(tmp_path / "p.safetensors")
    command("verify", tmp_path / "p.safetensors", "--volume-samples", 3000, "-o",
            tmp_path / "c.safetensors")
    assert json.loads((tmp_path / "c.summary.json").read_text())["follow"] == follow
    assert fairway.load_certificate(tmp_path / "c.safetensors").follow == follow
    assert fairway.check(tmp_path / "c.safetensors")["accepted"]


def test_the_exact_vehicle_is_asked_for_by_name(tour):
    touched = fairway.verify(tour, method="certified", undecided_max=0.5, samples=2000)
    assert isinstance(touched, fairway.Certificate)
    assert touched.volume_fraction["reach"] > 0.5


def test_a_goal_is_held(tmp_path):
    (tmp_path / "m.pgm").write_bytes(b"P5\n40 40\n255\n" + b"\xff" * 1600)
    scenario = fairway.Scenario.from_text(
        "[map]\nfile = 'm.pgm'\ncell_m = 8.0\nresolution_m = 8.0\n"
        "[vehicle]\nspeed_mps = 10.0\nturn_radius_m = 20.0\n"
        "[mission]\nkind = 'goal'\ngoal_m = [160.0, 160.0]\nhold = true\n"
        "[plan]\nalpha = 0.5\n", tmp_path / "s.toml")
    plan = fairway.plan(scenario)
    held = fairway.verify(plan, samples=2000)
    radius_m = held.follow["hold_radius_m"]
    assert 20.0 < radius_m < 80.0 and held.volume_fraction["reach"] > 0.5
    starts = plan.random_starts(50, seed=2)
    verdict, bound_s = held.query(starts, search=False)
    reach = verdict == fairway.Verdict.REACH
    assert reach.mean() > 0.5 and np.all(np.isfinite(bound_s[reach]))
    flights = plan.fly(starts[reach], laps=5)
    assert np.all(flights.after == fairway.After.HOLD) and np.all(flights.laps > 3)
    assert flights.summary["following"]["after"] == {"hold": reach.sum(), "collide": 0, "leave": 0}


def test_what_is_resumed_goes_on(small_plan, contract, kept, certificate, followed, tour):
    on = fairway.verify(small_plan, resume=kept, samples=3000)
    assert isinstance(on, fairway.ContractCertificate) and on.contract == kept.contract
    assert on.volume_fraction["undecided"] <= kept.volume_fraction["undecided"]
    again = fairway.verify(tour, resume=followed, samples=3000)
    assert again.volume_fraction["follow"] >= followed.volume_fraction["follow"]
    with pytest.raises(ValueError, match="another contract"):
        fairway.verify(small_plan, contract=contract, resume=kept)
    with pytest.raises(ValueError, match="expected a ContractCertificate"):
        fairway.verify(small_plan, contract=contract, resume=certificate)
    with pytest.raises(ValueError, match="is a ContractCertificate"):
        fairway.verify(small_plan, method="certified", resume=kept)


def test_what_makes_no_contract_is_refused_in_words(small_plan, contract):
    for words, given in (("heading_error_rad", {**contract, "heading_error_rad": -1.0}),
                         ("turn_radius_m", {**contract, "turn_radius_m": [3.0, 4.0]}),
                         ("wind_mps", {k: v for k, v in contract.items() if k != "wind_mps"})):
        with pytest.raises(ValueError, match=words):
            fairway.verify(small_plan, contract=given)
    with pytest.raises(ValueError, match="nothing was proved"):
        fairway.verify(small_plan, contract={**contract, "command_error_m": 500.0})
    with pytest.raises(ValueError, match="carries no contract"):
        fairway.verify(small_plan, method="contract")
    with pytest.raises(ValueError, match="goes with"):
        fairway.verify(small_plan, method="certified", contract=contract)
    with pytest.raises(ValueError, match="method"):
        fairway.verify(small_plan, method="bitmap")
    with pytest.raises(ValueError, match="parts_per_cell"):
        fairway.verify(small_plan, contract=contract, parts_per_cell=17)
    with pytest.raises(TypeError, match="resume"):
        fairway.verify(small_plan, resume="a file")


def test_a_pilot_flies_as_is_proved_from_what_it_takes_itself_to_be(small_plan, kept):
    starts = small_plan.random_starts(300, seed=5)
    verdict, bound_s, mode = kept.query_modes(starts)
    assert kept.modes == 1 and not mode.any()
    assert np.array_equal(verdict, kept.query(starts)[0])
    radius, speed = small_plan.vehicle["turn_radius_m"], small_plan.vehicle["speed_mps"]
    step_m, flown = 0.005, 0

    def at_goal(x, y):
        x0, y0 = small_plan.origin_m
        cell = math.floor((y - y0) / small_plan.cell_m), math.floor((x - x0) / small_plan.cell_m)
        return small_plan.region[cell] == fairway.Region.GOAL

    for k in np.flatnonzero(verdict == fairway.Verdict.REACH)[:20]:
        pilot = fairway.ContractPilot(kept)
        x, y, course = starts[k]
        now_s = 7.0
        to, told, in_s, at_mode = pilot.steer(now_s, x + 0.05, y - 0.05, course)
        if told != fairway.Verdict.REACH:
            continue  # some state around it is not proved
        flown += 1
        assert at_mode == 0 and math.isfinite(in_s)
        until_s = now_s + in_s
        while not at_goal(x, y):
            turn = math.remainder(to - course, 2 * math.pi)
            turn = max(-step_m / radius, min(step_m / radius, turn))
            x, y = x + step_m * math.cos(course + turn / 2), y + step_m * math.sin(course + turn / 2)
            course = math.remainder(course + turn, 2 * math.pi)
            now_s += step_m / speed
            assert now_s < until_s + 0.1
            to = pilot.steer(now_s, x + 0.05, y - 0.05, course)[0]
    assert flown > 8
    for bad in ((math.nan, 1, 1, 0), (0, math.inf, 1, 0), (0, 1, 1, math.nan), (0, 1, 1, 9.0)):
        with pytest.raises(ValueError):
            fairway.ContractPilot(kept).steer(*bad)
