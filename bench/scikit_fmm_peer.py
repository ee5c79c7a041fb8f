"""Solves the eikonal equation with scikit-fmm, for requests on stdin, one per line.

Prints "ready VERSION" or "absent REASON" first. A request is one line,
    MASK NX NY GOAL_X GOAL_Y RADIUS ORDER OUT
where MASK is a file of NX * NY bytes, [iy][ix], nonzero: blocked. Distances, in cells, grow from the
disc of RADIUS cells about the centre of cell (GOAL_X, GOAL_Y), whose border is the zero contour that
scikit-fmm starts from; RADIUS is added afterwards. The answer is "WALL_S CPU_S" of the solver call
alone; OUT, if not "-", gets NX * NY doubles, +inf where no distance was found.
"""
import sys
import time

try:
    import numpy as np
    import skfmm
except ImportError as error:
    print("absent", error, flush=True)
    sys.exit(0)
print("ready", getattr(skfmm, "__version__", "of unknown version"), flush=True)


def solve(mask_path, nx, ny, goal_x, goal_y, radius, order, out_path):
    blocked = np.fromfile(mask_path, dtype=np.uint8).reshape(ny, nx) != 0
    x = np.arange(nx, dtype=float) - goal_x
    y = np.arange(ny, dtype=float) - goal_y
    phi = np.ma.MaskedArray(np.hypot(x[None, :], y[:, None]) - radius, blocked)
    wall, cpu = time.perf_counter(), time.process_time()
    distance = skfmm.distance(phi, dx=1.0, order=order)
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    if out_path != "-":
        (np.ma.filled(distance, np.inf) + radius).tofile(out_path)
    return wall, cpu


for line in sys.stdin:
    mask_path, nx, ny, goal_x, goal_y, radius, order, out_path = line.split()
    wall, cpu = solve(mask_path, int(nx), int(ny), int(goal_x), int(goal_y), float(radius), int(order),
                      out_path)
    print(wall, cpu, flush=True)
