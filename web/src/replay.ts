// The run's flights: a table to choose from, and their replay.
import { Charts } from "./charts";
import { byId, degrees, el, short } from "./dom";
import { drawVehicle, outcomeWords, strokeTrack, type ShownFlight } from "./flights";
import type { PageRecord } from "./record";
import type { Viewport } from "./viewport";

const groups: Record<string, string> = { given: "given", random: "random", failing: "fails" };
const grounds: Record<string, string> = { safe_start: "from a safe start with a command", buffer: "from the buffer", cut_off: "from a cut-off cell" };
const place = (m: number): string => Math.abs(m) < 100 ? short(m) : String(Math.round(m));
const lines_in_charts = 5;

export class Replay {
  selected = -1;  // all
  private time_s = 0;
  private speed = 10;
  private frame = 0;
  private last = 0;
  private readonly charts: Charts;
  private readonly scrub = el("input", { type: "range", min: 0, max: 1000, value: 0, "aria-label": "Replay time" });
  private readonly play = el("button", { type: "button", class: "round", "aria-pressed": "false", "aria-label": "Replay" });
  private readonly clock = el("output", {});
  private readonly which = el("span", { class: "which" });
  private rows: HTMLTableRowElement[] = [];
  private ready = false;

  constructor(record: PageRecord, private readonly flights: ShownFlight[], private readonly changed: (what: "choice" | "time") => void) {
    this.charts = new Charts(record, flights, (time_s) => this.moveTo(time_s));
    if (flights.length === 0) {
      byId("flights-section").hidden = true;
      return;
    }
    const speeds = el("select", { "aria-label": "Replay speed" },
      ...[1, 5, 10, 30, 100].map((s) => el("option", { value: s, selected: s === this.speed }, `${s} ×`)));
    speeds.addEventListener("change", () => { this.speed = Number(speeds.value); });
    this.scrub.addEventListener("input", () => { this.stop(); this.moveTo(Number(this.scrub.value) / 1000 * this.duration_s); });
    this.play.addEventListener("click", () => this.frame ? this.stop() : this.start());
    byId("replay").replaceChildren(this.play, this.which, this.scrub, speeds, this.clock);
    byId("replay").hidden = false;
    this.table(record);
    this.choose(-1);
    this.ready = true;
  }

  private get shown(): ShownFlight[] { return this.selected < 0 ? this.flights : [this.flights[this.selected]]; }
  private get duration_s(): number {
    return Math.max(1e-9, ...this.shown.map((f) => f.track.duration_s + (f.leg?.duration_s ?? 0)));
  }

  private table(record: PageRecord): void {
    const row = (k: number, ...cells: (Node | string)[]): HTMLTableRowElement => {
      const tr = el("tr", { tabindex: k < 0 ? 0 : -1, "aria-selected": "false", "data-flight": k },
        ...cells.map((cell, c) => el("td", { class: c >= 2 ? "num" : undefined }, cell)));
      tr.addEventListener("click", () => {
        this.choose(k);
        if (k >= 0) byId("stage-map").scrollIntoView({ block: "nearest" });  // where it is highlighted
      });
      return tr;
    };
    this.rows = [row(-1, "all", `${this.flights.length} flights`, "", "")];
    for (const [k, { record: flight, line }] of this.flights.entries()) {
      const mark = el("span", { class: "mark" });
      mark.style.background = line.color;
      const [x, y, h] = flight.start;
      this.rows.push(row(k, el("span", {}, mark, outcomeWords(flight), " ", el("small", {}, (flight.ground && grounds[flight.ground]) ?? groups[flight.group] ?? flight.group)),
        `${place(x)}, ${place(y)}, ${Math.round(degrees(h)) % 360}°`,
        flight.time_s === null ? "–" : `${flight.time_s.toFixed(1)} s`, flight.length_m === null ? "–" : `${Math.round(flight.length_m)} m`));
    }
    const body = el("tbody", {}, ...this.rows);
    body.addEventListener("keydown", (event) => {
      const step = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
      if (step === 0) return;
      event.preventDefault();
      this.choose(Math.min(Math.max(this.selected + step, -1), this.flights.length - 1));
      this.rows[this.selected + 1].focus();
    });
    const left_out = Object.values(record.flights_left_out).reduce((a, b) => a + b, 0);
    byId("flight-table").replaceChildren(el("table", { "aria-label": "Flights" },
      el("thead", {}, el("tr", {}, el("th", {}, "outcome"), el("th", {}, "start"), el("th", { class: "num" }, "time"), el("th", { class: "num" }, "length"))),
      body));
    if (left_out > 0) byId("flight-table").append(el("p", { class: "hint" }, `${left_out} more flights of the run are not on this page.`));
  }

  choose(k: number): void {
    this.rows[this.selected + 1]?.setAttribute("aria-selected", "false");
    this.rows[this.selected + 1]?.setAttribute("tabindex", "-1");
    this.selected = k;
    const row = this.rows[k + 1];
    row.setAttribute("aria-selected", "true");
    row.setAttribute("tabindex", "0");
    // With all flights the charts show those of the scenario, else the first few.
    const given = this.flights.filter((f) => f.record.group === "given");
    this.charts.show(k >= 0 ? [this.flights[k]] : (given.length > 0 ? given : this.flights).slice(0, lines_in_charts));
    this.time_s = Math.min(this.time_s, this.duration_s);
    const start = this.flights[k]?.record.start;
    this.which.textContent = start ? `Flight from (${short(start[0])}, ${short(start[1])})` : `All ${this.flights.length} flights`;
    this.showTime();
    if (this.ready) this.changed("choice");
  }

  private moveTo(time_s: number): void {
    this.time_s = Math.min(Math.max(time_s, 0), this.duration_s);
    this.showTime();
    this.changed("time");
  }

  private showTime(): void {
    this.scrub.value = String(Math.round(this.time_s / this.duration_s * 1000));
    this.scrub.setAttribute("aria-valuetext", `${this.time_s.toFixed(1)} seconds`);
    this.clock.textContent = `${this.time_s.toFixed(1)} s of ${this.duration_s.toFixed(1)} s`;
    if (this.frame || this.time_s > 0) this.charts.mark(this.time_s);
  }

  private start(): void {
    if (this.time_s >= this.duration_s) this.time_s = 0;
    this.play.setAttribute("aria-pressed", "true");
    this.last = performance.now();
    const step = (now: number) => {
      const next = this.time_s + (now - this.last) / 1000 * this.speed;
      this.last = now;
      this.frame = requestAnimationFrame(step);
      if (next >= this.duration_s) this.stop();
      this.moveTo(next);
    };
    this.frame = requestAnimationFrame(step);
  }

  /** Redraws the charts, in other colours or at another width. */
  redraw(): void { this.charts.redraw(); }

  stop(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.play.setAttribute("aria-pressed", "false");
  }

  /** Vehicles at their current position, with the track so far. */
  draw(context: CanvasRenderingContext2D, view: Viewport): void {
    if (this.time_s <= 0) return;
    for (const { track, line, leg, leg_line } of this.shown) {
      const on_leg = leg !== null && this.time_s > track.duration_s;
      if (this.selected >= 0 || this.flights.length <= 12) {
        strokeTrack(context, view, track, line, 3, this.time_s);
        if (on_leg) strokeTrack(context, view, leg, leg_line, 3, this.time_s - track.duration_s);
      }
      const pose = on_leg ? leg.poseAt(this.time_s - track.duration_s) : track.poseAt(this.time_s);
      drawVehicle(context, view, pose, line.color, this.selected >= 0 ? 11 : 7);
    }
  }
}
