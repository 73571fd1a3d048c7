# SPDX-License-Identifier: MIT
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple

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
        name: str = "arrays",
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

def load(path: Any, progress: Any, threads: int, max_faces: int) -> Model: ...
def analyse(
    model: Any, F: Any, options: Dict[str, Any], progress: Any, threads: int
) -> Analysis: ...
def best_view(
    model: Any, F: Any, method: str, options: Dict[str, Any], progress: Any, threads: int
) -> Dict[str, Any]: ...
def skeleton(
    model: Any,
    F: Any,
    levels: bool,
    measure: bool,
    options: Dict[str, Any],
    progress: Any,
    threads: int,
) -> Dict[str, Any]: ...
def kssm(
    model: Any, F: Any, levels: bool, options: Dict[str, Any], progress: Any, threads: int
) -> Dict[str, Any]: ...
def vertex_map(
    model: Any, F: Any, method: str, options: Dict[str, Any], progress: Any, threads: int
) -> npt.NDArray[np.float64]: ...
def visible_vertices(
    model: Any,
    F: Any,
    eyes: Any,
    directions: Any,
    sphere: Any,
    options: Dict[str, Any],
    progress: Any,
    threads: int,
) -> npt.NDArray[np.bool_]: ...
def score(
    model: Any,
    F: Any,
    directions: Any,
    eyes: Any,
    sphere: Any,
    method: Sequence[str],
    view_set: int,
    options: Dict[str, Any],
    progress: Any,
    threads: int,
) -> npt.NDArray[np.float64]: ...
def render(
    model: Any,
    F: Any,
    direction: Any,
    camera: Any,
    view: Any,
    show: str,
    colours: Any,
    options: Dict[str, Any],
    progress: Any,
    threads: int,
) -> npt.NDArray[np.uint8]: ...
def directions(
    level: int, base: str
) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.uint32]]: ...
def colour_map(values: npt.ArrayLike) -> npt.NDArray[np.uint8]: ...
def measures() -> List[Dict[str, Any]]: ...
def defaults(preset: str) -> Dict[str, Any]: ...
def options() -> List[Mapping[str, Any]]: ...
def library_versions() -> str: ...
