"""Steering to a pose."""
import math

import numpy as np
import pytest

import fairway

RADIUS_M = 3.0


def random_poses(rng, n):
    return np.column_stack([rng.uniform(-30, 30, (n, 2)), rng.uniform(-7, 7, n)])


def test_paths_end_at_the_goal_and_are_those_of_one_pair_at_a_time():
    rng = np.random.default_rng(20)
    start, goal = random_poses(rng, 200), random_poses(rng, 200)
    length_m, word, end = fairway.steer(start, goal, RADIUS_M)
    assert (length_m.shape, word.shape, word.dtype, end.shape) == (
        (200,), (200,), np.dtype("<U3"), (200, 3))
    np.testing.assert_allclose(end[:, :2], goal[:, :2], atol=1e-9)
    assert np.abs(np.angle(np.exp(1j * (end[:, 2] - goal[:, 2])))).max() < 1e-9
    for i in range(0, 200, 17):
        path = fairway.shortest_path(start[i], goal[i], RADIUS_M)
        assert path.length_m == pytest.approx(length_m[i], rel=1e-12)
        assert path.word == word[i] and sum(path.part_m) == pytest.approx(path.length_m)


def test_a_path_driven_piece_by_piece_arrives():
    path = fairway.shortest_path([0, 0, 0], [20, 15, 2.0], RADIUS_M)
    poses = path.sample(0.01)
    np.testing.assert_array_equal(poses[0], [0, 0, 0])
    np.testing.assert_allclose(poses[-1], [20, 15, 2.0], atol=1e-9)
    steps_m = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    assert steps_m.max() <= 0.01 + 1e-12
    assert steps_m.sum() == pytest.approx(path.length_m, rel=1e-5)
    along = np.column_stack([np.cos(poses[:-1, 2]), np.sin(poses[:-1, 2])])
    moved = np.diff(poses[:, :2], axis=0)
    assert np.all((along * moved).sum(axis=1) >= 0.0)  # it never drives backwards
    np.testing.assert_array_equal(path.pose_at(1e9), path.end)


def test_laws_fly_in_noise_and_to_goals_that_move():
    start, goal, radius_m = [0, 0, 0], [100, 50, math.pi / 2], 20.0
    for law in (fairway.ClfLaw(), fairway.ShortestLaw(0.4, 0.02, tie_m=0.4)):
        still = law.fly(start, goal, radius_m)
        moved = law.fly(start, goal, radius_m, goal_speed=0.25, noise_m=0.02, seed=3)
        again = law.fly(start, goal, radius_m, goal_speed=0.25, noise_m=0.02, seed=3)
        assert still.converged and moved.converged
        assert moved.track[-1][1] > still.track[-1][1] + 20.0  # it fled north
        np.testing.assert_array_equal(moved.track, again.track)
        other = law.fly(start, goal, radius_m, goal_speed=0.25, noise_m=0.02, seed=4)
        assert not np.array_equal(moved.track[:50], other.track[:50])
        wide = law.fly(start, goal, radius_m, tolerance_m=2.0)
        assert wide.converged and wide.length_m < still.length_m
        with pytest.raises(ValueError, match="goal_speed"):
            law.fly(start, goal, radius_m, goal_speed=1.0)


def test_one_goal_serves_many_starts():
    rng = np.random.default_rng(21)
    start = random_poses(rng, 9)
    one = fairway.steer(start, [[5, 5, 1]], RADIUS_M)[0]
    many = fairway.steer(start, np.tile([5.0, 5.0, 1.0], (9, 1)), RADIUS_M)[0]
    assert np.array_equal(one, many)
    with pytest.raises(ValueError, match="9 and 2 rows"):
        fairway.steer(start, start[:2], RADIUS_M)
    nothing = fairway.steer([], [], RADIUS_M)
    assert [len(part) for part in nothing] == [0, 0, 0]


def test_what_cannot_be_steered_is_refused():
    for radius_m in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(ValueError):
            fairway.steer([[0, 0, 0]], [[1, 1, 1]], radius_m)
    with pytest.raises(ValueError, match=r"goal\[0\]: is not finite"):
        fairway.steer([[0, 0, 0]], [[1, 1, math.inf]], 1.0)
    with pytest.raises(ValueError, match="3 numbers"):
        fairway.shortest_path([0, 0], [1, 1, 1], 1.0)


@pytest.mark.parametrize("law", [fairway.ShortestLaw(0.02 * RADIUS_M, 0.02), fairway.ClfLaw()])
def test_laws_drive_to_the_goal(law):
    rng = np.random.default_rng(22)
    for start, goal in zip(random_poses(rng, 8), random_poses(rng, 8)):
        flight = law.fly(start, goal, RADIUS_M)
        assert flight.track.shape[1] == 3 and not flight.track.flags.writeable
        if isinstance(law, fairway.ShortestLaw):
            assert flight.converged
            assert flight.length_m == pytest.approx(
                fairway.shortest_path(start, goal, RADIUS_M).length_m, abs=0.2)
        if flight.converged:
            assert math.hypot(*(flight.end[:2] - goal[:2])) <= 0.02 * RADIUS_M + 1e-9


def test_a_law_in_a_loop_of_ones_own_drives_as_fly_does():
    start, goal, step_m = np.array([0.0, 0.0, 0.5]), np.array([15.0, -4.0, 2.0]), 0.03
    flight = fairway.ShortestLaw(0.06, 0.02).fly(start, goal, RADIUS_M, step_m=step_m)
    law, state, track = fairway.ShortestLaw(0.06, 0.02), start.copy(), [start.copy()]
    for _ in range(len(flight.track) - 1):
        bend = law.curvature_per_m(state, goal, RADIUS_M, step_m)
        assert abs(bend) <= 1 / RADIUS_M + 1e-12
        half = 0.5 * bend * step_m
        chord_m = step_m * np.sinc(half / math.pi)
        state += [chord_m * math.cos(state[2] + half), chord_m * math.sin(state[2] + half), 2 * half]
        track.append(state.copy())
    np.testing.assert_allclose(np.array(track)[:, :2], flight.track[:, :2], atol=1e-6)


def test_options_of_laws():
    fairway.ClfLaw(n=4, repulsion="none")
    with pytest.raises(ValueError, match="overlap_behind"):
        fairway.ClfLaw(repulsion="strong")
    with pytest.raises(ValueError, match="n: expected"):
        fairway.ClfLaw(n=0)


@pytest.mark.parametrize("law", ["shortest", "clf"])
def test_way_points_are_driven_one_after_the_other(law):
    way = np.array([[20.0, 0.0, 0.0], [40.0, 20.0, 1.5], [20.0, 40.0, 3.0]])
    driven = fairway.follow_waypoints([0, 0, 0], way, RADIUS_M, law=law)
    assert driven.converged and len(driven.legs) == 3
    assert driven.length_m == pytest.approx(sum(leg.length_m for leg in driven.legs))
    for leg, goal in zip(driven.legs, way):
        assert leg.reached and np.hypot(*(leg.end[:2] - goal[:2])) <= 0.02 * RADIUS_M + 1e-9
        assert np.array_equal(leg.track[-1], leg.end)
    for before, after in zip(driven.legs, driven.legs[1:]):
        assert np.array_equal(before.end, after.track[0])
    if law == "shortest":
        assert all(leg.length_m < leg.shortest_m + 0.05 * RADIUS_M for leg in driven.legs)
    with pytest.raises(ValueError, match="expected at least one"):
        fairway.follow_waypoints([0, 0, 0], [], RADIUS_M)
    with pytest.raises(ValueError, match="law"):
        fairway.follow_waypoints([0, 0, 0], way, RADIUS_M, law="quick")
