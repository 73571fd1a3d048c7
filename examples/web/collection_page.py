#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A web page of a collection: every glTF model to turn with the mouse, starting from its best view.

    vantage batch models/ -o results --write best,json
    collection_page.py results -o models/index.html --element model-viewer.min.js

Put the page where the keys of the batch lead from: beside the folder that was given to it. --element is the script of
<model-viewer> (npm: @google/model-viewer), served from where the page is. Models of other formats are shown as pictures.
"""
import argparse
import html
import json
import os
import pathlib
import subprocess
import urllib.parse

PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>{title}</title>
<script type="module" src="{element}"></script>
<style>
body {{ font: 1rem sans-serif; display: grid; grid-template-columns: repeat(auto-fill, minmax(16rem, 1fr)); gap: 1rem }}
figure {{ margin: 0 }} model-viewer, img {{ width: 100%; aspect-ratio: 4 / 3; object-fit: contain }}
</style>
{figures}
</html>
"""


def attributes(pairs):
    return " ".join(f'{name}="{html.escape(value)}"' for name, value in pairs)


def figure(row, pictures):
    """The model of one row of the batch."""
    picture = urllib.parse.quote(f"{pictures}/{row['folder']}/best.png")
    camera = row["best"]["model_viewer"]
    name = html.escape(row["name"])
    is_file = "//" not in row["key"] and "\\x" not in row["key"]  # not in an archive, and of a name that is text
    if row["format"] in ("gltf", "glb") and camera and is_file:
        fields = [("src", urllib.parse.quote(row["key"])), ("alt", row["name"]), ("poster", picture), ("loading", "lazy"), *camera.items()]
        shown = f"<model-viewer {attributes(fields)} camera-controls></model-viewer>"
    else:
        shown = f"<img {attributes([('src', picture), ('alt', row['name'])])}>"
    return f"<figure>{shown}<figcaption>{name}</figcaption></figure>"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--element", required=True)
    parser.add_argument("--title", default="Models")
    options = parser.parse_args()
    rows = subprocess.run([os.environ.get("VANTAGE", "vantage"), "results", "export", options.results, "--format",
                           "jsonl"], check=True, capture_output=True, text=True).stdout.splitlines()
    pictures = os.path.relpath(options.results / "models", options.output.resolve().parent)
    done = [row for row in map(json.loads, rows) if row["status"] == "done"]
    figures = "\n".join(figure(row, pictures) for row in done)
    options.output.write_text(PAGE.format(title=html.escape(options.title), element=html.escape(options.element),
                                          figures=figures), encoding="utf-8")


if __name__ == "__main__":
    main()
