#!/usr/bin/env python3
"""Completions for bash, zsh and fish, made from help texts.

Usage: completions.py -o DIR PROGRAM...
Writes DIR/bash/NAME, DIR/zsh/_NAME and DIR/fish/NAME.fish for each program.
"""
import argparse
import pathlib
import shlex

from help_texts import read_program


def levels(program):
    """(command's name or "", its options, its arguments), all of them."""
    yield "", program.all_options(), program.arguments
    for command, page in zip(program.commands, program.pages):
        yield command.names[0], page.all_options(), page.arguments


def argument_kind(arguments):
    return arguments[0].kind() if arguments else ""


def function_name(program):
    return "_" + program.name.replace("-", "_")


# bash

BASH_FILES = r"""# Files by extension (or any, or only folders), and folders on the way to them.
{f}_files() {{
    local IFS=$'\n'
    compopt -o filenames 2>/dev/null
    case $1 in
        directory) COMPREPLY=($(compgen -d -- "$current")) ;;
        file) COMPREPLY=($(compgen -f -- "$current")) ;;
        *) COMPREPLY=($(compgen -f -X "!*$1" -- "$current") $(compgen -d -- "$current")) ;;
    esac
}}
"""


def bash_value(program, entry):
    kind = entry.kind()
    if kind == "choice":
        return f"COMPREPLY=($(compgen -W {shlex.quote(' '.join(entry.choices))} -- \"$current\"))"
    return f"{function_name(program)}_files {kind}" if kind else ":"


def bash(program):
    f = function_name(program)
    commands = " ".join(c.names[0] for c in program.commands)
    lines = [f"# bash completion for {program.name}, made from its help.", BASH_FILES.format(f=f),
             f"{f}() {{",
             "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}",
             "    local command= i",
             "    COMPREPLY=()"]
    if commands:
        lines += ["    for ((i = 1; i < COMP_CWORD; i++)); do",
                  "        case ${COMP_WORDS[i]} in",
                  f"            {commands.replace(' ', '|')}) command=${{COMP_WORDS[i]}} && break ;;",
                  "        esac", "    done"]
    lines.append("    case $command:$previous in")
    words_of = {}  # by what completes a value: the words that take one
    for command, options, _ in levels(program):
        for entry in options:
            if entry.value or entry.choices:
                words_of.setdefault(bash_value(program, entry), []).extend(
                    f"{command}:{name}" for name in entry.names)
    for action, words in words_of.items():
        patterns = " |\\\n            ".join(words)
        lines.append(f"        {patterns}) {action}; return ;;")
    lines += ["    esac", "    case $command:$current in"]
    for command, options, arguments in levels(program):
        names = " ".join(name for o in options for name in o.names if name.startswith("--"))
        lines.append(f"        {command}:-*) COMPREPLY=($(compgen -W '{names}' -- \"$current\")) ;;")
        if not command and commands:
            lines.append(f"        :*) COMPREPLY=($(compgen -W '{commands}' -- \"$current\")) ;;")
        elif argument_kind(arguments):
            lines.append(f"        {command}:*) {bash_value(program, arguments[0])} ;;")
    lines += ["    esac", "}", f"complete -F {f} {program.name}", ""]
    return "\n".join(lines)


# zsh

def zsh_text(text):
    return text.replace("\\", "").replace("[", "(").replace("]", ")").replace(":", "\\:")


def zsh_action(entry):
    kind = entry.kind()
    if kind == "choice":
        return f"({' '.join(entry.choices)})"
    if not kind:
        return " "
    return {"directory": "_files -/", "file": "_files"}.get(kind, f'_files -g "*{kind}"')


def zsh_specifications(options, arguments):
    for entry in options:
        value = f":{zsh_text(entry.value or 'value')}:{zsh_action(entry)}" \
            if entry.value or entry.choices else ""
        for name in entry.names:
            others = "(" + " ".join(entry.names) + ")" if len(entry.names) > 1 else ""
            yield shlex.quote(f"{others}{name}[{zsh_text(entry.text)}]{value}")
    for i, entry in enumerate(arguments, 1):
        yield shlex.quote(f"{i}:{zsh_text(entry.value or entry.names[0])}:{zsh_action(entry)}")


def zsh(program):
    f = function_name(program)
    lines = [f"#compdef {program.name}", f"# zsh completion for {program.name}, made from its help.",
             f"{f}() {{", "  local state line", "  typeset -A opt_args"]
    for command, options, arguments in levels(program):
        specifications = " \\\n      ".join(zsh_specifications(options, arguments))
        if not command:
            more = " \\\n      '1:command:->command' '*::argument:->argument'" if program.commands else ""
            lines.append(f"  _arguments -C \\\n      {specifications}{more}")
            if program.commands:
                told = " ".join(shlex.quote(f"{c.names[0]}:{c.text}") for c in program.commands)
                lines += ["  case $state in", "  command)", f"    local -a commands=({told})",
                          "    _describe command commands ;;", "  argument)",
                          "    case $words[1] in"]
        else:
            lines.append(f"    {command}) _arguments \\\n      {specifications} ;;")
    if program.commands:
        lines += ["    esac ;;", "  esac"]
    lines += ["}", f'{f} "$@"', ""]
    return "\n".join(lines)


# fish

def fish_text(text):
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def fish_value(entry):
    kind = entry.kind()
    if kind == "choice":
        return f"-xa {fish_text(' '.join(entry.choices))}"
    if kind == "directory":
        return "-xa '(__fish_complete_directories)'"
    if kind == "file":
        return "-rF"
    return f"-xa '(__fish_complete_suffix {kind})'" if kind else "-x"


def fish(program):
    base = f"complete -c {program.name}"
    lines = [f"# fish completion for {program.name}, made from its help.", f"{base} -f"]
    for command in program.commands:
        lines.append(f"{base} -n __fish_use_subcommand -a {command.names[0]} -d {fish_text(command.text)}")
    for command, options, arguments in levels(program):
        where = f" -n '__fish_seen_subcommand_from {command}'" if command else \
            " -n __fish_use_subcommand" if program.commands else ""
        for entry in options:
            names = " ".join(("-l " if name.startswith("--") else "-s ") + name.lstrip("-")
                             for name in entry.names)
            value = " " + fish_value(entry) if entry.value or entry.choices else ""
            lines.append(f"{base}{where} {names}{value} -d {fish_text(entry.text)}")
        if argument_kind(arguments):
            lines.append(f"{base}{where} {fish_value(arguments[0])}")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", nargs="+", type=pathlib.Path)
    parser.add_argument("-o", dest="folder", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    for path in arguments.programs:
        program = read_program(path, path.name)
        for place, text in ((f"bash/{path.name}", bash(program)), (f"zsh/_{path.name}", zsh(program)),
                            (f"fish/{path.name}.fish", fish(program))):
            file = arguments.folder / place
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)


if __name__ == "__main__":
    main()
