"""Points: sampling of meshes, and orientation of normals."""

import os
import re
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, OCTAHEDRON, main, off

COLORED = """ply
format ascii 1.0
element vertex {n}
property double x
property double y
property double z
property uchar red
end_header
"""


def rows(path):
    return [[float(x) for x in line.split()] for line in path.read_text().splitlines()
            if not line.startswith("#")]


class Sample(CliTest):
    def setUp(self):
        super().setUp()
        self.write("a.off", off(*OCTAHEDRON))

    def test_points_lie_on_the_mesh_with_its_normals(self):
        self.rholm("make", "sample", "a.off", "--points", "500", "-o", "p.xyz")
        points = rows(self.folder / "p.xyz")
        self.assertEqual(len(points), 500)
        for x, y, z, nx, ny, nz in points:  # |x| + |y| + |z| = 1
            self.assertAlmostEqual(abs(x) + abs(y) + abs(z), 1, 12)
            self.assertAlmostEqual(x * nx + y * ny + z * nz, 3 ** -0.5, 12)

    def test_every_option_is_heard(self):
        self.rholm("make", "sample", "a.off", "--points", "1000", "-o", "clean.xyz")
        clean = (self.folder / "clean.xyz").read_bytes()
        for words in (["--noise", ".01"], ["--normal-noise", "5"], ["--outliers", ".1"],
                      ["--holes", "2,.1"], ["--density-ratio", "9"], ["--seed", "2"],
                      ["--no-normals"], ["--translate", "1,0,0"]):
            self.rholm("make", "sample", "a.off", "--points", "1000", *words, "-o", "p.xyz")
            self.assertNotEqual((self.folder / "p.xyz").read_bytes(), clean, words)
        self.assertEqual(len(rows(self.folder / "p.xyz")[0]), 6)

    def test_points_have_the_colours_of_their_places(self):
        vertices, faces = OCTAHEDRON
        body = "".join(f"{x} {y} {z} {100 + 100 * x:.0f}\n" for x, y, z in vertices)
        body += "".join(f"3 {a} {b} {c}\n" for a, b, c in faces)
        header = COLORED.format(n=len(vertices)).replace(
            "end_header", f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header")
        self.write("c.ply", header + body)
        self.rholm("make", "sample", "c.ply", "--points", "300", "-o", "p.ply", "--ascii")
        lines = (self.folder / "p.ply").read_text().split("end_header\n")[1].splitlines()
        self.assertEqual(len(lines), 300)
        for line in lines:
            x, red = float(line.split()[0]), line.split()[-1]
            self.assertEqual(red, str(round(100 + 100 * x)))
        self.assertIn("no room for red", self.rholm("make", "sample", "c.ply", "-o", "p.xyz").err)

    def test_largest_component_leaves_the_others_out(self):
        vertices, faces = OCTAHEDRON
        self.write("two.off", off(vertices + [(9 + x / 2, y / 2, z / 2) for x, y, z in vertices],
                                  faces + [tuple(i + 6 for i in f) for f in faces]))
        words = ["make", "sample", "two.off", "--points", "200", "-o", "p.xyz"]
        self.rholm(*words)
        self.assertGreater(max(p[0] for p in rows(self.folder / "p.xyz")), 8)
        self.rholm(*words, "--largest-component")
        self.assertLess(max(p[0] for p in rows(self.folder / "p.xyz")), 1)

    def test_what_does_not_belong_is_refused(self):
        for words, saying in ((["sphere", "a.off"], "MESH"), (["sample"], "MESH"),
                              (["sample", "a.off", "--cells", "3"], "--cells"),
                              (["bumpy", "--noise", ".1"], "--noise"),
                              (["box", "--no-normals"], "--no-normals"),
                              (["sample", "a.off", "--points", "0"], "--points"),
                              (["sample", "a.off", "--noise", "nan"], "--noise"),
                              (["sample", "a.off", "--holes", "2"], "--holes"),
                              (["sample", "a.off", "--holes", "1.5,.1"], "--holes"),
                              (["sample", "a.off", "--density-ratio", ".5"], "--density-ratio"),
                              (["sample", "a.off", "--pattern", "spiral"], "--pattern"),
                              (["sample", "a.off", "--pattern-ratio", "3"], "--pattern"),
                              (["sample", "a.off", "--pattern", "rings", "--pattern-axis", "0,0,0"], "axis"),
                              (["sample", "a.off", "--pattern", "lines"], "--scans"),
                              (["sample", "a.off", "--sensor"], "--scans"),
                              (["sample", "a.off", "--pattern", "grid", "--scans", "2"], "grid"),
                              (["box", "--scans", "2"], "--scans")):
            self.assertIn(saying, self.rholm("make", *words, "-o", "o.ply", code=2).err)
        self.write("p.xyz", "0 0 0\n1 0 0\n0 1 0\n")
        self.assertIn("mesh", self.rholm("make", "sample", "p.xyz", "-o", "o.ply", code=3).err)
        self.assertEqual(self.files(), ["a.off", "p.xyz"])


class Render(CliTest):
    def test_points_are_drawn_beside_meshes(self):
        self.write("a.off", off(*OCTAHEDRON))
        self.rholm("make", "sample", "a.off", "--points", "500", "-o", "p.xyz")
        for words in (["p.xyz"], ["a.off", "p.xyz", "--labels", "mesh,points"],
                      ["p.xyz", "--color", "error", "--against", "a.off"]):
            self.rholm("render", *words, "--size", "64x48", "-o", "o.png")
            self.assertEqual((self.folder / "o.png").read_bytes()[:4], b"\x89PNG")
        self.write("c.ply", COLORED.format(n=1) + "0 0 0 9\n")
        said = self.rholm("render", "c.ply", "--color", "own", "--size", "64x48", "-o", "o.png").err
        self.assertIn("no attributes red, green, blue", said)


class Orient(CliTest):
    def setUp(self):
        super().setUp()
        self.rholm("make", "torus", "-o", "t.ply")
        self.rholm("make", "sample", "t.ply", "--points", "5000", "-o", "true.xyz")
        self.rholm("make", "sample", "t.ply", "--points", "5000", "--no-normals", "-o", "p.ply")

    def test_normals_are_those_of_the_mesh(self):
        report = self.rholm("orient", "p.ply", "-o", "o.xyz", "--json").json()
        self.assertEqual((report["points"], report["computed"], report["components"]),
                         (5000, 5000, 1))
        self.assertGreater(report["mean_confidence"], 0.8)
        for a, b in zip(rows(self.folder / "true.xyz"), rows(self.folder / "o.xyz")):
            self.assertEqual(a[:3], b[:3])
            self.assertGreater(sum(x * y for x, y in zip(a[3:], b[3:])), 0.8)

    def test_report_in_text_has_the_same(self):
        text = self.rholm("orient", "p.ply", "-o", "o.xyz").out
        for name in ("points", "neighbours", "components", "computed", "mean confidence", "unsure"):
            self.assertRegex(text, rf"(?m)^  {name} +\d")
        self.assertRegex(self.rholm("orient", "o.xyz", "-o", "o2.xyz").out, r"turned round +0")

    def test_threads_do_not_change_a_bit(self):
        outputs = []
        for threads in (1, 2):
            self.rholm("orient", "p.ply", "-o", "o.ply", "--threads", threads)
            outputs.append((self.folder / "o.ply").read_bytes())
        self.assertEqual(*outputs)

    def test_colours_travel_through(self):
        points = [p[:3] for p in rows(self.folder / "true.xyz")]
        self.write("c.ply", COLORED.format(n=len(points)) + "".join(
            f"{x!r} {y!r} {z!r} {i % 256}\n" for i, (x, y, z) in enumerate(points)))
        self.rholm("orient", "c.ply", "--ascii", "-o", "o.ply")
        text = (self.folder / "o.ply").read_text()
        names = re.findall(r"property \w+ (\w+)", text)
        self.assertIn("property uchar red", text)
        for i, line in enumerate(text.split("end_header\n")[1].splitlines()):
            self.assertEqual(int(line.split()[names.index("red")]), i % 256)

    def test_a_sensor_sees_all_normals_and_a_center_none(self):
        for option, sign in (("--sensor", 1), ("--center", -1)):
            self.rholm("orient", "p.ply", option, "0,0,9", "-o", "o.xyz")
            for x, y, z, nx, ny, nz in rows(self.folder / "o.xyz"):
                self.assertGreaterEqual(sign * (-x * nx - y * ny + (9 - z) * nz), 0)

    def test_places_of_scanners_in_the_file_decide(self):
        self.rholm("make", "sample", "t.ply", "--points", "5000", "--scans", "4", "--sensor",
                   "--ascii", "-o", "scans.ply")
        report = self.rholm("orient", "scans.ply", "--ascii", "-o", "o.ply", "--json").json()
        self.assertEqual(report["components"], 0)
        text = [(self.folder / name).read_text() for name in ("scans.ply", "o.ply")]
        names = [re.findall(r"property \w+ (\w+)", t) for t in text]
        lines = [t.split("end_header\n")[1].splitlines() for t in text]
        wrong = 0
        for one, other in zip(*lines):
            a, b = dict(zip(names[0], one.split())), dict(zip(names[1], other.split()))
            wrong += sum(float(a[c]) * float(b[c]) for c in ("nx", "ny", "nz")) < 0
        self.assertLessEqual(wrong, 5)

    def test_an_isolated_point_is_counted_unless_told(self):
        self.write("s.xyz", "".join(" ".join(row[:3]) + "\n" for row in
                                    ([str(x) for x in r] for r in rows(self.folder / "true.xyz")))
                   + "1e6 0 0\n")
        found = self.rholm("orient", "s.xyz", "--json", "-o", "o.xyz").json()
        self.assertEqual(found["outliers"], 1)
        kept = self.rholm("orient", "s.xyz", "--keep-outliers", "--json", "-o", "o.xyz").json()
        self.assertEqual(kept["outliers"], 0)

    def test_unsure_signs_are_said_and_shown(self):
        self.write("plane.xyz", "".join(f"{i / 30} {j / 30} 0\n" for i in range(30)
                                        for j in range(30)))
        failed = self.rholm("orient", "plane.xyz", "--confidence", "--ascii", "-o", "o.ply", code=4)
        self.assertIn("uncertain", failed.err)
        self.assertIn("property float confidence", (self.folder / "o.ply").read_text())
        report = self.rholm("orient", "p.ply", "--confidence", "--json", "-o", "o.ply").json()
        self.assertLess(report["unsure"], 0.01)

    def test_a_stream_works_at_both_ends(self):
        data = (self.folder / "p.ply").read_bytes()
        self.rholm("orient", "p.ply", "-o", "o.ply")
        result = self.rholm("orient", "-", "--format", "ply", "-o", "-", stdin=data)
        self.assertEqual(result.bytes, (self.folder / "o.ply").read_bytes())

    def test_what_the_reader_says_and_a_mesh_s_own_normals_are_heard(self):
        """Vertices of a mesh are used as points; its normals are ignored, other attributes are kept."""
        rows = [line.split() for line in (self.folder / "true.xyz").read_text().splitlines()]
        names = ["x", "y", "z", "nx", "ny", "nz", "quality"]
        self.write("m.ply", "ply\nformat ascii 1.0\nelement extra 1\nproperty int a\n"
                   f"element vertex {len(rows)}\n" +
                   "".join(f"property double {name}\n" for name in names) +
                   "element face 1\nproperty list uchar int vertex_indices\nend_header\n7\n" +
                   "".join(" ".join([*row[:3], "0", "0", "0", "1"]) + "\n" for row in rows) +
                   "3 0 1 2\n")
        result = self.rholm("orient", "m.ply", "--json", "-o", "o.ply")
        self.assertIn("'extra' with 1 row passed over", result.err)
        self.assertIn("used as points", result.err)
        self.assertEqual(result.json()["computed"], len(rows))
        names = [a["name"] for a in self.rholm("info", "o.ply", "--json").json()["attributes"]]
        self.assertIn("quality", names)
        for command in (["convert", "m.ply", "c.obj"], ["reconstruct", "m.ply", "-o", "s.ply"]):
            self.assertIn("'extra' with 1 row passed over", self.run_rholm(*command).err)

    def test_directions_are_kept_on_demand(self):
        lines = [line.split() for line in (self.folder / "true.xyz").read_text().splitlines()]
        turned = [line[:3] + [str(-float(x)) for x in line[3:]] for line in lines[:1000]]
        self.write("turned.xyz", "".join(" ".join(r) + "\n" for r in turned + lines[1000:]))
        report = self.rholm("orient", "turned.xyz", "--keep-directions", "-o", "o.xyz",
                            "--json").json()
        self.assertEqual((report["computed"], report["flipped"]), (0, 1000))

    def test_wrong_words_and_points_that_have_no_plane_are_refused(self):
        for words, saying in ((["--center", "0,0,0", "--sensor", "1,1,1"], "exclude"),
                              (["--center", "up"], "--center"), (["--neighbors", "2"], "3 ... 1000")):
            self.assertIn(saying, self.rholm("orient", "p.ply", *words, "-o", "o.ply",
                                             code=2).err)
        self.rholm("orient", "p.ply", "-o", "o.stl", code=2)
        for points in ("0 0 0\n", "0 0 0\n1 1 1\n", "0 0 0\n1 1 1\n3 3 3\n", "0 0 0\n" * 9,
                       "0 0 0\n1 0 0\nnan 0 1\n", "nan 0 1\n"):
            self.write("few.xyz", points)
            self.assertIn("rholm: error:", self.rholm("orient", "few.xyz", "-o", "o.ply",
                                                      code=3).err)
        self.assertNotIn("o.ply", self.files())


class Tables(CliTest):
    """Meaning of columns of text tables, in every command that reads points."""

    def setUp(self):
        super().setUp()
        self.write("a.off", off(*OCTAHEDRON))
        self.rholm("make", "sample", "a.off", "--points", "400", "-o", "p.xyz")
        self.points = rows(self.folder / "p.xyz")

    def table(self, name, order, header="", separator=" ", comma=False):
        lines = [separator.join(f"{point[k]:.9f}" for k in order) for point in self.points]
        text = "\n".join(lines) + "\n"
        self.write(name, header + (text.replace(".", ",") if comma else text))

    def test_what_columns_were_taken_for_is_said(self):
        self.table("german.csv", range(6), separator=";", comma=True)
        said = "columns taken for x, y, z, nx, ny, nz by their values; decimal commas"
        for words in (["info", "german.csv"], ["info", "german.csv", "--json"]):
            self.assertIn(said, self.rholm(*words).out)
        for words in (["convert", "german.csv", "o.ply"], ["orient", "german.csv", "-o", "o.ply"],
                      ["reconstruct", "german.csv", "-o", "o.ply"],
                      ["partition", "german.csv", "-o", "o.ply"],
                      ["render", "german.csv", "-o", "o.png", "--size", "64x64"],
                      ["compress", "german.csv", "--tolerance", "0.1", "-o", "o.h5"]):
            self.assertIn(said, self.run_rholm(*words).err, words)
            self.assertNotIn(said, self.run_rholm(*words, "--quiet").err, words)

    def test_columns_can_be_said(self):
        self.table("turned.txt", (5, 4, 3, 2, 1, 0))
        columns = ["--columns", "nz,ny,nx,z,y,x"]
        self.rholm("convert", "turned.txt", "o.xyz", *columns)
        for found, wanted in zip(rows(self.folder / "o.xyz"), self.points, strict=True):
            for a, b in zip(found, wanted, strict=True):
                self.assertAlmostEqual(a, b, 8)
        plain = self.run_rholm("reconstruct", "p.xyz", "-o", "a.ply", "--json").json()
        self.assertEqual(self.run_rholm("reconstruct", "turned.txt", "-o", "b.ply", "--json",
                                        *columns).json()["points"], plain["points"])
        report = self.rholm("info", "turned.txt", "--json", *columns).json()
        self.assertEqual(report["table_columns"], "nz ny nx z y x".split())
        piped = self.run_rholm("info", "-", "--json", *columns,
                               stdin=(self.folder / "turned.txt").read_bytes())
        self.assertEqual(piped.json()["table_columns"], report["table_columns"])
        for wrong in ("x,y", "x,y,z,x", "x,,z", "lat,lon"):
            self.assertIn("--columns", self.rholm("info", "turned.txt", "--columns", wrong, code=2).err)
        self.rholm("info", "turned.txt", "--columns", "x,y,z", code=3)
        self.rholm("info", "a.off", "--columns", "x,y,z", code=3)

    def test_points_without_a_place_are_dropped_and_counted(self):
        self.table("gaps.xyz", range(6))
        text = (self.folder / "gaps.xyz").read_text()
        self.write("gaps.xyz", text + "nan nan nan 0 0 1\n" * 3)
        whole = self.rholm("info", "gaps.xyz", "--json").json()
        self.assertEqual(whole["counts"], {"points": 400})
        self.assertEqual(whole["warnings"],
                         ["3 points with a coordinate that is not a finite number dropped"])
        self.assertIn("3 points", self.run_rholm("reconstruct", "gaps.xyz", "-o", "g.ply").err)
        tiny = ["--max-memory", "1e-6"]
        pieces = self.rholm("info", "gaps.xyz", "--json", *tiny).json()
        self.assertEqual(pieces["counts"], whole["counts"])
        self.assertEqual(pieces["warnings"], whole["warnings"])
        for name in ("o.ply", "o.xyz"):
            self.rholm("convert", "gaps.xyz", name)
            bytes_of_whole = (self.folder / name).read_bytes()
            self.assertIn("3 points", self.rholm("convert", "gaps.xyz", name, *tiny).err)
            self.assertEqual((self.folder / name).read_bytes(), bytes_of_whole)

    def test_single_precision_that_spoils_faces_is_said(self):
        vertices, faces = OCTAHEDRON
        self.write("far.off", off([(x, y + 5155487, z) for x, y, z in vertices], faces))
        said = "binary STL has single precision, in steps of 0.5"
        self.assertIn(said, self.rholm("convert", "far.off", "far.stl").err)
        self.assertEqual(self.rholm("convert", "far.off", "text.stl", "--ascii").err, "")
        self.assertEqual(self.rholm("convert", "a.off", "near.stl").err, "")
        self.rholm("convert", "far.off", "far.ply")
        self.assertIn(said, self.rholm("convert", "far.ply", "far.stl").err)


if __name__ == "__main__":
    main()
