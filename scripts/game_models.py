# SPDX-License-Identifier: MIT
"""Models of UFO: Alien Invasion and SuperTuxKart for orientation_data.py (numpy)."""
import pathlib
import struct
import zipfile

import numpy as np

# Names of parts that are no things of their own: stems without leaves, wrecks, what water looks like.
PARTS = ("crash", "blaetter", "stamm", "leaves", "engine", "_wing", "weapon", "head0", "turret", "pods", "_hull",
         "_upper", "_lower", "collision", "_lod", "_LOD", "_low", "-low", "wheel", "water", "shield", "arrow", "shadow",
         "speed", "exhaust", "_hit", "spark", "fitchBarrel", "_structure", "_beam", "_stem", "_bloom")
FEWEST_FACES = 40
MOST_OF_A_SERIES = 3


def read_md2(data):
    """Points, faces, places on the texture and faces of these, of the first frame of a model of Quake 2's format."""
    if data[:8] != b"IDP2\x08\x00\x00\x00":
        raise ValueError("not of version 8")
    width, height, _, _, points, places, faces = struct.unpack_from("<7i", data, 8)
    at_places, at_faces, at_frames = struct.unpack_from("<3i", data, 48)
    scale = np.frombuffer(data, "<f4", 6, at_frames)
    bytes_of = np.frombuffer(data, np.uint8, 4 * points, at_frames + 40).reshape(-1, 4)
    pixels = np.frombuffer(data, "<i2", 2 * places, at_places).reshape(-1, 2).astype(float)
    flipped = np.stack([pixels[:, 0] / max(width, 1), 1 - pixels[:, 1] / max(height, 1)], 1)
    corners = np.frombuffer(data, "<i2", 6 * faces, at_faces).reshape(-1, 2, 3)[:, :, ::-1]  # clockwise there
    return bytes_of[:, :3] * scale[:3] + scale[3:], corners[:, 0].tolist(), flipped, corners[:, 1].tolist()


class Spm:
    """A model of SuperTuxKart, its left-handed coordinates made right-handed by z's sign."""

    def __init__(self, data):
        if data[:2] != b"SP":
            raise ValueError("no SPM file")
        self.data, self.at = data, 28
        self.is_skinned = data[2] & 7 == 1
        self.has_normals, self.has_colours, self.has_tangents = (data[3] >> bit & 1 for bit in range(3))
        self.points, self.faces, self.places, self.place_faces = [], [], [], []
        textures = [[self.name(), self.name()] for _ in range(self.take("<H")[0])]
        for _ in range(self.take("<H")[0]):
            for _ in range(self.take("<H")[0]):
                self.read_buffer(textures)

    def take(self, layout):
        values = struct.unpack_from(layout, self.data, self.at)
        self.at += struct.calcsize(layout)
        return values

    def name(self):
        length = self.take("B")[0]
        self.at += length
        return length > 0

    def read_buffer(self, textures):
        points, corners, texture = self.take("<IIH")
        has_one, has_two = textures[texture]
        first, first_place = len(self.points), len(self.places)
        for _ in range(points):
            x, y, z = self.take("<3f")
            self.points.append((x, y, -z))
            self.at += 4 * self.has_normals
            if self.has_colours:
                self.at += 1 if self.data[self.at] == 128 else 4
            if has_one:
                u, v = self.take("<2e")
                self.places.append((u, 1 - v))
                self.at += 4 * has_two + 4 * self.has_tangents
            self.at += 16 * self.is_skinned
        kind = np.dtype("<u2" if points > 255 else "u1")
        indices = np.frombuffer(self.data, kind, corners, self.at).astype(int).reshape(-1, 3)[:, ::-1]
        self.at += corners * kind.itemsize
        self.faces += (indices + first).tolist()
        self.place_faces += (indices + first_place).tolist() if has_one else [[None] * 3] * len(indices)


def ufo_models(packages):
    """(stem, series, group, kind, up, front, read) of objects, people, aircraft; z is up."""
    for file in sorted(packages.rglob("ufoai/base/0models.pk3")):
        with zipfile.ZipFile(file) as archive:
            for name in sorted(n for n in archive.namelist() if n.endswith(".md2")):
                path = pathlib.PurePosixPath(name)
                folders = path.parts[1:-1]
                is_aircraft = folders[0] == "aircraft" and folders[1].startswith(("inter_", "drop_", "ufo_"))
                if folders[0] in ("objects", "aliens", "animals", "civilians", "soldiers") or is_aircraft:
                    kind = folders[1] if folders[0] == "objects" and len(folders) > 2 else folders[0]
                    series = path.stem.rstrip("0123456789_abcdefghlms")
                    yield ("_".join([*folders, path.stem]), "_".join([*folders, series]), "ufoai",
                           f"{kind}, UFO AI", "z", "", read_md2(archive.read(name)))


def kart_models(packages):
    """The same of what stands beside the tracks, and of karts, which face z there, -z here; y is up."""
    for data in sorted(packages.rglob("games/supertuxkart/data")):
        for file in sorted([*data.glob("library/*/*.spm"), *data.glob("models/*.spm"), *data.glob("karts/*/*.spm")]):
            folder, place = file.parent.name, file.parent.parent.name
            is_kart = place == "karts"
            if folder.startswith("gfx") or (is_kart and "kart" not in file.stem and "main" not in file.stem
                                            and file.stem != folder):
                continue
            model = Spm(file.read_bytes())
            series = folder.rstrip("abcdefghi_") if place == "library" else f"{folder}_{file.stem}"
            kind = "karts" if is_kart else "beside the tracks" if place == "library" else "small things"
            yield (f"{folder}_{file.stem}", series, "supertuxkart", f"{kind}, SuperTuxKart", "y",
                   "-z" if is_kart else "", (np.array(model.points), model.faces, model.places, model.place_faces))


def games(packages):
    """(stem, series, group, kind, up, front, (points, faces, places, faces of places)), at most three of a series."""
    seen = {}
    for entry in [*ufo_models(packages), *kart_models(packages)]:
        stem, series, (_, faces, _, _) = entry[0], entry[1], entry[-1]
        if len(faces) >= FEWEST_FACES and not any(part in stem for part in PARTS):
            seen[series] = seen.get(series, 0) + 1
            if seen[series] <= MOST_OF_A_SERIES:
                yield entry
