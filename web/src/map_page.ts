// The map: cells as one of four views, lines and marks on top, and the readout under the cross.
import type { Arrays } from "./arrays";
import { BaseMap } from "./base_map";
import { checkBox, oneOf, radios } from "./choices";
import { byId, el, fitted, grouped, headingWords, isPrinting, pixelRatio, turnOf, wind } from "./dom";
import type { ShownFlight } from "./flights";
import { bearingWords } from "./earth";
import { HeadingSlider } from "./heading";
import { costLayer, costLooks, headingsOfKind, regionLayer, regionLooks, share_kinds, shareLayer, shareLooks, Tiles, VerdictLayers,
  verdictLooks, type CodeLayer } from "./layers";
import { showCostLegend, showRegionLegend, showShareLegend, showVerdictLegend, updateVerdictLegend } from "./legend";
import type { Live } from "./live";
import { MapInput, type MapHands } from "./map_input";
import { mapSize, placeTable, wide_window } from "./map_size";
import { Overlay, type FieldArrays, type LayerChoice } from "./overlay";
import { showReadout } from "./readout";
import type { PageRecord, VerdictInfo } from "./record";
import type { MovedPlan, PlanView } from "./moved_goal";
import { linkable, writeLink, type LinkedState } from "./state_link";
import { Replay } from "./replay";
import { Viewport } from "./viewport";

type View = "verdict" | "share" | "cost" | "region";
type Part = "base" | "lines" | "marks" | "readout";

const view_names: [View, string][] = [
  ["verdict", "Verdicts at a heading"], ["share", "Share of headings proved"], ["cost", "Cost to go"], ["region", "Regions"]];
const layer_names: [keyof LayerChoice, string][] = [
  ["streamlines", "Field (streamlines)"], ["arrows", "Field (arrows)"], ["contours", "Cost contours"], ["flights", "Flights"], ["mission", "Mission"]];

/** What is set aside while another plan is shown. */
interface Own { moved: MovedPlan; info: VerdictInfo | null; verdicts: VerdictLayers | null; arrays: Arrays; shown: View; flights: boolean }

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
  private readonly overlay: Overlay;
  private readonly input: MapInput;
  private readonly replay: Replay;
  private readonly choice: LayerChoice = { arrows: false, streamlines: true, contours: false, flights: false, mission: true };
  private readonly boxes = new Map<keyof LayerChoice, HTMLInputElement>();
  private pictures!: Record<"cost" | "region", { layer: CodeLayer; tiles: Tiles }>;
  private share_tiles: Tiles[] = [];
  private share_layers: CodeLayer[] = [];
  private reaching: Uint16Array | null = null;
  private shown: View;
  private share_kind = 0;
  private tool: Live | null = null;
  private own: Own | null = null;
  private set_aside: VerdictLayers | null = null;  // of the vehicle that is not shown: exact, or under its contract
  private readonly vehicles = oneOf(["Exact vehicle", "Under the contract"], "Which vehicle", (k) => this.showVehicle(k === 1));
  private readonly stale = new Set<Part>();

  constructor(private readonly record: PageRecord, private arrays: Arrays, private readonly field: FieldArrays, private readonly flown: ShownFlight[]) {
    this.grid = record.grid;
    this.view = new Viewport(record.grid);
    this.base = new BaseMap(byId<HTMLCanvasElement>("map-base"), record.grid);
    this.overlay = new Overlay(record, field);
    this.verdicts = record.verdicts ? new VerdictLayers(arrays, record.verdicts) : null;
    if (record.verdicts && record.contract_verdicts) {
      this.set_aside = new VerdictLayers(arrays, record.contract_verdicts, "contract_verdict");
    }
    this.paintTiles();
    this.shown = record.verdicts ? "verdict" : "cost";
    this.slider = new HeadingSlider(record, () => this.verdict_tiles, () => {
      this.redraw("base", "readout");
      if (this.shown === "verdict" && record.verdicts) updateVerdictLegend(record, this.slider.index);
      this.nameShown();
      if (!this.own && !this.under_contract) this.turned(this.slider.index);
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

  /** A click without a live tool: the state there, to link to. */
  picked(): void {
    if (!this.cross) return;
    const h = turnOf(parseFloat(headingWords(this.slider.rad)));  // as it is shown
    writeLink({ ...linkable(this.grid, { x: this.cross[0], y: this.cross[1], h }), goal: null });
  }

  private get under_contract(): boolean { return this.verdicts?.name === "contract_verdict"; }

  /** Verdicts of the exact vehicle, or of all that keep its contract, at the heading nearest to the one shown. */
  private showVehicle(contract: boolean): void {
    if (contract === this.under_contract || !this.set_aside) return;
    const verdicts = this.set_aside;
    this.set_aside = this.verdicts;
    const { mission, cost_step_m } = this.record;
    this.take({ mission, cost_step_m, field: this.field }, verdicts.info, verdicts);
    if (!contract) this.turned(this.slider.index);
    void this.needCounts().then(() => this.redraw("base", "readout"));
  }

  showMoved(plan: MovedPlan): void {
    if (this.under_contract) this.vehicles.querySelector("button")!.click();
    this.vehicles.hidden = true;
    const { record, field } = this;
    this.own ??= { moved: { mission: record.mission, cost_step_m: record.cost_step_m, field: { ...field } }, info: record.verdicts,
      verdicts: this.verdicts, arrays: this.arrays, shown: this.shown, flights: this.choice.flights };
    this.replay.stop();
    this.take(plan, null, null);
    this.setLayer("flights", false);
    if (this.shown === "verdict" || this.shown === "share") this.choose("cost");
  }

  async showProof(info: VerdictInfo, arrays: Arrays): Promise<void> {
    const { record } = this;
    const { mission, cost_step_m } = record;
    this.arrays = arrays;
    record.verdicts = info;
    this.take({ mission, cost_step_m, field: this.field }, info, new VerdictLayers(arrays, info));
    await this.verdicts!.ask(this.slider.index);
    await this.needCounts();
    this.choose("verdict");
  }

  showOwn(): void {
    const own = this.own;
    if (!own) return;
    this.own = null;
    this.vehicles.hidden = this.set_aside === null;
    this.arrays = own.arrays;
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
    this.reaching = null;
    this.share_layers = [];
    this.paintTiles();
    this.slider.reset(rad);
    for (const name of ["verdict", "share"]) {
      const input = byId("views").querySelector<HTMLInputElement>(`input[value=${name}]`);
      if (input) input.disabled = info === null;
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

  /** What the shares of headings are made of; the readout shows them too. */
  async needCounts(): Promise<void> {
    if (this.reaching || !this.verdicts) return;
    const { verdicts } = this;
    const [first, all] = await Promise.all([verdicts.ask(0), this.arrays.array(`${verdicts.name}_count`)]);
    if (verdicts !== this.verdicts) return;  // others are shown by now
    this.reaching = headingsOfKind(this.record, all as Uint8Array, 0);
    this.share_layers = share_kinds.map((_, kind) => shareLayer(this.record, first, all as Uint8Array, kind));
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
    if (parts.has("lines")) this.overlay.draw(this.cleared("map-lines"), this.view, this.choice, this.flown, this.replay.selected);
    if (parts.has("marks")) this.drawMarks();
    if (parts.has("readout")) this.drawReadout();
  }

  private drawBase(): void {
    const { shown, verdicts, slider } = this;
    if (shown === "cost" || shown === "region") {
      this.base.paint(this.pictures[shown].layer, this.pictures[shown].tiles, this.view);
    } else if (shown === "share") {
      const layer = this.share_layers[this.share_kind];
      if (layer) this.base.paint(layer, this.share_tiles[this.share_kind], this.view);
    } else if (verdicts) {
      const codes = verdicts.at(slider.index);
      if (codes) this.base.paint(verdicts.layer(codes), this.verdict_tiles, this.view);
      else void verdicts.ask(slider.index).then(() => this.redraw("base", "readout"));
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
    const context = this.cleared("map-marks");
    if (this.cross) {
      const [x, y] = this.view.toScreen(...this.cross);
      context.strokeStyle = "#22262b";
      context.lineWidth = 1;
      context.beginPath();
      for (const [dx, dy] of [[-1, 0], [1, 0], [0, -1], [0, 1]]) {
        context.moveTo(x + 4 * dx, y + 4 * dy);
        context.lineTo(x + 11 * dx, y + 11 * dy);
      }
      context.stroke();
    }
    if (!this.own) this.replay.draw(context, this.view);
    this.tool?.draw(context, this.view);
  }

  private drawReadout(): void {
    const codes = this.verdicts?.at(this.slider.index);
    showReadout(this.record, this.field, this.cross, codes ? { codes, heading_rad: this.slider.rad, reaching: this.reaching, whose: this.under_contract ? " under the contract" : "" } : null);
  }

  private showLegend(): void {
    const { record, shown, share_kind } = this;
    this.nameShown();
    if (shown === "verdict" && record.verdicts) showVerdictLegend(record, this.verdict_tiles, this.slider.index);
    if (shown === "share" && record.verdicts) showShareLegend(record, this.share_tiles[share_kind], share_kind);
    if (shown === "cost") showCostLegend(record, this.pictures.cost.tiles);
    if (shown === "region") showRegionLegend(this.pictures.region.tiles);
  }

  private offerChoices(): void {
    this.vehicles.classList.add("sub");
    this.vehicles.hidden = this.set_aside === null;
    byId("views").append(this.vehicles);
    const shares = oneOf(share_kinds, "Which share", (kind) => {
      this.share_kind = kind;
      this.showLegend();
      this.redraw("base");
    });
    shares.classList.add("sub");
    shares.hidden = true;
    const offered = view_names.filter(([name]) => this.verdicts || name === "cost" || name === "region");
    radios(byId("views"), "view", offered, this.shown, (name) => {
      this.shown = name;
      shares.hidden = name !== "share";
      void this.needCounts().then(() => {
        this.showLegend();
        this.redraw("base", "readout");
      });
    });
    byId("views").querySelector("input[value=share]")?.parentElement!.after(shares);
    for (const [name, words] of layer_names) {
      if (name === "flights" && this.flown.length === 0) continue;
      const count = name === "flights" ? [el("small", {}, grouped(this.flown.length))] : [];
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
      : this.shown === "share" ? `${view}: ${share_kinds[this.share_kind]}` : view;
    const layers = layer_names.filter(([name]) => this.choice[name]).map(([, words]) => words.toLowerCase());
    const whose = this.under_contract && (this.shown === "verdict" || this.shown === "share") ? ", under the contract" : "";
    byId("shown-words").textContent = what + whose + (layers.length > 0 ? `; overlays: ${layers.join(", ")}` : "") + ".";
  }

  private fit(): void {
    // The replay below the map wraps where the map is narrow: start from the style's own width and
    // measure twice, so that the previous size does not matter.
    byId("stage").style.removeProperty("--map-width");
    for (let pass = 0; pass < 2; ++pass) {
      const { width, height } = mapSize(this.grid.nx / this.grid.ny);
      byId("stage").style.setProperty("--map-width", `${width}px`);
      this.map.style.height = `${height}px`;
      this.map.style.width = isPrinting() ? `${width}px` : "";
    }
    this.view.resize(this.map.clientWidth, this.map.clientHeight);
    this.moved();
    this.slider.strip();
  }
}
