"""Surfaces from points: every option, reports and refusals."""

import json
import math
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import NIGHTLY, RHOLM, CliTest, held, main, nightly, nightly_too, until


def rows(path):
    return [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]


class Reconstruct(CliTest):
    def setUp(self):
        super().setUp()
        self.rholm("make", "torus", "-o", "t.ply")
        self.rholm("make", "sample", "t.ply", "--points", "2500", "-o", "p.xyz")

    def shape_of(self, name):
        return self.rholm("info", name, "--json").json()

    def reconstruct(self, *words, output="s.ply"):
        return self.rholm("reconstruct", *words, "-o", output, "--json").json()

    def test_a_torus_is_closed_with_one_hole_through_it(self):
        report = self.reconstruct("p.xyz")
        shape = self.shape_of("s.ply")
        self.assertEqual((shape["components"], shape["genus"]), (1, 1))
        self.assertTrue(shape["closed"] and shape["manifold"] and shape["oriented"])
        self.assertEqual((report["points"], report["outliers"], report["dropped_points"]),
                         (2500, 0, 0))
        self.assertFalse(report["computed_normals"])
        for count in ("vertices", "faces"):
            self.assertEqual(report[count], shape["counts"][count])
        self.assertIn("caps", report["stages"])
        compared = self.rholm("compare", "t.ply", "s.ply", "--json").json()
        self.assertLess(compared["b_to_a"]["rms"], 2e-3 * compared["diagonal"])

    def test_report_in_text_has_the_same(self):
        text = self.rholm("reconstruct", "p.xyz", "-o", "s.ply").out
        for name in ("points", "spacing", "caps", "grid", "surface"):
            self.assertRegex(text, rf"(?m)^  {name} +\S")

    def test_points_that_are_not_finite_are_counted(self):
        lines = (self.folder / "p.xyz").read_text().splitlines()
        for row, word in ((5, "nan"), (700, "inf"), (2000, "-inf")):
            lines.insert(row, " ".join([word] + lines[row].split()[1:]))
        self.write("odd.xyz", "\n".join(lines) + "\n")
        for words in (["odd.xyz"], ["odd.xyz", "--tile-points", "1500"]):
            report = self.reconstruct(*words)
            with self.subTest(words):
                self.assertEqual((report["points"], report["dropped_points"]), (2503, 3))
        text = self.rholm("reconstruct", "odd.xyz", "-o", "s.ply").out
        self.assertRegex(text, r"dropped +3 \(not finite")

    def test_points_without_normals_get_some(self):
        points = [row[:3] for row in rows(self.folder / "p.xyz")]
        self.write("bare.xyz", "".join(" ".join(row) + "\n" for row in points))
        self.assertTrue(self.reconstruct("bare.xyz")["computed_normals"])
        self.assertEqual(self.shape_of("s.ply")["genus"], 1)

    def test_one_sensor_turns_all_normals_to_it(self):
        self.write("front.xyz", "".join(" ".join(row[:3]) + "\n"
                                        for row in rows(self.folder / "p.xyz") if float(row[2]) > 0.1))
        for z in (9, -9):
            self.rholm("reconstruct", "front.xyz", "--holes", "keep", "--sensor", f"0,0,{z}",
                       "-o", "s.ply", "--ascii")
            text = (self.folder / "s.ply").read_text()
            names = re.findall(r"property \w+ (\w+)", text.split("element face")[0])
            n = int(re.search(r"element vertex (\d+)", text)[1])
            up = [float(line.split()[names.index("nz")]) > 0
                  for line in text.split("end_header\n")[1].splitlines()[:n]]
            self.assertGreater(up.count(z > 0), 0.99 * n)
            self.assertNotIn("sensor_x", names)

    def test_every_option_is_heard(self):
        self.rholm("make", "sample", "t.ply", "--points", "2500", "--noise", ".003", "--outliers",
                   ".02", "--holes", "1,.15", "-o", "bad.xyz")
        self.reconstruct("bad.xyz", output="plain.ply")
        plain = (self.folder / "plain.ply").read_bytes()
        for words in (["--tolerance", ".02"], ["--noise", ".006"], ["--holes", "keep"],
                      ["--resolution", "40"], ["--keep-outliers", "--min-component", "0"],
                      ["--ascii"], ["--confidence"]):
            self.reconstruct("bad.xyz", *words)
            self.assertNotEqual((self.folder / "s.ply").read_bytes(), plain, words)

    def test_scans_are_brought_together_or_kept(self):
        self.rholm("make", "sample", "t.ply", "--points", "4000", "--scans", "4", "--misalignment", ".01",
                   "-o", "scans.ply")
        report = self.reconstruct("scans.ply")["scans"]
        self.assertEqual(report["scans"], 4)
        self.assertLess(report["distance"], report["distance_before"] / 3)
        self.assertGreater(report["moved"], 0)
        self.assertRegex(self.rholm("reconstruct", "scans.ply", "-o", "s.ply").out,
                         r"(?m)^  scans +4, ")
        self.assertNotIn("scans", self.reconstruct("scans.ply", "--keep-scans"))
        self.assertNotIn("scans", self.reconstruct("p.xyz"))

    def test_holes_are_closed_or_kept(self):
        self.write("half.xyz", "".join(" ".join(row) + "\n" for row in rows(self.folder / "p.xyz")
                                       if float(row[0]) > 0))
        self.assertGreaterEqual(self.reconstruct("half.xyz")["holes"], 2)
        self.assertTrue(self.shape_of("s.ply")["closed"])
        self.reconstruct("half.xyz", "--holes", "keep")
        shape = self.shape_of("s.ply")
        self.assertFalse(shape["closed"])
        self.assertTrue(shape["manifold"])

    def test_confidence_is_less_where_there_are_no_points(self):
        self.write("half.xyz", "".join(" ".join(row) + "\n" for row in rows(self.folder / "p.xyz")
                                       if float(row[0]) > -0.9))
        report = self.reconstruct("half.xyz", "--confidence", "--ascii")
        self.assertGreater(report["unseen_area"], 0.02)
        self.assertGreaterEqual(report["unsure_area"], report["unseen_area"])
        text = (self.folder / "s.ply").read_text()
        names = re.findall(r"property \w+ (\w+)", text.split("element face")[0])
        at = names.index("confidence")
        vertices = [[float(x) for x in line.split()] for line in
                    text.split("end_header\n")[1].splitlines()[:report["vertices"]]]
        self.assertLess(min(v[at] for v in vertices if v[0] < -1.1), 0.1)
        self.assertGreater(min(v[at] for v in vertices if v[0] > -0.7), 0.9)
        self.assertIn("not known", self.rholm("reconstruct", "half.xyz", "--confidence", "-o",
                                              "s.ply").out)

    def test_double_walls_and_more_closed_than_seen_are_said(self):
        def ball(lowest, radius, n):
            lines = []
            for i in range(n):
                z, phi = lowest + (1 - lowest) * (i + 0.5) / n, 2.399963 * i
                s = math.sqrt(1 - z * z)
                n_xyz = (s * math.cos(phi), s * math.sin(phi), z)
                p_xyz = [radius * c for c in n_xyz]
                lines.append(" ".join(repr(c) for c in (*p_xyz, *n_xyz)) + "\n")
            return "".join(lines)
        self.write("part.xyz", ball(0.3, 1, 4000))
        done = self.rholm("reconstruct", "part.xyz", "-o", "s.ply", "--json")
        found = json.loads(done.out)
        self.assertAlmostEqual(found["points_area"], 2 * math.pi * 0.7, delta=0.3)
        self.assertGreater(found["closed_area"], found["points_area"])
        self.assertIn("closes holes", done.err)
        self.write("much.xyz", ball(-0.6, 1, 4000))
        done = self.rholm("reconstruct", "much.xyz", "-o", "s.ply", "--json")
        self.assertNotIn("closes holes", done.err)
        found = json.loads(done.out)
        self.assertAlmostEqual(found["area"] - found["closed_area"], found["points_area"],
                               delta=0.12 * found["points_area"])
        # Scans are misaligned by four spacings and not aligned: most caps contain two walls.
        self.rholm("make", "sample", "t.ply", "--points", "8000", "--scans", "6", "--misalignment",
                   ".032", "-o", "scans.ply")
        self.reconstruct("scans.ply")
        done = self.rholm("reconstruct", "scans.ply", "--keep-scans", "-o", "d.ply", code=4)
        self.assertIn("double walls", done.err)
        self.assertIn("d.ply", self.files())

    def test_points_of_a_plane_bound_no_solid(self):
        points = [(i / 40, j / 40 + 0.003 * (i * j % 7)) for i in range(40) for j in range(40)]
        self.write("plane.xyz", "".join(f"{x!r} {y!r} 0\n" for x, y in points))
        self.assertIn("bound no solid",
                      self.rholm("reconstruct", "plane.xyz", "-o", "s.ply", code=3).err)
        self.assertNotIn("s.ply", self.files())
        failed = self.rholm("reconstruct", "plane.xyz", "--holes", "keep", "-o", "s.ply", code=4)
        self.assertIn("uncertain", failed.err)
        self.assertFalse(self.shape_of("s.ply")["closed"])

    def test_an_isolated_point_far_away_is_left_out(self):
        lines = (self.folder / "p.xyz").read_text()
        self.write("far.xyz", lines + "1e7 0 0 1 0 0\n")
        self.assertEqual(self.reconstruct("far.xyz")["outliers"], 1)
        self.assertEqual(self.shape_of("s.ply")["genus"], 1)

    def test_resolution_is_along_the_longest_side(self):
        self.rholm("info", "p.xyz")
        coordinates = [[float(x) for x in row[:3]] for row in rows(self.folder / "p.xyz")]
        longest = max(max(c) - min(c) for c in zip(*coordinates))
        step = self.reconstruct("p.xyz", "--resolution", "50")["step"]
        self.assertAlmostEqual(step, longest / 50, 9)

    def test_simplify_keeps_the_shape_with_fewer_faces(self):
        full = self.reconstruct("p.xyz")
        self.assertEqual((full["full_faces"], full["simplify_error"]), (full["faces"], 0))
        for value, most in (("auto", full["faces"] / 2), ("3000", 3000),
                            ("5%", full["faces"] * 0.05)):
            report = self.reconstruct("p.xyz", "--simplify", value)
            self.assertLessEqual(report["faces"], most, value)
            self.assertEqual(report["full_faces"], full["faces"])
            self.assertGreater(report["simplify_error"], 0)
            shape = self.shape_of("s.ply")
            self.assertEqual(shape["counts"]["faces"], report["faces"])
            self.assertEqual((shape["components"], shape["genus"]), (1, 1))
            self.assertTrue(shape["closed"] and shape["manifold"] and shape["oriented"])
        text = self.rholm("reconstruct", "p.xyz", "-o", "s.ply", "--simplify", "10%").out
        self.assertRegex(text, r"(?m)^  simplified +from \d+ faces")
        for value in ("", "3", "0%", "101%", "nan", "1e99", "1000.5", "some"):
            failed = self.rholm("reconstruct", "p.xyz", "-o", "n.ply", "--simplify", value, code=2)
            self.assertIn("--simplify", failed.err)
        self.assertFalse((self.folder / "n.ply").exists())

    def test_threads_do_not_change_a_bit(self):
        outputs = []
        for threads in (1, 2):
            self.reconstruct("p.xyz", "--threads", threads)
            outputs.append((self.folder / "s.ply").read_bytes())
        self.assertEqual(*outputs)

    def test_a_stream_works_at_both_ends(self):
        data = (self.folder / "p.xyz").read_bytes()
        self.reconstruct("p.xyz")
        result = self.rholm("reconstruct", "-", "--format", "ply", "-o", "-", stdin=data)
        self.assertEqual(result.bytes, (self.folder / "s.ply").read_bytes())

    def test_colours_travel_along(self):
        points = rows(self.folder / "p.xyz")
        names = ["x", "y", "z", "nx", "ny", "nz"]
        self.write("c.ply", f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n" +
                   "".join(f"property double {name}\n" for name in names) +
                   "property uchar red\nend_header\n" +
                   "".join(" ".join(row) + f" {200 if float(row[0]) > 0 else 50}\n"
                           for row in points))
        self.reconstruct("c.ply", "--ascii")
        text = (self.folder / "s.ply").read_text()
        header, body = text.split("end_header\n")
        self.assertIn("property uchar red", header)
        names = re.findall(r"property \w+ (\w+)", header.split("element face")[0])
        count = int(re.search(r"element vertex (\d+)", header)[1])
        for line in body.splitlines()[:count]:
            values = dict(zip(names, line.split()))
            if abs(float(values["x"])) > 0.3:  # beyond the reach of points on the other side
                self.assertEqual(values["red"], "200" if float(values["x"]) > 0 else "50")

    def test_vertices_of_a_mesh_are_points(self):
        result = self.rholm("reconstruct", "t.ply", "-o", "s.ply")
        self.assertIn("used as points", result.err)
        self.assertEqual(self.shape_of("s.ply")["genus"], 1)

    def test_more_memory_than_allowed_is_refused_before_any_output(self):
        result = self.rholm("reconstruct", "p.xyz", "--resolution", "4000", "--max-memory", "0.1",
                            "-o", "s.ply", code=1)
        self.assertRegex(result.err, r"102 MiB allowed: take steps of [0-9.e-]+ ")
        self.assertNotIn("s.ply", self.files())
        # The value that the message suggests for the option works.
        fits = re.search(r"(\d+) along the longest side", result.err)[1]
        self.assertLess(int(fits), 4000)
        self.rholm("reconstruct", "p.xyz", "--resolution", fits, "--max-memory", "0.1",
                   "-o", "s.ply")

    def test_wrong_words_and_points_without_a_surface_are_refused(self):
        for words, saying in ((["--noise", "much"], "--noise"), (["--noise", "-1"], "--noise"),
                              (["--noise", "nan"], "--noise"), (["--holes", "shut"], "--holes"),
                              (["--tolerance", "2"], "--tolerance"),
                              (["--resolution", "3"], "--resolution"),
                              (["--min-component", "1.5"], "--min-component"),
                              (["--max-memory", "0"], "--max-memory")):
            self.assertIn(saying, self.rholm("reconstruct", "p.xyz", *words, "-o", "o.ply",
                                             code=2).err)
        self.assertIn("faces", self.rholm("reconstruct", "p.xyz", "-o", "o.xyz", code=2).err)
        points = (self.folder / "p.xyz").read_text().splitlines()
        bare = [" ".join(line.split()[:3]) for line in points if not line.startswith("#")]
        for content in ("", "0 0 0\n", "0 0 0\n" * 50, "\n".join(bare[:15]) + "\n",
                        "".join(f"{i} 0 0\n" for i in range(50)),
                        "nan 0 0\n" * 50):
            self.write("few.xyz", content)
            self.assertIn("rholm: error:", self.rholm("reconstruct", "few.xyz", "-o", "o.ply",
                                                      code=3).err)
        self.assertNotIn("o.ply", self.files())

    def test_the_surface_can_be_made_again_from_the_model_alone(self):
        # Half of the points: most of the closed part is far from all points.
        half = [line for line in (self.folder / "p.xyz").read_text().splitlines(True)
                if line.startswith("#") or float(line.split()[0]) > 0]
        self.write("half.xyz", "".join(half))
        for points in ("p.xyz", "half.xyz"):
            for words in ((), ("--holes", "keep"), ("--simplify", "10%", "--min-component", "0")):
                self.rholm("reconstruct", points, "--model", "m.h5", "-o", "s.ply", *words)
                self.assertIn("atlas of caps", self.rholm("info", "m.h5").out)
                made = self.rholm("synthesize", "m.h5", "-o", "again.ply")
                self.assertNotIn("warning", made.err)
                self.assertEqual((self.folder / "again.ply").read_bytes(),
                                 (self.folder / "s.ply").read_bytes(), (points, words))
        # Options take precedence over the model.
        self.rholm("synthesize", "m.h5", "-o", "whole.ply", "--simplify", "none")
        self.assertGreater(os.path.getsize(self.folder / "whole.ply"),
                           5 * os.path.getsize(self.folder / "again.ply"))

    def test_a_model_says_what_it_does_not_hold(self):
        self.rholm("reconstruct", "p.xyz", "--confidence", "--model", "m.h5", "-o", "s.ply")
        self.assertIn("the attribute confidence", self.rholm("info", "m.h5").out)
        kept = self.rholm("info", "m.h5", "--json").json()["reconstruction"]
        self.assertEqual((kept["holes"], kept["left_out"]), ("fill", ["confidence"]))
        made = self.rholm("synthesize", "m.h5", "-o", "again.ply")
        self.assertIn("the model does not store the attribute confidence", made.err)
        self.assertEqual(made.err.count("warning"), 1)
        self.rholm("reconstruct", "p.xyz", "--model", "-", "-o", "s.ply", code=2)


class Tiles(CliTest):
    """With more points than --tile-points the surface is made in parts."""

    def setUp(self):
        super().setUp()
        self.rholm("make", "torus", "-o", "t.ply")
        self.rholm("make", "sample", "t.ply", "--points", "5000", "-o", "p.ply")

    def tiles(self, *words, output="s.ply", n=1250, **options):
        return self.rholm("reconstruct", *words, "--tile-points", n, "-o", output, **options)

    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def test_the_model_gives_the_surface_of_tiles_in_another_order(self):
        said = self.tiles("p.ply", "--model", "m.h5")
        self.assertRegex(said.out, r"(?m)^  tiles +4, ")
        self.assertTrue(self.rholm("info", "m.h5", "--json").json()["reconstruction"]["tiles"])
        self.assertIn("made in tiles", self.rholm("synthesize", "m.h5", "-o", "again.ply").err)
        counts = [self.rholm("info", name, "--json").json()["counts"] for name in ("s.ply", "again.ply")]
        self.assertEqual(*counts)
        relative = self.rholm("compare", "s.ply", "again.ply", "--json").json()["relative"]
        # Tiles sum winding numbers in another order, and these close small gaps between caps. The bound is
        # far below a step of 1e-2 (chosen).
        for way in ("a_to_b", "b_to_a"):
            self.assertLess(relative[way]["max"], 1e-5)

    def test_a_torus_in_tiles_is_that_in_one_piece(self):
        self.rholm("make", "sample", "t.ply", "--points", "5000", "-o", "p.ply")
        said = self.tiles("p.ply", "--json", n=1250)
        self.assertRegex(said.err, r"5000 points in 4 tiles: some [\d.]+ GB of memory")
        report = json.loads(said.out)
        self.assertEqual((report["points"], report["tiles"]), (5000, 4))
        shape = self.rholm("info", "s.ply", "--json").json()
        self.assertEqual((shape["components"], shape["genus"], shape["closed"]), (1, 1, True))
        self.assertEqual((shape["counts"]["vertices"], shape["counts"]["faces"]),
                         (report["vertices"], report["faces"]))
        one = self.rholm("reconstruct", "p.ply", "-o", "one.ply", "--json").json()
        self.assertNotIn("tiles", one)
        self.assertAlmostEqual(report["area"] / one["area"], 1, delta=1e-3)
        self.assertAlmostEqual(report["diagonal"], one["diagonal"], delta=1e-6)
        # If the limit is the number of points, there are no tiles.
        self.tiles("p.ply", n=5000, output="same.ply")
        self.assertEqual(self.bytes("same.ply"), self.bytes("one.ply"))

    @nightly
    def test_neither_memory_nor_threads_nor_the_way_of_reading_changes_a_byte(self):
        self.tiles("p.ply")
        content = self.bytes("p.ply")
        (self.folder / "work").mkdir()
        for words, options in ((["p.ply", "--threads", "1", "--max-memory", "0.005"], {}),
                               (["-"], {"stdin": content}),
                               (["-", "--max-memory", "0.005"], {"stdin": content})):
            self.tiles(*words, "--work-dir", "work", output="other.ply", **options)
            self.assertEqual(self.bytes("other.ply"), self.bytes("s.ply"), words)
            self.assertEqual(os.listdir(self.folder / "work"), [])
        self.rholm("convert", "p.ply", "p.xyz")
        self.tiles("p.xyz", output="other.ply")
        self.assertEqual(self.bytes("other.ply"), self.bytes("s.ply"))

    @nightly_too
    def test_little_memory_is_refused_with_tiles_that_fit(self):
        points = 40000 if NIGHTLY else 8000
        self.rholm("make", "sample", "t.ply", "--points", points, "-o", "p.ply")
        self.rholm("reconstruct", "p.ply", "-o", "one.ply")
        # A sufficient limit changes nothing.
        self.rholm("reconstruct", "p.ply", "-o", "s.ply", "--max-memory", "0.1")
        self.assertEqual(self.bytes("s.ply"), self.bytes("one.ply"))
        refused = self.rholm("reconstruct", "p.ply", "-o", "s.ply", "--max-memory", "0.006", code=1)
        self.assertIn("0.013 GiB would do for tiles of 3100 points (--tile-points 3100)", refused.err)
        # The run is refused with `less` memory; `limit` is enough for the tiles that the message names.
        for less, limit in (("0.013", "0.013"), ("0.025", "0.025")) if NIGHTLY else (("0.006", "0.013"),):
            for words in ((), ("--tile-points", "30000")) if NIGHTLY else (("--tile-points", "6000"),):
                refused = self.rholm("reconstruct", "p.ply", "-o", "s.ply", "--max-memory", less, *words, code=1)
                fits = re.search(r"--tile-points (\d+)", refused.err)[1]
                made = self.rholm("reconstruct", "p.ply", "-o", "s.ply", "--max-memory", limit, "--tile-points", fits)
                self.assertIn(f"{points} points in", made.err)
                self.assertEqual(self.rholm("info", "s.ply", "--json").json()["genus"], 1)
                # The limit of memory does not change the result of these tiles.
                self.rholm("reconstruct", "p.ply", "-o", "wide.ply", "--tile-points", fits)
                self.assertEqual(self.bytes("s.ply"), self.bytes("wide.ply"))

    def test_the_old_name_of_tile_points_is_understood(self):
        said = self.rholm("reconstruct", "p.ply", "--brick-points", "1250", "-o", "old.ply")
        self.assertIn("--brick-points is --tile-points now", said.err)
        self.assertNotIn("is --tile-points now", self.tiles("p.ply").err)
        self.assertEqual(self.bytes("old.ply"), self.bytes("s.ply"))
        self.assertIn("--brick-points is", self.rholm("reconstruct", "p.ply", "--brick-points=1250", "-o", "old.ply").err)
        for words in (["reconstruct", "--help", "all"], ["completion", "bash"]):
            self.assertNotIn("brick", self.rholm(*words).out)

    def test_a_run_that_was_killed_is_taken_up(self):
        self.tiles("p.ply")
        words = ("p.ply", "--resume", "--work-dir", "work")
        (self.folder / "work").mkdir()
        folder = self.folder / "work" / "r.ply.tiles"
        for stage in ("caps", "mesh", "output"):  # the last stage writes a file
            def begun():
                piece = folder / "pieces" / stage
                return any(piece.glob("[0-9]")) if piece.is_dir() else piece.is_file()
            # The run waits when the second file of the stage, or the result, is about to get its name.
            letters, after = ("r.ply$", 0) if stage == "output" else (f"pieces/{stage}/", 1)
            mark = self.folder / "mark"
            with subprocess.Popen([RHOLM, "reconstruct", *words, "--tile-points", "1250", "-o", "r.ply",
                                   "--threads", "1"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL,
                                  env={**os.environ, **held(mark, letters, after)}) as run:
                until(mark.exists, f"it is in the stage {stage}", run)
                run.kill()
            mark.unlink()
            self.assertFalse((self.folder / "r.ply").exists())
            self.assertTrue(begun())
        self.assertIn("another run", self.tiles(*words, "--noise", "0", output="r.ply", code=3).err)
        self.tiles(*words, output="r.ply")
        self.assertEqual(self.bytes("r.ply"), self.bytes("s.ply"))
        self.assertEqual(os.listdir(self.folder / "work"), [])
        self.assertEqual(self.files(), ["p.ply", "r.ply", "s.ply", "t.ply", "work"])

    def test_what_cannot_be_done_in_tiles_is_said_before_the_work(self):
        self.assertIn("rholm convert", self.tiles("p.ply", output="s.obj", code=2).err)
        self.assertIn("rholm convert", self.tiles("p.ply", "--ascii", code=2).err)
        self.assertIn("--resume", self.tiles("-", "--resume", stdin=b"", code=2).err)
        self.assertIn("--resume", self.tiles("p.ply", "--resume", "--format", "ply", output="-", code=2).err)
        self.assertIn("nowhere", self.tiles("p.ply", "--max-memory", "0.005", "--work-dir", "nowhere", code=1).err)
        self.assertIn("--tile-points", self.tiles("p.ply", n=10, code=2).err)
        self.write("short.ply", self.bytes("p.ply")[:-7])
        self.tiles("short.ply", "--work-dir", ".", "--max-memory", "0.005", code=3)
        self.assertEqual(self.files(), ["p.ply", "short.ply", "t.ply"])


if __name__ == "__main__":
    main()
