// SPDX-License-Identifier: MIT
import { asBytes, readData } from './decode.js';
import { ModelView } from './model_view.js';
import * as panel from './panel.js';
import { replayRapid } from './rapid_replay.js';
import { ScoreSphere } from './score_sphere.js';

const element = (id) => document.getElementById(id);
const PLAY_LEVELS_PER_S = 1.5;

const data = readData();
const { view } = data;
panel.fillHeader(view);
panel.fillNumbers(data);
panel.fillWarnings(data.warnings);
panel.fillLegend(asBytes(data.colours));
const showCamera = panel.fillCameras(data.views);

const sphere = new ScoreSphere(element('sphere'), data, (direction) => {
  // The distance and the lens of the scoring camera: the whole model is in the picture.
  press('');
  model.fly({ ...data.lens, eye: direction.clone().multiplyScalar(data.lens.distance).toArray(),
    up: data.up, target: [0, 0, 0] });
});
let model; // the first report of a direction comes from its constructor
model = new ModelView(element('model'), data, (direction, up) => {
  sphere.turn(direction, up);
  panel.showDirection(direction, sphere.scoreAt(direction), view.total);
});
const press = panel.fillViews(data.views, (picked) => {
  press(picked.name);
  showCamera(picked);
  model.fly(picked);
});
press(data.views[0].name);
model.moved();

element('show-map').addEventListener('change', (event) => model.showMap(event.target.checked));
element('show-skeleton').addEventListener('change', (event) => model.showSkeleton(event.target.checked));

// The contraction's history.
const slider = element('level');
slider.max = String(data.history.levels.length - 1);
function setLevel(level) {
  slider.value = String(level);
  element('level-text').textContent = Number(level).toFixed(1);
  model.setLevel(Number(level));
}
slider.addEventListener('input', () => setLevel(slider.value));
let playing;
function play() {
  if (playing) {
    cancelAnimationFrame(playing);
    playing = undefined;
    element('play').textContent = '▶';
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
      play();
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
  sphere.showPath(result.path.map((step) => step.direction));
  panel.showReplay(result, view[goal].score);
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
replay(false);

// The round over all views, again and again until something else is asked for.
const TOUR_DEG_PER_S = 36;
if (data.tour) {
  const { degrees, poses } = data.tour;
  element('tour-text').textContent = `${Math.round(degrees)}° over ${data.views.length - 1} views`;
  element('tour').addEventListener('click', () => {
    const button = element('tour');
    if (model.touring) {
      model.stop();
      return;
    }
    press('');
    model.fly(poses[0], () => {
      button.textContent = '❚❚ Tour';
      model.tour(poses, (degrees / TOUR_DEG_PER_S) * 1000, () => { button.textContent = '▶ Tour'; });
    });
  });
} else {
  element('tour-box').remove();
}

// Light and dark.
function setTheme(dark) {
  document.documentElement.dataset.theme = dark ? 'dark' : 'light';
  model.draw();
}
setTheme(matchMedia('(prefers-color-scheme: dark)').matches);
const toggleTheme = () => setTheme(document.documentElement.dataset.theme !== 'dark');
element('theme').addEventListener('click', toggleTheme);

const toggle = (id) => element(id).click();
document.addEventListener('keydown', (event) => {
  if (['INPUT', 'SELECT', 'TEXTAREA', 'BUTTON'].includes(event.target.tagName) || event.ctrlKey || event.metaKey) {
    return;
  }
  const digit = Number(event.key);
  if (digit >= 1 && digit <= data.views.length) {
    document.querySelectorAll('.view')[digit - 1].click();
  } else if (event.key === ' ') {
    event.preventDefault();
    play();
  } else {
    ({ t: () => element('tour')?.click(), d: toggleTheme, k: () => toggle('show-map'), s: () => toggle('show-skeleton') })[event.key]?.();
  }
});

// For tests: what is shown, in numbers.
window.vantage = { model, sphere, data };
requestAnimationFrame(() => requestAnimationFrame(() => { document.documentElement.dataset.ready = 'yes'; }));
