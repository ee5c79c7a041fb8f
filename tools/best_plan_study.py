#!/usr/bin/env python3
"""Takes scenarios through `tune`, `improve`, `compare` and `ceiling`: one page of before and after each.

Usage: best_plan_study.py FAIRWAY OUT [--evaluations N] SCENARIO.toml...

For each scenario, in OUT/NAME: the plan as given, the tuned one, the tuned one improved,
compare.html of the three, and what any control could keep. What is there already is not made
again. Prints a Markdown table; times are wall times with the proofs.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import time


def run(words, may_fail=False):
    """Standard output, and the seconds it took; None if the program refused and may."""
    begun = time.monotonic()
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    took_s = time.monotonic() - begun
    if done.returncode == 0:
        return done.stdout, took_s
    if may_fail and done.returncode == 1:
        return None, took_s
    sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")


class Study:
    def __init__(self, fairway, out, evaluations):
        self.fairway = fairway
        self.out = out
        self.evaluations = evaluations

    def take(self, scenario):
        folder = self.out / scenario.stem
        folder.mkdir(parents=True, exist_ok=True)
        notes = folder / "took.json"
        took_s = json.loads(notes.read_text()) if notes.exists() else {}

        def step(name, product, words, may_fail=False):
            if name in took_s:
                return
            if product.is_dir():
                words.append("--force")
            took_s[name] = run([self.fairway, *words], may_fail)[1]
            notes.write_text(json.dumps(took_s))

        given = folder / "given.safetensors"
        tuned = folder / "tuned"
        improved = folder / "improved.safetensors"
        page = folder / "page"
        step("plan", given, ["plan", scenario, "-o", given, "--force"])
        step("tune", tuned, ["tune", scenario, "-o", tuned, "--evaluations", self.evaluations])
        step("improve", improved,
             ["improve", tuned / "plan.safetensors", "-o", improved, "--force"], may_fail=True)
        plans = [given, tuned / "plan.safetensors"] + ([improved] if improved.exists() else [])
        step("compare", page, ["compare", *plans, "-o", page])
        if not (folder / "ceiling.json").exists():
            text, took_s["ceiling"] = run([self.fairway, "ceiling", given, "--json"])
            (folder / "ceiling.json").write_text(text)
            notes.write_text(json.dumps(took_s))
        return folder, took_s


def row(scenario, folder, took_s):
    compared = json.loads((folder / "page" / "comparison.json").read_text())
    shares = [plan["exact"]["all"]["reach"]["value"] for plan in compared["plans"]]
    ceiling = json.loads((folder / "ceiling.json").read_text())["ceiling"]
    cells = [scenario.stem, *(f"{100 * s:.1f} %" for s in shares)]
    cells += ["not better"] * (4 - len(cells))
    cells += [f"{100 * ceiling[0]:.1f} to {100 * ceiling[1]:.1f} %",
              f"{100 * max(shares) / ceiling[1]:.0f} %",
              *(f"{took_s[step]:.0f} s" for step in ("tune", "improve", "compare", "ceiling"))]
    return "| " + " | ".join(cells) + " |"


def main():
    words = argparse.ArgumentParser()
    words.add_argument("fairway", type=lambda path: pathlib.Path(path).resolve())
    words.add_argument("out", type=pathlib.Path)
    words.add_argument("--evaluations", type=int, default=200)
    words.add_argument("scenarios", type=pathlib.Path, nargs="+")
    asked = words.parse_args()
    study = Study(asked.fairway, asked.out, asked.evaluations)
    print("| scenario | as given | tuned | improved | any control | the best over it | tune | improve "
          "| compare | ceiling |\n" + "|---" * 10 + "|")
    for scenario in asked.scenarios:
        print(row(scenario, *study.take(scenario)), flush=True)


if __name__ == "__main__":
    main()
