"""Operations on shapes: rotation, repair, simplification, rendering, at any size."""

import json
import math
import os
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, OCTAHEDRON, main, off, scaled

V, F = OCTAHEDRON


class Turning(CliTest):
    def model(self, name, *make):
        self.rholm("make", *make, "-o", "shape.ply", "--quiet")
        self.rholm("expand", "shape.ply", "--degree", 8, "-o", name, "--quiet")

    def test_a_sphere_has_no_axes_to_turn_to(self):
        self.model("sphere.h5", "sphere", "--subdivisions", 3)
        report = self.rholm("rotate", "sphere.h5", "--principal-axes", "--json", "-o",
                            "turned.h5").json()
        self.assertEqual(report["angle"], 0)
        self.assertEqual(len(report["free_axes"]), 3)

    def test_spheres_turn_freely_about_three_axes(self):
        self.model("a.h5", "sphere", "--subdivisions", 4)
        self.model("b.h5", "sphere", "--subdivisions", 5)
        report = self.rholm("align", "a.h5", "b.h5", "--json").json()
        self.assertEqual(report["angle"], 0)
        self.assertEqual(len(report["free_axes"]), 3)
        self.assertEqual(report["ambiguities"], [])

    def test_the_mirror_is_a_plane_through_the_centroid(self):
        self.model("body.h5", "bumpy", "--subdivisions", 3, "--translate", "5,6,7")
        self.rholm("rotate", "body.h5", "--mirror", "y", "-o", "image.h5")
        report = self.rholm("align", "image.h5", "body.h5", "--mirror", "--json").json()
        self.assertTrue(report["mirrored"])
        self.assertEqual(report["reflection"], {"point": report["from"], "normal": [1, 0, 0]})
        # The reflection, rotation and shift of the report take a point of the image, with y reversed, back
        # to its place.
        place = [5.5, 6.2, 7.1]
        image = [place[0], -place[1], place[2]]
        offset = [p - q for p, q in zip(image, report["from"])]
        offset[0] = -offset[0]
        for row, to, wanted in zip(report["matrix"], report["to"], place):
            self.assertAlmostEqual(sum(a * b for a, b in zip(row, offset)) + to, wanted, 6)


    def test_text_says_what_json_does(self):
        self.model("body.h5", "bumpy", "--subdivisions", 3, "--translate", "5,6,7")
        self.rholm("rotate", "body.h5", "--mirror", "y", "-o", "image.h5")
        self.assertIn("in the plane x = ", self.rholm("align", "image.h5", "body.h5", "--mirror").out)
        self.model("sphere.h5", "sphere", "--subdivisions", 3)
        self.assertEqual(self.rholm("align", "sphere.h5", "sphere.h5").out.count("free to turn"), 3)

    def test_a_matrix_turns_about_the_point_that_is_said(self):
        """A quarter turn about a line along z: the new centre is known."""
        self.model("body.h5", "bumpy", "--subdivisions", 3, "--translate", "5,6,7")
        self.rholm("convert", "body.h5", "before.json")
        before = json.loads((self.folder / "before.json").read_text())["center"]
        quarter = ["rotate", "body.h5", "--matrix", "0,-1,0,1,0,0,0,0,1"]
        for about, (x, y) in (("1,2,0", (1, 2)), ("origin", (0, 0)), ("center", before[:2])):
            self.rholm(*quarter, "--about", about, "-o", "turned.json")
            after = json.loads((self.folder / "turned.json").read_text())["center"]
            wanted = [x - (before[1] - y), y + (before[0] - x), before[2]]
            for found, value in zip(after, wanted):
                self.assertAlmostEqual(found, value, 12)
        for words in (["--matrix", "1,0,0,0,1,0,0,0,2"], ["--matrix", "1,0,0"]):
            self.rholm("rotate", "body.h5", *words, "-o", "turned.h5", code=2)


class Repair(CliTest):
    def repair(self, *words):
        return self.rholm("repair", *words, "--json", "-o", "repaired.off").json()

    def test_every_fault_at_once(self):
        """Separate triangles, a duplicate, flipped faces, an unused vertex and a hole."""
        vertices = [V[i] for f in F[:-1] for i in f] + [(9, 9, 9)]
        faces = [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(F) - 1)]
        faces[1] = faces[1][::-1]
        faces.append((0, 1, 2))
        self.write("bad.off", off(vertices, faces))
        report = self.repair("bad.off")
        for repaired, times in (("isolated_vertices", 1), ("duplicate_faces", 1), ("degenerate_faces", 0),
                                ("flipped_faces", 1), ("closed_holes", 1)):
            self.assertEqual(report[repaired], times, repaired)
        self.assertTrue(report["after"]["closed"] and report["after"]["oriented"])
        self.assertAlmostEqual(report["after"]["volume"], 4 / 3)
        self.rholm("expand", "repaired.off", "--degree", 4, "-o", "model.h5")
        again = self.rholm("info", "repaired.off", "--json").json()
        self.assertEqual(again["counts"]["faces"], len(F))
        self.assertEqual(again["duplicate_faces"], 0)

    def test_what_is_left_is_said(self):
        self.write("open.off", off(V, F[:-1]))
        result = self.rholm("repair", "open.off", "--max-hole", 2, "-o", "same.off")
        self.assertIn("larger than the 2 edges of --max-hole", result.err)
        self.assertIn("open, 3 boundary edges", result.out)
        # A strip with half a twist: a closed chain of five triangles.
        ring = [(math.cos(a), math.sin(a), 0.1 * k)
                for k, a in enumerate(2 * math.pi * i / 5 for i in range(5))]
        self.write("strip.off", off(ring, [(i, (i + 1) % 5, (i + 2) % 5) for i in range(5)]))
        self.assertIn("surfaces with one side", self.rholm("repair", "strip.off", "-o", "same.off").err)
        self.write("sheet.off", off(V, F[:2]))
        self.assertIn("an open sheet",
                      self.rholm("repair", "sheet.off", "-o", "same.off").err)

    def test_text_says_what_was_done(self):
        small = [tuple(x / 2 for x in v) for v in V]
        inner = [tuple(i + len(V) for i in f) for f in F]
        self.write("nested.off", off(V + small, F + inner))
        result = self.rholm("repair", "nested.off", "-o", "hollow.off")
        self.assertRegex(result.out, r"cavities +1 part within others")
        # Two octahedra share the corner at x = 1.
        beside = [(2 - x, y, z) for x, y, z in V[1:]]
        other = [tuple(0 if i == 0 else i + 5 for i in f[::-1]) for f in F]
        self.write("corner.off", off(V + beside, F + other))
        result = self.rholm("repair", "corner.off", "-o", "apart.off")
        self.assertRegex(result.out, r"split +1 vertex between sheets")

    def test_a_seam_is_told_with_the_tolerance_that_closes_it(self):
        """Two halves are 1e-5 of the diagonal apart."""
        self.rholm("make", "sphere", "--subdivisions", 3, "-o", "sphere.off", "--quiet")
        words = (self.folder / "sphere.off").read_text().split()
        n, m = int(words[1]), int(words[2])
        at = [tuple(map(float, words[4 + 3 * i:7 + 3 * i])) for i in range(n)]
        faces = [tuple(map(int, words[4 + 3 * n + 4 * i + 1:4 + 3 * n + 4 * i + 4]))
                 for i in range(m)]
        below = [sum(at[i][2] for i in f) < 0 for f in faces]
        moved = [(x, y, z - 3e-5) for x, y, z in at]
        self.write("seam.off", off(at + moved, [tuple(i + n * low for i in f)
                                                for f, low in zip(faces, below)]))
        error = self.rholm("expand", "seam.off", "--degree", 4, "-o", "m.h5", code=3).err
        tolerance = self.rholm("info", "seam.off", "--json").json()["closes_at"]
        self.assertGreater(tolerance, 3e-5)
        self.assertLess(tolerance, 7e-5)
        self.assertIn(f"--weld {tolerance:.2g}", error)
        self.rholm("expand", "seam.off", "--degree", 4, "--weld", tolerance, "-o", "m.h5")
        self.assertTrue(self.repair("seam.off", "--weld", tolerance)["after"]["closed"])

    def test_messages_name_the_command_that_mends(self):
        self.write("mixed.off", off(V, [F[0][::-1], *F[1:]]))
        self.write("twice.off", off(V, F + F))
        error = self.rholm("expand", "mixed.off", "--degree", 4, "-o", "m.h5", code=3).err
        self.assertIn("rholm repair", error)
        error = self.rholm("expand", "twice.off", "--degree", 4, "-o", "m.h5", code=3).err
        self.assertIn("8 of its 16 faces are duplicates", error)
        self.assertIn("rholm repair", error)
        self.assertNotIn("0 triangles", error)
        self.assertIn("8 of 16 faces are duplicates",
                      self.rholm("center", "twice.off", code=3).err)
        self.assertIn("rholm repair", self.rholm("info", "twice.off").out)

    def test_wrong_values_are_usage_errors(self):
        self.write("fine.off", off(V, F))
        for words in (["--max-hole", "501"], ["--max-hole", "-1"], ["--weld", "-1"],
                      ["--weld", "nan"], ["--max-hole", "many"]):
            with self.subTest(words):
                self.rholm("repair", "fine.off", *words, "-o", "out.off", code=2)
        self.rholm("repair", "fine.off", "-o", "out.xyz", code=2)
        self.rholm("repair", "fine.off", "-o", "out.h5", code=2)
        self.write("points.xyz", "0 0 0\n1 0 0\n0 1 0\n")
        self.rholm("repair", "points.xyz", "-o", "out.off", code=3)
        self.write("flat.off", off([(0, 0, 0), (1, 1, 1), (2, 2, 2)], [(0, 1, 2)]))
        self.rholm("repair", "flat.off", "-o", "out.off", code=3)

    def test_threads_do_not_change_a_byte(self):
        self.rholm("make", "bumpy", "--subdivisions", 3, "-o", "b.off", "--quiet")
        made = []
        for threads in (1, 3):
            self.rholm("repair", "b.off", "--threads", threads, "-o", "r.ply")
            made.append((self.folder / "r.ply").read_bytes())
        self.assertEqual(*made)


class Simplify(CliTest):
    def test_nothing_is_refused(self):
        self.write("none.off", off(V, []))
        self.rholm("simplify", "none.off", "--faces", "auto", "-o", "o.off", code=3)

    def setUp(self):
        super().setUp()
        self.rholm("make", "torus", "-o", "torus.ply", "--quiet")

    def test_as_many_faces_as_wanted_and_the_genus_stays(self):
        before = self.rholm("info", "torus.ply", "--json").json()
        for words, most in ((["--faces", 1000], 1000), (["--faces", "10%"], 922), ([], 9215)):
            report = self.rholm("simplify", "torus.ply", *words, "--json", "-o", "s.ply").json()
            self.assertLessEqual(report["faces"], most)
            after = self.rholm("info", "s.ply", "--json").json()
            self.assertEqual((after["genus"], after["closed"], after["manifold"]), (1, True, True))
            self.assertEqual(after["counts"]["faces"], report["faces"])
            self.assertAlmostEqual(after["volume"] / before["volume"], 1, 1)

    def test_an_error_is_kept(self):
        report = self.rholm("simplify", "torus.ply", "--faces", 4, "--max-error", 1e-3, "--json",
                            "-o", "s.ply").json()
        self.assertLessEqual(report["error"], 1e-3)
        self.assertGreater(report["faces"], 4)

    def test_wrong_values_are_usage_errors(self):
        for value in ("none", "3", "-5", "0%", "101%", "2.5", "many", ""):
            with self.subTest(value):
                error = self.rholm("simplify", "torus.ply", "--faces", value, "-o", "s.ply",
                                   code=2).err
                self.assertIn("--faces", error)
        self.rholm("simplify", "torus.ply", "--max-error", -1, "-o", "s.ply", code=2)
        self.rholm("simplify", "torus.ply", "-o", "s.xyz", code=2)


class Recenter(CliTest):
    def setUp(self):
        super().setUp()
        self.rholm("make", "bumpy", "--subdivisions", 4, "-o", "shape.ply", "--quiet")
        self.rholm("expand", "shape.ply", "--degree", 24, "--center", "none", "-o", "model.h5",
                   "--quiet")

    def test_volume_and_centroid_stay(self):
        before = self.rholm("info", "model.h5", "--json").json()
        for center in ("volume", "auto", "cosine", "centroid", "0.05,-0.03,0.02"):
            with self.subTest(center):
                report = self.rholm("recenter", "model.h5", "--center", center, "--json", "-o",
                                    "moved.h5").json()
                after = self.rholm("info", "moved.h5", "--json").json()
                self.assertAlmostEqual(after["volume"], before["volume"], 4)
                for a, b in zip(after["volume_centroid"], before["volume_centroid"]):
                    self.assertAlmostEqual(a, b, 4)
                self.assertEqual(after["center"], report["center"])
                self.assertLess(report["there_and_back"], 1e-3)
        self.assertEqual(report["center"], [0.05, -0.03, 0.02])
        report = self.rholm("recenter", "moved.h5", "--center", "none", "--json", "-o",
                            "back.h5").json()
        self.assertEqual(report["center"], [0, 0, 0])

    def test_centres_that_do_not_fit(self):
        self.rholm("recenter", "model.h5", "--center", "5,0,0", "-o", "m.h5", code=3)
        for value in ("middle", "1,2", "nan,0,0", ""):
            with self.subTest(value):
                self.rholm("recenter", "model.h5", "--center", value, "-o", "m.h5", code=2)
        self.rholm("recenter", "shape.ply", "-o", "m.h5", code=3)


class Render(CliTest):
    def test_small_shapes_are_noted_and_fit_each_shows_them(self):
        self.write("large.off", off(*OCTAHEDRON))
        self.write("small.off", off(*scaled(OCTAHEDRON, 1e-4)))
        words = ("large.off", "small.off", "--size", "200x100")
        self.assertIn("--fit each", self.rholm("render", *words, "-o", "scale.png").err)
        self.assertEqual(self.rholm("render", *words, "--fit", "each", "-o", "each.png").err, "")
        self.rholm("render", "large.off", "large.off", "--size", "200x100", "--labels",
                   "large,small", "-o", "same.png")
        pictures = [(self.folder / name).read_bytes() for name in
                    ("scale.png", "each.png", "same.png")]
        self.assertEqual(pictures[1], pictures[2])
        self.assertNotEqual(pictures[0], pictures[1])
        self.rholm("render", *words, "--fit", "both", "-o", "x.png", code=2)

    def test_normals_of_the_file_smooth_and_flat_leaves_them_out(self):
        vertices, faces = OCTAHEDRON
        normals = "ply\nformat ascii 1.0\nelement vertex 6\n" + "".join(
            f"property float {x}\n" for x in ("x", "y", "z", "nx", "ny", "nz")) + (
            "element face 8\nproperty list uchar int vertex_indices\nend_header\n")
        normals += "".join(" ".join(map(str, v + v)) + "\n" for v in vertices)
        normals += "".join("3 " + " ".join(map(str, f)) + "\n" for f in faces)
        self.write("a.ply", normals)
        self.write("a.off", off(*OCTAHEDRON))
        for name, words in (("smooth", ["a.ply"]), ("flat", ["a.ply", "--flat"]),
                            ("none", ["a.off"])):
            self.rholm("render", *words, "--size", "64x64", "-o", f"{name}.png")
        smooth, flat, none = ((self.folder / f"{name}.png").read_bytes()
                              for name in ("smooth", "flat", "none"))
        self.assertEqual(flat, none)
        self.assertNotEqual(smooth, flat)


class Size(CliTest):
    """A shape in any unit has the same figures, times powers of the unit, or a clear refusal."""

    def octahedron(self, size):
        self.write("shape.off", off(*scaled(OCTAHEDRON, size)))

    def test_errors_of_a_model_follow_the_unit_and_the_file_can_be_read(self):
        relative = []
        for size in (1, 1e-100, 1e-60, 1e-45, 1e40, 1e60, 1e100):
            self.octahedron(size)
            report = self.rholm("expand", "shape.off", "--degree", 6, "--json", "-o",
                                "model.h5").json()
            relative.append([report["errors"][key] / size
                             for key in ("rms", "measured_max", "distance_rms")])
            read = self.rholm("info", "model.h5", "--json").json()
            self.assertAlmostEqual(read["errors"]["rms"] / size, relative[0][0], 3)
        for others in relative[1:]:
            for a, b in zip(others, relative[0]):
                self.assertAlmostEqual(a / b, 1, 3)

    def test_fewer_faces_whatever_the_unit(self):
        self.rholm("make", "sphere", "--subdivisions", 2, "-o", "s.off", "--quiet")
        text = (self.folder / "s.off").read_text().split("\n")
        n = int(text[1].split()[0])
        at = [tuple(map(float, line.split())) for line in text[2:2 + n]]
        faces = [tuple(map(int, line.split()[1:4])) for line in text[2 + n:] if line]
        for power in (-200, 0, 200, 300):
            self.write("big.off", off([tuple(x * 10.0 ** power for x in p) for p in at], faces))
            report = self.rholm("simplify", "big.off", "--faces", 100, "--json", "-o",
                                "few.off").json()
            self.assertEqual(report["faces"], 100, power)
            self.assertLess(report["error"] / report["diagonal"], 0.05)

    def test_what_no_number_can_hold_is_said(self):
        self.octahedron(1e300)
        out = self.rholm("info", "shape.off").out
        self.assertNotRegex(out, r"\binf\b")
        self.assertIn("another unit", out)
        self.assertAlmostEqual(float(out.split("diagonal")[1].split()[0]) / 1e300, 12 ** .5, 5)
        self.octahedron(1e-200)
        self.assertIn("another unit", self.rholm("info", "shape.off").out)

    def test_floats_that_would_be_zero_are_refused(self):
        self.octahedron(1e-60)
        error = self.rholm("convert", "shape.off", "shape.stl", code=3).err
        self.assertIn("1.2e-38", error)
        self.assertNotIn("shape.stl", self.files())

    def test_atlases_name_the_range(self):
        for size in (1e-100, 1e100):
            self.octahedron(size)
            for words in (["compress", "shape.off", "--tolerance", 0.1, "--unit",
                           "diagonal", "-o", "a.h5"],
                          ["partition", "shape.off", "--tolerance", 0.1 * size, "-o", "p.ply"]):
                error = self.rholm(*words, code=3).err
                self.assertIn("take another unit", error)
                self.assertNotIn("area 0", error)


if __name__ == "__main__":
    main()
