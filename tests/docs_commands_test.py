#!/usr/bin/env python3
"""Runs every command in the docs and compares its output. CONTRIBUTING.md has the rules.

Usage: docs_commands_test.py SOURCE PROGRAM [unittest arguments]

- In a fenced block ```console, lines that begin with "$ " are run; "> " continues a command. Its
  output follows: `...` matches anything in a line, a line of `...` any lines. If the page shows no
  output, anything may be printed. A command must exit with 0, unless the next one is `echo $?`. A
  page is run from top to bottom in one shell, in its own folder with `demo/`; README in a fresh copy
  of the sources, already built and with nothing on the PATH.
- A block with title="NAME" is a file NAME in that folder; if NAME begins with tests/, it must equal
  that file of the sources exactly.
- A block with title="Not run by the tests: REASON" is not run, nor is any other block; but its
  commands, and those in `code` within sentences, must exist, with every option they are given.
- Every link to a file, from README, CHANGELOG and the like and from docs/, leads to an existing file and heading.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = PROGRAM = None
FENCE = re.compile(r"^```(\S*)[ ]?(.*)$")
TITLE = re.compile(r'title="([^"]*)"')
PROGRESS = re.compile(r"^fairway: .* so far.*\n", re.M)  # a line now and then, on a slow machine
NOT_RUN = "Not run by the tests: "


def pages():
    files = [*SOURCE.glob("*.md"), *(SOURCE / "docs").rglob("*.md")]
    return sorted(str(file.relative_to(SOURCE)) for file in files)


def blocks(text):
    """(language, title, lines, number of the first line) of every fenced block."""
    found, begin = [], None
    for number, line in enumerate(text.split("\n"), 1):
        fence = FENCE.match(line)
        if fence and begin is None:
            title = TITLE.search(fence[2])
            begin = (fence[1], title[1] if title else "", [], number + 1)
        elif line == "```":
            found.append(begin)
            begin = None
        elif begin is not None:
            begin[2].append(line)
    return found


def steps(lines, first):
    """(command, the output in the page or None, line number) of a console block."""
    told = []
    for number, line in enumerate(lines, first):
        if line.startswith("$ "):
            told.append([line[2:], None, number])
        elif line.startswith("> ") and told[-1][1] is None and told[-1][0].endswith("\\"):
            told[-1][0] += "\n" + line[2:]
        else:
            told[-1][1] = [*(told[-1][1] or []), line]
    return told


def pattern_of(lines):
    parts = [r"(?:.*\n)*" if line.strip() == "..." else
             "".join("[^\n]*" if part == "..." else re.escape(part)
                     for part in re.split(r"(\.\.\.)", line.rstrip())) + "\n" for line in lines]
    return re.compile("".join(parts))


def prose_and_blocks(text):
    """Everything that might be a command besides those that are run: (words, where)."""
    for language, title, lines, first in blocks(text):
        if language in ("console", "sh", "bash", "", "text"):
            for number, line in enumerate(lines, first):
                yield line.removeprefix("$ "), number
    fenced = False
    for number, line in enumerate(text.split("\n"), 1):
        fenced ^= line.startswith("```")
        if not fenced and line.startswith("    "):
            yield line.strip(), number
        elif not fenced:
            for code in re.findall(r"`([^`]+)`", line):
                yield code, number


def anchor(heading):
    kept = re.sub(r"[^\w\s-]", "", heading.lower().replace("`", ""))
    return re.sub(r"\s+", "-", kept.strip())


class Shell:
    """Runs commands one after another like a single shell: exports and the folder persist."""

    def __init__(self, folder, environment):
        self.environment, self.ended = environment, 0
        self.folder = folder
        self.kept = pathlib.Path(tempfile.mkstemp(prefix="fairway-docs-")[1])

    def run(self, command):
        script = (f"(exit {self.ended})\n{command}\nended=$?\n"
                  f"{{ pwd; env -0; }} > {self.kept}\nexit $ended")
        done = subprocess.run(["bash", "-c", script], cwd=self.folder, env=self.environment,
                              stdin=subprocess.DEVNULL, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.ended = done.returncode
        folder, _, kept = self.kept.read_text().partition("\n")
        self.folder = folder
        self.environment = dict(pair.split("=", 1) for pair in kept.split("\0") if "=" in pair)
        return done.stdout


def copy_of_the_sources(folder):
    """As after `make build` in a fresh clone."""
    files = subprocess.run(["git", "-c", "safe.directory=*", "-C", SOURCE, "ls-files", "-z"],
                           capture_output=True, text=True)
    if files.returncode != 0:  # not a clone, or no git
        shutil.copytree(SOURCE, folder, dirs_exist_ok=True,
                        ignore=shutil.ignore_patterns("build", "out", ".git", "node_modules"))
    for name in filter(None, files.stdout.split("\0")):
        if (SOURCE / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(SOURCE / name, folder / name)
    (folder / "build/release").mkdir(parents=True)
    (folder / "build/release/bin").symlink_to(PROGRAM.parent)


class Docs(unittest.TestCase):
    maxDiff = None

    def run_page(self, page, text):
        """Types a page into a shell, in its own folder."""
        folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-docs-"))
        self.addCleanup(shutil.rmtree, folder)
        # A shell of its own: without the job server and level of a `make` that runs the tests.
        kept = {key: value for key, value in os.environ.items() if not key.startswith(("MAKE", "MFLAGS"))}
        environment = {**kept, "PATH": f"{PROGRAM.parent}:/usr/bin:/bin", "LC_ALL": "C.UTF-8",
                       "CPLUS_INCLUDE_PATH": str(SOURCE)}
        if page == "README.md":
            copy_of_the_sources(folder)
            # Already built: `make` treats its target `build` as up to date.
            shim = pathlib.Path(tempfile.mkdtemp(prefix="fairway-docs-"))
            self.addCleanup(shutil.rmtree, shim)
            (shim / "make").write_text('#!/bin/sh\nexec /usr/bin/make -o build "$@"\n')
            (shim / "make").chmod(0o755)
            environment["PATH"] = f"{shim}:/usr/bin:/bin"
        else:
            shutil.copytree(SOURCE / "demo", folder / "demo")
        shell = Shell(folder, environment)
        self.addCleanup(shell.kept.unlink)
        for language, title, lines, first in blocks(text):
            if title.startswith(NOT_RUN):
                continue
            if language == "console":
                told = steps(lines, first)
                for i, (command, output, number) in enumerate(told):
                    printed = PROGRESS.sub("", shell.run(command))
                    where = f"{page}:{number}: $ {command}\n{printed}"
                    asked = i + 1 < len(told) and told[i + 1][0] == "echo $?"
                    self.assertTrue(shell.ended == 0 or asked, f"{where}ended with {shell.ended}")
                    if output is not None and not pattern_of(output).fullmatch(
                            "".join(line.rstrip() + "\n" for line in printed.splitlines())):
                        self.fail(f"{where}-- but the page says --\n" + "\n".join(output))
            elif title.startswith("tests/"):
                self.assertEqual("\n".join(lines) + "\n", (SOURCE / title).read_text(), title)
            elif title and language:
                (folder / title).parent.mkdir(parents=True, exist_ok=True)
                (folder / title).write_text("\n".join(lines) + "\n")

    def test_commands_that_are_not_run_exist_with_their_options(self):
        known = {}
        checked = 0
        for page in pages():
            if page == "CHANGELOG.md":  # also describes older versions
                continue
            for words, number in prose_and_blocks((SOURCE / page).read_text()):
                found = re.match(r"(?:sudo )?(fairway-check|fairway)((?: .*)?)$", words)
                if not found or found[1] == "fairway" and not found[2].strip():
                    continue
                try:
                    arguments = shlex.split(found[2], comments=True)
                except ValueError:
                    continue  # half of a two-line command
                command = arguments[0] if arguments and re.fullmatch("[a-z]+", arguments[0]) else ""
                if found[1] == "fairway" and not command and not arguments[0].startswith("-"):
                    continue  # "fairway 0.1.0", "fairway COMMAND"
                key = (found[1], command)
                if key not in known:
                    program = PROGRAM.parent / found[1]
                    done = subprocess.run([program, *([command] if command else []), "--help"],
                                          capture_output=True, text=True)
                    top = subprocess.run([program, "--help"], capture_output=True, text=True)
                    known[key] = (done.returncode, done.stdout + top.stdout)
                status, told = known[key]
                with self.subTest(page=f"{page}:{number}", command=words):
                    self.assertEqual(status, 0, "no such command")
                    for option in (a for a in arguments if re.fullmatch(r"--?[a-z][a-z-]*", a)):
                        self.assertRegex(told, rf"(^|[ ,]){option}[ ,\n]")
                        checked += 1
        self.assertGreater(checked, 10)

    def test_every_link_leads_somewhere(self):
        checked = 0
        for page in pages():
            text = (SOURCE / page).read_text()
            prose = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
            for target in re.findall(r"\]\(([^)\s]+)\)", prose):
                if re.match(r"[a-z]+:", target):
                    continue
                name, _, heading = target.partition("#")
                file = (SOURCE / page).parent / name if name else SOURCE / page
                with self.subTest(page=page, link=target):
                    self.assertTrue(file.exists(), "leads nowhere")
                    if heading:
                        there = re.findall(r"^#+ (.*)$", file.read_text(), re.M)
                        self.assertIn(heading, [anchor(h) for h in there])
                    checked += 1
        self.assertGreater(checked, 20)

    def test_a_page_that_errs_is_found_out(self):
        for wrong in ("```console\n$ fairway --version\n9.9.9\n```", "```console\n$ false\n```",
                      "```console\n$ false\n$ echo $?\n0\n```",
                      "```console\n$ printf 'a\\nb\\n'\na\n```"):
            with self.assertRaises(AssertionError, msg=wrong):
                self.run_page("a page", wrong)
        self.run_page("a page", '```csv title="a/b.csv"\n1,2\n```\n```console\n$ cat a/b.csv\n1,...\n'
                      "$ false\n$ echo $?\n1\n$ cd a\n$ export B=2\n$ cat b.csv; echo $B\n1,2\n2\n$ printf 'a\\nb\\nc\\n'\na\n...\n```")


def add_pages():
    for page in pages():
        text = (SOURCE / page).read_text()
        if any(language == "console" and not title.startswith(NOT_RUN) or title.startswith("tests/")
               for language, title, _, _ in blocks(text)):
            name = re.sub(r"\W+", "_", page.removesuffix(".md"))
            setattr(Docs, f"test_page_{name}",
                    lambda self, page=page, text=text: self.run_page(page, text))


if __name__ == "__main__":
    SOURCE, PROGRAM = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
    add_pages()
    unittest.main()
