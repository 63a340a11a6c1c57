#!/usr/bin/env python3
"""Whole commands of rholm as a user waits for them: processor and wall time, in Markdown.

    bench/peers/commands.py SHAPES                           # every row, one thread
    bench/peers/commands.py --against OTHER/rholm SHAPES     # two programs in turn, and their ratio
    bench/peers/commands.py --rows bennu,igea --rounds 3 --threads 1,2 SHAPES

SHAPES is a folder with asteroid-bennu.ply, igea.ply, bunny-closed-cgal.off, armadillo-43k.obj and
stanford-dragon.ply; a missing file has no row. Made inputs (points, a mesh of 5.2 million triangles, models)
are in a temporary folder of 0.4 GB. Programs and numbers of threads take turns, round by round, so that
other load of the machine affects all of them. Medians and quartiles of the rounds are given.
scripts/performance measures the stages of analyze; bench/peers/libraries.py measures other packages.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Row:
    """A command: words with {shapes} and {made} for folders. `first`: commands that make its inputs."""

    what: str
    words: str
    first: tuple[str, ...] = ()
    rounds: int = 9


LARGE = "make bumpy --subdivisions 9 -o {made}/large.ply"
ANALYZE_LARGE = "analyze {made}/large.ply --precision 1e-6 --center none -o {made}/o.h5 --degree "
BENNU_MODEL = "analyze {shapes}/asteroid-bennu.ply --degree 64 -o {made}/bennu.h5"

ROWS = {
    "small": Row(
        "`analyze`, 320 faces, degree 16",
        "analyze {made}/small.ply --degree 16 -o {made}/o.h5",
        ("make bumpy --subdivisions 2 -o {made}/small.ply",),
    ),
    "bennu": Row(
        "`analyze` Bennu, degree 180",
        "analyze {shapes}/asteroid-bennu.ply --degree 180 -o {made}/o.h5",
    ),
    "igea": Row(
        "`analyze --signed` Igea, degree 256",
        "analyze {shapes}/igea.ply --signed --degree 256 -o {made}/o.h5",
    ),
    "igea4": Row(
        "the same, precision 1e-4",
        "analyze {shapes}/igea.ply --signed --degree 256 --precision 1e-4 -o {made}/o.h5",
    ),
    "large480": Row("`analyze` 5.2M faces, degree 480, 1e-6", ANALYZE_LARGE + "480", (LARGE,)),
    "transform480": Row("the same, `--no-errors`", ANALYZE_LARGE + "480 --no-errors", (LARGE,)),
    "large64": Row("`analyze` 5.2M faces, degree 64, 1e-6", ANALYZE_LARGE + "64", (LARGE,)),
    "render": Row("`render` a model", "render {made}/bennu.h5 -o {made}/o.png", (BENNU_MODEL,)),
    "report": Row(
        "`report` of Bennu at 64 beside its shape",
        "report {made}/bennu.h5 --shape {shapes}/asteroid-bennu.ply -o {made}/o.html",
        (BENNU_MODEL,),
    ),
    "compare": Row(
        "`compare` Bennu with that model",
        "compare {shapes}/asteroid-bennu.ply {made}/bennu.h5",
        (BENNU_MODEL,),
    ),
    "bunny": Row(
        "`analyze --atlas` bunny, 1e-3",
        "analyze {shapes}/bunny-closed-cgal.off --atlas --tolerance 1e-3 --unit diagonal -o {made}/o.h5",
        rounds=3,
    ),
    "armadillo": Row(
        "`analyze --atlas` Armadillo, 3e-4",
        "analyze {shapes}/armadillo-43k.obj --atlas --tolerance 3e-4 --unit diagonal -o {made}/o.h5",
        rounds=1,
    ),
    "points": Row(
        "`reconstruct` Igea, 200 000 points",
        "reconstruct {made}/igea.ply -o {made}/o.ply",
        ("make sample {shapes}/igea.ply --points 200000 -o {made}/igea.ply",),
    ),
    "dragon": Row(
        "`reconstruct` dragon, a million points",
        "reconstruct {made}/dragon.ply -o {made}/o.ply",
        ("make sample {shapes}/stanford-dragon.ply --points 1000000 -o {made}/dragon.ply",),
        rounds=3,
    ),
}


def run(program: str, words: list[str]) -> tuple[float, float]:
    """Returns processor and wall seconds of a command; ends the script if it fails."""
    start = time.perf_counter()
    process = subprocess.Popen([program, *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    said = process.stderr.read().decode(errors="replace") if process.stderr else ""
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    if os.waitstatus_to_exitcode(status) not in (0, 4):
        sys.exit(f"{program} {' '.join(words)}: {said.strip()}")
    return usage.ru_utime + usage.ru_stime, wall


def figure(values: list[float]) -> str:
    """Formats the median and, from three values on, the quartiles."""
    text = f"{statistics.median(values):.3g}"
    if len(values) < 3:
        return text
    quartiles = statistics.quantiles(values, method="inclusive")
    return f"{text} ({quartiles[0]:.3g} ... {quartiles[2]:.3g})"


def measure(row: Row, programs: list[str], threads: list[int], rounds: int, folders: dict[str, str]) -> None:
    """Prints the lines of a row, one for each number of threads."""
    for words in row.first:
        wanted = Path(words.split("-o ")[1].format(**folders))
        if not wanted.exists():
            run(programs[0], [*words.format(**folders).split(), "--quiet"])
    found: dict[tuple[str, int], list[tuple[float, float]]] = {}
    for _ in range(rounds or row.rounds):
        for n in threads:
            for program in programs:
                words = [*row.words.format(**folders).split(), "--quiet", "--threads", str(n)]
                found.setdefault((program, n), []).append(run(program, words))
    for n in threads:
        cells = [row.what, str(n)]
        for program in programs:
            cells += [figure([time[k] for time in found[program, n]]) for k in (0, 1)]
        if len(programs) == 2:
            ours, other = (found[program, n] for program in programs)
            ratios = [b[0] / a[0] for a, b in zip(ours, other, strict=True)]
            cells.append(f"{statistics.median(ratios):.2f}")
        print("| " + " | ".join(cells) + " |", flush=True)


def main() -> None:
    """Reads the command line and prints the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("shapes", type=Path, metavar="SHAPES")
    parser.add_argument("--program", default=str(ROOT / "build/release/cli/rholm"))
    parser.add_argument("--against", metavar="PROGRAM", help="another one, such as of an earlier version")
    parser.add_argument("--rows", default=",".join(ROWS), help="of " + ",".join(ROWS))
    parser.add_argument("--rounds", type=int, default=0, help="9 by default, fewer of what takes long")
    parser.add_argument("--threads", default="1", help="numbers of them, with commas")
    options = parser.parse_args()
    unknown = set(options.rows.split(",")) - set(ROWS)
    if unknown:
        parser.error(f"no rows {', '.join(sorted(unknown))}")
    programs = [options.program, *([options.against] if options.against else [])]
    threads = [int(n) for n in options.threads.split(",")]
    head = ["command", "threads", "CPU, s", "wall, s"]
    if options.against:
        head += ["other, CPU, s", "other, wall, s", "other / CPU"]
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    with tempfile.TemporaryDirectory() as made:
        folders = {"shapes": str(options.shapes), "made": made}
        for name in options.rows.split(","):
            row = ROWS[name]
            inputs = [word for text in (row.words, *row.first) for word in text.split() if "{shapes}" in word]
            missing = [word for word in inputs if not Path(word.format(**folders)).exists()]
            if missing:
                print(f"no row {name}: there is no {missing[0].format(**folders)}", file=sys.stderr)
                continue
            measure(row, programs, threads, options.rounds, folders)


if __name__ == "__main__":
    main()
