// The 68 landmarks of a face in a picture: their names, the lines between them, and files of them.
import type { Point } from "../api_types";

export const kNumLandmarks = 68;

/** Lines of the drawing over a picture: first and last landmark from 0, closed or not. Left and right are those of the face. */
export const kLandmarkParts: readonly { name: string; first: number; last: number; closed: boolean }[] = [
  { name: "jaw", first: 0, last: 16, closed: false },
  { name: "right brow", first: 17, last: 21, closed: false },
  { name: "left brow", first: 22, last: 26, closed: false },
  { name: "bridge of the nose", first: 27, last: 30, closed: false },
  { name: "base of the nose", first: 31, last: 35, closed: false },
  { name: "right eye", first: 36, last: 41, closed: true },
  { name: "left eye", first: 42, last: 47, closed: true },
  { name: "outer lips", first: 48, last: 59, closed: true },
  { name: "inner lips", first: 60, last: 67, closed: true },
];

const kCorners: Record<number, string> = {
  0: "right end",
  8: "chin",
  16: "left end",
  30: "tip",
  36: "outer corner",
  39: "inner corner",
  42: "inner corner",
  45: "outer corner",
  48: "right corner",
  54: "left corner",
  60: "right corner",
  64: "left corner",
};

/** "36: right eye, outer corner"; numbers from 0, as in the field's figures of code. */
export function landmarkTitle(index: number): string {
  const part = kLandmarkParts.find((each) => index >= each.first && index <= each.last);
  const corner = kCorners[index];
  return `${index}: ${part?.name ?? ""}${corner ? `, ${corner}` : ""}`;
}

/** 68 points of a face from the front in the middle of a picture, where the network finds none. */
export function placedLandmarks(width: number, height: number): Point[] {
  const unit = 0.3 * Math.min(width, height);
  const points: Point[] = [];
  // On an ellipse, in half widths of the face, from one angle to another; degrees, clockwise on the screen, from the right.
  const arc = (x: number, y: number, rx: number, ry: number, count: number, from: number, to: number) => {
    for (let i = 0; i < count; ++i) {
      const angle = ((from + ((to - from) * i) / (count - 1)) * Math.PI) / 180;
      points.push([width / 2 + unit * (x + rx * Math.cos(angle)), height / 2 + unit * (y + ry * Math.sin(angle))]);
    }
  };
  arc(0, -0.1, 1, 1.2, 17, 180, 0);
  arc(-0.47, -0.45, 0.32, 0.14, 5, 190, 350);
  arc(0.47, -0.45, 0.32, 0.14, 5, 190, 350);
  for (let i = 0; i < 4; ++i) points.push([width / 2, height / 2 + unit * (-0.27 + 0.17 * i)]);
  arc(0, 0.33, 0.22, 0.07, 5, 180, 0);
  arc(-0.44, -0.24, 0.18, 0.08, 6, 180, 480);
  arc(0.44, -0.24, 0.18, 0.08, 6, 180, 480);
  arc(0, 0.66, 0.36, 0.15, 12, 180, 510);
  arc(0, 0.66, 0.27, 0.06, 8, 180, 495);
  return points;
}

/** A .pts file, version 1. */
export function writePts(points: readonly Point[]): string {
  const rows = points.map(([x, y]) => `${x.toFixed(3)} ${y.toFixed(3)}`);
  return `version: 1\nn_points: ${points.length}\n{\n${rows.join("\n")}\n}\n`;
}

/** The 68 points of a .pts file. @throws Error with a sentence. */
export function readPts(fileName: string, text: string): Point[] {
  const body = /\{([^}]*)\}/.exec(text)?.[1];
  if (body === undefined) throw new Error(`${fileName}: no points between { and } (expected a .pts file).`);
  const rows = body.split(/\r?\n/).filter((row) => row.trim());
  const points = rows.map((row): Point => {
    const [x = NaN, y = NaN] = row.trim().split(/\s+/).map(Number);
    if (!Number.isFinite(x) || !Number.isFinite(y)) throw new Error(`${fileName}: “${row.trim()}” is no point (expected x y).`);
    return [x, y];
  });
  if (points.length !== kNumLandmarks) throw new Error(`${fileName} has ${points.length} points (expected ${kNumLandmarks}).`);
  return points;
}
