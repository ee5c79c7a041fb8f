// Runs one test program of this folder, or says why it is skipped (exit code 77).
// Usage: node run.mjs types|page_test.mjs FAIRWAY SOURCE MAPS WORK, in the folder with node_modules.
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";

const [, , test, fairway, source, maps, work] = process.argv;
const skip = (why) => { console.log(`skipped: ${why}`); process.exit(77); };
if (!existsSync("node_modules/playwright-core")) skip("npm could not fetch the tests' packages");
if (test === "types") process.exit(spawnSync(process.execPath, ["node_modules/typescript/bin/tsc", "--noEmit"], { stdio: "inherit" }).status ?? 1);
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
if (!chromium) skip("Chromium is not installed (tools/packages-ci.apt)");
const done = spawnSync(process.execPath, ["--test", `test/${test}`],
  { stdio: "inherit", env: { ...process.env, CHROMIUM: chromium, FAIRWAY: fairway, SOURCE: source, MAPS: maps, WORK: work } });
process.exit(done.status ?? 1);
