# SPDX-License-Identifier: MIT
"""Entries of Sweet Home 3D's furniture libraries (.sh3f): icons, and models as coloured points (numpy, PIL).

A library is a ZIP file whose PluginFurnitureCatalog.properties lists for each thing its model (here: OBJ with
MTL), icon, category, licence's holder and model_rotation. After that rotation y is up and +z in front.
"""
import io
import pathlib
import posixpath
import re
import zipfile

import numpy as np
from PIL import Image

PROPERTIES = "PluginFurnitureCatalog.properties"
SEEN_ALPHA = 40      # of 255: where an icon shows something, glass and thin rods included
BACKGROUND = 12      # of 255: how far an opaque icon's pixel is from its corner to be no background

ALIKE_DISTANCE = 0.02  # of the half diagonal: mean distance of an image's points to the surface's, which are as dense


class Entry:
    """What the catalogue says of one thing: strings as they stand there."""

    def __init__(self, library, values):
        self.library = library
        self.archive = library.stem
        self.model, self.icon = values["model"], values.get("icon", "")
        self.name, self.category = values.get("name", ""), values.get("category", "")
        self.model_rotation = values.get("modelRotation", "")

    def rotation(self):
        if not self.model_rotation:
            return np.eye(3)
        return np.array([float(x) for x in self.model_rotation.split()]).reshape(3, 3)


def entries_of(library):
    """Entries of a library that have an OBJ model and an icon, in its order."""
    with zipfile.ZipFile(library) as archive:
        names, text = set(archive.namelist()), archive.read(PROPERTIES).decode("latin1")
    found = {}
    for line in text.splitlines():
        match = re.match(r"(\w+)#(\d+)=(.*)", line)
        if match:
            found.setdefault(int(match[2]), {})[match[1]] = match[3].strip()
    for _, values in sorted(found.items()):
        model, icon = values.get("model", "").lstrip("/"), values.get("icon", "").lstrip("/")
        if model.endswith(".obj") and model in names and icon in names:
            yield Entry(library, values)


def read_icon(archive, name):
    """Colours (rows × columns × 3, 0 to 1, over white) and whether a pixel shows the thing."""
    picture = Image.open(io.BytesIO(archive.read(name.lstrip("/"))))
    pixels = np.asarray(picture.convert("RGBA"), float)
    alpha = pixels[..., 3:]
    if alpha.min() == 255:  # no alpha: the corners are background
        corner = pixels[0, 0, :3]
        shown = np.abs(pixels[..., :3] - corner).max(-1) > BACKGROUND
    else:
        shown = alpha[..., 0] > SEEN_ALPHA
    return (pixels[..., :3] * alpha / 255 + 255 - alpha) / 255, shown


class Faces:
    """Triangles of an OBJ with their colours."""

    def __init__(self, archive, name, rotation):
        self.archive, self.folder, self.names = archive, posixpath.dirname(name), set(archive.namelist())
        self.materials, self.textures = {}, {}
        points, places, corners, corner_places, material = [], [[0.0, 0.0]], [], [], []
        current = None
        for line in archive.read(name).decode("latin1").replace("\\\n", " ").splitlines():
            words = line.split()
            key = words[0] if words else ""
            if key == "v":
                points.append([float(x) for x in words[1:4]])
            elif key == "vt":
                places.append([float(x) for x in words[1:3]])
            elif key == "mtllib":
                self.read_materials(line.split(None, 1)[1].strip())
            elif key == "usemtl":
                current = line.split(None, 1)[1].strip() if len(words) > 1 else None
            elif key == "f":
                face = [[int(x or 0) for x in word.split("/")] for word in words[1:]]
                v = [c[0] - 1 if c[0] > 0 else len(points) + c[0] for c in face]
                t = [0 if len(c) < 2 or c[1] == 0 else c[1] if c[1] > 0 else len(places) + c[1] for c in face]
                for i in range(1, len(v) - 1):
                    corners.append((v[0], v[i], v[i + 1]))
                    corner_places.append((t[0], t[i], t[i + 1]))
                    material.append(current)
        self.points = np.array(points).reshape(-1, 3) @ rotation.T
        self.corners = np.array(corners, int).reshape(-1, 3)
        self.places, self.corner_places = np.array(places), np.array(corner_places, int).reshape(-1, 3)
        self.material = material

    def read_materials(self, name):
        path = posixpath.normpath(posixpath.join(self.folder, name))
        if path not in self.names:
            return
        current = {}
        for line in self.archive.read(path).decode("latin1").splitlines():
            words = line.split()
            if words[:1] == ["newmtl"]:
                current = self.materials.setdefault(line.split(None, 1)[1].strip() if len(words) > 1 else "", {})
            elif words[:1] == ["Kd"] and len(words) >= 4:
                current["colour"] = np.array([float(x) for x in words[1:4]])
            elif words[:1] == ["map_Kd"] and len(words) > 1:
                current["texture"] = line.split(None, 1)[1].strip()

    def texture(self, name):
        """A texture as rows × columns × 3, 0 to 1, at most 512 wide; None if it cannot be read."""
        if name not in self.textures:
            path = posixpath.normpath(posixpath.join(self.folder, name.split()[-1] if " -" in name else name))
            try:
                picture = Image.open(io.BytesIO(self.archive.read(path))).convert("RGB")
                picture.thumbnail((512, 512))
                self.textures[name] = np.asarray(picture, float) / 255
            except (KeyError, OSError):
                self.textures[name] = None
        return self.textures[name]

    def colours(self, faces, shares):
        """The colour of a point of each face that has these shares of its corners."""
        result = np.full((len(faces), 3), 0.7)
        kinds = {}
        for i, name in enumerate(self.material):
            kinds.setdefault(name, []).append(i)
        of_face = np.zeros(len(self.material), int)
        for number, faces_of in enumerate(kinds.values()):
            of_face[faces_of] = number
        uv = np.einsum("ij,ijk->ik", shares, self.places[self.corner_places[faces]])
        for number, name in enumerate(kinds):
            here = of_face[faces] == number
            material = self.materials.get(name, {})
            picture = self.texture(material["texture"]) if "texture" in material else None
            if picture is not None:
                part = np.mod(np.nan_to_num(uv[here]), 1.0)
                rows, columns = picture.shape[:2]
                result[here] = picture[((1 - part[:, 1]) * (rows - 1)).round().astype(int),
                                       (part[:, 0] * (columns - 1)).round().astype(int)]
            elif "colour" in material:
                result[here] = material["colour"]
        return np.clip(result, 0, 1)


    def write(self, file):
        """As OBJ, shape only."""
        with open(file, "w", encoding="ascii") as stream:
            stream.writelines("v %.7g %.7g %.7g\n" % tuple(p) for p in self.points)
            stream.writelines("f %d %d %d\n" % tuple(f + 1) for f in self.corners)


class Cloud:
    """Points spread evenly over a surface: centred on the box and scaled to a half diagonal of 1."""

    def __init__(self, faces, count):
        a, b, c = (faces.points[faces.corners[:, k]] for k in range(3))
        cross = np.cross(b - a, c - a)
        area = np.linalg.norm(cross, axis=1)
        used = faces.points[faces.corners.ravel()]
        low, high = used.min(0), used.max(0)
        self.half_sizes = (high - low) / max(np.linalg.norm(high - low), 1e-300)
        random = np.random.default_rng(0)
        # Even steps along the summed area, in the faces' order: no face of some size is left out.
        at = (np.arange(count) + random.random(count)) / count * area.sum()
        pick = np.minimum(np.searchsorted(np.cumsum(area), at), len(area) - 1)
        u, v = random.random((2, count))
        u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
        shares = np.stack([1 - u - v, u, v], 1)
        points = np.einsum("ij,ijk->ik", shares, np.stack([a[pick], b[pick], c[pick]], 1))
        order = random.permutation(count)  # so that the first points are a sample of all
        self.points = ((points - (low + high) / 2) / max(np.linalg.norm(high - low) / 2, 1e-300))[order]
        self.normals = (cross[pick] / np.maximum(area[pick], 1e-300)[:, None])[order]
        self.colours = faces.colours(pick, shares)[order]


    def is_alike(self, matrix):
        """Whether the surface is its own image: points' images lie near points."""
        images = self.points[:1000] @ np.asarray(matrix).T
        others = self.points[-20000:]
        squares = (others ** 2).sum(1)
        nearest = [(squares - 2 * others @ p).min() + p @ p for p in images]
        return bool(np.sqrt(np.maximum(nearest, 0)).mean() < ALIKE_DISTANCE)

    def mirror_planes(self):
        """Normals: of left and right always, of front and back if alike, of every tenth degree if it is round."""
        turns = [np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]]) for a in np.radians((25, 80))]
        if all(self.is_alike(turn) for turn in turns):
            return [[round(float(np.cos(a)), 4), 0, round(float(np.sin(a)), 4)] for a in np.radians(range(0, 180, 10))]
        return [[1, 0, 0]] + [[0, 0, 1]] * self.is_alike(np.diag([1, 1, -1]))


def read_faces(archive, entry):
    return Faces(archive, entry.model.lstrip("/"), entry.rotation())


def read_cloud(archive, entry, count):
    faces = read_faces(archive, entry)
    return Cloud(faces, count) if len(faces.corners) else None


def libraries(packages):
    return sorted(pathlib.Path(packages).rglob("*.sh3f"))
