// Weights whose network moves the vertices of the mean face by its picture, so that `daumier predict` writes the C++ runtime's
// preprocessing into a mesh.
import { createHash } from 'node:crypto';
import { cpSync, mkdirSync, readFileSync, symlinkSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';

/** cm of ink 1. */
const kStep = 0.05;
const kFloat = 1, kInt64 = 7, kInt = 2;

function varint(value) {
  const bytes = [];
  for (let rest = BigInt.asUintN(64, BigInt(value)); ; rest >>= 7n) {
    if (rest < 128n) return Buffer.from([...bytes, Number(rest)]);
    bytes.push(Number(rest & 127n) + 128);
  }
}
const number = (field, value) => Buffer.concat([varint(field * 8), varint(value)]);
const bytes = (field, value) => Buffer.concat([varint(field * 8 + 2), varint(Buffer.byteLength(value)), Buffer.from(value)]);
const message = (field, ...parts) => bytes(field, Buffer.concat(parts));

function node(operator, inputs, output, attributes = {}) {
  const parts = Object.entries(attributes).map(([name, value]) => message(5, bytes(1, name), number(3, value), number(20, kInt)));
  return message(1, ...inputs.map((input) => bytes(1, input)), bytes(2, output), bytes(3, output), bytes(4, operator), ...parts);
}
function integers(name, values) {
  const data = Buffer.alloc(8 * values.length);
  values.forEach((value, i) => data.writeBigInt64LE(BigInt(value), 8 * i));
  return message(5, number(1, values.length), number(2, kInt64), bytes(8, name), bytes(9, data));
}
function floats(name, dims, numbers) {
  return message(5, ...dims.map((dim) => number(1, dim)), number(2, kFloat), bytes(8, name), bytes(9, Buffer.from(Float32Array.from(numbers).buffer)));
}
function value(field, name, dims) {
  const shape = dims.map((dim) => message(1, typeof dim === 'number' ? number(1, dim) : bytes(2, dim)));
  return message(field, bytes(1, name), message(2, message(1, number(1, kFloat), message(2, ...shape))));
}

/** u, v and residual are the first pixels; vertices those of the mean face plus kStep times all pixels. */
function graphOf(side, sizes, mean) {
  const pixels = side * side, count = mean.length;
  const parts = [node('Flatten', ['sketch'], 'flat', { axis: 1 }), floats('rest', [1, count - pixels], new Float32Array(count - pixels)), integers('begin', [0]), integers('axis', [1]),
    integers('shape', [1, count / 3, 3]), floats('mean', [1, count], mean), floats('step', [1], [kStep]), node('Concat', ['flat', 'rest'], 'all', { axis: 1 }), node('Mul', ['all', 'step'], 'moves'),
    node('Add', ['moves', 'mean'], 'moved'), node('Reshape', ['moved', 'shape'], 'vertices')];
  for (const [name, size] of Object.entries(sizes)) parts.push(integers(`end_${name}`, [size]), node('Slice', ['flat', 'begin', `end_${name}`, 'axis'], name), value(12, name, ['N', size]));
  parts.sort((a, b) => a[0] - b[0]);  // Nodes first; their order stays.
  return message(7, ...parts, bytes(2, 'ink'), value(11, 'sketch', ['N', 1, side, side]), value(12, 'vertices', ['N', count / 3, 3]));
}

/** Writes folder/sketch-ict of such a network, a copy of the shipped weights otherwise. */
export function writeInkWeights(weights, folder, mean) {
  const out = join(folder, 'sketch-ict');
  mkdirSync(folder, { recursive: true });
  symlinkSync(resolve(weights, 'face-ict'), join(folder, 'face-ict'));
  cpSync(join(weights, 'sketch-ict'), out, { recursive: true });
  const manifest = JSON.parse(readFileSync(join(out, 'manifest.json'), 'utf8')), { options, sizes } = manifest.details.network;
  const model = Buffer.concat([number(1, 8), graphOf(options.resolution, { u: sizes.num_identity, v: sizes.num_expression, residual: options.residual }, mean), message(8, bytes(1, ''), number(2, 13))]);
  writeFileSync(join(out, 'network.onnx'), model);
  manifest.checksums['network.onnx'] = createHash('sha256').update(model).digest('hex');
  writeFileSync(join(out, 'manifest.json'), JSON.stringify(manifest, null, 2));
  return { weights: out, side: options.resolution, levelsOf: (vertices) => Array.from(vertices.subarray(0, options.resolution ** 2), (at, i) => Math.round((255 * (at - Math.fround(mean[i]))) / kStep)) };
}
