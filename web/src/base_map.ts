// Cells as pixels: each screen pixel looks up its cell and takes a pixel from its code's tile, so
// that patterns keep their size at every zoom. Cost: a few nanoseconds a pixel.
import { fitted, pixelRatio } from "./dom";
import type { CodeLayer, Tiles } from "./layers";
import type { GridShape } from "./record";
import type { Viewport } from "./viewport";

const beyond = 0xfff4f5f6;  // outside the grid

export class BaseMap {
  private readonly context: CanvasRenderingContext2D;
  private image: ImageData | null = null;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly grid: GridShape) {
    this.context = canvas.getContext("2d", { alpha: false })!;
  }

  /** Places in the layer of the middles of pixels along one axis; -1 outside. */
  private places(pixels: number, world: (px: number) => number, origin: number, cells: number, count: number, ratio: number): Int32Array {
    const of = new Int32Array(pixels);
    for (let p = 0; p < pixels; ++p) {
      const cell = Math.floor((world((p + 0.5) / ratio) - origin) / this.grid.cell_m);
      of[p] = cell < 0 || cell >= count ? -1 : Math.floor(cell / cells);
    }
    return of;
  }

  paint(layer: CodeLayer, tiles: Tiles, view: Viewport): void {
    const ratio = pixelRatio();
    fitted(this.canvas, ratio);
    const { width, height } = this.canvas;
    if (!this.image || this.image.width !== width || this.image.height !== height) {
      this.image = new ImageData(width, height);
    }
    const { grid } = this;
    const columns = this.places(width, (p) => view.toWorld(p, 0)[0], grid.x0_m, layer.cells, grid.nx, ratio);
    const rows = this.places(height, (p) => view.toWorld(0, p)[1], grid.y0_m, layer.cells, grid.ny, ratio);
    // Patterns are fixed to the world's origin, so that they move with the map.
    const [ox, oy] = view.toScreen(grid.x0_m, grid.y0_m);
    const { size, pixels } = tiles;
    const phase = (offset: number) => ((-Math.round(offset * ratio)) % size + size) % size;
    const across = new Int32Array(width);
    for (let x = 0, t = phase(ox); x < width; ++x, t = t + 1 === size ? 0 : t + 1) across[x] = t;
    const area = size * size;
    const out = new Uint32Array(this.image.data.buffer);
    const { codes, nx } = layer;
    let left = 0, right = width;  // columns of the grid
    while (left < right && columns[left] < 0) ++left;
    while (right > left && columns[right - 1] < 0) --right;
    // Where each pixel's tile begins, for all screen rows of one row of cells.
    const tile = new Int32Array(width);
    let tiled = -1;
    for (let y = 0, ty = phase(oy); y < height; ++y, ty = ty + 1 === size ? 0 : ty + 1) {
      const row = rows[y], from = y * width;
      if (row < 0) {
        out.fill(beyond, from, from + width);
        continue;
      }
      if (row !== tiled) {
        tiled = row;
        const base = row * nx;
        for (let x = left; x < right; ++x) tile[x] = codes[base + columns[x]] * area + across[x];
      }
      const line = ty * size;
      if (left > 0) out.fill(beyond, from, from + left);
      for (let x = left; x < right; ++x) out[from + x] = pixels[tile[x] + line];
      if (right < width) out.fill(beyond, from + right, from + width);
    }
    this.context.putImageData(this.image, 0, 0);
  }
}

/** A sample of a code for the legend. */
export function paintSample(canvas: HTMLCanvasElement, tiles: Tiles, code: number): void {
  fitted(canvas);
  const image = new ImageData(canvas.width, canvas.height);
  const out = new Uint32Array(image.data.buffer);
  const { size, pixels } = tiles;
  for (let y = 0, o = 0; y < canvas.height; ++y) {
    for (let x = 0; x < canvas.width; ++x) out[o++] = pixels[code * size * size + y % size * size + x % size];
  }
  canvas.getContext("2d")!.putImageData(image, 0, 0);
}
