// A state in the page's address: #x=METRES&y=METRES&h=HEADING, radians, or degrees with the suffix
// deg as on the command line; and &goal_x=...&goal_y=... for a goal that was moved.
import { degrees, turnOf } from "./dom";
import type { GridShape } from "./record";

export interface LinkedState { x: number; y: number; h: number; goal: [number, number] | null }

/** As many decimals as it takes to resolve a thousandth of a cell. */
export function decimalsOf(grid: GridShape): number {
  return Math.min(Math.max(3 - Math.floor(Math.log10(grid.cell_m)), 2), 8);
}

/** A state rounded as its link will be, so that what is shown, asked and linked to is the same. */
export function linkable<Pose extends { x: number; y: number; h: number }>(grid: GridShape, pose: Pose): Pose {
  const round = (value: number) => Number(value.toFixed(decimalsOf(grid)));
  return { ...pose, x: round(pose.x), y: round(pose.y), h: turnOf(Math.round(degrees(pose.h) * 100) / 100) };
}

function numberOf(text: string | null): number | null {
  return text !== null && /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(text) && Number.isFinite(Number(text)) ? Number(text) : null;
}

export function stateOfHash(hash: string): LinkedState | null {
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const turn = given.get("h") ?? "0";
  const in_degrees = turn.endsWith("deg");
  const h = numberOf(in_degrees ? turn.slice(0, -3) : turn);
  const [x, y, goal_x, goal_y] = ["x", "y", "goal_x", "goal_y"].map((name) => numberOf(given.get(name)));
  if (x === null || y === null || h === null) return null;
  return { x, y, h: in_degrees ? turnOf(h) : h, goal: goal_x === null || goal_y === null ? null : [goal_x, goal_y] };
}

export function hashOf(state: LinkedState): string {
  const turn = Math.round(degrees(state.h) * 100) / 100 % 360;
  return `#x=${state.x}&y=${state.y}&h=${turn}deg` + (state.goal ? `&goal_x=${state.goal[0]}&goal_y=${state.goal[1]}` : "");
}

/** Into the address bar, without a step in the history. */
export function writeLink(state: LinkedState): void {
  try {
    history.replaceState(null, "", hashOf(state));
  } catch {
    // A browser that does not allow this for files: there is no link then.
  }
}
