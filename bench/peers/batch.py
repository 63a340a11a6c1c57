#!/usr/bin/env python3
"""Many shapes at once: rholm batch compared with a shell loop over rholm analyze, in Markdown.

    bench/peers/batch.py                          # 1000 meshes of 5120 faces, degree 32
    bench/peers/batch.py --count 10000 --broken 2 # per cent of truncated files
    bench/peers/batch.py --ranks 1,2,4            # rholm-mpi as well
    bench/peers/batch.py --sizes                  # gain by threads within a shape, by size of its file

The batch writes all descriptors (coefficients, energy per degree, errors) to a table (HDF5). The loop writes
a model and a JSON report for each shape, without joining them. Meshes are made in a temporary folder:
--distinct of them are files, the others are links. Methods take turns; the median of the rounds is given.
"""

from __future__ import annotations

import argparse
import csv
import os
import resource
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def seconds(words: list[str], folder: Path) -> tuple[float, float]:
    """Returns wall and processor time of a command, which may fail."""
    begin, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return time.perf_counter() - begin, cpu


def make_shapes(program: str, folder: Path, count: int, distinct: int, broken: float) -> None:
    """Writes `count` files and shapes.csv. Every n-th file is truncated in the middle."""
    for i in range(min(distinct, count)):
        words = [program, "make", "bumpy", "--subdivisions", "4", "--seed", str(i), "--quiet"]
        subprocess.run([*words, "-o", str(folder / f"{i}.ply")], check=True)
    cut = (folder / "0.ply").read_bytes()
    (folder / "cut.ply").write_bytes(cut[: len(cut) // 2])
    every = round(100 / broken) if broken > 0 else count + 1
    with open(folder / "shapes.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["id", "path"])
        for i in range(count):
            name = f"{i}.ply"
            if i % every == every - 1:
                name = f"cut-{i}.ply"
                os.link(folder / "cut.ply", folder / name)
            elif i >= distinct:
                os.link(folder / f"{i % distinct}.ply", folder / name)
            table.writerow([i, name])


def compare(program: str, options: argparse.Namespace) -> None:
    """Prints a row for each method: shapes per second of wall time, and processor time of a shape."""
    degree = str(options.degree)
    loop = (
        "tail -n +2 shapes.csv | tr -d '\\r' | while IFS=, read -r id path; do "
        f'"{program}" analyze "$path" --threads 1 --degree {degree} --json -o "$id.h5" > "$id.json" '
        f'&& "{program}" spectrum "$id.h5" --json > "$id.spectrum.json"; done'
    )
    ways = {} if options.batch_only else {"a loop of a shell": ["bash", "-c", loop]}
    for threads in options.threads.split(","):
        words = [program, "batch", "shapes.csv", "-o", "all.h5", "--threads", threads]
        ways[f"rholm batch, --threads {threads}"] = [*words, "--", "--degree", degree]
    for ranks in options.ranks.split(",") if options.ranks else ():
        words = [options.mpiexec, "-n", ranks, options.mpi, "batch", "shapes.csv", "-o", "all.h5"]
        ways[f"rholm-mpi batch, {ranks} ranks"] = [*words, "--threads", "1", "--", "--degree", degree]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        make_shapes(program, folder, options.count, options.distinct, options.broken)
        found: dict[str, list[tuple[float, float]]] = {way: [] for way in ways}
        for _ in range(options.rounds):
            for way, words in ways.items():
                found[way].append(seconds(words, folder))
    print(f"{options.count} meshes of 5120 faces, {options.broken:g} % of them cut off, degree {degree}\n")
    print("| | shapes per second | processor time of a shape, ms |\n|---|---|---|")
    for way, times in found.items():
        wall = statistics.median(t[0] for t in times)
        cpu = statistics.median(t[1] for t in times)
        print(f"| {way} | {options.count / wall:.1f} | {1000 * cpu / options.count:.1f} |")


def sizes(program: str, options: argparse.Namespace) -> None:
    """Prints the gain and the cost of two threads on one shape, by the size of its file."""
    print("| file, MiB | one thread, s | two threads, s | gain | processor time of two, of one |")
    print("|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for level in range(4, 10):
            words = [program, "make", "bumpy", "--subdivisions", str(level), "--quiet", "-o", "a.ply"]
            subprocess.run(words, cwd=folder, check=True)
            times: dict[int, list[tuple[float, float]]] = {1: [], 2: []}
            for _ in range(options.rounds):
                for threads, list_ in times.items():
                    words = [program, "analyze", "a.ply", "--degree", str(options.degree), "-o", "a.h5"]
                    list_.append(seconds([*words, "--threads", str(threads)], folder))
            one, two = (statistics.median(t[0] for t in times[n]) for n in (1, 2))
            cost = statistics.median(t[1] for t in times[2]) / statistics.median(t[1] for t in times[1])
            size = (folder / "a.ply").stat().st_size / 2**20
            print(f"| {size:.1f} | {one:.3f} | {two:.3f} | {one / two:.2f} | {cost:.2f} |", flush=True)


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "cli" / "rholm"))
    parser.add_argument("--mpi", default=str(ROOT / "build" / "release" / "mpi" / "rholm-mpi"))
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--ranks", default="", help="of rholm-mpi, on one thread each: 1,2,4")
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--distinct", type=int, default=100)
    parser.add_argument("--degree", type=int, default=32)
    parser.add_argument("--broken", type=float, default=0.0, help="per cent")
    parser.add_argument("--threads", default="1,2")
    parser.add_argument("--batch-only", action="store_true", help="without the loop")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--sizes", action="store_true")
    options = parser.parse_args()
    (sizes if options.sizes else compare)(options.program, options)


if __name__ == "__main__":
    main()
