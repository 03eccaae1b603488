// What a pen leaves on a sheet: points with time and pressure, and the steps back.
import type { Point } from "../api_types";

/** Sheet pixels: nearer samples add nothing to a line. */
const kLeastStep = 0.4;

export interface PenStroke {
  points: Point[];
  /** Since the sheet was shown. */
  times_ms: number[];
  pressures: number[];
}

const rounded = (value: number, digits: number): number => Math.round(value * 10 ** digits) / 10 ** digits;

export function newStroke(): PenStroke {
  return { points: [], times_ms: [], pressures: [] };
}

/** Appends a sample unless it is where the last one is. Returns whether it did. */
export function addSample(stroke: PenStroke, x: number, y: number, timeMs: number, pressure: number): boolean {
  const last = stroke.points[stroke.points.length - 1];
  if (last && Math.hypot(last[0] - x, last[1] - y) < kLeastStep) return false;
  stroke.points.push([rounded(x, 2), rounded(y, 2)]);
  // Clocks of events may step back by a fraction of a millisecond.
  stroke.times_ms.push(Math.max(0, stroke.times_ms[stroke.times_ms.length - 1] ?? 0, rounded(timeMs, 1)));
  stroke.pressures.push(rounded(Math.min(1, Math.max(0, pressure)), 3));
  return true;
}

/** The strokes of a sheet, and how it was before each change. */
export class StrokeHistory {
  private readonly earlier: PenStroke[][] = [];
  constructor(private now: PenStroke[] = []) {
    for (let count = 0; count < now.length; ++count) this.earlier.push(now.slice(0, count));
  }

  get strokes(): readonly PenStroke[] {
    return this.now;
  }
  get canUndo(): boolean {
    return this.earlier.length > 0;
  }
  add(stroke: PenStroke): void {
    this.change([...this.now, stroke]);
  }
  clear(): void {
    if (this.now.length > 0) this.change([]);
  }
  undo(): void {
    this.now = this.earlier.pop() ?? this.now;
  }
  private change(next: PenStroke[]): void {
    this.earlier.push(this.now);
    this.now = next;
  }
}
