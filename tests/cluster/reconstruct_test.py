"""rholm-mpi reconstruct gives the bytes of rholm reconstruct, also after failures of ranks."""

import os
import signal
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness_mpi import NIGHTLY, ProgramTest, RANKS, RHOLM_MPI, held, main, nightly, nightly_too


class Reconstruct(ProgramTest):
    def setUp(self):
        super().setUp()
        self.make("t.ply", "torus")
        self.sample("p.ply", 4400)  # four tiles for at most four ranks
        (self.folder / "work").mkdir()

    def sample(self, name, n):
        self.rholm("make", "sample", "t.ply", "--points", n, "-o", name, "--quiet")

    def words(self, out, *more, points="p.ply", n=1100):
        return ("reconstruct", points, "--tile-points", n, "-o", out, "--work-dir", "work", "--quiet", *more)

    def errors(self, run):
        return [line for line in run.stderr.splitlines() if line.startswith("rholm") and ": error:" in line]

    def killed(self, ranks, killed, stage):
        """Runs until three parts of a stage are finished, then kills a rank. Every rank that has finished
        one more part waits with it, so that the stage cannot end."""
        mark = self.folder / "mark"
        run = self.start(RHOLM_MPI, *self.words("all.ply", "--resume", "--threads", 1), ranks=ranks,
                         environment=held(mark, f"/{stage}/", 3))
        run.until(mark.exists, f"it is in the stage {stage}")
        os.kill(run.pids()[killed], signal.SIGKILL)
        run.wait()
        mark.unlink()
        self.assertFalse((self.folder / "all.ply").exists())
        return run

    def bare(self):
        """Writes the points without normals, in the order of the file."""
        self.rholm("convert", "p.ply", "p.xyz", "--quiet")
        rows = [line.split()[:3] for line in (self.folder / "p.xyz").read_text().splitlines()
                if not line.startswith("#")]
        (self.folder / "bare.xyz").write_text("".join(" ".join(row) + "\n" for row in rows))

    @nightly_too
    def test_any_number_of_ranks_gives_the_same_bytes(self):
        self.rholm(*self.words("one.ply", "--model", "one.h5"))
        for ranks in RANKS if NIGHTLY else (1, 3):
            run = self.finished(RHOLM_MPI, *self.words("all.ply", "--threads", 1 + ranks % 2, "--model", "all.h5"),
                                ranks=ranks)
            self.assertEqual(run.code, 0, run)
            self.assertEqual(self.bytes("all.ply"), self.bytes("one.ply"))
            self.assertEqual(self.bytes("all.h5"), self.bytes("one.h5"))
            self.assertEqual(os.listdir(self.folder / "work"), [])

    def test_normals_and_open_holes_are_those_of_one_process(self):
        self.bare()
        for points, more in (("bare.xyz", ()), ("p.ply", ("--holes", "keep"))):
            self.rholm(*self.words("one.ply", *more, points=points))
            run = self.finished(RHOLM_MPI, *self.words("all.ply", *more, points=points), ranks=3)
            self.assertEqual(run.code, 0, run)
            self.assertEqual(self.bytes("all.ply"), self.bytes("one.ply"), points)

    @nightly
    def test_normals_that_contradict_each_other_are_turned_as_by_one_process(self):
        self.rholm("convert", "p.ply", "p.xyz", "--quiet")
        rows = [line.split() for line in (self.folder / "p.xyz").read_text().splitlines()
                if not line.startswith("#")]
        spoiled = (row[:3] + ([f"{-float(x)}" for x in row[3:6]] if k % 3 == 0 else row[3:6])
                   for k, row in enumerate(rows))
        (self.folder / "spoiled.xyz").write_text("".join(" ".join(row) + "\n" for row in spoiled))
        self.rholm(*self.words("one.ply", points="spoiled.xyz"))
        for ranks in RANKS:
            run = self.finished(RHOLM_MPI, *self.words("all.ply", "--threads", 1 + ranks % 2,
                                                       points="spoiled.xyz"), ranks=ranks)
            self.assertEqual(run.code, 0, run)
            self.assertEqual(self.bytes("all.ply"), self.bytes("one.ply"))

    def test_sheets_that_cross_are_refused_as_by_one_process(self):
        self.bare()
        rows = [[float(x) for x in line.split()] for line in (self.folder / "bare.xyz").read_text().splitlines()]
        least, most = min(x for x, _, _ in rows), max(x for x, _, _ in rows)
        rows = rows[::2]
        both = rows + [[x + 0.3 * (most - least), y, z] for x, y, z in rows]
        (self.folder / "both.xyz").write_text("".join(f"{x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in both))
        one = self.rholm(*self.words("one.ply", points="both.xyz"), code=4)
        self.assertIn("sheets of the points cross each other, first near (", one.stderr)
        run = self.finished(RHOLM_MPI, *self.words("all.ply", "--threads", 2, points="both.xyz"), ranks=3)
        self.assertEqual(run.code, 4, run)
        said = "sheets of" + one.stderr.split("error: sheets of")[1].rstrip("\n")
        self.assertTrue(self.errors(run)[0].endswith(said), run)
        self.assertEqual(self.bytes("all.ply"), self.bytes("one.ply"))

    def test_few_points_are_left_to_one_rank(self):
        self.rholm("reconstruct", "p.ply", "-o", "one.ply")
        run = self.finished(RHOLM_MPI, "reconstruct", "p.ply", "-o", "all.ply", ranks=2)
        self.assertEqual(run.code, 0, run)
        self.assertEqual(self.bytes("all.ply"), self.bytes("one.ply"))

    def test_a_killed_rank_costs_its_tiles_only(self):
        self.sample("p.ply", 12000)  # eight tiles
        self.rholm(*self.words("one.ply"))
        pieces = self.folder / "work" / "all.ply.tiles" / "pieces"
        for stage, ranks, killed in (("caps", 3, 2), ("grid", 2, 0), ("mesh", 4, 1)):
            run = self.killed(ranks, killed, stage)
            self.assertNotEqual(run.code, 0, run)
            self.assertGreaterEqual(len(list((pieces / stage).glob("[0-9]*"))), 3)
        run = self.finished(RHOLM_MPI, *self.words("all.ply", "--resume"), ranks=2)
        self.assertEqual(run.code, 0, run)
        self.assertEqual(self.bytes("all.ply"), self.bytes("one.ply"))
        self.assertEqual(os.listdir(self.folder / "work"), [])

    def test_what_is_wrong_is_said_once(self):
        (self.folder / "short.ply").write_bytes(self.bytes("p.ply")[:-5])
        for words, code, says in (
                (self.words("a.ply", points="short.ply"), 3, "short.ply"),
                (self.words("a.ply", points="none.ply"), 1, "none.ply"),
                (self.words("a.ply", "--max-memory", "1e-5"), 1, "--tile-points"),
                (("reconstruct", "p.ply", "--tile-points", 2000, "-o", "a.ply"), 2, "--work-dir"),
                (self.words("none/a.ply"), 1, "none/a.ply")):
            run = self.finished(RHOLM_MPI, *words, ranks=3)
            self.assertEqual(run.code, code, run)
            self.assertEqual(len(self.errors(run)), 1, run)
            self.assertIn(says, self.errors(run)[0])
            self.assertEqual(os.listdir(self.folder / "work"), [])
            self.assertFalse((self.folder / "a.ply").exists())


if __name__ == "__main__":
    main()
