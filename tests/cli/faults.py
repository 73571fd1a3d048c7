"""Runs of the program in which one call that writes fails, or the process dies there (fail_at_call.cpp), and
what has to be true after each: the next run ends as an undisturbed one does.

A case is a job that is first run undisturbed, then disturbed at one call and run again. VANTAGE_FAULT_SHIM
names the shim.
"""

import collections
import http.client
import json
import os
import pathlib
import shutil
import signal
import subprocess
import urllib.error
import urllib.parse
import urllib.request

PROGRAM = os.environ.get("VANTAGE", "")
SHIM = os.environ.get("VANTAGE_FAULT_SHIM", "")
ERRORS = ("ENOSPC", "EDQUOT", "EROFS", "EIO", "KILL")
TIMES = {"timings.json", "timings.csv"}
TRY_AGAIN = 75


class Broken(AssertionError):
    """What ought to hold after a fault does not."""


def require(condition, problem):
    if not condition:
        raise Broken(problem)


def files_of(folder):
    """Names and bytes of the files of a folder and of those below it, hidden ones too, but for times."""
    folder = pathlib.Path(folder)
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*"))
            if p.is_file() and p.name not in TIMES}


def sampled(count, wanted):
    """Up to `wanted` numbers of 1 … count, spread evenly, the first and the last with them."""
    if count <= wanted:
        return list(range(1, count + 1))
    return sorted({1 + round(i * (count - 1) / (wanted - 1)) for i in range(wanted)})


class Job:
    """A command in a folder, made of words in which OUT stands for the folder of results."""

    name = ""
    faults_in = ""  # "worker", "parent" or both
    failures = (1,)  # exit codes

    def __init__(self, scratch):
        self.scratch = pathlib.Path(scratch)

    def words(self, out):
        raise NotImplementedError

    def prepare(self, out):
        """What is there before the command."""

    def answer(self, out):
        """What must be the same after a disturbed and a finished run."""
        raise NotImplementedError

    def check_disturbed(self, out, whole):
        """What must hold right after the fault."""

    def environment(self, faults):
        environment = dict(os.environ)
        if faults:
            environment["LD_PRELOAD"] = SHIM
            environment.update({f"FAULT_{name.upper()}": str(value) for name, value in faults.items()})
            if self.faults_in:
                environment["FAULT_IN"] = self.faults_in
        return environment

    def run(self, out, **faults):
        return subprocess.run([PROGRAM, *self.words(out)], cwd=self.scratch, env=self.environment(faults), check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=300)

    def undisturbed(self):
        """The answer of an undisturbed run, its exit code, and how many calls it makes."""
        out = self.scratch / f"{self.name}-whole"
        count = self.scratch / f"{self.name}-count"
        self.prepare(out)
        done = self.run(out, count=count)
        by_process = collections.Counter(count.read_text().split()) if count.exists() else {}
        calls = max(by_process.values(), default=0)
        return self.answer(out), done.returncode, calls

    def disturbed(self, call, error, whole, usual, stays=False):
        """Disturbs a run and finishes it; what happened, in a word. \\throw Broken"""
        out = self.scratch / f"{self.name}-{call}-{error}{'-stays' if stays else ''}"
        mark = self.scratch / "mark"
        mark.unlink(missing_ok=True)
        self.prepare(out)
        faults = {"at": call, "error": error, "mark": mark, **({"stays": 1} if stays else {})}
        done = self.run(out, **faults)
        where = f"{self.name}, call {call}, {error}{' from there on' if stays else ''}: "
        words = done.stderr.decode(errors="replace")
        came = mark.exists()
        require(done.returncode in (usual, *self.failures, TRY_AGAIN, 4, -9),
                f"{where}exit code {done.returncode}: {words}")
        require(done.returncode != -9 or error == "KILL", f"{where}died: {words}")
        if done.returncode in (*self.failures, TRY_AGAIN):
            require(words.strip().startswith("vantage: ") or "\nvantage: " in words,
                    f"{where}no sentence says what is wrong: {words!r}")
        self.check_disturbed(out, whole)
        if done.returncode == usual and error != "KILL":
            outcome = "usual exit code"
        else:
            outcome = {-9: "killed", usual: "worker killed"}.get(done.returncode, f"exit code {done.returncode}")
        again = self.run(out)
        require(again.returncode == usual, f"{where}then exit code {again.returncode}: {again.stderr.decode()}")
        after = self.answer(out)
        require(after == whole, where + difference(whole, after))
        shutil.rmtree(out, ignore_errors=True)
        return outcome if came else "not reached"


def difference(whole, after):
    if isinstance(whole, dict):
        odd = sorted(name for name in whole.keys() | after.keys() if whole.get(name) != after.get(name))
        return f"{odd} differ from those of an undisturbed run"
    return f"the answer differs from that of an undisturbed run:\n{whole}\n{after}"


class View(Job):
    """A view into a new folder."""

    name = "view"

    def words(self, out):
        return ["view", "new.off", "-o", str(out), "--search", "rapid", "--size", "48", "-q"]

    def answer(self, out):
        return files_of(out)

    def check_disturbed(self, out, whole):
        if not pathlib.Path(out).exists():
            return
        for name, content in files_of(out).items():
            if name in whole:
                require(content == whole[name], f"{out}: {name} is half written")


class ViewOver(View):
    """The same where results of another model are."""

    name = "view-over"

    def prepare(self, out):
        before = self.scratch / "before"
        if not before.exists():
            subprocess.run([PROGRAM, "view", "old.off", "-o", str(before), "--search", "rapid", "--size", "48", "-q"],
                           cwd=self.scratch, check=True)
        shutil.copytree(before, out)

    def check_disturbed(self, out, whole):
        before = files_of(self.scratch / "before")
        now = {name: content for name, content in files_of(out).items() if not name.startswith(".")}
        report = "report.html"  # written last, by itself
        rest = {name: content for name, content in now.items() if name != report}
        is_old = all(before.get(name) == content for name, content in rest.items())
        is_new = all(whole.get(name) == content for name, content in rest.items())
        require(is_old or is_new, f"{out}: files of two runs, or half of one: {sorted(rest)}")
        require(report not in now or now[report] in (before.get(report), whole.get(report)),
                f"{out}: {report} is half written")


class Batch(Job):
    """A batch of a few models, one of them broken, two alike."""

    name = "batch"

    def words(self, out):
        return ["batch", "m0.off", "m1.off", "m2.off", "bad.off", "-o", str(out), "--write", "best,camera",
                "--search", "rapid", "--size", "48", "--jobs", "1", "--retry", "failed", "-q"]

    def export(self, out):
        done = subprocess.run([PROGRAM, "results", "export", str(out), "--format", "jsonl"], check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        require(done.returncode == 0, f"{out}: {done.stderr.decode()}")
        return done.stdout.decode()

    def answer(self, out):
        files = {name: content for name, content in files_of(out).items()
                 if not name.startswith("results.sqlite")}
        return {**files, "export": self.export(out)}

    def check_disturbed(self, out, whole):
        models = pathlib.Path(out) / "models"
        if not models.exists():
            return
        for view in models.rglob("view.json"):
            json.loads(view.read_text())
        for name, content in files_of(models).items():
            require(whole.get(f"models/{name}") == content, f"{out}: models/{name} is half written")


class BatchParent(Batch):
    name = "batch-parent"
    faults_in = "parent"


class BatchWorker(Batch):
    name = "batch-worker"
    faults_in = "worker"


class Shard(Batch):
    """One shard, whose records are lines of a file; merged afterwards."""

    name = "shard"
    faults_in = "parent"

    def words(self, out):
        return [*super().words(out), "--shard", "0/1", "--name", "{stem}-{key8}"]

    def answer(self, out):
        done = subprocess.run([PROGRAM, "results", "merge", str(out), "-q"], check=False, stderr=subprocess.PIPE)
        require(done.returncode == 0, f"{out}: merge: {done.stderr.decode()}")
        files = super().answer(out)
        return {name: content for name, content in files.items() if not name.startswith("shards/")}


class Merge(Batch):
    """The merge of two shards."""

    name = "merge"
    failures = (1, 3)  # the store is its input, too

    def words(self, out):
        return ["results", "merge", str(out), "-q"]

    def prepare(self, out):
        before = self.scratch / "shards-before"
        if not before.exists():
            for shard in range(2):
                subprocess.run([PROGRAM, *Batch.words(self, before), "--shard", f"{shard}/2", "--name",
                                "{stem}-{key8}"], cwd=self.scratch, check=False)
        shutil.copytree(before, out)

    def answer(self, out):
        return {name: content for name, content in super().answer(out).items() if not name.startswith("shards/")}


class Serve(Batch):
    """A server of the folder of a batch, asked for its first page and for each file, and ended."""

    name = "serve"
    failures = (1, 3)  # the store is its input, too

    def __init__(self, scratch):
        super().__init__(scratch)
        self.pages = {}

    def prepare(self, out):
        before = self.scratch / "served-before"
        if not before.exists():
            subprocess.run([PROGRAM, *Batch.words(self, before)], cwd=self.scratch, check=False)
        shutil.copytree(before, out)

    def undisturbed(self):
        whole, usual, calls = super().undisturbed()
        pages = {page: content for page, content in whole.items() if page.startswith("page ")}
        require(pages.pop("page absent", None) == 404 and b"<html" in pages.get("page ", b""), "no server answers")
        require(len(pages) > 1 and all(isinstance(content, bytes) for content in pages.values()), "files are not served")
        return whole, usual, calls

    def run(self, out, **faults):
        words = [PROGRAM, "serve", str(out), "-q"]
        server = subprocess.Popen(words, cwd=self.scratch, env=self.environment(faults), stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE)
        self.pages = self.ask(server.stdout.readline().decode().strip(), out)
        server.send_signal(signal.SIGINT)
        stdout, stderr = server.communicate(timeout=60)
        return subprocess.CompletedProcess(words, server.returncode, stdout, stderr)

    @staticmethod
    def ask(address, out):
        """What the server answers to each path; nothing where it does not answer."""
        pages = {}
        for path in ["", "absent", *sorted(files_of(pathlib.Path(out) / "models"))] if address else []:
            path = f"models/{path}" if path not in ("", "absent") else path
            try:
                with urllib.request.urlopen(address + urllib.parse.quote(path), timeout=60) as answer:
                    pages[f"page {path}"] = answer.read()
            except urllib.error.HTTPError as error:
                pages[f"page {path}"] = error.code
            except (OSError, http.client.HTTPException):
                continue
        return pages

    def answer(self, out):
        return {**super().answer(out), **self.pages}

    def check_disturbed(self, out, whole):
        super().check_disturbed(out, whole)
        for page, content in self.pages.items():
            require(content == whole[page] or content in (500, 503), f"{out}: {page} is answered wrongly")


JOBS = (View, ViewOver, BatchParent, BatchWorker, Shard, Merge, Serve)
