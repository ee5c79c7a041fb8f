"""Verdicts and certificates."""
import csv
import io
import math
import pathlib
import shutil
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

import fairway


def test_verdicts_are_true_of_flights(small_plan, certificate):
    starts = small_plan.random_starts(3000, seed=11, where="not_obstacle")
    verdict, bound_s = certificate.query(starts)
    flights = small_plan.fly(starts)
    assert (verdict.dtype, bound_s.dtype) == (np.int8, np.float64)
    proved = verdict != fairway.Verdict.UNDECIDED
    assert np.array_equal(flights.outcome[proved], verdict[proved])
    reach = verdict == fairway.Verdict.REACH
    assert reach.mean() > 0.5
    assert np.all(flights.time_s[reach] <= bound_s[reach])
    assert np.all(np.isinf(bound_s[~reach]))
    assert np.mean(verdict == fairway.Verdict.UNDECIDED) < 0.08


def test_queries_are_those_of_the_command(small_plan, certificate, command, tmp_path):
    certificate.save(tmp_path / "c.safetensors")
    starts = small_plan.random_starts(200, seed=12, where="not_obstacle")
    np.savetxt(tmp_path / "s.csv", starts, delimiter=",", fmt="%.17g")
    text = command("query", tmp_path / "c.safetensors", "--states", tmp_path / "s.csv")
    rows = list(csv.DictReader(io.StringIO(text)))
    verdict, bound_s = certificate.query(starts)
    assert [fairway.Verdict(v).name.lower() for v in verdict] == [row["verdict"] for row in rows]
    assert np.array_equal(bound_s, [float(row["time_bound_s"] or "inf") for row in rows])


def test_a_map_of_verdicts_is_a_query_of_every_cell(small_plan, certificate):
    for heading_rad in (0.0, 2.0, -math.pi):
        verdicts = certificate.verdict_map(heading_rad)
        assert verdicts.shape == small_plan.shape and verdicts.dtype == np.int8
        iy, ix = np.indices(small_plan.shape)
        x = small_plan.origin_m[0] + ix + 0.5 + 1 / 37
        y = small_plan.origin_m[1] + iy + 0.5 - 1 / 53
        states = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, heading_rad + 0.0005)])
        asked, _ = certificate.query(states)
        assert np.mean(asked == verdicts.ravel()) > 0.999  # but for rounding of the places
    assert np.all(verdicts[small_plan.region == fairway.Region.GOAL] == fairway.Verdict.REACH)
    with pytest.raises(ValueError, match="finite"):
        certificate.verdict_map(math.nan)


def test_failing_states_fly_as_their_verdicts_say(plan):
    certificate = fairway.verify(plan, undecided_max=0.2, samples=2000)
    states, verdict = certificate.failing_states(40, seed=3)
    assert states.shape == (len(verdict), 3) and verdict.dtype == np.int8
    assert np.array_equal(certificate.query(states)[0], verdict)
    collide = verdict == fairway.Verdict.COLLIDE
    assert 40 <= collide.sum() <= 3 * 40  # up to 40 from safe starts, the buffer, cut-off cells
    assert np.all(plan.fly(states[collide]).outcome == fairway.Outcome.COLLIDE)


def test_shares_sum_to_one_and_are_recorded(small_plan, certificate):
    assert sum(certificate.volume_fraction.values()) == pytest.approx(1.0)
    assert certificate.volume_fraction["undecided"] <= 0.05
    assert certificate.summary["options"]["undecided_max"] == 0.05
    assert certificate.summary["stopped_by"] == "undecided_max"
    assert certificate.volume_fraction == certificate.summary["volume_fraction"]
    assert (certificate.shape, certificate.extent_m) == (small_plan.shape, small_plan.extent_m)


def test_a_certificate_file_reads_back_and_is_accepted(small_plan, certificate, tmp_path):
    certificate.save(tmp_path / "c.safetensors")
    small_plan.save(tmp_path / "p.safetensors")
    back = fairway.load_certificate(tmp_path / "c.safetensors")
    starts = small_plan.random_starts(100)
    for one, other in zip(back.query(starts), certificate.query(starts)):
        assert np.array_equal(one, other)
    assert back.summary == certificate.summary and back.leaves == certificate.leaves
    report = fairway.check(tmp_path / "c.safetensors", plan=tmp_path / "p.safetensors")
    assert report["accepted"] is True


def test_a_certificate_of_another_plan_is_refused(plan, certificate, tmp_path):
    certificate.save(tmp_path / "c.safetensors")
    plan.save(tmp_path / "p.safetensors")
    report = fairway.check(tmp_path / "c.safetensors", plan=tmp_path / "p.safetensors")
    assert report["accepted"] is False and "plan" in report["reason"]
    (tmp_path / "text").write_text("no certificate")
    with pytest.raises(ValueError, match="text"):
        fairway.check(tmp_path / "text")
    with pytest.raises(ValueError, match="text"):
        fairway.load_certificate(tmp_path / "text")
    with pytest.raises(ValueError, match="cannot resume from it"):
        fairway.verify(plan, resume=certificate)


def test_the_checker_is_found_where_the_package_is_installed_else_on_the_path(
        certificate, tmp_path, monkeypatch):
    file = tmp_path / "c.safetensors"
    certificate.save(file)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert fairway.check(file)["accepted"] is True
    # The package by itself, elsewhere.
    package = pathlib.Path(fairway.__file__).parent
    program = next(up / "bin/fairway-check" for up in package.parents
                   if (up / "bin/fairway-check").exists())
    shutil.copytree(package, tmp_path / "alone/fairway")
    ask = [sys.executable, "-c", f"import fairway; print(fairway.check({str(file)!r})['accepted'])"]

    def asked(path):
        return subprocess.run(ask, capture_output=True, text=True, cwd=tmp_path, env={
            "PYTHONPATH": str(tmp_path / "alone"), "PATH": path})
    assert "RuntimeError: cannot run fairway-check: expected in" in asked(str(tmp_path)).stderr
    assert asked(str(program.parent)).stdout == "True\n"


def test_more_work_goes_on_from_an_earlier_certificate(small_plan, certificate):
    finer = fairway.verify(small_plan, undecided_max=0.02, resume=certificate)
    assert finer.volume_fraction["undecided"] <= 0.02
    starts = small_plan.random_starts(500, seed=3, where="flyable")
    before, after = certificate.query(starts)[0], finer.query(starts)[0]
    decided = before != fairway.Verdict.UNDECIDED
    assert np.array_equal(after[decided], before[decided])


def test_another_region_takes_the_place_of_the_goal(small_plan):
    certificate = fairway.verify(small_plan, region=(0.0, 10.0, 20.0, 40.0), undecided_max=0.3)
    assert certificate.query([[10.0, 20.0, 1.0]])[0][0] == fairway.Verdict.REACH
    for wrong, error in (("west", ValueError), ((3, 0, 1, 1), ValueError), (7, TypeError)):
        with pytest.raises(error, match="region"):
            fairway.verify(small_plan, region=wrong)


@pytest.mark.parametrize("keywords", [{"undecided_max": 1.5}, {"undecided_max": math.nan},
                                      {"time_limit_s": -1.0}, {"memory_limit_mb": 0.0}])
def test_options_out_of_range_are_refused(small_plan, keywords):
    with pytest.raises(ValueError, match=next(iter(keywords))):
        fairway.verify(small_plan, **keywords)


def test_progress_comes_in_the_calling_thread_and_may_end_the_work(small_plan):
    told = []
    fairway.verify(small_plan, undecided_max=0.06, samples=2000,
                   progress=lambda stage, left_s: told.append((stage, threading.get_ident())))
    assert told[0][0] == "verifying" and len(told) > 2
    assert {thread for _, thread in told} == {threading.get_ident()}

    class Enough(Exception):
        pass

    calls = []

    def stop(stage, left_s):
        calls.append(stage)
        if len(calls) == 2:
            raise Enough
    with pytest.raises(Enough):
        fairway.verify(small_plan, undecided_max=0.0, progress=stop)
    assert len(calls) == 2


def test_other_threads_run_meanwhile(small_plan):
    """One thread verifies; this one lives on, and sees it end."""
    began, ended = threading.Event(), threading.Event()

    def work():
        fairway.verify(small_plan, undecided_max=0.05, samples=2000,
                       progress=lambda *told: began.set())
        ended.set()
    worker = threading.Thread(target=work)
    worker.start()
    assert began.wait(60)
    turns_while_it_works = 0
    while not ended.is_set():
        turns_while_it_works += 1
    worker.join()
    assert turns_while_it_works > 1000


LONG_WORK = """
import numpy as np, fairway, sys
plan = fairway.plan_arrays(np.zeros((60, 60), bool), 1.0, speed_mps=2.0, turn_radius_m=2.5,
                           goal_m=(30.0, 30.0))
try:
    fairway.verify(plan, undecided_max=0.0, progress=lambda *told: print("at work", flush=True))
except KeyboardInterrupt:
    print("interrupted")
    sys.exit(7)
"""


def test_ctrl_c_ends_the_work():
    process = subprocess.Popen([sys.executable, "-c", LONG_WORK], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "at work\n"
    process.send_signal(signal.SIGINT)
    rest, _ = process.communicate(timeout=120)
    assert process.returncode == 7 and rest.endswith("interrupted\n")


def test_the_answer_does_not_depend_on_threads(small_plan, certificate, tmp_path):
    certificate.save(tmp_path / "all.safetensors")
    try:
        fairway.limit_threads(1)
        fairway.verify(small_plan, undecided_max=0.05).save(tmp_path / "one.safetensors")
    finally:
        fairway.limit_threads(None)
    assert (tmp_path / "one.safetensors").read_bytes() == (
        tmp_path / "all.safetensors").read_bytes()
    with pytest.raises(ValueError, match="1 to 4096"):
        fairway.limit_threads(0)
