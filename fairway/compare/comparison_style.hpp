// The look of the page of a comparison: the colours and measures of the page of a run
// (web/src/style.css), in the light and in the dark.
#pragma once

namespace fairway {

inline constexpr const char* comparison_style = R"css(
:root {
  --paper: #fdfcfa; --sheet: #ffffff; --ink: #22262b; --soft: #5a626c; --line: #dfe1e3;
  --accent: #285d9f; --warn: #b0461b; --good: #1d6b45;
  --ground: #ffffff; --obstacle: #55585e; --goal: #7cc9ab; --mixed: #8d6aae; --stroke: #ffffff;
  --a1: #c5daf3; --a2: #6f9fdb; --a3: #1f4f8c; --b1: #f7cfb9; --b2: #e08a57; --b3: #a23d13;
  color-scheme: light dark;
  font: 15px/1.5 Inter, system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif;
}
@media (prefers-color-scheme: dark) { @media screen { :root {
  --paper: #15181c; --sheet: #1c2025; --ink: #e4e7ea; --soft: #a7afb8; --line: #30363d;
  --accent: #7fb0ec; --warn: #f0915f; --good: #7fd0a6;
  --ground: #23282e; --obstacle: #6b7178; --goal: #2f7d60; --mixed: #b494d6; --stroke: #15181c;
  --a1: #2d4a6e; --a2: #5590d6; --a3: #b3d4fb; --b1: #64371f; --b2: #d0733c; --b3: #ffc29d;
} } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font-variant-numeric: tabular-nums; }
h1, h2, p, ul, figure { margin: 0; padding: 0; }
h1 { font-size: 1.65rem; font-weight: 650; letter-spacing: -.015em; line-height: 1.2; overflow-wrap: anywhere; }
h2 { font-size: 1.12rem; font-weight: 640; margin-bottom: .35rem; }
a { color: var(--accent); }
:focus-visible { outline: 2.5px solid var(--accent); outline-offset: 2px; border-radius: 3px; }
header, main, .notice { max-width: 82rem; margin-inline: auto; padding-inline: clamp(.8rem, 2.5vw, 2rem); }
header { padding-top: 1.4rem; }
.hint, figcaption p { color: var(--soft); max-width: 46rem; margin-bottom: .8rem; }
.notice { margin-block: 1rem; padding-block: .6rem; border-left: 3px solid var(--warn); background: var(--sheet); }
.notice ul { padding-left: 1.2rem; }
section { margin-block: 1.4rem 2.2rem; }
.lead { list-style: none; font-size: 1.12rem; line-height: 1.4; max-width: 76rem; }
.lead li { padding-block: .25rem; border-top: 1px solid var(--line); }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 30rem), 1fr)); gap: 2rem; align-items: start; }
.beside { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 34rem), 1fr)); column-gap: 2.2rem; align-items: start; }
.beside > section { min-width: 0; margin-block: 0 2rem; }
figure { min-width: 0; max-width: 60rem; }
.map { display: block; width: 100%; max-height: 80vh; background: var(--ground); border: 1px solid var(--line); border-radius: 6px; }
.key { list-style: none; display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: .15rem 1.2rem; font-size: .86rem; margin-block: .7rem; }
.key li { display: flex; gap: .6rem; align-items: baseline; }
.key i { width: 1.9rem; height: .95rem; flex: none; translate: 0 .12rem; border: 1px solid var(--soft); border-radius: 2px; }
.same { fill: var(--ground); background: var(--ground); }
.obstacle { fill: var(--obstacle); background: var(--obstacle); }
.goal { fill: var(--goal); background: var(--goal); }
.mixed { fill: var(--mixed); background: var(--mixed); }
.a1 { fill: var(--a1); background: var(--a1); } .a2 { fill: var(--a2); background: var(--a2); } .a3 { fill: var(--a3); background: var(--a3); }
.b1 { fill: var(--b1); --of: var(--b1); } .b2 { fill: var(--b2); --of: var(--b2); } .b3 { fill: var(--b3); --of: var(--b3); }
.key i[class^="b"] { background: repeating-linear-gradient(135deg, var(--of) 0 5px, var(--stroke) 5px 6.5px); }
.stroke { fill: var(--stroke); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; background: var(--sheet); border: 1px solid var(--line); }
th, td { padding: .28rem .9rem; text-align: right; white-space: nowrap; }
thead th { border-bottom: 1px solid var(--line); vertical-align: bottom; overflow-wrap: break-word; white-space: normal; min-width: 5.5rem; }
thead th:first-child, tbody th { text-align: left; }
tbody th { font-weight: 500; }
tbody tr + tr > * { border-top: 1px solid var(--line); }
tbody th:first-child { position: sticky; left: 0; background: var(--sheet); white-space: normal; min-width: 9rem; }
.group th { color: var(--soft); font-size: .86rem; padding-top: .9rem; }
td small { display: block; color: var(--soft); }
.better { color: var(--good); font-weight: 600; } .worse { color: var(--warn); font-weight: 600; }
.plain td { text-align: left; white-space: normal; overflow-wrap: anywhere; min-width: 10rem; }
.plain thead th { text-align: left; }
code { font: .86em/1.4 ui-monospace, SFMono-Regular, Menlo, Consolas, monospace; overflow-wrap: anywhere; }
.wide + .hint { margin-top: .8rem; }
@media (max-width: 40rem) { .key { grid-template-columns: 1fr; } th, td { padding-inline: .5rem; } .lead { font-size: 1rem; } }
@media print { body { font-size: 10pt; } figure, tr { break-inside: avoid; } }
)css";

}  // namespace fairway
