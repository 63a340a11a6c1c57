"""The layer cluster on 1 ... 4 ranks: messages, parts, and how runs end."""

import os
import signal
import sys

sys.path.insert(0, os.path.dirname(__file__))
from harness_mpi import MpiTest, RANKS, main

PROGRAM = os.environ.get("RANKS_PROGRAM", "ranks_program")


class Ranks(MpiTest):
    def case(self, *words, ranks, code=0, graceful=True):
        for left in self.folder.iterdir():
            left.unlink()
        run = self.finished(PROGRAM, *words, ranks=ranks)
        what = f"{words} on {ranks} ranks: {run}"
        errors = [line for line in run.stderr.splitlines() if line.startswith("error: ")]
        if code == 0:
            self.assertEqual(run.code, 0, what)
            self.assertEqual(errors, [], what)
        else:
            self.assertNotEqual(run.code, 0, what)
            self.assertEqual(len(errors), 1, what)
        if graceful:  # every rank has ended by itself with that code
            codes = {p.name: p.read_text() for p in self.folder.glob("code.*")}
            self.assertEqual(codes, {f"code.{i}": str(code) for i in range(ranks)}, what)
        return run, errors

    def test_messages_arrive_parts_are_worked_and_ranks_without_work_end_with_rank_0(self):
        # Ranks are started once for all cases. Errors name the failed check; each case prints its name at
        # its start.
        cases = ("collect", "order", "parts", "ordered", "stages", "leaves")
        for ranks in RANKS:
            run, _ = self.case(",".join(cases), ranks=ranks)
            self.assertEqual(run.stdout.splitlines(), [*cases, f"{ranks} ranks"])

    def test_a_rank_that_throws_ends_all_with_its_code_and_one_message(self):
        for ranks in RANKS:
            for chosen in {0, ranks - 1}:
                _, errors = self.case("throws", chosen, ranks=ranks, code=3)
                self.assertRegex(errors[0], rf"^error: rank {chosen} on \S+: a bad file; go on so$")

    def test_of_ranks_that_throw_at_once_one_speaks(self):
        for ranks in RANKS:
            _, errors = self.case("throws-at-once", ranks=ranks, code=3)
            self.assertRegex(errors[0], r"^error: rank (\d).*: bad file \1; go on so$")

    def test_results_that_cannot_be_kept_end_the_run(self):
        for ranks in RANKS:
            _, errors = self.case("does-not-take", ranks=ranks, code=1)
            self.assertRegex(errors[0], r"^error: rank 0 on \S+: the disk is full; go on so$")

    def test_a_part_without_progress_ends_the_run(self):
        def check(ranks, chosen):
            _, errors = self.case("stuck", chosen, ranks=ranks, code=1, graceful=False)
            self.assertRegex(errors[0], rf"^error: rank {chosen} on \S+: has made no progress for 3 s "
                                        r"\(--patience\), and is ended; go on so$")

        self.at_once(check, (1, 0), (3, 0), (3, 2))


class Signals(MpiTest):
    def started(self, ranks):
        for left in self.folder.iterdir():
            left.unlink()
        run = self.start(PROGRAM, "slow", ranks=ranks)
        run.until(lambda: len(list(self.folder.glob("works.*"))) == ranks, "all ranks work")
        return run, [int((self.folder / f"works.{i}").read_text()) for i in range(ranks)]

    def check_ended(self, run):
        """wait() has checked that no rank is left."""
        run.wait()
        self.assertNotEqual(run.code, 0, run)

    def test_a_rank_that_is_killed_ends_the_run(self):
        def check(ranks, killed):
            run, pids = self.started(ranks)
            os.kill(pids[killed], signal.SIGKILL)
            self.check_ended(run)

        self.at_once(check, (1, 0), (2, 1), (4, 0), (4, 3))

    def test_a_rank_that_is_stopped_ends_the_run(self):
        def check(ranks, stopped):
            run, pids = self.started(ranks)
            os.kill(pids[stopped], signal.SIGSTOP)
            self.check_ended(run)
            errors = [line for line in run.stderr.splitlines() if line.startswith("error: ")]
            self.assertEqual(len(errors), 1, run)
            self.assertRegex(errors[0], rf"^error: rank {stopped}\b.* has not been heard of")

        self.at_once(check, (2, 0), (3, 2))

    def test_ctrl_c_ends_the_run(self):
        def check(ranks):
            run, _ = self.started(ranks)
            os.kill(run.process.pid, signal.SIGINT)
            run.wait()  # the exit code of MPICH's mpiexec is 0
            codes = {p.read_text() for p in self.folder.glob("code.*")}
            self.assertLessEqual(codes, {str(128 + signal.SIGINT), str(128 + signal.SIGTERM)}, run)

        self.at_once(check, (1,), (3,))

    def test_a_rank_that_is_told_to_end_ends_the_run(self):
        def check(ranks, told):
            run, pids = self.started(ranks)
            os.kill(pids[told], signal.SIGTERM)
            self.check_ended(run)
            errors = [line for line in run.stderr.splitlines() if line.startswith("error: ")]
            self.assertEqual(errors, ["error: interrupted; go on so"], run)

        self.at_once(check, (1, 0), (3, 2))


if __name__ == "__main__":
    main()
