// The document of a shape: a face is a pure function of it, so an earlier document is an undo.
import type { Shape } from "../api_types";
import type { Weights } from "../expressions";

export type Handle = NonNullable<Shape["handles"]>[number];

/** The document without what changes nothing: zeros, gains of 1, empty lists. */
export function tidy(document: Shape): Shape {
  const result: Shape = { base: document.base };
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
export function isPlain(document: Shape): boolean {
  return Object.keys(tidy(document)).length === 1;
}
