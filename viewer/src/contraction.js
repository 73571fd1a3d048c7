// SPDX-License-Identifier: MIT
// The surface as it is contracted, at any level and between two.
import * as THREE from 'three';
import { outwardNormals } from './corner_normals.js';
import { asBytes, asIndices, asPositions } from './decode.js';
import { surface } from './surface.js';

// Contracted surfaces are drawn thicker by so much on all sides, lest limbs that have become lines vanish.
const THICKENING = 0.006;

export class Contraction {
  constructor(part, creaseDeg, material) {
    this.levels = part.levels.map(asPositions);
    this.shown = this.levels[0].slice(); // of rows
    const { geometry, vertices } = surface(this.shown, asIndices(part.indices), creaseDeg, { significance: asBytes(part.significance) }, true);
    this.vertices = vertices;
    this.outward = outwardNormals(vertices);
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.visible = false;
  }

  /** @param level between two levels the positions are mixed. */
  show(level) {
    const { levels, shown, outward, vertices } = this;
    const thickness = THICKENING * Math.min(1, level);
    const low = Math.min(Math.floor(level), levels.length - 1);
    const high = Math.min(low + 1, levels.length - 1);
    const share = level - low;
    for (let i = 0; i < shown.length; i += 1) {
      const normal = outward[3 * vertices.welded.places[Math.floor(i / 3)] + (i % 3)];
      shown[i] = levels[low][i] * (1 - share) + levels[high][i] * share + thickness * normal;
    }
    const { position, normal } = this.mesh.geometry.attributes;
    position.array.set(vertices.spread(shown, 3));
    normal.array.set(vertices.normalsAt(shown));
    position.needsUpdate = normal.needsUpdate = true;
    this.mesh.geometry.computeBoundingSphere();
  }
}
