// The page of a plan with modes: which one serves which states.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { test } from "node:test";
import { frames, opened, openedFile, picture, readout, turnTo } from "./browser.mjs";
import { bytesOf, FAIRWAY, hasPage, recordOf, rocks, run, scenario, SOURCE, view } from "./runs.mjs";

const text = (modes, random = 5) => `[map]\nfile = ${JSON.stringify(join(SOURCE, "demo/town.map"))}\nresolution_m = 4.0\ncell_m = 4.0\n` +
  "[vehicle]\nspeed_mps = 10.0\nturn_radius_m = 9.0\n[mission]\nkind = \"goal\"\ngoal_m = [220.0, 32.0]\n" +
  `[plan]\npreset = "paper"\nalpha = 0.5\nbeta = 1.5\nmodes = ${modes}\n[verify]\nundecided_max = 0.05\n[simulate]\nrandom = ${random}\nsample = 200\n`;
const town = run("town", text(4));
if (!hasPage(town)) {
  console.log("skipped: this build has no page (it was built without npm)");
  process.exit(0);
}
const record = recordOf(town);

/** Mode, or null where none is proved to reach, of states [x, y, h], by the certificate. */
function modes(states) {
  const csv = "x_m,y_m,heading_rad\n" + states.map((s) => s.join(",")).join("\n") + "\n";
  const rows = execFileSync(FAIRWAY, ["query", join(town, "certificate.safetensors"), "--states", "-"], { input: csv, encoding: "utf8" }).trim().split("\n").slice(1);
  return rows.map((row) => row.split(",")).map(([, , , verdict, , mode]) => verdict === "reach" ? Number(mode) : null);
}
const show = async (page, value) => {
  await page.locator(`#views input[value=${value}]`).check();
  await page.waitForFunction((value) => document.querySelector(`#views input[value=${value}]`).checked, value);
  await frames(page, 8);
};
/** The state that the page shows for a cell at a heading. */
const sampled = ([ix, iy], k) => [record.grid.x0_m + (ix + 0.5) * record.grid.cell_m + record.verdicts.offset_m[0],
  record.grid.y0_m + (iy + 0.5) * record.grid.cell_m + record.verdicts.offset_m[1], record.verdicts.heading_rad[k]];

test("every mode read off the map is the certificate's, and its command that of the plan", async (t) => {
  const { page, trouble } = await openedFile(t, town);
  await show(page, "mode");
  assert.equal(record.verdicts.cells_per_sample, 1);
  const { nx } = record.grid;
  const box = await page.locator("#map").boundingBox();
  const seen = new Set();
  const states = [], shown = [];
  for (const k of [0, 18, 36, 54, 65]) {
    await turnTo(page, k);
    for (let n = 0; n < 16; ++n) {
      await page.mouse.move(box.x + (0.06 + 0.057 * n) * box.width, box.y + (0.08 + 0.84 * ((n * 7) % 16) / 16) * box.height);
      await frames(page);
      const words = await readout(page);
      const said = /mode at [^\n]*\n([^\n]*)/.exec(words)?.[1];
      if (!said) continue;  // an obstacle or the goal
      const cell = /cell\n(\d+), (\d+)/.exec(words).slice(1).map(Number);
      states.push(sampled(cell, k));
      const mode = /^mode (\d+)/.exec(said)?.[1];
      shown.push(mode === undefined ? null : Number(mode));
      seen.add(shown.at(-1));
      if (!mode) { assert.equal(said, "no mode is proved to reach"); continue; }
      const code = mode === "0" ? null : bytesOf(town, "mode_heading", Number(mode) - 1)[cell[1] * nx + cell[0]];
      assert.equal(/commands /.test(said), mode !== "0");
      if (code !== null) {
        const degrees = Number(/commands ([\d.]+)°/.exec(said)[1]);
        assert.ok(Math.abs(degrees - code / 255 * 360) < 0.51, `${said}: ${code}`);
      }
    }
  }
  assert.deepEqual(shown, modes(states));
  assert.ok(shown.length > 20 && [...seen].some((mode) => mode > 0), `seen: ${[...seen]}`);
  assert.deepEqual(trouble, []);
});

test("the legend names the modes that serve a state, with their shares", async (t) => {
  const { page, trouble } = await openedFile(t, town);
  await show(page, "mode");
  for (const k of [0, 40]) {
    await turnTo(page, k);
    const rows = await page.locator("#legend li").allInnerTexts();
    const counts = record.verdicts.mode_count[k];
    const all = record.verdicts.count[k].reduce((sum, n) => sum + n, 0);
    const serving = record.styles.mode.filter((_, mode) => record.verdicts.mode_count.some((of) => of[mode] > 0));
    assert.equal(rows.length, serving.length + 3);  // none, obstacle, goal
    assert.match(rows[0], /^mode 0: the plan's own/);
    assert.match(rows[1], /^mode \d+: (on towards [\d.]+ degrees|turning places)/);
    assert.match(rows[serving.length], /^no mode is proved to reach/);
    const share = Number(/([\d.]+) %/.exec(rows[0])[1]) / 100;
    assert.ok(Math.abs(share - counts[0] / all) < 0.0051, `${rows[0]}: ${counts[0]} of ${all}`);
  }
  assert.match(await page.locator("#shown-words").innerText(), /^Modes at heading 200/);
  assert.deepEqual(trouble, []);
});

test("the map of modes turns with the heading, and arrows are those of the modes shown", async (t) => {
  const { page, trouble } = await openedFile(t, town);
  const verdicts = await picture(page);
  await show(page, "mode");
  const east = await picture(page);
  assert.notEqual(east, verdicts);
  await page.locator("#layers input[value=arrows]").check();
  await page.locator("#layers input[value=streamlines]").uncheck();
  await frames(page, 5);
  const arrows = await picture(page, "map-lines");
  await turnTo(page, 36);
  assert.notEqual(await picture(page), east);
  assert.notEqual(await picture(page, "map-lines"), arrows, "another mode serves, another command");
  await show(page, "verdict");
  const own = await picture(page, "map-lines");
  await turnTo(page, 0);
  assert.equal(await picture(page, "map-lines"), own, "the plan's own field has one command, whatever the heading");
  assert.deepEqual(trouble, []);
});

test("without modes nothing is said of them", async (t) => {
  const plain = run("plain", scenario({ map: "plain.pgm", scale_m: 1, cell_m: 2, goal: [92, 40], undecided: 0.2 }).replace("[verify]", "[plan]\nmodes = 0\n[verify]"),
    { "plain.pgm": rocks(120, [[38, 70, 10]]) });
  const { page, trouble } = await openedFile(t, plain);
  assert.equal(await page.locator("#views input[value=mode]").count(), 0);
  const box = await page.locator("#map").boundingBox();
  await page.mouse.move(box.x + 0.7 * box.width, box.y + 0.3 * box.height);
  await frames(page);
  assert.match(await readout(page), /verdict at/);
  assert.doesNotMatch(await readout(page), /mode/);
  const { styles, verdicts } = recordOf(plain);
  assert.ok(!("mode" in styles) && !("mode_count" in verdicts));
  assert.deepEqual(trouble, []);
});

test("live: the answer names the mode, and a moved goal withdraws the map of modes", async (t) => {
  const server = await view(town);
  t.after(() => server.end());
  const { page, trouble } = await opened(t, server.address);
  await page.locator("#live").waitFor();
  const { nx, ny } = record.grid;
  let found = null;
  for (let k = 0; !found && k < 72; ++k) {
    const layer = bytesOf(town, "mode", k);
    const i = layer.findIndex((mode) => mode > 0 && mode < record.styles.mode.length);
    if (i >= 0) found = { cell: [i % nx, Math.floor(i / nx)], k };
  }
  assert.ok(found && found.cell[1] < ny);
  const [x, y, h] = sampled(found.cell, found.k);
  const [mode] = modes([[x, y, h]]);
  const type = async (values) => {
    for (const [name, value] of Object.entries(values)) await page.locator(`#live input[name=${name}]`).fill(String(value));
    await page.keyboard.press("Enter");
  };
  const answer = await (await fetch(`${server.address}api/state?x=${x}&y=${y}&h=${h}`)).json();
  assert.equal(answer.mode, mode);
  await type({ x, y, h: h * 180 / Math.PI });
  await page.waitForFunction((mode) => new RegExp(`proved: reach within [\\d.]+ s, in mode ${mode}: `).test(document.querySelector("#live .answer").innerText), mode, { timeout: 10_000 });
  await show(page, "mode");
  await page.getByRole("button", { name: "Move the goal" }).click();
  await type({ goal_x: 28, goal_y: 164 });
  await page.waitForFunction(() => document.querySelector("#views input[value=mode]").disabled, null, { timeout: 30_000 });
  assert.ok(await page.locator("#views input[value=cost]").isChecked());
  assert.deepEqual(trouble, []);
});
