"""How good a plan can be: ceiling, improve, compare and tune, as the commands have them."""
import json

import numpy as np
import pytest

import fairway


@pytest.fixture(scope="module")
def tight_plan():
    """A bay with two rocks, whose plan wastes some states."""
    cells = np.zeros((30, 36), bool)
    cells[0] = cells[-1] = cells[:, 0] = cells[:, -1] = True
    cells[8:12, 10:16] = cells[17:21, 20:25] = True
    return fairway.plan_arrays(cells, 1.0, speed_mps=2.0, turn_radius_m=2.5, goal_m=(31.0, 15.0),
                               alpha=0.5, beta=1.0)


@pytest.fixture(scope="module")
def bracket(tight_plan):
    return fairway.ceiling(tight_plan, levels_max=2)


@pytest.fixture(scope="module")
def improvement(tight_plan):
    return fairway.improve(tight_plan)


def test_a_plan_keeps_less_than_any_control_could(tight_plan, bracket):
    proved = fairway.verify(tight_plan).summary["volume_fraction"]["reach"]
    assert 0.0 < bracket.all[0] <= bracket.all[1] <= 1.0
    assert proved <= bracket.all[1] + 1e-3
    assert bracket.buffer[1] <= bracket.free[1] and bracket.levels in (1, 2) and bracket.complete


def test_shares_of_cells_and_headings_do_not_overlap(tight_plan, bracket):
    assert bracket.inside.shape == bracket.lost.shape and bracket.inside.shape[1:] == (30, 36)
    assert bracket.inside.dtype == np.float32 and not bracket.inside.flags.writeable
    assert (bracket.inside + bracket.lost).max() <= 1.0
    in_wall = tight_plan.region == fairway.Region.OBSTACLE
    assert not bracket.inside[:, in_wall].any() and not bracket.lost[:, in_wall].any()
    open_cells = (tight_plan.region == fairway.Region.FREE) | (
        tight_plan.region == fairway.Region.BUFFER)
    assert bracket.inside[:, open_cells].mean() == pytest.approx(bracket.all[0], abs=1e-6)


def test_a_ceiling_is_drawn_and_written(bracket, tmp_path):
    bracket.picture(title="A bay").save(tmp_path / "ceiling.svg")
    assert "A bay" in (tmp_path / "ceiling.svg").read_text()
    bracket.save(tmp_path / "ceiling.safetensors")
    with pytest.raises(fairway.InputError, match="exists"):
        bracket.save(tmp_path / "ceiling.safetensors", force=False)


@pytest.mark.parametrize("limits", [{"gap_max": 0.0}, {"levels_max": 6}, {"time_limit_s": -1.0},
                                    {"memory_limit_mb": 0.0}])
def test_limits_of_a_ceiling_are_refused(tight_plan, limits):
    with pytest.raises(ValueError, match=next(iter(limits))):
        fairway.ceiling(tight_plan, **limits)


def test_improving_proves_more_and_says_what_was_changed(tight_plan, improvement):
    made = improvement
    assert made.improved and made.attempts >= 1
    assert made.proved_after["exact"] > made.proved_before["exact"]
    assert made.proved_after["under_contract"] is None
    before, after = tight_plan.heading_rad, made.plan.heading_rad
    differ = (before != after) & ~(np.isnan(before) & np.isnan(after))
    assert len(made.changes) == differ.sum() > 0
    for x_m, y_m, old, new in made.changes:
        cell = int(y_m), int(x_m)
        assert old == before[cell] and new == after[cell]


def test_improving_refuses_what_makes_no_sense(tight_plan):
    with pytest.raises(ValueError, match="sweeps"):
        fairway.improve(tight_plan, sweeps=0)
    with pytest.raises(ValueError, match="undecided_max"):
        fairway.improve(tight_plan, undecided_max=2.0)


def test_plans_are_compared_and_written(tight_plan, improvement, tmp_path):
    tight_plan.save(tmp_path / "before.safetensors")
    improvement.plan.save(tmp_path / "after.safetensors")
    both = [tmp_path / "before.safetensors", tmp_path / "after.safetensors"]
    found = fairway.compare(both, tmp_path / "page", states=5000)
    assert found == json.loads((tmp_path / "page" / "comparison.json").read_text())
    assert (tmp_path / "page" / "compare.html").exists()
    alone = fairway.compare([both[0], both[0]], quick=True, states=1000)
    assert alone["pairs"][0]["only_first"]["value"] == 0.0
    with pytest.raises(ValueError, match="plans"):
        fairway.compare(both[:1])
    with pytest.raises(fairway.InputError, match="does not exist"):
        fairway.compare([both[0], tmp_path / "nothing"])


def test_a_scenario_is_tuned(tmp_path):
    (tmp_path / "lake.map").write_text(
        "type octile\nheight 24\nwidth 30\nmap\n" +
        "\n".join("." * 12 + ("@@@" if 8 < row < 14 else "...") + "." * 15 for row in range(24)))
    (tmp_path / "lake.toml").write_text("""
[map]
file = "lake.map"
resolution_m = 1.0
cell_m = 1.0
[vehicle]
speed_mps = 2.0
turn_radius_m = 2.5
[mission]
kind = "goal"
goal_m = [24.0, 12.0]
[plan]
preset = "paper"
alpha = 0.5
beta = 1.0
""")
    stages = []
    made = fairway.tune(tmp_path / "lake.toml", tmp_path / "tuned", vary=["plan.alpha=0.3:2"],
                        evaluations=6, finalists=1, progress=lambda stage, _: stages.append(stage))
    assert stages and (tmp_path / "tuned" / "scenario.toml").exists()
    assert made.summary == json.loads((tmp_path / "tuned" / "summary.json").read_text())
    with pytest.raises(fairway.InputError, match="plan.alpha"):
        fairway.tune(tmp_path / "lake.toml", tmp_path / "other", vary=["plan.alpha=much"])
    with pytest.raises(ValueError, match="evaluations"):
        fairway.tune(tmp_path / "lake.toml", tmp_path / "other", evaluations=0)
