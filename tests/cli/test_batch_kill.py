"""A batch killed by SIGKILL at random moments: nothing lost, nothing done twice, nothing corrupt.

VANTAGE_KILLS says how often (default 16; test_faults kills at every write); the seed is fixed.
"""

import json
import os
import pathlib
import random
import shutil
import signal
import sqlite3
import subprocess
import time
import unittest

from program import PROGRAM, ProgramTest
from program import contract_quickly as setUpModule
from shapes import box

KILLS = int(os.environ.get("VANTAGE_KILLS", "16"))
SHIM = os.environ.get("VANTAGE_KILL_SHIM", "")
MODELS = 20
RUN = ["--write", "camera", "--search", "rapid", "--jobs", "2", "-q"]


def processes_of_session(session):
    """Ids of the living processes of a session; ones that only wait to be buried do not count."""
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text(errors="replace").rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[3]) == session and fields[0] not in "ZX":
            found.append(int(stat.parent.name))
    return found


class Kill(ProgramTest):

    def setUp(self):
        super().setUp()
        for i in range(MODELS):
            self.write(f"m{i:03}.off", box(1 + i // 2 * 0.01))  # every second one equals the one before
        self.write("bad.off", "OFF\n1 1 0\n0 0 0\n3 0 1 2\n")
        self.random = random.Random(20240607)

    def start(self, folder, *more):
        return subprocess.Popen([PROGRAM, "batch", *(p.name for p in sorted(self.dir.glob("*.off"))),
                                 "-o", folder, *RUN, *more], cwd=self.dir, start_new_session=True,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def kill_somewhen(self, folder, duration, *more):
        """Whether the batch came to its end before it was to be killed."""
        process = self.start(folder, *more)
        time.sleep(self.random.uniform(0.0, 1.1 * duration))
        victims = [process.pid]
        if self.random.random() < 0.3:  # sometimes a worker dies too, or first
            victims += processes_of_session(process.pid)
            self.random.shuffle(victims)
        ended = process.poll() is not None
        for victim in victims:
            try:
                os.kill(victim, signal.SIGKILL)
            except ProcessLookupError:
                pass
        process.wait()
        deadline = time.monotonic() + 20
        while processes_of_session(process.pid) and time.monotonic() < deadline:
            time.sleep(0.002)
        self.assertEqual(processes_of_session(process.pid), [], "workers survive their parent")
        return ended

    def check_folder(self, folder, records):
        """Every result that is recorded is whole."""
        for record in records:
            if record["status"] == "done" and not record["duplicate_of"]:
                files = sorted(p.name for p in (folder / "models" / record["folder"]).iterdir())
                self.assertEqual(len(files), 9, files)
                json.loads((folder / "models" / record["folder"] / "view.json").read_text())

    def stored(self, folder):
        if not (folder / "results.sqlite").exists():
            return []
        with sqlite3.connect(folder / "results.sqlite") as store:
            store.row_factory = sqlite3.Row
            self.assertEqual(store.execute("PRAGMA integrity_check").fetchone()[0], "ok")
            if not store.execute("SELECT 1 FROM sqlite_master WHERE name = 'models'").fetchone():
                return []
            rows = [dict(row) for row in store.execute("SELECT * FROM models")]
        store.close()
        return rows

    def undisturbed(self):
        began = time.monotonic()
        self.assertEqual(self.start("whole").wait(), 4)
        duration = time.monotonic() - began
        return duration, self.vantage("results", "export", "whole", "--format", "jsonl").out

    def test_whatever_the_moment_the_run_after_it_ends_as_if_nothing_had_happened(self):
        duration, expected = self.undisturbed()
        rounds = 0
        folder = self.dir / "killed-0"
        for _ in range(KILLS):
            ended = self.kill_somewhen(folder.name, duration)
            records = self.stored(folder)
            self.check_folder(folder, records)
            if ended:  # finished in spite of all: compare and begin anew
                self.assertEqual(self.start(folder.name).wait(), 4)
                export = self.vantage("results", "export", folder.name, "--format", "jsonl").out
                self.assertEqual(export, expected)
                rounds += 1
                folder = self.dir / f"killed-{rounds}"
        self.assertEqual(self.start(folder.name).wait(), 4)
        self.assertEqual(self.vantage("results", "export", folder.name, "--format", "jsonl").out, expected)
        self.check_folder(folder, self.stored(folder))
        left = [p.name for p in (folder / "models").iterdir()]
        self.assertEqual(len(left), MODELS // 2, "a folder of results that no record names")
        self.assertEqual([p.name for p in (folder / ".work").iterdir()], ["local.lock"])

    def test_a_killed_shard_loses_only_what_was_in_flight(self):
        duration, expected = self.undisturbed()
        folder = self.dir / "shards"
        for _ in range(KILLS // 4):
            self.kill_somewhen(folder.name, duration / 2, "--shard", f"{self.random.randrange(2)}/2")
            if (folder / "shards").exists():
                self.vantage("results", "merge", folder.name)
                self.check_folder(folder, self.stored(folder))
        for shard in range(2):
            self.assertIn(self.start(folder.name, "--shard", f"{shard}/2").wait(), (0, 4))
        self.vantage("results", "merge", folder.name)
        self.assertEqual(self.vantage("results", "export", folder.name, "--format", "jsonl").out, expected)


@unittest.skipUnless(SHIM, "NOTHING WAS TESTED: VANTAGE_KILL_SHIM is not set: run this by ctest")
class KilledBeforeTheOverview(ProgramTest):

    def batch(self, out, *more, **environment):
        return subprocess.run([PROGRAM, "batch", *more, "-o", out, "--search", "rapid", "--size", "48", "--write", "best",
                               "--jobs", "1", "--retry", "failed", "-q"], cwd=self.dir, capture_output=True, timeout=300,
                              check=False, env={**os.environ, **environment}).returncode

    def overview(self, out):
        return {path.name: path.read_bytes() for path in sorted((self.dir / out).iterdir())
                if path.suffix in (".html", ".png")}

    def test_the_next_run_shows_all_that_has_ended_whatever_the_moment(self):
        for i in range(3):
            self.write(f"{i}.off", box(1.5 + i))
        self.assertEqual(self.batch("before", "0.off", "1.off"), 0)
        for more in (("2.off",), ("0.off", "--forget")):
            shutil.copytree(self.dir / "before", self.dir / "whole")
            self.assertEqual(self.batch("whole", *more), 0)
            whole = self.overview("whole")
            shutil.rmtree(self.dir / "whole")
            self.assertEqual(len(whole), 2)
            stale = 0
            for call in range(1, 200):
                shutil.copytree(self.dir / "before", self.dir / "out")
                code = self.batch("out", *more, LD_PRELOAD=SHIM, KILL_AT=str(call))
                stale += self.overview("out") != whole
                self.assertEqual(self.batch("out", *more), 0)
                self.assertTrue(self.overview("out") == whole, (more, call))
                shutil.rmtree(self.dir / "out")
                if code == 0:
                    break
                self.assertIn(code, (-signal.SIGKILL, 4), call)
            self.assertGreater(stale, 1)
            self.assertEqual(code, 0, "it makes more calls than that")


@unittest.skipUnless(SHIM, "NOTHING WAS TESTED: VANTAGE_KILL_SHIM is not set: run this by ctest")
class KilledAsResultsAreExchanged(ProgramTest):
    """A folder that has others' results already, and its record is still the former one's."""

    def setUp(self):
        super().setUp()
        self.names = ("a.off", "b.off")
        for i, name in enumerate(self.names):
            self.write(name, box(1.5 + i))
        self.flags = ("--search", "rapid", "--write", "json", "--jobs", "1", "--no-overview")

    def killed(self, exchange, *arguments):
        done = subprocess.run([PROGRAM, *arguments], cwd=self.dir, capture_output=True, timeout=300, check=False,
                              env={**os.environ, "LD_PRELOAD": SHIM, "KILL_AFTER_EXCHANGE": str(exchange)})
        self.assertEqual(done.returncode, -signal.SIGKILL, done.stderr)

    def ups(self):
        """The axis that each folder's view has as up, and that each record has that names a folder."""
        views = {view.parent.name: json.loads(view.read_text())["up"]
                 for view in (self.dir / "out/models").glob("*/view.json")}
        store = sqlite3.connect(self.dir / "out/results.sqlite")
        records = {folder: json.loads(result)["up"]
                   for folder, result in store.execute("SELECT folder, result FROM models WHERE folder <> ''")}
        store.close()
        return views, records

    def test_a_batch_with_the_former_options_does_them_again(self):
        batch = ("batch", *self.names, "-o", "out", *self.flags)
        self.vantage(*batch)
        before = self.ups()
        self.killed(1, *batch, "--up", "x")
        views, records = self.ups()
        self.assertNotEqual(views, before[0])
        self.assertEqual({**views, **records}, views)
        self.vantage(*batch)
        self.assertEqual(self.ups(), before)

    def test_a_merge_goes_on_where_it_was(self):
        self.vantage("batch", *self.names, "-o", "out", *self.flags)
        self.vantage("batch", *self.names, "-o", "part", *self.flags, "--up", "x")
        merge = ("results", "merge", "out", "part", "--no-overview")
        self.killed(1, *merge)
        views, records = self.ups()
        self.assertEqual(len(set(views.values())), 2)
        self.assertEqual({**views, **records}, views)
        self.vantage(*merge)
        views, records = self.ups()
        self.assertEqual((len(set(views.values())), views), (1, records))
        self.assertIn("2 folders of results: all sound", self.vantage("results", "verify", "out").out)


if __name__ == "__main__":
    unittest.main()
