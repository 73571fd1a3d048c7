# SPDX-License-Identifier: MIT
"""Runs the installed program on a surface, in a folder that is gone afterwards. Knows nothing of Blender."""

import base64
import dataclasses
import json
import pathlib
import subprocess
import tempfile

import numpy as np


class Failed(Exception):
    """Why there is no answer: one sentence."""


@dataclasses.dataclass
class Answer:
    """What the program found."""
    view: dict
    """view.json"""
    reach: float
    """Distance from the centre to the farthest vertex."""
    tour: "list"
    """(3,) position and (4,) rotation x y z w of each pose on a round, at equal times; the last is the first."""
    tour_fov_y: float
    """Of the camera on that round, radians."""


def answer(vertices, faces, *, up, front, views, size, seconds, path):
    """Asks `path`. views: how many that together show most; 0: the best and the worst alone. size: of the picture."""
    with tempfile.TemporaryDirectory(prefix="vantage-") as folder:
        scratch = pathlib.Path(folder)
        (scratch / "selection.ply").write_bytes(ply_of(vertices, faces))
        command = [path, "view", "selection.ply", "-o", "out", "--json", "--no-images", "-q", "--up=" + up,
                   "--front=" + front, f"--size={size[0]}x{size[1]}"]
        command += [f"--views={views}"] if views else []
        view = json.loads(output_of(command, scratch, seconds))
        centre = np.array(view["camera"]["target"])
        reach = float(np.linalg.norm(vertices - centre, axis=1).max())
        tour = scratch / "out/tour.gltf"
        if not tour.exists():
            return Answer(view, reach, [], 0.0)
        gltf = json.loads(tour.read_text())
        return Answer(view, reach, poses_of(gltf), gltf["cameras"][0]["perspective"]["yfov"])


def output_of(command, folder, seconds):
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=seconds, check=False)
    except (FileNotFoundError, PermissionError):
        raise Failed(f"There is no program {command[0]}: install vantage, or set its path in the add-on's "
                     "preferences") from None
    except OSError as error:
        raise Failed(f"{command[0]} cannot be run: {error.strerror}; set the program's path in the add-on's "
                     "preferences") from None
    except subprocess.TimeoutExpired:
        raise Failed(f"Stopped after {seconds} seconds; the add-on's preferences allow for more") from None
    if done.returncode != 0:
        said = done.stderr.strip().splitlines()
        raise Failed(said[-1] if said else f"{command[0]} ended with {done.returncode} and said nothing")
    return done.stdout


def ply_of(vertices, faces):
    """Binary PLY, coordinates in full."""
    rows = np.empty(len(faces), [("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, faces
    head = ("ply\nformat binary_little_endian 1.0\n"
            f"element vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
            f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    return head.encode() + vertices.astype("<f8").tobytes() + rows.tobytes()


def poses_of(gltf):
    """Positions and rotations of the animated camera of a tour.gltf."""
    data = base64.b64decode(gltf["buffers"][0]["uri"].partition("base64,")[2])

    def rows(number):
        accessor = gltf["accessors"][number]
        part = gltf["bufferViews"][accessor["bufferView"]]
        start = part.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        return np.frombuffer(data, "<f4", accessor["count"] * width, start).reshape(-1, width)

    animation = gltf["animations"][0]
    by_path = {channel["target"]["path"]: rows(animation["samplers"][channel["sampler"]]["output"])
               for channel in animation["channels"]}
    return list(zip(by_path["translation"].astype(float), by_path["rotation"].astype(float)))
