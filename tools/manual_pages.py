#!/usr/bin/env python3
"""Manual pages in roff, made from help texts.

Usage: manual_pages.py --version VERSION --date YYYY-MM-DD -o DIR PROGRAM...
Writes DIR/NAME.1.gz for each program and each of its commands.
"""
import argparse
import gzip
import pathlib

from help_texts import read_program

DOCUMENTATION = "/usr/share/doc/fairway"


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("`", "\\(ga")
    return "\\&" + text if text[:1] in (".", "'") else text


def bold(text):
    return f"\\fB{roff(text)}\\fR"


def italic(text):
    return f"\\fI{roff(text)}\\fR"


def placeholder(argument):
    return argument.names[0] if argument.names[0].isupper() else argument.value or argument.names[0]


def shown(entry):
    value = f" {italic(entry.value or '|'.join(entry.choices))}" if entry.value or entry.choices else ""
    if not entry.names[0].startswith("-"):  # an argument is called by its value's name
        return italic(placeholder(entry))
    return ", ".join(bold(name) for name in entry.names) + value


def details(entry):
    told = []
    if entry.choices and entry.value:
        told.append("One of " + ", ".join(entry.choices) + ".")
    if entry.range and not entry.range.endswith("1073741824]"):
        told.append(f"In {entry.range}.".replace(" - ", " to "))
    if entry.default and "(default" not in entry.text:
        told.append(f"Default: {entry.default}.")
    if entry.required:
        told.append("Required.")
    return told


def entries(title, list_of_entries):
    lines = [f".SH {roff(title.upper())}"]
    for entry in list_of_entries:
        sentence = entry.text
        if not sentence.split(" ")[0].endswith(":"):  # not the meaning of a value of that name
            sentence = sentence[:1].upper() + sentence[1:]
        sentence += "" if sentence.endswith((".", ")")) or not sentence else "."
        lines += [".TP", shown(entry), roff(" ".join([sentence, *details(entry)]))]
    return lines


def synopsis(page):
    options = ["[" + italic("OPTIONS") + "]"]
    options += [shown(e) for e in page.all_options() if e.required]
    options += [italic(placeholder(e)) for e in page.arguments]
    if page.commands:
        options += [italic("COMMAND"), "..."]
    return [".SH SYNOPSIS", bold(page.name) + " " + " ".join(options)]


def footer(page):
    """The footer, split into description, examples and exit status."""
    told, examples, status = [], [], []
    for line in page.footer:
        if line.startswith("Example: "):
            examples.append(line.removeprefix("Example: "))
        elif line.startswith("Exit codes: "):
            status.append(line.removeprefix("Exit codes: "))
        else:
            told.append(line)
    return told, examples, status


def manual(page, version, date, see_also):
    name = page.name.replace(" ", "-")
    told, examples, status = footer(page)
    lines = [f'.TH {roff(name.upper())} 1 {date} "fairway {version}" "Fairway"', ".SH NAME",
             f"{roff(name)} \\- {roff(page.does.rstrip('.'))}", *synopsis(page)]
    if any(told):
        lines.append(".SH DESCRIPTION")
        for line in told:
            lines.append(roff(line) if line else ".PP")
    if page.arguments:
        lines += entries("Arguments", page.arguments)
    for title, group in page.options:
        lines += entries(title, group)
    if page.commands:
        lines += entries("Commands", page.commands)
        lines += [".PP", f"Each has its own page: \\fB{roff(page.name)}\\-\\fICOMMAND\\fR(1)."]
    if examples:
        lines += [".SH EXAMPLES", ".EX", *(roff(line) for line in examples), ".EE"]
    if status:
        lines += [".SH EXIT STATUS", *(roff(line) for line in status)]
    others = sorted(other for other in see_also if other != name)
    lines += [".SH SEE ALSO", ",\n".join(f"\\fB{roff(other)}\\fR(1)" for other in others),
              ".PP", f"The documentation is in {roff(DOCUMENTATION)}."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", nargs="+", type=pathlib.Path)
    parser.add_argument("-o", dest="folder", type=pathlib.Path, required=True)
    parser.add_argument("--version", required=True)
    parser.add_argument("--date", required=True)
    arguments = parser.parse_args()
    pages = []
    for path in arguments.programs:
        program = read_program(path, path.name)
        pages.append(program)
    # `fairway check` is fairway-check: the program's page is more complete.
    alone = {page.name for page in pages}
    pages += [page for program in pages for page in program.pages
              if page.name.replace(" ", "-") not in alone]
    names = [page.name.replace(" ", "-") for page in pages]
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for old in arguments.folder.glob("*.1.gz"):
        old.unlink()
    for name, page in zip(names, pages):
        text = manual(page, arguments.version, arguments.date, names)
        with open(arguments.folder / f"{name}.1.gz", "wb") as file:
            # No name or time inside: the same page gives the same bytes.
            with gzip.GzipFile("", "wb", 9, file, mtime=0) as packed:
                packed.write(text.encode())


if __name__ == "__main__":
    main()
