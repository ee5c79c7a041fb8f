// How the page looks: what is in view, on paper, in dark mode, on a phone; and states in its address.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { chromium } from "playwright-core";
import { frames, opened, openedFile, picture, readout, turnTo } from "./browser.mjs";
import { hasPage, recordOf, rocks, run, scenario } from "./runs.mjs";

const look = run("look", scenario({ map: "look.pgm", scale_m: 1, cell_m: 2, goal: [92, 40], undecided: 0.2 })
  .replace("[simulate]", "[simulate]\nstates = [[20.0, 20.0, -3.0]]"), { "look.pgm": rocks(120, [[38, 70, 10], [84, 30, 6]]) });
if (!hasPage(look)) {
  console.log("skipped: this build has no page (it was built without npm)");
  process.exit(0);
}
const { grid } = recordOf(look);
const box = (page, selector) => page.locator(selector).boundingBox();

for (const [width, height] of [[1366, 768], [1400, 900]]) {
  test(`map, readout and replay are in view at ${width} x ${height}`, async (t) => {
    const { page } = await openedFile(t, look, { viewport: { width, height } });
    await page.mouse.move(...Object.values(await page.evaluate(() => {
      const { left, top, width, height } = document.getElementById("map").getBoundingClientRect();
      return [left + width / 2, top + height / 3];
    })));
    await frames(page, 4);
    assert.match(await readout(page), /verdict at/);
    for (const part of ["#map", "#readout", "#replay", "#heading"]) {
      const { y, height: tall } = await box(page, part);
      assert.ok(y >= 0 && y + tall <= height, `${part} ends at ${y + tall}`);
    }
    const map = await box(page, "#map");
    assert.ok(map.height > 0.45 * height, `the map is ${map.height} high`);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), "nothing is beside the window");
    const table = await box(page, "#flight-table");
    assert.ok(table.x + table.width <= width, "the table is not cut off");
    assert.ok(table.x >= map.x + map.width && table.y < map.y + map.height, "the flights table is next to the map");
  });
}

test("choosing a flight below the map scrolls the map back into view", async (t) => {
  const height = 700;
  const { page } = await openedFile(t, look, { viewport: { width: 800, height } });
  const row = page.locator("#flight-table tbody tr").nth(1);
  await row.scrollIntoViewIfNeeded();
  assert.ok((await box(page, "#map")).y < 0, "it is out of view before");
  await row.click();
  await frames(page, 3);
  const map = await box(page, "#map");
  assert.ok(map.y >= -1 && map.y + map.height <= height + 1, `${map.y} to ${map.y + map.height}`);
});

const print = (page, on) => page.evaluate((name) => { window.dispatchEvent(new Event(name)); }, on ? "beforeprint" : "afterprint");

for (const colorScheme of ["light", "dark"]) {
  test(`on paper the map keeps its shape and nothing idle is printed, from a ${colorScheme} screen`, async (t) => {
    const { page, trouble } = await openedFile(t, look, { colorScheme });
    await turnTo(page, 20);
    const before = { map: await box(page, "#map"), base: await picture(page) };
    await print(page, true);
    await page.emulateMedia({ media: "print", colorScheme });
    const map = await box(page, "#map"), legend = await box(page, "#legend");
    assert.ok(Math.abs(map.width / map.height - grid.nx / grid.ny) < 0.02, `${map.width} x ${map.height}`);
    const shown = await page.evaluate(() => {
      const canvas = document.getElementById("map-base");
      return canvas.width / canvas.height / (canvas.clientWidth / canvas.clientHeight);
    });
    assert.ok(Math.abs(shown - 1) < 0.01, "its pixels are square");
    assert.ok(legend.y >= map.y + map.height, "the legend is below");
    // A second canvas would be printed as white paper over the first.
    assert.equal(await page.evaluate(() => [...document.querySelectorAll("#map canvas")].filter((c) => c.getClientRects().length > 0).length), 1);
    const paper = 703;
    const wide = await page.evaluate((paper) => [...document.querySelectorAll("body *")]
      .filter((e) => e.getBoundingClientRect().right > paper && !e.closest("svg, .uplot, .skip")).map((e) => e.id || e.className || e.tagName), paper);
    assert.deepEqual(wide, []);
    const idle = await page.evaluate(() => [...document.querySelectorAll("button, input, select, .zoom, .keys, #readout, #solid-section")]
      .filter((e) => e.getClientRects().length > 0).map((e) => e.id || e.outerHTML.slice(0, 60)));
    assert.deepEqual(idle, []);
    assert.match(await page.locator("#shown-words").innerText(), /^Verdicts at heading 100° \(course 350°\), north; overlays: .*mission\.$/);
    const light = await page.evaluate(() => getComputedStyle(document.body).backgroundColor + getComputedStyle(document.querySelector("h1")).color);
    assert.equal(light, "rgb(255, 255, 255)rgb(34, 38, 43)");
    await page.emulateMedia({ media: "screen", colorScheme });
    await print(page, false);
    await frames(page, 4);
    assert.deepEqual({ map: await box(page, "#map"), base: await picture(page) }, before, "and the screen is as it was");
    assert.deepEqual(trouble, []);
  });
}

test("the printed file has a picture of the map on its first page, and no empty page", async (t) => {
  const { page } = await openedFile(t, look);
  const pdf = (await page.pdf({ preferCSSPageSize: true })).toString("latin1");
  const pages = [...pdf.matchAll(/\/Type \/Page\b(?!s)/g)].length;
  assert.ok(pages >= 2 && pages <= 4, `${pages} pages`);
  assert.match(pdf, /\/MediaBox \[0 0 59[45]\.?\d* 84[12]\.?\d*\]/, "A4");
  const images = [...pdf.matchAll(/\/Width (\d+)\s*\/Height (\d+)/g)].map(([, w, h]) => [Number(w), Number(h)]);
  const map = images.find(([w, h]) => w > 700 && Math.abs(w / h - grid.nx / grid.ny) < 0.02);
  assert.ok(map, `no picture of the map's shape among ${JSON.stringify(images)}`);
  // Every page except the last is full: its content ends near the bottom.
  await print(page, true);
  const tall = await page.evaluate(() => document.body.scrollHeight);
  assert.ok(tall > (pages - 1.6) * 1032, `${pages} pages for ${tall} pixels`);
});

/** Text whose contrast with its background is less than 4.5 (WCAG 2, 1.4.3). */
const faintWords = (page) => page.evaluate(() => {
  const parse = (color) => {
    const [r, g, b, a = 1] = color.startsWith("color(srgb") ? color.match(/[\d.]+/g).map((v, k) => k < 3 ? 255 * v : Number(v)) : color.match(/[\d.]+/g).map(Number);
    return [r, g, b, a];
  };
  const over = (top, under) => top.slice(0, 3).map((c, k) => c * top[3] + under[k] * (1 - top[3]));
  const light = (rgb) => rgb.map((c) => c / 255).map((c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4).reduce((sum, c, k) => sum + c * [0.2126, 0.7152, 0.0722][k], 0);
  const behind = (element) => {
    const layers = [];
    for (let e = element; e; e = e.parentElement) layers.push(parse(getComputedStyle(e).backgroundColor));
    return layers.reverse().reduce((under, layer) => over(layer, under), [255, 255, 255]);
  };
  const faint = new Set();
  let looked = 0;
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const element = walk.currentNode.parentElement;
    if (!walk.currentNode.textContent.trim() || element.closest("script, style, noscript, option") || element.getClientRects().length === 0) continue;
    ++looked;
    const ground = behind(element);
    const ink = over(parse(getComputedStyle(element).color), ground);
    const [a, b] = [light(ink), light(ground)].sort((p, q) => q - p);
    const ratio = (a + 0.05) / (b + 0.05);
    if (ratio < 4.5) faint.add(`${element.tagName}.${element.className} ${ratio.toFixed(2)}: ${walk.currentNode.textContent.slice(0, 30)}`);
  }
  return { looked, faint: [...faint] };
});

for (const colorScheme of ["light", "dark"]) {
  test(`all text is readable in the ${colorScheme} scheme`, async (t) => {
    const { page } = await openedFile(t, look, { colorScheme });
    await page.locator("#solid").scrollIntoViewIfNeeded();
    await page.waitForFunction(() => document.querySelector("#solid button"), null, { timeout: 30_000 });
    await page.evaluate(() => document.querySelectorAll("details").forEach((d) => { d.open = true; }));
    await page.locator("#flight-table tbody tr").nth(1).click();
    for (const view of ["Verdicts at a heading", "Share of headings proved", "Cost to go"]) {
      await page.getByLabel(view, { exact: true }).check();
      await frames(page, 4);
      const { looked, faint } = await faintWords(page);
      assert.ok(looked > 150, `${looked} texts`);
      assert.deepEqual(faint, []);
    }
  });
}

test("in dark mode obstacles stand out from the page", async (t) => {
  const { page } = await openedFile(t, look, { colorScheme: "dark" });
  const [obstacle, ground] = await page.evaluate(() => {
    const item = [...document.querySelectorAll("#legend li")].find((li) => li.innerText.includes("obstacle"));
    const canvas = item.querySelector("canvas");
    const data = [...canvas.getContext("2d").getImageData(8, 8, 1, 1).data].slice(0, 3);
    const light = (rgb) => rgb.map((c) => c / 255).map((c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4).reduce((sum, c, k) => sum + c * [0.2126, 0.7152, 0.0722][k], 0);
    return [light(data), light(getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number))];
  });
  assert.ok((obstacle + 0.05) / (ground + 0.05) > 3, `${obstacle} on ${ground}`);
});

test("on a phone controls are large enough for a finger, and nothing scrolls sideways", async (t) => {
  const { page } = await openedFile(t, look, { viewport: { width: 390, height: 844 }, hasTouch: true });
  const small = await page.evaluate(() => [...document.querySelectorAll("input[type=checkbox], input[type=radio], button, select")]
    .filter((e) => e.getClientRects().length > 0 && !e.closest(".skip"))
    .map((e) => [e.outerHTML.slice(0, 50), e.getBoundingClientRect()]).filter(([, b]) => b.width < 24 || b.height < 24).map(([html]) => html));
  assert.deepEqual(small, []);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 390);
});

test("a heading is the same in degrees, in radians and as a course", async (t) => {
  const { page } = await openedFile(t, look);
  for (let k = 0; k < 72; k += 7) {
    await turnTo(page, k);
    const [, degrees, course, rad] = /^([\d.]+)°\s+course (\d{3})°, [\w-]+ · ([\d.]+) rad/.exec(await page.locator("#heading-words").innerText());
    assert.equal(Number(rad).toFixed(3), (Number(degrees) * Math.PI / 180).toFixed(3));
    assert.equal(Number(course), (450 - 5 * k) % 360);
  }
});

test("headings in charts stay between -180 and 180 degrees", async (t) => {
  const { page } = await openedFile(t, look);
  await page.locator("#flight-table tbody tr").nth(1).click();  // starts at -172 degrees and turns right
  await page.locator("#charts").scrollIntoViewIfNeeded();
  const area = await page.locator("#charts .u-over").first().boundingBox();
  const seen = [];
  for (let k = 1; k < 60; ++k) {
    await page.mouse.move(area.x + k * area.width / 60, area.y + 20);
    await frames(page, 1);
    const value = Number((await page.locator("#charts .u-legend .u-series:nth-child(2) .u-value").first().innerText()).replace("−", "-"));
    if (Number.isFinite(value)) seen.push(value);
  }
  assert.ok(seen.length > 30 && seen.every((value) => value > -180.01 && value < 180.01), seen.join());
  assert.ok(Math.min(...seen) < -170 || Math.max(...seen) > 120, "and it crosses the seam");
});

test("the body fills its box, and is never seen from below its floor", async (t) => {
  const { page } = await openedFile(t, look);
  await page.locator("#solid").scrollIntoViewIfNeeded();
  await page.waitForFunction(() => Number(document.getElementById("solid").dataset.quads) > 0, null, { timeout: 30_000 });
  const extent = Number(await page.locator("#solid").getAttribute("data-extent"));
  assert.ok(extent > 0.9 && extent <= 1, `${extent}`);
  const { x, y, width, height } = await box(page, "#solid");
  await page.mouse.move(x + width / 2, y + 0.8 * height);
  await page.mouse.down();
  await page.mouse.move(x + width / 2, y - 600, { steps: 12 });
  await page.mouse.up();
  await frames(page, 6);
  for (let k = 0; k < 40; ++k) await page.keyboard.press("ArrowDown");
  await frames(page, 6);
  const polar = Number(await page.locator("#solid").getAttribute("data-polar"));
  assert.ok(polar > 1.3 && polar < Math.PI / 2, `${polar}`);
});

test("without WebGL a message says so, and the console is silent", async (t) => {
  const plain = await chromium.launch({ executablePath: process.env.CHROMIUM, args: ["--no-sandbox", "--disable-3d-apis"] });
  t.after(() => plain.close());
  const page = await plain.newPage();
  const trouble = [];
  page.on("console", (message) => { if (message.type() === "error") trouble.push(message.text()); });
  page.on("pageerror", (error) => trouble.push(error.message));
  await page.goto(`file://${join(look, "report.html")}`);
  await page.locator("#solid").scrollIntoViewIfNeeded();
  await page.waitForFunction(() => /does not support WebGL/.test(document.getElementById("solid").innerText));
  assert.deepEqual(trouble, []);
});

test("a state in the address is shown, and a click puts one there", async (t) => {
  const { page, trouble } = await opened(t, `file://${join(look, "report.html")}#x=61&y=21&h=90deg`);
  const shows = async (x, y, degrees) => {
    await frames(page, 4);
    assert.match(await readout(page), new RegExp(`x, y\\n${x}, ${y} m`));
    assert.match(await readout(page), new RegExp(`verdict at ${degrees}°`));
    assert.match(await page.locator("#heading-words").innerText(), new RegExp(`^${degrees}°`));
  };
  await shows(61, 21, 90);
  await page.evaluate(() => { location.hash = "#x=30.5&y=99&h=-1.5707963"; });
  await shows(30.5, 99, 270);
  for (const nothing of ["", "#map", "#x=1&y=2&h=north", "#x=&y=2&h=0", "#x=1e999&y=2&h=0"]) {
    await page.evaluate((hash) => { location.hash = hash; }, nothing);
    await shows(30.5, 99, 270);
  }
  const map = await box(page, "#map");
  await page.mouse.click(map.x + map.width / 3, map.y + map.height / 3);
  const link = await page.evaluate(() => location.hash);
  assert.match(link, /^#x=[\d.]+&y=[\d.]+&h=270deg$/);
  await frames(page, 3);
  const words = await readout(page);
  const { page: second } = await opened(t, `file://${join(look, "report.html")}${link}`);
  await frames(second, 4);
  assert.equal(await readout(second), words);
  assert.deepEqual(trouble, []);
});

test("on a map in degrees the page shows the same latitude and longitude as the run's GeoJSON", async (t) => {
  const fence = { fileType: "Plan", version: 1, groundStation: "QGroundControl",
    geoFence: { version: 2, polygons: [{ version: 1, inclusion: true, polygon: [[47.396, 8.540], [47.396, 8.556], [47.405, 8.556], [47.405, 8.540]] }], circles: [] },
    mission: { version: 2, items: [], plannedHomePosition: [47.400, 8.5495, 400] }, rallyPoints: { version: 2, points: [] } };
  const folder = run("fence", '[map]\nfile = "fence.plan"\ncell_m = 20.0\n[vehicle]\nspeed_mps = 18.0\nturn_radius_m = 45.0\n' +
    '[mission]\nkind = "goal"\ngoal_deg = [47.400, 8.5495]\n[simulate]\nrandom = 8\nsample = 100\n[verify]\nundecided_max = 0.9\n', { "fence.plan": JSON.stringify(fence) });
  const record = recordOf(folder);
  const flights = JSON.parse(readFileSync(join(folder, "flights.geojson"), "utf8")).features.filter((f) => f.geometry.type === "LineString");
  const { page } = await openedFile(t, folder);
  let compared = 0;
  for (const flight of record.flights.filter((f) => f.group === "random")) {
    const [x, y] = flight.start;
    await page.evaluate(([x, y]) => { location.hash = `#x=${x}&y=${y}&h=0`; }, [x, y]);
    await frames(page, 4);
    const [, lat, lon] = /latitude, longitude\n([\d.−]+), ([\d.−]+)/.exec(await readout(page));
    const apart = flights.map((f) => f.geometry.coordinates[0]).map(([a, b]) => Math.hypot(a - Number(lon), b - Number(lat)));
    assert.ok(Math.min(...apart) < 2e-6, `${lat}, ${lon}: ${Math.min(...apart)}`);
    ++compared;
  }
  assert.ok(compared > 4);
});
