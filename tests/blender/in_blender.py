# SPDX-License-Identifier: MIT
"""Runs inside Blender: builds a scene, presses the add-on's buttons, renders, and writes what happened as JSON.

    blender -b --factory-startup --python in_blender.py -- ADDON.zip PROGRAM MODELS OUT
"""
import json
import math
import pathlib
import sys

import bpy
import numpy as np

ADDON, PROGRAM, MODELS, OUT = map(pathlib.Path, sys.argv[sys.argv.index("--") + 1:])
RESULT = {"errors": {}}


def press(operator, **options):
    """The operator's answer, and what it showed as an error."""
    try:
        return sorted(operator(**options))
    except RuntimeError as error:
        return str(error)


def place(path, location=(0, 0, 0), rotation=(0, 0, 0), scale=1.0):
    """Imports a model, a longest side of 2 × scale."""
    bpy.ops.import_mesh.ply(filepath=str(path))
    placed = bpy.context.selected_objects[0]
    placed.scale = [2.0 * scale / max(placed.dimensions)] * 3
    placed.location, placed.rotation_euler = location, rotation
    return placed


def select(*objects):
    bpy.ops.object.select_all(action="DESELECT")
    for each in objects:
        each.select_set(True)
    bpy.context.view_layer.objects.active = objects[0]
    bpy.context.view_layer.update()


def render(name):
    scene = bpy.context.scene
    scene.render.filepath = str(OUT / f"{name}.png")
    bpy.ops.render.render(write_still=True)


def case(name):
    """The best view of what is selected: camera, picture, and the selection as Blender's own exporter writes it."""
    bpy.ops.export_mesh.ply(filepath=str(OUT / f"{name}.ply"), use_selection=True, use_ascii=False, use_normals=False,
                            use_uv_coords=False, use_colors=False, axis_forward="Y", axis_up="Z")
    for hidden in bpy.data.objects:
        hidden.hide_render = not hidden.select_get()
    answer = press(bpy.ops.vantage.best_view, which="BEST")
    camera = bpy.context.scene.camera
    bpy.context.view_layer.update()
    RESULT[name] = {"answer": answer, "eye": list(camera.matrix_world.translation),
                    "fov_y_deg": math.degrees(camera.data.angle_y)}
    render(name)


def main():
    scene = bpy.context.scene
    bpy.ops.preferences.addon_install(filepath=str(ADDON))
    bpy.ops.preferences.addon_enable(module="vantage_best_view")
    preferences = bpy.context.preferences.addons["vantage_best_view"].preferences
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    bpy.data.objects.remove(bpy.data.objects["Camera"])  # the add-on makes its own
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.render.film_transparent = True
    scene.render.resolution_x, scene.render.resolution_y = 400, 300
    scene.render.image_settings.color_mode = "RGBA"

    RESULT["errors"]["nothing selected"] = press(bpy.ops.vantage.best_view)
    select(bpy.data.objects["Light"])
    preferences.program = str(PROGRAM)
    RESULT["errors"]["no faces"] = press(bpy.ops.vantage.best_view)
    horse = place(MODELS / "horse.ply", rotation=(math.pi / 2, 0, 0.7))
    preferences.program = "/nonexistent/vantage"
    RESULT["errors"]["no program"] = press(bpy.ops.vantage.best_view)
    preferences.program = str(PROGRAM)

    select(horse)
    case("horse")
    cat = place(MODELS / "cat_lowpoly.ply", location=(1.5, -1, 0.5), rotation=(math.pi / 2, 0, 2), scale=0.5)
    cat.modifiers.new("Subdivision", "SUBSURF").levels = 1
    teddy = place(MODELS / "teddy.ply", location=(-2, 1, 1), scale=0.8)
    # Evaluated: one more copy of the teddy that only the modifier makes.
    bpy.context.view_layer.update()
    depth = teddy.dimensions[1] / teddy.scale[1]
    array = teddy.modifiers.new("Array", "ARRAY")
    array.count, array.use_relative_offset, array.use_constant_offset = 2, False, True
    array.constant_offset_displace = (0, 1.2 * depth, 0)
    select(cat, teddy)
    case("cat and teddies")

    directions = []
    for which in ("NEXT", "NEXT", "NEXT", "WORST"):
        RESULT[f"{which} {len(directions)}"] = press(bpy.ops.vantage.best_view, which=which)
        bpy.context.view_layer.update()
        directions.append(list(scene.camera.matrix_world.translation))
    RESULT["eyes"] = directions

    RESULT["tour"] = press(bpy.ops.vantage.tour, views=3, seconds=2.0)
    eyes, turns = [], []
    for frame in range(scene.frame_start, scene.frame_end + 2):
        scene.frame_set(frame)
        eyes.append(list(scene.camera.matrix_world.translation))
        turns.append([list(row) for row in scene.camera.matrix_world.to_3x3()])
    RESULT["tour_eyes"], RESULT["tour_turns"] = eyes, turns
    scene.frame_set(scene.frame_start + 20)
    render("tour")

    # An instance of a collection is an object like any other.
    group = bpy.data.collections.new("group")
    group.objects.link(horse)
    stand_in = bpy.data.objects.new("stand-in", None)
    stand_in.instance_type, stand_in.instance_collection = "COLLECTION", group
    stand_in.location = (10, 0, 0)
    scene.collection.objects.link(stand_in)
    select(stand_in)
    RESULT["instance"] = press(bpy.ops.vantage.best_view)
    bpy.context.view_layer.update()
    RESULT["instance_eye"] = list(scene.camera.matrix_world.translation)
    (OUT / "result.json").write_text(json.dumps(RESULT, indent=1))


main()
