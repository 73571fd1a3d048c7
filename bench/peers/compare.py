#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Times our contraction and skeleton against CGAL's, in alternation: a Markdown table and a log-log plot.

    bench/peers/compare.py --ours build/release/apps/vantage/vantage --call build/release/bench/skeleton_call \
        --peer build/peers/cgal_skeleton [--runs 3] [--plot FILE.svg] [--into docs/lab/YYYY-MM-performance.md] MESH…

Meshes must be closed, triangulated and in one piece. Both read the same PLY. Of all runs the least wall time
of the call itself counts (reading files does not), and the least processor time of it, all threads together, which
other work on the machine disturbs less. Memory is the largest peak of the whole process. --into replaces the text between the two lines
"<!-- peers -->" of a document."""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

COLUMNS = ("mesh", "vertices", "CGAL s", "ours s", "ratio", "CGAL CPU s", "ours CPU s", "CPU ratio", "`view` s",
           "CGAL / `view`", "`view` CPU s", "CPU ratio of `view`", "CGAL MB", "ours MB")
WIDTH, HEIGHT, MARGIN = 640, 420, 56


def run(command):
    """Standard output, processor seconds and peak resident megabytes of a command."""
    with tempfile.TemporaryFile() as out:
        child = subprocess.Popen(command, stdout=out, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode != 0:
            raise RuntimeError(f"{command[0]} failed with {child.returncode}")
        out.seek(0)
        return out.read().decode(), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def compare(ours, call, peer, mesh, runs):
    """Least seconds, least processor seconds and peak megabytes of both, and the number of vertices."""
    least, peak = {}, {"peer": 0.0, "ours": 0.0}

    def note(key, seconds):
        least[key] = min(seconds, least.get(key, math.inf))
    with tempfile.TemporaryDirectory() as folder:
        same, skeleton = os.path.join(folder, "mesh.ply"), os.path.join(folder, "skeleton.json")
        run([ours, "map", mesh, "-o", same, "-q"])
        for _ in range(runs):
            out, _, memory = run([peer, same])
            note("peer", float(out.split()[0]))
            note("peer cpu", float(out.split()[1]))
            peak["peer"] = max(peak["peer"], memory)
            out, _, _ = run([call, same])
            note("ours", float(out.split()[0]))
            note("ours cpu", float(out.split()[1]))
            _, _, memory = run([ours, "skeleton", same, "-o", skeleton, "-q"])
            peak["ours"] = max(peak["ours"], memory)
            out, cpu, _ = run([ours, "view", same, "-o", os.path.join(folder, "view"), "--no-images", "--json"])
            note("view cpu", cpu)
            report = json.loads(out)
            note("view", report["seconds"]["total"])
    return least, peak, report["model"]["vertices"]


def row(mesh, least, peak, vertices):
    return (pathlib.Path(mesh).stem, vertices, f"{least['peer']:.2f}", f"{least['ours']:.2f}",
            f"{least['peer'] / least['ours']:.1f}", f"{least['peer cpu']:.2f}", f"{least['ours cpu']:.2f}",
            f"{least['peer cpu'] / least['ours cpu']:.1f}", f"{least['view']:.2f}",
            f"{least['peer'] / least['view']:.1f}", f"{least['view cpu']:.2f}",
            f"{least['peer cpu'] / least['view cpu']:.1f}", f"{peak['peer']:.0f}", f"{peak['ours']:.0f}")


def line(cells):
    return "| " + " | ".join(map(str, cells)) + " |"


def plot(points):
    """An SVG of seconds over vertices, both axes logarithmic; points are (vertices, CGAL s, our s)."""
    xs = [math.log10(p[0]) for p in points]
    ys = [math.log10(s) for p in points for s in p[1:]]
    x_range, y_range = (math.floor(min(xs) * 4) / 4, math.ceil(max(xs) * 4) / 4), (math.floor(min(ys)), math.ceil(max(ys)))

    def at(vertices, seconds):
        x = MARGIN + (math.log10(vertices) - x_range[0]) / (x_range[1] - x_range[0]) * (WIDTH - 2 * MARGIN)
        y = HEIGHT - MARGIN - (math.log10(seconds) - y_range[0]) / (y_range[1] - y_range[0]) * (HEIGHT - 2 * MARGIN)
        return x, y
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
             f'font-size="12"><rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for decade in range(y_range[0], y_range[1] + 1):
        (left, y), right = at(10 ** x_range[0], 10 ** decade), WIDTH - MARGIN
        parts.append(f'<path d="M{left:.1f} {y:.1f}H{right}" stroke="#ddd"/>'
                     f'<text x="{left - 6:.1f}" y="{y + 4:.1f}" text-anchor="end">{10 ** decade:g} s</text>')
    for vertices in (v * 10 ** e for e in range(3, 7) for v in (1, 2, 5)):
        if x_range[0] <= math.log10(vertices) <= x_range[1]:
            x, y = at(vertices, 10 ** y_range[0])
            parts.append(f'<path d="M{x:.1f} {y:.1f}V{MARGIN}" stroke="#ddd"/>'
                         f'<text x="{x:.1f}" y="{y + 16:.1f}" text-anchor="middle">{vertices // 1000}K</text>')
    for column, name, colour in ((1, "CGAL 5.5", "#c0504d"), (2, "Vantage", "#1f77b4")):
        for p in points:
            x, y = at(p[0], p[column])
            parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{colour}"/>')
        x, y = at(*max((p[0], p[column]) for p in points))
        parts.append(f'<text x="{x - 8:.1f}" y="{y - 10:.1f}" text-anchor="end" fill="{colour}">{name}</text>')
    parts.append(f'<text x="{WIDTH / 2}" y="{HEIGHT - 12}" text-anchor="middle">vertices</text>'
                 f'<text x="{WIDTH / 2}" y="28" text-anchor="middle">contraction and skeleton, seconds</text></svg>\n')
    return "\n".join(parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ours", required=True)
    parser.add_argument("--call", required=True)
    parser.add_argument("--peer", required=True)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--plot", type=pathlib.Path)
    parser.add_argument("--into", type=pathlib.Path)
    parser.add_argument("meshes", nargs="+")
    args = parser.parse_args()
    lines, points = [line(COLUMNS), "| --- " * len(COLUMNS) + "|"], []
    print("\n".join(lines))
    for mesh in args.meshes:
        try:
            least, peak, vertices = compare(args.ours, args.call, args.peer, mesh, args.runs)
        except RuntimeError as error:
            print(f"{mesh}: {error}", file=sys.stderr)
            continue
        points.append((vertices, least["peer"], least["ours"]))
        lines.append(line(row(mesh, least, peak, vertices)))
        print(lines[-1], flush=True)
    if args.plot:
        args.plot.write_text(plot(points), encoding="utf-8")
    if args.into:
        mark = "<!-- peers -->"
        before, _, after = args.into.read_text(encoding="utf-8").split(mark)
        picture = [f"![seconds over vertices]({os.path.relpath(args.plot, args.into.parent)})", ""] if args.plot else []
        args.into.write_text("\n".join([before + mark, *picture, *lines, mark]) + after, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
