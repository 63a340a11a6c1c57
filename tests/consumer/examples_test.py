"""Runs the programs of examples/, built against the installed package, on shapes whose answers are
known.

Environment: EXAMPLES, the folder of the programs; RHOLM, the program that makes the shapes.
"""

import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import times

SOURCE = Path(__file__).resolve().parents[2] / "examples"
PROGRAMS = Path(os.environ["EXAMPLES"])
RHOLM = os.environ["RHOLM"]


class Examples(unittest.TestCase):
    """Each test has an empty folder in which the programs run."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="rholm-examples-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def call(self, program, *words):
        return subprocess.run([program, *map(str, words)], cwd=self.folder, capture_output=True,
                              text=True, timeout=1200)

    def make(self, *words):
        done = self.call(RHOLM, "make", *words)
        self.assertEqual(done.returncode, 0, done.stderr)

    def output(self, example, *words):
        done = self.call(PROGRAMS / example, *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), f"{example} {words}")
        return done.stdout

    def numbers(self, text, name):
        """Returns the numbers of the line that begins with that name."""
        line = re.search(rf"^ *{re.escape(name)}((?: +[-+.\de]+)+)", text, re.MULTILINE)
        self.assertIsNotNone(line, f"no '{name}' in\n{text}")
        return [float(number) for number in line[1].split()]

    def number(self, text, name):
        return self.numbers(text, name)[0]

    def move(self, source, target, change):
        """Rewrites a text mesh in OFF with change(vertex) for every vertex."""
        lines = (self.folder / source).read_text().split("\n")
        begin = 1 if lines[0] == "OFF" else 0
        n = int(lines[begin].split()[0])
        for i in range(begin + 1, begin + 1 + n):
            moved = change([float(x) for x in lines[i].split()[:3]])
            lines[i] = " ".join(map(repr, moved))
        (self.folder / target).write_text("\n".join(lines))

    def vertices(self, name):
        lines = (self.folder / name).read_text().split("\n")
        n = int(lines[1].split()[0])
        return [[float(x) for x in line.split()[:3]] for line in lines[2:2 + n]]

    def test_mesh_to_coefficients_and_back(self):
        self.make("ellipsoid", "--axes", "3,2,1", "--translate", "5,0,-1", "-o", "shape.ply")
        out = self.output("mesh_to_coefficients", "shape.ply", 48, "model.h5", "back.off")
        # Flat faces lie inside the ellipsoid. With 10 242 vertices they lose 0.1 % of the volume; the part
        # above degree 48 is as small.
        self.assertAlmostEqual(self.number(out, "volume"), 8 * math.pi, delta=0.003 * 8 * math.pi)
        for found, known in zip(self.numbers(out, "centre"), (5, 0, -1)):
            self.assertAlmostEqual(found, known, delta=1e-3)
        for x, y, z in self.vertices("back.off"):
            self.assertAlmostEqual(((x - 5) / 3) ** 2 + (y / 2) ** 2 + (z + 1) ** 2, 1, delta=0.02)

    def test_tolerance(self):
        self.make("ellipsoid", "--axes", "1,1,1.5", "--subdivisions", 6, "-o", "shape.ply")
        energy, norm = spheroid_spectrum(1, 1.5, 24)
        for percent in (5, 1, 0.2):
            out = self.output("tolerance", "shape.ply", percent)
            mean = math.sqrt(energy[0] / (4 * math.pi))
            beyond = [math.sqrt(max(0, norm - sum(energy[:l + 1])) / (4 * math.pi)) / mean
                      for l in range(25)]
            known = next(l for l in range(25) if beyond[l] <= percent / 100)
            # The mesh is only near to an ellipsoid. The margin shows that the answer does not depend on the
            # difference.
            self.assertGreater(min(abs(math.log(100 * b / percent)) for b in beyond if b > 0), 0.01)
            self.assertEqual(self.number(out, "degree"), known)
            self.assertAlmostEqual(self.number(out, "reached"), beyond[known] * mean,
                                   delta=0.02 * beyond[known] * mean)
            self.assertIn("kept yes", out)

    def test_points_to_surface(self):
        self.make("torus", "--radii", "1,0.4", "-o", "torus.ply")
        self.make("sample", "torus.ply", "--points", 6000, "--no-normals", "-o", "points.xyz")
        out = self.output("points_to_surface", "points.xyz", "surface.ply")
        self.assertIn("closed yes", out)
        self.assertEqual(self.number(out, "genus"), 1)
        volume = 2 * math.pi ** 2 * 0.4 ** 2
        self.assertAlmostEqual(self.number(out, "volume"), volume, delta=0.02 * volume)

    def test_smooth_region(self):
        self.make("sphere", "-o", "sphere.off")

        def spike(x):  # bumps of height 0.1 at both poles
            return [1.1 * c for c in x] if abs(x[2]) > 0.9999 else x
        self.move("sphere.off", "spiked.off", spike)
        spiked = self.vertices("spiked.off")
        poles = [i for i, x in enumerate(spiked) if math.hypot(*x) > 1.05]
        self.assertEqual(len(poles), 2)
        out = self.output("smooth_region", "spiked.off", "ball:0,0,1,0.5", 0.5, "smooth.off")
        self.assertAlmostEqual(self.number(out, "largest move"), 0.1, delta=0.001)
        smooth = self.vertices("smooth.off")
        for i, (before, after) in enumerate(zip(spiked, smooth)):
            if before[2] < 0:
                self.assertEqual(before, after, "the other half, and its spike, stay")
            else:
                self.assertAlmostEqual(math.hypot(*after), 1, delta=0.001)

    def test_align_two(self):
        self.make("bumpy", "-o", "a.off")
        angle, shift = math.radians(40), (0.3, -0.2, 0.1)
        axis = (1 / 3, 2 / 3, 2 / 3)

        def turn(x):  # Rodrigues' formula
            c, s = math.cos(angle), math.sin(angle)
            along = sum(a * b for a, b in zip(axis, x)) * (1 - c)
            across = [axis[1] * x[2] - axis[2] * x[1], axis[2] * x[0] - axis[0] * x[2],
                      axis[0] * x[1] - axis[1] * x[0]]
            return [c * x[i] + s * across[i] + along * axis[i] for i in range(3)]
        self.move("a.off", "b.off", lambda x: [u + v for u, v in zip(turn(x), shift)])
        out = self.output("align_two", "a.off", "b.off", "moved.off")
        self.assertAlmostEqual(self.number(out, "angle"), 40, delta=0.01)
        for found, known in zip(self.numbers(out, "axis"), axis):
            self.assertAlmostEqual(found, known, delta=1e-3)
        # The distance of the centroid, which is first turned about the origin.
        self.assertLess(self.number(out, "distance after"), 1e-3)
        self.assertGreater(self.number(out, "distance before"), 0.02)
        self.assertEqual(self.number(out, "others nearly as good"), 0)

    def test_spectrum_and_descriptors(self):
        self.make("sphere", "-o", "sphere.ply")
        self.make("ellipsoid", "--axes", "2,2,2", "-o", "large.ply")
        out = self.output("spectrum_and_descriptors", "sphere.ply", "large.ply", 4)
        # Radii 1 and 2: energies 4 pi and 16 pi, all of degree 0, and a distance of 1.
        self.assertAlmostEqual(self.numbers(out, "0")[0], 4 * math.pi, delta=0.02)
        self.assertAlmostEqual(self.numbers(out, "0")[1], 16 * math.pi, delta=0.08)
        self.assertLess(self.numbers(out, "2")[1], 1e-6)
        self.assertAlmostEqual(self.number(out, "distance"), 1, delta=1e-3)
        self.assertAlmostEqual(self.number(out, "distance of descriptors"), 1, delta=1e-3)

        self.make("bumpy", "-o", "a.off")
        self.move("a.off", "b.off", lambda x: [x[1], x[2], x[0]])  # a turn by 120 degrees
        out = self.output("spectrum_and_descriptors", "a.off", "b.off", 12)
        self.assertGreater(self.number(out, "distance"), 0.05)
        self.assertLess(self.number(out, "distance of descriptors"), 1e-6)

    def test_each_example_is_small_tested_and_says_what_is_wrong(self):
        for source in sorted(SOURCE.glob("*.cpp")):
            text = source.read_text()
            usage = re.search(r"^// Usage: (.*?)(   .*)?$", text, re.MULTILINE)[1]
            words = usage.split()
            self.assertEqual(words[0], source.stem)
            self.assertLessEqual(len(text.splitlines()), 60, source.name)
            self.assertIn(f'"{source.stem}"', Path(__file__).read_text())
            alone = self.call(PROGRAMS / source.stem)
            self.assertEqual((alone.returncode, alone.stderr), (2, f"usage: {usage}\n"))
            # Any value serves where a number is expected, because the files do not exist.
            values = [{"DEGREE": "4", "PERCENT": "1", "WAVELENGTH": "1",
                       "REGION": "ball:0,0,1,1"}.get(word, f"none-{i}.ply")
                      for i, word in enumerate(words[1:])]
            refused = self.call(PROGRAMS / source.stem, *values)
            self.assertEqual(refused.returncode, 1)
            self.assertRegex(refused.stderr, f"^{source.stem}: .*none-0.ply.*\n$")


def spheroid_spectrum(a, c, degree):
    """Returns energies of the radius of a spheroid (semi-axes a, a, c): up to the given degree, and of all
    degrees together, by Simpson's rule."""
    n = 4000
    energy, norm = [0.0] * (degree + 1), 0.0
    moments = [0.0] * (degree + 1)
    for i in range(n + 1):
        t = -1 + 2 * i / n
        weight = (1 if i in (0, n) else 4 if i % 2 else 2) * 2 / (3 * n)
        r = 1 / math.sqrt((1 - t * t) / a ** 2 + t * t / c ** 2)
        norm += 2 * math.pi * weight * r * r
        below, at = 0.0, 1.0  # P_{l-1}, P_l
        for l in range(degree + 1):
            moments[l] += weight * r * at
            below, at = at, ((2 * l + 1) * t * at - l * below) / (l + 1)
    for l in range(degree + 1):
        energy[l] = math.pi * (2 * l + 1) * moments[l] ** 2
    return energy, norm


if __name__ == "__main__":
    times.main()
