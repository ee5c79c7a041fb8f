// What the colours and patterns of the map mean.
import { byId, el, grouped, percent, short } from "./dom";
import { paintSample } from "./base_map";
import { share_classes, share_kinds, type Tiles } from "./layers";
import { no_value, type PageRecord } from "./record";

function entries(items: { code: number; name: string; number?: string }[], tiles: Tiles): { list: HTMLElement; paint: () => void } {
  const samples: [HTMLCanvasElement, number][] = [];
  const list = el("ul", {}, ...items.map(({ code, name, number }) => {
    const canvas = el("canvas", { "aria-hidden": "true" });
    samples.push([canvas, code]);
    return el("li", {}, canvas, name, ...(number ? [el("span", { class: "num" }, number)] : []));
  }));
  return { list, paint: () => samples.forEach(([canvas, code]) => paintSample(canvas, tiles, code)) };
}

export function showVerdictLegend(record: PageRecord, tiles: Tiles, heading: number): void {
  const info = record.verdicts!;
  const count = info.count[heading];
  const all = Math.max(1, count.reduce((a, b) => a + b, 0));
  const { order, undecided, obstacle, target } = record.codes;
  const { list, paint } = entries([
    ...order.map((code) => ({ code, name: (code === undecided ? "" : "proved: ") + record.styles.verdict[code].words, number: percent(count[code] / all) })),
    { code: obstacle, name: "obstacle" }, { code: target, name: "goal" }], tiles);
  const per = info.cells_per_sample;
  const each = per === 1 ? "each cell" : `one cell in each block of ${per} × ${per}`;
  byId("legend").replaceChildren(list, el("p", {},
    `One state of ${each}, sampled near the cell's centre, at the slider's heading: ${grouped(all)} states, each looked up in the certificate. ` +
    "Other states of the same cell may differ; the volumes below come from states sampled everywhere."));
  paint();
}

/** The shares at another heading, in the legend that showVerdictLegend made. */
export function updateVerdictLegend(record: PageRecord, heading: number): void {
  const count = record.verdicts!.count[heading];
  const all = Math.max(1, count.reduce((a, b) => a + b, 0));
  const { order } = record.codes;
  document.querySelectorAll("#legend .num").forEach((number, k) => { number.textContent = percent(count[order[k]] / all); });
}

export function showShareLegend(record: PageRecord, tiles: Tiles, kind: number): void {
  const { list, paint } = entries([
    ...share_classes.map((name, code) => ({ code, name })).reverse(),
    { code: 6, name: "obstacle" }, { code: 7, name: "goal" }], tiles);
  byId("legend").replaceChildren(list, el("p", {},
    `Share of the ${record.verdicts!.heading_rad.length} headings at each cell's sample point that is ${share_kinds[kind]}.`));
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
    { code: 2, name: "obstacle" }, { code: 3, name: "goal" }, { code: 4, name: "cut off: no way to the goal, no command" }], tiles);
  byId("legend").replaceChildren(list);
  paint();
}
