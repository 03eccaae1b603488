// node tests/studio/page/smoke.mjs PROGRAM [SHOTS_FOLDER]: the page of `daumier studio` in a browser, used by pointer and buttons.
// Draws a face, redraws an eye, drags a handle, exports a .glb, reloads, paints handles and moves them, draws with a pen's pressure. Exit code 0: all is well; 1: sentences say what is not; 77: no browser.
// SHOTS_FOLDER receives a screenshot after each step.
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { setTimeout as delay } from 'node:timers/promises';
import { stripVTControlCharacters } from 'node:util';
import { repository, startStudio } from '../../../tools/consumers/studio/client.mjs';
import { accessibilityFaults } from './accessibility.mjs';
import { kSkipped, launchBrowser, Missing, newPage, npmPackage } from './browser.mjs';
import { arc, distanceBetween, kUpperLid, nearestLine, portraitStrokes } from './strokes.mjs';
import { StudioDriver } from './studio_driver.mjs';

const kMostSeconds = 110;  // Below the limit of CTest, so that no process is left.
const kLidRise = 9;  // Pixels of the sheet.
const kMoveByPixels = 25;
const [program, shotsFolder] = process.argv.slice(2);

function check(condition, sentence) {
  if (!condition) throw new Error(sentence);
}
async function checkAccessible({ page }) {
  const faults = await accessibilityFaults(page);
  check(faults.length === 0, `axe-core has violations:\n  ${faults.join('\n  ')}`);
}

async function opensOnTheFirstScreen(studio) {
  await studio.open();
  await studio.until('three examples', async () => (await studio.page.locator('.start-example').count()) === 3);
  await checkAccessible(studio);
  await studio.press('Help');
  await checkAccessible(studio);
  await studio.page.keyboard.press('Escape');
}

async function drawsAFace(studio) {
  await studio.press('Empty sheet');
  const { sheet } = await studio.sessionWhere('an empty drawing', (state) => state.lines.length === 0);
  await studio.page.locator('.start').waitFor({ state: 'hidden' });
  const emptyView = await studio.viewPicture();
  const strokes = portraitStrokes(sheet);
  const [outline, ...others] = strokes;

  await studio.stroke(outline, sheet);
  await studio.sessionWhere('a face after one stroke', (state) => state.has_face);
  const first = await studio.sessionVertices();
  await studio.until('what is still missing', () => studio.page.getByText('Still missing: both eyes, the nose and the mouth.').isVisible());
  for (const stroke of others) await studio.stroke(stroke, sheet);
  const { lines } = await studio.sessionWhere(`${strokes.length} lines`, (state) => state.lines.length === strokes.length);
  await studio.until('faces that the page has applied', () => studio.page.evaluate(() => (window.daumierFinalTimes?.length ?? 0) > 0));

  const last = await studio.sessionVertices();
  check(first.length > 0 && first.length === last.length && !first.equals(last), 'The strokes have not changed the vertices of the face.');
  const farthest = Math.max(...strokes.map((stroke, i) => distanceBetween(stroke, lines[i].points)));
  check(farthest < 2, `A line lies ${farthest.toFixed(1)} sheet pixels from where the pen was.`);
  const inked = await studio.inkedShare(strokes.flat(), sheet);
  check(inked > 0.95, `Of the points that the pen passed ${Math.round(100 * inked)} % have ink on the paper.`);
  await studio.until('no missing part', () => studio.page.getByText('All parts are there.').isVisible());
  check(!(await studio.viewPicture()).equals(emptyView), 'The 3-D view shows no face.');
  await checkAccessible(studio);
}

async function showsTheSideToo(studio) {
  const before = await studio.viewPicture();
  const toggle = studio.page.getByRole('button', { name: 'front and side at once' });
  await toggle.click();
  await studio.until('the small view', () => studio.page.locator('.view-second').isVisible());
  check(!(await studio.viewPicture()).equals(before), 'The small view shows nothing.');
  await checkAccessible(studio);
  await toggle.click();
  await studio.until('the view without the small one', async () => (await studio.viewPicture()).equals(before));
}

async function redrawsAnEye(studio) {
  await studio.press('Redraw');
  const before = await studio.sessionWhere('the mode Redraw', (state) => state.mode === 'follow_up');
  const { sheet } = before;
  const vertices = await studio.sessionVertices();
  const lid = nearestLine(before.lines.map((line) => line.points), portraitStrokes(sheet)[kUpperLid]);

  await studio.stroke(lid.slice(3, -3), sheet);
  const erased = await studio.sessionWhere('a gap in the lid', (state) => state.open_ends.length > 0);
  check(erased.lines.length === before.lines.length - 1, `Erasing one lid left ${erased.lines.length} of ${before.lines.length} lines.`);
  await studio.press('Pen');
  const [[from, to]] = erased.open_ends;
  const height = Math.max(...lid.map(([, y]) => (from[1] + to[1]) / 2 - y));
  const drawn = arc(from, to, height + kLidRise);
  await studio.stroke(drawn, sheet);
  const after = await studio.sessionWhere('the gap filled', (state) => state.open_ends.length === 0 && state.lines.length === before.lines.length);

  const curve = nearestLine(after.lines.map((line) => line.points), drawn);
  const missedBefore = distanceBetween(drawn, lid), missed = distanceBetween(drawn, curve);
  check(missed < missedBefore / 2, `The lid lies ${missed.toFixed(1)} sheet pixels from its new line, before ${missedBefore.toFixed(1)}.`);
  check(!vertices.equals(await studio.sessionVertices()), 'The redrawn eye has not changed the vertices of the face.');
  await checkAccessible(studio);
}

async function dragsAHandle(studio) {
  await studio.openTab('Shape');
  const before = await studio.shapeVertices();
  check(before.equals(await studio.sessionVertices()), 'The tab Shape begins with another face than that of the drawing.');
  const view = await studio.viewPicture();
  await studio.press('Move points');
  const [x, y] = await studio.viewMiddle();
  await studio.drag([0, 0.25, 0.5, 0.75, 1].map((share) => [x + share * kMoveByPixels, y + share * kMoveByPixels]));
  const dragged = await studio.shapeVertices();
  check(dragged.length === before.length && !dragged.equals(before), 'A dragged handle has not changed the vertices of the face.');
  check(!(await studio.viewPicture()).equals(view), 'A dragged handle has not changed the 3-D view.');
  await studio.page.locator('.p-shape details').evaluateAll((all) => all.forEach((each) => (each.open = true)));
  await checkAccessible(studio);

  await studio.press('Undo');
  check((await studio.shapeVertices()).equals(before), 'Undo has not restored the vertices.');
  await studio.press('Redo');
  check((await studio.shapeVertices()).equals(dragged), 'Redo has not restored the vertices.');
}

async function showsTheAvatar(studio) {
  await studio.openTab('Avatar');
  await studio.page.locator('#panel-avatar button').first().waitFor();
  await checkAccessible(studio);
}

async function exportsAHead(studio, { folder }) {
  await studio.openTab('Take away');
  const card = studio.page.locator('.p-card', { has: studio.page.getByRole('heading', { name: 'Head with expressions' }) });
  await card.locator('.p-card-make button').click();
  await card.locator('.p-files:not([hidden]), .p-job.p-ended:not([hidden])').first().waitFor({ timeout: 40000 });
  const link = card.locator('.p-file-list button', { hasText: '.glb' });
  check((await link.count()) === 1, `The head was not made: ${await card.innerText()}`);
  await checkAccessible(studio);

  const [download] = await Promise.all([studio.page.waitForEvent('download'), link.click()]);
  const file = join(folder, 'exported.glb');
  await download.saveAs(file);
  const validated = spawnSync(process.execPath, [join(repository, 'tools/npm/validate_gltf.mjs'), file], { encoding: 'utf8' });
  check(validated.status === 0, `gltf-validator rejects the exported head:\n${validated.stdout}${validated.stderr}`);
}

async function reloadKeepsTheDrawing(studio) {
  await studio.openTab('Draw');
  const before = await studio.session();
  await studio.page.reload();
  await studio.until('the paper after a reload', () => studio.page.locator('.paper').isVisible());
  await studio.until('the drawing on the paper', async () => (await studio.inkedShare(before.lines[0].points, before.sheet)) > 0.95);
  const name = await studio.page.getByLabel('Name of the drawing').inputValue();
  check(name === before.name, `After a reload the page shows the drawing "${name}", not "${before.name}".`);
  check((await studio.sessionId()) === before.id, 'After a reload the page shows another drawing.');
  const after = await studio.session();
  check(JSON.stringify(after.lines) === JSON.stringify(before.lines), 'After a reload the drawing has other lines.');
}

async function paintsHandles(studio) {
  await studio.press('Sculpt');
  const { sheet } = await studio.sessionWhere('the mode Sculpt', (state) => state.mode === 'refine');
  const middle = sheet.map((side) => side / 2);
  await studio.stroke([-20, 0, 20].map((x) => [middle[0] + x, middle[1]]), sheet);
  await studio.sessionWhere('handles', (state) => state.handles.length > 0);
  await studio.until('the buttons of handles', () => studio.page.getByRole('button', { name: 'Clear all handles' }).isVisible());
  await checkAccessible(studio);
}

async function movesHandlesBeforeTheReleaseShows(studio) {
  const { page } = studio;
  const { sheet, revision } = await studio.session();
  const middle = sheet.map((side) => side / 2);
  const places = await studio.onScreen([0, 5, 10, 15, 20, 25, 30].map((x) => [middle[0] + x, middle[1]]), sheet);
  let inFlight = 0, most = 0, done = 0;
  const isPreview = (request) => request.url().endsWith('/preview');
  page.on('request', (request) => isPreview(request) && (most = Math.max(most, ++inFlight)));
  page.on('requestfinished', (request) => isPreview(request) && (--inFlight, ++done));
  await page.keyboard.press('v');
  const before = await studio.viewPicture();
  await page.mouse.move(...places[0]);
  await page.mouse.down();
  for (const place of places.slice(1)) await page.mouse.move(...place);
  await studio.until('a preview of moved handles', () => done > 0 && inFlight === 0);
  check(most === 1, `${most} previews were under way at once.`);
  check(!(await studio.viewPicture()).equals(before), 'The face does not follow the handles while they are dragged.');
  await page.keyboard.press('Escape');
  await page.mouse.up();
  check((await studio.session()).revision === revision, 'A cancelled drag has changed the drawing.');
  await studio.until('the face as it was', async () => (await studio.viewPicture()).equals(before));
}

async function drawsWithPressure(studio) {
  await studio.press('Drawings');
  await studio.press('Empty sheet');
  const { sheet } = await studio.sessionWhere('an empty drawing', (state) => state.lines.length === 0);
  await studio.page.locator('.start').waitFor({ state: 'hidden' });
  const points = [...Array(9).keys()].map((i) => [100 + 30 * i, 200]);
  await studio.penStroke(points, points.map((_, i) => 0.1 + 0.1 * i), sheet);
  const { lines } = await studio.sessionWhere('the line of a pen', (state) => state.lines.length === 1);
  const { widths } = lines[0];
  check(widths?.at(-1) > 3 * widths?.[0], `The line has the widths ${widths}.`);
}

const steps = [
  ['opens on the first screen', opensOnTheFirstScreen],
  ['draws a face', drawsAFace],
  ['shows the side, too', showsTheSideToo],
  ['redraws an eye', redrawsAnEye],
  ['drags a handle', dragsAHandle],
  ['shows the tab Avatar', showsTheAvatar],
  ['exports a head', exportsAHead],
  ['keeps the drawing in a reload', reloadKeepsTheDrawing],
  ['paints handles in Sculpt', paintsHandles],
  ['moves them before the release', movesHandlesBeforeTheReleaseShows],
  ['draws with pressure', drawsWithPressure],
];

/** Runs the steps in order; the first that fails is the last. Returns sentences about what is wrong. */
async function runSteps(studio, place) {
  for (const [index, [name, step]] of steps.entries()) {
    const began = performance.now();
    const failure = await step(studio, place).then(() => null, (error) => error);
    if (shotsFolder) await studio.page.screenshot({ path: join(shotsFolder, `${index + 1}_${name.replaceAll(' ', '_')}.png`) });
    if (failure) return [`"${name}": ${stripVTControlCharacters(failure.message)}`, ...studio.faults];
    if (studio.faults.length > 0) return studio.faults.map((fault) => `"${name}": ${fault}`);
    console.log(`${((performance.now() - began) / 1000).toFixed(1).padStart(5)} s  ${name}`);
  }
  return [];
}

async function timeIsUp() {
  await delay(1000 * kMostSeconds, null, { ref: false });
  throw new Error(`The test takes more than ${kMostSeconds} s.`);
}

async function main() {
  const folder = mkdtempSync(join(tmpdir(), 'studio-page-'));
  let browser = null, server = null;
  try {
    for (const name of ['axe-core', 'gltf-validator']) npmPackage(name);
    browser = await launchBrowser();
    server = await startStudio(program, join(folder, 'studio'));
    if (shotsFolder) mkdirSync(shotsFolder, { recursive: true });
    const studio = new StudioDriver(await newPage(browser), server);
    const failures = await Promise.race([runSteps(studio, { folder }), timeIsUp()]);
    if (server.child.exitCode !== null) failures.push(`The server has ended with ${server.child.exitCode}.`);
    for (const failure of failures) console.log(`FAIL ${failure}`);
    return failures.length > 0 ? 1 : 0;
  } catch (error) {
    console.log(error instanceof Missing ? `skipped studio_page: ${error.message}` : `FAIL ${error.message}`);
    return error instanceof Missing ? kSkipped : 1;
  } finally {
    await browser?.close();
    server?.child.kill();
    await server?.ended;
    rmSync(folder, { recursive: true, force: true });
  }
}

if (!program) {
  console.error('usage: node tests/studio/page/smoke.mjs PROGRAM [SHOTS_FOLDER]');
  process.exit(2);
}
process.exit(await main());
