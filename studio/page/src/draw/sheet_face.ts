// The face on the paper, as a view of the sheet shows it: the scene of the 3-D view through the server's orthographic camera.
import { Camera, Matrix4, Vector3, WebGLRenderer } from "three";
import { AdaptiveResolution } from "../adaptive_resolution";
import type { SheetCamera } from "../api_types";
import type { Viewer } from "../viewer";
import type { PaperView } from "./paper_view";

export class SheetFace {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly camera = Object.assign(new Camera(), { isOrthographicCamera: true });
  private readonly resolution: AdaptiveResolution;
  private size: [number, number] = [0, 0];
  private rows: SheetCamera["pixel_from_cm"] | null = null;

  constructor(
    private readonly viewer: Viewer,
    redraw: () => void,
  ) {
    try {
      this.renderer = new WebGLRenderer({ antialias: true, alpha: true, powerPreference: "low-power" });
    } catch {
      throw new Error("The face cannot be shown on the paper: WebGL is off in this browser.");
    }
    this.resolution = new AdaptiveResolution(this.renderer, redraw);
    this.renderer.setClearColor(0, 0);
    this.camera.matrixAutoUpdate = false;
    this.camera.matrixWorldAutoUpdate = false;
    this.canvas = this.renderer.domElement;
    this.canvas.className = "paper-face";
    this.canvas.setAttribute("aria-hidden", "true");
  }

  setCamera(camera: SheetCamera): void {
    this.rows = camera.pixel_from_cm;
  }

  get hasCamera(): boolean {
    return this.rows !== null;
  }
  /** The rectangle of the face on the sheet: least x, least y, width, height. */
  box(): [number, number, number, number] | null {
    if (!this.rows || !this.viewer.hasFace) return null;
    const [rowX, rowY] = this.rows;
    const positions = this.viewer.vertices;
    let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let i = 0; i + 2 < positions.length; i += 3) {
      const at = (r: number[]) =>
        (r[0] ?? 0) * (positions[i] ?? 0) + (r[1] ?? 0) * (positions[i + 1] ?? 0) + (r[2] ?? 0) * (positions[i + 2] ?? 0) + (r[3] ?? 0);
      const x = at(rowX);
      const y = at(rowY);
      left = Math.min(left, x);
      right = Math.max(right, x);
      top = Math.min(top, y);
      bottom = Math.max(bottom, y);
    }
    return [left, top, right - left, bottom - top];
  }

  /** Draws the face where the view has the sheet. */
  draw(view: PaperView): void {
    const [width, height] = view.size;
    if (!this.rows || !this.viewer.hasFace || width < 1 || height < 1) return;
    if (width !== this.size[0] || height !== this.size[1]) this.renderer.setSize(width, height, false);
    this.size = [width, height];
    this.place(this.rows, view);
    this.viewer.scene.lightFrom(this.camera);
    this.resolution.begin();
    this.renderer.render(this.viewer.scene.scene, this.camera);
    this.resolution.end();
  }

  private place([x, y, depth]: SheetCamera["pixel_from_cm"], view: PaperView): void {
    const [width, height] = view.size;
    // Axes of the camera in the frame of the face: the sheet's y points down, its depth away.
    const right = axis(x, 1);
    const up = axis(y, -1);
    const back = axis(depth, -1);
    const world = new Matrix4().makeBasis(right, up, back);
    const fromWorld = world.clone().transpose();
    const kNear = -100;
    const kFar = 100;
    const middle = depth[3] ?? 0;
    const row = (r: number[], scale: number, offset: number) => [
      scale * (r[0] ?? 0),
      scale * (r[1] ?? 0),
      scale * (r[2] ?? 0),
      scale * (r[3] ?? 0) + offset,
    ];
    const clipX = row(x, (2 * view.zoom) / width, (2 * view.x) / width - 1);
    const clipY = row(y, (-2 * view.zoom) / height, 1 - (2 * view.y) / height);
    const clipZ = row(depth, 2 / (kFar - kNear), (-2 * middle) / (kFar - kNear));
    const full = new Matrix4();
    full.set(...(clipX as Row), ...(clipY as Row), ...(clipZ as Row), 0, 0, 0, 1);
    this.camera.matrixWorld.copy(world);
    this.camera.matrixWorldInverse.copy(fromWorld);
    this.camera.projectionMatrix.copy(full).multiply(world);
    this.camera.projectionMatrixInverse.copy(this.camera.projectionMatrix).invert();
    this.camera.quaternion.setFromRotationMatrix(world);
  }
}

type Row = [number, number, number, number];

function axis(row: readonly number[], sign: number): Vector3 {
  return new Vector3(row[0], row[1], row[2]).normalize().multiplyScalar(sign);
}
