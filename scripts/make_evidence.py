#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the tables of docs/evidence.md: people's views by `vantage eval`, a catalogue's by fit_choices.py (numpy).

    scripts/make_evidence.py --vantage PROGRAM --work FOLDER [--people FOLDER] [--packages FOLDER --views VIEWS]

--people is a data set of `vantage eval`; --packages and --views are those of fit_choices.py, VIEWS as
rebuild_catalogue.py writes it. What is not given keeps its table. Each table has the error, folded, with its interval
of 95 %, and what it is less than that of the best constant camera, paired: fitted on the other models of people's, and
in the same folds as the model of choice on the catalogue. What was measured is kept in --work, and a run that was
stopped goes on from there.
"""
import argparse
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
METHOD = "kssm"
ROWS = {"best possible single view", "another person", "best constant camera, model left out", "three-quarter (1, 0.6, 1)",
        "vantage view", METHOD}

LEFT_OUT = ("| f3d", "| isometric", "| straight front", "| best constant camera, archives",
            "| random")


def of_people(program, data, folder):
    """The rows above of the table of views that an evaluation writes."""
    subprocess.run([program, "eval", data, "-o", folder, "--method", METHOD], check=True, stdout=subprocess.DEVNULL)
    lines = (folder / "tables.md").read_text(encoding="utf-8").splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("| view | error, folded"))
    count = next(line for line in lines if re.fullmatch(r"\d+ models\.", line))
    out = [count, "", "| view | error [95 %] | less the constant camera's |", "| --- | --- | --- |"]
    for line in lines[start + 2:]:
        if not line.startswith("|"):
            break
        name, error, less = (cell.strip() for cell in line.strip("|").split("|")[:3])
        if name in ROWS:
            shown = "`vantage view`" if name == "vantage view" else name
            out.append(f"| {shown} | {error} | {less} |")
    return "\n".join(out) + "\n"


def of_catalogue(program, packages, views, folder):
    """The table that fit_choices.py prints, without some of its fixed cameras."""
    done = subprocess.run([sys.executable, ROOT / "scripts/fit_choices.py", packages, "--views", views, "--vantage", program,
                           "--cache", folder], check=True, capture_output=True, text=True)
    return "".join(line + "\n" for line in done.stdout.strip().splitlines() if not line.startswith(LEFT_OUT))


def put(page, name, content):
    text = page.read_text(encoding="utf-8")
    begin, end = f"<!-- make_evidence.py begins: {name} -->", f"<!-- make_evidence.py ends: {name} -->"
    if begin not in text or end not in text:
        sys.exit(f"{page}: has no table of {name}; write the lines '{begin}' and '{end}' where it belongs")
    page.write_text(text[:text.index(begin) + len(begin)] + "\n" + content + text[text.index(end):], encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vantage", required=True)
    parser.add_argument("--work", required=True, type=pathlib.Path)
    parser.add_argument("--people", type=pathlib.Path)
    parser.add_argument("--packages", type=pathlib.Path)
    parser.add_argument("--views", type=pathlib.Path)
    parser.add_argument("--page", type=pathlib.Path, default=ROOT / "docs/evidence.md")
    arguments = parser.parse_args()
    if (arguments.packages is None) != (arguments.views is None):
        parser.error("--packages and --views need each other")
    arguments.work.mkdir(parents=True, exist_ok=True)
    if arguments.people:
        put(arguments.page, "people", of_people(arguments.vantage, arguments.people, arguments.work / "people"))
    if arguments.packages:
        put(arguments.page, "catalogue",
            of_catalogue(arguments.vantage, arguments.packages, arguments.views, arguments.work / "catalogue"))


if __name__ == "__main__":
    main()
