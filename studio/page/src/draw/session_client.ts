// A drawing session on the server: events are sent one after the other, previews at most one at a time, vertices of the newest state alone.
import type { Api } from "../api";
import { isAbort } from "../api";
import type { Point, SessionEvent, SessionState } from "../api_types";

declare global {
  interface Window {
    /** Milliseconds from the end of a stroke to the first applied vertices that it has shaped, without WebGL drawing; at most 100, newest last. */
    daumierTimes?: number[];
    /** The same to the vertices of the state on the server, where those of the network alone came first. */
    daumierFinalTimes?: number[];
  }
}

const kMostTimes = 100;

export interface SessionListener {
  /** The lines, mode, handles ... are new. */
  state(state: SessionState): void;
  /** The face is new; null: the state has none. */
  vertices(vertices: Float32Array | null): void;
  /** The number of events that wait for the server. */
  waiting(count: number): void;
  fail(error: unknown): void;
}

export class SessionClient {
  private current: SessionState | null = null;
  private queue: Promise<unknown> = Promise.resolve();
  private count = 0;
  private fetching: AbortController | null = null;
  private previewing: AbortController | null = null;
  private nextPreview: { points: Point[]; endedAt: number | null } | null = null;
  private recorded = -1;

  constructor(
    private readonly api: Api,
    private readonly listener: SessionListener,
  ) {}

  get state(): SessionState | null {
    return this.current;
  }
  get id(): string | null {
    return this.current?.id ?? null;
  }

  /** Shows a session that the server has created or opened. */
  async open(state: SessionState): Promise<void> {
    this.stopPreview();
    this.current = state;
    this.listener.state(state);
    await this.fetchVertices(state, null);
  }
  close(): void {
    this.stopPreview();
    this.fetching?.abort();
    this.current = null;
  }

  /**
   * Sends an event after those that wait. endedAt: performance.now() when the pen was lifted. line: the whole stroke, of which a last
   * preview arrives before the state does. Null: it failed.
   */
  send(event: SessionEvent, endedAt = performance.now(), line: Point[] | null = null): Promise<SessionState | null> {
    if (line && this.count === 0) this.preview(line, endedAt);
    else this.stopPreview();
    const id = this.id;
    this.listener.waiting(++this.count);
    const sent = this.queue.then(async () => {
      try {
        if (id === null || id !== this.id) return null;
        const state = await this.api.sendEvent(id, event);
        if (id !== this.id) return null;
        this.stopPreview();
        this.current = state;
        this.listener.state(state);
        // The next event need not wait for the vertices of this one.
        void this.fetchVertices(state, endedAt);
        return state;
      } catch (error) {
        this.listener.fail(error);
        return null;
      } finally {
        this.listener.waiting(--this.count);
      }
    });
    this.queue = sent;
    return sent;
  }

  private async fetchVertices(state: SessionState, endedAt: number | null): Promise<void> {
    this.fetching?.abort();
    const control = new AbortController();
    this.fetching = control;
    try {
      const vertices = state.has_face ? await this.api.sessionVertices(state.id, state.revision, control.signal) : null;
      if (control.signal.aborted || this.id !== state.id) return;
      this.listener.vertices(vertices);
      if (endedAt !== null && vertices) this.recordTime(endedAt, true);
    } catch (error) {
      if (!isAbort(error)) this.listener.fail(error);
    }
  }
  /** Of the faces of one stroke the first one is recorded. */
  private recordTime(endedAt: number, isFinal: boolean): void {
    const record = (times: number[]) => {
      times.push(performance.now() - endedAt);
      if (times.length > kMostTimes) times.shift();
    };
    if (endedAt !== this.recorded) record((window.daumierTimes ??= []));
    if (isFinal) record((window.daumierFinalTimes ??= []));
    this.recorded = endedAt;
  }

  /** The face while the pen is down. While one request is under way the newest points wait, older ones are dropped. */
  preview(points: Point[], endedAt: number | null = null): void {
    if (!this.current || this.current.mode !== "draw" || this.count > 0) return;
    this.nextPreview = { points, endedAt };
    if (!this.previewing) void this.runPreviews(this.current.id);
  }
  private async runPreviews(id: string): Promise<void> {
    const control = new AbortController();
    this.previewing = control;
    try {
      while (this.nextPreview && !control.signal.aborted) {
        const { points, endedAt } = this.nextPreview;
        this.nextPreview = null;
        const vertices = await this.api.preview(id, points, control.signal);
        if (control.signal.aborted || !vertices) continue;
        this.listener.vertices(vertices);
        if (endedAt !== null) this.recordTime(endedAt, false);
      }
    } catch {
      // A preview that fails is no loss: the event at the end of the stroke reports what is wrong.
    } finally {
      if (this.previewing === control) this.previewing = null;
    }
  }
  stopPreview(): void {
    this.nextPreview = null;
    this.previewing?.abort();
    this.previewing = null;
  }
}
