// Runs an ONNX model on the CPU in ONNX Runtime: node run_onnx.mjs REQUEST.json
// The request: {"model": FILE, "runs": [{"inputs": [{"name", "dims", "file"}], "outputs": [{"name", "file"}]}]}; the files hold raw
// little-endian float32. Prints {"runtime": "onnxruntime-node VERSION", "outputs": [{NAME: DIMS}]}, an entry a run. With "timed_runs": N in
// the request every run is repeated N times, and "milliseconds" holds the median time of each.
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';

const require = createRequire(import.meta.url);
const ort = require('onnxruntime-node');
const { version } = require('onnxruntime-node/package.json');

function readFloats(file) {
  const bytes = readFileSync(file);
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

async function medianMilliseconds(numRuns, run) {
  const times = [];
  for (let i = 0; i < numRuns; ++i) {
    const start = performance.now();
    await run();
    times.push(performance.now() - start);
  }
  return times.sort((a, b) => a - b)[Math.floor(numRuns / 2)];
}

try {
  const request = JSON.parse(readFileSync(process.argv[2], 'utf8'));
  const session = await ort.InferenceSession.create(request.model, { executionProviders: ['cpu'] });
  const dims = [];
  const milliseconds = [];
  for (const run of request.runs) {
    const feeds = {};
    for (const input of run.inputs) feeds[input.name] = new ort.Tensor('float32', readFloats(input.file), input.dims);
    const runSession = () => session.run(feeds, run.outputs.map((output) => output.name));
    const results = await runSession();
    if (request.timed_runs > 0) milliseconds.push(await medianMilliseconds(request.timed_runs, runSession));
    for (const { name, file } of run.outputs) {
      const { data } = results[name];
      writeFileSync(file, Buffer.from(data.buffer, data.byteOffset, data.byteLength));
    }
    dims.push(Object.fromEntries(run.outputs.map(({ name }) => [name, results[name].dims])));
  }
  console.log(JSON.stringify({ runtime: `onnxruntime-node ${version}`, outputs: dims, milliseconds }));
} catch (error) {
  console.error(error.message);
  process.exit(1);
}
