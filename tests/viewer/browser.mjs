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
      '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--disable-gpu-compositing'], // software draws 3D only: the rest of a page is not drawn by shaders that it compiles
  });
}

/** What must not happen, of all reports that were opened. */
export const complaints = [];

/** Opens a report from disk and waits for its first frame. Flights take no time, unless reducedMotion is 'no-preference'. */
export async function open(browser, file, options = {}) {
  const context = await browser.newContext({ reducedMotion: 'reduce', ...options });
  context.setDefaultTimeout(kPatienceMs);
  const page = await context.newPage();
  page.on('console', (m) => {
    if (['error', 'warning'].includes(m.type()) && !/GPU stall|swiftshader/i.test(m.text())) {
      complaints.push(`console: ${m.text()}`);
    }
  });
  page.on('pageerror', (e) => complaints.push(`error: ${e.message}`));
  page.on('request', (r) => {
    if (!/^(file|data|blob):/.test(r.url())) {
      complaints.push(`request: ${r.url()}`);
    }
  });
  const start = Date.now();
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector('html[data-ready=yes]', { state: 'attached' });
  page.loadSeconds = (Date.now() - start) / 1000;
  return page;
}
