// The map: cells as one of four views, lines and marks on top, and the readout under the cross.
import type { Arrays } from "./arrays";
import { BaseMap } from "./base_map";
import { checkBox, oneOf, radios } from "./choices";
import { byId, el, fitted, grouped, headingWords, isPrinting, pixelRatio, turnOf, wind } from "./dom";
import type { ShownFlight } from "./flights";
import { bearingWords } from "./earth";
import { HeadingSlider } from "./heading";
import { costLayer, costLooks, modeLooks, regionLayer, regionLooks, share_kinds, shareLooks, Tiles, VerdictLayers, verdictLooks, type CodeLayer, type Shares } from "./layers";
import { showCostLegend, showModeLegend, showRegionLegend, showShareLegend, showVerdictLegend, updateModeLegend, updateVerdictLegend, type ShownVerdict } from "./legend";
import type { Live } from "./live";
import { MapInput, type MapHands } from "./map_input";
import { mapSize, placeExplained, placeTable, wide_window } from "./map_size";
import { drawChokes, Overlay, type FieldArrays, type LayerChoice } from "./overlay";
import { Modes } from "./modes";
import { cellAt, showReadout, type ReadMode, type ReadVerdicts } from "./readout";
import { nearestHeading, sampleIndex, type Choke, type PageRecord, type VerdictInfo } from "./record";
import type { MovedPlan, PlanView } from "./moved_goal";
import { linkable, writeLink, type LinkedState } from "./state_link";
import { Replay } from "./replay";
import { Viewport } from "./viewport";
import { reachWord, verdictNames, type VerdictNames, type Whose } from "./whose";
import { Witnesses, type Witness } from "./witness";
import { poseWords, WitnessPlay } from "./witness_play";

type View = "verdict" | "mode" | "share" | "cost" | "region";
type Part = "base" | "lines" | "marks" | "readout";

const view_names: [View, string][] = [
  ["verdict", "Verdicts at a heading"], ["mode", "Modes at a heading"], ["share", "Share of headings proved"], ["cost", "Cost to go"], ["region", "Regions"]];
const layer_names: [keyof LayerChoice, string][] = [
  ["streamlines", "Field (streamlines)"], ["arrows", "Field (arrows)"], ["contours", "Cost contours"], ["tube", "Proved tube"], ["flights", "Flights"], ["chokes", "Chokes"], ["mission", "Mission"]];

/** What is set aside while another plan is shown. */
interface Own { moved: MovedPlan; info: VerdictInfo | null; verdicts: VerdictLayers | null; modes: Modes | null; arrays: Arrays; shown: View; flights: boolean }

export class MapPage implements MapHands, PlanView {
  readonly grid;
  readonly view: Viewport;
  readonly slider: HeadingSlider;
  verdicts: VerdictLayers | null;
  verdict_tiles!: Tiles;
  cross: [number, number] | null = null;
  /** Called when the heading changes. */
  turned: (heading: number) => void = () => {};

  private readonly map = byId("map");
  private readonly base: BaseMap;
  private readonly beside: BaseMap;
  private readonly overlay: Overlay;
  private readonly input: MapInput;
  private readonly replay: Replay;
  private readonly choice: LayerChoice = { arrows: false, streamlines: true, contours: false, flights: false, chokes: true, tube: true, mission: true };
  private readonly boxes = new Map<keyof LayerChoice, HTMLInputElement>();
  private pictures!: Record<"cost" | "region", { layer: CodeLayer; tiles: Tiles }>;
  private share_tiles: Tiles[] = [];
  private readonly shares = new Map<VerdictLayers, Shares>();
  private shown: View;
  private share_kind = 0;
  private tool: Live | null = null;
  private own: Own | null = null;
  private readonly exact: VerdictLayers | null;
  private readonly contract: VerdictLayers | null = null;  // besides `exact`, where the vehicle has one
  private modes: Modes | null;  // of the exact vehicle's plan, if it has several
  private mode_tiles!: Tiles;
  private whose: Whose = "exact";
  private readonly names: VerdictNames;
  private readonly vehicles: HTMLElement;
  private readonly witness: WitnessPlay;
  private readonly witnesses: Promise<Witnesses | null>;
  private readonly stale = new Set<Part>();

  constructor(private readonly record: PageRecord, private arrays: Arrays, private readonly field: FieldArrays, private readonly flown: ShownFlight[]) {
    this.grid = record.grid;
    const { choices, maps } = this.names = verdictNames(record);
    this.vehicles = oneOf(choices.map(([, words]) => words), "Which vehicle", (k) => this.showVehicle(choices[k][0]));
    document.querySelectorAll(".map-name").forEach((name, k) => { name.textContent = maps[k]; });
    this.view = new Viewport(record.grid);
    this.base = new BaseMap(byId<HTMLCanvasElement>("map-base"), record.grid);
    this.beside = new BaseMap(byId<HTMLCanvasElement>("map-beside"), record.grid);
    this.overlay = new Overlay(record, field);
    this.exact = this.verdicts = record.verdicts ? new VerdictLayers(arrays, record.verdicts) : null;
    this.modes = Modes.of(record, arrays, record.verdicts);
    if (record.verdicts && record.contract_verdicts) {
      this.contract = new VerdictLayers(arrays, record.contract_verdicts, "contract_verdict");
    }
    document.documentElement.toggleAttribute("data-contract", this.contract !== null);
    byId("contract-keys").hidden = this.contract === null || !record.codes.at_risk;
    this.witnesses = this.contract ? Witnesses.in(record, arrays) : Promise.resolve(null);
    this.witness = new WitnessPlay(record, () => this.redraw("marks"), (x, y, across_m) => {
      this.view.look(x, y, across_m);
      byId("stage-map").scrollIntoView({ block: "nearest" });
      this.moved();
    });
    this.paintTiles();
    this.shown = record.verdicts ? "verdict" : "cost";
    this.slider = new HeadingSlider(record, () => this.verdict_tiles, () => this.shownVerdicts().map(({ info }) => info), () => {
      this.redraw("base", "readout", ...(this.shown === "mode" ? ["lines"] as const : []));
      if (this.shown === "mode" && record.verdicts) updateModeLegend(record, record.verdicts, nearestHeading(record.verdicts, this.slider.rad));
      if (this.shown === "verdict" && record.verdicts) updateVerdictLegend(record, this.shownVerdicts());
      this.nameShown();
      if (!this.own && this.whose === "exact") this.turned(this.slider.index);
    });
    this.replay = new Replay(record, flown, (what) => {
      if (what === "choice" && this.replay.selected >= 0) this.setLayer("flights", true);
      this.redraw(...(what === "choice" ? ["lines", "marks"] as const : ["marks"] as const));
    });
    this.input = new MapInput(this);
    this.offerChoices();
    placeTable();
    window.matchMedia(wide_window).addEventListener("change", placeTable);
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.relayout());
  }

  /** Colours and patterns for the screen, or for paper. */
  private paintTiles(): void {
    const { record, field } = this;
    const ratio = pixelRatio();
    this.verdict_tiles = new Tiles(verdictLooks(record), ratio);
    this.mode_tiles = new Tiles(modeLooks(record), ratio);
    this.share_tiles = share_kinds.map((_, kind) => new Tiles(shareLooks(record, kind), ratio));
    this.pictures = {
      cost: { layer: costLayer(record, field.region, field.cost), tiles: new Tiles(costLooks(record), ratio) },
      region: { layer: regionLayer(record, field.region, field.cost), tiles: new Tiles(regionLooks(record), ratio) },
    };
  }

  /** Redraws at once for another medium or other colours. */
  relayout(): void {
    placeTable();
    this.paintTiles();
    this.fit();
    this.showLegend();
    this.slider.show();
    this.replay.redraw();
    this.paint(new Set(["base", "lines", "marks", "readout"]));
  }

  /** The first picture; resolves when it is on the screen's canvas. */
  async show(): Promise<void> {
    if (this.verdicts) await this.verdicts.ask(0);
    byId("heading").hidden = !this.verdicts;
    if (this.contract && window.matchMedia(wide_window).matches) {
      await Promise.all([this.contract.ask(0), this.contract.shares(this.record)]);
      this.vehicles.querySelectorAll("button")[2].click();
    }
    this.nameShown();
    new ResizeObserver(() => this.fit()).observe(this.map);
    window.addEventListener("resize", () => this.fit());
    this.fit();
    this.showLegend();
    this.slider.show();
    this.moved();
  }

  live(): Live | null { return this.tool; }
  set liveTool(tool: Live) {
    this.tool = tool;
    byId("live-keys").hidden = false;
    this.moved();
  }
  heading_rad(): number { return this.slider.rad; }
  turnBy(steps: number): void { this.slider.turnBy(steps); }
  pointed(): void { this.redraw("marks", "readout"); }
  moved(): void {
    this.input.showTouchAction();
    this.redraw("base", "lines", "marks", "readout");
  }
  redrawMarks(): void { this.redraw("marks"); }
  turnTo(rad: number): void { this.slider.turnToRad(rad); }
  crossTo(place: [number, number]): void {
    this.cross = place;
    this.redraw("marks", "readout");
  }

  /** A state that a link asks for. */
  goTo(state: LinkedState): void {
    this.cross = [state.x, state.y];
    this.slider.turnToRad(state.h);
    this.view.show(state.x, state.y);
    this.moved();
    if (this.tool) void this.tool.goTo(state);
  }

  /** A click without a live tool: the state there, to link to; and what fails from there. */
  picked(): void {
    if (!this.cross) return;
    const h = turnOf(parseFloat(headingWords(this.slider.rad)));  // as it is shown
    const state = linkable(this.grid, { x: this.cross[0], y: this.cross[1], h });
    writeLink({ ...state, goal: null });
    void this.playNearest(state);
  }

  /** The page's own witness from nearest to a state that is shown at risk. */
  private async playNearest(state: { x: number; y: number; h: number }): Promise<void> {
    const { contract, record } = this;
    const cell = cellAt(record, [state.x, state.y]);
    if (this.whose === "exact" || !contract || !cell) return this.witness.hide();
    const k = nearestHeading(contract.info, state.h);
    const codes = await contract.ask(k);
    if (codes[sampleIndex(contract.info, cell)] !== record.codes.at_risk) return this.witness.hide();
    const own = await this.witnesses;
    const witness = own?.nearest({ ...state, h: contract.info.heading_rad[k] });
    if (!witness) return this.witness.hide();
    this.witness.show(witness, [`It starts at ${poseWords(witness.start)}: of the ${grouped(own!.count)} witnesses on this page the nearest to the place pressed. `,
      el("code", {}, "fairway view"), " finds one for exactly the state pressed."]);
  }

  /** What the server says: `null` where nothing fails. */
  showWitness(witness: Witness | null): void {
    if (witness && !this.own) this.witness.show(witness, []);
    else this.witness.hide();
  }

  private get chokes(): Choke[] { return this.contract ? this.record.summary.contract?.chokes ?? [] : []; }

  private get under_contract(): boolean { return this.whose !== "exact"; }

  /** Two maps of the same place: cells by cells only. */
  private get split(): boolean { return this.whose === "both" && !isPrinting() && (this.shown === "verdict" || this.shown === "share"); }

  /** Whose verdicts are shown, the exact vehicle's first. */
  private shownVerdicts(): ShownVerdict[] {
    const { verdicts, exact, whose } = this;
    if (!verdicts) return [];
    const of = (layers: VerdictLayers): ShownVerdict => ({ info: layers.info, heading: nearestHeading(layers.info, this.slider.rad),
      name: this.names.short[layers === this.contract ? 1 : 0], reach: reachWord(this.record, layers.info) });
    return (whose === "both" ? [exact!, verdicts] : [verdicts]).map(of);
  }

  /** Verdicts of the exact vehicle, of all that keep its contract, or both, at the heading nearest to the one shown. */
  private showVehicle(whose: Whose): void {
    const { exact, contract } = this;
    if (whose === this.whose || !exact || !contract) return;
    this.whose = whose;
    this.witness.hide();
    const verdicts = whose === "exact" ? exact : contract;
    const { mission, cost_step_m } = this.record;
    this.take({ mission, cost_step_m, field: this.field }, verdicts.info, verdicts);
    this.fit();
    if (whose === "exact") this.turned(this.slider.index);
    byId("share-kinds").lastElementChild!.toggleAttribute("hidden", !this.record.codes.at_risk || whose === "exact");
    void this.needCounts().then(() => this.redraw("base", "readout"));
  }

  /** A choke, or any place of interest under the contract: there, near, and at the heading at which most around it is not proved. */
  async visit(x: number, y: number): Promise<void> {
    const { contract, record } = this;
    if (this.own || !contract) return;
    if (this.whose === "exact") this.vehicles.querySelectorAll("button")[1].click();
    this.choose("verdict");
    this.witness.hide();
    const layers = await Promise.all(contract.info.heading_rad.map((_, k) => contract.ask(k)));
    const cell = cellAt(record, [x, y]);
    if (cell) this.slider.turnToRad(contract.info.heading_rad[leastProved(record, contract.info, layers, cell)]);
    this.cross = [x, y];
    this.view.look(x, y, 40 * this.grid.cell_m);
    byId("stage-map").scrollIntoView({ block: "nearest" });
    this.moved();
  }

  showMoved(plan: MovedPlan): void {
    if (this.under_contract) this.vehicles.querySelector("button")!.click();
    this.vehicles.hidden = true;
    this.witness.hide();
    const { record, field } = this;
    this.own ??= { moved: { mission: record.mission, cost_step_m: record.cost_step_m, field: { ...field } }, info: record.verdicts,
      verdicts: this.verdicts, modes: this.modes, arrays: this.arrays, shown: this.shown, flights: this.choice.flights };
    this.replay.stop();
    this.modes = null;
    this.take(plan, null, null);
    this.setLayer("flights", false);
    if (this.shown !== "cost" && this.shown !== "region") this.choose("cost");
  }

  async showProof(info: VerdictInfo, arrays: Arrays): Promise<void> {
    const { record } = this;
    const { mission, cost_step_m } = record;
    this.arrays = arrays;
    record.verdicts = info;
    this.modes = Modes.of(record, arrays, info);
    this.take({ mission, cost_step_m, field: this.field }, info, new VerdictLayers(arrays, info));
    await this.verdicts!.ask(this.slider.index);
    await this.needCounts();
    this.choose("verdict");
  }

  showOwn(): void {
    const own = this.own;
    if (!own) return;
    this.own = null;
    this.vehicles.hidden = this.contract === null;
    this.arrays = own.arrays;
    this.modes = own.modes;
    this.take(own.moved, own.info, own.verdicts);
    this.setLayer("flights", own.flights);
    void this.needCounts().then(() => this.choose(own.shown));
  }

  /** Everything that draws shares the record and the arrays: they become those of the plan. */
  private take(plan: MovedPlan, info: VerdictInfo | null, verdicts: VerdictLayers | null): void {
    const rad = this.slider.rad;
    const { record } = this;
    record.mission = plan.mission;
    record.cost_step_m = plan.cost_step_m;
    record.verdicts = info;
    Object.assign(this.field, plan.field);
    this.verdicts = verdicts;
    this.paintTiles();
    this.slider.reset(rad);
    for (const name of ["verdict", "mode", "share"]) {
      const input = byId("views").querySelector<HTMLInputElement>(`input[value=${name}]`);
      if (input) input.disabled = name === "mode" ? this.modes === null : info === null;
    }
    const flights = this.boxes.get("flights");
    if (flights) flights.disabled = this.own !== null;
    this.showLegend();
    this.moved();
  }

  private choose(view: View): void {
    const input = byId("views").querySelector<HTMLInputElement>(`input[value=${view}]`);
    if (!input) return;
    input.checked = true;
    input.dispatchEvent(new Event("change"));
  }

  /** What the shares of headings are made of, and what modes command; the readout shows them too. */
  async needCounts(): Promise<void> {
    const needed = this.whose === "both" ? [this.exact, this.verdicts] : [this.verdicts];
    for (const layers of needed) {
      if (layers && !this.shares.has(layers)) this.shares.set(layers, await layers.shares(this.record));
    }
    await this.modes?.askCommands();
  }

  /** Draws what changed in the next frame, once. */
  private redraw(...parts: Part[]): void {
    const asked = this.stale.size > 0;
    parts.forEach((part) => this.stale.add(part));
    if (asked) return;
    requestAnimationFrame(() => {
      const stale = new Set(this.stale);
      this.stale.clear();
      this.paint(stale);
    });
  }

  private paint(parts: Set<Part>): void {
    if (parts.has("base")) this.drawBase();
    if (parts.has("lines")) {
      this.overlay.command = this.shown === "mode" ? (ix, iy) => this.commandAt(ix, iy) : null;
      this.inEach(this.cleared("map-lines"), (context, contract) => {
        this.overlay.draw(context, this.view, this.choice, this.flown, this.replay.selected);
        if (contract && this.choice.chokes && !this.own) drawChokes(context, this.view, this.chokes);
      });
    }
    if (parts.has("marks")) this.drawMarks();
    if (parts.has("readout")) this.drawReadout();
  }

  private drawBase(): void {
    const { shown, verdicts } = this;
    if (shown === "mode" && this.modes) {
      this.drawLayer(this.base, this.modes.layers, this.mode_tiles);
    } else if (shown === "cost" || shown === "region") {
      this.base.paint(this.pictures[shown].layer, this.pictures[shown].tiles, this.view);
    } else if (this.split) {
      this.drawCells(this.base, this.exact!);
      this.drawCells(this.beside, verdicts!);
    } else if (verdicts) {
      this.drawCells(this.base, verdicts);
    }
  }

  private drawCells(base: BaseMap, verdicts: VerdictLayers): void {
    if (this.shown === "share") {
      const layer = this.shares.get(verdicts)?.layers[this.share_kind];
      if (layer) base.paint(layer, this.share_tiles[this.share_kind], this.view);
      return;
    }
    this.drawLayer(base, verdicts, this.verdict_tiles);
  }

  private drawLayer(base: BaseMap, layers: VerdictLayers, tiles: Tiles): void {
    const k = nearestHeading(layers.info, this.slider.rad);
    const codes = layers.at(k);
    if (codes) base.paint(layers.layer(codes), tiles, this.view);
    else void layers.ask(k).then(() => this.redraw("base", "lines", "readout"));
  }

  /** The command of the mode that serves a cell, where it is not the plan's own. */
  private commandAt(ix: number, iy: number): number | null { return this.modes?.at([ix, iy], this.slider.rad)?.heading_rad ?? null; }

  /** On both maps, when they are side by side; `contract`: on that of the vehicle that keeps it. */
  private inEach(context: CanvasRenderingContext2D, draw: (context: CanvasRenderingContext2D, contract: boolean) => void): void {
    const { width, height } = this.view;
    for (const k of this.split ? [0, 1] : [0]) {
      context.save();
      if (this.split) {
        context.translate(k * width, 0);
        context.beginPath();
        context.rect(0, 0, width, height);
        context.clip();
      }
      draw(context, this.split ? k === 1 : this.under_contract);
      context.restore();
    }
  }

  /** A canvas of its own; on paper, where layers hide each other, the cells' picture. */
  private cleared(id: string): CanvasRenderingContext2D {
    if (isPrinting()) {
      const context = byId<HTMLCanvasElement>("map-base").getContext("2d")!;
      context.setTransform(pixelRatio(), 0, 0, pixelRatio(), 0, 0);
      return context;
    }
    const canvas = byId<HTMLCanvasElement>(id);
    const context = canvas.getContext("2d")!;
    fitted(canvas);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.setTransform(pixelRatio(), 0, 0, pixelRatio(), 0, 0);
    return context;
  }

  private drawMarks(): void {
    this.inEach(this.cleared("map-marks"), (context, contract) => {
      if (this.cross) drawCross(context, this.view, this.cross);
      if (!this.own) this.replay.draw(context, this.view);
      this.tool?.draw(context, this.view);
      if (contract || !this.split) this.witness.draw(context, this.view);
    });
  }

  private drawReadout(): void {
    const { exact, contract } = this;
    // Of the run's own plan both vehicles', whichever is shown.
    const layers = this.own || !exact ? [this.verdicts] : [exact, contract];
    showReadout(this.record, this.field, this.cross, layers.flatMap((its) => its ? this.readVerdicts(its) : []), this.readMode());
  }

  private readMode(): ReadMode | null {
    const { modes, slider } = this;
    const cell = this.cross && cellAt(this.record, this.cross);
    if (!modes || !cell) return null;
    const k = nearestHeading(modes.layers.info, slider.rad);
    if (!modes.layers.at(k)) {
      void modes.layers.ask(k).then(() => this.redraw("readout"));
      return null;
    }
    return { served: modes.at(cell, slider.rad), heading_rad: modes.layers.info.heading_rad[k] };
  }

  private readVerdicts(layers: VerdictLayers): ReadVerdicts[] {
    const { info } = layers;
    const k = nearestHeading(info, this.slider.rad);
    const codes = layers.at(k);
    if (!codes) {
      void layers.ask(k).then(() => this.redraw("readout"));
      return [];
    }
    return [{ info, codes, heading_rad: info.heading_rad[k], reaching: this.shares.get(layers)?.reaching ?? null, whose: layers === this.contract ? ` ${this.names.after}` : "", reach: reachWord(this.record, info) }];
  }

  private shareWords(kind: number): string { return share_kinds[kind].replace("reach", [...new Set(this.names.reach)].join(" or ")); }

  private showLegend(): void {
    const { record, shown, share_kind } = this;
    this.nameShown();
    if (shown === "verdict" && record.verdicts) showVerdictLegend(record, this.verdict_tiles, this.shownVerdicts());
    if (shown === "mode" && record.verdicts && this.modes) showModeLegend(record, record.verdicts, this.mode_tiles, nearestHeading(record.verdicts, this.slider.rad));
    if (shown === "share" && record.verdicts) showShareLegend(record, record.verdicts, this.share_tiles[share_kind], share_kind, this.shareWords(share_kind));
    if (shown === "cost") showCostLegend(record, this.pictures.cost.tiles);
    if (shown === "region") showRegionLegend(this.pictures.region.tiles);
  }

  private offerChoices(): void {
    this.vehicles.classList.add("sub", "vehicles");
    this.vehicles.hidden = this.contract === null;
    byId("views").append(this.vehicles);
    const shares = oneOf(share_kinds.map((_, kind) => this.shareWords(kind)), "Which share", (kind) => {
      this.share_kind = kind;
      this.showLegend();
      this.redraw("base");
    });
    shares.classList.add("sub");
    shares.id = "share-kinds";
    shares.hidden = true;
    shares.lastElementChild!.toggleAttribute("hidden", true);  // at risk: under a contract alone
    const offered = view_names.filter(([name]) => name === "mode" ? this.modes : this.verdicts || name === "cost" || name === "region");
    radios(byId("views"), "view", offered, this.shown, (name) => {
      this.shown = name;
      shares.hidden = name !== "share";
      void this.needCounts().then(() => {
        this.fit();
        this.showLegend();
        this.redraw("base", "lines", "readout");
      });
    });
    byId("views").querySelector("input[value=share]")?.parentElement!.after(shares);
    for (const [name, words] of layer_names) {
      const number = name === "flights" ? this.flown.length : name === "chokes" ? this.chokes.length : name === "tube" && !this.field.tube ? 0 : null;
      if (number === 0) continue;
      const count = number === null ? [] : [el("small", {}, grouped(number))];
      this.boxes.set(name, checkBox(byId("layers"), name, [words, ...count], this.choice[name], (on) => this.setLayer(name, on)));
    }
  }

  private setLayer(name: keyof LayerChoice, on: boolean): void {
    const box = this.boxes.get(name);
    if (!box) return;
    this.choice[name] = on;
    box.checked = on;
    this.nameShown();
    this.redraw("lines");
  }

  /** What the picture shows, for paper. */
  private nameShown(): void {
    const view = view_names.find(([name]) => name === this.shown)![1];
    const what = this.shown === "verdict" ? `Verdicts at heading ${bearingWords(this.record, this.slider.rad)}, ${wind(this.slider.rad)}`
      : this.shown === "mode" ? `Modes at heading ${bearingWords(this.record, this.slider.rad)}, ${wind(this.slider.rad)}`
      : this.shown === "share" ? `${view}: ${this.shareWords(this.share_kind)}` : view;
    const layers = layer_names.filter(([name]) => this.choice[name] && this.boxes.has(name)).map(([, words]) => words.toLowerCase());
    const whose = this.under_contract && (this.shown === "verdict" || this.shown === "share") ? `, ${this.names.after}${this.split ? `, next to those ${this.record.follow ? "of touching it" : "of the exact vehicle"}` : ""}` : "";
    byId("shown-words").textContent = what + whose + (layers.length > 0 ? `; overlays: ${layers.join(", ")}` : "") + ".";
  }

  private fit(): void {
    // The replay below the map wraps where the map is narrow: start from the style's own width and
    // measure twice, so that the previous size does not matter.
    const { split } = this;
    this.map.classList.toggle("split", split);
    placeExplained(split);
    byId("stage").style.removeProperty("--map-width");
    for (let pass = 0; pass < 2; ++pass) {
      const { width, height } = mapSize((split ? 2 : 1) * this.grid.nx / this.grid.ny);
      byId("stage").style.setProperty("--map-width", `${width}px`);
      this.map.style.height = `${height}px`;
      this.map.style.width = isPrinting() ? `${width}px` : "";
    }
    this.view.resize(this.map.clientWidth / (split ? 2 : 1), this.map.clientHeight);
    this.moved();
    this.slider.strip();
  }
}

function drawCross(context: CanvasRenderingContext2D, view: Viewport, place: [number, number]): void {
  const [x, y] = view.toScreen(...place);
  context.strokeStyle = "#22262b";
  context.lineWidth = 1;
  context.beginPath();
  for (const [dx, dy] of [[-1, 0], [1, 0], [0, -1], [0, 1]]) {
    context.moveTo(x + 4 * dx, y + 4 * dy);
    context.lineTo(x + 11 * dx, y + 11 * dy);
  }
  context.stroke();
}

/** The heading at which most samples near a cell are undecided or at risk. */
function leastProved({ codes }: PageRecord, info: VerdictInfo, layers: Uint8Array[], [ix, iy]: [number, number]): number {
  const near = 3;  // samples to either side
  const sx = Math.floor(ix / info.cells_per_sample), sy = Math.floor(iy / info.cells_per_sample);
  const counts = layers.map((layer) => {
    let count = 0;
    for (let y = Math.max(0, sy - near); y <= Math.min(info.ny - 1, sy + near); ++y) {
      for (let x = Math.max(0, sx - near); x <= Math.min(info.nx - 1, sx + near); ++x) {
        const code = layer[y * info.nx + x];
        if (code === codes.undecided || code === codes.at_risk) ++count;
      }
    }
    return count;
  });
  return counts.indexOf(Math.max(...counts));
}
