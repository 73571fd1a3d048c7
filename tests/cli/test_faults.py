"""Calls that write fail, or the process dies there: whatever the call, the run after it ends as if nothing had
happened (faults.py). Here a few calls of each job; scripts/inject_faults.py takes all.

VANTAGE_FAULTS says how many calls of each job and error (default 2).
"""

import os
import pathlib
import signal
import subprocess
import time
import unittest
import urllib.request

import faults
from program import PROGRAM, ProgramTest
from program import contract_quickly as setUpModule
from shapes import box, write_fault_models

MOST = int(os.environ.get("VANTAGE_FAULTS", "2"))


class Faults(ProgramTest):

    def setUp(self):
        super().setUp()
        self.assertTrue(pathlib.Path(faults.SHIM).is_file(), "VANTAGE_FAULT_SHIM names no file")
        write_fault_models(self.dir)

    def check(self, kind, errors=faults.ERRORS):
        job = kind(self.dir)
        whole, usual, calls = job.undisturbed()
        self.assertGreater(calls, 10)
        outcomes = []
        for number, error in enumerate(errors):
            # Other calls for each error: together they cover more.
            for call in faults.sampled(calls, MOST * len(errors))[number::len(errors)]:
                outcomes.append(job.disturbed(call, error, whole, usual))
        # Which process makes how many calls hangs on chance: not every last one is made again.
        self.assertLessEqual(outcomes.count("not reached"), len(outcomes) / 4, outcomes)
        self.assertNotEqual(job.disturbed(calls // 2, "ENOSPC", whole, usual, stays=True), "not reached")

    def test_views(self):
        self.check(faults.View)

    def test_views_over_others(self):
        self.check(faults.ViewOver)

    def test_a_disk_that_breaks_as_results_are_exchanged_leaves_a_folder_of_ours(self):
        # Of the calls that remove the former results some is the second: what is left must be known as ours.
        job = faults.ViewOver(self.dir)
        whole, usual, calls = job.undisturbed()
        for call in range(calls * 6 // 10, calls * 8 // 10, 2):
            self.assertNotEqual(job.disturbed(call, "EIO", whole, usual), "not reached")

    def test_batches(self):
        self.check(faults.BatchParent)

    def test_a_store_on_a_full_disk_says_so(self):
        job = faults.BatchParent(self.dir)
        _, _, calls = job.undisturbed()
        of_store = set()
        for call in faults.sampled(calls, 24):
            out = self.dir / f"full-{call}"
            done = job.run(out, at=call, error="ENOSPC", stays=1)
            of_store |= {line.partition("results.sqlite")[2] for line in done.stderr.decode().splitlines()
                         if "results.sqlite" in line and "No space left" in line}
        self.assertEqual(of_store, {": cannot hold more results; make room and run it again (No space left on device)"})

    def test_workers_of_batches(self):
        self.check(faults.BatchWorker, ("ENOSPC", "EIO", "KILL"))

    def test_shards(self):
        self.check(faults.Shard, ("EDQUOT", "EROFS", "KILL"))

    def test_merges(self):
        self.check(faults.Merge, ("ENOSPC", "EIO", "KILL"))

    def test_servers(self):
        self.check(faults.Serve, ("EDQUOT", "EIO", "KILL"))

    def test_a_server_whose_disk_takes_nothing_serves(self):
        self.vantage("batch", "m0.off", "-o", "out", "--search", "rapid", "--size", "48", "-q")
        before = faults.files_of(self.dir / "out")
        for error in ("ENOSPC", "EROFS"):
            environment = {**os.environ, "LD_PRELOAD": faults.SHIM, "FAULT_AT": "1", "FAULT_STAYS": "1",
                           "FAULT_ERROR": error}
            with subprocess.Popen([PROGRAM, "serve", "out", "--port", "0"], cwd=self.dir, env=environment,
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as server:
                address = server.stdout.readline().decode().split()[-1]
                with urllib.request.urlopen(address, timeout=30) as page:
                    self.assertIn(b"m0", page.read(), error)
                server.send_signal(signal.SIGTERM)
            self.assertEqual(faults.files_of(self.dir / "out"), before)


class Time(ProgramTest):
    """What happens meanwhile."""

    def setUp(self):
        super().setUp()
        self.names = [f"m{i}.off" for i in range(4)]
        for i, name in enumerate(self.names):
            self.write(name, box(1 + i / 10))
        # Long enough for something to happen meanwhile.
        self.run_words = ("--search", "rapid", "--size", "48", "--jobs", "2", "--contraction", "auto", "-q")

    def export(self, folder):
        return self.vantage("results", "export", folder, "--format", "jsonl").out

    def start(self, folder):
        return subprocess.Popen([PROGRAM, "batch", *self.names, "-o", folder, *self.run_words], cwd=self.dir,
                                start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    def test_a_batch_that_is_stopped_and_goes_on_ends_as_any_other(self):
        self.vantage("batch", *self.names, "-o", "whole", *self.run_words)
        with self.start("paused") as process:
            for results in range(3):  # two are computed at a time, so that then as many are left
                while process.poll() is None and len(list(self.dir.glob("paused/models/*/view.json"))) < results:
                    time.sleep(0.01)
                self.assertIsNone(process.poll(), "the batch has ended before it was stopped")
                os.killpg(process.pid, signal.SIGSTOP)
                time.sleep(0.5)
                os.killpg(process.pid, signal.SIGCONT)
            self.assertEqual(process.wait(timeout=120), 0, process.stderr.read())
        self.assertEqual(self.export("paused"), self.export("whole"))

    def test_an_input_that_is_replaced_meanwhile_is_answered_as_what_it_was_or_is(self):
        contents = [box(3), box(4)]
        for content in contents:
            self.write("m3.off", content)
            self.vantage("batch", "m3.off", "-o", f"of-{len(content)}-{contents.index(content)}", *self.run_words)
        known = {line for i, content in enumerate(contents)
                 for line in self.export(f"of-{len(content)}-{i}").splitlines()}
        with self.start("moving") as process:
            turn = 0
            while process.poll() is None:
                turn += 1
                self.write("next", contents[turn % 2])
                os.replace(self.dir / "next", self.dir / "m3.off")
                time.sleep(0.003)
            self.assertIn(process.returncode, (0, 4))
        lines = [line for line in self.export("moving").splitlines() if '"m3.off"' in line]
        self.assertEqual(len(lines), 1)
        self.assertTrue(lines[0] in known or "was changed while it was read" in lines[0], lines[0])
        # Left alone it is answered as what it is in the end.
        self.vantage("batch", *self.names, "-o", "moving", "--retry", "failed", "--verify", *self.run_words)
        lines = [line for line in self.export("moving").splitlines() if '"m3.off"' in line]
        self.assertIn(lines[0], known)


if __name__ == "__main__":
    unittest.main()
