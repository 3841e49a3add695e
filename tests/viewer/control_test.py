#!/usr/bin/env python3
"""`undine run --control`: pausing, resuming and stopping change no bit of the results, and only the run's own page does it.

    control_test.py UNDINE RUNS

RUNS is the folder that runs.py made; runs are added to it.
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest

from serving import Server

UNDINE, RUNS = sys.argv[1:3] if len(sys.argv) > 2 else (None, None)
HERE = os.path.dirname(os.path.abspath(__file__))


def read_text(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def read_json(path):
    return json.loads(read_text(path))


class Live:
    """A run of the plane dam break, by default without an end."""

    CASE = os.path.join(HERE, "..", "..", "cases", "dam_break_2d.toml")

    def __init__(self, name, *words, end=1000):
        self.folder = os.path.join(RUNS, name)
        if "--resume" not in words:
            shutil.rmtree(self.folder, ignore_errors=True)
        self.process = subprocess.Popen([UNDINE, "run", self.CASE, "--out", self.folder, "--threads", "1", "--quiet", "--no-report", *words, "--set", f"time.end={end}",
                                         "--set", "spacing=0.05", "--set", "output.snapshots=0.05", "--set", "output.energies=0.01"])

    def progress(self):
        return read_json(os.path.join(self.folder, "progress.json"))

    def wait_until(self, holds, seconds=30):
        start = time.monotonic()
        while True:
            if os.path.exists(os.path.join(self.folder, "progress.json")) and holds(self.progress()):
                return
            if time.monotonic() - start > seconds or self.process.poll() is not None:
                raise AssertionError(f"the run did not come to it: {self.progress()}")
            time.sleep(0.05)

    def wish(self, word):
        """As anybody who may write to the folder."""
        place = os.path.join(self.folder, "control")
        with open(place + ".new", "w", encoding="ascii") as file:
            file.write(word)
        os.replace(place + ".new", place)

    def end(self, seconds=60):
        return self.process.wait(timeout=seconds)

    def result(self):
        """Hash of the last checkpoint, and the tables."""
        last = sorted(name for name in os.listdir(self.folder) if name.endswith(".checkpoint"))[-1]
        hashed = subprocess.run([UNDINE, "checksum", os.path.join(self.folder, last)], capture_output=True, text=True, check=True).stdout
        return hashed.split()[0], *(read_text(os.path.join(self.folder, name)) for name in ("energies.csv", "steps.csv"))


class Control(unittest.TestCase):
    def setUp(self):
        self.runs, self.servers = [], []

    def tearDown(self):
        for run in self.runs:
            if run.process.poll() is None:
                run.process.kill()
                run.process.wait()
        for server in self.servers:
            server.stop()

    def start(self, *words, **more):
        self.runs.append(Live(*words, **more))
        return self.runs[-1]

    def serve(self, folder, *words):
        self.servers.append(Server(UNDINE, folder, *words))
        return self.servers[-1]

    def ask(self, server, wish, method="POST", **headers):
        return server.get(f"{server.path}control?wish={wish}", method, {name.replace("_", "-"): value for name, value in headers.items()})[0]

    def test_paused_resumed_and_stopped_it_ends_in_the_same_bits(self):
        run = self.start("controlled", "--control")
        run.wait_until(lambda said: said["control"] and said["step"] > 20)
        server = self.serve(run.folder, "--follow")
        for _ in range(3):
            self.assertTrue(server.json("state.json")["control"])
            self.assertEqual(self.ask(server, "pause"), 200)
            run.wait_until(lambda said: said["paused"])
            used, step = self.seconds_used(run), run.progress()["step"]
            time.sleep(1)
            self.assertLess(self.seconds_used(run) - used, 0.3, "a paused run computes nothing")
            self.assertEqual((run.progress()["step"], server.json("state.json")["progress"]["paused"]), (step, True))
            self.assertEqual(self.ask(server, "run"), 200)
            run.wait_until(lambda said: not said["paused"] and said["step"] > step)
        self.assertEqual(self.ask(server, "stop"), 200)
        self.assertEqual(run.end(), 130)
        record = read_json(os.path.join(run.folder, "run.json"))
        self.assertEqual(record["status"], "interrupted")
        self.assertFalse(os.path.exists(os.path.join(run.folder, "control")), "nobody listens any more")
        self.assertEqual(self.ask(server, "run"), 409)
        self.assertFalse(server.json("state.json")["control"])
        end = record["time"] + 0.2
        self.assertEqual(self.start("controlled", "--resume", end=end).end(), 0)
        unbroken = self.start("uncontrolled", end=end)
        self.assertEqual(unbroken.end(), 0)
        self.assertEqual(run.result(), unbroken.result())

    @staticmethod
    def seconds_used(run):
        with open(f"/proc/{run.process.pid}/stat", encoding="ascii") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def test_pauses_are_no_wall_time_and_signals_end_them(self):
        run = self.start("paused", "--control")
        run.wait_until(lambda said: said["step"] > 20)
        run.wish("pause")
        run.wait_until(lambda said: said["paused"])
        run.wish("pau\0nonsense" * 1000)
        time.sleep(3)
        self.assertTrue(run.progress()["paused"], "words that are not known change nothing")
        run.wish("run\n")
        run.wait_until(lambda said: not said["paused"])
        run.wish("pause")
        run.wait_until(lambda said: said["paused"])
        began = time.monotonic()
        run.process.send_signal(signal.SIGINT)
        self.assertEqual(run.end(10), 130)
        self.assertLess(time.monotonic() - began, 5)
        used = read_json(os.path.join(run.folder, "run.json"))["seconds"]["total"]
        run_for = os.stat(os.path.join(run.folder, "run.json")).st_mtime - os.stat(os.path.join(run.folder, ".undine")).st_mtime
        self.assertLess(used, run_for - 2.5)

    def test_only_a_run_that_wants_it_is_controlled(self):
        run = self.start("deaf")
        run.wait_until(lambda said: said["step"] > 20)
        server = self.serve(run.folder)
        self.assertFalse(server.json("state.json")["control"])
        self.assertEqual(self.ask(server, "stop"), 409)
        self.assertFalse(os.path.exists(os.path.join(run.folder, "control")))
        run.wish("stop")  # by hand: nobody reads it
        time.sleep(0.5)
        self.assertIsNone(run.process.poll())
        finished = self.serve(os.path.join(RUNS, "flat"))
        self.assertEqual(self.ask(finished, "pause"), 409)
        self.assertFalse(os.path.exists(os.path.join(RUNS, "flat", "control")))

    def test_only_this_page_controls_it(self):
        run = self.start("guarded", "--control")
        run.wait_until(lambda said: said["step"] > 20)
        server = self.serve(run.folder)
        here = f"127.0.0.1:{server.port}"
        for method in ("GET", "HEAD", "PUT", "DELETE", "OPTIONS", "PATCH"):
            self.assertIn(self.ask(server, "stop", method), (400, 405), method)
        for headers in ({"Origin": "http://example.org"}, {"Origin": "null"}, {"Origin": f"https://{here}"}, {"Origin": f"http://localhost:{server.port}"},
                        {"Sec_Fetch_Site": "cross-site"}, {"Sec_Fetch_Site": "same-site"}, {"Sec_Fetch_Site": "none"}, {"Host": "example.org"},
                        {"Host": f"example.org:{server.port}", "Origin": f"http://example.org:{server.port}"}):
            self.assertEqual(self.ask(server, "stop", **headers), 403, headers)
        for wish in ("", "halt", "STOP", "stop%0a", "stop%20", "..%2frun"):
            self.assertEqual(self.ask(server, wish), 400, wish)
        self.assertEqual(server.get("/" + "0" * 32 + "/control?wish=stop", "POST")[0], 403)
        self.assertEqual(server.get("/control?wish=stop", "POST")[0], 403)
        others = self.serve(run.folder, "--host", "0.0.0.0")
        self.assertEqual(self.ask(others, "stop"), 403)
        self.assertFalse(others.json("state.json")["control"])
        step = run.progress()["step"]
        run.wait_until(lambda said: said["step"] > step)
        self.assertEqual(self.ask(server, "stop", Origin=f"http://{here}", Sec_Fetch_Site="same-origin"), 200)
        self.assertEqual(run.end(), 130)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
