"""The page of rholm report, as a browser reads it: elements, references, texts."""

import base64
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from html.parser import HTMLParser

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, OCTAHEDRON, RHOLM, main, off

VOID = {"meta", "img", "br", "link", "hr", "input"}
# Elements that a self-contained page does not have, and attributes that load something.
FOREIGN = {"script", "link", "iframe", "object", "embed", "base", "form"}
LOADING = {"href", "xlink:href", "srcset", "action", "data", "poster", "background"}


class Page(HTMLParser):
    """Checks that elements are balanced, nothing is loaded, and pictures have descriptions; collects
    words."""

    def __init__(self, text):
        super().__init__()
        self.open, self.words, self.images, self.ids, self.cells = [], [], [], [], []
        self.problems = []
        self.feed(text)
        self.close()
        if self.open:
            self.problems.append(f"never closed: {self.open}")

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if tag in FOREIGN or LOADING & values.keys():
            self.problems.append(f"<{tag}> with {sorted(values)}")
        if tag == "img":
            self.images.append(values)
            if not values.get("alt") or not values["src"].startswith("data:image/png;base64,"):
                self.problems.append("a picture without words or with a foreign source")
        if tag == "th" and values.get("scope") not in ("row", "col"):
            self.problems.append("a heading of a table that does not say of what")
        if tag == "svg" and not ({"aria-hidden", "aria-label", "aria-labelledby"} & values.keys()):
            self.problems.append("a plot without words")
        if "id" in values:
            self.ids.append(values["id"])
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.problems.append(f"</{tag}> closes something else")

    def handle_data(self, data):
        if "style" not in self.open:
            self.words.append(data)

    def text(self):
        return re.sub(r"\s+", " ", " ".join(self.words))


class Report(CliTest):
    def setUp(self):
        super().setUp()
        self.rholm("make", "bumpy", "--subdivisions", "3", "-o", "a.ply")
        self.rholm("expand", "a.ply", "--degree", "12", "-o", "a.h5", "--quiet")

    def page(self, *words, code=0, output="page.html"):
        result = self.run_rholm("report", *words, "--size", "24", "-o", output)
        self.assertEqual(result.code, code, str(result))
        text = (self.folder / output).read_text(encoding="utf-8")
        page = Page(text)
        self.assertEqual(page.problems, [])
        self.assertEqual(len(page.ids), len(set(page.ids)), "an id twice")
        self.assertIn('<html lang="en">', text)
        self.assertIn('name="viewport"', text)
        self.assertNotRegex(text, r"https?:|url\((?!#)|@import")
        self.assertNotRegex(page.text(), r"(?i)\b(nan|inf|infinity)\b|not finite")
        self.assertNotIn(str(self.folder), text)
        self.assertNotRegex(text, r"\b20[0-9]{2}-[01][0-9]")
        return page

    def test_a_shape_has_pictures_plots_tables_and_commands(self):
        page = self.page("a.ply", "--degree", "16", "--length-unit", "km")
        self.assertEqual(len(page.images), 6)  # degrees 1, 4, 16, the shape, two pictures of errors
        text = page.text()
        for words in ("a.ply", "degree 16", "289", "km", "Parseval", "Conventions", "orthonormal",
                      "642", "1280"):  # coefficients, vertices and faces
            self.assertIn(words, text)

    def test_a_precision_that_is_not_reached_is_said_with_the_way_to_it(self):
        self.rholm("make", "ellipsoid", "--axes", "1,1,1e-10", "--subdivisions", "2", "-o", "flat.ply")
        text = self.page("flat.ply", "--degree", "6", code=4).text()
        said = self.run_rholm("report", "flat.ply", "--degree", "6", "--size", "16", "-o", "f.html").err
        for words in (text, said):
            self.assertIn("the wanted error is 1e-08", words)
            self.assertIn("--engine direct", words)

    def test_coefficients_of_every_format_have_a_page(self):
        for name in ("a.h5", "a.sh", "a.npy"):
            if name != "a.h5":
                self.rholm("convert", "a.h5", name)
            self.assertEqual(len(self.page(name).images), 2)  # degrees 3 and 12
        self.assertIn("assumed", self.page("a.npy").text())
        self.assertEqual(len(self.page("a.h5", "--shape", "a.ply").images), 5)

    def test_its_own_commands_give_the_same_page_and_the_model(self):
        self.page("a.ply", "--degree", "6", "--center", "0.01,0,0", "--length-unit", "my km")
        before = (self.folder / "page.html").read_bytes()
        commands = re.findall(r"<code>(.*?)</code>", before.decode())
        self.assertEqual(len(commands), 2)
        (self.folder / "a.h5").unlink()
        for command in commands:
            self.rholm(*shlex.split(command.replace("&#39;", "'"))[1:])
        self.assertEqual((self.folder / "page.html").read_bytes(), before)
        report = self.rholm("info", "a.h5", "--json").json()
        self.assertEqual((report["degree"], report["unit"]), (6, "my km"))

    def test_same_bytes_for_any_number_of_threads(self):
        pages = []
        for threads in ("1", "3"):
            self.page("a.ply", "--degree", "8", "--threads", threads)
            pages.append((self.folder / "page.html").read_bytes())
        self.assertEqual(pages[0], pages[1])

    def test_a_tolerance_is_a_line_and_a_sentence(self):
        page = self.page("a.ply", "--tolerance", "0.01")
        self.assertIn("is the smallest whose rms error (radius) is within the tolerance",
                      page.text())
        self.assertIn("tolerance (rms)", page.text())
        page = self.page("a.ply", "--tolerance", "1e-9", "--max-degree", "4", code=4)
        self.assertIn("was not reached by degree 4", page.text())

    def test_names_are_text_whatever_they_are(self):
        name = "<b>&\"'\u00fc\n.ply"
        (self.folder / "a.ply").rename(self.folder / name)
        self.assertIn("\u00fc", self.page(name, "--degree", "2").text())

    def test_a_mesh_that_is_not_the_models_is_no_crash(self):
        self.rholm("make", "torus", "-o", "t.ply")
        page = self.page("a.h5", "--shape", "t.ply")
        self.assertIn("t.ply is not the shape that these coefficients were found from", page.text())
        self.assertNotIn("Parseval", page.text())
        self.write("open.off", off(OCTAHEDRON[0], OCTAHEDRON[1][:-1]))
        self.page("a.h5", "--shape", "open.off")

    def test_an_atlas_has_its_caps_and_its_shape(self):
        self.rholm("make", "torus", "-o", "t.ply")
        self.rholm("make", "sample", "t.ply", "--points", "1000", "-o", "t.xyz")
        self.rholm("reconstruct", "t.xyz", "--model", "caps.h5", "-o", "s.ply")
        alone = self.page("caps.h5")
        beside = self.page("caps.h5", "--shape", "t.ply")
        self.assertIn("overlapping caps", alone.text())
        self.assertNotIn("Where the model differs", alone.text())
        self.assertIn("Where the model differs", beside.text())
        before = self.files()
        for words in (["--degree", "3"], ["--weld", "1"], ["--center", "0,0,0"]):
            self.rholm("report", "caps.h5", *words, "-o", "x.html", code=2)
        self.assertEqual(self.files(), before)

    def test_standard_input_and_output(self):
        shape = (self.folder / "a.ply").read_bytes()
        page = self.rholm("report", "-", "--degree", "2", "--size", "16", "--format", "html", "-o",
                          "-", stdin=shape).out
        self.assertEqual(Page(page).problems, [])
        self.assertTrue(page.rstrip().endswith("</html>"))

    def test_wrong_words_and_inputs_are_refused_and_leave_nothing(self):
        self.rholm("make", "torus", "-o", "t.ply")
        self.write("open.off", off(OCTAHEDRON[0], OCTAHEDRON[1][:-1]))
        self.write("p.xyz", "0 0 0\n1 0 0\n0 1 0\n")
        self.write("zero.sh", "0 0 0 0\n")
        before = self.files()
        for code, words in ((2, ["a.ply", "-o", "a.png"]), (2, ["a.ply", "-o", "-"]),
                            (2, ["a.h5", "--degree", "3", "-o", "o.html"]),
                            (2, ["a.h5", "--tolerance", "3", "-o", "o.html"]),
                            (2, ["a.ply", "--shape", "a.ply", "-o", "o.html"]),
                            (2, ["a.ply", "--degree", "3", "--tolerance", "1", "-o", "o.html"]),
                            (2, ["a.ply", "--size", "15", "-o", "o.html"]),
                            (2, ["a.ply", "--center", "left", "-o", "o.html"]),
                            (2, ["-", "--shape", "-", "-o", "o.html"]),
                            (1, ["a.h5", "--shape", "none.ply", "-o", "o.html"]),
                            (1, ["a.ply", "-o", "nowhere/o.html"]),
                            (3, ["t.ply", "-o", "o.html"]), (3, ["open.off", "-o", "o.html"]),
                            (3, ["p.xyz", "-o", "o.html"]),
                            (3, ["a.h5", "--shape", "a.h5", "-o", "o.html"])):
            with self.subTest(" ".join(words)):
                self.rholm("report", *words, code=code)
                self.assertEqual(self.files(), before)
        result = self.run_rholm("report", "zero.sh", "-o", "o.html", "--size", "16")
        self.assertIn(result.code, (0, 3), str(result))
        self.check_decent(result)

    def installed(self, with_viewer):
        """Installs the program in a separate folder."""
        (self.folder / "bin").mkdir()
        program = shutil.copy(RHOLM, self.folder / "bin")
        if with_viewer:
            viewer = self.folder / "share" / "rholm" / "studio" / "viewer"
            viewer.mkdir(parents=True)
            (viewer.parent / "index.html").write_text("<!doctype html>")
            (viewer / "viewer.js").write_text("const end = '</script>';")
        return program

    def interactive(self, program, *words):
        words = [program, "report", *words, "--interactive", "--size", "16", "-o", "o.html"]
        return subprocess.run(words, cwd=self.folder, capture_output=True, text=True)

    def test_interactive_has_the_viewer_that_is_installed(self):
        self.rholm("make", "bumpy", "--subdivisions", "2", "-o", "a.ply")
        run = self.interactive(self.installed(with_viewer=True), "a.ply", "--degree", "5")
        self.assertEqual(run.returncode, 0, run)
        text = (self.folder / "o.html").read_text()
        self.assertIn(r"const end = '<\x2fscript>';", text)
        self.assertIn("--interactive", text)  # in the list of commands
        data = base64.b64decode(re.search(r'id="rholm-data">([^<]+)<', text)[1])
        self.assertEqual(data[:8], b"RHOLM1\0\0")
        meta = json.loads(data[12:12 + int.from_bytes(data[8:12], "little")])["meta"]
        self.assertEqual(meta["expansion"]["degree"], 5)
        self.assertEqual(meta["title"], "a.ply")

    def test_interactive_without_the_viewer_says_how_to_get_it(self):
        self.rholm("make", "bumpy", "--subdivisions", "2", "-o", "a.ply")
        run = self.interactive(self.installed(with_viewer=False), "a.ply")
        self.assertEqual(run.returncode, 3, run)
        self.assertIn("scripts/studio", run.stderr)
        self.assertFalse((self.folder / "o.html").exists())


if __name__ == "__main__":
    main()
