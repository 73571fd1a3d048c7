// SPDX-License-Identifier: MIT
// From the page's data block to typed arrays. viewer/README.md describes the block.

export function readData() {
  return JSON.parse(document.getElementById('data').textContent);
}

function bytes(base64) {
  const text = atob(base64);
  const result = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i += 1) { // millions: Uint8Array.from() takes seconds
    result[i] = text.charCodeAt(i);
  }
  return result;
}

/** Base64 of bytes. */
export function asBytes(base64) {
  return bytes(base64);
}

/** Base64 of little-endian 32-bit indices. */
export function asIndices(base64) {
  return new Uint32Array(bytes(base64).buffer);
}

/** Base64 of little-endian 16-bit coordinates, which stand for [-1.25, 1.25]. */
export function asPositions(base64) {
  const quantised = new Uint16Array(bytes(base64).buffer);
  const positions = new Float32Array(quantised.length);
  for (let i = 0; i < quantised.length; ++i) {
    positions[i] = (quantised[i] / 65535) * 2.5 - 1.25;
  }
  return positions;
}

/** A number for each position of asPositions(): the same for the same. */
export function gridKeys(positions) {
  const step = (x) => Math.round(((x + 1.25) / 2.5) * 65535);
  const keys = new Float64Array(positions.length / 3);
  for (let row = 0; row < keys.length; row += 1) {
    keys[row] = (step(positions[3 * row]) * 65536 + step(positions[3 * row + 1])) * 65536 + step(positions[3 * row + 2]);
  }
  return keys;
}
