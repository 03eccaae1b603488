// node tests/web/measure_surfaces.mjs PROGRAM BUILD RUN: a run of `deform`, exported, decodes codes of `daumier edit` in Chromium: the largest
// difference from the C++ runtime's kernel, and times (docs/web.md).
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { repository } from '../../tools/consumers/studio/client.mjs';
import { openPage, unpacked } from './page.mjs';
import { difference, Program, verticesOfObj } from './program.mjs';

const kRuns = 11;
const [path, build, run] = process.argv.slice(2), scratch = mkdtempSync(join(tmpdir(), 'daumier-surfaces-')), program = new Program(resolve(path), scratch);
program.run('export', run, '--out', join(scratch, 'export'));
program.run('edit', run, '--random', '3', '--seed', '3', '--out', join(scratch, 'edit'));
const { faces } = JSON.parse(readFileSync(join(scratch, 'edit/edit.json'), 'utf8'));
try {
  for (const threads of [1, 2]) {
    const { page, close } = await openPage({ '/ort/': join(repository, 'web/node_modules/onnxruntime-web/dist'), '/daumier/': resolve(build), '/export/': join(scratch, 'export') }, { threads });
    const found = await page.evaluate(async ([codes, runs]) => {
      const begin = performance.now(), model = await daumier.openDeformModel(ort, '/export'), opened = performance.now() - begin, times = [], surfaces = [];
      for (const code of codes) surfaces.push(packed(await model.decode(Float32Array.from(code))));
      for (let i = 0; i < runs; ++i) {
        const start = performance.now();
        await model.decode(Float32Array.from(codes[0]));
        times.push(performance.now() - start);
      }
      return { opened, times: times.sort((a, b) => a - b), surfaces };
    }, [faces.map(({ latent }) => latent), kRuns]);
    await close();
    const shares = faces.map(({ name }, i) => {
      const surface = unpacked(found.surfaces[i]);
      return difference(surface, verticesOfObj(join(scratch, `edit/${name}.obj`), surface.length));
    });
    console.log(`${threads} threads: opened in ${found.opened.toFixed(0)} ms; a surface: least ${found.times[0].toFixed(0)} ms, median ${found.times[kRuns >> 1].toFixed(0)} ms; difference at most ${Math.max(...shares).toExponential(1)} of the largest value`);
  }
} finally {
  rmSync(scratch, { recursive: true, force: true });
}
