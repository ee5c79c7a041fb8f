#!/usr/bin/python3
"""Draws the demonstration's race track: track.png, track.yaml (ROS map_server) and track.csv, its
centreline, beside this script.

An invented track for model cars, its walls lines on open ground 1.1 m from the centreline: a curve
through a few points, with bends to both sides.

Needs numpy only. The same bytes every time: `python3 demo/draw_track.py`.
"""

from pathlib import Path

import numpy as np

from draw_map import write_png

RESOLUTION_M = 0.05
WIDTH_M, HEIGHT_M = 28.0, 18.0
WALL_M = 1.1  # from the centreline
WALL_WIDTH_M = 0.2
STEP_M = 0.25
LEAST_BEND_M = 1.6  # no bend of the centreline is tighter: twice the turning radius

CORNERS = [(3.5, 4.0), (9.0, 3.0), (14.0, 5.5), (19.0, 3.2), (24.3, 5.0), (23.8, 10.5), (19.5, 14.4),
           (15.5, 11.3), (11.0, 10.6), (8.0, 14.5), (3.6, 12.5)]


def through(corners, samples=200):
    """A closed curve through the corners, twice differentiable: a periodic cubic spline."""
    corner = np.array(corners)
    n = len(corner)
    # Second derivatives m at the corners: m[i-1] + 4 m[i] + m[i+1] = 6 (p[i-1] - 2 p[i] + p[i+1]).
    index = np.arange(n)
    system = np.zeros((n, n))
    system[index, index] = 4.0
    system[index, (index + 1) % n] = system[index, index - 1] = 1.0
    p, ahead, behind = corner, np.roll(corner, -1, 0), np.roll(corner, 1, 0)
    m = np.linalg.solve(system, 6.0 * (behind - 2.0 * p + ahead))
    t = (np.arange(samples) / samples)[None, :, None]
    m0, m1 = m[:, None], np.roll(m, -1, 0)[:, None]
    p0, p1 = p[:, None], ahead[:, None]
    curve = ((1 - t) * p0 + t * p1 + ((1 - t) ** 3 - (1 - t)) / 6 * m0 + (t ** 3 - t) / 6 * m1)
    return curve.reshape(-1, 2)


def in_steps(curve, step_m):
    """Points of the closed curve in even steps of about this length."""
    closed = np.vstack([curve, curve[:1]])
    station = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(closed, axis=0).T))])
    at = np.linspace(0.0, station[-1], round(station[-1] / step_m), endpoint=False)
    return np.column_stack([np.interp(at, station, closed[:, k]) for k in (0, 1)])


def tightest_bend(line):
    """The least radius of a circle through three neighbours."""
    a, b, c = np.roll(line, 1, 0), line, np.roll(line, -1, 0)
    area = np.abs((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]))
    sides = [np.hypot(*(u - v).T) for u, v in ((a, b), (b, c), (c, a))]
    return np.min(sides[0] * sides[1] * sides[2] / (2.0 * np.maximum(area, 1e-12)))


def distance_to(line, x, y):
    """Distance of every place to the closed line, metres."""
    best = np.full(x.shape, np.inf)
    for (ax, ay), (bx, by) in zip(line, np.roll(line, -1, 0)):
        ex, ey = bx - ax, by - ay
        t = np.clip(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey), 0.0, 1.0)
        best = np.minimum(best, np.hypot(x - ax - t * ex, y - ay - t * ey))
    return best


def main():
    folder = Path(__file__).resolve().parent
    line = np.round(in_steps(through(CORNERS), STEP_M), 3)
    assert tightest_bend(line) > LEAST_BEND_M, tightest_bend(line)
    width, height = round(WIDTH_M / RESOLUTION_M), round(HEIGHT_M / RESOLUTION_M)
    x = (np.arange(width) + 0.5)[None, :] * RESOLUTION_M + np.zeros((height, 1))
    y = (height - np.arange(height) - 0.5)[:, None] * RESOLUTION_M + np.zeros((1, width))
    off_m = distance_to(line, x, y)
    wall = (off_m >= WALL_M) & (off_m < WALL_M + WALL_WIDTH_M)
    write_png(folder / "track.png", np.where(wall, 0, 254).astype(np.uint8))
    (folder / "track.yaml").write_text(
        "image: track.png\n"
        f"resolution: {RESOLUTION_M}\n"
        "origin: [0.0, 0.0, 0.0]\n"
        "negate: 0\n"
        "occupied_thresh: 0.65\n"
        "free_thresh: 0.196\n")
    (folder / "track.csv").write_text("x_m,y_m\n" + "".join(f"{px:.3f},{py:.3f}\n" for px, py in line))


if __name__ == "__main__":
    main()
