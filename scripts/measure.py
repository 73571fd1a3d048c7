#!/usr/bin/env python3
"""Measures the program on real models and prints the tables of docs/performance.md and of docs/lab as Markdown.

    measure.py view   PROGRAM MODEL...    one row a model: sizes, cycles against genus, seconds by stage
    measure.py rapid  PROGRAM MODEL...    the paper's rapid search against 10 242 directions
    measure.py missed PROGRAM PICTURES MODEL...  where the paper's search misses what the global one finds on the same
                                          map, and pictures of both best views into that folder
    measure.py global PROGRAM MODEL...    the global search against the dense one, whose results are kept in the
                                          folder that VANTAGE_DENSE names, if it does, and taken from there
    measure.py smooth PROGRAM MODEL...    the largest change of score per degree between neighbouring directions, from
                                          the same dense results
    measure.py tessellation PROGRAM MODEL...  what splitting half of a model's faces in their planes does to the map,
                                          computed anew, and to the best view
    measure.py thumb  PROGRAM MODEL...    thumbnails: seconds, and their view against the best one
    measure.py pictures PROGRAM MODEL...  seconds of whole commands that draw, medians of three
    measure.py methods PROGRAM MODEL...   `view --method`, pictures and all, of every measure: seconds and exact scores
    measure.py broken PROGRAM FOLDER      how every file of a folder ends, under limits

Only ratios of one run mean something on a shared machine.
"""

import csv
import itertools
import json
import math
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

import tessellation

PAPER_SECONDS = {"rocker-arm_10044": 5.3, "cow_29000": 14.8, "venus_33066": 17.6, "horse_48485": 28.2,
                 "dinosaur_56194": 36.7, "armadillo_172966": 102.5}  # Table 1 of the paper
EPSILONS = ["0.001", "0.01", "0.1", "1", "10", "100", "1000"]
MOST_MISSED_VERTICES, MOST_PICTURED = 60_000, 6
MISSED_BEST, MISSED_WORST = 0.99, 1  # share of the global search's best; % of the range above its worst
DENSE_FOLDER = "VANTAGE_DENSE"  # the environment variable that names it
RATIO_BINS = (0.99, 0.995, 0.998, 0.999, 0.9999, 1.0, 1.0001, 1.001)
BROKEN_SECONDS = 60
BROKEN_BYTES = 4 << 30


def run(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def searcher(program, model, folder, *fixed):
    """A function of further flags that gives the result of `view` with them and the fixed ones."""
    return lambda *flags: run(program, "view", model, "-o", folder, "--no-images", "--json", *fixed, *flags)


def worst_gap(found, dense):
    """How far the worst view's score is above the dense search's, % of the dense search's range."""
    top, low = dense["best"]["score"], dense["worst"]["score"]
    return 100 * (found["worst"]["score"] - low) / (top - low)


def paper_seconds(name):
    return next((s for key, s in PAPER_SECONDS.items() if name.startswith(key)), None)


def view_table(program, models):
    print("| model | vertices | levels | nodes / edges | cycles / genus | load | contract | skeleton | map"
          " | search | total s | paper s | best score (fraction) | best direction |")
    print("| --- " * 14 + "|")
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            r = searcher(program, model, folder)()
            s, best = r["seconds"], r["best"]
            paper = paper_seconds(r["model"]["name"])
            stages = " | ".join(f"{s[k]:.2f}" for k in ("load", "contract", "skeleton", "map", "search"))
            print(f"| {r['model']['name']} | {r['model']['vertices']} | {r['contraction']['levels']} "
                  f"| {r['skeleton']['nodes']} / {r['skeleton']['edges']} "
                  f"| {r['skeleton']['cycles']} / {r['model']['genus'] if r['model']['closed'] else '–'} "
                  f"| {stages} | {s['total']:.2f} | {paper or '–'} "
                  f"| {best['score']:.1f} ({best['score_fraction']:.3f}) "
                  f"| {', '.join(f'{x:.3f}' for x in best['direction'])} |", flush=True)


def rapid_table(program, models):
    print("| model | search | ε | best / dense | worst − dense, % of range | evaluations best + worst |"
          " seconds |")
    print("| --- " * 7 + "|")
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            search = searcher(program, model, folder, "--preset", "paper")
            dense = search("--search", "exhaustive", "--subdivisions", "5")
            top = dense["best"]["score"]

            def row(label, epsilon, r):
                print(f"| {r['model']['name']} | {label} | {epsilon} | {r['best']['score'] / top:.4f} "
                      f"| {worst_gap(r, dense):.2f} | {r['search']['evaluations']} + {r['search']['worst_evaluations']} "
                      f"| {r['seconds']['search']:.2f} |", flush=True)
            row("dense", "–", dense)
            for epsilon in EPSILONS:
                row("rapid", epsilon, search("--epsilon", epsilon))


def missed_table(program, models):
    """Closed models on which the paper's whole method misses, and what it costs to find it."""
    pictures, *models = models
    print("| model | vertices | best, rapid / global | worst − global, % of range | angle of best views | evaluations |")
    print("| --- " * 6 + "|")
    tried, failed = [], []
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            info = run(program, "info", model, "--json")
            if not info["welded"]["closed"] or info["vertices"] >= MOST_MISSED_VERTICES:
                continue
            search = searcher(program, model, folder, "--preset", "paper")
            rapid, found = search(), search("--search", "global")
            ratio, gap = rapid["best"]["score"] / found["best"]["score"], worst_gap(rapid, found)
            tried.append((ratio, gap))
            if ratio >= MISSED_BEST and gap <= MISSED_WORST:
                continue
            if ratio < MISSED_BEST:
                failed.append((ratio, model, rapid["best"], found["best"]))
            costs = " and ".join(str(r["search"]["evaluations"] + r["search"]["worst_evaluations"])
                                 for r in (rapid, found))
            print(f"| {rapid['model']['name']} | {rapid['model']['vertices']} | {ratio:.4f} | {gap:.2f} "
                  f"| {angle_deg(rapid['best']['direction'], found['best']['direction']):.0f}° | {costs} |", flush=True)
    bests, worsts = (sum(bad) for bad in zip(*((r < MISSED_BEST, g > MISSED_WORST) for r, g in tried)))
    print(f"\nOf {len(tried)} models: best below {MISSED_BEST} of the global one's on {bests}, worst more than "
          f"{MISSED_WORST} % of the range above on {worsts}; least {min(r for r, _ in tried):.4f}, largest "
          f"{max(g for _, g in tried):.2f} %.")
    pathlib.Path(pictures).mkdir(parents=True, exist_ok=True)
    for _, model, *views in sorted(failed)[:MOST_PICTURED]:
        for name, view in zip(("rapid", "global"), views):
            picture = pathlib.Path(pictures) / f"{pathlib.Path(model).stem}-{name}.webp"
            direction = ",".join(map(repr, view["direction"]))
            subprocess.run([program, "render", model, "-q", "--direction", direction, "--size", "256", "--background",
                            "white", "-o", picture], check=True)


def dense_search(program, model, kept):
    """The result of the dense search, with what it scored beside it; from the folder if it is there."""
    kept = pathlib.Path(kept)
    steps = kept / (pathlib.Path(model).name + ".csv")

    def search():
        with tempfile.TemporaryDirectory() as folder:
            return run(program, "view", model, "-o", folder, "--no-images", "--json", "--prior", "none", "--threads", "1",
                       "--search", "dense", "--trace", steps)
    return once(kept, pathlib.Path(model).name, search)


def global_table(program, models):
    """Costs are processor time of one thread: those of two sets of directions tell what a score takes, and what
    everything else takes that is not the search."""
    kept = os.environ.get(DENSE_FOLDER)
    print("| model | vertices | best / dense | worst − dense, % of range | scored, best + worst | estimated"
          " | seconds | cost / 200 scores |")
    print("| --- " * 8 + "|")
    ratios, gaps, costs = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            flags = ("-o", folder, "--no-images", "--json", "--prior", "none", "--threads", "1", "--search")

            def search(*way):
                _, seconds, said = timed(program, "view", model, *flags, *way)
                return seconds, json.loads(said)
            dense = dense_search(program, model, kept or folder)
            ways = [("global",), *(("exhaustive", "--subdivisions", n) for n in ("1", "3"))]
            (t_found, found), (t_few, few), (t_many, many) = (search(*way) for way in ways)
            few, many = (r["search"]["evaluations"] for r in (few, many))
            score_seconds = (t_many - t_few) / (many - few)
            seconds = t_found - (t_few - score_seconds * few)
            ratios.append(found["best"]["score"] / dense["best"]["score"])
            gaps.append(worst_gap(found, dense))
            costs.append(seconds / (200 * score_seconds))
            print(f"| {found['model']['name']} | {found['model']['vertices']} | {ratios[-1]:.5f} | {gaps[-1]:.3f} "
                  f"| {found['search']['evaluations']} + {found['search']['worst_evaluations']} "
                  f"| {found['search']['estimates']} | {seconds:.2f} | {costs[-1]:.2f} |", flush=True)
    print(f"\nBest / dense: least {min(ratios):.5f}, at least 0.999 on {sum(r >= 0.999 for r in ratios)} of "
          f"{len(ratios)}, at least 0.995 on {sum(r >= 0.995 for r in ratios)}; worst: largest gap {max(gaps):.3f} % of "
          f"the range, at most 0.5 on {sum(g <= 0.5 for g in gaps)}; cost: median {statistics.median(costs):.2f} × 200 "
          f"scores, largest {max(costs):.2f}, at most 1 on {sum(c <= 1 for c in costs)}")
    print_histogram(ratios)


def print_histogram(ratios):
    """How many of the ratios are in each bin."""
    print("\n| best / dense | models |\n| --- | --- |")
    for low, high in itertools.pairwise((-math.inf, *RATIO_BINS, math.inf)):
        count = sum(low <= r < high for r in ratios)
        ends = [f"from {low}"] * (low > 0) + [f"below {high}"] * (high < math.inf)
        print(f"| {' '.join(ends)} | {count} {'#' * count} |")


def smooth_table(program, models):
    """Is there "no sudden change"? Neighbours are the directions within 2.5° of the 10 242, 2° apart."""
    print("| model | vertices | largest change per degree, % of the range | median, % of the range |")
    print("| --- " * 4 + "|")
    largest, medians = [], []
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            kept = os.environ.get(DENSE_FOLDER, folder)
            result = dense_search(program, model, kept)
            with open(pathlib.Path(kept) / (pathlib.Path(model).name + ".csv"), encoding="utf-8") as steps:
                rows = [row for row in csv.DictReader(steps) if row["level"] == "0"]
            slopes = slopes_between(rows)
            largest.append(max(slopes))
            medians.append(statistics.median(slopes))
            print(f"| {result['model']['name']} | {result['model']['vertices']} | {largest[-1]:.2f} | {medians[-1]:.2f} |",
                  flush=True)
    print(f"\nOf {len(largest)} models the largest change is {min(largest):.1f} to {max(largest):.1f} (median "
          f"{statistics.median(largest):.1f}), above 10 on {sum(x > 10 for x in largest)}; the median change is "
          f"{min(medians):.2f} to {max(medians):.2f}")


def slopes_between(rows):
    """Changes of score between neighbours, % of the range a degree."""
    cells = {}
    for row in rows:  # buckets of the unit cube, wider than the distance of neighbours
        d = tuple(float(row[c]) for c in ("dx", "dy", "dz"))
        cells.setdefault(tuple(int(x * 20 + 40) for x in d), []).append((d, float(row["score"])))
    scores = [float(row["score"]) for row in rows]
    spread = max(scores) - min(scores)
    return [abs(s - t) / angle / spread * 100
            for cell, members in cells.items() for d, s in members
            for near in neighbours_of(cell) for e, t in cells.get(near, [])
            if 0 < (angle := math.degrees(2 * math.asin(min(1, math.dist(d, e) / 2)))) < 2.5]


def neighbours_of(cell):
    return itertools.product(*((c - 1, c, c + 1) for c in cell))


def once(folder, name, compute):
    """What a long computation gave, kept under its name if there is a folder for it."""
    if folder is None:
        return compute()
    path = pathlib.Path(folder) / (name + ".json")
    if not path.exists():
        path.write_text(json.dumps(compute()), encoding="utf-8")
    return json.loads(path.read_text(encoding="utf-8"))


def timed(program, *arguments):
    """Wall and processor seconds of a command, and what it prints."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=True)
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def pictures_table(program, models):
    size = ("--size", "512x512", "--direction", "1,0.2,0.3")
    with tempfile.TemporaryDirectory() as folder:
        commands = {"`info`": ("info",), "`thumb`, 256²": ("thumb", "-o", f"{folder}/t.png"),
                    **{f"`render --quality {q}`, 512²": ("render", "-o", f"{folder}/r.png", "--quality", q, *size)
                       for q in ("draft", "normal", "fine")}}
        print("| model |", " | ".join(commands), "|")
        print("| --- " * (1 + len(commands)) + "|")
        for model in models:
            cells = []
            for name, *flags in commands.values():
                runs = [timed(program, name, model, *flags)[:2] for _ in range(3)]
                wall, cpu = (statistics.median(column) for column in zip(*runs))
                cells.append(f"{wall:.2f} ({cpu:.2f})")
            print(f"| {pathlib.Path(model).stem} |", " | ".join(cells), "|", flush=True)


def methods_table(program, models):
    print("| model | measure | looks at | wall s | CPU s | exact scores, best + worst |\n" + "| --- " * 6 + "|")
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            for measure in run(program, "measures", "--json"):
                name = measure["name"]
                wall, cpu, said = timed(program, "view", model, "--method", name, "-o", f"{folder}/{name}", "--json")
                search = json.loads(said)["search"]
                print(f"| {pathlib.Path(model).stem} | `{name}` | {measure['cost']} | {wall:.2f} | {cpu:.2f} "
                      f"| {search['evaluations']} + {search['worst_evaluations']} |", flush=True)


def thumb_table(program, models):
    """The view of a thumbnail against `view`'s best: its score, under the whole method's own map, and the angle. Both
    maximise the objective `people`: `thumb` takes no other, and no command prints it for a given view, so a share above 1
    is no mistake."""
    print("| model | vertices | wall s | CPU s | up as in view | score / the best view's | angle to the best |")
    print("| --- " * 7 + "|")
    with tempfile.TemporaryDirectory() as folder:
        for model in models:
            wall, cpu, said = timed(program, "thumb", model, f"{folder}/thumb.png", "--json")
            thumb = json.loads(said)
            view = run(program, "view", model, "-o", f"{folder}/view", "--no-images", "--json")
            directions = pathlib.Path(folder, "directions.csv")
            directions.write_text("dx,dy,dz\n" + ",".join(map(repr, thumb["direction"])) + "\n")
            rows = subprocess.run([program, "score", model, "--directions", directions],
                                  capture_output=True, text=True, check=True).stdout.splitlines()
            best = view["best"]
            score = float(rows[1].split(",")[-1])
            print(f"| {view['model']['name']} | {view['model']['vertices']} | {wall:.2f} | {cpu:.2f} "
                  f"| {'yes' if thumb['up'] == view['up'] else 'no'} | {score / best['score']:.3f} "
                  f"| {angle_deg(thumb['direction'], best['direction']):.0f}° |", flush=True)


def angle_deg(a, b):
    return math.degrees(2 * math.asin(min(1.0, math.dist(a, b) / 2)))


def tessellation_table(program, models):
    """The map of the vertices that both meshes have, its mean by vertex or by area, and the best view without a prior."""
    print("| model | vertices | split | weight | Spearman | change, mean | largest | angle of the best views | its fraction |")
    print("| --- " * 9 + "|")
    for model in models:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)

            def mapped(file, *flags):
                subprocess.run([program, "map", "-q", "-o", folder / "map.ply", file, *flags], check=True)
                return tessellation.read_map(folder / "map.ply")
            positions, _, triangles = mapped(model)
            meshes = [(positions, triangles), tessellation.split_half(positions, triangles)]
            for i, mesh in enumerate(meshes):
                tessellation.write_off(folder / f"{i}.off", *mesh)
            for weight in ("vertex", "area"):
                flags = ("--weight", weight)
                before, after = (mapped(folder / f"{i}.off", *flags)[1][:len(positions)] for i in (0, 1))
                best = [searcher(program, folder / f"{i}.off", folder / "out", "--prior", "none", *flags)()["best"]
                        for i in (0, 1)]
                span = max(before) - min(before)
                changes = [100 * abs(a - b) / span for a, b in zip(before, after)]
                print(f"| {pathlib.Path(model).stem} | {len(positions)} | {len(meshes[1][0])} | {weight} "
                      f"| {tessellation.spearman(before, after):.3f} | {statistics.mean(changes):.1f} % "
                      f"| {max(changes):.0f} % | {angle_deg(*(b['direction'] for b in best)):.1f}° "
                      f"| {' → '.join(format(b['score_fraction'], '.3f') for b in best)} |", flush=True)


def broken_table(program, folder):
    endings = {}
    slowest = (0.0, "")
    folder = pathlib.Path(folder)
    suffixes = {".obj", ".off", ".ply", ".stl", ".gltf", ".glb", ".xyz", ".gz", ".drc"}

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (BROKEN_BYTES, BROKEN_BYTES))
    with tempfile.TemporaryDirectory() as out:
        for file in sorted(p for p in folder.rglob("*") if p.is_file() and p.suffix.lower() in suffixes):
            start = time.monotonic()
            try:
                done = subprocess.run([program, "view", file, "-o", out + "/r", "--no-images", "-q"],
                                      capture_output=True, timeout=BROKEN_SECONDS, preexec_fn=limit,
                                      check=False)
                code = done.returncode
            except subprocess.TimeoutExpired:
                code = "hung"
            slowest = max(slowest, (time.monotonic() - start, str(file.relative_to(folder))))
            kind = {0: "done", 1: "cannot be viewed, says why", 3: "unreadable, says why",
                    "hung": "hung"}.get(code, "crashed")
            endings.setdefault(kind, []).append(file.name)
    print("| ending | files |\n| --- | --- |")
    for kind in ("done", "cannot be viewed, says why", "unreadable, says why", "hung", "crashed"):
        print(f"| {kind} | {len(endings.get(kind, []))} |")
    for kind in ("hung", "crashed"):
        for name in endings.get(kind, []):
            print(f"{kind}: {name}")
    print(f"\nslowest: {slowest[1]}, {slowest[0]:.1f} s")


def main():
    tables = {"view": view_table, "rapid": rapid_table, "missed": missed_table,
              "global": global_table, "smooth": smooth_table,
              "tessellation": tessellation_table, "thumb": thumb_table, "pictures": pictures_table,
              "methods": methods_table}
    if len(sys.argv) >= 4 and sys.argv[1] in tables:
        tables[sys.argv[1]](sys.argv[2], sys.argv[3:])
    elif len(sys.argv) == 4 and sys.argv[1] == "broken":
        broken_table(sys.argv[2], sys.argv[3])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
