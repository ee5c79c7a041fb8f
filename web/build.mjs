// Bundles src/ into one HTML file: script and style inlined, nothing to fetch.
// Usage: node build.mjs OUTPUT.html
import { build } from "esbuild";
import { readFile, rename, writeFile } from "node:fs/promises";

const output = process.argv[2];
if (!output) throw new Error("usage: node build.mjs OUTPUT.html");

const options = { bundle: true, minify: true, write: false, target: "es2022", legalComments: "eof",
  charset: "ascii", logLevel: "warning" };
const script = await build({ ...options, entryPoints: ["src/main.ts"], format: "iife" });
// Nested rules are written out; what the page needs anyway is in these and later.
const style = await build({ ...options, target: ["chrome105", "firefox113", "safari16.4"], entryPoints: ["src/style.css"] });
// What would end the element early has another spelling in strings.
function inert(text) {
  if (text.includes("<!--")) throw new Error("the bundle has <!--, which HTML reads in its own way");
  return text.replace(/<\/(script|style)/gi, "<\\/$1").trim();
}

let html = await readFile("src/page.html", "utf8");
for (const [mark, text] of [["/*STYLE*/", style], ["/*SCRIPT*/", script]]) {
  if (html.split(mark).length !== 2) throw new Error(`src/page.html has ${mark} once`);
  html = html.replace(mark, () => inert(text.outputFiles[0].text));
}
const marks = ["@FAIRWAY_TITLE@", "@FAIRWAY_RECORD@", "@FAIRWAY_ARRAYS@"];
for (const mark of marks) {
  if (html.split(mark).length !== 2) throw new Error(`the page has ${mark} ${html.split(mark).length - 1} times`);
}
await writeFile(output + ".part", html);
await rename(output + ".part", output);
