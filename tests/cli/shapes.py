"""Small models, most as OFF text."""

import math

BOX_FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
             (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
BOX_SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TETRAHEDRON = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
               [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])


def off(vertices, faces):
    return "\n".join(["OFF", f"{len(vertices)} {len(faces)} 0",
                      *(" ".join(map(str, v)) for v in vertices),
                      *(" ".join(map(str, (len(f), *f))) for f in faces), ""])


def obj(vertices, faces):
    return "".join("v " + " ".join(map(str, v)) + "\n" for v in vertices) + "".join(
        "f " + " ".join(str(i + 1) for i in f) + "\n" for f in faces)


def box(width, height=1.0, depth=1.0):
    """A closed box of 8 vertices; another width is another content."""
    return off([(width * (i >> 2 & 1), height * (i >> 1 & 1), depth * (i & 1)) for i in range(8)], BOX_FACES)


def boxes(*sizes):
    """A file of boxes: of each the lowest corner and the sides."""
    corners, faces = [], []
    for x, y, z, a, b, c in sizes:
        faces += [[len(corners) + i for i in side] for side in BOX_SIDES]
        corners += [(x + i * a, y + j * b, z + k * c) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    return off(corners, faces)


def ball_with_pole():
    """230 points: a ball, and on it a pole of 30 that no triangle joins, which ends at a height of 4."""
    points = []
    for i in range(200):
        y, angle = 1 - (i + 0.5) / 100, 2.4 * i
        points.append((math.sqrt(1 - y * y) * math.cos(angle), y, math.sqrt(1 - y * y) * math.sin(angle)))
    return points + [(0, 1 + 0.1 * k, 0) for k in range(1, 31)]


def angle_bar():
    """A long thin L of two legs: 12 vertices, 20 faces, and little area for its size."""
    outline = [(0, 0), (10, 0), (10, 0.3), (0.3, 0.3), (0.3, 4), (0, 4)]
    fan = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    faces = [(c, b, a) for a, b, c in fan] + [(a + 6, b + 6, c + 6) for a, b, c in fan]
    for a in range(6):
        b = (a + 1) % 6
        faces += [(a, b, b + 6), (a, b + 6, a + 6)]
    return off([(x, y, z) for z in (0, 0.2) for x, y in outline], faces)


def write_fault_models(folder):
    """The models of faults.py."""
    (folder / "old.off").write_text(box(2.0, 1.0))
    for name, size in (("new", 1.0), ("m0", 1.0), ("m1", 1.5), ("m2", 1.0)):
        (folder / f"{name}.off").write_text(box(size))
    (folder / "bad.off").write_text("OFF\n1 1 0\n0 0 0\n3 0 1 2\n")
