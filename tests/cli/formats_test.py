"""Formats of files, which all parts of the program take from two tables. A program with a made-up format in
each table shows the formats in its help, choices, completions, messages, files and studio.
"""

import json
import os
import re
import sys
import unittest

sys.path.insert(0, os.path.dirname(__file__))
# The program with the two formats ignores the instruction set, because it has its own main().
os.environ["RHOLM"] = os.environ["RHOLM_MADE_UP"]
os.environ.pop("RHOLM_TEST_TARGET", None)
from harness import STUDIO, CliTest, main
from studio_program import TETRAHEDRON, Studio

MESHES = ("convert", "make", "reconstruct", "repair", "simplify", "smooth", "synthesize", "transfer")
POINTS = ("orient",)
COEFFICIENTS = ("align", "expand", "convert", "filter", "recenter", "rotate")


class Formats(CliTest):
    def choices(self, command):
        """Returns the choices of --format in the help of a command."""
        return re.search(r"--format ([\w|]+)", self.rholm(command, "--help", "all").out)[1].split("|")

    def test_choices_of_commands(self):
        for command in MESHES:
            self.assertIn("made", self.choices(command), command)
        for command in POINTS:  # the format holds no points
            self.assertNotIn("made", self.choices(command), command)
        for command in COEFFICIENTS:
            self.assertIn("fancy", self.choices(command), command)

    def test_help_has_the_extensions(self):
        for command in MESHES:
            self.assertIn(".mad", self.rholm(command, "--help").out, command)
        for command in COEFFICIENTS:
            self.assertIn(".fcy", self.rholm(command, "--help").out, command)

    def test_completions_and_the_manual_page(self):
        for shell in ("bash", "zsh", "fish"):
            script = self.rholm("completion", shell).out
            for word in ("mad", "made", "fcy", "fancy"):
                self.assertRegex(script, rf"\b{word}\b", shell)
        self.assertIn(".mad", self.rholm("man-page").out.replace("\\&", ""))

    def test_shapes_are_written_and_read_by_extension_and_name(self):
        self.write("a.off", TETRAHEDRON)
        self.rholm("convert", "a.off", "a.mad")
        self.assertTrue((self.folder / "a.mad").read_bytes().startswith(b"MADE\nOFF\n4 4 0\n"))
        self.rholm("convert", "a.off", "--format", "made", "b")
        self.assertEqual((self.folder / "a.mad").read_bytes(), (self.folder / "b").read_bytes())
        # The format is recognised by the content, whatever the name.
        self.assertEqual(self.rholm("info", "b", "--json").json()["format"], "made")
        self.rholm("convert", "b", "c.off")
        self.rholm("convert", "a.off", "d.off")
        self.assertEqual((self.folder / "c.off").read_bytes(), (self.folder / "d.off").read_bytes())
        self.rholm("expand", "a.mad", "--degree", "2", "-o", "a.h5")

    def test_coefficients_are_written_and_read_by_extension_and_name(self):
        self.write("a.off", TETRAHEDRON)
        self.rholm("expand", "a.off", "--degree", "3", "-o", "a.sh")
        self.rholm("convert", "a.sh", "a.fcy")
        self.assertTrue((self.folder / "a.fcy").read_bytes().startswith(b"FANCY\n# format: rholm-coefficients 1\n"))
        self.rholm("convert", "a.sh", "--format", "fancy", "b")
        self.assertEqual(self.rholm("info", "b", "--json").json()["format"], "fancy")
        self.rholm("convert", "b", "c.sh")
        self.assertEqual((self.folder / "a.sh").read_bytes(), (self.folder / "c.sh").read_bytes())

    def test_messages_have_them(self):
        self.write("a.off", TETRAHEDRON)
        self.write("bytes", b"\0\1\2")
        self.assertIn(".mad", self.rholm("convert", "a.off", "a.foo", code=2).err)
        self.assertIn("MADE", self.rholm("simplify", "bytes", "-o", "a.ply", code=3).err)
        self.assertIn(".mad", self.rholm("simplify", "a.off", "-o", "a.xyz", code=2).err)
        self.assertIn("MADE has only faces", self.rholm("make", "sample", "a.off", "-o", "p.mad", code=2).err)
        self.assertIn(".fcy", self.rholm("expand", "a.off", "--degree", "2", "-o", "a.foo", code=2).err)

    def test_what_it_cannot_hold_is_said(self):
        self.write("a.ply", b"ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                            b"property double z\nproperty double heat\nelement face 1\n"
                            b"property list uchar int vertex_indices\nend_header\n"
                            b"0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 2\n")
        self.assertIn("made has no room for heat", self.rholm("convert", "a.ply", "a.mad").err)

    def test_outputs_of_a_batch(self):
        self.write("a.off", TETRAHEDRON)
        self.write("list.csv", "path\na.off\n")
        self.rholm("batch", "list.csv", "--command", "simplify", "-o", "r.csv", "--outputs", "kept", "--", "--format",
                   "made")
        self.assertEqual([path.suffix for path in (self.folder / "kept").iterdir()], [".mad"])

    @unittest.skipUnless(STUDIO, "built without the studio")
    def test_the_studio_opens_and_saves_them(self):
        studio = Studio(self)
        opened = {one["format"]: one for one in studio.begin()["opens"]}
        self.assertEqual(opened["made"], {"format": "made", "title": "MADE", "extensions": ["mad", "made"],
                                          "kinds": ["mesh"]})
        self.assertEqual(opened["fancy"]["kinds"], ["expansion"])
        state = studio.json("POST", "api/file?name=a.mad", b"MADE\n" + TETRAHEDRON)
        saved = {one["format"]: one for one in state["items"][0]["saved_as"]}
        self.assertEqual(saved["made"], {"format": "made", "label": "Mesh, MADE", "extension": "mad"})
        self.assertNotIn("fancy", saved)  # there are no coefficients yet
        state = studio.step(op="expand", item=state["items"][0]["id"], degree=3)
        saved = {one["format"]: one for one in state["items"][0]["saved_as"]}
        self.assertEqual(saved["fancy"]["extension"], "fcy")
        for one in saved.values():  # every offered format works
            status, headers, _ = studio.ask("GET", f"api/save?item={state['items'][0]['id']}&format={one['format']}")
            self.assertEqual(status, 200, one)
            self.assertIn("." + one["extension"], headers["Content-Disposition"])


if __name__ == "__main__":
    main()
