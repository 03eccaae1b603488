import { check } from "./error.js";
import { kIdentity, type Placement, type Point, toSheet } from "./drawing.js";
import { pointIndex } from "./drawing_terms.js";
import { contourOf, type FacePointVertices, projectedFacePoint } from "./face_points.js";

const kScaleDeviation = 0.4, kTurnDeviation = (12 * Math.PI) / 180, kPointDeviation = 0.06, kRounds = 20;

interface Match {
  onSheet: Point;
  drawn: Point;
  weight: number;
}

/** Gaussian elimination with pivots. */
export function solve(matrix: readonly (readonly number[])[], right: readonly number[]): number[] {
  const rows = matrix.map((row, i) => [...row, right[i]!]), n = rows.length;
  for (let k = 0; k < n; ++k) {
    let pivot = k;
    for (let i = k + 1; i < n; ++i) if (Math.abs(rows[i]![k]!) > Math.abs(rows[pivot]![k]!)) pivot = i;
    [rows[k], rows[pivot]] = [rows[pivot]!, rows[k]!];
    for (let i = k + 1; i < n; ++i) {
      const factor = rows[i]![k]! / rows[k]![k]!;
      for (let j = k; j <= n; ++j) rows[i]![j]! -= factor * rows[k]![j]!;
    }
  }
  const x = new Array<number>(n).fill(0);
  for (let k = n - 1; k >= 0; --k) {
    let sum = rows[k]![n]!;
    for (let j = k + 1; j < n; ++j) sum -= rows[k]![j]! * x[j]!;
    x[k] = sum / rows[k]![k]!;
  }
  return x;
}

/** The weighted least-squares similarity with its priors: a = 1, b = 0 of (a -b; b a). */
function solveFrame(matches: readonly Match[]): Placement {
  const a = kScaleDeviation ** -2, b = kTurnDeviation ** -2;
  const normal = [[a, 0, 0, 0], [0, b, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]], right = [a, 0, 0, 0];
  for (const { onSheet: [x, y], drawn, weight } of matches)
    for (const [row, value] of [[[x, -y, 1, 0], drawn[0]], [[y, x, 0, 1], drawn[1]]] as const)
      for (let i = 0; i < 4; ++i) {
        for (let j = 0; j < 4; ++j) normal[i]![j]! += weight * row[i]! * row[j]!;
        right[i]! += weight * row[i]! * value;
      }
  const [scaleCos, scaleSin, shiftX, shiftY] = solve(normal, right) as [number, number, number, number];
  return { scale: Math.hypot(scaleCos, scaleSin), shift: [shiftX, shiftY], turnDegrees: (Math.atan2(scaleSin, scaleCos) * 180) / Math.PI };
}

/**
 * From the sheet of a camera to the canvas of a drawing, by robust least squares between the projected points of a face
 * and those of the drawing: fitting::FindFaceFrame. points and confidences: of the drawing, by FacePoint.
 */
export function findFaceFrame(vertices: FacePointVertices, projected: Float64Array, points: readonly Point[], confidences: ArrayLike<number>): Placement {
  const origin: Point = [0, 0];
  const left = projectedFacePoint(vertices, pointIndex("eye_left_outer"), projected, origin);
  const rightEye = projectedFacePoint(vertices, pointIndex("eye_right_outer"), projected, origin);
  const unit = kPointDeviation * Math.hypot(left[0] - rightEye[0], left[1] - rightEye[1]);
  const shown = points.map((_, i) => i).filter((i) => confidences[i]! > 0);
  const contoursAlone = shown.every((i) => contourOf(i) !== undefined);
  let frame: Placement | undefined;
  for (let round = 0; round <= kRounds; ++round) {
    const matches: Match[] = [], distances: number[] = [];
    for (const i of shown) {
      if (frame === undefined && !contoursAlone && contourOf(i) !== undefined) continue;  // No place before a first frame.
      const near = toSheet(frame ?? kIdentity, points[i]!), onSheet = projectedFacePoint(vertices, i, projected, near);
      matches.push({ onSheet, drawn: points[i]!, weight: confidences[i]! });
      distances.push(Math.hypot(near[0] - onSheet[0], near[1] - onSheet[1]));
    }
    check(matches.length > 0, "drawing", "no point of a face is found in it", "Draw one face, by lines");
    const scale = frame?.scale ?? 1, median = [...distances].sort((a, b) => a - b)[distances.length >> 1]!;
    const least = 3 * Math.max(unit, 1.4826 * median);
    matches.forEach((match, k) => {
      const share = frame === undefined ? 0 : distances[k]! / least;
      match.weight *= (1 + share * share) ** -2 / (unit * unit * scale * scale);
    });
    frame = solveFrame(matches);
    check(frame.scale > 1e-6, "drawing", "its points coincide, so that they have no frame", "Draw one face, by lines");
  }
  return frame!;
}
