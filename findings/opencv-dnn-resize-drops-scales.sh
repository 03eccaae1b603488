#!/usr/bin/env bash
# OpenCV 5.0.0 (npm: @techstark/opencv-js 5.0.0-release.1), dnn: ONNX's Resize, linear, by `scales` that do not divide the size.
#
# Expected: 7 columns by scale 0.5 are floor(3.5) = 3, and column i is read at (i + 0.5) / scale - 0.5 [ONNX, Resize, half_pixel,
#   the default]: 0.5, 2.5, 4.5. The scale in the file counts; a ratio of sizes only where `sizes` are given instead. Upsampling
#   layers of networks are exported with scales, and any picture of odd size is such a case.
# Behaviour: OpenCV uses the ratio of the sizes, 3 / 7, in place of 0.5. Every column shifts, the last by 0.83 pixels here. No
#   message. 4 columns by 1.3 likewise (5 / 4). ONNX Runtime 1.30.0 gives the expected values for the same models.
# Output seen (each pixel holds its own column, so results are the places read):
#   7 columns, scale 0.5   expected 0.5 2.5 4.5   seen 0.6667 3 5.3333
#   8 columns, scale 0.5   expected 0.5 2.5 4.5 6.5   seen 0.5 2.5 4.5 6.5
#   4 columns, scale 1.3   expected 0 0.6538 1.4231 2.1923 2.9615   seen 0 0.7 1.5 2.3 3
# Exit: 0 as described, 1 changed, 2 no packages.
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --prefix . --ignore-scripts --no-audit --no-fund --silent @techstark/opencv-js@5.0.0-release.1 >/dev/null 2>&1 ||
  { echo "npm cannot install @techstark/opencv-js@5.0.0-release.1"; exit 2; }

cat >onnx.js <<'JS'
// Just enough of ONNX's protobuf for a chain of nodes. field(number, content): bytes, text, a message or an integer.
function varint(value) {
  const bytes = [];
  for (let rest = BigInt.asUintN(64, BigInt(value)); ; rest >>= 7n) {
    if (rest < 128n) return Buffer.from([...bytes, Number(rest)]);
    bytes.push(Number(rest & 127n) | 128);
  }
}
function field(number, content) {
  if (typeof content === 'number') return Buffer.concat([varint(number * 8), varint(content)]);
  const bytes = Array.isArray(content) ? Buffer.concat(content) : Buffer.from(content);
  return Buffer.concat([varint(number * 8 + 2), varint(bytes.length), bytes]);
}
const each = (number, values) => values.map((value) => field(number, value));

const attribute = (name, value) =>
  [field(1, name), ...(Array.isArray(value) ? [...each(8, value), field(20, 7)] : [field(4, value), field(20, 3)])];
const node = (type, inputs, output, attributes = {}) => [
  ...each(1, inputs), field(2, output), field(3, output), field(4, type),
  ...Object.entries(attributes).map(([name, value]) => field(5, attribute(name, value))),
];
const bytesOf = (array) => Buffer.from(array.buffer);
const floats = (name, dims, values) =>
  [...each(1, dims), field(2, 1), field(8, name), field(9, bytesOf(Float32Array.from(values)))];
const integers = (name, values) =>
  [field(1, values.length), field(2, 7), field(8, name), field(9, bytesOf(BigInt64Array.from(values, BigInt)))];
const shape = (dims) => field(2, dims.map((dim) => field(1, [field(1, dim)])));
const tensor = (name, dims) => [field(1, name), field(2, [field(1, [field(1, 1), shape(dims)])])];
const model = (nodes, weights, input, output) => Buffer.concat([
  field(1, 7), field(8, [field(1, ''), field(2, 13)]),
  field(7, [...each(1, nodes), field(2, 'graph'), ...each(5, weights), field(11, input), field(12, output)]),
]);

/// The values that OpenCV computes for a row of numbers; matrices of its JavaScript are two-dimensional.
async function run(bytes, values) {
  let cv = require('@techstark/opencv-js');
  if (cv instanceof Promise) cv = await cv;
  if (!cv.Mat) await new Promise((resolve) => { cv.onRuntimeInitialized = resolve; });
  const name = `model${run.count = (run.count ?? 0) + 1}.onnx`;
  cv.FS_createDataFile('/', name, new Uint8Array(bytes), true, false, false);
  const net = cv.readNetFromONNX(`/${name}`);
  net.setInput(cv.matFromArray(1, values.length, cv.CV_32F, values));
  return Array.from(net.forward().data32F);
}
module.exports = { node, floats, integers, tensor, model, run };
JS

cat >main.js <<'JS'
const { node, floats, integers, tensor, model, run } = require('./onnx.js');

const Text = (values) => values.map((value) => Number(value.toFixed(4))).join(' ');

/// Columns 0, 1, 2 ... of `rows` equal rows, resized in both directions; the first row of the result.
async function Resized(size, scale) {
  const count = Math.floor(size * scale);
  const columns = Array.from({ length: size * size }, (_, i) => i % size);
  const values = await run(model(
    [node('Reshape', ['row', 'image_shape'], 'image'),
      node('Resize', ['image', '', 'scales'], 'resized', { mode: 'linear' }),
      node('Reshape', ['resized', 'row_shape'], 'result')],
    [integers('image_shape', [1, 1, size, size]), integers('row_shape', [1, count * count]),
      floats('scales', [4], [1, 1, scale, scale])],
    tensor('row', [1, size * size]), tensor('result', [1, count * count])), columns);
  return values.slice(0, count);
}

async function main() {
  let as_described = true;
  for (const [size, scale, described] of [[7, 0.5, '0.6667 3 5.3333'], [8, 0.5, '0.5 2.5 4.5 6.5'], [4, 1.3, '0 0.7 1.5 2.3 3']]) {
    const places = Array.from({ length: Math.floor(size * scale) }, (_, i) => (i + 0.5) / scale - 0.5);
    const expected = Text(places.map((place) => Math.min(size - 1, Math.max(0, place)))), seen = Text(await Resized(size, scale));
    console.log(`${size} columns, scale ${scale}   expected ${expected}   seen ${seen}`);
    as_described &&= seen === described;
  }
  console.log(as_described ? 'as described' : 'CHANGED');
  process.exit(as_described ? 0 : 1);
}
main();
JS
node main.js
