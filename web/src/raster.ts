import { check } from "./error.js";
import { kSketchCanvas, type Point, type Stroke } from "./drawing.js";

const kPenWidth = 1.5;  // Pixels of the canvas: the pen of the training sketches.

function clamp(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}

/** Pixels whose centres can lie in [low, high], cut at the picture's border. */
function centresWithin(low: number, high: number, size: number): [number, number] {
  return [clamp(Math.ceil(low - 0.5), 0, size), clamp(Math.floor(high - 0.5) + 1, 0, size)];
}

function drawCapsule([fromX, fromY]: Point, [toX, toY]: Point, halfWidth: number, size: number, pixels: Uint8Array): void {
  const reach = halfWidth + 0.5;
  const dx = toX - fromX, dy = toY - fromY, lengthSquared = dx * dx + dy * dy;
  const inverseLengthSquared = lengthSquared > 0 ? 1 / lengthSquared : 0;
  const [firstRow, endRow] = centresWithin(Math.min(fromY, toY) - reach, Math.max(fromY, toY) + reach, size);
  for (let row = firstRow; row < endRow; ++row) {
    const y = row + 0.5;
    // Only the part of the segment that is within reach of this row can cover its pixels.
    let first = 0, last = 1;
    if (dy !== 0) {
      const atTop = (y - reach - fromY) / dy, atBottom = (y + reach - fromY) / dy;
      first = clamp(Math.min(atTop, atBottom), 0, 1);
      last = clamp(Math.max(atTop, atBottom), 0, 1);
    }
    const xFirst = fromX + first * dx, xLast = fromX + last * dx;
    const [firstColumn, endColumn] = centresWithin(Math.min(xFirst, xLast) - reach, Math.max(xFirst, xLast) + reach, size);
    for (let column = firstColumn; column < endColumn; ++column) {
      const px = column + 0.5 - fromX, py = y - fromY;
      const along = clamp((px * dx + py * dy) * inverseLengthSquared, 0, 1);
      const ex = px - along * dx, ey = py - along * dy, distanceSquared = ex * ex + ey * ey;
      if (distanceSquared > reach * reach) continue;
      const coverage = Math.min(reach - Math.sqrt(distanceSquared), 1);
      const value = Math.trunc(255 * (1 - coverage) + 0.5), at = row * size + column;
      if (value < pixels[at]!) pixels[at] = value;
    }
  }
}

/**
 * Black strokes of the canvas on white, size x size, antialiased: render::RasteriseStrokes of the C++ runtime, bit for
 * bit for points in single precision. Strokes do not add up where they meet; one point alone is a dot.
 */
export function rasteriseStrokes(strokes: readonly Stroke[], size: number): Uint8Array {
  check(Number.isInteger(size) && size > 0, "size", `a sketch of ${size} pixels`, "Give a positive whole number");
  const pixels = new Uint8Array(size * size).fill(255);
  const scale = size / kSketchCanvas, halfWidth = 0.5 * kPenWidth * scale;
  for (const stroke of strokes) {
    let previous: Point | undefined;
    for (const [x, y] of stroke) {
      const point: Point = [x * scale, y * scale];
      if (previous !== undefined || stroke.length === 1) drawCapsule(previous ?? point, point, halfWidth, size, pixels);
      previous = point;
    }
  }
  return pixels;
}

/** Strokes of the canvas as a network reads them: ink 1, paper 0, row 0 on top. */
export function inkOf(strokes: readonly Stroke[], size: number): Float32Array {
  const pixels = rasteriseStrokes(strokes, size), ink = new Float32Array(pixels.length);
  for (let i = 0; i < ink.length; ++i) ink[i] = (255 - pixels[i]!) / 255;
  return ink;
}

/** Points at equal distances along all strokes, 4 x count: x, y in -1 .. 1, cosine and sine of twice the line's angle. */
export function sampleRows(strokes: readonly Stroke[], count: number): Float32Array {
  const pieces: { from: Point; to: Point; length: number }[] = [];
  for (const stroke of strokes)
    for (let i = 1; i < stroke.length; ++i) {
      const from = stroke[i - 1]!, to = stroke[i]!, length = Math.hypot(to[0] - from[0], to[1] - from[1]);
      if (length > 0) pieces.push({ from, to, length });
    }
  check(pieces.length > 0, "drawing", "no stroke has a length", "Draw lines");
  const total = pieces.reduce((sum, piece) => sum + piece.length, 0), half = kSketchCanvas / 2;
  const rows = new Float32Array(4 * count);
  let current = 0, begin = 0;
  for (let i = 0; i < count; ++i) {
    const at = ((i + 0.5) / count) * total;
    while (current + 1 < pieces.length && at > begin + pieces[current]!.length) begin += pieces[current++]!.length;
    const { from, to, length } = pieces[current]!;
    const share = Math.min((at - begin) / length, 1), dx = (to[0] - from[0]) / length, dy = (to[1] - from[1]) / length;
    const x = Math.fround(from[0] + share * (to[0] - from[0])), y = Math.fround(from[1] + share * (to[1] - from[1]));
    rows[i] = Math.fround(x - half) / half;
    rows[count + i] = Math.fround(y - half) / half;
    rows[2 * count + i] = dx * dx - dy * dy;
    rows[3 * count + i] = 2 * dx * dy;
  }
  return rows;
}
