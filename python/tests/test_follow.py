"""Paths followed beyond the first touch, under any law."""
import csv
import json
import math

import numpy as np
import pytest

import fairway

CORNERS = [[60, 60], [340, 60], [340, 240], [60, 240]]


@pytest.fixture(scope="module")
def tour():
    return fairway.plan_arrays(np.zeros((75, 100), bool), 4.0, speed_mps=10.0, turn_radius_m=12.0,
                               path_m=CORNERS, closed=True, delta_position_m=6.0)


def distance_from_tour(points):
    """Of rows x, y from the rectangle, by formula."""
    x, y = np.abs(points[:, 0] - 200) - 140, np.abs(points[:, 1] - 150) - 90
    outside = np.hypot(np.maximum(x, 0), np.maximum(y, 0))
    return np.where((x <= 0) & (y <= 0), np.minimum(-x, -y), outside)


def test_following_leaves_what_the_flight_was(tour):
    starts = tour.random_starts(200, seed=3)
    plain, laps = tour.fly(starts), tour.fly(starts, laps=1)
    for name in ("outcome", "time_s", "length_m"):
        assert np.array_equal(getattr(plain, name), getattr(laps, name))
    assert np.all(plain.after == fairway.After.NONE) and np.all(np.isinf(plain.joined_s))
    assert plain.summary["following"] is None
    on = laps.after == fairway.After.FOLLOW
    assert on.sum() > 190
    np.testing.assert_allclose((laps.flown_m - laps.length_m)[on], 2 * (280 + 180), rtol=1e-9)
    np.testing.assert_allclose(laps.laps[on], 1.0, atol=0.15)
    timed = tour.fly(starts, follow_s=92.0)  # a lap at 10 m/s
    np.testing.assert_allclose(timed.flown_m, laps.flown_m, rtol=1e-9)


def test_measures_are_those_of_the_track(tour):
    starts = tour.random_starts(12, seed=4)
    starts = starts[tour.fly(starts).outcome == fairway.Outcome.REACH][:6]
    flights = tour.fly(starts, laps=2)
    for i in range(6):
        track = flights.trajectory(i, step_m=0.5)
        assert track.time_s[-1] == pytest.approx(flights.after_s[i])
        off_m = distance_from_tour(track.state)[track.time_s >= flights.joined_s[i]]
        assert flights.distance_worst_m[i] == pytest.approx(off_m.max(), abs=1.0)
        assert flights.distance_mean_m[i] == pytest.approx(off_m.mean(), abs=0.2)
        turn = np.abs(np.angle(np.exp(1j * np.diff(track.state[:, 2]))))
        assert flights.turned_rad[i] == pytest.approx(turn.sum(), rel=1e-3)
    assert (flights.reversals.dtype, flights.after.dtype) == (np.uint64, np.int8)
    for name in ("flown_m", "reversals", "after", "joined_s", "on_path_share"):
        array = getattr(flights, name)
        assert array.base is flights and not array.flags.writeable and array.shape == (6,)


def test_any_law_follows_in_wind_and_noise(tour):
    starts = tour.random_starts(20, seed=5)
    options = {"wind_mps": (1.0, -2.0), "heading_noise_rad": 0.02, "seed": 4, "laps": 1}
    named = tour.fly_sampled(starts, law="proportional", gain_per_s=1.5, **options)
    ours = tour.fly_sampled(starts, law=lambda x, y, h, error, t: 1.5 * error, **options)
    for name in ("after", "after_s", "distance_mean_m", "turned_rad", "laps"):
        assert np.array_equal(getattr(named, name), getattr(ours, name))
    exact = tour.fly(starts, laps=1)
    assert named.distance_mean_m.mean() < 1.0
    assert not np.array_equal(named.distance_mean_m, exact.distance_mean_m)


def test_files_are_those_of_the_command(tour, command, tmp_path):
    tour.save(tmp_path / "p.safetensors")
    command("simulate", tmp_path / "p.safetensors", "--random", 50, "--seed", 6, "--follow", 30,
            "--outcomes", tmp_path / "o.csv", "--geojson", tmp_path / "g.geojson")
    flights = tour.fly(tour.random_starts(50, seed=6), follow_s=30)
    flights.save_outcomes(tmp_path / "python.csv")
    assert (tmp_path / "python.csv").read_text() == (tmp_path / "o.csv").read_text()
    with open(tmp_path / "o.csv") as lines:
        rows = list(csv.DictReader(lines))
    assert np.array_equal(flights.after_s, [float(row["after_s"] or 0) for row in rows])
    flights.save_geojson(tmp_path / "python.geojson")
    assert (tmp_path / "python.geojson").read_text() == (tmp_path / "g.geojson").read_text()
    features = json.loads((tmp_path / "python.geojson").read_text())["features"]
    assert [f["properties"].get("after", "none") for f in features] == [
        fairway.After(code).name.lower() for code in flights.after]


def test_what_cannot_be_followed_is_refused_in_words(tour, plan):
    start = [[200.0, 100.0, 0.0]]
    for fly in (tour.fly, tour.fly_sampled):
        with pytest.raises(ValueError, match="one of them"):
            fly(start, laps=1, follow_s=1)
        for wrong in (0.0, -1.0, math.nan, math.inf):
            with pytest.raises(ValueError, match="laps: is "):
                fly(start, laps=wrong)
    with pytest.raises(ValueError, match="follow_s: the plan's mission is not a path"):
        plan.fly([[0.0, 0.0, 0.0]], follow_s=1)
