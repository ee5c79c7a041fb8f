// Which part of the world the map shows, in CSS pixels: y up in the world, down on the screen.
import type { GridShape } from "./record";

export class Viewport {
  width = 1;
  height = 1;
  scale = 1;  // pixels per metre
  private cx = 0;
  private cy = 0;
  private fits = true;

  constructor(private readonly grid: GridShape) { this.fit(); }

  private get fittingScale(): number {
    const { nx, ny, cell_m } = this.grid;
    return Math.min(this.width / (nx * cell_m), this.height / (ny * cell_m));
  }

  fit(): void {
    const { nx, ny, x0_m, y0_m, cell_m } = this.grid;
    this.scale = this.fittingScale;
    this.cx = x0_m + nx * cell_m / 2;
    this.cy = y0_m + ny * cell_m / 2;
    this.fits = true;
  }

  resize(width: number, height: number): void {
    this.width = width;
    this.height = height;
    if (this.fits) this.fit();
  }

  get zoomedIn(): boolean { return !this.fits; }

  toScreen(x: number, y: number): [number, number] {
    return [(x - this.cx) * this.scale + this.width / 2, this.height / 2 - (y - this.cy) * this.scale];
  }

  toWorld(px: number, py: number): [number, number] {
    return [this.cx + (px - this.width / 2) / this.scale, this.cy + (this.height / 2 - py) / this.scale];
  }

  zoomAt(px: number, py: number, factor: number): void {
    const least = this.fittingScale;
    const most = 80 / this.grid.cell_m;
    const scale = Math.min(Math.max(this.scale * factor, least), Math.max(most, least));
    if (scale === least) return this.fit();
    const [x, y] = this.toWorld(px, py);
    this.scale = scale;
    this.fits = false;
    const [qx, qy] = this.toScreen(x, y);
    this.pan(px - qx, py - qy);
  }

  pan(dx: number, dy: number): void {
    if (this.fits) return;
    const { nx, ny, x0_m, y0_m, cell_m } = this.grid;
    this.cx = Math.min(Math.max(this.cx - dx / this.scale, x0_m), x0_m + nx * cell_m);
    this.cy = Math.min(Math.max(this.cy + dy / this.scale, y0_m), y0_m + ny * cell_m);
  }

  /** A place in the middle, with so many metres around it in view, or fewer where it is shown nearer already. */
  look(x: number, y: number, across_m: number): void {
    const scale = Math.max(this.scale, Math.min(this.width, this.height) / across_m);
    this.zoomAt(this.width / 2, this.height / 2, scale / this.scale);
    const [px, py] = this.toScreen(x, y);
    this.pan(this.width / 2 - px, this.height / 2 - py);
  }

  /** Moves as little as needed to bring the place into view. */
  show(x: number, y: number): void {
    const margin = 30;
    const [px, py] = this.toScreen(x, y);
    this.pan(
      px < margin ? margin - px : px > this.width - margin ? this.width - margin - px : 0,
      py < margin ? margin - py : py > this.height - margin ? this.height - margin - py : 0);
  }
}
