// The 3-D view next to the tabs: the display head or a rigged one, turned by a person, drawn only when something changed.
import {
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  PerspectiveCamera,
  type Points,
  type PointsMaterial,
  Raycaster,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { AdaptiveResolution } from "./adaptive_resolution";
import type { Head } from "./api_types";
import { button, el } from "./dom";
import { HeadScene } from "./head_scene";
import { Orbit } from "./orbit";
import { readRiggedHead, type RiggedHead } from "./rigged_head";
import { SecondView } from "./second_view";
import { type Frame, kFieldOfView, placeCamera } from "./view_camera";
import { surfacePoints } from "./surface_points";

const kManyHandles = 150;
/** Milliseconds after which a view that waits for a face is drawn all the same. */
const kLongestHold = 400;

export type { RiggedHead } from "./rigged_head";
export const kViews = { front: [0, 0], side: [-90, 0], "three-quarter": [-35, 5] } as const;

export class Viewer {
  /** The view with its buttons; the page puts it next to the tab. */
  readonly element: HTMLElement;
  readonly orbit: Orbit;
  readonly second = new SecondView((name) => this.lookFrom(name), () => this.invalidate());
  private readonly stage: HTMLElement;
  private readonly note: HTMLElement;
  private readonly remarkBox = el("div", { class: "view-remark", role: "note", hidden: true });
  private drawing: { renderer: WebGLRenderer; resolution: AdaptiveResolution } | null = null;
  private readonly camera = new PerspectiveCamera(kFieldOfView, 1, 1, 1000);
  private readonly handlePoints: Points;
  private readonly chosenPoint: Points;
  private readonly regionPoints: Points;
  private region: readonly number[] = [];
  private readonly listeners: (() => void)[] = [];
  private rig: RiggedHead | null = null;
  private head: HeadScene | null = null;
  private handles: number[] = [];
  private chosen: number | null = null;
  /** Why nothing is ever seen. */
  private fault: string | null = null;
  private frame = 0;
  /** A drawing waits for the face that is on its way. */
  private holding = 0;
  private isStale = false;
  private readonly waiting: (() => void)[] = [];
  /** Vertices that arrived before the head. */
  private early: Float32Array | null = null;

  constructor() {
    this.note = el("p", { class: "view-note", hidden: true });
    this.stage = el(
      "div",
      {
        class: "view-stage",
        tabindex: 0,
        role: "application",
        "aria-label": "3-D view of the face. Arrow keys turn it, plus and minus zoom, 0 shows the front.",
      },
      this.note,
    );
    const look = (label: string, name: keyof typeof kViews) => button(label, () => this.lookFrom(name));
    this.element = el(
      "section",
      { class: "view", "aria-label": "3-D view" },
      this.stage,
      this.second.element,
      this.remarkBox,
      el(
        "div",
        { class: "view-buttons", role: "group", "aria-label": "View from" },
        look("Front", "front"),
        look("¾", "three-quarter"),
        look("Side", "side"),
        this.second.toggle,
      ),
    );
    this.element.querySelectorAll(".view-buttons button")[1]?.setAttribute("aria-label", "Three-quarter");
    this.orbit = new Orbit(this.stage, () => {
      this.invalidate();
      for (const listener of this.listeners) listener();
    });
    this.handlePoints = surfacePoints(0x1d6fd6, 5);
    this.chosenPoint = surfacePoints(0xe0572a, 11);
    this.regionPoints = surfacePoints(0x2f9e8f, 2.5);
    new ResizeObserver(() => this.resize()).observe(this.stage);
  }

  /** The head's topology, once, before all else. */
  setHead(head: Head, triangles: Uint32Array): void {
    // WebGL begins here and not with the page: it takes a part of a second, in which the page is to be seen.
    const renderer = this.makeRenderer();
    this.head = new HeadScene(head, triangles);
    this.head.scene.add(this.regionPoints, this.handlePoints, this.chosenPoint);
    if (renderer) this.stage.prepend(renderer.domElement);
    this.resize();
    if (this.early) this.setVertices(this.early);
    this.early = null;
    for (const act of this.waiting.splice(0)) act();
  }
  /** Acts once the head has arrived: after a reload, vertices may be here before it. */
  whenHead(act: () => void): void {
    if (this.head) act();
    else this.waiting.push(act);
  }
  private makeRenderer(): WebGLRenderer | null {
    let renderer: WebGLRenderer;
    try {
      renderer = new WebGLRenderer({ antialias: true, alpha: true, powerPreference: "low-power" });
    } catch {
      this.fault = "This browser shows no 3-D: WebGL is off. Drawing and files work without it.";
      this.say(null);
      return null;
    }
    renderer.setClearColor(0, 0);
    renderer.domElement.setAttribute("aria-hidden", "true");
    renderer.domElement.addEventListener("webglcontextrestored", () => this.invalidate());
    this.drawing = { renderer, resolution: new AdaptiveResolution(renderer, () => this.invalidate()) };
    return renderer;
  }
  /** The scene, for a second view of the same head. */
  get scene(): HeadScene {
    if (!this.head) throw new Error("The head has not arrived.");
    return this.head;
  }
  get vertices(): Float32Array {
    return this.head?.positions ?? new Float32Array();
  }
  get hasFace(): boolean {
    return this.head?.hasFace ?? false;
  }

  /** N x 3 vertices in cm; shows the display head. */
  setVertices(vertices: Float32Array): void {
    if (!this.head) {
      this.early = vertices;
      return;
    }
    this.showDisplayHead();
    this.scene.setVertices(vertices);
    this.placeHandles();
    this.say(null);
    this.invalidate();
  }
  /** Nothing to see, and why. */
  clear(why: string): void {
    this.early = null;
    this.showDisplayHead();
    this.head?.clear();
    this.setHandles([]);
    this.say(why);
    this.invalidate();
  }
  /** A sentence over the view, such as "Working …"; null removes it. */
  say(text: string | null): void {
    const shown = this.fault ?? text;
    this.note.hidden = shown === null;
    this.note.textContent = shown ?? "";
  }

  /** A sentence about what is shown, with a button; null removes it. */
  remark(remark: { text: string; label: string; act: () => void } | null): void {
    this.remarkBox.hidden = remark === null;
    if (remark) this.remarkBox.replaceChildren(el("span", {}, remark.text), button(remark.label, remark.act));
  }

  get view(): { yaw: number; pitch: number } {
    return { yaw: this.orbit.pose.yaw, pitch: this.orbit.pose.pitch };
  }
  lookFrom(name: keyof typeof kViews): void {
    const [yaw, pitch] = kViews[name];
    this.orbit.set(yaw, pitch);
  }
  onView(listener: () => void): void {
    this.listeners.push(listener);
  }
  /** Takes pointers before the view turns: returns true for a pointerdown that the tab handles itself. null: none. */
  onPointerDown(take: ((event: PointerEvent) => boolean) | null): void {
    this.orbit.take = take;
  }
  get stageElement(): HTMLElement {
    return this.stage;
  }

  /** Vertices of the face that are shown as points; one of them may be chosen. */
  setHandles(handles: readonly number[], chosen: number | null = null): void {
    this.handles = [...handles];
    this.chosen = chosen;
    // Many handles are a patch: smaller points let the skin show through.
    (this.handlePoints.material as PointsMaterial).size = handles.length > kManyHandles ? 2.5 : 5;
    this.placeHandles();
    this.invalidate();
  }
  /** Vertices that may move, as fine points; empty: none are shown. */
  setRegion(vertices: readonly number[]): void {
    if (vertices.length === 0 && this.region.length === 0) return;
    this.region = vertices;
    this.placeHandles();
    this.invalidate();
  }
  private placeHandles(): void {
    if (!this.head) return;
    const place = (points: Points, vertices: readonly number[]) => {
      const at = new Float32Array(3 * vertices.length);
      vertices.forEach((vertex, i) => {
        // Half a millimetre above the surface, so that the surface does not hide half of the point.
        for (let k = 0; k < 3; ++k) {
          at[3 * i + k] =
            (this.scene.positions[3 * vertex + k] ?? 0) + 0.05 * (this.scene.geometry.getAttribute("normal").array[3 * vertex + k] ?? 0);
        }
      });
      points.geometry.dispose();
      points.geometry = new BufferGeometry();
      points.geometry.setAttribute("position", new BufferAttribute(at, 3).setUsage(DynamicDrawUsage));
      points.visible = vertices.length > 0;
    };
    place(
      this.handlePoints,
      this.handles.filter((vertex) => vertex !== this.chosen),
    );
    place(this.regionPoints, this.region);
    place(this.chosenPoint, this.chosen === null ? [] : [this.chosen]);
  }

  /** The vertex of the face that is visible nearest to a place of the window, or null. */
  pick(clientX: number, clientY: number): number | null {
    const hit = this.cast(clientX, clientY);
    if (!hit) return null;
    const local = hit.point;
    let best: number | null = null;
    let least = Infinity;
    for (const vertex of [hit.face.a, hit.face.b, hit.face.c]) {
      if (vertex >= this.scene.head.num_face_vertices) continue;
      const distance = this.vertexPosition(vertex).distanceTo(local);
      if (distance < least) {
        least = distance;
        best = vertex;
      }
    }
    return best;
  }
  private cast(clientX: number, clientY: number) {
    if (!this.head || !this.head.hasFace) return null;
    const box = this.stage.getBoundingClientRect();
    const at = new Vector2((2 * (clientX - box.left)) / box.width - 1, 1 - (2 * (clientY - box.top)) / box.height);
    this.placeCamera();
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    const hit = ray.intersectObject(this.scene.mesh, false)[0];
    return hit && hit.face ? { point: hit.point, face: hit.face } : null;
  }
  private vertexPosition(vertex: number): Vector3 {
    const p = this.scene.positions;
    return new Vector3(p[3 * vertex], p[3 * vertex + 1], p[3 * vertex + 2]);
  }
  /** Where a vertex is in the window. */
  locate(vertex: number): { x: number; y: number } {
    this.placeCamera();
    const box = this.stage.getBoundingClientRect();
    const at = this.vertexPosition(vertex).project(this.camera);
    return { x: box.left + (box.width * (at.x + 1)) / 2, y: box.top + (box.height * (1 - at.y)) / 2 };
  }
  /** The move in cm, in the plane of the view through a vertex, of a pointer that moves by pixels of the window. */
  moveOf(vertex: number, pixelsX: number, pixelsY: number): [number, number, number] {
    this.placeCamera();
    const depth = this.vertexPosition(vertex).applyMatrix4(this.camera.matrixWorldInverse).z;
    const scale = (2 * Math.abs(depth) * Math.tan((Math.PI * kFieldOfView) / 360)) / (this.stage.clientHeight || 1);
    const move = new Vector3(pixelsX * scale, -pixelsY * scale, 0).applyQuaternion(this.camera.quaternion);
    return [move.x, move.y, move.z];
  }

  /** Shows a head of a .glb file in place of the display head, until setVertices, clear or showDisplayHead. */
  async loadGlb(bytes: ArrayBuffer): Promise<RiggedHead> {
    const rig = await readRiggedHead(bytes, () => this.invalidate());
    if (!this.head) throw new Error("The head has not arrived.");
    this.showDisplayHead();
    this.rig = rig;
    this.scene.setRigged(rig.object);
    this.say(null);
    this.invalidate();
    return rig;
  }
  showDisplayHead(): void {
    if (!this.rig) return;
    this.rig = null;
    this.scene.setRigged(null);
    this.placeHandles();
    this.invalidate();
  }

  private get frameOfHead(): Frame {
    return this.rig?.frame ?? { centre: new Vector3(...this.scene.head.centre), halfHeight: this.scene.head.half_height };
  }
  private placeCamera(): void {
    const width = this.stage.clientWidth || 1;
    const height = this.stage.clientHeight || 1;
    this.camera.setViewOffset(width, height, -this.second.shift(width, height), 0, width, height);
    placeCamera(this.camera, this.frameOfHead, this.orbit.pose, width, height);
  }

  /** Draws once, at the next frame of the browser. */
  invalidate(): void {
    if (this.frame !== 0 || !this.head) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      if (this.isHeld) this.isStale = true;
      else this.draw();
    });
  }
  /** Until a new face has arrived, a slow drawing would take the processor from the program that computes it. */
  hold(on: boolean): void {
    // Strokes that follow each other quickly do not hold it for ever.
    if (on && this.holding !== 0) return;
    clearTimeout(this.holding);
    this.holding = on ? window.setTimeout(() => this.hold(false), kLongestHold) : 0;
    if (on || !this.isStale) return;
    this.isStale = false;
    this.invalidate();
  }
  private get isHeld(): boolean {
    return this.holding !== 0 && (this.drawing?.resolution.isSlow ?? false);
  }
  private draw(withSecond = true): void {
    if (!this.head || !this.drawing || this.stage.clientWidth === 0) return;
    const { renderer, resolution } = this.drawing;
    this.placeCamera();
    this.head.lightFrom(this.camera);
    const shown = this.rig === null && this.head.hasFace;
    this.handlePoints.visible = shown && this.handles.length > 0;
    this.regionPoints.visible = shown && this.region.length > 0;
    this.chosenPoint.visible = shown && this.chosen !== null;
    resolution.begin();
    renderer.render(this.head.scene, this.camera);
    const { clientWidth, clientHeight } = this.stage;
    if (!shown && !this.rig) this.second.element.hidden = true;
    else if (withSecond) this.second.draw(renderer, this.head, this.frameOfHead, this.orbit.pose.yaw, clientWidth, clientHeight);
    resolution.end();
  }
  private resize(): void {
    this.drawing?.renderer.setSize(this.stage.clientWidth, this.stage.clientHeight, false);
    // A resized canvas is empty until it is drawn: drawing at once avoids a flash.
    this.draw();
  }

  async screenshot(): Promise<Blob> {
    this.draw(false);
    const canvas = this.drawing?.renderer.domElement;
    if (!canvas) throw new Error("The head has not arrived.");
    return new Promise((done, fail) => {
      canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error("The picture could not be made."))));
    });
  }
}
