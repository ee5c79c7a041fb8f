#!/usr/bin/python3
"""Every test that docs/papers.md names must exist in the tree."""

import re
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
named = set(re.findall(r"`([A-Z]\w+\.[A-Z]\w+)`", (root / "docs/papers.md").read_text()))
declared = set()
for source in [*root.glob("fairway/*/*_test.cpp"), *root.glob("reproduce/*_test.cpp")]:
    for suite, test in re.findall(r"\b(?:TEST|TEST_F|TEST_P|RC_GTEST_PROP)\(\s*(\w+),\s*(\w+)",
                                  source.read_text()):
        declared.add(f"{suite}.{test}")
missing = sorted(named - declared)
for name in missing:
    print(f"docs/papers.md names {name}, which no test source declares")
if len(named) < 10:
    sys.exit("docs/papers.md names hardly any tests: the check no longer tests anything")
sys.exit(1 if missing else 0)
