// node tests/studio/page/measure.mjs PROGRAM: times and sizes of the page of `daumier studio`, on an otherwise idle machine.
// Prints sizes of the page, times of first views in new profiles, times from the end of a stroke to the vertices that it has shaped (software
// drawing apart) twice, with WebGL drawn by the processor and with WebGL that draws nothing, as a graphics card leaves the processor free; and
// the frames that a resting page requests. By hand; no test.
import { mkdtempSync, rmSync } from 'node:fs';
import { cpus, loadavg, tmpdir } from 'node:os';
import { join } from 'node:path';
import { setTimeout as delay } from 'node:timers/promises';
import { gzipSync } from 'node:zlib';
import { startStudio } from '../../../tools/consumers/studio/client.mjs';
import { launchBrowser, newPage } from './browser.mjs';
import { portraitStrokes } from './strokes.mjs';
import { StudioDriver } from './studio_driver.mjs';

const kNumViews = 7, kNumStrokes = 20, kMsPerPoint = 10, kRestMs = 2000;
const [program] = process.argv.slice(2);

/** The smallest value that a share of the values does not exceed. */
function quantile(values, share) {
  return [...values].sort((a, b) => a - b)[Math.max(0, Math.ceil(share * values.length) - 1)];
}
function printTimes(name, values) {
  const [median, high, most] = [0.5, 0.95, 1].map((share) => quantile(values, share).toFixed(0).padStart(6));
  console.log(`${name.padEnd(44)} median ${median} ms, 95 % within ${high} ms, greatest ${most} ms (${values.length})`);
}

async function printSizes(api) {
  const sum = { raw: 0, gzip: 0 };
  for (const path of ['/', '/page.css', '/page.js']) {
    const bytes = await api.must('GET', path);
    const size = { raw: bytes.length, gzip: gzipSync(bytes).length };
    for (const kind of Object.keys(sum)) sum[kind] += size[kind];
    console.log(`${path.padEnd(12)} ${size.raw} bytes, ${size.gzip} by gzip`);
  }
  console.log(`${'page'.padEnd(12)} ${sum.raw} bytes, ${sum.gzip} by gzip`);
}

/** Runs in the page before its own code: notes when the first screen and the head on it are there, and counts requested frames. */
function observePage() {
  const times = (window.studioTimes = {});
  window.framesRequested = 0;
  const request = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (act) => {
    window.framesRequested += 1;
    return request(act);
  };
  let faceArrived = false;
  const look = () => {
    if (!times.screen && document.querySelector('.start:not([hidden]) h2')) times.screen = performance.now();
    if (times.head || !faceArrived || !document.querySelector('.view-stage canvas')) return;
    times.head = -1;
    // The first frame draws the head, the second one begins when it is drawn.
    request(() => request(() => (times.head = performance.now())));
  };
  new MutationObserver(look).observe(document, { subtree: true, childList: true, attributes: true });
  new PerformanceObserver((entries) => {
    faceArrived ||= entries.getEntries().some((entry) => new URL(entry.name).pathname === '/api/shape');
    look();
  }).observe({ type: 'resource', buffered: true });
}

/** Runs in the page before its own code: WebGL is there and draws nothing. */
function drawNothing() {
  for (const name of ['drawElements', 'drawArrays', 'drawElementsInstanced', 'drawArraysInstanced', 'clear', 'blitFramebuffer']) {
    WebGL2RenderingContext.prototype[name] = () => {};
  }
}

async function firstView(browser, server) {
  const page = await newPage(browser);
  await page.addInitScript(observePage);
  await page.goto(server.address);
  await page.waitForFunction(() => window.studioTimes.head > 0, null, { polling: 100 });
  const times = await page.evaluate(() => ({ paint: performance.getEntriesByName('first-contentful-paint')[0].startTime, ...window.studioTimes }));
  await page.context().close();
  return times;
}

/** Draws at the pace of a hand, waits for the face after each stroke, then rests. */
async function drawAndRest(browser, server, isDrawn) {
  const studio = new StudioDriver(await newPage(browser), server);
  const { page } = studio;
  await page.addInitScript(observePage);
  if (!isDrawn) await page.addInitScript(drawNothing);
  await studio.open();
  await studio.press('Empty sheet');
  const { sheet } = await studio.sessionWhere('an empty drawing', (state) => state.lines.length === 0);
  await page.locator('.start').waitFor({ state: 'hidden' });
  const numFaces = () => page.evaluate(() => window.daumierFinalTimes?.length ?? 0);
  for (const [index, stroke] of portraitStrokes(sheet).slice(0, kNumStrokes).entries()) {
    const [first, ...rest] = await studio.onScreen(stroke, sheet);
    await page.mouse.move(...first);
    await page.mouse.down();
    for (const point of rest) {
      void page.mouse.move(...point);
      await delay(kMsPerPoint);
    }
    await page.mouse.up();
    await studio.until(`the face of stroke ${index + 1}`, async () => (await numFaces()) > index);
    await delay(300);
  }
  await delay(kRestMs);
  const before = await page.evaluate(() => window.framesRequested);
  await delay(kRestMs);
  const frames = (await page.evaluate(() => window.framesRequested)) - before;
  const [first, last, ofServer] = await page.evaluate(() => [window.daumierTimes, window.daumierFinalTimes, window.daumierServerTimes]);
  await page.context().close();
  return { first, last, ofServer, frames };
}

if (!program) {
  console.error('usage: node tests/studio/page/measure.mjs PROGRAM');
  process.exit(2);
}
const folder = mkdtempSync(join(tmpdir(), 'studio-measure-'));
console.log(`${cpus().length} cores, load ${loadavg()[0].toFixed(2)} before the start (expected: below 0.5)`);
const server = await startStudio(program, folder);
const browser = await launchBrowser();
try {
  await printSizes(server.api);
  const views = [];
  for (let i = 0; i < kNumViews; ++i) views.push(await firstView(browser, server));
  console.log(`The first of ${kNumViews} first views: ${['paint', 'screen', 'head'].map((name) => `${name} ${views[0][name].toFixed(0)} ms`).join(', ')}`);
  printTimes('first contentful paint', views.map((view) => view.paint));
  printTimes('first screen in the page', views.map((view) => view.screen));
  printTimes('first head drawn', views.map((view) => view.head));
  for (const isDrawn of [true, false]) {
    const { first, last, ofServer, frames } = await drawAndRest(browser, server, isDrawn);
    console.log(isDrawn ? 'WebGL drawn by the processor:' : 'WebGL that draws nothing:');
    printTimes('  pen up to first vertices (daumierTimes)', first);
    printTimes('  pen up to last vertices (daumierFinalTimes)', last);
    printTimes('  of these in the server (daumierServerTimes)', ofServer);
    printTimes('  and elsewhere', last.map((time, i) => time - ofServer[i]));
    console.log(`  frames requested in ${kRestMs / 1000} s of rest: ${frames} (expected: 0)`);
  }
} finally {
  await browser.close();
  server.child.kill();
  await server.ended;
  rmSync(folder, { recursive: true, force: true });
}
