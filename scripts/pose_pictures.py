# SPDX-License-Identifier: MIT
"""Draws an icon beside a model's coloured points in a pose, to judge by eye (numpy, PIL)."""
import numpy as np
from PIL import Image

import icon_pose

SIDE = 120


def of_pose(cloud, pose):
    """The points seen so, lit from the eye, over white."""
    seen = cloud.points @ icon_pose.axes(pose.azimuth, pose.elevation).T
    w = 1 / (1 / np.sin(pose.field / 2) - seen[:, 2])
    x, y = seen[:, 0] * w, -seen[:, 1] * w
    size = max(np.ptp(x), np.ptp(y), 1e-9)
    column = ((x - (x.min() + x.max()) / 2) / size * 0.92 * SIDE + SIDE / 2).astype(int)
    row = ((y - (y.min() + y.max()) / 2) / size * 0.92 * SIDE + SIDE / 2).astype(int)
    order = np.argsort(seen[:, 2], kind="stable")
    normals = cloud.normals @ icon_pose.axes(pose.azimuth, pose.elevation)[2]
    picture = np.ones((SIDE, SIDE, 3))
    picture[row[order], column[order]] = (cloud.colours * (0.35 + 0.6 * np.abs(normals))[:, None])[order]
    return picture


def beside(colours, cloud, *poses):
    """One picture: the icon, then the poses."""
    icon = Image.fromarray((255 * np.clip(colours, 0, 1)).astype(np.uint8)).resize((SIDE, SIDE))
    parts = [np.asarray(icon)] + [(255 * np.clip(of_pose(cloud, p), 0, 1)).astype(np.uint8) for p in poses]
    return Image.fromarray(np.concatenate(parts, 1))


def draw(file, colours, cloud, *poses):
    beside(colours, cloud, *poses).save(file)
