# SPDX-License-Identifier: MIT
"""What functions return: frozen records of numbers and NumPy arrays.

Lengths are in the units of the model, n is its number of vertices, and row i of a per-vertex array
belongs to vertex i of the input, always. Arrays own the memory that the library computed them in.
"""

from __future__ import annotations

import importlib
import math
import struct
import zlib
from dataclasses import dataclass, fields
from typing import Any, Callable, Dict, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

from .errors import InvalidInput

Floats = npt.NDArray[np.float64]
Indices = npt.NDArray[np.uint32]
Integers = npt.NDArray[np.int64]
Bytes = npt.NDArray[np.uint8]
Flags = npt.NDArray[np.bool_]


def _brief(value: object) -> str:
    """Large arrays by their shape, long texts by their beginning."""
    if isinstance(value, np.ndarray) and value.size > 4:
        return f"<{value.dtype} {value.shape}>"
    if isinstance(value, tuple) and len(value) > 3:
        return f"<{len(value)} items>"
    text = repr(value)
    return text if len(text) <= 200 else text[:60] + "…"


class _Record:
    """Prints arrays by their shapes."""

    def __repr__(self) -> str:
        parts = [f"{f.name}={_brief(getattr(self, f.name))}"
                 for f in fields(self)]  # type: ignore[arg-type]
        return f"{type(self).__name__}({', '.join(parts)})"


def _inverse_of_rigid(pose: Floats) -> Floats:
    """Inverse of a rotation and a shift."""
    inverse = np.eye(4)
    inverse[:3, :3] = pose[:3, :3].T
    inverse[:3, 3] = -pose[:3, :3].T @ pose[:3, 3]
    return inverse


def _unit(vector: Floats, otherwise: str, least: float = 0.0) -> Floats:
    """The vector at length 1. Raises InvalidInput, which says `otherwise`, if it is no
    longer than `least`."""
    length = np.linalg.norm(vector)
    if not length > least:
        raise InvalidInput(otherwise)
    return vector / length


def _png_of(picture: Bytes) -> bytes:
    """A PNG file of (height, width, 4) bytes, sRGB."""
    def chunk(kind: bytes, data: bytes) -> bytes:
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))

    height, width = picture.shape[:2]
    rows = b"".join(b"\0" + row.tobytes() for row in picture)  # 0: no filter
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 6))
            + chunk(b"IEND", b""))


@dataclass(frozen=True, eq=False, repr=False)
class Camera(_Record):
    """A camera that takes a picture; right-handed, looks along −z of its own frame."""

    projection: str
    """"perspective" or "orthographic"."""
    eye: Floats
    """(3,) position."""
    target: Floats
    """(3,) the point at the centre of the picture."""
    up: Floats
    """(3,) unit, orthogonal to target − eye; of another, the part that is, is meant."""
    fov_y_deg: float = 30.0
    """Perspective: full vertical field of view, degrees, in (0, 180)."""
    height: float = 2.0
    """Orthographic: height of the picture in model units, above 0."""

    def __post_init__(self) -> None:
        for name in ("eye", "target", "up"):
            object.__setattr__(self, name, np.asarray(getattr(self, name), dtype=float))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Camera):
            return NotImplemented
        return self._numbers() == other._numbers()

    def __hash__(self) -> int:
        return hash(self._numbers())

    def _numbers(self) -> Tuple[Any, ...]:
        return (self.projection, self.camera_position, self.fov_y_deg, self.height)

    def world_from_camera(self) -> Floats:
        """(4, 4) camera to world, columns x right, y up, z back, eye: OpenGL, Blender, NeRF."""
        back = _unit(self.eye - self.target, "camera.target must differ from camera.eye")
        up = _unit(self.up, "camera.up must not be zero")
        right = _unit(np.cross(up, back), "camera.up must not point along the line of sight", 1e-12)
        pose = np.eye(4)
        pose[:3, 0] = right
        pose[:3, 1] = np.cross(back, right)
        pose[:3, 2] = back
        pose[:3, 3] = self.eye
        return pose

    def intrinsics(self, width: int, height: int) -> Floats:
        """(3, 3) pinhole matrix in pixels, origin top left, x right, y down (OpenCV's K); needs a
        world_from_camera() whose y and z columns are turned round. ValueError if orthographic."""
        if self.projection != "perspective":
            raise ValueError("an orthographic camera has no pinhole matrix")
        focal = 0.5 * height / math.tan(math.radians(self.fov_y_deg) / 2.0)
        return np.array([[focal, 0.0, 0.5 * width], [0.0, focal, 0.5 * height], [0.0, 0.0, 1.0]])

    def extrinsics(self) -> Floats:
        """(4, 4) world to camera, x right, y down, z forward: Open3D, OpenCV (R | t)."""
        pose = self.world_from_camera()
        pose[:3, 1:3] *= -1.0
        return _inverse_of_rigid(pose)

    @property
    def camera_transform(self) -> Floats:
        """(4, 4) as trimesh's `scene.camera_transform` takes it; fov() goes with it."""
        return self.world_from_camera()

    def fov(self, width: int, height: int) -> Tuple[float, float]:
        """Horizontal and vertical field of view in degrees: trimesh's `scene.camera.fov`."""
        if self.projection != "perspective":
            raise ValueError("an orthographic camera has no field of view")
        half = math.tan(math.radians(self.fov_y_deg) / 2.0) * width / height
        return math.degrees(2.0 * math.atan(half)), self.fov_y_deg

    @property
    def camera_position(self) -> Tuple[Tuple[float, ...], Tuple[float, ...], Tuple[float, ...]]:
        """Eye, target and up, as PyVista's `plotter.camera_position` takes them."""
        return tuple(self.eye.tolist()), tuple(self.target.tolist()), tuple(self.up.tolist())

    def set_vtk_camera(self, camera: Any) -> None:
        """Sets a vtkCamera, such as PyVista's `plotter.camera`; near and far are the renderer's:
        ResetCameraClippingRange()."""
        camera.SetPosition(*self.eye.tolist())
        camera.SetFocalPoint(*self.target.tolist())
        camera.SetViewUp(*self.up.tolist())
        camera.SetUseHorizontalViewAngle(False)
        camera.SetParallelProjection(self.projection != "perspective")
        if self.projection == "perspective":
            camera.SetViewAngle(self.fov_y_deg)
        else:
            camera.SetParallelScale(0.5 * self.height)

    def open3d_parameters(self, width: int, height: int) -> Any:
        """An open3d.camera.PinholeCameraParameters for a picture of this size, with the centre at
        (width − 1) / 2, (height − 1) / 2, where Open3D's own window has it."""
        open3d = importlib.import_module("open3d")  # optional: imported by those who have it
        K = self.intrinsics(width, height)
        parameters = open3d.camera.PinholeCameraParameters()
        parameters.intrinsic = open3d.camera.PinholeCameraIntrinsic(
            width, height, K[0, 0], K[1, 1], K[0, 2] - 0.5, K[1, 2] - 0.5)
        parameters.extrinsic = self.extrinsics()
        return parameters


@dataclass(frozen=True, eq=False, repr=False)
class View(_Record):
    """One view and what it sees."""

    direction: Floats
    """(3,) unit, from the model's centre to the eye."""
    eye: Floats
    """(3,) of the scoring camera."""
    up: Floats
    """(3,) unit, upright in the picture."""
    score: float
    """Significance seen; what `method` says for another measure."""
    score_fraction: float
    """score / total, in [0, 1]; NaN for measures without a total."""
    objective: float
    """What the search compared: the score, or how likely people take this view."""
    visible_area_fraction: float
    """Of the surface, in [0, 1]."""
    camera: Camera
    """From the same direction, in perspective the same eye, framed tightly: pass it to render()."""
    size: Tuple[int, int]
    """Width and height that it is framed for, pixels."""
    gain: Optional[float] = None
    """In a set: significance that no view before sees."""
    coverage: Optional[float] = None
    """In a set: share of what can be seen at all that is seen by now, in [0, 1]."""


@dataclass(frozen=True, eq=False, repr=False)
class Twin(_Record):
    """A view that a mirror plane makes as good as the best."""

    direction: Floats
    """(3,) unit."""
    score: float
    objective: float


@dataclass(frozen=True, eq=False, repr=False)
class DenseGap(_Record):
    """How far a search stayed behind the dense one (certify=True)."""

    best_ratio: float
    """Objective of the best view over the dense search's; 1 or more if nothing is better."""
    worst_above: float
    """Worst score above the dense search's, as a share of the range of scores."""
    evaluations: int
    """Directions that the dense search scored."""


@dataclass(frozen=True, eq=False, repr=False)
class BestView(_Record):
    """Result of best_view()."""

    best: View
    """Of the largest objective."""
    worst: View
    """Of the least score."""
    views: Tuple[View, ...]
    """The set, in order of choice, if views= or coverage= asked for one; else empty."""
    tour: Optional[Integers]
    """Order of `views` on the shortest closed round; None without a set."""
    tour_length_deg: Optional[float]
    """Length of that round on the view sphere, degrees."""
    total: float
    """The score if everything were visible; NaN for measures without one."""
    up: str
    """The up axis used: "x", "y", "z", "-x", "-y" or "-z"."""
    up_source: str
    """"given", "format", or "shape": what the shape says."""
    up_confidence: float
    """Probability that `up` is right, 0 to 1."""
    front: str
    """The axis that points from the model to a viewer in front."""
    front_source: str
    """As `up_source`."""
    front_confidence: float
    """Probability that `front` is right, 0 to 1."""
    centre: Floats
    """(3,) centre of the enclosing sphere, which directions start from."""
    distance: float
    """From there to the eye of the scoring camera."""
    evaluations: int
    """Directions scored."""
    estimates: int
    """Directions estimated to find out which to score."""
    twins: Tuple[Twin, ...]
    """Mirror images of the best view."""
    dense_gap: Optional[DenseGap]
    """With certify=True."""
    warnings: Tuple[str, ...]
    """Every repair and doubt, one sentence each."""
    doubts: Tuple[str, ...]
    """Of these, why the answer should not be trusted; empty almost always."""
    json: str
    """The text of view.json, as `vantage view --no-images --size 800x600` writes it."""

    def _show_by(self, take: Callable[[Camera], Bytes]) -> None:
        """How a notebook gets the picture; not part of the record, and not pickled."""
        object.__setattr__(self, "_take", take)

    def __getstate__(self) -> Dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_take"}

    def _repr_png_(self) -> Optional[bytes]:
        """The best view, for notebooks: taken anew each time, of the model as it is now. None once
        the result has been through pickle, which leaves the model behind."""
        take: Optional[Callable[[Camera], Bytes]] = self.__dict__.get("_take")
        return None if take is None else _png_of(take(self.best.camera))


@dataclass(frozen=True, eq=False, repr=False)
class Skeleton(_Record):
    """Result of skeleton(): k nodes, e edges."""

    nodes: Floats
    """(k, 3) points."""
    edges: Indices
    """(e, 2) node indices, the lower first, rows sorted."""
    radius: Floats
    """(k,) mean distance of a node to the vertices it stands for: of the surface that was contracted,
    which has more of them than the input where that is coarse."""
    vertex_node: Integers
    """(n,) node of each vertex; −1 for vertices without faces."""
    branches: Tuple[Indices, ...]
    """Runs of nodes from end or junction to the next, or round a loop; each edge in exactly one."""
    components: int
    cycles: int
    """Independent loops: the genus, on a closed surface."""
    length: float
    """Of all edges together."""
    shrinkage: Floats
    """(K + 1,) mean ratio of face areas to those of the input, at each level of the contraction."""
    levels: Optional[Floats]
    """(K + 1, n, 3) the vertices at each level, the input first, with levels=True."""
    quality: Optional[Mapping[str, float]]
    """Measures against the surface, with measure=True; docs/skeleton.md defines them."""
    warnings: Tuple[str, ...]


@dataclass(frozen=True, eq=False, repr=False)
class KssmMap(_Record):
    """Result of kssm(): K + 1 levels of contraction."""

    of_vertex: Floats
    """(n,) significance, 0 or more; 0 for vertices without faces."""
    thickness: Floats
    """(n,) mean distance of each vertex to the two curves that the map is measured to."""
    level_factor: Floats
    """(K + 1,) weight of each level in the sum, in [0, 1]; 0 where a level is flat."""
    displacement: Optional[Floats]
    """(K + 1, n) the same at each level, with levels=True."""
    warnings: Tuple[str, ...]


@dataclass(frozen=True, eq=False, repr=False)
class DirectionSet(_Record):
    """Result of directions(): unit vectors joined by triangles."""

    directions: Floats
    """(k, 3) unit vectors; those of coarser levels come first."""
    triangles: Indices
    """(t, 3) indices, counter-clockwise from outside."""


@dataclass(frozen=True)
class Measure:
    """A measure of a view, as `method` names it."""

    name: str
    alias: Optional[str]
    meaning: str
    source: str
    better: str
    """"more" or "less"."""
    cost: str
    """The dearest thing it needs."""


def view_of(record: Dict[str, Any]) -> View:
    """A View of what the compiled part returns."""
    parts: Dict[str, Any] = {**record, "camera": Camera(**record["camera"])}
    return View(**parts)


def best_view_of(record: Dict[str, Any]) -> BestView:
    """A BestView of what the compiled part returns."""
    gap = record["dense_gap"]
    parts: Dict[str, Any] = {**record,
                             "best": view_of(record["best"]),
                             "worst": view_of(record["worst"]),
                             "views": tuple(view_of(v) for v in record["views"]),
                             "twins": tuple(Twin(*t) for t in record["twins"]),
                             "dense_gap": DenseGap(*gap) if gap else None}
    return BestView(**parts)
