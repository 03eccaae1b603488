// The paper: canvases one above the other, the pen's ring, and when they are drawn.
import type { Point } from "../api_types";
import { el } from "../dom";
import { drawInk, drawUnder, type PaperContent } from "./paper_drawing";
import { PaperPointer, type PointerHost } from "./paper_pointer";
import { PaperView } from "./paper_view";
import type { SheetFace } from "./sheet_face";

export interface PaperHost extends Omit<PointerHost, "toSheet" | "pan" | "zoomAt" | "hover"> {
  content(): PaperContent;
  /** The face below the ink in refinement mode. */
  face(): SheetFace | null;
  /** The pen is above the paper without drawing. */
  hovered(at: Point | null): void;
}

export class Paper {
  readonly element: HTMLElement;
  readonly view = new PaperView([512, 512]);
  readonly pointer: PaperPointer;
  private readonly under = el("canvas", { "aria-hidden": "true" });
  private readonly ink = el("canvas", { "aria-hidden": "true" });
  private readonly ring = el("div", { class: "paper-ring", hidden: true });
  private frame = 0;
  private underStale = true;
  private faceStale = true;
  private ringRadius = 0;
  private ringUnit: "sheet" | "screen" = "sheet";

  constructor(private readonly host: PaperHost) {
    this.element = el(
      "div",
      {
        class: "paper",
        tabindex: 0,
        role: "application",
        "aria-label": "Paper. Draw with a pen, a mouse or a finger. Plus and minus zoom, 0 shows all of it.",
      },
      this.under,
      this.ink,
      this.ring,
    );
    this.pointer = new PaperPointer(this.element, {
      toSheet: (x, y) => this.toSheet(x, y),
      begin: (sample, event) => host.begin(sample, event),
      extend: (samples, event) => host.extend(samples, event),
      end: (event) => host.end(event),
      cancel: () => host.cancel(),
      hover: (event) => this.hover(event),
      pan: (dx, dy) => this.moved(() => this.view.pan(dx, dy)),
      zoomAt: (x, y, factor) => {
        const box = this.element.getBoundingClientRect();
        this.moved(() => this.view.zoomAt(x - box.left, y - box.top, factor));
      },
    });
    new ResizeObserver(() => {
      this.view.resize(this.element.clientWidth, this.element.clientHeight);
      this.invalidate("all");
      this.draw();
    }).observe(this.element);
    document.addEventListener("themechange", () => this.invalidate("all"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.invalidate("all"));
  }

  /** Puts the canvas of the face between paper and ink. */
  addFace(canvas: HTMLCanvasElement): void {
    this.under.after(canvas);
  }
  setSheet(sheet: [number, number]): void {
    if (sheet[0] === this.view.sheet[0] && sheet[1] === this.view.sheet[1]) return;
    this.view.sheet = sheet;
    this.view.fit();
    this.invalidate("all");
  }
  fit(): void {
    this.moved(() => this.view.fit());
  }
  fitBox(box: readonly [number, number, number, number]): void {
    this.moved(() => this.view.fit(box));
  }
  zoom(factor: number): void {
    this.moved(() => this.view.zoomMiddle(factor));
  }
  /** A ring around the pen, whose radius is in pixels of the sheet or of the screen; 0: none. */
  setRing(radius: number, unit: "sheet" | "screen"): void {
    this.ringRadius = radius;
    this.ringUnit = unit;
    this.sizeRing();
  }

  toSheet(clientX: number, clientY: number): { x: number; y: number } {
    const box = this.element.getBoundingClientRect();
    return { x: (clientX - box.left - this.view.x) / this.view.zoom, y: (clientY - box.top - this.view.y) / this.view.zoom };
  }
  private moved(change: () => void): void {
    change();
    this.sizeRing();
    this.invalidate("all");
  }
  private sizeRing(): void {
    const size = Math.max(6, 2 * this.ringRadius * (this.ringUnit === "sheet" ? this.view.zoom : 1));
    this.ring.style.width = this.ring.style.height = `${size}px`;
  }
  private hover(event: PointerEvent | null): void {
    this.ring.hidden = event === null || this.ringRadius === 0;
    if (event) {
      const box = this.element.getBoundingClientRect();
      this.ring.style.left = `${event.clientX - box.left}px`;
      this.ring.style.top = `${event.clientY - box.top}px`;
      const at = this.toSheet(event.clientX, event.clientY);
      this.host.hovered([at.x, at.y]);
    } else {
      this.host.hovered(null);
    }
  }

  /** ink: lines alone; all: also paper and face. Drawn once, at the next frame of the browser. */
  invalidate(what: "ink" | "all"): void {
    if (what === "all") this.underStale = this.faceStale = true;
    if (this.frame !== 0) return;
    this.frame = requestAnimationFrame(() => this.draw());
  }
  private draw(): void {
    if (this.frame !== 0) cancelAnimationFrame(this.frame);
    this.frame = 0;
    const [width, height] = this.view.size;
    if (width < 2 || height < 2) return;
    const content = this.host.content();
    this.element.classList.toggle("with-face", content.faceBelow);
    if (this.underStale) drawUnder(prepare(this.under, width, height), this.view, content);
    this.underStale = false;
    const face = this.host.face();
    if (face) {
      face.canvas.hidden = !content.faceBelow;
      if (content.faceBelow && this.faceStale) face.draw(this.view);
    }
    this.faceStale = false;
    drawInk(prepare(this.ink, width, height), this.view, content);
  }
}

/** A cleared context in css pixels. */
function prepare(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D {
  const ratio = Math.min(2, devicePixelRatio);
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) throw new Error("This browser cannot draw.");
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return context;
}
