// SPDX-License-Identifier: MIT
// Normals of what the page draws: as src/render/corner_normals.cpp has them for pictures.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { outwardNormals, ShadedVertices } from '../../viewer/src/corner_normals.js';

const kStep = 2.5 / 65535; // of the grid that positions are sent on
const shaded = (points, faces, isMoved = false, creaseDeg = 40) => new ShadedVertices(
  Float32Array.from(points.flat().map((x) => Math.round(x / kStep) * kStep)), Uint32Array.from(faces.flat()), creaseDeg, isMoved);
const normalOf = (surface, corner) => Array.from(surface.normals.subarray(3 * surface.index[corner], 3 * surface.index[corner] + 3));
const near = (a, b) => Math.hypot(...a.map((x, i) => x - b[i])) < 1e-3;

/** Two squares over an edge, bent by an angle; each has vertices of its own. \param turned the second is wound the other way. */
function roof(degrees, turned) {
  const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  const points = [[-1, 0, 0], [0, 0, 0], [0, 1, 0], [-1, 1, 0], [0, 0, 0], [c, 0, -s], [c, 1, -s], [0, 1, 0]];
  const second = [[4, 5, 6], [4, 6, 7]];
  const faces = [[0, 1, 2], [0, 2, 3], ...(turned ? second.map(([i, j, k]) => [i, k, j]) : second)];
  return { points, faces, flat: [s, 0, c], half: [Math.sin((degrees * Math.PI) / 360), 0, Math.cos((degrees * Math.PI) / 360)] };
}

for (const turned of [false, true]) {
  test(`gentle bends are smooth and sharp ones crisp${turned ? ', of faces wound against each other, too' : ''}`, () => {
    const side = turned ? -1 : 1;
    const gentle = roof(20, turned);
    const smooth = shaded(gentle.points, gentle.faces);
    assert.ok(near(normalOf(smooth, 1), gentle.half), normalOf(smooth, 1).join(' '));
    assert.ok(near(normalOf(smooth, 6).map((x) => side * x), gentle.half), normalOf(smooth, 6).join(' '));
    const sharp = roof(60, turned);
    const crisp = shaded(sharp.points, sharp.faces);
    assert.ok(near(normalOf(crisp, 1), [0, 0, 1]));
    assert.ok(near(normalOf(crisp, 6).map((x) => side * x), sharp.flat));
  });
}

test('the crease is where it is asked for, and 0 leaves every face flat', () => {
  const gentle = roof(20, false);
  assert.ok(near(normalOf(shaded(gentle.points, gentle.faces, false, 0), 1), [0, 0, 1]));
  const sharp = roof(60, false);
  assert.ok(near(normalOf(shaded(sharp.points, sharp.faces, false, 75), 1), sharp.half));
  const slight = roof(5, true);
  const facets = shaded(slight.points, slight.faces, true, 0);
  facets.normalsAt(Float32Array.from(slight.points.flat()));
  assert.ok(near(normalOf(facets, 6).map((x) => -x), slight.flat));
});

test('a row is drawn once where it has one normal', () => {
  const flat = shaded([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]);
  assert.equal(flat.rows.length, 4);
});

test('the hub of a large fan, and faces without area', () => {
  const rim = Array.from({ length: 300 }, (_, i) => [Math.cos((i * Math.PI) / 150), Math.sin((i * Math.PI) / 150), 0.9]);
  const faces = rim.map((_, i) => [0, 1 + i, 1 + ((i + 1) % 300)]);
  const fan = shaded([[0, 0, 1], ...rim], [...faces, [0, 1, 1]]);
  for (let i = 0; i < 300; i += 1) {
    assert.ok(near(normalOf(fan, 3 * i), [0, 0, 1]), normalOf(fan, 3 * i).join(' '));
  }
  assert.ok(normalOf(fan, 900).every(Number.isFinite));
});

test('normals follow where the vertices move', () => {
  const { points, faces } = roof(0, true);
  const moved = shaded(points, faces, true);
  const tilted = Float32Array.from(points.flatMap(([x, y]) => [x, y, x]));
  moved.normalsAt(tilted);
  assert.ok(near(normalOf(moved, 0), [-Math.SQRT1_2, 0, Math.SQRT1_2]));
  assert.ok(near(normalOf(moved, 6), [Math.SQRT1_2, 0, -Math.SQRT1_2])); // of the faces wound the other way
});

test('a surface that is wound any way has one outside', () => {
  const { points, faces } = roof(20, true);
  const outward = outwardNormals(shaded(points, faces, true));
  for (let i = 5; i < outward.length; i += 3) {
    assert.ok(outward[i] * outward[2] > 0, outward.join(' '));
  }
});
