// node tests/web/measure.mjs BUILD: sizes of the package and of what it fetches, and times in Chromium (docs/web.md). BUILD: the built package.
import { execFileSync } from 'node:child_process';
import { readdirSync, readFileSync } from 'node:fs';
import { loadavg } from 'node:os';
import { join, resolve } from 'node:path';
import { gzipSync } from 'node:zlib';
import { repository } from '../../tools/consumers/studio/client.mjs';
import { drawnFace } from './drawings.mjs';
import { openPage } from './page.mjs';

const kRuns = 21;
const build = resolve(process.argv[2]), web = join(repository, 'web'), weights = join(repository, 'weights'), ort = join(web, 'node_modules/onnxruntime-web/dist');

function printSize(name, files) {
  const bytes = files.map((file) => readFileSync(file)), sum = (list) => list.reduce((total, each) => total + each.length, 0);
  console.log(`${name}: ${sum(bytes)} bytes, ${sum(bytes.map((each) => gzipSync(each, { level: 9 })))} by gzip -9`);
}
const filesOf = (folder, names) => names.map((name) => join(folder, name));
printSize('modules of the package', filesOf(build, readdirSync(build).filter((name) => name.endsWith('.js'))));
printSize('onnxruntime-web', filesOf(ort, ['ort.wasm.min.mjs', 'ort-wasm-simd-threaded.mjs', 'ort-wasm-simd-threaded.wasm']));
for (const name of ['sketch-ict', 'parser', 'portrait'])
  printSize(name, filesOf(join(weights, name), ['manifest.json', 'network.onnx', 'network.safetensors', ...(name === 'portrait' ? ['identity.safetensors'] : [])]));
printSize('face-ict, template', filesOf(join(weights, 'face-ict'), ['template.json', 'template.safetensors']));
execFileSync(process.execPath, [join(web, 'node_modules/typescript/bin/tsc'), '-p', web]);
console.log(`npm pack: ${execFileSync('npm', ['pack', '--dry-run', '--ignore-scripts', '--json'], { cwd: web, encoding: 'utf8' }).match(/"size": (\d+)/)[1]} bytes`);

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const text = (values) => `least ${Math.min(...values).toFixed(1)} ms, median ${median(values).toFixed(1)} ms`;

for (const { isolated, threads } of [{ isolated: true, threads: 1 }, { isolated: true, threads: 2 }, { isolated: false, threads: 2 }]) {
  const { page, faults, close } = await openPage({ '/ort/': ort, '/daumier/': build, '/weights/': weights }, { isolated, threads });
  const times = await page.evaluate(async ([drawing, runs]) => {
    const timed = async (action) => {
      const begin = performance.now();
      await action();
      return performance.now() - begin;
    };
    let canvas, framed;
    const found = { isolated: crossOriginIsolated, open: await timed(async () => (framed = await daumier.openSketchModel(ort, '/weights/sketch-ict'))), again: [], canvas: [], framed: [] };
    for (let i = 0; i < 3; ++i) {
      await canvas?.release();
      found.again.push(await timed(async () => (canvas = await daumier.openSketchModel(ort, '/weights/sketch-ict', { framing: 'canvas' }))));
    }
    for (let i = 0; i < runs; ++i) {
      found.canvas.push(await timed(() => canvas.predict(drawing)));
      found.framed.push(await timed(() => framed.predict(drawing)));
    }
    return found;
  }, [drawnFace(1), kRuns]);
  console.log(`${threads} threads set, ${times.isolated ? 'isolated' : 'not isolated, so 1'} (load ${loadavg()[0].toFixed(1)}):`);
  console.log(`  onnxruntime-web, both networks and the template until they are ready: ${times.open.toFixed(0)} ms; the network and the template again: ${text(times.again)}`);
  console.log(`  a face on the canvas: ${text(times.canvas)}; framed by the parser: ${text(times.framed)}`);
  if (faults.length > 0) console.log(`  the page reports: ${faults.join('; ')}`);
  await close();
}
