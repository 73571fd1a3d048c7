#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the tables of docs/evidence.md: what `vantage eval` says of people's views and of a catalogue's (no packages).

    scripts/rebuild_catalogue.py packages -o catalogue --listed VIEWS --dataset
    scripts/make_evidence.py --vantage PROGRAM --people FOLDER --catalogue catalogue/people.json --work FOLDER [--every N]

Each table has the error, folded, with the interval of 95 %, and what it is less than that of the best constant camera
fitted on the other models, paired. Runs that were stopped go on from --work. --every N takes every Nth model of the
catalogue. Rows that are in no table of the page are in --work, tables.md.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

PAGE = pathlib.Path(__file__).resolve().parents[1] / "docs/evidence.md"
METHODS = "kssm,mesh-saliency,viewpoint-entropy,projected-area"
NAMES = {"best possible single view": None, "another person": None, "best constant camera, model left out": None,
         "three-quarter (1, 0.6, 1)": None, "vantage view (searches kssm × prior)": "`vantage view`",
         "vantage view": "`vantage view`", "random": None}


def evaluated(program, data, folder, methods):
    """The table of views that an evaluation writes: cells of each row by their header."""
    subprocess.run([program, "eval", data, "-o", folder, "--method", methods], check=True, stdout=subprocess.DEVNULL)
    lines = (folder / "tables.md").read_text(encoding="utf-8").splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("| view | error, folded"))
    header = [cell.strip() for cell in lines[start].strip("|").split("|")]
    rows = []
    for line in lines[start + 2:]:
        if not line.startswith("|"):
            break
        rows.append(dict(zip(header, (cell.strip() for cell in line.strip("|").split("|")))))
    count = next(line for line in lines if re.fullmatch(r"\d+ models\.", line)).split()[0]
    return int(count), rows


def table(count, rows, wanted):
    out = [f"{count} models.", "", "| view | error | less the constant camera's | within 45° |", "| --- | --- | --- | --- |"]
    for row in rows:
        name = row["view"]
        if name in wanted:
            out.append("| %s | %s | %s | %s |" % (
                NAMES.get(name) or name, row["error, folded [95 %]"],
                row["less the best constant camera's, folded [95 %, paired]"], row["within 45° [95 %]"].split(" [")[0]))
    return "\n".join(out) + "\n"


def part_of(catalogue, every, folder):
    """A manifest of every Nth model, beside the whole one, whose paths are relative to it."""
    if every == 1:
        return catalogue
    models = json.loads(catalogue.read_text(encoding="utf-8"))["models"][::every]
    part = catalogue.with_name(f"every{every}.json")
    part.write_text(json.dumps({"models": models}) + "\n", encoding="utf-8")
    return part


def put(text, name, content):
    begin, end = f"<!-- make_evidence.py begins: {name} -->", f"<!-- make_evidence.py ends: {name} -->"
    if begin not in text or end not in text:
        sys.exit(f"{PAGE}: has no marks of {name}; write the lines '{begin}' and '{end}' where its table belongs")
    return text[:text.index(begin) + len(begin)] + "\n" + content + text[text.index(end):]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vantage", required=True)
    parser.add_argument("--people", type=pathlib.Path)
    parser.add_argument("--catalogue", type=pathlib.Path)
    parser.add_argument("--work", required=True, type=pathlib.Path)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--page", type=pathlib.Path, default=PAGE)
    arguments = parser.parse_args()
    text = arguments.page.read_text(encoding="utf-8")
    wanted = set(NAMES) | set(METHODS.split(",")) | {"pmi-saliency"}
    if arguments.people:
        folder = arguments.work / "people"
        count, rows = evaluated(arguments.vantage, arguments.people, folder, METHODS + ",pmi-saliency")
        text = put(text, "people", table(count, rows, wanted))
    if arguments.catalogue:
        part = part_of(arguments.catalogue, arguments.every, arguments.work)
        count, rows = evaluated(arguments.vantage, part, arguments.work / "catalogue", METHODS)
        text = put(text, "catalogue", table(count, rows, wanted - {"best possible single view", "another person"}))
    arguments.page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
