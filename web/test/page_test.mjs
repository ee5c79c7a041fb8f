// The page in a real browser: what a person sees and does.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { existsSync } from "node:fs";
import { frames, opened, openedFile, picture, readout, turnTo } from "./browser.mjs";
import { hasPage, MAPS, query, recordOf, rocks, run, runScenario, scenario, SOURCE, view, WORK } from "./runs.mjs";

const discs = (pixels, count) => {  // drawn once and for all by a small generator of our own
  let seed = 20241;
  const next = () => (seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648;
  return Array.from({ length: count }, () => [Math.round(next() * pixels), Math.round(next() * pixels), Math.round((0.02 + 0.035 * next()) * pixels)])
    .filter(([x, y]) => Math.hypot(x - 0.84 * pixels, y - 0.2 * pixels) > 0.2 * pixels);
};

const small = run("small", scenario({ map: "small.pgm", scale_m: 1, cell_m: 2, goal: [92, 40], heading: 1.2, undecided: 0.05 }),
  { "small.pgm": rocks(120, [[38, 70, 10], [84, 30, 6]]) });
if (!hasPage(small)) {
  console.log("skipped: this build has no page (it was built without npm)");
  process.exit(0);
}

test("opens from disk, fetches nothing, and logs nothing", async (t) => {
  const { page, trouble } = await openedFile(t, small);
  assert.equal(await page.locator("h1").innerText(), "small");
  assert.match(await page.locator("#facts").innerText(), /proved to reach/);
  await page.locator("#solid").scrollIntoViewIfNeeded();
  await page.waitForFunction(() => Number(document.getElementById("solid").dataset.quads) > 0, null, { timeout: 30_000 });
  assert.deepEqual(trouble, []);
  assert.ok(await page.locator("#trouble").isHidden());
  assert.ok(await page.locator("#live").isHidden(), "from disk there is no server to ask");
});

test("what must not be missed comes first: cut-off cells, then the share of what the mission can use", async (t) => {
  const image = rocks(120, []);
  for (let y = 0; y < 120; ++y) image.fill(0, image.length - 14400 + y * 120 + 70, image.length - 14400 + y * 120 + 73);  // a wall
  const walled = run("walled", scenario({ map: "walled.pgm", scale_m: 1, cell_m: 2, goal: [30, 60], undecided: 0.1 }), { "walled.pgm": image });
  const { page, trouble } = await openedFile(t, walled);
  assert.match(await page.locator("#warnings li").first().innerText(), /of the free cells .* are cut off from the goal/);
  const [warnings, facts] = await Promise.all(["#warnings", "#facts"].map((id) => page.locator(id).boundingBox()));
  assert.ok(warnings.y < facts.y, "the warnings are above the figures");
  assert.match(await page.locator("#facts > div").first().innerText(), /^(of states that the mission can use are proved to reach the goal\s+[\d.]+ %|[\d.]+ %\s+of states that the mission can use are proved to reach the goal)$/);
  assert.match(await page.locator("#facts").innerText(), /of free cells are cut off from the goal/);
  const box = await page.locator("#map").boundingBox();
  await page.mouse.move(box.x + 0.8 * box.width, box.y + 0.5 * box.height);
  await frames(page);
  assert.match(await readout(page), /free, but cut off from the goal: the command leads to a circle/);
  assert.match(await readout(page), /headings that hold/);
  assert.doesNotMatch(await readout(page), /safe start/);
  assert.match(await page.locator("#flight-table").innerText(), /from a cut-off cell/);
  assert.deepEqual(trouble, []);
  const quiet = await openedFile(t, small);
  assert.ok(await quiet.page.locator("#warnings").isHidden(), "nothing to warn about");
});

test("numbers are labelled in words", async (t) => {
  const { page } = await openedFile(t, small);
  const told = await page.locator("#numbers").evaluate((box) => box.textContent);
  for (const words of ["free cells cut off from the goal", "share that reach, 95 % interval", "of safe starts with a command: reach"]) {
    assert.ok(told.includes(words), `${words} in: ${told.slice(0, 400)}`);
  }
  assert.doesNotMatch(told, /reach_share_interval|volume_fraction|unreachable_free_cells/);
});

test("every verdict read off the map is the certificate's", async (t) => {
  const { page } = await openedFile(t, small);
  const { grid, verdicts } = recordOf(small);
  const box = await page.locator("#map").boundingBox();
  const states = [], shown = [];
  for (const k of [0, 13, 30, 52, 71]) {
    await turnTo(page, k);
    for (let n = 0; n < 12; ++n) {
      const px = (0.06 + 0.077 * n) * box.width, py = (0.08 + 0.83 * ((n * 7) % 12) / 12) * box.height;
      await page.mouse.move(box.x + px, box.y + py);
      await frames(page);
      const words = await readout(page);
      const verdict = /verdict at [^\n]*\n(?:proved: )?(\w+)/.exec(words)?.[1];
      if (!verdict) continue;  // an obstacle or the goal
      const [ix, iy] = /cell\n(\d+), (\d+)/.exec(words).slice(1).map(Number);
      states.push([grid.x0_m + (ix + 0.5) * grid.cell_m + verdicts.offset_m[0], grid.y0_m + (iy + 0.5) * grid.cell_m + verdicts.offset_m[1], verdicts.heading_rad[k]]);
      shown.push(verdict);
    }
  }
  assert.ok(shown.length > 30, `${shown.length} places were read`);
  assert.ok(new Set(shown).size > 1, "more than one verdict is among them");
  assert.deepEqual(shown, query(small, states));
});

test("the slider changes the picture, and wraps round", async (t) => {
  const { page, trouble } = await openedFile(t, small);
  const first = await picture(page);
  await turnTo(page, 36);
  const second = await picture(page);
  assert.notEqual(second, first);
  assert.match(await page.locator("#heading-words").innerText(), /180°/);
  await page.locator("#heading-range").focus();
  for (let k = 0; k < 36; ++k) await page.keyboard.press("ArrowRight");
  await frames(page);
  assert.match(await page.locator("#heading-words").innerText(), /^0°/);
  assert.equal(await picture(page), first, "a full turn shows the same again");
  await page.keyboard.press("ArrowLeft");
  assert.match(await page.locator("#heading-words").innerText(), /^355°/);
  assert.match(await page.locator("#heading-range").getAttribute("aria-valuetext"), /^355° \(course 095°\), east/);
  const play = page.locator("#heading-play");
  await play.click();
  await page.waitForFunction(() => !document.getElementById("heading-words").innerText.startsWith("355°"));
  await play.click();
  assert.equal(await play.getAttribute("aria-pressed"), "false");
  assert.deepEqual(trouble, []);
});

test("every view and every layer looks different", async (t) => {
  const { page, trouble } = await openedFile(t, small);
  const seen = new Set([await picture(page)]);
  for (const name of ["Share of headings proved", "Cost to go", "Regions"]) {
    await page.getByLabel(name, { exact: true }).check();
    await frames(page, 6);
    seen.add(await picture(page));
    assert.ok((await page.locator("#legend").innerText()).length > 20, `${name} has a legend`);
  }
  await page.getByLabel("Share of headings proved").check();
  for (const kind of ["proved to fail", "undecided"]) {
    await page.getByRole("button", { name: kind, exact: true }).first().click();
    await frames(page, 4);
    seen.add(await picture(page));
  }
  assert.equal(seen.size, 6);
  const lines = new Set([await picture(page, "map-lines")]);
  for (const layer of ["arrows", "contours", "flights"]) {
    await page.locator(`#layers input[value=${layer}]`).check();
    await frames(page);
    lines.add(await picture(page, "map-lines"));
  }
  assert.equal(lines.size, 4);
  assert.deepEqual(trouble, []);
});

test("verdicts differ in lightness and in pattern, not in colour alone", async (t) => {
  const { page } = await openedFile(t, small);
  const samples = await page.evaluate(() => [...document.querySelectorAll("#legend li canvas")].slice(0, 5).map((canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const light = [];
    for (let i = 0; i < data.length; i += 4) light.push(Math.round(0.2126 * data[i] + 0.7152 * data[i + 1] + 0.0722 * data[i + 2]));
    return { mean: light.reduce((a, b) => a + b) / light.length, grey: light.join() };
  }));
  assert.equal(samples.length, 5);
  assert.equal(new Set(samples.map((s) => s.grey)).size, 5, "all five differ in grey print");
  const means = samples.map((s) => s.mean).sort((a, b) => a - b);
  for (let k = 1; k < 5; ++k) assert.ok(means[k] - means[k - 1] > 4, `lightness ${means.map(Math.round)}`);
});

test("the keyboard alone reaches everything on the map", async (t) => {
  const { page, trouble } = await openedFile(t, small);
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");  // the link that skips to the map
  await page.locator("#map").focus();
  await page.keyboard.press("ArrowRight");
  await frames(page);
  const first = await readout(page);
  assert.match(first, /verdict at 0°/);
  await page.keyboard.press("Shift+ArrowUp");
  await frames(page);
  assert.notEqual(await readout(page), first);
  await page.keyboard.press("]");
  await frames(page, 6);
  assert.match(await readout(page), /verdict at 5°/);
  const before = await picture(page);
  await page.keyboard.press("+");
  await frames(page);
  const zoomed = await picture(page);
  assert.notEqual(zoomed, before);
  for (let k = 0; k < 12; ++k) await page.keyboard.press("Shift+ArrowLeft");
  await frames(page);
  assert.notEqual(await picture(page), zoomed, "the map follows the cross");
  await page.keyboard.press("0");
  await frames(page);
  assert.equal(await picture(page), before);
  assert.deepEqual(trouble, []);
});

test("zooming by wheel and button, panning by the mouse", async (t) => {
  const { page } = await openedFile(t, small);
  const whole = await picture(page);
  const box = await page.locator("#map").boundingBox();
  await page.mouse.move(box.x + box.width / 3, box.y + box.height / 2);
  await page.mouse.wheel(0, -300);  // without Ctrl the page scrolls
  await frames(page);
  assert.equal(await picture(page), whole);
  await page.evaluate(() => scrollTo(0, 0));
  await page.keyboard.down("Control");
  await page.mouse.wheel(0, -300);
  await page.keyboard.up("Control");
  await frames(page);
  const zoomed = await picture(page);
  assert.notEqual(zoomed, whole);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 3 + 80, box.y + box.height / 2 + 40, { steps: 3 });
  await page.mouse.up();
  await frames(page);
  assert.notEqual(await picture(page), zoomed);
  await page.getByRole("button", { name: "Show the whole map" }).click();
  await frames(page);
  assert.equal(await picture(page), whole);
});

test("flights are chosen and replayed", async (t) => {
  const { page, trouble } = await openedFile(t, small);
  const count = recordOf(small).flights.length;
  const rows = page.locator("#flight-table tbody tr");
  assert.equal(await rows.count(), count + 1);
  await rows.nth(1).click();
  assert.equal(await rows.nth(1).getAttribute("aria-selected"), "true");
  await page.keyboard.press("ArrowDown");
  assert.equal(await rows.nth(2).getAttribute("aria-selected"), "true");
  assert.equal(await page.locator("#charts .uplot").count(), 2);
  const times = recordOf(small).flights.map((flight) => flight.time_s ?? 0);
  const longest = times.indexOf(Math.max(...times));
  await rows.nth(longest + 1).click();
  const marks = await picture(page, "map-marks");
  await page.locator("#replay select").selectOption("1");  // so that it does not end meanwhile
  assert.ok(times[longest] > 8, "a flight that takes its time");
  const play = page.locator("#replay button");
  await play.click();
  await page.waitForFunction(() => parseFloat(document.querySelector("#replay output").textContent) > 0.5);
  await play.click();
  const paused = await page.locator("#replay output").innerText();
  assert.notEqual(await picture(page, "map-marks"), marks);
  await frames(page, 10);
  assert.equal(await page.locator("#replay output").innerText(), paused);
  // The end of the replay is the end of the flight and its last leg.
  const slider = page.locator("#replay input[type=range]");
  await slider.focus();
  await page.keyboard.press("End");
  assert.match(await page.locator("#replay output").innerText(), /^([\d.]+) s of \1 s$/);
  assert.deepEqual(trouble, []);
});

test("everything fits in a narrow window", async (t) => {
  const { page, trouble } = await openedFile(t, small, { viewport: { width: 400, height: 800 }, hasTouch: true });
  await frames(page, 4);
  const wide = await page.evaluate(() => [...document.querySelectorAll("body *")].filter((e) => e.getBoundingClientRect().right > 401 &&
    !e.closest(".table-box, details, #charts, .skip, .solid")).map((e) => e.id || e.className || e.tagName));
  assert.deepEqual(wide, []);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 400);
  const before = await picture(page);
  await turnTo(page, 40);
  assert.notEqual(await picture(page), before);
  assert.deepEqual(trouble, []);
});

test("a dark scheme is dark, and its text is readable", async (t) => {
  const { page } = await openedFile(t, small, { colorScheme: "dark" });
  const [ground, ink] = await page.evaluate(() => {
    const light = (color) => { const [r, g, b] = color.match(/\d+/g).map(Number); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
    const style = getComputedStyle(document.body);
    return [light(style.backgroundColor), light(style.color)];
  });
  assert.ok(ground < 40 && ink > 200, `${ground}, ${ink}`);
});

test("file names stay text", async (t) => {
  const name = "<img src=x onerror=alert(1)>&amp;";
  const folder = run(name, scenario({ map: "small.pgm", scale_m: 1, cell_m: 2, goal: [92, 40], undecided: 0.9 }));
  const { page, trouble } = await opened(t, `file://${encodeURI(join(folder, "report.html")).replace("?", "%3F")}`);
  assert.equal(await page.locator("h1").innerText(), name);
  assert.equal(await page.title(), `${name} – Fairway`);
  assert.equal(await page.locator("img").count(), 0);
  assert.deepEqual(trouble, []);
});

test("the page of a run by border samples has no verdicts and says so", async (t) => {
  const folder = run("bitmap", scenario({ map: "small.pgm", scale_m: 1, cell_m: 2, goal: [92, 40], undecided: 0.9 })
    .replace("[verify]", '[verify]\nmethod = "bitmap"'));
  const { page, trouble } = await openedFile(t, folder);
  assert.equal(await page.getByLabel("Verdicts at a heading").count(), 0);
  assert.ok(await page.locator("#solid-section").isHidden());
  assert.match(await page.locator("#trust").innerText(), /Nothing was proved/);
  assert.deepEqual(trouble, []);
});

/** Frames a second while the slider is turned once round, one heading a frame. */
const turning = (page) => page.evaluate(async () => {
  const range = document.getElementById("heading-range");
  const count = Number(range.max) + 1;
  const turn = () => new Promise((done) => {
    let k = 0;
    const begin = performance.now();
    const step = () => {
      if (k === count) return done(count / ((performance.now() - begin) / 1000));
      range.value = k++;
      range.dispatchEvent(new Event("input"));
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  });
  await turn();  // inflates the rest
  return turn();
});

async function measured(t, name, folder) {
  const size = statSync(join(folder, "report.html")).size;
  const { page, trouble, ready_ms } = await openedFile(t, folder);
  await page.screenshot({ path: join(WORK, `${name}.png`) });
  const fps = await turning(page);
  t.diagnostic(`${name}: ${(size / 1e6).toFixed(2)} MB, ready after ${Math.round(ready_ms)} ms, slider at ${fps.toFixed(0)} frames a second`);
  assert.ok(size < 5e6, `${size} bytes`);
  assert.ok(ready_ms < 20_000 && fps > 3, "too slow to use");
  assert.deepEqual(trouble, []);
  return page;
}

test("a plan of 300 x 300 cells is small and quick", async (t) => {
  const folder = run("large", scenario({ map: "large.pgm", scale_m: 4, cell_m: 4, goal: [1008, 960], undecided: 0.5, random: 100 }),
    { "large.pgm": rocks(300, discs(300, 26)) });
  assert.ok(recordOf(folder).grid.nx >= 300);
  await measured(t, "large", folder);
});

test("the demonstration's page", async (t) => {
  const page = await measured(t, "demo", runScenario(join(SOURCE, "demo/demo.toml"), "demo"));
  assert.equal(await page.locator("h1").innerText(), "demo");
});

const berlin = join(MAPS, "movingai_cities/Berlin_0_512.map");
test("the page of a city", { skip: !existsSync(berlin) && `${berlin} is not there` }, async (t) => {
  const folder = run("berlin", scenario({ map: berlin, scale_m: 2, cell_m: 4, goal: [546, 474], undecided: 0.3, random: 100 }));
  await measured(t, "berlin", folder);
});

test("live: a state is checked and flown, and a pose is steered to", async (t) => {
  const server = await view(small);
  t.after(() => server.end());
  const { page, trouble } = await opened(t, server.address);
  await page.locator("#live").waitFor();
  const box = await page.locator("#map").boundingBox();
  const answer = page.locator("#live .answer");
  const drag = async (x, y, dx, dy) => {
    await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + x * box.width + dx, box.y + y * box.height + dy, { steps: 5 });
    await page.mouse.up();
  };
  const marks = await picture(page, "map-marks");
  await drag(0.15, 0.85, 0, -40);
  await page.waitForFunction(() => /heading 90°/.test(document.querySelector("#live .answer").innerText));
  assert.match(await answer.innerText(), /^(proved: \w+|undecided)/);
  assert.match(await answer.innerText(), /flown: \w+/);
  assert.notEqual(await picture(page, "map-marks"), marks);
  // The same by numbers: the page shows what the certificate says.
  const states = [[20, 20, 45], [60, 20, 180], [100, 60, 270]];
  for (const [x, y, h] of states) {
    for (const [name, value] of [["x", x], ["y", y], ["h", h]]) await page.locator(`#live input[name=${name}]`).fill(String(value));
    await page.keyboard.press("Enter");
    await page.waitForFunction((h) => document.querySelector("#live .answer").innerText.includes(`heading ${h}°`), h);
    const [expected] = query(small, [[x, y, h * Math.PI / 180]]);
    assert.match(await answer.innerText(), expected === "undecided" ? /^undecided/ : new RegExp(`^proved: ${expected}`));
  }
  // From the keyboard.
  await page.locator("#map").focus();
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /answered/.test(document.querySelector("#live .answer").innerText));
  // To a pose, moved twice.
  await page.getByRole("button", { name: "Steer to a pose" }).click();
  const words = [];
  for (const [x, y, dx] of [[0.5, 0.15, 40], [0.2, 0.3, -40]]) {
    await drag(x, y, dx, 0);
    await page.waitForFunction(() => /answered/.test(document.querySelector("#live .answer").innerText));
    await frames(page, 6);
    words.push((await answer.innerText()).split("\n")[0]);
  }
  assert.notEqual(words[0], words[1]);
  // Errors are explained.
  await page.locator("#live input[name=to_x]").fill("-5000");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /outside the plan/.test(document.querySelector("#live .answer").innerText));
  await page.getByRole("button", { name: "Fly from here" }).click();
  // Outside the plan a state has left, as in a query of the certificate.
  await page.locator("#live input[name=x]").fill("-5000");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /proved: leave/.test(document.querySelector("#live .answer").innerText));
  await page.locator("#live input[name=x]").fill("many");
  await page.keyboard.press("Enter");
  assert.match(await answer.innerText(), /decimal numbers/);
  const times = [];
  for (let k = 0; k < 40; ++k) {
    const begin = performance.now();
    const response = await page.request.get(`${server.address}api/state?x=${20 + 2 * k}&y=20&h=${0.1 * k}`);
    assert.equal(response.status(), 200);
    times.push(performance.now() - begin);
  }
  times.sort((a, b) => a - b);
  t.diagnostic(`live answers: median ${times[20].toFixed(1)} ms, slowest ${times[39].toFixed(1)} ms`);
  assert.deepEqual(trouble.filter((words) => !/400 \(Bad Request\)/.test(words)), []);
  assert.equal(await server.end(), 0);
});
