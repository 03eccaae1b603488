// Strokes on their way to the server: shown until it has drawn them; what an eraser took stays as a shadow until it is drawn again.
import type { Point, SessionEvent, SessionState } from "../api_types";
import type { LocalStroke } from "./paper_drawing";
import type { SessionClient } from "./session_client";
import { removedParts } from "./stroke_path";

export class StrokeSender {
  /** Lines that were erased and wait to be drawn again. */
  ghosts: Point[][] = [];
  /** Strokes that the server has not drawn yet, by the number of their event. */
  private readonly pending = new Map<number, LocalStroke[]>();
  private events = 0;

  constructor(private readonly session: SessionClient) {}

  get shown(): LocalStroke[] {
    return [...this.pending.values()].flat();
  }
  get isWaiting(): boolean {
    return this.pending.size > 0;
  }
  clear(): void {
    this.pending.clear();
  }

  /** Sends the event of a stroke. The state after it; null: it failed. */
  async send(event: SessionEvent, shown: LocalStroke[], endedAt: number, line: SessionEvent | null): Promise<SessionState | null> {
    const state = this.session.state;
    const before = state?.mode === "follow_up" ? state.lines.map((each) => each.points) : [];
    const number = ++this.events;
    this.pending.set(number, shown);
    const next = await this.session.send(event, endedAt, line);
    this.pending.delete(number);
    if (next && event.do === "erase") this.ghosts.push(...removedParts(before, next.lines.map((each) => each.points)));
    else this.ghosts = [];
    return next;
  }
}
