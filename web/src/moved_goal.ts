// A goal moved on the live page: its plan is shown at once, and nothing about it is proved.
import { Arrays } from "./arrays";
import { byId, el, percent, short } from "./dom";
import { fieldOf } from "./field_arrays";
import type { FieldArrays } from "./overlay";
import type { Mission, PageRecord, VerdictInfo } from "./record";

export type Ask = <T>(question: string, parameters?: Record<string, number>) => Promise<T>;

interface PlanAnswer { refused: string | null; verified: boolean; mission: Mission; cost_step_m: number; arrays: string }
interface ProofAnswer { volume_fraction: Record<string, number>; stopped_by: string; verdicts: VerdictInfo; arrays: string }

/** What the map shows instead of the run's own plan. */
export interface MovedPlan { mission: Mission; cost_step_m: number; field: FieldArrays }

export interface PlanView {
  showMoved(plan: MovedPlan): void;
  showProof(info: VerdictInfo, arrays: Arrays): Promise<void>;
  showOwn(): void;
}

const reasons: Record<string, string> = {
  undecided_max: "just now", time_limit: "for five seconds", memory_limit: "up to its memory limit",
  last_level: "to the finest level", stalled: "until no further progress was made" };

/** Other places that a refusal names, "[x, y]". */
export function placesIn(message: string, but: [number, number]): [number, number][] {
  const found = [...message.matchAll(/\[(-?[\d.e+-]+), (-?[\d.e+-]+)\]/g)].map(([, x, y]) => [Number(x), Number(y)] as [number, number]);
  return found.filter(([x, y], k) => Number.isFinite(x) && Number.isFinite(y) && Math.hypot(x - but[0], y - but[1]) > 0.01 &&
    found.findIndex(([a, b]) => a === x && b === y) === k);
}

export class MovedGoal {
  /** Where it is; null: the run's own goal. */
  goal: [number, number] | null = null;
  private asked = 0;

  constructor(private readonly record: PageRecord, private readonly ask: Ask, private readonly view: PlanView,
    private readonly changed: () => void) {}

  get parameters(): Record<string, number> { return this.goal ? { goal_x: this.goal[0], goal_y: this.goal[1] } : {}; }

  /** Replans; when the goal does not fit, explains why and keeps the plan shown. */
  async moveTo(goal: [number, number], box: HTMLElement): Promise<void> {
    const asked = ++this.asked;
    const answer = await this.ask<PlanAnswer>("replan", { goal_x: goal[0], goal_y: goal[1] });
    if (asked !== this.asked) return;
    if (answer.refused !== null) {
      this.tellRefusal(answer.refused, goal, box);
      return;
    }
    const field = await fieldOf(new Arrays(answer.arrays));
    if (asked !== this.asked) return;
    this.goal = goal;
    this.view.showMoved({ mission: answer.mission, cost_step_m: answer.cost_step_m, field });
    if (answer.verified) return this.verify();  // what the server remembers
    this.tell("Not proved: this plan has not been verified.", this.verifyButton());
    box.replaceChildren(el("b", {}, `goal at ${short(goal[0])}, ${short(goal[1])}`), el("br"), "replanned; not proved: this plan has not been verified");
    this.changed();
  }

  back(): void {
    ++this.asked;
    this.goal = null;
    byId("withdrawn").hidden = true;
    delete document.documentElement.dataset.moved;
    this.view.showOwn();
    this.changed();
  }

  private tellRefusal(message: string, goal: [number, number], box: HTMLElement): void {
    const places = placesIn(message, goal).map((place) => {
      const button = el("button", { type: "button" }, `Move it to ${short(place[0])}, ${short(place[1])}`);
      button.addEventListener("click", () => void this.moveTo(place, box));
      return button;
    });
    box.replaceChildren(el("b", {}, "The goal does not fit there"), el("br"), `${message}.`, ...(places.length > 0 ? [el("br"), ...places] : []));
  }

  private verifyButton(): HTMLElement {
    const button = el("button", { type: "button", id: "verify-moved" }, "Verify for up to 5 s");
    button.addEventListener("click", () => void this.verify());
    return button;
  }

  private tell(words: string, ...more: HTMLElement[]): void {
    const back = el("button", { type: "button", id: "goal-back" }, "Back to the run's goal");
    back.addEventListener("click", () => this.back());
    byId("withdrawn").replaceChildren(
      el("p", {}, el("b", {}, `The goal was moved to ${short(this.goal![0])}, ${short(this.goal![1])}. ${words}`),
        " Figures and text elsewhere on this page are still for the run's own goal."),
      el("div", {}, ...more, back));
    byId("withdrawn").hidden = false;
    document.documentElement.dataset.moved = "";
  }

  private async verify(): Promise<void> {
    const asked = ++this.asked;
    this.tell("Not proved yet: verifying.");
    try {
      const proof = await this.ask<ProofAnswer>("proof", this.parameters);
      if (asked !== this.asked) return;
      await this.view.showProof(proof.verdicts, new Arrays(proof.arrays));
      const { reach, failing, undecided } = this.record.codes;
      const share = (...codes: number[]) => percent(codes.reduce((sum, code) => sum + (proof.volume_fraction[this.record.styles.verdict[code].name] ?? 0), 0), 1);
      this.tell(`Verified ${reasons[proof.stopped_by] ?? proof.stopped_by}: of all states ${share(...failing)} are proved to fail, ` +
        `${share(undecided)} are undecided, ${share(reach)} are proved to reach. No other program has checked this proof, and it is not kept.`);
    } catch (error) {
      if (asked !== this.asked) return;
      this.tell(`Not proved: ${error instanceof Error ? error.message : String(error)}.`, this.verifyButton());
    }
    this.changed();
  }
}
