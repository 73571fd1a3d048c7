#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the cycles of our skeletons against VTK's Reeb graph of the height (Debian: python3-vtk9).

    bench/peers/reeb_loops.py build/release/apps/vantage/vantage MODEL…

The Reeb graph of a generic function on a closed orientable surface has as many loops as the surface has
handles, whatever the function; so three directions that are no axis must agree with each other too."""
import json
import subprocess
import sys
import tempfile

from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkReebGraph
from vtkmodules.vtkIOPLY import vtkPLYReader

DIRECTIONS = ((0.31, 0.89, 0.33), (0.83, -0.27, 0.49), (-0.41, 0.37, 0.83))


def reeb_loops(surface, direction):
    """Independent loops of the Reeb graph of the height along a direction, over all components."""
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    height = numpy_to_vtk(points @ direction, deep=True)
    height.SetName("height")
    graph = vtkReebGraph()
    if graph.Build(surface, height) != 0:
        return None
    parent = list(range(graph.GetNumberOfVertices()))

    def root(i):
        while parent[i] != i:
            i = parent[i]
        return i
    components = len(parent)
    for e in range(graph.GetNumberOfEdges()):
        a, b = root(graph.GetSourceVertex(e)), root(graph.GetTargetVertex(e))
        parent[a], components = b, components - (a != b)
    return graph.GetNumberOfEdges() - len(parent) + components


def main(program, *models):
    print("| model | genus | our cycles | loops of three Reeb graphs |\n| --- | --- | --- | --- |")
    wrong = 0
    for model in models:
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([program, "skeleton", model, "-o", folder + "/s.json", "--json"],
                                  capture_output=True, text=True, check=True)
            ours = json.loads(done.stdout)
            subprocess.run([program, "map", model, "-o", folder + "/m.ply", "-q"], check=True)
            reader = vtkPLYReader()
            reader.SetFileName(folder + "/m.ply")
            reader.Update()
            loops = [reeb_loops(reader.GetOutput(), direction) for direction in DIRECTIONS]
        wrong += any(count != ours["cycles"] for count in loops)
        print(f"| {model.rsplit('/', 1)[-1]} | {ours['genus']} | {ours['cycles']} "
              f"| {', '.join(map(str, loops))} |", flush=True)
    print(f"\n{len(models)} models, {wrong} on which they differ")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
