"""Paper 2's product: bitmaps, any region of interest, and the cellular sets of a cell."""
import csv
import io
import json
import math

import numpy as np
import pytest

import fairway
from fairway import Sampled

SIDES = ("right", "top", "left", "bottom")


@pytest.fixture(scope="module")
def bitmap(small_plan):
    return fairway.draw_bitmap(small_plan, samples=60)


def test_answers_are_what_flights_do_but_for_a_few(small_plan, bitmap):
    starts = small_plan.random_starts(4000, seed=21, where="not_obstacle")
    answer = bitmap.query(starts)
    assert answer.dtype == np.int8 and answer.shape == (4000,)
    reaches = small_plan.fly(starts).outcome == fairway.Outcome.REACH
    decided = answer != Sampled.UNDECIDED
    assert decided.mean() > 0.8
    assert np.mean(reaches[decided] != (answer[decided] == Sampled.REACH)) < 0.005


def test_no_answer_contradicts_a_proof_but_for_a_few(small_plan, bitmap, certificate):
    starts = small_plan.random_starts(4000, seed=22, where="not_obstacle")
    answer = bitmap.query(starts)
    verdict, _ = certificate.query(starts)
    both = (answer != Sampled.UNDECIDED) & (verdict != fairway.Verdict.UNDECIDED)
    agrees = (answer == Sampled.REACH) == (verdict == fairway.Verdict.REACH)
    assert both.mean() > 0.7 and np.mean(~agrees[both]) < 0.005


def test_a_file_reads_back_and_the_command_answers_alike(small_plan, bitmap, command, tmp_path):
    bitmap.save(tmp_path / "b.safetensors")
    with pytest.raises(ValueError):
        bitmap.save(tmp_path / "b.safetensors")
    back = fairway.load_bitmap(tmp_path / "b.safetensors")
    assert np.array_equal(back.words, bitmap.words) and back.summary == bitmap.summary
    assert (back.samples, back.shape, back.extent_m) == (60, small_plan.shape, small_plan.extent_m)
    starts = small_plan.random_starts(200, seed=23, where="not_obstacle")
    np.savetxt(tmp_path / "s.csv", starts, delimiter=",", fmt="%.17g")
    text = command("query", tmp_path / "b.safetensors", "--states", tmp_path / "s.csv")
    rows = list(csv.DictReader(io.StringIO(text)))
    words = {Sampled.UNDECIDED: "undecided", Sampled.REACH: "sampled_reach",
             Sampled.OTHER: "sampled_other"}
    assert [words[Sampled(a)] for a in bitmap.query(starts)] == [row["verdict"] for row in rows]
    assert not any(row["time_bound_s"] for row in rows)
    with pytest.raises(fairway.InputError, match="bitmap"):
        fairway.load_certificate(tmp_path / "b.safetensors")
    with pytest.raises(ValueError, match="no proof"):
        fairway.check(tmp_path / "b.safetensors")


def test_the_words_are_the_samples_of_the_borders(bitmap):
    ny, nx = bitmap.shape
    assert bitmap.words.shape == ((nx - 1) * ny + nx * (ny - 1), (60 * 60 + 63) // 64)
    assert not bitmap.words.flags.writeable
    right = bitmap.border(3, 4, "right")
    assert right.shape == (60, 60)
    assert np.array_equal(right, bitmap.border(4, 4, "left"))
    bits = np.unpackbits(bitmap.words[4 * (nx - 1) + 3].view(np.uint8), bitorder="little")
    assert np.array_equal(right.ravel(), bits[:3600])
    for wrong in ((nx - 1, 0, "right"), (0, 0, "left"), (-1, 0, "right"), (0, ny, "bottom")):
        with pytest.raises(IndexError):
            bitmap.border(*wrong)


def test_a_map_is_a_query_of_every_cell_and_pictures_are_drawn(small_plan, bitmap, tmp_path):
    answer = bitmap.reach_map(0.7)
    assert answer.shape == small_plan.shape and answer.dtype == np.int8
    assert np.all(answer[small_plan.region == fairway.Region.GOAL] == Sampled.REACH)
    assert bitmap.picture(headings=2).png.startswith(b"\x89PNG")
    assert "samples reach" in bitmap.shares_picture(title="t").svg
    bitmap.save_geotiff(tmp_path / "b.tif", [0.0, 1.0])
    assert (tmp_path / "b.tif").stat().st_size > 0


@pytest.mark.parametrize("keywords", [{"samples": 10}, {"samples": 0}, {"samples": 4004}])
def test_samples_out_of_range_are_refused(small_plan, keywords):
    with pytest.raises(ValueError, match="samples"):
        fairway.draw_bitmap(small_plan, **keywords)


def test_a_region_is_any_set_of_cells(small_plan, tmp_path):
    box = (0.0, 10.0, 20.0, 30.0)
    x0, y0, x1, y1 = box
    ring = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
    mask = np.zeros(small_plan.shape, bool)
    mask[5:25, 10:30] = True
    area = tmp_path / "area.geojson"
    area.write_text(json.dumps({"type": "Polygon", "coordinates": [[*ring, ring[0]]]}))
    listed = tmp_path / "cells.csv"
    listed.write_text("ix,iy\n" + "".join(f"{x},{y}\n" for y, x in np.argwhere(mask)))
    wanted = fairway.draw_bitmap(small_plan, region=box, samples=8)
    proved = fairway.verify(small_plan, region=box, undecided_max=1.0)
    for region in (mask, ring, np.array(ring), area, listed):
        got = fairway.draw_bitmap(small_plan, region=region, samples=8)
        assert np.array_equal(got.words, wanted.words)
        assert got.summary["region_of_interest"] == "cells"
    certificate = fairway.verify(small_plan, region=ring, undecided_max=1.0)
    assert certificate.volume_fraction == proved.volume_fraction
    assert certificate.leaves == proved.leaves
    certificate.save(tmp_path / "c.safetensors")
    assert fairway.check(tmp_path / "c.safetensors")["accepted"] is True
    tilted = fairway.draw_bitmap(small_plan, region=[[0, 10], [20, 14], [8, 30]], samples=8)
    assert 0 < np.bitwise_count(tilted.words).sum() if hasattr(np, "bitwise_count") else True


def test_a_region_that_is_none_is_refused(small_plan, tmp_path):
    crossed = [[0, 10], [20, 30], [20, 10], [0, 30]]
    for wrong in (np.ones((3, 3), bool), np.zeros(small_plan.shape, bool), crossed,
                  [[0, 10], [1, 1]], [[0.1, 10.1], [0.3, 10.1], [0.3, 10.4]], tmp_path / "none"):
        with pytest.raises((ValueError, TypeError)):
            fairway.draw_bitmap(small_plan, region=wrong, samples=8)


def first_side_left(track, low, high):
    """The border of a cell that a track leaves by, and place and heading there; None when the track
    has no point on that border, as where one arc goes on beyond it."""
    for x, y, heading in track[1:]:
        away = {"right": high[0] - x, "left": x - low[0], "top": high[1] - y, "bottom": y - low[1]}
        side = min(away, key=away.get)
        if away[side] < -1e-9:
            return None
        if away[side] < 1e-9:
            along = y - low[1] if side in ("right", "left") else x - low[0]
            return side, along, heading
    return None


def holds(ranges, heading, slack):
    turn = np.mod(heading - ranges[:, 0], 2 * math.pi)
    width = ranges[:, 1] - ranges[:, 0]
    return bool(np.any((turn <= width + slack) | (turn >= 2 * math.pi - slack)))


def test_cellular_sets_are_those_of_exact_flights(small_plan):
    random = np.random.default_rng(8)
    ny, nx = small_plan.shape
    d = small_plan.cell_m
    used = 0
    for _ in range(3000):
        ix, iy = int(random.integers(1, nx - 1)), int(random.integers(1, ny - 1))
        if np.any(small_plan.region[iy - 1:iy + 2, ix - 1:ix + 2] == fairway.Region.GOAL):
            continue
        low = np.array(small_plan.origin_m) + d * np.array([ix, iy])
        entry = int(random.integers(4))
        along = d * random.uniform(0.02, 0.98)
        place = {0: (d, along), 1: (along, d), 2: (0.0, along), 3: (along, 0.0)}[entry]
        heading = (entry + 1) * math.pi / 2 + random.uniform(0.02, math.pi - 0.02)
        heading = math.remainder(heading, 2 * math.pi)
        inside = low + place + 1e-10 * np.array([math.cos(heading), math.sin(heading)])
        track = small_plan.fly([[*inside, heading]]).trajectory(0, step_m=d / 2).state
        found = first_side_left(track, low, low + d)
        if found is None:
            continue
        leaves, there, end = found
        if min(there, d - there) < 1e-4:  # a corner belongs to both
            continue
        used += 1
        for side in SIDES:
            ranges = small_plan.backward_set(ix, iy, SIDES[entry], side, along)
            assert ranges.ndim == 2 and ranges.shape[1] == 2
            assert holds(ranges, heading, 1e-4 if side == leaves else -1e-4) == (side == leaves)
        there = float(np.clip(there, 0.0, d))
        assert holds(small_plan.forward_set(ix, iy, SIDES[entry], leaves, there), end, 1e-4)
    assert used > 200


def test_the_command_prints_the_same_sets(small_plan, command, tmp_path):
    small_plan.save(tmp_path / "p.safetensors")
    text = command("cell", tmp_path / "p.safetensors", "--cell", "3,4", "--places", 3,
                   "-o", tmp_path / "cell.svg")
    rows = list(csv.DictReader(io.StringIO(text)))
    assert {row["set"] for row in rows} == {"theta", "phi"}
    for row in rows:
        ask = small_plan.backward_set if row["set"] == "theta" else small_plan.forward_set
        ranges = ask(3, 4, row["entry"], row["exit"], float(row["along_m"]))
        assert [float(row["from_rad"]), float(row["to_rad"])] in ranges.tolist()
    assert (tmp_path / "cell.svg").read_text().startswith("<?xml")
    told = json.loads(command("cell", tmp_path / "p.safetensors", "--cell", "3,4", "--json",
                              "--entry", "left", "--exit", "top"))
    assert len(told["sets"]) == 2 * 8
    assert told["command_rad"] == pytest.approx(float(small_plan.heading_rad[4, 3]))


def test_places_that_are_none_are_refused(small_plan):
    with pytest.raises(IndexError):
        small_plan.backward_set(99, 0, "left", "top", 0.5)
    with pytest.raises(ValueError, match="along_m"):
        small_plan.forward_set(1, 1, "left", "top", 1.5)
    with pytest.raises(ValueError, match="exit"):
        small_plan.forward_set(1, 1, "left", "up", 0.5)
