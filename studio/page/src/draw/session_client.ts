// A drawing session on the server: events are sent one after the other, previews at most one at a time.
import type { Api } from "../api";
import type { SessionEvent, SessionState } from "../api_types";

declare global {
  interface Window {
    /** Milliseconds from the pointer event that ends a stroke to the first applied vertices that it has shaped, before they are drawn; at most 100, newest last. */
    daumierTimes?: number[];
    /** The same to the vertices of the state on the server, where those of the network alone came first. */
    daumierFinalTimes?: number[];
    /** Of these, what the server has computed. */
    daumierServerTimes?: number[];
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
  private previewing: AbortController | null = null;
  private nextPreview: { event: SessionEvent; endedAt: number | null } | null = null;
  /** Vertices of the state, which a preview that comes to nothing gives back. */
  private settled: Float32Array | null = null;
  private isPreviewShown = false;
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
    this.settled = null;
    this.listener.state(state);
    const vertices = state.has_face ? await this.api.sessionVertices(state.id, state.revision) : null;
    // An event may have been sent meanwhile.
    if (this.current === state) this.take(vertices);
  }
  close(): void {
    this.stopPreview();
    this.current = null;
  }

  /**
   * Sends an event after those that wait. endedAt: the time stamp of the pen that was lifted. line: the whole stroke, of which a last
   * preview arrives before the state does. Null: it failed.
   */
  send(event: SessionEvent, endedAt = performance.now(), line: SessionEvent | null = null): Promise<SessionState | null> {
    if (line && this.count === 0) this.preview(line, endedAt);
    else this.stopPreview();
    const id = this.id;
    this.listener.waiting(++this.count);
    const sent = this.queue.then(async () => {
      try {
        if (id === null || id !== this.id) return null;
        const { state, vertices } = await this.api.sendEvent(id, event);
        if (id !== this.id) return null;
        this.stopPreview();
        this.current = state;
        this.listener.state(state);
        this.take(vertices);
        if (vertices) this.recordTime(endedAt, true, state.milliseconds);
        return state;
      } catch (error) {
        this.dropPreview();
        this.listener.fail(error);
        return null;
      } finally {
        this.listener.waiting(--this.count);
      }
    });
    this.queue = sent;
    return sent;
  }

  private take(vertices: Float32Array | null): void {
    this.settled = vertices;
    this.isPreviewShown = false;
    this.listener.vertices(vertices);
  }
  /** Of the faces of one stroke the first one is recorded. */
  private recordTime(endedAt: number, isFinal: boolean, ofServer = 0): void {
    const record = (times: number[], time = performance.now() - endedAt) => {
      times.push(time);
      if (times.length > kMostTimes) times.shift();
    };
    if (endedAt !== this.recorded) record((window.daumierTimes ??= []));
    if (isFinal) {
      record((window.daumierFinalTimes ??= []));
      record((window.daumierServerTimes ??= []), ofServer);
    }
    this.recorded = endedAt;
  }

  /** The face while the pen is down. While one request is under way the newest event waits, older ones are dropped. */
  preview(event: SessionEvent, endedAt: number | null = null): void {
    if (!this.current || this.count > 0) return;
    this.nextPreview = { event, endedAt };
    if (!this.previewing) void this.runPreviews(this.current.id);
  }
  private async runPreviews(id: string): Promise<void> {
    const control = new AbortController();
    this.previewing = control;
    try {
      while (this.nextPreview && !control.signal.aborted) {
        const { event, endedAt } = this.nextPreview;
        this.nextPreview = null;
        const vertices = await this.api.preview(id, event, control.signal);
        if (control.signal.aborted || !vertices) continue;
        this.isPreviewShown = true;
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
  /** The stroke came to nothing: the face of the state is shown again. */
  dropPreview(): void {
    this.stopPreview();
    if (this.isPreviewShown) this.take(this.settled);
  }
}
