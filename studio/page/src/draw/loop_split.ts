// One closed stroke around two gaps with the same ends, as one draws an eye whose lids are both erased.
import type { Point, SessionEvent } from "../api_types";
import { lengthOf } from "./stroke_path";

/** Share of its length that a closed stroke may leave open. */
const kOpenShare = 0.2;
/** Sheet pixels between the ends of gaps that are the same. */
const kSame = 2;

type Draw = Extract<SessionEvent, { do: "draw" }>;

/**
 * The two strokes that fill both gaps, the upper one first: the server fills equally near gaps in the order of its curves, in which
 * upper lids and lips come before lower ones. Any other stroke is left as it is.
 */
export function splitLoop(stroke: Draw, openEnds: readonly (readonly [Point, Point])[]): Draw[] {
  const { points, pressure } = stroke;
  const first = points[0];
  const last = points.at(-1);
  if (!first || !last || distance(first, last) > kOpenShare * lengthOf(points)) return [stroke];
  const gap = sharedGap(openEnds, middleOf(points));
  if (!gap) return [stroke];
  const [from, to] = cornersOf(points, gap);
  if (to - from < 2 || points.length - to + from < 2) return [stroke];
  const part = <T>(values: readonly T[]): [T[], T[]] => [values.slice(from, to + 1), [...values.slice(to), ...values.slice(0, from + 1)]];
  const [lines, widths] = [part(points), pressure ? part(pressure) : null];
  const halves = lines.map((line, i): Draw => ({ ...stroke, points: line, ...(widths ? { pressure: widths[i] ?? [] } : {}) }));
  return halves.sort((a, b) => middleOf(a.points)[1] - middleOf(b.points)[1]);
}

/** The ends that two gaps share, nearest to a place. */
function sharedGap(openEnds: readonly (readonly [Point, Point])[], place: Point): readonly [Point, Point] | null {
  const isSame = (a: readonly [Point, Point], b: readonly [Point, Point]) =>
    (distance(a[0], b[0]) < kSame && distance(a[1], b[1]) < kSame) || (distance(a[0], b[1]) < kSame && distance(a[1], b[0]) < kSame);
  const shared = openEnds.filter((gap, i) => openEnds.some((other, k) => k !== i && isSame(gap, other)));
  const away = (gap: readonly [Point, Point]) => distance(middleOf(gap), place);
  return shared.sort((a, b) => away(a) - away(b))[0] ?? null;
}

/** The points of a closed line that lie farthest along the line through the ends of a gap: its corners, in the line's order. */
function cornersOf(points: readonly Point[], [a, b]: readonly [Point, Point]): [number, number] {
  const along = points.map(([x, y]) => x * (b[0] - a[0]) + y * (b[1] - a[1]));
  const least = along.indexOf(Math.min(...along));
  const greatest = along.indexOf(Math.max(...along));
  return [Math.min(least, greatest), Math.max(least, greatest)];
}
function middleOf(points: readonly Point[]): Point {
  const sum = points.reduce<Point>((total, [x, y]) => [total[0] + x, total[1] + y], [0, 0]);
  return [sum[0] / points.length, sum[1] / points.length];
}
function distance(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}
