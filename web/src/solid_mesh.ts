// The boundary of a set of voxels (x, y, heading) as quadrilaterals, neighbours in a row joined.

export interface Voxels { nx: number; ny: number; nz: number; inside: Uint8Array }  // [z][y][x]

export interface Quads { position: Float32Array; shade: Float32Array; count: number }

/** Brightness of a face by the direction it faces: left, right, back, front, down, up. */
const shades = [0.74, 0.86, 0.8, 0.68, 0.6, 1];

/** Corners in voxel steps; four vertices to a quadrilateral, counter-clockwise from outside. */
export function boundary(voxels: Voxels): Quads {
  const { nx, ny, nz, inside } = voxels;
  const corners: number[] = [];
  const shade: number[] = [];
  const at = (x: number, y: number, z: number): boolean =>
    x >= 0 && y >= 0 && z >= 0 && x < nx && y < ny && z < nz && inside[(z * ny + y) * nx + x] === 1;
  const add = (side: number, a: number[], b: number[], c: number[], d: number[]) => {
    corners.push(...a, ...b, ...c, ...d);
    shade.push(shades[side]);
  };
  // Runs along x of faces that face along y or z; runs along y of those that face along x.
  const runs = (length: number, open: (k: number) => boolean, emit: (from: number, to: number) => void) => {
    for (let k = 0; k < length; ++k) {
      if (!open(k)) continue;
      const from = k;
      while (k + 1 < length && open(k + 1)) ++k;
      emit(from, k + 1);
    }
  };
  for (let z = 0; z < nz; ++z) {
    for (let y = 0; y < ny; ++y) {
      runs(nx, (x) => at(x, y, z) && !at(x, y - 1, z), (a, b) => add(3, [a, y, z], [b, y, z], [b, y, z + 1], [a, y, z + 1]));
      runs(nx, (x) => at(x, y, z) && !at(x, y + 1, z), (a, b) => add(2, [b, y + 1, z], [a, y + 1, z], [a, y + 1, z + 1], [b, y + 1, z + 1]));
      runs(nx, (x) => at(x, y, z) && !at(x, y, z - 1), (a, b) => add(4, [a, y + 1, z], [b, y + 1, z], [b, y, z], [a, y, z]));
      runs(nx, (x) => at(x, y, z) && !at(x, y, z + 1), (a, b) => add(5, [a, y, z + 1], [b, y, z + 1], [b, y + 1, z + 1], [a, y + 1, z + 1]));
    }
    for (let x = 0; x < nx; ++x) {
      runs(ny, (y) => at(x, y, z) && !at(x - 1, y, z), (a, b) => add(0, [x, b, z], [x, a, z], [x, a, z + 1], [x, b, z + 1]));
      runs(ny, (y) => at(x, y, z) && !at(x + 1, y, z), (a, b) => add(1, [x + 1, a, z], [x + 1, b, z], [x + 1, b, z + 1], [x + 1, a, z + 1]));
    }
  }
  return { position: new Float32Array(corners), shade: new Float32Array(shade), count: shade.length };
}
