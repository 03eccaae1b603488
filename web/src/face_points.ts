import { type FacePoint, kFacePoints } from "./drawing_terms.js";
import type { Point } from "./drawing.js";
import type { FaceTemplate } from "./face_template.js";

/** Counterparts of the points of a drawing on a template: faces/face_points.h. */
export interface FacePointVertices {
  /** The point is their mean; none for points of contours. */
  readonly ofPoints: readonly (readonly number[])[];
  /** Right and left: along the silhouette down to the chin. */
  readonly contours: readonly [readonly number[], readonly number[]];
}

const kChinLandmark = 8;
const kLandmarks: Partial<Record<FacePoint, number[]>> = {
  eye_right_outer: [36], eye_right_inner: [39], eye_right_top: [37, 38], eye_right_bottom: [40, 41],
  eye_left_inner: [42], eye_left_outer: [45], eye_left_top: [43, 44], eye_left_bottom: [46, 47],
  brow_right_outer: [17], brow_right_inner: [21], brow_left_inner: [22], brow_left_outer: [26],
  nose_bottom: [33], mouth_right: [48], mouth_left: [54], lip_top: [51], lip_bottom: [57], inner_top: [62], inner_bottom: [66],
  eye_right_centre: [36, 37, 38, 39, 40, 41], eye_left_centre: [42, 43, 44, 45, 46, 47],
};

/** The first of the least. */
function leastBy(items: readonly number[], value: (item: number) => number): number {
  return items.reduce((best, item) => (value(item) < value(best) ? item : best));
}

export function findFacePoints({ landmarks, curves, neutral }: FaceTemplate): FacePointVertices {
  const landmark = (i: number): number => landmarks[i]!;
  const x = (vertex: number): number => neutral[3 * vertex]!;
  const middleX = x(landmark(kChinLandmark));
  let jaw = [...(curves["jaw"] ?? landmarks.slice(3, 14))];
  if (x(jaw[0]!) > x(jaw[jaw.length - 1]!)) jaw = jaw.reverse();
  const chin = leastBy(jaw, (v) => Math.abs(x(v) - middleX)), middle = jaw.indexOf(chin);
  const others: Partial<Record<FacePoint, number[]>> = {
    chin: [chin],
    nose_wing_right: [leastBy(curves["nose_wing_right"] ?? [landmark(31)], x)],
    nose_wing_left: [leastBy(curves["nose_wing_left"] ?? [landmark(35)], (v) => -x(v))],
  };
  return {
    ofPoints: kFacePoints.map((name) => others[name] ?? kLandmarks[name]?.map(landmark) ?? []),
    contours: [[landmark(0), landmark(1), landmark(2), ...jaw.slice(0, middle + 1)],
      [landmark(16), landmark(15), landmark(14), ...jaw.slice(middle).reverse()]],
  };
}

/** 0 for a point of the right contour, 1 of the left one. */
export function contourOf(point: number): 0 | 1 | undefined {
  return kFacePoints[point] === "contour_right" ? 0 : kFacePoints[point] === "contour_left" ? 1 : undefined;
}

/** A point of a face that a camera projects to x, y of each vertex; of a contour the point nearest to `near`. */
export function projectedFacePoint(vertices: FacePointVertices, point: number, projected: Float64Array, near: Point): Point {
  const at = (vertex: number): Point => [projected[2 * vertex]!, projected[2 * vertex + 1]!];
  const contour = contourOf(point);
  if (contour === undefined) {
    const own = vertices.ofPoints[point]!.map(at);
    return [own.reduce((sum, p) => sum + p[0], 0) / own.length, own.reduce((sum, p) => sum + p[1], 0) / own.length];
  }
  const line = vertices.contours[contour];
  let best: Point = at(line[0]!), least = Infinity;
  for (let i = 0; i + 1 < line.length; ++i) {
    const from = at(line[i]!), to = at(line[i + 1]!), sx = to[0] - from[0], sy = to[1] - from[1];
    const along = ((near[0] - from[0]) * sx + (near[1] - from[1]) * sy) / Math.max(sx * sx + sy * sy, 1e-12);
    const share = Math.min(Math.max(along, 0), 1);
    const dx = from[0] + share * sx - near[0], dy = from[1] + share * sy - near[1], distance = dx * dx + dy * dy;
    if (distance >= least) continue;
    least = distance;
    best = [(1 - share) * from[0] + share * to[0], (1 - share) * from[1] + share * to[1]];
  }
  return best;
}
