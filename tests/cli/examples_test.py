"""Commands in documents and help texts work unchanged.

Runs every ```sh block of README.md and docs/*.md; all blocks of a document run in one folder. Blocks of
docs/start.md are run by python/tests/test_guides.py, together with the code between them. Also runs the
examples of every --help. Blocks that install, build or run scripts/ need a fresh machine or a clone of the
project; they are recognised by the words below and left out."""

import os
import re
import signal
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, RHOLM, SOURCE, TIMEOUT, main

NOT_HERE = ("scripts/", "cmake ", "git ", "ninja", "ctest", "sudo ", "man rholm", "python3 -m venv", "pip install", "apt ", "rholm studio")


class Examples(CliTest):
    def setUp(self):
        super().setUp()
        self.environment = {**os.environ, "PATH": os.path.dirname(os.path.abspath(RHOLM)) + ":" +
                            os.environ["PATH"]}

    def shell(self, text, where):
        process = subprocess.run(["bash", "-eu", "-o", "pipefail", "-c", text], cwd=self.folder,
                                 env=self.environment, capture_output=True, text=True,
                                 timeout=TIMEOUT, stdin=subprocess.DEVNULL)
        self.assertEqual(process.returncode, 0, f"{where}:\n{text}\n{process.stderr}")

    def test_documents(self):
        ran = 0
        for document in [SOURCE / "README.md", *sorted((SOURCE / "docs").glob("*.md"))]:
            if not document.exists() or document.name == "start.md":
                continue
            for path in self.folder.iterdir():
                path.unlink()
            self.shell("rholm make bumpy --quiet --subdivisions 4 -o shape.ply", "preparation")
            for block in re.findall(r"^```sh\n(.*?)^```", document.read_text(), re.M | re.S):
                if not any(word in block for word in NOT_HERE):
                    with self.subTest(f"{document.name}: {block.splitlines()[0]}"):
                        self.shell(block, document.name)
                        ran += 1
        self.assertGreater(ran, 0, "no document has an example")

    def test_help_texts(self):
        # Examples of one command may use files that earlier examples made.
        listed = self.rholm("help").out.split("Commands:\n")[1].split("\n\n")[0]
        self.write("shapes.csv", "path\nbumpy.ply\nellipsoid.ply\n")  # for batch
        first = ["make", "info", "center", "expand", "synthesize"]
        commands = [line.split()[0] for line in listed.splitlines()]
        self.assertLessEqual(set(first), set(commands))
        for command in first + [name for name in commands if name not in first]:
            text = self.rholm(command, "--help").out
            for line in re.findall(r"^  (rholm .*)", re.split(r"\nExamples?:\n", text)[1], re.M):
                with self.subTest(line):
                    if command == "studio":
                        self.start_and_end(line)
                    else:
                        self.shell(line, command)
            if command == "make":  # fewer faces and points are enough for the others
                self.shell("rholm make bumpy --subdivisions 4 -o bumpy.ply --quiet\n"
                           "rholm make sample bumpy.ply --points 3000 -o points.ply --quiet", "preparation")

    def start_and_end(self, line):
        """Runs a command that continues until it is told to end."""
        process = subprocess.Popen([*line.split(), "--no-open"], cwd=self.folder, env=self.environment,
                                   stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        self.assertIn("http://127.0.0.1:", process.stderr.readline(), line)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(TIMEOUT), 0, line)


if __name__ == "__main__":
    main()
