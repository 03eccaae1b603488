// Undo and redo by earlier values. Changes of one drag are one step, and so are presses of a key in quick succession.

export interface HistoryState<T> {
  past: T[];
  present: T;
  future: T[];
}

const kMost = 100;
/** Milliseconds within which two finished changes of the same thing are one step. */
const kTogether = 700;

export class History<T> {
  private step: { what: string; open: boolean; at: number } | null = null;

  constructor(private state: HistoryState<T>) {}

  get present(): T {
    return this.state.present;
  }
  get canUndo(): boolean {
    return this.state.past.length > 0;
  }
  get canRedo(): boolean {
    return this.state.future.length > 0;
  }
  /** What a reload needs. */
  get all(): HistoryState<T> {
    return this.state;
  }

  /** Replaces the present. `what` names the thing that moves; until `done` further changes of it belong to the same step. */
  change(present: T, what: string, done: boolean): void {
    const now = Date.now();
    const same = this.step?.what === what && (this.step.open || now - this.step.at < kTogether);
    const past = same ? this.state.past : [...this.state.past, this.state.present].slice(-kMost);
    this.state = { past, present, future: [] };
    this.step = { what, open: !done, at: now };
  }

  undo(): boolean {
    const present = this.state.past.at(-1);
    if (present === undefined) return false;
    this.state = { past: this.state.past.slice(0, -1), present, future: [this.state.present, ...this.state.future] };
    this.step = null;
    return true;
  }

  redo(): boolean {
    const [present, ...future] = this.state.future;
    if (present === undefined) return false;
    this.state = { past: [...this.state.past, this.state.present], present, future };
    this.step = null;
    return true;
  }
}
