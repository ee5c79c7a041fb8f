#!/usr/bin/env python3
"""Fits a vehicle contract to some flights of each autopilot, and holds its others against it.

Usage: contract_table.py FAIRWAY FOLDER [WORK_FOLDER]

FOLDER holds logs named AUTOPILOT_FLIGHT_CONDITIONS.csv. For each autopilot there are two contracts:
"calm", fitted to flights in still air, and "any", fitted to flights in wind and turbulence. Prints
the contracts and, for every log, the tracking distance that it needs, as Markdown tables.
"""
import json
import math
import pathlib
import re
import subprocess
import sys

# Flights that a contract is fitted to, where the autopilot has them; all others test it.
FITTED = {
    "calm": ["steps_calm", "walk_calm", "reversal_calm"],
    "any": ["steps_wind25", "random_wind25_moderate", "reversal_calm"],
}
MARGIN = 0.2


def run(words):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    return done.stdout


def is_calm(flight):
    return flight.endswith("_calm")


def row(cells):
    print("| " + " | ".join(cells) + " |", flush=True)


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    work = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else "contracts")
    work.mkdir(exist_ok=True)
    logs = {}
    for file in sorted(folder.glob("*.csv")):
        autopilot, flight = file.stem.split("_", 1)
        logs.setdefault(autopilot, {})[flight] = file
    contracts = {}
    row(["autopilot", "contract", "r (m)", "tracking", "rho", "eps (deg)", "radius", "speed (m/s)", "side (deg)"])
    row(["---"] * 9)
    for autopilot, flights in logs.items():
        for kind, names in FITTED.items():
            fitted = [flights[name] for name in names if name in flights]
            file = work / f"{autopilot}_{kind}.toml"
            run([program, "contract", "--log", *fitted, "--margin", MARGIN, "--force", "-o", file])
            text = file.read_text()
            r = float(re.search(r"radius of ([\d.]+) m", text).group(1))
            value = {key: json.loads(shown) for key, shown in re.findall(r"^(\w+) = (.*)$", text, re.M)}
            contracts[autopilot, kind] = (file, r, names)
            low, high = value["turn_radius_m"]
            row([autopilot, kind, f"{r:.1f}", "0.10 r", f"{value['command_error_m'] / r:.2f} r",
                 f"{math.degrees(value['heading_error_rad']):.1f}", f"{low / r:.2f} to {high / r:.2f} r",
                 f"{value['speed_mps'][0]:.1f} to {value['speed_mps'][1]:.1f}",
                 f"{math.degrees(value['side_uncertain_rad']):.0f}"])
    print()
    row(["log", "contract", "fitted to it", "needs", "keeps it", "worst at t (s)"])
    row(["---"] * 6)
    for autopilot, flights in logs.items():
        for kind in FITTED:
            file, r, names = contracts[autopilot, kind]
            told = [flight for flight in flights if kind == "any" or is_calm(flight)]
            said = json.loads(run([program, "contract", "--json", "--contract", file, "--tracking-m", 0.1 * r,
                                   "--log", *(flights[f] for f in told)]))
            for flight, held in zip(told, said["logs"]):
                needs = "none" if held["needs_m"] is None else f"{held['needs_m'] / r:.3f} r"
                row([f"{autopilot}_{flight}", kind, "yes" if flight in names else "", needs,
                     "yes" if held["kept"] else "**no**", f"{held['worst_s']:.0f}"])


main()
