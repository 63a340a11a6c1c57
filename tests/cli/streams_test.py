"""Closed standard descriptors, outputs that are pipes, and the output that --quiet leaves."""

import os
import re
import subprocess
import sys
import threading

sys.path.insert(0, os.path.dirname(__file__))
from harness import NIGHTLY, CliTest, RHOLM, TIMEOUT, Result, main, nightly_too

# One line of every command that ends by itself, with the files of prepare(). %o is an output.
COMMANDS = [
    "info e.ply", "info e.ply --json", "info e.json --json", "center e.ply --json",
    "expand e.ply --degree 4 -o %o.h5 --json", "expand e.ply --degree 4 -o %o.json",
    "compress e.ply --tolerance .2 --unit diagonal -o %o.h5",
    "synthesize e.json --subdivisions 1 -o %o.ply", "spectrum e.json", "spectrum e.json -o %o.svg",
    "compare e.ply e.ply --json", "convert e.ply %o.obj", "convert e.ply --format off -",
    "render e.ply --size 32x32 -o %o.png", "report e.json --size 32 -o %o.html",
    "filter e.json --low-pass 2 -o %o.json", "rotate e.json --euler 1,2,3 -o %o.json --json",
    "recenter e.json -o %o.json", "align e.json e.json", "simplify e.ply --faces 100 -o %o.ply",
    "repair e.ply -o %o.ply", "smooth e.ply --region ball:0,0,1,1 --wavelength 1.4 -o %o.ply --json",
    "make sample e.ply --points 200 -o %o.xyz", "make box -o %o.stl",
    "orient p.xyz -o %o.ply", "reconstruct p.xyz -o %o.ply --json",
    "partition e.ply --tolerance .2 -o %o.ply", "batch rows.csv --command info -o %o.csv --no-times",
    "completion bash", "man-page", "help", "expand --help", "--version", "expand",
    "info nothing.ply --json"]
REFUSED = {"expand": 2, "info nothing.ply --json": 1}


class Streams(CliTest):
    def setUp(self):
        super().setUp()
        self.rholm("make", "ellipsoid", "--axes", "3,2,1", "--subdivisions", "2", "-o", "e.ply")
        self.rholm("expand", "e.ply", "--degree", "4", "-o", "e.json")
        self.rholm("make", "sample", "e.ply", "--points", "500", "-o", "p.xyz")
        self.write("rows.csv", "path\ne.ply\n")

    def shell(self, redirection, words, **options):
        process = subprocess.run(["sh", "-c", f'exec "$@" {redirection}', "sh", RHOLM, *words],
                                 cwd=self.folder, capture_output=True, timeout=TIMEOUT,
                                 stdin=subprocess.DEVNULL, **options)
        return Result(process, words)

    def outputs(self, begin):
        """Returns names and bytes of the files whose names begin with `begin`, and removes them."""
        found = {}
        for path in sorted(self.folder.glob(begin + "*")):
            found[path.name[len(begin):]] = path.read_bytes()
            path.unlink()
        return found


class Closed(Streams):
    @nightly_too
    def test_every_command_with_a_descriptor_closed(self):
        for k, line in enumerate(COMMANDS):
            self.check_closed(line, range(3) if NIGHTLY else [k % 3])

    def check_closed(self, line, descriptors):
        words = line.split()
        plain = self.shell("", [w.replace("%o", "out") for w in words])
        made = self.outputs("out")
        self.assertEqual(plain.code, REFUSED.get(line, 0), str(plain))
        for closed in descriptors:
            redirection = ("<&-", ">&-", "2>&-")[closed]
            with self.subTest(line, closed=closed):
                result = self.shell(redirection, [w.replace("%o", "out") for w in words])
                self.assertEqual(self.outputs("out"), made, str(result))
                self.check_decent(result) if closed != 2 else None
                if closed == 1 and plain.bytes:
                    # As for any output that cannot be written, the exit code is 1; an earlier error takes
                    # precedence.
                    self.assertEqual(result.code, plain.code or 1, str(result))
                    self.assertIn("standard output", result.err)
                else:
                    self.assertEqual(result.code, plain.code, str(result))
                if closed != 1:  # except for times
                    self.assertEqual(re.sub(rb"[0-9.e+-]+", b"", result.bytes),
                                     re.sub(rb"[0-9.e+-]+", b"", plain.bytes))

    def test_input_from_a_closed_descriptor_cannot_be_read(self):
        result = self.shell("<&-", ["info", "-"])
        self.assertEqual(result.code, 1, str(result))
        self.assertIn("standard input", result.err)

    def test_all_closed_at_once(self):
        result = self.shell("<&- >&- 2>&-", ["expand", "e.ply", "--degree", "4", "-o", "all.h5",
                                             "--json"])
        self.assertEqual(result.code, 1)
        self.rholm("expand", "e.ply", "--degree", "4", "-o", "plain.h5")
        self.assertEqual((self.folder / "all.h5").read_bytes(),
                         (self.folder / "plain.h5").read_bytes())


# Commands with an output, and the extension of its format.
WRITERS = [("make box", "off"), ("convert e.ply", "stl"), ("expand e.ply --degree 4", "json"),
           ("synthesize e.json --subdivisions 1", "ply"), ("filter e.json --low-pass 2", "npy"),
           ("render e.ply --size 32x32", "png"), ("spectrum e.json", "csv"),
           ("simplify e.ply --faces 100", "obj"), ("make sample e.ply --points 200", "xyz"),
           ("reconstruct p.xyz", "ply"), ("report e.json --size 32", "html")]


def output_words(line, name):
    return [name] if line.startswith("convert") else ["-o", name]


def without_command(data):
    """A report contains its command with the name of the output, which is removed here."""
    return re.sub(rb"<code>rholm [^<]*</code>", b"", data)


class Pipes(Streams):
    def plain(self, line, form):
        self.rholm(*line.split(), *output_words(line, f"plain.{form}"))
        return (self.folder / f"plain.{form}").read_bytes()

    def through_pipe(self, line, form):
        read, write = os.pipe()
        received = []

        def receive():
            with os.fdopen(read, "rb") as file:
                received.append(file.read())

        reader = threading.Thread(target=receive)
        reader.start()
        process = subprocess.run([RHOLM, *line.split(), "--format", form,
                                  *output_words(line, f"/dev/fd/{write}")],
                                 cwd=self.folder, capture_output=True, pass_fds=[write],
                                 timeout=TIMEOUT)
        os.close(write)
        reader.join()
        self.assertEqual(process.returncode, 0, process.stderr)
        return received[0]

    def test_descriptors_by_their_path(self):
        for line, form in WRITERS:
            with self.subTest(line):
                self.assertEqual(without_command(self.through_pipe(line, form)),
                                 without_command(self.plain(line, form)))

    def test_standard_output_by_its_path_is_that_of_the_dash(self):
        for name in ("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):
            dash = self.rholm("convert", "e.ply", "--format", "off", "-")
            self.assertEqual(self.rholm("convert", "e.ply", "--format", "off", name).bytes,
                             dash.bytes)
            # The report is not mixed with the data.
            both = self.rholm("simplify", "e.ply", "--faces", "100", "--format", "off", "-o", name)
            self.assertTrue(both.bytes.startswith(b"OFF") and b"simplified" not in both.bytes)
            self.rholm("expand", "e.ply", "--degree", "2", "--format", "json", "-o", name,
                       "--json", code=2)

    def test_what_stands_in_a_file_stays_where_a_descriptor_appends(self):
        self.write("log.off", "# before\n")
        result = self.shell("3>>log.off", ["make", "box", "--format", "off", "-o", "/dev/fd/3"])
        self.assertEqual(result.code, 0, str(result))
        self.assertEqual((self.folder / "log.off").read_bytes(),
                         b"# before\n" + self.plain("make box", "off"))

    def test_named_pipes(self):
        os.mkfifo(self.folder / "pipe.off")
        received = []
        reader = threading.Thread(
            target=lambda: received.append((self.folder / "pipe.off").read_bytes()))
        reader.start()
        self.rholm("make", "box", "-o", "pipe.off")
        reader.join()
        self.assertEqual(received[0], self.plain("make box", "off"))

    def test_a_descriptor_that_is_closed_is_an_output_that_cannot_be_written(self):
        self.rholm("make", "box", "--format", "off", "-o", "/dev/fd/77", code=1)

    def test_model_files_are_refused_before_the_work(self):
        os.mkfifo(self.folder / "pipe.h5")
        # The input does not exist: the program has not searched for it yet.
        for words in (["expand", "none.ply", "--degree", "4"], ["filter", "none.h5", "--low-pass", "2"],
                      ["compress", "none.ply", "--tolerance", ".1"]):
            self.rholm(*words, "-o", "pipe.h5", code=2)
            self.rholm(*words, "--format", "h5", "-o", "/dev/stdout", code=2)


class Quiet(Streams):
    def test_commands_that_write_a_file_print_nothing(self):
        for line in COMMANDS:
            if "%o" not in line or "--json" in line:
                continue
            with self.subTest(line):
                result = self.rholm(*line.replace("%o", "out").split(), "--quiet")
                self.assertEqual((result.out, result.err), ("", ""))


if __name__ == "__main__":
    main()
