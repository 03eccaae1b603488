import { Box, kSketchCanvas, mapToCanvas, type Placement, type Point, rotated, type Stroke, toSheet } from "./drawing.js";
import { kDrawnViews, kFacePoints, kLineLabels, kMirroredPoints, type LineLabel, pointIndex } from "./drawing_terms.js";
import { check } from "./error.js";
import { type Folder } from "./folder.js";
import { withoutFarMarks } from "./framing.js";
import { averageWithMirrored, classAt, findPeak, softmax } from "./heat_maps.js";
import { readMouthLines } from "./mouth_lines.js";
import { Network, type OrtModule, outputOf, readManifest, type SessionOptions } from "./network.js";
import { confidenceOf, labelAt, type ParsedDrawing } from "./parsed_drawing.js";
import { inkOf } from "./raster.js";

/** Points, labels of lines, states and view of a drawing, as DrawingParser of the C++ runtime finds them. */

const kWholeShare = 0.9, kFaceShare = 0.62, kForehead = 0.45, kEdge = 3, kLabelStep = 2, kRounds = 2;
const kUncertainParse = 0.8, kCertainTurn = 0.66, kMoreCertain = 0.1;
const kStateClasses = [3, 2, 2, 4];

function centred(box: Box, turnDegrees: number, share: number): Placement {
  const scale = (share * kSketchCanvas) / Math.max(box.longerSide, 1e-6), [x, y] = box.centre;
  return { scale, shift: [0.5 * kSketchCanvas - scale * x, 0.5 * kSketchCanvas - scale * y], turnDegrees };
}

/** The whole drawing on the canvas, turned by a multiple of 90 degrees, centred. */
function frameOfWhole(strokes: readonly Stroke[], turnDegrees: number): Placement {
  const { box } = withoutFarMarks(strokes), turned = new Box(), radians = (turnDegrees * Math.PI) / 180;
  turned.extend(rotated([box.minX, box.minY], radians));
  turned.extend(rotated([box.maxX, box.maxY], radians));
  return centred(turned, turnDegrees, kWholeShare);
}

/** The upright face of parsed points on the canvas. */
function frameOfPoints(points: readonly Point[]): Placement {
  const right = points[pointIndex("eye_right_centre")]!, left = points[pointIndex("eye_left_centre")]!;
  const dx = left[0] - right[0], dy = left[1] - right[1], turn = -Math.atan2(dy, dx);
  const box = new Box();
  for (const point of points) box.extend(rotated(point, turn));
  const between = rotated([0.5 * (right[0] + left[0]), 0.5 * (right[1] + left[1])], turn);
  const below = Math.max(rotated(points[pointIndex("chin")]!, turn)[1] - between[1], 0.5 * Math.hypot(dx, dy));
  box.extend([between[0], between[1] - kForehead * below]);
  return centred(box, (turn * 180) / Math.PI, kFaceShare);
}

/** The strokes with more points, so that no two neighbours are farther apart than `step`, in single precision. */
function dense(strokes: readonly Stroke[], step: number): Stroke[] {
  return strokes.map((stroke) => stroke.flatMap((b, i): Point[] => {
    if (i === 0) return [b];
    const a = stroke[i - 1]!, dx = Math.fround(b[0] - a[0]), dy = Math.fround(b[1] - a[1]);
    const pieces = Math.max(1, Math.ceil(Math.fround(Math.sqrt(dx * dx + dy * dy)) / step)), more: Point[] = [];
    for (let k = 1; k < pieces; ++k) {
      const t = Math.fround(k / pieces);
      more.push([Math.fround(a[0] + Math.fround(t * dx)), Math.fround(a[1] + Math.fround(t * dy))]);
    }
    return [...more, b];
  }));
}

function mirroredPicture(picture: Float32Array, side: number): Float32Array {
  const mirrored = new Float32Array(picture.length);
  for (let row = 0; row < side; ++row) mirrored.set(picture.slice(row * side, (row + 1) * side).reverse(), row * side);
  return mirrored;
}

interface States {
  mouth: number[];
  eyes: [number[], number[]];
  view: number[];
}

function statesOf(scores: Float32Array, mirrored: boolean): States {
  const groups: number[][] = [];
  let first = 0;
  for (const count of kStateClasses) groups.push([...softmax(scores.subarray(first, (first += count)))]);
  const [mouth, right, left, view] = groups as [number[], number[], number[], number[]];
  if (!mirrored) return { mouth, eyes: [right, left], view };
  const a = kDrawnViews.indexOf("three-quarter-left"), b = kDrawnViews.indexOf("three-quarter-right");
  [view[a], view[b]] = [view[b]!, view[a]!];
  return { mouth, eyes: [left, right], view };
}

function mean(a: readonly number[], b: readonly number[]): number[] {
  return a.map((value, i) => 0.5 * (value + b[i]!));
}

export class DrawingParser {
  private constructor(private readonly network: Network, private readonly side: number, private readonly deviation: number) {}

  /** @throws DaumierError if the folder holds no parser of drawings. */
  static async open(ort: OrtModule, folder: Folder, options?: SessionOptions): Promise<DrawingParser> {
    const manifest = await readManifest(folder, "drawing_parser"), network = await Network.open(ort, folder, manifest, options);
    network.requireNames(["pictures"], ["heat_maps", "labels", "states"]);
    const [, , height, width] = network.inputShape("pictures");
    check(height !== undefined && height === width && height % 4 === 0, network.file, `it reads pictures of ${height} x ${width}`, "Export the parser again");
    const { deviation } = (manifest.details["network"] ?? {}) as { deviation?: number };
    return new DrawingParser(network, height, deviation ?? 1.2);
  }

  /** strokes: in single precision, without far marks. */
  async parse(strokes: readonly Stroke[]): Promise<ParsedDrawing> {
    let best = await this.parseTurned(strokes, 0);
    if (confidenceOf(best) < kUncertainParse) {
      let least = Math.max(kCertainTurn, confidenceOf(best) + kMoreCertain);
      for (const turn of [180, 90, 270]) {
        const turned = await this.parseTurned(strokes, turn);
        if (confidenceOf(turned) < least) continue;
        least = confidenceOf(turned);
        best = turned;
      }
    }
    readMouthLines(best);
    return best;
  }

  private async parseTurned(strokes: readonly Stroke[], turnDegrees: number): Promise<ParsedDrawing> {
    const whole = frameOfWhole(strokes, turnDegrees), denser = dense(strokes, kLabelStep / whole.scale);
    const drawing: ParsedDrawing = {
      points: [], confidences: [], mouth: [], eyes: [[], []], view: [], strokes: denser,
      labels: denser.map((stroke) => stroke.map((): LineLabel => "other")), frame: whole,
    };
    for (let round = 0; round < kRounds; ++round) await this.parseIn(round === 0 ? whole : frameOfPoints(drawing.points), drawing);
    return drawing;
  }

  private async parseIn(frame: Placement, drawing: ParsedDrawing): Promise<void> {
    const { side } = this, mapSide = side / 4, labelSide = side / 2;
    const onCanvas = mapToCanvas(drawing.strokes, frame), picture = inkOf(onCanvas, side);
    const pictures = new Float32Array(2 * side * side);
    pictures.set(picture);
    pictures.set(mirroredPicture(picture, side), side * side);
    const outputs = await this.network.run({ pictures: { data: pictures, shape: [2, 1, side, side] } });
    const halves = (name: string, size: number): [Float32Array, Float32Array] => {
      const { data, shape } = outputOf(outputs, name, this.network);
      check(data.length === 2 * size, this.network.file, `'${name}' has the shape ${shape.join(" x ")} (expected ${2 * size} numbers)`, "Export the parser again");
      return [data.subarray(0, size), data.subarray(size)];
    };
    const maps = averageWithMirrored(...halves("heat_maps", kFacePoints.length * mapSide * mapSide), mapSide, kMirroredPoints);
    const labels = averageWithMirrored(...halves("labels", kLineLabels.length * labelSide * labelSide), labelSide, kLineLabels.map((_, i) => i));
    const [own, mirrored] = halves("states", 11).map((scores, i) => statesOf(scores, i === 1)) as [States, States];
    drawing.frame = frame;
    drawing.mouth = mean(own.mouth, mirrored.mouth);
    drawing.eyes = [mean(own.eyes[0], mirrored.eyes[0]), mean(own.eyes[1], mirrored.eyes[1])];
    drawing.view = mean(own.view, mirrored.view);
    const cell = kSketchCanvas / mapSide, cells = mapSide * mapSide;
    const peaks = kFacePoints.map((_, i) => findPeak(maps.subarray(i * cells, (i + 1) * cells), mapSide, this.deviation));
    drawing.points = peaks.map(({ x, y }) => toSheet(frame, [cell * x, cell * y]));
    drawing.confidences = peaks.map(({ confidence }) => confidence);
    const labelCell = kSketchCanvas / labelSide;
    onCanvas.forEach((stroke, s) => stroke.forEach(([x, y], p) => {
      if (Math.min(x, y) < kEdge || Math.max(x, y) > kSketchCanvas - kEdge) return;
      drawing.labels[s]![p] = labelAt(classAt(labels, kLineLabels.length, labelSide, x / labelCell, y / labelCell));
    }));
  }

  release(): Promise<void> {
    return this.network.release();
  }
}
