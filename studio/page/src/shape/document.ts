// The document of a shape: a face is a pure function of it, so an earlier document is an undo.
import type { Weights } from "../expressions";

export interface Handle {
  vertex: number;
  /** Centimetres: x to the head's own left, y up, z to the front. */
  move: [number, number, number];
}

export interface ShapeDocument {
  /** "mean", or the id of a pinned face or of a drawing. */
  base: string;
  toward?: { face: string; share: number };
  controls?: Weights;
  exaggeration?: number;
  caricature?: number;
  handles?: Handle[];
  expressions?: Weights;
  gains?: Weights;
}

export interface ShapeControl {
  name: string;
  title: string;
  group: string;
  sides: 1 | 2;
  least: number;
  greatest: number;
}

export interface ShapeRanges {
  controls: ShapeControl[];
  expressions: string[];
  expression_groups: Record<string, string[]>;
  caricature: [number, number];
  exaggeration: [number, number];
}

/** The document without what changes nothing: zeros, gains of 1, empty lists. */
export function tidy(document: ShapeDocument): ShapeDocument {
  const result: ShapeDocument = { base: document.base };
  const controls = without(document.controls, 0);
  const expressions = without(document.expressions, 0);
  const gains = without(document.gains, 1);
  if (document.toward) result.toward = document.toward;
  if (controls) result.controls = controls;
  if (document.exaggeration) result.exaggeration = document.exaggeration;
  if (document.caricature) result.caricature = document.caricature;
  if (document.handles?.length) result.handles = document.handles;
  if (expressions) result.expressions = expressions;
  if (gains) result.gains = gains;
  return result;
}

function without(weights: Weights | undefined, neutral: number): Weights | undefined {
  const kept = Object.entries(weights ?? {}).filter(([, value]) => value !== neutral);
  return kept.length ? Object.fromEntries(kept) : undefined;
}

/** Whether a document is its base alone. */
export function isPlain(document: ShapeDocument): boolean {
  return Object.keys(tidy(document)).length === 1;
}
