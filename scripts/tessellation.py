# SPDX-License-Identifier: MIT
"""Splits half of a mesh flatly, reads the program's maps, and compares them; for scripts/measure.py."""

import statistics
import struct

SIZES = {"float": "f", "double": "d", "uchar": "B", "int": "i", "uint": "I"}


def read_map(path):
    """Positions, quality and triangles of a map.ply."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    counts, fields = {}, {}
    for words in (line.split() for line in data[:end].decode().splitlines()):
        if words[0] == "element":
            name = words[1]
            counts[name], fields[name] = int(words[2]), []
        elif words[0] == "property":
            fields[name].append(words[1:])
    vertex = struct.Struct("<" + "".join(SIZES[kind] for kind, _ in fields["vertex"]))
    names = [name for _, name in fields["vertex"]]
    faces_at = end + counts["vertex"] * vertex.size
    rows = list(vertex.iter_unpack(data[end:faces_at]))
    quality = names.index("quality")
    _, size, index, _ = fields["face"][0]
    face = struct.Struct("<" + SIZES[size] + 3 * SIZES[index])
    triangles = [f[1:] for f in face.iter_unpack(data[faces_at:faces_at + counts["face"] * face.size])]
    return [row[:3] for row in rows], [row[quality] for row in rows], triangles


def write_off(path, positions, triangles):
    with path.open("w", encoding="ascii") as file:
        file.write(f"OFF\n{len(positions)} {len(triangles)} 0\n")
        file.writelines(" ".join(map(repr, p)) + "\n" for p in positions)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


def split_half(positions, triangles):
    """The half of the faces with the larger x splits in four, and what is beside it as far as it must to stay
    closed. Former vertices keep their numbers."""
    where = [sum(positions[v][0] for v in face) for face in triangles]
    middle = statistics.median_high(where)
    positions, middles = list(positions), {}

    def key(a, b):
        return (min(a, b), max(a, b))

    def middle_of(a, b):
        if key(a, b) not in middles:
            middles[key(a, b)] = len(positions)
            positions.append(tuple((x + y) / 2 for x, y in zip(positions[a], positions[b])))

    for x, (a, b, c) in zip(where, triangles):
        if x > middle:
            middle_of(a, b), middle_of(b, c), middle_of(c, a)
    split = []

    def add(a, b, c):
        ab, bc, ca = (middles.get(key(*edge)) for edge in ((a, b), (b, c), (c, a)))
        if None not in (ab, bc, ca):
            split.extend([(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)])
        elif ab is not None:
            add(a, ab, c), add(ab, b, c)
        elif bc is not None:
            add(b, bc, a), add(bc, c, a)
        elif ca is not None:
            add(c, ca, b), add(ca, a, b)
        else:
            split.append((a, b, c))

    for face in triangles:
        add(*face)
    return positions, split


def spearman(a, b):
    """Correlation of ranks; equal values share theirs."""
    def ranks(values):
        order = sorted(range(len(values)), key=values.__getitem__)
        result, start = [0.0] * len(values), 0
        while start < len(order):
            end = start
            while end < len(order) and values[order[end]] == values[order[start]]:
                end += 1
            for i in order[start:end]:
                result[i] = (start + end - 1) / 2
            start = end
        return result
    return statistics.correlation(ranks(a), ranks(b))
