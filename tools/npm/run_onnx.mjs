// Runs an ONNX model on the CPU in ONNX Runtime: node run_onnx.mjs REQUEST.json
// The request: {"model": FILE, "input": {"name", "dims", "file"}, "outputs": [{"name", "file"}, ...]}; files hold raw little-endian
// float32. Prints {"runtime": "onnxruntime-node VERSION", "outputs": {NAME: DIMS}}.
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';

const require = createRequire(import.meta.url);
const ort = require('onnxruntime-node');
const { version } = require('onnxruntime-node/package.json');

const request = JSON.parse(readFileSync(process.argv[2], 'utf8'));
const session = await ort.InferenceSession.create(request.model, { executionProviders: ['cpu'] });
const bytes = readFileSync(request.input.file);
const values = new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
const feeds = { [request.input.name]: new ort.Tensor('float32', values, request.input.dims) };
const names = request.outputs.map((output) => output.name);
const results = await session.run(feeds, names);

const dims = {};
for (const { name, file } of request.outputs) {
  const { data } = results[name];
  writeFileSync(file, Buffer.from(data.buffer, data.byteOffset, data.byteLength));
  dims[name] = results[name].dims;
}
console.log(JSON.stringify({ runtime: `onnxruntime-node ${version}`, outputs: dims }));
