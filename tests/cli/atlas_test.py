"""Atlases of large caps: compress, info, synthesize, partition."""

import os
import re
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(__file__))
from harness import QHULL, CliTest, OCTAHEDRON, main, nightly, off

V, F = OCTAHEDRON


class Atlas(CliTest):
    @classmethod
    def setUpClass(cls):
        cls.kept = None  # a folder with t.h5 and the report, once they exist

    @classmethod
    def tearDownClass(cls):
        if cls.kept:
            shutil.rmtree(cls.kept[0])

    def setUp(self):
        super().setUp()
        self.rholm("make", "torus", "-o", "t.ply")

    def compress(self, name, *more):
        return self.rholm("compress", "t.ply", "--tolerance", "5e-3", "--unit", "diagonal",
                          "-o", name, "--json", *more).json()

    def make_model(self):
        """Copies t.h5 into the folder and returns its report; the model is made once for all tests, on two
        threads."""
        if self.kept:
            shutil.copy(os.path.join(self.kept[0], "t.h5"), self.folder)
        else:
            report = self.compress("t.h5", "--threads", "2")
            type(self).kept = tempfile.mkdtemp(prefix="rholm-test-"), report
            shutil.copy(self.folder / "t.h5", self.kept[0])
        return self.kept[1]

    def test_a_torus_goes_to_a_model_and_back(self):
        report = self.make_model()
        self.assertTrue(report["met"])
        info = self.rholm("info", "t.h5", "--json").json()
        self.assertEqual(info["kind"], "atlas")
        self.assertEqual(info["bytes"], (self.folder / "t.h5").stat().st_size)
        for key in ("caps", "coefficients", "numbers", "input_numbers", "errors"):
            self.assertEqual(info[key], report[key])
        self.assertEqual(info["numbers"], info["coefficients"] + info["frame_numbers"])
        self.assertIn("atlas of caps", self.rholm("info", "t.h5").out)
        # Another process reads the model from its file only.
        self.rholm("synthesize", "t.h5", "-o", "s.ply")
        surface = self.rholm("info", "s.ply", "--json").json()
        self.assertTrue(surface["closed"] and surface["manifold"] and surface["oriented"])
        self.assertFalse(surface["inside_out"])
        self.assertEqual(surface["genus"], 1)
        found = self.rholm("compare", "t.ply", "s.ply", "--json").json()
        for way in ("a_to_b", "b_to_a"):
            # Samples are other than in the report: measured errors differ by 1 % at 100000 samples.
            self.assertLess(found["relative"][way]["rms"], 5.1e-3)

    def test_wrong_sides_are_turned_or_said(self):
        """One face of an octahedron is flipped; all faces are flipped; points have normals inwards."""
        words = ["--tolerance", "0.1", "--max-degree", "4", "-o", "m.h5"]
        self.write("mixed.off", off(V, [F[0][::-1], *F[1:]]))
        self.assertIn("faces have opposite orientations at 3 edges",
                      self.rholm("compress", "mixed.off", *words, code=3).err)
        self.write("turned.off", off(V, [f[::-1] for f in F]))
        self.assertIn("inside out", self.rholm("compress", "turned.off", *words, "--max-numbers", "1000").err)
        self.rholm("make", "sample", "turned.off", "--points", "2000", "-o", "p.xyz")
        result = self.rholm("compress", "p.xyz", *words, "--json")
        self.assertIn("all normals pointed inwards", result.err)
        self.assertEqual(result.json()["input_numbers"], 6000)
        self.assertIn("not measured to the shape", self.rholm("info", "m.h5").out)

    @nightly
    def test_a_model_of_more_numbers_than_the_shape_is_refused(self):
        """An octahedron has 18 coordinates; the frame of a single cap has nine numbers."""
        words = ["--tolerance", "0.05", "-o", "m.h5"]
        self.write("few.off", off(V, F))
        result = self.rholm("compress", "few.off", *words, code=3)
        self.assertIn("18 coordinates", result.err)
        self.assertNotIn("m.h5", self.files())
        report = self.rholm("compress", "few.off", *words, "--max-numbers", "1000", "--json").json()
        self.assertGreater(report["numbers"], 18)

    @unittest.skipUnless(QHULL, "built without Qhull")
    def test_the_paper_s_way_is_there_to_compare_with(self):
        found = {}
        for extension in ("zero", "sphere"):
            found[extension] = self.rholm(
                "compress", "t.ply", "--fit", "integral", "--degree", "12",
                "--extension", extension, "-o", extension + ".h5", "--json").json()
            info = self.rholm("info", extension + ".h5", "--json").json()
            self.assertEqual(info["method"], f"integral, {extension} beyond")
            self.rholm("synthesize", extension + ".h5", "-o", extension + ".ply")
        # The jump to zero is as large as the radius.
        self.assertLess(2 * found["sphere"]["errors"]["rms_from_shape"],
                        found["zero"]["errors"]["rms_from_shape"])
        for words in (["--fit", "integral"], ["--fit", "integral", "--degree", "25"],
                      ["--fit", "integral", "--degree", "4", "--tolerance", "1"],
                      ["--extension", "zero", "--tolerance", "1"], ["--fit", "best"]):
            self.rholm("compress", "t.ply", *words, "-o", "x.h5", code=2)

    @nightly
    def test_resolution_and_degree_limit(self):
        step = self.make_model()["step"]
        counts = {}
        for name, words in {"own": (), "finer": ("--resolution", str(step / 2))}.items():
            counts[name] = self.rholm("synthesize", "t.h5", "-o", name + ".ply", "--json",
                                      *words).json()["counts"]["vertices"]
        self.assertGreater(counts["finer"], 3 * counts["own"])
        # The refusal names the smallest limit that works.
        refused = self.rholm("synthesize", "t.h5", "-o", "x.ply", "--degree-limit", "0", code=3)
        least = int(re.search(r"for this model is (\d+)$", refused.err).group(1))
        self.assertGreater(least, 1)
        self.rholm("synthesize", "t.h5", "-o", "x.ply", "--degree-limit", str(least - 1), code=3)
        self.assertNotIn("x.ply", self.files())
        self.rholm("synthesize", "t.h5", "-o", "flat.ply", "--degree-limit", str(least))
        self.assertEqual(self.rholm("info", "flat.ply", "--json").json()["genus"], 1)
        for step, code in ("1000", 3), ("1e-6", 1):
            refused = self.rholm("synthesize", "t.h5", "-o", "x.ply", "--resolution", step, code=code)
            self.assertIn("take s", refused.err)
            self.assertNotIn("x.ply", self.files())

    def test_report_draws_levels_that_are_whole(self):
        self.make_model()
        refused = self.rholm("synthesize", "t.h5", "-o", "x.ply", "--degree-limit", "1", code=3)
        least = re.search(r"for this model is (\d+)$", refused.err).group(1)
        self.rholm("report", "t.h5", "--shape", "t.ply", "--size", "64", "-o", "t.html")
        drawn = re.findall(r"degrees up to (\d+)", (self.folder / "t.html").read_text())
        self.assertEqual(drawn[0], least)
        self.assertEqual(int(drawn[-1]), max(map(int, drawn)))

    def test_simplify_goes_with_an_atlas_only(self):
        self.make_model()
        counts = self.rholm("synthesize", "t.h5", "-o", "s.ply", "--json", "--simplify",
                            "2000").json()["counts"]
        self.assertLessEqual(counts["faces"], 2000)
        shape = self.rholm("info", "s.ply", "--json").json()
        self.assertTrue(shape["closed"] and shape["manifold"])
        self.assertEqual(shape["genus"], 1)
        self.rholm("synthesize", "t.h5", "-o", "s.ply", "--simplify", "ten", code=2)
        self.rholm("make", "bumpy", "-o", "b.ply")
        self.rholm("expand", "b.ply", "--degree", "4", "-o", "star.h5")
        failed = self.rholm("synthesize", "star.h5", "-o", "s.ply", "--simplify", "auto", code=2)
        self.assertIn("--simplify", failed.err)

    def test_threads_do_not_change_a_byte(self):
        self.make_model()
        self.compress("one.h5", "--threads", "1")
        self.assertEqual((self.folder / "one.h5").read_bytes(),
                         (self.folder / "t.h5").read_bytes())

    def test_partition_colours_every_vertex(self):
        report = self.rholm("partition", "t.ply", "--tolerance", "5e-3", "-o", "c.ply",
                            "--json").json()
        self.assertGreater(report["caps"], 3)
        info = self.rholm("info", "c.ply", "--json").json()
        self.assertEqual([a["name"] for a in info["attributes"][-3:]], ["red", "green", "blue"])

    @unittest.skipUnless(QHULL, "built without Qhull")
    def test_partition_shows_degrees_and_the_steps_of_the_paper(self):
        report = self.rholm("partition", "t.ply", "--tolerance", "5e-3", "--show", "degrees", "-o",
                            "d.ply", "--json").json()
        self.assertLessEqual(*report["degrees"])
        faces = {}
        for view in ("patches", "triangles", "spheres"):
            report = self.rholm("partition", "t.ply", "--show", view, "-o", view + ".ply",
                                "--json").json()
            self.assertGreater(report["patches"], 3)
            info = self.rholm("info", view + ".ply", "--json").json()
            self.assertEqual([a["name"] for a in info["attributes"][-3:]], ["red", "green", "blue"])
            faces[view] = info["counts"]["faces"]
        self.assertEqual(len(set(faces.values())), 1)
        self.rholm("partition", "t.ply", "--show", "nothing", "-o", "n.ply", code=2)

    def test_options_that_do_not_go_together_are_refused(self):
        self.rholm("compress", "t.ply", "-o", "t.h5", code=2)
        for words in (("--degree", "3"), ("--center", "none"), ("--norm", "max"), ("--signed",)):
            self.rholm("compress", "t.ply", "--tolerance", "1", "-o", "t.h5", *words,
                       code=2)
        self.rholm("compress", "t.ply", "--tolerance", "1", "-o", "t.sh", code=2)
        self.make_model()
        self.rholm("synthesize", "t.h5", "--degree", "3", "-o", "s.ply", code=2)
        self.rholm("synthesize", "t.h5", "--resolution", "0", "-o", "s.ply", code=2)
        self.rholm("spectrum", "t.h5", code=3)

    def test_damaged_models_are_refused(self):
        self.make_model()
        model = (self.folder / "t.h5").read_bytes()
        (self.folder / "cut.h5").write_bytes(model[:-100])
        self.rholm("info", "cut.h5", code=3)
        self.rholm("synthesize", "cut.h5", "-o", "s.ply", code=3)


if __name__ == "__main__":
    main()
