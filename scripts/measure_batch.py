#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures what docs/batch.md promises of `vantage batch`: measure_batch.py PROGRAM [MODEL…]

Prints one line a number. Throughput is measured on the models given (10 000 to 50 000 vertices are meant);
without any, only what needs no model is measured. Absolute times depend on what else the machine does: compare
the ratios, and the processor seconds.
"""
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

BOX = """OFF
8 12 0
0 0 0\n0 0 1\n0 {h} 0\n0 {h} 1\n{w} 0 0\n{w} 0 1\n{w} {h} 0\n{w} {h} 1
3 0 1 3\n3 0 3 2\n3 4 6 7\n3 4 7 5\n3 0 4 5\n3 0 5 1\n3 2 3 7\n3 2 7 6\n3 0 2 6\n3 0 6 4\n3 1 5 7\n3 1 7 3
"""
FAST = ["--search", "rapid", "--write", "json", "-q", "--no-overview"]


def run(arguments, codes=(0,)):
    """Seconds of wall clock and of processor, and the largest resident memory of the program itself, MB."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    begin = time.monotonic()
    process = subprocess.Popen([str(a) for a in arguments], stdout=subprocess.DEVNULL)
    peak = 0.0
    while process.poll() is None:  # what wait4() reports would count this script's memory before exec
        peak = max(peak, peak_of(process.pid))
        time.sleep(0.02)
    if process.returncode not in codes:
        sys.exit(f"{arguments[:3]}… ended with {process.returncode}")
    wall = time.monotonic() - begin
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return wall, cpu, peak


def peak_of(pid):
    """Largest resident memory of a process so far, MB; 0 if it has ended."""
    try:
        for line in pathlib.Path(f"/proc/{pid}/status").read_text(encoding="ascii").splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) / 1024
    except OSError:
        pass
    return 0.0


def many_small(folder, count):
    """A manifest of `count` small models, all different."""
    folder.mkdir()
    with open(folder / "list", "w", encoding="utf-8") as manifest:
        for i in range(count):
            (folder / f"{i:06}.off").write_text(BOX.format(w=1 + i * 1e-4, h=1 + i % 7 * 0.1))
            manifest.write(f"{i:06}.off\n")
    return folder / "list"


def resume(program, scratch, count):
    manifest = many_small(scratch / "small", count)
    wall, cpu, memory = run([program, "batch", "--manifest", manifest, "-o", scratch / "out", *FAST])
    print(f"{count} small models: {wall:.1f} s, {1000 * cpu / count:.2f} ms of processor each, parent {memory:.1f} MB")
    wall, cpu, memory = run([program, "batch", "--manifest", manifest, "-o", scratch / "out", *FAST])
    print(f"resume of {count} finished: {wall:.2f} s, {cpu:.2f} s of processor, parent {memory:.1f} MB")


def memory_of_long_lists(program, scratch):
    """Lists of models that are not there, so that it is the parent that is measured."""
    for count in (1_000, 10_000, 100_000):
        manifest = scratch / f"absent-{count}"
        manifest.write_text("".join(f"nowhere/model-{i:06}.ply\n" for i in range(count)))
        out = scratch / f"out-{count}"
        wall, cpu, memory = run([program, "batch", "--manifest", manifest, "-o", out, *FAST], codes=(4,))
        print(f"list of {count} absent models: parent {memory:.1f} MB, {wall:.1f} s, {cpu:.1f} s of processor")


def renamed_copies(folder, models):
    """Three more of each model that may end in a comment, so that the last one to end weighs little."""
    folder.mkdir()
    copies = []
    for model in models:
        for i in range(3 if model.suffix in (".obj", ".off") else 0):
            copy = folder / f"{i}-{model.name}"
            copy.write_bytes(model.read_bytes() + f"# {i}\n".encode())
            copies.append(copy)
    return copies


def throughput(program, scratch, models):
    """One worker against two, and against a loop over `view`, in turns; the best of three each."""
    flags = ["--search", "rapid", "--threads", "1", "-q"]
    models = models + renamed_copies(scratch / "copies", models)
    wall = {"one worker": [], "two workers": [], "loop of view": []}
    cpu = {name: [] for name in wall}
    for turn in range(3):
        for workers, name in ((1, "one worker"), (2, "two workers")):
            out = scratch / f"t-{turn}-{workers}"
            seconds = run([program, "batch", *models, "-o", out, *flags, "--write", "json", "--no-overview",
                           "--jobs", workers])
            wall[name].append(seconds[0])
            cpu[name].append(seconds[1])
            shutil.rmtree(out)
        totals = [run([program, "view", m, "-o", scratch / "v", *flags, "--no-images"]) for m in models]
        wall["loop of view"].append(sum(t[0] for t in totals))
        cpu["loop of view"].append(sum(t[1] for t in totals))
    for name in wall:
        print(f"{len(models)} models, {name}: {min(wall[name]):.2f} s, {min(cpu[name]):.2f} s of processor")
    print(f"two workers against one: {min(wall['one worker']) / min(wall['two workers']):.2f} times the throughput")
    print(f"batch against a loop of view: {min(cpu['one worker']) / min(cpu['loop of view']) - 1:+.1%} of processor")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    program = pathlib.Path(sys.argv[1]).resolve()
    print(json.dumps({"machine": os.uname().machine, "cores": os.cpu_count(), "load": os.getloadavg()}))
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        if len(sys.argv) > 2:
            throughput(program, scratch, [pathlib.Path(m).resolve() for m in sys.argv[2:]])
        resume(program, scratch, 10_000)
        memory_of_long_lists(program, scratch)


if __name__ == "__main__":
    main()
