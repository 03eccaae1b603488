// Collects drawings: a face in two views, and a blank sheet.
import type { Api } from "../api";
import { button, el } from "../dom";
import { PlainPage, setPicture } from "../plain_page";
import type { PenStroke } from "./pen_stroke";
import { Sheet } from "./sheet";

interface State {
  person: string;
  done: number;
  total: number;
  face: { number: number } | null;
  next: { number: number } | null;
}

/** An unfinished sheet, for a reload. */
interface Kept {
  person: string;
  face: number;
  elapsedMs: number;
  strokes: PenStroke[];
}
const kKept = "daumier-sheet";
const kPenWidth = 2.5;

export class CollectPage {
  readonly page = new PlainPage("Draw this face");
  private readonly views = ["front", "side"].map((view) => ({ view, image: el("img", { alt: `The face from the ${view}` }) }));
  private readonly sheet: Sheet;
  private readonly undoButton = button("Undo stroke", () => this.sheet.undo(), { title: "Undo stroke (Ctrl+Z)" });
  private readonly clearButton = button("Clear", () => this.sheet.clear());
  private readonly skipButton = button("Skip", () => this.send("/api/collect/skip", { face: this.state?.face?.number }), { title: "Show this face again later" });
  private readonly nextButton = button("Next", () => this.next(), { class: "primary", title: "Keep the drawing and show the next face (Ctrl+Enter)" });
  private readonly layout: HTMLElement;
  private state: State | null = null;
  private busy = false;

  constructor(private readonly api: Api, sheetSide: number) {
    this.sheet = new Sheet(sheetSide, kPenWidth, () => this.changed());
    this.layout = el("div", { class: "collect" },
      el("div", { class: "collect-views" }, ...this.views.map(({ view, image }) =>
        el("figure", {}, image, el("figcaption", {}, view === "front" ? "From the front" : "From the side")))),
      el("div", { class: "collect-paper" }, this.sheet.element,
        el("div", { class: "collect-actions" }, this.undoButton, this.clearButton,
          el("p", { class: "collect-hint" }, "Outline of the head, ears, brows, eyes, nose, mouth. No neck, no hair."), this.skipButton, this.nextButton)));
    document.addEventListener("keydown", (event) => this.key(event));
  }

  async start(): Promise<void> {
    this.state = await this.api.get<State>("/api/collect");
    const kept = this.kept();
    if (kept) {
      await this.showFace(kept);
      return;
    }
    this.showProgress();
    if (!this.state.face) this.thank();
    else this.page.showCard("You will see faces, one at a time", [
      "Draw each face from the front, as you see it, so that another person can recognise its shape and its expression.",
      "Draw the outline of the head, the ears, brows, eyes, nose and mouth, and lines that matter. Leave out neck and hair.",
      "The time that you take is recorded. There is no limit, and you can stop at any face and continue later.",
    ], { label: this.state.done === 0 ? "Begin" : "Continue", run: () => void this.showFace().catch((error) => this.page.fail(error)) });
  }

  private kept(): Kept | null {
    try {
      const kept = JSON.parse(sessionStorage.getItem(kKept) ?? "null") as Kept | null;
      return kept && kept.strokes.length > 0 && kept.person === this.state?.person && kept.face === this.state.face?.number ? kept : null;
    } catch {
      return null;
    }
  }
  private showProgress(): void {
    if (!this.state) return;
    const { done, total, face } = this.state;
    this.page.progress(done, total, face ? `${done + 1} of ${total}` : `${done} of ${total}`);
  }
  private thank(): void {
    sessionStorage.removeItem(kKept);
    this.page.showCard("Thank you", [`All ${this.state?.total ?? 0} faces are drawn. You can close this page.`]);
  }
  private async showFace(kept?: Kept): Promise<void> {
    const face = this.state?.face;
    if (!face) {
      this.showProgress();
      this.thank();
      return;
    }
    // The time begins when the face is seen.
    await Promise.all(this.views.map(({ view, image }) => setPicture(image, this.picture(face.number, view))));
    this.showProgress();
    if (!this.layout.isConnected) this.page.show(this.layout);
    this.sheet.show(kept?.strokes, kept?.elapsedMs);
    // The server draws the next face while a person draws this one.
    const next = this.state?.next;
    if (next) for (const { view } of this.views) this.picture(next.number, view).catch(() => undefined);
  }
  private picture(face: number, view: string): Promise<Blob> {
    return this.api.blob(`/api/collect/faces/${face}/${view}.png`);
  }
  private changed(): void {
    const empty = this.sheet.strokes.length === 0;
    this.undoButton.disabled = this.busy || !this.sheet.canUndo;
    this.clearButton.disabled = this.busy || empty;
    this.nextButton.disabled = this.busy || empty;
    this.skipButton.disabled = this.busy || (this.state !== null && this.state.total - this.state.done < 2);
    if (!this.state?.face) return;
    const kept: Kept = { person: this.state.person, face: this.state.face.number, elapsedMs: this.sheet.elapsedMs, strokes: [...this.sheet.strokes] };
    try {
      sessionStorage.setItem(kKept, JSON.stringify(kept));
    } catch {
      // A full store loses what a reload would restore, nothing else.
    }
  }
  private next(): void {
    const strokes = this.sheet.strokes;
    if (strokes.length === 0 || !this.state?.face) return;
    const seconds = Math.round(this.sheet.elapsedMs) / 1000;
    this.send("/api/collect/drawings", { face: this.state.face.number, width: this.sheet.width, seconds, strokes });
  }
  private send(path: string, body: unknown): void {
    if (this.busy) return;
    this.setBusy(true);
    this.api.post<State>(path, body).then(async (state) => {
      this.state = state;
      await this.showFace();
    }).catch((error) => this.page.fail(error)).finally(() => this.setBusy(false));
  }
  private setBusy(busy: boolean): void {
    this.busy = busy;
    this.layout.classList.toggle("busy", busy);
    this.changed();
  }
  private key(event: KeyboardEvent): void {
    const command = event.ctrlKey || event.metaKey;
    if (!command || !this.layout.isConnected || this.busy) return;
    if (event.key === "Enter") this.next();
    else if (event.key.toLowerCase() === "z" && this.sheet.canUndo) this.sheet.undo();
    else return;
    event.preventDefault();
  }
}
