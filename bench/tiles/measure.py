"""Measures the cost of reconstruction in tiles per point: time of each stage, memory, and disk.

Usage: measure.py RHOLM BODY.ply [POINTS] [POINTS_PER_TILE] [THREADS]

BODY.ply is a mesh, for example made by body.py. POINTS are sampled from it; for comparison, a million points
are reconstructed in one piece.
"""

import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

rholm, body = sys.argv[1:3]
points = int(sys.argv[3]) if len(sys.argv) > 3 else 4_000_000
per_tile = int(sys.argv[4]) if len(sys.argv) > 4 else 1 << 20
threads = sys.argv[5] if len(sys.argv) > 5 else "1"


def reconstruct(folder: Path, n: int, *more: str) -> dict:
    """Returns the report, with seconds of processor time, and memory in bytes."""
    subprocess.run(
        [rholm, "make", "sample", body, "--points", str(n), "-o", folder / "points.ply", "--quiet"],
        check=True,
    )
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    words = [rholm, "reconstruct", folder / "points.ply", "-o", folder / "surface.ply", "--json", "--quiet"]
    ran = subprocess.run([*words, "--threads", threads, *more], check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    report = json.loads(ran.stdout)
    report["cpu"] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    report["memory"] = 1024 * after.ru_maxrss  # largest child, which is this one
    return report


with tempfile.TemporaryDirectory(dir=".") as name:
    folder = Path(name)
    million = 1_000_000
    one = reconstruct(folder, million, "--tile-points", str(2 * million))
    per_point = 1e6 * one["cpu"] / million
    print(f"one piece, {million} points: {per_point:.2f} us a point, {one['memory'] / 1e9:.2f} GB")
    many = reconstruct(
        folder, points, "--tile-points", str(per_tile), "--max-memory", "3", "--work-dir", str(folder)
    )
    print(
        f"{many['tiles']} tiles, {points} points: {1e6 * many['cpu'] / points:.2f} us a point, "
        f"{many['memory'] / 1e9:.2f} GB, {many['stored_bytes'] / points:.0f} bytes a point stored"
    )
    print(f"ratio {many['cpu'] / points / (one['cpu'] / million):.2f}")
    for stage, time in sorted(many["stages"].items(), key=lambda item: -item[1]["cpu_seconds"]):
        print(f"  {stage:<12} {1e6 * time['cpu_seconds'] / points:6.3f} us a point")
