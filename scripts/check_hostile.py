#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the program over every file of a folder and checks how it ends: by itself, in time, within memory, in one sentence.

    check_hostile.py FOLDER [--program build/release/apps/vantage/vantage] [--command info|view|…|all] [--seconds 60]
                     [--max-memory 4GB] [--timeout SECONDS] [--stride N] [--largest BYTES] [--most-bytes N] [--table]

--timeout is the program's own, --seconds this script's; --table counts by ending, and how often vantage-import broke down.
Prints a table of exit codes, the slowest files and those with the largest peak of memory for each byte; exit code 1 if a
run crashed, hung, failed without one clear sentence, or took more than --most-bytes of memory for each byte of its file
(and 100 MB for itself), or if there was nothing to run. Works with a sanitizer's build too (without --max-memory).
"""
import argparse
import collections
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import break_models

MODELS = {".obj", ".off", ".ply", ".stl", ".gltf", ".glb", ".3mf", ".amf", ".xyz", ".pcd", ".pts", ".pwn", ".gz", ".drc", ".txt",
          ".wrl", ".zip", *("." + ending for ending in break_models.FORMATS.split(","))}
ITSELF = 100e6  # bytes that the program takes for a file of a few
SMALL = 1 << 20  # bytes: below, the program itself is most of the memory


def run(arguments, folder, seconds):
    """Exit code (None: it took too long), seconds, peak of memory in bytes, what it said."""
    with tempfile.TemporaryFile() as said:
        start = time.monotonic()
        process = subprocess.Popen(arguments, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=said)
        status = None
        while status is None and time.monotonic() - start < seconds:
            pid, code, usage = os.wait4(process.pid, os.WNOHANG)
            status = code if pid else None
            time.sleep(0.002)
        took = time.monotonic() - start
        if status is None:
            process.kill()
            _, _, usage = os.wait4(process.pid, 0)
        process.returncode = 0  # it has been waited for
        said.seek(0)
        code = None if status is None else os.waitstatus_to_exitcode(status)
        return code, took, usage.ru_maxrss * 1024, said.read().decode(errors="replace").strip()


def problem_of(code, words):
    if code is None:
        return "took too long"
    if code not in (0, 1, 3):
        return f"exit code {code}: {words[-300:]}"
    if code != 0 and len(words.splitlines()) != 1:
        return f"not one sentence: {words[-300:]}"
    return None


# What each command that reads a model is asked for, as little as makes it run its own code.
COMMANDS = {"info": [], "view": ["-o", "out", "--no-images", "--search", "rapid"], "map": ["-o", "map.ply"],
            "skeleton": ["-o", "graph.obj"], "thumb": ["-o", "thumb.png", "--size", "64"],
            "render": ["-o", "picture.png", "--size", "64", "--direction", "1,0.6,1"], "orient": ["--print"],
            "score": ["--sphere", "0", "-o", "scores.csv"],
            "compare": ["-o", "compared", "--method", "kssm,viewpoint-entropy", "--no-images"],
            "figures": ["-o", "figures", "--views", "2", "--size", "64x64", "--search", "rapid"],
            "batch": ["-o", "batch", "--search", "rapid", "--size", "64", "--jobs", "1"]}

OUTCOMES = ("read", "refused", "reader broke down", "limit", "other")


def outcome_of(code, words):
    if code == 0:
        return "read"
    if "--timeout" in words or "memory" in words and "broke down" not in words:
        return "limit"
    return "reader broke down" if "broke down" in words else "refused" if code == 3 else "other"


def print_table(kinds):
    print("| ending | files |", " | ".join(OUTCOMES), "|\n|" + " --- |" * (2 + len(OUTCOMES)))
    for ending, counts in [*sorted(kinds.items()), ("all", sum(kinds.values(), collections.Counter()))]:
        print(f"| {ending} | {sum(counts.values())} |", " | ".join(str(counts[o]) for o in OUTCOMES), "|")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--program", default="build/release/apps/vantage/vantage")
    parser.add_argument("--command", choices=(*COMMANDS, "all"), default="info")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--max-memory", default="")
    parser.add_argument("--timeout", default="")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--stride", type=int, default=1)
    parser.add_argument("--largest", type=float, default=float("inf"), help="of the files that are run")
    parser.add_argument("--most-bytes", type=float, default=0.0)
    options = parser.parse_args()
    if options.command == "all" and options.most_bytes > 0:
        parser.error("--most-bytes goes with one command")
    files = sorted(p for p in options.folder.resolve().rglob("*")
                   if p.is_file() and p.suffix.lower() in MODELS and p.stat().st_size <= options.largest)
    if not files:  # a mistyped folder must not pass
        sys.exit(f"{options.folder}: holds no file to check")
    commands = COMMANDS if options.command == "all" else (options.command,)
    problems = [problem for command in commands for problem in check(command, files[::options.stride], options)]
    sys.exit(1 if problems else 0)


def check(command, files, options):
    """Runs a command over the files and prints what came of it. Returns the problems."""
    program = str(pathlib.Path(options.program).resolve())
    codes, problems, slowest, hungriest = collections.Counter(), [], [], []
    kinds = collections.defaultdict(collections.Counter)
    for file in files:
        flags = [*COMMANDS[command], "-q"]
        if options.max_memory:
            flags += ["--max-memory", options.max_memory]
        if options.timeout:
            flags += ["--timeout", options.timeout]
        with tempfile.TemporaryDirectory() as scratch:
            code, took, peak, words = run([program, command, str(file), *flags], scratch, options.seconds)
        if command == "batch" and code == 4:
            code, words = 3, "refused"  # as the store says
        codes[code] += 1
        kinds[file.suffix.lower()][outcome_of(code, words)] += 1
        name = str(file.relative_to(options.folder.resolve()))
        problem = problem_of(code, words)
        size = file.stat().st_size
        if options.most_bytes > 0 and peak > options.most_bytes * size + ITSELF:
            problem = problem or f"took {peak / 1e6:.0f} MB for {size} bytes"
        if problem:
            problems.append(f"{name}: {problem}")
        slowest.append((took, name))
        if size >= SMALL:
            hungriest.append((peak / size, name, peak))
    print(f"{len(files)} files, {command}; exit codes: " +
          ", ".join(f"{code}: {count}" for code, count in sorted(codes.items(), key=str)), flush=True)
    if options.table:
        print_table(kinds)
    for took, name in sorted(slowest)[-3:]:
        print(f"  {took:8.2f} s  {name}")
    for ratio, name, peak in sorted(hungriest)[-3:]:
        print(f"  {ratio:8.1f} bytes of memory a byte of the file ({peak / 1e6:.0f} MB)  {name}")
    for problem in problems:
        print("WRONG:", problem, flush=True)
    return problems


if __name__ == "__main__":
    main()
