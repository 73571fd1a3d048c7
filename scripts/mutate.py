#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Changes one operator or constant of the method at a time and asks whether the tests notice.

    mutate.py [--count 50] [--seed 1] [--build build/mutate] [FILE…]

Works on a copy of the tree; rebuilds what the change touches, runs the unit and property tests of the module, then of the
other modules of the method, and lists the mutants that no test killed. Before the first, the tests have to pass on the
copy as it is. Exit code 1: they do not, or the share of killed ones is below --least (0.9).
"""
import argparse
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
MODULES = ("contraction", "skeleton", "significance", "visibility", "view")
# What is replaced by what; the spaces are those of clang-format, so templates and pointers are left alone.
SWAPS = ((" + ", " - "), (" - ", " + "), (" * ", " / "), (" / ", " * "), (" < ", " <= "), (" > ", " >= "),
         (" <= ", " < "), (" >= ", " > "), (" == ", " != "), (" != ", " == "), (" && ", " || "), (" || ", " && "),
         ("std::min(", "std::max("), ("std::max(", "std::min("), (" += ", " -= "), ("++", "--"))
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d+|\d+)(?![\w.])")


def code_part(line):
    """The line without comments and strings; empty for lines that only declare or print."""
    if re.match(r"\s*(//|#|throw|using|namespace|template|run\.|///)", line):
        return ""
    return re.sub(r'"[^"]*"', lambda text: " " * len(text.group()), line.split("//")[0])


def mutants_of(path):
    """Every (path, line number, column, old text, new text) of a file."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines()):
        code = code_part(line)
        for old, new in SWAPS:
            for found in re.finditer(re.escape(old), code):
                yield path, number, found.start(), old, new
        for found in NUMBER.finditer(code):
            old = found.group()
            yield path, number, found.start(), old, str(float(old) * 1.5 + 0.5) if "." in old else str(int(old) + 1)


def apply(mutant, tree):
    path, number, column, old, new = mutant
    target = tree / path.relative_to(ROOT)
    before = target.read_text(encoding="utf-8")
    lines = before.splitlines(keepends=True)
    line = lines[number]
    lines[number] = line[:column] + new + line[column + len(old):]
    target.write_text("".join(lines), encoding="utf-8")
    return target, before


def run(command, folder, seconds):
    try:
        return subprocess.run(command, cwd=folder, capture_output=True, check=False, timeout=seconds).returncode
    except subprocess.TimeoutExpired:
        return None


def judged(tree, build, modules, seconds, build_seconds=1200):
    """"killed", "survived" or "not compiled", by the tests of these modules, then of the method's others."""
    for name in dict.fromkeys((*modules, *MODULES)):
        targets = [f"{layer}_{name}" for layer in ("unit", "property")
                   if (tree / f"tests/{layer}/{name}/CMakeLists.txt").exists()]
        if run(["cmake", "--build", build, "-j", str(os.cpu_count()), "--target", *targets], tree, build_seconds) != 0:
            return "not compiled"
        for target in targets:
            layer = target.split("_")[0]
            if run([build / "tests" / layer / name / target], build, seconds) != 0:
                return "killed"
    return "survived"


def refuse_broken(tree, build, modules, seconds):
    """Ends the script where tests fail without a change: they would seem to notice every one."""
    verdict = judged(tree, build, modules, seconds, None)  # the first build takes as long as it takes
    if verdict != "survived":
        what = "does not compile" if verdict == "not compiled" else "fails its tests"
        sys.exit(f"{tree}: {what} without any change, so that no mutant would tell anything")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=pathlib.Path, help="sources; default: those of the method")
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/mutate")
    parser.add_argument("--timeout", type=float, default=300.0, help="seconds for the tests; what hangs is killed")
    parser.add_argument("--least", type=float, default=0.9)
    options = parser.parse_args()
    files = [path.resolve() for path in options.files] or [
        path for module in MODULES for path in sorted((ROOT / "src" / module).glob("*.cpp"))]
    every = [mutant for path in files for mutant in mutants_of(path)]
    chosen = random.Random(options.seed).sample(every, min(len(every), 4 * options.count))

    tree, build = options.build.resolve() / "tree", options.build.resolve() / "build"
    shutil.rmtree(tree, ignore_errors=True)
    tracked = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True, text=True).stdout
    for name in filter(None, tracked.split("\0")):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, tree / name)
    subprocess.run(["cmake", "-G", "Ninja", "-S", tree, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
                    "-DCMAKE_CXX_FLAGS_RELEASE=-O2"], check=True, capture_output=True)

    refuse_broken(tree, build, sorted({path.parent.name for path, *_ in chosen}), options.timeout)
    counts = {"killed": 0, "survived": 0}
    for mutant in chosen:
        if sum(counts.values()) == options.count:
            break
        path, number, _, old, new = mutant
        target, before = apply(mutant, tree)
        verdict = judged(tree, build, [path.parent.name], options.timeout)
        target.write_text(before, encoding="utf-8")
        if verdict in counts:
            counts[verdict] += 1
        text = before.splitlines()[number].strip()
        print(f"{verdict:12} {path.relative_to(ROOT)}:{number + 1} {old.strip()} -> {new.strip()}    {text}", flush=True)
    share = counts["killed"] / max(1, sum(counts.values()))
    print(f"{counts['killed']} of {sum(counts.values())} killed, {100 * share:.0f} %")
    sys.exit(share < options.least)


if __name__ == "__main__":
    main()
