# SPDX-License-Identifier: MIT
"""Meshes of other libraries go in, and cameras come out as each of them wants them. Open3D and VTK are the real ones;
trimesh is no package of Debian 12, so an object with its members stands for it."""

import functools
import importlib.util
import pathlib
import pickle
import shutil
import struct
import subprocess
import sys
import types
import zlib

import numpy as np
import pytest

from conftest import torus
from silhouettes import vtk_mesh
import vantage


def without(*modules):
    missing = [name for name in modules if importlib.util.find_spec(name) is None]
    return pytest.mark.skipif(bool(missing), reason=f"NOTHING WAS TESTED: {', '.join(missing)} is not installed")


needs_vtk = without("vtkmodules")
needs_open3d = without("open3d")
V, F = torus(bump=0.1)
QUICK = {"contraction": "exact", "search": "rapid"}  # it is of arrays that arrive, not of what is found in them


@functools.cache
def view_of_arrays(kind):
    return vantage.best_view(*{"surface": (V, F), "points": (V,)}[kind], **QUICK).json


def same_view(subject, kind="surface"):
    assert vantage.best_view(subject, **QUICK).json == view_of_arrays(kind)


@needs_open3d
def test_open3d_meshes_are_taken():
    import open3d
    mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(V), open3d.utility.Vector3iVector(F))
    same_view(mesh)
    tensors = open3d.t.geometry.TriangleMesh(open3d.core.Tensor(V), open3d.core.Tensor(F))
    same_view(tensors)


@needs_open3d
def test_open3d_points_are_a_point_cloud():
    import open3d
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(V))
    same_view(cloud, "points")


@needs_vtk
def test_vtk_triangles_are_taken_as_they_are():
    same_view(vtk_mesh(V, F))


@needs_vtk
def test_vtk_polygons_become_triangles_of_the_same_points():
    box = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 2.0) for z in (0.0, 3.0)])
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    seen = vantage.visible_vertices(vtk_mesh(box, quads), directions=[1.0, 1.0, 1.0])
    assert seen.tolist() == [False, True, True, True, True, True, True, True]
    assert vantage.analyse(vtk_mesh(box, quads)).closed


@needs_vtk
def test_vtk_data_that_is_no_surface_is_refused_by_name():
    from vtkmodules.vtkCommonDataModel import vtkImageData
    with pytest.raises(TypeError, match="vtkImageData is no surface: pass a vtkPolyData"):
        vantage.best_view(vtkImageData())


def meshio_of(*blocks):
    cells = [types.SimpleNamespace(type=name, data=data) for name, data in blocks]
    return types.SimpleNamespace(points=V, cells=cells, cells_dict=dict(blocks))


def test_quads_and_polygons_of_meshio_are_cut_as_fans():
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1.0]])
    block = types.SimpleNamespace
    mesh = types.SimpleNamespace(points=points, cells_dict={}, cells=[
        block(type="line", data=np.array([[0, 1]])), block(type="quad", data=np.array([[3, 2, 1, 0]])),
        block(type="triangle", data=np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]))])
    faces = np.array([[3, 2, 1], [3, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    assert (vantage.kssm(mesh).of_vertex == vantage.kssm(points, faces).of_vertex).all()


def test_of_faces_of_meshio_with_nodes_on_their_sides_the_corners_count():
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1.0],
                       [0.5, 0, 0], [1, 0.5, 0], [0.5, 1, 0], [0, 0.5, 0]])
    around = [[0, 1, 4, 5, 5, 5], [1, 2, 4, 6, 6, 6], [2, 3, 4, 7, 7, 7], [3, 0, 4, 8, 8, 8]]
    block = types.SimpleNamespace
    mesh = types.SimpleNamespace(points=points, cells_dict={}, cells=[
        block(type="quad8", data=np.array([[3, 2, 1, 0, 7, 6, 5, 8]])), block(type="triangle6", data=np.array(around))])
    faces = np.array([[3, 2, 1], [3, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    one_way, other = (vantage.visible_vertices(*model, directions=[0.0, 0.0, -1.0]) for model in ((mesh,), (points, faces)))
    assert (one_way == other).all() and not one_way.all()


def test_members_of_trimesh_tuples_and_scenes_are_taken():
    mesh = types.SimpleNamespace(vertices=V, faces=F)
    same_view(mesh)
    same_view((V, F))
    same_view(types.SimpleNamespace(geometry={}, to_geometry=lambda: mesh))
    same_view(meshio_of(("triangle", F)))
    cloud = types.SimpleNamespace(vertices=V)
    same_view(cloud, "points")
    with pytest.raises(TypeError, match="F goes with an array of vertices only"):
        vantage.best_view(mesh, F)


def test_a_tuple_of_two_points_is_two_points():
    with pytest.raises(vantage.InvalidInput):
        vantage.best_view(((0.0, 0.0), (1.0, 1.0)))


def test_every_function_takes_them():
    mesh = types.SimpleNamespace(vertices=V, faces=F)
    exact = {"contraction": "exact"}
    assert (vantage.kssm(mesh, **exact).of_vertex == vantage.kssm(V, F, **exact).of_vertex).all()
    assert vantage.skeleton(mesh, **exact).cycles == 1
    assert vantage.analyse(mesh, **exact).genus == 1
    assert vantage.vertex_map(mesh, method="thickness", **exact).shape == (len(V),)
    above = {"directions": [0.0, 0.0, 1.0], **exact}
    assert vantage.score(mesh, **above) == vantage.score(V, F, **above)
    assert vantage.render(mesh, view="best", size=32, **QUICK).shape == (32, 32, 4)


@pytest.mark.parametrize("library", [pytest.param("open3d", marks=needs_open3d), pytest.param("vtk", marks=needs_vtk)])
@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="NOTHING WAS TESTED: xvfb-run is not installed")
def test_silhouettes_in_the_other_library_are_ours(library, models):
    script = pathlib.Path(__file__).with_name("silhouettes.py")
    done = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", sys.executable, script, library,
                           models / "cat_lowpoly.ply"], capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    shares = [float(line.split()[1]) for line in done.stdout.splitlines()]
    # One column of pixels round the outline of 23 500 is 0.99.
    assert len(shares) == (2 if library == "vtk" else 1) and min(shares) > 0.99, done.stdout


def test_matrices_of_cameras_project_the_same_point():
    camera = vantage.best_view(V, F, **QUICK).best.camera
    width, height = 400, 300
    point = np.array([*V[5], 1.0])
    x, y, depth = camera.intrinsics(width, height) @ (camera.extrinsics() @ point)[:3]
    in_opengl = np.linalg.inv(camera.camera_transform) @ point
    half_x, half_y = (np.tan(np.radians(angle) / 2) for angle in camera.fov(width, height))
    assert depth == pytest.approx(-in_opengl[2])
    assert x / depth == pytest.approx(width / 2 * (1 + in_opengl[0] / -in_opengl[2] / half_x))
    assert y / depth == pytest.approx(height / 2 * (1 - in_opengl[1] / -in_opengl[2] / half_y))
    assert camera.camera_position == tuple(map(tuple, (camera.eye, camera.target, camera.up)))


def test_a_cameras_matrices_are_of_the_picture_that_render_takes():
    askew = vantage.Camera("perspective", np.array([1.0, 2.0, 3.0]), np.zeros(3), np.array([0.0, 2.0, 0.0]))
    pose = askew.world_from_camera()
    assert np.allclose(pose[:3, :3].T @ pose[:3, :3], np.eye(3)) and np.linalg.det(pose) == pytest.approx(1)
    upright = vantage.Camera("perspective", askew.eye, askew.target, pose[:3, 1])
    small = {"size": 16, "quality": "draft"}
    assert np.array_equal(vantage.render(V, F, camera=askew, **small), vantage.render(V, F, camera=upright, **small))
    for up, target in ((askew.eye, askew.target), (np.zeros(3), askew.target), (askew.up, askew.eye)):
        camera = vantage.Camera("perspective", askew.eye, target, up)
        for take in (camera.world_from_camera, lambda camera=camera: vantage.render(V, F, camera=camera, **small)):
            with pytest.raises(vantage.InvalidInput, match="camera"):
                take()


def test_a_notebook_shows_the_best_view():
    result = vantage.best_view(V, F, **QUICK)
    data = result._repr_png_()
    width, height = struct.unpack(">II", data[16:24])
    start = data.index(b"IDAT") + 4
    rows = np.frombuffer(zlib.decompress(data[start:]), np.uint8).reshape(height, 1 + 4 * width)
    shown = rows[:, 1:].reshape(height, width, 4)
    assert (shown == vantage.render(V, F, camera=result.best.camera, size=(width, height))).all()
    again = pickle.loads(pickle.dumps(result))
    assert again.json == result.json and again._repr_png_() is None
