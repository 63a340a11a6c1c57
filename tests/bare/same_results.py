#!/usr/bin/env python3
"""A program without the optional libraries gives the same results as a program with them.

    tests/bare/same_results.py PROGRAM BARE

Needs h5py and NumPy (scripts/python-env scripts/requirements-python.txt).
"""

import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import h5py
import numpy as np

PROGRAM, BARE = (str(Path(name).resolve()) for name in sys.argv[1:3])
LIBRARIES = ("tbb", "embree", "png", "hdf5", "qhull")
UNSUPPORTED = 3  # exit code of a refusal for a missing library


def contents(path):
    """Returns kind, type, shape, values and attributes of each object in an HDF5 file, by name."""
    found = {}

    def value(array, dtype, shape):
        return str(dtype), shape, array.tobytes() if dtype.kind != "O" else array.tolist()

    def add(name, item):
        attributes = {
            key: value(np.asarray(item.attrs[key]), item.attrs.get_id(key).dtype, item.attrs.get_id(key).shape)
            for key in item.attrs
        }
        is_dataset = isinstance(item, h5py.Dataset)
        found[name] = attributes, value(item[()], item.dtype, item.shape) if is_dataset else None
        if is_dataset:
            assert item.chunks is None and item.compression is None, f"{name} is not stored contiguous"

    with h5py.File(path, "r") as file:
        add("/", file)
        file.visititems(add)
    return found


def pixels(path):
    """Reads a PNG picture of 8 bits RGB into an array, with zlib alone."""
    data, at, stream = path.read_bytes(), 8, b""
    while at < len(data):
        size, name = int.from_bytes(data[at : at + 4]), data[at + 4 : at + 8]
        chunk = data[at + 8 : at + 8 + size]
        assert zlib.crc32(name + chunk) == int.from_bytes(data[at + 8 + size : at + 12 + size])
        if name == b"IHDR":
            width, height = int.from_bytes(chunk[:4]), int.from_bytes(chunk[4:8])
        stream += chunk if name == b"IDAT" else b""
        at += size + 12
    rows = np.frombuffer(zlib.decompress(stream), np.uint8).reshape(height, 3 * width + 1)
    image = np.zeros((height, width, 3), np.uint8)
    for y, row in enumerate(rows):
        line = row[1:].reshape(width, 3)
        if row[0] == 1:
            line = np.cumsum(line, axis=0, dtype=np.uint8)
        elif row[0] == 2:
            line = line + image[y - 1] if y else line
        else:
            assert row[0] == 0, f"filter {row[0]} of row {y}"
        image[y] = line
    return image


class SameResults(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def run_one(self, program, *words, code=0):
        run = subprocess.run([program, *words], cwd=self.folder, capture_output=True, text=True, timeout=600)
        self.assertEqual(run.returncode, code, run.stderr)
        return run

    def run_both(self, words, name):
        """Runs a command line with OUT in it by both programs; returns the paths that they wrote."""
        paths = []
        for folder, program in (("full", PROGRAM), ("bare", BARE)):
            (self.folder / folder).mkdir(exist_ok=True)
            path = self.folder / folder / name
            self.run_one(program, *(word.replace("OUT", str(path)) for word in words.split()))
            paths.append(path)
        return paths

    def make(self, words):
        self.run_one(PROGRAM, *words.split())

    def test_bare_program_has_none_of_the_libraries(self):
        said = self.run_one(BARE, "--version").stdout.splitlines()
        self.assertEqual(said[1:], ["without oneTBB, Embree, libpng, HDF5, Qhull"])
        linked = subprocess.run(["ldd", BARE], capture_output=True, text=True, check=True).stdout
        for library in LIBRARIES:
            self.assertNotIn(f"lib{library}", linked)

    def same_contents(self, words, name):
        full, bare = self.run_both(words, name)
        self.assertEqual(contents(bare), contents(full))
        return full, bare

    def test_models(self):
        self.make("make bumpy --subdivisions 4 -o bumpy.ply")
        for path in self.same_contents("analyze bumpy.ply --degree 24 --length-unit mm -o OUT", "model.h5"):
            for program in (PROGRAM, BARE):
                said = self.run_one(program, "info", "--json", str(path)).stdout
                self.assertIn('"degree": 24', said)

    def test_atlases(self):
        self.make("make torus -o torus.ply")
        self.same_contents("analyze torus.ply --atlas --tolerance 3e-2 -o OUT", "atlas.h5")

    def test_surfaces_of_points(self):
        self.make("make bumpy --subdivisions 3 -o bumpy.ply")
        self.make("make sample bumpy.ply --points 3000 --scans 3 -o points.ply")
        full, bare = self.run_both("reconstruct points.ply -o OUT", "surface.ply")
        self.assertEqual(bare.read_bytes(), full.read_bytes())
        self.same_contents("reconstruct points.ply --model OUT -o again.ply", "model.h5")

    def test_tables(self):
        for k in range(3):
            self.make(f"make bumpy --subdivisions {k + 1} -o {k}.ply")
        (self.folder / "shapes.csv").write_text("path,name\n0.ply,first\n1.ply,zweite\n2.ply,\n")
        self.same_contents("batch shapes.csv --command info --no-times -o OUT", "table.h5")

    def test_pictures(self):
        self.make("make bumpy --subdivisions 4 -o bumpy.ply")
        full, bare = self.run_both("render bumpy.ply --size 240x180 -o OUT", "picture.png")
        one, other = pixels(full).astype(int), pixels(bare).astype(int)
        self.assertEqual(one.shape, (180, 240, 3))
        self.assertGreater(one.std(), 10)
        # A ray that touches an edge may count as a hit or as a miss: at most one pixel in a thousand.
        self.assertLess(np.mean(np.abs(one - other).max(axis=2) > 2), 1e-3)

    def test_what_needs_qhull_is_refused(self):
        self.make("make bumpy --subdivisions 4 -o bumpy.ply")
        run = self.run_one(BARE, "partition", "bumpy.ply", "--show", "triangles", "-o", "t.ply", code=UNSUPPORTED)
        self.assertIn("Qhull", run.stderr)
        self.assertFalse((self.folder / "t.ply").exists())
        self.run_one(BARE, "partition", "bumpy.ply", "--tolerance", "3e-2", "-o", "caps.ply")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
