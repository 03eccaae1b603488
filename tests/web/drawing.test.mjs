import assert from 'node:assert/strict';
import test from 'node:test';
import { load } from './package.mjs';

const { checkedStrokes, composed, inverse, mapToCanvas, sheetPlacement, toCanvas, toSheet } = await load('drawing');
const { withoutFarMarks } = await load('framing');
const { inkOf, rasteriseStrokes, sampleRows } = await load('raster');

const kTurned = { scale: 1.7, shift: [-3, 11], turnDegrees: 33 };
function near(found, expected, tolerance = 1e-9) {
  assert.equal(found.length, expected.length);
  found.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) <= tolerance, `${value}, expected ${expected[i]}`));
}

test('a placement turns clockwise: (1, 0) by 90 degrees is (0, 1), y down', () => {
  near(toCanvas({ scale: 2, shift: [10, 20], turnDegrees: 90 }, [1, 0]), [10, 22]);
});
test('toSheet undoes toCanvas, and the inverse is a placement', () => {
  near(toSheet(kTurned, toCanvas(kTurned, [5, -7])), [5, -7]);
  near(toCanvas(inverse(kTurned), toCanvas(kTurned, [5, -7])), [5, -7]);
  const other = { scale: 0.3, shift: [1, 2], turnDegrees: -80 };
  near(toCanvas(composed(kTurned, other), [5, -7]), toCanvas(kTurned, toCanvas(other, [5, -7])));
});
test('a sheet of 512 x 256 gets 64 pixels of paper above and below', () => {
  assert.deepEqual(sheetPlacement({ width: 512, height: 256, strokes: [] }), { scale: 0.5, shift: [0, 64], turnDegrees: 0 });
});
test('strokes on the canvas are in single precision', () => {
  const [[[x]]] = mapToCanvas([[[1, 1]]], { scale: 1 / 3, shift: [0, 0], turnDegrees: 0 });
  assert.equal(x, Math.fround(1 / 3));
});
test('a drawing without strokes, or with a point that is not finite, is refused', () => {
  assert.throws(() => checkedStrokes({ width: 9, height: 9, strokes: [[]] }), /drawing: it has no strokes\. Draw a face first/);
  assert.throws(() => checkedStrokes({ width: 9, height: 9, strokes: [[[1, 2]], [[Infinity, 0]]] }), /a point of stroke 1 is \(Infinity, 0\)/);
  assert.throws(() => checkedStrokes({ width: 0, height: 9, strokes: [[[1, 2]]] }), /the sheet has 0 x 9 pixels/);
});

test('a level line 1.5 wide covers its row wholly and a quarter of the rows next to it', () => {
  const pixels = rasteriseStrokes([[[50, 100.5], [200, 100.5]]], 256), column = [99, 100, 101, 98].map((row) => pixels[256 * row + 120]);
  assert.deepEqual(column, [191, 0, 191, 255]);  // Half width 0.75: coverage 0.25 at a distance of 1.
});
test('one point is a dot, lines do not add up, what is outside is cut off', () => {
  assert.equal(rasteriseStrokes([[[10.5, 10.5]]], 256)[256 * 10 + 10], 0);
  const line = [[20.3, 30.1], [80.7, 44.9]];
  assert.deepEqual(rasteriseStrokes([line, line], 64), rasteriseStrokes([line], 64));
  assert.ok(rasteriseStrokes([[[-50, -50], [-20, 300]]], 64).every((value) => value === 255));
});
test('ink is 1 where the picture is black', () => {
  const line = [[[50, 100.5], [200, 100.5]]];
  assert.deepEqual([...inkOf(line, 256)].map((ink) => Math.round(255 * (1 - ink))), [...rasteriseStrokes(line, 256)]);
});
test('samples of a line from left to right are at equal distances, cosine 1 and sine 0', () => {
  assert.deepEqual([...sampleRows([[[0, 128], [256, 128]]], 2)], [-0.5, 0.5, 0, 0, 1, 1, 0, 0]);
});

test('a mark far outside of a drawing is left out', () => {
  const face = Array.from({ length: 41 }, (_, i) => [100 + 50 * Math.cos((i * Math.PI) / 20), 100 + 50 * Math.sin((i * Math.PI) / 20)]);
  const { strokes, box } = withoutFarMarks([face, [[400, 400], [401, 401]]]);
  assert.deepEqual(strokes, [face]);
  near([box.minX, box.maxX, box.minY, box.maxY], [50, 150, 50, 150]);
});
test('a drawing without extent is refused', () => {
  assert.throws(() => withoutFarMarks([[[5, 5]]]), /it has no extent/);
});
