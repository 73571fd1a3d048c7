"""Small models as OFF text, for tests that need many of them."""

BOX_FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
             (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]


def box(width, height=1.0, depth=1.0):
    """A closed box of 8 vertices; another width is another content."""
    lines = ["OFF", "8 12 0"]
    lines += [f"{width * (i >> 2 & 1)} {height * (i >> 1 & 1)} {depth * (i & 1)}" for i in range(8)]
    lines += [f"3 {a} {b} {c}" for a, b, c in BOX_FACES]
    return "\n".join(lines) + "\n"
