"""A running program rholm studio, and the requests of a page."""

import http.client
import json
import os
import re
import signal
import subprocess
import time

from harness import RHOLM, TIMEOUT

# In background runs of tests the signal is ignored, and started programs would inherit this.
signal.signal(signal.SIGINT, signal.default_int_handler)

TETRAHEDRON = b"OFF\n4 4 0\n1 1 1\n1 -1 -1\n-1 1 -1\n-1 -1 1\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n"


# Runs until it is cancelled: caps of degree 2 with a small error take minutes of processor time.
LONG_JOB = {"op": "compress", "item": 1, "tolerance": 1e-4, "max_degree": 2}


class Studio:
    """A running program and its connection."""

    def __init__(self, test, *words, **environment):
        self.process = subprocess.Popen([RHOLM, "studio", "--no-open", *map(str, words)], cwd=test.folder,
                                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True,
                                        env={**os.environ, **environment})
        test.addCleanup(self.process.stdout.close)
        test.addCleanup(self.process.stderr.close)
        test.addCleanup(self.process.wait)
        test.addCleanup(self.process.kill)
        line = self.process.stderr.readline()
        found = re.search(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/", line)
        test.assertTrue(found, line)
        self.port, self.token = int(found[1]), found[2]
        self.session = None

    def ask(self, method, path, body=None, where=None, **headers):
        """Returns status, headers and bytes of an answer. `where` replaces the path below the token."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=TIMEOUT)
        headers = {name.replace("_", "-"): value for name, value in headers.items()}
        if self.session:
            headers.setdefault("X-Session", self.session)
        connection.request(method, where or f"/{self.token}/{path}", body, headers)
        response = connection.getresponse()
        data = response.read()
        connection.close()
        return response.status, response.headers, data

    def json(self, method, path, body=None, **headers):
        return json.loads(self.ask(method, path, body, **headers)[2])

    def begin(self):
        self.session = None
        answer = self.json("POST", "api/session")
        self.session = answer["session"]
        return answer["state"]

    def post(self, **step):
        status, _, data = self.ask("POST", "api/step", json.dumps(step))
        return status, json.loads(data)

    def step(self, **step):
        """Returns the state when the step is done."""
        status, answer = self.post(**step)
        assert status in (200, 202), answer
        while status == 202:
            answer = self.json("GET", "api/state")
            if answer["job"]["state"] != "running":
                assert answer["job"]["state"] == "done", answer["job"]
                break
            time.sleep(0.01)
        return answer

    def end(self, number=signal.SIGINT):
        self.process.send_signal(number)
        return self.process.wait(TIMEOUT)
