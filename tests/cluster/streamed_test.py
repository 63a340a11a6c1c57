"""rholm-mpi analyze of a mesh with more than eight million triangles, whose parts are spread one after the
other."""

import os
import sys

sys.path.insert(0, os.path.dirname(__file__))
from analyze_test import Analyze, main


class Streamed(Analyze):
    every_way = True

    def test_the_bytes_are_those_of_one_process(self):
        self.make("mesh.ply", "box", "--size", "3,2,1", "--cells", 850)
        self.check_same("mesh.ply", "--degree", 200, ranks=(2, 3, 4), threads=(1, 2))


if __name__ == "__main__":
    main()
