// node tests/studio/page/measure_api.mjs PROGRAM: times of the studio's calls without a browser, on an otherwise idle machine: strokes of the
// example `front`, one every 300 ms, and shapes. By hand; no test.
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { setTimeout as delay } from 'node:timers/promises';
import { repository, startStudio } from '../../../tools/consumers/studio/client.mjs';

const kRestMs = 300, kNumStrokes = 22, kNumShapes = 10;
const folder = mkdtempSync(join(tmpdir(), 'studio-api-'));
const studio = await startStudio(process.argv[2], folder);

/** Milliseconds of a call. */
async function timeOf(method, path, body) {
  const begun = performance.now();
  await studio.api.must(method, path, body);
  return performance.now() - begun;
}
function printTimes(name, times) {
  const sorted = [...times].sort((a, b) => a - b);
  const at = (share) => sorted[Math.ceil(share * sorted.length) - 1].toFixed(1);
  console.log(`${name.padEnd(32)} median ${at(0.5)} ms, 95 % within ${at(0.95)} ms (${times.length})`);
}

const strokes = JSON.parse(readFileSync(join(repository, 'docs/examples/sessions/front.json'), 'utf8'))
  .events.filter((event) => event.do === 'draw').slice(0, kNumStrokes);
const { id } = await studio.api.must('POST', '/api/sessions', { begin: 'blank' });
const previews = [], events = [], faces = [];
for (const stroke of strokes) {
  previews.push(await timeOf('POST', `/api/sessions/${id}/preview`, { points: stroke.points }));
  events.push(await timeOf('POST', `/api/sessions/${id}/events`, stroke));
  faces.push(await timeOf('GET', `/api/sessions/${id}/vertices`));
  await delay(kRestMs);
}
printTimes('preview of a stroke', previews);
printTimes('stroke', events);
printTimes('vertices', faces);

const shapes = {
  'control': (i) => ({ controls: { nose_wings_left: i / 10 } }),
  'caricature': (i) => ({ caricature: i / 10 }),
  'exaggeration': (i) => ({ exaggeration: i / 50 }),
  'handle': (i) => ({ handles: [{ vertex: 2000, move: [0, i / 20, 0] }] }),
  'expression': (i) => ({ expressions: { jawOpen: i / 20 } }),
  'expression on a changed face': (i) => ({ controls: { nose_wings_left: i / 10 }, expressions: { jawOpen: 0.5 } }),
};
for (const [name, shape] of Object.entries(shapes)) {
  const times = [];
  for (let i = 1; i <= kNumShapes; ++i) times.push(await timeOf('POST', '/api/shape', shape(i)));
  printTimes(name, times);
}
studio.child.kill();
await studio.ended;
rmSync(folder, { recursive: true, force: true });
