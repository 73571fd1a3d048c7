#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the models and labels that fit_orientation.py reads, from unpacked Debian packages (numpy).

    apt-get download sweethome3d-furniture sweethome3d flightgear-data-ai torcs-data 0ad-data megaglest-data
    for p in *.deb; do dpkg -x $p packages; done
    scripts/orientation_data.py packages OUT [--listed views.csv] [--scans FOLDER] > labels.csv

Catalogue entries have y up and +z in front after their model_rotation; aircraft of FlightGear y up and the
nose at -x, cars of TORCS y up and +x in front (AC3D files);
creatures of 0 A.D. y up and -z in front, units of MegaGlest y up. --listed names the entries of the archives that
may be used (columns archive, model); without it all are. --scans is a folder with the files that
scripts/orientation_labels.csv says up and front of. Nothing of these models becomes part of the project.
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


def write_obj(file, points, faces):
    with open(file, "w", encoding="ascii") as stream:
        stream.writelines("v %.7g %.7g %.7g\n" % tuple(p) for p in points)
        stream.writelines("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)


def read_obj(text, rotation):
    points, faces = [], []
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(x) for x in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            faces.append([i - 1 if i > 0 else len(points) + i for i in corners])
    return np.array(points) @ rotation.T, faces


def catalogue(archive, properties, listed):
    """(stem, category, points, faces) of each entry that is an OBJ."""
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
        points, faces = read_obj(archive.read(model).decode("latin1"), rotation)
        if faces:
            yield pathlib.Path(model).stem, entry.get("category", ""), points, faces


class Ac3d:
    """The surfaces of an AC3D file, with the strips of TORCS."""

    def __init__(self, file):
        self.lines = file.read_text(errors="replace").split("\n")
        self.points, self.faces = [], []
        self.at = 0
        self.to_object()
        self.read(np.eye(3), np.zeros(3))

    def to_object(self):
        while self.at < len(self.lines) and not self.lines[self.at].startswith("OBJECT"):
            self.at += 1
        self.at += 1

    def read(self, turn, shift):
        own, offset, base, kind = np.eye(3), np.zeros(3), 0, 0
        while self.at < len(self.lines):
            words = self.lines[self.at].split()
            self.at += 1
            key = words[0] if words else ""
            if key == "rot":
                own = np.array([float(x) for x in words[1:10]]).reshape(3, 3).T
            elif key == "loc":
                offset = np.array([float(x) for x in words[1:4]])
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
                face = [base + int(self.lines[self.at + i].split()[0]) for i in range(count)]
                self.at += count
                if kind == 4:
                    self.faces += [face[i:i + 3] if i % 2 == 0 else face[i:i + 3][::-1] for i in range(count - 2)]
                elif kind == 0 and count >= 3:
                    self.faces.append(face)
            elif key == "kids":
                for _ in range(int(words[1])):
                    self.to_object()
                    self.read(turn @ own, shift + turn @ offset)
                return


def read_pmd(data):
    """Points and faces of a mesh of 0 A.D."""
    version, _, count = struct.unpack_from("<III", data, 4)
    at, pictures = 16, 1
    if version >= 4:
        pictures, at = struct.unpack_from("<I", data, 16)[0], 20
    size = 44 + 8 * pictures
    points = np.frombuffer(data, np.uint8, count * size, at).reshape(count, size)[:, :12].copy().view("<f4")
    at += count * size
    faces = np.frombuffer(data, "<u2", 3 * struct.unpack_from("<I", data, at)[0], at + 4)
    return points.astype(float), faces.reshape(-1, 3).tolist()


def read_g3d(data):
    """Points and faces of the first frame of a model of MegaGlest."""
    if data[:4] != b"G3D\x04":
        raise ValueError("not of version 4")
    points, faces, at, base = [], [], 7, 0
    for _ in range(struct.unpack_from("<H", data, 4)[0]):
        frames, corners, indices = struct.unpack_from("<III", data, at + 64)
        pictures = struct.unpack_from("<I", data, at + 112)[0]
        at += 116 + 64 * bin(pictures & 31).count("1")
        points.append(np.frombuffer(data, "<f4", 3 * corners, at).reshape(-1, 3))
        at += 24 * frames * corners + (8 * corners if pictures else 0)
        faces += (np.frombuffer(data, "<u4", indices, at).reshape(-1, 3) + base).tolist()
        at, base = at + 4 * indices, base + corners
    return np.concatenate(points).astype(float), faces


def creatures(packages):
    """(stem, group, kind, front, points, faces) of what stands in the games, at most three of a name."""
    seen = {}
    for file in sorted(packages.rglob("0ad/mods/public/public.zip")):
        with zipfile.ZipFile(file) as archive:
            for name in sorted(n for n in archive.namelist()
                               if n.startswith("art/meshes/skeletal/") and "/new/" not in n):
                stem = name.split("/")[-1].split(".")[0]
                key = stem.rstrip("0123456789_abcdefg")
                seen[key] = seen.get(key, 0) + 1
                if name.endswith(".pmd") and seen[key] <= 3:
                    yield stem, "0ad", "creatures, 0 A.D.", "-z", *read_pmd(archive.read(name))
    for file in sorted(packages.rglob("megaglest/**/units/**/*.g3d")):
        unit = file.parent.parent.name
        if "stand" in file.name or "idle" in file.name or file.stem == unit:
            yield f"{unit}_{file.stem}", "megaglest", "units, MegaGlest", "", *read_g3d(file.read_bytes())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packages", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--listed", type=pathlib.Path)
    parser.add_argument("--scans", type=pathlib.Path)
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    labels = csv.writer(sys.stdout)
    labels.writerow(["file", "group", "kind", "up", "front", "fold"])

    def row(file, stem, group, kind, up, front):
        # Models of one series (bed1, bed2) are left out together.
        labels.writerow([file, group, kind, up, front, zlib.crc32(stem.rstrip("0123456789-_").encode()) % 5])

    def put(stem, group, kind, up, front, points, faces):
        file = given.out / f"{stem}.obj"
        write_obj(file, points, faces)
        row(file, stem, group, kind, up, front)

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
            for stem, category, points, faces in catalogue(archive, properties, allowed):
                put(f"{file.stem}__{stem}", f"catalogue {file.stem}", category, "y", "z", points, faces)
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
            put(f"{group}__{file.stem}", group, kind, "y", front, model.points, model.faces)
    shapes = set()  # many are there twice
    for stem, group, kind, front, points, faces in creatures(given.packages):
        shape = zlib.crc32(points.tobytes())
        if len(faces) >= 60 and shape not in shapes:
            shapes.add(shape)
            put(f"{group}__{stem}", group, kind, "y", front, points, faces)
    if given.scans:
        table = pathlib.Path(__file__).with_name("orientation_labels.csv")
        for entry in csv.DictReader(table.open(encoding="utf-8")):
            found = sorted(given.scans.rglob(entry["file"]))
            if found:
                row(found[0], entry["file"], "scans", entry["kind"], entry["up"], entry["front"])


if __name__ == "__main__":
    main()
