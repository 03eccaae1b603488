/** What the outputs of a heat-map network mean: render/heat_map_decoding.h. */

export interface Peak {
  /** Cells; the centre of the first one is at 0.5. */
  readonly x: number;
  readonly y: number;
  /** 0 .. 1: how well the place is determined. */
  readonly confidence: number;
}

const kWindow = 2, kSteps = 8;

export function softmax(scores: ArrayLike<number>): Float64Array {
  const count = scores.length, p = new Float64Array(count);
  let largest = -Infinity, sum = 0;
  for (let i = 0; i < count; ++i) if (scores[i]! > largest) largest = scores[i]!;
  for (let i = 0; i < count; ++i) sum += p[i] = Math.exp(scores[i]! - largest);
  for (let i = 0; i < count; ++i) p[i]! /= sum;
  return p;
}

/** The first of the greatest. */
export function likeliest(values: ArrayLike<number>): number {
  let best = 0;
  for (let i = 1; i < values.length; ++i) if (values[i]! > values[best]!) best = i;
  return best;
}

/** The peak of one map, by a mean shift from its largest cell; deviation: of the Gaussians of the training, cells. */
export function findPeak(scores: Float32Array, side: number, deviation: number): Peak {
  const p = softmax(scores), largest = likeliest(scores);
  let x = (largest % side) + 0.5, y = Math.floor(largest / side) + 0.5, sum = 0;
  const factor = -0.5 / (kWindow * kWindow), reach = 3 * kWindow, alongX = new Float64Array(side);
  for (let step = 0; step < kSteps; ++step) {
    const firstRow = Math.max(0, Math.trunc(y - reach)), lastRow = Math.min(side - 1, Math.trunc(y + reach));
    const first = Math.max(0, Math.trunc(x - reach)), last = Math.min(side - 1, Math.trunc(x + reach));
    for (let column = first; column <= last; ++column) alongX[column] = Math.exp(factor * (column + 0.5 - x) * (column + 0.5 - x));
    let sumX = 0, sumY = 0;
    sum = 0;
    for (let row = firstRow; row <= lastRow; ++row) {
      let ofRow = 0, ofRowX = 0;
      for (let column = first; column <= last; ++column) {
        const weight = p[row * side + column]! * alongX[column]!;
        ofRow += weight;
        ofRowX += weight * (column + 0.5);
      }
      const alongY = Math.exp(factor * (row + 0.5 - y) * (row + 0.5 - y));
      sum += alongY * ofRow;
      sumX += alongY * ofRowX;
      sumY += alongY * ofRow * (row + 0.5);
    }
    x = sumX / sum;
    y = sumY / sum;
  }
  const window2 = kWindow * kWindow;
  return { x, y, confidence: Math.min(1, (sum * (window2 + deviation * deviation)) / window2) };
}

/** The mean of maps and of those of the mirror image, in which map m shows, mirrored, what map order[m] shows. */
export function averageWithMirrored(maps: Float32Array, mirrored: Float32Array, side: number, order: readonly number[]): Float32Array {
  const mean = new Float32Array(maps.length), cells = side * side;
  for (let map = 0; map < order.length; ++map)
    for (let row = 0; row < side; ++row) {
      const to = map * cells + row * side, from = order[map]! * cells + row * side + side - 1;
      for (let column = 0; column < side; ++column) mean[to + column] = 0.5 * (maps[to + column]! + mirrored[from - column]!);
    }
  return mean;
}

/** The class of the highest score at a point of a grid, in cells; scores between the cells' centres are bilinear. */
export function classAt(scores: Float32Array, numClasses: number, side: number, x: number, y: number): number {
  const column = Math.min(Math.max(x - 0.5, 0), side - 1), row = Math.min(Math.max(y - 0.5, 0), side - 1);
  const left = Math.floor(column), upper = Math.floor(row), right = Math.min(left + 1, side - 1), lower = Math.min(upper + 1, side - 1);
  const u = Math.fround(column - left), v = Math.fround(row - upper), cells = side * side;
  let best = 0, greatest = -Infinity;
  for (let k = 0; k < numClasses; ++k) {
    const at = k * cells;
    const above = (1 - u) * scores[at + upper * side + left]! + u * scores[at + upper * side + right]!;
    const below = (1 - u) * scores[at + lower * side + left]! + u * scores[at + lower * side + right]!;
    const score = (1 - v) * above + v * below;
    if (score <= greatest) continue;
    greatest = score;
    best = k;
  }
  return best;
}
