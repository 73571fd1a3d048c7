#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Times our contraction and skeleton against CGAL's, in alternation, and prints a Markdown table.

    bench/peers/compare.py --ours build/release/apps/vantage/vantage --peer build/peers/cgal_skeleton \
        [--runs 3] MESH…

Meshes must be closed, triangulated and in one piece. Both read the same PLY. The least
time of all runs counts; reading files is not counted for either. Memory is the peak of the whole
process, reading included."""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile


def run(command):
    """Standard output, user seconds and peak resident megabytes of a command."""
    with tempfile.TemporaryFile() as out:
        child = subprocess.Popen(command, stdout=out, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode != 0:
            raise RuntimeError(f"{command[0]} failed with {child.returncode}")
        out.seek(0)
        return out.read().decode(), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ours", required=True)
    parser.add_argument("--peer", required=True)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("meshes", nargs="+")
    args = parser.parse_args()
    print("| mesh | vertices | CGAL s | ours s | ratio | `view` s | CGAL / `view` | CGAL MB | ours MB |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for mesh in args.meshes:
        with tempfile.TemporaryDirectory() as folder:
            same = str(pathlib.Path(folder) / "mesh.ply")
            skeleton = str(pathlib.Path(folder) / "skeleton.json")
            run([args.ours, "map", mesh, "-o", same, "-q"])
            view_folder = str(pathlib.Path(folder) / "view")
            best = {"peer": 1e30, "ours": 1e30, "view": 1e30}
            peak = {"peer": 0.0, "ours": 0.0}
            vertices = 0
            for _ in range(args.runs):
                out, _, memory = run([args.peer, same])
                best["peer"] = min(best["peer"], float(out.split()[0]))
                peak["peer"] = max(peak["peer"], memory)
                _, _, memory = run([args.ours, "skeleton", same, "-o", skeleton, "-q"])
                peak["ours"] = max(peak["ours"], memory)
                out, _, _ = run([args.ours, "view", same, "-o", view_folder, "--no-images", "--json"])
                report = json.loads(out)
                seconds = report["seconds"]
                vertices = report["model"]["vertices"]
                best["ours"] = min(best["ours"], seconds["contract"] + seconds["skeleton"])
                best["view"] = min(best["view"], seconds["total"])
            print(f"| {pathlib.Path(mesh).stem} | {vertices} | {best['peer']:.2f} | {best['ours']:.2f} "
                  f"| {best['peer'] / best['ours']:.1f} | {best['view']:.2f} "
                  f"| {best['peer'] / best['view']:.1f} | {peak['peer']:.0f} | {peak['ours']:.0f} |")
            sys.stdout.flush()
    return 0


if __name__ == "__main__":
    sys.exit(main())
