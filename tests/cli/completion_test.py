"""Completions in real shells, and the manual page, as they are installed."""

import os
import re
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, RHOLM, Terminal, main

CASES = [  # typed text, and text that the shell must add or offer
    ("rholm exp", ["expand"]),
    ("rholm expand --m", ["--method"]),
    ("rholm expand --method ", ["edge", "gauge", "curl", "area"]),
    ("rholm make ", ["sphere", "ellipsoid", "box", "torus", "bumpy"]),
    ("rholm info mod", ["model.h5"]),
]


def needs(shell):
    return unittest.skipIf(shutil.which(shell) is None, f"{shell} is not installed")


class Completion(CliTest):
    def setUp(self):
        super().setUp()
        self.write("model.h5", "")
        bin_folder = os.path.dirname(os.path.abspath(RHOLM))
        self.environment = {"PATH": bin_folder + ":" + os.environ["PATH"],
                            "HOME": str(self.folder), "PS1": "$ ", "HISTFILE": ""}

    def script(self, shell, name):
        return self.write(name, self.rholm("completion", shell).bytes)

    def check_on_terminal(self, words, prepare):
        """Types each case and two tabs; the completion or a list with it must appear."""
        for typed, wanted in CASES:
            with self.subTest(typed):
                terminal = Terminal(words, self.folder, self.environment)
                try:
                    terminal.send(prepare + "; echo rea''dy\n")
                    self.assertIn("ready", terminal.read(["ready\r\n"]))
                    terminal.send(typed + "\t\t")
                    text = terminal.read(wanted)
                    for word in wanted:
                        self.assertIn(word, text)
                finally:
                    terminal.close()

    @needs("bash")
    def test_bash(self):
        script = self.script("bash", "rholm.bash")
        subprocess.run(["bash", "-n", script], check=True)
        self.check_on_terminal(["bash", "--norc", "--noprofile", "-i"],
                               "bind 'set bell-style none'; . ./rholm.bash")

    @needs("zsh")
    def test_zsh(self):
        (self.folder / "functions").mkdir()
        self.script("zsh", "functions/_rholm")
        self.check_on_terminal(["zsh", "-f", "-i"],
                               "fpath=($PWD/functions $fpath); autoload -U compinit; "
                               "compinit -u -D; zstyle ':completion:*' menu no")

    @needs("fish")
    def test_fish(self):
        script = self.script("fish", "rholm.fish")
        for typed, wanted in CASES:
            with self.subTest(typed):
                process = subprocess.run(
                    ["fish", "--no-config", "-c", f"source {script}; complete -C '{typed}'"],
                    capture_output=True, text=True, cwd=self.folder,
                    env={**os.environ, **self.environment}, check=True)
                offered = [line.split("\t")[0] for line in process.stdout.splitlines()]
                for word in wanted:
                    self.assertIn(word, offered, process.stdout + process.stderr)

    def test_every_command_and_option_is_offered(self):
        scripts = {shell: self.rholm("completion", shell).out for shell in ("bash", "zsh", "fish")}
        commands = re.findall(r"^  (\w+) +\w", self.rholm("help").out.split("Commands:")[1]
                              .split("\n\n")[0], re.M)
        self.assertGreaterEqual(len(commands), 9)
        for command in commands:
            for option in re.findall(r"^  (?:-\w, )?--([\w-]+)", self.rholm(command, "--help", "all").out,
                                     re.M):
                self.assertIn(f"--{option}", scripts["bash"])
                self.assertIn(f"--{option}", scripts["zsh"])
                self.assertIn(f"-l {option}", scripts["fish"])


class ManualPage(CliTest):
    @needs("mandoc")
    def test_is_clean(self):
        page = self.write("rholm.1", self.rholm("man-page", "--date", "2000-01-01").bytes)
        lint = subprocess.run(["mandoc", "-Tlint", "-Wwarning", page], capture_output=True,
                              text=True)
        self.assertEqual(lint.stdout + lint.stderr, "")
        text = subprocess.run(["mandoc", "-Tutf8", page], capture_output=True, text=True).stdout
        text = re.sub(".\b", "", text)
        for words in ("rholm expand", "--precision", "EXIT STATUS", "NO_COLOR"):
            self.assertIn(words, text)


if __name__ == "__main__":
    main()
