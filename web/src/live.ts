// The live part of the page, when `fairway view` serves it: checks and flies any state at once,
// steers to a pose, and moves the goal.
import { byId, degrees, el, short, turnOf } from "./dom";
import { bearingWords, earthWords } from "./earth";
import { drawVehicle, lineOf, strokeTrack, Track, type Pose } from "./flights";
import { MovedGoal, type PlanView } from "./moved_goal";
import { modeWords, type PageRecord } from "./record";
import { linkable, writeLink, type LinkedState } from "./state_link";
import type { Viewport } from "./viewport";
import { verdictNames } from "./whose";
import type { Witness } from "./witness";

type Piece = [number, number, number, number, number];
interface FlightAnswer { outcome: string; time_s: number | null; length_m: number | null; cut: boolean; pieces: Piece[]; leg?: SteerAnswer }
type WitnessStep = [...Piece, number, number, number];  // and the command in force: heading, place
interface ContractAnswer { verdict: string; time_bound_s: number | null; mode?: number; witness: { end: string; steps: WitnessStep[] } | null }
interface StateAnswer { verdict: string | null; time_bound_s: number | null; mode?: number; flight: FlightAnswer; contract: ContractAnswer | null }
interface SteerAnswer { state: string; word: string; length_m: number; time_s: number; pieces: Piece[]; shortest?: { word: string; length_m: number; pieces: Piece[] } }
type Mode = "look" | "fly" | "steer" | "goal";
type Held = "start" | "target" | "goal";

export interface Live {
  draw(context: CanvasRenderingContext2D, view: Viewport): void;
  /** A press at a place: true when it sets a state, so that the map must not pan. */
  takes(place: [number, number], view: Viewport): boolean;
  drags(place: [number, number], view: Viewport): boolean;
  releases(): void;
  flyFrom(place: [number, number], heading_rad: number): void;
  /** A state, and a goal, that a link names. */
  goTo(state: LinkedState): Promise<void>;
}

interface Page extends PlanView { showWitness(witness: Witness | null): void; redrawMarks(): void; heading_rad(): number; turnTo(rad: number): void; crossTo(place: [number, number]): void }
interface Info { live?: boolean; plan_sha256?: Record<string, string>; replan?: boolean; replan_refused?: string | null }

class NotAnswered extends Error {}

async function asked<T>(question: string, parameters: Record<string, number> = {}): Promise<T> {
  const query = Object.entries(parameters).map(([name, value]) => `${name}=${value}`).join("&");
  const response = await fetch(`api/${question}${query ? "?" + query : ""}`, { cache: "no-store" });
  const answer = await response.json();
  if (!response.ok) throw new NotAnswered(String(answer.error ?? response.status));
  return answer as T;
}

/** Asks one question at a time; of those that arrive meanwhile, only the last. */
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
  private target: Pose | null = null;
  private held: Held | null = null;
  private pressed: [number, number] = [0, 0];
  private turned = false;
  private track: Track | null = null;
  private leg: Track | null = null;
  private outcome = "reach";  // whose line the track has
  private readonly latest = new Latest();
  private readonly goals = new Latest();
  private readonly answer = el("div", { class: "answer", "aria-live": "polite" });
  private readonly fields = new Map<string, HTMLInputElement>();
  private readonly buttons = new Map<Mode, HTMLButtonElement>();
  private readonly moved: MovedGoal;
  private place: [number, number] | null = null;  // of the goal while it is dragged

  constructor(private readonly record: PageRecord, private readonly page: Page, info: Info) {
    this.moved = new MovedGoal(record, asked, page, () => { this.link(); this.ask(); });
    const modes = el("div", { class: "modes", role: "group", "aria-label": "What a click on the map does" });
    for (const [mode, words] of [["fly", "Fly from here"], ["steer", "Steer to a pose"], ["goal", "Move the goal"], ["look", "Pan"]] as [Mode, string][]) {
      const kept = mode === "goal" && !info.replan;
      const button = el("button", { type: "button", disabled: kept, title: kept ? info.replan_refused ?? undefined : undefined }, words);
      button.addEventListener("click", () => this.setMode(mode));
      this.buttons.set(mode, button);
      modes.append(button);
    }
    const form = el("form", { "aria-label": "Enter a state" });
    for (const [name, words] of [["x", "x, m"], ["y", "y, m"], ["h", "heading, °"], ["to_x", "to x, m"], ["to_y", "to y, m"], ["to_h", "to heading, °"], ["goal_x", "goal x, m"], ["goal_y", "goal y, m"]]) {
      const input = el("input", { inputmode: "decimal", autocomplete: "off", name });
      this.fields.set(name, input);
      form.append(el("label", {}, words, input));
    }
    form.append(el("button", { type: "submit" }, "Go"));
    form.addEventListener("submit", (event) => { event.preventDefault(); this.takeForm(); });
    byId("live").replaceChildren(el("h3", {}, "Live"), modes, form, this.answer);
    byId("live").hidden = false;
    this.setMode("fly");
  }

  private setMode(mode: Mode): void {
    this.mode = mode;
    this.buttons.forEach((button, name) => button.setAttribute("aria-pressed", String(name === mode)));
    this.fields.forEach((input, name) => {
      const of = name.startsWith("to_") ? ["steer"] : name.startsWith("goal_") ? ["goal"] : ["fly", "steer", "look"];
      input.parentElement!.hidden = !of.includes(mode);
    });
    const words = { fly: "Click the map and drag to set the heading.",
      steer: this.start ? "Click the pose to reach and drag to set its heading." : "Fly from somewhere first: steering starts there.",
      goal: "Click where the goal should be, or drag it: the plan is remade at once.",
      look: "Drag to pan." };
    this.answer.replaceChildren(words[mode]);
    this.track = this.leg = null;
    this.page.showWitness(null);
    if (mode === "goal" && this.record.mission.kind === "goal") this.fill("goal_", this.record.mission.goal_m);
    if (mode === "fly" || mode === "steer") this.ask();
    this.page.redrawMarks();
  }

  private static near(pose: Pose | null, place: [number, number], view: Viewport): boolean {
    return pose !== null && Math.hypot(pose.x - place[0], pose.y - place[1]) * view.scale < 14;
  }

  takes(place: [number, number], view: Viewport): boolean {
    if (this.mode === "look") return false;
    this.pressed = place;
    this.turned = false;
    if (this.mode === "goal") {
      this.held = "goal";
      this.moveGoal(place);
      return true;
    }
    const grabs_start = this.mode === "steer" && LiveTool.near(this.start, place, view);
    this.held = this.mode === "fly" || grabs_start || !this.start ? "start" : "target";
    const now = this.held === "start" ? this.start : this.target;
    this.set(this.held, { x: place[0], y: place[1], h: now?.h ?? this.page.heading_rad() });
    return true;
  }

  drags(place: [number, number], view: Viewport): boolean {
    if (!this.held) return false;
    if (this.held === "goal") {
      this.moveGoal(place);
      return true;
    }
    const dx = place[0] - this.pressed[0], dy = place[1] - this.pressed[1];
    if (!this.turned && Math.hypot(dx, dy) * view.scale < 8) return true;
    this.turned = true;
    this.set(this.held, { x: this.pressed[0], y: this.pressed[1], h: Math.atan2(dy, dx) });
    return true;
  }

  releases(): void {
    if (this.held) this.link();
    this.held = null;
  }

  flyFrom(place: [number, number], heading_rad: number): void {
    if (this.mode !== "fly") this.setMode("fly");
    this.set("start", { x: place[0], y: place[1], h: heading_rad });
    this.link();
  }

  async goTo(state: LinkedState): Promise<void> {
    if (state.goal && String(state.goal) !== String(this.moved.goal)) {
      await this.goals.ask(() => this.moved.moveTo(state.goal!, this.answer).catch((error) => this.tellError(error)));
    } else if (!state.goal && this.moved.goal) {
      this.moved.back();
    }
    this.flyFrom([state.x, state.y], state.h);
  }

  /** The state, and the goal where it was moved, into the page's address. */
  private link(): void {
    if (this.start) writeLink({ ...this.start, goal: this.moved.goal });
  }

  private set(which: "start" | "target", given: Pose): void {
    const pose = linkable(this.record.grid, given);
    if (which === "start") {
      this.start = pose;
      // The map then shows the heading asked for, so the colour under the arrow matches the answer.
      this.page.turnTo(pose.h);
      this.page.crossTo([pose.x, pose.y]);
    } else {
      this.target = pose;
    }
    this.fill(which === "start" ? "" : "to_", [pose.x, pose.y, degrees(pose.h)]);
    this.ask();
    this.page.redrawMarks();
  }

  private fill(prefix: string, values: number[]): void {
    values.forEach((value, k) => {
      this.fields.get(prefix + "xyh"[k])!.value = String(k === 2 ? Math.round(value * 100) / 100 % 360 : value);
    });
  }

  private moveGoal(place: [number, number]): void {
    const { x, y } = linkable(this.record.grid, { x: place[0], y: place[1], h: 0 });
    this.place = [x, y];
    this.fill("goal_", [x, y]);
    void this.goals.ask(async () => {
      try {
        await this.moved.moveTo([x, y], this.answer);
      } catch (error) {
        this.tellError(error);
      }
    });
    this.page.redrawMarks();
  }

  private read(names: string[]): number[] | null {
    const values = names.map((name) => {
      const text = this.fields.get(name)!.value.trim().replace("−", "-");
      return text === "" ? NaN : Number(text);
    });
    return values.every(Number.isFinite) ? values : null;
  }

  private takeForm(): void {
    if (this.mode === "goal") {
      const place = this.read(["goal_x", "goal_y"]);
      if (place) this.moveGoal([place[0], place[1]]);
      else this.answer.replaceChildren("Enter two decimal numbers: x (m), y (m).");
      return;
    }
    const start = this.read(["x", "y", "h"]);
    const target = this.mode === "steer" ? this.read(["to_x", "to_y", "to_h"]) : null;
    if (!start || (this.mode === "steer" && !target)) {
      this.answer.replaceChildren("Enter three decimal numbers: x (m), y (m), heading (°).");
      return;
    }
    if (this.mode === "look") this.setMode("fly");
    const pose = ([x, y, h]: number[]): Pose => ({ x, y, h: turnOf(h) });
    if (target) this.target = linkable(this.record.grid, pose(target));
    this.set("start", pose(start));
    this.link();
  }

  private tellError(error: unknown): void {
    this.track = this.leg = null;
    this.page.showWitness(null);
    this.answer.replaceChildren(error instanceof NotAnswered ? error.message : "No answer: is `fairway view` still running?");
    this.page.redrawMarks();
  }

  private trackOf(pieces: Piece[]): Track {
    const column = (k: number) => Float64Array.from(pieces, (piece) => piece[k]);
    return new Track(column(0), column(1), column(2), column(3), column(4), 0, 0, this.record.vehicle.speed_mps);
  }

  private ask(): void {
    const { start, target, mode } = this;
    if (!start || (mode === "steer" && !target)) return;
    const { x, y, h } = start;
    void this.latest.ask(async () => {
      const begin = performance.now();
      try {
        if (mode === "steer") this.showSteer(await asked<SteerAnswer>("steer", { x, y, h, to_x: target!.x, to_y: target!.y, to_h: target!.h }), start, begin);
        else this.showState(await asked<StateAnswer>("state", { x, y, h, ...this.moved.parameters }), start, begin);
      } catch (error) {
        this.tellError(error);
      }
      this.page.redrawMarks();
    });
  }
  private showState(answer: StateAnswer, pose: Pose, begin: number): void {
    const { flight } = answer;
    const names = verdictNames(this.record);
    this.track = this.trackOf(flight.pieces);
    this.leg = flight.leg && flight.leg.pieces.length > 0 ? this.trackOf(flight.leg.pieces) : null;
    this.outcome = flight.outcome;
    const verdict = answer.verdict === null ? this.moved.goal ? "not proved" : "no certificate" : answer.verdict === "undecided" ? "undecided" : `proved: ${answer.verdict === "reach" ? names.reach[0] : answer.verdict}`;
    const parts: (Node | string)[] = [el("b", {}, verdict)];
    if (answer.verdict === null && this.moved.goal) parts.push(": this plan has not been verified");
    if (answer.time_bound_s !== null) parts.push(` within ${answer.time_bound_s.toFixed(1)} s`);
    if (answer.mode !== undefined && answer.verdict === "reach") parts.push(`, in ${modeWords(this.record, answer.mode)}`);
    if (answer.contract) {
      parts.push(el("br"), ...contractWords(answer.contract, names.after));
      const { mode, verdict } = answer.contract;
      if (mode !== undefined && verdict === "reach") parts.push(`, in ${modeWords(this.record, mode)}`);
    }
    this.page.showWitness(answer.contract?.witness ? this.witnessOf(pose, answer.contract.witness) : null);
    parts.push(el("br"), `flown: ${flight.outcome}` +
      (flight.time_s === null ? "" : ` after ${flight.time_s.toFixed(1)} s, ${Math.round(flight.length_m!)} m`) + (flight.cut ? " (line cut short)" : ""));
    if (flight.leg) parts.push(el("br"), flight.leg.pieces.length > 0 ? `then ${flight.leg.word}, ${Math.round(flight.leg.length_m)} m, to the goal heading` : "then no clear way to the goal heading");
    parts.push(this.took(pose, begin));
    this.answer.replaceChildren(...parts);
  }

  private witnessOf(start: Pose, { end, steps }: { end: string; steps: WitnessStep[] }): Witness {
    const track = this.trackOf(steps.map((step) => step.slice(0, 5) as Piece));
    return { start, end, track, commands: steps.map(([, , , , , rad, x, y]) => ({ rad, x, y })) };
  }

  private showSteer(answer: SteerAnswer, pose: Pose, begin: number): void {
    const shortest = answer.shortest!;
    const none = answer.state === "none_clear";
    this.track = this.trackOf(none ? shortest.pieces : answer.pieces);
    this.leg = null;
    this.outcome = none ? "collide" : "reach";
    const parts: (Node | string)[] = !none
      ? [el("b", {}, `${answer.word}, ${short(answer.length_m)} m`), ` in ${answer.time_s.toFixed(1)} s`, el("br"),
        answer.state === "shortest" ? "the shortest path; it touches no obstacle" : `clear of obstacles; the shortest, ${shortest.word} of ${short(shortest.length_m)} m, is not`]
      : [el("b", {}, "no clear way found"), el("br"), `the shortest, ${shortest.word} of ${short(shortest.length_m)} m, touches an obstacle, and so does every other path tried`];
    parts.push(this.took(pose, begin));
    this.answer.replaceChildren(...parts);
  }

  /** `pose`: the state that the answer is of; another one may have been entered since. */
  private took({ x, y, h }: Pose, begin: number): HTMLElement {
    const ms = performance.now() - begin;
    byId("live").dataset.answeredMs = ms.toFixed(2);
    byId("live").dataset.answeredFor = `${x} ${y} ${(h * 180 / Math.PI).toFixed(1)}`;
    const earth = earthWords(this.record, [x, y]);
    return el("small", {}, `heading ${bearingWords(this.record, h)}`, el("br"), ...(earth ? [`at ${earth}`, el("br")] : []),
      `answered in ${ms.toFixed(ms < 10 ? 1 : 0)} ms`);
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
    if (this.target && this.mode === "steer") drawVehicle(context, view, this.target, "#00694b", 11);
    if (this.place && this.held === "goal") drawGoalHeld(context, view, this.place);
    if (this.start && this.mode !== "look") drawVehicle(context, view, this.start, "#16202c", 11);
  }
}

/** "under the contract proved: reach within 80.1 s". */
function contractWords({ verdict, time_bound_s }: ContractAnswer, after: string): (Node | string)[] {
  const words = verdict === "at_risk" ? "at risk" : verdict === "undecided" ? "undecided" : `proved: ${verdict}`;
  return [`${after} `, el("b", {}, words), time_bound_s === null ? "" : ` within ${time_bound_s.toFixed(1)} s`];
}

function drawGoalHeld(context: CanvasRenderingContext2D, view: Viewport, place: [number, number]): void {
  const [x, y] = view.toScreen(...place);
  for (const [color, width] of [["rgb(255 255 255 / 90%)", 5], ["#00694b", 2]] as const) {
    context.beginPath();
    context.arc(x, y, 9, 0, 2 * Math.PI);
    context.strokeStyle = color;
    context.lineWidth = width;
    context.stroke();
  }
}

/** The live tool when `fairway view` serves this page, else null. */
export async function connect(record: PageRecord, page: Page): Promise<Live | null> {
  if (!/^http:$/.test(location.protocol) || !["127.0.0.1", "localhost"].includes(location.hostname)) return null;
  let info: Info;
  try {
    info = await asked("info");
  } catch {
    return null;
  }
  if (!info.live) return null;
  const shown = record.summary.verify?.plan_sha256;
  if (shown && JSON.stringify(shown) !== JSON.stringify(info.plan_sha256)) {
    const trouble = byId("trouble");
    trouble.textContent = "This folder's plan differs from the one on this page; live answers would not match.";
    trouble.hidden = false;
    return null;
  }
  return new LiveTool(record, page, info);
}
