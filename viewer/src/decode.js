// SPDX-License-Identifier: MIT
// From the page's data block to typed arrays. viewer/README.md describes the block.

export function readData() {
  return JSON.parse(document.getElementById('data').textContent);
}

function bytes(base64) {
  return Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
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
