import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import test from 'node:test';
import { repository } from '../../tools/consumers/studio/client.mjs';
import { load } from './package.mjs';

const { folderAt, readJson } = await load('folder');
const { Network, readManifest } = await load('network');
const { completeOnnx } = await load('onnx_file');
const { numberOfHalf, Safetensors } = await load('safetensors');
const { readScaledShapes } = await load('scaled_shapes');

function fileOf(arrays) {
  const header = {}, parts = [];
  let at = 0;
  for (const [name, [dtype, shape, bytes]] of Object.entries(arrays)) {
    header[name] = { dtype, shape, data_offsets: [at, at + bytes.length] };
    at += bytes.length;
    parts.push(Buffer.from(bytes));
  }
  const text = Buffer.from(JSON.stringify(header)), size = Buffer.alloc(8);
  size.writeBigUInt64LE(BigInt(text.length));
  return new Uint8Array(Buffer.concat([size, text, ...parts]));
}

test('numbers of 16 bits: 1, -2, the largest, the least, infinity, NaN', () => {
  assert.deepEqual([0x3c00, 0xc000, 0x7bff, 0x0001, 0x7c00].map(numberOfHalf), [1, -2, 65504, 2 ** -24, Infinity]);
  assert.ok(Number.isNaN(numberOfHalf(0x7e01)));
});
test('a safetensors file is read, whatever its alignment', () => {
  const file = new Safetensors('a', fileOf({ odd: ['U8', [3], [1, 2, 3]], half: ['F16', [2], [0, 0x3c, 0, 0xc0]], whole: ['I16', [1], [0xff, 0xff]] }));
  assert.deepEqual([...file.floats('half')], [1, -2]);
  assert.deepEqual([...file.integers('whole')], [-1]);
  assert.throws(() => file.at('none'), /a: it has no array 'none'\..*export again/);
  assert.throws(() => file.floats('odd'), /is of type U8 \(expected F16, F32 or F64\)/);
});
test('a truncated file, and one of another kind, are refused', () => {
  const whole = fileOf({ x: ['F32', [2], new Array(8).fill(0)] });
  assert.throws(() => new Safetensors('a', whole.subarray(0, whole.length - 1)), /a: it is truncated/);
  assert.throws(() => new Safetensors('a', new TextEncoder().encode('<!doctype html>')), /no safetensors file, or it is truncated/);
});
test('shapes of 8 and 16 bits keep their order', () => {
  const scales = Buffer.from(Float32Array.of(0.5, 2, 0.25).buffer);
  const file = new Safetensors('a', fileOf({ 's/scales': ['F32', [3], scales], 's/bits': ['U8', [3], [8, 16, 8]], 's/int8': ['I8', [2, 2], [2, 254, 4, 8]], 's/int16': ['I16', [1, 2], [1, 0, 255, 255]] }));
  assert.deepEqual(readScaledShapes(file, 's').map((shape) => [...shape]), [[1, -1], [2, -2], [1, 2]]);
});

const weights = join(repository, 'weights/sketch-ict');
test('a graph of shipped weights gets its numbers, and is whole then', () => {
  const numbers = new Safetensors('n', new Uint8Array(readFileSync(join(weights, 'network.safetensors'))));
  const whole = completeOnnx('g', new Uint8Array(readFileSync(join(weights, 'network.onnx'))), numbers);
  assert.ok(!Buffer.from(whole).includes('network.safetensors'));
  assert.ok(Buffer.from(whole).includes(Buffer.from(numbers.floats('convolutions.0.weight').buffer)));
  assert.deepEqual(completeOnnx('g', whole, numbers), whole);
});
test('a file that is no graph is refused', () => {
  assert.throws(() => completeOnnx('g', new TextEncoder().encode('<html>'), undefined), /^DaumierError: g: /);
});

async function withFetch(respond, action) {
  const own = globalThis.fetch;
  globalThis.fetch = async (address) => respond(String(address));
  try {
    return await action();
  } finally {
    globalThis.fetch = own;
  }
}
const folder = folderAt('http://host/weights/sketch-ict/');
test('a neighbour lies next to a folder', () => assert.equal(folder.neighbour('face-ict').name, 'http://host/weights/face-ict'));
test('a missing file, a web page in its place, no JSON and no connection are errors with the address', async () => {
  const refuse = (respond, pattern) => withFetch(respond, () => assert.rejects(readJson(folder, 'manifest.json'), pattern));
  await refuse(() => new Response('', { status: 404 }), /http:\/\/host\/weights\/sketch-ict\/manifest\.json: the server has no such file \(status 404\)\. Serve/);
  await refuse(() => new Response('<html>', { headers: { 'content-type': 'text/html; charset=utf-8' } }), /sent a web page in its place/);
  await refuse(() => new Response('{'), /this is no JSON/);
  await refuse(() => Promise.reject(new TypeError('Failed to fetch')), /could not be fetched \(Failed to fetch\).*CORS/);
});
test('a run, another task and another version are refused with the repair', async () => {
  const refuse = (json, pattern) => withFetch(() => new Response(JSON.stringify(json)), () => assert.rejects(readManifest(folder, 'sketch'), pattern));
  await refuse({ format_version: 1, kind: 'run' }, /kind 'run' \(expected 'weights' or 'export'\).*daumier export RUN --out/);
  await refuse({ format_version: 1, kind: 'export', config: { system: 'deform' } }, /task 'deform' \(expected 'sketch'\)/);
  await refuse({ format_version: 2, kind: 'export' }, /its version is 2 \(expected 1\)/);
  await refuse([], /no manifest of Daumier/);
});

function fakeOrt(run) {
  const session = { inputNames: ['x'], outputNames: ['y'], inputMetadata: [{ name: 'x', isTensor: true, shape: ['N', 2] }], run, release: async () => {} };
  return { Tensor: class {
    constructor(type, data, dims) {
      Object.assign(this, { type, data, dims });
    }
  }, InferenceSession: { create: async () => session } };
}
const memory = { name: 'memory', read: async () => new Uint8Array(0), neighbour: () => memory };
const input = { x: { data: Float32Array.of(1, 2), shape: [1, 2] } };
test('runs follow one another, also after one that failed', async () => {
  let running = 0, most = 0, count = 0;
  const network = await Network.open(fakeOrt(async ({ x }) => {
    most = Math.max(most, ++running);
    await new Promise((resolve) => setTimeout(resolve, 2));
    --running;
    if (++count === 2) throw new Error('no memory');
    return { y: { data: x.data, dims: x.dims } };
  }), memory, { kind: 'export', system: 's', details: {} });
  const found = await Promise.allSettled([network.run(input), network.run(input), network.run(input)]);
  assert.deepEqual(found.map(({ status }) => status), ['fulfilled', 'rejected', 'fulfilled']);
  assert.match(found[1].reason.message, /memory\/model\.onnx: the network does not run \(no memory\)/);
  assert.equal(most, 1);
});
test('an output that is not finite, and names of another network, are refused', async () => {
  const network = await Network.open(fakeOrt(async () => ({ y: { data: Float32Array.of(NaN), dims: [1] } })), memory, { kind: 'export', system: 's', details: {} });
  await assert.rejects(network.run(input), /'y' has a number that is not finite/);
  assert.throws(() => network.requireNames(['crop'], ['y']), /the network reads x \(expected crop\)/);
  assert.throws(() => network.requireNames(['x'], ['z']), /no output 'z' \(it has y\)/);
  assert.deepEqual(network.inputShape('x'), [undefined, 2]);
});
