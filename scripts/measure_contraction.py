#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures contraction and skeletons on real models and prints the tables of docs/lab/2026-11-contraction.md as Markdown.

    measure_contraction.py fidelity  PROGRAM MODEL...   --contraction auto against exact: the two maps, the best views
    measure_contraction.py parts     PROGRAM MODEL...   whether auto's levels or its graph make its map differ from exact's
    measure_contraction.py limit     PROGRAM MODEL...   exact against exact of the model moved by 10^-4 D: what auto can
                                                        be asked for
    measure_contraction.py noise     PROGRAM CLEAN NOISY...  thickness of clouds of the noisy files' vertices against
                                                        that of the clean file's surface; vertices in the same order
    measure_contraction.py scale     PROGRAM MODEL [VERTICES]   the model subdivided: seconds and peak memory a vertex
    measure_contraction.py interrupt PROGRAM MODEL      seconds from SIGINT to the end, at many moments of many commands
    measure_contraction.py files     PROGRAM FOLDER [EVERY]  how every EVERYth file of a folder ends under 60 s and 4 GB

Needs numpy."""
import json
import math
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time

import numpy

TYPES = {"char": "i1", "uchar": "u1", "int": "<i4", "uint": "<u4", "float": "<f4", "double": "<f8"}
FLAT_LEVEL = 0.06  # the program's default
FILE_SECONDS, FILE_BYTES = 60, 4 << 30
SUFFIXES = {".obj", ".off", ".ply", ".stl", ".gltf", ".glb", ".xyz", ".gz", ".drc", ".pts", ".pwn", ".pcd", ".3mf", ".txt"}
MOMENTS = (0.05, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9)  # of the whole command


def run(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else str(done.returncode))
    return done.stdout


def table(*columns):
    print("| " + " | ".join(columns) + " |\n" + "| --- " * len(columns) + "|", flush=True)


def row(*cells):
    print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def read_ply(path):
    """Vertex columns by name, and the triangles, of a binary PLY of ours."""
    head, body = pathlib.Path(path).read_bytes().split(b"end_header\n", 1)
    counts, columns, element = {}, [], ""
    for line in head.decode().splitlines():
        word = line.split()
        if word[:1] == ["element"]:
            element = word[1]
            counts[element] = int(word[2])
        elif word[:1] == ["property"] and element == "vertex":
            columns.append((word[2], TYPES[word[1]]))
    vertices = numpy.frombuffer(body, numpy.dtype(columns), counts["vertex"])
    faces = numpy.frombuffer(body, numpy.dtype([("n", "u1"), ("v", "<i4", 3)]), counts.get("face", 0), vertices.nbytes)
    return vertices, faces["v"]


def points_of(vertices):
    return numpy.stack([vertices[c].astype(float) for c in "xyz"], axis=1)


def write_ply(path, points, faces):
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\n"
            f"property double z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    records = numpy.empty(len(faces), numpy.dtype([("n", "u1"), ("v", "<i4", 3)]))
    records["n"], records["v"] = 3, faces
    with open(path, "wb") as file:
        file.write(head.encode() + points.astype("<f8").tobytes() + records.tobytes())


def ranks(values):
    """Ranks, the mean one where values are equal."""
    _, place, count = numpy.unique(values, return_inverse=True, return_counts=True)
    return (numpy.cumsum(count) - 0.5 * (count + 1))[place]


def spearman(a, b):
    return numpy.corrcoef(ranks(a), ranks(b))[0, 1]


def quality(program, model, *flags):
    with tempfile.TemporaryDirectory() as folder:
        run(program, "map", model, "-o", folder + "/map.ply", "-q", *flags)
        return read_ply(folder + "/map.ply")[0]["quality"].astype(float)


def best_view_ratio(program, model, folder):
    """What auto's best view scores under the exact map, against exact's own; and auto's strategies."""
    lines, strategies = ["dx,dy,dz"], []
    for method in ("auto", "exact"):
        report = json.loads(run(program, "view", model, "-o", folder + "/view", "--no-images", "--json", "--prior", "none",
                                "--contraction", method))
        lines.append(",".join(map(repr, report["best"]["direction"])))
        strategies.append(report["contraction"]["strategy"])
    directions = pathlib.Path(folder, "directions.csv")
    directions.write_text("\n".join(lines) + "\n", encoding="utf-8")
    rows = run(program, "score", model, "--directions", directions, "--contraction", "exact").split()[1:]
    auto, exact = (float(line.split(",")[-1]) for line in rows)
    return auto / exact, strategies[0]


def fidelity(program, *models):
    table("model", "vertices", "strategy", "Spearman", "largest difference, % of the range", "best view's score")
    kept, all_models = 0, 0
    for model in models:
        with tempfile.TemporaryDirectory() as folder:
            try:
                auto, exact = (quality(program, model, "--contraction", m) for m in ("auto", "exact"))
                ratio, strategy = best_view_ratio(program, model, folder)
            except RuntimeError as error:
                print(f"{model}: {error}", file=sys.stderr)
                continue
        span = 100 * numpy.abs(auto - exact).max() / (exact.max() - exact.min())
        agreement = spearman(auto, exact)
        kept += agreement >= 0.98 or span <= 2
        all_models += 1
        row(pathlib.Path(model).name, len(auto), ", ".join(sorted(set(strategy))), f"{agreement:.4f}", f"{span:.1f}", f"{ratio:.4f}")
    print(f"\n{kept} of {all_models} with a Spearman of at least 0.98 or no vertex off by more than 2 %")


def distance_to_graph(points, nodes, edges):
    squared = numpy.full(len(points), math.inf)
    for a, b in [(i, i) for i in range(len(nodes))] + list(edges):
        along = nodes[b] - nodes[a]
        share = numpy.clip((points - nodes[a]) @ along / max(along @ along, sys.float_info.min), 0.0, 1.0)
        squared = numpy.minimum(squared, ((points - nodes[a] - share[:, None] * along) ** 2).sum(1))
    return numpy.sqrt(squared)


def significance(levels, graph, diameter):
    """The map of docs/kssm.md by its formulas, with the default options."""
    total = numpy.zeros(len(levels[0]))
    for level, points in enumerate(levels):
        distance = distance_to_graph(points, *graph)
        span = numpy.ptp(distance)
        if level == 0 or span > FLAT_LEVEL * diameter:
            share = (distance - distance.min()) / span
            total += (1 - (share.sum() - 1) / (len(share) - 1)) ** 2 * share
    return total


def parts(program, *models):
    table("model", "nodes, auto / exact", "auto's map", "auto's levels, exact's graph", "exact's levels, auto's graph")
    for model in models:
        levels, graphs = {}, {}
        diameter = json.loads(run(program, "info", model, "--json"))["diameter"]
        for method in ("auto", "exact"):
            with tempfile.TemporaryDirectory() as folder:
                run(program, "skeleton", model, "-o", folder + "/s.json", "-q", "--contraction", method, "--no-centre",
                    "--no-prune", "--levels", folder)
                graph = json.loads(pathlib.Path(folder, "s.json").read_text(encoding="utf-8"))
                graphs[method] = numpy.array(graph["nodes"]), graph["edges"]
                levels[method] = [points_of(read_ply(file)[0]) for file in sorted(pathlib.Path(folder).glob("level-*.ply"))]
        exact = significance(levels["exact"], graphs["exact"], diameter)
        cells = [spearman(significance(levels[a], graphs[b], diameter), exact)
                 for a, b in (("auto", "auto"), ("auto", "exact"), ("exact", "auto"))]
        row(pathlib.Path(model).name, f"{len(graphs['auto'][0])} / {len(graphs['exact'][0])}", *(f"{c:.4f}" for c in cells))


def limit(program, *models):
    table("model", "vertices", "Spearman of exact and exact, moved by 10^-4 D")
    for model in models:
        with tempfile.TemporaryDirectory() as folder:
            run(program, "map", model, "-o", folder + "/map.ply", "-q", "--contraction", "exact")
            vertices, faces = read_ply(folder + "/map.ply")
            points = points_of(vertices)
            size = numpy.linalg.norm(points.max(axis=0) - points.min(axis=0))
            noise = numpy.random.default_rng(1).normal(size=points.shape)
            noise *= 1e-4 * size / numpy.linalg.norm(noise, axis=1, keepdims=True)
            write_ply(folder + "/moved.ply", points + noise, faces)
            moved = quality(program, folder + "/moved.ply", "--contraction", "exact")
            row(pathlib.Path(model).name, len(points), f"{spearman(vertices['quality'], moved):.4f}")


def noise(program, clean, *noisy):
    reference = quality(program, clean, "--method", "thickness")
    table("cloud", "points", "Spearman of d^(0) to the clean surface", "cycles", "components")
    with tempfile.TemporaryDirectory() as folder:
        for model in (clean, *noisy):
            run(program, "map", model, "-o", folder + "/surface.ply", "-q")
            points = points_of(read_ply(folder + "/surface.ply")[0])
            cloud = folder + "/cloud.xyz"
            numpy.savetxt(cloud, points, fmt="%.9g")
            thickness = quality(program, cloud, "--method", "thickness")
            r = json.loads(run(program, "skeleton", cloud, "-o", folder + "/s.json", "--json"))
            row(pathlib.Path(model).name, len(points), f"{spearman(thickness, reference):.3f}", r["cycles"],
                r["components"])


def subdivided(points, faces):
    """Every triangle in four, new vertices at the middles of edges."""
    sides = numpy.sort(numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, place = numpy.unique(sides, axis=0, return_inverse=True)
    place = place.reshape(-1)
    ab, bc, ca = (place.reshape(3, -1) + len(points))
    a, b, c = faces.T
    split = numpy.concatenate([numpy.stack(t, axis=1) for t in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))])
    return numpy.concatenate([points, points[edges].mean(axis=1)]), split


def measured(program, model, folder):
    """Wall and processor seconds and peak bytes of `map`."""
    start = time.monotonic()
    child = subprocess.Popen([program, "map", model, "-o", folder + "/map.ply", "-q"])
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise RuntimeError(f"map ended with {child.returncode}")
    return time.monotonic() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def scale(program, model, vertices="3000000"):
    table("vertices", "wall s", "CPU s", "CPU µs a vertex", "peak MB", "KB a vertex")
    with tempfile.TemporaryDirectory() as folder:
        run(program, "map", model, "-o", folder + "/map.ply", "-q")
        columns, faces = read_ply(folder + "/map.ply")
        points = points_of(columns)
        while True:
            write_ply(folder + "/model.ply", points, faces)
            wall, cpu, peak = measured(program, folder + "/model.ply", folder)
            row(len(points), f"{wall:.1f}", f"{cpu:.1f}", f"{1e6 * cpu / len(points):.1f}", f"{peak / 2**20:.0f}",
                f"{peak / 1000 / len(points):.2f}")
            if len(points) >= int(vertices):
                return
            points, faces = subdivided(points, faces)


def interrupted(command, after):
    """Seconds from SIGINT to the end and the exit code, or nothing if the command was done before."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        child.wait(timeout=after)
        return None
    except subprocess.TimeoutExpired:
        pass
    start = time.monotonic()
    child.send_signal(signal.SIGINT)
    code = child.wait()
    return time.monotonic() - start, code


def interrupt(program, model):
    table("command", "whole, s", "moments", "slowest answer, s", "exit codes", "left behind")
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        os.mkdir(out)
        cloud = os.path.join(folder, "cloud.xyz")
        run(program, "map", model, "-o", folder + "/map.ply", "-q")
        numpy.savetxt(cloud, points_of(read_ply(folder + "/map.ply")[0]), fmt="%.9g")
        for name, command in (
                ("skeleton, auto", ("skeleton", model, "-o", out + "/s.json")),
                ("skeleton, exact", ("skeleton", model, "-o", out + "/s.json", "--contraction", "exact")),
                ("skeleton of the points", ("skeleton", cloud, "-o", out + "/s.json")),
                ("map", ("map", model, "-o", out + "/m.ply")),
                ("view", ("view", model, "-o", out + "/view")),
                ("view, dense search", ("view", model, "-o", out + "/view", "--search", "dense", "--no-images"))):
            start = time.monotonic()
            try:
                subprocess.run([program, *command], capture_output=True, check=True, timeout=40)
            except subprocess.TimeoutExpired:
                pass
            whole = time.monotonic() - start
            for kept in sorted(pathlib.Path(out).rglob("*"), reverse=True):
                kept.rmdir() if kept.is_dir() else kept.unlink()
            ends = [end for share in MOMENTS if (end := interrupted([program, *command], share * whole))]
            left = [p.name for p in pathlib.Path(out).rglob("*") if p.is_file()] if all(c == 130 for _, c in ends) else ["?"]
            row(name, f"{whole:.1f}", len(ends), f"{max((s for s, _ in ends), default=math.nan):.2f}",
                ", ".join(map(str, sorted({c for _, c in ends}))), len(left))


def files(program, folder, every="1"):
    def limits():
        resource.setrlimit(resource.RLIMIT_AS, (FILE_BYTES, FILE_BYTES))
    names = {0: "done", 1: "cannot be skeletonised, says why", 3: "unreadable, says why"}
    endings, slowest = {}, (0.0, "")
    folder = pathlib.Path(folder)
    found = sorted(p for p in folder.rglob("*") if p.is_file() and p.suffix.lower() in SUFFIXES)
    with tempfile.TemporaryDirectory() as out:
        for file in found[::int(every)]:
            start = time.monotonic()
            try:
                done = subprocess.run([program, "skeleton", file, "-o", out + "/s.json", "-q"], capture_output=True,
                                      timeout=FILE_SECONDS, preexec_fn=limits, check=False)
                ending = names.get(done.returncode, f"crashed ({done.returncode})")
            except subprocess.TimeoutExpired:
                ending = "hung"
            slowest = max(slowest, (time.monotonic() - start, file.name))
            endings.setdefault(ending, []).append(str(file.relative_to(folder)))
    table("ending", "files")
    for ending in sorted(endings):
        row(ending, len(endings[ending]))
    for ending in sorted(e for e in endings if e == "hung" or e.startswith("crashed")):
        print(ending + ": " + ", ".join(endings[ending]))
    print(f"\nslowest: {slowest[1]}, {slowest[0]:.1f} s")


COMMANDS = {"fidelity": fidelity, "parts": parts, "limit": limit, "noise": noise, "scale": scale, "interrupt": interrupt,
            "files": files}

if __name__ == "__main__":
    if len(sys.argv) < 4 or sys.argv[1] not in COMMANDS:
        sys.exit(__doc__)
    COMMANDS[sys.argv[1]](*sys.argv[2:])
