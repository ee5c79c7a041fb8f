#!/usr/bin/env python3
"""The table of docs/following.md: how plans of race tracks follow their paths.

Usage: table.py FOLDER_OF_MAPS FAIRWAY FAIRWAY_FOLLOWING [--cells 0.25,0.1] [--states N] [--laps N]
                [--tracks A,B] [--fields follow,paper]

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


def draw_track(file, points, pixel_m):
    """An image, white within the widths of the line; returns the world place of its corner."""
    margin_m = max(max(p[2:4]) for p in points) + 2.0
    low = [min(p[i] for p in points) - margin_m for i in (0, 1)]
    high = [max(p[i] for p in points) + margin_m for i in (0, 1)]
    nx, ny = (int((high[i] - low[i]) / pixel_m) + 1 for i in (0, 1))
    image = bytearray(nx * ny)
    for x, y, right_m, left_m in points:  # what the lines across leave out at the vertices
        reach = int(min(right_m, left_m) / pixel_m)
        px, py = int((x - low[0]) / pixel_m), int((y - low[1]) / pixel_m)
        for dy in range(-reach, reach + 1):
            half = int((reach * reach - dy * dy) ** 0.5)
            first = (ny - 1 - py - dy) * nx + px - half
            image[first:first + 2 * half + 1] = b"\xff" * (2 * half + 1)
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


def tracks_of(maps, folder, cells):
    """Name, side of a cell and values of the scenario of each track."""
    for line in sorted((maps / "f1tenth_racetracks").glob("*_centerline.csv")):
        track = line.name.removesuffix("_centerline.csv")
        write_path(folder / f"{track}.csv", center_line(line))
        for cell in cells:
            yield track, cell, dict(map=line.with_name(f"{track}_map.yaml"), resolution="", radius=0.8,
                                    alpha=0.5, path=f"{track}.csv")
    for line in sorted((maps / "tum_racetracks").glob("*.csv")):
        track = f"TUM-{line.stem}"
        points = center_line(line)
        low = draw_track(folder / f"{track}.pgm", points, 0.5)
        write_path(folder / f"{track}.csv", points, low)
        yield track, "1.0", dict(map=folder / f"{track}.pgm", resolution="resolution_m = 0.5", radius=5.0,
                                 alpha=0.3, path=f"{track}.csv")


def row_of(track, cell, field, row):
    """A share of what is viable lies between those of the two bounds of that."""
    low, high = float(row["viable_least"]), float(row["viable_most"])
    if low == 0.0:
        return f"| {track} | {cell} m | {field} | nothing is viable |"

    def percent(key):
        return f"{100 * float(row[key]):.0f} %"

    cells = [track, f"{cell} m", field, f"{100 * low:.0f} to {100 * high:.0f} %", percent("follow"),
             percent("follow_facing_forward"), f"{float(row['tube_radii']):.2f} r"]
    if row["proved_radii"]:
        length_s = float(row["length_s"])
        laps = [float(row[key]) / length_s for key in ("lap_least_s", "lap_most_s")]
        cells += [f"{100 * float(row['proved']) / high:.0f} %", f"{float(row['proved_gentle_radii']):.2f} r",
                  f"{float(row['proved_radii']):.2f} r", f"{laps[0]:.2f} to {laps[1]:.2f}"]
    else:
        cells += ["none", "", "", ""]
    return "| " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("maps", type=pathlib.Path)
    parser.add_argument("fairway")
    parser.add_argument("following")
    parser.add_argument("--cells", default="0.25")
    parser.add_argument("--states", default="1000")
    parser.add_argument("--laps", default="2")
    parser.add_argument("--tracks", default="")
    parser.add_argument("--fields", default="follow")
    asked = parser.parse_args()
    wanted = set(filter(None, asked.tracks.split(",")))
    print("| track | cells | field | some control could | of these follow | facing forward | tube "
          "| proved to follow | tube | at its widest | laps |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for track, cell, values in tracks_of(asked.maps.resolve(), folder, asked.cells.split(",")):
            if wanted and track not in wanted:
                continue
            scenario = folder / "scenario.toml"
            scenario.write_text(SCENARIO.format(cell=cell, **values))
            for field in asked.fields.split(","):
                plan = folder / "plan.safetensors"
                made = subprocess.run([asked.fairway, "plan", scenario, "-o", plan, "--force", "--quiet",
                                       "--set", f"plan.path_field={field}"], capture_output=True, text=True)
                if made.returncode != 0:
                    print(f"{track} {cell}: {made.stderr.strip()}", file=sys.stderr)
                    break
                out = subprocess.run([asked.following, plan, "--states", asked.states, "--laps", asked.laps,
                                      "--proof"], check=True, capture_output=True, text=True).stdout
                print(row_of(track, cell, field, next(csv.DictReader(io.StringIO(out)))), flush=True)


if __name__ == "__main__":
    main()
