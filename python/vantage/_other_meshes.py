# SPDX-License-Identifier: MIT
"""Takes meshes and point clouds of other libraries: what has the members of one is taken for one.

None of these libraries is imported unless the object given is one of its own.
"""

from __future__ import annotations

import importlib
from typing import Any, Tuple

import numpy as np

from . import _core


def subject_of(model: Any, F: Any) -> Tuple[Any, Any]:
    """What the compiled part reads, for what a user may pass: paths, models and arrays stay as they
    are; meshes of other libraries become arrays."""
    if (isinstance(model, (str, bytes, _core.Model, _core.Analysis, np.ndarray, list))
            or hasattr(model, "__fspath__")):
        return model, F
    pair = _arrays_of(model)
    if pair is None:
        return model, F
    if F is not None:
        raise TypeError("F goes with an array of vertices only")
    return pair


def _arrays_of(model: Any) -> "Tuple[Any, Any] | None":
    """Vertices, and faces or None for points alone; None if it is no mesh that is known here."""
    if isinstance(model, tuple):
        # (V, F); a tuple of two points has rows of one dimension
        return (model[0], model[1]) if len(model) == 2 and np.ndim(model[0]) == 2 else None
    if hasattr(model, "GetClassName"):
        return _vtk_arrays(model)
    if hasattr(model, "to_legacy"):  # Open3D's tensor geometry
        return _arrays_of(model.to_legacy())
    if hasattr(model, "vertices"):
        for faces in ("faces", "triangles"):  # trimesh; Open3D
            if hasattr(model, faces):
                return np.asarray(model.vertices), _or_none(getattr(model, faces))
        return np.asarray(model.vertices), None  # trimesh's PointCloud
    if hasattr(model, "to_geometry"):  # trimesh's Scene, placed as in the scene
        return _arrays_of(model.to_geometry())
    if hasattr(model, "dump") and hasattr(model, "geometry"):  # the same before trimesh 4.6
        return _arrays_of(model.dump(concatenate=True))
    if hasattr(model, "points") and hasattr(model, "cells_dict"):  # meshio
        return np.asarray(model.points), _or_none(_triangles_of_cells(model.cells))
    if hasattr(model, "points"):  # Open3D's PointCloud
        return np.asarray(model.points), None
    return None


def _triangles_of_cells(cells: Any) -> Any:
    """Faces of meshio's cells; quads and polygons are cut as fans. Of faces with nodes on their sides, "triangle6" or
    "quad8", the corners come first and count. Lines and vertices are none, nor are solids."""
    fans = [np.empty((0, 3), np.int64)]
    for block in cells:
        kind = block.type.rstrip("0123456789")
        if kind in ("triangle", "quad", "polygon"):
            faces = np.asarray(block.data)
            corners = {"triangle": 3, "quad": 4}.get(kind, faces.shape[1])
            fans += [faces[:, [0, k, k + 1]] for k in range(1, corners - 1)]
    return np.concatenate(fans)


def _or_none(faces: Any) -> Any:
    """A mesh without faces is a point cloud."""
    array = np.asarray(faces)
    return array if len(array) else None


def _vtk_arrays(data: Any) -> Tuple[Any, Any]:
    """Of a vtkPolyData, PyVista's included. Polygons and strips become triangles; points keep their
    order."""
    if not data.IsA("vtkPolyData"):
        raise TypeError(f"{data.GetClassName()} is no surface: pass a vtkPolyData, such as "
                        "vtkGeometryFilter or PyVista's extract_surface() makes")
    vtk_to_numpy = importlib.import_module("vtkmodules.util.numpy_support").vtk_to_numpy
    if data.GetNumberOfPoints() == 0:
        return np.zeros((0, 3)), None
    points = vtk_to_numpy(data.GetPoints().GetData())
    polygons = data.GetPolys()
    if data.GetNumberOfStrips() > 0 or polygons.GetNumberOfConnectivityIds() != (
            3 * polygons.GetNumberOfCells()):
        split = importlib.import_module("vtkmodules.vtkFiltersCore").vtkTriangleFilter()
        split.SetInputData(data)
        split.PassVertsOff()
        split.PassLinesOff()
        split.Update()
        polygons = split.GetOutput().GetPolys()
    if polygons.GetNumberOfCells() == 0:
        return points, None
    return points, vtk_to_numpy(polygons.GetConnectivityArray()).reshape(-1, 3)
