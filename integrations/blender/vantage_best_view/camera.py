# SPDX-License-Identifier: MIT
"""The scene's camera, put where the program says. Both look along their own −z with y up."""

import math

import bpy
from mathutils import Matrix, Quaternion, Vector

NAME = "Vantage camera"


def picture_size(scene):
    """Of a picture of square pixels with the shape of the scene's."""
    render = scene.render
    return (max(1, round(render.resolution_x * render.pixel_aspect_x)),
            max(1, round(render.resolution_y * render.pixel_aspect_y)))


def scene_camera(scene):
    """The scene's camera; a new one if it has none."""
    if scene.camera is None:
        scene.camera = bpy.data.objects.new(NAME, bpy.data.cameras.new(NAME))
        scene.collection.objects.link(scene.camera)
    return scene.camera


def set_lens(scene, fov_y, nearest, farthest):
    lens = scene_camera(scene).data
    lens.type = "PERSP"
    lens.sensor_fit = "VERTICAL"
    lens.angle_y = fov_y
    lens.shift_x = lens.shift_y = 0.0
    # Nothing of the selection is cut off, and what else the camera shows stays.
    lens.clip_end = max(lens.clip_end, 2.0 * farthest)
    lens.clip_start = min(lens.clip_start, max(0.5 * nearest, 1e-3 * farthest))


def pose_of(eye, target, up):
    back = (Vector(eye) - Vector(target)).normalized()
    right = Vector(up).cross(back).normalized()
    turn = Matrix((right, back.cross(right), back)).transposed()
    return Matrix.Translation(eye) @ turn.to_4x4()


def set_view(scene, view, reach):
    """Sets the camera to a view of view.json. reach: radius of what is looked at."""
    frame = view["frame"]
    holder = scene_camera(scene)
    if holder.animation_data is not None:
        holder.animation_data.action = None  # a tour would take the camera away again
    holder.matrix_world = pose_of(view["eye"], frame["target"], view["up"])
    distance = (Vector(view["eye"]) - Vector(frame["target"])).length
    set_lens(scene, math.radians(frame["fov_y_deg"]), distance - reach, distance + reach)


def set_tour(scene, result, seconds):
    """Keyframes from the scene's first frame on, at even speed."""
    holder = scene_camera(scene)
    if holder.animation_data is not None:
        holder.animation_data.action = None
    holder.rotation_mode = "QUATERNION"
    last = len(result.tour) - 1
    frames = seconds * scene.render.fps / scene.render.fps_base
    before = None
    for i, (position, (x, y, z, w)) in enumerate(result.tour):
        # World space: a parent of the camera's stays its parent.
        holder.matrix_world = Matrix.Translation(position) @ Quaternion((w, x, y, z)).to_matrix().to_4x4()
        if before is not None and holder.rotation_quaternion.dot(before) < 0.0:
            holder.rotation_quaternion = -holder.rotation_quaternion  # the same, reached the short way
        before = holder.rotation_quaternion.copy()
        for path in ("location", "rotation_quaternion"):
            holder.keyframe_insert(path, frame=scene.frame_start + frames * i / last)
    for curve in holder.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    scene.frame_end = max(scene.frame_start, scene.frame_start + round(frames) - 1)
    lens = result.view["camera"]
    set_lens(scene, result.tour_fov_y, lens["distance"] - result.reach, lens["distance"] + result.reach)
    scene.frame_set(scene.frame_start)
