"""Ctrl-C during every long command: exit code 130, the old file unchanged, no temporary files."""

import os
import re
import signal
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import (NIGHTLY, CliTest, RHOLM, TIMEOUT, answers_signals, held, main, nightly_too, status_of, until,
                     until_working)

OLD = b"what was here before\n"


def bytes_written(pid):
    """Returns the number of bytes written by all calls; infinity after the process has ended."""
    try:
        with open(f"/proc/{pid}/io") as counts:
            return next(int(line.split()[1]) for line in counts if line.startswith("wchar:"))
    except OSError:
        return float("inf")


class Interrupt(CliTest):
    def interrupted(self, *words, sign=signal.SIGINT, times=1, stdin=None):
        """Starts rholm, sends the signal once it computes (or waits for its input), returns the finished
        process."""
        process = subprocess.Popen([RHOLM, *map(str, words)], cwd=self.folder, stdin=stdin,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        if stdin is None:
            until_working(process)
        else:
            until(lambda: answers_signals(process.pid, sign), "it answers the signal", process)
        for _ in range(times):
            process.send_signal(sign)  # without effect if the first signal has ended it
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

    def test_expand(self):
        self.rholm("make", "bumpy", "--subdivisions", "6", "-o", "b.ply")
        # 82 000 faces at degree 1000 by direct sums take minutes of processor time.
        self.check_interrupted("b.h5", "expand", "b.ply", "--degree", "1000", "--engine", "direct")

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
        for words in (["info", "a.ply"], ["expand", "a.ply", "--degree", "4", "-o", "a.h5"],
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
        # SIGKILL cannot be handled: a temporary file may remain. The name belongs to the old file, or to the
        # new one if it had just been replaced.
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


# Commands of the test of questions: words, where {} is "small" or "large" and {n} a number; and the output
# (none for a report). The large input has at least 16 times the work of the small one.
LONG = (
    ("info {}.ply", None),
    ("repair {}.ply -o out.ply", "out.ply"),
    ("simplify {}.ply --faces 10% -o out.ply", "out.ply"),
    ("center {}.ply", None),
    ("expand {}.ply --degree 16 -o out.h5", "out.h5"),
    ("expand {}.off --degree 16 --method area -o out.sh", "out.sh"),
    ("compress {}.ply --tolerance 5e-3 -o out.h5", "out.h5"),
    ("synthesize {}.h5 --subdivisions 6 -o out.ply", "out.ply"),
    ("spectrum {}.sh", None),
    ("compare {}.ply {}.off --samples {n}", None),
    ("convert {}.ply out.obj", "out.obj"),
    ("convert {}.sh out.gfc", "out.gfc"),
    ("convert {}.sh out.json", "out.json"),
    ("convert {}.sh out.npy", "out.npy"),
    ("render {}.ply --size {side}x{side} -o out.png", "out.png"),
    ("report {}.h5 --size 64 -o out.html", "out.html"),
    ("make sample {}.ply --points {n} -o out.ply", "out.ply"),
    ("filter {}.sh --low-pass 8 -o out.sh", "out.sh"),
    ("recenter {}.h5 --center 0.02,0,0 -o out.h5", "out.h5"),
    ("rotate {}.h5 --axis 1,2,3 --angle 20 -o out.h5", "out.h5"),
    ("align {}.h5 {}.h5 -o out.h5", "out.h5"),
    ("smooth {}.ply --region ball:1,0,0,0.6 --wavelength 0.3 -o out.ply", "out.ply"),
    ("transfer --from {}.ply --from-region ball:1,0,0,0.4 --to {}.ply --to-region ball:0,1,0,0.4 -o out.ply",
     "out.ply"),
    ("orient {}.xyz -o out.ply", "out.ply"),
    ("partition {}.ply --tolerance 5e-3 -o out.ply", "out.ply"),
    ("reconstruct {}.xyz -o out.ply", "out.ply"),
    ("batch {}.csv --command info -o out.csv", "out.csv"),
)
SIZES = {"small": {"subdivisions": 4, "degree": 32, "points": 2000, "n": 20000, "side": 128, "lines": 32},
         "large": {"subdivisions": 6, "degree": 256, "points": 40000, "n": 640000, "side": 1024, "lines": 700}}
# Files that are left intentionally: finished rows of a batch, from which it can be continued.
LEFT = {"out.csv.journal"}
# These commands compute nothing, or ask for each request (tests of the studio).
NO_WORK = {"completion", "studio"}


class Questions(CliTest):
    """Every command asks repeatedly whether to stop; the number of questions grows with the work."""

    def questions(self, words, at=None):
        """Runs on one thread, interrupted at question `at` if given; returns the result and the number of
        questions."""
        environment = {"RHOLM_TEST_QUESTIONS": str(self.folder / "questions")}
        if at is not None:
            environment["RHOLM_TEST_INTERRUPT_AT"] = str(at)
        run = subprocess.run([os.environ["RHOLM_FORCED"], *words, "--threads", "1"], cwd=self.folder,
                             capture_output=True, env={**os.environ, **environment}, timeout=TIMEOUT)
        count = int((self.folder / "questions").read_text())
        (self.folder / "questions").unlink()
        return run, count

    def make_inputs(self):
        for size, of in SIZES.items():
            self.rholm("make", "bumpy", "--subdivisions", of["subdivisions"], "-o", f"{size}.ply")
            self.rholm("convert", f"{size}.ply", f"{size}.off")
            self.rholm("make", "sample", f"{size}.ply", "--points", of["points"], "--no-normals", "-o", f"{size}.xyz")
            self.rholm("expand", f"{size}.ply", "--degree", of["degree"], "--no-errors", "-o", f"{size}.h5")
            self.write(f"{size}.sh", "0 0 1 0\n" + "".join(f"{l} {m} 1e-7 0\n" for l in range(1, of["lines"] + 1)
                                                         for m in range(l + 1)))
            rows = "".join(f"{i},{size}.ply\n" for i in range(2 if size == "small" else 8))
            self.write(f"{size}.csv", "id,path\n" + rows)

    def test_all_commands_are_here(self):
        text = self.rholm("--help").out
        commands = re.findall(r"^  (\w+) {2,}", text.partition("Commands:")[2].partition("Exit codes")[0], re.M)
        self.assertEqual(set(commands) - NO_WORK, {words.split()[0] for words, _ in LONG})

    @nightly_too
    def test_commands_ask_while_they_work(self):
        self.make_inputs()
        for words, output in LONG if NIGHTLY else LONG[::9]:
            with self.subTest(words):
                self.check_questions(words, output)

    def check_questions(self, words, output):
        counts = []
        for size, of in SIZES.items():
            full = words.replace("{}", size).format(**of).split()
            run, n = self.questions(full)
            self.assertEqual(run.returncode, 0, run.stderr)
            counts.append(n)
        # A command that asks only between its steps would ask as often for a large input.
        self.assertGreaterEqual(counts[1], 1.25 * counts[0], "questions of little and of much work")
        if output:
            self.write(output, OLD)
        before = self.files()
        for at in sorted({1, counts[1] // 4, counts[1] // 2, 3 * counts[1] // 4}):
            run, n = self.questions(full, at)
            self.assertEqual(run.returncode, 130, (at, counts, run.stderr))
            self.assertIn(b"interrupted", run.stderr)
            self.assertEqual(run.stdout, b"")
            # Other threads may have asked before they noticed.
            self.assertLessEqual(n, at + 2, (at, counts))
            for name in LEFT & set(self.files()):
                (self.folder / name).unlink()
            self.assertEqual(self.files(), before, "litter was left")
            if output:
                self.check_old_file_is_whole(output)

    def check_old_file_is_whole(self, name):
        self.assertEqual((self.folder / name).read_bytes(), OLD)


if __name__ == "__main__":
    main()
