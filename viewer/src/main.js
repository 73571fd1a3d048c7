// SPDX-License-Identifier: MIT
import { Vector3 } from 'three';

import { asBytes, readData } from './decode.js';
import { ModelView } from './model_view.js';
import * as panel from './panel.js';
import { replayRapid } from './rapid_replay.js';
import { ScoreSphere } from './score_sphere.js';

const element = (id) => document.getElementById(id);
const PLAY_LEVELS_PER_S = 1.5;
const SPACING_RAD = 0.14; // of the directions of the sphere
const SAME_RAD = 1e-4; // an eye in 32-bit floats is a view's own

const data = readData();
const { view } = data;
panel.fillHeader(view);
panel.fillNumbers(data);
panel.fillWarnings(data.warnings);
panel.fillLegend(asBytes(data.colours));
const showCamera = panel.fillCameras(data);
const press = panel.fillViews(data.views, pick);

/** Looks at the whole model with the distance and the lens of the scoring camera. */
function lookFrom(direction) {
  press('');
  model.fly({ ...data.lens, eye: direction.clone().multiplyScalar(data.lens.distance).toArray(),
    up: data.up, target: [0, 0, 0] });
}
/** The value there, from those of the sphere; near a view that is known, towards its own. */
const valueNear = (direction, values, { angle, value }) => {
  const share = Math.min(1, angle / SPACING_RAD);
  return (1 - share) * value + share * sphere.valueAt(direction, values);
};
let traced = []; // where the replayed search stood; of large models its scores are estimates
/** Of the views that are shown and those traced, the nearest. */
const nearestKnown = (direction) => {
  const known = [...data.views, ...traced].map((of) => ({
    angle: direction.angleTo(new Vector3(...of.direction)), value: of.score, isExact: data.views.includes(of) }));
  return known.reduce((a, b) => (b.angle < a.angle ? b : a));
};
const bestEye = new Vector3(...view.best.direction);

function showDirection(direction, up) {
  sphere.turn(direction, up);
  const { scores, objective } = data.sphere;
  const near = nearestKnown(direction);
  const score = near.angle < SAME_RAD ? near : { value: valueNear(direction, scores, near) };
  const best = { angle: direction.angleTo(bestEye), value: view.best.objective };
  panel.showDirection(direction, score, view.total,
    sphere.hasObjective && best.value > 0 ? valueNear(direction, objective, best) / best.value : undefined);
}
let sphere;
let model; // undefined where the browser draws nothing in 3D: the pictures are shown in its place
try {
  sphere = new ScoreSphere(element('sphere'), data, lookFrom);
  model = new ModelView(element('model'), data, showDirection, () => press(''));
} catch (error) {
  console.error(error);
  document.documentElement.dataset.shows = 'pictures';
}
function pick(picked) {
  press(picked.name);
  showCamera(picked);
  if (model) {
    model.fly(picked);
  } else {
    element('still').src = picked.picture;
  }
}
if (model) {
  press(data.views[0].name);
  model.moved();
} else {
  pick(data.views[0]);
}

// The analysis comes and goes as one: colours, their legend, and the skeleton and the contraction they come from.
function showAnalysis(on) {
  element('show-map').checked = on;
  element('analysis').hidden = !on;
  element('legend').hidden = !on;
  model.showMap(on);
  showSkeleton(on && element('show-skeleton').checked);
  if (!on) {
    pause();
    setLevel(0);
  }
}
function showSkeleton(on) {
  element('show-skeleton').checked = on;
  model.showSkeleton(on);
}
element('show-map').addEventListener('change', (event) => showAnalysis(event.target.checked));
element('show-skeleton').addEventListener('change', (event) => showSkeleton(event.target.checked));

// What the best view maximises, and the score, on the sphere.
if (sphere?.hasObjective) {
  showOnSphere('objective');
} else {
  element('sphere-of').remove();
}
function showOnSphere(what) {
  document.querySelector(`input[name=sphere][value=${what}]`).checked = true;
  sphere.show(what);
  element('sphere').setAttribute('aria-label',
    `Every direction by ${what === 'score' ? 'its score' : 'what the best view maximises'}; click to look from there, or turn the model by arrow keys`);
}
for (const input of document.querySelectorAll('input[name=sphere]')) {
  input.addEventListener('change', () => showOnSphere(input.value));
}

/** All as it was when the page was opened. */
function reset() {
  showSkeleton(false);
  showAnalysis(false);
  if (sphere.hasObjective) {
    showOnSphere('objective');
  }
  for (const input of document.querySelectorAll('input[name=goal], #epsilon')) {
    input.checked = input.defaultChecked;
    input.value = input.defaultValue;
  }
  replay(false);
  press(data.views[0].name);
  element('format').selectedIndex = 0;
  showCamera(data.views[0]);
  model.fly(data.views[0]);
}
element('reset').addEventListener('click', reset);
const savePicture = () => panel.save(`${view.model.name}.png`, model.picture());
element('save-picture').addEventListener('click', savePicture);

// The contraction's history.
const slider = element('level');
slider.max = String(data.history.levels.length - 1);
function setLevel(level) {
  slider.value = String(level);
  element('level-text').textContent = Number(level).toFixed(1);
  model.setLevel(Number(level));
}
slider.addEventListener('input', () => {
  pause();
  setLevel(slider.value);
});
let playing;
function pause() {
  cancelAnimationFrame(playing);
  playing = undefined;
  element('play').textContent = '▶';
}
function play() {
  if (playing) {
    pause();
    return;
  }
  element('play').textContent = '❚❚';
  let last = performance.now();
  if (Number(slider.value) >= Number(slider.max)) {
    setLevel(0);
  }
  const step = (now) => {
    const next = Number(slider.value) + ((now - last) / 1000) * PLAY_LEVELS_PER_S;
    last = now;
    setLevel(Math.min(next, Number(slider.max)));
    playing = requestAnimationFrame(step);
    if (next >= Number(slider.max)) {
      pause();
    }
  };
  playing = requestAnimationFrame(step);
}
element('play').addEventListener('click', play);

// The rapid search.
function replay(flying) {
  const goal = document.querySelector('input[name=goal]:checked').value;
  const epsilon = 10 ** Number(element('epsilon').value);
  element('epsilon-text').textContent = Number(epsilon.toPrecision(2)).toString();
  const result = replayRapid(data.rapid[goal], goal, epsilon);
  traced = result.path;
  sphere.showPath(result.path.map((step) => step.direction));
  // The search replayed looks for scores alone, whatever the best view maximises.
  panel.showReplay(result, ...(goal === 'best' ? ['highest', view.highest_score.score] : ['least', view.worst.score]));
  if (!flying) {
    return;
  }
  press('');
  const stops = result.path.map((step) => ({ ...data.lens, up: data.up, target: [0, 0, 0],
    eye: step.direction.map((x) => x * data.lens.distance) }));
  const next = () => {
    const stop = stops.shift();
    if (stop) {
      model.fly(stop, next);
    }
  };
  next();
}
for (const input of document.querySelectorAll('input[name=goal], #epsilon')) {
  input.addEventListener('input', () => replay(false));
}
element('replay').addEventListener('click', () => replay(true));
if (model) {
  replay(false);
}

// The round over all views, again and again until something else is asked for.
const TOUR_DEG_PER_S = 36;
if (data.tour) {
  const { degrees, views, poses } = data.tour;
  element('tour-text').textContent = `${Math.round(degrees)}° over ${views} views`;
  // The poses nearest to the views that are shown, in their order on the way: where motion is unwelcome, these alone.
  const stops = data.views.filter(({ name }) => name !== 'worst').map((of) => {
    const angles = poses.map(({ eye, target }) => new Vector3(...eye).sub(new Vector3(...target)).angleTo(new Vector3(...of.direction)));
    return angles.indexOf(Math.min(...angles));
  }).sort((a, b) => a - b);
  element('tour').addEventListener('click', () => {
    const button = element('tour');
    if (model.touring) {
      model.stop();
      return;
    }
    press('');
    button.textContent = '❚❚ Tour';
    model.tour(poses, stops, (degrees / TOUR_DEG_PER_S) * 1000, () => { button.textContent = '▶ Tour'; });
  });
} else {
  element('tour-box').remove();
}

// Light and dark.
function setTheme(dark) {
  document.documentElement.dataset.theme = dark ? 'dark' : 'light';
  model?.draw();
}
const scheme = matchMedia('(prefers-color-scheme: dark)');
const followSystem = () => setTheme(scheme.matches);
followSystem();
scheme.addEventListener('change', followSystem);
function toggleTheme() {
  scheme.removeEventListener('change', followSystem); // the reader has chosen
  setTheme(document.documentElement.dataset.theme !== 'dark');
}
element('theme').addEventListener('click', toggleTheme);

const toggle = (id) => element(id).click();
const KEYS = {
  t: () => element('tour')?.click(),
  d: toggleTheme,
  k: () => toggle('show-map'),
  s: () => { // the skeleton is a part of the analysis
    const on = !element('show-skeleton').checked;
    showAnalysis(true);
    showSkeleton(on);
  },
  o: () => sphere.hasObjective && showOnSphere(sphere.shown === 'score' ? 'objective' : 'score'),
  p: savePicture,
  r: reset,
};
document.addEventListener('keydown', (event) => {
  const { tagName, type } = event.target;
  const isPressed = event.key === ' ' && (tagName === 'BUTTON' || ['checkbox', 'radio'].includes(type));
  if (tagName === 'SELECT' || isPressed || event.ctrlKey || event.metaKey || event.altKey) {
    return;
  }
  const picked = data.views.find(({ name }) => panel.keyOf(name) === event.key);
  if (picked) {
    pick(picked);
    return;
  }
  if (!model && event.key !== 'd') {
    return;
  }
  const ownArrows = ['range', 'radio', 'textarea'].includes(type); // which move by them, too
  if (!ownArrows && model?.moveByKey(event.key)) {
    event.preventDefault();
    return;
  }
  if (event.key === ' ') {
    event.preventDefault();
    showAnalysis(true);
    play();
  } else {
    KEYS[event.key]?.();
  }
});

// For tests: what is shown, in numbers.
window.vantage = { model, sphere, data };
requestAnimationFrame(() => requestAnimationFrame(() => { document.documentElement.dataset.ready = 'yes'; }));
