"""rholm-mpi expand gives the bytes of rholm expand on any number of ranks; how runs end."""

import json
import os
import signal
import struct
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness_mpi import NIGHTLY, ProgramTest, RANKS, RHOLM, RHOLM_MPI, held, main, nightly, nightly_too


class Expand(ProgramTest):
    every_way = False

    def check_same(self, *words, ranks=RANKS, threads=(1, 2), code=0):
        """Compares the file, and the report except for its times."""
        one = self.rholm("expand", *words, "--json", "-o", "one.h5", code=code)
        for n in ranks:
            for t in threads if self.every_way else threads[n % len(threads):][:1]:
                run = self.finished(RHOLM_MPI, "expand", *words, "--json", "-o", "all.h5", "--threads", t, ranks=n)
                self.assertEqual(run.code, code, run)
                self.assertEqual(self.bytes("all.h5"), self.bytes("one.h5"), f"{words} on {n} ranks")
                reports = [json.loads(text) for text in (one.stdout, run.stdout)]
                for report in reports:
                    for key in ("output", "seconds", "cpu_seconds", "peak_memory_bytes"):
                        report.pop(key)
                self.assertEqual(*reports)
                (self.folder / "all.h5").unlink()
        return json.loads(one.stdout)


class SameBytes(Expand):
    def test_of_a_mesh_where_it_lies(self):
        self.make("mesh.ply", "bumpy", "--subdivisions", 6)
        for words in (("--degree", 24), ("--degree", 24, "--precision", 1e-3), ("--tolerance", 1e-3)):
            self.check_same("mesh.ply", *words)
        self.assertGreater(self.exchanged("expand", "mesh.ply", "--degree", 24, "-o", "all.h5"), 2e4)

    def test_of_a_mesh_that_is_read(self):
        self.make("mesh.obj", "bumpy", "--subdivisions", 6)
        self.check_same("mesh.obj", "--degree", 100, "--no-errors", ranks=(1, 3))
        self.assertGreater(self.exchanged("expand", "mesh.obj", "--degree", 100, "-o", "all.h5"), 2e4)

    def test_of_a_mesh_that_is_changed_first(self):
        self.make("mesh.ply", "bumpy", "--subdivisions", 5)
        self.rholm("convert", "mesh.ply", "mesh.off")
        lines = (self.folder / "mesh.off").read_text().splitlines()
        turned = [line if not line.startswith("3 ") or len(line.split()) != 4
                  else "3 {2} {1} {0}".format(*line.split()[1:]) for line in lines]
        (self.folder / "inward.off").write_text("\n".join(turned) + "\n")
        report = self.check_same("inward.off", "--degree", 16, ranks=(1, 3), threads=(1,))
        self.assertTrue(report["flipped"])

    def test_of_a_small_mesh_on_many_ranks(self):
        self.make("mesh.ply", "bumpy", "--subdivisions", 1)
        self.check_same("mesh.ply", "--degree", 4, ranks=(4,))

    def test_of_standard_input_on_one_rank(self):
        self.make("mesh.ply", "bumpy", "--subdivisions", 3)
        self.rholm("expand", "mesh.ply", "--degree", 8, "-o", "one.h5")
        with open(self.folder / "mesh.ply", "rb") as mesh:
            run = subprocess.run([RHOLM_MPI, "expand", "-", "--degree", "8", "-o", "all.h5"], cwd=self.folder,
                                 stdin=mesh, capture_output=True)
        self.assertEqual(run.returncode, 0, run)
        self.assertEqual(self.bytes("all.h5"), self.bytes("one.h5"))

    def test_a_tolerance_that_is_not_kept_is_told_with_exit_code_4(self):
        self.make("mesh.ply", "bumpy", "--subdivisions", 6)
        self.check_same("mesh.ply", "--tolerance", 1e-9, "--max-degree", 8, ranks=(1, 2), threads=(1,), code=4)


@nightly
class SameBytesInEveryWay(SameBytes):
    """Runs any number of threads with any number of ranks."""

    every_way = True


class Refused(Expand):
    def check(self, words, code, says, ranks=3):
        run = self.finished(RHOLM_MPI, *words, ranks=ranks)
        self.assertEqual(run.code, code, run)
        self.assertEqual(len(self.errors(run)), 1, run)
        self.assertIn(says, self.errors(run)[0])
        self.assertFalse((self.folder / "o.h5").exists())

    def test_what_ranks_do_not_share(self):
        self.make("mesh.ply", "bumpy", "--subdivisions", 3)
        for words in (("--weld", "1e-3"), ("--method", "gauge"), ("--engine", "direct"),
                      ("--method", "monte-carlo-edge"), ("--samples", "4")):
            self.check(("expand", "mesh.ply", "--degree", 8, "-o", "o.h5", *words), 2, words[0])

    def test_standard_input_on_several_ranks(self):
        self.check(("expand", "-", "--degree", 8, "-o", "o.h5"), 2, "standard input can be read by one rank alone")
        os.mkfifo(self.folder / "pipe.ply")
        self.check(("expand", "pipe.ply", "--degree", 8, "-o", "o.h5"), 2, "pipe.ply can be read by one rank alone")

    def test_an_output_that_cannot_be_written(self):
        self.make("mesh.ply", "bumpy", "--subdivisions", 3)
        self.check(("expand", "mesh.ply", "--degree", 8, "-o", "none/o.h5"), 1, "none/o.h5")

    def test_files_that_no_rank_can_use(self):
        self.make("mesh.ply", "bumpy", "--subdivisions", 6)
        whole = self.bytes("mesh.ply")
        head = whole.index(b"end_header\n") + len(b"end_header\n")
        row = 24 if b"double x" in whole else 12
        numbers = "<ddd" if row == 24 else "<fff"
        files = {"missing.ply": None, "empty.ply": b"", "short.ply": whole[:-100],
                 "nan.ply": whole[:head] + struct.pack(numbers, float("nan"), 0, 0) + whole[head + row:],
                 "index.ply": whole[:-4] + struct.pack("<i", 10**6)}
        for name, data in files.items():
            if data is not None:
                (self.folder / name).write_bytes(data)
            words = ("expand", name, "--degree", 8, "-o", "o.h5")
            alone = subprocess.run([RHOLM, *[str(w) for w in words]], cwd=self.folder, capture_output=True, text=True)
            self.assertGreater(alone.returncode, 0)
            message = alone.stderr.strip().splitlines()[-1].split(": error: ")[-1]
            self.check(words, alone.returncode, message)

    def test_a_file_that_is_bad_on_one_rank(self):
        self.make("mesh.ply", "bumpy", "--subdivisions", 7)
        self.make("other.ply", "bumpy", "--subdivisions", 7, "--seed", 9)
        whole = self.bytes("mesh.ply")
        head = whole.index(b"end_header\n")
        cases = ((None, 1, "mesh.ply"), (whole[:-1000], 3, "mesh.ply"), (whole[:head // 2], 3, "mesh.ply"),
                 (self.bytes("other.ply"), 3, "mesh.ply is not the file of that name"))
        for data, code, says in cases:
            for rank in range(3):
                (self.folder / str(rank)).mkdir(exist_ok=True)
                (self.folder / str(rank) / "mesh.ply").write_bytes(whole)
            bad = self.folder / "2" / "mesh.ply"
            bad.unlink()
            if data is not None:
                bad.write_bytes(data)
            run = self.apart(RHOLM_MPI, "expand", "mesh.ply", "--degree", 16, "-o", "o.h5", ranks=3)
            self.assertEqual(run.code, code, run)
            self.assertEqual(len(self.errors(run)), 1, run)
            self.assertRegex(self.errors(run)[0], r": error: rank 2 on \S+: ")
            self.assertIn(says, self.errors(run)[0])
            self.assertEqual([p.name for p in (self.folder / "0").iterdir()], ["mesh.ply"])


class Stopped(Expand):
    """Runs that end too early write nothing and leave no rank behind."""

    def setUp(self):
        super().setUp()
        self.make("mesh.ply", "bumpy", "--subdivisions", 8)

    @property
    def mark(self):
        return self.folder.with_suffix(".mark")

    def start_working(self, ranks):
        """Starts a run of some seconds: every triangle has its own nodes. A run that is done before it is
        stopped waits where its file is about to get its name."""
        self.mark.unlink(missing_ok=True)
        run = self.start(RHOLM_MPI, "expand", "mesh.ply", "--degree", 700, "--precision", 1e-13, "-o", "o.h5",
                         "--threads", 1, "--patience", 10, ranks=ranks, environment=held(self.mark, "o.h5$"))
        # Ranks open the mesh after a message of rank 0. Before MPI has started, no rank can report that it
        # stops.
        run.until(lambda: run.have_mapped("mesh.ply") or self.mark.exists(), "all ranks have the mesh")
        return run

    def check_ended(self, run, by_mpiexec=False, killed=None):
        run.wait()
        if not by_mpiexec:  # the exit code of MPICH's mpiexec is 0 then
            self.assertNotEqual(run.code, 0, run)
        left = [p.name for p in self.folder.iterdir()]
        if killed == 0 or self.mark.exists():  # a rank killed with an unnamed file leaves the file behind
            left = [name for name in left if not name.startswith(".rholm.")]
        self.assertEqual(left, ["mesh.ply"])
        self.assertEqual(run.pids(), {})

    @nightly_too
    def test_a_rank_that_is_killed_ends_the_run(self):
        for ranks, killed, worked in ((3, 0, 0.2), (2, 1, 0), (4, 2, 0.5))[:3 if NIGHTLY else 1]:
            run = self.start_working(ranks)
            begin = run.seconds_worked(killed)
            run.until(lambda: run.seconds_worked(killed) >= begin + worked, f"rank {killed} has worked")
            os.kill(run.pids()[killed], signal.SIGKILL)
            self.check_ended(run, killed=killed)

    def test_a_rank_that_is_stopped_ends_the_run(self):
        run = self.start_working(3)
        os.kill(run.pids()[2], signal.SIGSTOP)
        self.check_ended(run)
        self.assertRegex("\n".join(self.errors(run)), "rank 2")

    def test_ctrl_c_ends_the_run(self):
        def check(ranks):
            run = self.start_working(ranks)
            os.kill(run.process.pid, signal.SIGINT)
            self.check_ended(run, by_mpiexec=True)

        self.at_once(check, (1,), (3,))


if __name__ == "__main__":
    main()
