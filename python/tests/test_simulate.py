"""Flights."""
import csv
import gc
import json
import math

import numpy as np
import pytest

import fairway


def test_flights_are_those_of_the_command(plan, command, tmp_path):
    starts = plan.random_starts(300, seed=5, where="flyable")
    flights = plan.fly(starts)
    plan.save(tmp_path / "p.safetensors")
    command("simulate", tmp_path / "p.safetensors", "--random", 300, "--seed", 5, "--random-in",
            "flyable", "--outcomes", tmp_path / "o.csv")
    flights.save_outcomes(tmp_path / "python.csv")
    assert (tmp_path / "python.csv").read_text() == (tmp_path / "o.csv").read_text()
    with open(tmp_path / "o.csv") as lines:
        rows = list(csv.DictReader(lines))
    assert [fairway.Outcome(code).name.lower() for code in flights.outcome] == [
        row["outcome"] for row in rows]
    assert np.array_equal(flights.time_s, [float(row["time_s"]) for row in rows])
    assert sum(flights.counts.values()) == len(flights) == 300


def test_result_arrays_are_views(plan):
    flights = plan.fly(plan.random_starts(50))
    assert (flights.outcome.dtype, flights.time_s.dtype) == (np.int8, np.float64)
    for name in ("outcome", "time_s", "length_m", "start"):
        array = getattr(flights, name)
        assert array.base is flights and not array.flags.writeable
        assert np.shares_memory(array, getattr(flights, name))
    kept, copied = flights.length_m, flights.length_m.copy()
    np.testing.assert_allclose(kept, flights.time_s * 10.0, rtol=1e-15)
    del flights, array
    gc.collect()
    assert np.array_equal(kept, copied)


def test_a_straight_flight_takes_the_time_it_should():
    field = np.zeros((40, 200), bool)
    plan = fairway.plan_arrays(field, 1.0, speed_mps=4.0, turn_radius_m=3.0, goal_m=(150.0, 20.0))
    flights = plan.fly([[60.0, 20.0, 0.0]])
    assert flights.outcome[0] == fairway.Outcome.REACH
    goal_columns = np.nonzero((plan.region == fairway.Region.GOAL)[20])[0]
    assert flights.length_m[0] == pytest.approx(goal_columns.min() - 60.0, abs=0.2)


def test_headings_are_wrapped_and_starts_of_any_layout_are_the_same(plan):
    starts = plan.random_starts(40, seed=2)
    flights = plan.fly(starts)
    turned = starts - 2 * math.pi * np.sign(starts) * [0, 0, 1]
    assert np.all(np.abs(plan.fly(turned).start[:, 2]) <= math.pi)
    np.testing.assert_allclose(plan.fly(turned).time_s, flights.time_s, rtol=1e-6)
    for same in (np.asfortranarray(starts), starts.tolist(), np.repeat(starts, 2, axis=0)[::2]):
        assert np.array_equal(plan.fly(same).time_s, flights.time_s)


def test_degrees_in_the_place_of_radians_are_refused(plan):
    with pytest.raises(ValueError, match="heading_rad is 90"):
        plan.fly([[0.0, 0.0, 90.0]])


def test_no_flights_are_no_error(plan):
    for nothing in ([], np.zeros((0, 3))):
        flights = plan.fly(nothing)
        assert len(flights) == 0 and flights.time_s.shape == (0,) and flights.start.shape == (0, 3)
    assert plan.random_starts(0).shape == (0, 3)


@pytest.mark.parametrize("states, error, words", [
    ([1.0, 2.0, 3.0], ValueError, r"shape \[3\].*\[n, 3\]: x_m, y_m, heading_rad"),
    ([[1.0, 2.0]], ValueError, r"shape \[1, 2\]"),
    ([["1", "2", "3"]], TypeError, "expected numbers"),
    ([[1j, 2.0, 3.0]], TypeError, "complex128"),
    ([[1.0, 2.0, 3.0], [0.0, math.nan, 0.0]], ValueError, r"states\[1\]: is not finite"),
    (None, TypeError, "expected numbers"),
])
def test_other_states_are_refused_in_words(plan, states, error, words):
    for fly in (plan.fly, plan.fly_sampled):
        with pytest.raises(error, match=words):
            fly(states)


def test_a_trajectory_is_the_flight(plan):
    flights = plan.fly(plan.random_starts(20, seed=4))
    for i in (0, 7, -1):
        track = flights.trajectory(i, step_m=1.0)
        assert np.array_equal(track.state[0], flights.start[i])
        assert track.time_s[-1] == pytest.approx(flights.time_s[i], rel=1e-9)
        step_m = np.hypot(*np.diff(track.state[:, :2], axis=0).T)
        assert step_m.max() <= 1.0 + 1e-9
        assert step_m.sum() == pytest.approx(flights.length_m[i], rel=1e-2)
        assert np.abs(track.curvature_per_m).max() <= 1.0 / 12.0 + 1e-12
        assert track.outcome == "reach" and len(track) == len(track.time_s)
    with pytest.raises(IndexError, match="20 flights"):
        flights.trajectory(20)
    with pytest.raises(ValueError, match="positive"):
        flights.trajectory(0, step_m=0.0)


def test_sampled_flights_depend_on_their_number_alone(plan):
    starts = plan.random_starts(30, seed=6)
    options = {"law": "proportional", "gain_per_s": 2.0, "position_noise_m": 0.5,
               "heading_noise_rad": 0.02, "wind_mps": (1.0, -1.0), "gust_mps": 0.5, "seed": 9}
    all_of_them = plan.fly_sampled(starts, **options)
    assert np.array_equal(plan.fly_sampled(starts[:10], **options).time_s, all_of_them.time_s[:10])
    assert not np.array_equal(all_of_them.time_s, plan.fly(starts).time_s)
    assert not np.array_equal(all_of_them.time_s,
                              plan.fly_sampled(starts, **{**options, "seed": 10}).time_s)
    track = all_of_them.trajectory(3)
    assert track.time_s[-1] == pytest.approx(all_of_them.time_s[3], abs=0.06)


def test_a_law_in_python_flies_as_the_same_law_in_the_library(plan):
    starts = plan.random_starts(5, seed=8)
    ours = plan.fly_sampled(starts, law=lambda x, y, h, error, t: 1.5 * error)
    theirs = plan.fly_sampled(starts, law="proportional", gain_per_s=1.5)
    assert np.array_equal(ours.time_s, theirs.time_s)
    assert np.array_equal(ours.trajectory(2).state, theirs.trajectory(2).state)


def test_what_a_law_raises_is_raised(plan):
    with pytest.raises(ZeroDivisionError):
        plan.fly_sampled(plan.random_starts(100), law=lambda *seen: 1 / 0)
    with pytest.raises(RuntimeError):  # no number
        plan.fly_sampled(plan.random_starts(3), law=lambda *seen: "left")
    with pytest.raises(TypeError, match="bang-bang"):
        plan.fly_sampled(plan.random_starts(3), law=3)
    with pytest.raises(ValueError, match="proportional"):
        plan.fly_sampled(plan.random_starts(3), law="fuzzy")


def test_files_of_flights(plan, tmp_path):
    flights = plan.fly(plan.random_starts(3))
    flights.save_csv(tmp_path / "t.csv", step_m=2.0)
    with open(tmp_path / "t.csv") as lines:
        rows = list(csv.DictReader(lines))
    assert {row["flight"] for row in rows} == {"0", "1", "2"}
    flights.save_geojson(tmp_path / "t.geojson")
    features = json.loads((tmp_path / "t.geojson").read_text())["features"]
    assert [f["properties"]["outcome"] for f in features] == ["reach"] * 3
    with pytest.raises(ValueError, match="exists"):
        flights.save_csv(tmp_path / "t.csv", force=False)


def test_random_starts_begin_alike_and_lie_where_asked(plan):
    few, many = plan.random_starts(10, seed=3), plan.random_starts(1000, seed=3)
    assert np.array_equal(many[:10], few)
    ix = ((many[:, 0] - plan.origin_m[0]) // plan.cell_m).astype(int)
    iy = ((many[:, 1] - plan.origin_m[1]) // plan.cell_m).astype(int)
    assert np.all(plan.region[iy, ix] == fairway.Region.FREE)
    with pytest.raises(ValueError, match="safe_start"):
        plan.random_starts(3, where="anywhere")


@pytest.mark.parametrize("wrong", [7.1, -90.0, 1e3])
def test_headings_in_degrees_are_refused_wherever_they_are_given(plan, certificate, wrong):
    hint = "expected radians from -7 to 7" + ("; did you mean math.radians" if abs(wrong) <= 360 else "")
    state = [30.0, 40.0, wrong]
    for call in (lambda: plan.fly([state]), lambda: certificate.query([state]),
                 lambda: certificate.verdict_map(wrong),
                 lambda: fairway.steer([[0, 0, 0]], [state], 10.0),
                 lambda: fairway.shortest_path(state, [0, 0, 0], 10.0)):
        with pytest.raises(ValueError, match=hint):
            call()


SITE = {"fileType": "Plan", "version": 1, "mission": {"version": 2, "items": [], "plannedHomePosition": [47.4, 8.55, 400]},
        "geoFence": {"version": 2, "circles": [], "polygons": [{"version": 1, "inclusion": True, "polygon": [
            [47.393, 8.5397], [47.393, 8.5603], [47.407, 8.5603], [47.407, 8.5397]]}]}}


def test_states_in_degrees_and_back(plan, tmp_path):
    (tmp_path / "site.plan").write_text(json.dumps(SITE))
    site = fairway.read_map(tmp_path / "site.plan", cell_m=20.0)
    on_earth = fairway.plan_arrays(site, speed_mps=12.0, turn_radius_m=45.0, goal_m=(300.0, 200.0))
    degrees = np.array([[47.397, 8.545, 90.0], [47.401, 8.555, 315.0]])
    states = on_earth.states_from_deg(degrees)
    np.testing.assert_allclose(states[:, 2], [0.0, math.pi * 0.75], atol=1e-3)
    np.testing.assert_allclose(on_earth.states_to_deg(states), degrees, atol=1e-7)
    assert on_earth.states_from_deg([]).shape == (0, 3) == on_earth.states_to_deg([]).shape
    assert len(on_earth.fly(states)) == 2
    with pytest.raises(fairway.InputError, match="not georeferenced"):
        plan.states_from_deg(degrees)
    with pytest.raises(ValueError, match="course_deg"):
        on_earth.states_from_deg([[47.397, 8.545, 400.0]])
    with pytest.raises(fairway.InputError, match="100 km"):
        on_earth.states_from_deg([[8.545, 47.397, 0.0]])
