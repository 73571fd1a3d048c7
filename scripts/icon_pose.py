# SPDX-License-Identifier: MIT
"""The camera that an icon was drawn with, from a model's coloured points (numpy).

1. Silhouette: intersection over union of the icon's shape and the model's, each a mask of cells of which any
   part is covered, over a grid of directions and distances; the best places are refined by a pattern search.
2. Appearance, for poses whose silhouettes fit nearly alike (front and back of a box, mirror images): how much
   of the icon's colours the model's colours explain under an unknown light, which is linear in the normals
   (Lambert), and how its inner edges agree.
Azimuth 0 is +z, 90 is +x; elevation 90 is +y. Distances are in half diagonals of the model's box.
"""
from dataclasses import dataclass

import numpy as np

FIELDS = np.array([0.2, 0.6, 1.0])  # radians under which the box's sphere is seen: those of the grid
STEP = 10                           # degrees of the grid
LOWEST = -60                        # elevation where the grid begins, degrees
COARSE, FINE = 32, 64               # cells on the longer side of the silhouette
COARSE_POINTS, FINE_POINTS = 12000, 40000
PLACES = 10                         # best places of the grid that are refined
APART = 30                          # degrees: nearer poses are one
WORSE = 0.06                        # overlap below the best that appearance may still prefer
BEHIND = 0.06                       # depth behind its neighbours by which a point is hidden


def direction(azimuth, elevation):
    a, e = np.radians(azimuth), np.radians(elevation)
    return np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)])


def angles_of(d):
    return np.degrees(np.arctan2(d[0], d[2])), np.degrees(np.arcsin(np.clip(d[1], -1, 1)))


def between(a, b):
    return np.degrees(np.arccos(np.clip(direction(*a[:2]) @ direction(*b[:2]), -1, 1)))


def axes(azimuth, elevation):
    """Rows: right, up and towards the eye."""
    a, e = np.radians(azimuth), np.radians(elevation)
    right = np.array([np.cos(a), 0.0, -np.sin(a)])
    eye = direction(azimuth, elevation)
    return np.stack([right, np.cross(eye, right), eye])


@dataclass
class Pose:
    azimuth: float
    elevation: float
    field: float            # radians
    overlap: float = 0.0
    appearance: float = 0.0  # 0 to 1

    def __getitem__(self, k):
        return (self.azimuth, self.elevation)[k]


class Frame:
    """The icon's shape on a grid of square cells that its longer side fills."""

    def __init__(self, shown, colours, cells):
        rows, columns = np.nonzero(shown)
        self.top, self.left = rows.min(), columns.min()
        height, width = rows.max() + 1 - self.top, columns.max() + 1 - self.left
        self.scale = cells / max(height, width)
        self.height, self.width = max(1, round(height * self.scale)), max(1, round(width * self.scale))
        self.side = cells
        self.across = width >= height
        # Every pixel covers its cells: as many samples of it as are needed.
        fine = max(1, int(np.ceil(2 * self.scale)))
        part = (np.arange(fine) + 0.5) / fine
        self.mask = np.zeros((cells, cells), bool)
        y = ((rows - self.top)[:, None] + part) * self.scale
        x = ((columns - self.left)[:, None] + part) * self.scale
        y = np.minimum(y.astype(int), cells - 1) + (cells - self.height) // 2
        x = np.minimum(x.astype(int), cells - 1) + (cells - self.width) // 2
        self.mask[np.clip(np.repeat(y, fine, 1), 0, cells - 1), np.clip(np.tile(x, (1, fine)), 0, cells - 1)] = True
        self.total = int(self.mask.sum())
        count = np.zeros((cells, cells))
        self.picture = np.zeros((cells, cells, 3))
        cell_y, cell_x = np.clip(y[:, fine // 2], 0, cells - 1), np.clip(x[:, fine // 2], 0, cells - 1)
        np.add.at(count, (cell_y, cell_x), 1)
        np.add.at(self.picture, (cell_y, cell_x), colours[rows, columns])
        self.has_colour = count > 0
        self.picture /= np.maximum(count, 1)[..., None]

    def cells_of(self, points, pose):
        """Cells of projected points (3 x N), row-major, -1 outside; and their depths towards the eye."""
        x, y, depth = axes(pose.azimuth, pose.elevation).astype(np.float32) @ points
        w = np.float32(1 / np.sin(pose.field / 2)) - depth
        x /= w
        y /= -w
        left, right, top, bottom = float(x.min()), float(x.max()), float(y.min()), float(y.max())
        size = max((right - left) if self.across else (bottom - top), 1e-9)
        # A little less than the icon's side, so that the far edges belong to the last cell.
        scale = (self.width if self.across else self.height) / size * (1 - 1e-5)
        x *= np.float32(scale)
        y *= np.float32(scale)
        x += np.float32(self.side / 2 - scale * (left + right) / 2)
        y += np.float32(self.side / 2 - scale * (top + bottom) / 2)
        cells = y.astype(np.int32) * self.side + x.astype(np.int32)
        longer = scale * max(right - left, bottom - top)
        if longer > self.side:  # the icon's longer side is the model's shorter one
            cells[(x < 0) | (x >= self.side) | (y < 0) | (y >= self.side)] = -1
        return cells, depth

    def overlap(self, points, pose):
        cells, _ = self.cells_of(points, pose)
        mask = np.zeros(self.side * self.side + 1, bool)
        mask[cells] = True
        outside = np.count_nonzero(cells < 0) / len(cells) * self.total if mask[-1] else 0
        mask = mask[:-1]
        both = np.count_nonzero(mask & self.mask.ravel())
        return both / (self.total + np.count_nonzero(mask) - both + outside)


def coarse_grid(frame, points):
    """All poses of the grid with their overlaps, by distance, elevation and azimuth."""
    azimuths, elevations = np.arange(-180, 180, STEP), np.arange(LOWEST, 91, STEP)
    result = []
    for field in FIELDS:
        for elevation in elevations:
            for azimuth in (azimuths if elevation < 90 else azimuths[::3]):
                pose = Pose(float(azimuth), float(elevation), float(field))
                pose.overlap = frame.overlap(points, pose)
                result.append(pose)
    return result


def apart(poses, count, least):
    """The best poses, none nearer than \\p least degrees to a better one."""
    kept = []
    for pose in sorted(poses, key=lambda p: -p.overlap):
        if all(between(pose, other) >= least for other in kept):
            kept.append(pose)
            if len(kept) == count:
                break
    return kept


def refined(frame, points, pose):
    """Pattern search over direction and distance: steps halve where none helps."""
    best = Pose(pose.azimuth, pose.elevation, pose.field, frame.overlap(points, pose))
    step = STEP / 2
    while step > 0.4:
        moved = False
        for da, de, factor in ((1, 0, 1), (-1, 0, 1), (0, 1, 1), (0, -1, 1),
                               (0, 0, 1 + step / 15), (0, 0, 1 / (1 + step / 15))):
            elevation = best.elevation + de * step
            if abs(elevation) > 90:
                continue
            stretch = 1 / max(np.cos(np.radians(best.elevation)), 0.2)  # of azimuth, near the poles
            tried = Pose((best.azimuth + da * step * stretch + 180) % 360 - 180, elevation,
                         float(np.clip(best.field * factor, 0.1, 1.6)))
            tried.overlap = frame.overlap(points, tried)
            if tried.overlap > best.overlap:
                best, moved = tried, True
        if not moved:
            step /= 2
    return best


def mirrored(pose):
    """Poses of like silhouettes: seen from behind, from the other side, and their mirror images."""
    for azimuth, elevation in ((180 - pose.azimuth, pose.elevation), (-pose.azimuth, pose.elevation),
                               (180 + pose.azimuth, pose.elevation), (180 - pose.azimuth, -pose.elevation),
                               (180 + pose.azimuth, -pose.elevation)):
        yield Pose((azimuth + 180) % 360 - 180, elevation, pose.field)


def drawn(frame, cloud, pose):
    """Colours and normals of what is in front in each cell, and where that is known."""
    cells, depth = frame.cells_of(np.ascontiguousarray(cloud.points.T, np.float32), pose)
    order = np.argsort(depth, kind="stable")  # the nearest is written last
    order = order[cells[order] >= 0]
    front = np.full(frame.side ** 2, -1)
    front[cells[order]] = order
    nearest = np.where(front >= 0, depth[front], -9.0).reshape(frame.side, frame.side)
    around = np.pad(nearest, 1, constant_values=-9.0)
    highest = np.max([around[i:i + frame.side, k:k + frame.side] for i in range(3) for k in range(3)], 0)
    known = (nearest > -9) & (nearest > highest - BEHIND)
    normals = cloud.normals[front] @ axes(pose.azimuth, pose.elevation).T
    normals *= np.sign(normals[:, 2:] + 1e-12)
    shape = (frame.side, frame.side, 3)
    return cloud.colours[front].reshape(shape), normals.reshape(shape), known


def edges(picture, known):
    """Length of the gradient where a cell and its neighbours are known."""
    grey = picture.mean(-1)
    dx, dy = grey[1:-1, 2:] - grey[1:-1, :-2], grey[2:, 1:-1] - grey[:-2, 1:-1]
    inside = known[1:-1, 1:-1] & known[1:-1, 2:] & known[1:-1, :-2] & known[2:, 1:-1] & known[:-2, 1:-1]
    return np.hypot(dx, dy), inside


def appearance(frame, cloud, pose):
    """Mean of the share of the icon's colours explained and of the agreement of edges, 0 to 1."""
    colours, normals, known = drawn(frame, cloud, pose)
    known &= frame.has_colour
    if np.count_nonzero(known) < 40:
        return 0.0
    lit = np.concatenate([np.ones(known.shape + (1,)), normals], -1)
    terms, wanted = [], []
    for channel in range(3):
        own = np.zeros(known.shape + (3,))
        own[..., channel] = 1
        terms.append(np.concatenate([own, colours[..., channel:channel + 1] * lit, lit[..., 1:]], -1)[known])
        wanted.append(frame.picture[..., channel][known])
    a, b = np.concatenate(terms), np.concatenate(wanted)
    weights = np.linalg.lstsq(a.T @ a + 1e-3 * len(b) * np.eye(a.shape[1]) * 0.01, a.T @ b, rcond=None)[0]
    spread = sum(((w - w.mean()) ** 2).sum() for w in wanted) + 0.002 * len(b)
    explained = 1 - ((a @ weights - b) ** 2).sum() / spread
    made = np.zeros(known.shape + (3,))
    made[known] = (a @ weights).reshape(3, -1).T
    first, inside = edges(frame.picture, known)
    second, _ = edges(made, known)
    p, q = first[inside], second[inside]
    agreement = 0.0
    if len(p) > 20 and p.std() > 1e-4 and q.std() > 1e-4:
        agreement = np.corrcoef(p, q)[0, 1]
    return float(np.clip(explained, 0, 1) + max(agreement, 0.0)) / 2


def find_poses(cloud, colours, shown):
    """Poses of the icon, refined, with overlap and appearance; the best overlap first."""
    fine, coarse = Frame(shown, colours, FINE), Frame(shown, colours, COARSE)
    few, many = (np.ascontiguousarray(cloud.points[:n].T, np.float32) for n in (COARSE_POINTS, FINE_POINTS))
    places = apart(coarse_grid(coarse, few), PLACES, 25)
    places = [p for p in places if p.overlap > places[0].overlap - 0.2]
    starts = places + [Pose(p.azimuth, p.elevation, float(field)) for p in places[:3] for field in FIELDS
                       if field != p.field]
    poses = [refined(fine, many, start) for start in starts]
    best = max(poses, key=lambda p: p.overlap)
    poses += [refined(fine, many, place) for place in mirrored(best)]
    poses = apart(poses, len(poses), 12)
    for pose in poses:
        if pose.overlap > best.overlap - WORSE - 0.02:
            pose.appearance = appearance(fine, cloud, pose)
    return poses
