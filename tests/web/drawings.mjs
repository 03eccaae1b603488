// Drawings of faces that a program makes, of seeds.

/** Numbers of 0 .. 1, the same everywhere. */
export function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

function ellipse(x, y, rx, ry, from = 0, to = 2 * Math.PI, count = 24) {
  return Array.from({ length: count + 1 }, (_, i) => {
    const angle = from + ((to - from) * i) / count;
    return [x + rx * Math.cos(angle), y + ry * Math.sin(angle)];
  });
}

/** A face on a sheet of 600 x 480, of a size and place of its own, with tremor. */
export function drawnFace(seed) {
  const random = randomNumbers(seed), vary = (share) => 1 + share * (2 * random() - 1);
  const size = 150 * vary(0.3), x = 300 + 60 * (random() - 0.5), y = 240 + 40 * (random() - 0.5), tremor = 1.5 * random(), turn = 0.3 * (random() - 0.5);
  const eye = 0.42 * vary(0.2), width = 0.75 * vary(0.15);
  const strokes = [ellipse(0, 0.05, width, 1.05 * vary(0.1), 0, 2 * Math.PI, 40)];
  for (const side of [-1, 1]) {
    strokes.push(ellipse(side * eye * width, -0.15, 0.15 * vary(0.3), 0.07 * vary(0.4)));
    strokes.push(ellipse(side * eye * width, -0.15, 0.05, 0.05, 0, 2 * Math.PI, 12));
    strokes.push(ellipse(side * eye * width, -0.25, 0.2, 0.12 * vary(0.4), Math.PI * 1.15, Math.PI * 1.85, 10));
  }
  strokes.push([[-0.05, -0.1], [-0.1, 0.2 * vary(0.2)], [0, 0.25], [0.1, 0.2]]);
  strokes.push(ellipse(0, 0.5, 0.28 * vary(0.3), 0.06 * vary(0.5), 0, Math.PI, 12));
  strokes.push(ellipse(0, 0.5, 0.28 * vary(0.3), 0.04 * vary(0.5), Math.PI, 2 * Math.PI, 12));
  const cos = size * Math.cos(turn), sin = size * Math.sin(turn);
  const place = ([px, py]) => [x + cos * px - sin * py + tremor * (random() - 0.5), y + sin * px + cos * py + tremor * (random() - 0.5)].map(Math.fround);
  return { width: 600, height: 480, strokes: strokes.map((stroke) => stroke.map(place)) };
}

function shifted(strokes, dx) {
  return strokes.map((stroke) => stroke.map(([x, y]) => [Math.fround(x + dx), y]));
}

/** The face over a title of seven letters. */
export function titledFace(seed) {
  const face = drawnFace(seed), points = face.strokes.flat(), bottom = Math.max(...points.map(([, y]) => y)), left = Math.min(...points.map(([x]) => x));
  const letters = Array.from({ length: 7 }, (_, i) => [[0, 0], [6, 20], [12, 0]].map(([x, y]) => [left + 20 * i + x, bottom + 60 + y].map(Math.fround)));
  return { ...face, height: 700, strokes: [...face.strokes, ...letters] };
}

/** Two faces side by side, the right one with other features. */
export function twoFaces(seed) {
  return { width: 1200, height: 480, strokes: [...drawnFace(seed).strokes, ...shifted(drawnFace(seed + 1).strokes, 500)] };
}

/** The face with hair of 12,000 points, more than the networks' pictures need. */
export function scribbledFace(seed) {
  const face = drawnFace(seed), random = randomNumbers(seed), points = face.strokes.flat(), xs = points.map(([x]) => x), top = Math.min(...points.map(([, y]) => y));
  const left = Math.min(...xs), width = Math.max(...xs) - left;
  const hair = Array.from({ length: 60 }, () => Array.from({ length: 200 }, () => [left + width * random(), top - 20 + 60 * random()].map(Math.fround)));
  return { ...face, strokes: [...face.strokes, ...hair] };
}
