#!/usr/bin/env python3
"""Markdown is wrapped at 100 columns, except where it cannot be: tables, code, headings, long words.

Usage: markdown_lines_test.py SOURCE_DIR. Prints every line that is too long; exit 1 if any.
"""
import pathlib
import re
import sys

LIMIT = 100
CODE_SPAN = re.compile(r"(`+)(?!`).+?(?<!`)\1(?!`)")
ITEM = re.compile(r"\s*(?:[-*+]|\d+[.)])\s+")


def can_be_broken(line):
    """Whether there is a space to break at before the limit, not in code."""
    text = CODE_SPAN.sub(lambda code: "x" * len(code[0]), line)
    marker = ITEM.match(text)
    begin = marker.end() if marker else len(text) - len(text.lstrip())
    return " " in text[begin : LIMIT + 1]


def too_long(text):
    """Numbers of the lines that should be broken, from 1."""
    found = []
    fence = None
    in_list = in_paragraph = False
    for number, line in enumerate(text.split("\n"), start=1):
        stripped = line.strip()
        if fence:
            if stripped == fence:
                fence = None
            continue
        opened = re.match(r"(`{3,}|~{3,})", stripped)
        if opened:
            fence = opened[1]
            continue
        if ITEM.match(line):
            in_list = True
        elif stripped and not in_paragraph and not line.startswith(" "):
            in_list = False
        is_code = line.startswith("    ") and not in_list and not in_paragraph
        in_paragraph = bool(stripped) and not is_code
        if stripped.startswith(("|", "#", "<!--")) or is_code:
            continue
        if len(line) > LIMIT and can_be_broken(line):
            found.append(number)
    return found


def check_itself():
    words = "word " * 30
    code = "`" + words.strip() + "`"
    assert too_long(words) == too_long("- " + words) == [1]
    assert too_long("a\n\n- b\n\n    " + words) == [5], "a paragraph of an item"
    for fine in ["| " + words, "# " + words, "```\n" + words + "\n```", "a\n\n    " + words, "x" * 120, code,
                 "1. " + code]:
        assert too_long(fine) == [], fine


def main():
    check_itself()
    root = pathlib.Path(sys.argv[1])
    files = sorted([*root.glob("*.md"), *(root / "docs").rglob("*.md")])
    found = [f"{file}:{number}: longer than {LIMIT} columns"
             for file in files for number in too_long(file.read_text())]
    print("\n".join(found) if found else f"{len(files)} files are wrapped")
    return 1 if found or len(files) < 10 else 0


if __name__ == "__main__":
    sys.exit(main())
