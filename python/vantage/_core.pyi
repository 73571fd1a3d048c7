# SPDX-License-Identifier: MIT
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

__version__: str

class Model:
    """A model as it was read, or as arrays describe it. Never changes."""
    def __init__(
        self,
        V: npt.ArrayLike,
        F: Optional[npt.ArrayLike] = None,
        *,
        name: Optional[str] = None,
        colours: Optional[npt.ArrayLike] = None,
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def format(self) -> str: ...
    @property
    def vertices(self) -> npt.NDArray[np.float64]: ...
    @property
    def faces(self) -> npt.NDArray[np.uint32]: ...
    @property
    def colours(self) -> npt.NDArray[np.uint8]: ...
    @property
    def parts(self) -> Tuple[Tuple[str, int, int], ...]: ...
    @property
    def notes(self) -> Tuple[str, ...]: ...

class Analysis:
    """A model with its contraction, skeleton and significance map. Never changes."""
    @property
    def model(self) -> Model: ...
    @property
    def closed(self) -> bool: ...
    @property
    def components(self) -> int: ...
    @property
    def genus(self) -> Optional[int]: ...
    @property
    def centre(self) -> npt.NDArray[np.float64]: ...
    @property
    def diameter(self) -> float: ...
    @property
    def warnings(self) -> Tuple[str, ...]: ...

def load(path: Any, progress: Any, threads: Any, max_faces: Any) -> Model: ...
def analyse(
    model: Any, F: Any, options: Dict[str, Any], progress: Any, threads: Any
) -> Analysis: ...
def best_view(
    model: Any, F: Any, method: Any, options: Dict[str, Any], progress: Any, threads: Any
) -> Dict[str, Any]: ...
def skeleton(
    model: Any,
    F: Any,
    levels: Any,
    measure: Any,
    options: Dict[str, Any],
    progress: Any,
    threads: Any,
) -> Dict[str, Any]: ...
def kssm(
    model: Any, F: Any, levels: Any, options: Dict[str, Any], progress: Any, threads: Any
) -> Dict[str, Any]: ...
def vertex_map(
    model: Any, F: Any, method: Any, options: Dict[str, Any], progress: Any, threads: Any
) -> npt.NDArray[np.float64]: ...
def visible_vertices(
    model: Any,
    F: Any,
    eyes: Any,
    directions: Any,
    sphere: Any,
    options: Dict[str, Any],
    progress: Any,
    threads: Any,
) -> npt.NDArray[np.bool_]: ...
def score(
    model: Any,
    F: Any,
    directions: Any,
    eyes: Any,
    sphere: Any,
    method: Any,
    view_set: Any,
    options: Dict[str, Any],
    progress: Any,
    threads: Any,
) -> npt.NDArray[np.float64]: ...
def render(
    model: Any,
    F: Any,
    direction: Any,
    camera: Any,
    view: Any,
    show: Any,
    colours: Any,
    options: Dict[str, Any],
    progress: Any,
    threads: Any,
) -> npt.NDArray[np.uint8]: ...
def directions(
    level: Any, base: Any
) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.uint32]]: ...
def colour_map(values: npt.ArrayLike) -> npt.NDArray[np.uint8]: ...
def measures() -> List[Dict[str, Any]]: ...
def defaults(preset: Any) -> Dict[str, Any]: ...
def options() -> List[Mapping[str, Any]]: ...
def library_versions() -> str: ...
