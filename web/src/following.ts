// Flights along the line that is proved to be followed: how far from it, at which station.
import type { ShownFlight } from "./flights";
import type { Following, PageRecord } from "./record";

const stations = 600;  // of a chart
const run = 16;  // pieces of the line in one box

interface Near { station_m: number; distance_m: number }

/** The nearest point of the line, through boxes about runs of its pieces. */
class FollowedLine {
  readonly length_m: number;
  private readonly x: number[];
  private readonly y: number[];
  private readonly station_m: number[] = [0];
  private readonly boxes: [number, number, number, number][] = [];

  constructor({ line_m, closed }: { line_m: [number, number][]; closed: boolean }) {
    const places = closed ? [...line_m, line_m[0]] : line_m;
    this.x = places.map(([x]) => x);
    this.y = places.map(([, y]) => y);
    for (let k = 1; k < places.length; ++k) this.station_m.push(this.station_m[k - 1] + Math.hypot(this.x[k] - this.x[k - 1], this.y[k] - this.y[k - 1]));
    this.length_m = this.station_m[places.length - 1];
    for (let k = 0; k + 1 < places.length; k += run) {
      const [xs, ys] = [this.x, this.y].map((all) => all.slice(k, k + run + 1));
      this.boxes.push([Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)]);
    }
  }

  nearest(px: number, py: number): Near {
    let least = Infinity, station_m = 0;  // squared
    const { x, y } = this;
    this.boxes.forEach(([left, right, low, high], box) => {
      const out_x = Math.max(left - px, 0, px - right), out_y = Math.max(low - py, 0, py - high);
      if (out_x * out_x + out_y * out_y >= least) return;
      for (let k = box * run; k < Math.min(box * run + run, x.length - 1); ++k) {
        const dx = x[k + 1] - x[k], dy = y[k + 1] - y[k];
        const squared = dx * dx + dy * dy;
        const t = squared === 0 ? 0 : Math.min(Math.max(((px - x[k]) * dx + (py - y[k]) * dy) / squared, 0), 1);
        const apart = (px - x[k] - t * dx) ** 2 + (py - y[k] - t * dy) ** 2;
        if (apart >= least) continue;
        least = apart;
        station_m = this.station_m[k] + t * Math.sqrt(squared);
      }
    });
    return { station_m, distance_m: Math.sqrt(least) };
  }
}

/** A flight's last lap, or if it flies less, all since it first came within the tube. */
export interface Lap {
  distance_m: (number | null)[];  // [station]: the largest there
  time_s: number | null;  // of a whole lap
}

export class FollowedPath {
  readonly proved: Following;
  readonly station_m: number[];  // of the chart
  readonly tube_m: number[];
  private readonly line: FollowedLine;
  private readonly closed: boolean;
  private readonly laps = new Map<ShownFlight, Lap | null>();

  constructor(record: PageRecord) {
    this.proved = record.summary.contract.follow;
    this.closed = record.follow!.closed;
    this.line = new FollowedLine(record.follow!);
    this.station_m = Array.from({ length: stations }, (_, k) => (k + 0.5) / stations * this.line.length_m);
    this.tube_m = this.station_m.map((s) => this.tubeAt(s));
  }

  private tubeAt(station_m: number): number {
    const { profile } = this.proved;
    return profile[Math.min(profile.length - 1, Math.floor(station_m / this.line.length_m * profile.length))].distance_m;
  }

  /** None: it never comes within the tube. */
  lapOf(flight: ShownFlight): Lap | null {
    let lap = this.laps.get(flight);
    if (lap === undefined) this.laps.set(flight, lap = this.measure(flight));
    return lap;
  }

  private measure({ record, track }: ShownFlight): Lap | null {
    if (!record.after) return null;  // not flown beyond where it touches the path
    const { length_m } = this.line;
    const flown: (Near & { t: number; progress_m: number })[] = [];
    for (const { t, pose } of track.samples(Math.ceil(track.duration_s * track.speed_mps / length_m * 2 * stations))) {
      const near = this.line.nearest(pose.x, pose.y);
      const last = flown[flown.length - 1];
      if (!last) {
        if (near.distance_m <= this.tubeAt(near.station_m)) flown.push({ ...near, t, progress_m: 0 });
        continue;
      }
      if (!this.closed && near.station_m >= length_m) break;  // past its end
      let moved = near.station_m - last.station_m;
      if (this.closed) moved -= length_m * Math.round(moved / length_m);
      flown.push({ ...near, t, progress_m: last.progress_m + moved });
    }
    if (flown.length === 0) return null;
    const end = flown[flown.length - 1];
    let begin = flown.length - 1;
    while (begin > 0 && end.progress_m - flown[begin].progress_m < length_m) --begin;
    const whole = this.closed && end.progress_m - flown[begin].progress_m >= length_m;
    const distance_m: (number | null)[] = new Array(stations).fill(null);
    for (const { station_m, distance_m: apart } of flown.slice(begin)) {
      const k = Math.min(stations - 1, Math.floor(station_m / length_m * stations));
      distance_m[k] = Math.max(distance_m[k] ?? 0, apart);
    }
    return { distance_m, time_s: whole ? end.t - flown[begin].t : null };
  }
}
