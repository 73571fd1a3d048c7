// SPDX-License-Identifier: MIT
// What the tests of report.html share: a folder for results, pages of reports, and what is seen in them.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import * as fs from 'node:fs';
import * as os from 'node:os';
import * as path from 'node:path';
import { after, afterEach, before } from 'node:test';
import { complaints, launch, open } from './browser.mjs';

export const models = process.env.VANTAGE_MODELS;
export const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'vantage-viewer-'));
/** Of a window whose 3D part is smaller than most readers': software draws every pixel of it. */
export const desktop = { width: 1000, height: 700 };

let browser;
before(async () => { browser = await launch(); });
afterEach(() => assert.deepEqual(complaints.splice(0), []));
after(async () => {
  await browser?.close();
  fs.rmSync(folder, { recursive: true, force: true });
});

export const vantage = (...args) => execFileSync(process.env.VANTAGE, args, { cwd: folder, stdio: 'pipe' });
export const viewOf = (name) => JSON.parse(fs.readFileSync(path.join(folder, name, 'view.json'), 'utf8'));

const pages = new Map();
/** The page of the report in a folder; it is opened once, as that takes seconds. Flights take no time in it. */
export async function pageOf(name, options = {}) {
  const key = JSON.stringify([name, options]);
  if (!pages.has(key)) {
    pages.set(key, await open(browser, path.join(folder, name, 'report.html'), { viewport: desktop, ...options }));
  }
  return pages.get(key);
}

/** Position and axes of the camera, in the model's own coordinates. */
export async function camera(page) {
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

/** The camera as text, in a format that is chosen. */
export async function cameraText(page, format) {
  await page.selectOption('#format', format);
  return page.inputValue('#camera');
}

/** All cameras of the box, by their formats. */
export async function cameraTexts(page) {
  const texts = new Map();
  for (const format of await page.locator('#format option').evaluateAll((all) => all.map((o) => o.value))) {
    texts.set(format, await cameraText(page, format));
  }
  return texts;
}

/** Where a camera for Blender stands. */
export const blenderLocation = (text) => text.match(/location = \(([^)]+)\)/)[1].split(', ').map(Number);

export const distance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));
export const unit = (v) => v.map((x) => x / Math.hypot(...v));

export async function waitForFlight(page) {
  await page.waitForFunction(() => window.vantage.model.flight === undefined);
}

/** Waits until what was asked for is drawn. */
export const drawn = (page) => page.evaluate(() => new Promise((resolve) => {
  requestAnimationFrame(() => requestAnimationFrame(resolve));
}));

/** That page as it was opened, in a window of this size. */
export async function fresh(name, size = desktop, device = {}) {
  const page = await pageOf(name, device);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.setViewportSize(size);
  await page.click('#reset');
  await page.evaluate(() => document.activeElement.blur());
  await waitForFlight(page);
  return page;
}

/** What count says of the window's { data, width, height } of pixels, in the page. */
export async function pixels(page, count) {
  await drawn(page);
  const window3d = await page.evaluateHandle(() => {
    const gl = window.vantage.model.renderer.getContext();
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const data = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
    return { data, width, height };
  });
  const counted = await window3d.evaluate(count);
  await window3d.dispose();
  return counted;
}

export async function clickSphere(page) {
  await page.locator('#sphere').scrollIntoViewIfNeeded();
  const box = await page.locator('#sphere').boundingBox();
  await page.mouse.click(box.x + 0.35 * box.width, box.y + 0.4 * box.height);
}
