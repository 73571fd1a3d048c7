#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Recovers the cameras of a furniture catalogue's icons (numpy, PIL).

    apt-get download sweethome3d-furniture; dpkg -x sweethome3d-furniture*.deb packages
    scripts/rebuild_catalogue.py packages -o FOLDER [--listed VIEWS] [--pictures] [--dataset]

Writes FOLDER/views.csv: for each entry whose icon fits its model archive, category, model, icon, name,
model_rotation, overlap, azimuth_deg, elevation_deg, fov_deg, dx, dy, dz (from the box's centre to the eye, y up, +z
in front, after model_rotation), second_* (the best pose at least 30 degrees away that cannot be told from it; 0 if
there is none), and last confidence, 0 to 1. FOLDER/refused.csv has the rest, with the reason. --listed is a file
with columns archive and model: only these are done. --pictures draws each icon beside its pose, FOLDER/pictures.
--dataset writes FOLDER/people.json and FOLDER/models for `vantage eval`: left and right are mirror images, front and
back of what mirrors them, and all sides of what is round. The same bytes come out whatever --jobs is. compare_views.py compares two such tables. No
model and no icon becomes part of the project: their licences are in the packages.
"""
import argparse
import csv
import json
import os
import pathlib
import sys
import zipfile
from multiprocessing import Pool

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):  # before numpy: one process a core is enough
    os.environ.setdefault(name, "1")

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import numpy as np  # noqa: E402

import catalogue_models  # noqa: E402
import icon_pose  # noqa: E402
import pose_pictures  # noqa: E402
from pose_choice import choose  # noqa: E402

COLUMNS = ("archive category model icon name model_rotation overlap azimuth_deg elevation_deg fov_deg dx dy dz "
           "second_overlap second_azimuth_deg second_elevation_deg confidence").split()
POINTS = 80000


def stem_of(entry):
    return f"{entry.archive}__{pathlib.Path(entry.model).stem}"


class Work:
    """What one process does with one entry."""

    def __init__(self, pictures, models):
        self.pictures, self.models = pictures, models

    def __call__(self, entry):
        try:
            with zipfile.ZipFile(entry.library) as archive:
                colours, shown = catalogue_models.read_icon(archive, entry.icon)
                faces = catalogue_models.read_faces(archive, entry)
                cloud = catalogue_models.Cloud(faces, POINTS) if len(faces.corners) else None
        except (KeyError, ValueError, IndexError, OSError) as error:
            return entry, None, f"cannot be read: {error}", []
        if cloud is None or not shown.any():
            return entry, None, "has no faces" if cloud is None else "its icon is empty", []
        choice = choose(icon_pose.find_poses(cloud, colours, shown))
        if self.pictures:
            pose_pictures.draw(self.pictures / f"{stem_of(entry)}.png", colours, cloud, choice.pose)
        planes = []
        if self.models and not choice.refusal:
            faces.write(self.models / f"{stem_of(entry)}.obj")
            planes = cloud.mirror_planes()
        return entry, choice, choice.refusal, planes


def row_of(entry, choice):
    d = icon_pose.direction(choice.pose.azimuth, choice.pose.elevation)
    second = choice.second
    return [entry.archive, entry.category, entry.model, entry.icon, entry.name, entry.model_rotation,
            "%.3f" % choice.pose.overlap, "%.1f" % choice.pose.azimuth, "%.1f" % choice.pose.elevation,
            "%.1f" % np.degrees(choice.pose.field), *("%.3f" % (x + 0.0) for x in d),
            *(("%.3f" % second.overlap, "%.1f" % second.azimuth, "%.1f" % second.elevation) if second
              else ("0.000", "0.0", "0.0")), "%.2f" % choice.confidence]


def wanted_entries(packages, listed):
    names = None
    if listed:
        with open(listed, newline="", encoding="utf-8") as file:
            names = {(row["archive"], row["model"]) for row in csv.DictReader(file)}
    return [entry for library in catalogue_models.libraries(packages)
            for entry in catalogue_models.entries_of(library)
            if names is None or (entry.archive, entry.model) in names]


def record_of(entry, choice, planes):
    """The entry in a manifest of `vantage eval`."""
    d = icon_pose.direction(choice.pose.azimuth, choice.pose.elevation)
    return {"model": f"models/{stem_of(entry)}.obj", "up": "y", "views": [{"direction": [round(x, 4) + 0.0 for x in d]}],
            "mirror_planes": planes}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packages", type=pathlib.Path)
    parser.add_argument("-o", "--output", required=True, type=pathlib.Path)
    parser.add_argument("--listed", type=pathlib.Path)
    parser.add_argument("--pictures", action="store_true")
    parser.add_argument("--dataset", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    entries = wanted_entries(arguments.packages, arguments.listed)
    if not entries:
        sys.exit(f"{arguments.packages}: holds no .sh3f library with such entries; unpack sweethome3d-furniture into it")
    pictures = arguments.output / "pictures" if arguments.pictures else None
    models = arguments.output / "models" if arguments.dataset else None
    for folder in (arguments.output, pictures, models):
        if folder:
            folder.mkdir(parents=True, exist_ok=True)
    accepted, refused, records = [], [], []
    with Pool(arguments.jobs) as pool:
        for count, (entry, choice, refusal, planes) in enumerate(pool.imap(Work(pictures, models), entries), 1):
            if refusal:
                about = row_of(entry, choice) if choice else [entry.archive, entry.category, entry.model]
                refused.append([refusal] + about)
            else:
                accepted.append(row_of(entry, choice))
                records.append(record_of(entry, choice, planes))
            print(f"\r{count} of {len(entries)}, {len(refused)} refused ", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    for name, header, rows in (("views.csv", COLUMNS, accepted), ("refused.csv", ["reason"] + COLUMNS, refused)):
        with open(arguments.output / name, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerows([header] + rows)
    if arguments.dataset:
        manifest = json.dumps({"models": records}, indent=1)
        (arguments.output / "people.json").write_text(manifest + "\n", encoding="utf-8")
    print(f"{len(accepted)} views, {len(refused)} refused: {arguments.output / 'views.csv'}")


if __name__ == "__main__":
    main()
