"""The tutorial does what it says: its blocks run in order, and print what stands below them."""
import contextlib
import io
import re

import pytest

BLOCK = re.compile(r'^```(python|text)( title="Not run by the tests: [^"]*")?\n(.*?)^```$', re.MULTILINE | re.DOTALL)


def printed_by(code, names):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(code, names)
    return out.getvalue()


def test_the_tutorial_prints_what_it_shows(source, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = (source / "docs/python.md").read_text()
    blocks = [match.groups() for match in BLOCK.finditer(text)]
    names, printed, compared = {}, None, 0
    for number, (kind, no_run, body) in enumerate(blocks):
        if kind == "text":
            assert printed == body, f"after block {number}"
            printed, compared = None, compared + 1
        elif not no_run:
            assert not printed, f"block {number - 1} prints {printed!r}, and nothing shows it"
            code = compile(body, f"docs/python.md, block {number}", "exec")
            printed = printed_by(code, names)
            assert printed_by(code, names) == printed, "a cell of a notebook is run again"
    assert compared >= 8
    assert {path.name for path in tmp_path.iterdir()} == {
        "plan.svg", "lost.png", "lake.safetensors", "lake.cert.safetensors"}


@pytest.mark.parametrize("page", ["python.md", "exchange.md"])
def test_every_block_of_a_page_is_python_that_parses(source, page):
    for kind, _, body in BLOCK.findall((source / "docs" / page).read_text()):
        if kind == "python":
            compile(body, page, "exec")
