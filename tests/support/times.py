"""Processor time of tests, for scripts/test-times: each test adds a line to the file that RHOLM_TEST_TIMES names, if
it names one. A line has the seconds, the group of the test and its name, between tabs; main.cpp writes the same."""

import os
import resource
import sys
import unittest
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]


def spent():
    """Processor time of this process, its threads and the processes that it has waited for."""
    return sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def note(seconds, group, name):
    if "RHOLM_TEST_TIMES" in os.environ:
        # Many processes write at once: one line is one call, at the end of the file.
        file = os.open(os.environ["RHOLM_TEST_TIMES"], os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o644)
        try:
            os.write(file, f"{seconds:.4f}\t{group}\t{name}\n".encode())
        finally:
            os.close(file)


class Result(unittest.TextTestResult):
    """Notes each test, and what a process takes besides: the start of Python and what classes share."""

    noted = 0.0

    def startTest(self, test):
        self.before = spent()
        super().startTest(test)

    def stopTest(self, test):
        super().stopTest(test)
        seconds = spent() - self.before
        self.noted += seconds
        note(seconds, group(), test.id().removeprefix("__main__."))

    def stopTestRun(self):
        super().stopTestRun()
        note(spent() - self.noted, group(), "(start)")


def group():
    """The script that runs, from tests/ on, without its ending: cli/atlas."""
    return str(Path(sys.argv[0]).resolve().relative_to(TESTS)).removesuffix("_test.py")


class Runner(unittest.TextTestRunner):
    resultclass = Result


def main(**options):
    """unittest.main() that notes."""
    unittest.main(testRunner=Runner, **options)
