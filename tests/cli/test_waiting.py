"""Nothing that a command waits for keeps it from being ended."""

import contextlib
import os
import signal
import sqlite3
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest
from program import contract_quickly as setUpModule
from shapes import box


class Waiting(ProgramTest):

    def setUp(self):
        super().setUp()
        self.write("a.off", box(1.0))
        os.mkfifo(self.dir / "pipe")
        os.mkfifo(self.dir / "pipe.json")

    def assert_ends(self, *command):
        """Interrupts a command that waits; it must end with the signal's code, and at once."""
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 75)):
            process = subprocess.Popen([PROGRAM, *command], cwd=self.dir, stdin=subprocess.PIPE,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            try:
                time.sleep(0.5)
                self.assertIsNone(process.poll(), (command, process.poll() is not None and process.stderr.read()))
                process.send_signal(number)
                started = time.monotonic()
                self.assertEqual(process.wait(timeout=20), code, command)
                self.assertLess(time.monotonic() - started, 5.0, command)
                self.assertEqual(len(process.stderr.read().decode().strip().splitlines()), 1, command)
            finally:
                process.kill()
                process.wait()
                for stream in (process.stdin, process.stdout, process.stderr):
                    stream.close()

    def test_a_manifest_from_a_silent_standard_input_a_pipe_or_an_endless_device(self):
        for manifest in ("-", "pipe", "/dev/zero"):
            self.assert_ends("batch", "--manifest", manifest, "-o", "out")

    def test_a_manifest_from_a_pipe_is_read(self):
        for manifest in ("-", "pipe"):
            process = subprocess.Popen([PROGRAM, "batch", "--manifest", manifest, "-o", "b" + manifest, "--write", "camera",
                                        "--search", "rapid", "--json"], cwd=self.dir, stdin=subprocess.PIPE,
                                       stdout=subprocess.PIPE)
            time.sleep(0.3)
            if manifest == "pipe":
                process.stdin.close()
                (self.dir / "pipe").write_text("a.off\n")
                out = process.stdout.read()
                process.stdout.close()
                process.wait()
            else:
                out, _ = process.communicate(b"a.off\n")
            self.assertIn(b'"done":1', out)

    def test_a_file_of_options_that_nobody_writes_and_one_that_never_ends(self):
        self.assert_ends("info", "a.off", "--config", "pipe")
        self.vantage("info", "a.off", "--config", "/dev/zero", exit_code=2)
        self.assertEqual(self.vantage("info", "a.off", "--config", "pipe", "--timeout", "0.2", exit_code=1).err.strip(),
                         "vantage: stopped: it took longer than --timeout allows; give it more, or a smaller model")

    def test_a_pipe_without_a_reader_or_that_reads_no_further(self):
        self.assert_ends("thumb", "a.off", "pipe")
        self.assert_ends("render", "a.off", "-o", "pipe", "--direction", "0,0,1", "--size", "32")
        self.assert_ends("score", "a.off", "--sphere", "0", "-o", "pipe")
        self.assert_ends("score", "a.off", "--sphere", "5")  # more than a pipe holds

    def test_standard_input_that_is_silent(self):
        self.assert_ends("info", "-")
        self.assert_ends("score", "a.off", "--directions", "-")
        self.assert_ends("render", "a.off", "-o", "r.png", "--camera", "-")

    def test_a_table_of_many_models(self):
        self.vantage("batch", "a.off", "-o", "many", "--write", "camera", "--no-overview")
        with contextlib.closing(sqlite3.connect(self.dir / "many/results.sqlite")) as store, store:
            columns = [row[1] for row in store.execute("PRAGMA table_info(models)") if row[1] != "key"]
            store.execute("WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 100000) INSERT INTO models "
                          f"(key, {', '.join(columns)}) SELECT 'copy' || i, {', '.join(columns)} FROM models, n")
        self.assert_ends("results", "query", "many", "--where", "vertices>0")
        self.assert_ends("results", "diff", "many", "many")

    def test_a_pipe_in_place_of_a_result_of_ours(self):
        os.mkdir(self.dir / "out")
        os.mkfifo(self.dir / "out/view.json")
        self.vantage("view", "a.off", "-o", "out", "--no-images", "--timeout", "60", exit_code=1)
        self.vantage("serve", "out", "--timeout", "60", exit_code=3)


if __name__ == "__main__":
    unittest.main()
