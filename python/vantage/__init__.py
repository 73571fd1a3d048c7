# SPDX-License-Identifier: MIT
"""Vantage finds the view from which a 3D model tells most about its shape.

    import vantage
    result = vantage.best_view(V, F)          # (n, 3) floats and (m, 3) integers; or a path
    picture = vantage.render(V, F, camera=result.best.camera)

docs/python.md is the cookbook.
"""

from ._core import __version__
from .errors import (Error, FormatError, InvalidInput, IoError, MissingFileError,
                     SolverError)
from .functions import (Analysis, Model, analyse, best_view, colour_map, defaults, directions, kssm,
                        library_versions, load, measures, options, render, score, skeleton,
                        vertex_map, visible_vertices)
from .results import (BestView, Camera, DenseGap, DirectionSet, KssmMap, Measure, Skeleton, Twin,
                      View)

__all__ = [
    "Analysis", "BestView", "Camera", "DenseGap", "DirectionSet", "Error", "FormatError",
    "InvalidInput", "IoError", "KssmMap", "Measure", "MissingFileError", "Model", "Skeleton", "SolverError", "Twin",
    "View", "__version__", "analyse", "best_view", "colour_map", "defaults", "directions", "kssm",
    "library_versions", "load", "measures", "options", "render", "score", "skeleton", "vertex_map",
    "visible_vertices",
]
