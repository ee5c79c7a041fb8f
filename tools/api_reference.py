#!/usr/bin/env python3
"""The API reference, made from the sources: docstrings and type stubs of the Python package, comments
of the public headers.

Usage: api_reference.py python PACKAGE_FOLDER | cpp SOURCE_FOLDER. Prints Markdown.
"""
import ast
import inspect
import pathlib
import re
import sys

# Headers for programs that use the library; the headers behind these may change.
HEADERS = {
    "base": ["vec2", "heading", "grid", "frame", "error", "atomic_file", "random"],
    "vehicle": ["vehicle", "mission"],
    "map": ["region", "obstacle_map"],
    "field": ["field", "compute_field"],
    "plan": ["plan", "plan_record", "plan_of_field", "plan_file"],
    "simulate": ["flight", "exact_flight", "sampled_flight", "start_states", "flight_statistics",
                 "state_files"],
    "verify": ["verdict", "region_of_interest", "certify", "verdict_map", "sample_verdicts"],
    "certificate": ["certificate", "certificate_file"],
    "steer": ["dubins_words", "shortest_law", "clf_law", "steering_flight", "clear_approach"],
    "exchange": ["flight_files", "track", "qgc_mission"],
}


def main():
    kind, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    print("\n".join(python_reference(folder) if kind == "python" else cpp_reference(folder)))


# Python

def python_reference(folder):
    sys.path.insert(0, str(folder.parent))
    import fairway
    stubs = {node.name: node for node in ast.parse((folder / "__init__.pyi").read_text()).body
             if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    lines = ["# Python API", "",
             "Made from the package's docstrings and type stubs by `tools/api_reference.py`. "
             "[Python](../python.md) is the tutorial, with the general conventions. In signatures, "
             "`_Path` is a string or an `os.PathLike`, `_Pair` and `_Extent` are tuples of two and four numbers, `_Progress` a "
             "function of (stage, left_s), `_Law` a name or a function.", ""]
    functions = [n for n in fairway.__all__ if isinstance(stubs[n], ast.FunctionDef)]
    classes = [n for n in fairway.__all__ if isinstance(stubs[n], ast.ClassDef)]
    lines += ["## Functions", ""]
    for name in functions:
        lines += function_lines(f"### {name}", "fairway." + signature(stubs[name], getattr(fairway, name)),
                                getattr(fairway, name))
    lines += ["## Classes", ""]
    for name in classes:
        lines += class_lines(name, stubs[name], getattr(fairway, name))
    return lines[:-1]


def signature(stub, member=None):
    fill_defaults(stub.args, member)
    text = ast.unparse(stub).removesuffix(": ...").removesuffix("...").strip()
    text = text.split("def ", 1)[1].rstrip(":").rstrip()
    text = re.sub(r"(: [^,=()]*(?:\[[^=]*?\])?)=", r"\1 = ", text)
    return text.replace("(self, ", "(").replace("(self)", "()")


def fill_defaults(arguments, member):
    """Replaces the stub's `...` with the values in pybind11's own signature."""
    first = (getattr(member, "__doc__", None) or "").partition("\n")[0]
    named = [(a, arguments.defaults, i - len(arguments.args) + len(arguments.defaults))
             for i, a in enumerate(arguments.args)]
    named += [(a, arguments.kw_defaults, i) for i, a in enumerate(arguments.kwonlyargs)]
    for argument, values, i in named:
        if i < 0 or values[i] is None:
            continue
        found = re.search(rf"\b{argument.arg}: [^=]*? = ('[^']*'|\([^)]*\)|[^,)]+)", first)
        if found:
            values[i] = ast.parse(found[1], mode="eval").body


def docs(member):
    """The docstring without pybind11's signature."""
    text = inspect.cleandoc(member.__doc__ or "")
    first, _, rest = text.partition("\n")
    return rest.strip() if re.match(r"\w+\(.*\) -> ", first) else text


def prose(text):
    """Paragraphs; indented or aligned lines, such as arguments, in a block."""
    lines = []
    for paragraph in re.split(r"\n\s*\n", text):
        rows = paragraph.splitlines()
        table = any(re.match(r"\s|\S+(, \S+)*\s{2,}\S", row) for row in rows)
        lines += ["```text", *rows, "```", ""] if table else [" ".join(rows), ""]
    return lines


def function_lines(title, call, member):
    return [title, "", "```python", wrapped(call), "```", "", *prose(docs(member))]


def wrapped(call, width=100):
    if len(call) <= width:
        return call
    head, inside = call.split("(", 1)
    arguments, result = inside.rsplit(") ->", 1)
    depth, parts, part = 0, [], ""
    for c in arguments:
        depth += (c in "[(") - (c in ")]")
        if c == "," and depth == 0:
            parts.append(part.strip())
            part = ""
        else:
            part += c
    parts.append(part.strip())
    return head + "(\n" + "".join(f"    {p},\n" for p in parts) + ") ->" + result


def class_lines(name, stub, member):
    lines = [f"### {name}", ""]
    if issubclass(member, int):
        lines += prose(member.__doc__)
        return lines + ["| name | code |", "|---|---|",
                        *(f"| `{one.name}` | {one.value} |" for one in member), ""]
    lines += prose(docs(member))
    properties, methods = [], []
    for part in stub.body:
        if not isinstance(part, ast.FunctionDef) or part.name == "__len__":
            continue
        decorators = {d.id for d in part.decorator_list}
        value = vars(member)[part.name]
        if "property" in decorators:
            words = " ".join(docs(value.fget if value.fget else value).split()) or docs(value)
            words = " ".join((value.__doc__ or words).split())
            properties.append(f"| `{part.name}` | {words} |".replace("-> ", ""))
        else:
            call = signature(part, getattr(member, part.name)).replace("__init__", name)
            static = "staticmethod" in decorators
            methods += function_lines(f"#### {name if part.name == '__init__' else part.name}",
                                      (f"{name}." if static else "") + call,
                                      getattr(member, part.name))
    if properties:
        lines += ["| property | |", "|---|---|", *properties, ""]
    return lines + methods


# C++

def cpp_reference(folder):
    lines = ["# C++ API", "",
             "`find_package(fairway)` provides `fairway::fairway`; everything is in the namespace `fairway`, and headers are "
             "included as `<fairway/STAGE/NAME.hpp>`. Made from the headers' comments by `tools/api_reference.py`. "
             "Anything not listed here is internal and may change. The header for vehicles, `fairway/runtime.hpp`, uses neither "
             "heap nor exceptions, and has its own target, `fairway::runtime`, which needs no other package. "
             "`tests/consumer` has a complete program for each.", ""]
    for stage, names in HEADERS.items():
        lines += [f"## {stage}", ""]
        for name in names:
            lines += header_lines(folder, f"fairway/{stage}/{name}.hpp")
    lines += ["## On the vehicle", "", *header_lines(folder, "fairway/runtime.hpp")]
    return lines[:-1]


def header_lines(folder, path):
    rows = (folder / path).read_text().splitlines()
    head = []
    for row in rows:
        if not row.startswith("//"):
            break
        head.append(row[2:].removeprefix(" "))
    lines = [f"### `{path}`", "", *comment_prose("\n".join(head))]
    code = declarations(rows[len(head):])
    return lines + (["```cpp", *code, "```", ""] if code else [])


def comment_prose(text):
    """A header's comment: its sentences as paragraphs, its numbered or aligned lines as they are."""
    lines = []
    for paragraph in re.split(r"\n\s*\n", text):
        rows = paragraph.splitlines()
        plain = [row for row in rows if not row.startswith(" ")]
        if len(plain) == len(rows):
            lines += [" ".join(rows), ""]
        else:
            lines += ["```text", *rows, "```", ""]
    return lines


def declarations(rows):
    """The header's declarations with their comments, bodies of functions and private parts left out."""
    code, depth_skipped, private, in_detail = [], 0, False, False
    i = 0
    while i < len(rows):
        row = rows[i]
        i += 1
        if row.startswith("#") or "NOLINT" in row and row.lstrip().startswith("//"):
            continue
        if re.match(r"namespace \w+(::\w+)* \{|\}  // namespace", row) or row.startswith("using "):
            in_detail = row.startswith("namespace detail") or (in_detail and "// namespace" not in row)
            continue
        if in_detail:
            continue
        if re.match(r"\s*private:", row):
            private = True
            continue
        if row.startswith("};"):
            private = False
        if private:
            continue
        opens = row.count("{") - row.count("}")
        is_type = re.match(r"\s*(struct|class|enum|union|enum class|enum struct)\b", row)
        is_body = not is_type and ")" in row and row.rstrip().endswith("{")
        if row.lstrip().startswith(": ") and code:  # a constructor's initialisers
            code[-1] += ";"
            depth = opens
            while depth > 0 and i < len(rows):
                depth += rows[i].count("{") - rows[i].count("}")
                i += 1
            continue
        if is_body:
            signature_ = row.rstrip()[:-1].rstrip()
            depth = opens
            while depth > 0 and i < len(rows):
                depth += rows[i].count("{") - rows[i].count("}")
                i += 1
            code.append(without_initialisers(signature_) + ";")
            continue
        one_line = re.match(r"(\s*.*\)\s*(?:const)?\s*(?:noexcept)?)\s*(?::.*)?\{.*\}\s*$", row)
        if one_line and not is_type:
            code.append(one_line[1].rstrip() + ";")
            continue
        code.append(row)
    text = re.sub(r"\n{3,}", "\n\n", "\n".join(code)).strip()
    text = re.sub(r"\n\n\};", "\n};", text)
    return text.splitlines()


def without_initialisers(signature_):
    return re.sub(r"\)\s*:\s.*$", ")", signature_)


if __name__ == "__main__":
    main()
