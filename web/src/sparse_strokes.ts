import { type Box, boxOfStrokes, type Point, type Stroke } from "./drawing.js";

/** render::SparseStrokes: strokes that show on the canvas what the given ones show, few enough to be drawn many times. */

const kMostPoints = 10000, kMostLength = 12000, kMostPieces = 20000;  // Lengths in pixels of the canvas.
const kFirstCell = 1, kLastCell = 8, kMostCells = 4096, kLag = 4;

function distance(a: Point, b: Point): number {
  const dx = b[0] - a[0], dy = b[1] - a[1];
  return Math.sqrt(dx * dx + dy * dy);
}

/** Which cells lines run through, for each range of directions. */
class LineCells {
  private readonly cell: number;
  private readonly columns: number;
  private readonly rows: number;
  private readonly directions: Uint8Array;

  constructor(private readonly box: Box, cell: number) {
    this.cell = Math.max(cell, box.longerSide / kMostCells);
    this.columns = Math.floor(box.width / this.cell) + 1;
    this.rows = Math.floor(box.height / this.cell) + 1;
    this.directions = new Uint8Array(this.columns * this.rows);
  }

  /** A bit for each 45 degrees of the direction, either sense alike. */
  private static directionOf(from: Point, to: Point): number {
    let x = to[0] - from[0], y = to[1] - from[1];
    if (y < 0 || (y === 0 && x < 0)) [x, y] = [-x, -y];
    if (x > y) return 1;
    if (x > 0) return 2;
    return -x < y ? 4 : 8;
  }

  private cellsOf(from: Point, to: Point): number[] {
    const parts = Math.max(1, Math.ceil((2 * distance(from, to)) / this.cell)), cells: number[] = [];
    for (let part = 0; part < parts; ++part) {
      const share = (part + 0.5) / parts;
      const column = Math.floor((from[0] + share * (to[0] - from[0]) - this.box.minX) / this.cell);
      const row = Math.floor((from[1] + share * (to[1] - from[1]) - this.box.minY) / this.cell);
      cells.push(Math.min(Math.max(row, 0), this.rows - 1) * this.columns + Math.min(Math.max(column, 0), this.columns - 1));
    }
    return cells;
  }

  isCovered(from: Point, to: Point): boolean {
    const direction = LineCells.directionOf(from, to);
    return this.cellsOf(from, to).every((cell) => (this.directions[cell]! & direction) !== 0);
  }
  cover(from: Point, to: Point): void {
    const direction = LineCells.directionOf(from, to);
    for (const cell of this.cellsOf(from, to)) this.directions[cell]! |= direction;
  }
}

/** The places of a stroke without those that are nearer than a cell to the last one; the last place stays. */
function sparsePlaces(stroke: Stroke, cell: number): Point[] {
  const places: Point[] = [];
  for (const point of stroke) if (places.length === 0 || distance(point, places[places.length - 1]!) >= cell) places.push(point);
  const last = stroke[stroke.length - 1]!, own = places[places.length - 1]!;
  if (own[0] !== last[0] || own[1] !== last[1]) places.push(last);
  return places;
}

/** Undefined once there are more than `mostPieces` pieces. */
function sparseOnCells(strokes: readonly Stroke[], box: Box, cell: number, mostPieces: number): Stroke[] | undefined {
  const cells = new LineCells(box, cell), sparse: Point[][] = [];
  const single = ([x, y]: Point): Point => [Math.fround(x), Math.fround(y)];
  let numPieces = 0;
  for (const stroke of strokes) {
    if (stroke.length === 0) continue;
    const recent: [Point, Point][] = [];
    let continues = false, recentLength = 0;
    // A piece covers its cells once the pen has left them, or every next piece would seem to be drawn already.
    const leave = (): void => {
      const [from, to] = recent.shift()!;
      cells.cover(from, to);
      recentLength -= distance(from, to);
    };
    const add = (from: Point, to: Point): void => {
      if (cells.isCovered(from, to)) {
        continues = false;
      } else {
        if (!continues) sparse.push([single(from)]);
        if (to[0] !== from[0] || to[1] !== from[1]) sparse[sparse.length - 1]!.push(single(to));
        continues = true;
        ++numPieces;
      }
      recent.push([from, to]);
      recentLength += distance(from, to);
      while (recentLength > kLag * cell && recent.length > 1) leave();
    };
    const places = sparsePlaces(stroke, cell);
    if (places.length === 1) add(places[0]!, places[0]!);
    for (let i = 1; i < places.length; ++i) {
      if (numPieces > mostPieces) return undefined;
      const from = places[i - 1]!, to = places[i]!, parts = Math.max(1, Math.floor(distance(from, to) / (2 * cell)));
      const at = (share: number): Point => [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
      for (let part = 0; part < parts; ++part) add(at(part / parts), at((part + 1) / parts));
    }
    while (recent.length > 0) leave();
  }
  return sparse;
}

/** scale: pixels of the canvas of one unit of the strokes. Most drawings are returned as they are. */
export function sparseStrokes(strokes: readonly Stroke[], scale: number): readonly Stroke[] {
  let numPoints = 0, length = 0;
  for (const stroke of strokes) {
    numPoints += stroke.length;
    for (let i = 1; i < stroke.length; ++i) length += scale * distance(stroke[i - 1]!, stroke[i]!);
  }
  if (numPoints <= kMostPoints && length <= kMostLength) return strokes;
  const box = boxOfStrokes(strokes);
  let cell = kFirstCell;
  for (; cell < kLastCell; cell *= 2) {
    const sparse = sparseOnCells(strokes, box, cell / scale, kMostPieces);
    if (sparse !== undefined) return sparse;
  }
  return sparseOnCells(strokes, box, cell / scale, Infinity)!;
}
