#!/usr/bin/env python3
"""`undine view`: what it sends is what is stored, and nobody without the token gets anything, whatever they send.

    view_test.py UNDINE RUNS           talks to the server
    view_test.py UNDINE RUNS CHROMIUM  opens its page in a browser (view_test.mjs), of a run that ended and of one that goes on

RUNS is the folder that runs.py made.
"""

import concurrent.futures
import http.client
import json
import os
import random
import shutil
import socket
import subprocess
import sys
import time
import unittest

import numpy

import synthetic_run
from page_data import Blocks
from report_test import snapshots, stored
from serving import Server

UNDINE, RUNS, CHROMIUM = (sys.argv + [None])[1:4] if len(sys.argv) > 2 else (None, None, None)
HERE = os.path.dirname(os.path.abspath(__file__))


class Serving(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = os.path.join(RUNS, "spatial")
        cls.before = cls.listing()
        cls.server = Server(UNDINE, cls.folder)

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
        with self.assertRaises(ConnectionRefusedError):
            socket.create_connection(("127.0.0.2", self.server.port), timeout=5)

    def test_other_addresses_only_where_asked_for(self):
        open_to_all = Server(UNDINE, self.folder, "--host", "0.0.0.0")
        try:
            for host in ("127.0.0.1", "127.0.0.2"):
                for path, want in ((open_to_all.path + "state.json", 200), ("/state.json", 403), ("/" + "0" * 32 + "/state.json", 403)):
                    link = http.client.HTTPConnection(host, open_to_all.port, timeout=10)
                    link.request("GET", path)
                    self.assertEqual(link.getresponse().status, want, (host, path))
                    link.close()
        finally:
            open_to_all.stop()

    def test_huge_requests_do_no_harm(self):
        before = self.server.largest_memory()
        for data in (b"GET / HTTP/1.1\r\nHost: x\r\nX: " + b"a" * 50_000_000 + b"\r\n\r\n", b"GET /" + b"a" * 50_000_000 + b" HTTP/1.1\r\n\r\n",
                     b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 2_000_000 + b"\r\n", b"POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n" + b"z" * 1_000_000):
            self.assertNotIn(b"200 OK", self.server.raw(data))
        self.alive()
        self.assertLess(self.server.largest_memory() - before, 10, "nothing keeps 50 MB headers")

    def test_packed_numbers_are_not_packed_again(self):
        for name in ("", "data.json", "frame.json?number=0"):
            status, _, response = self.server.get(self.server.path + name, headers={"Accept-Encoding": "gzip, deflate, br, zstd"})
            self.assertEqual((status, response.headers["Content-Encoding"]), (200, None), name)

    def test_what_follows_a_request_is_no_request(self):
        head = f"Host: 127.0.0.1:{self.server.port}\r\n"
        inner = f"GET {self.server.path}state.json HTTP/1.1\r\n{head}\r\n"
        for length in (f"Content-Length: {len(inner)}", "Transfer-Encoding: chunked"):
            answer = self.server.raw(f"POST {self.server.path} HTTP/1.1\r\n{head}{length}\r\n\r\n{inner}".encode())
            self.assertIn(b"405", answer.split(b"\r\n")[0])
            self.assertEqual(answer.count(b"HTTP/1.1 "), 1, answer)

    def test_parts_of_an_answer_cannot_be_multiplied(self):
        status, body, _ = self.server.get(self.server.path, headers={"Range": "bytes=" + ",".join(["0-"] * 500)})
        self.assertEqual((status, len(body)), (200, len(self.server.get(self.server.path)[1])))

    def test_random_bytes_do_no_harm(self):
        chance = random.Random(5)
        start = f"GET {self.server.path}frame.json?number=0&most=50 HTTP/1.1\r\nHost: 127.0.0.1:{self.server.port}\r\nConnection: close\r\n\r\n".encode()
        wish = f"POST {self.server.path}control?wish=stop HTTP/1.1\r\nHost: 127.0.0.1:{self.server.port}\r\nConnection: close\r\n\r\n".encode()
        requests = []
        for k in range(300):
            data = bytearray((start, wish, chance.randbytes(chance.randrange(1, 3000)))[k % 3])
            for _ in range(chance.randrange(1, 12)):
                data[chance.randrange(len(data))] = chance.randrange(256)
            requests.append(bytes(data) + b"\r\n\r\n")
        with concurrent.futures.ThreadPoolExecutor(10) as clients:  # most of them only wait for what does not come
            list(clients.map(lambda data: self.server.raw(data, wait=0.3), requests))
        self.alive()

    def test_slow_and_many_clients_keep_nobody_waiting(self):
        links = []
        try:
            for k in range(200):
                link = socket.create_connection(("127.0.0.1", self.server.port), timeout=10)
                links.append(link)
                if k % 2:
                    link.sendall(b"GET / HTTP/1.1\r\nX: ")
            start = time.monotonic()
            for _ in range(5):
                self.alive()
                time.sleep(0.1)
            self.assertLess(time.monotonic() - start, 4, "200 clients that say nothing, or nothing more, hold nobody up")
            # Bytes that trickle in do not keep a request alive: after its five seconds it is cut off.
            held = links[1::2]
            while held and time.monotonic() - start < 20:
                for link in list(held):
                    try:
                        link.sendall(b"a")
                    except OSError:
                        held.remove(link)
                time.sleep(0.5)
            self.assertEqual(len(held), 0, "clients that trickle are cut off")
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
        running = subprocess.Popen([UNDINE, "run", case, "--out", live, "--threads", "1", "--quiet", "--control", "--set", "spacing=0.02", "--set", "time.end=1000",
                                    "--set", "output.snapshots=0.01", "--set", "output.energies=0.005"])
        servers = []
        try:
            while not os.path.exists(os.path.join(live, "particles.vtkhdf.series")):
                self.assertIsNone(running.poll())
                time.sleep(0.1)
            large = os.path.join(RUNS, "large")
            many = 300_000
            synthetic_run.write(large, many)
            servers = [Server(UNDINE, os.path.join(RUNS, "flat")), Server(UNDINE, live, "--follow"), Server(UNDINE, large)]
            path, at = snapshots(os.path.join(RUNS, "flat"))[-1]
            want = stored(path)
            row = int(numpy.flatnonzero(want["group"] == 0)[17])
            plan = os.path.join(out, "view_plan.json")
            with open(plan, "w", encoding="utf-8") as file:
                json.dump({"finished": servers[0].url, "running": servers[1].url, "large": servers[2].url, "many": many, "last": at, "id": int(want["id"][row])}, file)
            done = subprocess.run(["node", os.path.join(HERE, "view_test.mjs"), CHROMIUM, plan, out], capture_output=True, text=True, timeout=800, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(running.wait(timeout=60), 130)
            with open(os.path.join(out, "view_readings.json"), encoding="utf-8") as file:
                readings = json.load(file)
            self.assertEqual(numpy.float32(readings["pressure"][0]), want["p"][row])
        finally:
            for server in servers:
                server.stop()
            if running.poll() is None:
                running.kill()
                running.wait()
            shutil.rmtree(os.path.join(RUNS, "large"), ignore_errors=True)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "Browser" if CHROMIUM else "Serving"], verbosity=2)
