"""The list of degenerate inputs through every command: the right exit code, no NaN, no crash, no temporary
files. Star-shaped shapes must work; other shapes must be refused with a message."""

import math
import os
import re
import struct
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, OCTAHEDRON, binary_stl, main, nightly, off, scaled

FINE, REFUSED = {0}, {3}
EITHER = {0, 3}

V, F = OCTAHEDRON
TETRAHEDRON = ([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)],
               [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])


def ply(mesh, kind="double"):
    """Returns a binary little-endian PLY file."""
    code = {"double": "d", "float": "f"}[kind]
    text = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(mesh[0])}\n"
            + "".join(f"property {kind} {x}\n" for x in "xyz")
            + f"element face {len(mesh[1])}\nproperty list uchar int vertex_indices\nend_header\n")
    data = text.encode()
    for v in mesh[0]:
        data += struct.pack("<3" + code, *v)
    for f in mesh[1]:
        data += struct.pack("<B3i", 3, *f)
    return data


# name: (content, exit codes of info, of center and expand, of compare and render)
SHAPES = {
    "empty.ply": (b"", REFUSED, REFUSED, REFUSED),
    "empty.off": (b"", REFUSED, REFUSED, REFUSED),
    "empty.xyz": (b"", REFUSED, REFUSED, REFUSED),
    "nothing.off": ("OFF\n0 0 0\n", EITHER, REFUSED, REFUSED),
    "no-faces.off": (off(V, []), EITHER, REFUSED, REFUSED),
    "one-triangle.off": (off(V[:3], [(0, 1, 2)]), FINE, REFUSED, FINE),
    "zero-area.off": (off([(0, 0, 0), (1, 1, 1), (2, 2, 2)], [(0, 1, 2)]), FINE, REFUSED, REFUSED),
    "one-point.off": (off([(1, 2, 3)] * 3, [(0, 1, 2)]), FINE, REFUSED, REFUSED),
    "same-corner-twice.off": (off(V, [*F, (0, 0, 1)]), FINE, FINE, FINE),
    "duplicate-points.stl": (binary_stl(OCTAHEDRON), FINE, FINE, FINE),
    "duplicate-face.off": (off(V, [*F, F[0]]), FINE, REFUSED, FINE),
    "open.off": (off(V, F[:-1]), FINE, REFUSED, FINE),
    "flipped-face.off": (off(V, [F[0][::-1], *F[1:]]), FINE, REFUSED, FINE),
    "inside-out.off": (off(V, [f[::-1] for f in F]), FINE, FINE, FINE),
    "two-parts.off": (off(V + [(x + 5, y, z) for x, y, z in V],
                          F + [tuple(i + 6 for i in f) for f in F]), FINE, REFUSED, FINE),
    "pole-on-vertex.off": (off(V, F), FINE, FINE, FINE),
    "pole-on-edge.off": (off(*TETRAHEDRON), FINE, FINE, FINE),
    "isolated-vertex.off": (off(V + [(9, 9, 9)], F), FINE, FINE, FINE),
    "nan.off": (off([("nan", 0, 0), *V[1:]], F), REFUSED, REFUSED, REFUSED),
    "infinite.off": (off([("inf", 0, 0), *V[1:]], F), REFUSED, REFUSED, REFUSED),
    "overflow.off": (off([("1e999", 0, 0), *V[1:]], F), REFUSED, REFUSED, REFUSED),
    "nan.ply": (ply(([(math.nan, 0, 0), *V[1:]], F)), REFUSED, REFUSED, REFUSED),
    "nan.stl": (binary_stl(([(math.nan, 0, 0), *V[1:]], F)), REFUSED, REFUSED, REFUSED),
    "infinite.ply": (ply(([(math.inf, 0, 0), *V[1:]], F)), REFUSED, REFUSED, REFUSED),
    "index-too-large.off": (off(V, [*F[1:], (0, 1, 6)]), REFUSED, REFUSED, REFUSED),
    "index-negative.ply": (ply((V, [*F[1:], (0, 1, -1)])), REFUSED, REFUSED, REFUSED),
    "large.off": (off(*scaled(OCTAHEDRON, 1e30)), FINE, FINE, FINE),
    "small.off": (off(*scaled(OCTAHEDRON, 1e-30)), FINE, FINE, FINE),
    "huge.off": (off(*scaled(OCTAHEDRON, 1e200)), EITHER, EITHER, EITHER),
    "largest.off": (off(*scaled(OCTAHEDRON, 1e308)), EITHER, EITHER, EITHER),
    "tiny.off": (off(*scaled(OCTAHEDRON, 1e-200)), EITHER, EITHER, EITHER),
    "denormal.off": (off(*scaled(OCTAHEDRON, 1e-310)), EITHER, EITHER, EITHER),
    "far-away.off": (off([(x + 1e9, y, z) for x, y, z in V], F), FINE, FINE, FINE),
    "truncated.ply": (ply(OCTAHEDRON)[:-5], REFUSED, REFUSED, REFUSED),
    "truncated-header.ply": (ply(OCTAHEDRON)[:60], REFUSED, REFUSED, REFUSED),
    "truncated.off": (off(*OCTAHEDRON)[:-9], REFUSED, REFUSED, REFUSED),
    "truncated.stl": (binary_stl(OCTAHEDRON)[:-7], REFUSED, REFUSED, REFUSED),
    "claims-too-much.ply": (ply(OCTAHEDRON).replace(b"vertex 6", b"vertex 4000000000"),
                            REFUSED, REFUSED, REFUSED),
    "claims-too-much.stl": (b"\0" * 80 + b"\xff\xff\xff\x7f", REFUSED, REFUSED, REFUSED),
    "claims-too-much.off": ("OFF\n4000000000 4000000000 0\n0 0 0\n", REFUSED, REFUSED, REFUSED),
    "noise.ply": (bytes(range(256)) * 4, REFUSED, REFUSED, REFUSED),
    "noise.bin": (bytes(range(256)) * 4, REFUSED, REFUSED, REFUSED),
}


NOT_A_NUMBER = re.compile(rb"\b(nan|inf|infinity)\b", re.I)


class Degenerate(CliTest):
    every_way = False

    def variants(self, name, *ways):
        """Returns ways to run a command: the first for unreadable shapes, another way for each readable
        shape, or all."""
        if SHAPES[name][1] == REFUSED:
            return ways[:1]
        if self.every_way:
            return ways
        turn = list(SHAPES).index(name) % len(ways)
        return ways[turn:turn + 1]

    def setUp(self):
        super().setUp()
        for name, (content, *_) in SHAPES.items():
            self.write(name, content)
        self.write("good.off", off(*OCTAHEDRON))
        self.write("good.sh", "0 0 1 0\n1 0 0.1 0\n1 1 0 0\n")

    def check(self, codes, *words, output=None):
        """Runs a command; its exit code must be allowed, and a refusal must leave no file behind. Exit code
        4 means an output that is not reliable."""
        before = self.files()
        result = self.run_rholm(*words, *(["-o", output] if output else []))
        self.assertIn(result.code, codes, str(result))
        self.check_decent(result)
        done = result.code in (0, 4)
        if result.code != 0:
            if not done:
                self.assertEqual(self.files(), before, f"left behind by {result}")
            self.assertTrue(result.err or "star" in result.out, str(result))
        if output and done:
            path = self.folder / output
            if path.suffix not in (".png", ".h5", ".ply", ".stl"):
                self.assertIsNone(NOT_A_NUMBER.search(path.read_bytes()), str(result))
            path.unlink()
        return result

    def test_info(self):
        for name, (_, codes, _, _) in SHAPES.items():
            with self.subTest(name):
                self.check(codes, "info", name)
                if self.check(codes, "info", name, "--json").code == 0:
                    self.rholm("info", name, "--json").json()

    def test_center(self):
        for name, (_, _, codes, _) in SHAPES.items():
            for kind in self.variants(name, "auto", "slope", "cosine", "none", "centroid", "volume"):
                with self.subTest(f"{name} {kind}"):
                    # "none" may be a centre outside the shape.
                    allowed = codes | EITHER if kind == "none" and codes == FINE else codes
                    self.check(allowed, "center", name, "--rays", "500", "--center", kind)

    def test_expand(self):
        for name, (_, _, codes, _) in SHAPES.items():
            # Methods of the same function have the same errors.
            for method in self.variants(name, ["edge"], ["gauge"], ["curl", "--no-errors"],
                                   ["area", "--no-errors"]):
                with self.subTest(f"{name} {method[0]}"):
                    self.check(codes, "expand", name, "--degree", "3", "--method", *method,
                               "--rays", "500", output="out.sh")

    def test_expand_signed(self):
        for name, (_, _, codes, _) in SHAPES.items():
            with self.subTest(name):
                self.check(codes | EITHER, "expand", name, "--degree", "3", "--signed", "--rays",
                           "500", output="out.json")

    def test_compare_and_render(self):
        for name, (_, _, _, codes) in SHAPES.items():
            with self.subTest(name):
                result = self.check(codes, "compare", name, "good.off", "--samples", "200",
                                    "--json")
                if result.code == 0:
                    result.json()
                # A picture without anything visible is allowed, a crash is not.
                self.check(codes | EITHER, "render", name, "--size", "64x48", output="out.png")

    def test_report(self):
        for name, (_, _, codes, _) in SHAPES.items():
            for words in self.variants(name, (name, "--degree", "3"), ("good.sh", "--shape", name)):
                with self.subTest(words):
                    self.check(codes if words[0] == name else codes | FINE, "report", *words, "--size", "16",
                               output="out.html")

    def test_convert(self):
        for name, (_, codes, _, _) in SHAPES.items():
            for output in self.variants(name, "out.off", "out.obj", "out.ply", "out.stl"):
                with self.subTest(f"{name} to {output}"):
                    # STL has single precision, and holds neither large numbers nor points.
                    before = self.files()
                    result = self.check(codes | EITHER, "convert", name, output)
                    if result.code == 0:
                        (self.folder / output).unlink()
                    self.assertEqual(self.files(), before)

    def test_sample_and_orient(self):
        # A surface with area has points; three places that are not on a line have normals.
        for name, (_, codes, _, sampled) in SHAPES.items():
            with self.subTest(name):
                self.check(sampled, "make", "sample", name, "--points", "50", output="out.ply")
                self.check(codes | EITHER | {4}, "orient", name, output="out.xyz")

    def test_smooth(self):
        for name in SHAPES:
            for region in self.variants(name, "ball:0,0,0,3", "vertex:0,1"):
                for fit in self.variants(name, "robust", "mean", "around"):
                    with self.subTest(f"{name} {region} {fit}"):
                        self.check(EITHER, "smooth", name, "--region", region, "--wavelength", "2",
                                   "--fitting", fit, output="out.ply")

    def test_transfer(self):
        for name in SHAPES:
            for region in self.variants(name, "ball:0,0,0,3", "vertex:0,1"):
                with self.subTest(f"{name} {region}"):
                    for source, target in ((name, "good.off"), ("good.off", name)):
                        self.check(EITHER, "transfer", "--from", source, "--from-region", region,
                                   "--to", target, "--to-region", region, "--refine",
                                   output="out.ply")

    def test_reconstruct(self):
        # No shape has enough points.
        for name in SHAPES:
            with self.subTest(name):
                self.check(REFUSED, "reconstruct", name, output="out.ply")

    def test_center_on_the_surface_is_refused(self):
        self.rholm("make", "box", "--size", "2,2,2", "-o", "box.ply")
        for center in ("1,0,0", "1,1,0", "1,1,1", "0.25,-1,0.125"):
            with self.subTest(center):
                words = ["expand", "box.ply", "--degree", "3", "--center", center]
                self.check(REFUSED, *words, output="out.sh")
                # A face through the centre adds nothing to the alternating sum, which exists.
                self.check(EITHER, *words, "--signed", output="out.sh")

    def test_center_outside_is_refused(self):
        self.check(REFUSED, "expand", "good.off", "--degree", "3", "--center", "2,0,0",
                   output="out.sh")

    def test_pole_on_edge_through_every_method(self):
        # The top face of the first box has its diagonal through the pole.
        self.rholm("make", "box", "-o", "box.ply")
        for method in ("edge", "gauge", "curl", "area"):
            self.check(FINE, "expand", "box.ply", "--degree", "6", "--method", method,
                       output="out.sh")

    def test_degree_zero_goes_all_the_way(self):
        self.rholm("expand", "good.off", "--degree", "0", "-o", "zero.h5")
        for words in (["info", "zero.h5"], ["spectrum", "zero.h5"],
                      ["compare", "good.off", "zero.h5", "--samples", "100"]):
            self.check(FINE, *words)
        for words, output in ((["synthesize", "zero.h5"], "z.ply"), (["spectrum", "zero.h5"], "z.svg"),
                              (["render", "zero.h5", "--size", "64x64"], "z.png"),
                              (["report", "zero.h5", "--size", "16"], "z.html")):
            self.check(FINE, *words, output=output)
        for name in ("z.sh", "z.gfc", "z.json", "z.npy"):
            self.rholm("convert", "zero.h5", name)
            self.check(FINE, "info", name)


@nightly
class EveryWay(Degenerate):
    """Runs each shape through all ways of a command."""

    every_way = True



class DegenerateCoefficients(CliTest):
    """Files of coefficients that are truncated, inconsistent, or without a surface."""

    def setUp(self):
        super().setUp()
        self.write("good.off", off(*OCTAHEDRON))
        self.rholm("expand", "good.off", "--degree", "6", "-o", "good.h5")
        for name in ("good.sh", "good.gfc", "good.json", "good.npy"):
            self.rholm("convert", "good.h5", name)

    def check_refused(self, name):
        for words in (["info", name], ["spectrum", name], ["synthesize", name, "-o", "o.ply"],
                      ["convert", name, "o.sh"], ["render", name, "-o", "o.png"],
                      ["report", name, "-o", "o.html"],
                      ["filter", name, "--low-pass", "2", "-o", "o.h5"],
                      ["rotate", name, "--mirror", "x", "-o", "o.h5"], ["align", name, "good.h5"]):
            before = self.files()
            with self.subTest(" ".join(words)):
                self.rholm(*words, code=3)
                self.assertEqual(self.files(), before)

    def test_truncated_files_are_refused(self):
        for name in ("good.h5", "good.json", "good.npy"):
            data = (self.folder / name).read_bytes()
            for part in (10, len(data) // 2, len(data) - 8):
                bad = "bad" + os.path.splitext(name)[1]
                self.write(bad, data[:part])
                self.check_refused(bad)

    def test_empty_files_are_refused(self):
        for name in ("e.h5", "e.sh", "e.gfc", "e.json", "e.npy", "e.txt"):
            self.write(name, b"")
            self.check_refused(name)
            self.assertIn("empty", self.rholm("repair", name, "-o", "o.ply", code=3).err)

    def test_text_with_the_extension_of_models_is_no_model(self):
        self.write("text.h5", "nothing of use\n")
        for command in (["repair", "text.h5", "-o", "o.ply"], ["render", "text.h5", "-o", "o.png"]):
            self.assertNotIn("contains coefficients", self.rholm(*command, code=3).err)

    def test_lies_are_refused_quickly(self):
        header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 1000001, 1000001), }"
        self.write("huge.npy", b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) +
                   header.encode())
        self.write("huge.sh", "2000000000 0 1 0\n")
        self.write("order.sh", "0 0 1 0\n1 2 1 0\n")
        self.write("undefined.sh", "0 0 nan 0\n")
        self.write("huge.gfc", "max_degree 2000000000\nend_of_head\ngfc 0 0 1 0\n")
        self.write("huge.json", '{"format": "rholm-coefficients", "degree": 2000000000}')
        for name in ("huge.npy", "huge.sh", "order.sh", "undefined.sh", "huge.gfc", "huge.json"):
            self.check_refused(name)

    def test_gains_that_are_none_are_refused(self):
        for text in ("", "# nothing\n", "1\n", "1 2 3\n", "-1 1\n", "one 1\n", "1 nan\n", "1 inf\n",
                     "1 0.5\n1 0.5\n", "1.5 1\n", "99999999999999999999 1\n", "1 " + "0" * 5000):
            self.write("gains.txt", text)
            with self.subTest(text[:20]):
                self.rholm("filter", "good.h5", "--gain", "gains.txt", "-o", "o.h5", code=3)
                self.assertNotIn("o.h5", self.files())
        self.rholm("filter", "good.h5", "--gain", "none.txt", "-o", "o.h5", code=1)
        self.rholm("filter", "good.h5", "--gain", ".", "-o", "o.h5", code=1)

    def test_rotations_that_are_none_are_refused(self):
        for words, code in ((["--axis", "0,0,0", "--angle", "1"], 2),
                            (["--matrix", "1,0,0,0,1,0,0,0,2"], 2),
                            (["--matrix", "1,0,0,0,1,0,0,0,-1"], 2), (["--matrix", "1,2"], 2),
                            (["--axis", "nan,0,0", "--angle", "1"], 2),
                            (["--mirror", "x", "--about", "here"], 2)):
            with self.subTest(" ".join(words)):
                self.rholm("rotate", "good.h5", *words, "-o", "o.h5", code=code)
                self.assertNotIn("o.h5", self.files())

    def test_editing_goes_with_every_degree_and_function(self):
        self.rholm("expand", "good.off", "--degree", "0", "-o", "zero.h5")
        self.rholm("expand", "good.off", "--degree", "6", "--method", "gauge", "-o", "gauge.h5")
        for name in ("zero.h5", "gauge.h5", "good.npy"):
            for words in (["filter", name, "--low-pass", "0"], ["filter", name, "--high-pass", "9"],
                          ["filter", name, "--low-pass", "4", "--window", "plateau"],
                          ["rotate", name, "--principal-axes"],
                          ["rotate", name, "--axis", "1,1,1", "--angle", "120"]):
                with self.subTest(" ".join(words)):
                    self.rholm(*words, "--json", "-o", "o.json").json()
                    self.rholm("info", "o.json")
        self.rholm("align", "good.h5", "gauge.h5", code=3)
        report = self.rholm("align", "zero.h5", "zero.h5", "--json").json()
        self.assertEqual(len(report["free_axes"]), 3)

    def test_a_surface_without_centroid_is_aligned_by_its_own_centre(self):
        self.write("odd.sh", "0 0 1 0\n1 0 2 0\n1 1 0 0\n")
        self.write("point.sh", "0 0 0 0\n")
        for name in ("odd.sh", "point.sh"):
            result = self.rholm("align", name, "good.sh", "--json")
            result.json()
            self.assertIn("own centres", result.err)

    def test_an_octahedron_lies_in_24_ways(self):
        self.rholm("rotate", "good.h5", "--axis", "1,2,3", "--angle", "50", "-o", "turned.h5")
        report = self.rholm("align", "good.h5", "turned.h5", "-o", "laid.h5", "--json").json()
        self.assertEqual(len(report["ambiguities"]), 23)
        self.assertLess(report["distance"], 1e-6)
        self.assertEqual(self.rholm("align", "laid.h5", "turned.h5", "--json").json()["angle"] < 1e-4,
                         True)

    def test_a_radius_below_zero_is_said(self):
        self.write("odd.sh", "0 0 1 0\n1 0 2 0\n1 1 0 0\n")
        result = self.rholm("synthesize", "odd.sh", "-o", "o.off")
        self.assertIn("crosses its centre", result.err)
        self.assertIsNone(NOT_A_NUMBER.search((self.folder / "o.off").read_bytes()))

    def test_zero_coefficients_are_a_point_and_no_crash(self):
        self.write("zero.sh", "0 0 0 0\n")
        for words in (["info", "zero.sh"], ["spectrum", "zero.sh"],
                      ["synthesize", "zero.sh", "-o", "o.ply"],
                      ["render", "zero.sh", "-o", "o.png", "--size", "64x64"],
                      ["compare", "good.off", "zero.sh", "--samples", "10"]):
            result = self.run_rholm(*words)
            self.assertIn(result.code, EITHER, str(result))
            self.check_decent(result)


if __name__ == "__main__":
    main()
