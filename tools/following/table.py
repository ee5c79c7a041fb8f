#!/usr/bin/env python3
"""The table of docs/following.md: how plans of race tracks follow their paths, by field.

Usage: table.py FOLDER_OF_MAPS FAIRWAY FAIRWAY_FOLLOWING [--cells 0.25,0.1] [--flights N] [--tracks A,B]

FOLDER_OF_MAPS has f1tenth_racetracks/NAME_map.yaml with NAME_centerline.csv, and
tum_racetracks/NAME.csv (x, y, width to the right and to the left; drawn here as an image).
"""
import argparse
import csv
import io
import pathlib
import subprocess
import sys
import tempfile

SCENARIO = """[map]
file = "{map}"
cell_m = {cell}
{resolution}
[vehicle]
speed_mps = 5.0
turn_radius_m = {radius}
[mission]
kind = "path"
path_file = "{path}"
closed = true
[plan]
alpha = {alpha}
"""


def center_line(file):
    rows = [line.split(",") for line in file.read_text().splitlines() if line and line[0] not in "#x"]
    return [tuple(float(v) for v in row) for row in rows]


def write_path(file, points, shift=(0.0, 0.0)):
    with file.open("w", newline="\n") as out:
        out.write("x_m,y_m\n")
        out.writelines(f"{p[0] - shift[0]:.6f},{p[1] - shift[1]:.6f}\n" for p in points)


def draw_track(file, points, pixel_m, margin_m=12.0):
    """An image, white within the widths of the line; returns the world place of its corner."""
    low = [min(p[i] for p in points) - margin_m for i in (0, 1)]
    high = [max(p[i] for p in points) + margin_m for i in (0, 1)]
    nx, ny = (int((high[i] - low[i]) / pixel_m) + 1 for i in (0, 1))
    image = bytearray(nx * ny)
    for a, b in zip(points, points[1:] + points[:1]):
        length = max(1e-9, ((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) ** 0.5)
        steps = max(1, int(length / pixel_m))
        left = (-(b[1] - a[1]) / length, (b[0] - a[0]) / length)
        for k in range(steps):
            t = k / steps
            x, y = (a[i] + t * (b[i] - a[i]) for i in (0, 1))
            right_m, left_m = (a[i] + t * (b[i] - a[i]) for i in (2, 3))
            across = -right_m
            while across <= left_m:  # a line across the track, two pixels thick
                for along in (0.0, 0.5 * pixel_m):
                    px = int((x + across * left[0] + along * left[1] - low[0]) / pixel_m)
                    py = int((y + across * left[1] - along * left[0] - low[1]) / pixel_m)
                    image[(ny - 1 - py) * nx + px] = 255
                across += 0.5 * pixel_m
    file.write_bytes(f"P5\n{nx} {ny}\n255\n".encode() + bytes(image))
    return low


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("maps", type=pathlib.Path)
    parser.add_argument("fairway")
    parser.add_argument("following")
    parser.add_argument("--cells", default="0.25,0.1")
    parser.add_argument("--flights", default="1000")
    parser.add_argument("--laps", default="3")
    parser.add_argument("--tracks", default="")
    asked = parser.parse_args()
    wanted = set(filter(None, asked.tracks.split(",")))
    print("| track | cells | field | follow | of those facing forward | collide | other | tube | join after |")
    print("|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        tracks = []
        for line in sorted((asked.maps / "f1tenth_racetracks").glob("*_centerline.csv")):
            track = line.name.removesuffix("_centerline.csv")
            write_path(folder / f"{track}.csv", center_line(line))
            for cell in asked.cells.split(","):
                tracks.append((track, cell, dict(map=line.with_name(f"{track}_map.yaml"), resolution="",
                                                 radius=0.8, alpha=0.5, path=f"{track}.csv")))
        for line in sorted((asked.maps / "tum_racetracks").glob("*.csv")):
            track = f"TUM-{line.stem}"
            if wanted and track not in wanted:
                continue
            points = center_line(line)
            low = draw_track(folder / f"{track}.pgm", points, 0.5)
            write_path(folder / f"{track}.csv", points, low)
            tracks.append((track, "1.0", dict(map=folder / f"{track}.pgm", resolution="resolution_m = 0.5",
                                              radius=5.0, alpha=0.3, path=f"{track}.csv")))
        for track, cell, values in tracks:
            if wanted and track not in wanted:
                continue
            scenario = folder / "scenario.toml"
            scenario.write_text(SCENARIO.format(cell=cell, **values))
            for field in ("paper", "follow"):
                plan = folder / "plan.safetensors"
                made = subprocess.run([asked.fairway, "plan", scenario, "-o", plan, "--force", "--quiet",
                                       "--set", f"plan.path_field={field}"], capture_output=True, text=True)
                if made.returncode != 0:
                    print(f"{track} {cell}: {made.stderr.strip()}", file=sys.stderr)
                    break
                out = subprocess.run([asked.following, plan, "--flights", asked.flights, "--laps", asked.laps],
                                     check=True, capture_output=True, text=True).stdout
                row = next(csv.DictReader(io.StringIO(out)))
                percent = lambda *keys: f"{100 * sum(float(row[k]) for k in keys):.1f} %"
                print(f"| {track} | {cell} m | {field} | {percent('follow')} | {percent('follow_facing_forward')} "
                      f"| {percent('collide')} | {percent('loose', 'leave', 'circle')} "
                      f"| {float(row['tube_radii']):.2f} r | {float(row['join_radii']):.1f} r |", flush=True)


if __name__ == "__main__":
    main()
