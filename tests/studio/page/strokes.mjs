// Lines of a drawing, as lists of points [x, y].
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { repository } from '../../../tools/consumers/studio/client.mjs';

/** Index of the upper lid of the eye on the left of the sheet among the strokes of PortraitStrokes. */
export const kUpperLid = 7;

/** The free strokes of docs/examples/sessions/front.json, in the middle of another sheet. */
export function portraitStrokes(sheet) {
  const recording = JSON.parse(readFileSync(join(repository, 'docs/examples/sessions/front.json'), 'utf8'));
  const shift = [0, 1].map((axis) => (sheet[axis] - recording.sheet[axis]) / 2);
  const numFree = recording.events.findIndex((event) => event.do !== 'draw');
  return recording.events.slice(0, numFree).map((event) => event.points.map(([x, y]) => [x + shift[0], y + shift[1]]));
}

/** Mean distance of the points of a line from the nearest point of another one. */
export function distanceBetween(line, other) {
  const nearest = ([x, y]) => Math.min(...other.map((point) => Math.hypot(point[0] - x, point[1] - y)));
  return line.reduce((sum, point) => sum + nearest(point), 0) / line.length;
}

/** The line nearest to a given one. */
export function nearestLine(lines, line) {
  return lines.reduce((best, each) => (distanceBetween(line, each) < distanceBetween(line, best) ? each : best));
}

/** An arc from one point to another that rises by `height` in the middle (y is down). */
export function arc([x0, y0], [x1, y1], height, numPoints = 15) {
  return [...Array(numPoints).keys()].map((i) => {
    const t = i / (numPoints - 1);
    return [x0 + t * (x1 - x0), y0 + t * (y1 - y0) - height * 4 * t * (1 - t)];
  });
}
