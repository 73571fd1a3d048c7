#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether one surface has one map: makes meshes of the same surface and compares their maps and skeletons.

    measure_variants.py make  PROGRAM FOLDER MODEL...   writes the variants of each closed model to FOLDER/NAME/
    measure_variants.py table PROGRAM FOLDER [NAME...]  the table, as Markdown; one row a model, worst first
    measure_variants.py moved PROGRAM FILE...           any file, open and broken ones too: how each was contracted, the
                                                        correlation of its map with those of `moved` and `quartered`, and
                                                        the processor time of `map`; worst moved first
    measure_variants.py thickness PROGRAM MODEL...      how much of each model's map is thickness: their correlation

Variants: `moved` (every vertex by 10^-4 D, in a random direction), `quartered` (every triangle in four), `remeshed`
(isotropically, as many vertices: Voronoi cells of geodesic distance on a finer copy, Valette and Chassery 2004),
`halved` (half the vertices, by quadric errors), `flipped` (other diagonals of flat quads), and the model itself by
`--contraction exact`. A variant that this simple code cannot make with the model's genus is left out. A cell is the
Spearman correlation of the two maps over the model's vertices, each with the nearest vertex of the variant, and after
the semicolon the mean distance between the two skeletons over 2 r (0.04 D); c where their cycles differ.

Needs numpy and scipy."""
import collections
import functools
import heapq
import json
import pathlib
import re
import resource
import sys
import tempfile

import numpy
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from measure_contraction import FILE_BYTES, FILE_SECONDS, points_of, read_ply, run, spearman, subdivided, write_ply

SHIFT = 1e-4         # of `moved`, over D
FLAT = 1e-6          # 1 - cosine of the angle between two faces that lie in a plane
FINER = 12           # vertices that a cell of `remeshed` is made of, at least
ROUNDS = 12          # of Lloyd's iteration
TWO_SPACINGS = 0.04  # 2 r over D
VARIANTS = ("moved", "quartered", "remeshed", "halved", "flipped", "exact")
GOOD, FAIR = 0.95, 0.85  # the bars


def edges_of(faces):
    """Edges, sorted pairs, and how many faces each has."""
    sides = numpy.sort(numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    return numpy.unique(sides, axis=0, return_counts=True)


def characteristic(faces):
    """V - E + F of a closed surface; nothing where an edge has other than two faces."""
    edges, count = edges_of(faces)
    return len(numpy.unique(faces)) - len(edges) + len(faces) if len(faces) and (count == 2).all() else None


def moved(points, faces, diameter):
    noise = numpy.random.default_rng(1).normal(size=points.shape)
    return points + SHIFT * diameter * noise / numpy.linalg.norm(noise, axis=1, keepdims=True), faces


def quartered(points, faces, _):
    return subdivided(points, faces)


def flipped(points, faces, _):
    """The other diagonal of every convex flat quad, each face at most once; nothing where there is none."""
    faces, by_side = faces.copy(), {}
    for f, face in enumerate(faces):
        for k in range(3):
            by_side[face[k], face[(k + 1) % 3]] = f, face[(k + 2) % 3]
    normal = numpy.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    normal /= numpy.maximum(numpy.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    taken, present, count = set(), {tuple(sorted(e)) for e in by_side}, 0
    for (a, b), (f, c) in sorted(by_side.items()):
        g, d = by_side.get((b, a), (None, None))
        if a > b or g is None or f in taken or g in taken or 1 - normal[f] @ normal[g] > FLAT or (min(c, d), max(c, d)) in present:
            continue
        first = numpy.cross(points[a] - points[c], points[d] - points[c]) @ normal[f]
        second = numpy.cross(points[d] - points[c], points[b] - points[c]) @ normal[f]
        if min(first, second) > 0.1 * max(first, second):  # as convex as that, and no sliver
            faces[f], faces[g] = (c, a, d), (d, b, c)
            present.add((min(c, d), max(c, d)))
            taken |= {f, g}
            count += 1
    return (points, faces) if count else None


def remeshed(points, faces, _):
    """The dual of as many geodesic Voronoi cells as there are vertices; twice as many where cells touch themselves."""
    for share in (1, 2):
        cells = max(500, share * len(points))
        fine, small = points, faces
        while len(fine) < FINER * cells:
            fine, small = subdivided(fine, small)
        found = dual(fine, small, cells)
        if found and characteristic(found[1]) == characteristic(faces):
            return found
    return None


def dual(points, faces, cells):
    edges, _ = edges_of(faces)
    length = numpy.maximum(numpy.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1), 1e-12)
    graph = csr_matrix((numpy.r_[length, length], (edges.T.ravel(), edges[:, ::-1].T.ravel())), (len(points),) * 2)
    corner = points[faces]
    area = 0.5 * numpy.linalg.norm(numpy.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    weight = numpy.bincount(faces.ravel(), numpy.repeat(area, 3), len(points))
    seeds = numpy.sort(numpy.random.default_rng(2).choice(len(points), cells, False, weight / weight.sum()))
    for _ in range(ROUNDS):
        _, _, source = dijkstra(graph, False, seeds, min_only=True, return_predecessors=True)
        _, cell = numpy.unique(source, return_inverse=True)
        total = numpy.bincount(cell, weight)
        middle = numpy.stack([numpy.bincount(cell, weight * points[:, k]) for k in range(3)], axis=1) / total[:, None]
        order = numpy.lexsort((((points - middle[cell]) ** 2).sum(1), cell))
        seeds = order[numpy.r_[True, numpy.diff(cell[order]) > 0]]
    triples = cell[faces]
    triples = triples[(triples[:, 0] != triples[:, 1]) & (triples[:, 1] != triples[:, 2]) & (triples[:, 2] != triples[:, 0])]
    return points[seeds], triples


def halved(points, faces, _):
    """Edge collapse by quadric errors (Garland and Heckbert 1997) under the link condition; no face may turn over."""
    points, target = points.copy(), len(points) // 2
    normal = numpy.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    plane = numpy.c_[normal, -(normal * points[faces[:, 0]]).sum(1)] / numpy.sqrt(numpy.maximum(numpy.linalg.norm(normal, axis=1), 1e-300))[:, None]
    quadric = numpy.zeros((len(points), 4, 4))
    for k in range(3):
        numpy.add.at(quadric, faces[:, k], plane[:, :, None] * plane[:, None, :])
    around, alive = [set() for _ in points], {f: tuple(map(int, t)) for f, t in enumerate(faces)}
    for f, t in alive.items():
        for v in t:
            around[v].add(f)

    def ring(v):
        return {u for f in around[v] for u in alive[f]} - {v}

    def candidate(a, b):
        q = quadric[a] + quadric[b]
        places = [points[a], points[b], 0.5 * (points[a] + points[b])]
        if numpy.linalg.cond(q[:3, :3]) < 1e6:
            places.append(numpy.linalg.solve(q[:3, :3], -q[:3, 3]))
        costs = [numpy.r_[p, 1] @ q @ numpy.r_[p, 1] for p in places]
        best = int(numpy.argmin(costs))
        return max(costs[best], 0.0) + 1e-9 * ((points[a] - points[b]) ** 2).sum(), places[best]

    def turns(v, gone, place):
        for f in around[v]:
            t = alive[f]
            if gone not in t:
                before, after = points[list(t)], points[list(t)].copy()
                after[t.index(v)] = place
                n, m = (numpy.cross(x[1] - x[0], x[2] - x[0]) for x in (before, after))
                if n @ m <= 0.2 * numpy.linalg.norm(n) * numpy.linalg.norm(m):
                    return True
        return False

    version, heap = [0] * len(points), []
    for a, b in map(tuple, edges_of(faces)[0].tolist()):
        heap.append((candidate(a, b)[0], a, b, 0, 0))
    heapq.heapify(heap)
    left = len(points)
    while heap and left > target:
        _, a, b, version_a, version_b = heapq.heappop(heap)
        if (version[a], version[b]) != (version_a, version_b):
            continue
        _, place = candidate(a, b)
        if len(ring(a) & ring(b)) != 2 or turns(a, b, place) or turns(b, a, place):
            continue
        for f in around[a] & around[b]:
            for v in alive.pop(f):
                around[v].discard(f)
        for f in around[b]:
            alive[f] = tuple(a if v == b else v for v in alive[f])
        around[a] |= around[b]
        around[b] = set()
        points[a], quadric[a] = place, quadric[a] + quadric[b]
        version[a], version[b] = version[a] + 1, -1
        left -= 1
        for c in ring(a):
            heapq.heappush(heap, (candidate(a, c)[0], a, c, version[a], version[c]))
    used, place = numpy.unique(numpy.array(sorted(alive.values())), return_inverse=True)
    return points[used], place.reshape(-1, 3)


def make(program, folder, *models):
    for model in models:
        out = pathlib.Path(folder, pathlib.Path(model).stem)
        info = json.loads(run(program, "info", model, "--json"))
        if not (info["welded"]["closed"] and info["welded"]["non_manifold_vertices"] == 0):
            print(f"{model}: passed over, not a closed manifold", file=sys.stderr)
            continue
        out.mkdir(parents=True, exist_ok=True)
        run(program, "map", model, "-o", out / "map.ply", "-q", "--method", "thickness")
        vertices, faces = read_ply(out / "map.ply")
        (out / "map.ply").unlink()
        points, place = numpy.unique(points_of(vertices), axis=0, return_inverse=True)  # welded
        faces = place.reshape(-1)[faces]
        faces = faces[(faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])]
        used, place = numpy.unique(faces, return_inverse=True)
        points, faces = points[used], place.reshape(-1, 3)
        write_ply(out / "itself.ply", points, faces)
        for change in (moved, quartered, remeshed, halved, flipped):
            made = change(points, faces, info["diameter"])
            if made and characteristic(made[1]) == characteristic(faces):
                write_ply(out / f"{change.__name__}.ply", *made)
        print(out.name, len(points), " ".join(sorted(p.stem for p in out.glob("*.ply"))), flush=True)


def graph_of(program, model, *flags):
    with tempfile.TemporaryDirectory() as folder:
        told = json.loads(run(program, "skeleton", model, "-o", folder + "/s.json", "--json", *flags))
        graph = json.loads(pathlib.Path(folder, "s.json").read_text(encoding="utf-8"))
    nodes = numpy.array(graph["nodes"], float).reshape(-1, 3)
    share = numpy.linspace(0, 1, 9)[:, None]
    points = [nodes] + [nodes[a] + share * (nodes[b] - nodes[a]) for a, b in graph["edges"]]
    return numpy.concatenate(points), told["cycles"]


def map_of(program, model, *flags):
    with tempfile.TemporaryDirectory() as folder:
        run(program, "map", model, "-o", folder + "/map.ply", "-q", *flags)
        vertices, _ = read_ply(folder + "/map.ply")
    return points_of(vertices), vertices["quality"].astype(float)


def compared(program, folder, *flags):
    """Vertices, and per variant the Spearman correlation, the skeletons' distance and whether cycles agree."""
    model = folder / "itself.ply"
    diameter = json.loads(run(program, "info", model, "--json"))["diameter"]
    points, values = map_of(program, model, *flags)
    graph, cycles = graph_of(program, model, *flags)
    cells = {}
    for name in VARIANTS:
        file = model if name == "exact" else folder / f"{name}.ply"
        if not file.exists():
            continue
        more = (*flags, "--contraction", "exact") if name == "exact" else flags
        other_points, other_values = map_of(program, file, *more)
        other_graph, other_cycles = graph_of(program, file, *more)
        same = name in ("exact", "flipped", "moved", "quartered")
        nearest = numpy.arange(len(points)) if same else cKDTree(other_points).query(points)[1]
        gap = 0.5 * (cKDTree(graph).query(other_graph)[0].mean() + cKDTree(other_graph).query(graph)[0].mean())
        cells[name] = spearman(values, other_values[nearest]), gap / (TWO_SPACINGS * diameter), cycles == other_cycles
    return len(points), cells


def table(program, folder, *names):
    flags = [n for n in names if n.startswith("-")]
    wanted = [n for n in names if not n.startswith("-")]
    flags = [f for flag in flags for f in flag.split("=")]
    found = sorted(p.parent for p in pathlib.Path(folder).glob("*/itself.ply") if not wanted or p.parent.name in wanted)
    rows = []
    for path in found:
        try:
            count, cells = compared(program, path, *flags)
        except RuntimeError as error:
            print(f"{path.name}: {error}", file=sys.stderr)
            continue
        worst = min((numpy.nan_to_num(c[0]) for c in cells.values()), default=1.0)
        rows.append((worst, path.name, count, cells))
        print(f"{path.name} {worst:.3f}", file=sys.stderr, flush=True)
    print("| model | vertices | worst | " + " | ".join(VARIANTS) + " |\n" + "| --- " * (3 + len(VARIANTS)) + "|")
    for worst, name, count, cells in sorted(rows):
        told = [f"{cells[v][0]:.3f}; {cells[v][1]:.2f}{'' if cells[v][2] else ' c'}" if v in cells else "–" for v in VARIANTS]
        print(f"| {name} | {count} | {worst:.3f} | " + " | ".join(told) + " |")
    print(f"\n{len(rows)} models; every variant at least {GOOD} on {sum(r[0] >= GOOD for r in rows)}, at least {FAIR} on "
          f"{sum(r[0] >= FAIR for r in rows)}.")
    for v in VARIANTS:
        of = [r[3][v][0] for r in rows if v in r[3]]
        if of:
            print(f"- {v}: {len(of)} models, at least {GOOD} on {sum(x >= GOOD for x in of)}, at least {FAIR} on "
                  f"{sum(x >= FAIR for x in of)}, median {numpy.median(of):.3f}, least {min(of):.3f}")


def agreement(values, others):
    flat = numpy.ptp(values) == 0 and numpy.ptp(others) == 0
    return 1.0 if flat else float(numpy.nan_to_num(spearman(values, others)))


def moved_file(ask, file, folder):
    """Correlations of the map with those of the file moved and quartered, whether `view` doubts the map, processor
    seconds, vertices, strategies and the report's contraction; None where there is no map."""
    def values_of(name, *mesh):
        write_ply(f"{folder}/{name}.ply", *mesh)
        ask("map", f"{folder}/{name}.ply", "-o", f"{folder}/map.ply", "--force", "-q")
        return read_ply(folder + "/map.ply")[0]["quality"].astype(float)

    try:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        ask("map", file, "-o", folder + "/map.ply", "-q")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        vertices, faces = read_ply(folder + "/map.ply")
        # What coincides stays together.
        points, first, place = numpy.unique(points_of(vertices), axis=0, return_index=True, return_inverse=True)
        faces = place.reshape(-1)[faces]
        size = numpy.linalg.norm(points.max(0) - points.min(0))
        value = vertices["quality"].astype(float)[first]
        other = values_of("moved", *moved(points, faces, size))
        finer = values_of("quartered", *quartered(points, faces, size))
        report = json.loads(ask("view", file, "-o", folder + "/view", "--no-images", "--json", "--objective", "significance",
                              "--search", "rapid"))
    except (RuntimeError, ValueError):
        return None
    if len(value) != len(other) or len(finer) < len(value):
        return None
    strategies = collections.Counter(re.sub("[0-9]+", "N", s) for s in report["contraction"]["strategy"])
    doubted = any("map" in doubt for doubt in report["doubts"])
    return (agreement(value, other), agreement(value, finer[:len(value)]), doubted,
            after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, len(vertices),
            ", ".join(f"{n} × {s}" if n > 1 else s for s, n in strategies.most_common(3)), report["contraction"])


def thickness_table(program, *models):
    rows = sorted((spearman(map_of(program, m)[1], map_of(program, m, "--method", "thickness")[1]), pathlib.Path(m).name)
                  for m in models)
    print("| model | map and thickness |\n| --- | --- |")
    for same, name in rows:
        print(f"| {name} | {same:.3f} |")
    print(f"\n{len(rows)} models: median {numpy.median([r[0] for r in rows]):.3f}, at least {GOOD} on "
          f"{sum(r[0] >= GOOD for r in rows)}, least {rows[0][0]:.3f}")


def moved_table(program, *files):
    resource.setrlimit(resource.RLIMIT_AS, (FILE_BYTES, resource.getrlimit(resource.RLIMIT_AS)[1]))
    ask = functools.partial(run, "timeout", FILE_SECONDS, program)
    rows = []
    for file in files:
        with tempfile.TemporaryDirectory() as folder:
            found = moved_file(ask, file, folder)
        if found:
            rows.append((found[0], pathlib.Path(file).name, *found[1:]))
    print("| file | vertices | contracted | levels used | CPU, s | moved | quartered | doubted |\n" + "| --- " * 8 + "|")
    for same, name, finer, doubted, seconds, count, how, contraction in sorted(rows, key=lambda r: r[:3]):
        print(f"| {name} | {count} | {how} | {len(contraction['levels_used'])} of {1 + contraction['levels']} | {seconds:.2f} "
              f"| {same:.3f} | {finer:.3f} | {'yes' if doubted else 'no'} |")
    print(f"\n{len(rows)} files with a map of {len(files)}; {numpy.mean([r[4] for r in rows]):.2f} s of processor time in the mean.")
    for name, of in (("moved", [r[0] for r in rows]), ("quartered", [r[2] for r in rows])):
        print(f"- {name}: mean {numpy.mean(of):.3f}, at least {GOOD} on {sum(x >= GOOD for x in of)}, at least {FAIR} on "
              f"{sum(x >= FAIR for x in of)}, least {min(of):.3f}")
    silent = [r[1] for r in rows if r[0] < FAIR and not r[3]]
    print(f"- `view` doubts the map of {sum(r[3] for r in rows)}; moved below {FAIR} and not doubted: "
          + (", ".join(sorted(silent)) or "none"))


if __name__ == "__main__":
    if len(sys.argv) < 4 or sys.argv[1] not in ("make", "table", "moved", "thickness"):
        sys.exit(__doc__)
    {"make": make, "table": table, "moved": moved_table, "thickness": thickness_table}[sys.argv[1]](*sys.argv[2:])
