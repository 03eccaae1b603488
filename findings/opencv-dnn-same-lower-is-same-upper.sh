#!/usr/bin/env bash
# OpenCV 5.0.0 (npm: @techstark/opencv-js 5.0.0-release.1), dnn: ONNX's auto_pad SAME_LOWER of Conv and AveragePool.
#
# Expected: where the padding is odd, SAME_LOWER puts the extra row and column before the image, SAME_UPPER behind it [ONNX, Conv].
#   A 2 x 2 kernel needs one of each, so SAME_LOWER is pads = [1, 1, 0, 0].
# Behaviour: SAME_LOWER gives what SAME_UPPER gives, the picture moved by one pixel, without a message. Explicit pads are right.
#   OpenCV 4.6.0 of Debian 12 does the same; ONNX Runtime 1.30.0 gives the expected values for the same models.
# Output seen (3 x 3 pixels 1 to 9, kernel 1 2 3 4; by hand the first is 4 x 1 = 4):
#   Conv         pads 1 1 0 0    4 11 18 18 37 47 36 67 77
#   Conv         SAME_LOWER      37 47 21 67 77 33 23 26 9
#   Conv         SAME_UPPER      37 47 21 67 77 33 23 26 9
#   AveragePool  pads 1 1 0 0    1 1.5 2.5 2.5 3 4 5.5 6 7
#   AveragePool  SAME_LOWER      3 4 4.5 6 7 7.5 7.5 8.5 9
#   AveragePool  SAME_UPPER      3 4 4.5 6 7 7.5 7.5 8.5 9
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

const image = [1, 2, 3, 4, 5, 6, 7, 8, 9];

/// A 2 x 2 convolution or mean of the image.
const Run = (type, padding) => run(model(
  [node('Reshape', ['row', 'image_shape'], 'image'),
    node(type, type === 'Conv' ? ['image', 'kernel'] : ['image'], 'padded', { kernel_shape: [2, 2], ...padding }),
    node('Reshape', ['padded', 'row_shape'], 'result')],
  [integers('image_shape', [1, 1, 3, 3]), integers('row_shape', [1, 9]),
    ...(type === 'Conv' ? [floats('kernel', [1, 1, 2, 2], [1, 2, 3, 4])] : [])],
  tensor('row', [1, 9]), tensor('result', [1, 9])), image);

async function main() {
  let as_described = true;
  for (const [type, first] of [['Conv', 4], ['AveragePool', 1]]) {
    const seen = [];
    for (const padding of [{ pads: [1, 1, 0, 0] }, { auto_pad: 'SAME_LOWER' }, { auto_pad: 'SAME_UPPER' }]) {
      const values = await Run(type, padding);
      seen.push(values.join(' '));
      console.log(`${type.padEnd(12)} ${(padding.auto_pad ?? `pads ${padding.pads.join(' ')}`).padEnd(15)} ${values.join(' ')}`);
      as_described &&= padding.auto_pad !== undefined || values[0] === first;
    }
    as_described &&= seen[1] === seen[2] && seen[1] !== seen[0];
  }
  console.log(as_described ? 'as described' : 'CHANGED');
  process.exit(as_described ? 0 : 1);
}
main();
JS
node main.js
