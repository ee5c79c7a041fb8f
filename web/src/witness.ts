// Behaviours within the contract that fail: those that the page carries, from some of the states at
// risk on its map. Positions are added up from steps, to a few centimetres: enough to look at.
import type { Arrays, Numbers } from "./arrays";
import { Track, type Pose } from "./flights";
import { headingOfCode } from "./overlay";
import type { PageRecord, VerdictInfo } from "./record";

/** A command in force: its heading, and the place whose command it is. */
export interface Command { rad: number; x: number; y: number }

export interface Witness {
  start: Pose;
  end: string;  // the outcome's name
  track: Track;  // a piece for each step
  commands: Command[];  // one for each
}

/** The middle of the cell that a sample stands for, moved as the samples are. */
export function placeOfSample(record: PageRecord, info: VerdictInfo, sample: number): [number, number] {
  const { nx, ny, x0_m, y0_m, cell_m } = record.grid;
  const per = info.cells_per_sample;
  const middle = (block: number, cells: number) => block * per + (Math.min(block * per + per, cells) - block * per >> 1);
  const ix = middle(sample % info.nx, nx), iy = middle(Math.floor(sample / info.nx), ny);
  return [x0_m + (ix + 0.5) * cell_m + info.offset_m[0], y0_m + (iy + 0.5) * cell_m + info.offset_m[1]];
}

const least_drift_m = 1e-9;
const names = ["sample", "heading", "end", "begin", "length_m", "curvature_per_m", "command", "cell"] as const;
type Name = typeof names[number];

export class Witnesses {
  private constructor(private readonly record: PageRecord, private readonly info: VerdictInfo,
    private readonly of: Record<Name, Numbers>) {}

  /** Null when the page has none. */
  static async in(record: PageRecord, arrays: Arrays): Promise<Witnesses | null> {
    const info = record.contract_verdicts;
    if (!info || !arrays.has("witness_begin")) return null;
    const found = await Promise.all(names.map((name) => arrays.array(`witness_${name}`)));
    return new Witnesses(record, info, Object.fromEntries(names.map((name, k) => [name, found[k]])) as Record<Name, Numbers>);
  }

  get count(): number { return this.of.sample.length; }

  private start(k: number): Pose {
    const [x, y] = placeOfSample(this.record, this.info, this.of.sample[k]);
    return { x, y, h: this.info.heading_rad[this.of.heading[k]] };
  }

  /** The one from the state nearest to a pose, where a turn counts as the way round at the turning radius. */
  nearest(pose: Pose): Witness | null {
    const { turn_radius_m } = this.record.vehicle;
    let best = -1, least = Infinity;
    for (let k = 0; k < this.count; ++k) {
      const start = this.start(k);
      const turn = Math.abs(Math.atan2(Math.sin(start.h - pose.h), Math.cos(start.h - pose.h)));
      const apart = Math.hypot(start.x - pose.x, start.y - pose.y) + turn * turn_radius_m;
      if (apart < least - least_drift_m) [best, least] = [k, apart];
    }
    return best < 0 ? null : this.at(best);
  }

  at(k: number): Witness {
    const { record, of } = this;
    const { nx, x0_m, y0_m, cell_m } = record.grid;
    const start = this.start(k);
    const begin = of.begin[k], count = of.begin[k + 1] - begin;
    const column = () => new Float64Array(count);
    const [x, y, h, length, curvature] = [column(), column(), column(), column(), column()];
    const commands: Command[] = [];
    const track = new Track(x, y, h, length, curvature, 0, 0, record.vehicle.speed_mps);
    let pose = start;
    for (let i = 0; i < count; ++i) {
      [x[i], y[i], h[i]] = [pose.x, pose.y, pose.h];
      [length[i], curvature[i]] = [of.length_m[begin + i], of.curvature_per_m[begin + i]];
      // The place of the cell nearest to the vehicle: that is why its command may be in force.
      const left = x0_m + of.cell[begin + i] % nx * cell_m, low = y0_m + Math.floor(of.cell[begin + i] / nx) * cell_m;
      const within = (value: number, least: number) => Math.min(Math.max(value, least), least + cell_m);
      commands.push({ rad: headingOfCode(of.command[begin + i]), x: within(pose.x, left), y: within(pose.y, low) });
      pose = track.pose(i, length[i]);
      track.time_s[i + 1] = track.time_s[i] + length[i] / record.vehicle.speed_mps;
    }
    return { start, end: record.styles.verdict[of.end[k]].name, track, commands };
  }
}
