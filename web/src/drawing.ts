import { described, isObject } from "./arguments.js";
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

const kPoints = "Give each line as [[x, y], [x, y], ...]; of points {x, y}: line.map(({x, y}) => [x, y])";

function checkedPoint(point: unknown, stroke: number): Point {
  const isPair = (Array.isArray(point) || ArrayBuffer.isView(point)) && (point as unknown as ArrayLike<unknown>).length >= 2;
  check(isPair, kArgument, `a point of stroke ${stroke} is ${described(point)} (expected [x, y])`, kPoints);
  const [x, y] = point as unknown as readonly unknown[], text = (value: unknown): string => (typeof value === "string" ? `'${value}'` : String(value));
  check(typeof x === "number" && typeof y === "number" && Number.isFinite(Math.fround(x)) && Number.isFinite(Math.fround(y)), kArgument,
    `a point of stroke ${stroke} is (${text(x)}, ${text(y)})`, "Give finite pixels of the sheet");
  return [Math.fround(x), Math.fround(y)];
}

/** The strokes in single precision, as the C++ runtime holds them. @throws DaumierError if it is empty or not finite. */
export function checkedStrokes(drawing: Drawing): Stroke[] {
  const given: unknown = drawing;
  check(isObject(given) && Array.isArray(given["strokes"]), kArgument,
    isObject(given) && "strokes" in given ? `its strokes are ${described(given["strokes"])} (expected an array of lines)` : `it is ${described(given)} (expected {width, height, strokes})`,
    "Give {width, height, strokes: [[[x, y], ...], ...]}, or the pixels of a picture: context.getImageData(0, 0, canvas.width, canvas.height)");
  const { width, height } = drawing;
  check(typeof width === "number" && typeof height === "number" && width > 0 && height > 0 && Number.isFinite(width * height), kArgument, `the sheet has ${width} x ${height} pixels`, "Give the size of the canvas");
  const strokes = drawing.strokes.map((stroke: unknown, s) => {
    check(Array.isArray(stroke), kArgument, `stroke ${s} is ${described(stroke)} (expected an array of points)`, kPoints);
    return stroke.map((point) => checkedPoint(point, s));
  });
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

const kFrame = "Give the `frame` of an earlier prediction of this sheet: preview(drawing, (await model.predict(drawing)).frame)";
/** How long the sheet, or the lines, may be on a canvas of 256 that shows a face of them. */
const kShortestOnCanvas = 16, kLongestOnCanvas = 1e7;

/** @throws DaumierError unless it is a placement that may show a face of these strokes. */
export function checkFrame(frame: unknown, { width, height }: Drawing, strokes: readonly Stroke[]): void {
  const { scale, shift, turnDegrees } = (isObject(frame) ? frame : {}) as Partial<Placement>;
  const isPlacement = typeof scale === "number" && Array.isArray(shift) && shift.length === 2 && typeof turnDegrees === "number";
  check(isPlacement, "frame", `it is ${described(frame)} (expected {scale, shift: [x, y], turnDegrees})`, kFrame);
  const isFinite = Number.isFinite(scale) && scale > 0 && shift.every(Number.isFinite) && Number.isFinite(turnDegrees);
  check(isFinite, "frame", `it has the scale ${scale}, the shift (${shift.join(", ")}) and the turn ${turnDegrees} (expected finite numbers, the scale above 0)`, kFrame);
  const side = scale * Math.max(width, height, boxOfStrokes(strokes).longerSide);
  check(side >= kShortestOnCanvas && side <= kLongestOnCanvas, "frame",
    `its scale ${scale} makes the sheet ${side.toPrecision(2)} pixels long on a canvas of ${kSketchCanvas}, which shows no face`, kFrame);
}
