// SPDX-License-Identifier: MIT
// The model, its significance, its skeleton and its contraction, in one three.js scene.
// Lengths are in radii of the enclosing sphere, around its centre.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Contraction } from './contraction.js';
import { asBytes, asIndices, asPositions } from './decode.js';
import { surface } from './surface.js';

const PLAIN = new THREE.Color(0xc4c0ba);
const BONE = new THREE.Color(0xc81e28);
const FLIGHT_MS = 700;
const KEY_STEP_RAD = Math.PI / 36;
const KEY_ZOOM = 1.1;
// Half of what is seen at most and at least, in radii, where lines of sight are parallel.
const MOST_HALF = 10;
const LEAST_HALF = 0.02;
const POLE_RAD = 0.01; // keys turn the eye no nearer to the axis, where it would look from the other side
// All that is drawn lies within so many radii of the centre.
const REACH = 1.5;

/** Half of what a view shows at a distance of one: by its angle, or its height where lines of sight are parallel. */
const halfHeight = (view) => (view.height === undefined ? Math.tan((view.fov_y_deg * Math.PI) / 360) : view.height / 2);
const wantsNoMotion = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

/** The legend's colours, looked up after values are mixed within a face: none has a colour that the legend has not. */
function palette(table) {
  const rgba = new Uint8Array(4 * 256).fill(255);
  for (let i = 0; i < 256; i += 1) {
    rgba.set(table.subarray(3 * i, 3 * i + 3), 4 * i);
  }
  const texture = new THREE.DataTexture(rgba, 256, 1);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Dark colours as pictures show them (lifted_from_black in src/render): on black nothing tells the shape. */
function liftFromBlack(shader) {
  const own = '#include <color_fragment>';
  const lift = `
    float own = max(max(diffuseColor.r, diffuseColor.g), diffuseColor.b);
    float brightest = max(own, 0.03 + 0.5 * own);
    float gain = min(3.0, brightest / max(own, 1e-6));
    diffuseColor.rgb = gain * diffuseColor.rgb + (brightest - gain * own);`;
  shader.fragmentShader = shader.fragmentShader.replace(own, `${own}\n${lift}`);
}

export class ModelView {
  /** @param onMove called with the unit direction to the eye and the up vector whenever the camera has moved.
   *  @param onLeave called when the reader has left the view that was flown to. */
  constructor(canvas, data, onMove, onLeave) {
    this.canvas = canvas;
    this.onMove = onMove;
    this.onLeave = onLeave;
    this.up = new THREE.Vector3(...data.up);
    this.scene = new THREE.Scene();
    this.aspect = 1; // of the window
    this.camera = data.lens.height === undefined ? new THREE.PerspectiveCamera() : new THREE.OrthographicCamera();
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.addLights();
    this.addSurface(data);
    if (data.asset) {
      this.addAsset(data.asset, data.crease_deg);
    }
    this.history = new Contraction(data.history, data.crease_deg, this.material);
    this.scene.add(this.history.mesh);
    this.addSkeleton(data.skeleton);
    this.level = 0;
    this.look(data.views[0]);
    this.showMap(false);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  addLights() {
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8f98, 1.6));
    // Fixed to the camera, so that no view is dark.
    const key = new THREE.DirectionalLight(0xffffff, 1.9);
    key.position.set(-0.6, 1.2, 1.6);
    this.camera.add(key);
    this.scene.add(this.camera);
  }

  addSurface(data) {
    this.palette = palette(asBytes(data.colours));
    const { mesh, crease_deg: creaseDeg } = data;
    const { geometry } = surface(asPositions(mesh.positions), asIndices(mesh.indices), creaseDeg,
      { significance: asBytes(mesh.significance) });
    this.material = new THREE.MeshStandardMaterial({ map: this.palette, roughness: 0.75, side: THREE.DoubleSide });
    this.mesh = new THREE.Mesh(geometry, this.material);
    this.scene.add(this.mesh);
  }

  /** The file's own faces in its materials. */
  addAsset(asset, creaseDeg) {
    const values = {};
    if (asset.uvs) {
      values.uv = new Float32Array(asBytes(asset.uvs).buffer);
    }
    if (asset.colours) {
      const bytes = asBytes(asset.colours);
      values.color = new Float32Array(bytes.length);
      for (let i = 0; i < bytes.length; i += 3) {
        new THREE.Color().setRGB(bytes[i] / 255, bytes[i + 1] / 255, bytes[i + 2] / 255, THREE.SRGBColorSpace).toArray(values.color, i);
      }
    }
    const { geometry } = surface(asPositions(asset.positions), asIndices(asset.indices), creaseDeg, values);
    const textures = asset.textures.map((texture) => this.texture(texture));
    const materials = asset.groups.map((group, i) => {
      geometry.addGroup(group.start, group.count, i);
      return this.assetMaterial(group, textures, Boolean(asset.colours));
    });
    this.asset = new THREE.Mesh(geometry, materials);
    this.scene.add(this.asset);
  }

  texture({ picture, wrap, nearest }) {
    const wraps = { repeat: THREE.RepeatWrapping, mirror: THREE.MirroredRepeatWrapping, clamp: THREE.ClampToEdgeWrapping };
    this.loading = (this.loading ?? 0) + 1;
    const done = () => {
      this.loading -= 1;
      this.draw();
    };
    const texture = new THREE.TextureLoader().load(picture, done, undefined, done);
    texture.colorSpace = THREE.SRGBColorSpace;
    texture.flipY = false; // (0, 0) is the top left corner
    [texture.wrapS, texture.wrapT] = wrap.map((name) => wraps[name]);
    texture.anisotropy = 4;
    if (nearest) {
      texture.magFilter = THREE.NearestFilter;
    }
    return texture;
  }

  assetMaterial({ colour, texture, emission, emission_texture: glow, opacity, cutoff, unlit }, textures, coloured) {
    const options = { color: colour ? new THREE.Color().setRGB(...colour, THREE.LinearSRGBColorSpace) : coloured ? 0xffffff : PLAIN,
      vertexColors: coloured, side: THREE.DoubleSide, map: textures[texture] ?? null };
    if (cutoff !== undefined) {
      options.alphaTest = Math.max(cutoff, 1e-3);
      options.opacity = opacity;
    } else if (opacity !== undefined) {
      Object.assign(options, { transparent: true, opacity, depthWrite: opacity === 1 });
    }
    if (unlit) {
      return new THREE.MeshBasicMaterial(options);
    }
    const emissive = new THREE.Color().setRGB(...(emission ?? [0, 0, 0]), THREE.LinearSRGBColorSpace);
    const material = new THREE.MeshStandardMaterial({ ...options, roughness: 0.75, emissive, emissiveMap: textures[glow] ?? null });
    material.onBeforeCompile = liftFromBlack;
    return material;
  }

  addSkeleton({ nodes, edges }) {
    const group = new THREE.Group();
    const material = new THREE.MeshStandardMaterial({ color: BONE, roughness: 0.6 });
    const ball = new THREE.SphereGeometry(0.013, 12, 8);
    const tube = new THREE.CylinderGeometry(0.008, 0.008, 1, 10);
    const points = nodes.map((p) => new THREE.Vector3(...p));
    const balls = new THREE.InstancedMesh(ball, material, points.length);
    points.forEach((p, i) => balls.setMatrixAt(i, new THREE.Matrix4().setPosition(p)));
    const tubes = new THREE.InstancedMesh(tube, material, edges.length);
    const along = new THREE.Vector3(0, 1, 0);
    edges.forEach(([a, b], i) => {
      const axis = points[b].clone().sub(points[a]);
      const turn = new THREE.Quaternion().setFromUnitVectors(along, axis.clone().normalize());
      const middle = points[a].clone().lerp(points[b], 0.5);
      tubes.setMatrixAt(i, new THREE.Matrix4().compose(middle, turn, new THREE.Vector3(1, axis.length(), 1)));
    });
    group.add(balls, tubes);
    group.visible = false;
    this.skeleton = group;
    this.scene.add(group);
  }

  showMap(on) {
    this.mapped = on;
    this.material.map = on ? this.palette : null;
    this.material.color = on ? new THREE.Color(1, 1, 1) : PLAIN;
    this.material.needsUpdate = true;
    this.choose();
  }

  showSkeleton(on) {
    this.skeleton.visible = on;
    this.material.transparent = on;
    this.material.opacity = on ? 0.35 : 1;
    this.material.depthWrite = !on;
    this.material.needsUpdate = true;
    this.choose();
  }

  /** Which of the surfaces is seen. */
  choose() {
    const { mesh } = this.history;
    mesh.visible = this.level > 0;
    const own = this.asset && !mesh.visible && !this.mapped && !this.skeleton.visible;
    this.mesh.visible = !mesh.visible && !own;
    if (this.asset) {
      this.asset.visible = own;
    }
    this.draw();
  }

  /** @param level of the contraction. */
  setLevel(level) {
    this.level = level;
    if (level > 0) {
      this.history.show(level);
    }
    this.choose();
  }

  /** Stands at a view's camera at once. */
  look(view) {
    this.flight = undefined;
    this.taken = false;
    this.controls?.dispose();
    this.camera.position.set(...view.eye);
    this.camera.zoom = 1;
    this.setLens(halfHeight(view), view.aspect);
    this.camera.up.copy(this.up); // the controls turn about what is up when they are made
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.camera.up.set(...view.up);
    this.controls.target.set(...view.target);
    this.controls.enablePan = false;
    this.controls.minDistance = 0.2;
    this.controls.maxDistance = Math.max(20, 2 * this.camera.position.length());
    this.controls.addEventListener('start', () => this.take());
    this.controls.addEventListener('change', () => {
      if (this.taken) {
        this.onLeave();
      }
      this.moved();
    });
    this.controls.update();
    this.moved();
  }

  /** Leaves the views: from now on the reader turns the model, which stands upright. */
  take() {
    if (this.flight !== undefined) {
      this.onLeave();
    }
    this.stop();
    this.taken = true;
    this.camera.up.copy(this.up);
    this.controls.minZoom = Math.min(0.5, this.half / MOST_HALF);
    this.controls.maxZoom = Math.max(2, this.half / LEAST_HALF);
  }

  /** Flies along the great circle to a view. The reader may take over at any moment: all stands as it is seen then. */
  fly(view, done) {
    this.stop();
    this.taken = false;
    if (wantsNoMotion()) {
      this.look(view);
      done?.();
      return;
    }
    const from = { eye: this.camera.position.clone(), up: this.camera.up.clone(), target: this.controls.target.clone(),
      half: this.half / this.camera.zoom, aspect: this.pictureAspect };
    this.camera.zoom = 1;
    const to = { eye: new THREE.Vector3(...view.eye), up: new THREE.Vector3(...view.up), target: new THREE.Vector3(...view.target),
      half: halfHeight(view), aspect: view.aspect };
    const mix = (a, b, share) => a * (1 - share) + b * share;
    const turn = new THREE.Quaternion().setFromUnitVectors(from.eye.clone().normalize(), to.eye.clone().normalize());
    const start = performance.now();
    const step = (now) => {
      const t = Math.min(1, (now - start) / FLIGHT_MS);
      if (t === 1) {
        this.look(view);
        done?.();
        return;
      }
      const share = t * t * (3 - 2 * t);
      const distance = mix(from.eye.length(), to.eye.length(), share);
      const part = new THREE.Quaternion().slerp(turn, share);
      this.camera.position.copy(from.eye).applyQuaternion(part).setLength(distance);
      this.camera.up.copy(from.up).lerp(to.up, share).normalize();
      this.setLens(mix(from.half, to.half, share), mix(from.aspect, to.aspect, share));
      this.controls.target.copy(from.target).lerp(to.target, share);
      this.camera.lookAt(this.controls.target);
      this.moved();
      this.flight = requestAnimationFrame(step);
    };
    this.flight = requestAnimationFrame(step);
  }

  /** Flies to a closed round of cameras, and along it until it is stopped.
   *  @param stops places in `poses`, ascending, that a reader who wants no motion is shown, one after the other. */
  tour(poses, stops, roundMs, onEnd) {
    this.fly(poses[0], () => this.goRound(poses, stops, roundMs));
    this.touring = onEnd; // from now on, so that the way there can be stopped, too
  }

  goRound(poses, stops, roundMs) {
    const start = performance.now();
    const mix = (a, b, share) => new THREE.Vector3(...a).lerp(new THREE.Vector3(...b), share);
    const step = (now) => {
      const part = ((((now - start) / roundMs) % 1) + 1) % 1;
      const place = wantsNoMotion() ? stops[Math.floor(part * stops.length)] : part * poses.length;
      const from = poses[Math.floor(place) % poses.length];
      const to = poses[(Math.floor(place) + 1) % poses.length];
      const share = place - Math.floor(place);
      const distance = new THREE.Vector3(...from.eye).length();
      this.camera.position.copy(mix(from.eye, to.eye, share)).setLength(distance);
      this.camera.up.copy(mix(from.up, to.up, share)).normalize();
      this.controls.target.copy(mix(from.target, to.target, share));
      this.setLens(halfHeight(from), from.aspect);
      this.camera.lookAt(this.controls.target);
      this.moved();
      this.flight = requestAnimationFrame(step);
    };
    this.flight = requestAnimationFrame(step);
  }

  stop() {
    cancelAnimationFrame(this.flight);
    this.flight = undefined;
    this.touring?.();
    this.touring = undefined;
  }

  /** The picture's lens, widened where the window is narrower than the picture. */
  setLens(halfOfPicture, pictureAspect) {
    this.half = halfOfPicture;
    this.pictureAspect = pictureAspect;
    const half = halfOfPicture * Math.max(1, pictureAspect / this.aspect);
    if (this.camera.isPerspectiveCamera) {
      this.camera.aspect = this.aspect;
      this.camera.fov = (360 / Math.PI) * Math.atan(half);
    } else {
      [this.camera.top, this.camera.bottom] = [half, -half];
      [this.camera.left, this.camera.right] = [-half * this.aspect, half * this.aspect];
    }
    this.camera.updateProjectionMatrix();
  }

  /** Towards the eye: from the centre, or against parallel rays. */
  direction() {
    const eye = this.camera.position.clone();
    return (this.camera.isPerspectiveCamera ? eye : eye.sub(this.controls.target)).normalize();
  }

  /** Turns or zooms, if the key is for that. */
  moveByKey(key) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const zooms = { '+': KEY_ZOOM, '=': KEY_ZOOM, '-': 1 / KEY_ZOOM };
    if (!turns[key] && !zooms[key]) {
      return false;
    }
    this.take();
    this.onLeave();
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (turns[key]) {
      this.turn(offset, ...turns[key].map((steps) => steps * KEY_STEP_RAD));
    } else if (this.camera.isPerspectiveCamera) {
      offset.divideScalar(zooms[key]);
    } else {
      this.camera.zoom = THREE.MathUtils.clamp(this.camera.zoom * zooms[key], this.controls.minZoom, this.controls.maxZoom);
    }
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.moved();
    return true;
  }

  /** Turns an offset of the eye about the vertical, and away from the top. */
  turn(offset, aroundRad, downRad) {
    const right = new THREE.Vector3().crossVectors(this.up, offset);
    if (right.length() < POLE_RAD * offset.length()) {
      right.setFromMatrixColumn(this.camera.matrixWorld, 0);
    }
    right.normalize();
    const tilt = offset.angleTo(this.up);
    const wanted = Math.min(Math.max(tilt + downRad, POLE_RAD), Math.PI - POLE_RAD);
    offset.applyAxisAngle(right, wanted - tilt).applyAxisAngle(this.up, aroundRad);
  }

  /** What the window shows, as a PNG on nothing. */
  picture() {
    this.render();
    return this.canvas.toDataURL('image/png');
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (clientWidth === this.width && clientHeight === this.height) {
      return;
    }
    [this.width, this.height] = [clientWidth, clientHeight];
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.aspect = clientWidth / Math.max(1, clientHeight);
    this.setLens(this.half, this.pictureAspect);
    this.render(); // at once: another size empties the canvas, and the next frame is after this one is shown
  }

  moved() {
    const away = this.camera.position.length();
    this.camera.near = this.camera.isPerspectiveCamera ? Math.max(0.01, away - REACH) : away - REACH;
    this.camera.far = away + REACH;
    this.camera.updateProjectionMatrix();
    this.onMove(this.direction(), this.camera.up);
    this.draw();
  }

  /** At most once a frame, however often it is asked. */
  draw() {
    this.pending ??= requestAnimationFrame(() => {
      this.pending = undefined;
      this.render();
    });
  }

  render() {
    this.renderer.render(this.scene, this.camera);
  }
}
