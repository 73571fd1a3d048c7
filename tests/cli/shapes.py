"""Small models as OFF text, for tests that need many of them."""

BOX_FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
             (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]


def box(width, height=1.0, depth=1.0):
    """A closed box of 8 vertices; another width is another content."""
    lines = ["OFF", "8 12 0"]
    lines += [f"{width * (i >> 2 & 1)} {height * (i >> 1 & 1)} {depth * (i & 1)}" for i in range(8)]
    lines += [f"3 {a} {b} {c}" for a, b, c in BOX_FACES]
    return "\n".join(lines) + "\n"


def angle_bar():
    """A long thin L of two legs: 12 vertices, 20 faces, and little area for its size."""
    outline = [(0, 0), (10, 0), (10, 0.3), (0.3, 0.3), (0.3, 4), (0, 4)]
    fan = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    faces = [(c, b, a) for a, b, c in fan] + [(a + 6, b + 6, c + 6) for a, b, c in fan]
    for a in range(6):
        b = (a + 1) % 6
        faces += [(a, b, b + 6), (a, b + 6, a + 6)]
    lines = ["OFF", "12 20 0"] + [f"{x} {y} {z}" for z in (0, 0.2) for x, y in outline]
    return "\n".join(lines + [f"3 {a} {b} {c}" for a, b, c in faces]) + "\n"


def write_fault_models(folder):
    """The models of faults.py."""
    (folder / "old.off").write_text(box(2.0, 1.0))
    for name, size in (("new", 1.0), ("m0", 1.0), ("m1", 1.5), ("m2", 1.0)):
        (folder / f"{name}.off").write_text(box(size))
    (folder / "bad.off").write_text("OFF\n1 1 0\n0 0 0\n3 0 1 2\n")
