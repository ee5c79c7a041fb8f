// A behaviour that fails, played on the map, with what it shows in words.
import { byId, el, headingWords, short } from "./dom";
import { drawVehicle, lineOf, strokeTrack, type Pose } from "./flights";
import type { PageRecord } from "./record";
import type { Viewport } from "./viewport";
import type { Witness } from "./witness";

const whole_s = 6;  // of the reader's time, for the whole behaviour
const ends: Record<string, string> = { collide: "touches an obstacle", leave: "leaves the map" };

/** Words for where it starts: a place, a heading. */
export const poseWords = ({ x, y, h }: Pose): string => `(${short(x)}, ${short(y)}), heading ${headingWords(h)}`;

export class WitnessPlay {
  private shown: Witness | null = null;
  private time_s = 0;
  private frame = 0;
  private last = 0;
  private readonly box = byId("witness");
  private readonly play = el("button", { type: "button", class: "round", "aria-pressed": "false", "aria-label": "Play the witness" });
  private readonly scrub = el("input", { type: "range", min: 0, max: 1000, value: 0, "aria-label": "Time of the witness" });
  private readonly clock = el("output", {});
  private readonly step = el("p", { class: "step" });

  /** `closely`: to show a part of the map, given by its middle and its size. */
  constructor(private readonly record: PageRecord, private readonly changed: () => void, private readonly closely: (x: number, y: number, across_m: number) => void) {
    this.play.addEventListener("click", () => this.frame ? this.stop() : this.start());
    this.scrub.addEventListener("input", () => { this.stop(); this.moveTo(Number(this.scrub.value) / 1000 * this.duration_s); });
  }

  get playing(): Witness | null { return this.shown; }
  private get duration_s(): number { return Math.max(1e-9, this.shown?.track.duration_s ?? 0); }

  /** `note`: where it comes from, if not from the very state pressed. */
  show(witness: Witness, note: (Node | string)[]): void {
    this.stop();
    this.shown = witness;
    const { track, end, start } = witness;
    const { exact_contract } = this.record;
    const close = el("button", { type: "button", class: "close", "aria-label": "Close the witness" }, "×");
    close.addEventListener("click", () => this.hide());
    const zoom = el("button", { type: "button" }, "Zoom to it");
    zoom.addEventListener("click", () => this.zoom());
    const steps = track.count;
    this.box.replaceChildren(
      el("h3", {}, "At risk", close),
      el("p", { role: "status" }, el("b", {}, `A ${exact_contract ? "flight" : "vehicle within the contract"} that fails from here.`),
        track.count === 0 ? ` It ${ends[end] ?? end} at once.`
          : ` It ${ends[end] ?? end} after ${track.duration_s.toFixed(1)} s and ${short(Math.round(track.time_s[track.count] * track.speed_mps))} m. ` +
            `${steps === 1 ? "Its one step is" : `Each of its ${steps} steps is`} one that ${exact_contract ? "the vehicle flies, give or take a thousandth of a radian" : "the contract allows"}; an adversary picks ${steps === 1 ? "it" : "them"}.`),
      ...(note.length > 0 ? [el("p", { class: "hint" }, ...note)] : []),
      ...(track.count === 0 ? [] : [el("div", { class: "controls" }, this.play, this.scrub, this.clock), this.step, zoom]));
    this.box.dataset.start = `${start.x},${start.y},${start.h}`;
    this.box.hidden = false;
    const still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.moveTo(still ? this.duration_s : 0);
    if (!still && track.count > 0) this.start();
  }

  hide(): void {
    this.stop();
    if (!this.shown) return;
    this.shown = null;
    this.box.hidden = true;
    this.changed();
  }

  private zoom(): void {
    const { track } = this.shown!;
    const poses = track.samples(200).map(({ pose }) => pose);
    const xs = poses.map(({ x }) => x), ys = poses.map(({ y }) => y);
    const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    this.closely((left + right) / 2, (low + high) / 2, 2 * Math.max(right - left, high - low, 2 * this.record.grid.cell_m));
  }

  private moveTo(time_s: number): void {
    this.time_s = Math.min(Math.max(time_s, 0), this.duration_s);
    this.scrub.value = String(Math.round(this.time_s / this.duration_s * 1000));
    this.scrub.setAttribute("aria-valuetext", `${this.time_s.toFixed(1)} seconds`);
    this.clock.textContent = `${this.time_s.toFixed(1)} s of ${this.duration_s.toFixed(1)} s`;
    this.step.textContent = this.stepWords();
    this.changed();
  }

  /** The step in which the vehicle is, its last one at the end. */
  private at(): number {
    const { track } = this.shown!;
    let k = 0;
    while (k + 1 < track.count && track.time_s[k + 1] <= this.time_s) ++k;
    return k;
  }

  private stepWords(): string {
    const { shown } = this;
    if (!shown || shown.track.count === 0) return "";
    const k = this.at();
    const { track, commands } = shown;
    const curvature = track.curvature_per_m[k];
    const begin = track.pose(k, 0);
    const away = Math.hypot(commands[k].x - begin.x, commands[k].y - begin.y);
    const whose = away < 0.05 ? "of its own place" : `of a place ${short(Math.round(away * 10) / 10)} m away`;
    const does = curvature === 0 ? "flies straight on" : `turns ${curvature > 0 ? "left" : "right"} with a radius of ${short(Math.round(10 / Math.abs(curvature)) / 10)} m towards ${headingWords(commands[k].rad)}`;
    return `Step ${k + 1} of ${track.count}: it ${does}, by the command ${whose}.`;
  }

  private start(): void {
    if (this.time_s >= this.duration_s) this.time_s = 0;
    this.play.setAttribute("aria-pressed", "true");
    this.last = performance.now();
    const speed = Math.max(1, this.duration_s / whole_s);
    const step = (now: number) => {
      const next = this.time_s + Math.max(0, now - this.last) / 1000 * speed;
      this.last = now;
      this.frame = requestAnimationFrame(step);
      if (next >= this.duration_s) this.stop();
      this.moveTo(next);
    };
    this.frame = requestAnimationFrame(step);
  }

  private stop(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.play.setAttribute("aria-pressed", "false");
  }

  draw(context: CanvasRenderingContext2D, view: Viewport): void {
    const { shown } = this;
    if (!shown) return;
    const { track, commands, start } = shown;
    const line = lineOf(this.record, shown.end);
    context.beginPath();
    track.trace(context, view);
    context.strokeStyle = "rgb(255 255 255 / 85%)";
    context.lineWidth = 5.5;
    context.stroke();
    context.globalAlpha = 0.55;
    strokeTrack(context, view, track, line, 1.6);
    context.globalAlpha = 1;
    strokeTrack(context, view, track, line, 3, this.time_s);
    this.drawSteps(context, view);
    const at = track.count > 0 ? track.poseAt(this.time_s) : start;
    if (track.count > 0) {
      const k = this.at();
      drawCommand(context, view, at, commands[k]);
      drawEnd(context, view, track.pose(track.count - 1, track.length_m[track.count - 1]), line.color);
    }
    drawVehicle(context, view, at, line.color, 11);
  }

  /** A dot where each step begins, when they can be told apart. */
  private drawSteps(context: CanvasRenderingContext2D, view: Viewport): void {
    const { track } = this.shown!;
    const apart_px = track.duration_s * track.speed_mps / Math.max(1, track.count) * view.scale;
    if (apart_px < 5) return;
    context.fillStyle = "#22262b";
    for (let k = 1; k < track.count; ++k) {
      const [x, y] = view.toScreen(track.x[k], track.y[k]);
      context.beginPath();
      context.arc(x, y, 1.8, 0, 2 * Math.PI);
      context.fill();
    }
  }
}

/** The command in force, where it is from, and which way it points. */
function drawCommand(context: CanvasRenderingContext2D, view: Viewport, at: Pose, command: { rad: number; x: number; y: number }): void {
  const [x, y] = view.toScreen(at.x, at.y);
  const [cx, cy] = view.toScreen(command.x, command.y);
  const ux = Math.cos(command.rad), uy = -Math.sin(command.rad);
  for (const [color, width] of [["rgb(255 255 255 / 85%)", 4], ["#22262b", 1.5]] as const) {
    context.strokeStyle = color;
    context.lineWidth = width;
    context.beginPath();
    if (Math.hypot(cx - x, cy - y) > 3) {
      context.moveTo(x, y); context.lineTo(cx, cy);
    }
    context.moveTo(cx, cy); context.lineTo(cx + 20 * ux, cy + 20 * uy);
    context.lineTo(cx + 20 * ux - 6 * ux - 3 * uy, cy + 20 * uy - 6 * uy + 3 * ux);
    context.moveTo(cx + 20 * ux, cy + 20 * uy);
    context.lineTo(cx + 20 * ux - 6 * ux + 3 * uy, cy + 20 * uy - 6 * uy - 3 * ux);
    context.stroke();
  }
}

/** A cross in a ring: here it fails. */
function drawEnd(context: CanvasRenderingContext2D, view: Viewport, at: Pose, color: string): void {
  const [x, y] = view.toScreen(at.x, at.y);
  for (const [stroke, width] of [["rgb(255 255 255 / 90%)", 5], [color, 2.4]] as const) {
    context.beginPath();
    context.arc(x, y, 10, 0, 2 * Math.PI);
    context.moveTo(x - 5, y - 5); context.lineTo(x + 5, y + 5);
    context.moveTo(x - 5, y + 5); context.lineTo(x + 5, y - 5);
    context.strokeStyle = stroke;
    context.lineWidth = width;
    context.stroke();
  }
}
