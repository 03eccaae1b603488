/** What is wrong, where, and how to repair it: `FILE: CAUSE. REPAIR`. */
export class DaumierError extends Error {
  override readonly name = "DaumierError";
  /** The file, address or argument. */
  readonly file: string;
  readonly repair: string;

  constructor(file: string, reason: string, repair: string, options?: ErrorOptions) {
    super(`${file}: ${reason}. ${repair}`, options);
    this.file = file;
    this.repair = repair;
  }
}

/** @throws DaumierError unless `condition`. */
export function check(condition: unknown, file: string, reason: string, repair: string): asserts condition {
  if (!condition) throw new DaumierError(file, reason, repair);
}

export function textOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
