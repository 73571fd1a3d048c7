#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Says how often icon_pose.py finds a camera that is known (numpy, PIL): on icons that vantage draws.

    scripts/try_icon_poses.py packages --vantage PROGRAM [--models 60] [--listed VIEWS] [-o FOLDER]

Models are every so-manieth entry of the libraries (--listed: of those in its columns archive and model) without a
rotation; each is drawn with 128 x 128 pixels by `vantage render` in its own colours, from a seeded direction up to
120 degrees from the front, between 5 degrees below the horizon and 60 above, with 10 to 45 degrees of view. vantage
lights otherwise than icon_pose.py believes. -o keeps the icons and the table.
"""
import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import zipfile

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(name, "1")

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

import catalogue_models  # noqa: E402
import icon_pose  # noqa: E402
from pose_choice import choose  # noqa: E402
from rebuild_catalogue import POINTS, wanted_entries  # noqa: E402


def unpacked(archive, entry, folder):
    """The model's file with its materials and pictures beside it."""
    home = str(pathlib.PurePosixPath(entry.model.lstrip("/")).parent) + "/"
    for name in archive.namelist():
        if name.startswith(home) and not name.endswith("/"):
            file = folder / pathlib.PurePosixPath(name).name
            file.write_bytes(archive.read(name))
    return folder / pathlib.PurePosixPath(entry.model).name


def drawn(program, model, pose, folder):
    file = folder / "drawn_by_vantage.png"
    d = icon_pose.direction(pose.azimuth, pose.elevation)
    subprocess.run([program, "render", model, "-o", file, "--direction", ",".join("%.6f" % (x + 0.0) for x in d),
                    "--fov", "%.3f" % np.degrees(pose.field), "--size", "128x128", "--up", "y", "--front", "z",
                    "--background", "transparent", "--threads", "1", "-q"], check=True, timeout=120)
    pixels = np.asarray(Image.open(file).convert("RGBA"), float)
    alpha = pixels[..., 3:]
    return (pixels[..., :3] * alpha / 255 + 255 - alpha) / 255, alpha[..., 0] > catalogue_models.SEEN_ALPHA


def summary(rows):
    print("| icons | number | within 5° | 10° | 20° | elevation within 10° | from the wrong side | refused |\n"
          + "| --- " * 8 + "|")
    for title, chosen in (("all", rows), ("accepted", [r for r in rows if not r["refusal"]]),
                          ("confidence 0.5 or more", [r for r in rows if r["confidence"] >= 0.5 and not r["refusal"]])):
        if chosen:
            errors = np.array([r["error"] for r in chosen])
            shares = " | ".join(f"{100 * (errors <= limit).mean():.0f} %" for limit in (5, 10, 20))
            heights = np.array([abs(r["elevation_deg"] - r["found_elevation_deg"]) for r in chosen])
            print(f"| {title} | {len(chosen)} | {shares} | {100 * (heights <= 10).mean():.0f} % | {sum(r['wrong_side'] for r in chosen)} | "
                  f"{sum(bool(r['refusal']) for r in chosen)} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packages", type=pathlib.Path)
    parser.add_argument("--vantage", required=True)
    parser.add_argument("--models", type=int, default=60)
    parser.add_argument("--listed", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path)
    arguments = parser.parse_args()
    entries = [e for e in wanted_entries(arguments.packages, arguments.listed) if not e.model_rotation]
    entries = entries[::max(1, len(entries) // arguments.models)][:arguments.models]
    random, rows = np.random.default_rng(0), []
    for count, entry in enumerate(entries, 1):
        truth = icon_pose.Pose(random.uniform(-120, 120), random.uniform(-5, 60), np.radians(random.uniform(10, 45)))
        with zipfile.ZipFile(entry.library) as archive, tempfile.TemporaryDirectory() as folder:
            model = unpacked(archive, entry, pathlib.Path(folder))
            try:
                colours, shown = drawn(arguments.vantage, model, truth, pathlib.Path(folder))
            except (subprocess.CalledProcessError, subprocess.TimeoutExpired):
                continue
            poses = icon_pose.find_poses(catalogue_models.read_cloud(archive, entry, POINTS), colours, shown)
        choice = choose(poses)
        dz = [icon_pose.direction(p.azimuth, p.elevation)[2] for p in (truth, choice.pose)]
        rows.append({"model": entry.model, "azimuth_deg": truth.azimuth, "elevation_deg": truth.elevation,
                     "found_azimuth_deg": choice.pose.azimuth, "found_elevation_deg": choice.pose.elevation,
                     "overlap": choice.pose.overlap, "confidence": choice.confidence, "refusal": choice.refusal,
                     "error": icon_pose.between(truth, choice.pose),
                     "wrong_side": bool(dz[0] * dz[1] < 0 and min(map(abs, dz)) > 0.17), "poses": poses})
        print(f"\r{count} of {len(entries)} ", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    summary(rows)
    if arguments.output:
        arguments.output.mkdir(parents=True, exist_ok=True)
        with open(arguments.output / "tried.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(rows[0])[:-1], extrasaction="ignore", lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
