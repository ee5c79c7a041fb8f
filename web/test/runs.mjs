// Runs of fairway for the tests of their page.
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { inflateSync } from "node:zlib";

export const { FAIRWAY, SOURCE, MAPS, WORK } = process.env;

/** An empty world with round rocks, one pixel a metre, as a PGM. */
export function rocks(pixels, discs) {
  const image = Buffer.alloc(pixels * pixels, 255);
  for (const [cx, cy, r] of discs) {
    for (let y = Math.max(0, cy - r); y <= Math.min(pixels - 1, cy + r); ++y) {
      for (let x = Math.max(0, cx - r); x <= Math.min(pixels - 1, cx + r); ++x) {
        if ((x - cx) ** 2 + (y - cy) ** 2 <= r * r) image[y * pixels + x] = 0;
      }
    }
  }
  return Buffer.concat([Buffer.from(`P5\n${pixels} ${pixels}\n255\n`), image]);
}

export function scenario({ map, scale_m, cell_m, goal, heading, undecided, random = 20 }) {
  return `[map]\nfile = ${JSON.stringify(map)}\nresolution_m = ${scale_m.toFixed(1)}\ncell_m = ${cell_m.toFixed(1)}\n` +
    `[vehicle]\nspeed_mps = 10.0\nturn_radius_m = ${(3 * cell_m).toFixed(1)}\n` +
    `[mission]\nkind = "goal"\ngoal_m = [${goal.map((m) => m.toFixed(1)).join(", ")}]\n` +
    (heading === undefined ? "" : `goal_heading_rad = ${heading.toFixed(3)}\n`) +
    `[verify]\nundecided_max = ${undecided}\n[simulate]\nrandom = ${random}\nsample = 200\n`;
}

/** The folder of a fresh run. */
export function run(name, text, files = {}) {
  mkdirSync(WORK, { recursive: true });
  for (const [file, bytes] of Object.entries(files)) writeFileSync(join(WORK, file), bytes);
  writeFileSync(join(WORK, `${name}.toml`), text);
  return runScenario(join(WORK, `${name}.toml`), name);
}

export function runScenario(file, name) {
  const folder = join(WORK, `${name}-out`);
  rmSync(folder, { recursive: true, force: true });
  execFileSync(FAIRWAY, ["run", file, "-o", folder, "--quiet"], { stdio: ["ignore", "ignore", "inherit"] });
  return folder;
}

export function hasPage(folder) { return existsSync(join(folder, "report.html")); }

/** The record of a page. */
export function recordOf(folder) {
  return JSON.parse(/id="record">(.*?)<\/script>/s.exec(readFileSync(join(folder, "report.html"), "utf8"))[1]);
}

/** Verdicts of states [x, y, h], by a certificate of the run. */
export function query(folder, states, certificate = "certificate.safetensors") {
  const csv = "x_m,y_m,heading_rad\n" + states.map((s) => s.join(",")).join("\n") + "\n";
  const text = execFileSync(FAIRWAY, ["query", join(folder, certificate), "--states", "-"], { input: csv, encoding: "utf8" });
  return text.trim().split("\n").slice(1).map((line) => line.split(",")[3]);
}

/** `fairway view` on a folder: its address, and how to stop it. */
export async function view(folder) {
  const server = spawn(FAIRWAY, ["--json", "view", folder], { stdio: ["ignore", "pipe", "inherit"] });
  let said = "";
  for await (const part of server.stdout) {
    said += part;
    if (said.trimEnd().endsWith("}")) break;
  }
  const ended = new Promise((resolve) => server.on("exit", resolve));
  return { address: JSON.parse(said).address, end: async () => { server.kill("SIGINT"); return ended; } };
}

/** One layer, or the whole, of an array of bytes that a page carries. */
export function bytesOf(folder, name, layer = 0) {
  const text = /id="arrays">(.*?)<\/script>/s.exec(readFileSync(join(folder, "report.html"), "utf8"))[1];
  const bytes = Buffer.from(text, "base64");
  const begin = 8 + Number(bytes.readBigUInt64LE(0));
  const { at } = JSON.parse(bytes.subarray(8, begin))[name];
  return inflateSync(bytes.subarray(begin + at[layer], begin + at[layer + 1]));
}
