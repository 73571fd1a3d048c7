# SPDX-License-Identifier: MIT
"""Arrays in and out: types, orders, shapes, and who owns the memory."""

import gc
import math

import numpy as np
import pytest

from conftest import torus
from shapes import ball_with_pole
import vantage

V, F = torus(12, 8)


def seen(vertices, faces):
    """Something that depends on every vertex and face."""
    return vantage.visible_vertices(vertices, faces, sphere=0)


@pytest.mark.parametrize("vertices", [
    np.asfortranarray(V), np.repeat(V, 2, axis=0)[::2], np.c_[V, V][:, :3], V[::-1][::-1],
    V.astype(">f8"), V.astype(np.longdouble), V.tolist(),
    np.frombuffer(b"x" + V.tobytes(), np.uint8)[1:].view(np.float64).reshape(V.shape),
], ids=["fortran", "strided", "columns", "negative strides", "big endian", "long double", "list",
        "unaligned"])
def test_vertices_mean_the_same_in_any_layout(vertices):
    assert np.array_equal(vantage.Model(vertices, F).vertices, V)


def test_single_precision_is_read_exactly():
    assert np.array_equal(vantage.Model(V.astype(np.float32), F).vertices,
                          V.astype(np.float32).astype(np.float64))


def test_whole_numbers_are_coordinates():
    assert np.array_equal(vantage.Model([[0, 0, 0], [1, 0, 0], [0, 2, 0]]).vertices[2], [0, 2, 0])


@pytest.mark.parametrize("kind", ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", ">i4", ">u8"])
def test_faces_may_be_any_integers(kind):
    assert np.array_equal(vantage.Model(V, F.astype(kind)).faces, F)


@pytest.mark.parametrize("faces", [np.asfortranarray(F), np.repeat(F, 2, axis=0)[::2], F.tolist()],
                         ids=["fortran", "strided", "list"])
def test_faces_mean_the_same_in_any_layout(faces):
    assert np.array_equal(vantage.Model(V, faces).faces, F)


def test_arrays_are_read_not_kept():
    mine = V.copy()
    model = vantage.Model(mine, F)
    mine[:] = 0
    assert np.array_equal(model.vertices, V)


@pytest.mark.parametrize("vertices, faces, message", [
    (V[:, :2], F, r"V must have the shape \(n, 3\), not \(96, 2\)"),
    (V.ravel(), F, r"V must have the shape \(n, 3\)"),
    (V[None], F, r"V must have the shape \(n, 3\)"),
    (V[:0], F, "V holds no vertices"),
    (V, F[:, :2], r"F must have the shape \(n, 3\)"),
    (V, F + 1, "F names vertex 96 in row"),
    (V, F - 1, "F names vertex -1 in row"),
    (V, np.array([[0, 1, 2**64 - 1]], np.uint64), "F names vertex 18446744073709551615 in row 0"),
    (np.where(np.arange(96)[:, None] == 7, np.nan, V), F, "not finite in row 7"),
    (np.where(np.arange(96)[:, None] == 9, np.inf, V), F, "not finite in row 9"),
])
def test_arrays_that_are_no_model_are_refused(vertices, faces, message):
    with pytest.raises(vantage.InvalidInput, match=message):
        vantage.best_view(vertices, faces)


@pytest.mark.parametrize("vertices, faces, message", [
    (V.astype(complex), F, "V must hold real numbers, not complex128"),
    (V.astype(str), F, "V must hold real numbers"),
    (V.astype(object), F, "V must hold real numbers"),
    (V, F.astype(float), "F must hold integers, not float64"),
    (V, F.astype(bool), "F must hold integers, not bool"),
    ("model.ply", F, "F goes with an array of vertices only"),
    (None, F, "V must"),
])
def test_arrays_of_other_things_are_refused(vertices, faces, message):
    with pytest.raises((TypeError, vantage.InvalidInput), match=message):
        vantage.best_view(vertices, faces)


@pytest.mark.parametrize("call, message", [
    (lambda: vantage.kssm(None), "V must be an array of numbers, not NoneType"),
    (lambda: vantage.kssm(5), "V must be an array of numbers, not int"),
    (lambda: vantage.kssm({}), "V must be an array of numbers, not dict"),
    (lambda: vantage.kssm(["a", "b"]), "V must hold real numbers"),
    (lambda: vantage.kssm(V, 5), "F must be an array of numbers, not int"),
    (lambda: vantage.kssm(V, ["a", "b", "c"]), "F must hold integers"),
    (lambda: vantage.Model(V, F, colours="red"), "colours must be an array of numbers, not str"),
    (lambda: vantage.score(V, F, directions="x"), "directions must be an array of numbers, not str"),
    (lambda: vantage.render(V, F, direction="x"), "direction must be an array of numbers, not str"),
    (lambda: vantage.render(V, F, direction=["x", "y"]), "direction must hold real numbers"),
    (lambda: vantage.colour_map("x"), "values must be an array of numbers, not str"),
    (lambda: vantage.colour_map([1j]), "values must hold real numbers"),
])
def test_what_is_no_array_of_numbers_is_a_type_error(call, message):
    with pytest.raises(TypeError, match=message):
        call()


@pytest.mark.parametrize("raised", [KeyboardInterrupt, MemoryError, RuntimeError, ValueError])
def test_what_an_array_raises_as_it_is_made_is_not_lost(raised):
    class Lazy:
        def __array__(self, *_, **__):
            raise raised("far away")

    with pytest.raises(TypeError if raised is ValueError else raised) as caught:
        vantage.kssm(Lazy(), F)
    cause = caught.value.__cause__ if raised is ValueError else caught.value
    assert isinstance(cause, raised) and str(cause) == "far away"


def test_a_model_without_extent_is_refused():
    with pytest.raises(vantage.InvalidInput):
        vantage.best_view(np.zeros((3, 3)), [[0, 1, 2]])


def test_vertices_without_faces_are_a_point_cloud():
    points, _ = torus(40, 20)
    result = vantage.kssm(points)
    assert result.of_vertex.shape == (800,) and np.ptp(result.of_vertex) > 0


def test_no_faces_at_all_are_the_same_as_none():
    assert np.array_equal(vantage.Model(V, []).faces, np.empty((0, 3)))
    assert np.array_equal(vantage.Model(V, np.empty((0, 3), int)).faces, np.empty((0, 3)))


def test_no_faces_at_all_are_noted():
    note = "F holds no faces, so V is taken for a point cloud"
    points, _ = torus(40, 20)
    empty = np.empty((0, 3), int)
    assert vantage.Model(points, empty).notes == (note,)
    assert not vantage.Model(points).notes and not vantage.Model(V, F).notes
    result = vantage.best_view(points, empty, search="exhaustive", subdivisions=0)
    assert note in result.warnings
    assert np.array_equal(vantage.kssm(points, empty).of_vertex, vantage.kssm(points).of_vertex)


@pytest.mark.parametrize("faces", [[[]], np.empty((0, 4), int), np.empty((2, 0), int), np.empty((0, 3, 3), int)])
def test_no_faces_of_another_shape_are_refused(faces):
    with pytest.raises(vantage.InvalidInput, match=r"F must have the shape \(n, 3\), not"):
        vantage.Model(V, faces)


def test_a_vertex_without_faces_has_no_node_and_no_significance():
    lonely = np.r_[V, [[0.0, 0.0, 0.0]]]
    assert vantage.skeleton(lonely, F).vertex_node[-1] == -1
    assert vantage.kssm(lonely, F).of_vertex[-1] == 0
    assert not seen(lonely, F)[:, -1].any()


def test_vertices_at_one_place_get_the_same_numbers():
    doubled, faces = np.r_[V, V], np.where(np.arange(len(F))[:, None] % 2, F, F + len(V))
    result = vantage.kssm(doubled, faces).of_vertex
    assert np.array_equal(result[:96], result[96:])
    assert np.array_equal(result[:96], vantage.kssm(V, F).of_vertex)


def test_a_models_arrays_are_views_that_outlive_it():
    model = vantage.Model(V, F, colours=np.full((96, 3), 7, np.uint8))
    first, again, colours = model.vertices, model.vertices, model.colours
    assert np.shares_memory(first, again)
    assert not first.flags.writeable and not first.flags.owndata
    del model, again
    gc.collect()
    assert np.array_equal(first, V) and (colours == 7).all()


def test_results_are_not_copied_and_can_be_written_to():
    result = vantage.kssm(V, F, levels=True)
    for array in (result.of_vertex, result.thickness, result.displacement,
                  vantage.render(V, F, direction=(0, 0, 1), size=16, quality="draft")):
        assert not array.flags.owndata and type(array.base).__name__ == "PyCapsule"
        assert array.flags.c_contiguous
        array[...] = 0


def test_levels_begin_with_the_input():
    result = vantage.skeleton(V, F, levels=True)
    assert np.array_equal(result.levels[0], V)
    assert result.levels.shape == (len(result.shrinkage), 96, 3)


def test_thickness_is_the_displacement_of_the_first_level():
    result = vantage.kssm(V, F, levels=True)
    assert np.array_equal(result.thickness, result.displacement[0])


def test_a_single_eye_gives_a_single_row():
    assert np.array_equal(vantage.visible_vertices(V, F, eyes=[0, 0, 9]),
                          vantage.visible_vertices(V, F, eyes=[[0, 0, 9]])[0])


def test_from_above_a_torus_shows_its_upper_half():
    points, faces = torus(36, 24)
    above = vantage.visible_vertices(points, faces, eyes=[0, 0, 1e6])
    assert np.array_equal(above[np.abs(points[:, 2]) > 0.1], points[np.abs(points[:, 2]) > 0.1][:, 2] > 0)


def test_the_score_of_a_view_is_the_sum_of_the_significance_it_sees():
    directions = vantage.directions(1).directions
    sums = vantage.visible_vertices(V, F, directions=directions) @ vantage.kssm(V, F).of_vertex
    assert np.allclose(vantage.score(V, F, directions=directions), sums, rtol=1e-12)


def test_length_of_a_direction_does_not_matter():
    assert vantage.score(V, F, directions=[0, 0, 5]) == vantage.score(V, F, directions=[0, 0, 1])


@pytest.mark.parametrize("keywords", [
    {}, {"eyes": [0, 0, 9], "sphere": 0}, {"directions": [0, 0, 0]}, {"directions": [1.7e308] * 3}, {"directions": [[0, 1]]},
    {"eyes": [0, 0, np.nan]}, {"sphere": 9}, {"sphere": -1}, {"sphere": 2**40},
    {"sphere": 0, "view_set": -1}, {"sphere": 0, "view_set": 7}])
def test_views_that_make_no_sense_are_refused(keywords):
    with pytest.raises(vantage.InvalidInput):
        vantage.score(V, F, **keywords)


def test_a_map_that_is_none_is_refused_with_all_there_are():
    with pytest.raises(vantage.InvalidInput, match="there are kssm, thickness, mesh-saliency, pmi-saliency"):
        vantage.vertex_map(V, F, method="foo")


def test_colours_of_vertices_are_drawn():
    red = np.tile(np.array([255, 0, 0], np.uint8), (96, 1))
    picture = vantage.render(V, F, direction=(0, 0, 1), colours=red, size=32, quality="draft")
    solid = picture[picture[..., 3] == 255]
    assert len(solid) > 100 and (solid[:, 0] > solid[:, 1]).all()
    with pytest.raises(vantage.InvalidInput, match="96 vertices"):
        vantage.render(V, F, direction=(0, 0, 1), colours=red[1:], size=32)
    with pytest.raises(vantage.InvalidInput, match="colours has 0 rows"):
        vantage.render(V, F, direction=(0, 0, 1), colours=red[:0], size=32)
    with pytest.raises(TypeError, match="colours must be uint8, or floats from 0 to 1, not int64"):
        vantage.render(V, F, direction=(0, 0, 1), colours=red.astype(np.int64), size=32)


@pytest.mark.parametrize("kind", [np.float64, np.float32, np.float16, ">f8"])
def test_colours_may_be_shares(kind):
    shares = np.tile(np.array([[1, 0.5, 0], [0.25, 0, 1]], kind), (48, 1))
    expected = np.tile(np.array([[255, 128, 0], [64, 0, 255]], np.uint8), (48, 1))
    assert np.array_equal(vantage.Model(V, F, colours=shares).colours, expected)
    assert np.array_equal(vantage.Model(V, F, colours=shares.tolist()).colours, expected)
    pictures = [vantage.render(V, F, direction=(0, 0, 1), colours=colours, size=16, quality="draft")
                for colours in (shares, expected)]
    assert np.array_equal(*pictures)


@pytest.mark.parametrize("share", [255.0, -0.01, math.nan, math.inf])
def test_shares_of_colour_beyond_0_and_1_are_refused(share):
    colours = np.full((96, 3), 0.5)
    colours[7, 1] = share
    with pytest.raises(vantage.InvalidInput, match="colours must be between 0 and 1 where they are floats, in row 7"):
        vantage.Model(V, F, colours=colours)


def test_colours_of_a_cloud_are_drawn_on_points_that_no_triangle_joins():
    points = np.array(ball_with_pole())
    red = np.tile(np.array([255, 0, 0], np.uint8), (len(points), 1))
    camera = vantage.Camera("perspective", np.array([0, 2.0, 12]), np.array([0, 2.0, 0]), np.array([0, 1.0, 0]), 30.0)
    of_lists = vantage.Camera("perspective", [0, 2, 12], (0, 2, 0), [0, 1, 0], 30.0)
    assert of_lists == camera and hash(of_lists) == hash(camera)
    np.testing.assert_array_equal(of_lists.world_from_camera(), camera.world_from_camera())
    shown = [vantage.render(points, camera=camera, colours=colours, size=200, quality="draft")[..., 3]
             for colours in (None, red)]
    assert np.array_equal(*shown) and shown[0][:90].any()


def test_a_camera_that_was_given_out_takes_the_same_picture():
    direction = (1.0, 2.0, 3.0)
    analysis = vantage.analyse(V, F)
    result = vantage.best_view(analysis, size=48)
    again = vantage.render(analysis, camera=result.best.camera, size=48, quality="draft")
    assert np.array_equal(again, vantage.render(analysis, view="best", size=48, quality="draft"))
    assert not np.array_equal(again, vantage.render(analysis, direction=direction, size=48,
                                                    quality="draft"))


def test_a_picture_takes_the_aspect_of_what_is_seen():
    V, F = torus(12, 8)
    best = vantage.best_view(V, F, size="auto:30").best
    picture = vantage.render(V, F, camera=best.camera, size=best.size, quality="draft")
    assert np.array_equal(picture, vantage.render(V, F, view="best", size="auto:30", quality="draft"))
    assert abs(picture.shape[0] * picture.shape[1] - 900) < 30
    assert picture[2:-2].any() and picture.shape[0] != picture.shape[1]


def test_a_cameras_matrices_put_its_target_in_the_middle_of_the_picture():
    camera = vantage.best_view(V, F, size=(200, 100)).best.camera
    target = np.linalg.inv(camera.world_from_camera()) @ [*camera.target, 1]
    x, y, w = camera.intrinsics(200, 100) @ (target[:3] * [1, -1, -1])
    assert np.allclose([x / w, y / w], [100, 50]) and w > 0


def test_colour_map_goes_from_cool_to_warm_and_nan_is_grey():
    cool, warm, none = vantage.colour_map([0.0, 1.0, np.nan]).astype(int)
    assert cool[2] > cool[0] and warm[0] > warm[2] and none.max() - none.min() <= 8


@pytest.mark.parametrize("size", [1e-320, 1e-300, 1e80, 1e300, np.nan, np.inf])
@pytest.mark.parametrize("function", [vantage.best_view, vantage.render, vantage.skeleton])
def test_sizes_beyond_what_can_be_computed_are_refused(function, size):
    tetrahedron = np.array([[size, 0, 0], [0, size, 0], [0, 0, size], [0, 0, 0]])
    with pytest.raises(vantage.InvalidInput):
        function(tetrahedron, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


@pytest.mark.parametrize("size", [1e-59, 1e59])
def test_sizes_at_the_limits_give_finite_views(size):
    tetrahedron = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]]) * size
    best = vantage.best_view(tetrahedron, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]).best
    assert np.isfinite(best.score) and abs(np.linalg.norm(best.direction) - 1) < 1e-12
