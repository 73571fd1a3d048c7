// SPDX-License-Identifier: MIT
// report.html in real Chromium: what the reader does, checked against view.json and the pictures.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import * as fs from 'node:fs';
import * as os from 'node:os';
import * as path from 'node:path';
import { after, before, test } from 'node:test';
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

/** Position and axes of the camera, in the model's own coordinates. */
async function camera(page) {
  const [matrix, fov] = await page.evaluate(() => {
    const { camera } = window.vantage.model;
    camera.updateMatrixWorld();
    return [camera.matrixWorld.toArray(), camera.fov];
  });
  const radius = view.camera.distance * Math.sin((view.camera.fov_y_deg * Math.PI) / 360);
  return {
    eye: [12, 13, 14].map((k, axis) => view.camera.target[axis] + radius * matrix[k]),
    up: matrix.slice(4, 7),
    back: matrix.slice(8, 11),
    fov,
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
    const page = await open(browser, report);
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
    await page.context().close();
  });
}

test('the window shows the silhouette of best.png', async () => {
  // The stage is as large as the picture: 360 px of panel beside it, the header above.
  const page = await open(browser, report, { viewport: { width: 1160, height: 649 } });
  const [width, height] = await page.evaluate(() => [
    document.getElementById('model').clientWidth, document.getElementById('model').clientHeight]);
  assert.equal(width, 800);
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
  const page = await open(browser, report);
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
  await page.context().close();
});

test('the map gives the surface its colours, and they can be switched off', async () => {
  const page = await open(browser, report);
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
  assert.ok(await spread() > 10000);
  await page.click('#show-map');
  assert.equal(await spread(), 0);
  await page.click('#show-skeleton'); // the bones are red
  assert.ok(await spread() > 100);
  await page.context().close();
});

test('a click on the view sphere flies there and tells the score', async () => {
  const page = await open(browser, report);
  const before = (await camera(page)).eye;
  const box = await page.locator('#sphere').boundingBox();
  await page.mouse.click(box.x + 0.35 * box.width, box.y + 0.4 * box.height);
  await waitForFlight(page);
  const after = await camera(page);
  assert.ok(distance(before, after.eye) > 0.1 * after.radius);
  assert.ok(Math.abs(distance(after.eye, view.camera.target) - view.camera.distance) < 1e-4 * after.radius);
  assert.match(await page.textContent('#direction'), /score about [\d.]+ \([\d.]+ %\)/);
  await page.context().close();
});

test('the replayed search takes fewer views for a larger ε, and all of them for the smallest', async () => {
  const page = await open(browser, report);
  const views = async (exponent) => {
    await page.locator('#epsilon').evaluate((slider, value) => {
      slider.value = value;
      slider.dispatchEvent(new Event('input'));
    }, exponent);
    return Number((await page.textContent('#replay-text')).match(/^\d+/)[0]);
  };
  const counts = [await views(-3), await views(0), await views(3)];
  assert.ok(counts[0] >= counts[1] && counts[1] > counts[2] && counts[2] >= 8, counts.join(' '));
  await page.context().close();
});

test('keys turn the model, pick views and toggle what is shown', async () => {
  const page = await open(browser, report);
  await page.focus('#model');
  const start = (await camera(page)).eye;
  await page.keyboard.press('ArrowRight');
  assert.ok(distance(start, (await camera(page)).eye) > 0.01);
  await page.keyboard.press('2');
  await waitForFlight(page);
  assert.ok(distance((await camera(page)).eye, view.worst.eye) < 1e-4 * (await camera(page)).radius);
  await page.keyboard.press('k');
  assert.equal(await page.isChecked('#show-map'), false);
  await page.keyboard.press('d');
  assert.equal(await page.getAttribute('html', 'data-theme'), 'dark');
  await page.context().close();
});

test('a further view of the set brings its camera', async () => {
  const page = await open(browser, report);
  await page.click('.view[data-view="3"]');
  await waitForFlight(page);
  const seen = await camera(page);
  assert.ok(distance(seen.eye, view.views[2].eye) < 1e-5 * seen.radius);
  await page.context().close();
});

test('the tour goes on until something else is asked for', async () => {
  const page = await open(browser, report);
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
  const page = await open(browser, report);
  const files = { glTF: 'gltf', 'NeRF transforms.json': 'transforms.json', f3d: 'f3d.txt',
    'model-viewer': 'model-viewer.html' };
  const formats = await page.locator('#format option').evaluateAll((all) => all.map((o) => o.value));
  assert.deepEqual(formats.sort(), Object.keys(files).sort());
  await page.context().close();
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
  const page = await open(browser, report);
  await page.selectOption('#format', 'NeRF transforms.json');
  assert.equal(await page.inputValue('#camera'),
    fs.readFileSync(path.join(out, 'camera-best.transforms.json'), 'utf8'));
  await page.context().close();
});

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
