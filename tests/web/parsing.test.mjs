import assert from 'node:assert/strict';
import test from 'node:test';
import { load } from './package.mjs';

const { toCanvas } = await load('drawing');
const { kFacePoints, kMirroredPoints, pointIndex } = await load('drawing_terms');
const { findFaceFrame, solve } = await load('face_frame');
const { findFacePoints } = await load('face_points');
const { averageWithMirrored, classAt, findPeak, likeliest, softmax } = await load('heat_maps');
const { readMouthLines } = await load('mouth_lines');
const { linesOfFace, refuseProfile } = await load('parsed_drawing');

test('a peak has no bias to the centres of cells', () => {
  const side = 64, deviation = 1.2, x = 20.37, y = 41.81;
  const scores = Float32Array.from({ length: side * side }, (_, i) => -0.5 * (((i % side) + 0.5 - x) ** 2 + (Math.floor(i / side) + 0.5 - y) ** 2) / deviation ** 2);
  const peak = findPeak(scores, side, deviation);
  assert.ok(Math.abs(peak.x - x) < 1e-3 && Math.abs(peak.y - y) < 1e-3, JSON.stringify(peak));
  assert.ok(Math.abs(peak.confidence - 1) < 1e-2);
});
test('softmax of (0, ln 3) is (1/4, 3/4)', () => {
  const [a, b] = softmax([0, Math.log(3)]);
  assert.ok(Math.abs(a - 0.25) < 1e-12 && Math.abs(b - 0.75) < 1e-12);
});
test('the likeliest is the first of equals', () => assert.equal(likeliest([1, 3, 3, 2]), 1));
test('maps are averaged with the mirrored maps of the other side', () => {
  assert.deepEqual([...averageWithMirrored(Float32Array.of(1, 2, 3, 4, 0, 0, 0, 0), Float32Array.of(0, 0, 0, 0, 10, 20, 30, 40), 2, [1, 0])], [10.5, 6, 21.5, 17, 0, 0, 0, 0]);
});
test('classes change halfway between the centres of cells', () => {
  const scores = Float32Array.of(1, 0, 1, 0, 0, 1, 0, 1);
  assert.deepEqual([0.5, 0.9, 1.1, 3].map((x) => classAt(scores, 2, 2, x, 1)), [0, 0, 1, 1]);
});
test('mirroring points is an involution', () => {
  assert.ok(kMirroredPoints.every((other, i) => kMirroredPoints[other] === i));
  assert.equal(kMirroredPoints[pointIndex('mouth_right')], pointIndex('mouth_left'));
});

test('equations are solved with pivots', () => {
  assert.deepEqual(solve([[0, 2], [4, 0]], [6, 8]), [2, 3]);
});

/** A template of 68 landmarks alone: an eye of the face lies on both sides of the middle, the jaw below. */
function smallTemplate() {
  const landmarks = [...new Array(68).keys()], neutral = new Float32Array(3 * 68);
  landmarks.forEach((n) => {
    const angle = (n / 68) * 2 * Math.PI, onJaw = n <= 16;
    neutral[3 * n] = onJaw ? (n - 8) / 2 : Math.cos(angle) * 2 + (n >= 42 && n < 48 ? 3 : n >= 36 && n < 42 ? -3 : 0);
    neutral[3 * n + 1] = onJaw ? -8 + ((n - 8) / 4) ** 2 : Math.sin(3 * angle);
  });
  return { neutral, landmarks, curves: {}, triangles: new Uint32Array(0), closingTriangles: new Uint32Array(0), source: 'test' };
}

test('the frame of a moved face is its move, up to the priors', () => {
  const vertices = findFacePoints(smallTemplate()), { neutral } = smallTemplate();
  const projected = Float64Array.from({ length: 2 * 68 }, (_, i) => 128 + (i % 2 === 0 ? 10 : -10) * neutral[3 * (i >> 1) + (i % 2)]);
  const placement = { scale: 1.05, shift: [4, -9], turnDegrees: 3 };
  const points = kFacePoints.map((_, i) => {
    const own = vertices.ofPoints[i].length > 0 ? vertices.ofPoints[i] : [vertices.contours[i === pointIndex('contour_right') ? 0 : 1][4]];
    const mean = [0, 1].map((axis) => own.reduce((sum, v) => sum + projected[2 * v + axis], 0) / own.length);
    return toCanvas(placement, mean);
  });
  const found = findFaceFrame(vertices, projected, points, points.map(() => 1));
  assert.ok(Math.abs(found.scale - placement.scale) < 0.01 && Math.abs(found.turnDegrees - placement.turnDegrees) < 0.5, JSON.stringify(found));
  assert.throws(() => findFaceFrame(vertices, projected, points, points.map(() => 0)), /no point of a face is found/);
});

function parsedMouth(lines) {
  const points = kFacePoints.map(() => [0, 0]);
  points[pointIndex('mouth_right')] = [100, 100];
  points[pointIndex('mouth_left')] = [150, 100];
  const strokes = lines.map((height) => Array.from({ length: 26 }, (_, i) => [100 + 2 * i, 100 + height * 50 * Math.sin((i / 25) * Math.PI)]));
  return { points, confidences: points.map(() => 1), mouth: [0.2, 0.7, 0.1], eyes: [[1, 0], [1, 0]], view: [1, 0, 0, 0], strokes, labels: strokes.map((stroke) => stroke.map(() => 'inner_mouth')),
    frame: { scale: 1, shift: [0, 0], turnDegrees: 0 } };
}
test('three lines are a closed mouth: its state, seam and labels', () => {
  const drawing = parsedMouth([-0.15, 0.02, 0.25]);
  readMouthLines(drawing);
  assert.equal(drawing.mouth[0], 0.89);
  assert.ok(Math.abs(drawing.mouth.reduce((a, b) => a + b) - 1) < 1e-12);
  assert.deepEqual(drawing.labels.map((labels) => labels[12]), ['upper_lip', 'inner_mouth', 'lower_lip']);
  assert.ok(Math.abs(drawing.points[pointIndex('inner_top')][1] - 101) < 0.1);
});
test('four lines are lips and an opening, and stay', () => {
  const drawing = parsedMouth([-0.15, -0.05, 0.1, 0.25]);
  readMouthLines(drawing);
  assert.deepEqual(drawing.mouth, [0.2, 0.7, 0.1]);
});
test('pieces of hair are cut out of a stroke, and runs meet at a point', () => {
  const drawing = { strokes: [[[0, 0], [1, 0], [2, 0], [3, 0]]], labels: [['nose', 'nose', 'hair', 'nose']] };
  assert.deepEqual(linesOfFace(drawing), [[[0, 0], [1, 0], [2, 0]], [[3, 0]]]);
  assert.deepEqual(linesOfFace({ ...drawing, labels: [['hair', 'hair', 'hair', 'hair']] }), drawing.strokes);
});
test('a profile is refused', () => {
  assert.throws(() => refuseProfile({ view: [0.3, 0, 0, 0.7] }), /from the side \(probability 0\.70\).*draw both eyes/);
});
