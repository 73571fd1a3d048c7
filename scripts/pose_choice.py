# SPDX-License-Identifier: MIT
"""Which of an icon's poses is meant, how sure that is, and when none is (numpy).

Poses are compared by fit = 6 overlap + appearance. Where fits are so near that they cannot be told apart, the pose
nearest to the catalogue's front and not from below is taken: an icon from behind needs a reason. If such poses are of
heights far apart, as those of a ball are, none is taken.
"""
from dataclasses import dataclass

import numpy as np

import icon_pose

OVERLAP_WEIGHT = 6.0     # of overlap against appearance: on 70 icons of known cameras (try_icon_poses.py) 6 to 20 are best
LEAST_OVERLAP = 0.88     # with less, an icon shows something else, or otherwise than the model is
ALIKE = 0.10             # fits so near cannot be told apart: of 39 poses from behind so near, one at most is right
CERTAIN = 0.10           # difference of fits that leaves a doubt of 1/e


@dataclass
class Choice:
    pose: icon_pose.Pose
    second: object      # a pose at least icon_pose.APART away that fits as well, or None
    confidence: float   # 0 to 1
    refusal: str        # why the pose is not to be used; empty if it is


def fit(pose):
    return OVERLAP_WEIGHT * pose.overlap + pose.appearance


def usual(pose):
    """Towards the front, and not from below."""
    _, up, front = icon_pose.direction(pose.azimuth, pose.elevation)
    return front + 2 * min(up, 0.0)


def choose(poses):
    """\\param poses of icon_pose.find_poses()."""
    most = max(pose.overlap for pose in poses)
    near = sorted((p for p in poses if p.overlap >= most - icon_pose.WORSE), key=lambda p: -fit(p))
    alike = [p for p in near if fit(p) > fit(near[0]) - ALIKE]
    pose = max(alike, key=usual)
    others = [p for p in near if icon_pose.between(p, pose) >= icon_pose.APART]
    second = max((p for p in others if fit(p) > fit(pose) - ALIKE), key=fit, default=None)
    margin = max(0.0, fit(pose) - max(fit(p) for p in others)) if others else 1.0
    told = 1 - np.exp(-margin / CERTAIN)
    if second is not None:  # the front is believed
        told = 0.5
    confidence = float(np.clip((pose.overlap - 0.8) / 0.12, 0, 1) * told)
    refusal = ""
    if pose.overlap < LEAST_OVERLAP:
        refusal = "the silhouettes do not fit"
    elif any(abs(p.elevation - pose.elevation) >= icon_pose.APART for p in alike):
        refusal = "poses cannot be told apart"
    return Choice(pose, second, confidence, refusal)
