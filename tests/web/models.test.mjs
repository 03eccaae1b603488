// The models' own methods, by a session in the place of ONNX Runtime's: arguments, release, warnings.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import test from 'node:test';
import { repository } from '../../tools/consumers/studio/client.mjs';
import { load } from './package.mjs';

const { openDeformModel, openPortraitModel, openSketchModel } = await load('index');

const folder = (path) => ({ name: path, read: async (file) => new Uint8Array(readFileSync(join(path, file))), neighbour: (name) => folder(join(path, '..', name)) });
const place = folder(join(repository, 'weights/sketch-ict')), portraitPlace = folder(join(repository, 'weights/portrait'));
const faceNumbers = 3 * 10350;

/** A module like ONNX Runtime's whose network gives zeros after `wait` ms; log: what was called. */
function fakeOrt({ input = ['sketch', [1, 1, 128, 128]], outputs = { u: 1, v: 1, vertices: faceNumbers }, wait = 0, log = [] } = {}) {
  class Tensor {
    constructor(type, data, dims) {
      Object.assign(this, { type, data, dims });
    }
  }
  let isReleased = false;
  const session = {
    inputNames: [input[0]], outputNames: Object.keys(outputs), inputMetadata: [{ name: input[0], isTensor: true, shape: input[1] }],
    async run() {
      await new Promise((resolve) => setTimeout(resolve, wait));
      if (isReleased) throw new Error('invalid session id');
      log.push('run');
      return Object.fromEntries(Object.entries(outputs).map(([name, size]) => [name, new Tensor('float32', new Float32Array(size), [1, size])]));
    },
    async release() {
      if (isReleased) throw new Error('invalid session id');
      isReleased = true;
      log.push('release');
    },
  };
  return { InferenceSession: { create: async () => session }, Tensor };
}
const canvasModel = (options) => openSketchModel(fakeOrt(options), place, { framing: 'canvas' });
const refused = (promise, message) => assert.rejects(promise, (error) => {
  assert.equal(error.name, 'DaumierError', error.stack);
  assert.match(error.message, message);
  return true;
});

const line = [[10, 10], [200, 150]], drawing = { width: 256, height: 256, strokes: [line] };
const frame = { scale: 1, shift: [0, 0], turnDegrees: 0 };

test('release waits for calls that run, is harmless twice, and ends the model', async () => {
  const log = [], model = await canvasModel({ wait: 20, log });
  const [face] = await Promise.all([model.predict(drawing), model.preview(drawing, frame), model.release(), model.release()]);
  assert.equal(face.vertices.length, faceNumbers);
  assert.deepEqual(log, ['run', 'run', 'release']);
  for (const call of [() => model.predict(drawing), () => model.preview(drawing, frame), () => model.faceOf([line])])
    await refused(call(), /weights\/sketch-ict: the model was released\. Open it again$/);
  await model.release();
  assert.deepEqual(log, ['run', 'run', 'release']);
});
test('a call that is refused does not keep release waiting', async () => {
  const model = await canvasModel();
  const bad = refused(model.predict({ ...drawing, strokes: [] }), /it has no strokes/);
  await model.release();
  await bad;
});
test('a portrait model waits, too, and is refused after release', async () => {
  const log = [], model = await openPortraitModel(fakeOrt({ input: ['crop', [1, 3, 112, 112]], outputs: { coefficients: 239 }, wait: 20, log }), portraitPlace);
  const picture = { width: 8, height: 8, data: new Uint8ClampedArray(256) };
  await Promise.all([model.predict(picture), model.release()]);
  assert.deepEqual(log, ['run', 'release']);
  await model.release();
  await refused(model.predict(picture), /weights\/portrait: the model was released\. Open it again$/);
});
test('a portrait without pixels, or with landmarks that are none, is refused', async () => {
  const model = await openPortraitModel(fakeOrt({ input: ['crop', [1, 3, 112, 112]], outputs: { coefficients: 239 } }), portraitPlace);
  await refused(model.predict(), /picture: it is undefined/);
  await refused(model.predict(drawing), /picture: it is an object of width, height, strokes \(expected \{width, height, data\}\)/);
  await refused(model.predict({ width: 8, height: 8, data: new Uint8ClampedArray(256) }, null), /landmarks: they are null/);
});

test('what is no drawing is refused with what was found and the repair', async () => {
  const model = await canvasModel(), strokesOf = (strokes) => ({ ...drawing, strokes });
  class HTMLCanvasElement {
    get [Symbol.toStringTag]() { return 'HTMLCanvasElement'; }
    getContext() {}
  }
  class HTMLImageElement {
    get [Symbol.toStringTag]() { return 'HTMLImageElement'; }
  }
  await refused(model.predict(), /drawing: it is undefined \(expected \{width, height, strokes\}\)\. Give \{width, height, strokes/);
  await refused(model.predict(null), /drawing: it is null/);
  await refused(model.predict([line]), /drawing: it is an array of 1 \(expected/);
  await refused(model.predict(new HTMLCanvasElement()), /it is a HTMLCanvasElement \(expected its pixels\)\. Give context\.getImageData\(0, 0, canvas\.width, canvas\.height\)/);
  await refused(model.predict(new HTMLImageElement()), /it is a HTMLImageElement \(expected its pixels\)\. Draw it on a canvas/);
  await refused(model.predict({ width: 9, height: 9 }), /it is an object of width, height \(expected \{width, height, strokes\}\)/);
  await refused(model.predict(strokesOf(undefined)), /its strokes are undefined/);
  await refused(model.predict(strokesOf([[{ x: 1, y: 2 }]])), /a point of stroke 0 is an object of x, y \(expected \[x, y\]\)\..*line\.map\(\(\{x, y\}\) => \[x, y\]\)/);
  await refused(model.predict(strokesOf([[1, 2, 3, 4]])), /a point of stroke 0 is the number 1 \(expected \[x, y\]\)/);
  await refused(model.predict(strokesOf([{ points: line }])), /stroke 0 is an object of points \(expected an array of points\)/);
  await refused(model.predict(strokesOf([line, [[null, 1]]])), /a point of stroke 1 is \(null, 1\)\. Give finite pixels/);
  await refused(model.predict({ ...drawing, data: undefined }), /picture: its data are undefined/);
});
test('points with a third number, or typed ones, are read', async () => {
  const model = await canvasModel();
  for (const point of [(x, y) => [x, y, 0.5], (x, y) => Float32Array.of(x, y)])
    assert.equal((await model.predict({ ...drawing, strokes: [line.map(([x, y]) => point(x, y))] })).vertices.length, faceNumbers);
});
test('a preview without a frame of a prediction is refused', async () => {
  const model = await canvasModel();
  await refused(model.preview(drawing), /frame: it is undefined \(expected \{scale, shift: \[x, y\], turnDegrees\}\)\. Give the `frame` of an earlier prediction/);
  await refused(model.preview(drawing, { ...frame, scale: NaN }), /frame: it has the scale NaN.*the scale above 0/);
  await refused(model.preview(drawing, { ...frame, scale: 0 }), /frame: it has the scale 0/);
  for (const scale of [1e20, 1e-20]) await refused(model.preview(drawing, { ...frame, scale }), /frame: its scale \S+ makes the sheet/);
  const { frame: own } = await model.predict(drawing);
  assert.equal((await model.preview(drawing, own)).vertices.length, faceNumbers);
});
test('the warning of an inverted picture is that of its face', async () => {
  const model = await canvasModel(), data = new Uint8ClampedArray(4 * 64 * 64).fill(255);
  for (let i = 0; i < 64 * 64; ++i) if (i % 64 !== 32) data.fill(0, 4 * i, 4 * i + 3);
  assert.match((await model.predict({ width: 64, height: 64, data })).warnings[0], /light lines on dark/);
});

test('opening says which argument is wrong', async () => {
  const ort = fakeOrt();
  for (const open of [openSketchModel, openPortraitModel, openDeformModel]) {
    await refused(open(ort), /place: it is undefined \(expected the address of a folder\)\. Give an address such as/);
    await refused(open('/weights/sketch-ict', ort), /ort: it is the text '\/weights\/sketch-ict', and the second argument is ONNX Runtime: they are swapped\. Call open/);
    await refused(open(undefined, place), /ort: it is undefined \(expected the module onnxruntime-web\)\. Give the whole module: import/);
    await refused(open(ort, 3), /place: it is the number 3/);
  }
  await refused(openSketchModel(ort, place, { framing: 'Canvas' }), /options: framing is the text 'Canvas'\. Give \{framing: "parser"\}/);
});
