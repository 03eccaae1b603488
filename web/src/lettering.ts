import { Box, boxOf, type Stroke } from "./drawing.js";
import { boxOfGroups, hasOutline, type StrokeGroup } from "./stroke_groups.js";

/** Titles, dates and signatures above or below a face: render/faces_on_sheet.h, whose numbers these are. In sizes of the face. */

const kGapBelow = 0.125, kGapAbove = 0.25, kLargestLetter = 0.2, kHighestRow = 0.3, kFewestLetters = 4, kLeastRowAspect = 2;
const kFewestTurns = 4, kLeastTurn = 0.2, kWidestSignature = 0.7;
const kLeastHead = 0.6, kWholeFace = 0.8, kFewestStrokes = 4, kGreatestAspect = 2.5, kLeastSize = 0.4;

/** How often the stroke turns up or down by a share of its height. */
function numTurns(stroke: Stroke, height: number): number {
  let turns = 0, direction = 0, extreme = stroke[0]![1];
  for (const [, y] of stroke) {
    const step = y - extreme;
    if (direction * step >= 0 && direction !== 0) {
      extreme = y;
    } else if (Math.abs(step) >= kLeastTurn * height) {
      if (direction !== 0) ++turns;
      direction = step > 0 ? 1 : -1;
      extreme = y;
    }
  }
  return turns;
}

/** Groups side by side. */
type Row = StrokeGroup[];

function rowsOf(groups: readonly StrokeGroup[]): Row[] {
  const rows: Row[] = [];
  let bottom = -Infinity;
  for (const group of [...groups].sort((a, b) => a.box.minY - b.box.minY)) {
    if (group.box.minY > bottom) rows.push([]);
    bottom = Math.max(group.box.minY > bottom ? -Infinity : bottom, group.box.maxY);
    rows[rows.length - 1]!.push(group);
  }
  return rows;
}

/** Whether a row of small groups, apart from a face of this box, is lettering. */
function isLettering(row: Row, strokes: readonly Stroke[], face: Box): boolean {
  const size = face.longerSide, box = boxOfGroups(row);
  const isBelow = box.minY >= face.maxY + kGapBelow * size, isAbove = box.maxY <= face.minY - kGapAbove * size;
  if ((!isBelow && !isAbove) || box.height > kHighestRow * size || box.width < kLeastRowAspect * box.height) return false;
  let numLetters = 0, hasSignature = false;
  for (const index of row.flatMap((group) => group.strokes)) {
    const stroke = strokes[index]!, { width, height, longerSide } = boxOf(stroke);
    const isWritten = isBelow && width <= kWidestSignature * size && width > height && height <= kLargestLetter * size && numTurns(stroke, height) >= kFewestTurns;
    if (!isWritten && longerSide > kLargestLetter * size) return false;
    hasSignature ||= isWritten;
    ++numLetters;
  }
  return hasSignature || numLetters >= kFewestLetters;
}

/** The groups without lettering; all unless heads with an outline, or one group that is the whole face, have most of the other lines. */
export function withoutLettering(groups: StrokeGroup[], strokes: readonly Stroke[]): StrokeGroup[] {
  let size = 0;
  for (const { box, strokes: own } of groups)
    if (own.length >= kFewestStrokes && Math.min(box.width, box.height) * kGreatestAspect >= box.longerSide) size = Math.max(size, box.longerSide);
  let rows = rowsOf(groups.filter(({ box }) => box.height <= kHighestRow * size)), kept = groups, face = new Box();
  for (let changed = true; changed && rows.length > 0;) {
    const leftOut = new Set(rows.flat());
    kept = groups.filter((group) => !leftOut.has(group));
    face = boxOfGroups(kept);
    if (face.isEmpty) return groups;
    const letters = rows.filter((row) => isLettering(row, strokes, face));
    changed = letters.length < rows.length;
    rows = letters;
  }
  if (rows.length === 0) return groups;
  const isHead = (group: StrokeGroup): boolean => (group.box.longerSide >= kLeastSize * size && hasOutline(group, strokes)) ||
    (group.box.width >= kWholeFace * face.width && group.box.height >= kWholeFace * face.height);
  const lengthOf = (of: readonly StrokeGroup[]): number => of.reduce((sum, { length }) => sum + length, 0);
  return lengthOf(kept.filter(isHead)) < kLeastHead * lengthOf(kept) ? groups : kept;
}
