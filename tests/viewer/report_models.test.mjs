// SPDX-License-Identifier: MIT
// report.html in real Chromium, of models and options that change what it shows.
import assert from 'node:assert/strict';
import * as fs from 'node:fs';
import * as path from 'node:path';
import { before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import * as zlib from 'node:zlib';
import { glb } from './glb.mjs';
import { blenderLocation, camera, cameraText, cameraTexts, clickSphere, desktop, distance, drawn, folder, models, pageOf, pixels, unit,
  vantage, viewOf } from './report.mjs';

const horse = path.join(models, 'horse.ply');
const markup = '<img src=x onerror=document.title=1>&<!--<script>';
// Small pictures: no test looks at them.
const rapid = ['--search', 'rapid', '--size', '160x120'];
const reports = {
  far: [horse, ...rapid, '--distance', '60'],
  flat: [horse, ...rapid, '--projection', 'orthographic'],
  // Maximises what people choose; a rapid search maximises the score.
  people: [`${markup}.ply`, '--size', '160x120', '--crease', '0'],
  soup: ['soup.obj', ...rapid, '--views', '40', '--contraction', 'exact'],
  row: ['row.obj', ...rapid, '--focus', 'b1', '--projection', 'orthographic'],
  lamp: ['lamp.glb', '--size', '160x120', '--contraction', 'exact', '--search', 'rapid'],
  box: ['box.obj', '--up', 'any', '--size', '160x120', '--contraction', 'exact'],
  ball: ['ball.obj', ...rapid],
  cloud: ['cloud.xyz', ...rapid],
  speck: ['speck.obj', ...rapid, '--contraction', 'exact'],
  // In the axes of glTF, as those of <model-viewer>.
  lampFlat: ['lamp.glb', ...rapid, '--projection', 'orthographic', '--contraction', 'exact'],
  large: [path.join(process.env.VANTAGE_DATA ?? '', 'paper', 'armadillo_172966_loop.ply'), ...rapid],
};

/** The page of a report, and what its view.json says. */
async function opened(name) {
  if (!fs.existsSync(path.join(folder, name))) {
    vantage('view', ...reports[name], '-o', name);
  }
  return [await pageOf(name), viewOf(name)];
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

/** A box that leans, and whose sides show redAndBlue(). */
function writeBox() {
  const [c, s] = [Math.cos(0.4), Math.sin(0.4)];
  const corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
    .map((corner) => corner.map((bit, k) => 5 + (k + 1) * bit))
    .map(([x, y, z]) => [c * x - s * y, s * x + c * y, z]).map(([x, y, z]) => [x, c * y - s * z, s * y + c * z]);
  const sides = [[4, 3, 2, 1], [5, 6, 7, 8], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8]];
  fs.writeFileSync(path.join(folder, 'box.png'), redAndBlue());
  fs.writeFileSync(path.join(folder, 'box.mtl'), 'newmtl two\nKd 1 1 1\nmap_Kd box.png\n');
  fs.writeFileSync(path.join(folder, 'box.obj'), ['mtllib box.mtl', ...corners.map((p) => `v ${p.join(' ')}`),
    'vt 0 0', 'vt 1 0', 'vt 1 1', 'vt 0 1', 'usemtl two',
    ...sides.map((side) => `f ${side.map((v, k) => `${v}/${k + 1}`).join(' ')}`), ''].join('\n'));
}

/** A black tetrahedron that shines in green. */
function writeLamp() {
  const corners = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
  fs.writeFileSync(path.join(folder, 'lamp.glb'), glb(corners, [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
    { pbrMetallicRoughness: { baseColorFactor: [0, 0, 0, 1] }, emissiveFactor: [0, 0.5, 0] }));
}

/** Small walls in the sun, each of which hides others: many views are needed. */
function writeSoup(count) {
  const walls = [];
  const faces = [];
  for (let i = 0; i < count; ++i) {
    const z = 1 - (2 * i + 1) / count;
    const [r, turn, away] = [Math.sqrt(1 - z * z), i * 2.399963, 0.3 + 0.7 * ((i * 0.618034) % 1)];
    const middle = [away * r * Math.cos(turn), away * r * Math.sin(turn), away * z];
    for (const corner of [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) {
      walls.push(`v ${middle.map((x, k) => (x + 0.09 * corner[k]).toFixed(6)).join(' ')}`);
    }
    faces.push(...[[1, 2, 3], [1, 4, 2], [1, 3, 4], [2, 4, 3]].map((f) => `f ${f.map((v) => v + 4 * i).join(' ')}`));
  }
  fs.writeFileSync(path.join(folder, 'soup.obj'), [...walls, ...faces, ''].join('\n'));
}

/** A ball of 2 n² faces. \param placed where its points are put. \param flip every so manieth face is wound the other way. */
function ball(n, placed, flip) {
  const at = (i, j) => i * 2 * n + (j % (2 * n)) + 1;
  const rows = Array.from({ length: n + 1 }, (_, i) => i);
  const turns = Array.from({ length: 2 * n }, (_, j) => j);
  const corners = rows.flatMap((i) => turns.map((j) => [(Math.PI * i) / n, (Math.PI * j) / n]))
    .map(([t, p]) => placed([Math.sin(t) * Math.cos(p), Math.cos(t), Math.sin(t) * Math.sin(p)]));
  const faces = rows.slice(0, n).flatMap((i) => turns.flatMap((j) => [
    ...(i > 0 ? [[at(i, j), at(i, j + 1), at(i + 1, j)]] : []),
    ...(i + 1 < n ? [[at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)]] : [])]));
  return [...corners.map((p) => `v ${p.map((x) => x.toFixed(7)).join(' ')}`),
    ...faces.map(([a, b, c], f) => (f % flip === 0 ? `f ${a} ${c} ${b}` : `f ${a} ${b} ${c}`)), ''].join('\n');
}

function writeBalls() {
  fs.writeFileSync(path.join(folder, 'ball.obj'), ball(24, (p) => p, 11));
  const spiral = Array.from({ length: 3000 }, (_, i) => {
    const z = 1 - (2 * i + 1) / 3000;
    return [Math.sqrt(1 - z * z) * Math.cos(2.399963 * i), Math.sqrt(1 - z * z) * Math.sin(2.399963 * i), z];
  });
  fs.writeFileSync(path.join(folder, 'cloud.xyz'), spiral.map((p) => `${p.join(' ')}\n`).join(''));
  const ends = 'v -1 0 0\nv 1 0 0\nv 0 1 0\n'; // of a plate as large as the sphere
  const small = ball(8, (p) => [0.31 + 0.004 * p[0], -0.29 + 0.004 * p[1], 0.33 + 0.004 * p[2]], Infinity);
  fs.writeFileSync(path.join(folder, 'speck.obj'), `${small}${ends}f -3 -2 -1\n`);
}

before(() => {
  writeBalls();
  fs.copyFileSync(horse, path.join(folder, `${markup}.ply`));
  writeSoup(340);
  writeBox();
  writeLamp();
});

/** Share of the window's height that is drawn on. */
const drawnHeight = (page) => pixels(page, ({ data, width, height }) => {
  let rows = 0;
  for (let y = 0; y < height; ++y) {
    rows += data.subarray(4 * width * y, 4 * width * (y + 1)).some((a, i) => i % 4 === 3 && a > 0) ? 1 : 0;
  }
  return rows / height;
});

for (const name of ['far', 'flat']) {
  test(`stands at the view's eye and shows the whole model with ${reports[name].slice(-2).join(' ')}`, async () => {
    const [page, json] = await opened(name);
    const seen = await camera(page);
    const line = json.best.eye.map((x, i) => x - json.best.frame.target[i]);
    const away = name === 'far' ? line : seen.eye.map((x, i) => x - json.best.frame.target[i]); // of parallel lines any is right
    const eye = json.best.frame.target.map((x, i) => x + away[i]);
    assert.ok(distance(seen.eye, eye) < 1e-4 * Math.hypot(...away), seen.eye.join(' '));
    assert.ok(distance(seen.back, name === 'far' ? unit(line) : json.best.direction) < 1e-4, seen.back.join(' '));
    const narrow = Math.max(1, (json.best.size[0] / json.best.size[1]) / await page.evaluate(() => window.vantage.model.aspect));
    const share = narrow * await drawnHeight(page); // of the picture's height; the rest is margin
    assert.ok(share > 0.6 && share <= 1, `${share} of the height`);
    const location = blenderLocation(await cameraText(page, 'Blender'));
    assert.ok(distance(location, seen.eye) < 1e-4 * Math.hypot(...away), location.join(' '));
    const scale = (await cameraText(page, 'Blender')).match(/ortho_scale = (.+)/)?.[1];
    assert.equal(scale === undefined, name === 'far');
    assert.ok(scale === undefined || Math.abs(Number(scale) - json.best.frame.height) < 1e-5 * json.best.frame.height, scale);
    await clickSphere(page);
    assert.ok(await drawnHeight(page) > 0.3);
  });
}

test('keys zoom no further than to where the model is still seen, and back', async () => {
  const [page] = await opened('flat');
  const press = (key) => page.evaluate((pressed) => {
    for (let i = 0; i < 400; ++i) {
      document.body.dispatchEvent(new KeyboardEvent('keydown', { key: pressed, bubbles: true }));
    }
  }, key);
  await press('+');
  assert.ok(await drawnHeight(page) > 0.9);
  await press('-');
  const low = await drawnHeight(page);
  assert.ok(low > 0.01 && low < 0.5, String(low));
  for (let i = 0; i < 30; ++i) {
    await page.keyboard.press('+');
  }
  assert.ok(await drawnHeight(page) > 2 * low);
});

test('a name with markup is shown as text', async () => {
  const [page] = await opened('people');
  assert.equal(await page.textContent('#name'), markup);
});

test('has facets where pictures have them', async () => {
  const [page] = await opened('people');
  const smooth = await page.evaluate(() => ['mesh', 'history'].map((part) => {
    const { geometry } = window.vantage.model[part].mesh ?? window.vantage.model[part];
    const normal = geometry.attributes.normal;
    const at = (corner) => [0, 1, 2].map((axis) => normal.array[3 * geometry.index.array[corner] + axis]).join();
    return Array.from({ length: geometry.index.count / 3 }, (_, f) => 3 * f).filter((c) => at(c) !== at(c + 1) || at(c) !== at(c + 2)).length;
  }));
  assert.deepEqual(smooth, [0, 0]);
});

test('who comes back to the page finds its controls as what is shown', async () => {
  const [page] = await opened('people');
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
});

test('the sphere shows what best maximises until it is switched to the score', async () => {
  const [page, { best, twins }] = await opened('people');
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
  const label = () => page.getAttribute('#sphere', 'aria-label');
  assert.match(await label(), /by what the best view maximises;/);
  await page.check('input[name=sphere][value=score]');
  assert.match(await label(), /by its score;/);
  assert.deepEqual(await highest(), await page.evaluate(() => {
    const { directions, scores } = window.vantage.data.sphere;
    return directions[scores.indexOf(Math.max(...scores))];
  }));
});

for (const name of ['people', 'flat']) {
  test(`a flight that is taken over stays as it is seen: ${name}`, async () => {
    const [page] = await opened(name);
    await page.click('#reset');
    await page.emulateMedia({ reducedMotion: 'no-preference' });
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
    await page.setViewportSize({ ...desktop, width: desktop.width - 1 });
    await page.waitForFunction((width) => document.getElementById('model').clientWidth < width, box.width);
    await drawn(page);
    const [, resized] = await seen();
    assert.ok(Math.abs(resized / lens - 1) < 0.005, `${name}: ${lens} ${resized}`);
    if (name === 'flat') { // zooms by its lens, which goes on from where it is
      const whole = await page.evaluate(() => window.vantage.data.views[1].height / 2);
      assert.ok(lens > near && lens < whole, `${near} ${lens} ${whole}`);
      assert.equal(await page.evaluate(() => window.vantage.model.camera.zoom), 1);
    }
  });
}

test('the tour tells of all its views, though the strip has but the first', async () => {
  const [page, { views }] = await opened('soup');
  assert.ok(views.length > 24, String(views.length));
  assert.match(await page.textContent('#tour-text'), new RegExp(`° over ${views.length} views$`));
});

test("shows a file's own texture", async () => {
  const [page] = await opened('box');
  await page.waitForFunction(() => window.vantage.model.loading === 0);
  const sides = () => pixels(page, ({ data }) => {
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
});

test("shows a file's own light", async () => {
  const [page] = await opened('lamp');
  const [green, red] = await pixels(page, ({ data }) => {
    let count = 0;
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      const isGreen = data[i + 1] > 150 && data[i + 1] > 2 * data[i] && data[i + 1] > 2 * data[i + 2];
      count += isGreen ? 1 : 0;
      sum += isGreen ? data[i] : 0;
    }
    return [count, sum / count];
  });
  assert.ok(green > 10000, String(green));
  assert.ok(red > 25, String(red)); // 12 is what black reflects
});

test('cameras that name the file fit it where --up any has turned the model', async () => {
  const [page, json] = await opened('box');
  const line = await cameraText(page, 'f3d');
  assert.equal(line, fs.readFileSync(path.join(folder, 'box/camera-best.f3d.txt'), 'utf8'));
  const eye = line.match(/position=(\S+)/)[1].split(',').map(Number);
  assert.ok(distance(eye, json.best.eye) > 1, 'the model was turned');
  const location = blenderLocation(await cameraText(page, 'Blender'));
  assert.ok(distance(location, [eye[0], -eye[2], eye[1]]) < 1e-4, location.join(' '));
});

for (const name of ['ball', 'cloud']) {
  test(`a ball looks smooth, whichever way its faces are wound, and as it is contracted: ${name}`, async () => {
    const [page] = await opened(name);
    const steps = () => pixels(page, ({ data, width, height }) => { // of brightness from pixel to pixel, away from the outline
      let rough = 0;
      let count = 0;
      for (let y = 4; y + 4 < height; ++y) {
        for (let x = 4; x + 4 < width; ++x) {
          const i = 4 * (y * width + x);
          if ([-16, 16, -16 * width, 16 * width].every((away) => data[i + away + 3] === 255)) {
            rough += Math.abs(data[i] - data[i + 4]) > 12 ? 1 : 0;
            count += 1;
          }
        }
      }
      return count > 10000 ? rough / count : Infinity;
    });
    for (const level of [0, 0.5, 1]) {
      await page.evaluate((to) => window.vantage.model.setLevel(to), level);
      const rough = await steps();
      assert.ok(rough < 2e-4, `level ${level}: ${rough}`);
    }
  });
}

test('small parts have normals of their own', async () => {
  const [page, { model }] = await opened('speck');
  const least = await page.evaluate(() => {
    const { geometry } = window.vantage.model.mesh;
    const { position, normal } = geometry.attributes;
    const faces = window.vantage.data.mesh.faces;
    const at = (of, corner) => [0, 1, 2].map((axis) => of.array[3 * (geometry.index ? geometry.index.array[corner] : corner) + axis]);
    const corners = Array.from({ length: 3 * (faces - 1) }, (_, c) => c); // the plate is the last face
    const points = corners.map((c) => at(position, c));
    const middle = [0, 1, 2].map((axis) => {
      const all = points.map((p) => p[axis]);
      return (Math.min(...all) + Math.max(...all)) / 2;
    });
    return Math.min(...corners.map((c, i) => {
      const out = points[i].map((x, axis) => x - middle[axis]);
      return Math.abs(at(normal, c).reduce((sum, x, axis) => sum + x * out[axis], 0)) / Math.hypot(...out);
    }));
  });
  assert.ok(model.faces > 100);
  assert.ok(least > 0.99, String(least));
});

test('a cloud has points, and no camera for programs that do not read it', async () => {
  const [page] = await opened('cloud');
  assert.equal(await page.textContent('#summary'), '3,000 points');
  assert.match(await page.textContent('#numbers'), /shown herefaces made between the points, for display/);
  assert.deepEqual([...(await cameraTexts(page)).keys()], ['glTF', 'NeRF transforms.json']);
  assert.notEqual(await page.inputValue('#camera'), '');
});

test('a camera for model-viewer is there of glTF, unless lines of sight are parallel', async () => {
  const [page, json] = await opened('lamp');
  const files = fs.readdirSync(path.join(folder, 'lamp')).filter((name) => name.startsWith('camera-best.'));
  const texts = await cameraTexts(page);
  for (const name of files) {
    assert.ok([...texts.values()].includes(fs.readFileSync(path.join(folder, 'lamp', name), 'utf8')), name);
  }
  const numbers = (name) => texts.get('model-viewer').match(new RegExp(`${name}="([^"]+)"`))[1].split(' ').map(parseFloat);
  const [theta, phi, away] = numbers('camera-orbit');
  const target = numbers('camera-target');
  const [t, p] = [theta, phi].map((x) => (x * Math.PI) / 180);
  const eye = [Math.sin(p) * Math.sin(t), Math.cos(p), Math.sin(p) * Math.cos(t)].map((x, i) => target[i] + away * x);
  assert.equal(json.up, 'y'); // so that its axes are those of glTF
  assert.ok(distance(eye, json.best.eye) < 1e-4 * json.camera.distance, eye.join(' '));
  const [flat] = await opened('lampFlat');
  assert.ok(!(await cameraTexts(flat)).has('model-viewer'));
});

test('shows a large model within seconds', { skip: process.env.VANTAGE_DATA ? false : 'NOTHING WAS TESTED: VANTAGE_DATA is not set' }, async () => {
  const [page] = await opened('large');
  assert.match(await page.textContent('#numbers'), /shown here/);
  assert.match(await page.textContent('#numbers'), /more where significance is high/);
  assert.ok(fs.statSync(path.join(folder, 'large', 'report.html')).size < 40e6);
  console.log(`# 173 000 vertices loaded in ${page.loadSeconds} s`);
});

test('the replayed search is compared with the score that it looks for', async () => {
  const [page, { highest_score: highest, best, worst }] = await opened('people');
  assert.ok(highest.score > 1.01 * best.score, 'people take another view than the one of the highest score');
  const found = async () => Number((await page.textContent('#replay-text')).match(/ found: ([\d.]+)$/)[1]);
  assert.ok(Math.abs((await found()) - highest.score) < 1e-3 * highest.score);
  await page.check('input[name=goal][value=worst]');
  assert.ok(Math.abs((await found()) - worst.score) < 1e-3 * worst.score);
});

test('an orthographic view of an object beside the middle tells its own direction', async () => {
  const box = (x, n) => ['o b' + n, ...[0, 1, 2, 3, 4, 5, 6, 7].map((i) => `v ${x + (i & 1)} ${(i >> 1) & 1} ${i >> 2}`),
    ...['1 3 4 2', '5 6 8 7', '1 2 6 5', '3 7 8 4', '1 5 7 3', '2 4 8 6'].map((f) => 'f ' + f.split(' ').map((k) => Number(k) + 8 * n).join(' '))];
  fs.writeFileSync(path.join(folder, 'row.obj'), [...box(0, 0), ...box(9, 1), ''].join('\n'));
  const [page, { best }] = await opened('row');
  const told = (await page.textContent('#direction')).match(/direction (.+)\n/)[1].split(', ').map(Number);
  assert.ok(distance(told, best.direction) < 2e-3, `${told} ${best.direction}`);
});
