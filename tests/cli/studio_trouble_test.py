"""rholm studio under difficult conditions: too large requests, many at the same time, pages that close
during work. Requests are answered, nothing is lost, and memory is returned."""

import json
import os
import random
import signal
import socket
import sys
import threading

sys.path.insert(0, os.path.dirname(__file__))
from harness import NIGHTLY, TIMEOUT, CliTest, main, nightly_too, until
from studio_program import LONG_JOB, TETRAHEDRON, Studio

LONG = os.environ.get("RHOLM_LONG") == "1"  # True where tests of minutes are wanted
MIB = 1 << 20
SANITIZED = os.environ.get("RHOLM_TEST_SANITIZED") == "1"


def is_compared(test):
    """Returns true if memory can be compared; a sanitizer's allocator keeps freed memory."""
    if SANITIZED:
        print(f"{test.id()}: memory is not compared, as a sanitizer keeps it", file=sys.stderr)
    return not SANITIZED


def gives_back(test, studio, most):
    """Waits until the program has fewer bytes than `most` (memory is returned several times a second)."""
    if is_compared(test):
        until(lambda: resident(studio) < most, f"less than {most} bytes", studio.process)


def has_taken_less(test, studio, most):
    """Checks that the program has never had `most` bytes."""
    if is_compared(test):
        test.assertLess(highest(studio), most)


def resident(studio):
    """Returns the bytes of memory that the program has."""
    with open(f"/proc/{studio.process.pid}/status") as status:
        return next(1024 * int(line.split()[1]) for line in status if line.startswith("VmRSS:"))


def highest(studio):
    """Returns the largest number of bytes that the program has had."""
    with open(f"/proc/{studio.process.pid}/status") as status:
        return next(1024 * int(line.split()[1]) for line in status if line.startswith("VmHWM:"))


def listener(studio):
    """Opens a stream of events, as a page does."""
    connection = socket.create_connection(("127.0.0.1", studio.port), timeout=TIMEOUT)
    connection.sendall(f"GET /{studio.token}/api/events?session={studio.session} HTTP/1.1\r\n"
                       f"Host: 127.0.0.1:{studio.port}\r\n\r\n".encode())
    assert b" 200 " in connection.recv(1000).split(b"\r\n")[0]
    return connection


def in_threads(n, work):
    threads = [threading.Thread(target=work, args=(i,)) for i in range(n)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


class Large(CliTest):
    def test_two_gigabytes_are_refused_before_they_fill_memory_or_disk(self):
        studio = Studio(self, TMPDIR=str(self.folder))
        studio.begin()
        studio.ask("POST", "api/file?name=a.off", TETRAHEDRON)
        before = highest(studio)
        sparse = self.folder / "huge.ply"
        with open(sparse, "wb") as file:
            file.truncate(1 << 31)
        # Like curl, which waits for permission to send, and like a browser, which does not.
        for expect in ("Expect: 100-continue\r\n", ""):
            with socket.create_connection(("127.0.0.1", studio.port), timeout=TIMEOUT) as connection:
                connection.sendall(f"POST /{studio.token}/api/file?name=huge.ply HTTP/1.1\r\nHost: 127.0.0.1:"
                                   f"{studio.port}\r\n{expect}Content-Length: {1 << 31}\r\n"
                                   f"X-Session: {studio.session}\r\n\r\n".encode())
                if not expect:
                    with open(sparse, "rb") as file:
                        try:
                            connection.sendfile(file, count=64 * MIB)
                        except ConnectionError:
                            pass  # the program has closed the connection
                try:
                    self.assertIn(b" 413 ", connection.recv(1000).split(b"\r\n")[0])
                except ConnectionError:
                    self.assertFalse(expect)  # clients that send on regardless may lose the answer
        has_taken_less(self, studio, before + 32 * MIB)
        self.assertEqual(self.files(), ["huge.ply"])
        self.assertEqual(len(studio.json("GET", "api/state")["items"]), 1)

    def test_a_large_file_that_is_none_leaves_no_memory_behind(self):
        studio = Studio(self)
        studio.begin()
        garbage = random.Random(1).randbytes(64 * MIB)
        self.assertEqual(studio.ask("POST", "api/file?name=a.ply", garbage)[0], 422)
        before = resident(studio)
        for name in ("a.ply", "a.off", "a.obj", "a.stl", "a.xyz", "a.h5", "a.rholm"):
            self.assertEqual(studio.ask("POST", f"api/file?name={name}", garbage)[0], 422, name)
        gives_back(self, studio, before + 32 * MIB)
        self.assertEqual(studio.json("GET", "api/state")["items"], [])


class Many(CliTest):
    def test_a_thousand_requests_at_once(self):
        studio = Studio(self)
        studio.begin()
        studio.step(op="make", shape="bumpy")
        studio.step(op="expand", item=1, degree=20)
        look = json.dumps({"live": "degree", "item": 1, "degree": 7})
        kinds = [("GET", "api/state", None, {200}), ("GET", "api/item/1/measures", None, {200}),
                 ("POST", "api/live", look, {200, 409}), ("POST", "api/live", "{", {400}),
                 ("GET", "api/item/9/surface", None, {404}), ("GET", "none", None, {404}),
                 ("POST", "api/step", '{"op": "fly"}', {400}), ("GET", "", None, {200}),
                 ("POST", "api/file?name=a.ply", b"ply\n", {422}), ("DELETE", "api/none", None, {404})]
        wrong, done, start = [], [], threading.Barrier(1000)

        def ask(i):
            method, path, body, statuses = kinds[i % len(kinds)]
            start.wait()
            try:
                status = studio.ask(method, path, body)[0]
                if status not in statuses:
                    wrong.append((method, path, status))
                if path == "api/live" and status == 200:
                    done.append(i)
            except OSError as error:
                wrong.append((method, path, error))

        in_threads(1000, ask)
        after_one = resident(studio)
        for _ in range(2):
            in_threads(1000, ask)
        self.assertEqual(wrong, [])
        self.assertTrue(done)  # some live requests were not replaced by later ones
        self.assertEqual(len(studio.json("GET", "api/state")["items"]), 1)
        gives_back(self, studio, after_one + 32 * MIB)

    @nightly_too
    def test_sessions_that_come_and_go_leave_no_memory_behind(self):
        studio = Studio(self)
        first = None
        for _ in range(30 if NIGHTLY else 10):
            studio.begin()
            studio.step(op="make", shape="bumpy", amplitude=0.3)
            studio.step(op="expand", item=1, degree=16)
            studio.ask("POST", "api/live", json.dumps({"live": "degree", "item": 1, "degree": 7}))
            self.assertEqual(studio.ask("DELETE", "api/session")[0], 200)
            first = first or resident(studio)
        gives_back(self, studio, first + 32 * MIB)


class Slow(CliTest):
    """Slow connections that must not delay others."""

    def connect(self, studio, text):
        connection = socket.create_connection(("127.0.0.1", studio.port), timeout=TIMEOUT)
        self.addCleanup(connection.close)
        connection.sendall(text.encode())
        return connection

    def trickle(self, connections, done):
        """Repeatedly sends a byte of an endless header on each connection."""
        while not done.wait(0.2):
            for connection in connections:
                try:
                    connection.sendall(b"a")
                except OSError:
                    pass  # the studio has closed the connection

    def test_without_the_token_they_take_nothing_from_those_with_it(self):
        studio = Studio(self)
        studio.begin()
        slow = [self.connect(studio, f"GET /{'0' * 32}/ HTTP/1.1\r\nA: ") for _ in range(400)]
        done = threading.Event()
        sender = threading.Thread(target=self.trickle, args=(slow, done))
        sender.start()
        try:
            for _ in range(20):
                self.assertEqual(studio.ask("GET", "api/state")[0], 200)
            # The connections do not stay: the time for a header is limited, and the oldest are closed if
            # there are too many.
            for connection in slow:
                try:
                    self.assertEqual(connection.recv(10), b"")
                except ConnectionError:
                    pass  # a byte was on its way
        finally:
            done.set()
            sender.join()

    def test_a_head_has_a_size(self):
        studio = Studio(self)
        connection = self.connect(studio, "GET / HTTP/1.1\r\n")
        try:
            for _ in range(64):
                connection.sendall((b"A: " + b"b" * 1019 + b"\r\n") * 1024)
            self.fail("64 MiB of headers are read")
        except ConnectionError:
            pass
        self.assertEqual(studio.ask("POST", "api/session")[0], 200)

    def test_it_ends_whatever_is_connected(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            studio = Studio(self)
            studio.begin()
            page = listener(studio)
            self.addCleanup(page.close)
            done = threading.Event()
            upload = self.connect(studio, f"POST /{studio.token}/api/file?name=a.ply HTTP/1.1\r\nHost: 127.0.0.1:"
                                  f"{studio.port}\r\nContent-Length: 1000000\r\nX-Session: {studio.session}\r\n\r\n")
            slow = [self.connect(studio, "GET / HTTP/1.1\r\nA: ") for _ in range(100)]
            sender = threading.Thread(target=self.trickle, args=([*slow, upload], done))
            sender.start()
            try:
                self.assertEqual(studio.ask("GET", "api/state")[0], 200)
                self.assertEqual(studio.end(number), 0)  # all connections still send
            finally:
                done.set()
                sender.join()


class Bodies(CliTest):
    @nightly_too
    def test_json_and_what_has_no_body(self):
        studio = Studio(self)
        studio.begin()
        before = highest(studio)
        most = 16 * MIB
        for path in ("api/step", "api/live", "api/session"):
            self.assertEqual(self.refused(studio, "POST", path, most + 1), 413, path)
        for method in ("DELETE", "GET", "PUT", "PATCH"):
            self.assertIn(self.refused(studio, method, "api/session", 1), (413, 404), method)
        status, answer = studio.post(op="make", shape="x" * (most - 100))
        self.assertEqual(status, 400, answer)
        # A number takes more memory than its text: many large bodies at the same time are read one by one.
        large = b'{"op": "look", "item": 1, "gains": [' + b"0," * (most // 2 - 100) + b"0]}"

        def ask(_):
            self.assertEqual(studio.ask("POST", "api/step", large)[0], 404)

        n = 8 if NIGHTLY else 3
        in_threads(n, ask)
        has_taken_less(self, studio, before + (n * 2 * 16 + 512) * MIB)
        self.assertEqual(studio.ask("GET", "api/state")[0], 200)

    def refused(self, studio, method, path, length):
        """Returns the status of the answer to a body of stated length, of which nothing is sent."""
        with socket.create_connection(("127.0.0.1", studio.port), timeout=TIMEOUT) as connection:
            connection.sendall(f"{method} /{studio.token}/{path} HTTP/1.1\r\nHost: 127.0.0.1:{studio.port}\r\n"
                               f"Content-Length: {length}\r\nX-Session: {studio.session}\r\n\r\n".encode())
            return int(connection.recv(1000).split()[1])

    def pieces(self, studio, path, piece, n):
        """Sends a body in chunks until it is refused; returns its status, or None if the answer was lost."""
        with socket.create_connection(("127.0.0.1", studio.port), timeout=TIMEOUT) as connection:
            connection.sendall(f"POST /{studio.token}/{path} HTTP/1.1\r\nHost: 127.0.0.1:{studio.port}\r\n"
                               f"Transfer-Encoding: chunked\r\nX-Session: {studio.session}\r\n\r\n".encode())
            try:
                for _ in range(n):
                    connection.sendall(piece)
                self.fail("all of it is taken")
            except ConnectionError:
                pass
            try:
                return int(connection.recv(1000).split()[1])
            except (ConnectionError, IndexError):
                return None

    def test_pieces_are_counted_while_they_come(self):
        studio = Studio(self)
        studio.begin()
        before = highest(studio)
        piece = b"100000\r\n" + bytes(MIB) + b"\r\n"
        self.assertIn(self.pieces(studio, "api/file?name=a.ply", piece, 400), (411, None))
        self.assertIn(self.pieces(studio, "api/step", piece, 400), (413, None))
        self.assertIn(self.pieces(studio, "api/step", b"0" * MIB, 400), (400, None))  # an unbounded length
        has_taken_less(self, studio, before + 300 * MIB)
        self.assertEqual(studio.ask("GET", "api/state")[0], 200)


class Gone(CliTest):
    def test_a_page_that_goes_away_in_the_middle_of_an_answer_or_a_request(self):
        studio = Studio(self)
        studio.begin()
        studio.step(op="make", shape="bumpy")
        for request in (f"GET /{studio.token}/api/item/1/surface HTTP/1.1\r\n",
                        f"POST /{studio.token}/api/file?name=a.ply HTTP/1.1\r\nContent-Length: 1000000\r\n"):
            for _ in range(20):
                connection = socket.create_connection(("127.0.0.1", studio.port), timeout=TIMEOUT)
                connection.sendall((request + f"Host: 127.0.0.1:{studio.port}\r\n"
                                    f"X-Session: {studio.session}\r\n\r\nply").encode())
                connection.close()
        self.assertEqual(len(studio.json("GET", "api/state")["items"]), 1)

    def test_a_page_that_is_closed_during_a_job_takes_it_along(self):
        if not LONG:
            print("skipped: it takes more than a minute; RHOLM_LONG=1 waits for it")
            return
        studio = Studio(self)
        studio.begin()
        page = listener(studio)
        before = resident(studio)
        studio.step(op="make", shape="bumpy")
        self.assertEqual(studio.post(**LONG_JOB)[0], 202)
        until(lambda: resident(studio) > before + 64 * MIB, "the job takes no memory")
        page.close()
        # No page sends requests any more.
        until(lambda: resident(studio) < before + 32 * MIB, "the job ends with its page")
        self.assertEqual(studio.ask("GET", "api/state")[0], 404)


if __name__ == "__main__":
    main()
