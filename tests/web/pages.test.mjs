// The page of web/README.md and the example's module, without a browser: what they say of errors, and what they load.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import test from 'node:test';
import { exampleMounts } from '../../web/example/mounts.mjs';
import { repository } from '../../tools/consumers/studio/client.mjs';
import { readmePage } from './readme_page.mjs';

const module = /<script type="module">\n(.*)<\/script>/s.exec(readmePage)[1];
const example = readFileSync(join(repository, 'web/example/example.js'), 'utf8');

/** Runs a module with replacements of its imports and for the document. Returns {canvas, said}. */
async function runPage(text, predict) {
  const said = [], canvas = { width: 400, height: 400, getContext: () => ({ beginPath() {}, lineTo() {}, stroke() {} }), setPointerCapture() {} };
  const status = { set textContent(value) { said.push(value); } };
  const element = (name) => (/^(canvas|paper|view)$/.test(name) ? canvas : status);
  const model = { template: { triangles: [] }, predict }, body = text.replace(/^import .*$/gm, '');
  const FaceView = class { show() {} };
  const run = new Function('ort', 'openSketchModel', 'FaceView', 'document', `return (async () => {${body}})()`);
  await run({ env: { wasm: {} } }, async () => model, FaceView, { querySelector: element, getElementById: element });
  return { canvas, said };
}
for (const [name, text] of [['the page of the README', module], ['the example', example]])
  test(`${name} shows the message of a tap as first line, and the next face`, async () => {
    let isTap = true;
    const { canvas, said } = await runPage(text, async () => {
      if (isTap) throw new Error('drawing: it has no extent. Draw a face by lines');
      return { vertices: new Float32Array(30), warnings: ['a warning'] };
    });
    canvas.onpointerdown({ pointerId: 1, offsetX: 1, offsetY: 1 });
    await canvas.onpointerup();
    assert.equal(said.at(-1), 'drawing: it has no extent. Draw a face by lines');
    isTap = false;
    canvas.onpointermove({ buttons: 1, offsetX: 9, offsetY: 9 });
    await canvas.onpointerup();
    assert.equal(said.at(-1), 'a warning');
  });

test('the page of the README loads files that are there', () => {
  const { imports } = JSON.parse(/importmap">(.*)<\/script>/.exec(readmePage)[1]), mounts = exampleMounts(process.env.DAUMIER_WEB);
  const named = [...module.matchAll(/from "([^"]+)"/g)].map(([, name]) => imports[name]);
  assert.equal(named.length, 2);
  for (const address of [...named, '/weights/sketch-ict/manifest.json']) {
    const mount = Object.keys(mounts).find((each) => each !== '/' && address.startsWith(each));
    assert.ok(existsSync(join(mounts[mount], address.slice(mount.length))), address);
  }
});
test('the README says how to build and pack', () => {
  const readme = readFileSync(join(repository, 'web/README.md'), 'utf8'), { version, scripts } = JSON.parse(readFileSync(join(repository, 'web/package.json'), 'utf8'));
  assert.ok(scripts.build !== undefined && readme.includes('npm ci --ignore-scripts && npm run build'));
  assert.ok(readme.includes(`daumier-web-${version}.tgz`));
});
