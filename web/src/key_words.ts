// Members of the summary for people to read: names in words, with units; numbers formatted by their kind.
import { grouped, percent } from "./dom";

const names: Record<string, string> = {
  cells: "cells across and up", cell_m: "side of a cell, m", origin_m: "lower-left corner, m",
  free: "free cells", buffer: "buffer cells", obstacle: "obstacle cells", goal: "goal cells",
  unreachable_free_cells: "free cells cut off from the goal",
  random: "random flights", given: "given starts", count: "flown", outcomes: "", share: "share", seed: "seed",
  reach_share_interval_95: "share that reach, 95 % interval",
  volume_fraction: "of all states", volume_fraction_free: "of safe starts", volume_fraction_free_commanded: "of safe starts with a command", volume_fraction_usable: "of the states that the mission can use",
  volume_fraction_buffer: "of the buffer", samples: "sampled states for the shares", worst_time_s: "longest bound on the time to reach, s",
  stopped_by: "what ended the proof", leaves: "leaves of the proof", checked: "re-proved by the separate program",
  region_of_interest: "region to reach", program: "made by",
};
const units: Record<string, string> = { m: "m", s: "s", rad: "rad", deg: "degrees", mps: "m/s", mb: "MB", bytes: "bytes", mm: "mm" };
const values: Record<string, string> = {
  undecided_max: "the permitted share of undecided states", time_limit: "the time limit", memory_limit: "the memory limit",
  last_level: "the finest refinement level", stalled: "no further progress", true: "yes", false: "no",
};

/** "turn_radius_m" as "turn radius, m". */
function plainWords(key: string): string {
  const parts = key.split("_");
  const unit = parts.length > 1 ? units[parts[parts.length - 1]] : undefined;
  return unit ? `${parts.slice(0, -1).join(" ")}, ${unit}` : parts.join(" ");
}

/** The name of a member by the keys that lead to it. */
export function keyWords(path: string[]): string {
  return path.map((key) => names[key] ?? plainWords(key)).filter((words) => words !== "").join(": ");
}

function numberText(value: number, share_digits: number): string {
  if (share_digits > 0) return percent(value, share_digits);
  return Number.isInteger(value) ? grouped(value) : String(Number(value.toPrecision(6)));
}

/** A value by the keys that lead to it; null means not set. */
export function valueText(path: string[], value: unknown): string {
  const interval = path.includes("reach_share_interval_95");
  const share_digits = interval ? 2 : path.some((key) => /share|fraction/.test(key)) ? 1 : 0;
  if (value === null || value === undefined) return "not set";
  if (typeof value === "number") return path[path.length - 1] === "seed" ? String(value) : numberText(value, share_digits);
  if (Array.isArray(value)) return value.map((inner) => valueText(path, inner)).join(interval ? " to " : ", ");
  return values[String(value)] ?? String(value);
}

/** Every member of an object, in words. */
export function wordRows(value: unknown, path: string[] = []): [string, string][] {
  if (value === null || typeof value !== "object" || Array.isArray(value)) return [[keyWords(path), valueText(path, value)]];
  return Object.entries(value).flatMap(([key, inner]) => wordRows(inner, [...path, key]));
}
