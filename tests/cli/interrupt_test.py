"""Ctrl-C in the middle of every long command: exit code 130, the old file whole, no litter."""

import os
import signal
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import (CliTest, RHOLM, TIMEOUT, answers_signals, held, main, status_of, until,
                     until_working)

OLD = b"what was here before\n"


def bytes_written(pid):
    """By all its calls; what has ended has written all."""
    try:
        with open(f"/proc/{pid}/io") as counts:
            return next(int(line.split()[1]) for line in counts if line.startswith("wchar:"))
    except OSError:
        return float("inf")


class Interrupt(CliTest):
    def interrupted(self, *words, sign=signal.SIGINT, times=1, stdin=None):
        """Starts rholm, sends the signal once it computes (or waits for its input), returns the finished process."""
        process = subprocess.Popen([RHOLM, *map(str, words)], cwd=self.folder, stdin=stdin,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        if stdin is None:
            until_working(process)
        else:
            until(lambda: answers_signals(process.pid, sign), "it answers the signal", process)
        for _ in range(times):
            process.send_signal(sign)  # nothing, if the one before has ended it
            until(lambda: process.poll() is not None or self.has_taken(process, sign), "it has got the signal")
        process.out, process.err = process.communicate(timeout=TIMEOUT)
        return process

    @staticmethod
    def has_taken(process, sign):
        return int(status_of(process.pid, "ShdPnd"), 16) >> (sign - 1) & 1 == 0

    def check_old_file_is_whole(self, name):
        self.assertEqual((self.folder / name).read_bytes(), OLD)

    def check_interrupted(self, output, *words):
        self.write(output, OLD)
        before = self.files()
        process = self.interrupted(*words, "-o", output)
        self.assertEqual(process.returncode, 130, (words, process.err))
        self.assertIn(b"interrupted", process.err)
        self.assertEqual(process.out, b"")
        self.assertEqual(self.files(), before, "litter was left")
        self.check_old_file_is_whole(output)

    def test_analyze(self):
        self.rholm("make", "bumpy", "--subdivisions", "6", "-o", "b.ply")
        # 82 000 faces at degree 1000 by direct sums: minutes of a processor.
        self.check_interrupted("b.h5", "analyze", "b.ply", "--degree", "1000", "--engine", "direct")

    def test_synthesize_and_render(self):
        self.rholm("make", "box", "-o", "b.ply")
        self.write("b.sh", "0 0 1 0\n1000 3 1e-6 0\n")
        self.check_interrupted("b.obj", "synthesize", "b.sh", "--subdivisions", "8")
        self.check_interrupted("b.png", "render", "b.ply", "--size", "12000x12000")

    def test_waiting_for_standard_input(self):
        process = self.interrupted("info", "-", stdin=subprocess.PIPE)
        self.assertEqual(process.returncode, 130)

    def test_waiting_for_the_writer_of_a_named_pipe(self):
        os.mkfifo(self.folder / "a.ply")
        self.write("shapes.csv", "path\na.ply\n")
        for words in (["info", "a.ply"], ["analyze", "a.ply", "--degree", "4", "-o", "a.h5"],
                      ["reconstruct", "a.ply", "-o", "o.ply"],
                      ["batch", "shapes.csv", "--command", "info", "-o", "o.csv"]):
            process = self.interrupted(*words, stdin=subprocess.DEVNULL)
            self.assertEqual(process.returncode, 130, (words, process.err))

    def test_termination_is_answered_likewise(self):
        process = self.interrupted("info", "-", sign=signal.SIGTERM, stdin=subprocess.PIPE)
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)

    def test_second_signal_leaves_at_once_and_clean(self):
        self.rholm("make", "box", "-o", "b.ply")
        self.write("b.png", OLD)
        before = self.files()
        process = self.interrupted("render", "b.ply", "--size", "12000x12000", "-o", "b.png",
                                   times=2)
        self.assertEqual(process.returncode, 130)
        self.assertEqual(self.files(), before)
        self.check_old_file_is_whole("b.png")

    def test_killed_while_it_writes_leaves_a_whole_file(self):
        # SIGKILL cannot be answered: a temporary file may stay, and what has the name is the old
        # file or, if it had just been replaced, the new one.
        self.write("s.obj", OLD)
        mark = self.folder / "mark"
        process = subprocess.Popen([RHOLM, "make", "sphere", "--subdivisions", "6", "-o", "s.obj"], cwd=self.folder,
                                   env={**os.environ, **held(mark, "s.obj$")})
        until(mark.exists, "the new file is complete", process)
        self.check_old_file_is_whole("s.obj")
        process.kill()
        process.wait()
        self.check_old_file_is_whole("s.obj")

    def test_killed_at_any_byte_it_leaves_a_whole_file(self):
        words = [RHOLM, "make", "sphere", "--subdivisions", "7", "-o"]
        subprocess.run([*words, "new.obj"], cwd=self.folder, check=True)
        new = (self.folder / "new.obj").read_bytes()
        for written in (0, 1, 1000000, len(new) // 2):
            self.write("s.obj", OLD)
            process = subprocess.Popen([*words, "s.obj"], cwd=self.folder)
            until(lambda: process.poll() is not None or bytes_written(process.pid) >= written, "it writes")
            process.kill()
            process.wait()
            self.assertIn((self.folder / "s.obj").read_bytes(), (OLD, new))

    def test_reader_that_goes_away_is_no_error_message(self):
        process = subprocess.run(f'"{RHOLM}" make sphere --subdivisions 7 --format obj -o - | head -1',
                                 shell=True, capture_output=True, timeout=TIMEOUT)
        self.assertNotIn(b"terminate", process.stderr)
        self.assertNotIn(b"error", process.stderr)


if __name__ == "__main__":
    main()
