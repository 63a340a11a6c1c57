"""The command line: help, versions, wrong words, exit codes, places of output."""

import os
import re
import resource
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, OCTAHEDRON, RHOLM, SOURCE, STUDIO, Terminal, main, off

COMMANDS = ["info", "center", "expand", "synthesize", "spectrum", "compare", "convert", "render",
            "report", "make", "filter", "rotate", "align", "smooth", "transfer", "orient", "reconstruct",
            "completion", *(["studio"] if STUDIO else [])]

PARTS = ("oneTBB", "Embree", "libpng", "HDF5", "Qhull")


class Help(CliTest):
    def test_version_is_that_of_the_header(self):
        header = (SOURCE / "include/rholm/version.h").read_text()
        version = re.search(r'kVersion = "([^"]+)"', header)[1]
        said = self.rholm("--version").out.splitlines()
        self.assertEqual(said[0], f"rholm {version}")
        # Each optional library is named once, as used or as left out.
        parts = [part for line in said[1:] for part in re.split(r"^with(?:out)? |, ", line)[1:]]
        self.assertEqual(sorted(parts), sorted(PARTS))
        # The version is also in the files that people cite and read.
        citation = (SOURCE / "CITATION.cff").read_text()
        self.assertEqual(re.search(r"^version: (.+)$", citation, re.M)[1], version)
        released = re.search(r"^## \[(\d.*?)\] - (.+)$", (SOURCE / "CHANGELOG.md").read_text(), re.M)
        self.assertEqual(released[1], version)
        self.assertEqual(re.search(r"^date-released: (.+)$", citation, re.M)[1], released[2])

    def test_help_lists_every_command(self):
        for words in (["help"], ["--help"], ["-h"]):
            text = self.rholm(*words).out
            for command in COMMANDS:
                self.assertRegex(text, rf"\n  {command} +\w")
            self.assertLessEqual(max(map(len, text.splitlines())), 80)

    def test_help_of_each_command_has_usage_options_and_an_example(self):
        for command in COMMANDS:
            for extent in ([], ["all"]):
                text = self.rholm(command, "--help", *extent).out
                self.assertEqual(text, self.rholm("help", command, *extent).out)
                self.assertIn(f"\nUsage: rholm {command} ", text)
                self.assertRegex(text, rf"\nExamples?:\n  rholm {command} ")
                for line in text.splitlines():
                    if not line.startswith("  rholm "):  # examples may be longer
                        self.assertLessEqual(len(line), 80, line)

    def every_command(self):
        listed = self.rholm("help").out.split("Commands:\n")[1].split("\n\n")[0]
        return [line.split()[0] for line in listed.splitlines()]

    def groups(self, *words):
        """Returns the options of a help text by the title of their group, in the order of the text."""
        text = self.rholm(*words).out
        groups = {}
        for title, entries in re.findall(r"^(\w[\w ]*):\n((?:  .*\n)+)", text, re.M):
            if not title.startswith("Example"):
                groups[title] = re.findall(r"^  (?:-\w, )?(--[\w-]+|[A-Z]+)", entries, re.M)
        return groups

    def test_the_first_screen_fits_for_the_common_commands(self):
        for command in ("info", "make", "expand", "synthesize", "spectrum", "compare", "convert", "render",
                        "reconstruct", "repair"):
            with self.subTest(command):
                self.assertLessEqual(len(self.rholm(command, "--help").out.splitlines()), 40)

    def test_help_all_has_every_option_once_and_the_groups_in_order(self):
        titles = ["Operands", "Data", "Accuracy", "Output", "Advanced", "Method of the paper"]
        completion = self.rholm("completion", "bash").out
        for command in self.every_command():
            with self.subTest(command):
                everything = self.groups(command, "--help", "all")
                self.assertEqual(list(everything), [title for title in titles if title in everything])
                options = [option for title, names in everything.items() if title != "Operands" for option in names]
                self.assertEqual(len(options), len(set(options)))
                offered = re.search(rf"^    {command}\)\n.*?_rholm_words '([^']*)'", completion, re.M)[1].split()
                self.assertEqual(set(options), {word for word in offered if word.startswith("--")} - {"--help"})
                # The first screen leaves out the last two groups, and says how many options they have.
                first = self.groups(command, "--help")
                self.assertEqual(first, {title: names for title, names in everything.items() if title in titles[:4]})
                more = len(options) - sum(len(names) for title, names in first.items() if title != "Operands")
                last = self.rholm(command, "--help").out.splitlines()[-1]
                self.assertEqual(last, f"rholm {command} --help all shows {more} more options.")

    def test_required_options_are_on_the_first_screen(self):
        for command in self.every_command():
            text = self.rholm(command, "--help").out
            usage = text.split("\nUsage: ")[1].split("\n\n")[0]
            for option in re.findall(r" (--?\w[\w-]*)", usage):
                self.assertRegex(text, rf"\n  {option}[ ,]", command)

    def test_the_reference_has_every_command_and_option(self):
        page = self.run_rholm("reference").out  # has the word NaN
        section = page.split("\n## Commands\n")[1].split("\n## ")[0]
        for command in self.every_command():
            part = section.split(f"\n### rholm {command}\n")[1].split("\n### ")[0]
            for title, names in self.groups(command, "--help", "all").items():
                for name in names:
                    self.assertEqual(len(re.findall(rf"^\|[^|]*\| `(?:-\w, )?{name}`", part, re.M)), 1, (command, name))

    def test_help_wins_over_wrong_options(self):
        self.rholm("expand", "--nonsense", "--help")

    def test_no_command_is_a_usage_error_that_shows_the_help(self):
        result = self.run_rholm()
        self.assertEqual(result.code, 2)
        self.assertIn("Commands:", result.err)
        self.assertEqual(result.out, "")


class WrongUsage(CliTest):
    def setUp(self):
        super().setUp()
        self.write("a.off", off(*OCTAHEDRON))

    def refused(self, *words, saying=None):
        before = self.files()
        result = self.rholm(*words, code=2)
        self.assertEqual(result.out, "")
        self.assertEqual(self.files(), before, "a refused command wrote a file")
        if saying:
            self.assertIn(saying, result.err)

    def test_unknown_words_are_named(self):
        self.refused("anlyze", saying="anlyze")
        self.refused("help", "anlyze", saying="anlyze")
        self.refused("--threads", "2", "info", "a.off", saying="command comes first")
        self.refused("info", "a.off", "--jsno", saying="--jsno")
        self.refused("info", "a.off", "b.off", saying="b.off")

    def test_what_may_have_been_meant_is_said(self):
        for words, meant in ((["expnad", "a.off"], "expand"), (["help", "recon"], "reconstruct"),
                             (["batch", "a.csv", "-o", "o.csv", "--command", "simplfy"], "simplify"),
                             (["expand", "a.off", "--degre", "8", "-o", "a.h5"], "--degree"),
                             (["expand", "--degre=8", "a.off", "-o", "a.h5"], "--degree"),
                             (["info", "a.off", "--jsno"], "--json"),
                             (["expand", "a.off", "--degree", "4", "-o", "a.h5", "--method",
                               "egde"], "edge")):
            with self.subTest(words):
                self.refused(*words, saying=f"did you mean '{meant}'?")
        # Words of other programs and versions are answered with the command or option of this one.
        for words, advice in ((["analyse", "a.off"], "'rholm expand' computes coefficients"),
                              (["encode", "a.off"], "'rholm expand' computes coefficients"),
                              (["help", "decimate"], "'rholm simplify' reduces"),
                              (["expand", "a.off", "--atlas", "--tolerance", "1", "-o", "a.h5"],
                               "'rholm compress' makes an atlas of caps"),
                              (["expand", "a.off", "--lmax=8", "-o", "a.h5"], "--degree")):
            with self.subTest(words):
                self.refused(*words, saying=f"; {advice}")
        for words, said in ((["expand", "a.off", "--degree"], "--degree needs a value, L"),
                            (["expand", "a.off", "--unit"], "--unit needs a value"),
                            (["expand", "a.off", "--degree", "3", "--degree=4"], "--degree is given twice"),
                            (["info", "a.off", "-o"], "there is no option '-o'"),
                            (["center", "a.off", "b.off"], "'b.off' is one operand too many")):
            with self.subTest(words):
                self.refused(*words, saying=said)
        for words in (["xylophone", "a.off"], ["info", "a.off", "--colour-of-sky"],
                      ["expand", "a.off", "-o", "a.h5", "--degree", "4", "--method", "magic"]):
            with self.subTest(words):
                result = self.rholm(*words, code=2)
                self.assertNotIn("did you mean", result.err)
        # A word after an option is its value, and numbers are not options.
        self.rholm("rotate", "--help")
        self.refused("expand", "a.off", "-o", "--degre", "--degree", "-1", saying="0 ... 16384")

    def test_missing_words_are_named(self):
        self.refused("info", saying="SHAPE")
        self.refused("expand", "a.off", "-o", "a.h5", saying="--degree")
        self.refused("expand", "a.off", "--degree", "4", saying="--output")
        self.refused("expand", "a.off", "-o", "a.h5", "--degree")

    def test_values_out_of_range_are_answered_with_the_limit(self):
        def expand(*words, saying):
            self.refused("expand", "a.off", "-o", "a.h5", *words, saying=saying)
        expand("--degree", "16385", saying="0 ... 16384")
        expand("--degree", "2000000000", saying="0 ... 16384")
        expand("--degree", "99999999999999999999", saying="--degree")
        expand("--degree", "-1", saying="0 ... 16384")
        expand("--degree", "four", saying="--degree")
        expand("--degree", "4", "--precision", "0", saying="1e-14")
        expand("--degree", "4", "--precision", "tiny", saying="--precision")
        expand("--degree", "4", "--method", "magic", saying="edge, gauge, curl, area")
        expand("--degree", "4", "--center", "left", saying="--center")
        expand("--degree", "4", "--center", "1,2", saying="--center")
        expand("--degree", "4", "--weld", "-1", saying="--weld")
        expand("--degree", "4", "--csphase", "0", saying="one of 1, -1")
        expand("--degree", "4", "--threads", "-2", saying="--threads")

    def test_a_value_that_is_not_a_number_is_refused_as_such(self):
        result = self.run_rholm("expand", "a.off", "-o", "a.h5", "--degree", "4", "--weld", "nan")
        self.assertEqual(result.code, 2, str(result))
        self.assertIn("finite number", result.err)

    def test_outputs_without_a_format_are_refused_before_any_work(self):
        for words in (["expand", "missing.off", "--degree", "4"], ["synthesize", "missing.h5"],
                      ["make", "sphere"], ["spectrum", "missing.h5"], ["render", "missing.off"],
                      ["report", "missing.off"], ["orient", "missing.xyz"], ["reconstruct", "missing.xyz"],
                      ["make", "sample", "missing.off"]):
            self.refused(*words, "-o", "out.xyzzy", saying="out.xyzzy")
            self.refused(*words, "-o", "-", saying="--format")
        for words in (["filter", "missing.h5", "--low-pass", "4"],
                      ["rotate", "missing.h5", "--mirror", "x"],
                      ["align", "missing.h5", "missing.h5"]):
            self.refused(*words, "-o", "out.xyzzy", saying="out.xyzzy")
            self.refused(*words, "-o", "-", saying="--format")
        self.refused("convert", "a.off", "out.xyzzy", saying="out.xyzzy")
        self.refused("convert", "a.off", "-", saying="--format")

    def test_report_and_data_cannot_share_standard_output(self):
        self.refused("expand", "a.off", "--degree", "4", "--format", "shtools", "-o", "-",
                     "--json", saying="--json")
        self.refused("expand", "a.off", "--degree", "4", "--format", "h5", "-o", "-",
                     saying="HDF5")

    def test_options_that_exclude_one_another_are_refused(self):
        self.refused("synthesize", "a.h5", "--grid", "9x18", "--subdivisions", "3", "-o", "o.ply",
                     saying="exclude")
        self.refused("synthesize", "a.h5", "--degree", "1,2", "--format", "ply", "-o", "-",
                     saying="several")
        self.refused("make", "box", "--amplitude", "0.1", "-o", "b.ply", saying="--amplitude")
        self.refused("render", "a.off", "--color", "error", "-o", "a.png", saying="--against")
        self.refused("filter", "a.h5", "-o", "b.h5", saying="--low-pass")
        self.refused("filter", "a.h5", "--low-pass", "4", "--band", "1,2", "-o", "b.h5",
                     saying="one of")
        self.refused("filter", "a.h5", "--low-pass", "4", "--time", "1", "-o", "b.h5",
                     saying="--window heat")
        self.refused("filter", "a.h5", "--high-pass", "4", "--sharpen", "1", "-o", "b.h5",
                     saying="--low-pass")
        self.refused("filter", "a.h5", "--low-pass", "4", "--window", "heat", "--time", "1", "-o",
                     "b.h5", saying="give one")
        self.refused("render", "a.off", "--against", "a.off", "-o", "a.png", saying="--color error")
        self.refused("render", "a.off", "--labels", "one,two", "-o", "a.png", saying="1 panels")
        self.refused("transfer", "--from", "-", "--to", "-", "--from-region", "ball:0,0,0,1",
                     "--to-region", "ball:0,0,0,1", "-o", "b.ply", saying="standard input")
        self.refused("compress", "a.off", "--tolerance", "1", "--max-degree", "25", "-o",
                     "a.h5", saying="2 ... 24")
        monte_carlo = ["expand", "a.off", "--method", "monte-carlo-edge", "--degree", "2",
                       "-o", "a.h5"]
        self.refused(*monte_carlo, "--engine", "fast", saying="direct")
        self.refused(*monte_carlo, "--samples", "100", "--deviation", "0.1", saying="--samples")
        self.refused("rotate", "a.h5", "-o", "b.h5", saying="--matrix")
        self.refused("rotate", "a.h5", "--axis", "0,0,1", "-o", "b.h5", saying="--angle")
        self.refused("rotate", "a.h5", "--mirror", "x", "--euler", "1,2,3", "-o", "b.h5",
                     saying="one of")
        self.refused("align", "-", "-", saying="standard input")
        self.refused("render", "a.off", "--size", "0x5", "-o", "a.png", saying="--size")
        self.refused("render", "a.off", "--view", "0,0,1", "--up", "0,0,-2", "-o", "a.png",
                     saying="--up")


class Failures(CliTest):
    def test_a_file_that_is_not_there_is_a_failure(self):
        for words in (["info", "none.ply"], ["center", "none.ply"], ["spectrum", "none.h5"],
                      ["expand", "none.ply", "--degree", "2", "-o", "o.h5"],
                      ["compare", "none.ply", "none.ply"], ["convert", "none.ply", "o.obj"],
                      ["render", "none.ply", "-o", "o.png"],
                      ["report", "none.ply", "-o", "o.html"],
                      ["orient", "none.ply", "-o", "o.ply"],
                      ["reconstruct", "none.ply", "-o", "o.ply"],
                      ["filter", "none.h5", "--low-pass", "4", "-o", "o.h5"],
                      ["rotate", "none.h5", "--mirror", "x", "-o", "o.h5"],
                      ["align", "none.h5", "none.h5"],
                      ["make", "sample", "none.ply", "-o", "o.ply"]):
            result = self.rholm(*words, code=1)
            self.assertIn("none.", result.err)
            self.assertEqual(self.files(), [])

    def test_an_output_that_cannot_be_written_is_a_failure(self):
        self.write("a.off", off(*OCTAHEDRON))
        (self.folder / "folder.ply").mkdir()
        for target in ("missing/out.ply", "folder.ply", "/proc/out.ply"):
            result = self.rholm("convert", "a.off", target, code=1)
            self.assertIn(target, result.err)
        self.assertEqual(self.files(), ["a.off", "folder.ply"])

    def test_a_full_disk_is_a_failure(self):
        for command in (["--help"], ["completion", "bash"],
                        ["make", "sphere", "--format", "ply", "-o", "-"]):
            code = os.spawnlp(os.P_WAIT, "sh", "sh", "-c",
                              '"$RHOLM" ' + " ".join(command) + " >/dev/full 2>/dev/null")
            self.assertEqual(code, 1, command)

    @unittest.skipIf("ASAN_OPTIONS" in os.environ, "AddressSanitizer needs all of address space")
    def test_memory_refused_is_a_failure(self):
        self.write("a.off", off(*OCTAHEDRON))
        # 2 (16384 + 1)^2 doubles are 4 GiB.
        limit = 2 << 30
        process = subprocess.run(
            [RHOLM, "expand", "a.off", "--degree", "16384", "--method", "gauge", "-o", "a.h5"],
            cwd=self.folder, capture_output=True, text=True,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(process.returncode, 1, process.stderr)
        self.assertIn("memory", process.stderr)
        self.assertEqual(self.files(), ["a.off"])

    def test_a_folder_is_not_a_shape(self):
        self.assertIn("directory", self.rholm("info", ".", code=1).err)


class Talk(CliTest):
    def test_names_of_the_version_before_are_understood(self):
        for line, name in (("align no.h5 no.h5 --method=correlation", "--start"), ("align no.h5 no.h5 --center own", "--centers"),
                           ("make sample no.ply --ratio 2 --pattern rings -o o.ply", "--pattern-ratio"),
                           ("make sample no.ply --axis 1,0,0 --pattern rings -o o.ply", "--pattern-axis"),
                           ("make sample no.ply --scans 2 --misalign 0.1 -o o.ply", "--misalignment"),
                           ("make sample no.ply --scans 2 --noise-per-scan 0.1 -o o.ply", "--scan-noise"),
                           ("orient no.ply --k 8 -o o.ply", "--neighbors"),
                           ("smooth no.ply --region ball:0,0,0,1 --wavelength 1 --fit=mean -o o.ply", "--fitting")):
            said = self.rholm(*line.split(), code=1).err
            self.assertIn(f" is {name} now; the next version refuses the old name", said)
            self.assertIn("no.", said.splitlines()[-1])  # the file is missing

    def test_analyze_is_two_commands_now(self):
        self.write("a.off", off(*OCTAHEDRON))
        words = ["a.off", "--degree", "4", "-o"]
        said = self.rholm("analyze", *words, "old.h5").err
        self.assertIn("analyze is expand now; the next version refuses the old name", said)
        self.assertNotIn("is expand now", self.rholm("analyze", *words, "old.h5", "--quiet").err)
        self.assertEqual(self.rholm("help", "analyze").out, self.rholm("help", "expand").out)
        said = self.rholm("analyze", "none.off", "--atlas", "--tolerance", "1", "-o", "o.h5", code=1).err
        self.assertIn("analyze --atlas is compress now", said)
        self.assertIn("none.off", said.splitlines()[-1])
        self.write("list.csv", "path\na.off\n")
        for command in (["--command", "analyze"], ["--command=analyze"]):
            said = self.rholm("batch", "list.csv", *command, "--restart", "-o", "o.csv", "--", "--degree", "2").err
            self.assertIn("analyze is expand now", said)
        for command in ([], ["--command", "analyze"], ["--command=analyze"]):
            said = self.rholm("batch", "list.csv", *command, "--restart", "-o", "o.csv", "--", "--atlas", "--tolerance", "1").err
            self.assertIn("analyze --atlas is compress now", said)
        self.assertIn("spectrum", self.rholm("spectrum", "old.h5", "--help").out)

    def test_quiet_says_nothing(self):
        self.rholm("make", "sphere", "--subdivisions", "2", "-o", "s.ply")
        result = self.rholm("expand", "s.ply", "--degree", "2", "-o", "s.h5", "--quiet")
        self.assertEqual(result.out + result.err, "")

    def test_no_escape_sequences_without_a_terminal(self):
        self.assertNotIn("\x1b", self.rholm("info", "none.ply", code=1).err)

    def on_terminal(self, *words, environment=None, **reading):
        terminal = Terminal([RHOLM, *words], self.folder, environment or {})
        try:
            return terminal.read_raw(**reading)
        finally:
            terminal.close()

    def test_colours_on_a_terminal_unless_told_otherwise(self):
        self.assertIn("\x1b[", self.on_terminal("info", "none.ply"))
        for environment in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
            self.assertNotIn("\x1b", self.on_terminal("info", "none.ply", environment=environment))

    def test_progress_on_a_terminal_unless_told_otherwise(self):
        self.rholm("make", "box", "-o", "b.off")
        words = ["expand", "b.off", "--degree", "700", "--engine", "direct", "-o", "b.h5"]
        self.assertRegex(self.on_terminal(*words, wanted=[" %"]), r"\w+ +\[#* *\] +\d+ %")
        quiet = self.on_terminal(*words, "--quiet", wanted=[" %"], seconds=1.5)
        self.assertEqual(quiet, "")


if __name__ == "__main__":
    main()
