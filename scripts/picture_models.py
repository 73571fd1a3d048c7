#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Models that pictures of the documentation are made of: picture_models.py MAP.ply SEEN.npy FOLDER

seen.ply: the surface of MAP.ply (as vantage map writes it), vertices that SEEN.npy (vantage score --visible) has warm;
cloud.xyz: its points alone. Needs NumPy.
"""
import pathlib
import sys

import numpy as np

VERTEX = np.dtype([("place", "<f4", 3), ("quality", "<f4"), ("colour", "u1", 3)])
FACE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])


def write_ply(path, places, colours, faces):
    vertices = np.zeros(len(places), [("place", "<f4", 3), ("colour", "u1", 3)])
    vertices["place"], vertices["colour"] = places, colours
    rows = np.zeros(len(faces), FACE)
    rows["count"], rows["corners"] = 3, faces
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(places)}",
             *(f"property float {axis}" for axis in "xyz"), *(f"property uchar {c}" for c in ("red", "green", "blue")),
             f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    path.write_bytes("\n".join(lines).encode() + vertices.tobytes() + rows.tobytes())


def read_map(path):
    data = path.read_bytes()
    head, body = data.split(b"end_header\n", 1)
    words = head.decode().split()
    vertices = int(words[words.index("vertex") + 1])
    faces = int(words[words.index("face") + 1])
    table = np.frombuffer(body, VERTEX, vertices)
    return table["place"], np.frombuffer(body, FACE, faces, vertices * VERTEX.itemsize)["corners"]


def main():
    folder = pathlib.Path(sys.argv[3])
    places, faces = read_map(pathlib.Path(sys.argv[1]))
    seen = np.load(sys.argv[2])["seen"][:, :1] != 0
    write_ply(folder / "seen.ply", places, np.where(seen, [230, 120, 40], [120, 130, 145]), faces)
    np.savetxt(folder / "cloud.xyz", places, "%.6g")


if __name__ == "__main__":
    main()
