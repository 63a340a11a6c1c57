"""A row that is added to a table of the library appears in everything that the program shows; so does an
option.

The program of these tests is the program of users with one made-up row in each table (*.inc beside this
file), and a made-up option of reconstruct (CMakeLists.txt).
"""

import csv
import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
# This program has its own main(), which does not read the variable of the instruction set.
os.environ.pop("RHOLM_TEST_TARGET", None)
from harness import STUDIO, CliTest
from studio_program import Studio


class OneList(CliTest):
    def setUp(self):
        super().setUp()
        self.rholm("make", "bumpy", "--subdivisions", 3, "-o", "rock.ply")
        self.rholm("expand", "rock.ply", "--degree", 8, "-o", "rock.h5")

    def words(self, *words):
        """Returns the output of a command without line breaks."""
        return " ".join(self.rholm(*words).out.split())

    def test_window_is_in_all_that_the_program_says_of_itself(self):
        text = self.words("filter", "--help", "all")
        self.assertIn("plateau, wedge", text)
        self.assertIn("wedge none", text)  # overshoot of the window
        self.assertIn("of the exponential and wedge windows", text)  # parameter of the window
        for shell in ("bash", "zsh", "fish"):
            self.assertIn("wedge", self.rholm("completion", shell).out)
        self.assertIn("wedge", self.rholm("man-page").out)
        self.assertIn("| `wedge` | `(1 - l/(L+1))^p` | none |", self.run_rholm("reference").out)
        refused = self.rholm("filter", "rock.h5", "--low-pass", 4, "--window", "wdge", "-o", "x.h5", code=2)
        self.assertIn("wedge", refused.err)

    def test_window_filters(self):
        self.rholm("filter", "rock.h5", "--low-pass", 4, "--window", "wedge", "--order", 1, "-o", "low.h5")
        before, after = (self.rholm("spectrum", f"{name}.h5", "--json").json()["energy"] for name in ("rock", "low"))
        for l in range(5):
            self.assertAlmostEqual(after[l], before[l] * (1 - l / 5) ** 2, delta=1e-12 * before[0])

    @unittest.skipUnless(STUDIO, "built without the studio")
    def test_window_is_in_the_studio(self):
        studio = Studio(self)
        studio.begin()
        answer = studio.json("GET", "api/windows")
        self.assertEqual(answer["default"], "lanczos")
        wedge = answer["windows"][-1]
        self.assertEqual((wedge["name"], wedge["formula"], wedge["overshoot"]), ("wedge", "(1 - l/(L+1))^p", 0))
        self.assertEqual([(one["name"], one["default"], one["whole"]) for one in wedge["parameters"]], [("order", 4, True)])
        gains = studio.json("GET", "api/gains?window=wedge&cutoff=3&degree=5&order=1")["gains"]
        self.assertEqual(gains, [1, 0.75, 0.5, 0.25, 0, 0])

    def test_option_is_in_all_that_the_program_says_of_itself(self):
        text = self.words("reconstruct", "--help", "all")
        self.assertIn("--made-up X", text)
        self.assertIn("a made-up option, for tests; 0.5 by default", text)
        for shell in ("bash", "zsh", "fish"):
            self.assertIn("made-up", self.rholm("completion", shell).out)
        self.assertIn("made", self.rholm("man-page").out)
        self.assertIn("| `made_up` | `--made-up` | 0.5 | 0 ... 1 | a made-up option, for tests |",
                      self.run_rholm("reference").out)

    def test_option_is_parsed_and_checked(self):
        self.rholm("make", "sample", "rock.ply", "--points", 2000, "-o", "points.ply")
        self.rholm("reconstruct", "points.ply", "--made-up", 0.25, "-o", "surface.ply")
        refused = self.rholm("reconstruct", "points.ply", "--made-up", 1.5, "-o", "x.ply", code=2)
        self.assertIn("--made-up", refused.err)
        refused = self.rholm("reconstruct", "points.ply", "--made-upp", 1, "-o", "x.ply", code=2)
        self.assertIn("--made-up", refused.err)

    @unittest.skipUnless(STUDIO, "built without the studio")
    def test_option_is_in_the_studio(self):
        studio = Studio(self)
        studio.begin()
        control = next(one for one in studio.json("GET", "api/controls")["reconstruct"] if one["name"] == "made_up")
        self.assertEqual((control["label"], control["kind"], control["default"], control["least"], control["most"]),
                         ("Made up", "number", 0.5, 0, 1))
        self.assertFalse(control["shown"])  # listed under "More options" of the page
        studio.step(op="make", shape="points")
        state = studio.step(op="reconstruct", item=1, made_up=0.25)
        self.assertIn(" --made-up 0.25 ", state["recipe"]["shell"])
        self.assertIn(", made_up=0.25)", state["recipe"]["python"])

    def test_descriptor_is_in_reports_and_tables(self):
        report = self.rholm("info", "rock.h5", "--json").json()
        self.assertEqual(report["thickness"], report["volume"] / report["area"])
        self.assertRegex(self.rholm("info", "rock.h5").out, r"\n  thickness +[0-9.]+\n")
        self.assertIn("volume, area, sphericity and thickness", self.words("info", "--help", "all"))
        self.assertIn("volume, area, sphericity and thickness", self.words("batch", "--help", "all"))
        self.assertIn("| `thickness` | length | the volume over the area | Nobody 1900 |",
                      self.run_rholm("reference").out)
        (self.folder / "list.csv").write_text("path\nrock.ply\n")
        self.rholm("batch", "list.csv", "-o", "table.csv", "--", "--degree", 8)
        with open(self.folder / "table.csv", newline="") as file:
            row = next(csv.DictReader(file))
        self.assertEqual(float(row["thickness"]), report["thickness"])
        self.rholm("report", "rock.h5", "-o", "page.html")
        self.assertIn("thickness", (self.folder / "page.html").read_text())


if __name__ == "__main__":
    unittest.main(verbosity=2)
