// What the plan and the certificate say about the place under the cross.
import { byId, el, headingWords, short, term } from "./dom";
import { bearingWords, earthWords } from "./earth";
import type { Served } from "./modes";
import { headingOfCode, type FieldArrays } from "./overlay";
import { modeWords, no_value, RegionCode, sampleIndex, valueIndex, verdictWords, type PageRecord, type VerdictInfo } from "./record";

const region_names = ["buffer", "safe start", "obstacle", "goal"];

/** What a vehicle's verdicts say at a heading, once their layer is inflated, and for how many headings each sample reaches. */
export interface ReadVerdicts { info: VerdictInfo; codes: Uint8Array; heading_rad: number; reaching: Uint16Array | null; whose: string; reach: string }

/** Which mode serves the state, of a plan with several; null: none is proved to reach. */
export interface ReadMode { served: Served | null; heading_rad: number }

type Cell = [number, number];

export function cellAt(record: PageRecord, place: [number, number]): Cell | null {
  const { nx, ny, x0_m, y0_m, cell_m } = record.grid;
  const cell: Cell = [Math.floor((place[0] - x0_m) / cell_m), Math.floor((place[1] - y0_m) / cell_m)];
  return cell[0] >= 0 && cell[0] < nx && cell[1] >= 0 && cell[1] < ny ? cell : null;
}

function verdictTerms(record: PageRecord, cell: Cell, { info, codes, heading_rad, reaching, whose, reach: word }: ReadVerdicts): HTMLElement[] {
  const sample = sampleIndex(info, cell);
  const code = codes[sample];
  if (code === record.codes.obstacle || code === record.codes.target) return [];
  const name = `verdict at ${headingWords(heading_rad)}${whose}`;
  const reach = reaching ? `${reaching[sample]} of ${info.heading_rad.length}` : "";
  if (whose) return [wide(term(name, verdictWords(record, code, word), ...(reach ? [el("small", {}, `, ${word} at ${reach} headings`)] : [])))];
  return [term(name, verdictWords(record, code, word)), ...(reach ? [term(`headings that ${word}`, reach)] : [])];
}

function modeTerms(record: PageRecord, { served, heading_rad }: ReadMode): HTMLElement[] {
  const command = served?.heading_rad ?? null;
  const commands = command === null ? "" : `, commands ${Number.isNaN(command) ? "nothing: straight on" : bearingWords(record, command)}`;
  return [wide(term(`mode at ${headingWords(heading_rad)}`, served ? modeWords(record, served.mode) + commands : record.styles.no_mode!.words))];
}

function wide(element: HTMLElement): HTMLElement {
  element.className = "wide";
  return element;
}

export function showReadout(record: PageRecord, field: FieldArrays, place: [number, number] | null, verdicts: ReadVerdicts[], mode: ReadMode | null = null): void {
  const cell = place && cellAt(record, place);
  if (!place || !cell) {
    byId("readout").replaceChildren(term("place", "point at the map to read values"));
    return;
  }
  const { region, heading, cost } = field;
  const i = valueIndex(record, ...cell);
  const per = record.values.cells_per_value;
  const earth = earthWords(record, place);
  const open = region[i] === RegionCode.free || region[i] === RegionCode.buffer;
  const cut_off = open && cost[i] === no_value;
  const commanded = heading[i] !== no_value && region[i] !== RegionCode.obstacle;
  byId("readout").replaceChildren(
    term("x, y", `${short(place[0])}, ${short(place[1])} m`),
    ...(earth ? [wide(term("latitude, longitude", earth))] : []), term("cell", cell.join(", ")),
    term("region", cut_off ? `${region[i] === RegionCode.free ? "free" : "buffer"}, but cut off from the goal: ${commanded ? "the command leads to a circle on which to wait" : "no command"}` : region_names[region[i]]),
    term("cost to go", cost[i] === no_value ? "none" : `${short(cost[i] * record.cost_step_m)} m`),
    term("commanded heading", commanded ? bearingWords(record, headingOfCode(heading[i])) : open ? "none: straight on" : "none"),
    // Where the mission is out of reach, who is safe holds.
    ...verdicts.flatMap((its) => verdictTerms(record, cell, cut_off ? { ...its, reach: "hold" } : its)),
    ...(mode && open ? modeTerms(record, mode) : []),
    ...(per > 1 ? [term("values", `of one cell in ${per} × ${per}`)] : []));
}
