// Turning, moving and scaling of a view by pointer, touch, wheel and keys. A view has yaw and pitch in degrees as the server has them:
// [0, 0] is the front, [-90, 0] the face's own right side.
export interface OrbitPose {
  yaw: number;
  pitch: number;
  /** 1: the head fills the view. */
  zoom: number;
  /** In half heights of the view. */
  pan: [number, number];
}

/** Degrees of half a turn for a pointer that crosses the view. */
const kTurn = 180;
const kGreatestPitch = 85;

export class Orbit {
  pose: OrbitPose = { yaw: 0, pitch: 0, zoom: 1, pan: [0, 0] };
  /** A pointer that a tab takes (a handle that is dragged) does not turn the view. */
  take: ((event: PointerEvent) => boolean) | null = null;
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private spread = 0;

  constructor(
    private readonly element: HTMLElement,
    private readonly changed: () => void,
  ) {
    element.addEventListener("pointerdown", (event) => this.down(event));
    element.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
      element.addEventListener(name, (event) => {
        this.pointers.delete(event.pointerId);
        this.spread = 0;
      });
    }
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.scale(Math.exp(-0.0015 * event.deltaY));
      },
      { passive: false },
    );
    element.addEventListener("keydown", (event) => this.key(event));
  }

  turn(yaw: number, pitch: number): void {
    this.pose.yaw = ((this.pose.yaw + yaw + 540) % 360) - 180;
    this.pose.pitch = Math.min(kGreatestPitch, Math.max(-kGreatestPitch, this.pose.pitch + pitch));
    this.changed();
  }
  scale(factor: number): void {
    this.pose.zoom = Math.min(12, Math.max(0.4, this.pose.zoom * factor));
    this.changed();
  }
  set(yaw: number, pitch: number): void {
    this.pose = { yaw, pitch, zoom: 1, pan: [0, 0] };
    this.changed();
  }

  private shift(x: number, y: number): void {
    const half = this.element.clientHeight / 2 || 1;
    this.pose.pan = [this.pose.pan[0] + x / half, this.pose.pan[1] + y / half];
    this.changed();
  }
  private down(event: PointerEvent): void {
    if (this.take?.(event)) return;
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  }
  private move(event: PointerEvent): void {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const x = event.clientX - last.x;
    const y = event.clientY - last.y;
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.pointers.size === 2) {
      const [a, b] = [...this.pointers.values()];
      if (!a || !b) return;
      const spread = Math.hypot(a.x - b.x, a.y - b.y);
      if (this.spread > 0) this.scale(spread / this.spread);
      this.spread = spread;
      this.shift(x / 2, y / 2);
    } else if (event.shiftKey || (event.buttons & 6) !== 0) {
      this.shift(x, y);
    } else {
      const size = Math.min(this.element.clientWidth, this.element.clientHeight) || 1;
      this.turn((-kTurn * x) / size, (kTurn * y) / size);
    }
  }
  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? 15 : 5;
    const used = true;
    if (event.key === "ArrowLeft") this.turn(-step, 0);
    else if (event.key === "ArrowRight") this.turn(step, 0);
    else if (event.key === "ArrowUp") this.turn(0, step);
    else if (event.key === "ArrowDown") this.turn(0, -step);
    else if (event.key === "+" || event.key === "=") this.scale(1.15);
    else if (event.key === "-") this.scale(1 / 1.15);
    else if (event.key === "0" || event.key === "Home") this.set(0, 0);
    else return;
    if (used) {
      event.preventDefault();
      event.stopPropagation();
    }
  }
}
