// Lines on the map: contours, the field as arrows and streamlines, mission, scale, flights.
import type { Numbers } from "./arrays";
import { short } from "./dom";
import { strokeTrack, type ShownFlight } from "./flights";
import { no_value, RegionCode, valueIndex, type Choke, type Mission, type PageRecord } from "./record";
import { tube_color } from "./tube_chart";
import type { Viewport } from "./viewport";

/** Lines on the grid: places as shares of its width and height in 65535ths. */
export interface GridLines { x: Numbers; y: Numbers; begin: Numbers }

export interface FieldArrays {
  region: Numbers;
  heading: Numbers;
  cost: Numbers;
  streamlines: GridLines;
  contours: GridLines;
  contour_level_m: Numbers;
  tube: GridLines | null;  // about the path that is followed: closed lines
}

export interface LayerChoice { arrows: boolean; streamlines: boolean; contours: boolean; mission: boolean; flights: boolean; chokes: boolean; tube: boolean }

const ink = "#22262b";

export const headingOfCode = (code: number): number => code / no_value * 2 * Math.PI;

function arrowHead(context: CanvasPath, x: number, y: number, ux: number, uy: number, size: number): void {
  context.moveTo(x, y);
  context.lineTo(x - size * ux - 0.4 * size * uy, y - size * uy + 0.4 * size * ux);
  context.lineTo(x - size * ux + 0.4 * size * uy, y - size * uy - 0.4 * size * ux);
  context.closePath();
}

/** What a cell commands, radians, NaN none; null: what the plan's own field does. */
export type CommandAt = (ix: number, iy: number) => number | null;

export class Overlay {
  /** In place of the plan's own commands; null: these. */
  command: CommandAt | null = null;

  constructor(private readonly record: PageRecord, private readonly field: FieldArrays) {}

  draw(context: CanvasRenderingContext2D, view: Viewport, choice: LayerChoice, flights: ShownFlight[], selected: number): void {
    context.lineJoin = "round";
    context.lineCap = "butt";
    if (choice.tube) this.tube(context, view);
    if (choice.contours) this.contours(context, view);
    if (choice.streamlines) this.streamlines(context, view);
    if (choice.arrows) this.arrows(context, view);
    if (choice.flights) this.flights(context, view, flights, selected);
    if (choice.mission) drawMission(context, view, this.record.mission);
    this.frame(context, view);
    drawScale(context, view);
  }

  private lineToScreen(view: Viewport): (u: number, v: number) => [number, number] {
    const { nx, ny, x0_m, y0_m, cell_m } = this.record.grid;
    const [ox, oy] = view.toScreen(x0_m, y0_m);
    const sx = nx * cell_m * view.scale / 65535;
    const sy = ny * cell_m * view.scale / 65535;
    return (u, v) => [ox + u * sx, oy - v * sy];
  }

  private frame(context: CanvasRenderingContext2D, view: Viewport): void {
    const { nx, ny, x0_m, y0_m, cell_m } = this.record.grid;
    const [left, bottom] = view.toScreen(x0_m, y0_m);
    context.strokeStyle = "rgb(34 38 43 / 45%)";
    context.lineWidth = 1;
    context.strokeRect(left, bottom - ny * cell_m * view.scale, nx * cell_m * view.scale, ny * cell_m * view.scale);
  }

  private tube(context: CanvasRenderingContext2D, view: Viewport): void {
    const { tube } = this.field;
    if (!tube) return;
    const at = this.lineToScreen(view);
    context.beginPath();
    for (let k = 0; k + 1 < tube.begin.length; ++k) {
      for (let i = tube.begin[k]; i < tube.begin[k + 1]; ++i) {
        const [x, y] = at(tube.x[i], tube.y[i]);
        if (i === tube.begin[k]) context.moveTo(x, y); else context.lineTo(x, y);
      }
      context.closePath();
    }
    context.fillStyle = "rgb(170 51 119 / 22%)";
    context.fill("evenodd");
    for (const [color, width] of [["rgb(255 255 255 / 75%)", 3.4], [tube_color, 1.5]] as const) {
      context.strokeStyle = color;
      context.lineWidth = width;
      context.stroke();
    }
  }

  private contours(context: CanvasRenderingContext2D, view: Viewport): void {
    const { contours, contour_level_m } = this.field;
    const at = this.lineToScreen(view);
    context.beginPath();
    const labels: [number, number, number, string][] = [];
    for (let k = 0; k + 1 < contours.begin.length; ++k) {
      const begin = contours.begin[k], end = contours.begin[k + 1];
      let along = 0, px = 0, py = 0;
      for (let i = begin; i < end; ++i) {
        const [x, y] = at(contours.x[i], contours.y[i]);
        if (i === begin) context.moveTo(x, y); else {
          context.lineTo(x, y);
          const before = along;
          along += Math.hypot(x - px, y - py);
          if (before < 90 && along >= 90) labels.push([(x + px) / 2, (y + py) / 2, Math.atan2(y - py, x - px), short(contour_level_m[k])]);
        }
        px = x; py = y;
      }
    }
    context.strokeStyle = "rgb(34 38 43 / 55%)";
    context.lineWidth = 0.8;
    context.stroke();
    context.font = "10px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    const taken: [number, number][] = [];
    for (const [x, y, turn, text] of labels) {
      if (taken.some(([a, b]) => Math.hypot(a - x, b - y) < 46)) continue;
      taken.push([x, y]);
      context.save();
      context.translate(x, y);
      context.rotate(Math.abs(turn) > Math.PI / 2 ? turn + Math.PI : turn);
      context.lineWidth = 3;
      context.strokeStyle = "rgb(255 255 255 / 85%)";
      context.strokeText(text, 0, 0);
      context.fillStyle = ink;
      context.fillText(text, 0, 0);
      context.restore();
    }
  }

  private streamlines(context: CanvasRenderingContext2D, view: Viewport): void {
    const { streamlines } = this.field;
    const at = this.lineToScreen(view);
    const heads = new Path2D();
    context.beginPath();
    for (let k = 0; k + 1 < streamlines.begin.length; ++k) {
      const begin = streamlines.begin[k], end = streamlines.begin[k + 1];
      let [px, py] = at(streamlines.x[begin], streamlines.y[begin]);
      context.moveTo(px, py);
      let along = 0, next = 32;
      for (let i = begin + 1; i < end; ++i) {
        const [x, y] = at(streamlines.x[i], streamlines.y[i]);
        context.lineTo(x, y);
        const step = Math.hypot(x - px, y - py);
        along += step;
        if (along >= next && step > 0) {
          arrowHead(heads, x, y, (x - px) / step, (y - py) / step, 5);
          next = along + 85;
        }
        px = x; py = y;
      }
    }
    context.strokeStyle = "rgb(34 38 43 / 72%)";
    context.lineWidth = 0.9;
    context.stroke();
    context.fillStyle = "rgb(34 38 43 / 85%)";
    context.fill(heads);
  }

  private arrows(context: CanvasRenderingContext2D, view: Viewport): void {
    const { nx, ny, x0_m, y0_m, cell_m } = this.record.grid;
    const { heading, region } = this.field;
    const stride = Math.max(this.record.values.cells_per_value, Math.ceil(17 / (cell_m * view.scale)));
    const length = Math.min(0.82 * stride * cell_m * view.scale, 34);
    const head = Math.min(0.42 * length, 6);
    const heads = new Path2D();
    context.beginPath();
    const [left, top] = view.toWorld(0, 0);
    const [right, bottom] = view.toWorld(view.width, view.height);
    // Cells of one fixed lattice, whichever part of the map is shown.
    const first = (world: number, origin: number) => {
      const k = Math.max(0, Math.floor((world - origin) / cell_m / stride) - 1);
      return k * stride + (stride >> 1);
    };
    for (let iy = first(bottom, y0_m); iy < ny && y0_m + (iy - 1) * cell_m < top; iy += stride) {
      for (let ix = first(left, x0_m); ix < nx && x0_m + (ix - 1) * cell_m < right; ix += stride) {
        const i = valueIndex(this.record, ix, iy);
        if (region[i] === RegionCode.obstacle) continue;
        const h = this.command?.(ix, iy) ?? (heading[i] === no_value ? NaN : headingOfCode(heading[i]));
        if (Number.isNaN(h)) continue;
        const ux = Math.cos(h), uy = -Math.sin(h);
        const [x, y] = view.toScreen(x0_m + (ix + 0.5) * cell_m, y0_m + (iy + 0.5) * cell_m);
        context.moveTo(x - ux * length / 2, y - uy * length / 2);
        context.lineTo(x + ux * (length / 2 - 0.8 * head), y + uy * (length / 2 - 0.8 * head));
        arrowHead(heads, x + ux * length / 2, y + uy * length / 2, ux, uy, head);
      }
    }
    context.strokeStyle = "rgb(34 38 43 / 80%)";
    context.lineWidth = 0.9;
    context.stroke();
    context.fillStyle = "rgb(34 38 43 / 88%)";
    context.fill(heads);
  }

  private flights(context: CanvasRenderingContext2D, view: Viewport, flights: ShownFlight[], selected: number): void {
    const many = flights.length > 12;
    context.globalAlpha = selected >= 0 ? 0.22 : many ? 0.6 : 0.9;
    for (const [k, flight] of flights.entries()) {
      if (k === selected) continue;
      strokeTrack(context, view, flight.track, flight.line, many ? 1 : 1.6);
      if (flight.leg) strokeTrack(context, view, flight.leg, flight.leg_line, many ? 1 : 1.6);
    }
    context.globalAlpha = 1;
    const one = flights[selected];
    if (!one) return;
    context.beginPath();
    one.track.trace(context, view);
    one.leg?.trace(context, view);
    context.strokeStyle = "rgb(255 255 255 / 80%)";
    context.lineWidth = 5;
    context.stroke();
    strokeTrack(context, view, one.track, one.line, 2.4);
    if (one.leg) strokeTrack(context, view, one.leg, one.leg_line, 2.4);
  }
}

export function drawMission(context: CanvasRenderingContext2D, view: Viewport, mission: Mission): void {
  context.strokeStyle = "#00694b";
  context.fillStyle = "#00694b";
  if (mission.kind === "goal") {
    const [x, y] = view.toScreen(...mission.goal_m);
    for (const [color, width] of [["rgb(255 255 255 / 90%)", 5], ["#00694b", 2.2]] as const) {
      context.beginPath();
      context.moveTo(x - 7, y); context.lineTo(x + 7, y);
      context.moveTo(x, y - 7); context.lineTo(x, y + 7);
      if (mission.goal_heading_rad !== null) {
        const ux = Math.cos(mission.goal_heading_rad), uy = -Math.sin(mission.goal_heading_rad);
        context.moveTo(x, y); context.lineTo(x + 24 * ux, y + 24 * uy);
        arrowHead(context, x + 28 * ux, y + 28 * uy, ux, uy, 8);
      }
      context.strokeStyle = color;
      context.lineWidth = width;
      context.stroke();
    }
    return;
  }
  const vertices = mission.closed ? [...mission.vertices_m, mission.vertices_m[0]] : mission.vertices_m;
  for (const [color, width] of [["rgb(255 255 255 / 80%)", 5], ["#00694b", 2]] as const) {
    context.beginPath();
    for (const [k, vertex] of vertices.entries()) {
      const [x, y] = view.toScreen(...vertex);
      if (k === 0) context.moveTo(x, y); else context.lineTo(x, y);
    }
    context.strokeStyle = color;
    context.lineWidth = width;
    context.stroke();
  }
}

/** Rings with the chokes' numbers in their table; of several that would overlap, the most costly. */
export function drawChokes(context: CanvasRenderingContext2D, view: Viewport, chokes: Choke[]): void {
  context.font = "600 10px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  const taken: [number, number][] = [];
  for (const [k, choke] of chokes.entries()) {
    const [x, y] = view.toScreen(choke.x_m, choke.y_m);
    if (taken.some(([a, b]) => Math.hypot(a - x, b - y) < 17)) continue;
    taken.push([x, y]);
    context.beginPath();
    context.arc(x, y, 8, 0, 2 * Math.PI);
    context.fillStyle = "rgb(255 255 255 / 88%)";
    context.fill();
    context.strokeStyle = ink;
    context.lineWidth = 1.4;
    context.stroke();
    context.fillStyle = ink;
    context.fillText(String(k + 1), x, y + 0.5);
  }
}

function drawScale(context: CanvasRenderingContext2D, view: Viewport): void {
  const most_m = 130 / view.scale;
  let bar_m = 10 ** Math.floor(Math.log10(most_m));
  for (const times of [5, 2]) if (bar_m * times <= most_m) { bar_m *= times; break; }
  const width = bar_m * view.scale;
  const x = 14, y = view.height - 16;
  const text = bar_m >= 1000 ? `${bar_m / 1000} km` : `${short(bar_m)} m`;
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "left";
  context.textBaseline = "alphabetic";
  const words = context.measureText(text).width;
  context.fillStyle = "rgb(255 255 255 / 88%)";
  context.beginPath();
  context.roundRect(x - 7, y - 9, width + words + 22, 19, 4);
  context.fill();
  context.strokeStyle = ink;
  context.lineWidth = 1.4;
  context.beginPath();
  context.moveTo(x, y - 3); context.lineTo(x, y + 3); context.moveTo(x, y); context.lineTo(x + width, y);
  context.moveTo(x + width, y - 3); context.lineTo(x + width, y + 3);
  context.stroke();
  context.fillStyle = ink;
  context.fillText(text, x + width + 7, y + 4);
}
