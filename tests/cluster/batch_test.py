"""rholm-mpi batch gives the bytes of rholm batch on any number of ranks, also after interrupted runs."""

import csv
import io
import itertools
import os
import signal
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness_mpi import NIGHTLY, MpiTest, RANKS, RHOLM, RHOLM_MPI, main, nightly, nightly_too, rows_done


class Batch(MpiTest):
    def rholm(self, *words):
        return subprocess.run([RHOLM, *[str(w) for w in words]], cwd=self.folder, check=True, capture_output=True)

    def make_shapes(self, n):
        """Makes shapes, some of them not star-shaped, and writes shapes.csv."""
        (self.folder / "s").mkdir()
        rows = []
        for i in range(n):
            self.rholm("make", "bumpy", "--subdivisions", 3 + i % 2, "--seed", i,
                       "--quiet", "-o", f"s/{i:03}.ply")
            rows.append((f"shape {i}", f"s/{i:03}.ply", "good"))
        (self.folder / "s" / "empty.ply").write_bytes(b"")
        (self.folder / "s" / "short.ply").write_bytes((self.folder / "s" / "000.ply").read_bytes()[:-50])
        for k, name in enumerate(("empty.ply", "short.ply", "missing.ply")):
            rows.insert(4 * k + 1, (name, f"s/{name}", "bad"))
        text = io.StringIO()
        csv.writer(text).writerows([("id", "path", "group"), *rows])
        (self.folder / "shapes.csv").write_text(text.getvalue())
        return rows

    def words(self, out, *more, degree=6):
        return ("batch", "shapes.csv", "-o", out, "--no-times", *more, "--", "--degree", degree)

    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def check_no_litter(self, *expected):
        left = {p.name for p in self.folder.iterdir()} - {"s", "shapes.csv", *expected}
        self.assertEqual(left, set())


class SameBytes(Batch):
    every_way = False

    def test_any_number_of_ranks_and_threads_gives_the_bytes_of_one_process(self):
        rows = self.make_shapes(10)
        for out in ("one.h5", "one.csv"):
            self.rholm(*self.words(out))
        # Formats are combined with numbers of threads; rank 0 writes the format from its rows.
        ways = ((1, 1, "all.h5"), (2, 2, "all.csv"), (3, 2, "all.h5"), (4, 1, "all.csv"))
        if self.every_way:
            ways = itertools.product(RANKS, (1, 2), ("all.h5", "all.csv"))
        for ranks, threads, out in ways:
            run = self.finished(RHOLM_MPI, *self.words(out, "--threads", threads), ranks=ranks)
            self.assertEqual(run.code, 0, run)
            self.assertEqual(self.errors(run), [], run)
            self.assertEqual(run.stderr.count(f"{len(rows)} rows, 3 failed"), 1, run)
            self.assertEqual(self.bytes(out), self.bytes(out.replace("all", "one")), run)
        self.check_no_litter("one.h5", "one.csv", "all.h5", "all.csv")

    def test_outputs_are_written_by_all_ranks(self):
        self.make_shapes(12)
        self.rholm(*self.words("one.csv", "--outputs", "one"))
        run = self.finished(RHOLM_MPI, *self.words("all.csv", "--outputs", "all"), ranks=3)
        self.assertEqual(run.code, 0, run)
        names = sorted(p.name for p in (self.folder / "one").iterdir())
        self.assertEqual(len(names), 12)
        self.assertEqual(sorted(p.name for p in (self.folder / "all").iterdir()), names)
        for name in names:
            self.assertEqual(self.bytes(f"one/{name}"), self.bytes(f"all/{name}"))

    def test_shards_merge_to_one_run(self):
        self.make_shapes(10)
        self.rholm(*self.words("one.h5"))
        for i in (1, 2):
            run = self.finished(RHOLM_MPI, *self.words(f"{i}.h5", "--shard", f"{i}/2"), ranks=2)
            self.assertEqual(run.code, 0, run)
        run = self.finished(RHOLM_MPI, "batch", "shapes.csv", "--merge", "-o", "all.h5", "1.h5", "2.h5", ranks=3)
        self.assertEqual(run.code, 0, run)
        self.assertEqual(self.bytes("all.h5"), self.bytes("one.h5"))

    @nightly
    def test_a_large_file_has_all_threads_of_a_rank(self):
        (self.folder / "s").mkdir()
        self.rholm("make", "bumpy", "--subdivisions", 9, "--quiet", "-o", "s/large.ply")  # 100 MB
        self.rholm("make", "bumpy", "--subdivisions", 2, "--quiet", "-o", "s/small.ply")
        (self.folder / "shapes.csv").write_text("path\ns/small.ply\ns/large.ply\n")
        words = ("batch", "shapes.csv", "--command", "info", "--no-times", "-o")
        self.rholm(*words, "one.csv")
        run = self.finished(RHOLM_MPI, *words, "all.csv", "--threads", 2, ranks=2)
        self.assertEqual(run.code, 0, run)
        self.assertEqual(self.bytes("all.csv"), self.bytes("one.csv"))


@nightly
class SameBytesInEveryWay(SameBytes):
    """Runs any number of threads with any number of ranks."""

    every_way = True


class Usage(Batch):
    def check(self, words, code, says):
        run = self.finished(RHOLM_MPI, *words, ranks=3)
        self.assertEqual(run.code, code, run)
        self.assertEqual(len(self.errors(run)), 1 if code else 0, run)
        self.assertEqual((run.stdout + run.stderr).count(says), 1, run)
        return run

    def test_one_rank_speaks(self):
        self.make_shapes(2)
        self.check(("--version",), 0, "rholm-mpi ")
        self.check(("--help",), 0, "Usage: rholm-mpi COMMAND")
        self.check(("help", "batch"), 0, "Usage: rholm-mpi batch MANIFEST")
        self.check(("analyse",), 2, "there is no command 'analyse'; 'rholm expand' computes coefficients")
        self.check(("batch", "shapes.csv", "-o", "r.csv", "--fast"), 2, "Try 'rholm-mpi batch --help'")
        self.check(("batch", "none.csv", "--command", "info", "-o", "r.csv"), 1, "none.csv")
        self.check(self.words("none/r.csv"), 1, "none/r.csv")
        self.check(self.words("r.csv", "--patience", 0), 2, "--patience")
        self.check_no_litter()

    def test_failed_rows_fail_the_run_if_strict(self):
        self.make_shapes(2)
        run = self.check(self.words("r.csv", "--strict"), 3, "3 of 5 rows failed; the results are written")
        self.assertNotIn("goes on from there", run.stderr)

    def test_timings_count_what_ranks_exchange(self):
        self.make_shapes(5)
        run = self.check(self.words("r.csv", "--timings"), 0, "3 ranks: ")
        self.assertRegex(run.stderr, r"3 ranks: [\d.]+ s of processors, .* MB in \d+ messages")


class Stopped(Batch):
    """Runs that end too early and are continued. From some row on, all shapes wait for a writer: the rows
    before it are done then, and the run lasts until it is stopped."""

    ROWS = 16

    def setUp(self):
        super().setUp()
        self.rows = self.make_shapes(self.ROWS)
        self.rholm(*self.words("one.h5", degree=24))

    def rows_done(self):
        return rows_done(self.folder / "all.h5.journal")

    def stopped_at(self, share, ranks, stop):
        """Returns a run after stop(run), which is called when that share of the rows is done."""
        done = int(share * len(self.rows))
        waiting = [self.folder / path for _, path, _ in self.rows[done:]]  # one of the files does not exist
        for path in waiting:
            if path.is_file():
                path.rename(path.with_suffix(".kept"))
            os.mkfifo(path)
        run = self.start(RHOLM_MPI, *self.words("all.h5", "--patience", 10, "--threads", 1, degree=24), ranks=ranks)
        run.until(lambda: self.rows_done() == done, f"{done} rows are done")
        stop(run)
        run.wait()
        for path in waiting:
            path.unlink()
            if path.with_suffix(".kept").exists():
                path.with_suffix(".kept").rename(path)
        self.assertEqual(self.rows_done(), done)
        return run

    def check_stopped(self, run, says=None, by_mpiexec=False):
        if not by_mpiexec:  # the exit code of MPICH's mpiexec is 0 then
            self.assertNotEqual(run.code, 0, run)
        self.assertFalse((self.folder / "all.h5").exists())
        if says is not None:
            self.assertEqual(len(self.errors(run)), 1, run)
            self.assertRegex(self.errors(run)[0], says)

    def check_went_on(self, before, stderr):
        self.assertRegex(stderr, rf"{before} rows? already done")
        self.assertEqual(self.bytes("all.h5"), self.bytes("one.h5"))
        self.check_no_litter("one.h5", "all.h5")
        (self.folder / "all.h5").unlink()

    def check_goes_on_without_ranks(self):
        before = self.rows_done()
        self.check_went_on(before, self.rholm(*self.words("all.h5", degree=24)).stderr.decode())

    def check_goes_on_over_ranks(self, ranks):
        before = self.rows_done()
        run = self.finished(RHOLM_MPI, *self.words("all.h5", degree=24), ranks=ranks)
        self.assertEqual(run.code, 0, run)
        self.check_went_on(before, run.stderr)

    def test_a_killed_rank_costs_the_rows_that_were_not_done(self):
        def check(share, ranks, killed):
            run = self.stopped_at(share, ranks, lambda run: os.kill(run.pids()[killed], signal.SIGKILL))
            self.check_stopped(run)
            if killed == 0:
                self.check_goes_on_without_ranks()
            else:
                self.check_goes_on_over_ranks(2)

        self.at_once(check, (0.3, 3, 2), (0.6, 2, 0), (0.9, 4, 1))

    @nightly_too
    def test_a_rank_that_is_stopped_ends_the_run(self):
        for stopped in (0, 1) if NIGHTLY else (1,):
            run = self.stopped_at(0.1, 3, lambda run: os.kill(run.pids()[stopped], signal.SIGSTOP))
            says = rf"error: rank {stopped}\b.* has not been heard of .*"
            if stopped != 0:  # rank 0 knows the number of rows kept
                says += r"; \d+ of 19 rows are kept in all.h5.journal: the same command goes on from there$"
            self.check_stopped(run, says)
            self.check_goes_on_over_ranks(2)

    def test_ctrl_c_keeps_what_is_done(self):
        run = self.stopped_at(0.3, 3, lambda run: os.kill(run.process.pid, signal.SIGINT))
        self.check_stopped(run, by_mpiexec=True)
        self.check_goes_on_over_ranks(3)

    def test_a_rank_that_is_told_to_end_says_how_to_go_on(self):
        run = self.stopped_at(0.3, 3, lambda run: os.kill(run.pids()[1], signal.SIGTERM))
        self.check_stopped(run, r"error: interrupted; \d+ of 19 rows are kept in all.h5.journal: "
                                r"the same command goes on from there$")
        self.check_goes_on_over_ranks(2)

    def test_a_full_disk_is_said_once(self):
        (self.folder / "small").mkdir()
        words = list(self.words("small/all.h5", degree=24))
        # The results are on a separate file system in a separate name space.
        script = 'mount -t tmpfs -o size=64k none small && exec "$@"'
        if subprocess.run(["unshare", "-m", "sh", "-c", script, "sh", "true"], cwd=self.folder,
                          capture_output=True).returncode != 0:
            self.skipTest("this user may not mount")
        run = self.finished(RHOLM_MPI, *words, ranks=3, wrap=("unshare", "-m", "sh", "-c", script, "sh"))
        self.assertEqual(run.code, 1, run)
        self.assertEqual(len(self.errors(run)), 1, run)
        self.assertRegex(self.errors(run)[0], r"rank 0 on \S+: the journal small/all.h5.journal cannot be "
                                              r"written: No space left on device; \d+ of 19 rows are kept")
        self.assertEqual(list((self.folder / "small").iterdir()), [])


if __name__ == "__main__":
    main()
