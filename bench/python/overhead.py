"""Compares a call from Python with the same call from C++, in one interleaved run.

    PYTHONPATH=build/release/python python bench/python/overhead.py [--rounds N] [--count N]

Runs `expand` of small meshes (320 faces, degree 16) in a loop, and the same loop in `small_meshes_bench`.
Also measures the memory of `expand` for a large mesh, with arrays that can be used in place and with others.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

MEMORY = """
import resource, sys
import numpy as np, rholm
mesh = rholm.icosphere(8)
vertices = np.array(mesh.vertices, dtype=sys.argv[1])
triangles = np.array(mesh.faces, dtype=sys.argv[2])
n = len(triangles)
del mesh
rholm.expand((vertices[:12], rholm.icosphere(0).faces), 4, threads=1)
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
with open("/proc/self/clear_refs", "w") as f:  # the peak starts again from here
    f.write("5")
def status(key):
    return next(int(line.split()[1]) for line in open("/proc/self/status") if line.startswith(key))
resident = status("VmRSS")
rholm.expand((vertices, triangles), 64, threads=1, errors=False, center="none", rays=0)
print((status("VmHWM") - resident) * 1024 / n)
"""


def python_loop(count: int, threads: int) -> dict[str, float]:
    """Runs the loop of small_meshes_bench in Python."""
    import numpy as np
    import rholm

    mesh = rholm.bumpy_sphere(2)
    arrays = (np.array(mesh.vertices), np.array(mesh.faces))
    wall, cpu = time.perf_counter(), time.process_time()
    for _ in range(count):
        rholm.expand(arrays, 16, threads=threads)
    return {"wall": time.perf_counter() - wall, "cpu": time.process_time() - cpu}


def cpp_loop(count: int, threads: int) -> dict[str, float]:
    """Runs the same loop in C++."""
    program = ROOT / "build" / "release" / "bench" / "small_meshes_bench"
    done = subprocess.run([program, str(count), str(threads)], check=True, capture_output=True, text=True)
    return dict(json.loads(done.stdout))


def main() -> None:
    """Measures and prints."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--count", type=int, default=1000)
    options = parser.parse_args()
    for threads in (1, 0):
        python_loop(50, threads)
        runs = [
            (cpp_loop(options.count, threads), python_loop(options.count, threads))
            for _ in range(options.rounds)
        ]
        for what in ("cpu", "wall"):
            cpp = statistics.median(run[0][what] for run in runs) / options.count * 1e6
            python = statistics.median(run[1][what] for run in runs) / options.count * 1e6
            ratio = statistics.median(run[1][what] / run[0][what] for run in runs)
            both = f"C++ {cpp:7.1f} us, Python {python:7.1f} us a mesh"
            print(f"threads {threads}, {what:4}: {both}, ratio {ratio:.3f}")
    for floats, ints in (("f8", "i4"), ("f4", "u4"), ("f8", "i8")):
        done = subprocess.run(
            [sys.executable, "-c", MEMORY, floats, ints], check=False, capture_output=True, text=True
        )
        print(
            f"memory of expand, {floats} {ints}: {done.stdout.strip() or done.stderr[-200:]} bytes a triangle"
        )


main()
