import { kMouthStates, type LineLabel, pointIndex } from "./drawing_terms.js";
import type { Point } from "./drawing.js";
import type { ParsedDrawing } from "./parsed_drawing.js";

/** A mouth by the lines that cuts across it meet, for closed mouths: systems/sketch/mouth_lines.h, whose numbers these are. */

const kMouthCuts = [0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7];
const kLabelsOfLines: readonly LineLabel[] = ["upper_lip", "inner_mouth", "lower_lip"];
const kSameLine = 0.8, kClosedByLines = 0.89;
const kLeastWidth = 8, kMouthReach = 0.9, kLeastThreeCuts = 6, kLeastTwoCuts = 7;
const kHighestMiddle = -0.1, kLowestMiddle = 0.16, kLeastUpperShare = 0.15, kMostUpperShare = 0.65;
const kRaisedLip = -0.06, kLevelMiddle = 0.08, kThinnestLips = 0.1, kThickestLips = 0.3, kShareOfUpperLip = 0.45;
const kSureOfTeeth = 0.5, kShareOfStroke = 0.8;

type Three = [number, number, number];
/** How far below the line of the corners each cut meets upper lip, middle and lower lip, in widths of the mouth. */
type ClosedMouthLines = (Three | undefined)[];

function showsMouth(label: LineLabel): boolean {
  return kLabelsOfLines.includes(label);
}

/** From the right corner of the mouth to the left one x is 0 to 1; y is down from there, in widths of the mouth. */
class MouthFrame {
  private readonly origin: Point;
  private readonly along: Point;
  readonly widthOnCanvas: number;

  constructor({ points, frame }: ParsedDrawing) {
    const left = points[pointIndex("mouth_left")]!;
    this.origin = points[pointIndex("mouth_right")]!;
    this.along = [left[0] - this.origin[0], left[1] - this.origin[1]];
    this.widthOnCanvas = frame.scale * Math.hypot(...this.along);
  }
  of([x, y]: Point): Point {
    const dx = x - this.origin[0], dy = y - this.origin[1], [ax, ay] = this.along, squared = ax * ax + ay * ay;
    return [(ax * dx + ay * dy) / squared, (ax * dy - ay * dx) / squared];
  }
  place(x: number, y: number): Point {
    const [ax, ay] = this.along;
    return [this.origin[0] + x * ax - y * ay, this.origin[1] + x * ay + y * ax];
  }
}

interface LineOnCut {
  y: number;
  label: LineLabel;
  numMerged: number;
}

/** The lines that a cut meets, from above. */
function linesOnCut({ strokes, labels }: ParsedDrawing, mouth: MouthFrame, x: number): LineOnCut[] {
  const met: LineOnCut[] = [];
  strokes.forEach((stroke, s) => {
    for (let i = 1; i < stroke.length; ++i) {
      const before = labels[s]![i - 1]!, after = labels[s]![i]!;
      if (!showsMouth(before) && !showsMouth(after)) continue;
      const a = mouth.of(stroke[i - 1]!), b = mouth.of(stroke[i]!);
      if (a[0] <= x === b[0] <= x) continue;
      const t = (x - a[0]) / (b[0] - a[0]), y = a[1] + t * (b[1] - a[1]);
      if (Math.abs(y) <= kMouthReach) met.push({ y, label: t < 0.5 ? before : after, numMerged: 1 });
    }
  });
  met.sort((a, b) => a.y - b.y);
  const lines: LineOnCut[] = [];
  for (const line of met) {
    const last = lines[lines.length - 1];
    if (last === undefined || (line.y - last.y) * mouth.widthOnCanvas >= kSameLine) {
      lines.push({ ...line });
      continue;
    }
    last.y = (last.numMerged * last.y + line.y) / (last.numMerged + 1);
    last.label = line.label;
    ++last.numMerged;
  }
  return lines;
}

function threeLines(cuts: readonly LineOnCut[][]): ClosedMouthLines | undefined {
  const withThree = cuts.filter((lines) => lines.length >= 3), num = withThree.length;
  if (num < kLeastThreeCuts) return undefined;
  const mean = [0, 1, 2].map((i) => withThree.reduce((sum, lines) => sum + lines[i]!.y, 0) / num) as Three;
  const upperLabels = withThree.filter((lines) => lines[0]!.label === "upper_lip").length;
  const lowerLabels = withThree.filter((lines) => lines[2]!.label === "lower_lip").length;
  const upperShare = (mean[1] - mean[0]) / (mean[2] - mean[0]);
  const isLevel = mean[1] >= kHighestMiddle && mean[1] <= kLowestMiddle && upperShare >= kLeastUpperShare && upperShare <= kMostUpperShare;
  const areLips = 2 * upperLabels > num && 2 * lowerLabels > num, isRaised = mean[0] < kRaisedLip && mean[1] < kLevelMiddle;
  if (!isLevel || !(areLips || isRaised)) return undefined;
  return cuts.map((lines) => (lines.length < 3 ? undefined : [lines[0]!.y, lines[1]!.y, lines[2]!.y]));
}

function outline(cuts: readonly LineOnCut[][]): ClosedMouthLines | undefined {
  const withTwo = cuts.filter((lines) => lines.length >= 2), num = withTwo.length;
  if (num < kLeastTwoCuts || withTwo.reduce((sum, lines) => sum + lines[0]!.y, 0) / num >= kRaisedLip) return undefined;
  const thickness = Math.max(0, ...withTwo.map((lines) => lines[1]!.y - lines[0]!.y));
  if (thickness < kThinnestLips || thickness > kThickestLips) return undefined;
  return cuts.map((lines) => {
    if (lines.length < 2) return undefined;
    const upper = lines[0]!.y, lower = lines[1]!.y;
    return [upper, upper + kShareOfUpperLip * (lower - upper), lower];
  });
}

function findClosedMouthLines(drawing: ParsedDrawing, mouth: MouthFrame): ClosedMouthLines | undefined {
  if (!(mouth.widthOnCanvas >= kLeastWidth)) return undefined;
  const cuts = kMouthCuts.map((x) => linesOnCut(drawing, mouth, x)), most = Math.max(...cuts.map((lines) => lines.length));
  return most === 3 ? threeLines(cuts) : most === 2 ? outline(cuts) : undefined;
}

/** Which of the three lines a place in the mouth's frame is nearest to; beyond the outer cuts they run to the corners. */
function nearestLine(lines: ClosedMouthLines, [x, y]: Point): number | undefined {
  const first = kMouthCuts[0]!, last = kMouthCuts[kMouthCuts.length - 1]!, step = kMouthCuts[1]! - first;
  if (x <= 0 || x >= 1) return undefined;
  const ofCut = lines[Math.round((Math.min(Math.max(x, first), last) - first) / step)];
  if (ofCut === undefined) return undefined;
  const share = Math.min(x / first, 1, (1 - x) / (1 - last)), distances = ofCut.map((line) => Math.abs(share * line - y));
  return distances.indexOf(Math.min(...distances));
}

function labelLines(lines: ClosedMouthLines, mouth: MouthFrame, drawing: ParsedDrawing): void {
  drawing.labels.forEach((labels, s) => {
    const counts: Three = [0, 0, 0];
    const ofPoints = labels.map((label, i) => {
      const line = showsMouth(label) ? nearestLine(lines, mouth.of(drawing.strokes[s]![i]!)) : undefined;
      if (line !== undefined) ++counts[line]!;
      return line;
    });
    const most = counts.indexOf(Math.max(...counts)), sum = counts[0] + counts[1] + counts[2];
    const isOne = sum > 0 && counts[most]! >= kShareOfStroke * sum;
    labels.forEach((label, i) => {
      if (!showsMouth(label)) return;
      const line = isOne ? most : ofPoints[i];
      if (line !== undefined) labels[i] = kLabelsOfLines[line]!;
    });
  });
}

/** Of a closed mouth, unless the network finds teeth, the lines decide: state, inner points and labels. */
export function readMouthLines(drawing: ParsedDrawing): void {
  const closed = kMouthStates.indexOf("closed"), open = kMouthStates.indexOf("open"), teeth = kMouthStates.indexOf("teeth");
  if (drawing.mouth[teeth]! >= kSureOfTeeth) return;
  const mouth = new MouthFrame(drawing), lines = findClosedMouthLines(drawing, mouth);
  if (lines === undefined) return;
  if (drawing.mouth[closed]! < kClosedByLines) {
    const others = (1 - kClosedByLines) / (1 - drawing.mouth[closed]!);
    drawing.mouth[open]! *= others;
    drawing.mouth[teeth]! *= others;
    drawing.mouth[closed] = kClosedByLines;
  }
  let middle: number | undefined;  // The cut with lines that is nearest to the middle.
  kMouthCuts.forEach((x, cut) => {
    if (lines[cut] !== undefined && (middle === undefined || Math.abs(x - 0.5) < Math.abs(kMouthCuts[middle]! - 0.5))) middle = cut;
  });
  const seam = mouth.place(kMouthCuts[middle!]!, lines[middle!]![1]);
  for (const point of ["inner_top", "inner_bottom"] as const) drawing.points[pointIndex(point)] = seam;
  labelLines(lines, mouth, drawing);
}
