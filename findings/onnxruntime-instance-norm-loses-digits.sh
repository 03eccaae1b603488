#!/usr/bin/env bash
# onnxruntime-node 1.30.0 (npm, CPU): InstanceNormalization of one large channel, as styling networks have at full size.
#
# Expected: (x - mean) / sqrt(variance + epsilon) to about 1e-6 of values near 1, whatever the size: float32 has 7 digits, and a mean
#   of n numbers summed in blocks or in float64 loses hardly any.
# Behaviour: the error grows with the number of pixels, by a factor of 2,000 from 64 x 64 to 2896 x 2896 (two cores, AVX-512).
#   Daumier sums moments of norms in float64 (runtime/row_norm.h).
# Output seen:
#   64 x 64: greatest error 5.6e-7
#   512 x 512: greatest error 3.4e-6
#   1024 x 1024: greatest error 2.2e-5
#   2896 x 2896: greatest error 1.2e-3
# Exit: 0 as described, 1 changed, 2 no packages.
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --prefix . --ignore-scripts --no-audit --no-fund --silent onnxruntime-node@1.30.0 >/dev/null 2>&1 ||
  { echo "npm cannot install onnxruntime-node@1.30.0"; exit 2; }

cat >main.mjs <<'JS'
import ort from 'onnxruntime-node';

// The fields of a protobuf message.
const varint = (n) => (n < 128 ? [n] : [(n % 128) | 128, ...varint(Math.floor(n / 128))]);
const number = (field, value) => [...varint(field * 8), ...varint(value)];
const bytes = (field, value) => {
  const data = typeof value === 'string' ? [...Buffer.from(value)] : value;
  return [...varint(field * 8 + 2), ...varint(data.length), ...data];
};
const one = [...new Uint8Array(new Float32Array([1]).buffer)], zero = [0, 0, 0, 0];
const tensor = (name, raw) => [...number(1, 1), ...number(2, 1), ...bytes(8, name), ...bytes(9, raw)];
const value = (name, sides) => [
  ...bytes(1, name),
  ...bytes(2, bytes(1, [...number(1, 1), ...bytes(2, sides.flatMap((side) => bytes(1, number(1, side))))])),
];

/// y = InstanceNormalization(x) of 1 x 1 x side x side, scale 1, shift 0.
function Model(side) {
  const node = [...['x', 'scale', 'shift'].flatMap((name) => bytes(1, name)), ...bytes(2, 'y'), ...bytes(4, 'InstanceNormalization')];
  const sides = [1, 1, side, side];
  const graph = [...bytes(1, node), ...bytes(2, 'g'), ...bytes(5, tensor('scale', one)), ...bytes(5, tensor('shift', zero)),
    ...bytes(11, value('x', sides)), ...bytes(12, value('y', sides))];
  return Uint8Array.from([...number(1, 7), ...bytes(7, graph), ...bytes(8, number(2, 13))]);
}

/// The greatest error of a picture of values 0 to 255: a ramp with a fine texture.
async function Error(side) {
  const x = Float32Array.from({ length: side * side }, (_, i) => 128 + (100 * (i % side)) / side + 20 * Math.sin(0.7 * i));
  let mean = 0, variance = 0;
  for (const v of x) mean += v / x.length;
  for (const v of x) variance += (v - mean) ** 2 / x.length;
  const session = await ort.InferenceSession.create(Model(side), { executionProviders: ['cpu'] });
  const { y } = await session.run({ x: new ort.Tensor('float32', x, [1, 1, side, side]) });
  let worst = 0;
  for (let i = 0; i < x.length; ++i) {
    worst = Math.max(worst, Math.abs(y.data[i] - (x[i] - mean) / Math.sqrt(variance + 1e-5)));
  }
  return worst;
}

const errors = [];
for (const side of [64, 512, 1024, 2896]) {
  errors.push(await Error(side));
  console.log(`${side} x ${side}: greatest error ${errors.at(-1).toExponential(1)}`);
}
const as_described = errors[0] < 1e-5 && errors.at(-1) > 3e-4;
console.log(as_described ? 'as described' : 'CHANGED');
process.exit(as_described ? 0 : 1);
JS
node main.mjs
