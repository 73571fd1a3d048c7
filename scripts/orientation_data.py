#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the models and labels that fit_orientation.py reads, from unpacked Debian packages (numpy).

    apt-get download sweethome3d-furniture sweethome3d flightgear-data-ai torcs-data 0ad-data megaglest-data \
        ufoai-data supertuxkart-data
    for p in *.deb; do dpkg -x $p packages; done
    scripts/orientation_data.py packages OUT [--listed views.csv] [--scans FOLDER] > labels.csv

Catalogue entries have y up and +z in front after their model_rotation; aircraft of FlightGear y up and the
nose at -x, cars of TORCS y up and +x in front (AC3D files);
creatures of 0 A.D. y up and -z in front, units of MegaGlest y up; what UFO: Alien Invasion and SuperTuxKart
have is in game_models.py. --listed names the entries of the archives that
may be used (columns archive, model); without it all are. --scans is a folder with the files that
scripts/orientation_labels.csv says up and front of. Of catalogue models there are two copies each, stretched
along the axes, to learn from (column copy_of). Nothing of these models becomes part of the project.
"""
import argparse
import csv
import pathlib
import re
import struct
import sys
import zipfile
import zlib

import numpy as np

from game_models import games

STRETCH = 0.2  # of the copies of catalogue models: standard deviation of each axis' log


class Shape:
    """Points, faces, and coordinates on textures (v grows upwards in the picture), if there are any."""

    def __init__(self, points=(), faces=(), places=(), place_faces=()):
        self.points, self.faces = points, faces
        self.places, self.place_faces = places, place_faces  # one index a corner, None without

    def write(self, file):
        with open(file, "w", encoding="ascii") as stream:
            stream.writelines("v %.7g %.7g %.7g\n" % tuple(p) for p in self.points)
            stream.writelines("vt %.6g %.6g\n" % tuple(p) for p in self.places)
            if not len(self.places):
                stream.writelines("f " + " ".join(str(i + 1) for i in face) + "\n" for face in self.faces)
            for face, places in zip(self.faces, self.place_faces):
                corners = (str(i + 1) if k is None else f"{i + 1}/{k + 1}" for i, k in zip(face, places))
                stream.write("f " + " ".join(corners) + "\n")


def read_obj(text, rotation):
    points, faces, places, place_faces = [], [], [], []
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(x) for x in words[1:4]])
        elif words[:1] == ["vt"]:
            places.append([float(x) for x in words[1:3]])
        elif words[:1] == ["f"]:
            corners = [[int(x or 0) for x in word.split("/")] for word in words[1:]]
            faces.append([c[0] - 1 if c[0] > 0 else len(points) + c[0] for c in corners])
            place_faces.append([None if len(c) < 2 or c[1] == 0 else c[1] - 1 if c[1] > 0 else len(places) + c[1]
                                for c in corners])
    return Shape(np.array(points) @ rotation.T, faces, places, place_faces)


def catalogue(archive, properties, listed):
    """(stem, category, shape) of each entry that is an OBJ."""
    entries = {}
    for line in archive.read(properties).decode("latin1").splitlines():
        found = re.match(r"(\w+)#(\d+)=(.*)", line)
        if found:
            entries.setdefault(found[2], {})[found[1]] = found[3].strip()
    names = set(archive.namelist())
    for entry in entries.values():
        model = entry.get("model", "").lstrip("/")
        if not model.endswith(".obj") or model not in names or (listed is not None and model not in listed):
            continue
        rotation = np.eye(3)
        if entry.get("modelRotation"):
            rotation = np.array([float(x) for x in entry["modelRotation"].split()]).reshape(3, 3)
        shape = read_obj(archive.read(model).decode("latin1"), rotation)
        if shape.faces:
            yield pathlib.Path(model).stem, entry.get("category", ""), shape


class Ac3d(Shape):
    """The surfaces of an AC3D file, with the strips of TORCS."""

    def __init__(self, file):
        super().__init__([], [], [], [])
        self.lines = file.read_text(errors="replace").split("\n")
        self.at = 0
        self.to_object()
        self.read(np.eye(3), np.zeros(3))

    def to_object(self):
        while self.at < len(self.lines) and not self.lines[self.at].startswith("OBJECT"):
            self.at += 1
        self.at += 1

    def read(self, turn, shift):
        own, offset, base, kind, has_texture = np.eye(3), np.zeros(3), 0, 0, False
        while self.at < len(self.lines):
            words = self.lines[self.at].split()
            self.at += 1
            key = words[0] if words else ""
            if key == "rot":
                own = np.array([float(x) for x in words[1:10]]).reshape(3, 3).T
            elif key == "loc":
                offset = np.array([float(x) for x in words[1:4]])
            elif key == "texture":
                has_texture = True
            elif key == "data":
                rest = int(words[1])
                while rest > 0:
                    rest -= len(self.lines[self.at]) + 1
                    self.at += 1
            elif key == "numvert":
                count = int(words[1])
                rows = [self.lines[self.at + i].split()[:3] for i in range(count)]
                self.at += count
                base = len(self.points)
                points = np.array(rows, float).reshape(-1, 3)
                self.points.extend(points @ (turn @ own).T + shift + turn @ offset)
            elif key == "SURF":
                kind = int(words[1], 16) & 0xF
            elif key == "refs":
                count = int(words[1])
                corners = [self.lines[self.at + i].split() for i in range(count)]
                self.at += count
                if kind == 4:
                    for i in range(count - 2):
                        self.add_face(base, corners[i:i + 3][::1 - i % 2 * 2], has_texture)
                elif kind == 0 and count >= 3:
                    self.add_face(base, corners, has_texture)
            elif key == "kids":
                for _ in range(int(words[1])):
                    self.to_object()
                    self.read(turn @ own, shift + turn @ offset)
                return

    def add_face(self, base, corners, has_texture):
        self.faces.append([base + int(corner[0]) for corner in corners])
        self.place_faces.append([len(self.places) + i if has_texture else None for i in range(len(corners))])
        if has_texture:
            self.places += [[float(x) for x in corner[1:3]] for corner in corners]


def read_pmd(data):
    """A mesh of 0 A.D."""
    version, _, count = struct.unpack_from("<III", data, 4)
    at, pictures = 16, 1
    if version >= 4:
        pictures, at = struct.unpack_from("<I", data, 16)[0], 20
    size = 44 + 8 * pictures
    vertices = np.frombuffer(data, np.uint8, count * size, at).reshape(count, size)
    points, places = (vertices[:, a:b].copy().view("<f4").astype(float) for a, b in ((0, 12), (24, 32)))
    at += count * size
    faces = np.frombuffer(data, "<u2", 3 * struct.unpack_from("<I", data, at)[0], at + 4).reshape(-1, 3).tolist()
    return Shape(points, faces, places, faces)


def read_g3d(data):
    """The first frame of a model of MegaGlest."""
    if data[:4] != b"G3D\x04":
        raise ValueError("not of version 4")
    points, faces, places, place_faces, at, base = [], [], [], [], 7, 0
    for _ in range(struct.unpack_from("<H", data, 4)[0]):
        frames, corners, indices = struct.unpack_from("<III", data, at + 64)
        pictures = struct.unpack_from("<I", data, at + 112)[0]
        at += 116 + 64 * bin(pictures & 31).count("1")
        points.append(np.frombuffer(data, "<f4", 3 * corners, at).reshape(-1, 3))
        at += 24 * frames * corners
        if pictures:
            places.append(np.frombuffer(data, "<f4", 2 * corners, at).reshape(-1, 2))
            at += 8 * corners
        found = np.frombuffer(data, "<u4", indices, at).reshape(-1, 3)
        faces += (found + base).tolist()
        first = sum(len(p) for p in places[:-1])
        place_faces += (found + first).tolist() if pictures else [[None] * 3] * len(found)
        at, base = at + 4 * indices, base + corners
    return Shape(np.concatenate(points).astype(float), faces, np.concatenate(places) if places else [], place_faces)


def creatures(packages):
    """(stem, group, kind, front, shape) of what stands in the games, at most three of a name."""
    seen = {}
    for file in sorted(packages.rglob("0ad/mods/public/public.zip")):
        with zipfile.ZipFile(file) as archive:
            for name in sorted(n for n in archive.namelist()
                               if n.startswith("art/meshes/skeletal/") and "/new/" not in n):
                stem = name.split("/")[-1].split(".")[0]
                key = stem.rstrip("0123456789_abcdefg")
                seen[key] = seen.get(key, 0) + 1
                if name.endswith(".pmd") and seen[key] <= 3:
                    yield stem, "0ad", "creatures, 0 A.D.", "-z", read_pmd(archive.read(name))
    for file in sorted(packages.rglob("megaglest/**/units/**/*.g3d")):
        unit = file.parent.parent.name
        if "stand" in file.name or "idle" in file.name or file.stem == unit:
            yield f"{unit}_{file.stem}", "megaglest", "units, MegaGlest", "", read_g3d(file.read_bytes())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packages", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--listed", type=pathlib.Path)
    parser.add_argument("--scans", type=pathlib.Path)
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    labels = csv.writer(sys.stdout)
    labels.writerow(["file", "group", "kind", "up", "front", "fold", "copy_of"])

    def row(file, stem, group, kind, up, front, copy_of="", series=None):
        # Models of one series (bed1, bed2) are left out together.
        series = series or stem.rstrip("0123456789-_")
        labels.writerow([file, group, kind, up, front, zlib.crc32(series.encode()) % 5, copy_of])

    def put(stem, group, kind, up, front, shape, series=None):
        file = given.out / f"{stem}.obj"
        shape.write(file)
        row(file, stem, group, kind, up, front, series=series)
        if group.startswith("catalogue"):  # more of what there is too little of
            random = np.random.default_rng(zlib.crc32(stem.encode()))
            for number in (1, 2):
                copy = given.out / f"{stem}~{number}.obj"
                Shape(np.asarray(shape.points) * np.exp(random.normal(0.0, STRETCH, 3)), shape.faces, shape.places,
                      shape.place_faces).write(copy)
                row(copy, stem, group, kind, up, front, file)

    listed = {}
    if given.listed:
        for entry in csv.DictReader(given.listed.open(encoding="utf-8")):
            listed.setdefault(entry["archive"], set()).add(entry["model"].lstrip("/"))
    archives = [(f, "PluginFurnitureCatalog.properties", listed.get(f.stem, set()) if given.listed else None)
                for f in sorted(given.packages.rglob("*.sh3f"))]
    archives += [(f, "com/eteks/sweethome3d/io/DefaultFurnitureCatalog.properties", None)
                 for f in sorted(given.packages.rglob("sweethome3d.jar"))]
    for file, properties, allowed in archives:
        with zipfile.ZipFile(file) as archive:
            for stem, category, shape in catalogue(archive, properties, allowed):
                put(f"{file.stem}__{stem}", f"catalogue {file.stem}", category, "y", "z", shape)
    cars = [f for f in sorted(given.packages.rglob("cars/*/*.acc")) if "-lod" not in f.name]
    folders = [f for folder in given.packages.rglob("AI/Aircraft") for f in sorted(folder.iterdir())]
    planes = [max(found, key=lambda f: f.stat().st_size) for f in folders if (found := list(f.rglob("*.ac")))]
    for file, group, kind, front in ([(f, "torcs", "racing cars", "x") for f in cars]
                                     + [(f, "fgai", "aircraft", "-x") for f in planes]):
        try:
            model = Ac3d(file)
        except (IndexError, ValueError) as error:
            print(f"left out: {file}: {error}", file=sys.stderr)
            continue
        if len(model.faces) >= 100:
            put(f"{group}__{file.stem}", group, kind, "y", front, model)
    known = set()  # many are there twice
    for stem, group, kind, front, shape in creatures(given.packages):
        bytes_of_it = zlib.crc32(shape.points.tobytes())
        if len(shape.faces) >= 60 and bytes_of_it not in known:
            known.add(bytes_of_it)
            put(f"{group}__{stem}", group, kind, "y", front, shape)
    for stem, series, group, kind, up, front, shape in games(given.packages):
        bytes_of_it = zlib.crc32(np.asarray(shape[0]).tobytes())
        if bytes_of_it not in known:
            known.add(bytes_of_it)
            put(f"{group}__{stem}", group, kind, up, front, Shape(*shape), series)
    if given.scans:
        table = pathlib.Path(__file__).with_name("orientation_labels.csv")
        for entry in csv.DictReader(table.open(encoding="utf-8")):
            found = sorted(given.scans.rglob(entry["file"]))
            if found:
                row(found[0], entry["file"], "scans", entry["kind"], entry["up"], entry["front"])


if __name__ == "__main__":
    main()
