import { check } from "./error.js";

/** x to the right, y down. */
export type Point = readonly [number, number];
/** A line as its points. */
export type Stroke = readonly Point[];

/** Strokes on a sheet of width x height pixels, such as a canvas. */
export interface Drawing {
  readonly width: number;
  readonly height: number;
  readonly strokes: readonly Stroke[];
}

/** Side of the canvas of sketches, in whose pixels the networks' pen is 1.5 wide. */
export const kSketchCanvas = 256;

const kArgument = "drawing";

/** The strokes in single precision, as the C++ runtime holds them. @throws DaumierError if it is empty or not finite. */
export function checkedStrokes(drawing: Drawing): Stroke[] {
  const { width, height } = drawing;
  check(width > 0 && height > 0 && Number.isFinite(width * height), kArgument, `the sheet has ${width} x ${height} pixels`, "Give the size of the canvas");
  const strokes = drawing.strokes.map((stroke) => stroke.map(([x, y]): Point => [Math.fround(x), Math.fround(y)]));
  for (const [s, stroke] of strokes.entries())
    for (const [x, y] of stroke)
      check(Number.isFinite(x) && Number.isFinite(y), kArgument, `a point of stroke ${s} is (${x}, ${y})`, "Give finite pixels of the sheet");
  check(strokes.some((stroke) => stroke.length > 0), kArgument, "it has no strokes", "Draw a face first");
  return strokes;
}

/** p_canvas = scale R p_sheet + shift, R a turn clockwise on the screen. */
export interface Placement {
  readonly scale: number;
  readonly shift: Point;
  readonly turnDegrees: number;
}

export const kIdentity: Placement = { scale: 1, shift: [0, 0], turnDegrees: 0 };

function rotationOf(placement: Placement): [number, number] {
  const angle = (placement.turnDegrees * Math.PI) / 180;
  return [Math.cos(angle), Math.sin(angle)];
}

export function rotated([x, y]: Point, radians: number): Point {
  const cos = Math.cos(radians), sin = Math.sin(radians);
  return [cos * x - sin * y, sin * x + cos * y];
}

export function toCanvas(placement: Placement, [x, y]: Point): Point {
  const [cos, sin] = rotationOf(placement), { scale, shift } = placement;
  return [scale * (cos * x - sin * y) + shift[0], scale * (sin * x + cos * y) + shift[1]];
}

/** Undoes toCanvas. */
export function toSheet(placement: Placement, [x, y]: Point): Point {
  const [cos, sin] = rotationOf(placement), { scale, shift } = placement;
  const dx = x - shift[0], dy = y - shift[1];
  return [(cos * dx + sin * dy) / scale, (cos * dy - sin * dx) / scale];
}

/** The placement whose toCanvas is toSheet of this one. */
export function inverse(placement: Placement): Placement {
  const turned: Placement = { scale: 1 / placement.scale, shift: [0, 0], turnDegrees: -placement.turnDegrees };
  const [x, y] = toCanvas(turned, placement.shift);
  return { ...turned, shift: [-x, -y] };
}

/** First `inner`, then `outer`. */
export function composed(outer: Placement, inner: Placement): Placement {
  return { scale: outer.scale * inner.scale, shift: toCanvas(outer, inner.shift), turnDegrees: outer.turnDegrees + inner.turnDegrees };
}

/** toCanvas of every point, in single precision. */
export function mapToCanvas(strokes: readonly Stroke[], placement: Placement): Stroke[] {
  const [cos, sin] = rotationOf(placement), { scale, shift } = placement;
  return strokes.map((stroke) => stroke.map(([x, y]): Point =>
    [Math.fround(scale * (cos * x - sin * y) + shift[0]), Math.fround(scale * (sin * x + cos * y) + shift[1])]));
}

/** The sheet as the whole canvas, its longer side; the shorter one gets paper on both sides. */
export function sheetPlacement({ width, height }: Drawing): Placement {
  const side = Math.max(width, height), scale = kSketchCanvas / side;
  return { scale, shift: [0.5 * scale * (side - width), 0.5 * scale * (side - height)], turnDegrees: 0 };
}

/** An axis-aligned box. */
export class Box {
  minX = Infinity;
  minY = Infinity;
  maxX = -Infinity;
  maxY = -Infinity;

  extend([x, y]: Point): void {
    this.minX = Math.min(this.minX, x);
    this.minY = Math.min(this.minY, y);
    this.maxX = Math.max(this.maxX, x);
    this.maxY = Math.max(this.maxY, y);
  }
  get isEmpty(): boolean {
    return !(this.minX <= this.maxX);
  }
  get width(): number {
    return this.maxX - this.minX;
  }
  get height(): number {
    return this.maxY - this.minY;
  }
  get longerSide(): number {
    return Math.max(this.width, this.height);
  }
  get centre(): Point {
    return [(this.minX + this.maxX) / 2, (this.minY + this.maxY) / 2];
  }
}

export function boxOf(stroke: Stroke): Box {
  const box = new Box();
  for (const point of stroke) box.extend(point);
  return box;
}

export function boxOfStrokes(strokes: readonly Stroke[]): Box {
  const box = new Box();
  for (const stroke of strokes) for (const point of stroke) box.extend(point);
  return box;
}
