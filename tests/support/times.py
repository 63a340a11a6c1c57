"""Notes processor time and duration of tests for scripts/test-times. Each test adds a line to the file that
RHOLM_TEST_TIMES names, if the variable is set. A line has the two times in seconds, the group of the
test and its name, separated by tabs. main.cpp writes the same format."""

import os
import resource
import sys
import time
import unittest
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]


STARTED = time.monotonic()


def spent():
    """Returns two times in seconds. The first is the processor time of this process, its threads and the
    processes that it has waited for. The second is the time since this file was read."""
    used = sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return used, time.monotonic() - STARTED


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def plus(a, b):
    return tuple(x + y for x, y in zip(a, b))


def note(seconds, group, name):
    """Appends the line of one test. `seconds` is a difference of two results of spent()."""
    if "RHOLM_TEST_TIMES" in os.environ:
        # Many processes append at once: each line is written by one call.
        file = os.open(os.environ["RHOLM_TEST_TIMES"], os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o644)
        try:
            os.write(file, "{:.4f}\t{:.4f}\t{}\t{}\n".format(*seconds, group, name).encode())
        finally:
            os.close(file)


class Result(unittest.TextTestResult):
    """Notes the times of each test, and of the process besides: start of Python, shared set-up of
    classes."""

    noted = (0.0, 0.0)

    def startTest(self, test):
        self.before = spent()
        super().startTest(test)

    def stopTest(self, test):
        super().stopTest(test)
        seconds = minus(spent(), self.before)
        self.noted = plus(self.noted, seconds)
        note(seconds, group(), test.id().removeprefix("__main__."))

    def stopTestRun(self):
        super().stopTestRun()
        note(minus(spent(), self.noted), group(), "(start)")


def group():
    """Returns the running script relative to tests/, without its ending, for example cli/atlas."""
    return str(Path(sys.argv[0]).resolve().relative_to(TESTS)).removesuffix("_test.py")


class Runner(unittest.TextTestRunner):
    resultclass = Result


def main(**options):
    """Runs unittest.main() with a runner that notes times."""
    unittest.main(testRunner=Runner, **options)
