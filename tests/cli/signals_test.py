"""Signals and limits of the system: documented exit codes, old files unchanged, no temporary files."""

import os
import resource
import signal
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, RHOLM, TIMEOUT, main

OLD = b"what was here before\n"


class Signals(CliTest):
    def started(self, *words, environment=None, **options):
        """Starts a rholm that waits for its input, the named pipe in.ply."""
        if not (self.folder / "in.ply").exists():
            os.mkfifo(self.folder / "in.ply")
        process = subprocess.Popen([RHOLM, *words], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE,
                                   env={**os.environ, **(environment or {})}, **options)
        # Returns when the program has opened the other end: its signal handlers exist then.
        writer = os.open(self.folder / "in.ply", os.O_WRONLY)
        return process, writer

    def ended(self, process, writer):
        os.close(writer)  # the program may not have seen the signal before it reads
        out, err = process.communicate(timeout=TIMEOUT)
        return process.returncode, out, err

    def test_what_asks_to_stop_has_its_code_in_the_table(self):
        for sign in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGXCPU,
                     signal.SIGALRM, signal.SIGUSR1, signal.SIGUSR2):
            with self.subTest(sign.name):
                self.write("o.off", OLD)
                process, writer = self.started("convert", "in.ply", "o.off")
                process.send_signal(sign)
                code, out, err = self.ended(process, writer)
                self.assertEqual((code, out), (128 + sign, b""), err)
                self.assertIn(b"interrupted", err)
                self.assertEqual(self.files(), ["in.ply", "o.off"])
                self.assertEqual((self.folder / "o.off").read_bytes(), OLD)

    def test_a_signal_that_the_parent_ignores_is_ignored(self):
        process, writer = self.started(
            "info", "in.ply", preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.send_signal(signal.SIGHUP)
        code, _, err = self.ended(process, writer)
        self.assertEqual(code, 3, err)  # the file is empty

    def limited(self, *words, limit, size):
        return subprocess.run([RHOLM, *words], cwd=self.folder, capture_output=True,
                              timeout=TIMEOUT,
                              preexec_fn=lambda: resource.setrlimit(limit, (size, size + 60)))

    def test_a_limit_of_file_sizes_is_an_output_that_cannot_be_written(self):
        self.rholm("make", "ellipsoid", "--axes", "3,2,1", "--subdivisions", "3", "-o", "e.ply")
        self.rholm("analyze", "e.ply", "--degree", "16", "-o", "e.json")
        self.write("rows.csv", "id,path\n" + "".join(f"{k},e.ply\n" for k in range(50)))
        for words, name in ((["convert", "e.ply"], "o.off"), (["convert", "e.json"], "o.h5"),
                            (["convert", "e.json"], "o.npy"),
                            (["render", "e.ply", "--size", "64x64"], "o.png"),
                            (["report", "e.json", "--size", "64"], "o.html"),
                            (["simplify", "e.ply", "--faces", "500"], "o.ply")):
            with self.subTest(name):
                self.write(name, OLD)
                before = self.files()
                process = self.limited(*words, *([] if words[0] == "convert" else ["-o"]), name, limit=resource.RLIMIT_FSIZE, size=512)
                self.assertEqual(process.returncode, 1, process.stderr)
                self.assertIn(b"cannot write", process.stderr)
                self.assertEqual(self.files(), before)
                self.assertEqual((self.folder / name).read_bytes(), OLD)
        # A batch keeps its journal, so that it can be continued.
        process = self.limited("batch", "rows.csv", "--command", "info", "-o", "rows.h5",
                               limit=resource.RLIMIT_FSIZE, size=2048)
        self.assertEqual(process.returncode, 1, process.stderr)

    def test_a_limit_of_processor_time_stops_the_work(self):
        self.rholm("make", "bumpy", "--subdivisions", "6", "-o", "b.ply")
        before = self.files()
        # Direct sums take minutes.
        process = self.limited("analyze", "b.ply", "--degree", "1000", "--engine", "direct", "-o",
                               "b.h5", limit=resource.RLIMIT_CPU, size=1)
        self.assertEqual(process.returncode, 128 + signal.SIGXCPU, process.stderr)
        self.assertIn(b"interrupted", process.stderr)
        self.assertEqual(self.files(), before)

    def test_folders_of_killed_programs_go_with_the_next(self):
        temporary = self.folder / "tmp"
        temporary.mkdir()
        place = {"TMPDIR": str(temporary)}
        self.rholm("make", "box", "-o", "box.ply")
        self.write("rows.csv", "path\nbox.ply\nin.ply\n")
        # The second row waits for the pipe.
        process, writer = self.started("batch", "rows.csv", "--command", "info", "-o", "rows.csv2.csv",
                                       "--threads", "1", environment=place)
        process.kill()
        self.ended(process, writer)
        self.assertEqual(len(list(temporary.glob("rholm-batch-*"))), 1)
        # A folder of another program whose name begins alike is kept.
        (temporary / "rholm-batch-shapes").mkdir()
        self.write("box.csv", "path\nbox.ply\n")
        self.rholm("batch", "box.csv", "--command", "info", "-o", "done.csv", environment=place)
        self.assertEqual([path.name for path in temporary.iterdir()], ["rholm-batch-shapes"])


if __name__ == "__main__":
    main()
