// What the parts of the Shape panel share: the document, and how it is changed.
import type { Shape } from "../api_types";
import type { Weights } from "../expressions";

export interface Editor {
  readonly document: Shape;
  /** Merges fields into the document. `what` names the thing that moves, so that one drag is one undo. */
  change(fields: Partial<Shape>, what: string, done: boolean): void;
}

/** A part of the panel: shows the document again after an undo, and takes part in the search. */
export interface Part {
  readonly element: HTMLElement;
  show(document: Shape): void;
  /** Shows only what matches; true if anything does. */
  search?(words: string): boolean;
}

/** A list of numbers with one of them replaced. */
export function withValues(weights: Weights | undefined, values: Weights): Weights {
  return { ...weights, ...values };
}

export function matches(text: string, words: string): boolean {
  const lower = text.toLowerCase();
  return words.toLowerCase().split(/\s+/).every((word) => lower.includes(word));
}
