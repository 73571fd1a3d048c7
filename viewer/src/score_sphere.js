// SPDX-License-Identifier: MIT
// The view sphere as a heat map: coloured and raised by the objective or the score of every direction.
import * as THREE from 'three';
import { asBytes } from './decode.js';

const RAISE = 0.25; // of the radius, for the best score
const SIZE = 170; // px
const PATH_PIECES = 8;
const LEAST_SHOWN = 1e-4; // of the largest objective
const MARKS = { best: 0x1a9641, worst: 0xd7191c, other: 0x8a8f98 };

/** Values as shares of their range. */
function linear(values) {
  const low = Math.min(...values);
  const span = Math.max(...values) - low || 1;
  return values.map((value) => (value - low) / span);
}

/** A likelihood has one peak; by its logarithm the rest can be told apart. */
function logarithmic(values) {
  const floor = Math.max(...values) * LEAST_SHOWN;
  return floor > 0 ? linear(values.map((value) => Math.log(Math.max(value, floor)))) : linear(values);
}

export class ScoreSphere {
  constructor(canvas, data, onPick) {
    this.data = data;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(SIZE, SIZE, false);
    this.scene = new THREE.Scene();
    this.camera = new THREE.OrthographicCamera(-1.4, 1.4, 1.4, -1.4, 0.1, 10);
    this.hasObjective = data.sphere.objective.length > 0;
    this.table = asBytes(data.colours);
    this.show(this.hasObjective ? 'objective' : 'score');
    for (const view of data.views) {
      this.scene.add(this.mark(view.direction, MARKS[view.name] ?? MARKS.other, 0.06));
    }
    this.here = this.mark([0, 0, 1], 0xffffff, 0.045);
    this.scene.add(this.here);
    canvas.addEventListener('click', (event) => {
      const direction = this.pick(event);
      if (direction) {
        onPick(direction);
      }
    });
  }

  /** @param what 'objective', what the best view maximises, or 'score'. */
  show(what) {
    const { directions, triangles, scores, objective } = this.data.sphere;
    const values = what === 'objective' ? objective : scores;
    this.heights = what === 'objective' ? logarithmic(values) : linear(values);
    const positions = new Float32Array(3 * directions.length);
    const rgb = new Float32Array(3 * directions.length);
    const { table } = this;
    directions.forEach((d, i) => {
      new THREE.Vector3(...d).multiplyScalar(1 + RAISE * this.heights[i]).toArray(positions, 3 * i);
      const c = 3 * Math.round(255 * this.heights[i]);
      new THREE.Color().setRGB(table[c] / 255, table[c + 1] / 255, table[c + 2] / 255, THREE.SRGBColorSpace).toArray(rgb, 3 * i);
    });
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(rgb, 3));
    geometry.setIndex(triangles.flat());
    if (this.mesh) {
      this.scene.remove(this.mesh);
      this.mesh.geometry.dispose();
    }
    this.mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ vertexColors: true }));
    this.scene.add(this.mesh);
    this.shown = what;
    this.draw();
  }

  mark(direction, colour, radius) {
    const ball = new THREE.Mesh(new THREE.SphereGeometry(radius, 16, 12), new THREE.MeshBasicMaterial({ color: colour }));
    ball.position.set(...direction).multiplyScalar(1 + RAISE);
    return ball;
  }

  /** Turns so that the direction of the model's eye faces the reader. */
  turn(direction, up) {
    this.here.position.copy(direction).multiplyScalar(1 + RAISE);
    this.camera.up.copy(up);
    this.camera.position.copy(direction).multiplyScalar(4);
    this.camera.lookAt(0, 0, 0);
    this.draw();
  }

  /** Line through the directions that the replayed search stood at. */
  showPath(directions) {
    if (this.path) {
      this.scene.remove(this.path);
      this.path.geometry.dispose();
    }
    // Along great circles above the highest place, so that no part of the way is hidden.
    const stops = directions.map((d) => new THREE.Vector3(...d));
    const points = stops.flatMap((d, i) => (i === 0 ? [d] : Array.from({ length: PATH_PIECES }, (_, k) =>
      stops[i - 1].clone().lerp(d, (k + 1) / PATH_PIECES)))).map((d) => d.setLength(1.01 + RAISE));
    this.path = new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), new THREE.LineBasicMaterial({ color: 0x777777 }));
    this.scene.add(this.path);
    this.draw();
  }

  pick(event) {
    const box = event.target.getBoundingClientRect();
    const point = new THREE.Vector2(
      ((event.clientX - box.left) / box.width) * 2 - 1,
      1 - ((event.clientY - box.top) / box.height) * 2,
    );
    const ray = new THREE.Raycaster();
    ray.setFromCamera(point, this.camera);
    return ray.intersectObject(this.mesh)[0]?.point.normalize();
  }

  /** Score or objective of any direction, linear in the triangle of the set that it falls in. */
  valueAt(direction, values) {
    const { directions, triangles } = this.data.sphere;
    let found = { inside: -Infinity, value: 0 };
    const corner = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
    for (const triangle of triangles) {
      triangle.forEach((v, k) => corner[k].set(...directions[v]));
      const shares = corner.map((_, k) => corner[(k + 1) % 3].clone().cross(corner[(k + 2) % 3]).dot(direction));
      const inside = Math.min(...shares);
      if (inside > found.inside && corner[0].dot(direction) > 0) {
        const sum = shares[0] + shares[1] + shares[2];
        found = { inside, value: triangle.reduce((s, v, k) => s + (shares[k] / sum) * values[v], 0) };
      }
    }
    return found.value;
  }

  draw() {
    this.pending ??= requestAnimationFrame(() => {
      this.pending = undefined;
      this.renderer.render(this.scene, this.camera);
    });
  }
}
