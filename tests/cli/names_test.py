"""Names that contain commands for a terminal or a shell: names in files, and names of files."""

import json
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, OCTAHEDRON, RHOLM, TIMEOUT, main, off

# Escape, bell, a C1 character, a change of the direction of writing, delete, carriage return.
WILD = "a\x1b]0;x\x07b\x9b31mc\u202ed\x7fe\rf"
ALLOWED = "\n\t"


def commands_a_terminal(text):
    """Returns characters of `text` that a terminal would not simply show."""
    shown = text.decode("utf-8")  # it must be UTF-8
    return [c for c in shown if c not in ALLOWED and
            (ord(c) < 32 or 127 <= ord(c) < 160 or c in "\u061c\u200e\u200f\u2028\u2029\ufeff" or
             "\u202a" <= c <= "\u202e" or "\u2066" <= c <= "\u2069")]


def ply(names):
    """Returns the corners of a tetrahedron with attributes of these names (bytes)."""
    lines = [b"ply", b"format ascii 1.0", b"element vertex 4"]
    lines += [b"property float " + name for name in (b"x", b"y", b"z", *names)]
    lines += [b"element face 4", b"property list uchar int vertex_indices", b"end_header"]
    corners = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    lines += [b" ".join(b"%d" % x for x in (*corner, *[7] * len(names))) for corner in corners]
    lines += [b"3 0 1 2", b"3 0 3 1", b"3 0 2 3", b"3 1 3 2"]
    return b"\n".join(lines) + b"\n"


class Names(CliTest):
    def said(self, *words, code=0):
        process = subprocess.run([RHOLM, *words], cwd=self.folder, capture_output=True,
                                 stdin=subprocess.DEVNULL, timeout=TIMEOUT)
        self.assertEqual(process.returncode, code, (words, process.stderr))
        for text in (process.stdout, process.stderr):
            self.assertEqual(commands_a_terminal(text), [], (words, text))
        return process

    def test_attributes_of_files(self):
        name = WILD.replace("\r", "")  # a carriage return ends a line
        self.write("w.ply", ply([name.encode()]))
        text = self.said("info", "w.ply").stdout.decode()
        self.assertIn(r"a\x1b]0;x\x07b\u009b31mc\u202ed\x7fe", text)
        # Programs get the exact name.
        report = json.loads(self.said("info", "w.ply", "--json").stdout)
        self.assertEqual([a["name"] for a in report["attributes"]], [name])
        self.assertIn(rb"\x1b]0", self.said("convert", "w.ply", "w.obj").stderr)
        self.write("latin.ply", ply([b"h\xf6he\x9b31m"]))
        self.assertIn(rb"h\xf6he\x9b31m", self.said("info", "latin.ply").stdout)

    def test_words_of_files_in_messages(self):
        wild = WILD.replace("\r", "").encode()
        # Words have no blanks, so that blanks are left out.
        for text in (b"ply\nformat " + wild + b" 1.0\n", b"ply\nformat ascii 1.0\nelement " + wild +
                     b" -1\n", ply([]).replace(b"1 1 1", b"1 1 " + wild), b"OFF\n4 " + wild):
            self.write("bad.ply" if text.startswith(b"ply") else "bad.off", text)
            self.said("info", "bad.ply" if text.startswith(b"ply") else "bad.off", code=3)

    def test_texts_of_models(self):
        self.write("o.off", off(*OCTAHEDRON))
        self.rholm("expand", "o.off", "--degree", "2", "-o", "o.json")
        model = json.loads((self.folder / "o.json").read_text())
        keys = [key for key in ("unit", "method") if key in model] or ["unit"]
        for key in keys:
            self.write("wild.json", json.dumps({**model, key: "m\x1b[31m\nrholm: error: no"}))
            process = subprocess.run([RHOLM, "info", "wild.json"], cwd=self.folder,
                                     capture_output=True, timeout=TIMEOUT)
            for text in (process.stdout, process.stderr):
                self.assertEqual(commands_a_terminal(text), [], (key, text))
                self.assertNotIn(b"\nrholm: error: no", text)

    def test_names_of_files(self):
        for name in (WILD.encode(), b"new\nline", b"\xff\xfe\x9b31m"):
            path = name + b".off"
            self.write(os.fsdecode(path), off(*OCTAHEDRON))
            self.assertIn(b"mesh", self.said("info", path).stdout.splitlines()[0])
            report = self.said("info", path, "--json").stdout
            # Bytes that are not UTF-8 cannot be in JSON.
            self.assertEqual(json.loads(report)["file"], path.decode("utf-8", "replace"))
            self.said("spectrum", path, code=3)
            self.said("info", b"no such " + path, code=1)
            self.said("make", "box", "-o", path + b"/in/it.ply", code=1)
            self.said("expand", path, "--degree", "2", "-o", path, code=2)

    def test_no_name_looks_like_another_message(self):
        process = self.said("info", "x\nrholm: note: all is well", code=1)
        self.assertEqual(len(re.findall(rb"^rholm: ", process.stderr, re.M)), 1, process.stderr)

    def test_commands_that_are_printed_can_be_typed(self):
        for name in ("-x.off", "--json.off", "a b.off", "it's.off", 'q"$(date)`.off', "l\nm.off",
                     WILD + ".off", "ä.off", "-", "~.off", "#.off"):
            path = "./-" if name == "-" else name
            self.write(name, off(*OCTAHEDRON))
            message = self.said("spectrum", "--", path, code=3).stderr.decode()
            command = re.search(r"compute them with '(rholm expand .*) --degree L", message, re.S)[1]
            # The shell splits the line as intended.
            words = subprocess.run(["bash", "-c", f'rholm() {{ printf "%s\\0" "$@"; }}; {command}'],
                                   capture_output=True, check=True).stdout.decode().split("\0")
            self.assertEqual(words[0], "expand")
            self.assertEqual(words[1], "./" + name if path.startswith("-") else path)


if __name__ == "__main__":
    main()
