// The blank sheet under the pen.
import type { Point } from "../api_types";
import { el } from "../dom";
import { addSample, newStroke, StrokeHistory, type PenStroke } from "./pen_stroke";

const kInk = "#22262a";

export class Sheet {
  readonly element: HTMLElement;
  private readonly canvas = el("canvas", { "aria-hidden": "true" });
  private history = new StrokeHistory();
  private stroke: PenStroke | null = null;
  private pointer = -1;
  /** After a pen was seen, a resting hand does not draw. */
  private penSeen = false;
  private shownAt = performance.now();

  /** width: of the pen, sheet pixels. */
  constructor(private readonly side: number, readonly width: number, private readonly changed: () => void) {
    this.element = el("div", { class: "sheet", role: "img", "aria-label": "Blank sheet. Draw on it with a pen, a mouse or a finger." }, this.canvas);
    this.element.addEventListener("pointerdown", (event) => this.down(event));
    this.element.addEventListener("pointermove", (event) => this.move(event));
    this.element.addEventListener("pointerup", (event) => this.up(event, true));
    this.element.addEventListener("pointercancel", (event) => this.up(event, false));
    this.element.addEventListener("contextmenu", (event) => event.preventDefault());
    new ResizeObserver(() => this.redraw()).observe(this.element);
  }

  /** A new sheet, or one on which a person began to draw some time ago. */
  show(strokes: PenStroke[] = [], elapsedMs = 0): void {
    this.history = new StrokeHistory(strokes);
    this.stroke = null;
    this.shownAt = performance.now() - elapsedMs;
    this.redraw();
    this.changed();
  }
  get strokes(): readonly PenStroke[] {
    return this.history.strokes;
  }
  get canUndo(): boolean {
    return this.history.canUndo;
  }
  get elapsedMs(): number {
    return performance.now() - this.shownAt;
  }
  undo(): void {
    this.history.undo();
    this.redraw();
    this.changed();
  }
  clear(): void {
    this.history.clear();
    this.redraw();
    this.changed();
  }

  private add(event: PointerEvent): boolean {
    if (!this.stroke) return false;
    const box = this.canvas.getBoundingClientRect();
    const scale = this.side / box.width;
    return addSample(this.stroke, (event.clientX - box.left) * scale, (event.clientY - box.top) * scale, event.timeStamp - this.shownAt,
      event.pointerType === "pen" ? event.pressure : 1);
  }
  private down(event: PointerEvent): void {
    event.preventDefault();
    if (event.pointerType === "pen") this.penSeen = true;
    if (this.stroke || event.button !== 0 || (event.pointerType === "touch" && this.penSeen)) return;
    this.element.setPointerCapture(event.pointerId);
    this.pointer = event.pointerId;
    this.stroke = newStroke();
    this.add(event);
    this.drawFrom(this.stroke, 0);
  }
  private move(event: PointerEvent): void {
    if (!this.stroke || event.pointerId !== this.pointer) return;
    const first = this.stroke.points.length - 1;
    const events = event.getCoalescedEvents();
    let added = false;
    for (const each of events.length > 0 ? events : [event]) added = this.add(each) || added;
    if (added) this.drawFrom(this.stroke, Math.max(0, first));
  }
  private up(event: PointerEvent, kept: boolean): void {
    if (!this.stroke || event.pointerId !== this.pointer) return;
    const stroke = this.stroke;
    this.stroke = null;
    if (kept) this.history.add(stroke);
    else this.redraw();
    this.changed();
  }

  private redraw(): void {
    const size = Math.round(this.element.clientWidth * devicePixelRatio);
    if (size === 0) return;
    this.canvas.width = size;
    this.canvas.height = size;
    for (const stroke of this.history.strokes) this.drawFrom(stroke, 0);
    if (this.stroke) this.drawFrom(this.stroke, 0);
  }
  private drawFrom(stroke: PenStroke, first: number): void {
    const context = this.canvas.getContext("2d");
    if (!context) return;
    const scale = this.canvas.width / this.side;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.strokeStyle = kInk;
    context.lineCap = "round";
    for (let i = first; i < stroke.points.length; ++i) {
      const from: Point | undefined = stroke.points[Math.max(first, i - 1)];
      const to = stroke.points[i];
      if (!from || !to) continue;
      context.lineWidth = this.width * (0.4 + 0.6 * (stroke.pressures[i] ?? 1));
      context.beginPath();
      context.moveTo(...from);
      context.lineTo(...to);
      context.stroke();
    }
  }
}
