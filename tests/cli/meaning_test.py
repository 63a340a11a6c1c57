"""The meaning of files and messages about it: conventions, units, files that are no shapes, losses, and the
output that --quiet leaves."""

import json
import os
import re
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, main

GRAVITY = """product_type gravity_field
earth_gravity_constant 0.3986004415E+15
radius 0.6378136300E+07
max_degree 2
norm fully_normalized
key L M C S
end_of_head
gfc 0 0 1.0 0.0
gfc 2 0 -4.8D-04 0.0
gfc 2 2 2.4e-06 -1.4e-06
"""

# A body like an ellipsoid: (l, m, C, S), 4-pi normalised.
BARE = "0 0 1 0\n1 0 0 0\n1 1 0 0\n2 0 -0.1 0\n2 1 0.02 0.01\n2 2 0.05 -0.03\n"


def commands_that_read(model):
    """Returns each command that reads coefficients, with the file of a model."""
    return {
        "info": ["info", model],
        "synthesize": ["synthesize", model, "-o", "o.ply"],
        "spectrum": ["spectrum", model],
        "compare": ["compare", model, "s.ply", "--samples", "100"],
        "compare B": ["compare", "s.ply", model, "--samples", "100"],
        "convert": ["convert", model, "o.json"],
        "render": ["render", model, "--size", "32x32", "-o", "o.png"],
        "render --against": ["render", "s.ply", "--color", "error", "--against", model, "--size",
                             "32x32", "-o", "o.png"],
        "report": ["report", model, "--size", "16", "-o", "o.html"],
        "filter": ["filter", model, "--low-pass", "1", "-o", "o.h5"],
        "rotate": ["rotate", model, "--mirror", "x", "-o", "o.h5"],
        "recenter": ["recenter", model, "-o", "o.h5"],
        "align": ["align", model, "s.h5"],
        "align B": ["align", "s.h5", model],
        "smooth": ["smooth", model, "--region", "ball:0,0,1,0.5", "--wavelength", "0.5", "-o",
                   "o.ply"],
        "transfer": ["transfer", "--from", model, "--from-region", "ball:0,0,1,0.5", "--to",
                     "s.ply", "--to-region", "ball:0,0,1,0.5", "-o", "o.ply"],
    }


class Meaning(CliTest):
    def setUp(self):
        super().setUp()
        self.rholm("make", "ellipsoid", "--axes", "1.2,1.1,1", "--subdivisions", "4", "-o", "s.ply")
        self.rholm("expand", "s.ply", "--degree", "4", "--no-errors", "--quiet", "-o", "s.h5")

    def model(self, name, unit, degree=4):
        self.rholm("expand", "s.ply", "--degree", degree, "--length-unit", unit, "--quiet", "-o",
                   name)


class Conventions(Meaning):
    def test_every_command_says_what_it_assumed(self):
        self.write("bare.sh", BARE)
        for name, words in commands_that_read("bare.sh").items():
            with self.subTest(name):
                result = self.rholm(*words)
                said = re.findall(r"bare.sh does not state its convention; assumed: (.*)", result.err)
                self.assertEqual(said, ["normalization 4pi, csphase 1, function radius, "
                                        "center 0 0 0"], str(result))

    def test_every_command_takes_what_it_is_told_instead(self):
        self.write("bare.sh", BARE)
        told = ["--input-normalization", "schmidt", "--input-csphase", "-1"]
        for name, words in commands_that_read("bare.sh").items():
            with self.subTest(name):
                said = self.rholm(*words, *told).err
                self.assertIn("assumed: function radius, center 0 0 0", said)
                self.assertNotIn("csphase", said)

    def test_what_is_told_counts(self):
        # C_20 in Schmidt's normalisation is the 4-pi normalised one times sqrt 5. The phase changes the sign
        # of odd orders.
        self.write("bare.sh", BARE)
        energy = {}
        for normalization in ("4pi", "schmidt"):
            energy[normalization] = self.rholm("spectrum", "bare.sh", "--json",
                                               "--input-normalization",
                                               normalization).json()["energy"][2]
        self.assertAlmostEqual(energy["4pi"] / energy["schmidt"], 5, 12)
        for phase, sign in (("1", 1), ("-1", -1)):
            self.rholm("filter", "bare.sh", "--low-pass", "2", "--window", "ideal", "-o", "o.json",
                       "--input-csphase", phase)
            row = json.loads((self.folder / "o.json").read_text())["coefficients"]["C"][2]
            self.assertAlmostEqual(row[1], sign * 0.02, 14)
            self.assertAlmostEqual(row[2], 0.05, 14)

    def test_files_that_say_it_are_not_talked_about(self):
        self.rholm("convert", "s.h5", "s.json")
        for model in ("s.h5", "s.json"):
            self.assertNotIn("assumed", self.rholm("spectrum", model).err)

    def test_quiet_is_quiet_about_it(self):
        self.write("bare.sh", BARE)
        self.assertEqual(self.rholm("synthesize", "bare.sh", "--quiet", "-o", "o.ply").err, "")


class NoShape(Meaning):
    def test_gravity_field_makes_no_surface(self):
        self.write("g.gfc", GRAVITY)
        before = self.files()
        for name, words in commands_that_read("g.gfc").items():
            if name in ("info", "spectrum", "convert", "filter", "rotate"):
                continue
            with self.subTest(name):
                result = self.rholm(*words, code=3)
                self.assertIn("g.gfc is a gravity_field, no shape", result.err)
                self.assertEqual(self.files(), before)

    def test_its_numbers_are_taken_and_that_is_said(self):
        self.write("g.gfc", GRAVITY)
        for name in ("info", "spectrum", "convert", "filter", "rotate"):
            with self.subTest(name):
                said = self.rholm(*commands_that_read("g.gfc")[name]).err
                self.assertIn("g.gfc is a gravity_field, no shape", said)
                self.assertIn("gravity constant 398600441500000 m^3/s^2, reference radius 6378136.3 m",
                              said)
        report = self.rholm("info", "g.gfc", "--json").json()
        self.assertEqual(report["function"], "other")
        self.assertEqual(report["product"], "gravity_field")
        self.assertEqual(report["gravity_constant"], 0.3986004415E+15)
        self.assertEqual(report["reference_radius"], 6378136.3)
        self.assertIsNone(report["volume"])

    def test_no_format_makes_a_body_of_it(self):
        self.write("g.gfc", GRAVITY)
        for name in ("o.h5", "o.sh", "o.json", "o.gfc"):
            self.rholm("convert", "g.gfc", name)
            self.assertEqual(self.rholm("info", name, "--json").json()["function"], "other")
            self.assertIn("no shape", self.rholm("synthesize", name, "-o", "o.ply", code=3).err)
            self.rholm("spectrum", name)

    def test_what_it_is_relative_to_stays_and_may_be_given(self):
        def header(name):
            lines = (self.folder / name).read_text().split("end_of_head")[0].splitlines()
            return dict(line.split(None, 1) for line in lines if len(line.split()) > 1)
        self.write("g.gfc", GRAVITY)
        # Uses every command that keeps the meaning of the numbers, and every format that can store it.
        for step, source in enumerate(("g.gfc", "0.h5", "1.json", "2.sh")):
            ending = ("h5", "json", "sh", "gfc")[step]
            words = (["convert"], ["filter", "--low-pass", "2"],
                     ["rotate", "--axis", "0,0,1", "--angle", "30"], ["rotate", "--mirror", "x"])[step]
            output = ["o.gfc"] if ending == "gfc" else [f"{step}.{ending}"]
            if words[0] != "convert":
                output.insert(0, "-o")
            self.rholm(words[0], source, *words[1:], *output)
        self.assertEqual(header("o.gfc")["product_type"], "gravity_field")
        self.assertEqual(float(header("o.gfc")["earth_gravity_constant"]), 0.3986004415E+15)
        self.assertEqual(float(header("o.gfc")["radius"]), 6378136.3)
        self.write("plain.json", (self.folder / "1.json").read_text()
                   .replace("gravity_constant", "a").replace("reference_radius", "b"))
        self.write("bare.sh", BARE)
        given = ("--gravity-constant", "4.9e12", "--reference-radius", "1738000")
        for source in ("1.json", "plain.json", "bare.sh"):  # these say that they are no surface, or nothing
            self.rholm("convert", source, "p.gfc", *given)
            self.assertEqual(header("p.gfc")["product_type"], "gravity_field")
            self.assertEqual(float(header("p.gfc")["earth_gravity_constant"]), 4.9e12)
            self.assertEqual(float(header("p.gfc")["radius"]), 1738000)
        self.rholm("convert", "s.h5", "p.gfc", *given, code=3)  # is a surface
        for words in (["1.json", "p.gfc", *given[:2]], ["1.json", "p.npy", *given],
                      ["1.json", "p.gfc", *given[:2], "--reference-radius", "0"]):
            with self.subTest(words):
                self.rholm("convert", *words, code=2)

    def test_radii_in_such_a_file_are_a_body_once_it_says_so(self):
        self.write("g.gfc", GRAVITY.replace("gravity_field", "shape"))
        self.rholm("synthesize", "g.gfc", "-o", "o.ply")


class Precision(Meaning):
    def test_a_model_is_judged_by_the_precision_it_was_made_with(self):
        self.rholm("make", "ellipsoid", "--axes", "1.3,1.1,1", "--subdivisions", "2", "-o", "e.ply")
        for name, precision in (("coarse.h5", "1e-3"), ("fine.h5", "1e-8")):
            self.rholm("expand", "e.ply", "--degree", "6", "--no-errors", "--precision", precision,
                       "-o", name)
        fine = self.rholm("info", "fine.h5", "--json").json()
        self.assertEqual(fine["precision"], 1e-8)
        self.assertGreater(fine["truncation_rms"], 0)
        tolerance = 2 * fine["truncation_rms"]
        within = ("spectrum", "fine.h5", "--tolerance", tolerance)
        self.assertRegex(self.rholm(*within).out, r"# within \S+ from degree \d")
        for name in ("coarse.h5", "c.sh", "c.gfc", "c.json"):
            if name != "coarse.h5":
                self.rholm("convert", "coarse.h5", name)
            with self.subTest(name):
                report = self.rholm("info", name, "--json").json()
                self.assertEqual((report["precision"], report["truncation_rms"]), (1e-3, None))
                said = self.rholm("spectrum", name, "--tolerance", tolerance).out
                self.assertIn("not known: at most", said)
                self.assertIn("a precision of 0.001", said)
                self.assertNotIn("does not state", said)
                self.assertRegex(said, r"# whether any degree is within \S+ is not known")
                self.rholm("report", name, "-o", "r.html", "--size", "16")
                self.assertRegex((self.folder / "r.html").read_text(), r"rms error.*?&lt;&nbsp;")

    def test_where_it_is_not_known_that_is_said(self):
        self.rholm("make", "sphere", "--subdivisions", "4", "-o", "s.ply")
        self.rholm("expand", "s.ply", "--degree", "200", "--no-errors", "-o", "s.json")
        text = (self.folder / "s.json").read_text()
        self.write("old.json", text.replace('"precision"', '"another"'))
        report = self.rholm("info", "old.json", "--json").json()
        self.assertIsNone(report["precision"])
        self.assertRegex(self.rholm("info", "old.json").out, r"(?m)^  precision +not said")
        # The norm beyond the coefficients is made smaller than their precision can determine.
        norm = sum(self.rholm("spectrum", "old.json", "--json").json()["energy"])
        self.write("old.json", re.sub(r'"norm_squared":[^,]+', f'"norm_squared":{norm * (1 + 1e-9)!r}',
                                      (self.folder / "old.json").read_text()))
        self.assertIn("which the file does not say", self.rholm("spectrum", "old.json").out)
        self.assertIn("if the precision is 1e-08", self.rholm("info", "old.json").out)


class Units(Meaning):
    def test_models_in_km_and_m_of_one_body_lie_on_each_other(self):
        self.model("m.h5", "m")
        self.rholm("make", "ellipsoid", "--axes", "0.0012,0.0011,0.001", "--subdivisions", "4",
                   "-o", "s.ply")
        self.model("km.h5", "kilometres")
        for words in (["compare", "m.h5", "km.h5"], ["compare", "km.h5", "m.h5"]):
            result = self.rholm(*words, "--samples", "1000", "--json")
            self.assertRegex(result.err, r"m.h5 is in \w+ and k?m.h5 is in \w+")
            report = result.json()
            # The vertices are the same except for the rounding of text and of floats.
            self.assertLess(report["relative"]["hausdorff"], 1e-5)
        report = self.rholm("align", "km.h5", "m.h5", "--json", "-o", "o.h5").json()
        self.assertLess(report["distance"], 1e-5)
        self.assertEqual(self.rholm("info", "o.h5", "--json").json()["unit"], "m")

    def test_units_that_cannot_be_converted_are_refused(self):
        self.model("a.h5", "m")
        self.model("b.h5", "voxels")
        for words in (["compare", "a.h5", "b.h5"], ["align", "a.h5", "b.h5"],
                      ["render", "a.h5", "b.h5", "-o", "o.png"]):
            said = self.rholm(*words, code=3).err
            self.assertIn("voxels", said)
            self.assertIn("--length-unit", said)

    def test_a_model_without_a_unit_is_said(self):
        self.model("a.h5", "m")
        for words in (["compare", "a.h5", "s.h5", "--samples", "100"], ["align", "s.h5", "a.h5"]):
            self.assertIn("s.h5 does not state its unit of length, and a.h5 states m", self.rholm(*words).err)
        # Files of meshes cannot store a unit.
        self.assertEqual(self.rholm("compare", "a.h5", "s.ply", "--samples", "100").err, "")

    def test_pictures_at_one_scale_are_in_one_unit(self):
        self.model("m.h5", "m")
        self.model("km.h5", "km")
        said = self.rholm("render", "m.h5", "km.h5", "--size", "64x32", "-o", "o.png").err
        self.assertIn("km.h5 is in km and m.h5 is in m; the lengths of the first are multiplied by 1000", said)


class Lost(Meaning):
    def test_an_array_of_numbers_says_what_it_loses(self):
        self.rholm("expand", "s.ply", "--degree", "2", "--method", "gauge", "--center", "0.1,0,0.2",
                   "--length-unit", "km", "--quiet", "-o", "g.h5")
        words = ["normalization schmidt", "csphase -1", "function gauge", "(0.1, 0, 0.2)",
                 "unit km"]
        convention = ["--normalization", "schmidt", "--csphase", "-1"]
        for command in (["convert", "g.h5", "g.npy"],
                        ["filter", "g.h5", "--low-pass", "1", "-o", "f.npy"],
                        ["rotate", "g.h5", "--mirror", "x", "--about", "center", "-o", "r.npy"]):
            said = self.rholm(*command, *convention).err
            for word in words:
                self.assertIn(word, said)

    def test_text_says_that_errors_are_lost(self):
        self.model("a.h5", "m")
        self.assertIn("errors", self.rholm("convert", "a.h5", "a.sh").err)
        self.assertEqual(self.rholm("convert", "s.h5", "s.sh").err, "")


    def test_shapes_say_which_attributes_are_lost(self):
        self.write("c.off", "CNOFF\n3 1 0\n" + "".join(
            f"{x} {y} 0 0 0 1 9 8 7 255\n" for x, y in ((0, 0), (1, 0), (0, 1))) + "3 0 1 2\n")
        self.assertEqual(self.rholm("convert", "c.off", "c.ply").err, "")
        said = self.rholm("convert", "c.ply", "c.stl").err
        for name in ("stl", "red", "nx"):
            self.assertIn(name, said)
        said = self.rholm("convert", "c.ply", "c.obj").err
        self.assertIn("alpha", said)
        self.assertNotIn("red", said)


class Quiet(Meaning):
    def test_commands_that_write_a_file_say_nothing(self):
        self.rholm("make", "sample", "s.ply", "--points", "2000", "-o", "p.ply")
        self.model("a.h5", "m")
        for words in (["reconstruct", "p.ply", "-o", "o.ply"], ["orient", "p.ply", "-o", "o.ply"],
                      ["smooth", "s.ply", "--region", "ball:0,0,1,0.5", "--wavelength", "0.5", "-o",
                       "o.ply"],
                      ["transfer", "--from", "s.ply", "--from-region", "ball:0,0,1,0.5", "--to",
                       "s.ply", "--to-region", "ball:1,0,0,0.5", "-o", "o.ply"],
                      ["align", "s.h5", "a.h5", "-o", "o.h5"], ["synthesize", "s.h5", "-o", "o.ply"],
                      ["convert", "a.h5", "o.npy"], ["rotate", "s.h5", "--mirror", "x", "-o", "o.h5"],
                      ["filter", "s.h5", "--low-pass", "2", "-o", "o.h5"],
                      ["expand", "s.ply", "--degree", "2", "-o", "o.h5"],
                      ["report", "s.h5", "--size", "16", "-o", "o.html"],
                      ["render", "s.h5", "--size", "32x32", "-o", "o.png"]):
            with self.subTest(words[0]):
                result = self.rholm(*words, "--quiet")
                self.assertEqual(result.out + result.err, "")

    def test_a_report_that_is_asked_for_stays(self):
        for words in (["info", "s.ply"], ["center", "s.ply"], ["spectrum", "s.h5"],
                      ["compare", "s.ply", "s.h5", "--samples", "100"], ["align", "s.h5", "s.h5"],
                      ["smooth", "s.ply", "--region", "ball:0,0,1,0.5", "--wavelength", "0.5",
                       "--json", "-o", "o.ply"]):
            with self.subTest(words[0]):
                result = self.rholm(*words, "--quiet")
                self.assertEqual(result.err, "")
                self.assertNotEqual(result.out, "")


class Words(Meaning):
    def test_both_a_degree_and_a_tolerance(self):
        said = self.rholm("expand", "s.ply", "--degree", "4", "--tolerance", "1", "-o", "o.h5",
                          code=2).err
        self.assertIn("only one of the two", said)

    def test_points_are_no_output_of_a_surface(self):
        for words in (["synthesize", "s.h5", "-o", "o.xyz"],
                      ["smooth", "s.ply", "--region", "ball:0,0,1,1", "--wavelength", "1", "-o",
                       "o.xyz"], ["make", "sphere", "-o", "o.xyz"]):
            self.assertIn("no faces", self.rholm(*words, code=2).err)
        self.assertNotIn("xyz", self.rholm("synthesize", "--help", "all").out)
        for words in (["make", "sample", "s.ply"], ["orient", "s.ply"]):
            self.assertIn("no points", self.rholm(*words, "-o", "o.stl", code=2).err)

    def test_convert_points_to_the_command_that_does_it(self):
        said = self.rholm("convert", "s.h5", "o.ply", code=2).err
        self.assertIn("'rholm synthesize s.h5 -o o.ply'", said)
        said = self.rholm("convert", "s.ply", "o.h5", code=2).err
        self.assertIn("'rholm expand s.ply --degree L -o o.h5'", said)

    def test_transfer_speaks_of_its_own_options(self):
        self.rholm("make", "sphere", "--subdivisions", "2", "-o", "coarse.ply")
        words = ["transfer", "--from", "coarse.ply", "--from-region", "ball:0,0,1,0.7", "--to",
                 "s.ply", "--to-region", "ball:0,0,1,0.5", "-o", "o.ply"]
        said = self.rholm(*words, "--from-degree", "20", code=3).err
        self.assertNotIn("wavelength", said)
        most = int(re.search(r"degree (\d+) or less", said)[1])
        self.assertGreaterEqual(most, 2)
        self.assertNotIn("or less", self.run_rholm(*words, "--from-degree", most).err)

    def test_a_sample_without_points_is_refused(self):
        said = self.rholm("make", "sample", "s.ply", "--holes", "100,1", "-o", "o.ply", code=3).err
        self.assertIn("holes", said)
        self.assertNotIn("o.ply", self.files())

    def test_what_is_not_star_shaped_is_told_in_the_words_of_the_command(self):
        self.rholm("make", "torus", "-o", "t.ply")
        said = self.rholm("expand", "t.ply", "--degree", "4", "-o", "o.h5", code=3).err
        for word in ("min d", "rholm compress"):
            self.assertIn(word, said)
        for word in ("--signed", "allow_signed", "compress(", "d_T", "min_d"):
            self.assertNotIn(word, said)
        said = self.rholm("report", "t.ply", "-o", "o.html", code=3).err
        self.assertIn("rholm compress", said)
        self.assertNotIn("--signed", said)

    def test_text_has_the_centroid_that_json_has(self):
        centroid = self.rholm("info", "s.ply", "--json").json()["volume_centroid"]
        self.assertEqual(len(centroid), 3)
        self.assertIn("volume centroid", self.rholm("info", "s.ply").out)

    def test_a_view_from_above_needs_no_up(self):
        for view in ("0,0,1", "0,0,-3"):
            self.rholm("render", "s.ply", "--view", view, "--size", "32x32", "-o", "o.png")
        said = self.rholm("render", "s.ply", "--view", "0,0,1", "--up", "0,0,2", "-o", "o.png",
                          code=2).err
        self.assertIn("--up", said)


class Names(Meaning):
    def test_names_that_cannot_be_are_failures(self):
        long = "x" * 300
        os.symlink("b.ply", self.folder / "a.ply")
        os.symlink("a.ply", self.folder / "b.ply")
        before = self.files()
        for name, words in ((long, "too long"), ("a.ply", "symbolic links")):
            for command in (["info", name], ["expand", name, "--degree", "2", "-o", "o.h5"],
                            ["compare", "s.ply", name],
                            ["synthesize", "s.h5", "--like", name, "-o", "o.ply"],
                            ["filter", "s.h5", "--gain", name, "-o", "o.h5"],
                            ["make", "sphere", "--format", "ply", "-o", name],
                            ["expand", "s.ply", "--degree", "2", "--format", "h5", "-o", name],
                            ["report", "s.ply", "--format", "html", "-o", name],
                            ["render", "s.ply", "--format", "png", "-o", name],
                            ["convert", "s.h5", name, "--format", "json"]):
                with self.subTest(command=command):
                    said = self.rholm(*command, code=1).err
                    self.assertIn(words, said)
                    self.assertNotIn("unexpected", said)
        self.assertEqual(self.files(), before)

    def test_a_level_whose_name_would_be_too_long_is_refused_before_the_work(self):
        name = "x" * 249 + ".ply"  # 253 bytes; with -L1 it exceeds the 255 of file systems
        said = self.rholm("synthesize", "s.h5", "--degree", "1,2", "-o", name, code=1).err
        self.assertIn("too long", said)
        self.assertIn("-L1.ply", said)


if __name__ == "__main__":
    main()
