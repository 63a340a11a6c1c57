"""Runs the program rholm as a user does: real processes and real files, each test in its own folder."""

import json
import os
import pty
import re
import select
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import times

# RHOLM_TEST_TARGET names an instruction set. The program itself ignores the variable; a program built for
# the tests reads it.
if "RHOLM_TEST_TARGET" in os.environ:
    if "RHOLM_FORCED" not in os.environ:
        sys.exit("RHOLM_TEST_TARGET is set, and RHOLM_FORCED does not name the program of the tests "
                 "(tests/cli/forced/rholm of the build)")
    os.environ["RHOLM"] = os.environ["RHOLM_FORCED"]
RHOLM = os.environ.get("RHOLM", "rholm")
SOURCE = Path(__file__).resolve().parents[2]

# True if the program was built with `rholm studio` (RHOLM_BUILD_STUDIO).
STUDIO = os.environ.get("RHOLM_TEST_STUDIO", "1") == "1"
# True if the program has the paper's patches (RHOLM_QHULL).
QHULL = os.environ.get("RHOLM_TEST_QHULL", "1") == "1"

# Seconds after which a run that hangs is ended. No result depends on the value; slow machines and builds set
# the factor.
SLOWNESS = float(os.environ.get("RHOLM_TEST_SLOWNESS", "1"))
TIMEOUT = 120 * SLOWNESS
HELD_RENAME = os.environ.get("HELD_RENAME", "held_rename.so")


class Result:
    """Exit code, standard output and standard error (as text) of a finished run."""

    def __init__(self, process, words, name="rholm"):
        self.words = [name, *words]
        self.code = process.returncode
        self.bytes = process.stdout
        self.out = process.stdout.decode("utf-8", "replace")
        self.err = process.stderr.decode("utf-8", "replace")

    def json(self):
        # NaN and Infinity are not JSON, although Python accepts them.
        def refuse(name):
            raise ValueError(f"{name} in the report of {self}")
        return json.loads(self.out, parse_constant=refuse)

    def __str__(self):
        return f"{' '.join(self.words)}\n-> {self.code}\n{self.out[-2000:]}\n{self.err[-2000:]}"


def until(is_true, what, process=None):
    """Waits for a state. If `process` is given, it must not end earlier."""
    end = time.monotonic() + TIMEOUT
    while not is_true():
        if process is not None and process.poll() is not None:
            raise AssertionError(f"the program ended with {process.returncode} before {what}")
        if time.monotonic() > end:
            raise AssertionError(f"not reached: {what}")
        time.sleep(0.005)


def status_of(pid, name):
    """Returns the text after a name in /proc/pid/status."""
    text = Path(f"/proc/{pid}/status").read_text()
    return re.search(rf"^{name}:\s*(.*)$", text, re.M)[1]


def answers_signals(pid, number=signal.SIGINT):
    """Returns true once a program handles this signal itself."""
    return int(status_of(pid, "SigCgt"), 16) >> (number - 1) & 1 == 1


def seconds_worked(pid):
    """Returns the processor time of a program, in seconds; it grows only while the program does not wait."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def until_working(process, number=signal.SIGINT):
    """Waits until a program handles the signal and computes."""
    until(lambda: answers_signals(process.pid, number), "it answers signals", process)
    begin = seconds_worked(process.pid)
    until(lambda: seconds_worked(process.pid) > begin + 0.1, "it computes", process)


def rows_done(path):
    """Returns the number of rows in the journal of a batch: a head, then for each row its size, a checksum,
    the bytes."""
    data, at, n = path.read_bytes() if path.exists() else b"", 28, 0
    while at + 16 <= len(data):
        at += 8 + int.from_bytes(data[at:at + 4], "little")
        n += at <= len(data)
    return n


def held(mark, letters, after=0):
    """Returns an environment in which a program waits for ever before it gives a file its name. The path of
    the file contains `letters` (at its end, if '$' follows them), and its folder has `after` entries.
    The program makes the file `mark` first."""
    return {"LD_PRELOAD": HELD_RENAME, "ASAN_OPTIONS": "verify_asan_link_order=0", "RHOLM_TEST_HELD": str(mark),
            "RHOLM_TEST_HOLD": letters, "RHOLM_TEST_AFTER": str(after)}


class CliTest(unittest.TestCase):
    """Each test has an empty folder, self.folder, in which rholm runs."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rholm-test-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_rholm(self, *words, stdin=b"", environment=None):
        words = [str(word) for word in words]
        process = subprocess.run([RHOLM, *words], input=stdin, capture_output=True,
                                 cwd=self.folder, timeout=TIMEOUT,
                                 env={**os.environ, **(environment or {})})
        return Result(process, words)

    def rholm(self, *words, code=0, **options):
        """Runs the program; checks the exit code, and that there is one clear message if it is not 0."""
        result = self.run_rholm(*words, **options)
        self.assertEqual(result.code, code, f"wanted exit code {code}:\n{result}")
        self.check_decent(result)
        return result

    def check_decent(self, result):
        """Checks properties of every run: no NaN, no crash, exactly one clear error."""
        # An error may quote the NaN of the input; no other output may contain one. Binary files may contain
        # these bytes by chance.
        out = "" if b"\0" in result.bytes else result.out
        said = out + (result.err if result.code == 0 else "")
        self.assertNotRegex(said, re.compile(r"\bnan\b", re.I), str(result))
        self.assertGreaterEqual(result.code, 0, f"died of a signal: {result}")
        errors = [line for line in result.err.splitlines() if line.startswith(f"{result.words[0]}: error:")]
        if result.code in (1, 2, 4):
            self.assertEqual(len(errors), 1, str(result))
        self.assertLessEqual(len(errors), 1, str(result))
        self.assertNotIn("terminate called", result.err, str(result))
        self.assertNotIn("runtime error:", result.err, str(result))

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())


class Terminal:
    """An interactive program on a pseudo-terminal."""

    def __init__(self, words, folder, environment):
        try:
            self.pid, self.master = pty.fork()
        except OSError as error:
            raise unittest.SkipTest(f"no pseudo-terminal on this machine: {error}") from error
        if self.pid == 0:
            os.chdir(folder)
            os.execvpe(words[0], words, {**os.environ, "TERM": "xterm", **environment})

    def send(self, text):
        os.write(self.master, text.encode())

    def read_raw(self, wanted=("\0",), seconds=TIMEOUT):
        """Returns output until it contains all of `wanted`, the program ends, or the time is over."""
        text, end = "", time.monotonic() + seconds
        while time.monotonic() < end and not all(word in plain(text) for word in wanted):
            if select.select([self.master], [], [], 0.1)[0]:
                try:
                    text += os.read(self.master, 65536).decode("utf-8", "replace")
                except OSError:  # the program has closed its end
                    break
        return text

    def read(self, wanted, seconds=TIMEOUT):
        return plain(self.read_raw(wanted, seconds))

    def close(self):
        os.close(self.master)
        os.kill(self.pid, 9)
        os.waitpid(self.pid, 0)


def plain(text):
    """Returns text without the escape sequences of a terminal."""
    return re.sub(r"\x1b\[[0-9;?]*[A-Za-z]|\x07|\x08", "", text)


def off(vertices, faces):
    """Returns an OFF file."""
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
    lines += [" ".join(str(x) for x in v) for v in vertices]
    lines += [f"{len(f)} " + " ".join(str(i) for i in f) for f in faces]
    return "\n".join(lines) + "\n"


OCTAHEDRON = ([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)],
              [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5),
               (0, 3, 5)])


def scaled(mesh, factor):
    return [tuple(factor * x for x in v) for v in mesh[0]], mesh[1]


def binary_stl(mesh):
    """Returns an STL file: every triangle has its own corners, which are shared only after welding."""
    vertices, faces = mesh
    text = b"\0" * 80 + struct.pack("<I", len(faces))
    for face in faces:
        text += struct.pack("<12fH", 0, 0, 0, *[x for i in face for x in vertices[i]], 0)
    return text


def nightly(case):
    """Marks a case, or a class of cases, for nightly runs only. CMake makes a test cli.NAME_nightly of the
    marked cases of a script (docs/testing.md)."""
    case.nightly = True
    return case


# True if cases with two sizes take the larger one: in nightly runs, and in runs of all cases.
NIGHTLY = not {"--nightly", "--every"}.isdisjoint(sys.argv)


def nightly_too(case):
    """Marks a case that asks NIGHTLY for its size: it is among the fast ones and, in full size, among the nightly ones."""
    case.two_sizes = True
    return case


class Loader(unittest.TestLoader):
    """Loads cases that are (not) nightly, or all (None). A case given by name is always loaded."""

    def __init__(self, wanted):
        super().__init__()
        self.wanted = wanted

    def getTestCaseNames(self, case_class):
        def is_wanted(name):
            case = getattr(case_class, name)
            is_nightly = getattr(case_class, "nightly", False) or getattr(case, "nightly", False)
            return self.wanted in (None, is_nightly) or getattr(case, "two_sizes", False)
        return [name for name in super().getTestCaseNames(case_class) if is_wanted(name)]


def main():
    """Runs the cases of a script: marked cases with --nightly, all with --every, otherwise the unmarked
    cases."""
    wanted = False
    for option, cases in (("--nightly", True), ("--every", None)):
        if option in sys.argv:
            sys.argv.remove(option)
            wanted = cases
    if "RHOLM_TEST_TARGET" in os.environ:
        print("instruction set:", os.environ["RHOLM_TEST_TARGET"], "(forced)", file=sys.stderr)
    times.main(verbosity=2, testLoader=Loader(wanted))
