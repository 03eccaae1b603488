// The frame of the page: the bar of tabs, messages, undo, theme, help and files dropped anywhere.
import { type Api, ApiError, isAbort } from "./api";
import type { Face } from "./api_types";
import { el, iconButton, sentence } from "./dom";
import { Tray, type TrayOwner } from "./face_tray";
import { makeHelp } from "./help";
import type { Studio, Subject, Tab } from "./tab";
import { Theme } from "./theme";
import { Viewer } from "./viewer";

const kStore = "daumier-studio";
const kMessageMs = 4000;
const kMsPerLetter = 50;

export class StudioPage implements Studio, TrayOwner {
  readonly viewer = new Viewer();
  readonly faces: Tray;
  readonly element: HTMLElement;
  private readonly tabs: Tab[] = [];
  private current: Tab | null = null;
  private readonly bar = el("div", { class: "tabs", role: "tablist", "aria-label": "Steps" });
  private readonly panel = el("div", { class: "panel" });
  private readonly messages = el("div", { class: "messages", role: "status", "aria-live": "polite" });
  private readonly undoButton: HTMLButtonElement;
  private readonly redoButton: HTMLButtonElement;
  private readonly help = makeHelp();
  private readonly store: Record<string, unknown>;
  private subjectValue: Subject | null = null;

  constructor(readonly api: Api) {
    this.store = this.readStore();
    this.faces = new Tray(this);
    this.viewer.second.set(this.recall("view.second", false));
    this.viewer.second.onToggle = (on) => this.remember("view.second", on);
    const theme = new Theme(this);
    this.undoButton = iconButton("undo", "Undo", () => this.current?.undo?.(), "Ctrl+Z");
    this.redoButton = iconButton("redo", "Redo", () => this.current?.redo?.(), "Ctrl+Shift+Z");
    this.element = el(
      "div",
      { class: "studio" },
      el(
        "header",
        { class: "bar" },
        el("h1", { class: "brand" }, "Daumier", el("span", {}, " studio")),
        this.bar,
        el(
          "div",
          { class: "bar-actions" },
          this.undoButton,
          this.redoButton,
          theme.button,
          iconButton("help", "Help", () => this.showHelp(), "?"),
        ),
      ),
      el("main", { class: "workspace", id: "workspace", tabindex: -1 }, this.panel, this.viewer.element),
      this.faces.element,
      this.messages,
      this.help,
    );
    document.addEventListener("keydown", (event) => this.key(event));
    this.acceptFiles();
  }

  get subject(): Subject | null {
    return this.subjectValue;
  }
  set subject(subject: Subject | null) {
    this.subjectValue = subject;
    this.faces.update();
  }

  add(tab: Tab): void {
    this.tabs.push(tab);
    tab.element.id = `panel-${tab.id}`;
    tab.element.setAttribute("role", "tabpanel");
    tab.element.setAttribute("aria-labelledby", `tab-${tab.id}`);
    tab.element.hidden = true;
    this.panel.append(tab.element);
    this.bar.append(
      el(
        "button",
        {
          type: "button",
          role: "tab",
          id: `tab-${tab.id}`,
          "aria-controls": `panel-${tab.id}`,
          "aria-selected": "false",
          tabindex: -1,
          onclick: () => this.open(tab.id),
          onkeydown: (event) => {
            const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
            if (step === 0) return;
            event.preventDefault();
            const next = this.tabs[(this.tabs.indexOf(tab) + step + this.tabs.length) % this.tabs.length];
            if (!next) return;
            this.open(next.id);
            document.getElementById(`tab-${next.id}`)?.focus();
          },
        },
        tab.title,
      ),
    );
  }

  open(id: Tab["id"]): void {
    const next = this.tabs.find((tab) => tab.id === id);
    if (!next || next === this.current) return;
    if (this.current) {
      this.current.hide();
      this.current.element.hidden = true;
    }
    this.current = next;
    next.element.hidden = false;
    this.element.dataset["tab"] = id;
    for (const tab of this.tabs) {
      const handle = document.getElementById(`tab-${tab.id}`);
      handle?.setAttribute("aria-selected", String(tab === next));
      handle?.setAttribute("tabindex", tab === next ? "0" : "-1");
    }
    this.viewer.onPointerDown(null);
    this.viewer.setHandles([]);
    this.remember("tab", id);
    this.refresh();
    Promise.resolve(next.show()).then(
      () => this.refresh(),
      (error) => this.fail(error),
    );
  }

  refresh(): void {
    const tab = this.current;
    this.undoButton.disabled = !(tab?.undo && (tab.canUndo?.() ?? true));
    this.redoButton.disabled = !(tab?.redo && (tab.canRedo?.() ?? true));
    this.faces.update();
  }
  whyNoPin(): string | null {
    const no = this.current?.whyNoPin?.() ?? null;
    if (no !== null) return no;
    if (this.subject === null) return "There is no face to pin yet. Draw one, or open Shape.";
    return this.subject.kind === "face" ? "This face is pinned already." : null;
  }
  faceAction(): { label: string; use: (face: Face) => void } | null {
    const tab = this.current;
    if (!tab?.useFace) return null;
    return {
      label: tab.useFaceLabel ?? "Use",
      use: (face) => void Promise.resolve(tab.useFace?.(face)).catch((error) => this.fail(error)),
    };
  }

  say(message: string, kind: "info" | "warning" | "error" = "info"): void {
    for (const shown of this.messages.querySelectorAll(".message")) if (shown.firstChild?.textContent === message) shown.remove();
    const box = el("div", { class: `message ${kind}` }, el("span", {}, message));
    box.append(iconButton("close", "Dismiss", () => box.remove()));
    this.messages.append(box);
    // An error stays until it is dismissed.
    if (kind !== "error") setTimeout(() => box.remove(), kMessageMs + kMsPerLetter * message.length);
    while (this.messages.children.length > 4) this.messages.firstElementChild?.remove();
  }
  fail(error: unknown): void {
    if (isAbort(error)) return;
    // A refused request is a slip of a person, all else a failure of the program.
    const isRefused = error instanceof ApiError && error.status >= 400 && error.status < 500 && error.status !== 401;
    if (!isRefused) console.error(error);
    this.say(sentence(error instanceof Error ? error.message : String(error)), isRefused ? "warning" : "error");
  }

  private readStore(): Record<string, unknown> {
    try {
      return JSON.parse(localStorage.getItem(kStore) ?? "{}") as Record<string, unknown>;
    } catch {
      return {};
    }
  }
  remember(key: string, value: unknown): void {
    this.store[key] = value;
    try {
      localStorage.setItem(kStore, JSON.stringify(this.store));
    } catch {
      // A full or forbidden store loses the memory of a reload, nothing else.
    }
  }
  recall<T>(key: string, otherwise: T): T {
    return key in this.store ? (this.store[key] as T) : otherwise;
  }

  private showHelp(): void {
    this.help.showModal();
  }
  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement | null;
    const typing =
      target instanceof HTMLTextAreaElement ||
      target instanceof HTMLSelectElement ||
      (target instanceof HTMLInputElement && !["checkbox", "radio", "range", "button"].includes(target.type)) ||
      Boolean(target?.isContentEditable);
    // Arrows move a slider or the choice of a group that has the focus.
    const moves = target instanceof HTMLInputElement && /^(Arrow|Home|End|Page| )/.test(event.key);
    if (typing || moves || event.defaultPrevented || document.querySelector("dialog[open]")) return;
    const command = event.ctrlKey || event.metaKey;
    if (command && !event.altKey && event.key.toLowerCase() === "z") {
      event.preventDefault();
      if (event.shiftKey) this.current?.redo?.();
      else this.current?.undo?.();
    } else if (command && event.key.toLowerCase() === "y") {
      event.preventDefault();
      this.current?.redo?.();
    } else if (event.key === "?" && !command) {
      this.showHelp();
    } else if (!command && this.current?.key?.(event)) {
      event.preventDefault();
    }
  }

  private acceptFiles(): void {
    const over = (event: DragEvent, on: boolean) => {
      if (!event.dataTransfer?.types.includes("Files")) return;
      event.preventDefault();
      this.element.classList.toggle("dropping", on);
    };
    addEventListener("dragover", (event) => over(event, true));
    addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) over(event, false);
    });
    addEventListener("drop", (event) => {
      over(event, false);
      for (const file of event.dataTransfer?.files ?? []) void this.takeFile(file);
    });
  }
  /** The shown tab first, then the others in order. */
  private async takeFile(file: File): Promise<void> {
    const order = [this.current, ...this.tabs.filter((tab) => tab !== this.current)];
    try {
      for (const tab of order) if (tab?.drop && (await tab.drop(file))) return;
      this.say(`No part of the studio reads ${file.name}. Drop a picture of a face or of a drawing, or a clip.`, "warning");
    } catch (error) {
      this.fail(error);
    }
  }
}
