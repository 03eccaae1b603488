// Weights that another program posts to the server, polled while a person listens.
import type { Api } from "../api";
import type { Weights } from "../expressions";

const kNextMs = 40;
const kQuietMs = 500;
/** Older weights are those of a stream that has ended. */
const kOldMs = 2000;

export class LiveStream {
  private running: AbortController | null = null;

  constructor(private readonly api: Api) {}

  get isOn(): boolean {
    return this.running !== null;
  }

  /** `frame` receives weights as they come; null while nothing arrives. `failed` ends the stream. */
  start(frame: (weights: Weights | null) => void, failed: (error: unknown) => void): void {
    this.stop();
    const running = new AbortController();
    this.running = running;
    const poll = async () => {
      if (running.signal.aborted) return;
      try {
        const got = await this.api.getOrNull<{ weights: Weights; age_ms: number }>("/api/drive", running.signal);
        if (running.signal.aborted) return;
        const fresh = got !== null && got.age_ms < kOldMs;
        frame(fresh ? got.weights : null);
        setTimeout(() => void poll(), fresh ? kNextMs : kQuietMs);
      } catch (error) {
        if (running.signal.aborted) return;
        this.stop();
        failed(error);
      }
    };
    void poll();
  }
  stop(): void {
    this.running?.abort();
    this.running = null;
  }
}
