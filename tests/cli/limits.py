"""A program run within limits: of processor time, which other work on the machine does not change,
and of memory in use."""

import os
import resource
import signal
import subprocess
import tempfile
import threading

SECONDS = 60
BYTES = 4 << 30


class Run:
    """code (negative: the signal it died of), out and err (bytes), seconds, memory (bytes), and
    exceeded: the limit it went beyond, if any."""

    def __init__(self, words, folder):
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            process = subprocess.Popen(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=out,
                                       stderr=err)
            try:
                # The soft limit ends it by a signal. Address space is mapped generously and not
                # used: twice the memory, so that a program that runs wild leaves the machine alive.
                # AddressSanitizer needs all of it.
                resource.prlimit(process.pid, resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))
                if "ASAN_OPTIONS" not in os.environ:
                    resource.prlimit(process.pid, resource.RLIMIT_AS, (2 * BYTES, 2 * BYTES))
            except ProcessLookupError:
                pass  # it is done already
            # One that waits for something uses no processor.
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
