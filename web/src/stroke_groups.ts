import { Box, boxOf, type Stroke } from "./drawing.js";

/** Strokes that lie together on a sheet: render/faces_on_sheet.h, whose numbers these are. */

const kLeastGap = 0.125;  // Sizes of the larger group, by which groups are clearly apart.
const kGatheringCells = 64;  // Strokes with their boxes' corners in the same cells of this grid are one group from the start.
const kFewestStrokes = 4, kLeastOutline = 0.7;

export interface StrokeGroup {
  box: Box;
  length: number;
  /** Indices. */
  strokes: number[];
}

/** Undefined of a stroke without points. */
function groupOfStroke(stroke: Stroke, index: number): StrokeGroup | undefined {
  let length = 0;
  for (let i = 1; i < stroke.length; ++i) {
    const dx = stroke[i]![0] - stroke[i - 1]![0], dy = stroke[i]![1] - stroke[i - 1]![1];
    length += Math.sqrt(dx * dx + dy * dy);
  }
  return stroke.length === 0 ? undefined : { box: boxOf(stroke), length, strokes: [index] };
}

function extend(box: Box, { minX, minY, maxX, maxY }: Box): void {
  box.extend([minX, minY]);
  box.extend([maxX, maxY]);
}

function join(group: StrokeGroup, other: StrokeGroup): void {
  extend(group.box, other.box);
  group.length += other.length;
  group.strokes.push(...other.strokes);
}

/** The box of boxes. */
export function boxOfGroups(groups: readonly StrokeGroup[]): Box {
  const box = new Box();
  for (const group of groups) extend(box, group.box);
  return box;
}

/** One group for all strokes whose boxes have their corners in the same cells. */
export function gatheredGroups(strokes: readonly Stroke[]): StrokeGroup[] {
  const groups = strokes.map(groupOfStroke).filter((group) => group !== undefined), whole = boxOfGroups(groups);
  const cell = Math.max(whole.longerSide / kGatheringCells, 1e-9), gathered = new Map<number, StrokeGroup>();
  const keyed = groups.map((group) => {
    const { minX, minY, maxX, maxY } = group.box;
    const corners = [minX - whole.minX, minY - whole.minY, maxX - whole.minX, maxY - whole.minY];
    return { group, key: corners.reduce((key, corner) => key * (kGatheringCells + 1) + Math.trunc(corner / cell), 0) };
  });
  for (const { group, key } of keyed.sort((a, b) => a.key - b.key)) {
    const own = gathered.get(key);
    if (own === undefined) gathered.set(key, group);
    else join(own, group);
  }
  return [...gathered.values()];
}

/** Distance of two boxes, 0 where they meet. */
export function distanceOfBoxes(a: Box, b: Box): number {
  const dx = Math.max(a.minX - b.maxX, b.minX - a.maxX, 0), dy = Math.max(a.minY - b.maxY, b.minY - a.maxY, 0);
  return Math.sqrt(dx * dx + dy * dy);
}

/** Joins groups until all are clearly apart. */
export function joinNeighbours(groups: StrokeGroup[]): void {
  for (let joined = true; joined;) {
    joined = false;
    for (let i = 0; i < groups.length; ++i)
      for (let k = i + 1; k < groups.length;) {
        const one = groups[i]!, other = groups[k]!;
        if (distanceOfBoxes(one.box, other.box) > kLeastGap * Math.max(one.box.longerSide, other.box.longerSide)) {
          ++k;
          continue;
        }
        join(one, other);
        const last = groups.pop()!;
        if (k < groups.length) groups[k] = last;
        joined = true;
      }
  }
}

/** Whether the group has an outline and features: a face however small. */
export function hasOutline({ box, strokes: own }: StrokeGroup, strokes: readonly Stroke[]): boolean {
  return own.length > kFewestStrokes && own.some((index) => {
    const { width, height } = boxOf(strokes[index]!);
    return width >= kLeastOutline * box.width && height >= kLeastOutline * box.height;
  });
}
