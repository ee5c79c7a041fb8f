// The page: the record and the arrays it carries, shown as a map with layers, and below it flights,
// the body of states that reach, and what all of it rests on.
import { Arrays } from "./arrays";
import { BaseMap } from "./base_map";
import { byId, el, fitted, grouped, headingWords, pixelRatio, short, term } from "./dom";
import { flightsOf } from "./flights";
import { HeadingSlider } from "./heading";
import { costLayer, costLooks, headingsOfKind, regionLayer, regionLooks, share_kinds, shareLayer, shareLooks, Tiles, VerdictLayers,
  verdictLooks, type CodeLayer } from "./layers";
import { showCostLegend, showRegionLegend, showShareLegend, showVerdictLegend, updateVerdictLegend } from "./legend";
import { connect, type Live } from "./live";
import { showFacts, showNumbers, showTitle, showTrust, showVolumes, showWords } from "./numbers";
import { headingOfCode, Overlay, type GridLines, type LayerChoice } from "./overlay";
import { Code, no_value, recordOfPage, RegionCode, valueIndex, type PageRecord } from "./record";
import { Replay } from "./replay";
import { showSolid } from "./solid";
import { Viewport } from "./viewport";

type View = "verdict" | "share" | "cost" | "region";

const view_names: [View, string][] = [
  ["verdict", "Verdicts at a heading"], ["share", "Share of headings proved"], ["cost", "Cost to go"], ["region", "Regions"]];
const layer_names: [keyof LayerChoice, string][] = [
  ["streamlines", "Field as streamlines"], ["arrows", "Field as arrows"], ["contours", "Cost contours"], ["flights", "Flights"], ["mission", "Mission"]];
const region_names = ["buffer", "safe start", "obstacle", "target"];

async function show(record: PageRecord, arrays: Arrays): Promise<void> {
  const { grid } = record;
  const lines = async (name: string): Promise<GridLines> => ({
    x: await arrays.array(`${name}_x`), y: await arrays.array(`${name}_y`), begin: await arrays.array(`${name}_begin`) });
  const [region, heading, cost, streamlines, contours, contour_level_m] = await Promise.all([
    arrays.array("region"), arrays.array("heading"), arrays.array("cost"), lines("streamline"), lines("contour"), arrays.array("contour_level_m")]);
  const [x_m, y_m, heading_rad, length_m, curvature_per_m] = await Promise.all(
    ["x_m", "y_m", "heading_rad", "length_m", "curvature_per_m"].map((name) => arrays.array(`piece_${name}`)));
  const flights = flightsOf(record, { x_m, y_m, heading_rad, length_m, curvature_per_m });

  const ratio = pixelRatio();
  const tiles = {
    verdict: record.verdicts ? new Tiles(verdictLooks(record), ratio) : null,
    share: record.verdicts ? [0, 1, 2].map((kind) => new Tiles(shareLooks(record, kind), ratio)) : [],
    cost: new Tiles(costLooks(record), ratio),
    region: new Tiles(regionLooks(record), ratio),
  };
  const verdicts = record.verdicts ? new VerdictLayers(arrays, record) : null;
  const layers = { cost: costLayer(record, region, cost), region: regionLayer(record, region, cost), share: [] as CodeLayer[] };
  let count: Uint8Array | null = null;

  const map = byId("map");
  const base = new BaseMap(byId<HTMLCanvasElement>("map-base"), grid);
  const lines_canvas = byId<HTMLCanvasElement>("map-lines");
  const marks_canvas = byId<HTMLCanvasElement>("map-marks");
  const view = new Viewport(grid);
  const overlay = new Overlay(record, { region, heading, cost, streamlines, contours, contour_level_m });
  const choice: LayerChoice = { arrows: false, streamlines: false, contours: false, flights: false, mission: true };
  let shown: View = record.verdicts ? "verdict" : "cost";
  let share_kind = 0;
  let cross: [number, number] | null = null;
  let live: Live | null = null;
  let cut: ((heading: number) => void) | null = null;

  // What changed is drawn in the next frame, once.
  const stale = { base: false, lines: false, marks: false, readout: false };
  let asked = false;
  const redraw = (...parts: (keyof typeof stale)[]) => {
    for (const part of parts) stale[part] = true;
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      if (stale.base) drawBase();
      if (stale.lines) drawLines();
      if (stale.marks) drawMarks();
      if (stale.readout) showReadout();
      stale.base = stale.lines = stale.marks = stale.readout = false;
    });
  };
  const redrawAll = () => redraw("base", "lines", "marks", "readout");

  function drawBase(): void {
    if (shown === "verdict" && verdicts) {
      const codes = verdicts.at(slider.index);
      if (codes) base.paint(verdicts.layer(codes), tiles.verdict!, view);
      else void verdicts.ask(slider.index).then(() => redraw("base", "readout"));
    } else if (shown === "share" && layers.share[share_kind]) {
      base.paint(layers.share[share_kind], tiles.share[share_kind], view);
    } else if (shown === "cost") {
      base.paint(layers.cost, tiles.cost, view);
    } else if (shown === "region") {
      base.paint(layers.region, tiles.region, view);
    }
  }

  function cleared(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
    const context = canvas.getContext("2d")!;
    fitted(canvas, ratio);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    return context;
  }

  function drawLines(): void { overlay.draw(cleared(lines_canvas), view, choice, flights, replay.selected); }

  function drawMarks(): void {
    const context = cleared(marks_canvas);
    if (cross) {
      const [x, y] = view.toScreen(...cross);
      context.strokeStyle = "#22262b";
      context.lineWidth = 1;
      context.beginPath();
      context.moveTo(x - 11, y); context.lineTo(x - 4, y); context.moveTo(x + 4, y); context.lineTo(x + 11, y);
      context.moveTo(x, y - 11); context.lineTo(x, y - 4); context.moveTo(x, y + 4); context.lineTo(x, y + 11);
      context.stroke();
    }
    replay.draw(context, view);
    live?.draw(context, view);
  }

  function showReadout(): void {
    const box = byId("readout");
    const cell = cross && [Math.floor((cross[0] - grid.x0_m) / grid.cell_m), Math.floor((cross[1] - grid.y0_m) / grid.cell_m)];
    if (!cross || !cell || cell[0] < 0 || cell[0] >= grid.nx || cell[1] < 0 || cell[1] >= grid.ny) {
      box.replaceChildren(term("place", "point at the map to read it"));
      return;
    }
    const i = valueIndex(record, cell[0], cell[1]);
    const parts = [term("x, y", `${short(cross[0])}, ${short(cross[1])} m`), term("cell", `${cell[0]}, ${cell[1]}`), term("region", region_names[region[i]]),
      term("cost to go", cost[i] === no_value ? "no way" : `${short(cost[i] * record.cost_step_m)} m`),
      term("commanded heading", heading[i] === no_value || region[i] === RegionCode.obstacle ? "none" : headingWords(headingOfCode(heading[i])))];
    const codes = verdicts?.at(slider.index);
    if (codes && record.verdicts) {
      const info = record.verdicts;
      const sample = Math.floor(cell[1] / info.cells_per_sample) * info.nx + Math.floor(cell[0] / info.cells_per_sample);
      const code = codes[sample];
      if (code < Code.obstacle) {
        const name = record.styles.verdict[code].name;
        parts.push(term(`verdict at ${headingWords(slider.rad)}`, code === Code.undecided ? name : `proved: ${name}`));
        if (count) {
          const reached = headingsOfKind(count.subarray(0), info.nx * info.ny, 0)[sample];
          parts.push(term("headings that reach", `${reached} of ${info.heading_rad.length}`));
        }
      }
    }
    const per = record.values.cells_per_value;
    if (per > 1) parts.push(term("values", `of one cell in ${per} × ${per}`));
    box.replaceChildren(...parts);
  }

  function showLegend(): void {
    if (shown === "verdict" && record.verdicts) showVerdictLegend(record, tiles.verdict!, slider.index);
    if (shown === "share" && record.verdicts) showShareLegend(record, tiles.share[share_kind], share_kind);
    if (shown === "cost") showCostLegend(record, tiles.cost);
    if (shown === "region") showRegionLegend(tiles.region);
    byId("heading").hidden = !record.verdicts;
  }

  async function needCounts(): Promise<void> {
    if (count) return;
    const [first, all] = await Promise.all([verdicts!.ask(0), arrays.array("verdict_count")]);
    count = all as Uint8Array;
    layers.share = [0, 1, 2].map((kind) => shareLayer(record, first, count!, kind));
  }

  const slider: HeadingSlider = new HeadingSlider(record, () => tiles.verdict!, () => {
    redraw("base", "readout");
    if (shown === "verdict") updateVerdictLegend(record, slider.index);
    cut?.(slider.index);
  });
  const replay: Replay = new Replay(record, flights, (what) => {
    if (what === "choice") {
      if (replay.selected >= 0 && !choice.flights) setLayer("flights", true);
      redraw("lines", "marks");
    } else redraw("marks");
  });

  // What to show.
  const shares = el("div", { class: "sub", role: "group", "aria-label": "Which share" });
  share_kinds.forEach((name, kind) => {
    const button = el("button", { type: "button", "aria-pressed": kind === 0 ? "true" : "false" }, name);
    button.addEventListener("click", () => {
      share_kind = kind;
      shares.querySelectorAll("button").forEach((b, k) => b.setAttribute("aria-pressed", String(k === kind)));
      showLegend();
      redraw("base");
    });
    shares.append(button);
  });
  async function setView(next: View): Promise<void> {
    shown = next;
    shares.hidden = next !== "share";
    if (next === "share") await needCounts();
    showLegend();
    redrawAll();
  }
  for (const [name, words] of view_names) {
    if (!record.verdicts && (name === "verdict" || name === "share")) continue;
    const input = el("input", { type: "radio", name: "view", value: name, checked: name === shown });
    input.addEventListener("change", () => void setView(name));
    byId("views").append(el("label", { class: "choice" }, input, words));
    if (name === "share") byId("views").append(shares);
  }
  shares.hidden = true;

  const boxes = new Map<keyof LayerChoice, HTMLInputElement>();
  function setLayer(name: keyof LayerChoice, on: boolean): void {
    choice[name] = on;
    boxes.get(name)!.checked = on;
    redraw("lines");
  }
  choice.streamlines = true;
  for (const [name, words] of layer_names) {
    if (name === "flights" && flights.length === 0) continue;
    const input = el("input", { type: "checkbox", value: name, checked: choice[name] });
    boxes.set(name, input);
    input.addEventListener("change", () => setLayer(name, input.checked));
    byId("layers").append(el("label", { class: "choice" }, input, words,
      ...(name === "flights" ? [el("small", {}, grouped(flights.length))] : [])));
  }

  // Size: as wide as its column, as high as the map needs and the window allows.
  function fit(): void {
    const width = map.clientWidth;
    const wanted = width * grid.ny / grid.nx;
    map.style.height = `${Math.round(Math.max(260, Math.min(wanted, window.innerHeight - 170)))}px`;
    view.resize(width, map.clientHeight);
    redrawAll();
    slider.strip();
  }
  new ResizeObserver(fit).observe(map);
  window.addEventListener("resize", fit);

  // Pointers: one drags, two pinch, a wheel with Ctrl (or once the map has the focus) zooms.
  const pointers = new Map<number, [number, number]>();
  const place = (event: PointerEvent | WheelEvent): [number, number] => {
    const box = map.getBoundingClientRect();
    return [event.clientX - box.left - map.clientLeft, event.clientY - box.top - map.clientTop];
  };
  map.addEventListener("pointerdown", (event) => {
    if ((event.target as HTMLElement).closest(".zoom")) return;
    pointers.set(event.pointerId, place(event));
    cross = view.toWorld(...place(event));
    if (pointers.size === 1 && live?.takes(view.toWorld(...place(event)), view)) {
      map.setPointerCapture(event.pointerId);
    } else if (view.zoomedIn) {
      map.setPointerCapture(event.pointerId);
      map.classList.add("pans");
    }
    redraw("marks", "readout");
  });
  map.addEventListener("pointermove", (event) => {
    const [px, py] = place(event);
    const before = pointers.get(event.pointerId);
    if (!before) {
      if (event.pointerType === "mouse") { cross = view.toWorld(px, py); redraw("marks", "readout"); }
      return;
    }
    if (live?.drags(view.toWorld(px, py), view)) {
      redraw("marks");
      return;
    }
    if (pointers.size === 2) {
      const [other] = [...pointers].filter(([id]) => id !== event.pointerId).map(([, p]) => p);
      const factor = Math.hypot(px - other[0], py - other[1]) / Math.max(1, Math.hypot(before[0] - other[0], before[1] - other[1]));
      view.zoomAt((px + other[0]) / 2, (py + other[1]) / 2, factor);
    } else {
      view.pan(px - before[0], py - before[1]);
    }
    pointers.set(event.pointerId, [px, py]);
    zoomed();
  });
  const release = (event: PointerEvent) => {
    pointers.delete(event.pointerId);
    map.classList.remove("pans");
    live?.releases();
  };
  map.addEventListener("pointerup", release);
  map.addEventListener("pointercancel", release);
  map.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey && document.activeElement !== map) return;
    event.preventDefault();
    view.zoomAt(...place(event), Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0016)));
    zoomed();
  }, { passive: false });
  function zoomed(): void {
    map.style.touchAction = view.zoomedIn || live ? "none" : "pan-y";
    redrawAll();
  }
  const zoomMiddle = (factor: number) => {
    const at = cross ? view.toScreen(...cross) : [view.width / 2, view.height / 2] as [number, number];
    view.zoomAt(at[0], at[1], factor);
    zoomed();
  };
  byId("zoom-in").addEventListener("click", () => { cross = null; zoomMiddle(1.6); });
  byId("zoom-out").addEventListener("click", () => { cross = null; zoomMiddle(1 / 1.6); });
  byId("zoom-fit").addEventListener("click", () => { view.fit(); zoomed(); });

  map.addEventListener("keydown", (event) => {
    if (event.target !== map) return;
    const step = (event.shiftKey ? 10 : 1) * Math.max(grid.cell_m, 3 / view.scale);
    const moves: Record<string, [number, number]> = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    const move = moves[event.key];
    if (move) {
      const from = cross ?? view.toWorld(view.width / 2, view.height / 2);
      const width_m = grid.nx * grid.cell_m, height_m = grid.ny * grid.cell_m;
      cross = [Math.min(Math.max(from[0] + move[0], grid.x0_m + 1e-6 * width_m), grid.x0_m + width_m * (1 - 1e-6)),
        Math.min(Math.max(from[1] + move[1], grid.y0_m + 1e-6 * height_m), grid.y0_m + height_m * (1 - 1e-6))];
      view.show(...cross);
      redrawAll();
    } else if (event.key === "+" || event.key === "=") zoomMiddle(1.4);
    else if (event.key === "-") zoomMiddle(1 / 1.4);
    else if (event.key === "0") { view.fit(); zoomed(); }
    else if (event.key === "[") slider.turnBy(-1);
    else if (event.key === "]") slider.turnBy(1);
    else if (event.key === "Enter" && live && cross) live.flyFrom(cross, slider.rad);
    else return;
    event.preventDefault();
  });

  showTitle(record);
  showFacts(record);
  showWords(record);
  showTrust(record);
  showNumbers(record);
  if (verdicts) await verdicts.ask(0);
  fit();
  await setView(shown);
  slider.show();
  if (tiles.verdict) showVolumes(record, tiles.verdict);
  zoomed();
  document.documentElement.dataset.ready = String(Math.round(performance.now()));

  // The rest, while nobody waits for it.
  if (verdicts) {
    await needCounts();
    void verdicts.askAll();
    cut = showSolid(record, verdicts);
  } else {
    byId("solid-section").hidden = true;
  }
  live = await connect(record, { redraw: () => redraw("marks"), heading: () => slider.rad, turnTo: (rad) => slider.turnToRad(rad) });
  if (live) {
    byId("live-keys").hidden = false;
    zoomed();
  }
}

function fail(error: unknown): void {
  const trouble = byId("trouble");
  trouble.textContent = `This page could not be shown: ${error instanceof Error ? error.message : String(error)}.`;
  trouble.hidden = false;
  console.error(error);
}

try {
  show(recordOfPage(), new Arrays(byId("arrays").textContent!)).catch(fail);
} catch (error) {
  fail(error);
}
