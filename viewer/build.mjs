// SPDX-License-Identifier: MIT
// Bundles the page into one self-contained HTML file: node build.mjs OUT
import * as fs from 'node:fs';
import * as path from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const source = path.join(path.dirname(fileURLToPath(import.meta.url)), 'src');
const out = process.argv[2] ?? 'page.html';
const bundle = await build({
  entryPoints: [path.join(source, 'main.js')],
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2021',
  legalComments: 'inline',
  write: false,
});
const script = bundle.outputFiles[0].text.replaceAll('</script', '<\\/script');
const style = fs.readFileSync(path.join(source, 'style.css'), 'utf8');
// Functions as replacements: a "$&" in the bundle must not be taken for a pattern.
const page = fs
  .readFileSync(path.join(source, 'page.html'), 'utf8')
  .replace('/*STYLE*/', () => style)
  .replace('/*SCRIPT*/', () => script);
fs.writeFileSync(out, page);
