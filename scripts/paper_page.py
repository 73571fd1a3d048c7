# SPDX-License-Identifier: MIT
"""The page of paper_claims.py: what the numbers say about each claim."""

HOLDS, PARTLY, NOT = "holds", "partly", "does not hold"

NEIGHBOURING_CORNERS = 70.53  # degrees: arccos(1/3)

HEAD = """# The paper's claims, checked

Laboratory page of {month}, commit {commit}. Each claim of the paper with the command that checks it, the numbers and a
verdict. It is a record of that time and is not kept up to date; what holds now is in [evidence](../evidence.md).

Made by `scripts/paper_claims.py` from the program's own output: no number and no verdict on this page is
written by hand. Models are the paper's shapes, by the names at the end of the page; some had to be
subdivided or decimated from a scan of the same shape, so that vertices are not the paper's own. Where the
paper names no camera, ours is used. `MODEL` stands for a file; `--prior none` is the pure measure.

A verdict is *holds* where all models agree, *partly* where most do or where it depends on what is counted,
else *does not hold*. The paper's figures show single models; what is claimed of them is checked on all.
"""


def verdict(shares, most=0.5):
    """From a list of truth values."""
    share = sum(shares) / max(1, len(shares))
    return HOLDS if share == 1 else PARTLY if share >= most else NOT


def percent(x, digits=0):
    return f"{100 * x:.{digits}f} %"


def each(models, text):
    return "; ".join(f"{name} {text(found)}" for name, found in models.items())


def span(values, form):
    return f"{form(min(values))} to {form(max(values))}"


def belly_row(models, limb="front left leg"):
    rows, clear, blocked = [], [], []
    for name, found in models.items():
        if "belly" not in found:
            continue
        for weight, what in found["belly"].items():
            kssm, saliency = what["kssm"], what["mesh-saliency"]
            rows.append(f"{name}, {weight}: {percent(kssm[limb])} / {percent(saliency[limb])}")
            clear.append(kssm[limb] < 0.01)
            blocked.append(saliency[limb] > kssm[limb])
    outcome = verdict([c and b for c, b in zip(clear, blocked)])
    if all(clear) and outcome == NOT:
        outcome = PARTLY
    return rows, outcome


def belly_seen_row(models):
    pairs = [(f"{name}, {weight}", what["kssm"]["seen"], what["mesh-saliency"]["seen"])
             for name, found in models.items() for weight, what in found.get("belly", {}).items()]
    return ("So more of the belly is seen from KSSM's best view", "the same: share of the belly's vertices seen, "
            "KSSM / saliency", "; ".join(f"{n}: {percent(k)} / {percent(s)}" for n, k, s in pairs),
            verdict([k > s for _, k, s in pairs]))


def topology_row(models, end, better):
    what = {n: f["topology"]["skeleton-visibility"] for n, f in models.items()}
    numbers = "; ".join(f"{n} {percent(t[f'kssm {end}'])} / {percent(t[f'mesh-saliency {end}'])} / "
                        f"{percent(t['random'])}" for n, t in what.items())
    return numbers, verdict([better(t) for t in what.values()])


def rows_of(models):
    """(claim, command, number, verdict) of each claim. \\param models those measured in full"""
    certified = {n: f for n, f in models.items() if f["paper"]["dense"]}
    rows = [("The skeleton that comes out of the contraction has the topology of the shape",
             "`vantage view MODEL --json`: skeleton.cycles, model.genus",
             each(models, lambda f: f"{f['cycles']} cycles at genus {f['genus']}"),
             verdict([f["cycles"] == f["genus"] for f in models.values()])),
            ("Warm colours in the map are where the displacement from the skeleton is large (figure 5)",
             "`vantage map MODEL --method kssm` and `thickness`: Spearman's correlation",
             each(models, lambda f: f"{f['displacement']:.3f}"),
             verdict([f["displacement"] >= 0.9 for f in models.values()])),
            ("KSSM describes the global shape, mesh saliency only local features",
             "the same for `mesh-saliency`: share of a map's variance left when it is averaged over balls of "
             "5 % of the box's diagonal, KSSM / saliency",
             each(models, lambda f: f"{percent(f['locality']['kssm'])} / "
                                    f"{percent(f['locality']['mesh-saliency'])}"),
             verdict([f["locality"]["kssm"] > f["locality"]["mesh-saliency"] for f in models.values()]))]
    limbs, outcome = belly_row(models)
    rows.append(("Dinosaur: the front left leg hides the belly in saliency's best view, and does not in KSSM's "
                 "(figure 7)",
                 "`vantage view MODEL --method kssm --prior none`, and `mesh-saliency`, `--weight vertex` and "
                 "`area`, `--preset paper`; share of the belly turned to the eye that the leg hides, KSSM / "
                 "saliency", "; ".join(limbs), outcome))
    rows.append(belly_seen_row(models))
    numbers, outcome = topology_row(models, "best", lambda t: t["kssm best"] > t["mesh-saliency best"])
    rows.append(("KSSM's best view gives more topological perception than saliency's (figure 7)",
                 "`vantage score MODEL --method skeleton-visibility --directions FILE`: share of the skeleton "
                 "shown at KSSM's best / saliency's best / a random view", numbers, outcome))
    numbers, outcome = topology_row(models, "best", lambda t: t["kssm best"] > t["random"])
    rows.append(("KSSM's best view gives more topological perception than a view by chance", "the same",
                 "see above", outcome))
    numbers, outcome = topology_row(models, "worst", lambda t: t["kssm worst"] < 0.5 * t["random"])
    rows.append(("KSSM's worst view shows nothing of the topology (figure 8): less than half of what a random "
                 "view does", "the same at KSSM's worst / saliency's worst / a random view", numbers, outcome))
    rows.append(("KSSM does as well as saliency when the worst view is wanted: it shows as little of the "
                 "skeleton, to 5 % of it", "the same", "see above; angle between the two worst views: " +
                 each(models, lambda f: f"{f['angle']['worst']:.0f}°"),
                 topology_row(models, "worst",
                              lambda t: t["kssm worst"] <= t["mesh-saliency worst"] + 0.05)[1]))
    entropy = {n: f["topology"]["viewpoint-entropy"] for n, f in models.items()}
    rows.append(("The best view obtains the most information: it is among the tenth of views of largest "
                 "viewpoint entropy", "`vantage score MODEL --method viewpoint-entropy`: share of views below "
                 "KSSM's best", "; ".join(f"{n} {percent(t['kssm best percentile'])}"
                                          for n, t in entropy.items()),
                 verdict([t["kssm best percentile"] >= 0.9 for t in entropy.values()])))
    rows += search_rows(models, certified)
    return rows


def search_rows(models, certified):
    def steps(found):
        return [found["jumps"][level]["largest"] for level in ("2", "3", "4")]
    return [
        ("The KSSM seen changes without jumps as the eye moves: half the way, at most 0.65 of the largest "
         "change", "`vantage score MODEL --sphere 2`, 3, 4: largest change between neighbouring views over the "
         "range, at 16°, 8° and 4°",
         each(models, lambda f: " / ".join(percent(x) for x in steps(f))),
         verdict([steps(f)[1] < 0.65 * steps(f)[0] and steps(f)[2] < 0.65 * steps(f)[1]
                  for f in models.values()])),
        ("The best view lies in the 1-ring of the best of the initial views, corners of a cube: no farther than "
         f"its neighbours, {NEIGHBOURING_CORNERS:.1f}°",
         "`vantage score MODEL --preset paper --directions FILE` and `vantage view MODEL --preset paper "
         "--search global`: angle between the two",
         each(models, lambda f: f"{f['from_initial']:.0f}°"),
         verdict([f["from_initial"] <= NEIGHBOURING_CORNERS for f in models.values()])),
        ("The best view is selected accurately by the rapid search: 99 % of a dense search's score",
         "`vantage view MODEL --preset paper --certify`",
         each(certified, lambda f: percent(f["paper"]["dense"]["best_ratio"], 2)),
         verdict([f["paper"]["dense"]["best_ratio"] >= 0.99 for f in certified.values()])),
        ("So is the worst view: within 1 % of the range", "the same",
         each(certified, lambda f: percent(f["paper"]["dense"]["worst_above"], 2) + " above"),
         verdict([f["paper"]["dense"]["worst_above"] <= 0.01 for f in certified.values()])),
        ("The rapid search is very efficient: less than a tenth of the views of an exhaustive one (642)",
         "`vantage view MODEL --preset paper --json`: search.evaluations",
         each(models, lambda f: f"{f['paper']['evaluations']} views"),
         verdict([f["paper"]["evaluations"] < 642 / 10 for f in models.values()])),
    ]


def table_1(cache):
    paper = {"rocker-arm": 5.3, "cow": 14.8, "venus": 17.6, "horse": 28.2, "dinosaur 56K": 36.7,
             "armadillo": 102.5}
    lines = ["| model | vertices | paper, 2014, s | `--preset paper`, s | of this the search | default, s |",
             "| --- | --- | --- | --- | --- | --- |"]
    for name, seconds in paper.items():
        if name in cache:
            mine = cache[name]["paper"]["seconds"]
            lines.append(f"| {name} | {cache[name]['paper']['vertices']} | {seconds} | {mine['total']:.1f} | "
                         f"{mine['search']:.2f} | {cache[name]['default_seconds']['total']:.1f} |")
    return lines


def belly_table(cache):
    limbs = ("front left leg", "front right leg", "hind left leg", "hind right leg")
    lines = ["| model | run | method | direction | belly seen | " + " | ".join(limbs) + " |",
             "| --- | --- | --- | --- | --- |" + " --- |" * len(limbs)]
    for name, found in cache.items():
        for weight, what in found.get("belly", {}).items():
            for method in ("kssm", "mesh-saliency"):
                m = what[method]
                direction = ", ".join(f"{x:.2f}" for x in m["direction"])
                lines.append(f"| {name} | {weight} | {method} | {direction} | {percent(m['seen'])} | " +
                             " | ".join(percent(m[limb]) for limb in limbs) + " |")
    return lines


def page(cache, files, month, commit, times=False):
    """\\param month such as November 2026"""
    models = {name: cache[name] for name in files if "topology" in cache.get(name, {})}
    lines = [HEAD.format(month=month, commit=commit), "| claim | command | number | verdict |", "| --- | --- | --- | --- |"]
    lines += [f"| {claim} | {command} | {number} | **{outcome}** |"
              for claim, command, number, outcome in rows_of(models)]
    lines += ["", "What the paper says of others is not ours to check: Kim et al. 2010 evaluate mesh saliency "
              "and propose no new map, and Gooch et al. 2001 write on artistic composition. How far KSSM "
              "agrees with what people choose and look at is on the [page of evidence](../evidence.md).", "",
              "## The dinosaur's belly",
              "The animal looks along −y and stands on z. Its parts are the vertices in boxes, given in shares of "
              "the bounding box in `scripts/paper_shapes.py`, so that every tessellation has the same parts. "
              "*Belly seen* is the share of its vertices that the view sees; under each leg is the share of "
              "the belly's vertices turned to the eye that this leg alone hides.", "", *belly_table(cache), "",
              *(["## Times", "The paper's Table 1 (its title speaks of a segmentation) beside this program, "
                 "without pictures; the paper does not name its machine.", "", *table_1(cache), ""]
                if times else ["## Times", "The paper's Table 1 is beside ours on the [page of performance](../performance.md); "
                               "`--times` puts those of this run here, for a machine with nothing else to do.",
                               ""]), "## Models",
              *[f"- {name}: `{file}`" for name, file in files.items() if name in cache]]
    return "\n".join(lines) + "\n"
