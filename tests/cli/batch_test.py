"""rholm batch: a row has the results of the command for the shape alone, however the batch was run."""

import contextlib
import csv
import io
import math
import os
import signal
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, OCTAHEDRON, RHOLM, NIGHTLY, Terminal, TIMEOUT, main, nightly_too, off, rows_done, until

# Columns that only the batch has, and columns of a run, which differ from one run to the next.
OWN = {"id", "path", "group", "exit_code", "message", "warnings", "seconds", "cpu_seconds"}
OF_THE_RUN = {"seconds", "cpu_seconds", "wall_seconds", "times", "peak_memory_bytes"}


def flattened(report, prefix=""):
    """Converts the report of --json to columns, independently of the program: {name: text}."""
    columns = {}
    for key, value in report.items():
        name = prefix + key
        if isinstance(value, dict):
            columns |= flattened(value, name + ".")
        elif isinstance(value, list):
            if all(isinstance(x, (int, float)) or x is None for x in value):
                columns |= {f"{name}.{i}": x for i, x in enumerate(value) if x is not None}
            elif all(isinstance(x, str) for x in value):
                columns[name] = "; ".join(value)
        elif value is not None:
            columns[name] = value
    return columns


def same(cell, value):
    if isinstance(value, bool):
        return cell == ("true" if value else "false")
    if isinstance(value, (int, float)):
        return cell != "" and float(cell) == value
    return cell == value


class BatchTest(CliTest):
    def make_shapes(self, n):
        """Makes n star-shaped shapes, some other shapes, and files that are no shapes; writes shapes.csv.
        Errors of shapes with few, long faces would take longer."""
        (self.folder / "s").mkdir()
        rows = []
        for i in range(n):
            name = f"s/{i:03}.ply"
            self.rholm("make", "bumpy", "--subdivisions", 3 + i % 2, "--seed", i, "--quiet", "-o", name)
            rows.append((f"shape {i}", name, "good"))
        for name, text in self.broken().items():
            (self.folder / "s" / name).write_bytes(text)
        (self.folder / "s" / "short.ply").write_bytes((self.folder / "s" / "000.ply").read_bytes()[:-50])
        self.rholm("make", "torus", "--quiet", "-o", "s/torus.ply")
        names = [*self.broken(), "short.ply", "torus.ply", "missing.ply"]
        for k, name in enumerate(names):
            rows.insert(3 * k + 1, (name, f"s/{name}", "bad"))
        text = io.StringIO()
        csv.writer(text).writerows([("id", "path", "group"), *rows])
        self.write("shapes.csv", text.getvalue())
        return rows

    @staticmethod
    def broken():
        nan = off(*OCTAHEDRON).replace("1 0 0\n", "nan 0 0\n", 1)
        return {"empty.ply": b"", "nan.off": nan.encode(), "open.off":
                off(OCTAHEDRON[0], OCTAHEDRON[1][1:]).encode()}

    def table(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def batch(self, out, *words, degree=4, **options):
        """Runs a batch; the options of its command come after --."""
        return self.rholm("batch", "shapes.csv", "-o", out, "--no-times", *words, "--", "--degree", degree,
                          **options)


class Rows(BatchTest):
    @nightly_too
    def test_rows_say_what_the_command_says_of_each_shape_alone(self):
        rows = self.make_shapes(100 if NIGHTLY else 8)
        result = self.batch("all.csv", "--coefficients")
        table = self.table("all.csv")
        self.assertEqual([(r["id"], r["path"], r["group"]) for r in table], rows)
        n_bad = sum(group == "bad" for _, _, group in rows)
        self.assertIn(f"{len(rows)} rows, {n_bad} failed", result.err)
        for row in table:
            alone = self.run_rholm("expand", row["path"], "--degree", 4, "--json", "-o", "one.h5")
            self.assertEqual(row["exit_code"], str(alone.code), row)
            if alone.code != 0:
                self.assertIn(f"error: {row['message']}\n", alone.err)
                self.assertEqual(set(k for k, v in row.items() if v) - OWN, set())
                continue
            self.assertEqual(row["message"], "")
            report = flattened(alone.json())
            spectrum = flattened(self.rholm("spectrum", "one.h5", "--json").json())
            for name, value in {**spectrum, **report}.items():
                if name in ("file", "output") or OF_THE_RUN & set(name.split(".")):
                    self.assertNotIn(name, row)
                else:
                    self.assertTrue(same(row[name], value), f"{name}: {row[name]!r}, not {value!r}")
            measures = self.rholm("info", "one.h5", "--json").json()
            for name in ("volume", "area", "sphericity"):
                self.assertTrue(same(row[name], measures[name]), f"{name}: {row[name]!r}, not {measures[name]!r}")
            self.assertLessEqual(float(row["sphericity"]), 1)
            # Parseval: the energy of a degree is the sum of its squared coefficients.
            for l in range(5):
                energy = sum(float(row[f"coefficients.{l * l + k}"]) ** 2 for k in range(2 * l + 1))
                self.assertTrue(math.isclose(energy, float(row[f"energy.{l}"]), rel_tol=1e-14, abs_tol=1e-300))
        self.assertEqual([f for f in self.files() if "journal" in f], [])

    def test_coefficients_stand_where_the_document_says(self):
        self.make_shapes(2)
        self.batch("all.csv", "--coefficients", degree=3)
        row = self.table("all.csv")[0]
        self.rholm("expand", row["path"], "--degree", 3, "-o", "one.sh", "--normalization", "orthonormal")
        lines = [line.split() for line in (self.folder / "one.sh").read_text().splitlines()
                 if line and not line.startswith("#")]
        found = 0
        for l, m, c, s in ((int(x[0]), int(x[1]), x[2], x[3]) for x in lines if len(x) == 4):
            self.assertEqual(float(row[f"coefficients.{l * l + l + m}"]), float(c))
            if m > 0:
                self.assertEqual(float(row[f"coefficients.{l * l + l - m}"]), float(s))
            found += 1
        self.assertEqual(found, 10)

    def test_every_command_that_takes_a_shape_makes_rows(self):
        self.make_shapes(2)
        self.write("good.csv", "path\ns/000.ply\ns/001.ply\n")
        for command, words, column in (("info", [], "area"), ("center", [], "min_d"),
                                       ("repair", [], "after.faces"), ("simplify", ["--faces", "50%"], "faces")):
            self.rholm("batch", "good.csv", "--command", command, "-o", "r.csv", "--", *words)
            for row in self.table("r.csv"):
                self.assertEqual(row["exit_code"], "0", row)
                self.assertTrue(row.get(column), row)
                self.assertGreaterEqual(float(row["seconds"]), 0)
        self.batch("models.csv", "--outputs", "models")
        self.write("m.csv", "path\nmodels/shape_0.h5\n")
        self.rholm("batch", "m.csv", "--command", "spectrum", "-o", "s.csv")
        self.assertEqual(self.table("s.csv")[0]["degree"], "4")

    def test_outputs_are_kept_under_safe_names(self):
        self.make_shapes(1)
        self.write("shapes.csv", "id,path\n../a b,s/000.ply\n.._a_b,s/000.ply\n.._A_b,s/000.ply\nbroken,s/empty.ply\n")
        self.rholm("batch", "shapes.csv", "-o", "r.csv", "--outputs", "kept", "--", "--degree", 2,
                   "--format", "shtools")
        self.assertEqual(sorted(p.name for p in (self.folder / "kept").iterdir()),
                         ["_._A_b-2.sh", "_._a_b-1.sh", "_._a_b.sh"])
        self.rholm("expand", "s/000.ply", "--degree", 2, "-o", "one.sh")
        self.assertEqual((self.folder / "kept/_._a_b.sh").read_bytes(), (self.folder / "one.sh").read_bytes())

    def test_a_manifest_on_standard_input_has_paths_from_here(self):
        self.make_shapes(2)
        text = (self.folder / "shapes.csv").read_bytes()
        self.batch("a.csv")
        self.rholm("batch", "-", "-o", "b.csv", "--no-times", "--", "--degree", 4, stdin=text)
        self.assertEqual((self.folder / "a.csv").read_bytes(), (self.folder / "b.csv").read_bytes())

    def test_paths_are_beside_the_manifest(self):
        self.make_shapes(2)
        (self.folder / "list").mkdir()
        self.write("list/m.csv", "path,file\n../s/000.ply,x\n")
        self.rholm("batch", "list/m.csv", "--command", "info", "-o", "r.csv")
        self.assertEqual(self.table("r.csv")[0]["exit_code"], "0")

    def test_a_column_of_the_manifest_keeps_its_name(self):
        self.make_shapes(1)
        self.write("m.csv", "path,area,weld\ns/000.ply,large,no\n")
        self.rholm("batch", "m.csv", "--command", "info", "-o", "r.csv")
        row = self.table("r.csv")[0]
        self.assertEqual(row["area"], "large")
        self.assertGreater(float(row["info.area"]), 0)

    def test_strict_and_json(self):
        rows = self.make_shapes(2)
        result = self.batch("a.csv", "--strict", "--json", code=3)
        self.assertEqual(result.json()["rows"], len(rows))
        self.assertEqual(result.json()["failed"], len(rows) - 2)
        self.assertEqual(len(self.table("a.csv")), len(rows))
        self.assertEqual(self.batch("b.csv", "--quiet").err, "")
        self.assertEqual(self.batch("b.csv", "--quiet").out, "")


    def test_a_terminal_sees_how_far_it_is(self):
        self.rholm("make", "bumpy", "--subdivisions", 4, "--quiet", "-o", "a.ply")
        lines = [f"{i},a.ply" for i in range(20)] + ["lost,lost.ply"]
        self.write("shapes.csv", "\n".join(["id,path", "lost first,lost.ply", *lines]) + "\n")
        words = [RHOLM, "batch", "shapes.csv", "-o", "r.csv", "--threads", "1", "--", "--degree", "16"]
        terminal = Terminal(words, self.folder, {"NO_COLOR": "1"})
        said = terminal.read(["r.csv: 22 rows, 2 failed"])
        self.assertRegex(said, r"\d+ of 22, 1 failed, \d+ (s|min) left")
        self.assertIn("r.csv: 22 rows, 2 failed", said)
        terminal.close()

    def test_shards_with_times_are_merged(self):
        rows = self.make_shapes(3)
        for i in (1, 2):
            self.rholm("batch", "shapes.csv", "-o", f"{i}.h5", "--shard", f"{i}/2", "--", "--degree", 4)
            self.rholm("batch", "shapes.csv", "-o", f"{i}.csv", "--shard", f"{i}/2", "--", "--degree", 4)
        self.rholm("batch", "shapes.csv", "--merge", "-o", "all.csv", "1.csv", "2.csv")
        self.rholm("batch", "shapes.csv", "--merge", "-o", "all.h5", "1.h5", "2.h5")
        self.batch("plain.csv")
        table = self.table("all.csv")
        self.assertTrue(all(float(row["seconds"]) > 0 for row in table))
        rest = [{k: v for k, v in row.items() if not OF_THE_RUN & set(k.split("."))} for row in table]
        self.assertEqual(rest, self.table("plain.csv"))
        self.assertEqual(len(table), len(rows))


class SameBytes(BatchTest):
    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def test_for_any_number_of_threads(self):
        self.make_shapes(6)
        for extension in ("csv", "h5"):
            for threads in (1, 2, 3):
                self.batch(f"{threads}.{extension}", "--threads", threads)
            self.assertEqual(self.bytes_of(f"1.{extension}"), self.bytes_of(f"2.{extension}"))
            self.assertEqual(self.bytes_of(f"1.{extension}"), self.bytes_of(f"3.{extension}"))

    def test_of_shards_that_are_merged(self):
        rows = self.make_shapes(3)
        for extension in ("csv", "h5"):
            self.batch(f"all.{extension}", "--coefficients")
            for n in (2, len(rows) + 1):
                parts = [f"part-{i}.{extension}" for i in range(1, n + 1)]
                for i, part in enumerate(parts):
                    self.batch(part, "--shard", f"{i + 1}/{n}", "--coefficients")
                if extension == "csv":
                    self.assertEqual([r["id"] for r in self.table(parts[1])],
                                     [r[0] for r in rows[1::n]])
                self.rholm("batch", "shapes.csv", "--merge", "-o", f"merged.{extension}", *reversed(parts))
                self.assertEqual(self.bytes_of(f"merged.{extension}"), self.bytes_of(f"all.{extension}"))
            self.rholm("batch", "shapes.csv", "--merge", "-o", f"bad.{extension}", *parts[1:], code=3)
            self.rholm("batch", "shapes.csv", "--merge", "-o", f"bad.{extension}", *parts, parts[0], code=3)
            self.assertFalse((self.folder / f"bad.{extension}").exists())
        self.batch("other.h5", "--shard", "1/2", degree=5)
        self.batch("part.h5", "--shard", "2/2")
        result = self.rholm("batch", "shapes.csv", "--merge", "-o", "bad.h5", "other.h5", "part.h5", code=3)
        self.assertIn("different jobs", result.err)
        self.rholm("batch", "shapes.csv", "--merge", "-o", "bad.csv", "other.h5", code=2)
        self.rholm("batch", "shapes.csv", "--merge", "-o", "bad.h5", code=2)

    def test_with_times_all_but_their_columns(self):
        self.make_shapes(3)
        self.batch("a.csv")
        self.rholm("batch", "shapes.csv", "-o", "b.csv", "--", "--degree", 4)
        for a, b in zip(self.table("a.csv"), self.table("b.csv"), strict=True):
            rest = {k: v for k, v in b.items() if not OF_THE_RUN & set(k.split("."))}
            self.assertEqual(rest, a)
            self.assertIn("seconds.read", b)


class Interrupted(BatchTest):
    """Runs that are ended while rows wait for a writer: all rows before them are done then, and the run
    lasts until it is ended."""

    THREADS = 2

    @contextlib.contextmanager
    def started(self, rows, done, out="k.h5"):
        """Starts a run in which `done` rows are finished and no other row can finish."""
        waiting = [self.folder / path for _, path, _ in rows[done:]]  # one of the files does not exist
        for path in waiting:
            if path.is_file():
                path.rename(path.with_suffix(".kept"))
            os.mkfifo(path)
        try:
            process = subprocess.Popen([RHOLM, "batch", "shapes.csv", "-o", out, "--no-times", "--threads",
                                        str(self.THREADS), "--", "--degree", "4"], cwd=self.folder,
                                       stderr=subprocess.PIPE)
            until(lambda: rows_done(self.folder / f"{out}.journal") == done, f"{done} rows are done", process)
            yield process
        finally:
            process.kill()
            process.wait()
            process.stderr.close()
            for path in waiting:
                path.unlink()
                if path.with_suffix(".kept").exists():
                    path.with_suffix(".kept").rename(path)

    def test_killed_at_any_moment_it_goes_on_and_gives_the_same_bytes(self):
        rows = self.make_shapes(8)
        self.batch("all.h5")
        wanted = (self.folder / "all.h5").read_bytes()
        for done in (1, 5, 8):
            with self.started(rows, done) as process:
                process.kill()
            self.assertEqual(rows_done(self.folder / "k.h5.journal"), done)
        with open(self.folder / "k.h5.journal", "ab") as file:
            file.write(b"\x40\0\0\0torn")
        result = self.batch("k.h5")
        self.assertIn("are incomplete", result.err)
        self.assertIn("8 rows already done", result.err)
        self.assertEqual((self.folder / "k.h5").read_bytes(), wanted)
        self.assertFalse((self.folder / "k.h5.journal").exists())
        self.assertEqual(len(rows), 14)

    def test_ctrl_c_keeps_the_journal_and_says_how_to_go_on(self):
        rows = self.make_shapes(8)
        with self.started(rows, 6) as process:
            process.send_signal(signal.SIGINT)
            err = process.communicate(timeout=TIMEOUT)[1].decode()
            self.assertEqual(process.returncode, 130, err)
        self.assertIn("interrupted: 6 of 14 rows are stored in k.h5.journal; run the same command again", err)
        self.assertFalse((self.folder / "k.h5").exists())
        result = self.batch("k.h5", degree=5, code=3)
        self.assertIn("journal of another job", result.err)
        self.batch("k.h5", "--shard", "1/2", code=3)
        self.batch("k.h5", "--restart", degree=5)
        self.batch("k.h5")
        self.batch("all.h5")
        self.assertEqual((self.folder / "k.h5").read_bytes(), (self.folder / "all.h5").read_bytes())

    def test_another_manifest_is_another_job(self):
        rows = self.make_shapes(10)
        with self.started(rows, 8, "k.csv") as process:
            process.kill()
        text = (self.folder / "shapes.csv").read_text()
        self.write("shapes.csv", text.replace("bad", "worse", 1))
        self.assertIn("another job", self.batch("k.csv", code=3).err)
        self.write("shapes.csv", text)
        self.batch("k.csv")


class Refusals(BatchTest):
    def test_manifests(self):
        for text, words in (("", "empty"), ("file\na\n", "no column 'path'"), ("path\n", "no shapes"),
                            ("path\na\na\n", "line 3"), ("id,path\n1,a\n1,b\n", "the id '1'"),
                            ("path\n\"a\n", "never closed"), ("path\na\"b\n", "a quote within"),
                            ("path,x\na\n", "1 fields"), ("path,message\na,b\n", "of their own"),
                            ("path\n" + "x" * 70000 + "\n", "more than 65536 bytes"),
                            (b"path\n\xff\n", "UTF-8")):
            self.write("shapes.csv", text)
            self.assertIn(words, self.batch("r.csv", code=3).err)
            self.assertEqual(self.files(), ["shapes.csv"])
        self.rholm("batch", "none.csv", "-o", "r.csv", "--", "--degree", 4, code=1)

    def test_command_lines(self):
        self.write("shapes.csv", "path\nmissing.ply\n")
        for words in (["-o", "r.csv", "--command", "frobnicate"], ["-o", "r.csv", "--command", "compare"],
                      ["-o", "r.csv", "--command", "make"], ["-o", "r.txt"], ["-o", "-"], [],
                      ["-o", "r.csv", "--", "--frobnicate"], ["-o", "r.csv", "--", "--degree", "x"],
                      ["-o", "r.csv", "--", "--degree", "-1"], ["-o", "r.csv", "--"],
                      ["-o", "r.csv", "--", "--degree", "4", "more.ply"],
                      ["-o", "r.csv", "--", "--degree", "4", "--tolerance", "1"],
                      ["-o", "r.csv", "--", "--degree", "4", "-o", "x.h5"],
                      ["-o", "r.csv", "--", "--degree", "4", "--json"],
                      ["-o", "r.csv", "--", "--degree", "4", "--format", "png"],
                      ["-o", "r.csv", "--command", "reconstruct", "--", "--model", "m.h5"],
                      ["-o", "r.csv", "--command", "info", "--outputs", "d"],
                      *(["-o", "r.csv", "--shard", s, "--", "--degree", "4"]
                        for s in ("0/2", "3/2", "2", "a/b", "1/2/3", "1/0"))):
            with self.subTest(words):
                self.rholm("batch", "shapes.csv", *words, code=2)
                self.assertEqual(self.files(), ["shapes.csv"])

    def test_results_that_cannot_be_written(self):
        self.write("shapes.csv", "path\nmissing.ply\n")
        self.rholm("batch", "shapes.csv", "-o", "none/r.csv", "--command", "info", code=1)
        (self.folder / "r.csv").mkdir()
        self.rholm("batch", "shapes.csv", "-o", "r.csv", "--command", "info", code=1)

    def test_a_shape_called_minus_is_a_file(self):
        self.write("shapes.csv", "path\n-\n")
        self.rholm("batch", "shapes.csv", "-o", "r.csv", "--command", "info", stdin=b"path\n")
        self.assertEqual(self.table("r.csv")[0]["exit_code"], "1")


if __name__ == "__main__":
    main()
