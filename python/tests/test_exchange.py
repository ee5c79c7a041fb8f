"""Out to GIS programs and ground stations; in the same words as the command."""
import json
import math
import pathlib
import warnings

import numpy as np
import pytest

import fairway

HOME = (47.4, 8.55)


@pytest.fixture(scope="module")
def scenario(tmp_path_factory):
    """A plan within a fence of about 1.5 km, in degrees, to a goal with a heading."""
    folder = tmp_path_factory.mktemp("exchange")
    d = 0.007
    corners = [[HOME[0] + a * d, HOME[1] + b * d / 0.68]
               for a, b in ((-1, -1), (-1, 1), (1, 1), (1, -1))]
    fence = {"fileType": "Plan", "version": 1,
             "geoFence": {"circles": [], "version": 2,
                          "polygons": [{"inclusion": True, "polygon": corners, "version": 1}]},
             "mission": {"items": [], "plannedHomePosition": [*HOME, 400], "version": 2}}
    (folder / "fence.plan").write_text(json.dumps(fence))
    (folder / "s.toml").write_text(
        "[map]\nfile = 'fence.plan'\ncell_m = 10.0\n[vehicle]\nspeed_mps = 12.0\n"
        "turn_radius_m = 30.0\n[mission]\nkind = 'goal'\ngoal_deg = [47.403, 8.556]\n"
        "goal_heading_rad = 2.0\n")
    return fairway.Scenario(folder / "s.toml")


@pytest.fixture(scope="module")
def placed(scenario):
    return fairway.plan(scenario)


def test_a_map_in_degrees_says_where_it_lies(scenario, placed):
    reference = scenario.read_map().georeference
    assert (reference["latitude_deg"], reference["longitude_deg"]) == HOME
    assert placed.record["frame"]["georeference"] == reference


def test_missions_and_rasters_are_those_of_the_command(placed, command, tmp_path):
    placed.save(tmp_path / "p.safetensors")
    start = [[-400.0, -300.0, math.pi]]
    flights = placed.fly(start)
    for name in ("m.plan", "m.waypoints"):
        command("simulate", tmp_path / "p.safetensors", "--state", "-400,-300,180deg", "--qgc",
                tmp_path / name, "--altitude", 90, "--tolerance", 2)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            flights.save_mission(0, tmp_path / ("python-" + name), altitude_m=90, tolerance_m=2)
        # The fence is looked for in the working folder, and is not there.
        assert ["fence=FILE" in str(w.message) for w in told] == [True] * name.endswith(".plan")
        assert (tmp_path / name).read_text() == (tmp_path / ("python-" + name)).read_text()
    command("export", tmp_path / "p.safetensors", "-o", tmp_path / "p.tif")
    placed.save_geotiff(tmp_path / "python.tif")
    assert (tmp_path / "p.tif").read_bytes() == (tmp_path / "python.tif").read_bytes()

    command("simulate", tmp_path / "p.safetensors", "--state", "-400,-300,180deg", "--geojson",
            tmp_path / "t.geojson", "--csv", tmp_path / "t.csv")
    flights.save_geojson(tmp_path / "python.geojson")
    flights.save_csv(tmp_path / "python.csv")
    assert (tmp_path / "t.geojson").read_text() == (tmp_path / "python.geojson").read_text()
    assert (tmp_path / "t.csv").read_text() == (tmp_path / "python.csv").read_text()


def test_a_mission_keeps_a_fence(placed, scenario, tmp_path):
    fence = pathlib.Path(scenario.path).parent / "fence.plan"
    flights = placed.fly([[-400.0, -300.0, math.pi]])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        flights.save_mission(0, tmp_path / "m.plan", fence=fence)
    written = json.loads((tmp_path / "m.plan").read_text())
    assert written["geoFence"] == json.loads(fence.read_text())["geoFence"]
    with pytest.raises(ValueError, match="other mission formats have no fence"):
        flights.save_mission(0, tmp_path / "m.waypoints", fence=fence)


def test_a_track_goes_on_to_the_heading_of_the_goal(placed):
    track = placed.fly([[-400.0, -300.0, math.pi]]).trajectory(0)
    goal_m = placed.record["mission"]["goal_m"]
    np.testing.assert_allclose(track.state[-1], [*goal_m, 2.0], atol=1e-6)
    assert track.time_s[-1] > track.time_to_end_s


def test_rasters_of_verdicts(certificate, command, tmp_path):
    certificate.save(tmp_path / "c.safetensors")
    command("export", tmp_path / "c.safetensors", "-o", tmp_path / "c.tif", "--heading", "0.5",
            "--heading", "-2")
    certificate.save_geotiff(tmp_path / "python.tif", [0.5, -2.0])
    assert (tmp_path / "c.tif").read_bytes() == (tmp_path / "python.tif").read_bytes()
    certificate.save_geotiff(tmp_path / "eight.tif")
    for wrong in ([math.nan], []):
        with pytest.raises(ValueError):
            certificate.save_geotiff(tmp_path / "x.tif", wrong)


def test_what_has_no_place_on_earth_is_no_mission(small_plan, placed, tmp_path):
    flights = small_plan.fly(small_plan.random_starts(2))
    with pytest.raises(ValueError, match="not georeferenced"):
        flights.save_mission(0, tmp_path / "m.plan")
    flights = placed.fly(placed.random_starts(2))
    with pytest.raises(ValueError, match=".plan, .waypoints"):
        flights.save_mission(0, tmp_path / "m.kml")
    with pytest.raises(IndexError):
        flights.save_mission(2, tmp_path / "m.plan")
    with pytest.raises(ValueError, match="altitude"):
        flights.save_mission(0, tmp_path / "m.plan", altitude_m=-1.0)
    assert list(tmp_path.iterdir()) == []
