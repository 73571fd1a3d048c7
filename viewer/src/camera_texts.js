// SPDX-License-Identifier: MIT
// Cameras of views for programs that vantage itself writes no file for.

const triple = (v) => v.map((x) => Number(x.toPrecision(7))).join(', ');
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const minus = (a, b) => a.map((x, i) => x - b[i]);
const length = (v) => Math.hypot(...v);
const unit = (v) => v.map((x) => x / length(v));

/** A view's camera in the model's own coordinates. */
function worldCamera(view, json) {
  const { camera } = json;
  const radius = camera.distance * Math.sin((camera.fov_y_deg * Math.PI) / 360);
  const world = (p) => p.map((x, i) => camera.target[i] + radius * x);
  return { eye: world(view.eye), target: world(view.target), up: view.up, fov: view.fov_y_deg };
}

/** Blender's importers of glTF and OBJ turn y up into z up. */
function inBlender(v, format) {
  return ['glb', 'gltf', 'obj'].includes(format) ? [v[0], -v[2], v[1]] : v;
}

export function blenderScript(view, json) {
  const format = json.model.format.toLowerCase();
  const camera = worldCamera(view, json);
  const [eye, target, up] = [camera.eye, camera.target, camera.up].map((v) => inBlender(v, format));
  const back = unit(minus(eye, target));
  const right = unit(cross(up, back));
  return [
    'import bpy, math, mathutils',
    "camera = bpy.data.objects.new('vantage', bpy.data.cameras.new('vantage'))",
    `camera.matrix_world = mathutils.Matrix(((${triple(right)}), (${triple(cross(back, right))}), (${triple(back)}))).transposed().to_4x4()`,
    `camera.location = (${triple(eye)})`,
    "camera.data.sensor_fit = 'VERTICAL'",
    `camera.data.angle = math.radians(${triple([camera.fov])})`,
    `camera.data.clip_start, camera.data.clip_end = ${triple([1e-3 * length(minus(eye, target))])}, ${triple([10 * length(minus(eye, target))])}`,
    'bpy.context.scene.collection.objects.link(camera)',
    'bpy.context.scene.camera = camera',
    '',
  ].join('\n');
}
