"""Random closed meshes through every command, within 60 s and 4 GiB each. Exit codes must be documented,
refusals must have a clear message, and outputs must be readable and contain finite numbers only.

Without options a few meshes and cheap commands are tested. Options test all:
  random_meshes_test.py --count 500 [--first N] [--seed S] [--jobs J] [--table FILE] [--keep DIR]
    [--steps everything|all_but_caps|caps|patches|cheap]

The output lists how often each command ended with which exit code, and the ten slowest commands."""

import argparse
import collections
import os
import re
import shutil
import sys
import tempfile
import threading
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, RHOLM, Result, main
from limits import Run
import random_meshes_commands as commands
try:
    from random_meshes import KINDS, content, random_shape
except ImportError:  # NumPy is missing
    KINDS = ()

NOT_A_NUMBER = re.compile(rb"(?<![\w.#-])-?(nan|inf|infinity)(?![\w-])", re.I)
TEXTS = (".off", ".obj", ".xyz", ".sh", ".gfc", ".json", ".csv", ".svg", ".html")
SURFACES = (".off", ".obj", ".ply", ".stl", ".xyz")
MODELS = (".h5", ".sh", ".gfc", ".json", ".npy")


class Trial:
    """One mesh in its own folder, and the results of its commands: runs has (name, command line, exit code,
    seconds, memory), faults has (command line, fault)."""

    def __init__(self, shape, folder):
        self.folder, self.name, self.number = Path(folder), shape.name, shape.number
        self.mesh = "mesh." + shape.kind
        self.diagonal, self.edge = shape.diagonal(), shape.mean_edge()
        self.vertices, self.farthest = len(shape.vertices), float(abs(shape.vertices).max())
        (self.folder / self.mesh).write_bytes(content(shape))
        self.names = None  # names of commands to run; None means all
        self.last = None  # last run
        self.runs, self.faults, self.check = [], [], CliTest()

    def one_of(self, *choices):
        """Returns another choice for each mesh of a kind."""
        return choices[self.number // len(KINDS) % len(choices)]

    def has(self, name):
        return (self.folder / name).exists()

    def same(self, one, other):
        if self.has(other) and (self.folder / one).read_bytes() != (self.folder / other).read_bytes():
            self.faults.append((f"info {other}", f"differs from {one}, of which it was made"))

    def do(self, name, *words, out=None, made=None, codes=commands.DONE_OR_REFUSED):
        """Runs words, with name as the command if words begin with no command, and checks the properties of
        every run. Returns true if it succeeded. `out` is the file written by -o, `made` is the file to
        examine."""
        if self.names and name not in self.names:
            return False
        if name.split()[0] != words[0]:
            words = (name.split()[0], *words)
        words = [*words, *(["-o", out] if out else []), "--threads", "1"]
        self.last = run = Run([RHOLM, *words], self.folder)
        self.runs.append((name, " ".join(words), run.code, run.seconds, run.memory))
        line = " ".join(words)
        for fault in self.faults_of(run, words, codes):
            self.faults.append((line, fault))
        made = made or out
        if run.code not in (0, 4) or not made:
            return run.code == 0
        for fault in self.faults_in(made):
            self.faults.append((line, f"{made}: {fault}"))
        return run.code == 0

    def faults_of(self, run, words, codes):
        if run.exceeded:
            return [run.exceeded]
        if run.code < 0:
            return [f"died of signal {-run.code}"]
        said = run.err.decode("utf-8", "replace")
        if run.code not in codes:
            return [f"exit code {run.code}: {said.strip()}"]
        run.stdout, run.stderr, run.returncode = run.out, run.err, run.code
        result = Result(run, words)
        try:
            self.check.check_decent(result)
            if "--json" in words and run.code == 0:
                result.json()
        except (AssertionError, ValueError) as error:
            return [str(error)]
        # center reports its finding as its answer, on standard output.
        if run.code != 0 and not said and words[0] != "center":
            return [f"exit code {run.code} without a word"]
        return []

    def faults_in(self, made):
        if not self.has(made):
            return ["was not written"]
        kind = Path(made).suffix
        if kind in TEXTS:
            bad = NOT_A_NUMBER.search((self.folder / made).read_bytes())
            if bad:
                return [f"holds {bad[0].decode()}"]
        if kind not in SURFACES + MODELS:
            return []
        read = Run([RHOLM, "info", made, "--json"], self.folder)
        return [f"info: {fault}" for fault in self.faults_of(read, ["info", made, "--json"], {0})]


def try_shape(number, options, steps):
    shape = random_shape(number, options.seed)
    with tempfile.TemporaryDirectory(prefix="rholm-test-") as folder:
        trial = Trial(shape, folder)
        steps(trial)
        if trial.faults and options.keep:
            kept = Path(options.keep)
            kept.mkdir(parents=True, exist_ok=True)
            shutil.copy(trial.folder / trial.mesh, kept / (shape.name + "." + shape.kind))
    return trial


def table(trials):
    """Returns the exit codes of each command with their numbers, most seconds and memory, as Markdown."""
    counts, most = collections.defaultdict(collections.Counter), {}
    for trial in trials:
        for name, _, code, seconds, memory in trial.runs:
            counts[name][code] += 1
            before = most.get(name, (0, 0))
            most[name] = max(before[0], seconds), max(before[1], memory)
    codes = sorted({code for counter in counts.values() for code in counter})
    heads = ["command", *[str(code) if code >= 0 else f"signal {-code}" for code in codes],
             "most s", "most MiB"]
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    for name, counter in counts.items():
        cells = [str(counter[code] or "") for code in codes]
        seconds, memory = most[name]
        lines.append(f"| {name} | " + " | ".join(cells)
                     + f" | {seconds:.1f} | {memory / 2**20:.0f} |")
    return lines


def slowest(trials, n=10):
    runs = [(seconds, memory, code, trial.name, line) for trial in trials
            for _, line, code, seconds, memory in trial.runs]
    lines = ["| s | MiB | code | mesh | command |", "|---|---|---|---|---|"]
    return lines + [f"| {seconds:.1f} | {memory / 2**20:.0f} | {code} | {mesh} | {line} |"
                    for seconds, memory, code, mesh, line in sorted(runs, reverse=True)[:n]]


def summary(trials):
    runs = sum(len(trial.runs) for trial in trials)
    faults = [f"{trial.name}: rholm {line}\n    {what}" for trial in trials
              for line, what in trial.faults]
    return "\n".join([f"{len(trials)} meshes, {runs} runs, {len(faults)} faults", "", *table(trials),
                      "", "The slowest:", "", *slowest(trials), "", *faults])


@unittest.skipIf(not KINDS, "NumPy is not installed")
class RandomMeshes(CliTest):
    def test_every_command_is_tried(self):
        listed = self.rholm("help").out.split("Commands:\n")[1].split("\n\n")[0]
        source = Path(commands.__file__).read_text()
        # The studio takes shapes from its page (studio_test.py).
        for name in {line.split()[0] for line in listed.splitlines()} - {"completion", "studio"}:
            self.assertTrue(re.search(rf'trial.do\(\s*f?"{name}\b', source), f"{name} is not tried")

    def test_every_mesh_is_closed(self):
        for number in range(2 * len(KINDS)):
            shape = random_shape(number)
            edges = collections.Counter()
            names = {}
            corner = [names.setdefault(tuple(v), len(names)) for v in shape.vertices.tolist()]
            for face in shape.faces.tolist():
                a, b, c = (corner[k] for k in face)
                edges.update(frozenset(edge) for edge in ((a, b), (b, c), (c, a)))
            odd = [edge for edge, count in edges.items() if count % 2 and len(edge) == 2]
            self.assertEqual(odd, [], shape.name)

    def test_meshes_of_some_kinds_through_what_is_cheap(self):
        options = argparse.Namespace(seed=1, keep=None)
        # Every sixth kind is tested; nightly runs test 500 meshes of all kinds.
        for number in range(0, len(KINDS), 6):
            trial = try_shape(number, options, commands.cheap)
            with self.subTest(trial.name):
                self.assertEqual(trial.faults, [])


def all_of_them(words):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--steps", default="everything", choices=(
        "everything", "all_but_caps", "caps", "patches", "cheap"))
    parser.add_argument("--table", help="file for the tables, which are printed in any case")
    parser.add_argument("--keep", help="folder for meshes that something was wrong with")
    options = parser.parse_args(words)
    if not KINDS:
        sys.exit("NumPy is not installed for this Python")
    trials, lock = [], threading.Lock()

    def one(number):
        trial = try_shape(number, options, getattr(commands, options.steps))
        with lock:
            trials.append(trial)
            seconds = sum(run[3] for run in trial.runs)
            print(f"{trial.name}: {len(trial.runs)} runs, {seconds:.0f} s", flush=True)
            for line, what in trial.faults:
                print(f"  rholm {line}\n    {what}", flush=True)
            if options.table:
                Path(options.table).write_text(summary(trials) + "\n")
    with ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(one, range(options.first, options.first + options.count)))
    print(summary(trials))
    return any(trial.faults for trial in trials)


if __name__ == "__main__":
    if any(word.startswith("--") for word in sys.argv[1:]):
        sys.exit(all_of_them(sys.argv[1:]))
    main()
