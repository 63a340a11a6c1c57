"""Edits of regions: the commands smooth and transfer."""

import math
import os
import struct
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, main


def vertices(path):
    """Returns the bytes of each vertex of a binary PLY file of a mesh without attributes."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode()
    size = struct.calcsize("3d" if "property double x" in header else "3f")
    n = int(header.split("element vertex ")[1].split()[0])
    return [data[end + i * size:end + (i + 1) * size] for i in range(n)]


class Smooth(CliTest):
    def setUp(self):
        super().setUp()
        self.rholm("make", "bumpy", "-o", "a.ply")
        self.region = ["--region", "ball:0,0,1,0.3", "--wavelength", "0.3"]

    def test_only_the_region_and_its_transition_change(self):
        report = self.rholm("smooth", "a.ply", *self.region, "-o", "b.ply", "--json").json()
        before, after = vertices(self.folder / "a.ply"), vertices(self.folder / "b.ply")
        changed = [i for i, (x, y) in enumerate(zip(before, after)) if x != y]
        self.assertEqual(len(before), len(after))
        self.assertTrue(0 < len(changed) <= report["vertices"] < len(before) / 2)
        form = "3d" if len(before[0]) == 24 else "3f"
        for i in changed:  # within ball and transition
            x, y, z = struct.unpack("<" + form, before[i])
            self.assertLess(x * x + y * y + (z - 1) ** 2, 0.6001 ** 2)

    def test_strength_zero_changes_nothing(self):
        self.rholm("smooth", "a.ply", *self.region, "--strength", "0", "-o", "b.ply")
        self.assertEqual((self.folder / "a.ply").read_bytes(),
                         (self.folder / "b.ply").read_bytes())

    def test_a_painted_scratch_is_bridged(self):
        # One vertex is moved out as a spike and painted red.
        self.rholm("make", "sphere", "--ascii", "-o", "s.ply")
        lines = (self.folder / "s.ply").read_text().splitlines()
        start = lines.index("end_header") + 1
        n = int(next(x for x in lines if x.startswith("element vertex")).split()[2])
        z = next(i for i, x in enumerate(lines) if x.startswith("property") and x.endswith(" z"))
        lines[z:z + 1] = [lines[z], *(f"property uchar {c}" for c in ("red", "green", "blue"))]
        start += 3
        for i in range(n):
            spike = i == 100
            xyz = [float(x) * (1.1 if spike else 1) for x in lines[start + i].split()]
            lines[start + i] = " ".join(map(repr, xyz)) + (" 255 0 0" if spike else " 9 9 9")
        self.write("spike.ply", "\n".join(lines) + "\n")
        self.rholm("make", "sphere", "-o", "s.ply")
        for words in (["--region", "color:ff0000", "--fitting", "around"],
                      ["--region", "vertex:100,0.3", "--repair"]):
            self.rholm("smooth", "spike.ply", *words, "--wavelength", "0.3", "-o", "mended.ply")
            compared = self.rholm("compare", "mended.ply", "s.ply", "--json").json()
            self.assertLess(compared["hausdorff"], 2e-3)  # facets lie 6e-4 inside the sphere

    def test_threads_do_not_change_a_byte(self):
        for threads in (1, 2):
            self.rholm("smooth", "a.ply", *self.region, "--threads", threads, "-o",
                       f"{threads}.ply")
        self.assertEqual((self.folder / "1.ply").read_bytes(), (self.folder / "2.ply").read_bytes())

    def test_what_is_wrong_is_said(self):
        for words, code, saying in (
                (["--region", "cone:1", "--wavelength", "1"], 2, "--region"),
                (["--wavelength", "1"], 2, "--region"),
                (["--region", "ball:0,0,1,1"], 2, "--wavelength"),
                (["--region", "ball:0,0,9,1", "--wavelength", "1"], 3, "nearest"),
                (["--region", "ball:0,0,1,1", "--wavelength", "1e-3"], 3, "wavelength"),
                (["--region", "property:w", "--wavelength", "1"], 3, "'w'"),
                ([*self.region, "--fitting", "mean", "--repair"], 2, "--repair"),
                ([*self.region, "--format", "xyz"], 2, "--format")):
            result = self.rholm("smooth", "a.ply", *words, "-o", "b.ply", code=code)
            self.assertIn(saying, result.err)
            self.assertFalse((self.folder / "b.ply").exists())


class Transfer(CliTest):
    def setUp(self):
        super().setUp()
        self.rholm("make", "bumpy", "-o", "a.ply")
        self.rholm("make", "sphere", "-o", "s.ply")
        self.words = ["--from", "a.ply", "--from-region", "ball:1,0,0,0.5", "--to", "s.ply",
                      "--to-region", "ball:0,0,1,0.5"]

    def test_only_the_region_and_its_transition_change(self):
        report = self.rholm("transfer", *self.words, "-o", "b.ply", "--json").json()
        before, after = vertices(self.folder / "s.ply"), vertices(self.folder / "b.ply")
        changed = [i for i, (x, y) in enumerate(zip(before, after)) if x != y]
        self.assertEqual(len(before), len(after))
        self.assertTrue(0 < len(changed) <= report["vertices"] < len(before) / 4)
        self.assertEqual(report["angle"], report["best_angle"])
        form = "3d" if len(before[0]) == 24 else "3f"
        for i in changed:  # within ball and transition
            self.assertLess(math.dist(struct.unpack("<" + form, before[i]), (0, 0, 1)),
                            0.5001 + report["target_wavelength"])

    def test_height_zero_changes_nothing(self):
        self.rholm("transfer", *self.words, "--height", "0", "--rotate", "-20", "-o", "b.ply")
        self.assertEqual((self.folder / "s.ply").read_bytes(),
                         (self.folder / "b.ply").read_bytes())

    def test_a_patch_laid_on_itself_is_not_turned(self):
        report = self.rholm("transfer", "--from", "a.ply", "--from-region", "ball:1,0,0,0.5",
                            "--to", "a.ply", "--to-region", "ball:1,0,0,0.5", "--remove-own",
                            "-o", "b.ply", "--json").json()
        self.assertLess(abs(report["angle"]), 1)
        self.assertGreater(report["correlation"], 0.99)
        self.assertAlmostEqual(report["scale"], 1, delta=1e-3)

    def test_repeated_and_refined_it_is_closed(self):
        report = self.rholm("transfer", *self.words, "--scale", "0.5", "--repeat", "--refine",
                            "-o", "b.ply", "--json").json()
        info = self.rholm("info", "b.ply", "--json").json()
        self.assertGreater(report["new_vertices"], 0)
        self.assertLessEqual(report["target_edge"], report["source_edge"] * report["scale"])
        self.assertEqual(info["counts"]["vertices"],
                         len(vertices(self.folder / "s.ply")) + report["new_vertices"])
        self.assertTrue(info["closed"] and info["manifold"])

    def test_a_coarse_target_is_said(self):
        words = [*self.words, "--scale", "0.3", "-o", "b.ply"]
        self.assertIn("--refine", self.rholm("transfer", *words).err)
        self.assertEqual(self.rholm("transfer", *words, "--quiet").err, "")
        self.assertEqual(self.rholm("transfer", *words, "--refine").err, "")

    def test_models_are_edited_as_their_surfaces(self):
        self.rholm("make", "bumpy", "--subdivisions", "3", "-o", "b.ply")
        self.rholm("analyze", "b.ply", "--degree", "12", "-o", "b.h5", "--quiet")
        self.rholm("synthesize", "b.h5", "--subdivisions", "5", "-o", "own.ply")
        words = ("--region", "ball:0,0,1,0.4", "--wavelength", "0.5")
        self.rholm("smooth", "b.h5", *words, "-o", "model.ply")
        self.rholm("smooth", "own.ply", *words, "-o", "mesh.ply")
        found = self.rholm("compare", "model.ply", "mesh.ply", "--json").json()
        self.assertLess(found["hausdorff"], 1e-12)

    def test_raw_coefficients_differ(self):
        for mode in ("displacement", "coefficients"):
            self.rholm("transfer", *self.words, "--mode", mode, "-o", f"{mode}.ply")
        self.assertNotEqual((self.folder / "displacement.ply").read_bytes(),
                            (self.folder / "coefficients.ply").read_bytes())

    def test_threads_do_not_change_a_byte(self):
        for threads in (1, 2):
            self.rholm("transfer", *self.words, "--refine", "--threads", threads, "-o",
                       f"{threads}.ply")
        self.assertEqual((self.folder / "1.ply").read_bytes(), (self.folder / "2.ply").read_bytes())

    def test_what_is_wrong_is_said(self):
        for words, code, saying in (
                (["--rotate", "left"], 2, "--rotate"),
                (["--from-degree", "1"], 2, "--from-degree"),
                (["--from-degree", "64"], 3, "degree 25 or less"),
                (["--mode", "coefficients", "--repeat"], 2, "--repeat"),
                (["--mode", "coefficients", "--from-degree", "24"], 3, "24"),
                (["--to-region", "cone:1"], 2, "--to-region"),
                (["--to-region", "ball:0,0,0,2"], 3, "hidden"),
                (["--from-region", "ball:9,0,0,1"], 3, "nearest")):
            if words[0].endswith("-region"):
                given = dict(zip(self.words[::2], self.words[1::2]))
                given[words[0]] = words[1]
                words = [x for pair in given.items() for x in pair]
            else:
                words = [*self.words, *words]
            result = self.rholm("transfer", *words, "-o", "b.ply", code=code)
            self.assertIn(saying, result.err)
            self.assertFalse((self.folder / "b.ply").exists())


if __name__ == "__main__":
    main()
