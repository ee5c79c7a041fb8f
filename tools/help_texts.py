"""Reads the --help output of a CLI11 program strictly, so that no option can get lost.

    program = read_program("build/release/bin/fairway", "fairway")
"""
import dataclasses
import re
import subprocess

COLUMN = 30  # where descriptions start
# Names, then: the value's name, its check, the default, how many.
LABEL = re.compile(
    r"(?P<names>-[^ ]+|[A-Za-z_-]+)"
    r"(?: (?P<value>KEY=VALUE|(?!REQUIRED)[^ :={]+)?"
    r"(?::(?P<check>\{[^}]*\}|[A-Z]+(?: in \[[^]]*\])?))?"
    r"(?:=(?P<default>[^ ]+))?)?"
    r"(?P<many> x \d+| \.\.\.)?(?P<required> REQUIRED)?")


@dataclasses.dataclass
class Entry:
    """An option, an argument, or (with only a name) a subcommand."""
    names: list
    text: str
    value: str = ""
    choices: list = dataclasses.field(default_factory=list)
    range: str = ""
    default: str = ""
    required: bool = False

    def kind(self):
        """What the value is: "choice", "directory", "file", a file extension like ".csv", or ""."""
        if self.choices:
            return "choice"
        for word in (self.value, self.names[-1].lstrip("-").upper()):
            for name, kind in KINDS.items():
                if word == name or word.endswith("." + name):
                    return kind
        return ""


KINDS = {"toml": ".toml", "safetensors": ".safetensors", "PLAN": ".safetensors",
         "CERT": ".safetensors", "CERT|BITMAP": ".safetensors", "PLAN|CERT|BITMAP": ".safetensors",
         "CSV": ".csv", "JSON": ".json", "DIR": "directory", "FILE": "file", "tif": ".tif"}


@dataclasses.dataclass
class Help:
    name: str
    does: str
    arguments: list = dataclasses.field(default_factory=list)
    options: list = dataclasses.field(default_factory=list)  # (title, entries)
    commands: list = dataclasses.field(default_factory=list)  # entries
    footer: list = dataclasses.field(default_factory=list)  # lines
    pages: list = dataclasses.field(default_factory=list)  # Help of each command

    def all_options(self):
        return [entry for _, entries in self.options for entry in entries]


def entry_of(label, text):
    found = LABEL.fullmatch(label)
    if not found:
        raise ValueError(f"cannot parse in a help text: {label!r}")
    check = found["check"] or ""
    return Entry(found["names"].split(","), text, found["value"] or "",
                 check[1:-1].split(",") if check.startswith("{") else [],
                 check.partition(" in ")[2], found["default"] or "", bool(found["required"]))


def entries_of(lines):
    """`  LABEL   description`, or the description on separate lines, from the same column."""
    entries = []
    for line in lines:
        if line.startswith(" " * COLUMN):
            entries[-1][1].append(line.strip())
        elif LABEL.fullmatch(line.strip()):
            entries.append((line.strip(), []))
        else:
            entries.append((line[:COLUMN].strip(), [line[COLUMN:].strip()]))
    return [entry_of(label, " ".join(text)) for label, text in entries]


def read_help(name, text):
    lines = text.rstrip("\n").split("\n")
    usage = next(i for i, line in enumerate(lines) if line.startswith("Usage: "))
    does = " ".join(lines[:usage]).removeprefix(f"{name}: ")
    page = Help(name, does)
    i = usage + 1
    while i < len(lines):
        title = lines[i]
        i += 1
        if title.endswith(":") and i < len(lines) and lines[i].startswith("  "):
            begin = i
            while i < len(lines) and lines[i].startswith("  "):
                i += 1
            if title == "Subcommands:":
                page.commands = [Entry([line.split()[0]], line[COLUMN:].strip())
                                 for line in lines[begin:i]]
            elif title == "Positionals:":
                page.arguments = entries_of(lines[begin:i])
            else:
                page.options.append((title.rstrip(":"), entries_of(lines[begin:i])))
        elif title or page.footer:
            page.footer.append(title)
    return page


def help_of(program, *command):
    done = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True)
    return done.stdout


def read_program(program, name):
    """The Help of a program, with that of its commands in `pages`."""
    page = read_help(name, help_of(program))
    page.pages = [read_help(f"{name} {c.names[0]}", help_of(program, c.names[0]))
                  for c in page.commands]
    return page
