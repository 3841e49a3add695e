"""`undine view` as a process, and ways to ask it."""

import http.client
import json
import re
import socket
import subprocess
from urllib.parse import urlsplit


class Server:
    """`undine view` on a folder, until stop()."""

    def __init__(self, undine, folder, *words):
        self.process = subprocess.Popen([undine, "view", folder, *words], stdout=subprocess.PIPE, text=True)
        found = None
        for line in self.process.stdout:
            if found := re.search(r"http://\S+/", line):
                break
        self.url = found.group()
        place = urlsplit(self.url)
        self.port, self.path = place.port, place.path

    def stop(self):
        self.process.terminate()
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
        """Sends bytes and returns what comes back until the server ends it, if anything does."""
        answer = b""
        with socket.create_connection(("127.0.0.1", self.port), timeout=30) as link:
            link.settimeout(wait)
            try:
                link.sendall(data)
                while len(answer) < 1_000_000 and (more := link.recv(65536)):
                    answer += more
            except OSError:
                pass
        return answer

    def largest_memory(self):
        """MB that the server has ever held."""
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as file:
            return int(re.search(r"VmHWM:\s*(\d+) kB", file.read()).group(1)) / 1000
