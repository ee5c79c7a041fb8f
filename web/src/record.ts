// What the page knows about a run, as fairway/report/page.cpp writes it.

export interface GridShape { nx: number; ny: number; x0_m: number; y0_m: number; cell_m: number }

export interface VerdictStyle {
  name: string; words: string; ground: string; pen: string; pen_pt: number; dotted: boolean; rising: boolean; falling: boolean;
}

export interface Line { color: string; dash: number[] }

/** Codes of the array `verdict`: those of verdicts, and those of cells without states. */
export interface Codes {
  reach: number;
  failing: number[];
  safe: number[];  // what is proved to reach, or at least to be safe for ever
  seldom: number[];  // listed only where a state has them
  undecided: number;
  order: number[];  // in which verdicts are listed, undecided the last
  obstacle: number;
  target: number;
  at_risk?: number;  // undecided, and a behaviour within the contract is known that fails
  no_mode?: number;  // of the array `mode`: none is proved to reach
}

/** A line of the findings: "97.0 %" of "free cells" "are cut off"; without a share, a sentence. */
export interface Finding { share: string; of: string; what: string }

export interface FlightRecord {
  group: string;
  ground?: "safe_start" | "buffer" | "cut_off";  // of failing ones: where they start
  after?: "follow" | "hold" | "collide" | "leave";  // on a path: what a followed flight does after it reaches
  outcome: string;
  time_s: number | null;
  length_m: number | null;
  start: [number, number, number];
  pieces: [number, number];
  leg?: { state: string; pieces: [number, number] };
}

export type Mission =
  | { kind: "goal"; goal_m: [number, number]; goal_heading_rad: number | null }
  | { kind: "path"; closed: boolean; vertices_m: [number, number][] };

export interface VerdictInfo {
  nx: number;
  ny: number;
  cells_per_sample: number;
  heading_rad: number[];
  offset_m: [number, number];
  count: number[][];  // [heading][code]
  mode_count?: number[][];  // [heading][mode]: how many samples it serves; only of a plan with several
  at_risk?: number[];  // [heading]: of the undecided ones; only under a contract, where witnesses were searched for
  not_searched?: number;  // undecided states where none was, at all headings
}

export interface PageRecord {
  format_version: number;
  title: string;
  grid: GridShape;
  /** The grid's turn against its map's world, and degrees at across * across places over the grid, [row][column]. */
  frame: { yaw_rad: number; earth: { across: number; lat_deg: number[]; lon_deg: number[] } | null };
  values: { nx: number; ny: number; cells_per_value: number };  // the cells that the plan's arrays sample
  vehicle: { speed_mps: number; turn_radius_m: number };
  mission: Mission;
  cost_step_m: number;
  styles: {
    verdict: VerdictStyle[];  // [code]
    at_risk?: VerdictStyle;
    mode?: VerdictStyle[];  // of a plan with several modes, the plan's own first
    no_mode?: VerdictStyle;
    outcome: Record<string, Line>;  // by the outcome's name
    cost_ramp: string[];
    share: string[][];
    series: string[];
    obstacle: string; buffer: string; buffer_pattern: string; free: string;
    goal: string; goal_pattern: string; unreachable: string; unreachable_pattern: string;
  };
  codes: Codes;
  verdicts: VerdictInfo | null;
  contract_verdicts?: VerdictInfo;  // under the vehicle's contract, where it has one, or of following a path
  exact_contract?: boolean;  // contract_verdicts: the contract allows hardly more than the exact vehicle
  follow?: { line_m: [number, number][]; closed: boolean };  // the line that contract_verdicts prove to be followed
  flights: FlightRecord[];
  flights_left_out: Record<string, number>;
  words: string[];
  assumptions: string[];  // of every proof
  summary: Record<string, any>;
}

/** What is proved of those that follow the path: `profile` in equal stretches of its length. */
export interface Following {
  tube_m: number;
  length_m: number;
  lap_time_s: [number, number];  // of an open path: 0, and the longest time to its end
  profile: { station_m: number; distance_m: number; heading_rad: number }[];
}

/** A place that undecided states under the contract wait for. */
export interface Choke { x_m: number; y_m: number; cell: [number, number]; reason: string; share: number }

/** Codes in the order in which their verdicts are listed, undecided the last. */
export function codesInOrder({ codes }: PageRecord, info: VerdictInfo): number[] {
  return withRisk(codes, info, codes.order.filter((code) => !codes.seldom.includes(code) || info.count.some((of) => of[code] > 0)));
}

/** With those at risk before the undecided ones, where they are known. */
export function withRisk(codes: Codes, info: VerdictInfo | undefined, order: number[]): number[] {
  if (!info?.at_risk) return order;
  return [...order.filter((code) => code !== codes.undecided), codes.at_risk!, codes.undecided];
}

/** How many samples have each code at a heading: at risk, or undecided, but not both. */
export function countsAt({ codes }: PageRecord, info: VerdictInfo, heading: number): number[] {
  const count = [...info.count[heading]];
  if (info.at_risk) {
    count[codes.undecided] -= info.at_risk[heading];
    count[codes.at_risk!] = info.at_risk[heading];
  }
  return count;
}

/** The heading of `info` nearest to an angle. */
export function nearestHeading(info: VerdictInfo, rad: number): number {
  const n = info.heading_rad.length;
  return (Math.round(rad / (2 * Math.PI) * n) % n + n) % n;
}

/** Index of a cell's sample. */
export function sampleIndex(info: VerdictInfo, [ix, iy]: [number, number]): number {
  return Math.floor(iy / info.cells_per_sample) * info.nx + Math.floor(ix / info.cells_per_sample);
}

/** "proved: reach", "at risk", "undecided"; `reach`: what reaching is called. */
export function verdictWords(record: PageRecord, code: number, reach: string): string {
  const { codes, styles } = record;
  if (code === codes.at_risk) return styles.at_risk!.words;
  return (code === codes.undecided ? "" : "proved: ") + (code === codes.reach ? reach : styles.verdict[code].words);
}

/** "mode 3: on towards 90 degrees"; a goal moved on the page may have made more modes than the run. */
export function modeWords({ styles }: PageRecord, mode: number): string {
  return styles.mode?.[mode]?.words ?? `mode ${mode}`;
}

/** Codes of the array `region`: those of a plan file plus 1. */
export const enum RegionCode { buffer = 0, free = 1, obstacle = 2, goal = 3 }

/** Index of a cell's values in the plan's arrays. */
export function valueIndex(record: PageRecord, ix: number, iy: number): number {
  const { nx, cells_per_value } = record.values;
  return Math.floor(iy / cells_per_value) * nx + Math.floor(ix / cells_per_value);
}

export const no_value = 65535;

export function recordOfPage(): PageRecord {
  const record = JSON.parse(document.getElementById("record")!.textContent!) as PageRecord;
  if (record.format_version !== 2) throw new Error(`this page's data has format ${record.format_version}, not 2`);
  return record;
}
