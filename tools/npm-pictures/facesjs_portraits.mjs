// node facesjs_portraits.mjs OUT COUNT: COUNT faces of npm's facesjs as OUT/NN.png with OUT/NN.txt. A landmark is a point of
// the pixels that a part of the SVG covers when it is drawn alone:
//   jaw, 0-16     evenly spaced along the outline of the head, from the height of the eyes to that height
//   brows, 17-26  evenly spaced columns, the middle of each
//   nose          31, 33, 35: left end, middle of the lower edge, right end; not of noses that are seen from a side
//   eyes, 36-47   ends; upper and lower edge at a third and two thirds of the width
//   mouth, 48-59  ends; upper and lower edge at sixths of the width
// The bridge of the nose and the inner lips are not known.
import { faceToSvgString, generate } from 'facesjs';
import { mkdirSync } from 'node:fs';
import { render, seededRandom, writePortrait } from './shared.mjs';

const width = 400, height = 600;
const parts = ['hairBg', 'body', 'jersey', 'ear', 'head', 'eyeLine', 'smileLine', 'miscLine', 'facialHair', 'eye', 'eyebrow',
  'mouth', 'nose', 'hair', 'glasses', 'accessories'];
const noId = 'none of this';

function toSvg(face) {
  return faceToSvgString(structuredClone(face)).replace('width="100%" height="100%"', `width="${width}" height="${height}"`);
}

/// Of each column the first row that a part covers and one past the last, or nothing; of columns begin .. end - 1.
function columnsOf(face, part, begin = 0, end = width) {
  const alone = structuredClone(face);
  for (const other of parts) if (other !== part) alone[other].id = noId;
  const { pixels } = render(toSvg(alone));
  const columns = [];
  for (let x = begin; x < end; ++x) {
    let top = height, bottom = 0;
    for (let y = 0; y < height; ++y) {
      if (pixels[4 * (y * width + x) + 3] < 128) continue;
      top = Math.min(top, y);
      bottom = y + 1;
    }
    if (bottom > top) columns.push({ x: x + 0.5, top, bottom, middle: (top + bottom) / 2 });
  }
  if (columns.length < 3) throw new Error(`the part ${part} covers ${columns.length} columns, expected 3 or more`);
  return columns;
}

function columnAt(columns, share) {
  return columns[Math.round(share * (columns.length - 1))];
}
const middleAt = (columns, share) => [columnAt(columns, share).x, columnAt(columns, share).middle];
const topAt = (columns, share) => [columnAt(columns, share).x, columnAt(columns, share).top];
const bottomAt = (columns, share) => [columnAt(columns, share).x, columnAt(columns, share).bottom];

/// Points evenly spaced along the lower outline of the head, between its sides at the height `from`.
function jawOf(columns, from) {
  const outline = columns.filter(({ bottom }) => bottom >= from).map(({ x, bottom }) => [x, bottom]);
  outline.unshift([columns[0].x - 0.5, from]);
  outline.push([columns.at(-1).x + 0.5, from]);
  const lengths = [0];
  for (let i = 1; i < outline.length; ++i)
    lengths.push(lengths[i - 1] + Math.hypot(outline[i][0] - outline[i - 1][0], outline[i][1] - outline[i - 1][1]));
  return Array.from({ length: 17 }, (_, k) => {
    const length = (lengths.at(-1) * k) / 16;
    const i = Math.max(1, lengths.findIndex((value) => value >= length - 1e-9));
    const share = (length - lengths[i - 1]) / (lengths[i] - lengths[i - 1]);
    return [0, 1].map((axis) => outline[i - 1][axis] + share * (outline[i][axis] - outline[i - 1][axis]));
  });
}

function landmarksOf(face) {
  const points = {};
  const half = width / 2;
  const eyes = [columnsOf(face, 'eye', 0, half), columnsOf(face, 'eye', half)];
  const brows = [columnsOf(face, 'eyebrow', 0, half), columnsOf(face, 'eyebrow', half)];
  brows.forEach((columns, side) => {
    for (let k = 0; k < 5; ++k) points[17 + 5 * side + k] = middleAt(columns, k / 4);
  });
  eyes.forEach((columns, side) => {
    const first = 36 + 6 * side;
    points[first] = middleAt(columns, 0);
    points[first + 1] = topAt(columns, 1 / 3);
    points[first + 2] = topAt(columns, 2 / 3);
    points[first + 3] = middleAt(columns, 1);
    points[first + 4] = bottomAt(columns, 2 / 3);
    points[first + 5] = bottomAt(columns, 1 / 3);
  });
  const mouth = columnsOf(face, 'mouth');
  points[48] = middleAt(mouth, 0);
  points[54] = middleAt(mouth, 1);
  for (let k = 1; k < 6; ++k) {
    points[48 + k] = topAt(mouth, k / 6);
    points[60 - k] = bottomAt(mouth, k / 6);
  }
  if (!['nose4', 'pinocchio'].includes(face.nose.id)) {
    const nose = columnsOf(face, 'nose');
    points[31] = middleAt(nose, 0);
    points[33] = bottomAt(nose, 0.5);
    points[35] = middleAt(nose, 1);
  }
  const eyeHeight = (columnAt(eyes[0], 0.5).middle + columnAt(eyes[1], 0.5).middle) / 2;
  jawOf(columnsOf(face, 'head'), eyeHeight).forEach((point, i) => { points[i] = point; });
  return points;
}

const [out, count] = [process.argv[2], Number(process.argv[3])];
mkdirSync(out, { recursive: true });
const races = ['asian', 'black', 'brown', 'white'];
const grounds = ['#ffffff', '#dfe9f2', '#f4e6c8', '#9db7a5', '#5a6070'];
for (let i = 0; i < count; ++i) {
  const random = seededRandom(1000 + i);
  Math.random = random;  // generate() draws from it.
  const face = generate(undefined, { gender: i % 2 === 0 ? 'female' : 'male', race: races[Math.floor(i / 2) % races.length] });
  if (face.glasses.id === 'facemask') face.glasses.id = 'none';
  const png = render(toSvg(face), grounds[i % grounds.length]).asPng();
  writePortrait(out, String(i + 1).padStart(2, '0'), png, landmarksOf(face));
}
console.log(`${out}: ${count} faces of facesjs`);
