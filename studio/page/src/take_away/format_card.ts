// A card of a format: what it is for, its choices, the job, and the files that came out.
import type { Job } from "../api_types";
import { download, el } from "../dom";
import { commandField, JobCard, warningList } from "../job_card";
import type { Studio } from "../tab";
import { button, choice, fileSize, icon, newId } from "../widgets";
import type { Choice, Format } from "./formats";
import { targetKey, whyNot, type FormatId, type Target } from "./targets";
import { zipOf } from "./zip";

/** More files than these come as a .zip, and in a list that folds. */
const kFewFiles = 4;

export class FormatCard {
  readonly element: HTMLElement;
  private readonly job: JobCard;
  private readonly make: HTMLButtonElement;
  private readonly no = el("p", { class: "p-hint" });
  private readonly options: HTMLElement;
  private readonly result = el("div", { class: "p-files", hidden: true });
  private readonly chosen: Record<string, string>;
  private readonly fields: { choice: Choice; element: HTMLElement }[];
  private target: Target | null = null;

  constructor(private readonly studio: Studio, private readonly format: Format) {
    this.job = new JobCard(studio.api);
    this.chosen = studio.recall<Record<string, string>>(`take-away.${format.id}`, {});
    this.make = button(format.make, () => void this.run().catch((error) => studio.fail(error)), { kind: format.id === "glb" ? "primary" : "plain" });
    this.fields = format.choices.map((each) => {
      const field = choice(each.label, (value) => {
        this.chosen[each.key] = value;
        studio.remember(`take-away.${format.id}`, this.chosen);
        this.stale();
      });
      field.set(each.values.map((value) => ({ ...value })), this.chosen[each.key] ?? each.values[0]?.value ?? "");
      field.select.setAttribute("aria-label", `${each.label} of ${format.title}`);
      return { choice: each, element: field.element };
    });
    this.options = el("div", { class: "p-card-options" }, ...this.fields.map((field) => field.element));
    const id = newId("card");
    this.element = el(
      "article",
      { class: "p-card", "aria-labelledby": id },
      el("div", { class: "p-card-icon" }, icon(format.icon)),
      el("div", { class: "p-card-words" }, el("h3", { id }, format.title), el("p", {}, format.what)),
      this.options,
      el("div", { class: "p-card-make" }, this.make, this.no),
      this.job.element,
      this.result,
    );
  }

  setTarget(target: Target | null): void {
    const before = this.target && targetKey(this.target);
    this.target = target;
    const no = target ? whyNot(target, this.format.id) : "There is nothing to take away yet.";
    this.no.replaceChildren(no ?? "");
    this.no.hidden = no === null;
    this.make.hidden = no !== null;
    this.options.hidden = no !== null;
    for (const field of this.fields) field.element.hidden = target?.kind === "avatar" && field.choice.notOfAvatars === true;
    this.element.classList.toggle("p-not", no !== null);
    if (before !== null && before !== (target && targetKey(target))) this.stale();
    if (this.result.hidden && !this.job.isBusy) this.showMade().catch(() => undefined);
  }
  /** Names what is made: the same target with the same choices, unchanged since. */
  private request(): string {
    const { target } = this;
    if (!target || whyNot(target, this.format.id) !== null) return "";
    return JSON.stringify([this.format.body(target, this.chosen), target.kind === "session" ? target.changed : 0]);
  }
  /** The files that were made before a reload, where the server still has them. */
  private async showMade(): Promise<void> {
    const request = this.request();
    const made = this.studio.recall<{ request: string; job: string } | null>(this.madeKey, null);
    if (request === "" || made?.request !== request) return;
    const job = await this.studio.api.get<Job>(`/api/jobs/${made.job}`);
    if (this.request() === request && this.result.hidden && !this.job.isBusy) this.showFiles(job);
  }
  private get madeKey(): string {
    return `take-away.${this.format.id}.made`;
  }
  get id(): FormatId {
    return this.format.id;
  }

  /** Files of another face or of other choices are not offered. */
  private stale(): void {
    this.result.hidden = true;
    this.result.replaceChildren();
    if (!this.job.isBusy) this.job.clear();
  }

  private async run(): Promise<void> {
    const { target, format } = this;
    if (!target || this.job.isBusy) return;
    this.stale();
    const body = format.body(target, this.chosen);
    if (body === null) {
      if (target.kind === "session") await this.takeSession(target);
      return;
    }
    this.make.disabled = true;
    const request = this.request();
    try {
      const job = await this.job.run(body, format.doing);
      if (!job) return;
      this.studio.remember(this.madeKey, { request, job: job.id });
      this.showFiles(job);
      this.result.scrollIntoView({ block: "nearest" });
    } finally {
      this.make.disabled = false;
    }
  }

  private async takeSession(target: { id: string; title: string }): Promise<void> {
    const bytes = await this.studio.api.blob(`/api/sessions/${target.id}/session.json`);
    const name = `${fileStem(target.title)}.json`;
    download(bytes, name);
    this.result.hidden = false;
    this.result.replaceChildren(
      el("p", { role: "status" }, `${name}, ${fileSize(bytes.size)}, is in your downloads.`),
      commandField(`daumier predict --session ${name} --out drawing`),
    );
  }

  private showFiles(job: Job): void {
    const all = job.files.filter((file) => !file.name.startsWith("stages/"));
    const isWanted = (file: { name: string }) => this.format.wanted.some((end) => file.name.endsWith(end));
    const wanted = all.filter(isWanted);
    const others = all.filter((file) => !isWanted(file));
    const sum = wanted.reduce((total, file) => total + file.size, 0);
    const list = (files: Job["files"]) => el("ul", { class: "p-file-list" }, ...files.map((file) => el("li", {}, this.link(job, file))));
    const fold = (title: string, files: Job["files"]) => el("details", { class: "p-how" }, el("summary", {}, title), list(files));
    const zip = () => this.downloadAll(job, wanted.map((file) => file.name)).catch((error) => this.studio.fail(error));
    const parts: (HTMLElement | null)[] = [
      el("p", { role: "status" }, `Ready: ${wanted.length === 1 ? "one file" : `${wanted.length} files`}, ${fileSize(sum)}, in ${job.seconds.toFixed(1)} s.${printSize(job)}`),
      ...(wanted.length > kFewFiles
        ? [button("Download all as a .zip", () => void zip(), { icon: "download" }), fold("One by one", wanted)]
        : [list(wanted)]),
      others.length ? fold(others.length === 1 ? "One more file" : `${others.length} more files`, others) : null,
      warningList(job.warnings),
      job.command ? commandField(job.command) : null,
      job.note ? el("p", { class: "p-note" }, `${job.note}.`) : null,
    ];
    this.result.hidden = false;
    this.result.replaceChildren(...parts.filter((part) => part !== null));
  }
  private link(job: Job, file: { name: string; size: number }): HTMLButtonElement {
    const name = this.ownName(file.name);
    const made = button(name, () => void this.downloadOne(job, file.name).catch((error) => this.studio.fail(error)), {
      kind: "quiet",
      icon: "download",
      title: `Download ${name}`,
    });
    made.append(el("span", { class: "p-note" }, fileSize(file.size)));
    return made;
  }
  private async downloadOne(job: Job, name: string): Promise<void> {
    download(await this.studio.api.jobFile(job.id, name), this.ownName(name.split("/").at(-1) ?? name));
  }
  private async downloadAll(job: Job, names: readonly string[]): Promise<void> {
    const entries = await Promise.all(
      names.map(async (name) => ({ name, bytes: new Uint8Array(await (await this.studio.api.jobFile(job.id, name)).arrayBuffer()) })),
    );
    download(zipOf(entries), `${fileStem(this.target?.title ?? "")}-${this.format.id}.zip`);
  }
  /** "head.glb" with the name of what was taken away. */
  private ownName(name: string): string {
    return name.replace(/^head(?=\.)/, fileStem(this.target?.title ?? ""));
  }
}

/** A title as the beginning of a file's name. */
function fileStem(title: string): string {
  return title.replace(/\.\w+$/, "").replace(/[^\p{L}\p{N}_-]+/gu, "_") || "head";
}

/** " 159 x 207 x 245 mm." of a print. */
function printSize(job: Job): string {
  const print = job.result?.["print"] as { size_mm?: number[] } | undefined;
  return print?.size_mm ? ` ${print.size_mm.map((length) => Math.round(length)).join(" × ")} mm.` : "";
}
