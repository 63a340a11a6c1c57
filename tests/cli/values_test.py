"""Every option of every command, taken from the program's own description, with impossible values: exit
code 2, and a message with the option and the value, before any file is opened."""

import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import NIGHTLY, CliTest, RHOLM, STUDIO, main, nightly_too

# Other words that a command needs. The files do not exist: an accepted value ends with exit code 1, a
# refused one with 2.
NEEDS = {
    "info": ["none.ply"], "center": ["none.ply"],
    "expand": ["none.ply", "-o", "out.h5"],
    "compress": ["none.ply", "--tolerance", "1", "-o", "out.h5"],
    "synthesize": ["none.h5", "-o", "out.ply"], "spectrum": ["none.h5"],
    "compare": ["none.ply", "none.h5"], "convert": ["none.ply", "out.obj"],
    "render": ["none.ply", "-o", "out.png"], "report": ["none.ply", "-o", "out.html"],
    "make": ["sample", "none.ply", "-o", "out.ply"],
    "filter": ["none.h5", "-o", "out.h5"], "rotate": ["none.h5", "-o", "out.h5"],
    "align": ["none.h5", "none.h5"],
    "smooth": ["none.ply", "--region", "ball:0,0,0,1", "--wavelength", "1", "-o", "out.ply"],
    "transfer": ["--from", "none.ply", "--from-region", "ball:0,0,0,1", "--to", "none.ply",
                 "--to-region", "ball:0,0,0,1", "-o", "out.ply"],
    "orient": ["none.xyz", "-o", "out.ply"], "partition": ["none.ply", "-o", "out.ply"],
    "reconstruct": ["none.xyz", "-o", "out.ply"],
    "repair": ["none.ply", "-o", "out.ply"], "simplify": ["none.ply", "-o", "out.ply"],
    "batch": ["none.csv", "--command", "info", "-o", "out.csv"],
    "recenter": ["none.h5", "-o", "out.h5"], "completion": ["bash"],
}

# Options whose values are words of the user's choice: names of files, units, labels.
FREE = {"output", "against", "like", "shape", "from", "to", "gain", "model", "labels",
        "length-unit", "outputs", "page", "work-dir"}

BAD = ["", "text", "nan", "-inf", "1e400", "1,2,3,4,5,6,7,8,9,10,11,12,"]

# One value beyond each limit that the help texts state.
BEYOND = {
    "threads": ["-1", "4097"], "seed": ["-1", "99999999999999999999"], "weld": ["-1e-9"],
    "expand --degree": ["-1", "16385", "1.5", "0x10"], "report --degree": ["-1", "16385"],
    "synthesize --degree": ["-1", "4,16385", "4,,5"], "tolerance": ["0", "-1"],
    "reconstruct --tolerance": ["-1", "1.1"], "tile-points": ["999", "268435457"],
    "max-degree": ["-1", "16385"], "compress --degree": ["-1", "25"], "precision": ["0", "1"], "rays": ["-1", "1e3"],
    "samples": ["0", "-1"], "deviation": ["0", "2"], "most-samples": ["1"],
    "center": ["1,2", "1,2,nan"], "length-unit": ["x" * 300, "a\nb", " km", "\udcff"],
    "subdivisions": ["-1", "13"], "grid": ["0x9", "9x2", "9", "32768x32768"],
    "resolution": ["0", "-1"], "degree-limit": ["-1", "25"],
    "simplify": ["0", "3", "0%", "101%", "-5"], "threshold": ["0", "-1"],
    "render --size": ["15x100", "100x99999"], "view": ["0,0,0"], "up": ["0,0,0", "1,2"],
    "scale-max": ["0", "-1"], "report --size": ["15", "4097"],
    "make --size": ["0,1,1", "1,1", "-1,1,1"], "axes": ["3,2,0", "1,1,-1"],
    "cells": ["0", "4097"], "radii": ["0.4,1", "1,1", "1,0", "1"],
    "segments": ["2x3", "9", "16384x16385"], "amplitude": ["1", "-0.1"],
    "translate": ["1,2"], "points": ["0", "-1"], "make --noise": ["-0.1", "1.1"],
    "normal-noise": ["-1", "181"], "outliers": ["-0.1", "1.1"],
    "make --holes": ["1.5,0.1", "1001,0.1", "1,2", "-1,0.1"], "density-ratio": ["0.5"],
    "low-pass": ["-1", "16385"], "high-pass": ["0"], "band": ["5,4", "5", "1,2,3", "-1,4"],
    "order": ["0", "65"], "time": ["0", "-1"], "sharpen": ["-1.1"],
    "axis": ["0,0,0", "1,2"], "angle": ["1e7"], "euler": ["1,2"],
    "matrix": ["1,0,0,0,1,0,0,0,2", "1,0,0,0,1,0,0,0,-1", "1,2,3"], "about": ["centre", "1,2"],
    "bandwidth": ["0", "65"], "margin": ["-1", "3"],
    "region": ["ball:0,0,0,0", "ball:0,0,0,-1", "ball:1", "vertex:-1,1", "color:12345",
               "vertex:0,0", "property:"],
    "wavelength": ["0", "-1"], "strength": ["-11", "1.1"], "transition": ["-1"],
    "from-degree": ["1", "65"], "scale": ["0", "1e7"], "neighbors": ["2", "10001"],
    "sensor": ["1,2"], "min-cosine": ["-0.1", "1.1"], "reconstruct --noise": ["1.1", "-0.1"],
    "reconstruct --resolution": ["3", "65537"], "min-component": ["-0.1", "1.1"],
    "max-memory": ["0"], "max-numbers": ["-1"],
    "max-hole": ["-1", "501"], "simplify --faces": ["0", "3", "0%", "101%", "none"],
    "max-error": ["-1"], "shard": ["0/2", "3/2", "1/2/3", "1/0"],
    "columns": ["x,y", "x,y,z,x", "x,y,z,nx"],
}

if STUDIO:
    NEEDS["studio"] = ["none.ply", "--no-open"]
    BEYOND |= {"port": ["0", "65536"], "max-upload": ["0", "-1"]}


def described_options():
    """Returns {(command, option): True if its values are a list of words} for options with a value, as the
    program describes them to fish."""
    text = subprocess.run([RHOLM, "completion", "fish"], capture_output=True, text=True,
                          check=True).stdout
    found = {}
    for line in text.splitlines():
        command = re.search(r"__fish_seen_subcommand_from ([a-z-]+)'", line)
        option = re.search(r" -l ([a-z-]+)", line)
        if command and option and re.search(r" -(r|x|ra|xa)\b", line):
            found[command[1], option[1]] = bool(re.search(r" -x -a '", line))
    return found


class Values(CliTest):
    def refused(self, command, option, value):
        """Checks for exit code 2 with one message that has the option and the value."""
        needed = list(NEEDS[command])
        if f"--{option}" in needed:
            at = needed.index(f"--{option}")
            del needed[at:at + 2]
        elif option == "output" and "-o" in needed:
            del needed[needed.index("-o"):]
        result = self.run_rholm(command, *needed, f"--{option}", value)
        words = [command, option, value]
        said = f"{words}: {result.code}: {result.err}"
        self.assertEqual(result.code, 2, said)
        first = result.err.splitlines()[0]
        self.assertTrue(first.startswith("rholm: error:"), said)
        self.assertIn(f"--{option} is ", first, said)
        if value and "\n" not in value and len(value) < 100 and value.isprintable():
            self.assertIn(f"'{value}'", first, said)
        self.assertEqual(self.files(), [], said)

    def test_the_program_describes_its_options(self):
        options = described_options()
        self.assertGreater(len(options), 150)
        self.assertEqual({command for command, _ in options}, set(NEEDS))

    @nightly_too
    def test_a_value_that_is_no_value(self):
        for k, ((command, option), is_word) in enumerate(described_options().items()):
            if option == "threads" and command != "info":
                continue  # tested once for all commands
            # Each option is tested without a value and with a word. Numbers, which are read in one place,
            # get others in turn.
            values = BAD[:2] if is_word else [*BAD[:2], BAD[2 + k // 3 % (len(BAD) - 2)]]
            for value in values if NIGHTLY else [values[k % len(values)]]:
                if value and option in FREE:
                    continue
                with self.subTest(command=command, option=option, value=value):
                    self.refused(command, option, value)

    def test_values_beyond_the_limits(self):
        tried = set()
        for command, option in described_options():
            for value in BEYOND.get(f"{command} --{option}", BEYOND.get(option, [])):
                tried.add(option)
                with self.subTest(command=command, option=option, value=value):
                    self.refused(command, option, value)
        for key in BEYOND:
            self.assertIn(key.split("--")[-1], tried, "an option that is not there any more")

    def test_operands_that_are_empty(self):
        for command in ("info", "center", "spectrum"):
            result = self.rholm(command, "", code=2)
            self.assertIn("is empty", result.err)


if __name__ == "__main__":
    main()
