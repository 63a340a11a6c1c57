"""Completions of rholm-mpi in real shells, and its manual page. No ranks are needed for these tests."""

import re
import shutil
import subprocess
import sys
import os
import unittest

sys.path.insert(0, os.path.dirname(__file__))
from harness_mpi import MpiTest, RHOLM_MPI, main

CASES = (("rholm-mpi exp", "expand"), ("rholm-mpi expand --deg", "--degree"), ("rholm-mpi compare --pa", "--patience"))


def needs(program):
    return unittest.skipIf(shutil.which(program) is None, f"{program} is not installed")


class ShellFiles(MpiTest):
    def text(self, *words):
        return subprocess.run([RHOLM_MPI, *words], check=True, capture_output=True, text=True).stdout

    def script(self, shell):
        path = self.folder / f"rholm-mpi.{shell}"
        path.write_text(self.text("completion", shell))
        return path

    def run_in(self, shell, *words):
        return subprocess.run([shell, *words], cwd=self.folder, capture_output=True, text=True)

    @needs("bash")
    def test_bash(self):
        script = self.script("bash")
        for typed, wanted in CASES:
            words = typed.split(" ")
            run = self.run_in("bash", "--norc", "-c",
                              f". {script}; COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; "
                              "_rholm_mpi; echo ${COMPREPLY[@]}; complete -p rholm-mpi")
            self.assertIn(wanted, run.stdout.split(), run)
            self.assertIn("-F _rholm_mpi rholm-mpi", run.stdout)

    @needs("zsh")
    def test_zsh(self):
        script = self.script("zsh")
        self.assertTrue(script.read_text().startswith("#compdef rholm-mpi\n"))
        run = self.run_in("zsh", "-f", "-c", f"autoload -U compinit; compinit -u -D; . {script}; "
                          "echo $_comps[rholm-mpi] $+functions[_rholm_mpi]")
        self.assertEqual(run.stdout.split(), ["_rholm_mpi", "1"], run)

    @needs("fish")
    def test_fish(self):
        script = self.script("fish")
        for typed, wanted in CASES:
            run = self.run_in("fish", "--no-config", "-c", f"source {script}; complete -C '{typed}'")
            self.assertIn(wanted, [line.split("\t")[0] for line in run.stdout.splitlines()], run)

    def test_every_command_and_option_is_offered(self):
        scripts = {shell: self.script(shell).read_text() for shell in ("bash", "zsh", "fish")}
        for command in ("expand", "batch", "compare", "completion"):
            run = self.finished(RHOLM_MPI, command, "--help", "all", ranks=1)
            self.assertEqual(run.code, 0, run)
            options = re.findall(r"^  (?:-\w, )?--([\w-]+)", run.stdout, re.M)
            self.assertIn("threads", options)
            for option in options:
                self.assertIn(f"--{option}", scripts["bash"])
                self.assertIn(f"--{option}", scripts["zsh"])
                self.assertIn(f"-l {option}", scripts["fish"])
        for text in scripts.values():
            self.assertNotIn("@", text.replace("$@", "").replace("[@]", ""))

    @needs("mandoc")
    def test_the_manual_page_is_clean(self):
        path = self.folder / "rholm-mpi.1"
        path.write_text(self.text("man-page", "--date", "2000-01-01"))
        lint = self.run_in("mandoc", "-Tlint", "-Wwarning", str(path))
        self.assertEqual(lint.stdout + lint.stderr, "")
        text = re.sub(".\b", "", self.run_in("mandoc", "-Tutf8", str(path)).stdout)
        for words in ("rholm-mpi expand", "rholm-mpi compare", "--patience", "EXIT STATUS"):
            self.assertIn(words, text)


if __name__ == "__main__":
    main()
