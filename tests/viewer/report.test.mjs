// SPDX-License-Identifier: MIT
// report.html in real Chromium: what the reader does, checked against view.json and the pictures.
import assert from 'node:assert/strict';
import * as fs from 'node:fs';
import * as path from 'node:path';
import { before, test } from 'node:test';
import { complaints } from './browser.mjs';
import { blenderLocation, camera, cameraText, cameraTexts, clickSphere, distance, drawn, folder, fresh, models, pixels, unit, vantage,
  viewOf, waitForFlight } from './report.mjs';

const out = path.join(folder, 'result');
let view;

before(() => {
  vantage('view', path.join(models, 'horse.ply'), '-o', out, '--search', 'rapid', '--views', '4');
  view = viewOf('result');
});

const opened = (size) => fresh('result', size);

test('opens from disk without errors, warnings or requests', async () => {
  const page = await opened();
  assert.deepEqual(complaints, []);
  assert.equal(await page.textContent('#name'), 'horse');
  assert.equal(await page.locator('.view').count(), 2 + 3); // the best is the first of the four
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
  // The 3D part is as large as the picture: 360 px of panel beside it, bars above and below.
  const [wide, high] = view.best.size;
  const page = await opened({ width: wide + 360, height: high + 100 });
  const bars = await page.evaluate(() => window.innerHeight - document.getElementById('window').getBoundingClientRect().height);
  await page.setViewportSize({ width: wide + 360, height: high + Math.round(bars) });
  await page.waitForFunction((h) => Math.abs(document.getElementById('model').clientHeight - h) <= 1, high);
  await drawn(page);
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
});

test('the slider plays the history: the last level is thinner than the first', async () => {
  const page = await opened();
  const area = () => pixels(page, ({ data }) => data.filter((_, i) => i % 4 === 3).reduce((n, a) => n + (a > 0 ? 1 : 0), 0));
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
});

test('the map gives the surface its colours, and they can be switched off', async () => {
  const page = await opened();
  const spread = () => pixels(page, ({ data }) => {
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
  await clickSphere(page);
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

test('where the replayed search ends, its score is told', async () => {
  const page = await opened();
  await page.check('input[name=goal][value=worst]');
  await page.click('#replay');
  const [, end] = (await page.textContent('#replay-text')).match(/ends at about ([\d.]+)/);
  const [, here] = (await page.textContent('#direction')).match(/score about ([\d.]+)/);
  assert.equal(here, end);
});

test('keys turn the model, pick views and toggle what is shown', async () => {
  const page = await opened();
  await page.focus('#model');
  const start = (await camera(page)).eye;
  await page.keyboard.press('ArrowRight');
  assert.ok(distance(start, (await camera(page)).eye) > 0.01);
  // A digit is the one on the button.
  for (const [key, of] of [['w', view.worst], ['2', view.views[1]], ['3', view.views[2]], ['1', view.best]]) {
    await page.keyboard.press(key);
    await waitForFlight(page);
    assert.ok(distance((await camera(page)).eye, of.eye) < 1e-4 * (await camera(page)).radius, key);
  }
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
  const page = await opened();
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  // At once: a busy machine may answer only when the flight is over.
  assert.notEqual(await page.evaluate(() => {
    document.querySelector('.view[data-view=worst]').click();
    return window.vantage.model.flight;
  }), undefined);
  await waitForFlight(page);
  const seen = await camera(page);
  assert.ok(distance(seen.eye, view.worst.eye) < 1e-5 * seen.radius);
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
  // A key that is held down, for 36 steps of 5°.
  await Promise.all(Array.from({ length: 36 }, () => page.keyboard.press('ArrowUp')));
  const high = await camera(page);
  await page.keyboard.press('ArrowUp');
  const higher = await camera(page);
  assert.ok(high.back[1] > 0.999 && distance(high.eye, higher.eye) < 1e-3 * high.radius, high.back.join(' '));
  assert.ok(distance(high.right, higher.right) < 1e-3);
  const away = ({ eye, radius }) => distance(eye, view.camera.target) / radius;
  await page.keyboard.press('+');
  assert.ok(away(await camera(page)) < 0.95 * away(higher));
});

test('hiding the significance ends the contraction that is played', async () => {
  const page = await opened();
  await page.keyboard.press(' ');
  await page.waitForFunction(() => window.vantage.model.level > 0);
  await page.keyboard.press('k');
  await drawn(page);
  assert.equal(await page.evaluate(() => window.vantage.model.level), 0);
});

test('a slider that is taken hold of ends the play', async () => {
  const page = await opened();
  await page.keyboard.press(' ');
  await page.waitForFunction(() => window.vantage.model.level > 0);
  await page.fill('#level', '1');
  assert.equal(await page.textContent('#play'), '▶');
  await drawn(page);
  assert.equal(await page.evaluate(() => window.vantage.model.level), 1);
});

test('a tour can be stopped on the way to its start', async () => {
  const page = await opened();
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  await page.click('.view[data-view=worst]');
  await waitForFlight(page);
  const press = () => page.evaluate(() => { // at once: a busy machine may answer only when the flight is over
    document.getElementById('tour').click();
    document.getElementById('tour').click();
  });
  await press();
  assert.equal(await page.evaluate(() => window.vantage.model.flight), undefined);
  assert.equal(await page.textContent('#tour'), '▶ Tour');
});

test('the tour goes from view to view where motion is unwelcome', async () => {
  const page = await opened();
  const seen = await page.evaluate(() => {
    const { model, data } = window.vantage;
    const { requestAnimationFrame, cancelAnimationFrame } = window;
    const frames = new Map(); // of a clock that is turned by hand
    let last = 0;
    window.requestAnimationFrame = (step) => {
      last += 1;
      frames.set(last, step);
      return last;
    };
    window.cancelAnimationFrame = (id) => frames.delete(id);
    model.draw = () => {}; // nothing is looked at
    const start = performance.now();
    const places = new Set();
    document.getElementById('tour').click();
    for (let seconds = 0; seconds < 12; seconds += 0.1) { // a round takes 10
      const due = [...frames.values()];
      frames.clear();
      due.forEach((step) => step(start + 1000 * seconds));
      places.add(JSON.stringify(model.camera.position.clone().normalize().toArray()));
    }
    model.stop();
    [...frames.values()].forEach((step) => step(start));
    delete model.draw;
    Object.assign(window, { requestAnimationFrame, cancelAnimationFrame });
    return [[...places].map((place) => JSON.parse(place)), data.views.map(({ direction }) => direction)];
  });
  const [places, [best, , ...others]] = seen;
  assert.equal(places.length, 4);
  for (const direction of [best, ...others]) {
    assert.ok(Math.min(...places.map((place) => distance(place, direction))) < 0.05, direction.join(' '));
  }
});

test('the tour goes on until something else is asked for', async () => {
  const page = await opened();
  await page.emulateMedia({ reducedMotion: 'no-preference' });
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
});

test('every camera format of the result folder is in the box', async () => {
  const page = await opened();
  const texts = await cameraTexts(page);
  const web = 'camera-best.model-viewer.html'; // of glTF alone, and the horse is a PLY
  const cameras = fs.readdirSync(out).filter((name) => name.startsWith('camera-best.') && name !== web);
  assert.ok(cameras.length >= 3, cameras.join(' '));
  for (const name of cameras) {
    assert.ok([...texts.values()].includes(fs.readFileSync(path.join(out, name), 'utf8')), name);
  }
  assert.equal(new Set(texts.values()).size, cameras.length + 1); // and a script for Blender, which is no file
  assert.match(texts.get('Blender'), /bpy/);
});

test('the camera box holds the file that view wrote', async () => {
  const page = await opened();
  assert.equal(await cameraText(page, 'NeRF transforms.json'),
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

test('a sphere of the score alone has no switch', async () => {
  const page = await opened();
  assert.equal(await page.locator('#sphere-of').count(), 0);
});

test('reset brings back the page as it was opened', async () => {
  const page = await opened();
  const first = (await camera(page)).eye;
  await page.click('.view[data-view=worst]');
  await waitForFlight(page);
  await page.click('#show-map');
  await page.click('#show-skeleton');
  const search = () => page.evaluate(() => [document.querySelector('input[name=goal]:checked').value,
    ...['epsilon', 'format'].map((id) => document.getElementById(id).value), document.getElementById('replay-text').textContent,
    document.getElementById('camera').value, window.vantage.sphere.path.geometry.attributes.position.count]);
  const asOpened = await search();
  await page.check('input[name=goal][value=worst]');
  await page.fill('#epsilon', '3');
  await page.selectOption('#format', 'glTF');
  assert.notDeepEqual(await search(), asOpened);
  await page.click('#reset');
  await waitForFlight(page);
  const seen = await camera(page);
  await page.click('.view[data-view=worst]');
  await waitForFlight(page);
  assert.deepEqual(await search(), asOpened);
  await page.click('#reset');
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

test("a camera for Blender stands at the view's eye", async () => {
  const page = await opened();
  const location = blenderLocation(await cameraText(page, 'Blender'));
  assert.ok(distance(location, view.best.eye) < 1e-4 * view.camera.distance, location.join(' '));
});

test('keys go on working after a camera was copied', async () => {
  const page = await opened();
  await page.click('#copy');
  await page.waitForFunction(() => document.getElementById('copy').textContent === 'Copied');
  await page.keyboard.press('k');
  assert.equal(await page.isChecked('#show-map'), true);
  await page.focus('#camera'); // nothing can be typed there
  await page.keyboard.press('k');
  assert.equal(await page.isChecked('#show-map'), false);
});

test('space plays the contraction while its slider has the focus', async () => {
  const page = await opened();
  await page.click('#show-map');
  await page.focus('#level');
  await page.keyboard.press(' ');
  await page.waitForFunction(() => window.vantage.model.level > 0);
});

test('a view counts as shown until the reader leaves it', async () => {
  const page = await opened();
  const shown = () => page.locator('.view[aria-pressed=true]').evaluateAll((all) => all.map((one) => one.dataset.view));
  assert.deepEqual(await shown(), ['best']);
  const box = await page.locator('#model').boundingBox();
  await page.mouse.click(box.x + 200, box.y + 300);
  assert.deepEqual(await shown(), ['best']); // which turned nothing
  await page.keyboard.press('ArrowRight');
  assert.deepEqual(await shown(), []);
  await page.click('.view[data-view=worst]');
  assert.deepEqual(await shown(), ['worst']);
  await page.mouse.move(box.x + 200, box.y + 300);
  await page.mouse.down();
  await page.mouse.move(box.x + 420, box.y + 300, { steps: 8 });
  await page.mouse.up();
  assert.deepEqual(await shown(), []);
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  // At once: a busy machine may answer only when the flight is over.
  await page.evaluate(() => {
    document.querySelector('.view[data-view=worst]').click();
    window.vantage.model.controls.dispatchEvent({ type: 'start' });
  });
  assert.deepEqual(await shown(), []);
});

test('a view that is shown has one score, and elsewhere an estimate', async () => {
  const page = await opened();
  for (const [of, name] of [[view.best, 'best'], [view.worst, 'worst'], [view.views[1], '2']]) {
    await page.click(`.view[data-view="${name}"]`);
    await waitForFlight(page);
    const [, score] = (await page.textContent('#direction')).match(/score ([\d.]+) \(/) ?? [];
    assert.equal(score, (await page.textContent(`.view[data-view="${name}"] small`)).split(' ')[0]);
    assert.ok(Math.abs(score - of.score) < 1e-3 * of.score, name);
  }
  await page.keyboard.press('ArrowRight');
  assert.match(await page.textContent('#direction'), /score about [\d.]+ \(/);
});
