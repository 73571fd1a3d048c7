// SPDX-License-Identifier: MIT
// Cameras of views for programs that vantage itself writes no file for.

const triple = (v) => v.map((x) => Number(x.toPrecision(7))).join(', ');
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const minus = (a, b) => a.map((x, i) => x - b[i]);
const length = (v) => Math.hypot(...v);
const unit = (v) => v.map((x) => x / length(v));

const same = (v) => v;
const yUpToZUp = (v) => [v[0], -v[2], v[1]];
/** Where Blender's own importers put a point of such a file. Others turn and scale by what the file says. */
const IN_BLENDER = { glb: yUpToZUp, gltf: yUpToZUp, obj: yUpToZUp, ply: same, stl: same };

/** Empty where the camera's place in Blender is not known.
 *  @param frame the centre and the radius that the page's lengths are measured by.
 *  @param turn rows of the rotation from the file's points to the page's. */
export function blenderScript(view, frame, format, turn) {
  const placed = IN_BLENDER[format.toLowerCase()];
  if (!placed) {
    return '';
  }
  const world = (p) => p.map((x, i) => frame.centre[i] + frame.radius * x);
  const inFile = (v) => [0, 1, 2].map((i) => v.reduce((sum, x, row) => sum + turn[row][i] * x, 0));
  const [eye, target, up] = [world(view.eye), world(view.target), view.up].map(inFile).map(placed);
  const back = unit(minus(eye, target));
  const right = unit(cross(up, back));
  const away = length(minus(eye, target));
  const lens = view.height === undefined
    ? [`camera.data.angle = math.radians(${triple([view.fov_y_deg])})`]
    : ["camera.data.type = 'ORTHO'", `camera.data.ortho_scale = ${triple([frame.radius * view.height])}`];
  return [
    'import bpy, math, mathutils',
    "camera = bpy.data.objects.new('vantage', bpy.data.cameras.new('vantage'))",
    `camera.matrix_world = mathutils.Matrix(((${triple(right)}), (${triple(cross(back, right))}), (${triple(back)}))).transposed().to_4x4()`,
    `camera.location = (${triple(eye)})`,
    "camera.data.sensor_fit = 'VERTICAL'",
    ...lens,
    `camera.data.clip_start, camera.data.clip_end = ${triple([1e-3 * away])}, ${triple([10 * away])}`,
    'bpy.context.scene.collection.objects.link(camera)',
    'bpy.context.scene.camera = camera',
    '',
  ].join('\n');
}
