#!/usr/bin/env python3
"""Compares rholm with other packages on the same data: time, memory and error, in Markdown.

    python bench/peers/libraries.py                                  # everything, on made shapes
    python bench/peers/libraries.py --data SHAPES --json table.json  # on real ones
    python bench/peers/libraries.py --rows sums,points --rounds 5

Run it with an interpreter that has rholm: an installed one, or PYTHONPATH=build/release/python. The other
packages, listed in requirements.txt, go into a separate environment, made once in
${XDG_CACHE_HOME:-~/.cache}/rholm-bench-python (3 GB). Open3D and pymeshlab need libraries of the system that
no wheel has: on Debian libusb-1.0-0, libgl1, libgomp1, libopengl0 and libglu1-mesa. A package that cannot be
installed, or fails, has a row that says so.

SHAPES is a folder with asteroid-bennu.ply, igea.ply, armadillo-43k.obj and stanford-dragon.ply.

Each measurement is a process with one thread (OMP_NUM_THREADS and similar variables, and the arguments of
packages). Open3D's use of TBB has no such setting; where processor time is above wall time, a package has
used more than one thread. Contenders of a group take turns, in as many rounds as fit into --seconds, at
least one. Times are medians over processes. Each process gives the median of repeated calls after the first,
or the first call if it is long. Memory is the peak of the resident set in the first call, above the size of
the process with its packages and its input. Radii along rays, voxels, sources and weights are given to
contenders for free; opening files is not measured.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import math
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import rholm
from tables import TABLES, Entry, Group, Result, oracle

HERE = Path(__file__).resolve().parent
PACKAGES = ("numpy", "pyshtools", "aicsshparam", "ducc0", "open3d", "pymeshlab", "trimesh", "pyvista", "vtk")
ONE_THREAD = {
    name: "1"
    for name in (
        "OMP_NUM_THREADS",
        "OPENBLAS_NUM_THREADS",
        "MKL_NUM_THREADS",
        "BLIS_NUM_THREADS",
        "NUMEXPR_NUM_THREADS",
        "DUCC0_NUM_THREADS",
        "VTK_SMP_MAX_THREADS",
    )
}
LONGEST = 300  # seconds a process may take; chosen: four times the slowest run on a loaded machine


def environment() -> Path:
    """Returns the interpreter of an environment with requirements.txt, which is made if necessary."""
    pinned = (HERE / "requirements.txt").read_text()
    key = hashlib.sha256(f"{pinned}{sys.version_info[:2]}".encode()).hexdigest()[:12]
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "rholm-bench-python" / key
    python, done = cache / "bin" / "python", cache / "complete"
    if done.exists():
        return python
    print(f"Installing the other packages into {cache}", file=sys.stderr)
    subprocess.run([sys.executable, "-m", "venv", "--clear", str(cache)], check=True)
    install = [
        str(python),
        *("-m", "pip", "install", "--quiet", "--no-deps", "--require-hashes", "--only-binary=:all:", "-r"),
    ]
    if subprocess.run([*install, str(HERE / "requirements.txt")]).returncode != 0:
        # A package is not available for this machine: the others are installed one by one.
        one, installed = cache / "one.txt", 0
        for pin in pinned.replace("\\\n", " ").splitlines():
            if pin and not pin.startswith("#"):
                one.write_text(pin)
                installed += subprocess.run([*install, str(one)], capture_output=True).returncode == 0
        if installed == 0:
            raise SystemExit("None of the other packages can be installed.")
    done.touch()
    return python


class Bench:
    """Runs contenders in processes of their own."""

    def __init__(self, others: Path, scratch: Path) -> None:
        self._others = others
        self._scratch = scratch
        self._files: dict[int, tuple[Path, Result]] = {}

    def run(self, entry: Entry, data: Result, seconds: float, keep: bool) -> tuple[dict[str, float], Result]:
        """Measures a contender once.

        Parameters
        ----------
        entry : Entry
            The contender.
        data : arrays
            Its input.
        seconds : float
            Time for which short calls are repeated.
        keep : bool
            True if its result is wanted.

        Raises
        ------
        RuntimeError
            With the last output of the process, if it failed.
        """
        made = self._scratch / "result.npz"
        job = {
            "contender": entry.contender,
            "options": entry.options,
            "data": str(self._file(data)),
            "result": str(made) if keep else "",
            "seconds": seconds,
        }
        (self._scratch / "job.json").write_text(json.dumps(job))
        variables = {**os.environ, **ONE_THREAD}
        if not entry.ours:
            variables.pop("PYTHONPATH", None)
        python = sys.executable if entry.ours else self._others
        command = [str(python), str(HERE / "contenders.py"), str(self._scratch / "job.json")]
        try:
            ran = subprocess.run(
                command, env=variables, capture_output=True, text=True, errors="replace", timeout=LONGEST
            )
        except subprocess.TimeoutExpired:
            raise RuntimeError(f"took more than {LONGEST} s") from None
        if ran.returncode != 0:
            said = [line for line in ran.stderr.splitlines() if line.strip()] or ["said nothing"]
            ended = f"ended by signal {-ran.returncode}: " if ran.returncode < 0 else ""
            raise RuntimeError((ended + said[-1])[:160])
        figures: dict[str, float] = json.loads(ran.stdout.splitlines()[-1])
        if not keep:
            return figures, {}
        with np.load(made) as file:
            return figures, {name: file[name] for name in file.files}

    def prepare(self, contender: str, data: Result, **options: Any) -> Result:
        """Returns the result of a job of the other environment, which is not measured."""
        return self.run(Entry("", contender, options), data, 0, keep=True)[1]

    def _file(self, data: Result) -> Path:
        if id(data) not in self._files:
            path = self._scratch / f"data{len(self._files)}.npz"
            arrays: dict[str, Any] = data
            np.savez(path, **arrays)
            self._files[id(data)] = (path, data)
        return self._files[id(data)][0]

    def choose(self, group: Group, entry: Entry) -> None:
        """Gives an entry the choice of options with the smallest error."""
        errors, reason = [], ""
        for options in entry.choices:
            entry.options = options
            try:
                _, result = self.run(entry, group.data[entry.data], 0, keep=True)
                errors.append(next(iter(group.judge(result, entry).values())))
            except (RuntimeError, rholm.Error) as error:
                errors.append(math.inf)
                reason = str(error)
        if min(errors) == math.inf:
            raise RuntimeError(reason)
        entry.options = entry.choices[int(np.argmin(errors))]
        said = ", ".join(f"{k} {v:.3g}" for k, v in entry.options.items() if not isinstance(v, str))
        entry.label += f": {said}"

    def measure(self, group: Group, rounds: int, seconds: float) -> list[dict[str, Any]]:
        """Returns the rows of a group."""
        rows: list[dict[str, Any]] = []
        runs: list[list[dict[str, float]]] = [[] for _ in group.entries]
        for entry in group.entries:
            rows.append({"shape": group.title, "contender": entry.label})
            try:
                if entry.choices:
                    self.choose(group, entry)
                    rows[-1]["contender"] = entry.label
            except RuntimeError as error:
                rows[-1]["failed"] = str(error)
        end = time.perf_counter() + seconds
        for turn in range(rounds):
            if turn > 0 and time.perf_counter() > end:
                break
            for entry, row, measured in zip(group.entries, rows, runs, strict=True):
                if "failed" in row:
                    continue
                try:
                    figures, result = self.run(entry, group.data[entry.data], 0.5, keep=turn == 0)
                    measured.append(figures)
                    if turn == 0:
                        row.update(group.judge(result, entry))
                except (RuntimeError, rholm.Error) as error:
                    row["failed"] = str(error)
        for row, measured in zip(rows, runs, strict=True):
            if measured:
                for name in ("cpu", "wall", "memory"):
                    row[name] = statistics.median(m[name] for m in measured)
                row["rounds"] = len(measured)
                row["runs"] = measured
        return rows


UNITS = {"cpu": "CPU, ms", "wall": "wall, ms", "memory": "memory, MB"}


def cell(name: str, value: Any) -> str:
    """Formats a figure."""
    if value is None:
        return ""
    if name in ("cpu", "wall"):
        return f"{value * 1e3:.3g}" if value < 0.9995 else f"{value * 1e3:.0f}"
    if name == "memory":
        return f"{value:.3g}" if value < 999.5 else f"{value:.0f}"
    if name == "volume":
        return f"{value:+.1e}"
    if name == "wrong side":
        return f"{100 * value:.3g} %"
    if name == "inside out":
        return "yes" if value else "no"
    if name == "mean angle":
        return f"{value:.2f}°"
    if isinstance(value, float) and not math.isfinite(value):
        return "none"
    return f"{value:.1e}" if isinstance(value, float) else str(value)


def markdown(rows: list[dict[str, Any]]) -> str:
    """Formats a table of one kind of rows."""
    judged = list(
        dict.fromkeys(
            k
            for row in rows
            for k in row
            if k not in ("shape", "contender", "failed", "rounds", "runs", *UNITS)
        )
    )
    columns = ["cpu", "wall", "memory", *judged, "rounds"]
    lines = ["| | " + " | ".join(UNITS.get(c, c) for c in columns) + " |"]
    lines.append("|---|" + "---:|" * len(columns))
    shape = None
    for row in rows:
        if row["shape"] != shape:
            shape = row["shape"]
            lines.append(f"| **{shape}** |" + " |" * len(columns))
        if "failed" in row:
            lines.append(
                f"| {row['contender']} | not measured: {row['failed']} |" + " |" * (len(columns) - 1)
            )
            continue
        lines.append(f"| {row['contender']} | " + " | ".join(cell(c, row.get(c)) for c in columns) + " |")
    return "\n".join(lines)


def machine() -> str:
    """Returns the system's name for the processor."""
    path = Path("/proc/cpuinfo")
    lines = path.read_text().splitlines() if path.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return f"{names[0] if names else platform.processor()}, {os.cpu_count()} processors"


def versions(python: Path) -> dict[str, str]:
    """Returns the versions of the installed packages."""
    code = (
        "import importlib.metadata as m, json, sys\n"
        "def v(n):\n try: return m.version(n)\n except m.PackageNotFoundError: return 'not installed'\n"
        "print(json.dumps({n: v(n) for n in sys.argv[1:]}))"
    )
    said = subprocess.run(
        [str(python), "-c", code, *PACKAGES], check=True, capture_output=True, text=True
    ).stdout
    return {"rholm": rholm.__version__, **json.loads(said)}


def main() -> None:
    """Reads the command line, measures and prints."""
    assert __doc__ is not None
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rows", default=",".join(TABLES), help="which tables: " + ", ".join(TABLES))
    parser.add_argument("--data", type=Path, help="folder of real shapes; made ones without it")
    parser.add_argument("--rounds", type=int, default=5, help="of all contenders in turn, at most")
    parser.add_argument("--seconds", type=float, default=30, help="of a group, after which no round begins")
    parser.add_argument("--json", type=Path, help="all figures, of each process, in a file")
    arguments = parser.parse_args()
    chosen = arguments.rows.split(",")
    if unknown := [name for name in chosen if name not in TABLES]:
        parser.error(f"no table is called {', '.join(unknown)}; there are {', '.join(TABLES)}")
    others = environment()
    found: dict[str, Any] = {"machine": machine(), "versions": versions(others), "tables": {}}
    print(f"{found['machine']}; Python {platform.python_version()};")
    print(", ".join(f"{name} {version}" for name, version in found["versions"].items()) + ". One thread.")
    for name in chosen:
        with tempfile.TemporaryDirectory() as scratch:
            bench = Bench(others, Path(scratch))
            rows: list[dict[str, Any]] = []
            try:
                if name == "coefficients":
                    found["oracle"] = oracle(bench.prepare)
                    figures = ", ".join(f"{k} {v:.0e}" for k, v in found["oracle"].items())
                    print(f"\nThe oracle against cubature with SciPy's harmonics: {figures}.")
                for group in TABLES[name](arguments.data, bench.prepare):
                    print(f"{name}: {group.title}", file=sys.stderr)
                    rows += bench.measure(group, arguments.rounds, arguments.seconds)
            except RuntimeError as error:  # in the preparation of data for all contenders
                rows.append({"shape": name, "contender": "all others", "failed": str(error)})
            found["tables"][name] = rows
            print(f"\n### {name}\n\n{markdown(rows)}", flush=True)
    if arguments.json:
        arguments.json.write_text(json.dumps(found, indent=1))


if __name__ == "__main__":
    main()
