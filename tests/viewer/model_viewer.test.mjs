// SPDX-License-Identifier: MIT
// The real <model-viewer> element shows what the cameras for it promise: corners of the model are projected by its camera
// and compared with ours, and its picture's silhouette with best.png.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import * as fs from 'node:fs';
import * as http from 'node:http';
import * as os from 'node:os';
import * as path from 'node:path';
import { after, before, test } from 'node:test';
import { launch } from './browser.mjs';
import { glb } from './glb.mjs';

const size = { width: 400, height: 300 };
const element = path.join(process.env.VANTAGE_MODEL_VIEWER ?? '',
  'node_modules/@google/model-viewer/dist/model-viewer.min.js');
const skip = fs.existsSync(element) ? false : `NOTHING WAS TESTED: ${element} is not there (npm)`;

// A bracket with a foot: nothing in it is symmetric. Boxes as [lowest corner, highest corner].
const boxes = [[[0, 0, 0], [3, 0.4, 1.5]], [[0, 0.4, 0], [0.5, 2.2, 1.1]], [[2.2, 0.4, 0.9], [2.6, 1, 1.3]]];
const sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
const vertices = boxes.flatMap(([low, high]) => [...Array(8).keys()].map(
  (i) => [0, 1, 2].map((k) => ((i >> (2 - k)) & 1 ? high : low)[k])));
const faces = boxes.flatMap((_, b) => sides.flatMap(
  ([p, q, r, s]) => [[p, q, r], [p, r, s]].map((f) => f.map((v) => 8 * b + v))));

let browser;
let server;
let folder;
before(async () => {
  if (skip) {
    return;
  }
  folder = fs.mkdtempSync(path.join(os.tmpdir(), 'model-viewer-'));
  fs.writeFileSync(path.join(folder, 'bracket.glb'), glb(vertices, faces));
  fs.copyFileSync(element, path.join(folder, 'model-viewer.min.js'));
  const types = { '.js': 'text/javascript', '.html': 'text/html', '.glb': 'model/gltf-binary' };
  server = http.createServer((request, response) => {
    const file = path.join(folder, path.normalize(new URL(request.url, 'http://x').pathname));
    if (!fs.existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { 'content-type': types[path.extname(file)] ?? 'image/png' });
    response.end(fs.readFileSync(file));
  });
  await new Promise((ready) => { server.listen(0, '127.0.0.1', ready); });
  browser = await launch();
});
after(async () => {
  await browser?.close();
  server?.close();
  if (folder) {
    fs.rmSync(folder, { recursive: true });
  }
});

function vantage(...options) {
  return vantageOf('bracket.glb', ...options);
}

function vantageOf(file, ...options) {
  execFileSync(process.env.VANTAGE, ['view', path.join(folder, file), '-o', path.join(folder, 'out'), '-q',
    '--no-report', '--contraction', 'exact', '--size', `${size.width}x${size.height}`, ...options]);
  return JSON.parse(fs.readFileSync(path.join(folder, 'out/view.json'), 'utf8'));
}

const axes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1], '-x': [-1, 0, 0], '-y': [0, -1, 0], '-z': [0, 0, -1] };

/** Where our camera puts a point, in pixels, held upright as the element holds it. */
function projected(view, up, point) {
  const minus = (a, b) => a.map((x, k) => x - b[k]);
  const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => a.map((x) => x / Math.hypot(...a));
  const back = unit(minus(view.eye, view.frame.target));
  const upright = cross(axes[up], back);
  const right = Math.hypot(...upright) > 1e-9 ? unit(upright) : cross(view.up, back);  // straight above: the picture's own
  assert.ok(dot(right, unit(cross(view.up, back))) > Math.cos((5 * Math.PI) / 180), 'the picture itself is all but upright');
  const ray = minus(point, view.eye);
  const focal = size.height / 2 / Math.tan((view.frame.fov_y_deg * Math.PI) / 360);
  const depth = -dot(ray, back);
  return [size.width / 2 + (focal * dot(ray, right)) / depth, size.height / 2 - (focal * dot(ray, cross(back, right))) / depth];
}

let shared; // one page, as the element compiles its shaders once in each
/** Shows the line of HTML that the program wrote, as a new element of the picture's size. */
async function open(line) {
  if (!shared) {
    fs.writeFileSync(path.join(folder, 'page.html'), `<!doctype html><script type="module" src="model-viewer.min.js"></script>
<style>body { margin: 0 } model-viewer { width: ${size.width}px; height: ${size.height}px; background: none }</style><body></body>`);
    shared = await browser.newPage({ viewport: size });
    await shared.goto(`http://127.0.0.1:${server.address().port}/page.html`);
  }
  const page = shared;
  await page.evaluate((html) => { document.body.innerHTML = html; }, line.replace(' camera-controls', ''));
  await page.waitForFunction(() => document.querySelector('model-viewer')?.loaded, undefined, { timeout: 60000 });
  await page.evaluate(() => document.querySelector('model-viewer').updateComplete);
  await page.waitForTimeout(300);
  return page;
}

/** Where the element's own camera puts points of the model, in pixels; its scene is behind a symbol. */
function seenAt(page, points) {
  return page.evaluate(({ points: all, width, height }) => {
    const viewer = document.querySelector('model-viewer');
    const scene = viewer[Object.getOwnPropertySymbols(viewer).find((s) => s.description === 'scene')];
    scene.updateMatrixWorld(true);
    scene.camera.updateMatrixWorld(true);
    const model = scene.models[0];
    return all.map((p) => {
      const seen = model.localToWorld(scene.camera.position.clone().set(...p)).project(scene.camera);
      return [(width / 2) * (1 + seen.x), (height / 2) * (1 - seen.y)];
    });
  }, { points, ...size });
}

/** @param place where a corner of the file is in the model that the view is of. */
async function agrees(view, name, file = 'bracket.glb', corners = vertices, place = (p) => p) {
  const page = await open(fs.readFileSync(path.join(folder, `out/camera-${name}.model-viewer.html`), 'utf8')
    .replace(/src="[^"]*"/, `src="${file}"`));
  const theirs = await seenAt(page, corners);
  corners.forEach((p, i) => {
    const ours = projected(view[name], view.up, place(p));
    const off = Math.hypot(theirs[i][0] - ours[0], theirs[i][1] - ours[1]);
    assert.ok(off < 0.01, `${name}, corner ${i}: ${theirs[i]} for ${ours}`);  // pixels
  });
  return page;
}

for (const options of [[], ['--up', 'z', '--fov', '10'], ['--up=-x', '--fov', '60']]) {
  test(`its camera projects the corners as ours does ${options.join(' ')}`, { skip }, async () => {
    const view = vantage('--no-images', ...options);
    for (const name of options.length ? ['best'] : ['best', 'worst']) {
      await agrees(view, name);
    }
  });
}

test('its camera fits the file of a model that --up any has turned', { skip }, async () => {
  const [c, s] = [Math.cos(0.4), Math.sin(0.4)];
  const leaning = vertices.map(([x, y, z]) => [c * x - s * y, s * x + c * y, z]).map(([x, y, z]) => [x, c * y - s * z, s * y + c * z]);
  fs.writeFileSync(path.join(folder, 'leaning.glb'), glb(leaning, faces));
  const view = vantageOf('leaning.glb', '--no-images', '--up', 'any');
  const [x, y, z, w] = view.warnings.join().match(/quaternion ([^(]+)/)[1].trim().split(' ').map(Number);
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const stood = (p) => {
    const once = cross([x, y, z], p);
    const twice = cross([x, y, z], once);
    return p.map((v, k) => v + 2 * (w * once[k] + twice[k]));
  };
  await agrees(view, 'best', 'leaning.glb', leaning, stood);
});

test('its picture has the silhouette of best.png', { skip }, async () => {
  const view = vantage();
  const page = await agrees(view, 'best');
  const shot = await page.screenshot({ omitBackground: true });
  const shares = await page.evaluate(async ({ sources, width, height }) => {
    const masks = [];
    for (const source of sources) {
      const image = await createImageBitmap(await (await fetch(source)).blob());
      const canvas = new OffscreenCanvas(width, height).getContext('2d');
      canvas.drawImage(image, 0, 0);
      masks.push(canvas.getImageData(0, 0, width, height).data.filter((_, i) => i % 4 === 3).map((a) => a > 127));
    }
    let both = 0;
    let either = 0;
    masks[0].forEach((a, i) => { both += a & masks[1][i]; either += a | masks[1][i]; });
    return both / either;
  }, { sources: [`data:image/png;base64,${shot.toString('base64')}`, 'out/best.png'], ...size });
  assert.ok(shares > 0.98, `${shares} of the silhouette`);
});

test('the page of a collection shows its models from their best views', { skip }, async () => {
  await shared?.close(); // what is seen no more is drawn no more
  fs.mkdirSync(path.join(folder, 'in'));
  fs.copyFileSync(path.join(folder, 'bracket.glb'), path.join(folder, 'in/bracket.glb'));
  fs.writeFileSync(path.join(folder, 'in/slope.obj'), 'v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n');
  execFileSync(process.env.VANTAGE, ['batch', 'in', '-o', 'results', '--write', 'best,json', '-q', '--size',
    `${size.width}x${size.height}`, '--contraction', 'exact'], { cwd: folder });
  execFileSync('python3', [path.resolve('../../examples/web/collection_page.py'), 'results', '-o', 'collection.html',
    '--element', 'model-viewer.min.js'], { cwd: folder });
  const page = await browser.newPage({ viewport: { width: 700, height: 400 } });
  await page.goto(`http://127.0.0.1:${server.address().port}/collection.html`);
  await page.waitForFunction(() => document.querySelector('model-viewer')?.loaded, undefined, { timeout: 60000 });
  const orbit = await page.evaluate(async () => {
    const read = () => {
      const { theta, phi, radius } = document.querySelector('model-viewer').getCameraOrbit();
      return { theta, phi, radius };
    };
    for (let last = read(); ;) { // the element glides to where its camera shall be: frames come late on a busy machine
      await new Promise((done) => { setTimeout(done, 300); });
      const now = read();
      if (JSON.stringify(now) === JSON.stringify(last)) {
        return now;
      }
      last = now;
    }
  });
  const [view] = fs.readdirSync(path.join(folder, 'results/models')).filter((name) => name.startsWith('bracket'))
    .map((name) => JSON.parse(fs.readFileSync(path.join(folder, 'results/models', name, 'view.json'), 'utf8')));
  const wanted = view.best.model_viewer['camera-orbit'].split(' ').map(Number.parseFloat);
  const degrees = 180 / Math.PI;
  const turned = ((orbit.theta * degrees - wanted[0] + 540) % 360) - 180;  // a whole turn is none
  assert.ok(Math.abs(turned) < 0.01 && Math.abs(orbit.phi * degrees - wanted[1]) < 0.01, `${JSON.stringify(orbit)} for ${wanted}`);
  assert.ok(Math.abs(orbit.radius / wanted[2] - 1) < 1e-5);
  assert.equal(await page.evaluate(() => [...document.images].every((i) => i.complete && i.naturalWidth > 0)), true);
  await page.close();
});
