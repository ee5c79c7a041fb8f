#!/usr/bin/env python3
"""What the command exports to GIS programs and ground stations, and reads back.

Usage: exchange_command_test.py FAIRWAY [unittest arguments]
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

FAIRWAY = None
HOME = (47.4, 8.55)

SCENARIO = """[map]
file = "{map}"
cell_m = 10.0
[vehicle]
speed_mps = 12.0
turn_radius_m = 30.0
[mission]
{mission}
[verify]
undecided_max = 0.5
[simulate]
random = 5
sample = 50
"""


def fence():
    """A keep-in square of about 1.5 km about HOME, as QGroundControl saves it."""
    d = 0.007
    corners = [[HOME[0] + a * d, HOME[1] + b * d / 0.68]
               for a, b in ((-1, -1), (-1, 1), (1, 1), (1, -1))]
    return {"fileType": "Plan", "groundStation": "QGroundControl", "version": 1,
            "geoFence": {"circles": [], "version": 2,
                         "polygons": [{"inclusion": True, "polygon": corners, "version": 1}]},
            "mission": {"items": [], "plannedHomePosition": [*HOME, 400], "version": 2},
            "rallyPoints": {"points": [], "version": 2}}


class Exchange(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-exchange-"))
        (self.folder / "fence.plan").write_text(json.dumps(fence()))
        self.scenario("s.toml", "fence.plan", 'kind = "goal"\ngoal_deg = [47.403, 8.556]')
        self.expect(0, "plan", "s.toml", "-o", "p.safetensors")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def scenario(self, name, map_file, mission):
        (self.folder / name).write_text(SCENARIO.format(map=map_file, mission=mission))

    def expect(self, code, *arguments):
        done = subprocess.run([FAIRWAY, *map(str, arguments)], cwd=self.folder, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def metres_from_home(self, latitude, longitude):
        return (latitude - HOME[0]) * 111_200, (longitude - HOME[1]) * 75_400

    def test_a_flight_becomes_a_mission_that_plans_again(self):
        for name in ("m.plan", "m.waypoints"):
            self.expect(0, "simulate", "p.safetensors", "--state", "-400,-300,180deg", "--qgc",
                        name, "--altitude", 90, "--tolerance", 2)
            # The mission is a separate path, on the same fences.
            self.scenario("again.toml", "fence.plan", f'kind = "path"\npath_file = "{name}"')
            self.expect(0, "plan", "again.toml", "-o", "again.safetensors", "--force")
        mission = json.loads((self.folder / "m.plan").read_text())["mission"]
        places = [item["params"][4:] for item in mission["items"] if item["command"] == 16]
        self.assertTrue(all(altitude == 90 for _, _, altitude in places))
        north, east = self.metres_from_home(*places[0][:2])
        self.assertAlmostEqual(east, -400, delta=3)
        self.assertAlmostEqual(north, -300, delta=3)
        lines = (self.folder / "m.waypoints").read_text().splitlines()
        self.assertEqual(lines[0], "QGC WPL 110")
        self.assertEqual([line.split("\t")[0] for line in lines[1:]],
                         [str(i) for i in range(len(lines) - 1)])
        self.assertEqual([[float(x) for x in line.split("\t")[8:10]] for line in lines[3:]],
                         [place[:2] for place in places])

    def test_a_mission_keeps_the_fence_of_its_map(self):
        def export(*more):
            done = self.expect(0, "simulate", "p.safetensors", "--state", "-400,-300,180deg",
                               "--qgc", "f.plan", "--force", *more)
            return json.loads((self.folder / "f.plan").read_text()), done.stderr
        source = json.loads((self.folder / "fence.plan").read_text())
        mission, told = export()
        self.assertEqual(mission["geoFence"], source["geoFence"])
        self.assertEqual(told, "")
        (self.folder / "fence.plan").rename(self.folder / "moved.plan")
        mission, told = export()
        self.assertEqual(mission["geoFence"]["polygons"], [])
        self.assertIn("has no fence", told)
        self.assertIn("fence.plan, was not found", told)
        mission, told = export("--fence", "moved.plan")
        self.assertEqual(mission["geoFence"], source["geoFence"])
        self.assertEqual(told, "")
        done = self.expect(65, "simulate", "p.safetensors", "--state", "0,0,0", "--qgc", "g.plan",
                           "--fence", "s.toml")
        self.assertIn("s.toml: is not a QGroundControl plan", done.stderr)
        self.assertFalse((self.folder / "g.plan").exists())
        self.expect(64, "simulate", "p.safetensors", "--state", "0,0,0", "--qgc", "g.waypoints",
                    "--fence", "moved.plan")

    def test_a_mission_that_cannot_be_made_is_refused_with_the_reason(self):
        done = self.expect(65, "simulate", "p.safetensors", "--random", 3, "--qgc", "m.plan")
        self.assertIn("3 starts", done.stderr)
        self.expect(64, "simulate", "p.safetensors", "--random", 1, "--qgc", "m.kml")
        (self.folder / "map.pgm").write_bytes(b"P5\n60 60\n255\n" + b"\xff" * 3600)
        self.scenario("flat.toml", "map.pgm", 'kind = "goal"\ngoal_m = [300, 300]')
        text = (self.folder / "flat.toml").read_text()
        (self.folder / "flat.toml").write_text(text.replace("[vehicle]",
                                                            "resolution_m = 10.0\n[vehicle]"))
        self.expect(0, "plan", "flat.toml", "-o", "flat.safetensors")
        done = self.expect(65, "simulate", "flat.safetensors", "--random", 1, "--qgc", "m.plan")
        self.assertIn("not georeferenced", done.stderr)
        self.assertFalse((self.folder / "m.plan").exists())
        report = json.loads(self.expect(0, "--json", "export", "flat.safetensors", "-o",
                                        "flat.tif").stdout)
        self.assertEqual((report["of"], report["on_earth"]), ("plan", False))

    def test_rasters_of_plan_and_verdicts(self):
        report = json.loads(self.expect(0, "--json", "export", "p.safetensors", "-o",
                                        "p.tif").stdout)
        self.assertEqual((report["of"], report["on_earth"]), ("plan", True))
        self.assertEqual((self.folder / "p.tif").read_bytes()[:2], b"II")
        self.expect(65, "export", "p.safetensors", "-o", "p.tif")
        self.expect(0, "export", "p.safetensors", "-o", "p.tif", "--force")
        self.assertIn("certificate", self.expect(65, "export", "p.safetensors", "-o", "q.tif",
                                                 "--heading", "0").stderr)
        self.expect(0, "verify", "p.safetensors", "--undecided-max", 0.5, "-o", "c.safetensors")
        report = json.loads(self.expect(0, "--json", "export", "c.safetensors", "-o", "c.tif",
                                        "--heading", "90deg", "--heading", "-0.5").stdout)
        self.assertEqual(report["headings_rad"], [1.5707963267948966, -0.5])
        self.assertTrue(report["on_earth"])  # the certificate alone says where it lies
        self.expect(0, "export", "c.safetensors", "-o", "eight.tif")
        self.expect(64, "export", "c.safetensors", "-o", "x.tif", "--heading", "north")
        self.assertIn("s.toml: is a scenario: `fairway plan` makes a plan from it",
                      self.expect(65, "export", "s.toml", "-o", "x.tif").stderr)
        self.assertIn("expected a name that ends in .tif or .tiff",
                      self.expect(64, "export", "p.safetensors", "-o", "p.png").stderr)
        self.expect(0, "export", "p.safetensors", "-o", "capitals.TIFF")
        if shutil.which("gdalinfo"):
            info = json.loads(subprocess.run(["gdalinfo", "-json", self.folder / "p.tif"],
                                             check=True, capture_output=True).stdout)
            self.assertEqual([band["description"] for band in info["bands"]],
                             ["heading_rad", "cost_m", "region"])
            self.assertEqual([band.get("unit", "") for band in info["bands"]], ["rad", "m", ""])
            self.assertEqual({str(band["noDataValue"]).lower() for band in info["bands"]}, {"nan"})
            self.assertIn("Azimuthal", info["coordinateSystem"]["wkt"])
            longitude, latitude = info["wgs84Extent"]["coordinates"][0][0]
            north, east = self.metres_from_home(latitude, longitude)
            self.assertLess(abs(north), 900)
            self.assertLess(abs(east), 900)

    def test_tracks_are_in_degrees_on_such_maps(self):
        self.expect(0, "simulate", "p.safetensors", "--random", 2, "--geojson", "t.geojson")
        tracks = json.loads((self.folder / "t.geojson").read_text())
        self.assertNotIn("note", tracks)
        for feature in tracks["features"]:
            self.assertEqual(set(feature["properties"]),
                             {"flight", "outcome", "time_s", "length_m"})
            for longitude, latitude in feature["geometry"]["coordinates"]:
                self.assertLess(abs(longitude - HOME[1]) + abs(latitude - HOME[0]), 0.03)


if __name__ == "__main__":
    FAIRWAY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
