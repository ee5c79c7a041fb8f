#!/usr/bin/python3
"""Plans the demonstration's scenarios with FAIRWAY and flies random states with both programs.

    flights_agree_test.py FAIRWAY DEMO_FOLDER
"""

import os
import subprocess
import sys
import tempfile

try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)

ORACLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "fly.py")


def main():
    fairway, demo = sys.argv[1:]
    good = True
    with tempfile.TemporaryDirectory() as folder:
        for scenario in ("demo.toml", "path.toml"):
            plan = os.path.join(folder, scenario + ".safetensors")
            subprocess.run(
                [fairway, "plan", os.path.join(demo, scenario), "-o", plan, "--quiet"],
                check=True,
                stdout=subprocess.DEVNULL,
            )
            print(scenario, flush=True)
            answer = subprocess.run(
                [sys.executable, ORACLE, plan, "--random", "5000", "--seed", "3", "--command", fairway]
            )
            good = good and answer.returncode == 0
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
