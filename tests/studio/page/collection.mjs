// node tests/studio/page/collection.mjs PROGRAM [DRAWINGS]: a collection from its first drawing to a trained network. The drawings are SYNTHETIC: the
// program's own contours of each face (`daumier draw`), moved by a smooth tremor and given in by the calls that the page uses. Then `daumier train`
// for a few steps and `daumier eval`. A test of `./dev test`; by hand with more drawings (docs/studio_studies.md).
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { repository, startServer } from '../../../tools/consumers/studio/client.mjs';

const kCanvas = 256, kSheet = 512, kPersons = 2, kMostStrokes = 60, kPointsOfStroke = 40, kStepMs = 12;
const program = process.argv[2], numDrawings = Number(process.argv[3] ?? 12);
const folder = mkdtempSync(join(tmpdir(), 'collection-'));
const at = (...parts) => join(folder, ...parts);

function run(...words) {
  const begun = performance.now();
  const printed = execFileSync(program, words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
  console.log(`${words[0]}: ${((performance.now() - begun) / 1e3).toFixed(1)} s`);
  return printed;
}
function check(holds, what) {
  if (!holds) throw new Error(`it does not hold: ${what}`);
}

/** Numbers from 0 to 1 that are the same in each run. */
function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** The contours of a face as strokes of a pen on the sheet. */
function strokesOf(mesh, random) {
  const drawing = at('contours.svg');
  execFileSync(program, ['draw', mesh, '--out', drawing, '--force'], { stdio: 'ignore' });
  const scale = kSheet / kCanvas;
  const lines = [...readFileSync(drawing, 'utf8').matchAll(/<path class="\w+" d="M([^"]+)"/g)]
    .map((path) => path[1].split('L').map((pair) => pair.trim().split(/\s+/).map((number) => scale * Number(number))))
    .filter((line) => line.length > 1)
    .sort((a, b) => b.length - a.length)
    .slice(0, kMostStrokes);
  let time = 0;
  return lines.map((line) => {
    const count = Math.min(line.length, kPointsOfStroke);
    const phase = 6.3 * random(), reach = 0.5 + 1.5 * random();
    const points = Array.from({ length: count }, (_, i) => {
      const [x, y] = line[Math.round((i * (line.length - 1)) / Math.max(1, count - 1))];
      return [x + reach * Math.sin(0.3 * i + phase), y + reach * Math.cos(0.23 * i + phase)];
    });
    time += 300;
    return { points, times_ms: points.map(() => (time += kStepMs)), pressures: points.map(() => 0.4 + 0.5 * random()) };
  });
}

async function collect(person, count) {
  const options = ['--collect', at('faces'), '--out', at('collection'), '--person', String(person), '--count', String(count)];
  const server = await startServer(program, options);
  const meshes = readdirSync(at('faces')).filter((name) => name.endsWith('.obj')).sort();
  const random = randomNumbers(person);
  const times = [];
  let state = await server.api.must('GET', '/api/collect');
  while (state.face !== null) {
    const strokes = strokesOf(at('faces', meshes[state.face.number]), random);
    const seconds = strokes.at(-1).times_ms.at(-1) / 1e3;
    const begun = performance.now();
    state = await server.api.must('POST', '/api/collect/drawings', { face: state.face.number, width: 3, seconds, strokes });
    times.push(performance.now() - begun);
  }
  server.child.kill('SIGINT');
  await server.ended;
  console.log(`person ${person}: ${times.length} drawings, ${Math.max(...times).toFixed(0)} ms at most for one`);
  check(times.length === count, `person ${person} draws ${count} faces`);
}

try {
  run('edit', '--random', String(numDrawings), '--seed', '1', '--steps', '1', '--out', at('faces'));
  rmSync(at('faces', 'mean.obj'));
  for (let person = 1; person <= kPersons; ++person) await collect(person, Math.floor(numDrawings / kPersons));
  const data = [`data.faces=${at('collection/faces')}`, `data.sketches=${at('collection/sketches')}`];
  const collected = ['bilinear.num_identity=4', 'bilinear.num_expression=1', 'sketch.all_views=true'];
  const small = ['epochs=2', 'batch=4', 'network.width=24', 'network.hidden=64', 'network.branch=64', 'network.shape_hidden=64'];
  run('train', join(repository, 'configs/sketch/cpu.toml'), '--out', at('run'), ...data, ...collected, ...small);
  const printed = run('eval', at('run'), '--faces', at('collection/faces'), '--sketches', at('collection/sketches'));
  console.log(printed.trim());
  check(existsSync(at('run', 'manifest.json')), 'a run was written');
} finally {
  if (process.env['KEEP']) console.log(folder);
  else rmSync(folder, { recursive: true, force: true });
}
