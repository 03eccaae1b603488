import { DaumierError } from "./error.js";
import { kDrawnViews, kLineLabels, kNumLandmarkPoints, type LineLabel, showsFace } from "./drawing_terms.js";
import type { Placement, Point, Stroke } from "./drawing.js";

/** What a drawing shows, in the pixels of its sheet. */
export interface ParsedDrawing {
  /** By FacePoint. */
  points: Point[];
  /** 0 .. 1: how well the place of a point is determined. */
  confidences: number[];
  /** Probabilities by MouthState, EyeState (right, left) and DrawnView. */
  mouth: number[];
  eyes: [number[], number[]];
  view: number[];
  /** As given, with points at most 2 pixels of the canvas apart. */
  strokes: Stroke[];
  /** Of each point of each stroke. */
  labels: LineLabel[][];
  /** Sheet to canvas of the last round. */
  frame: Placement;
}

const kLeastProfile = 0.6, kLeastConfidence = 0.62, kTurned = 60;

/** Mean confidence of the landmarks: of upright faces by people 0.69 to 0.97. */
export function confidenceOf({ confidences }: ParsedDrawing): number {
  let sum = 0;
  for (let i = 0; i < kNumLandmarkPoints; ++i) sum += confidences[i]!;
  return sum / kNumLandmarkPoints;
}

/** The lines that show the face, pieces of strokes with one label each; all strokes if none does. */
export function linesOfFace({ strokes, labels }: ParsedDrawing): Stroke[] {
  const lines: Stroke[] = [];
  strokes.forEach((stroke, s) => {
    const own = labels[s]!;
    for (let begin = 0; begin < stroke.length;) {
      let end = begin + 1;
      while (end < stroke.length && own[end] === own[begin]) ++end;
      if (showsFace(own[begin]!)) lines.push(stroke.slice(begin, Math.min(end, stroke.length - 1) + 1));  // Runs meet at a point.
      begin = end;
    }
  });
  return lines.length > 0 ? lines : strokes;
}

/** @throws DaumierError if the drawing shows a profile. */
export function refuseProfile({ view }: ParsedDrawing): void {
  const profile = view[kDrawnViews.indexOf("profile")]!;
  if (profile >= kLeastProfile)
    throw new DaumierError("drawing", `it shows a face from the side (probability ${profile.toFixed(2)})`,
      "Faces are predicted from the front, or turned by up to about 60 degrees: draw both eyes");
}

/** What a person should hear of it. */
export function parseWarnings(parsed: ParsedDrawing): string[] {
  const warnings: string[] = [], confidence = confidenceOf(parsed);
  if (confidence < kLeastConfidence)
    warnings.push(`hardly a face is seen: the points are found with a confidence of ${confidence.toFixed(2)} (faces by most people 0.7 or more). `
      + "Is it one face from the front, drawn by lines?");
  const turn = parsed.frame.turnDegrees - 360 * Math.round(parsed.frame.turnDegrees / 360);
  if (Math.abs(turn) > kTurned) warnings.push(`the face is not upright on the sheet: it is read turned by ${turn.toFixed(0)} degrees`);
  return warnings;
}

export function labelAt(index: number): LineLabel {
  return kLineLabels[index]!;
}
