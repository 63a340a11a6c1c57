"""The commands one after the other, on shapes with a known answer."""

import json
import math
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, OCTAHEDRON, binary_stl, main, off

try:
    import numpy
except ImportError:
    numpy = None


class Info(CliTest):
    def test_octahedron_has_its_counts_area_and_volume(self):
        self.write("a.off", off(*OCTAHEDRON))
        report = self.rholm("info", "a.off", "--json").json()
        self.assertEqual(report["kind"], "mesh")
        self.assertEqual(report["format"], "off")
        self.assertEqual(report["counts"], {"vertices": 6, "faces": 8, "edges": 12})
        self.assertTrue(report["closed"] and report["manifold"] and report["oriented"])
        self.assertFalse(report["inside_out"])
        self.assertEqual((report["components"], report["genus"]), (1, 0))
        self.assertAlmostEqual(report["volume"], 4 / 3, 14)
        self.assertAlmostEqual(report["area"], 4 * math.sqrt(3), 14)
        self.assertEqual(report["bounds"]["min"], [-1, -1, -1])

    def test_soup_is_closed_after_welding(self):
        self.write("a.stl", binary_stl(OCTAHEDRON))
        report = self.rholm("info", "a.stl", "--json").json()
        self.assertEqual(report["as_read"]["vertices"], 24)
        self.assertEqual(report["weld"]["merged_vertices"], 18)
        self.assertTrue(report["closed"])

    def test_torus_has_genus_one(self):
        self.rholm("make", "torus", "-o", "t.obj")
        self.assertEqual(self.rholm("info", "t.obj", "--json").json()["genus"], 1)

    def test_open_mesh_is_told_in_words(self):
        self.write("a.off", off(OCTAHEDRON[0], OCTAHEDRON[1][:-1]))
        self.assertRegex(self.rholm("info", "a.off").out, r"closed +no, 3 boundary edges")

    def test_mesh_inside_out_is_told_in_words(self):
        self.write("a.off", off(OCTAHEDRON[0], [f[::-1] for f in OCTAHEDRON[1]]))
        self.assertRegex(self.rholm("info", "a.off").out, r"inside out +yes")

    def test_points_are_points(self):
        self.write("p.xyz", "0 0 0 0 0 1\n1 0 0 0 0 1\n1 2 3 0 0 1\n")
        report = self.rholm("info", "p.xyz", "--json").json()
        self.assertEqual((report["kind"], report["counts"]["points"]), ("points", 3))
        self.assertTrue(report["normals"])
        self.assertEqual(report["bounds"]["max"], [1, 2, 3])

    def test_bare_text_is_told_from_points_by_its_lines(self):
        self.write("a.txt", "0 0 1 0\n1 0 0.5 0\n1 1 0 0.25\n")
        self.assertEqual(self.rholm("info", "a.txt", "--json").json()["kind"], "coefficients")
        self.write("b.txt", "0.5 0 1\n1 0 0.5\n1 1 0\n")
        self.assertEqual(self.rholm("info", "b.txt", "--json").json()["kind"], "points")


class Center(CliTest):
    def test_kernel_of_a_box_is_the_box(self):
        self.rholm("make", "box", "--size", "2,4,6", "--translate", "10,20,30", "-o", "b.ply")
        report = self.rholm("center", "b.ply", "--json").json()
        # The largest ball inside has radius 1; its centre is fixed along x only.
        self.assertAlmostEqual(report["center"][0], 10, 9)
        self.assertAlmostEqual(report["min_d"], 1, 9)
        self.assertTrue(report["star_shaped"])
        self.assertEqual(report["once_share"], 1)

    def test_torus_is_not_star_shaped_and_says_so(self):
        self.rholm("make", "torus", "-o", "t.ply")
        result = self.rholm("center", "t.ply", "--rays", "1000", "--json", code=3)
        report = result.json()
        self.assertFalse(report["star_shaped"])
        self.assertLess(report["min_d"], 0)
        self.assertEqual(report["rays"], 1000)
        self.assertIn("not star-shaped", self.rholm("center", "t.ply", code=3).out)

    def test_open_mesh_is_refused(self):
        self.write("a.off", off(OCTAHEDRON[0], OCTAHEDRON[1][:-1]))
        self.assertIn("3", self.rholm("center", "a.off", code=3).err)


class Analyze(CliTest):
    def setUp(self):
        super().setUp()
        self.write("a.off", off(*OCTAHEDRON))

    def numbers(self, name):
        """Returns all C and S of an SHTOOLS text."""
        rows = [line.split() for line in (self.folder / name).read_text().splitlines()
                if line[:1] != "#"]
        return [float(x) for row in rows for x in row[2:4]]

    def test_report_has_the_promised_keys(self):
        report = self.rholm("expand", "a.off", "--degree", "4", "-o", "a.h5", "--json").json()
        stages = {"read", "topology", "center", "transform", "order", "faces", "spread",
                  "fourier", "verify", "norms", "rays", "errors", "write"}
        self.assertEqual(set(report["seconds"]), stages)
        self.assertEqual(set(report["cpu_seconds"]), stages)
        self.assertEqual(report["degree"], 4)
        self.assertEqual(report["method"], "edge")
        self.assertEqual({k: report["counts"][k] for k in ("vertices", "faces", "edges")},
                         {"vertices": 6, "faces": 8, "edges": 12})
        self.assertGreater(report["counts"]["nodes"], 0)
        self.assertGreater(report["peak_memory_bytes"], 1e6)
        self.assertEqual(report["engine"], "fast")
        self.assertIsNone(report["closure_residual"])
        self.assertLess(report["fast"]["error"], 1e-8)
        # Each figure of an error states its kind.
        self.assertEqual(report["fast"]["kinds"]["error"], "measured")
        self.assertEqual(report["fast"]["measured_share"], 1)
        self.assertEqual(report["errors"]["kinds"]["rms"], "exact")
        self.assertEqual(report["errors"]["kinds"]["measured_max"], "measured")
        self.assertEqual(report["errors"]["kinds"]["max_bound"], "bound")
        self.assertGreaterEqual(report["errors"]["max_bound"], report["errors"]["measured_max"])
        for part in (report, report["fast"], report["errors"]):
            for figure, kind in part["kinds"].items():
                self.assertIn(figure, part)
                self.assertIn(kind, ("exact", "bound", "measured", "estimate"))
        direct = self.rholm("expand", "a.off", "--degree", "4", "--engine", "direct", "-o",
                            "b.h5", "--json").json()
        self.assertEqual(direct["engine"], "direct")
        self.assertLess(direct["closure_residual"], 1e-14)
        self.assertEqual([round(x, 9) for x in report["center"]], [0, 0, 0])

    def test_a_tolerance_finds_the_degree_and_the_model_keeps_the_errors(self):
        report = self.rholm("expand", "a.off", "--tolerance", "0.05", "-o", "a.h5", "--json").json()
        self.assertTrue(report["tolerance"]["met"])
        self.assertLessEqual(report["errors"]["rms"], 0.05)
        self.assertTrue(report["errors"]["rms_is_exact"])
        info = self.rholm("info", "a.h5", "--json").json()
        self.assertEqual(info["errors"], report["errors"])
        self.assertIn("rms over solid angle, exact", self.rholm("info", "a.h5").out)
        below = str(report["degree"] - 1)
        less = self.rholm("expand", "a.off", "--degree", below, "-o", "b.h5", "--json").json()
        self.assertGreater(less["errors"]["rms"], 0.05)
        spectrum = self.rholm("spectrum", "a.h5", "--tolerance", "0.05", "--json").json()
        self.assertEqual(spectrum["tolerance_degree"], report["degree"])

    def test_a_tolerance_that_is_not_kept_is_exit_code_4(self):
        result = self.rholm("expand", "a.off", "--tolerance", "1e-9", "--max-degree", "9", "-o",
                            "a.h5", code=4)
        self.assertIn("is not reached by degree 9", result.err)
        self.assertTrue((self.folder / "a.h5").exists())

    def test_a_precision_that_is_not_reached_is_exit_code_4(self):
        self.rholm("make", "ellipsoid", "--axes", "1,1,1e-10", "--subdivisions", "2", "-o", "flat.ply")
        result = self.rholm("expand", "flat.ply", "--degree", "6", "-o", "flat.h5", code=4)
        self.assertIn("--engine direct", result.err)
        self.assertTrue((self.folder / "flat.h5").exists())

    def test_degree_and_tolerance_exclude_each_other(self):
        self.rholm("expand", "a.off", "-o", "a.h5", code=2)
        self.rholm("expand", "a.off", "--degree", "3", "--tolerance", "1", "-o", "a.h5", code=2)
        self.rholm("expand", "a.off", "--degree", "3", "--norm", "max", "-o", "a.h5", code=2)
        self.rholm("expand", "a.off", "--tolerance", "0", "-o", "a.h5", code=2)

    def test_monte_carlo_says_how_sure_it_is(self):
        for method in ("monte-carlo-edge", "monte-carlo-triangle"):
            report = self.rholm("expand", "a.off", "--degree", "4", "--method", method,
                                "--deviation", "0.6", "-o", "a.json", "--json").json()
            self.assertTrue(report["deviation_reached"])
            self.assertLessEqual(report["relative_deviation"], 0.6)
            self.assertEqual(report["method"], method)
            self.assertEqual(len(report["degree_deviation"]), 5)
            self.rholm("expand", "a.off", "--degree", "4", "--method", method, "--deviation",
                       "1e-7", "--most-samples", "4", "-o", "a.json", code=4)
            self.rholm("expand", "a.off", "--tolerance", "4", "--method", method, "-o", "a.json",
                       code=2)
        self.rholm("expand", "a.off", "--degree", "4", "--samples", "4", "-o", "a.json", code=2)
        # This is the distance of the origin from x + y + z = 1; a corner is seen at the angle of the normal.
        self.assertAlmostEqual(report["min_d"], 1 / math.sqrt(3), 9)
        self.assertAlmostEqual(report["min_cos_gamma"], 1 / math.sqrt(3), 9)

    def test_methods_of_the_radius_agree(self):
        values = []
        for method in ("edge", "curl", "area"):
            out = f"{method}.json"
            self.rholm("expand", "a.off", "--degree", "8", "--method", method, "--center", "none",
                       "--precision", "1e-11", "-o", out)
            self.rholm("convert", out, f"{method}.sh")
            values.append(self.numbers(f"{method}.sh"))
        for other in values[1:]:
            self.assertLess(max(abs(a - b) for a, b in zip(values[0], other)), 1e-9)

    def test_four_pi_normalised_c00_is_the_mean_radius(self):
        # Every point of an icosphere lies between the sphere and its deepest face centre.
        self.rholm("make", "sphere", "--subdivisions", "5", "-o", "s.ply")
        self.rholm("expand", "s.ply", "--degree", "2", "-o", "s.sh")
        first = [line for line in (self.folder / "s.sh").read_text().splitlines()
                 if line[:1] != "#"][0].split()
        self.assertEqual(first[:2], ["0", "0"])
        # An edge of the icosahedron spans 1.107, a part of it about 1.107 / 2^5, and less than twice that. A
        # face centre is at most edge / sqrt 3 from its corners.
        self.assertLess(float(first[2]), 1)
        self.assertGreater(float(first[2]), math.cos(2 * 1.107 / 32 / math.sqrt(3)))

    def test_points_are_refused_with_words(self):
        self.write("p.xyz", "0 0 0\n1 0 0\n0 1 0\n")
        result = self.rholm("expand", "p.xyz", "--degree", "2", "-o", "p.h5", code=3)
        self.assertIn("3 points without faces", result.err)

    def test_coefficients_are_refused_with_words(self):
        self.rholm("expand", "a.off", "--degree", "2", "-o", "a.h5")
        result = self.rholm("expand", "a.h5", "--degree", "2", "-o", "b.h5", code=3)
        self.assertIn("rholm synthesize", result.err)

    def test_inside_out_is_turned_and_said(self):
        self.write("b.off", off(OCTAHEDRON[0], [f[::-1] for f in OCTAHEDRON[1]]))
        precise = ["--precision", "1e-13", "-o"]
        result = self.rholm("expand", "b.off", "--degree", "2", *precise, "b.sh", "--json")
        self.assertTrue(result.json()["flipped"])
        self.assertIn("inside out", result.err)
        self.rholm("expand", "a.off", "--degree", "2", *precise, "a.sh")
        for a, b in zip(self.numbers("a.sh"), self.numbers("b.sh"), strict=True):
            self.assertAlmostEqual(a, b, 12)

    def test_not_star_shaped_is_refused_unless_signed(self):
        self.rholm("make", "torus", "--segments", "24x12", "-o", "t.ply")
        words = ["expand", "t.ply", "--degree", "4", "-o", "t.h5"]
        refusal = self.rholm(*words, code=3).err
        self.assertIn("star", refusal)
        self.assertIn("rholm compress", refusal)
        self.assertNotIn("--signed", refusal)
        self.assertNotIn("t.h5", self.files())
        # The best centre of the torus lies in the hole, off the surface.
        result = self.rholm(*words, "--signed", "--center", "none", "--json")
        self.assertFalse(result.json()["star_shaped"])
        self.assertTrue(result.json()["signed_sum"])
        self.assertIn("signed sum", result.err)

    def test_a_signed_sum_has_no_figures_of_the_body(self):
        self.rholm("make", "torus", "--segments", "24x12", "-o", "t.ply")
        words = ["expand", "t.ply", "--degree", "4", "--signed", "--center", "none"]
        for name, more in (("t.h5", []), ("t.sh", []), ("t.gfc", []), ("t.json", []),
                           ("d.h5", ["--engine", "direct"]), ("g.h5", ["--method", "gauge"]),
                           ("m.h5", ["--method", "monte-carlo-edge", "--samples", "4"])):
            self.rholm(*words, *more, "-o", name)
            info = self.rholm("info", name, "--json").json()
            self.assertTrue(info["signed_sum"], name)
            for figure in ("volume", "area", "sphericity", "volume_centroid", "truncation_rms"):
                self.assertIsNone(info[figure], (name, figure))
        self.assertIn("not known", self.rholm("info", "t.h5").out)
        for command in (["rotate", "t.h5", "--euler", "10,20,30", "-o"],
                        ["filter", "t.h5", "--low-pass", "3", "-o"], ["convert", "t.h5"]):
            self.rholm(*command, "u.json")
            self.assertTrue(self.rholm("info", "u.json", "--json").json()["signed_sum"], command)
        self.assertIn("signed sum", self.rholm("recenter", "t.h5", "-o", "v.h5", code=3).err)
        self.rholm("report", "t.h5", "-o", "t.html")
        self.assertIn("not known", (self.folder / "t.html").read_text())
        # A star-shaped shape gives no signed sum, even if one is allowed.
        self.rholm("make", "bumpy", "-o", "b.ply")
        self.rholm("expand", "b.ply", "--degree", "4", "--signed", "-o", "b.h5")
        info = self.rholm("info", "b.h5", "--json").json()
        self.assertFalse(info["signed_sum"])
        self.assertGreater(info["volume"], 0)

    # The truncation error of an ellipsoid's faces is below what coefficients of precision 1e-8 determine.
    def test_truncation_error_below_the_precision_is_not_known(self):
        self.rholm("make", "ellipsoid", "--axes", "3,2,1", "--subdivisions", "5", "-o", "e.ply")
        for more, measured in (([], True), (["--no-errors"], False)):
            report = self.rholm("expand", "e.ply", "--degree", "40", *more, "-o", "e.h5", "--json")
            self.assertIsNone(report.json()["truncation_rms"])
            report = self.rholm("spectrum", "e.h5", "--tolerance", "1e-9", "--json").json()
            rms = report["rms_beyond"]
            self.assertIsNone(rms[40])
            self.assertIsNone(report["tolerance_degree"])
            self.assertIsNone(self.rholm("info", "e.h5", "--json").json()["truncation_rms"])
            # Known figures end where the bound begins.
            self.assertTrue(all(x is None or x > 0.8 * report["rms_beyond_bound"] for x in rms))
            self.assertTrue(all(x is not None for x in rms[:8]))
            text = self.rholm("spectrum", "e.h5", "--tolerance", "1e-9").out
            self.assertIn("not known", text.splitlines()[42])
            self.assertIn("never within 1e-09, as measured" if measured
                          else "whether any degree is within 1e-09 is not known", text)
            within = self.rholm("spectrum", "e.h5", "--tolerance", "0.05").out
            self.assertIn("within 0.05 from degree", within)
            self.assertEqual("not known" in self.rholm("info", "e.h5").out, not measured)
            self.rholm("spectrum", "e.h5", "--tolerance", "1e-9", "-o", "e.csv")
            self.assertTrue((self.folder / "e.csv").read_text().endswith(",\n"))
            self.rholm("spectrum", "e.h5", "--tolerance", "1e-9", "-o", "e.svg")
            self.assertIn("known to degree", (self.folder / "e.svg").read_text())
        self.rholm("convert", "e.h5", "e.npy")
        text = self.rholm("spectrum", "e.npy", "--tolerance", "0.05").out
        self.assertIn("not known: the file has no norm", text)
        self.assertIn("of the file's own degrees", text)

    def test_threads_do_not_change_a_bit(self):
        self.rholm("make", "bumpy", "--subdivisions", "4", "-o", "m.ply")
        for method in ("edge", "gauge", "area"):
            for threads in (1, 2, 3):
                self.rholm("expand", "m.ply", "--degree", "24", "--method", method, "--threads",
                           threads, "-o", f"{threads}.npy")
            contents = {(self.folder / f"{t}.npy").read_bytes() for t in (1, 2, 3)}
            self.assertEqual(len(contents), 1, method)

    def test_streams_work_at_both_ends(self):
        piped = self.rholm("expand", "-", "--degree", "3", "--format", "shtools", "-o", "-",
                           stdin=(self.folder / "a.off").read_bytes())
        self.rholm("expand", "a.off", "--degree", "3", "-o", "a.sh")
        self.assertEqual(piped.out, (self.folder / "a.sh").read_text())


class Synthesize(CliTest):
    def setUp(self):
        super().setUp()
        self.rholm("make", "bumpy", "--subdivisions", "4", "-o", "b.ply")
        self.rholm("expand", "b.ply", "--degree", "24", "-o", "b.h5")

    def vertices(self, name):
        return self.rholm("info", name, "--json").json()["counts"]["vertices"]

    def test_sampling_has_the_asked_number_of_vertices(self):
        self.rholm("synthesize", "b.h5", "--subdivisions", "3", "-o", "o.ply")
        self.assertEqual(self.vertices("o.ply"), 10 * 4**3 + 2)
        self.rholm("synthesize", "b.h5", "--grid", "10x20", "-o", "o.ply")
        self.assertEqual(self.vertices("o.ply"), 10 * 20 + 2)
        self.rholm("synthesize", "b.h5", "--like", "b.ply", "-o", "o.ply")
        self.assertEqual(self.vertices("o.ply"), 10 * 4**4 + 2)
        # 2 (24 + 1)^2 = 1250 vertices would suffice; 4 subdivisions are the minimum.
        self.rholm("synthesize", "b.h5", "-o", "o.ply")
        self.assertEqual(self.vertices("o.ply"), 10 * 4**4 + 2)

    def test_several_degrees_make_several_files(self):
        report = self.rholm("synthesize", "b.h5", "--degree", "2,8,24", "-o", "lod.obj",
                            "--json").json()
        names = ["lod-L2.obj", "lod-L8.obj", "lod-L24.obj"]
        self.assertEqual([o["file"] for o in report["outputs"]], names)
        errors = [self.rholm("compare", "b.ply", n, "--samples", "20000", "--json").json()
                  ["a_to_b"]["rms"] for n in names]
        self.assertGreater(errors[0], errors[1])
        self.assertGreater(errors[1], errors[2])

    def test_a_degree_beyond_the_model_is_cut_and_said(self):
        self.assertIn("24", self.rholm("synthesize", "b.h5", "--degree", "99", "-o", "o.ply").err)

    def test_all_formats_hold_the_same_mesh(self):
        for name in ("o.ply", "o.obj", "o.off", "o.stl"):
            self.rholm("synthesize", "b.h5", "-o", name)
            report = self.rholm("info", name, "--json").json()
            self.assertTrue(report["closed"], name)
            self.assertEqual(report["counts"]["faces"], 20 * 4**4, name)

    def test_standard_output_is_the_file(self):
        self.rholm("synthesize", "b.h5", "-o", "o.ply")
        piped = self.rholm("synthesize", "b.h5", "--format", "ply", "-o", "-")
        self.assertEqual(piped.bytes, (self.folder / "o.ply").read_bytes())

    def test_the_model_returns_to_the_mesh(self):
        report = self.rholm("compare", "b.ply", "b.h5", "--json").json()
        self.assertLess(report["relative"]["a_to_b"]["rms"], 1e-3)


class Compare(CliTest):
    def test_cube_in_a_cube_is_half_the_difference_away(self):
        self.rholm("make", "box", "--size", "2,2,2", "-o", "a.ply")
        self.rholm("make", "box", "--size", "4,4,4", "-o", "b.ply")
        report = self.rholm("compare", "a.ply", "b.ply", "--samples", "5000", "--seed", "3",
                            "--json").json()
        diagonal = math.sqrt(12)
        self.assertEqual((report["samples"], report["seed"]), (5000, 3))
        for key in ("rms", "mean", "max"):
            self.assertAlmostEqual(report["a_to_b"][key], 1, 12)
            self.assertAlmostEqual(report["relative"]["a_to_b"][key], 1 / diagonal, 12)
        # In the other direction, faces are at 1 in the middle and at sqrt 3 at the corners.
        self.assertLessEqual(report["b_to_a"]["max"], math.sqrt(3))
        self.assertAlmostEqual(report["hausdorff"], report["b_to_a"]["max"], 15)
        self.assertAlmostEqual(report["relative"]["hausdorff"], report["hausdorff"] / diagonal, 15)
        self.assertIn("normal_median_degrees", report)

    def test_same_mesh_is_at_distance_zero(self):
        self.write("a.off", off(*OCTAHEDRON))
        report = self.rholm("compare", "a.off", "a.off", "--samples", "1000", "--json").json()
        self.assertLess(report["hausdorff"], 1e-14)
        self.assertEqual(report["f_score"], 1)


class Spectrum(CliTest):
    def test_sums_up_to_the_norm(self):
        self.write("a.off", off(*OCTAHEDRON))
        self.rholm("expand", "a.off", "--degree", "16", "--precision", "1e-11", "-o", "a.h5")
        report = self.rholm("spectrum", "a.h5", "--json").json()
        self.assertEqual(len(report["energy"]), 17)
        self.assertTrue(report["rms_beyond_includes_tail"])
        beyond = report["norm_squared"] - report["cumulative"][16]
        self.assertAlmostEqual(report["rms_beyond"][16], math.sqrt(beyond / (4 * math.pi)), 12)
        # The body is symmetric about a point: it has no odd degrees.
        self.assertLess(max(report["energy"][1::2]), 1e-20)

    def test_plots_are_written(self):
        self.write("a.off", off(*OCTAHEDRON))
        self.rholm("expand", "a.off", "--degree", "16", "-o", "a.h5")
        self.rholm("spectrum", "a.h5", "-o", "a.svg")
        self.assertTrue((self.folder / "a.svg").read_text().rstrip().endswith("</svg>"))
        self.rholm("spectrum", "a.h5", "-o", "a.csv")
        self.assertEqual(len((self.folder / "a.csv").read_text().splitlines()), 18)
        self.assertIn("rms beyond", self.rholm("spectrum", "a.h5").out)

    def test_a_tolerance_is_answered_with_its_degree(self):
        # Only degrees 0 and 2 exist: the error beyond degree l is known.
        self.write("a.sh", "0 0 1 0\n2 1 0.3 0.4\n")
        for tolerance, degree in ((1, 0), (0.05, 2)):
            self.assertIn(f"from degree {degree} on",
                          self.rholm("spectrum", "a.sh", "--tolerance", tolerance).out)
            report = self.rholm("spectrum", "a.sh", "--tolerance", tolerance, "--json").json()
            self.assertEqual(report["tolerance_degree"], degree)
        # The error beyond the file's coefficients is known, so that the answer may be: at no degree.
        self.write("a.off", off(*OCTAHEDRON))
        self.rholm("expand", "a.off", "--degree", "4", "-o", "a.h5")
        self.assertIn("never within", self.rholm("spectrum", "a.h5", "--tolerance", "1e-9").out)
        report = self.rholm("spectrum", "a.h5", "--tolerance", "1e-9", "--json").json()
        self.assertIsNone(report["tolerance_degree"])


class Convert(CliTest):
    def setUp(self):
        super().setUp()
        self.write("a.off", off(*OCTAHEDRON))
        self.rholm("expand", "a.off", "--degree", "5", "--center", "0.1,0.2,0.05", "--length-unit", "km",
                   "-o", "a.h5")

    def orthonormal(self, name):
        """Returns the coefficients of a file, converted through JSON."""
        self.rholm("convert", name, "probe.json", "--normalization", "orthonormal")
        return json.loads((self.folder / "probe.json").read_text())

    def test_every_format_and_convention_returns(self):
        first = self.orthonormal("a.h5")
        for name in ("b.sh", "b.gfc", "b.json"):
            for normalization in ("4pi", "orthonormal", "schmidt"):
                for csphase in ("1", "-1"):
                    self.rholm("convert", "a.h5", name, "--normalization", normalization,
                               "--csphase", csphase)
                    again = self.orthonormal(name)
                    self.assert_close(first, again, f"{name} {normalization} {csphase}")

    def assert_close(self, a, b, what):
        if isinstance(a, dict):
            for key in a:
                if key in b:
                    self.assert_close(a[key], b[key], what)
        elif isinstance(a, list):
            for x, y in zip(a, b):
                self.assert_close(x, y, what)
        elif isinstance(a, float) and isinstance(b, (int, float)):
            self.assertAlmostEqual(a, b, 14, what)

    def test_numpy_file_says_what_was_assumed(self):
        result = self.rholm("convert", "a.h5", "a.npy", "--normalization", "schmidt")
        self.assertIn("schmidt", result.err)
        self.assertIn("assumed", self.rholm("convert", "a.npy", "b.sh").err)

    @unittest.skipIf(numpy is None, "NumPy is not installed")
    def test_numpy_reads_the_array(self):
        self.rholm("convert", "a.h5", "a.npy")
        array = numpy.load(self.folder / "a.npy")
        self.assertEqual(array.shape, (2, 6, 6))
        self.assertEqual(array.dtype, numpy.float64)
        rows = [line.split() for line in self.rholm("convert", "a.h5", "-", "--format", "shtools")
                .out.splitlines() if line[:1] != "#"]
        for l, m, c, s in rows:
            self.assertEqual(array[0, int(l), int(m)], float(c))
            self.assertEqual(array[1, int(l), int(m)], float(s))

    def test_shapes_become_shapes(self):
        self.rholm("convert", "a.off", "a.ply")
        self.rholm("convert", "a.ply", "a.obj")
        self.rholm("convert", "a.obj", "b.off")
        self.assertAlmostEqual(self.rholm("info", "b.off", "--json").json()["volume"], 4 / 3, 14)
        self.rholm("convert", "a.off", "a.h5", code=2)
        self.rholm("convert", "a.h5", "a.ply", code=2)


class Render(CliTest):
    def png_size(self, name):
        data = (self.folder / name).read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        return int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")

    def test_pictures_have_the_asked_size_and_do_not_depend_on_threads(self):
        self.rholm("make", "bumpy", "--subdivisions", "3", "-o", "b.ply")
        self.rholm("expand", "b.ply", "--degree", "8", "-o", "b.h5")
        for threads in (1, 2):
            self.rholm("render", "b.h5", "b.ply", "--degree", "2,8", "--size", "300x120",
                       "--color", "error", "--against", "b.ply", "--threads", threads,
                       "-o", f"{threads}.png")
        self.assertEqual(self.png_size("1.png"), (300, 120))
        self.assertEqual((self.folder / "1.png").read_bytes(), (self.folder / "2.png").read_bytes())


if __name__ == "__main__":
    main()
