// SPDX-License-Identifier: MIT
import * as THREE from 'three';
import { ShadedVertices } from './corner_normals.js';

/** A surface with its normals.
 *  @param creaseDeg of pictures.
 *  @param values of rows: `significance`, or `uv` and `color`.
 *  @param isMoved whether its vertices move. */
export function surface(positions, indices, creaseDeg, { significance, uv, color }, isMoved = false) {
  const vertices = new ShadedVertices(positions, indices, creaseDeg, isMoved);
  const geometry = new THREE.BufferGeometry();
  const add = (name, values, size) => geometry.setAttribute(name, new THREE.BufferAttribute(values, size));
  add('position', vertices.spread(positions, 3), 3);
  add('normal', vertices.normals.slice(), 3);
  if (significance) { // as places in the legend's colours
    const places = new Float32Array(2 * vertices.rows.length).fill(0.5);
    vertices.rows.forEach((row, v) => { places[2 * v] = (significance[row] + 0.5) / 256; });
    add('uv', places, 2);
  }
  if (uv) {
    add('uv', vertices.spread(uv, 2), 2);
  }
  if (color) {
    add('color', vertices.spread(color, 3), 3);
  }
  geometry.setIndex(new THREE.BufferAttribute(vertices.index, 1));
  return { geometry, vertices };
}
