// The engine behind the page, when `fairway view` serves it: a place and a heading are flown and
// judged at once, and a pose is steered to.
import { byId, degrees, el, headingWords, short } from "./dom";
import { drawVehicle, lineOf, strokeTrack, Track, type Pose } from "./flights";
import type { PageRecord } from "./record";
import type { Viewport } from "./viewport";

type Piece = [number, number, number, number, number];
interface FlightAnswer { outcome: string; time_s: number | null; length_m: number | null; cut: boolean; pieces: Piece[]; leg?: SteerAnswer }
interface StateAnswer { verdict: string | null; time_bound_s: number | null; flight: FlightAnswer }
interface SteerAnswer { state: string; word: string; length_m: number; time_s: number; pieces: Piece[]; shortest?: { word: string; length_m: number; pieces: Piece[] } }
type Mode = "look" | "fly" | "steer";

export interface Live {
  draw(context: CanvasRenderingContext2D, view: Viewport): void;
  /** A press at a place: true when it is meant for a state, and the map must not pan. */
  takes(place: [number, number], view: Viewport): boolean;
  drags(place: [number, number], view: Viewport): boolean;
  releases(): void;
  flyFrom(place: [number, number], heading_rad: number): void;
}

interface Page { redraw(): void; heading(): number; turnTo(rad: number): void }

class NotAnswered extends Error {}

async function asked<T>(question: string, parameters: Record<string, number> = {}): Promise<T> {
  const query = Object.entries(parameters).map(([name, value]) => `${name}=${value}`).join("&");
  const response = await fetch(`api/${question}${query ? "?" + query : ""}`, { cache: "no-store" });
  const answer = await response.json();
  if (!response.ok) throw new NotAnswered(String(answer.error ?? response.status));
  return answer as T;
}

/** Asks one question at a time: of those that come meanwhile only the last. */
class Latest {
  private running = false;
  private next: (() => Promise<void>) | null = null;

  async ask(question: () => Promise<void>): Promise<void> {
    this.next = question;
    if (this.running) return;
    this.running = true;
    while (this.next) {
      const now: () => Promise<void> = this.next;
      this.next = null;
      await now();
    }
    this.running = false;
  }
}

class LiveTool implements Live {
  private mode: Mode = "fly";
  private start: Pose | null = null;
  private goal: Pose | null = null;
  private held: "start" | "goal" | null = null;
  private pressed: [number, number] = [0, 0];
  private turned = false;
  private track: Track | null = null;
  private leg: Track | null = null;
  private outcome = "reach";  // whose line the track has
  private readonly latest = new Latest();
  private readonly answer = el("div", { class: "answer", "aria-live": "polite" });
  private readonly fields = new Map<string, HTMLInputElement>();
  private readonly buttons = new Map<Mode, HTMLButtonElement>();
  private readonly goal_fields: HTMLElement[] = [];

  constructor(private readonly record: PageRecord, private readonly page: Page) {
    const modes = el("div", { class: "modes", role: "group", "aria-label": "What a press on the map does" });
    for (const [mode, words] of [["fly", "Fly from here"], ["steer", "Steer to a pose"], ["look", "Pan"]] as [Mode, string][]) {
      const button = el("button", { type: "button" }, words);
      button.addEventListener("click", () => this.setMode(mode));
      this.buttons.set(mode, button);
      modes.append(button);
    }
    const form = el("form", { "aria-label": "State by numbers" });
    for (const [name, words] of [["x", "x, m"], ["y", "y, m"], ["h", "heading, °"], ["to_x", "to x, m"], ["to_y", "to y, m"], ["to_h", "to heading, °"]]) {
      const input = el("input", { inputmode: "decimal", autocomplete: "off", name });
      this.fields.set(name, input);
      const label = el("label", {}, words, input);
      if (name.startsWith("to_")) this.goal_fields.push(label);
      form.append(label);
    }
    form.append(el("button", { type: "submit" }, "Answer"));
    form.addEventListener("submit", (event) => { event.preventDefault(); this.takeForm(); });
    byId("live").replaceChildren(el("h3", {}, "Live"), modes, form, this.answer);
    byId("live").hidden = false;
    this.setMode("fly");
  }

  private setMode(mode: Mode): void {
    this.mode = mode;
    this.buttons.forEach((button, name) => button.setAttribute("aria-pressed", String(name === mode)));
    this.goal_fields.forEach((label) => { label.hidden = mode !== "steer"; });
    const words = { fly: "Press on the map and drag to where the vehicle looks.",
      steer: this.start ? "Press where it shall go, and drag to its heading there." : "First fly from somewhere: that is where steering starts.",
      look: "Drag to pan." };
    this.answer.replaceChildren(words[mode]);
    this.track = this.leg = null;
    if (mode !== "look") this.ask();
    this.page.redraw();
  }

  private static near(pose: Pose | null, place: [number, number], view: Viewport): boolean {
    return pose !== null && Math.hypot(pose.x - place[0], pose.y - place[1]) * view.scale < 14;
  }

  takes(place: [number, number], view: Viewport): boolean {
    if (this.mode === "look") return false;
    const grabs_start = this.mode === "steer" && LiveTool.near(this.start, place, view);
    this.held = this.mode === "fly" || grabs_start || !this.start ? "start" : "goal";
    const now = this.held === "start" ? this.start : this.goal;
    this.pressed = place;
    this.turned = false;
    this.set(this.held, { x: place[0], y: place[1], h: now?.h ?? this.page.heading() });
    return true;
  }

  drags(place: [number, number], view: Viewport): boolean {
    if (!this.held) return false;
    const dx = place[0] - this.pressed[0], dy = place[1] - this.pressed[1];
    if (!this.turned && Math.hypot(dx, dy) * view.scale < 8) return true;
    this.turned = true;
    this.set(this.held, { x: this.pressed[0], y: this.pressed[1], h: Math.atan2(dy, dx) });
    return true;
  }

  releases(): void {
    if (this.held === "start" && this.turned && this.start) this.page.turnTo(this.start.h);
    this.held = null;
  }

  flyFrom(place: [number, number], heading_rad: number): void {
    if (this.mode !== "fly") this.setMode("fly");
    this.set("start", { x: place[0], y: place[1], h: heading_rad });
  }

  private set(which: "start" | "goal", pose: Pose): void {
    if (which === "start") this.start = pose; else this.goal = pose;
    const prefix = which === "start" ? "" : "to_";
    const round = (value: number) => String(Math.round(value * 100) / 100);
    this.fields.get(prefix + "x")!.value = round(pose.x);
    this.fields.get(prefix + "y")!.value = round(pose.y);
    this.fields.get(prefix + "h")!.value = round(degrees(pose.h));
    this.ask();
    this.page.redraw();
  }

  private takeForm(): void {
    const read = (prefix: string): Pose | null => {
      const [x, y, h] = ["x", "y", "h"].map((name) => {
        const text = this.fields.get(prefix + name)!.value.trim().replace("−", "-");
        return text === "" ? NaN : Number(text);
      });
      return [x, y, h].every(Number.isFinite) ? { x, y, h: h * Math.PI / 180 } : null;
    };
    const start = read("");
    const goal = this.mode === "steer" ? read("to_") : null;
    if (!start || (this.mode === "steer" && !goal)) {
      this.answer.replaceChildren("Three decimal numbers are wanted: metres, metres, degrees.");
      return;
    }
    if (this.mode === "look") this.setMode("fly");
    if (goal) this.goal = goal;
    this.set("start", start);
  }

  private trackOf(pieces: Piece[]): Track {
    const column = (k: number) => Float64Array.from(pieces, (piece) => piece[k]);
    return new Track(column(0), column(1), column(2), column(3), column(4), 0, 0, this.record.vehicle.speed_mps);
  }

  private ask(): void {
    const { start, goal, mode } = this;
    if (!start || (mode === "steer" && !goal)) return;
    void this.latest.ask(async () => {
      const begin = performance.now();
      try {
        if (mode === "steer") this.showSteer(await asked<SteerAnswer>("steer", { x: start.x, y: start.y, h: start.h, to_x: goal!.x, to_y: goal!.y, to_h: goal!.h }), begin);
        else this.showState(await asked<StateAnswer>("state", { x: start.x, y: start.y, h: start.h }), begin);
      } catch (error) {
        this.track = this.leg = null;
        this.answer.replaceChildren(error instanceof NotAnswered ? error.message : "The engine does not answer: fairway view has ended.");
      }
      this.page.redraw();
    });
  }

  private showState(answer: StateAnswer, begin: number): void {
    const { flight } = answer;
    this.track = this.trackOf(flight.pieces);
    this.leg = flight.leg && flight.leg.pieces.length > 0 ? this.trackOf(flight.leg.pieces) : null;
    this.outcome = flight.outcome;
    const verdict = answer.verdict === null ? "no certificate" : answer.verdict === "undecided" ? "undecided" : `proved: ${answer.verdict}`;
    const parts: (Node | string)[] = [el("b", {}, verdict)];
    if (answer.time_bound_s !== null) parts.push(` within ${answer.time_bound_s.toFixed(1)} s`);
    parts.push(el("br"), `flown: ${flight.outcome}` +
      (flight.time_s === null ? "" : ` after ${flight.time_s.toFixed(1)} s, ${Math.round(flight.length_m!)} m`) + (flight.cut ? " (line cut short)" : ""));
    if (flight.leg) parts.push(el("br"), flight.leg.pieces.length > 0 ? `then ${flight.leg.word}, ${Math.round(flight.leg.length_m)} m, to its heading` : "then no clear way to its heading");
    parts.push(this.took(begin));
    this.answer.replaceChildren(...parts);
  }

  private showSteer(answer: SteerAnswer, begin: number): void {
    const shortest = answer.shortest!;
    const none = answer.state === "none_clear";
    this.track = this.trackOf(none ? shortest.pieces : answer.pieces);
    this.leg = null;
    this.outcome = none ? "collide" : "reach";
    const parts: (Node | string)[] = !none
      ? [el("b", {}, `${answer.word}, ${short(answer.length_m)} m`), ` in ${answer.time_s.toFixed(1)} s`, el("br"),
        answer.state === "shortest" ? "the shortest path; it touches no obstacle" : `clear of obstacles; the shortest, ${shortest.word} of ${short(shortest.length_m)} m, is not`]
      : [el("b", {}, "no clear way found"), el("br"), `the shortest, ${shortest.word} of ${short(shortest.length_m)} m, touches an obstacle, and so did every other tried`];
    parts.push(this.took(begin));
    this.answer.replaceChildren(...parts);
  }

  private took(begin: number): HTMLElement {
    const ms = performance.now() - begin;
    byId("live").dataset.answeredMs = ms.toFixed(2);
    return el("small", {}, `answered in ${ms.toFixed(ms < 10 ? 1 : 0)} ms, heading ${headingWords(this.start!.h)}`);
  }

  draw(context: CanvasRenderingContext2D, view: Viewport): void {
    for (const track of [this.track, this.leg]) {
      if (!track || this.mode === "look") continue;
      context.beginPath();
      track.trace(context, view);
      context.strokeStyle = "rgb(255 255 255 / 85%)";
      context.lineWidth = 5.5;
      context.stroke();
      strokeTrack(context, view, track, lineOf(this.record, this.outcome), 2.6);
    }
    if (this.goal && this.mode === "steer") drawVehicle(context, view, this.goal, "#00694b", 11);
    if (this.start && this.mode !== "look") drawVehicle(context, view, this.start, "#16202c", 11);
  }
}

/** The live tool when this page is served by `fairway view`, else nothing. */
export async function connect(record: PageRecord, page: Page): Promise<Live | null> {
  if (!/^http:$/.test(location.protocol) || !["127.0.0.1", "localhost"].includes(location.hostname)) return null;
  let info: { live?: boolean; plan_sha256?: Record<string, string> };
  try {
    info = await asked("info");
  } catch {
    return null;
  }
  if (!info.live) return null;
  const shown = record.summary.verify?.plan_sha256;
  if (shown && JSON.stringify(shown) !== JSON.stringify(info.plan_sha256)) {
    const trouble = byId("trouble");
    trouble.textContent = "The plan in this folder is another one than this page shows: live answers would not fit it.";
    trouble.hidden = false;
    return null;
  }
  return new LiveTool(record, page);
}
