// The page of a run whose vehicle keeps a contract: its verdicts next to those of the exact vehicle,
// behaviours that fail, and the places that what is unproved waits for.
import assert from "node:assert";
import { before, test } from "node:test";
import { frames, opened, openedFile, picture, readout, turnTo } from "./browser.mjs";
import { bytesOf, hasPage, query, recordOf, rocks, run, scenario, view } from "./runs.mjs";

const contract = "[vehicle.contract]\ncommand_error_m = 2.0\nheading_error_rad = 0.04\nturn_radius_m = [10.0, 14.0]\nspeed_mps = [9.0, 11.0]\n";
const rocky = { "contract.pgm": rocks(140, [[110, 90, 10], [100, 30, 6]]) };
const plain = scenario({ map: "contract.pgm", scale_m: 1, cell_m: 4, goal: [52, 66], undecided: 0.1 });
let exact, kept, record;
before(() => {
  exact = run("contract-none", plain, rocky);
  kept = run("contract-kept", plain + contract, rocky);
  if (!hasPage(kept)) process.exit(77);
  record = recordOf(kept);
});

const whose = (page, name) => page.getByRole("group", { name: "Which vehicle" }).getByRole("button", { name });
const choose = async (page, name) => {
  await whose(page, name).click();
  await frames(page, 12);
};
const share = (count, code) => (100 * (count[code] ?? 0) / count.reduce((a, b) => a + b)).toFixed(1);
const under = () => record.contract_verdicts;

/** A sample with a code at a heading under the contract: heading, place. */
function sampleWith(code, skip = 0) {
  const { nx, heading_rad, offset_m } = under();
  const { x0_m, y0_m, cell_m } = record.grid;
  for (let k = 0; k < heading_rad.length; ++k) {
    const layer = bytesOf(kept, "contract_verdict", k);
    for (let i = 0; i < layer.length; ++i) {
      if (layer[i] !== code || skip-- > 0) continue;
      return { k, i, x: x0_m + (i % nx + 0.5) * cell_m + offset_m[0], y: y0_m + (Math.floor(i / nx) + 0.5) * cell_m + offset_m[1], h: heading_rad[k] };
    }
  }
  assert.fail(`no sample has code ${code}`);
}

/** Where a place in the world is on the map: on the right one, when there are two. */
async function onScreen(page, { x, y }) {
  const { grid } = record;
  const map = await page.locator("#map").evaluate((box) => {
    const { left, top } = box.getBoundingClientRect();
    return { left: left + box.clientLeft, top: top + box.clientTop, width: box.clientWidth, height: box.clientHeight, split: box.classList.contains("split") };
  });
  const width = map.split ? map.width / 2 : map.width;
  const scale = Math.min(width / (grid.nx * grid.cell_m), map.height / (grid.ny * grid.cell_m));
  return [map.left + map.width - width / 2 + (x - grid.x0_m - grid.nx * grid.cell_m / 2) * scale, map.top + map.height / 2 - (y - grid.y0_m - grid.ny * grid.cell_m / 2) * scale];
}
const press = async (page, place) => {
  await page.mouse.click(...await onScreen(page, place));
  await frames(page, 8);
};

test("a wide window opens with both side by side, at the same heading", async (t) => {
  const { page, trouble } = await openedFile(t, kept);
  assert.equal(await whose(page, "Side by side").getAttribute("aria-pressed"), "true");
  const { heading_rad } = under();
  assert.equal(await page.locator("#heading-range").getAttribute("max"), String(heading_rad.length - 1));
  for (const k of [0, 5]) {
    await turnTo(page, k);
    await frames(page, 10);
    assert.notEqual(await picture(page), await picture(page, "map-beside"));
    const legend = await page.locator("#legend").innerText();
    const risk = under().at_risk[k];
    const counts = [record.verdicts.count[k * 72 / heading_rad.length], under().count[k]];
    assert.match(legend, new RegExp(`reach\\s+${share(counts[0], record.codes.reach)}\\s%\\s+${share(counts[1], record.codes.reach)}\\s%`));
    assert.match(legend, new RegExp(`at risk\\s+${share([...counts[1].slice(1), counts[1][0] - risk, risk], counts[1].length)}\\s%`));
  }
  // One and the same state is pointed at on either.
  const place = sampleWith(record.codes.at_risk);
  await turnTo(page, place.k);
  const [px, py] = await onScreen(page, place);
  const half = (await page.locator("#map").evaluate((box) => box.clientWidth)) / 2;
  await page.mouse.move(px, py);
  await frames(page, 6);
  const right = await readout(page);
  assert.match(right, /verdict at [^\n]+ under the contract\nat risk/);
  await page.mouse.move(px - half, py);
  await frames(page, 6);
  assert.equal(await readout(page), right);
  assert.deepEqual(trouble, []);
});

test("a narrow window opens with the exact vehicle alone", async (t) => {
  const { page } = await openedFile(t, kept, { viewport: { width: 700, height: 900 } });
  assert.equal(await whose(page, "Exact vehicle").getAttribute("aria-pressed"), "true");
  assert.ok(await page.locator("#map-beside").isHidden());
});

test("whose verdicts the map shows can be chosen, at the heading that was shown", async (t) => {
  const { page, trouble } = await openedFile(t, kept);
  const slider = page.locator("#heading-range");
  await choose(page, "Exact vehicle");
  await turnTo(page, 24);  // 120 degrees
  await press(page, { x: 30, y: 100 });
  const own = await picture(page);
  await choose(page, "Under the contract");
  assert.equal(await slider.getAttribute("max"), String(under().heading_rad.length - 1));
  assert.match(await page.locator("#heading-words").innerText(), /^120°/);
  assert.match(await readout(page), /verdict at 120° under the contract/);
  assert.match(await page.locator("#shown-words").textContent(), /under the contract/);
  assert.notEqual(await picture(page), own);
  const count = under().count[Math.round(under().heading_rad.length / 3)];
  assert.match(await page.locator("#legend").innerText(), new RegExp(`${share(count, record.codes.reach)}\\s%`));
  await page.getByLabel("Share of headings proved").check();
  await page.getByRole("button", { name: "at risk" }).click();
  await frames(page, 6);
  assert.match(await page.locator("#legend").innerText(), /that is at risk/);
  await page.getByLabel("Verdicts at a heading").check();
  await choose(page, "Exact vehicle");
  assert.equal(await slider.getAttribute("max"), "71");
  assert.equal(await picture(page), own);
  assert.deepEqual(trouble, []);
});

test("figures and volumes are given for both", async (t) => {
  const { page } = await openedFile(t, kept);
  assert.doesNotMatch(await page.locator("#facts").innerText(), /contract/);
  assert.match(await page.locator("#contract-facts").innerText(), /whatever the vehicle does within its contract/);
  assert.match(await page.locator("#volumes").innerText(), /All states, under the contract[^]*% at risk/);
  assert.match(await page.locator("#trust").innerText(), /re-proved the certificate under the contract, too|certificate under the contract was not re-proved/);
});

test("pressing on a state at risk plays a behaviour that fails from there, and says what it is", async (t) => {
  const { page, trouble } = await openedFile(t, kept);
  const box = page.locator("#witness");
  for (const name of ["Under the contract", "Side by side"]) {
    await choose(page, name);
    assert.ok(await box.isHidden());
    for (const skip of [0, 40]) {
      const place = sampleWith(record.codes.at_risk, skip);
      await turnTo(page, place.k);
      const before = await picture(page, "map-marks");
      await press(page, place);
      assert.match(await box.innerText(), /A vehicle within the contract that fails from here\. It (touches an obstacle|leaves the map) after [\d.]+ s and \d+ m\. (Each of its \d+ steps|Its one step) is one that the contract allows/);
      const start = (await box.getAttribute("data-start")).split(",").map(Number);
      [place.x, place.y, place.h].forEach((value, c) => assert.ok(Math.abs(start[c] - value) < 1e-6, `${start} is not ${Object.values(place)}`));
      assert.match(await box.innerText(), /of the [\d\u202f]+ witnesses on this page the nearest/);
      // At the end, as motion is not wanted; then anywhere on the way.
      const last = await picture(page, "map-marks");
      assert.notEqual(last, before);
      assert.match(await box.locator(".step").innerText(), /^Step (\d+) of \1: it (turns (left|right) with a radius of 1[04] m|flies straight on)/);
      await box.locator("input").evaluate((range) => { range.value = 0; range.dispatchEvent(new Event("input")); });
      await frames(page, 4);
      assert.notEqual(await picture(page, "map-marks"), last);
      assert.match(await box.locator(".step").innerText(), /^Step 1 of/);
    }
    await press(page, sampleWith(record.codes.reach, 200));
    assert.ok(await box.isHidden(), "where all reach there is none");
    // From the keyboard.
    const place = sampleWith(record.codes.at_risk, 20);
    await turnTo(page, place.k);
    await page.mouse.move(...await onScreen(page, place));
    await page.locator("#map").focus();
    await page.keyboard.press("Enter");
    await page.waitForFunction((x) => document.querySelector("#witness").dataset.start?.startsWith(x), String(place.x));
    assert.ok(await box.isVisible());
    const near = await picture(page);
    await box.getByRole("button", { name: "Zoom to it" }).click();
    await frames(page, 6);
    assert.notEqual(await picture(page), near);
    await page.getByRole("button", { name: "Show the whole map" }).click();
    await frames(page, 6);
    await page.getByRole("button", { name: "Close the witness" }).click();
  }
  // For the exact vehicle nothing is at risk.
  await choose(page, "Exact vehicle");
  await press(page, sampleWith(record.codes.at_risk));
  assert.ok(await box.isHidden());
  assert.deepEqual(trouble, []);
});

test("a witness is animated where motion is welcome", async (t) => {
  const { page } = await openedFile(t, kept, { reducedMotion: "no-preference" });
  await choose(page, "Under the contract");
  const place = sampleWith(record.codes.at_risk);
  await turnTo(page, place.k);
  await press(page, place);
  const clock = page.locator("#witness output");
  const seconds = async () => parseFloat(await clock.innerText());
  const early = await seconds();
  await page.waitForFunction((early) => parseFloat(document.querySelector("#witness output").innerText) > early, early);
  await page.waitForFunction(() => { const [now, all] = document.querySelector("#witness output").innerText.split(" s of "); return parseFloat(now) === parseFloat(all); }, null, { timeout: 30_000 });
  await page.getByRole("button", { name: "Close the witness" }).click();
  assert.ok(await page.locator("#witness").isHidden());
});

test("on paper nothing is beside the sheet", async (t) => {
  const { page, trouble } = await openedFile(t, kept);
  await page.evaluate(() => { window.dispatchEvent(new Event("beforeprint")); });
  await frames(page, 6);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= Math.max(700, window.innerWidth)));
  assert.match(await page.locator("#shown-words").innerText(), /under the contract/);
  assert.ok(await page.locator("#chokes tbody tr").last().isVisible());
  await page.evaluate(() => { window.dispatchEvent(new Event("afterprint")); });
  await frames(page, 6);
  assert.ok(await page.locator("#map-beside").isVisible());
  assert.deepEqual(trouble, []);
});

test("chokes are listed with their shares and reasons, and pressing one goes there", async (t) => {
  const { page, trouble } = await openedFile(t, kept);
  const { chokes } = record.summary.contract;
  assert.ok(chokes.length > 0);
  const rows = page.locator("#chokes tbody tr");
  assert.equal(await rows.count(), chokes.length);
  assert.match(await rows.first().innerText(), new RegExp(`${(100 * chokes[0].share).toFixed(2)} %\\s+\\(${chokes[0].x_m}, ${chokes[0].y_m}\\)\\s+${chokes[0].reason}`));
  await choose(page, "Exact vehicle");
  const before = await picture(page);
  await rows.first().getByRole("button").click();
  await frames(page, 12);
  assert.equal(await whose(page, "Under the contract").getAttribute("aria-pressed"), "true");
  assert.match(await readout(page), new RegExp(`^x, y\\n${chokes[0].x_m}, ${chokes[0].y_m} m\n`));
  assert.notEqual(await picture(page), before);
  const map = await page.locator("#map").boundingBox();
  assert.ok(map.y >= -1 && map.y + map.height <= 901, "the map is in view");
  await page.locator("#layers input[value=chokes]").uncheck();
  assert.deepEqual(trouble, []);
});

test("a run without a contract offers none of it", async (t) => {
  const { page, trouble } = await openedFile(t, exact);
  assert.equal(await page.getByRole("group", { name: "Which vehicle" }).count(), 0);
  assert.doesNotMatch(await page.locator("main").innerText(), /under the contract/i);
  for (const id of ["chokes-section", "witness", "map-beside", "contract-facts", "facts-h"]) assert.ok(await page.locator(`#${id}`).isHidden(), id);
  assert.equal(await page.locator("#layers input[value=chokes]").count(), 0);
  assert.equal(recordOf(exact).contract_verdicts, undefined);
  assert.equal(recordOf(exact).codes.at_risk, undefined);
  assert.deepEqual(trouble, []);
});

test("live: a state is answered under the contract, too, and its own witness is played", async (t) => {
  const server = await view(kept);
  t.after(() => server.end());
  const { page, trouble } = await opened(t, server.address);
  await page.locator("#live").waitFor();
  const answer = page.locator("#live .answer"), box = page.locator("#witness");
  const fields = ["x", "y", "h"];
  const states = [sampleWith(record.codes.at_risk, 3), sampleWith(record.codes.reach, 150), sampleWith(record.codes.at_risk, 90)]
    .map(({ x, y, h }) => [Number((x + 0.3).toFixed(2)), Number(y.toFixed(2)), Number((h * 180 / Math.PI).toFixed(1))]);
  const expected = query(kept, states.map(([x, y, h]) => [x, y, h * Math.PI / 180]), "contract.certificate.safetensors");
  assert.ok(expected.includes("at_risk") && expected.includes("reach"));
  for (const [k, state] of states.entries()) {
    for (const [c, name] of fields.entries()) await page.locator(`#live input[name=${name}]`).fill(String(state[c]));
    await page.keyboard.press("Enter");
    await page.waitForFunction(([x, y, h]) => {
      const [ax, ay, ah] = (document.querySelector("#live").dataset.answeredFor ?? "").split(" ").map(Number);
      return ax === x && ay === y && Math.abs((((ah - h) % 360) + 540) % 360 - 180) < 0.06;
    }, state);
    const words = { at_risk: "at risk", undecided: "undecided" }[expected[k]] ?? `proved: ${expected[k]}${expected[k] === "reach" ? " within" : ""}`;
    assert.match(await answer.innerText(), new RegExp(`under the contract ${words}`));
    assert.match(await answer.innerText(), /flown: /);
    assert.equal(await box.isVisible(), expected[k] === "at_risk");
    if (expected[k] !== "at_risk") continue;
    assert.match(await box.innerText(), /A vehicle within the contract that fails from here/);
    assert.doesNotMatch(await box.innerText(), /nearest/);
    assert.deepEqual((await box.getAttribute("data-start")).split(",").map(Number).slice(0, 2), state.slice(0, 2));
  }
  // Nothing is known under the contract for another goal.
  await page.getByRole("button", { name: "Move the goal" }).click();
  for (const [name, value] of [["goal_x", 52], ["goal_y", 74]]) await page.locator(`#live input[name=${name}]`).fill(String(value));
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /moved to 52, 74/.test(document.querySelector("#withdrawn").innerText), null, { timeout: 30_000 });
  await page.getByRole("button", { name: "Fly from here" }).click();
  await page.waitForFunction(() => /flown: /.test(document.querySelector("#live .answer").innerText));
  assert.doesNotMatch(await answer.innerText(), /under the contract/);
  assert.ok(await box.isHidden());
  assert.deepEqual(trouble, []);
});
