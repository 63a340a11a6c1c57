"""A hundred million triangles in less than 8 GiB. Needs 2.5 GB of disk and some minutes."""

import os
import unittest

import harness
from harness import CliTest, main

GIB = 1 << 30


class Large(CliTest):
    def numbers(self, name):
        """Returns all C and S of an SHTOOLS text, except for degree 0."""
        rows = [line.split() for line in (self.folder / name).read_text().splitlines()
                if line[:1] != "#"]
        return [float(x) for row in rows if row[0] != "0" for x in row[2:4]]

    # A box is the same body however its faces are cut. The coefficients of the box with twelve triangles are
    # the oracle, term by term.
    def test_a_hundred_million_triangles_have_the_coefficients_of_twelve(self):
        harness.TIMEOUT = 1800
        place = ["--size", "2,1.6,1.2", "--translate", "0.1,-0.05,0.08"]
        self.rholm("make", "box", "--cells", "2887", *place, "-o", "large.ply")
        self.assertGreater(os.path.getsize(self.folder / "large.ply"), 2.4e9)
        common = ["--degree", "48", "--center", "none", "--json", "-o"]
        report = self.rholm("analyze", "large.ply", "--precision", "1e-6", *common,
                            "large.sh").json()
        self.assertEqual(report["counts"]["faces"], 12 * 2887**2)
        self.assertLess(report["peak_memory_bytes"], 8 * GIB)
        self.rholm("make", "box", *place, "-o", "small.ply")
        self.rholm("analyze", "small.ply", "--precision", "1e-10", "--engine", "direct", *common,
                   "small.sh")
        large, small = self.numbers("large.sh"), self.numbers("small.sh")
        self.assertEqual(len(large), len(small))
        error = sum((a - b)**2 for a, b in zip(large, small))**0.5
        norm = sum(b**2 for b in small)**0.5
        self.assertLess(error, 1e-6 * norm)


if __name__ == "__main__":
    main()
