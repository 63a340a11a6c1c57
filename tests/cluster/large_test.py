"""Sends one message of more than 2^31 bytes, whose length exceeds MPI's counts."""

import os
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness_mpi import MpiTest, main


class Large(MpiTest):
    def test_more_bytes_than_an_int_counts(self):
        run = self.finished(os.environ["RANKS_PROGRAM"], "large", ranks=2, seconds=600)
        self.assertEqual(run.code, 0, run)


if __name__ == "__main__":
    main()
