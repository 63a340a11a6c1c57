"""rholm studio, as a browser sees it: permissions, answers, and its end. Recipes must make the files that
the studio saves."""

import http.client
import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading

sys.path.insert(0, os.path.dirname(__file__))
from harness import RHOLM, TIMEOUT, CliTest, main, until
from studio_program import LONG_JOB, TETRAHEDRON, Studio


class Access(CliTest):
    def test_there_is_nothing_without_the_token(self):
        studio = Studio(self)
        wrong = "0" * 32
        for path in ("/", "/api/state", f"/{wrong}/", f"/{wrong}/api/state", f"/{studio.token}",
                     f"/{studio.token[:31]}/", f"//{studio.token}/", "/index.html", "*",
                     f"/{studio.token.upper()}x/api/state"):
            for method in ("GET", "POST", "DELETE", "PUT", "HEAD", "OPTIONS"):
                status, headers, data = studio.ask(method, "", b"" if method == "POST" else None, where=path)
                self.assertIn(status, (400, 404), path)
                self.assertEqual(data, b"", path)
                self.assertIsNone(headers.get("Access-Control-Allow-Origin"))
        self.assertNotEqual(studio.token, Studio(self).token)

    def test_other_pages_are_refused(self):
        studio = Studio(self)
        own = f"127.0.0.1:{studio.port}"
        self.assertEqual(studio.ask("GET", "")[0], 200)
        self.assertEqual(studio.ask("GET", "", Host=f"localhost:{studio.port}")[0], 200)
        for host in ("evil.example", f"evil.example:{studio.port}", "127.0.0.1", "localhost", "",
                     f"127.0.0.1:{studio.port + 1}", f"127.0.0.1:{studio.port}.evil.example"):
            self.assertEqual(studio.ask("POST", "api/session", Host=host)[0], 403, host)
        self.assertEqual(studio.ask("POST", "api/session", Origin=f"http://{own}")[0], 200)
        for origin in ("http://evil.example", "null", f"https://{own}", f"http://{own}/",
                       f"http://localhost:{studio.port}", "file://"):
            self.assertEqual(studio.ask("POST", "api/session", Origin=origin)[0], 403, origin)
        for site, status in (("same-origin", 200), ("none", 200), ("cross-site", 403), ("same-site", 403)):
            self.assertEqual(studio.ask("POST", "api/session", Sec_Fetch_Site=site)[0], status, site)
        # Links to the page are allowed; the page in a frame is not.
        link = {"Sec_Fetch_Site": "cross-site", "Sec_Fetch_Mode": "navigate"}
        self.assertEqual(studio.ask("GET", "", Sec_Fetch_Dest="document", **link)[0], 200)
        self.assertEqual(studio.ask("GET", "", Sec_Fetch_Dest="iframe", **link)[0], 403)
        self.assertEqual(studio.ask("GET", "api/state", Sec_Fetch_Dest="document", **link)[0], 403)

    def test_every_answer_says_how_it_may_be_used(self):
        studio = Studio(self)
        studio.begin()
        for path in ("", "api/state", "none", "api/none"):
            headers = studio.ask("GET", path)[1]
            self.assertEqual(headers["Cache-Control"], "no-store")
            self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
            self.assertEqual(headers["Referrer-Policy"], "no-referrer")
            self.assertIn("frame-ancestors 'none'", headers["Content-Security-Policy"])

    def test_only_this_machine(self):
        studio = Studio(self)
        try:
            found = socket.getaddrinfo(socket.gethostname(), None)
        except socket.gaierror:
            found = []  # the machine cannot resolve its own name
        others = {address[4][0] for address in found}
        others = {a for a in others if not a.startswith("127.") and a != "::1"}
        if not others:
            print("skipped: this machine has no other address")
        for address in others | {"::1"}:
            with self.assertRaises(OSError):
                socket.create_connection((address, studio.port), timeout=2).close()

    def test_files_of_the_page_and_no_others(self):
        page = self.folder / "page"
        (page / "assets").mkdir(parents=True)
        (page / "index.html").write_text("<p>here")
        (page / "assets/a.js").write_text("let a;")
        (self.folder / "secret.txt").write_text("secret")
        studio = Studio(self, "--page", "page")
        status, headers, data = studio.ask("GET", "")
        self.assertEqual((status, headers["Content-Type"], data), (200, "text/html; charset=utf-8", b"<p>here"))
        status, headers, data = studio.ask("GET", "assets/a.js")
        self.assertEqual((status, headers["Content-Type"], data), (200, "text/javascript", b"let a;"))
        for path in ("../secret.txt", "..%2fsecret.txt", "assets/../../secret.txt", "assets/..%2f..%2fsecret.txt",
                     "%2e%2e/secret.txt", "assets", "assets/", "/etc/passwd", "./index.html", "b.js",
                     "assets/a.js%00", "....//secret.txt", "..\\secret.txt"):
            status, _, data = studio.ask("GET", path)
            self.assertEqual(status, 404, path)
            self.assertNotIn(b"secret", data)
        # The folder is read once: later files do not appear.
        (page / "late.js").write_text("let b;")
        self.assertEqual(studio.ask("GET", "late.js")[0], 404)
        result = self.rholm("studio", "--no-open", "--page", self.folder, code=1)
        self.assertIn("index.html", result.err)


class Work(CliTest):
    def test_files_of_the_command_line_are_there_first(self):
        self.rholm("make", "bumpy", "-o", "a.ply")
        self.rholm("expand", "a.ply", "--degree", "4", "-o", "a.h5")
        studio = Studio(self, "a.ply", "a.h5")
        for _ in range(2):  # the same for every page
            self.assertEqual([(i["name"], i["kind"]) for i in studio.begin()["items"]],
                             [("a.ply", "mesh"), ("a.h5", "expansion")])

    def test_columns_of_the_command_line_are_those_of_its_tables(self):
        self.write("a.txt", "".join(f"{k} {k * k} {k % 3} {k + .5}\n" for k in range(2, 40)))
        item = Studio(self, "a.txt", "--columns", "-,x,y,z").begin()["items"][0]
        self.assertEqual([c["taken_for"] for c in item["table"]["columns"]], ["-", "x", "y", "z"])
        self.rholm("studio", "--no-open", "a.txt", "--columns", "x,y", code=2)
        self.rholm("studio", "--no-open", "a.txt", "--columns", "x,y,z", code=3)

    def test_files_that_are_refused_end_it(self):
        self.write("bad.ply", "ply\nnothing\n")
        self.rholm("studio", "--no-open", "bad.ply", code=3)
        self.rholm("studio", "--no-open", "none.ply", code=1)

    def test_a_port_that_is_taken(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = taken.getsockname()[1]
            result = self.rholm("studio", "--no-open", "--port", port, code=1)
            self.assertIn(str(port), result.err)
        self.assertEqual(Studio(self, "--port", port).port, port)

    def test_recipes_make_what_is_saved(self):
        studio = Studio(self)
        studio.begin()
        studio.step(op="make", shape="bumpy", amplitude=0.45, seed=5)
        studio.step(op="expand", item=1, degree=12)
        studio.step(op="look", item=1, degree=5)
        saved = {}

        def keep(item, format):
            status, headers, data = studio.ask("GET", f"api/save?item={item}&format={format}")
            self.assertEqual(status, 200, data[:200])
            return data

        saved["bumpy.h5"] = None
        studio.step(op="smooth", item=1, regions=["vertex:5,0.5"], wavelength=0.4, strength=0.5)
        saved["bumpy-smooth.ply"] = keep(1, "ply")
        studio.step(op="transfer", source=1, to=["vertex:900,0.4"], target=1, height=2, angle=30, scale=0.9,
                    **{"from": ["vertex:5,0.4"]}, repeat=True)
        saved["bumpy-transfer.ply"] = keep(1, "ply")
        studio.step(op="simplify", item=1, faces=4000)
        saved["bumpy-simple.ply"] = keep(1, "ply")
        studio.step(op="repair", item=1)
        saved["bumpy-repaired.ply"] = keep(1, "ply")
        studio.step(op="make", shape="points")
        studio.step(op="orient", item=2)
        saved["points-oriented.ply"] = keep(2, "ply")
        studio.step(op="reconstruct", item=2, noise="none", simplify=0.25)
        saved["points-surface.ply"] = keep(3, "ply")
        studio.step(op="compress", item=1, tolerance=0.15)
        saved["bumpy-caps.h5"] = keep(4, "h5")
        studio.step(op="make", shape="ellipsoid")
        studio.step(op="expand", item=5, tolerance=0.02)
        saved["ellipsoid.h5"] = keep(5, "h5")
        studio.step(op="look", item=5, degree=2, gains=[1, 0.5, 0.25])
        studio.step(op="simplify", item=5, error=0.01)
        saved["ellipsoid-simple.ply"] = keep(5, "ply")
        recipe = self.folder / "recipe"
        recipe.mkdir()
        lines = studio.json("GET", "api/state")["recipe"]["shell"]
        ran = subprocess.run(["bash", "-eu", "-c", lines], cwd=recipe, capture_output=True, text=True,
                             env={**os.environ, "PATH": os.path.dirname(os.path.abspath(RHOLM)) + ":" +
                                  os.environ["PATH"]}, timeout=TIMEOUT)
        self.assertEqual(ran.returncode, 0, lines + ran.stderr)
        for name, data in saved.items():
            with self.subTest(name):
                made = (recipe / name).read_bytes()
                self.assertTrue(data is None or made == data, lines)

    def test_events_tell_of_steps_and_jobs(self):
        studio = Studio(self)
        studio.begin()
        connection = http.client.HTTPConnection("127.0.0.1", studio.port, timeout=TIMEOUT)
        self.addCleanup(connection.close)
        connection.request("GET", f"/{studio.token}/api/events?session={studio.session}")
        stream = connection.getresponse()
        self.assertEqual((stream.status, stream.headers["Content-Type"]), (200, "text/event-stream"))

        def next_event():
            lines = []
            while not lines or lines[-1] != b"\n":
                lines.append(stream.readline())
                self.assertTrue(lines[-1], "the stream has ended")
            if lines[0].startswith(b":"):
                return next_event()
            self.assertTrue(lines[0].startswith(b"event: ") and lines[1].startswith(b"data: "), lines)
            return lines[0][7:-1].decode(), json.loads(lines[1][6:])

        self.assertEqual(next_event()[0], "state")
        studio.step(op="make", shape="bumpy")
        name, state = next_event()
        self.assertEqual((name, len(state["items"])), ("state", 1))
        studio.post(op="expand", item=1, degree=6)
        seen = set()
        while "done" not in seen:
            name, data = next_event()
            if name == "job":
                seen.add(data["state"])
        self.assertEqual(studio.end(), 0)

    def test_two_sessions_and_a_thousand_requests(self):
        studio = Studio(self)
        studio.begin()
        studio.step(op="make", shape="box")
        first = studio.session
        self.assertEqual(studio.begin()["items"], [])
        wrong = []

        def look(begin):
            for i in range(begin, 1000, 50):
                session = first if i % 2 else studio.session
                try:
                    status, _, data = studio.ask("GET", "api/state", X_Session=session)
                    if status != 200 or len(json.loads(data)["items"]) != i % 2:
                        wrong.append(data)
                except OSError as error:
                    wrong.append(error)
        threads = [threading.Thread(target=look, args=(begin,)) for begin in range(50)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_uploads_that_are_too_large(self):
        studio = Studio(self, "--max-upload", 1000)
        studio.begin()
        self.assertEqual(studio.ask("POST", "api/file?name=a.off", TETRAHEDRON)[0], 200)
        # The request is refused by its stated size, before its data arrives.
        with socket.create_connection(("127.0.0.1", studio.port), timeout=TIMEOUT) as connection:
            connection.sendall(f"POST /{studio.token}/api/file?name=a.ply HTTP/1.1\r\nHost: 127.0.0.1:"
                               f"{studio.port}\r\nContent-Length: 999999999999\r\n\r\n".encode())
            self.assertIn(b" 413 ", connection.recv(1000).split(b"\r\n")[0])
        # The request does not state its size.
        def chunks():
            for _ in range(100):
                yield b"x" * 100
        try:
            status, _, data = studio.ask("POST", "api/file?name=a.ply", chunks())
            self.assertEqual(status, 413, data)
        except (BrokenPipeError, ConnectionResetError):
            pass  # the program closed the connection early; its answer is lost
        self.assertEqual(len(studio.json("GET", "api/state")["items"]), 1)

    def test_requests_that_are_none(self):
        studio = Studio(self)
        studio.begin()
        for text in (b"", b"\r\n\r\n", b"GET\r\n\r\n", b"\0\0\0\0\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n",
                     b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n\r\n",
                     b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 10000 + b"\r\n",
                     f"POST /{studio.token}/api/step HTTP/1.1\r\nHost: 127.0.0.1:{studio.port}\r\n"
                     f"Content-Length: 100\r\n\r\n{{".encode()):
            with socket.create_connection(("127.0.0.1", studio.port), timeout=TIMEOUT) as connection:
                try:
                    connection.sendall(text)
                    connection.shutdown(socket.SHUT_WR)
                    while connection.recv(100000):
                        pass
                except OSError:
                    pass
        self.assertEqual(studio.ask("GET", "api/state")[0], 200)


class End(CliTest):
    def test_signals_and_the_page_end_it(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            studio = Studio(self, TMPDIR=str(self.folder))
            studio.begin()
            studio.step(op="make", shape="box")
            self.assertEqual(studio.ask("GET", "api/save?item=1&format=ply")[0], 200)
            self.assertEqual(studio.end(number), 0)
            self.assertEqual(studio.process.stdout.read(), "")
            self.assertEqual(self.files(), [])  # no temporary files either
        studio = Studio(self)
        self.assertEqual(studio.json("POST", "api/quit"), {"quit": True})
        self.assertEqual(studio.process.wait(TIMEOUT), 0)

    def test_it_ends_as_soon_as_it_has_begun(self):
        for _ in range(10):
            self.assertEqual(Studio(self).end(signal.SIGTERM), 0)

    def test_it_ends_during_a_job(self):
        studio = Studio(self, TMPDIR=str(self.folder))
        studio.begin()
        studio.step(op="make", shape="bumpy")
        self.assertEqual(studio.post(**LONG_JOB)[0], 202)
        self.assertEqual(studio.post(op="undo")[0], 409)
        self.assertEqual(studio.end(), 0)
        self.assertEqual(self.files(), [])

    def test_a_session_ends_during_a_job(self):
        studio = Studio(self)
        studio.begin()
        studio.step(op="make", shape="bumpy")
        self.assertEqual(studio.post(**LONG_JOB)[0], 202)
        self.assertEqual(studio.ask("DELETE", "api/session")[0], 200)
        self.assertEqual(studio.ask("GET", "api/state")[0], 404)
        self.assertEqual(studio.begin()["items"], [])

    def test_the_address_is_not_in_the_list_of_processes(self):
        seen = self.folder / "seen"
        browser = self.folder / "xdg-open"
        browser.write_text(f'#!/bin/sh\nprintf "%s\\n" "$@" > {seen}.part; cat "$1" >> {seen}.part\n'
                           f'mv {seen}.part {seen}\n')
        browser.chmod(0o755)
        process = subprocess.Popen([RHOLM, "studio"], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True,
                                   env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}",
                                        "TMPDIR": str(self.folder)})
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        address = re.search(r"http://\S+", process.stderr.readline())[0]
        until(seen.exists, "the browser has been started", process)
        arguments, page = seen.read_text().split("\n", 1)
        self.assertNotIn(address, arguments)
        self.assertIn(address, page)
        self.assertEqual(os.stat(os.path.dirname(arguments)).st_mode & 0o777, 0o700)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(TIMEOUT), 0)
        self.assertFalse(os.path.exists(arguments))


if __name__ == "__main__":
    main()
