// A job as a person sees it: progress with cancel, an error in words, the command line that reproduces it.
import { isAbort, type Api } from "./api";
import type { Job } from "./api_types";
import { el } from "./dom";
import { button, newId } from "./widgets";

export class JobCard {
  readonly element = el("div", { class: "p-job", hidden: true });
  private running: AbortController | null = null;

  /** `withCommand`: a job that failed shows its command line, which a person may run by hand. */
  constructor(private readonly api: Api, private readonly withCommand = true) {}

  get isBusy(): boolean {
    return this.running !== null;
  }

  /** Runs a job to its end; null if it was cancelled or failed, which the card shows. `doing` is a sentence such as "Making the head". */
  async run(body: unknown, doing: string): Promise<Job | null> {
    this.cancel();
    const running = new AbortController();
    this.running = running;
    let last: Job | null = null;
    const show = this.progress(doing, () => running.abort());
    try {
      return await this.api.runJob(body, (job) => {
        last = job;
        if (this.running === running) show(job);
      }, running.signal);
    } catch (error) {
      if (this.running === running) this.showEnd(error, last);
      return null;
    } finally {
      if (this.running === running) {
        this.running = null;
        if (!this.element.classList.contains("p-ended")) this.element.hidden = true;
      }
    }
  }
  cancel(): void {
    this.running?.abort();
    this.running = null;
    this.clear();
  }
  clear(): void {
    this.element.hidden = true;
    this.element.replaceChildren();
  }

  private progress(doing: string, cancel: () => void): (job: Job) => void {
    const id = newId("job");
    const label = el("p", { id, class: "p-job-label" }, `${doing} …`);
    const detail = el("p", { class: "p-hint" }, "Starting");
    const bar = el("progress", { "aria-labelledby": id });
    const begin = performance.now();
    this.element.className = "p-job";
    this.element.hidden = false;
    let cancelled = false;
    const stop = button("Cancel", () => {
      cancelled = true;
      stop.disabled = true;
      detail.replaceChildren("Cancelling");
      cancel();
    });
    this.element.replaceChildren(label, bar, el("div", { class: "p-row p-spread" }, detail, stop));
    return (job) => {
      if (cancelled) return;
      const share = /(\d+)\s*\/\s*(\d+)/.exec(job.progress);
      if (share && Number(share[2]) > 0) {
        bar.max = Number(share[2]);
        bar.value = Number(share[1]);
      } else {
        bar.removeAttribute("value");
      }
      const words = job.state === "queued" ? "Waits for another job" : job.progress || "Working";
      // The server states the seconds of a job that has ended.
      detail.replaceChildren(`${words} · ${((performance.now() - begin) / 1000).toFixed(0)} s`);
    };
  }

  private showEnd(error: unknown, job: Job | null): void {
    this.element.className = "p-job p-ended";
    this.element.hidden = false;
    if (isAbort(error)) {
      this.element.replaceChildren(el("p", { role: "status" }, "Cancelled."));
      return;
    }
    const message = error instanceof Error ? error.message : String(error);
    const command = this.withCommand && job?.command ? commandField(job.command) : null;
    this.element.replaceChildren(el("div", { class: "p-error", role: "alert" }, el("p", {}, message)), ...(command ? [command] : []));
  }
}

/** A long command line is wrapped. */
const kMostRows = 5;
const kLettersOfRow = 34;

/** A command line that can be copied. */
export function commandField(command: string): HTMLElement {
  const id = newId("command");
  const rows = Math.min(kMostRows, Math.ceil(command.length / kLettersOfRow));
  const field = el("textarea", { id, class: "p-text p-command", readonly: true, rows, spellcheck: "false", onfocus: () => field.select() }, command);
  const copied = el("span", { class: "p-hint", role: "status" });
  const copy = button("Copy", () => {
    field.select();
    navigator.clipboard.writeText(command).then(
      () => copied.replaceChildren("Copied."),
      () => copied.replaceChildren("Press Ctrl+C."),
    );
  }, { icon: "copy", name: "Copy the command line" });
  return el("div", { class: "p-command-field" }, el("label", { for: id }, "The same by the command line"), el("div", { class: "p-row" }, field, copy), copied);
}

/** Sentences of a job that went well but for something. */
export function warningList(warnings: readonly string[]): HTMLElement | null {
  if (warnings.length === 0) return null;
  return el("ul", { class: "p-warnings", "aria-label": "Warnings" }, ...warnings.map((warning) => el("li", {}, warning)));
}
