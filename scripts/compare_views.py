#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares two tables of views of one catalogue, as rebuild_catalogue.py writes them (numpy, PIL).

    scripts/compare_views.py GIVEN NEW [--least 0.88] [--worst 20] [--packages FOLDER --sheet PICTURE]

Says how many are within 5, 10 and 20 degrees, of all and of those of which GIVEN's overlap is --least or more; on how
many the two sides of the thing disagree (one sees +z, one -z); what one has and the other has not; and the worst.
--sheet draws the worst: the icon, GIVEN's pose, NEW's pose.
"""
import argparse
import csv
import pathlib
import sys
import zipfile

import numpy as np
from PIL import Image, ImageDraw

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import catalogue_models  # noqa: E402
import fit_choices  # noqa: E402
import icon_pose  # noqa: E402
import pose_pictures  # noqa: E402

SIDEWAYS = 0.17  # of |dz|: nearer to the side than 10 degrees, neither front nor back is seen


def read(file):
    with open(file, newline="", encoding="utf-8") as stream:
        return {(row["archive"], row["model"]): row for row in csv.DictReader(stream)}


def seen_from(row):
    d = np.array([float(row[k]) for k in ("dx", "dy", "dz")])
    return d / np.linalg.norm(d)


def front_believed(row):
    """GIVEN's view as fit_choices.py reads it: where silhouettes cannot tell, the front."""
    d = fit_choices.chosen(row)
    return {**row, "dx": d[0], "dy": d[1], "dz": d[2]}


def angle(a, b):
    """Degrees between two views, plain and with left and right as one."""
    p, q = seen_from(a), seen_from(b)
    return tuple(np.degrees(np.arccos(np.clip(p @ (q * s), -1, 1))) for s in ((1, 1, 1), (-1, 1, 1)))


def summary(title, keys, given, new):
    plain = np.array([angle(given[k], new[k])[0] for k in keys])
    folded = np.array([min(angle(given[k], new[k])) for k in keys])
    dz = np.array([[seen_from(t[k])[2] for t in (given, new)] for k in keys])
    sides = (np.abs(dz).min(1) > SIDEWAYS) & (dz[:, 0] * dz[:, 1] < 0)
    cells = [f"{100 * (values <= limit).mean():.0f} %" for values in (plain, folded) for limit in (5, 10, 20)]
    print(f"| {title} | {len(keys)} | {' | '.join(cells)} | {np.median(plain):.1f}° | {sides.sum()} | "
          f"{(sides & (dz[:, 0] < 0)).sum()} |")


def sheet(file, packages, keys, given, new):
    parts = []
    for library in catalogue_models.libraries(packages):
        with zipfile.ZipFile(library) as archive:
            for entry in catalogue_models.entries_of(library):
                if (entry.archive, entry.model) not in keys:
                    continue
                rows = [table[entry.archive, entry.model] for table in (given, new)]
                colours, _ = catalogue_models.read_icon(archive, entry.icon)
                cloud = catalogue_models.read_cloud(archive, entry, 80000)
                poses = [icon_pose.Pose(*icon_pose.angles_of(seen_from(r)), float(np.radians(float(r["fov_deg"]))))
                         for r in rows]
                parts.append((keys.index((entry.archive, entry.model)), entry, rows,
                              pose_pictures.beside(colours, cloud, *poses)))
    across, height = 3, pose_pictures.SIDE + 14
    width = 3 * pose_pictures.SIDE + 10
    whole = Image.new("RGB", (across * width, -(-len(parts) // across) * height), "white")
    draw = ImageDraw.Draw(whole)
    for at, (_, entry, rows, picture) in enumerate(sorted(parts, key=lambda p: p[0])):
        x, y = at % across * width, at // across * height
        whole.paste(picture, (x, y))
        text = " / ".join(f"{r['overlap']} %.0f %.0f" % icon_pose.angles_of(seen_from(r)) for r in rows)
        draw.text((x, y + pose_pictures.SIDE + 1), f"{pathlib.Path(entry.model).stem[:20]} {text}", fill="black")
    whole.save(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("given", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    parser.add_argument("--least", type=float, default=0.88)
    parser.add_argument("--worst", type=int, default=20)
    parser.add_argument("--packages", type=pathlib.Path)
    parser.add_argument("--sheet", type=pathlib.Path)
    arguments = parser.parse_args()
    given, new = read(arguments.given), read(arguments.new)
    both = [k for k in given if k in new]
    good = [k for k in both if float(given[k]["overlap"]) >= arguments.least]
    print("| views | number | within 5° | 10° | 20° | left and right as one: 5° | 10° | 20° | median | sides disagree "
          "| given from behind |\n" + "| --- " * 11 + "|")
    for title, keys in (("in both", both), (f"given overlap {arguments.least} or more", good)):
        if keys:
            summary(title, keys, given, new)
    believed = {k: front_believed(given[k]) for k in good}
    if good:
        summary("the same, its front believed", good, believed, new)
    only = [k for k in given if k not in new]
    sound = sum(float(given[k]["overlap"]) >= arguments.least for k in only)
    print(f"\nonly given: {len(only)}, of which {sound} with an overlap of {arguments.least} or more; "
          f"only new: {sum(k not in given for k in new)}")
    worst = sorted(good, key=lambda k: -min(angle(believed[k], new[k])))[:arguments.worst]
    given = {**given, **believed}
    for key in worst:
        print("%3.0f° %s: given %s %s %s %s, new %s %s %s confidence %s" % (
            min(angle(given[key], new[key])), key[1], given[key]["overlap"],
            *("%.1f" % x for x in icon_pose.angles_of(seen_from(given[key]))), f"(second {given[key]['second_overlap']})", new[key]["overlap"],
            new[key]["azimuth_deg"], new[key]["elevation_deg"], new[key].get("confidence", "")))
    if arguments.sheet:
        sheet(arguments.sheet, arguments.packages, worst, given, new)


if __name__ == "__main__":
    main()
