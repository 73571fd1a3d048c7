# SPDX-License-Identifier: MIT
"""`vantage batch --engine slurm` against a real cluster on loopback, with its failures."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import cluster

VANTAGE = os.environ["VANTAGE"]
# Fast, so that a test is about Slurm; a shard of the slow kind takes long enough to be disturbed.
FAST = ["--search", "rapid", "--contraction", "exact", "--write", "camera"]
SLOW = ["--search", "exhaustive", "--subdivisions", "4", "--contraction", "exact", "--write", "camera"]


def write_boxes(folder, count):
    folder.mkdir()
    for i in range(count):
        side = 1 + i / 10
        corners = [(x, y, z) for x in (0, side) for y in (0, 1) for z in (0, 2)]
        faces = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
        (folder / f"box-{i:03}.obj").write_text(
            "".join("v %g %g %g\n" % p for p in corners) + "".join("f %d %d %d %d\n" % f for f in faces))


def write_waves(folder, count):
    """Wavy sheets, no two alike: a second or so each with a dense search."""
    folder.mkdir()
    cells = 40
    for i in range(count):
        lines = []
        for y in range(cells + 1):
            for x in range(cells + 1):
                lines.append("v %g %g %g\n" % (x, y, (3 + i / 100) * ((x * (i + 3)) % 7 + (y * (i + 2)) % 5) / 5))
        for y in range(cells):
            for x in range(cells):
                a = y * (cells + 1) + x + 1
                lines.append("f %d %d %d %d\n" % (a, a + 1, a + cells + 2, a + cells + 1))
        (folder / f"wave-{i:03}.obj").write_text("".join(lines))


def processes(*words):
    """Ids of running processes whose command line holds all the words."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                line = (entry / "cmdline").read_bytes().decode(errors="replace").split("\0")
            except OSError:
                continue
            if all(any(word in part for part in line) for word in words):
                found.append(int(entry.name))
    return found


def wait_until(condition, what, seconds=60):
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError("waited in vain until " + what)
        time.sleep(0.05)


@unittest.skipIf(cluster.missing(), f"NOTHING WAS TESTED: no Slurm here: {cluster.missing()}")
class SlurmTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="vantage-slurm-", dir="/tmp"))
        os.chmod(cls.folder, 0o755)
        cls.cluster = cluster.Cluster(cls.folder / "cluster")
        write_boxes(cls.folder / "boxes", 96)
        (cls.folder / "boxes" / "broken.obj").write_text("f 1 2 3\n")
        write_waves(cls.folder / "waves", 8)

    @classmethod
    def tearDownClass(cls):
        cls.cluster.stop()
        shutil.rmtree(cls.folder, ignore_errors=True)

    def setUp(self):
        self.out = self.folder / self.id().rsplit(".", 1)[1]

    def run(self, result=None):
        """A failure tells what Slurm and the shards said: the folder is gone when one reads of it."""
        before = len(result.failures) + len(result.errors)
        super().run(result)
        if len(result.failures) + len(result.errors) > before:
            for log in [*sorted(self.out.glob("slurm/*.log")),
                        *sorted((self.folder / "cluster" / "log").iterdir())]:
                print(f"== {log.name}", *log.read_text(errors="replace").splitlines()[-60:], sep="\n",
                      file=sys.stderr)

    def command(self, models, out, *flags):
        return [VANTAGE, "batch", models, "-o", str(out), *flags]

    def start(self, models, *flags):
        process = subprocess.Popen(
            self.command(models, self.out, "--engine", "slurm", *flags), cwd=self.folder,
            env=self.cluster.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.clear, process)
        return process

    def clear(self, process):
        """Leaves the next test an empty queue, whatever became of this one."""
        if process.poll() is None:
            process.kill()
            process.communicate()
        self.cluster.cancel_all()

    def run_local(self, models, *flags):
        out = self.folder / f"local-{models}"
        if not out.exists():
            subprocess.run(self.command(models, out, *flags), cwd=self.folder, check=False,
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        return out

    def exported(self, out):
        return subprocess.run([VANTAGE, "results", "export", str(out), "--format", "jsonl"],
                              stdout=subprocess.PIPE, check=True).stdout

    def attempts(self, out):
        rows = subprocess.run(
            [VANTAGE, "results", "export", str(out), "--format", "jsonl", "--timings"],
            stdout=subprocess.PIPE, check=True, text=True).stdout.splitlines()
        return {json.loads(row)["key"]: json.loads(row)["attempts"] for row in rows}

    def check_waves(self, process):
        output, errors = process.communicate(timeout=400)
        self.assertEqual(process.returncode, 0, output + errors)
        self.assertEqual(self.exported(self.out), self.exported(self.run_local("waves", *SLOW)))
        return errors

    def shard_processes(self):
        return [p for p in processes("--shard", f"--output={self.out}")
                if pathlib.Path(f"/proc/{p}/exe").resolve() == pathlib.Path(VANTAGE).resolve()]

    def kill_shard(self):
        os.kill(self.shard_processes()[0], signal.SIGKILL)

    def test_an_array_of_64_tasks_gives_the_same_bytes_as_a_run_on_this_machine(self):
        process = self.start("boxes", "--shards", "64", *FAST)
        output, errors = process.communicate(timeout=400)
        self.assertEqual(process.returncode, 4, output + errors)  # one model is broken
        mine = self.exported(self.out)
        self.assertEqual(mine, self.exported(self.run_local("boxes", *FAST)))
        self.assertEqual(mine.count(b"\n"), 97)
        self.assertEqual(len(list((self.out / "models").iterdir())), 96)

    def test_a_worker_that_is_killed_costs_an_attempt_and_no_model(self):
        process = self.start("waves", "--shards", "2", *SLOW)
        wait_until(lambda: list(self.out.glob("models/*/view.json")), "a model is done")
        time.sleep(0.3)  # into the next one
        for worker in processes("batch-worker", "exhaustive"):  # all: one may be between two models
            os.kill(worker, signal.SIGKILL)
        self.check_waves(process)
        self.assertEqual(max(self.attempts(self.out).values()), 2)

    def test_a_shard_that_is_killed_is_submitted_again_and_goes_on(self):
        process = self.start("waves", "--shards", "2", *SLOW)
        wait_until(lambda: self.shard_processes() and list(self.out.glob("models/*/view.json")),
                   "a shard has done a model")
        self.kill_shard()
        errors = self.check_waves(process)
        self.assertEqual(errors.count("job "), 2, errors)

    def test_a_model_that_is_given_up_leaves_its_results_to_its_equal(self):
        write_waves(self.folder / "twins", 2)
        first, second = sorted((self.folder / "twins").iterdir())
        other = second.read_bytes()
        second.write_bytes(first.read_bytes())
        subprocess.run(self.command("twins", self.out, *SLOW), cwd=self.folder, check=True, stdout=subprocess.PIPE)
        first.write_bytes(other)
        process = self.start("twins", "--shards", "1", "--attempts", "1", *SLOW)
        wait_until(self.shard_processes, "the shard runs")
        self.kill_shard()
        output, errors = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 4, output + errors)
        rows = {row["name"]: row for row in map(json.loads, self.exported(self.out).splitlines())}
        self.assertEqual((rows["wave-000"]["status"], rows["wave-000"]["reason"]), ("failed", "crash"))
        self.assertEqual((rows["wave-001"]["status"], rows["wave-001"]["duplicate_of"]), ("done", ""))
        verified = subprocess.run([VANTAGE, "results", "verify", str(self.out)], stdout=subprocess.PIPE, text=True, check=False)
        self.assertIn("1 folder of results: all sound", verified.stdout)

    def test_a_lost_node_hands_its_shard_to_the_other_one(self):
        process = self.start("waves", "--shards", "2", *SLOW)
        wait_until(lambda: list(self.out.glob("models/*/view.json")), "a model is done")
        self.cluster.kill_node("n1")
        try:
            self.check_waves(process)
        finally:
            self.cluster.start_node("n1")

    def test_a_shard_over_its_time_limit_stops_with_75_and_goes_on_when_requeued(self):
        # Slurm's shortest limit is a minute; thirty seconds before it the shard is told to stop. Until then its workers
        # stand still, so that it has work for longer, however fast the machine is.
        process = self.start("waves", "--shards", "1", "--minutes", "1", *SLOW)
        log = self.out / "slurm" / "shard-0.log"
        stops = lambda: log.read_text().count("stopped by SIGTERM") if log.exists() else 0
        wait_until(lambda: list(self.out.glob("models/*/view.json")), "a model is done")
        before = stops()  # one more is waited for
        workers = processes("batch-worker", "exhaustive")
        for worker in workers:
            os.kill(worker, signal.SIGSTOP)
        try:
            wait_until(lambda: stops() > before, "the shard is told to stop", 150)
        finally:
            for worker in {*workers} & {*processes("batch-worker", "exhaustive")}:
                os.kill(worker, signal.SIGCONT)
        errors = self.check_waves(process)
        # Slurm may send the signal up to a minute early (sbatch, --signal): then no model has ended, and the batch
        # submits a job anew. Every other stop is one after which Slurm itself starts the job again.
        self.assertGreater(stops(), errors.count("job ") - 1, "Slurm starts it again")

    def test_an_interrupted_batch_cancels_its_job_and_resumes(self):
        process = self.start("waves", "--shards", "2", *SLOW)
        wait_until(lambda: list(self.out.glob("models/*/view.json")), "a model is done")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        stored = [json.loads(line)["key"] for line in self.exported(self.out).splitlines()]
        page = (self.out / "index.html").read_text()
        shown = json.loads(page.partition('id="data">')[2].partition("</script>")[0])["rows"]
        self.assertEqual(sorted(row[0] for row in shown), sorted(stored))
        wait_until(lambda: not self.cluster.queue_is_busy(), "the queue is empty")
        done_before = {p.parent.name: p.stat().st_mtime_ns for p in self.out.glob("models/*/view.json")}
        self.assertGreater(len(done_before), 0)
        self.assertLess(len(done_before), 8)
        self.check_waves(self.start("waves", "--shards", "2", *SLOW))
        for name, modified in done_before.items():
            self.assertEqual((self.out / "models" / name / "view.json").stat().st_mtime_ns, modified)

    def test_balanced_shards_hold_every_model_once(self):
        process = self.start("boxes", "--shards", "5", "--balance", *FAST)
        process.communicate(timeout=400)
        self.assertEqual(self.exported(self.out), self.exported(self.run_local("boxes", *FAST)))
        sizes = [len(p.read_text().splitlines()) for p in sorted((self.out / "shards").glob("*.jsonl"))]
        self.assertEqual(sum(sizes), 97)
        # The files are about alike, so their counts are.
        self.assertLessEqual(max(sizes) - min(sizes), 2)

    def test_run_again_it_does_what_changed_since_and_no_more(self):
        write_boxes(self.folder / "changing", 4)
        run = lambda *flags: self.start("changing", "--shards", "1", *FAST, *flags)
        local = lambda: subprocess.run(
            self.command("changing", self.folder / "changing-local", *FAST), cwd=self.folder, check=False,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        run().communicate(timeout=200)
        _, errors = run().communicate(timeout=200)
        self.assertEqual(errors.count("job "), 0, errors)  # nothing changed: nothing is submitted
        models = sorted((self.folder / "changing").iterdir())
        models[1].write_bytes(models[0].read_bytes().replace(b" 2", b" 3"))
        models[2].write_text("f 1 2 3\n")
        os.utime(models[3], ns=(1, 1))
        process = run()
        _, errors = process.communicate(timeout=200)
        self.assertEqual((process.returncode, errors.count("job ")), (4, 1), errors)
        local()
        self.assertEqual(self.exported(self.out), self.exported(self.folder / "changing-local"))
        self.assertIn(b"failed", self.exported(self.out))
        shutil.rmtree(next((self.out / "models").iterdir()))
        _, errors = run().communicate(timeout=200)
        self.assertEqual(errors.count("job "), 1, errors)  # what has lost its results is done again
        self.assertEqual(len(list((self.out / "models").iterdir())), 3)
        _, errors = run("--verify").communicate(timeout=200)
        self.assertEqual(errors.count("job "), 1, errors)  # all are read again
        self.assertEqual(self.exported(self.out), self.exported(self.folder / "changing-local"))

    def test_without_slurm_it_says_what_is_missing(self):
        environment = {k: v for k, v in self.cluster.environment.items() if k != "PATH"}
        run = subprocess.run(self.command("boxes", self.out, "--engine", "slurm", *FAST), cwd=self.folder,
                             env=environment | {"PATH": "/nonexistent"}, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"sbatch: cannot be started")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
