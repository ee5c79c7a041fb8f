// The page of a run whose vehicle keeps a contract: its verdicts next to those of the exact vehicle.
import assert from "node:assert";
import { before, test } from "node:test";
import { frames, openedFile, picture, readout, turnTo } from "./browser.mjs";
import { hasPage, recordOf, rocks, run, scenario } from "./runs.mjs";

const contract = "[vehicle.contract]\ncommand_error_m = 1.0\nheading_error_rad = 0.03\nturn_radius_m = [11.0, 13.0]\nspeed_mps = [9.0, 11.0]\n";
const rocky = { "contract.pgm": rocks(200, [[140, 100, 12]]) };
const plain = scenario({ map: "contract.pgm", scale_m: 1, cell_m: 4, goal: [60, 100], undecided: 0.1 });
let exact, kept;
before(() => {
  exact = run("contract-none", plain, rocky);
  kept = run("contract-kept", plain + contract, rocky);
  if (!hasPage(kept)) process.exit(77);
});

test("whose verdicts the map shows can be chosen, at the heading that was shown", async (t) => {
  const { page, trouble } = await openedFile(t, kept);
  const record = recordOf(kept);
  const slider = page.locator("#heading-range");
  const whose = page.getByRole("group", { name: "Which vehicle" });
  await turnTo(page, 27);  // 135 degrees
  await page.locator("#map").click({ position: { x: 60, y: 60 } });
  const own = await picture(page);
  await whose.getByRole("button", { name: "Under the contract" }).click();
  await frames(page, 10);
  assert.equal(await slider.getAttribute("max"), String(record.contract_verdicts.heading_rad.length - 1));
  assert.match(await page.locator("#heading-words").innerText(), /^135°/);
  assert.match(await readout(page), /verdict at 135° under the contract/);
  assert.match(await page.locator("#shown-words").textContent(), /under the contract/);
  assert.notEqual(await picture(page), own);
  const count = record.contract_verdicts.count[3];
  const share = (100 * count[record.codes.reach] / count.reduce((a, b) => a + b)).toFixed(1);
  assert.match(await page.locator("#legend").innerText(), new RegExp(`${share}\\s%`));
  await whose.getByRole("button", { name: "Exact vehicle" }).click();
  await frames(page, 10);
  assert.equal(await slider.getAttribute("max"), "71");
  assert.equal(await picture(page), own);
  assert.deepEqual(trouble, []);
});

test("figures and volumes are given for both", async (t) => {
  const { page } = await openedFile(t, kept);
  assert.match(await page.locator("#facts").innerText(), /whatever the vehicle does within its contract/);
  assert.match(await page.locator("#volumes").innerText(), /All states, under the contract/);
});

test("a run without a contract offers no choice", async (t) => {
  const { page, trouble } = await openedFile(t, exact);
  assert.equal(await page.getByRole("group", { name: "Which vehicle" }).count(), 0);
  assert.doesNotMatch(await page.locator("main").innerText(), /under the contract/i);
  assert.equal(recordOf(exact).contract_verdicts, undefined);
  assert.deepEqual(trouble, []);
});
