"""Runs a program within limits of memory in use and of processor time, which other work on the machine does
not change."""

import os
import resource
import signal
import subprocess
import tempfile
import threading

SECONDS = 60
BYTES = 4 << 30


class Run:
    """A finished run. `code` is the exit code, or the negative number of the signal. `out` and `err` are
    bytes, `memory` is in bytes. `exceeded` is the name of the exceeded limit, if any."""

    def __init__(self, words, folder):
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            process = subprocess.Popen(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=out,
                                       stderr=err)
            try:
                # The soft limit ends the program by a signal. The limit of address space is twice the
                # memory, because programs map more than they use. It protects the machine if a program uses
                # memory without bound. AddressSanitizer needs all address space.
                resource.prlimit(process.pid, resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))
                if "ASAN_OPTIONS" not in os.environ:
                    resource.prlimit(process.pid, resource.RLIMIT_AS, (2 * BYTES, 2 * BYTES))
            except ProcessLookupError:
                pass  # the process has already ended
            # A process that waits uses no processor time.
            watch = threading.Timer(20 * SECONDS, process.kill)
            watch.start()
            _, status, usage = os.wait4(process.pid, 0)
            watch.cancel()
            process.returncode = self.code = os.waitstatus_to_exitcode(status)
            out.seek(0)
            err.seek(0)
            self.out, self.err = out.read(), err.read()
        self.seconds = usage.ru_utime + usage.ru_stime
        self.memory = usage.ru_maxrss * 1024
        self.exceeded = None
        if self.code in (-signal.SIGXCPU, -signal.SIGKILL) or self.seconds > SECONDS:
            self.exceeded = f"more than {SECONDS} s"
        elif self.memory > BYTES:
            self.exceeded = f"{self.memory / 2**30:.1f} GiB"
