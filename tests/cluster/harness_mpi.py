"""Runs programs on several ranks as a user does, with either MPI. MPIEXEC names the program that starts
ranks."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from harness import NIGHTLY, held, main, nightly, nightly_too, rows_done, seconds_worked  # noqa: F401 (for the tests)

RHOLM = os.environ.get("RHOLM", "rholm")
RHOLM_MPI = os.environ.get("RHOLM_MPI", "rholm-mpi")
MPIEXEC = os.environ.get("MPIEXEC", "mpiexec")
# Seconds after which a run that hangs is ended. No result depends on the value.
TIMEOUT = 900
RANKS = (1, 2, 3, 4)
# Settings of Open MPI; MPICH reads none of them. Tests run more ranks than processors, as root, in a
# container. Waiting ranks must leave processors to the others. Ranks of one machine use the transports vader
# and self anyway; naming them avoids starting others, which takes a fifth of a run's processor time.
ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
               "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
               "OMPI_MCA_pml": "ob1", "OMPI_MCA_btl": "self,vader"}
# After a rank has failed, mpiexec waits a second before SIGTERM for the others and another before SIGKILL,
# even if all have ended. Ranks that end by themselves have nothing left to do when the first of them has
# ended.
NO_GRACE = {"OMPI_MCA_odls_base_sigkill_timeout": "0"}


class RanksRun:
    """A running program: the command `words` on n ranks in a folder."""

    def __init__(self, words, ranks, folder, wrap=(), environment=None):
        self.folder, self.ranks = Path(folder), ranks
        self.out, self.err = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        # mpiexec of Open MPI fails if another one has just made the folder that all runs of a user share.
        self.session = tempfile.TemporaryDirectory(prefix="mpi-", ignore_cleanup_errors=True)
        self.process = subprocess.Popen(
            [*wrap, MPIEXEC, "-n", str(ranks), *[str(w) for w in words]], cwd=folder, stdout=self.out,
            stderr=self.err, stdin=subprocess.DEVNULL, start_new_session=True,
            env={**os.environ, **ENVIRONMENT, "OMPI_MCA_orte_tmpdir_base": self.session.name,
                 **(environment or {})})
        self.program = os.path.basename(str(words[0]))

    def pids(self):
        """Returns the process ids of the ranks by number. They are found by their working folder."""
        found = {}
        for entry in Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                if (os.readlink(entry / "cwd") != str(self.folder)
                        or os.path.basename(os.readlink(entry / "exe")) != self.program):
                    continue
                variables = dict(v.split("=", 1) for v in
                                 (entry / "environ").read_bytes().decode(errors="replace").split("\0") if "=" in v)
            except OSError:
                continue
            rank = variables.get("OMPI_COMM_WORLD_RANK", variables.get("PMI_RANK"))
            if rank is not None:
                found[int(rank)] = int(entry.name)
        return found

    def until(self, is_true, what):
        """Waits for a state; the run must not end before it."""
        begin = time.monotonic()
        while not is_true():
            if self.process.poll() is not None or time.monotonic() - begin > TIMEOUT:
                self.kill()
                self.wait()
                raise AssertionError(f"not reached: {what}: {self}")
            time.sleep(0.005)

    def have_mapped(self, name):
        """Returns true if all ranks have mapped this file into memory."""
        pids = self.pids()
        try:
            return len(pids) == self.ranks and all(
                f"/{name}" in Path(f"/proc/{pid}/maps").read_text() for pid in pids.values())
        except OSError:
            return False

    def seconds_worked(self, rank):
        """Returns the processor time of a rank, or 0 if the rank does not exist."""
        try:
            return seconds_worked(self.pids()[rank])
        except (KeyError, OSError):
            return 0

    def kill(self):
        for pid in self.pids().values():
            os.kill(pid, signal.SIGKILL)
        self.process.kill()

    def wait(self, seconds=TIMEOUT):
        """Waits for the end and keeps the exit code; texts are in stdout and stderr. No process is left
        running: mpiexec may end before ranks that it has killed, and these still write until they
        notice."""
        begin = time.monotonic()
        try:
            self.code = self.process.wait(seconds)
            while self.pids():
                if time.monotonic() - begin > seconds:
                    raise subprocess.TimeoutExpired(self.program, seconds)
                time.sleep(0.01)
        except subprocess.TimeoutExpired:
            self.kill()
            self.process.wait()
            raise
        finally:
            for stream, name in ((self.out, "stdout"), (self.err, "stderr")):
                stream.seek(0)
                setattr(self, name, stream.read().decode("utf-8", "replace"))
                stream.close()
            self.session.cleanup()
        return self.code

    def __str__(self):
        return f"-> {self.code}\n{self.stdout[-2000:]}\n{self.stderr[-3000:]}"


class MpiTest(unittest.TestCase):
    """Each test has its own empty folder, self.folder, in which ranks run."""

    def setUp(self):
        self.all = Path(os.path.realpath(tempfile.mkdtemp(prefix="rholm-mpi-test-")))
        self.addCleanup(shutil.rmtree, self.all)
        self.own = threading.local()  # the folder of each thread
        self.own.folder = self.all / "test"
        self.folder.mkdir()

    @property
    def folder(self):
        return self.own.folder

    def at_once(self, check, *cases):
        """Calls check(*case) for all cases at the same time, each in a copy of the folder. It suits runs
        that mostly wait."""
        given = self.folder

        def one(number, case):
            self.own.folder = self.all / f"case-{number}"
            shutil.copytree(given, self.folder)
            check(*case)

        with ThreadPoolExecutor(len(cases)) as pool:
            for done in [pool.submit(one, *numbered) for numbered in enumerate(cases)]:
                done.result()

    def start(self, *words, ranks, **options):
        return RanksRun(words, ranks, self.folder, **options)

    def apart(self, program, *words, ranks, **options):
        """Runs rank r in the folder r, so that ranks may have different files of the same name."""
        script = 'cd "${OMPI_COMM_WORLD_RANK:-$PMI_RANK}" && exec "$@"'
        return self.finished("sh", "-c", script, "sh", program, *words, ranks=ranks, **options)

    def errors(self, run):
        """Returns the error messages of a program of ours."""
        return [line for line in run.stderr.splitlines() if line.startswith("rholm") and ": error:" in line]

    def finished(self, *words, ranks, seconds=TIMEOUT, **options):
        """Returns a finished run whose ranks end by themselves."""
        run = self.start(*words, ranks=ranks, environment=NO_GRACE, **options)
        run.wait(seconds)
        return run


class ProgramTest(MpiTest):
    """Compares rholm-mpi with rholm, which runs alone."""

    def rholm(self, *words, code=0):
        run = subprocess.run([RHOLM, *[str(w) for w in words]], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(run.returncode, code, run)
        return run

    def make(self, name, shape="bumpy", *words):
        self.rholm("make", shape, *words, "--quiet", "-o", name)

    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def exchanged(self, *words, ranks=2):
        """Returns the number of bytes that ranks have sent to each other."""
        run = self.finished(RHOLM_MPI, *words, "--timings", ranks=ranks)
        self.assertEqual(run.code, 0, run)
        return 1e6 * float(run.stderr.split(" MB in ")[0].split()[-1])
