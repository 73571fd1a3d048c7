// SPDX-License-Identifier: MIT
// What `vantage serve` shows, in real Chromium: our pages work, and those of others can do nothing.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import * as fs from 'node:fs';
import * as http from 'node:http';
import * as os from 'node:os';
import * as path from 'node:path';
import { after, before, test } from 'node:test';
import { launch } from './browser.mjs';

const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'vantage-serve-'));
const results = path.join(folder, 'results');
const model = path.join(process.env.VANTAGE_MODELS, 'cat_lowpoly.ply');
const kCount = 120; // what a page of the index shows
let browser;
let server;
let address;
let elsewhere; // whom a hostile page would tell
const told = [];

before(async () => {
  const vantage = (...args) => execFileSync(process.env.VANTAGE, args, { cwd: folder, stdio: 'pipe' });
  vantage('view', model, '-o', path.join(results, 'm000'), '--search', 'rapid', '--size', '64x48');
  vantage('compare', model, '-o', path.join(results, 'compared'), '--method', 'silhouette-length');
  for (let i = 1; i < kCount; ++i) {
    fs.cpSync(path.join(results, 'm000'), path.join(results, `m${String(i).padStart(3, '0')}`), { recursive: true });
  }
  elsewhere = http.createServer((request, response) => {
    told.push(request.url);
    response.writeHead(200, { 'Access-Control-Allow-Origin': '*' }).end();
  });
  await new Promise((done) => elsewhere.listen(0, '127.0.0.1', done));
  const to = `http://127.0.0.1:${elsewhere.address().port}/`;
  const script = `
    const tell = (what) => { new Image().src = '${to}?image=' + what; fetch('${to}?fetch=' + what).catch(() => {}); };
    tell('ran');
    for (const page of ['/', '/m000/view.json']) {
      fetch(page).then((r) => r.text()).then((t) => { document.title = 'read'; tell(t.length); }).catch(() => {});
    }
    const frame = document.createElementNS('http://www.w3.org/1999/xhtml', 'iframe');
    frame.src = '/';
    frame.onload = () => { try { tell(frame.contentDocument.body.textContent.length); } catch { /* no origin */ } };
    document.documentElement.append(frame);`;
  // A page can also go away itself, and take along what it knows.
  const link = (attribute) => `const a = document.createElement('a'); a.href = '${to}?${attribute}'; a.${attribute} = 'x';
    document.body.append(a); a.click();`;
  for (const [name, way] of Object.entries({ href: `location.href = '${to}?href'`, top: `top.location.href = '${to}?top'`,
    open: `open('${to}?open')`, download: link('download'), target: link('target') })) {
    fs.mkdirSync(path.join(results, name));
    fs.writeFileSync(path.join(results, name, 'report.html'), `<!doctype html><title>x</title><body><script>${way}</script>`);
  }
  fs.writeFileSync(path.join(results, 'refresh.html'),
    `<!doctype html><title>x</title><meta http-equiv="refresh" content="0;url=${to}?refresh">`);
  fs.mkdirSync(path.join(results, 'refresh'));
  fs.copyFileSync(path.join(results, 'refresh.html'), path.join(results, 'refresh', 'report.html'));
  fs.writeFileSync(path.join(results, 'evil.html'), `<!doctype html><title>evil</title><script>${script}</script>`);
  fs.mkdirSync(path.join(results, 'evil'));
  fs.writeFileSync(path.join(results, 'evil', 'report.html'), `<!doctype html><title>evil</title><script>${script}</script>`);
  fs.writeFileSync(path.join(results, 'evil.svg'),
    `<svg xmlns="http://www.w3.org/2000/svg"><title>evil</title><script><![CDATA[${script}]]></script></svg>`);
  server = spawn(process.env.VANTAGE, ['serve', results, '-q'], { stdio: ['ignore', 'pipe', 'inherit'] });
  address = await new Promise((done) => server.stdout.once('data', (text) => done(String(text).trim())));
  browser = await launch();
});

after(async () => {
  await browser?.close();
  server?.kill('SIGINT');
  elsewhere?.close();
  fs.rmSync(folder, { recursive: true, force: true });
});

test('the index shows all its small pictures, and none waits for a connection to be free', async () => {
  const page = await browser.newPage();
  const refused = [];
  page.on('console', (m) => m.type() === 'error' && refused.push(m.text()));
  await page.setViewportSize({ width: 1200, height: 6000 });
  await page.goto(address);
  await page.waitForFunction((count) => {
    const images = [...document.images];
    images.forEach((image) => { image.loading = 'eager'; });
    return images.length === count && images.every((image) => image.complete && image.naturalWidth > 0);
  }, kCount, { timeout: 60000 });
  // From asking to the first byte; kept connections are given up after 5 s.
  const slowest = await page.evaluate(() => Math.max(
    ...performance.getEntriesByType('resource').map((e) => e.responseStart - e.requestStart)));
  assert.ok(slowest < 4000, `${slowest} ms`);
  assert.deepEqual(refused, []);
  await page.close();
});

test('a picture of the index leads to a report that works', async () => {
  const context = await browser.newContext({ permissions: ['clipboard-read'] });
  const page = await context.newPage();
  const refused = [];
  page.on('console', (m) => m.type() === 'error' && refused.push(m.text()));
  page.on('pageerror', (e) => refused.push(e.message));
  await page.goto(address);
  await page.click('article a >> nth=0');
  const report = page.frameLocator('iframe');
  await report.locator('html[data-ready=yes]').waitFor({ state: 'attached', timeout: 60000 });
  assert.match(page.url(), /report\.html$/);
  assert.equal(await page.title(), `${decodeURIComponent(page.url()).split('/').at(-2)} · Vantage`);
  await page.keyboard.press('k'); // no click is needed before
  assert.equal(await report.locator('#show-map').isChecked(), true);
  const [picture] = await Promise.all([page.waitForEvent('download'), report.locator('#save-picture').click()]);
  assert.match(picture.suggestedFilename(), /\.png$/);
  const [camera] = await Promise.all([page.waitForEvent('download'), report.locator('#save-camera').click()]);
  assert.match(camera.suggestedFilename(), /best/);
  await report.locator('#copy').click();
  await report.locator('#copy', { hasText: 'Copied' }).waitFor();
  await page.evaluate(() => window.focus());
  assert.equal(await page.evaluate(() => navigator.clipboard.readText()), await report.locator('#camera').inputValue());
  assert.deepEqual(refused, []);
  await context.close();
});

test('the page of compare shows its contact sheet', async () => {
  const page = await browser.newPage();
  await page.goto(`${address}compared/index.html`);
  await page.waitForFunction(() => document.images.length > 0 &&
    [...document.images].every((image) => image.complete && image.naturalWidth > 0));
  await page.close();
});

let visiting; // one page for all that is hostile
async function visitor() {
  visiting ??= await (await browser.newContext()).newPage();
  return visiting;
}

for (const name of ['evil.html', 'evil.svg', 'evil/report.html']) {
  test(`a hostile ${name} reads nothing and tells nobody`, async () => {
    told.length = 0;
    const page = await visitor();
    await page.goto(address + name);
    await page.waitForTimeout(1500);
    assert.deepEqual(told, []);
    assert.notEqual(await page.title(), 'read');
  });
}

for (const name of ['href/report.html', 'top/report.html', 'open/report.html', 'download/report.html', 'target/report.html',
  'refresh/report.html', 'refresh.html']) {
  test(`a hostile ${name} leads nowhere`, async () => {
    told.length = 0;
    const page = await visitor();
    await page.goto(address + name);
    await page.waitForTimeout(500);
    assert.deepEqual(told, []);
    assert.equal(page.url(), address + name);
    assert.equal(page.context().pages().length, 1);
  });
}
