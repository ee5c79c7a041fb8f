// A page in a real browser, with helpers for tests.
import { join } from "node:path";
import { after, before } from "node:test";
import { chromium } from "playwright-core";

let browser;
before(async () => {
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM, args: ["--no-sandbox", "--enable-unsafe-swiftshader"] });
});
after(async () => browser?.close());

/** A page that is ready, and everything it logged or requested from the network. */
export async function opened(t, address, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, reducedMotion: "reduce", ...options });
  t.after(() => context.close());
  const page = await context.newPage();
  const trouble = [];
  page.on("console", (message) => {
    if (message.type() === "error" || (message.type() === "warning" && !/WebGL|GL Driver/.test(message.text()))) trouble.push(message.text());
  });
  page.on("pageerror", (error) => trouble.push(error.message));
  page.on("dialog", (dialog) => { trouble.push(`dialog: ${dialog.message()}`); void dialog.dismiss(); });
  page.on("request", (request) => {
    const url = request.url();
    if (url !== address.split("#")[0] && !url.startsWith("data:") && !url.startsWith("blob:") && !new URL(url).pathname.startsWith("/api/")) trouble.push(`asked for ${url}`);
  });
  const begin = performance.now();
  await page.goto(address);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: 30_000 });
  return { page, trouble, ready_ms: performance.now() - begin };
}
export const openedFile = (t, folder, options) => opened(t, `file://${join(folder, "report.html")}`, options);

export const picture = (page, id = "map-base") => page.evaluate((id) => {
  const canvas = document.getElementById(id);
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const context = copy.getContext("2d", { willReadFrequently: true });
  context.drawImage(canvas, 0, 0);
  const data = context.getImageData(0, 0, canvas.width, canvas.height).data;
  let hash = 0;
  for (let i = 0; i < data.length; i += 4) hash = (Math.imul(hash, 31) + data[i] * 65536 + data[i + 1] * 256 + data[i + 2] + data[i + 3] * 7) | 0;
  return hash;
}, id);
export const frames = (page, n = 3) => page.evaluate((n) => new Promise((done) => {
  const step = () => n-- > 0 ? requestAnimationFrame(step) : done();
  step();
}), n);
export const readout = (page) => page.locator("#readout").innerText();
export const turnTo = async (page, index) => {
  await page.locator("#heading-range").evaluate((range, index) => { range.value = index; range.dispatchEvent(new Event("input")); }, index);
  await frames(page, 6);
};
