import { boxOfStrokes, type Stroke } from "./drawing.js";
import { withoutLettering } from "./lettering.js";
import { distanceOfBoxes, gatheredGroups, hasOutline, joinNeighbours, type StrokeGroup } from "./stroke_groups.js";

/** render::FacesOnSheet, whose numbers these are. */

const kMostGroups = 2000;
const kFewestStrokes = 4, kLeastSize = 0.4, kSurelyLarge = 0.5, kLeastLength = 1 / 3, kGreatestAspect = 2.5, kLeastShare = 0.85;

/** The groups that are faces; none where the drawing does not clearly hold several. */
function faceGroups(groups: readonly StrokeGroup[], strokes: readonly Stroke[]): StrokeGroup[] {
  const size = Math.max(0, ...groups.map(({ box }) => box.longerSide)), length = Math.max(0, ...groups.map((group) => group.length));
  const largest = groups.find(({ box }) => box.longerSide === size), mayBeSmall = largest !== undefined && hasOutline(largest, strokes);
  const faces = groups.filter((group) => {
    const { box } = group;
    return group.strokes.length >= kFewestStrokes && box.longerSide >= kLeastSize * size && group.length >= kLeastLength * length &&
      box.longerSide <= kGreatestAspect * Math.min(box.width, box.height) && (box.longerSide >= kSurelyLarge * size || (mayBeSmall && hasOutline(group, strokes)));
  });
  const lengthOf = (of: readonly StrokeGroup[]): number => of.reduce((sum, each) => sum + each.length, 0);
  return lengthOf(faces) < kLeastShare * lengthOf(groups) ? [] : faces;
}

export interface LargestFace {
  /** In their order. */
  strokes: Stroke[];
  /** Faces on the sheet. */
  numFaces: number;
  /** Strokes of titles, dates and signatures. */
  numLeftOut: number;
}

/** The largest of the faces on a sheet, without lettering; of one face all its strokes. */
export function largestFace(strokes: readonly Stroke[]): LargestFace {
  const drawn = strokes.filter((stroke) => stroke.length > 0), all = gatheredGroups(drawn);
  if (all.length > kMostGroups) return { strokes: drawn, numFaces: 1, numLeftOut: 0 };
  joinNeighbours(all);
  const groups = withoutLettering(all, drawn), faces = faceGroups(groups, drawn);
  const picked = (indices: readonly number[]): Stroke[] => [...indices].sort((a, b) => a - b).map((index) => drawn[index]!);
  const kept = groups.flatMap((group) => group.strokes), numLeftOut = drawn.length - kept.length;
  if (faces.length < 2) return { strokes: picked(kept), numFaces: 1, numLeftOut };
  const members = new Map(faces.map((face) => [face, [...face.strokes]]));
  for (const group of groups) {
    if (members.has(group)) continue;  // What else is on the sheet belongs to the nearest face.
    const nearest = faces.reduce((best, face) => (distanceOfBoxes(face.box, group.box) < distanceOfBoxes(best.box, group.box) ? face : best));
    members.get(nearest)!.push(...group.strokes);
  }
  const drawings = [...members.values()].map(picked), areas = drawings.map((drawing) => {
    const { width, height } = boxOfStrokes(drawing);
    return width * height;
  });
  return { strokes: drawings[areas.indexOf(Math.max(...areas))]!, numFaces: faces.length, numLeftOut };
}
