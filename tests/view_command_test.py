#!/usr/bin/env python3
"""`fairway view` as a user sees it: it prints its address, ends with Ctrl-C, and rejects bad folders.

Usage: view_command_test.py FAIRWAY [unittest arguments]
"""
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

FAIRWAY = None

SCENARIO = """[map]
file = "map.pgm"
resolution_m = 1.0
cell_m = 2.0
[vehicle]
speed_mps = 10.0
turn_radius_m = 4.0
[mission]
kind = "goal"
goal_m = [45.0, 30.0]
[verify]
undecided_max = 0.5
[simulate]
random = 5
sample = 10
"""


class View(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="fairway-view-"))
        (cls.folder / "map.pgm").write_bytes(b"P5\n70 60\n255\n" + b"\xff" * 4200)
        (cls.folder / "s.toml").write_text(SCENARIO)
        subprocess.run([FAIRWAY, "run", "s.toml", "-o", "run"], cwd=cls.folder, check=True, capture_output=True)
        page = cls.folder / "run/report.html"  # any page will do where the build has none
        if not page.exists():
            page.write_text("<!doctype html>")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def start(self, *arguments, environment=None):
        server = subprocess.Popen([FAIRWAY, "--json", "view", *map(str, arguments)], cwd=self.folder, text=True,
                                  env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.stderr.close)
        self.addCleanup(server.wait)
        self.addCleanup(server.kill)
        lines = []
        for line in server.stdout:
            lines.append(line)
            if line.rstrip() == "}":
                break
        return server, json.loads("".join(lines))

    def refused(self, code, *arguments):
        done = subprocess.run([FAIRWAY, "view", *map(str, arguments)], cwd=self.folder, text=True, capture_output=True,
                              timeout=60)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stderr

    def test_says_where_it_is_answers_there_and_ends_with_a_signal(self):
        for ending in (signal.SIGINT, signal.SIGTERM):
            server, said = self.start("run")
            self.assertEqual(said["address"], f"http://127.0.0.1:{said['port']}/")
            with urllib.request.urlopen(said["address"] + "api/state?x=20&y=20&h=0.5", timeout=10) as answer:
                found = json.load(answer)
            self.assertEqual(found["flight"]["outcome"], "reach")
            self.assertEqual(found["verdict"], "reach")
            server.send_signal(ending)
            self.assertEqual(server.wait(10), 0)

    def test_a_port_of_ones_own_choice_and_one_that_is_taken(self):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        _, said = self.start("run", "--port", port)
        self.assertEqual(said["port"], port)
        self.assertIn(f"--port: {port} is in use", self.refused(65, "run", "--port", port))

    def test_the_usual_port_unless_it_is_taken(self):
        ports = [self.start("run")[1]["port"] for _ in range(2)]
        self.assertNotEqual(ports[0], ports[1])
        self.assertIn("(default: 8642,", subprocess.run([FAIRWAY, "view", "--help"], capture_output=True,
                                                        text=True).stdout.replace("\n" + " " * 30, " "))

    def test_open_hands_the_address_to_the_desktop(self):
        tools = self.folder / "tools"
        tools.mkdir()
        (tools / "xdg-open").write_text('#!/bin/sh\necho "$@" > opened.part; mv opened.part opened\n')
        (tools / "xdg-open").chmod(0o755)
        environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}
        server, said = self.start("run", "--open", "--port", "0", environment=environment)
        opened = self.folder / "opened"
        deadline = time.monotonic() + 30
        while not opened.exists():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        self.assertEqual(opened.read_text(), said["address"] + "\n")
        server.send_signal(signal.SIGINT)
        self.assertEqual(server.wait(10), 0)

    def test_open_without_a_desktop_is_a_warning(self):
        server, _ = self.start("run", "--open", "--port", "0", environment={"PATH": str(self.folder / "nothing")})
        server.send_signal(signal.SIGINT)
        self.assertEqual(server.wait(10), 0)
        self.assertIn("xdg-open could not be run", server.stderr.read())

    def test_a_contract_certificate_is_found_or_given_and_must_be_of_this_plan(self):
        kept = self.folder / "kept"
        shutil.copytree(self.folder / "run", kept)
        (self.folder / "c.toml").write_text("[vehicle.contract]\ncommand_error_m = 0.5\n")
        own = kept / "contract.certificate.safetensors"
        subprocess.run([FAIRWAY, "verify", kept / "plan.safetensors", "--contract", "c.toml", "-o", own],
                       cwd=self.folder, check=True, capture_output=True)
        given = self.folder / "given.safetensors"
        shutil.copy(own, given)
        for arguments in (("kept",), ("run", "--contract-certificate", given)):
            server, said = self.start(*arguments, "--port", "0")
            with urllib.request.urlopen(said["address"] + "api/state?x=20&y=20&h=0.5", timeout=30) as answer:
                found = json.load(answer)
            self.assertEqual((found["verdict"], found["contract"]["verdict"]), ("reach", "reach"))
            self.assertGreater(found["contract"]["time_bound_s"], 0)
            server.send_signal(signal.SIGINT)
            self.assertEqual(server.wait(10), 0)
        (self.folder / "other.toml").write_text(SCENARIO.replace("45.0, 30.0", "30.0, 45.0"))
        subprocess.run([FAIRWAY, "run", "other.toml", "-o", "other"], cwd=self.folder, check=True, capture_output=True)
        (self.folder / "other/report.html").touch()
        self.assertIn("given.safetensors: belongs to a different plan or vehicle than plan.safetensors",
                      self.refused(65, "other", "--contract-certificate", given))
        self.assertIn("is a certificate", self.refused(65, "kept", "--contract-certificate",
                                                       kept / "certificate.safetensors"))
        own.write_bytes(own.read_bytes()[:-1])
        self.assertIn("contract.certificate.safetensors", self.refused(65, "kept"))

    def test_what_is_not_the_folder_of_a_run_is_refused(self):
        self.assertIn("is not a folder", self.refused(65, "nowhere"))
        self.assertIn("is not a folder", self.refused(65, "s.toml"))
        self.assertIn("report.html", self.refused(65, "."))
        broken = self.folder / "broken"
        shutil.copytree(self.folder / "run", broken)
        plan = broken / "plan.safetensors"
        plan.write_bytes(plan.read_bytes()[:-1])
        self.assertIn("plan.safetensors", self.refused(65, "broken"))
        plan.unlink()
        self.assertIn("plan.safetensors", self.refused(65, "broken"))
        self.refused(64, "run", "--port", "70000")
        self.refused(64)


if __name__ == "__main__":
    FAIRWAY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
