import { check } from "./error.js";

/** The calls of a model that run, and its end, which waits for them. */
export class Calls {
  private readonly running = new Set<Promise<unknown>>();
  private freed: Promise<void> | undefined;

  /** model: its folder, for messages. */
  constructor(private readonly model: string) {}

  /** @throws DaumierError after release. */
  async run<T>(call: () => Promise<T>): Promise<T> {
    check(this.freed === undefined, this.model, "the model was released", "Open it again");
    const running = call();
    this.running.add(running);
    try {
      return await running;
    } finally {
      this.running.delete(running);
    }
  }

  /** Once, after the calls that run; what is called later is refused at once. */
  release(free: () => Promise<void>): Promise<void> {
    return (this.freed ??= Promise.allSettled([...this.running]).then(free));
  }
}
