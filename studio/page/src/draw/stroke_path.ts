// What becomes of a pen's path before the server has it: thinned samples, the stabiliser's line, mirror images.
import type { Point } from "../api_types";

export interface Sample {
  x: number;
  y: number;
  pressure: number;
}

/** Sheet pixels: nearer samples add nothing to a line. */
const kLeastStep = 0.75;

/** Appends a sample if it is far enough from the last one. */
export function append(path: Sample[], sample: Sample): boolean {
  const last = path[path.length - 1];
  if (last && Math.hypot(last.x - sample.x, last.y - sample.y) < kLeastStep) return false;
  path.push(sample);
  return true;
}

export function pointsOf(path: readonly Sample[]): Point[] {
  return path.map(({ x, y }) => [Math.round(x * 100) / 100, Math.round(y * 100) / 100]);
}
/** Share of the weight that a line has without pressure, as the server has it. */
const kLeastPressure = 0.05;
export function widthsOf(path: readonly Sample[], weight: number): number[] {
  return path.map(({ pressure }) => weight * Math.max(kLeastPressure, pressure));
}
export function pressureOf(path: readonly Sample[]): number[] {
  return path.map(({ pressure }) => Math.round(Math.min(1, Math.max(0, pressure)) * 1000) / 1000);
}

/** The line that the pen pulls behind it on a string, as the server computes it (session_pen.h), shown before it arrives. */
export function stabilised(path: readonly Sample[], string: number): Sample[] {
  const first = path[0];
  if (string <= 0 || !first) return [...path];
  const line: Sample[] = [first];
  let { x: qx, y: qy } = first;
  for (let i = 1; i < path.length; ++i) {
    const { x: ax, y: ay, pressure: before } = path[i - 1] ?? first;
    const { x: bx, y: by, pressure: after } = path[i] ?? first;
    const steps = 1 + Math.min(10_000, Math.floor((Math.hypot(bx - ax, by - ay) * 8) / string));
    for (let k = 1; k <= steps; ++k) {
      const px = ax + (k / steps) * (bx - ax);
      const py = ay + (k / steps) * (by - ay);
      const distance = Math.hypot(qx - px, qy - py);
      if (distance <= string) continue;
      qx = px + (string * (qx - px)) / distance;
      qy = py + (string * (qy - py)) / distance;
      line.push({ x: qx, y: qy, pressure: before + (k / steps) * (after - before) });
    }
  }
  return line;
}

export function mirrored(points: readonly Point[], axis: number): Point[] {
  return points.map(([x, y]) => [2 * axis - x, y]);
}

export function lengthOf(points: readonly Point[]): number {
  let sum = 0;
  for (let i = 1; i < points.length; ++i) {
    const a = points[i - 1];
    const b = points[i];
    if (a && b) sum += Math.hypot(b[0] - a[0], b[1] - a[1]);
  }
  return sum;
}

/** The parts of lines of which no point is near those that are left: what an eraser took. */
export function removedParts(before: readonly (readonly Point[])[], after: readonly (readonly Point[])[], near = 1.5): Point[][] {
  const left = after.flat();
  const isLeft = (p: Point) => left.some((q) => Math.abs(p[0] - q[0]) < near && Math.abs(p[1] - q[1]) < near);
  const parts: Point[][] = [];
  for (const line of before) {
    let part: Point[] = [];
    for (const point of line) {
      if (!isLeft(point)) {
        part.push(point);
        continue;
      }
      if (part.length > 1) parts.push(part);
      part = [];
    }
    if (part.length > 1) parts.push(part);
  }
  return parts;
}
