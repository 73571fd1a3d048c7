// SPDX-License-Identifier: MIT
// Opens reports in Chromium as their readers do and takes pictures of the window: light, dark, on a
// phone, with the skeleton, half way through the contraction. Prints size and seconds to load.
//   VANTAGE_VIEWER_BUILD=build/release/viewer node scripts/report_pictures.mjs FOLDER report.html...
import * as fs from 'node:fs';
import * as path from 'node:path';
import { launch, open } from '../tests/viewer/browser.mjs';

const [folder, ...reports] = process.argv.slice(2);
if (!folder || reports.length === 0) {
  console.error('usage: report_pictures.mjs FOLDER report.html...');
  process.exit(2);
}
fs.mkdirSync(folder, { recursive: true });
const browser = await launch();
const settle = (page) => page.evaluate(() => new Promise((done) => { setTimeout(done, 400); }));
const looks = [
  ['light', {}, async () => {}],
  ['dark', { colorScheme: 'dark' }, async () => {}],
  ['phone', { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }, async () => {}],
  ['wide', { viewport: { width: 1280, height: 800 } }, async (page) => { await page.click('#show-map'); }],
  ['skeleton', {}, async (page) => {
    await page.click('#show-map');
    await page.click('#show-skeleton');
  }],
  ['contraction', {}, async (page) => {
    await page.click('#show-map');
    await page.locator('#level').evaluate((slider) => {
      slider.value = Number(slider.max) / 2;
      slider.dispatchEvent(new Event('input'));
    });
  }],
];
for (const report of reports) {
  const name = path.basename(path.dirname(path.resolve(report)));
  const data = fs.readFileSync(report, 'utf8').match(/<script type="application\/json"[^>]*>([\s\S]*?)<\/script>/)[1];
  const size = fs.statSync(report).size;
  for (const [look, options, prepare] of looks) {
    const page = await open(browser, report, options);
    await prepare(page);
    await settle(page);
    await page.screenshot({ path: path.join(folder, `${name}-${look}.png`), fullPage: look === 'phone' });
    if (look === 'light') {
      console.log(`${name}: ${(size / 1e6).toFixed(2)} MB, ${((size - data.length) / 1e6).toFixed(2)} MB without the data, loaded in ${page.loadSeconds.toFixed(2)} s`);
    }
    for (const complaint of page.complaints) {
      console.log(`${name} ${look}: ${complaint}`);
    }
    await page.context().close();
  }
}
await browser.close();
