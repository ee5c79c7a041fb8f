// The page of a path mission: who touches the path, who is proved to follow it, and the tube about it.
import assert from "node:assert/strict";
import { before, test } from "node:test";
import { frames, opened, openedFile, picture, readout, turnTo } from "./browser.mjs";
import { bytesOf, hasPage, query, recordOf, rocks, run, scenario, view } from "./runs.mjs";

const map = { "follow.pgm": rocks(160, [[140, 140, 10], [12, 14, 6]]) };
const circle = scenario({ map: "follow.pgm", scale_m: 1, cell_m: 4, goal: [80, 80], undecided: 0.05 })
  .replace(/kind = "goal"\ngoal_m = .*\n/, 'kind = "path"\nloiter = {center_m = [80.0, 80.0], radius_m = 40.0, direction = "left"}\n');
const contract = "[vehicle.contract]\ncommand_error_m = 1.0\nheading_error_rad = 0.0175\nturn_radius_m = [11.4, 12.6]\nspeed_mps = [10.0, 10.0]\n";
let exact, kept, record;
before(() => {
  exact = run("follow-exact", circle, map);
  kept = run("follow-kept", circle + contract, map);
  if (!hasPage(exact)) process.exit(77);
  record = recordOf(exact);
  assert.ok(record.summary.contract?.follow, "the path is proved to be followed");
});

const whose = (page, name) => page.getByRole("group", { name: "Which vehicle" }).getByRole("button", { name });
const choose = async (page, name) => {
  await whose(page, name).click();
  await frames(page, 12);
};
const percent = (share) => (100 * share).toFixed(1);

/** The page's place of (x, y) on the only map, in its middle. */
async function pointAt(page, [x, y]) {
  const { grid } = record;
  const box = await page.locator("#map").evaluate((map) => {
    const { left, top } = map.getBoundingClientRect();
    return { left: left + map.clientLeft, top: top + map.clientTop, width: map.clientWidth, height: map.clientHeight };
  });
  const scale = Math.min(box.width / (grid.nx * grid.cell_m), box.height / (grid.ny * grid.cell_m));
  await page.mouse.move(box.left + box.width / 2 + (x - grid.x0_m - grid.nx * grid.cell_m / 2) * scale,
    box.top + box.height / 2 - (y - grid.y0_m - grid.ny * grid.cell_m / 2) * scale);
  await frames(page, 6);
}

test("touching the path and following it are told apart everywhere", async (t) => {
  const { page, trouble } = await openedFile(t, exact);
  const { contract, verify } = record.summary;
  assert.equal(await whose(page, "Side by side").getAttribute("aria-pressed"), "true");
  await turnTo(page, 0);
  const legend = await page.locator("#legend").innerText();
  assert.match(legend, /touch\s+follow/);
  assert.match(legend, /proved: touch or follow/);
  assert.match(await page.locator("#heading-words").innerText(), /places that touch: [\d.> ]+ %, follow: [\d.> ]+ %/);
  assert.deepEqual(await page.locator(".map-name").allInnerTexts(), ["Touches the path", "Follows it"]);
  const volumes = await page.locator("#volumes").innerText();
  assert.match(volumes, new RegExp(`All states[^]*${percent(verify.volume_fraction.reach)} % touch`));
  assert.match(volumes, new RegExp(`All states, following the path[^]*${percent(contract.volume_fraction.follow)} % follow`));
  assert.match(volumes, new RegExp(`States that the mission can use, following the path\\s+${percent(contract.volume_fraction_usable.follow)} % follow`));
  assert.doesNotMatch(await page.locator("main").innerText(), /under the contract/i, "there is none");
  await choose(page, "Follows it");
  await pointAt(page, [80, 125]);
  assert.match(await readout(page), /verdict at 0° following the path\nproved: follow, follow at \d+ of/);
  assert.match(await readout(page), /verdict at 0°\nproved: touch/);
  await choose(page, "Touches the path");
  assert.match(await page.locator("#legend").innerText(), /proved: touch\s/);
  assert.match(await page.locator("#heading-words").innerText(), /of places touch/);
  const other = await openedFile(t, kept);
  assert.deepEqual(await other.page.locator(".map-name").allInnerTexts(), ["Touches the path, exact vehicle", "Follows it, under the contract"]);
  assert.match(await other.page.locator("#contract-facts-h").innerText(), /Following it: every vehicle that keeps the contract/i);
  assert.deepEqual([...trouble, ...other.trouble], []);
});

test("the proved tube lies about the line on the map, and can be switched off", async (t) => {
  const { page, trouble } = await openedFile(t, exact);
  await choose(page, "Follows it");
  for (const layer of ["streamlines", "mission", "chokes"]) {
    const box = page.locator(`#layers input[value=${layer}]`);
    if (await box.count()) await box.uncheck();
  }
  await frames(page, 4);
  const on = await picture(page, "map-lines");
  /** How opaque the layer of lines is at places that many metres right of the circle. */
  const opaque = (off_m) => page.evaluate(({ off_m, grid }) => {
    const canvas = document.getElementById("map-lines");
    const scale = Math.min(canvas.width / (grid.nx * grid.cell_m), canvas.height / (grid.ny * grid.cell_m));
    const x = canvas.width / 2 + (120 + off_m - grid.x0_m - grid.nx * grid.cell_m / 2) * scale;
    const y = canvas.height / 2 - (80 - grid.y0_m - grid.ny * grid.cell_m / 2) * scale;
    const copy = document.createElement("canvas");
    copy.width = copy.height = 1;
    const context = copy.getContext("2d", { willReadFrequently: true });
    context.drawImage(canvas, Math.round(x), Math.round(y), 1, 1, 0, 0, 1, 1);
    return context.getImageData(0, 0, 1, 1).data[3];
  }, { off_m, grid: record.grid });
  const width = record.summary.contract.follow.profile[0].distance_m;
  for (const off of [-0.7, 0, 0.7]) assert.ok(await opaque(off * width) > 0, `${off} of the tube's width`);
  for (const off of [-1.3, 1.3]) assert.equal(await opaque(off * width), 0, `${off} of the tube's width`);
  await page.locator("#layers input[value=tube]").uncheck();
  await frames(page, 4);
  assert.notEqual(await picture(page, "map-lines"), on);
  assert.equal(await opaque(0), 0);
  assert.deepEqual(trouble, []);
});

test("flights are charted over the station within the tube, with the time of a lap proved and flown", async (t) => {
  const { page, trouble } = await openedFile(t, exact);
  const { tube_m, lap_time_s: [least, most], length_m } = record.summary.contract.follow;
  await page.waitForFunction(() => /Flown: /.test(document.getElementById("tube-words")?.innerText));
  const words = await page.locator("#tube-words").innerText();
  const [, widest, from, to] = /farther than ([\d.]+) m from the line, and a lap takes (\d+) to (\d+) s/.exec(words).map(Number);
  assert.ok(widest >= tube_m && widest < tube_m + 0.11);
  assert.deepEqual([from, to], [Math.floor(least), Math.ceil(most)]);
  const [, fastest, slowest, flights] = /the last lap took (\d+) to (\d+) s in (\d+) flights/.exec(words).map(Number);
  // A circle of 251 m at 10 m/s.
  assert.ok(fastest >= from && slowest <= to && fastest <= slowest && Math.abs(fastest - length_m / 10) < 2, words);
  // Flown for a lap after they touch the path, not all have gone round the line when they end.
  const less = Number(/(\d+) more fly less than a lap/.exec(words)?.[1] ?? 0);
  assert.ok(flights >= 3);
  assert.equal(flights + less, record.flights.filter(({ after }) => after).length);
  const chart = page.locator("#tube-chart");
  assert.match(await chart.locator(".uplot").getAttribute("aria-label"), /the proved tube and [1-5] flights?/);
  assert.match(await chart.locator(".u-legend").innerText(), /proved tube[^]*from \(/);
  // One flight alone: the first that follows, then the first of those that collide.
  for (const [outcome, count] of [["reach", 1], ["collide", 0]]) {
    await page.locator("#flight-table tr[data-flight]").filter({ hasText: outcome }).first().click();
    await frames(page, 4);
    assert.match(await chart.locator(".uplot").getAttribute("aria-label"), new RegExp(`and ${count} flight`));
  }
  assert.deepEqual(trouble, []);
});

test("live: what is proved of a state is that it follows", async (t) => {
  const server = await view(exact);
  t.after(() => server.end());
  const { page, trouble } = await opened(t, server.address);
  await page.locator("#live").waitFor();
  const state = [60.5, 100.25, 90];
  const [expected] = query(exact, [[60.5, 100.25, Math.PI / 2]], "contract.certificate.safetensors");
  assert.equal(expected, "follow");
  for (const [c, name] of ["x", "y", "h"].entries()) await page.locator(`#live input[name=${name}]`).fill(String(state[c]));
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /flown: /.test(document.querySelector("#live .answer").innerText));
  assert.match(await page.locator("#live .answer").innerText(), /^proved: touch within [\d.]+ s\nfollowing the path proved: follow/);
  assert.deepEqual(trouble, []);
});

test("the tube is in the record as it is in the proof", () => {
  const { follow, summary } = record;
  assert.ok(follow.closed && follow.line_m.length > 20);
  for (const [x, y] of follow.line_m) assert.ok(Math.abs(Math.hypot(x - 80, y - 80) - 40) < 0.5);
  assert.equal(record.exact_contract, true);
  assert.equal(recordOf(kept).exact_contract, undefined);
  assert.ok(summary.contract.follow.profile.length > 10);
  assert.ok(bytesOf(exact, "tube_x").length > 40);
});
