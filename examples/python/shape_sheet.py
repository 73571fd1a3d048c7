#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One figure about a model: shape_sheet.py MODEL [FIGURE.png]

Best and worst view, the significance map, the skeleton and what it divides the surface into, the
score from everywhere, and what each level of the contraction adds. Needs matplotlib. The cells
(`# %%`) run one by one in editors that know them.
"""
# %% Read the model once, contract it once
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np

import vantage

MODEL = sys.argv[1] if len(sys.argv) > 1 else str(
    pathlib.Path(__file__).resolve().parents[2] / "models" / "horse.ply")
FIGURE = sys.argv[2] if len(sys.argv) > 2 else "shape_sheet.png"

analysis = vantage.analyse(MODEL)
model = analysis.model
print(f"{model.name}: {len(model.vertices)} vertices, {len(model.faces)} faces, "
      f"closed: {analysis.closed}, genus: {analysis.genus}")

# %% The views, the map, the skeleton: each a record of arrays
SIZE = (480, 360)
views = vantage.best_view(analysis, size=SIZE)
significance = vantage.kssm(analysis, levels=True)
skeleton = vantage.skeleton(analysis)
sphere = vantage.directions(level=3)
scores = vantage.score(analysis, sphere=3)
print(f"best view from {views.best.direction.round(3)} sees "
      f"{100 * views.best.score_fraction:.1f} % of the significance")

# %% The surface by limbs: each vertex takes the colour of the branch that its node is in
branch_of_node = np.zeros(len(skeleton.nodes), int)
for number, branch in enumerate(skeleton.branches):
    branch_of_node[branch] = number  # a junction goes with the last of its branches
palette = (255 * plt.get_cmap("tab20")(np.arange(20))[:, :3]).astype(np.uint8)
limbs = palette[branch_of_node[skeleton.vertex_node] % 20]
limbs[skeleton.vertex_node < 0] = 128

# %% Six pictures from the same renderer as the program's
camera = views.best.camera


def picture(**how):
    """The model from the best view unless `how` says otherwise."""
    return vantage.render(analysis, size=SIZE, background="white", **{"camera": camera, **how})


figure, axes = plt.subplots(3, 3, figsize=(12, 9.4), layout="constrained")
pictures = [
    (f"best view: {100 * views.best.score_fraction:.0f} % of the significance", picture()),
    (f"worst view: {100 * views.worst.score_fraction:.0f} %", picture(camera=views.worst.camera)),
    ("a drawing", picture(style="technical")),
    ("significance (KSSM)", picture(show="kssm")),
    (f"skeleton: {len(skeleton.nodes)} nodes, {skeleton.cycles} cycles", picture(show="skeleton")),
    (f"{len(skeleton.branches)} limbs by vertex_node", picture(colours=limbs)),
]
for axis, (title, image) in zip(axes.flat, pictures):
    axis.imshow(image)
    axis.set_title(title, fontsize=10)
    axis.set_axis_off()

# %% The score from everywhere, as a map of the view sphere with the model's up axis at the top
up = "xyz".index(views.up[-1])
sign = -1.0 if views.up.startswith("-") else 1.0


def on_map(direction):
    """Longitude and latitude, degrees."""
    d = np.atleast_2d(direction)
    return (np.degrees(np.arctan2(d[:, (up + 2) % 3], d[:, (up + 1) % 3])),
            np.degrees(np.arcsin(np.clip(sign * d[:, up], -1, 1))))


axis = axes[2, 0]
shown = axis.scatter(*on_map(sphere.directions), c=scores / views.total, s=14, cmap="viridis")
axis.plot(*on_map(views.best.direction), "r^", label="best")
axis.plot(*on_map(views.worst.direction), "rv", label="worst")
axis.set(title="share of the significance seen, by direction", xlabel="longitude, degrees",
         ylabel="latitude, degrees", xlim=(-190, 190), ylim=(-90, 90))
axis.title.set_fontsize(10)
axis.legend(fontsize=8, loc="lower right")
figure.colorbar(shown, ax=axis)

# %% What the map is made of
axis = axes[2, 1]
axis.hist(significance.of_vertex, bins=40, color="tab:blue")
axis.set_title("significance of the vertices", fontsize=10)
axis.set(xlabel="KSSM", ylabel="vertices")

axis = axes[2, 2]
share = significance.displacement / analysis.diameter
axis.fill_between(range(len(share)), share.min(axis=1), share.max(axis=1), alpha=0.25,
                  label="all vertices")
axis.plot(share.mean(axis=1), "o-", label="mean")
axis.set_title("distance to the skeleton by level", fontsize=10)
axis.set(xlabel="level of the contraction", ylabel="share of the diameter",
         xticks=range(len(share)))
axis.legend(fontsize=8)

figure.suptitle(f"{model.name}: {len(model.vertices)} vertices", fontsize=12)
figure.savefig(FIGURE, dpi=110)
print(f"figure in {FIGURE}")
