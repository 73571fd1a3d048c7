// SPDX-License-Identifier: MIT
// A GLB of triangles, for the tests.

/** @param {number[][]} vertices @param {number[][]} faces @param {object} material of all faces */
export function glb(vertices, faces, material = {}) {
  const positions = Float32Array.from(vertices.flat());
  const indices = Uint32Array.from(faces.flat());
  const axis = (pick) => [0, 1, 2].map((k) => pick(...vertices.map((v) => v[k])));
  const body = Buffer.concat([Buffer.from(positions.buffer), Buffer.from(indices.buffer)]);
  const json = {
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    materials: [material], meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1, material: 0 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: vertices.length, type: 'VEC3', min: axis(Math.min), max: axis(Math.max) },
      { bufferView: 1, componentType: 5125, count: indices.length, type: 'SCALAR' }],
    bufferViews: [
      { buffer: 0, byteLength: positions.byteLength },
      { buffer: 0, byteOffset: positions.byteLength, byteLength: indices.byteLength }],
    buffers: [{ byteLength: body.length }],
  };
  let text = JSON.stringify(json);
  text += ' '.repeat((4 - (text.length % 4)) % 4);
  const chunk = (type, data) => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(data.length, 0);
    head.write(type, 4, 'latin1');
    return Buffer.concat([head, data]);
  };
  const head = Buffer.alloc(12);
  head.write('glTF', 0, 'latin1');
  head.writeUInt32LE(2, 4);
  const chunks = Buffer.concat([chunk('JSON', Buffer.from(text)), chunk('BIN\0', body)]);
  head.writeUInt32LE(12 + chunks.length, 8);
  return Buffer.concat([head, chunks]);
}
