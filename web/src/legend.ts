// What the colours and patterns of the map mean.
import { byId, el, grouped, percent, short } from "./dom";
import { paintSample } from "./base_map";
import { share_classes, type Tiles } from "./layers";
import { codesInOrder, countsAt, modeWords, no_value, verdictWords, type PageRecord, type VerdictInfo } from "./record";

function entries(items: { code: number; name: string; numbers?: string[] }[], tiles: Tiles): { list: HTMLElement; paint: () => void } {
  const samples: [HTMLCanvasElement, number][] = [];
  const list = el("ul", {}, ...items.map(({ code, name, numbers }) => {
    const canvas = el("canvas", { "aria-hidden": "true" });
    samples.push([canvas, code]);
    return el("li", {}, canvas, name, ...(numbers ?? []).map((number) => el("span", { class: "num" }, number)));
  }));
  return { list, paint: () => samples.forEach(([canvas, code]) => paintSample(canvas, tiles, code)) };
}

/** Verdicts that the map shows: of one vehicle, or of two side by side. */
export interface ShownVerdict { info: VerdictInfo; heading: number; name: string; reach: string }

const total = (count: number[]): number => Math.max(1, count.reduce((sum, n) => sum + n, 0));

/** The shares of each vehicle at its heading, by code; one that it cannot have is empty. */
function columns(record: PageRecord, shown: ShownVerdict[]): Map<number, string>[] {
  return shown.map(({ info, heading }) => {
    const count = countsAt(record, info, heading);
    const all = total(count);
    return new Map(codesInOrder(record, info).map((code) => [code, percent(count[code] / all)]));
  });
}

/** The last of `shown` has all codes that any has. */
export function showVerdictLegend(record: PageRecord, tiles: Tiles, shown: ShownVerdict[]): void {
  const { info } = shown[shown.length - 1];
  const { obstacle, target } = record.codes;
  const shares = columns(record, shown);
  const reach = [...new Set(shown.map((its) => its.reach))].join(" or ");
  const { list, paint } = entries([
    ...codesInOrder(record, info).map((code) => ({ code, name: verdictWords(record, code, reach), numbers: shares.map((of) => of.get(code) ?? "") })),
    { code: obstacle, name: "obstacle" }, { code: target, name: "goal" }], tiles);
  if (shown.length > 1) list.prepend(el("li", { class: "head" }, ...shown.map(({ name }) => el("span", { class: "num" }, name))));
  const per = info.cells_per_sample;
  const each = per === 1 ? "each cell" : `one cell in each block of ${per} × ${per}`;
  const sampled = shown.length > 1 ? `${shown[1].name.replace(/^./, (c) => c.toUpperCase())}: one state` : "One state";
  byId("legend").replaceChildren(list, el("p", {},
    `${sampled} of ${each}, sampled near the cell's centre, at the slider's heading: ${grouped(total(countsAt(record, info, shown[shown.length - 1].heading)))} states, each looked up in the certificate. ` +
    "Other states of the same cell may differ; the volumes below come from states sampled everywhere." +
    (info.at_risk ? ` At risk: nothing is proved, and a ${record.exact_contract ? "flight" : "behaviour within the contract"} is known that fails. Undecided: no proof, and no such ${record.exact_contract ? "flight" : "behaviour"} was found${info.not_searched ? ` (in ${grouped(info.not_searched)} states, at all headings, none was searched for)` : ""}.` : "")));
  paint();
}

/** The shares at another heading, in the legend that showVerdictLegend made. */
export function updateVerdictLegend(record: PageRecord, shown: ShownVerdict[]): void {
  const shares = columns(record, shown);
  const order = codesInOrder(record, shown[shown.length - 1].info);
  document.querySelectorAll("#legend li:not(.head)").forEach((row, k) => {
    row.querySelectorAll(".num").forEach((number, c) => { number.textContent = shares[c].get(order[k]) ?? ""; });
  });
}

/** The modes that serve a sample at some heading, and how many at this one. */
export function showModeLegend(record: PageRecord, info: VerdictInfo, tiles: Tiles, heading: number): void {
  const { mode, no_mode } = record.styles;
  const { obstacle, target } = record.codes;
  const serving = modesThatServe(info);
  const shares = modeShares(record, info, heading);
  const { list, paint } = entries([
    ...serving.map((code) => ({ code, name: modeWords(record, code), numbers: [shares.get(code)!] })),
    { code: record.codes.no_mode!, name: no_mode!.words, numbers: [shares.get(record.codes.no_mode!)!] },
    { code: obstacle, name: "obstacle" }, { code: target, name: "goal" }], tiles);
  const idle = mode!.length - serving.length;
  byId("legend").replaceChildren(list, el("p", {},
    "The first mode that is proved to bring the vehicle from each cell's sample point at the slider's heading; it flies that one, and changes to earlier ones on the way." +
    (idle > 0 ? ` ${idle === 1 ? "One more mode serves" : `${idle} more modes serve`} no sample, at any heading.` : "") +
    " The arrows of the field are those of the mode that serves the place."));
  paint();
}

/** The shares at another heading, in the legend that showModeLegend made. */
export function updateModeLegend(record: PageRecord, info: VerdictInfo, heading: number): void {
  const shares = modeShares(record, info, heading);
  const codes = [...modesThatServe(info), record.codes.no_mode!];
  document.querySelectorAll("#legend li").forEach((row, k) => {
    row.querySelectorAll(".num").forEach((number) => { number.textContent = shares.get(codes[k]) ?? ""; });
  });
}

function modesThatServe(info: VerdictInfo): number[] {
  const modes = info.mode_count![0].map((_, mode) => mode);
  return modes.filter((mode) => info.mode_count!.some((of) => of[mode] > 0));
}

/** Of all samples at a heading, by mode, and of those that none serves. */
function modeShares(record: PageRecord, info: VerdictInfo, heading: number): Map<number, string> {
  const all = total(info.count[heading]);
  const count = info.mode_count![heading];
  const served = count.reduce((sum, n) => sum + n, 0);
  return new Map([...count.map((n, mode): [number, string] => [mode, percent(n / all)]), [record.codes.no_mode!, percent((all - served) / all)]]);
}

export function showShareLegend(record: PageRecord, info: VerdictInfo, tiles: Tiles, kind: number, words: string): void {
  const hold = record.styles.verdict.findIndex(({ name }) => name === "hold");
  const { list, paint } = entries([
    ...share_classes.map((name, code) => ({ code, name })).reverse(),
    { code: 6, name: "obstacle" }, { code: 7, name: "goal" }], tiles);
  const holds = kind === 0 && info.count.some((of) => hold >= 0 && of[hold] > 0);
  byId("legend").replaceChildren(list, el("p", {},
    `Share of the ${info.heading_rad.length} headings at each cell's sample point that is ${words}${holds ? " or to hold" : ""}.`));
  paint();
}

export function showCostLegend(record: PageRecord, tiles: Tiles): void {
  const steps = record.styles.cost_ramp.length;
  const ramp = el("canvas", { class: "ramp", "aria-hidden": "true" });
  const { list, paint } = entries([
    { code: steps + (steps >> 2), name: "buffer" }, { code: 2 * steps, name: "obstacle" },
    { code: 2 * steps + 1, name: "goal" }, { code: 2 * steps + 2, name: "cut off: no way to the goal" }], tiles);
  byId("legend").replaceChildren(ramp, el("div", { class: "ends" }, el("span", {}, "0 m"), el("span", {}, "cost to go"),
    el("span", {}, `${short(record.cost_step_m * (no_value - 1))} m`)), list);
  ramp.width = steps;
  ramp.height = 1;
  const context = ramp.getContext("2d")!;
  record.styles.cost_ramp.forEach((color, k) => { context.fillStyle = color; context.fillRect(k, 0, 1, 1); });
  paint();
}

export function showRegionLegend(tiles: Tiles): void {
  const { list, paint } = entries([
    { code: 1, name: "safe start: farther than the buffer from obstacles" }, { code: 0, name: "buffer around obstacles" },
    { code: 2, name: "obstacle" }, { code: 3, name: "goal" }, { code: 4, name: "cut off: no way to the goal" }], tiles);
  byId("legend").replaceChildren(list);
  paint();
}
