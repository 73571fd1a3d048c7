// SPDX-License-Identifier: MIT
// report.html in windows of any size, with fingers, and where something is missing that it needs.
import assert from 'node:assert/strict';
import * as path from 'node:path';
import { before, test } from 'node:test';
import { camera, distance, drawn, fresh, models, vantage } from './report.mjs';

const phone = { hasTouch: true, isMobile: true };

before(() => vantage('view', path.join(models, 'horse.ply'), '-o', 'result', '--search', 'rapid', '--views', '4', '--size', '160x120'));
const opened = (size, device) => fresh('result', size, device);

test('the model stays in sight while the window is resized', async () => {
  const page = await opened();
  const seen = await page.evaluate(() => new Promise((resolve) => {
    const { canvas } = window.vantage.model;
    const small = Object.assign(document.createElement('canvas'), { width: 32, height: 32 }).getContext('2d', { willReadFrequently: true });
    const stage = document.getElementById('stage');
    const shown = [];
    // Observers are called in their order, after the page's own: what is in the canvas then is shown.
    new ResizeObserver((_, observer) => {
      small.clearRect(0, 0, 32, 32);
      small.drawImage(canvas, 0, 0, 32, 32);
      shown.push(small.getImageData(0, 0, 32, 32).data.some((value) => value > 0));
      if (shown.length === 4) {
        observer.disconnect();
        stage.style.width = '';
        resolve(shown);
      } else {
        requestAnimationFrame(() => { stage.style.width = `${600 - 20 * shown.length}px`; });
      }
    }).observe(canvas.parentElement);
  }));
  assert.deepEqual(seen, [true, true, true, true]);
});

for (const width of [390, 850, 1280]) {
  test(`at ${width} px nothing lies over the model or over another control`, async () => {
    const page = await opened({ width, height: 844 }, width === 390 ? phone : {});
    await page.click('#show-map');
    const boxes = await page.locator('#window, #tools, #legend, #actions button').evaluateAll((all) => all
      .map((one) => [one.id, one.getBoundingClientRect()]).map(([id, { left, right, top, bottom }]) => ({ id, left, right, top, bottom })));
    assert.equal(boxes.length, 5);
    const apart = (a, b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
    boxes.forEach((a, i) => boxes.slice(i + 1).forEach((b) => assert.ok(apart(a, b), JSON.stringify([a, b]))));
    assert.ok(boxes[1].bottom - boxes[1].top > 300, JSON.stringify(boxes[1]));
  });
}

test('a finger turns the model', async () => {
  const page = await opened({ width: 390, height: 844 }, phone);
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
});

for (const width of [390, 1280]) {
  test(`at ${width} px all that is pressed is at least 44 px high`, async () => {
    const page = await opened({ width, height: 844 }, width === 390 ? phone : {});
    await page.click('#show-map');
    const low = await page.locator('button, select, label, input[type=range]').evaluateAll((all) => all
      .filter((one) => one.getClientRects().length > 0 && one.getBoundingClientRect().height < 44)
      .map((one) => one.outerHTML.slice(0, 60)));
    assert.deepEqual(low, []);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
  });
}

test('without WebGL there are the pictures and their cameras', async () => {
  const first = await opened();
  const page = await first.context().newPage();
  await page.addInitScript(() => {
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function other(type, ...rest) {
      return /webgl/.test(type) ? null : getContext.call(this, type, ...rest);
    };
  });
  await page.goto(first.url());
  assert.equal(await page.locator('.view').count(), 2 + 3);
  assert.match(await page.locator('#stage').innerText(), /^This browser draws nothing in 3D/);
  const shown = () => page.getAttribute('#still', 'src');
  const best = await shown();
  await page.keyboard.press('w');
  assert.match(await page.textContent('#camera-of'), /worst/);
  assert.ok(best.startsWith('data:image/png') && await shown() !== best);
  await page.keyboard.press('d');
  assert.equal(await page.getAttribute('html', 'data-theme'), 'dark');
  for (const dead of ['#tools', '#reset', '#tour', '#sphere', '#replay']) {
    assert.equal(await page.isVisible(dead), false, dead);
  }
  await page.close();
});

test('without JavaScript the page says what it needs', async () => {
  const first = await opened();
  const context = await first.context().browser().newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.goto(first.url());
  assert.match((await page.locator('body').innerText()).trim(), /^Vantage\s+This page needs JavaScript\.[^.]+\.$/);
  await context.close();
});

test('light and dark follow the system until they are chosen', async () => {
  const page = await opened({ width: 390, height: 844 }, phone);
  const theme = (scheme) => page.emulateMedia({ colorScheme: scheme }).then(() => drawn(page)).then(() => page.getAttribute('html', 'data-theme'));
  assert.deepEqual([await theme('light'), await theme('dark'), await theme('light')], ['light', 'dark', 'light']);
  await page.click('#theme');
  assert.deepEqual([await theme('dark'), await theme('light')], ['dark', 'dark']);
});

test('on a phone nothing is wider than the screen', async () => {
  const page = await opened({ width: 360, height: 740 }, phone);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
});
