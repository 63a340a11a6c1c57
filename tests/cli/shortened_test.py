"""An input that another program shortens while it is mapped."""

import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness import CliTest, TIMEOUT, main


class Shortened(CliTest):
    def test_is_told_from_a_crash_and_leaves_no_litter(self):
        # The file has 1.4 MB: its last page lies far beyond the remaining part.
        self.rholm("make", "sphere", "--subdivisions", "6", "-o", "s.ply")
        self.write("out.txt", b"what was here before\n")
        process = subprocess.run([os.environ["SHORTENED_FILE"], "s.ply", "out.txt"],
                                 cwd=self.folder, capture_output=True, timeout=TIMEOUT)
        self.assertEqual(process.returncode, 3, process)
        self.assertIn(b"the file was shortened while it was read", process.stderr)
        self.assertEqual(process.stdout, b"")
        self.assertEqual(self.files(), ["out.txt", "s.ply"])
        self.assertEqual((self.folder / "out.txt").read_bytes(), b"what was here before\n")


if __name__ == "__main__":
    main()
