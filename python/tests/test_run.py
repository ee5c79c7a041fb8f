"""The whole job, pictures, and the package itself."""
import ast
import inspect
import json
import pathlib

import numpy as np
import pytest

import fairway


@pytest.fixture
def scenario(tmp_path):
    image = np.full((90, 120), 255, np.uint8)
    (tmp_path / "map.pgm").write_bytes(b"P5\n120 90\n255\n" + image.tobytes())
    (tmp_path / "s.toml").write_text(
        "[map]\nfile = 'map.pgm'\nresolution_m = 1.0\ncell_m = 2.0\n"
        "[vehicle]\nspeed_mps = 10.0\nturn_radius_m = 4.0\n"
        "[mission]\nkind = 'goal'\ngoal_m = [90.0, 45.0]\n"
        "[verify]\nundecided_max = 0.1\n[simulate]\nrandom = 20\nsample = 100\n")
    return fairway.Scenario(tmp_path / "s.toml")


def test_run_leaves_every_product(scenario, tmp_path):
    stages = []
    result = fairway.run(scenario, tmp_path / "out",
                         progress=lambda stage, left_s: stages.append(stage))
    on_disk = json.loads((tmp_path / "out/summary.json").read_text())
    assert on_disk["cells"] == result.summary["cells"] == [62, 47]
    assert "reach" in result.paragraph and result.warnings == []
    assert result.summary["verify"]["checked"] is True
    assert {"reading the map", "computing the field", "flying", "drawing"} <= set(stages)
    plan = fairway.load_plan(tmp_path / "out/plan.safetensors")
    assert np.array_equal(plan.heading_rad, fairway.plan(scenario).heading_rad, equal_nan=True)
    with pytest.raises(fairway.InputError):
        fairway.run(scenario, tmp_path / "out", force=False)
    (tmp_path / "out/notes.txt").write_text("mine")
    fairway.run(scenario, tmp_path / "out")
    assert (tmp_path / "out/notes.txt").read_text() == "mine"


def test_a_run_that_is_stopped_leaves_nothing(scenario, tmp_path):
    def stop(stage, left_s):
        if stage == "flying":
            raise RuntimeError("enough")
    with pytest.raises(RuntimeError, match="enough"):
        fairway.run(scenario, tmp_path / "out", progress=stop)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["map.pgm", "s.toml"]


def test_an_unreachable_goal_is_refused_with_its_line(tmp_path, scenario):
    image = np.full((90, 120), 255, np.uint8)
    image[38:50, 54:66] = 0
    image[40:48, 56:64] = 255  # the goal fills the room
    (tmp_path / "map.pgm").write_bytes(b"P5\n120 90\n255\n" + image.tobytes())
    text = (tmp_path / "s.toml").read_text().replace("[90.0, 45.0]", "[60.0, 46.0]")
    (tmp_path / "s.toml").write_text(text + "[plan]\nalpha = 0.5\nbeta = 0.8\n")
    walled = fairway.Scenario(tmp_path / "s.toml")
    for ask in (lambda: fairway.plan(walled), lambda: fairway.run(walled, tmp_path / "out")):
        with pytest.raises(fairway.MissionRefused, match=r"s\.toml:10: mission\.goal_m") as error:
            ask()
        assert error.value.reason == "unreachable"
    assert not (tmp_path / "out").exists()


def test_pictures_for_notebooks_and_files(plan, certificate, tmp_path):
    flights = plan.fly(plan.random_starts(5))
    for thing in (plan, flights, certificate, plan.picture(title="A plan"), flights.picture(),
                  certificate.picture(headings=2), certificate.shares_picture()):
        png = thing._repr_png_()
        assert png.startswith(b"\x89PNG") and len(png) > 2000
    drawn = plan.picture(title="A plan", arrows=True, streamlines=False)
    drawn.save(tmp_path / "plan.svg")
    assert (tmp_path / "plan.svg").read_text() == drawn.svg and "A plan" in drawn.svg
    drawn.save(tmp_path / "plan.png")
    assert (tmp_path / "plan.png").read_bytes() == drawn.png
    with pytest.raises(ValueError, match=".svg or .png"):
        drawn.save(tmp_path / "plan.jpg")
    with pytest.raises(ValueError, match="exists"):
        drawn.save(tmp_path / "plan.svg", force=False)


def test_everything_says_what_it_is(plan, certificate):
    flights = plan.fly(plan.random_starts(5))
    for thing in (plan, flights, flights.trajectory(0), certificate,
                  fairway.shortest_path([0, 0, 0], [9, 9, 0], 1.0)):
        assert repr(thing).startswith("<fairway.") and "0x" not in repr(thing)
    for name in fairway.__all__:
        member = getattr(fairway, name)
        assert member.__doc__, name
        if not inspect.isclass(member) or issubclass(member, (Exception, int)):
            continue
        for part, value in vars(member).items():
            if not part.startswith("_"):
                documented = value.fget if isinstance(value, property) else value
                assert documented.__doc__ or part in ("path",), f"{name}.{part}"


def test_the_stubs_name_what_is_there_and_nothing_else():
    tree = ast.parse(pathlib.Path(fairway.__file__).with_name("__init__.pyi").read_text())
    stubs = {node.name: node for node in tree.body
             if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert set(stubs) == set(fairway.__all__)
    for name, node in stubs.items():
        member = getattr(fairway, name)
        if isinstance(node, ast.FunctionDef):
            check_keywords(name, node, member)
            continue
        if issubclass(member, int):
            stub = {part.targets[0].id: ast.literal_eval(part.value) for part in node.body}
            assert stub == {one.name: one.value for one in member}
            continue
        if issubclass(member, Exception):
            continue
        parts = {part.name: part for part in node.body}
        public = {part for part in vars(member) if not part.startswith("_")}
        assert public == {part for part in parts if not part.startswith("_")}, name
        for part, stub in parts.items():
            decorators = {d.id for d in stub.decorator_list}
            if "property" in decorators:
                assert isinstance(vars(member)[part], property), f"{name}.{part}"
            else:
                check_keywords(f"{name}.{part}", stub, getattr(member, part))


def check_keywords(name, stub, function):
    """The stub's parameters are those in the signature that heads the docstring."""
    text = function.__doc__
    if "Overloaded" in text or "(" not in text.splitlines()[0]:
        return
    signature = text.splitlines()[0]
    for argument in stub.args.args + stub.args.kwonlyargs:
        assert f"{argument.arg}: " in signature, f"{name}: {argument.arg}"
    count = len(stub.args.args) + len(stub.args.kwonlyargs)
    parsed = ast.parse("def " + "".join(
        c if ord(c) < 128 else "?" for c in simplified(signature)) + ": ...").body[0].args
    assert len(parsed.args) + len(parsed.kwonlyargs) == count, f"{name}: {signature}"


def simplified(signature):
    """`f(a: type = <default>, ...) -> type` as `f(a, ...)`: types and defaults dropped."""
    head, inside = signature.split("(", 1)
    depth, words, word, kept = 0, [], "", True
    for c in inside:
        if depth == 0 and c in ",)":
            words.append(word.strip())
            word, kept = "", True
            if c == ")":
                break
            continue
        depth += (c in "([{<") - (c in ")]}>")
        if depth == 0 and c in ":=":
            kept = False
        if kept:
            word += c
    return f"{head}({', '.join(w for w in words if w)})"


def test_the_version_is_that_of_the_command(command):
    assert command("--version").strip() == fairway.__version__
