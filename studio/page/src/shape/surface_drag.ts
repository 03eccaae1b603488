// Handles on the surface: a press picks a vertex or a dot, a drag moves it in the plane of the view.
import type { Viewer } from "../viewer";
import type { Handle } from "./document";

/** Pixels within which a press takes a dot that is there. */
const kReach = { mouse: 12, touch: 24 };
/** Centimetres between a dot and the surface in front of it at which the dot is hidden. */
const kHidden = 1;

export interface SurfaceDragOptions {
  handles(): readonly Handle[];
  change(handles: Handle[], vertex: number, done: boolean): void;
}

export class SurfaceDrag {
  private picking = false;
  private chosen: number | null = null;

  constructor(private readonly viewer: Viewer, private readonly options: SurfaceDragOptions) {}

  /** The view is this tab's: dots are shown and taken by presses. */
  attach(): void {
    this.viewer.onPointerDown((event) => this.press(event));
    this.show();
  }
  detach(): void {
    this.viewer.onPointerDown(null);
    this.viewer.setHandles([]);
    this.viewer.stageElement.style.cursor = "";
  }
  setPicking(on: boolean): void {
    this.picking = on;
    this.viewer.stageElement.style.cursor = on ? "crosshair" : "";
  }
  /** Marks one handle, by its place in the list. */
  choose(at: number | null): void {
    this.chosen = at === null ? null : (this.options.handles()[at]?.vertex ?? null);
    this.show();
  }
  show(): void {
    const vertices = this.options.handles().map((handle) => handle.vertex);
    const chosen = this.chosen !== null && vertices.includes(this.chosen) ? this.chosen : null;
    this.viewer.setHandles(vertices, chosen);
  }

  private press(event: PointerEvent): boolean {
    if (event.button !== 0 || event.shiftKey) return false;
    const dot = this.dotAt(event);
    const vertex = dot ?? (this.picking ? this.viewer.pick(event.clientX, event.clientY) : null);
    if (vertex === null) return false;
    this.drag(vertex, event);
    return true;
  }

  private dotAt(event: PointerEvent): number | null {
    const reach = event.pointerType === "touch" ? kReach.touch : kReach.mouse;
    let best: number | null = null;
    let least = reach;
    for (const { vertex } of this.options.handles()) {
      const at = this.viewer.locate(vertex);
      const distance = Math.hypot(at.x - event.clientX, at.y - event.clientY);
      if (distance >= least || this.isHidden(vertex, at)) continue;
      least = distance;
      best = vertex;
    }
    return best;
  }
  private isHidden(vertex: number, at: { x: number; y: number }): boolean {
    const front = this.viewer.pick(at.x, at.y);
    if (front === null) return false;
    const p = this.viewer.vertices;
    const of = (v: number, k: number) => p[3 * v + k] ?? 0;
    return Math.hypot(of(front, 0) - of(vertex, 0), of(front, 1) - of(vertex, 1), of(front, 2) - of(vertex, 2)) > kHidden;
  }

  private drag(vertex: number, down: PointerEvent): void {
    const stage = this.viewer.stageElement;
    stage.setPointerCapture(down.pointerId);
    this.chosen = vertex;
    const begin = this.options.handles().find((handle) => handle.vertex === vertex)?.move ?? [0, 0, 0];
    const to = (event: PointerEvent, done: boolean) => {
      const by = this.viewer.moveOf(vertex, event.clientX - down.clientX, event.clientY - down.clientY);
      const move: Handle["move"] = [begin[0] + by[0], begin[1] + by[1], begin[2] + by[2]].map((each) => Math.round(each * 1000) / 1000) as Handle["move"];
      this.options.change([...this.options.handles().filter((handle) => handle.vertex !== vertex), { vertex, move }].sort((a, b) => a.vertex - b.vertex), vertex, done);
    };
    const moved = (event: PointerEvent) => {
      if (event.pointerId === down.pointerId) to(event, false);
    };
    const ended = (event: PointerEvent) => {
      if (event.pointerId !== down.pointerId) return;
      stage.removeEventListener("pointermove", moved);
      stage.removeEventListener("pointerup", ended);
      stage.removeEventListener("pointercancel", ended);
      if (event.type === "pointerup") to(event, true);
    };
    stage.addEventListener("pointermove", moved);
    stage.addEventListener("pointerup", ended);
    stage.addEventListener("pointercancel", ended);
    to(down, false);
  }
}
