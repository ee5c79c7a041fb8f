// The map: cells as one of four views, lines and marks on top, and what is under the cross.
import type { Arrays } from "./arrays";
import { BaseMap } from "./base_map";
import { checkBox, oneOf, radios } from "./choices";
import { byId, el, fitted, grouped, pixelRatio } from "./dom";
import type { ShownFlight } from "./flights";
import { HeadingSlider } from "./heading";
import { costLayer, costLooks, headingsOfKind, regionLayer, regionLooks, share_kinds, shareLayer, shareLooks, Tiles, VerdictLayers,
  verdictLooks, type CodeLayer } from "./layers";
import { showCostLegend, showRegionLegend, showShareLegend, showVerdictLegend, updateVerdictLegend } from "./legend";
import type { Live } from "./live";
import { MapInput, type MapHands } from "./map_input";
import { Overlay, type FieldArrays, type LayerChoice } from "./overlay";
import { showReadout } from "./readout";
import type { PageRecord } from "./record";
import { Replay } from "./replay";
import { Viewport } from "./viewport";

type View = "verdict" | "share" | "cost" | "region";
type Part = "base" | "lines" | "marks" | "readout";

const view_names: [View, string][] = [
  ["verdict", "Verdicts at a heading"], ["share", "Share of headings proved"], ["cost", "Cost to go"], ["region", "Regions"]];
const layer_names: [keyof LayerChoice, string][] = [
  ["streamlines", "Field as streamlines"], ["arrows", "Field as arrows"], ["contours", "Cost contours"], ["flights", "Flights"], ["mission", "Mission"]];

export class MapPage implements MapHands {
  readonly grid;
  readonly view: Viewport;
  readonly slider: HeadingSlider;
  readonly verdicts: VerdictLayers | null;
  readonly verdict_tiles: Tiles | null;
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
  private readonly pictures: Record<"cost" | "region", { layer: CodeLayer; tiles: Tiles }>;
  private readonly share_tiles: Tiles[];
  private share_layers: CodeLayer[] = [];
  private reaching: Uint16Array | null = null;
  private shown: View;
  private share_kind = 0;
  private tool: Live | null = null;
  private readonly stale = new Set<Part>();
  private readonly ratio = pixelRatio();

  constructor(private readonly record: PageRecord, private readonly arrays: Arrays, private readonly field: FieldArrays, private readonly flown: ShownFlight[]) {
    const { ratio } = this;
    this.grid = record.grid;
    this.view = new Viewport(record.grid);
    this.base = new BaseMap(byId<HTMLCanvasElement>("map-base"), record.grid);
    this.overlay = new Overlay(record, field);
    this.verdicts = record.verdicts ? new VerdictLayers(arrays, record) : null;
    this.verdict_tiles = record.verdicts ? new Tiles(verdictLooks(record), ratio) : null;
    this.share_tiles = record.verdicts ? share_kinds.map((_, kind) => new Tiles(shareLooks(record, kind), ratio)) : [];
    this.pictures = {
      cost: { layer: costLayer(record, field.region, field.cost), tiles: new Tiles(costLooks(record), ratio) },
      region: { layer: regionLayer(record, field.region, field.cost), tiles: new Tiles(regionLooks(record), ratio) },
    };
    this.shown = record.verdicts ? "verdict" : "cost";
    this.slider = new HeadingSlider(record, () => this.verdict_tiles!, () => {
      this.redraw("base", "readout");
      if (this.shown === "verdict") updateVerdictLegend(record, this.slider.index);
      this.turned(this.slider.index);
    });
    this.replay = new Replay(record, flown, (what) => {
      if (what === "choice" && this.replay.selected >= 0) this.setLayer("flights", true);
      this.redraw(...(what === "choice" ? ["lines", "marks"] as const : ["marks"] as const));
    });
    this.input = new MapInput(this);
    this.offerChoices();
  }

  /** The first picture; resolves when it is on the screen's canvas. */
  async show(): Promise<void> {
    if (this.verdicts) await this.verdicts.ask(0);
    byId("heading").hidden = !this.verdicts;
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

  /** What the shares of headings are made of; the readout tells them too. */
  async needCounts(): Promise<void> {
    if (this.reaching || !this.verdicts) return;
    const [first, all] = await Promise.all([this.verdicts.ask(0), this.arrays.array("verdict_count")]);
    this.reaching = headingsOfKind(this.record, all as Uint8Array, 0);
    this.share_layers = share_kinds.map((_, kind) => shareLayer(this.record, first, all as Uint8Array, kind));
  }

  /** What changed is drawn in the next frame, once. */
  private redraw(...parts: Part[]): void {
    const asked = this.stale.size > 0;
    parts.forEach((part) => this.stale.add(part));
    if (asked) return;
    requestAnimationFrame(() => {
      const stale = new Set(this.stale);
      this.stale.clear();
      if (stale.has("base")) this.drawBase();
      if (stale.has("lines")) this.overlay.draw(this.cleared("map-lines"), this.view, this.choice, this.flown, this.replay.selected);
      if (stale.has("marks")) this.drawMarks();
      if (stale.has("readout")) this.drawReadout();
    });
  }

  private drawBase(): void {
    const { shown, verdicts, slider } = this;
    if (shown === "cost" || shown === "region") {
      this.base.paint(this.pictures[shown].layer, this.pictures[shown].tiles, this.view);
    } else if (shown === "share") {
      const layer = this.share_layers[this.share_kind];
      if (layer) this.base.paint(layer, this.share_tiles[this.share_kind], this.view);
    } else {
      const codes = verdicts!.at(slider.index);
      if (codes) this.base.paint(verdicts!.layer(codes), this.verdict_tiles!, this.view);
      else void verdicts!.ask(slider.index).then(() => this.redraw("base", "readout"));
    }
  }

  private cleared(id: string): CanvasRenderingContext2D {
    const canvas = byId<HTMLCanvasElement>(id);
    const context = canvas.getContext("2d")!;
    fitted(canvas, this.ratio);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
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
    this.replay.draw(context, this.view);
    this.tool?.draw(context, this.view);
  }

  private drawReadout(): void {
    const codes = this.verdicts?.at(this.slider.index);
    showReadout(this.record, this.field, this.cross, codes ? { codes, heading_rad: this.slider.rad, reaching: this.reaching } : null);
  }

  private showLegend(): void {
    const { record, shown, share_kind } = this;
    if (shown === "verdict") showVerdictLegend(record, this.verdict_tiles!, this.slider.index);
    if (shown === "share") showShareLegend(record, this.share_tiles[share_kind], share_kind);
    if (shown === "cost") showCostLegend(record, this.pictures.cost.tiles);
    if (shown === "region") showRegionLegend(this.pictures.region.tiles);
  }

  private offerChoices(): void {
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
        this.redraw("base");
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
    this.choice[name] = on;
    this.boxes.get(name)!.checked = on;
    this.redraw("lines");
  }

  /** As wide as its column, as high as the map needs and the window allows. */
  private fit(): void {
    const width = this.map.clientWidth;
    const wanted = width * this.grid.ny / this.grid.nx;
    this.map.style.height = `${Math.round(Math.max(260, Math.min(wanted, window.innerHeight - 170)))}px`;
    this.view.resize(width, this.map.clientHeight);
    this.moved();
    this.slider.strip();
  }
}
