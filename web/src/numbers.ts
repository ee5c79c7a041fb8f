// What was found, in words and figures: facts, volumes, assumptions, digests.
import { byId, el, fitted, grouped, percent, short, term } from "./dom";
import { wordRows } from "./key_words";
import type { Tiles } from "./layers";
import { withRisk, type Choke, type Finding, type PageRecord } from "./record";
import { verdictNames } from "./whose";

function missionWords(record: PageRecord): string {
  const { mission } = record;
  if (mission.kind === "goal") return `to (${mission.goal_m.map(short).join(", ")})`;
  return `along a ${mission.closed ? "closed path" : "path"} of ${mission.vertices_m.length} vertices`;
}

export function showTitle(record: PageRecord): void {
  const { grid, vehicle } = record;
  byId("title").textContent = record.title;
  byId("subtitle").textContent = `${grid.nx} × ${grid.ny} cells of ${short(grid.cell_m)} m · ${short(vehicle.speed_mps)} m/s · ` +
    `turning radius ${short(vehicle.turn_radius_m)} m · ${missionWords(record)}`;
}

/** What the user must not miss, first of all. */
export function showWarnings(record: PageRecord): void {
  const warnings: string[] = record.summary.warnings ?? [];
  byId("warnings").replaceChildren(...warnings.map((warning) => el("li", {}, warning)));
  byId("warnings").hidden = warnings.length === 0;
}

/** The run's closing findings, in their order: all states first, then what stands in the way; those under a contract in a row of their own. */
export function showFacts(record: PageRecord): void {
  const { verify, contract } = record.summary;
  const under: Finding[] = contract?.findings ?? [];
  const same = (a: Finding, b: Finding) => a.share === b.share && a.of === b.of && a.what === b.what;
  const findings: Finding[] = (record.summary.findings ?? []).filter((finding: Finding) => !under.some((other) => same(finding, other)));
  byId("facts").replaceChildren(...factTerms(findings, verify?.worst_time_s ?? 0));
  if (under.length === 0) return;
  byId("contract-facts").replaceChildren(...factTerms(under, contract.worst_time_s ?? 0));
  const { rows } = verdictNames(record);
  byId("facts-h").textContent = rows[0];
  byId("contract-facts-h").textContent = rows[1];
  for (const id of ["facts-h", "contract-facts-h", "contract-facts"]) byId(id).hidden = false;
}

function factTerms(findings: Finding[], bound_s: number): HTMLElement[] {
  const facts = findings.map(({ share, of, what }) =>
    share ? term(`of ${of} ${what}`, share) : term("what ended the proof", el("small", {}, what)));
  if (bound_s > 0) facts.push(term("longest bound on the time to reach, sampled", bound_s.toFixed(1), el("small", {}, " s")));
  return facts;
}

/** The places that what is unproved under the contract waits for; `visit` shows one on the map. */
export function showChokes(record: PageRecord, visit: (x: number, y: number) => void): void {
  const chokes: Choke[] = record.summary.contract?.chokes ?? [];
  byId("chokes-section").hidden = chokes.length === 0;
  if (chokes.length === 0) return;
  byId("chokes-words").textContent = `${verdictNames(record).after.replace(/^./, (c) => c.toUpperCase())}, states that are not proved wait for few places: a behaviour that comes there may end in more than one way, ` +
    `or cannot be shown to move on. More room there${record.exact_contract ? "" : ", or a tighter contract,"} proves them all. ${chokes.length === 1 ? "This is the one" : `These are the ${chokes.length}`} that cost most, with the share of all states that wait for each; press one to go there.`;
  const rows = chokes.map(({ x_m, y_m, reason, share }, k) => {
    const go = el("button", { type: "button" }, `(${short(x_m)}, ${short(y_m)})`);
    go.addEventListener("click", () => visit(x_m, y_m));
    return el("tr", {}, el("td", { class: "num" }, String(k + 1)), el("td", { class: "num" }, percent(share, 2)), el("td", {}, go), el("td", {}, reason));
  });
  byId("chokes").replaceChildren(el("table", { "aria-label": "Chokes" },
    el("thead", {}, el("tr", {}, el("th", { class: "num" }, ""), el("th", { class: "num" }, "share of all states"), el("th", {}, "place, m"), el("th", {}, "why"))), el("tbody", {}, ...rows)));
}

export function showWords(record: PageRecord): void {
  byId("words").replaceChildren(...record.words.map((words) => el("p", {}, words)));
}

const or_at_risk = "undecided or at risk";

/** A bar for each region of states: verdicts by their share of volume. */
export function showVolumes(record: PageRecord, tiles: Tiles): void {
  const verify = record.summary.verify ?? {};
  const { contract } = record.summary;
  const { codes } = record;
  const names = verdictNames(record);
  const reach = record.styles.verdict[codes.reach].name;
  const rows: [string, Record<string, number>][] = [];
  const add = (name: string, key: string, at_risk?: number | null) => {
    const named = (shares: Record<string, number>, word: string) => Object.fromEntries(Object.entries(shares).map(([key, value]) => [key === reach ? word : key, value]));
    if (verify[key]) rows.push([name, named(verify[key], names.reach[0])]);
    if (!contract?.[key]) return;
    const share = named(contract[key], names.reach[1]);
    if (at_risk !== null && at_risk !== undefined && codes.at_risk) {
      share[record.styles.at_risk!.name] = at_risk;
      share.undecided = Math.max(0, share.undecided - at_risk);
    } else if (codes.at_risk && share.undecided) {
      share[or_at_risk] = share.undecided;  // how many of these are at risk was not counted
    }
    rows.push([`${name}, ${names.after}`, share]);
  };
  add("All states", "volume_fraction", contract?.at_risk);
  add("States that the mission can use", "volume_fraction_usable");
  add("Safe starts", "volume_fraction_free", contract?.at_risk_free);
  if (verify.volume_fraction) add("Safe starts with a command", "volume_fraction_free_commanded");
  if (verify.volume_fraction) add("Buffer around obstacles", "volume_fraction_buffer");
  const { undecided } = codes;
  // Shares of states that follow stand where those that reach do.
  const order = withRisk(codes, record.contract_verdicts, codes.order.filter((v) => v === codes.reach || !names.reach.includes(record.styles.verdict[v].name)));
  const nameOf = (code: number): string => (code === codes.at_risk ? record.styles.at_risk! : record.styles.verdict[code]).name;
  const paints: (() => void)[] = [];
  byId("volumes").replaceChildren(...rows.map(([name, share]) => {
    const word = (v: number): string => v === codes.reach ? names.reach.find((it) => it in share)! : v === undecided && or_at_risk in share ? or_at_risk : nameOf(v);
    const of = (v: number): number => share[word(v)] ?? 0;
    const words = order.filter((v) => of(v) > 0).map((v) => `${percent(of(v))} ${word(v)}`);
    const canvas = el("canvas", { role: "img", "aria-label": `${name}: ${words.join(", ")}` });
    paints.push(() => {
      fitted(canvas);
      const image = new ImageData(canvas.width, canvas.height);
      const out = new Uint32Array(image.data.buffer);
      const { size, pixels } = tiles;
      let from = 0, sum = 0;
      for (const v of order) {
        sum += of(v);
        const to = v === undecided ? canvas.width : Math.round(sum * canvas.width);
        for (let x = from; x < to; ++x) {
          for (let y = 0; y < canvas.height; ++y) out[y * canvas.width + x] = pixels[v * size * size + y % size * size + x % size];
        }
        from = Math.max(from, to);
      }
      canvas.getContext("2d")!.putImageData(image, 0, 0);
    });
    return el("div", { class: "volume" }, el("b", {}, name), canvas, el("span", {}, words.join(" · ")));
  }));
  paints.forEach((paint) => paint());
}

const shown = [
  "A verdict on the map is that of one sampled state of a cell at one heading. The certificate proves it for exactly that state; a query returns the same answer.",
  "Shares of volume are measured on sampled states, each looked up in the certificate; the certificate itself covers every state.",
  "A flight is computed exactly for the model, but in floating-point arithmetic: it is evidence, not a proof.",
  "Headings are counter-clockwise from east; x is east, y is north, in metres.",
];

export function showTrust(record: PageRecord): void {
  const list = (items: string[]) => el("ul", {}, ...items.map((item) => el("li", {}, item)));
  const verify = record.summary.verify ?? {};
  const checked = verify.method !== "certified" ? "Nothing was proved in this run: no certificate was asked for."
    : verify.checked ? "fairway-check, a separate program that shares no code with the prover, re-proved the certificate."
    : "The certificate was not re-proved by the separate program in this run.";
  const { contract } = record.summary;
  const second = record.follow ? "of following the path" : "under the contract";
  const model = record.exact_contract ? `For following the path, instead of the model: the vehicle obeys its commands within ${contract?.contract?.heading_error_rad ?? 0.001} rad.`
    : "Under the contract, instead of the model: the vehicle keeps its contract at every instant.";
  const under = contract ? [contract.checked ? `It re-proved the certificate ${second}, too.` : `The certificate ${second} was not re-proved in this run.`] : [];
  const following = "A state that follows: it joins the path and stays in the tube about it for ever, or to the end of an open path. The tube and the bounds of the time for a lap are part of the certificate.";
  const risk = record.contract_verdicts ? [...(record.exact_contract ? [] : ["Under the contract a verdict holds for every behaviour that the contract allows."]), ...(record.follow ? [following] : []), `That a state is at risk is proved, too: by a ${record.exact_contract ? "flight" : "behaviour whose every step keeps the contract"}.`] : [];
  byId("trust").replaceChildren(
    el("h3", {}, "What is assumed"), list([...record.assumptions, ...(contract ? [model] : [])]),
    el("h3", {}, "What is shown"), list([...(record.verdicts ? shown : shown.slice(2)), ...risk]),
    el("h3", {}, "Who checked it"), list([checked, ...under]));
}

function digestTable(head: string, rows: [string, string][]): HTMLElement {
  return el("table", {}, el("thead", {}, el("tr", {}, el("th", {}, head), el("th", {}, "SHA-256"))),
    el("tbody", {}, ...rows.map(([name, digest]) => el("tr", {}, el("td", {}, name), el("td", { class: "digest" }, digest)))));
}

/** Options keep their keys in the scenario. */
function optionRows(options: Record<string, Record<string, unknown>>): [string, string][] {
  return Object.entries(options).flatMap(([table, keys]) => Object.entries(keys).map(([key, value]): [string, string] =>
    [`${table}.${key}`, value === null ? "not set" : typeof value === "string" ? value : JSON.stringify(value)]));
}

function valueTable(rows: [string, string][]): HTMLElement {
  return el("table", {}, el("tbody", {}, ...rows.map(([name, value]) => el("tr", {}, el("th", { scope: "row" }, name), el("td", {}, value)))));
}

export function showNumbers(record: PageRecord): void {
  const { summary } = record;
  const fold = (title: string, ...content: Node[]) => el("details", {}, el("summary", {}, title), el("div", {}, ...content));
  const parts: HTMLElement[] = [];
  const regions = summary.region_cells ?? {};
  const verify = { ...(summary.verify ?? {}) };
  for (const key of ["words", "levels", "plan_sha256", "options"]) delete verify[key];
  parts.push(fold("Cells and regions", valueTable(wordRows({ cells: summary.cells, cell_m: summary.cell_m, origin_m: summary.origin_m, ...regions,
    unreachable_free_cells: summary.unreachable_free_cells }))));
  if (summary.random_flights) parts.push(fold("Flights", valueTable(wordRows({ random: summary.random_flights, given: summary.given_flights }))));
  if (Object.keys(verify).length > 0) {
    const levels: any[] = summary.verify.levels ?? [];
    parts.push(fold("Proof", valueTable(wordRows(verify)), ...(levels.length > 0 ? [el("table", {},
      el("thead", {}, el("tr", {}, ...["level", "leaves", "undecided leaves", "undecided volume"].map((name) => el("th", { class: "num" }, name)))),
      el("tbody", {}, ...levels.map((l) => el("tr", {}, ...[l.level, grouped(l.leaves), grouped(l.undecided_leaves), percent(l.undecided_volume, 2)]
        .map((text) => el("td", { class: "num" }, String(text)))))))] : [])));
  }
  parts.push(fold("Every option, by its key in the scenario", valueTable(optionRows(summary.options ?? {}))));
  const digests: HTMLElement[] = [];
  if (summary.inputs) digests.push(digestTable("Input", summary.inputs.map((i: any) => [i.path, i.sha256])));
  if (summary.products) digests.push(digestTable("Product", Object.entries(summary.products)));
  if (summary.verify?.plan_sha256) digests.push(digestTable("Array of the plan", Object.entries(summary.verify.plan_sha256)));
  parts.push(fold("Digests", ...digests));
  byId("numbers").replaceChildren(...parts);
  byId("footer").textContent = `Made by ${summary.program ?? "fairway"}. All data are in this file; nothing was fetched.`;
}
