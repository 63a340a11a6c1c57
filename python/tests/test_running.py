"""Running of computations: threads, progress, Ctrl-C, fork, several callers at once."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import rholm
from rholm import _run


def slow(progress=False, threads=0):
    """Works for some tenths of a second."""
    cloud = rholm.sample_surface(rholm.torus(2, 0.7, 200, 100), 8000, noise=1e-3)
    return rholm.reconstruct(cloud.points, progress=progress, threads=threads)


def long():
    """Works until it is stopped: minutes of a processor, for caps of degree 2 and a small error."""
    return rholm.compress(rholm.torus(2, 0.7, 384, 192), 1e-4, max_degree=2)


def test_results_are_the_same_bits_for_any_number_of_threads(bumpy, ring):
    expansions = [rholm.expand(bumpy, 24, threads=n).coeffs for n in (1, 2, 5)]
    assert np.array_equal(expansions[0], expansions[1])
    assert np.array_equal(expansions[0], expansions[2])
    cloud = rholm.sample_surface(ring, 5000)
    meshes = [rholm.reconstruct(cloud, threads=n).mesh.vertices for n in (1, 3)]
    assert np.array_equal(meshes[0], meshes[1])
    for wrong in (-1, 1.5, "2"):
        with pytest.raises((ValueError, TypeError)):
            rholm.expand(bumpy, 4, threads=wrong)


def test_progress_is_told_on_the_thread_that_called():
    seen = []
    here = threading.get_ident()
    slow(lambda stage, fraction: seen.append((stage, fraction, threading.get_ident())))
    assert seen
    assert all(thread == here for _, _, thread in seen)
    assert all(stage and 0 <= fraction <= 1 for stage, fraction, _ in seen)


def test_a_callable_stops_by_returning_false():
    with pytest.raises(rholm.CancelledError) as stop:
        slow(lambda stage, fraction: False)
    assert stop.value.code == "Cancelled"


def test_what_a_callable_raises_comes_through():
    def fail(stage: str, fraction: float) -> None:
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        slow(fail)


def test_only_callables_tell_progress(bumpy):
    with pytest.raises(TypeError):
        rholm.expand(bumpy, 4, progress="yes")


def test_a_bar_is_drawn_where_it_is_wanted(capsys):
    slow(True)
    assert "%" in capsys.readouterr().err
    slow(None)  # standard error is no terminal here
    assert capsys.readouterr().err == ""


def test_control_c_raises_keyboard_interrupt():
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        long()
    timer.join()
    assert rholm.expand(rholm.icosphere(2), 4).degree == 4  # further calls work


def test_functions_without_progress_look_at_signals():
    mesh = rholm.icosphere(7)
    rang = 0

    def ring(*_):
        nonlocal rang
        rang += 1

    old = signal.signal(signal.SIGALRM, ring)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.001, 0.001)
        most = 0
        while most < 10:  # a call without checks has one before it and one afterwards
            before = rang
            rholm.inspect(mesh)
            most = max(most, rang - before)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)


def test_handlers_of_other_signals_run_meanwhile():
    class AlarmError(Exception):
        pass

    def ring_alarm(*_):
        raise AlarmError

    old = signal.signal(signal.SIGALRM, ring_alarm)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with pytest.raises(AlarmError):
            long()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)


def test_other_threads_run_meanwhile():
    counted = 0
    done = threading.Event()

    def count():
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    most = 0
    while most < 20:  # counts while one call works; stays small if the call keeps the lock
        before = counted
        slow()
        most = max(most, counted - before)
    done.set()
    thread.join()


def test_four_threads_at_once_are_right(bumpy, ring, tmp_path):
    cloud = rholm.sample_surface(ring, 1000)

    def work(i: int):
        s = rholm.expand(bumpy, 20 + i % 3)
        s.save(tmp_path / f"{i}.h5")
        r = rholm.reconstruct(cloud)
        return s.coeffs, rholm.load(tmp_path / f"{i}.h5").coeffs, r.mesh.vertices

    alone = [work(i) for i in range(3)]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(work, range(12)))
    for i, (coeffs, loaded, vertices) in enumerate(together):
        assert np.array_equal(coeffs, alone[i % 3][0])
        assert np.array_equal(loaded, coeffs)
        assert np.array_equal(vertices, alone[0][2])


FORK = """
import os, sys, numpy as np, rholm
mesh = rholm.bumpy_sphere(4)
before = rholm.expand(mesh, 32, threads=2).coeffs if sys.argv[1] == "used" else None
child = os.fork()
if child == 0:
    after = rholm.expand(mesh, 32, threads=2).coeffs
    cloud = rholm.reconstruct(rholm.sample_surface(mesh, 1000), threads=2)
    os._exit(0 if before is None or np.array_equal(before, after) else 1)
_, status = os.waitpid(child, 0)
sys.exit(os.waitstatus_to_exitcode(status))
"""


@pytest.mark.parametrize("threads", ["used", "unused"])
def test_a_child_of_fork_computes_the_same(threads):
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", FORK, threads], timeout=1000, check=False)
    assert done.returncode == 0


def test_the_bar_is_full_when_the_work_is_done(monkeypatch, bumpy):
    import tqdm.auto

    bars = []

    class Bar:
        def __init__(self, total, **options):
            self.total, self.n = total, 0.0
            bars.append(self)

        def set_description_str(self, *args, **options): ...
        def update(self, n): ...
        def close(self):
            self.closed_at = self.n / self.total

    monkeypatch.setattr(tqdm.auto, "tqdm", Bar)
    with _run.reporter(True) as tell:
        tell("compare", 0.4)
        tell("compare", 0.99)
    with pytest.raises(rholm.InvalidInputError), _run.reporter(True) as tell:
        tell("compare", 0.5)
        raise rholm.InvalidInputError("stopped")
    assert [bar.closed_at for bar in bars] == [1.0, 0.5]
    rholm.compare(slow(threads=1).mesh, rholm.torus(2, 0.7, 60, 30), progress=True)
    assert all(bar.closed_at == 1.0 for bar in bars[2:])
