# SPDX-License-Identifier: MIT
"""The functions of the package. Each works without the interpreter's lock and ends on Ctrl-C."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._options import takes
from ._other_meshes import subject_of
from .results import (BestView, Bytes, DirectionSet, Flags, Floats, KssmMap, Measure, Skeleton,
                      best_view_of)

Model = _core.Model
Analysis = _core.Analysis
_NOTEBOOK_SIZE = (480, 360)
_OF_FRAMES = ("up", "front")  # what is seen, and a number a vertex, do not hang on them


def load(path: Any, *, progress: Any = None, threads: Optional[int] = 0,
         max_faces: Optional[int] = 0) -> Model:
    """Reads a model: OBJ, OFF, PLY, STL, glTF, GLB, 3MF, AMF, or a point cloud XYZ, PTS, PWN, PCD.

    path: str, bytes or os.PathLike. max_faces: a model of more faces, or points, is refused; 0:
    what fits into memory.
    Returns a Model: name, format, vertices (n, 3) float64, faces (m, 3) uint32, colours (n, 3) or
    (0, 3) uint8, parts (name, first face, faces) and notes. Its arrays are read-only views.
    Raises IoError, if there is no such file MissingFileError, a FileNotFoundError; FormatError.
    """
    return _core.load(path, progress, threads, max_faces)


@takes("method", "map")
def analyse(model: Any, F: Any = None, *, progress: Any = None, threads: Optional[int] = 0,
            **options: Any) -> Analysis:
    """Contracts a model, finds its skeleton and its significance map, once for many questions.

    model: a path, (n, 3) vertices, a Model. F: (m, 3) integers with vertices; None, or of no rows: a
    point cloud. progress: function of (stage, fraction in [0, 1]). threads: at most this many; 0: all cores.
    Returns an Analysis, which every other function takes as its model; the options below then stay
    as they were given here. It has model, closed, components, genus, centre, diameter, warnings.
    Raises InvalidInput, IoError, FormatError, TypeError.
    """
    model, F = subject_of(model, F)
    return _core.analyse(model, F, options, progress, threads)


@takes("method", "map", "camera", "search", "saliency", "set", "size")
def best_view(model: Any, F: Any = None, *, method: Optional[str] = "kssm", progress: Any = None,
              threads: Optional[int] = 0, **options: Any) -> BestView:
    """Finds the view that tells most about a shape, and the one that tells least.

    model: a path, (n, 3) vertices, a Model, an Analysis; a mesh or point cloud of trimesh, Open3D,
    PyVista or VTK; a tuple (V, F). F: (m, 3) integers with vertices; None, or of no rows, which is
    noted: a point cloud.
    method: a measure of a view, see measures().
    progress: function of (stage, fraction in [0, 1]). threads: at most this many; 0: all cores.
    Returns a BestView; the same for any number of threads.
    Raises InvalidInput, IoError, FormatError, TypeError.
    """
    model, F = subject_of(model, F)
    result = best_view_of(_core.best_view(model, F, method, options, progress, threads))
    result._show_by(lambda camera: render(model, F, camera=camera, size=_NOTEBOOK_SIZE))
    return result


@takes("method")
def skeleton(model: Any, F: Any = None, *, levels: Optional[bool] = False,
             measure: Optional[bool] = False, progress: Any = None, threads: Optional[int] = 0,
             **options: Any) -> Skeleton:
    """Contracts a surface, or a point cloud, to its curve skeleton.

    model: a path, (n, 3) vertices, a Model, an Analysis. F: (m, 3) integers with vertices; None: a
    point cloud. levels: also the surface at each level of the contraction. measure: also how good
    the skeleton is. progress: function of (stage, fraction in [0, 1]). threads: at most this many.
    Returns a Skeleton. Raises InvalidInput, IoError, FormatError, TypeError.
    """
    model, F = subject_of(model, F)
    return Skeleton(**_core.skeleton(model, F, levels, measure, options, progress, threads))


@takes("method", "map")
def kssm(model: Any, F: Any = None, *, levels: Optional[bool] = False, progress: Any = None,
         threads: Optional[int] = 0, **options: Any) -> KssmMap:
    """The significance of each vertex: the Kinematics Significance based Skeleton Map.

    model: a path, (n, 3) vertices, a Model, an Analysis. F: (m, 3) integers with vertices; None: a
    point cloud. levels: also the distance to the skeleton at each level of the contraction.
    progress: function of (stage, fraction in [0, 1]). threads: at most this many; 0: all cores.
    Returns a KssmMap. Raises InvalidInput, IoError, FormatError, TypeError.
    """
    model, F = subject_of(model, F)
    return KssmMap(**_core.kssm(model, F, levels, options, progress, threads))


@takes("method", "map", "camera", "saliency", but=_OF_FRAMES)
def vertex_map(model: Any, F: Any = None, *, method: Optional[str] = "kssm", progress: Any = None,
               threads: Optional[int] = 0, **options: Any) -> Floats:
    """One number a vertex: (n,) float64.

    method: "kssm", "thickness" (mean distance to the curves of the map, in the model's units), "mesh-saliency"
    or "pmi-saliency". The rest as for kssm(). Raises InvalidInput, IoError, FormatError, TypeError.
    """
    model, F = subject_of(model, F)
    return _core.vertex_map(model, F, method, options, progress, threads)


@takes("camera", but=_OF_FRAMES)
def visible_vertices(model: Any, F: Any = None, *, eyes: Any = None, directions: Any = None,
                     sphere: Any = None, progress: Any = None, threads: Optional[int] = 0,
                     **options: Any) -> Flags:
    """Which vertices are seen: by an unblocked segment to the eye and a face turned to it.

    model: a path, (n, 3) vertices, a Model, an Analysis. F: (m, 3) integers with vertices.
    One of eyes: (k, 3) positions in model units, outside or inside the model; directions: (k, 3)
    from the centre to the scoring camera, of any length but zero; sphere: all directions of the
    icosahedron split this many times, 0 to 8. progress and threads as everywhere.
    Returns (k, n) bool, or (n,) for a single (3,) eye or direction.
    Raises InvalidInput, IoError, FormatError, TypeError.
    """
    model, F = subject_of(model, F)
    return _core.visible_vertices(model, F, eyes, _points_of(directions), sphere, options, progress, threads)


def _points_of(directions: Any) -> Any:
    """A DirectionSet's directions; anything else as it is."""
    return directions.directions if isinstance(directions, DirectionSet) else directions


def _is_single(eyes: Any, directions: Any) -> bool:
    given = directions if directions is not None else eyes
    return given is not None and np.ndim(given) == 1


@takes("method", "map", "camera", "saliency", but=_OF_FRAMES)
def score(model: Any, F: Any = None, *, directions: Any = None, eyes: Any = None,
          sphere: Any = None, method: "Union[str, Sequence[str], None]" = "kssm",
          view_set: Optional[int] = 3, progress: Any = None, threads: Optional[int] = 0, **options: Any) -> Any:
    """Scores given views.

    model: a path, (n, 3) vertices, a Model, an Analysis. F: (m, 3) integers with vertices.
    One of directions: (k, 3) from the centre to the scoring camera, of any length but zero; eyes:
    (k, 3) positions in model units; sphere: all directions of the icosahedron split this many
    times, 0 to 8, as directions() gives them. method: one measure or several, see measures().
    view_set: the same split, 0 to 6, for measures that are defined over a set of views.
    Returns float64: (k,) for one method, (methods, k) for a list of them, without the k for a
    single (3,) direction or eye. Raises InvalidInput, IoError, FormatError, TypeError.
    """
    model, F = subject_of(model, F)
    directions = _points_of(directions)
    table = _core.score(model, F, directions, eyes, sphere, method, view_set, options, progress,
                        threads)
    if _is_single(eyes, directions):
        table = table[:, 0]
    return table[0] if isinstance(method, str) else table


@takes("method", "map", "camera", "search", "size", "look")
def render(model: Any, F: Any = None, *, direction: Any = None, camera: Any = None,
           view: Any = None, show: Optional[str] = "plain", colours: Any = None, progress: Any = None,
           threads: Optional[int] = 0, **options: Any) -> Bytes:
    """Takes a picture: (height, width, 4) uint8, sRGB with straight alpha, origin top left.

    model: a path, (n, 3) vertices, a Model, an Analysis. F: (m, 3) integers with vertices.
    One of direction: (3,) from the centre to the eye; camera: a Camera, such as best.camera; view:
    "best" or "worst", which is searched for; none of them: the best view. show: "plain", "kssm" or
    "skeleton". colours: (n, 3) sRGB of the vertices, uint8 or floats from 0 to 1, for a plain picture;
    see colour_map().
    progress: function of (stage, fraction in [0, 1]). threads: at most this many; 0: all cores.
    Raises InvalidInput, IoError, FormatError, TypeError.
    """
    model, F = subject_of(model, F)
    return _core.render(model, F, direction, camera, view, show, colours, options, progress,
                        threads)


def directions(level: int = 3, base: str = "icosahedron") -> DirectionSet:
    """Directions spread over the sphere: "icosahedron" or "cube", its faces split in four `level`
    times, 0 to 8. Raises InvalidInput, TypeError."""
    return DirectionSet(*_core.directions(level, base))


def colour_map(values: Any) -> Bytes:
    """(n, 3) uint8 colours of (n,) numbers, from cool (the least) to warm (the largest); NaN is
    grey. Raises InvalidInput, TypeError."""
    return _core.colour_map(values)


def measures() -> Tuple[Measure, ...]:
    """All measures of a view that `method` may name."""
    return tuple(Measure(**row) for row in _core.measures())


def defaults(preset: Optional[str] = "default") -> Dict[str, Any]:
    """What every option is when it is not given, by preset: "default" or "paper"."""
    return _core.defaults(preset)


def options() -> List[Mapping[str, Any]]:
    """The table of all options: name, flag (of the program), group, type, help, choices, low, high,
    default, paper."""
    return _core.options()


def library_versions() -> str:
    """One line with the versions of the libraries that shape the results."""
    return _core.library_versions()
