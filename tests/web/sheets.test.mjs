import assert from 'node:assert/strict';
import test from 'node:test';
import { drawnFace, scribbledFace, titledFace, twoFaces } from './drawings.mjs';
import { load } from './package.mjs';

const { mapToCanvas, sheetPlacement } = await load('drawing');
const { largestFace } = await load('faces_on_sheet');
const { inkOf } = await load('raster');
const { sparseStrokes } = await load('sparse_strokes');
const { distanceOfBoxes, gatheredGroups, joinNeighbours } = await load('stroke_groups');

test('one face stays whole, in its order', () => {
  const { strokes } = drawnFace(3);
  assert.deepEqual(largestFace(strokes), { strokes, numFaces: 1, numLeftOut: 0 });
});
test('a title below a face is left out', () => {
  const { strokes } = titledFace(2);
  assert.deepEqual(largestFace(strokes), { strokes: strokes.slice(0, -7), numFaces: 1, numLeftOut: 7 });
});
test('of two faces the larger one is taken, with its strokes alone', () => {
  const { strokes } = twoFaces(1), half = strokes.length / 2, height = (stroke) => Math.max(...stroke.map(([, y]) => y)) - Math.min(...stroke.map(([, y]) => y));
  const larger = height(strokes[0]) > height(strokes[half]) ? strokes.slice(0, half) : strokes.slice(half);
  assert.deepEqual(largestFace(strokes), { strokes: larger, numFaces: 2, numLeftOut: 0 });
});
test('strokes of one cell are one group, and near groups are joined', () => {
  const square = (x, side) => [[x, 0], [x + side, 0], [x + side, side], [x, side]];
  const groups = gatheredGroups([square(0, 100), square(0.1, 100), square(110, 100), square(400, 100)]);
  assert.deepEqual(groups.map(({ strokes }) => strokes), [[0, 1], [2], [3]]);
  assert.ok(Math.abs(distanceOfBoxes(groups[1].box, groups[2].box) - 190) < 1e-12);
  joinNeighbours(groups);
  assert.deepEqual(groups.map(({ strokes }) => strokes), [[0, 1, 2], [3]]);
  assert.equal(groups[1].length, 300);
});

test('few strokes are returned as they are', () => {
  const { strokes } = drawnFace(1);
  assert.equal(sparseStrokes(strokes, 1), strokes);
});
test('a line that is drawn a hundred times becomes about one', () => {
  const line = [[0, 0], [200, 50]], sparse = sparseStrokes(new Array(100).fill(line), 1);
  assert.ok(sparse.length < 3, `${sparse.length} strokes`);
});
test('a scribble loses points, and its picture hardly changes', () => {
  const drawing = scribbledFace(1), frame = sheetPlacement(drawing), sparse = sparseStrokes(drawing.strokes, frame.scale), numPoints = (of) => of.reduce((sum, stroke) => sum + stroke.length, 0);
  const [before, after] = [drawing.strokes, sparse].map((strokes) => inkOf(mapToCanvas(strokes, frame), 128));
  assert.ok(numPoints(sparse) < 0.7 * numPoints(drawing.strokes), `${numPoints(sparse)} of ${numPoints(drawing.strokes)} points`);
  const difference = before.reduce((sum, ink, i) => sum + Math.abs(ink - after[i]), 0) / before.reduce((sum, ink) => sum + ink, 0);
  assert.ok(difference < 0.06, `${difference} of the ink`);
});
