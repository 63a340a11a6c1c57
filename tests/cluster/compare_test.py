"""rholm-mpi compare gives the report of rholm compare on any number of ranks; how runs end."""

import os
import signal
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness_mpi import ProgramTest, RANKS, RHOLM_MPI, main, nightly


class Compare(ProgramTest):
    every_way = False

    def setUp(self):
        super().setUp()
        self.make("a.ply", "bumpy", "--subdivisions", 6)
        self.rholm("analyze", "a.ply", "--degree", 12, "--quiet", "-o", "a.h5")

    def check_same(self, *words, ranks=RANKS, threads=(1, 2)):
        one = self.rholm("compare", *words).stdout
        for n in ranks:
            for t in threads if self.every_way else threads[n % len(threads):][:1]:
                run = self.finished(RHOLM_MPI, "compare", *words, "--threads", t, ranks=n)
                self.assertEqual(run.code, 0, run)
                self.assertEqual(run.stdout, one, f"{words} on {n} ranks")
                self.assertEqual(self.errors(run), [], run)

    def check_fails(self, run, code, says):
        self.assertEqual(run.code, code, run)
        self.assertEqual(run.stdout, "", run)
        self.assertEqual(len(self.errors(run)), 1, run)
        self.assertRegex(self.errors(run)[0], says)


class SameReport(Compare):
    def test_of_a_mesh_and_its_coefficients(self):
        self.check_same("a.ply", "a.h5", "--json")

    def test_of_two_meshes_with_all_options(self):
        self.make("b.obj", "sphere", "--subdivisions", 4)
        self.check_same("b.obj", "a.ply", "--samples", 33333, "--seed", 7, "--threshold", 0.05, ranks=(1, 3))
        self.assertGreater(self.exchanged("compare", "b.obj", "a.ply", "--samples", 33333), 16 * 33333)

    def test_of_fewer_samples_than_ranks(self):
        self.check_same("a.ply", "a.h5", "--samples", 1, "--quiet", ranks=(4,), threads=(1,))

    def test_ranks_that_read_say_nothing(self):
        self.rholm("convert", "a.h5", "a.sh")
        text = (self.folder / "a.sh").read_text()
        (self.folder / "bare.sh").write_text("".join(line for line in text.splitlines(True) if line[0] != "#"))
        run = self.finished(RHOLM_MPI, "compare", "a.ply", "bare.sh", "--samples", 10, ranks=3)
        self.assertEqual(run.code, 0, run)
        self.assertEqual(run.stderr.count("assumed"), 1, run)


@nightly
class SameReportInEveryWay(SameReport):
    """Runs any number of threads with any number of ranks."""

    every_way = True


class Failures(Compare):
    def test_files_that_no_rank_can_use(self):
        (self.folder / "short.ply").write_bytes(self.bytes("a.ply")[:-100])
        run = self.finished(RHOLM_MPI, "compare", "a.ply", "missing.ply", ranks=3)
        self.check_fails(run, 1, "missing.ply cannot be opened")
        run = self.finished(RHOLM_MPI, "compare", "short.ply", "a.ply", ranks=3)
        self.check_fails(run, 3, "short.ply")

    def test_standard_input_on_several_ranks(self):
        run = self.finished(RHOLM_MPI, "compare", "a.ply", "-", ranks=2)
        self.check_fails(run, 2, "standard input can be read by one rank alone, and there are 2")
        self.check_fails(self.finished(RHOLM_MPI, "compare", "a.ply", "a.h5", "--sample", 5, ranks=2), 2, "--sample")

    def test_a_mesh_without_area(self):
        (self.folder / "flat.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
        self.check_fails(self.finished(RHOLM_MPI, "compare", "a.ply", "flat.off", ranks=3), 3, "area 0")

    def test_a_file_that_is_bad_on_one_rank(self):
        self.make("other.ply", "bumpy", "--subdivisions", 6, "--seed", 9)
        cases = ((None, 1, "b.ply cannot be opened"), (self.bytes("a.ply")[:-100], 3, "b.ply"),
                 (self.bytes("other.ply"), 3, "a file is not the one of that name that rank 0 has"))
        for data, code, says in cases:
            for rank in range(3):
                (self.folder / str(rank)).mkdir(exist_ok=True)
                for name in ("a.ply", "b.ply"):
                    (self.folder / str(rank) / name).write_bytes(self.bytes("a.ply"))
            (self.folder / "1" / "b.ply").unlink()
            if data is not None:
                (self.folder / "1" / "b.ply").write_bytes(data)
            run = self.apart(RHOLM_MPI, "compare", "a.ply", "b.ply", ranks=3)
            self.check_fails(run, code, rf": error: rank 1 on \S+: .*{says}")

    def test_a_rank_that_dies_and_ctrl_c_end_the_run(self):
        def check(ranks, victim, what):
            run = self.start(RHOLM_MPI, "compare", "a.ply", "a.h5", "--samples", 100000000, ranks=ranks)
            run.until(lambda: len(run.pids()) == ranks, "all ranks are there")
            begin = run.seconds_worked(0)
            run.until(lambda: run.seconds_worked(0) >= begin + 0.5, "rank 0 has worked")
            os.kill(run.process.pid if victim is None else run.pids()[victim], what)
            run.wait()
            if victim is not None:  # the exit code of MPICH's mpiexec is 0 after Ctrl-C
                self.assertNotEqual(run.code, 0, run)
            self.assertNotIn("Hausdorff", run.stdout, run)  # MPICH's mpiexec writes to it, too
            self.assertEqual(run.pids(), {})

        self.at_once(check, (3, 1, signal.SIGKILL), (2, 0, signal.SIGKILL), (3, None, signal.SIGINT))


if __name__ == "__main__":
    main()
