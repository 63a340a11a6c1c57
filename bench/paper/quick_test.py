"""Runs the paper's experiments quickly: the document and pictures are made, and the figures are
plausible."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["PAPER_EXPERIMENTS"]
IMAGES = {"paper-figure-1.png", "paper-figure-4.png", "paper-figure-5.png",
          "paper-convergence.svg"}


def errors(series):
    return [point["error"] for point in series]


class QuickTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="rholm-paper-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        run = subprocess.run([SOURCE / "bench" / "paper" / "run", "--quick", "--program", PROGRAM,
                              "--output", cls.folder], capture_output=True, check=False)
        assert run.returncode == 0, run.stderr.decode()
        cls.results = json.loads((cls.folder / "results.json").read_text(encoding="utf-8"))

    def test_document_has_every_table_and_picture(self):
        text = (self.folder / "paper.md").read_text(encoding="utf-8")
        for name in re.findall(r"<!-- (\S+): begin -->", text):
            part = text.split(f"<!-- {name}: begin -->\n")[1].split(f"<!-- {name}: end -->")[0]
            self.assertTrue(part.strip(), name)
        self.assertNotIn("nan", text.lower().split())
        self.assertEqual(set(re.findall(r"\(images/(paper-[^)]+)\)", text)), IMAGES)
        for image in IMAGES:
            self.assertGreater((self.folder / "images" / image).stat().st_size, 4000, image)

    def test_times_and_errors_of_table_one(self):
        rows = self.results["table_one"]
        self.assertEqual([row["name"] for row in rows],
                         ["Igea", "Max-Planck", "Dinosaur", "Tyra", "Buddha", "Thai", "Vase"])
        for row in rows:
            self.assertAlmostEqual(row["faces"] / (2 * row["points"] / 50), 1, delta=0.1)
            # Errors here are relative to the mean radius. The requested precision is relative to the norm
            # without the mean, which is smaller on these bodies.
            self.assertLess(row["coarse"]["error"], 1e-3)
            self.assertLess(row["fine"]["error"], 1e-6)
            # There is one seed, but thousands of coefficients: its error is near the mean over all seeds.
            triangles = row["triangles"]
            self.assertAlmostEqual(triangles["measured_error"] / triangles["expected_error"], 1,
                                   delta=0.1)
            for value in (row["coarse"]["cpu_seconds"], row["fine"]["cpu_seconds"],
                          triangles["cpu_seconds"], row["edge_cpu_per_point"]):
                self.assertGreater(value, 0)
            # Compares errors at vertices, where they are largest on these coarse meshes, with errors in all
            # directions.
            self.assertLess(row["vertex_error"], 3 * row["truncation_rms"])
            self.assertGreater(row["vertex_error"], row["truncation_rms"] / 3)

    def test_random_points_converge_with_the_root_of_their_number(self):
        for shape in self.results["figure_four"]["shapes"]:
            for key in ("random_edges", "random_triangles"):
                first, last = shape[key][0], shape[key][-1]
                expected = (first["samples"] / last["samples"]) ** 0.5
                # Errors are of one seed, over a factor of at least 4 in samples.
                self.assertAlmostEqual(last["error"] / first["error"] / expected, 1, delta=0.4)

    def test_nodes_on_edges_converge_fast(self):
        for shape in self.results["figure_four"]["shapes"]:
            self.assertLess(errors(shape["nodes_edges"])[-1], 1e-8, shape["name"])

    def test_levels_of_detail_come_nearer_to_the_shape(self):
        for figure in ("one", "five"):
            levels = self.results["levels"][figure]["levels"]
            for measure in ("rms", "max"):
                found = [level[measure] for level in levels]
                self.assertEqual(found, sorted(found, reverse=True))
            self.assertLess(levels[0]["rms"], 0.05)


if __name__ == "__main__":
    unittest.main()
