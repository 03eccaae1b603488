// Runs an ONNX model on the CPU in ONNX Runtime: node run_onnx.mjs REQUEST.json
// The request: {"model": FILE, "runs": [{"inputs": [{"name", "dims", "file"}], "outputs": [{"name", "file"}]}]}; the files hold raw
// little-endian float32. Prints {"runtime": "onnxruntime-node VERSION", "outputs": [{NAME: DIMS}]}, an entry a run.
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';

const require = createRequire(import.meta.url);
const ort = require('onnxruntime-node');
const { version } = require('onnxruntime-node/package.json');

function readFloats(file) {
  const bytes = readFileSync(file);
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

try {
  const request = JSON.parse(readFileSync(process.argv[2], 'utf8'));
  const session = await ort.InferenceSession.create(request.model, { executionProviders: ['cpu'] });
  const dims = [];
  for (const run of request.runs) {
    const feeds = {};
    for (const input of run.inputs) feeds[input.name] = new ort.Tensor('float32', readFloats(input.file), input.dims);
    const results = await session.run(feeds, run.outputs.map((output) => output.name));
    for (const { name, file } of run.outputs) {
      const { data } = results[name];
      writeFileSync(file, Buffer.from(data.buffer, data.byteOffset, data.byteLength));
    }
    dims.push(Object.fromEntries(run.outputs.map(({ name }) => [name, results[name].dims])));
  }
  console.log(JSON.stringify({ runtime: `onnxruntime-node ${version}`, outputs: dims }));
} catch (error) {
  console.error(error.message);
  process.exit(1);
}
