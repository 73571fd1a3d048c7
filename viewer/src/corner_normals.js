// SPDX-License-Identifier: MIT
// Normals for smooth shading as pictures have them: src/render/corner_normals.h says how and why.
// Surfaces may be wound any way, as those of clouds are, and need not share vertices.
import { gridKeys } from './decode.js';

const cosine = (degrees) => Math.cos((degrees * Math.PI) / 180);
const SOFTNESS_DEG = 10; // an edge turns from smooth to crisp over the crease angle ± so much, as in pictures
const MOST_PAIRS = 64; // of corners at a place: to compare all pairs of more would take long

/** Unit normals of the faces, 0 of those without area, and the weights of corners: angle times area. */
function faceShapes(positions, indices) {
  const normals = new Float32Array(indices.length);
  const weights = new Float32Array(indices.length);
  const sides = new Float64Array(9); // from each corner to the next
  const dot = (a, b) => sides[a] * sides[b] + sides[a + 1] * sides[b + 1] + sides[a + 2] * sides[b + 2];
  for (let f = 0; f < indices.length; f += 3) {
    for (let k = 0; k < 3; k += 1) {
      const from = 3 * indices[f + k];
      const to = 3 * indices[f + ((k + 1) % 3)];
      for (let axis = 0; axis < 3; axis += 1) {
        sides[3 * k + axis] = positions[to + axis] - positions[from + axis];
      }
    }
    const x = sides[1] * sides[5] - sides[2] * sides[4];
    const y = sides[2] * sides[3] - sides[0] * sides[5];
    const z = sides[0] * sides[4] - sides[1] * sides[3];
    const area = Math.sqrt(x * x + y * y + z * z);
    if (area > 0) {
      normals[f] = x / area;
      normals[f + 1] = y / area;
      normals[f + 2] = z / area;
      for (let k = 0; k < 3; k += 1) {
        weights[f + k] = area * Math.atan2(area, -dot(3 * k, 3 * ((k + 2) % 3)));
      }
    }
  }
  return { normals, weights };
}

/** Numbers rows at one position alike. */
function weld(positions) {
  const numbers = new Map();
  const places = gridKeys(positions).map((key) => {
    if (!numbers.has(key)) {
      numbers.set(key, numbers.size);
    }
    return numbers.get(key);
  });
  return { places, count: numbers.size };
}

/** Corners by place, as lists one after the other, ascending. */
function cornersByPlace(indices, places, count) {
  const starts = new Uint32Array(count + 1);
  indices.forEach((row) => { starts[places[row] + 1] += 1; });
  for (let p = 0; p < count; p += 1) {
    starts[p + 1] += starts[p];
  }
  const next = starts.slice();
  const corners = new Uint32Array(indices.length);
  indices.forEach((row, corner) => {
    corners[next[places[row]]] = corner;
    next[places[row]] += 1;
  });
  return { starts, corners };
}

/** The vertices that a surface is drawn with: a row of its positions once for each normal that it has there. */
export class ShadedVertices {
  /** @param creaseDeg edges that bend by more are sharp; 0: every face is flat.
   *  @param isMoved whether normals are asked for again, at other positions. */
  constructor(positions, indices, creaseDeg, isMoved = false) {
    this.indices = indices;
    this.isFlat = creaseDeg === 0;
    const smoothDeg = Math.max(0, creaseDeg - SOFTNESS_DEG);
    this.smooth = cosine(smoothDeg); // up to there a face counts in full
    this.halfSmooth = cosine(smoothDeg / 2);
    this.crisp = cosine(creaseDeg + SOFTNESS_DEG); // from there on it does not
    this.faces = faceShapes(positions, indices);
    this.index = new Uint32Array(indices.length);
    this.rows = [];
    this.sources = isMoved ? [] : undefined; // of each vertex: a corner of its own, then others and their shares
    const normals = [];
    this.welded = weld(positions);
    this.lists = cornersByPlace(indices, this.welded.places, this.welded.count);
    const { starts, corners } = this.lists;
    for (let p = 0; p < this.welded.count; p += 1) {
      this.addPlace(corners.subarray(starts[p], starts[p + 1]), normals);
    }
    this.normals = Float32Array.from(normals);
    if (!isMoved) {
      this.faces = this.lists = undefined;
    }
  }

  cosine(a, b) {
    const { normals } = this.faces;
    const [f, g] = [a - (a % 3), b - (b % 3)];
    return normals[f] * normals[g] + normals[f + 1] * normals[g + 1] + normals[f + 2] * normals[g + 2];
  }

  /** How much a corner's face counts for another's: less than 0 if it is wound the other way. */
  share(a, b) {
    const cos = this.cosine(a, b);
    const t = Math.min(Math.max((Math.abs(cos) - this.crisp) / (this.smooth - this.crisp), 0), 1);
    return Math.sign(cos) * t * t * (3 - 2 * t);
  }

  /** How much each of the corners counts for the first. */
  shares(first, corners) {
    const shares = new Array(corners.length);
    for (let i = 0; i < corners.length; i += 1) {
      shares[i] = this.share(first, corners[i]);
    }
    return shares;
  }

  addPlace(corners, normals) {
    const { weights } = this.faces;
    const solid = [];
    let isSmooth = true;
    for (let i = 0; i < corners.length; i += 1) {
      const c = corners[i];
      if (weights[c] > 0 && !this.isFlat) {
        solid.push(c);
        isSmooth &&= Math.abs(this.cosine(solid[0], c)) >= this.halfSmooth;
      } else {
        this.addVertex(c, [], [], normals);
      }
    }
    if (isSmooth) {
      this.addGroup(solid, normals);
    } else if (solid.length <= MOST_PAIRS) {
      for (let i = 0; i < solid.length; i += 1) {
        this.addVertex(solid[i], solid, this.shares(solid[i], solid), normals);
      }
    } else {
      const groups = [];
      solid.forEach((c) => {
        const group = groups.find(([leader]) => this.share(leader, c) !== 0);
        if (group) {
          group.push(c);
        } else {
          groups.push([c]);
        }
      });
      groups.forEach((group) => this.addGroup(group, normals));
    }
  }

  /** Corners that have one normal, turned for those wound the other way than the first. */
  addGroup(corners, normals) {
    const shares = this.shares(corners[0], corners);
    const vertices = new Map(); // by row and side
    corners.forEach((c, i) => {
      const key = 2 * this.indices[c] + (shares[i] < 0 ? 1 : 0);
      if (!vertices.has(key)) {
        vertices.set(key, this.rows.length);
        this.addVertex(c, corners, shares[i] < 0 ? shares.map((share) => -share) : shares, normals);
      }
      this.index[c] = vertices.get(key);
    });
  }

  addVertex(own, corners, shares, normals) {
    this.index[own] = this.rows.length;
    this.rows.push(this.indices[own]);
    this.sources?.push({ own, corners, shares });
    const normal = this.sum(own, corners, shares);
    normals.push(normal[0], normal[1], normal[2]);
  }

  /** The unit normal of a vertex; that of the corner's own face if there is no other. */
  sum(own, corners, shares) {
    const { normals, weights } = this.faces;
    let [x, y, z] = [0, 0, 0];
    for (let i = 0; i < corners.length; i += 1) {
      const c = corners[i];
      const f = c - (c % 3);
      const weight = shares[i] * weights[c];
      x += weight * normals[f];
      y += weight * normals[f + 1];
      z += weight * normals[f + 2];
    }
    const length = Math.sqrt(x * x + y * y + z * z);
    const f = own - (own % 3);
    return length > 0 ? [x / length, y / length, z / length] : normals.subarray(f, f + 3);
  }

  /** The vertices' normals where the rows have moved to. */
  normalsAt(positions) {
    this.faces = faceShapes(positions, this.indices);
    this.sources.forEach(({ own, corners, shares }, i) => this.normals.set(this.sum(own, corners, shares), 3 * i));
    return this.normals;
  }

  /** Numbers of rows, `size` each, for the vertices. */
  spread(values, size) {
    const result = new values.constructor(size * this.rows.length);
    this.rows.forEach((row, i) => {
      for (let k = 0; k < size; k += 1) {
        result[size * i + k] = values[size * row + k];
      }
    });
    return result;
  }
}

/** Whether no two faces run along an edge the same way. */
function isWoundAlike(indices, places) {
  const seen = new Set();
  return indices.every((row, corner) => {
    const next = places[indices[corner % 3 === 2 ? corner - 2 : corner + 1]];
    const edge = places[row] * 2 ** 26 + next;
    const isNew = !seen.has(edge);
    seen.add(edge);
    return isNew;
  });
}

/** A normal of each place. Where faces are wound any way, neighbours' are turned alike. */
export function outwardNormals({ indices, faces, welded, lists }) {
  const { places, count } = welded;
  const alike = isWoundAlike(indices, places);
  const outward = new Float32Array(3 * count);
  const dot = (a, i, b, j) => a[i] * b[j] + a[i + 1] * b[j + 1] + a[i + 2] * b[j + 2];
  const cornersAt = (place) => lists.corners.subarray(lists.starts[place], lists.starts[place + 1]);
  const faceOf = (corner) => corner - (corner % 3);
  for (let p = 0; p < count; p += 1) {
    const corners = cornersAt(p);
    corners.forEach((c) => {
      const turned = !alike && dot(faces.normals, faceOf(corners[0]), faces.normals, faceOf(c)) < 0;
      for (let axis = 0; axis < 3; axis += 1) {
        outward[3 * p + axis] += (turned ? -1 : 1) * faces.weights[c] * faces.normals[faceOf(c) + axis];
      }
    });
    const length = Math.hypot(...outward.subarray(3 * p, 3 * p + 3)) || 1;
    for (let axis = 0; axis < 3; axis += 1) {
      outward[3 * p + axis] /= length;
    }
  }
  const isReached = new Uint8Array(count).fill(alike ? 1 : 0);
  for (let seed = 0; seed < count; seed += 1) {
    const queue = isReached[seed] ? [] : [seed];
    isReached[seed] = 1;
    for (const p of queue) { // which grows
      const neighbours = Array.from(cornersAt(p), faceOf).flatMap((f) => [f, f + 1, f + 2]).map((c) => places[indices[c]]);
      for (const q of neighbours.filter((place) => !isReached[place])) {
        if (!isReached[q]) {
          isReached[q] = 1;
          queue.push(q);
          if (dot(outward, 3 * p, outward, 3 * q) < 0) {
            [0, 1, 2].forEach((axis) => { outward[3 * q + axis] *= -1; });
          }
        }
      }
    }
  }
  return outward;
}
