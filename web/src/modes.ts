// Modes of a plan: which one serves the states at a heading, and what it commands there.
import type { Arrays } from "./arrays";
import { VerdictLayers } from "./layers";
import { nearestHeading, sampleIndex, type PageRecord, type VerdictInfo } from "./record";

const no_command = 255;
const turn_codes = 255;

/** What serves a state: its mode and, of one after the first, its command; NaN: none, straight on. */
export interface Served { mode: number; heading_rad: number | null }

export class Modes {
  /** The modes at each heading. */
  readonly layers: VerdictLayers;
  private readonly commands: (Uint8Array | undefined)[];

  private constructor(private readonly arrays: Arrays, private readonly info: VerdictInfo) {
    this.layers = new VerdictLayers(arrays, info, "mode");
    this.commands = new Array(info.mode_count![0].length);
  }

  /** Null for a plan with one mode. */
  static of(record: PageRecord, arrays: Arrays, info: VerdictInfo | null): Modes | null {
    return record.styles.mode && info?.mode_count && arrays.has("mode") ? new Modes(arrays, info) : null;
  }

  /** Inflates the commands of the modes after the first. */
  async askCommands(): Promise<void> {
    for (let mode = 1; mode < this.commands.length; ++mode) {
      this.commands[mode] ??= await this.arrays.layer("mode_heading", mode - 1);
    }
  }

  /** What serves a cell's sample at an angle; null: nothing is known, or none is proved to reach. */
  at(cell: [number, number], rad: number): Served | null {
    const codes = this.layers.at(nearestHeading(this.info, rad));
    if (!codes) return null;
    const sample = sampleIndex(this.info, cell);
    const mode = codes[sample];
    if (mode >= this.commands.length) return null;
    const command = this.commands[mode]?.[sample];
    const heading_rad = command === undefined ? null : command === no_command ? NaN : command / turn_codes * 2 * Math.PI;
    return { mode, heading_rad };
  }
}
