#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Pictures of the same models from the same cameras by this program, by f3d and by Blender, on one sheet.

    compare_pictures.py PROGRAM SHEET.png MODEL...

Columns: ours in the styles asset, clay and technical; f3d with its best lights (ambient occlusion,
antialiasing); Blender's Cycles with 32 samples. What is not installed is left out. Needs python3-pil;
f3d needs xvfb-run. Times are processor seconds of the whole command, so that they may be compared.
"""

import json
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile

from PIL import Image, ImageDraw

SIDE = 320
BLENDER = """
import numpy; numpy.bool = bool  # Debian's importer of glTF asks for what numpy 1.24 has dropped
import bpy, math, mathutils, sys
model, out, eye, target, up, fov = {arguments!r}
bpy.ops.wm.read_factory_settings(use_empty=True)
ending = model.rsplit('.', 1)[-1].lower()
if ending in ('glb', 'gltf'):
    bpy.ops.import_scene.gltf(filepath=model)
elif ending == 'obj':
    bpy.ops.wm.obj_import(filepath=model)
elif ending == 'ply':
    bpy.ops.import_mesh.ply(filepath=model)
elif ending == 'stl':
    bpy.ops.import_mesh.stl(filepath=model)
turned = ending in ('glb', 'gltf', 'obj')  # brought from y up to z up
turn = lambda v: mathutils.Vector((v[0], -v[2], v[1]) if turned else v)
eye, target, up = turn(eye), turn(target), turn(up)
camera = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
back = (eye - target).normalized()
right = up.cross(back).normalized()
camera.matrix_world = mathutils.Matrix((right, back.cross(right), back)).transposed().to_4x4()
camera.location = eye
camera.data.sensor_fit = 'VERTICAL'
camera.data.angle = math.radians(fov)
camera.data.clip_end = 1e6
camera.data.clip_start = (eye - target).length * 1e-3
scene = bpy.context.scene
scene.collection.objects.link(camera)
scene.camera = camera
sun = bpy.data.objects.new('sun', bpy.data.lights.new('sun', 'SUN'))
sun.data.energy, sun.data.angle = 2.5, 0.3
light = (-0.5 * right + 0.68 * back.cross(right) + 0.7 * back).normalized()
sun.rotation_euler = light.to_track_quat('Z', 'Y').to_euler()
scene.collection.objects.link(sun)
scene.world = bpy.data.worlds.new('world')
scene.world.use_nodes = True
scene.world.node_tree.nodes['Background'].inputs[0].default_value = (1, 1, 1, 1)
scene.world.node_tree.nodes['Background'].inputs[1].default_value = 0.6
scene.render.engine = 'CYCLES'
scene.cycles.samples = 32
scene.cycles.use_denoising = False  # Debian builds it without a denoiser
scene.view_settings.view_transform = 'Standard'
scene.render.film_transparent = True
scene.render.resolution_x = scene.render.resolution_y = {side}
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
"""


def run(command, **more):
    """Processor seconds of a command; None if it failed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=300, **more)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return (seconds if done.returncode == 0 else None), done.stdout


def ours(program, model, direction, style, out):
    command = [program, "render", model, "-o", out, "--size", f"{SIDE}x{SIDE}", "--json", "--style", style,
               "--direction=" + ",".join(repr(x) for x in direction)]
    return run(command)


def f3d(model, camera, out):
    numbers = {k: ",".join(repr(x) for x in camera[k]) for k in ("eye", "target", "up")}
    return run(["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", "f3d", model, f"--output={out}",
                f"--resolution={SIDE},{SIDE}", "--no-background", "-q", "-a", "--filename=0", "--progress=0",
                f"--camera-position={numbers['eye']}", f"--camera-focal-point={numbers['target']}",
                f"--camera-view-up={numbers['up']}", f"--camera-view-angle={camera['fov_y_deg']!r}"])[0]


def blender(model, camera, out, scratch):
    script = pathlib.Path(scratch) / "picture.py"
    arguments = (model, str(out), *(camera[k] for k in ("eye", "target", "up", "fov_y_deg")))
    script.write_text(BLENDER.format(arguments=arguments, side=SIDE))
    return run(["blender", "-b", "--python-exit-code", "1", "-P", str(script)])[0]


def row(program, model, scratch):
    """Pictures of a model with what is written below them."""
    direction = json.loads(run([program, "thumb", model, f"{scratch}/t.png", "--json"])[1])["direction"]
    pictures = []
    for style in ("asset", "clay", "technical"):
        out = f"{scratch}/{style}.png"
        seconds, text = ours(program, model, direction, style, out)
        pictures.append((f"ours, {style}", out, seconds))
        camera = json.loads(text)
    if shutil.which("f3d"):
        pictures.append(("f3d", f"{scratch}/f3d.png", f3d(model, camera, f"{scratch}/f3d.png")))
    if shutil.which("blender"):
        pictures.append(("Cycles", f"{scratch}/cycles.png", blender(model, camera, f"{scratch}/cycles.png", scratch)))
    tiles = []
    for name, file, seconds in pictures:
        tile = Image.new("RGB", (SIDE, SIDE + 20), "white")
        if seconds is not None:
            picture = Image.open(file).convert("RGBA")
            tile.paste(picture, (0, 0), picture)
        text = f"{name}: " + ("failed" if seconds is None else f"{seconds:.1f} s")
        ImageDraw.Draw(tile).text((6, SIDE + 4), text, fill="black")
        tiles.append(tile)
        print(f"{pathlib.Path(model).name}\t{text}", flush=True)
    return tiles


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    program, sheet_file, *models = sys.argv[1:]
    rows = []
    for model in models:
        with tempfile.TemporaryDirectory() as scratch:
            rows.append(row(program, model, scratch))
    sheet = Image.new("RGB", (max(map(len, rows)) * SIDE, len(rows) * (SIDE + 20)), "white")
    for y, tiles in enumerate(rows):
        for x, tile in enumerate(tiles):
            sheet.paste(tile, (x * SIDE, y * (SIDE + 20)))
    sheet.save(sheet_file)


if __name__ == "__main__":
    main()
