"""Meshes larger than memory give the same results as meshes that fit."""

import os
import struct
import unittest

import limits
from harness import RHOLM, CliTest, main

MIB = 1 << 20
PLACE = ["--size", "2,1.6,1.2", "--translate", "0.1,-0.05,0.08"]
TINY = ["--max-memory", "0.001"]


class Memory(CliTest):
    def box(self, cells=40):
        self.rholm("make", "box", "--cells", cells, *PLACE, "-o", "box.ply")
        return (self.folder / "box.ply").read_bytes()

    def test_a_stream_that_does_not_fit_gives_the_bytes_of_the_file(self):
        content = self.box()
        for options in (["--degree", "16"], ["--tolerance", "0.05", "--center", "none"]):
            self.rholm("expand", "box.ply", *options, "-o", "file.sh")
            self.rholm("expand", "-", *options, "-o", "stream.sh", stdin=content)
            self.rholm("expand", "-", *options, *TINY, "--work-dir", ".", "-o", "spooled.sh",
                       stdin=content)
            expected = (self.folder / "file.sh").read_bytes()
            self.assertEqual((self.folder / "stream.sh").read_bytes(), expected)
            self.assertEqual((self.folder / "spooled.sh").read_bytes(), expected)
        self.assertEqual(self.files(), ["box.ply", "file.sh", "spooled.sh", "stream.sh"])

    def test_a_stream_that_cannot_be_kept_says_where_it_could(self):
        content = self.box()
        result = self.rholm("expand", "-", "--degree", "4", *TINY, "--work-dir", "nowhere", "-o",
                            "x.sh", code=1, stdin=content)
        self.assertIn("--work-dir", result.err)
        # A smaller mesh needs no space on disk (its work takes some 60 MiB).
        self.rholm("make", "box", *PLACE, "-o", "small.ply")
        self.rholm("expand", "-", "--degree", "4", "--max-memory", "0.1", "--work-dir", "nowhere",
                   "-o", "x.sh", stdin=(self.folder / "small.ply").read_bytes())

    def test_a_mesh_that_must_be_read_and_does_not_fit_is_refused(self):
        content = self.box(160)
        for words in (["-"], ["box.ply"]):
            result = self.rholm("expand", *words, "--degree", "4", "--weld", "1e-9",
                                "--max-memory", "0.005",
                                "--work-dir", ".", "-o", "x.sh", code=1, stdin=content)
            self.assertIn("GiB", result.err)
        self.assertRegex(result.err, r"0\.\d+ would do\. Only a binary PLY")
        self.assertEqual(self.files(), ["box.ply"])

    def test_a_truncated_or_empty_stream_is_bad_input(self):
        content = self.box()
        for some in (content[:-5], content[:100], b""):
            self.rholm("expand", "-", "--degree", "4", "--max-memory", "0.01", "--work-dir", ".",
                       "-o", "x.sh", code=3, stdin=some)

    # Standard input is read into memory; a file is mapped.
    def test_convert_writes_what_it_writes_of_a_mesh_in_memory(self):
        content = self.box()
        for name, options in (("a.ply", []), ("b.ply", ["--ascii"]), ("c.obj", []), ("d.off", []),
                              ("e.stl", []), ("f.stl", ["--ascii"])):
            self.rholm("convert", "box.ply", name, *options)
            self.rholm("convert", "-", f"read-{name}", *options, stdin=content)
            self.assertEqual((self.folder / name).read_bytes(),
                             (self.folder / f"read-{name}").read_bytes(), name)
        self.rholm("convert", "box.ply", "box.ply")  # replaces its own input
        self.assertEqual((self.folder / "box.ply").read_bytes(), content)

    def both_ways(self, source, target, *options):
        """Returns bytes and messages of a conversion in place, and of the same data read from standard
        input."""
        out = []
        for words, content in (([source, *TINY], None), (["-"], (self.folder / source).read_bytes())):
            done = self.rholm("convert", words[0], target, *words[1:], *options, stdin=content)
            out.append(((self.folder / target).read_bytes(),
                        done.err.replace("standard input", source)))
        return out

    def test_convert_writes_attributes_and_polygons_from_where_they_lie(self):
        corners = b"".join(struct.pack("<B3ff", 7 * k, k % 2, k // 2, 0.25 * k, 0.1 * k)
                           for k in range(6))
        header = (b"ply\nformat binary_little_endian 1.0\nelement vertex 6\nproperty uchar label\n"
                  b"property float x\nproperty float y\nproperty float z\nproperty float q\n"
                  b"element face 3\nproperty list uchar int vertex_indices\nend_header\n")
        faces = struct.pack("<B4iB3iB2i", 4, 0, 1, 3, 2, 3, 2, 3, 5, 2, 0, 1)
        self.write("faces.ply", header + corners + faces)
        for name, options in (("a.ply", []), ("b.ply", ["--ascii"]), ("c.obj", []), ("d.off", []),
                              ("e.stl", [])):
            lying, read = self.both_ways("faces.ply", name, *options)
            self.assertEqual(lying, read)
            self.assertIn("1 face with fewer than 3 corners", lying[1])
            if ".ply" not in name:
                self.assertIn("no room for label, q", lying[1])

    def test_convert_writes_points_as_they_are_read(self):
        self.box()
        self.rholm("make", "sample", "box.ply", "--points", "70000", "-o", "points.ply")
        self.rholm("convert", "points.ply", "text.ply", "--ascii")
        self.rholm("convert", "points.ply", "points.xyz")
        for source in ("points.ply", "text.ply", "points.xyz"):
            for target, options in (("a.ply", []), ("b.ply", ["--ascii"]), ("c.xyz", [])):
                lying, read = self.both_ways(source, target, *options)
                self.assertEqual(lying, read, (source, target))
                # A stream that is stored in a temporary file.
                content = (self.folder / source).read_bytes()
                self.rholm("convert", "-", "spooled", "--format", target[2:], *options, *TINY,
                           "--work-dir", ".", stdin=content)
                self.assertEqual((self.folder / "spooled").read_bytes(), read[0])
        # Formats that need more than one pass, and replacement of the input.
        self.assertEqual(*self.both_ways("points.ply", "d.obj"))
        before = (self.folder / "points.ply").read_bytes()
        self.rholm("convert", "points.ply", "points.ply", *TINY)
        self.assertEqual((self.folder / "points.ply").read_bytes(), before)

    def test_convert_of_coefficients_does_not_depend_on_memory(self):
        self.box(cells=2)
        self.rholm("expand", "box.ply", "--degree", "20", "-o", "box.txt")
        content = (self.folder / "box.txt").read_bytes()
        for words, text in ((["box.txt"], None), (["-"], content)):
            result = self.rholm("convert", *words, "out.ply", "--max-memory", "1e-6",
                                "--work-dir", ".", code=2, stdin=text)
            self.assertIn("synthesize", result.err)
            self.rholm("convert", *words, "out.json", "--max-memory", "1e-6", "--work-dir", ".",
                       stdin=text)

    def test_convert_of_a_damaged_stream_says_what_is_wrong(self):
        self.box()
        self.rholm("make", "sample", "box.ply", "--points", "20000", "-o", "points.ply")
        content = (self.folder / "points.ply").read_bytes()
        for some in (content[:-5], content[:300], b"", b"1 2 3\n" * 50000 + b"4 5\n"):
            result = self.rholm("convert", "-", "out.ply", "--max-memory", "1e-5", "--work-dir", ".",
                                code=3, stdin=some)
            self.assertIn("standard input", result.err)
            self.assertNotIn("/proc", result.err)
        self.assertEqual(self.files(), ["box.ply", "points.ply"])

    def test_convert_takes_little_memory_of_points(self):
        self.box()
        self.rholm("make", "sample", "box.ply", "--points", "1000000", "-o", "points.ply")
        plain = limits.Run([RHOLM, "--version"], self.folder).memory
        for name in ("a.ply", "b.xyz"):
            run = limits.Run([RHOLM, "convert", "points.ply", name, "--max-memory", "0.02"],
                             self.folder)
            self.assertEqual(run.code, 0, run.err)
            if "ASAN_OPTIONS" not in os.environ:
                self.assertLess(run.memory - plain, 32 * MIB)

    def test_convert_takes_little_memory(self):
        self.box(cells=400)
        size = os.path.getsize(self.folder / "box.ply")
        self.assertGreater(size, 45 * MIB)
        plain = limits.Run([RHOLM, "--version"], self.folder).memory
        for name in ("a.ply", "b.obj"):
            run = limits.Run([RHOLM, "convert", "box.ply", name], self.folder)
            self.assertEqual(run.code, 0, run.err)
            if "ASAN_OPTIONS" not in os.environ:
                self.assertLess(run.memory - plain, 16 * MIB)

    def test_info_says_what_needs_no_neighbours(self):
        self.box()
        whole = self.rholm("info", "box.ply", "--json").json()
        part = self.rholm("info", "box.ply", "--json", *TINY).json()
        self.assertIsNone(part["topology"])
        self.assertEqual(part["counts"], {k: whole["as_read"][k] for k in ("vertices", "faces")})
        self.assertTrue(part["closed"])
        self.assertEqual(part["bounds"], whole["bounds"])
        for key in ("area", "volume"):
            self.assertAlmostEqual(part[key], whole[key], delta=1e-13 * whole[key])
        self.assertIn("unknown: about", self.rholm("info", "box.ply", *TINY).out)
        self.assertNotIn("unknown: about", self.rholm("info", "box.ply").out)

    def test_info_of_points_is_the_same_a_piece_at_a_time(self):
        self.box()
        self.rholm("make", "sample", "box.ply", "--points", "20000", "-o", "points.ply")
        self.rholm("convert", "points.ply", "points.xyz")
        for name in ("points.ply", "points.xyz"):
            for options in (["--json"], []):
                whole = self.rholm("info", name, *options)
                self.assertEqual(self.rholm("info", name, *options, *TINY).out, whole.out)

    def compared(self, a, b, *options):
        return self.rholm("compare", a, b, "--samples", "3000", "--seed", "3", *options).out

    def test_compare_says_the_same_of_meshes_where_they_lie(self):
        self.box(cells=60)
        self.rholm("make", "sphere", "--subdivisions", "6", "-o", "ball.ply")
        self.rholm("convert", "ball.ply", "ball.obj")
        self.rholm("expand", "ball.ply", "--degree", "4", "-o", "ball.h5")
        for a, b in (("box.ply", "ball.ply"), ("ball.ply", "box.ply"), ("box.ply", "box.ply"),
                     ("box.ply", "ball.obj"), ("ball.h5", "box.ply")):
            for options in (["--json"], ["--threshold", "0.1"]):
                whole = self.compared(a, b, *options)
                # An OBJ file is read, and needs memory.
                for memory in ("1e-6", "0.005", "0.02") if b != "ball.obj" else ("0.05",):
                    large = self.compared(a, b, *options, "--max-memory", memory)
                    self.assertEqual(large, whole, (a, b, memory))

    def test_compare_reads_what_does_not_lie_as_triangles(self):
        self.box(cells=3)
        header = (b"ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\n"
                  b"property float y\nproperty float z\nelement face 1\n"
                  b"property list uchar int vertex_indices\nend_header\n")
        corners = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0)
        self.write("square.ply", header + corners + struct.pack("<B4i", 4, 0, 1, 2, 3))
        self.rholm("convert", "square.ply", "square.obj")
        for other in ("square.ply", "square.obj"):
            whole = self.compared(other, "box.ply", "--json")
            self.assertEqual(self.compared(other, "box.ply", "--json", *TINY), whole)
        result = self.rholm("compare", "square.ply", "square.obj", "--max-memory", "1e-6")
        self.assertIn("GiB", result.err)

    def test_compare_refuses_damaged_meshes_where_they_lie(self):
        content = self.box(cells=3)
        self.write("cut.ply", content[:-5])
        self.write("index.ply", content[:-4] + b"\xff\xff\xff\x7f")
        self.write("empty.ply", b"")
        at = content.index(b"end_header\n") + len(b"end_header\n")
        self.write("nan.ply", content[:at] + struct.pack("<d", float("nan")) + content[at + 8:])
        for bad in ("cut.ply", "index.ply", "empty.ply", "nan.ply"):
            for pair in (("box.ply", bad), (bad, "box.ply")):
                self.rholm("compare", *pair, "--max-memory", "1e-6", code=3)
        self.rholm("compare", "box.ply", "none.ply", "--max-memory", "1e-6", code=1)

    def test_compare_takes_little_memory(self):
        self.box(cells=400)
        run = limits.Run([RHOLM, "compare", "box.ply", "box.ply", "--samples", "1000",
                          "--max-memory", "0.03"], self.folder)
        self.assertEqual(run.code, 0, run.err)
        plain = limits.Run([RHOLM, "--version"], self.folder).memory
        if "ASAN_OPTIONS" not in os.environ:
            self.assertLess(run.memory - plain, 80 * MIB)

    def test_info_of_a_damaged_file_is_refused_as_ever(self):
        content = self.box()
        self.write("bad.ply", content[:-7])
        self.rholm("info", "bad.ply", *TINY, code=3)
        self.write("bad.xyz", b"1 2 3\n" * 40000 + b"1 2\n")
        self.rholm("info", "bad.xyz", *TINY, code=3)


if __name__ == "__main__":
    main()
