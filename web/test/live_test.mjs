// The live page: the goal is moved, and what is proved is withdrawn; states in its address.
import assert from "node:assert/strict";
import { test } from "node:test";
import { frames, opened, picture, readout } from "./browser.mjs";
import { hasPage, query, recordOf, rocks, run, scenario, view } from "./runs.mjs";

const map = { "live.pgm": rocks(120, [[38, 70, 10], [84, 30, 6]]) };
const live = run("live", scenario({ map: "live.pgm", scale_m: 1, cell_m: 2, goal: [92, 40], undecided: 0.2 }), map);
if (!hasPage(live)) {
  console.log("skipped: this build has no page (it was built without npm)");
  process.exit(0);
}

async function served(t, folder, hash = "") {
  const server = await view(folder);
  t.after(() => server.end());
  const found = await opened(t, server.address + hash);
  await found.page.locator("#live").waitFor();
  return { ...found, address: server.address, answer: found.page.locator("#live .answer") };
}
const says = (page, selector, words) => page.waitForFunction(([selector, words]) => new RegExp(words).test(document.querySelector(selector)?.innerText ?? ""),
  [selector, words], { timeout: 30_000 });
const type = async (page, values) => {
  for (const [name, value] of Object.entries(values)) await page.locator(`#live input[name=${name}]`).fill(String(value));
  await page.keyboard.press("Enter");
};
/** Where a place in the world is on the screen. */
const onScreen = async (page, [x, y]) => {
  const { grid } = recordOf(live);
  const box = await page.locator("#map").boundingBox();
  const scale = Math.min(box.width / (grid.nx * grid.cell_m), box.height / (grid.ny * grid.cell_m));
  return [box.x + box.width / 2 + (x - grid.x0_m - grid.nx * grid.cell_m / 2) * scale, box.y + box.height / 2 - (y - grid.y0_m - grid.ny * grid.cell_m / 2) * scale];
};

test("the slider turns to the heading asked for, and the readout agrees with the answer", async (t) => {
  const { page, answer, trouble } = await served(t, live);
  const { verdicts, grid } = recordOf(live);
  for (const [ix, iy, k] of [[10, 10, 28], [30, 50, 3], [44, 8, 60], [20, 44, 66]]) {
    // Exactly the states that the map shows.
    const x = grid.x0_m + (ix + 0.5) * grid.cell_m + verdicts.offset_m[0], y = grid.y0_m + (iy + 0.5) * grid.cell_m + verdicts.offset_m[1];
    await type(page, { x: x.toFixed(3), y: y.toFixed(3), h: 5 * k });
    await says(page, "#live .answer", `heading ${5 * k}°`);
    await frames(page, 5);
    assert.match(await page.locator("#heading-words").innerText(), new RegExp(`^${5 * k}°`));
    const shown = /verdict at [^\n]*\n(?:proved: )?(\w+)/.exec(await readout(page));
    if (!shown) continue;
    const [expected] = query(live, [[x, y, verdicts.heading_rad[k]]]);
    assert.equal(shown[1], expected);
    assert.match(await answer.innerText(), new RegExp(`^(proved: )?${expected}`));
  }
  assert.deepEqual(trouble, []);
});

test("the state is in the address, and opening it asks again", async (t) => {
  const { page, answer, address } = await served(t, live);
  await type(page, { x: 20, y: 100, h: 141.83 });
  await says(page, "#live .answer", "heading 141.8°");
  const link = await page.evaluate(() => location.hash);
  assert.equal(link, "#x=20&y=100&h=141.83deg");
  const words = (await answer.innerText()).replace(/answered.*/s, "");
  const { page: second } = await opened(t, address + link);
  await says(second, "#live .answer", "heading 141.8°");
  assert.equal((await second.locator("#live .answer").innerText()).replace(/answered.*/s, ""), words);
});

test("moving the goal makes a new plan; what was proved is withdrawn until it is verified", async (t) => {
  const { page, answer, trouble } = await served(t, live);
  const before = await picture(page);
  await type(page, { x: 100, y: 60, h: 200 });
  await says(page, "#live .answer", "heading 200°");
  await page.getByRole("button", { name: "Move the goal" }).click();
  await page.mouse.move(...await onScreen(page, [60, 25]));
  await page.mouse.down();
  for (const place of [[58, 30], [50, 80], [45, 92]]) await page.mouse.move(...await onScreen(page, place), { steps: 3 });
  await page.mouse.up();
  await says(page, "#withdrawn", "Not proved: this plan has not been verified");
  await says(page, "#live .answer", "not proved: this plan has not been verified");
  await says(page, "#live .answer", "flown: reach");
  await page.waitForFunction(() => {  // the last place of the drag counts
    const [, x, y] = /goal_x=([\d.]+)&goal_y=([\d.]+)/.exec(location.hash) ?? [];
    return Math.hypot(x - 45, y - 92) < 1;
  });
  assert.ok(await page.getByLabel("Verdicts at a heading").isDisabled());
  assert.ok(await page.locator("#flights-section").isHidden() && await page.locator("#solid-section").isHidden());
  assert.match(await page.evaluate(() => getComputedStyle(document.querySelector(".facts dd")).textDecorationLine), /line-through/);
  assert.doesNotMatch(await readout(page), /verdict/);
  // Where it does not fit, the refusal offers a place that does, a click away.
  await type(page, { goal_x: 38, goal_y: 50 });
  await says(page, "#live .answer", "does not fit there[^]*lies in an obstacle");
  assert.match(await page.locator("#withdrawn").innerText(), /moved to 4[45]/);
  await page.locator("#live .answer button").first().click();
  await says(page, "#live .answer", "flown: reach");
  await type(page, { goal_x: 45, goal_y: 92 });
  await says(page, "#withdrawn", "moved to 45, 92");
  // A short proof of this plan.
  await page.locator("#verify-moved").click();
  await says(page, "#withdrawn", "Verified [^]*proved to fail[^]*undecided[^]*proved to reach[^]*No other program has checked");
  assert.ok(await page.getByLabel("Verdicts at a heading").isChecked());
  await page.getByRole("button", { name: "Fly from here" }).click();
  await says(page, "#live .answer", "^(proved|undecided)");
  await type(page, { x: 100, y: 60, h: 200 });
  await says(page, "#live .answer", "heading 200°");
  assert.match(await answer.innerText(), /^proved: reach within/);
  assert.notEqual(await picture(page), before);
  // Opening the link shows what the server remembers, in the banner and in the answer.
  const { page: second } = await opened(t, page.url());
  await says(second, "#withdrawn", "Verified ");
  await says(second, "#live .answer", "^proved: reach");
  // Back to the run's own goal.
  await page.locator("#goal-back").click();
  await says(page, "#live .answer", "^proved");
  assert.ok(await page.locator("#withdrawn").isHidden());
  await page.locator("#heading-range").evaluate((range) => { range.value = 0; range.dispatchEvent(new Event("input")); });
  await frames(page, 8);
  assert.equal(await picture(page), before);
  assert.doesNotMatch(await page.evaluate(() => location.hash), /goal/);
  assert.deepEqual(trouble, []);
});

test("a link with a moved goal opens with the goal moved", async (t) => {
  const { page } = await served(t, live, "#x=100&y=60&h=200deg&goal_x=45&goal_y=92");
  await says(page, "#withdrawn", "moved to 45, 92. Not proved");
  await says(page, "#live .answer", "flown: reach");
});

test("the goal of a path cannot be moved", async (t) => {
  const folder = run("live-path", scenario({ map: "live.pgm", scale_m: 1, cell_m: 2, goal: [0, 0], undecided: 0.9 })
    .replace(/kind = "goal"\ngoal_m.*/, 'kind = "path"\npath_file = "live-path.csv"').replace("[verify]", "[plan]\nalpha = 1.0\n[verify]"),
  { ...map, "live-path.csv": "x_m,y_m\n20,20\n60,20\n70,100\n" });
  const { page } = await served(t, folder);
  assert.ok(await page.getByRole("button", { name: "Move the goal" }).isDisabled());
});
