"""--max-memory is kept, or refused with a larger limit that is kept, for all commands with the option,
formats and sizes. The option `--large` uses meshes of millions of faces."""

import os
import re
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, NIGHTLY, RHOLM, TIMEOUT, main, nightly_too

MIB = 1 << 20
GIB = 1 << 30
BESIDE = 32 * MIB  # allowance for the program and its libraries beyond the limit
LARGE = "--large" in sys.argv
if LARGE:
    sys.argv.remove("--large")


def anonymous(pid):
    """Returns the memory of a process in bytes, without pages of files."""
    try:
        with open(f"/proc/{pid}/status", encoding="ascii") as status:
            return 1024 * int(re.search(r"RssAnon:\s+(\d+)", status.read())[1])
    except (OSError, TypeError):
        return 0  # the process has ended


# Commands that have --max-memory, for a mesh and for points.
OF_MESHES = ("info {}", "convert {} out.ply", "convert {} out.obj", "compare {} {} --samples 1000",
             "expand {} --degree 8 -o out.h5", "expand {} --degree 8 --weld 1e-9 -o out.h5")
OF_POINTS = ("info {}", "convert {} out.xyz", "convert {} out.off", "reconstruct {} -o out.ply",
             "reconstruct {} -o out.ply --tile-points 10000")


@unittest.skipIf(os.environ.get("RHOLM_TEST_SANITIZED") == "1",
                 "sanitizers have memory of their own")
class Limits(CliTest):
    def peak(self, words, limit):
        """Runs with that limit (GiB); returns exit code, message and the largest memory."""
        with open(self.folder / "err", "wb") as err:
            process = subprocess.Popen([RHOLM, *words, "--threads", "2", "--max-memory", str(limit)],
                                       cwd=self.folder, stdout=subprocess.DEVNULL, stderr=err)
            most = 0
            while process.poll() is None:
                most = max(most, anonymous(process.pid))
                try:
                    process.wait(0.002)
                except subprocess.TimeoutExpired:
                    pass
        return process.returncode, (self.folder / "err").read_text(), most

    def check(self, line, limit):
        """Returns true if the command succeeded within the limit."""
        with self.subTest(line, limit=limit):
            code, said, most = self.peak(line.split(), limit)
            self.assertLessEqual(most, limit * GIB + BESIDE, (line, limit, said))
            self.assertIn(code, (0, 1), said)
            if code == 0:
                return True
            # A refused command names the limit that suffices, and this limit does suffice.
            wanted = re.search(r"max-memory: ([\d.e+-]+) would do", said)
            if wanted:
                enough = float(wanted[1])
                self.assertGreater(enough, limit)
                code, said, most = self.peak(line.split(), enough)
                again = re.search(r"max-memory: ([\d.e+-]+) would do", said)
                if again:  # reading has its own limit, and later steps another
                    enough = float(again[1])
                    code, said, most = self.peak(line.split(), enough)
                self.assertEqual(code, 0, (line, enough, said))
                self.assertLessEqual(most, enough * GIB + BESIDE)
            elif fits := re.search(r"--tile-points (\d+)", said):
                if wanted := re.search(r"need some ([\d.e+-]+) GiB", said):  # the limit for tiles
                    self.assertEqual(self.peak(line.split(), float(wanted[1]))[0], 0, (line, said))
                # The named tiles fit into the limit, or into the limit named with them.
                words = re.sub(r" --tile-points \d+", "", line).split() + ["--tile-points", fits[1]]
                wanted = re.search(r"([\d.e+-]+) GiB would do for tiles", said)
                enough = float(wanted[1]) if wanted else limit
                code, said, most = self.peak(words, enough)
                self.assertEqual(code, 0, (words, enough, said))
                self.assertLessEqual(most, enough * GIB + BESIDE)
            else:
                self.assertRegex(said, "GiB|step")
        return False

    def sweep(self, meshes, points, limits):
        done = {True: 0, False: 0}
        for lines, names in ((OF_MESHES, meshes), (OF_POINTS, points)):
            for line in lines:
                for name in names:
                    for limit in limits:
                        done[self.check(line.format(name, name), limit)] += 1
        # Both outcomes must occur, or the limits test nothing.
        self.assertGreater(done[True], 0)
        self.assertGreater(done[False], 0)

    def files_of(self, subdivisions, points):
        self.rholm("make", "sphere", "--subdivisions", subdivisions, "-o", "mesh.ply")
        for name, options in (("mesh.obj", []), ("mesh.off", []), ("mesh.stl", []),
                              ("text.ply", ["--ascii"])):
            self.rholm("convert", "mesh.ply", name, *options)
        self.rholm("make", "sample", "mesh.ply", "--points", points, "-o", "points.ply")
        self.rholm("convert", "points.ply", "points.xyz")
        return ("mesh.ply", "mesh.obj", "mesh.off", "mesh.stl", "text.ply"), ("points.ply",
                                                                              "points.xyz")

    @unittest.skipIf(LARGE, "the large ones")
    def test_what_would_go_far_beyond_is_refused(self):
        self.rholm("make", "sphere", "--subdivisions", "7", "-o", "mesh.ply")
        self.rholm("convert", "mesh.ply", "mesh.stl")
        # The commands need 110, 55 and 70 MiB.
        self.assertFalse(self.check("compare mesh.stl mesh.stl --samples 1000", 0.02))
        self.assertFalse(self.check("info mesh.stl", 0.003))
        self.assertFalse(self.check("expand mesh.stl --degree 8 -o out.h5", 0.01))
        self.assertTrue(self.check("info mesh.ply", 0.003))  # mapped in place
        self.assertTrue(self.check("info mesh.stl", 0.1))

    @nightly_too
    @unittest.skipIf(LARGE, "the large ones")
    def test_a_limit_little_above_what_text_takes_is_enough(self):
        self.rholm("make", "sphere", "--subdivisions", 7 if NIGHTLY else 6, "-o", "mesh.ply")
        n = 163842 if NIGHTLY else 40962
        rows = self.rholm("convert", "mesh.ply", "-", "--format", "obj").out.splitlines()
        vertices, faces = rows[:n], rows[n:]
        self.assertTrue(vertices[-1].startswith("v ") and faces[0].startswith("f "))
        texts = {"plain.obj": vertices + faces,
                 # Files with all faces before all vertices, and with both alternating.
                 "faces.obj": faces + vertices,
                 "mixed.obj": [line for i in range(len(faces)) for line in
                               vertices[i:i + 1] + faces[i:i + 1]],
                 "normals.obj": [line for v in vertices for line in (v, "vn" + v[1:])] + faces,
                 "squares.obj": vertices + [f"{f} {1 + (int(f.split()[1]) + 99) % n}" for f in faces]}
        for name, lines in texts.items():
            (self.folder / name).write_text("\n".join(lines) + "\n")
        for name in ("mesh.off", "text.ply", "text.stl"):
            self.rholm("convert", "mesh.ply", name, *["--ascii"] * (name != "mesh.off"))
        for name in (*texts, "mesh.off", "text.ply", "text.stl"):
            line = f"convert {name} out.ply"
            # Memory is sampled, and a sample may come too late: a case that fails is measured again.
            most = 0
            for _ in range(5):
                most = max(most, self.peak(line.split(), 4)[2])
                limit = 1.3 * most / GIB
                code, said, used = self.peak(line.split(), limit)
                if code == 0:
                    break
            with self.subTest(name, peak=most):
                self.assertEqual(code, 0, said)
                self.assertLessEqual(used, limit * GIB + BESIDE)

    @nightly_too
    @unittest.skipIf(LARGE, "the large ones")
    def test_tiles_are_refused_with_a_limit_and_a_size_that_are_enough(self):
        points, tile, limits_of_tiles, limits = 8000, 6000, [0.006], [0.006]
        if NIGHTLY:
            points, tile = 60000, 10000
            limits_of_tiles, limits = [0.006, 0.01, 0.015], [0.003, 0.006, 0.01, 0.02, 0.04]
        self.rholm("make", "sphere", "--subdivisions", "5", "-o", "mesh.ply")
        self.rholm("make", "sample", "mesh.ply", "--points", points, "-o", "points.ply")
        line = f"reconstruct points.ply -o out.ply --tile-points {tile}"
        refused = self.peak(line.split(), 0.006)
        self.assertRegex(refused[1], r"need some [\d.]+ GiB")
        for limit in limits_of_tiles:
            self.assertFalse(self.check(line, limit))  # also tries the limit that is named
        for limit in limits:
            self.assertFalse(self.check("reconstruct points.ply -o out.ply", limit))
        self.assertTrue(self.check("reconstruct points.ply -o out.ply", 0.1))

    @unittest.skipIf(LARGE, "the large ones")
    def test_nothing_is_refused_where_no_limit_was_said(self):
        self.rholm("make", "sphere", "--subdivisions", "4", "-o", "mesh.ply")
        for line in OF_MESHES:
            self.rholm(*line.format("mesh.ply", "mesh.ply").split())

    @unittest.skipUnless(LARGE, "--large")
    def test_small_middle_and_large_shapes(self):
        for subdivisions, points, limits in ((5, 20000, (0.001, 0.02)),
                                             (8, 300000, (0.03, 0.1, 0.3)),
                                             (9, 3000000, (0.1, 0.4))):
            self.sweep(*self.files_of(subdivisions, points), limits)


if __name__ == "__main__":
    main()
