"""The reference pages are made from what is there, and leave nothing of it out."""
import ast
import pathlib
import re
import subprocess
import sys

import pytest

import fairway


@pytest.fixture(scope="module")
def page(source):
    def made(kind, folder):
        return subprocess.run([sys.executable, "-B", source / "tools/api_reference.py", kind, folder],
                              check=True, capture_output=True, text=True).stdout
    return made


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def test_the_python_page_has_every_name_and_every_default(page):
    text = page("python", pathlib.Path(fairway.__file__).parent)
    headings = re.findall(r"^### (\w+)$", text, re.MULTILINE)
    assert sorted(headings) == sorted(fairway.__all__)
    calls = blocks(text, "python")
    assert len(calls) > 40
    for call in calls:
        assert "..." not in call
        ast.parse("def " + call.replace("fairway.", "").replace("Scenario.", "").strip() + ": ...")
    for name, member in vars(fairway.Plan).items():
        if not name.startswith("_"):
            assert f"`{name}`" in text or f"#### {name}\n" in text


def test_the_cpp_page_has_declarations_and_no_bodies(page, source):
    text = page("cpp", source)
    for word in ("FieldOrRefusal compute_field(", "Plan read_plan(", "class ExactFlights {",
                 "Certified certify(", "DubinsPath shortest_path(", "Answer query("):
        assert word in text
    code = blocks(text, "cpp")
    assert len(code) >= 34
    for block in code:
        bare = re.sub(r"//.*", "", block)
        assert bare.count("{") == bare.count("}") and bare.count("(") == bare.count(")"), block
        assert "private:" not in bare and "return " not in bare, block
