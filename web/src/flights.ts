// Flights as pieces of constant curvature: where the vehicle is at a time, and lines on a canvas.
import type { Numbers } from "./arrays";
import type { FlightRecord, Line, PageRecord } from "./record";
import type { Viewport } from "./viewport";

export interface Pose { x: number; y: number; h: number }

/** Pieces of one flight: places in metres in the world. */
export class Track {
  readonly count: number;
  readonly time_s: Float64Array;  // at the start of each piece, and at the end of the last

  constructor(
    readonly x: ArrayLike<number>, readonly y: ArrayLike<number>, readonly h: ArrayLike<number>,
    readonly length_m: ArrayLike<number>, readonly curvature_per_m: ArrayLike<number>,
    readonly x0: number, readonly y0: number, readonly speed_mps: number,
  ) {
    this.count = x.length;
    this.time_s = new Float64Array(this.count + 1);
    for (let i = 0; i < this.count; ++i) this.time_s[i + 1] = this.time_s[i] + length_m[i] / speed_mps;
  }

  get duration_s(): number { return this.time_s[this.count]; }

  /** The pose `along` metres after the start of piece i: by the chord, exact for straight pieces too. */
  pose(i: number, along: number): Pose {
    const half = along * this.curvature_per_m[i] / 2;
    const chord = half === 0 ? along : along * Math.sin(half) / half;
    const at = this.h[i] + half;
    return { x: this.x0 + this.x[i] + chord * Math.cos(at), y: this.y0 + this.y[i] + chord * Math.sin(at), h: this.h[i] + 2 * half };
  }

  poseAt(time_s: number): Pose {
    if (this.count === 0) return { x: this.x0, y: this.y0, h: 0 };
    let low = 0;
    for (let high = this.count - 1; low < high;) {
      const middle = (low + high + 1) >> 1;
      if (this.time_s[middle] <= time_s) low = middle; else high = middle - 1;
    }
    const along = Math.min(Math.max((time_s - this.time_s[low]) * this.speed_mps, 0), this.length_m[low]);
    return this.pose(low, along);
  }

  trace(context: CanvasRenderingContext2D, view: Viewport, until_s = Infinity): void {
    if (this.count === 0) return;
    const [px, py] = view.toScreen(this.x0 + this.x[0], this.y0 + this.y[0]);
    context.moveTo(px, py);
    let shown = 0;  // pixels since the last vertex: shorter pieces are drawn together
    for (let i = 0; i < this.count && this.time_s[i] < until_s; ++i) {
      const length = Math.min(this.length_m[i], (until_s - this.time_s[i]) * this.speed_mps);
      const last = i === this.count - 1 || this.time_s[i + 1] >= until_s;
      shown += length * view.scale;
      if (shown < 0.8 && !last) continue;
      shown = 0;
      const turn = length * this.curvature_per_m[i];
      const steps = Math.max(1, Math.ceil(Math.abs(turn) / 0.12));
      for (let k = 1; k <= steps; ++k) {
        const p = this.pose(i, length * k / steps);
        const [qx, qy] = view.toScreen(p.x, p.y);
        context.lineTo(qx, qy);
      }
    }
  }

  /** Times and poses, dense enough for charts. */
  samples(most: number): { t: number; pose: Pose }[] {
    const found: { t: number; pose: Pose }[] = [];
    const step_s = this.duration_s / most;
    let next = 0;
    for (let i = 0; i < this.count; ++i) {
      const dt = this.time_s[i + 1] - this.time_s[i];
      const parts = Math.max(1, Math.ceil(dt / step_s));
      if (this.time_s[i] < next && parts === 1 && i + 1 < this.count) continue;
      for (let k = 0; k < parts; ++k) found.push({ t: this.time_s[i] + dt * k / parts, pose: this.pose(i, this.length_m[i] * k / parts) });
      next = this.time_s[i] + step_s;
    }
    if (this.count > 0) found.push({ t: this.duration_s, pose: this.pose(this.count - 1, this.length_m[this.count - 1]) });
    return found;
  }
}

export interface ShownFlight { record: FlightRecord; line: Line; track: Track; leg: Track | null; leg_line: Line }

export function lineOf(record: PageRecord, outcome: string): Line { return record.styles.outcome[outcome] ?? record.styles.outcome.reach; }

/** Whether a followed flight ends badly. */
function ends(after: FlightRecord["after"]): after is "collide" | "leave" { return after === "collide" || after === "leave"; }

/** The outcome by which a flight is drawn: a followed one that ends badly looks like its end. */
function drawnOutcome({ outcome, after }: FlightRecord): string { return ends(after) ? after : outcome; }

/** "reach", or "reach, then collide" for a followed flight that ends badly. */
export function outcomeWords({ outcome, after }: FlightRecord): string { return ends(after) ? `${outcome}, then ${after}` : outcome; }

export function flightsOf(record: PageRecord, pieces: Record<"x_m" | "y_m" | "heading_rad" | "length_m" | "curvature_per_m", Numbers>): ShownFlight[] {
  const { x0_m, y0_m } = record.grid;
  const track = ([begin, end]: [number, number]) => new Track(
    pieces.x_m.subarray(begin, end), pieces.y_m.subarray(begin, end), pieces.heading_rad.subarray(begin, end),
    pieces.length_m.subarray(begin, end), pieces.curvature_per_m.subarray(begin, end), x0_m, y0_m, record.vehicle.speed_mps);
  return record.flights.map((flight) => ({
    record: flight, line: lineOf(record, drawnOutcome(flight)), track: track(flight.pieces),
    leg: flight.leg ? track(flight.leg.pieces) : null, leg_line: lineOf(record, "reach") }));
}

export function strokeTrack(context: CanvasRenderingContext2D, view: Viewport, track: Track, line: Line, width: number, until_s = Infinity): void {
  context.beginPath();
  track.trace(context, view, until_s);
  context.strokeStyle = line.color;
  context.lineWidth = width;
  context.setLineDash(line.dash);
  context.stroke();
  context.setLineDash([]);
}

/** The vehicle: a dart with its tip forward. */
export function drawVehicle(context: CanvasRenderingContext2D, view: Viewport, pose: Pose, color: string, size = 9): void {
  const [px, py] = view.toScreen(pose.x, pose.y);
  context.save();
  context.translate(px, py);
  context.rotate(-pose.h);
  context.beginPath();
  context.moveTo(size, 0);
  context.lineTo(-0.7 * size, 0.62 * size);
  context.lineTo(-0.35 * size, 0);
  context.lineTo(-0.7 * size, -0.62 * size);
  context.closePath();
  context.fillStyle = color;
  context.strokeStyle = "#fff";
  context.lineWidth = 1.6;
  context.stroke();
  context.fill();
  context.restore();
}
