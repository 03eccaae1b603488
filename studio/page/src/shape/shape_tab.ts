// The tab Shape: a panel of sliders and the surface of the face, both of which change one document.
import type { SessionEntry, Shape, ShapeInfo } from "../api_types";
import { el } from "../dom";
import type { Studio, Tab } from "../tab";
import { button, icon } from "../widgets";
import { controlsPart, type Memory } from "./controls_part";
import { isPlain, tidy } from "./document";
import type { Editor, Part } from "./editor";
import { expressionsPart, type Stored } from "./expressions_part";
import { handlesPart } from "./handles_part";
import { History, type HistoryState } from "../history";
import { Latest } from "./latest";
import { SurfaceDrag } from "./surface_drag";
import { wholePart, type WholePart } from "./whole_part";

const kBusyMs = 400;

export function createShapeTab(studio: Studio): Tab {
  return new ShapeTab(studio);
}

class ShapeTab implements Tab, Editor {
  readonly id = "shape";
  readonly title = "Shape";
  readonly useFaceLabel = "Begin with";
  readonly element = el("div", { class: "p-panel p-shape" });
  private readonly history: History<Shape>;
  private readonly latest: Latest<Shape, Float32Array | null>;
  private readonly surface: SurfaceDrag;
  private readonly offer = el("div", { class: "p-offer", hidden: true });
  private parts: Part[] = [];
  private whole: WholePart | null = null;
  private shown = false;
  private sessions: SessionEntry[] = [];
  private busyTimer = 0;
  private stopPicking = () => {};

  constructor(private readonly studio: Studio) {
    this.history = new History(studio.recall<HistoryState<Shape>>("shape.history", { past: [], present: { base: "mean" }, future: [] }));
    this.latest = new Latest(
      (shape) => studio.api.shapeVertices(shape),
      (vertices) => {
        if (!this.shown || !vertices) return;
        studio.viewer.setVertices(vertices);
        this.surface.show();
      },
      (error) => studio.fail(error),
      (busy) => this.showBusy(busy),
    );
    this.surface = new SurfaceDrag(studio.viewer, {
      handles: () => this.document.handles ?? [],
      change: (handles, vertex, done) => this.change({ handles }, `handle ${vertex}`, done),
    });
    studio.faces.onChange(() => this.offerFaces());
  }

  get document(): Shape {
    return this.history.present;
  }
  change(fields: Partial<Shape>, what: string, done: boolean): void {
    this.history.change(tidy({ ...this.document, ...fields }), what, done);
    this.changed(done);
  }
  undo(): void {
    if (this.history.undo()) this.changed(true);
  }
  redo(): void {
    if (this.history.redo()) this.changed(true);
  }
  canUndo(): boolean {
    return this.history.canUndo;
  }
  canRedo(): boolean {
    return this.history.canRedo;
  }
  useFace(face: { id: string }): void {
    this.change({ base: face.id }, "base", true);
  }
  key(event: KeyboardEvent): boolean {
    if (event.key === "Escape") this.stopPicking();
    return event.key === "Escape";
  }

  async show(): Promise<void> {
    this.shown = true;
    this.surface.attach();
    if (!this.whole) await this.build();
    // What became stale while another tab was shown.
    this.sessions = await this.studio.api.sessions().catch(() => this.sessions);
    if (!this.shown) return;
    this.offerFaces();
    this.offerSubject();
    this.changed(true);
  }
  hide(): void {
    this.shown = false;
    this.stopPicking();
    this.surface.detach();
  }

  private async build(): Promise<void> {
    this.element.replaceChildren(el("p", { class: "p-state" }, "Loading the controls …"));
    let info: ShapeInfo;
    try {
      info = await this.studio.api.shapeInfo();
    } catch (error) {
      const message = error instanceof Error ? error.message : String(error);
      const again = button("Try again", () => void this.show().catch((reason) => this.studio.fail(reason)));
      this.element.replaceChildren(el("div", { class: "p-state p-error" }, el("p", {}, message), again));
      throw error;
    }
    const folded = this.memory("shape.folded");
    const unlinked = this.memory("shape.unlinked");
    this.whole = wholePart(info, this, folded, (random) => void this.roll(random.seed, random.spread));
    const handles = handlesPart(this, folded, (on) => this.pick(on), (at) => this.surface.choose(at));
    this.stopPicking = () => {
      this.surface.setPicking(false);
      handles.setPicking(false);
    };
    const expressions = expressionsPart(info, this, folded, unlinked, {
      all: () => this.studio.recall<Stored[]>("shape.expressions", []),
      keep: (stored) => this.studio.remember("shape.expressions", stored),
    });
    this.parts = [this.whole, handles, expressions, ...controlsPart(info, this, folded, unlinked)];

    const nothing = el("p", { class: "p-state", hidden: true, role: "status" }, "No slider has this name.");
    const search = el("input", { type: "search", class: "p-text", placeholder: "Find a slider", "aria-label": "Find a slider" });
    search.addEventListener("input", () => {
      const found = this.parts.map((part) => part.search?.(search.value.trim()) ?? true).some(Boolean);
      nothing.hidden = found;
      for (const part of this.parts) part.show(this.document);
    });
    search.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      search.value = "";
      search.dispatchEvent(new Event("input"));
    });
    const reset = button("Reset", () => this.reset(), { icon: "reset", title: "Back to the face that it began with" });
    const bar = el("div", { class: "p-bar" }, el("div", { class: "p-search" }, icon("search"), search), reset);
    const quick = el("div", { class: "p-row p-quick" }, this.whole.random, handles.picking);
    const list = el("div", { class: "p-scroll" }, this.offer, quick, ...this.parts.map((part) => part.element), nothing);
    this.element.replaceChildren(bar, list);
  }

  /** Shows the document and requests its face. */
  private changed(done: boolean): void {
    for (const part of this.parts) part.show(this.document);
    if (this.shown) {
      this.surface.show();
      this.latest.request(this.document);
    }
    if (!done) return;
    this.studio.remember("shape.history", this.history.all);
    this.takeSubject();
    this.studio.refresh();
  }
  /** A shape that is its base alone stays the drawing or the pinned face that a person worked on. */
  private takeSubject(): void {
    if (isPlain(this.document) && this.subjectId() === this.document.base) return;
    this.studio.subject = { kind: "shape", title: "Shape", body: { shape: this.document } };
  }
  private subjectId(): string | null {
    const body = this.studio.subject?.body;
    return body && "session" in body ? body.session : body && "face" in body ? body.face : null;
  }

  private reset(): void {
    const { base } = this.document;
    if (isPlain(this.document)) {
      this.studio.say("The face is as it began.");
      return;
    }
    this.history.change({ base }, "reset", true);
    this.changed(true);
  }
  private pick(on: boolean): void {
    this.surface.setPicking(on);
    for (const part of this.parts) part.show(this.document);
  }
  private async roll(seed: number, spread: number): Promise<void> {
    try {
      const { controls } = await this.studio.api.randomShape(seed, spread);
      this.change({ controls }, "random", true);
    } catch (error) {
      this.studio.fail(error);
    }
  }

  private offerFaces(): void {
    this.whole?.offer(this.studio.faces.faces, this.sessions);
  }
  /** A drawing or a pinned face that a person comes from: taken where nothing would be lost, otherwise offered. */
  private offerSubject(): void {
    const id = this.subjectId();
    this.offer.hidden = true;
    if (id === null || id === this.document.base) return;
    if (isPlain(this.document)) {
      this.history.change({ base: id }, "base", true);
      return;
    }
    const title = this.studio.subject?.title ?? "the drawing";
    const close = () => {
      this.offer.hidden = true;
    };
    const begin = button(`Begin with ${title}`, () => {
      this.change({ base: id }, "base", true);
      close();
    });
    this.offer.replaceChildren(
      el("p", {}, `This shape began with another face than ${title}.`),
      el("div", { class: "p-row" }, begin, button("Keep it", close, { kind: "quiet" })),
    );
    this.offer.hidden = false;
  }

  private showBusy(busy: boolean): void {
    clearTimeout(this.busyTimer);
    this.element.setAttribute("aria-busy", String(busy));
    if (busy) this.busyTimer = window.setTimeout(() => this.shown && this.studio.viewer.say("Working …"), kBusyMs);
    else if (this.shown) this.studio.viewer.say(null);
  }
  private memory(key: string): Memory {
    const values = this.studio.recall<Record<string, boolean>>(key, {});
    return {
      get: (name) => values[name],
      set: (name, value) => {
        values[name] = value;
        this.studio.remember(key, values);
      },
    };
  }
}
