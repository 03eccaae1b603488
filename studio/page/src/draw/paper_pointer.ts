// Pointers over the paper: strokes of pen, mouse or finger; two fingers, space or the middle button move it; the wheel zooms.
import type { Sample } from "./stroke_path";

export interface PointerHost {
  /** Sheet pixels of a place of the window. */
  toSheet(clientX: number, clientY: number): { x: number; y: number };
  begin(sample: Sample, event: PointerEvent): void;
  extend(samples: Sample[], event: PointerEvent): void;
  end(event: PointerEvent): void;
  cancel(): void;
  hover(event: PointerEvent | null): void;
  pan(dx: number, dy: number): void;
  zoomAt(clientX: number, clientY: number, factor: number): void;
}

type Drag = { kind: "stroke"; id: number } | { kind: "pan"; id: number; x: number; y: number } | null;

export class PaperPointer {
  /** The space bar is down. */
  panning = false;
  private drag: Drag = null;
  private readonly touches = new Map<number, { x: number; y: number }>();
  /** After a pen was seen, one finger moves the paper: a resting hand does not draw. */
  private penSeen = false;
  private began = 0;

  constructor(
    private readonly element: HTMLElement,
    private readonly host: PointerHost,
  ) {
    element.addEventListener("pointerdown", (event) => this.down(event));
    element.addEventListener("pointermove", (event) => this.move(event));
    element.addEventListener("pointerup", (event) => this.up(event, false));
    element.addEventListener("pointercancel", (event) => this.up(event, true));
    element.addEventListener("pointerleave", () => this.host.hover(null));
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        if (event.ctrlKey || event.deltaMode !== 0 || Math.abs(event.deltaX) < 1)
          this.host.zoomAt(event.clientX, event.clientY, Math.exp(-0.0016 * event.deltaY));
        else this.host.pan(-event.deltaX, -event.deltaY);
      },
      { passive: false },
    );
  }

  get drawing(): boolean {
    return this.drag?.kind === "stroke";
  }

  private sample(event: PointerEvent): Sample {
    return { ...this.host.toSheet(event.clientX, event.clientY), pressure: event.pointerType === "pen" ? event.pressure : 1 };
  }
  private down(event: PointerEvent): void {
    // Keeps the focus where keys reach the tab, and text unselected.
    event.preventDefault();
    this.element.focus({ preventScroll: true });
    this.element.setPointerCapture(event.pointerId);
    if (event.pointerType === "pen") this.penSeen = true;
    if (event.pointerType === "touch") {
      this.touches.set(event.pointerId, { x: event.clientX, y: event.clientY });
      if (this.touches.size === 2) {
        // The first finger of two has not meant a stroke.
        if (this.drag?.kind === "stroke") this.host.cancel();
        this.drag = null;
        return;
      }
      if (this.touches.size > 2) return;
    }
    if (this.drag) return;
    const pans = this.panning || event.button === 1 || (event.pointerType === "touch" && this.penSeen);
    if (pans) {
      this.drag = { kind: "pan", id: event.pointerId, x: event.clientX, y: event.clientY };
      return;
    }
    if (event.button > 2) return;
    this.drag = { kind: "stroke", id: event.pointerId };
    this.began = performance.now();
    this.host.begin(this.sample(event), event);
  }
  private move(event: PointerEvent): void {
    const touch = this.touches.get(event.pointerId);
    if (touch && this.touches.size >= 2) {
      this.pinch(event, touch);
      return;
    }
    if (touch) this.touches.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.drag?.id === event.pointerId) {
      if (this.drag.kind === "pan") {
        this.host.pan(event.clientX - this.drag.x, event.clientY - this.drag.y);
        this.drag.x = event.clientX;
        this.drag.y = event.clientY;
      } else {
        const events = event.getCoalescedEvents();
        this.host.extend(
          (events.length > 0 ? events : [event]).map((each) => this.sample(each)),
          event,
        );
      }
    }
    if (event.pointerType !== "touch") this.host.hover(event);
  }
  private pinch(event: PointerEvent, last: { x: number; y: number }): void {
    const other = [...this.touches].find(([id]) => id !== event.pointerId)?.[1];
    if (!other) return;
    const before = Math.hypot(last.x - other.x, last.y - other.y);
    const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
    this.host.pan((event.clientX - last.x) / 2, (event.clientY - last.y) / 2);
    if (before > 10 && after > 10) this.host.zoomAt((event.clientX + other.x) / 2, (event.clientY + other.y) / 2, after / before);
    this.touches.set(event.pointerId, { x: event.clientX, y: event.clientY });
  }
  private up(event: PointerEvent, cancelled: boolean): void {
    this.touches.delete(event.pointerId);
    if (this.drag?.id !== event.pointerId) return;
    const drag = this.drag;
    this.drag = null;
    if (drag.kind !== "stroke") return;
    // A tap of a finger that ends at once is the first of two more often than a dot.
    if (cancelled || (event.pointerType === "touch" && performance.now() - this.began < 40)) this.host.cancel();
    else this.host.end(event);
  }
}
