// Codes and how they look: every picture of cells is an array of codes and a tile of pixels for
// each code, a ground colour with a pattern on it. Colours and patterns are those of the pictures.
import type { Numbers, Arrays } from "./arrays";
import { isDark } from "./dom";
import { no_value, RegionCode, type PageRecord, type VerdictInfo, type VerdictStyle } from "./record";

export interface CodeLayer {
  codes: Uint8Array;
  nx: number;
  ny: number;
  cells: number;  // of the plan along each axis, for one code
}

interface Look { ground: string; pen?: string; pen_px?: number; rising?: boolean; falling?: boolean; dotted?: boolean }

const period_px = 8;

function rgb(hex: string): [number, number, number] {
  const n = parseInt(hex.slice(1), 16);
  return [n >> 16, n >> 8 & 255, n & 255];
}

/** Tiles of side `size` pixels, [code][y][x], as ImageData holds them on a little-endian machine. */
export class Tiles {
  readonly size: number;
  readonly pixels: Uint32Array;

  constructor(looks: Look[], ratio: number) {
    this.size = Math.round(period_px * ratio);
    const area = this.size * this.size;
    this.pixels = new Uint32Array(looks.length * area);
    looks.forEach((look, code) => this.draw(look, code * area, ratio));
  }

  private draw(look: Look, at: number, ratio: number): void {
    const size = this.size;
    const ground = rgb(look.ground);
    const pen = look.pen ? rgb(look.pen) : ground;
    const half = (look.pen_px ?? 1) * ratio / 2;
    // The share of a pixel that lies within a line along which `along` is constant.
    const cover = (along: number): number => {
      const off = Math.abs((along % size + size) % size - size / 2) / Math.SQRT2;
      return Math.min(Math.max(half + 0.5 - off, 0), 1);
    };
    for (let y = 0; y < size; ++y) {
      for (let x = 0; x < size; ++x) {
        let ink = 0;
        if (look.rising) {
          // Dashes: two to a period on each line.
          const step = ((x - y) % (size / 2) + size / 2) % (size / 2);
          ink = Math.max(ink, !look.dotted || look.falling || step < 2.6 * ratio ? cover(x + y + 0.5) : 0);
        }
        if (look.falling && look.dotted) {
          // Dots: two to a period on each line.
          const step = ((x + y) % (size / 2) + size / 2) % (size / 2);
          ink = Math.max(ink, step < 1.6 * ratio ? cover(x - y + 0.5) : 0);
        } else if (look.falling) {
          ink = Math.max(ink, cover(x - y + 0.5));
        }
        const mix = (k: number) => Math.round(ground[k] + (pen[k] - ground[k]) * ink);
        this.pixels[at + y * size + x] = (0xff000000 | mix(2) << 16 | mix(1) << 8 | mix(0)) >>> 0;
      }
    }
  }
}

export function lookOf(style: VerdictStyle): Look {
  return { ground: style.ground, pen: style.pen, pen_px: 1.3 * style.pen_pt + 0.35, dotted: style.dotted,
    rising: style.rising, falling: style.falling };
}

/** Lighter on a dark page: the pictures' obstacle colour is nearly that of the page. */
const obstacle_in_the_dark = "#6d7782";
export function obstacleColor(record: PageRecord): string { return isDark() ? obstacle_in_the_dark : record.styles.obstacle; }
export function obstacleLook(record: PageRecord): Look { return { ground: obstacleColor(record) }; }
export function goalLook(record: PageRecord): Look {
  const { goal, goal_pattern } = record.styles;
  return { ground: goal, pen: goal_pattern, pen_px: 1.1, rising: true, falling: true };
}
export function bufferLook(record: PageRecord): Look {
  const { buffer, buffer_pattern } = record.styles;
  return { ground: buffer, pen: buffer_pattern, pen_px: 0.8, falling: true };
}
export function unreachableLook(record: PageRecord): Look {
  const { unreachable, unreachable_pattern } = record.styles;
  return { ground: unreachable, pen: unreachable_pattern, pen_px: 0.9, rising: true };
}

/** By the codes of the verdict layers; codes between the verdicts' and the others are unused. */
export function verdictLooks(record: PageRecord): Look[] {
  const looks = record.styles.verdict.map(lookOf);
  if (record.styles.at_risk) looks[record.codes.at_risk!] = lookOf(record.styles.at_risk);
  looks[record.codes.obstacle] = obstacleLook(record);
  looks[record.codes.target] = goalLook(record);
  return looks;
}

/** By the codes of the array `mode`: modes, those that none serves, and cells without states. */
export function modeLooks(record: PageRecord): Look[] {
  const looks = (record.styles.mode ?? []).map(lookOf);
  if (record.styles.no_mode) looks[record.codes.no_mode!] = lookOf(record.styles.no_mode);
  looks[record.codes.obstacle] = obstacleLook(record);
  looks[record.codes.target] = goalLook(record);
  return looks;
}

// Cost: ramp steps of free cells, the same of buffer cells, then obstacle, goal, unreachable.
export function costLooks(record: PageRecord): Look[] {
  const ramp = record.styles.cost_ramp;
  return [...ramp.map((ground) => ({ ground })),
    ...ramp.map((ground) => ({ ground, pen: "#ffffff", pen_px: 0.7, falling: true })),
    obstacleLook(record), goalLook(record), unreachableLook(record)];
}

export function costLayer(record: PageRecord, region: Numbers, cost: Numbers): CodeLayer {
  const steps = record.styles.cost_ramp.length;
  const codes = new Uint8Array(region.length);
  for (let i = 0; i < codes.length; ++i) {
    const ramp = Math.min(steps - 1, Math.floor(cost[i] / (no_value - 1) * steps));
    codes[i] = region[i] === RegionCode.obstacle ? 2 * steps
      : region[i] === RegionCode.goal ? 2 * steps + 1
      : cost[i] === no_value ? 2 * steps + 2
      : region[i] === RegionCode.buffer ? steps + ramp : ramp;
  }
  return { codes, nx: record.values.nx, ny: record.values.ny, cells: record.values.cells_per_value };
}

// Regions: those of the plan, and free cells cut off from the goal.
export function regionLooks(record: PageRecord): Look[] {
  return [bufferLook(record), { ground: record.styles.free }, obstacleLook(record), goalLook(record),
    unreachableLook(record)];
}

export function regionLayer(record: PageRecord, region: Numbers, cost: Numbers): CodeLayer {
  const codes = new Uint8Array(region.length);
  for (let i = 0; i < codes.length; ++i) {
    codes[i] = region[i] === RegionCode.free && cost[i] === no_value ? 4 : region[i];
  }
  return { codes, nx: record.values.nx, ny: record.values.ny, cells: record.values.cells_per_value };
}

export const share_kinds = ["proved to reach", "proved to fail", "undecided", "at risk"] as const;
const at_risk_kind = 3;  // only under a contract, and then not undecided
export const share_classes = ["none", "up to 1/8", "up to 1/2", "up to 7/8", "not quite all", "all"];

// Shares: six classes, then obstacle and goal.
export function shareLooks(record: PageRecord, kind: number): Look[] {
  const shares = record.styles.share[kind === at_risk_kind ? 1 : kind];  // at risk: as what fails
  return [...shares.map((ground) => ({ ground })), obstacleLook(record), goalLook(record)];
}

/** The codes of each of share_kinds. */
export function verdictsOfKind({ codes }: PageRecord, kind: number): number[] {
  return [codes.safe, codes.failing, [codes.undecided], []][kind];
}

/** For how many headings each sample has each verdict, and is at risk. */
export interface HeadingCounts { verdict: Uint8Array; at_risk: Uint8Array | null }

/** For each sample, how many of the headings are of a kind. */
export function headingsOfKind(record: PageRecord, info: VerdictInfo, count: HeadingCounts, kind: number): Uint16Array {
  const samples = info.nx * info.ny;
  const of = new Uint16Array(samples);
  for (const v of verdictsOfKind(record, kind)) {
    for (let i = 0; i < samples; ++i) of[i] += count.verdict[v * samples + i];
  }
  const { at_risk } = count;
  if (at_risk && kind === at_risk_kind) of.set(at_risk);
  if (at_risk && share_kinds[kind] === "undecided") for (let i = 0; i < samples; ++i) of[i] -= at_risk[i];
  return of;
}

function shareLayer(record: PageRecord, info: VerdictInfo, first: Uint8Array, of: Uint16Array): CodeLayer {
  const headings = info.heading_rad.length;
  const { obstacle, target } = record.codes;
  const codes = new Uint8Array(of.length);
  for (let i = 0; i < codes.length; ++i) {
    const n = of[i];
    codes[i] = first[i] === obstacle ? share_classes.length : first[i] === target ? share_classes.length + 1
      : n === 0 ? 0 : n === headings ? 5 : 8 * n <= headings ? 1 : 2 * n <= headings ? 2 : 8 * n <= 7 * headings ? 3 : 4;
  }
  return { codes, nx: info.nx, ny: info.ny, cells: info.cells_per_sample };
}

/** Of each sample, for how many headings it reaches, and pictures of the shares of each kind. */
export interface Shares { reaching: Uint16Array; layers: CodeLayer[] }

/** The verdict layers, inflated when shown, the rest when idle. */
export class VerdictLayers {
  private readonly kept: (Uint8Array | undefined)[];
  private readonly asked: (Promise<Uint8Array> | undefined)[];
  readonly length: number;

  /** `name`: of their array, whose counts are in NAME_count. */
  constructor(private readonly arrays: Arrays, readonly info: VerdictInfo, readonly name = "verdict") {
    this.length = info.heading_rad.length;
    this.kept = new Array(this.length);
    this.asked = new Array(this.length);
  }

  /** The layer if it has been inflated. */
  at(heading: number): Uint8Array | undefined { return this.kept[heading]; }

  ask(heading: number): Promise<Uint8Array> {
    return this.asked[heading] ??= this.arrays.layer(this.name, heading).then((codes) => this.kept[heading] = codes);
  }

  async askAll(): Promise<void> {
    for (let k = 0; k < this.length; ++k) await this.ask(k);
  }

  /** Made when first asked for. */
  shares(record: PageRecord): Promise<Shares> { return this.made_shares ??= this.makeShares(record); }
  private made_shares: Promise<Shares> | undefined;

  private async makeShares(record: PageRecord): Promise<Shares> {
    const { arrays, info, name } = this;
    const at_risk = `${name.replace("verdict", "")}at_risk_count`;
    const [first, verdict, risky] = await Promise.all([this.ask(0), arrays.array(`${name}_count`), arrays.has(at_risk) ? arrays.array(at_risk) : null]);
    const count = { verdict: verdict as Uint8Array, at_risk: risky as Uint8Array | null };
    const of = share_kinds.map((_, kind) => headingsOfKind(record, info, count, kind));
    return { reaching: of[0], layers: of.map((its) => shareLayer(record, info, first, its)) };
  }

  layer(codes: Uint8Array): CodeLayer {
    const { nx, ny, cells_per_sample } = this.info;
    return { codes, nx, ny, cells: cells_per_sample };
  }
}
