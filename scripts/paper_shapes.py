# SPDX-License-Identifier: MIT
"""The dinosaur's parts as vertex lists, and what hides what: for paper_claims.py."""

import numpy as np

# Boxes in shares of the model's bounding box: x to the animal's left, y from its snout to the tip of
# the tail, z upwards. The same boxes fit every tessellation of the shape.
BELLY = ((0.25, 0.72), (0.24, 0.46), (0.45, 0.58))  # underside of the trunk, hips to chest
LIMBS = {
    "front left leg": ((0.72, 1.00), (0.10, 0.34), (0.50, 0.75)),
    "front right leg": ((0.00, 0.40), (0.08, 0.26), (0.50, 0.75)),
    "hind left leg": ((0.50, 1.00), (0.38, 0.54), (0.00, 0.36)),
    "hind right leg": ((0.00, 0.50), (0.25, 0.45), (0.00, 0.36)),
}
SMOOTHING = 0.05  # of the bounding box's diagonal


class Mesh:
    def __init__(self, positions, quality, triangles):
        self.positions, self.quality, self.triangles = positions, quality, triangles

    def normals(self):
        a, b, c = (self.positions[self.triangles[:, k]] for k in range(3))
        faces = np.cross(b - a, c - a)
        normals = np.zeros_like(self.positions)
        for k in range(3):
            np.add.at(normals, self.triangles[:, k], faces)
        return normals

    def smooth_share(self, most=2000):
        """Share of the map's variance that is left when it is averaged over balls: 1 is global, 0 local."""
        span = np.linalg.norm(self.positions.max(0) - self.positions.min(0))
        chosen = np.random.default_rng(0).permutation(len(self.positions))[:most]
        means = []
        for v in chosen:
            near = np.sum((self.positions - self.positions[v])**2, axis=1) < (SMOOTHING * span)**2
            means.append(self.quality[near].mean())
        return float(np.var(means) / np.var(self.quality[chosen]))


def read_ply(path):
    """A binary little-endian PLY of triangles with float or double properties."""
    with open(path, "rb") as file:
        header = []
        while not header or header[-1] != "end_header":
            header.append(file.readline().decode().strip())
        kinds = {"float": "<f4", "double": "<f8", "uchar": "u1"}
        fields, counts, section = [], {}, ""
        for line in header:
            words = line.split()
            if words[0] == "element":
                section, counts[words[1]] = words[1], int(words[2])
            elif words[0] == "property" and section == "vertex":
                fields.append((words[2], kinds[words[1]]))
        vertex = np.dtype(fields)
        rows = np.frombuffer(file.read(vertex.itemsize * counts["vertex"]), vertex)
        face = np.dtype([("n", "u1"), ("v", "<i4", 3)])
        triangles = np.frombuffer(file.read(face.itemsize * counts["face"]), face)["v"]
    positions = np.stack([rows[axis].astype(float) for axis in "xyz"], axis=1)
    quality = rows["quality"].astype(float) if "quality" in rows.dtype.names else None
    return Mesh(positions, quality, triangles)


def in_box(positions, box):
    low, high = positions.min(0), positions.max(0)
    shares = (positions - low) / (high - low)
    bounds = np.array(box)
    return np.all((shares >= bounds[:, 0]) & (shares <= bounds[:, 1]), axis=1)


def belly(positions):
    return in_box(positions, BELLY)


def limb(positions, name):
    return in_box(positions, LIMBS[name])


def crossed(points, eye, a, b, c):
    """Whether the segment from each point to the eye crosses one of the triangles."""
    hit = np.zeros(len(points), bool)
    ab, ac = b - a, c - a
    for i, p in enumerate(points):
        way = eye - p
        h = np.cross(way, ac)
        det = np.einsum("ij,ij->i", ab, h)
        ok = np.abs(det) > 1e-14
        inverse = np.where(ok, 1.0 / np.where(ok, det, 1.0), 0.0)
        s = p - a
        u = inverse * np.einsum("ij,ij->i", s, h)
        q = np.cross(s, ab)
        v = inverse * (q @ way)
        t = inverse * np.einsum("ij,ij->i", ac, q)
        hit[i] = np.any(ok & (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 1e-9) & (t < 1))
    return hit


def hidden_by(mesh, on_belly, eye):
    """Belly vertices turned to the eye, and for each limb those of them that it hides."""
    turned = np.einsum("ij,ij->i", mesh.normals(), eye - mesh.positions) > 0
    facing = on_belly & turned
    points = np.flatnonzero(facing)
    hidden = {}
    for name in LIMBS:
        of_limb = limb(mesh.positions, name)
        faces = mesh.triangles[of_limb[mesh.triangles].all(axis=1)]
        corners = (mesh.positions[faces[:, k]] for k in range(3))
        hidden[name] = np.zeros(len(mesh.positions), bool)
        hidden[name][points] = crossed(mesh.positions[points], eye, *corners)
    return facing, hidden
