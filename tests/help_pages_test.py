#!/usr/bin/env python3
"""Manual pages and completions: no option is lost, readers accept them, a TAB completes.

Usage: help_pages_test.py PAGES PROGRAM PROGRAM [unittest arguments]
"""
import gzip
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tools"))
import help_texts  # noqa: E402

PAGES = PROGRAMS = None


def raw_help(program, *command):
    return subprocess.run([program, *command, "--help"], capture_output=True, text=True).stdout


def options_told(text):
    """Every long option at the beginning of a line of help."""
    return set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", text, re.M))


def typed(shell, environment, keys, wanted):
    """What a terminal shows once `keys` are typed into a shell, as soon as `wanted` is there."""
    child, terminal = pty.fork()
    if child == 0:
        os.execvpe(shell[0], shell, {**os.environ, "TERM": "dumb", **environment})
    shown = b""

    def read_until(word, seconds):
        nonlocal shown
        end = time.monotonic() + seconds
        while word not in shown and time.monotonic() < end:
            if select.select([terminal], [], [], 0.1)[0]:
                try:
                    shown += os.read(terminal, 65536)
                except OSError:
                    return
    for line in keys[:-1]:
        os.write(terminal, line + b"\n")
    os.write(terminal, b"echo rea''dy\n")
    read_until(b"ready", 20)
    shown = b""
    os.write(terminal, keys[-1])
    read_until(wanted, 20)
    os.close(terminal)
    os.waitpid(child, 0)
    return shown


class HelpPages(unittest.TestCase):
    def every_help(self):
        for program in PROGRAMS:
            tree = help_texts.read_program(program, program.name)
            yield program.name, "", raw_help(program)
            for command in tree.commands:
                yield program.name, command.names[0], raw_help(program, command.names[0])

    def test_every_option_of_every_command_is_in_its_manual_page(self):
        count = 0
        for program, command, text in self.every_help():
            if command == "check":  # fairway-check's page is that of the program
                continue
            name = f"{program}-{command}" if command else program
            page = gzip.decompress((PAGES / f"man1/{name}.1.gz").read_bytes()).decode()
            page = page.replace("\\-", "-")
            for option in options_told(text):
                self.assertIn(f"\\fB{option}\\fR", page, name)
                count += 1
        self.assertGreater(count, 60)

    def test_every_option_of_every_command_is_in_every_completion(self):
        for program, command, text in self.every_help():
            bash = (PAGES / f"completions/bash/{program}").read_text()
            zsh = (PAGES / f"completions/zsh/_{program}").read_text()
            fish = (PAGES / f"completions/fish/{program}.fish").read_text()
            bash_line = next(l for l in bash.splitlines() if l.strip().startswith(f"{command}:-*)"))
            for option in options_told(text):
                self.assertRegex(bash_line, rf"[' ]{option}[' ]")
                self.assertIn(f"{option}[", zsh)
                where = f"from {command}' " if command else ""
                self.assertTrue(any(where in l and f"-l {option[2:]} " in l
                                    for l in fish.splitlines()), (command, option))

    def test_a_line_of_help_that_is_not_understood_is_an_error(self):
        good = "does\nUsage: p [OPTIONS]\n\nOptions:\n  --fast N:INT in [1 - 4]=2   how fast\n"
        option = help_texts.read_help("p", good).all_options()[0]
        self.assertEqual((option.names, option.value, option.range, option.default, option.text),
                         (["--fast"], "N", "[1 - 4]", "2", "how fast"))
        for label in ("--fast N M", "--fast N NEEDS: --slow", "two words here"):
            bad = good.replace("--fast N:INT in [1 - 4]=2 ", label.ljust(27))
            with self.assertRaises(ValueError, msg=label):
                help_texts.read_help("p", bad)

    def test_readers_of_manuals_have_nothing_to_say(self):
        readers = [r for r in ("mandoc", "man") if shutil.which(r)]
        if not readers:
            self.skipTest("neither mandoc nor man is installed")
        for page in sorted((PAGES / "man1").glob("*.gz")):
            if "mandoc" in readers:
                done = subprocess.run(["mandoc", "-Tlint", "-W", "warning", page],
                                      capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stdout), (0, ""), page)
            if "man" in readers:
                done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", page],
                                      capture_output=True, text=True,
                                      env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "80"})
                if "nothing" not in done.stderr:  # a man without its system
                    self.assertEqual(done.stderr, "", page)

    def complete(self, shell, environment, load, keys, wanted):
        if not shutil.which(shell[0]):
            self.skipTest(f"{shell[0]} is not installed")
        shown = typed(shell, environment, [*load, keys], wanted)
        self.assertIn(wanted, shown)

    def test_a_tab_in_bash_completes_commands_options_and_values(self):
        shell = ["bash", "--norc", "--noprofile", "-i"]
        load = [f"source '{PAGES}/completions/bash/{p.name}'".encode() for p in PROGRAMS]
        for keys, wanted in ((b"fairway ver\t", b"fairway verify "),
                             (b"fairway verify --met\t", b"--method "),
                             (b"fairway verify --method b\t", b"bitmap "),
                             (b"fairway query --js\t", b"--json "),
                             (b"fairway-check --sam\t", b"--samples ")):
            self.complete(shell, {"PS1": "> "}, load, keys, wanted)

    def test_bash_offers_files_by_their_ending(self):
        script = f"""source '{PAGES}/completions/bash/fairway'
            cd "$(mktemp -d)" && touch a.toml b.csv c.safetensors && mkdir folder
            ask() {{ COMP_WORDS=(fairway "$@"); COMP_CWORD=$#; _fairway; echo "${{COMPREPLY[@]}}"; }}
            ask run ''; ask query ''; ask query --states ''; ask run -o ''; ask '' | wc -w
            rm -r "$PWD" """
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        commands = len(help_texts.read_program(PROGRAMS[0], "fairway").commands)
        self.assertEqual(done.stdout.split("\n")[:5], ["a.toml folder", "c.safetensors folder",
                                                       "b.csv folder", "folder", str(commands)])

    def test_a_tab_in_zsh_completes_commands_options_and_values(self):
        load = [f"fpath=('{PAGES}/completions/zsh' $fpath)".encode(),
                b"autoload -U compinit && compinit -u -D && PS1='> '"]
        for keys, wanted in ((b"fairway ver\t", b"verify"), (b"fairway verify --met\t", b"--method"),
                             (b"fairway verify --method bit\t", b"bitmap")):
            self.complete(["zsh", "-f", "-i"], {}, load, keys, wanted)

    def test_fish_completes_commands_options_and_values(self):
        if not shutil.which("fish"):
            self.skipTest("fish is not installed")
        asked = "; ".join(f'complete -C "{words}"' for words in
                          ("fairway ver", "fairway verify --met", "fairway verify --method b"))
        done = subprocess.run(["fish", "--no-config", "-c",
                               f"source '{PAGES}/completions/fish/fairway.fish'; {asked}"],
                              capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        self.assertEqual([line.split("\t")[0] for line in done.stdout.splitlines()],
                         ["verify", "--method", "bitmap"])


if __name__ == "__main__":
    PAGES = pathlib.Path(sys.argv.pop(1)).resolve()
    PROGRAMS = [pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2)]
    unittest.main()
