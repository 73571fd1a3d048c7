// SPDX-License-Identifier: MIT
// The texts beside the model. Everything from the file goes in as text, never as markup.

import { blenderScript } from './camera_texts.js';

const element = (id) => document.getElementById(id);

function make(tag, text, parent) {
  const node = document.createElement(tag);
  node.textContent = text;
  parent.append(node);
  return node;
}

const short = (x) => (Math.abs(x) >= 1000 ? x.toFixed(0) : Number(x.toPrecision(4)).toString());
const counted = (n) => n.toLocaleString('en');
const isCloud = (model) => model.faces === 0;
const percent = (x) => `${(100 * x).toFixed(1)} %`;

export function fillHeader(view) {
  const { model } = view;
  document.title = `${model.name} · Vantage`;
  element('name').textContent = model.name;
  const kind = model.closed ? `closed, genus ${model.genus ?? '–'}` : 'open';
  element('summary').textContent = isCloud(model)
    ? `${counted(model.vertices)} points`
    : `${counted(model.vertices)} vertices · ${counted(model.faces)} faces · ${kind}`;
}

/** The key that picks a view, by its label. */
export const keyOf = (name) => ({ best: '1', worst: 'w' })[name] ?? name;

export function fillViews(views, onPick) {
  const buttons = views.map((view) => {
    const button = document.createElement('button');
    button.className = 'view';
    button.type = 'button';
    button.dataset.view = view.name;
    if (keyOf(view.name).length === 1) {
      button.title = `Key ${keyOf(view.name)}`;
    }
    const picture = document.createElement('img');
    picture.src = view.picture;
    picture.alt = `${view.name} view`;
    button.append(picture);
    make('span', /^\d/.test(view.name) ? `view ${view.name}` : view.name, button);
    make('small', `${short(view.score)} · ${percent(view.score_fraction)}`, button);
    button.addEventListener('click', () => onPick(view));
    element('views').append(button);
    return button;
  });
  return (name) => buttons.forEach((b) => b.setAttribute('aria-pressed', String(b.dataset.view === name)));
}

export function fillNumbers(data) {
  const { view } = data;
  const rows = [
    ['method', `${view.method}, preset ${view.preset}`],
    ['objective', view.objective === 'people' ? 'people: the view a maker of catalogues would take' : view.objective],
    ['best score', `${short(view.best.score)} (${percent(view.best.score_fraction)} of all)`],
    ['worst score', `${short(view.worst.score)} (${percent(view.worst.score_fraction)})`],
    ['search', `${view.search.strategy}, ${view.search.evaluations + view.search.worst_evaluations} views`],
    ['skeleton', `${view.skeleton.nodes} nodes, ${view.skeleton.edges} edges, ${view.skeleton.cycles} cycles`],
    ['contraction', `${view.contraction.levels} levels`],
    ['up axis', view.up],
    ['version', view.vantage],
  ];
  if (isCloud(view.model)) {
    rows.push(['shown here', 'faces made between the points, for display']);
  } else if (data.mesh.faces < view.model.faces) {
    rows.push(['shown here', `${counted(data.mesh.faces)} of ${counted(view.model.faces)} faces, more where significance is high`]);
  }
  for (const [name, value] of rows) {
    const row = document.createElement('tr');
    make('td', name, row);
    make('td', String(value), row);
    element('numbers').append(row);
  }
}

export function fillWarnings(warnings) {
  if (warnings.length === 0) {
    element('warnings-box').remove();
  }
  warnings.forEach((text) => make('li', text, element('warnings')));
}

/** Where the eye is now, what that view scores ({value, isExact}) and, as a share of the best view's, the objective. */
export function showDirection(direction, score, total, objective) {
  const numbers = direction.toArray().map((x) => x.toFixed(3)).join(', ');
  const share = total > 0 ? ` (${percent(score.value / total)})` : '';
  element('direction').textContent = `direction ${numbers}\nscore ${score.isExact ? '' : 'about '}${short(score.value)}${share}`
    + (objective === undefined ? '' : `\nobjective about ${percent(objective)} of the best view's`);
}

export function showReplay({ path, evaluations, levels }, name, found) {
  const last = path[path.length - 1];
  element('replay-text').textContent =
    `${evaluations} views in ${levels} ring${levels === 1 ? '' : 's'}; ends at about ${short(last.score)}, the ${name} found: ${short(found)}`;
}

/** Hands a file to the reader. */
export function save(name, url) {
  const link = document.createElement('a');
  link.download = name;
  link.href = url;
  link.click();
}

const FORMATS = {
  f3d: { name: 'f3d', ending: 'f3d.txt', hint: 'A command line that opens the model there.' },
  Blender: { name: 'Blender', ending: 'py', hint: 'Paste into the Python console, after the import of the model.' },
  'model-viewer': { name: 'model-viewer: camera-orbit', ending: 'model-viewer.html', hint: 'An element of web pages, for a glTF.' },
  glTF: { name: 'glTF', ending: 'gltf', hint: 'A camera node.' },
  'NeRF transforms.json': { name: 'NeRF transforms.json', ending: 'transforms.json', hint: 'For NeRF and Gaussian splatting.' },
};

/** Fills the camera box; returns a function that shows another view's camera. */
export function fillCameras({ views, frame, turn, view: json }) {
  const textOf = (view, format) =>
    (format === 'Blender' ? blenderScript(view, frame, json.model.format, turn) : view.cameras[format] ?? '');
  let current = views[0];
  for (const [value, { name }] of Object.entries(FORMATS)) {
    if (textOf(current, value) !== '') {
      make('option', name, element('format')).setAttribute('value', value);
    }
  }
  const show = (view = current) => {
    current = view;
    element('camera-of').textContent = /^\d/.test(view.name) ? `view ${view.name}` : `the ${view.name} view`;
    element('format-text').textContent = FORMATS[element('format').value].hint;
    element('camera').value = textOf(view, element('format').value);
  };
  element('format').addEventListener('change', () => show());
  element('copy').addEventListener('click', async () => {
    try {
      await navigator.clipboard.writeText(element('camera').value);
    } catch { // pages opened from disk may not use the clipboard
      const focused = document.activeElement;
      element('camera').select();
      document.execCommand('copy');
      focused.focus();
    }
    element('copy').textContent = 'Copied';
    setTimeout(() => { element('copy').textContent = 'Copy'; }, 1200);
  });
  element('save-camera').addEventListener('click', () => {
    const file = new Blob([element('camera').value], { type: 'text/plain' });
    save(`${json.model.name}-${current.name}.${FORMATS[element('format').value].ending}`, URL.createObjectURL(file));
  });
  show();
  return show;
}

export function fillLegend(table) {
  const context = element('colours').getContext('2d');
  const image = context.createImageData(256, 1);
  for (let i = 0; i < 256; ++i) {
    image.data.set([table[3 * i], table[3 * i + 1], table[3 * i + 2], 255], 4 * i);
  }
  context.putImageData(image, 0, 0);
}
