#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Rotates, moves, scales and renumbers models and compares their skeletons; prints Markdown.

    measure_robustness.py PROGRAM MODEL...
    measure_robustness.py stages PROGRAM MODEL...

One row a closed model: components and cycles, and the ends, of the model as it is and of each variant; and the farthest
node of one graph from the edges of the other, moved back, over 2 r, where r = 0.02 D is the distance of samples. Exit
code 1 if components or cycles of a variant differ. `stages` says where a difference begins: of the variant that is
farthest off, the distance after each stage.
"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile

import numpy as np

SEED = 1
SPACING = 0.02  # r / D, the program's default
AXIS, ANGLE_RAD = np.array([1.0, 2.0, 3.0]) / np.sqrt(14.0), 1.1


# What the graph has gone through, and the flags for it.
STAGES = {"collapsed": ("--no-centre", "--no-prune"), "centred and led inside": ("--no-prune",), "pruned": ()}


def rotation():
    """Rodrigues' formula."""
    x, y, z = AXIS
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(ANGLE_RAD) * cross + (1.0 - np.cos(ANGLE_RAD)) * cross @ cross


# Name: matrix, offset over the size of the model, whether rows are shuffled.
VARIANTS = {
    "rotated": (rotation(), (0.3, -1.2, 0.7), False),
    "scaled by 1e6": (1e6 * np.eye(3), (0.0, 0.0, 0.0), False),
    "scaled by 1e-6": (1e-6 * np.eye(3), (0.0, 0.0, 0.0), False),
    "renumbered": (np.eye(3), (0.0, 0.0, 0.0), True),
}


def read_ply(path):
    """Positions and triangles of a binary PLY of ours."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    sizes = {"float": "f4", "double": "f8", "uchar": "u1", "int": "i4", "uint": "u4"}
    counts, fields, element = {}, [], ""
    for line in head.decode().splitlines():
        word = line.split()
        if word[0] == "element":
            element, counts[word[1]] = word[1], int(word[2])
        elif word[0] == "property" and element == "vertex":
            fields.append((word[2], "<" + sizes[word[1]]))
    vertices = np.frombuffer(body, fields, counts["vertex"])
    faces = np.frombuffer(body, [("n", "u1"), ("v", "<i4", 3)], counts["face"], vertices.nbytes)
    return np.stack([vertices[axis].astype(float) for axis in "xyz"], 1), faces["v"]


def write_ply(path, positions, triangles):
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(positions)}\nproperty double x\n"
            f"property double y\nproperty double z\nelement face {len(triangles)}\n"
            "property list uchar int vertex_indices\nend_header\n")
    faces = np.empty(len(triangles), [("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, triangles
    path.write_bytes(head.encode() + positions.astype("<f8").tobytes() + faces.tobytes())


def skeleton(program, model, folder, *flags):
    """Summary, number of ends, nodes and edges."""
    out = folder / "skeleton.json"
    done = subprocess.run([program, "skeleton", str(model), "-o", str(out), "--json", *flags], capture_output=True,
                          text=True, check=True)
    graph = json.loads(out.read_text(encoding="utf-8"))
    ends = sum(degree == 1 for degree in graph["degree"])
    nodes, edges = np.array(graph["nodes"]).reshape(-1, 3), np.array(graph["edges"], int).reshape(-1, 2)
    return json.loads(done.stdout), ends, nodes, edges


def farthest(nodes, other_nodes, other_edges):
    """The largest distance of a node from the other graph."""
    a, b = (other_nodes[other_edges[:, k]] for k in (0, 1)) if len(other_edges) else (other_nodes, other_nodes)
    along = b - a
    length2 = np.maximum((along * along).sum(1), np.finfo(float).tiny)
    worst = 0.0
    for node in nodes:
        t = np.clip(((node - a) * along).sum(1) / length2, 0.0, 1.0)
        worst = np.maximum(worst, np.sqrt((((a + t[:, None] * along) - node) ** 2).sum(1).min()))  # max() hides NaN
    return worst


def variants(positions, triangles):
    yield "as it is", np.eye(3), np.zeros(3), positions, triangles
    size = np.linalg.norm(np.ptp(positions, axis=0))
    for name, (matrix, offset, is_shuffled) in VARIANTS.items():
        shift = size * np.array(offset)
        moved, faces = positions @ matrix.T + shift, triangles
        if is_shuffled:
            order = np.random.default_rng(SEED).permutation(len(positions))
            moved, faces = moved[order], np.argsort(order)[triangles]
            faces = faces[np.random.default_rng(SEED + 1).permutation(len(faces))]
        yield name, matrix, shift, moved, faces


def plain_copy(program, model, folder):
    """Positions and triangles of a model, and 2 r."""
    plain = folder / "plain.ply"
    subprocess.run([program, "map", str(model), "-o", str(plain), "-q"], check=True, capture_output=True)
    info = json.loads(subprocess.run([program, "info", str(plain), "--json"], capture_output=True, check=True).stdout)
    return *read_ply(plain), 2.0 * SPACING * info["diameter"]


def row(program, model, folder):
    """The cells of a row, and whether topology is the same everywhere; None where the model is not closed."""
    positions, triangles, limit = plain_copy(program, model, folder)
    cells, first, is_same = [pathlib.Path(model).name], None, True
    for name, matrix, shift, moved, faces in variants(positions, triangles):
        path = folder / "variant.ply"
        write_ply(path, moved, faces)
        summary, ends, nodes, edges = skeleton(program, path, folder)
        if not summary["closed"]:
            return None
        topology = (summary["components"], summary["cycles"])
        if first is None:
            first = topology, nodes, edges
            cells += [f"{topology[0]}, {topology[1]}", str(ends)]
            continue
        back = (nodes - shift) @ np.linalg.inv(matrix).T
        gap = np.maximum(farthest(back, first[1], first[2]), farthest(first[1], back, edges)) / limit
        is_same = is_same and topology == first[0]
        told = "" if topology == first[0] else f"; {topology[0]}, {topology[1]}"
        cells.append(f"{ends}; {gap:.2f}{told}")
    return cells, is_same


def stages(program, *models):
    print("| model | variant | " + " | ".join(STAGES) + " |")
    print("| --- " * (2 + len(STAGES)) + "|")
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            positions, triangles, limit = plain_copy(program, model, pathlib.Path(folder))
            first, gaps = {}, {}
            for name, matrix, shift, moved, faces in variants(positions, triangles):
                path = pathlib.Path(folder, "variant.ply")
                write_ply(path, moved, faces)
                for stage, flags in STAGES.items():
                    _, _, nodes, edges = skeleton(program, path, pathlib.Path(folder), *flags)
                    back = (nodes - shift) @ np.linalg.inv(matrix).T
                    plain = first.setdefault(stage, (nodes, edges))
                    gap = np.maximum(farthest(back, *plain), farthest(plain[0], back, edges)) / limit
                    gaps.setdefault(name, []).append(gap)
            worst = max(gaps, key=lambda name: gaps[name][-1])
            cells = [pathlib.Path(model).name, worst] + [f"{gap:.2f}" for gap in gaps[worst]]
            print("| " + " | ".join(cells) + " |", flush=True)
    return 0


def main(program, *models):
    print("| model | components, cycles | ends | " + " | ".join(VARIANTS) + " |")
    print("| --- " * (3 + len(VARIANTS)) + "|")
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            done = row(program, model, pathlib.Path(folder))
            if done is None:
                print(f"{model}: passed over, not closed", file=sys.stderr)
                continue
            print("| " + " | ".join(done[0]) + " |", flush=True)
            wrong += not done[1]
    print(f"\nOther components or cycles in {wrong} models.")
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(stages(*sys.argv[2:]) if sys.argv[1] == "stages" else main(*sys.argv[1:]))
