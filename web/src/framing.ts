import { check } from "./error.js";
import { Box, boxOf, boxOfStrokes, kSketchCanvas, type Point, type Stroke } from "./drawing.js";

const kShareOutside = 0.02;  // Of the length of all strokes, beyond each side of the core box.
const kReach = 0.15;  // From the core box, as a share of its longer side, within which strokes belong to the drawing.
const kNumSteps = 500, kMostSamples = 1e6;

interface Sample {
  at: number;
  length: number;
}

/** The coordinate below which `share` of the length lies. */
function weightedQuantile(sorted: readonly Sample[], share: number): number {
  const total = sorted.reduce((sum, { length }) => sum + length, 0);
  let sum = 0;
  for (const { at, length } of sorted) {
    sum += length;
    if (sum >= share * total) return at;
  }
  return sorted[sorted.length - 1]!.at;
}

function distance(a: Point, b: Point): number {
  const dx = b[0] - a[0], dy = b[1] - a[1];
  return Math.sqrt(dx * dx + dy * dy);
}

/** The box that holds all but the outermost lengths of the strokes. */
function coreBox(strokes: readonly Stroke[], least: number): Box {
  let total = 0;
  for (const stroke of strokes) for (let i = 1; i < stroke.length; ++i) total += distance(stroke[i - 1]!, stroke[i]!);
  const step = Math.max(least, total / kMostSamples), xs: Sample[] = [], ys: Sample[] = [];
  for (const stroke of strokes)
    for (let i = 1; i < stroke.length; ++i) {
      const from = stroke[i - 1]!, to = stroke[i]!, length = distance(from, to), numParts = Math.max(1, Math.ceil(length / step));
      for (let part = 0; part < numParts; ++part) {
        const share = (part + 0.5) / numParts;
        xs.push({ at: from[0] + share * (to[0] - from[0]), length: length / numParts });
        ys.push({ at: from[1] + share * (to[1] - from[1]), length: length / numParts });
      }
    }
  const box = new Box();
  for (const samples of [xs, ys]) samples.sort((a, b) => a.at - b.at);
  if (xs.length > 0) for (const share of [kShareOutside, 1 - kShareOutside]) box.extend([weightedQuantile(xs, share), weightedQuantile(ys, share)]);
  return box;
}

const kCurveHeight = 0.62, kMaxWidth = 0.8;  // Of the drawing on the canvas, shares of its side.

/** The drawing without marks far outside of it (dirt, a signature), its box, and pixels of the canvas of one of the sheet: render::FrameDrawing. */
export function withoutFarMarks(strokes: readonly Stroke[]): { strokes: Stroke[]; box: Box; scale: number } {
  const whole = boxOfStrokes(strokes);
  check(!whole.isEmpty && whole.longerSide > 0, "drawing", "it has no extent", "Draw a face by lines");
  const core = coreBox(strokes, whole.longerSide / kNumSteps), reach = core.isEmpty ? whole : core;
  const margin = kReach * reach.longerSide, kept: Stroke[] = [], box = new Box();
  for (const stroke of strokes) {
    const own = boxOf(stroke);
    const isNear = own.minX <= reach.maxX + margin && own.maxX >= reach.minX - margin && own.minY <= reach.maxY + margin && own.maxY >= reach.minY - margin;
    if (stroke.length === 0 || !isNear) continue;
    box.extend([own.minX, own.minY]);
    box.extend([own.maxX, own.maxY]);
    kept.push(stroke);
  }
  const least = 1e-9 * whole.longerSide;
  return { strokes: kept, box, scale: kSketchCanvas * Math.min(kCurveHeight / Math.max(box.height, least), kMaxWidth / Math.max(box.width, least)) };
}
