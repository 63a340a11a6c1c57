"""Measures the time from Ctrl-C to KeyboardInterrupt, at random moments of long computations.

    PYTHONPATH=build/release/python python bench/python/interrupt.py [--signals N] [--threads N] [NAME...]

Prints for each computation its duration, and the median and the largest delay in milliseconds.
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import statistics
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import rholm


def computations() -> dict[str, Callable[[dict[str, Any]], Any]]:
    """Prepares the computations that are interrupted."""
    body = rholm.bumpy_sphere(8)
    ring = rholm.torus(2, 0.7, 400, 200)
    cloud = rholm.sample_surface(ring, 300_000, noise=1e-3)
    plain = rholm.expand(body, 200, rays=0, errors=False)
    fine = rholm.expand(rholm.bumpy_sphere(5), 30).mesh(7)
    chart = rholm.harmonics.make_star_chart(rholm.bumpy_sphere(5))
    directions = np.random.default_rng(1).normal(size=(3_000_000, 3))
    return {
        "expand 1.3M triangles to 400": lambda how: rholm.expand(body, 400, **how),
        "expand to a tolerance": lambda how: rholm.expand(body, tolerance=1e-6, unit="diagonal", **how),
        "expand by direct sums": lambda how: rholm.expand(chart.mesh, 200, engine="direct", **how),
        "monte_carlo": lambda how: rholm.harmonics.monte_carlo(chart, 64, samples=256, **how),
        "evaluate 3M directions": lambda how: rholm.harmonics.evaluate(plain, directions, **how),
        "rotate degree 1000": lambda how: plain.truncate(1000).rotate(
            rholm.rotation_about((1, 2, 3), 1), **how
        ),
        "align": lambda how: rholm.align(plain, plain.rotate(rholm.rotation_about((1, 2, 3), 1)), **how),
        "reconstruct 300k points": lambda how: rholm.reconstruct(cloud, **how),
        "reconstruct without normals": lambda how: rholm.reconstruct(cloud.points, **how),
        "orient 300k points": lambda how: rholm.orient(cloud.points, **how),
        "compress": lambda how: rholm.compress(ring, 3e-4, unit="diagonal", **how),
        "smooth": lambda how: rholm.smooth(fine, "ball:0,0,1,1", 0.2, **how),
        "repair": lambda how: rholm.repair(body, **how),
        "simplify": lambda how: rholm.simplify(body, faces=10_000, **how),
        "compare": lambda how: rholm.compare(body, ring, samples=20_000, **how),
        "render": lambda how: rholm.render(body, (1600, 1200), **how),
        "report": lambda how: plain.report_html(shape=body, **how),
        "mesh of degree 200": lambda how: plain.mesh(9, **how),
    }


def delay(work: Callable[[], Any], after: float) -> float | None:
    """Returns seconds from the signal to the exception, or None if the work was done before."""
    sent = 0.0
    stop = threading.Event()

    def send() -> None:
        nonlocal sent
        if not stop.wait(after):
            sent = time.perf_counter()
            os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=send)
    thread.start()
    try:
        try:
            work()
        except KeyboardInterrupt:
            return time.perf_counter() - sent
        stop.set()
        thread.join()
        return None if sent == 0 else time.perf_counter() - sent
    except KeyboardInterrupt:  # the signal came in between
        return None
    finally:
        stop.set()
        thread.join()


def main() -> None:
    """Measures and prints."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--signals", type=int, default=12)
    parser.add_argument("--threads", type=int, default=0)
    options = parser.parse_args()
    dice = random.Random(1)
    for name, work in computations().items():
        if options.names and not any(part in name for part in options.names):
            continue
        how = {"threads": options.threads, "progress": False}
        begin = time.perf_counter()
        work(how)
        whole = time.perf_counter() - begin
        found = [delay(lambda: work(how), dice.uniform(0.02, 0.95 * whole)) for _ in range(options.signals)]  # noqa: B023
        delays = [1e3 * d for d in found if d is not None]
        if delays:
            middle, most = statistics.median(delays), max(delays)
            print(f"{name:32} {whole:6.2f} s  median {middle:6.0f} ms  largest {most:6.0f} ms")
        else:
            print(f"{name:32} {whole:6.2f} s  done before any signal")


main()
