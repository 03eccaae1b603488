import assert from 'node:assert/strict';
import test from 'node:test';
import { drawnFace, scribbledFace, titledFace, twoFaces } from './drawings.mjs';
import { load } from './package.mjs';

const { checkPicture, drawingOfPicture, greyOf, readPicture, shrunk } = await load('picture');
const { colourPlanes, cropOfLandmarks, cropOfWhole, cropped } = await load('portrait_crop');
const { resizedByArea } = await load('resize');
const { thin } = await load('thinning');
const { mapToCanvas, sheetPlacement } = await load('drawing');
const { rasteriseStrokes } = await load('raster');

/** RGBA of rows of text: '#' ink, '.' paper, ' ' transparent. */
function pictureOf(rows) {
  const data = new Uint8ClampedArray(rows.flatMap((row) => [...row].flatMap((mark) => (mark === '#' ? [0, 0, 0, 255] : mark === '.' ? [255, 255, 255, 255] : [0, 0, 0, 0]))));
  return { width: rows[0].length, height: rows.length, data };
}

test('a thick bar is thinned to a line of one pixel, and a line stays', () => {
  const bar = Uint8Array.from({ length: 20 * 9 }, (_, i) => (i % 20 >= 2 && i % 20 < 18 && Math.floor(i / 20) >= 2 && Math.floor(i / 20) < 7 ? 1 : 0));
  const line = thin(bar, 20, 9), rows = [...line.keys()].filter((i) => line[i]).map((i) => Math.floor(i / 20));
  assert.deepEqual([...new Set(rows)], [4]);
  assert.ok(rows.length >= 10 && rows.length <= 16);
  assert.deepEqual(thin(line, 20, 9), line);
});
test('a ring stays closed', () => {
  const side = 21, ring = Uint8Array.from({ length: side * side }, (_, i) => {
    const distance = Math.hypot((i % side) - 10, Math.floor(i / side) - 10);
    return distance > 5 && distance < 9 ? 1 : 0;
  });
  const line = thin(ring, side, side), ends = [...line.keys()].filter((i) => line[i] && [1, -1, side, -side, side + 1, side - 1, -side - 1, 1 - side].filter((step) => line[i + step]).length < 2);
  assert.ok(line.some((value) => value === 1));
  assert.deepEqual(ends, []);
});

test('a line on a transparent canvas is one stroke along it', () => {
  const rows = Array.from({ length: 21 }, (_, y) => Array.from({ length: 41 }, (_, x) => (y >= 9 && y <= 11 && x >= 5 && x <= 35 ? '#' : ' ')).join(''));
  const { strokes, width, height } = drawingOfPicture(pictureOf(rows));
  assert.deepEqual([width, height, strokes.length], [41, 21, 1]);
  assert.ok(strokes[0].every(([x, y]) => Math.abs(y - 10.5) < 0.6 && x > 4 && x < 37));
  assert.ok(Math.abs(strokes[0][0][0] - strokes[0].at(-1)[0]) > 25);
});
test('an empty canvas and data of another size are refused', () => {
  assert.throws(() => drawingOfPicture(pictureOf(['...', '...'])), /picture: it has no lines\. Draw dark lines/);
  assert.throws(() => drawingOfPicture({ width: 2, height: 2, data: new Uint8Array(3) }), /3 numbers are no RGBA of 2 x 2 pixels \(expected 16\)/);
});
/** A ring, by a function from its coverage to RGBA. */
function ringPicture(colourOf, side = 120) {
  const data = new Uint8ClampedArray(4 * side * side);
  for (let i = 0; i < side * side; ++i) data.set(colourOf(Math.abs(Math.hypot((i % side) - 60, Math.floor(i / side) - 60) - 40) < 2), 4 * i);
  return { width: side, height: side, data };
}
test('white lines on black, or on a transparent canvas, are read as black ones on white, with a warning', () => {
  const black = readPicture(ringPicture((on) => (on ? [0, 0, 0, 255] : [255, 255, 255, 255])));
  assert.deepEqual(black.warnings, []);
  for (const colourOf of [(on) => (on ? [255, 255, 255, 255] : [0, 0, 0, 255]), (on) => (on ? [255, 255, 255, 255] : [0, 0, 0, 0])]) {
    const { drawing, warnings } = readPicture(ringPicture(colourOf));
    assert.deepEqual(drawing, black.drawing);
    assert.deepEqual(warnings, ['the picture shows light lines on dark: it is read inverted']);
  }
  assert.deepEqual(readPicture(ringPicture((on) => [0, 0, 0, on ? 255 : 0])), black);
});
test('generated drawings are not inverted, and their negatives have the same strokes', () => {
  for (const drawing of [drawnFace(1), drawnFace(2), titledFace(2), twoFaces(1), scribbledFace(1)]) {
    const pixels = rasteriseStrokes(mapToCanvas(drawing.strokes, sheetPlacement(drawing)), 256);
    const pictureIn = (level) => ({ width: 256, height: 256, data: Uint8ClampedArray.from({ length: 4 * pixels.length }, (_, i) => (i % 4 === 3 ? 255 : level(pixels[i >> 2]))) });
    const positive = readPicture(pictureIn((value) => value)), negative = readPicture(pictureIn((value) => 255 - value));
    assert.deepEqual([positive.warnings.length, negative.warnings.length], [0, 1]);
    assert.deepEqual(negative.drawing.strokes.length, positive.drawing.strokes.length);
  }
});
test('a picture that is none is refused with what was found and the repair', () => {
  const refused = (picture, message) => assert.throws(() => checkPicture(picture), (error) => error.name === 'DaumierError' && message.test(error.message));
  refused(undefined, /picture: it is undefined \(expected \{width, height, data\}\)\. Give context\.getImageData/);
  refused({ width: 2, height: 2, data: undefined }, /its data are undefined \(expected a Uint8ClampedArray of RGBA\)/);
  refused({ width: 2, height: 2, data: new Float32Array(16) }, /its data are a Float32Array/);
  refused({ width: 1.5, height: 2, data: new Uint8ClampedArray(12) }, /its size is 1\.5 x 2 \(expected whole numbers of pixels\)/);
  refused({ getContext() {} }, /expected its pixels\)\. Give context\.getImageData\(0, 0, canvas\.width, canvas\.height\) of context = canvas/);
});
test('half transparent black is grey over paper', () => {
  assert.ok(Math.abs(greyOf({ width: 1, height: 1, data: Uint8Array.of(0, 0, 0, 51) })[0] - 204) < 1e-4);
});
test('a smaller picture has the means of areas', () => {
  assert.deepEqual([...shrunk(Float32Array.of(0, 3, 6), 3, 1, 2, 1)], [1, 5]);
});

test('halves are means of four, rounded up from the half', () => {
  assert.deepEqual([...resizedByArea(Uint8Array.of(0, 1, 1, 0), 2, 2, 1, 1, 1)], [1]);
});
test('an area in thirds: 3 pixels to 2, by hand', () => {
  assert.deepEqual([...resizedByArea(Uint8Array.of(0, 90, 255, 0, 90, 255), 3, 2, 1, 2, 1)], [30, 200]);
});
test('a constant picture stays constant', () => {
  assert.ok(resizedByArea(new Uint8Array(7 * 5 * 3).fill(77), 7, 5, 3, 3, 4).every((value) => value === 77));
});

test('the box of landmarks has the share of the crop, a little below its middle', () => {
  const landmarks = Array.from({ length: 136 }, (_, i) => (i === 0 ? 10 : i === 1 ? 20 : i === 2 ? 110 : i === 3 ? 70 : i % 2 === 0 ? 60 : 45));
  const { scale, shift } = cropOfLandmarks(landmarks, 0.56);
  assert.ok(Math.abs(scale - 0.56 * 2.24) < 1e-12);
  assert.ok(Math.abs(scale * 60 + shift[0] - 112) < 1e-9 && Math.abs(scale * 45 + shift[1] - 123.2) < 1e-9);
  assert.throws(() => cropOfLandmarks([1, 2], 0.56), /2 numbers are no landmarks \(expected 136/);
  assert.throws(() => cropOfLandmarks(new Array(136).fill(4), 0.56), /all are in one point/);
});
test('a picture of the size of the crop is the crop; its border repeats', () => {
  const data = Uint8Array.from({ length: 4 * 224 * 224 }, (_, i) => (i % 4 === 3 ? 255 : (i * 7) % 251)), picture = { width: 224, height: 224, data };
  const crop = cropped(picture, cropOfWhole(picture));
  assert.deepEqual([...crop.subarray(0, 9)], [0, 1, 2, 4, 5, 6, 8, 9, 10].map((i) => data[i]));
  const wide = { width: 2, height: 1, data: Uint8Array.of(10, 20, 30, 255, 50, 60, 70, 255) }, whole = cropped(wide, cropOfWhole(wide));
  assert.deepEqual([...whole.subarray(0, 3)], [10, 20, 30]);
  assert.deepEqual([...whole.subarray(-3)], [50, 60, 70]);
});
test('colours are planes of 0 .. 1', () => {
  const planes = colourPlanes(new Uint8Array(3 * 224 * 224).fill(255), 112);
  assert.equal(planes.length, 3 * 112 * 112);
  assert.ok(planes.every((value) => value === 1));
});
