"""Tests the figures, the temporary files and the refusals of bench/rholm_bench."""

import os
import re
import signal
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "cli"))
from harness import CliTest, OCTAHEDRON, Result, TIMEOUT, main, off, until, until_working

BENCH = os.environ["RHOLM_BENCH"]

QUICK = ["--degree", "16", "--repeat", "2"]


class Bench(CliTest):
    NAME = "rholm_bench"

    def setUp(self):
        super().setUp()
        self.temporary = self.folder / "temporary"
        self.temporary.mkdir()
        self.environment = {"TMPDIR": str(self.temporary)}

    def bench(self, *words, code=0, environment=None):
        process = subprocess.run([BENCH, *words], capture_output=True, cwd=self.folder, timeout=TIMEOUT,
                                 env={**os.environ, **(environment or self.environment)})
        result = Result(process, words, self.NAME)
        self.assertEqual(result.code, code, result)
        self.check_decent(result)
        self.assertEqual(list(self.temporary.iterdir()), [], "litter was left")
        return result

    def report(self, *words):
        return self.bench(*words, "--json").json()

    def test_every_mesh_degree_and_precision_is_a_case(self):
        self.rholm("make", "bumpy", "--subdivisions", "3", "-o", "b.ply")
        report = self.report("b.ply", "--faces", "1200", "--degree", "8,16", "--precision",
                             "1e-3,1e-6", "--repeat", "1")
        found = [(c["mesh"], c["counts"]["faces"], c["degree"], c["precision"])
                 for c in report["cases"]]
        self.assertEqual(found, [(mesh, faces, degree, precision)
                                 for mesh, faces in (("smooth body", 1200), ("b.ply", 1280))
                                 for degree in (8, 16) for precision in (1e-3, 1e-6)])
        for case in report["cases"]:
            # --precision promises these bounds.
            self.assertLessEqual(case["accuracy"]["error"], case["precision"])
            self.assertLessEqual(case["accuracy"]["error_of_mean"], case["precision"])
            self.assertIn("direct", case["accuracy"]["reference"])

    def test_the_instruction_set_is_the_one_that_was_forced(self):
        machine = self.report("--faces", "2000", *QUICK)["machine"]
        self.assertEqual(machine["vector_instructions"],
                         os.environ.get("RHOLM_TEST_TARGET", machine["vector_instructions"]))

    def test_figures_are_of_one_run_and_per_face(self):
        case, = self.report("--faces", "5000", *QUICK)["cases"]
        stages = case["runs"][0]["stages"]
        self.assertEqual(case["runs"][0]["threads"], 1)
        for name in ("coefficients", "read", "faces", "spread", "fourier", "norms", "write"):
            stage = stages[name]
            self.assertLessEqual(stage["least_cpu_seconds"], stage["cpu_seconds"])
            self.assertAlmostEqual(stage["cpu_ns_per_face"] * case["counts"]["faces"],
                                   1e9 * stage["cpu_seconds"], delta=1)
        for name in ("adjoint", "adjoint_with_gradient", "forward_with_gradient", "direct"):
            self.assertGreater(case["sums"][name]["cpu_seconds"], 0)
        for name in ("file_read", "copy"):
            self.assertGreater(case["floors"][name]["gigabytes_per_second"], 0)
        for name in ("row_updates", "legendre"):
            self.assertGreater(case["floors"][name]["cpu_seconds"], 0)
        self.assertGreater(case["ratios"]["direct_to_fast"], 0)

    def test_thread_counts_and_random_order(self):
        ordered, shuffled = self.report("--faces", "5000", "--shuffle", "--thread-counts", "1,2",
                                        *QUICK)["cases"]
        self.assertEqual((ordered["order"], shuffled["order"]), ("file", "random"))
        self.assertEqual([run["threads"] for run in ordered["runs"]], [1, 2])
        self.assertEqual(ordered["runs"][0]["speedup"], 1)
        self.assertGreater(shuffled["ratios"]["random_to_file_order"], 0)
        # The triangles are the same: their order changes rounding errors only.
        self.assertEqual(ordered["counts"]["faces"], shuffled["counts"]["faces"])
        self.assertLessEqual(shuffled["accuracy"]["error"], shuffled["precision"])

    def test_the_text_has_a_table(self):
        text = self.bench("--faces", "5000", *QUICK).out
        for word in ("bytes to coefficients", "faces", "spread", "row updates alone", "GB/s",
                     "ns/face", "measured against direct sums"):
            self.assertIn(word, text)
        text = self.bench("--faces", "2000", "--shuffle", "--thread-counts", "1,2", *QUICK).out
        self.assertEqual(text.count("times as fast"), 2)
        self.assertEqual(text.count("times the time of the file's order"), 1)

    def test_a_mesh_that_lies_as_text_is_read(self):
        self.rholm("make", "bumpy", "--subdivisions", "3", "-o", "b.obj")
        case, = self.report("b.obj", *QUICK)["cases"]
        self.assertEqual(case["counts"]["faces"], 1280)
        self.assertLessEqual(case["accuracy"]["error"], case["precision"])

    def test_wrong_meshes_are_refused(self):
        self.write("open.off", off(OCTAHEDRON[0], OCTAHEDRON[1][1:]))
        self.write("broken.ply", "ply\nformat ascii 1.0\n")
        self.rholm("make", "torus", "-o", "torus.ply")
        for shape in ("open.off", "broken.ply", "torus.ply"):
            self.assertEqual(self.bench(shape, *QUICK, code=3).out, "")
        self.bench("missing.ply", *QUICK, code=1)

    def test_a_surface_that_is_not_star_shaped_needs_to_be_wanted(self):
        self.rholm("make", "torus", "-o", "torus.ply")
        case, = self.report("torus.ply", "--signed", *QUICK)["cases"]
        self.assertLessEqual(case["accuracy"]["error"], case["precision"])

    def test_wrong_words_are_refused(self):
        for words in (["--faces", "11"], ["--faces", "1e9"], ["--faces", "many"], ["--faces", "82000,0"],
                      ["--degree", "-1"], ["--precision", "1"], ["--precision", "1e-6,0"],
                      ["--repeat", "0"], ["--repeat", "1001"], ["--thread-counts", "0"],
                      ["--thread-counts", "1,4097"], ["--no-such-option"], ["-"], [""]):
            self.assertIn("Try 'rholm_bench --help'.", self.bench(*words, code=2).err)

    def test_the_examples_of_its_help_work(self):
        self.rholm("make", "bumpy", "--subdivisions", "3", "-o", "bumpy.ply")
        text = self.bench("--help").out
        self.assertIn("Usage: rholm_bench [SHAPE...] [options]", text)
        for line in re.findall(r"^  (\w+ .*)", text.split("\nExamples:\n")[1], re.M):
            name, *words = line.split()
            self.assertEqual(name, self.NAME)
            self.assertIn("direct sums", self.bench(*words).out)

    def test_without_a_folder_for_temporary_files_it_fails(self):
        for folder in ("/proc", str(self.folder / "missing")):
            result = self.bench("--faces", "1200", *QUICK, code=1,
                                environment={"TMPDIR": folder})
            self.assertIn("TMPDIR", result.err)

    def test_interrupted_it_leaves_nothing(self):
        process = subprocess.Popen(
            [BENCH, "--faces", "300000", "--degree", "200", "--repeat", "1000"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            env={**os.environ, **self.environment},
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        until(lambda: any(self.temporary.iterdir()), "it has temporary files", process)
        until_working(process)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=TIMEOUT)
        self.assertEqual(process.returncode, 130, err)
        self.assertEqual(out, b"")
        self.assertEqual(list(self.temporary.iterdir()), [])


if __name__ == "__main__":
    main()
