// SPDX-License-Identifier: MIT
// Debian's Chromium without a display, rendering WebGL in software.
import { createRequire } from 'node:module';
import * as path from 'node:path';
import { pathToFileURL } from 'node:url';

// playwright-core is where the page's own packages are, in the build folder.
const require = createRequire(path.resolve(process.env.VANTAGE_VIEWER_BUILD, 'package.json'));
const { chromium } = require('playwright-core');

// A machine that builds beside the tests may take this long for what takes a second alone.
const kPatienceMs = 120000;

export async function launch() {
  return chromium.launch({
    timeout: kPatienceMs,
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    headless: true,
    args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync', '--disable-dev-shm-usage',
      '--use-gl=angle', '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader'],
  });
}

/** Opens a report from disk and waits for its first frame; collects what must not happen. Flights take no time,
 *  unless reducedMotion is 'no-preference'. */
export async function open(browser, file, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1200, height: 800 }, reducedMotion: 'reduce', ...options });
  context.setDefaultTimeout(kPatienceMs);
  const page = await context.newPage();
  page.complaints = [];
  page.on('console', (m) => {
    if (['error', 'warning'].includes(m.type()) && !/GPU stall|swiftshader/i.test(m.text())) {
      page.complaints.push(`console: ${m.text()}`);
    }
  });
  page.on('pageerror', (e) => page.complaints.push(`error: ${e.message}`));
  page.on('request', (r) => {
    if (!/^(file|data|blob):/.test(r.url())) {
      page.complaints.push(`request: ${r.url()}`);
    }
  });
  const start = Date.now();
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector('html[data-ready=yes]', { state: 'attached' });
  page.loadSeconds = (Date.now() - start) / 1000;
  return page;
}
