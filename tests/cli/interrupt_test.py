"""Ctrl-C in the middle of every long command: exit code 130, the old file whole, no litter."""

import os
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, RHOLM, SLOWNESS, TIMEOUT, main

OLD = b"what was here before\n"


class Interrupt(CliTest):
    def interrupted(self, *words, after=0.3, sign=signal.SIGINT, times=1, gap=0.0, stdin=None):
        """Starts rholm, sends the signal, returns the finished process."""
        process = subprocess.Popen([RHOLM, *map(str, words)], cwd=self.folder, stdin=stdin,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        time.sleep(after)
        self.assertIsNone(process.poll(), f"{words} finished before it could be interrupted")
        for _ in range(times):
            process.send_signal(sign)
            time.sleep(gap)
        process.out, process.err = process.communicate(timeout=TIMEOUT)
        return process

    def check_old_file_is_whole(self, name):
        self.assertEqual((self.folder / name).read_bytes(), OLD)

    def check_interrupted(self, output, *words):
        self.write(output, OLD)
        before = self.files()
        begin = time.monotonic()
        process = self.interrupted(*words, "-o", output)
        self.assertEqual(process.returncode, 130, (words, process.err))
        self.assertIn(b"interrupted", process.err)
        self.assertEqual(process.out, b"")
        self.assertEqual(self.files(), before, "litter was left")
        self.check_old_file_is_whole(output)
        return time.monotonic() - begin

    def test_analyze(self):
        self.rholm("make", "bumpy", "--subdivisions", "6", "-o", "b.ply")
        # 82 000 faces at degree 1000 by direct sums: minutes.
        seconds = self.check_interrupted("b.h5", "analyze", "b.ply", "--degree", "1000")
        self.assertLess(seconds, 20 * SLOWNESS, "the library looks too seldom whether to stop")

    def test_synthesize_and_render(self):
        self.rholm("make", "box", "-o", "b.ply")
        self.write("b.sh", "0 0 1 0\n1000 3 1e-6 0\n")
        self.check_interrupted("b.obj", "synthesize", "b.sh", "--subdivisions", "8")
        self.check_interrupted("b.png", "render", "b.ply", "--size", "12000x12000")

    def test_waiting_for_standard_input(self):
        process = self.interrupted("info", "-", stdin=subprocess.PIPE)
        self.assertEqual(process.returncode, 130)

    def test_termination_is_answered_likewise(self):
        process = self.interrupted("info", "-", sign=signal.SIGTERM, stdin=subprocess.PIPE)
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)

    def test_second_signal_leaves_at_once_and_clean(self):
        self.rholm("make", "box", "-o", "b.ply")
        self.write("b.png", OLD)
        before = self.files()
        process = self.interrupted("render", "b.ply", "--size", "12000x12000", "-o", "b.png",
                                   times=2, gap=0.01)
        self.assertEqual(process.returncode, 130)
        self.assertEqual(self.files(), before)
        self.check_old_file_is_whole("b.png")

    def test_killed_while_it_writes_leaves_a_whole_file(self):
        # SIGKILL cannot be answered: a temporary file may stay, and what has the name is the old
        # file or, if it had just been replaced, the new one.
        words = [RHOLM, "make", "sphere", "--subdivisions", "8", "-o"]
        subprocess.run([*words, "new.obj"], cwd=self.folder, check=True)
        new = (self.folder / "new.obj").read_bytes()
        self.write("s.obj", OLD)
        survived = 0
        for after in (0.02, 0.05, 0.1, 0.2, 0.4):
            process = subprocess.Popen([*words, "s.obj"], cwd=self.folder)
            time.sleep(after)
            process.kill()
            process.wait()
            found = (self.folder / "s.obj").read_bytes()
            self.assertTrue(found in (OLD, new), f"{len(found)} bytes of {len(new)}")
            survived += found == OLD
            self.write("s.obj", OLD)
        self.assertGreater(survived, 0, "never killed before it was done")

    def test_reader_that_goes_away_is_no_error_message(self):
        process = subprocess.run(f'"{RHOLM}" make sphere --subdivisions 7 --format obj -o - | head -1',
                                 shell=True, capture_output=True, timeout=TIMEOUT)
        self.assertNotIn(b"terminate", process.stderr)
        self.assertNotIn(b"error", process.stderr)


if __name__ == "__main__":
    main()
