#!/usr/bin/python3
"""Draws the demonstration map: basin.png and basin.yaml (ROS map_server), beside this script.

An invented basin of 1000 m by 800 m at 2 m a pixel with islands of irregular, non-convex shape. Each
island is a thick bent line or blob whose shore is roughened by seeded noise; a bay with a narrow
mouth has water inside that a vehicle with a wide turn cannot leave with room to spare.

Needs numpy only. The same bytes every time: `python3 demo/draw_map.py`.
"""

import struct
import zlib
from pathlib import Path

import numpy as np

RESOLUTION_M = 2.0
WIDTH, HEIGHT = 500, 400  # pixels
SEED = 20190710

# Islands as bent lines (metres, x east, y north) with a half width; several may touch.
ISLANDS = [
    ([(440, 565), (520, 590), (590, 540), (612, 435), (580, 335), (500, 285)], 20),  # the hook
    ([(0, 500), (60, 495), (140, 535), (185, 505)], 28),                             # western cape
    ([(140, 535), (165, 480)], 20),
    ([(170, 165), (265, 140), (330, 180)], 24),                                      # the boomerang
    ([(300, 800), (290, 755), (320, 725)], 28),                                      # northern cape
    ([(600, 0), (585, 65), (620, 110)], 28),                                         # southern cape
    ([(800, 345), (865, 385), (1000, 395)], 26),                                     # eastern cape
    ([(800, 345), (792, 315)], 26),
    ([(800, 100), (790, 165), (830, 225), (895, 238), (950, 200), (962, 135), (925, 75), (865, 62)],
     14),                                                                            # the bay
]
SHORE_ROUGHNESS_M = 9.0


def distance_to_line(x, y, line):
    """Distance of every pixel centre to a polyline, metres."""
    best = np.full(x.shape, np.inf)
    for (ax, ay), (bx, by) in zip(line, line[1:]):
        ex, ey = bx - ax, by - ay
        t = np.clip(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey), 0.0, 1.0)
        best = np.minimum(best, np.hypot(x - ax - t * ex, y - ay - t * ey))
    return best


def smooth_noise(random, wavelength_m):
    """Noise of mean 0 and deviation 1 without anything much shorter than the wavelength."""
    noise = random.standard_normal((HEIGHT, WIDTH))
    fx = np.fft.fftfreq(WIDTH, RESOLUTION_M)[None, :]
    fy = np.fft.fftfreq(HEIGHT, RESOLUTION_M)[:, None]
    low_pass = np.exp(-0.5 * (fx * fx + fy * fy) * wavelength_m**2)
    smooth = np.fft.ifft2(np.fft.fft2(noise) * low_pass).real
    return (smooth - smooth.mean()) / smooth.std()


def draw():
    """Boolean [row][column], row 0 in the north, True on land."""
    random = np.random.Generator(np.random.PCG64(SEED))
    x = (np.arange(WIDTH) + 0.5)[None, :] * RESOLUTION_M + np.zeros((HEIGHT, 1))
    y = (HEIGHT - np.arange(HEIGHT) - 0.5)[:, None] * RESOLUTION_M + np.zeros((1, WIDTH))
    shore_m = SHORE_ROUGHNESS_M * (0.85 * smooth_noise(random, 60.0) + 0.25 * smooth_noise(random, 30.0))
    land = np.zeros((HEIGHT, WIDTH), dtype=bool)
    for line, half_width_m in ISLANDS:
        rough = np.clip(shore_m, -0.6 * half_width_m, 0.9 * half_width_m)
        land |= distance_to_line(x, y, line) < half_width_m + rough
    return land


def write_png(path, grey):
    """8-bit greyscale, by the PNG specification's three chunks."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + row.tobytes() for row in grey)
    header = struct.pack(">IIBBBBB", grey.shape[1], grey.shape[0], 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                     + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def main():
    folder = Path(__file__).resolve().parent
    write_png(folder / "basin.png", np.where(draw(), 0, 254).astype(np.uint8))
    (folder / "basin.yaml").write_text(
        "image: basin.png\n"
        f"resolution: {RESOLUTION_M}\n"
        "origin: [0.0, 0.0, 0.0]\n"
        "negate: 0\n"
        "occupied_thresh: 0.65\n"
        "free_thresh: 0.196\n")


if __name__ == "__main__":
    main()
