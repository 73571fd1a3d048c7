#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs many models of a few faces through `batch` (or a Slurm array on loopback) while its workers are killed, checks
what came of it, and measures a store of a million rows.

    scripts/measure_store.py PROGRAM [--models 100000] [--kill 0.01] [--slurm] [--jobs 2] [--seconds 3000]
    scripts/measure_store.py PROGRAM --rows 1000000

One worker is killed (SIGKILL) for each 1 / KILL models that are done. Prints one line a number; exit code 1 if a model is
missing, failed, or `results verify` finds something. After --seconds the batch is stopped, and what was reached is checked.
"""

import argparse
import contextlib
import os
import pathlib
import random
import resource
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
QUICK = ["--preset", "paper", "--write", "json", "--no-overview", "-q"]
BODIES = [  # vertices and faces of a tetrahedron, a bipyramid and an octahedron
    ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]),
    ([(1, 0, 0), (-.5, .8, 0), (-.5, -.8, 0), (0, 0, 1), (0, 0, -1)],
     [(0, 1, 3), (1, 2, 3), (2, 0, 3), (1, 0, 4), (2, 1, 4), (0, 2, 4)]),
    ([(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)],
     [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (1, 0, 5), (2, 1, 5), (3, 2, 5), (0, 3, 5)])]


def write_models(folder, count):
    """Different models of 4 to 8 faces, a thousand a folder, and the list of them."""
    rng = random.Random(1)
    with open(folder / "list", "w", encoding="utf-8") as manifest:
        for i in range(count):
            points, faces = BODIES[i % len(BODIES)]
            moved = [[c * (1 + 0.6 * rng.random()) + 0.1 * rng.random() for c in p] for p in points]
            path = folder / f"{i // 1000:03}" / f"{i:06}.off"
            path.parent.mkdir(exist_ok=True)
            path.write_text(f"OFF\n{len(moved)} {len(faces)} 0\n" + "".join("%.5f %.5f %.5f\n" % tuple(p) for p in moved)
                            + "".join("3 %d %d %d\n" % f for f in faces))
            manifest.write(f"{path.relative_to(folder)}\n")
    return folder / "list"


def counts(out):
    """Rows of the store by status, of a running batch too."""
    with contextlib.suppress(sqlite3.Error):
        with contextlib.closing(sqlite3.connect(f"file:{out}/results.sqlite?mode=ro", uri=True)) as store:
            return dict(store.execute("SELECT status, COUNT(*) FROM models GROUP BY status"))
    return {}


def done_in_store(out):
    """Models that have ended. Not by status: that is in rows of kilobytes, which to read took more than the batch."""
    with contextlib.suppress(sqlite3.Error):
        with contextlib.closing(sqlite3.connect(f"file:{out}/results.sqlite?mode=ro", uri=True)) as store:
            return store.execute("SELECT COUNT(*) FROM timings").fetchone()[0]
    return 0


def done_by_shards(out):
    return sum(file.read_bytes().count(b"\n") for file in (out / "shards").glob("**/*.jsonl"))


def workers(out):
    """Processes that work for the batch into `out`."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        with contextlib.suppress(OSError):
            words = (entry / "cmdline").read_bytes().split(b"\0") if entry.name.isdigit() else []
            if b"batch-worker" in words:
                parent = (entry / "stat").read_text().rsplit(")", 1)[1].split()[1]
                if str(out).encode() in pathlib.Path(f"/proc/{parent}/cmdline").read_bytes():
                    found.append(int(entry.name))
    return found


def processor_seconds():
    """Of all processes that have ended and were waited for."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run_under_kills(command, out, kill, seconds, done, environment):
    """Runs the command and kills workers meanwhile. Returns seconds, kills, and whether it came to its end."""
    rng = random.Random(2)
    begin = time.monotonic()
    process = subprocess.Popen([str(c) for c in command], env=environment)
    killed = 0
    while process.poll() is None:
        time.sleep(0.5)
        if time.monotonic() - begin > seconds:
            process.send_signal(signal.SIGINT)
            process.wait()
            return time.monotonic() - begin, killed, False
        if done() * kill > killed + 1:
            victims = workers(out)
            if victims:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(rng.choice(victims), signal.SIGKILL)
                    killed += 1
    return time.monotonic() - begin, killed, process.returncode == 0


def timed(name, command, codes=(0,)):
    before = processor_seconds()
    begin = time.monotonic()
    ended = subprocess.run([str(c) for c in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    print(f"{name}: {time.monotonic() - begin:.1f} s, {processor_seconds() - before:.1f} s of processor", flush=True)
    if ended.returncode not in codes:
        print(f"  exit code {ended.returncode}: {ended.stderr.strip()[:300]}")
    return ended.returncode in codes


def check_kills(arguments, scratch):
    manifest = write_models(scratch, arguments.models)
    out = scratch / "out"
    command = [arguments.program, "batch", "--manifest", manifest, "-o", out, *QUICK]
    environment = dict(os.environ)
    with contextlib.ExitStack() as stack:
        done = lambda: done_in_store(out)
        if arguments.slurm:
            sys.path.insert(0, str(ROOT / "tests" / "slurm"))
            import cluster  # needs root and slurm-wlm
            environment = stack.enter_context(cluster.Cluster(scratch / "cluster")).environment
            command += ["--engine", "slurm"]
            done = lambda: done_by_shards(out)
        else:
            command += ["--jobs", arguments.jobs]
        seconds, killed, is_whole = run_under_kills(command, out, arguments.kill, arguments.seconds, done, environment)
    got = counts(out)
    print(f"{arguments.models} models, {'Slurm' if arguments.slurm else f'{arguments.jobs} workers'}: "
          f"{seconds:.0f} s, {processor_seconds():.0f} s of processor, {killed} workers killed, ended by itself: {is_whole}, "
          f"rows: {got}, {(out / 'results.sqlite').stat().st_size / 1e6:.0f} MB", flush=True)
    good = got.get("failed", 0) == 0 and (not is_whole or got.get("done", 0) == arguments.models)
    good &= timed("results verify", [arguments.program, "results", "verify", out])
    if is_whole:
        resume = command[:-2] if arguments.slurm else command
        good &= timed("resume of all that is done", resume)
        good &= timed("overview (index.html)", [a for a in resume if a != "--no-overview"])
    return good and ask(arguments.program, out, scratch)


def ask(program, out, scratch):
    """Times of queries and of an export."""
    good = True
    for flags in (["--status", "failed"], ["--where", "best_fraction<0.4", "--limit", "20"],
                  ["--sort", "best_fraction", "--limit", "20"]):
        good &= timed(f"results query {' '.join(flags)}", [program, "results", "query", out, *flags])
    return good & timed("results export to CSV", [program, "results", "export", out, "-o", scratch / "all.csv"])


def grow_store(store, rows):
    """Copies of the rows that are there under other keys, contents and folders."""
    with contextlib.closing(sqlite3.connect(store)) as book:
        have = book.execute("SELECT COUNT(*) FROM models").fetchone()[0]
        columns = [r[1] for r in book.execute("PRAGMA table_info(models)")]
        changed = {"key": "key || '-' || n", "position": "position + n * :have", "folder": "folder || '-' || n",
                   "content": "substr(content, 1, 52) || printf('%012d', n * :have + position)"}
        chosen = ", ".join(changed.get(c, c) for c in columns)
        numbers = "WITH RECURSIVE copies(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM copies WHERE n < :most)"
        book.execute(f"INSERT INTO models {numbers} SELECT {chosen} FROM models, copies", {"have": have, "most": rows // have - 1})
        book.execute(f"INSERT INTO timings {numbers} SELECT key || '-' || n, seconds, peak_bytes, attempts, finished_ms "
                     "FROM timings, copies", {"most": rows // have - 1})
        book.commit()
        return book.execute("SELECT COUNT(*) FROM models").fetchone()[0]


def measure_rows(arguments, scratch):
    """Times of a store of so many rows, of which one in a thousand was made and the rest copied."""
    manifest = write_models(scratch, arguments.rows // 1000)
    out = scratch / "out"
    command = [arguments.program, "batch", "--manifest", manifest, "-o", out, "--jobs", arguments.jobs, *QUICK]
    subprocess.run([str(c) for c in command], check=True)
    rows = grow_store(out / "results.sqlite", arguments.rows)
    print(f"{rows} rows, {(out / 'results.sqlite').stat().st_size / 1e6:.0f} MB")
    good = timed("resume of the models that are in the list", command)
    good &= ask(arguments.program, out, scratch)
    good &= timed("overview (index.html)", [a for a in command if a != "--no-overview"])
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--models", type=int, default=100_000)
    parser.add_argument("--kill", type=float, default=0.01, help="workers killed for each model")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seconds", type=float, default=3000)
    parser.add_argument("--slurm", action="store_true")
    parser.add_argument("--rows", type=int, default=0)
    arguments = parser.parse_args()
    arguments.program = arguments.program.resolve()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="vantage-store-"))
    try:
        good = measure_rows(arguments, folder) if arguments.rows else check_kills(arguments, folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
