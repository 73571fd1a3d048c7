// SPDX-License-Identifier: MIT
// report.html in real Chromium: what the reader does, checked against view.json and the pictures.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import * as fs from 'node:fs';
import * as os from 'node:os';
import * as path from 'node:path';
import { pathToFileURL } from 'node:url';
import { after, before, test } from 'node:test';
import * as zlib from 'node:zlib';
import { launch, open } from './browser.mjs';

const models = process.env.VANTAGE_MODELS;
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'vantage-viewer-'));
const out = path.join(folder, 'result');
let browser;
let view;

const vantage = (...args) => execFileSync(process.env.VANTAGE, args, { cwd: folder, stdio: 'pipe' });
const report = path.join(out, 'report.html');

before(async () => {
  vantage('view', path.join(models, 'horse.ply'), '-o', out, '--search', 'rapid', '--views', '4');
  view = JSON.parse(fs.readFileSync(path.join(out, 'view.json'), 'utf8'));
  browser = await launch();
});

after(async () => {
  await browser?.close();
  fs.rmSync(folder, { recursive: true, force: true });
});

let shared;
/** The report as it was opened: one page for many tests, as a new one takes seconds to draw. */
async function opened() {
  shared ??= await open(browser, report);
  await shared.click('#reset');
  await shared.evaluate(() => document.activeElement.blur());
  await waitForFlight(shared);
  return shared;
}

/** A PNG of one row: red, blue. */
function redAndBlue() {
  const chunk = (type, data) => {
    const body = Buffer.concat([Buffer.from(type), data]);
    const [size, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
    size.writeUInt32BE(data.length);
    let crc = 0xffffffff;
    for (const byte of body) {
      crc ^= byte;
      for (let k = 0; k < 8; ++k) {
        crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
      }
    }
    sum.writeUInt32BE((crc ^ 0xffffffff) >>> 0);
    return Buffer.concat([size, body, sum]);
  };
  return Buffer.concat([Buffer.from('89504e470d0a1a0a', 'hex'),
    chunk('IHDR', Buffer.from([0, 0, 0, 2, 0, 0, 0, 1, 8, 2, 0, 0, 0])),
    chunk('IDAT', zlib.deflateSync(Buffer.from([0, 255, 0, 0, 0, 0, 255]))), chunk('IEND', Buffer.alloc(0))]);
}

/** The report of a box whose sides show redAndBlue(). */
function texturedReport() {
  const corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
  const sides = [[4, 3, 2, 1], [5, 6, 7, 8], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8]];
  fs.writeFileSync(path.join(folder, 'box.png'), redAndBlue());
  fs.writeFileSync(path.join(folder, 'box.mtl'), 'newmtl two\nKd 1 1 1\nmap_Kd box.png\n');
  fs.writeFileSync(path.join(folder, 'box.obj'), ['mtllib box.mtl', ...corners.map((p) => `v ${p.join(' ')}`),
    'vt 0 0', 'vt 1 0', 'vt 1 1', 'vt 0 1', 'usemtl two',
    ...sides.map((side) => `f ${side.map((v, k) => `${v}/${k + 1}`).join(' ')}`), ''].join('\n'));
  vantage('view', 'box.obj', '-o', path.join(folder, 'box'), '--search', 'rapid', '--contraction', 'exact');
  return path.join(folder, 'box', 'report.html');
}

/** Position and axes of the camera, in the model's own coordinates. */
async function camera(page) {
  const [matrix, { centre, radius }] = await page.evaluate(() => {
    const { camera } = window.vantage.model;
    camera.updateMatrixWorld();
    return [camera.matrixWorld.toArray(), window.vantage.data.frame];
  });
  return {
    eye: [12, 13, 14].map((k, axis) => centre[axis] + radius * matrix[k]),
    right: matrix.slice(0, 3),
    up: matrix.slice(4, 7),
    back: matrix.slice(8, 11),
    radius,
  };
}

const distance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));
const unit = (v) => v.map((x) => x / Math.hypot(...v));

async function waitForFlight(page) {
  await page.waitForFunction(() => window.vantage.model.flight === undefined);
}

test('opens from disk without errors, warnings or requests', async () => {
  const page = await open(browser, report);
  assert.deepEqual(page.complaints, []);
  assert.equal(await page.textContent('#name'), 'horse');
  assert.equal(await page.locator('.view').count(), 2 + 3); // the best is the first of the four
  await page.context().close();
});

for (const name of ['best', 'worst']) {
  test(`a click on the ${name} view brings the camera of view.json`, async () => {
    const page = await opened();
    await page.click('.view >> nth=' + (name === 'best' ? 1 : 0)); // leave the view first
    await waitForFlight(page);
    await page.click(`.view[data-view=${name}]`);
    await waitForFlight(page);
    const seen = await camera(page);
    // Positions are 32-bit floats in the page.
    assert.ok(distance(seen.eye, view[name].eye) < 1e-5 * seen.radius, 'eye');
    const back = unit(view[name].eye.map((x, i) => x - view[name].frame.target[i]));
    assert.ok(distance(seen.back, back) < 1e-5, 'line of sight');
    assert.ok(seen.up.reduce((s, x, i) => s + x * view[name].up[i], 0) > 0.95, 'up');
  });
}

test('the window shows the silhouette of best.png', async () => {
  // The stage is as large as the picture: 360 px of panel beside it, the header above.
  const [wide, high] = view.best.size;
  const page = await open(browser, report, { viewport: { width: wide + 360, height: high + 100 } });
  const header = (await page.locator('header').boundingBox()).height;
  await page.setViewportSize({ width: wide + 360, height: high + Math.round(header) });
  await page.waitForFunction((h) => Math.abs(document.getElementById('model').clientHeight - h) <= 1, high);
  // A canvas that is made larger is empty until the frame after.
  await page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
  const [width, height] = await page.evaluate(() => [
    document.getElementById('model').clientWidth, document.getElementById('model').clientHeight]);
  assert.equal(width, wide);
  const picture = 'data:image/png;base64,' + fs.readFileSync(path.join(out, 'best.png')).toString('base64');
  const overlap = await page.evaluate(async ([url, w, h]) => {
    const mask = async (source) => {
      const image = new Image();
      image.src = source;
      await image.decode();
      const canvas = document.createElement('canvas');
      canvas.width = w;
      canvas.height = h;
      const context = canvas.getContext('2d');
      const size = image.height * (w / image.width);
      context.drawImage(image, 0, (h - size) / 2, w, size);
      return context.getImageData(0, 0, w, h).data.filter((_, i) => i % 4 === 3).map((a) => a > 127);
    };
    const a = await mask(document.getElementById('model').toDataURL());
    const b = await mask(url);
    let both = 0;
    let either = 0;
    a.forEach((x, i) => { both += x && b[i] ? 1 : 0; either += x || b[i] ? 1 : 0; });
    return both / either;
  }, [picture, width, height]);
  // One pixel along the outline of a horse is about 1 % of its area.
  assert.ok(overlap > 0.98, `overlap ${overlap}`);
  await page.context().close();
});

test('the slider plays the history: the last level is thinner than the first', async () => {
  const page = await opened();
  const area = () => page.evaluate(async () => {
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const gl = window.vantage.model.renderer.getContext();
    const data = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, data);
    return data.filter((_, i) => i % 4 === 3).reduce((n, a) => n + (a > 0 ? 1 : 0), 0);
  });
  const levels = [];
  const last = Number(await page.getAttribute('#level', 'max'));
  assert.equal(last, view.contraction.levels);
  for (const level of [0, 1, last]) {
    await page.locator('#level').evaluate((slider, value) => {
      slider.value = value;
      slider.dispatchEvent(new Event('input'));
    }, level);
    levels.push(await area());
  }
  assert.ok(levels[1] < levels[0] && levels[2] < 0.7 * levels[0], levels.join(' '));
  assert.deepEqual(page.complaints, []);
});

test('the map gives the surface its colours, and they can be switched off', async () => {
  const page = await opened();
  const spread = () => page.evaluate(async () => {
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const gl = window.vantage.model.renderer.getContext();
    const data = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, data);
    let colourful = 0;
    for (let i = 0; i < data.length; i += 4) {
      const c = [data[i], data[i + 1], data[i + 2]];
      colourful += data[i + 3] > 0 && Math.max(...c) - Math.min(...c) > 60 ? 1 : 0;
    }
    return colourful;
  });
  assert.equal(await spread(), 0); // the horse has no colours of its own
  await page.click('#show-map');
  assert.ok(await spread() > 10000);
  await page.click('#show-skeleton');
  await page.click('#show-map');
  assert.equal(await spread(), 0); // the bones, which are red, went with the map
});

test('a click on the view sphere flies there and tells the score', async () => {
  const page = await opened();
  const before = (await camera(page)).eye;
  const box = await page.locator('#sphere').boundingBox();
  await page.mouse.click(box.x + 0.35 * box.width, box.y + 0.4 * box.height);
  await waitForFlight(page);
  const after = await camera(page);
  assert.ok(distance(before, after.eye) > 0.1 * after.radius);
  assert.ok(Math.abs(distance(after.eye, view.camera.target) - view.camera.distance) < 1e-4 * after.radius);
  assert.match(await page.textContent('#direction'), /score about [\d.]+ \([\d.]+ %\)/);
});

test('the replayed search takes fewer views for a larger ε, and all of them for the smallest', async () => {
  const page = await opened();
  const views = async (exponent) => {
    await page.locator('#epsilon').evaluate((slider, value) => {
      slider.value = value;
      slider.dispatchEvent(new Event('input'));
    }, exponent);
    return Number((await page.textContent('#replay-text')).match(/^\d+/)[0]);
  };
  const counts = [await views(-3), await views(0), await views(3)];
  assert.ok(counts[0] >= counts[1] && counts[1] > counts[2] && counts[2] >= 8, counts.join(' '));
  assert.match(await page.textContent('#replay-text'), / views in 1 ring; /);
});

test('keys turn the model, pick views and toggle what is shown', async () => {
  const page = await opened();
  await page.focus('#model');
  const start = (await camera(page)).eye;
  await page.keyboard.press('ArrowRight');
  assert.ok(distance(start, (await camera(page)).eye) > 0.01);
  await page.keyboard.press('2');
  await waitForFlight(page);
  assert.ok(distance((await camera(page)).eye, view.worst.eye) < 1e-4 * (await camera(page)).radius);
  await page.keyboard.press('k');
  assert.equal(await page.isChecked('#show-map'), true);
  await page.keyboard.press('o');
  assert.equal(await page.evaluate(() => window.vantage.sphere.shown), 'score');
  await page.keyboard.press('r');
  assert.equal(await page.isChecked('#show-map'), false);
  await page.keyboard.press('d');
  assert.equal(await page.getAttribute('html', 'data-theme'), 'dark');
});

test('a further view of the set brings its camera', async () => {
  const page = await opened();
  await page.click('.view[data-view="3"]');
  await waitForFlight(page);
  const seen = await camera(page);
  assert.ok(distance(seen.eye, view.views[2].eye) < 1e-5 * seen.radius);
});

test('a flight takes a while, and ends at the view', async () => {
  const page = await open(browser, report, { reducedMotion: 'no-preference' });
  await page.click('.view[data-view=worst]');
  assert.notEqual(await page.evaluate(() => window.vantage.model.flight), undefined);
  await waitForFlight(page);
  const seen = await camera(page);
  assert.ok(distance(seen.eye, view.worst.eye) < 1e-5 * seen.radius);
  await page.context().close();
});

test('turned by hand or by keys the model stands upright, and keys stop at the poles', async () => {
  const page = await opened();
  const lean = async () => { // of the horizon: how far the picture's right is from the horizontal
    const up = await page.evaluate(() => window.vantage.data.up);
    return Math.abs((await camera(page)).right.reduce((sum, x, i) => sum + x * up[i], 0));
  };
  const box = await page.locator('#model').boundingBox();
  await page.mouse.move(box.x + 200, box.y + 300);
  await page.mouse.down();
  await page.mouse.move(box.x + 420, box.y + 300, { steps: 8 });
  await page.mouse.up();
  assert.ok(await lean() < 1e-3, `leans by ${await lean()}`);
  await page.keyboard.press('r');
  const before = await camera(page);
  await page.keyboard.press('ArrowRight'); // nothing has the focus
  assert.ok(await lean() < 1e-3);
  await page.focus('#epsilon');
  const turned = await camera(page);
  assert.ok(distance(before.eye, turned.eye) > 0.01 * turned.radius);
  await page.keyboard.press('ArrowRight'); // of the slider
  assert.ok(distance(turned.eye, (await camera(page)).eye) < 1e-6 * turned.radius);
  await page.focus('#theme');
  for (let i = 0; i < 50; ++i) {
    await page.keyboard.press('ArrowUp');
  }
  const high = await camera(page);
  await page.keyboard.press('ArrowUp');
  const higher = await camera(page);
  assert.ok(high.back[1] > 0.999 && distance(high.eye, higher.eye) < 1e-3 * high.radius, high.back.join(' '));
  assert.ok(distance(high.right, higher.right) < 1e-3);
  const away = ({ eye, radius }) => distance(eye, view.camera.target) / radius;
  await page.keyboard.press('+');
  assert.ok(away(await camera(page)) < 0.95 * away(higher));
});

test('a flight that is taken over stays as it is seen', async () => {
  for (const [name, ...options] of [['taken'], ['flat', '--projection', 'orthographic']]) {
    const [page] = await openWith(name, { reducedMotion: 'no-preference' }, ...options);
    await page.evaluate(() => { // slow motion: a busy machine draws few frames of a flight
      const [zero, clock, request] = [performance.now(), performance.now.bind(performance), requestAnimationFrame.bind(window)];
      const slow = (now) => zero + (now - zero) / 10;
      performance.now = () => slow(clock());
      window.requestAnimationFrame = (step) => request((now) => step(slow(now)));
    });
    await page.focus('#model');
    for (let i = 0; i < 8; ++i) {
      await page.keyboard.press('+');
    }
    const seen = async () => [await camera(page), await page.evaluate(() => {
      const { camera } = window.vantage.model;
      return camera.isPerspectiveCamera ? camera.fov : camera.top / camera.zoom;
    })];
    const [, near] = await seen();
    const box = await page.locator('#model').boundingBox();
    await page.evaluate(() => { window.start = window.vantage.model.direction(); });
    await page.click('.view[data-view=worst]');
    await page.mouse.move(box.x + 300, box.y + 300);
    await page.waitForFunction(() => window.vantage.model.direction().angleTo(window.start) > 0.5);
    await page.mouse.down(); // which ends the flight
    const [before, lens] = await seen();
    const towards = await page.evaluate(() => {
      const { camera, controls } = window.vantage.model;
      return camera.position.clone().sub(controls.target).normalize().toArray();
    });
    assert.ok(distance(before.back, towards) < 1e-5, `${name}: ${before.back} ${towards}`); // about which the reader turns it
    await page.mouse.up();
    await page.setViewportSize({ width: 1199, height: 800 });
    await page.waitForFunction((width) => document.getElementById('model').clientWidth < width, box.width);
    await page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
    const [, resized] = await seen();
    assert.ok(Math.abs(resized / lens - 1) < 0.005, `${name}: ${lens} ${resized}`);
    if (name === 'flat') { // zooms by its lens, which goes on from where it is
      const whole = await page.evaluate(() => window.vantage.data.views[1].height / 2);
      assert.ok(lens > near && lens < whole, `${near} ${lens} ${whole}`);
      assert.equal(await page.evaluate(() => window.vantage.model.camera.zoom), 1);
    }
    await page.context().close();
  }
});

test('who comes back to the page finds its controls as what is shown', async () => {
  const page = await open(browser, peoplesReport());
  const controls = () => page.locator('input, select').evaluateAll((all) => all.map((one) => [one.id || one.value, one.checked, one.value]));
  const first = await controls();
  await page.click('#show-map');
  await page.click('#show-skeleton');
  await page.check('input[name=sphere][value=score]');
  await page.check('input[name=goal][value=worst]');
  await page.selectOption('#format', 'glTF');
  await page.fill('#level', '1');
  await page.fill('#epsilon', '2');
  assert.notDeepEqual(await controls(), first);
  fs.writeFileSync(path.join(folder, 'other.html'), '<!doctype html><title>other</title>');
  await page.goto(pathToFileURL(path.join(folder, 'other.html')).href);
  await page.goBack();
  await page.waitForSelector('html[data-ready=yes]', { state: 'attached' });
  assert.deepEqual(await controls(), first);
  await page.context().close();
});

test('the tour tells of all its views, though the strip has but the first', async () => {
  // Small walls in the sun, each of which hides others: many views are needed.
  const walls = [];
  const faces = [];
  for (let i = 0; i < 400; ++i) {
    const z = 1 - (2 * i + 1) / 400;
    const [r, turn, away] = [Math.sqrt(1 - z * z), i * 2.399963, 0.3 + 0.7 * ((i * 0.618034) % 1)];
    const middle = [away * r * Math.cos(turn), away * r * Math.sin(turn), away * z];
    for (const corner of [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) {
      walls.push(`v ${middle.map((x, k) => (x + 0.09 * corner[k]).toFixed(6)).join(' ')}`);
    }
    faces.push(...[[1, 2, 3], [1, 4, 2], [1, 3, 4], [2, 4, 3]].map((f) => `f ${f.map((v) => v + 4 * i).join(' ')}`));
  }
  fs.writeFileSync(path.join(folder, 'soup.obj'), [...walls, ...faces, ''].join('\n'));
  vantage('view', 'soup.obj', '-o', 'soup', '--search', 'rapid', '--views', '40');
  const { views } = JSON.parse(fs.readFileSync(path.join(folder, 'soup', 'view.json'), 'utf8'));
  assert.ok(views.length > 24, String(views.length));
  const page = await open(browser, path.join(folder, 'soup', 'report.html'));
  assert.match(await page.textContent('#tour-text'), new RegExp(`° over ${views.length} views$`));
  await page.context().close();
});

test('hiding the significance ends the contraction that is played', async () => {
  const page = await opened();
  await page.keyboard.press(' ');
  await page.waitForFunction(() => window.vantage.model.level > 0);
  await page.keyboard.press('k');
  await page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
  assert.equal(await page.evaluate(() => window.vantage.model.level), 0);
});

/** Of the report that view makes with these options: its page, and what its view.json says. */
async function openWith(name, context, ...options) {
  const result = path.join(folder, name);
  vantage('view', path.join(models, 'horse.ply'), '-o', result, '--search', 'rapid', ...options);
  const json = JSON.parse(fs.readFileSync(path.join(result, 'view.json'), 'utf8'));
  return [await open(browser, path.join(result, 'report.html'), context), json];
}

/** Share of the window's height that is drawn on. */
const drawnHeight = (page) => page.evaluate(async () => {
  await new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); });
  const gl = window.vantage.model.renderer.getContext();
  const [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
  const data = new Uint8Array(4 * w * h);
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, data);
  let rows = 0;
  for (let y = 0; y < h; ++y) {
    rows += data.subarray(4 * w * y, 4 * w * (y + 1)).some((a, i) => i % 4 === 3 && a > 0) ? 1 : 0;
  }
  return rows / h;
});

for (const [name, ...options] of [['far', '--distance', '60'], ['flat', '--projection', 'orthographic']]) {
  test(`stands at the view's eye and shows the whole model with ${options.join(' ')}`, async () => {
    const [page, json] = await openWith(name, {}, ...options);
    const seen = await camera(page);
    const line = json.best.eye.map((x, i) => x - json.best.frame.target[i]);
    const away = name === 'far' ? line : seen.eye.map((x, i) => x - json.best.frame.target[i]); // of parallel lines any is right
    const eye = json.best.frame.target.map((x, i) => x + away[i]);
    assert.ok(distance(seen.eye, eye) < 1e-4 * Math.hypot(...away), seen.eye.join(' '));
    assert.ok(distance(seen.back, name === 'far' ? unit(line) : json.best.direction) < 1e-4, seen.back.join(' '));
    const narrow = Math.max(1, (json.best.size[0] / json.best.size[1]) / await page.evaluate(() => window.vantage.model.aspect));
    const drawn = narrow * await drawnHeight(page); // of the picture's height; the rest is margin
    assert.ok(drawn > 0.6 && drawn <= 1, `${drawn} of the height`);
    const text = async (format) => {
      await page.selectOption('#format', format);
      return page.inputValue('#camera');
    };
    const location = (await text('Blender')).match(/location = \(([^)]+)\)/)[1].split(', ').map(Number);
    assert.ok(distance(location, seen.eye) < 1e-4 * Math.hypot(...away), location.join(' '));
    const scale = (await text('Blender')).match(/ortho_scale = (.+)/)?.[1];
    assert.equal(scale === undefined, name === 'far');
    assert.ok(scale === undefined || Math.abs(Number(scale) - json.best.frame.height) < 1e-5 * json.best.frame.height, scale);
    const formats = await page.locator('#format option').evaluateAll((all) => all.map((o) => o.value));
    assert.equal(formats.includes('model-viewer'), name === 'far'); // it knows no parallel lines of sight
    const box = await page.locator('#sphere').boundingBox();
    await page.mouse.click(box.x + 0.35 * box.width, box.y + 0.4 * box.height);
    assert.ok(await drawnHeight(page) > 0.3);
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  });
}

test('the tour goes on until something else is asked for', async () => {
  const page = await open(browser, report, { reducedMotion: 'no-preference' });
  await page.click('#tour');
  await page.waitForFunction(() => window.vantage.model.touring);
  const first = (await camera(page)).eye;
  await page.waitForFunction((eye) => {
    const { position } = window.vantage.model.camera;
    return Math.hypot(position.x - eye[0], position.y - eye[1], position.z - eye[2]) > 0.1;
  }, await page.evaluate(() => window.vantage.model.camera.position.toArray()));
  assert.ok(distance(first, (await camera(page)).eye) > 0);
  await page.click('.view[data-view=worst]');
  await page.waitForFunction(() => !window.vantage.model.touring && window.vantage.model.flight === undefined);
  assert.ok(distance((await camera(page)).eye, view.worst.eye) < 1e-4 * (await camera(page)).radius);
  assert.match(await page.textContent('#tour'), /▶/);
  await page.context().close();
});

test('every camera format of the result folder is in the box', async () => {
  const page = await opened();
  const texts = new Map();
  for (const format of await page.locator('#format option').evaluateAll((all) => all.map((o) => o.value))) {
    await page.selectOption('#format', format);
    texts.set(format, await page.inputValue('#camera'));
  }
  const cameras = fs.readdirSync(out).filter((name) => name.startsWith('camera-best.'));
  assert.ok(cameras.length >= 4, cameras.join(' '));
  for (const name of cameras) {
    assert.ok([...texts.values()].includes(fs.readFileSync(path.join(out, name), 'utf8')), name);
  }
  assert.equal(new Set(texts.values()).size, cameras.length + 1); // and a script for Blender, which is no file
  assert.match(texts.get('Blender'), /bpy/);
});

test('a finger turns the model', async () => {
  const page = await open(browser, report, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  const before = (await camera(page)).eye;
  const box = await page.locator('#model').boundingBox();
  const client = await page.context().newCDPSession(page);
  const touch = (type, x) => client.send('Input.dispatchTouchEvent', {
    type, touchPoints: type === 'touchEnd' ? [] : [{ x, y: box.y + box.height / 2 }] });
  await touch('touchStart', box.x + 100);
  for (let x = 110; x <= 200; x += 10) {
    await touch('touchMove', box.x + x);
  }
  await touch('touchEnd', 0);
  assert.ok(distance(before, (await camera(page)).eye) > 0.05 * (await camera(page)).radius);
  await page.context().close();
});

test('the camera box holds the file that view wrote', async () => {
  const page = await opened();
  await page.selectOption('#format', 'NeRF transforms.json');
  assert.equal(await page.inputValue('#camera'),
    fs.readFileSync(path.join(out, 'camera-best.transforms.json'), 'utf8'));
});

test('opens on the model as it is; colours, legend, skeleton and contraction come and go as one', async () => {
  const page = await opened();
  const shown = async () => [await page.isVisible('#legend'), await page.isVisible('#show-skeleton'), await page.isVisible('#level')];
  assert.deepEqual(await shown(), [false, false, false]);
  await page.click('#show-map');
  assert.deepEqual(await shown(), [true, true, true]);
  await page.click('#show-map');
  assert.deepEqual(await shown(), [false, false, false]);
});

/** The report of a search that maximises what people choose; a rapid one maximises the score. */
function peoplesReport() {
  const result = path.join(folder, 'people');
  if (!fs.existsSync(result)) {
    vantage('view', path.join(models, 'horse.ply'), '-o', result);
  }
  return path.join(result, 'report.html');
}

test('a sphere of the score alone has no switch', async () => {
  const page = await opened();
  assert.equal(await page.locator('#sphere-of').count(), 0);
});

test('the sphere shows what best maximises until it is switched to the score', async () => {
  const page = await open(browser, peoplesReport());
  const { best, twins } = JSON.parse(fs.readFileSync(path.join(folder, 'people', 'view.json'), 'utf8'));
  const highest = () => page.evaluate(() => {
    const { sphere, data } = window.vantage;
    return data.sphere.directions[sphere.heights.indexOf(1)];
  });
  const angle = (a, b) => (Math.acos(a.reduce((s, x, i) => s + x * b[i], 0)) * 180) / Math.PI;
  const peak = await highest();
  const asGood = [best, ...twins].map((view) => angle(peak, view.direction));
  assert.ok(Math.min(...asGood) < 15, 'the objective peaks at the best view or its mirror image');
  // It opens at the best view.
  const [, share] = (await page.textContent('#direction')).match(/objective about ([\d.]+) % of the best view's/);
  assert.ok(Number(share) > 99 && Number(share) < 101, share);
  await page.check('input[name=sphere][value=score]');
  assert.deepEqual(await highest(), await page.evaluate(() => {
    const { directions, scores } = window.vantage.data.sphere;
    return directions[scores.indexOf(Math.max(...scores))];
  }));
  await page.context().close();
});

test('reset brings back the page as it was opened', async () => {
  const page = await opened();
  const first = (await camera(page)).eye;
  await page.click('.view[data-view=worst]');
  await waitForFlight(page);
  await page.click('#show-map');
  await page.click('#show-skeleton');
  await page.click('#reset');
  await waitForFlight(page);
  const seen = await camera(page);
  assert.ok(distance(seen.eye, first) < 1e-5 * seen.radius);
  assert.equal(await page.isChecked('#show-map'), false);
  assert.equal(await page.evaluate(() => window.vantage.model.skeleton.visible), false);
  assert.match(await page.textContent('#camera-of'), /best/);
});

test('the picture and the camera can be saved', async () => {
  const page = await opened();
  const saved = async (button) => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
    return [download.suggestedFilename(), fs.readFileSync(await download.path())];
  };
  const [pictureName, picture] = await saved('#save-picture');
  assert.equal(pictureName, 'horse.png');
  assert.equal(picture.subarray(1, 4).toString(), 'PNG');
  await page.selectOption('#format', 'NeRF transforms.json');
  const [cameraName, text] = await saved('#save-camera');
  assert.equal(cameraName, 'horse-best.transforms.json');
  assert.equal(text.toString(), fs.readFileSync(path.join(out, 'camera-best.transforms.json'), 'utf8'));
});

test("cameras for Blender and model-viewer stand at the view's eye", async () => {
  const page = await opened();
  await page.selectOption('#format', 'model-viewer');
  const text = await page.inputValue('#camera');
  const numbers = (name) => text.match(new RegExp(`${name}="([^"]+)"`))[1].split(' ').map(parseFloat);
  const [theta, phi, away] = numbers('camera-orbit');
  const target = numbers('camera-target');
  const [t, p] = [theta, phi].map((x) => (x * Math.PI) / 180);
  const eye = [Math.sin(p) * Math.sin(t), Math.cos(p), Math.sin(p) * Math.cos(t)].map((x, i) => target[i] + away * x);
  const size = view.camera.distance;
  assert.equal(view.up, 'y'); // so that its axes are those of glTF
  assert.ok(distance(eye, view.best.eye) < 1e-4 * size, eye.join(' '));
  await page.selectOption('#format', 'Blender');
  const location = (await page.inputValue('#camera')).match(/location = \(([^)]+)\)/)[1].split(', ').map(Number);
  assert.ok(distance(location, view.best.eye) < 1e-4 * size, location.join(' '));
});

test('cameras that name the file fit it where --up any has turned the model', async () => {
  const [c, s] = [Math.cos(0.4), Math.sin(0.4)];
  const corners = [...Array(8).keys()].map((i) => [i & 1, (i >> 1) & 1, i >> 2].map((bit, k) => 5 + (k + 1) * bit))
    .map(([x, y, z]) => [c * x - s * y, s * x + c * y, z]).map(([x, y, z]) => [x, c * y - s * z, s * y + c * z]);
  const sides = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]];
  fs.writeFileSync(path.join(folder, 'leaning.obj'),
    `${corners.map((p) => `v ${p.join(' ')}`).join('\n')}\n${sides.map((f) => `f ${f.join(' ')}`).join('\n')}\n`);
  vantage('view', 'leaning.obj', '-o', 'leaning', '--up', 'any', '--contraction', 'exact');
  const page = await open(browser, path.join(folder, 'leaning/report.html'));
  const text = async (format) => {
    await page.selectOption('#format', format);
    return page.inputValue('#camera');
  };
  const line = await text('f3d');
  assert.equal(line, fs.readFileSync(path.join(folder, 'leaning/camera-best.f3d.txt'), 'utf8'));
  const eye = line.match(/position=(\S+)/)[1].split(',').map(Number);
  const turned = JSON.parse(fs.readFileSync(path.join(folder, 'leaning/view.json'), 'utf8')).best.eye;
  assert.ok(distance(eye, turned) > 1, 'the model was turned');
  const location = (await text('Blender')).match(/location = \(([^)]+)\)/)[1].split(', ').map(Number);
  assert.ok(distance(location, [eye[0], -eye[2], eye[1]]) < 1e-4, location.join(' '));
  await page.context().close();
});

test("shows a file's own texture", async () => {
  // A square in a texture that is red on the left and blue on the right.
  const page = await open(browser, texturedReport());
  await page.waitForFunction(() => window.vantage.model.loading === 0);
  const sides = () => page.evaluate(async () => {
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const { renderer } = window.vantage.model;
    const gl = renderer.getContext();
    const [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const data = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, data);
    const counts = { red: 0, blue: 0 };
    for (let i = 0; i < data.length; i += 4) {
      counts.red += data[i] > 2 * data[i + 2] + 40 ? 1 : 0;
      counts.blue += data[i + 2] > 2 * data[i] + 40 ? 1 : 0;
    }
    return counts;
  });
  const asItIs = await sides();
  assert.ok(asItIs.red > 5000 && asItIs.blue > 5000, JSON.stringify(asItIs));
  await page.click('#show-map');
  assert.equal(await page.evaluate(() => window.vantage.model.asset.visible), false);
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

for (const width of [390, 1280]) {
  test(`at ${width} px all that is pressed is at least 44 px high`, async () => {
    const page = await open(browser, report, { viewport: { width, height: 844 }, hasTouch: width === 390, isMobile: width === 390 });
    await page.click('#show-map');
    const low = await page.locator('button, select, label, input[type=range]').evaluateAll((all) => all
      .filter((one) => one.getClientRects().length > 0 && one.getBoundingClientRect().height < 44)
      .map((one) => one.outerHTML.slice(0, 60)));
    assert.deepEqual(low, []);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
    await page.context().close();
  });
}

test('on a phone nothing is wider than the screen', async () => {
  const page = await open(browser, report, { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

test('a name with markup is shown as text', async () => {
  const name = '<img src=x onerror=document.title=1>&<!--<script>';
  fs.copyFileSync(path.join(models, 'horse.ply'), path.join(folder, `${name}.ply`));
  const odd = path.join(folder, 'odd');
  vantage('view', `${name}.ply`, '-o', odd, '--search', 'rapid');
  const page = await open(browser, path.join(odd, 'report.html'));
  assert.equal(await page.textContent('#name'), name);
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

test('shows a large model within seconds', { skip: process.env.VANTAGE_DATA ? false : 'VANTAGE_DATA is not set' }, async () => {
  const large = path.join(folder, 'large');
  vantage('view', path.join(process.env.VANTAGE_DATA, 'paper', 'armadillo_172966_loop.ply'), '-o', large, '--search', 'rapid');
  const page = await open(browser, path.join(large, 'report.html'));
  assert.deepEqual(page.complaints, []);
  assert.match(await page.textContent('#numbers'), /shown here/);
  assert.match(await page.textContent('#numbers'), /more where significance is high/);
  assert.ok(fs.statSync(path.join(large, 'report.html')).size < 40e6);
  console.log(`# 173 000 vertices loaded in ${page.loadSeconds} s`);
  await page.context().close();
});
