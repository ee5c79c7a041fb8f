#!/usr/bin/env python3
"""The files that docs/trust.md calls trusted are those the proofs need, with the stated line counts.

Usage: trusted_lines_test.py SOURCE_DIR [--print]. For each table of trusted files: its files are
those that its roots include, themselves included, headers with their sources; each has as many
lines that are neither blank nor comment as its row says. Prints what is wrong; exit 1 if anything.
"""
import pathlib
import re
import sys

# heading in docs/trust.md -> files from which the rest follows
ROOTS = {
    "What a verdict rests on": ["fairway/verify/prover.cpp", "fairway/verify/undecided_sections.cpp",
                                "fairway/verify/reprove.cpp", "fairway/runtime.hpp"],
    "What the check rests on": ["check/main.cpp"],
}
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)
ROW = re.compile(r"^\| `([^`]+)` \| (\d+) \|", re.M)
TOTAL = re.compile(r"^\| \*\*all\*\* \| \*\*([\d,]+)\*\* \|", re.M)


def needed(root, files):
    found, waiting = set(), list(files)
    while waiting:
        name = waiting.pop()
        if name in found:
            continue
        found.add(name)
        waiting += INCLUDE.findall((root / name).read_text())
        source = name.removesuffix(".hpp") + ".cpp"
        if name.endswith(".hpp") and (root / source).is_file():
            waiting.append(source)
    return found


def lines_of_code(text):
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    return sum(1 for line in text.splitlines() if re.sub(r"//.*", "", line).strip())


def main():
    root = pathlib.Path(sys.argv[1])
    text = (root / "docs" / "trust.md").read_text()
    wrong = []
    for heading, roots in ROOTS.items():
        count = {f: lines_of_code((root / f).read_text()) for f in sorted(needed(root, roots))}
        if "--print" in sys.argv:
            print(f"## {heading}\n\n| file | lines |\n|---|---|")
            print("\n".join(f"| `{name}` | {n} |" for name, n in count.items()))
            print(f"| **all** | **{sum(count.values()):,}** |\n")
            continue
        part = text.split(f"## {heading}\n")
        if len(part) != 2:
            wrong.append(f"docs/trust.md has no section \"{heading}\"")
            continue
        section = part[1].split("\n## ")[0]
        said = {name: int(n) for name, n in ROW.findall(section)}
        for name in sorted(set(said) | set(count)):
            if said.get(name) != count.get(name):
                wrong.append(f"{heading}: {name}: said {said.get(name)}, found {count.get(name)}")
        total = TOTAL.search(section)
        if not total or int(total[1].replace(",", "")) != sum(count.values()):
            wrong.append(f"{heading}: the sum is {sum(count.values()):,}")
    if "--print" in sys.argv:
        return 0
    print("\n".join(wrong) if wrong else "trusted is what is needed, line by line")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
