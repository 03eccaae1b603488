// One request at a time: while one runs, only the newest of those that wait is kept.

export class Latest<Q, R> {
  private waiting: { question: Q } | null = null;
  private running = false;

  constructor(
    private readonly ask: (question: Q) => Promise<R>,
    private readonly done: (result: R, question: Q, isLast: boolean) => void,
    private readonly failed: (error: unknown, question: Q) => void,
    private readonly busy: (busy: boolean) => void,
  ) {}

  request(question: Q): void {
    this.waiting = { question };
    if (!this.running) void this.run();
  }

  private async run(): Promise<void> {
    this.running = true;
    this.busy(true);
    while (this.waiting) {
      const { question } = this.waiting;
      this.waiting = null;
      try {
        const result = await this.ask(question);
        this.done(result, question, this.waiting === null);
      } catch (error) {
        // A newer request replaces one that failed.
        if (!this.waiting) this.failed(error, question);
      }
    }
    this.running = false;
    this.busy(false);
  }
}
