// The packages that tests need (a superset of the bundle's), next to a copy of the sources.
// Usage: node packages.mjs WEB_SOURCE FOLDER NPM. Exit code 77, and why, when npm cannot fetch them.
import { spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

const [, , source, folder, npm] = process.argv;
mkdirSync(folder, { recursive: true });
const lock = (place) => existsSync(join(place, "package-lock.json")) ? readFileSync(join(place, "package-lock.json"), "utf8") : "";
const stale = lock(source) !== lock(folder) || !existsSync(join(folder, "node_modules/.package-lock.json"));
for (const name of ["package.json", "package-lock.json", "tsconfig.json", "src", "test"]) {
  cpSync(join(source, name), join(folder, name), { recursive: true });
}
if (stale) {
  const done = spawnSync(npm, ["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--prefer-offline", "--loglevel=error"],
    { cwd: folder, encoding: "utf8", timeout: 240_000 });
  if (done.status !== 0) {
    console.log(`skipped: npm ci failed: ${(done.stderr || done.stdout || String(done.error)).slice(0, 600)}`);
    process.exit(77);
  }
}
