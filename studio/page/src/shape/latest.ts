// One request at a time: while one runs, only the newest of those that wait is kept.

export class Latest<Q, R> {
  private waiting: { request: Q } | null = null;
  private running = false;

  constructor(
    private readonly send: (request: Q) => Promise<R>,
    private readonly done: (result: R, request: Q, isLast: boolean) => void,
    private readonly failed: (error: unknown, request: Q) => void,
    private readonly busy: (busy: boolean) => void,
  ) {}

  request(request: Q): void {
    this.waiting = { request };
    if (!this.running) void this.run();
  }

  private async run(): Promise<void> {
    this.running = true;
    this.busy(true);
    while (this.waiting) {
      const { request } = this.waiting;
      this.waiting = null;
      try {
        const result = await this.send(request);
        this.done(result, request, this.waiting === null);
      } catch (error) {
        // A newer request replaces one that failed.
        if (!this.waiting) this.failed(error, request);
      }
    }
    this.running = false;
    this.busy(false);
  }
}
