#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes vantage/functions.pyi: the functions with every option of the table as a typed keyword.

    PYTHONPATH=build/release/python scripts/write_python_stubs.py > python/vantage/functions.pyi
"""
import inspect

from vantage import _core, functions

HEAD = '''# SPDX-License-Identifier: MIT
# Written by scripts/write_python_stubs.py from the table of options; do not edit.
import os
from typing import (
    Any,
    Callable,
    Dict,
    List,
    Literal,
    Mapping,
    Optional,
    Protocol,
    Sequence,
    Tuple,
    Union,
)

import numpy.typing as npt

from . import _core
from .results import (
    BestView,
    Bytes,
    Camera,
    DirectionSet,
    Flags,
    Floats,
    KssmMap,
    Measure,
    Skeleton,
)

Model = _core.Model
Analysis = _core.Analysis
_Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]

class _HasVertices(Protocol):  # trimesh, Open3D's TriangleMesh
    @property
    def vertices(self) -> Any: ...

class _HasPoints(Protocol):  # Open3D's PointCloud, PyVista, meshio
    @property
    def points(self) -> Any: ...

class _HasPolygons(Protocol):  # vtkPolyData
    def GetPoints(self) -> Any: ...
    def GetPolys(self) -> Any: ...

_Subject = Union[
    _Path,
    _core.Model,
    _core.Analysis,
    npt.ArrayLike,
    Tuple[npt.ArrayLike, npt.ArrayLike],
    _HasVertices,
    _HasPoints,
    _HasPolygons,
]
_Progress = Optional[Callable[[str, float], object]]

def load(
    path: _Path, *, progress: _Progress = None, threads: Optional[int] = 0, max_faces: Optional[int] = 0
) -> _core.Model: ...
'''
TAIL = '''def directions(level: int = 3, base: str = "icosahedron") -> DirectionSet: ...
def colour_map(values: npt.ArrayLike) -> Bytes: ...
def measures() -> Tuple[Measure, ...]: ...
def defaults(preset: Optional[str] = "default") -> Dict[str, Any]: ...
def options() -> List[Mapping[str, Any]]: ...
def library_versions() -> str: ...
'''
POINTS = "Optional[npt.ArrayLike] = None"
FUNCTIONS = [  # name, own keywords, groups of options, result
    ("analyse", [], ["method", "map"], "_core.Analysis"),
    ("best_view", ['method: Optional[str] = "kssm"'],
     ["method", "map", "camera", "search", "saliency", "set", "size"], "BestView"),
    ("skeleton", ["levels: Optional[bool] = False", "measure: Optional[bool] = False"], ["method"], "Skeleton"),
    ("kssm", ["levels: Optional[bool] = False"], ["method", "map"], "KssmMap"),
    ("vertex_map", ['method: Optional[str] = "kssm"'],
     ["method", "map", "camera", "saliency"],
     "Floats"),
    ("visible_vertices", [f"eyes: {POINTS}", f"directions: {POINTS}", "sphere: Optional[int] = None"],
     ["camera"], "Flags"),
    ("score", [f"directions: {POINTS}", f"eyes: {POINTS}", "sphere: Optional[int] = None",
               'method: Union[str, Sequence[str], None] = "kssm"', "view_set: Optional[int] = 3"],
     ["method", "map", "camera", "saliency"], "Any"),
    ("render", [f"direction: {POINTS}", "camera: Optional[Camera] = None",
                'view: Optional[Literal["best", "worst"]] = None',
                'show: Optional[Literal["plain", "kssm", "skeleton"]] = "plain"', f"colours: {POINTS}"],
     ["method", "map", "camera", "search", "size", "look"], "Bytes"),
]


def annotation(row):
    """The option's type, in the words of Python 3.9."""
    text = row["type"].replace("tuple[", "Tuple[").replace("str | os.PathLike[str]", "_Path")
    kinds = text.split(" | ")
    return f"Optional[Union[{', '.join(kinds)}]]" if len(kinds) > 1 else f"Optional[{text}]"


def stub(name, own, groups, result):
    """One function, a keyword a line."""
    lines = [f"def {name}(", "    model: _Subject,", "    F: Optional[npt.ArrayLike] = None,", "    *,"]
    lines += [f"    {keyword}," for keyword in own]
    lines += ["    progress: _Progress = None,", "    threads: Optional[int] = 0,"]
    takes = inspect.signature(getattr(functions, name)).parameters
    lines += [f"    {row['name']}: {annotation(row)} = None,"
              for row in _core.options() if row["group"] in groups and row["name"] in takes]
    return "\n".join([*lines, f") -> {result}: ..."]) + "\n"


def stubs():
    """The whole file."""
    return HEAD + "".join(stub(*function) for function in FUNCTIONS) + TAIL


if __name__ == "__main__":
    print(stubs(), end="")
