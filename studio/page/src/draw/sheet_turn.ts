// From where the sheet sees the face: the view of refinement mode, and the middle of the face for the mirror.
import type { Api } from "../api";
import type { SessionState, View } from "../api_types";
import type { Viewer } from "../viewer";
import type { Paper } from "./paper";
import { SheetFace } from "./sheet_face";

export interface TurnHost {
  readonly api: Api;
  readonly viewer: Viewer;
  readonly state: SessionState | null;
  readonly paper: Paper;
  /** Degrees about the vertical, of a new view. */
  turned(yaw: number): void;
  fail(error: unknown): void;
}

const kGreatestPitch = 85;

export class SheetTurn {
  view: View = [0, 0];
  /** x of the mirror, sheet pixels. */
  mirrorAxis = 256;
  face: SheetFace | null = null;
  private request: AbortController | null = null;
  private drag: { x: number; y: number; view: View } | null = null;
  private unfitted = false;
  /** What has yet to arrive of the drawing and its mode: a fit before that is of an earlier face. */
  private readonly missing = new Set<"camera" | "vertices">();

  constructor(private readonly host: TurnHost) {
    host.viewer.whenHead(() => this.verticesChanged());
  }

  get turning(): boolean {
    return this.drag !== null;
  }
  beginDrag(event: PointerEvent): void {
    this.drag = { x: event.clientX, y: event.clientY, view: this.view };
  }
  moveDrag(event: PointerEvent): void {
    if (!this.drag) return;
    const size = Math.min(...this.host.paper.view.size);
    this.look([
      this.drag.view[0] - (180 * (event.clientX - this.drag.x)) / size,
      this.drag.view[1] + (180 * (event.clientY - this.drag.y)) / size,
    ]);
  }
  endDrag(): void {
    this.drag = null;
  }
  look(view: View): void {
    this.view = [((view[0] + 540) % 360) - 180, Math.min(kGreatestPitch, Math.max(-kGreatestPitch, view[1]))];
    this.host.turned(this.view[0]);
    void this.update();
  }
  /** A key that turns the face; false: another key. */
  key(event: KeyboardEvent): boolean {
    const turns: Record<string, View> = { ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5] };
    const turn = turns[event.key];
    if (turn) this.look([this.view[0] + turn[0], this.view[1] + turn[1]]);
    return turn !== undefined;
  }

  /** The mode is new. */
  modeChanged(state: SessionState, before: SessionState["mode"] | null): void {
    this.unfitted = state.mode === "refine";
    if (this.unfitted) {
      this.missing.add("camera").add("vertices");
      // The paper shows the front: the other view shows more.
      this.host.viewer.lookFrom("three-quarter");
    }
    if (before === "refine") this.host.paper.fit();
    if (state.mode === "draw") this.mirrorAxis = state.sheet[0] / 2;
    else void this.update();
  }
  /** All of the sheet, or of the face that lies in its place. */
  fit(): void {
    const isRefined = this.host.state?.mode === "refine";
    const box = isRefined ? this.face?.box() : null;
    this.unfitted = isRefined && (!box || this.missing.size > 0);
    if (box) this.host.paper.fitBox(box);
    else this.host.paper.fit();
  }
  /** Fits the face once it has arrived in its mode. */
  verticesChanged(): void {
    if (this.host.viewer.hasFace) this.missing.delete("vertices");
    if (this.unfitted && this.face?.hasCamera) this.fit();
    if (this.host.state?.mode === "refine") this.host.paper.invalidate("all");
  }

  /** Requests the camera of the view; an older request is dropped. */
  private async update(): Promise<void> {
    const state = this.host.state;
    if (!state || !state.has_face) return;
    this.request?.abort();
    const control = new AbortController();
    this.request = control;
    try {
      const [yaw, pitch] = state.mode === "refine" ? this.view : [0, 0];
      const camera = await this.host.api.camera(state.id, yaw, pitch, control.signal);
      if (control.signal.aborted || this.host.state?.id !== state.id) return;
      if (state.mode === "refine") {
        if (!this.face) {
          this.face = new SheetFace(this.host.viewer, () => this.host.paper.invalidate("all"));
          this.host.paper.addFace(this.face.canvas);
        }
        this.face.setCamera(camera);
        this.missing.delete("camera");
        if (this.unfitted) this.fit();
      } else {
        // The middle of the face has x = 0 cm.
        this.mirrorAxis = camera.pixel_from_cm[0][3] ?? state.sheet[0] / 2;
      }
      this.host.paper.invalidate("all");
    } catch (error) {
      this.host.fail(error);
    }
  }
}
