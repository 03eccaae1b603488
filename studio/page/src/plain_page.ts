// The frame of the modes that are not the studio: what is done of how much, one view, messages.
import { isAbort } from "./api";
import { el, iconButton } from "./dom";
import { Theme } from "./theme";

const kStore = "daumier-plain";
const kMessageMs = 8000;

export class PlainPage {
  readonly element: HTMLElement;
  private readonly view = el("main", { class: "plain-view", id: "workspace", tabindex: -1 });
  private readonly words = el("span", { class: "plain-progress" });
  private readonly bar = el("progress", { "aria-label": "Done", max: 1, value: 0 });
  private readonly messages = el("div", { class: "messages", role: "status", "aria-live": "polite" });

  constructor(title: string) {
    document.title = `${title} · Daumier studio`;
    const theme = new Theme({
      remember: (key, value) => localStorage.setItem(`${kStore}-${key}`, JSON.stringify(value)),
      recall: <T>(key: string, otherwise: T): T => {
        try {
          return (JSON.parse(localStorage.getItem(`${kStore}-${key}`) ?? "null") as T | null) ?? otherwise;
        } catch {
          return otherwise;
        }
      },
    });
    this.element = el("div", { class: "plain" },
      el("header", { class: "bar plain-bar" }, el("h1", { class: "brand" }, title), el("div", { class: "plain-done" }, this.bar, this.words),
        el("div", { class: "bar-actions" }, theme.button)),
      this.view, this.messages);
  }

  show(...content: HTMLElement[]): void {
    this.view.replaceChildren(...content);
  }
  /** A page of words with one button. */
  showCard(title: string, words: readonly string[], action?: { label: string; run: () => void }): void {
    const card = el("section", { class: "plain-card" }, el("h2", {}, title), ...words.map((each) => el("p", {}, each)));
    if (action) card.append(el("button", { type: "button", class: "primary", onclick: action.run }, action.label));
    this.show(card);
    card.querySelector("button")?.focus();
  }
  progress(done: number, total: number, place: string): void {
    this.bar.max = Math.max(1, total);
    this.bar.value = done;
    this.words.textContent = place;
  }
  say(message: string, kind: "info" | "error" = "info"): void {
    const box = el("div", { class: `message ${kind}` }, el("span", {}, message));
    box.append(iconButton("close", "Dismiss", () => box.remove()));
    this.messages.replaceChildren(box);
    if (kind !== "error") setTimeout(() => box.remove(), kMessageMs);
  }
  fail(error: unknown): void {
    if (isAbort(error)) return;
    console.error(error);
    this.say(error instanceof Error ? error.message : String(error), "error");
  }
}

/** Fetches a picture, whose address alone does not do: it needs the token too. */
export async function setPicture(image: HTMLImageElement, picture: Promise<Blob>): Promise<void> {
  const address = URL.createObjectURL(await picture);
  image.src = address;
  try {
    await image.decode();
  } finally {
    URL.revokeObjectURL(address);
  }
}
