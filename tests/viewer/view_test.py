#!/usr/bin/env python3
"""`undine view`: what it sends is what is stored, and nobody without the token gets anything, whatever they send.

    view_test.py UNDINE RUNS           talks to the server
    view_test.py UNDINE RUNS CHROMIUM  opens its page in a browser (view_test.mjs), of a run that ended and of one that goes on

RUNS is the folder that runs.py made.
"""

import http.client
import json
import os
import random
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest
from urllib.parse import urlsplit

import numpy

from page_data import Blocks
from report_test import snapshots, stored

UNDINE, RUNS, CHROMIUM = (sys.argv + [None])[1:4] if len(sys.argv) > 2 else (None, None, None)
HERE = os.path.dirname(os.path.abspath(__file__))


class Server:
    """`undine view` on a folder, until stop()."""

    def __init__(self, folder, *words):
        self.process = subprocess.Popen([UNDINE, "view", folder, *words], stdout=subprocess.PIPE, text=True)
        said = self.process.stdout.readline()
        self.url = re.search(r"http://\S+/", said).group()
        place = urlsplit(self.url)
        self.port, self.path = place.port, place.path

    def stop(self):
        self.process.send_signal(signal.SIGINT)
        self.process.wait(timeout=20)
        self.process.stdout.close()

    def get(self, path, method="GET", headers=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        try:
            connection.putrequest(method, path, skip_host=bool(headers and "Host" in headers))
            for name, value in (headers or {}).items():
                connection.putheader(name, value)
            connection.endheaders()
            response = connection.getresponse()
            return response.status, response.read(), response
        finally:
            connection.close()

    def json(self, name):
        status, body, _ = self.get(self.path + name)
        assert status == 200, (name, status, body[:200])
        return json.loads(body)

    def raw(self, data, wait=3):
        """Sends bytes and returns what comes back, if anything does."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=wait) as link:
            try:
                link.sendall(data)
                return link.recv(65536)
            except OSError:
                return b""


class Serving(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = os.path.join(RUNS, "spatial")
        cls.before = cls.listing()
        cls.server = Server(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.server.stop()
        assert cls.listing() == cls.before, "viewing must leave a run's files alone"

    @classmethod
    def listing(cls):
        return {(entry.name, entry.stat().st_mtime_ns, entry.stat().st_size) for entry in os.scandir(cls.folder)}

    def alive(self):
        self.assertEqual(self.server.get(self.server.path)[0], 200)
        self.assertIsNone(self.server.process.poll())

    def test_frames_are_the_snapshots(self):
        for k, (path, at) in enumerate(snapshots(self.folder)):
            answer = self.server.json(f"frame.json?number={k}&most=1000000")
            self.assertEqual(answer["frame"]["time"], at)
            ids, fields = Blocks(answer, answer["texts"]).particles(answer["frame"])
            want, order = stored(path), numpy.argsort(ids)
            numpy.testing.assert_array_equal(ids[order], want["id"])
            numpy.testing.assert_array_equal(fields["p"][order][:, 0], want["p"])
            numpy.testing.assert_array_equal(fields["x"][order], want["x"].astype("f4"))

    def test_thinned_frames_are_parts_of_them(self):
        path, _ = snapshots(self.folder)[1]
        want = stored(path)
        answer = self.server.json("frame.json?number=1&most=500")
        ids, fields = Blocks(answer, answer["texts"]).particles(answer["frame"])
        self.assertTrue(400 < len(ids) < 600, len(ids))
        numpy.testing.assert_array_equal(fields["p"][:, 0], want["p"][numpy.searchsorted(want["id"], ids)])

    def test_data_and_state(self):
        data, state = self.server.json("data.json"), self.server.json("state.json")
        self.assertEqual(state["status"], "finished")
        self.assertEqual(state["times"], [at for _, at in snapshots(self.folder)])
        self.assertAlmostEqual(state["progress"]["time"], data["run"]["time"], 12)
        self.assertEqual(len(data["particles"]["frames"]), len(state["times"]))

    def test_nothing_without_the_token(self):
        token = self.server.path.strip("/")
        self.assertRegex(token, r"^[0-9a-f]{32}$")
        other = token[:-1] + ("0" if token[-1] != "0" else "1")
        for path in ("/", "/data.json", "//", f"/{other}/", f"/{other}/data.json", f"/{token[:-1]}/", f"/{token}", f"/{token}0/", "/favicon.ico", "/%00/", "/*"):
            status, body, _ = self.server.get(path)
            self.assertEqual(status, 403, path)
            self.assertNotIn(token.encode(), body)

    def test_names_of_other_machines_are_refused(self):
        for host in ("example.org", f"example.org:{self.server.port}", "127.0.0.1", ""):
            self.assertEqual(self.server.get(self.server.path, headers={"Host": host})[0], 403, host)
        self.assertEqual(self.server.get(self.server.path, headers={"Host": f"localhost:{self.server.port}"})[0], 200)

    def test_no_path_becomes_a_file(self):
        for path in ("run.json", "../run.json", "..%2frun.json", "%2e%2e/%2e%2e/etc/passwd", "....//run.json", "/etc/passwd", "..\\run.json", "%00", "data.json/..", "frame.json/x"):
            status, body, _ = self.server.get(self.server.path + path)
            self.assertIn(status, (400, 403, 404), path)
            self.assertNotIn(b"root:", body)
            self.assertNotIn(b"case_hash", body)

    def test_odd_questions_get_short_answers(self):
        for query in ("number=-1", "number=99999999999999999999999", "number=x", "number=", "number=1e3", "number=7777", "most=-1", "most=x"):
            status, body, _ = self.server.get(f"{self.server.path}frame.json?{query}")
            self.assertEqual(status, 400, query)
            self.assertLess(len(body), 300)
        for method in ("POST", "PUT", "DELETE", "OPTIONS", "PATCH"):
            self.assertIn(self.server.get(self.server.path, method)[0], (400, 405), method)
        self.alive()

    def test_answers_say_that_they_are_private(self):
        _, _, response = self.server.get(self.server.path)
        self.assertEqual(response.headers["Cache-Control"], "no-store")
        self.assertEqual(response.headers["X-Frame-Options"], "DENY")
        self.assertIsNone(response.headers["Access-Control-Allow-Origin"])

    def test_it_listens_on_this_machine_only(self):
        port = f"{self.server.port:04X}"
        with open("/proc/net/tcp", encoding="ascii") as file:
            places = [line.split()[1] for line in file.readlines()[1:]]
        self.assertEqual([place for place in places if place.endswith(":" + port) and not place.startswith("0100007F")], [])
        if os.path.exists("/proc/net/tcp6"):
            with open("/proc/net/tcp6", encoding="ascii") as file:
                self.assertEqual([line for line in file.readlines()[1:] if line.split()[1].endswith(":" + port)], [])

    def test_huge_requests_do_no_harm(self):
        for data in (b"GET / HTTP/1.1\r\nHost: x\r\nX: " + b"a" * 10_000_000 + b"\r\n\r\n", b"GET /" + b"a" * 1_000_000 + b" HTTP/1.1\r\n\r\n",
                     b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 200_000 + b"\r\n", b"POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n" + b"z" * 100_000):
            self.server.raw(data)
        self.alive()

    def test_random_bytes_do_no_harm(self):
        chance = random.Random(5)
        start = f"GET {self.server.path}frame.json?number=0&most=50 HTTP/1.1\r\nHost: 127.0.0.1:{self.server.port}\r\nConnection: close\r\n\r\n".encode()
        for k in range(150):
            data = bytearray(start if k % 2 else chance.randbytes(chance.randrange(1, 3000)))
            for _ in range(chance.randrange(1, 12)):
                data[chance.randrange(len(data))] = chance.randrange(256)
            self.server.raw(bytes(data) + b"\r\n\r\n", wait=0.3)
        self.alive()

    def test_slow_and_many_clients_do_no_harm(self):
        links = []
        try:
            for k in range(200):
                link = socket.create_connection(("127.0.0.1", self.server.port), timeout=10)
                links.append(link)
                if k % 2:
                    link.sendall(b"GET / HT")
        finally:
            for link in links:
                link.close()
        self.alive()

    def test_what_cannot_be_viewed_is_refused(self):
        done = subprocess.run([UNDINE, "view", HERE], capture_output=True, text=True, timeout=20, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("does not hold a run", done.stderr)
        done = subprocess.run([UNDINE, "view", self.folder, "--port", str(self.server.port)], capture_output=True, text=True, timeout=20, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("cannot listen", done.stderr)


class Browser(unittest.TestCase):
    def test_finished_and_running(self):
        out, live = os.path.join(RUNS, "browser"), os.path.join(RUNS, "live")
        os.makedirs(out, exist_ok=True)
        shutil.rmtree(live, ignore_errors=True)
        case = os.path.join(HERE, "..", "..", "cases", "dam_break_2d.toml")
        running = subprocess.Popen([UNDINE, "run", case, "--out", live, "--threads", "1", "--quiet", "--set", "spacing=0.02", "--set", "time.end=1000",
                                    "--set", "output.snapshots=0.01", "--set", "output.energies=0.005"])
        servers = []
        try:
            while not os.path.exists(os.path.join(live, "particles.vtkhdf.series")):
                self.assertIsNone(running.poll())
                time.sleep(0.1)
            servers = [Server(os.path.join(RUNS, "flat")), Server(live, "--follow")]
            path, at = snapshots(os.path.join(RUNS, "flat"))[-1]
            want = stored(path)
            row = int(numpy.flatnonzero(want["group"] == 0)[17])
            plan = os.path.join(out, "view_plan.json")
            with open(plan, "w", encoding="utf-8") as file:
                json.dump({"finished": servers[0].url, "running": servers[1].url, "last": at, "id": int(want["id"][row])}, file)
            done = subprocess.run(["node", os.path.join(HERE, "view_test.mjs"), CHROMIUM, plan, out], capture_output=True, text=True, timeout=200, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIsNone(running.poll(), "closing the browser leaves the run alone")
            with open(os.path.join(out, "view_readings.json"), encoding="utf-8") as file:
                readings = json.load(file)
            self.assertEqual(numpy.float32(readings["pressure"][0]), want["p"][row])
        finally:
            for server in servers:
                server.stop()
            running.send_signal(signal.SIGINT)
            running.wait(timeout=60)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "Browser" if CHROMIUM else "Serving"], verbosity=2)
